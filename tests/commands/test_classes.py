"""`pel classes`: what a class file says, and the other forms that it can be written in."""
import os
import shutil
import subprocess
import tempfile

from peltest import SOURCE, collect, equal, main, ok, refused, true, write

TEXT = """[Colors]
(255,128,  0) 0.5000 2 orange
(  0,  0,255) 0.0000 1 blue
[Thresholds]
( 40:200,  0:100, 150:255)
(  0:100, 200:255,  0:120)
#! range limited
"""
BOXES = [(40, 200, 0, 100, 150, 255), (0, 100, 200, 255, 0, 120)]


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


def test_table_is_cmvisions_with_every_cell_classified_at_its_middle():
    ok("classes", write("c.classes", TEXT), "c.tm")
    with open("c.tm", "rb") as file:
        data = file.read()
    header = b"TMAP\nYUV8\n16 64 64\n"
    equal(data[:len(header)], header)
    wanted = bytes(label(16 * y + 8, 4 * u + 2, 4 * v + 2)
                   for y in range(16) for u in range(64) for v in range(64))
    equal(data[len(header):] == wanted, True, "65536 labels")
    true(1 in wanted and 2 in wanted, "both classes occur")
    equal(len(ok("classes", "c.tm").text.splitlines()), 4)


def compile_and_run(source, program):
    write("main.c", program)
    includes = ["-I", os.path.join(SOURCE, "lib", "include")]
    lib = os.path.join(SOURCE, "lib", "src")
    sources = [os.path.join(lib, name) for name in ("classify.c", "image.c", "row/row_c.c")]
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
        putchar('0' + pel_classify_color(&classifier, (uint8_t)(i >> 8 << 4), (uint8_t)(i >> 4 << 4),
                                         (uint8_t)(i << 4)));
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
    const pel_classifier classifier = {.lut = {cells, 4, 6, 6}};
    for (unsigned i = 0; i < 4096; i++)
        putchar('0' + pel_classify_color(&classifier, (uint8_t)(i >> 8 << 4), (uint8_t)(i >> 4 << 4),
                                         (uint8_t)(i << 4)));
}
""")
    equal(out, "".join(str(label((i >> 8 << 4) + 8, ((i >> 4 & 15) << 4) + 2, ((i & 15) << 4) + 2))
                       for i in range(4096)))


def test_refusals():
    write("c.classes", TEXT)
    refused(2, ["no class file"], "classes")
    refused(2, ["'x'"], "classes", "c.classes", "y", "x")
    refused(2, ["'1st'"], "classes", "--c-array", "1st", "c.classes", "c.c")
    refused(1, ["missing.classes"], "classes", "missing.classes")
    ok("classes", "c.classes", "c.tm")
    refused(1, ["out.classes", ".tm"], "classes", "c.tm", "out.classes")
    equal(os.path.exists("out.classes"), False)


if __name__ == "__main__":
    main(collect(dict(globals())))
