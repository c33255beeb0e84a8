#!/usr/bin/env python3
"""Backups while writers are at work: each copy is sound, the log up to some entry with all that was acknowledged before, and nobody
waits long for it.

    backup_test.py --driver archive_driver --program gumcert [--backups N] [--writers N]

First of a file, then of a server of PostgreSQL, where Debian's package is there; then the file is migrated to a server, back into a
file, and onto a server again: all entries, contents and heads are the same.
"""

import argparse
import importlib.util
import json
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time

import postgresql_server

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("verify_archive", ROOT / "tools" / "verify_archive.py")
verify_archive = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(verify_archive)

LONGEST_WAIT = 20.0  # [s] of a writer beside backups that take less than a second, on a machine that does other things as well


class Writers:
    """Programs that draft certificates, and when each of these was acknowledged."""

    def __init__(self, driver, store, count):
        self.acknowledged = []  # numbers of entries
        self.longest_wait = 0.0
        self.programs = [subprocess.Popen([driver, "write", store, f"W{i}", "1000000"], stdout=subprocess.PIPE, text=True) for i in range(count)]
        self.readers = [threading.Thread(target=self.read, args=(program,)) for program in self.programs]
        for reader in self.readers:
            reader.start()

    def read(self, program):
        before = time.monotonic()
        for line in program.stdout:
            now = time.monotonic()
            self.longest_wait = max(self.longest_wait, now - before)
            before = now
            self.acknowledged.append(int(line.split()[1]))

    def end(self):
        for program in self.programs:
            program.kill()
            program.wait()
        for reader in self.readers:
            reader.join()


def rows(archive, table):
    database = sqlite3.connect(f"file:{archive}?mode=ro", uri=True)
    found = sorted(database.execute(f"SELECT * FROM {table}"))
    database.close()
    return found


def backups_under_load(options, archive, store, folder):
    """Faults of backups of a store."""
    faults, copies = [], []
    writers = Writers(options.driver, store, options.writers)
    while len(writers.acknowledged) < options.writers and all(program.poll() is None for program in writers.programs):
        time.sleep(0.01)
    today = time.strftime("%Y-%m-%d", time.gmtime())
    for i in range(options.backups):
        before = list(writers.acknowledged)
        head = folder / f"{len(list(folder.iterdir()))}.json"
        copy = head.with_suffix(".archive")
        archive("head", "--store", store, "-o", head)
        done = archive("backup", "--store", store, "--by", "A. Author", "--today", today, "-o", copy)
        if done.returncode:
            faults.append(f"backup {i}: exit code {done.returncode}, {done.stderr}")
            continue
        copies.append((copy, before))
        faults += [f"backup {i}: {fault}" for fault in verify_archive.findings(copy, [head])]
    writers.end()
    whole = folder / f"{len(list(folder.iterdir()))}.archive"
    archive("migrate", "--store", store, "--to", whole)
    log = rows(whole, "log")
    entries = {row[0] for row in log}
    faults += [f"entry {seq} was acknowledged and is lost" for seq in writers.acknowledged if seq not in entries]
    for copy, before in copies:
        copied = rows(copy, "log")
        if copied != log[:len(copied)]:
            faults.append(f"{copy.name} is not how the log began")
        if before and len(copied) < max(before):
            faults.append(f"{copy.name} has {len(copied)} entries, and entry {max(before)} had been acknowledged before")
    if writers.longest_wait > LONGEST_WAIT:
        faults.append(f"a writer waited {writers.longest_wait:.1f} s")
    print(f"{options.backups} backups beside {options.writers} writers: {len(writers.acknowledged)} entries acknowledged, longest wait "
          f"{writers.longest_wait:.2f} s, {len(faults)} faults")
    return faults


def migrations(archive, store, server, folder):
    """Faults of an archive that goes from a file to a server and back, and onto a server again."""
    places = [store, server.new_database(), folder / "back.archive", server.new_database()]
    faults = []
    for there, here in zip(places, places[1:]):
        done = archive("migrate", "--store", there, "--to", here)
        if done.returncode:
            faults.append(f"migrate: exit code {done.returncode}, {done.stderr}")
    heads = {archive("head", "--store", place).stdout for place in places}
    if len(heads) != 1:
        faults.append(f"{len(heads)} different heads after migrations")
    for table in ("log", "content", "listed"):
        if rows(store, table) != rows(places[2], table):
            faults.append(f"migrations change the table {table}")
    return faults


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--program", required=True)
    parser.add_argument("--backups", type=int, default=4)
    parser.add_argument("--writers", type=int, default=3)
    options = parser.parse_args()

    def archive(action, *words):
        return subprocess.run([options.program, "archive", action, *words, "--share", ROOT, "-q"], capture_output=True, text=True, check=False)

    faults = []
    with tempfile.TemporaryDirectory() as name, tempfile.TemporaryDirectory(dir="/tmp") as place, postgresql_server.Server(place) as server:
        folder = pathlib.Path(name)
        record, store, copies = folder / "record.json", folder / "a.archive", folder / "copies"
        copies.mkdir()
        record.write_text(json.dumps({"title": "x" * 200_000}), encoding="utf-8")  # a backup takes some time
        subprocess.run([options.driver, "fill", store, "40", record], check=True, stdout=subprocess.DEVNULL)
        address = server.new_database() if server.runs else None
        if address:
            archive("migrate", "--store", store, "--to", address)
        faults += backups_under_load(options, archive, store, copies)
        if address:
            faults += backups_under_load(options, archive, address, copies)
            faults += migrations(archive, store, server, folder)
        else:
            print(postgresql_server.ABSENT)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
