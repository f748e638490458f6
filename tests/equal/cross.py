#!/usr/bin/env python3
"""The comparisons of this folder on a processor that the building machine is not, in its emulator.

    cross.py MACHINE BACKEND OUT_DIR

MACHINE is a file of tests/target/machines, which names the compiler and the emulator; BACKEND is
what must have been compared there.
"""
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / "tests/target"), str(ROOT / "tools/dev")]
import matrix  # noqa: E402
import project  # noqa: E402

FLAGS = ["-std=c99", "-O2", "-static", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion",
         "-Wsign-conversion", "-Wshadow", "-Wcast-qual", "-Wundef", "-Werror"]
# As users compile it; and so that undefined behaviour ends the program, which takes no library.
PROGRAMS = (("equal", []),
            ("equal-undefined", ["-fsanitize=undefined", "-fsanitize-undefined-trap-on-error"]))


def build(compiler, flags, program):
    """Whether there is a program; if not, the compiler has said why."""
    program.unlink(missing_ok=True)
    sources = project.sources(ROOT) + sorted(HERE.glob("*.c"))
    return subprocess.run([compiler, *FLAGS, *flags, f"-I{ROOT}/lib/include", f"-I{ROOT}/lib/src",
                           *sources, "-o", program], stderr=subprocess.STDOUT).returncode == 0


def compare(emulator, program, seed, backend):
    """How many comparisons passed and failed."""
    done = subprocess.run([emulator, program, str(seed)], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    closing = re.search(r"^(\d+) passed, (\d+) failed\n\Z", done.stdout, re.M)
    print(done.stdout[:closing.start() if closing else None], end="")
    if not closing or not re.search(rf"^{backend}: [1-9]\d* comparisons", done.stdout, re.M):
        print(f"wrong: ended with {done.returncode}, not having compared {backend}")
        return 0, 1
    return int(closing.group(1)), int(closing.group(2)) or int(done.returncode != 0)


def main():
    name, backend, out = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    compiler, emulator = matrix.machines()[name].programs
    passed = failed = 0

    if not shutil.which(compiler):
        print(f"skipped: no {compiler} here\n0 passed, 0 failed, 1 skipped")
        return 0
    out.mkdir(parents=True, exist_ok=True)
    for seed, (program, flags) in enumerate(PROGRAMS, 1):
        if not shutil.which(emulator) or not build(compiler, flags, out / program):
            print(f"wrong: no {emulator} here, or {program} not compiled")
            failed += 1
            continue
        good, bad = compare(emulator, out / program, seed, backend)
        passed += good
        failed += bad
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
