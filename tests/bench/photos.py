#!/usr/bin/env python3
"""Makes the photographs of the benchmark from the sample images of scikit-learn and scikit-image.

usage: photos.py NAME WIDTHxHEIGHT OUT.yuyv

Needs scikit-learn (china, flower) or scikit-image (cat, astronaut, coffee), NumPy and OpenCV, whose
resize decides the bytes: 5.0.0 gives those that the benchmark's figures were measured on. Exit
status 3 if a module is missing.
"""
import sys


def load(name):
    if name in ("china", "flower"):
        from sklearn.datasets import load_sample_image
        return load_sample_image(name + ".jpg")
    from skimage import data
    return getattr(data, {"cat": "chelsea"}.get(name, name))()


def crop_to_4_3(rgb):
    height, width = rgb.shape[:2]
    if width * 3 > height * 4:
        w, h = height * 4 // 3, height
    else:
        w, h = width, width * 3 // 4
    x, y = (width - w) // 2, (height - h) // 2
    return rgb[y:y + h, x:x + w]


def to_yuyv(np, rgb):
    r, g, b = (rgb[..., c].astype(np.int32) for c in range(3))
    y = (77 * r + 150 * g + 29 * b + 128) >> 8
    u = ((-43 * r - 85 * g + 128 * b + 128) >> 8) + 128
    v = ((128 * r - 107 * g - 21 * b + 128) >> 8) + 128
    y, u, v = (np.clip(plane, 0, 255) for plane in (y, u, v))
    frame = np.empty((rgb.shape[0], rgb.shape[1], 2), np.uint8)
    frame[..., 0] = y
    frame[:, 0::2, 1] = (u[:, 0::2] + u[:, 1::2] + 1) // 2
    frame[:, 1::2, 1] = (v[:, 0::2] + v[:, 1::2] + 1) // 2
    return frame


def main():
    name, size, out = sys.argv[1:]
    width, height = (int(side) for side in size.split("x"))
    try:
        import cv2
        import numpy as np
        rgb = crop_to_4_3(load(name))
    except ImportError as missing:
        print(missing, file=sys.stderr)
        return 3
    shrink = rgb.shape[1] > width
    rgb = cv2.resize(np.ascontiguousarray(rgb), (width, height),
                     interpolation=cv2.INTER_AREA if shrink else cv2.INTER_LINEAR)
    to_yuyv(np, rgb).tofile(out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
