#!/usr/bin/env python3
"""Writes the sets that the audit is proved on.

    make_sets.py [--seed N] --into DIR

DIR/sound     20 sound budgets of different fields, as tables that laboratories might have
DIR/planted   100 of the same with one error each, five for each budget
DIR/expected.json   what was planted where, which rules may tell of it, and what the sound budget gives

The same seed gives the same bytes. An error that would change nothing that is printed is not planted: the numbers of the
budget are drawn again until each of its five errors changes the printed U, the verdict, E_n or k.
"""

import argparse
import json
import math
import pathlib
import random
import sys

from budgets import FIELDS, GERMAN, Draw
from errors import KINDS, PLANTED
from tables import as_csv, claims_of, left_open, outcome, printed_sensitivity, reported, significant

DEFAULT_SEED = 17025
MOST_DRAWS = 4000


def drawn(field, dice):
    """A sound budget and the draw that it came from."""
    german = field in GERMAN
    draw = Draw(dice, "de" if german else "en", "," if german else ".", short_divisors=field.__name__ in ("pt100", "hardness"))
    budget = field(draw)
    budget.language, budget.layout.decimal = draw.language, draw.decimal
    found = outcome(budget)
    if budget.capability is not None:
        budget.capability = float(f"{0.8 * found['U']:.1e}")
    if budget.reference:
        U_ref = float(f"{0.8 * found['U']:.1e}")
        difference = dice.choice((-1.0, 1.0)) * dice.uniform(0.4, 0.7) * math.hypot(found["U"], U_ref)
        budget.reference = (float(f"{budget.value - difference:.3g}"), U_ref)
    return budget, draw


def is_sound(budget):
    """What a laboratory would not do in this budget: k = 2 with few degrees of freedom, one row that is nearly all, a value
    at its limit; and an E_n that shows nothing."""
    found = outcome(budget)
    largest = max(row.contribution for row in budget.rows)
    if budget.coverage == "two" and found["nu_eff"] < 60.0 or largest ** 2 > 0.8 * found["u_c"] ** 2:
        return False
    if budget.limits and (found["U"] > 0.45 * budget.limits[1] or abs(budget.value) > budget.limits[1] - 1.5 * found["U"]):
        return False
    return not budget.reference or 0.3 < abs(float(claims_of(budget)["en"])) < 0.85


def missing_contribution(budget):
    """The least contribution that changes the printed U, of the digits that the table prints."""
    read = budget.copy()
    for row in read.rows:
        if row.u:
            row.stated, row.divisor = float(significant(row.u, budget.layout.digits)[0]), 1.0
            row.c = float(printed_sensitivity(row.c)[0])
    before = significant(outcome(read)["U"], 2)[0]
    low, high = 0.0, outcome(read)["u_c"]
    while high - low > 1e-4 * high:
        middle = 0.5 * (low + high)
        if significant(outcome(read, middle)["U"], 2)[0] != before:
            high = middle
        else:
            low = middle
    return high


def planted(sound, kind, key, draw):
    """The budget with one error and what is expected of the audit; nothing where the error shows in no printed number."""
    budget = sound.copy()
    expected = KINDS[kind](budget, budget.row(key) if key else None, draw)
    if not expected.pop("fits", True):
        return None
    right, wrong = outcome(sound), outcome(budget)
    wrong.update({name: value for name, value in budget.claimed.items() if name in wrong and not isinstance(value, str)})
    texts = claims_of(budget)
    shown = texts.get("reported", texts["U"])
    U = expected.get("U", reported(sound, right))
    if expected["effect"] == "corrected":
        visible = expected.pop("printed", shown) != significant(U, 2)[0]
        change = abs(math.log(float(shown) / U))
        tolerance = left_open(sound, right)
        if not visible or change < 1.5 * tolerance:
            return None
        expected["tolerance"] = tolerance
    if expected["effect"] == "missing":
        expected["number"] = missing_contribution(budget)
        if significant(wrong["U"], 2)[0] == significant(right["U"], 2)[0]:
            return None
    if expected["effect"] == "bound":
        expected["tolerance"] = left_open(sound, right)
    if "number" in expected and "half" in expected and kind == "k loses its digits" and abs(right["k"] - round(right["k"])) < 0.12:
        return None
    if kind == "E_n with one U" and abs(float(texts["en"]) - expected["number"]) < 0.06:
        return None
    expected.update(kind=kind, claimed_U=shown, U=U)
    return budget, expected


def make_field(number, field, seed):
    """(sound budget, [(planted budget, expected)]) of a field."""
    dice = random.Random(f"{seed}/{field.__name__}")
    for _ in range(MOST_DRAWS):
        sound, draw = drawn(field, dice)
        if not is_sound(sound):
            continue
        all_planted = []
        for kind, key in PLANTED[sound.slug]:
            one = planted(sound, kind, key, draw)
            if one is None:
                break
            all_planted.append(one)
        else:
            return sound, all_planted
    sys.exit(f"{field.__name__}: no numbers were found with which all of its errors show in print")


def make(seed):
    """All files of the sets: bytes by name."""
    files, expected = {}, {}
    for number, field in enumerate(FIELDS, start=1):
        sound, all_planted = make_field(number, field, seed)
        stem = f"{number:02d}_{sound.slug}"
        files[f"sound/{stem}.csv"] = as_csv(sound)
        expected[f"sound/{stem}.csv"] = {"U": reported(sound, outcome(sound)),
                                         "tolerance": left_open(sound, outcome(sound))}
        for letter, (budget, said) in zip("abcde", all_planted):
            name = f"planted/{stem}_{letter}.csv"
            files[name] = as_csv(budget)
            expected[name] = {key: float(f"{value:.6g}") if isinstance(value, float) else value for key, value in said.items()}
    text = json.dumps({"seed": seed, "files": expected}, ensure_ascii=False, indent=1, sort_keys=True)
    files["expected.json"] = (text + "\n").encode("utf-8")
    return files


def write(files, folder):
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="The sets that the audit is proved on.")
    parser.add_argument("--seed", type=int, default=DEFAULT_SEED)
    parser.add_argument("--into", type=pathlib.Path, required=True, metavar="DIR")
    arguments = parser.parse_args()
    write(make(arguments.seed), arguments.into)
