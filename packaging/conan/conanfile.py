"""Onset for Conan 2, of the clone that this recipe lies in.

    conan create packaging/conan                                   Eigen, oneTBB and Boost from Conan Center
    conan create packaging/conan -o "&:system_dependencies=True"   those of the system, and nothing downloaded
"""

import os
import re

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

FOLDERS = ["base", "scene", "broadphase", "narrowphase", "src", "include", "cmake"]


class Onset(ConanFile):
    name = "onset"
    description = "Conservative continuous collision detection for simulators"
    license = "MIT"
    topics = ("collision-detection", "simulation", "geometry")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "threads": ["tbb", "std"], "system_dependencies": [True, False]}
    default_options = {"shared": False, "fPIC": True, "threads": "tbb", "system_dependencies": False}
    implements = ["auto_shared_fpic"]

    @property
    def _clone(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        project = load(self, os.path.join(self._clone, "CMakeLists.txt"))
        self.version = re.search(r"project\(onset VERSION ([\d.]+)", project).group(1)

    def export_sources(self):
        for pattern in ["CMakeLists.txt", "LICENSE", *(f"{folder}/*" for folder in FOLDERS)]:
            copy(self, pattern, self._clone, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def validate(self):
        check_min_cppstd(self, 17)
        if self.settings.compiler == "msvc":
            raise ConanInvalidConfiguration("onset is written in the vector types and 128-bit integers of GCC and Clang, which MSVC has not")
        if self.settings.arch not in ("x86_64", "armv8"):
            raise ConanInvalidConfiguration(f"onset needs 128-bit integers, which compilers for {self.settings.arch} have not")

    def requirements(self):
        if self.options.system_dependencies:
            return
        self.requires("eigen/3.4.0", transitive_headers=True)
        self.requires("boost/[>=1.74 <2]", options={"header_only": True}, libs=False)
        if self.options.threads == "tbb":
            self.requires("onetbb/[>=2021.5 <2023]")

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["ONSET_BUILD_TESTS"] = "OFF"
        toolchain.cache_variables["ONSET_BUILD_APPS"] = "OFF"
        toolchain.cache_variables["ONSET_THREADS"] = str(self.options.threads).upper()
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        # Its own package for CMake finds what it needs, from Conan or from the system.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "onset")]
        self.cpp_info.libs = ["onset"]
        if self.options.shared:
            self.cpp_info.defines = ["ONSET_SHARED"]
        if self.options.threads == "std" and self.settings.os == "Linux":
            self.cpp_info.system_libs = ["pthread"]
