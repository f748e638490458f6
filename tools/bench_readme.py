#!/usr/bin/env python3
"""Writes what `pel bench --csv` measured into the README, between its marks for speed.

    pel bench --csv --plot bench.png --input synth FILE... > bench.csv
    python3 tools/bench_readme.py bench.csv [README]

Blobs of every input are rows of the table, the other operators those of the input that came first.
"""
import csv
import pathlib
import platform
import sys

README = pathlib.Path(__file__).resolve().parents[1] / "README.md"
BEGIN, END = "<!-- speed begin -->\n", "<!-- speed end -->\n"
BACKENDS = ("scalar", "ssse3", "avx2", "avx512")
OPERATORS = {"blobs": "YUYV to blobs", "gauss3": "3x3 Gaussian", "sobel-x": "Sobel across, 16 bits",
             "gradient-abs": "size of Sobel's gradient, as a sum",
             "gradient": "size of Sobel's gradient", "kernel3": "any 3x3 kernel",
             "median": "3x3 median", "min": "3x3 erosion"}


def processor():
    """Its name, where Linux tells."""
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")),
                platform.processor())


def cell(row, name):
    return f"{float(row[name]):.3f}" if row and row[name] else ""


def table(rows):
    known = {(row["operator"], row["input"], row["backend"]): row for row in rows}
    inputs = list(dict.fromkeys(row["input"] for row in rows))
    backends = [name for name in BACKENDS if any(row["backend"] == name for row in rows)]
    wanted = [("blobs", name) for name in inputs] + [(operator, inputs[0])
                                                     for operator in OPERATORS
                                                     if operator != "blobs"]
    lines = [f"| nanoseconds per pixel | {' | '.join(backends)} | OpenCV | faster | x memcpy |",
             "| --- |" + " ---: |" * (len(backends) + 3)]
    for operator, name in wanted:
        found = [known.get((operator, name, backend)) for backend in backends]
        best = min((row for row in found if row), key=lambda row: float(row["ns_per_px"]))
        faster = best["speedup_over_opencv"]
        lines.append(f"| {OPERATORS[operator]}, {name} | "
                     + " | ".join(cell(row, "ns_per_px") for row in found)
                     + f" | {cell(best, 'opencv_ns_per_px')} | "
                     + (f"{float(faster):.1f}" if faster else "")
                     + f" | {float(best['ratio_to_memcpy']):.1f} |")
    return lines


def note_on(row):
    """How it was measured."""
    frames = "the same frame again and again"
    if row["frames"] != "1":
        frames = f"{row['frames']} copies of the frame in turn"
    return (f"Medians of {row['runs']} runs, {row['width']}x{row['height']}, {frames}, "
            f"{processor()}, one core.\n")


def main():
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = table(rows)
    readme = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else README
    text = readme.read_text(encoding="utf-8")
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit("bench_readme.py: the README has not one place for speed")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    readme.write_text(before + BEGIN + "\n".join(lines) + "\n\n" + note_on(rows[0]) + END + after,
                      encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
