"""What an audit says, in each language of its page: over the planted errors, the sound budgets and the examples.

    check_languages.py --program FILE [--all]

Each file in one of the languages, in turn; with --all (or GUMCERT_ALL_CASES) in all of them.
On a page in German, Spanish or Chinese nothing of a finding is English, and every sentence has the numbers of the English one in the
JSON of the same audit, those that stand alone with the decimal sign of the language.
"""

import argparse
import html
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
LANGUAGES = ("de", "es", "zh-Hant")
WORDS = {one: json.loads((ROOT / f"templates/wording/{one}.json").read_text(encoding="utf-8")) for one in LANGUAGES}


def numbers(text: str) -> list[str]:
    return sorted(re.findall(r"\d+(?:[.,]\d+)?", text.replace(",", ".")))


def texts(pattern: str, page: str) -> list[tuple[bool, str]]:
    """Whether each is marked as English, and its text."""
    return [(bool(mark), html.unescape(text)) for mark, text in re.findall(pattern, page, re.DOTALL)]


def has_words(text: str) -> bool:
    return len(re.findall(r"[a-z]{3,}", text)) >= 3  # a formula has none


class Audits:
    def __init__(self, program: str, in_all: bool):
        self.program = program
        self.in_all = in_all

    def made(self, file: pathlib.Path, form: str, language: str, folder: str) -> str:
        out = pathlib.Path(folder) / f"audit.{language}.{form}"
        options = ["--format", form, "--share", str(ROOT), "-o", str(out), "--quiet"]
        language_of = ["--language", language] if form == "html" else []
        done = subprocess.run([self.program, "audit", str(file), *options, *language_of], capture_output=True, text=True,
                              check=False)
        if done.returncode not in (0, 1):
            raise RuntimeError(f"{file}: {done.stderr}")
        return out.read_text(encoding="utf-8")

    def problems(self, number: int, file: pathlib.Path) -> list[str]:
        found = []
        languages = LANGUAGES if self.in_all else LANGUAGES[number % len(LANGUAGES):][:1]
        with tempfile.TemporaryDirectory() as folder:
            findings = json.loads(self.made(file, "json", "en", folder))["findings"]
            for language in languages:
                page = self.made(file, "html", language, folder)
                found += differences(page, findings, WORDS[language], f"{file.name}, {language}")
        return found


def beside(label: str, detail: str) -> list[tuple[bool, str]]:
    return texts(rf'<dt>{re.escape(label)}</dt><dd( lang="en")?>(.*?)</dd>', detail)


def differences(page: str, findings: list[dict], words: dict, name: str) -> list[str]:
    details = re.findall(r'<section class="finding".*?</section>', page, re.DOTALL)
    if len(details) != len(findings):
        return [f"{name}: {len(details)} findings on the page, {len(findings)} in JSON"]
    problems = []
    for detail, finding in zip(details, findings):
        said = texts(r'<p class="what"( lang="en")?>(.*?)</p>', detail)
        listed = re.search(r"</dt><dd><ul>(.*?)</ul>", detail, re.DOTALL)
        evidence = texts(r'<li( lang="en")?>(.*?)</li>', listed[1] if listed else "")
        compared = beside(words["audit"]["expected"], detail) + beside(words["audit"]["actual"], detail)
        stated = [finding["expected"] or "", finding["actual"] or ""] if compared else []
        shown, in_english = said + evidence + compared, [finding["what"], *finding["evidence"], *stated]
        if len(shown) != len(in_english):
            problems.append(f"{name}, {finding['id']}: {len(in_english)} sentences in JSON, {len(shown)} on the page")
        for (is_english, text), english in zip(shown, in_english):
            where = f"{name}, {finding['id']}: {text!r}"
            if is_english or (text == english and has_words(english)):
                problems.append(f"{where} is English")
            if numbers(text) != numbers(english):
                problems.append(f"{where} has other numbers than {english!r}")
            sign = words["document"]["decimal_sign"]
            if re.match(r"-?\d+[.]\d+( |$)", english) and sign not in text:
                problems.append(f"{where} has not the decimal sign of the language")
    return problems


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="the gumcert to ask")
    parser.add_argument("--all", action="store_true", default="GUMCERT_ALL_CASES" in os.environ, help="each file in all languages")
    options = parser.parse_args()
    audits = Audits(options.program, options.all)
    files = sorted(
        [*(ROOT / "tests/audit_sets/planted").iterdir(), *(ROOT / "tests/audit_sets/sound").iterdir()]
        + [path for path in (ROOT / "examples/audit").rglob("*") if path.suffix in (".csv", ".xlsx")]
    )
    with ThreadPoolExecutor(2) as pool:
        problems = [problem for found in pool.map(audits.problems, range(len(files)), files) for problem in found]
    print("\n".join(problems) or f"{len(files)} files, each in {len(LANGUAGES) if options.all else 1} of {len(LANGUAGES)} languages")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
