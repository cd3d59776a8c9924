#!/usr/bin/env python3
"""Prints a public header with its comments as Doxygen wants them: doxygen_filter.py HEADER, the INPUT_FILTER of docs/site/Doxyfile.

Comments above declarations become documentation; those above an empty line, and the first one, that of the file. What stands inside
functions, and marks for other tools, stay as they are.
"""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from comment_text import inline, parts  # noqa: E402

SPECIAL = re.compile(r"[\\@&$#<>%\"]|::")
SCOPE = re.compile(r"(?:template\s*<.*>\s*)?(?:namespace|struct|class|enum|extern)\b")
FOR_TOOLS = re.compile(r"NOLINT|clang-format")


def escaped(text):
    return SPECIAL.sub(lambda m: "\\" + m.group(), text)


def marked(text):
    made = {
        "text": escaped,
        "code": lambda t: f"<code>{escaped(t)}</code>",
        "link": lambda t: t,
        "power": lambda t: "{}<sup>{}</sup>".format(*t.split("^")),
    }
    return "".join(made[kind](piece) for kind, piece in inline(text))


def documentation(lines, declaration):
    """The lines of a comment, marked."""
    of_enum = declaration.lstrip().startswith("enum")
    inside = re.search(r"\{(.*)\}" if of_enum else r"\((.*)\)", declaration)
    parameters = re.findall(r"\w+", inside[1]) if inside else ()
    for kind, name, text in parts(lines, parameters):
        if kind == "example":
            yield f"<b>Example{', ' + escaped(name) if name else ''}:</b>"
            yield "\\code{.cpp}"
            yield from (line[2:] for line in text)
            yield "\\endcode"
        elif kind == "formula":
            yield from ("\\verbatim", *(line[2:] for line in text), "\\endverbatim")
        else:
            first, sentence = "", marked("\n".join(text))
            if kind == "head":
                first = f"<b>{name}:</b> "
            elif kind == "parameter":
                first = f"<code>{name}</code>: " if of_enum else f"\\param {name} "
            elif kind == "returns":
                first = "\\return "
            elif kind == "throws":
                what = re.match(r"std::\w+ ", text[0])
                if not inside or of_enum:
                    yield from ("Throws " + sentence).splitlines() + [""]
                    continue
                first = f"\\throws {what[0]}"
                sentence = marked("\n".join(text)[what.end() :])
            yield from (first + sentence).splitlines()
        yield ""


def braces(line):
    return re.sub(r"//.*|\"(?:\\.|[^\"])*\"|'(?:\\.|[^'])*'", "", line)


def declaration_after(lines):
    text = ""
    for line in lines:
        text += " " + line.strip()
        if re.search(r"[;{}]", braces(line)) or line.rstrip().endswith(","):
            if not re.search(r"\([^)]*$", text):
                break
    return text


def filtered(text):
    lines, of_file, out = text.splitlines(), [], []
    documented = None
    scopes, at = [], 0  # of each open brace whether it is one of declarations
    while at < len(lines):
        line = lines[at]
        comment = []
        indent = line[: len(line) - len(line.lstrip())]
        while at < len(lines) and lines[at].lstrip().startswith("//"):
            comment.append(lines[at].strip()[2:].removeprefix(" "))
            at += 1
        if comment:
            comment = [c for c in comment if not FOR_TOOLS.search(c)]
            following = lines[at] if at < len(lines) else ""
            if not all(scopes):
                out += [f"{indent}// {c}" for c in comment]
            elif not following.strip() or following.startswith("#"):
                of_file += ["", *comment]
            else:
                declaration = declaration_after(lines[at:])
                out += [f"{indent}/// {c}" for c in documentation(comment, declaration)]
                documented = re.search(r"(\w+)\(|$", declaration)[1]
            continue
        # A call right below one with a comment shares it.
        if line.startswith("ONSET_API") and out and re.search(r"[;}]$", out[-1]) and documented:
            out.append(f"/// As <code>{documented}</code>.")
        code = braces(line)
        for brace in re.findall("[{}]", code):
            if brace == "}":
                scopes[-1:] = []
            else:
                scopes.append(bool(SCOPE.match(code.strip())) and "(" not in code)
        out.append(line)
        at += 1
    return "\n".join(["/// \\file", *(f"/// {line}" for line in documentation(of_file, "")), *out]) + "\n"


if __name__ == "__main__":
    sys.stdout.write(filtered(pathlib.Path(sys.argv[1]).read_text()))
