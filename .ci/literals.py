# SPDX-License-Identifier: MIT
"""Literals of shaders/model, which compiles as float and as double from one text.

`0.75f` is for values that float holds exactly, so that both builds mean the same number; every
other one is `real(0.0990567)`. A bare `0.75` would be double in the float build.
"""
import fractions
import re
import struct

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
DIGITS = r"(?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?|\d+[eE][+-]?\d+"
FLOATING = re.compile(rf"(?<![\w.])({DIGITS})([fF]?)(?!\w)")


def exact_in_float(digits):
    try:
        stored = struct.unpack("f", struct.pack("f", float(digits)))[0]
    except OverflowError:
        return False
    return fractions.Fraction(stored) == fractions.Fraction(digits)


def findings(text):
    """Yields (line, what)."""
    # Comments become blanks of the same length, so that lines stay where they are.
    code = COMMENT.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)
    for match in FLOATING.finditer(code):
        digits, suffix = match.groups()
        line = code.count("\n", 0, match.start()) + 1
        if suffix:
            if not exact_in_float(digits):
                yield line, f"{digits}{suffix} is not exact in float: real({digits})"
        elif not (re.search(r"\breal\(\s*[+-]?\s*$", code[:match.start()])
                  and re.match(r"\s*\)", code[match.end():])):
            yield line, f"bare {digits}: real({digits}), or {digits}f if exact"
