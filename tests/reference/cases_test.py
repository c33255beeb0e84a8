#!/usr/bin/env python3
"""`gumcert self-test` fails where it must on the published cases, and so does the check of their shape.

    cases_test.py PROGRAM [--all]

Every expected value of a case is moved just beyond its tolerance, in its last digits, and must be refused; one that
passes all the same was never compared. One case a topic, or with --all every case. Beside that: cases that are not as they
should be.
"""

import copy
import io
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from decimal import Decimal

import check_cases

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = ROOT / "tests" / "reference" / "cases"


def last_digit(printed):
    """A unit of the last printed digit: "1.60E-3" → 0.00001."""
    return Decimal(1).scaleb(Decimal(printed.replace(" ", "")).as_tuple().exponent)


def expected_value(entry):
    """The number, truth or text of an entry; numbers may be printed with spaces between their digits."""
    value = entry["printed"] if "printed" in entry else entry["computed"]
    try:
        return float(value.replace(" ", "")) if isinstance(value, str) else value
    except ValueError:
        return value


def tolerance_of(entry):
    if "tolerance" in entry:
        return entry["tolerance"]
    if "relative_tolerance" in entry:
        return entry["relative_tolerance"] * abs(expected_value(entry))
    return 0.5 * float(last_digit(entry["printed"]))


def spoiled(entry):
    """The entry with a value that is as far away as two and a half tolerances, at least: found cannot agree with it, as
    it agrees with the true one."""
    entry = copy.deepcopy(entry)
    key = "printed" if "printed" in entry else "computed"
    value = expected_value(entry)
    if isinstance(value, bool):
        entry[key] = not value
    elif isinstance(value, str):
        entry[key] = value + "0"
    elif isinstance(entry.get("tolerance"), str):  # some numerical errors of the trials: far below a tenth
        entry[key] = 1.1 * value + (value == 0.0)
    elif math.isfinite(value):
        tolerance = tolerance_of(entry)
        if key == "printed":  # whole units of the last digit
            unit = last_digit(entry[key])
            units = max(1, math.ceil(2.5 * tolerance / float(unit)))
            entry[key] = str(Decimal(entry[key].replace(" ", "")) + units * unit)
        else:
            entry[key] = value + 2.5 * tolerance + 1e-15 * abs(value)
    else:
        entry[key] = "1"
    return entry


def one_case_a_topic():
    """That with the fewest jobs."""
    chosen = {}
    for path in sorted(CASES.glob("*.json")):
        case = json.loads(path.read_text(encoding="utf-8"))
        chosen.setdefault(case["topic"], []).append((len(case["jobs"]), path.stem))
    return [min(cases)[1] for cases in chosen.values()]


class Case(unittest.TestCase):
    program, all_cases = None, False

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.share = self.folder / "share"
        (self.share / "reference_cases").mkdir(parents=True)
        (self.share / "templates").symlink_to(ROOT / "templates")

    def case(self, name):
        return json.loads((CASES / f"{name}.json").read_text(encoding="utf-8"))

    def put(self, name, case):
        text = case if isinstance(case, str) else json.dumps(case)
        (self.share / "reference_cases" / f"{name}.json").write_text(text, encoding="utf-8")

    def self_test(self):
        ended = subprocess.run([self.program, "self-test", "--share", self.share, "-o", self.folder / "out"],
                               capture_output=True, text=True, encoding="utf-8", check=False, cwd=self.folder)
        report = self.folder / "out" / "self-test.json"
        return ended, json.loads(report.read_text(encoding="utf-8")) if report.exists() else None


class SelfTest(Case):
    def test_every_expected_value_is_compared(self):
        names = [path.stem for path in sorted(CASES.glob("*.json"))] if self.all_cases else one_case_a_topic()
        counts = {}
        for name in names:
            case = self.case(name)
            case["expected"] = [spoiled(entry) for entry in case["expected"] if "found" in entry]
            counts[name] = len(case["expected"])
            self.put(name, case)
        ended, report = self.self_test()
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertEqual({one["case"]: len(one["values"]) for one in report["cases"]}, counts)
        for one in report["cases"]:
            for value in one["values"]:
                with self.subTest(f"{one['case']}: {value['quantity']} {value['kind']}"):
                    self.assertFalse(value["agrees"], value)
                    self.assertIn(", expected ", value["because"])

    def test_one_spoiled_digit_fails_and_is_named(self):
        name = "gum-522-series-resistors-uncorrelated"
        case = self.case(name)
        place = next(i for i, entry in enumerate(case["expected"]) if entry["kind"] == "u" and "printed" in entry)
        case["expected"][place] = spoiled(case["expected"][place])
        self.put(name, case)
        self.put("iso11929-4-ex6", self.case("iso11929-4-ex6"))
        ended, report = self.self_test()
        self.assertEqual(ended.returncode, 1)
        self.assertRegex(ended.stdout, f"(?m)^FAIL  {name}  ")
        self.assertRegex(ended.stdout, "(?m)^pass  iso11929-4-ex6  ISO 11929-4:2022, example 6, Table 1  2 of 2 values$")
        self.assertIn(f"{name} — {case['expected'][place]['quantity']} u: ", ended.stderr)
        self.assertIn("[GC-SELF-0003]", ended.stderr)
        self.assertIn("1 of 2 cases pass", ended.stdout)
        self.assertFalse(report["passes"])
        self.assertFalse(report["reference_cases"]["of_this_release"])

    def test_a_refused_job_and_files_that_are_no_case_are_failures(self):
        case = self.case("gum-522-series-resistors-uncorrelated")
        case["jobs"]["law"]["model"] = ["Rref = "]
        self.put("refused", case)
        self.put("empty", {**case, "expected": []})
        self.put("torn", json.dumps(case)[:100])
        ended, report = self.self_test()
        self.assertEqual(ended.returncode, 1)
        self.assertEqual([one["passes"] for one in report["cases"]], [False] * 3)
        self.assertIn("job law: ", report["cases"][1]["values"][0]["because"])

    def test_nothing_to_run_is_no_success(self):
        ended, report = self.self_test()
        self.assertEqual(ended.returncode, 5)
        self.assertIsNone(report)
        self.assertIn("[GC-STORE-0016]", ended.stderr)


class Check(Case):
    def breaches(self, change):
        case = self.case("gum-h3-thermometer")
        change(case)
        return list(check_cases.breaches_of_case(case))

    def test_the_cases_as_they_are(self):
        self.assertEqual(self.breaches(lambda case: None), [])

    def test_each_breach_is_said(self):
        def entry(**changes):
            def change(case):
                first = case["expected"][0]
                first.update(changes)
                for key in [key for key, value in changes.items() if value is None]:
                    del first[key]
            return change

        for said, change in (
                ("the case has the key procedure", lambda case: case.update(procedure="fit")),
                ("the case has no checked_by", lambda case: case.pop("checked_by")),
                ("source: seen is one of", lambda case: case["source"].update(seen="maybe")),
                ("place_unverified where it is recalled", lambda case: case["source"].update(seen="recalled")),
                ("no value is compared", lambda case: case.update(expected=[])),
                ("either printed or computed", entry(computed=1.0)),
                ("either printed or computed", entry(printed=None)),
                ("says in not_compared why", entry(not_compared="because")),
                ("says in not_compared why", entry(found=None)),
                ("one tolerance is enough", entry(tolerance=1.0, relative_tolerance=0.1)),
                ("a tolerance is a positive number", entry(tolerance=-1.0)),
                ("a tolerance is a positive number", entry(tolerance="wide")),
                ("a computed number needs a tolerance", entry(printed=None, computed=1.0)),
                ("is no number, so that it has no tolerance", entry(printed="1.2(3)", tolerance=1.0)),
                ("printed is of the wrong type", entry(printed=-0.1712)),
                ("has the key publisched", entry(publisched="1")),
                ("there is no job, and no data, line", entry(found="line/results/y1/value")),
                ("there is no job, and no data, data/q", entry(found="{data/q/0} + 1")),
                ("job more: no value is found in its record", lambda case: case["jobs"].update(more={})),
                ("job more: there is no job none before it", lambda case: case["jobs"].update(more={"like": "none"})),
                ("data q: no job takes them", lambda case: case["data"].update(q=[1]))):
            with self.subTest(said):
                self.assertTrue(any(said in breach for breach in self.breaches(change)), self.breaches(change))

    def test_a_list_of_other_cases_is_refused_and_written_anew(self):
        (self.folder / "gum-h3-thermometer.json").write_text(json.dumps(self.case("gum-h3-thermometer")), encoding="utf-8")
        readme = self.folder / "README.md"
        readme.write_bytes((CASES / "README.md").read_bytes())
        with redirect_stdout(io.StringIO()) as out:
            self.assertEqual(check_cases.main([str(self.folder)]), 1)
            self.assertEqual(check_cases.main(["--write", str(self.folder)]), 0)
            self.assertEqual(check_cases.main([str(self.folder)]), 0)
            (self.folder / "broken.json").write_text("[1]", encoding="utf-8")
            self.assertEqual(check_cases.main([str(self.folder)]), 1)
        self.assertIn("README.md: the list is not that of the cases", out.getvalue())
        self.assertIn("broken.json: ", out.getvalue())
        self.assertEqual(readme.read_text(encoding="utf-8").count(".json)"), 1)


if __name__ == "__main__":
    Case.program = pathlib.Path(sys.argv.pop(1)).resolve()
    Case.all_cases = "--all" in sys.argv
    sys.argv = [argument for argument in sys.argv if argument != "--all"]
    unittest.main()
