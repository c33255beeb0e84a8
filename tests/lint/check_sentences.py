"""Every sentence that the program writes into a record has its wording in four languages, and every text of the wording
is used.

Three laws:
1. A text of words in the sources that make findings, remarks and messages, every gate among them, stands in an English pattern of
   templates/wording/sentences.json. Texts that are put together of several literals are found literal by literal.
2. Every entry of sentences.json has a text in each language, with the same placeholders, and the languages have the same
   keys in the wording files.
3. Every key of a wording file is asked for by a source or a template.
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
    "reports/record/make/rotary_table/location_error_record.cpp",
    "reports/record/make/rotary_table/rotary_findings.cpp",
    "reports/record/make/rotary_table/rotary_monte_carlo_record.cpp",
    "reports/record/make/rotary_table/table_parameter_record.cpp",
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

# Literals of these sources that are no sentences of a record, or end the program in place of a record.
NOT_IN_RECORDS = (
    "Monte Carlo, ",
    # Names of results, which reports/result_names.cpp words.
    "position of the axis along ",
    "tilt of the axis about ",
    " in the frame of the machine",
)

LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')


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
    return [text.replace('\\"', '"').replace("\\\\", "\\") for text in LITERAL.findall(joined)]


def is_sentence(text: str) -> bool:
    return len(re.findall(r"[A-Za-z]{2,}", text)) >= 3 and " " in text.strip()


def placeholders(pattern: str) -> set[str]:
    bare = pattern.replace("{{", "").replace("}}", "")
    return {name.split(":")[0] for name in re.findall(r"\{([^}]*)\}", bare)}


def literals(pattern: str) -> list[str]:
    bare = pattern.replace("{{", "\1").replace("}}", "\2")
    return [part.replace("\1", "{").replace("\2", "}") for part in re.split(r"\{[^}]*\}", bare)]


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
    for path in [*root.glob("reports/**/*.cpp"), *root.glob("reports/**/*.h"), *root.glob("app/*.cpp")]:
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
        for folder in ("reports", "app", "certificate", "gum", "engine")
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


def main(root: pathlib.Path) -> int:
    catalogue = json.loads((root / "templates/wording/sentences.json").read_text(encoding="utf-8"))
    problems = (
        uneven_entries(catalogue)
        + uneven_files(root)
        + missing_keys(root)
        + unused_keys(root)
        + unknown_sentences(root, catalogue)
    )
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
