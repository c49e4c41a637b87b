# SPDX-License-Identifier: MIT
"""Who may include whom: the table of docs/architecture.md as data, and the check of one file."""
import pathlib
import re

INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.M)

# Folders in which an include is looked up, after the file's own; the build's include paths.
SEARCH = ("include", "src", "shaders", "shaders/pass", "tests", "samples", "")

STANDARD = r"[a-z_0-9]+(\.h)?"  # <vector>, <stdint.h>; never a folder
GLM = r"glm/.*"
VULKAN = r"vulkan/vulkan(_core)?\.h"
SPIRV = r"(spv/)?\w+_spv\.h"
ANY = r".*"

# First match decides: (files, ours that it may include, others that it may include).
# Ours are repository paths; "generated" files exist in the build tree only and count as others.
RULES = [
    (r"include/welkin/core\.h", r"-", STANDARD),
    (r"include/welkin/(scene|surface|view|output|statistics|query|welkin)\.h",
     r"include/welkin/(core|scene|surface|view|output|statistics|query)\.h", STANDARD),
    (r"include/welkin/welkin_vulkan\.h", r"include/welkin/welkin\.h", VULKAN),
    (r"include/welkin/.*\.hpp", r"include/welkin/.*", STANDARD),
    (r"shaders/model/(model|sky/sky)\.glsl", r"shaders/model/.*", r"-"),
    (r"shaders/model/.*", r"-", r"-"),
    (r"shaders/interface/.*", r"-", r"-"),
    # Kernels include shared .glsl text, never another kernel.
    (r"shaders/pass/.*", r"shaders/(model|interface)/.*|shaders/pass/.*\.glsl", r"-"),
    (r"src/[^/]*\.hpp", r"src/[^/]*\.hpp|include/welkin/welkin\.h", STANDARD),
    (r"src/model/evaluate\..*",
     r"src/(model/.*|[^/]*\.hpp)|shaders/(model|interface)/.*|include/welkin/welkin\.h",
     rf"{STANDARD}|{GLM}"),
    (r"src/model/.*", r"src/model/.*|shaders/model/.*", rf"{STANDARD}|{GLM}"),
    (r"src/particles/.*", r"src/(model|particles)/.*", rf"{STANDARD}|{GLM}"),
    (r"src/tables/.*", r"src/(model|particles|tables)/.*", rf"{STANDARD}|{GLM}"),
    (r"src/surface/.*", r"src/(model|particles|tables|surface)/.*|src/[^/]*\.hpp|include/welkin/.*",
     rf"{STANDARD}|{GLM}"),
    # The plan is pure data: it may compute with the model, but sees no Vulkan and no tables.
    (r"src/frame/plan.*",
     r"src/(frame/plan.*|model/.*|[^/]*\.hpp)|include/welkin/welkin\.h|shaders/interface/.*",
     rf"{STANDARD}|{GLM}"),
    (r"src/frame/.*",
     r"src/(frame|surface|tables|particles|model|vk)/.*|src/[^/]*\.hpp|include/welkin/.*"
     r"|shaders/interface/.*",
     rf"{STANDARD}|{GLM}|{VULKAN}"),
    (r"src/vk/.*", r"src/vk/.*|src/[^/]*\.hpp|include/welkin/.*|shaders/interface/.*",
     rf"{STANDARD}|{VULKAN}|{SPIRV}"),
    (r"src/api/.*", r"src/.*|include/welkin/.*|shaders/interface/.*",
     rf"{STANDARD}|{GLM}|{VULKAN}"),
    (r"tests/reference/.*", r"tests/reference/.*", rf"{STANDARD}|gtest/gtest\.h"),
    # A frozen copy of the API; its client includes it as <welkin/...>, found in the tree's headers.
    (r"tests/abi/baseline/.*", r"(tests/abi/baseline/[\d.]+|include)/welkin/.*",
     rf"{STANDARD}|{VULKAN}"),
    (r"tests/abi/.*", r"include/welkin/.*", rf"{STANDARD}|{VULKAN}"),
    # The commands `reference` and `slab` draw with the tests' independent renderer and solver.
    (r"samples/cli/.*", r"include/welkin/.*|samples/.*|tests/reference/.*", ANY),
    (r"samples/.*", r"include/welkin/.*|samples/.*", ANY),
    # These drive the SDK through the sample host's scenes and images.
    (r"tests/(host|fuzz|image|bench|budget)/.*",
     r"(src|tests|include|shaders|samples/common)/.*", ANY),
    (r"tests/.*", r"(src|tests|include|shaders)/.*", ANY),
]


def long_by_nature(path):
    """The generated layout list grows with the API and frozen headers stay as they were: they get
    no warning before the limit."""
    return path.as_posix().startswith(("tests/abi/layout_test.c", "tests/abi/baseline/"))


def resolve(root, relative, name):
    """Repository path of an included file, or None if it is not ours."""
    folder = pathlib.PurePosixPath(relative).parent
    for base in (str(folder), *SEARCH):
        candidate = (root / base / name).resolve()
        if candidate.is_file() and candidate.is_relative_to(root):
            return candidate.relative_to(root).as_posix()
    return None


def findings(root, relative, text):
    """Yields (line, what) for each include that the layer of `relative` does not allow."""
    rule = next((r for r in RULES if re.fullmatch(r[0], relative)), None)
    if rule is None:
        return
    _, ours, others = rule
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start(1)) + 1
        target = resolve(root, relative, match.group(1))
        allowed = re.fullmatch(ours, target) if target else re.fullmatch(others, match.group(1))
        if not allowed:
            yield line, f"{relative} must not include {target or match.group(1)}"
