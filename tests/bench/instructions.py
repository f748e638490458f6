#!/usr/bin/env python3
"""Counts the instructions per pixel from a YUYV frame to sorted blobs, and holds them to limits.

Per input: counts blobs, areas, runs and regions and compares them with the known ones, then runs
the chain under callgrind with the basic and with all measurements, in plain C and with AVX2 where
the processor has it. It fails where pel needs more instructions than CMVision 1.x, than it aims at,
or 3 % more than expected.csv says (same compiler only).

CMVision's figures: the 1.x code with raised limits, -O2, gcc 12.2, the same frames, 4-connected, 20
pixels and more, counted in the same way. Known counts: the 4-connected ones agree in CMVision 1.x,
OpenMV, grayskull and OpenCV.
"""
import argparse
import csv
import hashlib
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXPECTED = HERE / "expected.csv"
SIZE = "640x480"
LEVELS = ("basic", "all", "avx2 basic", "avx2 all")  # what is measured; in plain C, or how
NOT_HERE = 77  # status of bench_chain
GROWTH_ALLOWED = 0.03
MARKERS = ("<!-- bench begin -->", "<!-- bench end -->")

# The instructions per pixel that pel aims at.
AIMS = {("synth", "basic"): 10, ("china", "basic"): 14, ("rand4", "basic"): 20,
        ("rand1", "basic"): 40, ("synth", "avx2 basic"): 2.5, ("synth", "avx2 all"): 2.5}

# The stages of --stages: functions whose calls, with all that they call, make the stage.
STAGES = ("pel_i_classify_runs", "pel_i_blobs_join", "pel_blobs_end")


class Input:
    def __init__(self, title, cmvision, sha256=None, **counts):
        self.title = title
        self.cmvision = cmvision
        self.sha256 = sha256  # of a photograph, first 8 bytes; None: made by bench_chain itself
        self.counts = counts


INPUTS = {
    "synth": Input("40 coloured shapes, 8 classes", 14.9,
                   blobs=40, area=69832, regions4=40, runs=1628),
    "rand4": Input("noise in 4 x 4 cells", 26.6,
                   blobs=679, area=144624, regions4=1297, runs=19120, regions8=86),
    "rand1": Input("noise in every pixel", 67.2,
                   blobs=1784, area=91982, regions4=20563, runs=77024, regions8=1119),
    "china": Input("photograph, 6 classes", 17.6, "2c0580bd3e5fa9d9",
                   blobs=144, regions4=972, runs=6056, regions8=483),
    "cat": Input("photograph, 6 classes", 16.9, "595e20013a556cbb", runs=4888),
}


def choice_of(level):
    """What bench_chain is to be told."""
    return level.split() if " " in level else ["scalar", level]


class Tally:
    def __init__(self):
        self.passed = self.failed = self.skipped = 0
        self.lines = []

    def check(self, ok, text):
        self.passed += ok
        self.failed += not ok
        self.lines.append(("ok    " if ok else "FAIL  ") + text)

    def skip(self, text):
        self.skipped += 1
        self.lines.append("skip  " + text)


def run(command, may_lack=False):
    """What a command prints; None if it may say that it cannot be run here, and does."""
    done = subprocess.run(command, capture_output=True, text=True)
    if may_lack and done.returncode == NOT_HERE:
        return None
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stderr}")
    return done.stdout


def run_chain(program, *arguments):
    text = run([program, *arguments], may_lack=True)
    if text is None:
        return None
    pairs = (line.split(None, 1) for line in text.splitlines())
    return {key: int(value) if value.isdigit() else value for key, value in pairs}


def make_photo(name, folder):
    """The path of the photograph, or None and why there is none."""
    path = folder / f"{name}.yuyv"
    done = subprocess.run([sys.executable, HERE / "photos.py", name, SIZE, path],
                          capture_output=True, text=True)
    if done.returncode == 3:
        return None, done.stderr.strip()
    if done.returncode != 0:
        return None, "photos.py failed: " + done.stderr.strip()[-200:]
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:16]
    if digest != INPUTS[name].sha256:
        return None, f"SHA-256 {digest}, another resize than OpenCV 5.0.0"
    return path, None


def has_valgrind():
    return shutil.which("valgrind") is not None


def callgrind(program, level, source, folder):
    """Instructions inside measured_chain, and the file that callgrind wrote."""
    out = folder / f"{Path(str(source)).stem}.{level.replace(' ', '.')}.callgrind"
    run(["valgrind", "--tool=callgrind", "--toggle-collect=measured_chain",
         f"--callgrind-out-file={out}", program, *choice_of(level), source])
    total = re.search(r"^(?:totals|summary): (\d+)", out.read_text(), re.MULTILINE)
    if total is None or int(total.group(1)) == 0:
        sys.exit("callgrind counted nothing inside measured_chain")
    return int(total.group(1)), out


def stages_of(out, pixels):
    """Instructions per pixel of each stage, from callgrind's inclusive costs."""
    text = run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", out])
    cost = {}
    for line in text.splitlines():
        found = re.match(r"\s*([\d,]+) .*?:(\w+)(?:'\d+)?(?: \[|$)", line)
        if found and found.group(2) in STAGES:
            name = found.group(2)
            count = int(found.group(1).replace(",", ""))
            cost[name] = max(cost.get(name, 0), count)  # lists callers and callees apart
    rows = {"runs": cost.get("pel_i_classify_runs", 0), "join": cost.get("pel_i_blobs_join", 0),
            "end": cost.get("pel_blobs_end", 0)}
    return {stage: count / pixels for stage, count in rows.items()}


def check_counts(tally, name, source, program):
    """Compares what the chain finds with what is known; returns the counts."""
    counts = run_chain(program, "--count", source)
    levels = {level: run_chain(program, *choice_of(level), source) for level in LEVELS}
    found = {level: there for level, there in levels.items() if there is not None}
    tally.check(all(found["basic"][k] == there[k] for k in ("blobs", "area", "regions4")
                    for there in found.values()), f"{name}: {', '.join(found)} find the same")
    counts.update(found["all"], levels=list(found))
    for key, known in INPUTS[name].counts.items():
        tally.check(counts[key] == known, f"{name}: {key} {counts[key]}, known {known}")
    return counts


def check_growth(tally, name, level, now, compiler, expected):
    if (name, level) not in expected:
        tally.skip(f"{name} {level}: no figure in {EXPECTED.name}")
        return
    before, made_by = expected[name, level]
    growth = now / before - 1
    text = (f"{name} {level}: {now:.3f} instructions per pixel, {100 * growth:+.1f} % against "
            f"{before:.3f} ({made_by})")
    if major(made_by) != major(compiler):
        tally.skip(f"{text}, this is {compiler}")
    else:
        tally.check(growth <= GROWTH_ALLOWED, text)


def major(compiler):
    return compiler.split(".")[0]


def measure(name, source, program, folder, tally, expected, with_stages):
    counts = check_counts(tally, name, source, program)
    row = {"input": name, **counts, "cmvision": INPUTS[name].cmvision}
    for level in LEVELS:
        row[level] = float("nan")
        if level not in counts["levels"] or not has_valgrind():
            known = level in counts["levels"]
            why = "valgrind is not installed" if known else "not on this machine"
            tally.skip(f"{name} {level}: instructions not counted, {why}")
            continue
        total, out = callgrind(program, level, source, folder)
        row[level] = total / counts["pixels"]
        tally.check(row[level] <= row["cmvision"],
                    f"{name} {level}: {row[level]:.2f} instructions per pixel, "
                    f"CMVision 1.x {row['cmvision']}")
        if (name, level) in AIMS:
            tally.check(row[level] <= AIMS[name, level],
                        f"{name} {level}: {row[level]:.2f}, aim {AIMS[name, level]}")
        check_growth(tally, name, level, row[level], counts["compiler"], expected)
        if with_stages:
            row["stages " + level] = stages_of(out, counts["pixels"])
    return row


def read_expected():
    if not EXPECTED.exists():
        return {}
    with EXPECTED.open(newline="") as file:
        return {(r["input"], r["level"]): (float(r["instructions_per_px"]), r["compiler"])
                for r in csv.DictReader(file)}


def write_expected(rows):
    figures = read_expected()
    figures.update({(row["input"], level): (row[level], row["compiler"])
                    for row in rows for level in LEVELS if row[level] == row[level]})
    with EXPECTED.open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["input", "level", "instructions_per_px", "compiler"])
        for (name, level), (figure, compiler) in figures.items():
            out.writerow([name, level, f"{figure:.3f}", compiler])


def print_table(rows):
    print(f"{'input':<8}" + "".join(f"{'pel ' + level:>16}" for level in LEVELS) +
          f"{'CMVision 1.x':>14}{'runs':>8}{'blobs':>8}{'area':>9}")
    for r in rows:
        print(f"{r['input']:<8}" + "".join(f"{r[level]:>16.2f}" for level in LEVELS) +
              f"{r['cmvision']:>14.1f}{r['runs']:>8}{r['blobs']:>8}{r['area']:>9}")


def print_csv(rows):
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["input", *("pel_" + level.replace(" ", "_") for level in LEVELS), "cmvision_1x",
                  "runs", "blobs", "area_px", "compiler"])
    for r in rows:
        out.writerow([r["input"], *(f"{r[level]:.3f}" for level in LEVELS), r["cmvision"],
                      r["runs"], r["blobs"], r["area"], r["compiler"]])


def markdown_cells(row):
    return [f"{row['input']}: {INPUTS[row['input']].title}, {row['blobs']} blobs",
            *(f"{row[level]:.1f}" for level in LEVELS), str(row["cmvision"])]


def print_markdown(rows):
    print(MARKERS[0])
    print("| 640x480 YUYV to sorted blobs | pel | all measured | AVX2 | AVX2, all | CMVision 1.x |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for r in rows:
        print("| " + " | ".join(markdown_cells(r)) + " |")
    print(MARKERS[1])


def read_markdown(path):
    """The README's table: the cells of each line, by input, and the text before and behind it."""
    before, rest = path.read_text().split(MARKERS[0])
    table, behind = rest.split(MARKERS[1])
    lines = [[cell.strip() for cell in line.strip("|").split("|")]
             for line in table.strip().splitlines()[2:]]
    return {cells[0].split(":")[0]: cells for cells in lines}, before + behind


def check_figure(tally, what, told, now):
    """The table tells one decimal, so a figure may differ by half of its last digit more."""
    tally.check(abs(now - told) <= GROWTH_ALLOWED * told + 0.05,
                f"{what} {told} instructions per pixel, measured {now:.2f}")


def check_readme(tally, path, rows, names):
    """Compares the README's table with what was measured; figures of its own compiler only."""
    lines, text = read_markdown(path)
    tally.check(list(lines) == list(INPUTS), f"{path.name} lists {', '.join(lines)}")
    compiler = re.search(r"gcc (\d+)\.", text)
    tally.check(compiler is not None, f"{path.name} names the compiler of its table")
    for row in (row for row in rows if row["input"] in lines):
        cells, wanted = lines[row["input"]], markdown_cells(row)
        tally.check((cells[0], cells[-1]) == (wanted[0], wanted[-1]),
                    f"{path.name}: '{cells[0]}', CMVision {cells[-1]}")
        if compiler and "gcc-" + compiler.group(1) != major(row["compiler"]):
            tally.skip(f"{path.name}: {row['input']}, this is {row['compiler']}")
            continue
        for level, cell in zip(LEVELS, cells[1:-1]):
            if row[level] == row[level]:  # otherwise it could not be counted
                check_figure(tally, f"{path.name}: {row['input']} {level}", float(cell), row[level])
    for name in names:
        if name not in [row["input"] for row in rows]:
            tally.skip(f"{path.name}: {name} was not measured")


def print_stages(rows):
    names = ("runs", "join", "end")
    print(f"\n{'input':<8}{'level':<12}" + "".join(f"{name:>11}" for name in names))
    for r in rows:
        for level in r["levels"]:
            print(f"{r['input']:<8}{level:<12}" +
                  "".join(f"{r['stages ' + level][name]:>11.2f}" for name in names))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="the built bench_chain")
    parser.add_argument("--inputs", default=",".join(INPUTS), help="which, with commas")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--csv", action="store_true", help="only the table, as CSV")
    form.add_argument("--markdown", action="store_true", help="only the table of the README")
    parser.add_argument("--stages", action="store_true", help="also the cost of each stage")
    parser.add_argument("--check-readme", type=Path, metavar="README.md",
                        help="also compare the table in this file")
    parser.add_argument("--write", action="store_true", help="write expected.csv, do not compare")
    arguments = parser.parse_args()
    arguments.inputs = arguments.inputs.split(",")
    for name in arguments.inputs:
        if name not in INPUTS:
            parser.error(f"no input {name}; there are {', '.join(INPUTS)}")
    return arguments


def find_sources(names, folder, tally):
    """What bench_chain is to be given for each input that there is."""
    sources = {}
    for name in names:
        if INPUTS[name].sha256 is None:
            sources[name] = name
            continue
        path, reason = make_photo(name, folder)
        if path is None:
            tally.skip(f"{name}: {reason}")
        else:
            sources[name] = path
    return sources


def report(arguments, rows, tally):
    if arguments.csv:
        print_csv(rows)
    elif arguments.markdown:
        print_markdown(rows)
    else:
        print_table(rows)
        if arguments.stages:
            print_stages(rows)
        print()
        print("\n".join(tally.lines))
    if arguments.csv or arguments.markdown:
        for line in tally.lines:
            if line.startswith("FAIL"):
                print(line, file=sys.stderr)


def main():
    arguments = parse_arguments()
    plain = not (arguments.csv or arguments.markdown)
    if not has_valgrind() and (not plain or arguments.write or arguments.stages):
        sys.exit("valgrind is not installed")
    tally = Tally()
    expected = {} if arguments.write else read_expected()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sources = find_sources(arguments.inputs, folder, tally)
        rows = [measure(name, source, arguments.program, folder, tally, expected, arguments.stages)
                for name, source in sources.items()]
        if arguments.check_readme:
            check_readme(tally, arguments.check_readme, rows, arguments.inputs)
        report(arguments, rows, tally)
    if arguments.write:
        write_expected(rows)
    if plain:
        skipped = f", {tally.skipped} skipped" if tally.skipped else ""
        print(f"{tally.passed} passed, {tally.failed} failed{skipped}")
    return 1 if tally.failed or not tally.passed else 0


if __name__ == "__main__":
    sys.exit(main())
