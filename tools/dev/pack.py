#!/usr/bin/env python3
"""Packs the library for the tools that people use on their boards.

    pack.py KIND [OUT] [--root PROJECT_DIR]

KIND is arduino, platformio, esp-idf, zephyr or single-file. OUT is a new or empty folder or, with
the ending .zip, an archive; without it the package is written anew below build/packages. Manifests
and examples come from ports/KIND, where @VERSION@ in a file that ends in .in becomes the version of
pel/version.h. The same project always gives the same bytes.
"""
import argparse
import pathlib
import shutil
import sys
import tempfile
import zipfile

import amalgamate
import project
from project import Problem


def copy_file(source, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(source.read_bytes())


def add_port(root, kind, out):
    """ports/KIND with the version filled in, the ending .in falling off, and the licence."""
    folder = root / "ports" / kind
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        target = out / path.relative_to(folder)
        if path.suffix == ".in":
            target = target.with_suffix("")
            target.parent.mkdir(parents=True, exist_ok=True)
            text = path.read_text(encoding="utf-8").replace("@VERSION@", project.version(root))
            target.write_text(text, encoding="utf-8")
        else:
            copy_file(path, target)
    copy_file(root / "LICENSE", out / "LICENSE")


def add_headers(root, out):
    for path in project.public_headers(root):
        copy_file(path, out / path.relative_to(root / "lib/include"))


def add_sources(root, out):
    """The sources, and the private headers beside them."""
    for path in project.sources(root) + project.private_headers(root):
        copy_file(path, out / path.relative_to(root / "lib/src"))


def add_flat(root, out):
    """Headers and sources in one folder src, as Arduino wants them."""
    add_headers(root, out / "src")
    add_sources(root, out / "src")


def add_split(root, out):
    """Public headers in include, the rest in src."""
    add_headers(root, out / "include")
    add_sources(root, out / "src")


def add_lib(root, out):
    """lib as it is in the project, for builds that read pel_files.cmake."""
    copy_file(root / "lib/pel_files.cmake", out / "lib/pel_files.cmake")
    add_headers(root, out / "lib/include")
    add_sources(root, out / "lib/src")


def add_single(root, out):
    for name, text in amalgamate.amalgamate(root).items():
        (out / name).write_text(text, encoding="utf-8")


LAYOUTS = {"arduino": add_flat, "platformio": add_split, "esp-idf": add_lib, "zephyr": add_lib,
           "single-file": add_single}


def write_zip(folder, out):
    """An archive whose one folder is pel; without dates, so that it is the same every time."""
    out.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(out, "w") as archive:
        for path in sorted(path for path in folder.rglob("*") if path.is_file()):
            entry = zipfile.ZipInfo(f"pel/{path.relative_to(folder).as_posix()}")
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3  # Unix, wherever this runs
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, path.read_bytes())


def pack(root, kind, out):
    """Makes the package elsewhere first: what goes wrong leaves `out` as it was."""
    if out.suffix != ".zip" and out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise Problem(f"{out} is not an empty folder")
    with tempfile.TemporaryDirectory() as folder:
        made = pathlib.Path(folder) / "pel"
        made.mkdir()
        add_port(root, kind, made)
        LAYOUTS[kind](root, made)
        if out.suffix == ".zip":
            write_zip(made, out)
        else:
            shutil.copytree(made, out, dirs_exist_ok=True)


def main():
    parser = argparse.ArgumentParser(description="Packs the library for one kind of board tools.")
    parser.add_argument("kind", choices=LAYOUTS)
    parser.add_argument("out", type=pathlib.Path, nargs="?")
    parser.add_argument("--root", type=pathlib.Path, default=project.HERE)
    arguments = parser.parse_args()
    root, kind, out = arguments.root.resolve(), arguments.kind, arguments.out
    try:
        if out is None:
            name = "arduino/pel.zip" if kind == "arduino" else f"{kind}/pel"
            out = root / "build/packages" / name
            shutil.rmtree(out.parent, ignore_errors=True)
        pack(root, kind, out)
    except (OSError, Problem) as problem:
        print(f"pack.py: {problem}", file=sys.stderr)
        return 1
    print(f"wrote {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
