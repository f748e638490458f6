"""Corners, edges and lines against OpenCV and NumPy.

FAST-9 and Canny must equal OpenCV's point for point and pixel for pixel. The integer corner
responses are held against OpenCV's floating-point ones, the chessboards of Debian's opencv-doc
against findChessboardCorners with cornerSubPix, lines against NumPy's eigenvectors and OpenCV's
fitLine.

Needs PEL_SHARED (the library as a shared object). The chessboards are looked for in
PEL_CHESSBOARDS, in the installed package opencv-doc, and in the folder chessboards of
PEL_BINARY_DIR; if they are nowhere the package is fetched into the latter. PEL_DATA_DIR holds the
pictures of robots.
"""
import ctypes
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import cv2
import numpy as np

from pel_ctypes import LIBRARY as pel
from pel_ctypes import view_of

HARRIS, SHI_TOMASI, FAST9 = range(3)
FIRST, STRICT, NONE = range(3)
ROBOT_PICTURES = 12
CHESSBOARD_CORNERS = 800  # the strongest N among which all 54 inner corners must be
CHESSBOARD_DISTANCE_PX = 1.5  # after pel_corners_refine
RESPONSE_DISTANCE_PX = 3.0    # the top of the response, with a 3x3 window, lies beside the crossing


class CornersConfig(ctypes.Structure):
    _fields_ = [("method", ctypes.c_int), ("suppress", ctypes.c_int), ("backend", ctypes.c_int),
                ("width", ctypes.c_uint16), ("height", ctypes.c_uint16), ("k_q15", ctypes.c_uint16),
                ("threshold", ctypes.c_int32), ("work", ctypes.c_void_p),
                ("work_bytes", ctypes.c_size_t), ("results", ctypes.c_void_p),
                ("results_max", ctypes.c_uint32), ("on_corner", ctypes.c_void_p),
                ("on_response", ctypes.c_void_p), ("user", ctypes.c_void_p)]


class Corners(ctypes.Structure):
    _fields_ = [("config", CornersConfig), ("found", ctypes.c_uint32),
                ("dropped", ctypes.c_uint32), ("private", ctypes.c_uint8 * 32)]


class CannyConfig(ctypes.Structure):
    _fields_ = [("width", ctypes.c_uint16), ("height", ctypes.c_uint16), ("low", ctypes.c_uint16),
                ("high", ctypes.c_uint16), ("backend", ctypes.c_int), ("work", ctypes.c_void_p),
                ("work_bytes", ctypes.c_size_t)]


class Line(ctypes.Structure):
    _fields_ = [(name, ctypes.c_int32) for name in
                ("x_q4", "y_q4", "dx_q16", "dy_q16", "offset_q4", "x0_q4", "y0_q4", "x1_q4",
                 "y1_q4")] + [("inliers", ctypes.c_uint16), ("angle_turn16", ctypes.c_int16)]


CORNER = np.dtype([("response", "<i4"), ("x", "<u2"), ("y", "<u2"), ("dx_q4", "i1"),
                   ("dy_q4", "i1"), ("padding", "<u2")])
RESPONSE_ROW = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_uint16,
                                ctypes.POINTER(ctypes.c_int32))

pel.pel_corners_bytes.restype = ctypes.c_size_t
pel.pel_canny_bytes.restype = ctypes.c_size_t


class Tally:
    def __init__(self):
        self.passed = self.failed = self.skipped = 0

    def group(self, name, checks, failures):
        good = checks > 0 and not failures
        self.passed += good
        self.failed += not good
        print("%s %s: %d checks%s" % ("ok  " if good else "FAIL", name, checks,
                                      "" if checks else " (nothing was checked)"))
        for failure in failures[:5]:
            print("     ", failure)
        sys.stdout.flush()

    def skip(self, name, why):
        self.skipped += 1
        print("skip %s: %s" % (name, why))


# ---- The library ---------------------------------------------------------------------------

def find_corners(gray, method, results_max, suppress=FIRST, k_q15=0, threshold=0):
    """The corners, strongest first, and the responses."""
    height, width = gray.shape
    work = np.zeros(pel.pel_corners_bytes(width, method) // 4 + 1, np.uint32)
    results = np.zeros(max(results_max, 1), CORNER)
    responses = np.zeros((height, width), np.int32)

    def on_response(_, y, row):
        responses[y] = np.ctypeslib.as_array(row, (width,))

    callback = RESPONSE_ROW(on_response)
    config = CornersConfig(method=method, suppress=suppress, k_q15=k_q15, threshold=threshold,
                           work=work.ctypes.data, work_bytes=work.nbytes,
                           results=results.ctypes.data, results_max=results_max,
                           on_response=ctypes.cast(callback, ctypes.c_void_p))
    corners, count, view = Corners(), ctypes.c_uint32(), view_of(gray)
    status = pel.pel_corners_frame(ctypes.byref(corners), ctypes.byref(config), ctypes.byref(view),
                                   ctypes.byref(count))
    assert status == (1 if corners.dropped else 0), status
    assert count.value == (corners.found - corners.dropped if results_max else 0)
    return results[:count.value], responses


def refine_corners(gray, found, radius=5):
    refined = found.copy()
    count, view = ctypes.c_uint32(), view_of(gray)
    status = pel.pel_corners_refine(ctypes.byref(view), ctypes.c_uint(radius),
                                    ctypes.c_void_p(refined.ctypes.data),
                                    ctypes.c_uint32(len(refined)), ctypes.byref(count))
    assert status == 0, status
    return refined, count.value


def places_of(corners):
    return np.stack([corners["x"] + corners["dx_q4"] / 16, corners["y"] + corners["dy_q4"] / 16], 1)


def canny(gray, low, high, stack_max=0):
    edges = np.empty_like(gray)
    work = np.zeros(pel.pel_canny_bytes(gray.shape[1]) // 2 + 1, np.uint16)
    stack = np.zeros((max(stack_max, 1), 2), np.uint16)
    config = CannyConfig(low=low, high=high, work=work.ctypes.data, work_bytes=work.nbytes)
    src, dst = view_of(gray), view_of(edges)
    status = pel.pel_canny_frame(ctypes.byref(config), ctypes.byref(src), ctypes.byref(dst))
    assert status == 0, status
    status = pel.pel_canny_hysteresis(ctypes.byref(dst), ctypes.c_void_p(stack.ctypes.data),
                                      ctypes.c_uint32(stack_max))
    assert status == 0, status
    return edges


def fit_line(points_q4, distance_q4=0, rounds=0):
    points = np.ascontiguousarray(points_q4, np.int32)
    line = Line()
    status = pel.pel_line_fit(ctypes.c_void_p(points.ctypes.data), ctypes.c_uint32(len(points)),
                              ctypes.c_uint32(distance_q4), ctypes.c_uint(rounds),
                              ctypes.byref(line))
    assert status == 0, status
    return line


# ---- Pictures ------------------------------------------------------------------------------

def random_pictures(random):
    """Noise, smooth noise, rectangles and few gray levels, from 1x1 to 67x35."""
    sizes = [(w, h) for w in (1, 2, 3, 5, 6, 7, 8, 9) for h in (1, 2, 3, 6, 7, 8, 9)]
    sizes += [(int(random.integers(1, 68)), int(random.integers(1, 36))) for _ in range(150)]
    for i, (width, height) in enumerate(sizes):
        gray = random.integers(0, 256, (height, width), np.uint8)
        if i % 4 == 1:
            gray = cv2.GaussianBlur(gray, (5, 5), 1.2)
        elif i % 4 == 2:
            gray[:] = random.integers(0, 256)
            for _ in range(6):
                x, y = random.integers(0, width), random.integers(0, height)
                gray[y:y + random.integers(1, 20), x:x + random.integers(1, 20)] = \
                    random.integers(0, 256)
        elif i % 4 == 3:
            gray = (gray // 86 * 127).astype(np.uint8)
        yield "random %d, %dx%d" % (i, width, height), gray


def robot_pictures():
    folder = pathlib.Path(os.environ.get("PEL_DATA_DIR", "")) / "robocup-msl"
    for path in sorted(folder.glob("*.jpg"))[:ROBOT_PICTURES]:
        gray = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
        yield path.name, np.ascontiguousarray(cv2.resize(gray, None, fx=0.5, fy=0.5))


def chessboard_folder():
    listed = ""
    if shutil.which("dpkg"):
        listed = subprocess.run(["dpkg", "-L", "opencv-doc"], capture_output=True,
                                text=True).stdout
    fetched = pathlib.Path(os.environ.get("PEL_BINARY_DIR", ".")) / "chessboards"
    places = [os.environ.get("PEL_CHESSBOARDS")]
    places += [os.path.dirname(p) for p in listed.split() if p.endswith("/left01.jpg")]
    places += [str(fetched)]
    for place in places:
        if place and list(pathlib.Path(place).glob("left[01][0-9].jpg")):
            return pathlib.Path(place)
    return fetched if fetch_chessboards(fetched) else None


def fetch_chessboards(folder):
    if not shutil.which("apt-get") or not shutil.which("dpkg"):
        return False
    with tempfile.TemporaryDirectory() as work:
        got = subprocess.run(["apt-get", "download", "opencv-doc"], cwd=work, capture_output=True)
        packages = list(pathlib.Path(work).glob("opencv-doc*.deb"))
        if got.returncode != 0 or not packages:
            return False
        subprocess.run(["dpkg", "-x", str(packages[0]), work], check=True)
        folder.mkdir(parents=True, exist_ok=True)
        for path in pathlib.Path(work).rglob("left[01][0-9].jpg"):
            shutil.copy(path, folder)
    return bool(list(folder.glob("left*.jpg")))


# ---- FAST ----------------------------------------------------------------------------------

def check_fast(tally, name, pictures):
    checks, points, failures = 0, 0, []
    for label, gray in pictures:
        for threshold in (1, 5, 20, 60, 200, 254):
            for suppress in (True, False):
                detector = cv2.FastFeatureDetector_create(
                    threshold, suppress, cv2.FastFeatureDetector_TYPE_9_16)
                theirs = {(int(p.pt[0]), int(p.pt[1])): int(p.response)
                          for p in detector.detect(gray)}
                found, _ = find_corners(gray, FAST9, gray.size, STRICT if suppress else NONE,
                                        threshold=threshold)
                ours = {(int(c["x"]), int(c["y"])): int(c["response"]) for c in found}
                same = ours == theirs if suppress else set(ours) == set(theirs)
                checks += 1
                points += len(theirs)
                if not same or len(ours) != len(found):
                    failures.append("%s, threshold %d, suppress %d: %d points, OpenCV %d"
                                    % (label, threshold, suppress, len(ours), len(theirs)))
    tally.group("%s (%d points)" % (name, points), checks if points else 0, failures)


def check_fast_scores(tally, pictures):
    """OpenCV gives scores with suppression only; a score says at which thresholds it finds it."""
    checks, failures = 0, []
    for label, gray in pictures:
        found, _ = find_corners(gray, FAST9, gray.size, NONE, threshold=1)
        for threshold in range(1, 255, 11):
            detector = cv2.FastFeatureDetector_create(threshold, False)
            theirs = {(int(p.pt[0]), int(p.pt[1])) for p in detector.detect(gray)}
            ours = {(int(c["x"]), int(c["y"])) for c in found if c["response"] >= threshold}
            checks += 1
            if ours != theirs:
                failures.append("%s at threshold %d" % (label, threshold))
    tally.group("FAST-9 scores without suppression", checks, failures)


# ---- Canny ---------------------------------------------------------------------------------

def check_canny(tally, name, pictures):
    checks, edges, failures = 0, 0, []
    for label, gray in pictures:
        for low, high in ((0, 0), (20, 60), (100, 200), (150, 700), (400, 400), (2040, 2040)):
            theirs = cv2.Canny(gray, low, high, apertureSize=3, L2gradient=False)
            edges += int(np.count_nonzero(theirs))
            for stack_max in (0, 3, gray.size):
                checks += 1
                if not np.array_equal(canny(gray, low, high, stack_max), theirs):
                    failures.append("%s, %d..%d, stack of %d" % (label, low, high, stack_max))
    tally.group("%s (%d edge pixels)" % (name, edges), checks if edges else 0, failures)


# ---- Harris and Shi-Tomasi -----------------------------------------------------------------

def exact_responses(gray, k_q15):
    """Harris and twice the smaller eigenvalue by NumPy: wide integers, doubles for the root."""
    padded = np.pad(gray.astype(np.int64), 2, mode="edge")
    across = padded[:, 2:] - padded[:, :-2]
    gx = across[:-2] + 2 * across[1:-1] + across[2:]
    down = padded[2:] - padded[:-2]
    gy = down[:, :-2] + 2 * down[:, 1:-1] + down[:, 2:]

    def window(values):
        rows = values[:-2] + values[1:-1] + values[2:]
        return rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:]

    a, b, c = window(gx * gx), window(gx * gy), window(gy * gy)
    harris = ((a * c - b * b) * 32768 - k_q15 * (a + c) ** 2) >> 29
    eigenvalue = (a + c - np.sqrt(((a - c) ** 2 + 4 * b * b).astype(float))) / 2
    return harris, eigenvalue


def check_responses(tally, pictures):
    """Harris against wide integers, all pixels; both against OpenCV away from the border, where it
    repeats other things, and up to the digits of its 32-bit numbers."""
    checks, failures = 0, []
    for label, gray in pictures:
        for k_q15 in (1311, 2048, 8191):
            harris = find_corners(gray, HARRIS, 0, k_q15=k_q15)[1]
            eigenvalue = find_corners(gray, SHI_TOMASI, 0)[1]
            exact, root = exact_responses(gray, k_q15)
            checks += gray.size
            if not np.array_equal(harris, exact):
                failures.append("%s: Harris, k %d" % (label, k_q15))
            if np.any(eigenvalue > root + 1e-6) or np.any(eigenvalue < root - 1 - 1e-6):
                failures.append("%s: Shi-Tomasi" % label)
            if min(gray.shape) < 5:
                continue
            unit = 4 * 3 * 255  # OpenCV divides the derivatives by this
            theirs = cv2.cornerHarris(gray, 3, 3, k_q15 / 32768).astype(float) * unit ** 4 / 2 ** 14
            smaller = cv2.cornerMinEigenVal(gray, 3, 3).astype(float) * unit ** 2
            inner = np.s_[2:-2, 2:-2]
            scale = float(np.max(root)) + 1.0
            far = np.abs(harris - theirs)[inner] > 2 + 1e-4 * np.abs(theirs).max()
            far |= np.abs(eigenvalue - smaller)[inner] > 2 + 1e-3 * scale
            if np.any(far):
                failures.append("%s: OpenCV, %d pixels" % (label, np.count_nonzero(far)))
    tally.group("Harris and Shi-Tomasi responses", checks, failures)


def board_corners(gray):
    """The 54 inner corners as OpenCV sees them; None if it does not."""
    seen, board = cv2.findChessboardCorners(gray, (9, 6))
    if not seen:
        return None
    stop = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 30, 0.001)
    return cv2.cornerSubPix(gray, board, (5, 5), (-1, -1), stop).reshape(-1, 2)


class Boards:
    """How far the nearest corner is from those of the boards, and how strong."""

    def __init__(self, limit):
        self.limit, self.distances, self.last, self.failures = limit, [], 0, []

    def compare(self, label, board, places):
        for corner in board:
            distances = np.hypot(*(places - corner).T)
            near = np.flatnonzero(distances <= self.limit)
            self.distances.append(distances.min())
            if len(near):
                self.last = max(self.last, int(near[0]) + 1)
            else:
                self.failures.append("%s: none near (%.1f, %.1f), nearest %.2f px"
                                     % (label, *corner, distances.min()))

    def report(self, tally, name):
        distances = self.distances or [math.nan]
        median, most = np.median(distances), max(distances)
        tally.group("%s on chessboards: all corners within %.1f px among the strongest %d (%d "
                    "would do); median %.2f, farthest %.2f px" %
                    (name, self.limit, CHESSBOARD_CORNERS, self.last, median, most),
                    len(self.distances), self.failures)


def check_chessboards(tally):
    folder = chessboard_folder()
    if folder is None:
        tally.skip("chessboards", "no package opencv-doc, and it cannot be fetched")
        return
    for method, name in ((HARRIS, "Harris"), (SHI_TOMASI, "Shi-Tomasi")):
        refined, raw = Boards(CHESSBOARD_DISTANCE_PX), Boards(RESPONSE_DISTANCE_PX)
        for path in sorted(folder.glob("left[01][0-9].jpg")):
            gray = np.ascontiguousarray(cv2.imread(str(path), cv2.IMREAD_GRAYSCALE))
            board = board_corners(gray)
            if board is None:
                refined.failures.append("%s: OpenCV sees no board" % path.name)
                continue
            found, _ = find_corners(gray, method, CHESSBOARD_CORNERS)
            raw.compare(path.name, board, places_of(found))
            refined.compare(path.name, board, places_of(refine_corners(gray, found)[0]))
        refined.report(tally, name + ", refined,")
        raw.report(tally, name)


# ---- Lines ---------------------------------------------------------------------------------

def angle_between_turn16(dx, dy, vx, vy):
    """Of two lines without a sense, in 1/65536 of a turn."""
    return abs(math.atan2(dx * vy - dy * vx, dx * vx + dy * vy)) % math.pi * 65536 / (2 * math.pi)


def check_lines(tally, random):
    checks, failures = 0, []
    for i in range(600):
        count = int(random.integers(2, 300)) if i % 10 else 4096
        angle, length = random.uniform(-math.pi, math.pi), random.uniform(40, 60000)
        if i % 8 == 0:
            angle = i // 8 % 4 * math.pi / 4
        along = random.uniform(-length, length, count)
        across = random.normal(0, random.uniform(0, length / 30), count)
        middle = random.integers(-50000, 50000, 2)
        points = np.stack([along * math.cos(angle) - across * math.sin(angle),
                           along * math.sin(angle) + across * math.cos(angle)], 1)
        points = np.clip(np.rint(points + middle), -131072, 131071).astype(np.int64)
        if np.all(points == points[0]):
            continue
        line = fit_line(points)
        mean = points.mean(0)
        values, vectors = np.linalg.eigh(np.cov((points - mean).T, bias=True))
        vx, vy = vectors[:, 1]
        cx, cy = cv2.fitLine(points.astype(np.float32), cv2.DIST_L2, 0, 1e-9, 1e-9).ravel()[:2]
        turned = angle_between_turn16(line.dx_q16, line.dy_q16, vx, vy)
        turned = min(turned, 32768 - turned)
        told = line.angle_turn16 * 2 * math.pi / 65536
        told = angle_between_turn16(math.cos(told), math.sin(told), vx, vy)
        told = min(told, 32768 - told)
        theirs = angle_between_turn16(cx, cy, vx, vy)
        theirs = min(theirs, 32768 - theirs)
        beside = abs((line.x_q4 - mean[0]) * vy - (line.y_q4 - mean[1]) * vx)
        normal = (-line.dy_q16 / 65536, line.dx_q16 / 65536)
        offset = normal[0] * mean[0] + normal[1] * mean[1]
        inliers = np.count_nonzero(np.abs((points - mean) @ np.array([-vy, vx])) < 0.01)
        checks += 1
        if turned > 0.5 or told > 2 or theirs > 20 or beside > 0.75 or \
                abs(line.offset_q4 - offset) > 1.5 or inliers > count or line.dx_q16 < 0 or \
                abs(math.hypot(line.dx_q16, line.dy_q16) - 65536) > 1:
            failures.append("%d points, length %.0f, angle %.4f: turned by %.2f, told %.2f, OpenCV "
                            "%.2f, beside %.2f, offset %d for %.2f" %
                            (count, length, angle, turned, told, theirs, beside, line.offset_q4,
                             offset))
    tally.group("lines through random points", checks, failures)


def check_robust_lines(tally, random):
    """A third of the points lies elsewhere; the line must come back to those that do not."""
    checks, failures = 0, []
    for i in range(200):
        angle = random.uniform(-math.pi, math.pi)
        direction = np.array([math.cos(angle), math.sin(angle)])
        normal = np.array([-direction[1], direction[0]])
        middle = random.integers(2000, 6000, 2)
        good = middle + np.outer(random.uniform(-2500, 2500, 100), direction) + \
            np.outer(random.uniform(-12, 12, 100), normal)
        bad = middle + np.outer(random.uniform(-2500, 2500, 50), direction) + \
            np.outer(random.uniform(100, 900, 50), normal)
        points = np.rint(np.concatenate([good, bad]))
        line = fit_line(points, 32, 6)
        turned = angle_between_turn16(line.dx_q16, line.dy_q16, *direction)
        turned = min(turned, 32768 - turned)
        beside = abs((line.x_q4 - middle[0]) * normal[0] + (line.y_q4 - middle[1]) * normal[1])
        checks += 1
        if turned > 65536 / 360 * 0.3 or beside > 8 or line.inliers != 100:
            failures.append("angle %.3f: turned by %.1f, beside %.1f, %d inliers"
                            % (angle, turned, beside, line.inliers))
    tally.group("lines with a third of outliers", checks, failures)


def main():
    tally = Tally()
    random = np.random.default_rng(20240607)
    pictures = list(random_pictures(random))
    robots = list(robot_pictures())
    check_fast(tally, "FAST-9 on random pictures", pictures)
    check_fast_scores(tally, pictures[-24:])
    check_canny(tally, "Canny on random pictures", pictures)
    check_responses(tally, pictures[::3] + [p for p in pictures if p[1].size > 1200][:10])
    if robots:
        check_fast(tally, "FAST-9 on pictures of robots", robots)
        check_canny(tally, "Canny on pictures of robots", robots)
        check_responses(tally, robots[:3])
    else:
        tally.skip("pictures of robots", "PEL_DATA_DIR has none")
    check_chessboards(tally)
    check_lines(tally, random)
    check_robust_lines(tally, random)
    print("%d passed, %d failed, %d skipped" % (tally.passed, tally.failed, tally.skipped))
    return 1 if tally.failed or not tally.passed else 0


if __name__ == "__main__":
    sys.exit(main())
