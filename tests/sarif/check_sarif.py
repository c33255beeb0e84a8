#!/usr/bin/env python3
"""What gumcert audit writes as SARIF, held against the schema of SARIF 2.1.0 (README.md).

    check_sarif.py --program FILE

Exit code: 0 it is so; 1 it is not; 77 python3-jsonschema is missing.
"""

import argparse
import copy
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed - scripts/setup test")
    sys.exit(77)

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCHEMA = HERE / "sarif-2.1.0-rtm.5.json"
DIGEST = "2d99159ae54a3eea97f81781cff48780548657c35949f4b7f25e99a2ba4de4f8"


def validator():
    bytes_ = SCHEMA.read_bytes()
    if hashlib.sha256(bytes_).hexdigest() != DIGEST:
        sys.exit(f"{SCHEMA}: is not the file of the README")
    schema = json.loads(bytes_)
    jsonschema.Draft4Validator.check_schema(schema)
    return jsonschema.Draft4Validator(schema, format_checker=jsonschema.FormatChecker())


def audited(program, files, *options):
    """One log of all files; exit codes 0 and 1 are those of an audit."""
    ended = subprocess.run(
        [program, "audit", *map(str, files), "--format", "sarif", "--share", str(ROOT), "-q", *options],
        capture_output=True, text=True, check=False)
    if ended.returncode not in (0, 1):
        sys.exit(f"{files[0]}: exit code {ended.returncode}: {ended.stderr}")
    return json.loads(ended.stdout)


def refusals(judge, log):
    """What the schema refuses, and what the specification says in words."""
    found = [f"/{'/'.join(map(str, error.absolute_path))}: {error.message[:200]}" for error in judge.iter_errors(log)]
    for run in log.get("runs", []):
        rules = run["tool"]["driver"].get("rules", [])
        for i, result in enumerate(run.get("results", [])):
            index = result.get("ruleIndex", -1)  # 3.27.6
            if index >= 0 and (index >= len(rules) or rules[index]["id"] != result["ruleId"]):
                found.append(f"result {i}: ruleIndex {index} is not {result['ruleId']}")
            for location in result.get("locations", []):
                artifact = location["physicalLocation"]["artifactLocation"]  # 3.4.5
                if run["artifacts"][artifact["index"]]["location"]["uri"] != artifact["uri"]:
                    found.append(f"result {i}: index {artifact['index']} is not {artifact['uri']}")
        for artifact in run.get("artifacts", []):
            uri = artifact["location"]["uri"]
            if uri.startswith("/") or "://" in uri:
                found.append(f"{uri}: is not relative")
    return found


def breaches(log):
    """Logs that are refused: one breach each."""
    def changed(change):
        other = copy.deepcopy(log)
        change(other["runs"][0])
        return other

    yield "a level that there is not", changed(lambda run: run["results"][0].update(level="critical"))
    yield "no message", changed(lambda run: run["results"][0].pop("message"))
    yield "a key that there is not", changed(lambda run: run["results"][0].update(waiver=1))
    yield "no name of the tool", changed(lambda run: run["tool"]["driver"].pop("name"))
    yield "an artifact twice", changed(lambda run: run["artifacts"].append(copy.deepcopy(run["artifacts"][0])))
    yield "another rule at the index", changed(lambda run: run["results"][0].update(ruleId="Z99"))
    yield "an absolute file", changed(lambda run: run["artifacts"][-1]["location"].update(uri="/tmp/budget.csv"))


def waivers_of(log, file):
    """A file in which somebody accepts everything that was found."""
    file.write_text(json.dumps([
        {"finding": rule, "by": "Head of laboratory", "date": "2026-11-20", "reason": "The table is that of a published paper, and is not used."}
        for rule in sorted({result["ruleId"] for result in log["runs"][0]["results"]})]))
    return file


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    program = parser.parse_args().program
    judge = validator()
    bad = 0

    def look(name, log):
        nonlocal bad
        for refusal in refusals(judge, log):
            print(f"{name}: {refusal}")
            bad += 1
        return log

    folder = ROOT / "examples" / "audit"
    examples = sorted(f for f in folder.rglob("*") if f.suffix in (".csv", ".xlsx", ".json") and f.name != "expected.json")
    for file in examples:
        look(file.relative_to(ROOT), audited(program, [file]))
    planted = look("planted tables", audited(program, [ROOT / "tests" / "audit_sets" / "planted"]))
    certificate = ROOT / "tests" / "fuzz" / "corpus" / "dcc" / "real.xml"
    look(certificate.name, audited(program, [certificate]))
    with tempfile.TemporaryDirectory() as temporary:
        waivers = waivers_of(planted, pathlib.Path(temporary) / "waivers.json")
        log = look("accepted", audited(program, [examples[0]], "--waivers", str(waivers)))
        if not any("suppressions" in result for result in log["runs"][0]["results"]):
            print("accepted: nothing is suppressed")
            bad += 1
    if len(planted["runs"][0]["results"]) < 100 or not examples:
        print("too few findings to judge by")
        bad += 1
    for what, log in breaches(planted):
        if not refusals(judge, log):
            print(f"{what}: is not refused")
            bad += 1
    print(f"{len(examples)} examples, {len(planted['runs'][0]['results'])} findings of planted tables: {bad} breaches")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
