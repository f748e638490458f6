"""`pel point`: every operation against its definition, in exact arithmetic."""
from fractions import Fraction

from grids import (clamp, each, luma, neighbourhoods, noise, read_gray, read_rgb, write_gray,
                   write_rgb)
from peltest import collect, equal, half_up, main, ok, parse_pnm, refused, true, write

RAMP = [list(range(16 * y, 16 * y + 16)) for y in range(16)]  # every value once


def rounded(value):
    """To nearest, halves upward."""
    value = Fraction(value)
    return half_up(value.numerator, value.denominator)


def turned(*words):
    ok("point", *words, "in.pgm", "out.pgm")
    return read_gray("out.pgm")


def curve(*words):
    """What every value becomes."""
    write_gray("in.pgm", RAMP)
    return sum(turned(*words), [])


def curved(function):
    return [clamp(function(value)) for value in range(256)]


# ---- Curves -----------------------------------------------------------------------------------


def test_brightness():
    for offset in (38, -38, 0, 255, -255):
        equal(curve("brightness", offset), curved(lambda v: v + offset), offset)


def test_contrast():
    for words, factor, pivot in (((), "1.3", 128), (("--pivot", 100), "1.3", 100),
                                 (("--pivot", 0), "0.5", 0), (("--pivot", 200), "-1", 200)):
        equal(curve("contrast", factor, *words),
              curved(lambda v: pivot + rounded((v - pivot) * Fraction(factor))), words)


def test_contrast_around_the_mean():
    rows = noise(9, 7, 1, top=99)
    mean = rounded(Fraction(sum(map(sum, rows)), 63))
    write_gray("in.pgm", rows)
    equal(turned("contrast", 2, "--pivot", "mean"),
          each(lambda v: clamp(mean + 2 * (v - mean)), rows))


def test_linear_with_worked_values():
    got = curve("linear", "1.3", 40)
    equal(got, curved(lambda v: rounded(v * Fraction("1.3") + 40)))
    equal([got[v] for v in (0, 100, 166, 255)], [40, 170, 255, 255])
    equal(curve("linear", "-0.5", "-12.5")[0], 0)


def test_gamma_with_worked_values():
    at = (1, 16, 32, 64, 128, 192, 254, 255)
    for words in (("gamma-brighten", "5/2"), ("gamma-brighten", "2.5"), ("gamma-exponent", "0.4"),
                  ("gamma-exponent", "2/5")):
        got = curve(*words)
        equal([got[v] for v in at], [28, 84, 111, 147, 194, 228, 255, 255], words)
    for words in (("gamma-darken", "5/2"), ("gamma-exponent", "2.5")):
        got = curve(*words)
        equal([got[v] for v in at], [0, 0, 1, 8, 46, 125, 253, 255], words)


def test_gamma_against_exact_powers():
    for upper, lower in ((11, 5), (5, 11), (1, 1), (3, 2), (32, 31)):
        got = curve("gamma-exponent", "%d/%d" % (upper, lower))
        for value in range(256):
            # out is right if out - 1/2 <= 255 (value/255)^(upper/lower) < out + 1/2
            exact = Fraction(value, 255) ** upper
            low = Fraction(2 * got[value] - 1, 510)
            high = Fraction(2 * got[value] + 1, 510)
            true((got[value] == 0 or low ** lower <= exact) and exact < high ** lower,
                 "%d/%d: %d" % (upper, lower, value))


def test_invert_and_threshold():
    equal(curve("invert"), list(range(255, -1, -1)))
    for threshold in (0, 100, 255):
        equal(curve("threshold", threshold), curved(lambda v: 255 * (v > threshold)))


def test_curves_on_colours():
    channels = [noise(6, 5, seed) for seed in (2, 3, 4)]
    write_rgb("in.ppm", *channels)
    ok("point", "brightness", "-20", "in.ppm", "out.ppm")
    equal(read_rgb("out.ppm"), [each(lambda v: max(0, v - 20), rows) for rows in channels])
    ok("point", "invert", "--gray", "in.ppm", "out.pgm")
    equal(read_gray("out.pgm"), each(lambda v: 255 - v, luma(*channels)))
    ok("point", "threshold", "120", "in.ppm", "out.pgm")
    equal(read_gray("out.pgm"), each(lambda v: 255 * (v > 120), luma(*channels)))


# ---- Curves from the picture ------------------------------------------------------------------


def equalize(values):
    def up_to(v):
        return sum(1 for other in values if other <= v)
    first = up_to(min(values))
    return [clamp(half_up(255 * (up_to(v) - first), len(values) - first)) if v >= min(values) else 0
            for v in range(256)]


def otsu(values):
    """The largest between-class variance, as fractions; of several the smallest threshold."""
    best, found = Fraction(-1), 0
    for t in range(256):
        low, high = [v for v in values if v <= t], [v for v in values if v > t]
        if low and high:
            between = Fraction(sum(low), len(low)) - Fraction(sum(high), len(high))
            variance = between * between * len(low) * len(high)
            if variance > best:
                best, found = variance, t
    return found


def test_equalize():
    rows = each(lambda a, b: a * b // 128, noise(12, 9, 5, 127), noise(12, 9, 6, 127))
    write_gray("in.pgm", rows)
    table = equalize(sum(rows, []))
    equal(turned("equalize"), each(lambda v: table[v], rows))
    channels = [rows, noise(12, 9, 7), noise(12, 9, 8)]
    write_rgb("in.ppm", *channels)
    ok("point", "equalize", "in.ppm", "out.ppm")
    table = equalize(sum(luma(*channels), []))
    equal(read_rgb("out.ppm"), [each(lambda v: table[v], grid) for grid in channels], "colours")
    write_gray("in.pgm", [[9] * 3] * 2)
    equal(turned("equalize"), [[9] * 3] * 2, "one gray")


def test_otsu():
    rows = each(lambda a, b: clamp(a + 120 * (b > 60)), noise(12, 9, 9, 80), noise(12, 9, 10, 100))
    write_gray("in.pgm", rows)
    threshold = otsu(sum(rows, []))
    true(0 < threshold < 255, "the test's own picture")
    equal(turned("otsu"), each(lambda v: 255 * (v > threshold), rows))


def test_stretch():
    rows = noise(10, 10, 11, 60)
    write_gray("in.pgm", rows)
    ranked = sorted(sum(rows, []))
    low, high = ranked[4], ranked[94]  # the 5th and the 95th of 100: nearest rank
    equal(turned("stretch", 5, 95),
          each(lambda v: clamp(half_up(255 * (v - low), high - low)), rows))
    low, high = ranked[0], ranked[-1]
    equal(turned("stretch", 0, 100), each(lambda v: half_up(255 * (v - low), high - low), rows))
    write_gray("in.pgm", [[9] * 3] * 2)
    equal(turned("stretch", 1, 99), [[9] * 3] * 2, "one gray")


def test_adaptive():
    rows = noise(13, 11, 12)
    write_gray("in.pgm", rows)
    for radius, c in ((1, 0), (2, 7), (7, -30)):
        side = 2 * radius + 1
        means = neighbourhoods(rows, radius, "replicate", lambda s: half_up(sum(s), side * side))
        equal(turned("adaptive", radius, c),
              each(lambda v, mean: 255 * (v > mean - c), rows, means), (radius, c))


def test_integral():
    rows = noise(6, 5, 13)
    write_gray("in.pgm", rows)
    total = sum(map(sum, rows))
    equal(turned("integral"),
          [[half_up(255 * sum(sum(row[:x + 1]) for row in rows[:y + 1]), total) for x in range(6)]
           for y in range(5)])
    write_gray("in.pgm", [[0, 0]])
    equal(turned("integral"), [[0, 0]])


# ---- Sizes ------------------------------------------------------------------------------------


def nearest(rows, width, height):
    return [[rows[y * len(rows) // height][x * len(rows[0]) // width] for x in range(width)]
            for y in range(height)]


def axis(i, length, size):
    """Where pixel i of `size` lies among `length`: a pixel, the weight of the next in 1/2048."""
    point = (Fraction(i) + Fraction(1, 2)) * length / size - Fraction(1, 2)
    whole = point.numerator // point.denominator
    if whole < 0:
        return 0, 0
    if whole >= length - 1:
        return length - 1, 0
    return whole, rounded(2048 * (point - whole))


def bilinear(rows, width, height):
    made = []
    for y in range(height):
        j, g = axis(y, len(rows), height)
        made.append([])
        for x in range(width):
            i, f = axis(x, len(rows[0]), width)
            total = 0
            for line, weight in ((j, 2048 - g), (j + 1, g)):
                for at, share in ((i, 2048 - f), (i + 1, f)):
                    if weight and share:
                        total += weight * share * rows[line][at]
            made[-1].append(half_up(total, 2**22))
    return made


def test_resize():
    rows = noise(12, 8, 14)
    write_gray("in.pgm", rows)
    for width, height in ((12, 8), (24, 16), (5, 3), (1, 1), (7, 20), (6, 4)):
        size = "%dx%d" % (width, height)
        equal(turned("resize", size, "--nearest"), nearest(rows, width, height), size)
        equal(turned("resize", size, "--bilinear"), bilinear(rows, width, height), size)
        equal(turned("resize", size), bilinear(rows, width, height), size)
    equal(turned("resize", "4x2", "--box"),
          [[half_up(sum(sum(row[3 * x:3 * x + 3]) for row in rows[4 * y:4 * y + 4]), 12)
            for x in range(4)] for y in range(2)])
    refused(1, ["in.pgm", "12x8", "5x4", "--bilinear"], "point", "resize", "5x4", "--box", "in.pgm",
            "out.pgm")


def test_resize_colours():
    channels = [noise(8, 6, seed) for seed in (15, 16, 17)]
    write_rgb("in.ppm", *channels)
    ok("point", "resize", "5x9", "in.ppm", "out.ppm")
    equal(read_rgb("out.ppm"), [bilinear(rows, 5, 9) for rows in channels])
    ok("point", "resize", "2x2", "--box", "--gray", "in.ppm", "out.pgm")
    gray = luma(*channels)
    equal(read_gray("out.pgm"),
          [[half_up(sum(sum(row[4 * x:4 * x + 4]) for row in gray[3 * y:3 * y + 3]), 12)
            for x in range(2)] for y in range(2)])


# ---- White balance ----------------------------------------------------------------------------


def balance(channels, gains_q8):
    return [each(lambda v: min(255, half_up(v * gain, 256)), rows)
            for rows, gain in zip(channels, gains_q8)]


def test_white_balance():
    channels = [noise(8, 6, 18, 200), noise(8, 6, 19, 255), noise(8, 6, 20, 100)]
    write_rgb("in.ppm", *channels)
    sums = [sum(map(sum, rows)) for rows in channels]
    ok("point", "white-balance", "--gray-world", "in.ppm", "out.ppm")
    equal(read_rgb("out.ppm"), balance(channels, [half_up(256 * sum(sums), 3 * s) for s in sums]))
    sums = [sum(sum(row[2:5]) for row in rows[1:4]) for rows in channels]
    ok("point", "white-balance", "--patch", "2,1,5,4", "in.ppm", "out.ppm")
    equal(read_rgb("out.ppm"), balance(channels, [half_up(256 * sums[1], s) for s in sums]))


def test_white_balance_refuses():
    files = ("in.ppm", "out.ppm")
    write_rgb("in.ppm", noise(4, 4, 21), noise(4, 4, 22), [[0] * 4] * 4)
    refused(2, ["--gray-world", "--patch"], "point", "white-balance", *files)
    refused(2, ["--gray-world", "--patch"], "point", "white-balance", "--gray-world", "--patch",
            "0,0,1,1", *files)
    refused(2, ["--patch", "'1,1,1,2'"], "point", "white-balance", "--patch", "1,1,1,2", *files)
    refused(2, ["--gray"], "point", "white-balance", "--gray", "--gray-world", *files)
    refused(1, ["in.ppm", "0,0,5,1", "4x4"], "point", "white-balance", "--patch", "0,0,5,1", *files)
    refused(1, ["in.ppm", "black"], "point", "white-balance", "--gray-world", *files)


# ---- Two pictures -----------------------------------------------------------------------------

PAIRS = {"add": lambda a, b: min(255, a + b), "subtract": lambda a, b: max(0, a - b),
         "absdiff": lambda a, b: abs(a - b), "min": min, "max": max, "and": lambda a, b: a & b,
         "or": lambda a, b: a | b, "xor": lambda a, b: a ^ b}


def test_pairs():
    a, b = noise(9, 5, 23), noise(9, 5, 24)
    write_gray("in.pgm", a)
    write_gray("second.pgm", b)
    for name, compute in PAIRS.items():
        equal(turned(name, "second.pgm"), each(compute, a, b), name)


def test_blend():
    a, b = noise(9, 5, 25), noise(9, 5, 26)
    write_gray("in.pgm", a)
    write_gray("second.pgm", b)
    for word, weight in (("0", 0), ("1", 256), ("0.5", 128), ("0.25", 64), ("0.1", 26)):
        equal(turned("blend", word, "second.pgm"),
              each(lambda x, y: half_up(x * weight + y * (256 - weight), 256), a, b), word)


def test_gray_and_colour():
    channels = [noise(5, 4, seed) for seed in (27, 28, 29)]
    gray = noise(5, 4, 30)
    write_rgb("in.ppm", *channels)
    write_gray("in.pgm", gray)
    ok("point", "subtract", "in.pgm", "in.ppm", "out.ppm")
    equal(read_rgb("out.ppm"), [each(PAIRS["subtract"], rows, gray) for rows in channels])
    ok("point", "subtract", "in.ppm", "in.pgm", "out.ppm")
    equal(read_rgb("out.ppm"), [each(PAIRS["subtract"], gray, rows) for rows in channels])
    ok("point", "subtract", "in.ppm", "--gray", "in.pgm", "out.pgm")
    equal(read_gray("out.pgm"), each(PAIRS["subtract"], gray, luma(*channels)))


def test_second_of_a_stream():
    frames = [noise(4, 3, seed) for seed in (31, 32, 33)]
    others = [noise(4, 3, seed) for seed in (34, 35, 36)]
    data = [b"".join(open(write_gray("x.pgm", rows), "rb").read() for rows in grids)
            for grids in (frames, others)]
    write("stream.pgm", data[0])
    write_gray("one.pgm", others[0])
    for second, wanted in (("one.pgm", others[:1] * 3), (write("all.pgm", data[1]), others)):
        out = ok("point", "absdiff", second, "stream.pgm", "-").out
        for a, b in zip(frames, wanted):
            picture, out = parse_pnm(out)
            equal(picture[3], bytes(sum(each(PAIRS["absdiff"], a, b), [])), second)
        equal(out, b"")
    out = ok("point", "absdiff", "-", "stream.pgm", "-", stdin=data[1]).out
    equal(len(out), 3 * len(out[:len(out) // 3]))
    short = write("short.pgm", data[1][:2 * len(data[1]) // 3])
    refused(1, ["short.pgm", "2 pictures", "fewer"], "point", "add", short, "stream.pgm", "-")


def test_pairs_refuse():
    write_gray("in.pgm", noise(4, 3, 37))
    write_gray("other.pgm", noise(3, 4, 38))
    refused(1, ["other.pgm", "3x4", "in.pgm", "4x3"], "point", "add", "other.pgm", "in.pgm",
            "out.pgm")
    refused(1, ["none.pgm"], "point", "add", "none.pgm", "in.pgm", "out.pgm")
    refused(1, ["empty.pgm"], "point", "add", write("empty.pgm", b""), "in.pgm", "out.pgm")
    refused(2, ["standard input"], "point", "add", "-", "-", "out.pgm")
    refused(2, ["blend", "'1.5'"], "point", "blend", "1.5", "other.pgm", "in.pgm", "out.pgm")


# ---- The command line -------------------------------------------------------------------------


def test_the_list():
    lines = ok("point", "--list").text.splitlines()
    names = [line.split()[0] for line in lines]
    equal(sorted(names), sorted([*PAIRS, "blend", "brightness", "contrast", "linear", "stretch",
                                 "equalize", "gamma-brighten", "gamma-darken", "gamma-exponent",
                                 "invert", "threshold", "otsu", "adaptive", "integral", "resize",
                                 "white-balance"]))
    true(all(len(line) <= 100 for line in lines), "one line each")


def test_refuses_bad_usage():
    write_gray("in.pgm", noise(4, 4, 39))
    files = ("in.pgm", "out.pgm")
    refused(2, ["no operation", "--list"], "point")
    refused(2, ["first word"], "point", "--gray", "invert", *files)
    refused(2, ["'brigthness'", "--list"], "point", "brigthness", 3, *files)
    refused(2, ["pel point threshold N IN OUT"], "point", "threshold")
    refused(2, ["brightness", "-255 to 255", "'in.pgm'"], "point", "brightness", *files)
    refused(2, ["'256'"], "point", "brightness", 256, *files)
    refused(2, ["'-1'"], "point", "threshold", "-1", *files)
    refused(2, ["contrast", "'x'"], "point", "contrast", "x", *files)
    refused(2, ["--pivot", "'256'"], "point", "contrast", 1, "--pivot", 256, *files)
    refused(2, ["'--pivot'", "invert"], "point", "invert", "--pivot", *files)
    refused(2, ["'--box'", "invert"], "point", "invert", "--box", *files)
    refused(2, ["fraction", "'33/32'"], "point", "gamma-exponent", "33/32", *files)
    refused(2, ["fraction", "'0'"], "point", "gamma-exponent", "0", *files)
    refused(2, ["fraction", "'1/0'"], "point", "gamma-exponent", "1/0", *files)
    refused(2, ["0.5", "gamma-darken"], "point", "gamma-brighten", "0.5", *files)
    refused(2, ["1/2", "gamma-brighten"], "point", "gamma-darken", "1/2", *files)
    refused(2, ["LOW under HIGH"], "point", "stretch", 50, 50, *files)
    refused(2, ["'320'"], "point", "resize", "320", *files)
    refused(2, ["adaptive: R", "'0'"], "point", "adaptive", 0, 5, *files)
    refused(2, ["adaptive: C", "'256'"], "point", "adaptive", 1, 256, *files)
    refused(2, ["IN and OUT"], "point", "invert", "in.pgm")
    refused(2, ["--nonsense"], "point", "invert", "--nonsense", *files)
    refused(1, ["none.pgm"], "point", "invert", "none.pgm", "out.pgm")
    refused(1, ["same file"], "point", "invert", "in.pgm", "in.pgm")


if __name__ == "__main__":
    main(collect(globals()))
