"""The recipes of other package managers and CITATION.cff, as far as that can be tried without their registries.

Environment: SOURCE, WORK (a folder that is emptied), PROGRAM (prints what a user of a package must print), CXX, LAUNCHER (ccache or
nothing), CMAKE.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["SOURCE"])
WORK = pathlib.Path(os.environ["WORK"])
CMAKE = os.environ["CMAKE"]
BIN = pathlib.Path(sys.executable).parent
PORT = SOURCE / "packaging/vcpkg/onset"


def run(*command, **environment):
    done = subprocess.run([str(word) for word in command], env={**os.environ, **environment}, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout[-5000:]}")
    return done.stdout


def fresh(name):
    folder = WORK / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def version():
    return re.search(r"project\(onset VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)


class Texts(unittest.TestCase):
    def test_citation_is_valid(self):
        self.assertIn("valid", run(BIN / "cffconvert", "--validate", "-i", SOURCE / "CITATION.cff"))
        broken = fresh("citation") / "CITATION.cff"
        broken.write_text((SOURCE / "CITATION.cff").read_text().replace("type: article", "type: none"))
        with self.assertRaises(AssertionError):
            run(BIN / "cffconvert", "--validate", "-i", broken)

    def test_versions_are_those_of_the_project(self):
        self.assertIn(f"\nversion: {version()}\n", (SOURCE / "CITATION.cff").read_text())
        self.assertEqual(json.loads((PORT / "vcpkg.json").read_text())["version-semver"], version())

    # What vcpkg's own schema says of the fields that are used; the schema itself is not at hand.
    def test_vcpkg_manifest(self):
        manifest = json.loads((PORT / "vcpkg.json").read_text())
        known = {"$schema", "name", "version-semver", "description", "license", "supports", "dependencies", "default-features", "features"}
        self.assertLessEqual(set(manifest), known)
        identifier = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
        dependencies = list(manifest["dependencies"])
        for name, feature in manifest["features"].items():
            self.assertTrue(identifier.fullmatch(name))
            self.assertLessEqual(set(feature), {"description", "dependencies", "supports"})
            dependencies += feature["dependencies"]
        for dependency in dependencies:
            if isinstance(dependency, dict):
                self.assertLessEqual(set(dependency), {"name", "host", "features", "default-features", "platform", "version>="})
                dependency = dependency["name"]
            self.assertTrue(identifier.fullmatch(dependency), dependency)
        self.assertLessEqual(set(manifest["default-features"]), set(manifest["features"]))


class Vcpkg(unittest.TestCase):
    def test_static_with_tbb(self):
        work = fresh("vcpkg")
        packages = work / "packages"
        run(CMAKE, f"-DPORT_DIR={PORT}", "-DFEATURES=core;tbb", "-DVCPKG_LIBRARY_LINKAGE=static", f"-DCURRENT_PACKAGES_DIR={packages}",
            f"-DCURRENT_BUILDTREES_DIR={work / 'build'}", f"-DLAUNCHER={os.environ['LAUNCHER']}", "-P", SOURCE / "tests/packaging/mock_vcpkg.cmake")
        for name in ["copyright", "usage", "onsetConfig.cmake"]:
            self.assertTrue((packages / "share/onset" / name).is_file(), name)
        self.assertFalse((packages / "share/doc").exists())
        run(CMAKE, "-S", SOURCE / "tests/consumer/app", "-B", work / "consumer", "-G", "Ninja", f"-Donset_DIR={packages / 'share/onset'}",
            "-DCMAKE_BUILD_TYPE=Release")
        run(CMAKE, "--build", work / "consumer")
        self.assertEqual(run(work / "consumer/consumer"), run(os.environ["PROGRAM"]))


class Conan(unittest.TestCase):
    def test_shared_with_own_threads(self):
        environment = {"CONAN_HOME": str(fresh("conan")), "CMAKE_CXX_COMPILER_LAUNCHER": os.environ["LAUNCHER"]}
        run(BIN / "conan", "profile", "detect", **environment)
        run(BIN / "conan", "remote", "disable", "*", **environment)
        options = [word for option in ["system_dependencies=True", "shared=True", "threads=std"] for word in ("-o", f"&:{option}")]
        said = run(BIN / "conan", "create", SOURCE / "packaging/conan", "-s", "compiler.cppstd=gnu17", "-c",
                   "tools.cmake.cmaketoolchain:generator=Ninja", *options, **environment)
        self.assertIn(f"onset/{version()}", said)
        self.assertRegex(said, r"step 0\.4999\d*")


if __name__ == "__main__":
    unittest.main(verbosity=2)
