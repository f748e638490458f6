"""What the tests of the packages share: checks that are counted, and commands that are run."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(os.environ["PEL_SOURCE_DIR"])
HERE = pathlib.Path(__file__).resolve().parent
PACK = ROOT / "tools/dev/pack.py"
AMALGAMATE = ROOT / "tools/dev/amalgamate.py"
UNITY_CONFIG = ROOT / "tests/target"  # Unity for machines without a C library
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow",
            "-Wcast-qual", "-Wundef", "-Werror"]
CC = os.environ.get("PEL_CC", "cc")
PYTHON = os.environ.get("PEL_PYTHON", sys.executable)

KINDS = ("arduino", "platformio", "esp-idf", "zephyr", "single-file")

passed = failed = skipped = 0


def check(good, what, detail=""):
    global passed, failed
    if good:
        passed += 1
    else:
        failed += 1
        print(f"wrong: {what}\n{detail[:1500]}")
    return bool(good)


def skip(what):
    global skipped
    skipped += 1
    print(f"skipped: {what}")


def run(*command, **options):
    """Runs a command with its output captured, errors included; a missing program is a failure."""
    options = {"timeout": 300, **options}
    try:
        return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", check=False,
                              **options)
    except (FileNotFoundError, subprocess.TimeoutExpired) as error:
        return subprocess.CompletedProcess(command, 127, str(error))


def step(what, *command, **options):
    result = run(*command, **options)
    return check(result.returncode == 0, what, result.stdout)


def have(*programs):
    """Whether all programs are here; says what is missing and counts it as skipped."""
    missing = [program for program in programs if not shutil.which(program)]
    if missing:
        skip(f"{', '.join(missing)} not here")
    return not missing


def version():
    """As pel/version.h states it."""
    text = (ROOT / "lib/include/pel/version.h").read_text()
    return re.search(r'^#define PEL_VERSION "([^"]+)"$', text, re.M).group(1)


def library_sources():
    """The sources below lib/src in their order, as CMake reads them in pel_files.cmake."""
    told = run("cmake", "-P", HERE / "print_sources.cmake")
    prefix = f"{ROOT}/lib/src/"
    names = told.stdout.split()
    check(told.returncode == 0 and names and all(name.startswith(prefix) for name in names),
          "CMake reads pel_files.cmake", told.stdout)
    return [name[len(prefix):] for name in names]


def user_line():
    """What the program user.c prints."""
    return f"pel {version()}: 1 blob, 4 px, blurred 4\n"


def fresh(name):
    """An empty folder below the one that the command line names."""
    folder = pathlib.Path(sys.argv[1]).resolve() / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def unity_folder():
    """Where the build put the sources of Unity."""
    return pathlib.Path(sys.argv[2])


def unit_suites():
    suites = sorted((ROOT / "tests/unit").glob("test_*.c"))
    check(suites, "unit suites found")
    return suites


def avr_simulator(folder):
    """The program that runs AVR programs, compiled; None if what it takes is not here."""
    if not have("avr-gcc", "gcc"):
        return None
    headers = run("gcc", "-E", "-", input="#include <simavr/sim_avr.h>\n#include <libelf.h>\n")
    if headers.returncode != 0:
        skip("the headers of simavr or libelf are not here")
        return None
    program = folder / "avr_run"
    if step("the simulator", "gcc", "-O2", "-std=c99", HERE / "avr/run.c", "-o", program,
            "-lsimavr", "-lelf"):
        return program
    return None


UNITY_SUMMARY = re.compile(r"(\d+) Tests (\d+) Failures (\d+) Ignored")


def check_suite(what, result):
    """A Unity program's output: every test of it counts."""
    global passed, failed, skipped
    summary = UNITY_SUMMARY.search(result.stdout)
    if not summary:
        return check(False, f"{what}: ran to its end", result.stdout)
    tests, wrong, ignored = (int(number) for number in summary.groups())
    if wrong or tests == 0:
        print(f"wrong: {what}\n" + "\n".join(line for line in result.stdout.splitlines()
                                              if ":FAIL" in line or " Tests " in line))
    passed += tests - wrong - ignored
    failed += wrong + (tests == 0)
    skipped += ignored
    return wrong == 0


def finish():
    """The closing line and the exit status. Nothing at all is a failure; skips are seen by all."""
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed or passed + skipped == 0 else 0
