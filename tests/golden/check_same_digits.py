#!/usr/bin/env python3
"""Records and documents do not depend on what the processor can do (ADR 0058).

1. The program takes no elementary function from the C library, neither of double nor of extended precision: those differ
   between processors. What it may take is exact everywhere, such as floor and sqrt. It holds no instruction of its own that
   rounds otherwise: no fused multiply-add, and none of the elementary functions of x87, which differ between makers.
2. No evaluation calls a routine of BLAS, LAPACK or SuiteSparse, which differ between machines.
3. Examples have the same bytes on each path through the C library that this processor can take: with and without FMA
   (GLIBC_TUNABLES). Where it has one path only, the exit code is 77.

--every compares all examples of check_golden.py in all their forms, instead of a selection.
"""

import argparse
import concurrent.futures
import hashlib
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import check_golden

EXACT = set("""ceil copysign fabs fdim floor fmax fmin fmod frexp ilogb ldexp llrint llround logb lrint lround modf nan
nearbyint nextafter nexttoward remainder remquo rint round scalbln scalbn sqrt trunc""".split())
ELEMENTARY = set("""acos acosh asin asinh atan atan2 atanh cbrt cos cosh erf erfc exp exp10 exp2 expm1 fma gamma hypot j0 j1
jn lgamma lgamma_r log log10 log1p log2 pow sin sincos sinh tan tanh tgamma y0 y1 yn cabs cacos cacosh carg casin casinh catan
catanh ccos ccosh cexp clog clog10 cpow csin csinh csqrt ctan ctanh""".split())
PATHS = ("glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX")
INSTRUCTIONS = re.compile(r"\t(vfn?m(?:add|sub)\w*|f2xm1|fyl2x(?:p1)?|fsin|fcos|fsincos|fptan|fpatan)\b")
BLAS = re.compile(r"binding file (\S+) \[\d+\] to (\S*/lib(?:blas|cblas|f77blas|atlas|openblas\w*|lapack|cholmod|spqr|cxsparse)"
                  r"\.so\S*) .*symbol .(\w+)'")
SELECTED = {"end_gauge/job.json", "multimeter/job.json", "resistance_and_reactance/job.json", "certificate/end_gauge.json",
            "rotary_table/job_with_reference_budget.json", "circle_closure/indexing_tables.json", "comparison/methods.json",
            "everyday/torque_wrench/job.json", "everyday/multimeter/job.json"}


def taken_from_the_c_library(program: str) -> list[str]:
    symbols = subprocess.run(["nm", "-D", "--undefined-only", program], capture_output=True, text=True, check=True).stdout
    names = {line.split()[-1].split("@")[0] for line in symbols.splitlines() if line}
    if not names & EXACT:
        raise RuntimeError(f"{program}: takes nothing at all from the C library?")
    return sorted(name for name in names if re.sub(r"[fl]$", "", name) in ELEMENTARY or name in ELEMENTARY
                  or (name.startswith("__") and name.strip("_").removesuffix("_finite") in ELEMENTARY))


def instructions(program: str) -> list[str]:
    """Of the program itself; its libraries have their own."""
    with subprocess.Popen(["objdump", "--disassemble", "--no-show-raw-insn", program], stdout=subprocess.PIPE, text=True) as dump:
        return sorted({found.group(1) for line in dump.stdout for found in INSTRUCTIONS.finditer(line)})


def routines_of_blas(program: str) -> list[str]:
    """What the dynamic linker binds of them to the program while a rotary table, the largest adjustment, is evaluated."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([program, "evaluate", "examples/rotary_table/job.json", "-o", f"{folder}/record.json", "--quiet"],
                              env={**os.environ, "LD_DEBUG": "bindings"}, cwd=check_golden.SOURCE,
                              capture_output=True, text=True, check=False)
    if "binding file" not in done.stderr:
        raise RuntimeError("the dynamic linker does not say what it binds")
    return sorted({f"{name} of {Path(library).name}" for file, library, name in BLAS.findall(done.stderr)
                   if Path(file).name == Path(program).name})


def last_bits(tunables: str) -> str:
    """Elementary functions of the C library on a path, as Python asks it for them."""
    code = ("import math\nfor i in range(1, 20001):\n x = i * 0.37 + 1.0 / i\n"
            " print(math.sin(x).hex(), math.exp(-x / 500).hex(), math.pow(x, 0.3).hex())")
    return digest(subprocess.run([sys.executable, "-c", code], env={**os.environ, "GLIBC_TUNABLES": tunables},
                                 capture_output=True, check=True).stdout)


def digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def results(program: check_golden.Program, every: bool, tunables: str) -> dict[str, list[str]]:
    os.environ["GLIBC_TUNABLES"] = tunables
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        tasks = [pool.submit(program.evaluated, job, *(documents if every else documents[:1]))
                 for job, *documents in check_golden.EVALUATED if every or job in SELECTED]
        tasks += [pool.submit(program.study, *study) for study in check_golden.STUDIES if every]
        return dict(pair for task in tasks for pair in task.result())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, help="the gumcert to ask")
    parser.add_argument("--every", action="store_true", help="all examples on all paths")
    chosen = parser.parse_args()
    faults = [f"{name} is taken from the C library" for name in taken_from_the_c_library(chosen.program)]
    faults += [f"{name} is an instruction of the program" for name in instructions(chosen.program)]
    faults += [f"{name} is called" for name in routines_of_blas(chosen.program)]
    if faults:
        print("same digits:", "\nsame digits: ".join(faults))
        return 1

    own = last_bits("")
    others = [path for path in PATHS if last_bits(path) != own]
    if not others:
        print("same digits: this processor has one path through the C library only; nothing to compare")
        return 77
    program = check_golden.Program(chosen.program, None)
    expected = results(program, chosen.every, "")
    for path in others if chosen.every else others[:1]:
        found = results(program, chosen.every, path)
        differing = sorted(name for name in expected if found.get(name) != expected[name])
        if differing:
            print(f"same digits: with {path}: other bytes in {', '.join(differing)}")
            return 1
    print(f"same digits: {len(expected)} records and documents have the same bytes on "
          f"{len(others if chosen.every else others[:1]) + 1} paths")
    return 0


if __name__ == "__main__":
    sys.exit(main())
