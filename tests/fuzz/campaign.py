"""Runs fuzz targets for some hours and writes what was reached to docs/fuzzing.csv and docs/fuzzing.md (scripts/fuzz).

Each target has the same share of the time. Its corpus grows in the folder of the build, from one campaign to the next; what
breaks a law is kept beside it and ends nothing but the run that found it. The table has one row for each target of each
campaign and is only added to; the page is made from it.
"""

import argparse
import concurrent.futures
import csv
import datetime
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ["date", "commit", "target", "seconds", "executions", "edges", "inputs", "findings"]
AIM = 10**8  # executions of each target
LONGEST_INPUT_KEPT = 2048  # [byte] of inputs that go into the tree
MOST_INPUTS_KEPT = 20  # of a target
MOST_FINDINGS = 10  # of a target in one campaign


def targets_of(text):
    """Name of each target in targets.cmake, with the target whose seeds it has as well, or None."""
    rows = re.findall(r"^gumcert_fuzz_target\((\w+)([^)]*)\)", text, re.M)
    return {name: (re.search(r"SEEDS (\w+)", rest) or [None, None])[1] for name, rest in rows}


def numbers_of(output):
    """Executions, edges and inputs of the corpus that libFuzzer tells at the end of a run, or in its last line."""
    stated = re.findall(r"^stat::number_of_executed_units:\s*(\d+)", output, re.M)
    lines = re.findall(r"^#(\d+)\t.*?cov: (\d+).*?corp: (\d+)", output, re.M)
    last = lines[-1] if lines else ("0", "0", "0")
    return {"executions": int(stated[-1] if stated else last[0]), "edges": int(last[1]), "inputs": int(last[2])}


def has_finding(output):
    """Whether libFuzzer ended by what it found; an input that is only slow does not end it."""
    return re.search(r"Test unit written to \S*-(?:crash|timeout|oom|leak)-", output) is not None


def words_of(schemas):
    """Keys and words of JSON Schemas, for dictionaries."""
    import json

    words = set()

    def collect(node):
        if isinstance(node, dict):
            words.update(node.get("properties", {}))
            words.update(word for word in node.get("enum", []) if isinstance(word, str))
            if isinstance(node.get("const"), str):
                words.add(node["const"])
            for child in node.values():
                collect(child)
        elif isinstance(node, list):
            for child in node:
                collect(child)

    for schema in schemas:
        collect(json.loads(schema.read_text(encoding="utf-8")))
    return sorted(word for word in words if word and word.isascii() and '"' not in word and "\\" not in word)


def dictionary_for(target, folder):
    """The file of words for a target, those of the schemas where it reads JSON; None without."""
    lines = (ROOT / "tests/fuzz/targets.cmake").read_text(encoding="utf-8")
    line = re.search(rf"^gumcert_fuzz_target\({target} .*MUTATOR (\w+)", lines, re.M)
    kind = line[1] if line else ""
    if kind != "json":
        shared = ROOT / "tests/fuzz/dictionaries" / f"{kind}.dict"
        return shared if kind and shared.exists() else None
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / "json.dict"
    made.write_text("".join(f'"{word}"\n' for word in words_of(sorted((ROOT / "schemas").glob("*.json")))), encoding="utf-8")
    return made


class Campaign:
    def __init__(self, build, seconds):
        self.programs = build / "tests/fuzz"
        self.work = build / "campaign"
        self.seconds = seconds
        self.seeds = targets_of((ROOT / "tests/fuzz/targets.cmake").read_text(encoding="utf-8"))

    def folders(self, target):
        """The corpus of the target, and the folders of the tree that it begins with."""
        corpus = self.work / "corpora" / target
        corpus.mkdir(parents=True, exist_ok=True)
        names = [target] + ([self.seeds[target]] if self.seeds.get(target) else [])
        seeds = [ROOT / "tests/fuzz" / kind / name for kind in ("corpus", "kept") for name in names]
        return corpus, [seed for seed in seeds if seed.is_dir()]

    def once(self, target, seconds):
        """One run of libFuzzer; what it printed."""
        corpus, seeds = self.folders(target)
        findings = self.work / "findings"
        findings.mkdir(parents=True, exist_ok=True)
        dictionary = dictionary_for(target, self.work)
        command = ["nice", "-n", "19", self.programs / f"{target}_fuzzer", corpus, *seeds, f"-max_total_time={seconds}",
                   "-print_final_stats=1", "-len_control=100", "-timeout=60", "-rss_limit_mb=4096", "-verbosity=1",
                   f"-artifact_prefix={findings}/{target}-"]
        if dictionary:
            command.append(f"-dict={dictionary}")
        log = self.work / f"{target}.log"
        with open(log, "w", encoding="utf-8", errors="replace") as out:
            subprocess.run([str(word) for word in command], stdout=out, stderr=subprocess.STDOUT, check=False)
        return log.read_text(encoding="utf-8", errors="replace")

    def run(self, target):
        """The share of one target, begun again after each finding."""
        begin = time.monotonic()
        total = {"target": target, "executions": 0, "edges": 0, "inputs": 0, "findings": 0}
        while total["findings"] < MOST_FINDINGS and (left := self.seconds - (time.monotonic() - begin)) >= 1:
            output = self.once(target, int(left) or 1)
            numbers = numbers_of(output)
            total["executions"] += numbers["executions"]
            for name in ("edges", "inputs"):
                total[name] = max(total[name], numbers[name])
            if not has_finding(output):
                break
            total["findings"] += 1
        total["seconds"] = round(time.monotonic() - begin)
        return total

    def minimise(self, target):
        """The corpus with the fewest inputs that reach the same."""
        corpus, seeds = self.folders(target)
        smaller = self.work / "smaller" / target
        shutil.rmtree(smaller, ignore_errors=True)
        smaller.mkdir(parents=True)
        subprocess.run([str(self.programs / f"{target}_fuzzer"), "-merge=1", str(smaller), str(corpus)],
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        if any(smaller.iterdir()):
            shutil.rmtree(corpus)
            smaller.rename(corpus)

    def keep(self, target):
        """Puts small inputs that reach more than those of the tree into kept/."""
        corpus, seeds = self.folders(target)
        more = self.work / "more" / target
        shutil.rmtree(more, ignore_errors=True)
        more.mkdir(parents=True)
        for seed in (path for folder in seeds for path in folder.iterdir()):
            shutil.copy(seed, more)
        known = {path.name for path in more.iterdir()}
        subprocess.run([str(self.programs / f"{target}_fuzzer"), "-merge=1", "-set_cover_merge=1", str(more), str(corpus)],
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        new = sorted((path for path in more.iterdir() if path.name not in known), key=lambda path: (path.stat().st_size, path.name))
        kept = ROOT / "tests/fuzz/kept" / target
        for path in [path for path in new if path.stat().st_size <= LONGEST_INPUT_KEPT][:MOST_INPUTS_KEPT]:
            kept.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, kept / path.name)


def append_rows(table, rows):
    """Adds rows to the table; its first line names the columns."""
    is_new = not table.exists()
    with open(table, "a", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        if is_new:
            writer.writeheader()
        writer.writerows(rows)


def law_of(target):
    """What the comment before the function of a target says."""
    text = (ROOT / "tests/fuzz" / f"{target}_fuzzer.cpp").read_text(encoding="utf-8")
    found = re.search(r'((?:^//.*\n)+)extern "C"', text, re.M) or re.search(r"((?:^//.*\n)+)", text, re.M)
    return " ".join(line.lstrip("/ ") for line in found[1].splitlines()) if found else ""


def page_of(rows, targets):
    """docs/fuzzing.md: what was reached so far."""
    by_target = {name: [row for row in rows if row["target"] == name] for name in targets}
    total = sum(int(row["executions"]) for row in rows)
    hours = sum(float(row["seconds"]) for row in rows) / 3600
    ran = len({row["target"] for row in rows})
    lines = [
        "# Fuzzing",
        "",
        "Made by `scripts/fuzz` from [fuzzing.csv](fuzzing.csv), which has a row for each target of each campaign; change neither by hand.",
        "",
        "A target takes any bytes as input of one reader, or makes a problem from them, and says what must hold. libFuzzer changes",
        "inputs where that reaches new edges of the program, which is compiled with the address and undefined-behaviour sanitizers",
        "(preset `fuzz`). JSON and XML are changed so that they stay what they are (`tests/fuzz/*_mutator.cpp`), with the",
        "keys of the schemas as a dictionary. `tests/fuzz/corpus` has the seeds, `tests/fuzz/kept` what campaigns found: small inputs",
        "that reach more, and those that broke something. The test `fuzz/replay` runs all of them with every change.",
        "",
        f"Reached so far: {grouped(total)} executions of {ran} of {len(targets)} targets in {hours:.1f} hours. The aim is {grouped(AIM)} a target. The last",
        "column says how many hours that takes from here, at the rate reached so far. Hours are those that passed; the cores of the machine",
        "were shared with other work.",
        "",
        "| target | what must hold | executions | hours | a second | edges | findings | last | hours to the aim |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for name in sorted(targets):
        lines.append(row_of(name, by_target[name]))
    return "\n".join(lines) + "\n"


def grouped(number):
    return f"{number:,}".replace(",", " ")


def row_of(name, rows):
    executions = sum(int(row["executions"]) for row in rows)
    seconds = sum(float(row["seconds"]) for row in rows)
    rate = executions / seconds if seconds else 0
    edges = max((int(row["edges"]) for row in rows), default=0)
    findings = sum(int(row["findings"]) for row in rows)
    last = max((row["date"] for row in rows), default="never")
    left = f"{max(AIM - executions, 0) / rate / 3600:.0f}" if rate else "not known"
    numbers = [grouped(executions), f"{seconds / 3600:.2f}", grouped(round(rate)), grouped(edges), str(findings), last, left]
    return f"| `{name}` | {law_of(name)} | " + " | ".join(numbers) + " |"


def write_page(table, page):
    with open(table, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    targets = targets_of((ROOT / "tests/fuzz/targets.cmake").read_text(encoding="utf-8"))
    page.write_text(page_of(rows, targets), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(prog="scripts/fuzz", description="Searches for inputs that break a law.")
    parser.add_argument("hours", type=float, nargs="?", help="of the campaign; each target has an equal share")
    parser.add_argument("--seconds", type=float, help="of each target, in place of hours")
    parser.add_argument("--jobs", type=int, default=1, help="targets at once (default: 1)")
    parser.add_argument("--target", action="append", help="this one only; several times for several")
    parser.add_argument("--keep", action="store_true", help="put small inputs that reach more into tests/fuzz/kept")
    parser.add_argument("--unrecorded", action="store_true", help="write neither table nor page")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/fuzz", help="folder of the build")
    arguments = parser.parse_args()
    if (arguments.hours is None) == (arguments.seconds is None):
        parser.error("state hours, or --seconds")
    known = targets_of((ROOT / "tests/fuzz/targets.cmake").read_text(encoding="utf-8"))
    targets = arguments.target or sorted(known)
    for name in targets:
        if name not in known:
            parser.error(f"no such target: {name}")
        if not (arguments.build / "tests/fuzz" / f"{name}_fuzzer").exists():
            parser.error(f"{name} is not built")
    date = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")
    git = ["git", "-C", str(ROOT), "rev-parse", "--short=12", "HEAD"]
    commit = "" if arguments.unrecorded else subprocess.run(git, capture_output=True, text=True, check=True).stdout.strip()
    campaign = Campaign(arguments.build, arguments.seconds or arguments.hours * 3600 * arguments.jobs / len(targets))
    table, page = ROOT / "docs/fuzzing.csv", ROOT / "docs/fuzzing.md"
    findings = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for numbers in pool.map(campaign.run, targets):
            if not arguments.unrecorded:
                append_rows(table, [{"date": date, "commit": commit, **numbers}])
            findings += numbers["findings"]
            print(f"{numbers['target']}: {numbers['executions']} executions in {numbers['seconds']} s, {numbers['edges']} edges, "
                  f"{numbers['findings']} findings", flush=True)
            campaign.minimise(numbers["target"])
            if arguments.keep:
                campaign.keep(numbers["target"])
    if not arguments.unrecorded:
        write_page(table, page)
    if findings:
        print(f"what was found lies in {campaign.work}/findings", file=sys.stderr)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
