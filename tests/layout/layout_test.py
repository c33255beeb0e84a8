#!/usr/bin/env python3
"""The layout of documents: nothing overlaps or sticks out, no heading or single row stands alone, no page is almost empty.

    layout_test.py --program gumcert          a few documents, and the proof that each kind of breach is found
    layout_test.py --program gumcert --all    all shipped examples in all languages: scripts/layout

Skipped (77) where node, pdftotext or qpdf is missing.
"""

import argparse
import concurrent.futures
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from pdf_layout import layout_breaches

SOURCE = Path(__file__).resolve().parents[2]
LANGUAGES = ("en", "de", "es", "zh-Hant")
FEW = (("everyday/torque_wrench/job.json", ("es",)), ("everyday/mass_set/job.json", ("de",)),
       ("thermometer/job.json", ("zh-Hant",)), ("comparison/methods.json", ("en",)),
       ("everyday/multimeter/job.json", ("en",)))
ALL = tuple((job, LANGUAGES) for job in (
    "certificate/end_gauge.json", "certificate/rotary_table.json", "circle_closure/comparison.json",
    "circle_closure/indexing_tables.json", "circle_closure/job.json", "comparison/key_comparison.json",
    "comparison/methods.json", "comparison/proficiency_test.json", "end_gauge/job.json", "everyday/angle_gauges/job.json",
    "everyday/gauge_blocks/job.json",
    "everyday/mass_set/job.json", "everyday/multimeter/job.json", "everyday/pt100/job.json", "everyday/torque_wrench/job.json",
    "gauge_block/job.json", "laboratory/end_gauge.json", "multimeter/job.json", "resistance_and_reactance/job.json",
    "rotary_table/job.json", "thermometer/job.json"))
SKIPPED = 77

FRAME = """#set document(title: "layout", date: datetime(year: 2026, month: 11, day: 24))
#set page(paper: "a4", margin: (left: 20mm, right: 18mm, top: 22mm, bottom: 20mm))
#set text(font: "Libertinus Serif", size: 10pt, lang: "en")
#let rows(n) = range(n).map(i => ([row #i], [value])).flatten()
#let table-of(n) = table(columns: 2, table.header([*Name*], [*Value*]), ..rows(n))
#let filled = lorem(120)
"""
SOUND = FRAME + "= Heading\n#filled\n\nBelow:\n\n#table-of(8)\n\n#pagebreak()\n= Other\n#filled\n"
# A document with one breach each, and the words that must be said of it.
PLANTED = {
    "overlap": ("#filled\n\n#box(width: 0pt, [first])#box[second]\n\n#filled", "overlap"),
    "over the side": ("#filled\n\n#h(165mm)#box(width: 0pt, [sticking])\n\n#filled", "sticks out of the text area at the side"),
    "over the edge": ("#filled\n\n#place(dx: 183mm, [sticking])\n\n#filled", "sticks out over the edge of the paper"),
    "over the foot": ("#filled\n\n#place(top, dy: 253.5mm, [sticking])", "sticks out of the text area at the foot"),
    "number and %": ("#filled\n\nThis holds for 95.45\\ % of all.\n\n#filled", "“95.45” and “%” stand in two lines"),
    "symbol and value": ("#filled\n\nThis holds for k\\ = 2 and others.\n\n#filled", "“k” and “=” stand in two lines"),
    "single row behind": ("#block(height: 201mm)\n#table-of(8)\n#filled\n\n#filled", "one single row of table"),
    "single row ahead": ("#block(height: 234mm)\n#table-of(8)\n#filled\n\n#filled", "one single row of table"),
    "heading at the foot": ("#show heading: it => block(sticky: false, it.body)\n#block(height: 238mm, filled)\n= Alone\n"
                            "#block(breakable: false, filled)", "a heading stands at the foot"),
    "words before a table": ("#block(height: 238mm, filled)\nTable 1\n#block(breakable: false, table-of(4))\n\n#filled",
                             "the words above a table stand at the foot"),
    "almost empty page": ("Few words.\n#pagebreak()\n#filled\n\n#filled", "of it is filled"),
    "almost empty last page": ("#filled\n#v(1fr)\n#pagebreak()\nLast words.", "the last one: it holds 1 lines"),
}


def set_by_typst(documents: dict[str, str], folder: Path) -> dict[str, Path]:
    """PDF of Typst sources, set as the program sets its documents: in one process."""
    workspace = folder / "workspace"
    node = subprocess.Popen(["node", str(SOURCE / "templates/pdf/render.mjs"), str(SOURCE / "node_modules"), str(workspace)],
                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    files = {}
    for name, text in documents.items():
        shutil.rmtree(workspace, ignore_errors=True)
        workspace.mkdir()
        (workspace / "view.json").write_text("{}", encoding="utf-8")
        template = folder / "template" / "certificate.typ"
        template.parent.mkdir(exist_ok=True)
        template.write_text(text, encoding="utf-8")
        node.stdin.write(json.dumps({"template": str(template), "further_fonts": False}) + "\n")
        node.stdin.flush()
        answer = json.loads(node.stdout.readline())
        if answer["status"] != "done":
            raise RuntimeError(f"{name}: {answer}")
        files[name] = (workspace / "certificate.pdf").rename(folder / f"{name}.pdf")
    node.stdin.close()
    node.wait(timeout=60)
    return files


def wide_job(results: tuple[int, ...]) -> dict:
    """A gauge with several readings at six pressures: nominal value and reference, and of each result so many columns."""
    channels = range(1, len(results) + 1)
    roles = {1: "rising", 2: "falling", 3: "rising again", 4: "falling again"}
    columns = ["p_n", "p_s"]
    for i, wanted in zip(channels, results):
        columns += [f"p_{i}", f"e_{i}", "U", "limit", "verdict"][:wanted]
    points = [{"p_n": 1000 * p, "p_s": 1000 * p + 0.0045, **{f"p_{i}": 1000 * p + 0.05 * i for i in channels}} for p in range(1, 7)]
    indications = {f"p_{i}": {"unit": "bar", "u": 0.03, "role": "indication"} for i in channels}
    return {
        "schema": "gumcert/job/1", "kind": "budget", "title": "Pressure gauge",
        "model": [f"e_{i} = p_{i} + d - p_s" for i in channels],
        "inputs": {"p_n": {"unit": "bar", "constant": True, "role": "nominal"}, "p_s": {"unit": "bar", "u": 0.01, "role": "reference"},
                   "d": {"unit": "bar", "value": 0, "half_width": 0.025}} | indications,
        "outputs": {f"e_{i}": {"unit": "bar", "role": "error", "description": f"error, {roles[i]}"} for i in channels},
        "points": points, "tables": [{"title": "Pressure", "columns": columns, "plot": "none"}],
        # A standard without U is a finding that tells a key, longer than its column.
        "certificate": {"status": "not_accredited", "annexes": "none", "standards": [{"name": "Pressure balance", "identification": "PB-1"}], "specifications": [{
            "id": "class", "results": [f"e_{i}" for i in channels], "lower": -0.6, "upper": 0.6, "unit": "bar", "document": "EN 837-1",
            "edition": "1996", "rule": {"id": "DR-04", "guard_factor": 0.5}}]}}


def long_job(points: int) -> dict:
    """A dial gauge at so many points: behind 68 of them the meaning of the verdicts alone would stand on the last page."""
    return {
        "schema": "gumcert/job/1", "kind": "budget", "title": "Dial gauge", "model": ["e = x + d - s"],
        "inputs": {"s": {"unit": "mm", "constant": True, "role": "reference"}, "x": {"unit": "mm", "u": 0.0005, "role": "indication"},
                   "d": {"unit": "mm", "value": 0, "half_width": 0.001}},
        "outputs": {"e": {"unit": "um", "role": "error"}},
        "points": [{"s": round(0.2 * i, 1), "x": round(0.2 * i + 0.0005, 4)} for i in range(1, points + 1)],
        "certificate": {"annexes": "none", "specifications": [{
            "id": "class", "results": ["e"], "lower": -10, "upper": 10, "unit": "um", "document": "DS-77", "edition": "3",
            "rule": {"id": "DR-03"}}]}}


def table_at_the_end(points: int) -> dict:
    """The same without limits and plot: little stands behind the table. Remarks make some rows higher."""
    job = long_job(points)
    del job["certificate"]["specifications"]
    for point in job["points"][4::9]:
        point["remark"] = "jaws cleaned before this point, second run"
    job["points"] = {"list": job["points"], "columns": {"remark": "text"}}
    return job | {"tables": [{"plot": "none"}]}


# Parts of words, with a soft hyphen, that stood in budgets beside empty room: their heads and distributions stay whole. Before
# the gap of a column only, for a sentence may break there.
BROKEN = re.compile("(?:Sensitivity coeffi|Distribu|Coeficiente de sensibi|convolu|Rechteck|Normalver|t-Vertei)\u00ad {2}")
VALUE_WITHOUT_UNIT = re.compile(r"[0-9]+ *\n *(?:[kM]Ω|[mµ]V)\b")  # V alone is a quantity of a budget, too

LONG = (64, 66, 68, 70)
# Columns side by side: 12, 15 and 18.
WIDE = ((5, 5), (5, 5, 3), (5, 5, 3, 3))


def planted_problems(folder: Path) -> list[str]:
    files = set_by_typst({"sound": SOUND} | {name: FRAME + text for name, (text, _) in PLANTED.items()}, folder)
    problems = [f"sound: {breach}" for breach in layout_breaches(files["sound"])]
    for name, (_, words) in PLANTED.items():
        breaches = layout_breaches(files[name])
        if not any(words in breach for breach in breaches):
            problems.append(f"planted “{name}” is not found: {breaches}")
    return problems


def broken_words(file: Path) -> list[str]:
    text = subprocess.run(["pdftotext", "-layout", str(file), "-"], capture_output=True, text=True, check=True).stdout
    return [f"a word of a budget is broken: {line.strip()}" for line in text.splitlines() if BROKEN.search(line)] + [
        f"a value and its unit stand in two lines: {found.group().split()}" for found in VALUE_WITHOUT_UNIT.finditer(text)]


def made_up_problems(program: str, name: str, job: dict, languages: tuple[str, ...]) -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"{name}.json"
        file.write_text(json.dumps(job), encoding="utf-8")
        return example_problems(program, str(file), languages)


def example_problems(program: str, job: str, languages: tuple[str, ...]) -> list[str]:
    """:param job: below examples/, or an absolute path"""
    problems = []
    with tempfile.TemporaryDirectory() as name:
        record = Path(name) / "record.json"
        commands = [["evaluate", str(SOURCE / "examples" / job), "-o", str(record)]]
        commands += [["render", str(record), "--format", "pdf", "--language", language, "--draft", "--share", str(SOURCE),
                      "-o", f"{name}/{language}.pdf"] for language in languages]
        for command in commands:
            done = subprocess.run([program, *command, "--quiet", "--threads", "1"], capture_output=True, text=True, check=False)
            if done.returncode not in (0, 1):  # 1: a negative answer, with its documents
                return [f"{job}: {done.stderr}"]
        for language in languages:
            file = Path(name) / f"{language}.pdf"
            problems += [f"{job}, {language}: {breach}" for breach in layout_breaches(file) + broken_words(file)]
    return problems


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, help="the gumcert to ask")
    parser.add_argument("--all", action="store_true", help="all examples in all languages")
    arguments = parser.parse_args()
    for tool in ("node", "pdftotext", "qpdf"):
        if shutil.which(tool) is None:
            print(f"skipped: {tool} is missing: scripts/setup test")
            return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        problems = planted_problems(Path(folder))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = ALL if arguments.all else FEW
        for found in pool.map(lambda job: example_problems(arguments.program, *job), jobs):
            problems += found
        made_up = [(f"{2 + sum(results)} columns", wide_job(results), LANGUAGES) for results in WIDE]
        made_up += [(f"{points} points", long_job(points), ("en",)) for points in LONG]
        made_up += [(f"{points} points, table at the end", table_at_the_end(points), ("en",)) for points in LONG]
        for found in pool.map(lambda job: made_up_problems(arguments.program, *job), made_up):
            problems += found
    for problem in problems:
        print(problem)
    print(f"{len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
