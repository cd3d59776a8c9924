"""The plain comments of the public headers, taken apart: what doxygen_filter.py and the Python reference make markup of."""

import re
import typing

# A name of code in the middle of a sentence, which no mark tells apart from words: in backticks, qualified, called, with an underscore, in two humps.
NAME = re.compile(
    r"`(?P<quoted>[^`]+)`"
    r"|(?P<power>(?<![\w.])\d+\^(?:-?\d+))"
    r"|(?P<link>https?://[^\s)]+)"
    r"|(?P<name>(?:docs|include|onset|src|scene|narrowphase|broadphase|base)/[\w/-]+\.\w+"
    r"|\w+\.(?:hpp|cpp|inl|md)\b"
    r"|~?\w+(?:::~?\w+)+(?:\(\))?"
    r"|[A-Za-z]\w*_\w+(?:\(\))?"
    r"|\b[A-Za-z]\w+\(\)"
    r"|\b(?!NaN\b)[A-Z][a-z]+[A-Z]\w*)"
)
# Words that begin a paragraph of their own; those with a colon head it.
HEADS = re.compile(r"(Guarantee|Memory|Source): *")
STARTS = re.compile(r"Throws |Returns |Safe to call|Const calls |Parameters, ")
EXAMPLE = re.compile(r"Example(.*):$")


class Part(typing.NamedTuple):
    """kind: paragraph, head (with the word), parameter (with the names), throws, returns, formula, example (with what it is of)."""

    kind: str
    name: str
    lines: list


def inline(text):
    """(kind, text) of each piece: text, code, link, power (base^exponent), in order."""
    at = 0
    for found in NAME.finditer(text):
        if found.start() > at:
            yield "text", text[at : found.start()]
        kind = "power" if found["power"] else "link" if found["link"] else "code"
        yield kind, found["quoted"] or found["name"] or found[kind]
        at = found.end()
    if at < len(text):
        yield "text", text[at:]


def parts(lines, parameters=()):
    """The parts of a comment, whose lines have lost their marks; `parameters` are names that a line "name: ..." may explain."""
    begins = "|".join(["Throws ", "Safe to call", *(f"{name}: " for name in parameters)])
    lines = re.sub(rf"(?<=[.)]) (?={begins})", "\n", "\n".join(lines)).split("\n")
    found, fresh = [], True
    for line in lines:
        example = EXAMPLE.match(line)
        if found and found[-1].kind == "example" and line[:2] == "  ":
            found[-1].lines.append(line)
            continue
        if line[:2] == "  ":
            if not found or found[-1].kind != "formula":
                found.append(Part("formula", "", []))
            found[-1].lines.append(line)
            fresh = True
            continue
        sentence_ended = fresh or not found or found[-1].lines[-1:] == [] or found[-1].lines[-1].rstrip().endswith((".", ":"))
        names = re.match(r"(\w+(?:, \w+)*): +", line)
        head = HEADS.match(line)
        if not line.strip():
            fresh = True
            continue
        if example:
            found.append(Part("example", example[1].strip(" ,"), []))
        elif head:
            found.append(Part("head", head[1], [line[head.end() :]]))
        elif names and set(re.split(", ", names[1])) <= set(parameters):
            found.append(Part("parameter", names[1].replace(" ", ""), [line[names.end() :]]))
        elif sentence_ended and re.match(r"Throws std::\w+ ", line):
            found.append(Part("throws", "", [line[len("Throws ") :]]))
        elif sentence_ended and line.startswith("Returns "):
            found.append(Part("returns", "", [line[len("Returns ") :]]))
        elif fresh or not found or found[-1].kind == "example" or (sentence_ended and STARTS.match(line)):
            found.append(Part("paragraph", "", [line]))
        else:
            found[-1].lines.append(line)
        fresh = False
    return found
