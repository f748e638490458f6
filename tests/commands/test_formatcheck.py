"""`pel formatcheck`: frames of every format, made here from the definitions, are found out.

What two formats have in common in principle cannot be told, and then both must be named: red and
blue of RGB and Bayer change places without a trace, U and V where there is no colour.
"""
import csv
import functools
import glob
import io
import os

from peltest import (Skipped, collect, equal, main, ok, parse_pnm, ppm, read_pnm, refused, to_yuv,
                     true, write)

PACKED = {"YUYV": "YUyV", "UYVY": "UYVy", "YVYU": "YVyU", "VYUY": "VYUy"}
COLOURED = list(PACKED) + ["NV12", "NV21", "I420", "YV12", "RGB565_LE", "RGB565_BE"]
PAIRS = [{"RGB888", "BGR888"}, {"BAYER8_RGGB", "BAYER8_BGGR"}, {"BAYER8_GRBG", "BAYER8_GBRG"}]


def scene(seed, *options):
    ok("scene", "--seed", seed, "-o", "scene.ppm", *options)
    _, width, height, pixels, _ = read_pnm("scene.ppm")
    return width, height, pixels


@functools.lru_cache(maxsize=2)
def planes(picture, limited=False):
    """The Y, U and V bytes of every pixel."""
    width, height, rgb = picture
    known = {}
    y, u, v = bytearray(width * height), bytearray(width * height), bytearray(width * height)
    for i in range(width * height):
        color = rgb[3 * i:3 * i + 3]
        if color not in known:
            known[color] = to_yuv(*color)
            if limited:
                luma, cb, cr = known[color]
                known[color] = (16 + round(219 * luma / 255), 128 + round(224 * (cb - 128) / 255),
                                128 + round(224 * (cr - 128) / 255))
        y[i], u[i], v[i] = known[color]
    return y, u, v


def pack(picture, form, limited=False, padding=0):
    """The bytes of a frame, with `padding` bytes of 0 behind each row of a packed format."""
    width, height, rgb = picture
    rows = []
    if form in ("RGB888", "BGR888"):
        data = bytearray(rgb)
        if form == "BGR888":
            data[0::3], data[2::3] = rgb[2::3], rgb[0::3]
        rows = [data[3 * width * i:3 * width * (i + 1)] for i in range(height)]
    elif form.startswith("RGB565"):
        order = "little" if form.endswith("LE") else "big"
        words = (rgb[i] >> 3 << 11 | rgb[i + 1] >> 2 << 5 | rgb[i + 2] >> 3
                 for i in range(0, len(rgb), 3))
        data = b"".join(word.to_bytes(2, order) for word in words)
        rows = [data[2 * width * i:2 * width * (i + 1)] for i in range(height)]
    elif form.startswith("BAYER8"):
        for y in range(height):
            row = bytearray(width)
            for x in range(2):
                letter = form[-4:][2 * (y % 2) + x]
                first = 3 * width * y + 3 * x + "RGB".index(letter)
                row[x::2] = rgb[first:3 * width * (y + 1):6]
            rows.append(row)
    else:
        y, u, v = planes(picture, limited)
        if form in PACKED:
            data = bytearray(2 * width * height)
            for place, letter in enumerate(PACKED[form]):
                data[place::4] = {"Y": y[0::2], "y": y[1::2], "U": u[0::2], "V": v[0::2]}[letter]
            rows = [data[2 * width * i:2 * width * (i + 1)] for i in range(height)]
        elif form == "GRAY8":
            rows = [y[width * i:width * (i + 1)] for i in range(height)]
        else:
            less = [b"".join(plane[width * i:width * (i + 1):2] for i in range(0, height, 2))
                    for plane in ((v, u) if form in ("NV21", "YV12") else (u, v))]
            both = bytearray(2 * len(less[0]))
            both[0::2], both[1::2] = less
            rows = [y, both] if form.startswith("NV") else [y, less[0], less[1]]
    return b"".join(bytes(row) + bytes(padding) for row in rows)


def fits(data, *options):
    """[(format, width, height, bytes per line, frames)] of those that fit."""
    out = ok("formatcheck", "--csv", "--best", 600, *options, "-", stdin=data).text
    rows = list(csv.DictReader(io.StringIO(out)))
    true(rows, "no line")
    equal([int(row["rank"]) for row in rows], list(range(1, len(rows) + 1)))
    count = sum(row["fits"] == "1" for row in rows)
    equal([row["fits"] for row in rows], ["1"] * count + ["0"] * (len(rows) - count))
    return [(row["format"], int(row["width"]), int(row["height"]), int(row["bytes_per_line"]),
             int(row["frames"])) for row in rows[:count]]


def names(found):
    return {row[0] for row in found}


ALL = ["GRAY8"] + COLOURED + [name for pair in PAIRS for name in sorted(pair)]


def check_formats(picture, what, forms=ALL, size=True):
    """Every format is named, alone or with the one that it cannot be told from."""
    width, height, _ = picture
    options = ["--size", "%dx%d" % (width, height)] if size else []
    unsure = 0
    for form in forms:
        found = fits(pack(picture, form), *options)
        pair = next((pair for pair in PAIRS if form in pair), {form})
        equal({row[1:3] for row in found}, {(width, height)}, "%s: size of %s" % (what, form))
        if names(found) != pair:
            swapped = form.translate(str.maketrans("UV", "VU"))
            swapped = {"NV12": "NV21", "NV21": "NV12", "I420": "YV12", "YV12": "I420"}.get(
                form, swapped)
            equal(names(found), {form, swapped}, "%s: %s" % (what, form))
            unsure += 1
    return unsure


# ---- The right answer -------------------------------------------------------------------------


def test_all_formats_of_scenes():
    for seed in (1, 2):
        equal(check_formats(scene(seed), "scene %d" % seed), 0, "undecided")


def test_all_formats_without_the_size():
    equal(check_formats(scene(3), "scene", size=False), 0, "undecided")
    equal(check_formats(scene(4, "--size", "160x120"), "small", size=False), 0, "undecided")


def test_noisy_scene():
    equal(check_formats(scene(6, "--noise", "6"), "noisy scene"), 0, "undecided")


def test_photos():
    paths = sorted(glob.glob(os.path.join(os.environ.get("PEL_DATA_DIR", ""), "robocup-msl",
                                          "*_304x400.ppm")))
    if not paths:
        raise Skipped("no pictures in PEL_DATA_DIR")
    forms = ["GRAY8", "YUYV", "VYUY", "NV12", "YV12", "RGB565_LE", "BGR888", "BAYER8_GRBG"]
    unsure = 0
    for path in paths:
        _, width, height, pixels, _ = read_pnm(path)
        unsure += check_formats((width, height, pixels), os.path.basename(path), forms)
    # Halls without saturated colours leave U and V open, which is honest; others do not.
    true(unsure <= 3 * len(paths), "%d of %d undecided" % (unsure, 4 * len(paths)))


def test_padded_rows():
    picture = scene(1)
    for form, row in (("YUYV", 640), ("RGB565_BE", 640), ("GRAY8", 320)):
        data = pack(picture, form, padding=64)
        equal(fits(data, "--size", "320x240"), [(form, 320, 240, row + 64, 1)], form)
        equal(fits(data, "--size", "320x240", "--stride", row + 64),
              [(form, 320, 240, row + 64, 1)])
    data = pack(picture, "UYVY", padding=32)
    table = ok("formatcheck", "--size", "320x240", "-", stdin=data).text
    true("640 bytes of pixels and 32 of padding" in table, table)


def test_several_frames():
    data = b"".join(pack(scene(seed, "--size", "160x120"), "VYUY") for seed in (1, 2))
    equal(fits(data, "--size", "160x120"), [("VYUY", 160, 120, 320, 2)])
    equal(fits(data, "--frames", 2), [("VYUY", 160, 120, 320, 2)])


def test_explains_itself():
    picture = scene(1)
    out = ok("formatcheck", "-", stdin=pack(picture, "YVYU")).text
    for part in ("best: YVYU 320x240\n", "bits per byte", "as YUYV, ", "outside of RGB",
                 "pel convert --raw YVYU 320x240 --range full"):
        true(part in out, "%r is not in\n%s" % (part, out))
    out = ok("formatcheck", "-", stdin=pack(picture, "YV12")).text
    true("best: YV12 320x240\n" in out and "swap its U and V, then it is I420" in out, out)


# ---- Honest doubts ----------------------------------------------------------------------------


def gray(picture):
    width, height, rgb = picture
    return width, height, b"".join(bytes([to_yuv(*rgb[i:i + 3])[0]] * 3)
                                   for i in range(0, len(rgb), 3))


def test_colourless_pictures():
    picture = gray(scene(1))
    for wanted in ({"YUYV", "YVYU"}, {"UYVY", "VYUY"}, {"NV12", "NV21", "I420", "YV12"},
                   {"RGB888", "BGR888"}, {"RGB565_LE"}, {"RGB565_BE"}, {"GRAY8"}):
        for form in wanted:
            equal(names(fits(pack(picture, form), "--size", "320x240")), wanted, form)
    out = ok("formatcheck", "--size", "320x240", "-", stdin=pack(picture, "YUYV")).text
    true("cannot tell: YUYV 320x240 or YVYU 320x240\n" in out, out)
    # A mosaic in front of colourless things is a gray picture.
    equal(names(fits(pack(picture, "BAYER8_RGGB"), "--size", "320x240")), {"GRAY8"})


def test_red_and_blue_of_rgb():
    out = ok("formatcheck", "--size", "320x240", "-", stdin=pack(scene(1), "BGR888")).text
    true("cannot tell: RGB888 320x240 or BGR888 320x240\n" in out and "changing places" in out, out)


def test_flat_frame():
    out = ok("formatcheck", "--size", "64x64", "-", stdin=b"\x80" * 8192).text
    true("cannot tell: " in out and "too little in the picture" in out, out)


def test_noise():
    state, data = 1, bytearray()
    for _ in range(128 * 96 * 2):
        state = (state * 1103515245 + 12345) & 0x7fffffff
        data.append(state >> 16 & 255)
    out = ok("formatcheck", "--size", "128x96", "-", stdin=bytes(data)).text
    true("\nnothing fits\n" in out and "not alike" in out, out)
    equal(fits(bytes(data), "--size", "128x96"), [])


def ranges(data, *options):
    out = ok("formatcheck", *options, "-", stdin=data).text
    return next(line for line in out.splitlines() if " range" in line)


def test_ranges():
    for seed in (1, 2, 3):
        picture = scene(seed)
        for form in ("YUYV", "NV12"):
            full = ranges(pack(picture, form), "--size", "320x240")
            limited = ranges(pack(picture, form, limited=True), "--size", "320x240")
            true(full.startswith("  full range: "), full)
            true("full range" not in limited, limited)
    # Black to white in limited range, and the same bytes without their ends.
    ramp = (256, 64, b"".join(bytes([x] * 3) for x in range(256)) * 64)
    true(ranges(pack(ramp, "YUYV", limited=True), "--size", "256x64").startswith("  limited range"))
    less = (256, 64, b"".join(bytes([64 + x // 2] * 3) for x in range(256)) * 64)
    for data in (pack(less, "GRAY8"), pack(less, "GRAY8", limited=True)):
        true("cannot tell" in ranges(data, "--size", "256x64"))


# ---- The sheet --------------------------------------------------------------------------------


def test_sheet_shows_the_ways():
    picture = scene(1)
    data = write("frame.raw", pack(picture, "UYVY"))
    table = ok("formatcheck", "--size", "320x240", "-o", "sheet.ppm", data).text
    equal(table, ok("formatcheck", "--size", "320x240", "frame.raw").text)
    kind, width, height, pixels, _ = read_pnm("sheet.ppm")
    ways = table.count("320x240 ") - 4  # three in the sentences, one in the command at the end
    true(ways >= 7, table)
    ok("convert", "--raw", "UYVY", "320x240", "frame.raw", "best.ppm")
    best = read_pnm("best.ppm")[3]
    at = pixels.find(best[:960])
    true(at >= 0, "the first row of the best way")
    for y in range(240):  # it is there row by row, as `pel convert` shows it
        start = at + 3 * width * y
        equal(pixels[start:start + 960] == best[960 * y:960 * (y + 1)], True, "row %d" % y)
    green = bytes([64, 255, 64])
    equal(pixels[:3], green, "the frame around the first")
    equal(pixels[3 * (width - 1):3 * width] != green, True, "none around the last of the row")
    single = ok("formatcheck", "--size", "320x240", "--best", 1, "-o", "-", "frame.raw").out
    (kind, width, height, _, _), rest = parse_pnm(single)
    equal((kind, rest, width < 400, height < 400), ("P6", b"", True, True))
    ok("formatcheck", "-o", "sheet.png", "frame.raw")
    with open("sheet.png", "rb") as file:
        equal(file.read(4), b"\x89PNG")


def test_sheet_of_large_and_thin_frames():
    data = bytes(range(256)) * 16 * 24
    ok("formatcheck", "--size", "2048x24", "-o", "sheet.ppm", "-", stdin=data)
    ok("formatcheck", "--size", "2x2", "-o", "tiny.ppm", "-", stdin=b"\x10\x80\x20\x80" * 2)


# ---- Refusals ---------------------------------------------------------------------------------


def test_refusals():
    write("empty.raw", b"")
    refused(1, ["empty.raw", "empty"], "formatcheck", "empty.raw")
    refused(1, ["none.raw", "No such file"], "formatcheck", "none.raw")
    refused(1, ["PPM", "pel convert"], "formatcheck", write("p.ppm", ppm(1, 1, [1, 2, 3])))
    refused(1, ["JPEG", "MJPEG"], "formatcheck", "-", stdin=b"\xff\xd8\xff\xe0" + bytes(100))
    refused(1, ["YUV4MPEG2"], "formatcheck", "-", stdin=b"YUV4MPEG2 W2 H2\n")
    refused(1, ["100 bytes", "0.13 per pixel of 32x24", "cut short"], "formatcheck", "--size",
            "32x24", "-", stdin=bytes(100))
    refused(1, ["101 bytes", "--size"], "formatcheck", "-", stdin=bytes(101))
    refused(2, ["--size"], "formatcheck", "--stride", 64, "-")
    refused(2, ["one FILE"], "formatcheck")
    refused(2, ["one FILE"], "formatcheck", "a", "b")
    refused(2, ["'8'", "size"], "formatcheck", "--size", "8", "-")
    refused(2, ["--best"], "formatcheck", "--best", "0", "-")
    refused(2, ["both"], "formatcheck", "--csv", "-o", "-", "-")
    refused(2, [".ppm"], "formatcheck", "-o", "sheet.gif", "-")
    refused(1, ["cannot create"], "formatcheck", "-o", "none/sheet.ppm", "-", stdin=bytes(8192))


if __name__ == "__main__":
    main(collect(dict(globals())))
