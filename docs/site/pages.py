"""Pages of docs/ on the site: the order that index.md gives them, links that leave docs/, and names in code font as links.

The pages are written for a code host, and stay as they are.
"""

import re

from docutils import nodes
from sphinx import addnodes

LINK = re.compile(r"^- \[([^\]]*)\]\(([\w/-]+)\.(?:md|rst)\)", re.MULTILINE)


def exists(app, page):
    return any((app.srcdir / (page + suffix)).exists() for suffix in (".md", ".rst"))


def order_pages(app, text):
    """Makes of each list of links below a heading of index.md a part of the sidebar. Pages that are not there are left out."""
    text = LINK.sub(lambda m: m[0] if exists(app, m[2]) else "<!-- missing -->", text)
    text = re.sub(r"^<!-- missing -->[^\n]*\n(?:  [^\n]*\n)*", "", text, flags=re.MULTILINE)
    for heading, part in re.findall(r"^## ([^\n]*)\n(.*?)(?=^## |\Z)", text, flags=re.MULTILINE | re.DOTALL):
        linked = [f"{title} <{page}>" for title, page in LINK.findall(part)]
        if linked:
            text += f"\n```{{toctree}}\n:hidden:\n:caption: {heading}\n\n" + "\n".join(linked) + "\n```\n"
    return text


def read_page(app, docname, source):
    text = source[0]
    if docname == "index":
        text = order_pages(app, text)
    # Files that the site does not have are named, without a link; a header is linked as a name in code font is.
    text = re.sub(r"\[([^\]]*)\]\(\.\./(include/[^)#]*)\)", r"\1 (`\2`)", text)
    source[0] = re.sub(r"\[([^\]]*)\]\(\.\./([\w./-]+)\)", r"\1 (`\2`)", text)


def objects(app, domain, separator, scopes):
    """(docname, anchor) of each name of a domain, and of `Class::member` and what stands in one of the scopes without its scope."""
    found = {}
    for name, _, kind, docname, anchor, _ in app.env.domains[domain].get_objects():
        if kind in ("functionParam", "templateParam", "module"):
            continue
        found.setdefault(name.replace(separator, "::"), (docname, anchor))
    for scope in scopes:
        for name, place in list(found.items()):
            if name.startswith(scope + "::"):
                found.setdefault(name[len(scope) + 2 :], place)
    return found


POWER = re.compile(r"(?<![\w.^])(\d+)\^(-?\d+)(?![\w^])")


def raise_powers(app, doctree):
    """Makes 2^-53 in the text of pages what it means."""
    for text in list(doctree.findall(nodes.Text)):
        if not POWER.search(text) or isinstance(text.parent, (nodes.literal, nodes.FixedTextElement, nodes.raw, nodes.comment)):
            continue
        pieces, at = [], 0
        for found in POWER.finditer(text):
            pieces += [nodes.Text(text[at : found.start()] + found[1]), nodes.superscript("", found[2].replace("-", "\u2212"))]
            at = found.end()
        text.parent.replace(text, [*pieces, nodes.Text(text[at:])])


def place_of(app, text, tables):
    """Where the site says more about what stands in code font: (docname, anchor)."""
    page = re.fullmatch(r"(?:docs/)?([\w-]+)\.md", text)
    if page and page[1] in app.env.all_docs:
        return page[1], ""
    header = text.removeprefix("include/")
    if header == "onset/onset.hpp":
        return "reference/cpp/index", ""
    if header in app.env.onset_headers:
        return app.env.onset_headers[header]
    name = re.sub(r"\(.*\)$", "", text).replace(".", "::")
    return next((table[name] for table in tables if name in table), None)


def link_names(app, doctree, docname):
    if not hasattr(app, "onset_names"):
        app.onset_names = [objects(app, "cpp", "::", ("onset", "onset::ipc")), objects(app, "py", ".", ("onset_ccd",))]
    of_python = docname == "python" or docname.startswith("reference/python")
    tables = app.onset_names[::-1] if of_python else app.onset_names
    for literal in list(doctree.findall(nodes.literal)):
        above = literal.parent
        while above is not None and not isinstance(above, (nodes.reference, nodes.title, addnodes.desc_signature)):
            above = above.parent
        place = place_of(app, literal.astext().strip(), tables) if above is None else None
        if not place or place == (docname, ""):
            continue
        anchor = f"#{place[1]}" if place[1] else ""
        uri = anchor if place[0] == docname else app.builder.get_relative_uri(docname, place[0]) + anchor
        link = nodes.reference("", "", internal=True, refuri=uri, classes=["name"])
        literal.replace_self(link)
        link += literal


def setup(app):
    app.connect("source-read", read_page)
    app.connect("doctree-read", raise_powers)
    app.connect("doctree-resolved", link_names)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
