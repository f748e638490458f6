#!/usr/bin/env python3
"""The gate of the budgets, tried on cases whose outcome is known: every rule of budgets.py,
stack.py, linked.py and counts.py must be able to fail."""
import contextlib
import io
import pathlib
import re
import shutil
import sys
import tempfile

import budgets
import counts
import firmware
import linked
import stack

report = firmware.Report()
check = report.check


def outcome(function, *arguments):
    """Runs a checking function; (passed, failed, skipped, what it printed)."""
    inner, text = firmware.Report(), io.StringIO()
    with contextlib.redirect_stdout(text):
        function(inner, *arguments)
    return inner.passed, inner.failed, inner.skipped, text.getvalue()


def row(kind, value, item="item", target="cortex-m4", by="gcc 12.2.1"):
    return budgets.Row(kind, target, item, value, "bytes", by)


# ---- Tolerances and limits ----------------------------------------------------------------------

def test_tolerances():
    for kind, before, allowed, too_much in (
            ("flash", 1000, 1020, 1021), ("flash", 100, 108, 109), ("linked", 4000, 4080, 4081),
            ("stack", 200, 208, 209), ("ram", 500, 500, 501), ("instructions", 10.0, 10.3, 10.31),
            ("robot flash", 10000, 10200, 10201), ("robot ram", 5000, 5100, 5101)):
        old = row(kind, before)
        check(budgets.judge(old, row(kind, before)) == "same", f"{kind}: equal is not the same")
        check(budgets.judge(old, row(kind, allowed)) != "grown", f"{kind}: {allowed} is too much")
        check(budgets.judge(old, row(kind, too_much)) == "grown", f"{kind}: {too_much} passes")
        check(budgets.judge(old, row(kind, before / 2)) == "changed", f"{kind}: half is not less")


def test_compare():
    kept = [row("flash", 1000, "a"), row("flash", 500, "b"), row("peer", 3, "a")]
    passed, failed, skipped, text = outcome(budgets.compare, kept[:2], kept)
    check((passed, failed, skipped, text) == (2, 0, 0, ""), "equal figures")
    passed, failed, _, text = outcome(budgets.compare, [row("flash", 1100, "a"), kept[1]], kept)
    check((passed, failed) == (1, 1) and "1000 -> 1100" in text, f"growth: {text}")
    passed, failed, _, text = outcome(budgets.compare, [row("flash", 900, "a"), kept[1]], kept)
    check((passed, failed) == (2, 0) and "changed" in text, f"less: {text}")
    passed, failed, _, text = outcome(budgets.compare, [*kept[:2], row("flash", 1, "new")], kept)
    check((passed, failed) == (2, 1) and "not in" in text, f"new: {text}")
    passed, failed, _, text = outcome(budgets.compare, kept[:1], kept)
    check((passed, failed) == (1, 1) and "gone" in text, f"gone: {text}")
    other = [row("flash", 9000, "a", by="gcc 13.1.0"), row("flash", 1, "b", by="gcc 13.1.0")]
    passed, failed, skipped, text = outcome(budgets.compare, other, kept)
    check((passed, failed, skipped) == (0, 0, 1) and "13.1.0" in text, f"other compiler: {text}")
    photo = [row("instructions", 9.0, "blobs of china"), row("instructions", 8.0, "x")]
    passed, failed, skipped, _ = outcome(budgets.compare, photo[1:], photo, ["china"])
    check((passed, failed, skipped) == (1, 0, 1), "no photograph")


def test_limits():
    for item, most in (("classify and blobs", 4096), ("generic 3x3, all borders", 2048),
                       ("whole library", 49152)):
        check(outcome(budgets.check_limits, [row("linked", most, item)])[:2] == (1, 0), item)
        check(outcome(budgets.check_limits, [row("linked", most + 1, item)])[:2] == (0, 1), item)
    china = {"kind": "instructions", "item": "blobs basic china", "target": "cortex-m4"}
    for value, expected in ((8.24, (1, 0)), (8.25, (0, 1))):
        check(outcome(budgets.check_limits, [row(value=value, **china)])[:2] == expected, "an aim")
    # Each stack is one check, and the share of small ones another.
    for sizes, expected in (((127, 64, 512), (4, 0)), ((127, 64, 513), (3, 1)),
                            ((127, 128), (2, 1))):
        rows = [row("stack", size) for size in sizes]
        check(outcome(budgets.check_limits, rows)[:2] == expected, f"stacks of {sizes} bytes")


def test_file():
    rows = budgets.read_rows()
    keys = [(r.kind, r.target, r.item) for r in rows if r.kind != budgets.PEER]
    check(len(keys) > 1000, f"{budgets.KEPT.name} has only {len(keys)} rows")
    check(len(keys) == len(set(keys)), f"{budgets.KEPT.name} has a row twice")
    for limit in budgets.LIMITS:
        check(any(r.kind == limit.kind and re.fullmatch(limit.target, r.target) and
                  re.fullmatch(limit.item, r.item) for r in rows), f"{limit} limits nothing")
    ours = {r.item for r in rows if r.kind == "instructions"}
    peers = [r for r in rows if r.kind == budgets.PEER]
    check(len(peers) > 20, "figures of peers")
    for peer in peers:
        check(peer.item in ours, f"a peer's figure for {peer.item}, which nobody measures here")
        check("gcc" in peer.made_by, f"{peer.made_by}: by which compiler?")


# ---- Stack --------------------------------------------------------------------------------------

SOURCE = """
#include <string.h>
typedef void (*worker)(char *);
typedef struct job { worker on_end; worker step; } job;
void pel_chain(char *out); void pel_pointer(job *j, char *out); void pel_ring(char *out, int n);
void pel_copy(char *out, unsigned n, const char *in); void pel_stranger(char *out);
void elsewhere(char *out);
static __attribute__((noinline)) void low(char *out) { volatile char b[300]; b[0] = *out;
    *out = b[0]; }
static __attribute__((noinline)) void middle(char *out) { volatile char b[200]; b[0] = 1; low(out);
    *out = b[0]; }
void pel_chain(char *out) { middle(out); *out = 1; }
static __attribute__((noinline, used)) void step_large(char *out) { volatile char b[250]; b[0] = 1;
    *out = b[0]; }
void pel_pointer(job *j, char *out)
{
    j->on_end(out);

    j->step(out);

    *out = 2;
}
static void again(char *out, int n);
void pel_ring(char *out, int n) { again(out, n); *out = 3; }
static __attribute__((noinline)) void again(char *out, int n) { if (n) { pel_ring(out, n - 1); }
    *out = 4; }
void pel_copy(char *out, unsigned n, const char *in) { memcpy(out, in, n); *out = 5; }
void pel_stranger(char *out) { elsewhere(out); *out = 6; }
"""


def graph_of(folder):
    source = folder / "trial.c"
    source.write_text(SOURCE)
    target = firmware.HOST
    done = firmware.run("gcc", "-O0", "-fcallgraph-info=su", "-c",
                        source, "-o", folder / "trial.o")
    check(done.returncode == 0, f"{target.name}: {done.stderr}")
    return stack.Graph([folder / "trial"])


def full_name(graph, name):
    return next(title for title in graph.frames if title.rsplit(":", 1)[-1] == name)


def test_stack(folder):
    graph = graph_of(folder)
    frames = {title.rsplit(":", 1)[-1]: size for title, size in graph.frames.items()}
    check(graph.deepest("pel_chain") == frames["pel_chain"] + frames["middle"] + frames["low"]
          and min(frames["low"], frames["middle"]) > 64, "a chain of three")
    rings = {name.rsplit(":", 1)[-1] for name in graph.rings()}
    check(rings == {"pel_ring", "again"}, f"rings: {rings}")
    check(graph.deepest("pel_copy") == frames["pel_copy"] + stack.HELPER_BYTES, "memcpy")
    check(graph.strangers() == ["elsewhere"], f"strangers: {graph.strangers()}")


def test_pointers(folder):
    user, own = (r"\bon_end\(", None), (r"\bstep\(", "step_.*")
    faults, used = graph_of(folder).resolve(())
    check(len(faults) == 2 and not used, f"pointers that nobody lists: {faults}")
    faults, _ = graph_of(folder).resolve((user,))
    check(len(faults) == 1 and "->step(" in faults[0], f"one that nobody lists: {faults}")
    graph = graph_of(folder)
    faults, used = graph.resolve((user, own))
    check(not faults and used == {user[0], own[0]}, f"both listed: {faults}")
    frame = graph.frames
    check(graph.deepest("pel_pointer") ==
          frame["pel_pointer"] + frame[full_name(graph, "step_large")], "the listed one's stack")
    faults, _ = graph_of(folder).resolve((user, (r"\bstep\(", "nobody")))
    check(len(faults) == 1 and "nobody" in faults[0], f"no such function: {faults}")


def test_public():
    names = stack.public_functions()
    check({"pel_blobs_row", "pel_classify_row", "pel_filter_pull", "pel_isqrt64"} <= names,
          "public functions that are missing")
    check(not names & {"pel_boxes", "pel_for_classes"} and all(re.fullmatch(r"pel_[a-z0-9_]+", name)
                                                               for name in names), "no functions")


# ---- Maps and counts ----------------------------------------------------------------------------

MAP = """
Discarded input sections

 .text.pel_unused
                0x00000000       0x40 /x/blobs.o

Linker script and memory map

 .text          0x00008000        0x0 /x/blobs.o
 .text.pel_a    0x00008000       0x10 /x/blobs.o
 .text.pel_blobs_row
                0x00008010       0x22 /x/blobs.o
 .rodata.table  0x00009000        0x8 /x/row_c.o
 .text.start    0x00009100      0x100 /x/main.o
 .bss.memory    0x20000000      0x200 /x/blobs.o
 .ARM.attributes
                0x00000000       0x2e /x/blobs.o
"""


def test_map():
    stems = [pathlib.Path("/x/blobs"), pathlib.Path("/x/row_c"), pathlib.Path("/x/filter")]
    check(linked.kept(MAP, stems) == {"blobs": 0x32, "row_c": 8}, f"{linked.kept(MAP, stems)}")


def test_counts(folder):
    path = folder / "counts"
    path.write_text("sum 10 2\nin f 4\nin g h 6\nsum 7 1\nin f 7\nend\n")
    sums, ended = counts.read_sums(path)
    check(ended and sums == [(10, 2, {"f": 4, "g h": 6}), (7, 1, {"f": 7})], f"{sums}")
    path.write_text("sum 10 2\n")
    check(counts.read_sums(path)[1] is False, "a count that broke off")
    check(counts.read_sums(folder / "nothing") == ([], False), "no count at all")
    for item, number in (("blobs all rand1", 434), ("filter gauss3", 240), ("table row", None),
                         ("filter generic 3x3, valid", 238), ("resize box to half", 120),
                         ("resize bilinear to 240x180", 180), ("edges canny rows", 240)):
        check(counts.expected_number(item) == number, f"{item}: {counts.expected_number(item)}")


def one(checksum, number):
    return {"filter median": counts.Measurement("filter median", checksum, number, 76800, {})}


def test_work():
    good = {"a": one("12", "240"), "b": one("12", "240")}
    check(outcome(counts.check_work, good)[1] == 0, "equal work")
    check(outcome(counts.check_work, {**good, "c": one("13", "240")})[1] == 1, "another checksum")
    check(outcome(counts.check_work, {**good, "c": one("12", "239")})[1] == 1, "a row is missing")


def main():
    test_tolerances()
    test_compare()
    test_limits()
    test_file()
    test_public()
    test_map()
    test_work()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        test_counts(folder)
        if shutil.which("gcc"):
            test_stack(folder)
            test_pointers(folder)
        else:
            report.skip("stacks: there is no gcc")
    return report.close()


if __name__ == "__main__":
    sys.exit(main())
