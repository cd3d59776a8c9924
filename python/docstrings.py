#!/usr/bin/env python3
"""Makes the docstrings of the bindings from the comments of the public headers.

    docstrings.py OUTPUT HEADER...

OUTPUT is a C++ file that defines onset_python::doc(name): the comment above the declaration of `Class.member`, `function`, or
`function#2` for its second overload with a comment.
"""

import pathlib
import re
import sys

SCOPE = re.compile(r"^(?:struct|class|enum class)\s+(?:ONSET_API\s+)?(\w+)[^;]*\{")
ENUMERATORS = re.compile(r"^\w+(?:,\s*\w+)*,?$")
NOT_FUNCTIONS = {"if", "for", "while", "return", "static_assert", "sizeof"}


def without_nested(text):
    """`text` without what stands in brackets of any kind."""
    previous = None
    while previous != text:
        previous, text = text, re.sub(r"<[^<>]*>|\([^()]*\)|\{[^{}]*\}|\[[^\[\]]*\]", " ", text)
    return text


def names_of(declaration, in_enum):
    if in_enum:
        return [name.strip() for name in declaration.rstrip(",").split(",")] if ENUMERATORS.match(declaration) else []
    declaration = re.sub(r"<[^<>]*>", "", declaration)
    call = re.search(r"(~?\w+)\s*\(", declaration)
    before = declaration[: call.start()] if call else ""
    if call and "=" not in before and call.group(1) not in NOT_FUNCTIONS:
        return [call.group(1)]
    if not declaration.rstrip().endswith(";"):
        return []
    names = []
    for part in without_nested(declaration.rstrip(" ;")).split(","):
        words = re.findall(r"\w+", part.split("=")[0])
        names += words[-1:]
    return names


def members(header):
    """(qualified name, comment) for each declaration with a comment above it."""
    scopes, comment, of_enumerators, depth = [], [], [], 0  # enumerators without a comment share that of those before
    for line in header.read_text().splitlines():
        text = line.strip()
        if text.startswith("//"):
            comment.append(text[3:] if text.startswith("// ") else text[2:])
            continue
        if not text:
            of_enumerators = []
        if not text or text.startswith(("#", "template", "namespace", "public:", "private:", "}")):
            keep = text.startswith("template")
        else:
            keep = False
            scope = SCOPE.match(text)
            in_enum = bool(scopes) and scopes[-1][2]
            inside = not scopes or depth == scopes[-1][1] + 1
            prefix = "".join(name + "." for name, _, _ in scopes)
            if scope:
                names = [scope.group(1)]
            else:
                names = names_of(re.sub(r"\s*//.*", "", text), in_enum) if inside else []
            shared = comment or (of_enumerators if in_enum and not scope else [])
            of_enumerators = shared if in_enum and not scope else []
            if shared:
                for name in names:
                    yield prefix + name, "\n".join(shared)
            if scope and text.count("{") > text.count("}"):
                scopes.append((scope.group(1), depth, text.startswith("enum")))
        if not keep:
            comment = []
        if not text.startswith("namespace") and "// namespace" not in text:
            depth += text.count("{") - text.count("}")
        while scopes and depth <= scopes[-1][1]:
            scopes.pop()


def main(output, *headers):
    docs = {}
    for header in sorted(map(pathlib.Path, headers)):
        for name, comment in members(header):
            key, n = name, 1
            while key in docs:
                n += 1
                key = f"{name}#{n}"
            docs[key] = comment
    rows = "".join(f'      {{"{name}", R"doc({text})doc"}},\n' for name, text in sorted(docs.items()))
    pathlib.Path(output).write_text(
        "// Made by python/docstrings.py from the comments of the public headers.\n"
        '#include "conversion/docs.hpp"\n\n#include <stdexcept>\n#include <string>\n#include <unordered_map>\n\n'
        "namespace onset_python {\n\n"
        "const char* doc(const char* name) {\n"
        "  static const std::unordered_map<std::string, const char*> docs = {\n" + rows + "  };\n"
        "  const auto found = docs.find(name);\n"
        "  if (found != docs.end()) return found->second;\n"
        "  // Members may go without; a class or a call of this name is gone.\n"
        "  if (std::string(name).find('.') == std::string::npos) throw std::logic_error(std::string(name) + \" has no comment\");\n"
        '  return "";\n'
        "}\n\n}  // namespace onset_python\n"
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
