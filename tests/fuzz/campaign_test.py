"""What tests/fuzz/campaign.py makes of outputs and tables, without a fuzzer."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import campaign  # noqa: E402

OUTPUT = """INFO: seed corpus: files: 5
#6\tINITED cov: 410 ft: 600 corp: 5/2000b exec/s: 0 rss: 40Mb
#2048\tpulse  cov: 431 ft: 702 corp: 31/4Kb lim: 99 exec/s: 682 rss: 52Mb
"""


class Numbers(unittest.TestCase):
    def test_are_those_of_the_last_line_or_of_the_statistics(self):
        self.assertEqual(campaign.numbers_of(OUTPUT), {"executions": 2048, "edges": 431, "inputs": 31})
        ended = OUTPUT + "stat::number_of_executed_units: 3000\n"
        self.assertEqual(campaign.numbers_of(ended)["executions"], 3000)
        self.assertEqual(campaign.numbers_of("no such program"), {"executions": 0, "edges": 0, "inputs": 0})


class Finding(unittest.TestCase):
    def test_is_what_ended_the_search(self):
        self.assertTrue(campaign.has_finding("Test unit written to a/unit-crash-16\n"))
        self.assertFalse(campaign.has_finding("Test unit written to a/unit-slow-unit-16\n"))
        self.assertFalse(campaign.has_finding(OUTPUT))


class Targets(unittest.TestCase):
    def test_are_those_of_the_build(self):
        text = "gumcert_fuzz_target(a json MUTATOR json)\ngumcert_fuzz_target(b app SEEDS a)\n# gumcert_fuzz_target(c x)\n"
        self.assertEqual(campaign.targets_of(text), {"a": None, "b": "a"})

    def test_have_a_source_a_law_and_seeds(self):
        folder = campaign.ROOT / "tests/fuzz"
        targets = campaign.targets_of((folder / "targets.cmake").read_text())
        self.assertEqual(sorted(targets), sorted(path.name[:-11] for path in folder.glob("*_fuzzer.cpp")))
        for name, more in targets.items():
            self.assertTrue(campaign.law_of(name), name)
            self.assertTrue((folder / "corpus" / name).is_dir() or more, name)


class Page(unittest.TestCase):
    def test_adds_up_all_campaigns(self):
        with tempfile.TemporaryDirectory() as folder:
            table, page = pathlib.Path(folder) / "a.csv", pathlib.Path(folder) / "a.md"
            row = {"date": "2026-11-27", "commit": "c", "target": "unit", "seconds": 1800, "executions": 9000000,
                   "edges": 500, "inputs": 40, "findings": 0}
            campaign.append_rows(table, [row])
            campaign.append_rows(table, [{**row, "date": "2026-11-28", "edges": 510, "findings": 1}])
            campaign.write_page(table, page)
            line = next(line for line in page.read_text().splitlines() if line.startswith("| `unit`"))
        self.assertTrue(line.endswith("| 18 000 000 | 1.00 | 5 000 | 510 | 1 | 2026-11-28 | 5 |"), line)

    def test_in_the_tree_is_that_of_its_table(self):
        table, page = campaign.ROOT / "docs/fuzzing.csv", campaign.ROOT / "docs/fuzzing.md"
        with tempfile.TemporaryDirectory() as folder:
            made = pathlib.Path(folder) / "fuzzing.md"
            campaign.write_page(table, made)
            self.assertEqual(made.read_text(), page.read_text())


class Dictionary(unittest.TestCase):
    def test_has_the_keys_of_the_schemas(self):
        words = campaign.words_of(sorted((campaign.ROOT / "schemas").glob("*.json")))
        for word in ("inputs", "rotary_table", "certificate"):
            self.assertIn(word, words)


if __name__ == "__main__":
    unittest.main()
