"""What a configuration builds, says and refuses: with and without what tests and apps need, alone and in another project."""

import json
import os
import re
import unittest

from support import CMAKE, SOURCE, OutsideTest, environment

FOR_TESTS = ("Catch2", "fcl")
FOR_APPS = ("CLI11",)
with_apps = unittest.skipIf(os.environ.get("APPS") == "0", "what the apps need is not known to be here")


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

    def sources(self):
        """The sources that the build compiles, each with its command."""
        compiled = json.loads((self.build / "compile_commands.json").read_text())
        return {entry["file"]: entry["command"] for entry in compiled}

    def folders(self):
        """The top folders of onset that sources are compiled of."""
        return {name[len(f"{SOURCE}/"):].split("/")[0] for name in self.sources() if name.startswith(f"{SOURCE}/")}

    def library(self):
        """The commands that compile sources of the library."""
        return [command for name, command in self.sources().items() if name.startswith(f"{SOURCE}/src/")]

    def cached(self):
        """What the cache holds, by name."""
        return dict(re.findall(r"^(\w+):\w+=(.*)$", (self.build / "CMakeCache.txt").read_text(), re.MULTILINE))


class TopLevel(ConfigureTest):
    def test_without_their_packages_tests_and_apps_are_left_out(self):
        said = self.configure(*without(*FOR_TESTS, *FOR_APPS))
        self.assertIn("onset: tests are left out, not found: Catch2, fcl (Debian, Ubuntu: apt-get install catch2 libfcl-dev)", said)
        self.assertIn("onset: apps are left out, not found: CLI11 (Debian, Ubuntu: apt-get install libcli11-dev)", said)
        self.assertNotIn("Warning", said)
        self.assertTrue(self.library())
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


if __name__ == "__main__":
    unittest.main()
