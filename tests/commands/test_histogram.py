"""`pel histogram` and `pel sheet` against their definitions."""
import csv
import io
import math
import os
from fractions import Fraction

from grids import luma, noise, read_gray, read_rgb, write_gray, write_rgb
from peltest import collect, equal, half_up, main, ok, ppm, read_pnm, refused, true, write


def counted(*words, path):
    """What `pel histogram --csv` counts: {column: 256 counts}."""
    rows = list(csv.reader(io.StringIO(ok("histogram", "--csv", *words, path).text)))
    equal([row[0] for row in rows[1:]], [str(value) for value in range(256)])
    return {name: [int(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0]) if i}


def bins(*grids):
    values = [value for rows in grids for row in rows for value in row]
    return [values.count(value) for value in range(256)]


def cumulative(counts):
    return [sum(counts[:value + 1]) for value in range(256)]


# ---- Histogram --------------------------------------------------------------------------------


def test_gray():
    rows = noise(23, 17, 1)
    write_gray("in.pgm", rows)
    equal(counted(path="in.pgm"), {"count": bins(rows)})
    equal(counted("--cumulative", path="in.pgm"), {"count": cumulative(bins(rows))})
    equal(list(counted(path="in.pgm")), ["count"])


def test_colours():
    channels = [noise(23, 17, seed) for seed in (2, 3, 4)]
    write_rgb("in.ppm", *channels)
    wanted = {name: bins(rows) for name, rows in zip(("red", "green", "blue"), channels)}
    equal(counted(path="in.ppm"), wanted)
    equal(list(counted(path="in.ppm")), ["red", "green", "blue"])
    equal(counted("--gray", path="in.ppm"), {"count": bins(luma(*channels))})


def test_streams_count_together():
    a, b = noise(9, 4, 5), noise(3, 6, 6)
    data = b"".join(open(write_gray("x.pgm", rows), "rb").read() for rows in (a, b))
    out = ok("histogram", "--csv", "-", stdin=data).text
    equal([int(line.split(",")[1]) for line in out.splitlines()[1:]], bins(a, b))
    colour = open(write_rgb("in.ppm", a, a, a), "rb").read()
    mixed = write("mixed.ppm", data + colour)
    refused(1, ["mixed.ppm", "--gray"], "histogram", mixed)
    equal(counted("--gray", path=mixed), {"count": bins(a, b, a)})


def test_the_table():
    rows = noise(23, 17, 7, 180)
    write_gray("in.pgm", rows)
    values = sorted(sum(rows, []))
    count, total = len(values), sum(values)
    mean = Fraction(total, count)
    variance = Fraction(sum(v * v for v in values), count) - mean * mean

    def shown(value):  # rounded to 1/256, then to 1/100
        q8 = half_up(value.numerator * 256, value.denominator)
        return q8 / 256

    lines = ok("histogram", "in.pgm").text.splitlines()
    equal(len(lines), 2)
    words = lines[1].split()
    equal(words[:4], ["gray", str(count), str(values[0]), str(values[-1])])
    true(abs(float(words[4]) - shown(mean)) < 0.0051, "mean %s" % words[4])
    true(abs(float(words[5]) - shown(variance)) < 0.0051, "variance %s" % words[5])
    ranks = [values[math.ceil(Fraction(percent * count, 100)) - 1]
             for percent in (1, 5, 25, 50, 75, 95, 99)]
    equal([int(word) for word in words[6:13]], ranks)
    channels = [rows, noise(23, 17, 8), noise(23, 17, 9)]
    write_rgb("in.ppm", *channels)
    lines = ok("histogram", "in.ppm").text.splitlines()
    equal([line.split()[0] for line in lines[1:]], ["red", "green", "blue"])


def bars(counts, most):
    return [-(-256 * count // most) for count in counts]


def test_the_picture():
    rows = noise(23, 17, 10, 90)
    write_gray("in.pgm", rows)
    for words, counts in (((), bins(rows)), (("--cumulative",), cumulative(bins(rows)))):
        ok("histogram", *words, "-o", "out.pgm", "in.pgm")
        heights = bars(counts, max(counts))
        equal(read_gray("out.pgm"),
              [[255 * (256 - y <= heights[x // 2]) for x in range(512)] for y in range(256)])
    channels = [rows, noise(23, 17, 11), noise(23, 17, 12)]
    write_rgb("in.ppm", *channels)
    printed = ok("histogram", "--csv", "-o", "out.ppm", "in.ppm").text
    equal(len(printed.splitlines()), 257, "the numbers, too")
    most = max(map(max, map(bins, channels)))
    equal(read_rgb("out.ppm"),
          [[[255 * (256 - y <= height) for height in bars(bins(grid), most) for _ in range(2)]
            for y in range(256)] for grid in channels])
    equal(ok("histogram", "-o", "-", "in.ppm").out, open("out.ppm", "rb").read())


def test_histogram_refuses():
    write_gray("in.pgm", noise(8, 8, 13))
    refused(2, ["one IN", "0"], "histogram")
    refused(2, ["one IN", "2"], "histogram", "in.pgm", "in.pgm")
    refused(2, ["both"], "histogram", "--csv", "-o", "-", "in.pgm")
    refused(2, ["--nonsense"], "histogram", "--nonsense")
    refused(1, ["none.pgm"], "histogram", "none.pgm")
    refused(2, ["out.bmp", ".ppm"], "histogram", "-o", "out.bmp", "none.pgm")
    path = write("many.raw", b"")
    with open(path, "wb") as file:
        file.truncate(65 * 1024 * 1024)
    refused(1, ["many.raw", "2^26", "--frame"], "histogram", "--raw", "GRAY8", "1024x1024", path)


# ---- Sheet ------------------------------------------------------------------------------------


def solid(name, width, height, color):
    return write(name, ppm(width, height, bytes(color) * (width * height)))


def sheet_pixels(path):
    _, width, height, pixels, _ = read_pnm(path)
    return [[tuple(pixels[3 * (y * width + x):][:3]) for x in range(width)] for y in range(height)]


RED, GREEN, BLUE, WHITE, GRAY = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255,) * 3, (7,) * 3


def test_sheet():
    names = [solid("a.ppm", 3, 2, RED), solid("b.ppm", 1, 2, GREEN), solid("c.ppm", 3, 2, BLUE),
             write_gray("d.pgm", [[7] * 3])]
    ok("sheet", "--columns", 2, "--gap", 1, "out.ppm", *names)
    gap = [WHITE]
    equal(sheet_pixels("out.ppm"),
          [[RED] * 3 + gap + gap + [GREEN] + gap] * 2 + [gap * 7] +
          [[BLUE] * 3 + gap + [GRAY] * 3] + [[BLUE] * 3 + gap * 4])
    ok("sheet", "--gap", 0, "out.ppm", *names)
    equal(len(sheet_pixels("out.ppm")), 4)
    equal(len(sheet_pixels("out.ppm")[0]), 6, "square by itself")
    ok("sheet", "--columns", 9, "--gap", 0, "out.ppm", *names)
    equal(len(sheet_pixels("out.ppm")), 2, "no more columns than pictures")


def test_sheet_of_a_stream():
    data = b"".join(open(solid("x.ppm", 2, 2, color), "rb").read() for color in (RED, GREEN, BLUE))
    ok("sheet", "--columns", 3, "--gap", 0, "out.ppm", "-", stdin=data)
    equal(sheet_pixels("out.ppm"), [[RED] * 2 + [GREEN] * 2 + [BLUE] * 2] * 2)


def test_sheet_refuses():
    name = solid("a.ppm", 3, 2, RED)
    refused(2, ["OUT", "IN"], "sheet", "out.ppm")
    refused(2, ["out.bmp", ".ppm"], "sheet", "out.bmp", "none.ppm")
    refused(2, ["--columns", "'0'"], "sheet", "--columns", 0, "out.ppm", name)
    refused(2, ["--nonsense"], "sheet", "--nonsense")
    refused(1, ["none.ppm"], "sheet", "out.ppm", "none.ppm")
    refused(1, ["out.ppm", "8192"], "sheet", "--gap", 8192, "--columns", 2, "out.ppm", name, name)
    equal(os.path.exists("out.ppm"), False)


if __name__ == "__main__":
    main(collect(globals()))
