#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the rules of docs/contributing.md; prints `file:line: rule: what`, exits 1 on a finding.

lint.py                 the text rules: who includes whom, literals, equations, line shape
lint.py --format        and clang-format on every C and C++ file
lint.py --tidy BUILD    and clang-tidy on src/ by BUILD/compile_commands.json; with --tidy-all also
                        on samples/ and tests/ (about 6 s of CPU per file, too slow for every run);
                        with --since REVISION only on the .cpp files that differ from it
lint.py --root TREE     another tree (the self-test's)
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # nothing is written to the source tree
import layers
import literals
import tidy

WARN_LINES, MAX_LINES, MAX_COLUMNS = 400, 500, 100
SKIPPED = {".git", "build", "out", "__pycache__"}
SHADERS = {".glsl", ".comp", ".vert", ".frag", ".inl"}
CPP = {".c", ".h", ".cpp", ".hpp"}
SOURCES = SHADERS | CPP | {".py", ".cmake", ".sh", ".supp"}
TEXT = SOURCES | {".md", ".json", ".txt", ".map", ".csv"}
# A path that only one machine has. Written as a group so that this line does not match itself.
MACHINE_PATH = re.compile(r"(?<![\w.$}])/(?:work|home|root|Users|tmp)/")
OPEN_WORK = re.compile(r"\b(?:TO" + "DO|FIX" + "ME|XX" + "X)\\b")
EQUATION = re.compile(r"\[([A-Z]\d\d)\],? Eqs?\. (\d+(?:(?:-|, | and )\d+)*)")


class Lint:
    def __init__(self, root):
        self.root = root
        self.findings, self.warnings = [], []

    def report(self, path, line, rule, what):
        self.findings.append(f"{path.relative_to(self.root)}:{line}: {rule}: {what}")

    def files(self):
        for folder, folders, names in os.walk(self.root):
            folders[:] = sorted(set(folders) - SKIPPED)
            for name in sorted(names):
                path = pathlib.Path(folder) / name
                if path.suffix in TEXT or is_source(path):
                    yield path

    def run_text_rules(self):
        self.equations = equation_rows(self.root)
        for path in self.files():
            text = path.read_text(encoding="utf-8", errors="replace")
            lines = text.split("\n")
            relative = path.relative_to(self.root).as_posix()
            self.shape(path, lines)
            if is_source(path):
                self.head_and_length(path, lines)
            if path.suffix in SHADERS | CPP:
                for line, what in layers.findings(self.root, relative, text):
                    self.report(path, line, "layer", what)
                self.cited(path, lines)
            if path.suffix in SHADERS:
                self.loops(path, text)
            if relative.startswith("shaders/model/"):
                for line, what in literals.findings(text):
                    self.report(path, line, "literal", what)

    def shape(self, path, lines):
        for number, line in enumerate(lines, 1):
            if "\t" in line:
                self.report(path, number, "tab", "use spaces")
            # Prose and tables of documents, and JSON values, may be long.
            if len(line) > MAX_COLUMNS and path.suffix not in {".md", ".json", ".csv", ".txt"}:
                self.report(path, number, "columns", f"{len(line)} > {MAX_COLUMNS}")
            if MACHINE_PATH.search(line):
                self.report(path, number, "path", "absolute path of one machine")
            if is_source(path) and OPEN_WORK.search(line):
                self.report(path, number, "open-work", "finish it or say why it stays")

    def head_and_length(self, path, lines):
        first = lines[1] if lines[0].startswith("#!") and len(lines) > 1 else lines[0]
        if "SPDX-License-Identifier: MIT" not in first:
            self.report(path, 1, "spdx", "the first line is the SPDX line")
        count = len(lines) - (lines[-1] == "")
        if count > MAX_LINES:
            self.report(path, count, "length", f"{count} lines > {MAX_LINES}")
        elif count > WARN_LINES and not layers.long_by_nature(path.relative_to(self.root)):
            self.warnings.append(f"{path.relative_to(self.root)}: {count} lines, split soon")

    def cited(self, path, lines):
        for number, line in enumerate(lines, 1):
            for key in cited_keys(line):
                if key not in self.equations:
                    self.report(path, number, "equation", f"{key} has no row in docs/equations.md")

    def loops(self, path, text):
        # lavapipe computes what such a loop leaves once more for lanes that have ended.
        for end in re.finditer(r"\} while \(", text):
            count = re.match(r"(\w+) (?:<|<=|>|>=) \w+\);", text[end.end():])
            if not count or not re.search(rf"\bu?int {count[1]}\b", text):
                line = text.count("\n", 0, end.start()) + 1
                self.report(path, line, "loop", "test in front where lanes may end apart")

    def run_format(self):
        files = [str(p) for p in self.files() if p.suffix in CPP]
        result = subprocess.run(["clang-format", "--dry-run", "-Werror", *files],
                                capture_output=True, text=True, check=False)
        # One finding per file: tools/format mends them all.
        for name in sorted(set(re.findall(r"^(\S+):\d+:\d+: error:", result.stderr, re.M))):
            self.report(pathlib.Path(name), 1, "format", "run tools/format")

    def run_tidy(self, build, folders):
        for line in tidy.findings(self.root, build, folders):
            self.findings.append(line.replace(str(self.root) + "/", ""))


def is_source(path):
    """Files that carry an SPDX line: known suffixes, and scripts without one."""
    if path.suffix in SOURCES or path.name == "CMakeLists.txt":
        return True
    return path.suffix == "" and path.parent.name in {"tools", ".ci"}


def cited_keys(line):
    """"[R04] Eq. 3-5 and 7" gives [R04] 3, 4, 5, 7."""
    for source, numbers in EQUATION.findall(line):
        for part in re.split(r", | and ", numbers):
            first, _, last = part.partition("-")
            for number in range(int(first), int(last or first) + 1):
                yield f"[{source}] Eq. {number}"


def equation_rows(root):
    """Keys of the tables' first column."""
    path = root / "docs" / "equations.md"
    if not path.exists():
        return set()
    rows = re.findall(r"^\| *(\[[A-Z]\d\d\][^|]*)\|", path.read_text(encoding="utf-8"), re.M)
    return {key for row in rows for key in cited_keys(row)}


def changed(root, revision, folders):
    """Source files below the folders that differ from the revision, as committed or not."""
    names = subprocess.run(["git", "-C", str(root), "diff", "--name-only", revision],
                           capture_output=True, text=True, check=True).stdout.split()
    return tuple(name for name in names if name.startswith(folders) and name.endswith(".cpp"))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--format", action="store_true")
    parser.add_argument("--tidy", type=pathlib.Path, metavar="BUILD")
    parser.add_argument("--tidy-all", action="store_true")
    parser.add_argument("--since", metavar="REVISION")
    arguments = parser.parse_args()
    lint = Lint(arguments.root.resolve())
    lint.run_text_rules()
    if arguments.format:
        lint.run_format()
    if arguments.tidy:
        folders = ("src/", "samples/", "tests/") if arguments.tidy_all else ("src/",)
        if arguments.since:
            folders = changed(lint.root, arguments.since, folders)
        lint.run_tidy(arguments.tidy.resolve(), folders)
    for line in lint.warnings:
        print("warning:", line)
    for line in lint.findings:
        print(line)
    print(f"lint: {len(lint.findings)} finding(s)")
    return 1 if lint.findings else 0


if __name__ == "__main__":
    sys.exit(main())
