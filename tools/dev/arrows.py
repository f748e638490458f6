#!/usr/bin/env python3
"""Reads every #include line of the project and fails on one that points upward.

Includes may only go down the arrows below, over as many steps as it takes; a module never includes
one beside or above it. Ports, tools and tests see the public headers and their own files.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# module: the modules right below it.
ARROWS = {
    "blobs": ["classify"],
    "feature": ["filter", "point"],
    "track": ["point"],
    "nn": ["row"],
    "camera": ["row"],
    "classify": ["color"],
    "filter": ["color"],
    "point": ["color"],
    "color": ["image"],  # for pel_range alone
    "image": ["row"],
    "row": ["backend", "fixed", "status", "config", "overlap"],
    "backend": ["config"],
    "overlap": [],
    "fixed": [],
    "status": ["version"],
    "version": [],
    "config": [],
}
# A file MODULE_part.c belongs to MODULE; these bear another name.
PARTS = {"blob": "blobs", "classifier": "classify", "format": "image", "frames": "image"}
# lib/ runs where there is nothing but a compiler.
LIB_SYSTEM = {"limits.h", "stdbool.h", "stddef.h", "stdint.h"}
# What the processor is asked with.
BACKEND_SYSTEM = {"cpuid.h"}
EXTRA_SYSTEM = {"row": {"arm_acle.h", "arm_mve.h", "arm_neon.h", "immintrin.h", "tmmintrin.h"},
                "backend": {"cpuid.h"}}
# Who above lib/ may look inside: the tests of row kernels, against each other and by brute force.
SEES_ROW = ("tests/equal/", "tests/property/classify_runs.c")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)


def below(module):
    """Every module that can be reached by going down from this one."""
    reached = set()
    waiting = list(ARROWS[module])
    while waiting:
        lower = waiting.pop()
        if lower not in reached:
            reached.add(lower)
            waiting += ARROWS[lower]
    return reached


def module_of(path):
    """The module of a file of lib/, None if the table does not know it."""
    if path.parent.name == "row":
        return "row"
    first = path.stem.split("_")[0]
    name = PARTS.get(first, first)
    return name if name in ARROWS else None


def find_in_lib(name):
    """Where lib/ has the file that an include line names, None if nowhere."""
    for folder in (ROOT / "lib/include", ROOT / "lib/src"):
        if (folder / name).is_file():
            return folder / name
    return None


def check_lib(path, kind, name):
    """What is wrong with an include line of lib/; None if nothing."""
    module = module_of(path)
    if path == ROOT / "lib/include/pel.h":
        return None if name.startswith("pel/") else "pel.h includes public headers only"
    if module is None:
        return "this file is in no module: add it to the table in tools/dev/arrows.py"
    if kind == "<":
        allowed = LIB_SYSTEM | EXTRA_SYSTEM.get(module, set())
        return None if name in allowed else f"lib/ does not include <{name}>"
    target = find_in_lib(name)
    if target is None:
        return f'"{name}" is neither in lib/include nor in lib/src'
    public = ROOT / "lib/include"
    if public in path.parents and public not in target.parents:
        return f'a public header includes the private "{name}"'
    other = module_of(target)
    if other != module and other not in below(module):
        return f"{module} includes {other}, which is not below it"
    return None


def check_user(path, kind, name):
    """What is wrong with an include line of ports/, tools/ or tests/; None if nothing."""
    if name == "pel.h" or name.startswith("pel/"):
        return None if find_in_lib(name) else f"there is no {name}"
    if kind == "<":
        return None
    top = path.relative_to(ROOT).parts[0]
    target = (path.parent / name).resolve()
    if target.is_file():
        if (ROOT / top) in target.parents:
            return None
        return f'{top}/ does not see "{name}"'
    if find_in_lib(name) and not path.relative_to(ROOT).as_posix().startswith(SEES_ROW):
        return f'"{name}" is private to lib/'
    return None


def main():
    files = edges = failed = 0
    for top in ("lib", "ports", "tools", "tests"):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix not in (".c", ".h", ".cpp", ".hpp") or not path.is_file():
                continue
            files += 1
            for kind, name in INCLUDE.findall(path.read_text()):
                edges += 1
                fault = (check_lib if top == "lib" else check_user)(path, kind, name)
                if fault:
                    failed += 1
                    print(f"{path.relative_to(ROOT)}: {fault}")
    print(f"{files} files, {edges} include lines")
    print(f"{edges - failed} passed, {failed} failed")
    return 1 if failed or edges == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
