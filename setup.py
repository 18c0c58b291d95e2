"""Builds the module by CMake: pip install . --no-build-isolation"""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = Path(__file__).parent.resolve()


class CMakeBuild(build_ext):
    def build_extension(self, ext: Extension) -> None:
        package = Path(self.get_ext_fullpath(ext.name)).parent.resolve()
        build = Path(self.build_temp).resolve()
        configure = ["cmake", "-S", root, "-B", build, f"-DPython_EXECUTABLE={sys.executable}"]
        configure += ["-DCMAKE_BUILD_TYPE=Release", "-DPOISE_PYTHON=ON", "-DPOISE_PYTHON_DIR=."]
        configure += ["-DPOISE_PROGRAM=OFF", "-DPOISE_TESTS=OFF"]
        configure += os.environ.get("CMAKE_ARGS", "").split()
        subprocess.run(configure, check=True)
        subprocess.run(["cmake", "--build", build, "--parallel", str(os.cpu_count())], check=True)
        install = ["cmake", "--install", build, "--component", "python"]
        subprocess.run([*install, "--prefix", package.parent], check=True)


version = re.search(r"project\(poise VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())
setup(
    version=version[1],
    ext_modules=[Extension("poise._core", [])],
    cmdclass={"build_ext": CMakeBuild},
)
