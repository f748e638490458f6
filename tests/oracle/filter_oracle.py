"""The filters of the library against SciPy and OpenCV, pixel for pixel.

SciPy filters 64-bit integers; its sums are whole numbers far below 2^53 and therefore exact. It
has every border. OpenCV is asked for 16-bit or floating-point results of 8-bit pictures, in which
whole numbers of this size are exact too; it has every border but wrap. What then is rounded and
limited is done here in NumPy integers by the rule of pel/filter.h: halves upward.

Rounding of the others: OpenCV's GaussianBlur of 3x3 and 5x5 with sigma 0 adds half and shifts, the
same rule; a box of nine never meets a half. SciPy's minimum, maximum and median do not round.

Needs PEL_SHARED, the library as a shared one, and PEL_DATA_DIR for pictures of robots; without the
latter those are skipped.
"""
import os
import pathlib
import sys

import cv2
import numpy as np
import scipy.ndimage

SCIPY_MODES = {"replicate": "nearest", "symmetric": "reflect", "reflect101": "mirror",
               "wrap": "wrap", "constant": "constant"}
# Named kernels that have operators, and how these are called.
OPERATORS = {"gauss3": "filter_u8", "box3": "filter_u8", "binomial5": "filter_u8",
             "sobel_x": "filter_s16", "sobel_y": "filter_s16"}
CV_BORDERS = {"replicate": cv2.BORDER_REPLICATE, "symmetric": cv2.BORDER_REFLECT,
              "reflect101": cv2.BORDER_REFLECT_101, "constant": cv2.BORDER_CONSTANT}


class Tally:
    """Counts checks, and the images and pixels of each group."""

    def __init__(self):
        self.passed = self.failed = self.skipped = 0
        self.groups = {}

    def check(self, good, text):
        if good:
            self.passed += 1
        else:
            self.failed += 1
            if self.failed <= 20:
                print("FAIL " + text)

    def equal(self, group, ours, theirs, text):
        same = ours.shape == theirs.shape and bool((ours.astype(np.int64) == theirs).all())
        images, pixels = self.groups.get(group, (0, 0))
        self.groups[group] = (images + 1, pixels + ours.size)
        if not same and ours.shape == theirs.shape:
            y, x = np.argwhere(ours.astype(np.int64) != theirs)[0]
            text += f": row {y} column {x} is {ours[y, x]}, not {theirs[y, x]}"
        self.check(same, f"{group}: {text}")

    def skip(self, text):
        self.skipped += 1
        print("skip " + text)

    def end(self):
        for group, (images, pixels) in self.groups.items():
            print(f"{group}: {images} images, {pixels} pixels compared")
        skipped = f", {self.skipped} skipped" if self.skipped else ""
        print(f"{self.passed} passed, {self.failed} failed{skipped}")
        return 1 if self.failed or not self.passed else 0


# ---- The rules of pel/filter.h in NumPy -------------------------------------------------------


def scaled(sums, divisor=1, shift=0, bias=0, absolute=False):
    """Exactly rounded, halves upward: floor((2 sum + d) / 2 d)."""
    sums = np.abs(sums) if absolute else sums
    whole = max(divisor, 1) << shift
    return (2 * sums + whole) // (2 * whole) + bias


def as_u8(values):
    return np.clip(values, 0, 255)


def as_s16(values):
    return np.clip(values, -32768, 32767)


def whole(values):
    """Floating-point results that must be whole numbers, as integers."""
    integers = values.astype(np.int64)
    if not (integers == values).all():
        raise ArithmeticError("the oracle's result is no whole number")
    return integers


def root_below(squares):
    roots = np.sqrt(squares.astype(np.float64)).astype(np.int64)
    roots -= roots * roots > squares
    return roots + ((roots + 1) * (roots + 1) <= squares)


def nearest_direction(gx, gy):
    """No quotient of whole numbers lies halfway between two 256ths of a turn."""
    turns = np.arctan2(gy.astype(np.float64), gx.astype(np.float64)) / (2 * np.pi)
    return np.floor(turns * 256 + 0.5).astype(np.int64) & 255


# ---- Pictures ---------------------------------------------------------------------------------


def random_picture(random, height, width):
    style = random.integers(4)
    if style == 0:
        return random.integers(0, 256, (height, width), np.uint8)
    if style == 1:
        return (random.integers(0, 2, (height, width)) * 255).astype(np.uint8)
    if style == 2:
        return random.integers(0, 4, (height, width), np.uint8)
    ramp = np.add.outer(np.arange(height) * 7, np.arange(width) * 3)
    return (ramp + random.integers(0, 9, (height, width))).astype(np.uint8)


def random_pictures(random, count):
    """Sizes 1x1 to 5x5 first, then random ones to 67x35."""
    sizes = [(h, w) for h in range(1, 6) for w in range(1, 6)]
    for i in range(count):
        height, width = (sizes[i] if i < len(sizes)
                         else (int(random.integers(1, 36)), int(random.integers(1, 68))))
        yield random_picture(random, height, width)


def robot_pictures(tally):
    """Each channel of the pictures as a gray picture."""
    folder = pathlib.Path(os.environ.get("PEL_DATA_DIR", ".")) / "robocup-msl"
    paths = sorted(folder.glob("*_304x400.ppm"))
    if not paths:
        tally.skip("pictures of robots: there is no robocup-msl in PEL_DATA_DIR")
        return []
    tally.check(len(paths) == 8, f"eight pictures of robots, not {len(paths)}")
    return [np.ascontiguousarray(channel) for path in paths
            for channel in cv2.split(cv2.imread(str(path), cv2.IMREAD_COLOR))]


# ---- Sums ---------------------------------------------------------------------------------------


def scipy_sums(picture, taps, border, constant, convolve=False):
    """Of a valid border: the middle of any other."""
    radius = taps.shape[0] // 2
    run = scipy.ndimage.convolve if convolve else scipy.ndimage.correlate
    mode = SCIPY_MODES.get(border, "nearest")
    sums = run(picture.astype(np.int64), taps.astype(np.int64), mode=mode, cval=constant)
    return sums[radius:-radius, radius:-radius] if border == "valid" else sums


def random_kernel(random):
    side = int(random.choice([3, 5]))
    if random.integers(4) == 0:
        return random.choice(np.array([-128, 127], np.int64), (side, side))
    return random.integers(-128, 128, (side, side))


def random_scale(random):
    divisor = int(random.choice([0, 1, 2, 3, 9, 16, 25, 255, 32767, random.integers(32768)]))
    return {"divisor": divisor, "shift": int(random.choice([0, 0, 1, 4, 15])),
            "bias": int(random.choice([0, 0, 128, -32768, 32767, random.integers(-500, 500)])),
            "absolute": bool(random.integers(2))}


def compare_scipy(tally, pel, random, picture):
    """One random kernel with every border, as correlation and as convolution."""
    taps, scale = random_kernel(random), random_scale(random)
    constant = int(random.integers(256))
    ours = pel.kernel(taps, **scale)
    for border in pel.BORDERS:
        if border == "valid" and min(picture.shape) < taps.shape[0]:
            continue
        for convolve in (False, True):
            name = "convolve" if convolve else "correlate"
            made = pel.flipped(ours) if convolve else ours
            exact = scaled(scipy_sums(picture, taps, border, constant, convolve), **scale)
            text = f"{picture.shape} {border} {constant} {scale} {taps.tolist()}"
            tally.equal(f"SciPy {name}, 8 bits", pel.filter_u8(picture, "kernel", made, border,
                                                               constant), as_u8(exact), text)
            tally.equal(f"SciPy {name}, 16 bits", pel.filter_s16(picture, "kernel", made, border,
                                                                 constant), as_s16(exact), text)


def compare_filter2d(tally, pel, random, picture):
    """OpenCV fills a constant border with 0."""
    taps = random_kernel(random)
    small = taps // 16  # sums that 16 bits hold
    for border, flag in CV_BORDERS.items():
        text = f"{picture.shape} {border} {taps.tolist()}"
        floats = cv2.filter2D(picture, cv2.CV_32F, taps.astype(np.float32), borderType=flag)
        ours = pel.filter_s16(picture, "kernel", pel.kernel(taps, divisor=25), border)
        tally.equal("OpenCV filter2D, CV_32F", ours, as_s16(scaled(whole(floats), 25)), text)
        words = cv2.filter2D(picture, cv2.CV_16S, small.astype(np.float32), borderType=flag)
        ours = pel.filter_s16(picture, "kernel", pel.kernel(small), border)
        tally.equal("OpenCV filter2D, CV_16S", ours, words, text)


# ---- Named kernels and gradients ----------------------------------------------------------------


def opencv_named(picture, flag):
    """What OpenCV has under a name: the name here, its 16-bit result."""
    blur = {"borderType": flag}
    return {
        "sobel_x": cv2.Sobel(picture, cv2.CV_16S, 1, 0, ksize=3, **blur),
        "sobel_y": cv2.Sobel(picture, cv2.CV_16S, 0, 1, ksize=3, **blur),
        "scharr_x": cv2.Scharr(picture, cv2.CV_16S, 1, 0, **blur),
        "scharr_y": cv2.Scharr(picture, cv2.CV_16S, 0, 1, **blur),
        "laplacian": cv2.Laplacian(picture, cv2.CV_16S, ksize=1, **blur),
        "gauss3": cv2.GaussianBlur(picture, (3, 3), 0, **blur),
        "binomial5": cv2.GaussianBlur(picture, (5, 5), 0, **blur),
        "box3": cv2.blur(picture, (3, 3), **blur),
    }


def compare_opencv_named(tally, pel, picture):
    for border, flag in CV_BORDERS.items():
        for name, theirs in opencv_named(picture, flag).items():
            ours = pel.filter_s16(picture, "kernel", pel.named(name), border)
            tally.equal(f"OpenCV {name}", ours, theirs, f"{picture.shape} {border}")
            run = OPERATORS.get(name)
            if run:
                tally.equal(f"OpenCV {name}, by its operator",
                            getattr(pel, run)(picture, name, border=border), theirs,
                            f"{picture.shape} {border}")
        sums = cv2.boxFilter(picture, cv2.CV_16S, (3, 3), normalize=False, borderType=flag)
        ours = pel.filter_s16(picture, "kernel", pel.kernel(np.ones((3, 3), int)), border)
        tally.equal("OpenCV boxFilter, sums", ours, sums, f"{picture.shape} {border}")
        sums = cv2.boxFilter(picture, cv2.CV_32S, (5, 5), normalize=False, borderType=flag)
        ours = pel.filter_u8(picture, "kernel", pel.kernel(np.ones((5, 5), int), 25), border)
        tally.equal("OpenCV boxFilter 5x5, exact mean", ours, scaled(sums.astype(np.int64), 25),
                    f"{picture.shape} {border}")


def compare_gradients(tally, pel, picture):
    for border, mode in SCIPY_MODES.items():
        wide = picture.astype(np.int64)
        gx = scipy.ndimage.sobel(wide, axis=1, mode=mode)
        gy = scipy.ndimage.sobel(wide, axis=0, mode=mode)
        text = f"{picture.shape} {border}"
        expected = {"gradient_abs": np.abs(gx) + np.abs(gy), "gradient": root_below(gx**2 + gy**2)}
        for op, exact in expected.items():
            tally.equal(f"SciPy sobel, {op}", pel.filter_s16(picture, op, border=border), exact,
                        text)
            tally.equal(f"SciPy sobel, {op}", pel.filter_u8(picture, op, border=border),
                        as_u8(exact), text)
        tally.equal("SciPy sobel, direction", pel.filter_u8(picture, "direction", border=border),
                    nearest_direction(gx, gy), text)
        for name, exact in (("prewitt_x", scipy.ndimage.prewitt(wide, axis=1, mode=mode)),
                            ("prewitt_y", scipy.ndimage.prewitt(wide, axis=0, mode=mode)),
                            ("laplacian", scipy.ndimage.laplace(wide, mode=mode))):
            ours = pel.filter_s16(picture, "kernel", pel.named(name), border)
            tally.equal(f"SciPy {name}", ours, exact, text)


# ---- Ranks and morphology -----------------------------------------------------------------------


def compare_ranks(tally, pel, random, picture):
    constant = int(random.integers(256))
    for border, mode in SCIPY_MODES.items():
        for op, run in (("min", scipy.ndimage.minimum_filter),
                        ("max", scipy.ndimage.maximum_filter),
                        ("median", scipy.ndimage.median_filter)):
            theirs = run(picture.astype(np.int64), size=3, mode=mode, cval=constant)
            ours = pel.filter_u8(picture, op, border=border, constant=constant)
            tally.equal(f"SciPy {op}", ours, theirs, f"{picture.shape} {border} {constant}")
    tally.equal("OpenCV medianBlur", pel.filter_u8(picture, "median"), cv2.medianBlur(picture, 3),
                f"{picture.shape}")


def compare_morphology(tally, pel, random, picture):
    constant = int(random.integers(256))
    element = np.ones((3, 3), np.uint8)
    for border, flag in CV_BORDERS.items():
        around = {"borderType": flag, "borderValue": constant}
        text = f"{picture.shape} {border} {constant}"
        for op, run in (("min", cv2.erode), ("max", cv2.dilate)):
            tally.equal(f"OpenCV {run.__name__}",
                        pel.filter_u8(picture, op, border=border, constant=constant),
                        run(picture, element, **around), text)
        for name, flag_of, first, second in (("open", cv2.MORPH_OPEN, "min", "max"),
                                             ("close", cv2.MORPH_CLOSE, "max", "min")):
            tally.equal(f"OpenCV {name}", pel.twice(picture, first, second, border, constant),
                        cv2.morphologyEx(picture, flag_of, element, **around), text)


def neighbours(labels):
    """The nine labels around every pixel, the edge repeated, as a stack of pictures."""
    padded = np.pad(labels, 1, mode="edge").astype(np.int64)
    height, width = labels.shape
    return np.stack([padded[y:y + height, x:x + width] for y in range(3) for x in range(3)])


def compare_labels(tally, pel, picture):
    """Labels by counting, with SciPy's ranks for the extremes."""
    labels = (picture % 5).astype(np.uint8)
    around = neighbours(labels)
    counts = np.stack([(around == label).sum(axis=0) for label in range(5)])
    own = np.take_along_axis(counts, labels[None].astype(np.int64), axis=0)[0]
    most = np.where(own == counts.max(axis=0), labels, counts.argmax(axis=0))
    low = scipy.ndimage.minimum_filter(labels, size=3, mode="nearest").astype(np.int64)
    high = scipy.ndimage.maximum_filter(labels, size=3, mode="nearest")
    filled = np.where(around == 0, 99, around).min(axis=0) % 99
    text = f"{picture.shape}"
    tally.equal("majority", pel.filter_u8(labels, "majority"), most, text)
    tally.equal("erode_labels", pel.filter_u8(labels, "erode_labels"),
                np.where(low == high, low, 0), text)
    tally.equal("dilate_labels", pel.filter_u8(labels, "dilate_labels"),
                np.where(labels != 0, labels, filled), text)


# -------------------------------------------------------------------------------------------------


def compare_all(tally, pel, random, picture):
    compare_scipy(tally, pel, random, picture)
    compare_filter2d(tally, pel, random, picture)
    compare_opencv_named(tally, pel, picture)
    compare_gradients(tally, pel, picture)
    compare_ranks(tally, pel, random, picture)
    compare_morphology(tally, pel, random, picture)
    compare_labels(tally, pel, picture)


def main():
    tally = Tally()
    if not os.path.exists(os.environ.get("PEL_SHARED", "")):
        tally.check(False, "PEL_SHARED does not name the shared library")
        return tally.end()
    import pel_filter_lib as pel
    cv2.setNumThreads(1)  # other tests run at the same time
    random = np.random.default_rng(20240607)
    for picture in random_pictures(random, 250):
        compare_all(tally, pel, random, picture)
    for picture in robot_pictures(tally):
        compare_all(tally, pel, random, picture)
    return tally.end()


if __name__ == "__main__":
    sys.exit(main())
