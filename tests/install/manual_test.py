#!/usr/bin/env python3
"""Manual and completion say what --help says: of the program and of each command, every option, no more and no less.

    manual_test.py --program GUMCERT --manual FOLDER

FOLDER holds man1/*.1.gz and completion/* of the build. Exits with 77 where man or a shell is not installed and all that
could be looked at is right.
"""

import argparse
import dataclasses
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ENVIRONMENT = {"PATH": os.environ["PATH"], "LC_ALL": "C.UTF-8", "MANWIDTH": "5000", "MANROFFOPT": "", "HOME": "/nonexistent"}
# What a shell is asked, for one word that is being typed.
QUESTIONS_OF_BASH = """
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_gumcert gumcert "${COMP_WORDS[COMP_CWORD]}"
printf '%s\\n' "${COMPREPLY[@]}"
"""
# _arguments is told what may follow: each description is printed in place of it.
QUESTIONS_OF_ZSH = """
compdef() { }
_arguments() {
    print -rl -- "$@"
    if [[ $1 == -C && -n $wanted ]]; then
        words=("$wanted"); state=argument
    elif [[ $1 == -C ]]; then
        state=command
    fi
}
_describe() { print -rl -- "${(P@)2}" }
wanted=$2
source "$1"
"""


@dataclasses.dataclass
class Option:
    names: list
    value: str  # kind of its value; "" for a flag
    choices: list
    explanation: str


def run(*command, text="", folder=None):
    return subprocess.run(command, input=text, capture_output=True, text=True, env=ENVIRONMENT, timeout=60, check=False,
                          cwd=folder)


def section(text, title):
    found = re.search(rf"^{title}:\n((?: .*\n|\n(?= ))+)", text, re.M)
    return found[1] if found else ""


def entries(text):
    """(what stands in the first column, explanation) of each entry of a section of --help."""
    for entry in re.split(r"\n(?=  \S)", text.rstrip("\n")):
        head, _, rest = entry[2:].partition("\n")
        first = re.match(r"(.*?\S)(?:\s{2,}(\S.*))?$", head)
        yield first[1], " ".join(f"{first[2] or ''} {rest}".split())


def options_of(help_text):
    found = []
    for head, explanation in entries(section(help_text, "Options")):
        words = head.split(" ")
        kind, _, check = (words[1] if len(words) > 1 else "").partition(":")
        choices = check[1:-1].split(",") if check.startswith("{") else []
        found.append(Option(words[0].split(","), kind, choices, explanation))
    return found


def squeezed(text):
    return " ".join(text.split())


class Check:
    def __init__(self):
        self.failures = []
        self.looked_at = 0
        self.missing = [tool for tool in ("man", "groff", "bash", "zsh", "fish") if shutil.which(tool) is None]

    def equal(self, what, found, expected):
        self.looked_at += 1
        if found != expected:
            self.failures.append(f"{what}:\n  found    {found}\n  expected {expected}")

    def holds(self, what, truth):
        self.equal(what, bool(truth), True)

    def has(self, tool):
        return tool not in self.missing


def check_page(check, page, name, help_text, options):
    """One page: set without a warning, and every word of --help that is not its layout stands in it."""
    source = gzip.decompress(page.read_bytes()).decode("utf-8")
    check.holds(f"{page.name}: ASCII, which every reader of manuals takes", source.isascii())
    if check.has("groff"):
        warnings = run("groff", "-man", "-ww", "-Tutf8", "-z", "-rLL=78n", text=source)
        check.equal(f"{page.name}: warnings of groff", warnings.stderr, "")
    if not check.has("man"):
        return
    shown = run("man", "--local-file", "--no-hyphenation", "--no-justification", "--warnings=w", str(page))
    check.equal(f"{page.name}: man", (shown.returncode, shown.stderr), (0, ""))
    text = shown.stdout.replace("\u2010", "-").replace("\u2212", "-")
    parts = dict(re.findall(r"^([A-Z][A-Z ]+)\n((?:[ ].*\n|\n)+)", text, re.M))
    check.holds(f"{page.name}: NAME", squeezed(parts["NAME"]).startswith(f"{name} - "))
    listed = re.findall(r"^ {7}((?:-\w, )?--[\w-]+)(?: (\w+))?(?:$| {2,})", parts["OPTIONS"], re.M)
    check.equal(f"{page.name}: options", listed, [(", ".join(o.names), o.value) for o in options])
    flat = squeezed(text)
    for option in options:
        check.holds(f"{page.name}: explanation of {option.names[-1]}", option.explanation in flat)
    for head, explanation in entries(section(help_text, "Positionals")) if section(help_text, "Positionals") else ():
        check.holds(f"{page.name}: {head}", re.search(rf"^ {{7}}{head.split()[0]}\b", parts["ARGUMENTS"], re.M))
        check.holds(f"{page.name}: explanation of {head}", explanation in flat)
    # What stands below the options: every word, and every command as one text.
    footer = help_text[help_text.rindex("\n\n", 0, help_text.index("\nStart here:" if name == "gumcert" else "\nExample:") + 1):]
    for line in footer.splitlines():
        for part in re.split(r"^Example:|^Start here:|\s{3,}", line):
            check.holds(f"{page.name}: {part.strip()!r}", squeezed(part) in flat)


# Words that the first argument of a command may be.
WORDS_OF_ARGUMENTS = {
    "import": ["dcc"],
    "archive": ["init", "settings", "number", "add", "review", "authorise", "issue", "amend", "withdraw", "list", "show", "export", "head",
                "verify", "backup", "migrate", "replay", "worker", "statistics", "affected"]
}


def replies_of_bash(script, *words):
    asked = run("bash", "--norc", "-c", QUESTIONS_OF_BASH, "bash", str(script), "gumcert", *words)
    return sorted(asked.stdout.split()) + asked.stderr.split()


def check_bash(check, script, helps):
    commands = sorted(name for name in helps if name)
    check.equal("bash: commands", replies_of_bash(script, ""), commands)
    check.equal("bash: commands with r", replies_of_bash(script, "r"), [c for c in commands if c.startswith("r")])
    check.equal("bash: commands behind a flag", replies_of_bash(script, "-q", ""), commands)
    for command, options in helps.items():
        words = [command] if command else []
        names = sorted(name for option in options for name in option.names)
        check.equal(f"bash: options of {command!r}", replies_of_bash(script, *words, "-"), names)
        for option in options:
            for name in option.names:
                expected = sorted(option.choices) if option.value else ([] if command else commands)
                if command in WORDS_OF_ARGUMENTS and not option.value:
                    expected = sorted(WORDS_OF_ARGUMENTS[command])
                check.equal(f"bash: values of {command} {name}", replies_of_bash(script, *words, name, ""), expected)
                if option.choices:
                    for typed in (["=", ""], ["="]):
                        replies = replies_of_bash(script, *words, name, *typed)
                        check.equal(f"bash: values of {command} {name}{typed}", replies, expected)
    check.equal("bash: the second language", replies_of_bash(script, "run", "--language", "de,e"), ["de,en", "de,es"])
    check.equal("bash: a job", replies_of_bash(script, "run", "--draft", "job.json", ""), [])


def check_zsh(check, script, helps):
    check.equal("zsh: syntax", run("zsh", "-f", "-n", str(script)).stderr, "")
    for command, options in helps.items():
        asked = run("zsh", "-f", "-c", QUESTIONS_OF_ZSH, "zsh", str(script), command)
        check.equal(f"zsh: complaints about {command!r}", asked.stderr, "")
        lines = asked.stdout.splitlines()
        if command:
            lines = lines[lines.index("*::argument:->argument") + 1:]
        else:
            described = [line for line in lines if re.match(r"[\w-]+:[A-Z]", line)]
            check.equal("zsh: commands", sorted(line.split(":")[0] for line in described), sorted(c for c in helps if c))
        found = [re.match(r"(?:\(.*?\)|\*)?(--?[\w-]+)\[(.*)", line) for line in lines]
        found = {name[1]: name[2] for name in found if name}
        check.equal(f"zsh: options of {command!r}", sorted(found), sorted(n for o in options for n in o.names))
        for option in options:
            for name in option.names:
                values = found.get(name, "").rpartition(f"]:{option.value}:")[2] if option.value else ""
                replies = values.removeprefix("_sequence compadd - ").strip("()").split() if option.choices else []
                check.equal(f"zsh: values of {command} {name}", replies, option.choices)


def check_fish(check, script, helps):
    def replies(line):
        with tempfile.TemporaryDirectory() as empty:  # fish offers the files of the folder as well
            asked = run("fish", "--no-config", "-c", f"source '{script}'; complete --do-complete '{line}'", folder=empty)
        return sorted({reply.split("\t")[0] for reply in asked.stdout.splitlines()}) + asked.stderr.split()

    check.equal("fish: commands", [r for r in replies("gumcert ") if not r.startswith("-")], sorted(c for c in helps if c))
    for command, options in helps.items():
        line = f"gumcert {command} ".replace("  ", " ")
        long_names = sorted(name for option in options for name in option.names if name.startswith("--"))
        check.equal(f"fish: options of {command!r}", replies(line + "--"), long_names)
        for option in options:
            if option.choices:
                check.equal(f"fish: values of {command} {option.names[-1]}", replies(f"{line}{option.names[-1]} "),
                            sorted(option.choices))
    check.holds("fish: import", "dcc" in replies("gumcert import "))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--manual", required=True, type=pathlib.Path)
    given = parser.parse_args()
    given.manual = given.manual.resolve()
    check = Check()

    texts = {"": run(given.program, "--help").stdout}
    for name, _ in entries(section(texts[""], "Subcommands")):
        texts[name] = run(given.program, name, "--help").stdout
    helps = {name: options_of(text) for name, text in texts.items()}
    for name, options in helps.items():
        check.holds(f"--help of {name!r} was read", len(options) >= 4)
    check.holds("--help names the commands", len(helps) >= 10)

    pages = {f"gumcert-{name}.1.gz" if name else "gumcert.1.gz": name for name in helps}
    check.equal("pages", sorted(p.name for p in (given.manual / "man1").iterdir()), sorted(pages))
    for page, name in pages.items():
        check_page(check, given.manual / "man1" / page, page.removesuffix(".1.gz"), texts[name], helps[name])
    for shell, look, script in (("bash", check_bash, "gumcert"), ("zsh", check_zsh, "_gumcert"),
                                ("fish", check_fish, "gumcert.fish")):
        if check.has(shell):
            look(check, given.manual / "completion" / script, helps)

    for failure in check.failures:
        print(failure)
    print(f"{check.looked_at} statements, {len(check.failures)} wrong")
    if check.failures:
        return 1
    if check.missing:
        print(f"not installed: {', '.join(check.missing)} — manual or completion is tried with each — run scripts/setup")
        return 77
    return 0


if __name__ == "__main__":
    sys.exit(main())
