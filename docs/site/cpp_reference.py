"""The directive `headers`: public headers by their paths or patterns below include/onset/ and mpi/include/onset/, each a section of what it declares.

    cpp_reference.py XML    prepares doxygen's XML: a file is named by its path, since headers of two folders may be called alike,
                            and has what it declares in a namespace, which doxygen lists with the namespace alone; private members go
"""

import fnmatch
import pathlib
import re
import sys
from xml.etree import ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDES = [ROOT / "include", ROOT / "mpi/include"]
# They declare nothing that a program uses.
WITHOUT_SECTION = {"onset/onset.hpp", "onset/export.hpp", "onset/mpi/mpi.hpp"}


def public_headers():
    return sorted(path.relative_to(include).as_posix() for include in INCLUDES for path in include.rglob("*.hpp"))


def prepare(xml):
    for path in xml.glob("*.xml"):  # no page has a namespace
        path.write_text(re.sub(r'<ref refid="namespace\w+" kindref="compound">([^<]*)</ref>', r"\1", path.read_text()))
    for path in [*xml.glob("class*.xml"), *xml.glob("struct*.xml")]:  # which has private members, asked for or not
        page = ElementTree.parse(path)
        for compound in page.getroot().findall("compounddef"):
            for section in compound.findall("sectiondef"):
                if section.get("kind").startswith("private"):
                    compound.remove(section)
        page.write(path, encoding="utf-8", xml_declaration=True)
    declared = {}  # by file: sections of each kind
    for path in sorted(xml.glob("namespace*.xml")):
        for section in ElementTree.parse(path).getroot().iter("sectiondef"):
            for member in section.findall("memberdef"):
                member.find("name").text = member.findtext("qualifiedname")
                declared.setdefault(member.find("location").get("file"), {}).setdefault(section.get("kind"), []).append(member)
    index = ElementTree.parse(xml / "index.xml")
    for entry in index.getroot().findall("compound[@kind='file']"):
        path = xml / f"{entry.get('refid')}.xml"
        page = ElementTree.parse(path)
        file = page.getroot().find("compounddef")
        for old in [*file.findall("innernamespace"), *file.findall("sectiondef")]:
            file.remove(old)
        entry.find("name").text = name = file.find("location").get("file")
        for kind, members in declared.get(name, {}).items():
            section = ElementTree.SubElement(file, "sectiondef", kind=kind)
            section.extend(sorted(members, key=lambda member: int(member.find("location").get("line"))))
        page.write(path, encoding="utf-8", xml_declaration=True)
    index.write(xml / "index.xml", encoding="utf-8", xml_declaration=True)


def setup(app):
    from docutils import nodes
    from docutils.statemachine import StringList
    from sphinx.util import logging
    from sphinx.util.docutils import SphinxDirective
    from sphinx.util.nodes import nested_parse_with_titles

    class Headers(SphinxDirective):
        has_content = True

        def run(self):
            lines = StringList()
            made = self.env.onset_headers if hasattr(self.env, "onset_headers") else {}
            for pattern in self.content:
                names = [name for name in public_headers() if fnmatch.fnmatch(name, f"onset/{pattern}")]
                if not names:
                    raise self.error(f"no header include/onset/{pattern}")
                for name in names:
                    if name in made:
                        continue
                    anchor = "header-" + "".join(c if c.isalnum() else "-" for c in name.removeprefix("onset/").removesuffix(".hpp"))
                    made[name] = (self.env.docname, anchor)
                    for line in (f".. _{anchor}:", "", name, "-" * len(name), "", f".. doxygenfile:: {name}", ""):
                        lines.append(line, self.get_source_info()[0], self.lineno)
            self.env.onset_headers = made
            container = nodes.section()
            nested_parse_with_titles(self.state, lines, container, self.content_offset)
            return container.children

    def every_header_has_a_page(app, env):
        for name in public_headers():
            if name not in env.onset_headers and name not in WITHOUT_SECTION:
                logging.getLogger(__name__).warning("no page of docs/reference/cpp/ has include/%s", name)

    app.add_directive("headers", Headers)
    app.connect("env-check-consistency", every_header_has_a_page)
    return {"parallel_read_safe": False, "parallel_write_safe": True}


if __name__ == "__main__":
    prepare(pathlib.Path(sys.argv[1]))
