#!/usr/bin/env python3
"""Pixel formats are told apart in one place of the library and one of the command.

Fails where any other file of lib/, ports/ or tools/ switches over formats, has a table with a line
per format or relies on their order, so that a new format stays one row in one table.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ALLOWED = {"lib/src/image.c", "tools/pack.c"}


def main():
    header = (ROOT / "lib/include/pel/image.h").read_text()
    body = re.search(r"typedef enum pel_format \{(.*?)\} pel_format;", header, re.S).group(1)
    names = [name for name in re.findall(r"^\s*(PEL_\w+)", body, re.M)
             if name != "PEL_FORMAT_COUNT"]
    either = "|".join(names)
    fault = re.compile(rf"\bcase\s+(?:{either})\b|\[\s*(?:{either})\s*\]\s*=|"
                       rf"[<>]=?\s*(?:{either})\b")

    files = failed = 0
    for top in ("lib", "ports", "tools"):
        for path in sorted((ROOT / top).rglob("*.[ch]")):
            place = path.relative_to(ROOT).as_posix()
            if place in ALLOWED:
                continue
            files += 1
            lines = [number for number, line in enumerate(path.read_text().splitlines(), 1)
                     if fault.search(line)]
            if lines:
                failed += 1
                print(f"{place}: tells pixel formats apart in line {', '.join(map(str, lines))}")
    print(f"{len(names)} formats, {files} files")
    print(f"{files - failed} passed, {failed} failed")
    return 1 if failed or files == 0 or len(names) < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
