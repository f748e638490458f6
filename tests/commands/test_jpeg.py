"""`pel convert` to JPEG: lossy, so what comes back is near, and the rest is exact."""
import os

from peltest import DEMO, collect, equal, main, ok, parse_pnm, refused, true, write


def pnm(path):
    with open(path, "rb") as file:
        return parse_pnm(file.read())[0]


def test_colours_come_back_nearly():
    demo = os.path.join(DEMO, "robot.ppm")
    ok("convert", demo, "out.jpg")
    with open("out.jpg", "rb") as file:
        data = file.read()
    equal((data[:3], data[-2:]), (b"\xff\xd8\xff", b"\xff\xd9"), "JPEG from start to end")
    true(len(data) < os.path.getsize(demo) / 3, "smaller than the PPM")
    ok("convert", "out.jpg", "back.ppm")
    kind, width, height, pixels, _ = pnm("back.ppm")
    _, _, _, wanted, _ = pnm(demo)
    equal((kind, width, height), ("P6", 320, 240))
    distance = sum(abs(a - b) for a, b in zip(pixels, wanted)) / len(wanted)
    true(0 < distance < 3, "mean distance of the channels: %f" % distance)


def test_gray_stays_gray():
    ramp = bytes(range(0, 256, 4)) * 64
    write("ramp.pgm", b"P5 64 64 255\n" + ramp)
    ok("convert", "ramp.pgm", "ramp.jpeg")
    ok("convert", "ramp.jpeg", "back.pgm")
    kind, width, height, pixels, _ = pnm("back.pgm")
    equal((kind, width, height), ("P5", 64, 64))
    true(max(abs(a - b) for a, b in zip(pixels, ramp)) <= 4, "every pixel near")


def test_standard_output_and_refusals():
    write("two.pgm", b"P5 8 8 255\n" + bytes(64) + b"P5 8 8 255\n" + bytes(64))
    equal(ok("convert", "--to", "jpg", "--frame", "0", "two.pgm", "-").out[:2], b"\xff\xd8")
    refused(1, ["two.jpg", "JPEG", "--frame"], "convert", "two.pgm", "two.jpg")
    equal(os.path.exists("two.jpg"), False)
    refused(2, [".ppm"], "filter", "identity", "two.pgm", "out.jpg")


if __name__ == "__main__":
    main(collect(dict(globals())))
