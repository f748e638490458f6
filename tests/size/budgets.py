#!/usr/bin/env python3
"""Measures what the library costs on microcontrollers and compares it with budgets.csv.

    budgets.py [--part compiled|emulated] [--write] OUT_DIR

To take the figures of today as the new ones, table in the README included:

    python3 tests/size/budgets.py --write build/budgets

Part `compiled` (seconds) measures, of the library as compiled with -Os:
    flash         text and constants of each module, for each core
    stack         the worst case of each public function (stack.py says how)
    ram           of each part of the library for rows of 320 pixels (ram.c)
    linked        what is left of the library in a firmware (linked.py says what is counted)
Part `emulated` (minutes):
    instructions  per pixel of each operator, -O2 (counts.py)
    robot flash, robot ram    of the firmware ports/robot on each board; without its stack
Rows of the kind `peer` are figures of other programs for the same work, copied in by hand.

It fails on growth over the tolerance, on items that came or went, and where a limit is not held.
Figures of another version of a compiler cannot be compared: then only the limits count.
"""
import argparse
import collections
import csv
import pathlib
import re
import shutil
import subprocess
import sys

import counts
import firmware
import linked
import stack

KEPT = firmware.HERE / "budgets.csv"
README_SIZES = firmware.ROOT / "tools/dev/readme_sizes.py"
Row = collections.namedtuple("Row", "kind target item value unit made_by")
PARTS = {"compiled": ("flash", "stack", "ram", "linked"),
         "emulated": ("instructions", "robot flash", "robot ram")}
PEER = "peer"
KINDS = PARTS["compiled"] + PARTS["emulated"] + (PEER,)

# How much a figure may grow: a part of it, and at least so much, as small figures jump.
Tolerance = collections.namedtuple("Tolerance", "part least")
TOLERANCES = {"flash": Tolerance(0.02, 8), "linked": Tolerance(0.02, 8), "ram": Tolerance(0, 0),
              "stack": Tolerance(0, 8), "instructions": Tolerance(0.03, 0.02),
              "robot flash": Tolerance(0.02, 8), "robot ram": Tolerance(0.02, 8)}

# Instructions per pixel to be reached, for each core, and the part by which they may be missed.
AIMS_TOLERANCE = 0.03
GENERIC = "filter generic 3x3(?!, divisor).*"
AIMS = {
    "m0": {"blobs basic synth": 9, "blobs basic china": 11.5},
    "m4": {"blobs basic synth": 6, "blobs basic china": 8, "blobs basic rand4": 15,
           "blobs basic rand1": 33, "blobs all synth": 6.5, "blobs all china": 9.5,
           "blobs all rand4": 20, "blobs all rand1": 50,
           "filter gauss3": 7, GENERIC: 15, "filter gradient abs": 14},
    "m55": {"blobs basic synth": 2.5, "blobs basic china": 4, "filter gauss3": 2.8, GENERIC: 6,
            "filter gradient abs": 4},
}

# What must hold whatever the compiler: kind, target, item (patterns), and the most it may be.
Limit = collections.namedtuple("Limit", "kind target item most")
LIMITS = (
    Limit("linked", "cortex-m4", "classify and blobs", 4096),
    Limit("linked", "cortex-m4", "generic 3x3, all borders", 2048),
    Limit("linked", "cortex-m4", "whole library", 49152),
    Limit("stack", ".*", ".*", 512),
    Limit("ram", ".*", "robot, 320x240.*", 8192),
) + tuple(
    Limit("instructions", f"cortex-{core}", item, round(aim * (1 + AIMS_TOLERANCE), 3))
    for core, aims in AIMS.items() for item, aim in aims.items())
SMALL_STACK = 128  # most public functions take less
CLASSES_ITEM = "robot, 320x240, 8 classes, all measured"


# ---- Measuring ----------------------------------------------------------------------------------

def array_sizes(report, target, source, out):
    """name -> bytes of the arrays of a source that is only compiled."""
    stem = out / pathlib.Path(source).stem
    _, fault = firmware.compile_one((target, ["-fno-common"], source, stem))
    report.check(not fault, f"{target.name}: {source}:\n{fault}")
    return {fields[-1]: int(fields[1], 16)
            for fields in firmware.symbols(target, [f"{stem}.o"], "-S") if len(fields) == 4}


def ram_rows(report, target, out, by):
    robot = array_sizes(report, target, firmware.HERE / "memory.c", out)
    parts = array_sizes(report, target, firmware.HERE / "ram.c", out)
    report.check("robot_memory" in robot and len(parts) > 5, f"{target.name}: no RAM was measured")
    rows = [Row("ram", target.name, CLASSES_ITEM, robot.get("robot_memory", 0), "bytes", by)]
    for name in sorted(parts):
        item = name.removeprefix("ram_").replace("_", " ")
        rows.append(Row("ram", target.name, item, parts[name], "bytes", by))
    return rows


def compiled_rows(report, target, out, used):
    """All rows of one core."""
    by = firmware.version(target.tools)
    options = ["-ffunction-sections", "-fdata-sections", "-fstack-usage", "-fcallgraph-info=su"]
    stems = firmware.compile_all(report, target, options, firmware.library_sources(),
                                 out / target.name)
    rows = []
    for stem in stems:
        text, data, bss = firmware.sizes(target, f"{stem}.o")
        report.check(data == bss == 0, f"{target.name}: {stem.name}: data {data}, bss {bss}")
        if text > 0:  # the kernels for other processors are empty
            rows.append(Row("flash", target.name, stem.name, text, "bytes", by))
    for name, size in stack.worst_stacks(report, target, stems, used).items():
        rows.append(Row("stack", target.name, name, size, "bytes", by))
    rows += ram_rows(report, target, out / target.name, by)
    if target.name == "cortex-m4":
        for which in linked.FIRMWARES:
            modules = linked.link(report, target, stems, which, out / target.name,
                                  stack.public_functions())
            print(f"{which.item}:", ", ".join(f"{name} {size}" for name, size in modules.items()))
            rows.append(Row("linked", target.name, which.item, sum(modules.values()), "bytes", by))
    return rows


def measure_compiled(report, out):
    rows, used = [], set()
    for target in firmware.CORES:
        if shutil.which(target.tools + "gcc"):
            rows += compiled_rows(report, target, out, used)
        else:
            report.skip(f"{target.name}: there is no {target.tools}gcc")
    for pattern, _ in stack.INDIRECT:
        report.check(pattern in used or not rows,
                     f"stack.py lists calls through {pattern}, and there is none any more")
    return rows


def robot_rows(report, board, out):
    """Flash and RAM of the robot's firmware."""
    text = (firmware.ROOT / f"ports/baremetal/boards/{board}.cmake").read_text()
    tools = "arm-none-eabi-" if "CORE cortexm" in text else "riscv64-unknown-elf-"
    if not shutil.which(tools + "gcc") or not shutil.which("cmake"):
        report.skip(f"{board}: there is no {tools}gcc or no cmake")
        return []
    folder = out / f"robot-{board}"
    toolchain = firmware.ROOT / "ports/baremetal/toolchain.cmake"
    shutil.rmtree(folder, ignore_errors=True)
    for command in (["cmake", "-S", firmware.ROOT / "ports/robot", "-B", folder,
                     f"-DCMAKE_TOOLCHAIN_FILE={toolchain}", f"-DPEL_BOARD={board}"],
                    ["cmake", "--build", folder, "--parallel", "2"]):
        done = firmware.run(*command)
        report.check(done.returncode == 0, f"robot on {board}: {done.stderr or done.stdout}")
        if done.returncode != 0:
            return []
    target = next(core for core in firmware.CORES if core.tools == tools)
    code, data, bss = firmware.sizes(target, folder / "robot_blobs.elf")
    by = firmware.version(tools)
    return [Row("robot flash", board, "ports/robot", code + data, "bytes", by),
            Row("robot ram", board, "ports/robot", data + bss, "bytes", by)]


def measure_emulated(report, out):
    targets = [target for target in counts.BOARDS if not counts.missing(target)]
    for target in counts.BOARDS:
        if target not in targets:
            report.skip(f"instructions on {target}: there is no {counts.missing(target)}")
    boards, pictures = counts.measure(report, out / "counts", targets)
    for name in counts.PHOTOGRAPHS:
        if name not in pictures:
            report.skip(f"the photograph {name}: its Python packages are not here")
    rows = []
    for target, measured in boards.items():
        tools = next(core.tools for core in firmware.CORES if core.name == target)
        by = firmware.version(tools)
        rows += [Row("instructions", target, item, round(found.per_pixel, 3), "per pixel", by)
                 for item, found in measured.items()]
    for path in sorted((firmware.ROOT / "ports/baremetal/boards").glob("*.cmake")):
        rows += robot_rows(report, path.stem, out)
    return rows


MEASURE = {"compiled": measure_compiled, "emulated": measure_emulated}


# ---- Comparing ----------------------------------------------------------------------------------

def number(text):
    return float(text) if "." in text else int(text)


def read_rows(path=KEPT):
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return [Row(row["kind"], row["target"], row["item"], number(row["value"]), row["unit"],
                    row["made_by"]) for row in csv.DictReader(file)]


def check_limits(report, rows):
    """The limits that hold for every compiler."""
    for limit in LIMITS:
        for row in rows:
            if row.kind == limit.kind and re.fullmatch(limit.target, row.target) and \
                    re.fullmatch(limit.item, row.item):
                report.check(row.value <= limit.most,
                             f"over the limit: {row.kind} of {row.item} on {row.target}: "
                             f"{row.value} {row.unit}, at most {limit.most}")
    for target in dict.fromkeys(row.target for row in rows if row.kind == "stack"):
        stacks = [row.value for row in rows if row.kind == "stack" and row.target == target]
        small = sum(size < SMALL_STACK for size in stacks)
        report.check(2 * small > len(stacks),
                     f"{target}: only {small} of {len(stacks)} public functions take less than "
                     f"{SMALL_STACK} bytes of stack")


def judge(before, now):
    """'grown', 'changed' (within the tolerance, or less) or 'same'."""
    tolerance = TOLERANCES[now.kind]
    allowed = max(before.value * tolerance.part, tolerance.least)
    if now.value > before.value + allowed + 1e-9:
        return "grown"
    return "same" if now.value == before.value else "changed"


def difference(before, now):
    part = f" ({100 * (now.value / before.value - 1):+.1f} %)" if before.value else ""
    return f"{now.kind} of {now.item} on {now.target}: {before.value} -> {now.value} " \
           f"{now.unit}{part}"


def compare(report, rows, kept, pictures_missing=()):
    """Checks rows against those kept. True if the kept ones could be refreshed."""
    old = {(row.kind, row.target, row.item): row for row in kept}
    new = {(row.kind, row.target, row.item): row for row in rows}
    measured = {(row.kind, row.target) for row in rows}
    other = sorted({f"{row.target}: {row.made_by}, the figures kept are of "
                    f"{old[key].made_by}" for key, row in new.items()
                    if key in old and old[key].made_by != row.made_by})
    for text in other:
        report.skip(f"{text}: only the limits are checked")
    stale = False
    for key, now in new.items():
        before = old.get(key)
        if before is not None and before.made_by != now.made_by:
            continue
        if before is None:
            report.check(False, f"not in {KEPT.name}: {now.kind} of {now.item} on {now.target}, "
                                f"{now.value} {now.unit}")
            stale = True
            continue
        verdict = judge(before, now)
        report.check(verdict != "grown", f"grown: {difference(before, now)}")
        if verdict == "changed":
            print(f"changed: {difference(before, now)}")
        stale |= verdict != "same"
    for key, before in old.items():
        if key[:2] not in measured or key in new:
            continue
        if any(name in before.item for name in pictures_missing):
            report.skip(f"{before.kind} of {before.item} on {before.target}: no photograph")
            continue
        report.check(False, f"in {KEPT.name}, but gone: {before.kind} of {before.item} on "
                            f"{before.target}")
        stale = True
    return stale


# ---- Writing ------------------------------------------------------------------------------------

def write_rows(rows, kept):
    """Rows that were measured take the place of those of their kind and target."""
    measured = {(row.kind, row.target) for row in rows}
    fresh = {(row.kind, row.target, row.item) for row in rows}
    # What could not be measured for want of a photograph stays.
    staying = [row for row in kept if (row.kind, row.target) not in measured
               or (row.kind == "instructions" and (row.kind, row.target, row.item) not in fresh
                   and any(name in row.item for name in counts.PHOTOGRAPHS))]
    both = sorted(rows + staying, key=lambda row: KINDS.index(row.kind))
    with open(KEPT, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(Row._fields)
        writer.writerows(both)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--part", choices=PARTS, action="append", help="both if none is named")
    parser.add_argument("--write", action="store_true", help="take the figures of today")
    parser.add_argument("out", type=pathlib.Path, metavar="OUT_DIR")
    arguments = parser.parse_args()
    out = arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)

    report = firmware.Report()
    rows = []
    for part in arguments.part or PARTS:
        rows += MEASURE[part](report, out)
    check_limits(report, rows)
    kept = read_rows()
    if arguments.write:
        if report.skipped:
            print("what was skipped keeps its old figures")
        write_rows(rows, kept)
        subprocess.run([sys.executable, README_SIZES, "--write"], check=False)
    else:
        missing = [name for name in counts.PHOTOGRAPHS
                   if not (out / f"counts/{name}.yuyv").exists()]
        if compare(report, rows, kept, missing):
            print(f"To take the figures of today:  python3 tests/size/budgets.py --write {out}")
    return report.close()


if __name__ == "__main__":
    sys.exit(main())
