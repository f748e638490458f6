"""The library called from Python, for the oracles: views over NumPy arrays, pictures, a tally.

PEL_SHARED is the path of pel as a shared library; PEL_DATA_DIR the folder with the pictures of
robots, which are skipped where there are none.
"""
import ctypes
import os
import pathlib

import numpy as np
from PIL import Image

LIBRARY = ctypes.CDLL(os.environ["PEL_SHARED"])

OK, TRUNCATED = 0, 1
ERR_ARG, ERR_FORMAT, ERR_SPACE, ERR_RANGE, ERR_ORDER = -1, -2, -3, -4, -5

GRAY8 = 0
RGB888 = 9
BGR888 = 10


class View(ctypes.Structure):
    """pel_view and pel_cview, which have the same layout."""
    _fields_ = [("plane", ctypes.c_void_p * 3), ("stride_bytes", ctypes.c_int32 * 3),
                ("width", ctypes.c_uint16), ("height", ctypes.c_uint16),
                ("format", ctypes.c_int), ("range", ctypes.c_int)]


def pointer(array):
    """The address of an array's first element, which the caller keeps alive."""
    return ctypes.c_void_p(array.ctypes.data)


def view_of(pixels, pixel_format=None):
    """A view of a uint8 array of shape (h, w) or (h, w, 3), whatever the distance of its rows."""
    assert pixels.dtype == np.uint8 and pixels.strides[1] == (1 if pixels.ndim == 2 else 3)
    if pixel_format is None:
        pixel_format = GRAY8 if pixels.ndim == 2 else RGB888
    view = View()
    view.plane[0] = pixels.ctypes.data
    view.stride_bytes[0] = pixels.strides[0]
    view.height, view.width = pixels.shape[:2]
    view.format = pixel_format
    return view


def padded_like(pixels, padding=5, fill=0xA5):
    """An array of the same shape in wider rows, and those rows, to see that the padding lasts."""
    height, width = pixels.shape[:2]
    channels = 1 if pixels.ndim == 2 else 3
    rows = np.full((height, width * channels + padding), fill, np.uint8)
    inside = rows[:, :width * channels]
    if channels == 3:
        inside = np.lib.stride_tricks.as_strided(rows, (height, width, 3), (rows.strides[0], 3, 1))
    return inside, rows


def call(name, *arguments):
    """Calls a function by name; arrays and structures are passed by address."""
    def convert(argument):
        if isinstance(argument, np.ndarray):
            return pointer(argument)
        if isinstance(argument, ctypes.Structure):
            return ctypes.byref(argument)
        return argument
    return getattr(LIBRARY, name)(*[convert(a) for a in arguments])


class Tally:
    def __init__(self):
        self.passed = self.failed = self.skipped = 0

    def check(self, good, text):
        if good:
            self.passed += 1
        else:
            self.failed += 1
            if self.failed <= 40:
                print("FAIL " + text)

    def equal(self, found, wanted, text):
        found, wanted = np.asarray(found), np.asarray(wanted)
        good = found.shape == wanted.shape and bool((found == wanted).all())
        if not good and found.shape == wanted.shape and found.ndim:
            place = tuple(int(i) for i in np.argwhere(found != wanted)[0])
            text += f" at {place}: {found[place]}, not {wanted[place]}"
        self.check(good, text)

    def skip(self, text):
        self.skipped += 1
        print("skip " + text)

    def end(self):
        skipped = f", {self.skipped} skipped" if self.skipped else ""
        print(f"{self.passed} passed, {self.failed} failed{skipped}")
        return 1 if self.failed or not self.passed else 0


def random_pixels(rng, width, height, channels=1):
    """Noise, a slope with noise, few levels, or one level, in turns by chance."""
    shape = (height, width) if channels == 1 else (height, width, channels)
    kind = rng.integers(4)
    if kind == 0:
        return rng.integers(0, 256, shape, np.uint8)
    if kind == 1:
        slope = np.arange(width)[None, :] * 3 + np.arange(height)[:, None] * 2
        slope = slope if channels == 1 else slope[:, :, None]
        return np.clip(slope + rng.integers(-20, 21, shape), 0, 255).astype(np.uint8)
    if kind == 2:
        return rng.choice(rng.integers(0, 256, 3, np.uint8), shape)
    return np.full(shape, rng.integers(256), np.uint8)


def random_sizes(rng, count):
    """1x1, rows, columns, then any up to 67 x 35."""
    fixed = [(1, 1), (2, 1), (1, 2), (2, 2), (67, 1), (1, 35), (3, 3), (67, 35)]
    return fixed + [(int(rng.integers(1, 68)), int(rng.integers(1, 36))) for _ in range(count)]


def robot_pictures(tally):
    """(name, RGB array) of each small picture of robots."""
    folder = pathlib.Path(os.environ.get("PEL_DATA_DIR", ".")) / "robocup-msl"
    paths = sorted(folder.glob("*_304x400.ppm"))
    if not paths:
        tally.skip("pictures of robots: there is no robocup-msl in PEL_DATA_DIR")
    return [(path.stem, np.ascontiguousarray(np.asarray(Image.open(path).convert("RGB"))))
            for path in paths]
