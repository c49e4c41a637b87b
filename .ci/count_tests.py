#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Adds up ctest's JUnit files; the last line is `N passed, N failed[, N skipped]`.

An entry that runs several GoogleTest tests counts as these, by its output. A test that ctest could
not start ("not run" for any reason but its own skip) is a failed one, and so are a test that did
not end, an entry that fails beside its tests, and a file that is missing or holds no test at all.
"""
import argparse
import collections
import pathlib
import re
import sys
import xml.etree.ElementTree

# What ctest writes for a test that skipped itself (GTEST_SKIP, SKIP_RETURN_CODE).
SKIP_MESSAGES = ("SKIP_REGULAR_EXPRESSION_MATCHED", "SKIP_RETURN_CODE")
# GoogleTest's lines of one test; the summary's lines of failures have no time.
RUN = re.compile(r"^\[ RUN      \] (.+)$", re.M)
ENDED = re.compile(r"\[ *(OK|FAILED|SKIPPED) +\] ([^,\n]+).* \(\d+ ms\)$", re.M)
ANNOUNCED = re.compile(r"^\[=+\] Running (\d+) tests? from", re.M)
OUTCOMES = {"OK": "passed", "FAILED": "failed", "SKIPPED": "skipped"}


def outcomes(case):
    """(name, outcome) of the tests of an entry."""
    whole = outcome(case)
    output = case.findtext("system-out") or ""
    announced = ANNOUNCED.search(output)
    if whole == "skipped" or not announced or int(announced[1]) == 1:
        return [(case.get("name"), whole)]
    ended = {name.strip(): OUTCOMES[word] for word, name in ENDED.findall(output)}
    tests = [(name, ended.get(name, "failed")) for name in RUN.findall(output)]
    failed = any(result == "failed" for _, result in tests)
    if len(tests) != int(announced[1]) or (whole == "failed" and not failed):
        tests.append((case.get("name"), "failed"))
    return tests


def outcome(case):
    status = case.get("status")
    if status == "run":
        return "passed"
    skipped = case.find("skipped")
    if status == "disabled" or (skipped is not None and
                                skipped.get("message", "").startswith(SKIP_MESSAGES)):
        return "skipped"
    return "failed"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--broken", type=int, default=0, help="builds that failed")
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    total = collections.Counter(failed=arguments.broken)
    for path in arguments.files:
        cases = list(xml.etree.ElementTree.parse(path).iter("testcase")) if path.exists() else []
        tests = [test for case in cases for test in outcomes(case)]
        counts = collections.Counter(result for _, result in tests)
        if not cases:
            print(f"{path}: no test ran")
            counts["failed"] += 1
        for name, result in tests:
            if result == "failed":
                print(f"failed: {name} ({path.parent.name})")
        total += counts
    line = f"{total['passed']} passed, {total['failed']} failed"
    print(line + (f", {total['skipped']} skipped" if total["skipped"] else ""))
    return 1 if total["failed"] or not total["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
