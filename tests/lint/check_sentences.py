"""Every sentence that the program writes into a record has its wording in four languages, and every text of the wording
is used.

Eight laws:
1. A text of words in the sources that make findings, remarks and messages, every gate among them, stands in an English pattern of
   templates/wording/sentences.json. Texts that are put together of several literals are found literal by literal.
2. Every entry of sentences.json has a text in each language, with the same placeholders, and the languages have the same
   keys in the wording files.
3. Every key of a wording file is asked for by a source or a template.
4. Every pattern that the audit says (say(), say_count()) has its translations in templates/wording/audit_sentences.json, with
   the same places, each once, and the same numbers; no other entry stands there, and no source of the audit has a
   sentence of words that is no pattern.
5. A noun that has a singular and a plural behind one number has both behind every number of its file, and no source writes
   "degrees of freedom" behind a number by itself (text/degrees_of_freedom.h): "1 degrees of freedom" is printed nowhere.
6. A thing has one name in a language: what one sentence of a document calls a budget, a tolerance or consistency, the
   table beside it calls the same.
7. What a reader of jobs warns of (warn()) stands in sentences.json, too: it is among the messages of the evaluation.
8. A value to be written into JSON is no number of a language there: a job with 0,5 is refused.
"""

import json
import pathlib
import re
import sys

LANGUAGES = ("en", "de", "es", "zh-Hant")

# Sources of the sentences in records. A file that is added here has all of its sentences in the catalogue. Every gate is
# one without being named.
GATES = "certificate/gates/*.cpp"
NO_GATES = ("certificate/gates/accreditation_standard.cpp",)  # publishers of standards
SOURCES = (
    "laboratory/applicability.cpp",
    "reports/record/make/rotary_table/adjustment_record.cpp",
    "reports/record/make/budget/budget_findings.cpp",
    "reports/record/make/budget/budget_record.cpp",
    "reports/record/make/certificate/certified_scope.cpp",
    "reports/record/make/certificate/certify.cpp",
    "reports/record/make/circle_closure/circle_closure_findings.cpp",
    "reports/record/make/comparison/compared_job_side.cpp",
    "reports/record/make/certificate/environment_findings.cpp",
    "reports/record/make/comparison/evaluate_laboratories.cpp",
    "reports/record/make/comparison/laboratory_notes.cpp",
    "reports/record/make/comparison/method_remarks.cpp",
    "reports/record/make/rotary_table/location_error_record.cpp",
    "reports/record/make/rotary_table/reference_comparison.cpp",
    "reports/record/make/rotary_table/rotary_findings.cpp",
    "reports/record/make/rotary_table/rotary_monte_carlo_record.cpp",
    "reports/record/make/rotary_table/table_parameter_record.cpp",
    "engine/rotary_table/evaluation/repeatability_check.cpp",
    "engine/rotary_table/evaluation/stated_positions.cpp",
    "engine/rotary_table/group_notes.cpp",
    "engine/rotary_table/reversal_choice.cpp",
    "gum/budget/budget_coverage.cpp",
    "gum/budget/evaluate_budget.cpp",
    "gum/budget/evaluation_choice.cpp",
    "gum/budget/fit_scatter.cpp",
    "gum/budget/reported_covariance.cpp",
    "gum/budget/zero_uncertainty.cpp",
    "gum/comparison/assigned_value.cpp",
    "gum/comparison/item_result.cpp",
    "gum/comparison/laboratory_covariance.cpp",
    "gum/comparison/laboratory_data.cpp",
    "gum/rotary_table/location_errors.cpp",
)

# Readers whose warnings documents in all languages print. Plans and simulations are in English.
WARNING_READERS = ("jobs/budget/*.cpp", "jobs/comparison/*.cpp", "jobs/laboratory/*.cpp", "jobs/rotary_table/*.cpp")

# Names that a language has for a thing beside the one that is used, and this one.
OTHER_NAMES = {
    "de": {"bilanz": "Budget"},
    "es": {
        "presupuesto": "balance de incertidumbre",
        "consistente": "coherente",
        "consistencia": "coherencia",
        "chi-cuadrado": "chi cuadrado",
        "ji cuadrado": "chi cuadrado",
        "ji al cuadrado": "chi cuadrado",
    },
    "zh-Hant": {"預算": "評估表", "公差": "容差", "允差": "容差", "所測量": "所量測"},
}

# Literals of these sources that are no sentences of a record, or end the program in place of a record.
NOT_IN_RECORDS = (
    "Monte Carlo, ",
    # Names of results, which reports/result_names.cpp words.
    "position of the axis along ",
    "tilt of the axis about ",
    " in the frame of the machine",
)

FORMS = re.compile(r"\{[a-z_]+\?([^|}]*)\|([^}]*)\}")  # reports/forms_of_number.h
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
JSON_FRAGMENT = re.compile(r'"\w+"\s*:\s*(?:\{\{.*\}\}|\[.*?\]|"[^"]*"|[^\s，。]+)')  # "key": value
ESCAPED = re.compile(r"\\u([0-9A-Fa-f]{4})")


def without_comments(source: str) -> str:
    kept = []
    for line in source.splitlines():
        if line.lstrip().startswith(("//", "#include")):
            continue
        kept.append(re.sub(r"\s//[^\"]*$", "", line))
    return "\n".join(kept)


def texts_of(source: str) -> list[str]:
    """The string literals, those beside each other as one."""
    joined = re.sub(r'"\s*\n\s*"', "", without_comments(source))
    return [ESCAPED.sub(lambda code: chr(int(code[1], 16)), text).replace('\\"', '"').replace("\\\\", "\\")
            for text in LITERAL.findall(joined)]


def is_sentence(text: str) -> bool:
    return len(re.findall(r"[A-Za-z]{2,}", text)) >= 3 and " " in text.strip()


def placeholders(pattern: str) -> set[str]:
    bare = pattern.replace("{{", "").replace("}}", "")
    return {re.split("[:?]", name)[0] for name in re.findall(r"\{([^}]*)\}", bare)}


def literals(pattern: str) -> list[str]:
    parts = []
    for form in (r"\1", r"\2"):
        bare = FORMS.sub(lambda found: found.expand(form).replace("#", "{}"), pattern)
        bare = bare.replace("{{", "\1").replace("}}", "\2")
        parts += [part.replace("\1", "{").replace("\2", "}") for part in re.split(r"\{[^}]*\}", bare)]
    return parts


def unknown_sentences(root: pathlib.Path, catalogue: dict) -> list[str]:
    known = [part for entry in catalogue.values() for part in literals(entry["en"])]
    problems = []
    gates = sorted({str(path.relative_to(root)) for path in root.glob(GATES)} - set(NO_GATES))
    for name in (*gates, *SOURCES):
        for text in texts_of((root / name).read_text(encoding="utf-8")):
            if not is_sentence(text) or text in NOT_IN_RECORDS:
                continue
            # Two sentences in one literal have two entries; what joins them stands in none.
            for part in re.split(r"(?<=[.]) (?=[A-Z])|; ", text):
                bare = part.strip(" ,;:()")
                if is_sentence(part) and not any(bare in one for one in known):
                    problems.append(f"{name}: no wording in templates/wording/sentences.json for: {part!r}")
    return problems


def calls_of(name: str, source: str) -> list[str]:
    """The arguments of each call of a function, as they stand."""
    calls = []
    for found in re.finditer(r"\b" + name + r"\(", source):
        depth, at = 1, found.end()
        while depth > 0 and at < len(source):
            if source[at] == '"':
                at = LITERAL.match(source, at).end()
                continue
            depth += {"(": 1, ")": -1}.get(source[at], 0)
            at += 1
        calls.append(source[found.end() : at])
    return calls


def unknown_warnings(root: pathlib.Path, catalogue: dict) -> list[str]:
    """Law 7: sentences of warnings that have no wording."""
    known = [part for entry in catalogue.values() for part in literals(entry["en"])]
    problems = []
    for path in sorted(path for pattern in WARNING_READERS for path in root.glob(pattern)):
        for call in calls_of("warn", without_comments(path.read_text(encoding="utf-8"))):
            for text in texts_of(call):
                bare = text.strip(" ,;:()")
                if is_sentence(text) and not any(bare in one for one in known):
                    problems.append(f"{path.relative_to(root)}: warn() says what has no wording: {text!r}")
    return problems


def uneven_entries(catalogue: dict) -> list[str]:
    problems = []
    for key, entry in catalogue.items():
        if set(entry) != set(LANGUAGES):
            problems.append(f"sentences.json#/{key}: languages {sorted(entry)}, not {sorted(LANGUAGES)}")
            continue
        for language in LANGUAGES[1:]:
            if placeholders(entry[language]) != placeholders(entry["en"]):
                problems.append(f"sentences.json#/{key}/{language}: other placeholders than in English")
    return problems


def decimal_signs_in_json(catalogue: dict) -> list[str]:
    """Law 8: the kind in the English pattern says which values get the decimal sign of the language."""
    problems = []
    for key, entry in catalogue.items():
        kinds = dict(re.findall(r"\{(\w+):(\w+)\}", entry["en"]))
        for language, text in entry.items():
            for fragment in JSON_FRAGMENT.findall(text):
                worded = [name for name in re.findall(r"\{(\w+)", fragment) if kinds.get(name) in ("number", "list")]
                if worded or re.search(r"\d,\d", fragment):
                    problems.append(f"sentences.json#/{key}/{language}: decimal sign of the language in JSON: {fragment!r}")
    return problems


def keys_of(wording: dict, at: tuple = ()) -> set[tuple]:
    keys = set()
    for key, value in wording.items():
        keys |= keys_of(value, at + (key,)) if isinstance(value, dict) else {at + (key,)}
    return keys


def uneven_files(root: pathlib.Path) -> list[str]:
    files = {
        language: json.loads((root / "templates/wording" / f"{language}.json").read_text(encoding="utf-8"))
        for language in LANGUAGES
    }
    english = keys_of(files["en"])
    problems = []
    for language in LANGUAGES[1:]:
        keys = keys_of(files[language])
        problems += [f"{language}.json: /{'/'.join(k)} is missing" for k in sorted(english - keys)]
        problems += [f"{language}.json: /{'/'.join(k)} is not in en.json" for k in sorted(keys - english)]
    return problems


def literal_calls(root: pathlib.Path) -> set[tuple[str, str]]:
    """Keys that sources ask for by two literals: words("group", "name"), filled("group", "name", …), fill("name", …)."""
    asked = set()
    for path in [*root.glob("reports/**/*.cpp"), *root.glob("reports/**/*.h"), *root.glob("evaluation/*.cpp"),
                 *root.glob("issuing/*.cpp"), *root.glob("self_test/*.cpp")]:
        source = without_comments(path.read_text(encoding="utf-8"))
        for group, name in re.findall(r'(?:words|words\(\)|wording_|filled)\(\s*"(\w+)",\s*"([^"]+)"', source):
            asked.add((group, name))
        for name in re.findall(r'\bfill\(\s*"([^"]+)"', source):
            asked.add(("sentence", name))
    return asked


def missing_keys(root: pathlib.Path) -> list[str]:
    english = json.loads((root / "templates/wording/en.json").read_text(encoding="utf-8"))
    known = {key[:2] for key in keys_of(english)}
    return [
        f"en.json: /{group}/{name} is asked for by a source and missing"
        for group, name in sorted(literal_calls(root))
        if (group, name) not in known and not name.endswith("_") and group != "study"  # a study has words of its own
    ]


def unused_keys(root: pathlib.Path) -> list[str]:
    """Keys whose name stands in no source and no template. Names that a source puts together of parts, and words that
    are codes of a record, count as used by their group."""
    english = json.loads((root / "templates/wording/en.json").read_text(encoding="utf-8"))
    text = "\n".join(
        path.read_text(encoding="utf-8")
        for folder in ("reports", "evaluation", "issuing", "self_test", "archive", "app", "certificate", "gum", "engine")
        for path in root.glob(f"{folder}/**/*")
        if path.suffix in (".cpp", ".h")
    )
    problems = []
    for group, names in english.items():
        if isinstance(names, str):
            continue
        for name, value in names.items():
            parts = [name] + ([] if isinstance(value, str) else list(value))
            whole = any(f'"{part}"' in text for part in parts)
            # "datum_" + r.datum
            start = any(f'"{name[:i + 1]}"' in text for i, c in enumerate(name) if c == "_")
            end = any(f'"{name[i:]}"' in text for i, c in enumerate(name) if c == "_")
            by_code = f'words("{group}", ' in text or f'.has("{group}", ' in text or f'.filled("{group}", ' in text
            if not (whole or start or end or by_code):
                problems.append(f"en.json: /{group}/{name} is used by no source")
    return problems


FORMS_BEHIND = re.compile(r"\{([a-z_]+)(?::\w+)?\} \{\1\?([^|}]*)\|([^}]*)\}")
SEVERAL = ("{effective}", "{effective:number}", "{nu_reference}", "{pool}")  # no counts; the second one of two numbers
TWO_NUMBERS = (  # "with 1 and 4 degrees of freedom"; or one that is never 1
    "gum/analysis_of_variance.cpp",
    "jobs/budget/budget_statement.cpp",
    "reports/record/make/budget/budget_findings.cpp",
    "reports/record/make/circle_closure/circle_closure_findings.cpp",
)


def texts_in(wording: dict, at: str = "") -> list[tuple[str, str]]:
    texts = []
    for key, value in wording.items():
        texts += texts_in(value, f"{at}/{key}") if isinstance(value, dict) else [(f"{at}/{key}", value)]
    return texts


def plural_of_one(texts: list[tuple[str, str]], name: str) -> list[str]:
    """Places where a noun stands in the plural behind any number, though it has a singular in another sentence."""
    nouns = {found[2] for _, text in texts for found in FORMS_BEHIND.findall(text)}
    if not nouns:
        return [f"{name}: no noun has a singular and a plural"]
    alone = re.compile(r"(\{[a-z_]+(?::\w+)?\}) (" + "|".join(sorted(map(re.escape, nouns), key=len, reverse=True)) + r")\b")
    return [
        f"{name}#{at}: {found[0]} {found[1]}, also where it is 1"
        for at, text in texts
        for found in alone.findall(text)
        if found[0] not in SEVERAL
    ]


def plurals(root: pathlib.Path, catalogue: dict) -> list[str]:
    problems = []
    for language in ("en", "de", "es"):
        wording = json.loads((root / "templates/wording" / f"{language}.json").read_text(encoding="utf-8"))
        problems += plural_of_one(texts_in(wording), f"{language}.json")
        of_records = [(f"/{key}", entry[language]) for key, entry in catalogue.items() if language in entry]
        problems += plural_of_one(of_records, f"sentences.json, {language}")
    for path in sorted(root.glob("**/*.cpp")):
        folder = path.relative_to(root).parts[0]
        if folder in ("build", "tests", "examples", "text", "node_modules"):
            continue
        if str(path.relative_to(root)) in TWO_NUMBERS:
            continue
        source = without_comments(path.read_text(encoding="utf-8"))
        if re.search(r"\+\s*\" degrees of freedom|\{\} degrees of freedom", source):
            problems.append(f"{path.relative_to(root)}: \"degrees of freedom\" behind a number, also where it is 1")
    return problems


# The audit -------------------------------------------------------------------------------------------------------------

AUDIT = ("audit/*.cpp", "audit/worksheets/*.cpp", "audit/rules/*.cpp", "audit/words/*.cpp", "audit/tables/*.cpp", "audit/sources/*.cpp",
         "evaluation/audit_files.cpp")
# Words to look for in the files of others, pages of our documentation, and messages of the program.
NO_SENTENCES_OF_AUDIT = (
    "row_meaning.cpp",
    "row_facts.cpp",
    "checklists.cpp",
    "rules_page.cpp",
    "left_out.cpp",
    "column_heads.cpp",
    "column_words.cpp",
    "statement_words.cpp",
    "uncertainty_in_words.cpp",
    "sum_names.cpp",
    "certificate_in.cpp",
    "coverage_words.cpp",
    "named_statement.cpp",
    "product_of_coverage.cpp",
    "stated_rule.cpp",
    "gate_findings.cpp",
    "audit_files.cpp",
)
NOT_SAID_BY_AUDIT = (
    "terms of second order",  # name of a row that a correction adds
    "terms of second order: ",
    "displacement of the contact point",  # name of a result
)
OF_A_RULE = re.compile(r"\.(?:title|detection|correction|question|text|source)\s*=\s*(?:\"(?:[^\"\\]|\\.)*\"\s*)+")
SAID = re.compile(r"\bsay(_count)?\(")
WORDS_TO_LOOK_FOR = re.compile(r"\b(?:has_any|has_word|mentions|says|say_one_of|is_one_of)\(")


def behind(source: str, at: int) -> int:
    """The place behind the bracket that opens at a place."""
    depth = 0
    while True:
        if source[at] == '"':
            at = LITERAL.match(source, at).end() - 1
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(source[at], 0)
        at += 1
        if depth == 0:
            return at


def said_in(source: str) -> tuple[set[str], str]:
    """The patterns that a source says, and the source without them."""
    joined = re.sub(r'"\s*\n\s*"', "", without_comments(source))
    patterns, rest, at = set(), "", 0
    for call in SAID.finditer(joined):
        inside = joined[call.end() : behind(joined, call.end() - 1) - 1]
        found = LITERAL.findall(inside) if call[1] else [m[1] for m in [LITERAL.match(inside.lstrip())] if m]
        patterns |= {text.replace('\\"', '"') for text in found}
        rest += joined[at : call.end()]
        at = call.end() + (len(inside) if call[1] else len(inside) - len(without_first(inside)))
    return patterns, rest + joined[at:]


def without_first(arguments: str) -> str:
    return re.sub(r'^\s*"(?:[^"\\]|\\.)*"', "", arguments)


def without_words_to_look_for(source: str) -> str:
    kept, at = "", 0
    for call in WORDS_TO_LOOK_FOR.finditer(source):
        if call.start() >= at:
            kept += source[at : call.start()]
            at = behind(source, call.end() - 1)
    return kept + source[at:]


def numbers(text: str) -> list[str]:
    return sorted(re.findall(r"\d+(?:[.,]\d+)?", re.sub(r"\{[^}]*\}", "", text).replace(",", ".")))


def places(pattern: str) -> list[str]:
    return sorted(re.findall(r"\{(\w+)(?::\w+)?\}", pattern))


def unworded_audit(root: pathlib.Path, of_program: dict) -> list[str]:
    known = [part for entry in of_program.values() for part in literals(entry["en"])]
    catalogue = json.loads((root / "templates/wording/audit_sentences.json").read_text(encoding="utf-8"))
    problems, said = [], set()
    for path in sorted(path for pattern in AUDIT for path in root.glob(pattern)):
        patterns, rest = said_in(path.read_text(encoding="utf-8"))
        said |= patterns
        if path.name in NO_SENTENCES_OF_AUDIT:
            continue
        for text in LITERAL.findall(without_words_to_look_for(OF_A_RULE.sub("", rest))):
            worded = text in NOT_SAID_BY_AUDIT or any(text.strip(" ,;:()") in one for one in known)
            if is_sentence(text) and not worded:
                problems.append(f"{path.relative_to(root)}: say() does not say: {text!r}")
    name = "audit_sentences.json"
    problems += [f"{name}: no translations of {pattern!r}" for pattern in sorted(said - set(catalogue))]
    problems += [f"{name}: no source says {pattern!r}" for pattern in sorted(set(catalogue) - said)]
    for pattern, texts in catalogue.items():
        if set(texts) != set(LANGUAGES[1:]):
            problems.append(f"{name}#/{pattern}: languages {sorted(texts)}, not {sorted(LANGUAGES[1:])}")
        for language, text in texts.items():
            if places(text) != places(pattern) or ":" in "".join(re.findall(r"\{[^}]*\}", text)):
                problems.append(f"{name}#/{pattern}/{language}: other places than in English")
            if numbers(text) != numbers(pattern):
                problems.append(f"{name}#/{pattern}/{language}: other numbers than in English")
    return problems


def other_names(root: pathlib.Path, catalogue: dict) -> list[str]:
    """Law 6: texts with another name of a thing than the one that its language uses."""
    of_audit = json.loads((root / "templates/wording/audit_sentences.json").read_text(encoding="utf-8"))
    problems = []
    for language, names in OTHER_NAMES.items():
        wording = json.loads((root / f"templates/wording/{language}.json").read_text(encoding="utf-8"))
        texts = [(f"{language}.json#{place}", text) for place, text in texts_in(wording)]
        for name, entries in (("sentences.json", catalogue), ("audit_sentences.json", of_audit)):
            texts += [(f"{name}#/{pattern}/{language}", of[language]) for pattern, of in entries.items() if language in of]
        for place, text in texts:
            problems += [
                f"{place}: {other!r} is called {used!r} elsewhere" for other, used in names.items() if other in text.lower()
            ]
    return problems


def main(root: pathlib.Path) -> int:
    catalogue = json.loads((root / "templates/wording/sentences.json").read_text(encoding="utf-8"))
    problems = (
        uneven_entries(catalogue)
        + decimal_signs_in_json(catalogue)
        + uneven_files(root)
        + missing_keys(root)
        + unused_keys(root)
        + unknown_sentences(root, catalogue)
        + unworded_audit(root, catalogue)
        + plurals(root, catalogue)
        + other_names(root, catalogue)
        + unknown_warnings(root, catalogue)
    )
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
