"""Lines and branches of the sources that tests reach (scripts/coverage): builds the preset coverage, runs its tests, reads what
gcov counted and writes docs/coverage.csv and docs/coverage.md.

A branch is a way out of a condition in a source (.cpp). Ways that only an exception takes, which g++ counts at every call, are left
out, and so are conditions in code that only an exception reaches: which temporaries it has left, asked behind every "a ? b : c" with texts.
gcov tells such code in its text alone ("$$$$$"), the ways in JSON. What stands on a line of closing brackets alone is no condition, either. Of headers, which are compiled into several units, lines count alone. Each measurement has a row for each folder, in place
of an earlier one of the same folder.
"""

import csv
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/coverage"
TABLE, PAGE = ROOT / "docs/coverage.csv", ROOT / "docs/coverage.md"
COLUMNS = ["date", "commit", "tests", "folder", "lines", "lines_reached", "branches", "branches_reached"]
# No sources of the product.
OUTSIDE = ("tests", "bench", "examples", "build", "node_modules")
AIMS = {"gum": (95.0, 90.0), "all": (90.0, None)}  # [%] lines, branches


CLOSING = re.compile(r"[\s)\]};,]*")


def closing_lines(path):
    """Numbers of the lines of a source that hold nothing but closing brackets."""
    if not path.is_file():
        return set()
    return {number for number, text in enumerate(path.read_text(encoding="utf-8").splitlines(), 1) if CLOSING.fullmatch(text)}


def counts_of(reports, root=ROOT):
    """Of each source: {line: executions} and {line: [executions of its branches]}, over all units and functions in them."""
    lines, branches, closing = {}, {}, {}
    for report in reports:
        for file in report["files"]:
            path = pathlib.Path(file["file"])
            if path.is_absolute():
                try:
                    path = path.relative_to(ROOT)
                except ValueError:
                    continue  # of a library
            if path.parts[0] in OUTSIDE or len(path.parts) < 2:
                continue
            name = path.as_posix()
            of_lines = lines.setdefault(name, {})
            of_branches = branches.setdefault(name, {})
            if name not in closing:
                closing[name] = closing_lines(root / path)
            for line in file["lines"]:
                number = line["line_number"]
                of_lines[number] = of_lines.get(number, 0) + line["count"]
                taken = [branch["count"] for branch in line["branches"] if not branch["throw"]]
                if len(taken) < 2 or path.suffix != ".cpp" or number in closing[name]:
                    continue  # a jump has no other way, a bracket no condition
                known = of_branches.get(number, [])
                if len(known) == len(taken):  # the same condition in another instance of a template
                    of_branches[number] = [a + b for a, b in zip(known, taken)]
                elif len(known) < len(taken):
                    of_branches[number] = taken
    return lines, branches


def sums_of(lines, branches):
    """Rows by folder: lines, those reached, branches, those reached."""
    rows = {}
    for name, counted in lines.items():
        row = rows.setdefault(pathlib.PurePosixPath(name).parent.as_posix(), [0, 0, 0, 0])
        row[0] += len(counted)
        row[1] += sum(count > 0 for count in counted.values())
        ways = [count for of_line in branches.get(name, {}).values() for count in of_line]
        row[2] += len(ways)
        row[3] += sum(count > 0 for count in ways)
    return rows


def is_in(folder, room):
    return room == "all" or folder == room or folder.startswith(room + "/")


def percent(reached, count):
    return f"{100.0 * reached / count:.1f} %" if count else "–"


def page_of(rows):
    """docs/coverage.md."""
    rooms = sorted({row["folder"].split("/")[0] for row in rows})
    text = [
        "# Coverage",
        "",
        "Made by `scripts/coverage` from [coverage.csv](coverage.csv): which part of the lines and branches of the sources the tests",
        "reach, with the commit and the tests of each measurement. A branch is a way out of a condition; ways that only exceptions take",
        "are left out, in rows since 2026-12-01 also those that g++ puts on lines of closing brackets and in what it does after an exception.",
        "What is reached is not thereby tested: that is asked by [mutants](mutants.md).",
        "",
        "Aims: of `gum` 95 % of the lines and 90 % of the branches, of everything 90 % of the lines. Folders that have no row were not measured",
        "yet, and no sum holds them.",
        "",
        "| folder | lines | reached | branches | reached | tests | date | commit |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for room in rooms:
        inside = [row for row in rows if is_in(row["folder"], room)]
        if len(inside) > 1:
            sums = [sum(int(row[key]) for row in inside) for key in COLUMNS[4:]]
            text.append(f"| **{room}** and its folders in this table | {sums[0]} | {percent(sums[1], sums[0])} | {sums[2]} "
                        f"| {percent(sums[3], sums[2])} | | | |")
        for row in inside:
            numbers = [int(row[key]) for key in COLUMNS[4:]]
            text.append(f"| `{row['folder']}` | {numbers[0]} | {percent(numbers[1], numbers[0])} | {numbers[2]} "
                        f"| {percent(numbers[3], numbers[2])} | {row['tests']} | {row['date']} | {row['commit'][:8]} |")
    return "\n".join(text) + "\n"


def written(rows):
    rows = sorted(rows, key=lambda row: row["folder"])
    with TABLE.open("w", encoding="utf-8", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    PAGE.write_text(page_of(rows), encoding="utf-8")


def known_rows():
    if not TABLE.exists():
        return []
    with TABLE.open(encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def targets_of(room):
    """Test programs of a room: of its folders."""
    listed = subprocess.run(["ninja", "-C", str(BUILD), "-t", "targets", "all"], capture_output=True, text=True, check=True).stdout
    names = {pathlib.PurePosixPath(line.split(":")[0]).name for line in listed.splitlines() if line.startswith("tests/test_")}
    start = "test_unit_" + room.replace("/", "_")
    return sorted(name for name in names
                  if (name == start or name.startswith(start + "_")) and "." not in name)


BLOCK = re.compile(r" *([^ :]+): *\d+-block +\d+$")
WAY = re.compile(r"branch +\d+ (?:never executed|taken (\d+))")
SOURCE_LINE = re.compile(r" *[^ :]+: *(\d+):")


def ways_of_text(text):
    """Of each line of each source in the text of gcov, in its order, the ways out of it: (executions, whether only an exception reaches
    the code that they lead out of)."""
    ways, source, now, exceptional = {}, "", [], False
    for line in text.splitlines():
        if way := WAY.match(line):
            now.append((int(way[1] or 0), exceptional))
        elif block := BLOCK.match(line):
            exceptional = block[1] == "$$$$$"
        elif found := SOURCE_LINE.match(line):
            if found[1] == "0" and ":Source:" in line:
                source = line.split(":Source:")[1]
            now, exceptional = [], False
            ways.setdefault((source, int(found[1])), []).append(now)
    return ways


def without_exceptional(report, ways):
    """Marks the ways of a report that lead out of code which only an exception reaches as those of an exception."""
    for file in report["files"]:
        for line in file["lines"]:
            counts = [way["count"] for way in line["branches"]]
            same = next((told for told in ways.get((file["file"], line["line_number"]), ()) if [count for count, _ in told] == counts), [])
            for way, (_, exceptional) in zip(line["branches"], same):
                way["throw"] = way["throw"] or exceptional
    return report


def gcov_reports():
    for counted in sorted(BUILD.rglob("*.gcda")):
        def told(*options, counted=counted):
            return subprocess.run(["gcov", *options, "--stdout", "--branch-probabilities", str(counted)], cwd=BUILD,
                                  capture_output=True, text=True, errors="replace", check=True).stdout

        ways = ways_of_text(told("--all-blocks", "--branch-counts"))
        for line in told("--json-format").splitlines():
            if line.startswith("{"):
                yield without_exceptional(json.loads(line), ways)


def main(arguments):
    if len(arguments) > 1:
        sys.exit("usage: scripts/coverage [ROOM]")
    room = arguments[0].strip("/") if arguments else "all"
    jobs = str(os.cpu_count())
    targets = targets_of(room) if room != "all" else ["all"]
    if not targets or (room != "all" and not (ROOT / room).is_dir()):
        sys.exit(f"{room} — no folder that has tests — rooms are folders of the tree, such as gum or engine — name one of them")
    for old in BUILD.rglob("*.gcda"):
        old.unlink()
    subprocess.run(["cmake", "--build", str(BUILD), "--parallel", jobs, "--target", *targets], check=True)
    if room == "all":
        subprocess.run(["ctest", "--preset", "coverage", "--parallel", jobs], cwd=ROOT, check=True)
    else:
        for target in targets:
            print(f"coverage: {target}", flush=True)
            subprocess.run([BUILD / "tests" / target, "--gtest_brief=1"], cwd=BUILD / "tests", check=True)
    sums = sums_of(*counts_of(gcov_reports()))
    commit = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()
    stamp = {"date": datetime.date.today().isoformat(), "commit": commit,
             "tests": "all" if room == "all" else f"of {room}"}
    rows = [row for row in known_rows() if not is_in(row["folder"], room)]
    rows += [{**stamp, "folder": folder, **dict(zip(COLUMNS[4:], numbers))}
             for folder, numbers in sums.items() if is_in(folder, room)]
    written(rows)
    inside = [row for row in rows if is_in(row["folder"], room)]
    totals = [sum(int(row[key]) for row in inside) for key in COLUMNS[4:]]
    print(f"coverage: {room}: lines {percent(totals[1], totals[0])}, branches {percent(totals[3], totals[2])}; docs/coverage.md")


if __name__ == "__main__":
    main(sys.argv[1:])
