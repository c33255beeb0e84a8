#!/usr/bin/env python3
"""The joint adjustment of a rotary table with NumPy and SciPy: the peer of rotary_table_benchmark.cpp.

    scipy_rotary_table.py CAMPAIGN.csv [RESULT.json] [--repetitions N]

CAMPAIGN.csv is written by the benchmark program (--write-campaign): observations, standard uncertainties, start values
and the program's own solution, all in metre and radian. RESULT.json is what it measured (--benchmark_format=json, with
the times of every repetition). Solves the same least-squares problem by three ways, checks that all agree with the
program to 1e-3 of a standard uncertainty and that the standard uncertainties agree to 1e-6, and prints one Markdown
table of times and ratios. Exits with 1 when they do not agree.

Model:  P = E R(θ) p,  E = Trans(d) Rz(c) Ry(b) Rx(a),  |P - q| = l + l0,  E = identity at the first angle, which is home,
and pseudo-observations of the coordinates p. The rotation R(θ) is about x. No set-up: it is found afterwards, when the
error motions are carried to the axis average line.
"""

import argparse
import csv
import json
import statistics
import sys
import time
import warnings

import numpy as np
from scipy import optimize


def read(name):
    """The campaign: kind → array of value and array of standard uncertainty, indexed by i, j, k."""
    rows = {}
    with open(name, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            where = tuple(int(row[index]) for index in "ijk")
            rows.setdefault(row["kind"], {})[where] = (float(row["value"]), float(row["u"]))
    campaign = {}
    for kind, numbers in rows.items():
        array = np.full(tuple(np.max(list(numbers), axis=0) + 1) + (2,), np.nan)
        for where, number in numbers.items():
            array[where] = number
        if np.isnan(array).any():
            sys.exit(f"{name}: {kind}: not every combination of i, j and k is there")
        campaign[kind] = array[..., 0], array[..., 1]
    return campaign


def rotations(angles, axis):
    """Rotation matrices about a coordinate axis and their derivatives, N×3×3 each."""
    second, third = (axis + 1) % 3, (axis + 2) % 3
    cosine, sine = np.cos(angles), np.sin(angles)
    rotation = np.zeros((len(angles), 3, 3))
    rotation[:, axis, axis] = 1.0
    rotation[:, second, second] = rotation[:, third, third] = cosine
    rotation[:, third, second], rotation[:, second, third] = sine, -sine
    derivative = np.zeros_like(rotation)
    derivative[:, second, second] = derivative[:, third, third] = -sine
    derivative[:, third, second], derivative[:, second, third] = cosine, -cosine
    return rotation, derivative


class Adjustment:
    """Unknowns x: stations (3 each), dead paths, fixture (3 each), six error motions of every angle but home."""

    def __init__(self, campaign):
        self.length, self.u_length = campaign["length"]  # angles × reflectors × stations
        self.angles, self.reflectors, self.stations = self.length.shape
        self.fixture, self.u_fixture = (array[..., 0] for array in campaign["fixture"])
        self.turn = rotations(campaign["angle"][0].ravel(), 0)[0]
        self.first_path = 3 * self.stations
        self.first_point = self.first_path + self.stations
        self.first_pose = self.first_point + 3 * self.reflectors
        self.unknowns = self.first_pose + 6 * (self.angles - 1)
        self.start = np.concatenate([campaign["start_station"][0].ravel(), campaign["start_dead_path"][0].ravel(),
                                     self.fixture.ravel(), np.zeros(6 * (self.angles - 1))])

    def unpack(self, x):
        poses = np.vstack([np.zeros(6), x[self.first_pose:].reshape(-1, 6)])
        return (x[:self.first_path].reshape(-1, 3), x[self.first_path:self.first_point],
                x[self.first_point:self.first_pose].reshape(-1, 3), poses)

    def residual(self, x):
        """(predicted - observed) / u of lengths and coordinates."""
        stations, paths, points, poses = self.unpack(x)
        (rx, _), (ry, _), (rz, _) = (rotations(poses[:, 3 + axis], axis) for axis in range(3))
        turned = np.einsum("iab,mb->ima", self.turn, points)
        world = np.einsum("iab,imb->ima", rz @ ry @ rx, turned) + poses[:, None, :3]
        distance = np.linalg.norm(world[:, :, None] - stations, axis=3)
        return np.concatenate([((distance - paths - self.length) / self.u_length).ravel(),
                               ((points - self.fixture) / self.u_fixture).ravel()])

    def jacobian(self, x):
        """Derivatives of `residual`, dense, analytic."""
        stations, _, points, poses = self.unpack(x)
        (rx, drx), (ry, dry), (rz, drz) = (rotations(poses[:, 3 + axis], axis) for axis in range(3))
        turned = np.einsum("iab,mb->ima", self.turn, points)
        error = rz @ ry @ rx
        difference = (np.einsum("iab,imb->ima", error, turned) + poses[:, None, :3])[:, :, None] - stations
        direction = difference / np.linalg.norm(difference, axis=3, keepdims=True) / self.u_length[..., None]
        by_rotation = [np.einsum("iab,imb->ima", derivative, turned)
                       for derivative in (rz @ ry @ drx, rz @ dry @ rx, drz @ ry @ rx)]
        rows = np.zeros((self.angles, self.reflectors, self.stations, self.unknowns))
        for j in range(self.stations):
            rows[:, :, j, 3 * j:3 * j + 3] = -direction[:, :, j]
            rows[:, :, j, self.first_path + j] = -1.0 / self.u_length[:, :, j]
        by_point = np.einsum("imja,iab->imjb", direction, error @ self.turn)
        for m in range(self.reflectors):
            first = self.first_point + 3 * m
            rows[:, m, :, first:first + 3] = by_point[:, m]
        by_angle = np.stack([np.einsum("imja,ima->imj", direction, change) for change in by_rotation], axis=3)
        for i in range(1, self.angles):
            first = self.first_pose + 6 * (i - 1)
            rows[i, :, :, first:first + 3] = direction[i]
            rows[i, :, :, first + 3:first + 6] = by_angle[i]
        priors = np.zeros((3 * self.reflectors, self.unknowns))
        priors[:, self.first_point:self.first_pose] = np.diag(1.0 / self.u_fixture.ravel())
        return np.vstack([rows.reshape(-1, self.unknowns), priors])

    def gauss_newton(self):
        """Steps by QR of the Jacobian with columns of unit length, until a step is below 1e-6 of the noise."""
        x = self.start
        for _ in range(50):
            jacobian = self.jacobian(x)
            scale = np.linalg.norm(jacobian, axis=0)
            step = np.linalg.lstsq(jacobian / scale, -self.residual(x), rcond=None)[0]
            x = x + step / scale
            if np.abs(step).max() < 1e-6:
                return x
        sys.exit("Gauss-Newton: not converged in 50 steps")

    def least_squares(self, **options):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = optimize.least_squares(self.residual, self.start, jac=self.jacobian, x_scale="jac", **options)
        if not found.success:
            sys.exit(f"least_squares, {options}: {found.message}")
        return found.x

    def covariance(self, x):
        """(JᵀJ)⁻¹, columns of J scaled to unit length first."""
        jacobian = self.jacobian(x)
        scale = np.linalg.norm(jacobian, axis=0)
        jacobian /= scale
        return np.linalg.inv(jacobian.T @ jacobian) / np.outer(scale, scale)

    def reported_covariance(self, x):
        """Covariance of the error motions with respect to the axis average line, and of O_y, O_z, S_y, S_z."""
        size = 6 * self.angles
        turning = np.zeros((size, 4))
        for i in range(self.angles):
            turning[6 * i:6 * i + 3, :2] = turning[6 * i + 3:6 * i + 6, 2:] = self.turn[i][:, 1:]
        motion = np.hstack([np.tile(np.eye(6), (self.angles, 1)), -turning])
        condition = np.hstack([np.tile(np.eye(6), (self.angles, 1)), turning]).T
        change = -np.linalg.solve(condition @ motion, condition)
        to_reported = np.vstack([np.eye(size) + motion @ change, change[6:]])[:, 6:]  # home is held
        return to_reported @ self.covariance(x)[self.first_pose:, self.first_pose:] @ to_reported.T


def timed(work, repetitions):
    """Median processor time of a call, in milliseconds, and what it gives."""
    times = []
    for _ in range(repetitions):
        begin = time.process_time()
        result = work()
        times.append(1e3 * (time.process_time() - begin))
    return statistics.median(times), result


def measured_by_program(name):
    """Median processor time of every benchmark of the program, in milliseconds."""
    times = {}
    with open(name, encoding="utf-8") as file:
        for run in json.load(file)["benchmarks"]:
            if run["run_type"] == "iteration":
                factor = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}[run["time_unit"]]
                times.setdefault(run["run_name"], []).append(factor * run["cpu_time"])
    return {name: statistics.median(values) for name, values in times.items()}


def main():
    parser = argparse.ArgumentParser(description="SciPy peer of the rotary-table benchmark")
    parser.add_argument("campaign")
    parser.add_argument("result", nargs="?")
    parser.add_argument("--repetitions", type=int, default=7)
    arguments = parser.parse_args()
    campaign = read(arguments.campaign)
    adjustment = Adjustment(campaign)
    kinds = ("solved_station", "solved_dead_path", "solved_fixture", "solved_pose")
    solution, u = (np.concatenate([(campaign[kind][part][1:] if kind == "solved_pose" else campaign[kind][part]).ravel()
                                   for kind in kinds]) for part in (0, 1))

    solvers = {
        "own Gauss-Newton, QR": adjustment.gauss_newton,
        "least_squares, lm": lambda: adjustment.least_squares(method="lm"),
        "least_squares, trf": lambda: adjustment.least_squares(method="trf", tr_solver="exact"),
    }
    agree = True
    solve_times = {}
    for name, solver in solvers.items():
        solve_times[name], x = timed(solver, arguments.repetitions)
        largest = np.max(np.abs(x - solution) / u)
        agree = agree and largest < 1e-3
        print(f"{name}: differs from the program by at most {largest:.1e} of a standard uncertainty", file=sys.stderr)
    covariance_time, covariance = timed(lambda: adjustment.covariance(solution), arguments.repetitions)
    reported_time, reported = timed(lambda: adjustment.reported_covariance(solution), arguments.repetitions)
    for name, own, theirs in (("parameters", covariance, u), ("errors", reported, campaign["reported"][1].ravel())):
        largest = np.max(np.abs(np.sqrt(np.diag(own)) / theirs - 1.0))
        agree = agree and largest < 1e-6
        print(f"standard uncertainties, {name}: differ from the program's by at most {largest:.1e}", file=sys.stderr)
    if not agree:
        sys.exit("the solutions do not agree: the times would not be of the same work")

    program = measured_by_program(arguments.result) if arguments.result else {}
    rows = [("start values of stations and dead paths", "start_values", "", None)]
    rows += [("one solve", "solve", name, found) for name, found in solve_times.items()]
    rows += [("covariance of all parameters", "covariance_of_parameters", "inv(JᵀJ)", covariance_time),
             ("covariance of all errors in the datum", "covariance_of_errors", "inv(JᵀJ), mapped", reported_time),
             ("one variance-component step", "variance_component_step", "", None),
             ("whole evaluation, weights stated", "evaluate_stated_weights", "", None),
             ("whole evaluation, weights estimated, 3 outliers found", "evaluate_estimated_weights", "", None),
             ("law of propagation with budget", "propagate", "", None)]
    print("| work | gumcert, ms | SciPy | SciPy, ms | ratio |\n|---|---|---|---|---|")
    for work, key, peer, theirs in rows:
        ours = program.get(key)
        print(f"| {work} | {'–' if ours is None else format(ours, '.2f')} | {peer or '–'} "
              f"| {'–' if theirs is None else format(theirs, '.1f')} "
              f"| {'–' if None in (ours, theirs) else format(theirs / ours, '.1f')} |")


if __name__ == "__main__":
    main()
