#!/usr/bin/env python3
"""amalgamate.py on a project of a few lines that holds what is hard to join: the same private names
in several sources, variants for machines under #if, private headers under conditions, templates.
And what cannot be joined is refused by name.

    check_amalgamate.py OUT_DIR
"""
import sys

from packagetest import AMALGAMATE, CC, PYTHON, WARNINGS, check, finish, fresh, run, step

LIST = """set(PEL_LIB_DIR ${CMAKE_CURRENT_LIST_DIR})
# ${PEL_LIB_DIR}/src/gone.c is history
set(PEL_SOURCES
    ${PEL_LIB_DIR}/src/row/row_c.c
    ${PEL_LIB_DIR}/src/row/row_fast.c
    ${PEL_LIB_DIR}/src/row/row_faster.c
    ${PEL_LIB_DIR}/src/module.c)
"""

PUBLIC = """#ifndef PEL_H
#define PEL_H
#include "pel/version.h"
#ifdef __cplusplus
extern "C" {
#endif
int pel_answer(int limit);
#ifdef __cplusplus
}
#endif
#endif
"""

VERSION = """#ifndef PEL_VERSION_H
#define PEL_VERSION_H
#define PEL_VERSION "1.2.3"
#endif
"""

ROW = """#ifndef PEL_ROW_H
#define PEL_ROW_H
#if defined(FAST) || defined(FASTER)
#define PEL_ROW_VARIANT
#endif
typedef struct pair {
    int step, lanes;
    int (*add)(int);
} pair;
int pel_row_sum(int a);
int pel_row_scale(int a);
static inline int twice(int a) { return 2 * a; }
#endif
"""

ROW_WIDE = """#ifndef PEL_ROW_WIDE_H
#define PEL_ROW_WIDE_H
#include "row/row.h"
enum { WIDE = sizeof(long long) };
#endif
"""

ROW_NEAR = """#ifndef PEL_ROW_NEAR_H
#define PEL_ROW_NEAR_H
enum { NEAR = 1 };
#endif
"""

ROW_C = """#include "row/row.h"
#include "row/row_near.h"
#include <stdint.h>
#ifndef PEL_ROW_VARIANT
#define STEP 1
enum { LANES = 1 };
static int add(int a) { return a + STEP * LANES * NEAR; }
int pel_row_sum(int a) { return add(a); }
#endif
int pel_row_scale(int a)
{
    int wide = twice(a);
    return (int)(int32_t)wide;
}
"""

# A variant: its names are those of the others, and its header and intrinsics are for it alone.
ROW_FAST = """#include "row/row.h"
#ifdef %(macro)s
#include "row/row_wide.h"
#include <limits.h>
#include <stdint.h>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-macros"
#define STEP %(step)s
#define FUNCTION __attribute__((noinline)) LOCAL
#define LOCAL static
enum { LANES = 4 };
typedef int (*adder)(int);
static const uint8_t table[2] __attribute__((aligned(4))) = {STEP, LANES};
#include "row/row_template.h"
int pel_row_sum(int a)
{
    const adder use = add;
    return use(a) + WIDE - WIDE + CHAR_BIT - CHAR_BIT;
}
#pragma GCC diagnostic pop
#endif
"""

# A part of each variant, which says what its words mean.
ROW_TEMPLATE = """/* table has two elements */
FUNCTION int add(int a) { return a + table[0] * table[1]; }
"""

MODULE = """#include "pel.h"
#include "row/row.h"
#include "row/row_wide.h"
typedef int (*adder)(int);
typedef struct tools {
    int adder;
    int (*add)(int);
} tools;
static int (*const adders[])(int) = {pel_row_sum, pel_row_scale};
static int add(int a) { return adders[0](a); }
int pel_answer(int limit)
{
    const pair p = {.step = 1, .lanes = WIDE / WIDE, .add = add};
    const adder scale = adders[1];
    const tools own = {.adder = 1, .add = scale};
    return own.add(p.add(limit)) + p.step - own.adder;
}
"""

FILES = {
    "LICENSE": "As you like.\n",
    "lib/pel_files.cmake": LIST,
    "lib/include/pel.h": PUBLIC,
    "lib/include/pel/version.h": VERSION,
    "lib/src/row/row.h": ROW,
    "lib/src/row/row_wide.h": ROW_WIDE,
    "lib/src/row/row_near.h": ROW_NEAR,
    "lib/src/row/row_template.h": ROW_TEMPLATE,
    "lib/src/row/row_c.c": ROW_C,
    "lib/src/row/row_fast.c": ROW_FAST % {"macro": "FAST", "step": 2},
    "lib/src/row/row_faster.c": ROW_FAST % {"macro": "FASTER", "step": 3},
    "lib/src/module.c": MODULE,
}
USER = """#include <stdio.h>
#include "pel.h"
int main(void)
{
    printf("%d\\n", pel_answer(10));
    return 0;
}
"""
# {what: (file, old text or None to append, new text, what the refusal must say)}
REFUSED = {
    "the same function twice": ("src/module.c", None, "int pel_row_scale(int a) { return a; }\n",
                                "pel_row_scale"),
    "the same function twice, once under a condition": (
        "src/module.c", None, "#ifdef FAST\nint pel_row_scale(int a) { return a; }\n#endif\n",
        "pel_row_scale"),
    "a function without prefix": ("src/module.c", None, "int answer(void) { return 42; }\n",
                                  "answer"),
    "a macro of a header in another file": ("src/row/row_wide.h", "enum {",
                                            "#define PEL_ROW_VARIANT 2\nenum {", "PEL_ROW_VARIANT"),
    "a macro of the public headers": ("src/module.c", None, "#define PEL_VERSION 3\n",
                                      "PEL_VERSION"),
    "a new name that is taken": ("src/module.c", None, "static int module_add(void)\n{\n"
                                 "    return 0;\n}\n", "module_add"),
    "an unknown header": ("src/module.c", None, '#include "nowhere.h"\n', "nowhere.h"),
    "an unknown template": ("src/module.c", None, '#include "no_template.h"\n', "no_template.h"),
    "a header named by a macro": ("src/module.c", None, "#include WHERE\n", "WHERE"),
    "a header without a guard": ("src/row/row_wide.h", "#ifndef",
                                 "#if !defined(X)\n#endif\n#ifndef", "row_wide.h"),
    "a header that a source configures": ("src/row/row_wide.h", "WIDE = ", "STEP, WIDE = ", "STEP"),
    "a bracket in both branches": ("src/module.c", None, "static void f(int a)\n{\n#ifdef A\n"
                                   "    if (a) {\n#else\n    if (!a) {\n#endif\n    }\n}\n",
                                   "module.c"),
    "an #if without end": ("src/module.c", None, "#if 1\n", "module.c"),
    "a pragma for the rest of the file": ("src/row/row_c.c", None, '#pragma GCC target("avx2")\n',
                                          "row_c.c"),
    "a pragma that is not popped": ("src/row/row_fast.c", "#pragma GCC diagnostic pop\n", "",
                                    "row_fast.c"),
    "intrinsics behind a foreign macro": (
        "src/row/row_near.h", "enum { NEAR = 1 };", "#define NEAR 1", "behind the macros NEAR"),
    "a source that is not listed": ("src/left_out.c", None, "\n", "left_out.c"),
    "a source that is not there": ("pel_files.cmake", "module.c)",
                                   "module.c ${PEL_LIB_DIR}/src/none.c)", "none.c"),
    "a source listed twice": ("pel_files.cmake", "module.c)",
                              "module.c ${PEL_LIB_DIR}/src/module.c)", "twice"),
    "a kind of file that no package takes": ("src/table.inc", None, "1, 2\n", "table.inc"),
    "a public header that is left out": ("include/pel/more.h", None, "\n", "more.h"),
}


def write_project(folder, files):
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def check_joined(folder):
    """One file computes what the many do, whichever variant the flags choose."""
    tree = write_project(folder / "tree", FILES)
    one = folder / "one"
    if not step("amalgamate", PYTHON, AMALGAMATE, one, "--root", tree):
        return
    (folder / "user.c").write_text(USER)
    separate = [tree / name for name in FILES if name.endswith(".c")]
    for flags, answer in (([], 22), (["-DFAST"], 36), (["-DFASTER"], 44)):
        for what, sources, include in (("many files", separate, tree / "lib/include"),
                                       ("one file", [one / "pel.c"], one)):
            program = folder / "user"
            if step(f"compile {what} {flags}", CC, "-std=c99", *WARNINGS, *flags, f"-I{include}",
                    *([f"-I{tree}/lib/src"] if sources is separate else []), folder / "user.c",
                    *sources, "-o", program):
                result = run(program)
                check(result.stdout == f"{answer}\n", f"{what} {flags} give {answer}",
                      result.stdout)
    wrong = run(CC, "-DFAST", "-DFASTER", f"-I{one}", "-c", one / "pel.c", "-o", folder / "x.o")
    check(wrong.returncode != 0 and "pel_row_sum" in wrong.stdout,
          "two variants at a time do not compile", wrong.stdout)


def check_refused(folder):
    """What cannot be joined is refused, and nothing is written."""
    for number, (what, (name, old, new, expected)) in enumerate(REFUSED.items()):
        path = f"lib/{name}"
        text = FILES.get(path, "")
        if old is not None:
            check(old in text, f"{what}: the text to change is there")
        changed = text + new if old is None else text.replace(old, new)
        tree = write_project(folder / f"tree{number}", dict(FILES, **{path: changed}))
        out = folder / f"refused{number}"
        result = run(PYTHON, AMALGAMATE, out, "--root", tree)
        check(result.returncode == 1 and expected in result.stdout, f"refused: {what}",
              f"status {result.returncode}: {result.stdout}")
        check(result.stdout.startswith("amalgamate.py: ") and not out.exists(),
              f"nothing is written: {what}", result.stdout)


def main():
    folder = fresh("amalgamate")
    check_joined(folder)
    check_refused(folder)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
