"""Builds the site into a build folder, test_site.py BUILD, and looks through it.

Every link leads to something, nothing is fetched from elsewhere, and what is public is in the reference and found by the search.
"""

import html.parser
import json
import pathlib
import re
import subprocess
import sys
import unittest
import urllib.parse
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Tags that fetch what they name when a page is shown, and where they name it.
FETCHED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src", "object": "data"}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.fetched = set(), [], []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.ids |= {of[key] for key in ("id", "name") if of.get(key)}
        if tag == "a" and of.get("href"):
            self.links.append(of["href"])
        if of.get(FETCHED.get(tag)):
            self.fetched.append(of[FETCHED[tag]])


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([ROOT / "scripts/build-site.sh", BUILD], check=True)
        cls.site = BUILD / "site"
        cls.pages = {path: Page(path) for path in cls.site.rglob("*.html")}
        text = (cls.site / "searchindex.js").read_text()
        cls.index = json.loads(text[text.index("(") + 1 : text.rindex(")")])

    def test_links_lead_somewhere(self):
        count = 0
        for path, page in self.pages.items():
            for link in page.links + page.fetched:
                url = urllib.parse.urlsplit(link)
                if url.scheme or url.netloc:
                    continue
                target = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
                self.assertTrue(target.is_file(), f"{path}: {link}")
                if url.fragment and target in self.pages:
                    self.assertIn(urllib.parse.unquote(url.fragment), self.pages[target].ids, f"{path}: {link}")
                    count += 1
        self.assertGreater(count, 1000)

    def test_nothing_is_fetched_from_elsewhere(self):
        for path, page in self.pages.items():
            for link in page.fetched:
                self.assertFalse(urllib.parse.urlsplit(link).netloc, f"{path}: {link}")
        for path in self.site.rglob("*.css"):
            self.assertIsNone(re.search(r"(@import|url\()[^;)]*//", path.read_text()), path)
        for path in self.site.rglob("*.js"):
            self.assertIsNone(re.search(r"(fetch|import|importScripts)\(\s*['\"`]\w+://|\.src\s*=\s*['\"`]\w+://", path.read_text()), path)

    def test_all_pages_are_there(self):
        names = {path.relative_to(self.site).as_posix() for path in self.pages}
        for page in (ROOT / "docs").glob("*.md"):
            self.assertIn(f"{page.stem}.html", names)

    def test_public_functions_are_in_the_reference(self):
        inventory = (self.site / "objects.inv").read_bytes()
        shown = set(zlib.decompress(inventory.split(b"\n", 4)[4]).decode().split())
        declared = 0
        for folder, scope in (("include/onset", "onset"), ("mpi/include/onset/mpi", "onset::mpi")):
            for header in (ROOT / folder).glob("*.hpp"):
                for name in re.findall(r"^ONSET_API [\w:<>, ]+[ &*](\w+)\(", header.read_text(), re.MULTILINE):
                    self.assertIn(f"{scope}::{name}", shown, header)
                    declared += 1
        self.assertGreater(declared, 20)
        for name in ("Mesh", "LineSearch.largest_step", "compute_collision_free_stepsize", "Options", "Contact.toi"):
            self.assertIn(f"onset_ccd.{name}", shown)

    def test_the_search_finds_words_and_names(self):
        for word in ("barrier", "seam", "thick", "separ"):  # stems
            self.assertIn(word, self.index["terms"])
        names = {(prefix, entry[4]) for prefix, entries in self.index["objects"].items() for entry in entries}
        for name in (("", "onset::StepResult::toi"), ("onset_ccd", "StepResult"), ("onset_ccd.StepResult", "toi")):
            self.assertIn(name, names)


if __name__ == "__main__":
    BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
