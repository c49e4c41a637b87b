#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does the API keep the ABI of tests/abi/baseline? Prints what does not and exits 1.

gate.py LIBRARY   the tree's headers and libwelkin.so against the baseline
gate.py --freeze  writes the baseline from the tree. Before 1.0 that is how an intended break is
                  taken in; from then on a baseline stays for as long as its major version lives.

Four checks, because each is blind somewhere:
- layout: offsets, values of enumerators and macros, as the baseline's compiler saw them (does not
  see types);
- abidiff, and abi-compliance-checker: types and signatures (see neither macros nor enumerators
  without a type);
- client: the baseline's C program, with the baseline's headers, run with the new library, which
  must also know the sizes that structures had.
The two tools compare libraries made from the headers alone, which hold every function's signature
and every structure; exports.py has compared the headers with the true library's symbols.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is written to the source tree
import generate

HERE = pathlib.Path(__file__).resolve().parent
INCLUDE = HERE.parent.parent / "include"
BASELINE = HERE / "baseline"
FUNCTION = re.compile(r"WLK_API\s+([^;{()]*?)\b(wlk\w+)\s*(\([^;{]*?\))\s*;")
# One type's part of abidiff's report, and the lines of one that only got fields beyond its old end.
CHANGED = re.compile(r"^'struct (\w+) at [^']*' changed:\n((?:  .*\n)*)", re.M)
GREW = re.compile(r"  type size changed from (\d+) to \d+ \(in bits\)\n"
                  r"  \d+ data member insertions?:\n"
                  r"((?:    '.*', at offset \d+ \(in bits\).*\n)+)")
# What a baseline must not hold fast: the version, and room for what is to come.
FREE = re.compile(r"WLK_VERSION_|reserved\d")


class Missing(Exception):
    pass


def run(*command, cwd=None):
    words = [str(word) for word in command]
    try:
        return subprocess.run(words, capture_output=True, text=True, cwd=cwd, check=False)
    except FileNotFoundError as error:
        raise Missing(f"{words[0]} is not installed: run tools/setup") from error


def text_of(include):
    return generate.without_comments(
        "".join((include / "welkin" / name).read_text() for name in generate.HEADERS))


def frozen_layout(include):
    """C asserts of the baseline that structures which only grew still pass."""
    text = text_of(include)
    asserts = generate.layout(text, include)
    grows = set(generate.growing(text))
    lines = []
    for statement in asserts.replace("; ", ";\n").splitlines():
        size = re.match(r"SIZE\((\w+), (\d+)\);", statement)
        if size and size[1] in grows:
            lines.append(f"_Static_assert(sizeof({size[1]}) >= {size[2]}, \"{size[1]} shrank\");")
        elif not FREE.search(statement):
            lines.append(statement)
    return generate.BANNER + "\n".join(lines) + "\n"


def headers_library(include, folder):
    """A library with every function of the headers, and one that takes each structure: those which
    are only chained stand in no signature. Returns its path, or the compiler's message."""
    folder.mkdir()
    text = text_of(include)
    lines = ["#include <welkin/welkin_vulkan.h>"]
    for result, name, parameters in FUNCTION.findall(text):
        value = "" if result.strip() == "void" else "return 0;"
        lines.append(f"{result}{name}{parameters} {{ {value} }}")
    for name, _ in generate.structs(text):
        lines.append(f"void wlkAbi{name}(const {name}* a) {{ (void)a; }}")
    source, library = folder / "headers.c", folder / "libwelkin.so"
    source.write_text("\n".join(lines) + "\n")
    compiled = run("gcc", "-std=c11", "-w", "-g", "-O0", "-shared", "-fPIC", f"-I{include}", source,
                   "-o", library)
    return library if compiled.returncode == 0 else compiled.stderr


def check_layout(old, new, folder):
    source = folder / "layout.c"
    source.write_text(frozen_layout(old))
    compiled = run("gcc", "-std=c11", "-fsyntax-only", f"-I{new}", source)
    return re.findall(r"error: (.*)", compiled.stderr) if compiled.returncode else []


def only_grew(match, may_grow):
    """True for a structure of a size that callers tell, which grew behind its old end: the library
    reads what both sides know. In the padding of the old end it would read what no old caller has
    set."""
    grew = GREW.fullmatch(match[2])
    return bool(grew) and match[1] in may_grow and all(
        int(offset) >= int(grew[1]) for offset in re.findall(r"at offset (\d+)", grew[2]))


def check_abidiff(old, new, may_grow):
    # Not by abidiff's own rules of suppression: "inserted at the end" also hides other changes of
    # the same structure, such as a field's type.
    compared = run("abidiff", "--no-added-syms", "--leaf-changes-only", old, new)
    if compared.returncode == 0:
        return []
    rest = CHANGED.sub(lambda match: "" if only_grew(match, may_grow) else match[0],
                       compared.stdout + "\n")
    lines = [line for line in rest.splitlines() if line.strip() and "summary:" not in line]
    if not CHANGED.search(compared.stdout + "\n") and not lines:
        return [f"exit status {compared.returncode}"]
    return lines


def check_abicc(old, new, folder):
    dumps = []
    for library, version in ((old, "old"), (new, "new")):
        dumps.append(folder / f"{version}.dump")
        dumped = run("abi-dumper", library, "-o", dumps[-1], "-lver", version)
        if dumped.returncode != 0:
            return (dumped.stdout + dumped.stderr).splitlines()
    compared = run("abi-compliance-checker", "-l", "welkin", "-old", dumps[0], "-new", dumps[1],
                   "-binary", "-report-path", folder / "report.html", cwd=folder)
    return compared.stdout.splitlines() if compared.returncode else []


def sizes_program():
    """A C program: does the library still fill structures of the baseline's sizes?"""
    lines = ["#include <stdio.h>", "#include <welkin/welkin_vulkan.h>", "static double room[8192];",
             "int main(void) {", "int failures = 0;"]
    for name, fields in generate.structs(text_of(BASELINE)):
        if fields[:2] == ["sType", "structSize"]:
            kind = "WLK_STRUCT" + re.sub(r"([A-Z])", r"_\1", name.removeprefix("Wlk")).upper()
            lines.append(f"if (wlkInitStruct({kind}, sizeof({name}), room) != WLK_SUCCESS) {{"
                         f' fprintf(stderr, "{name} of %zu bytes is refused\\n", sizeof({name}));'
                         " ++failures; }")
    return "\n".join([*lines, "return failures != 0; }"])


def check_client(library, folder):
    """An old program: the baseline's consumer, and its structures' sizes."""
    (folder / "sizes.c").write_text(sizes_program())
    found = []
    for source in (BASELINE / "client.c", folder / "sizes.c"):
        program = folder / source.stem
        built = run("gcc", "-std=c99", "-w", f"-I{BASELINE}", source, library,
                    f"-Wl,-rpath,{pathlib.Path(library).parent}", "-lm", "-o", program)
        ran = built if built.returncode else run(program)
        if ran.returncode:
            found += [f"{source.name}: {line}" for line in
                      [f"exit status {ran.returncode}", *ran.stderr.splitlines()]]
    return found


def breaks(old, new, folder):
    """{check: findings} of headers `new` against headers `old`."""
    libraries = [headers_library(include, folder / name)
                 for name, include in (("old", old), ("new", new))]
    for library in libraries:
        if isinstance(library, str):
            return {"headers": library.splitlines()}
    grows = set(generate.growing(text_of(old)))
    found = {"layout": check_layout(old, new, folder), "abidiff": check_abidiff(*libraries, grows),
             "abicc": check_abicc(*libraries, folder)}
    return {check: lines for check, lines in found.items() if lines}


def freeze():
    shutil.rmtree(BASELINE, ignore_errors=True)
    (BASELINE / "welkin").mkdir(parents=True)
    for header in sorted((INCLUDE / "welkin").glob("*.h")):
        shutil.copy(header, BASELINE / "welkin" / header.name)
    shutil.copy(HERE / "c_consumer.c", BASELINE / "client.c")


def main():
    if sys.argv[1:] == ["--freeze"]:
        freeze()
        return 0
    library, = sys.argv[1:]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        try:
            found = breaks(BASELINE, INCLUDE, folder)
            client = check_client(library, folder)
        except Missing as error:
            sys.exit(str(error))
    if client:
        found["client"] = client
    for check, lines in found.items():
        print("\n".join(f"{check}: {line}" for line in lines))
    print("the ABI of the baseline is broken; if that is intended, and before 1.0: gate.py --freeze"
          if found else "the ABI of the baseline holds")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
