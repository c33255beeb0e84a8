#!/usr/bin/env python3
"""Every message has a code of its own, and templates/messages.json says what each code means.

    check_codes.py [ROOT] [--write]

Prints each breach on a line and exits with 1, or 0 when there is none. The laws:

- a code that a source makes is in the register; a code of the register is made by a source, or is retired. A retired code
  is never made again: somebody may still have it in a log.
- a code has one meaning. Where several places make one code, they state one rule, or the register lists each of their
  rules: to list a second one is a decision, and --write never takes it. Codes of the tables `InputCode` have the meaning
  that the table states, and every key has a rule of its own; there, the code is not written a second time.
- severity, class of failure and finding of a certificate are those that the sources state, where they can be read there.
- documents and comments name no code that there is not.
- docs/messages.md is what the register gives.

With --write it puts the rules of the sources and the severities of docs/findings.md into the register, and writes
docs/messages.md. Meaning, cause and remedy are written by people.
"""

import json
import pathlib
import re
import sys
import textwrap

import message_places

REGISTER = "templates/messages.json"
DOCUMENT = "docs/messages.md"
FINDINGS = "docs/findings.md"
TEXTS = ("meaning", "cause", "remedy")
KEYS = ("outcome", *TEXTS, "rules", "finding", "formerly")
LONGEST_FIRST_SENTENCE = 120  # it stands alone in a list of codes
CODE = message_places.CODE


def canonical(register):
    register["families"] = dict(sorted(register["families"].items()))
    register["codes"] = {
        code: {key: entry[key] for key in (*KEYS, "retired") if key in entry}
        for code, entry in sorted(register["codes"].items())
    }
    return json.dumps(register, ensure_ascii=False, indent=1) + "\n"


def family_of(code):
    return code.rsplit("-", 1)[0]


def first_sentence(text):
    return text[:text.find(". ") + 1] if ". " in text else text


def rules_of(places):
    return list(dict.fromkeys(rule for place in places for rule in place.rules))


def severities_of_findings(root):
    """id -> severity, of the tables of the document of findings."""
    file = root / FINDINGS
    rows = re.findall(r"^\| ([A-Z]\d\d(?:-\w+)?) \|[^|]*\| ([^|]*?) \|", file.read_text(encoding="utf-8"), re.M) if file.exists() else []
    return dict(reversed(rows))


def unwritten_texts(register):
    """Entries that say nothing, or too much."""
    for name, family in register["families"].items():
        if not family.get("title") or not family.get("text", "").endswith("."):
            yield f"{REGISTER}#/families/{name}: a family has a title, and a text that ends with a full stop"
    for name, outcome in register["outcomes"].items():
        if outcome.get("severity") not in ("note", "warning", "error") or not outcome.get("text", "").endswith("."):
            yield f"{REGISTER}#/outcomes/{name}: an outcome has the severity note, warning or error, and a text"
    meanings = {}
    for code, entry in register["codes"].items():
        at = f"{REGISTER}#/codes/{code}"
        if not CODE.fullmatch(code):
            yield f"{at}: a code is GC, a family and four digits"
        elif family_of(code) not in register["families"] and "retired" not in entry:
            yield f"{at}: the family {family_of(code)} is not described"
        if "retired" in entry:
            if set(entry) != {"retired"} or not entry["retired"].endswith("."):
                yield f"{at}: a retired code says in `retired` what it was, and nothing else"
            continue
        if not entry.get("outcome") or set(entry["outcome"]) - set(register["outcomes"]):
            yield f"{at}/outcome: one or more of {', '.join(register['outcomes'])}"
        for key in TEXTS:
            if not re.fullmatch(r"(?s)[A-Z0-9\"“`].*[.]", entry.get(key, "")):
                yield f"{at}/{key}: a text of whole sentences is needed"
        if set(entry) - set(KEYS):
            yield f"{at}: unknown keys {sorted(set(entry) - set(KEYS))}"
        meaning = entry.get("meaning", "")
        if len(first_sentence(meaning)) > LONGEST_FIRST_SENTENCE:
            yield f"{at}/meaning: the first sentence stands in lists, and has at most {LONGEST_FIRST_SENTENCE} characters"
        if meaning in meanings:
            yield f"{at}/meaning: the same as that of {meanings[meaning]}"
        meanings[meaning] = code


def unregistered_codes(register, tree):
    codes = register["codes"]
    for code, places in sorted(tree.places.items()):
        place = f"{places[0].file}:{places[0].line}" if places else "a table"
        if code not in codes:
            yield f"{place}: {code} is not in {REGISTER}; write what it means"
        elif "retired" in codes[code]:
            yield f"{place}: {code} is retired and never given again; take a number that none had"
    made = {code for code, places in tree.places.items() if places}
    for code, names in sorted(tree.tables.items()):
        if code not in made:
            yield f"{names[0]}: no source uses the constant of {code}; retire the code"
        if code not in codes:
            yield f"{names[0]}: {code} is not in {REGISTER}; write what it means"
        elif "retired" in codes[code]:
            yield f"{names[0]}: {code} is retired and never given again; take a number that none had"
        if len(names) > 1:
            yield f"{' and '.join(names)}: two constants of {code}; give one of them a code of its own"
        for file, line in tree.literals.get(code, ()):
            yield f"{file}:{line}: {code} is written a second time; use the constant {names[0]}"
    for code, entry in codes.items():
        if "retired" not in entry and code not in made and code not in tree.tables:
            yield f"{REGISTER}#/codes/{code}: no source makes it; say in `retired` what it was"


def second_meanings(register, tree):
    for code, places in sorted(tree.places.items()):
        entry = register["codes"].get(code)
        if entry is None or code in tree.tables:
            continue
        known = entry.get("rules", [])
        for place in places:
            for rule in place.rules:
                if rule not in known:
                    yield (f"{place.file}:{place.line}: {code} states “{rule}”, which {REGISTER} does not list: a code has "
                           f"one meaning; give the message a code of its own, or list the rule where the meaning is the same")
        for rule in known:
            if rule not in rules_of(places):
                yield f"{REGISTER}#/codes/{code}/rules: no source states “{rule}”"


def other_outcomes(register, tree):
    for code, places in sorted(tree.places.items()):
        entry = register["codes"].get(code)
        if entry is None or "retired" in entry:
            continue
        severities = {register["outcomes"].get(one, {}).get("severity") for one in entry["outcome"]}
        for place in places:
            if place.severity is not None and place.severity not in severities:
                yield f"{place.file}:{place.line}: {code} is of severity {place.severity}, and {REGISTER} says otherwise"
            if place.error is not None and place.error not in entry["outcome"]:
                yield f"{place.file}:{place.line}: {code} ends as {place.error}, and {REGISTER} says otherwise"


def other_findings(register, tree, root):
    severities = severities_of_findings(root)
    for code, ids in sorted(tree.findings.items()):
        stated = register["codes"].get(code, {}).get("finding", {}).get("id")
        if code in register["codes"] and ids != {stated}:
            yield f"{REGISTER}#/codes/{code}/finding: the sources make it the finding {', '.join(sorted(ids))}"
    for code, entry in register["codes"].items():
        finding = entry.get("finding")
        if finding and finding.get("severity") != severities.get(finding.get("id"), ""):
            yield f"{REGISTER}#/codes/{code}/finding: {FINDINGS} says “{severities.get(finding.get('id'), 'nothing')}”"


def unknown_mentions(register, tree, root):
    """Codes that comments and documents name."""
    documents = [path for path in [*sorted(root.glob("docs/**/*.md")), root / "README.md"] if path.exists()]
    texts = [(source.name, source.raw) for source in tree.sources]
    texts += [(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")) for path in documents]
    for name, text in texts:
        if name == DOCUMENT:
            continue
        for number, line in enumerate(text.split("\n"), start=1):
            for code in CODE.findall(line):
                if code not in register["codes"] and code not in tree.places and code not in tree.tables:
                    yield f"{name}:{number}: names {code}, which there is not"


def document(register):
    def wrapped(text):
        return textwrap.fill(text, width=120, break_long_words=False, break_on_hyphens=False)

    lines = ["# Messages", "",
             wrapped("Every message of the program ends with its code in brackets. This page says of each code what it means, "
                     "what usually causes it, and what to do; `gumcert explain CODE` says the same in the terminal. It is made "
                     "from `templates/messages.json` by `tests/lint/check_codes.py --write`: correct it there. Texts are in "
                     "English. A rule is quoted as messages state it; “…” stands for what each of them fills in."), "",
             "| outcome | severity | what it is |", "|---|---|---|"]
    lines += [f"| {name} | {one['severity']} | {' '.join([one['text'], one.get('certificate', '')]).strip()} |" for name, one in register["outcomes"].items()]
    lines += ["", wrapped(register["finding"]), "", "## Families", ""]
    lines += [f"- [{name}](#{name.lower()}) {one['title']}" for name, one in register["families"].items()]
    for name, family in register["families"].items():
        lines += ["", f"## {name}", "", f"{family['title']}.", "", wrapped(family["text"])]
        for code, entry in register["codes"].items():
            if family_of(code) != name or "retired" in entry:
                continue
            lines += ["", f"### {code}", "", f"*{', '.join(entry['outcome']).replace('_', ' ')}*", "", wrapped(entry["meaning"]), "",
                      wrapped("**Usual cause.** " + entry["cause"]), "", wrapped("**What to do.** " + entry["remedy"])]
            if entry.get("rules"):
                label = "**Rule.**" if len(entry["rules"]) == 1 else "**Rules.**"
                lines += ["", wrapped(label + " " + "; ".join(f"“{rule}”" for rule in entry["rules"]).replace("*", "\\*").replace("_", "\\_"))]
            if "finding" in entry:
                lines += ["", wrapped(f"**On a certificate.** Finding {entry['finding']['id']}: {entry['finding']['severity']}.")]
            if "formerly" in entry:
                lines += ["", wrapped("**Formerly.** " + entry["formerly"])]
    retired = {code: entry["retired"] for code, entry in register["codes"].items() if "retired" in entry}
    if retired:
        lines += ["", "## Retired codes", "", "They are not given again.", "", "| code | what it was |", "|---|---|"]
        lines += [f"| {code} | {text} |" for code, text in retired.items()]
    return "\n".join(lines) + "\n"


def write(register, tree, root):
    severities = severities_of_findings(root)
    for code, entry in register["codes"].items():
        rules = [] if code in tree.tables else rules_of(tree.places.get(code, ()))
        if len(rules) == 1:
            entry["rules"] = rules
        elif not rules:
            entry.pop("rules", None)
        if "finding" in entry:
            entry["finding"]["severity"] = severities.get(entry["finding"]["id"], "")
    (root / REGISTER).write_text(canonical(register), encoding="utf-8")
    (root / DOCUMENT).write_text(document(register), encoding="utf-8")


def breaches(register, text, tree, root):
    yield from unwritten_texts(register)
    yield from unregistered_codes(register, tree)
    yield from second_meanings(register, tree)
    yield from other_outcomes(register, tree)
    yield from other_findings(register, tree, root)
    yield from unknown_mentions(register, tree, root)
    if canonical(register) != text:
        yield f"{REGISTER}: not in the order and form that tests/lint/check_codes.py --write gives it"
    file = root / DOCUMENT
    if not file.exists() or file.read_text(encoding="utf-8") != document(register):
        yield f"{DOCUMENT}: not what {REGISTER} gives; run tests/lint/check_codes.py --write"


def main(arguments):
    paths = [one for one in arguments if one != "--write"]
    root = pathlib.Path(paths[0] if paths else ".").resolve()
    tree = message_places.Tree(root)
    text = (root / REGISTER).read_text(encoding="utf-8")
    register = json.loads(text)
    if "--write" in arguments:
        write(register, tree, root)
        text = (root / REGISTER).read_text(encoding="utf-8")
        register = json.loads(text)
    found = list(dict.fromkeys(breaches(register, text, tree, root)))
    for breach in found:
        print(breach)
    print(f"{len(register['codes'])} codes, {len(found)} breaches")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
