#!/usr/bin/env python3
"""What docs/accuracy.md and the headers point to is there.

    check_accuracy.py [ROOT]

Prints every name that leads nowhere and exits with 1, or 0 when there is none.

- tests that the page names, `file_test`: Case, Case
- reference cases that it names, with * for several
- examples that headers name, `/// Example: examples/api/NAME.cpp`, and places of the page, `docs/accuracy.md#place`
- examples whose output no test compares
"""

import pathlib
import re
import sys

PAGE = "docs/accuracy.md"
EXAMPLES = "examples/api"
COMPARED = "tests/install/install_test.cmake"

NAMED_TESTS = re.compile(r"`(\w+_test)`:\s*`?([A-Z]\w*`?(?:,\s+`?[A-Z]\w*`?)*)")
CASE_OF_REFERENCE = re.compile(r"`([a-z0-9]+-[a-z0-9*-]+)`")
TEST = re.compile(r"\bTEST(?:_F|_P)?\(\s*\w+\s*,\s*(\w+)\s*\)")
EXAMPLE = re.compile(r"///.*\bExamples?: (.*)")
PLACE = re.compile(r"docs/accuracy\.md#([\w-]+)")


def anchor(heading):
    kept = re.sub(r"[^\w\s-]", "", heading.strip().lower())
    return re.sub(r"\s", "-", kept)


def missing(root):
    page = (root / PAGE).read_text(encoding="utf-8")
    cases = {}
    for path in (root / "tests").rglob("*_test.cpp"):
        cases.setdefault(path.stem, set()).update(TEST.findall(path.read_text(encoding="utf-8")))
    for stem, names in NAMED_TESTS.findall(page):
        for name in re.findall(r"\w+", names):
            if name not in cases.get(stem, set()):
                yield f"{PAGE}: no test {name} in {stem}.cpp"
    for name in CASE_OF_REFERENCE.findall(page):
        if not list((root / "tests/reference/cases").glob(name + ".json")):
            yield f"{PAGE}: no reference case {name}"

    places = {anchor(line[3:]) for line in page.split("\n") if line.startswith("## ")}
    for path in sorted(root.rglob("*.h")):
        relative = path.relative_to(root)
        if relative.parts[0] in {"build", "node_modules", ".git"}:
            continue
        text = path.read_text(encoding="utf-8")
        for place in PLACE.findall(text):
            if place not in places:
                yield f"{relative}: no section {place} in {PAGE}"
        for line in EXAMPLE.findall(text):
            for name in re.findall(r"examples/\S+\.cpp", line):
                if not (root / name).is_file():
                    yield f"{relative}: no example {name}"

    compared = (root / COMPARED).read_text(encoding="utf-8")
    for path in sorted((root / EXAMPLES).glob("*.cpp")):
        if f"expect_printed({path.stem} " not in compared:
            yield f"{EXAMPLES}/{path.name}: {COMPARED} does not compare what it prints"


def main(arguments):
    root = pathlib.Path(arguments[0] if arguments else ".").resolve()
    found = list(missing(root))
    for problem in found:
        print(problem)
    print(f"{len(found)} names that lead nowhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
