"""`pel corners` and `pel edges` against their definitions."""
import csv
import io
import math
import os
from fractions import Fraction

from grids import (SOBEL_X, SOBEL_Y, clamp, correlate, cut, each, luma, noise, read_gray,
                   read_rgb, write_gray, write_rgb)
from peltest import (DEMO, collect, equal, half_up, main, ok, parse_pnm, read_pnm, refused, true,
                     write)

# ---- Corners: definitions ---------------------------------------------------------------------


def tensor(rows):
    """a, b, c at every pixel: sums over 3x3 of products of Sobel's gradients. The edge pixels of
    the picture repeat without end, so gradients outside of it are those of the repeated pixels."""
    height, width = len(rows), len(rows[0])
    wide = [[rows[clamp(y, 0, height - 1)][clamp(x, 0, width - 1)] for x in range(-2, width + 2)]
            for y in range(-2, height + 2)]
    gx, gy = correlate(wide, SOBEL_X, "valid"), correlate(wide, SOBEL_Y, "valid")

    def summed(left, right):
        return correlate(each(lambda p, q: p * q, left, right), [1] * 9, "valid")

    return summed(gx, gx), summed(gx, gy), summed(gy, gy)


def harris(rows, k_q15=1311):
    return each(lambda a, b, c: (2**15 * (a * c - b * b) - k_q15 * (a + c)**2) // 2**29,
                *tensor(rows))


def smaller_eigenvalue(a, b, c):
    # floor((s - sqrt(d)) / 2): the largest n with s - 2 n >= sqrt(d)
    s, d = a + c, (a - c)**2 + 4 * b * b
    n = (s - math.isqrt(d)) // 2
    while s - 2 * n < 0 or (s - 2 * n)**2 < d:
        n -= 1
    return n


def shi_tomasi(rows):
    return each(smaller_eigenvalue, *tensor(rows))


CIRCLE = [(0, -3), (1, -3), (2, -2), (3, -1), (3, 0), (3, 1), (2, 2), (1, 3), (0, 3), (-1, 3),
          (-2, 2), (-3, 1), (-3, 0), (-3, -1), (-2, -2), (-1, -3)]


def fast(rows, threshold=20):
    height, width = len(rows), len(rows[0])
    found = [[0] * width for _ in range(height)]
    for y in range(3, height - 3):
        for x in range(3, width - 3):
            steps = [rows[y + dy][x + dx] - rows[y][x] for dx, dy in CIRCLE]
            # an arc passes t if all of it differs by more than t
            best = max(max(min(steps[(i + j) % 16] * sign for j in range(9)) - 1
                           for i in range(16)) for sign in (1, -1))
            found[y][x] = best if best >= threshold else 0
    return found


def neighbours(responses, x, y):
    """The eight around, those that came before first; None outside."""
    def at(i, j):
        inside = 0 <= i < len(responses[0]) and 0 <= j < len(responses)
        return responses[j][i] if inside else None
    return ([at(x - 1, y - 1), at(x, y - 1), at(x + 1, y - 1), at(x - 1, y)],
            [at(x + 1, y), at(x - 1, y + 1), at(x, y + 1), at(x + 1, y + 1)])


def corners(responses, threshold, suppress="first"):
    """(x, y, response), strongest first, then by y, then by x."""
    found = []
    for y, row in enumerate(responses):
        for x, value in enumerate(row):
            before, after = neighbours(responses, x, y)
            stays = value >= threshold and (suppress == "none" or (
                all(other is None or value > other for other in before) and
                all(other is None or (value > other if suppress == "strict" else value >= other)
                    for other in after)))
            if stays:
                found.append((x, y, value))
    return sorted(found, key=lambda corner: (-corner[2], corner[1], corner[0]))


def listed(*words, path="in.pgm"):
    """What `pel corners --csv` lists."""
    rows = list(csv.reader(io.StringIO(ok("corners", "--csv", *words, path).text)))
    equal(rows[0], ["x", "y", "response"])
    return [tuple(map(int, row)) for row in rows[1:]]


def squares(width, height, seed):
    """Bright rectangles on dark noise: something with corners."""
    rows = noise(width, height, seed, 20)
    for i, (x, y, w, h) in enumerate(((4, 3, 9, 7), (16, 9, 11, 8), (7, 14, 6, 9))):
        for j in range(y, min(height, y + h)):
            for k in range(x, min(width, x + w)):
                rows[j][k] += 100 + 50 * i
    return rows


# ---- Corners ----------------------------------------------------------------------------------


def test_harris():
    for rows in (noise(13, 11, 1), squares(30, 25, 2), noise(1, 1, 3), noise(2, 5, 4)):
        write_gray("in.pgm", rows)
        wanted = corners(harris(rows), 1)
        equal(listed("--max", 10000), wanted)
        equal(listed("--max", 3), wanted[:3])
        equal(listed("--threshold", 100000), [c for c in wanted if c[2] >= 100000][:100])
    true(len(wanted) == 0 or wanted[0][2] > 0, "responses")


def test_harris_with_another_k():
    rows = squares(30, 25, 5)
    write_gray("in.pgm", rows)
    k_q15 = half_up(60 * 32768, 1000)
    equal(listed("--k", "0.06", "--max", 10000), corners(harris(rows, k_q15), 1))


def test_shi_tomasi():
    rows = squares(30, 25, 6)
    write_gray("in.pgm", rows)
    equal(listed("--method", "shi-tomasi", "--max", 10000), corners(shi_tomasi(rows), 1))


def test_fast():
    rows = squares(30, 25, 7)
    write_gray("in.pgm", rows)
    for words, threshold in (((), 20), (("--threshold", 1), 1), (("--threshold", 90), 90)):
        wanted = corners(fast(rows, threshold), threshold)
        true(wanted, "the test's own picture")
        equal(listed("--method", "fast", "--max", 10000, *words), wanted, words)


def test_suppression():
    rows = each(lambda v: v // 64 * 64, noise(20, 15, 8))
    write_gray("in.pgm", rows)
    for how in ("first", "strict", "none"):
        equal(listed("--suppress", how, "--max", 10000), corners(harris(rows), 1, how), how)


def test_a_white_square():
    rows = [[200 if 8 <= x < 20 and 6 <= y < 15 else 10 for x in range(32)] for y in range(24)]
    write_gray("in.pgm", rows)
    equal(sorted(c[:2] for c in listed("--max", 4)), [(8, 6), (8, 14), (19, 6), (19, 14)])


def vertex(before, value, after):
    """Of the parabola through three values, in 1/16, halves upward."""
    if before is None or after is None:
        return 0
    bend = 2 * value - before - after
    return 0 if bend <= 0 else half_up(8 * (after - before), bend)


def test_subpixel():
    rows = squares(30, 25, 9)
    write_gray("in.pgm", rows)
    responses = harris(rows)
    wanted = []
    for x, y, value in corners(responses, 1):
        before, after = neighbours(responses, x, y)
        wanted.append((x + Fraction(vertex(before[3], value, after[0]), 16),
                       y + Fraction(vertex(before[1], value, after[2]), 16), value))
    out = ok("corners", "--csv", "--subpixel", "--max", 10000, "in.pgm").text.splitlines()
    got = [line.split(",") for line in out[1:]]
    true(all(len(word.split(".")[1]) == 4 for row in got for word in row[:2]), "four decimals")
    equal([(Fraction(x), Fraction(y), int(value)) for x, y, value in got], wanted)


def test_corners_for_people():
    rows = squares(30, 25, 10)
    write_gray("in.pgm", rows)
    wanted = corners(harris(rows), 1)
    lines = ok("corners", "--max", 5, "in.pgm").text.splitlines()
    equal(lines[0], "frame 0: %d corners, the strongest 5:" % len(wanted))
    equal(lines[1].split(), ["x", "y", "response"])
    equal([tuple(map(int, line.split())) for line in lines[2:]], wanted[:5])
    write_gray("in.pgm", [[7] * 9] * 9)
    equal(ok("corners", "in.pgm").text.splitlines()[0], "frame 0: 0 corners, all 0")


def test_corners_of_colours_and_streams():
    channels = [squares(30, 25, seed) for seed in (11, 12, 13)]
    gray = luma(*channels)
    data = b"".join(open(path, "rb").read()
                    for path in (write_rgb("in.ppm", *channels), write_gray("in.pgm", gray)))
    out = ok("corners", "--csv", "-", stdin=data).text
    wanted = "".join("%d,%d,%d\n" % corner for corner in corners(harris(gray), 1)[:100])
    equal(out, "x,y,response\n" + wanted + "\n" + wanted)


def test_corners_drawn():
    rows = [[200 if 8 <= x < 20 and 6 <= y < 15 else 10 for x in range(32)] for y in range(24)]
    write_gray("in.pgm", rows)
    out = ok("corners", "--max", 1, "--csv", "in.pgm", "-o", "out.ppm").text
    x, y, _ = map(int, out.splitlines()[1].split(","))
    red, green, blue = read_rgb("out.ppm")
    for i in (-3, -1, 1, 3):
        for at, line in ((x + i, y), (x, y + i)):
            equal((red[line][at], green[line][at], blue[line][at]), (255, 40, 40), (at, line))
    equal((red[y][x], green[y][x], blue[y][x]), (rows[y][x],) * 3, "the corner itself stays")
    marks = sum(r != g for line in zip(red, green) for r, g in zip(*line))
    equal(marks, 12, "pixels of a cross")
    equal(ok("corners", "--max", 1, "in.pgm", "-o", "-").out, open("out.ppm", "rb").read())


def test_the_demo_has_corners():
    kind, width, _, pixels, _ = read_pnm(os.path.join(DEMO, "robot.ppm"))
    equal(kind, "P6")
    rows = luma(*(cut(pixels[i::3], width) for i in range(3)))
    equal(listed(path=os.path.join(DEMO, "robot.ppm")), corners(harris(rows), 1)[:100])


def test_corners_refuse():
    write_gray("in.pgm", noise(8, 8, 14))
    refused(2, ["one IN", "0"], "corners")
    refused(2, ["one IN", "2"], "corners", "in.pgm", "in.pgm")
    refused(2, ["--method", "'sift'"], "corners", "--method", "sift", "in.pgm")
    refused(2, ["--suppress", "'last'"], "corners", "--suppress", "last", "in.pgm")
    refused(2, ["--max", "'0'"], "corners", "--max", "0", "in.pgm")
    refused(2, ["--threshold", "'0'"], "corners", "--threshold", "0", "in.pgm")
    refused(2, ["at most 254"], "corners", "--method", "fast", "--threshold", "255", "in.pgm")
    refused(2, ["--subpixel"], "corners", "--method", "fast", "--subpixel", "in.pgm")
    refused(2, ["--k", "'0.25'"], "corners", "--k", "0.25", "in.pgm")
    refused(2, ["both"], "corners", "--csv", "-o", "-", "in.pgm")
    refused(2, ["'out.bmp'"], "corners", "-o", "out.bmp", "in.pgm")
    refused(2, ["--nonsense"], "corners", "--nonsense")
    refused(1, ["none.pgm"], "corners", "none.pgm")
    refused(1, ["same file"], "corners", "-o", "in.pgm", "in.pgm")


# ---- Edges ------------------------------------------------------------------------------------


def candidates(rows, low, high):
    """Canny's edge pixels before hysteresis: 0, 128 weak, 255 strong."""
    height, width = len(rows), len(rows[0])
    gx, gy = correlate(rows, SOBEL_X), correlate(rows, SOBEL_Y)
    size = each(lambda a, b: abs(a) + abs(b), gx, gy)

    def at(x, y):
        return size[y][x] if 0 <= x < width and 0 <= y < height else 0

    found = [[0] * width for _ in range(height)]
    slope = Fraction(13573, 32768)  # tan 22.5 degrees
    for y in range(height):
        for x in range(width):
            m, across, down = size[y][x], abs(gx[y][x]), abs(gy[y][x])
            if down < slope * across:
                top = m > at(x - 1, y) and m >= at(x + 1, y)
            elif down > (2 + slope) * across:
                top = m > at(x, y - 1) and m >= at(x, y + 1)
            elif (gx[y][x] < 0) == (gy[y][x] < 0):
                top = m > at(x - 1, y - 1) and m > at(x + 1, y + 1)
            else:
                top = m > at(x + 1, y - 1) and m > at(x - 1, y + 1)
            if top and m > low:
                found[y][x] = 255 if m > high else 128
    return found


def around(x, y, width, height):
    return [(i, j) for j in (y - 1, y, y + 1) for i in (x - 1, x, x + 1)
            if 0 <= i < width and 0 <= j < height and (i, j) != (x, y)]


def linked(found):
    """All that a chain of neighbours links to a strong pixel."""
    height, width = len(found), len(found[0])
    kept = [[255 * (value == 255) for value in row] for row in found]
    waiting = [(x, y) for y in range(height) for x in range(width) if kept[y][x]]
    while waiting:
        for i, j in around(*waiting.pop(), width, height):
            if found[j][i] and not kept[j][i]:
                kept[j][i] = 255
                waiting.append((i, j))
    return kept


def linked_rows(found):
    """Row by row: a stretch stays if it has a strong pixel, or touches one of the row above (as
    linked) or of the row below (as it is)."""
    kept = []
    for y, row in enumerate(found):
        below = found[y + 1] if y + 1 < len(found) else [0] * len(row)
        above = kept[-1] if kept else [0] * len(row)
        made, x = [0] * len(row), 0
        while x < len(row):
            end = x
            while end < len(row) and row[end]:
                end += 1
            if end > x:
                span = slice(max(0, x - 1), end + 1)
                if 255 in row[x:end] or 255 in above[span] or 255 in below[span]:
                    made[x:end] = [255] * (end - x)
            x = end + 1
        kept.append(made)
    return kept


def edges(*words, path="in.pgm"):
    ok("edges", *words, path, "out.pgm")
    return read_gray("out.pgm")


def test_edges():
    for rows in (noise(17, 13, 15), squares(30, 25, 16), noise(1, 1, 17), noise(4, 2, 18),
                 correlate(noise(25, 20, 19, 28), [1] * 9)):
        write_gray("in.pgm", rows)
        for low, high in ((100, 200), (0, 0), (200, 600), (50, 900), (2040, 2040)):
            words = ("--low", low, "--high", high)
            found = candidates(rows, low, high)
            equal(edges(*words, "--link", "none"), found, (words, "none"))
            equal(edges(*words), linked(found), (words, "whole"))
            equal(edges(*words, "--link", "rows"), linked_rows(found), (words, "rows"))


def test_default_thresholds():
    rows = squares(30, 25, 20)
    write_gray("in.pgm", rows)
    for words, low, high in (((), 100, 200), (("--high", 60), 60, 60), (("--low", 300), 300, 300),
                             (("--low", 50), 50, 200), (("--high", 500), 100, 500)):
        equal(edges(*words), linked(candidates(rows, low, high)), words)


def test_edges_of_colours_and_streams():
    channels = [squares(30, 25, seed) for seed in (21, 22, 23)]
    gray = luma(*channels)
    wanted = bytes(sum(linked(candidates(gray, 100, 200)), []))
    data = b"".join(open(path, "rb").read()
                    for path in (write_rgb("in.ppm", *channels), write_gray("in.pgm", gray)))
    out = ok("edges", "-", "-", stdin=data).out
    for _ in range(2):
        picture, out = parse_pnm(out)
        equal(picture[:4], ("P5", 30, 25, wanted))
    equal(out, b"")


def test_edges_of_the_demo():
    kind, width, _, pixels, _ = read_pnm(os.path.join(DEMO, "robot.ppm"))
    equal(kind, "P6")
    rows = luma(*(cut(pixels[i::3], width) for i in range(3)))
    wanted = linked(candidates(rows, 100, 200))
    true(sum(map(sum, wanted)) > 255 * 1000, "the demo has edges")
    equal(edges(path=os.path.join(DEMO, "robot.ppm")) == wanted, True)


def test_edges_refuse():
    write_gray("in.pgm", noise(8, 8, 24))
    files = ("in.pgm", "out.pgm")
    refused(2, ["--low 300", "--high 200"], "edges", "--low", 300, "--high", 200, *files)
    refused(2, ["--low", "'2041'"], "edges", "--low", 2041, *files)
    refused(2, ["--link", "'all'"], "edges", "--link", "all", *files)
    refused(2, ["IN and OUT"], "edges", "in.pgm")
    refused(2, ["--nonsense"], "edges", "--nonsense")
    refused(1, ["none.pgm"], "edges", "none.pgm", "out.pgm")
    refused(1, ["cut.pgm"], "edges", write("cut.pgm", b"P5\n4 4\n255\nabc"), "out.pgm")
    equal(os.path.exists("out.pgm"), False)


if __name__ == "__main__":
    main(collect(globals()))
