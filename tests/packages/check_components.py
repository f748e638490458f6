#!/usr/bin/env python3
"""The ESP-IDF component and the Zephyr module: their CMake files run with stand-ins for the
functions of the two systems, and a user's program is compiled from exactly what was registered.

    check_components.py OUT_DIR
"""
import sys

from packagetest import (CC, HERE, PACK, PYTHON, check, finish, fresh, library_sources, run, skip,
                         step, user_line, version)

REGISTERED = {"sources", "include", "private"}


def record(what, script, package, out, *definitions):
    """What the CMake file told the stand-ins, as {kind: [values]}; None if it failed."""
    if not step(what, "cmake", f"-DCOMPONENT={package}", f"-DOUT={out}",
                *(f"-D{definition}" for definition in definitions), "-P", HERE / script):
        return None
    lines = [line.split(";") for line in out.read_text().splitlines()]
    return {words[0]: words[1:] for words in lines}


def compile_user(what, told, package, classes):
    """The registered sources, each with the private folders; the program with the public ones."""
    public = [f"-I{path}" for path in told["include"]] + \
        [f"-D{word}" for word in told.get("definitions", [])]
    private = [f"-I{path}" for path in told["private"]]
    objects = []
    folder = package.parent
    check(told["sources"] == [f"{package}/lib/src/{name}" for name in library_sources()],
          f"{what}: the sources", str(told))
    for source in told["sources"]:
        objects.append(folder / f"{len(objects)}.o")
        step(f"{what}: {source}", CC, "-std=c99", "-c", *public, *private, source, "-o",
             objects[-1])
    program = folder / "user"
    if step(f"{what}: the user's program", CC, "-std=c99", *public, HERE / "user.c", *objects, "-o",
            program):
        result = run(program)
        check(result.stdout == user_line(), f"{what}: it runs", result.stdout)
        symbols = run("nm", program).stdout.split()
        name = "pel_boxes_set" if classes == 8 else f"pel_boxes_set_{classes}"
        check(name in symbols, f"{what}: library and program agree on {classes} classes")


def check_esp_idf():
    folder = fresh("esp-idf")
    package = folder / "pel"
    if not step("pack esp-idf", PYTHON, PACK, "esp-idf", package):
        return
    for classes, definitions in ((8, []), (16, ["PEL_CLASS_MAX=16"])):
        told = record(f"ESP-IDF, {classes} classes", "record_esp_idf.cmake", package,
                      folder / "told", *definitions)
        if told and check(REGISTERED <= set(told), "ESP-IDF: registered", str(told)):
            compile_user("ESP-IDF", told, package, classes)
    check_idf_manifest(package)


def check_idf_manifest(package):
    """idf_component.yml under Espressif's own component manager, also when it is wrong."""
    try:
        # pylint: disable=import-outside-toplevel
        from idf_component_tools.errors import ManifestError
        from idf_component_tools.manager import ManifestManager
    except ImportError:
        skip("the PyPI package idf-component-manager is not here")
        return
    try:
        manifest = ManifestManager(str(package), "pel").load()
        check(str(manifest.version) == version(), "ESP-IDF: the version", str(manifest.version))
    except ManifestError as error:
        check(False, "Espressif's component manager accepts idf_component.yml", str(error))
    file = package / "idf_component.yml"
    file.write_text(file.read_text().replace(f'"{version()}"', '"one"'))
    try:
        ManifestManager(str(package), "pel").load()
        check(False, "Espressif's component manager refuses a version that is none")
    except ManifestError:
        check(True, "Espressif's component manager refuses a version that is none")


def check_kconfig(path):
    """Zephyr's Kconfig under kconfiglib: the choice of classes becomes the number."""
    try:
        import kconfiglib  # pylint: disable=import-outside-toplevel
    except ImportError:
        skip("the PyPI package kconfiglib is not here")
        return
    config = kconfiglib.Kconfig(str(path), warn_to_stderr=False)
    check(config.syms["PEL"].str_value == "n", "pel is off until it is asked for")
    config.syms["PEL"].set_value("y")
    for classes in (8, 16, 32):
        if classes != 8:
            config.syms[f"PEL_CLASS_{classes}"].set_value("y")
        check(config.syms["PEL_CLASS_MAX"].str_value == str(classes),
              f"Kconfig gives {classes} classes", config.syms["PEL_CLASS_MAX"].str_value)
    check(not config.warnings, "Kconfig without warnings", str(config.warnings))


def check_module(package):
    """module.yml names files that are there."""
    lines = (package / "zephyr/module.yml").read_text().splitlines()
    stated = dict(line.strip().split(": ", 1) for line in lines if ": " in line)
    check(stated.get("name") == "pel", "module.yml: the name", str(stated))
    check((package / stated.get("cmake", "?") / "CMakeLists.txt").is_file(), "module.yml: cmake")
    check((package / stated.get("kconfig", "?")).is_file(), "module.yml: kconfig")


def check_zephyr():
    folder = fresh("zephyr")
    package = folder / "pel"
    if not step("pack zephyr", PYTHON, PACK, "zephyr", package):
        return
    check_module(package)
    check_kconfig(package / "zephyr/Kconfig")
    told = record("Zephyr, off", "record_zephyr.cmake", package, folder / "told")
    check(told == {}, "Zephyr: nothing is built unless CONFIG_PEL is set", str(told))
    for classes in (8, 32):
        told = record(f"Zephyr, {classes} classes", "record_zephyr.cmake", package, folder / "told",
                      "CONFIG_PEL=y", f"CONFIG_PEL_CLASS_MAX={classes}")
        if told and check(REGISTERED <= set(told), "Zephyr: registered", str(told)):
            compile_user("Zephyr", told, package, classes)


def main():
    check_esp_idf()
    check_zephyr()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
