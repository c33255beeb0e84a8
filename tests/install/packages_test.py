#!/usr/bin/env python3
"""scripts/packages.txt as scripts/setup reads it, and docs/dependencies.md, which says why each package is needed.

    packages_test.py    from the root of the tree; installs nothing
"""

import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def listed(root, *words):
    ended = subprocess.run([root / "scripts/setup", "--list", *words], capture_output=True, text=True, check=False)
    return ended.returncode, ended.stdout.split(), ended.stderr


class OurPackages(unittest.TestCase):
    def test_each_purpose_needs_what_the_one_before_needs(self):
        run, build, test = (listed(ROOT, purpose)[1] for purpose in ("run", "build", "test"))
        self.assertIn("nodejs", run)
        self.assertIn("g++", set(build) - set(run))
        self.assertIn("libgtest-dev", set(test) - set(build))
        self.assertLess(set(run), set(build))
        self.assertLess(set(build), set(test))
        self.assertEqual(listed(ROOT)[1], test)

    def test_the_document_names_every_package_and_no_other(self):
        text = (ROOT / "docs/dependencies.md").read_text(encoding="utf-8")
        first_columns = re.findall(r"^\| ([^|]*`[^|]*)\|", text, re.M)
        named = {name for column in first_columns for name in re.findall(r"`([^`]+)`", column) if "@" not in name}
        self.assertEqual(named, set(listed(ROOT, "test")[1]))


class OtherPackages(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        (self.root / "scripts").mkdir()
        shutil.copy(ROOT / "scripts/setup", self.root / "scripts/setup")

    def list_of(self, text, *words):
        (self.root / "scripts/packages.txt").write_text(text, encoding="utf-8")
        return listed(self.root, *words)

    def test_sections_may_repeat_and_stand_in_any_order(self):
        text = "# head\n[test] checks\nz # why\n\n[run] PDF\n  a\n[build] tools\nb\n[run] more\nc\n"
        self.assertEqual(self.list_of(text, "run"), (0, ["a", "c"], ""))
        self.assertEqual(self.list_of(text, "build"), (0, ["a", "b", "c"], ""))
        self.assertEqual(self.list_of(text), (0, ["z", "a", "b", "c"], ""))

    def test_what_cannot_be_read_is_refused(self):
        for text, place in (("a\n[run]\n", "packages.txt:1: a — a package before the first section"),
                            ("[run]\na\n[peers]\nb\n", "packages.txt:3: [peers] — no section"),
                            ("[run\na\n", "packages.txt:1: [run — no section"),
                            ("[run]\na b\n", "packages.txt:2: a b — more than one package"),
                            ("[run]\na\n[test]\na\n", "packages.txt:4: a — a package that stands in line 2")):
            with self.subTest(text):
                code, packages, told = self.list_of(text, "run")
                self.assertEqual(code, 1)
                self.assertEqual(packages, [])
                self.assertIn(place, told)

    def test_other_words_are_refused(self):
        for words in (["runn"], ["run", "build"], ["--all"]):
            code, packages, told = self.list_of("[run]\na\n", *words)
            self.assertEqual((code, packages), (2, []))
            self.assertIn("usage: scripts/setup", told)


if __name__ == "__main__":
    unittest.main()
