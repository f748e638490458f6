"""The shipped picture: the renderer makes it again byte for byte, and what the command finds in it
is what a flood fill over its pixels finds."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "commands"))

from peltest import (DEMO, classify, collect, contract_rows, equal, main, ok,  # noqa: E402
                     parse_pnm, parse_rows, read_classes, read_pnm, true)

PICTURE = os.path.join(DEMO, "robot.ppm")
CLASSES = os.path.join(DEMO, "robot.classes")


def demo_options():
    words = " ".join(read_pnm(PICTURE)[4]).split()
    equal(words[:2], ["pel", "scene"], "the comment of the picture")
    return words[2:]


def test_the_picture_is_made_again_byte_for_byte():
    true(os.path.getsize(PICTURE) <= 240 * 1024, "size")
    ok("scene", *demo_options(), "-o", "again.ppm")
    with open(PICTURE, "rb") as one, open("again.ppm", "rb") as two:
        true(one.read() == two.read(), "robot.ppm and what its comment renders")


def test_the_shipped_classes_are_those_of_the_renderer():
    ok("scene", "--size", "8x6", "--classes", "scene.classes")
    equal(read_classes(CLASSES), read_classes("scene.classes")[:4])


def test_blobs_are_those_of_a_flood_fill():
    classes = read_classes(CLASSES)
    _, width, height, pixels, _ = read_pnm(PICTURE)
    labels = classify(pixels, classes)
    names = [name for name, _ in classes]
    for words, limits in (([], {}), (["--connectivity", "4"], {"connectivity": 4}),
                          (["--min-area", "20"], {"min_area": 20}),
                          (["--min-area", "20", "--max", "3"], {"min_area": 20, "limit": 3})):
        rows = parse_rows(ok("blobs", "-c", CLASSES, "--csv", *words, PICTURE).text)
        equal(rows, contract_rows(labels, width, height, names, **limits), " ".join(words))


def test_what_is_found_is_what_stands_there():
    """Ten things are in sight, and each is found where the mask has it, but for its mixed edge."""
    ok("scene", *demo_options(), "--mask", "mask.pgm")
    _, width, height, labels, _ = read_pnm("mask.pgm")
    labels = bytes(label if label <= 4 else 0 for label in labels)
    names = [name for name, _ in read_classes(CLASSES)]
    truth = contract_rows(labels, width, height, names, min_area=20)
    found = parse_rows(ok("blobs", "-c", CLASSES, "--csv", "--min-area", "20", PICTURE).text)
    equal(len(truth), 10, "things")
    equal(len(found), 10, "blobs")
    for thing in truth:
        same = [blob for blob in found if blob[1] == thing[1] and
                all(abs(blob[i] - thing[i]) <= 2 for i in (4, 5, 6, 7))]
        equal(len(same), 1, "blobs at %r" % (thing,))
        true(abs(same[0][3] - thing[3]) <= thing[3] // 8, "area of %r: %r" % (thing, same[0]))


def test_the_annotated_picture_is_what_the_command_draws():
    ok("blobs", "-c", CLASSES, "--min-area", "20", "-o", "drawn.ppm", PICTURE)
    shown = ok("convert", os.path.join(DEMO, "annotated.png"), "-").out
    with open("drawn.ppm", "rb") as file:
        true(parse_pnm(file.read())[0][:4] == parse_pnm(shown)[0][:4], "annotated.png")


if __name__ == "__main__":
    main(collect(globals()))
