#!/usr/bin/env python3
"""The scripts that judge the project see what they are there to see.

    check_scripts.py OUT_DIR
"""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(os.environ["PEL_SOURCE_DIR"])

passed = failed = 0


def check(good, what, detail=""):
    global passed, failed
    passed += bool(good)
    failed += not good
    if not good:
        print(f"wrong: {what}\n{detail}")


def run(*command, **variables):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False, cwd=ROOT,
                          env=dict(os.environ, **variables))


def make_program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#!/bin/sh\n" + text)
    path.chmod(0o755)
    return path


def check_summary():
    summary = ROOT / "tools/dev/summary.py"
    done = run(sys.executable, summary, "--check", "a:passed", "--check", "b:skipped")
    check(done.returncode == 0 and done.stdout.endswith("\n1 passed, 0 failed, 1 skipped\n"),
          "a skipped check is counted", done.stdout)
    done = run(sys.executable, summary, "--check", "a:passed", "--check", "b:failed")
    check(done.returncode == 1 and done.stdout.endswith("\n1 passed, 1 failed\n"),
          "a failed check is counted", done.stdout)
    done = run(sys.executable, summary, "--check", "b:skipped")
    check(done.returncode == 1, "nothing but skips is no success", done.stdout)


def check_sanitizers(out):
    """Without the sanitizers' libraries a visible line says so."""
    script = ('. tools/dev/need.sh; '
              'if sanitizes "$0" "$1"; then echo yes; else say_unsanitized cc; fi')
    without = make_program(out / "without/cc", 'case "$*" in *sanitize*) exit 1 ;; esac\n')
    done = run("sh", "-c", script, without, out / "a.out")
    check(done.stdout.startswith("SKIPPED: cc ") and "libasan" in done.stdout
          and done.stdout.count("\n") == 1, "a compiler without sanitizers", done.stdout)
    done = run("sh", "-c", script, make_program(out / "with/cc", "exit 0\n"), out / "a.out")
    check(done.stdout == "yes\n", "a compiler with sanitizers", done.stdout)


def check_format(out):
    """Long lines are found in every kind of source; clang-format is that beside PEL_PYTHON."""
    plain = make_program(out / "plain/clang-format",
                         '[ "$1" != --version ] || { echo version 14.0.6; exit; }\ncat "$1"\n')
    other = make_program(out / "other/clang-format",
                         '[ "$1" != --version ] || { echo version 14.0.6; exit; }\necho other\n')
    good = "# " + "\u00e4" * 98 + "\n"
    for ending in ("py", "sh", "c", "h", "cpp"):
        path = out / f"text.{ending}"
        for text, wanted in ((good, "1 passed, 0 failed"), (good + good[:-1] + "x\n",
                                                            "0 passed, 1 failed")):
            path.write_text(text, encoding="utf-8")
            done = run("sh", "tools/dev/format.sh", path, PEL_PYTHON=str(plain.parent / "python"))
            check(done.stdout.endswith(wanted + "\n"), f"lines of a .{ending}", done.stdout)
            check(("line 2" in done.stdout) == (text != good), f"line of a .{ending}", done.stdout)
    path.write_text("int x;\n")
    done = run("sh", "tools/dev/format.sh", path, PEL_PYTHON=str(other.parent / "python"))
    check(done.returncode == 1 and "not formatted" in done.stdout,
          "clang-format of the Python environment", done.stdout)
    pinned = [line for line in (ROOT / "tests/requirements.txt").read_text().splitlines()
              if line.startswith("clang-format==14.")]
    check(len(pinned) == 1, "tests/requirements.txt pins the release")


def load_instructions():
    place = importlib.util.spec_from_file_location("instructions",
                                                   ROOT / "tests/bench/instructions.py")
    module = importlib.util.module_from_spec(place)
    place.loader.exec_module(module)
    return module


def check_readme_table(out):
    """The README's benchmark table is held to what is measured."""
    bench = load_instructions()
    text = (ROOT / "README.md").read_text()
    lines, _ = bench.read_markdown(ROOT / "README.md")
    rows = [{"input": name, "blobs": int(cells[0].split()[-2]),
             **{level: float(cell) for level, cell in zip(bench.LEVELS, cells[1:-1])},
             "cmvision": bench.INPUTS[name].cmvision, "compiler": "gcc-12.9.9"}
            for name, cells in lines.items()]

    def judge(rows, text):
        path = out / "README.md"
        path.write_text(text)
        tally = bench.Tally()
        bench.check_readme(tally, path, rows, list(lines))
        return tally.passed > 0, tally.failed, tally.skipped

    check(judge(rows, text) == (True, 0, 0), "the table as it is", judge(rows, text))
    check(judge([dict(row, all=1.1 * row["all"]) for row in rows], text) == (True, 5, 0),
          "a tenth more")
    check(judge([dict(row, basic=0.9 * row["basic"]) for row in rows], text) == (True, 5, 0),
          "a tenth less: the table is out of date")
    check(judge([dict(row, compiler="gcc-99.1.0", all=99.0) for row in rows], text)
          == (True, 0, 5), "another compiler")
    check(judge(rows, text.replace("679 blobs", "678 blobs"))[1] == 1, "another number of blobs")
    check(judge(rows, text.replace("| 67.2 |", "| 68.2 |"))[1] == 1, "another figure of CMVision")
    check(judge(rows[:4], text.replace("| cat:", "| dog:"))[1] == 1, "another input")


def main():
    out = pathlib.Path(sys.argv[1]).resolve() / "scripts"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    check_summary()
    check_sanitizers(out)
    check_format(out)
    check_readme_table(out)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or passed == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
