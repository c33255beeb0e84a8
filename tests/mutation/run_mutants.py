"""Changes sources of the layers that compute, one small change at a time, and asks whether a test fails (scripts/mutants).

A mutant is compiled by itself and linked before the libraries of the release, whose equal symbols give way to it: nothing in
the tree is touched. It is killed when a test fails, ends by a signal or takes longer than it may: first one of the tests that
stand beside its source, which see most of the changes in seconds, then one of its layer, of the layers above, of published cases
and of properties. What survives is either equivalent (nobody could see the change) or shows what no test asks for. Time is that
of the processor: other work on the machine makes no test fail.
"""

import argparse
import concurrent.futures
import csv
import datetime
import os
import pathlib
import random
import re
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import mutate  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE, PAGE = ROOT / "docs/mutants.csv", ROOT / "docs/mutants.md"
COLUMNS = ["date", "commit", "file", "line", "change", "verdict", "judgement"]
ROOMS = ("gum", "engine", "certificate")  # with the folders in them
# Asked when no test of the layer itself has failed: those of layers that rest on it. Paths below tests/.
WIDER = {
    "gum": ["unit/gum/budget", "unit/gum/comparison", "unit/certificate", "property", "reference"],
    "engine": ["unit/engine/rotary_table", "unit/engine/rotary_table/evaluation", "unit/engine/rotary_table/start",
               "unit/gum/rotary_table", "unit/gum/budget", "property",
               "reference"],
    "certificate": ["unit/certificate/gates", "unit/reports/record/make/certificate", "unit/jobs/certificate", "reference"],
}
LONGEST = 600  # [s] of one test program, of the processor
LONGEST_WAIT = 3600  # [s] of the clock: a test that waits for ever uses no processor
MOST_MEMORY = 8 << 30  # [byte]
SUITE = re.compile(r"^\s*(?:TYPED_)?TEST(?:_F|_P)?\((\w+)", re.M)
SLOWER = 8  # times as long as without a change: it does not end


def layer_of(path):
    return str(pathlib.PurePosixPath(path).parent)


def test_program(folder):
    return "test_" + folder.replace("/", "_")


def sources(rooms):
    found = []
    for room in rooms:
        found += sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / room).rglob("*.cpp"))
    return found


def suites_beside(source):
    """The filter that takes the tests of the file that stands beside a source; none where there is no such file."""
    beside = ROOT / "tests/unit" / pathlib.PurePosixPath(source).parent / f"{pathlib.PurePosixPath(source).stem}_test.cpp"
    if not beside.exists():
        return None
    names = sorted(set(SUITE.findall(beside.read_text(encoding="utf-8"))))
    return ":".join(pattern for name in names for pattern in (f"{name}.*", f"{name}/*", f"*/{name}.*")) or None


def compile_command(of_unit, source, out):
    """The command of a unit of the build, for one source: no notes of dependencies, no warnings, not by ccache."""
    words = shlex.split(of_unit)
    if words[0].endswith("ccache"):
        words = words[1:]
    kept = []
    skip = 0
    for word in words:
        if skip:
            skip -= 1
        elif word in ("-MT", "-MF", "-o", "-c"):
            skip = 1
        elif word != "-MD" and not word.startswith("-W"):
            kept.append(word)
    return [*kept, "-w", "-o", str(out), "-c", str(source)]


def link_command(of_program, first, out):
    """The command that links a test program, with an object before all others whose symbols they may repeat."""
    words = shlex.split(of_program.split(" && ")[1])
    words[words.index("-o") + 1] = str(out)
    at = next(i for i, word in enumerate(words) if i > 0 and (word.endswith(".o") or word.startswith("-Wl,")))
    return [*words[:at], "-Wl,-z,muldefs", str(first), *words[at:]]


class Build:
    """Commands of a build with tests."""

    def __init__(self, folder):
        self.folder = folder
        self.commands = {}

    def command(self, target):
        """The last command that makes a target."""
        if target not in self.commands:
            listed = subprocess.run(["ninja", "-C", self.folder, "-t", "commands", target], capture_output=True, text=True, check=True)
            self.commands[target] = [line for line in listed.stdout.splitlines() if line and not line.startswith("ninja:")][-1]
        return self.commands[target]

    def unit_of(self, source):
        """An object of the layer of a source, whose options it is compiled with; the source's own where it has one."""
        objects = f"CMakeFiles/{layer_of(source).replace('/', '_')}.dir"
        own = self.folder / objects / f"{source}.o"
        return f"{objects}/{source}.o" if own.exists() else f"{objects}/Unity/unity_0_cxx.cxx.o"


class Campaign:
    def __init__(self, build, work):
        self.build, self.work = Build(build), work
        self.usual = {}
        self.one_at_a_time = threading.Lock()
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)

    def programs(self, source):
        layer = layer_of(source)
        wider = [folder for folder in WIDER[layer.split("/")[0]] if folder != f"unit/{layer}"]
        library = f"libgumcert_{layer.replace('/', '_')}.a"
        return [folder for folder in (f"unit/{layer}", *wider)
                if (self.build.folder / "tests" / test_program(folder)).exists()
                and library in self.build.command(f"tests/{test_program(folder)}")]

    def run_test(self, program, seconds, suites):
        """Exit code of a test program, none where it does not end, and the time of the processor that it took [s]."""
        # A change can make a loop without end that asks for memory all the time.
        command = ["prlimit", f"--as={MOST_MEMORY}", f"--cpu={round(seconds)}:{round(seconds) + 5}", program, "--gtest_brief=1", "--gtest_fail_fast",
                   f"--gtest_filter={suites or '*'}"]
        running = subprocess.Popen(command, cwd=self.build.folder / "tests", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = threading.Timer(LONGEST_WAIT, running.kill)
        end.start()
        _, status, used = os.wait4(running.pid, 0)
        waited_for_ever = not end.is_alive()
        end.cancel()
        running.returncode = os.waitstatus_to_exitcode(status)  # told to Popen, which has not waited itself
        endless = waited_for_ever or running.returncode == -signal.SIGXCPU
        return (None if endless else running.returncode), used.ru_utime + used.ru_stime

    def usual_time(self, folder, suites):
        """How long tests of a program take without a change [s]; they must pass."""
        with self.one_at_a_time:
            if (folder, suites) not in self.usual:
                code, seconds = self.run_test(self.build.folder / "tests" / test_program(folder), LONGEST, suites)
                if code != 0:
                    sys.exit(f"{folder}: its tests do not pass without a change (exit code {code}) — build the release first")
                self.usual[folder, suites] = seconds
            return self.usual[folder, suites]

    def judge(self, number, source, mutant):
        """The verdict of the tests on a mutant."""
        folder = self.work / str(number)
        folder.mkdir()
        changed, made = folder / pathlib.PurePosixPath(source).name, folder / "mutant.o"
        changed.write_text(mutate.applied((ROOT / source).read_text(encoding="utf-8"), mutant), encoding="utf-8")
        try:
            command = compile_command(self.build.command(self.build.unit_of(source)), changed, made)
            compiled = subprocess.run(command, cwd=self.build.folder, capture_output=True, check=False)
            if compiled.returncode != 0:
                return "does not compile"
            for tests in self.programs(source):
                program = folder / "tests"
                link = link_command(self.build.command(f"tests/{test_program(tests)}"), made, program)
                linked = subprocess.run(link, cwd=self.build.folder, capture_output=True, text=True, check=False)
                if linked.returncode != 0:
                    sys.exit(f"{source}: it cannot be linked with {tests}:\n{linked.stderr}")
                beside = suites_beside(source) if tests == f"unit/{layer_of(source)}" else None
                for suites in ([beside] if beside else []) + [None]:
                    code, _ = self.run_test(program, min(LONGEST, 20 + SLOWER * self.usual_time(tests, suites)), suites)
                    if code != 0:
                        return ("does not end: " if code is None else "killed by ") + tests
            return "survived"
        finally:
            shutil.rmtree(folder)


def chosen(files, count, seed):
    """Mutants of the files, each with the same probability; the same for the same seed."""
    everything = [(path, mutant) for path in files for mutant in mutate.mutants_of((ROOT / path).read_text(encoding="utf-8"))]
    return random.Random(seed).sample(everything, min(count, len(everything)))


def is_killed(row):
    return row["verdict"].startswith(("killed", "does not end"))


def in_cell(text):
    return text.replace("|", "\\|")


def page_of(rows):
    """docs/mutants.md."""
    lines = [
        "# Mutants",
        "",
        "Made by `scripts/mutants` from [mutants.csv](mutants.csv), which has a row for each mutant of each campaign. A mutant is a source with",
        "one small change, as a slip would make it: `<` for `<=`, `+` for `-`, another number, the opposite of a condition, a root",
        "left out. It is killed when a test fails: of its layer, or of those that rest on it, published cases and properties among them.",
        "Survivors are judged by a person, in the last column of the table: a change that nobody can see is equivalent and does not",
        "count; for the others a test is written, which stands beside.",
        "",
        "| room | mutants that compile | killed | survived | of these equivalent | killed, of those not equivalent |",
        "|---|---|---|---|---|---|",
    ]
    compiled = [row for row in rows if row["verdict"] != "does not compile"]
    for room in (*ROOMS, "all"):
        of_room = [row for row in compiled if room == "all" or row["file"].startswith(room + "/")]
        if of_room:
            killed = sum(is_killed(row) for row in of_room)
            equivalent = sum(row["judgement"].startswith("equivalent") for row in of_room)
            counted = len(of_room) - equivalent
            score = f"{100 * killed / counted:.0f} %" if counted else "–"
            lines.append(f"| `{room}` | {len(of_room)} | {killed} | {len(of_room) - killed} | {equivalent} | {score} |")
    lines += ["", "Survivors, with the line of the day:", "", "| where | change | date | judgement |", "|---|---|---|---|"]
    for row in compiled:
        if not is_killed(row):
            place = f"`{row['file']}:{row['line']}`"
            lines.append(f"| {place} | {in_cell(row['change'])} | {row['date']} | {in_cell(row['judgement']) or 'not judged yet'} |")
    return "\n".join(lines) + "\n"


def read_rows():
    if not TABLE.exists():
        return []
    with open(TABLE, newline="", encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def write_rows(rows):
    with open(TABLE, "w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    PAGE.write_text(page_of(rows), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(prog="scripts/mutants", description="Asks whether tests see small changes of the sources.")
    parser.add_argument("count", type=int, nargs="?", default=0, help="of mutants; without it, the page is made of the table")
    parser.add_argument("--seed", type=int, default=1, help="of the choice (default: 1)")
    parser.add_argument("--in", dest="rooms", action="append", help="a folder or file (default: " + ", ".join(ROOMS) + ")")
    parser.add_argument("--line", type=int, help="all mutants of this line of the one file named by --in, unrecorded")
    parser.add_argument("--jobs", type=int, default=2, help="mutants at once (default: 2)")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="folder of a release with tests")
    arguments = parser.parse_args()
    rooms = arguments.rooms or list(ROOMS)
    files = [room for room in rooms if room.endswith(".cpp")] + sources(room for room in rooms if not room.endswith(".cpp"))
    mutants = chosen(files, arguments.count, arguments.seed)
    if arguments.line:
        mutants = [(path, m) for path in files for m in mutate.mutants_of((ROOT / path).read_text()) if m.line == arguments.line]
    rows = read_rows()
    if mutants:
        date = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")
        commit = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short=12", "HEAD"], capture_output=True, text=True, check=False)
        campaign = Campaign(arguments.build, arguments.build / "mutants")
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            verdicts = pool.map(lambda one: (one[1], campaign.judge(one[0], *one[1])), enumerate(mutants))
            for (path, mutant), verdict in verdicts:
                print(f"{path}:{mutant.line}: {mutant.what}: {verdict}", flush=True)
                rows.append({"date": date, "commit": commit.stdout.strip(), "file": path, "line": str(mutant.line), "change": mutant.what,
                             "verdict": verdict, "judgement": ""})
                if not arguments.line:
                    write_rows(rows)  # what was found is kept when the campaign is ended
    if not mutants:
        write_rows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
