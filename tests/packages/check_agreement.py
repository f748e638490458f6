#!/usr/bin/env python3
"""One version, one list of sources, one list of packages: what states them states the same.

    check_agreement.py OUT_DIR
"""
import json
import re
import shutil
import sys
import zipfile

from packagetest import (KINDS, PACK, PYTHON, ROOT, check, finish, fresh, library_sources, run,
                         step, version)


def first(pattern, text):
    match = re.search(pattern, text, re.M)
    return match.group(1) if match else None


def pack_all(folder, root):
    """Makes every package as a folder below `folder`, Arduino's by way of its archive."""
    for kind in KINDS:
        out = folder / ("arduino.zip" if kind == "arduino" else kind)
        if not step(f"pack {kind}", PYTHON, PACK, kind, out, "--root", root):
            return False
    with zipfile.ZipFile(folder / "arduino.zip") as archive:
        archive.extractall(folder)
    (folder / "pel").rename(folder / "arduino")
    return True


def stated(folder):
    """{package: version} of all that the packages below `folder` say."""
    def read(name, pattern):
        return first(pattern, (folder / name).read_text())

    headers = {"arduino": "src/pel/version.h", "platformio": "include/pel/version.h",
               "esp-idf": "lib/include/pel/version.h", "zephyr": "lib/include/pel/version.h",
               "single-file": "pel.h"}
    found = {f"{kind}'s header": read(f"{kind}/{headers[kind]}",
                                      r'^#define PEL_VERSION "([^"]+)"$') for kind in KINDS}
    found["arduino"] = read("arduino/library.properties", r"^version=(.*)$")
    found["platformio"] = json.loads((folder / "platformio/library.json").read_text())["version"]
    found["esp-idf"] = read("esp-idf/idf_component.yml", r'^version: "(.*)"$')
    found["pel.c"] = read("single-file/pel.c", r"^ \* pel ([\d.]+), the whole library")
    return found


def check_sources(folder):
    """Every package holds the sources that CMake compiles, and pel.c a section for each."""
    sources = library_sources()
    places = {"arduino": "src", "platformio": "src", "esp-idf": "lib/src", "zephyr": "lib/src"}
    for kind, place in places.items():
        packed = [path.relative_to(folder / kind / place).as_posix()
                  for path in (folder / kind / place).rglob("*.c")]
        check(sorted(packed) == sorted(sources), f"{kind}: the sources", str(packed))
    sections = re.findall(r"^/\* ==== src/(\S+\.c) =+ \*/$",
                          (folder / "single-file/pel.c").read_text(), re.M)
    check(sections == sources, "pel.c: the sources, in their order", str(sections))
    here = sorted(path.relative_to(ROOT / "lib/src").as_posix()
                  for path in (ROOT / "lib/src").rglob("*.c"))
    check(here == sorted(sources), "pel_files.cmake lists what is there", str(here))


def check_readme():
    """The README names every package once, with its page and with a command that makes it."""
    readme = (ROOT / "README.md").read_text()
    lines = re.findall(r"^\| \[`([\w-]+)`\]\(([^)]*)\) \|", readme, re.M)
    check(lines == [(kind, f"ports/{kind}/README.md") for kind in KINDS],
          "the README's table of packages", str(lines))
    for kind, page in lines:
        check((ROOT / page).is_file(), f"{page} is there")
        check(re.search(rf"^    python3 tools/dev/pack.py {kind} \S+$",
                        (ROOT / page).read_text(), re.M), f"{page} says how to make it")
    check(re.search(r"^    python3 tools/dev/pack.py arduino\b", readme, re.M),
          "the README says how to make them")
    usage = run(PYTHON, PACK, "--help").stdout
    check(f"{{{','.join(KINDS)}}}" in usage, "pack.py makes these and no others", usage)


def check_refusals(folder):
    """What stands in the way is refused, and left as it was."""
    full = folder / "full"
    full.mkdir()
    (full / "mine.txt").write_text("mine\n")
    for out in (full, full / "mine.txt"):
        result = run(PYTHON, PACK, "zephyr", out)
        check(result.returncode == 1 and result.stdout.startswith("pack.py: "),
              f"{out.name} is refused", result.stdout)
    check([path.name for path in full.iterdir()] == ["mine.txt"], "and nothing is written")
    tree = copy_project(folder / "lacking")
    (tree / "lib/src/left_out.c").write_text("\n")
    for kind in KINDS:
        out = folder / f"refused-{kind}"
        result = run(PYTHON, PACK, kind, out, "--root", tree)
        check(result.returncode == 1 and "left_out.c" in result.stdout and not out.exists(),
              f"{kind}: a source that is not listed", result.stdout)


def check_places(folder):
    """Without a place to write to, a package lies below build, and can be made again."""
    tree = copy_project(folder / "places")
    for kind in KINDS:
        for _ in range(2):
            result = run(PYTHON, PACK, kind, "--root", tree)
            out = result.stdout.partition("wrote ")[2].strip()
            check(result.returncode == 0 and out.startswith(f"{tree}/build/packages/{kind}/pel"),
                  f"{kind}: its own place", result.stdout)


def check_header():
    """The numbers of the header make up its text."""
    text = (ROOT / "lib/include/pel/version.h").read_text()
    parts = [first(rf"^#define PEL_VERSION_{part} (\d+)$", text)
             for part in ("MAJOR", "MINOR", "PATCH")]
    check(None not in parts and ".".join(parts) == version(), "the numbers and the text",
          str(parts))


def check_nowhere_else():
    """No other file of lib, ports or the packaging tools writes the version down."""
    for folder in ("lib", "ports", "tools/dev", "tools/package"):
        for path in (ROOT / folder).rglob("*"):
            if path.is_file() and path.name != "version.h" and path.suffix != ".pyc":
                text = path.read_text(encoding="utf-8", errors="replace")
                check(not re.search(rf"(?<![\d.]){re.escape(version())}(?![\d.])", text),
                      f"{path.relative_to(ROOT)} does not state the version")


def copy_project(tree):
    """What packages are made from."""
    for name in ("lib", "ports"):
        shutil.copytree(ROOT / name, tree / name)
    shutil.copy(ROOT / "LICENSE", tree)
    return tree


def check_follows(folder):
    """A project with another version makes packages of that version."""
    tree = copy_project(folder / "tree")
    header = tree / "lib/include/pel/version.h"
    header.write_text(header.read_text().replace(f'"{version()}"', '"98.7.6"'))
    (folder / "other").mkdir()
    if pack_all(folder / "other", tree):
        for name, found in stated(folder / "other").items():
            check(found == "98.7.6", f"{name} follows the header", str(found))


def main():
    folder = fresh("agreement")
    check_header()
    if pack_all(folder, ROOT):
        for name, text in stated(folder).items():
            check(text == version(), f"{name} is version {version()}", str(text))
        check_sources(folder)
    check_nowhere_else()
    check_follows(folder)
    check_readme()
    check_refusals(folder)
    check_places(folder)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
