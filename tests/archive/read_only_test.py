#!/usr/bin/env python3
"""Reads archives where nothing can be written, and where something could: nothing is left behind, nothing is changed.

    read_only_test.py --driver archive_driver --program gumcert

- in a folder that cannot be written both verifiers read an archive, and every action that reads does
- who may write the folder and not the archive leaves nothing that its owner could not write
- an archive with several names is read by each of them, and written by none
- an action that reads, and the second verifier, leave no file beside an archive, and the archive with its bytes
- entries that stand in the write-ahead log are read, and stay there
- a log that was written for another archive is refused by all of them, and nothing is changed
- what cannot be read is exit code 5 for both, not an archive that is not sound
"""

import argparse
import os
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOBODY = 65534
faults = []


def expect(condition, what):
    if not condition:
        faults.append(what)
        print(what)


def files_in(folder):
    return {file.name: file.read_bytes() for file in sorted(folder.iterdir())}


class Readers:
    def __init__(self, program):
        self.program = pathlib.Path(program).resolve()
        # Rights do not stop root.
        self.drop = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}

    def run(self, words, unprivileged):
        return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, cwd="/", **(self.drop if unprivileged else {}))

    def all(self, archive, number, unprivileged=False):
        """Name, exit code and what was said of every reader."""
        for action in (["verify"], ["list"], ["show", number], ["head"], ["statistics"], ["export", number, "-o", "-"],
                       ["affected", "--source", "STD-1", "--since", "2026-01-01"]):
            yield action[0], self.run([self.program, "archive", *action, "--store", archive], unprivileged)
        yield "verify_archive.py", self.run([sys.executable, "-B", ROOT / "tools" / "verify_archive.py", archive], unprivileged)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--program", required=True)
    options = parser.parse_args()
    readers = Readers(options.program)
    driver = pathlib.Path(options.driver).resolve()
    with tempfile.TemporaryDirectory() as name:
        base = pathlib.Path(name)
        base.chmod(0o755)
        folder = base / "a folder #1?"
        folder.mkdir()
        archive = folder / "a%20.archive"
        subprocess.run([driver, "fill", archive, "3", ROOT / "tests" / "fuzz" / "corpus" / "archive" / "superseded.json"], check=True)
        backup = base / "backup.archive"
        subprocess.run([options.program, "archive", "backup", "--store", archive, "--by", "K", "--today", time.strftime("%Y-%m-%d", time.gmtime()), "-o", backup], check=True, capture_output=True)
        with sqlite3.connect(f"file:{archive.as_posix().replace('%', '%25').replace('#', '%23').replace('?', '%3f')}?mode=ro", uri=True) as database:
            number = database.execute("SELECT certificate FROM listed ORDER BY certificate").fetchone()[0]
        database.close()
        for ending in ("-wal", "-shm"):
            (folder / (archive.name + ending)).unlink(missing_ok=True)

        before = files_in(folder)
        expect(list(before) == [archive.name], f"beside an archive that is closed stand {list(before)}")
        for reader, ended in readers.all(archive, number):
            expect(ended.returncode in (0, 1), f"{reader}: {ended.returncode} {ended.stderr}")
            expect("NOT SOUND" not in ended.stdout, f"{reader}: {ended.stdout}")
            expect(files_in(folder) == before, f"{reader} leaves {sorted(files_in(folder))}, or another archive")

        folder.chmod(0o777)
        archive.chmod(0o644)
        for reader, ended in readers.all(archive, number, unprivileged=True):
            expect(ended.returncode in (0, 1), f"{reader}, a folder of everybody: {ended.returncode} {ended.stderr}")
            expect(files_in(folder) == before, f"{reader}, a folder of everybody: leaves {sorted(files_in(folder))}")

        link = folder / "link.archive"
        os.link(archive, link)
        for reader, ended in readers.all(link, number):
            expect(ended.returncode in (0, 1), f"{reader}, a link: {ended.returncode} {ended.stderr}")
            expect(len(files_in(folder)) == 2, f"{reader}, a link: leaves {sorted(files_in(folder))}")
        for one in (archive, link):
            ended = readers.run([readers.program, "archive", "settings", "--store", one, "--by", "K", "--why", "agreed"], False)
            expect(ended.returncode == 5 and "GC-ARCHIVE-0014" in ended.stderr, f"written by one of two names: {ended.returncode} {ended.stderr}")
        link.unlink()
        expect(files_in(folder) == before, "an archive with two names was written")

        folder.chmod(0o555)
        archive.chmod(0o444)
        for reader, ended in readers.all(archive, number, unprivileged=True):
            expect(ended.returncode in (0, 1), f"{reader}, a folder that cannot be written: {ended.returncode} {ended.stderr}")
            expect("NOT SOUND" not in ended.stdout, f"{reader}, a folder that cannot be written: {ended.stdout}")
        expect(files_in(folder) == before, "somebody wrote where nothing can be written")

        archive.chmod(0o000)
        for reader, ended in readers.all(archive, number, unprivileged=True):
            expect(ended.returncode == 5, f"{reader}, a file that cannot be read: {ended.returncode} {ended.stdout}{ended.stderr}")
        archive.chmod(0o644)

        # Entries in the write-ahead log, as a writer that was killed leaves them.
        folder.chmod(0o755)
        writer = sqlite3.connect(archive)
        writer.execute("PRAGMA wal_autocheckpoint = 0")
        writer.execute("BEGIN IMMEDIATE")
        writer.execute("UPDATE listed SET item = 'another' WHERE certificate = ?", (number,))
        writer.execute("COMMIT")
        other = base / "killed"
        other.mkdir()
        for ending in ("", "-wal"):
            shutil.copy(folder / (archive.name + ending), other / ("b.archive" + ending))
        writer.close()
        before = {name: content for name, content in files_in(other).items()}
        expect(len(before) == 2 and before["b.archive-wal"], "no entry in the write-ahead log")
        for reader, ended in readers.all(other / "b.archive", number):
            expect(ended.returncode in (0, 1), f"{reader}, with a log: {ended.returncode} {ended.stderr}")
            if reader in ("verify", "verify_archive.py"):
                expect(ended.returncode == 1, f"{reader} does not read the write-ahead log")
            now = files_in(other)
            expect({name: now.get(name) for name in before} == before, f"{reader} changes an archive with a log, or its log")
        (other / "b.archive-shm").unlink(missing_ok=True)
        other.chmod(0o555)
        codes = {reader: ended.returncode for reader, ended in readers.all(other / "b.archive", number, unprivileged=True)
                 if reader in ("verify", "verify_archive.py")}
        expect(set(codes.values()) == {5}, f"a log that cannot be read: {codes}")
        other.chmod(0o755)

        # A backup at the place of an archive whose log was left: SQLite would replace its pages.
        restored = base / "restored"
        restored.mkdir()
        shutil.copy(backup, restored / "b.archive")
        (restored / "b.archive-wal").write_bytes(before["b.archive-wal"])
        before = files_in(restored)
        for reader, ended in readers.all(restored / "b.archive", number):
            expect(ended.returncode == 5 and "was written for another archive" in ended.stderr,
                   f"{reader}, a log of another archive: {ended.returncode} {ended.stdout}{ended.stderr}")
        expect(files_in(restored) == before, "a backup, or the log beside it, was changed")
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
