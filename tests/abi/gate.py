#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does the API keep the ABI of every version in tests/abi/baseline? Prints what does not, exits 1.

gate.py LIBRARY           the tree's headers and libwelkin.so against all baselines of its major
                          version, baseline/MAJOR.MINOR: each stays as long as that lives
gate.py --freeze LIBRARY  writes that of the tree's version: once, when it is released. Until then
                          that is how an intended break is taken in. Those of other major versions
                          go.

Six checks, because each is blind somewhere:
- layout: offsets, values of enumerators and macros, as the baseline's compiler saw them (does not
  see types);
- abidiff, and abi-compliance-checker: types and signatures (see neither macros nor enumerators
  without a type);
- client: the baseline's C program, with the baseline's headers, run with the new library, which
  must also know the sizes that structures had and write no more than them;
- defaults: what wlkInitStruct writes into the fields of that time;
- nodes: functions keep the version node of the minor version that brought them, and none is added
  to the node of a frozen one.
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
    """Of the headers that this version has."""
    files = [include / "welkin" / name for name in generate.HEADERS]
    return generate.without_comments("".join(file.read_text() for file in files if file.exists()))


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


def struct_type(name):
    return "WLK_STRUCT" + re.sub(r"([A-Z])", r"_\1", name.removeprefix("Wlk")).upper()


def with_heads(include):
    return [(name, fields) for name, fields in generate.structs(text_of(include))
            if fields[:2] == ["sType", "structSize"]]


SIZES = """
#include <stdio.h>
#include <string.h>
#include <welkin/welkin_vulkan.h>
static double room[8192];
static int bad(const char* name, unsigned type, unsigned size) {
  const unsigned char* byte = (const unsigned char*)room;
  const char* what = NULL;
  size_t i;
  memset(room, 0xee, sizeof room);
  if (wlkInitStruct(type, size, room) != WLK_SUCCESS) what = "refused";
  for (i = size; i < sizeof room; ++i) if (byte[i] != 0xee) what = "overrun";
  if (what != NULL) fprintf(stderr, "%s of %u bytes is %s\\n", name, size, what);
  return what != NULL;
}
int main(void) {
  int failures = 0;
"""


def sizes_program(include):
    """A C program: does the library still fill structures of the baseline's sizes, and not a byte
    behind them?"""
    lines = [f'failures += bad("{name}", {struct_type(name)}, sizeof({name}));'
             for name, _ in with_heads(include)]
    return "\n".join([SIZES, *lines, "return failures != 0; }"])


PRINTERS = """
static void bytes(const char* name, const void* p, unsigned size) {
  const unsigned char* byte = p;
  unsigned last = size, i;
  while (last > 0 && byte[last - 1] == 0) --last;
  printf("%s: %u bytes,", name, size);
  for (i = 0; i < last; ++i) printf(" %02x", byte[i]);
  puts(last == 0 ? " all 0" : "");
}
#define NUMBERS(kind, type, format) \\
  static void kind(const char* name, const void* p, unsigned size) { \\
    unsigned i; \\
    printf("%s", name); \\
    for (i = 0; i < size / sizeof(type); ++i) printf(" " format, ((const type*)p)[i]); \\
    puts(""); \\
  }
NUMBERS(float_, float, "%.9g")
NUMBERS(double_, double, "%.17g")
NUMBERS(uint32_t_, uint32_t, "%u")
NUMBERS(uint64_t_, unsigned long, "%lu")
"""


def defaults_program(include):
    """A C program: every field that wlkInitStruct fills, with its value; bytes where it is no
    number."""
    bodies = dict(re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text_of(include), flags=re.S))
    lines = ["#include <stdio.h>", "#include <string.h>", "#include <welkin/welkin_vulkan.h>",
             PRINTERS, "int main(void) {"]
    for name, fields in with_heads(include):
        lines.append(f"{{ {name} s; memset(&s, 0xee, sizeof s);"
                     f" wlkInitStruct({struct_type(name)}, sizeof s, &s);")
        for field in fields:
            number = re.search(rf"\b(float|double|uint32_t|uint64_t)\s+{field}\s*[;\[]",
                               bodies[name])
            printer = f"{number[1]}_" if number else "bytes"
            lines.append(f'{printer}("{name}::{field}", &s.{field}, sizeof s.{field});')
        lines.append("}")
    return "\n".join([*lines, "return 0; }"])


def defaults(include, library, folder):
    """What the library writes into the structures of these headers, a field a line."""
    source, program = folder / "defaults.c", folder / "defaults"
    source.write_text(defaults_program(include))
    built = run("gcc", "-std=c99", "-w", f"-I{include}", source, library,
                f"-Wl,-rpath,{pathlib.Path(library).resolve().parent}", "-o", program)
    return (built.stderr if built.returncode else run(program).stdout).splitlines()


def check_defaults(baseline, library, folder):
    frozen = (baseline / "defaults.txt").read_text().splitlines()
    now = defaults(baseline, library, folder)
    found = [f"was {line}" for line in frozen if line not in now]
    return found + [f"is {line}" for line in now if line not in frozen]


def check_nodes(baseline, symbols):
    """Of the lists symbols.txt of then and now."""
    then, now = (set(file.read_text().split()) for file in (baseline / "symbols.txt", symbols))
    frozen = generate.node_order(baseline.name)
    late = [line for line in now - then if generate.node_order(line.split("@@")[1]) <= frozen]
    return [f"{line} is gone" for line in sorted(then - now)] + \
        [f"{line} was added to a frozen node" for line in sorted(late)]


def check_client(baseline, library, folder):
    """An old program: the baseline's consumer, and its structures' sizes."""
    (folder / "sizes.c").write_text(sizes_program(baseline))
    found = []
    for source in (baseline / "client.c", folder / "sizes.c"):
        program = folder / source.stem
        built = run("gcc", "-std=c99", "-w", f"-I{baseline}", source, library,
                    f"-Wl,-rpath,{pathlib.Path(library).resolve().parent}", "-lm", "-o", program)
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


def baselines(root, major):
    """The frozen versions of this major version, the oldest first."""
    return sorted(root.glob(f"{major}.*"), key=lambda folder: generate.node_order(folder.name))


def all_breaks(root, major, include, library, symbols):
    """{"MAJOR.MINOR check": findings} of headers and library against every baseline."""
    found = {}
    for baseline in baselines(root, major):
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            checks = breaks(baseline, include, folder)
            if library:
                checks["client"] = check_client(baseline, library, folder)
                checks["defaults"] = check_defaults(baseline, library, folder)
            checks["nodes"] = check_nodes(baseline, symbols)
        found |= {f"{baseline.name} {check}": lines for check, lines in checks.items() if lines}
    return found


def freeze(library):
    major, minor = generate.version()
    for other in BASELINE.iterdir() if BASELINE.exists() else ():
        if not other.name.startswith(f"{major}."):
            shutil.rmtree(other) if other.is_dir() else other.unlink()
    target = BASELINE / f"{major}.{minor}"
    shutil.rmtree(target, ignore_errors=True)
    (target / "welkin").mkdir(parents=True)
    for header in sorted((INCLUDE / "welkin").glob("*.h")):
        shutil.copy(header, target / "welkin" / header.name)
    shutil.copy(HERE / "c_consumer.c", target / "client.c")
    shutil.copy(HERE / "symbols.txt", target / "symbols.txt")
    with tempfile.TemporaryDirectory() as temporary:
        lines = defaults(target, library, pathlib.Path(temporary))
    (target / "defaults.txt").write_text("\n".join(lines) + "\n")


def main():
    if sys.argv[1] == "--freeze":
        freeze(sys.argv[2])
        return 0
    library, = sys.argv[1:]
    major, minor = generate.version()
    if not baselines(BASELINE, major):
        sys.exit(f"no baseline of version {major}")
    try:
        found = all_breaks(BASELINE, major, INCLUDE, library, HERE / "symbols.txt")
    except Missing as error:
        sys.exit(str(error))
    for check, lines in found.items():
        print("\n".join(f"{check}: {line}" for line in lines))
    print("the ABI of a baseline is broken; if that is intended, and the tree's version "
          f"{major}.{minor} is not released: gate.py --freeze" if found else
          "the ABI of the baselines holds")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
