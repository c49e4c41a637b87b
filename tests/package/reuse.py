#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiler launcher that takes objects of another build instead of making them again.

reuse.py BUILD MADE SOURCE LINK COMPILER ARGUMENT...: BUILD has objects of SOURCE; the build that
runs this one has SOURCE as LINK and its objects under MADE. An object that BUILD made by the same
command, up to these paths, is copied; any other command runs as it is.
"""
import json
import os
import pathlib
import shlex
import shutil
import sys

# What changes no object: warnings as errors, where the list of headers goes, with its words, and
# headers compiled before (what units would be without them, builds without them show).
WITHOUT_WORD, WITH_WORD = ("-Werror", "-MD", "-Winvalid-pch"), ("-MT", "-MF")
PRECOMPILED = "cmake_pch.hxx"


def essence(words):
    """(object, the words that decide what it becomes)"""
    rest, result, words = [], None, iter(words)
    for word in words:
        if word == "-o":
            result = next(words)
        elif word in WITH_WORD:
            next(words)
        elif word == "-include":
            header = next(words)
            rest += [] if header.endswith(PRECOMPILED) else [word, header]
        elif word not in WITHOUT_WORD:
            rest.append(word)
    return result, rest


def main():
    build, made, source, link, *command = sys.argv[1:]
    mine = [word.replace(made, build).replace(link, source) for word in command]
    target, wanted = essence(mine)
    # Objects are named from the folder where the compiler runs, that above MADE.
    name = target and os.path.relpath(target, pathlib.Path(made).name)
    with open(pathlib.Path(build) / "compile_commands.json", encoding="utf-8") as file:
        for entry in json.load(file):
            if essence(shlex.split(entry["command"])) == (name, wanted):
                shutil.copyfile(pathlib.Path(build) / name, target)
                return
    os.execvp(command[0], command)


if __name__ == "__main__":
    main()
