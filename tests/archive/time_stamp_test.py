#!/usr/bin/env python3
"""Time stamps over heads, by the commands of docs/archive.md and an authority that is made for the test: no network.

    time_stamp_test.py --driver archive_driver
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
AUTHORITY = """
[tsa]
default_tsa = own
[own]
serial = serial
default_policy = 1.2.3.4.1
digests = sha256
signer_digest = sha256
ess_cert_id_alg = sha256
[issued]
extendedKeyUsage = critical,timeStamping
"""


def documented_commands():
    """The two commands of the page: what is asked, and what is verified."""
    text = (ROOT / "docs" / "archive.md").read_text(encoding="utf-8")
    return [re.search(pattern, text)[0].split() for pattern in (r"openssl ts -query [^\n]*", r"openssl ts -verify [^\n]*")]


def make_authority(openssl, folder):
    (folder / "authority.cnf").write_text(AUTHORITY, encoding="utf-8")
    (folder / "serial").write_text("01\n", encoding="utf-8")
    openssl("req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", "root.key", "-out", "authority.pem", "-subj", "/CN=Root", "-days", "2")
    openssl("req", "-newkey", "rsa:2048", "-nodes", "-keyout", "tsa.key", "-out", "tsa.csr", "-subj", "/CN=Time stamps")
    openssl("x509", "-req", "-in", "tsa.csr", "-CA", "authority.pem", "-CAkey", "root.key", "-CAcreateserial", "-out", "tsa.pem", "-days", "2",
            "-extfile", "authority.cnf", "-extensions", "issued")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    options = parser.parse_args()
    if shutil.which("openssl") is None:
        print("openssl is not installed: no time stamps")
        return 77
    query, verify = documented_commands()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def run(*words):
            return subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)

        def openssl(*words):
            done = run("openssl", *words)
            if done.returncode:
                raise SystemExit(done.stdout)

        make_authority(openssl, folder)
        subprocess.run([options.driver, "make", folder / "a.archive", "1", "5", folder / "head.json"], check=True)
        asked = run(*query)
        openssl("ts", "-reply", "-queryfile", "head.tsq", "-signer", "tsa.pem", "-inkey", "tsa.key", "-config", "authority.cnf", "-section", "own",
                "-out", "head.tsr")
        faults = [] if asked.returncode == 0 else [asked.stdout]
        good = run(*verify)
        if good.returncode or "Verification: OK" not in good.stdout:
            faults.append(f"the time stamp of the head: {good.stdout}")
        head = (folder / "head.json").read_text(encoding="utf-8")
        (folder / "head.json").write_text(head.replace('"size": ', '"size": 1'), encoding="utf-8")
        if run(*verify).returncode == 0:
            faults.append("a head that was changed has the time stamp of the old one")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
