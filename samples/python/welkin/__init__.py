# SPDX-License-Identifier: MIT
"""Welkin from Python: the C API by cffi, without a build step. Needs python3-cffi and
python3-numpy, libwelkin.so ($WELKIN_LIBRARY) and the headers ($WELKIN_INCLUDE, else the tree's or
the system's). docs/guide.md, "Python"."""
from .api import API_VERSION, Error, check, constants, ffi, lib, make, make_preset
from .context import Context

__all__ = ["API_VERSION", "Context", "Error", "check", "constants", "ffi", "lib", "make",
           "make_preset"]
