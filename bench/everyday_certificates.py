#!/usr/bin/env python3
"""What everyday certificates cost: processor time of `gumcert` with all that it starts, beside that of parts of the work.

    bench/everyday_certificates.py PROGRAM [--certificates 100] [--points 500]

The multimeter with 500 points, with PDF and digital certificate, and 100 certificates in one command, of each everyday
example the same number.
Processor time is that of the program and of the process that sets its PDFs.
"""

import argparse
import json
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

EXAMPLES = sorted(path.parent for path in (Path(__file__).resolve().parents[1] / "examples/everyday").glob("*/job.json"))


def timed(*command: str) -> tuple[float, float]:
    """Processor time and time of the clock, both in seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    began = time.monotonic()
    done = subprocess.run([*command, "--quiet"], capture_output=True, text=True, check=False)
    clock = time.monotonic() - began
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stderr)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, clock


def other_reading(text: str, chance: random.Random) -> str:
    """The number with its last digits changed by two at most; the same number of digits."""
    digits = len(text.partition(".")[2])
    return f"{float(text) + chance.randint(-2, 2) * 10.0**-digits:.{digits}f}"


def with_other_readings(table: str, chance: random.Random) -> str:
    """Each certificate has readings of its own: columns V_x.1, V_x.2 …, and the resistance R of a fit."""
    head, *rows = [line.split(",") for line in table.splitlines()]
    readings: dict[str, list[int]] = {}
    for i, name in enumerate(head):
        if found := re.fullmatch(r"(\w+)\.\d+|R", name):
            readings.setdefault(found[1] or name, []).append(i)
    for row in rows:
        for columns in readings.values():
            changed = [other_reading(row[i], chance) for i in columns]
            if len(columns) == 1 or len(set(changed)) > 1:  # equal readings are refused
                for i, text in zip(columns, changed, strict=True):
                    row[i] = text
    return "\n".join(",".join(row) for row in [head, *rows]) + "\n"


def copy_of(example: Path, folder: Path, number: int, points: int | None = None) -> Path:
    """The job of an example with another number and item, and either other readings or about so many points."""
    shutil.copytree(example, folder)
    certificate = json.loads((folder / "certificate.json").read_text(encoding="utf-8"))
    certificate["number"] = f"BENCH-{number:04}"
    certificate["item"]["serial_number"] = f"{70000 + 17 * number}"
    (folder / "certificate.json").write_text(json.dumps(certificate), encoding="utf-8")
    tables = sorted(folder.glob("*.csv"))
    chance = random.Random(number)
    for table in [] if points else tables:
        table.write_text(with_other_readings(table.read_text(encoding="utf-8"), chance), encoding="utf-8")
    for table in tables if points else []:
        head, *rows = table.read_text(encoding="utf-8").splitlines()
        wanted = points // len(tables)
        table.write_text("\n".join([head] + (rows * (wanted // len(rows) + 1))[:wanted]) + "\n", encoding="utf-8")
    return (folder / "job.json").rename(folder / f"job_{number}.json")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--certificates", type=int, default=100)
    parser.add_argument("--points", type=int, default=500)
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        multimeter = next(path for path in EXAMPLES if path.name == "multimeter")
        long = str(copy_of(multimeter, folder / "long", 1, a.points))
        rows = [(f"run, {a.points} points", timed(a.program, "run", long, "--draft", "-o", f"{name}/long-out")),
                ("of it evaluate", timed(a.program, "evaluate", long, "-o", f"{name}/record.json"))]
        for form in ("html", "dcc", "pdf"):
            rows.append((f"render {form}, which evaluates again",
                         timed(a.program, "render", f"{name}/record.json", "--format", form, "--draft",
                               "-o", f"{name}/long.{form}")))
        jobs = [str(copy_of(EXAMPLES[i % len(EXAMPLES)], folder / f"job{i}", i)) for i in range(a.certificates)]
        rows.append((f"run, {a.certificates} certificates",
                     timed(a.program, "run", *jobs, "--draft", "-o", f"{name}/many", "--threads", "1")))
        print("| | processor, s | clock, s |\n|---|---|---|")
        for what, (processor, clock) in rows:
            print(f"| {what} | {processor:.2f} | {clock:.2f} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
