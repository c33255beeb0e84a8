#!/usr/bin/env python3
"""The runner of the published cases fails where it must, and so does the check of their shape.

    cases_test.py PROGRAM [--all]

Every expected value of a case is moved just beyond its tolerance, in its last digits, and must be refused; one that
passes all the same was never compared. One case a topic, or with --all every case, which takes as long as the cases do.
Beside that: paths, jobs and files that are not as they should be.
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
import run_cases

CASES = run_cases.HERE / "cases"


def spoiled(entry):
    """The entry with a value that is as far away as two and a half tolerances, at least: found cannot agree with it, as
    it agrees with the true one."""
    entry = copy.deepcopy(entry)
    key = "printed" if "printed" in entry else "computed"
    value = run_cases.expected_value(entry)
    if isinstance(value, bool):
        entry[key] = not value
    elif isinstance(value, str):
        entry[key] = value + "0"
    elif isinstance(entry.get("tolerance"), str):  # some numerical errors of the trials: far below a tenth
        entry[key] = 1.1 * value + (value == 0.0)
    elif math.isfinite(value):
        tolerance = run_cases.tolerance_of(entry, None)
        if key == "printed":  # whole units of the last digit
            unit = Decimal(1).scaleb(Decimal(entry[key].replace(" ", "")).as_tuple().exponent)
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

    def case(self, name):
        return json.loads((CASES / f"{name}.json").read_text(encoding="utf-8"))

    def run_changed(self, case):
        (self.folder / "changed.json").write_text(json.dumps(case), encoding="utf-8")
        return run_cases.run_case(self.folder / "changed.json", self.program, self.folder / "work")


class Runner(Case):
    def test_every_expected_value_is_compared(self):
        names = [path.stem for path in sorted(CASES.glob("*.json"))] if self.all_cases else one_case_a_topic()
        for name in names:
            with self.subTest(name):
                case = self.case(name)
                case["expected"] = [spoiled(entry) for entry in case["expected"] if "found" in entry]
                outcome = self.run_changed(case)
                self.assertEqual(outcome.agreed, 0, outcome.said)
                self.assertEqual(len(outcome.failures), len(case["expected"]))
                for failure in outcome.failures:
                    self.assertIn(", expected ", failure)

    def test_one_spoiled_digit_fails_the_run_and_is_named(self):
        case = self.case("gum-522-series-resistors-uncorrelated")
        place = next(i for i, entry in enumerate(case["expected"]) if entry["kind"] == "u" and "printed" in entry)
        whole = len(case["expected"])
        case["expected"][place] = spoiled(case["expected"][place])
        (self.folder / "spoiled.json").write_text(json.dumps(case), encoding="utf-8")
        done = self.run_program("--cases", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("FAIL  spoiled", done.stdout)
        self.assertIn(f"{case['expected'][place]['quantity']} u: ", done.stdout)
        self.assertIn(f"0 cases pass, 1 fail; {whole - 1} values agree", done.stdout)

    def test_a_value_in_a_second_place_is_compared_too(self):
        case = self.case("gum-h2-resistance-reactance")
        entry = next(entry for entry in case["expected"] if isinstance(entry.get("found"), list))
        entry["found"][1] = entry["found"][1].replace("/value", "/u")
        self.assertEqual(len(self.run_changed(case).failures), 1)

    def test_what_cannot_be_found_is_a_failure(self):
        def without_place(entry):
            del entry["found"]

        def elsewhere(path):
            return lambda entry: entry.update(found=path)

        for change in (without_place, elsewhere("law/results/none/u"), elsewhere("none/results/Rref/u"),
                       elsewhere("law/results/Rref/budget/input=none/u"), elsewhere("law/results/Rref"),
                       elsewhere("{law/results/Rref/u} / 0"), elsewhere("{law/results/Rref/u} +")):
            case = self.case("gum-522-series-resistors-uncorrelated")
            case["expected"] = case["expected"][:1]
            change(case["expected"][0])
            outcome = self.run_changed(case)
            self.assertEqual((outcome.agreed, len(outcome.failures)), (0, 1), case["expected"])

    def test_a_refused_job_and_an_empty_case_are_failures(self):
        case = self.case("gum-522-series-resistors-uncorrelated")
        case["jobs"]["law"]["model"] = ["Rref = "]
        outcome = self.run_changed(case)
        self.assertEqual(outcome.agreed, 0)
        self.assertIn("exit code 3 of the job law", outcome.failures[0])
        case["expected"] = []
        self.assertEqual(self.run_changed(case).failures, ["no value of the case is compared"])

    def test_nothing_to_run_is_no_success(self):
        self.assertEqual(self.run_program("--cases", self.folder).returncode, 2)
        self.assertEqual(self.run_program("--only", "no-such-case").returncode, 2)

    def run_program(self, *arguments):
        return subprocess.run([sys.executable, "-B", run_cases.__file__, "--program", self.program, *arguments],
                              capture_output=True, text=True, encoding="utf-8", check=False)


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
