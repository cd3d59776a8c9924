"""Numbers as files have them: Python's own readers take more."""


def plain_float(word):
    """A float of ASCII digits; ValueError else, as for Python's 1_0."""
    if "_" in word or not word.isascii():
        raise ValueError(f"not a number: {word}")
    return float(word)


def plain_int(word):
    if "_" in word or not word.isascii():
        raise ValueError(f"not a number: {word}")
    return int(word)
