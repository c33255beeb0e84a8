#!/usr/bin/env python3
"""Times the whole program on a rotary table without and with wrong distances.

    rotary_table_outliers.py GUMCERT [--campaigns N]

6 stations, 6 reflectors, 36 angles, both senses of approach, all variances estimated (rotary_table_campaign.py). Prints a
Markdown table of the processor time as a multiple of that without wrong distances: median and largest over the campaigns.
"""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
SIZES = (("0.5 µm to 5 µm", 5e-7, 5e-6), ("10 µm to 100 µm", 1e-5, 1e-4), ("0.1 mm to 1 mm", 1e-4, 1e-3),
         ("1 mm to 30 mm", 1e-3, 0.03), ("30 mm to 1 m", 0.03, 1.0), ("0.5 µm to 1 m", 5e-7, 1.0))
REPETITIONS = 3


def seconds(command):
    """Least processor time [s] of some runs of a command."""
    times = []
    for _ in range(REPETITIONS):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"{' '.join(command)}: ended with {os.waitstatus_to_exitcode(status)}")
        times.append(usage.ru_utime + usage.ru_stime)
    return min(times)


def main():
    parser = argparse.ArgumentParser(description="time of an evaluation with wrong distances")
    parser.add_argument("gumcert")
    parser.add_argument("--campaigns", type=int, default=5)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:

        def evaluation(seed, *more):
            subprocess.run([sys.executable, "-B", str(HERE / "rotary_table_campaign.py"), work, "--both-senses",
                            "--seed", str(seed), *more], check=True)
            return seconds([arguments.gumcert, "evaluate", "-q", f"{work}/job.json", "-o", f"{work}/record.json"])

        without = [evaluation(seed) for seed in range(arguments.campaigns)]
        print(f"Without wrong distances: {statistics.median(without):.2f} s.\n")
        print("| size of the errors | 1 % wrong, median | largest | 5 % wrong, median | largest |")
        print("|---|---|---|---|---|")
        for name, least, largest in SIZES:
            cells = []
            for share in (0.01, 0.05):
                ratios = [evaluation(seed, "--outliers", str(share), "--least", str(least), "--largest", str(largest)) /
                          without[seed] for seed in range(arguments.campaigns)]
                cells += [f"{statistics.median(ratios):.1f}", f"{max(ratios):.1f}"]
            print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
