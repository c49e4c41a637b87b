#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the installed `welkin` program: tool.py PREFIX VERSION WORK.

It must find its library where both now are, tell its version, and render an installed scene.
"""
import os
import pathlib
import sys

sys.dont_write_bytecode = True  # nothing is written to the source tree
from consume import output

EXR = b"\x76\x2f\x31\x01"


def main():
    prefix, version, work = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3]
    program = prefix / "bin" / "welkin"
    libraries = [line.split()[2] for line in output("ldd", program).splitlines()
                 if "libwelkin" in line]
    if [prefix in pathlib.Path(os.path.realpath(file)).parents for file in libraries] != [True]:
        sys.exit(f"{program} loads {libraries}")
    stated = output(program, "--version").strip()
    if stated != version:
        sys.exit(f"{program} --version says {stated}")
    # The quickest of the scenes: a second of lavapipe.
    scene = prefix / "share" / "welkin" / "scenes" / "surface-sphere.json"
    picture = pathlib.Path(work) / "picture.exr"
    picture.parent.mkdir(parents=True, exist_ok=True)
    picture.unlink(missing_ok=True)
    output(program, "render", scene, "--size", "16x9", "--quality", "low", "-o", picture)
    if not picture.read_bytes().startswith(EXR):
        sys.exit(f"{picture} is no picture")


if __name__ == "__main__":
    main()
