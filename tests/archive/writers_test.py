#!/usr/bin/env python3
"""Several programs take certificate numbers from one archive at the same time: no gap, no number twice.

    writers_test.py --driver archive_driver [--writers N] [--numbers N]

First in a file, then on a server of PostgreSQL, where Debian's package is there.
"""

import argparse
import importlib.util
import pathlib
import sqlite3
import subprocess
import sys
import tempfile

import postgresql_server

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("verify_archive", ROOT / "tools" / "verify_archive.py")
verify_archive = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(verify_archive)


def archive_with_numbering(driver, folder):
    """An archive of chance that gives numbers and lets anybody take them."""
    for seed in range(1000):
        store = folder / f"{seed}.archive"
        subprocess.run([driver, "make", store, str(seed), "3"], check=True)
        database = sqlite3.connect(store)
        bodies = [body for (body,) in database.execute("SELECT body FROM log WHERE kind IN ('created', 'settings') ORDER BY seq")]
        taken = database.execute("SELECT count(*) FROM log WHERE kind = 'numbered'").fetchone()[0]
        database.close()
        body = verify_archive.strict_object(bodies[-1])
        settings = body.get("settings") or body["new"]
        if settings["numbering"] and not settings["persons"]:
            return store, taken
    raise SystemExit("no archive of chance gives numbers")


def take_numbers(options, store, before):
    """Faults of writers that take numbers at the same time."""
    writers = [subprocess.Popen([options.driver, "number", store, f"W{i}", str(options.numbers)], stdout=subprocess.PIPE, text=True)
               for i in range(options.writers)]
    taken = [number for writer in writers for number in writer.communicate()[0].split()]
    faults = [f"writer {i} ended with {w.returncode}" for i, w in enumerate(writers) if w.returncode]
    total = options.writers * options.numbers
    expected = [f"EX-2026-{ordinal:04}" for ordinal in range(before + 1, before + total + 1)]
    if sorted(taken) != expected:
        faults.append(f"{len(taken)} numbers, {len(set(taken))} different ones, {len(set(expected) - set(taken))} missing")
    again = subprocess.run([options.driver, "number", store, "W0", "1"], stdout=subprocess.PIPE, text=True, check=True)
    if again.stdout.split()[0] not in taken:
        faults.append("a request with a key that is known took a new number")
    return faults


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--writers", type=int, default=8)
    parser.add_argument("--numbers", type=int, default=50)
    options = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as name, tempfile.TemporaryDirectory(dir="/tmp") as place:
        folder = pathlib.Path(name)
        store, before = archive_with_numbering(options.driver, folder)
        with postgresql_server.Server(place) as server:
            address = server.new_database() if server.runs else None
            if address:
                subprocess.run([options.driver, "migrate", store, address], check=True)
            for where in [store, address]:
                if where is None:
                    print(postgresql_server.ABSENT)
                    continue
                faults = take_numbers(options, where, before)
                copy = where
                if where == address:
                    copy = folder / "copy.archive"
                    subprocess.run([options.driver, "migrate", address, copy], check=True)
                faults += list(verify_archive.findings(copy))
                for fault in faults:
                    print(fault)
                print(f"{'on a server' if where == address else 'in a file'}: {options.writers * options.numbers} numbers by "
                      f"{options.writers} writers, {len(faults)} faults")
                failed += len(faults)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
