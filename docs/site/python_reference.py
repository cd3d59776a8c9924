"""The directive `names`: names of onset_ccd, documented by its stub; and the plain text of docstrings, which come from C++ comments, as markup.

    python_reference.py PACKAGE STUBS FOLDER    copies the package, its stub in the place of the compiled module, for autodoc to import
"""

import ast
import pathlib
import re
import shutil
import sys

# Types as the reference names them: what numpy spells out in several lines, autodoc would as well.
SHORT = {
    r"numpy\.typing\.ArrayLike": "ArrayLike",
    r"numpy\.typing\.NDArray": "NDArray",
    r"numpy\.(float64|int32)": r"\1",
    r"Unpack\[onset_ccd\.(\w+)\]": r"\1",
    r"onset_ccd\.": "",
}
NAMES = """from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, TypeVar

_Scalar = TypeVar("_Scalar")


class float64:
    pass


class int32:
    pass


class ArrayLike:
    pass


class NDArray(Generic[_Scalar]):
    pass


"""


def overloaded(stub):
    """For each function with overloads: the line after the last, its indentation, and the functions."""
    for scope in [stub, *(node for node in stub.body if isinstance(node, ast.ClassDef))]:
        groups = {}
        for node in scope.body:
            if isinstance(node, ast.FunctionDef) and any(getattr(d, "id", "") == "overload" for d in node.decorator_list):
                groups.setdefault(node.name, []).append(node)
        for functions in groups.values():
            yield functions[-1].end_lineno, functions[-1].col_offset, functions


def called(function):
    arguments = [a.arg for a in function.args.posonlyargs + function.args.args if a.arg != "self"]
    return f"{function.name}({', '.join(arguments + ([f'**{function.args.kwarg.arg}'] if function.args.kwarg else []))})"


def module_of(stub_text):
    """Python that can be imported: annotations stay text, and overloads have a function that all their docstrings belong to."""
    lines = stub_text.splitlines()
    for line, indent, functions in sorted(overloaded(ast.parse(stub_text)), key=lambda group: -group[0]):
        docs = [(called(f), ast.get_docstring(f)) for f in functions if ast.get_docstring(f)]
        text = "\n\n".join(f"`{call}`: {doc}" if len(docs) > 1 else doc for call, doc in docs)
        lines[line:line] = [f"{' ' * indent}def {functions[0].name}(*args, **kwargs):", f"{' ' * (indent + 4)}{text!r}"]
    text = "\n".join(lines)
    for long, short in SHORT.items():
        text = re.sub(rf"(?<![\w.]){long}", short, text)
    text = re.sub(r"^(import (onset_ccd|numpy|numpy\.typing)|from typing_extensions .*)$", "", text, flags=re.MULTILINE)
    return NAMES + text


def make_package(package, stub, folder):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
    import docstrings

    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(package, folder / "onset_ccd", ignore=shutil.ignore_patterns("__pycache__"))
    headers = sorted((pathlib.Path(__file__).resolve().parents[2] / "include/onset").glob("*.hpp"))
    docs = {name: text for header in headers for name, text in docstrings.members(header) if re.match(r"\w*Options\.", name)}
    docs.update({name.removeprefix("Options."): text for name, text in docs.items() if name.startswith("Options.")})
    options = f"\n\n__version__ = ''\n\n\ndef _option_docs():\n    from collections import defaultdict\n\n    return defaultdict(str, {docs!r})\n"
    (folder / "onset_ccd/_onset.py").write_text(module_of(stub.read_text()) + options)


def marked(text):
    """A text without markup, but for names in backticks, as reStructuredText."""
    from comment_text import inline

    out = ""
    for kind, piece in inline(text):
        if kind == "text":
            escaped = re.sub(r"[\\*|_`]", r"\\\g<0>", piece)
            # Markup ends where a character follows that may.
            out += ("\\ " if out.endswith("`") and not re.match(r"[\s'\")\]}>/:.,;!?-]", escaped) else "") + escaped
        elif kind == "link":
            out += piece
        else:
            out += "" if not out or re.search(r"[\s'\"(\[{</:-]$", out) else "\\ "
            out += f"``{piece}``" if kind == "code" else "{}\\ :sup:`{}`".format(*piece.split("^"))
    return out


def markup_of(lines, parameters, of_enum=False):
    """reStructuredText of a docstring that is a comment of C++."""
    from comment_text import parts

    for kind, name, text in parts(lines, parameters):
        if kind == "example":
            continue  # C++
        if kind == "formula":
            yield from ("::", "", *("    " + line for line in text), "")
            continue
        sentence = marked("\n".join(text)).splitlines()
        if kind == "parameter":
            yield (f"``{name}``: " if of_enum else f":param {name}: ") + (sentence[0] if sentence else "")
            yield from (("" if of_enum else "    ") + line.strip() for line in sentence[1:])
        elif kind == "throws":
            what = re.match(r"std::(\w+) ", text[0])[1]
            python = {"invalid_argument": "ValueError", "runtime_error": "RuntimeError", "bad_alloc": "MemoryError"}.get(what, "RuntimeError")
            sentence = marked("\n".join(text).split(" ", 1)[1]).splitlines()
            yield f":raises {python}: " + sentence[0]
            yield from ("    " + line.strip() for line in sentence[1:])
        else:
            lead = {"head": f"**{name}:** ", "returns": "Returns "}.get(kind, "")
            yield lead + sentence[0].lstrip() if lead else sentence[0]
            yield from sentence[1:]
        yield ""


def of_comments(what, name, obj, lines, parameters):
    """What the compiled module says of itself, and the options, as markup; other docstrings have their own."""
    module = str(getattr(obj, "__module__", None) or getattr(getattr(obj, "fget", None), "__module__", ""))
    if module.endswith("_options") and what == "class":
        lines[:] = list(options_of(obj, lines))
    elif module.endswith("_onset"):
        enumerators = getattr(obj, "__members__", ())
        names = enumerators or (parameters if what in ("function", "method", "class") else ())
        lines[:] = list(markup_of(list(lines), names, bool(enumerators)))


def options_of(options, lines):
    """A list of options with their types, after what a docstring says before it lists them."""
    from onset_ccd import Options, _onset

    for line in lines:
        if re.fullmatch(r"\w+", line):
            break
        yield line.strip()
    for name, kind in options.__annotations__.items():
        if options is not Options and name in Options.__annotations__:
            continue
        text = str(getattr(kind, "__forward_arg__", getattr(kind, "__name__", kind))).replace("Callable[[float], object]", "Callable")
        yield from ("", f"``{name}``: {text}")
        doc = _onset._option_docs()[f"{options.__name__}.{name}"]
        enumeration = re.match(r"(\w+) \| str$", text)
        otherwise = f"An enumerator of ``{enumeration[1]}``, or its name." if enumeration else "See the one above."
        yield from ("    " + line for line in (markup_of(doc.splitlines(), ()) if doc else [otherwise]))


def setup(app):
    from docutils import nodes
    from docutils.statemachine import StringList
    from sphinx.util import logging
    from sphinx.util.docutils import SphinxDirective

    class Names(SphinxDirective):
        has_content = True

        def run(self):
            import onset_ccd

            lines = StringList()
            for name in " ".join(self.content).split():
                thing = getattr(onset_ccd, name)
                of_class = isinstance(thing, type)
                text = [f".. auto{'class' if of_class else 'function'}:: onset_ccd.{name}"]
                if of_class and not name.endswith("Options"):
                    text += ["   :members:", "   :undoc-members:", "   :show-inheritance:"]
                for line in [*text, ""]:
                    lines.append(line, *self.get_source_info())
                documented.add(name)
            container = nodes.container()
            self.state.nested_parse(lines, self.content_offset, container)
            return container.children

    documented = set()
    stub = pathlib.Path(app.config.breathe_projects["onset"]).parents[1] / "python/onset_ccd/_onset.py"
    parameters = {node.arg for node in ast.walk(ast.parse(stub.read_text())) if isinstance(node, ast.arg)}

    def every_name_has_a_page(app, env):
        import onset_ccd

        stub_names = {node.name for node in ast.parse(stub.read_text()).body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        types = {node.name for node in ast.parse(NAMES).body if isinstance(node, ast.ClassDef)}
        own = set(onset_ccd.__all__) & stub_names - types | {n for n in onset_ccd.__all__ if n.endswith("Options")}
        for name in sorted(own - documented):
            logging.getLogger(__name__).warning("no page of docs/reference/python/ has onset_ccd.%s", name)

    app.add_directive("names", Names)
    app.connect("autodoc-process-docstring", lambda app, what, name, obj, _, lines: of_comments(what, name, obj, lines, parameters))
    app.connect("env-check-consistency", every_name_has_a_page)
    return {"parallel_read_safe": False, "parallel_write_safe": True}


if __name__ == "__main__":
    make_package(*map(pathlib.Path, sys.argv[1:]))
