# SPDX-License-Identifier: MIT
"""clang-tidy on several files at once: most of its time goes to the headers that they share.

Files with the same compiler arguments are included into one unit. Where such a unit has findings
(two files may have the same name in an unnamed namespace) it is halved, down to single files: what
is reported was found in a file on its own.
"""
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess

UNIT = 8  # files; more saves little, and the last units have to keep all cores busy
FINDING = re.compile(r": (error|warning): ")


def arguments_of(entry):
    """Without the file, its output, and what is gcc's: a precompiled header, flags."""
    words = shlex.split(entry["command"])
    left_out = [words.index("-o"), words.index("-o") + 1]
    for i, word in enumerate(words):
        if word == "-include" and words[i + 1].endswith("cmake_pch.hxx"):
            left_out += [i, i + 1]
        elif word in ("-c", entry["file"], "-Winvalid-pch", "-fno-gnu-unique"):
            left_out.append(i)
    return tuple(word for i, word in enumerate(words) if i not in left_out)


def units(entries):
    """(arguments, folder, files); no file twice."""
    groups = collections.defaultdict(list)
    seen = set()
    for entry in entries:
        if entry["file"] not in seen:
            seen.add(entry["file"])
            suffix = pathlib.Path(entry["file"]).suffix
            groups[arguments_of(entry), entry["directory"], suffix].append(entry["file"])
    for (arguments, directory, suffix), files in groups.items():
        files.sort()
        step = UNIT if suffix == ".cpp" else 1  # names of C files are all in one namespace
        for i in range(0, len(files), step):
            yield arguments, directory, files[i:i + step]


def tidy(folder, arguments, directory, files):
    """Findings of the files, without repetition."""
    if len(files) == 1:
        name = files[0]
    else:
        folder.mkdir(parents=True, exist_ok=True)
        name = folder / (re.sub(r"\W", "_", f"{files[0]}_{len(files)}") + ".cpp")
        name.write_text("".join(f'#include "{file}"  // NOLINT\n' for file in files))
    command = ["clang-tidy", "--quiet", str(name), "--", *arguments[1:]]
    result = subprocess.run(command, cwd=directory, capture_output=True, text=True, check=False)
    seen = [line for line in result.stdout.splitlines() if FINDING.search(line)]
    if result.returncode == 0 and not seen:
        return []
    if len(files) > 1:
        middle = len(files) // 2
        return (tidy(folder, arguments, directory, files[:middle]) +
                tidy(folder, arguments, directory, files[middle:]))
    return seen or ["clang-tidy: " + result.stderr.strip()[-400:]]


def findings(root, build, folders):
    entries = [entry for entry in json.loads((build / "compile_commands.json").read_text())
               if os.path.relpath(entry["file"], root).startswith(folders)]
    work = sorted(units(entries), key=lambda unit: -len(unit[2]))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = pool.map(lambda unit: tidy(build / "tidy", *unit), work)
        return sorted({line for lines in found for line in lines})
