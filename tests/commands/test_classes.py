"""`pel classes`: what a class file says, and the other forms that it can be written in."""
import glob
import os
import shutil
import subprocess
from fractions import Fraction
from math import floor

from peltest import SOURCE, collect, equal, main, ok, paint, parse_rows, refused, true, write

TEXT = """[Colors]
(255,128,  0) 0.5000 2 orange
(  0,  0,255) 0.0000 1 blue
[Thresholds]
( 40:200,  0:100, 150:255)
(  0:100, 200:255,  0:120)
#! range limited
"""
BOXES = [(40, 200, 0, 100, 150, 255), (0, 100, 200, 255, 0, 120)]


def limited(y, u, v):
    """A full-range colour in limited range, rounded, halves upward."""
    return (floor(16 + Fraction(219 * y, 255) + Fraction(1, 2)),
            *(floor(128 + Fraction(224 * (c - 128), 255) + Fraction(1, 2)) for c in (u, v)))


def label(y, u, v):
    for index, (y0, y1, u0, u1, v0, v1) in enumerate(BOXES):
        if y0 <= y <= y1 and u0 <= u <= u1 and v0 <= v <= v1:
            return index + 1
    return 0


def test_the_list_tells_names_boxes_colours_and_range():
    out = ok("classes", write("c.classes", TEXT)).text
    lines = out.splitlines()
    equal(lines[1].split(), ["0", "orange", "40..200", "0..100", "150..255", "255,128,0"])
    equal(lines[2].split(), ["1", "blue", "0..100", "200..255", "0..120", "0,0,255"])
    equal(lines[3], "colour range: limited")


def test_text_round_trip():
    ok("classes", write("c.classes", TEXT), "again.classes")
    equal(ok("classes", "again.classes").text, ok("classes", "c.classes").text)


def table(text):
    """The cells of the .tm that the class file becomes."""
    ok("classes", write("c.classes", text), "c.tm")
    with open("c.tm", "rb") as file:
        data = file.read()
    header = b"TMAP\nYUV8\n16 64 64\n"
    equal(data[:len(header)], header)
    return data[len(header):]


def middles():
    return ((16 * y + 8, 4 * u + 2, 4 * v + 2)
            for y in range(16) for u in range(64) for v in range(64))


def test_table_is_cmvisions_with_every_cell_classified_at_its_middle():
    wanted = bytes(label(*middle) for middle in middles())
    equal(table(TEXT.replace("limited", "full")) == wanted, True, "65536 labels")
    true(1 in wanted and 2 in wanted, "both classes occur")
    equal(len(ok("classes", "c.tm").text.splitlines()), 4)


def test_table_of_limited_classes_is_a_table_of_full_range():
    equal(limited(0, 0, 255), (16, 16, 240))
    equal(limited(255, 128, 128), (235, 128, 128))
    wanted = bytes(label(*limited(*middle)) for middle in middles())
    true(wanted != bytes(label(*middle) for middle in middles()), "the range matters")
    equal(table(TEXT) == wanted, True, "65536 labels")
    equal(ok("classes", "c.tm").text.splitlines()[-1], "colour range: full")


def test_table_finds_what_its_limited_classes_find():
    path = write("p.ppm", paint(["oo.b"], {"o": (255, 128, 0), "b": (0, 0, 255)}))
    found = []
    for name in (write("c.classes", TEXT), "c.tm"):
        ok("classes", "c.classes", "c.tm")
        rows = parse_rows(ok("blobs", "-c", name, "--csv", path).text)
        found.append([row[:2] + row[3:] for row in rows])
    equal([row[1:3] for row in found[0]], [(0, 2), (1, 1)])
    equal(found[1], found[0])


def test_limited_frames_and_a_table():
    ok("classes", write("c.classes", TEXT), "c.tm")
    raw = write("f.yuv", bytes(8))
    words = ["--raw", "YUYV", "4x1", "--range", "limited", raw]
    for command in (["blobs", "-c", "c.tm", *words], ["runs", "-c", "c.tm", *words],
                    ["classify", "-c", "c.tm", *words, "out.ppm"]):
        said = refused(1, ["f.yuv", "limited", "c.tm is a table", "full range", "pel convert",
                           "the class file"], *command)
        equal("#!" in said.err, False, "a table has no lines to write into")
    ok("blobs", "-c", "c.classes", *words)


def compile_and_run(source, program):
    write("main.c", program)
    includes = ["-I", os.path.join(SOURCE, "lib", "include")]
    lib = os.path.join(SOURCE, "lib", "src")
    sources = glob.glob(os.path.join(lib, "**", "*.c"), recursive=True)
    compiler = shutil.which("cc") or shutil.which("gcc")
    subprocess.run([compiler, "-std=c99", *includes, "-I", lib, "main.c", source, *sources,
                    "-o", "program"], check=True)
    return subprocess.run(["./program"], check=True, stdout=subprocess.PIPE).stdout.decode()


def test_boxes_as_c_source_classify_as_the_file_does():
    ok("classes", "--c-array", "robot", write("c.classes", TEXT), "c.c")
    out = compile_and_run("c.c", """#include <pel.h>
#include <stdio.h>
extern const pel_color_box robot[];
int main(void) {
    static pel_boxes boxes;
    const pel_classifier classifier = {.boxes = &boxes};
    for (unsigned i = 0; i < 2; i++) pel_boxes_set(&boxes, i, &robot[i]);
    for (unsigned i = 0; i < 4096; i++)
        putchar('0' + pel_classify_color(&classifier, (uint8_t)(i >> 8 << 4),
                                         (uint8_t)(i >> 4 << 4), (uint8_t)(i << 4)));
}
""")
    equal(out, "".join(str(label(i >> 8 << 4, (i >> 4 & 15) << 4, (i & 15) << 4))
                       for i in range(4096)))


def test_table_as_c_source_classifies_as_the_table_does():
    ok("classes", write("c.classes", TEXT), "c.tm")
    ok("classes", "--c-array", "cells", "c.tm", "t.c")
    out = compile_and_run("t.c", """#include <pel.h>
#include <stdio.h>
extern const uint8_t cells[65536];
int main(void) {
    const pel_classifier classifier = {.lut = {cells, 4, 6, 6}, .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    for (unsigned i = 0; i < 4096; i++)
        putchar('0' + pel_classify_color(&classifier, (uint8_t)(i >> 8 << 4),
                                         (uint8_t)(i >> 4 << 4), (uint8_t)(i << 4)));
}
""")
    equal(out, "".join(str(label(*limited((i >> 8 << 4) + 8, ((i >> 4 & 15) << 4) + 2,
                                          ((i & 15) << 4) + 2))) for i in range(4096)))


def test_refusals():
    write("c.classes", TEXT)
    refused(2, ["no class file"], "classes")
    refused(2, ["'x'"], "classes", "c.classes", "y", "x")
    for name in ("1st", "int", "class", "_Bool", "co_await", "and"):
        refused(2, ["'%s'" % name], "classes", "--c-array", name, "c.classes", "c.c")
    equal(os.path.exists("c.c"), False)
    ok("classes", "--c-array", "integer", "c.classes", "c.c")
    refused(1, ["missing.classes"], "classes", "missing.classes")
    ok("classes", "c.classes", "c.tm")
    refused(1, ["out.classes", ".tm"], "classes", "c.tm", "out.classes")
    equal(os.path.exists("out.classes"), False)


if __name__ == "__main__":
    main(collect(dict(globals())))
