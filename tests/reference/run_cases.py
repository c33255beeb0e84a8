#!/usr/bin/env python3
"""Published reference cases through the command line of the program.

    run_cases.py --program FILE --cases DIR [--only ID ...] [--jobs N] [--keep DIR] [--verbose]

Each case (a JSON file; INDEX.md beside them states the format) is translated into one or more jobs of kind budget or
comparison, by its procedure and never by its name. `gumcert evaluate` runs them, and every expected number is looked up
in the records, by its kind and quantity. Two numbers agree within the tolerance of the case, or half a unit of the last
printed digit where it states none. A number that cannot be looked up needs a reason in one line: see NOT_LOOKED_UP.

Exit code: 0 all cases pass; 1 a failure, or a number without a look-up and without a reason; 77 there are no cases.
"""

import argparse
import ast
import concurrent.futures
import dataclasses
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
from decimal import Decimal, InvalidOperation

SHARE = pathlib.Path(__file__).resolve().parents[2]  # holds templates/ with the profiles of certificates
FEW_TRIALS = 1_000_000
MANY_TRIALS = 10_000_000
NUMERICAL_ERRORS = 5  # how many of them an exact value may be away from a Monte Carlo one
LEAST_LRE = {"linear_fit_ols": 9.0, "nonlinear_least_squares": 8.0}  # digits that agree with certified parameters

# Expected numbers without a look-up: procedure, kind and quantity (patterns of the whole text), and why.
NOT_LOOKED_UP = (
    (r"lpu", r"decision_threshold|detection_limit", r".*",
     "characteristic limits of ISO 11929: not a calculation of this program"),
    (r"lpu", r"(u_)?best_estimate(_nonnegative)?|interval_(low|high)_nonnegative", r".*",
     "estimate that is known not to be negative (ISO 11929): not a calculation of this program"),
    (r"lpu", r"y|u", r"v_without_factor_2",
     "quantity of another model than the one that the case states (see its notes)"),
    (r"anova_.*", r"F_critical", r"F_0\.975.*", "the record holds the critical value of F at 5 % only"),
    (r"conformity_probability", r"cpk", r".*", "process capability index: not a calculation of this program"),
    (r"decision_rule", r"limit", r"rejection_.*",
     "the record holds no rejection limits; the verdicts show them, and the unit tests of gum/conformity look them up"),
    (r"rounding", r"rounded_u", r".*round up.*",
     "the program rounds to the nearest; a job cannot ask for rounding up"),
    (r"random_effects_mean", r"between_std", r"tau_cochran_anova",
     "the record holds no Cochran estimate of the spread between laboratories; the unit tests of gum/random_effects "
     "look it up"),
    (r"algorithm_a_and_s", r"robust_pooled_std_full", r"w\*",
     "computed with the factors of the table, rounded to 0.001; the program takes exact ones, and the unit tests of "
     "gum/robust_statistics look it up with the rounded ones"),
)


class Unexplained(Exception):
    """An expected number that no rule looks up."""


class Refused(Exception):
    """The program did not evaluate a job."""


@dataclasses.dataclass
class Found:
    """What the record says: a number, a truth or a text."""

    value: object
    unit: str | None = None  # none: the unit that the case means
    error: float = 0.0  # standard uncertainty from the finite number of Monte Carlo trials
    how: str = ""  # said with --verbose
    convention: str = ""  # why the source has another number than the result of the program; always said


# ---- units ----------------------------------------------------------------------------------------------------------

PREFIXES = {"": 1.0, "n": 1e-9, "u": 1e-6, "µ": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6, "G": 1e9}
BASE_UNITS = ("ohm", "degC", "Pa", "Hz", "Bq", "rad", "mol", "dB", "m", "g", "s", "A", "K", "V", "J", "N", "W", "L")
COHERENT = {"J": {"kg": 1, "m": 2, "s": -2}, "Pa": {"kg": 1, "m": -1, "s": -2}, "N": {"kg": 1, "m": 1, "s": -2}}
FUNCTIONS_OF_AN_ANGLE = ("sin", "cos", "tan")
FUNCTIONS_TO_AN_ANGLE = ("asin", "acos", "atan", "atan2")
FUNCTIONS = {"sqrt", "exp", "ln", "log", "log10", "abs", "min", "max", "pow", "hypot", "sinh", "cosh", "tanh", "pi",
             *FUNCTIONS_OF_AN_ANGLE, *FUNCTIONS_TO_AN_ANGLE}
UNIT_REFUSALS = re.compile(r"GC-UNIT-\d+|GC-MODEL-003\d|GC-INPUT-0318")


def product(a, b, power=1):
    merged = dict(a)
    for name, exponent in b.items():
        merged[name] = merged.get(name, 0) + power * exponent
    return {name: exponent for name, exponent in merged.items() if exponent}


def program_unit(text):
    """A unit of a case as the program reads it."""
    return {"": "1", "C": "degC"}.get(text, text.replace("Ohm", "ohm"))


def parse_unit(text):
    """"kg/m3" → {"kg": 1, "m": -3}"""
    unit, sign, outer = {}, 1, []
    for token in re.findall(r"[^\s/()\d^.-]+(?:\^?-?\d+)?|[/()]", text):
        if token == "/":
            sign = -1
        elif token == "(":
            outer.append(sign)
            sign = 1
        elif token == ")":
            outer.pop()
            sign = 1
        else:
            name, exponent = re.fullmatch(r"([^\d^-]+)\^?(-?\d+)?", token).groups()
            unit = product(unit, {program_unit(name): 1}, sign * math.prod(outer) * int(exponent or 1))
            sign = 1
    return unit


def unit_text(unit):
    """As the program reads it."""
    if any(exponent != int(exponent) for exponent in unit.values()):
        whole = {}
        for name, exponent in unit.items():
            whole = product(whole, COHERENT.get(name, {name: 1}), exponent)
        unit = whole
    return " ".join(name + ("" if e == 1 else f"{e:g}") for name, e in sorted(unit.items(), key=lambda x: -x[1])) or "1"


def factor_of(text):
    """Of a unit to its base units, and these."""
    factor, base = 1.0, {}
    for name, exponent in parse_unit(text).items():
        for known in BASE_UNITS:
            if name.endswith(known) and name[:-len(known)] in PREFIXES:
                factor *= PREFIXES[name[:-len(known)]] ** exponent
                base = product(base, {known: 1}, exponent)
                break
        else:
            raise Unexplained(f"the unit {name} is not known here")
    return factor, base


def converted(value, unit, wanted):
    if wanted is None or unit is None or unit_text(parse_unit(unit)) == unit_text(parse_unit(wanted)):
        return value
    from_factor, from_base = factor_of(unit)
    to_factor, to_base = factor_of(wanted)
    if from_base != to_base:
        raise Unexplained(f"found in {unit}, expected in {wanted}")
    return value * from_factor / to_factor


def unit_of_formula(formula, units):
    """The unit that the numbers of a formula have, with every quantity in its own unit. A sum has the unit of its first
    term that has one: published formulas hold bare numbers."""

    def visit(node):
        if isinstance(node, ast.Constant):
            return {}
        if isinstance(node, ast.Name):
            return units.get(node.id, {})
        if isinstance(node, ast.UnaryOp):
            return visit(node.operand)
        if isinstance(node, ast.BinOp):
            left, right = visit(node.left), visit(node.right)
            if isinstance(node.op, (ast.Add, ast.Sub)):
                return left or right
            if isinstance(node.op, (ast.Mult, ast.Div)):
                return product(left, right, 1 if isinstance(node.op, ast.Mult) else -1)
            exponent = ast.literal_eval(node.right) if left else 1
            return product({}, left, exponent)
        if isinstance(node, ast.Call):
            if node.func.id in FUNCTIONS_TO_AN_ANGLE:
                return {"rad": 1}
            inner = visit(node.args[0])
            return product({}, inner, 0.5) if node.func.id == "sqrt" else (
                inner if node.func.id in ("abs", "min", "max", "hypot") else {})
        raise Unexplained(f"the formula {formula} is not understood here")

    return visit(ast.parse(formula.replace("^", "**"), mode="eval").body)


def names_of(formula):
    """Names of quantities, in the order of appearance."""
    names = re.findall(r"(?<![\w.])[A-Za-z_]\w*", formula)
    return [name for name in dict.fromkeys(names) if name not in FUNCTIONS]


def with_plain_angles(formula):
    """sin(x) of a number is sin(x*rad), and the number of atan(x) is atan(x)/rad."""
    out, position = "", 0
    for call in re.finditer(r"(?<!\w)(a?(?:sin|cos|tan)2?)\(", formula):
        if call.start() < position:
            continue
        depth, end = 1, call.end()
        while depth:
            depth += {"(": 1, ")": -1}.get(formula[end], 0)
            end += 1
        inside = with_plain_angles(formula[call.end():end - 1])
        name = call.group(1)
        out += formula[position:call.start()]
        out += f"({name}({inside})/rad)" if name in FUNCTIONS_TO_AN_ANGLE else f"{name}(({inside})*rad)"
        position = end
    return out + formula[position:]


# ---- the program ----------------------------------------------------------------------------------------------------


class Program:
    """Runs jobs of one case."""

    def __init__(self, program, folder):
        self.program, self.folder, self.count = program, folder, 0
        self.said = []  # what a person may want to know, for --verbose

    def evaluate(self, job, name="job"):
        """\\return the record, and the exit code (1: not validated where validation was asked for)
        \\throws Refused"""
        self.count += 1
        stem = f"{self.count:02d}-{name}"
        job = {"schema": "gumcert/job/1", "kind": "budget", **job}
        job_file, record_file = self.folder / f"{stem}.json", self.folder / f"{stem}-record.json"
        job_file.write_text(json.dumps(job, indent=1, ensure_ascii=False), encoding="utf-8")
        share = ["--share", SHARE] if "certificate" in job else []
        done = subprocess.run([self.program, "evaluate", job_file, "-o", record_file, "--quiet", "--json-messages",
                               "--threads", "1", *share], capture_output=True, text=True, encoding="utf-8", errors="replace",
                              check=False, timeout=550)
        messages = []
        for line in done.stderr.splitlines():
            try:
                messages.append(json.loads(line))
            except json.JSONDecodeError:
                messages.append({"code": "", "what": line, "severity": "error"})
        if done.returncode not in (0, 1) or not record_file.exists():
            refusal = Refused(f"exit code {done.returncode} of {stem}: " + "; ".join(
                f"{m.get('where', '')} — {m.get('what', '')} — {m.get('rule', '')} [{m.get('code', '')}]"
                for m in messages if m.get("severity") == "error")[:400])
            refusal.codes = [m.get("code", "") for m in messages if m.get("severity") == "error"]
            raise refusal
        record = json.loads(record_file.read_text(encoding="utf-8"))
        record["exit_code"] = done.returncode
        return record


def probability_of(k):
    return math.erf(k / math.sqrt(2.0))


# ---- look-ups of each procedure -------------------------------------------------------------------------------------


class Lookup:
    """Jobs of one case and the numbers in their records. A class for each procedure finds an expected entry."""

    def __init__(self, case, program):
        self.case, self.program = case, program
        self.options = case.get("options") or {}
        self.data = case.get("data") or {}
        self.records = {}

    def record(self, key, make_job):
        """Of a job that is run once."""
        if key not in self.records:
            try:
                self.records[key] = self.program.evaluate(make_job(), re.sub(r"\W+", "-", str(key)).strip("-")[:60])
            except Refused as refused:
                self.records[key] = refused
        if isinstance(self.records[key], Refused):
            raise self.records[key]
        return self.records[key]

    def probability(self, entry):
        if "coverage_probability" in entry:
            return entry["coverage_probability"]
        for k in (entry.get("k"), None if "coverage_probability" in self.options else self.options.get("k")):
            if k is not None:
                return probability_of(k)
        return self.options.get("coverage_probability", 0.95)

    def single(self, statement, probability=0.95, monte_carlo=None, reporting=None):
        """Result of a job of one input and no model."""
        job = {"coverage_probability": probability, "inputs": {"x": statement}}
        if monte_carlo:
            job["monte_carlo"] = monte_carlo
        if reporting:
            job["reporting"] = reporting
        record = self.record(("x", json.dumps(statement), probability, str(monte_carlo), str(reporting)), lambda: job)
        return record["results"]["x"]

    def readings(self, name, values, unit="1"):
        """What the record says of repeated readings."""
        job = {"inputs": {name: {"unit": unit, "observations": values}}}
        return self.record(("readings", name), lambda: job)["readings"][0]

    def reading(self, name, values, kind, unit="1"):
        key = {"mean": "mean", "std": "standard_deviation", "u_mean": "standard_deviation_of_mean"}[kind]
        return Found(self.readings(name, values, unit)[key], unit)

    def finish(self):
        """Lines to print, and complaints, that belong to no entry."""
        return [], []


def without_suffix(kind):
    """A kind without what says how the number is printed, in which unit, or by whom."""
    return re.sub(r"_(full|unrounded|[numk]?[mgVAKs]|guide|metrodata|of_these_three_components)$", "", kind)


class Propagation(Lookup):
    """A measurement model: law of propagation, implicit models, Monte Carlo."""

    def __init__(self, case, program):
        super().__init__(case, program)
        self.is_monte_carlo = case["procedure"].startswith("mcm")
        self.inputs = {i["name"]: i for i in case["inputs"]}
        self.mode = 0  # 0 the units of the case, 1 numbers, 2 numbers and angles as numbers
        model = case["model"]
        intermediate = case.get("intermediate") or {}
        if isinstance(intermediate, list):
            intermediate = {k: v for item in intermediate for k, v in item.items()}
        if isinstance(model, str):
            left, right = model.split("=")
            self.unknown = self.options["solve_for"]
            self.equations = {"0": left if right.strip() == "0" else f"({left}) - ({right})"}
            self.outputs = [self.unknown]
        else:
            self.unknown = None
            self.equations = {**intermediate, **model}
            asked = {e["quantity"] for e in case["expected"]}
            self.outputs = [name for name in self.equations if name in model or name in asked]
        self.units = {n: parse_unit(i["unit"]) for n, i in self.inputs.items()}
        for name, formula in self.equations.items():
            self.units[name] = unit_of_formula(formula, self.units)
        self.observed = self.find_observed()

    # -- jobs

    def find_observed(self):
        """Raw readings of the inputs: by the name of the input, with or without a unit behind it."""
        observed = {}
        for key, values in self.data.items():
            if not isinstance(values, list) or not all(isinstance(v, (int, float)) for v in values):
                continue
            for name in self.inputs:
                match = re.fullmatch(re.escape(name) + r"(?:_(?!observations)(\w+)|_observations)?", key)
                if match:
                    unit = match.group(1) or self.inputs[name]["unit"]
                    observed[name] = (values, program_unit(unit))
        if "observations" in self.data:
            means = [e["quantity"] for e in self.case["expected"] if e["kind"] in ("mean", "std", "u_mean")]
            for name in dict.fromkeys(means):
                observed[name] = (self.data["observations"], program_unit(self.inputs[name]["unit"]))
        return observed

    def statement(self, name):
        given = self.inputs[name]
        shape = given["distribution"]
        kind = shape["type"]
        out = {"unit": self.input_unit(name)}
        nu = {} if given["dof"] == "inf" else {"nu": given["dof"]}
        if kind == "constant":
            return {**out, "value": given["estimate"], "constant": True}
        if kind == "normal":
            return {**out, "value": given["estimate"], "u": given["standard_uncertainty"], **nu}
        if kind == "t":
            scale = shape["scale"] if self.is_monte_carlo else given["standard_uncertainty"]
            return {**out, "value": given["estimate"], "u": scale, "nu": shape["dof"]}
        stated = {**out, **self.of_shape(shape), **nu}
        u = given["standard_uncertainty"]
        if "limits" in stated and not self.is_monte_carlo:
            own = self.single({k: v for k, v in stated.items() if k != "unit"})["u"]
            if abs(own - u) > 1e-9 * u:  # the law of propagation takes u, and the source rounded one of the two
                low, high = stated.pop("limits")
                stated.update(value=given["estimate"], half_width=0.5 * (high - low) * u / own)
                if "d" in stated:
                    stated["d"] *= u / own
        return stated

    @staticmethod
    def of_shape(shape):
        """A distribution of a case as the statement of an input."""
        words = {"rectangular": "uniform", "trapezoid": "trapezoidal"}
        kind = shape["type"]
        if "lower" in shape:
            more = {key: shape[key] for key in ("beta", "d") if key in shape}
            return {"limits": [shape["lower"], shape["upper"]], "distribution": words.get(kind, kind), **more}
        keys = {"t": ("location", "scale"), "exponential": ("mean",), "gamma": ("shape", "scale"),
                "lognormal": ("mu", "sigma")}[kind]
        more = {"nu": shape["dof"]} if kind == "t" else {}
        return {"distribution": {"kind": {"t": "student_t"}.get(kind, kind), **{k: shape[k] for k in keys}, **more}}

    def input_unit(self, name):
        unit = program_unit(self.inputs[name]["unit"])
        return unit if self.mode == 0 or unit in ("rad", "deg", "arcsec") else "1"

    def equation(self, formula):
        return with_plain_angles(formula) if self.mode == 2 else formula

    def job(self, probability, monte_carlo, observed):
        inputs = {name: self.statement(name) for name in self.inputs}
        correlations = [[c["a"], c["b"], c["r"]] for c in self.case["correlations"]]
        job = {"title": self.case["title"], "coverage_probability": probability,
               "model": [f"{name} = {self.equation(formula)}" for name, formula in self.equations.items()]}
        if observed:
            for name, (values, unit) in self.observed.items():
                inputs[name] = {"unit": unit if self.mode == 0 or unit == "rad" else "1", "observations": values}
            if correlations:
                job["simultaneous"], correlations = [list(self.observed)], []
        job["inputs"] = inputs
        if correlations:
            job["correlations"] = correlations
        if self.unknown:
            job["solve_for"] = {self.unknown: {"start": self.options.get("initial_guess", 1.0)}}
        else:
            job["outputs"] = {name: {"unit": unit_text(self.units[name])} if self.mode == 0 else {}
                              for name in self.outputs}
        if monte_carlo:
            job["monte_carlo"] = monte_carlo
        return job

    def evaluate(self, probability, trials=None, observed=False):
        settings = None
        if trials:
            kinds = {e["kind"] for e in self.case["expected"]}
            settings = {"trials": trials, "seed": 1}
            if kinds & {"guf_validated", "validation_distance"}:
                settings["validate"] = True
                settings["digits"] = self.options.get("significant_digits_for_validation", 2)
        while True:
            key = ("model", probability, trials or "law", "observed" if observed else "stated", self.mode)
            try:
                return self.record(key, lambda: self.job(probability, settings, observed))
            except Refused as refused:
                if self.mode == 2 or not any(UNIT_REFUSALS.fullmatch(code) for code in refused.codes):
                    raise
                self.mode += 1
                self.program.said.append(
                    "the units of the case do not balance: " + str(refused).split(": ", 1)[-1] + "; run again "
                    + ("with numbers" if self.mode == 1 else "with numbers, angles too"))

    def unit_of(self, name):
        """Of a number that the case means: None stands for it as well."""
        unit = self.units.get(name) if name in self.units else {}
        return unit_text(unit) if unit else None

    # -- look-ups

    def find(self, entry):
        kind, quantity = entry["kind"], entry["quantity"]
        if quantity in self.inputs and quantity not in self.outputs:
            return self.find_input(entry)
        if kind in ("mean_second_approach", "u_second_approach"):
            return self.find_second_approach(entry)
        match = re.fullmatch(r"(?:1-)?r\((\w+),(\w+)\)", quantity)
        if match:
            return self.find_correlation(entry, *match.groups())
        if re.fullmatch(r"\(\w+(,\w+)+\)", quantity):
            return self.find_region(entry)
        if kind in ("guf_validated", "validation_distance"):
            return self.find_validation(entry)
        if quantity not in self.outputs:
            return self.find_sum_of_components(entry)
        if kind.startswith(("mcm_", "shortest_", "mean_exact", "u_exact")) or (
                self.is_monte_carlo and kind.startswith("interval_")):
            return self.find_monte_carlo(entry)
        found = [self.find_law(entry, self.evaluate(self.probability(entry)), quantity)]
        if self.is_monte_carlo and kind in ("y", "u") and disagreement(entry, found[0]):
            return self.find_monte_carlo({**entry, "kind": f"mcm_{kind}"})
        if set(self.observed) == set(self.inputs) and without_suffix(kind) in ("y", "u"):
            found.append(self.find_law(entry, self.evaluate(self.probability(entry), observed=True), quantity))
        return found

    def scale(self, kind):
        return (kind[:-len("_1e-6")], 1e6) if kind.endswith("_1e-6") else (kind, 1.0)

    def find_law(self, entry, record, quantity):
        kind, scale = self.scale(entry["kind"])
        kind = without_suffix(re.sub(r"^guf_(first_order_)?", "", kind))
        result = record["results"][quantity]
        unit = self.unit_of(quantity)
        if kind == "y":
            return Found(result["value"] * scale, unit)
        if kind == "u" and self.case["procedure"] == "lpu_second_order" or kind == "u_second_order":
            return Found(result["second_order"]["u"], unit, how="with second-order terms")
        if kind in ("u", "u_first_order"):
            # Where the first-order terms vanish, the result has u of the second order.
            second = result["second_order"]
            return Found((second["first_order_u"] if second else result["u"]) * scale, unit)
        if kind in ("u_rel_percent", "u_rel", "relative_u"):
            return Found(result["u"] / abs(result["value"]) * (100.0 if kind.endswith("percent") else 1.0))
        if kind == "variance":
            return Found(result["u"] ** 2, unit, how="u²")
        if kind == "nu_eff":
            return Found(math.inf if result["nu_eff"] is None else result["nu_eff"])
        if kind in ("k", "U", "U_rel_percent"):
            return self.find_expanded(kind, entry, result, unit)
        if kind in ("interval_low", "interval_high"):
            sign = 1.0 if kind.endswith("high") else -1.0
            found = Found(result["value"] + sign * result["U"], unit, how="y ± U")
            if result["coverage"] == "convolution" and disagreement(entry, found):
                k, convention = self.factor_of_degrees_of_freedom(entry, result)
                found = Found(result["value"] + sign * k * result["u"], unit, convention=convention)
            return found
        if kind == "second_order_u":
            return Found(result["second_order"]["u"] * scale, unit)
        if kind in ("second_order_interval_low", "second_order_interval_high"):
            low, high = self.second_order_interval(result, entry)
            return Found(high if kind.endswith("high") else low, unit, how="y ± k u of the second order")
        if kind in ("contribution", "sensitivity"):
            rows = [row for row in result["budget"] if row["input"] in entry["input"].split("+")]
            if len(rows) != len(entry["input"].split("+")):
                raise Unexplained(f"the budget has no row for {entry['input']}")
            if kind == "sensitivity":
                return Found(rows[0]["sensitivity"])
            return Found(math.hypot(*(row["contribution"] for row in rows)), unit)
        raise Unexplained(f"no rule for the kind {entry['kind']} of {self.case['procedure']}")

    def find_expanded(self, kind, entry, result, unit):
        """k and U. Where the source cuts ν_eff to a whole number, or takes k of the dominating input, so does a job of
        one input: the program itself uses ν_eff as it is, and the convolution of all distributions."""
        if str(self.options.get("k_rule", "")).startswith("rectangular dominant") and kind == "k":
            largest = max(result["budget"], key=lambda row: row["contribution"])["input"]
            alone = self.single(self.statement(largest), self.probability(entry))
            return Found(alone["k"], convention=f"k of {largest} alone, which dominates; the program takes the "
                                                f"convolution of all inputs, k = {result['k']:.4f}")
        k, how = result["k"], ""
        own = {"k": k, "U": result["U"], "U_rel_percent": 100.0 * (result["U"] or 0.0) / abs(result["value"] or 1.0)}
        if result["coverage"] == "convolution" and disagreement(entry, Found(own[kind], unit if kind == "U" else None)):
            k, how = self.factor_of_degrees_of_freedom(entry, result)
        elif self.is_cut(entry["quantity"]) and result["nu_eff"] is not None:
            nu = math.floor(result["nu_eff"])
            k = self.single({"value": 0, "u": 1, "nu": result["nu_eff"]}, self.probability(entry),
                            reporting={"degrees_of_freedom": "truncated"})["k"]
            if abs(k - result["k"]) > 1e-9 * k:
                how = (f"ν_eff cut to {nu} as in the source; the program takes {result['nu_eff']:.2f} as it is,"
                       f" k = {result['k']:.4f}")
        if kind == "k":
            return Found(k, convention=how)
        U = result["U"] if not how else k * result["u"]
        if kind == "U_rel_percent":
            return Found(100.0 * U / abs(result["value"]), convention=how)
        return Found(U, unit, convention=how)

    def factor_of_degrees_of_freedom(self, entry, result):
        """k of ν_eff or of the normal distribution, which sources take where the program takes the convolution."""
        nu = {} if result["nu_eff"] is None else {"nu": result["nu_eff"]}
        cut = {"degrees_of_freedom": "truncated"} if nu and self.is_cut(entry["quantity"]) else None
        k = self.single({"value": 0, "u": 1, **nu}, self.probability(entry), reporting=cut)["k"]
        of = "ν_eff" if nu else "the normal distribution"
        return k, (f"k of {of} as in the source, {k:.4f}; the program takes the convolution of all distributions, "
                   f"k = {result['k']:.4f}")

    def is_cut(self, quantity):
        """The source cuts ν_eff: it says so, or prints a whole number."""
        return self.options.get("nu_eff_rounding") == "truncate" or any(
            e["kind"] == "nu_eff" and e["quantity"] == quantity and e["published"] is not None
            and re.fullmatch(r"\d+", str(e["published"])) for e in self.case["expected"])

    def find_input(self, entry):
        name, kind = entry["quantity"], entry["kind"]
        if kind in ("mean", "std", "u_mean") and name in self.observed:
            values, unit = self.observed[name]
            return self.reading(name, values, kind, unit)
        if without_suffix(kind) == "u":
            record = self.evaluate(self.probability(entry))
            row = next(r for r in record["results"][self.outputs[0]]["budget"] if r["input"] == name)
            return Found(row["u"], self.unit_of(name))
        raise Unexplained(f"no rule for the kind {kind} of an input")

    def find_sum_of_components(self, entry):
        """A quantity that the source names and the model gives by its components: d for dbar, d1 and d2."""
        name = entry["quantity"]
        parts = [i for i in self.inputs if re.fullmatch(re.escape(name) + r"(bar|\d+)", i)]
        if len(parts) < 2:
            raise Unexplained(f"the model of the case has no quantity {name}")
        units = {"outputs": {name: {"unit": unit_text(self.units[parts[0]])}}} if self.mode == 0 else {}
        record = self.record(("sum", name), lambda: {
            "model": [name + " = " + " + ".join(parts)], "inputs": {i: self.statement(i) for i in parts}, **units})
        return self.find_law(entry, record, name)

    def find_correlation(self, entry, a, b):
        if entry["kind"].startswith("mcm_"):
            return self.find_monte_carlo_correlation(a, b)
        if a in self.outputs:
            records = [self.evaluate(self.probability(entry))]
            if set(self.observed) == set(self.inputs):
                records.append(self.evaluate(self.probability(entry), observed=True))
        else:
            records = [self.record(("inputs", "observed"), lambda: {
                "inputs": {n: {"unit": unit, "observations": values} for n, (values, unit) in self.observed.items()},
                "simultaneous": [list(self.observed)]})]
        found = []
        for record in records:
            order = record["covariance"]["names"]
            r = record["covariance"]["correlation"][order.index(a)][order.index(b)]
            found.append(Found(1.0 - r if entry["kind"] == "one_minus_correlation" else r))
        return found

    def find_second_approach(self, entry):
        """Each set of readings evaluated (a table of points of constants), the results averaged (observations)."""
        points = [dict(zip(self.observed, values)) for values in zip(*(v for v, _ in self.observed.values()))]
        constants = {n: {"unit": unit, "value": values[0], "constant": True}
                     for n, (values, unit) in self.observed.items()}
        first = self.record("second approach, sets", lambda: {
            **{k: v for k, v in self.job(0.95, None, True).items() if k in ("model", "outputs")},
            "inputs": constants, "points": points})
        values = [first["results"][f"{entry['quantity']}[{i + 1}]"]["value"] for i in range(len(points))]
        kind = "mean" if entry["kind"].startswith("mean") else "u_mean"
        return self.reading(entry["quantity"], values, kind)

    # -- Monte Carlo

    def find_monte_carlo(self, entry):
        wanted, tolerance = entry["value"], entry.get("tolerance") or 0.0
        found = None
        for trials in (FEW_TRIALS, MANY_TRIALS):
            found = self.find_in_trials(entry, self.evaluate(self.probability(entry), trials))
            distance = abs(found.value - wanted)
            is_exact = "exact" in entry["kind"]
            if distance < tolerance or is_exact and distance <= NUMERICAL_ERRORS * found.error:
                break
        return found

    def find_in_trials(self, entry, record):
        kind, scale = self.scale(entry["kind"])
        kind = re.sub(r"_(exact|full)$", "", kind)
        quantity = entry["quantity"]
        mc = record["results"][quantity]["monte_carlo"]
        unit = self.unit_of(quantity)
        error = mc["numerical_error"]
        how = f"{mc['trials']} trials"
        if kind in ("mcm_y", "mean"):
            return Found(mc["mean"] * scale, unit, error["mean"] * scale, how)
        if kind in ("mcm_u", "u"):
            return Found(mc["u"] * scale, unit, error["u"] * scale, how)
        if kind == "mcm_half_width":
            low, high = mc["symmetric"]
            return Found(0.5 * (high - low), unit, 0.5 * math.hypot(*error["symmetric"]), how)
        match = re.fullmatch(r"(?:mcm_)?(interval|symmetric|shortest)_(low|high)", kind)
        if match:
            which, end = match.groups()
            if which == "interval":
                which = "shortest" if self.options.get("interval", "").startswith("shortest") else "symmetric"
            at = 0 if end == "low" else 1
            return Found(mc[which][at] * scale, unit, error[which][at] * scale, f"{which} interval, {how}")
        raise Unexplained(f"no rule for the kind {entry['kind']} of {self.case['procedure']}")

    def second_order_interval(self, result, entry):
        k = result["k"]
        if result["coverage"] == "convolution":  # of the first order: the second has the factor of ν_eff
            k, _ = self.factor_of_degrees_of_freedom(entry, result)
        half_width = k * result["second_order"]["u"]
        return result["value"] - half_width, result["value"] + half_width

    def find_validation(self, entry):
        """Of the first order by the record. The program does not validate the second order: its interval is compared
        here with that of Monte Carlo, by the numerical tolerance of the record."""
        record = self.evaluate(self.probability(entry), FEW_TRIALS)
        result = record["results"][self.outputs[0]]
        mc = result["monte_carlo"]
        validation = mc["validation"]
        how = ""
        if re.search(r"higher|second", entry["quantity"]):
            ends = self.second_order_interval(result, entry)
            distances = [abs(a - b) for a, b in zip(ends, mc["symmetric"])]
            validated = max(distances) <= validation["delta"]
            how = "second order: compared here"
        elif validation is None:  # u = 0 in the first order: nothing that could be validated
            distances, validated, how = [], record["exit_code"] == 0, f"no interval, exit code {record['exit_code']}"
        else:
            distances, validated = [validation["d_low"], validation["d_high"]], validation["validated"]

        def found(convention=""):
            if entry["kind"] == "guf_validated":
                return Found(validated, how=how, convention=convention)
            return Found(distances[1 if entry["quantity"].startswith("d_high") else 0], self.unit_of(self.outputs[0]),
                         how=how, convention=convention)

        if result["coverage"] == "convolution" and not how and disagreement(entry, found()):
            k, convention = self.factor_of_degrees_of_freedom(entry, result)
            distances = [abs(result["value"] + sign * k * result["u"] - end)
                         for sign, end in zip((-1.0, 1.0), mc["symmetric"])]
            validated = max(distances) <= validation["delta"]
            return found(convention)
        return found()

    def find_region(self, entry):
        kind = entry["kind"]
        p = self.probability(entry)
        record = self.evaluate(p, FEW_TRIALS if kind.startswith("mcm_") else None)
        region = record["region"]
        if kind.endswith("k_p_elliptical"):
            return Found(region["ellipsoid"]["k_p"])
        if kind.endswith("k_q_rectangular"):
            return Found(region["parallelepiped"]["k_q"])
        if kind == "ellipse_area":
            (a, b), (c, d) = record["covariance"]["matrix"]
            return Found(math.pi * region["ellipsoid"]["k_p"] ** 2 * math.sqrt(a * d - b * c), how="π k_p² √det V")
        raise Unexplained(f"no rule for the kind {kind} of a region")

    def find_monte_carlo_correlation(self, a, b):
        """From the variances of the sum and the difference of the scaled outputs: the covariance of the record is the
        one of the law of propagation."""
        base = self.evaluate(self.probability({}), FEW_TRIALS)["results"]
        u = {n: base[n]["monte_carlo"]["u"] for n in (a, b)}

        def job():
            job = self.job(0.95, {"trials": FEW_TRIALS, "seed": 1}, False)
            for n in (a, b):
                per_angle = "/rad" if self.units[n] == {"rad": 1} and self.mode < 2 else ""
                job["model"].append(f"scaled_{n} = {n}/{u[n]!r}{per_angle}")
            job["model"] += [f"sum_of_both = scaled_{a} + scaled_{b}", f"difference = scaled_{a} - scaled_{b}"]
            job["outputs"] = {"sum_of_both": {}, "difference": {}}
            return job

        results = self.record("correlation by Monte Carlo", job)["results"]
        plus, minus = (results[n]["monte_carlo"]["u"] for n in ("sum_of_both", "difference"))
        return Found((plus ** 2 - minus ** 2) / 4.0, how="from sum and difference")


class WelchSatterthwaite(Propagation):
    """Components u_i with ν_i, added up."""

    def __init__(self, case, program):
        inputs = [{"name": f"x{i + 1}", "estimate": 0, "standard_uncertainty": u, "dof": nu, "unit": "",
                   "distribution": {"type": "normal"}}
                  for i, (u, nu) in enumerate(zip(case["data"]["u"], case["data"]["dof"]))]
        model = {"y": " + ".join(i["name"] for i in inputs)}
        super().__init__({**case, "inputs": inputs, "model": model}, program)

    def find(self, entry):
        if entry["kind"] == "k95":
            result = self.evaluate(0.95)["results"]["y"]
            found = Found(result["k"])
            if result["coverage"] == "convolution" and disagreement(entry, found):
                k, convention = self.factor_of_degrees_of_freedom(
                    {**entry, "quantity": "", "coverage_probability": 0.95}, result)  # of ν_eff as it is
                return Found(k, convention=convention)
            return found
        return super().find(entry)


class Quantiles(Lookup):
    """Coverage factors: a job of many inputs, each with its ν or shape and its coverage probability."""

    def find(self, entry):
        entries = [e for e in self.case["expected"] if e["kind"] == "k"]
        if entry not in entries:
            raise Unexplained(f"no rule for the kind {entry['kind']} of {self.case['procedure']}")

        def statement(given):
            if "beta" in given:
                return {"value": 0, "half_width": 1, "distribution": "trapezoidal", "beta": given["beta"]}
            return {"value": 0, "u": 1, **({} if given["nu"] == "inf" else {"nu": given["nu"]})}

        def job():
            given = [e["given"] for e in entries]
            return {"inputs": {f"x{i}": statement(g) for i, g in enumerate(given)},
                    "outputs": {f"x{i}": {"coverage_probability": g.get("coverage_probability", g.get("p"))}
                                for i, g in enumerate(given)}}

        result = self.record("factors", job)["results"][f"x{entries.index(entry)}"]
        return Found(result["k"], how=result["coverage"])


class EllipsoidFactors(Lookup):
    """k_p of m outputs that are independent."""

    def find(self, entry):
        m, p = entry["given"]["m"], entry["given"]["coverage_probability"]
        job = {"coverage_probability": p, "model": [f"y{i} = x{i}" for i in range(m)],
               "inputs": {f"x{i}": {"value": 0, "u": 1} for i in range(m)}}
        return Found(self.record(("m", m), lambda: job)["region"]["ellipsoid"]["k_p"])


class ExpandedUncertainty(Lookup):
    """y, u and ν in; k and U out."""

    def find(self, entry):
        given = {key.split("_")[0]: (value, key.partition("_")[2] or "1") for key, value in self.data.items()}
        (y, unit), (u, unit_of_u), (nu, _) = given["y"], given["u"], given["nu"]
        p = next(e["coverage_probability"] for e in self.case["expected"] if "coverage_probability" in e)
        result = self.single({"unit": unit, "value": y, "u": converted(u, unit_of_u, unit), "nu": nu}, p)
        return Found(result["k"]) if entry["kind"] == "k" else Found(result["U"], unit)


class Rounding(Lookup):
    """What documents print, with k = 1."""

    def printed(self, y, u):
        return self.single({"value": y, "u": u}, probability_of(1.0))["printed"]

    def find(self, entry):
        text = entry["quantity"]
        both = re.fullmatch(r"y = (\S+) (\w+) with u = (\S+) (\w+)", text)
        only_u = re.fullmatch(r"u = (\S+) (\w+), 2 digits, nearest", text)
        pair = re.fullmatch(r"(\S+), u=(\S+), 2 digits", text)
        if both and entry["kind"] == "rounded_y":
            y, unit, u, unit_of_u = both.groups()
            return Found(self.printed(float(y), converted(float(u), unit_of_u, unit))["value"])
        if only_u and entry["kind"] == "rounded_u":
            return Found(self.printed(0.0, float(only_u.group(1)))["U"])
        if pair and entry["kind"] == "shorthand":
            printed = self.printed(float(pair.group(1)), float(pair.group(2)))
            digits = printed["U"].replace(".", "").lstrip("0")
            return Found(f"{printed['value']}({digits})", how="composed of the printed value and uncertainty")
        raise Unexplained(f"the text {text} is not understood here")


class Conformity(Lookup):
    """A value without a model against a specification: what the certificate says of it."""

    def verdict(self, statement, limits, rule, probability=None):
        """\\param limits  lower and upper one, or None"""
        specification = {"id": "A", "results": ["x"], "unit": "1", "rule": rule,
                         **{key: limit for key, limit in zip(("lower", "upper"), limits) if limit is not None}}
        job = {"coverage_probability": probability or probability_of(2), "inputs": {"x": statement},
               "certificate": {"specifications": [specification]}}
        record = self.record(json.dumps((statement, limits, rule), sort_keys=True), lambda: job)
        values = [value for table in record["certificate"]["tables"] for column in table["columns"]
                  for value in column["values"] if column["result"] == "x"]
        if len(values) != 1 or not values[0].get("verdict"):
            raise Unexplained("the record holds no verdict of x")
        return values[0]["verdict"]


class ConformanceProbability(Conformity):
    """p_c, and the risk of an accepted value."""

    def statement(self, given):
        distribution = given.get("distribution")
        if not isinstance(distribution, dict):
            return {"value": given["mean"], "u": given["std"]} if "mean" in given else {
                "value": self.data["y"], "u": self.data["u"]}
        if distribution["type"] == "t":
            return {"value": distribution["location"], "u": distribution["scale"], "nu": distribution["dof"]}
        return {"limits": [distribution["lower"], distribution["upper"]],
                "distribution": {"rectangular": "uniform"}.get(distribution["type"], distribution["type"])}

    def find(self, entry):
        given = entry.get("given", {})
        if "distribution" in given:
            limits = [given.get("lower"), given.get("upper")]
        else:
            limits = self.data.get("limits") or [self.data["lower_limit"], self.data["upper_limit"]]
        verdict = self.verdict(self.statement(given), limits, {"id": "DR-01"})
        kind = without_suffix(entry["kind"])
        if kind == "conformance_probability":
            return Found(verdict["conformance_probability"])
        if kind in ("specific_consumer_risk", "specific_risk") and verdict["verdict"] == "pass":
            return Found(verdict["specific_risk"])
        raise Unexplained(f"no rule for the kind {entry['kind']} of a value that gives {verdict['verdict']}")


class GuardBandRules(Conformity):
    """Acceptance limits of the methods of ANSI/NCSL Z540.3, as a part of the tolerance ±1."""

    METHODS = {"rss": "rds", "test95": "5", "rp10": "rp10", "dobbert": "6"}

    def find(self, entry):
        statement = {"value": 0, "U": 1 / entry["given"]["TUR"], "k": 2}
        method = self.METHODS[entry["quantity"].partition("(")[0]]
        verdict = self.verdict(statement, [-1, 1], {"id": "DR-09", "method": method})
        return [Found(verdict["acceptance_upper"]), Found(-verdict["acceptance_lower"])]


class ConformanceZones(Conformity):
    """ISO 14253-1. The case gives u and, by its zones, the limits; it rounds the factor to 1.65."""

    def find(self, entry):
        expected = {e["quantity"]: e for e in self.case["expected"]}
        u, g = expected["g"]["given"]["u"], expected["g"]["value"]
        limits = [round(expected["acceptance_low"]["value"] - g, 9), round(expected["acceptance_high"]["value"] + g, 9)]
        solved = {"id": "DR-08"}
        rounded = {"id": "DR-08", "guard_factor": 1.65 / 2}
        middle = {"value": sum(limits) / 2, "u": u}
        kind, quantity = entry["kind"], entry["quantity"]
        if kind == "decision":
            verdicts = {self.verdict({"value": float(quantity.removeprefix("y=")), "u": u}, limits, rule)["verdict"]
                        for rule in (solved, rounded)}
            said = {"pass": "conformity", "fail": "nonconformity", "undetermined": "undecided"}
            return Found(" or ".join(sorted(said[v] for v in verdicts)))
        if kind == "guard_band_factor":
            return Found(self.verdict(middle, limits, solved)["guard_band"] / u)
        verdict = self.verdict(middle, limits, rounded)
        if kind == "guard_band":
            return Found(verdict["guard_band"])
        side = "lower" if quantity.endswith("low") else "upper"
        return Found(verdict[f"acceptance_{side}"])


class GlobalRisk(Conformity):
    """Risks of a population that is centred between the limits ±1, u a quarter of its deviation, nothing guarded."""

    def find(self, entry):
        reliability = float(re.fullmatch(r"\w+\(([\d.]+)\)", entry["quantity"]).group(1))
        deviation = 1 / statistics.NormalDist().inv_cdf((1 + reliability) / 2)
        rule = {"id": "DR-01", "population_reliability": reliability}
        verdict = self.verdict({"value": 0, "u": deviation / 4}, [-1, 1], rule)
        accept, reject = verdict["false_accept"], verdict["false_reject"]
        kind = entry["kind"].removesuffix("_percent")
        if kind == "conditional_false_accept":  # among the accepted: the good ones that were not rejected, and the bad
            return Found(100 * accept / (reliability - reject + accept))
        return Found(100 * {"false_accept": accept, "false_reject": reject}[kind])


class UncertaintyOfStandardDeviation(Lookup):
    """s of n readings is the root of a variance that is χ² distributed: Monte Carlo of one input."""

    def find(self, entry):
        n = int(re.fullmatch(r"n=(\d+)", entry["quantity"]).group(1))
        job = {"model": ["s = sqrt(q)"],
               "inputs": {"q": {"distribution": {"kind": "gamma", "shape": (n - 1) / 2, "scale": 2 / (n - 1)}}},
               "monte_carlo": {"trials": FEW_TRIALS, "seed": 1}}
        mc = self.record(("n", n), lambda: job)["results"]["s"]["monte_carlo"]
        return Found(100.0 * mc["u"] / mc["mean"], error=100.0 * mc["numerical_error"]["u"] / mc["mean"])


class Reliability(Lookup):
    """ν from how well u is known."""

    def find(self, entry):
        percent = float(re.match(r"(\d+) percent", entry["quantity"]).group(1))
        return Found(self.single({"value": 0, "u": 1, "reliability": percent / 100})["nu_eff"])


NUMBER = r"([-+]?[\d.]+(?:e[-+]?\d+)?)"


class ScalarConversions(Lookup):
    """One statement of what is known of a quantity each."""

    def find(self, entry):
        kind, text, given = without_suffix(entry["kind"]), entry["quantity"], entry.get("given") or {}
        if kind in ("mean", "std", "u_mean"):
            (name, values), = self.data.items()
            return Found(self.reading(name, values, kind).value)
        if kind == "u_from_normal_coverage":
            return Found(self.single({"value": 0, "U": given["half_width"], "p": given["coverage_probability"]})["u"])
        if kind == "u_from_k":
            return Found(self.single({"value": 0, "U": given["expanded"], "k": given["k"]})["u"])
        if kind == "estimate":
            return Found(self.single({"limits": [given["lower"], given["upper"]]})["value"])
        shape = "triangular" if kind == "u_triangular" else "uniform"
        for pattern, statement in (
                (rf"{NUMBER}\.\.{NUMBER}", lambda a, b: {"limits": [a, b], "distribution": shape}),
                (rf"limits {NUMBER} / {NUMBER}", lambda a, b: {"limits": [a, b], "distribution": shape}),
                (rf"half-width {NUMBER}", lambda a: {"value": 0, "half_width": a, "distribution": shape}),
                (rf"resolution delta = {NUMBER}", lambda a: {"value": 0, "resolution": a}),
                (rf"range = {NUMBER}", lambda a: {"limits": [-a / 2, a / 2], "distribution": shape})):
            match = re.search(pattern, text)
            if match:
                return Found(self.single(statement(*(float(n) for n in match.groups())))["u"])
        raise Unexplained(f"the text {text} is not understood here")


class DistributionMoments(Lookup):
    def find(self, entry):
        given = entry["given"]
        if given["type"] == "t":  # the law of propagation takes the scale with ν; the moments are those of Monte Carlo
            statement = Propagation.of_shape(given)
            result = self.single(statement, monte_carlo={"trials": FEW_TRIALS, "seed": 1})
            if entry["kind"] == "mean":
                return Found(result["value"])
            # Exact: the variance of the t with ν, from u = scale of the record and its ν.
            nu = result["nu_eff"]
            mc = result["monte_carlo"]
            exact = result["u"] * math.sqrt(nu / (nu - 2.0))
            if abs(mc["u"] - exact) > NUMERICAL_ERRORS * mc["numerical_error"]["u"]:
                return Found(mc["u"], how="Monte Carlo")
            return Found(exact, how="u √(ν/(ν − 2)), which agrees with the Monte Carlo of the record")
        result = self.single(Propagation.of_shape(given))
        return Found(result["value"] if entry["kind"] == "mean" else result["u"])


class NumericalTolerance(Lookup):
    """δ of the validation."""

    def find(self, entry):
        given = entry["given"]
        settings = {"trials": 200_000, "seed": 1, "validate": True, "digits": given["digits"]}
        return Found(self.single({"value": 0, "u": given["u"]}, 0.95, settings)["monte_carlo"]["validation"]["delta"])


class TypeA(Lookup):
    """Repeated readings of one quantity: summary, autocorrelation, coverage interval of the mean."""

    def find(self, entry):
        (key, values), = self.data.items()
        kind = entry["kind"]
        lag = re.fullmatch(r"r(\d+)", entry["quantity"])
        if kind in ("autocorrelation", "autocorrelation_lag1") and lag:
            listed = self.readings("y", values)["autocorrelation"]
            if int(lag.group(1)) >= len(listed):
                raise Unexplained(f"the record lists the lags 0 to {len(listed) - 1}")
            return Found(listed[int(lag.group(1))])
        if without_suffix(kind) in ("mean", "std", "u_mean"):
            return Found(self.reading("y", values, without_suffix(kind)).value)
        unit = program_unit(key.partition("_")[2])
        result = self.single({"unit": unit, "observations": values}, self.probability(entry))
        if kind in ("interval_low", "interval_high"):
            return Found(result["value"] + (result["U"] if kind.endswith("high") else -result["U"]), how="y ± U")
        return Found(result[{"k": "k", "U": "U", "u_full": "u", "u": "u"}[kind]])


class ComplexTypeA(Lookup):
    """Complex readings as pairs of real ones that were taken together; the model is a sum or difference."""

    def inputs(self, names):
        return {f"{name}_{part}": {"observations": [reading[i] for reading in self.data[name]]}
                for name in names for i, part in enumerate(("re", "im"))}

    def find(self, entry):
        output, formula = (side.strip() for side in self.case["model"].split("="))
        names = names_of(formula)
        name, _, part = entry["quantity"].partition(".")
        if name == output:
            record = self.record("model", lambda: {
                "model": [f"{output}_{p} = " + re.sub(r"\b([A-Za-z_]\w*)\b", rf"\1_{p}", formula)
                          for p in ("re", "im")],
                "inputs": self.inputs(names), "simultaneous": [[f"{n}_re", f"{n}_im"] for n in names]})
        else:
            record = self.record(("input", name), lambda: {
                "inputs": self.inputs([name]), "simultaneous": [[f"{name}_re", f"{name}_im"]]})
        kind = entry["kind"]
        if kind == "y":
            return Found(record["results"][f"{name}_{part}"]["value"])
        if kind == "nu_eff":
            return Found(record["region"]["nu"])
        order = record["covariance"]["names"]
        re_at, im_at = order.index(f"{name}_re"), order.index(f"{name}_im")
        at = {"var_re": (re_at, re_at), "cov": (re_at, im_at), "var_im": (im_at, im_at)}[kind]
        return Found(record["covariance"]["matrix"][at[0]][at[1]])


class LengthDependent(Lookup):
    """u(L) = √(a² + (b L)²): a constant and a proportional effect, a table of points of L."""

    def record_of(self):
        data, unit = self.data, {"unit": "um"}
        lengths = sorted({e["given"]["L_mm"] for e in self.case["expected"] if "given" in e})
        slope = {"value": 0, "unit": "um/mm"}
        parts = {f"a_{i + 1}": {**unit, "value": 0, "u": u} for i, u in enumerate(data["a_components_um"])}
        return lengths, self.record("lengths", lambda: {
            "coverage_probability": probability_of(2.0),
            "model": ["d = a + b*L", "mpe = mpe_0 + mpe_1*L", "constant_part = " + " + ".join(parts),
                      "slope_part = b_1 + b_2"],
            "inputs": {"a": {**unit, "value": 0, "u": data["a_um"]}, "b": {**slope, "u": data["b_um_per_mm"]},
                       "mpe_0": {**unit, "value": data["mpe_constant_um"], "constant": True},
                       "mpe_1": {"unit": "um/mm", "value": data["mpe_slope_um_per_mm"], "constant": True},
                       "L": {"unit": "mm", "value": 0, "constant": True}, **parts,
                       "b_1": {**slope, "u": data["thermal_um_per_mm"]},
                       "b_2": {**slope, "u": data["mpe_slope_um_per_mm"]}},
            "outputs": {"d": unit, "mpe": unit, "constant_part": unit, "slope_part": {"unit": "1"}},
            "points": [{"L": length} for length in lengths]})

    def find(self, entry):
        lengths, record = self.record_of()
        kind = entry["kind"]
        point = lengths.index(entry["given"]["L_mm"]) + 1 if "given" in entry else 1
        name = {"u": "d", "U": "d"}.get(kind, kind)
        if f"{name}[{point}]" not in record["results"]:
            raise Unexplained(f"no rule for the kind {kind} of {self.case['procedure']}")
        key = {"mpe": "value", "U": "U"}.get(kind, "u")
        return Found(record["results"][f"{name}[{point}]"][key], "um" if kind != "slope_part" else None)


class VarianceAnalysis(Lookup):
    """One-way analysis of variance: readings, or a summary of each group."""

    def statement(self):
        if "groups" in self.data:
            return "1", self.data["groups"]
        columns = {}
        for key, values in self.data.items():
            match = re.fullmatch(r"(?:group_)?(mean|std)s?(?:_(\w+))?", key)
            if match:
                columns[match.group(1)] = (values, match.group(2))
        means, unit = columns["mean"]
        deviations, unit_of_s = columns["std"]
        sizes = self.data.get("n") or [self.data["K"]] * len(means)
        return unit or "1", {"means": means, "sizes": sizes,
                             "standard_deviations": [converted(s, unit_of_s, unit) for s in deviations]}

    def find(self, entry):
        kind, quantity = without_suffix(entry["kind"]), entry["quantity"]
        group = re.fullmatch(r"group(\d+)", quantity)
        if group and kind in ("mean", "std"):
            return self.reading(quantity, self.data["groups"][int(group.group(1)) - 1], kind)
        unit, groups = self.statement()
        analysis = self.record("analysis", lambda: {
            "inputs": {"x": {"unit": unit, "groups": groups}}})["variance_analyses"][0]
        if kind == "dof":
            which = "within" if quantity in ("dof_within", "nu_b") else "between"
            return Found(analysis[f"degrees_of_freedom_{which}"])
        if kind in ("sum_of_squares", "mean_square"):
            return Found(analysis[f"{kind}_{quantity}"])
        if kind == "between_estimate" or entry["kind"] == "full" and quantity == "s_a":
            return Found(math.sqrt(analysis["mean_square_between"]), unit, how="root of the mean square")
        if kind == "F_critical" and "0.975" in quantity:
            raise Unexplained("another level")
        key = {"F": "F", "F_critical": "F_critical", "p_value": "p_value", "r_squared": "r_squared", "mean": "mean",
               "y": "mean"}.get(kind)
        if key:
            return Found(analysis[key], unit if key == "mean" else None)
        key = {"std_of_group_means": "standard_deviation_of_group_means",
               "group_mean_std": "standard_deviation_of_group_means",
               "within_std": "standard_deviation_within", "residual_std": "standard_deviation_within",
               "between_std": "standard_deviation_between", "between_std_clipped": "standard_deviation_between",
               "u_between_existing": "u_with_between_effect",
               "u_pooled": "u_without_between_effect", "u_pooled_all": "u_without_between_effect"}.get(kind)
        if key is None:
            raise Unexplained(f"no rule for the kind {entry['kind']} of {self.case['procedure']}")
        return Found(analysis[key], unit)


class Fit(Lookup):
    """Least squares: ordinary, weighted, errors in both variables, nonlinear from each start that the case states."""

    def __init__(self, case, program):
        super().__init__(case, program)
        left, right = (side.strip() for side in case["model"].split("="))
        columns = {k: v for k, v in self.data.items()
                   if isinstance(v, list) and re.fullmatch(r"(?!start)\w+", k) and k != "parameters"}
        for name, value in self.data.items():
            if isinstance(value, (int, float)):
                right = re.sub(rf"\b{re.escape(name)}\b", f"({value!r})", right)
        of_function = re.fullmatch(r"(\w+)\((\w+)\)", left)
        self.ordinate = left
        if of_function:  # what was observed is transformed first, as the program fits a quantity
            function, name = of_function.groups()
            self.ordinate = f"{function}_{name}"
            transform = {"ln": math.log, "log": math.log, "log10": math.log10, "exp": math.exp}[function]
            columns[self.ordinate] = [transform(v) for v in columns.pop(name)]
        self.right = right
        self.regressors = [n for n in names_of(right) if n in columns]
        wanted = (self.ordinate, *self.regressors)
        self.columns = {k: v for k, v in columns.items() if k in wanted or k.startswith("u_") and k[2:] in wanted}
        self.covariance = {}
        for key, matrix in columns.items():
            match = re.fullmatch(r"(?:cov|covariance|V|U)_?(\w+)", key)
            if match and match.group(1) in wanted and isinstance(matrix[0], list):
                self.covariance[match.group(1)] = matrix
                self.columns.pop(f"u_{match.group(1)}", None)
        names = [n for n in names_of(right) if n not in columns]
        self.parameters = self.data.get("parameters") or sorted(
            names, key=lambda n: (re.sub(r"\d+$", "", n), int((re.search(r"\d+$", n) or ["0"])[0])))
        self.starts = [k for k in ("start1", "start2") if k in self.data] or [None]
        self.plain_angles = False
        self.lre = {}

    def fit(self, start, scaled):
        parameters = {name: {} for name in self.parameters}
        if start:
            parameters = {n: {"start": v} for n, v in zip(self.parameters, self.data[start])}
        right = with_plain_angles(self.right) if self.plain_angles else self.right
        fit = {"equation": f"{self.ordinate} = {right}", "parameters": parameters, "data": self.columns}
        if self.covariance:
            fit["covariance"] = self.covariance
        if scaled:
            fit["scale_by_residuals"] = True
        return {"fits": {"fit": fit}}

    def evaluate(self, start=None, scaled=False, probability=0.95):
        key = ("fit", start or self.starts[0], "scaled" if scaled else "", probability)
        try:
            return self.record(key, lambda: {"title": self.case["title"], "coverage_probability": probability,
                                             **self.fit(start or self.starts[0], scaled)})
        except Refused as refused:
            if self.plain_angles or not any(UNIT_REFUSALS.fullmatch(code) for code in refused.codes):
                raise
            self.plain_angles = True
            self.program.said.append("an angle stands where a number is meant: run again with numbers")
            del self.records[key]
            return self.evaluate(start, scaled, probability)

    def at(self, regressor_value, extra=""):
        """A job with the fit and an equation of the model that uses it."""
        equation = re.sub(rf"\b{re.escape(self.regressors[0])}\b", "at", self.right)
        inputs = {"at": {"value": regressor_value, "constant": True}}
        if extra:  # a further observation scatters as the others did
            fit = self.evaluate()["fits"][0]
            inputs["scatter"] = {"value": 0, "u": fit["residual_standard_deviation"], "nu": fit["degrees_of_freedom"]}
        job = {**self.fit(self.starts[0], False), "model": [f"predicted = {equation}{extra}"], "inputs": inputs}
        return self.record(("at", regressor_value, extra), lambda: job)["results"]["predicted"]

    def inverse(self):
        """The regressor at an observed ordinate, by an implicit equation."""
        equation = re.sub(rf"\b{re.escape(self.regressors[0])}\b", "x_0", self.right)
        middle = sum(self.columns[self.regressors[0]]) / len(self.columns[self.regressors[0]])
        job = {**self.fit(self.starts[0], False), "model": [f"0 = y_0 - ({equation})"],
               "inputs": {"y_0": {"value": self.options["inverse_y0"], "u": self.options["u_y0"]}},
               "solve_for": {"x_0": {"start": middle}}}
        return self.record("inverse", lambda: job)["results"]["x_0"]

    def find(self, entry):
        kind, quantity = entry["kind"], entry["quantity"]
        plain = without_suffix(kind)
        place = re.fullmatch(r"(\w+)\(([-\d.]+)\)", quantity)
        if place and quantity.startswith("t("):
            first = self.evaluate(probability=float(place.group(2)))["results"]
            return Found(first[self.parameters[0]]["k"])
        if place:
            at = float(place.group(2))
            if kind == "variance_of_prediction":
                return Found(self.at(at, " + scatter")["u"] ** 2, how="u²")
            result = self.at(at)
            return Found({"prediction": result["value"], "u_prediction": result["u"], "u": result["u"],
                          "variance_of_mean": result["u"] ** 2}[plain])
        if quantity == "x0":
            return Found(self.inverse()["value" if kind == "inverse_prediction" else "u"])
        found = []
        for start in self.starts:
            found.append(self.find_in_fit(entry, plain, start))
            digits = self.options.get("certified_significant_digits")
            if plain == "parameter" and digits:
                error = abs(found[-1].value - entry["value"])
                lre = digits if error == 0.0 else min(digits, -math.log10(error / abs(entry["value"])))
                self.lre[(start, quantity)] = lre
        return found

    def find_in_fit(self, entry, kind, start):
        quantity = entry["quantity"]
        how = start or ""
        weighting = re.fullmatch(r"(u|covariance)_(known|scaled)", kind)
        record = self.evaluate(start, scaled=bool(weighting) and weighting.group(2) == "scaled")
        kind = weighting.group(1) if weighting else kind
        fit, results = record["fits"][0], record["results"]
        if quantity in results:
            result = results[quantity]
            if kind in ("interval_low", "interval_high"):
                return Found(result["value"] + (result["U"] if kind.endswith("high") else -result["U"]), how="y ± U")
            value = {"parameter": result["value"], "u": result["u"], "variance": result["u"] ** 2,
                     "t_statistic": result["value"] / result["u"] if result["u"] else math.inf}.get(kind)
            if value is not None:
                return Found(value, how=how)
        pair = re.fullmatch(r"(?:r|cov)\((\w+),(\w+)\)", quantity)
        if pair:
            i, j = (self.parameters.index(n) for n in pair.groups())
            return Found(fit[kind][i][j])
        squares, dof = fit["sum_of_squares"], fit["degrees_of_freedom"]
        value = {"residual_std": fit["residual_standard_deviation"], "dof": dof, "r_squared": fit["r_squared"],
                 "residual_sum_of_squares": squares, "chi_square": squares}.get(kind)
        if value is None and kind == "sum_of_squares" and quantity == "residual":
            value = squares
        if value is not None:
            return Found(value, how=how)
        if kind in ("sum_of_squares", "F"):
            # The record has no table of the regression: from the fitted values that it lists.
            y, fitted = fit["data"]["y"], fit["data"]["fitted"]
            centre = 0.0 if self.options["through_origin"] else math.fsum(y) / len(y)
            regression = math.fsum((f - centre) ** 2 for f in fitted)
            if kind == "sum_of_squares":
                return Found(regression, how="from the fitted values of the record")
            terms = len(self.parameters) - (0 if self.options["through_origin"] else 1)
            return Found(regression / terms / (squares / dof), how="from the fitted values of the record")
        raise Unexplained(f"no rule for the kind {entry['kind']} of {self.case['procedure']}")

    def finish(self):
        if not self.lre:
            return [], []
        lines, complaints = [], []
        least = LEAST_LRE[self.case["procedure"]]
        for start in self.starts:
            digits, name = min((lre, q) for (s, q), lre in self.lre.items() if s == start)
            place = f"{self.case['id']} {start}" if start else self.case["id"]
            lines.append(f"{place}: least log relative error {digits:.1f} ({name})")
            if digits < least:
                complaints.append(f"{lines[-1]}, at least {least:g} are asked for")
        return lines, complaints


class Laboratories(Lookup):
    """Results of laboratories for one item: assigned values, spread, consistency, scores."""

    def __init__(self, case, program):
        super().__init__(case, program)
        self.unit = program_unit(self.data.get("unit", "1"))

    def comparison(self, assigned_value, participants, probability=None, **more):
        """Of a job with these keys, by default with U = 2 u."""
        if not isinstance(assigned_value, dict):
            assigned_value = {"method": assigned_value}
        job = {"kind": "comparison", "title": self.case["title"], "unit": self.unit,
               "coverage_probability": probability or probability_of(2.0),
               "participants": participants, "assigned_value": assigned_value, **more}
        key = (assigned_value.get("method", "given"), json.dumps(job))
        return self.record(key, lambda: job)["comparison"]

    @staticmethod
    def values(numbers):
        """Participants L1, L2 … with a value each."""
        return [{"id": f"L{i + 1}", "value": value} for i, value in enumerate(numbers)]

    def with_u(self, probability=None):
        """Participants L1, L2 … with their standard uncertainties; without a probability with U = 2 u."""
        uncertainties = self.data["u"] if "u" in self.data else [math.sqrt(u2) for u2 in self.data["u2"]]
        return [{"id": f"L{i + 1}", "value": x, **({"u": u} if probability else {"U": 2.0 * u, "k": 2})}
                for i, (x, u) in enumerate(zip(self.data["x"], uncertainties))]

    @staticmethod
    def estimate(comparison, method):
        """One of the estimates of the item that stand side by side."""
        return next(e for e in comparison["items"][0]["estimates"] if e["method"] == method)

    @staticmethod
    def point(comparison, participant):
        return next(p for p in comparison["points"] if p["participant"] == participant)

    def unknown(self, entry):
        return Unexplained(f"no rule for {entry['quantity']} {entry['kind']} of {self.case['procedure']}")

    def consistency(self, comparison, kind):
        test = comparison["items"][0]["consistency"]
        key = {"consistency": "consistent"}.get(kind, kind)
        return Found(test[key]) if key in test else None


class KeyComparison(Laboratories):
    """Key comparison reference value with degrees of equivalence: power-moderated or weighted mean."""

    def results(self):
        if self.case["procedure"] == "kcrv_weighted_mean":
            return self.comparison({"method": "weighted_mean", "alpha": self.options["consistency_alpha"]},
                                   self.with_u())
        participants = []
        for lab in self.data["participants"]:
            outside = {} if lab["in_kcrv"] else {"contributes": False, "reason": "not in the reference value"}
            participants.append({"id": f"{lab['lab']} {lab['year']}", "value": lab["x"], "U": 2.0 * lab["u"], "k": 2,
                                 **outside})
        return self.comparison("power_moderated_mean", participants)

    def participant(self, quantity):
        """Of "d_3", "D(PTB)" or "w(PTB 2000)"; of a laboratory that took part twice the later result."""
        number = re.fullmatch(r"d_(\d)", quantity)
        if number:
            return f"L{number.group(1)}"
        name = re.search(r"\w\(([^()]+)\)+$", quantity).group(1)
        known = [f"{lab['lab']} {lab['year']}" for lab in self.data["participants"] if lab["lab"] == name]
        return sorted(known)[-1] if known else name

    def find(self, entry):
        quantity, kind, comparison = entry["quantity"], entry["kind"], self.results()
        item = comparison["items"][0]
        if kind.removesuffix("_full") in ("kcrv", "u_kcrv"):
            return Found(item["u" if kind.startswith("u_") else "value"], self.unit)
        if kind == "mandel_paule_std":
            return Found(self.estimate(comparison, "mandel_paule")["between"], self.unit)
        if quantity == "weighted_mean":
            return Found(self.estimate(comparison, "weighted_mean")["u" if kind == "u" else "value"], self.unit)
        found = self.consistency(comparison, kind)
        if found:
            return found
        if "pair_degree" in kind:
            names = [f"L{number}" for number in re.fullmatch(r"d_(\d)(\d)", quantity).groups()]
            pair = next(p for p in item["pairs"] if [p["first"], p["second"]] == names)
            return Found(pair["U" if kind.startswith("U_") else "d"], self.unit)
        participant = self.participant(quantity)
        if kind == "kcrv_weight":
            return Found(next(w["weight"] for w in item["weights"] if w["participant"] == participant))
        point = self.point(comparison, participant)
        if kind == "en_from_doe":
            return Found(abs(point["En"]), how="|D|/U")
        key = {"degree_of_equivalence": "D", "U_degree_of_equivalence": "U_D"}.get(kind)
        if key is None:
            raise self.unknown(entry)
        return Found(point[key], self.unit)


class RandomEffects(Laboratories):
    """Means of results that differ more than their uncertainties explain."""

    def method_of(self, quantity):
        if quantity == "fixed":
            return "weighted_mean"
        if self.case["procedure"] == "random_effects_ml":
            return "vangel_rukhin"
        return "mandel_paule" if self.options.get("method") == "Paule-Mandel" else "dersimonian_laird"

    def results(self, method, probability):
        if "n" in self.data:
            stated = [{"id": f"L{i + 1}", "value": x, "s": s, "n": n}
                      for i, (x, s, n) in enumerate(zip(self.data["x"], self.data["s"], self.data["n"]))]
        else:
            stated = self.with_u(probability)
        return self.comparison(method, stated, probability)

    def t_of(self, results, probability):
        """Quantile of t with n − 1 degrees of freedom, from a job: U over u of an arithmetic mean."""
        participants = [{"id": f"L{i + 1}", "value": float(i)} for i in range(results)]
        item = self.comparison("arithmetic_mean", participants, probability, sigma_pt=1.0)["items"][0]
        return item["U"] / item["u"]

    def find(self, entry):
        kind, method = entry["kind"], self.method_of(entry["quantity"])
        comparison = self.results(method, self.probability(entry))
        item, estimate = comparison["items"][0], self.estimate(comparison, method)
        if kind in ("chi_square", "p_value"):
            return self.consistency(comparison, kind)
        if kind in ("interval_low", "interval_high"):
            # Of the publication: with the normal factor. U of the record has the t-distribution and the scatter.
            half = statistics.NormalDist().inv_cdf(0.5 + 0.5 * self.probability(entry)) * item["u"]
            return Found(item["value"] + (half if kind.endswith("high") else -half), how="y ± z u")
        if kind == "u_hksj":
            return Found(estimate["u_hartung_knapp"])
        if kind in ("interval_low_hksj", "interval_high_hksj"):
            # Through the record alone: t of n − 1 degrees of freedom is U over u of a mean of equal weights.
            half = self.t_of(len(self.data["x"]), self.probability(entry)) * estimate["u_hartung_knapp"]
            return Found(item["value"] + (half if "high" in kind else -half), how="y ± t u of Hartung and Knapp")
        value = {"y": item["value"], "u": item["u"], "between_std": estimate.get("between")}.get(kind)
        if kind == "between_variance":
            value = estimate["between"] ** 2
        if value is None:
            raise self.unknown(entry)
        return Found(value)


class RobustStatistics(Laboratories):
    """Median, quartiles, algorithms A and S, Q method with Hampel's estimator, mode of a kernel density."""

    def results(self, method="algorithm_a", **more):
        if self.case["procedure"] == "algorithm_a_and_s":
            participants = self.values(self.data["averages"])
            for participant, s in zip(participants, self.data["standard_deviations"]):
                participant.update(s=s, n=self.data["replicates"])
        else:
            participants = self.values(self.data["x"])
        if "bandwidth" in self.options:
            more["kernel_bandwidth"] = self.options["bandwidth"]
        return self.comparison(method, participants, **more)

    def without_outliers(self, number):
        """Those that are farthest from the median do not contribute."""
        x = self.data["x"]
        outliers = sorted(range(len(x)), key=lambda i: -abs(x[i] - statistics.median(x)))[:number]
        participants = self.values(x)
        for i in outliers:
            participants[i].update(contributes=False, reason="outlier")
        return self.comparison("arithmetic_mean", participants)

    def classical(self, entry):
        """Of mean, standard deviation, median, MADe and nIQR; none for other quantities."""
        quantity, kind, comparison = entry["quantity"], entry["kind"], self.results()
        key = {"mean": "value", "std": "scale", "u": "u"}.get(kind)
        trimmed = [int(n) for e in self.case["expected"] for n in re.findall(r"(\d+) outliers removed", e["quantity"])]
        if quantity.startswith("trimmed") and trimmed:
            return Found(self.estimate(self.without_outliers(trimmed[0]), "arithmetic_mean")[key])
        if quantity in ("mean", "std") and key:
            return Found(self.estimate(comparison, "arithmetic_mean")[key])
        median, quartiles = self.estimate(comparison, "median"), self.estimate(comparison, "niqr")
        if kind == "median":
            return Found(median["value"])
        if kind == "mad_scaled":  # MADe is 1.483 times the median absolute deviation
            return Found(median["scale"] / 1.483 / statistics.NormalDist().inv_cdf(0.75),
                         how="MADe with the exact factor")
        if quantity == "median" and kind == "u":
            return Found(1.25 * quartiles["scale"] / math.sqrt(median["results"]), how="from nIQR",
                         convention=f"the source takes nIQR as the scale of the median; from MADe {median['u']:.6g}")
        return Found({"niqr": quartiles, "made": median}[kind]["scale"]) if kind in ("niqr", "made") else None

    def find(self, entry):
        quantity, kind = entry["quantity"], entry["kind"].removesuffix("_full")
        if kind.startswith("huber_"):
            comparison = self.results({"method": "algorithm_a", "constants": "exact"})
            return Found(self.estimate(comparison, "algorithm_a")["scale" if kind == "huber_scale" else "value"])
        if kind == "kernel_mode":
            return Found(self.estimate(self.results(), "kernel_mode")["value"])
        if kind == "robust_pooled_std":
            return Found(self.results()["items"][0]["pooled_standard_deviation"])
        key = {"robust_mean": "value", "robust_std": "scale", "u_robust_mean": "u", "u": "u"}.get(kind)
        method = "q_hampel" if quantity.startswith("Q") else "algorithm_a"
        if key and quantity in ("x*", "s*", "u(x*)", "Q/Hampel mean", "Q std"):
            return Found(self.estimate(self.results(), method)[key])
        found = self.classical(entry)
        if found is None:
            raise self.unknown(entry)
        return found


class ConsensusAndReference(RobustStatistics):
    """Robust consensus held against an independent reference value."""

    def find(self, entry):
        key = {"u_difference": "u_difference", "difference": "difference", "difference_over_u": "ratio"}.get(
            entry["kind"])
        comparison = self.results(reference_value={"value": self.data["x_ref"], "u": self.data["u_ref"]})
        if key:
            return Found(abs(comparison["items"][0]["consensus"][key]), how="without sign")
        return Found(self.estimate(comparison, "algorithm_a")[
            {"robust_mean": "value", "robust_std": "scale", "u": "u"}[entry["kind"]]])


class ItemChecks(Laboratories):
    """Homogeneity and stability of the items, and the factors of the expanded criterion."""

    def checks(self):
        percent = 100.0 * float(re.fullmatch(r"([\d.]+) \* mean", self.options["sigma_pt"]).group(1))
        mean = statistics.fmean(value for item in self.data["homogeneity"] for value in item)
        comparison = self.comparison({"value": mean}, self.values([mean, mean]), sigma_pt={"percent": percent},
                                     homogeneity=self.data["homogeneity"], stability=self.data["stability"])
        return comparison["items"][0]

    def factors(self, items):
        """From two checks of duplicates: of items that differ in nothing, and of one with a σ_pt next to nothing."""
        duplicates = {"same": [[1.0, 1.0]] * items, "scattered": [[0.0, 2.0]] * items}
        sigma_pt = {"same": 1.0, "scattered": 1e-6}
        comparison = self.comparison(
            {"value": 1.0}, [{"id": "L1"}, {"id": "L2"}],
            results=[{"participant": name, "item": item, "value": 1.0} for name in ("L1", "L2") for item in duplicates],
            items=[{"id": item, "unit": "1", "homogeneity": results, "sigma_pt": sigma_pt[item]}
                   for item, results in duplicates.items()])
        same, scattered = (item["homogeneity"] for item in comparison["items"])
        f1 = (same["expanded_limit"] / same["limit"]) ** 2
        f2 = (scattered["expanded_limit"] ** 2 - f1 * scattered["limit"] ** 2) / scattered["s_w"] ** 2
        return {"F1": f1, "F2": f2}

    def find(self, entry):
        quantity, kind = entry["quantity"], entry["kind"]
        if self.case["procedure"] == "homogeneity_factors":
            items = int(re.search(r"g=(\d+)", quantity).group(1))
            return Found(self.factors(items)[kind], how="from the limits of two checks")
        item = self.checks()
        if kind == "sigma_pt":
            return Found(item["sigma_pt"])
        key = {"mean": "mean", "std_of_item_means": "s_x", "within_std": "s_w", "between_std": "s_s",
               "between_std_full": "s_s", "criterion": "limit", "difference": "difference",
               "sufficiently_homogeneous": "sufficient", "stable": "stable"}.get(kind)
        if key is None:
            raise self.unknown(entry)
        return Found(item["stability" if "stab" in quantity else "homogeneity"][key])


class SigmaPt(Laboratories):
    """Standard deviation for proficiency assessment: curve of Horwitz and Thompson, precision of a method."""

    def sigma_pt(self, value, request):
        return self.comparison({"value": value}, self.values([value, value]), sigma_pt=request)["items"][0]["sigma_pt"]

    def given(self, quantity):
        """What belongs to the quantity: its own, or that of the one whose name has the same number."""
        number = re.search(r"\(([\d.]+)", quantity)
        fits = [e for e in self.case["expected"] if "given" in e and (
            f"({number.group(1)}" in e["quantity"] if number else "sigma_R" in e["given"])]
        return fits[0]["given"]

    def find(self, entry):
        kind, quantity = entry["kind"], entry["quantity"]
        if kind == "sigma_pt_mass_fraction":
            c = float(re.search(r"c=([\d.e-]+)", quantity).group(1))
            return Found(self.sigma_pt(c, {"mass_fraction_per_unit": 1.0}))
        given = self.given(quantity)
        if "mass_fraction" in given:
            value = given["mass_fraction"] * 1e6  # in mg/kg
            sigma = self.sigma_pt(value, {"mass_fraction_per_unit": 1e-6})
            return Found(100.0 * sigma / value if kind == "sigma_pt_percent" else sigma)
        many = 1_000_000  # replicates, which leave what is between laboratories
        return Found(self.sigma_pt(100.0, {"reproducibility": given["sigma_R"], "repeatability": given["sigma_r"],
                                           "replicates": many if kind == "std" else given["m"]}))


class Scores(Laboratories):
    """Scores of laboratories against an assigned value."""

    SIGNALS = {"none": "satisfactory", "warning": "questionable", "action": "unsatisfactory"}
    KEYS = {"percent_difference": "D_percent", "percent_allowed": "P_A", "z": "z", "z_prime": "z_prime",
            "zeta": "zeta", "En": "En", "en_satisfactory": "En"}

    def single_point(self, given):
        """One value against one reference, each with its U."""
        reference = {"value": given["x_ref"], **({"U": given["U_ref"], "k": 2} if given["U_ref"] else {})}
        participants = [{"id": name, "value": given["x"], "U": given["U"], "k": 2} for name in ("L1", "L2")]
        return self.point(self.comparison(reference, participants), "L1")

    def scored(self, participant, only_z):
        """With all that is stated; or with σ_pt alone, so that z decides."""
        data = self.data
        reference = {"value": data["x_pt"], **({} if only_z else {"U": data["U_pt"], "k": data["k_pt"]})}
        participants = [{"id": lab["lab"], "value": lab["x"], **({} if only_z else {"U": lab["U"], "k": lab["k"]})}
                        for lab in data["participants"]]
        more = {} if only_z else {"delta_E": data["delta_E"]}
        return self.point(self.comparison(reference, participants, sigma_pt=data["sigma_pt"], **more), participant)

    def of_mean_and_std(self, entry):
        comparison = self.comparison("arithmetic_mean", self.values(self.data["x"]), sigma_pt="standard_deviation")
        number = re.fullmatch(r"z\((\d+)\)", entry["quantity"])
        if number:
            return Found(self.point(comparison, f"L{number.group(1)}")["z"])
        kind = entry["kind"].removesuffix("_full")
        if kind in ("robust_mean", "robust_std"):
            return Found(self.estimate(comparison, "algorithm_a")["value" if kind == "robust_mean" else "scale"])
        return Found(self.estimate(comparison, "arithmetic_mean")[{"mean": "value", "std": "scale"}[kind]])

    def find(self, entry):
        if self.case["procedure"] == "z_scores_from_mean_and_std":
            return self.of_mean_and_std(entry)
        kind = entry["kind"]
        if "given" in entry:
            return Found(self.single_point(entry["given"])[self.KEYS[kind]])
        participant = re.search(r"\(([^()]+)\)", entry["quantity"]).group(1)
        if kind == "z_signal":
            return Found(self.SIGNALS[self.scored(participant, only_z=True)["signal"]], how="signal of z")
        point = self.scored(participant, only_z=False)
        score = point[self.KEYS[kind]]
        if kind == "en_satisfactory":
            return Found(abs(score) <= 1.0)
        lab = next(lab for lab in self.data["participants"] if lab["lab"] == participant)
        if kind == "En" and lab["k"] != self.data["k_pt"]:
            as_stated = (lab["x"] - self.data["x_pt"]) / math.hypot(lab["U"], self.data["U_pt"])
            return Found(as_stated, convention=f"U with k = {lab['k']} as the source takes it; the program brings both "
                                               f"sides to one coverage factor, E_n = {score:.4f}")
        return Found(score)


PROCEDURES = {
    "lpu": Propagation, "lpu_multi": Propagation, "lpu_relative": Propagation, "lpu_implicit": Propagation,
    "lpu_second_order": Propagation, "mcm": Propagation, "mcm_multi": Propagation,
    "mcm_with_guf_validation": Propagation,
    "welch_satterthwaite": WelchSatterthwaite,
    "t_quantile": Quantiles, "trapezoid_k": Quantiles, "chi2_coverage_factor": EllipsoidFactors,
    "expanded_uncertainty": ExpandedUncertainty, "rounding": Rounding, "format_result": Rounding,
    "conformity_probability": ConformanceProbability, "guard_band_rules": GuardBandRules,
    "decision_rule": ConformanceZones, "global_risk": GlobalRisk,
    "uncertainty_of_std": UncertaintyOfStandardDeviation, "type_b_dof": Reliability,
    "scalar_conversions": ScalarConversions, "distribution_moments": DistributionMoments,
    "numerical_tolerance": NumericalTolerance,
    "univariate_summary": TypeA, "autocorrelation": TypeA, "type_a_mean": TypeA, "complex_type_a": ComplexTypeA,
    "length_dependent_uncertainty": LengthDependent,
    "anova_oneway": VarianceAnalysis, "anova_oneway_from_summary": VarianceAnalysis,
    "anova_oneway_from_group_means": VarianceAnalysis,
    "linear_fit_ols": Fit, "linear_fit_wls": Fit, "linear_fit_eiv": Fit, "linear_fit_gls": Fit,
    "nonlinear_least_squares": Fit,
    "kcrv_pmm": KeyComparison, "kcrv_weighted_mean": KeyComparison,
    "random_effects_mean": RandomEffects, "random_effects_ml": RandomEffects,
    "robust_statistics": RobustStatistics, "algorithm_a": RobustStatistics, "algorithm_a_and_s": RobustStatistics,
    "kernel_mode": RobustStatistics, "compare_with_reference": ConsensusAndReference,
    "homogeneity": ItemChecks, "homogeneity_factors": ItemChecks, "sigma_pt": SigmaPt,
    "performance_scores": Scores, "z_scores_from_mean_and_std": Scores,
}


# ---- comparison -----------------------------------------------------------------------------------------------------


def half_last_digit(published):
    """Half a unit of the last printed digit: "1.60E-3" → 0.000005."""
    try:
        return 0.5 * 10.0 ** Decimal(str(published).replace(" ", "")).as_tuple().exponent
    except (InvalidOperation, TypeError):
        return 0.0


def tolerance_of(entry):
    if entry.get("tolerance") is not None:
        return entry["tolerance"]
    if entry.get("relative_tolerance") is not None:
        return entry["relative_tolerance"] * abs(entry["value"])
    return half_last_digit(entry["published"])


def disagreement(entry, found):
    """None when the two agree, else what is wrong."""
    wanted = entry["value"]
    if isinstance(found.value, bool) or isinstance(wanted, bool):
        return None if found.value == wanted else f"{found.value}, expected {wanted}"
    if isinstance(found.value, str):
        wanted = entry["published"] if entry["published"] is not None else wanted
        return None if found.value == str(wanted) else f"{found.value}, expected {wanted}"
    value = converted(found.value, found.unit, entry.get("unit"))
    tolerance = tolerance_of(entry)
    if "exact" in entry["kind"]:
        tolerance = max(tolerance, NUMERICAL_ERRORS * found.error)
    allowed = tolerance * (1.0 + 1e-9) + 4e-16 * abs(wanted)
    if math.isfinite(value) and abs(value - wanted) <= allowed:
        return None
    # ν_eff that is printed as a whole number is cut to it (JCGM 100:2008, G.4.1).
    if entry["kind"] == "nu_eff" and re.fullmatch(r"\d+", str(entry["published"])) and math.floor(value) == wanted:
        return None
    return f"{value:.15g}, expected {wanted:.15g} ± {tolerance:.3g}" + (f" ({found.how})" if found.how else "")


def product_of_rounded(case, entry):
    """A printed U that is the product of the printed k and the printed u of the same quantity, both rounded: U and what
    the rounding of the factors may change in it. None where the case does not print them so."""
    if entry["kind"] != "U" or entry["published"] is None:
        return None
    printed = [e for e in case["expected"] if e["quantity"] == entry["quantity"] and e["published"] is not None
               and e.get("unit") in (None, entry.get("unit"))]
    half = half_last_digit(entry["published"])
    factors = {kind: [(e["value"], half_last_digit(e["published"])) for e in printed if e["kind"] == kind]
               for kind in ("u", "k")}
    for u, half_of_u in sorted(factors["u"], key=lambda pair: pair[1]):
        for k, half_of_k in factors["k"]:
            if abs(k * u - entry["value"]) <= half:
                return half + k * half_of_u + u * half_of_k
    return None


@dataclasses.dataclass
class Outcome:
    case: str
    procedure: str
    agreed: int = 0
    failures: list = dataclasses.field(default_factory=list)
    reasons: list = dataclasses.field(default_factory=list)  # entries that are not looked up, and why
    conventions: list = dataclasses.field(default_factory=list)  # entries that agree with the convention of the source
    lines: list = dataclasses.field(default_factory=list)
    said: list = dataclasses.field(default_factory=list)


def reason_for(case, entry):
    for procedure, kind, quantity, reason in NOT_LOOKED_UP:
        if (re.fullmatch(procedure, case["procedure"]) and re.fullmatch(kind, entry["kind"])
                and re.fullmatch(quantity, entry["quantity"])):
            return reason
    return None


def with_unit(case, entry):
    """A number of full precision has the unit of the printed one of the same quantity."""
    if "unit" in entry or not re.search(r"(^|_)full$", entry["kind"]):
        return entry
    base = entry["kind"].removesuffix("full").removesuffix("_")
    units = {e["unit"] for e in case["expected"] if "unit" in e and e["quantity"] == entry["quantity"]
             and base in ("", e["kind"])}
    return {**entry, "unit": units.pop()} if len(units) == 1 else entry


def run_case(path, program_file, folder):
    case = json.loads(path.read_text(encoding="utf-8"))
    outcome = Outcome(case["id"], case["procedure"])
    if case["procedure"] not in PROCEDURES:
        outcome.failures.append(f"the procedure {case['procedure']} is not known here")
        return outcome
    folder = folder / case["id"]
    folder.mkdir(parents=True, exist_ok=True)
    program = Program(program_file, folder)
    try:
        lookup = PROCEDURES[case["procedure"]](case, program)
    except (Unexplained, KeyError, ValueError, SyntaxError) as error:
        outcome.failures.append(f"the case is not understood: {error!r}")
        return outcome
    refusals = set()
    for entry in case["expected"]:
        entry = with_unit(case, entry)
        name = f"{entry['quantity']} {entry['kind']}" + (f" [{entry['input']}]" if "input" in entry else "")
        if entry.get("informative"):
            outcome.said.append(f"{name}: {entry['value']}, for information: {entry.get('note', '')}")
            continue
        reason = reason_for(case, entry)
        if reason:
            outcome.reasons.append((name, reason))
            continue
        try:
            found = lookup.find(entry)
            for one in found if isinstance(found, list) else [found]:
                wrong = disagreement(entry, one)
                wider = product_of_rounded(case, entry) if wrong else None
                if wider and not disagreement({**entry, "tolerance": wider}, one):
                    wrong = None
                    outcome.conventions.append((name, f"the source multiplies rounded k and u; without rounding "
                                                      f"{one.value:.6g}, printed {entry['published']}"))
                if one.convention:
                    outcome.conventions.append((name, one.convention))
                if wrong:
                    outcome.failures.append(f"{name}: {wrong}")
                    break
                outcome.said.append(f"{name}: {one.value}" + (f" ({one.how})" if one.how else ""))
            else:
                outcome.agreed += 1
        except Refused as refused:
            if str(refused) not in refusals:
                outcome.failures.append(f"{name}: {refused}")
            refusals.add(str(refused))
        except subprocess.TimeoutExpired:
            outcome.failures.append(f"{name}: the program took too long")
        except Unexplained as error:
            outcome.failures.append(f"{name}: cannot be looked up, and no reason is stated: {error}")
        except (KeyError, IndexError, TypeError, AttributeError, ValueError, StopIteration, ZeroDivisionError) as error:
            outcome.failures.append(f"{name}: the record does not hold it: {error!r}")
    outcome.lines, complaints = lookup.finish()
    outcome.failures += complaints
    outcome.said = program.said + outcome.said
    return outcome


def report(outcomes, verbose):
    failed = [o for o in outcomes if o.failures]
    for outcome in outcomes:
        verdict = "FAIL" if outcome.failures else "pass"
        print(f"{verdict}  {outcome.case}  ({outcome.procedure}, {outcome.agreed} numbers)")
        for failure in outcome.failures:
            print(f"      {failure}")
        if verbose:
            for line in outcome.said:
                print(f"      . {line}")
    digits = [line for o in outcomes for line in o.lines]
    if digits:
        print("\nCertified parameters of fits")
        for line in digits:
            print(f"  {line}")
    reasons = {}
    for outcome in outcomes:
        for name, reason in outcome.reasons:
            reasons.setdefault(reason, []).append(f"{outcome.case}: {name}")
    if reasons:
        print("\nNumbers that are not looked up")
        for reason, names in reasons.items():
            print(f"  {reason}")
            for name in names:
                print(f"      {name}")
    conventions = [(o.case, name, text) for o in outcomes for name, text in o.conventions]
    if conventions:
        print("\nNumbers that agree by the convention of their source")
        for case, name, text in conventions:
            print(f"  {case}: {name}: {text}")
    print(f"\n{len(outcomes) - len(failed)} cases pass, {len(failed)} fail; "
          f"{sum(o.agreed for o in outcomes)} numbers agree, {sum(len(o.reasons) for o in outcomes)} are not looked up")
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description="Published reference cases through the command line of the program.")
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--cases", required=True, type=pathlib.Path)
    parser.add_argument("--only", action="append", metavar="ID", help="this case; may be given again")
    parser.add_argument("--jobs", type=int, default=2, help="cases at the same time")
    parser.add_argument("--keep", type=pathlib.Path, metavar="DIR", help="keep jobs and records there")
    parser.add_argument("--verbose", action="store_true", help="every number, and how it was found")
    options = parser.parse_args()
    paths = sorted(options.cases.glob("*.json")) if options.cases.is_dir() else []
    if not paths:
        print(f"no reference cases in {options.cases}: skipped", file=sys.stderr)
        return 77
    if options.only:
        paths = [p for p in paths if p.stem in options.only]
        if not paths:
            parser.error("no case of this name")
    if not options.program.is_file():
        parser.error(f"there is no program {options.program}")
    with tempfile.TemporaryDirectory() as temporary:
        folder = (options.keep or pathlib.Path(temporary)).resolve()
        with concurrent.futures.ThreadPoolExecutor(max_workers=max(1, options.jobs)) as pool:
            outcomes = list(pool.map(lambda path: run_case(path, options.program.resolve(), folder), paths))
    return report(outcomes, options.verbose)


if __name__ == "__main__":
    sys.exit(main())
