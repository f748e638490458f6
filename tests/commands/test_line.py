"""`pel line` against spans and total least squares, worked out here."""
import csv
import io
import math
import os

from grids import noise, read_rgb, write_gray, write_rgb
from peltest import collect, equal, main, ok, refused, true

COLUMNS = ["frame", "points", "inliers", "x0", "y0", "x1", "y1", "angle_deg"]


def fitted(*words, path="in.pgm", **options):
    rows = list(csv.reader(io.StringIO(ok("line", "--csv", *words, path, **options).text)))
    equal(rows[0], COLUMNS)
    return [[float(word) if word else None for word in row] for row in rows[1:]]


def centres(rows, label=255, length=(1, 10**6), box=None, columns=False):
    """The centres of the spans of a label, row by row, or column by column."""
    x0, y0, x1, y1 = box or (0, 0, len(rows[0]), len(rows))
    part = [row[x0:x1] for row in rows[y0:y1]]
    found = []
    for line, values in enumerate(zip(*part) if columns else part):
        begin = None
        for at, value in enumerate([*values, None]):
            if value == label and begin is None:
                begin = at
            if value != label and begin is not None:
                if length[0] <= at - begin <= length[1]:
                    centre = (begin + at - 1) / 2
                    found.append((x0 + line, y0 + centre) if columns else (x0 + centre, y0 + line))
                begin = None
    return found


def least_squares(points):
    """Mean, and angle in degrees, of the line with the least squared distances (Pearson 1901)."""
    n = len(points)
    mx, my = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    xx = sum((x - mx)**2 for x, _ in points)
    yy = sum((y - my)**2 for _, y in points)
    xy = sum((x - mx) * (y - my) for x, y in points)
    return mx, my, math.degrees(math.atan2(2 * xy, xx - yy) / 2)


def off(x, y, line):
    mx, my, degrees = line
    angle = math.radians(degrees)
    return abs((y - my) * math.cos(angle) - (x - mx) * math.sin(angle))


def stripe(width, height, slope, start, thick):
    """A band that leans: `thick` pixels wide in every row."""
    rows = [[0] * width for _ in range(height)]
    for y, row in enumerate(rows):
        for x in range(round(start + slope * y), round(start + slope * y) + thick):
            if 0 <= x < width:
                row[x] = 255
    return rows


def check(got, points, what):
    """A fit without leaving out: within 1/16 pixel and a little of the exact one."""
    _, count, inliers, x0, y0, x1, y1, angle = got
    wanted = least_squares(points)
    equal(count, len(points), what)
    true(1 <= inliers <= count, what)
    true(abs((angle - wanted[2] + 90) % 180 - 90) < 0.05, "%s: %r, %r" % (what, angle, wanted))
    for x, y in ((x0, y0), (x1, y1)):
        true(off(x, y, wanted) < 0.15, "%s: end %r of %r" % (what, (x, y), wanted))
    true(x0 <= x1, what)


def test_least_squares():
    for slope in (0.5, -0.25, 0, 1.0):
        rows = stripe(60, 40, slope, 12, 3)
        write_gray("in.pgm", rows)
        check(fitted("--rounds", 0)[0], centres(rows), slope)
    rows = [list(row) for row in zip(*stripe(60, 40, 0.3, 9, 4))]
    write_gray("in.pgm", rows)
    check(fitted("--rounds", 0, "--columns")[0], centres(rows, columns=True), "columns")


def test_which_points():
    rows = [[255 * (a > 90) for a in row] for row in noise(31, 22, 1, 180)]
    write_gray("in.pgm", rows)
    for columns in (False, True):
        words = ("--columns",) if columns else ()
        equal(fitted(*words)[0][1], len(centres(rows, columns=columns)))
        equal(fitted("--length", "2-3", *words)[0][1],
              len(centres(rows, length=(2, 3), columns=columns)))
        equal(fitted("--roi", "5,4,25,19", *words)[0][1],
              len(centres(rows, box=(5, 4, 25, 19), columns=columns)))
        equal(fitted("--label", 0, *words)[0][1], len(centres(rows, 0, columns=columns)))


def test_far_points_are_left_out():
    rows = stripe(60, 40, 0.5, 12, 3)
    line = centres(rows)
    for i in range(8):
        rows[3 + 4 * i][52 + i % 5] = 255
    write_gray("in.pgm", rows)
    equal(len(centres(rows)), 48, "the test's own picture")
    got = fitted()[0]
    equal(got[1:3], [48, 40])
    check([0, 40, *got[2:]], line, "robust")
    true(off(got[3], got[4], least_squares(centres(rows))) > 1,
         "the others would have drawn it away")


def test_no_line():
    write_gray("in.pgm", [[0] * 9] * 9)
    equal(ok("line", "--csv", "in.pgm").text, ",".join(COLUMNS) + "\n0,0,0,,,,,\n")
    true("no line" in ok("line", "in.pgm").text, "for people")
    rows = [[0] * 9 for _ in range(9)]
    rows[4][4] = 255
    write_gray("in.pgm", rows)
    equal(fitted()[0][:3], [0, 1, 0])


def test_streams_and_drawing():
    rows = stripe(40, 30, 0.5, 12, 3)
    data = open(write_gray("in.pgm", rows), "rb").read()
    equal([row[0] for row in fitted(path="-", stdin=data + data)], [0, 1])
    out = ok("line", "in.pgm", "-o", "out.ppm").text
    true(out.startswith("frame 0: from ("), out)
    red, green, _ = read_rgb("out.ppm")
    marked = [(x, y) for y in range(30) for x in range(40) if (red[y][x], green[y][x]) == (255, 40)]
    true(len(marked) >= 28, "a pixel in every row: %d" % len(marked))
    wanted = least_squares(centres(rows))
    true(all(off(x, y, wanted) < 1 for x, y in marked), "on the line")
    write_rgb("in.ppm", rows, rows, rows)
    equal(fitted(path="in.ppm"), fitted(path="in.pgm"), "white is white in colour")


def test_refuses():
    write_gray("in.pgm", [[255 * (x % 2) for x in range(100)] for _ in range(100)])
    refused(1, ["in.pgm", "4096", "--roi"], "line", "in.pgm")
    refused(1, ["in.pgm", "0,0,101,5", "100x100"], "line", "--roi", "0,0,101,5", "in.pgm")
    refused(1, ["none.pgm"], "line", "none.pgm")
    refused(2, ["one IN", "0"], "line")
    refused(2, ["--length", "'3'"], "line", "--length", 3, "in.pgm")
    refused(2, ["--length", "'3-2'"], "line", "--length", "3-2", "in.pgm")
    refused(2, ["--roi", "'1,2,3'"], "line", "--roi", "1,2,3", "in.pgm")
    refused(2, ["--label", "'256'"], "line", "--label", 256, "in.pgm")
    refused(2, ["--rounds", "'9'"], "line", "--rounds", 9, "in.pgm")
    refused(2, ["--distance"], "line", "--distance", "x", "in.pgm")
    refused(2, ["both"], "line", "--csv", "-o", "-", "in.pgm")
    refused(2, ["--nonsense"], "line", "--nonsense")
    equal(os.path.exists("out.ppm"), False)


if __name__ == "__main__":
    main(collect(globals()))
