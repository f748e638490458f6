#!/usr/bin/env python3
"""The Arduino library as a user gets it: the zip is unpacked among the libraries, Arduino's builder
compiles the example for a Mega (ATmega2560, 8 KiB of RAM), and simavr runs it.

    check_arduino.py OUT_DIR

What it prints must be the blobs of the map in the sketch, found here by a flood fill.
"""
import pathlib
import re
import shutil
import sys
import zipfile

from packagetest import (PACK, PYTHON, ROOT, avr_simulator, check, finish, fresh, have,
                         library_sources, run, skip, step, version)

HARDWARE = pathlib.Path("/usr/share/arduino/hardware")
# Where the distribution puts the tools, and a constant that its compiler, older than the one that
# the core was written for, leaves out of <float.h> in C++: digits of a 32-bit long double.
PREFERENCES = ["compiler.path=/usr/bin/", "compiler.cpp.extra_flags=-DDECIMAL_DIG=9",
               'tools.ctags.pattern="/usr/bin/arduino-ctags" -u --language-force=c++ -f - '
               '--c++-kinds=svpf --fields=KSTtzns --line-directives "{source_file}"']
RAM_BYTES, SCALE = 8192, 4
CLASSES = {"o": "ball", "b": "goal", "y": "cone"}


def check_layout(archive):
    """What the Arduino library specification asks of an archive."""
    names = archive.namelist()
    check({name.split("/")[0] for name in names} == {"pel"}, "one folder in the archive")
    for name in ("library.properties", "src/pel.h", "src/pel/version.h", "keywords.txt", "LICENSE",
                 "README.md", "examples/BlobFinder/BlobFinder.ino"):
        check(f"pel/{name}" in names, f"{name} is in the archive", str(names))
    check(not [name for name in names if name.endswith((".in", ".py", ".o"))], "nothing else", "")
    packed = sorted(name[len("pel/src/"):] for name in names
                    if name.startswith("pel/src/") and not name.endswith(".h"))
    check(packed == sorted(library_sources()), "the sources", str(packed))
    properties = dict(line.split("=", 1) for line in
                      archive.read("pel/library.properties").decode().splitlines() if line)
    for key in ("name", "version", "author", "maintainer", "sentence", "paragraph", "category",
                "architectures"):
        check(properties.get(key), f"library.properties states {key}", str(properties))
    check(properties.get("version") == version(), "the version", str(properties))
    check(properties.get("category") in (
        "Display", "Communication", "Signal Input/Output", "Sensors", "Device Control", "Timing",
        "Data Storage", "Data Processing", "Other"), "a category that exists", str(properties))
    for line in archive.read("pel/keywords.txt").decode().splitlines():
        check(re.fullmatch(r"\w+\t(KEYWORD1|KEYWORD2|LITERAL1)", line), "keywords.txt", line)
    return properties


def check_keywords(archive):
    """Every keyword is a name of the library."""
    headers = "".join(path.read_text() for path in (ROOT / "lib/include").rglob("*.h"))
    for line in archive.read("pel/keywords.txt").decode().splitlines():
        word = line.split("\t")[0]
        check(re.search(rf"\b{word}\b", headers), f"keyword {word} exists")


def flood(cells, start):
    """The cells of one letter that hang together, corners included."""
    letter, found, waiting = cells[start], {start}, [start]
    while waiting:
        x, y = waiting.pop()
        for near in ((x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)):
            if cells.get(near) == letter and near not in found:
                found.add(near)
                waiting.append(near)
    return found


def expected_blobs(sketch):
    """{(class, area, centre, box)} of the map in the sketch, a letter being a square of pixels."""
    body = re.search(r"MAP\[30\]\[41\] PROGMEM = \{(.*?)\};", sketch, re.S).group(1)
    rows = re.findall(r'"([^"]*)"', body)
    check(len(rows) == 30 and all(len(row) == 40 for row in rows), "the map is 40 x 30")
    cells = {(x, y): letter for y, row in enumerate(rows) for x, letter in enumerate(row)
             if letter in CLASSES}
    blobs = set()
    left = set(cells)
    while left:
        region = flood(cells, min(left))
        left -= region
        area = len(region) * SCALE * SCALE
        centre = [round((SCALE * sum(cell[axis] for cell in region) / len(region)
                         + (SCALE - 1) / 2) * 65536) / 65536 for axis in (0, 1)]
        ends = [(min(cell[axis] for cell in region) * SCALE,
                 (max(cell[axis] for cell in region) + 1) * SCALE) for axis in (0, 1)]
        blobs.add((CLASSES[cells[next(iter(region))]], area, *centre, *ends[0], *ends[1]))
    return blobs


LINE = re.compile(r"^(closed|largest): (\w+) area (\d+) centre ([\d.]+) ([\d.]+) "
                  r"box (\d+) (\d+) (\d+) (\d+)\r?$", re.M)


def printed_blobs(text):
    """The printed blobs, those of each kind in their order."""
    out = {"closed": [], "largest": []}
    for kind, name, area, x, y, *box in LINE.findall(text):
        out[kind].append((name, int(area), float(x), float(y), *(int(number) for number in box)))
    return out


def same(found, expected):
    """Equal, with centres to the two decimals that are printed."""
    return found[:2] == expected[:2] and found[4:] == expected[4:] and all(
        abs(a - b) <= 0.0051 for a, b in zip(found[2:4], expected[2:4]))


def check_output(text, expected):
    found = printed_blobs(text)
    check(len(expected) == 7, "the map holds seven blobs", str(expected))
    check(len(found["closed"]) == len(expected), "every blob is reported once", text)
    for blob in expected:
        check(sum(same(other, blob) for other in found["closed"]) == 1, f"closed: {blob}", text)
    ends = [blob[-1] for blob in found["closed"]]
    check(ends == sorted(ends), "blobs are reported as soon as they end", text)
    largest = sorted(expected, key=lambda blob: (-blob[1], blob[6], blob[4]))[:4]
    check(len(found["largest"]) == 4 and all(map(same, found["largest"], largest)),
          "the four largest, in order", f"{text}\nexpected {largest}")
    check(f"frame done: PEL_TRUNCATED, found {len(expected)}" in text,
          "the status tells that three were left out", text)


def build(folder):
    """Runs Arduino's builder on the example of the unpacked library; the program or None."""
    sketch = folder / "sketch/BlobFinder"
    shutil.copytree(folder / "libraries/pel/examples/BlobFinder", sketch)
    (folder / "build").mkdir()
    flags = [f"-prefs={preference}" for preference in PREFERENCES]
    if step("Arduino's builder compiles BlobFinder", "arduino-builder", "-compile", "-hardware",
            HARDWARE, "-tools", "/usr/bin", "-libraries", folder / "libraries", "-fqbn",
            "arduino:avr:mega:cpu=atmega2560", "-build-path", folder / "build", *flags,
            sketch / "BlobFinder.ino"):
        return folder / "build/BlobFinder.ino.elf"
    return None


def check_run(runner, program):
    """The example prints what its map holds, and fits as its README says."""
    result = run(runner, program, "1000000000", "frame done")
    check(result.returncode == 0, "the example runs", result.stdout)
    check_output(result.stdout, expected_blobs(
        (ROOT / "ports/arduino/examples/BlobFinder/BlobFinder.ino").read_text()))
    memory = re.search(r"RAM: .* = (\d+) of (\d+) bytes", result.stdout)
    promised = re.search(r"takes less than (\d+) of the 8 KiB of RAM",
                         (ROOT / "ports/arduino/README.md").read_text())
    if check(memory and promised, "the memory is told", result.stdout):
        print(f"BlobFinder, 160x120, ATmega2560: {memory.group(0)}")
        used, there = map(int, memory.groups())
        check(there == RAM_BYTES and used < int(promised.group(1)) * 1024, "it fits as promised",
              memory.group(0))


def main():
    folder = fresh("arduino")
    archive_path = folder / "pel.zip"
    if not step("pack", PYTHON, PACK, "arduino", archive_path):
        return finish()
    step("pack again", PYTHON, PACK, "arduino", folder / "again.zip")
    check(archive_path.read_bytes() == (folder / "again.zip").read_bytes(),
          "the archive is the same every time")
    with zipfile.ZipFile(archive_path) as archive:
        check_layout(archive)
        check_keywords(archive)
        archive.extractall(folder / "libraries")
    runner = avr_simulator(folder)
    if not runner or not have("arduino-builder", "arduino-ctags"):
        return finish()
    if not HARDWARE.exists():
        skip("Arduino's AVR core is not here")
        return finish()
    program = build(folder)
    if program:
        check_run(runner, program)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
