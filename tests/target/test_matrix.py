#!/usr/bin/env python3
"""matrix.py must see what is wrong: each way in which a cell can go bad, with made-up output."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import matrix  # noqa: E402

GOOD = "a.c:1:test_a:PASS\n1 Tests 0 Failures 0 Ignored\nvalues 3, hash {}, stack 8 of 64\n{}\n"
ONE, OTHER = "0123456789ABCDEF", "0123456789ABCDE0"


def column(name, **cells):
    return matrix.Column(matrix.Machine(name, [], [], ""), dict(cells), 0, [], (0, 0))


class ReadingASuite(unittest.TestCase):
    def test_good(self):
        cell = matrix.read_suite(GOOD.format(ONE, "1 passed, 0 failed"), True)
        self.assertEqual((cell.hash, cell.remark), (ONE, ""))

    def test_failures_are_named(self):
        output = "a.c:7:test_a:FAIL: no\n" + GOOD.format(ONE, "1 passed, 1 failed")
        cell = matrix.read_suite(output, False)
        self.assertIsNone(cell.hash)
        self.assertIn("a.c:7:test_a:FAIL", cell.remark)

    def test_bad_end_after_a_good_closing_line(self):
        output = GOOD.format(ONE, "1 passed, 0 failed") + "guard words smashed below the stack\n"
        cell = matrix.read_suite(output, False)
        self.assertIsNone(cell.hash)
        self.assertIn("guard words smashed", cell.remark)

    def test_cut_short(self):
        for output in ("", "a.c:1:test_a:PASS\n", GOOD.format(ONE, "")):
            cell = matrix.read_suite(output, True)
            self.assertIsNone(cell.hash, output)
            self.assertIn("before it was done", cell.remark)

    def test_nothing_ran(self):
        for output in (GOOD.format(ONE, "0 passed, 0 failed"),
                       GOOD.format(ONE, "1 passed, 0 failed").replace("values 3", "values 0")):
            self.assertEqual(matrix.read_suite(output, True), matrix.Cell(remark="ran nothing"))


class Comparing(unittest.TestCase):
    def fill(self, columns, excused=None):
        matrix.fill_and_compare(columns, ["blobs"], excused or {})
        with contextlib.redirect_stdout(io.StringIO()) as self.text:
            return matrix.print_table(columns, ["blobs"])

    def test_all_agree(self):
        columns = [column("host", blobs=matrix.Cell(ONE)), column("m0", blobs=matrix.Cell(ONE))]
        self.assertEqual(self.fill(columns), (2, 0, 0))

    def test_one_bit_of_difference(self):
        columns = [column("host", blobs=matrix.Cell(ONE)), column("m0", blobs=matrix.Cell(OTHER))]
        self.assertEqual(self.fill(columns), (1, 1, 0))
        self.assertIn("FAIL [1]", self.text.getvalue())
        self.assertIn(OTHER, self.text.getvalue())

    def test_a_missing_cell_is_a_failure_without_a_reason(self):
        self.assertEqual(self.fill([column("host", blobs=matrix.Cell(ONE)), column("m0")]),
                         (1, 1, 0))
        self.assertIn("did not run", self.text.getvalue())

    def test_a_missing_cell_with_a_reason(self):
        columns = [column("host", blobs=matrix.Cell(ONE)), column("m0")]
        self.assertEqual(self.fill(columns, {("m0", "blobs"): "too large"}), (1, 0, 1))
        self.assertIn("too large", self.text.getvalue())

    def test_a_reason_for_what_ran_is_a_failure(self):
        columns = [column("host", blobs=matrix.Cell(ONE)), column("m0", blobs=matrix.Cell(ONE))]
        self.assertEqual(self.fill(columns, {("m0", "blobs"): "too large"}), (1, 1, 0))


class Machines(unittest.TestCase):
    def test_every_file_is_a_machine_and_host_is_first(self):
        known = matrix.machines()
        self.assertEqual(next(iter(known)), "host")
        files = list(matrix.TARGET.glob("machines/*.cmake")) + list(matrix.BOARDS.glob("*.cmake"))
        self.assertEqual(sorted(known), sorted(path.stem for path in files))
        for machine in known.values():
            self.assertTrue(all(machine.programs) and machine.note, machine.name)
        self.assertEqual(known["microbit"].programs, ["arm-none-eabi-gcc", "qemu-system-arm"])
        self.assertEqual(known["s390x-linux"].programs, ["s390x-linux-gnu-gcc", "qemu-s390x"])

    def test_missing_programs_are_told(self):
        known = {"host": matrix.Machine("host", [], ["no-such-compiler"], "")}
        self.assertEqual(matrix.choose(known, []), ([], [("host", "no-such-compiler")]))

    def test_reasons_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "absent.csv"
            path.write_text("machine,suite,reason\nm0,blobs,\"too large, by far\"\n")
            self.assertEqual(matrix.excuses(path), {("m0", "blobs"): "too large, by far"})


if __name__ == "__main__":
    result = unittest.TextTestRunner(stream=sys.stdout).run(
        unittest.defaultTestLoader.loadTestsFromModule(sys.modules[__name__]))
    failed = len(result.failures) + len(result.errors)
    print(f"{result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed or not result.testsRun else 0)
