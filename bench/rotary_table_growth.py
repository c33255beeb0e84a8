#!/usr/bin/env python3
"""Times the whole program on rotary tables of growing size, beside peers that use the structure too.

    rotary_table_growth.py GUMCERT [--angles 36,360,3600] [--repetitions N]

Every size is a job of 6 stations and 6 reflectors with stated weights (rotary_table_campaign.py). The program evaluates it
cold, from the files to the record with all uncertainties and budgets; the peers solve the same adjustment and find the
standard uncertainties of the error motions (numpy_rotary_table.py, a process of its own a size). Prints a Markdown table of
medians of processor time and of peak memory, and the exponents of growth. Exits with 1 when the peers disagree.
"""

import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent


def run(command):
    """Processor time [s] and peak memory [MB] of a command, and what it prints."""
    with tempfile.TemporaryFile("w+") as out:
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"{command[0]} {command[1]}: ended with {os.waitstatus_to_exitcode(status)}")
        out.seek(0)
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0, out.read()


def main():
    parser = argparse.ArgumentParser(description="growth of the rotary table with its angles")
    parser.add_argument("gumcert")
    parser.add_argument("--angles", default="36,360,3600")
    parser.add_argument("--repetitions", type=int, default=5)
    arguments = parser.parse_args()
    sizes = [int(size) for size in arguments.angles.split(",")]
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for angles in sizes:
            folder = pathlib.Path(work, str(angles))
            run([sys.executable, str(HERE / "rotary_table_campaign.py"), str(folder), "--angles", str(angles),
                 "--stated-weights"])
            record = folder / "record.json"
            ours, peers = [], []
            for _ in range(arguments.repetitions):  # in turns: a change of the load of the machine meets both
                ours.append(run([arguments.gumcert, "evaluate", "-q", str(folder / "job.json"), "-o", str(record)]))
                peers.append(json.loads(run([sys.executable, "-B", str(HERE / "numpy_rotary_table.py"), str(folder),
                                             str(record)])[2]))
            rows.append((angles, statistics.median(time for time, _, _ in ours), max(memory for _, memory, _ in ours),
                         {key: statistics.median(peer[key] for peer in peers) for key in peers[0]}))
    print("| angles | gumcert evaluate, s | MB | NumPy Schur, solve, s | its uncertainties, s | SuperLU, solve, s | peers, MB |")
    print("|---|---|---|---|---|---|---|")
    for angles, seconds, memory, peer in rows:
        print(f"| {angles} | {seconds:.2f} | {memory:.0f} | {peer['schur_solve_s']:.4f} "
              f"| {peer['schur_uncertainties_s']:.4f} | {peer['superlu_solve_s']:.4f} | {peer['superlu_memory_MB']:.0f} |")
    print()
    for before, after in zip(rows, rows[1:]):
        exponent = math.log(after[1] / before[1]) / math.log(after[0] / before[0])
        print(f"Growth of the evaluation from {before[0]} to {after[0]} angles: exponent {exponent:.2f}.")


if __name__ == "__main__":
    main()
