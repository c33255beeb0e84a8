#!/usr/bin/env python3
"""Fills a small file system with an archive: what was acknowledged is there, and the archive is used on when there is space.

    disk_full_test.py --driver archive_driver --program gumcert

A file system of 2 MiB in memory is mounted where only this test sees it. Where that is not permitted, the test is
skipped (exit code 77).
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import writers_test
from writers_test import verify_archive

SKIPPED = 77
IN_NAMESPACE = "GUMCERT_DISK_FULL_PLACE"


def mounted_elsewhere():
    """Runs this program again where mounts are its own. Its exit code."""
    with tempfile.TemporaryDirectory() as place:
        ended = subprocess.run(["unshare", "--mount", "--propagation", "private", "sh", "-c",
                                'mount -t tmpfs -o size=2m none "$0" || exit 77; exec "$@"', place, sys.executable, "-B", *sys.argv],
                               env={**os.environ, IN_NAMESPACE: place}, stderr=subprocess.PIPE, text=True, check=False)
    if ended.returncode == SKIPPED or "unshare" in ended.stderr:
        print(f"no file system of its own: {ended.stderr.strip()}")
        return SKIPPED
    sys.stderr.write(ended.stderr)
    return ended.returncode


def faults_of(options, place):
    def gumcert(*words):
        return subprocess.run([options.program, "archive", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              check=False)

    def is_refused(ended):
        return ended.returncode == 5 and "[GC-ARCHIVE-0005]" in ended.stderr

    store, _ = writers_test.archive_with_numbering(options.driver, place)
    ballast = place / "ballast"
    ballast.write_bytes(bytes(400_000))
    writer = subprocess.run([options.driver, "number", store, "W", "100000"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, check=False)
    numbers = writer.stdout.split()
    if writer.returncode != 1 or "free some space" not in writer.stderr:
        yield f"the writer ended with {writer.returncode}: {writer.stderr}"
    take = ["number", "--store", store, "--by", "A. Author", "--request-key", "again"]
    ended = gumcert(*take)
    if not is_refused(ended):
        yield f"number on a full disk ended with {ended.returncode}: {ended.stderr}"
    ended = gumcert("verify", "--store", store)
    if ended.returncode != 0 and not is_refused(ended):
        yield f"verify on a full disk ended with {ended.returncode}: {ended.stdout} {ended.stderr}"
    ended = gumcert("init", "--store", place / "other.archive", "--by", "K. Keeper")
    if not is_refused(ended) or (place / "other.archive").exists():
        yield f"init on a full disk ended with {ended.returncode}: {ended.stderr}"
    ballast.unlink()
    for words in (take, ["verify", "--store", store], ["init", "--store", place / "other.archive", "--by", "K. Keeper"]):
        ended = gumcert(*words)
        if ended.returncode != 0:
            yield f"{words[0]} with space again ended with {ended.returncode}: {ended.stdout} {ended.stderr}"
    yield from verify_archive.findings(store)
    listed = gumcert("list", "--store", store).stdout
    lost = [number for number in numbers if number not in listed]
    yield from (f"{number} was acknowledged and is lost" for number in lost)
    print(f"{len(numbers)} numbers acknowledged before the disk was full, {len(lost)} lost")
    if not numbers:
        yield "nothing was acknowledged"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--program", required=True)
    options = parser.parse_args()
    if IN_NAMESPACE not in os.environ:
        return mounted_elsewhere()
    faults = list(faults_of(options, pathlib.Path(os.environ[IN_NAMESPACE])))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
