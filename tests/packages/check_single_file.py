#!/usr/bin/env python3
"""The library as one file: compiled alone for several machines, as C++ sees it, under the unit
suites.

    check_single_file.py OUT_DIR UNITY_DIR
"""
import sys

from packagetest import (AMALGAMATE, HERE, PACK, PYTHON, ROOT, WARNINGS, check, check_suite, finish,
                         fresh, have, run, skip, step, unit_suites, unity_folder, user_line,
                         version)

BOARD = "mps2-an386"
SANITIZE = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
# The flags under which sources that hold faster row kernels may come to life, too.
HOST_FLAGS = {"x86_64": ([], ["-mssse3"], ["-mavx2"])}
CHIPS = {"Cortex-M4": ("arm-none-eabi-", ["-mcpu=cortex-m4", "-mthumb"]),
         "Cortex-M55": ("arm-none-eabi-", ["-mcpu=cortex-m55", "-mthumb", "-mfloat-abi=hard"]),
         "AArch64": ("aarch64-linux-gnu-", []),
         "RV32IMC": ("riscv64-unknown-elf-", ["-march=rv32imc", "-mabi=ilp32"])}
# What a compiler may call by itself.
HELPERS = ("__aeabi_", "__gnu_", "__clz", "__ctz", "__div", "__udiv", "__mod", "__umod", "__mul",
           "__ashl", "__ashr", "__lshr", "mem")


def check_symbols(program, file):
    """Nothing is exported without the prefix, and nothing is writable data."""
    listed = run(program, "-g", "--defined-only", file).stdout
    lines = [line.split() for line in listed.splitlines()]
    names = [words[-1] for words in lines if len(words) == 3]
    check(len(names) > 50 and all(name.startswith("pel_") for name in names), f"exports of {file}",
          str([name for name in names if not name.startswith("pel_")] or len(names)))
    writable = [words[-1] for words in lines if len(words) == 3 and words[1] in "BDC"]
    check(not writable, f"no writable data in {file}", str(writable))


def check_host(folder):
    for compiler in ("gcc", "clang"):
        if not have(compiler):
            continue
        for classes in (8, 16, 32):
            target = folder / f"{compiler}{classes}.o"
            if step(f"pel.c with {compiler}, {classes} classes", compiler, "-std=c99", "-O2",
                    *WARNINGS, f"-DPEL_CLASS_MAX={classes}", "-c", folder / "pel.c", "-o", target):
                check_symbols("nm", target)
        machine = run(compiler, "-dumpmachine").stdout.split("-")[0]
        for flags in HOST_FLAGS.get(machine, ()):
            step(f"pel.c with {compiler} {flags}", compiler, "-std=c99", "-O2", *WARNINGS, *flags,
                 "-c", folder / "pel.c", "-o", folder / "flags.o")


def check_chips(folder):
    """Compiled for small machines, and calling nothing but the compiler's helpers."""
    for name, (prefix, flags) in CHIPS.items():
        if not have(f"{prefix}gcc"):
            continue
        target = folder / f"{name}.o"
        if step(f"pel.c for {name}", f"{prefix}gcc", *flags, "-ffreestanding", "-Os", "-std=c99",
                *WARNINGS, "-c", folder / "pel.c", "-o", target):
            check_symbols(f"{prefix}nm", target)
            wanted = set(run(f"{prefix}nm", "-u", target).stdout.split()) - {"U"}
            foreign = {word for word in wanted if not word.startswith(HELPERS)}
            check(not foreign, f"{name}: nothing but the compiler's helpers", str(foreign))
    if have("avr-gcc"):
        step("pel.c for AVR", "avr-gcc", "-mmcu=atmega2560", "-Os", "-std=c99", "-Wall", "-Wextra",
             "-Wpedantic", "-Wno-sign-compare", "-Werror", "-c", folder / "pel.c", "-o",
             folder / "avr.o")


def check_user(folder):
    """A user's program and the two files, as the README of the package compiles them."""
    program = folder / "user"
    if step("the user's program", "gcc", "-std=c99", HERE / "user.c", folder / "pel.c",
            f"-I{folder}", "-o", program):
        result = run(program)
        check(result.stdout == user_line(), "the user's program: it runs", result.stdout)


def check_header(folder):
    """pel.h in C and in C++, where a program also calls the library."""
    source = folder / "user.cpp"
    source.write_text('#include "pel.h"\n#include "pel.h"\n#include <cstdio>\n'
                      'int main()\n{\n'
                      '    std::printf("%s %s\\n", PEL_VERSION, pel_version());\n}\n')
    for compiler in ("g++", "clang++"):
        if not have(compiler):
            continue
        program = folder / f"user_{compiler}"
        c_compiler = {"g++": "gcc", "clang++": "clang"}[compiler]
        if step(f"pel.h with {compiler}", compiler, "-std=c++11", *WARNINGS, source, "-x", "none",
                folder / f"{c_compiler}8.o", "-o", program):
            result = run(program)
            check(result.stdout == f"{version()} {version()}\n", "the version, from C++",
                  result.stdout)
    plain = folder / "plain.c"
    plain.write_text('#include "pel.h"\n#include "pel.h"\nint main(void)\n{\n    return 0;\n}\n')
    step("pel.h twice, C99", "gcc", "-std=c99", *WARNINGS, "-fsyntax-only", plain)


def sanitizers(folder):
    """The flags of the sanitizers, none if the compiler cannot link them."""
    probe = folder / "probe.c"
    probe.write_text("int main(void)\n{\n    return 0;\n}\n")
    if run("gcc", *SANITIZE, probe, "-o", folder / "probe").returncode == 0:
        return SANITIZE
    skip("the sanitizers of gcc")
    return []


def check_suites(folder, unity):
    """Every unit suite, with nothing of the project on the include path but the two files."""
    library = folder / "suites.o"
    for header in (ROOT / "lib/include/pel").glob("*.h"):  # for suites that name just one
        (folder / "pel").mkdir(exist_ok=True)
        (folder / "pel" / header.name).write_text("#include <pel.h>\n")
    flags = ["-std=c99", "-O1", "-g", *sanitizers(folder)]
    step("pel.c for the suites", "gcc", *flags, "-c", folder / "pel.c", "-o", library)
    step("Unity", "gcc", "-O1", "-c", unity / "unity.c", "-o", folder / "unity.o")
    for suite in unit_suites():
        program = folder / suite.stem
        if step(f"{suite.name}: compile", "gcc", *flags, f"-I{folder}", f"-I{unity}", suite,
                library, folder / "unity.o", "-o", program):
            check_suite(suite.name, run(program))


def check_m4_suites(folder, unity):
    """Every unit suite on an emulated Cortex-M4."""
    if not have("arm-none-eabi-gcc", "qemu-system-arm"):
        return
    build = folder / "m4"
    if not step("Cortex-M4: configure", "cmake", "-S", HERE / "m4", "-B", build,
                f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/ports/baremetal/toolchain.cmake",
                f"-DPEL_BOARD={BOARD}", f"-DPEL_SINGLE_DIR={folder}",
                f"-DPEL_UNITY_SOURCES={unity}", "-G", "Unix Makefiles"):
        return
    # A suite that does not compile leaves the others standing.
    step("Cortex-M4: build", "cmake", "--build", build, "--parallel", "2", "--", "-k")
    for suite in unit_suites():
        images = [path for path in (build / suite.stem, build / f"{suite.stem}.elf")
                  if path.is_file()]
        if check(images, f"{suite.name}: there is an image for {BOARD}"):
            check_suite(f"{suite.name} on {BOARD}", run("sh", build / "run.sh", images[0]))


def main():
    folder = fresh("single-file")
    packed = fresh("single-file-packed")
    if step("amalgamate", PYTHON, AMALGAMATE, folder) and \
            step("pack", PYTHON, PACK, "single-file", packed):
        for name in ("pel.c", "pel.h"):
            check((folder / name).read_bytes() == (packed / name).read_bytes(),
                  f"{name} is the same every time")
        check_host(folder)
        check_chips(folder)
        check_header(folder)
        check_user(folder)
        check_suites(folder, unity_folder())
        check_m4_suites(folder, unity_folder())
    return finish()


if __name__ == "__main__":
    sys.exit(main())
