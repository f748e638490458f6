"""What the scripts of this folder share: the cores, the compilers' flags, a count of checks."""
import collections
import concurrent.futures
import os
import pathlib
import re
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow",
            "-Wcast-qual", "-Wundef", "-Werror"]
FLAGS = ["-std=c99", "-ffreestanding", *WARNINGS, f"-I{ROOT}/lib/include", f"-I{ROOT}/lib/src"]

Target = collections.namedtuple("Target", "name tools flags float_mnemonic")
ARM_FLOAT = r"v\w+(\.\w+)*\.f(16|32|64)"
HOST = Target("host", "", ["-O2"],
              r"f\w+|v?cvt\w+|v?(add|sub|mul|div|sqrt|min|max|rcp|rsqrt|hadd|hsub|u?comi|cmp\w*"
              r"|fn?m(add|sub)\d+)[sp][sd]")


def cortex(name, *flags):
    return Target(f"cortex-{name}", "arm-none-eabi-",
                  [f"-mcpu=cortex-{name}", "-mthumb", *flags, "-Os"], ARM_FLOAT)


# The cores of the boards in ports/baremetal/boards, with the flags of those.
CORES = (
    cortex("m0"),
    cortex("m3"),
    cortex("m4", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"),
    cortex("m7", "-mfloat-abi=hard", "-mfpu=fpv5-d16"),
    cortex("m33", "-mfloat-abi=hard", "-mfpu=fpv5-sp-d16"),
    cortex("m55", "-mfloat-abi=hard"),
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

    def skip(self, why):
        self.skipped += 1
        print(f"skipped: {why}")

    def close(self):
        """Prints the last line; returns the exit status."""
        print(f"{self.passed} passed, {self.failed} failed"
              + (f", {self.skipped} skipped" if self.skipped else ""))
        return 1 if self.failed or self.passed == 0 else 0


def run(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=False, **options)


def version(tools):
    return "gcc " + run(tools + "gcc", "-dumpfullversion").stdout.strip()


def library_sources():
    """The sources of the library, from its only list."""
    text = (ROOT / "lib/pel_files.cmake").read_text()
    return [ROOT / "lib" / name for name in re.findall(r"\$\{PEL_LIB_DIR\}/(\S+\.c)", text)]


def compile_one(job):
    """Compiles one source to STEM.o; returns the job and what the compiler said if it failed."""
    target, options, source, stem = job
    result = run(target.tools + "gcc", *target.flags, *FLAGS, *options, "-c", source,
                 "-o", f"{stem}.o")
    return job, result.stderr if result.returncode else ""


def compile_all(report, target, options, sources, folder):
    """Compiles into a folder, in parallel; returns the stems of the objects."""
    folder.mkdir(parents=True, exist_ok=True)
    jobs = [(target, options, source, folder / pathlib.Path(source).stem) for source in sources]
    good = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (_, _, source, stem), fault in pool.map(compile_one, jobs):
            report.check(not fault, f"{target.name}: {source} {' '.join(options)}:\n{fault}")
            if not fault:
                good.append(stem)
    return good


def symbols(target, objects, *options):
    """Yields the fields of nm's lines: value or nothing, kind, name."""
    for line in run(target.tools + "nm", *options, *objects).stdout.splitlines():
        fields = line.split()
        if len(fields) >= 2 and not line.endswith(":"):
            yield fields


def sizes(target, path):
    """text (with constants), data, bss."""
    line = run(target.tools + "size", path).stdout.splitlines()[1]
    return tuple(int(field) for field in line.split()[:3])
