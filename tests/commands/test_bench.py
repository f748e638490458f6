"""`pel bench`: what it compares, prints and draws; no figure is held to a limit."""
import csv
import io
import math
import os
import re
import struct
import subprocess
import sys

from grids import noise, write_gray
from peltest import PEL, SOURCE, collect, equal, main, ok, pel, refused, true, write

FIRST_COLUMNS = ("operator,backend,input,ns_per_px,ratio_to_memcpy,opencv_ns_per_px,"
                 "speedup_over_opencv").split(",")
INPUTS = ["synth", "rand1", "rand4"]
SMALL = ("--size", "32x24", "--runs", 2)
ALONE = SMALL + ("--no-opencv",)

HAS_OPENCV = subprocess.run([sys.executable, "-c", "import cv2"], capture_output=True,
                            check=False).returncode == 0


def listed(kind):
    """What --list has under a heading: {name: marks}."""
    text = ok("bench", "--list").text
    part = re.search(r"^%s.*\n((?:  .*\n)+)" % kind, text, re.MULTILINE).group(1)
    return {line[5:].split()[0]: line[2:4] for line in part.splitlines()}


def table(*words, **options):
    rows = list(csv.DictReader(io.StringIO(ok("bench", "--csv", *words, **options).text)))
    true(rows, "no rows")
    equal((list(rows[0])[:7], list(rows[0])[-1]), (FIRST_COLUMNS, "frames"))
    return rows


def plausible(row, name):
    value = float(row[name])
    true(math.isfinite(value) and value > 0, "%s: %s" % (name, row))
    return value


def check_figures(row):
    own, copy = plausible(row, "ns_per_px"), plausible(row, "memcpy_ns_per_px")
    for name in ("", "memcpy_", "opencv_"):
        if name != "opencv_" or row["opencv_ns_per_px"]:
            middle = plausible(row, name + "ns_per_px")
            low, high = (plausible(row, (name or "ns_per_px_") + q) for q in ("q1", "q3"))
            true(low <= middle <= high, "quartiles: %s" % row)
    true(abs(float(row["ratio_to_memcpy"]) / (own / copy) - 1) < 0.05, "ratio: %s" % row)
    equal(row["opencv_ns_per_px"] == "", row["speedup_over_opencv"] == "", row)
    if row["opencv_ns_per_px"]:
        faster = plausible(row, "opencv_ns_per_px") / own
        true(abs(float(row["speedup_over_opencv"]) / faster - 1) < 0.02, "speedup: %s" % row)


# ---- What is measured --------------------------------------------------------------------------


def test_every_operator_backend_and_input():
    backends = listed("Backends")
    true("scalar" in backends)
    wanted = [(operator, backend, name) for name in INPUTS
              for operator, marks in listed("Operators").items()
              for backend in (backends if marks[0] == "*" else ["auto"])]
    rows = table(*ALONE)
    equal([(row["operator"], row["backend"], row["input"]) for row in rows], wanted)
    for row in rows:
        check_figures(row)
        equal((row["width"], row["height"], row["runs"], row["frames"]), ("32", "24", "2", "16"))
        equal(row["compared"], "" if row["backend"] in ("scalar", "auto") else "scalar")


def test_the_operators_are_those_of_the_library():
    with open(os.path.join(SOURCE, "lib", "include", "pel", "filter.h")) as file:
        ops = re.findall(r"^pel_filter_op(?:_s16)? (.*);", file.read(), re.MULTILINE)
    names = {name.strip()[len("pel_op_"):].replace("_", "-") for line in ops
             for name in line.split(",")}
    true(len(names) >= 16, "operators of filter.h: %s" % names)
    # 16 bits is what the two derivatives have alone.
    spelt = {name[:-4] if name.startswith("sobel") else name for name in names}
    equal(spelt - set(listed("Operators")), set())


def test_names_choose():
    rows = table(*ALONE, "--operator", "median,gauss3", "--backend", "scalar", "--input",
                 "rand4,synth")
    equal([(row["operator"], row["backend"], row["input"]) for row in rows],
          [(operator, "scalar", name) for name in ("synth", "rand4")
           for operator in ("gauss3", "median")])


def test_files():
    write_gray("ball.pgm", noise(33, 25, 1))
    row, = table("--no-opencv", "--runs", 1, "--operator", "median", "--backend", "scalar",
                 "--input", "none", "ball.pgm")
    equal((row["input"], row["width"], row["height"]), ("ball", "32", "24"))
    raw = write("raw.yuv", bytes(range(64)) * 2)
    row, = table("--no-opencv", "--runs", 1, "--operator", "table", "--backend", "scalar",
                 "--input", "none", "--raw", "YUYV", "8x8", raw)
    equal((row["input"], row["width"], row["height"]), ("raw", "8", "8"))
    refused(1, ["ball.pgm", "32x25"], "bench", "--size", "40x24", "--input", "none", "ball.pgm")
    refused(1, ["none.pgm"], "bench", "none.pgm")


def test_frames_take_turns():
    one = ALONE + ("--operator", "absdiff", "--backend", "scalar", "--input", "synth")
    for frames, line in ((1, "The same frame again and again: it stays in the cache."),
                         (2, "2 copies of the frame take turns."),
                         (64, "64 copies of the frame take turns.")):
        row, = table(*one, "--frames", frames)
        check_figures(row)
        equal(row["frames"], str(frames))
        true(line in ok("bench", *one, "--frames", frames).text.splitlines(), line)
    true("16 copies of the frame take turns." in ok("bench", *one).text.splitlines())


def test_frames_have_a_limit():
    """A picture is kept as YUYV, gray, RGB, labels and gray again: 8 bytes a pixel."""
    raw = write("large.yuv", b"\x80" * (2 << 20))
    words = ("bench", "--csv", "--no-opencv", "--runs", 1, "--operator", "runs", "--input", "none",
             "--raw", "YUYV", "1024x1024", raw)
    row, = csv.DictReader(io.StringIO(ok(*words, "--frames", 32).text))
    equal(row["frames"], "32")
    done = pel(*words, "--frames", 33)
    row, = csv.DictReader(io.StringIO(done.text))
    equal((done.status, row["frames"]), (0, "32"))
    equal(done.err, "pel: bench: large: 32 frames take turns, more would take over 256 MiB\n")


def test_the_table_of_the_readme():
    rows = table(*ALONE, "--input", "synth,rand4")
    with open("bench.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    write("README.md", b"a\n<!-- speed begin -->\nold\n<!-- speed end -->\nz\n")
    script = os.path.join(SOURCE, "tools", "bench_readme.py")
    subprocess.run([sys.executable, script, "bench.csv", "README.md"], check=True)
    with open("README.md", encoding="utf-8") as file:
        lines = file.read().splitlines()
    equal((lines[0], lines[1], lines[-2:]),
          ("a", "<!-- speed begin -->", ["<!-- speed end -->", "z"]))
    median, = (row for row in rows if (row["operator"], row["backend"], row["input"])
               == ("median", "scalar", "synth"))
    line, = (line for line in lines if line.startswith("| 3x3 median, synth | "))
    equal(line.split(" | ")[1], "%.3f" % float(median["ns_per_px"]))
    true(any("to blobs, rand4" in line for line in lines) and "old" not in lines, lines)
    true(lines[-3].startswith("Medians of 2 runs, 32x24, 16 copies of the frame in turn, "), lines)


# ---- For people --------------------------------------------------------------------------------


def compared(text):
    return tuple(map(int, re.search(r"^(\d+) results compared with plain C and equal; "
                                    r"(\d+) compared with OpenCV", text,
                                    re.MULTILINE).groups()))


def test_the_table():
    text = ok("bench", *ALONE, "--input", "synth").text
    for operator, marks in listed("Operators").items():
        backend = "scalar" if marks[0] == "*" else "auto"
        true(re.search("^%s +%s " % (re.escape(operator), backend), text, re.MULTILINE), operator)
    others = len(listed("Backends")) - 1
    starred = sum(marks[0] == "*" for marks in listed("Operators").values())
    equal(compared(text), (others * starred, 0))


# ---- OpenCV ------------------------------------------------------------------------------------


def test_opencv():
    if not HAS_OPENCV:
        print("OpenCV is not here: its side is not tested")
        return
    with_job = {name for name, marks in listed("Operators").items() if marks[1] == "o"}
    true(len(with_job) >= 40, "jobs of OpenCV: %d" % len(with_job))
    rows = table(*SMALL, "--python", sys.executable)
    for row in rows:
        check_figures(row)
        equal("opencv" in row["compared"], row["operator"] in with_job, row)
        equal(row["opencv_ns_per_px"] != "", row["operator"] in with_job, row)
    text = ok("bench", *SMALL, "--python", sys.executable, "--input", "synth").text
    equal(compared(text)[1], len(with_job))


def test_another_result_is_seen():
    """A Python that turns one job of OpenCV's into another."""
    if not HAS_OPENCV:
        return
    for job, wrong, name in (("cv2.medianBlur(g, 3,", "cv2.medianBlur(g, 5,", "median"),
                             ("connectivity=4", "connectivity=8", "blobs"),
                             ("HARRIS_K = 1311", "HARRIS_K = 1400", "harris"),
                             ("cv2.COLOR_YUV2RGB", "cv2.COLOR_YUV2BGR", "rgb")):
        write("python", "#!%s\nimport sys\nscript = sys.argv[2]\nassert %r in script\n"
              "exec(compile(script.replace(%r, %r), 'script', 'exec'))\n"
              % (sys.executable, job, job, wrong))
        os.chmod("python", 0o755)
        # Nothing is timed: no line is printed.
        done = refused(1, [name + " of ", "OpenCV's result"], "bench", "--csv", *SMALL, "--python",
                       "./python")
        equal(done.out, b"")


def test_frames_take_turns_in_opencv():
    """A Python that writes down which frame each run reads: the four of the picture in turn."""
    if not HAS_OPENCV:
        return
    run = "            run(frame)\n"
    place = run.replace("run(frame)", "print(id(frame), frame.gray.ctypes.data)")
    write("python", "#!%s\nimport sys\nscript = sys.argv[2]\nassert %r in script\n"
          "exec(compile(script.replace(%r, %r), 'script', 'exec'))\n"
          % (sys.executable, run, run, run + place))
    os.chmod("python", 0o755)
    done = pel("bench", "--csv", "--size", "32x24", "--runs", 10, "--operator", "median", "--input",
               "synth", "--backend", "scalar", "--frames", 4, "--python", "./python")
    equal(done.status, 0, done.err)
    read = done.err.splitlines()
    true(len(read) >= 12 and len(set(read[:4])) == 4, read[:8])
    equal(len({line.split()[1] for line in read}), 4, "places of the frames")
    equal(read, [read[i % 4] for i in range(len(read))])


def test_without_opencv():
    refused(1, ["no OpenCV", "./none"], "bench", *SMALL, "--python", "./none")
    write("python", "#!/bin/sh\nexit 0\n")
    os.chmod("python", 0o755)
    refused(1, ["no OpenCV"], "bench", *SMALL, "--python", "./python")
    done = subprocess.run([PEL, "bench", "--csv", *map(str, SMALL), "--operator", "median"],
                          env=dict(os.environ, PEL_PYTHON="./none"), capture_output=True,
                          text=True, check=False)
    equal(done.returncode, 0)
    true("OpenCV is left out" in done.stderr and "--python" in done.stderr, done.stderr)
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    equal({row["opencv_ns_per_px"] for row in rows}, {""})


def test_a_process_that_dies():
    write("python", "#!/bin/sh\necho opencv 1.0\nread line\n")
    os.chmod("python", 0o755)
    refused(1, ["OpenCV's process"], "bench", *SMALL, "--python", "./python")


# ---- The plot ----------------------------------------------------------------------------------


def sizes():
    """The numbers of tools/benchplot.h."""
    with open(os.path.join(SOURCE, "tools", "benchplot.h")) as file:
        return {name: int(value)
                for name, value in re.findall(r"BENCHPLOT_(\w+) = (\d+)", file.read())}


def png_size(path):
    with open(path, "rb") as file:
        data = file.read()
    equal((data[:8], data[12:16]), (b"\x89PNG\r\n\x1a\n", b"IHDR"))
    return struct.unpack(">II", data[16:24])


def test_the_plot():
    at = sizes()
    bars = len(listed("Backends")) + 1
    for words, panels, rows in (
            ((), 3, len(listed("Operators"))),
            (("--input", "synth", "--operator", "gauss3,runs"), 1, 2)):
        printed = ok("bench", "--csv", *ALONE, *words, "--plot", "out.png").text
        true(printed.startswith("operator,"), "the numbers, too")
        equal(png_size("out.png"),
              (at["LEFT"] + panels * (at["PANEL"] + at["RIGHT"]),
               at["TOP"] + rows * (at["GAP"] + bars * at["BAR"]) + at["BOTTOM"]))


# ---- Refusals ----------------------------------------------------------------------------------


def test_bench_refuses():
    refused(2, ["operator 'gaus3'", " gauss3 "], "bench", "--operator", "median,gaus3")
    refused(2, ["backend 'mmx'", " scalar"], "bench", "--backend", "mmx")
    refused(2, ["backend 'auto'"], "bench", "--backend", "auto")
    refused(2, ["input 'sinth'", " synth "], "bench", "--input", "sinth")
    refused(2, ["operator ''"], "bench", "--operator", "median,")
    refused(2, ["--runs", "'0'"], "bench", "--runs", "0")
    for frames in ("0", "65", "-1", "many", ""):
        refused(2, ["--frames", "1 to 64", "'%s'" % frames], "bench", "--frames", frames)
    refused(2, ["even", "'33x24'"], "bench", "--size", "33x24")
    refused(2, ["'2x24'"], "bench", "--size", "2x24")
    refused(2, [".png", "'out.jpg'"], "bench", "--plot", "out.jpg")
    refused(2, ["FILE"], "bench", "--input", "none")
    refused(2, ["--nonsense"], "bench", "--nonsense")
    equal(pel("bench", "--list", "--nonsense").status, 0, "--list comes first")


if __name__ == "__main__":
    main(collect(globals()))
