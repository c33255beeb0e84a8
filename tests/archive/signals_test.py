#!/usr/bin/env python3
"""Ends commands that write archives by Ctrl-C, SIGTERM and kill -9 at every moment, and holds what they say against what is there.

    signals_test.py --program gumcert [--moments N]

- "nothing was written" is said where nothing was: no new entry, no new file
- where an entry is in the log, it is named, or it is said that this is not known
- it ends where nobody reads what it says, too
- what a command begins is there whole, and sound, or not at all; nothing stays beside it, and what a kill leaves the next command removes
"""

import argparse
import pathlib
import re
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

faults = []


def expect(condition, what):
    if not condition:
        faults.append(what)
        print(what)


def entries_in(archive):
    database = sqlite3.connect(archive)
    count = database.execute("SELECT count(*) FROM log").fetchone()[0]
    database.close()
    return count


class Trial:
    def __init__(self, program, folder):
        self.program, self.folder, self.store = pathlib.Path(program).resolve(), folder, folder / "lab.archive"
        self.run("init", "--store", self.store, "--by", "K", "--numbering", "N-#####", "--no-four-eyes")
        for _ in range(20):
            self.run("number", "--store", self.store, "--by", "K")
        self.ended = 0

    def run(self, *words):
        subprocess.run([self.program, "archive", *words, "-q"], check=True, stdout=subprocess.DEVNULL)

    def words(self, action, out):
        return {"number": ["number", "--store", self.store, "--by", "K"],
                "settings": ["settings", "--store", self.store, "--by", "K", "--why", "agreed", "--numbering", "N-#####", "--no-four-eyes"],
                "init": ["init", "--store", out, "--by", "K"],
                "migrate": ["migrate", "--store", self.store, "--to", out],
                "backup": ["backup", "--store", self.store, "--by", "K", "-o", out]}[action]

    def duration(self, action):
        begin = time.monotonic()
        self.run(*self.words(action, self.folder / "first.archive"))
        (self.folder / "first.archive").unlink(missing_ok=True)
        return time.monotonic() - begin

    def others(self):
        return sorted(file.name for file in self.folder.iterdir() if not file.name.startswith(self.store.name))

    def one(self, action, after, by):
        name = f"{action} ended by {by.name} after {after * 1000:.1f} ms"
        out, before = self.folder / "new.archive", entries_in(self.store)
        process = subprocess.Popen([self.program, "archive", *self.words(action, out)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(after)
        process.send_signal(by)
        _, said = process.communicate()
        added = entries_in(self.store) - before
        if by != signal.SIGKILL:
            expect(not [one for one in self.others() if one != out.name], f"{name}: leaves {self.others()}")
        if process.returncode == -by and by != signal.SIGKILL and said:  # it may come before anything is caught
            self.ended += 1
            nothing, unknown = "nothing was written" in said, "is not known" in said
            expect(nothing == (not added and not out.exists()) or unknown, f"{name}: {added} entries, {self.others()}: {said}")
            expect(unknown or nothing or not added or re.search(r"in the archive: .*entry \d+", said), f"{name}: the entry is not named: {said}")
        if out.exists():
            verified = subprocess.run([self.program, "archive", "verify", "--store", out], capture_output=True, text=True, check=False)
            expect(verified.returncode == 0, f"{name}: what is there is {verified.stdout}{verified.stderr}")
            out.unlink()
        if by == signal.SIGKILL and action in ("init", "migrate", "backup"):
            self.run(*self.words(action, out))
            expect(self.others() == [out.name], f"{name}: the next one leaves {self.others()}")
            out.unlink()

    def without_a_reader(self):
        """A command that waits for another writer, ended when nobody reads any more what it says."""
        writer = sqlite3.connect(self.store)
        writer.execute("BEGIN IMMEDIATE")
        process = subprocess.Popen([self.program, "archive", "number", "--store", self.store, "--by", "K"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        time.sleep(1.0)
        process.stderr.close()
        process.send_signal(signal.SIGTERM)
        try:
            ended = process.wait(30)
            expect(ended == -signal.SIGTERM, f"without a reader it ends with {ended}")
        except subprocess.TimeoutExpired:
            process.kill()
            expect(False, "it does not end where nobody reads what it says")
        writer.close()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--moments", type=int, default=16)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        trial = Trial(options.program, pathlib.Path(name))
        for action in ("number", "settings", "init", "migrate", "backup"):
            whole = min(trial.duration(action) for _ in range(3))
            for moment in range(options.moments):
                for by in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)[:3 if moment % 4 == 0 else 1]:
                    trial.one(action, 1.2 * whole * (moment + 1) / options.moments, by)
        trial.without_a_reader()
        expect(trial.ended > 0, "no signal came while a command was at work")
        print(f"{trial.ended} commands ended by a signal that they answered")
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
