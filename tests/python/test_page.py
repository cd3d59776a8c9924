"""The Python of docs/python.md is run as it stands there, and prints what stands below it."""

import contextlib
import io
import pathlib
import re

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "python.md"


def blocks(text):
    """(line, code, what it prints or None) of each block of Python; a block of text right below one is what it prints."""
    found = list(re.finditer(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))
    for block, following in zip(found, [*found[1:], None]):
        if block.group(1) == "python":
            below = following and following.group(1) == "text" and not text[block.end():following.start()].strip()
            yield text[: block.start()].count("\n") + 2, block.group(2), following.group(2) if below else None


def test_the_page():
    names, count = {}, 0
    for line, code, expected in blocks(PAGE.read_text(encoding="utf-8")):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile("\n" * (line - 1) + code, str(PAGE), "exec"), names)
        assert expected is None or printed.getvalue() == expected, f"docs/python.md:{line} prints\n{printed.getvalue()}"
        count += 1
    assert count > 15


def test_the_blocks_are_found():
    text = "```python\nprint(1)\n```\n\n```text\n1\n```\n\n```sh\nls\n```\n\n```python\npass\n```\n\nwords\n\n```text\n2\n```\n"
    assert list(blocks(text)) == [(2, "print(1)\n", "1\n"), (14, "pass\n", None)]
