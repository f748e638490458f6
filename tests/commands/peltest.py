"""What the tests of the command share: running it, reading its files, and counting checks.

Everything that judges the command is written down here once more, from the definitions and without
any of its code: colour conversion, class files, connected regions.
"""
import os
import shutil
import subprocess
import sys
import tempfile
import traceback

PEL = os.environ.get("PEL_COMMAND", "pel")
SOURCE = os.environ.get("PEL_SOURCE_DIR") or os.path.join(os.path.dirname(__file__), "..", "..")
DEMO = os.path.join(SOURCE, "tools", "demo")


class Result:
    def __init__(self, status, out, err):
        self.status = status
        self.out = out
        self.err = err.decode("utf-8", "replace")

    @property
    def text(self):
        return self.out.decode("utf-8")


def pel(*words, stdin=b"", cwd=None, stdout=subprocess.PIPE):
    done = subprocess.run([PEL, *map(str, words)], input=stdin, stdout=stdout,
                          stderr=subprocess.PIPE, cwd=cwd, timeout=120)
    return Result(done.returncode, done.stdout, done.stderr)


def equal(got, wanted, what=""):
    if got != wanted:
        raise AssertionError("%s: got %r, wanted %r" % (what, got, wanted))


def true(condition, what=""):
    if not condition:
        raise AssertionError(what)


def ok(*words, **options):
    """Runs the command, which must succeed without a word on standard error."""
    result = pel(*words, **options)
    equal((result.status, result.err), (0, ""), "pel " + " ".join(map(str, words)))
    return result


def refused(status, parts, *words, **options):
    """Runs the command, which must fail with this status and a message that has all the parts."""
    result = pel(*words, **options)
    what = "pel " + " ".join(map(str, words))
    equal(result.status, status, what + " said " + result.err)
    true(result.err.startswith("pel: "), what + ": message is " + repr(result.err))
    for part in parts:
        true(part in result.err, "%s: %r is not in %r" % (what, part, result.err))
    return result


def main(tests):
    """Runs the tests, each with a fresh folder as working directory; prints the closing line."""
    passed = failed = skipped = 0
    if shutil.which(PEL) is None:
        print("the command to test is not there: PEL_COMMAND=%s" % PEL)
        print("0 passed, 1 failed")
        sys.exit(1)
    for test in tests:
        folder = tempfile.mkdtemp(prefix="pel-test-")
        back = os.getcwd()
        os.chdir(folder)
        try:
            test()
            passed += 1
        except Skipped as reason:
            skipped += 1
            print("skipped %s: %s" % (test.__name__, reason))
        except Exception:  # a test that breaks is a test that failed
            failed += 1
            print("FAILED %s" % test.__name__)
            traceback.print_exc(limit=-2, file=sys.stdout)
        finally:
            os.chdir(back)
            shutil.rmtree(folder, ignore_errors=True)
    print("%d passed, %d failed" % (passed, failed) + (", %d skipped" % skipped if skipped else ""))
    sys.exit(1 if failed or not passed else 0)


class Skipped(Exception):
    """A test that cannot run here, and why."""


def collect(namespace):
    return [value for name, value in namespace.items() if name.startswith("test_")]


# ---- Pictures ---------------------------------------------------------------------------------


def parse_pnm(data):
    """(kind, width, height, pixels, comments) of the first binary picture, and what follows it."""
    words, comments, at = [], [], 0
    while len(words) < 4:
        if data[at:at + 1].isspace():
            at += 1
        elif data[at:at + 1] == b"#":
            end = data.index(b"\n", at)
            comments.append(data[at + 1:end].decode().strip())
            at = end + 1
        else:
            end = at
            while not data[end:end + 1].isspace():
                end += 1
            words.append(data[at:end])
            at = end
    at += 1
    width, height = int(words[1]), int(words[2])
    equal(words[3], b"255", "maxval")
    size = width * height * {b"P5": 1, b"P6": 3}[words[0]]
    pixels = data[at:at + size]
    equal(len(pixels), size, "bytes of pixels")
    return (words[0].decode(), width, height, pixels, comments), data[at + size:]


def read_pnm(path):
    with open(path, "rb") as file:
        picture, rest = parse_pnm(file.read())
    equal(rest, b"", "bytes behind the picture")
    return picture


def write(path, data):
    with open(path, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())
    return path


def ppm(width, height, pixels):
    return b"P6\n%d %d\n255\n" % (width, height) + bytes(pixels)


def paint(rows, colors):
    """A PPM drawn with letters: paint(["..o"], {"o": (255, 128, 0)}); unknown letters are black."""
    pixels = b"".join(bytes(colors.get(letter, (0, 0, 0))) for row in rows for letter in row)
    return ppm(len(rows[0]), len(rows), pixels)


# ---- Classes and colours ----------------------------------------------------------------------


def half_up(numerator, denominator):
    return (2 * numerator + denominator) // (2 * denominator)


def to_yuv(red, green, blue):
    """RGB to full-range YCbCr, BT.601 as JFIF has it, exactly rounded."""
    luma = 299 * red + 587 * green + 114 * blue
    u = half_up(128 * 1772 + 1000 * blue - luma, 1772)
    v = half_up(128 * 1402 + 1000 * red - luma, 1402)
    return (half_up(luma, 1000), min(255, u), min(255, v))


def read_classes(path):
    """[(name, ((y, y), (u, u), (v, v)))] of a class file."""
    names, boxes, part = [], [], None
    with open(path) as file:
        for line in file:
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            if line.startswith("["):
                part = line
            elif part == "[Colors]":
                names.append(line.split(")")[1].split()[2])
            else:
                pairs = line.strip("()").split(",")
                boxes.append(tuple(tuple(map(int, pair.split(":"))) for pair in pairs))
    equal(len(names), len(boxes), "names and boxes")
    return list(zip(names, boxes))


def classify(rgb, classes):
    """The labels of packed RGB pixels: class + 1 of the first class whose box has the colour; 0."""
    known = {}
    labels = bytearray(len(rgb) // 3)
    for i in range(len(labels)):
        color = bytes(rgb[3 * i:3 * i + 3])
        if color not in known:
            yuv = to_yuv(*color)
            known[color] = next((index + 1 for index, (_, box) in enumerate(classes)
                                 if all(low <= part <= high
                                        for part, (low, high) in zip(yuv, box))), 0)
        labels[i] = known[color]
    return bytes(labels)


# ---- Blobs ------------------------------------------------------------------------------------


def flood(labels, width, height, connectivity=8):
    """The connected regions, as lists of (x, y), in the order of their first pixels."""
    steps = [(1, 0), (-1, 0), (0, 1), (0, -1)]
    if connectivity == 8:
        steps += [(1, 1), (1, -1), (-1, 1), (-1, -1)]
    seen = bytearray(len(labels))
    regions = []
    for start, label in enumerate(labels):
        if label == 0 or seen[start]:
            continue
        seen[start] = 1
        region = [(start % width, start // width)]
        for x, y in region:  # grows while it is walked
            for dx, dy in steps:
                nx, ny = x + dx, y + dy
                at = ny * width + nx
                if 0 <= nx < width and 0 <= ny < height and labels[at] == label and not seen[at]:
                    seen[at] = 1
                    region.append((nx, ny))
        regions.append((label, region))
    return regions


CONTRACT = "frame,class,name,area,x0,y0,x1,y1,sum_x,sum_y"


def contract_rows(labels, width, height, names, frame=0, connectivity=8, min_area=1, limit=None):
    """The first ten columns of `pel blobs --csv` as tuples, in the order that is promised."""
    rows = []
    for label, region in flood(labels, width, height, connectivity):
        xs, ys = [p[0] for p in region], [p[1] for p in region]
        if len(region) >= min_area:
            rows.append((frame, label - 1, names[label - 1], len(region), min(xs), min(ys),
                         max(xs) + 1, max(ys) + 1, sum(xs), sum(ys)))
    rows.sort(key=lambda row: (-row[3], row[5], row[4]))
    return rows[:limit]


def parse_rows(text):
    """The first ten columns of `pel blobs --csv` as tuples of the same form."""
    lines = text.split("\n")
    true(lines[0].startswith(CONTRACT + ","), "header: " + lines[0])
    equal(lines.pop(), "", "what follows the last newline")
    rows = []
    for line in lines[1:]:
        words = line.split(",")
        equal(len(words), len(lines[0].split(",")), "columns of " + line)
        rows.append(tuple(word if i == 2 else int(word) for i, word in enumerate(words[:10])))
    return rows
