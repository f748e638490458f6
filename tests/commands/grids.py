"""What the tests of the image operations share: small pictures as lists of rows; what a filter, a
border and a structure tensor are, from their definitions."""
import math

from peltest import equal, half_up, read_pnm, write


def noise(width, height, seed, top=255):
    """Rows of values 0..top by a linear congruence."""
    state, rows = seed * 2654435761 % 2**31, []
    for _ in range(height):
        row = []
        for _ in range(width):
            state = (state * 1103515245 + 12345) % 2**31
            row.append((state >> 12) % (top + 1))
        rows.append(row)
    return rows


def write_gray(name, rows):
    return write(name, b"P5\n%d %d\n255\n" % (len(rows[0]), len(rows))
                 + bytes(value for row in rows for value in row))


def write_rgb(name, red, green, blue):
    pixels = bytearray()
    for y in range(len(red)):
        for x in range(len(red[0])):
            pixels += bytes((red[y][x], green[y][x], blue[y][x]))
    return write(name, b"P6\n%d %d\n255\n" % (len(red[0]), len(red)) + bytes(pixels))


def cut(values, width):
    return [list(values[i:i + width]) for i in range(0, len(values), width)]


def read_gray(name):
    kind, width, _, pixels, _ = read_pnm(name)
    equal(kind, "P5", name)
    return cut(pixels, width)


def read_rgb(name):
    kind, width, _, pixels, _ = read_pnm(name)
    equal(kind, "P6", name)
    return [cut(pixels[i::3], width) for i in range(3)]


def luma(red, green, blue):
    return [[half_up(299 * r + 587 * g + 114 * b, 1000) for r, g, b in zip(*rows)]
            for rows in zip(red, green, blue)]


def clamp(value, low=0, high=255):
    return max(low, min(high, value))


# ---- Neighbourhoods ---------------------------------------------------------------------------


def place(i, length, border):
    """Which pixel stands for the one at i; None for a constant."""
    if 0 <= i < length:
        return i
    if border == "replicate":
        return clamp(i, 0, length - 1)
    if border == "wrap":
        return i % length
    if border in ("symmetric", "reflect101"):
        line = list(range(length))
        turn = line + line[::-1] if border == "symmetric" else line + line[-2:0:-1]
        return turn[i % len(turn)]
    return None


def window(rows, x, y, radius, border, constant=0):
    """The pixels around (x, y), row by row."""
    found = []
    for j in range(y - radius, y + radius + 1):
        for i in range(x - radius, x + radius + 1):
            at, line = place(i, len(rows[0]), border), place(j, len(rows), border)
            found.append(constant if at is None or line is None else rows[line][at])
    return found


def neighbourhoods(rows, radius, border, compute, constant=0):
    """compute(window) for every pixel; for "valid" only where all neighbours are inside."""
    less = radius if border == "valid" else 0
    return [[compute(window(rows, x, y, radius, border, constant))
             for x in range(less, len(rows[0]) - less)] for y in range(less, len(rows) - less)]


def correlate(rows, taps, border="replicate", constant=0):
    radius = 1 if len(taps) == 9 else 2
    return neighbourhoods(rows, radius, border,
                          lambda seen: sum(a * b for a, b in zip(seen, taps)), constant)


SOBEL_X = [-1, 0, 1, -2, 0, 2, -1, 0, 1]
SOBEL_Y = [-1, -2, -1, 0, 0, 0, 1, 2, 1]


def each(function, *grids):
    """The function of values at the same place."""
    return [[function(*values) for values in zip(*rows)] for rows in zip(*grids)]


def root(value):
    return math.isqrt(value)
