"""The Python of the README and of docs/ runs as it stands there, and prints what stands below it.

The blocks of a page run one after the other, with the same names; a block of text right below one is what it prints. A line
<!-- not run: REASON --> before a block leaves it out.
"""

import contextlib
import io
import pathlib
import re
import textwrap

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"(<!-- not run: [^\n]+ -->\n+)?^( *)```(\w+)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)


def blocks(text):
    """(line, code, what it prints or None) of each block of Python that is run."""
    found = list(FENCE.finditer(text))
    for block, following in zip(found, [*found[1:], None]):
        if block[3] == "python" and block[1] is None:
            below = following and following[3] == "text" and not text[block.end():following.start()].strip()
            yield text[: block.start(4)].count("\n") + 1, textwrap.dedent(block[4]), following[4] if below else None


PAGES = [page for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))] if any(blocks(page.read_text(encoding="utf-8")))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_python_of_a_page(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"__name__": page.stem}
    for line, code, expected in blocks(page.read_text(encoding="utf-8")):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile("\n" * (line - 1) + code, str(page), "exec"), names)
        assert expected is None or printed.getvalue() == expected, f"{page.name}:{line} prints\n{printed.getvalue()}"


def test_pages_have_python():
    assert {page.stem for page in PAGES} >= {"README", "start", "scenes-and-rules", "active-sets", "starts-and-checks", "python"}


def test_the_blocks_are_found():
    text = "```python\nprint(1)\n```\n\n```text\n1\n```\n\n```sh\nls\n```\n\n```python\npass\n```\n\nwords\n\n```text\n2\n```\n"
    assert list(blocks(text)) == [(2, "print(1)\n", "1\n"), (14, "pass\n", None)]
