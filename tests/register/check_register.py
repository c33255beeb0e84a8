#!/usr/bin/env python3
"""Drift, applicability and recalibration intervals of made-up standards, computed a second time.

Standards with histories are made from a seed; the program's register reads them (register_driver) and this file answers
the same questions by what docs/laboratory.md says: straight lines by numpy.linalg.lstsq and the covariance matrix of the
parameters, dates by datetime, intervals by walking day by day. No line of code is shared.

    check_register.py --driver PROGRAM [--histories 6000] [--seed 1]
"""

import argparse
import datetime
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

import numpy as np
from scipy import stats

YEAR = 365.25
SAME = 1e-9
FACTORS = {"V": 1.0, "mV": 1e-3, "kV": 1e3}  # of the units that the histories are in


# ---- what is made up ----------------------------------------------------------------------------------------------------

def day(text):
    return datetime.date.fromisoformat(text)


def later(text, days):
    return (day(text) + datetime.timedelta(days=days)).isoformat()


def made_lines(rng):
    """The lines of a certificate without their values: quantity, range, mode, nominal value, limits."""
    shape = rng.choice(["one", "open", "points", "points", "points", "ranges", "modes", "quantities", "limits"])
    if shape == "one":
        return [{"nominal": rng.choice([1, 10, 20.5])}]
    if shape == "open":
        return [{}]
    if shape == "limits":
        low = rng.uniform(0, 5)
        return [{"low": low, "high": low + rng.uniform(0.5, 20)}]
    nominals = sorted(rng.sample([-20, -5, 0, 1, 2.5, 5, 10, 20, 50, 80, 100], rng.randint(2, 6)))
    if shape == "points":
        return [{"nominal": n} for n in nominals]
    key, words = {"ranges": ("range", ["10 V", "100 V", ""]), "modes": ("mode", ["DC", "AC", ""]),
                  "quantities": ("quantity", ["voltage", "ratio", ""])}[shape]
    lines = []
    for word in rng.sample(words, rng.randint(1, 3)):
        for n in nominals[: rng.randint(1, len(nominals))]:
            lines.append({"nominal": n, **({key: word} if word else {})})
    return lines


def made_standard(rng, number):
    lines = made_lines(rng)
    nominal_unit = rng.choice([None, None, "V", "mm"])
    beside = rng.random() < 0.2  # values are errors, beside their nominal values
    count = rng.choice([1, 2, 3, 3, 4, 5, 8, 12])
    date = later("2005-01-01", rng.randint(0, 3000))
    scale = 10 ** rng.uniform(-3, 1)
    slope = rng.choice([0.0, 1.0, -1.0]) * scale * rng.uniform(0, 1) / 365
    scatter = scale * rng.choice([0.0, 0.02, 0.3])
    start = day(date)
    calibrations = []
    for i in range(count):
        unit = "V" if i == count - 1 else rng.choice(["V", "V", "V", "mV", "kV"])
        results = []
        for line in lines:
            if i < count - 1 and rng.random() < 0.1:
                continue  # was not calibrated then
            elapsed = (day(date) - start).days
            value = (0.0 if beside else line.get("nominal", 3.0)) + scale * rng.gauss(0, 0.1) + slope * elapsed + rng.gauss(0, 1) * scatter
            U = scale * rng.choice([0.05, 0.1, 0.5]) * rng.uniform(0.8, 1.2)
            result = {**line, "value": value / FACTORS[unit], "unit": unit, "U": U / FACTORS[unit]}
            if nominal_unit and ("nominal" in line or "low" in line):
                result["nominal_unit"] = nominal_unit
            elif unit != "V" and ("nominal" in line or "low" in line):
                result["nominal_unit"] = "V"
            if rng.random() < 0.8:
                result["k"] = rng.choice([2, 2.05, 3])
            else:
                result["p"] = rng.choice([0.95, 0.9545])
            if rng.random() < 0.3:
                result["nu"] = rng.choice([3, 8, 50, "inf"])
            results.append(result)
        if not results:
            continue
        calibration = {"calibrated": date, "certificate": f"C-{i}", "results": results}
        if rng.random() < 0.85:
            calibration["valid_to"] = later(date, rng.randint(100, 1500))
        calibrations.append(calibration)
        date = later(date, rng.randint(1, 900))
    model = rng.choice(["none", "limit_per_year", "linear", "linear", "linear", "last_difference"])
    drift = {"model": model}
    if model == "none":
        drift["reason"] = "made up"
    elif model == "limit_per_year":
        unit = rng.choice(["V", "mV"])
        drift.update(limit=scale * rng.uniform(0.01, 1) / FACTORS[unit], unit=unit)
    elif model == "linear" and rng.random() < 0.5:
        drift["weights"] = rng.choice(["equal", "by_uncertainty"])
    standard = {"schema": "gumcert/standard/1", "id": f"STD-{number}", "description": "made up",
                "calibrations": calibrations, "drift": drift}
    if rng.random() < 0.7:
        standard["interpolation"] = rng.choice(["none", "nearest", "linear"])
    plan = made_plan(rng, scale, calibrations[-1]["calibrated"])
    if plan:
        standard["interval"] = plan
    return standard, lines


def made_plan(rng, scale, last):
    method = rng.choice([None, "staircase", "control_chart", "control_chart", "in_use_time"])
    if method is None:
        return None
    plan = {"method": method}
    if method == "in_use_time":
        plan["hours"] = rng.randint(50, 3000)
        counter = rng.choice([0, rng.uniform(0, 500)])
        if counter:
            plan["hours_at_calibration"] = counter
        date, readings = last, []
        for _ in range(rng.randint(0, 4)):
            date = later(date, rng.randint(0, 200))
            counter += rng.choice([0, rng.uniform(0, 700)])
            readings.append({"date": date, "hours": counter})
        if readings:
            plan["readings"] = readings
        return plan
    unit = rng.choice(["V", "mV"])
    plan.update(limit=scale * rng.uniform(0.05, 5) / FACTORS[unit], unit=unit)
    if method == "staircase":
        plan.update(present_days=rng.randint(30, 1500), extend_by=rng.uniform(1.05, 2), reduce_by=rng.uniform(0.3, 0.95))
    elif rng.random() < 0.5:
        plan["coverage_factor"] = rng.choice([1, 2, 3])
    if rng.random() < 0.5:
        plan["least_days"] = rng.randint(1, 100)
        plan["most_days"] = rng.randint(100, 3000)
    return plan


def made_use(rng, standard, lines):
    use = {}
    line = rng.choice(lines)
    for key, other in (("quantity", "current"), ("range", "1 kV"), ("mode", "pulsed")):
        if key in line and rng.random() < 0.85:
            use[key] = line[key]
        elif rng.random() < 0.06:
            use[key] = other
    nominals = [one["nominal"] for one in lines if "nominal" in one]
    choice = rng.random()
    if choice < 0.4 and nominals:
        use["at"] = line.get("nominal", nominals[0]) * rng.choice([1, 1 + 1e-12])
    elif choice < 0.85 and (nominals or "low" in line):
        values = nominals or [line["low"], line["high"]]
        use["at"] = rng.uniform(min(values) - 3, max(values) + 3)
    first, last = standard["calibrations"][0], standard["calibrations"][-1]
    where = rng.random()
    if where < 0.7:
        use["date"] = later(last["calibrated"], rng.randint(0, 1800))
    elif where < 0.95:
        use["date"] = later(first["calibrated"], rng.randint(-100, 3000))
    return use


# ---- the second opinion -------------------------------------------------------------------------------------------------

def k_of(result):
    if "k" in result:
        return result["k"]
    nu = result.get("nu", "inf")
    half = (1 + result["p"]) / 2
    if nu == "inf":
        return stats.norm.ppf(half)
    k = stats.t.ppf(half, nu)  # good to 1e-9; one step of Newton's method makes it as good as the distribution itself
    return k - (stats.t.cdf(k, nu) - half) / stats.t.pdf(k, nu)


def same(a, b):
    return abs(a - b) <= SAME * max(abs(a), abs(b))


def calibration_for(standard, date):
    fitting = [c for c in standard["calibrations"] if not date or c["calibrated"] <= date]
    return max(fitting, key=lambda c: c["calibrated"]) if fitting else None


def lines_for(standard, use):
    """The calibration, the lines that are left, what is said, and whether these are of one quantity, range and mode."""
    said = []
    date = use.get("date", "")
    calibration = calibration_for(standard, date)
    if calibration is None:
        return None, [], ["no"], True
    last_day = calibration.get("valid_to") or (planned_day(standard, calibration, date) if date else None)
    if not date or not last_day:
        said.append("unknown")
    elif date > last_day:
        said.append("no")
    left = calibration["results"]
    wanted = use.get("quantity", "")
    if wanted:
        left = [r for r in left if r.get("quantity", "") == wanted]
        if not left:
            return calibration, [], said + ["no"], True
    elif len({r.get("quantity", "") for r in left}) > 1:
        return calibration, left, said + ["unknown"], False
    for key in ("range", "mode"):
        wanted = use.get(key, "")
        there = {r.get(key, "") for r in left}
        if not wanted:
            if len(there) > 1:
                return calibration, left, said + ["unknown"], False
        elif wanted in there:
            left = [r for r in left if r.get(key, "") == wanted]
        elif "" in there:
            said.append("unknown")
            left = [r for r in left if r.get(key, "") == ""]
        else:
            return calibration, [], said + ["no"], True
    return calibration, left, said, True


def hits(result, at):
    return ("nominal" in result and same(result["nominal"], at)) or \
        ("low" in result and result["low"] <= at <= result["high"])


def applicable(standard, use):
    _, left, said, _ = lines_for(standard, use)
    if left and "at" not in use:
        said = said + (["unknown"] if len(left) > 1 else [])
    elif left and not any(hits(r, use["at"]) for r in left):
        nominals = [r["nominal"] for r in left if "nominal" in r]
        if any("nominal" not in r and "low" not in r for r in left):
            said = said + ["unknown"]
        elif nominals and min(nominals) < use["at"] < max(nominals):
            said = said + (["unknown"] if standard.get("interpolation", "none") == "none" else [])
        else:
            said = said + ["no"]
    return "no" if "no" in said else "unknown" if "unknown" in said else "yes"


def history(standard, calibration, line):
    """Rows of days, value [V], u [V], up to the calibration."""
    rows = []
    for c in standard["calibrations"]:
        if c["calibrated"] > calibration["calibrated"]:
            continue
        for r in c["results"]:
            one = all(r.get(k, "") == line.get(k, "") for k in ("quantity", "range", "mode"))
            if one and r.get("nominal") == line.get("nominal"):
                days = (day(c["calibrated"]) - day(calibration["calibrated"])).days
                rows.append((days, r["value"] * FACTORS[r["unit"]], r["U"] / k_of(r) * FACTORS[r["unit"]]))
                break
    return np.array(rows, dtype=float)


def line_drift(rows, weighted, days):
    """(D, u, nu) of the straight line at each of the days; None where there is none."""
    if len(rows) < 3:
        return None
    t, y, u = rows.T
    weights = 1 / u**2 if weighted else np.ones(len(t))
    # Days in units of their span and values as differences: the normal equations are then well conditioned.
    span = max(-t[0], 1.0)
    design = np.column_stack([np.ones(len(t)), t / span])
    root = np.sqrt(weights)
    p = np.linalg.lstsq(design * root[:, None], (y - y[-1]) * root, rcond=None)[0]
    covariance = np.linalg.inv(design.T @ (design * weights[:, None]))
    squares = np.sum(weights * (y - y[-1] - design @ p) ** 2)
    nu = len(t) - 2
    at = np.column_stack([np.ones(len(days)), np.asarray(days, dtype=float) / span])
    of_line = np.einsum("ij,jk,ik->i", at, covariance, at)
    if not weighted:
        return at @ p, np.sqrt(squares / nu * (1 + of_line)), nu, math.sqrt(squares / nu)
    excess = max(1.0, squares / nu)
    return (at @ p, np.sqrt(excess * of_line + (excess - 1) * u[-1] ** 2), nu if squares > nu else None,
            math.sqrt(excess) * u[-1])


def drift(standard, calibration, line, days):
    """(D, u, half width, nu) in V, or the code of what cannot be said."""
    model = standard["drift"]
    if model["model"] == "none":
        return 0.0, 0.0, 0.0, None
    if model["model"] == "limit_per_year":
        half = model["limit"] * FACTORS[model["unit"]] * days / YEAR
        return 0.0, half / math.sqrt(3), half, None
    rows = history(standard, calibration, line)
    if model["model"] == "last_difference":
        if len(rows) < 2:
            return "GC-LAB-0011"
        interval = rows[-1, 0] - rows[-2, 0]
        half = abs(rows[-1, 1] - rows[-2, 1]) * (days / interval if days > interval else 1)
        return 0.0, half / math.sqrt(3), half, None
    found = line_drift(rows, model.get("weights") == "by_uncertainty", [days])
    if found is None:
        return "GC-LAB-0012"
    return float(found[0][0]), float(found[1][0]), 0.0, found[2]


def worth(standard, use):
    calibration, left, _, is_one = lines_for(standard, use)
    if not left or not is_one:
        return {"code": "GC-LAB-0014"}
    days = (day(use["date"]) - day(calibration["calibrated"])).days if use.get("date") else 0
    at = use.get("at")
    exact = None
    if at is None:
        exact = left[0] if len(left) == 1 else None
        if exact is None:
            return {"code": "GC-LAB-0014"}
    else:
        exact = next((r for r in left if "nominal" in r and same(r["nominal"], at)), None) or \
            next((r for r in left if "low" in r and r["low"] <= at <= r["high"]), None)
    if exact is not None:
        moved = drift(standard, calibration, exact, days)
        if isinstance(moved, str):
            return {"code": moved}
        return answer(exact["value"], exact["U"] / k_of(exact), 0.0, moved, exact["unit"])
    points = sorted((r for r in left if "nominal" in r), key=lambda r: r["nominal"])
    below = [r for r in points if r["nominal"] <= at]
    above = [r for r in points if r["nominal"] > at]
    how = standard.get("interpolation", "none")
    if not below or not above or how == "none":
        return {"code": "GC-LAB-0014"}
    if how == "linear" and len(points) < 3:
        return {"code": "GC-LAB-0015"}
    a, b = below[-1], above[0]
    one_unit = a.get("nominal_unit", a["unit"]) == a["unit"]
    c = {id(r): r["value"] - (r["nominal"] if one_unit else 0.0) for r in points}
    h = b["nominal"] - a["nominal"]
    base = at if one_unit else 0.0
    if how == "nearest":
        if one_unit and abs(b["value"] - a["value"]) < abs(c[id(b)] - c[id(a)]):
            base, c = 0.0, {id(r): r["value"] for r in points}
        near = a if at - a["nominal"] <= b["nominal"] - at else b
        moved = drift(standard, calibration, near, days)
        if isinstance(moved, str):
            return {"code": moved}
        error = abs(c[id(b)] - c[id(a)]) / h * abs(at - near["nominal"])
        return answer(base + c[id(near)], near["U"] / k_of(near), error, moved, near["unit"])
    l = (at - a["nominal"]) / h
    low, high = drift(standard, calibration, a, days), drift(standard, calibration, b, days)
    for one in (low, high):
        if isinstance(one, str):
            return {"code": one}
    i = points.index(a)
    bend = 0.0
    for three in (points[max(i - 1, 0) : i + 2], points[i : i + 3]):
        if len(three) == 3:
            # The leading coefficient of the parabola through three points.
            x = np.array([r["nominal"] for r in three], dtype=float) - three[1]["nominal"]
            y = np.array([c[id(r)] for r in three])
            bend = max(bend, abs(np.linalg.solve(np.vander(x, 3), y - y[1])[0]))
    mixed = [(1 - l) * p + l * q for p, q in zip(low[:3], high[:3])]
    nus = [n for n in (low[3], high[3]) if n is not None]
    moved = (*mixed, min(nus) if nus else None)
    u = (1 - l) * a["U"] / k_of(a) + l * b["U"] / k_of(b)
    return answer(base + (1 - l) * c[id(a)] + l * c[id(b)], u, abs((at - a["nominal"]) * (b["nominal"] - at)) * bend,
                  moved, a["unit"])


def answer(value, u, interpolation, moved, unit):
    """Drifts are computed in V."""
    drift, drift_u, half = (number / FACTORS[unit] for number in moved[:3])
    return {"value": value, "u": u, "interpolation": interpolation, "drift": drift, "drift_u": drift_u,
            "drift_half_width": half, "drift_nu": moved[3]}


def planned_day(standard, calibration, date):
    """The next calibration as it was known on a day: the earliest of those of the lines; None where none can be said."""
    plan = standard.get("interval")
    is_last = calibration is standard["calibrations"][-1]
    if plan is None or not (is_last or plan["method"] == "control_chart"):
        return None
    then = {**standard, "calibrations": [c for c in standard["calibrations"]
                                         if c["calibrated"] <= calibration["calibrated"]]}
    if "readings" in plan:
        then["interval"] = {**plan, "readings": [r for r in plan["readings"] if r["date"] <= date]}
    days = [found["due"] for found, _ in (interval(then, line) for line in calibration["results"]) if "due" in found]
    return min((d for d in days if d), default=None)


def interval(standard, line=None):
    """(days, due), the code of what cannot be said, or None. With it how near the decision was."""
    plan = standard.get("interval")
    if plan is None:
        return None, 1.0
    last = standard["calibrations"][-1]
    line = line or last["results"][0]
    least, most = plan.get("least_days", 1), plan.get("most_days", 3653)
    if plan["method"] == "in_use_time":
        readings = plan.get("readings", [])
        begun = plan.get("hours_at_calibration", 0)
        if not readings:
            return {"days": 0, "due": ""}, 1.0
        used = readings[-1]["hours"] - begun
        since = (day(readings[-1]["date"]) - day(last["calibrated"])).days
        if used <= 0 or since <= 0:
            return {"days": 0, "due": ""}, 1.0
        left = min(max((plan["hours"] - used) * since / used, -1e6), 1e6)  # no day beyond what a calendar has
        days = since + math.floor(left)
        return {"days": days, "due": later(last["calibrated"], days)}, abs(left - round(left))
    limit = plan["limit"] * FACTORS[plan["unit"]]
    rows = history(standard, last, line)
    if plan["method"] == "staircase":
        days, distance = plan["present_days"], 1.0
        if len(rows) > 1:
            found = abs(rows[-1, 1] - rows[-2, 1])
            factor = plan["extend_by"] if found <= 0.8 * limit else plan["reduce_by"] if found > limit else 1
            days = min(max(math.floor(days * factor), least), most)
            distance = min(abs(found / limit - 0.8), abs(found / limit - 1))
        return {"days": days, "due": later(last["calibrated"], days)}, distance
    weighted = standard["drift"].get("weights") == "by_uncertainty"
    walk = line_drift(rows, weighted, np.arange(0, most + 1))
    if walk is None:
        return {"code": "GC-LAB-0012"}, 1.0
    bound = np.abs(walk[0]) + plan.get("coverage_factor", 2) * walk[1]
    broken = np.flatnonzero(bound > limit)
    days = most if len(broken) == 0 else max(int(broken[0]) - 1, 0)
    near = float(np.min(np.abs(bound / limit - 1)))
    days = max(days, min(least, most))
    return {"days": days, "due": later(last["calibrated"], days)}, near


# ---- the comparison -----------------------------------------------------------------------------------------------------

def number_differs(key, a, b, scale):
    if a is None or b is None:
        return a is not b
    # Sums of squares lose half of the digits where points lie on a line: relative to the spread of the history.
    allowed = 1e-9 * max(abs(a), abs(b)) + (1e-7 if key.startswith("drift_u") else 1e-11) * scale
    return abs(a - b) > allowed


def differences(standard, use, said):
    found = []
    if "refused" in said:
        return [f"refused: {said['refused']}"]
    if said["applicable"] != applicable(standard, use):
        found.append(f"applicable: {said['applicable']}, expected {applicable(standard, use)}")
    expected = worth(standard, use)
    if set(said["value"]) != set(expected) or said["value"].get("code") != expected.get("code"):
        found.append(f"value: {said['value']}, expected {expected}")
    elif "code" not in expected:
        values = [abs(r["value"]) * FACTORS[r["unit"]] for c in standard["calibrations"] for r in c["results"]]
        unit = calibration_for(standard, use.get("date", ""))["results"][0]["unit"]
        scale = max(values) / FACTORS[unit]
        found += [f"{key}: {said['value'][key]}, expected {expected[key]}" for key in expected
                  if number_differs(key, said["value"][key], expected[key], scale)]
    days, distance = interval(standard)
    # A day is decided by numbers that are the same to rounding: where they are on the edge, both answers are right.
    if said["interval"] != days and distance > 1e-9:
        found.append(f"interval: {said['interval']}, expected {days}")
    return found


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--driver", required=True, type=pathlib.Path)
    arguments.add_argument("--histories", type=int, default=6000)
    arguments.add_argument("--seed", type=int, default=1)
    options = arguments.parse_args()
    rng = random.Random(options.seed)
    cases = []
    for number in range(options.histories):
        standard, lines = made_standard(rng, number)
        cases.append((standard, made_use(rng, standard, lines)))
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "cases.jsonl"
        file.write_text("".join(json.dumps({"standard": s, "use": u}) + "\n" for s, u in cases), encoding="utf-8")
        ran = subprocess.run([options.driver, file], capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        sys.exit(f"{options.driver} ended with {ran.returncode}: {ran.stderr}")
    answers = [json.loads(line) for line in ran.stdout.splitlines()]
    if len(answers) != len(cases):
        sys.exit(f"{len(answers)} answers to {len(cases)} histories")
    wrong = 0
    counts = {}
    for (standard, use), said in zip(cases, answers):
        for key in (said.get("applicable"), standard["drift"]["model"], standard.get("interval", {}).get("method"),
                    said.get("value", {}).get("code", "a value")):
            counts[key] = counts.get(key, 0) + 1
        found = differences(standard, use, said)
        if found:
            wrong += 1
            if wrong <= 10:
                print(f"{standard['id']}, use {json.dumps(use)}:", *found, sep="\n    ")
    print(f"{len(cases)} histories, seed {options.seed}: {wrong} differ")
    print(", ".join(f"{key} {count}" for key, count in sorted(counts.items(), key=lambda c: str(c[0])) if key))
    # Every answer occurs, so that none is left untested.
    least = len(cases) / 100
    rare = [key for key in ("yes", "no", "unknown", "none", "limit_per_year", "linear", "last_difference", "staircase",
                            "control_chart", "in_use_time", "a value") if counts.get(key, 0) < least]
    if rare:
        print("hardly tested:", ", ".join(rare))
    return 1 if wrong or rare else 0


if __name__ == "__main__":
    sys.exit(main())
