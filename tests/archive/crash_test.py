#!/usr/bin/env python3
"""Kills writers of an archive at a random moment (kill -9), and looks for everything that was acknowledged.

    crash_test.py --driver archive_driver [--rounds N] [--server-rounds N] [--seed S]

Each round one or two writers draft certificates into the same archive until they are killed. Afterwards every record that
was acknowledged is there with its bytes, the archive is sound for both verifiers, and what was asked for with a key
before the kill is found by it: asked again, it is not drafted twice.
On a server of PostgreSQL every second kill is one of the server itself, which recovers when it is started again.
kill -9 does not test the disk: what the system has taken survives. power_cuts_test.cpp does.
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

import postgresql_server

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


def start_writers(driver, store, names, folder):
    writers = []
    for who in names:
        with open(folder / f"{who}.out", "wb") as stream:
            writers.append(subprocess.Popen([driver, "write", store, who, "100000"], stdout=stream, stderr=subprocess.DEVNULL))
    return writers


def told(names, folder):
    """What the writers said that was kept: number → place in the log and record."""
    lines = [line for who in names for line in (folder / f"{who}.out").read_text().split("\n")[:-1]]  # a line without its end was not told
    return {number: (int(seq), record) for number, seq, record in map(str.split, lines)}


def drafts_in(file):
    database = sqlite3.connect(file)
    kept = {row[0]: row[1:] for row in database.execute("SELECT certificate, seq, record FROM log WHERE kind = 'drafted'")}
    database.close()
    return kept


class Trial:
    """Kills in a file, or on a server where there is one."""

    def __init__(self, options, folder, server=None):
        self.driver, self.seed, self.folder, self.server = options.driver, options.seed, folder, server
        self.rng = random.Random(options.seed)
        self.faults, self.acknowledged, self.known, self.ahead, self.store = [], 0, {}, 0, None

    def new_store(self, round_):
        self.store, self.known = new_archive(self.driver, self.folder, 1000 * round_ + self.seed), {}
        if self.server:
            file, self.store = self.store, self.server.new_database()
            subprocess.run([self.driver, "migrate", file, self.store], check=True)
            file.unlink()

    def as_file(self):
        """The archive as a file, for the verifier that reads files."""
        if not self.server:
            return self.store
        copy = self.folder / "copy.archive"
        copy.unlink(missing_ok=True)
        subprocess.run([self.driver, "migrate", self.store, copy], check=True)
        return copy

    def kill(self, round_, names, writers):
        if self.server:  # it takes its time until the first one is kept
            while all(writer.poll() is None for writer in writers) and not told(names, self.folder):
                time.sleep(0.01)
        time.sleep(self.rng.uniform(0.01, 0.25))
        if self.server and round_ % 2 == 1:
            self.server.kill()
        for writer in writers:
            writer.kill()
            writer.wait()
        if self.server and round_ % 2 == 1:
            self.server.start()

    def run(self, rounds):
        for round_ in range(rounds):
            if round_ % 25 == 0:  # archives stay small, so that each round looks at all of it
                self.new_store(round_)
            names = [f"W{round_}{letter}" for letter in ("a", "b")[:1 + (round_ % 4 >= 2)]]
            self.kill(round_, names, start_writers(self.driver, self.store, names, self.folder))
            self.faults += [f"round {round_}: {fault}" for fault in self.faults_behind(names)]
        kills = f"{rounds} rounds {'on a server' if self.server else 'in a file'}"
        print(f"{kills}: {self.acknowledged} records acknowledged, {self.ahead} kept that were not acknowledged yet, "
              f"{len(self.faults)} faults")
        return self.faults or ([] if self.acknowledged else [f"{kills}, and nothing was acknowledged"])

    def faults_behind(self, names):
        of_round = told(names, self.folder)
        self.acknowledged += len(of_round)
        self.known.update(of_round)
        if (verdict := judged(self.driver, self.store)) != "sound":
            yield verdict
        file = self.as_file()
        yield from verify_archive.findings(file)
        kept = drafts_in(file)
        yield from (f"{number} was acknowledged and is lost" for number, what in self.known.items() if kept.get(number) != what)
        ahead = {number: what for number, what in kept.items() if number not in self.known}
        self.ahead += len(ahead)
        self.known.update(ahead)
        for who in [who for who in names if f"{who}-0" in kept][:1]:  # the client asks again, from the first one on
            again = subprocess.run([self.driver, "write", self.store, who, "1"], stdout=subprocess.PIPE, text=True, check=True)
            if int(again.stdout.split()[1]) != kept[f"{who}-0"][0]:
                yield f"asked again with the same key, {who}-0 was drafted twice"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--rounds", type=int, default=50)
    parser.add_argument("--server-rounds", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    faults = []
    if options.rounds:
        with tempfile.TemporaryDirectory() as folder:
            faults += Trial(options, pathlib.Path(folder)).run(options.rounds)
    if options.server_rounds:
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory(dir="/tmp") as place:
            with postgresql_server.Server(place) as server:
                if server.runs:
                    faults += Trial(options, pathlib.Path(folder), server).run(options.server_rounds)
                else:
                    print(postgresql_server.ABSENT)
    for fault in faults[:50]:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
