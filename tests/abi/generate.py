#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes symbols.txt, fixed.txt, layout_test.c and src/welkin.map from the public headers; --check
compares. Both require that c_consumer.c, which becomes the baseline's old program, calls every
function.

Run it after an intended change of the API; the diff of these files is then the ABI change to
review. The offsets come from the compiler, so x86-64 Linux with gcc is needed.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
INCLUDE = HERE.parent.parent / "include"
HEADERS = ("core.h", "scene.h", "surface.h", "view.h", "output.h", "statistics.h", "query.h",
           "welkin_vulkan.h")
MAP = HERE.parent.parent / "src" / "welkin.map"

BANNER = """/* SPDX-License-Identifier: MIT
 *
 * Layout of the C API on x86-64: compiling this file is the test. Written by generate.py; a
 * difference here is an ABI break unless a structure only grew at its end.
 */
/* clang-format off */
#include <stddef.h>
#include <welkin/welkin_vulkan.h>

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), "size of " #type)
#define AT(type, field, offset) _Static_assert(offsetof(type, field) == (offset), #type "::" #field)
#define STARTS(type) (offsetof(type, sType) == 0 && offsetof(type, structSize) == 4)
#define HEAD(type) _Static_assert(STARTS(type) && offsetof(type, next) == 8, "head of " #type)
#define VALUE(name, value) _Static_assert((long long)(name) == (value), #name)
"""


def version(include=INCLUDE):
    """(major, minor) of the headers."""
    text = (include / "welkin" / "core.h").read_text()
    return tuple(int(re.search(rf"#define WLK_VERSION_{part} (\d+)", text)[1])
                 for part in ("MAJOR", "MINOR"))


def node_order(node):
    return tuple(int(number) for number in node.removeprefix("WELKIN_").split("."))


def nodes(names, listed, now):
    """{function: version node}. A function keeps the node of the minor version that brought it: a
    program that uses it must not start with an older library. New ones get that of `now`."""
    known = dict(line.split("@@") for line in listed.split())
    fresh = "WELKIN_%d.%d" % now
    return {name: known[name] if name in known and node_order(known[name])[0] == now[0] else fresh
            for name in sorted(names)}


def version_script(node_of):
    """Every function by its name, so that none gets into a node by a pattern."""
    text, before = "", ""
    for node in sorted(set(node_of.values()), key=node_order):
        names = "".join(f"    {name};\n" for name in node_of if node_of[name] == node)
        rest = "" if before else "  local: *;\n"
        text += f"{node} {{\n  global:\n{names}{rest}}}{before};\n"
        before = f" {node}"
    return text


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)


def functions(text):
    return re.findall(r"WLK_API\b[^;{]*?\b(wlk\w+)\s*\(", text)


def not_called(names, program):
    """Those that the C text does not call: a comment or a name without parentheses is no call."""
    called = set(re.findall(r"\b(wlk\w+)\s*\(", without_comments(program)))
    return sorted(set(names) - called)


def enumerators(text):
    for body in re.findall(r"\benum\b\s*\w*\s*\{([^}]*)\}", text):
        yield from re.findall(r"\b(WLK_\w+)\b\s*=", body)


def macros(text):
    return re.findall(r"#define (WLK_\w+) +\d+u?\b", text)


def structs(text):
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, flags=re.S):
        fields = []
        for declaration in body.split(";"):
            pointer = re.search(r"\(\*(\w+)\)\s*\(", declaration)
            plain = re.search(r"(\w+)\s*(?:\[[^\]]*\]\s*)*$", declaration.strip())
            if pointer or plain:
                fields.append((pointer or plain).group(1))
        yield name, fields


def growing(text):
    """Structures whose size the caller tells: in themselves, or as the stride of an array."""
    for name, fields in structs(text):
        if fields[:2] == ["sType", "structSize"]:
            yield name
    for _, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, flags=re.S):
        if re.search(r"\w*[sS]tride;", body):
            yield from re.findall(r"const (Wlk\w+)\s*\*\s*\w+;", body)
    yield from re.findall(r"uint32_t stride,\s*(?:const )?(Wlk\w+)\*", text)


def fixed(text):
    """Structures that can never grow, one a line, and why: a caller's array or structure around
    them has their old size."""
    bodies = dict(re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, flags=re.S))
    grows = set(growing(text))
    for name, _ in structs(text):
        if name not in grows:
            yield f"{name}: has no structSize\n"
        for outer, body in bodies.items():
            if re.search(rf"\b{name}\s+\w+\s*(?:\[|;)", body):
                yield f"{name}: part of {outer}\n"


def joined(text):
    """Values side by side where they fit into a line."""
    lines = []
    for line in text.splitlines():
        if lines and line.startswith("VALUE") and lines[-1].startswith("VALUE") and \
                len(lines[-1]) + 1 + len(line) <= 100:
            lines[-1] += " " + line
        else:
            lines.append(line)
    return "\n".join(lines) + "\n"


def layout(text, include=INCLUDE):
    """Asserts, with the numbers that a small C program prints."""
    lines = ['#include <stddef.h>', '#include <stdio.h>', '#include <welkin/welkin_vulkan.h>',
             'int main(void) {']
    for name, fields in structs(text):
        lines.append(f'printf("\\nSIZE({name}, %zu);\\n", sizeof({name}));')
        if fields[:3] == ["sType", "structSize", "next"]:
            lines[-1] = f'printf("\\nSIZE({name}, %zu); HEAD({name});\\n", sizeof({name}));'
            fields = fields[3:]
        for field in fields:
            lines.append(f'printf("AT({name}, {field}, %zu);\\n", offsetof({name}, {field}));')
    lines.append('puts("");')
    for name in [*enumerators(text), *macros(text)]:
        lines.append(f'printf("VALUE({name}, %lld);\\n", (long long)({name}));')
    lines.append('return 0; }')
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "print.c"
        source.write_text("\n".join(lines))
        program = pathlib.Path(folder) / "print"
        subprocess.run(["gcc", "-std=c11", f"-I{include}", source, "-o", program], check=True)
        return joined(subprocess.run([program], check=True, capture_output=True, text=True).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing, fail on a difference")
    check = parser.parse_args().check
    text = without_comments("".join((INCLUDE / "welkin" / h).read_text() for h in HEADERS))
    symbols = HERE / "symbols.txt"
    listed = symbols.read_text() if symbols.exists() else ""
    node_of = nodes(functions(text), listed, version())
    outputs = {symbols: "".join(f"{name}@@{node}\n" for name, node in node_of.items()),
               MAP: version_script(node_of), HERE / "fixed.txt": "".join(fixed(text)),
               HERE / "layout_test.c": BANNER + layout(text)}
    failed = 0
    for path, content in outputs.items():
        if not check:
            path.write_text(content)
        elif not path.exists() or path.read_text() != content:
            print(f"{path.name} does not describe the headers: if the change of the API is "
                  "intended, run tests/abi/generate.py and review the difference")
            failed = 1
    for name in not_called(node_of, (HERE / "c_consumer.c").read_text()):
        print(f"c_consumer.c does not call {name}")
        failed = 1
    return failed


if __name__ == "__main__":
    sys.exit(main())
