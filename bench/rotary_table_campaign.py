#!/usr/bin/env python3
"""Writes a rotary-table job of any size with simulated distances, for measurements of time and memory.

    rotary_table_campaign.py DIR [--angles N] [--stations S] [--reflectors M] [--both-senses] [--seed K] [--stated-weights]
                             [--outliers SHARE --least METRE --largest METRE]

The table turns about x. Stations and reflectors stand on a spiral around the axis, the six error motions are harmonics
of a few micrometres and arcseconds, every visit of the table deviates by its repeatability and every distance by its
noise. The same arguments give the same files.
"""

import argparse
import json
import pathlib

import numpy as np

ARCSECOND = np.pi / 648000


def rotations(angles, axis):
    """Rotation matrices about a coordinate axis, N×3×3."""
    second, third = (axis + 1) % 3, (axis + 2) % 3
    result = np.zeros((len(angles), 3, 3))
    result[:, axis, axis] = 1.0
    result[:, second, second] = result[:, third, third] = np.cos(angles)
    result[:, third, second], result[:, second, third] = np.sin(angles), -np.sin(angles)
    return result


def turned(poses, angles, points):
    """E R(θ) p of every angle and point, N×M×3, in metre; E = Trans(d) Rz(c) Ry(b) Rx(a)."""
    motion = rotations(poses[:, 5], 2) @ rotations(poses[:, 4], 1) @ rotations(poses[:, 3], 0)
    return np.einsum("nij,mj->nmi", motion @ rotations(angles, 0), points) + poses[:, None, :3]


def spiral(count, along, radius, start):
    """Points around the x axis at growing heights along it, count×3, in metre."""
    turn = start + 2.4 * np.arange(count)
    height = np.linspace(*along, count)
    return np.column_stack([height, radius * np.cos(turn), radius * np.sin(turn)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--angles", type=int, default=36)
    parser.add_argument("--stations", type=int, default=6)
    parser.add_argument("--reflectors", type=int, default=6)
    parser.add_argument("--both-senses", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stated-weights", action="store_true",
                        help="state the repeatability of the table, keep the noise, and leave nothing out")
    parser.add_argument("--outliers", type=float, default=0.0, help="share of the distances that are wrong")
    parser.add_argument("--least", type=float, default=5e-7, help="size of the least error, in metre")
    parser.add_argument("--largest", type=float, default=1.0, help="size of the largest; evenly in the logarithm between")
    a = parser.parse_args()

    blunders = np.random.default_rng(a.seed + 1000)  # the same measurement with and without them
    random = np.random.default_rng(a.seed)
    degrees = 360.0 * np.arange(a.angles) / a.angles
    angles = np.radians(degrees)
    errors = np.zeros((a.angles, 6))
    for column, size in enumerate([3e-6, 2e-6, 2e-6, 2 * ARCSECOND, ARCSECOND, ARCSECOND]):
        for order in (1, 2, 3):
            phase = random.uniform(0.0, 2 * np.pi)
            errors[:, column] += size / order * (np.sin(order * angles + phase) - np.sin(phase))
    stations = spiral(a.stations, (0.4, 1.3), 0.85, 0.3)
    stated = spiral(a.reflectors, (0.03, 0.2), 0.14, 1.1)
    fixture = stated + random.normal(0.0, 0.4e-6, stated.shape)
    dead_paths = random.uniform(0.05, 0.2, a.stations)
    repeatability = np.array([0.1e-6] * 3 + [0.3 * ARCSECOND] + [0.1 * ARCSECOND] * 2)

    a.directory.mkdir(parents=True, exist_ok=True)
    with open(a.directory / "lengths.csv", "w", encoding="utf-8") as file:
        file.write("station,reflector,pass,direction,angle_deg,length_mm,dead_path\n")
        for j in range(a.stations):
            for sense in "+-" if a.both_senses else "+":
                poses = errors + random.normal(0.0, 1.0, errors.shape) * repeatability
                places = turned(poses, angles, fixture)
                lengths = np.linalg.norm(places - stations[j], axis=2) - dead_paths[j]
                lengths += random.normal(0.0, 0.1e-6, lengths.shape)
                sizes = np.exp(blunders.uniform(np.log(a.least), np.log(a.largest), lengths.shape))
                lengths += np.where(blunders.random(lengths.shape) < a.outliers,
                                    blunders.choice([-1.0, 1.0], lengths.shape) * sizes, 0.0)
                order = range(a.angles) if sense == "+" else reversed(range(a.angles))
                for i in order:
                    for m in range(a.reflectors):
                        file.write(f"P{j + 1},R{m + 1},P{j + 1}{sense},{sense},{degrees[i]:.4f},"
                                   f"{1e3 * lengths[i, m]:.6f},P{j + 1}\n")
    with open(a.directory / "fixture.csv", "w", encoding="utf-8") as file:
        file.write("reflector,x_mm,y_mm,z_mm,u_x_um,u_y_um,u_z_um\n")
        for m, point in enumerate(stated):
            file.write(f"R{m + 1}," + ",".join(f"{1e3 * c:.7f}" for c in point) + ",0.4,0.4,0.4\n")
    with open(a.directory / "stations.csv", "w", encoding="utf-8") as file:
        file.write("station,x_mm,y_mm,z_mm,u_mm\n")
        for j, point in enumerate(stations):
            file.write(f"P{j + 1}," + ",".join(f"{1e3 * c:.0f}" for c in point) + ",20\n")
    job = {"schema": "gumcert/job/1", "kind": "rotary_table", "axis": "A", "home_angle_deg": 0,
           "title": f"Simulated: {a.stations} stations, {a.reflectors} reflectors, {a.angles} angles",
           "datum": "axis_average_line", "coverage_probability": 0.9545,
           "observations": {"lengths": "lengths.csv", "stations": "stations.csv"},
           "length_uncertainty": {"u_constant_um": 0.1, "scale_model": "fixed"},
           "fixture": {"coordinates": "fixture.csv", "reference_temperature_degC": 20},
           "table_repeatability": {"mode": "estimate"}}
    if a.stated_weights:
        job["variance_components"] = "fixed"
        job["outliers"] = {"test": "none"}
        job["table_repeatability"] = {"mode": "given", "u_linear_um": 0.1, "u_axial_arcsec": 0.3, "u_tilt_arcsec": 0.1}
    (a.directory / "job.json").write_text(json.dumps(job, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
