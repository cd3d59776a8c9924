"""What the shell blocks of the README and docs/ name is there: scripts, presets, options of CMake and of the command line."""

import json
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^ *```sh\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]


def commands():
    """(page, words) of each command, without comments and redirections."""
    for page in PAGES:
        for block in FENCE.findall(page.read_text()):
            for line in re.sub(r"\\\n", " ", block).splitlines():
                words = re.sub(r"(^|\s)#.*", "", line).split()
                while words and re.match(r"\w+=", words[0]):
                    words = words[1:]
                if words:
                    yield page.name, words


class ShellBlocks(unittest.TestCase):
    def test_scripts_are_there(self):
        count = 0
        for page, words in commands():
            for word in words:
                if re.match(r"(\./)?(scripts|apps|tests)/[\w/.-]+$", word):
                    self.assertTrue((ROOT / word).exists(), f"{page}: {word}")
                    count += 1
            if words[0].startswith("scripts/"):
                self.assertTrue(os.access(ROOT / words[0], os.X_OK), f"{page}: {words[0]} cannot be run")
        self.assertGreater(count, 5)

    def test_presets_and_options_of_cmake_are_there(self):
        presets = json.loads((ROOT / "CMakePresets.json").read_text())
        names = {p["name"] for key in ("configurePresets", "buildPresets", "testPresets") for p in presets.get(key, [])}
        lists = "\n".join(path.read_text() for path in [ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake")])
        for page, words in commands():
            for word, following in zip(words, [*words[1:], ""]):
                if word == "--preset" and words[0] in ("cmake", "ctest"):
                    self.assertIn(following, names, page)
                option = re.match(r"-D(ONSET_\w+)", word)
                if option:
                    self.assertRegex(lists, rf"\b{option[1]}\b", f"{page}: {word}")

    @unittest.skipUnless(os.environ.get("ONSET_CLI"), "ONSET_CLI is not set")
    def test_options_of_the_command_line_are_there(self):
        helps, count = {}, 0
        for page, words in commands():
            if pathlib.PurePath(words[0]).name != "onset" or len(words) < 2 or words[1].startswith("-"):
                continue
            command = words[1]
            if command not in helps:
                helps[command] = subprocess.run([os.environ["ONSET_CLI"], command, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
            for word in words[2:]:
                if word.startswith("--"):
                    self.assertRegex(helps[command], rf"{re.escape(word.split('=')[0])}\b", f"{page}: onset {command} {word}")
                    count += 1
        self.assertGreater(count, 1)

    def test_what_start_says_of_cmake_is_what_the_readme_says(self):
        readme = (ROOT / "README.md").read_text()
        blocks = re.findall(r"```cmake\n(.*?)```", (ROOT / "docs/start.md").read_text(), re.DOTALL)
        self.assertTrue(blocks)
        for line in "".join(blocks).splitlines():
            self.assertIn(line, readme)


if __name__ == "__main__":
    unittest.main()
