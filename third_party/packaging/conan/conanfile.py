# SPDX-License-Identifier: MIT
"""glssao for Conan 2."""

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, get


class Glssao(ConanFile):
    name = "glssao"
    version = "0.2.0"
    license = "MIT"
    description = "Screen-space ambient occlusion for OpenGL 3.3"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    languages = ["C"]
    implements = ["auto_shared_fpic"]

    def layout(self):
        cmake_layout(self, src_folder="src")

    def source(self):
        get(self, f"https://example.org/glssao-{self.version}.tar.gz", strip_root=True)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["GLSSAO_BUILD_EXAMPLES"] = False
        toolchain.cache_variables["GLSSAO_BUILD_TESTS"] = False
        toolchain.cache_variables["GLSSAO_INSTALL"] = True
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, f"{self.package_folder}/licenses")
        CMake(self).install()

    def package_info(self):
        self.cpp_info.libs = ["glssao"]
        self.cpp_info.set_property("cmake_target_name", "glssao::glssao")
        if self.options.shared:
            self.cpp_info.defines = ["GLSSAO_SHARED"]
        elif self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m"]
