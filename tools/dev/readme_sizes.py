#!/usr/bin/env python3
"""Keeps the section "How large it is" of README.md equal to tests/size/budgets.csv.

    readme_sizes.py --check|--write

budgets.csv is what tests/size/budgets.py measured; it checks that the figures still hold.
"""
import pathlib
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/size"))
import budgets  # noqa: E402

README = ROOT / "README.md"
BEGIN = "<!-- sizes: written by tools/dev/readme_sizes.py -->"
END = "<!-- end of sizes -->"
CORES = (("cortex-m0", "Cortex-M0"), ("cortex-m4", "Cortex-M4"), ("cortex-m55", "Cortex-M55"),
         ("rv32imc", "RV32IMC"))
# What the reader calls the modules, and how the names of their files begin, in the order of the
# arrows.
MODULES = (("blobs", ("blob",)), ("classify", ("classify",)), ("filter", ("filter",)),
           ("point", ("point",)), ("feature", ("feature",)), ("image", ("image", "frames")),
           ("color", ("color",)), ("row kernels", ("row",)),
           ("fixed, status, backend", ("fixed", "status", "backend", "overlap")))
# What others have figures for, too.
WORK = (("YUYV to blobs: shapes, 8 classes", "blobs basic synth"),
        ("YUYV to blobs: photograph, 6 classes", "blobs basic china"),
        ("YUYV to blobs: noise in 4 x 4 cells", "blobs basic rand4"),
        ("YUYV to blobs: noise in every pixel", "blobs basic rand1"),
        ("YUYV to labels, 8 classes", "classify yuyv"),
        ("Gauss 3x3", "filter gauss3"),
        ("any 3x3 kernel", "filter generic 3x3"),
        ("Sobel x, 16 bits", "filter sobel_x, 16 bits"),
        ("Sobel magnitude", "filter gradient abs"),
        ("box 3x3", "filter box3"),
        ("median 3x3", "filter median"),
        ("erosion 3x3", "filter min"))
WORK_CORES = (("cortex-m0", "M0"), ("cortex-m4", "M4"), ("cortex-m7", "M7"), ("cortex-m55", "M55"),
              ("rv32imc", "RV32IMC"))
ROBOT_BOARD = "microbit"


def line(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def table(head, rows):
    """Lines of a table; columns whose cells begin with a figure stand to the right."""
    rule = ["---:" if str(cell).strip("*")[0].isdigit() else "---" for cell in rows[0]]
    return [line(head), line(rule)] + [line(row) for row in rows] + [""]


def paragraph(text):
    """Lines of running text, and an empty one."""
    return textwrap.wrap(" ".join(text.split()), 100, break_long_words=False,
                         break_on_hyphens=False) + [""]


class Figures:
    """The rows of budgets.csv by kind, target and item."""

    def __init__(self, rows):
        self.rows = rows
        self.values = {(row.kind, row.target, row.item): row.value for row in rows
                       if row.kind != budgets.PEER}

    def of(self, kind, target):
        return {item: value for (k, t, item), value in self.values.items()
                if (k, t) == (kind, target)}

    def makers(self, *kinds):
        return ", ".join(sorted({row.made_by.removeprefix("gcc ") for row in self.rows
                                 if row.kind in kinds}))

    def best_peer(self, target, item):
        """Figure and name of the peer with the fewest instructions."""
        peers = [(row.value, row.made_by.split(",")[0]) for row in self.rows
                 if (row.kind, row.target, row.item) == (budgets.PEER, target, item)]
        return min(peers)


def flash_lines(figures):
    flash = {core: figures.of("flash", core) for core, _ in CORES}
    files = {file for some in flash.values() for file in some}
    parts = {title: [file for file in sorted(files) if file.startswith(heads)]
             for title, heads in MODULES}
    unlisted = files - {file for some in parts.values() for file in some}
    if unlisted:
        sys.exit(f"readme_sizes.py: no row of the table has {', '.join(sorted(unlisted))}")
    rows = [[title] + [sum(flash[core].get(file, 0) for file in some) for core, _ in CORES]
            for title, some in parts.items()]
    rows.append(["**everything**"] + [f"**{sum(flash[core].values())}**" for core, _ in CORES])
    rows.append(["deepest stack of a call"] + [max(figures.of("stack", core).values())
                                               for core, _ in CORES])
    rows.append(["RAM for blobs, 320x240 *"] + [figures.of("ram", core)[budgets.CLASSES_ITEM]
                                                for core, _ in CORES])
    return table(["bytes of flash"] + [title for _, title in CORES], rows)


def linked_lines(figures):
    limits = {limit.item: limit.most for limit in budgets.LIMITS if limit.kind == "linked"}
    rows = [[item, value, limits[item]] for item, value in
            figures.of("linked", "cortex-m4").items()]
    return table(["left of it in a firmware, Cortex-M4", "bytes of flash", "at most"], rows)


def robot_sentence(figures):
    flash = figures.of("robot flash", ROBOT_BOARD)["ports/robot"]
    ram = figures.of("robot ram", ROBOT_BOARD)["ports/robot"]
    return f"""The whole firmware [`ports/robot`](ports/robot/PROTOCOL.md) for the {ROBOT_BOARD}
        takes {flash} bytes of flash and {ram} of RAM beside its stack."""


def work_lines(figures):
    counts = {core: figures.of("instructions", core) for core, _ in WORK_CORES}
    rows = []
    for title, item in WORK:
        value, name = figures.best_peer("cortex-m4", item)
        rows.append([title] + [f"{counts[core][item]:.1f}" for core, _ in WORK_CORES]
                    + [f"{value:.1f}", name])
    return table(["instructions per pixel, 320x240"] + [title for _, title in WORK_CORES]
                 + ["best peer on M4", "which"], rows)


def make_section(figures):
    compiled = figures.makers("flash", "linked")
    stacks = [row.value for row in figures.rows if row.kind == "stack"]
    small = 100 * sum(value < budgets.SMALL_STACK for value in stacks) // len(stacks)
    lines = flash_lines(figures)
    lines += paragraph(f"""gcc {compiled}, `-Os`, constants included; the library has no writable
        data of its own (`data` = `bss` = 0). Of the public functions {small} % take
        less than {budgets.SMALL_STACK} bytes of stack with all that they call.""")
    lines += linked_lines(figures)
    lines += paragraph(robot_sentence(figures))
    lines += work_lines(figures)
    counted = figures.makers("instructions")
    lines += paragraph(f"""Counted in QEMU, gcc {counted}, `-O2`; the peers with the same
        compiler, the better of `-O2` and `-O3`, blobs in the same frames, filters in
        another picture. Instructions are not cycles. All figures, also for other cores, boards and
        operators, and the stack of each public function:
        [`tests/size/budgets.csv`](tests/size/budgets.csv).""")
    return "\n".join(lines).rstrip()


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in ("--check", "--write"):
        sys.exit(__doc__)
    new = f"\n\n{make_section(Figures(budgets.read_rows()))}\n\n"
    before, rest = README.read_text().split(BEGIN)
    old, after = rest.split(END)
    if sys.argv[1] == "--write":
        README.write_text(before + BEGIN + new + END + after)
        return 0
    if old != new:
        print("README.md is not as tests/size/budgets.csv; it should say:")
        print(new.strip())
        print("write it with: python3 tools/dev/readme_sizes.py --write")
    print(f"{int(old == new)} passed, {int(old != new)} failed")
    return 0 if old == new else 1


if __name__ == "__main__":
    sys.exit(main())
