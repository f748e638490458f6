"""pel/point.h against OpenCV, NumPy and exact fractions.

Equal to OpenCV byte for byte: LUT, add, subtract, absdiff, min, max, bitwise operations, integral,
adaptiveThreshold (mean), resize by INTER_AREA in two by two pixels. Where OpenCV computes in
floating point (equalizeHist, Otsu, INTER_AREA by other factors, INTER_NEAREST) the exact rational
result is what must come out, and OpenCV must agree wherever the exact number is not within its
rounding error of a half (or of another best threshold, or of a whole number); INTER_LINEAR must be
within 1. How often OpenCV differs is printed.
"""
import ctypes
import sys
from fractions import Fraction

import cv2
import numpy as np

from pel_ctypes import (ERR_ARG, ERR_ORDER, ERR_RANGE, OK, Tally, call, padded_like, random_pixels,
                        random_sizes, robot_pictures, view_of, BGR888)

U16 = ctypes.c_uint16
U8 = ctypes.c_uint8
COMBINE = {"add": cv2.add, "subtract": cv2.subtract, "absdiff": cv2.absdiff, "min": cv2.min,
           "max": cv2.max, "and": cv2.bitwise_and, "or": cv2.bitwise_or, "xor": cv2.bitwise_xor}
NEAREST, BOX, BILINEAR = 0, 1, 2


class Stats(ctypes.Structure):
    _fields_ = [("sum", ctypes.c_uint64), ("sum_squares", ctypes.c_uint64),
                ("count", ctypes.c_uint32), ("mean_q8", ctypes.c_uint32),
                ("variance_q8", ctypes.c_uint32), ("min", U8), ("max", U8)]


class Adaptive(ctypes.Structure):
    _fields_ = [("width", U16), ("height", U16), ("radius", U8), ("c", ctypes.c_int16),
                ("work", ctypes.c_void_p), ("work_bytes", ctypes.c_size_t)]


class Resize(ctypes.Structure):
    _fields_ = [("method", ctypes.c_int), ("channels", U8), ("width_in", U16), ("height_in", U16),
                ("width_out", U16), ("height_out", U16), ("work", ctypes.c_void_p),
                ("work_bytes", ctypes.c_size_t)]


class Sums(ctypes.Structure):
    _fields_ = [("sum", ctypes.c_uint64 * 3), ("count", ctypes.c_uint32)]


def half_up(value):
    """A Fraction rounded to nearest, halves upward."""
    return (2 * value.numerator + value.denominator) // (2 * value.denominator)


def limit(value):
    return max(0, min(255, value))


# ---- Tables ------------------------------------------------------------------------------------


def table_of(name, *arguments):
    table = np.zeros(256, np.uint8)
    return call("pel_table_" + name, *arguments, table), table


def check_gamma(tally):
    """Every exponent, by the definition in integers and by double precision where it is sure."""
    certain = 0
    for n in range(1, 33):
        for d in range(1, 33):
            status, table = table_of("gamma_exponent", n, d)
            good = status == OK
            for i, out in enumerate(int(v) for v in table):
                reach = 510 ** d * i ** n
                scale = 255 ** n
                good = good and (out == 0 or (2 * out - 1) ** d * scale <= reach)
                good = good and (out == 255 or reach < (2 * out + 1) ** d * scale)
            real = 255 * (np.arange(256) / 255) ** (n / d)
            sure = np.abs(real + 0.5 - np.round(real + 0.5)) > 1e-9
            certain += int(sure.sum())
            tally.check(good and (np.floor(real + 0.5) == table)[sure].all(), f"exponent {n}/{d}")
    print(f"gamma: 1024 tables, {certain} of 262144 values also by double precision")


def check_linear(tally, rng):
    for _ in range(400):
        divisor = int(rng.choice([1, 2, 10, 256, 1000, 1 << 20, int(rng.integers(1, 1 << 21))]))
        alpha = int(rng.integers(-4 * divisor, 4 * divisor + 1))
        alpha = max(-(1 << 21), min(1 << 21, alpha))
        beta = int(rng.integers(-300, 300)) * min(divisor, 1 << 20) + int(rng.integers(-9, 9))
        pivot = int(rng.integers(256))
        status, table = table_of("linear", alpha, beta, divisor)
        wanted = [limit(half_up(Fraction(i * alpha + beta, divisor))) for i in range(256)]
        tally.equal(table, wanted, f"linear {alpha} {beta} {divisor} (status {status})")
        status, table = table_of("contrast", alpha, divisor, pivot)
        wanted = [limit(pivot + half_up(Fraction((i - pivot) * alpha, divisor)))
                  for i in range(256)]
        tally.equal(table, wanted, f"contrast {alpha} {divisor} {pivot} (status {status})")


def check_simple_tables(tally):
    values = np.arange(256)
    tally.equal(table_of("invert")[1], 255 - values, "invert")
    for offset in (-32768, -255, -38, 0, 1, 38, 200, 255, 32767):
        tally.equal(table_of("brightness", ctypes.c_int16(offset))[1],
                    np.clip(values + offset, 0, 255), f"brightness {offset}")
    gray = np.arange(256, dtype=np.uint8)[None, :]
    for threshold in range(256):
        wanted = cv2.threshold(gray, threshold, 255, cv2.THRESH_BINARY)[1][0]
        tally.equal(table_of("threshold", U8(threshold))[1], wanted, f"threshold {threshold}")


def check_lut(tally, rng, name, pixels):
    table = rng.integers(0, 256, 256, np.uint8)
    wanted = cv2.LUT(pixels, table)
    out, rows = padded_like(pixels)
    status = call("pel_table_frame", table, view_of(pixels), view_of(out))
    tally.check(status == OK, f"{name}: table frame answers {status}")
    tally.equal(out, wanted, f"{name}: table frame")
    tally.check((rows[:, -5:] == 0xA5).all(), f"{name}: table frame writes beside its rows")
    inside = pixels.copy()
    call("pel_table_frame", table, view_of(inside), view_of(inside))
    tally.equal(inside, wanted, f"{name}: table frame in place")
    row = np.zeros_like(pixels[0])
    call("pel_table_row", table, np.ascontiguousarray(pixels[0]), U16(row.size), row)
    tally.equal(row, wanted[0], f"{name}: table row")


# ---- Histograms --------------------------------------------------------------------------------


def check_histogram(tally, name, pixels):
    """Counts one or three channels; returns the last one's histogram."""
    channels = 1 if pixels.ndim == 2 else 3
    for channel in range(channels):
        bins = np.full(256, 7, np.uint32)
        call("pel_histogram_frame", view_of(pixels), channel, bins)
        plane = pixels if channels == 1 else pixels[:, :, channel]
        wanted = cv2.calcHist([np.ascontiguousarray(plane)], [0], None, [256], [0, 256]).ravel()
        tally.equal(bins, wanted, f"{name}: histogram of channel {channel}")
        rows = np.zeros(256, np.uint32)
        for row in pixels:
            start = ctypes.c_void_p(row.ctypes.data + channel)
            call("pel_histogram_row", start, channels, U16(pixels.shape[1]), rows)
        tally.equal(rows, bins, f"{name}: histogram by rows")
    cumulative = np.zeros(256, np.uint32)
    call("pel_histogram_cumulative", bins, cumulative)
    tally.equal(cumulative, np.cumsum(bins), f"{name}: cumulative")
    return bins


def check_measure(tally, name, bins):
    counts = [int(b) for b in bins]
    n = sum(counts)
    total = sum(i * b for i, b in enumerate(counts))
    squares = sum(i * i * b for i, b in enumerate(counts))
    present = np.flatnonzero(bins)
    wanted = (total, squares, n, half_up(Fraction(256 * total, n)),
              half_up(256 * (Fraction(squares, n) - Fraction(total, n) ** 2)),
              int(present[0]), int(present[-1]))
    stats = Stats()
    status = call("pel_histogram_measure", bins, stats)
    found = tuple(getattr(stats, field) for field, _ in Stats._fields_)
    tally.check(status == OK and found == wanted, f"{name}: measure {found}, not {wanted}")


def check_percentiles(tally, name, bins, rng):
    if int(bins.sum()) > 200000:
        return
    values = np.repeat(np.arange(256), bins)
    for permille in [0, 1, 250, 500, 999, 1000] + [int(p) for p in rng.integers(0, 1001, 3)]:
        found = U8()
        call("pel_histogram_percentile", bins, U16(permille), ctypes.byref(found))
        rank = max(1, -(-permille * values.size // 1000))
        tally.check(found.value == values[rank - 1],
                    f"{name}: percentile {permille} is {found.value}, not {values[rank - 1]}")


def check_percentile_by_numpy(tally, rng):
    """NumPy's inverted_cdf is the same definition, for quantiles that binary fractions hold."""
    for _ in range(50):
        values = rng.integers(0, 256, int(rng.integers(1, 400)))
        bins = np.bincount(values, minlength=256).astype(np.uint32)
        for permille in (0, 125, 250, 500, 875, 1000):
            found = U8()
            call("pel_histogram_percentile", bins, U16(permille), ctypes.byref(found))
            wanted = np.quantile(values, permille / 1000, method="inverted_cdf")
            tally.check(found.value == wanted, f"quantile {permille} of {values.size} values")


def between_class_variances(bins):
    """{t: spread^2 / (n1 n2)} as fractions, of the thresholds that split."""
    counts = [int(b) for b in bins]
    n, total = sum(counts), sum(i * b for i, b in enumerate(counts))
    low = low_sum = 0
    found = {}
    for t, count in enumerate(counts):
        low += count
        low_sum += t * count
        if 0 < low < n:
            found[t] = Fraction((n * low_sum - low * total) ** 2, low * (n - low))
    return found


def check_otsu(tally, name, pixels, bins, differ):
    found = U8(99)
    status = call("pel_histogram_otsu", bins, ctypes.byref(found))
    variances = between_class_variances(bins)
    wanted = min((-v, t) for t, v in variances.items())[1] if variances else 0
    tally.check(status == OK and found.value == wanted,
                f"{name}: Otsu {found.value}, not {wanted}")
    theirs = int(cv2.threshold(pixels, 0, 255, cv2.THRESH_BINARY | cv2.THRESH_OTSU)[0])
    if theirs != wanted:
        differ["otsu"] += 1
        close = 1 - variances[theirs] / variances[wanted]
        tally.check(close < Fraction(1, 10 ** 12),
                    f"{name}: OpenCV's Otsu is {theirs}, not {wanted}")
    else:
        tally.check(True, "")


def check_equalize(tally, name, pixels, bins, differ):
    status, table = table_of("equalize", bins)
    present = np.flatnonzero(bins)
    first, n = int(present[0]), int(bins.sum())
    part = n - int(bins[first])
    cumulative = np.cumsum(bins.astype(object)) - int(bins[first])
    exact = [Fraction(255 * max(0, int(c)), part) for c in cumulative] if part else range(256)
    wanted = [half_up(Fraction(e)) for e in exact]
    tally.equal(table, wanted, f"{name}: equalize (status {status})")
    theirs = cv2.equalizeHist(pixels)
    for value in present:
        their = int(theirs[pixels == value][0])
        if their != wanted[value]:
            differ["equalize"] += 1
            off = abs(exact[value] - int(exact[value]) - Fraction(1, 2))
            tally.check(off < Fraction(1, 20000), f"{name}: equalizeHist of {value} is {their}, "
                        f"not {wanted[value]} ({float(exact[value])})")
        else:
            tally.check(True, "")


def check_statistics(tally, rng, name, pixels, differ):
    bins = check_histogram(tally, name, pixels)
    check_measure(tally, name, bins)
    check_percentiles(tally, name, bins, rng)
    if pixels.ndim == 2:
        check_otsu(tally, name, pixels, bins, differ)
        check_equalize(tally, name, pixels, bins, differ)


def check_large_histograms(tally, rng):
    """Up to 2^26 values, where the sums are at their bounds, and one more, which is refused."""
    most = 1 << 26
    for low, high, part in ((0, 255, most // 2), (0, 255, 1), (0, 255, most - 1),
                            (254, 255, most // 3), (255, 255, 0), (0, 0, 0), (7, 200, 12345678)):
        bins = np.zeros(256, np.uint32)
        bins[low] += part
        bins[high] += most - part
        name = f"{part} of {low}, rest {high}"
        check_measure(tally, name, bins)
        found = U8(99)
        call("pel_histogram_otsu", bins, ctypes.byref(found))
        tally.check(found.value == (low if low != high else 0), f"{name}: Otsu {found.value}")
        bins[3] += 1
        tally.check(call("pel_histogram_measure", bins, Stats()) == ERR_RANGE, f"{name}: too many")
    for _ in range(60):
        bins = rng.integers(0, most // 256, 256).astype(np.uint32)
        bins[rng.integers(0, 256, 200)] = 0
        check_measure(tally, "large", bins)
        found = U8()
        call("pel_histogram_otsu", bins, ctypes.byref(found))
        variances = between_class_variances(bins)
        wanted = min((-v, t) for t, v in variances.items())[1]
        tally.check(found.value == wanted, f"large: Otsu {found.value}, not {wanted}")


# ---- Two pictures ------------------------------------------------------------------------------


def check_combine(tally, rng, name, a):
    b = rng.permuted(a.ravel()).reshape(a.shape) if a.size else a
    b = np.where(rng.random(a.shape) < 0.1, rng.integers(0, 256, a.shape, np.uint8), b)
    for op, (text, theirs) in enumerate(COMBINE.items()):
        wanted = theirs(a, b)
        out, _ = padded_like(a)
        status = call("pel_combine_frame", op, view_of(a), view_of(b), view_of(out))
        tally.equal(out, wanted, f"{name}: {text} (status {status})")
        row = b[-1].copy()
        call("pel_combine_row", op, np.ascontiguousarray(a[-1]), row, U16(row.size), row)
        tally.equal(row, wanted[-1], f"{name}: {text} row in place")
    for alpha in (0, 1, 77, 128, 255, 256):
        mixed = (a.astype(int) * alpha + b.astype(int) * (256 - alpha) + 128) // 256
        out, _ = padded_like(a)
        call("pel_blend_frame", U16(alpha), view_of(a), view_of(b), view_of(out))
        tally.equal(out, mixed, f"{name}: blend {alpha}")


# ---- Integral ----------------------------------------------------------------------------------


def check_integral(tally, name, pixels):
    height, width = pixels.shape
    wanted = cv2.integral(pixels)
    sums = np.full((height + 1, width + 4), 0xDEADBEEF, np.uint32)
    status = call("pel_integral_frame", view_of(pixels), sums, ctypes.c_uint32(width + 4))
    tally.equal(sums[:, :width + 1], wanted, f"{name}: integral (status {status})")
    tally.check((sums[:, width + 1:] == 0xDEADBEEF).all(), f"{name}: integral beside its rows")
    row = np.zeros(width + 1, np.uint32)
    call("pel_integral_row", None, U16(width), None, row)
    good = (row == wanted[0]).all()
    for y in range(height):
        call("pel_integral_row", np.ascontiguousarray(pixels[y]), U16(width), row, row)
        good = good and (row == wanted[y + 1]).all()
    tally.check(good, f"{name}: integral in one row")


# ---- Adaptive threshold ------------------------------------------------------------------------


def stream(kind, config, state_bytes, rows, out_rows):
    """Pushes and pulls row by row; pulls as soon as it can, and checks that nothing else can."""
    state = np.zeros(state_bytes // 8, np.uint64)
    if call(f"pel_{kind}_begin", state, config) != OK:
        return False
    done = 0
    for row in rows:
        buffer = row.copy()
        if call(f"pel_{kind}_push", state, buffer) != OK:
            return False
        buffer[...] = 0xEE
        while done < len(out_rows) and call(f"pel_{kind}_pull", state, out_rows[done]) == OK:
            done += 1
    return (done == len(out_rows) and call(f"pel_{kind}_pull", state, out_rows[0]) == ERR_ORDER and
            call(f"pel_{kind}_push", state, rows[0]) == ERR_ORDER)


def check_adaptive(tally, rng, name, pixels, radii):
    height, width = pixels.shape
    for radius in radii:
        c = int(rng.choice([0, 1, -1, 7, -20, 255, -255]))
        wanted = cv2.adaptiveThreshold(pixels, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY,
                                       2 * radius + 1, c)
        config = Adaptive(width, height, radius, c)
        work = np.zeros(width * (2 * radius + 3) // 2 + 1, np.uint16)
        config.work, config.work_bytes = work.ctypes.data, width * (2 * radius + 3)
        out, rows = padded_like(pixels)
        status = call("pel_adaptive_frame", config, view_of(pixels), view_of(out))
        tally.equal(out, wanted, f"{name}: adaptive {radius} {c} (status {status})")
        tally.check((rows[:, -5:] == 0xA5).all(), f"{name}: adaptive beside its rows")
        inside = pixels.copy()
        call("pel_adaptive_frame", config, view_of(inside), view_of(inside))
        tally.equal(inside, wanted, f"{name}: adaptive {radius} in place")
        again = np.zeros_like(pixels)
        whole = stream("adaptive", config, 64, pixels, again)
        tally.check(whole and (again == wanted).all(), f"{name}: adaptive {radius} by rows")


# ---- Resize ------------------------------------------------------------------------------------


def places_exact(size_in, size_out):
    """Columns and weights of the formula in point.h, in fractions."""
    places = []
    for i in range(size_out):
        centre = (Fraction(2 * i + 1, 2)) * Fraction(size_in, size_out) - Fraction(1, 2)
        left = centre.numerator // centre.denominator
        weight = half_up(2048 * (centre - left))
        if centre < 0:
            left = weight = 0
        elif left >= size_in - 1:
            left, weight = size_in - 1, 0
        places.append((left, weight))
    return np.array([p[0] for p in places]), np.array([p[1] for p in places], np.int64)


def bilinear_exact(pixels, width, height):
    planes = pixels.astype(np.int64).reshape(pixels.shape[0], pixels.shape[1], -1)
    x, f = places_exact(pixels.shape[1], width)
    y, g = places_exact(pixels.shape[0], height)
    x1 = np.minimum(x + 1, pixels.shape[1] - 1)
    y1 = np.minimum(y + 1, pixels.shape[0] - 1)
    f, g = f[None, :, None], g[:, None, None]
    rows = planes[:, x] * (2048 - f) + planes[:, x1] * f
    mixed = rows[y] * (2048 - g) + rows[y1] * g
    return ((mixed + (1 << 21)) >> 22).reshape((height, width) + pixels.shape[2:])


def nearest_exact(pixels, width, height):
    rows = np.arange(height) * pixels.shape[0] // height
    columns = np.arange(width) * pixels.shape[1] // width
    return pixels[rows][:, columns]


def is_whole(size_in, size_out):
    """Where X * size_in / size_out is whole, so that OpenCV's product may come out below it."""
    return np.arange(size_out) * size_in % size_out == 0


def check_nearest_of_opencv(tally, text, pixels, theirs, out):
    wrong = theirs != out
    if wrong.ndim == 3:
        wrong = wrong.any(axis=2)
    height, width = wrong.shape
    excused = is_whole(pixels.shape[0], height)[:, None] | is_whole(pixels.shape[1], width)[None, :]
    tally.check(not (wrong & ~excused).any(), f"{text}: INTER_NEAREST differs")
    if pixels.shape[0] % height == pixels.shape[1] % width == 0:
        tally.check(not wrong.any(), f"{text}: INTER_NEAREST by whole factors differs")


def box_exact(pixels, width, height):
    fy, fx = pixels.shape[0] // height, pixels.shape[1] // width
    planes = pixels.astype(np.int64).reshape((height, fy, width, fx) + pixels.shape[2:])
    sums = planes.sum(axis=(1, 3))
    return (2 * sums + fx * fy) // (2 * fx * fy)


def resize(tally, name, method, pixels, width, height):
    """By frame and by rows, which must be equal; returns the result."""
    channels = 1 if pixels.ndim == 2 else 3
    shape = (height, width) + pixels.shape[2:]
    config = Resize(method, channels, pixels.shape[1], pixels.shape[0], width, height)
    bytes_needed = call("pel_resize_bytes", config)
    work = np.zeros(bytes_needed // 4 + 1, np.uint32)
    config.work, config.work_bytes = work.ctypes.data, bytes_needed
    out, rows = padded_like(np.zeros(shape, np.uint8))
    status = call("pel_resize_frame", config, view_of(pixels), view_of(out))
    tally.check(status == OK, f"{name}: resize answers {status}")
    tally.check((rows[:, -5:] == 0xA5).all(), f"{name}: resize beside its rows")
    again = np.zeros(shape, np.uint8)
    whole = stream("resize", config, 96, pixels, again)
    tally.check(whole and (again == out).all(), f"{name}: resize {method} by rows")
    return out


def check_resize(tally, rng, name, pixels, differ):
    sizes = [(int(rng.integers(1, 70)), int(rng.integers(1, 40))) for _ in range(3)]
    sizes.append((max(1, pixels.shape[1] // 2), max(1, pixels.shape[0] // 2)))
    for width, height in sizes + [pixels.shape[1::-1]]:
        text = f"{name} to {width}x{height}"
        out = resize(tally, text, NEAREST, pixels, width, height)
        tally.equal(out, nearest_exact(pixels, width, height), f"{text}: nearest")
        theirs = cv2.resize(pixels, (width, height), interpolation=cv2.INTER_NEAREST)
        check_nearest_of_opencv(tally, text, pixels, theirs, out)
        differ["nearest"] += int((theirs != out).sum())
        differ["nearest of"] += out.size
        out = resize(tally, text, BILINEAR, pixels, width, height)
        tally.equal(out, bilinear_exact(pixels, width, height), f"{text}: bilinear")
        theirs = cv2.resize(pixels, (width, height), interpolation=cv2.INTER_LINEAR)
        off = np.abs(theirs.astype(int) - out)
        tally.check(off.max() <= 1, f"{text}: bilinear is {off.max()} off OpenCV")
        differ["bilinear"] += int((off != 0).sum())
        differ["bilinear of"] += out.size


def check_box(tally, rng, name, pixels, differ):
    for _ in range(4):
        fx, fy = int(rng.integers(1, 8)), int(rng.integers(1, 8))
        width, height = pixels.shape[1] // fx, pixels.shape[0] // fy
        if width == 0 or height == 0:
            continue
        part = np.ascontiguousarray(pixels[:height * fy, :width * fx])
        text = f"{name} by {fx} x {fy}"
        out = resize(tally, text, BOX, part, width, height)
        tally.equal(out, box_exact(part, width, height), f"{text}: box")
        theirs = cv2.resize(part, (width, height), interpolation=cv2.INTER_AREA)
        wrong = theirs != out
        if fx == fy == 2:
            tally.check(not wrong.any(), f"{text}: INTER_AREA of four pixels")
            differ["box 2x2"] += out.size
        elif wrong.any():
            check_box_halves(tally, text, part, (width, height), wrong)
            differ["box"] += int(wrong.sum())
        differ["box of"] += out.size


def check_box_halves(tally, text, part, size, wrong):
    """OpenCV may only differ where the mean is a half."""
    width, height = size
    fy, fx = part.shape[0] // height, part.shape[1] // width
    sums = part.astype(np.int64).reshape((height, fy, width, fx) + part.shape[2:]).sum(axis=(1, 3))
    tally.check((2 * sums[wrong] % (2 * fx * fy) == fx * fy).all(), f"{text}: INTER_AREA differs")


# ---- White balance -----------------------------------------------------------------------------


def check_white_balance(tally, rng, name, pixels):
    total = [int(v) for v in pixels.reshape(-1, 3).astype(np.int64).sum(axis=0)]
    for form, order in ((None, [0, 1, 2]), (BGR888, [2, 1, 0])):
        sums = Sums()
        call("pel_rgb_sums_frame", view_of(pixels, form), sums)
        tally.check(list(sums.sum) == [total[c] for c in order], f"{name}: sums")
    call("pel_rgb_sums_frame", view_of(pixels), sums)
    for kind, target, times in (("gray_patch", total[1], 1), ("gray_world", sum(total), 3)):
        gains = np.zeros(3, np.uint16)
        status = call("pel_gains_" + kind, sums, gains)
        wanted = [half_up(Fraction(256 * target, times * t)) if t else 1 << 16 for t in total]
        if max(wanted) > 65535:
            tally.check(status == ERR_RANGE and not gains.any(), f"{name}: {kind} refuses")
        else:
            tally.equal(gains, wanted, f"{name}: {kind} (status {status})")
    gains = rng.integers(0, 1024, 3).astype(np.uint16)
    wanted = np.minimum((pixels.astype(int) * gains.astype(int) + 128) // 256, 255)
    out, rows = padded_like(pixels)
    call("pel_white_balance_frame", gains, view_of(pixels), view_of(out))
    tally.equal(out, wanted, f"{name}: white balance")
    tally.check((rows[:, -5:] == 0xA5).all(), f"{name}: white balance beside its rows")
    turned = pixels.copy()
    view = view_of(turned, BGR888)
    call("pel_white_balance_frame", np.ascontiguousarray(gains[::-1]), view, view)
    tally.equal(turned, wanted, f"{name}: white balance of BGR in place")


# ---- All of it ---------------------------------------------------------------------------------


def check_refusals(tally):
    pixels = np.zeros((4, 8), np.uint8)
    shifted = pixels.ravel()[1:29].reshape(4, 7)
    table = np.zeros(256, np.uint8)
    tally.check(call("pel_table_frame", table, view_of(pixels[:, :7]), view_of(pixels[:, 1:])) ==
                ERR_ARG, "overlap by one column is refused")
    tally.check(call("pel_table_frame", table, view_of(pixels[:, :4]),
                     view_of(pixels[:, 4:])) == OK, "parts side by side are none")
    tally.check(call("pel_table_frame", table, view_of(np.zeros_like(shifted)), view_of(shifted)) ==
                OK, "a good frame is not refused")


def check_gray(tally, rng, name, pixels, differ, radii):
    check_lut(tally, rng, name, pixels)
    check_statistics(tally, rng, name, pixels, differ)
    check_combine(tally, rng, name, pixels)
    check_integral(tally, name, pixels)
    check_adaptive(tally, rng, name, pixels, radii)
    check_resize(tally, rng, name, pixels, differ)
    check_box(tally, rng, name, pixels, differ)


def check_color(tally, rng, name, pixels, differ):
    check_lut(tally, rng, name, pixels)
    check_statistics(tally, rng, name, pixels, differ)
    check_combine(tally, rng, name, pixels)
    check_resize(tally, rng, name, pixels, differ)
    check_box(tally, rng, name, pixels, differ)
    check_white_balance(tally, rng, name, pixels)


def main():
    tally = Tally()
    rng = np.random.default_rng(20190606)
    differ = dict.fromkeys(["otsu", "equalize", "nearest", "nearest of", "bilinear", "bilinear of",
                            "box", "box 2x2", "box of"], 0)
    check_gamma(tally)
    check_linear(tally, rng)
    check_simple_tables(tally)
    check_percentile_by_numpy(tally, rng)
    check_large_histograms(tally, rng)
    check_refusals(tally)
    for width, height in random_sizes(rng, 120):
        name = f"{width}x{height}"
        radii = {1, 2, int(rng.integers(3, 30)), 127}
        check_gray(tally, rng, name, random_pixels(rng, width, height), differ, sorted(radii))
        check_color(tally, rng, name, random_pixels(rng, width, height, 3), differ)
    for name, pixels in robot_pictures(tally):
        gray = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)
        check_gray(tally, rng, name, gray, differ, [1, 7, 40])
        check_color(tally, rng, name, pixels, differ)
    print("values in which OpenCV differs: " + ", ".join(f"{k} {v}" for k, v in differ.items()))
    return tally.end()


if __name__ == "__main__":
    sys.exit(main())
