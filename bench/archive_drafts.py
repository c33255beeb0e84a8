#!/usr/bin/env python3
"""What it takes to find the certificates that rest on a wrong standard, to calculate them again and to draft their amendments.

    bench/archive_drafts.py PROGRAM DRIVER [--before OTHER] [--certificates 500] [--rounds 2] [--folder FOLDER]

DRIVER is tests/archive_driver of the build. The certificates are those of examples/laboratory/end_gauge.json; the value of its standard
becomes larger by 20 nm, and each of them needs an amendment. Prints milliseconds a certificate, of the clock and of the processor, the
least of the rounds; with --before of two programs in turn, so that both meet the same machine, and whether their answers and drafts
are the same. Each calculates records that it has made itself: those of another version are evaluated twice.
"""

import argparse
import filecmp
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def run(*command, stdout=None) -> None:
    done = subprocess.run([str(word) for word in command], stdout=stdout, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stderr)


def cost(*command, stdout) -> tuple[float, float]:
    """Seconds of the clock, and of the processor."""
    began, before = time.monotonic(), os.times()
    run(*command, stdout=stdout)
    after = os.times()
    return (time.monotonic() - began,
            after.children_user + after.children_system - before.children_user - before.children_system)


def prepare(folder: Path, program: Path, driver: Path, certificates: int) -> None:
    shutil.copytree(ROOT / "examples" / "laboratory", folder / "job")
    certificate = folder / "job" / "end_gauge_certificate.json"
    certificate.write_text(certificate.read_text().replace("EX-2026-0042", "EX-2026-0043"))  # which the driver leaves alone
    run(program, "evaluate", folder / "job" / "end_gauge.json", "-o", folder / "record.json", "--share", ROOT, "-q")
    run(driver, "fill", folder / "archive", certificates, folder / "record.json", "issued")
    standard = folder / "job" / "laboratory" / "standards" / "STD-017.json"
    standard.write_text(standard.read_text().replace("50.000623", "50.000643"))


def same_files(one: Path, other: Path) -> bool:
    """But for the records of the originals, which name the version that made them."""
    names = sorted(path.relative_to(one) for path in one.rglob("*") if path.is_file())
    compared = [name for name in names if name.name != "original_record.json"]
    return (names == sorted(path.relative_to(other) for path in other.rglob("*") if path.is_file())
            and not any(filecmp.cmpfiles(one, other, compared, shallow=False)[1:]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("driver", type=Path)
    parser.add_argument("--before", type=Path)
    parser.add_argument("--certificates", type=int, default=500)
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--folder", type=Path, help="where the archive and the drafts are written: their disk counts")
    options = parser.parse_args()
    programs = {"now": options.program} | ({"before": options.before} if options.before else {})
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        folder = Path(name)
        for which, program in programs.items():
            prepare(folder / f"of_{which}", program, options.driver, options.certificates)
        costs = {}
        for _ in range(options.rounds):
            for which, program in programs.items():
                drafts = folder / which
                shutil.rmtree(drafts, ignore_errors=True)
                own = folder / f"of_{which}"
                question = ["archive", "affected", "--store", own / "archive", "--source", "STD-017", "--since", "2026-03-02", "-q"]
                more = ["--share", ROOT, "--register", own / "job" / "laboratory"]
                for what, words in (("search", []), ("and calculate", more), ("and draft", [*more, "-o", drafts])):
                    with (folder / f"{which}.txt").open("w") as answer:
                        costs.setdefault((which, what), []).append(cost(program, *question, *words, stdout=answer))
        for (which, what), all_of_them in costs.items():
            clock, processor = (min(one) * 1000 / options.certificates for one in zip(*all_of_them, strict=True))
            print(f"{which:<7} {what:<14} {clock:8.2f} ms by the clock, {processor:6.2f} ms of the processor", flush=True)
        if options.before:
            same = (filecmp.cmp(folder / "now.txt", folder / "before.txt", shallow=False)
                    and same_files(folder / "now", folder / "before"))
            print("the same answers and drafts" if same else "ANSWERS OR DRAFTS DIFFER")


if __name__ == "__main__":
    main()
