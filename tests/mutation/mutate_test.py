"""Where tests/mutation/mutate.py changes a source, and where it must not."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import mutate  # noqa: E402
import run_mutants  # noqa: E402


def changes(text):
    return [(mutant.what, mutate.applied(text, mutant)) for mutant in mutate.mutants_of(text)]


class Mutants(unittest.TestCase):
    def test_are_the_slips_of_a_writer(self):
        self.assertEqual(changes("return a <= b;"), [("< for <=", "return a < b;")])
        self.assertEqual(changes("x = a - b * c;"), [("+ for -", "x = a + b * c;"), ("/ for *", "x = a - b / c;")])
        self.assertEqual(changes("u += v;"), [("-= for +=", "u -= v;")])
        self.assertEqual(changes("y = std::sqrt(x);"), [("nothing for std::sqrt", "y = (x);")])
        self.assertEqual(changes("y = std::min(a, b);"), [("std::max for std::min", "y = std::max(a, b);")])
        self.assertEqual(changes("k = 0.5;"), [("0.75 for 0.5", "k = 0.75;")])
        self.assertEqual(changes("n = 0;"), [("1 for 0", "n = 1;")])
        self.assertEqual(changes("return -x;"), [("+ for the sign -", "return  x;")])
        self.assertEqual(changes("if (f(a)) {"), [("the opposite of the condition", "if (!(f(a))) {")])
        self.assertEqual(changes("if (a && b) {")[0][1], "if (!(a && b)) {")

    def test_leave_comments_texts_and_types_alone(self):
        for text in ("// a < b, 0.5", "/* a + b\n 1 */", '"a - b 2"', "#include <x.h>  // 1", "std::vector<int> a{};", "const T* p;",
                     "T&& x", "x2", "k_3", "a->b", "std::array<double, 3>", "'1'", "std::sqrt_of", 'R"(1 + 2)"'):
            with self.subTest(text):
                allowed = {"std::array<double, 3>": 1}.get(text, 0)  # told from an argument by no word: it does not compile
                self.assertEqual(len(changes(text)), allowed)

    def test_stand_on_their_line(self):
        self.assertEqual([mutant.line for mutant in mutate.mutants_of("a;\n\nb = c + d;")], [3])

    def test_are_found_in_real_sources_and_each_differs(self):
        for path in ("gum/coverage.cpp", "engine/adjustment.cpp", "certificate/statement_of_uncertainty.cpp"):
            text = (run_mutants.ROOT / path).read_text(encoding="utf-8")
            found = mutate.mutants_of(text)
            self.assertGreater(len(found), 20, path)
            self.assertTrue(all(mutate.applied(text, mutant) != text for mutant in found), path)


class Commands(unittest.TestCase):
    UNIT = ("/usr/bin/ccache /usr/bin/c++ -I/x -O2 -Werror -MD -MT a.o -MF a.o.d -o a.o -c /x/unity_0_cxx.cxx")
    LINK = (": && /usr/bin/c++ -O2 /x/first.o -Wl,--whole-archive /x/liba.a -Wl,--no-whole-archive t.o -o tests/test_unit_a "
            "liba.a && cd /x && /usr/bin/cmake -D TEST_TARGET=a -P found.cmake")

    def test_compile_one_source_in_place_of_a_unit(self):
        self.assertEqual(run_mutants.compile_command(self.UNIT, "m.cpp", "m.o"),
                         ["/usr/bin/c++", "-I/x", "-O2", "-w", "-o", "m.o", "-c", "m.cpp"])

    def test_link_it_before_all_others(self):
        self.assertEqual(run_mutants.link_command(self.LINK, "m.o", "m"),
                         ["/usr/bin/c++", "-O2", "-Wl,-z,muldefs", "m.o", "/x/first.o", "-Wl,--whole-archive", "/x/liba.a",
                          "-Wl,--no-whole-archive", "t.o", "-o", "m", "liba.a"])


class Tests(unittest.TestCase):
    def test_beside_a_source_are_asked_first(self):
        self.assertEqual(run_mutants.suites_beside("gum/no_such.cpp"), None)
        for path in run_mutants.sources(("gum/conformity",)):
            beside = run_mutants.ROOT / "tests/unit" / path.replace(".cpp", "_test.cpp")
            self.assertEqual(run_mutants.suites_beside(path) is not None, beside.exists(), path)

    def test_end_by_the_time_of_the_processor_alone(self):
        def ran(folder, text, seconds):
            program = pathlib.Path(folder) / "program"
            program.write_text(f"#!/bin/sh\n{text}\n")
            program.chmod(0o755)
            return campaign.run_test(program, seconds, None)[0]

        with tempfile.TemporaryDirectory() as folder:
            campaign = run_mutants.Campaign(pathlib.Path(folder), pathlib.Path(folder) / "mutants")
            (pathlib.Path(folder) / "tests").mkdir()
            self.assertEqual(ran(folder, "sleep 2; exit 0", 1), 0)
            self.assertEqual(ran(folder, "exit 3", 1), 3)
            self.assertEqual(ran(folder, "kill -SEGV $$", 1), -11)
            self.assertEqual(ran(folder, "while :; do :; done", 1), None)


class Page(unittest.TestCase):
    ROW = {"date": "2026-11-28", "commit": "c", "file": "gum/a.cpp", "line": "3", "change": "< for <=", "verdict": "survived",
           "judgement": ""}

    def test_counts_what_compiles_and_tells_what_survived(self):
        rows = [self.ROW, self.ROW | {"verdict": "killed by unit/gum"}, self.ROW | {"verdict": "does not compile"},
                self.ROW | {"judgement": "equivalent: a is never b"}]
        page = run_mutants.page_of(rows)
        self.assertIn("| `gum` | 3 | 1 | 2 | 1 | 50 % |", page)
        self.assertIn("| `gum/a.cpp:3` | < for <= | 2026-11-28 | not judged yet |", page)
        self.assertIn("equivalent: a is never b", page)

    def test_escapes_what_would_end_a_cell(self):
        page = run_mutants.page_of([self.ROW | {"change": "&& for ||"}])
        self.assertIn("&& for \\|\\|", page)


if __name__ == "__main__":
    unittest.main()
