"""`pel scene` tells the truth: its mask, its object list and its picture agree with each other and
with the geometry of a pin-hole camera, computed here once more in floating point."""
import csv
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "commands"))

from peltest import (classify, collect, contract_rows, equal, main, ok, parse_rows,  # noqa: E402
                     read_classes, read_pnm, true)

VIEWS = [
    ["--seed", "1"],
    ["--seed", "2", "--height", "900", "--pitch", "50", "--balls", "8", "--cones", "5"],
    ["--seed", "3", "--height", "60", "--pitch", "0", "--fov", "90", "--balls", "2",
     "--cones", "1"],
    ["--seed", "4", "--height", "1200", "--pitch", "90", "--balls", "3", "--cones", "3"],
    ["--seed", "5", "--size", "161x121", "--pitch", "25.5", "--fov", "40.25"],
]


def scene(*words):
    """Renders a scene; returns its size, pixels, mask, objects and classes."""
    ok("scene", *words, "-o", "s.ppm", "--mask", "m.pgm", "--objects", "o.csv", "--classes",
       "s.classes")
    _, width, height, pixels, _ = read_pnm("s.ppm")
    equal(read_pnm("m.pgm")[1:3], (width, height))
    with open("o.csv", newline="") as file:
        objects = list(csv.DictReader(file))
    for row in objects:
        for key in row:
            if key not in ("kind", "name", "cx", "cy"):
                row[key] = int(row[key])
    return width, height, pixels, read_pnm("m.pgm")[3], objects, read_classes("s.classes")


def test_one_ray_per_pixel_gives_the_mask():
    for words in VIEWS:
        width, height, pixels, mask, _, classes = scene(*words, "--samples", "1")
        equal(classify(pixels, classes) == mask, True, "labels of " + " ".join(words))
        names = [name for name, _ in classes]
        for connectivity in (4, 8):
            out = ok("blobs", "-c", "s.classes", "--csv", "--connectivity", connectivity, "s.ppm")
            wanted = contract_rows(mask, width, height, names, connectivity=connectivity)
            true(len(wanted) >= 4, "blobs")
            equal(parse_rows(out.text), wanted, " ".join(words))


def test_the_mask_does_not_depend_on_light_and_camera():
    masks = []
    for words in ([], ["--gain", "0.5", "--noise", "9", "--blur", "2", "--samples", "1"]):
        ok("scene", "--mask", "m.pgm", *words)
        masks.append(read_pnm("m.pgm")[3])
    true(masks[0] == masks[1], "mask")


def test_objects_add_up_to_the_mask():
    for words in VIEWS:
        width, height, _, mask, objects, classes = scene(*words, "--samples", "1")
        for index in range(len(classes)):
            at = [i for i, label in enumerate(mask) if label == index + 1]
            shown = [row for row in objects if row["class"] == index and row["area"] > 0]
            equal(sum(row["area"] for row in shown), len(at), classes[index][0])
            equal(sum(row["sum_x"] for row in shown), sum(i % width for i in at))
            equal(sum(row["sum_y"] for row in shown), sum(i // width for i in at))
            if shown:
                equal((min(row["x0"] for row in shown), max(row["x1"] for row in shown),
                       min(row["y0"] for row in shown), max(row["y1"] for row in shown)),
                      (min(i % width for i in at), max(i % width for i in at) + 1,
                       at[0] // width, at[-1] // width + 1))


def rays(width, height, camera_mm, pitch, fov):
    """Direction of the ray of every pixel: x to the right, y ahead, z up."""
    focal = width / 2 / math.tan(math.radians(fov) / 2)
    sine, cosine = math.sin(math.radians(pitch)), math.cos(math.radians(pitch))
    for y in range(height):
        v = y - (height - 1) / 2
        for x in range(width):
            u = x - (width - 1) / 2
            yield x, y, (u, focal * cosine - v * sine, -focal * sine - v * cosine)


def test_a_ball_covers_the_pixels_that_geometry_says():
    checked = 0
    for seed, camera, pitch, fov in ((1, 320, 16, 62), (2, 320, 16, 62), (3, 700, 45, 50),
                                     (4, 1000, 90, 70), (5, 150, 5, 100)):
        width, height, _, mask, objects, _ = scene(
            "--seed", seed, "--height", camera, "--pitch", pitch, "--fov", fov, "--balls", 1,
            "--cones", 0, "--samples", "1", "--size", "200x150")
        ball = objects[0]
        equal((ball["kind"], ball["class"]), ("ball", 0))
        radius = ball["radius_mm"]
        centre = (ball["x_mm"], ball["y_mm"], radius - camera)
        square = sum(c * c for c in centre)
        covered = different = 0
        for x, y, d in rays(width, height, camera, pitch, fov):
            along = sum(a * b for a, b in zip(d, centre))
            inside = along > 0 and along ** 2 > (square - radius ** 2) * sum(a * a for a in d)
            covered += inside
            different += inside != (mask[y * width + x] == 1)
        true(covered > 30, "the ball of seed %d is in sight: %d" % (seed, covered))
        # directions have 16 fraction bits: a pixel that the edge just touches may fall either way
        equal(abs(covered - ball["area"]) <= 4 and different <= 4, True,
              "seed %d: %d covered, %d different, area %d" % (seed, covered, different,
                                                              ball["area"]))
        checked += 1
    equal(checked, 5)


def test_gain_and_cast_scale_the_channels():
    base = scene("--samples", "1")[2]
    for words, factors in ((["--gain", "0.5"], (0.5, 0.5, 0.5)), (["--gain", "3"], (3, 3, 3)),
                           (["--cast", "255,204,51"], (1, 0.8, 0.2))):
        got = scene("--samples", "1", *words)[2]
        for i, value in enumerate(base):
            wanted = min(255, value * factors[i % 3])
            true(abs(got[i] - wanted) <= 1 + factors[i % 3] / 2, "%r at %d" % (words, i))


def test_noise_is_the_stated_one():
    def fmix(h):
        h ^= h >> 16
        h = h * 0x85EBCA6B & 0xFFFFFFFF
        h ^= h >> 13
        h = h * 0xC2B2AE35 & 0xFFFFFFFF
        return h ^ h >> 16

    base = scene("--seed", "6", "--samples", "1")[2]
    got = scene("--seed", "6", "--samples", "1", "--noise", "5")[2]
    count, total, squares = 0, 0, 0
    for i in range(0, len(base), 7):
        if 40 < base[i] < 215:
            words = [fmix((6 ^ 0x6E015E) + 0x9E3779B9 * (3 * i + k + 1) & 0xFFFFFFFF)
                     for k in range(3)]
            noise = (sum(sum(word.to_bytes(4, "little")) for word in words) - 1530) * 5 / 256
            true(abs(got[i] - base[i] - noise) <= 1, "sample %d" % i)
            count, total, squares = count + 1, total + noise, squares + noise * noise
    true(count > 10000, "samples")
    true(abs(total / count) < 0.2 and abs(math.sqrt(squares / count) - 5) < 0.1,
         "mean and deviation")


def test_blur_is_a_box():
    width, height, base = scene("--samples", "1")[:3]
    got = scene("--samples", "1", "--blur", "2")[2]
    for y in range(0, height, 11):
        for x in range(0, width, 7):
            for c in range(3):
                mean = sum(base[3 * (width * min(max(y + j, 0), height - 1) +
                                     min(max(x + i, 0), width - 1)) + c]
                           for j in range(-2, 3) for i in range(-2, 3)) / 25
                true(abs(got[3 * (width * y + x) + c] - mean) <= 1.1, "at %d, %d" % (x, y))


def test_seeds_make_different_scenes():
    places = set()
    for seed in range(12):
        objects = scene("--seed", seed, "--size", "16x12", "--samples", "1")[4]
        places.add((objects[0]["x_mm"], objects[0]["y_mm"]))
    equal(len(places), 12)


if __name__ == "__main__":
    main(collect(globals()))
