#!/usr/bin/env python3
"""Workers of an archive on a server, some of them killed on the way: nothing is lost, nothing is done twice.

    workers_test.py --driver archive_driver --program gumcert [--certificates N] [--kills N] [--workers N]

The same search and recalculation are done by one command on a file, and by a command with workers on a server, from the same
log: the answers and the drafts are the same bytes.
"""

import argparse
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

import postgresql_server

ROOT = pathlib.Path(__file__).resolve().parents[2]


def files_below(folder):
    return {file.relative_to(folder): file.read_bytes() for file in sorted(folder.rglob("*")) if file.is_file()}


def verified_by_the_second(archive, driver, address, folder):
    """Faults of the way by which the verifier that has no client of PostgreSQL verifies a server: of an archive of chance, for the
    records of the other one state another number than their entries."""
    verifier = ROOT / "tools" / "verify_archive.py"
    subprocess.run([driver, "make", folder / "chance.archive", "1", "14"], check=True)
    subprocess.run([driver, "migrate", folder / "chance.archive", address], check=True)
    listed = subprocess.run(archive("list", "--store", address, "--format", "json"), check=True, stdout=subprocess.PIPE).stdout
    number = next(one["number"] for one in json.loads(listed)["certificates"] if one["record"])
    copy, head, evidence = folder / "copy.archive", folder / "head.json", folder / "evidence.json"
    subprocess.run(archive("head", "--store", address, "-o", head, "-q"), check=True)
    subprocess.run(archive("backup", "--store", address, "--by", "K. Keeper", "--today", time.strftime("%Y-%m-%d", time.gmtime()), "-o", copy, "-q"), check=True)
    subprocess.run(archive("export", number, "--store", address, "--since", head, "-o", evidence, "-q"), check=True)
    faults = []
    for words in ([copy, "--head", head], [evidence, "--head", head]):
        done = subprocess.run([sys.executable, "-B", verifier, *words], stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode:
            faults.append(f"the second verifier of {words[0].name}: {done.stdout}")
    subprocess.run(["/usr/lib/postgresql/15/bin/psql", "-q", "-d", address, "-c", "SET session_replication_role = replica; "
                    "UPDATE gumcert_archive.log SET actor = 'N. Obody' WHERE seq = 5"], check=True)
    spoiled = folder / "spoiled.archive"  # `backup` removes a copy that is not sound
    subprocess.run([driver, "migrate", address, spoiled], check=True)
    if not subprocess.run([sys.executable, "-B", verifier, spoiled], stdout=subprocess.DEVNULL, check=False).returncode:
        faults.append("the second verifier does not see what was changed on the server")
    return faults


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--program", required=True)
    parser.add_argument("--certificates", type=int, default=40)
    parser.add_argument("--kills", type=int, default=4)
    parser.add_argument("--workers", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = random.Random(options.seed)

    def archive(*words):
        return [options.program, "archive", *map(str, words), "--share", str(ROOT), "--threads", "1"]

    faults = []
    with tempfile.TemporaryDirectory() as name, tempfile.TemporaryDirectory(dir="/tmp") as place, postgresql_server.Server(place) as server:
        if not server.runs:
            print(postgresql_server.ABSENT)
            return 0
        address = server.new_database()
        folder = pathlib.Path(name)
        shutil.copytree(ROOT / "examples" / "laboratory", folder / "job")
        # Another number than that of the driver: all records are the same but for blanks behind them.
        for file in (folder / "job").rglob("*.json"):
            file.write_text(file.read_text(encoding="utf-8").replace("EX-2026-0042", "EX-2026-0043"), encoding="utf-8")
        record, store = folder / "record.json", folder / "a.archive"
        subprocess.run([options.program, "evaluate", folder / "job" / "end_gauge.json", "-o", record, "--share", ROOT, "-q"], check=True)
        subprocess.run([options.driver, "fill", store, str(options.certificates), record, "issued"], check=True)
        subprocess.run([options.driver, "migrate", store, address], check=True)
        standard = folder / "job" / "laboratory" / "standards" / "STD-017.json"
        standard.write_text(standard.read_text(encoding="utf-8").replace("50.000623", "50.000643"), encoding="utf-8")
        query = ["affected", "--source", "STD-017", "--since", "2026-03-02", "--register", folder / "job" / "laboratory", "--format", "json"]

        began = time.monotonic()
        alone = subprocess.run(archive(*query, "--store", store, "-o", folder / "alone", "-q"), stdout=subprocess.PIPE, check=False)
        taken_alone = time.monotonic() - began
        if alone.returncode != 1 or alone.stdout.count(b'"outcome": "printed"') != options.certificates:
            faults.append(f"one command on a file: exit code {alone.returncode}, {alone.stdout[:300]}")

        began = time.monotonic()
        answer = folder / "answer.json"
        with open(answer, "wb") as stream:
            shared = subprocess.Popen(archive(*query, "--store", address, "-o", folder / "shared", "--shared", "-q"), stdout=stream)
        workers, killed = [], 0
        while shared.poll() is None:
            workers = [worker for worker in workers if worker.poll() is None]
            while len(workers) < options.workers:
                workers.append(subprocess.Popen(archive("worker", "--store", address, "--wait-for-work", "-q")))
            if killed < options.kills:
                time.sleep(rng.uniform(0.05, 0.6))
                victim = rng.choice(workers)
                victim.kill()
                victim.wait()
                killed += 1
            else:
                try:
                    shared.wait(0.2)
                except subprocess.TimeoutExpired:
                    pass
        taken_shared = time.monotonic() - began
        for worker in workers:
            worker.kill()
            worker.wait()
        if shared.returncode != 1 or answer.read_bytes() != alone.stdout:
            faults.append(f"with workers: exit code {shared.returncode}, and another answer")
        if files_below(folder / "shared") != files_below(folder / "alone") or not files_below(folder / "alone"):
            faults.append("with workers: other drafts")

        # The one who asked is killed: asked again, the work goes on. It is replayed this time.
        asked = subprocess.Popen(archive("replay", "--store", address, "--shared", "-q"), stdout=subprocess.DEVNULL)
        time.sleep(rng.uniform(0.3, 1.0))
        asked.kill()
        asked.wait()
        done = subprocess.run(archive("worker", "--store", address), stdout=subprocess.PIPE, text=True, check=False)
        replayed = subprocess.run(archive("replay", "--store", address, "--shared"), stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode or replayed.returncode or f"{options.certificates} of {options.certificates} records" not in replayed.stdout:
            faults.append(f"replay: {replayed.returncode}, {replayed.stdout[-200:]}")
        faults += verified_by_the_second(archive, options.driver, server.new_database(), folder)
        refused = subprocess.run(archive("worker", "--store", store), stderr=subprocess.PIPE, text=True, check=False)
        if refused.returncode != 2:
            faults.append(f"a worker of a file: exit code {refused.returncode}")
    for fault in faults:
        print(fault)
    print(f"{options.certificates} certificates: alone {taken_alone:.1f} s, with {options.workers} workers of which {killed} were killed "
          f"{taken_shared:.1f} s, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
