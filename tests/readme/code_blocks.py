"""The C++ of documents, to be compiled: code_blocks.py FOLDER DOCUMENT...

Blocks marked cpp that begin with an #include are put into FOLDER/documented.hpp as they stand; every other one becomes a member function
run() of a struct, README_1 : Context and so on, in FOLDER/documented_fragments.hpp: the names it takes for granted are those of context.hpp.
A line <!-- not compiled: REASON --> before a block leaves it out. Compilers name the document and its line.
"""

import pathlib
import re
import sys
import textwrap

FENCE = re.compile(r"(<!-- not compiled: [^\n]+ -->\n+)?^( *)```(?:cpp|c\+\+|C\+\+)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)


def main(folder, *documents):
    whole, fragments = ["#pragma once\n"], ['#pragma once\n#include "tests/readme/context.hpp"\n']
    names = []
    for document in map(pathlib.Path, documents):
        text, first = document.read_text(), len(names)
        for block in FENCE.finditer(text):
            left_out, _, code = block.groups()
            if left_out:
                continue
            line = text[:block.start(3)].count("\n") + 1
            numbered = f'#line {line} "{document}"\n{textwrap.dedent(code)}'
            if code.lstrip().startswith("#include"):
                whole.append(numbered)
                continue
            names.append(f"{document.stem.replace('-', '_')}_{len(names) - first + 1}")
            fragments.append(f"struct {names[-1]} : Context {{\nvoid run() {{\n{numbered}}}\n}};\n")
    fragments.append("template <class F>\nvoid for_all_fragments(F&& f) {\n" + "".join(f"f({n}());\n" for n in names) + "}\n")
    pathlib.Path(folder, "documented.hpp").write_text("\n".join(whole))
    pathlib.Path(folder, "documented_fragments.hpp").write_text("\n".join(fragments))
    if len(whole) < 2 or not names:
        sys.exit(f"{len(whole) - 1} programs and {len(names)} fragments of C++: their marks have changed")


main(*sys.argv[1:])
