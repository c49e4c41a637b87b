#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the installed trees that the consumers use, and checks them.

prepare.py prefix BUILD WORK SOURCE: installs BUILD to a prefix and moves it to WORK/moved.
prepare.py debian BUILD WORK SOURCE: makes the .deb packages and unpacks them, as no user in
particular, to WORK/unpacked.
"""
import pathlib
import shutil
import subprocess
import sys

# Beyond them a program needs nothing but libwelkin1.
RUNTIME = {"libc6", "libgcc-s1", "libstdc++6", "libm"}


def run(*command, cwd=None):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                            cwd=cwd, check=False)
    if result.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return result.stdout


def refuse_paths(tree, words):
    """No file may know where it was built or first installed."""
    found = [f"{path.relative_to(tree)} has {word}" for path in tree.rglob("*") if path.is_file()
             for word in words if str(word).encode() in path.read_bytes()]
    if found:
        sys.exit("\n".join(found))


def globals_of(archive):
    listing = run("nm", "--extern-only", "--defined-only", "--format=posix", archive)
    return {line.split()[0] for line in listing.splitlines() if len(line.split()) > 2}


def check_archive(tree, source):
    listed = (source / "tests/abi/symbols.txt").read_text(encoding="utf-8").split()
    expected = {name.split("@")[0] for name in listed}
    archive, = tree.rglob("libwelkin.a")
    different = globals_of(archive) ^ expected
    if different:
        sys.exit(f"libwelkin.a does not define exactly the API: {sorted(different)}")


def prefix(build, work, source):
    first, moved = work / "first", work / "moved"
    for folder in (first, moved):
        shutil.rmtree(folder, ignore_errors=True)
    run("cmake", "--install", build, "--prefix", first)
    first.rename(moved)
    refuse_paths(moved, (first, source))
    check_archive(moved, source)


def field(package, name):
    return run("dpkg-deb", "--field", package, name).strip()


def debian(build, work, source):
    made, unpacked = work / "made", work / "unpacked"
    for folder in (made, unpacked):
        shutil.rmtree(folder, ignore_errors=True)
    run("cpack", "-G", "DEB", "-B", made, cwd=build)
    packages = {field(path, "Package"): path for path in made.glob("*.deb")}
    if sorted(packages) != ["libwelkin-dev", "libwelkin1", "welkin-tools"]:
        sys.exit(f"packages are {sorted(packages)}")
    needs = {word.split()[0] for word in field(packages["libwelkin1"], "Depends").split(",")}
    if not needs <= RUNTIME:
        sys.exit(f"libwelkin1 depends on {sorted(needs - RUNTIME)}")
    for name in ("libwelkin-dev", "welkin-tools"):
        if "libwelkin1 (= " not in field(packages[name], "Depends"):
            sys.exit(f"{name} does not depend on libwelkin1 of its version")
    owners = {}
    for name, path in packages.items():
        for line in run("dpkg-deb", "--contents", path).splitlines():
            file = line.split()[5]
            if not file.endswith("/") and owners.setdefault(file, name) != name:
                sys.exit(f"{file} is in {name} and in {owners[file]}")
        if f"./usr/share/doc/{name}/copyright" not in owners:
            sys.exit(f"{name} has no licence")
        run("dpkg-deb", "--extract", path, unpacked)
    refuse_paths(unpacked, (source,))
    check_archive(unpacked, source)


def main():
    what, build, work, source = sys.argv[1:]
    work = pathlib.Path(work)
    work.mkdir(parents=True, exist_ok=True)
    {"prefix": prefix, "debian": debian}[what](pathlib.Path(build), work, pathlib.Path(source))


if __name__ == "__main__":
    main()
