#!/usr/bin/env python3
"""Uses pel in every way that the README offers, each time from outside.

    check_consumer.py OUT_DIR LIBRARY_SOURCE.c...
"""
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ["PEL_SOURCE_DIR"])
HERE = ROOT / "tests/consumer"
CC = os.environ.get("PEL_CC", "cc")
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow",
            "-Wcast-qual", "-Wundef", "-Werror"]
VERSION = re.search(r'PEL_VERSION "([^"]+)"',
                    (ROOT / "lib/include/pel/version.h").read_text()).group(1)

passed = failed = skipped = 0


def check(good, what, detail=""):
    global passed, failed
    if good:
        passed += 1
    else:
        failed += 1
        print(f"wrong: {what}\n{detail}")
    return good


def skip(what):
    global skipped
    skipped += 1
    print(f"skipped: {what}")


def run(*command, **options):
    """Runs a command with its output captured, errors included."""
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False, **options)


def step(what, *command, **options):
    result = run(*command, **options)
    return check(result.returncode == 0, what, result.stdout)


def user_line(classes):
    return f"pel {VERSION}: class {classes} of {classes}, 2 px at x 2\n"


USER_CPP_LINE = f"pel {VERSION}: centroid {6 * 65536 // 4}, {10 * 65536 // 4}\n"


def check_output(what, program, expected):
    if not program.exists():
        return check(False, what, f"there is no {program}")
    result = run(program)
    return check(result.returncode == 0 and result.stdout == expected, what,
                 f"expected {expected!r}, got {result.stdout!r}, status {result.returncode}")


def check_headers(out):
    """Every header alone, twice, as C99 and as C++11, with the full warnings."""
    include = ROOT / "lib/include"
    headers = sorted(path.relative_to(include).as_posix() for path in include.rglob("*.h"))
    check(len(headers) >= 9, "headers found", str(headers))
    compilers = [(name, language, standard)
                 for names, language, standard in ((("gcc", "clang"), "c", "c99"),
                                                   (("g++", "clang++"), "c++", "c++11"))
                 for name in names]
    for name, language, standard in compilers:
        if not shutil.which(name):
            skip(f"headers with {name}: not here")
            continue
        for header in headers:
            source = out / f"header.{'c' if language == 'c' else 'cpp'}"
            source.write_text(f"#include <{header}>\n#include <{header}>\n"
                              "int main(void)\n{\n    return 0;\n}\n")
            step(f"{header} alone, {name} -std={standard}", name, "-x", language,
                 f"-std={standard}", *WARNINGS, f"-I{include}", "-fsyntax-only", source)


def check_subdirectory(out):
    build = out / "subdirectory"
    for classes in (8, 32):
        if (step("add_subdirectory: configure", "cmake", "-S", HERE / "subdirectory", "-B", build,
                 f"-DPEL_SOURCE_DIR_UNDER_TEST={ROOT}", f"-DPEL_CLASS_MAX={classes}",
                 f"-DCMAKE_INSTALL_PREFIX={out}/nothing")
                and step("add_subdirectory: build", "cmake", "--build", build, "--parallel", "2")):
            check_output(f"add_subdirectory, {classes} classes", build / "user_c",
                         user_line(classes))
            check_output("add_subdirectory, C++", build / "user_cpp", USER_CPP_LINE)
            step("add_subdirectory: install", "cmake", "--install", build)
            check(not (out / "nothing").exists(), "add_subdirectory installs nothing of pel")


def install(out, classes):
    """Installs and moves the result, so that nothing in it may know where it was. The new place."""
    build, prefix, moved = (out / f"{name}{classes}" for name in ("build", "prefix", "moved"))
    if not (step("install: configure", "cmake", "-S", ROOT, "-B", build, "-DPEL_BUILD_TESTS=OFF",
                 f"-DPEL_CLASS_MAX={classes}", f"-DCMAKE_INSTALL_PREFIX={prefix}",
                 f"-DCMAKE_C_COMPILER={CC}")
            and step("install: build", "cmake", "--build", build, "--parallel", "2")
            and step("install", "cmake", "--install", build)):
        return None
    prefix.rename(moved)
    return moved


def check_package(out, prefix, classes):
    build = out / f"package{classes}"
    wanted = ".".join(VERSION.split(".")[:2])
    if (step("find_package: configure", "cmake", "-S", HERE / "package", "-B", build,
             f"-DCMAKE_PREFIX_PATH={prefix}", f"-DPEL_VERSION_WANTED={wanted}")
            and step("find_package: build", "cmake", "--build", build, "--parallel", "2")):
        check_output(f"find_package, {classes} classes", build / "user_c", user_line(classes))
        check_output("find_package, C++", build / "user_cpp", USER_CPP_LINE)
    result = run("cmake", "-S", HERE / "package", "-B", out / f"newer{classes}",
                 f"-DCMAKE_PREFIX_PATH={prefix}", "-DPEL_VERSION_WANTED=99.0")
    check(result.returncode != 0, "find_package refuses a version that is not there")


def check_pkg_config(out, prefix, classes):
    if not shutil.which("pkg-config"):
        skip("pkg-config: not here")
        return
    folder = next(prefix.rglob("pel.pc")).parent
    environment = dict(os.environ, PKG_CONFIG_PATH=str(folder))
    flags = run("pkg-config", "--cflags", "--libs", "pel", env=environment)
    check(flags.returncode == 0, "pkg-config", flags.stdout)
    version = run("pkg-config", "--modversion", "pel", env=environment)
    check(version.stdout.strip() == VERSION, "pkg-config --modversion", version.stdout)
    program = out / f"pkg_config{classes}"
    if step("pkg-config: compile", CC, HERE / "user.c", "-o", program, *flags.stdout.split()):
        check_output(f"pkg-config, {classes} classes", program, user_line(classes))
    if classes == 8:
        wrong = run(CC, HERE / "user.c", "-DPEL_CLASS_MAX=16", "-o", program,
                    *flags.stdout.split())
        check(wrong.returncode != 0 and "pel_boxes_set_16" in wrong.stdout,
              "a program for 16 classes does not link with a library for 8", wrong.stdout)


def check_installed_command(prefix):
    if "PEL_COMMAND" not in os.environ:
        skip("the installed command: not built")
        return
    result = run(prefix / "bin/pel", "--help")
    check(result.returncode == 0 and "blobs" in result.stdout, "the installed command",
          result.stdout)


def check_readme(out):
    """The README's program prints what the README says."""
    blocks = re.findall(r"^```(\w*)\n(.*?)^```$", (ROOT / "README.md").read_text(), re.M | re.S)
    programs = [index for index, (language, _) in enumerate(blocks) if language == "c"]
    if not check(len(programs) == 1, "the README has one program", str(len(programs))):
        return
    source = out / "readme.c"
    source.write_text(blocks[programs[0]][1])
    language, expected = blocks[programs[0] + 1]
    check(language == "text", "the README says what the program prints")
    if step("README: compile", CC, "-std=c99", *WARNINGS, f"-I{ROOT}/lib/include",
            f"-I{ROOT}/lib/src", source, *sys.argv[2:], "-o", out / "readme"):
        check_output("README", out / "readme", expected)


def check_readme_commands():
    """The README names every subcommand once, and each of them has a manual."""
    if "PEL_COMMAND" not in os.environ:
        skip("the README's commands: not built")
        return
    command = os.environ["PEL_COMMAND"]
    readme = (ROOT / "README.md").read_text()
    lines = re.findall(r"^    pel (\w+)", readme, re.M)
    twice = sorted({name for name in lines if lines.count(name) > 1})
    check(not twice, "commands that the README names more than once", str(twice))
    named = set(lines)
    usage, rest = run(command, "--help").stdout.split("FILE...\n\n")
    listed = set(re.findall(r"^  (\w+) ", rest.split("\n\n")[0], re.M))
    sources = {path.stem[4:] for path in (ROOT / "tools").glob("cmd_*.c")}
    check(named == listed and listed == sources and len(named) >= 5, "commands of the README",
          f"named {sorted(named)}, listed {sorted(listed)}, written {sorted(sources)}")
    for name in sorted(listed):
        result = run(command, name, "--help")
        check(result.returncode == 0 and f"pel {name}" in result.stdout, f"pel {name} --help",
              result.stdout)
    check_readme_budget(command, readme)
    check_readme_convert(command, readme)


def check_readme_budget(command, readme):
    """The README's `pel budget` gives its table's RAM, but for the pointers of this machine."""
    words = re.search(r"`pel (budget 320x240 [^`]*)`", readme).group(1).split()
    here, there = map(int, re.search(r"the finder is (\d+) bytes\s+with 64-bit pointers and (\d+) "
                                     r"on Cortex-M", readme).groups())
    table = set(re.search(r"^\| RAM for blobs, 320x240[^|]*\|(.*)\|$", readme, re.M)
                .group(1).replace(" ", "").split("|"))
    result = run(command, *words, "--csv")
    parts = dict(re.findall(r"^(.*),(\d+)$", result.stdout, re.M))
    check(result.returncode == 0 and "sum" in parts, "pel budget as the README has it",
          result.stdout)
    if struct.calcsize("P") == 8:
        check(int(parts["finder"]) == here, "the README's finder", result.stdout)
    ram = int(parts["sum"]) - int(parts["finder"]) + there
    check(table == {str(ram)}, "the README's RAM", f"table {sorted(table)}, pel budget {ram}")


def check_readme_convert(command, readme):
    """The README's `pel convert` line takes the demo's picture."""
    words = re.search(r"^    pel (convert .*?)  ", readme, re.M).group(1).split()
    with tempfile.TemporaryDirectory() as folder:
        given = pathlib.Path(folder) / next(word for word in words if word.endswith(".png"))
        shutil.copy(ROOT / "tools/demo/annotated.png", given)
        result = run(command, *words, cwd=folder)
        check(result.returncode == 0, "pel convert as the README has it", result.stdout)


def main():
    out = pathlib.Path(sys.argv[1]).resolve() / "work"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    check_headers(out)
    check_subdirectory(out)
    for classes in (8, 16):
        prefix = install(out, classes)
        if prefix:
            check_package(out, prefix, classes)
            check_pkg_config(out, prefix, classes)
            check_installed_command(prefix)
    check_readme(out)
    check_readme_commands()
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed or passed == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
