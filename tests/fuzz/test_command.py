"""The command itself and bad input: exit status 1, one line on standard error that names the file
and the fault, nothing on standard output and no file left behind. Wrong usage: exit status 2. And
what `pel convert` makes of good input, compared with Pillow."""
import os
import pathlib
import subprocess
import tempfile

import numpy
from PIL import Image

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"
PEL = os.environ["PEL_COMMAND"]
DATA = pathlib.Path(os.environ.get("PEL_DATA_DIR", "")) / "robocup-msl"

passed = failed = skipped = 0


def check(holds, what):
    global passed, failed
    if holds:
        passed += 1
    else:
        failed += 1
        print("FAILED:", what)


def pel(*words, stdin=b""):
    return subprocess.run([PEL, *map(str, words)], input=stdin, capture_output=True, timeout=60)


def check_corpus(folder):
    good = CORPUS / "good" / "rgb.png"
    out = folder / "out.ppm"
    for line in (CORPUS / "EXPECTED").read_text().splitlines():
        name, how, fragment = line.split("\t")
        path = CORPUS / name
        if how == "classes":
            got = pel("blobs", "-c", path, good)
        elif how == "source":
            got = pel("convert", path, out)
        else:
            got = pel("convert", "--raw", *how.split()[1:], path, out)
        usage = how.startswith("raw") and "cannot be" in fragment
        text = got.stderr.decode()
        check(got.returncode == (2 if usage else 1), f"{name}: exit status {got.returncode}")
        check(got.stdout == b"", f"{name}: prints {got.stdout[:80]}")
        check(not out.exists(), f"{name}: leaves a file behind")
        out.unlink(missing_ok=True)
        if not usage:
            check(text.startswith(f"pel: {path}: ") and fragment in text and text.count("\n") == 1,
                  f"{name}: says {text!r}")


def check_pipe():
    """The same over standard input, which cannot seek."""
    for name in ("pnm/p6_one_byte_short.ppm", "y4m/second_frame_short.y4m", "png/no_end.png",
                 "jpeg/half.jpg"):
        got = pel("convert", "-", "-", stdin=(CORPUS / name).read_bytes())
        check(got.returncode == 1 and got.stderr.startswith(b"pel: standard input: "),
              f"{name} by pipe")
    for name in ("binary.ppm", "rgb.png", "color.jpg", "video422.y4m"):
        data = (CORPUS / "good" / name).read_bytes()
        piped = pel("convert", "-", "-", stdin=data)
        check(piped.returncode == 0
              and piped.stdout == pel("convert", CORPUS / "good" / name, "-").stdout
              and piped.stdout.startswith(b"P6\n"), f"{name} by pipe")


def check_usage(folder):
    good = CORPUS / "good" / "rgb.png"
    for words in ([], [good], [good, folder / "a.gif"], [good, folder / "a.raw"],
                  ["--to", "YUV9", good, "-"],
                  ["--raw", "YUYV"], ["--raw", "YUYV", "0x2", good, "-"],
                  ["--raw", "YUYV", "3x2", good, "-"],
                  ["--raw", "YUYV", "8193x2", good, "-"],
                  ["--raw", "YUYV", "4294967298x2", good, "-"],
                  ["--range", "half", good, "-"], ["--frame", "-1", good, "-"],
                  ["--frame", "x", good, "-"],
                  ["--c-array", "int", "--to", "YUYV", good, "-"],
                  ["--c-array", "virtual", "--to", "YUYV", good, "-"],
                  ["--c-array", "9a", "--to", "YUYV", good, "-"], ["--c-array", "a", good, "-"],
                  ["--to", "YUYV", good, folder / "a.png"], ["--to", "png", good, folder / "a.ppm"],
                  ["--nonsense"]):
        got = pel("convert", *words)
        check(got.returncode == 2 and got.stderr.startswith(b"pel: ") and got.stdout == b"",
              f"usage {words}: {got.returncode} {got.stderr}")
    check(list(folder.iterdir()) == [], "wrong usage leaves files behind")
    got = pel("convert", "--help")
    check(got.returncode == 0 and b"Examples" in got.stdout and got.stderr == b"", "--help")


def check_files(folder):
    good = CORPUS / "good" / "binary.ppm"
    copy = folder / "same.ppm"
    copy.write_bytes(good.read_bytes())
    got = pel("convert", copy, copy)
    check(got.returncode == 1 and b"same file" in got.stderr
          and copy.read_bytes() == good.read_bytes(),
          "IN is OUT")
    two = good.read_bytes() * 2
    got = pel("convert", "-", folder / "two.png", stdin=two)
    check(got.returncode == 1 and not (folder / "two.png").exists(), "two pictures in a PNG")
    got = pel("convert", "--frame", "2", "-", folder / "third.ppm", stdin=two)
    check(got.returncode == 1 and b"there is no frame 2; the last one is 1" in got.stderr,
          "a frame too far")
    got = pel("convert", "--frame", "1", "-", folder / "second.ppm", stdin=two)
    check(got.returncode == 0 and (folder / "second.ppm").read_bytes() == good.read_bytes(),
          "the second frame")
    got = pel("convert", "--to", "YUYV", good, "-")
    check(got.returncode == 1 and b"4:2:2 needs an even width" in got.stderr,
          "an odd width with 4:2:2")
    if os.access("/dev/full", os.W_OK):
        for words in (["--to", "ppm"], ["--to", "png"], ["--to", "RGB888"],
                      ["--to", "RGB888", "--c-array", "a"]):
            got = pel("convert", *words, good, "/dev/full")
            check(got.returncode == 1 and b"/dev/full" in got.stderr,
                  f"a full disk {words}: {got.stderr}")


def check_crop(folder):
    """What --crop leaves, byte for byte, and what it refuses."""
    rgb = bytes(range(6 * 4 * 3))
    picture, out = folder / "crop.ppm", folder / "part.ppm"
    picture.write_bytes(b"P6\n6 4\n255\n" + rgb)
    got = pel("convert", "--crop", "1,2,5,4", picture, out)
    want = b"".join(rgb[18 * y + 3:18 * y + 15] for y in (2, 3))
    check(got.returncode == 0 and out.read_bytes() == b"P6\n4 2\n255\n" + want,
          f"a part of a PPM: {got.stderr}")
    yuyv = bytes(range(12 * 4))
    raw = ["--raw", "YUYV", "6x4"]
    got = pel("convert", *raw, "--crop", "2,1,4,3", "-", folder / "part.raw", stdin=yuyv * 2)
    want = yuyv[16:20] + yuyv[28:32]
    check(got.returncode == 0 and (folder / "part.raw").read_bytes() == want * 2,
          f"a part of two YUYV frames: {got.stderr}")
    i420 = bytes(range(36))  # 6 x 4: Y, then 3 x 2 of U, then of V
    got = pel("convert", "--raw", "I420", "6x4", "--crop", "2,2,6,4", "-", folder / "part.yuv",
              stdin=i420)
    want = i420[14:18] + i420[20:24] + i420[28:30] + i420[34:36]
    check(got.returncode == 0 and (folder / "part.yuv").read_bytes() == want,
          f"a part of an I420 frame: {got.stderr}")
    got = pel("convert", "--to", "YUYV", "--crop", "1,0,5,4", picture, folder / "even.yuv")
    check(got.returncode == 0 and (folder / "even.yuv").stat().st_size == 4 * 4 * 2,
          f"RGB may be cut anywhere: {got.stderr}")
    odd = CORPUS / "good" / "binary.ppm"
    got = pel("convert", "--to", "YUYV", odd, "-")
    check(got.returncode == 1 and b"even width" in got.stderr and b"--crop" in got.stderr,
          f"an odd width: the way out is named: {got.stderr}")
    got = pel("convert", *raw, "--crop", "1,0,4,2", "-", "-", "--to", "ppm", stdin=yuyv)
    check(got.returncode == 1 and b"1,0,4,2 cuts through pixels of YUYV" in got.stderr
          and got.stdout == b"", f"through a pair: {got.stderr}")
    got = pel("convert", "--crop", "0,0,7,4", picture, folder / "none.ppm")
    check(got.returncode == 1 and b"0,0,7,4 is not inside the picture of 6x4" in got.stderr
          and not (folder / "none.ppm").exists(), f"outside: {got.stderr}")
    for word in ("1,1,1,4", "3,0,2,4", "0,0,4", "0,0,4,4,4", "0,0,4,x", "-1,0,4,4", "0,0,8193,4",
                 ""):
        got = pel("convert", "--crop", word, picture, folder / "none.ppm")
        check(got.returncode == 2 and b"--crop needs X0,Y0,X1,Y1" in got.stderr,
              f"--crop {word}: {got.stderr}")


def check_c_array(folder):
    source, program = folder / "shot.c", folder / "shot"
    picture = CORPUS / "good" / "video422.y4m"
    got = pel("convert", "--to", "UYVY", "--c-array", "shot", picture, source)
    check(got.returncode == 0, f"C array: {got.stderr}")
    main = folder / "main.c"
    main.write_text('#include <stdio.h>\n#include "shot.c"\nint main(void)\n{\n'
                    "    printf(\"%d %d \", shot_width, shot_height);\n"
                    "    for (unsigned i = 0; i < sizeof shot; i++) { printf(\"%d \", shot[i]); }\n"
                    "    return 0;\n}\n")
    compiler = os.environ.get("PEL_CC", "cc")
    built = subprocess.run([compiler, "-std=c99", "-Wall", "-Wextra", "-Werror", main,
                            "-o", program],
                           capture_output=True)
    check(built.returncode == 0, f"C array: {built.stderr}")
    if built.returncode == 0:
        said = subprocess.run([program], capture_output=True).stdout.split()
        check(said == b"4 2 8 0 12 1 9 2 13 3 10 4 14 5 11 6 15 7".split(), f"C array: {said}")


def check_against_pillow(folder):
    """Pillow uses the same JPEG library or a sister of it: colours within 2."""
    global skipped
    pictures = sorted(DATA.glob("*.jpg")) if DATA.is_dir() else []
    if not pictures:
        skipped += 1
        print("skipped: no pictures in", DATA)
    for path in pictures[:3]:
        out = folder / "photo.png"
        got = pel("convert", path, out)
        check(got.returncode == 0, f"{path.name}: {got.stderr}")
        ours = numpy.asarray(Image.open(out)).astype(int)
        theirs = numpy.asarray(Image.open(path).convert("RGB")).astype(int)
        check(ours.shape == theirs.shape and abs(ours - theirs).max() <= 2,
              f"{path.name}: other colours")
    generator = numpy.random.default_rng(7)
    for mode, channels in (("L", 1), ("LA", 2), ("RGB", 3), ("RGBA", 4)):
        made = generator.integers(0, 256, (23, 31, channels), numpy.uint8)
        Image.fromarray(made.squeeze(), mode if channels != 2 else "LA").save(folder / "made.png")
        got = pel("convert", folder / "made.png", folder / "got.ppm")
        ours = numpy.asarray(Image.open(folder / "got.ppm"))
        want = made[:, :, :1].repeat(3, 2) if channels < 3 else made[:, :, :3]
        check(got.returncode == 0 and (ours == want).all(), f"PNG {mode}: other colours")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_usage(folder)
        check_corpus(folder)
        check_pipe()
        check_files(folder)
        check_crop(folder)
        check_c_array(folder)
        check_against_pillow(folder)
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed or not passed else 0


raise SystemExit(main())
