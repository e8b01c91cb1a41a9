"""superhelix for Conan 2: `conan create packaging/conan` in a checkout. Needs cargo on the machine that builds."""

import os
import re

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

required_conan_version = ">=2.0"


class SuperhelixConan(ConanFile):
    """The library by the CMake project of the repository."""

    name = "superhelix"
    description = "A hair engine to build into other programs: strands as Super-Helices, behind a stable C ABI"
    license = "MIT OR Apache-2.0"
    topics = ("hair", "rod", "simulation", "physics")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "cargo_profile": ["ANY"]}
    default_options = {"shared": False, "cargo_profile": "release"}
    no_copy_source = True

    @property
    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        manifest = load(self, os.path.join(self._root, "Cargo.toml"))
        self.version = re.search(r'^version = "(.*)"$', manifest, re.MULTILINE).group(1)

    def export_sources(self):
        for pattern in (
            "CMakeLists.txt",
            "Cargo.toml",
            "Cargo.lock",
            "LICENSE-*",
            "README.md",
            "benches/*",
            "examples/*.rs",
            "examples/*/*.rs",
            "examples_c/*",
            "include/*",
            "packaging/cmake/*",
            "packaging/pkgconfig/*",
            "scripts/*.sh",
            "src/*",
            "tests/*.rs",
            "tests/c/library.rs",
        ):
            copy(self, pattern, self._root, self.export_sources_folder)

    def configure(self):
        # A C library: neither the C++ standard nor its library matters.
        self.settings.rm_safe("compiler.cppstd")
        self.settings.rm_safe("compiler.libcxx")

    def package_id(self):
        # Cargo's profile says how it is compiled.
        del self.info.settings.build_type
        del self.info.settings.compiler

    def validate(self):
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("the CMake project of superhelix knows Linux only")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SUPERHELIX_LINKAGE"] = "shared" if self.options.shared else "static"
        toolchain.cache_variables["SUPERHELIX_CARGO_PROFILE"] = str(self.options.cargo_profile)
        toolchain.cache_variables["SUPERHELIX_BUILD_EXAMPLES"] = False
        # Where a build of before may be taken up again.
        if folder := os.environ.get("SUPERHELIX_CARGO_TARGET_DIR"):
            toolchain.cache_variables["SUPERHELIX_CARGO_TARGET_DIR"] = folder
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE-*", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        # The package that was installed serves CMake itself.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "superhelix")]
        self.cpp_info.set_property("pkg_config_name", "superhelix")
        self.cpp_info.libs = ["superhelix"]
        if not self.options.shared:
            self.cpp_info.system_libs = ["util", "rt", "pthread", "m", "dl", "c"]
