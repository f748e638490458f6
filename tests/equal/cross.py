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


def build(compiler, out):
    """The program, or None and the compiler's words on standard output."""
    out.mkdir(parents=True, exist_ok=True)
    program = out / "equal"
    program.unlink(missing_ok=True)
    sources = project.sources(ROOT) + sorted(HERE.glob("*.c"))
    done = subprocess.run([compiler, *FLAGS, f"-I{ROOT}/lib/include", f"-I{ROOT}/lib/src",
                           *sources, "-o", program], stdout=sys.stdout, stderr=subprocess.STDOUT)
    return program if done.returncode == 0 else None


def main():
    name, backend, out = sys.argv[1:]
    compiler, emulator = matrix.machines()[name].programs
    if not shutil.which(compiler):
        print(f"skipped: no {compiler} here\n0 passed, 0 failed, 1 skipped")
        return 0
    program = build(compiler, pathlib.Path(out))
    if not program or not shutil.which(emulator):
        print(f"wrong: {f'no {emulator} here' if program else 'not compiled'}")
        print("0 passed, 1 failed")
        return 1
    done = subprocess.run([emulator, program], capture_output=True, text=True)
    compared = re.search(rf"^{backend}: [1-9]\d* comparisons", done.stdout, re.M)
    print(done.stdout + done.stderr, end="")
    if not compared:
        print(f"wrong: nothing compared with {backend}\n0 passed, 1 failed")
    return 0 if compared and done.returncode == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
