"""`pel capture`, `pel cameras` and `pel blobs -d` with replayed cameras (replayed_cameras.c).

What the cameras show are frames written here or by `pel convert`, so that what arrives is known by
value; the program itself watches that everything is closed and given back (status 99 otherwise).
"""
import csv
import functools
import io
import os
import pty
import resource
import select
import signal
import stat
import subprocess
import time

from peltest import (DEMO, Result, collect, equal, main, ok, parse_pnm, read_pnm, refused, true,
                     write)

REPLAYED = os.environ.get("PEL_COMMAND_REPLAYED", "pel_replayed")
YUYV = "mode=YUYV:320x240:30 frames=frames.raw "
CLASSES = os.path.join(DEMO, "robot.classes")
PLACES = {"YUYV": (0, 1, 3), "UYVY": (1, 0, 2), "YVYU": (0, 3, 1), "VYUY": (1, 2, 0)}


def environment(replay):
    return dict(os.environ, PEL_REPLAY=replay)


def rep(replay, *words, status=0, err=None, **options):
    """Runs the command with the cameras that `replay` describes."""
    done = subprocess.run([REPLAYED, *map(str, words)], stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120,
                          env=environment(replay), **options)
    result = Result(done.returncode, done.stdout, done.stderr)
    what = "%s | %s: %s" % (replay, " ".join(map(str, words)), result.err)
    equal(result.status, status, what)
    if err is None:
        equal(result.err, "", what)
    for part in err or []:
        true(part in result.err, "%r is not in: %s" % (part, what))
    return result


def scenes(form, count=2, name="frames.raw"):
    """Writes frames of rendered scenes, one after another; returns the bytes of each."""
    frames = [scene(form, seed) for seed in range(1, count + 1)]
    write(name, b"".join(frames))
    return frames


@functools.lru_cache(maxsize=None)
def scene(form, seed):
    ok("scene", "--seed", seed, "-o", "scene.ppm")
    return ok("convert", "--to", form, "scene.ppm", "-").out


def as_ppm(frame, form, *options):
    """The pixels that a raw frame means."""
    write("one.raw", frame)
    out = ok("convert", "--raw", form, "320x240", *options, "one.raw", "-").out
    return parse_pnm(out)[0][:4]


def y4m(data):
    """The words of the header, and the frames."""
    header, rest = data.split(b"\n", 1)
    words = header.decode().split(" ")
    equal(words[0], "YUV4MPEG2")
    size = {"C422": 2 * 320 * 240, "C420jpeg": 320 * 240 * 3 // 2, "Cmono": 320 * 240}
    bytes_of = next(size[word] for word in words if word in size)
    true(len(rest) % (bytes_of + 6) == 0, "whole frames: %d bytes" % len(rest))
    frames = []
    for at in range(0, len(rest), bytes_of + 6):
        equal(rest[at:at + 6], b"FRAME\n")
        frames.append(rest[at + 6:at + 6 + bytes_of])
    return words, frames


def planar(frame, form):
    """4:2:2 as the video file has it: all Y, all U, all V."""
    luma, u, v = PLACES[form]
    return frame[luma::2] + frame[u::4] + frame[v::4]


def read(path):
    with open(path, "rb") as file:
        return file.read()


# ---- What is recorded -------------------------------------------------------------------------


def test_one_picture():
    frames = scenes("YUYV")
    rep(YUYV, "capture", "out.ppm")
    picture = read_pnm("out.ppm")
    equal(picture[:4] == as_ppm(frames[0], "YUYV", "--range", "limited"), True, "pixels")
    equal(picture[4], ["camera: Replayed Camera (replay, usb-replay-1) at /dev/video0",
                       "format: YUYV 320x240, 640 bytes per line, limited range",
                       "rate: 30/1 frames per second",
                       "controls: exposure=2500, auto_exposure=3, gain=50, white_balance=4600, "
                       "auto_white_balance=1, power_line=1",
                       "frame: sequence 0, " + picture[4][-1].split(", ")[1]])
    rep(YUYV + "quantization=1", "capture", "full.ppm")
    equal(read_pnm("full.ppm")[:4] == as_ppm(frames[0], "YUYV"), True, "full range")


def test_png_has_the_comment():
    frames = scenes("YUYV", 1)
    rep(YUYV, "capture", "--exposure", 300, "out.png")
    data = read("out.png")
    at = data.index(b"tEXtComment\0")
    length = int.from_bytes(data[at - 4:at], "big")
    text = data[at + 12:at + 4 + length].decode()
    true("\ncontrols: exposure=300, auto_exposure=1, " in text, text)
    out = ok("convert", "out.png", "-").out
    equal(parse_pnm(out)[0][:4] == as_ppm(frames[0], "YUYV", "--range", "limited"), True)


def test_numbered_pictures():
    frames = scenes("YUYV")
    rep(YUYV, "capture", "--count", 3, "out-%04d.ppm")
    equal(sorted(name for name in os.listdir() if name.startswith("out")),
          ["out-0000.ppm", "out-0001.ppm", "out-0002.ppm"])
    for number in range(3):
        picture = read_pnm("out-%04d.ppm" % number)
        equal(picture[:4] == as_ppm(frames[number % 2], "YUYV", "--range", "limited"), True)
        true(picture[4][-1].startswith("frame: sequence %d, " % number), picture[4][-1])


def test_video_without_loss():
    for form in PLACES:
        frames = scenes(form)
        for stride in ("", "stride=64 "):
            rep("mode=%s:320x240:25 frames=frames.raw %s" % (form, stride), "capture", "--count", 3,
                "--force", "out.y4m")
            words, got = y4m(read("out.y4m"))
            equal(words[1:7], ["W320", "H240", "F25:1", "Ip", "A1:1", "C422"])
            equal(words[7], "XCOLORRANGE=LIMITED")
            true(words[8].startswith("XPEL=camera:_Replayed_Camera_"), words[8])
            true("controls:_exposure=2500," in words[8], words[8])
            for i, frame in enumerate(got):
                equal(frame == planar(frames[i % 2], form), True, "%s frame %d" % (form, i))
            equal(len(got), 3)
    back = ok("convert", "--to", "VYUY", "--frame", 1, "out.y4m", "-").out
    equal(back == frames[1], True, "the bytes of the camera again")


def test_other_videos():
    frames = scenes("NV12", 1)
    rep("mode=NV12:320x240:30 frames=frames.raw", "capture", "--count", 1, "out.y4m")
    chroma = frames[0][76800:]
    equal(y4m(read("out.y4m"))[1] == [frames[0][:76800] + chroma[0::2] + chroma[1::2]], True)
    frames = scenes("GRAY8", 1)
    rep("mode=GREY:320x240:30 frames=frames.raw", "capture", "--count", 1, "gray.y4m")
    equal(y4m(read("gray.y4m"))[1] == frames, True)


def test_raw_is_without_padding():
    for form, code in (("YUYV", "YUYV"), ("RGB565_BE", "RGBR"), ("BAYER8_GRBG", "GRBG")):
        frames = scenes(form)
        rep("mode=%s:320x240:30 frames=frames.raw stride=48" % code, "capture", "--count", 2,
            "--force", "out.raw")
        equal(read("out.raw") == frames[0] + frames[1], True, form)
        rep("mode=%s:320x240:30 frames=frames.raw stride=48" % code, "capture", "--format", form,
            "--force", "out.ppm")
        options = ["--range", "limited"] if form == "YUYV" else []
        equal(read_pnm("out.ppm")[:4] == as_ppm(frames[0], form, *options), True, form)


def test_jpeg_cameras():
    ok("scene", "--seed", 1, "--size", "96x64", "-o", "scene.ppm")
    ok("convert", "scene.ppm", "scene.jpg")
    ok("convert", "scene.jpg", "wanted.ppm")
    replay = "mode=MJPG:96x64:30 jpeg=scene.jpg"
    rep(replay, "capture", "out.ppm")
    wanted = read_pnm("wanted.ppm")[3]
    far = max(abs(a - b) for a, b in zip(read_pnm("out.ppm")[3], wanted))
    true(far <= 8, "a channel is %d away" % far)  # decoders may smooth chroma differently
    rep(replay, "capture", "--count", 2, "out.raw")
    equal(read("out.raw") == 2 * read_pnm("out.ppm")[3], True)
    damaged = read("scene.jpg")
    write("scene.jpg", damaged[:len(damaged) // 2])
    rep(replay, "capture", "none.ppm", status=1, err=["damaged JPEG"])
    equal(os.path.exists("none.ppm"), False)


def test_settle_count_and_seconds():
    frames = scenes("YUYV", 4)
    rep(YUYV + "quantization=1", "capture", "--settle", 3, "out.ppm")
    equal(read_pnm("out.ppm")[:4] == as_ppm(frames[3], "YUYV"), True)
    rep(YUYV, "capture", "--seconds", "0.5", "out.y4m")
    equal(len(y4m(read("out.y4m"))[1]), 16)  # the last 15 * 33 333 us after the first


def test_pipe_into_blobs():
    scenes("YUYV", 2)
    wanted = ok("blobs", "-c", CLASSES, "--csv", "--raw", "YUYV", "320x240", "frames.raw").text
    true(wanted.count("\n") > 5, wanted)
    camera = rep(YUYV + "quantization=1", "capture", "--count", 2, "-")
    equal(ok("blobs", "-c", CLASSES, "--csv", "-", stdin=camera.out).text, wanted)
    limited = rep(YUYV, "capture", "--count", 2, "--range", "full", "-")
    equal(y4m(limited.out)[0][7], "XCOLORRANGE=FULL")
    true(ok("blobs", "-c", CLASSES, "--csv", "-", stdin=limited.out).text.count("\n") > 5)


# ---- Controls ---------------------------------------------------------------------------------


def controls(path):
    line = next(line for line in read_pnm(path)[4] if line.startswith("controls: "))
    return dict(pair.split("=") for pair in line[10:].split(", "))


def test_exposure_and_white_balance():
    scenes("YUYV", 1)
    rep(YUYV, "capture", "--exposure", 120, "--white-balance", 3200, "--gain", 7, "--power-line",
        "60", "out.ppm")
    equal(controls("out.ppm"), {"exposure": "120", "auto_exposure": "1", "gain": "7",
                                "white_balance": "3200", "auto_white_balance": "0",
                                "power_line": "2"})
    rep(YUYV, "capture", "--exposure", "auto", "--white-balance", "auto", "--force", "out.ppm")
    equal([controls("out.ppm")[name] for name in ("auto_exposure", "auto_white_balance")],
          ["3", "1"])
    rep(YUYV, "capture", "--exposure", 6000, "other.ppm", status=1,
        err=["exposure=6000 is refused", "0 to 5000"])
    rep(YUYV, "capture", "--gain", "auto", "other.ppm", status=1,
        err=["--gain: the camera has no control 'auto_gain'", "pel cameras -d /dev/video0"])
    equal(os.path.exists("other.ppm"), False)


def test_ignored_values_are_reported():
    scenes("YUYV", 1)
    rep("ignore=Exposure " + YUYV, "capture", "--exposure", 300, "out.ppm",
        err=["exposure: 300 was asked for, the driver has 2500"])
    equal(controls("out.ppm")["exposure"], "2500")


def test_lock_holds_what_was_reached():
    frames = scenes("YUYV", 4)
    rep(YUYV + "quantization=1", "capture", "--lock", "--settle", 2, "out.ppm")
    equal(controls("out.ppm"), {"exposure": "2500", "auto_exposure": "1", "gain": "50",
                                "white_balance": "4600", "auto_white_balance": "0",
                                "power_line": "1"})
    true("locked: yes" in read_pnm("out.ppm")[4])
    equal(read_pnm("out.ppm")[:4] == as_ppm(frames[2], "YUYV"), True, "two frames skipped")
    rep(YUYV, "capture", "--lock", "--force", "out.ppm")  # and 30 if nothing is said
    equal(read_pnm("out.ppm")[:4] == as_ppm(frames[30 % 4], "YUYV", "--range", "limited"), True)


# ---- Trouble ----------------------------------------------------------------------------------


def test_silent_change_is_reported():
    scenes("YUYV", 1)
    replay = "mode=YUYV:320x240:30 mode=YUYV:160x120:30 force_width=160 force_height=120"
    rep(replay, "capture", "--size", "320x240", "--count", 1, "out.y4m",
        err=["/dev/video0: the camera does not do it all: size 320x240 became 160x120"])
    true(read("out.y4m").startswith(b"YUV4MPEG2 W160 H120 "))
    true(b"changed_by_the_driver:_size_320x240_became_160x120" in read("out.y4m")[:1000])


def test_unplugged():
    frames = scenes("YUYV", 1)
    rep(YUYV + "unplug=3", "capture", "--count", 9, "out.y4m", status=1,
        err=["/dev/video0", "--reconnect"])
    equal(y4m(read("out.y4m"))[1] == 3 * [planar(frames[0], "YUYV")], True, "what came before")
    rep(YUYV + "unplug=3 back_ms=1500", "capture", "--count", 9, "--reconnect", 5, "--force",
        "out.y4m")
    equal(y4m(read("out.y4m"))[1] == 9 * [planar(frames[0], "YUYV")], True)


def test_no_frames():
    scenes("YUYV", 1)
    rep(YUYV + "lose=1000", "capture", "--patience", 4, "out.y4m", status=1,
        err=["/dev/video0: no frame for 4 seconds"])
    equal(os.path.exists("out.y4m"), False)


def test_bad_weather():
    frames = scenes("YUYV", 1)
    rep(YUYV + "damage=200 shorten=200 interrupt=200", "capture", "--count", 50, "out.y4m")
    equal(y4m(read("out.y4m"))[1] == 50 * [planar(frames[0], "YUYV")], True)


def test_not_allowed_busy_or_missing():
    for command in (["capture", "out.ppm"], ["blobs", "-c", CLASSES, "--count", 1],
                    ["capture", "-d", "/dev/video0", "out.ppm"],
                    ["cameras", "-d", "/dev/video0"]):
        rep("open_error=13", *command, status=1, err=["usermod -aG video"])
    for command in (["capture", "out.ppm"], ["blobs", "-c", CLASSES, "-d", "/dev/video0"]):
        rep("busy=1000", *command, status=1, err=["fuser -v /dev/video0"])
    rep("present=0", "capture", "out.ppm", status=1, err=["pel cameras"])
    rep("present=0", "cameras", status=1, err=["no camera"])
    rep("", "capture", "-d", "/dev/video7", "out.ppm", status=1, err=["/dev/video7", "pel cameras"])
    equal(os.path.exists("out.ppm"), False)


def start(replay, *words, **options):
    return subprocess.Popen([REPLAYED, *map(str, words)], stdin=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, env=environment(replay), **options)


def wait_for(condition, process):
    end = time.monotonic() + 60
    while not condition():
        true(process.poll() is None and time.monotonic() < end, "it did not get so far")
        time.sleep(0.01)


def test_signals_leave_whole_frames():
    frames = scenes("YUYV", 1)
    for number in (signal.SIGINT, signal.SIGTERM):
        process = start(YUYV + "realtime=1", "capture", "--force", "out.y4m")
        wait_for(lambda: os.path.exists("out.y4m") and os.path.getsize("out.y4m") > 600000, process)
        process.send_signal(number)
        _, err = process.communicate(timeout=60)
        equal((process.returncode, err), (0, b""))
        got = y4m(read("out.y4m"))[1]
        true(len(got) >= 3 and set(got) == {planar(frames[0], "YUYV")}, "whole frames")
        os.remove("out.y4m")


def test_signal_before_the_first_frame():
    scenes("YUYV", 1)
    process = start(YUYV + "realtime=1 lose=1000", "capture", "out.y4m")
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    equal((process.communicate(timeout=60)[1], process.returncode), (b"", 0))
    equal(os.path.exists("out.y4m"), False)


def test_reader_goes_away():
    scenes("YUYV", 1)
    process = start(YUYV, "capture", "-", stdout=subprocess.PIPE)
    process.stdout.read(100000)
    process.stdout.close()
    err = process.stderr.read().decode()
    process.stderr.close()
    equal((process.wait(60), err), (1, "pel: standard output: cannot write: Broken pipe\n"))


def test_full_disk_keeps_whole_frames():
    frames = scenes("YUYV", 1)

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (400000, 400000))

    rep(YUYV, "capture", "--count", 9, "out.y4m", status=1, preexec_fn=limit,
        err=["out.y4m: cannot write: File too large", "ends after 2 whole frames"])
    equal(y4m(read("out.y4m"))[1] == 2 * [planar(frames[0], "YUYV")], True)


# ---- Files ------------------------------------------------------------------------------------


def test_existing_files():
    scenes("YUYV", 1)
    for name in ("out.ppm", "out.y4m", "out.raw"):
        write(name, b"precious")
        rep(YUYV, "capture", "--count", 1, name, status=1, err=[name + ": exists already; --force"])
        equal(read(name), b"precious")
        rep(YUYV, "capture", "--count", 1, "--force", name)
        true(len(read(name)) > 1000 and not read(name).startswith(b"precious"))
    write("n-0001.ppm", b"precious")
    rep(YUYV, "capture", "--count", 2, "n-%04d.ppm", status=1, err=["n-0001.ppm: exists"])
    equal(read("n-0001.ppm"), b"precious")


def test_links_and_pipes_are_not_followed():
    scenes("YUYV", 1)
    write("target.y4m", b"precious")
    os.symlink("target.y4m", "link.y4m")
    os.symlink("nowhere.y4m", "dangling.y4m")
    os.link("target.y4m", "hard.y4m")
    os.mkfifo("pipe.y4m")
    os.mkdir("folder.y4m")
    for name in ("link.y4m", "dangling.y4m", "hard.y4m", "pipe.y4m", "folder.y4m"):
        for options in ([], ["--force"]):
            rep(YUYV, "capture", "--count", 1, *options, name, status=1, err=[name + ": "])
    equal((read("target.y4m"), os.path.exists("nowhere.y4m")), (b"precious", False))
    rep(YUYV, "capture", "--count", 1, "none/out.y4m", status=1, err=["No such file"])


def test_modes_of_files():
    scenes("YUYV", 1)
    for mask, wanted in ((0o077, 0o600), (0o022, 0o644), (0o000, 0o644)):
        for name in ("out.y4m", "out.ppm"):
            rep(YUYV, "capture", "--count", 1, name, preexec_fn=lambda: os.umask(mask))
            equal(stat.S_IMODE(os.stat(name).st_mode), wanted, name)
            os.remove(name)


# ---- Terminals --------------------------------------------------------------------------------


def on_terminal(replay, *words, stream):
    """Runs with standard error or output as a terminal; returns what was shown there."""
    ours, theirs = pty.openpty()
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, stream: theirs}
    process = subprocess.Popen([REPLAYED, *map(str, words)], stdin=subprocess.DEVNULL,
                               env=environment(replay), **pipes)
    os.close(theirs)
    shown = b""
    while True:
        try:
            ready = select.select([ours], [], [], 60)[0]
            piece = os.read(ours, 4096) if ready else b""
        except OSError:  # the terminal has been closed
            break
        if not piece:
            break
        shown += piece
    out, err = process.communicate(timeout=60)
    os.close(ours)
    return process.returncode, shown.decode(), out, err


def test_progress_on_a_terminal():
    scenes("YUYV", 1)
    status, shown, out, _ = on_terminal(YUYV + "damage=300", "capture", "--count", 30, "out.y4m",
                                        stream="stderr")
    equal((status, out), (0, b""))
    last = shown.rstrip("\r\n").split("\r")[-1]
    true(last.startswith("30 frames, ") and last.endswith(" lost"), shown)
    true(int(last.split(", ")[-1].split()[0]) > 0, "losses: " + last)
    rep(YUYV + "damage=300", "capture", "--count", 30, "--force", "out.y4m")  # quiet otherwise


def test_no_video_on_a_terminal():
    scenes("YUYV", 1)
    status, shown, _, err = on_terminal(YUYV, "capture", "-", stream="stdout")
    equal((status, shown), (1, ""))
    true(b"terminal" in err, err)


def test_table_is_refreshed_in_place():
    scenes("YUYV", 2)
    status, shown, _, err = on_terminal(YUYV + "quantization=1", "blobs", "-c", CLASSES, "--count",
                                        2, "-d", "/dev/video0", stream="stdout")
    equal((status, err), (0, b""))
    tables = shown.split("\033[H\033[J")
    equal((len(tables), tables[0]), (3, ""))
    for number in range(2):
        true(tables[number + 1].startswith("/dev/video0: frame %d, 320x240, " % number), shown)
        true("orange" in tables[number + 1], shown)


# ---- pel blobs -d -----------------------------------------------------------------------------


def test_live_blobs_are_those_of_the_file():
    for form in ("YUYV", "RGB565_LE", "NV12"):
        scenes(form, 2)
        for style in ("--csv", "--json"):
            wanted = ok("blobs", "-c", CLASSES, style, "--raw", form, "320x240", "frames.raw").text
            code = {"RGB565_LE": "RGBP"}.get(form, form)
            got = rep("mode=%s:320x240:30 frames=frames.raw quantization=1" % code, "blobs", "-c",
                      CLASSES, style, "-d", "Replayed", "--count", 2).text
            equal(got, wanted.replace("frames.raw", "/dev/video0"), form + style)


def test_live_blobs_of_limited_range():
    ok("scene", "--seed", 1, "-o", "scene.ppm")
    wanted = ok("blobs", "-c", CLASSES, "--csv", "--min-area", 100, "scene.ppm").text
    write("frames.raw", ok("convert", "--to", "YUYV", "--range", "limited", "scene.ppm", "-").out)
    got = rep(YUYV, "blobs", "-c", CLASSES, "--csv", "--min-area", 100, "--count", 1).text
    first, second = ([row.split(",") for row in text.splitlines()[1:]] for text in (wanted, got))
    first.sort(key=lambda row: (row[2], int(row[4])))
    second.sort(key=lambda row: (row[2], int(row[4])))
    equal([row[2] for row in first], [row[2] for row in second], "the same classes")
    for one, other in zip(first, second):
        true(abs(int(one[3]) - int(other[3])) < 0.1 * int(one[3]), "%s %s" % (one, other))


def test_each_frame_at_once():
    scenes("YUYV", 1)
    process = start(YUYV + "realtime=1 quantization=1", "blobs", "-c", CLASSES, "--json", "-d",
                    "/dev/video0", stdout=subprocess.PIPE)
    for number in range(3):  # long before the program ends
        line = process.stdout.readline().decode()
        true(line.startswith('{"frame":%d,"file":"/dev/video0",' % number), line)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    equal((process.returncode, err), (0, b""))
    true(out == b"" or out.endswith(b"}\n"), "whole lines")


# ---- pel cameras ------------------------------------------------------------------------------


def test_cameras():
    replay = "mode=YUYV:320x240:30 mode=MJPG:640x480:60 mode=H264:640x480:60 second=usb-replay-2"
    out = rep(replay, "cameras").text
    for part in ("/dev/video0: Replayed Camera (replay, usb-replay-1)\n", "/dev/video2: Second",
                 "  * YUYV  320x240, up to 30.000 per second", "  * MJPG  640x480", "    H264 ",
                 "1 50 Hz <", "    exposure                     2500   (0 to 5000; 2500 at first)"):
        true(part in out, "%r is not in\n%s" % (part, out))
    rows = list(csv.DictReader(io.StringIO(rep(replay, "cameras", "--csv", "-d", "usb-replay-1")
                                           .text)))
    equal([(row["device"], row["format"], row["readable"], row["width_min"], row["height_max"],
            row["rate"]) for row in rows],
          [("/dev/video0", "YUYV", "1", "320", "240", "30.000"),
           ("/dev/video0", "MJPG", "1", "640", "480", "60.000"),
           ("/dev/video0", "H264", "0", "640", "480", "60.000")])
    rows = list(csv.DictReader(io.StringIO(rep(replay, "cameras", "--controls-csv", "--camera",
                                               "Second").text)))
    equal([(row["device"], row["known"], row["kind"], row["max"]) for row in rows],
          [("/dev/video2", "gain", "integer", "100"), ("/dev/video2", "power_line", "menu", "2"),
           ("/dev/video2", "exposure", "integer", "5000")])
    equal(rep("busy=1000 mode=YUYV:320x240:30", "cameras").text.split("\n")[0],
          "/dev/video0: Replayed Camera (replay, usb-replay-1), in use by another program")


# ---- Command lines ----------------------------------------------------------------------------


def test_command_lines():
    refused(2, ["one OUT"], "capture")
    refused(2, ["out.gif", ".y4m"], "capture", "out.gif")
    refused(2, ["out.jpg"], "capture", "out.jpg")
    refused(2, ["%04d"], "capture", "--count", 2, "out.ppm")
    refused(2, ["only pictures"], "capture", "out-%04d.y4m")
    refused(2, ["--backend is v4l2 or libcamera"], "capture", "--backend", "dshow", "out.ppm")
    refused(2, ["YUVY", "UYVY"], "capture", "--format", "YUVY", "out.ppm")
    refused(2, ["--rate"], "capture", "--rate", "fast", "out.y4m")
    refused(2, ["--exposure", "'bright'"], "capture", "--exposure", "bright", "out.ppm")
    refused(2, ["--power-line"], "capture", "--power-line", "55", "out.ppm")
    refused(2, ["--settle"], "capture", "--settle", "-1", "out.ppm")
    refused(2, ["needs a value"], "capture", "--device")
    refused(2, ["takes no file"], "cameras", "x")
    refused(2, ["once"], "cameras", "--csv", "--controls-csv")
    refused(2, ["not both"], "blobs", "-c", CLASSES, "-d", "/dev/video0", "frame.ppm")
    equal(os.listdir(), [])


def test_without_libcamera_or_without_its_cameras():
    for command in (["capture", "--backend", "libcamera", "out.ppm"],
                    ["cameras", "--backend", "libcamera"]):
        result = rep("present=0", *command, status=1, err=["pel: "])
        true(result.err.count("\n") == 1 or "libcamera" in result.err, result.err)


if __name__ == "__main__":
    main(collect(dict(globals())))
