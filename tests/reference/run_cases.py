#!/usr/bin/env python3
"""Published reference cases through the command line of the program.

    run_cases.py --program FILE [--cases DIR] [--only ID ...] [--jobs N] [--keep DIR] [--verbose]

Each case is a JSON file; README.md in the folder of the cases says what stands in it. `gumcert evaluate` runs its jobs,
and every expected value is compared with what its path or formula finds in the records: within the stated tolerance, or
half a unit of the last printed digit where none is stated. A value that is not compared says why.

Exit code: 0 all cases pass; 1 a failure; 2 no case.
"""

import argparse
import concurrent.futures
import copy
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
from decimal import Decimal

HERE = pathlib.Path(__file__).resolve().parent
SHARE = HERE.parents[1]  # holds templates/ with the profiles of certificates
PATH = re.compile(r"\{([^{}]+)\}")
# What a formula may call, beside + − * / ^ and comparisons.
FUNCTIONS = {
    "abs": abs, "max": max, "floor": math.floor, "sqrt": math.sqrt, "ln": math.log, "hypot": math.hypot, "pi": math.pi,
    "sum": math.fsum, "mean": statistics.fmean, "normal_quantile": statistics.NormalDist().inv_cdf,
    "last_digits": lambda text: text.replace(".", "").lstrip("0"),  # of a printed uncertainty: "0.0023" → "23"
}


class Refused(Exception):
    """The program did not evaluate a job."""


def merged(base, changes):
    """A copy of `base` with the changes: objects key by key, everything else as a whole."""
    if not isinstance(base, dict) or not isinstance(changes, dict):
        return copy.deepcopy(changes)
    keys = list(base) + [key for key in changes if key not in base]
    return {key: merged(base.get(key), changes[key]) if key in changes else copy.deepcopy(base[key]) for key in keys}


def stated_job(case, name):
    """A job as the case states it, with what it takes over from another one ("like")."""
    job = dict(case["jobs"][name])
    like = job.pop("like", None)
    return merged(stated_job(case, like), job) if like else job


class Records:
    """The records of the jobs of one case; a job is evaluated when its record is first asked for."""

    def __init__(self, case, program, folder):
        self.case, self.program, self.folder, self.found = case, program, folder, {}

    def record(self, name):
        if name not in self.found:
            try:
                self.found[name] = self.evaluate(name)
            except (Refused, subprocess.TimeoutExpired) as problem:
                self.found[name] = problem
        if isinstance(self.found[name], Exception):
            raise self.found[name]
        return self.found[name]

    def evaluate(self, name):
        job = {"schema": "gumcert/job/1", "kind": "budget", "title": self.case["title"],
               **self.filled_in(stated_job(self.case, name))}
        stem = f"{list(self.case['jobs']).index(name) + 1:02d}-" + re.sub(r"\W+", "-", name).strip("-")[:60]
        job_file, record_file = self.folder / f"{stem}.json", self.folder / f"{stem}-record.json"
        job_file.write_text(json.dumps(job, indent=1, ensure_ascii=False), encoding="utf-8")
        share = ["--share", SHARE] if "certificate" in job else []
        done = subprocess.run([self.program, "evaluate", job_file, "-o", record_file, "--quiet", "--threads", "1", *share],
                              capture_output=True, text=True, encoding="utf-8", errors="replace", check=False, timeout=550)
        if done.returncode not in (0, 1) or not record_file.exists():  # 1: not validated, where validation was asked for
            raise Refused(f"exit code {done.returncode} of the job {name}: {done.stderr.strip()[:400]}")
        return {**json.loads(record_file.read_text(encoding="utf-8")), "exit_code": done.returncode}

    def filled_in(self, part):
        """A job, or a part of it, with its formulas replaced by their values."""
        if isinstance(part, dict):
            return {key: self.filled_in(value) for key, value in part.items()}
        if isinstance(part, list):
            return [self.filled_in(value) for value in part]
        return self.value(part) if isinstance(part, str) and "{" in part else part

    def at(self, path):
        """What stands at a path: the name of a job, or data, then keys of objects, numbers of rows, and key=value,… of
        the row of a list that has them. Null stands for infinity, as in degrees of freedom."""
        first, *rest = path.split("/")
        place = self.case["data"] if first == "data" else self.record(first)
        for step in rest:
            if isinstance(place, dict):
                place = place[step]
            elif step.isdigit():
                place = place[int(step)]
            else:
                wanted = dict(part.split("=", 1) for part in step.split(","))
                place, = [row for row in place if all(row[key] == value for key, value in wanted.items())]
        return math.inf if place is None else place

    def value(self, formula):
        """Of a path, or of a formula with paths in braces."""
        if "{" not in formula:
            return self.at(formula)
        values = {}

        def name_of(path):
            return values.setdefault(path[1], (f"_{len(values)}", self.at(path[1])))[0]

        text = PATH.sub(name_of, formula).replace("^", "**")
        return eval(text, {"__builtins__": {}, **FUNCTIONS, **dict(values.values())})  # the cases are part of the tree


def expected_value(entry):
    """The number, truth or text of an entry; numbers may be printed with spaces between their digits."""
    value = entry["printed"] if "printed" in entry else entry["computed"]
    try:
        return float(value.replace(" ", "")) if isinstance(value, str) else value
    except ValueError:
        return value


def half_last_digit(printed):
    """Half a unit of the last printed digit: "1.60E-3" → 0.000005."""
    return 0.5 * 10.0 ** Decimal(printed.replace(" ", "")).as_tuple().exponent


def tolerance_of(entry, records):
    tolerance = entry.get("tolerance")
    if isinstance(tolerance, str):
        return records.value(tolerance)
    if tolerance is not None:
        return tolerance
    if "relative_tolerance" in entry:
        return entry["relative_tolerance"] * abs(expected_value(entry))
    return half_last_digit(entry["printed"])


def disagreement(entry, found, records):
    """None when the two agree, else what is wrong."""
    wanted = expected_value(entry)
    if isinstance(found, str):
        wanted = entry["printed"] if "printed" in entry else wanted
    if isinstance(found, (bool, str)) or isinstance(wanted, (bool, str)):
        return None if type(found) is type(wanted) and found == wanted else f"{found}, expected {wanted}"
    if found == wanted:  # infinities among them
        return None
    tolerance = tolerance_of(entry, records)
    allowed = tolerance * (1.0 + 1e-9) + 4e-16 * abs(wanted)  # the tolerance itself is a rounded number
    return None if abs(found - wanted) <= allowed else f"{found:.15g}, expected {wanted:.15g} ± {tolerance:.3g}"


class Outcome:
    def __init__(self, case):
        self.case, self.agreed, self.compared = case, 0, 0
        self.failures, self.said, self.reasons = [], [], []  # reasons: what is not compared, and why


def name_of(entry):
    return f"{entry['quantity']} {entry['kind']}" + (f" [{entry['input']}]" if "input" in entry else "")


def run_case(path, program, folder):
    case = json.loads(path.read_text(encoding="utf-8"))
    outcome = Outcome(path.stem)
    folder = folder / path.stem
    folder.mkdir(parents=True, exist_ok=True)
    records = Records(case, program, folder)
    problems = set()
    for entry in case["expected"]:
        name = name_of(entry)
        if "not_compared" in entry:
            outcome.reasons.append((name, entry["not_compared"]))
            continue
        try:
            formulas = entry["found"] if isinstance(entry["found"], list) else [entry["found"]]
            for formula in formulas:
                found = records.value(formula)
                wrong = disagreement(entry, found, records)
                if wrong:
                    outcome.failures.append(f"{name}: {wrong} ({formula})")
                    break
                outcome.compared += 1
                outcome.said.append(f"{name}: {found} ({formula})")
            else:
                outcome.agreed += 1
        except (Refused, subprocess.TimeoutExpired) as problem:
            if str(problem) not in problems:
                outcome.failures.append(f"{name}: {problem}")
            problems.add(str(problem))
        except (ArithmeticError, LookupError, NameError, SyntaxError, TypeError, ValueError) as error:
            outcome.failures.append(f"{name}: the record does not hold it: {error!r} ({entry.get('found')})")
    if not outcome.compared and not outcome.failures:
        outcome.failures.append("no value of the case is compared")
    return outcome


def report(outcomes, verbose):
    failed = [outcome for outcome in outcomes if outcome.failures]
    for outcome in outcomes:
        print(f"{'FAIL' if outcome.failures else 'pass'}  {outcome.case}  ({outcome.agreed} values)")
        for line in outcome.failures:
            print(f"      {line}")
        for line in outcome.said if verbose else ():
            print(f"      . {line}")
    reasons = {}
    for outcome in outcomes:
        for name, reason in outcome.reasons:
            reasons.setdefault(reason, []).append(f"{outcome.case}: {name}")
    if reasons:
        print("\nValues that are not compared")
    for reason, names in reasons.items():
        print("\n      ".join([f"  {reason}", *names]))
    print(f"\n{len(outcomes) - len(failed)} cases pass, {len(failed)} fail; "
          f"{sum(o.agreed for o in outcomes)} values agree in {sum(o.compared for o in outcomes)} comparisons, "
          f"{sum(len(o.reasons) for o in outcomes)} are not compared")
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description="Published reference cases through the command line of the program.")
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--cases", type=pathlib.Path, default=HERE / "cases", help="another folder of cases")
    parser.add_argument("--only", action="append", metavar="ID", help="this case; may be given again")
    parser.add_argument("--jobs", type=int, default=2, help="cases at the same time")
    parser.add_argument("--keep", type=pathlib.Path, metavar="DIR", help="keep jobs and records there")
    parser.add_argument("--verbose", action="store_true", help="every value, and where it was found")
    options = parser.parse_args()
    paths = sorted(options.cases.glob("*.json"))
    if options.only:
        unknown = set(options.only) - {path.stem for path in paths}
        if unknown:
            parser.error(f"no case {', '.join(sorted(unknown))}")
        paths = [path for path in paths if path.stem in options.only]
    if not paths:
        parser.error(f"no case in {options.cases}")
    if not options.program.is_file():
        parser.error(f"there is no program {options.program}")
    with tempfile.TemporaryDirectory() as temporary:
        folder = (options.keep or pathlib.Path(temporary)).resolve()
        with concurrent.futures.ThreadPoolExecutor(max_workers=max(1, options.jobs)) as pool:
            outcomes = list(pool.map(lambda path: run_case(path, options.program.resolve(), folder), paths))
    return report(outcomes, options.verbose)


if __name__ == "__main__":
    sys.exit(main())
