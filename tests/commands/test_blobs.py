"""`pel blobs`: its contract (columns, order, options), its messages, and what it draws."""
import csv
import io
import json
import os
import subprocess
import threading
from fractions import Fraction

from peltest import (CONTRACT, DEMO, PEL, classify, collect, contract_rows, equal, main, ok, paint,
                     parse_pnm, parse_rows, pel, ppm, read_classes, read_pnm, refused, to_yuv, true,
                     write)

ORANGE, BLUE = (255, 128, 0), (0, 0, 255)
COLORS = {"o": ORANGE, "b": BLUE}
CLASSES = """[Colors]
(255,128,  0) 0.0000 1 orange
(  0, 90,255) 0.0000 1 "deep, blue"

[Thresholds]
( 40:200,  0:100, 150:255)
( 0:100, 200:255, 0:120)
"""
PLAIN = CLASSES.replace('"deep, blue"', "blue")
ROWS = ["oo...b....",
        "oo...b..o.",
        "..o..b...o",
        ".....bb...",
        "b.......oo"]


def classes(text=PLAIN):
    return write("c.classes", text)


def picture(name="p.ppm", rows=ROWS):
    return write(name, paint(rows, COLORS))


def table_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_the_test_colours_are_in_their_boxes():
    equal(to_yuv(*ORANGE), (151, 43, 202))
    equal(to_yuv(*BLUE), (29, 255, 107))
    y, u, v = to_yuv(*ORANGE)
    true(40 <= y <= 200 and u <= 100 and v >= 150, "orange")


def test_header_and_first_ten_columns_by_hand():
    out = ok("blobs", "-c", classes(), "--csv", picture()).text
    equal(out.split("\n")[0],
          CONTRACT + ",cx,cy,angle_deg,elongation,roundness,density,compactness,perimeter,holes,"
          "edges,mean_y,mean_u,mean_v")
    equal(parse_rows(out), [
        # area 5: the square and the pixel at its corner, and blue; y0 alike, then x0
        (0, 0, "orange", 5, 0, 0, 3, 3, 0 + 1 + 0 + 1 + 2, 0 + 0 + 1 + 1 + 2),
        (0, 1, "blue", 5, 5, 0, 7, 4, 5 * 4 + 6, 0 + 1 + 2 + 3 + 3),
        (0, 0, "orange", 2, 8, 1, 10, 3, 17, 3),
        (0, 0, "orange", 2, 8, 4, 10, 5, 17, 8),
        (0, 1, "blue", 1, 0, 4, 1, 5, 0, 4)])


def test_connectivity_4():
    out = ok("blobs", "-c", classes(), "--csv", "--connectivity", "4", picture()).text
    equal([row[3:6] for row in parse_rows(out)],
          [(5, 5, 0), (4, 0, 0), (2, 8, 4), (1, 8, 1), (1, 2, 2), (1, 9, 2), (1, 0, 4)])


def test_8_is_the_default():
    equal(ok("blobs", "-c", classes(), "--csv", picture()).out,
          ok("blobs", "-c", classes(), "--csv", "--connectivity=8", picture()).out)


def test_min_area_and_max():
    base = ["blobs", "-c", classes(), "--csv", picture()]
    equal([row[3] for row in parse_rows(ok(*base, "--min-area", 2).text)], [5, 5, 2, 2])
    equal([row[3:6] for row in parse_rows(ok(*base, "--max", 3).text)],
          [(5, 0, 0), (5, 5, 0), (2, 8, 1)])
    equal(parse_rows(ok(*base, "--min-area", 6).text), [])


def test_columns_after_the_contract():
    row = table_of(ok("blobs", "-c", classes(), "--csv", picture()).text)[1]
    equal(row["cx"], "5.200")
    equal(row["cy"], "1.800")
    equal((row["perimeter"], row["holes"], row["edges"]), ("12", "0", "4"))
    equal(row["density"], "0.6250")  # 5 of 2 x 4
    # 4 pi 5 / 12^2
    equal(row["compactness"], "0.4363")
    equal((row["mean_y"], row["mean_u"], row["mean_v"]), ("29", "255", "107"))


def test_angle_of_a_diagonal_and_of_a_bar():
    rows = ["o....", ".o...", "..o..", "...o.", "....o"]
    row = table_of(ok("blobs", "-c", classes(), "--csv", picture(rows=rows)).text)[0]
    true(abs(Fraction(row["angle_deg"]) - 45) <= Fraction(1, 50), row["angle_deg"])
    equal((row["elongation"], row["roundness"], row["edges"]), ("1.0000", "0.0000", "15"))
    row = table_of(ok("blobs", "-c", classes(), "--csv", picture(rows=["ooooo"])).text)[0]
    equal((row["angle_deg"], row["cx"], row["cy"]), ("0.00", "2.000", "0.000"))


def test_holes_and_their_perimeter():
    rows = ["ooo", "o.o", "ooo"]
    row = table_of(ok("blobs", "-c", classes(), "--csv", picture(rows=rows)).text)[0]
    equal((row["holes"], row["perimeter"]), ("1", "16"))


def test_frames_count_over_all_inputs():
    one, two = picture("1.ppm", ["o"]), picture("2.ppm", ["oo"])
    stream = write("s.ppm", open(one, "rb").read() + open(two, "rb").read())
    out = ok("blobs", "-c", classes(), "--csv", one, stream, two).text
    equal([(row[0], row[3]) for row in parse_rows(out)], [(0, 1), (1, 1), (2, 2), (3, 2)])


def test_a_frame_without_blobs_counts_too():
    none, one = picture("0.ppm", ["."]), picture("1.ppm", ["o"])
    out = ok("blobs", "-c", classes(), "--csv", none, one).text
    equal([row[0] for row in parse_rows(out)], [1])
    objects = [json.loads(line) for line in
               ok("blobs", "-c", classes(), "--json", none, one).text.splitlines()]
    equal([len(found["blobs"]) for found in objects], [0, 1])


def test_standard_input():
    path = picture()
    with open(path, "rb") as file:
        data = file.read()
    equal(ok("blobs", "-c", classes(), "--csv", "-", stdin=data).out,
          ok("blobs", "-c", classes(), "--csv", path).out)
    refused(1, ["standard input", "twice"], "blobs", "-c", classes(), "-", "-", stdin=data)


def test_csv_quotes_and_json_escapes():
    path = picture(rows=["b"])
    listed = classes(CLASSES.replace('"deep, blue"', '"deep,blue\\'))
    row = next(csv.reader(ok("blobs", "-c", listed, "--csv", path).text.split("\n")[1:]))
    equal(row[2], '"deep,blue\\')
    found = json.loads(ok("blobs", "-c", listed, "--json", path).text)
    equal(found["blobs"][0]["name"], '"deep,blue\\')


def test_json_of_file_names_that_are_no_text():
    name = os.fsdecode(b"\xff\x01\"p.ppm")
    picture(name, ["o"])
    found = json.loads(ok("blobs", "-c", classes(), "--json", name).text)
    equal(found["file"], "\ufffd\x01\"p.ppm")


def test_json_says_the_same_as_csv():
    rows = table_of(ok("blobs", "-c", classes(), "--csv", picture()).text)
    found = json.loads(ok("blobs", "-c", classes(), "--json", picture()).text)
    equal((found["frame"], found["width"], found["height"], found["found"]), (0, 10, 5, 5))
    equal(len(found["blobs"]), len(rows))
    for blob, row in zip(found["blobs"], rows):
        for key, value in row.items():
            if key == "name":
                equal(blob[key], value, key)
            elif key != "frame":
                equal(Fraction(str(blob[key])), Fraction(value), key)


def test_json_counts_what_is_left_out():
    found = json.loads(ok("blobs", "-c", classes(), "--json", "--max", 1, "--min-area", 2,
                          picture()).text)
    equal((found["found"], found["dropped"], found["dropped_px"]), (4, 3, 9))
    equal((found["filtered"], found["filtered_px"], found["lost_px"]), (1, 1, 0))


def test_table_for_people():
    out = ok("blobs", "-c", classes(), "--max", 1, "--min-area", 2, picture()).text
    lines = out.splitlines()
    equal(lines[0], "p.ppm: frame 0, 10x5, 1 blob")
    equal(lines[1].split()[:6], ["class", "area", "x0", "y0", "x1", "y1"])
    equal(lines[2].split()[:6], ["orange", "5", "0", "0", "3", "3"])
    equal(lines[3:], ["  dropped: 3 smaller blobs, 9 pixels", "  filtered: 1 blobs, 1 pixels"])


def test_class_filter():
    base = ["blobs", "-c", classes(), "--csv", picture()]
    equal([row[2] for row in parse_rows(ok(*base, "--class", "blue").text)], ["blue"] * 2)
    equal([row[2] for row in parse_rows(ok(*base, "--class", "0").text)], ["orange"] * 3)
    equal(len(parse_rows(ok(*base, "--class", "0", "--class", "blue").text)), 5)
    refused(2, ["c.classes", "no class 'green'"], *base, "--class", "green")


def test_region_of_interest_and_density():
    base = ["blobs", "-c", classes(), "--csv", picture()]
    equal([row[4:6] for row in parse_rows(ok(*base, "--roi", "8,0,10,4").text)], [(8, 1)])
    equal([row[3] for row in parse_rows(ok(*base, "--min-density", "0.9").text)], [2, 1])
    refused(2, ["--roi", "X0,Y0,X1,Y1"], *base, "--roi", "8,0,8,4")
    refused(2, ["--min-density", "0 to 1"], *base, "--min-density", "1.5")


def test_merging():
    path = picture(rows=["oo..oo....o", "oo..oo....."])
    base = ["blobs", "-c", classes(), "--csv", path]
    equal([row[3:8] for row in parse_rows(ok(*base).text)],
          [(4, 0, 0, 2, 2), (4, 4, 0, 6, 2), (1, 10, 0, 11, 1)])
    # 8 of 6 x 2 = 0.667 of the box around the squares; with the pixel, 9 of 22 = 0.41
    merged = [(8, 0, 0, 6, 2), (1, 10, 0, 11, 1)]
    equal([row[3:8] for row in parse_rows(ok(*base, "--merge-density", "0.6").text)], merged)
    equal(len(parse_rows(ok(*base, "--merge-density", "0.7").text)), 3)
    equal([row[3:8] for row in parse_rows(ok(*base, "--merge-density", "0.4").text)],
          [(9, 0, 0, 11, 2)])
    equal([row[3:8] for row in parse_rows(ok(*base, "--merge-margin", "3").text)], merged)
    equal(len(parse_rows(ok(*base, "--merge-margin", "2").text)), 3)


def test_merging_with_the_densities_of_the_classes():
    path = picture(rows=["oo..oo..bb..bb"] * 2)  # 8 of 6 x 2 = 0.667 for both pairs

    def merged(orange, blue, *words):
        listed = classes(PLAIN.replace("0.0000 1 orange", orange + " 1 orange")
                         .replace("0.0000 1 blue", blue + " 1 blue"))
        found = parse_rows(ok("blobs", "-c", listed, "--csv", *words, path).text)
        return [(row[2], row[3], row[4], row[6]) for row in found]

    apart = [("orange", 4, 0, 2), ("orange", 4, 4, 6), ("blue", 4, 8, 10), ("blue", 4, 12, 14)]
    by_class = ["--merge-classes"]
    equal(merged("0.6", "0.6"), apart, "not without being asked")
    equal(merged("0", "0", *by_class), apart, "0 is never")
    equal(merged("0.6", "0.7", *by_class), [("orange", 8, 0, 6)] + apart[2:])
    equal(merged("0.7", "0.6", *by_class), [("blue", 8, 8, 14)] + apart[:2])
    equal(merged("0.6", "0.6", *by_class), [("orange", 8, 0, 6), ("blue", 8, 8, 14)])
    equal(merged("7", "99.5", *by_class), apart, "more than all of it")
    equal(merged("0.6", "0.7", *by_class, "--max", 1), [("orange", 8, 0, 6)])
    ok("classes", classes(), "c.tm")
    refused(2, ["c.tm", "table", "--merge-classes"], "blobs", "-c", "c.tm", *by_class, path)
    equal(ok("blobs", "-c", classes(), "--merge-classes", "--csv", picture(rows=["."])).text
          .count("\n"), 1, "no blobs")


def test_merging_by_class_is_merging_each_class_alone():
    # 40 x 30 pixels of a simple linear congruence; a density for each class, then for one alone
    state, rows = 5, []
    for _ in range(30):
        row = ""
        for _ in range(40):
            state = (state * 1103515245 + 12345) % 2**31
            row += ".....ob"[(state >> 16) % 7]
        rows.append(row)
    listed = classes(PLAIN.replace("0.0000 1 orange", "0.3 1 orange")
                     .replace("0.0000 1 blue", "0.4 1 blue"))
    base = ["blobs", "-c", listed, "--csv", picture(rows=rows)]
    alone = [row for name, density in (("orange", "0.3"), ("blue", "0.4")) for row in
             parse_rows(ok(*base, "--class", name, "--merge-density", density).text)]
    got = parse_rows(ok(*base, "--merge-classes").text)
    true(50 < len(got) < len(parse_rows(ok(*base).text)) - 50, "something to merge")
    equal(sorted(got), sorted(alone))
    equal([row[3] for row in got], sorted((row[3] for row in alone), reverse=True), "order")


def test_annotated_picture():
    rows = ["." * 20] * 3 + ["....oooooooooo......"] * 9 + ["." * 20] * 4
    ok("blobs", "-c", classes(), "-o", "out.ppm", picture(rows=rows))
    kind, width, height, pixels, _ = read_pnm("out.ppm")
    equal((kind, width, height), ("P6", 20, 16))

    def at(x, y):
        return tuple(pixels[3 * (20 * y + x):][:3])

    for x in range(3, 15):  # the frame lies one pixel outside the box 4..14 x 3..12
        equal((at(x, 2), at(x, 12)), (ORANGE, ORANGE), "frame at x %d" % x)
    for y in range(2, 13):
        equal((at(3, y), at(14, y)), (ORANGE, ORANGE), "frame at y %d" % y)
    for d in (-1, 0, 1):  # the centroid is (8.5, 7): the cross at (9, 7), halves upward
        equal((at(9 + d, 7), at(9, 7 + d)), ((255, 255, 255),) * 2, "middle of the cross")
    equal((at(6, 7), at(12, 7), at(9, 4), at(9, 10)), ((0, 0, 0),) * 4, "ends of the cross")
    equal((at(5, 7), at(13, 7), at(9, 3), at(9, 11)), (ORANGE,) * 4, "beyond its ends")
    equal((at(2, 2), at(15, 12), at(0, 0)), ((0, 0, 0),) * 3, "beside it")
    equal(at(4, 3), ORANGE, "the blob itself")


def test_annotated_axis():
    # a bar of 40 x 5: its long axis lies along y = 4, from the first pixel to the last
    rows = ["." * 44] * 2 + [".." + "o" * 40 + ".."] * 5 + ["." * 44] * 2
    ok("blobs", "-c", classes(), "-o", "out.ppm", picture(rows=rows))
    _, width, _, pixels, _ = read_pnm("out.ppm")
    row = [tuple(pixels[3 * (width * 4 + x):][:3]) for x in range(width)]
    for x in list(range(2, 19)) + list(range(26, 42)):
        equal(row[x], (255, 255, 255), "axis at x %d" % x)
    equal((row[1], row[42]), (ORANGE, ORANGE), "the frame")


def test_annotated_png():
    ok("blobs", "-c", classes(), "-o", "out.png", picture())
    with open("out.png", "rb") as file:
        equal(file.read(8), b"\x89PNG\r\n\x1a\n")
    # the boxes of all blobs come back as a picture of the same size
    equal(ok("convert", "out.png", "-").out[:9], b"P6\n10 5\n2")


def test_annotated_stream():
    one = picture("1.ppm", ["o"])
    listed = classes()
    ok("blobs", "-c", listed, "-o", "f%04d.ppm", one, one)
    equal(sorted(name for name in os.listdir(".") if name.startswith("f")),
          ["f0000.ppm", "f0001.ppm"])
    said = refused(1, ["f.ppm", "%04d"], "blobs", "-c", listed, "-o", "f.ppm", one, one)
    equal((said.out, os.path.exists("f.ppm")), (b"", False), "nothing is read before")
    two = write("two.ppm", open(one, "rb").read() * 2)
    said = refused(1, ["f.ppm", "%04d"], "blobs", "-c", listed, "-o", "f.ppm", "--csv", two)
    equal([row[0] for row in parse_rows(said.text)], [0], "the frame that has a place")
    out = ok("blobs", "-c", listed, "-o", "-", one, one).out
    _, rest = parse_pnm(out)
    _, rest = parse_pnm(rest)
    equal(rest, b"")
    refused(2, ["both"], "blobs", "-c", listed, "--csv", "-o", "-", one)


def test_annotated_picture_that_cannot_be_written():
    refused(1, ["nowhere/out.ppm"], "blobs", "-c", classes(), "-o", "nowhere/out.ppm", picture())
    for name in ("out.gif", "out.y4m", "out"):
        said = refused(2, [name, ".png"], "blobs", "-c", "none.classes", "-o", name, "none.ppm")
        equal(said.out, b"")


def test_raw_frames_and_colour_range():
    # Y0 U Y1 V of orange, twice, in full range
    y, u, v = to_yuv(*ORANGE)
    raw = write("f.yuv", bytes([y, u, y, v] * 2))
    out = ok("blobs", "-c", classes(), "--csv", "--raw", "YUYV", "4x1", raw).text
    equal([row[3:8] for row in parse_rows(out)], [(4, 0, 0, 4, 1)])
    refused(1, ["f.yuv", "limited", "full", "#! range limited", "c.classes"],
            "blobs", "-c", classes(), "--raw", "YUYV", "4x1", "--range", "limited", raw)
    limited = write("l.classes", "#! range limited\n" + PLAIN)
    ok("blobs", "-c", limited, "--raw", "YUYV", "4x1", "--range", "limited", raw)
    ok("blobs", "-c", limited, picture())  # RGB becomes what the classes want
    refused(1, ["f.yuv"], "blobs", "-c", classes(), "--raw", "YUYV", "6x1", raw)


def test_streams_are_answered_frame_by_frame():
    data = open(picture(rows=["oooo"] * 4), "rb").read()
    with subprocess.Popen([PEL, "blobs", "-c", classes(), "--json", "-"], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE) as process:
        timer = threading.Timer(10, process.kill)  # an answer that waits for the end never comes
        timer.start()
        for number in range(3):
            process.stdin.write(data)
            process.stdin.flush()
            answer = process.stdout.readline()
            true(answer, "an answer to frame %d before the end of the stream" % number)
            equal(json.loads(answer)["frame"], number)
        process.stdin.close()
        timer.cancel()
    equal(process.returncode, 0)


def test_bad_usage():
    path = picture()
    refused(2, ["-c CLASSES"], "blobs", path)
    refused(2, ["no input"], "blobs", "-c", classes())
    refused(2, ["--connectivity", "'6'"], "blobs", "-c", classes(), "--connectivity", 6, path)
    refused(2, ["--max"], "blobs", "-c", classes(), "--max", 0, path)
    refused(2, ["--min-area", "'-1'"], "blobs", "-c", classes(), "--min-area", -1, path)
    refused(2, ["--colour"], "blobs", "-c", classes(), "--colour", path)
    refused(2, ["'-z'"], "blobs", "-c", classes(), "-z", path)
    refused(2, ["needs a value"], "blobs", path, "-c")
    refused(2, ["needs a value"], "blobs", path, "--max")
    refused(2, ["--csv or --json"], "blobs", "-c", classes(), "--csv", "--json", path)
    refused(2, ["--raw"], "blobs", "-c", classes(), "--raw", "YUYV")


def test_bad_input():
    refused(1, ["nothing.ppm"], "blobs", "-c", classes(), "nothing.ppm")
    refused(1, ["nothing.classes"], "blobs", "-c", "nothing.classes", picture())
    refused(1, ["cut.ppm"], "blobs", "-c", classes(), write("cut.ppm", b"P6\n4 4\n255\nabc"))
    refused(1, ["empty.ppm"], "blobs", "-c", classes(), write("empty.ppm", b""))
    refused(1, ["text.ppm"], "blobs", "-c", classes(), write("text.ppm", b"no picture"))
    broken = write("broken.classes", PLAIN.replace("150:255)", "150:256)"))
    refused(1, ["broken.classes", "6"], "blobs", "-c", broken, picture())


def test_what_came_before_a_broken_frame_is_there():
    good = open(picture(rows=["o"]), "rb").read()
    path = write("s.ppm", good + good[:-1])
    result = refused(1, ["s.ppm"], "blobs", "-c", classes(), "--csv", path)
    equal([row[0] for row in parse_rows(result.text)], [0])


def test_a_full_disk_is_noticed():
    if os.path.exists("/dev/full"):
        with open("/dev/full", "wb") as full:
            refused(1, ["standard output"], "blobs", "-c", classes(), "--csv", picture(),
                    stdout=full)


def test_a_closed_pipe_is_noticed():
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "wb") as pipe:
        refused(1, ["standard output"], "blobs", "-c", classes(), "--csv", picture(), stdout=pipe)


def test_a_picture_too_large_for_its_sums():
    # 2592 x 1944: over the 2^33 of the header; as raw zeroes
    path = write("large.raw", b"")
    with open(path, "wb") as file:
        file.truncate(2592 * 1944)
    refused(1, ["large.raw", "2592x1944", "too large", "resize --box",
                "convert --crop"],
            "blobs", "-c", classes(), "--raw", "GRAY8", "2592x1944", path)


def test_noise_loses_nothing():
    # a third of the pixels in each of two classes and none: a simple linear congruence
    width, height, state, labels, pixels = 61, 47, 7, bytearray(), bytearray()
    for _ in range(width * height):
        state = (state * 1103515245 + 12345) % 2**31
        label = (state >> 16) % 3
        labels.append(label)
        pixels += bytes([(0, 0, 0), ORANGE, BLUE][label])
    path = write("noise.ppm", ppm(width, height, pixels))
    equal(classify(pixels, read_classes(classes())), bytes(labels), "the test's own classes")
    for connectivity in (4, 8):
        out = ok("blobs", "-c", classes(), "--csv", "--connectivity", connectivity, path).text
        wanted = contract_rows(labels, width, height, ["orange", "blue"],
                               connectivity=connectivity)
        true(len(wanted) > 20, "enough blobs")
        equal(parse_rows(out), wanted, "connectivity %d" % connectivity)


def test_bayer_counts_in_cells():
    raw = write("b.raw", bytes([255, 128, 255, 128, 128, 0, 128, 0]))  # R G R G / G B G B
    out = ok("blobs", "-c", classes(), "--json", "--raw", "BAYER8_RGGB", "4x2", "-o", "b.ppm",
             raw).text
    found = json.loads(out)
    equal((found["width"], found["height"]), (2, 1))
    equal([(blob["area"], blob["x1"], blob["y1"]) for blob in found["blobs"]], [(2, 2, 1)])
    equal(read_pnm("b.ppm")[1:3], (2, 1))


def test_help_has_examples():
    out = ok("blobs", "--help").text
    true("Usage: pel blobs" in out and "Examples" in out, "help")
    true("4 megapixels" in out and "--crop" in out and "not applied otherwise" in
         " ".join(out.split()), "what it refuses and leaves alone")
    equal(out, ok("help", "blobs").text)
    true(os.path.isdir(DEMO), "the demo is there")


if __name__ == "__main__":
    main(collect(globals()))
