#!/usr/bin/env python3
"""No operator may take longer with a backend than in plain C, however small the frame.

    backends.py PEL [RUNS]

Prints the time of every operator with every backend on frames of several sizes, as a part of that
of plain C. Times jump on busy machines: what seems slower is measured again on its own, and the
smallest of its parts counts. It is the same frame again and again, in the cache: code is compared
here, not memory. What is over SLOWER is marked, what is over WRONG fails: by that much no noise was
seen to make a backend slower that many times in a row.
"""
import collections
import csv
import io
import subprocess
import sys

SIZES = ("16x16", "20x16", "34x16", "66x32", "98x32", "160x120", "640x480")
SLOWER = 1.05  # equal code differs by as much
WRONG = 1.25
TRIES = 6


def measure(pel, runs, size, *choice):
    """(operator, backend) -> its time as a part of that of plain C."""
    done = subprocess.run([pel, "bench", "--csv", "--no-opencv", "--input", "synth", "--frames",
                           "1", "--runs", str(runs), "--size", size, *choice],
                          capture_output=True, text=True, check=True)
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    plain = {row["operator"]: float(row["ns_per_px"]) for row in rows
             if row["backend"] == "scalar"}
    return {(row["operator"], row["backend"]): float(row["ns_per_px"]) / plain[row["operator"]]
            for row in rows if row["backend"] not in ("scalar", "auto")}


def parts_of(pel, runs, size):
    """The same, with what was over the limit tried again."""
    parts = measure(pel, runs, size)
    for _ in range(TRIES):
        over = collections.defaultdict(list)
        for (operator, backend), part in parts.items():
            if part > SLOWER:
                over[operator].append(backend)
        if not over:
            break
        for key, part in measure(pel, 2 * runs, size, "--operator", ",".join(over)).items():
            parts[key] = min(parts[key], part)
    return parts


def main():
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 40
    passed = failed = 0
    for size in SIZES:
        parts = parts_of(sys.argv[1], runs, size)
        backends = list(dict.fromkeys(backend for _, backend in parts))
        print(f"{size:18}" + "".join(f"{backend:>8}" for backend in backends))
        for operator in dict.fromkeys(operator for operator, _ in parts):
            row = [parts[operator, backend] for backend in backends]
            wrong = [part > WRONG for part in row]
            print(f"  {operator:16}" + "".join(f"{part:8.3f}" for part in row)
                  + ("  slower" if max(row) > SLOWER else ""))
            passed += wrong.count(False)
            failed += wrong.count(True)
    if passed + failed == 0:
        print("this machine has no backend but plain C")
        print("0 passed, 0 failed, 1 skipped")
        return 0
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
