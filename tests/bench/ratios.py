#!/usr/bin/env python3
"""How far the chain and the 3x3 filters are from copying memory, and ahead of OpenCV.

    ratios.py PEL TABLE.txt [RUNS]

Runs `pel bench`, which compares all results before it times any, and prints its ratios, each beside
what pel aims at: times of AVX2 over those of copying the same frame, and OpenCV's times over those
of the best backend. Times of machines that do other things as well decide nothing: this fails
where results differ or where something was not measured, not where an aim is missed. The table goes
into the file, too.
"""
import csv
import io
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SIZE = "640x480"
COPIES = {("blobs", "synth"): 3, ("blobs", "china"): 6, ("blobs", "rand4"): 12,
          ("blobs", "rand1"): 60, ("gauss3", "synth"): 2.5, ("sobel-x", "synth"): 3,
          ("gradient", "synth"): 6}
TIMES_OPENCV = {("blobs", "synth"): 100, ("blobs", "china"): 25, ("gauss3", "synth"): 2,
                ("sobel-x", "synth"): 2, ("gradient", "synth"): 2, ("kernel3", "synth"): 2,
                ("median", "synth"): 2, ("min", "synth"): 2}


def bench(pel, runs, *choice):
    done = subprocess.run([pel, "bench", "--csv", "--python", sys.executable, "--runs", runs,
                           *choice], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"pel bench {' '.join(map(str, choice))}: status {done.returncode}\n{done.stderr}")
    return list(csv.DictReader(io.StringIO(done.stdout)))


def make_photo(folder):
    path = folder / "china.yuyv"
    done = subprocess.run([sys.executable, HERE / "photos.py", "china", SIZE, path],
                          capture_output=True, text=True)
    return path if done.returncode == 0 else None


def measure(pel, runs):
    filters = ",".join(operator for operator, _ in TIMES_OPENCV if operator != "blobs")
    rows = bench(pel, runs, "--operator", "blobs", "--input", "synth,rand4,rand1")
    rows += bench(pel, runs, "--operator", filters, "--input", "synth")
    with tempfile.TemporaryDirectory() as name:
        photo = make_photo(Path(name))
        if photo:
            rows += bench(pel, runs, "--operator", "blobs", "--input", "none", "--raw", "YUYV",
                          SIZE, photo)
    return rows


def table(title, aims, figure_of, is_met):
    """The lines of a table, and what is missing in it."""
    lines, missing = [f"{title:40}{'measured':>10}{'aim':>8}"], []
    for (operator, source), aim in aims.items():
        found = figure_of(operator, source)
        if found is None:
            missing.append(f"{operator} of {source}")
            continue
        figure, how = found
        mark = "" if is_met(figure, aim) else "  missed"
        lines.append(f"  {operator + ', ' + source + ', ' + how:38}{figure:10.1f}{aim:8g}{mark}")
    return lines, missing


def tables(rows):
    def of(operator, source):
        return [row for row in rows if (row["operator"], row["input"]) == (operator, source)]

    def copies(operator, source):
        found = [row for row in of(operator, source) if row["backend"] == "avx2"]
        return (float(found[0]["ratio_to_memcpy"]), "avx2") if found else None

    def times_opencv(operator, source):
        found = [row for row in of(operator, source) if row["speedup_over_opencv"]]
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
