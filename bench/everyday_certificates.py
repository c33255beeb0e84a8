#!/usr/bin/env python3
"""What everyday certificates cost: processor time of `gumcert` with all that it starts, beside that of parts of the work.

    bench/everyday_certificates.py PROGRAM [--certificates 100] [--points 500]

A job of 500 points with PDF and digital certificate, and 100 certificates of the example of a multimeter in one command.
Processor time is that of the program and of the process that sets its PDFs.
"""

import argparse
import json
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "everyday" / "multimeter"


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


def copy_of_the_example(folder: Path, number: int, points: int | None = None) -> Path:
    folder.mkdir()
    for name in ("job.json", "certificate.json", "points.csv"):
        (folder / name).write_text((EXAMPLE / name).read_text(encoding="utf-8"), encoding="utf-8")
    certificate = json.loads((folder / "certificate.json").read_text(encoding="utf-8"))
    certificate["number"] = f"BENCH-{number:04}"
    text = json.dumps(certificate).replace("../../certificate/symbol.png", "symbol.png")
    (folder / "certificate.json").write_text(text, encoding="utf-8")
    shutil.copy(EXAMPLE.parents[1] / "certificate" / "symbol.png", folder)
    if points:
        head, *rows = (folder / "points.csv").read_text(encoding="utf-8").splitlines()
        (folder / "points.csv").write_text("\n".join([head] + (rows * (points // len(rows) + 1))[:points]) + "\n",
                                           encoding="utf-8")
    return (folder / "job.json").rename(folder / f"job_{number}.json")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--certificates", type=int, default=100)
    parser.add_argument("--points", type=int, default=500)
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        long = str(copy_of_the_example(folder / "long", 1, a.points))
        rows = [(f"run, {a.points} points", timed(a.program, "run", long, "--draft", "-o", f"{name}/long-out")),
                ("of it evaluate", timed(a.program, "evaluate", long, "-o", f"{name}/record.json"))]
        for form in ("html", "dcc", "pdf"):
            rows.append((f"render {form}, which evaluates again",
                         timed(a.program, "render", f"{name}/record.json", "--format", form, "--draft",
                               "-o", f"{name}/long.{form}")))
        jobs = [str(copy_of_the_example(folder / f"job{i}", i)) for i in range(a.certificates)]
        rows.append((f"run, {a.certificates} certificates",
                     timed(a.program, "run", *jobs, "--draft", "-o", f"{name}/many", "--threads", "1")))
        print("| | processor, s | clock, s |\n|---|---|---|")
        for what, (processor, clock) in rows:
            print(f"| {what} | {processor:.2f} | {clock:.2f} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
