#!/usr/bin/env python3
"""Records and documents of the shipped examples have the bytes that they had: SHA-256 of each, in digests.json.

A change of structure moves none of them. A change that moves one is announced under "Numbers changed" in CHANGELOG.md, and
`--write` takes the new digests. Commit and digest of the record, which change with every commit, are left out.

Bytes are the same on all processors of one architecture (check_same_digits.py). On others, where extended precision is
another, the same is compared with numbers of ten significant digits.

Without --write the exit code is 0, or 1 when something differs.
"""

import argparse
import concurrent.futures
import hashlib
import json
import platform
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
DIGESTS = Path(__file__).with_name("digests.json")

# Job, and forms and languages of its documents. A language costs time, and all words stand in one form.
EVALUATED = (
    ("gauge_block/job.json", ("html text", "en")),
    ("end_gauge/job.json", ("html text", "de")),
    ("multimeter/job.json", ("html text", "en")),
    ("resistance_and_reactance/job.json", ("html text", "es")),
    ("thermometer/job.json", ("html text", "en")),
    ("certificate/end_gauge.json", ("html text dcc", "en"), ("html", "zh-Hant")),
    ("certificate/rotary_table.json", ("html text dcc", "de,en")),
    ("rotary_table/job.json", ("html text", "en"), ("html", "es")),
    ("rotary_table/job_with_reference_budget.json", ("text", "en")),
    ("circle_closure/job.json", ("html text", "en")),
    ("circle_closure/indexing_tables.json", ("html text", "de")),
    ("circle_closure/comparison.json", ("html text csv", "en")),
    ("comparison/key_comparison.json", ("html text csv", "en")),
    ("comparison/methods.json", ("html text csv", "de")),
    ("comparison/proficiency_test.json", ("html text csv", "en"), ("html", "zh-Hant")),
    ("everyday/multimeter/job.json", ("html text dcc", "en")),
    ("everyday/torque_wrench/job.json", ("text", "de")),
    ("everyday/angle_gauges/job.json", ("text", "es")),
    ("laboratory/end_gauge.json", ("text", "en")),
)
STUDIES = (
    ("plan rotary_table/plan.json", "json html"),
    ("simulate rotary_table/simulation.json --runs 3", "json html"),
)


def ten_digits(content: bytes) -> bytes:
    """The content with every number of more than ten significant digits rounded to ten."""

    def shorter(match: re.Match) -> bytes:
        digits = re.sub(rb"[eE].*|[-.]", b"", match.group()).lstrip(b"0")
        return match.group() if len(digits) <= 10 else f"{float(match.group()):.9e}".encode()

    return re.sub(rb"-?\d+\.\d+(?:[eE][-+]?\d+)?", shorter, content)


class Program:
    def __init__(self, program: str, keep: Path | None):
        self.program = program
        self.keep = keep
        version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
        self.commit = [(line.split()[1], "COMMIT") for line in version.splitlines() if line.startswith("commit ")]
        if self.commit == [("unknown", "COMMIT")]:
            raise RuntimeError(f"{program} was built without git: its documents name no commit that could be left out. "
                               "Build it in a checkout.")

    def run(self, *arguments: str) -> None:
        done = subprocess.run([self.program, *arguments, "--quiet"], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):  # 1: a negative answer, with its documents
            raise RuntimeError(f"{' '.join(arguments)}\n{done.stderr}")

    def digest(self, name: str, content: bytes) -> tuple[str, list[str]]:
        """Digests of the bytes, and of those with ten digits."""
        if self.keep:
            (self.keep / name.replace("/", "_")).write_bytes(content)
        return name, [hashlib.sha256(bytes_).hexdigest() for bytes_ in (content, ten_digits(content))]

    def evaluated(self, job: str, *documents: tuple[str, str]) -> list[tuple[str, list[str]]]:
        found = []
        with tempfile.TemporaryDirectory() as folder:
            record_file = Path(folder) / "record.json"
            self.run("evaluate", str(SOURCE / "examples" / job), "-o", str(record_file))
            record = json.loads(record_file.read_text(encoding="utf-8"))
            changing = [(record["software"]["commit"], "COMMIT"), (record["digest"]["value"], "DIGEST")]
            found.append(self.digest(job, without(changing, record_file.read_bytes())))
            for covariance in sorted(Path(folder).glob("covariance*")):
                found.append(self.digest(f"{job} covariance", covariance.read_bytes()))
            for form, languages in ((form, languages) for forms, languages in documents for form in forms.split()):
                document = Path(folder) / f"document.{form}"
                self.run("render", str(record_file), "--format", form, "--language", languages, "--draft",
                         "--share", str(SOURCE), "-o", str(document))
                found.append(self.digest(f"{job} {form} {languages}", without(changing, document.read_bytes())))
        return found

    def study(self, command: str, forms: str) -> list[tuple[str, list[str]]]:
        name, job, *options = command.split()
        found = []
        with tempfile.TemporaryDirectory() as folder:
            for form in forms.split():
                document = Path(folder) / f"document.{form}"
                self.run(name, str(SOURCE / "examples" / job), *options, "--share", str(SOURCE), "-o", str(document))
                found.append(self.digest(f"{name} {job} {form}", without(self.commit, document.read_bytes())))
        return found


def without(changing: list[tuple[str, str]], content: bytes) -> bytes:
    """The content with what changes with every commit named in place of its value; documents print the beginning."""
    for value, name in changing:
        for length in (len(value), 12):
            content = content.replace(value[:length].encode(), name.encode())
    return content


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, help="the gumcert to ask")
    parser.add_argument("--write", action="store_true", help="take what it writes as the new digests")
    parser.add_argument("--keep", type=Path, help="folder for what was compared, to see what differs")
    chosen = parser.parse_args()
    if chosen.keep:
        chosen.keep.mkdir(parents=True, exist_ok=True)
    kept = json.loads(DIGESTS.read_text(encoding="utf-8")) if DIGESTS.exists() else {}
    here = platform.machine()
    program = Program(chosen.program, chosen.keep)
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        tasks = [pool.submit(program.evaluated, *task) for task in EVALUATED]
        tasks += [pool.submit(program.study, *task) for task in STUDIES]
        found = dict(pair for task in tasks for pair in task.result())
    if chosen.write:
        digests = {"architecture": here, "digests": dict(sorted(found.items()))}
        DIGESTS.write_text(json.dumps(digests, indent=1) + "\n", encoding="utf-8")
        print(f"golden: {len(found)} digests written")
        return 0
    same_kind = kept["architecture"] == here
    which = 0 if same_kind else 1
    differing = sorted(name for name in found.keys() | kept["digests"].keys()
                       if name not in found or name not in kept["digests"]
                       or found[name][which] != kept["digests"][name][which])
    for name in differing:
        print(f"golden: {name} has other bytes")
    if differing:
        print("golden: see what differs with --keep before and after; if it is meant, say so under \"Numbers changed\" in "
              "CHANGELOG.md, and take the new digests with --write")
        return 1
    print(f"golden: {len(found)} records and documents have the "
          + ("bytes that they had" if same_kind else "numbers that they had, to ten digits"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
