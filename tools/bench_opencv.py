"""OpenCV's side of `pel bench`, which holds this text and runs it: the same jobs, timed here.

Requests come line by line on standard input, answers go to standard output:

    picture WIDTH HEIGHT BOXES FRAMES
                       and the bytes of 6 * BOXES box sides, the YUYV and the RGB picture, of which
                       FRAMES copies are made: answered by "ok"
    prepare JOB        "result BYTES" and those bytes, or "none" if there is no such job
    run REPEAT COUNT   COUNT times in a line, nanoseconds of REPEAT runs of that job, each of which
                       reads the next copy
"""
import itertools
import os
import sys
import time

answers = os.fdopen(os.dup(1), "wb")
os.dup2(2, 1)  # whatever a library prints is no answer


def answer(line, data=b""):
    answers.write(line.encode() + b"\n" + data)
    answers.flush()


try:
    import cv2
    import numpy as np
except ImportError as missing:
    answer("missing %s" % missing)
    sys.exit(0)

cv2.setNumThreads(1)
EDGE = cv2.BORDER_REPLICATE
BOX3 = np.ones((3, 3), np.uint8)
SHARPEN = (np.array([[-1, -1, -1], [-1, 17, -1], [-1, -1, -1]]) / 9).astype(np.float32)
LAPLACIAN = np.array([[0, 1, 0], [1, -4, 1], [0, 1, 0]], np.float32)
GAUSS5 = (np.array([[1, 3, 6, 3, 1], [3, 15, 25, 15, 3], [6, 25, 44, 25, 6], [3, 15, 25, 15, 3],
                    [1, 3, 6, 3, 1]]) / 256).astype(np.float32)
GAMMA = np.floor(255 * (np.arange(256) / 255) ** 0.5 + 0.5).astype(np.uint8)
HARRIS_K = 1311 / 32768
AREA_MIN = 20


class Frame:
    """A copy of the picture."""
    def __init__(self, width, height, yuyv, rgb):
        self.yuyv = yuyv.copy().reshape(height, width, 2)
        self.pairs = self.yuyv.reshape(height, width // 2, 4)
        self.rgb = rgb.copy().reshape(height, width, 3)
        self.gray = np.ascontiguousarray(self.yuyv[..., 0])
        self.turned = np.ascontiguousarray(self.gray[::-1, ::-1])


class Picture:
    def __init__(self, width, height, boxes, frames):
        self.boxes, self.width, self.height, self.frames = boxes, width, height, frames

    def like(self, dtype=np.uint8, channels=None):
        shape = (self.height, self.width) + ((channels,) if channels else ())
        return np.empty(shape, dtype)


# ---- Jobs: each takes a picture and gives a function that takes one of its frames, runs and
# returns the result ---------------------------------------------------------------------------


def to_yuv444(p):
    """Three planes, each chroma value twice."""
    half = [np.empty((p.height, p.width // 2), np.uint8) for _ in range(2)]
    y, u, v = p.like(), p.like(), p.like()
    size = (p.width, p.height)

    def run(f):
        cv2.extractChannel(f.yuyv, 0, y)
        cv2.extractChannel(f.pairs, 1, half[0])
        cv2.extractChannel(f.pairs, 3, half[1])
        cv2.resize(half[0], size, u, interpolation=cv2.INTER_NEAREST)
        cv2.resize(half[1], size, v, interpolation=cv2.INTER_NEAREST)
        return y, u, v
    return run


def masks(p, use):
    """Calls `use` with the number and the mask of each class."""
    planes, yuv, mask = to_yuv444(p), p.like(channels=3), p.like()
    bounds = [tuple(tuple(map(int, box[i::2])) for i in range(2)) for box in p.boxes]

    def run(f):
        cv2.merge(planes(f), yuv)
        return [use(number, cv2.inRange(yuv, low, high, mask))
                for number, (low, high) in enumerate(bounds)]
    return run


def classify(p):
    labels = p.like()
    values = [p.like() for _ in p.boxes]
    for number, value in enumerate(values):
        value.fill(number + 1)
    paint = masks(p, lambda number, mask: cv2.copyTo(values[number], mask, labels))

    def run(f):
        labels.fill(0)
        paint(f)
        return labels
    return run


def blobs(p):
    """Small ones are left out and the rest is sorted in `finish`, which is not timed."""
    places = [p.like(np.int32) for _ in p.boxes]
    return masks(p, lambda number, mask: cv2.connectedComponentsWithStats(
        mask, places[number], connectivity=4))


def finish_blobs(classes):
    rows = []
    for number, (_, _, stats, centres) in enumerate(classes):
        stats, centres = stats[1:].astype(np.int64), centres[1:]
        keep = stats[:, cv2.CC_STAT_AREA] >= AREA_MIN
        stats, centres = stats[keep], centres[keep]
        x, y, width, height, area = stats.T
        sums = np.rint(centres * area[:, None]).astype(np.int64)
        rows.append(np.stack([np.full_like(area, number), area, x, y, x + width, y + height,
                              sums[:, 0], sums[:, 1]], axis=1))
    rows = np.concatenate(rows)
    order = np.lexsort((rows[:, 7], rows[:, 6], rows[:, 0], rows[:, 2], rows[:, 3], -rows[:, 1]))
    return rows[order]


def sobel(p, depth, dx, dy):
    out = p.like(np.int16 if depth == cv2.CV_16S else np.float32)
    return lambda f: cv2.Sobel(f.gray, depth, dx, dy, out, 3, borderType=EDGE)


def gradient_abs(p):
    across, down = sobel(p, cv2.CV_16S, 1, 0), sobel(p, cv2.CV_16S, 0, 1)
    a, b, out = p.like(), p.like(), p.like()
    return lambda f: cv2.add(cv2.convertScaleAbs(across(f), a), cv2.convertScaleAbs(down(f), b),
                             out)


def of_gradient(function, scale):
    def prepare(p):
        across, down = sobel(p, cv2.CV_32F, 1, 0), sobel(p, cv2.CV_32F, 0, 1)
        wide, out = p.like(np.float32), p.like()
        return lambda f: cv2.convertScaleAbs(function(across(f), down(f), wide), out, scale)
    return prepare


def direction(gx, gy, out):
    return cv2.phase(gx, gy, out, True)


def filter2d(kernel, depth=-1):
    def prepare(p):
        out = p.like(np.uint8 if depth == -1 else np.int16)
        return lambda f: cv2.filter2D(f.gray, depth, kernel, out, borderType=EDGE)
    return prepare


def gray_to_gray(function):
    def prepare(p):
        out = p.like()
        return lambda f: function(f.gray, out)
    return prepare


def two(function):
    def prepare(p):
        out = p.like()
        return lambda f: function(f.gray, f.turned, out)
    return prepare


def color(source, code):
    def prepare(p):
        out = p.like(channels=3)
        return lambda f: cv2.cvtColor(getattr(f, source), code, out)
    return prepare


def two_steps(first, second):
    def prepare(p):
        between, out = p.like(), p.like()
        return lambda f: second(first(f.gray, BOX3, between, borderType=EDGE), BOX3, out,
                                borderType=EDGE)
    return prepare


def resize(method, numerator, denominator):
    def prepare(p):
        size = tuple(side * numerator // denominator for side in (p.width, p.height))
        out = np.empty(size[::-1], np.uint8)
        return lambda f: cv2.resize(f.gray, size, out, interpolation=method)
    return prepare


def integral(p):
    out = np.empty((p.height + 1, p.width + 1), np.int32)
    return lambda f: cv2.integral(f.gray, out)


def harris(p):
    out = p.like(np.float32)
    return lambda f: cv2.cornerHarris(f.gray, 3, 3, HARRIS_K, out, EDGE)


def shi_tomasi(p):
    out = p.like(np.float32)
    return lambda f: cv2.cornerMinEigenVal(f.gray, 3, out, 3, EDGE)


# OpenCV's gradients are ours / (4 * 3 * 255); Harris responses are in units of 2^14.
UNIT = 1 / (4 * 3 * 255)

# job: what prepares it, and what brings its result into our form, not timed.
JOBS = {
    "blobs": (blobs, finish_blobs),
    "blobs-all": (blobs, finish_blobs),
    "classify": (classify, None),
    "planes": (to_yuv444, np.stack),
    "rgb": (color("yuyv", cv2.COLOR_YUV2RGB_YUY2), None),
    "ycbcr": (color("rgb", cv2.COLOR_RGB2YCrCb), lambda out: out[..., [0, 2, 1]]),
    "hsv": (color("rgb", cv2.COLOR_RGB2HSV_FULL), None),
    "gauss3": (gray_to_gray(lambda g, out: cv2.GaussianBlur(g, (3, 3), 0, out, borderType=EDGE)),
               None),
    "box3": (gray_to_gray(lambda g, out: cv2.blur(g, (3, 3), out, borderType=EDGE)), None),
    "binomial5": (gray_to_gray(lambda g, out: cv2.GaussianBlur(g, (5, 5), 0, out,
                                                               borderType=EDGE)), None),
    "sobel-x": (lambda p: sobel(p, cv2.CV_16S, 1, 0), None),
    "sobel-y": (lambda p: sobel(p, cv2.CV_16S, 0, 1), None),
    "gradient-abs": (gradient_abs, None),
    "gradient": (of_gradient(cv2.magnitude, 1), None),
    "direction": (of_gradient(direction, 256 / 360), None),
    "kernel3": (filter2d(SHARPEN), None),
    "kernel3-s16": (filter2d(LAPLACIAN, cv2.CV_16S), None),
    "kernel5": (filter2d(GAUSS5), None),
    "median": (gray_to_gray(lambda g, out: cv2.medianBlur(g, 3, out)), None),
    "min": (gray_to_gray(lambda g, out: cv2.erode(g, BOX3, out, borderType=EDGE)), None),
    "max": (gray_to_gray(lambda g, out: cv2.dilate(g, BOX3, out, borderType=EDGE)), None),
    "open": (two_steps(cv2.erode, cv2.dilate), None),
    "close": (two_steps(cv2.dilate, cv2.erode), None),
    "threshold": (gray_to_gray(lambda g, out: cv2.threshold(g, 127, 255, cv2.THRESH_BINARY,
                                                            out)[1]), None),
    "table": (gray_to_gray(lambda g, out: cv2.LUT(g, GAMMA, out)), None),
    "histogram": (lambda p: lambda f: cv2.calcHist([f.gray], [0], None, [256], [0, 256]),
                  lambda counts: counts.astype(np.uint32)),
    "equalize": (gray_to_gray(cv2.equalizeHist), None),
    "adaptive": (gray_to_gray(lambda g, out: cv2.adaptiveThreshold(
        g, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY, 15, 5, out)), None),
    "integral": (integral, None),
    "add": (two(cv2.add), None),
    "subtract": (two(cv2.subtract), None),
    "absdiff": (two(cv2.absdiff), None),
    "smaller": (two(cv2.min), None),
    "larger": (two(cv2.max), None),
    "and": (two(cv2.bitwise_and), None),
    "or": (two(cv2.bitwise_or), None),
    "xor": (two(cv2.bitwise_xor), None),
    "blend": (two(lambda a, b, out: cv2.addWeighted(a, 0.25, b, 0.75, 0, out)), None),
    "resize": (resize(cv2.INTER_LINEAR, 5, 8), None),
    "resize-box": (resize(cv2.INTER_AREA, 1, 2), None),
    "resize-nearest": (resize(cv2.INTER_NEAREST, 5, 8), None),
    "harris": (harris, lambda out: (out / (UNIT ** 4 * 2 ** 14)).astype(np.float32)),
    "shi-tomasi": (shi_tomasi, lambda out: (out / UNIT ** 2).astype(np.float32)),
    "canny": (gray_to_gray(lambda g, out: cv2.Canny(g, 100, 200, out)), None),
}


# ---- Requests --------------------------------------------------------------------------------


def read_bytes(count):
    return np.frombuffer(sys.stdin.buffer.read(count), np.uint8)


def read_picture(width, height, count, frames):
    boxes = read_bytes(6 * count).reshape(count, 6)
    yuyv, rgb = read_bytes(2 * width * height), read_bytes(3 * width * height)
    picture = Picture(width, height, boxes,
                      [Frame(width, height, yuyv, rgb) for _ in range(frames)])
    answer("ok")
    return picture


def prepare(picture, name):
    if name not in JOBS:
        answer("none")
        return None
    start, finish = JOBS[name]
    run = start(picture)
    result = run(picture.frames[0])
    data = np.ascontiguousarray(finish(result) if finish else result).tobytes()
    answer("result %d" % len(data), data)
    return run


def measure(run, turns, repeat, count):
    clock = time.process_time_ns  # with all of its threads, without other processes
    times = []
    for _ in range(count):
        start = clock()
        for frame in itertools.islice(turns, repeat):
            run(frame)
        times.append(clock() - start)
    answer(" ".join(map(str, times)))


def main():
    answer("opencv %s" % cv2.__version__)
    picture = run = turns = None
    for line in iter(sys.stdin.buffer.readline, b""):
        word, *more = line.decode().split()
        if word == "picture":
            picture = read_picture(*map(int, more))
        elif word == "prepare":
            run, turns = prepare(picture, *more), itertools.cycle(picture.frames)
        else:
            measure(run, turns, *map(int, more))


main()
