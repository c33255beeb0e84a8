#!/usr/bin/env python3
"""Makes every call of the system fail in turn while `gumcert run` replaces a set of outputs by another.

    inject_faults.py --program GUMCERT --library SYSTEM_FAULTS [--stride N] [--with-node] [--memory]

In the folder lies the old set. The n-th open, read, write, fsync, rename, mkdir, unlink, close, flock … fails with EIO or
ENOSPC, all from the n-th on fail, or the process is killed there (SIGKILL) or asked to end (SIGTERM, SIGINT). Then:

1. before anything else: the folder holds exactly the old files or exactly the new ones, or a journal says that it does
   not;
2. after the next command, which is refused for another reason: exactly the old ones or exactly the new ones;
3. exit code 0 with the new ones and the whole output of an undisturbed run, or 5 with a message that names a file, or
   the signal;
4. nothing is left in the temporary folder or beside the outputs, but for the record of the new set whose documents could not
   be made, whole in a folder of its own.

Without --with-node the page is set by a stand-in that hands out the PDF of an undisturbed run: the calls of gumcert are
the same, and the time is a tenth. --memory: every allocation in turn in place of every call.
"""

import argparse
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
STAND_IN = """#!/bin/sh
# node render.mjs MODULES WORKSPACE …: one document for each line.
while read -r line; do
    /bin/cp "{pdf}" "$3/certificate.pdf" && echo '{{"status":"done","memory":1}}'
done
"""
KINDS = {"EIO": ("5", 1), "ENOSPC": ("28", 1), "ENOSPC from there on": ("28", 1_000_000),
         "SIGKILL": ("signal 9", 1), "SIGTERM": ("signal 15", 1), "SIGINT": ("signal 2", 1)}


def files_of(folder, hidden=False):
    """Name and digest of each file in a folder."""
    if not folder.is_dir():
        return {}
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.iterdir()) if path.is_file() and (hidden or not path.name.startswith("."))}


KEPT = "record-kept"  # the set of an evaluation whose documents could not be made


class Bench:
    def __init__(self, arguments, folder):
        self.program, self.library = arguments.program.resolve(), arguments.library.resolve()
        self.folder = folder
        self.temporary = folder / "temporary"
        self.temporary.mkdir()
        self.path = os.environ.get("PATH", "")
        job = json.loads((ROOT / "examples/end_gauge/job.json").read_text(encoding="utf-8"))
        for name in ("old", "new"):
            job["title"] = f"The {name} job"
            (folder / f"{name}.json").write_text(json.dumps(job), encoding="utf-8")
        (folder / "refused.json").write_text("{}", encoding="utf-8")
        self.out = folder / "out"
        self.sets = {}

    def run(self, job, fault=None):
        environment = {"PATH": self.path, "TMPDIR": str(self.temporary)}
        if fault is not None:
            environment.update(fault, LD_PRELOAD=str(self.library))
        return subprocess.run([self.program, "run", self.folder / f"{job}.json", "-o", self.out, "--share", ROOT,
                               "--threads", "1"], env=environment, capture_output=True, check=False)

    def prepare(self, with_node):
        """The two sets, and what an undisturbed run says."""
        for name in ("old", "new"):
            ended = self.run(name)
            if ended.returncode != 0:
                raise SystemExit(f"{name}: {ended.stderr.decode()}")
            shutil.copytree(self.out, self.folder / f"set_{name}")
            self.sets[name] = files_of(self.out, hidden=True)
            self.said = ended.stdout
        if not with_node:
            (self.folder / "bin").mkdir()
            stand_in = self.folder / "bin" / "node"
            stand_in.write_text(STAND_IN.format(pdf=self.folder / "set_new" / "certificate.pdf"), encoding="utf-8")
            stand_in.chmod(0o755)
            self.path = str(self.folder / "bin")

    def restore(self, with_old):
        shutil.rmtree(self.out, ignore_errors=True)
        if with_old:
            shutil.copytree(self.folder / "set_old", self.out)

    def state(self):
        held = files_of(self.out)
        visible = {name: {file: digest for file, digest in files.items() if not file.startswith(".")}
                   for name, files in [*self.sets.items(), ("none", {})]}
        return next((name for name, files in visible.items() if held == files), "mixture")

    def is_kept_whole(self):
        """Whether the kept set has the new record, and nothing that is not of the new evaluation."""
        kept = files_of(self.out / KEPT)
        hidden = set(files_of(self.out / KEPT, hidden=True)) - set(kept) - {".gumcert-set.json"}
        return "record.json" in kept and not hidden and all(
            self.sets["new"].get(name) == digest for name, digest in kept.items())

    def calls(self, kind):
        self.restore(True)
        count = self.folder / "count"
        ended = self.run("new", {"GUMCERT_FAULT_COUNT": str(count), "GUMCERT_FAULT_KIND": kind})
        if ended.returncode != 0 or self.state() != "new":
            raise SystemExit(f"counting the calls: {ended.stderr.decode()}")
        return int(count.read_text())

    def fault(self, name, at, with_old):
        """One fault; the breaches that it shows."""
        kind, many = KINDS[name] if name != "memory" else ("memory", 1)
        self.restore(with_old)
        before = "old" if with_old else "none"
        ended = self.run("new", {"GUMCERT_FAULT_AT": str(at), "GUMCERT_FAULT_KIND": kind, "GUMCERT_FAULT_FOR": str(many)})
        said = ended.stderr.decode(errors="replace")
        breaches = []
        state = self.state()
        if state not in (before, "new") and not (self.out / ".gumcert-unfinished.json").exists():
            breaches.append(f"a mixture that nothing tells: {sorted(files_of(self.out, True))}")
        if ended.returncode == 0:
            if state != "new" or (ended.stdout != self.said and name != "SIGKILL"):
                breaches.append(f"exit code 0 with the set: {state}")
        elif ended.returncode == 5:
            if "[GC-" not in said or (not any(word in said for word in ("/", ".json", "PDF \u2014")) and name != "memory"):
                breaches.append(f"exit code 5, and no message that names a file: {said!r}")
        elif not (name.startswith("SIG") and ended.returncode in (-9, -15, -2)):
            breaches.append(f"exit code {ended.returncode}: {said[-300:]!r}")
        if name in ("SIGTERM", "SIGINT") and any(self.temporary.iterdir()):
            breaches.append(f"left in the temporary folder: {sorted(p.name for p in self.temporary.iterdir())}")
        healing = self.run("refused")
        if healing.returncode != 3:
            breaches.append(f"the next command: {healing.returncode}, {healing.stderr.decode()[-300:]!r}")
        state = self.state()
        if state not in (before, "new"):
            breaches.append(f"after the next command: {state}, {sorted(files_of(self.out, True))}")
        elif state != "none" and files_of(self.out, hidden=True) != self.sets[state]:
            breaches.append(f"after the next command: {sorted(files_of(self.out, True))}")
        elif state == "none" and self.out.exists() and any(path.name != KEPT for path in self.out.iterdir()):
            breaches.append(f"left beside the outputs: {sorted(files_of(self.out, True))}")
        if (self.out / KEPT).exists() and not self.is_kept_whole():
            breaches.append(f"kept: {sorted(files_of(self.out / KEPT, True))}")
        if any(self.temporary.iterdir()):
            breaches.append(f"left in the temporary folder: {sorted(p.name for p in self.temporary.iterdir())}")
            shutil.rmtree(self.temporary)
            self.temporary.mkdir()
        return breaches, state


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--library", type=pathlib.Path, required=True)
    parser.add_argument("--stride", type=int, default=1, help="only every n-th call")
    parser.add_argument("--with-node", action="store_true", help="pages are set by node, not by a stand-in")
    parser.add_argument("--memory", action="store_true", help="allocations in place of calls")
    arguments = parser.parse_args()
    if shutil.which("node") is None or not (ROOT / "node_modules").exists():
        print("skipped: node is not installed, or node_modules is missing")
        return SKIPPED
    injected, found, states = {}, 0, {}
    with tempfile.TemporaryDirectory(prefix="gumcert-faults-") as name:
        bench = Bench(arguments, pathlib.Path(name))
        bench.prepare(arguments.with_node)
        calls = bench.calls("memory" if arguments.memory else "5")
        print(f"{calls} {'allocations' if arguments.memory else 'calls of the system'} in an undisturbed run")
        for kind in ["memory"] if arguments.memory else KINDS:
            for with_old in (True, False):
                # The last one is beyond the end: nothing happens, and the run is as ever.
                for at in range(1, calls + 2, arguments.stride):
                    breaches, state = bench.fault(kind, at, with_old)
                    injected[kind] = injected.get(kind, 0) + 1
                    states[state] = states.get(state, 0) + 1
                    for breach in breaches:
                        found += 1
                        print(f"{kind} at {at}, {'old set' if with_old else 'empty folder'}: {breach}")
    print(", ".join(f"{kind}: {number}" for kind, number in injected.items()))
    print(f"{sum(injected.values())} faults injected, {found} breaches; "
          + ", ".join(f"{state}: {number}" for state, number in sorted(states.items())))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
