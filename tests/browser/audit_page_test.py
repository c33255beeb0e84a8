#!/usr/bin/env python3
"""The page of an audit in a browser: rules of accessibility (axe-core: WCAG 2.2 A and AA, best practice), wide and narrow, its
script under its own policy, and its filter.

    audit_page_test.py --pages PROGRAM      PROGRAM writes the pages into a folder: write_audit_pages

Skipped (77) where Chromium or axe-core is missing: `scripts/setup test` installs both.
"""

import argparse
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
AXE = HERE / "node_modules" / "axe-core" / "axe.min.js"
SKIPPED = 77

ASK_AXE = """
axe.run({runOnly: {type: "tag", values: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]}})
  .then((result) => answer({passes: result.passes.length,
    violations: result.violations.map((v) => v.id + ": " + v.help + " " + v.nodes[0].html.slice(0, 200))}));
"""
ASK_FILTER = """
const section = document.querySelector(".findings");
const shown = () => [...section.querySelectorAll(".finding")].filter((f) => !f.hidden).length;
const before = shown();
section.querySelector('[data-show="critical"]').click();
const critical = shown();
section.querySelector('[data-show="all"]').click();
section.querySelector(".fold").click();
answer({before, critical, all: shown(), open: [...section.querySelectorAll("details")].every((d) => d.open)});
"""


def document_in_browser(chromium, page, width):
    run = subprocess.run(
        [chromium, "--headless", "--no-sandbox", "--disable-gpu", f"--window-size={width},900",
         "--virtual-time-budget=30000", "--dump-dom", page.as_uri()],
        capture_output=True, text=True, encoding="utf-8", timeout=120, check=False)
    return run.stdout


def answer_of(chromium, folder, page, script, width=1100):
    """What a script says of a page: put into a copy without the policy, which lets no script but that of the page run."""
    text = page.read_text(encoding="utf-8")
    text = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>\n', "", text)
    text = text.replace("<details class=\"row\">", "<details class=\"row\" open>")
    tail = ("<script>const answer = (value) => { const out = document.createElement('pre'); out.id = 'answer';"
            "out.textContent = JSON.stringify(value); document.body.append(out); };\n" + script + "</script></body>")
    copy = folder / "asked.html"
    copy.write_text(text.replace("</body>", tail), encoding="utf-8")
    found = re.search(r'<pre id="answer">(.*?)</pre>', document_in_browser(chromium, copy, width), re.DOTALL)
    return json.loads(html.unescape(found[1])) if found else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--pages", required=True)
    pages = parser.parse_args().pages
    chromium = shutil.which("chromium")
    if chromium is None or not AXE.exists():
        print("skipped: chromium or axe-core is missing: scripts/setup test installs both")
        return SKIPPED
    problems = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([pages, name], check=True)
        axe = AXE.read_text(encoding="utf-8").replace("</script", "<\\/script")
        for language, width in (("en", 1100), ("en", 390), ("de", 1100), ("es", 390), ("zh-Hant", 1100)):
            result = answer_of(chromium, folder, folder / f"{language}.html", axe + ASK_AXE, width)
            if result is None or result["passes"] < 20:
                problems.append(f"{language}, {width}: axe-core gave no answer")
            else:
                problems += [f"{language}, {width}: {violation}" for violation in result["violations"]]
        filtered = answer_of(chromium, folder, folder / "en.html", ASK_FILTER)
        if filtered != {"before": 3, "critical": 1, "all": 3, "open": True}:
            problems.append(f"the filter shows {filtered}")
        own = document_in_browser(chromium, folder / "en.html", 1100)
        if not re.search(r'<div class="tools"[^>]*>', own) or re.search(r'<div class="tools"[^>]*hidden', own):
            problems.append("the script of the page does not run under the policy of the page")
        spoiled = folder / "spoiled.html"
        spoiled.write_text((folder / "en.html").read_text(encoding="utf-8").replace("</body>",
                           "<script>document.body.dataset.foreign = 'ran'</script></body>"), encoding="utf-8")
        if "data-foreign" in document_in_browser(chromium, spoiled, 1100):
            problems.append("a foreign script runs under the policy of the page")
    for problem in problems:
        print(problem)
    print(f"{len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
