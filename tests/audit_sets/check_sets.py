#!/usr/bin/env python3
"""The audit on budgets of which everything is known: 100 planted errors, and budgets that are sound.

    check_sets.py --program FILE [--seed N] [--tables-only] [--verbose]

100 errors stand in 20 budgets of different fields (make_sets.py): at least 95 are found, by a rule that tells of them, at
the row where they are, with the effect that was computed without the program. Over the sound budgets (those 20, published
ones of tests/reference as jobs and as tables, and the jobs of examples/: more than 50) there is at most one false finding
that is critical.

The seed is that of the files in this folder, which are compared byte by byte with what make_sets.py gives; another one is
taken from --seed or GUMCERT_AUDIT_SEED. Exit code 1 where a number is missed.
"""

import argparse
import collections
import concurrent.futures
import csv
import io
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from make_sets import DEFAULT_SEED, make, write
from tables import significant

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]

# Published budgets: cases of tests/reference/cases whose job "law" is one. Each is audited as a job, and as a table with the
# digits that a laboratory would print.
PUBLISHED = (
    "ea402-s2-mass-10kg", "ea402-s4-gauge-block-50mm", "ea402-s6-power-sensor-value", "ea402-s7-attenuator-30db",
    "ea402-s9-dmm-100v", "ea402-s12-water-meter", "gum-522-series-resistors-uncorrelated", "gum-g41-product", "gum-h1-end-gauge",
    "gum-h2-ignoring-correlation", "gum-h2-resistance-reactance", "gum5-ex1-ph", "gum5-ex2-bap", "gum5-ex3-glucose",
    "gum5-ex13-implicit-rtd", "gum5-ex14-decay", "gum5-ex15-rope", "iso11929-4-ex6", "iso11929-ex1a", "iso11929-ex1b",
    "kessel-2006-lead-ratios", "kessel-2006-mass-10kg", "quam-a1-cadmium-standard", "quam-a3-hcl-titration",
    "quam-a3-hcl-improved-repeatability", "s1-93-mass-calibration", "s1-95-gauge-block", "snl-xrf-ratio",
    "sterlinski-2008-caesium", "tn1900-e4-pitot", "tn1900-e13-thermal-expansion", "willink-2008-mean-of-three-linear",
    "wuebbeler-2008-ohm")
# What is true of an example, and therefore no false accusation: a comparison holds a result with |E_n| > 1, which is what
# it is made to show, and nobody says in its job what was done about it.
TRUE_OF_EXAMPLES = {"circle_closure/comparison.json": "N06", "rotary_table/job_with_reference_budget.json": "N06",
                    "rotary_table/paper_fixture_budget.json": "S15",
                    "rotary_table/job_with_paper_fixture_budget.json": "S15"}
LEAST_FOUND = 95
MOST_FALSE = 1
LEAST_SOUND = 50
ARITHMETIC = 0.002  # of a number that a finding states with four digits

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def audited(program, files):
    """What the audit says of each file, by its name."""
    command = [str(program), "audit", *map(str, files), "--format", "json", "--quiet", "--share", str(ROOT)]
    ended = subprocess.run(command, capture_output=True, check=False, timeout=300)
    if ended.returncode not in (0, 1):
        sys.exit(f"the audit ended with {ended.returncode}: {ended.stderr.decode('utf-8', errors='replace')}")
    report = json.loads(ended.stdout)
    reports = report.get("files", [report])
    if len(reports) != len(files):
        sys.exit(f"{len(files)} files were given to the audit, and {len(reports)} were looked at")
    for one, file in zip(reports, files):
        one["path"] = str(file)
    return reports


def numbers_in(text):
    return [float(number) for number in NUMBER.findall(text)]


def is_near(number, expected, tolerance):
    return number is not None and abs(number - expected) <= tolerance * abs(expected)


def states(finding, expected):
    """Why a finding does not state the effect that was expected; nothing where it does."""
    effect = expected["effect"]
    if effect == "corrected":
        if not finding["effect"]:
            return "no effect is stated"
        U = finding["effect"]["alone"]["U"]
        return None if is_near(U, expected["U"], expected["tolerance"] + ARITHMETIC) else f"U alone {U:.4g}"
    if effect == "missing":
        found = (finding.get("missing_term") or {}).get("u_for_digit")
        return None if is_near(found, expected["number"], 0.02) else f"u_for_digit {found}"
    if effect == "bound":
        said = next((text for text in finding["evidence"] if text.startswith(expected["before"])), None)
        if said is None:
            return f"no evidence “{expected['before']}”"
        found = numbers_in(said[len(expected["before"]):])[0]
        return None if is_near(found, expected["number"], expected["tolerance"] + ARITHMETIC) else said
    said = finding["expected"] or ""
    if "word" in expected:
        return None if said == expected["word"] else f"expected: {said}"
    near = any(abs(number - expected["number"]) <= expected["half"] for number in numbers_in(said))
    return None if near else f"expected: {said}"


def missed(report, expected):
    """Why an error was not found; nothing where it was."""
    claimed = report["claimed"]
    if not claimed:
        return "the table was not read: " + "; ".join(report["not_read"])
    if not is_near(claimed["U"], float(expected["claimed_U"]), 1e-9):
        return f"U = {expected['claimed_U']} is claimed, and {claimed['U']} was read"
    reasons = []
    for finding in report["findings"]:
        if finding["id"] not in expected["ids"]:
            continue
        if expected["row"] and f"({expected['row']})" not in finding["where"]:
            reasons.append(f"{finding['id']} at {finding['where']}")
            continue
        why = states(finding, expected)
        if why is None:
            return None
        reasons.append(f"{finding['id']}: {why}")
    return "; ".join(reasons) or "no such finding; there are " + " ".join(one["id"] for one in report["findings"])


def check_planted(reports, expected, verbose):
    """How many errors were found, and what was not."""
    found, kinds = 0, collections.defaultdict(lambda: [0, 0])
    lines = []
    for report in reports:
        name = "planted/" + pathlib.Path(report["path"]).name
        said = expected[name]
        why = missed(report, said)
        kinds[said["kind"]][0] += why is None
        kinds[said["kind"]][1] += 1
        found += why is None
        if why is not None:
            lines.append(f"  missed  {name}  {said['kind']}, {said['row'] or 'whole budget'}: {why}"
                         + (f" (U {said['claimed_U']} → {said['U']:.4g})" if verbose else ""))
    return found, lines, kinds


def check_sound(reports, expected):
    """Critical findings on sound budgets, and budgets whose numbers were not read."""
    false, unread = [], []
    for report in reports:
        true = next((rule for name, rule in TRUE_OF_EXAMPLES.items() if report["path"].endswith("examples/" + name)), None)
        for finding in report["findings"]:
            if finding["severity"] == "critical" and finding["id"] != true:
                false.append(f"  critical  {report['path']}  {finding['id']} {finding['where']}: {finding['what']}")
        said = expected.get("sound/" + pathlib.Path(report["path"]).name)
        if said:
            U = (report["recomputed"] or {}).get("U")
            if report["not_read"] or not is_near(U, said["U"], said["tolerance"] + ARITHMETIC):
                unread.append(f"  not read  {report['path']}: U = {U}, and {said['U']:.4g} is right {report['not_read']}")
    return false, unread


def table_of(record):
    """A published budget as a table with few digits; nothing where its rows are not all of u_c (correlations)."""
    for name, result in record["results"].items():
        rows = result["budget"]
        if not rows or abs(math.hypot(*(row["contribution"] for row in rows)) - result["u"]) > 1e-3 * result["u"]:
            continue
        unit = result["unit"]
        said = {row["name"]: row["description"] for row in record["inputs"]}
        lines = [["measurand", f"{name}, {record['title']}"],
                 ["quantity", "estimate", "unit", "u", "sensitivity", "contribution", "nu", "comment"]]
        for row in rows:
            nu = "inf" if row["nu"] is None else f"{row['nu']:.6g}"
            lines.append([row["input"], significant(row["value"], 9)[0], row["unit"], significant(row["u"], 3)[0],
                          significant(row["sensitivity"], 4)[0], significant(row["contribution"], 3)[0], nu,
                          said.get(row["input"], "")])
        nu_eff = ["effective degrees of freedom", f"{result['nu_eff']:.1f}"] if result["nu_eff"] is not None else []
        lines += [["u_c", "", unit, significant(result["u"], 3)[0]], nu_eff, ["k", f"{result['k']:.2f}"],
                  ["U", "", unit, significant(result["U"], 2)[0]],
                  ["coverage probability", f"{100 * result['coverage_probability']:.4g} %"]]
        file = io.StringIO()
        csv.writer(file, lineterminator="\n").writerows(lines)
        return file.getvalue()
    return None


def published(program, folder):
    """Jobs and tables of the published budgets."""
    files = []

    def evaluated(name):
        case = json.loads((ROOT / "tests" / "reference" / "cases" / f"{name}.json").read_text(encoding="utf-8"))
        place = folder / name
        place.mkdir(parents=True)
        job, record_file = place / "law.json", place / "record.json"
        law = {"schema": "gumcert/job/1", "kind": "budget", "title": case["title"], **case["jobs"]["law"]}
        job.write_text(json.dumps(law, ensure_ascii=False), encoding="utf-8")
        subprocess.run([program, "evaluate", job, "-o", record_file, "--quiet", "--threads", "1", "--share", ROOT],
                       capture_output=True, check=False, timeout=550)  # 1 where the audit has a critical finding
        table = table_of(json.loads(record_file.read_text(encoding="utf-8")))
        if table is not None:
            (place / "table.csv").write_text(table, encoding="utf-8")
        return [job] + ([place / "table.csv"] if table is not None else [])

    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        for made in pool.map(evaluated, PUBLISHED):
            files += made
    return files


def examples():
    """All jobs of the tree's examples that have results: no plan, no simulation, and none of examples/audit, which have
    errors."""
    folder = ROOT / "examples"
    return [path for path in sorted(folder.rglob("*.json")) if folder / "audit" not in path.parents
            and re.search(r'"schema"\s*:\s*"gumcert/job/1"', path.read_text(encoding="utf-8"))
            and path.stem not in ("plan", "simulation")]


def differing(files):
    """Names of files of this folder that are not what the default seed gives."""
    kept = {path.relative_to(HERE).as_posix() for folder in ("sound", "planted") for path in (HERE / folder).glob("*.csv")}
    names = {name for name, data in files.items()
             if not (HERE / name).is_file() or (HERE / name).read_bytes() != data}
    return sorted(names | (kept - set(files)))


def main():
    parser = argparse.ArgumentParser(description="The audit on budgets of which everything is known.")
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--seed", type=int, default=int(os.environ.get("GUMCERT_AUDIT_SEED", DEFAULT_SEED)))
    parser.add_argument("--tables-only", action="store_true", help="leave out published cases and examples")
    parser.add_argument("--verbose", action="store_true", help="counts for each kind of error as well")
    arguments = parser.parse_args()
    files = make(arguments.seed)
    expected = json.loads(files["expected.json"])["files"]
    problems = []
    if arguments.seed == DEFAULT_SEED and differing(files):
        problems.append("not what make_sets.py writes: " + ", ".join(differing(files)))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write(files, folder)
        found, lines, kinds = check_planted(audited(arguments.program, sorted((folder / "planted").iterdir())), expected,
                                            arguments.verbose)
        sound = sorted((folder / "sound").iterdir())
        if not arguments.tables_only:
            sound += published(arguments.program, folder / "published") + examples()
        false, unread = check_sound(audited(arguments.program, sound), expected)
    print("\n".join(lines + false + unread))
    if arguments.verbose:
        for kind, (right, of) in sorted(kinds.items()):
            print(f"  {right} of {of}  {kind}")
    print(f"seed {arguments.seed}: {found} of {sum(of for _, of in kinds.values())} planted errors found with their effect; "
          f"{len(false)} false critical findings on {len(sound)} sound budgets")
    if len(sound) < LEAST_SOUND and not arguments.tables_only:
        problems.append(f"fewer than {LEAST_SOUND} sound budgets were looked at")
    if found < LEAST_FOUND:
        problems.append(f"fewer than {LEAST_FOUND} of 100 errors were found")
    if len(false) > MOST_FALSE:
        problems.append(f"more than {MOST_FALSE} false critical finding on sound budgets")
    if unread:
        problems.append("sound budgets were not read as they are")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
