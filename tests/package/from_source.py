#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds an empty project in C that has this source tree as a folder, and runs it.

from_source.py SOURCE BUILD TYPE WORK: BUILD is one of the same tree and build type. Objects that it
made by the same command are not made again, which would take minutes; all else is, and what they
include from a build must be the same.
"""
import filecmp
import pathlib
import shutil
import sys

sys.dont_write_bytecode = True  # nothing is written to the source tree
from consume import HERE, check, output


def main():
    source, build, kind, work = sys.argv[1:]
    project = pathlib.Path(work)
    shutil.rmtree(project, ignore_errors=True)
    project.mkdir(parents=True)
    shutil.copy(HERE / "source" / "CMakeLists.txt", project)
    shutil.copy(HERE / "c" / "main.c", project)
    link, out = project / "welkin", project / "out"
    link.symlink_to(source)
    made = out / "welkin"
    reuse = ";".join(map(str, (sys.executable, HERE / "reuse.py", build, made, source, link)))
    output("cmake", "-G", "Ninja", "-S", project, "-B", out, f"-DCMAKE_BUILD_TYPE={kind}",
           f"-DCMAKE_C_COMPILER_LAUNCHER={reuse}", f"-DCMAKE_CXX_COMPILER_LAUNCHER={reuse}")
    output("cmake", "--build", out)
    headers = [file.relative_to(made) for file in made.rglob("*.h")]
    other = [str(file) for file in headers
             if not filecmp.cmp(made / file, pathlib.Path(build) / file, shallow=False)]
    if other or not headers:
        sys.exit(f"{len(headers)} headers are made, others than in {build}: {other}")
    check(out / "shared", out, True)
    check(out / "static", out, False)


if __name__ == "__main__":
    main()
