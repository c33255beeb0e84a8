#!/usr/bin/env python3
"""Each law of the tree catches a breach that is planted for it, and lets a clean tree pass.

    planted_breaches_test.py CMAKE

Works on small trees in a temporary folder; the scanners, the layer table and the CMake functions are the real ones.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CMAKE = "cmake"


class PlantedTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="gumcert-planted-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def plant(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def run_program(self, *command):
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
        # CMake breaks the lines of a message where it likes.
        return done.returncode, " ".join((done.stdout + done.stderr).split())

    def expect(self, returned, code, *texts):
        self.assertEqual(returned[0], code, returned[1])
        for text in texts:
            self.assertIn(text, returned[1])


class Includes(PlantedTree):
    def setUp(self):
        super().setUp()
        (self.root / "cmake").mkdir()
        (self.root / "docs").mkdir()
        shutil.copy(ROOT / "cmake/gumcert_layers.cmake", self.root / "cmake")
        shutil.copy(ROOT / "docs/architecture.md", self.root / "docs")
        self.plant("gum/quantity/diagnostic.h", "#pragma once\n#include <string>\n")
        self.plant("gum/coverage.h", '#pragma once\n#include "gum/quantity/diagnostic.h"\n')
        self.plant("engine/adjustment.h", "#pragma once\n#include <Eigen/Core>\n")

    def scan(self, *options):
        return self.run_program(sys.executable, ROOT / "tests/lint/check_includes.py", self.root, *options)

    def refused(self, path, text, line, reason):
        self.plant(path, text)
        self.expect(self.scan(), 1, f"{path}:{line}: ", reason)

    def test_clean_tree_passes(self):
        self.plant("engine/adjustment.cpp", '#include "engine/adjustment.h"\n#include <ceres/ceres.h>\n')
        self.plant("app/cli/main.cpp", "#include <CLI/CLI.hpp>\n#include <iostream>\nint main() { std::cout << 1; }\n")
        self.expect(self.scan(), 0, "5 files checked, 0 breaches")

    def test_permission_that_nobody_uses(self):
        self.expect(self.scan("--no-spare-permissions"), 1,
                    "GUMCERT_EDGES_gum_expression: no file of gum/expression includes gum/quantity",
                    "GUMCERT_THIRD_PARTY_engine: no file of engine includes ceres",
                    "GUMCERT_MAY_TOUCH_FILES: no file of signing includes fstream or filesystem")
        code, text = self.scan("--no-spare-permissions")
        for used in ("no file of gum includes gum/quantity", "no file of engine includes Eigen"):
            self.assertNotIn(used, text)

    def test_document_that_names_other_layers(self):
        document = self.root / "docs/architecture.md"
        text = document.read_text(encoding="utf-8")
        row = next(line for line in text.split("\n") if line.startswith("| `gum/monte_carlo` | `"))
        for planted, reason in ((row.replace(", `gum` |", " |"), "gum/monte_carlo uses gum, as"),
                                (row.replace(", `gum` |", ", `gum`, `engine` |"), "gum/monte_carlo does not use engine, as"),
                                ("", "the table has no row of gum/monte_carlo"),
                                (row.replace("`gum/monte_carlo`", "`gum/roulette`"), "gum/roulette is no layer of")):
            self.assertNotEqual(planted, row)
            document.write_text(text.replace(row, planted), encoding="utf-8")
            self.expect(self.scan(), 1, "docs/architecture.md:", reason)
        document.unlink()
        self.expect(self.scan(), 1, "the table has no row of text")

    def test_tree_without_sources_is_not_clean(self):
        for folder in ("gum", "engine"):
            shutil.rmtree(self.root / folder)
        self.expect(self.scan(), 1, "no source found")

    def test_edge_that_is_not_in_the_table(self):
        self.refused("engine/adjustment.cpp", '#include "engine/adjustment.h"\n#include "gum/coverage.h"\n', 2,
                     "engine includes gum/coverage.h of gum — allowed are: text, gum/quantity")

    def test_edge_upwards(self):
        self.refused("gum/quantity/diagnostic.cpp", '\n\n#include "engine/adjustment.h"\n', 3, "allowed are: text")

    def test_longest_prefix_decides_the_layer(self):
        self.plant("jobs/reader.h", "#pragma once\n#include <nlohmann/json_fwd.hpp>\n")
        self.plant("jobs/reader.cpp", '#include "gum/coverage.h"\n')
        self.expect(self.scan(), 0)
        self.refused("engine/solver.cpp", '#include "jobs/reader.h"\n', 1, "jobs/reader.h of jobs")

    def test_package_of_another_layer(self):
        self.refused("engine/adjustment.cpp", "#include <nlohmann/json.hpp>\n", 1,
                     "<nlohmann/json.hpp> is not among the third-party headers of engine")

    def test_package_name_is_compared_whole(self):
        self.refused("engine/adjustment.cpp", "#include <ceresque/ceres.h>\n", 1, "is not among the third-party headers")

    def test_package_that_stays_out_of_headers(self):
        self.refused("engine/adjustment.h", "#pragma once\n#include <ceres/problem.h>\n", 2, "stands in a header")

    def test_package_that_stands_in_one_header_only(self):
        self.plant("gum/quantity/dense_factors.h", "#pragma once\n#include <Eigen/SVD>\n")
        self.expect(self.scan(), 0)
        self.refused("engine/datum.cpp", "#include <Eigen/SVD>\n", 1, "include gum/quantity/dense_factors.h in its place")

    def test_include_in_a_comment_does_not_count(self):
        self.plant("gum/coverage.cpp", '/*\n#include "engine/adjustment.h"\n*/ // std::cout << 1\n')
        self.expect(self.scan(), 0)

    def test_own_header_that_is_missing(self):
        self.refused("gum/coverage.cpp", '#include "gum/quantity/lost.h"\n', 1, "does not exist")

    def test_own_header_relative_to_its_folder(self):
        self.refused("gum/coverage.cpp", '#include "coverage.h"\n', 1, "is in no layer")

    def test_file_that_the_build_does_not_read(self):
        self.refused("gum/details/tables.cpp", "int n;\n", 1, "lies in a folder below gum")

    def test_files_in_a_layer_without_files(self):
        self.refused("gum/coverage.cpp", "#include <fstream>\n", 1, "gum does not touch files")

    def test_calls_that_a_library_does_not_make(self):
        for number, call in enumerate([
                'std::cout << 1;', 'std::cerr << 1;', 'std::printf("x");', 'std::exit(1);', 'exit(1);', '::abort();',
                'std::abort();', 'std::getenv("HOME");', 'std::setlocale(LC_ALL, "");', 'std::strtod(s, &e);',
                'std::stod(s);', 'std::atof(s);', 'std::snprintf(b, 9, "%g", x);', 'std::chrono::system_clock::now();',
                'std::time(nullptr);', 'auto t = std::chrono::steady_clock::now();']):
            with self.subTest(call=call):
                self.refused("gum/planted.cpp", f"void f() {{\n    {call}\n}}\n", 2, "gum/planted.cpp:2: ")

    def test_words_that_look_like_calls(self):
        self.plant("gum/planted.cpp", 'const char* s = "exit(1) std::cout"; // abort()\n'
                                      "double digits = 1'000.0; void f() { path.exit(1); next_time(0); }\n")
        self.expect(self.scan(), 0)


class LayerFunction(PlantedTree):
    def configure(self, layer_line, languages="NONE"):
        (self.root / "cmake").mkdir(exist_ok=True)
        self.plant("CMakeLists.txt", f"""
cmake_minimum_required(VERSION 3.25)
project(planted LANGUAGES {languages})
add_library(gumcert_compile_options INTERFACE)
include({ROOT.as_posix()}/cmake/gumcert_layers.cmake)
include({ROOT.as_posix()}/cmake/gumcert_header_self_check.cmake)
{layer_line}
""")
        return self.run_program(CMAKE, "-S", self.root, "-B", self.root / "build")

    def test_folder_that_is_no_layer(self):
        self.expect(self.configure("gumcert_layer(utils)"), 1, "utils: not a layer")

    def test_argument_that_is_not_known(self):
        self.expect(self.configure("gumcert_layer(gum NEEDS gum/quantity)"), 1, "NEEDS", "only WORDS, MATRICES, FILES_AS_ONE, PUBLIC")

    def refused_build(self, expected):
        self.expect(self.configure("gumcert_layer(gum/quantity)\ngumcert_header_self_check()", "CXX"), 0)
        returned = self.run_program(CMAKE, "--build", self.root / "build")
        self.assertNotEqual(returned[0], 0)
        self.assertIn(expected, returned[1])

    def test_header_that_does_not_compile_alone(self):
        layers = "gumcert_layer(gum/quantity)\ngumcert_header_self_check()"
        self.plant("gum/quantity/alone.cpp", '#include "gum/quantity/alone.h"\n')
        self.plant("gum/quantity/alone.h", "#pragma once\n#include <string>\nstd::string text();\n")
        self.expect(self.configure(layers, "CXX"), 0)
        self.expect(self.run_program(CMAKE, "--build", self.root / "build"), 0)
        self.plant("gum/quantity/alone.h", "#pragma once\nstd::vector<double> leans_on_its_neighbours();\n")
        self.plant("gum/quantity/alone.cpp", '#include <vector>\n#include "gum/quantity/alone.h"\n')
        self.refused_build("gum/quantity/alone.h:2")

    def test_header_that_does_not_compile_in_its_own_source(self):
        self.plant("gum/quantity/alone.cpp", '#include "gum/quantity/alone.h"\n#include <vector>\n')
        self.plant("gum/quantity/alone.h", "#pragma once\nstd::vector<double> leans_on_its_neighbours();\n")
        self.refused_build("gum/quantity/alone.h:2")

    def test_header_without_guard(self):
        self.plant("gum/quantity/twice.cpp", '#include "gum/quantity/twice.h"\n')
        self.plant("gum/quantity/twice.h", "struct Twice {};\n")
        self.refused_build("redefinition of")


class LayerTable(PlantedTree):
    def test_table_with_a_cycle(self):
        law = (ROOT / "cmake/gumcert_layers.cmake").read_text(encoding="utf-8")
        law, count = re.subn(r"set\(GUMCERT_EDGES_gum_quantity +text\)", "set(GUMCERT_EDGES_gum_quantity text engine)", law)
        self.assertEqual(count, 1)
        self.plant("law.cmake", law)
        self.expect(self.run_program(CMAKE, "-P", self.root / "law.cmake"), 1,
                    "gum/quantity: may use engine — an edge points to a layer below")


class CompilerFlags(PlantedTree):
    def configure(self, flags):
        self.plant("CMakeLists.txt", f"""
cmake_minimum_required(VERSION 3.25)
project(planted LANGUAGES NONE)
include({ROOT.as_posix()}/cmake/gumcert_compiler.cmake)
""")
        return self.run_program(CMAKE, "-S", self.root, "-B", self.root / "build", f"-DCMAKE_CXX_FLAGS={flags}")

    def test_flags_that_change_digits(self):
        for flag in ("-march=native", "-ffast-math", "-Ofast"):
            with self.subTest(flag=flag):
                self.expect(self.configure(f"-g {flag}"), 1, f"compiler flags: {flag}")
        self.expect(self.configure("-g -O2"), 0)


class Tree(PlantedTree):
    def scan(self):
        return self.run_program(sys.executable, ROOT / "tests/lint/check_tree.py", self.root)

    def test_clean_tree_passes(self):
        self.plant("gum/a.cpp", "// see docs/home/page.md and /usr/share; TO" "DO(#12) is allowed\n")
        self.expect(self.scan(), 0, "1 files checked, 0 breaches")

    def test_breaches(self):
        for path, text, reason in [
                ("scripts/run", "#!/bin/sh\ncd /ho" "me/someone/tree\n", "a path of one machine"),
                ("gum/a.cpp", "\n// TO" "DO: later\n", "without the number of an issue"),
                ("gum/a.cpp", "\nint a;\r\n", "CR LF"),
                ("gum/a.h", "\n/// A value. \\param x  of what\n", "a doc tag inside a line of text"),
                ("package-lock.json", "{\n\"resolved\": " "\"https://example.org/a.tgz\"}", "a package registry"),
                (".npmrc", "\nregistry " "= https://example.org\n", "a package registry"),
                ("docs/a.md", "\nsee [b](b.md#c) and [d](https://example.org)\n", "links to b.md, which does not exist"),
                ("docs/a.md", "\n<<<<" "<<< ours\n", "conflict mark")]:
            with self.subTest(path=path, reason=reason):
                self.plant(path, text)
                self.expect(self.scan(), 1, f"{path}:2: ", reason)
                (self.root / path).unlink()

    def test_counts_have_two_forms(self):
        for text in ('print("{} entries", n);', 'a = std::to_string(list.size()) +\n  " entries";', 'a = "{} more places";',
                     'a = std::to_string(at(n)) + " earlier heads";'):
            self.plant("archive/a.cpp", "\n" + text + "\n")
            self.expect(self.scan(), 1, "archive/a.cpp:2: ", "use text::count_of()")
        for text in ('print("{} of {} records", n, m);', 'a = std::to_string(n) + " of " + std::to_string(m) + " records";',
                     'a = "entry " + std::to_string(n) + " names it";', 'a = text::count_of(n, "entry");'):
            self.plant("archive/a.cpp", text + "\n")
            self.expect(self.scan(), 0)
        # Refusals of readers are read there, too; a limit is never one.
        self.plant("jobs/a.cpp", '\na = std::to_string(rows) + " rows";\n')
        self.expect(self.scan(), 1, "jobs/a.cpp:2: ", "use text::count_of()")
        self.plant("jobs/a.cpp", '\na = std::to_string(k_most_rows) + " rows, as " + std::to_string(n) + " rows and columns";\n')
        self.expect(self.scan(), 0)

    def test_memory_that_ends_blames_no_file(self):
        handler = "    }} catch (const {}&) {{\n        a();\n"
        others = handler.format("std::exception")
        self.plant("imports/a.cpp", "try {\n        b();\n" + others + "    }\n")
        self.expect(self.scan(), 1, "imports/a.cpp:3: ", "let std::bad_alloc through")
        self.plant("imports/a.cpp", "    try {\n        b();\n" + handler.format("std::bad_alloc") + others + "    }\n")
        self.expect(self.scan(), 0)

    def test_header_of_the_domain_without_a_test_by_its_name(self):
        declared = "namespace n {\n/// A sum; (of two).\n[[nodiscard]] double sum(double a, double b);\n}\n"
        for path, text in [
                ("gum/sums.h", declared),
                ("engine/rotary_table/trials/sums.h", declared),
                ("audit/rules/sums.h", declared),
                ("json/sums.h", declared),
                ("laboratory/sums.h", declared),
                ("system/sums.h", declared),
                ("text/sums.h", "inline int twice(int a) {\n    return 2 * a;\n}\n"),
                ("certificate/sums.h", "class Sum {\npublic:\n    void add(double a);\n    int n() const { return n_; }\n"
                                       "private:\n    int n_ = 0;\n};\n")]:
            with self.subTest(path=path):
                test = f"tests/unit/{path[:-2]}_test.cpp"
                self.plant(path, text)
                self.expect(self.scan(), 1, f"{path}:1: declares functions, and there is no {test}")
                self.plant("tests/unit/" + path.split("/")[-1][:-2] + "_test.cpp", "")  # in another folder
                self.expect(self.scan(), 1, f"{path}:1: ")
                self.plant(test, "")
                self.expect(self.scan(), 0)

    def test_headers_around_the_domain_are_listed_where_they_have_no_test(self):
        header, listed, test = "app/a.h", "tests/lint/untested_headers.txt", "tests/unit/app/a_test.cpp"
        self.plant(header, "int f();\n")
        self.expect(self.scan(), 1, f"{header}:1: declares functions, and there is no {test}")
        self.plant(listed, header + "\n")
        self.expect(self.scan(), 0)
        self.plant(test, "")
        self.expect(self.scan(), 1, f"take it off {listed}")
        self.plant(listed, "app/b.h\n")
        self.expect(self.scan(), 1, "app/b.h:1: is not there any more")
        self.plant(listed, "")
        self.expect(self.scan(), 0)

    def test_headers_that_need_no_test_by_their_name(self):
        for path, text in [
                ("gum/data.h", "struct Data {\n    double a = f(1);  ///< g(a);\n    bool both() const { return a > 0; }\n"
                               "    friend bool operator==(const Data&, const Data&) = default;\n};\n"),
                ("gum/constants.h", "namespace n {\ninline constexpr double k_a = limit(2.0);\n"
                                    "using Progress = std::function<void(const int&)>;\nenum class E { a, b };\n}\n"),
                ("gum/macro.h", "#define PLUS(a) \\\n    plus(a);\nint n;\n"),
                ("gum/templates.h", "template <class A>\nvoid describe(A& a) {\n    a(1);\n}\n"),
                ("gum/private.h", "int f();\n"),
                ("jobs/reader.h", "int f();\n"),
                ("reports/view.h", "int f();\n"),
                ("templates/view.h", "int f();\n"),
                ("tests/lint/untested_headers.txt", "jobs/reader.h\nreports/view.h\n")]:
            self.plant(path, text)
        self.plant("cmake/gumcert_layers.cmake", "set(GUMCERT_PRIVATE_HEADERS gum/private.h\n    gum/b.h)\n")
        self.expect(self.scan(), 0, "0 breaches")

    def test_layer_of_too_many_units(self):
        self.plant("cmake/gumcert_layers.cmake", "set(GUMCERT_LAYER_FOLDERS text reports)\n")
        for i in range(25):
            self.plant(f"reports/unit_{i}.h", "int a;\n")
            self.plant(f"reports/unit_{i}.cpp", "int a;\n")
        self.expect(self.scan(), 0, "0 breaches")
        self.plant("reports/deeper/unit.cpp", "int a;\n")  # another layer, or none
        self.expect(self.scan(), 0, "0 breaches")
        self.plant("reports/one_more.cpp", "int a;\n")
        self.expect(self.scan(), 1, "reports: 26 units; a layer has at most 25")


class Codes(PlantedTree):
    """A tree of one message, and of one code in a table."""

    SOURCE = ('#include <string>\n// GC-TREE-0001\n'
              'void fail(std::string code, std::string what, std::string rule) {\n'
              '    throw InputError({code, "", what, rule, ""});\n}\n'
              'void f() {\n    fail("GC-TREE-0001", "it is " "wrong", "it is right");\n}\n')
    TABLE = ('inline constexpr InputCode k_one{"GC-TREE-0002", "a key"};\n'
             'inline constexpr std::array k_all_codes{k_one};\n'
             'void g(List& list) {\n    list.refuse(k_one, "here", "bad", "good", "mend");\n}\n')

    def setUp(self):
        super().setUp()
        self.plant("gum/a.cpp", self.SOURCE)
        self.plant("jobs/b.cpp", self.TABLE)
        self.plant("docs/findings.md", "| id | clause | severity | what |\n|---|---|---|---|\n| A01 | 7.1 | major | x |\n")
        texts = {"cause": "A cause.", "remedy": "A remedy."}
        self.register = {
            "language": "en",
            "outcomes": {"refused": {"severity": "error", "text": "Refused."},
                         "warning": {"severity": "warning", "text": "Warned."}},
            "finding": "A finding.",
            "families": {"GC-TREE": {"title": "Tree", "text": "Of the tree."}},
            "codes": {"GC-TREE-0001": {"outcome": ["refused"], "meaning": "It is wrong.", **texts},
                      "GC-TREE-0002": {"outcome": ["refused"], "meaning": "A key.", **texts},
                      "GC-TREE-0009": {"retired": "It was something else."}}}
        self.write()
        self.expect(self.scan("--write"), 0, "3 codes, 0 breaches")
        self.register = json.loads((self.root / "templates/messages.json").read_text(encoding="utf-8"))

    def write(self):
        self.plant("templates/messages.json", json.dumps(self.register))

    def scan(self, *arguments):
        return self.run_program(sys.executable, "-B", ROOT / "tests/lint/check_codes.py", self.root, *arguments)

    def refused(self, *texts):
        self.expect(self.scan(), 1, *texts)

    def refused_entry(self, code, changes, *texts):
        self.register["codes"][code].update(changes)
        self.write()
        self.refused(*texts)

    def test_clean_tree_passes(self):
        self.expect(self.scan(), 0, "3 codes, 0 breaches")
        self.assertEqual(self.register["codes"]["GC-TREE-0001"]["rules"], ["it is right"])
        self.assertIn("### GC-TREE-0001", (self.root / "docs/messages.md").read_text(encoding="utf-8"))

    def test_code_that_is_not_in_the_register(self):
        self.plant("gum/c.cpp", '\nvoid h() { fail("GC-TREE-0003", "a", "b"); }\n')
        self.refused("gum/c.cpp:2: GC-TREE-0003 is not in templates/messages.json")

    def test_code_inside_a_longer_text(self):
        self.plant("gum/c.cpp", 'const char* k = "{\\"code\\":\\"GC-TREE-0003\\"}";\n')
        self.refused("gum/c.cpp:1: GC-TREE-0003 is not in templates/messages.json")

    def test_code_of_a_table_that_is_not_in_the_register(self):
        self.plant("jobs/c.h", 'inline constexpr InputCode k_two{"GC-TREE-0003", "another key"};\n')
        self.refused("k_two: GC-TREE-0003 is not in templates/messages.json", "no source uses the constant")

    def test_retired_code_that_is_made_again(self):
        self.plant("gum/c.cpp", 'void h() { fail("GC-TREE-0009", "a", "b"); }\n')
        self.refused("gum/c.cpp:1: GC-TREE-0009 is retired and never given again")

    def test_code_that_no_source_makes(self):
        self.register["codes"]["GC-TREE-0004"] = dict(self.register["codes"]["GC-TREE-0002"], meaning="Nothing.")
        self.write()
        self.refused("codes/GC-TREE-0004: no source makes it")

    def test_code_that_is_only_asked_for(self):
        self.plant("gum/a.cpp", 'bool f(D d) { return d.code == "GC-TREE-0001"; }\n')
        self.refused("codes/GC-TREE-0001: no source makes it")

    def test_code_with_a_second_rule(self):
        self.plant("gum/c.cpp", 'void h() {\n    fail("GC-TREE-0001", "b", "it is " "left");\n}\n')
        self.refused("gum/c.cpp:2: GC-TREE-0001 states “it is left”", "a code has one meaning")
        # --write takes no decision: a person lists the second rule, or gives a code of its own.
        self.expect(self.scan("--write"), 1, "GC-TREE-0001 states “it is left”")
        self.refused_entry("GC-TREE-0001", {"rules": ["it is right", "it is left"]}, "docs/messages.md: not what")
        self.expect(self.scan("--write"), 0, "0 breaches")

    def test_rule_by_every_way_that_sources_have(self):
        for text in ['Diagnostic d{"GC-TREE-0001", "a", "b", "it is left", "c"};',
                     'Diagnostic d{.code = "GC-TREE-0001", .rule = std::string("it is ") + "left", .action = "c"};',
                     'void h() { const std::string rule = "it is left"; fail("GC-TREE-0001", "b", rule); }',
                     'const char* k_rule = "it is left"; void h() { fail("GC-TREE-0001", "b", k_rule); }',
                     'void m(S rule) { fail("GC-TREE-0001", "b", rule); } void h() { m("it is left"); }',
                     'void h(bool c) { fail("GC-TREE-0001", "b", c ? "it is right" : "it is left"); }']:
            with self.subTest(text=text):
                self.plant("gum/a.cpp", self.SOURCE + text + "\n")
                self.refused("GC-TREE-0001 states “it is left”")

    def test_rule_that_no_source_states(self):
        self.refused_entry("GC-TREE-0001", {"rules": ["it is right", "it is up"]}, "no source states “it is up”")

    def test_code_of_a_table_that_is_written_again(self):
        self.plant("gum/c.cpp", 'void h() {\n    fail("GC-TREE-0002", "a", "b");\n}\n')
        self.refused("gum/c.cpp:2: GC-TREE-0002 is written a second time; use the constant k_one")

    def test_two_constants_of_one_code(self):
        self.plant("jobs/c.h", 'inline constexpr InputCode k_two{"GC-TREE-0002", "a key"};\n')
        self.refused("k_one and k_two: two constants of GC-TREE-0002")

    def test_severity_that_the_source_does_not_have(self):
        self.plant("gum/c.cpp", 'Diagnostic d{"GC-TREE-0001", "a", "b", "it is right", "c", Severity::warning};\n')
        self.refused("gum/c.cpp:1: GC-TREE-0001 is of severity warning")

    def test_failure_that_the_source_does_not_have(self):
        self.plant("gum/c.cpp", 'void h() { throw NoResultError(Diagnostic{"GC-TREE-0001", "", "b", "it is right", ""}); }\n')
        self.refused("gum/c.cpp:1: GC-TREE-0001 ends as no_result")

    def test_finding_that_the_source_does_not_make(self):
        self.refused_entry("GC-TREE-0001", {"finding": {"id": "A01", "severity": "minor"}}, "docs/findings.md says “major”")
        self.plant("gum/c.cpp", 'Table t{{"GC-TREE-0001", "A02", "7.1"}};\n')
        self.refused("the sources make it the finding A02")

    def test_comment_and_document_that_name_no_code(self):
        self.plant("gum/c.cpp", "// throws GC-TREE-0005\n")
        self.plant("docs/a.md", "\nsee GC-TREE-0006\n")
        self.refused("gum/c.cpp:1: names GC-TREE-0005", "docs/a.md:2: names GC-TREE-0006")

    def test_texts_that_say_nothing(self):
        for key, text in [("meaning", ""), ("cause", "no capital letter."), ("remedy", "No full stop"),
                          ("meaning", "L" * 130 + "."), ("outcome", ["lost"])]:
            with self.subTest(key=key, text=text):
                before = dict(self.register["codes"]["GC-TREE-0001"])
                self.refused_entry("GC-TREE-0001", {key: text}, "codes/GC-TREE-0001/" + key)
                self.register["codes"]["GC-TREE-0001"] = before

    def test_two_codes_of_one_meaning(self):
        self.refused_entry("GC-TREE-0001", {"meaning": "A key."}, "codes/GC-TREE-0002/meaning: the same as that of GC-TREE-0001")

    def test_document_that_was_edited(self):
        self.plant("docs/messages.md", "# Messages\n")
        self.refused("docs/messages.md: not what templates/messages.json gives")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        CMAKE = sys.argv.pop(1)
    unittest.main()
