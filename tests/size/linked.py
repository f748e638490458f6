"""What of the library ends up in a firmware, as the linker's map says.

Counted are the bytes of code and of constants (.text* and .rodata*) of the library's own objects
that the linker kept with --gc-sections: modules and row kernels. Not counted are the program
itself, memcpy and its like, the helpers of the compiler's library, and gaps for alignment.
"""
import collections
import re

import firmware

Firmware = collections.namedtuple("Firmware", "item source everything absent")
# `absent`: modules of which nothing may be left, by the beginnings of their files' names.
FIRMWARES = (
    Firmware("classify and blobs", "classify_blobs", False,
             ("filter", "point", "feature", "color")),
    Firmware("generic 3x3, all borders", "generic_3x3", False,
             ("blob", "classify", "point", "feature", "color")),
    Firmware("whole library", "everything", True, ()),
)

SECTION = re.compile(r"^ \.(text|rodata)\S*\s+0x[0-9a-f]+\s+0x([0-9a-f]+)\s+(\S+\.o)$", re.M)


def kept(map_text, stems):
    """Module -> bytes of those of its sections that are in the program."""
    # Long names of sections stand alone on a line; discarded ones come before the memory map.
    text = re.sub(r"^( \.\S+)\n\s+0x", r"\1 0x", map_text.split("Linker script and memory map")[1],
                  flags=re.M)
    modules = {f"{stem}.o": stem.name for stem in stems}
    found = collections.Counter()
    for _, size, path in SECTION.findall(text):
        if path in modules:
            found[modules[path]] += int(size, 16)
    return {module: size for module, size in found.items() if size}


def link(report, target, stems, which, folder, public):
    """Links one firmware; module -> bytes."""
    main = folder / which.source
    memory = folder / "memory"
    for stem, source in ((main, firmware.HERE / f"linked/{which.source}.c"),
                         (memory, firmware.ROOT / "ports/baremetal/memory.c")):
        _, fault = firmware.compile_one((target, ["-ffunction-sections", "-fdata-sections"],
                                         source, stem))
        report.check(not fault, f"{target.name}: {source}:\n{fault}")
    wanted = [f"-Wl,--undefined={name}" for name in sorted(public)] if which.everything else []
    result = firmware.run(
        target.tools + "gcc", *target.flags, "-nostdlib", "-Wl,--gc-sections", "-Wl,-e,start",
        f"-Wl,-Map={main}.map", *wanted, f"{main}.o", f"{memory}.o",
        *[f"{stem}.o" for stem in stems], "-lgcc", "-o", f"{main}.elf")
    report.check(result.returncode == 0, f"{target.name}: {which.item}: {result.stderr}")
    if result.returncode != 0:
        return {}
    modules = kept(main.with_suffix(".map").read_text(), stems)
    left = [module for module in modules
            if module.removeprefix("row_").startswith(which.absent or ("?",))]
    report.check(not left, f"{target.name}: {which.item}: also has {', '.join(left)}")
    return modules
