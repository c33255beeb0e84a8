#!/usr/bin/env python3
"""How long a large archive takes: drafts a second, each durable by itself; verifying, listing, search for a standard.

    bench/archive_size.py PROGRAM DRIVER RECORD [--certificates 100000]

DRIVER is tests/archive_driver of the build, RECORD one of a certificate with the number EX-2026-0042. Every certificate of the archive
has its record, with another number; STD-017 is searched for, and a standard that does not exist.
"""

import argparse
import subprocess
import tempfile
import time
from pathlib import Path


def seconds(*command) -> float:
    began = time.monotonic()
    done = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stderr)
    return time.monotonic() - began


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("driver", type=Path)
    parser.add_argument("record", type=Path)
    parser.add_argument("--certificates", type=int, default=100_000)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        store = Path(name) / "large.archive"
        filling = seconds(options.driver, "fill", store, options.certificates, options.record)
        print(f"{options.certificates} certificates, {store.stat().st_size / 2**20:.0f} MiB")
        print(f"append    {options.certificates / filling:8.0f} per second")
        archive = [options.program, "archive"]
        affected = ["affected", "--since", "2000-01-01", "--source"]
        for what, words in (("list", ["list"]), ("show", ["show", "L-0"]), ("head", ["head"]), ("verify", ["verify"]),
                            ("search, none", [*affected, "STD-999"]), ("search, all", [*affected, "STD-017"])):
            print(f"{what:<13} {seconds(*archive, *words, '--store', store, '-q'):8.2f} s", flush=True)


if __name__ == "__main__":
    main()
