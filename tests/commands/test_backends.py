"""--backend: the same bytes with every backend that the machine has, and by their names only."""
from grids import noise, write_gray, write_rgb
from peltest import collect, equal, main, ok, refused, true, write


def backends():
    """Those that `pel bench --list` names."""
    lines = ok("bench", "--list").text.split("Backends\n")[1].split("Inputs\n")[0]
    return lines.split()


def same(*words, out=None):
    """Runs the command with each backend; what it prints, or writes, is what plain C gives."""
    def result(*choice):
        printed = ok(*words, *choice, *([out] if out else [])).out
        if not out:
            return printed
        with open(out, "rb") as file:
            return file.read()
    wanted = result("--backend", "scalar")
    true(len(wanted) > 100, words)
    for name in backends():
        equal(result("--backend", name), wanted, "%s of %s" % (name, words))
    equal(result("--backend", "auto"), wanted, words)
    equal(result(), wanted, words)


def test_filter():
    write_gray("noise.pgm", noise(150, 40, 1))
    for name in ("gauss3", "median", "gradient", "open", "sharpen", "gauss5"):
        same("filter", name, "noise.pgm", out="out.pgm")
    for border in ("wrap", "valid", "constant=9", "reflect101"):
        same("filter", "binomial5", "--border", border, "noise.pgm", out="out.pgm")
    same("filter", "sobel-x", "--wide", "noise.pgm", out="out.pgm")


def test_classes():
    ok("scene", "--size", "160x120", "-o", "scene.ppm", "--classes", "scene.classes")
    same("blobs", "-c", "scene.classes", "--csv", "scene.ppm")
    same("runs", "-c", "scene.classes", "--csv", "scene.ppm")
    same("classify", "-c", "scene.classes", "scene.ppm", out="out.ppm")


def test_points():
    """Wide enough for vectors and what is left of them, with and without colours."""
    write_gray("noise.pgm", noise(152, 40, 1))
    write_gray("other.pgm", noise(152, 40, 2))
    write_rgb("noise.ppm", *(noise(72, 12, seed) for seed in (3, 4, 5)))
    for words in (("threshold", 99), ("otsu",), ("equalize",), ("gamma-brighten", "2"),
                  ("adaptive", 7, 5), ("integral",), ("resize", "95x25"),
                  ("resize", "76x20", "--box"), ("resize", "38x10", "--box"),
                  ("resize", "95x25", "--nearest")):
        same("point", *words, "noise.pgm", out="out.pgm")
    for words in (("add", "other.pgm"), ("min", "other.pgm"), ("blend", "0.3", "other.pgm")):
        same("point", *words, "noise.pgm", out="out.pgm")
    for words in (("white-balance", "--gray-world"), ("resize", "45x6"), ("invert",)):
        same("point", *words, "noise.ppm", out="out.ppm")


def test_raw_frames():
    write("frame.yuv", bytes(value for row in noise(320, 20, 2) for value in row))
    ok("scene", "--size", "32x24", "-o", "scene.ppm", "--classes", "scene.classes")
    raw = ("--raw", "YUYV", "160x20", "-c", "scene.classes")
    same("classify", *raw, "frame.yuv", out="out.ppm")


def test_corners():
    write_gray("noise.pgm", noise(150, 40, 4))
    for method in ("harris", "shi-tomasi", "fast"):
        same("corners", "--method", method, "--csv", "noise.pgm")


def test_edges():
    write_gray("noise.pgm", noise(150, 40, 5))
    for how in ("whole", "rows", "none"):
        same("edges", "--link", how, "noise.pgm", out="out.pgm")


def test_names():
    write_gray("noise.pgm", noise(9, 9, 3))
    for words in (("filter", "median"), ("point", "invert"), ("blobs",), ("runs",), ("classify",),
                  ("corners",), ("edges",)):
        refused(2, ["no backend 'mmx' here; there are: auto scalar"], *words, "--backend", "mmx",
                "noise.pgm", "out.pgm")


if __name__ == "__main__":
    main(collect(globals()))
