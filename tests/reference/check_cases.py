#!/usr/bin/env python3
"""Every published case has the shape that README.md beside the cases describes, and the list in it is theirs.

    check_cases.py [--write] [FOLDER]

Prints `file: reason` for every breach and exits with 1, or 0 when there is none. With --write the list is written first.
"""

import json
import pathlib
import re
import sys
from decimal import Decimal, InvalidOperation

PATH = re.compile(r"\{([^{}]+)\}")
CASE = {"title": str, "topic": str, "source": dict, "checked_by": str, "note": str, "data": dict, "jobs": dict,
        "expected": list}
SOURCE = {"document": str, "place": str, "place_unverified": str, "read_in": str, "seen": str}
EXPECTED = {"quantity": str, "kind": str, "input": str, "printed": (str, bool), "computed": (int, float, str, bool),
            "unit": str, "seen": str, "tolerance": (int, float, str), "relative_tolerance": float, "found": (str, list),
            "not_compared": str, "note": str}
SEEN = ("opened", "quoted", "recalled")
LIST = re.compile(r"(<!-- list of the cases: check_cases\.py --write -->\n).*?(<!-- end of the list -->)", re.DOTALL)


def is_number(text):
    try:
        return Decimal(text.replace(" ", "")).is_finite()
    except InvalidOperation:
        return False


def keys_of(part, known, needed, name):
    for key, value in part.items():
        if key not in known:
            yield f"{name} has the key {key}, which README.md does not know"
        elif not isinstance(value, known[key]):
            yield f"{name}: {key} is of the wrong type"
    yield from (f"{name} has no {key}" for key in needed if key not in part)


def formulas_of(part):
    """Of jobs and expected values: every text that can hold paths."""
    if isinstance(part, dict):
        for value in part.values():
            yield from formulas_of(value)
    elif isinstance(part, list):
        for value in part:
            yield from formulas_of(value)
    elif isinstance(part, str) and "{" in part:
        yield part


def roots_of(formula):
    """What the paths of a formula begin with, and the second step."""
    return [tuple(path.split("/")[:2]) for path in (PATH.findall(formula) if "{" in formula else [formula])]


def breaches_of_entry(entry, name):
    yield from keys_of(entry, EXPECTED, ("quantity", "kind"), name)
    if ("printed" in entry) == ("computed" in entry):
        yield f"{name}: a value is either printed or computed"
    if ("found" in entry) == ("not_compared" in entry):
        yield f"{name}: a value is found in a record, or says in not_compared why it is not compared"
    if "tolerance" in entry and "relative_tolerance" in entry:
        yield f"{name}: one tolerance is enough"
    tolerance = entry.get("tolerance", entry.get("relative_tolerance"))
    if isinstance(tolerance, (int, float)) and tolerance <= 0 or isinstance(tolerance, str) and "{" not in tolerance:
        yield f"{name}: a tolerance is a positive number, or a formula with a path in it"
    value = entry.get("computed")
    if tolerance is None and isinstance(value, (int, float)) and not isinstance(value, bool):
        yield f"{name}: a computed number needs a tolerance"
    if tolerance is not None and isinstance(entry.get("printed"), str) and not is_number(entry["printed"]):
        yield f"{name}: {entry['printed']} is no number, so that it has no tolerance"
    if entry.get("seen", "opened") not in SEEN:
        yield f"{name}: seen is one of {', '.join(SEEN)}"


def breaches_of_case(case):
    yield from keys_of(case, CASE, ("title", "topic", "source", "checked_by", "jobs", "expected"), "the case")
    source = case.get("source", {})
    yield from keys_of(source, SOURCE, ("document", "seen"), "source")
    if source.get("seen") not in SEEN:
        yield f"source: seen is one of {', '.join(SEEN)}"
    if ("place" if source.get("seen") == "recalled" else "place_unverified") in source:
        yield "source: the place is place_unverified where it is recalled, and place elsewhere"
    if not any("found" in entry for entry in case.get("expected", [])):
        yield "no value is compared"
    jobs, used = case.get("jobs", {}), set()
    formulas = [text for entry in case.get("expected", []) for key in ("found", "tolerance") if key in entry
                for text in (entry[key] if isinstance(entry[key], list) else [entry[key]]) if isinstance(text, str)]
    for number, entry in enumerate(case.get("expected", []), start=1):
        yield from breaches_of_entry(entry, f"expected value {number} ({entry.get('quantity')} {entry.get('kind')})")
    for formula in formulas + list(formulas_of(jobs)):
        for root in roots_of(formula):
            used.add(root if root[0] == "data" else root[:1])
            if root[0] not in jobs and (root[0] != "data" or root[1:] and root[1] not in case.get("data", {})):
                yield f"{formula}: there is no job, and no data, {'/'.join(root)}"
    for name, job in jobs.items():
        if "like" in job:
            used.add((job["like"],))
            if job["like"] not in list(jobs)[:list(jobs).index(name)]:
                yield f"job {name}: there is no job {job['like']} before it"
    yield from (f"job {name}: no value is found in its record" for name in jobs if (name,) not in used)
    yield from (f"data {name}: no job takes them" for name in case.get("data", {}) if ("data", name) not in used)


def line_of(name, case):
    """A case in the list: what it is, where it comes from, what is compared."""
    source, kinds, left_out = case["source"], {}, {}
    for entry in case["expected"]:
        counted = kinds if "found" in entry else left_out
        counted[entry["kind"]] = counted.get(entry["kind"], 0) + 1

    def listed(counts):
        return ", ".join(kind + (f" ×{count}" if count > 1 else "") for kind, count in counts.items())

    place = f", {source['place']}" if "place" in source else ""
    if "place_unverified" in source:
        place = f" ({source['place_unverified']}: unverified)"
    compared = listed(kinds) + (f"; not compared: {listed(left_out)}" if left_out else "")
    cells = (f"[{name}]({name}.json)", case["title"], source["document"] + place, source["seen"], compared)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"


def with_list(readme, cases):
    """README.md with the list of these cases."""
    text = "| case | what | source | seen | compared |\n|---|---|---|---|---|\n"
    topics = sorted({case["topic"] for case in cases.values()}, key=str.lower)
    lines = [f"\n### {topic[0].upper()}{topic[1:]}\n\n{text}" +
             "".join(line_of(name, case) for name, case in cases.items() if case["topic"] == topic) for topic in topics]
    count = sum("found" in entry for case in cases.values() for entry in case["expected"])
    said = f"\n{len(cases)} cases with {count} values that are compared.\n"
    return LIST.sub(lambda match: match[1] + said + "".join(lines) + "\n" + match[2], readme)


def main(arguments):
    write = "--write" in arguments
    folders = [argument for argument in arguments if argument != "--write"]
    folder = pathlib.Path(folders[0] if folders else pathlib.Path(__file__).resolve().parent / "cases")
    cases, found = {}, []
    for path in sorted(folder.glob("*.json")):
        try:
            cases[path.stem] = json.loads(path.read_text(encoding="utf-8"))
            found += [f"{path.name}: {reason}" for reason in breaches_of_case(cases[path.stem])]
        except (json.JSONDecodeError, AttributeError, TypeError) as error:
            found.append(f"{path.name}: it does not have the shape of a case: {error}")
    if not cases:
        found.append(f"{folder}: no case found to check")
    if not found:
        readme = folder / "README.md"
        text = readme.read_text(encoding="utf-8")
        if not LIST.search(text):
            found.append("README.md: the marks around the list of the cases are missing")
        elif with_list(text, cases) != text:
            if write:
                readme.write_text(with_list(text, cases), encoding="utf-8")
            else:
                found.append("README.md: the list is not that of the cases; run check_cases.py --write")
    print("\n".join(found + [f"{len(cases)} cases checked, {len(found)} breaches"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
