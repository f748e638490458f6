#!/usr/bin/env python3
"""Adds up what the tests of one or more build folders said and prints one table.

    summary.py [--check NAME:passed|failed|skipped]... [--run PREFIX:BUILD_DIR]...

A test counts what its closing line says, `N passed, N failed[, N skipped]`, as found in ctest's
log. A test without that line, or one that ended badly although it counted no failure, or that
never ran, counts as one failure more.
"""
import argparse
import json
import pathlib
import re
import sys

CLOSING = re.compile(r"^(\d+) passed, (\d+) failed(?:, (\d+) skipped)?$")
TAIL_LINES = 30


def planned(build):
    """The names of the tests that ctest set out to run, as tools/test.sh noted them before."""
    listing = json.loads((build / "planned-tests.json").read_text())
    return [test["name"] for test in listing["tests"]]


def blocks(log):
    """Yields name, text, seconds and verdict of every test in ctest's log."""
    head = re.compile(r"^\d+/\d+ Testing: (.*)$", re.M)
    starts = list(head.finditer(log))
    for start, following in zip(starts, starts[1:] + [None]):
        block = log[start.end():following.start() if following else len(log)]
        output = re.search(r"^Output:\n-+\n(.*)^<end of output>", block, re.M | re.S)
        seconds = re.search(r"^Test time =\s*([\d.]+) sec", block, re.M)
        good = re.search(r"^Test Passed\.$", block, re.M)
        yield (start.group(1), output.group(1) if output else block,
               float(seconds.group(1)) if seconds else 0.0, bool(good))


def count(text, good):
    """What a test's output and its end amount to: passed, failed, skipped, remark."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    closing = CLOSING.match(lines[-1]) if lines else None
    if not closing:
        return 0, 1, 0, "no closing line"
    passed, failed, skipped = (int(number or 0) for number in closing.groups())
    if not good and failed == 0:
        return passed, 1, skipped, "ended badly"
    if passed + failed + skipped == 0:
        return 0, 1, 0, "ran nothing"
    return passed, failed, skipped, ""


def rows_of_run(prefix, build):
    """The table rows of one build folder, and the output of what failed."""
    log_path = build / "Testing/Temporary/LastTest.log"
    log = log_path.read_text(errors="replace") if log_path.exists() else ""
    rows, failures, seen = [], [], set()
    for name, text, seconds, good in blocks(log):
        seen.add(name)
        passed, failed, skipped, remark = count(text, good)
        rows.append((f"{prefix} {name}", passed, failed, skipped, seconds, remark))
        if failed:
            tail = text.rstrip().splitlines()[-TAIL_LINES:]
            failures.append((f"{prefix} {name}", tail, log_path))
    for name in sorted(set(planned(build)) - seen):
        rows.append((f"{prefix} {name}", 0, 1, 0, 0.0, "did not run"))
    if not rows:
        rows.append((f"{prefix} (no tests)", 0, 1, 0, 0.0, "ran nothing"))
    return sorted(rows), failures


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="append", default=[])
    parser.add_argument("--run", action="append", default=[])
    arguments = parser.parse_args()

    rows, failures = [], []
    for check in arguments.check:
        name, verdict = check.rsplit(":", 1)
        skipped = verdict == "skipped"
        good = verdict == "passed"
        rows.append((name, int(good), int(not good and not skipped), int(skipped), 0.0, ""))
    for run in arguments.run:
        prefix, build = run.split(":", 1)
        build = pathlib.Path(build)
        more, bad = rows_of_run(prefix, build)
        rows += more
        failures += bad

    for name, tail, log_path in failures:
        print(f"\n---- {name} failed; the end of its output (all of it: {log_path})")
        print("\n".join(tail))
    width = max(len(row[0]) for row in rows)
    print(f"\n{'suite':{width}}   passed  failed  skipped  seconds")
    for name, passed, failed, skipped, seconds, remark in rows:
        mark = "  <-- " + (remark or "look here") if failed else ""
        print(f"{name:{width}} {passed:8} {failed:7} {skipped:8} {seconds:8.1f}{mark}")
    passed, failed, skipped = (sum(row[i] for row in rows) for i in (1, 2, 3))
    print()
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed or passed == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
