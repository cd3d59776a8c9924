"""What is wrong with the input, or with the options: one line that names the cause."""


class InputError(Exception):
    """A file that cannot be read or written, or what is in it."""


class UsageError(Exception):
    """Options that parse but cannot go together, or are out of range."""


def one_line(text):
    return " ".join(str(text).split())


def missing(package, extra, what):
    """The error of a package that is not installed."""
    return InputError(f"{what} needs {package}, which is not installed: pip install {package}, or 'onset-ccd[{extra}]'")
