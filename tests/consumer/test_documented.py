"""The README's three ways to use onset from CMake: its blocks, as they stand there, build and run the program of app/.

A block is marked by a comment before it, <!-- test: NAME -->; what is in CMake goes into CMakeLists.txt, what is in sh is run. Only
the address of the repository and $HOME are replaced, so that nothing is asked of a network or written outside.
"""

import os
import re
import shutil
import subprocess
import unittest

from support import CMAKE, SOURCE, OutsideTest, environment

ADDRESS = "https://git.example/onset.git"
PLACE = "# onset comes in here, in one of three ways\n"
README = (SOURCE / "README.md").read_text()
VERSION = re.search(r"project\(onset VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())[1]


def blocks(name):
    """The marked blocks of that name, by language."""
    fence = r"```(\w+)\n(.*?)```\n"
    marked = re.search(rf"<!-- test: {name} -->\n((?:{fence}\n?)+)", README, re.DOTALL)
    if not marked:
        raise AssertionError(f"README.md has no block that is marked '{name}'")
    return dict(re.findall(fence, marked[1], re.DOTALL))


class Documented(OutsideTest):
    def setUp(self):
        super().setUp()
        self.env = environment(PATH=f"{os.path.dirname(CMAKE)}:{os.environ['PATH']}",
                               GIT_CONFIG_GLOBAL=os.devnull, GIT_CONFIG_NOSYSTEM="1")
        self.repository = self.work / "onset.git"
        self.project = self.work / "project"
        self.project.mkdir()

    def make_repository(self):
        """What is in the source folder now, committed or not, as a repository with the tag of its version: the library only."""
        def others(folder, names):
            top = os.path.samefile(folder, SOURCE)
            return [name for name in names if top and name.startswith((".", "build", "tests", "apps", "docs"))]
        tree = self.work / "tree"
        shutil.copytree(SOURCE, tree, ignore=others)
        name = ["-c", "user.name=test", "-c", "user.email=test@git.example"]
        for words in (["init", "-q"], ["add", "-A"], [*name, "commit", "-q", "-m", "As it is"], ["tag", f"v{VERSION}"]):
            self.run_or_fail("git", "-C", tree, *words)
        self.run_or_fail("git", "clone", "-q", "--bare", tree, self.repository)

    def run_or_fail(self, *command, **more):
        status, said = self.run_command(*command, **{"env": self.env, **more})
        self.assertEqual(status, 0, said)
        return said

    def check_versions(self):
        self.assertIn(f"GIT_TAG v{VERSION})", blocks("FetchContent")["cmake"])
        self.assertIn(f"find_package(onset {VERSION.rpartition('.')[0]} ", blocks("find_package")["cmake"])

    def use(self, way, flags, settings="", **env):
        """Follows the README in an empty folder. `flags` are those of its build type, `settings` CMake code of the user."""
        self.check_versions()
        self.make_repository()
        lists, build = blocks("project")["cmake"], blocks("build")["sh"]
        self.assertIn(PLACE, lists)
        text = lists.replace(PLACE, blocks(way)["cmake"]), blocks(way).get("sh", "") + build
        lists, script = (t.replace(ADDRESS, f"file://{self.repository}").replace("$HOME", str(self.work / "home")) for t in text)
        self.assertNotIn("://git.example", lists + script)

        (self.project / "CMakeLists.txt").write_text(lists)
        app = SOURCE / "tests/consumer/app"
        (self.project / "main.cpp").write_text(f'#include "{app}/main.cpp"\n#include "{app}/second_unit.cpp"\n')
        (self.work / "user.cmake").write_text(f'set(CMAKE_CXX_FLAGS_RELEASE "{flags}" CACHE STRING "")\n{settings}\n')
        said = self.run_or_fail("sh", "-euc", script, cwd=self.project,
                                env={**self.env, "CMAKE_TOOLCHAIN_FILE": str(self.work / "user.cmake"), **env})
        expected = subprocess.run([os.environ["PROGRAM"]], stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertTrue(expected and said.endswith(expected), said)

    # What is optimised less is sooner built, and has to print the same.

    def test_find_package(self):
        """A shared library, as this user likes it; other tests go on with what is installed here."""
        self.use("find_package", "-O0", 'set(BUILD_SHARED_LIBS ON CACHE BOOL "")')
        self.assertTrue(list(self.work.glob("home/.local/lib/**/libonset.so")))
        self.assertIn(f"onset_DIR:PATH={self.work}/home/", (self.project / "build/CMakeCache.txt").read_text())

    def test_add_subdirectory(self):
        """In a project with flags that would change the library's arithmetic, where GCC fuses, and that joins its sources."""
        self.use("add_subdirectory", "-O1 -fexpensive-optimizations -DNDEBUG", "set(CMAKE_CXX_STANDARD 20)\nset(CMAKE_UNITY_BUILD ON)",
                 CXXFLAGS="-O3 -march=native -ffast-math")

    def test_fetch_content(self):
        """Where there is no TBB, with threads of onset's own."""
        self.use("FetchContent", "-O0", 'set(ONSET_THREADS STD CACHE STRING "")\nset(CMAKE_DISABLE_FIND_PACKAGE_TBB ON)')
        cache = (self.project / "build/CMakeCache.txt").read_text()
        self.assertIn("ONSET_THREADS:STRING=STD", cache)
        self.assertNotIn("TBB_DIR", cache)
        self.assertTrue((self.project / "build/_deps/onset-src/LICENSE").exists())


if __name__ == "__main__":
    unittest.main()
