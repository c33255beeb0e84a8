"""Times `gumcert compare` on jobs between laboratories: reads the job and its table, evaluates, writes the record.

    comparison_jobs.py PROGRAM FOLDER [--repetitions N]

Writes the jobs into FOLDER, and a table of wall times to stdout. Results are drawn with a fixed seed.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import time

import numpy

TARGET_S = 2.0


def write_job(folder, name, participants, items, keys):
    """A job with a CSV of results: one row a participant and item, U = 2 u between 0.2 and 2 times the spread."""
    random = numpy.random.default_rng(20261121)
    value = random.normal(0.0, 0.05, (participants, items))
    u = random.uniform(0.01, 0.1, (participants, items))
    rows = ["participant,item,value,U,k"]
    for p in range(participants):
        for i in range(items):
            rows.append(f"L{p + 1},I{i + 1},{10 + value[p, i]:.4f},{2 * u[p, i]:.4f},2")
    (folder / f"{name}.csv").write_text("\n".join(rows) + "\n")
    job = {
        "schema": "gumcert/job/1",
        "kind": "comparison",
        "unit": "mm",
        "items": [{"id": f"I{i + 1}"} for i in range(items)],
        "participants": [{"id": f"L{p + 1}"} for p in range(participants)],
        "results": {"file": f"{name}.csv"},
        **keys,
    }
    path = folder / f"{name}.json"
    path.write_text(json.dumps(job))
    return path


def wall_times(program, job, repetitions):
    """Wall times of the command, [s], the first one left out: it brings the files into memory."""
    times = []
    for _ in range(repetitions + 1):
        begin = time.perf_counter()
        done = subprocess.run(
            [program, "compare", str(job), "--quiet", "-o", str(job.with_suffix(".record"))], capture_output=True, text=True
        )
        times.append(time.perf_counter() - begin)
        if done.returncode != 0:
            sys.exit(f"comparison_jobs: {job.name}: exit code {done.returncode}: {done.stderr}")
    return times[1:]


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--repetitions", type=int, default=15)
    options = arguments.parse_args()
    robust = {"assigned_value": "algorithm_a", "sigma_pt": 0.05}
    cases = [
        ("10 000 participants, one item, weighted mean", 10_000, 1, {"assigned_value": "weighted_mean"}),
        ("10 000 participants, one item, algorithm A", 10_000, 1, robust),
        ("10 participants, 1000 items, weighted mean", 10, 1_000, {"assigned_value": "weighted_mean"}),
        ("10 participants, 1000 items, algorithm A", 10, 1_000, robust),
    ]
    print("| work | median | largest | target |")
    print("|---|---|---|---|")
    for number, (name, participants, items, keys) in enumerate(cases):
        times = wall_times(options.program, write_job(options.folder, f"job{number}", participants, items, keys), options.repetitions)
        print(f"| {name} | {statistics.median(times):.2f} s | {max(times):.2f} s | {TARGET_S:g} s |")


if __name__ == "__main__":
    main()
