"""What a configuration builds, says and refuses: with and without what tests and apps need, alone and in another project."""

import json
import os
import re
import shutil
import unittest

from support import CMAKE, SOURCE, OutsideTest, environment

FOR_TESTS = ("Catch2", "fcl")
FOR_APPS = ("CLI11",)
PRESETS = ("release", "debug", "dev", "checked", "tsan")
with_apps = unittest.skipIf(os.environ.get("APPS") == "0", "what the apps need is not known to be here")
with_ninja = unittest.skipUnless(shutil.which("ninja"), "no ninja")
PARENT = f"""cmake_minimum_required(VERSION 3.22)
project(parent LANGUAGES CXX)
include(settings.cmake)
add_subdirectory({SOURCE} onset)
message(STATUS "parent: '${{CMAKE_BUILD_TYPE}}' '${{CMAKE_CXX_FLAGS}}' '${{CMAKE_CONFIGURATION_TYPES}}'")
add_executable(simulator main.cpp)
target_link_libraries(simulator PRIVATE onset::onset)
"""


def without(*packages):
    """Options that hide these packages from find_package."""
    return [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in packages]


class ConfigureTest(OutsideTest):
    def configure(self, *options, source=SOURCE, status=0, **env):
        """What it says, as one line: messages are wrapped."""
        self.build = self.work / "build"
        env = environment(CMAKE_EXPORT_COMPILE_COMMANDS="ON", **env)
        code, said = self.run_command(CMAKE, "-S", source, "-B", self.build, *options, env=env)
        self.assertEqual(code != 0, status != 0, said)
        return " ".join(said.split())

    def sources(self, configuration=""):
        """The sources that the build compiles, each with its command; of one of several configurations, where it is named."""
        compiled = json.loads((self.build / "compile_commands.json").read_text())
        return {entry["file"]: entry["command"] for entry in compiled if f".dir/{configuration}" in entry["command"]}

    def folders(self):
        """The top folders of onset that sources are compiled of."""
        return {name[len(f"{SOURCE}/"):].split("/")[0] for name in self.sources() if name.startswith(f"{SOURCE}/")}

    def library(self, configuration=""):
        """The commands that compile sources of the library."""
        commands = [command for name, command in self.sources(configuration).items() if name.startswith(f"{SOURCE}/src/")]
        self.assertTrue(commands)
        return commands

    def cached(self):
        """What the cache holds, by name."""
        return dict(re.findall(r"^(\w+):\w+=(.*)$", (self.build / "CMakeCache.txt").read_text(), re.MULTILINE))


class TopLevel(ConfigureTest):
    def test_without_their_packages_tests_and_apps_are_left_out(self):
        said = self.configure(*without(*FOR_TESTS, *FOR_APPS))
        self.assertIn("onset: tests are left out, not found: Catch2, fcl (Debian, Ubuntu: apt-get install catch2 libfcl-dev)", said)
        self.assertIn("onset: apps are left out, not found: CLI11 (Debian, Ubuntu: apt-get install libcli11-dev)", said)
        self.assertNotIn("Warning", said)
        self.assertIn("src", self.folders())
        self.assertFalse(self.folders() & {"tests", "apps"})

    @with_apps
    def test_they_come_once_their_packages_are_there(self):
        self.configure(*without(*FOR_TESTS, *FOR_APPS))
        said = self.configure("-UCMAKE_DISABLE_FIND_PACKAGE_*")
        self.assertNotIn("left out", said)
        self.assertLessEqual({"tests", "apps"}, self.folders())

    @with_apps
    def test_apps_come_without_tests(self):
        self.assertIn("tests are left out", self.configure(*without(*FOR_TESTS)))
        self.assertEqual({"tests", "apps"} & self.folders(), {"apps"})

    def test_tests_come_without_apps(self):
        self.assertIn("apps are left out", self.configure(*without(*FOR_APPS)))
        self.assertEqual({"tests", "apps"} & self.folders(), {"tests"})

    def test_asked_for_they_have_to_be_possible(self):
        said = self.configure("-DONSET_BUILD_TESTS=ON", *without(*FOR_TESTS), status=1)
        self.assertIn("ONSET_BUILD_TESTS is ON, and for the tests this was not found: Catch2, fcl.", said)
        self.assertIn("apt-get install catch2 libfcl-dev", said)
        said = self.configure("-DONSET_BUILD_TESTS=OFF", "-DONSET_BUILD_APPS=ON", *without(*FOR_APPS), status=1)
        self.assertIn("ONSET_BUILD_APPS is ON, and for the apps this was not found: CLI11.", said)
        self.assertIn("apt-get install libcli11-dev", said)

    def test_off_is_off_without_a_word(self):
        said = self.configure("-DONSET_BUILD_TESTS=OFF", "-DONSET_BUILD_APPS=OFF", *without(*FOR_TESTS, *FOR_APPS))
        self.assertNotIn("left out", said)
        self.assertFalse(self.folders() & {"tests", "apps"})

    def test_what_the_library_needs_is_named(self):
        for name, package in (("Eigen3", "libeigen3-dev"), ("TBB", "libtbb-dev"), ("Boost", "libboost-dev")):
            said = self.configure("-UCMAKE_DISABLE_FIND_PACKAGE_*", *without(name), status=1)
            self.assertIn(f"apt-get install {package}", said)

    def test_tbb_can_be_done_without(self):
        """With threads of onset's own neither the build nor who uses what it installs looks for TBB."""
        for static, needed in ((True, "Threads"), (False, "")):
            self.configure("-DONSET_THREADS=STD", f"-DBUILD_SHARED_LIBS={'OFF' if static else 'ON'}",
                           *without("TBB", *FOR_TESTS, *FOR_APPS))
            self.assertIn(f'set(onset_needs "{needed}")', (self.build / "onsetConfig.cmake").read_text())
            pc = (self.build / "onset.pc").read_text()
            self.assertIn("Requires: eigen3\n", pc)
            self.assertEqual("-pthread" in pc, static)
        self.configure("-DONSET_THREADS=TBB", "-DBUILD_SHARED_LIBS=OFF", "-UCMAKE_DISABLE_FIND_PACKAGE_TBB")
        self.assertIn('set(onset_needs "TBB")', (self.build / "onsetConfig.cmake").read_text())
        self.assertIn("Requires: eigen3, tbb\n", (self.build / "onset.pc").read_text())
        self.assertIn("can be TBB or STD", self.configure("-DONSET_THREADS=OTHER", status=1))

    def test_it_is_optimised_unless_asked_otherwise(self):
        self.configure(*without(*FOR_TESTS, *FOR_APPS))
        self.assertEqual(self.cached()["CMAKE_BUILD_TYPE"], "Release")
        self.configure("-DCMAKE_BUILD_TYPE=Debug")
        self.assertEqual(self.cached()["CMAKE_BUILD_TYPE"], "Debug")
        for command in self.library():
            self.assertNotIn(" -O", command)

    @with_ninja
    def test_several_configurations(self):
        self.configure(*without(*FOR_TESTS, *FOR_APPS), CMAKE_GENERATOR="Ninja Multi-Config")
        self.assertEqual(self.cached()["CMAKE_DEFAULT_BUILD_TYPE"], "Release")
        self.assertEqual(self.cached().get("CMAKE_BUILD_TYPE", ""), "")
        self.assertIn("impl-Release.ninja", (self.build / "build.ninja").read_text())
        self.assertTrue(all(" -O3 " in command for command in self.library("Release/")))
        self.assertFalse(any(" -O" in command for command in self.library("Debug/")))

    def test_presets_are_listed(self):
        for kind, names in (("configure", (*PRESETS[:-1], "fuzz", "tsan")), ("build", PRESETS), ("test", ("dev", "checked", "tsan"))):
            status, said = self.run_command(CMAKE, f"--list-presets={kind}", cwd=SOURCE)
            self.assertEqual(status, 0, said)
            self.assertEqual(re.findall(r'^ *"(\w+)"', said, re.MULTILINE), list(names))

    def test_presets_build_what_they_say(self):
        for name, build_type, folders in (("release", "Release", set()), ("debug", "Debug", set()),
                                          ("dev", "Release", {"tests", "apps"})):
            if folders and os.environ.get("APPS") == "0":
                continue
            self.configure("--preset", name)
            self.assertEqual(self.cached()["CMAKE_BUILD_TYPE"], build_type)
            self.assertEqual({"tests", "apps"} & self.folders(), folders)

    def test_every_option_is_documented(self):
        self.configure(*without(*FOR_TESTS, *FOR_APPS))
        document = (SOURCE / "docs/building.md").read_text()
        options = [name for name in self.cached() if name.startswith(("ONSET_BUILD_", "ONSET_INSTALL", "ONSET_THREADS", "BUILD_SHARED"))]
        self.assertGreaterEqual(len(options), 5)
        for name in options:
            self.assertIn(f"| `{name}` |", document)


class Subdirectory(ConfigureTest):
    def parent(self, *options, settings="", **env):
        """What the configuration of a project says that has onset as a subdirectory."""
        (self.work / "CMakeLists.txt").write_text(PARENT)
        (self.work / "settings.cmake").write_text(settings)
        (self.work / "main.cpp").write_text("int main() {}\n")
        return self.configure(*options, source=self.work, **env)

    def optimisation(self):
        """The -O flags of the library's sources, and of the project's own."""
        def flags(command):
            return re.findall(r" (-O\w*)", command)
        library = {tuple(flags(command)) for command in self.library()}
        self.assertEqual(len(library), 1)
        return list(library.pop()), flags(self.sources()[str(self.work / "main.cpp")])

    def test_only_the_library(self):
        said = self.parent()
        self.assertFalse(self.folders() & {"tests", "apps"})
        self.assertNotIn("left out", said)
        self.assertEqual(self.cached()["ONSET_INSTALL"], "OFF")
        self.assertNotIn("include/onset", (self.build / "onset/cmake_install.cmake").read_text())

    def test_parts_can_be_asked_for(self):
        self.parent("-DONSET_BUILD_TESTS=ON", "-DONSET_INSTALL=ON")
        self.assertIn("tests", self.folders())
        self.assertIn("include/onset", (self.build / "onset/cmake_install.cmake").read_text())

    def test_without_a_build_type_the_library_is_optimised(self):
        said = self.parent()
        self.assertIn("onset: CMAKE_BUILD_TYPE is not set; the library is compiled with -O2, the rest of parent is not", said)
        self.assertIn("parent: '' '' ''", said)
        self.assertEqual(self.optimisation(), (["-O2"], []))

    def test_what_the_project_chose_holds(self):
        silent = "CMAKE_BUILD_TYPE is not set"
        self.assertNotIn(silent, self.parent("-DCMAKE_BUILD_TYPE=Debug"))
        self.assertEqual(self.optimisation(), ([], []))
        self.assertNotIn(silent, self.parent("-DCMAKE_BUILD_TYPE=", "-DCMAKE_CXX_FLAGS=-g -O0"))
        self.assertEqual(self.optimisation(), (["-O0"], ["-O0"]))
        self.assertNotIn(silent, self.parent("-DCMAKE_CXX_FLAGS=", settings="add_compile_options(-Og)"))
        self.assertEqual(self.optimisation(), (["-Og"], ["-Og"]))

    @with_ninja
    def test_several_configurations(self):
        said = self.parent(CMAKE_GENERATOR="Ninja Multi-Config")
        self.assertNotIn("CMAKE_BUILD_TYPE is not set", said)
        self.assertNotIn("CMAKE_DEFAULT_BUILD_TYPE", self.cached())
        self.assertTrue(all(" -O3 " in command and " -O2 " not in command for command in self.library("Release/")))
        self.assertFalse(any(" -O" in command for command in self.library("Debug/")))


if __name__ == "__main__":
    unittest.main()
