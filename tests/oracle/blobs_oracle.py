"""The blobs of `pel blobs` against OpenCV and SciPy, on photographs and on random pictures.

Everything from the RGB picture on is computed a second time with tools that are not ours: YCbCr by
exact integer fractions in NumPy, the class of a pixel by comparing it with the boxes, the regions
by OpenCV's connectedComponentsWithStats and by SciPy's ndimage.label. Areas, boxes and coordinate
sums must be equal, blob for blob, for 4 and for 8 neighbours.

Needs PEL_COMMAND (the built command) in the environment, and PEL_DATA_DIR for the pictures of
robots; without the latter those are skipped.
"""
import collections
import csv
import importlib.util
import io
import os
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy as np
import scipy.ndimage
from PIL import Image

COLUMNS = ["frame", "class", "name", "area", "x0", "y0", "x1", "y1", "sum_x", "sum_y"]

# What is compared of a blob, in this order.
Blob = collections.namedtuple("Blob", "class_index area x0 y0 x1 y1 sum_x sum_y")

# A class set: boxes (Y min, Y max, U min, U max, V min, V max) in the given colour range.
ClassSet = collections.namedtuple("ClassSet", "name range boxes")

CLASS_SETS = [
    ClassSet("six disjoint boxes", "full", [
        (30, 255, 0, 127, 150, 255), (30, 255, 128, 255, 150, 255), (30, 255, 140, 255, 0, 149),
        (30, 255, 0, 119, 0, 119), (30, 255, 0, 104, 120, 149), (30, 255, 120, 139, 0, 119)]),
    ClassSet("eight overlapping boxes", "full", [
        (100, 130, 0, 255, 0, 255), (0, 180, 0, 120, 100, 255), (60, 255, 110, 150, 110, 150),
        (0, 255, 130, 255, 0, 126), (200, 255, 0, 255, 0, 255), (0, 90, 100, 140, 120, 255),
        (0, 255, 0, 127, 0, 127), (0, 255, 0, 255, 0, 255)]),
    ClassSet("eight tiny boxes", "full", [
        (40, 44, 100, 140, 100, 140), (60, 63, 0, 255, 0, 255), (90, 94, 118, 124, 0, 255),
        (120, 123, 0, 255, 128, 136), (150, 152, 0, 255, 0, 255), (180, 183, 120, 128, 0, 255),
        (210, 214, 0, 255, 0, 255), (240, 255, 0, 127, 0, 255)]),
    ClassSet("five boxes of limited range", "limited", [
        (16, 60, 16, 240, 16, 240), (61, 120, 16, 124, 128, 240), (61, 235, 129, 240, 16, 127),
        (121, 180, 16, 128, 110, 150), (100, 235, 120, 136, 120, 136)]),
]

WHEEL_PICTURES = {
    "skimage": ["astronaut.png", "chelsea.png", "coffee.png", "coins.png", "color.png", "ihc.png",
                "rocket.jpg"],
    "sklearn": ["china.jpg", "flower.jpg"],
}
WHEEL_FOLDERS = {"skimage": "data", "sklearn": "datasets/images"}


class Tally:
    def __init__(self):
        self.passed = self.failed = self.skipped = 0

    def check(self, good, text):
        if good:
            self.passed += 1
        else:
            self.failed += 1
            print("FAIL " + text)

    def skip(self, text):
        self.skipped += 1
        print("skip " + text)

    def end(self):
        skipped = f", {self.skipped} skipped" if self.skipped else ""
        print(f"{self.passed} passed, {self.failed} failed{skipped}")
        return 1 if self.failed or not self.passed else 0


# ---- Pictures ---------------------------------------------------------------------------------


def write_picture(path, pixels):
    """A binary PPM, or a PGM for a picture of two dimensions."""
    kind = "P5" if pixels.ndim == 2 else "P6"
    height, width = pixels.shape[:2]
    path.write_bytes(f"{kind}\n{width} {height}\n255\n".encode() + pixels.tobytes())


def as_rgb(pixels):
    return pixels if pixels.ndim == 3 else np.repeat(pixels[:, :, None], 3, axis=2)


def read_picture(path):
    image = Image.open(path)
    gray = image.mode in ("1", "L")
    return np.ascontiguousarray(np.asarray(image.convert("L" if gray else "RGB")))


def robot_pictures(tally):
    folder = pathlib.Path(os.environ.get("PEL_DATA_DIR", ".")) / "robocup-msl"
    paths = sorted(folder.glob("*_304x400.ppm"))
    if not paths:
        tally.skip("pictures of robots: there is no robocup-msl in PEL_DATA_DIR")
        return []
    tally.check(len(paths) == 8, f"eight pictures of robots, not {len(paths)}")
    return [(path.stem, path, read_picture(path)) for path in paths]


def wheel_pictures(folder):
    found = []
    for package, names in WHEEL_PICTURES.items():
        root = pathlib.Path(importlib.util.find_spec(package).submodule_search_locations[0])
        for name in names:
            pixels = read_picture(root / WHEEL_FOLDERS[package] / name)
            ending = "pgm" if pixels.ndim == 2 else "ppm"
            path = folder / f"{package}-{name.rsplit('.', 1)[0]}.{ending}"
            write_picture(path, pixels)
            found.append((path.stem, path, pixels))
    return found


def random_pictures(folder, count):
    """Patches of a few colours, 1 x 1 to 67 x 35, from single pixels to large ones."""
    random = np.random.default_rng(20000731)
    found = []
    for i in range(count):
        width, height = (1 + random.integers(67), 1 + random.integers(35)) if i else (1, 1)
        palette = random.integers(0, 256, (random.integers(2, 9), 3), dtype=np.uint8)
        patch = 1 + i % 4
        pattern = random.integers(0, len(palette), (height // patch + 1, width // patch + 1))
        pixels = palette[pattern.repeat(patch, axis=0).repeat(patch, axis=1)[:height, :width]]
        path = folder / f"random-{i:03d}.ppm"
        write_picture(path, pixels)
        found.append((path.stem, path, pixels))
    return found


def random_boxes(seed):
    """Eight boxes that overlap and together hold most colours."""
    random = np.random.default_rng(seed)
    boxes = []
    for _ in range(8):
        ends = np.sort(random.integers(0, 256, (3, 2)), axis=1)
        ends[:, 0] //= 2
        boxes.append(tuple(int(end) for end in ends.flatten()))
    return ClassSet(f"random boxes {seed}", "full", boxes)


# ---- The definition ---------------------------------------------------------------------------


def rounded(numerator, denominator):
    """n / d to nearest, halves upward, limited to 0..255: floor((2 n + d) / (2 d))."""
    return np.clip((2 * numerator + denominator) // (2 * denominator), 0, 255)


def ycbcr(rgb, color_range):
    red, green, blue = (rgb[:, :, c].astype(np.int64) for c in range(3))
    luma = 299 * red + 587 * green + 114 * blue  # thousandths
    if color_range == "full":
        return (rounded(luma, 1000), rounded(128 * 1772 + 1000 * blue - luma, 1772),
                rounded(128 * 1402 + 1000 * red - luma, 1402))
    return (rounded(16 * 255000 + 219 * luma, 255000),
            rounded(128 * 1772 * 255 + 224 * (1000 * blue - luma), 1772 * 255),
            rounded(128 * 1402 * 255 + 224 * (1000 * red - luma), 1402 * 255))


def class_masks(rgb, class_set):
    """A mask per class; a pixel is in the first class whose box holds it."""
    y, u, v = ycbcr(rgb, class_set.range)
    taken = np.zeros(y.shape, bool)
    masks = []
    for y_min, y_max, u_min, u_max, v_min, v_max in class_set.boxes:
        mask = ((y >= y_min) & (y <= y_max) & (u >= u_min) & (u <= u_max) & (v >= v_min) &
                (v <= v_max) & ~taken)
        taken |= mask
        masks.append(mask)
    return masks


def sums_of_labels(labels, count):
    """Sums of x and of y of labels 1..count; every partial sum is far below 2^53, so exact."""
    rows, columns = np.nonzero(labels)
    label = labels[rows, columns]
    sum_x = np.bincount(label, weights=columns, minlength=count + 1)[1:].astype(np.int64)
    sum_y = np.bincount(label, weights=rows, minlength=count + 1)[1:].astype(np.int64)
    return sum_x, sum_y


def blobs_by_opencv(mask, class_index, connectivity):
    count, labels, stats, _ = cv2.connectedComponentsWithStats(
        mask.astype(np.uint8), connectivity=connectivity, ltype=cv2.CV_32S)
    sum_x, sum_y = sums_of_labels(labels, count - 1)
    stats = stats[1:].astype(np.int64)
    x0, y0 = stats[:, cv2.CC_STAT_LEFT], stats[:, cv2.CC_STAT_TOP]
    x1, y1 = x0 + stats[:, cv2.CC_STAT_WIDTH], y0 + stats[:, cv2.CC_STAT_HEIGHT]
    fields = (stats[:, cv2.CC_STAT_AREA], x0, y0, x1, y1, sum_x, sum_y)
    return [Blob(class_index, *row) for row in np.stack(fields, axis=1).tolist()]


def blobs_by_scipy(mask, class_index, connectivity):
    structure = scipy.ndimage.generate_binary_structure(2, 1 if connectivity == 4 else 2)
    labels, count = scipy.ndimage.label(mask, structure)
    area = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    sum_x, sum_y = sums_of_labels(labels, count)
    boxes = scipy.ndimage.find_objects(labels)
    return [Blob(class_index, int(area[i]), columns.start, rows.start, columns.stop, rows.stop,
                 int(sum_x[i]), int(sum_y[i])) for i, (rows, columns) in enumerate(boxes)]


# ---- The command ------------------------------------------------------------------------------


def write_classes(path, class_set):
    """CMVision's text format; the range is a comment line for CMVision."""
    lines = [f"#! range {class_set.range}", "[Colors]"]
    lines += [f"({30 * c + 9},{250 - 30 * c},{17 * c}) 0.0000 1 class{c}"
              for c in range(len(class_set.boxes))]
    lines += ["", "[Thresholds]"]
    lines += [f"({b[0]}:{b[1]}, {b[2]}:{b[3]}, {b[4]}:{b[5]})" for b in class_set.boxes]
    path.write_text("\n".join(lines) + "\n")


def run_blobs(class_file, connectivity, paths):
    """The rows of the table that the command prints, as lists of text, header first."""
    command = [os.environ["PEL_COMMAND"], "blobs", "-c", str(class_file), "--csv",
               "--connectivity", str(connectivity)] + [str(path) for path in paths]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode != 0:
        raise RuntimeError(f"exit status {done.returncode}: {done.stderr.strip()}")
    return list(csv.reader(io.StringIO(done.stdout)))


def blobs_of_frames(rows, count):
    """Blobs per frame, in the order in which they were printed."""
    frames = [[] for _ in range(count)]
    for row in rows:
        frames[int(row[0])].append(Blob(int(row[1]), *(int(field) for field in row[3:10])))
    return frames


def check_table(tally, rows, text):
    """The header, the names, and the order: by frame, then area downward, then y0, then x0."""
    header, rows = rows[0], rows[1:]
    keys = [(int(r[0]), -int(r[3]), int(r[5]), int(r[4])) for r in rows]
    tally.check(header[:10] == COLUMNS, f"{text}: the first ten columns are {header[:10]}")
    tally.check(all(len(r) == len(header) for r in rows), f"{text}: a row of another length")
    tally.check(all(r[2] == f"class{r[1]}" for r in rows), f"{text}: a name of another class")
    tally.check(keys == sorted(keys), f"{text}: rows out of order")


# ---- The comparison ---------------------------------------------------------------------------


def first_difference(ours, theirs):
    left, right = collections.Counter(ours), collections.Counter(theirs)
    return (f"{len(ours)} blobs against {len(theirs)}; only here {sorted(left - right)[:2]}, "
            f"only there {sorted(right - left)[:2]}")


def blobs_of_command(tally, class_set, connectivity, pictures, folder):
    """What the command finds: a list of blobs per picture, or None after a failed check."""
    text = f"{class_set.name}, {connectivity} neighbours"
    class_file = folder / "classes.txt"
    write_classes(class_file, class_set)
    try:
        rows = run_blobs(class_file, connectivity, [path for _, path, _ in pictures])
        check_table(tally, rows, text)
        return blobs_of_frames(rows[1:], len(pictures))
    except (RuntimeError, ValueError, IndexError, OSError) as error:
        tally.check(False, f"{text}: {error}")
        return None


def compare_picture(tally, text, ours, masks, connectivity):
    """Compares the blobs of a picture with those of both oracles; returns how many they found."""
    compared = 0
    ours = sorted(ours)
    for oracle, blobs_of in (("OpenCV", blobs_by_opencv), ("SciPy", blobs_by_scipy)):
        theirs = sorted(blob for c, mask in enumerate(masks)
                        for blob in blobs_of(mask, c, connectivity))
        tally.check(ours == theirs, f"{text}, {oracle}: "
                    + ("" if ours == theirs else first_difference(ours, theirs)))
        compared += len(theirs)
    return compared


def compare(tally, group, class_set, pictures, folder):
    """All blobs of all pictures with one set of classes, for 4 and for 8 neighbours.

    A gray file holds full-range Y, and mixing ranges is refused: only RGB can be converted.
    """
    pictures = [p for p in pictures if class_set.range == "full" or p[2].ndim == 3]
    masks = [class_masks(as_rgb(pixels), class_set) for _, _, pixels in pictures]
    for connectivity in (4, 8):
        frames = blobs_of_command(tally, class_set, connectivity, pictures, folder)
        text = f"{class_set.name}, {connectivity} neighbours"
        compared = 0
        for (name, _, _), ours, theirs in zip(pictures, frames or [], masks):
            compared += compare_picture(tally, f"{name}, {text}", ours, theirs, connectivity)
        tally.check(compared > 0, f"{group}, {text}: no blob was compared")
        print(f"{group}: {len(pictures)} pictures, {text}: {compared} blobs compared")


def compare_all(tally, group, pictures, class_sets, folder):
    for class_set in class_sets:
        compare(tally, group, class_set, pictures, folder)


def main():
    tally = Tally()
    if not os.path.exists(os.environ.get("PEL_COMMAND", "")):
        tally.check(False, "PEL_COMMAND does not name the built command")
        return tally.end()
    cv2.setNumThreads(1)  # other tests run at the same time
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        robots = robot_pictures(tally)
        if robots:
            compare_all(tally, "robots", robots, CLASS_SETS, folder)
        compare_all(tally, "photographs", wheel_pictures(folder), CLASS_SETS, folder)
        compare_all(tally, "random", random_pictures(folder, 200),
                    [random_boxes(seed) for seed in (1, 2, 3)], folder)
    return tally.end()


if __name__ == "__main__":
    sys.exit(main())
