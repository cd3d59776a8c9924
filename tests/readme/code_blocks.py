"""The C++ of documents, to be compiled: code_blocks.py FOLDER DOCUMENT...

Blocks marked cpp that begin with an #include are put into FOLDER/documented.hpp as they stand; every other one becomes a member function
run() of a struct, README_1 : Context and so on, in FOLDER/documented_fragments.hpp: the names it takes for granted are those of context.hpp.
A main function is given another name, by which for_all_programs hands it on; it ends with `return`, as no other function may do without.
A line <!-- not compiled: REASON --> before a block leaves it out. In headers, the lines that begin with //   after a comment line
"// Example..." are such blocks. Compilers name the document and its line.
"""

import pathlib
import re
import sys
import textwrap

FENCE = re.compile(r"(<!-- not compiled: [^\n]+ -->\n+)?^( *)```(?:cpp|c\+\+|C\+\+)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)

EXAMPLE = re.compile(r"^// Example[^\n]*\n((?://   [^\n]*\n)+)", re.MULTILINE)


def blocks(document):
    """(line, code) of every block that is to be compiled."""
    text = document.read_text()
    if document.suffix == ".hpp":
        found = [(m.start(1), re.sub("^//   ", "", m.group(1), flags=re.MULTILINE)) for m in EXAMPLE.finditer(text)]
    else:
        found = [(m.start(3), m.group(3)) for m in FENCE.finditer(text) if not m.group(1)]
    return [(text[:start].count("\n") + 1, code) for start, code in found]


def main(folder, *documents):
    whole, fragments = ["#pragma once\n"], ['#pragma once\n#include "tests/readme/context.hpp"\n']
    names, programs = [], []
    for document in map(pathlib.Path, documents):
        first = len(names)
        for line, code in blocks(document):
            numbered = f'#line {line} "{document}"\n{textwrap.dedent(code)}'
            if code.lstrip().startswith("#include"):
                if "int main()" in code:
                    if "\n  return 0;\n}" not in code:
                        sys.exit(f"{document}:{line}: main has no 'return 0;' at its end")
                    programs.append(f"program_{len(programs) + 1}")
                    numbered = numbered.replace("int main()", f"inline int {programs[-1]}()")
                whole.append(numbered)
                continue
            names.append(f"{re.sub('[^A-Za-z0-9]', '_', document.stem)}_{len(names) - first + 1}")
            fragments.append(f"struct {names[-1]} : Context {{\nvoid run() {{\n{numbered}}}\n}};\n")
    fragments.append("template <class F>\nvoid for_all_fragments(F&& f) {\n" + "".join(f"f({n}());\n" for n in names) + "}\n")
    whole.append("template <class F>\nvoid for_all_programs(F&& f) {\n" + "".join(f"f({p});\n" for p in programs) + "}\n")
    pathlib.Path(folder, "documented.hpp").write_text("\n".join(whole))
    pathlib.Path(folder, "documented_fragments.hpp").write_text("\n".join(fragments))
    if len(whole) < 3 or not programs or not names:
        sys.exit(f"{len(whole) - 2} whole blocks, {len(programs)} programs and {len(names)} fragments of C++: their marks have changed")


main(*sys.argv[1:])
