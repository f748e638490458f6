#!/usr/bin/env python3
"""The library on an 8-bit AVR, where int, size_t and pointers have 16 bits: it compiles without the
warnings that tell of wrapped arithmetic, and the unit suites run in simavr on an ATmega2560, but
for those that need more than its 8 KiB of RAM.

    check_avr.py OUT_DIR UNITY_DIR
"""
import re
import sys

from packagetest import (HERE, ROOT, UNITY_CONFIG, avr_simulator, check, check_suite, finish, fresh,
                         library_sources, run, skip, step, unit_suites, unity_folder)

MCU, CYCLES_MAX = "atmega2560", "8000000000"
RAM_BYTES, STACK_BYTES = 8192, 1536  # a suite needs that much stack beside its variables
FLAGS = [f"-mmcu={MCU}", "-std=c99", "-Os", "-ffunction-sections", "-fdata-sections"]
# What tells of lost bits. Not -Wsign-compare: where uint16_t is unsigned int and not a part of int,
# it speaks of every loop that counts to a width.
LOST_BITS = ["-Wall", "-Wextra", "-Wpedantic", "-Woverflow", "-Wshift-count-overflow",
             "-Wno-sign-compare", "-Werror"]


def compile_library(folder):
    objects = []
    for source in library_sources():
        target = folder / (source.replace("/", "_")[:-2] + ".o")
        if step(f"{source} for AVR", "avr-gcc", *FLAGS, *LOST_BITS, f"-I{ROOT}/lib/include",
                f"-I{ROOT}/lib/src", "-c", ROOT / "lib/src" / source, "-o", target):
            objects.append(target)
    return objects


def fits(program):
    """Whether variables and stack have room; a suite that is too large is counted as skipped."""
    sizes = re.search(r"^\s*\d+\s+(\d+)\s+(\d+)\s", run("avr-size", program).stdout, re.M)
    if not check(sizes, f"{program.name}: avr-size"):
        return False
    variables = sum(map(int, sizes.groups()))
    if variables + STACK_BYTES > RAM_BYTES:
        skip(f"{program.stem}: with {variables} bytes of variables too large for {MCU}")
        return False
    return True


def main():
    folder, unity = fresh("avr"), unity_folder()
    runner = avr_simulator(folder)
    if not runner:
        return finish()
    flags = FLAGS + [f"-I{UNITY_CONFIG}", f"-I{unity}", "-DUNITY_INCLUDE_CONFIG_H"]
    objects = compile_library(folder)
    for source in (unity / "unity.c", HERE / "avr/suite.c"):
        objects.append(folder / f"{source.stem}.o")
        step(f"{source.name} for AVR", "avr-gcc", *flags, "-c", source, "-o", objects[-1])
    ran = 0
    suites = unit_suites()
    for suite in suites:
        program = folder / f"{suite.stem}.elf"
        if not step(f"{suite.name} for AVR", "avr-gcc", *flags, f"-I{ROOT}/lib/include",
                    "-Dmain=pel_suite_main", "-Wl,--gc-sections", suite, *objects, "-o",
                    program) or not fits(program):
            continue
        ran += 1
        result = run(runner, program, CYCLES_MAX)
        check_suite(f"{suite.name} on {MCU}", result)
        memory = re.search(r"RAM: (.*)", result.stdout)
        if check(result.returncode == 0 and memory, f"{suite.name}: ended well",
                 result.stdout[-2000:]):
            print(f"{suite.stem}: {memory.group(1)}")
    check(2 * ran > len(suites), f"most suites fit {MCU}", f"{ran} of {len(suites)}")
    return finish()


if __name__ == "__main__":
    sys.exit(main())
