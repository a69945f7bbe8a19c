"""Builds the module and links it with liblumel.

The library is that of the build folder in the environment variable LUMEL_BUILD, else the installed one of this version
that pkg-config finds, else that of build/release in this source tree.
"""

import os
import pathlib
import shutil
import subprocess
import sys

from pybind11.setup_helpers import ParallelCompile, Pybind11Extension, build_ext
from setuptools import setup

HERE = pathlib.Path(__file__).resolve().parent
TREE = HERE.parent
BUILD = pathlib.Path(os.environ.get("LUMEL_BUILD") or TREE / "build" / "release")


def installed(flags, version):
    """The folders that pkg-config prints; None without the library in this version."""
    try:
        found = subprocess.run(["pkg-config", flags, f"lumel = {version}"], check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return [flag[2:] for flag in found.stdout.split()]


def build_library():
    if not (BUILD / "CMakeCache.txt").exists():
        sys.exit(f"lumel: there is no liblumel in {BUILD}: run ./run --version in Lumel's source tree, or install "
                 "Lumel so that pkg-config finds this version, and try again")
    built = subprocess.run(["cmake", "--build", str(BUILD), "--target", "lumel_library"], stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, text=True)
    if built.returncode != 0:
        sys.exit(f"{built.stdout}\nlumel: liblumel cannot be built in {BUILD}")


def find_library(version):
    """Folders of headers, of the library for the linker, and of the library at run time."""
    headers = None if "LUMEL_BUILD" in os.environ else installed("--cflags-only-I", version)
    if headers is not None:
        folders = installed("--libs-only-L", version)
        return headers, folders, folders
    build_library()
    return [str(TREE / "include")], [str(BUILD / "lib")], ["$ORIGIN"]


class BuildWithLibrary(build_ext):
    def build_extension(self, extension):
        found = find_library(self.distribution.get_version())
        extension.include_dirs += found[0]
        extension.library_dirs += found[1]
        extension.runtime_library_dirs += found[2]
        extension.depends.append(str(self.note(found)))
        super().build_extension(extension)
        if found[2] == ["$ORIGIN"]:
            self.copy_library(pathlib.Path(self.get_ext_fullpath(extension.name)).parent)

    def note(self, found):
        """A file that changes with the library, so that the module is linked again."""
        file = pathlib.Path(self.build_temp) / "library.txt"
        if not file.exists() or file.read_text() != repr(found):
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(repr(found))
        return file

    def copy_library(self, folder):
        """Copies the library beside the module, which then does not need the source tree."""
        link = BUILD / "lib" / "liblumel.so"
        if not link.is_symlink():
            sys.exit(f"lumel: {link} is missing or no link to a library with a version")
        soname = os.readlink(link)  # CMake links liblumel.so to the soname
        shutil.copy(link.parent / soname, folder / soname)


def files(folder, pattern):
    return sorted(str(file) for file in folder.glob(pattern))


ParallelCompile().install()
module = Pybind11Extension("lumel._core", [str(file.relative_to(HERE)) for file in sorted(HERE.glob("core/*.cpp"))],
                           depends=files(HERE, "core/*.h") + files(TREE, "include/lumel/*.h"), cxx_std=20,
                           libraries=["lumel"])
setup(ext_modules=[module], cmdclass={"build_ext": BuildWithLibrary})
