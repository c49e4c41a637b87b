#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks what libwelkin.so gives to and takes from the process: exports.py LIBRARY SYMBOLS_TXT.

Exports exactly the list, each with its version node; takes no vk* symbol, since two users of
Vulkan in one process must not resolve to each other, nor one of wlk*, since two copies of Welkin
must not either; needs the C++ runtime and nothing else.
"""
import re
import subprocess
import sys

NEEDED = re.compile(r"(libstdc\+\+|libm|libgcc_s|libc|ld-linux-x86-64)\.so\.\d+")


def lines_of(*command):
    result = subprocess.run(command, check=True, capture_output=True, text=True)
    return result.stdout.splitlines()


def findings(library, listed):
    rows = [line.split() for line in lines_of("nm", "-D", "--with-symbol-versions", library)]
    # The version node itself is an absolute symbol (type A).
    exported = {row[-1] for row in rows if row[-2] not in ("U", "w", "v", "A")}
    for name in sorted(exported - listed):
        yield f"exported but not listed: {name}"
    for name in sorted(listed - exported):
        yield f"listed but not exported: {name}"
    for row in rows:
        if row[-2] in ("U", "w", "v") and re.match(r"(vk|vma|volk)[A-Z]", row[-1]):
            yield f"takes a symbol of Vulkan from the process: {row[-1]}"
    for line in lines_of("readelf", "-rW", library):
        own = re.search(r"R_\w+ .*\b(wlk\w+)", line)
        if own:
            yield f"calls its own function through the process: {own.group(1)}"
    for line in lines_of("readelf", "-d", library):
        needed = re.search(r"\(NEEDED\).*\[(.+)\]", line)
        if needed and not NEEDED.fullmatch(needed.group(1)):
            yield f"needs {needed.group(1)}"
        if re.search(r"\((RPATH|RUNPATH|TEXTREL)\)", line):
            yield f"dynamic section: {line.strip()}"


def main():
    library, symbols = sys.argv[1:]
    with open(symbols, encoding="utf-8") as file:
        found = list(findings(library, set(file.read().split())))
    print("\n".join(found) if found else "exports and needs are as listed")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
