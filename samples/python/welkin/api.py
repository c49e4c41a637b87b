# SPDX-License-Identifier: MIT
"""The C API as it is, read from the public headers when this module is imported: nothing is
generated or compiled, and nothing here can fall behind the headers.

`lib` has the functions and the enumerators, `ffi` is cffi's. make() fills a structure with its
defaults, check() turns an error code into an Error.
"""
import ctypes.util
import os
import pathlib
import re

import cffi

HEADERS = ("core.h", "scene.h", "surface.h", "view.h", "output.h", "statistics.h", "query.h")


class Error(Exception):
    """A call of the library that failed: what wlkGetLastError says about it."""

    def __init__(self, name, result, field, message):
        super().__init__(f"{name}: {field}: {message}" if field else f"{name}: {message}")
        self.name, self.result, self.field = name, result, field


def include_folder():
    """Folder with welkin/core.h: $WELKIN_INCLUDE, this repository's, or the system's."""
    tree = pathlib.Path(__file__).resolve().parents[3] / "include"
    places = [os.environ.get("WELKIN_INCLUDE"), tree, "/usr/local/include", "/usr/include"]
    for place in places:
        if place and (pathlib.Path(place) / "welkin" / "core.h").is_file():
            return pathlib.Path(place)
    raise ImportError("welkin: no headers found; set WELKIN_INCLUDE to the folder with welkin/")


def library_file():
    """$WELKIN_LIBRARY, or what the dynamic linker finds."""
    file = os.environ.get("WELKIN_LIBRARY") or ctypes.util.find_library("welkin")
    if not file:
        raise ImportError("welkin: no library found; set WELKIN_LIBRARY to libwelkin.so")
    return file


def declarations(folder):
    """The headers without what cffi's parser does not read."""
    text = "".join((folder / "welkin" / name).read_text(encoding="utf-8") for name in HEADERS)
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
    numbers = dict(re.findall(r"^#define (WLK_\w+) +(\d+)u?\s*$", text, flags=re.M))
    text = re.sub(r'^extern "C" \{|^\}\s*$', "", text, flags=re.M)
    text = re.sub(r"^#(?:.*\\\n)*.*$", "", text, flags=re.M)
    text = text.replace("WLK_API", "")
    text = re.sub(r"\[(WLK_\w+)\]", lambda found: f"[{numbers[found[1]]}]", text)
    return text, {name: int(number) for name, number in numbers.items()}


def header_version(folder):
    text = (folder / "welkin" / "core.h").read_text(encoding="utf-8")
    parts = [int(re.search(rf"#define WLK_VERSION_{part} (\d+)", text)[1])
             for part in ("MAJOR", "MINOR", "PATCH")]
    return parts[0] << 22 | parts[1] << 12 | parts[2]


ffi = cffi.FFI()
_TEXT, constants = declarations(include_folder())
ffi.cdef(_TEXT)
lib = ffi.dlopen(library_file())
API_VERSION = header_version(include_folder())


def check(result):
    """Returns results that are no errors; raises Error for the others."""
    if result >= 0:
        return result
    info = make("WlkErrorInfo")
    lib.wlkGetLastError(info)
    raise Error(ffi.string(lib.wlkResultName(result)).decode(), result,
                ffi.string(info.field).decode(), ffi.string(info.message).decode())


def struct_type(name):
    """"WlkContextInfo" gives WLK_STRUCT_CONTEXT_INFO."""
    upper = re.sub(r"(?<!^)(?=[A-Z])", "_", name.removeprefix("Wlk")).upper()
    return getattr(lib, "WLK_STRUCT_" + upper)


def make(name, **fields):
    """A structure of the C API with its documented defaults, then `fields`. A misspelled field is
    an AttributeError; sequences fill arrays of their length."""
    structure = ffi.new(name + " *")
    result = lib.wlkInitStruct(struct_type(name), ffi.sizeof(name), structure)
    if result < 0:
        raise Error("wlkInitStruct", result, "", name)
    for field, value in fields.items():
        setattr(structure, field, as_given(getattr(structure, field), value))
    return structure


def make_preset(preset, name):
    """A part of an atmosphere, WLK_ATMOSPHERE_*."""
    structure = ffi.new(name + " *")
    result = lib.wlkInitPresetStruct(preset, struct_type(name), ffi.sizeof(name), structure)
    if result < 0:
        raise Error("wlkInitPresetStruct", result, "", name)
    return structure


def as_given(old, value):
    """Arrays take any sequence, but of their own length alone: cffi would leave the rest as is."""
    if isinstance(old, ffi.CData) and ffi.typeof(old).kind == "array":
        number = float if ffi.typeof(old).item.cname in ("float", "double") else int
        value = [number(v) for v in value]
        if len(value) != len(old):
            raise ValueError(f"{len(value)} values for {len(old)}")
    return value
