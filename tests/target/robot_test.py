#!/usr/bin/env python3
"""The robot demo: the firmware on the desk and on emulated boards against `pel blobs`, its memory,
and its protocol under damage.

    robot_test.py BUILD_DIR            with PEL_COMMAND, PEL_SOURCE_DIR, PEL_CC as ctest sets them
    robot_test.py BUILD_DIR --demo     only that `sh tools/demo.sh --board microbit` does it all

Records are encoded and decoded here once more, from ports/robot/PROTOCOL.md; the CRC is that of
Python's standard library.
"""
import binascii
import collections
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import traceback

PEL = os.environ.get("PEL_COMMAND", "pel")
SOURCE = pathlib.Path(os.environ.get("PEL_SOURCE_DIR")
                      or pathlib.Path(__file__).resolve().parents[2])
CC = os.environ.get("PEL_CC", "cc")
ROBOT = SOURCE / "ports/robot"
sys.path.insert(0, str(SOURCE / "tests/size"))
import stack  # noqa: E402 (the graph of calls is read in one place)
CLASSES = ROBOT / "robot.classes"

# name: compiler, emulator, limits of RAM and flash in bytes (of the boards with little).
BOARDS = {
    "microbit": ("arm-none-eabi-gcc", "qemu-system-arm", (12 * 1024, 24 * 1024)),
    "sifive_e": ("riscv64-unknown-elf-gcc", "qemu-system-riscv32", (12 * 1024, 24 * 1024)),
    "mps2-an386": ("arm-none-eabi-gcc", "qemu-system-arm", None),
}
FRAME_BYTES = 320 * 240 * 2

passed = failed = skipped = 0


def check(good, what):
    global passed, failed
    if good:
        passed += 1
    else:
        failed += 1
        print("wrong:", what)
    return good


def run(*words, stdin=b"", cwd=None):
    return subprocess.run([str(word) for word in words], input=stdin, cwd=cwd, timeout=300,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)


def must(*words, **options):
    done = run(*words, **options)
    if done.returncode:
        raise RuntimeError("%s: %d\n%s\n%s" % (" ".join(map(str, words)), done.returncode,
                                               done.stdout[-2000:].decode("utf-8", "replace"),
                                               done.stderr[-2000:].decode("utf-8", "replace")))
    return done


# ---- The protocol once more --------------------------------------------------------------------

FORMS = {1: "<IIHHBB", 2: "<II7IHIB", 3: "<IIHHB"}
for measure in range(8):
    FORMS[0x10 + measure] = ("<IBB4H3I" + ("3Q" if measure & 1 else "")
                             + ("2I" if measure & 2 else "") + ("3B" if measure & 4 else ""))


def crc(data):
    return binascii.crc_hqx(data, 0xFFFF)


def encode(kind, *values, payload=None):
    body = struct.pack(FORMS[kind], *values) if payload is None else payload
    middle = bytes([kind, len(body)]) + body
    return b"\xa5" + middle + struct.pack("<H", crc(middle))


def sensible(kind, values):
    """Whether values can be meant, by the last paragraph of PROTOCOL.md and the limits of pel."""
    if kind == 1:
        return 0 < values[2] <= 8192 and 0 < values[3] <= 8192 and values[4] < 8
    if kind == 2:
        return values[11] <= 2 and values[3] <= values[2]
    if kind == 3:
        return values[2] < 32768 and values[3] < 32768 and values[4] < 8
    _, label, edges, x0, x1, y0, y1, area, sum_x, sum_y = values[:10]
    if not (x0 < x1 <= 8192 and y0 < y1 <= 8192 and 0 < area <= (x1 - x0) * (y1 - y0)
            and edges < 16 and label < 8 and area * x0 <= sum_x <= area * (x1 - 1)
            and area * y0 <= sum_y <= area * (y1 - 1)):
        return False
    if kind & 1:
        for value, low, high in zip(values[10:13], (x0 * x0, x0 * y0, y0 * y0),
                                    ((x1 - 1) ** 2, (x1 - 1) * (y1 - 1), (y1 - 1) ** 2)):
            if not area * low <= value <= area * high:
                return False
    return True


def decode(data):
    """Good records as (kind, values), and a Counter of what went wrong."""
    records, wrong, at = [], collections.Counter(), 0
    while at < len(data):
        if data[at] == 0xA5:
            rest = data[at:at + 101]
            form = FORMS.get(rest[1]) if len(rest) > 1 else None
            if len(rest) < 3:
                wrong["cut short"] += 1
            elif rest[2] == struct.calcsize(form) if form else rest[2] <= 96:
                end = rest[2] + 5
                if len(rest) < end:
                    wrong["cut short"] += 1
                elif crc(rest[1:end - 2]) == struct.unpack("<H", rest[end - 2:end])[0]:
                    values = struct.unpack(form, rest[3:end - 2]) if form else ()
                    if not form or sensible(rest[1], values):
                        if form:
                            records.append((rest[1], values))
                        else:
                            wrong["unknown types"] += 1
                        at += end
                        continue
                    wrong["impossible values"] += 1
                elif form:
                    wrong["wrong checksum"] += 1
        wrong["bytes skipped"] += 1
        at += 1
    return records, wrong


def blobs_of(records):
    """The first columns of `pel listen --csv` that need no names, as a sorted list."""
    return sorted((v[0], v[1], v[7], v[3], v[5], v[4], v[6], v[8], v[9])
                  for kind, v in records if kind >= 0x10)


def blobs_of_csv(text):
    rows = [line.split(",") for line in text.splitlines()[1:]]
    return sorted(tuple(int(word) for word in row[:2] + row[3:10]) for row in rows)


def listen(data, *options):
    return run(PEL, "listen", *options, "-", stdin=data)


def complaints(stderr):
    """{what: count} of the lines 'pel: standard input: COUNT records with a wrong checksum'."""
    found = {}
    for line in stderr.decode().splitlines():
        match = re.match(r"pel: .*?: (\d+) (.*)$", line)
        if match:
            found[match.group(2)] = int(match.group(1))
    return found


SAYS = {"wrong checksum": "records with a wrong checksum",
        "impossible values": "records with impossible values",
        "cut short": "records cut short by the end",
        "unknown types": "records of unknown types", "bytes skipped": "bytes skipped"}


def check_damaged(data, truth, what, counted):
    """Whether the listener says of a damaged stream what it must, and no blob that was not sent."""
    done = listen(data, "--csv")
    records, wrong = decode(data)
    got, said = blobs_of_csv(done.stdout.decode()), complaints(done.stderr)
    faults = []
    if not set(got) <= truth:
        faults.append("a blob that was never sent")
    if got != blobs_of(records):
        faults.append("%d blobs, not %d" % (len(got), len(blobs_of(records))))
    for key, words in SAYS.items():
        if said.get(words, 0) != wrong[key]:
            faults.append("%s: %d, not %d" % (words, said.get(words, 0), wrong[key]))
    if done.returncode != (0 if records else 1):
        faults.append("exit status %d" % done.returncode)
    counted.update(wrong)
    if faults:
        print("wrong: %s: %s" % (what, "; ".join(faults)))
    return not faults


def small_stream():
    """Two frames with every kind of blob record; what is in them as a set."""
    def blob(frame, measure, label, x0, y0, side):
        xs = [x for x in range(x0, x0 + side) for _ in range(side)]
        ys = [y for _ in range(side) for y in range(y0, y0 + side)]
        values = [frame, label, 0, x0, x0 + side, y0, y0 + side, side * side, sum(xs), sum(ys)]
        if measure & 1:
            values += [sum(x * x for x in xs), sum(x * y for x, y in zip(xs, ys)),
                       sum(y * y for y in ys)]
        values += [4 * side, 0] if measure & 2 else []
        values += [165, 165, 0] if measure & 4 else []  # 0xA5: start bytes within a record
        return encode(0x10 + measure, *values)
    records = [encode(1, 0, 0, 320, 240, 7, 8), blob(0, 7, 0, 165, 16, 3), blob(0, 0, 5, 2, 3, 1),
               encode(3, 0, 9, 17000, 2400, 0), encode(2, 0, 31200, 2, 0, 0, 0, 0, 0, 0, 2, 0, 0),
               encode(1, 1, 33333, 320, 240, 4, 8), blob(1, 4, 7, 300, 200, 4),
               encode(2, 1, 64533, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0)]
    return records, set(blobs_of(decode(b"".join(records))[0]))


# ---- Tests of the protocol ---------------------------------------------------------------------


def test_crc():
    check(crc(b"123456789") == 0x29B1, "the judge's CRC of 123456789")


def test_listener_reads_hand_made_records():
    records, truth = small_stream()
    done = listen(b"".join(records), "--csv", "-c", CLASSES)
    lines = done.stdout.decode().splitlines()
    check(done.returncode == 0 and done.stderr == b"", "small stream: %r" % done.stderr)
    check(blobs_of_csv(done.stdout.decode()) == sorted(truth) and len(truth) == 3, "small stream")
    # 3 x 3 pixels from (165, 16): sums 9 * 166 and 9 * 17, all of it written down by hand.
    check(lines[1] == "0,0,orange,9,165,16,168,19,1494,153,166.000,17.000,0.00,0.0000,1.0000,"
          "1.0000,0.7854,12,0,0,165,165,0", lines[1])
    targets = listen(b"".join(records), "--targets", "-c", CLASSES).stdout.decode().splitlines()
    check(targets == ["frame,class,name,area,x_q15,y_q15", "0,0,orange,9,17000,2400"], targets)
    unnamed = listen(b"".join(records), "--csv").stdout.decode().splitlines()
    check(unnamed[2].startswith("0,5,class5,1,2,3,3,4,2,3,"), unnamed[2])


def test_nothing_valid():
    for data in (b"", b"hello", b"\xa5" * 500, b"\xa5\x10\x1a", encode(0x20, payload=b"1234")):
        done = listen(data)
        check(done.returncode == 1, "exit status for %r" % data[:8])
    check(b"1 records of unknown types" in listen(encode(0x20, payload=b"1234")).stderr,
          "an unknown type is named")


def test_missing_records():
    records, _ = small_stream()
    for left_out, words in ((1, "1 blobs missing"), (4, "1 frames whose end is missing")):
        data = b"".join(r for i, r in enumerate(records) if i != left_out)
        check(words in listen(data).stderr.decode(), words)
    for i in range(len(records)):  # whatever is missing, the rest is there
        data = b"".join(r for j, r in enumerate(records) if j != i)
        check(blobs_of_csv(listen(data, "--csv").stdout.decode()) == blobs_of(decode(data)[0]),
              "without record %d" % i)


def test_every_bit_flipped():
    records, truth = small_stream()
    data, good, counted = b"".join(records), 0, collections.Counter()
    for bit in range(8 * len(data)):
        damaged = bytearray(data)
        damaged[bit // 8] ^= 1 << bit % 8
        good += check_damaged(bytes(damaged), truth, "bit %d flipped" % bit, counted)
    check(good == 8 * len(data), "bits flipped: %d of %d" % (good, 8 * len(data)))
    check(counted["wrong checksum"] > len(data), "wrong checksums happened")
    print("%d flipped bits: %s" % (good, dict(counted)))


def test_every_truncation():
    records, truth = small_stream()
    data, good, counted = b"".join(records), 0, collections.Counter()
    for length in range(len(data)):
        good += check_damaged(data[:length], truth, "first %d bytes" % length, counted)
        good += check_damaged(data[length:], truth, "without %d bytes" % length, counted)
    check(good == 2 * len(data), "truncations: %d of %d" % (good, 2 * len(data)))
    print("%d truncations: %s" % (good, dict(counted)))


def garbage(chance):
    """Noise with start bytes, beginnings of records and broken records in it."""
    kind = chance.randrange(4)
    if kind == 0:
        return bytes(chance.randrange(256) for _ in range(chance.randrange(150)))
    if kind == 1:
        return b"\xa5" * chance.randrange(1, 8)
    records, _ = small_stream()
    record = bytearray(chance.choice(records))
    if kind == 2:
        return bytes(record[:chance.randrange(1, len(record))])
    record[chance.randrange(len(record))] ^= chance.randrange(1, 256)
    return bytes(record)


def test_garbage_between_records():
    chance, rounds, good, counted = random.Random(4), 300, 0, collections.Counter()
    records, truth = small_stream()
    for number in range(rounds):
        data = b"".join(garbage(chance) + record for record in records) + garbage(chance)
        found = decode(data)[0]
        good += (check_damaged(data, truth, "garbage %d" % number, counted)
                 and set(blobs_of(found)) == truth)
    check(good == rounds, "garbage: %d of %d" % (good, rounds))
    print("%d streams with garbage: %s" % (good, dict(counted)))


def test_impossible_values():
    good = [3, 1, 0, 10, 14, 20, 22, 8, 92, 164]
    check(listen(encode(0x10, *good)).returncode == 0, "a blob that makes sense")
    for place, value in ((1, 8), (2, 16), (4, 10), (4, 8193), (6, 20), (7, 0), (7, 9), (8, 79),
                         (8, 105), (9, 159), (9, 169)):
        bad = list(good)
        bad[place] = value
        done = listen(encode(0x10, *bad))
        check(done.returncode == 1 and b"1 records with impossible values" in done.stderr,
              "field %d = %d" % (place, value))


# ---- The firmware ------------------------------------------------------------------------------


def build(folder, *defines, board=None):
    """Configures and builds the firmware; returns its folder."""
    words = ["cmake", "-S", ROBOT, "-B", folder, "-DPEL_WERROR=ON", "-DPEL_STACK_USAGE=ON",
             "-DPEL_ROBOT_DEFINES=" + ";".join(defines)]
    if board:
        words += ["-DPEL_BOARD=" + board,
                  "-DCMAKE_TOOLCHAIN_FILE=%s" % (SOURCE / "ports/baremetal/toolchain.cmake")]
    else:
        words += ["-DCMAKE_C_COMPILER=" + CC, "-DPEL_STACK_USAGE=OFF"]
    must(*words)
    must("cmake", "--build", folder)
    return folder


def play(folder, camera):
    """Runs the firmware in its folder; returns what came out of its UART and what it said."""
    run_in = folder / "run"
    run_in.mkdir(exist_ok=True)
    (run_in / "camera.yuv").write_bytes(camera.read_bytes())
    (run_in / "robot.uart").write_bytes(b"")
    done = must("sh", folder / "run.sh", cwd=run_in)
    return (run_in / "robot.uart").read_bytes(), done.stderr.decode()


def make_camera(folder):
    """Four frames of YUYV: the demo's picture and three scenes."""
    frames = []
    for number in range(4):
        picture = SOURCE / "tools/demo/robot.ppm"
        if number:
            picture = folder / ("scene%d.ppm" % number)
            must(PEL, "scene", "--seed", number, "--size", "320x240", "-o", picture)
        must(PEL, "convert", "--to", "YUYV", picture, folder / "frame.yuv")
        frames.append((folder / "frame.yuv").read_bytes())
    camera = folder / "camera.yuv"
    camera.write_bytes(b"".join(frames))
    check(all(len(frame) == FRAME_BYTES for frame in frames), "size of the frames")
    return camera


def expected(camera, *options):
    return must(PEL, "blobs", "-c", CLASSES, "--raw", "YUYV", "320x240", *options, "-",
                stdin=camera.read_bytes()).stdout


def check_equal(name, stream, camera):
    """What the robot said is what `pel blobs` says, byte for byte."""
    for style in ("--csv", "--json"):
        done = listen(stream, "-c", CLASSES, style)
        wanted = expected(camera, style)
        check(done.stdout == wanted and wanted.count(b"\n") > 3 and done.stderr == b"",
              "%s: %s differs from pel blobs: %s" % (name, style, done.stderr.decode()))
        if style == "--csv":
            print("%s: %d blobs in %d bytes" % (name, wanted.count(b"\n") - 1, len(stream)))


def check_targets(stream, camera):
    """The motors got the largest of classes 0..3, in its place."""
    rows = [line.split(",") for line in expected(camera, "--csv").decode().splitlines()[1:]]
    largest = {}
    for row in rows:
        frame, label, area, sum_x, sum_y = (int(row[i]) for i in (0, 1, 3, 8, 9))
        if label < 4 and area > largest.get(frame, (0,))[0]:
            largest[frame] = (area, label, (sum_x / area + 0.5) / 320, (sum_y / area + 0.5) / 240)
    targets = [values for kind, values in decode(stream)[0] if kind == 3]
    check(len(targets) == 4, "%d targets" % len(targets))
    for frame, area, x_q15, y_q15, label in targets:
        truth = largest[frame]
        check((area, label) == truth[:2], "target %d: %r" % (frame, (area, label)))
        check(abs(x_q15 - 32768 * truth[2]) <= 1 and abs(y_q15 - 32768 * truth[3]) <= 1,
              "target %d at %d, %d, not %r" % (frame, x_q15, y_q15, truth[2:]))


def deepest(folder):
    """Bytes of stack from the first C function down, out of the compiler's graph files. Calls
    through pointers reach what stack.py lists for the library, and the firmware's on_blob."""
    graph = stack.Graph(path.with_suffix("") for path in folder.rglob("*.ci"))
    mine = [entry for entry in stack.INDIRECT if "on_blob" not in entry[0]]
    faults, used = graph.resolve([(r"\bon_blob\(", "on_blob")] + mine)
    check(not faults and r"\bon_blob\(" in used, "calls through pointers: %s" % faults)
    rings = graph.rings()
    check(not rings, "functions that come back to themselves: %s" % rings)
    return graph.deepest("pel_start")


def check_memory(name, folder, said):
    compiler, _, limits = BOARDS[name]
    size = re.sub(r"gcc$", "size", compiler)
    text, data, bss = (int(word) for word in
                       must(size, folder / "robot_blobs.elf").stdout.split(b"\n")[1].split()[:3])
    used = int(re.search(r"stack used: (\d+) bytes", said).group(1))
    bound = deepest(folder)
    ram, flash = data + bss + bound, text + data
    print("%s: flash %d, RAM %d (data %d, bss %d, stack at most %d; %d were used)"
          % (name, flash, ram, data, bss, bound, used))
    check(used <= bound,
          "%s: %d bytes of stack used, but %d predicted" % (name, used, bound))
    if limits:
        check(ram < limits[0], "%s: RAM %d" % (name, ram))
        check(flash < limits[1], "%s: flash %d" % (name, flash))


def test_classes_are_those_of_the_file():
    folder = OUT / "classes"
    folder.mkdir(exist_ok=True)
    made = folder / "robot_classes.c"
    must(PEL, "classes", "--c-array", "robot_classes", CLASSES, made)
    kept = (ROBOT / "robot_classes.c").read_text()
    code = [re.sub(r"/\*.*?:\n.*?\*/", "", text, count=1, flags=re.S).split()
            for text in (made.read_text(), kept)]
    check(code[0] == code[1], "robot_classes.c is not robot.classes")
    check("robot_classes_count = 8" in kept, "eight classes")


def test_firmware():
    global skipped
    camera = make_camera(OUT)
    reference, _ = play(build(OUT / "host"), camera)
    check_equal("host", reference, camera)
    check_targets(reference, camera)
    for name, (compiler, emulator, _) in BOARDS.items():
        lacking = [tool for tool in (compiler, emulator) if shutil.which(tool) is None]
        if lacking:
            skipped += 1
            print("skipped: %s: no %s" % (name, ", ".join(lacking)))
            continue
        folder = build(OUT / name, board=name)
        stream, said = play(folder, camera)
        check(stream == reference, "%s: not the bytes of the host" % name)
        check_equal(name, stream, camera)
        check_memory(name, folder, said)


def test_missed_line():
    """The camera is faster than the program in the middle of frame 1: 0, 2 and 3 stay whole."""
    camera = OUT / "camera.yuv"
    stream, _ = play(build(OUT / "missing", "PORT_MISS_FRAME=1", "PORT_MISS_LINE=100"), camera)
    records, wrong = decode(stream)
    ends = [(v[0], v[11], v[10]) for kind, v in records if kind == 2]
    check(ends == [(0, 0, 0), (1, 2, 1), (2, 0, 1), (3, 0, 1)] and not wrong, ends)
    done = listen(stream, "--csv", "-c", CLASSES)
    check(b"1 frames broken off" in done.stderr and b"1 lines missed" in done.stderr, done.stderr)
    truth = expected(camera, "--csv").decode().splitlines()
    got = done.stdout.decode().splitlines()
    check([row for row in got if row[:2] != "1,"] == [row for row in truth if row[:2] != "1,"],
          "the other frames")
    broken = [row for row in got if row[:2] == "1,"]
    check(broken and set(broken) <= set(truth), "blobs closed before the break are true")
    check([v[0] for kind, v in records if kind == 3] == [0, 2, 3], "no target of a broken frame")


def test_too_few_open_blobs():
    """With room for four open blobs some are lost, and counted; those that come are true."""
    camera = OUT / "camera.yuv"
    stream, _ = play(build(OUT / "few", "ROBOT_OPEN_MAX=4"), camera)
    got = blobs_of_csv(listen(stream, "--csv").stdout.decode())
    truth = blobs_of_csv(expected(camera, "--csv").decode())
    check(got and set(got) < set(truth), "some of the true blobs")
    for kind, v in decode(stream)[0]:
        if kind == 2:
            missing = (sum(row[2] for row in truth if row[0] == v[0])
                       - sum(row[2] for row in got if row[0] == v[0]))
            check(v[7] == missing and v[11] == (1 if missing else 0),
                  "frame %d: %d pixels lost, %d missing" % (v[0], v[7], missing))


def test_cut_short_camera():
    """Half a line is no line: the frame is broken off."""
    camera = OUT / "short.yuv"
    camera.write_bytes((OUT / "camera.yuv").read_bytes()[:FRAME_BYTES + 640 * 10 + 3])
    stream, _ = play(OUT / "host", camera)
    ends = [(v[0], v[11]) for kind, v in decode(stream)[0] if kind == 2]
    check(ends == [(0, 0), (1, 2)], ends)


# ---- The template ------------------------------------------------------------------------------


def template_flags():
    return ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion",
            "-Wshadow", "-Werror", "-I", SOURCE / "lib/include", "-I", SOURCE / "lib/src",
            "-I", SOURCE / "ports/template"]


def library_sources():
    listed = (SOURCE / "lib/pel_files.cmake").read_text()
    return [SOURCE / "lib" / name for name in re.findall(r"\$\{PEL_LIB_DIR\}/(\S+\.c)", listed)]


def test_template():
    """The empty port compiles and runs; with a camera the first blob is where it must be."""
    flags, library = template_flags(), library_sources()
    first = SOURCE / "ports/template/first_blob.c"
    must(CC, *flags, first, SOURCE / "ports/template/port.c", *library, "-o", OUT / "empty")
    done = run(OUT / "empty")
    check((done.returncode, done.stdout) == (0, b""), "the empty port")
    must(CC, *flags, first, ROBOT / "port_simulated.c", ROBOT / "simulated_host.c", *library,
         "-o", OUT / "first")
    camera = OUT / "camera.yuv"
    done = run(OUT / "first", stdin=camera.read_bytes())
    rows = [line.split(",") for line in expected(camera, "--csv", "--class", "orange", "--max",
                                                 "1").decode().splitlines()[1:]]
    truth = {int(row[0]): "x %d y %d area %s" % (int(row[8]) // int(row[3]),
                                                 int(row[9]) // int(row[3]), row[3])
             for row in rows}
    wanted = "".join(truth.get(frame, "nothing") + "\r\n" for frame in range(4))
    check(truth and done.stdout.decode() == wanted, "first blobs: %r" % done.stdout)


def test_false_camera():
    """The README's camera without a camera gives the blob that the README promises."""
    readme = (SOURCE / "ports/template/README.md").read_text()
    code = re.search(r"^    static uint8_t line_bytes.*?^    }$", readme, re.M | re.S).group(0)
    promised = re.search(r"must say `(.*?)`", readme).group(1)
    port = (SOURCE / "ports/template/port.c").read_text()
    empty_line = re.search(r"^int port_line\(.*?^}$", port, re.M | re.S).group(0)
    silent = "    (void)bytes;\n    (void)count;\n    return 0;"
    check(silent in port, "the empty port_write")
    loud = "    return fwrite(bytes, 1, count, stdout) == count ? fflush(stdout) : PORT_FAILED;"
    filled = "#include <stdio.h>\n" + port.replace(empty_line, code).replace(silent, loud)
    (OUT / "false.c").write_text(filled)
    must(CC, *template_flags(), SOURCE / "ports/template/first_blob.c", OUT / "false.c",
         *library_sources(), "-o", OUT / "false")
    endless = subprocess.Popen([OUT / "false"], stdout=subprocess.PIPE)
    lines = [endless.stdout.readline() for _ in range(3)]
    endless.kill()
    endless.stdout.close()
    endless.wait()
    check(lines == [promised.encode() + b"\r\n"] * 3, "the false camera: %r" % lines)


def demo():
    done = run("sh", SOURCE / "tools/demo.sh", "--board", "microbit", OUT)
    said = done.stdout.decode()
    check(done.returncode == 0, "exit status %d: %s" % (done.returncode, done.stderr[-2000:]))
    print(said)
    for names in ("microbit sees tools/demo/robot.ppm", "  orange ", "  blue ", "  field ",
                  "frame,class,name,area,x_q15,y_q15", "finds the same, byte for byte"):
        check(names in said, "the demo says: " + names)
    numbers = re.search(r"Flash: (\d+) bytes\. RAM: (\d+) bytes", said)
    check(numbers and 0 < int(numbers.group(1)) < 24 * 1024
          and 0 < int(numbers.group(2)) < 12 * 1024, "the demo's memory")
    wrong = run("sh", SOURCE / "tools/demo.sh", "--board", "no_such_board", OUT)
    check(wrong.returncode == 2 and b"microbit" in wrong.stderr, "an unknown board is refused")


def main(tests):
    global failed
    for test in tests:
        try:
            test()
        except Exception:  # a test that breaks is a test that failed
            failed += 1
            print("FAILED", test.__name__)
            traceback.print_exc(limit=-2, file=sys.stdout)
    print("%d passed, %d failed" % (passed, failed) + (", %d skipped" % skipped if skipped else ""))
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    if shutil.which(PEL) is None:
        print("the command to test is not there: PEL_COMMAND=%s" % PEL)
        print("0 passed, 1 failed")
        sys.exit(1)
    OUT = pathlib.Path(sys.argv[1]).resolve()
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    sys.exit(main([demo] if "--demo" in sys.argv else
                  [value for name, value in globals().items() if name.startswith("test_")]))
