#!/usr/bin/env python3
"""The PlatformIO library: its manifest under PlatformIO's own parser and schema, packed by its own
command, and what comes out of the archive compiled with the folders of the manifest.

    check_platformio.py OUT_DIR
"""
import json
import os
import pathlib
import sys

from packagetest import (CC, HERE, PACK, PYTHON, check, finish, fresh, library_sources, run, skip,
                         step, user_line, version)

# PlatformIO looks licences up on the network; this is the part of that list that is needed here.
LICENCES = {"licenses": [{"licenseId": "MIT"}]}
PIO_OFFLINE = f"""
import sys
from platformio.package.manifest.schema import ManifestSchema
ManifestSchema.load_spdx_licenses = staticmethod(lambda: {LICENCES!r})
from platformio.__main__ import main
sys.exit(main(["pio"] + sys.argv[1:]))
"""


def check_manifest(folder):
    try:
        # pylint: disable=import-outside-toplevel
        from platformio.package.manifest.parser import ManifestParserFactory
        from platformio.package.manifest.schema import ManifestSchema, ManifestValidationError
    except ImportError:
        skip("the PyPI package platformio is not here")
        return False
    ManifestSchema.load_spdx_licenses = staticmethod(lambda: LICENCES)
    parsed = ManifestParserFactory.new_from_file(str(folder / "library.json")).as_dict()
    try:
        loaded = ManifestSchema().load_manifest(parsed)
    except ManifestValidationError as error:
        check(False, "PlatformIO's schema accepts library.json", str(error))
        return True
    check(True, "PlatformIO's schema accepts library.json")
    check(loaded["name"] == "pel" and loaded["version"] == version(), "name and version",
          str(loaded))
    check(loaded["headers"] == ["pel.h"] and loaded["license"] == "MIT", "header and licence",
          str(loaded))
    broken = dict(parsed, version="one")
    try:
        ManifestSchema().load_manifest(broken)
        check(False, "the schema refuses a version that is none")
    except ManifestValidationError:
        check(True, "the schema refuses a version that is none")
    return True


def check_packed(folder):
    """`pio pkg pack`, then a program against the unpacked archive."""
    archive = folder / "pel.tar.gz"
    environment = dict(os.environ, PLATFORMIO_SETTING_ENABLE_TELEMETRY="no",
                       PLATFORMIO_SETTING_CHECK_PLATFORMIO_INTERVAL="0")
    if not step("pio pkg pack", PYTHON, "-c", PIO_OFFLINE, "pkg", "pack", folder / "pel", "-o",
                archive, env=environment):
        return
    unpacked = folder / "unpacked"
    unpacked.mkdir()
    if step("unpack", "tar", "xzf", archive, "-C", unpacked):
        compile_user(unpacked, folder)


def compile_user(library, folder):
    """A user's program and all sources below srcDir: PlatformIO compiles with both folders on the
    include path."""
    build = json.loads((library / "library.json").read_text())["build"]
    sources = sorted((library / build["srcDir"]).rglob("*.c"))
    names = [path.relative_to(library / build["srcDir"]).as_posix() for path in sources]
    check(names == sorted(library_sources()), "sources in the package", str(names))
    program = folder / "user"
    if step("compile the package", CC, "-std=c99", f"-I{build['includeDir']}",
            f"-I{build['srcDir']}", *sources, HERE / "user.c", "-o", program, cwd=library):
        result = run(program)
        check(result.returncode == 0 and result.stdout == user_line(), "the user's program",
              result.stdout)


def main():
    folder = fresh("platformio")
    os.environ["PLATFORMIO_CORE_DIR"] = str(folder / "core")  # and not the user's
    package = folder / "pel"
    if step("pack", PYTHON, PACK, "platformio", package):
        names = {path.relative_to(package).as_posix() for path in package.rglob("*")}
        for name in ("library.json", "LICENSE", "README.md", "include/pel.h"):
            check(name in names, f"{name} is in the package", str(sorted(names)))
        check(not [name for name in names if pathlib.Path(name).suffix == ".in"], "no templates")
        compile_user(package, folder)
        if check_manifest(package):
            check_packed(folder)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
