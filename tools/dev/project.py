"""What the packages are made from: the version and the files of the library, each stated once."""
import pathlib
import re

HERE = pathlib.Path(__file__).resolve().parents[2]
SOURCE = re.compile(r"\$\{PEL_LIB_DIR\}/(src/[^\s;()\"]+)")


class Problem(Exception):
    """What a tool cannot solve; its text is for the user."""


def version(root):
    """The version as pel/version.h states it."""
    text = (root / "lib/include/pel/version.h").read_text(encoding="utf-8")
    found = re.search(r'^#define PEL_VERSION "([^"]+)"$', text, re.M)
    if not found:
        raise Problem("pel/version.h states no version")
    return found.group(1)


def sources(root):
    """The sources of lib/pel_files.cmake in their order, which must be all that lib/src holds."""
    text = (root / "lib/pel_files.cmake").read_text(encoding="utf-8")
    listed = SOURCE.findall(re.sub(r"#.*", "", text))
    there = {path.relative_to(root / "lib").as_posix() for path in source_files(root)
             if path.suffix != ".h"}
    if len(set(listed)) != len(listed):
        raise Problem("pel_files.cmake lists a source twice")
    if set(listed) != there:
        raise Problem("pel_files.cmake and lib/src differ in "
                      f"{', '.join(sorted(set(listed) ^ there)) or 'nothing: no sources'}")
    if not listed or not all(name.endswith(".c") for name in listed):
        raise Problem("lib/src holds something else than .c and .h, or nothing")
    return [root / "lib" / name for name in listed]


def source_files(root):
    return sorted(path for path in (root / "lib/src").rglob("*") if path.is_file())


def private_headers(root):
    return [path for path in source_files(root) if path.suffix == ".h"]


def public_headers(root):
    return sorted((root / "lib/include").rglob("*.h"))
