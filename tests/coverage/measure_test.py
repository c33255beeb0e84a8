"""What counts as a line or a branch that was reached (tests/coverage/measure.py)."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import measure  # noqa: E402


def line(number, count, branches=()):
    return {"line_number": number, "count": count,
            "branches": [{"count": of, "throw": thrown, "fallthrough": False} for of, thrown in branches]}


def report(file, *lines):
    return {"files": [{"file": file, "lines": list(lines)}]}


class Coverage(unittest.TestCase):
    def test_lines_of_several_units_are_the_same_lines(self):
        sums = measure.sums_of(*measure.counts_of([report("gum/a.h", line(1, 0), line(2, 0)), report("gum/a.h", line(1, 3))]))
        self.assertEqual(sums, {"gum": [2, 1, 0, 0]})

    def test_ways_of_exceptions_are_no_branches(self):
        counted = measure.counts_of([report("gum/a.cpp", line(1, 2, [(2, False), (0, False), (0, True)]), line(2, 1, [(1, False), (0, True)]))])
        self.assertEqual(measure.sums_of(*counted), {"gum": [2, 2, 2, 1]})

    def test_ways_in_code_that_only_an_exception_reaches_are_no_branches(self):
        text = ("        -:    0:Source:gum/a.cpp\n        -:    7:// nothing\n        4:    8:    return a ? text(1) : text(2);\n"
                "branch  0 taken 3 (fallthrough)\nbranch  1 taken 0\n        3:    8-block  0\ncall    2 returned 3\n    $$$$$:    8-block  1\n"
                "branch  3 never executed\nbranch  4 never executed\n    %%%%%:    8-block  2\nbranch  5 never executed\nbranch  6 never executed\n")
        ways = measure.ways_of_text(text)
        self.assertEqual(ways["gum/a.cpp", 8], [[(3, False), (0, False), (0, True), (0, True), (0, False), (0, False)]])

        def sums(*counts):
            marked = measure.without_exceptional(report("gum/a.cpp", line(8, 4, [(count, False) for count in counts])), ways)
            return measure.sums_of(*measure.counts_of([marked]))["gum"]

        self.assertEqual(sums(3, 0, 0, 0, 0, 0), [1, 1, 4, 1])
        self.assertEqual(sums(2, 1, 0, 0, 0, 0), [1, 1, 6, 2], "another instance, of which the text says nothing")

    def test_a_closing_bracket_is_no_condition(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "gum/a.cpp"
            source.parent.mkdir()
            source.write_text("if (a ||\n    b) {\n    c();\n    }\n});\n", encoding="utf-8")
            ways = [(1, False), (0, False)]
            counted = measure.counts_of([report("gum/a.cpp", *(line(number, 1, ways) for number in (1, 2, 3, 4, 5)))], pathlib.Path(folder))
        self.assertEqual(sorted(counted[1]["gum/a.cpp"]), [1, 2, 3])

    def test_instances_of_a_template_are_one(self):
        counted = measure.counts_of([report("gum/a.cpp", line(1, 1, [(1, False), (0, False)]), line(1, 1, [(0, False), (1, False)]))])
        self.assertEqual(measure.sums_of(*counted), {"gum": [1, 1, 2, 2]})

    def test_sources_of_others_and_tests_do_not_count(self):
        counted = measure.counts_of([report("/usr/include/vector", line(1, 1)), report("tests/unit/a_test.cpp", line(1, 1)),
                                     report(str(measure.ROOT / "json/step.cpp"), line(1, 1))])
        self.assertEqual(measure.sums_of(*counted), {"json": [1, 1, 0, 0]})

    def test_the_page_is_made_from_the_table(self):
        page = measure.PAGE.read_text(encoding="utf-8")
        self.assertEqual(page, measure.page_of(measure.known_rows()), "run scripts/coverage, change neither by hand")


if __name__ == "__main__":
    unittest.main()
