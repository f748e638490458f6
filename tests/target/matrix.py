#!/usr/bin/env python3
"""Builds and runs the unit suites on every machine and compares the hashes of what they computed.

    matrix.py [--out DIR] [--unity DIR] [--jobs N] [MACHINE...]
    matrix.py --list

Machines: host, the toolchain files of tests/target/machines, the boards of ports/baremetal/boards.
Without names: all whose compiler and emulator are here, the others are skipped. With names: these
and host, and what is missing is a failure. Each machine has a build folder DIR/MACHINE, in which
ctest can be called as well. A cell of the table is the first half of the suite's 64-bit hash,
or a number in brackets that says below what is wrong or why the suite is not there.
"""
import argparse
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections import namedtuple

TARGET = pathlib.Path(__file__).resolve().parent
ROOT = TARGET.parents[1]
BOARDS = ROOT / "ports/baremetal/boards"
COMPILERS = {"cortexm": "arm-none-eabi-gcc", "riscv": "riscv64-unknown-elf-gcc"}
END = re.compile(r"^values (\d+), hash ([0-9A-F]{16}), stack (\d+) of (\d+)$", re.M)
CLOSING = re.compile(r"^(\d+) passed, (\d+) failed(?:, (\d+) skipped)?$")

# What ran: a hash (or None) and what is wrong or, with `excused`, why nothing ran.
Cell = namedtuple("Cell", "hash remark excused", defaults=(None, "", False))
Machine = namedtuple("Machine", "name options programs note")
# cells: suite -> Cell; watchers: how many of the programs that go wrong on purpose were seen to.
Column = namedtuple("Column", "machine cells watched unwatched stack")


def setting(text, name):
    """The value of a CMake set() line, or an empty text."""
    found = re.search(rf"^set\({name} \"?([^\")]*)\"?\)", text, re.M)
    return found.group(1) if found else ""


def machines():
    """All machines by name, host first."""
    found = {}
    for path in sorted(TARGET.glob("machines/*.cmake"), key=lambda path: path.stem != "host"):
        text = path.read_text()
        emulator = re.search(r"EMULATOR timeout \d+ (\S+?)\)?$", text, re.M)
        programs = [setting(text, "CMAKE_C_COMPILER")] + list(emulator.groups() if emulator else ())
        note = text.splitlines()[0].lstrip("# ").rstrip(".")
        found[path.stem] = Machine(path.stem, [f"-DCMAKE_TOOLCHAIN_FILE={path}"], programs, note)
    for path in sorted(BOARDS.glob("*.cmake")):
        text = path.read_text()
        programs = [COMPILERS[setting(text, "PEL_BOARD_CORE")],
                    setting(text, "PEL_BOARD_QEMU").split()[0]]
        options = [f"-DCMAKE_TOOLCHAIN_FILE={BOARDS.parent}/toolchain.cmake",
                   f"-DPEL_BOARD={path.stem}"]
        found[path.stem] = Machine(path.stem, options, programs, setting(text, "PEL_BOARD_NOTE"))
    return found


def excuses(path):
    """(machine, suite) -> why that suite cannot run there."""
    with open(path, newline="") as file:
        return {(row["machine"], row["suite"]): row["reason"] for row in csv.DictReader(file)}


def read_suite(output, good):
    """The cell of one run."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    closing = next((CLOSING.match(line) for line in reversed(lines) if CLOSING.match(line)), None)
    end = END.search(output)
    if not end or not closing:
        return Cell(remark=f"ended before it was done: {lines[-1] if lines else 'no output'}")
    passed, failed, _ = (int(number or 0) for number in closing.groups())
    if failed:
        first = next((line for line in lines if ":FAIL" in line), "no line says which")
        return Cell(remark=f"{failed} tests failed: {first}")
    if not good:
        return Cell(remark=f"ended badly: {lines[-1]}")
    if passed == 0 or int(end.group(1)) == 0:
        return Cell(remark="ran nothing")
    return Cell(hash=end.group(2))


def read_results(machine, junit):
    """The column of one machine from ctest's report."""
    cells, watched, unwatched, stack = {}, 0, [], (0, 0)
    for case in ElementTree.parse(junit).getroot().iter("testcase"):
        kind, name = case.get("name").split("_", 1)
        output = case.findtext("system-out") or ""
        good = case.get("status") == "run"
        if kind == "suite":
            cells[name] = read_suite(output, good)
            end = END.search(output)
            if end:
                stack = max(stack, (int(end.group(3)), int(end.group(4))))
        elif good and output.rstrip().endswith("1 passed, 0 failed"):
            watched += 1
        else:
            unwatched.append((name, output.strip()))
    return Column(machine, cells, watched, unwatched, stack)


def log_of(command, path):
    with open(path, "w") as log:
        return subprocess.run(command, stdout=log, stderr=subprocess.STDOUT).returncode


def run_machine(machine, out, unity, jobs):
    """Configures, builds and runs; a column, whatever went wrong."""
    build = out / machine.name
    build.mkdir(parents=True, exist_ok=True)
    junit = build / "junit.xml"
    junit.unlink(missing_ok=True)
    if log_of(["cmake", "-S", TARGET / "images", "-B", build, f"-DPEL_UNITY_DIR={unity}",
               f"-DPEL_PYTHON={sys.executable}"] + machine.options, build / "configure.log") != 0:
        log = (build / "configure.log").read_text()
        return Column(machine, {}, 0, [("configure", log)], (0, 0))
    # A suite that does not fit leaves the others standing; ctest misses its program.
    built = log_of(["cmake", "--build", build, "--parallel", str(jobs), "--", "-k"],
                   build / "build.log") == 0
    log_of(["ctest", "--test-dir", build, "--parallel", str(jobs), "--output-junit", junit,
            "--test-output-size-passed", "1000000", "--test-output-size-failed", "1000000"],
           build / "ctest.log")
    if not junit.exists():
        return Column(machine, {}, 0, [("ctest", (build / "ctest.log").read_text())], (0, 0))
    column = read_results(machine, junit)
    if not built:
        errors = [line for line in (build / "build.log").read_text().splitlines()
                  if re.search(r"error|Error 1|warning|not enough|overflow", line)]
        column.unwatched.append(("build", "\n".join(errors[:20])))
    return column


def fill_and_compare(columns, suites, excused):
    """Gives every machine a cell for every suite, and marks hashes that are not the first one's."""
    for suite in suites:
        reference = next((column.cells[suite].hash for column in columns
                          if suite in column.cells and column.cells[suite].hash), None)
        for column in columns:
            reason = excused.get((column.machine.name, suite))
            cell = column.cells.get(suite)
            if cell is None:
                cell = Cell(remark=reason, excused=True) if reason else Cell(remark="did not run")
            elif reason:
                cell = Cell(remark=f"ran, although absent.csv says: {reason}")
            elif cell.hash and cell.hash != reference:
                cell = Cell(remark=f"computed something else: {cell.hash}, not {reference}")
            column.cells[suite] = cell


def print_table(columns, suites):
    """Returns how many cells are good, wrong and excused."""
    remarks, good, excused = [], 0, 0
    width = max(len(suite) for suite in suites) + 1
    widths = [max(len(column.machine.name), 8) for column in columns]
    print("suite".ljust(width), *(column.machine.name.ljust(w)
                                  for column, w in zip(columns, widths)))
    for suite in suites:
        cells = []
        for column in columns:
            cell = column.cells[suite]
            if cell.hash:
                good += 1
                cells.append(cell.hash[:8].lower())
                continue
            excused += cell.excused
            remarks.append(f"{suite} on {column.machine.name}: {cell.remark}")
            cells.append(f"{'absent' if cell.excused else 'FAIL'} [{len(remarks)}]")
        print(suite.ljust(width), *(cell.ljust(w) for cell, w in zip(cells, widths)))
    print("watchers".ljust(width), *(f"{column.watched}/{column.watched + len(column.unwatched)}"
                                     .ljust(w) for column, w in zip(columns, widths)))
    print("stack".ljust(width), *((str(column.stack[0]) if column.stack[1] else "-").ljust(w)
                                  for column, w in zip(columns, widths)))
    for number, remark in enumerate(remarks, 1):
        print(f"[{number}] {remark}")
    print("watchers: programs that go wrong on purpose and were seen to; stack: the most bytes "
          "that a suite used\n(-: not watched; the host has the sanitizers)")
    return good, len(remarks) - excused, excused


def write_csv(columns, suites, path):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["suite"] + [column.machine.name for column in columns])
        for suite in suites:
            writer.writerow([suite] + [column.cells[suite].hash or column.cells[suite].remark
                                       for column in columns])


def choose(known, names):
    """The machines to run, and (name, what is missing) of those that cannot."""
    wanted = list(known) if not names else list(dict.fromkeys(["host"] + names))
    chosen, missing = [], []
    for name in wanted:
        absent = [program for program in known[name].programs if not shutil.which(program)]
        if absent:
            missing.append((name, " and ".join(absent)))
        else:
            chosen.append(known[name])
    return chosen, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="name the machines and stop")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/target")
    parser.add_argument("--unity", type=pathlib.Path, help="where Unity is or is put")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("machines", nargs="*", metavar="MACHINE")
    arguments = parser.parse_args()

    known = machines()
    if arguments.list:
        for machine in known.values():
            print(f"{machine.name:12} {machine.note}")
        return 0
    for name in arguments.machines:
        if name not in known:
            parser.error(f"no machine '{name}'; there are: {', '.join(known)}")
    chosen, missing = choose(known, arguments.machines)
    out = arguments.out.resolve()
    unity = (arguments.unity or out / "unity").resolve()

    columns = [run_machine(machine, out, unity, arguments.jobs) for machine in chosen]
    suites = {path.stem.removeprefix("test_") for path in (ROOT / "tests/unit").glob("test_*.c")}
    suites = sorted(suites.union(*(column.cells for column in columns)))
    fill_and_compare(columns, suites, excuses(TARGET / "absent.csv"))
    good, wrong, skipped = print_table(columns, suites)
    write_csv(columns, suites, out / "matrix.csv")

    for column in columns:
        good += column.watched
        wrong += len(column.unwatched)
        for name, output in column.unwatched:
            print(f"\n{column.machine.name} {name}:\n{output}")
    for name, programs in missing:
        print(f"{name}: {'FAIL' if arguments.machines else 'skipped'}, no {programs} here")
    if arguments.machines:
        wrong += len(missing)
    else:
        skipped += len(missing)
    print(f"{good} passed, {wrong} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if wrong or not good else 0


if __name__ == "__main__":
    sys.exit(main())
