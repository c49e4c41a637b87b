#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds an empty project against an installed tree and runs it.

consume.py LANGUAGE WAY PREFIX VERSION WORK: LANGUAGE is c or cpp, WAY is cmake or pkg-config; each
links the shared library and then the archive. Each program must answer, and find its library in
PREFIX or hold it inside.
"""
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
# The package must be found by its prefix alone: not in this machine's paths, not by flags.
FORGOTTEN = ("PKG_CONFIG_PATH", "PKG_CONFIG_LIBDIR", "CMAKE_PREFIX_PATH", "welkin_DIR",
             "LD_LIBRARY_PATH", "LD_PRELOAD", "CFLAGS", "CXXFLAGS", "LDFLAGS", "CPATH")
ENVIRONMENT = {key: value for key, value in os.environ.items() if key not in FORGOTTEN}


def output(*command, **variables):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                            env={**ENVIRONMENT, **variables}, check=False)
    if result.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return result.stdout


def by_cmake(language, prefix, version, work):
    major, minor = (int(number) for number in version.split(".")[:2])
    output("cmake", "-G", "Ninja", "-S", HERE / language, "-B", work,
           f"-DCMAKE_PREFIX_PATH={prefix}",
           f"-DWELKIN_VERSION={version}", f"-DWELKIN_NEXT_MINOR={major}.{minor + 1}",
           "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF")
    output("cmake", "--build", work)


def by_pkg_config(language, prefix, version, work):
    files = list(prefix.rglob("welkin.pc"))
    if len(files) != 1:
        sys.exit(f"{len(files)} files welkin.pc in {prefix}")
    source, *compiler = {"c": ("main.c", "gcc", "-std=c99"),
                         "cpp": ("main.cpp", "g++", "-std=c++11")}[language]

    folder_of_pc = str(files[0].parent)

    def ask(*words):
        return output("pkg-config", *words, "welkin", PKG_CONFIG_LIBDIR=folder_of_pc).split()

    if ask("--modversion") != [version]:
        sys.exit(f"welkin.pc has version {ask('--modversion')}")
    folder = ask("--variable=libdir")[0]
    links = {"shared": [*ask("--libs"), f"-Wl,-rpath,{folder}"],
             "static": [word.replace("-lwelkin", "-l:libwelkin.a")
                        for word in ask("--static", "--libs")]}
    work.mkdir(parents=True)
    for kind, link in links.items():
        output(*compiler, HERE / language / source, *ask("--cflags"), *link, "-o", work / kind)


def check(program, prefix, shared):
    answer = output(program)
    if "welkin answers" not in answer:
        sys.exit(f"{program} says: {answer}")
    libraries = [line for line in output("ldd", program).splitlines() if "libwelkin" in line]
    inside = [line for line in libraries if str(prefix) in os.path.realpath(line.split()[2])]
    if len(libraries) != shared or len(inside) != shared:
        sys.exit(f"{program} loads {libraries}, expected {int(shared)} from {prefix}")


def main():
    language, way, prefix, version, work = sys.argv[1:]
    prefix, work = pathlib.Path(prefix).resolve(), pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    {"cmake": by_cmake, "pkg-config": by_pkg_config}[way](language, prefix, version, work)
    check(work / "shared", prefix, True)
    check(work / "static", prefix, False)


if __name__ == "__main__":
    main()
