#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds and runs what the documents say in ```cmake: documents.py SOURCE PREFIX WORK.

Each block stands in a project in C whose program is `game`, as a reader would paste it; PREFIX is
the installed tree that it must find.
"""
import pathlib
import re
import shutil
import sys

sys.dont_write_bytecode = True  # nothing is written to the source tree
from consume import HERE, check, output

BLOCK = re.compile(r"^```cmake\n(.*?)^```", re.S | re.M)
HEAD = """cmake_minimum_required(VERSION 3.16)
project(game LANGUAGES C)
add_executable(game main.c)
"""


def main():
    source, prefix, work = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    shutil.rmtree(work, ignore_errors=True)
    count = 0
    for page in sorted([*source.glob("*.md"), *source.glob("docs/*.md")]):
        for block in BLOCK.findall(page.read_text(encoding="utf-8")):
            count += 1
            project = work / f"{page.stem}{count}"
            project.mkdir(parents=True)
            shutil.copy(HERE / "c" / "main.c", project)
            (project / "CMakeLists.txt").write_text(HEAD + block, encoding="utf-8")
            output("cmake", "-G", "Ninja", "-S", project, "-B", project / "out",
                   f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF")
            output("cmake", "--build", project / "out")
            check(project / "out" / "game", prefix, True)
    if count == 0:
        sys.exit("the documents have no block of cmake")


if __name__ == "__main__":
    main()
