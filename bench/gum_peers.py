#!/usr/bin/env python3
"""The gauge block of JCGM 101:2008, 9.5, by other programs: the peers of gum_bench.cpp.

    gum_peers.py [--repetitions N]

Monte Carlo with 10^6 trials, mean, standard deviation and shortest 99 % interval: with NumPy by hand, vectorised, and
with OpenTURNS. The law of propagation: with uncertainties, degrees of freedom by hand, because it has none, k from SciPy.
Prints JSON: for each way the wall times and processor times of all repetitions, in seconds, and what it found, in metre.
"""

import argparse
import json
import math
import sys
import time

import numpy as np
import openturns as ot
import scipy
from scipy import stats
import uncertainties

TRIALS = 1_000_000
PROBABILITY = 0.99
NOMINAL = 50e-3
STUDENT_T = {"L_s": (50000623e-9, 25e-9, 18), "D": (215e-9, 6e-9, 24), "d_1": (0.0, 4e-9, 5), "d_2": (0.0, 7e-9, 8)}
ALPHA_S = (9.5e-6, 13.5e-6)
THETA_0 = (-0.1, 0.2)
DELTA = 0.5
D_ALPHA = (1e-6, 0.1e-6)  # half-width, and by how much the limits are not known
D_THETA = (0.05, 0.025)


def length(l_s, d, d_1, d_2, alpha_s, theta_0, delta, d_alpha, d_theta):
    return l_s + d + d_1 + d_2 - l_s * (d_alpha * (theta_0 + delta) + alpha_s * d_theta) - NOMINAL


def shortest(ascending):
    inside = int(PROBABILITY * len(ascending) + 0.5)
    widths = ascending[inside:] - ascending[:len(ascending) - inside]
    begin = int(np.argmin(widths))
    return float(ascending[begin]), float(ascending[begin + inside])


def numpy_by_hand(seed):
    generator = np.random.default_rng(seed)

    def student_t(name):
        value, u, nu = STUDENT_T[name]
        return value + u * generator.standard_t(nu, TRIALS)

    def curvilinear_trapezoid(half_width, unknown):  # JCGM 101:2008, 6.4.3.4
        low = -half_width - unknown + 2.0 * unknown * generator.random(TRIALS)
        return low + (-2.0 * low) * generator.random(TRIALS)

    y = length(*(student_t(name) for name in STUDENT_T), generator.uniform(*ALPHA_S, TRIALS),
               generator.normal(*THETA_0, TRIALS), DELTA * np.cos(math.pi * generator.random(TRIALS)),
               curvilinear_trapezoid(*D_ALPHA), curvilinear_trapezoid(*D_THETA))
    mean, u = float(y.mean()), float(y.std(ddof=1))
    y.sort()
    low, high = shortest(y)
    return {"y": mean, "u": u, "low": low, "high": high}


def openturns_model():
    """OpenTURNS has no curvilinear trapezoid: its two uniform deviates are inputs, and the formula puts them together."""
    names = [*STUDENT_T, "alpha_s", "theta_0", "Delta", "r_1", "r_2", "r_3", "r_4"]
    marginals = [ot.Student(nu, value, u) for value, u, nu in STUDENT_T.values()]
    marginals += [ot.Uniform(*ALPHA_S), ot.Normal(*THETA_0), ot.Arcsine(-DELTA, DELTA)]
    marginals += [ot.Uniform(0.0, 1.0)] * 4

    def trapezoid(half_width, unknown, first, second):
        return f"(({-half_width - unknown!r} + {2.0 * unknown!r} * {first}) * (1 - 2 * {second}))"

    formula = (f"L_s + D + d_1 + d_2 - L_s * ({trapezoid(*D_ALPHA, 'r_1', 'r_2')} * (theta_0 + Delta) + "
               f"alpha_s * {trapezoid(*D_THETA, 'r_3', 'r_4')}) - {NOMINAL!r}")
    return ot.CompositeRandomVector(ot.SymbolicFunction(names, [formula]),
                                    ot.RandomVector(ot.ComposedDistribution(marginals)))


def openturns(vector, seed):
    ot.RandomGenerator.SetSeed(seed)
    sample = vector.getSample(TRIALS)
    mean, u = sample.computeMean()[0], sample.computeStandardDeviation()[0]
    low, high = shortest(np.asarray(sample.sort()).ravel())
    return {"y": mean, "u": u, "low": low, "high": high}


def by_uncertainties():
    def stated(value, u):
        return uncertainties.ufloat(value, u)

    inputs = [stated(value, u) for value, u, _ in STUDENT_T.values()]
    freedom = {variable: nu for variable, (_, _, nu) in zip(inputs, STUDENT_T.values())}
    inputs += [stated(sum(ALPHA_S) / 2.0, (ALPHA_S[1] - ALPHA_S[0]) / math.sqrt(12.0)), stated(*THETA_0),
               stated(0.0, DELTA / math.sqrt(2.0))]
    inputs += [stated(0.0, math.sqrt(half_width**2 / 3.0 + unknown**2 / 9.0)) for half_width, unknown in (D_ALPHA, D_THETA)]
    y = length(*inputs)
    u = y.std_dev
    sum_of_fourths = sum(part**4 / freedom[variable] for variable, part in y.error_components().items()
                         if variable in freedom)
    nu = u**4 / sum_of_fourths
    return {"y": y.nominal_value, "u": u, "degrees_of_freedom": nu,
            "U": float(stats.t.ppf(0.5 + PROBABILITY / 2.0, nu)) * u}


def timed(work, repetitions, calls=1):
    result = {"wall_s": [], "processor_s": []}
    for repetition in range(repetitions):
        wall, processor = time.perf_counter(), time.process_time()
        for _ in range(calls):
            found = work(repetition + 1)
        result["processor_s"].append((time.process_time() - processor) / calls)
        result["wall_s"].append((time.perf_counter() - wall) / calls)
    return {**result, "found": found}


def main():
    parser = argparse.ArgumentParser(description="Peers of the benchmark of the GUM engine")
    parser.add_argument("--repetitions", type=int, default=3)
    arguments = parser.parse_args()
    peers = {"numpy": timed(numpy_by_hand, arguments.repetitions)}
    for threads in (1, 2):
        ot.TBB.SetThreadsNumber(threads)
        vector = openturns_model()  # anew: a function keeps the number of threads that it was made for
        peers[f"openturns_{threads}"] = timed(lambda seed: openturns(vector, seed), arguments.repetitions)
    peers["uncertainties"] = timed(lambda _: by_uncertainties(), arguments.repetitions, calls=200)
    json.dump({"versions": {"NumPy": np.__version__, "SciPy": scipy.__version__, "OpenTURNS": ot.__version__,
                            "uncertainties": uncertainties.__version__}, "peers": peers}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
