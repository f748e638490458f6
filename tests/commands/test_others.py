"""`pel` itself, `pel classify`, `pel runs`, `pel budget` and the command line of `pel scene`."""
import csv
import io
import os
import re
import subprocess

from peltest import (DEMO, SOURCE, classify, collect, equal, main, ok, paint, parse_pnm, pel,
                     read_classes, read_pnm, refused, true, write)

COMMANDS = ["blobs", "classify", "runs", "convert", "scene", "budget", "classes", "filter",
            "point", "corners", "edges", "histogram", "line", "sheet", "listen", "formatcheck",
            "capture", "cameras", "bench"]
CLASSES = """[Colors]
(255,128,  0) 0.0000 1 orange
(  1,  2,  3) 0.0000 1 a,b
[Thresholds]
( 40:200,  0:100, 150:255)
( 0:100, 200:255, 0:120)
"""
COLORS = {"o": (255, 128, 0), "b": (0, 0, 255)}


def classes(text=CLASSES):
    return write("c.classes", text)


def picture(rows, name="p.ppm"):
    return write(name, paint(rows, COLORS))


# ---- pel --------------------------------------------------------------------------------------


def test_version_is_that_of_the_header():
    with open(os.path.join(SOURCE, "lib", "include", "pel", "version.h")) as file:
        version = re.search('#define PEL_VERSION "(.*)"', file.read()).group(1)
    equal(ok("--version").text, "pel %s\n" % version)


def test_help_lists_the_commands():
    out = ok("--help").text
    equal(ok("help").text, out)
    equal([line.split()[0] for line in out.splitlines() if line.startswith("  ")][:len(COMMANDS)],
          COMMANDS)


def test_every_command_has_a_manual():
    for name in COMMANDS:
        out = ok(name, "--help").text
        true(out.startswith("Usage: pel %s " % name), name)
        true("Example" in out, name + ": examples")
        equal(max(map(len, out.splitlines())) <= 100, True, name + ": width")
        equal(ok("help", name).text, out)


def test_unknown_words():
    refused(2, ["'bolbs'", "--help"], "bolbs")
    refused(2, ["'bolbs'"], "help", "bolbs")
    refused(2, ["no command"])
    for name in COMMANDS:
        if "this build has no cameras" not in pel(name, "--nonsense").err:
            refused(2, ["--nonsense"], name, "--nonsense")


def test_inputs_are_described_in_one_place():
    tools = os.path.join(SOURCE, "tools")
    with_raw = []
    for name in sorted(os.listdir(tools)):
        if name.endswith((".c", ".h")):
            with open(os.path.join(tools, name)) as file:
                with_raw += [name] if '{"raw", required' in file.read() else []
    equal(with_raw, ["options.h"])
    path = picture(["oo"])
    for command in (["blobs", "-c", classes(), path], ["runs", "-c", classes(), path],
                    ["classify", "-c", classes(), path, "out.ppm"],
                    ["convert", path, "out.ppm"]):
        refused(2, ["unknown pixel format 'YUVY'"], *command, "--raw", "YUVY", "4x2")
        refused(2, ["3x2", "even width"], *command, "--raw", "YUYV", "3x2")
        refused(2, ["unknown colour range 'half'"], *command, "--range", "half")
        refused(2, ["two words"], *command, "--raw", "YUYV")


def test_help_on_a_full_disk():
    if os.path.exists("/dev/full"):
        with open("/dev/full", "wb") as full:
            refused(1, ["standard output"], "--help", stdout=full)


# ---- pel classify -----------------------------------------------------------------------------


def test_classify_paints_display_colours():
    ok("classify", "-c", classes(), picture(["o.b"]), "out.ppm")
    equal(read_pnm("out.ppm")[:4], ("P6", 3, 1, bytes([255, 128, 0, 0, 0, 0, 1, 2, 3])))


def test_classify_to_standard_output():
    path = picture(["o.b"])
    with open(path, "rb") as file:
        data = file.read()
    out = ok("classify", "-c", classes(), "-", "-", stdin=data + data).out
    first, rest = parse_pnm(out)
    second, rest = parse_pnm(rest)
    equal((first[:4], rest), (second[:4], b""))


def test_classify_equals_the_definition_on_the_demo():
    listed = os.path.join(DEMO, "robot.classes")
    source = os.path.join(DEMO, "robot.ppm")
    ok("classify", "-c", listed, source, "out.ppm")
    labels = classify(read_pnm(source)[3], read_classes(listed))
    shown = [(0, 0, 0), (255, 128, 0), (255, 230, 0), (255, 0, 80), (60, 120, 255)]
    equal(read_pnm("out.ppm")[3] == b"".join(bytes(shown[label]) for label in labels), True)


def test_classify_refuses():
    path = picture(["o"])
    refused(2, ["-c CLASSES"], "classify", path, "out.ppm")
    refused(2, ["INPUT and OUT"], "classify", "-c", classes(), path)
    refused(1, ["none.ppm"], "classify", "-c", classes(), "none.ppm", "out.ppm")
    refused(2, ["out.gif", ".png"], "classify", "-c", "none.classes", "none.ppm", "out.gif")
    with open(path, "rb") as file:
        data = file.read()
    refused(1, ["two.ppm", "more than one"], "classify", "-c", classes(),
            write("two.ppm", data + data), "out.ppm")


# ---- pel runs ---------------------------------------------------------------------------------


def test_runs_by_hand():
    path = picture(["oo.bb", ".....", "b.ooo"])
    out = ok("runs", "-c", classes(), "--csv", path, path).text
    rows = list(csv.reader(io.StringIO(out)))
    equal(rows[0], ["frame", "y", "x0", "x1", "class", "name"])
    frame = [["0", "0", "2", "0", "orange"], ["0", "3", "5", "1", "a,b"],
             ["2", "0", "1", "1", "a,b"], ["2", "2", "5", "0", "orange"]]
    equal(rows[1:], [[number] + row for number in "01" for row in frame])


def test_runs_of_touching_classes():
    out = ok("runs", "-c", classes(), "--csv", picture(["ooobbo"])).text
    equal([row.split(",")[2:5] for row in out.splitlines()[1:]],
          [["0", "3", "0"], ["3", "5", "1"], ["5", "6", "0"]])


def test_runs_from_standard_input_for_people():
    with open(picture(["o"]), "rb") as file:
        out = ok("runs", "-c", classes(), "-", stdin=file.read()).text
    equal([line.split() for line in out.splitlines()],
          [["frame", "y", "x0", "x1", "class"], ["0", "0", "0", "1", "orange"]])


def test_runs_refuses():
    refused(2, ["-c CLASSES"], "runs", "p.ppm")
    refused(2, ["no input"], "runs", "-c", classes())
    refused(1, ["none.ppm"], "runs", "-c", classes(), "none.ppm")


# ---- pel budget -------------------------------------------------------------------------------


def parts(*words):
    rows = list(csv.reader(io.StringIO(ok("budget", "--csv", *words).text)))
    equal(rows[0], ["part", "bytes"])
    return {name: int(size) for name, size in rows[1:]}


def eights(size):
    return (size + 7) // 8 * 8


def test_budget_by_hand():
    got = parts("320x240", "--classes", 8, "--open", 32, "--blobs", 16)
    equal(got["class tables"], 3 * 256)
    equal(got["camera line (beside it)"], 320 * 2)
    equal(got["label row"], 320)
    # 24 bytes an open blob and 24 for its moments; 12 for every run of two rows, one to spare; in
    # words of 8
    equal(got["working memory"], eights(32 * 48 + 12 * 321))
    equal(got["results"], 16 * 64)
    equal(got["sum"], sum(got[name] for name in
                          ("class tables", "label row", "working memory", "results", "finder")))
    true(got["sum"] <= 8192, "the promise of 8 KiB: %d" % got["sum"])


def test_budget_of_measures():
    for words, slot in (("none", 24), ("moments", 48), ("outline", 32), ("color", 40),
                        ("all", 72), ("outline,color", 48)):
        got = parts("100x100", "--open", 10, "--measure", words)
        equal(got["working memory"], eights(10 * slot + 12 * 101), words)


def test_budget_of_classes_and_formats():
    equal([parts("64x64", "--classes", n)["class tables"] for n in (1, 8, 9, 16, 17, 32)],
          [768, 768, 1536, 1536, 3072, 3072])
    equal([parts("64x64", "--format", name)["camera line (beside it)"]
           for name in ("GRAY8", "YUYV", "VYUY", "RGB565_BE", "RGB888", "BGR888")],
          [64, 128, 128, 128, 192, 192])
    # a row of Y and its chroma, in one plane or two; two rows of a mosaic
    equal([parts("64x64", "--format", name)["camera line (beside it)"]
           for name in ("NV12", "I420", "BAYER8_RGGB", "BAYER8_BGGR")], [128] * 4)
    equal(parts("64x64", "--format", "BAYER8_RGGB")["label row"], 32)


def test_budget_for_people():
    out = ok("budget", "320x240", "--measure", "moments,outline").text
    true("static uint64_t work[PEL_BLOBS_WORDS(320, 32, "
         "PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE)];" in out, "declaration")
    true("--open 320 (work: %d bytes)" % eights(320 * 56 + 12 * 321) in out,
         "never-lose number: " + out)
    true("PEL_CLASS_MAX=16" in ok("budget", "320x240", "--classes", 9).text, "more classes")


def test_what_budget_says_to_paste_compiles_and_has_its_size():
    words = ["320x240", "--open", 20, "--blobs", 5, "--measure", "all"]
    size = parts(*words)
    declarations = ok("budget", *words).text.split("To paste:\n")[1]
    equal(len(declarations.strip().splitlines()), 6, "declarations")
    checks = "".join("typedef char check_%s[sizeof %s == %d ? 1 : -1];\n" % (name, name, wanted)
                     for name, wanted in (("boxes", size["class tables"]),
                                          ("labels", size["label row"]),
                                          ("work", size["working memory"]),
                                          ("found", size["results"]), ("blobs", size["finder"]),
                                          ("line", size["camera line (beside it)"])))
    write("paste.c", "#include <pel.h>\n" + declarations + checks)
    done = subprocess.run([os.environ.get("PEL_CC", "cc"), "-std=c99", "-fsyntax-only", "-I",
                           os.path.join(SOURCE, "lib", "include"), "paste.c"],
                          stderr=subprocess.PIPE)
    equal(done.returncode, 0, done.stderr.decode())


def test_budget_refuses():
    refused(2, ["one size"], "budget")
    refused(2, ["'320'", "WIDTHxHEIGHT"], "budget", "320")
    refused(2, ["--classes", "'33'"], "budget", "320x240", "--classes", 33)
    refused(2, ["YUYV", "321x240", "even"], "budget", "321x240")
    refused(2, ["2592x1944", "too large"], "budget", "2592x1944")
    refused(2, ["--measure", "colour"], "budget", "320x240", "--measure", "colour")
    refused(2, ["YUVY"], "budget", "320x240", "--format", "YUVY")


# ---- pel scene --------------------------------------------------------------------------------


def test_scene_writes_what_is_asked():
    ok("scene", "--size", "40x30", "-o", "s.ppm", "--mask", "m.pgm", "--objects", "l.csv",
       "--classes", "s.classes")
    equal(read_pnm("s.ppm")[:3], ("P6", 40, 30))
    equal(read_pnm("m.pgm")[:3], ("P5", 40, 30))
    equal([name for name, _ in read_classes("s.classes")],
          ["orange", "yellow", "red", "blue", "white", "green"])
    with open("l.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    equal([row["kind"] for row in rows],
          ["ball"] * 4 + ["cone"] * 2 + ["post"] * 4 + ["goal", "lines", "floor"])


def test_scene_to_standard_output():
    ok("scene", "--size", "40x30", "-o", "s.ppm")
    with open("s.ppm", "rb") as file:
        equal(ok("scene", "--size", "40x30", "-o", "-").out, file.read())
    out = ok("scene", "--size", "40x30", "--objects", "-").text
    true(out.startswith("id,kind,class,name,x_mm,"))


def test_scene_comment_is_its_command_line():
    words = ["--size", "40x30", "--seed", "9", "--pitch", "-2.5", "--fov", "80", "--gain", "0.75",
             "--cast", "255,240,200", "--noise", "2.25", "--blur", "1", "--height", "400"]
    ok("scene", *words, "-o", "s.ppm")
    comment = " ".join(read_pnm("s.ppm")[4]).split()
    equal(comment[:2], ["pel", "scene"])
    ok("scene", *comment[2:], "-o", "t.ppm")
    equal(read_pnm("s.ppm"), read_pnm("t.ppm"))


def test_scene_refuses():
    refused(2, ["nothing to write"], "scene")
    refused(2, ["one output"], "scene", "-o", "-", "--objects", "-")
    refused(2, ["s.gif", ".png"], "scene", "-o", "s.gif")
    refused(2, ["m.yuv", ".png"], "scene", "-o", "s.ppm", "--mask", "m.yuv")
    equal(os.listdir("."), [])
    refused(2, ["'extra'"], "scene", "-o", "s.ppm", "extra")
    refused(2, ["--pitch", "-90 to 90", "'91'"], "scene", "-o", "s.ppm", "--pitch", "91")
    refused(2, ["--fov"], "scene", "-o", "s.ppm", "--fov", "9.9")
    refused(2, ["--height"], "scene", "-o", "s.ppm", "--height", "49")
    refused(2, ["--balls"], "scene", "-o", "s.ppm", "--balls", "51")
    refused(2, ["--cast"], "scene", "-o", "s.ppm", "--cast", "255,255,256")
    refused(2, ["--noise"], "scene", "-o", "s.ppm", "--noise", "x")
    refused(2, ["--gain"], "scene", "-o", "s.ppm", "--gain", "1.2345")
    refused(2, ["--samples"], "scene", "-o", "s.ppm", "--samples", "0")
    refused(1, ["nowhere/s.ppm"], "scene", "--size", "8x6", "-o", "nowhere/s.ppm")
    refused(1, ["nowhere/l.csv"], "scene", "--size", "8x6", "--objects", "nowhere/l.csv")


def test_scene_with_no_floor_in_sight():
    refused(1, ["0 of 4 balls"], "scene", "-o", "s.ppm", "--pitch", "-60")
    equal(os.path.exists("s.ppm"), False)
    ok("scene", "-o", "s.ppm", "--pitch", "-60", "--balls", "0", "--cones", "0", "--size", "8x6")


def test_the_pipe_of_the_manual():
    out = pel("scene", "--size", "80x60", "--classes", "r.classes", "-o", "r.ppm")
    equal(out.status, 0)
    with open("r.ppm", "rb") as file:
        rows = ok("blobs", "-c", "r.classes", "--csv", "-", stdin=file.read()).text
    true(len(rows.splitlines()) > 5, "blobs")


if __name__ == "__main__":
    main(collect(globals()))
