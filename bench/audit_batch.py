#!/usr/bin/env python3
"""What audits cost: a folder of thousands of budgets in one command, and single workbooks.

    bench/audit_batch.py PROGRAM [--budgets 10000] [--rows 20000]

The budgets are those of tests/audit_sets, sound and planted in turn, each as often as needed; the form is JSON. The workbook
is the one with planted errors of examples/audit; the long one is a column of sums over all rows above. Processor time and memory
are those of the program, time is that of the clock.
"""

import argparse
import itertools
import os
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PARTS = {
    "[Content_Types].xml": '<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Override PartName="/xl/workbook.xml" '
    'ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"/>'
    '<Override PartName="/xl/worksheets/sheet1.xml" '
    'ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"/></Types>',
    "_rels/.rels": '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Id="rId1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/officeDocument" '
    'Target="xl/workbook.xml"/></Relationships>',
    "xl/workbook.xml": '<?xml version="1.0"?><workbook xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main" '
    'xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"><sheets>'
    '<sheet name="Budget" sheetId="1" r:id="rId1"/></sheets></workbook>',
    "xl/_rels/workbook.xml.rels": '<?xml version="1.0"?>'
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Id="rId1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet" '
    'Target="worksheets/sheet1.xml"/></Relationships>',
}


def running_sums(file: Path, rows: int) -> None:
    """A workbook with a budget of two rows, and below it a column of sums over all rows above."""
    lines = ['<row r="1">' + "".join(f'<c r="{cell}1" t="inlineStr"><is><t>{text}</t></is></c>'
                                     for cell, text in zip("ABCD", ("quantity", "unit", "u", "sensitivity"))) + "</row>"]
    for row in (2, 3):
        lines.append(f'<row r="{row}"><c r="A{row}" t="inlineStr"><is><t>x{row}</t></is></c>'
                     f'<c r="B{row}" t="inlineStr"><is><t>mm</t></is></c><c r="C{row}"><v>0.1</v></c><c r="D{row}"><v>1</v></c></row>')
    for row in range(9, 9 + rows):
        lines.append(f'<row r="{row}"><c r="A{row}"><v>0.5</v></c><c r="B{row}"><f>SUM(A$9:A{row})</f></c></row>')
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as package:
        for name, part in PARTS.items():
            package.writestr(name, part)
        package.writestr("xl/worksheets/sheet1.xml",
                         '<?xml version="1.0"?><worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main">'
                         "<sheetData>" + "".join(lines) + "</sheetData></worksheet>")


def measured(program: str, what: Path, out: Path) -> str:
    began = time.monotonic()
    process = subprocess.Popen([program, "audit", str(what), "--format", "json", "-o", str(out), "--quiet"],
                               stderr=subprocess.PIPE, text=True)
    told = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    clock = time.monotonic() - began
    if os.waitstatus_to_exitcode(status) not in (0, 1):
        return "not audited: " + told.strip()
    return (f"{clock:7.2f} s of the clock, {usage.ru_utime + usage.ru_stime:7.2f} s of processors, "
            f"{usage.ru_maxrss / 1024:6.0f} MiB")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--budgets", type=int, default=10_000)
    parser.add_argument("--rows", type=int, default=20_000)
    a = parser.parse_args()
    sets = ROOT / "tests/audit_sets"
    tables = sorted((sets / "sound").glob("*.csv")) + sorted((sets / "planted").glob("*.csv"))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "budgets").mkdir()
        for i, table in enumerate(itertools.islice(itertools.cycle(tables), a.budgets)):
            (folder / "budgets" / f"{i:06}.csv").write_bytes(table.read_bytes())
        running_sums(folder / "sums.xlsx", a.rows)
        rows = [(f"{a.budgets} budgets", folder / "budgets"),
                ("a workbook", ROOT / "examples/audit/planted_workbook/planted.xlsx"),
                (f"{a.rows} running sums", folder / "sums.xlsx")]
        for what, file in rows:
            print(f"{what:22} {measured(a.program, file, folder / 'audit.json')}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
