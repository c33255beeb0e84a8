"""The entries of ctest that tests/suites_of_program.cmake writes: one of each suite, and none hides a failure.

usage: suites_test.py CMAKE CTEST
"""
import pathlib
import subprocess
import sys
import tempfile

# What gtest lists, and the end of what it prints for a suite of each kind.
PROGRAM = r"""#!/bin/sh
skipped='[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] Suite.Test'
case $1 in
--gtest_list_tests) printf 'Running main() from gtest_main.cc\nGood.\n  A\nSkips.\n  A\nFails.\n  A\nBoth.\n  A\nDies.\n  A\n'
    printf 'Values/Param/0.  # TypeParam = int\n  A/0  # GetParam() = 1\n' ;;
--gtest_filter=Good.\*|--gtest_filter=Values/Param/0.\*) echo '[  PASSED  ] 1 test.' ;;
--gtest_filter=Skips.\*) printf '[  PASSED  ] 0 tests.\n%s\n' "$skipped" ;;
--gtest_filter=Fails.\*) printf '[  FAILED  ] Fails.A\n\n 1 FAILED TEST\n'; exit 1 ;;
--gtest_filter=Both.\*) printf '%s\n[  FAILED  ] Both.B\n\n 1 FAILED TEST\n' "$skipped"; exit 1 ;;
--gtest_filter=Dies.\*) printf '[  SKIPPED ] Dies.A (0 ms)\n'; kill -ABRT $$ ;;
*) echo "not a suite: $1"; exit 1 ;;
esac
"""
WANTED = {"Good": "Passed", "Skips": "Skipped", "Fails": "Failed", "Both": "Failed", "Dies": "Exception",
          "Values/Param/0": "Passed"}


def main(cmake, ctest):
    script = pathlib.Path(__file__).resolve().parents[1] / "suites_of_program.cmake"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        program = folder / "program"
        program.write_text(PROGRAM, encoding="utf-8")
        program.chmod(0o755)

        def entries():
            return subprocess.run([cmake, f"-DPROGRAM={program}", "-DFOLDER=unit/x", f"-DFILE={folder}/CTestTestfile.cmake",
                                   "-P", script], capture_output=True, text=True)

        assert entries().returncode == 0
        said = subprocess.run([ctest, "--test-dir", folder], capture_output=True, text=True).stdout
        lines = [line for line in said.splitlines() if " Test " in line and "unit/x/" in line]
        for suite, wanted in WANTED.items():
            of_suite = [line for line in lines if f"unit/x/{suite} " in line]
            assert len(of_suite) == 1 and wanted in of_suite[0], f"{suite}: {of_suite}, expected {wanted}\n{said}"
        assert len(lines) == len(WANTED), said
        program.write_text("#!/bin/sh\necho nothing\n", encoding="utf-8")
        assert entries().returncode != 0, "a program without suites is refused"
        program.write_text("#!/bin/sh\necho A.\nexit 1\n", encoding="utf-8")
        assert entries().returncode != 0, "a program that cannot list its tests is refused"


if __name__ == "__main__":
    main(*sys.argv[1:])
