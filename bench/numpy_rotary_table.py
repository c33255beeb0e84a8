#!/usr/bin/env python3
"""The joint adjustment of a rotary table with NumPy and SciPy, by structure: the peer of the program for many angles.

    numpy_rotary_table.py DIR [RECORD.json]

DIR is written by rotary_table_campaign.py --stated-weights; RECORD.json is the program's record of the same job. Solves
the same least-squares problem by Gauss-Newton steps in two ways: with the poses eliminated angle by angle (Schur
complement, batched over the angles), and with SuperLU on the sparse normal equations. Then the standard uncertainties
of all error motions with respect to the axis average line, from the Schur complement. Prints one JSON object: seconds
of processor time, peak memory, and how far errors and uncertainties are from the record. Exits with 1 when they
disagree by more than 1e-3 of a standard uncertainty or 1e-5 of an uncertainty.
"""

import csv
import json
import pathlib
import resource
import sys
import time

import numpy as np
from scipy import sparse
from scipy.sparse import linalg as sparse_linalg

from rotary_table_campaign import ARCSECOND, rotations

U_LENGTH, U_POSE = 0.1e-6, np.array([0.1e-6] * 3 + [0.3 * ARCSECOND] + [0.1 * ARCSECOND] * 2)
U_FIXTURE = 0.4e-6


def table(name):
    with open(name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Adjustment:
    """Border: stations (3 each), dead paths, fixture (3 each); then six error motions of every angle but the first."""

    def __init__(self, folder):
        self.stated = 1e-3 * np.array([[float(row[c]) for c in ("x_mm", "y_mm", "z_mm")]
                                       for row in table(folder / "fixture.csv")])
        self.start = 1e-3 * np.array([[float(row[c]) for c in ("x_mm", "y_mm", "z_mm")]
                                      for row in table(folder / "stations.csv")])
        rows = table(folder / "lengths.csv")
        self.stations, self.reflectors = len(self.start), len(self.stated)
        shape = (self.stations, -1, self.reflectors)
        length = 1e-3 * np.array([float(row["length_mm"]) for row in rows]).reshape(shape)
        self.length = length.transpose(1, 0, 2)  # angles × stations × reflectors
        degrees = np.array([float(row["angle_deg"]) for row in rows]).reshape(shape)[0, :, 0]
        self.angles = len(degrees)
        self.turn = rotations(np.radians(degrees), 0)
        self.border = 4 * self.stations + 3 * self.reflectors

    def first(self):
        """Stations as stated, dead paths from them."""
        turned = np.einsum("iab,mb->ima", self.turn, self.stated)
        distance = np.linalg.norm(turned[:, None] - self.start[None, :, None], axis=3)
        return (self.start.copy(), (distance - self.length).mean(axis=(0, 2)), self.stated.copy(),
                np.zeros((self.angles, 6)))

    def linearise(self, stations, paths, points, poses):
        """Whitened residuals N×S×M, derivatives by pose N×S×M×6 and by border N×S×M×b; a visit is one angle and station."""
        (rx, drx), (ry, dry), (rz, drz) = (with_derivative(poses[:, 3 + axis], axis) for axis in range(3))
        turned = np.einsum("iab,mb->ima", self.turn, points)
        error = rz @ ry @ rx
        difference = (np.einsum("iab,imb->ima", error, turned) + poses[:, None, :3])[:, None] - stations[None, :, None]
        distance = np.linalg.norm(difference, axis=3)
        direction = difference / distance[..., None]
        moved = [np.einsum("iab,imb->ima", derivative, turned)
                 for derivative in (rz @ ry @ drx, rz @ dry @ rx, drz @ ry @ rx)]
        by_pose = np.concatenate([direction] + [np.einsum("ijma,ima->ijm", direction, change)[..., None]
                                                for change in moved], axis=3)
        by_border = np.zeros((self.angles, self.stations, self.reflectors, self.border))
        by_point = np.einsum("ijma,iab->ijmb", direction, error @ self.turn)
        for j in range(self.stations):
            by_border[:, j, :, 3 * j:3 * j + 3] = -direction[:, j]
            by_border[:, j, :, 3 * self.stations + j] = -1.0
        for m in range(self.reflectors):
            first = 4 * self.stations + 3 * m
            by_border[:, :, m, first:first + 3] = by_point[:, :, m]
        covariance = np.einsum("ijma,a,ijna->ijmn", by_pose, U_POSE**2, by_pose)
        covariance += U_LENGTH**2 * np.eye(self.reflectors)
        root = np.linalg.inv(np.linalg.cholesky(covariance))
        residual = np.einsum("ijmn,ijn->ijm", root, self.length - (distance - paths[None, :, None]))
        return residual, root @ by_pose, root @ by_border

    def normal(self, parameters):
        """Blocks of the normal equations: border, poses, between them, and the right-hand sides."""
        residual, by_pose, by_border = self.linearise(*parameters)
        flat = (self.angles, -1)
        pose, border = by_pose.reshape(*flat, 6), by_border.reshape(*flat, self.border)
        residual = residual.reshape(self.angles, -1, 1)
        prior = np.zeros(self.border)
        prior[4 * self.stations:] = 1.0 / U_FIXTURE**2
        misfit = np.zeros(self.border)
        misfit[4 * self.stations:] = prior[4 * self.stations:] * (self.stated - parameters[2]).ravel()
        swapped = pose.transpose(0, 2, 1)
        rows = border.reshape(-1, self.border)
        return (rows.T @ rows + np.diag(prior), swapped @ pose, swapped @ border,
                rows.T @ residual.ravel() + misfit, (swapped @ residual)[..., 0])

    def schur(self, parameters):
        """Covariance of the border, W of every pose, F = ∂pose/∂border, and the step."""
        border, own, across, right, right_own = self.normal(parameters)
        inverse = np.linalg.inv(own[1:])  # the first angle is home: its pose is zero
        gain = inverse @ across[1:]
        reduced = border - np.einsum("iab,iac->bc", across[1:], gain)
        scale = 1.0 / np.sqrt(np.diag(reduced))
        covariance = np.linalg.inv(reduced * np.outer(scale, scale)) * np.outer(scale, scale)
        step = covariance @ (right - np.einsum("iab,ia->b", gain, right_own[1:]))
        poses = np.einsum("iab,ib->ia", inverse, right_own[1:]) - gain @ step
        return covariance, inverse, -gain, step, poses

    def sparse_step(self, parameters):
        border, own, across, right, right_own = self.normal(parameters)
        count = self.angles - 1
        blocks = sparse.block_diag(list(own[1:]), format="csc")
        side = sparse.csc_matrix(across[1:].reshape(6 * count, self.border))
        whole = sparse.bmat([[sparse.csc_matrix(border), side.T], [side, blocks]], format="csc")
        scale = 1.0 / np.sqrt(whole.diagonal())
        scaled = sparse.diags(scale) @ whole @ sparse.diags(scale)
        solution = sparse_linalg.splu(scaled.tocsc()).solve(scale * np.concatenate([right, right_own[1:].ravel()]))
        solution *= scale
        return solution[:self.border], solution[self.border:].reshape(count, 6)

    def solve(self, step_of):
        stations, paths, points, poses = self.first()
        for _ in range(50):
            step, pose_step = step_of((stations, paths, points, poses))
            stations = stations + step[:3 * self.stations].reshape(-1, 3)
            paths = paths + step[3 * self.stations:4 * self.stations]
            points = points + step[4 * self.stations:].reshape(-1, 3)
            poses = poses + np.vstack([np.zeros(6), pose_step])
            # A thousandth of the noise of one distance is no number that anyone states.
            if max(np.abs(pose_step[:, :3]).max(), np.abs(step).max()) < 1e-3 * U_LENGTH:
                return stations, paths, points, poses
        sys.exit("Gauss-Newton: not converged in 50 steps")

    def average_line(self):
        """D and K of the S-transformation to the axis average line: errors = poses + D K poses."""
        size = 6 * self.angles
        turning = np.zeros((size, 4))
        for i in range(self.angles):
            turning[6 * i:6 * i + 3, :2] = turning[6 * i + 3:6 * i + 6, 2:] = self.turn[i][:, 1:]
        motion = np.hstack([np.tile(np.eye(6), (self.angles, 1)), -turning])
        condition = np.hstack([np.tile(np.eye(6), (self.angles, 1)), turning]).T
        return motion, -np.linalg.solve(condition @ motion, condition)

    def uncertainties(self, parameters):
        """Standard uncertainties of the error motions, 6N, without a matrix of all of them."""
        covariance, own, by_border, _, _ = self.schur(parameters)
        motion, change = self.average_line()
        own = np.concatenate([np.zeros((1, 6, 6)), own])
        by_border = np.concatenate([np.zeros((1, 6, self.border)), by_border]).reshape(-1, self.border)
        gain = by_border + motion @ (change @ by_border)
        change_own = np.einsum("kia,iab->kib", change.reshape(10, -1, 6), own).reshape(10, -1)
        cross = change_own.T + 0.5 * motion @ (change_own @ change.T)
        variance = np.einsum("ia,ab,ib->i", gain, covariance, gain, optimize=True)
        variance += np.diagonal(own, axis1=1, axis2=2).ravel() + 2.0 * np.einsum("ia,ia->i", motion, cross)
        return np.sqrt(variance)

    def errors(self, poses):
        motion, change = self.average_line()
        flat = poses.ravel()
        return flat + motion @ (change @ flat)


def with_derivative(angles, axis):
    rotation = rotations(angles, axis)
    quarter = rotations(angles + np.pi / 2.0, axis)
    quarter[:, axis, axis] = 0.0
    return rotation, quarter


def timed(work):
    begin = time.process_time()
    result = work()
    return time.process_time() - begin, result


def main():
    folder = pathlib.Path(sys.argv[1])
    adjustment = Adjustment(folder)
    seconds, solution = timed(lambda: adjustment.solve(lambda at: adjustment.schur(at)[3:]))
    uncertainty_seconds, u = timed(lambda: adjustment.uncertainties(solution))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    sparse_seconds, again = timed(lambda: adjustment.solve(adjustment.sparse_step))
    result = {"schur_solve_s": seconds, "schur_uncertainties_s": uncertainty_seconds, "schur_memory_MB": memory / 1024.0,
              "superlu_solve_s": sparse_seconds,
              "superlu_memory_MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0}
    errors = adjustment.errors(solution[3])
    result["superlu_differs_u"] = float(np.max(np.abs(adjustment.errors(again[3]) - errors) / u))
    agree = True
    if len(sys.argv) > 2:
        with open(sys.argv[2], encoding="utf-8") as file:
            rotary = json.load(file)["rotary"]
        unit = np.array([1e-6] * 3 + [ARCSECOND] * 3)
        theirs = [[[row[name][part] for name in rotary["error_names"]] for row in rotary["errors"]]
                  for part in ("value", "u")]
        value, stated = (np.array(part) * unit for part in theirs)
        # The axis average line is an average of nonlinear motions: second-order terms of 1e-12 m are in the program only.
        result["errors_differ_u"] = float(np.max(np.abs(value.ravel() - errors) / u))
        result["u_differs"] = float(np.max(np.abs(stated.ravel() / u - 1.0)))
        agree = result["errors_differ_u"] < 1e-3 and result["u_differs"] < 1e-5
    print(json.dumps(result))
    if not agree:
        sys.exit(f"{folder}: the solutions do not agree: the times would not be of the same work")


if __name__ == "__main__":
    main()
