#!/usr/bin/env python3
"""Keeps the table of sizes in README.md equal to what the compilers make.

    readme_sizes.py --check|--write SIZES.csv

SIZES.csv is what tests/size/compiled.py writes. The README names the compiler; with another one
the numbers are others, and there is nothing to compare.
"""
import csv
import pathlib
import sys

README = pathlib.Path(__file__).resolve().parents[2] / "README.md"
BEGIN = "<!-- sizes: written by tools/dev/readme_sizes.py -->"
END = "<!-- end of sizes -->"
CLASSES = "8"
COLUMNS = (("cortex-m0", "Cortex-M0"), ("cortex-m4", "Cortex-M4"), ("cortex-m55", "Cortex-M55"),
           ("rv32imc", "RV32IMC"))
# What the reader calls the modules, and how the names of their files begin, in the order of the
# arrows.
ROWS = (("blobs", ("blob",)), ("classify", ("classify",)), ("filter", ("filter",)),
        ("point", ("point",)), ("feature", ("feature",)), ("image", ("image", "frames")),
        ("color", ("color",)), ("row kernels", ("row",)), ("fixed, status", ("fixed", "status")))
REMARKS = ("(stack)", "(memory)")


def read(path):
    """Bytes by target and module, and the compilers' versions."""
    table, versions = {}, set()
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["classes"] == CLASSES:
                table[row["target"], row["module"]] = sum(int(row[k])
                                                         for k in ("text", "data", "bss"))
            if row["target"] != "host":
                versions.add(row["gcc"].rsplit(".", 1)[0])
    return table, sorted(versions)


def line(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def make_table(table, versions):
    names = [name for name, _ in COLUMNS]
    files = {module for _, module in table} - set(REMARKS)
    parts = {title: [file for file in sorted(files) if file.startswith(heads)]
             for title, heads in ROWS}
    unlisted = files - {file for some in parts.values() for file in some}
    if unlisted:
        sys.exit(f"readme_sizes.py: no row of the table has {', '.join(sorted(unlisted))}")
    lines = [line(["bytes of flash"] + [title for _, title in COLUMNS]),
             line(["---"] + ["---:"] * len(COLUMNS))]
    for title, some in parts.items():
        lines.append(line([title] + [sum(table[name, file] for file in some) for name in names]))
    lines.append(line(["**everything**"] + [
        f"**{sum(table[name, file] for file in files)}**" for name in names]))
    lines.append(line(["deepest stack"] + [table[name, "(stack)"] for name in names]))
    lines.append(line(["RAM for blobs, 320x240 *"] + [table[name, "(memory)"] for name in names]))
    return "\n".join(lines) + f"\n\ngcc {', '.join(versions)}, `-Os`, constants included;" \
        " the library has no writable data of its own (`data` = `bss` = 0)."


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("--check", "--write"):
        sys.exit(__doc__)
    if not pathlib.Path(sys.argv[2]).exists():
        sys.exit(f"there is no {sys.argv[2]}: run tests/size/compiled.py first")
    table, versions = read(sys.argv[2])
    if any((name, "(stack)") not in table for name, _ in COLUMNS):
        print("a cross compiler is missing: nothing to compare\n0 passed, 0 failed, 1 skipped")
        return 0
    text = README.read_text()
    before, rest = text.split(BEGIN)
    old, after = rest.split(END)
    new = f"\n\n{make_table(table, versions)}\n\n"
    if sys.argv[1] == "--write":
        README.write_text(before + BEGIN + new + END + after)
        return 0
    if f"gcc {', '.join(versions)}," not in old:
        print(f"the README's sizes are of another compiler than gcc {', '.join(versions)}")
        print("0 passed, 0 failed, 1 skipped")
        return 0
    if old != new:
        print("README.md is out of date; the table now is:")
        print(new.strip())
        print(f"write it with: python3 tools/dev/readme_sizes.py --write {sys.argv[2]}")
    print(f"{int(old == new)} passed, {int(old != new)} failed")
    return 0 if old == new else 1


if __name__ == "__main__":
    sys.exit(main())
