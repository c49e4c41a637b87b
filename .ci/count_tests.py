#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Adds up ctest's JUnit files; the last line is `N passed, N failed[, N skipped]`.

A test that ctest could not start ("not run" for any reason but its own skip) is a failed one, and
so is a file that is missing or holds no test at all.
"""
import argparse
import collections
import pathlib
import sys
import xml.etree.ElementTree

# What ctest writes for a test that skipped itself (GTEST_SKIP, SKIP_RETURN_CODE).
SKIP_MESSAGES = ("SKIP_REGULAR_EXPRESSION_MATCHED", "SKIP_RETURN_CODE")


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
        counts = collections.Counter(outcome(case) for case in cases)
        if not cases:
            print(f"{path}: no test ran")
            counts["failed"] += 1
        for case in cases:
            if outcome(case) == "failed":
                print(f"failed: {case.get('name')} ({path.parent.name})")
        total += counts
    line = f"{total['passed']} passed, {total['failed']} failed"
    print(line + (f", {total['skipped']} skipped" if total["skipped"] else ""))
    return 1 if total["failed"] or not total["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
