#!/usr/bin/env python3
"""Kills writers of an archive at a random moment (kill -9), and looks for everything that was acknowledged.

    crash_test.py --driver archive_driver [--rounds N] [--seed S]

Each round one or two writers draft certificates into the same archive until they are killed. Afterwards every record that
was acknowledged is there with its bytes, the archive is sound for both verifiers, and what was asked for with a key
before the kill is found by it: asked again, it is not drafted twice.
kill -9 does not test the disk: what the system has taken survives. A simulated power cut belongs to a later harness.
"""

import argparse
import importlib.util
import pathlib
import random
import sqlite3
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("verify_archive", ROOT / "tools" / "verify_archive.py")
verify_archive = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(verify_archive)


def new_archive(driver, folder, start):
    """An archive that anybody may draft into, with numbers given elsewhere."""
    for seed in range(start, start + 1000):
        store = folder / f"{seed}.archive"
        subprocess.run([driver, "make", store, str(seed), "0"], check=True)
        database = sqlite3.connect(store)
        body = verify_archive.strict_object(database.execute("SELECT body FROM log").fetchone()[0])
        database.close()
        if not body["settings"]["numbering"] and not body["settings"]["persons"]:
            return store
        store.unlink()
    raise SystemExit("no archive of chance lets anybody draft")


def judged(driver, store):
    """The program's own verdict."""
    return subprocess.run([driver, "judge"], input=f"{store}\n", stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--rounds", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = random.Random(options.seed)
    faults, acknowledged, ahead, store = [], {}, 0, None
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for round_ in range(options.rounds):
            if round_ % 25 == 0:  # archives stay small, so that each round looks at all of it
                store, acknowledged = new_archive(options.driver, folder, 1000 * round_ + options.seed), {}
            names = [f"W{round_}{letter}" for letter in ("a", "b")[:1 + (round_ % 4 == 3)]]
            logs = [folder / f"{who}.out" for who in names]
            writers = []
            for who, log in zip(names, logs):
                with open(log, "wb") as stream:
                    writers.append(subprocess.Popen([options.driver, "write", store, who, "100000"], stdout=stream))
            time.sleep(rng.uniform(0.01, 0.25))
            for writer in writers:
                writer.kill()
                writer.wait()
            for log in logs:
                for line in log.read_text().split("\n")[:-1]:  # a line without its end was not told
                    number, seq, record = line.split()
                    acknowledged[number] = (int(seq), record)
            verdict = judged(options.driver, store)
            if verdict != "sound":
                faults.append(f"round {round_}: {verdict}")
            faults += [f"round {round_}: {finding}" for finding in verify_archive.findings(store)]
            database = sqlite3.connect(store)
            kept = {row[0]: row[1:] for row in database.execute("SELECT certificate, seq, record FROM log WHERE kind = 'drafted'")}
            database.close()
            lost = [number for number, what in acknowledged.items() if kept.get(number) != what]
            faults += [f"round {round_}: {number} was acknowledged and is lost" for number in lost]
            of_round = [number for number in kept if number.rsplit("-", 1)[0] in names]
            ahead += len([number for number in of_round if number not in acknowledged])
            if of_round:  # the client asks again, from the first one on
                who = of_round[0].rsplit("-", 1)[0]
                again = subprocess.run([options.driver, "write", store, who, "1"], stdout=subprocess.PIPE, text=True, check=True)
                if int(again.stdout.split()[1]) != kept[f"{who}-0"][0]:
                    faults.append(f"round {round_}: asked again with the same key, {who}-0 was drafted twice")
            acknowledged.update({number: what for number, what in kept.items() if number in of_round})
        for fault in faults[:50]:
            print(fault)
        print(f"{options.rounds} rounds, {len(acknowledged)} records in the last archive, {ahead} kept that were not acknowledged yet, "
              f"{len(faults)} faults")
        return 1 if faults or not acknowledged else 0


if __name__ == "__main__":
    sys.exit(main())
