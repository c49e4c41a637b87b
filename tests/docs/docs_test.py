#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the documents: docs_test.py SUITE SOURCE BUILD.

links      every link and picture of every page leads somewhere, also to the heading it names
code       what stands in ```c, glsl and python compiles or runs; the README's C host runs; nothing
           is in a language that no test reads (cmake: tests/package/documents.py)
commands   programs, options, presets and files of shell blocks exist
reference  Doxygen has no complaint, and every function and structure of the API has its text
tests      every test that docs/reliability.md names exists, no row of its tables lacks one, and its
           tables of sweeps and faults are those of docs/results
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

SUITE, SOURCE, BUILD = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
PAGES = sorted([*SOURCE.glob("*.md"), *SOURCE.glob("docs/*.md")])
BLOCK = re.compile(r"^```(\S*)\n(.*?)^```", re.S | re.M)
READ = {"", "c", "cmake", "glsl", "python", "sh", "bash"}
PROGRAMS = ("cmake", "printf", "welkin")

# Around a piece of C: what an engine has at hand there.
C_HEAD = """#include <stdio.h>
#include <string.h>
#include <welkin/welkin_vulkan.h>
typedef struct Cascade { float clipFromWorld[16]; } Cascade;
void piece(WlkContext context, WlkView view, VkCommandBuffer commands, const double* eye,
           const float* toSun, const float* toMoon, WlkCloudShadow map, WlkCloudShadowState state,
           WlkVulkanImage image, WlkVulkanImage shadowImage, WlkVulkanImage radiance,
           WlkVulkanImage transmittance, float (*rows)[4], WlkQuality quality, WlkCamera camera,
           const Cascade* cascade, WlkVulkanViewTargets targets);
void piece(WlkContext context, WlkView view, VkCommandBuffer commands, const double* eye,
           const float* toSun, const float* toMoon, WlkCloudShadow map, WlkCloudShadowState state,
           WlkVulkanImage image, WlkVulkanImage shadowImage, WlkVulkanImage radiance,
           WlkVulkanImage transmittance, float (*rows)[4], WlkQuality quality, WlkCamera camera,
           const Cascade* cascade, WlkVulkanViewTargets targets) {{
"""
GLSL_HEAD = """#version 460
layout(binding = 0) uniform sampler2D cloudShadow;
layout(binding = 1) uniform sampler3D aerialTransmittance;
layout(binding = 2) uniform sampler3D aerialRadiance;
layout(push_constant) uniform Constants {
  mat4x3 rows;
  vec3 position, color;
  vec2 uv;
  float range, distance, exponent, depth;
};
void main() {
"""

problems = []


def report(page, text):
    problems.append(f"{page.relative_to(SOURCE)}: {text}")


def blocks(*languages):
    for page in PAGES:
        for language, text in BLOCK.findall(page.read_text(encoding="utf-8")):
            if language in languages:
                yield page, text


def anchors(page):
    """Of a page's headings, as GitHub makes them."""
    text = BLOCK.sub("", page.read_text(encoding="utf-8"))
    found = set()
    for heading in re.findall(r"^#+ +(.+?) *$", text, re.M):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        name = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        number = 0
        while name + (f"-{number}" if number else "") in found:
            number += 1
        found.add(name + (f"-{number}" if number else ""))
    return found


def links():
    count = 0
    for page in PAGES:
        text = BLOCK.sub("", page.read_text(encoding="utf-8"))
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            if re.match(r"[a-z]+:", target):
                continue  # the web is not asked
            count += 1
            name, _, anchor = target.partition("#")
            other = page if not name else (page.parent / name)
            if not other.exists():
                report(page, f"{target}: no such file")
            elif anchor and other.suffix == ".md" and anchor not in anchors(other):
                report(page, f"{target}: no such heading")
    return count


def run(page, command, **more):
    result = subprocess.run(command, capture_output=True, text=True, check=False, **more)
    if result.returncode != 0:
        report(page, f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")


def code():
    count = 0
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for language in sorted({name for name, _ in BLOCK.findall(text)} - READ):
            report(page, f"no test reads ```{language}")
    include = ["-I", str(SOURCE / "include")]
    with tempfile.TemporaryDirectory() as folder:
        for page, text in blocks("c"):
            count += 1
            file = pathlib.Path(folder) / f"piece{count}.c"
            whole = "int main(" in text
            file.write_text(text if whole else C_HEAD + text + "}}\n", encoding="utf-8")
            warnings = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-Wno-unused-variable",
                        "-Wno-unused-parameter", "-Wno-unused-but-set-variable",
                        "-Wno-unused-but-set-parameter"]
            if not whole:
                run(page, ["cc", *warnings, *include, "-fsyntax-only", file])
                continue
            program = file.with_suffix("")
            library = ["-L", str(BUILD / "lib"), f"-Wl,-rpath,{BUILD / 'lib'}", "-lwelkin"]
            run(page, ["cc", *warnings, *include, file, "-o", program, *library])
            run(page, [program])
        for page, text in blocks("glsl"):
            count += 1
            file = pathlib.Path(folder) / f"piece{count}.frag"
            file.write_text(GLSL_HEAD + text + "}\n", encoding="utf-8")
            run(page, ["glslangValidator", "--quiet", "--target-env", "vulkan1.2", "-V", file,
                       "-o", os.devnull])
    for page, text in blocks("python"):
        count += 1
        where = {**os.environ, "PYTHONPATH": str(SOURCE / "samples" / "python"),
                 "PYTHONDONTWRITEBYTECODE": "1"}
        run(page, ["/usr/bin/python3", "-c", text], env=where)
    return count


def help_of(arguments):
    result = subprocess.run([BUILD / "bin" / "welkin", *arguments, "--help"], capture_output=True,
                            text=True, check=False)
    return result.stdout if result.returncode == 0 else ""


def check_command(page, words, presets):
    if words[0] == "welkin":
        text = help_of(words[1:2])
        if not text:
            report(page, f"welkin {words[1]}: no such command")
        for word in words[2:]:
            option = word.split("=")[0]
            if option.startswith("-") and not re.search(rf"(?:^|[\s,]){re.escape(option)}\b", text):
                report(page, f"welkin {words[1]} has no {option}")
    elif words[0] == "cmake":
        for before, word in zip(words, words[1:]):
            if before == "--preset" and f'"name": "{word}"' not in presets:
                report(page, f"no preset {word}")
    elif words[0].startswith("tools/") and not (SOURCE / words[0]).exists():
        report(page, f"no program {words[0]}")
    for word in words:
        if re.match(r"(samples|tests|docs/results|include|shaders)/", word):
            if not (SOURCE / word).exists():
                report(page, f"no file {word}")


def commands():
    count = 0
    presets = (SOURCE / "CMakePresets.json").read_text(encoding="utf-8")
    for page, text in blocks("", "sh", "bash"):
        lines = re.sub(r"\\\n", " ", text).splitlines()
        for line in lines:
            for part in line.split("#")[0].split("&&"):
                words = part.split()
                if words and (words[0] in PROGRAMS or words[0].startswith(("tools/", "build/"))):
                    count += 1
                    check_command(page, words, presets)
    return count


def text_of(node):
    return "".join(node.itertext()).strip() if node is not None else ""


def undocumented(folder):
    """Names of the API without a word about them, and how many there are in all."""
    count, bare = 0, []
    for file in pathlib.Path(folder).glob("xml/*.xml"):
        for compound in xml.etree.ElementTree.parse(file).getroot().iter("compounddef"):
            things = [(text_of(m.find("name")), m) for m in compound.iter("memberdef")
                      if m.get("kind") == "function"]
            if compound.get("kind") == "struct":
                things.append((text_of(compound.find("compoundname")), compound))
            for name, node in things:
                if re.match(r"(wlk|Wlk)\w+$", name):
                    count += 1
                    if not text_of(node.find("briefdescription")) and not text_of(
                            node.find("detaileddescription")):
                        bare.append(name)
    return count, sorted(set(bare))


def reference():
    page = SOURCE / "docs" / "Doxyfile"
    with tempfile.TemporaryDirectory() as folder:
        settings = page.read_text(encoding="utf-8")
        settings += f"\nOUTPUT_DIRECTORY = {folder}\nGENERATE_HTML = NO\nGENERATE_XML = YES\n"
        run(page, ["doxygen", "-"], input=settings, cwd=SOURCE)
        count, bare = undocumented(folder)
    for name in bare:
        report(page, f"{name} has no text")
    return count


def output_of(tool):
    return subprocess.run([SOURCE / "tools" / tool], capture_output=True, text=True,
                          check=True).stdout


def tests():
    page = SOURCE / "docs" / "reliability.md"
    known = set()
    for file in SOURCE.glob("tests/**/*.cpp"):
        text = file.read_text(encoding="utf-8")
        for suite, name in re.findall(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", text, re.M):
            known.update((f"{suite}.{name}", f"{suite}.*"))
    known.add("Docs.Tests")
    text = page.read_text(encoding="utf-8")
    named = re.findall(r"`([A-Z]\w*\.(?:[A-Z]\w*|\*))`", text)
    for name in sorted(set(named) - known):
        report(page, f"there is no test {name}")
    # Tables whose last column is "test": each row names one or says why there is none.
    for rows in re.findall(r"^\|.*\| test \|\n\|[-|]+\|\n((?:\|.*\n)+)", text, re.M):
        for row in rows.splitlines():
            last = row.rstrip(" |").rpartition(" | ")[2]
            if not re.search(r"`\*?[A-Z]\w*\.", last) and not last.startswith("none: "):
                report(page, f"no test and no reason in: {row}")
    if output_of("sweep_table") not in text:
        report(page, "its table of sweeps is not that of tools/sweep_table")
    *tables, leaks = output_of("fault_table").strip().split("\n\n")
    for table in tables:
        if f"\n\n{table}\n\n" not in text:
            report(page, f"its table of faults is not that of tools/fault_table:\n{table}")
    if leaks != "leaks: 0":
        report(page, f"results/faults.csv has {leaks}")
    return len(named)


checked = {"links": links, "code": code, "commands": commands, "reference": reference,
           "tests": tests}[SUITE]()
for problem in problems:
    print(problem)
print(f"{SUITE}: {checked} checked, {len(problems)} problem(s)")
sys.exit(1 if problems or checked == 0 else 0)
