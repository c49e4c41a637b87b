#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plants one violation of each rule in a temporary tree and requires lint.py to find exactly it."""
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is written to the source tree
import lint

HERE = pathlib.Path(__file__).resolve().parent
SPDX = "// SPDX-License-Identifier: MIT\n"

# A tree that keeps the rules; every case below adds or replaces one file.
CLEAN = {
    "include/welkin/welkin.h": SPDX + "#include <stdint.h>\n",
    "include/welkin/welkin_vulkan.h":
        SPDX + '#include "welkin.h"\n#include <vulkan/vulkan_core.h>\n',
    "shaders/model/model.glsl": SPDX + '#include "numeric.glsl"\n',
    "shaders/model/numeric.glsl": SPDX + "const real A = real(-0.1) * real(0.75f) + 1.5e3f;\n",
    "shaders/interface/frame.glsl": SPDX,
    "shaders/pass/ray.glsl": SPDX + '#include "model/model.glsl"\n',
    "shaders/pass/a.comp": SPDX + '#include "ray.glsl"\n#include "interface/frame.glsl"\n',
    "src/failure.hpp": SPDX + "#include <welkin/welkin.h>\n",
    "src/model/model.hpp": SPDX + '#include <glm/glm.hpp>\n#include "model/model.glsl"\n',
    "src/particles/medium.hpp": SPDX + '#include "model/model.hpp"\n',
    "src/tables/table.hpp": SPDX + '#include "particles/medium.hpp"\n',
    "src/frame/plan.hpp": SPDX + '#include <welkin/welkin.h>\n#include "interface/frame.glsl"\n',
    "src/frame/record.hpp": SPDX + '#include "frame/plan.hpp"\n#include "vk/device.hpp"\n',
    "src/vk/device.hpp": SPDX + "#include <vulkan/vulkan_core.h>\n#include <a_comp_spv.h>\n",
    "src/api/api.hpp": SPDX + '#include "frame/record.hpp"\n#include "tables/table.hpp"\n',
    "tests/reference/quad.hpp": SPDX + "#include <cmath>\n// [R04] Eq. 1, [R04] Eq. 3-5 and 7\n",
    "tests/unit/a.cpp": SPDX + '#include "model/model.hpp"\n#include "reference/quad.hpp"\n',
    "tests/abi/a.c": SPDX + "#include <welkin/welkin_vulkan.h>\n",
    "samples/common/b.hpp": SPDX + "#include <welkin/welkin.h>\n#include <OpenEXR/ImfRgba.h>\n",
    "docs/equations.md": "| key |\n| [R04] Eq. 1 |\n| [R04] Eq. 3-5, 7 | x |\n",
    "tools/run": "#!/usr/bin/env bash\n# SPDX-License-Identifier: MIT\n",
}


def include(name):
    return f'{SPDX}#include "{name}"\n'


# (rule, file, its text)
PLANTED = [
    ("layer", "include/welkin/welkin.h", SPDX + "#include <vulkan/vulkan_core.h>\n"),
    ("layer", "include/welkin/welkin.h", include("model/model.hpp")),
    ("layer", "shaders/model/numeric.glsl", include("model.glsl")),
    ("layer", "shaders/interface/frame.glsl", include("../model/numeric.glsl")),
    ("layer", "shaders/pass/b.comp", include("a.comp")),
    ("layer", "src/failure.hpp", include("vk/device.hpp")),
    ("layer", "src/model/model.hpp", SPDX + "#include <welkin/welkin.h>\n"),
    ("layer", "src/particles/medium.hpp", include("tables/table.hpp")),
    ("layer", "src/tables/table.hpp", include("vk/device.hpp")),
    ("layer", "src/tables/table.hpp", SPDX + "#include <vulkan/vulkan.h>\n"),
    ("layer", "src/frame/plan.hpp", include("tables/table.hpp")),
    ("layer", "src/frame/plan.hpp", SPDX + "#include <vulkan/vulkan_core.h>\n"),
    ("layer", "src/frame/record.hpp", include("api/api.hpp")),
    ("layer", "src/vk/device.hpp", include("model/model.hpp")),
    ("layer", "src/vk/device.hpp", include("frame/plan.hpp")),
    ("layer", "src/api/api.hpp", SPDX + "#include <openvdb/openvdb.h>\n"),
    ("layer", "tests/reference/quad.hpp", include("model/model.hpp")),
    ("layer", "tests/reference/quad.hpp", SPDX + "#include <glm/glm.hpp>\n"),
    ("layer", "tests/abi/a.c", include("failure.hpp")),
    ("layer", "tests/unit/a.cpp", include("common/b.hpp")),
    ("layer", "samples/common/b.hpp", include("vk/device.hpp")),
    ("literal", "shaders/model/numeric.glsl", SPDX + "real a() { return 0.75; }\n"),
    ("literal", "shaders/model/numeric.glsl", SPDX + "real a() { return real(0.1f); }\n"),
    ("literal", "shaders/model/numeric.glsl", SPDX + "real a() { return real(2.0 * b); }\n"),
    ("literal", "shaders/model/numeric.glsl", SPDX + "real a() { return real(1e-5f); }\n"),
    ("loop", "shaders/pass/a.comp", SPDX + "float t;\ndo {\n} while (t < end);\n"),
    ("loop", "shaders/pass/a.comp", SPDX + "int i;\ndo {\n} while (i < 4 && t < end);\n"),
    ("equation", "src/vk/device.hpp", SPDX + "// as in [R04] Eq. 2\n"),
    ("equation", "src/vk/device.hpp", SPDX + "// as in [J23] Eq. 1\n"),
    ("equation", "src/vk/device.hpp", SPDX + "// as in [R04] Eq. 3-6\n"),
    ("spdx", "src/vk/device.hpp", "#pragma once\n"),
    ("spdx", "tools/run", "#!/usr/bin/env bash\necho\n"),
    ("spdx", "shaders/pass/a.comp", "\n" + SPDX),
    ("length", "src/vk/device.hpp", SPDX + "\n" * 500),
    ("columns", "src/vk/device.hpp", SPDX + "//" + "-" * 99 + "\n"),
    ("tab", "src/vk/device.hpp", SPDX + "\tint a;\n"),
    ("path", "docs/guide.md", "see /ho" + "me/me/file\n"),
    ("path", "tools/run", "#!/bin/sh\n# SPDX-License-Identifier: MIT\ncat /t" + "mp/x\n"),
    ("open-work", "src/vk/device.hpp", SPDX + "// TO" + "DO later\n"),
]


def findings(files, with_format=False):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        for name, text in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        run = lint.Lint(root)
        run.run_text_rules()
        if with_format:
            run.run_format()
        return run.findings


def exit_status(files):
    """Of the program itself, which the build sees."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            (pathlib.Path(folder) / name).write_text(text)
        command = [sys.executable, str(HERE / "lint.py"), "--root", folder]
        return subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode


def main():
    failures = 0

    def expect(condition, what, lines):
        nonlocal failures
        if not condition:
            print(what, *lines, sep="\n  ")
            failures += 1

    lines = findings(CLEAN)
    expect(not lines, "the clean tree is not clean:", lines)
    for rule, name, text in PLANTED:
        lines = findings({**CLEAN, name: text})
        found = len(lines) == 1 and lines[0].startswith(name + ":") and f": {rule}: " in lines[0]
        expect(found, f"{name}: exactly one {rule} finding expected:", lines)
    lines = findings({"a.hpp": SPDX + "int  a ;\n"}, with_format=True)
    expect(lines == ["a.hpp:1: format: run tools/format"], "misformatted file:", lines)
    expect(exit_status({"a.hpp": SPDX}) == 0, "exit status of a clean tree is not 0", [])
    expect(exit_status({"a.hpp": "int a;\n"}) == 1, "exit status of a finding is not 1", [])
    print(f"{len(PLANTED) + 4 - failures} cases passed, {failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
