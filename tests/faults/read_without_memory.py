#!/usr/bin/env python3
"""Makes allocations fail, one after the other, while commands read files of others: signatures, workbooks, certificates.

    read_without_memory.py --program GUMCERT --library SYSTEM_FAULTS [--faults N]

The n-th allocation fails, once or with all behind it. What has to hold: the command ends as it does undisturbed, to the
byte, or with exit code 5 and a message; no crash, and no statement about a file that has no fault. N allocations a command,
spread over all of them; --faults 0: each one.
"""

import argparse
import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
SUBJECT = "/O=Example Calibration Laboratory/CN=Seal"


class Bench:
    def __init__(self, arguments, folder):
        self.program, self.library = arguments.program.resolve(), arguments.library.resolve()
        self.folder = folder

    def run(self, command, fault=None):
        environment = {"PATH": os.environ.get("PATH", ""), "TMPDIR": str(self.folder)}
        if fault is not None:
            environment.update(fault, LD_PRELOAD=str(self.library))
        return subprocess.run([self.program, *command, "--threads", "1"], cwd=self.folder, env=environment,
                              capture_output=True, check=False)

    def sign(self):
        """An issued certificate with its signatures, and the certificate that is trusted."""
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
                        "-keyout", "key.pem", "-out", "trusted.pem", "-days", "3650", "-subj", SUBJECT,
                        "-addext", "basicConstraints=critical,CA:FALSE", "-addext", "keyUsage=critical,digitalSignature"],
                       cwd=self.folder, capture_output=True, check=True)
        (self.folder / "signer.json").write_text(json.dumps({"certificates": "trusted.pem", "key": "key.pem"}))
        ended = self.run(["run", ROOT / "examples/certificate/end_gauge.json", "-o", "signed", "--share", ROOT,
                          "--sign", "signer.json"])
        if ended.returncode != 0:
            raise SystemExit(f"signing: {ended.stderr.decode()}")

    def commands(self):
        return {
            "verify XML": ["verify", "signed/certificate.xml", "--trust", "trusted.pem"],
            "verify PDF": ["verify", "signed/certificate.pdf", "--trust", "trusted.pem"],
            "import": ["import", "dcc", "signed/certificate.xml"],
            "check dcc": ["check", "dcc", ROOT / "tests/fuzz/corpus/dcc/real.xml"],
            "audit workbook": ["audit", ROOT / "examples/audit/planted_workbook/planted.xlsx", "--format", "json"],
        }

    def faults(self, name, command, many):
        """Tells what broke; the number of faults and of breaches."""
        undisturbed = self.run(command)
        count = self.folder / "count"
        self.run(command, {"GUMCERT_FAULT_COUNT": str(count), "GUMCERT_FAULT_KIND": "memory"})
        number = int(count.read_text())
        places = range(1, number + 1, max(1, number // many) if many else 1)
        ends, breaches = collections.Counter(), 0
        for at in places:
            for how_many in (1, 1_000_000_000):
                ended = self.run(command, {"GUMCERT_FAULT_AT": str(at), "GUMCERT_FAULT_KIND": "memory",
                                           "GUMCERT_FAULT_FOR": str(how_many)})
                if (ended.returncode, ended.stdout, ended.stderr) == (undisturbed.returncode, undisturbed.stdout,
                                                                      undisturbed.stderr):
                    ends["the same"] += 1
                elif ended.returncode == 5 and (b"[GC-" in ended.stderr or how_many > 1):
                    ends["exit code 5"] += 1
                else:
                    breaches += 1
                    print(f"{name}, allocation {at}{' and all behind it' if how_many > 1 else ''}: exit code "
                          f"{ended.returncode}, {ended.stderr.decode(errors='replace')[-300:]!r}")
        told = ", ".join(f"{end}: {times}" for end, times in sorted(ends.items()))
        print(f"{name}: {number} allocations, {2 * len(places)} faults, {breaches} breaches; {told}")
        return 2 * len(places), breaches


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--library", type=pathlib.Path, required=True)
    parser.add_argument("--faults", type=int, default=23, help="allocations a command; 0: every one")
    arguments = parser.parse_args()
    if shutil.which("node") is None or not (ROOT / "node_modules").exists():
        print("skipped: node is not installed, or node_modules is missing")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="gumcert-memory-") as name:
        bench = Bench(arguments, pathlib.Path(name))
        bench.sign()
        told = [bench.faults(name, command, arguments.faults)
                for name, command in bench.commands().items()]
    print(f"{sum(faults for faults, _ in told)} faults injected, {sum(breaches for _, breaches in told)} breaches")
    return 1 if any(breaches for _, breaches in told) else 0


if __name__ == "__main__":
    sys.exit(main())
