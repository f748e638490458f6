#!/usr/bin/env python3
"""How far the chain and the 3x3 filters are from copying memory, and ahead of OpenCV.

    ratios.py PEL TABLE.txt [RUNS]

Runs `pel bench`, which compares all results before it times any, and prints its ratios, each beside
what pel aims at: times of AVX2 over those of copying the same frame, and OpenCV's times over those
of the best backend. Both are measured twice: with 16 copies of the frame that take turns, as the
buffers of a camera do, and with the same frame again and again, which lies in the cache. Times of
machines that do other things as well decide nothing: this fails where results differ or where
something was not measured, not where an aim is missed. The table goes into the file, too.
"""
import csv
import io
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SIZE = "640x480"
COLUMNS = {"16": "ring of 16", "1": "same frame"}  # by --frames
NO_AIM = None
# What others call the size of Sobel's gradient is |gx| + |gy|, so that has the aim; the root of the
# squares is shown for comparison.
COPIES = {("blobs", "synth"): 3, ("blobs", "china"): 6, ("blobs", "rand4"): 12,
          ("blobs", "rand1"): 60, ("gauss3", "synth"): 2.5, ("sobel-x", "synth"): 3,
          ("gradient-abs", "synth"): 6, ("gradient", "synth"): NO_AIM}
TIMES_OPENCV = {("blobs", "synth"): 100, ("blobs", "china"): 25, ("gauss3", "synth"): 2,
                ("sobel-x", "synth"): 2, ("gradient-abs", "synth"): 2,
                ("gradient", "synth"): NO_AIM, ("kernel3", "synth"): 2, ("median", "synth"): 2,
                ("min", "synth"): 2}


def bench(pel, runs, *choice):
    """Rows of both columns, measured one right after the other."""
    rows = []
    for frames in COLUMNS:
        done = subprocess.run([pel, "bench", "--csv", "--python", sys.executable, "--runs", runs,
                               "--frames", frames, *choice], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"pel bench {' '.join(map(str, choice))}: status {done.returncode}\n"
                     f"{done.stderr}")
        rows += csv.DictReader(io.StringIO(done.stdout))
    return rows


def make_photo(folder):
    path = folder / "china.yuyv"
    done = subprocess.run([sys.executable, HERE / "photos.py", "china", SIZE, path],
                          capture_output=True, text=True)
    return path if done.returncode == 0 else None


def measure(pel, runs):
    rows = []
    for operator in dict.fromkeys(operator for operator, _ in TIMES_OPENCV):
        inputs = "synth,rand4,rand1" if operator == "blobs" else "synth"
        rows += bench(pel, runs, "--operator", operator, "--input", inputs)
    with tempfile.TemporaryDirectory() as name:
        photo = make_photo(Path(name))
        if photo:
            rows += bench(pel, runs, "--operator", "blobs", "--input", "none", "--raw", "YUYV",
                          SIZE, photo)
    return rows


def line_of(name, found, aim, is_met):
    """`found`: of each column the figure and the backend that has it."""
    backends = "/".join(dict.fromkeys(backend for _, backend in found))
    line = f"  {name + ', ' + backends:38}" + "".join(f"{figure:12.1f}" for figure, _ in found)
    if aim is NO_AIM:
        return f"{line}{'-':>8}"
    missed = [column for column, (figure, _) in zip(COLUMNS.values(), found)
              if not is_met(figure, aim)]
    note = "  missed" if len(missed) == len(COLUMNS) else f"  missed: {missed[0]}" if missed else ""
    return f"{line}{aim:8g}{note}"


def table(title, aims, figure_of, is_met):
    """The lines of a table, and what is missing in it."""
    lines = [f"{title:40}" + "".join(f"{column:>12}" for column in COLUMNS.values())
             + f"{'aim':>8}"]
    missing = []
    for (operator, source), aim in aims.items():
        found = [figure_of(operator, source, frames) for frames in COLUMNS]
        if None in found:
            missing.append(f"{operator} of {source}")
        else:
            lines.append(line_of(f"{operator}, {source}", found, aim, is_met))
    return lines, missing


def tables(rows):
    def of(*wanted):
        return [row for row in rows if (row["operator"], row["input"], row["frames"]) == wanted]

    def copies(*wanted):
        found = [row for row in of(*wanted) if row["backend"] == "avx2"]
        return (float(found[0]["ratio_to_memcpy"]), "avx2") if found else None

    def times_opencv(*wanted):
        found = [row for row in of(*wanted) if row["speedup_over_opencv"]]
        best = max(found, key=lambda row: float(row["speedup_over_opencv"]), default=None)
        return (float(best["speedup_over_opencv"]), best["backend"]) if best else None

    lines, missing = table("times OpenCV", TIMES_OPENCV, times_opencv,
                           lambda figure, aim: figure >= aim)
    if any(row["backend"] == "avx2" for row in rows):
        more, lacking = table("copies of the frame", COPIES, copies,
                              lambda figure, aim: figure <= aim)
        lines, missing = more + lines, lacking + missing
    return lines, missing


def main():
    rows = measure(sys.argv[1], sys.argv[3] if len(sys.argv) > 3 else "200")
    lines, missing = tables(rows)
    text = "".join(line + "\n" for line in lines)
    Path(sys.argv[2]).write_text(text, encoding="utf-8")
    print(text, end="")
    for what in missing:
        print(f"FAIL  not measured: {what}")
    measured = sum(line.startswith("  ") for line in lines)
    print(f"{measured} passed, {len(missing)} failed")
    return 1 if missing or not measured else 0


if __name__ == "__main__":
    sys.exit(main())
