#!/usr/bin/env python3
"""Instructions per pixel of every operator, on emulated boards.

    counts.py OUT_DIR [--functions ITEM] [BOARD...]

Builds count/operators.c at -O2 for each board, runs it in QEMU under count/plugin.c, and prints a
table; with --functions also in which functions an item spends its instructions. budgets.py takes
the same figures. They are instructions, not cycles, and repeat to the last digit.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

import firmware

PIXELS = 320 * 240
BOARDS = {"cortex-m0": "microbit", "cortex-m4": "mps2-an386", "cortex-m7": "mps2-an500",
          "cortex-m55": "mps3-an547", "rv32imc": "rv32-virt"}
EMULATORS = {"cortex-m0": "qemu-system-arm", "cortex-m4": "qemu-system-arm",
             "cortex-m7": "qemu-system-arm", "cortex-m55": "qemu-system-arm",
             "rv32imc": "qemu-system-riscv32"}
PICTURES = ("synth", "rand4", "rand1")
PHOTOGRAPHS = ("china",)
# The code between two marks that has a known length, in the program's own reports.
NOTHING, KNOWN = "(nothing)", ("(501)", 501)
# 4-connected regions of 20 pixels and more; CMVision 1.x and OpenMV find as many.
BLOBS = {"synth": 40, "china": 75, "rand4": 164, "rand1": 434}
# Rows of the result where they are not as many as those of the picture.
ROWS = {"valid": 238, "half": 120, "240x180": 180}
WITH_ROWS = ("filter", "adaptive", "resize", "edges canny")


class Measurement:
    """One item on one board."""

    def __init__(self, item, checksum, number, instructions, functions):
        self.item = item
        self.checksum = checksum
        self.number = int(number)
        self.per_pixel = instructions / PIXELS
        self.functions = functions


def missing(target):
    """Which of the programs that a core takes is not here; None if all are."""
    tools = next(core.tools for core in firmware.CORES if core.name == target)
    programs = (tools + "gcc", EMULATORS[target], "cmake")
    return next((program for program in programs if not shutil.which(program)), None)


def make_inputs(report, out):
    """The plugin and the pictures, in OUT; says which pictures there are."""
    compiler = os.environ.get("PEL_CC", "cc")
    made = firmware.run(compiler, "-std=c99", "-D_POSIX_C_SOURCE=200809L", *firmware.WARNINGS,
                        "-shared", "-fPIC", "-O2", firmware.HERE / "count/plugin.c", "-o",
                        out / "count.so")
    report.check(made.returncode == 0, f"plugin.c: {made.stderr}")
    bench = firmware.ROOT / "tests/bench"
    tools = firmware.ROOT / "tools"
    program = out / "inputs"
    made = firmware.run(compiler, "-std=c99", "-O1", f"-I{firmware.ROOT}/lib/include",
                        f"-I{firmware.ROOT}/lib/src", f"-I{tools}", bench / "inputs_main.c",
                        tools / "benchinput.c", *firmware.library_sources(), "-o", program)
    report.check(made.returncode == 0, f"tools/benchinput.c: {made.stderr}")
    there = []
    for name in PICTURES + PHOTOGRAPHS:
        picture = out / f"{name}.yuyv"
        picture.unlink(missing_ok=True)
        if name in PHOTOGRAPHS:
            firmware.run(sys.executable, bench / "photos.py", name, "320x240", picture)
        else:
            write_output(picture, program, name, "320x240")
        write_output(out / f"{name}.boxes", program, name, "boxes")
        if picture.exists() and picture.stat().st_size == 2 * PIXELS:
            there.append(name)
        else:
            picture.unlink(missing_ok=True)
            report.check(name in PHOTOGRAPHS, f"the picture {name} was not made")
    return there


def write_output(path, *command):
    with open(path, "wb") as file:
        subprocess.run([str(word) for word in command], stdout=file, check=False)


def build(report, board, out):
    """Builds the program for a board; its folder, or None."""
    folder = out / board
    folder.mkdir(parents=True, exist_ok=True)
    toolchain = firmware.ROOT / "ports/baremetal/toolchain.cmake"
    configure = ["cmake", "-S", firmware.HERE / "count", "-B", folder, f"-DPEL_BOARD={board}"]
    if not (folder / "CMakeCache.txt").exists():
        configure.append(f"-DCMAKE_TOOLCHAIN_FILE={toolchain}")
    for command in (configure, ["cmake", "--build", folder, "--parallel", str(os.cpu_count())]):
        result = firmware.run(*command)
        report.check(result.returncode == 0, f"{board}: {result.stderr or result.stdout}")
        if result.returncode != 0:
            return None
    return folder


def read_sums(path):
    """The plugin's sums, (instructions, regions, {function: instructions}); if it ended well."""
    sums, ended = [], False
    for line in path.read_text().splitlines() if path.exists() else ():
        words = line.split()
        if words[0] == "sum":
            sums.append((int(words[1]), int(words[2]), {}))
        elif words[0] == "in":
            sums[-1][2][" ".join(words[1:-1])] = int(words[-1])
        ended = words[0] == "end"
    return sums, ended


def measure_board(report, board, out):
    """item -> Measurement; empty if something went wrong, which the report then says."""
    folder = build(report, board, out)
    if folder is None:
        return {}
    counts = out / f"{board}.counts"
    counts.unlink(missing_ok=True)
    options = f"-plugin file={out}/count.so,out={counts}"
    done = firmware.run("sh", folder / "run.sh", folder / "operators.elf", cwd=out,
                        env={**os.environ, "PEL_QEMU_OPTIONS": options})
    jobs = [line.split("\t")[1:] for line in done.stderr.splitlines() if line.startswith("job\t")]
    sums, ended = read_sums(counts)
    report.check(done.returncode == 0, f"{board}: status {done.returncode}: {done.stderr[-300:]}")
    report.check(ended and len(sums) == len(jobs) > len(BLOBS),
                 f"{board}: {len(sums)} sums for {len(jobs)} items")
    if done.returncode != 0 or not ended or len(sums) != len(jobs):
        return {}
    empty = sums[0][0]
    measured = {}
    for (name, checksum, number), (instructions, regions, functions) in zip(jobs, sums):
        measured[name] = Measurement(name, checksum, number, instructions - empty * regions,
                                     functions)
    report.check(jobs[0][0] == NOTHING, f"{board}: the first report is {jobs[0][0]}")
    known = measured.pop(KNOWN[0], None)
    report.check(known and round(known.per_pixel * PIXELS) == KNOWN[1],
                 f"{board}: the plugin counted {known and known.per_pixel * PIXELS} instructions "
                 f"where there are {KNOWN[1]}")
    measured.pop(NOTHING, None)
    return measured


def expected_number(item):
    """What an item must have found or how many rows it must have made; None if that is open."""
    if item.startswith("blobs"):
        return BLOBS[item.split()[-1]]
    if item.startswith(WITH_ROWS):
        return ROWS.get(re.split(r"[ ,]+", item)[-1], 240)
    return None


def check_work(report, boards):
    """The operators did their work, and the same on all boards."""
    first = {}
    for board, measured in boards.items():
        for item, found in measured.items():
            number = expected_number(item)
            report.check(number in (None, found.number),
                         f"{board}: {item}: {found.number}, not {number}")
            reference, place = first.setdefault(item, (found.checksum, board))
            report.check(found.checksum == reference,
                         f"{item}: checksum {found.checksum} on {board}, {reference} on {place}")
            report.check(found.per_pixel > 0, f"{board}: {item}: nothing was counted")


def measure(report, out, targets=BOARDS):
    """target -> item -> Measurement of all targets whose tools are here, and the pictures."""
    out.mkdir(parents=True, exist_ok=True)
    there = make_inputs(report, out)
    boards = {target: measure_board(report, BOARDS[target], out) for target in targets}
    check_work(report, boards)
    return boards, there


def print_table(boards, item_of_interest):
    items = list(dict.fromkeys(item for measured in boards.values() for item in measured))
    print("instructions per pixel".ljust(34), *(name.rjust(10) for name in boards))
    for item in items:
        print(item.ljust(34), *(f"{found[item].per_pixel:10.2f}" if item in found else " " * 9 + "-"
                                for found in boards.values()))
    for target, measured in boards.items():
        if item_of_interest in measured:
            print(f"\n{item_of_interest} on {target}:")
            functions = measured[item_of_interest].functions
            for name, count in sorted(functions.items(), key=lambda pair: -pair[1]):
                print(f"{count / PIXELS:10.3f} {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--functions", metavar="ITEM", help="where an item spends them")
    parser.add_argument("boards", nargs="*", metavar="BOARD", help=", ".join(BOARDS.values()))
    arguments = parser.parse_args()
    targets = [target for target, board in BOARDS.items()
               if not arguments.boards or board in arguments.boards]
    report = firmware.Report()
    for target in [target for target in targets if missing(target)]:
        report.skip(f"{target}: there is no {missing(target)}")
        targets.remove(target)
    boards, _ = measure(report, arguments.out.resolve(), targets)
    print_table(boards, arguments.functions)
    return report.close()


if __name__ == "__main__":
    sys.exit(main())
