#!/usr/bin/env python3
"""One rotary-table campaign adjusted by an independent program, for rotary_model_oracle_test.cpp.

    rotary_model_oracle.py OUTPUT.json

Simulates a geometry with known errors and a fixed seed, adjusts it by dense Gauss-Newton with rotation vectors, and writes
inputs and solution. It shares no code, parameters of rotation or order of computation with the program. Units:
metre and radian. Exit code 77 when numpy is absent.

Frames: the fixture at the home position, in which the stations stand, and the axis of the table (x). The exact motion of a
reflector p is T⁻¹ E Rx(θ) T p, with the set-up T = Trans(0, Oy, Oz) Ry(Sy) Rz(Sz) and the errors of the table
E = Trans(dx, dy, dz) Rx(ea) Ry(eb) Rz(ec).
"""

import json
import pathlib
import sys

try:
    import numpy as np
except ImportError as error:
    print(f"rotary_model_oracle.py: {error}", file=sys.stderr)
    sys.exit(77)

ARCSECOND = np.pi / 180 / 3600
MICROMETRE = 1e-6
U_CONSTANT = 0.10e-6
U_PROPORTIONAL = 0.15e-6

# Six reflectors that lie in no plane, and six stations in front of the table, 0.6 m to 1.5 m away.
FIXTURE = np.array([[0.030, 0.120, 0.000], [0.150, 0.050, 0.100], [0.060, -0.085, 0.090],
                    [0.180, -0.070, -0.050], [0.040, 0.010, -0.120], [0.220, 0.020, 0.010]])
STATIONS = np.array([[0.70, 0.45, 0.10], [0.75, -0.40, 0.35], [0.55, 0.10, -0.60],
                     [1.20, -0.55, -0.45], [1.10, 0.60, 0.70], [0.45, -0.75, 0.05]])
THETA = np.arange(36) * 2 * np.pi / 36
DEAD_PATHS = np.array([0.213, 0.187, 0.251, 0.232, 0.199, 0.244])
OFFSET = np.array([59.4, 192.6]) * MICROMETRE    # Oy, Oz
TILT = np.array([50.78, 108.70]) * ARCSECOND     # Sy, Sz


def rotation_x(t):
    return np.array([[1, 0, 0], [0, np.cos(t), -np.sin(t)], [0, np.sin(t), np.cos(t)]])


def rotation_y(t):
    return np.array([[np.cos(t), 0, np.sin(t)], [0, 1, 0], [-np.sin(t), 0, np.cos(t)]])


def rotation_z(t):
    return np.array([[np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1]])


def rotation_of_vector(r):
    """exp(r×), by the formula of Rodrigues."""
    angle = np.linalg.norm(r)
    cross = np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])
    if angle < 1e-9:
        return np.eye(3) + cross + cross @ cross / 2
    return np.eye(3) + np.sin(angle) / angle * cross + (1 - np.cos(angle)) / angle ** 2 * cross @ cross


def true_errors():
    """dx, dy, dz, ea, eb, ec of each angle; 0 at the first one."""
    t = THETA
    errors = np.c_[1.5 * np.sin(t + .3) + .5 * np.cos(3 * t), 2.0 * np.cos(2 * t + 1) + .8 * np.sin(5 * t),
                   1.8 * np.sin(2 * t) + .6 * np.cos(4 * t + .5), 12 * np.sin(t) + 4 * np.sin(2 * t + .7),
                   5 * np.cos(2 * t) + 2 * np.sin(3 * t), 6 * np.sin(2 * t + .4) + 1.5 * np.cos(3 * t)] * 1e-6
    return errors - errors[0]


def pose_of(theta, error):
    """Rotation and translation of the fixture from its place at home."""
    set_up = rotation_y(TILT[0]) @ rotation_z(TILT[1])
    shift = np.array([0, *OFFSET])
    turn = rotation_x(error[3]) @ rotation_y(error[4]) @ rotation_z(error[5]) @ rotation_x(theta)
    return set_up.T @ turn @ set_up, set_up.T @ (turn @ shift + error[:3] - shift)


class Adjustment:
    """x = stations, a dead path a station, fixture, poses of all angles but the first, whose pose is the identity.

    P = exp(r×) Rx(θ) p + t; a distance is |P − station| − dead path; coordinates of the fixture are observed, too.
    """

    def __init__(self, fixture, u_fixture, sigma):
        self.fixture, self.u_fixture, self.sigma = fixture, u_fixture, sigma  # sigma: angles × reflectors × stations
        self.angles, self.reflectors, self.stations = sigma.shape
        self.paths = 3 * self.stations
        self.coordinates = self.paths + self.stations
        self.poses = self.coordinates + 3 * self.reflectors
        self.parameters = self.poses + 6 * (self.angles - 1)
        self.turns = np.array([rotation_x(t) for t in THETA])

    def parts(self, x):
        poses = np.vstack([np.zeros(6), x[self.poses:].reshape(-1, 6)])
        return (x[:self.paths].reshape(-1, 3), x[self.paths:self.coordinates],
                x[self.coordinates:self.poses].reshape(-1, 3), poses)

    def lines(self, x):
        """Rotations after Rx(θ), places of the reflectors, and vectors from stations to them."""
        stations, _, fixture, poses = self.parts(x)
        rotations = np.array([rotation_of_vector(r) for r in poses[:, 3:]])
        turned = np.einsum("iab,ibc,mc->ima", rotations, self.turns, fixture)
        places = turned + poses[:, None, :3]
        return rotations, turned, places[:, :, None, :] - stations

    def residuals(self, x, lengths):
        _, dead_paths, fixture, _ = self.parts(x)
        distances = np.linalg.norm(self.lines(x)[2], axis=3) - dead_paths
        return np.r_[((distances - lengths) / self.sigma).ravel(), ((fixture - self.fixture) / self.u_fixture).ravel()]

    def jacobian(self, x):
        rotations, turned, lines = self.lines(x)
        weighted = lines / np.linalg.norm(lines, axis=3)[..., None] / self.sigma[..., None]
        rows = np.zeros((*self.sigma.shape, self.parameters))
        for j in range(self.stations):
            rows[:, :, j, 3 * j:3 * j + 3] = -weighted[:, :, j]
            rows[:, :, j, self.paths + j] = -1 / self.sigma[:, :, j]
        whole = rotations @ self.turns
        for m in range(self.reflectors):
            at = self.coordinates + 3 * m
            rows[:, m, :, at:at + 3] = np.einsum("isa,iab->isb", weighted[:, m], whole)
        turning = np.cross(turned[:, :, None, :], weighted)  # of a small rotation from the left
        for i in range(1, self.angles):
            at = self.poses + 6 * (i - 1)
            rows[i, :, :, at:at + 3] = weighted[i]
            rows[i, :, :, at + 3:at + 6] = turning[i]
        of_fixture = np.zeros((3 * self.reflectors, self.parameters))
        of_fixture[:, self.coordinates:self.poses] = np.diag(1 / self.u_fixture.ravel())
        return np.vstack([rows.reshape(-1, self.parameters), of_fixture])

    def solve(self, lengths, stations):
        first = np.linalg.norm(self.fixture[:, None] - stations, axis=2) - lengths[0]
        x = np.r_[stations.ravel(), first.mean(0), self.fixture.ravel(), np.zeros(6 * (self.angles - 1))]
        for _ in range(30):
            jacobian = self.jacobian(x)
            scale = np.linalg.norm(jacobian, axis=0)  # columns of length 1
            step = np.linalg.lstsq(jacobian / scale, -self.residuals(x, lengths), rcond=None)[0]
            x = x + step / scale
            if np.abs(step).max() < 1e-6:
                break
        return x

    def covariance(self, x):
        jacobian = self.jacobian(x)
        scale = np.linalg.norm(jacobian, axis=0)
        scaled = jacobian / scale
        return np.linalg.inv(scaled.T @ scaled) / np.outer(scale, scale)


rng = np.random.default_rng(20240517)
points = np.array([FIXTURE @ rotation.T + shift for rotation, shift in map(pose_of, THETA, true_errors())])
distances = np.linalg.norm(points[:, :, None] - STATIONS, axis=3)  # angles × reflectors × stations
sigma = np.hypot(U_CONSTANT, U_PROPORTIONAL * distances)
lengths = distances - DEAD_PATHS + rng.standard_normal(distances.shape) * sigma
u_fixture = np.repeat(np.hypot(0.401, 0.332 * np.linalg.norm(FIXTURE, axis=1))[:, None], 3, 1) * MICROMETRE
fixture = FIXTURE + rng.standard_normal(FIXTURE.shape) * u_fixture
start = STATIONS + rng.uniform(-1, 1, STATIONS.shape) * 2e-3

# The weights rest on the distances, hence on the dead paths: solved again with those of the solution.
dead_paths = DEAD_PATHS
for _ in range(3):
    adjustment = Adjustment(fixture, u_fixture, np.hypot(U_CONSTANT, U_PROPORTIONAL * (lengths + dead_paths)))
    x = adjustment.solve(lengths, start)
    dead_paths = adjustment.parts(x)[1]
residuals = adjustment.residuals(x, lengths)
covariance = adjustment.covariance(x)
stations, _, coordinates, motions = adjustment.parts(x)
u = np.sqrt(np.diag(covariance))
u_pose = np.vstack([np.zeros(6), u[adjustment.poses:].reshape(-1, 6)])
first_pose = slice(adjustment.poses, adjustment.poses + 6)

pathlib.Path(sys.argv[1]).write_text(json.dumps({
    "theta": THETA.tolist(), "lengths": lengths.tolist(), "u_constant": U_CONSTANT, "u_proportional": U_PROPORTIONAL,
    "fixture": fixture.tolist(), "u_fixture": u_fixture.tolist(),
    "solution": {
        "chi_square": float(residuals @ residuals), "parameters": adjustment.parameters, "observations": len(residuals),
        "stations": stations.tolist(), "u_stations": u[:adjustment.paths].reshape(-1, 3).tolist(),
        "dead_paths": dead_paths.tolist(), "u_dead_paths": u[adjustment.paths:adjustment.coordinates].tolist(),
        "fixture": coordinates.tolist(),
        "u_fixture": u[adjustment.coordinates:adjustment.poses].reshape(-1, 3).tolist(),
        "translations": motions[:, :3].tolist(), "u_translations": u_pose[:, :3].tolist(),
        "rotations": [rotation_of_vector(motion[3:]).tolist() for motion in motions],  # P = E R(θ) p + t
        "u_rotations": u_pose[:, 3:].tolist(),      # of a small rotation from the left, about x, y, z
        "pose_covariance": [covariance[at:at + 6, first_pose].tolist()
                            for at in range(adjustment.poses, adjustment.parameters, 6)]}}), encoding="utf-8")
