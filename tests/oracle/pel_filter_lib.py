"""The filter module of pel as a shared library, called through ctypes. PEL_SHARED names it.

The structures are those of pel/filter.h and pel/image.h, field for field.
"""
import ctypes
import os

import numpy as np

BORDERS = ["replicate", "symmetric", "reflect101", "wrap", "constant", "valid"]


class Kernel(ctypes.Structure):
    _fields_ = [("tap", ctypes.c_int8 * 25), ("radius", ctypes.c_uint8),
                ("divisor", ctypes.c_uint16), ("shift", ctypes.c_uint8),
                ("absolute", ctypes.c_uint8), ("bias", ctypes.c_int16)]


class Config(ctypes.Structure):
    _fields_ = [("op", ctypes.c_void_p), ("op_s16", ctypes.c_void_p),
                ("kernel", ctypes.POINTER(Kernel)), ("width", ctypes.c_uint16),
                ("height", ctypes.c_uint16),
                ("border", ctypes.c_int), ("backend", ctypes.c_int),
                ("constant", ctypes.c_uint8),
                ("last_rows", ctypes.c_void_p * 2), ("work", ctypes.c_void_p),
                ("work_bytes", ctypes.c_size_t)]


class View(ctypes.Structure):
    _fields_ = [("plane", ctypes.c_void_p * 3), ("stride_bytes", ctypes.c_int32 * 3),
                ("width", ctypes.c_uint16),
                ("height", ctypes.c_uint16),
                ("format", ctypes.c_int), ("range", ctypes.c_int)]


LIBRARY = ctypes.CDLL(os.environ["PEL_SHARED"])
LIBRARY.pel_kernel_named.restype = ctypes.POINTER(Kernel)
LIBRARY.pel_kernel_named.argtypes = [ctypes.c_char_p]
LIBRARY.pel_kernel_flipped.restype = Kernel
LIBRARY.pel_kernel_flipped.argtypes = [ctypes.POINTER(Kernel)]
LIBRARY.pel_filter_bytes.restype = ctypes.c_size_t
LIBRARY.pel_filter_bytes.argtypes = [ctypes.c_uint16, ctypes.c_uint, ctypes.c_int]
LIBRARY.pel_filter_frame.argtypes = [ctypes.POINTER(Config), ctypes.POINTER(View),
                                     ctypes.POINTER(View)]
LIBRARY.pel_filter_frame_s16.argtypes = [ctypes.POINTER(Config), ctypes.POINTER(View),
                                         ctypes.c_void_p, ctypes.c_int32]
LIBRARY.pel_filter_twice.argtypes = [ctypes.POINTER(Config), ctypes.c_void_p, ctypes.c_void_p,
                                     ctypes.POINTER(View), ctypes.POINTER(View)]


def operator(name):
    """The address of pel_op_NAME; none for the kernel."""
    if name == "kernel":
        return None
    return ctypes.cast(getattr(LIBRARY, "pel_op_" + name), ctypes.c_void_p)


def kernel(taps, divisor=1, shift=0, bias=0, absolute=False):
    """A kernel of a square NumPy array of taps."""
    made = Kernel()
    made.radius = taps.shape[0] // 2
    for i, tap in enumerate(taps.ravel()):
        made.tap[i] = int(tap)
    made.divisor, made.shift, made.bias, made.absolute = divisor, shift, bias, int(absolute)
    return made


def named(name):
    found = LIBRARY.pel_kernel_named(name.encode())
    if not found:
        raise LookupError(f"no kernel {name}")
    copy = Kernel()
    ctypes.pointer(copy)[0] = found.contents
    return copy


def flipped(made):
    return LIBRARY.pel_kernel_flipped(ctypes.byref(made))


def view_of(pixels):
    view = View()
    view.plane[0] = pixels.ctypes.data
    view.stride_bytes[0] = pixels.strides[0]
    view.height, view.width = pixels.shape
    return view


def _check(status, what):
    if status != 0:
        raise RuntimeError(f"{what} gave {status}")


def _config(made, border, constant, work):
    config = Config()
    config.kernel = ctypes.pointer(made) if made is not None else None
    config.border = BORDERS.index(border)
    config.constant = constant
    config.work = work.ctypes.data
    config.work_bytes = work.size
    return config


def _room(pixels, op, made, border):
    radius = made.radius if op == "kernel" else 2 if op == "binomial5" else 1
    size = LIBRARY.pel_filter_bytes(pixels.shape[1], radius, BORDERS.index(border))
    lost = 2 * radius if border == "valid" else 0
    return np.zeros(size, np.uint8), (pixels.shape[0] - lost, pixels.shape[1] - lost)


def filter_u8(pixels, op, made=None, border="replicate", constant=0):
    work, shape = _room(pixels, op, made, border)
    result = np.zeros(shape, np.uint8)
    config = _config(made, border, constant, work)
    config.op = operator(op)
    source, target = view_of(pixels), view_of(result)
    _check(LIBRARY.pel_filter_frame(config, source, target), "pel_filter_frame")
    return result


def filter_s16(pixels, op, made=None, border="replicate", constant=0):
    work, shape = _room(pixels, op, made, border)
    result = np.zeros(shape, np.int16)
    config = _config(made, border, constant, work)
    config.op_s16 = operator(op if op == "kernel" else op + "_s16")
    _check(LIBRARY.pel_filter_frame_s16(config, view_of(pixels), result.ctypes.data, shape[1]),
           "pel_filter_frame_s16")
    return result


def twice(pixels, first, second, border="replicate", constant=0):
    width = pixels.shape[1]
    work = np.zeros(3 * (width + 2), np.uint8)
    result = np.zeros_like(pixels)
    config = _config(None, border, constant, work)
    _check(LIBRARY.pel_filter_twice(config, operator(first), operator(second), view_of(pixels),
                                    view_of(result)), "pel_filter_twice")
    return result
