#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks the ABI in every known way and requires that gate.py and exports.py see it; changes that
keep old programs running must pass. Works on small headers of its own, in the form of the true
ones. Prints what is not as it should be."""
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is written to the source tree
import exports
import gate

PREAMBLE = """#pragma once
#include <stdint.h>
#define WLK_API __attribute__((visibility("default")))
typedef int32_t WlkResult;
"""
TOY = """
#define WLK_VERSION_MINOR 1
#define WLK_TOY_SIZE 16u
enum { WLK_TOY_SUCCESS = 0, WLK_TOY_ERROR = -1 };
typedef enum WlkToyKind { WLK_TOY_KIND_ONE = 1, WLK_TOY_KIND_TWO = 2 } WlkToyKind;
typedef void (*WlkToyCallback)(void* user, uint32_t severity);
typedef struct WlkToy {
  uint64_t id;
} WlkToy;
typedef struct WlkToyPart {
  float x;
  uint32_t count;
} WlkToyPart;
typedef struct WlkToyItem {
  double y;
} WlkToyItem;
typedef struct WlkToyInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  const WlkToyItem* items;
  uint32_t itemStride;
  WlkToyPart part;
  uint32_t flags;
  float scale;
  WlkToyCallback log;
  double position[3];
  uint32_t reserved0;
  uint32_t last;
} WlkToyInfo;
typedef struct WlkToyInner {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  double value;
} WlkToyInner;
typedef struct WlkToyOuter {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  WlkToyInner inner;
  double after;
} WlkToyOuter;
typedef struct WlkToyTail {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  uint32_t flags;
} WlkToyTail;
WLK_API WlkResult wlkToyMake(WlkToyKind kind, const WlkToyInfo* info, WlkToy* toy);
WLK_API WlkResult wlkToyChange(WlkToy toy, uint32_t count, const double* values);
WLK_API double wlkToyValue(WlkToy toy, const WlkToyOuter* outer);
"""

TYPES = {"abidiff", "abicc"}
LAYOUT = {"layout"}
ALL = TYPES | LAYOUT

# (what, text of TOY, what replaces it, checks that must go red; others may)
HARMLESS = [
    ("nothing", "", ""),
    ("a function added", "WLK_API double", "WLK_API void wlkToyNew(uint32_t a);\nWLK_API double"),
    ("an enumerator added", "KIND_TWO = 2 }", "KIND_TWO = 2, WLK_TOY_KIND_THREE = 3 }"),
    ("an error code added", "ERROR = -1 }", "ERROR = -1, WLK_TOY_LATE = -2 }"),
    ("a structure added", "typedef struct WlkToyPart",
     "typedef struct WlkToyNew {\n  float x;\n} WlkToyNew;\ntypedef struct WlkToyPart"),
    ("a field at the end", "uint32_t last;\n", "uint32_t last;\n  double more;\n"),
    ("an array's structure, with a stride", "  double y;\n", "  double y;\n  double z;\n"),
    ("the version", "MINOR 1", "MINOR 2"),
    ("reserved room used", "uint32_t reserved0;", "uint32_t mode;"),
]
BREAKS = [
    ("a function removed", "WLK_API double wlkToyValue(WlkToy toy, const WlkToyOuter* outer);\n",
     "", TYPES),
    ("a function renamed", "wlkToyValue", "wlkToyWorth", TYPES),
    ("a parameter widened", "uint32_t count, const", "uint64_t count, const", TYPES),
    ("a parameter added", "uint32_t count, const", "uint32_t count, uint32_t stride, const", TYPES),
    ("parameters exchanged", "uint32_t count, const double* values",
     "const double* values, uint32_t count", TYPES),
    ("double returned as float", "WLK_API double", "WLK_API float", TYPES),
    ("an array of other numbers", "const double* values", "const float* values", {"abidiff"}),
    ("a callback's parameter", "uint32_t severity", "uint64_t severity", {"abidiff"}),
    ("a field inserted first", "  float x;\n", "  float w;\n  float x;\n", ALL),
    ("a field inserted in the middle", "  float scale;\n", "  double bias;\n  float scale;\n", ALL),
    ("a field inserted before the last", "  uint32_t last;\n",
     "  double bias;\n  uint32_t last;\n", ALL),
    ("a field removed", "  float scale;\n", "", ALL),
    ("a field's type, of one size", "float scale", "uint32_t scale", {"abidiff"}),
    ("a field wider, where padding was", "  uint32_t last;\n", "  uint64_t last;\n",
     LAYOUT | {"abidiff"}),
    ("fields exchanged", "  uint32_t flags;\n  float scale;\n",
     "  float scale;\n  uint32_t flags;\n", ALL),
    ("a field in the padding at the end", "  uint32_t flags;\n} WlkToyTail",
     "  uint32_t flags;\n  uint32_t more;\n} WlkToyTail", {"abidiff"}),
    ("a structure without a head grew", "  uint32_t count;\n}", "  uint32_t count;\n  float y;\n}",
     ALL),
    ("a handle wider", "  uint64_t id;\n", "  uint64_t id;\n  uint64_t owner;\n", LAYOUT),
    ("an embedded structure grew", "  double value;\n",
     "  double value;\n  double error;\n", LAYOUT),
    ("an array longer", "position[3]", "position[4]", LAYOUT | {"abidiff"}),
    ("an enumerator renumbered", "KIND_ONE = 1, WLK_TOY_KIND_TWO = 2",
     "KIND_ONE = 2, WLK_TOY_KIND_TWO = 1", ALL),
    ("an enumerator removed", ", WLK_TOY_KIND_TWO = 2", "", LAYOUT | {"abidiff"}),
    ("an error code changed", "WLK_TOY_ERROR = -1", "WLK_TOY_ERROR = -2", LAYOUT),
    ("a macro changed", "WLK_TOY_SIZE 16u", "WLK_TOY_SIZE 32u", LAYOUT),
    ("a macro removed", "#define WLK_TOY_SIZE 16u\n", "", LAYOUT),
]


def write_headers(folder, text):
    (folder / "welkin").mkdir(parents=True)
    for name in gate.generate.HEADERS:
        (folder / "welkin" / name).write_text("" if name != "core.h" else PREAMBLE + text)
    (folder / "welkin" / "welkin_vulkan.h").write_text('#include "core.h"\n')
    return folder


def verdict(case):
    """What is wrong with the gate's answer to one change, or None."""
    what, old, new, *red = case
    if old not in TOY:
        return f"{what}: the text to change does not exist"
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        before = write_headers(folder / "before", TOY)
        after = write_headers(folder / "after", TOY.replace(old, new, 1))
        found = gate.breaks(before, after, folder)
    if not red:
        return f"{what} is harmless, but: {found}" if found else None
    missed = red[0] - set(found)
    return f"{what}: not seen by {sorted(missed)}" if missed else None


# Libraries: (what, C text, linker's version script, more arguments, a word of the finding).
PLAIN = "int wlkToy(void) { return 1; }\nint inside(void) { return 2; }\n"
NODE = "WELKIN_1.0 { global: wlk*; local: *; };\n"
LIBRARIES = [
    ("the library as it is", PLAIN, NODE, [], ""),
    ("a function is gone", "int inside(void) { return 2; }\n", NODE, [], "not exported"),
    ("another node", PLAIN, NODE.replace("1.0", "1.1"), [], "not exported: wlkToy@@WELKIN_1.0"),
    ("internals are exported", PLAIN, NODE.replace("wlk*;", "wlk*; inside;"), [], "not listed"),
    ("Vulkan is taken from the process", "int vkToy(void);\nint wlkToy(void) { return vkToy(); }\n",
     NODE, [], "symbol of Vulkan"),
    ("its own function is taken from the process",
     PLAIN + "int wlkOther(void) { return wlkToy(); }\n", NODE, [], "through the process: wlkToy"),
    ("a library more is needed", PLAIN, NODE, ["-Wl,--no-as-needed", "-lz"], "needs libz"),
    ("a path to libraries", PLAIN, NODE, ["-Wl,-rpath,/opt"], "RUNPATH"),
]


def library_verdict(case):
    what, text, node, arguments, word = case
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "toy.c").write_text(text)
        (folder / "toy.map").write_text(node)
        subprocess.run(["gcc", "-w", "-shared", "-fPIC", folder / "toy.c", "-o", folder / "toy.so",
                        f"-Wl,--version-script={folder / 'toy.map'}", *arguments], check=True)
        found = list(exports.findings(folder / "toy.so", {"wlkToy@@WELKIN_1.0"}))
    if not word:
        return f"{what}: {found}" if found else None
    return None if any(word in line for line in found) else f"{what}: not seen, but {found}"



# What wlkInitStruct writes: (what, text of BOX or FILL, what replaces it, is it a break).
BOX = """
enum { WLK_SUCCESS = 0, WLK_STRUCT_TOY_BOX = 1 };
typedef struct WlkToyBox {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  float scale[2];
  uint32_t mode;
  uint32_t reserved0;
  const void* data;
} WlkToyBox;
WLK_API WlkResult wlkInitStruct(uint32_t sType, uint32_t structSize, void* structure);
WLK_API double wlkToyVolume(double edge);
"""
FILL = """
#include <string.h>
#include <welkin/core.h>
WlkResult wlkInitStruct(uint32_t sType, uint32_t structSize, void* structure) {
  WlkToyBox box = {1, structSize, 0, {1.0f, 0.3f}, 7};
  memcpy(structure, &box, structSize < sizeof box ? structSize : sizeof box);
  return 0;
}
double wlkToyVolume(double edge) { return edge * edge * edge; }
"""
DEFAULTS = [
    ("defaults as they were", "", "", False),
    ("a field more", "const void* data;", "const void* data;\n  double late;", False),
    ("the last digit of a default", "0.3f", "0.30000004f", True),
    ("another mode", ", 7}", ", 8}", True),
    ("a pointer that was null", ", 7}", ", 7, 0, structure}", True),
    ("reserved room that is not 0", ", 7}", ", 7, 1}", True),
]


def toy_library(folder, *changes):
    """A library of BOX and FILL, changed by pairs (old, new), with its headers in `folder`."""
    header, source = BOX, FILL
    for old, new in changes:
        header, source = header.replace(old, new, 1), source.replace(old, new, 1)
    include = write_headers(folder, header)
    (include / "fill.c").write_text(source)
    library = include / "libtoy.so"
    subprocess.run(["gcc", "-w", "-shared", "-fPIC", f"-I{include}", include / "fill.c",
                    "-o", library], check=True)
    return library


def defaults_verdict(case):
    what, old, new, breaks = case
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        libraries = [toy_library(folder / "old"), toy_library(folder / "new", (old, new))]
        baseline = folder / "old"
        lines = gate.defaults(baseline, libraries[0], folder)
        (baseline / "defaults.txt").write_text("\n".join(lines) + "\n")
        if not any(line.startswith("WlkToyBox::scale 1 0.3") for line in lines):
            return f"defaults are not listed, but {lines}"
        found = gate.check_defaults(baseline, libraries[1], folder)
    return f"{what}: {found or 'not seen'}" if bool(found) != breaks else None


# Old programs with another library: (what, changes of BOX and FILL, a word of the finding).
CLIENT = """
#include <stdio.h>
#include <welkin/core.h>
int main(void) {
  double volume = wlkToyVolume(2.0);
  if (volume != 8.0) fprintf(stderr, "the volume is %g\\n", volume);
  return volume != 8.0;
}
"""
GROWN = ("const void* data;", "const void* data;\n  double late;")
COPY = "memcpy(structure, &box, structSize < sizeof box ? structSize : sizeof box);"
CLIENTS = [
    ("a library as it was", [], ""),
    ("a structure that grew, the old size taken", [GROWN], ""),
    ("another value of the same call", [("edge * edge * edge", "edge * edge")],
     "client.c: the volume is 4"),
    ("a crash", [("return edge", "__builtin_trap(); return edge")], "client.c: exit status -"),
    ("a function that old programs call is gone", [("wlkToyVolume", "wlkToyWeight")],
     "client.c: .*undefined reference to .wlkToyVolume"),
    ("a structure that grew, the old size refused",
     [GROWN, (COPY, f"if (structSize < sizeof box) return -1; {COPY}")],
     "sizes.c: WlkToyBox of 40 bytes is refused"),
    ("a structure that shrank, the old size refused",
     [("  const void* data;\n", ""), (COPY, f"if (structSize > sizeof box) return -1; {COPY}")],
     "sizes.c: WlkToyBox of 40 bytes is refused"),
    ("a structure that grew, written in its new size",
     [GROWN, (COPY, "memcpy(structure, &box, sizeof box);")],
     "sizes.c: WlkToyBox of 40 bytes is overrun"),
]


def client_verdict(case):
    """By way of all_breaks, so that a check which is not called is seen as well."""
    what, changes, word = case
    if any(old not in BOX + FILL for old, _ in changes):
        return f"{what}: the text to change does not exist"
    with tempfile.TemporaryDirectory() as temporary:
        root = pathlib.Path(temporary)
        before = toy_library(root / "1.0")
        baseline = before.parent
        (baseline / "client.c").write_text(CLIENT)
        (baseline / "symbols.txt").write_text("")
        lines = gate.defaults(baseline, before, root)
        (baseline / "defaults.txt").write_text("\n".join(lines) + "\n")
        library = toy_library(root / "now", *changes)
        found = gate.all_breaks(root, 1, library.parent, library, baseline / "symbols.txt")
    lines = found.get("1.0 client", [])
    if not word:
        return f"{what} is harmless, but: {found}" if found else None
    return None if any(re.search(word, line) for line in lines) else \
        f"{what}: not seen by the client, but {found}"


# Lists of symbols: (what, then, now, a word of the finding).
THEN = "wlkA@@WELKIN_1.0\nwlkB@@WELKIN_1.0\n"
NODES = [
    ("the list as it was", THEN, ""),
    ("a function in a new node", THEN + "wlkC@@WELKIN_1.1\n", ""),
    ("a function in a frozen node", THEN + "wlkC@@WELKIN_1.0\n", "wlkC@@WELKIN_1.0 was added"),
    ("a function in another node", THEN.replace("wlkB@@WELKIN_1.0", "wlkB@@WELKIN_1.1"),
     "wlkB@@WELKIN_1.0 is gone"),
]


def nodes_verdict(case):
    what, now, word = case
    with tempfile.TemporaryDirectory() as temporary:
        baseline = pathlib.Path(temporary) / "1.0"
        baseline.mkdir()
        (baseline / "symbols.txt").write_text(THEN)
        (baseline / "now.txt").write_text(now)
        found = gate.check_nodes(baseline, baseline / "now.txt")
    seen = any(word in line for line in found) if word else not found
    return None if seen else f"{what}: {found or 'not seen'}"


def written_nodes():
    """generate.py keeps old nodes, gives new functions the new one, and ld takes what it writes."""
    node_of = gate.generate.nodes(["wlkA", "wlkNew"], THEN, (1, 1))
    if node_of != {"wlkA": "WELKIN_1.0", "wlkNew": "WELKIN_1.1"}:
        return f"nodes of a minor version: {node_of}"
    if gate.generate.nodes(["wlkA"], THEN, (2, 0)) != {"wlkA": "WELKIN_2.0"}:
        return "a major version keeps nodes of the last"
    text = "int wlkA(void) { return 1; }\nint wlkNew(void) { return 2; }\n"
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "toy.c").write_text(text)
        (folder / "toy.map").write_text(gate.generate.version_script(node_of))
        subprocess.run(["gcc", "-w", "-shared", "-fPIC", folder / "toy.c", "-o", folder / "toy.so",
                        f"-Wl,--version-script={folder / 'toy.map'}"], check=True)
        found = list(exports.findings(folder / "toy.so",
                                      {"wlkA@@WELKIN_1.0", "wlkNew@@WELKIN_1.1"}))
    return f"the version script: {found}" if found else None


def every_baseline():
    """What 1.1 added is held fast in 1.2, though 1.0 knows nothing of it; other majors are not."""
    grown = TOY.replace("uint32_t last;\n", "uint32_t last;\n  float a;\n  float b;\n")
    exchanged = grown.replace("  float a;\n  float b;\n", "  float b;\n  float a;\n")
    with tempfile.TemporaryDirectory() as temporary:
        root = pathlib.Path(temporary)
        for version, text in (("1.0", TOY), ("1.1", grown), ("0.9", ""), ("1.10", grown)):
            write_headers(root / version, text)
            (root / version / "symbols.txt").write_text("")
        (root / "symbols.txt").write_text("")
        names = [folder.name for folder in gate.baselines(root, 1)]
        good = gate.all_breaks(root, 1, write_headers(root / "good", grown), None,
                               root / "symbols.txt")
        bad = gate.all_breaks(root, 1, write_headers(root / "bad", exchanged), None,
                              root / "symbols.txt")
    if names != ["1.0", "1.1", "1.10"]:
        return f"baselines of version 1 are {names}"
    if good:
        return f"1.1 breaks itself: {good}"
    return None if {"1.1 layout", "1.10 layout"} <= set(bad) and "1.0 layout" not in bad else \
        f"a field of 1.1 was moved: {sorted(bad)}"


def main():
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        try:
            wrong = [*pool.map(verdict, HARMLESS + BREAKS),
                     *pool.map(library_verdict, LIBRARIES),
                     *pool.map(defaults_verdict, DEFAULTS), *pool.map(nodes_verdict, NODES),
                     *pool.map(client_verdict, CLIENTS),
                     written_nodes(), every_baseline()]
        except gate.Missing as error:
            sys.exit(str(error))
    wrong = [line for line in wrong if line]
    cases = [BREAKS, LIBRARIES, DEFAULTS, NODES, CLIENTS]
    print("\n".join(wrong) if wrong else
          f"{sum(map(len, cases)) - 5} breaks seen, {len(HARMLESS) + 7} changes passed")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
