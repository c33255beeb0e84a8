#!/usr/bin/env python3
"""Each law of the tree catches a breach that is planted for it, and lets a clean tree pass.

    planted_breaches_test.py CMAKE

Works on small trees in a temporary folder; the scanners, the layer table and the CMake functions are the real ones.
"""

import pathlib
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
        shutil.copy(ROOT / "cmake/gumcert_layers.cmake", self.root / "cmake")
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
        self.plant("engine/job/reader.h", "#pragma once\n#include <nlohmann/json_fwd.hpp>\n")
        self.plant("engine/job/reader.cpp", '#include "gum/coverage.h"\n')
        self.expect(self.scan(), 0)
        self.refused("engine/solver.cpp", '#include "engine/job/reader.h"\n', 1, "engine/job/reader.h of engine/job")

    def test_package_of_another_layer(self):
        self.refused("engine/adjustment.cpp", "#include <nlohmann/json.hpp>\n", 1,
                     "<nlohmann/json.hpp> is not among the third-party headers of engine")

    def test_package_name_is_compared_whole(self):
        self.refused("engine/adjustment.cpp", "#include <ceresque/ceres.h>\n", 1, "is not among the third-party headers")

    def test_package_that_stays_out_of_headers(self):
        self.refused("engine/adjustment.h", "#pragma once\n#include <ceres/problem.h>\n", 2, "stands in a header")

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

    def test_edge_that_is_not_in_the_table(self):
        self.expect(self.configure("gumcert_layer(engine USES gum/quantity gum)"), 1,
                    "engine: uses gum — the edge is not in cmake/gumcert_layers.cmake")

    def test_folder_that_is_no_layer(self):
        self.expect(self.configure("gumcert_layer(utils)"), 1, "utils: not a layer")

    def test_argument_that_is_not_known(self):
        self.expect(self.configure("gumcert_layer(gum NEEDS gum/quantity)"), 1, "NEEDS", "only USES, PUBLIC")

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
        law = law.replace("set(GUMCERT_EDGES_gum_quantity   text)", "set(GUMCERT_EDGES_gum_quantity text engine)")
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


if __name__ == "__main__":
    if len(sys.argv) > 1:
        CMAKE = sys.argv.pop(1)
    unittest.main()
