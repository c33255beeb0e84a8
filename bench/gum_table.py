#!/usr/bin/env python3
"""Table of the benchmark of the GUM engine from what scripts/bench measured.

    gum_table.py FOLDER

FOLDER has program_*.json (gum_bench), peers_*.json (gum_peers.py), one of each a round, values.json (gum_bench
--write-values) and memory_*.json (monte_carlo_memory). Checks that all found the same, prints Markdown; exits with 1
when they did not.
"""

import json
import math
import statistics
import sys
from pathlib import Path

TARGET_MS = {"monte_carlo/1": 50.0, "monte_carlo/2": 30.0, "law_of_propagation": 0.01}


def rounds(folder, pattern):
    return [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob(pattern))]


def program_times(folder):
    """Benchmark → median wall time and processor time, ms."""
    times = {}
    for document in rounds(folder, "program_*.json"):
        for run in document["benchmarks"]:
            if run["run_type"] == "iteration":
                factor = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}[run["time_unit"]]
                name = run["run_name"].removesuffix("/process_time/real_time")
                times.setdefault(name, []).append((factor * run["real_time"], factor * run["cpu_time"]))
    return {name: tuple(map(statistics.median, zip(*runs))) for name, runs in times.items()}


def peer_times(folder):
    documents = rounds(folder, "peers_*.json")
    times = {name: tuple(1e3 * statistics.median(time for document in documents for time in document["peers"][name][kind])
                         for kind in ("wall_s", "processor_s")) for name in documents[0]["peers"]}
    return times, documents[0]


def agree(values, peers):
    """Monte Carlo within its numerical error, the law of propagation to the last digits."""
    same = True

    def check(name, quantity, ours, theirs, tolerance):
        nonlocal same
        if not abs(ours - theirs) <= tolerance:
            same = False
            print(f"{name}: {quantity} {theirs}, gumcert {ours}", file=sys.stderr)

    ours = values["monte_carlo"]
    for name in ("numpy", "openturns_1", "openturns_2"):
        found = peers[name]["found"]
        check(name, "y", ours["y"], found["y"], 6e-3 * ours["u"])
        check(name, "u", ours["u"], found["u"], 6e-3 * ours["u"])
        for end in ("low", "high"):
            check(name, end, ours[end], found[end], 6.0 * math.sqrt(2.0) * ours[f"error_of_{end}"])
    ours = values["law_of_propagation"]
    for quantity in ("y", "u", "degrees_of_freedom", "U"):
        check("uncertainties", quantity, ours[quantity], peers["uncertainties"]["found"][quantity],
              1e-9 * abs(ours[quantity]))
    return same


def shown(milliseconds):
    return f"{milliseconds:.4g} ms" if milliseconds >= 1.0 else f"{1e3 * milliseconds:.3g} µs"


def main():
    folder = Path(sys.argv[1])
    program = program_times(folder)
    theirs, first = peer_times(folder)
    if not agree(json.loads((folder / "values.json").read_text(encoding="utf-8")), first["peers"]):
        sys.exit("the results do not agree: the times would not be of the same work")
    versions = first["versions"]
    numpy, openturns = f"NumPy {versions['NumPy']}, by hand", f"OpenTURNS {versions['OpenTURNS']}"
    print("| work | gumcert, wall | processor | target | met | peer | peer, wall | processor | ratio, wall | ratio, processor |\n"
          "|---|---|---|---|---|---|---|---|---|---|")
    for work, key, peer, peer_key in (
            ("Monte Carlo, 1 thread", "monte_carlo/1", f"{numpy}, 1 thread", "numpy"),
            ("Monte Carlo, 1 thread", "monte_carlo/1", f"{openturns}, 1 thread", "openturns_1"),
            ("Monte Carlo, 2 threads", "monte_carlo/2", f"{numpy}, 1 thread", "numpy"),
            ("Monte Carlo, 2 threads", "monte_carlo/2", f"{openturns}, 2 threads", "openturns_2"),
            ("law of propagation", "law_of_propagation", f"uncertainties {versions['uncertainties']}", "uncertainties")):
        ours, target = program[key], TARGET_MS[key]
        peers = theirs[peer_key]
        print(f"| {work} | {shown(ours[0])} | {shown(ours[1])} | {shown(target)} | {'yes' if ours[0] <= target else 'no'} "
              f"| {peer} | {shown(peers[0])} | {shown(peers[1])} | {peers[0] / ours[0]:.1f} | {peers[1] / ours[1]:.1f} |")
    print("\n| inputs of a sum, law of propagation | wall | processor | wall time an input |\n|---|---|---|---|")
    for inputs in (1_000, 10_000, 100_000):
        wall, processor = program[f"law_of_propagation_of_sum/{inputs}"]
        print(f"| {inputs} | {shown(wall)} | {shown(processor)} | {1e6 * wall / inputs:.0f} ns |")
    print("\n| trials, 2 threads | wall | largest memory of the process |\n|---|---|---|")
    for run in sorted(rounds(folder, "memory_*.json"), key=lambda run: run["trials"]):
        print(f"| 10^{round(math.log10(run['trials']))} | {run['wall_s']:.3g} s | {run['peak_kib'] / 1024.0:.1f} MiB |")


if __name__ == "__main__":
    main()
