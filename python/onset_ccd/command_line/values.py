"""The values of options, as text: numbers in their range and nothing behind them, paths that are not empty."""

import argparse
import math
import re

REAL = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


def number(text):
    """Hexadecimal too, as C writes doubles exactly; None for another text."""
    try:
        value = float(text) if REAL.fullmatch(text) else float.fromhex(text) if "x" in text.lower() else math.nan
    except (ValueError, OverflowError):
        return None
    return value if math.isfinite(value) else None


def real(zero):
    """Of a finite number > 0, or >= 0 where `zero`."""

    def parse(text):
        value = number(text)
        if value is None or value < 0 or (value == 0 and not zero):
            raise argparse.ArgumentTypeError(f"a finite number {'>= 0' if zero else '> 0'} expected, not '{text}'")
        return value

    return parse


def whole(lowest, highest):
    def parse(text):
        if not re.fullmatch(r"[+-]?\d{1,19}", text) or not lowest <= int(text) <= highest:
            raise argparse.ArgumentTypeError(f"a whole number in [{lowest}, {highest}] expected, not '{text}'")
        return int(text)

    return parse


def path(text):
    if not text:
        raise argparse.ArgumentTypeError("a path expected, not ''")
    return text


def plane(text):
    values = [number(part) for part in text.split(",")]
    if len(values) != 4 or None in values or values[:3] == [0, 0, 0]:
        raise argparse.ArgumentTypeError(f"four finite numbers nx,ny,nz,offset and a normal other than 0 expected, not '{text}'")
    return values


def body_separation(text):
    parts = text.split(",")
    if len(parts) != 3:
        raise argparse.ArgumentTypeError(f"two bodies and a length expected, such as 0,1,0.01, not '{text}'")
    body = whole(0, 2**31 - 1)
    return body(parts[0]), body(parts[1]), real(True)(parts[2])


def share(text):
    value = real(False)(text)
    if value >= 1:
        raise argparse.ArgumentTypeError(f"{text} is not below 1")
    return value


def names(known):
    """A list of names, separated by commas."""

    def parse(text):
        for name in text.split(","):
            if name not in known:
                raise argparse.ArgumentTypeError(f"'{name}' is none of {', '.join(known)}")
        return text.split(",")

    return parse
