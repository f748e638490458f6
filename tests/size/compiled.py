#!/usr/bin/env python3
"""Compiles the library as firmware does and looks at what came out, target by target.

    compiled.py OUT_DIR SOURCE.c...

For 8, 16 and 32 classes: no writable data, no symbol without the prefix, no call out of the library
but to the compiler's own integer helpers, no floating point, small stack frames, no recursion. How
large it all is, budgets.py says. What differs for the vector kernels of x86 stands under HOST.
"""
import pathlib
import re
import shutil
import sys

import firmware
import stack

STACK_FRAME_LIMIT = 256
CLASS_COUNTS = (8, 16, 32)
OPTIONS = ["-fstack-usage", "-fcallgraph-info=su", "-save-temps=obj"]
# One of each kind of core; budgets.py compiles for all.
TARGETS = [firmware.HOST] + [core for core in firmware.CORES if core.name in
                             ("cortex-m0", "cortex-m4", "cortex-m55", "rv32imc")]

# HOST: what only files that are empty on microcontrollers may do.
#
# Kernels with taps or tables hold more vectors than there are registers (of 5 x 5 taps 20, of up to
# 64 bytes each), and a host's stack has megabytes.
VECTOR_FRAME_LIMIT = 1536
# Root and quotient of whole numbers below 2^22 in single precision are exact after truncation: both
# instructions are correctly rounded, see row_filter_template.h; equal_filter.c tries all roots.
# Reciprocals only make guesses that whole numbers put right, see row_filter_rows_template.h. For
# squares and roots in double precision see row_feature_tensor_template.h and equal_feature.c.
EXACT_FLOATS = (r"v?(cvtdq2ps|cvttps2dq|sqrtps|divps|rcp(14)?ps|rsqrt(14)?ps|addps|"
                r"cvtdq2pd|cvttpd2dqy?|addpd|subpd|mulpd|sqrtpd)")
FLOAT_FILES = re.compile(r"row_(filter|point|feature)_(ssse3|avx2|avx512)")
VECTOR_FILES = re.compile(r"row_(filter_|point_|feature_|color_)?(ssse3|avx2|avx512)")
# What the compiler's start-up code found out about the processor, and how shared objects get there.
HOST_SYMBOLS = ("__cpu_model", "_GLOBAL_OFFSET_TABLE_")


def is_one_of(names, target, stem):
    return target is firmware.HOST and names.fullmatch(stem.name)


def stack_frames(stem):
    """Yields function, bytes, kind from the compiler's stack usage file."""
    for line in stem.with_suffix(".su").read_text().splitlines():
        place, size, kind = line.split("\t")
        yield place.rsplit(":", 1)[1], int(size), kind


def float_lines(target, stem):
    """The instructions of the compiler's assembly text that work on floating-point numbers."""
    mnemonic = re.compile(rf"\s+({target.float_mnemonic})\s")
    return [line.strip() for line in stem.with_suffix(".s").read_text().splitlines()
            if mnemonic.match(line + " ")]


def check_objects(report, target, stems, where):
    """All checks of one build of the library; returns the bytes of text."""
    total = 0
    for stem in stems:
        text, data, bss = firmware.sizes(target, f"{stem}.o")
        total += text
        report.check(data == 0 and bss == 0, f"{where}: {stem.name}: data {data}, bss {bss}")
        is_vector_file = is_one_of(VECTOR_FILES, target, stem)
        limit = VECTOR_FRAME_LIMIT if is_vector_file else STACK_FRAME_LIMIT
        floats = [line for line in float_lines(target, stem) if not
                  (is_one_of(FLOAT_FILES, target, stem) and re.match(EXACT_FLOATS + r"\s", line))]
        report.check(not floats, f"{where}: {stem.name}: floating point: {floats[:3]}")
        for function, size, kind in stack_frames(stem):
            # "dynamic,bounded" is a frame that pushes arguments: its size is the most it can be.
            report.check(size < limit and kind != "dynamic",
                         f"{where}: {function}: stack frame of {size} bytes, {kind}")

    objects = [f"{stem}.o" for stem in stems]
    defined = {fields[-1] for fields in firmware.symbols(target, objects, "-g", "--defined-only")}
    report.check(len(defined) > 40, f"{where}: only {len(defined)} symbols")
    for name in sorted(defined):
        report.check(name.startswith("pel_"), f"{where}: symbol without the prefix: {name}")
    for fields in firmware.symbols(target, objects, "-u"):
        name = fields[-1]
        if name not in defined:
            known = target is firmware.HOST and name in HOST_SYMBOLS
            report.check(known or firmware.HELPERS.fullmatch(name), f"{where}: calls {name}")

    graph = stack.Graph(stems)
    faults, _ = graph.resolve()
    report.check(not faults, f"{where}: {'; '.join(faults)}")
    report.check(len(graph.frames) > 40,
                 f"{where}: the call graph has only {len(graph.frames)} functions")
    rings = graph.rings()
    for name in graph.frames:
        report.check(name not in rings, f"{where}: {name} comes back to itself")
    return total


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    sources = sys.argv[2:]
    report = firmware.Report()
    for target in TARGETS:
        if not shutil.which(target.tools + "gcc"):
            report.skip(f"{target.name}: there is no {target.tools}gcc")
            continue
        for classes in CLASS_COUNTS:
            options = OPTIONS + [f"-DPEL_CLASS_MAX={classes}"]
            stems = firmware.compile_all(report, target, options, sources,
                                         out / target.name / str(classes))
            text = check_objects(report, target, stems, f"{target.name}, {classes} classes")
            print(f"{target.name:12} {classes:2} classes: text {text}")
    return report.close()


if __name__ == "__main__":
    sys.exit(main())
