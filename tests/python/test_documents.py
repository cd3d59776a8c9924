"""The Python of the README and of docs/ runs as it stands there: the blocks of a page one after the other, with the same names.

A line <!-- not run: REASON --> before a block leaves it out.
"""

import pathlib
import re
import textwrap

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"(<!-- not run: [^\n]+ -->\n+)?^( *)```python\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
PAGES = [page for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))] if FENCE.search(page.read_text())]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_python_of_a_page_runs(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text, names = page.read_text(), {"__name__": page.stem}
    for block in FENCE.finditer(text):
        if block[1] is None:
            line = text[: block.start(3)].count("\n")
            exec(compile("\n" * line + textwrap.dedent(block[3]), str(page), "exec"), names)


def test_pages_have_python():
    assert {page.stem for page in PAGES} >= {"start", "scenes-and-rules", "active-sets", "starts-and-checks"}
