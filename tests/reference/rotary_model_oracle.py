#!/usr/bin/env python3
"""One rotary-table campaign adjusted by an independent program, for rotary_model_oracle_test.cpp.

    rotary_model_oracle.py TOOLS_FOLDER OUTPUT.json

Imports rotary_model_check.py from the folder (numpy and scipy; its Bundle class is a dense Gauss-Newton adjustment with
rotation vectors), simulates its geometry with its errors and a fixed seed, solves, and writes inputs and solution.
Units: metre and radian. Exit code 77 when something that it needs is absent.
"""

import json
import pathlib
import sys

folder, output = sys.argv[1:3]
sys.dont_write_bytecode = True
sys.path.insert(0, folder)
try:
    import numpy as np
    import rotary_model_check as check
except ImportError as error:
    print(f"rotary_model_oracle.py: {error}", file=sys.stderr)
    sys.exit(77)

U_CONSTANT = 0.10e-6
U_PROPORTIONAL = 0.15e-6

rng = np.random.default_rng(20240517)
errors = check.true_errors()
set_up = np.r_[check.O_TRUE, check.S_TRUE]
poses = [check.pose_of(theta, set_up, error) for theta, error in zip(check.THETA, errors)]
points = np.array([check.FIX @ rotation.T + translation for rotation, translation in poses])
distances = np.linalg.norm(points[:, :, None] - check.STA[None, None], axis=3)       # angles × reflectors × stations
sigma = np.hypot(U_CONSTANT, U_PROPORTIONAL * distances)
lengths = distances - check.L0 + rng.standard_normal(distances.shape) * sigma
u_fixture = np.repeat(check.u_cmm(np.linalg.norm(check.FIX, axis=1))[:, None], 3, 1)
fixture = check.FIX + rng.standard_normal(check.FIX.shape) * u_fixture
start = check.STA + rng.uniform(-1, 1, check.STA.shape) * 2e-3

# The weights rest on the distances, hence on the dead paths: solved again with those of the solution.
dead_paths = check.L0
for _ in range(3):
    bundle = check.Bundle(check.THETA, fixture, u_fixture, np.hypot(U_CONSTANT, U_PROPORTIONAL * (lengths + dead_paths)))
    x, residual, iterations = bundle.solve(lengths, start, iters=30)
    dead_paths = x[bundle.o_l:bundle.o_l + bundle.nl]
covariance, _, _ = bundle.cov(x)
stations, _, _, coordinates, motions = bundle.unpack(x)
rotations = np.array([check.expm3(motion[3:]) for motion in motions])
u = np.sqrt(np.diag(covariance))
u_pose = np.vstack([np.zeros(6), u[bundle.o_m:].reshape(-1, 6)])

pathlib.Path(output).write_text(json.dumps({
    "theta": check.THETA.tolist(), "lengths": lengths.tolist(), "u_constant": U_CONSTANT, "u_proportional": U_PROPORTIONAL,
    "fixture": fixture.tolist(), "u_fixture": u_fixture.tolist(),
    "solution": {
        "chi_square": float(residual @ residual), "parameters": int(bundle.n), "observations": int(len(residual)),
        "stations": stations.tolist(), "u_stations": u[:3 * bundle.S].reshape(-1, 3).tolist(),
        "dead_paths": dead_paths.tolist(), "u_dead_paths": u[bundle.o_l:bundle.o_l + bundle.nl].tolist(),
        "fixture": coordinates.tolist(), "u_fixture": u[bundle.o_p:bundle.o_m].reshape(-1, 3).tolist(),
        "translations": motions[:, :3].tolist(), "u_translations": u_pose[:, :3].tolist(),
        "rotations": rotations.tolist(),            # E of each angle, P = E R(θ) p + t
        "u_rotations": u_pose[:, 3:].tolist(),      # of a small rotation from the left, about x, y, z
        "pose_covariance": [covariance[bundle.o_m + 6 * i:bundle.o_m + 6 * i + 6, bundle.o_m:bundle.o_m + 6].tolist()
                            for i in range(bundle.N - 1)]}}), encoding="utf-8")
