"""A recipe for conan 2 of the checkout that it lies in: conan create packaging/conan"""
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy
from conan.tools.gnu import PkgConfigDeps

PARTS = {"io": ("gdal/3.8.3", "assimp/5.4.3", "expat/2.6.4"), "draw": ("cairo/1.18.0",), "cli": ("jansson/2.14",)}


class Froe(ConanFile):
    name = "froe"
    version = "0.1.0"
    description = "Small, exact binary space partitions: queries, drawings and motion of maps and models"
    license = "MIT"
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], **{part: [True, False] for part in PARTS}}
    default_options = {"shared": False, **{part: False for part in PARTS}}
    languages = ["C"]

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "*.c", "*.h", "*.inc", "*.def", "*.css", "*.js", "cmake/*", "data/*"):
            copy(self, pattern, root, self.export_sources_folder, excludes=("build/*", "web/*", "python/*", "tests/*"))

    def configure(self):
        if self.options.cli:
            self.options.io = self.options.draw = True

    def requirements(self):
        for part, needs in PARTS.items():
            if self.options.get_safe(part):
                for need in needs:
                    self.requires(need)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for part in PARTS:
            toolchain.cache_variables["FROE_" + part.upper()] = bool(self.options.get_safe(part))
        toolchain.cache_variables.update(FROE_TESTS=False, FROE_WERROR=False)
        toolchain.generate()
        PkgConfigDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        """Users find what CMake has installed: froe-config.cmake and froe.pc are froe's own."""
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "froe")]
        self.cpp_info.libs = ["froe"]
        self.cpp_info.system_libs = ["m", "pthread"]
        for part in ("io", "draw"):
            if self.options.get_safe(part):
                self.cpp_info.libs.insert(0, "froe-" + part)
