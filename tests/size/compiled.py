#!/usr/bin/env python3
"""Compiles the library as firmware does and looks at what came out, target by target.

    compiled.py OUT_DIR SOURCE.c...

No writable data, no symbol without the prefix, no call out of the library but to the compiler's
own integer helpers, no floating point, small stack frames, no recursion. Writes OUT_DIR/sizes.csv.
"""
import collections
import concurrent.futures
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
STACK_FRAME_LIMIT = 256
CLASS_COUNTS = (8, 16, 32)
FLAGS = ["-std=c99", "-ffreestanding", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion",
         "-Wsign-conversion", "-Wshadow", "-Wcast-qual", "-Wundef", "-Werror", "-fstack-usage",
         "-fcallgraph-info=su", "-save-temps=obj", f"-I{ROOT}/lib/include", f"-I{ROOT}/lib/src"]

Target = collections.namedtuple("Target", "name tools flags float_mnemonic")
ARM_FLOAT = r"v\w+(\.\w+)*\.f(16|32|64)"
TARGETS = (
    Target("host", "", ["-O2"],
           r"f\w+|v?cvt\w+|v?(add|sub|mul|div|sqrt|min|max|rcp|rsqrt|hadd|hsub|u?comi|cmp\w*"
           r"|fn?m(add|sub)\d+)[sp][sd]"),
    Target("cortex-m0", "arm-none-eabi-", ["-mcpu=cortex-m0", "-mthumb", "-Os"], ARM_FLOAT),
    Target("cortex-m4", "arm-none-eabi-",
           ["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16", "-Os"],
           ARM_FLOAT),
    Target("cortex-m55", "arm-none-eabi-",
           ["-mcpu=cortex-m55", "-mthumb", "-mfloat-abi=hard", "-Os"], ARM_FLOAT),
    Target("rv32imc", "riscv64-unknown-elf-", ["-march=rv32imc", "-mabi=ilp32", "-Os"],
           r"f(?!ence)\w+\.[sdhw]\w*(\.\w+)?"),
)
# What a compiler may call by itself: copying, integer division by a variable, 64-bit products and
# shifts, bit counts. 64-bit division is not among them: it takes a thousand cycles on a small core.
HELPERS = re.compile(
    r"mem(cpy|set|move|cmp)|__aeabi_mem(cpy|set|move|clr)[48]?"
    r"|__aeabi_u?idiv(mod)?|__aeabi_(lmul|llsl|llsr|lasr)|__gnu_thumb1_case_\w+"
    r"|__u?(div|mod)si3|__(mul|ashl|ashr|lshr)di3|__mulsi3|__(clz|ctz|popcount)[sd]i2")


class Report:
    """Counts checks and prints the faults among them."""

    def __init__(self):
        self.passed = self.failed = self.skipped = 0

    def check(self, good, fault):
        if good:
            self.passed += 1
        else:
            self.failed += 1
            print(f"wrong: {fault}")


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=False)


def compile_one(job):
    """Compiles one source; returns the job and what the compiler said if it failed."""
    target, classes, source, stem = job
    result = run(target.tools + "gcc", *target.flags, *FLAGS, f"-DPEL_CLASS_MAX={classes}", "-c",
                 source, "-o", f"{stem}.o")
    return job, result.stderr if result.returncode else ""


def stack_frames(stem):
    """Yields function, bytes, kind from the compiler's stack usage file."""
    for line in stem.with_suffix(".su").read_text().splitlines():
        place, size, kind = line.split("\t")
        yield place.rsplit(":", 1)[1], int(size), kind


def call_graph(stems):
    """Who calls whom and the frame of each function, out of the compiler's graph files."""
    calls, frames = collections.defaultdict(set), {}
    for stem in stems:
        text = stem.with_suffix(".ci").read_text()
        for title, size in re.findall(r'node: \{ title: "([^"]+)" label: "[^"]*?(\d+) bytes', text):
            frames[title] = int(size)
        for caller, callee in re.findall(r'sourcename: "([^"]+)" targetname: "([^"]+)"', text):
            calls[caller].add(callee)
    return calls, frames


def deepest(name, calls, frames, path=()):
    """Bytes of stack of the deepest chain of calls from here down; None if calls go in a ring."""
    if name in path:
        return None
    depths = [deepest(callee, calls, frames, path + (name,)) for callee in calls[name]]
    return None if None in depths else frames.get(name, 0) + max(depths, default=0)


def symbols(target, objects, *options):
    """Yields the fields of nm's lines: value or nothing, kind, name."""
    for line in run(target.tools + "nm", *options, *objects).stdout.splitlines():
        fields = line.split()
        if len(fields) >= 2 and not line.endswith(":"):
            yield fields


def sizes(target, stem):
    """text (with constants), data, bss."""
    line = run(target.tools + "size", stem.with_suffix(".o")).stdout.splitlines()[1]
    return tuple(int(field) for field in line.split()[:3])


def float_lines(target, stem):
    """The instructions of the compiler's assembly text that work on floating-point numbers."""
    mnemonic = re.compile(rf"\s+({target.float_mnemonic})\s")
    return [line.strip() for line in stem.with_suffix(".s").read_text().splitlines()
            if mnemonic.match(line + " ")]


def check_objects(report, target, stems, where):
    """All checks of one build of the library; returns the sizes and the deepest stack."""
    rows = {}
    for stem in stems:
        text, data, bss = sizes(target, stem)
        rows[stem.name] = (text, data, bss)
        report.check(data == 0 and bss == 0, f"{where}: {stem.name}: data {data}, bss {bss}")
        floats = float_lines(target, stem)
        report.check(not floats, f"{where}: {stem.name}: floating point: {floats[:3]}")
        for function, size, kind in stack_frames(stem):
            # "dynamic,bounded" is a frame that pushes arguments: its size is the most it can be.
            report.check(size < STACK_FRAME_LIMIT and kind != "dynamic",
                         f"{where}: {function}: stack frame of {size} bytes, {kind}")

    objects = [stem.with_suffix(".o") for stem in stems]
    defined = {fields[-1] for fields in symbols(target, objects, "-g", "--defined-only")}
    report.check(len(defined) > 40, f"{where}: only {len(defined)} symbols")
    for name in sorted(defined):
        report.check(name.startswith("pel_"), f"{where}: symbol without the prefix: {name}")
    for fields in symbols(target, objects, "-u"):
        name = fields[-1]
        if name not in defined:
            report.check(HELPERS.fullmatch(name), f"{where}: calls {name}")

    calls, frames = call_graph(stems)
    depths = {name: deepest(name, calls, frames) for name in frames}
    report.check(len(frames) > 40, f"{where}: the call graph has only {len(frames)} functions")
    for name, depth in depths.items():
        report.check(depth is not None, f"{where}: {name} comes back to itself")
    return rows, max((depth for depth in depths.values() if depth), default=0)


def check_memory(report, target, out):
    """The memory budget holds with this target's pointers: its file does not compile otherwise."""
    stem = out / target.name / "memory"
    result = run(target.tools + "gcc", *target.flags, *FLAGS, "-c", ROOT / "tests/size/memory.c",
                 "-o", f"{stem}.o")
    found = [int(fields[1], 16) for fields in symbols(target, [f"{stem}.o"], "-S")
             if fields[-1] == "robot_memory" and len(fields) == 4] if not result.returncode else []
    report.check(len(found) == 1, f"{target.name}: memory.c: {result.stderr or 'no size'}")
    return found[0] if found else 0


def compile_all(report, target, sources, out):
    """Compiles for every number of classes; returns the stems of the objects by number."""
    jobs = []
    for classes in CLASS_COUNTS:
        folder = out / target.name / str(classes)
        folder.mkdir(parents=True, exist_ok=True)
        jobs += [(target, classes, source, folder / pathlib.Path(source).stem)
                 for source in sources]
    good = collections.defaultdict(list)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (_, classes, source, stem), fault in pool.map(compile_one, jobs):
            report.check(not fault, f"{target.name}, {classes} classes: {source}:\n{fault}")
            if not fault:
                good[classes].append(stem)
    return good


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    sources = sys.argv[2:]
    report = Report()
    table = []
    for target in TARGETS:
        if not shutil.which(target.tools + "gcc"):
            report.skipped += 1
            print(f"{target.name}: skipped, there is no {target.tools}gcc")
            continue
        version = run(target.tools + "gcc", "-dumpfullversion").stdout.strip()
        stems = compile_all(report, target, sources, out)
        for classes in CLASS_COUNTS:
            rows, stack = check_objects(report, target, stems[classes],
                                        f"{target.name}, {classes} classes")
            table += [(target.name, version, classes, module, *row)
                      for module, row in rows.items()]
            if classes == CLASS_COUNTS[0]:
                total = [sum(row[i] for row in rows.values()) for i in range(3)]
                memory = check_memory(report, target, out)
                table += [(target.name, version, classes, "(stack)", stack, 0, 0),
                          (target.name, version, classes, "(memory)", memory, 0, 0)]
                for module, row in rows.items():
                    print(f"{target.name:12} {module:12} text {row[0]:6} data {row[1]} "
                          f"bss {row[2]}")
                print(f"{target.name:12} {'all':12} text {total[0]:6} data {total[1]} "
                      f"bss {total[2]}; deepest stack {stack}; 320x240 memory {memory}")

    with open(out / "sizes.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("target", "gcc", "classes", "module", "text", "data", "bss"))
        writer.writerows(table)
    print(f"{report.passed} passed, {report.failed} failed"
          + (f", {report.skipped} skipped" if report.skipped else ""))
    return 1 if report.failed or report.passed == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
