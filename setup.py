"""pip install --no-build-isolation . builds the module with CMake and packs it with the package's Python and the data."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeModule(build_ext):
    """FOLK_BUILD names a build folder to go on with; CMAKE_ARGS holds more options for CMake."""

    def build_extension(self, extension):
        target = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        build = Path(os.environ.get("FOLK_BUILD") or Path(self.build_temp).resolve())
        subprocess.run(
            ["cmake", "-S", ROOT, "-B", build, *generator(build), "-DCMAKE_BUILD_TYPE=Release", "-DFOLK_FOLDERS_AS_ONE=ON",
             "-DFOLK_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}", "-DFOLK_PROGRAMS=OFF", "-DFOLK_TESTS=OFF",
             "-DFOLK_BENCH=OFF", "-DFOLK_MPI=OFF", *os.environ.get("CMAKE_ARGS", "").split()],
            check=True)
        subprocess.run(["cmake", "--build", build, "--target", "_folk", "--parallel", *jobs()], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", target.parent], check=True)
        shutil.copytree(ROOT / "data", target / "data", dirs_exist_ok=True)


def generator(build):
    return ["-G", "Ninja"] if shutil.which("ninja") and not (build / "CMakeCache.txt").exists() else []


def jobs():
    return [os.environ["CMAKE_BUILD_PARALLEL_LEVEL"]] if "CMAKE_BUILD_PARALLEL_LEVEL" in os.environ else []


def version():
    return re.search(r"project\(Folk VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


setup(
    version=version(),
    packages=["folk"],
    package_dir={"": "python"},
    package_data={"folk": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("folk._folk", [])],
    cmdclass={"build_ext": CMakeModule},
    zip_safe=False,
)
