"""How much stack a function takes at worst: its own frame and the deepest chain of calls below it.

Frames and calls are those of the compiler's .ci files (-fcallgraph-info=su). No function may come
back to itself, and a call through a pointer must be listed in INDIRECT, or nothing is known.
"""
import collections
import pathlib
import re

import firmware

# What a helper of the compiler's own library, or memcpy and its like, may take. They come without
# stack figures; those of gcc 12's libgcc save at most seven registers.
HELPER_BYTES = 32

# Calls through pointers, by the text of the source line that calls: (pattern of the text, pattern
# of the names of all functions that may be called, or None for the user's own function, which
# counts as nothing here because only the user knows it).
INDIRECT = (
    (r"\bon_blob\(", None),
    (r"\bon_corner\(", None),
    (r"\bon_response\(", None),
    (r"->accept\(|config\.accept\(", r"pel_blob_shape_passes"),
    (r"\bmeasurer\(", r"pel_blobs_measure"),
    (r"\bpieces\(", r"pel_classify_pieces(_\d+)?"),
    (r"\breader\(", r"pel_crow_read_\w+"),
    (r"\bread\(row", r"rgb_of_\w+"),
    (r"\bop\(|\bop_s16\(", r"pel_op_\w+"),
)

NODE = re.compile(r'node: \{ title: "([^"]+)" label: "[^"]*?\\n(\d+) bytes \(([^)]*)\)')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"(?: label: "([^"]*)")?')


class Graph:
    """frames: function -> bytes; calls: function -> functions; pointers: function -> places of
    calls through pointers. A static function's name has its file in front: path/file.c:name."""

    def __init__(self, stems):
        self.frames = {}
        self.calls = collections.defaultdict(set)
        self.pointers = collections.defaultdict(set)
        for stem in stems:
            text = pathlib.Path(f"{stem}.ci").read_text()
            for title, size, _ in NODE.findall(text):
                self.frames[title] = int(size)
            for caller, callee, place in EDGE.findall(text):
                if callee == "__indirect_call":
                    self.pointers[caller].add(place)
                else:
                    self.calls[caller].add(callee)

    def resolve(self, indirect=INDIRECT):
        """Turns calls through pointers into calls of all that they may reach. Returns the faults
        and the patterns that were of use."""
        faults, used = [], set()
        for caller, places in self.pointers.items():
            for place in places:
                text = source_text(place)
                found = [entry for entry in indirect if re.search(entry[0], text)]
                if not found:
                    faults.append(f"{caller} calls through a pointer that stack.py does not list, "
                                  f"{place}: {text.strip()}")
                for pattern, names in found:
                    used.add(pattern)
                    reached = {name for name in self.frames
                               if names and re.fullmatch(names, name.rsplit(":", 1)[-1])}
                    if names and not reached:
                        faults.append(f"{place}: no function is called {names}")
                    self.calls[caller] |= reached
        return faults, used

    def rings(self):
        """Functions that come back to themselves."""
        return [name for name in self.frames if self.deepest(name, (), {}) is None]

    def deepest(self, name, path=(), known=None):
        """Bytes from here down; None where calls go in a ring."""
        known = {} if known is None else known
        if name in path:
            return None
        if name not in known:
            below = [self.deepest(callee, path + (name,), known) for callee in self.calls[name]]
            if None in below:
                return None
            known[name] = self.frames.get(name, HELPER_BYTES) + max(below, default=0)
        return known[name]

    def strangers(self):
        """Functions that are called and neither known nor helpers of the compiler."""
        called = {callee for callees in self.calls.values() for callee in callees}
        return sorted(name for name in called - set(self.frames)
                      if not firmware.HELPERS.fullmatch(name))


def source_text(place):
    """The source at FILE:LINE:COLUMN and the line behind it, as a call may be broken there."""
    path, line, _ = place.rsplit(":", 2)
    lines = pathlib.Path(path).read_text().splitlines()
    return " ".join(lines[int(line) - 1:int(line) + 1])


def public_functions():
    """The functions that the library's headers declare."""
    names = set()
    for path in sorted((firmware.ROOT / "lib/include").rglob("*.h")):
        text = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.S)
        text = re.sub(r"^\s*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.M)
        types = re.findall(r"typedef\s[^;{}]*?\b(pel_\w+)\s*\(", text)
        names |= set(re.findall(r"\b(pel_[a-z0-9_]+)\s*\(", text)) - set(types)
        for kind in types:  # pel_reader pel_crow_read_ycbcr, ...;
            for declared in re.findall(rf"^{kind}\s([^;()]+);", text, flags=re.M):
                names |= set(re.findall(r"\w+", declared))
    return names


def worst_stacks(report, target, stems, used):
    """Public function -> bytes. `used` collects the patterns of INDIRECT that were of use."""
    graph = Graph(stems)
    faults, of_use = graph.resolve()
    used |= of_use
    for fault in faults:
        report.check(False, f"{target.name}: {fault}")
    for name in graph.strangers():
        report.check(False, f"{target.name}: {name} is called, and its stack is not known")
    for name in graph.rings():
        report.check(False, f"{target.name}: {name} comes back to itself")
    public = public_functions()
    missing = public - set(graph.frames)
    report.check(not missing, f"{target.name}: declared, but not compiled: {sorted(missing)}")
    known = {}
    return {name: graph.deepest(name, (), known) or 0 for name in sorted(public - missing)}
