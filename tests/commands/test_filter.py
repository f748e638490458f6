"""`pel filter`: every filter and every border, against the definitions and worked examples."""
import math

from grids import (SOBEL_X, SOBEL_Y, clamp, correlate, each, luma, neighbourhoods, noise, read_gray,
                   read_rgb, root, write_gray, write_rgb)
from peltest import collect, equal, half_up, main, ok, parse_pnm, refused, true, write

# A picture with its gradients worked out by hand.
WORKED = [[3, 4, 20, 21, 20, 19, 0, 1],
          [3, 2, 3, 20, 20, 19, 2, 1],
          [2, 0, 3, 19, 21, 20, 5, 0],
          [2, 1, 1, 25, 24, 19, 21, 5],
          [5, 10, 19, 20, 23, 3, 2, 0],
          [1, 3, 10, 20, 19, 24, 1, 1]]
WORKED_SOBEL_X = [[18, 72, 52, -3, -72, -74],
                  [1, 80, 76, -5, -53, -72],
                  [13, 77, 68, -28, -43, -51],
                  [36, 61, 40, -36, -63, -43]]
ZERO = [[10, 34, 52, 17, -5, -58, -54, -2],
        [8, 18, 72, 52, -3, -72, -74, -9],
        [3, 1, 80, 76, -5, -53, -72, -33],
        [12, 13, 77, 68, -28, -43, -51, -49],
        [24, 36, 61, 40, -36, -63, -43, -26],
        [16, 32, 44, 22, -9, -57, -49, -4]]
REPLICATE = [[2, 51, 69, 17, -7, -78, -72, 2],
             [-3, 18, 72, 52, -3, -72, -74, -6],
             [-6, 1, 80, 76, -5, -53, -72, -27],
             [1, 13, 77, 68, -28, -43, -51, -39],
             [11, 36, 61, 40, -36, -63, -43, -20],
             [11, 41, 61, 31, -5, -75, -72, -2]]
WRAP = [[9, 43, 69, 26, -1, -76, -77, 7],
        [5, 18, 72, 52, -3, -72, -74, 2],
        [-3, 1, 80, 76, -5, -53, -72, -24],
        [2, 13, 77, 68, -28, -43, -51, -38],
        [18, 36, 61, 40, -36, -63, -43, -13],
        [17, 49, 61, 22, -11, -77, -67, 6]]
BORDERS = {"replicate": "replicate", "symmetric": "symmetric", "reflect101": "reflect101",
           "wrap": "wrap", "valid": "valid", "zero": "constant", "constant=77": "constant"}
SIZES = [(1, 1), (2, 1), (1, 3), (2, 2), (3, 3), (5, 4), (17, 9)]

# The kernels, written down from the literature; name: (taps, divisor).
KERNELS = {
    "identity": ([0, 0, 0, 0, 1, 0, 0, 0, 0], 1),
    "shift-left": ([0, 0, 0, 0, 0, 1, 0, 0, 0], 1),
    "shift-right": ([0, 0, 0, 1, 0, 0, 0, 0, 0], 1),
    "shift-up": ([0, 0, 0, 0, 0, 0, 0, 1, 0], 1),
    "shift-down": ([0, 1, 0, 0, 0, 0, 0, 0, 0], 1),
    "box3": ([1] * 9, 9),
    "gauss3": ([a * b for a in (1, 2, 1) for b in (1, 2, 1)], 16),
    "binomial5": ([a * b for a in (1, 4, 6, 4, 1) for b in (1, 4, 6, 4, 1)], 256),
    "gauss5": ([1, 3, 6, 3, 1, 3, 15, 25, 15, 3, 6, 25, 44, 25, 6, 3, 15, 25, 15, 3, 1, 3, 6, 3, 1],
               256),
    "sobel-x": (SOBEL_X, 1),
    "sobel-y": (SOBEL_Y, 1),
    "scharr-x": ([-3, 0, 3, -10, 0, 10, -3, 0, 3], 1),
    "scharr-y": ([-3, -10, -3, 0, 0, 0, 3, 10, 3], 1),
    "prewitt-x": ([-1, 0, 1] * 3, 1),
    "prewitt-y": ([-1, -1, -1, 0, 0, 0, 1, 1, 1], 1),
    "laplacian": ([0, 1, 0, 1, -4, 1, 0, 1, 0], 1),
    "laplacian-negative": ([0, -1, 0, -1, 4, -1, 0, -1, 0], 1),
    "sharpen": ([-1, -1, -1, -1, 17, -1, -1, -1, -1], 9),
    "sharpen5": ([0, -1, 0, -1, 5, -1, 0, -1, 0], 1),
    "emboss": ([-2, -1, 0, -1, 1, 1, 0, 1, 2], 1),
}


def read_wide(data):
    """The signed values of a picture of 16 bits, and its comments."""
    lines = data.split(b"\n", 4)
    equal((lines[0], lines[1][:2], lines[3]), (b"P5", b"# ", b"65535"), "header")
    width, height = map(int, lines[2].split())
    equal(len(lines[4]), 2 * width * height, "bytes")
    values = [256 * a + b - 32768 for a, b in zip(lines[4][::2], lines[4][1::2])]
    return [values[i:i + width] for i in range(0, len(values), width)], lines[1].decode()


def wide(*words):
    """Runs pel filter --wide ... in.pgm and gives the signed values."""
    return read_wide(ok("filter", "--wide", *words, "in.pgm", "-").out)[0]


def filtered(*words):
    ok("filter", *words, "in.pgm", "out.pgm")
    return read_gray("out.pgm")


# ---- Worked examples --------------------------------------------------------------------------


def test_worked_sobel():
    write_gray("in.pgm", WORKED)
    values, comment = read_wide(ok("filter", "sobel-x", "--wide", "--border", "valid", "in.pgm",
                                   "-").out)
    equal(values, WORKED_SOBEL_X)
    equal(values[1][1], 80)
    true("32768" in comment, comment)
    equal(wide("sobel-x", "--convolve", "--border", "valid")[1][1], -80)
    equal(wide("sobel-x", "--border", "zero"), ZERO)
    for border in ("replicate", "symmetric"):
        equal(wide("sobel-x", "--border", border), REPLICATE, border)
    equal(wide("sobel-x", "--border", "wrap"), WRAP)
    equal(wide("gradient-abs", "--border", "valid"),
          [[44, 112, 72, 4, 80, 84], [6, 80, 88, 18, 76, 114], [52, 120, 88, 40, 78, 74],
           [48, 76, 46, 46, 78, 82]])


def test_worked_smoothing():
    write_gray("in.pgm", WORKED)
    equal(filtered("gauss3", "--border", "valid"),
          [[4, 9, 17, 20, 15, 6], [2, 7, 16, 21, 17, 9], [4, 9, 18, 21, 16, 11],
           [7, 13, 19, 20, 13, 7]])
    equal(filtered("box3", "--border", "valid"),
          [[4, 10, 16, 20, 14, 7], [2, 8, 15, 21, 17, 10], [5, 11, 17, 19, 15, 8],
           [6, 12, 18, 20, 15, 8]])


def test_worked_box_with_a_hole():
    rows = [[90 if 2 <= y <= 6 and 3 <= x <= 7 else 0 for x in range(10)] for y in range(10)]
    rows[5][4], rows[8][2] = 0, 90
    write_gray("in.pgm", rows)
    equal(filtered("box3", "--border", "zero")[1:-1][4][1:-1], [0, 30, 50, 80, 80, 90, 60, 30])
    equal(filtered("box3", "--border", "zero")[9], [0, 10, 10, 10, 0, 0, 0, 0, 0, 0])
    sharp = filtered("sharpen", "--border", "zero")
    equal((sharp[5][4], sharp[8][2], sharp[2][3]), (0, 170, 140))


# ---- Against the definitions ------------------------------------------------------------------


def test_every_kernel_with_every_border():
    rows = noise(9, 7, 1)
    write_gray("in.pgm", rows)
    for name, (taps, divisor) in KERNELS.items():
        for word, border in BORDERS.items():
            sums = correlate(rows, taps, border, 77 if "77" in word else 0)
            equal(filtered(name, "--border", word),
                  each(lambda s: clamp(half_up(s, divisor)), sums), name + " " + word)
    equal(filtered("gauss3"), filtered("gauss3", "--border", "replicate"), "the default")


def test_small_pictures():
    for width, height in SIZES:
        rows = noise(width, height, 10 * width + height)
        write_gray("in.pgm", rows)
        for name in ("scharr-x", "gauss5"):
            taps, divisor = KERNELS[name]
            for word, border in BORDERS.items():
                what = "%s %s %dx%d" % (name, word, width, height)
                side = 3 if len(taps) == 9 else 5
                if border == "valid" and (width < side or height < side):
                    refused(1, ["in.pgm", "%dx%d" % (width, height), "too small"], "filter", name,
                            "--border", word, "in.pgm", "out.pgm")
                    continue
                sums = correlate(rows, taps, border, 77 if "77" in word else 0)
                equal(filtered(name, "--border", word),
                      each(lambda s: clamp(half_up(s, divisor)), sums), what)
                equal(wide(name, "--border", word), each(lambda s: half_up(s, divisor), sums), what)


def test_kernels_of_ones_own():
    rows = noise(8, 6, 3)
    write_gray("in.pgm", rows)
    for size, seed in ((9, 4), (25, 5)):
        taps = [value - 128 for value in noise(size, 1, seed)[0]]
        sums = correlate(rows, taps)
        words = " ".join(map(str, taps))
        equal(wide("--kernel", words, "--shift", 5), each(lambda s: half_up(s, 32), sums))
        equal(wide("--kernel", words, "--divide", 31), each(lambda s: half_up(s, 31), sums))
        equal(wide("--kernel", words, "--divide", 31, "--absolute", "--bias", -7),
              each(lambda s: half_up(abs(s), 31) - 7, sums))
        equal(filtered("--kernel", words.replace(" ", ", "), "--shift", 9, "--bias", 128),
              each(lambda s: clamp(half_up(s, 512) + 128), sums))
        equal(wide("--kernel", words, "--shift", 5, "--convolve"),
              each(lambda s: half_up(s, 32), correlate(rows, taps[::-1])))
    equal(filtered("--kernel", "0 1 0 / 1 -4 1 / 0 1 0"), filtered("laplacian"), "slashes")


def test_extremes_saturate():
    write_gray("in.pgm", [[255] * 4] * 4)
    equal(wide("--kernel", " ".join(["127"] * 9)), [[32767] * 4] * 4)
    equal(wide("--kernel", " ".join(["-128"] * 25)), [[-32768] * 4] * 4)
    equal(wide("--kernel", " ".join(["-128"] * 25), "--divide", 25), [[-32640] * 4] * 4)
    equal(filtered("--kernel", " ".join(["-128"] * 9)), [[0] * 4] * 4)


def test_what_named_kernels_are_given():
    rows = noise(6, 5, 6)
    write_gray("in.pgm", rows)
    sums = correlate(rows, SOBEL_X)
    equal(filtered("sobel_x", "--shift", 2, "--bias", 128),
          each(lambda s: clamp(half_up(s, 4) + 128), sums))
    equal(filtered("sobel-x", "--absolute"), each(lambda s: clamp(abs(s)), sums))
    equal(wide("gauss3", "--divide", 1), correlate(rows, KERNELS["gauss3"][0]), "undivided")


def test_operators():
    rows = noise(9, 7, 7)
    write_gray("in.pgm", rows)
    for word, border in BORDERS.items():
        constant = 77 if "77" in word else 0
        gx, gy = (correlate(rows, taps, border, constant) for taps in (SOBEL_X, SOBEL_Y))
        wanted = {"median": lambda seen: sorted(seen)[4], "erode": min, "min": min, "dilate": max,
                  "max": max}
        for name, compute in wanted.items():
            equal(filtered(name, "--border", word),
                  neighbourhoods(rows, 1, border, compute, constant), name + " " + word)
        equal(wide("gradient-abs", "--border", word), each(lambda a, b: abs(a) + abs(b), gx, gy))
        equal(filtered("gradient-abs", "--border", word),
              each(lambda a, b: min(255, abs(a) + abs(b)), gx, gy))
        equal(wide("gradient", "--border", word), each(lambda a, b: root(a * a + b * b), gx, gy))
        equal(filtered("direction", "--border", word),
              each(lambda a, b: math.floor(math.atan2(b, a) / math.tau * 256 + 0.5) % 256, gx, gy))


def test_open_and_close():
    rows = noise(11, 9, 8)
    write_gray("in.pgm", rows)
    for word, border in BORDERS.items():
        constant = 77 if "77" in word else 0
        for name, steps in (("open", (min, max)), ("close", (max, min))):
            wanted = rows
            for compute in steps:
                wanted = neighbourhoods(wanted, 1, border, compute, constant)
            equal(filtered(name, "--border", word), wanted, name + " " + word)


def test_labels():
    rows = noise(12, 9, 9, top=3)
    write_gray("in.pgm", rows)

    def majority(seen):
        most = max(map(seen.count, seen))
        winners = [label for label in seen if seen.count(label) == most]
        return seen[4] if seen[4] in winners else min(winners)

    equal(filtered("majority"), neighbourhoods(rows, 1, "replicate", majority))
    equal(filtered("dilate-labels"),
          neighbourhoods(rows, 1, "replicate",
                         lambda seen: seen[4] or min([v for v in seen if v] or [0])))
    rows = [[5] * 12] * 4 + [[5] * 6 + [9] * 6] * 5
    write_gray("in.pgm", rows)
    wanted = neighbourhoods(rows, 1, "replicate",
                            lambda seen: seen[4] if len(set(seen)) == 1 else 0)
    true(0 < sum(map(sum, wanted)) < sum(map(sum, rows)), "the test's own picture")
    equal(filtered("erode-labels"), wanted)


def test_repeat():
    rows = noise(9, 9, 11)
    write_gray("in.pgm", rows)
    wanted = rows
    for _ in range(3):
        wanted = neighbourhoods(wanted, 1, "valid", lambda seen: sorted(seen)[4])
    equal(filtered("median", "--repeat", 3, "--border", "valid"), wanted)
    wanted = rows
    for compute in (max, max, min, min):
        wanted = neighbourhoods(wanted, 1, "replicate", compute)
    equal(filtered("close", "--repeat", 2), wanted, "each step twice")


# ---- Pictures and files -----------------------------------------------------------------------


def test_colour_channel_by_channel():
    channels = [noise(7, 5, seed) for seed in (12, 13, 14)]
    write_rgb("in.ppm", *channels)
    ok("filter", "gauss3", "in.ppm", "out.ppm")
    equal(read_rgb("out.ppm"),
          [each(lambda s: half_up(s, 16), correlate(rows, KERNELS["gauss3"][0]))
           for rows in channels])
    ok("filter", "gauss3", "--gray", "in.ppm", "out.pgm")
    equal(read_gray("out.pgm"),
          each(lambda s: half_up(s, 16), correlate(luma(*channels), KERNELS["gauss3"][0])))


def test_streams():
    first = noise(6, 4, 15)
    second = noise(3, 5, 16)
    data = b"".join(open(write_gray("in.pgm", rows), "rb").read() for rows in (first, second))
    out = ok("filter", "max", "-", "-", stdin=data).out
    for rows in (first, second):
        picture, out = parse_pnm(out)
        wanted = neighbourhoods(rows, 1, "replicate", max)
        equal(picture[3], bytes(value for row in wanted for value in row))
    equal(out, b"")
    write("two.pgm", data)
    ok("filter", "max", "two.pgm", "out.pgm")
    refused(1, ["out.png", "more than one picture"], "filter", "max", "two.pgm", "out.png")
    out = ok("filter", "sobel-x", "--wide", "two.pgm", "-").out
    size = len(b"P5\n\n6 4\n65535\n") + out.index(b"\n", 3) - 3 + 2 * 24
    equal(read_wide(out[:size])[0], correlate(first, SOBEL_X))
    equal(read_wide(out[size:])[0], correlate(second, SOBEL_X))


def test_video():
    frames = [noise(6, 4, seed) for seed in (17, 18)]
    data = b"".join(open(write_gray("in.pgm", rows), "rb").read() for rows in frames)
    out = ok("filter", "min", write("two.pgm", data), "out.y4m")
    equal(out.out, b"")
    video = open("out.y4m", "rb").read()
    true(video.startswith(b"YUV4MPEG2 W6 H4 "), "header")
    equal([bytes(part[:24]) for part in video.split(b"FRAME\n")[1:]],
          [bytes(v for row in neighbourhoods(rows, 1, "replicate", min) for v in row)
           for rows in frames])


def test_raw_input():
    rows = noise(6, 4, 19)
    raw = write("in.raw", bytes(value for row in rows for value in row))
    ok("filter", "median", "--raw", "GRAY8", "6x4", raw, "out.pgm")
    equal(read_gray("out.pgm"), neighbourhoods(rows, 1, "replicate", lambda s: sorted(s)[4]))


def test_a_camera_frame():
    # Gray YUYV, full range: R = G = B = Y.
    rows = noise(6, 4, 20)
    raw = write("in.raw", bytes(byte for row in rows for value in row for byte in (value, 128)))
    ok("filter", "max", "--raw", "YUYV", "6x4", raw, "out.ppm")
    equal(read_rgb("out.ppm"), [neighbourhoods(rows, 1, "replicate", max)] * 3)


def test_the_list():
    lines = ok("filter", "--list").text.splitlines()
    names = [line.split()[0] for line in lines]
    equal(names[:len(KERNELS)], [name for name in
                                 sorted(KERNELS, key=lambda name: names.index(name))])
    equal(sorted(names[len(KERNELS):]),
          sorted(["gradient-abs", "gradient", "direction", "median", "erode", "dilate", "open",
                  "close", "majority", "erode-labels", "dilate-labels"]))
    true(all(len(line.split()) > 2 and len(line) <= 110 for line in lines), "one line each")
    write_gray("in.pgm", noise(5, 5, 21))
    for name in names:
        ok("filter", name, "in.pgm", "out.pgm")
    true("divided by 16" in lines[names.index("gauss3")], "the divisor")


# ---- What is refused --------------------------------------------------------------------------


def test_refuses_bad_usage():
    write_gray("in.pgm", noise(4, 4, 22))
    files = ("in.pgm", "out.pgm")
    refused(2, ["no filter given"], "filter")
    refused(2, ["'gaus'", "--list"], "filter", "gaus", *files)
    refused(2, ["IN and OUT", "1"], "filter", "box3", "in.pgm")
    refused(2, ["IN and OUT", "3"], "filter", "box3", *files, "more")
    refused(2, ["9 numbers", "25", "8"], "filter", "--kernel", "1 2 3 4 5 6 7 8", *files)
    refused(2, ["-128..127", "128"], "filter", "--kernel", "1 2 3 4 5 6 7 8 128", *files)
    refused(2, ["-128..127", "'1.5"], "filter", "--kernel", "1.5 2 3 4 5 6 7 8 9", *files)
    refused(2, ["-128..127", "'x'"], "filter", "--kernel", "1 2 3 4 5 6 7 8 x", *files)
    refused(2, ["9 numbers"], "filter", "--kernel", "", *files)
    refused(2, ["--shift", "--divide"], "filter", "box3", "--shift", 1, "--divide", 2, *files)
    refused(2, ["--shift", "'16'"], "filter", "box3", "--shift", 16, *files)
    refused(2, ["--divide", "'0'"], "filter", "box3", "--divide", 0, *files)
    refused(2, ["--bias", "'32768'"], "filter", "box3", "--bias", 32768, *files)
    refused(2, ["for kernels"], "filter", "median", "--bias", 1, *files)
    refused(2, ["'mirror'", "reflect101"], "filter", "box3", "--border", "mirror", *files)
    refused(2, ["constant", "'256'"], "filter", "box3", "--border", "constant=256", *files)
    refused(2, ["--wide"], "filter", "median", "--wide", *files)
    refused(2, ["--repeat"], "filter", "box3", "--wide", "--repeat", 2, *files)
    refused(2, ["'out.bmp'", ".ppm"], "filter", "box3", "in.pgm", "out.bmp")
    refused(2, ["--nonsense"], "filter", "--nonsense")


def test_refuses_bad_input():
    rows = noise(4, 4, 23)
    write_rgb("in.ppm", rows, rows, rows)
    write_gray("in.pgm", rows)
    refused(1, ["in.ppm", "--gray"], "filter", "sobel-x", "--wide", "in.ppm", "out.pgm")
    ok("filter", "sobel-x", "--wide", "--gray", "in.ppm", "out.pgm")
    refused(1, ["out.png", ".pgm"], "filter", "sobel-x", "--wide", "in.pgm", "out.png")
    refused(1, ["none.pgm"], "filter", "box3", "none.pgm", "out.pgm")
    refused(1, ["same file"], "filter", "box3", "in.pgm", "in.pgm")
    refused(1, ["nowhere/out.pgm"], "filter", "box3", "in.pgm", "nowhere/out.pgm")
    refused(1, ["cut.pgm"], "filter", "box3", write("cut.pgm", b"P5\n4 4\n255\nabc"), "new.pgm")
    try:
        open("new.pgm", "rb")
        raise AssertionError("bad input left a file behind")
    except FileNotFoundError:
        pass


if __name__ == "__main__":
    main(collect(globals()))
