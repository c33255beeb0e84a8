"""Twenty sound budgets of different fields, as calibration laboratories make them. Numbers are drawn; what stands in the
rows (sources, divisors, sensitivities, degrees of freedom) is what the field has."""

import math

from tables import INFINITE, ROOT3, Budget, Layout, Row, as_decimal, exact

DIVISOR_TEXTS = {2.0: "2", ROOT3: "√3", math.sqrt(6.0): "√6", math.sqrt(2.0): "√2", math.sqrt(12.0): "√12", 1.0: "1"}
SHORT_TEXTS = {**DIVISOR_TEXTS, ROOT3: "1.732", math.sqrt(6.0): "2.449", math.sqrt(2.0): "1.414", math.sqrt(12.0): "3.464"}


class Draw:
    """Draws the rows of one budget in its language."""

    def __init__(self, random, language, decimal, short_divisors=False):
        self.random, self.language, self.decimal = random, language, decimal
        self.texts = SHORT_TEXTS if short_divisors else DIVISOR_TEXTS
        self.year = random.choice((2023, 2024, 2025))

    def near(self, value, digits=2, spread=0.22):
        """A number near another one, with few digits."""
        drawn = value * math.exp(self.random.uniform(-spread, spread))
        return float(f"{drawn:.{digits - 1}e}")

    def date(self):
        return f"{self.year}-{self.random.randint(1, 12):02d}-{self.random.randint(1, 28):02d}"

    def number(self):
        return f"{self.random.choice('KDMRT')}-{self.random.randint(10000, 99999)}"

    def say(self, english, german):
        return german if self.language == "de" else english

    def text(self, value):
        return as_decimal(exact(value), self.decimal)

    def divisor(self, value):
        """Text of a divisor: a known root, or the root of a whole number."""
        known = next((text for number, text in self.texts.items() if abs(number - value) < 1e-12), None)
        square = value * value
        if known:
            return known
        return f"√{square:.0f}" if abs(square - round(square)) < 1e-9 else exact(round(value, 4))

    def row(self, key, name, unit, stated, divisor, shape, kind, comment, *, c=1.0, x="0", nu=INFINITE, type_a=False,
            source="", n=0):
        return Row(key=key, name=name, unit=unit, x=x, stated=stated, divisor=divisor, divisor_text=self.divisor(divisor),
                   shape=shape, type_a=type_a, nu=nu, c=c, source=source, comment=comment, kind=kind, n=n)

    def certificate(self, key, name, unit, U, c=1.0, x="0", k=2.0, source=""):
        U, source = self.near(U), source or self.say("certificate ", "Kalibrierschein ") + self.number()
        said = f"U = {self.text(U)} {unit}, k = {self.text(k)}; {source}, {self.date()}"
        return self.row(key, name, unit, U, k, "normal", "certificate", said, c=c, x=x, source=source)

    def specification(self, key, name, unit, a, c=1.0, x="0"):
        a = self.near(a)
        said = self.say(f"MPE ±{self.text(a)} {unit}; conformity verified {self.date()}",
                        f"Fehlergrenze ±{self.text(a)} {unit}; Konformität geprüft {self.date()}")
        return self.row(key, name, unit, a, ROOT3, "rect", "specification", said, c=c, x=x,
                        source=self.say("data sheet", "Datenblatt"))

    def resolution(self, key, name, unit, steps, c=1.0, whole=False):
        step = self.random.choice(steps)
        said = self.say(f"resolution {self.text(step)} {unit}", f"Auflösung {self.text(step)} {unit}")
        stated, divisor = (step, math.sqrt(12.0)) if whole else (step / 2.0, ROOT3)
        return self.row(key, name, unit, stated, divisor, "rect", "resolution", said, c=c)

    def limits(self, key, name, unit, a, why, c=1.0, x="0", shape="rect"):
        a = self.near(a)
        divisor = {"rect": ROOT3, "tri": math.sqrt(6.0), "arcsine": math.sqrt(2.0)}[shape]
        return self.row(key, name, unit, a, divisor, shape, "limits", f"±{self.text(a)} {unit}, {why}", c=c, x=x)

    def drift(self, key, name, unit, a, c=1.0, source=""):
        a, count = self.near(a), self.random.randint(3, 6)
        said = self.say(f"±{self.text(a)} {unit}, history of {count} calibrations since {self.year - count}",
                        f"±{self.text(a)} {unit}, Verlauf über {count} Kalibrierungen seit {self.year - count}")
        return self.row(key, name, unit, a, ROOT3, "rect", "drift", said, c=c,
                        source=source or self.say("history ", "Verlauf ") + self.number())

    def mean(self, key, name, unit, s, counts=(4, 5, 6, 8, 10), c=1.0, x="0"):
        n, s = self.random.choice(counts), self.near(s, 3)
        said = self.say(f"standard deviation {self.text(s)} {unit}; mean of {n} readings",
                        f"Standardabweichung {self.text(s)} {unit}; Mittelwert aus {n} Messungen")
        return self.row(key, name, unit, s, math.sqrt(n), "t", "mean", said, c=c, x=x, nu=n - 1, type_a=True,
                        source=self.say("readings", "Messwerte"), n=n)

    def single(self, key, name, unit, s, c=1.0):
        """The scatter of a study, for a result of one reading."""
        n, s = self.random.choice((10, 12, 15, 20)), self.near(s, 3)
        said = self.say(f"standard deviation {self.text(s)} {unit} of {n} readings of a study; the result is a single reading",
                        f"Standardabweichung {self.text(s)} {unit} von {n} Messungen einer Studie; das Ergebnis ist eine "
                        "Einzelmessung")
        return self.row(key, name, unit, s, 1.0, "t", "single", said, c=c, nu=n - 1, type_a=True,
                        source=self.say("study ", "Studie ") + str(self.year), n=n)

    def pooled(self, key, name, unit, s, c=1.0):
        n, s = self.random.choice((3, 4, 5)), self.near(s, 3)
        series = self.random.randint(12, 20)
        said = self.say(f"pooled s = {self.text(s)} {unit} of {series} series; mean of {n} readings",
                        f"gepoolte Standardabweichung s = {self.text(s)} {unit} aus {series} Reihen; Mittelwert aus {n} Messungen")
        return self.row(key, name, unit, s, math.sqrt(n), "t", "pooled", said, c=c, nu=series * (n - 1), type_a=True,
                        source=self.say("control chart", "Regelkarte"), n=n)


def end_gauge(d):
    length = d.random.choice((75.0, 100.0, 125.0))
    dtheta = d.random.choice((0.3, 0.4, 0.5))
    rows = [
        d.certificate("l_S", "length of the reference gauge block", "µm", 0.060),
        d.drift("drift", "drift of the reference gauge block", "µm", 0.040),
        d.mean("d", "repeatability of the comparator", "µm", 0.075),
        d.certificate("d_C", "calibration of the comparator", "µm", 0.034),
        d.limits("dt", "temperature difference of the two gauges", "K", 0.050, "after 12 h on one plate", c=length * 0.0115),
        d.limits("da", "difference of the expansion coefficients", "1E-6/K", 1.0, "steel on steel", c=length * 1e-3 * dtheta,
                 shape="tri"),
        d.limits("l_V", "central length, place of the contact", "µm", 0.033, "0.5 mm beside the centre"),
        d.resolution("res", "resolution of the comparator display", "µm", (0.01, 0.02)),
        d.limits("rep", "reproducibility between operators", "µm", 0.03, "three operators, 2 days"),
    ]
    return Budget("end_gauge", "en", f"End gauge {length:g} mm, deviation from nominal length", "End gauge by comparison", "µm",
                  d.near(0.4, 3), rows, Layout("qxiadsucbnrm"))


def gauge_block(d):
    rows = [
        d.certificate("l_S", "Länge des Bezugsnormals", "nm", 30.0),
        d.drift("drift", "Drift des Bezugsnormals", "nm", 20.0),
        d.mean("dl", "Wiederholbarkeit der Längendifferenz", "nm", 24.0, counts=(4, 5, 6)),
        d.limits("d_C", "Nichtlinearität des Komparators", "nm", 21.0, "Prüfung mit Endmaßpaaren"),
        d.limits("dt", "Temperaturdifferenz der Endmaße", "K", 0.020, "Fühler am Tisch", c=575.0),
        d.limits("da", "Differenz der Ausdehnungskoeffizienten", "1E-6/K", 0.8, "Stahl gegen Stahl", c=15.0),
        d.limits("l_V", "Abweichung vom Mittenmaß durch den Antastpunkt", "nm", 12.0, "Parallelität 0,05 µm"),
        d.resolution("res", "Auflösung der Anzeige", "nm", (5.0, 10.0), whole=True),
    ]
    return Budget("gauge_block", "de", "Endmaß 50 mm, Abweichung vom Nennmaß", "Parallelendmaß", "nm", d.near(120.0, 3), rows,
                  Layout("qiadsucbnm", ";", ",", heads=1))


def multimeter(d):
    rows = [
        d.certificate("V_S", "calibration of the calibrator", "µV", 210.0),
        d.drift("drift", "drift of the calibrator since its calibration", "µV", 120.0),
        d.limits("temp", "ambient temperature of the calibrator", "K", 1.0, "23 °C during the work", c=70.0),
        d.limits("emf", "thermal EMF of the leads", "µV", 80.0, "reversed polarity", shape="tri"),
        d.single("rep", "repeatability of the multimeter", "µV", 85.0),
        d.resolution("res", "resolution of the multimeter", "µV", (200.0, 100.0)),
        d.limits("load", "loading by the input resistance", "µV", 45.0, "10 MΩ input"),
        d.limits("repro", "reproducibility of the connection", "µV", 50.0, "connected four times"),
    ]
    return Budget("multimeter_dc", "en", "Digital multimeter, 10 V DC, error of indication", "multimeter", "µV",
                  d.near(350.0, 3), rows, Layout("qxiadsucbnm", heads=1), coverage="two",
                  limits=(-1500.0, 1500.0), rule="DR-03")


def resistor(d):
    R_S = 10000.0 + round(d.random.uniform(-0.5, 0.5), 3)
    r = 1.0 + round(d.random.uniform(-2e-5, 2e-5), 7)
    rows = [
        d.certificate("R_S", "R_S, calibration of the standard resistor", "Ω", 0.010, c=r, x=exact(R_S)),
        d.drift("dR_D", "dR_D, drift of the standard resistor", "Ω", 0.0085, c=r),
        d.limits("dR_TS", "dR_TS, temperature of the oil bath, standard", "Ω", 0.0045, "oil bath 23.00 °C", c=r),
        d.mean("r", "r, ratio of the resistances, repeatability", "1", 1.1e-6, counts=(5, 6, 8), c=R_S, x=exact(r)),
        d.limits("r_C", "r_C, parasitic effects of the comparison", "1", 5.0e-7, "ratio bridge", c=R_S * r, x="1", shape="tri"),
        d.limits("dR_TX", "dR_TX, temperature of the item", "Ω", 0.006, "oil bath 23.00 °C", c=-1.0),
        d.limits("dR_P", "dR_P, reproducibility of the connection", "Ω", 0.005, "five connections"),
    ]
    return Budget("resistor", "en", "Standard resistor 10 kΩ", "Substitution in an oil bath", "Ω", R_S * r, rows,
                  Layout("qxiadsucbnrm", digits=3),
                  equation="R_X = (R_S + dR_D + dR_TS)*r*r_C - dR_TX + dR_P")


def weight(d):
    rows = [
        d.certificate("m_S", "mass of the reference weight", "mg", 0.30),
        d.drift("drift", "drift of the reference weight", "mg", 0.16),
        d.mean("dm", "repeatability of the weighing", "mg", 0.21, counts=(4, 5, 6)),
        d.limits("ecc", "eccentric load on the balance", "mg", 0.12, "plate of 4 points"),
        d.limits("sens", "sensitivity of the balance", "mg", 0.08, "weight of 10 g"),
        d.limits("air", "air buoyancy", "mg", 0.20, "1 ppm of the mass", shape="tri"),
        d.resolution("res", "resolution of the balance, difference", "mg", (0.1, 0.2)),
        d.limits("mag", "magnetic properties", "mg", 0.07, "class F1"),
    ]
    return Budget("weight_1kg", "en", "Weight 1 kg, deviation from nominal mass", "weights", "mg", d.near(1.5, 3), rows,
                  Layout("qiadsubnrm", "\t", claims_above=True), capability=0.35)


def balance(d):
    rows = [
        d.certificate("m_ref", "Referenzgewichte 200 g", "mg", 0.22),
        d.drift("drift", "Drift der Referenzgewichte", "mg", 0.15),
        d.mean("rep", "Wiederholbarkeit der Anzeige", "mg", 0.24, counts=(5, 6, 8, 10)),
        d.resolution("d0", "Ablesbarkeit des Prüflings ohne Last", "mg", (0.1, 0.2)),
        d.resolution("dL", "Ablesbarkeit des Prüflings mit Last", "mg", (0.5, 1.0)),
        d.limits("ecc", "Exzentrizität der Last", "mg", 0.20, "Prüfung mit 100 g"),
        d.limits("conv", "Konvektion", "mg", 0.12, "Temperaturunterschied höchstens 1 K"),
        d.limits("air", "Luftauftrieb", "mg", 0.16, "justiert vor der Kalibrierung"),
        d.limits("repro", "Reproduzierbarkeit", "mg", 0.15, "zwei Bediener"),
    ]
    return Budget("balance_220g", "de", "Waage, Abweichung der Anzeige bei 200 g", "Kalibrierung nach EURAMET cg-18", "mg",
                  d.near(0.8, 3), rows, Layout("qiuscbnm", ";", ",", digits=3))


def pt100(d):
    rows = [
        d.certificate("t_ref", "calibration of the reference thermometer", "mK", 14.0),
        d.drift("drift", "drift of the reference thermometer", "mK", 9.0),
        d.certificate("bridge", "calibration of the resistance bridge", "mΩ", 2.2, c=2.55),
        d.limits("hom", "homogeneity of the bath", "mK", 9.0, "survey of the bath", shape="rect"),
        d.limits("stab", "stability of the bath, cyclic temperature control", "mK", 5.5, "cyclic, two-point control",
                 shape="arcsine"),
        d.mean("rep", "repeatability of the readings", "mK", 7.5, counts=(5, 6, 8, 10)),
        d.resolution("res", "resolution of the item indication", "mK", (10.0, 20.0)),
        d.limits("imm", "immersion and heat conduction", "mK", 6.0, "immersed 20 mm less"),
        d.limits("self", "self-heating at 1 mA", "mK", 3.5, "two measuring currents"),
        d.limits("repro", "reproducibility of the item", "mK", 4.5, "ice point before and after"),
    ]
    return Budget("pt100", "en", "Pt100 thermometer at 100 °C, deviation", "thermometer", "mK", d.near(25.0, 3), rows,
                  Layout("qxiadsucbnrm", digits=2), p=0.95)


def pressure_balance(d):
    rows = [
        d.certificate("A", "effective area of the reference piston", "Pa", 60.0),
        d.drift("drift", "drift of the reference piston", "Pa", 38.0),
        d.certificate("m", "masses of the reference", "Pa", 33.0),
        d.limits("t", "temperature of the piston", "K", 0.30, "sensor in the base", c=110.0),
        d.limits("h", "difference of heights", "mm", 1.5, "line of reference", c=8.5),
        d.limits("tilt", "tilt of the axis", "Pa", 9.0, "spirit level"),
        d.mean("rep", "repeatability of the cross-float", "Pa", 85.0, counts=(5, 6, 8)),
        d.limits("sens", "sensitivity of the equilibrium", "Pa", 22.0, "smallest mass that moves the piston"),
        d.limits("repro", "reproducibility, assembled again", "Pa", 25.0, "two assemblies"),
        d.resolution("res", "resolution of the item's indicator of the fall rate", "Pa", (10.0, 20.0)),
    ]
    return Budget("pressure_balance", "en", "Pressure balance, 5 MPa, deviation", "Cross-float", "Pa", d.near(150.0, 3), rows,
                  Layout("qxiadsucbnrm", digits=3, heads=2))


def pressure_gauge(d):
    fine = d.random.choice((0.02, 0.05))
    full = 60.0
    percent = d.random.choice((0.05, 0.06, 0.08))
    a = float(f"{percent / 100 * full:.6g}")
    rows = [
        d.certificate("p_ref", "Referenzdruck des Normals", "bar", 0.030),
        d.drift("drift", "Drift des Normals", "bar", 0.021),
        d.resolution("res", "Auflösung des Prüflings", "bar", (0.1,)),
        d.mean("rep", "Wiederholbarkeit", "bar", 0.035, counts=(4, 5, 6)),
        d.limits("hys", "Umkehrspanne des Prüflings", "bar", 0.03, "aufwärts und abwärts"),
        d.limits("zero", "Nullpunkt des Prüflings", "bar", fine / 2, "vor und nach der Reihe"),
        d.row("conv", "Messumformer, Genauigkeit", "bar", a, ROOT3, "rect", "percent",
              f"{d.text(percent)} % vom Endwert, Endwert = 60 bar; geprüft {d.date()}", x=exact(20.0)),
        d.limits("h", "Höhendifferenz", "mm", 20.0, "Öl", c=8.6e-5),
        d.limits("repro", "Reproduzierbarkeit", "bar", 0.015, "zweimal angeschlossen"),
    ]
    return Budget("pressure_gauge", "de", "Manometer 60 bar, Abweichung bei 20 bar", "Vergleich mit Referenzdruck", "bar",
                  d.near(0.12, 2), rows, Layout("qxiadsucbnm", ";", ",", heads=2, claim_digits=3), limits=(-0.6, 0.6), rule="DR-01")


def torque(d):
    m, g, l = round(d.random.uniform(19.5, 20.5), 4), 9.8124, round(d.random.uniform(0.498, 0.502), 5)
    rows = [
        d.certificate("m", "m, mass of the load", "kg", 4.0e-4, c=g * l, x=exact(m)),
        d.limits("g", "g, acceleration of free fall", "m/s^2", 9.0e-5, "gravity map", c=m * l, x=exact(g)),
        d.certificate("l", "l, length of the lever", "m", 1.6e-5, c=m * g, x=exact(l)),
        d.drift("dl", "dl, drift of the lever arm, reference", "m", 9.0e-6, c=m * g),
        d.limits("dT", "dT, thermal expansion of the lever arm", "m", 6.0e-6, "21 °C to 22 °C", c=m * g),
        d.mean("dM", "dM, repeatability of the torque", "N m", 8.0e-3, counts=(4, 5, 6)),
        d.resolution("dR", "dR, resolution of the item's indication", "N m", (0.002, 0.005), whole=True),
        d.limits("dP", "dP, reproducibility over four mounting positions", "N m", 3.0e-3, "turned by 90°"),
    ]
    return Budget("torque", "en", "Torque transducer 100 N m", "", "N m", m * g * l, rows,
                  Layout("qxiadsucbnrm", digits=3, heads=1), equation="M = m*g*(l + dl + dT) + dM + dR + dP")


def force(d):
    rows = [
        d.certificate("F_N", "Kraft der Bezugsnormalmesseinrichtung", "N", 1.6),
        d.drift("drift", "Drift der Bezugsnormalmesseinrichtung", "N", 1.1),
        d.mean("rep", "Wiederholbarkeit in gleicher Einbaustellung", "N", 8.5, counts=(5, 6, 8)),
        d.limits("repro", "Reproduzierbarkeit in verschiedenen Einbaustellungen", "N", 1.3, "0°, 120°, 240°"),
        d.limits("zero", "Nullpunktabweichung des Prüflings", "N", 2.5, "vor und nach der Reihe"),
        d.resolution("res", "Auflösung des Prüflings", "N", (1.0, 2.0)),
        d.limits("temp", "Temperatur", "K", 1.0, "Raum 22 °C", c=0.55),
        d.specification("amp", "Messverstärker", "N", 2.6),
        d.limits("fit", "Interpolation mit Ausgleichsgerade", "N", 0.7, "Residuen der Ausgleichung", shape="tri"),
    ]
    return Budget("force", "de", "Kraftaufnehmer 10 kN", "Kalibrierung nach ISO 376", "N", 10000.0 + d.near(1.5, 2), rows,
                  Layout("qiadsubnm", ";", ",", digits=3, unit_first=False))


def pipette(d):
    rows = [
        d.certificate("bal", "calibration of the balance, reference", "mg", 0.14, c=1.0032),
        d.drift("drift", "drift of the balance since its calibration", "mg", 0.09, c=1.0032),
        d.mean("rep", "repeatability of the delivered volume", "µL", 0.21, counts=(10,)),
        d.limits("evap", "evaporation", "mg", 0.10, "weighed without delivery", c=1.0032),
        d.limits("tw", "temperature of the water", "K", 0.20, "sensor in the weighing vessel", c=0.21),
        d.limits("rho", "density of the water", "kg/m^3", 0.01, "equation of Tanaka", c=0.1),
        d.limits("air", "air density, buoyancy", "kg/m^3", 0.02, "20 °C, 50 %", c=0.9),
        d.limits("cub", "temperature of the pipette, expansion", "K", 0.5, "plastic", c=0.024),
        d.resolution("res", "resolution of the item's setting", "µL", (0.1, 0.2)),
        d.limits("op", "reproducibility between operators", "µL", 0.15, "handling by two operators"),
    ]
    return Budget("pipette", "en", "Piston pipette 100 µL, mean volume", "Gravimetric, ISO 8655-6", "µL", 100.0 + d.near(0.3, 2), rows,
                  Layout("qiudscbnm", digits=3), coverage="cut", p=0.95)


def caliper(d):
    rows = [
        d.specification("ref", "length of the reference gauge blocks, grade 1", "mm", 0.0060),
        d.certificate("ref_cal", "calibration of the reference gauge blocks", "mm", 0.0040),
        d.drift("drift", "drift of the reference gauge blocks", "mm", 0.0030),
        d.resolution("res", "resolution of the caliper", "mm", (0.01, 0.02)),
        d.single("rep", "repeatability of the caliper", "mm", 0.0035),
        d.limits("dt", "temperature difference of caliper and blocks", "K", 1.0, "1 h on the plate", c=0.00173),
        d.limits("da", "difference of the expansion coefficients", "1E-6/K", 2.0, "steel on steel", c=0.00015),
        d.limits("abbe", "Abbe offset and parallelism of the jaws", "mm", 0.005, "mechanical effects"),
        d.limits("op", "reproducibility, operator", "mm", 0.004, "force of measurement"),
    ]
    return Budget("caliper", "en", "Vernier caliper 150 mm, error of indication", "caliper", "mm", d.near(0.012, 2), rows,
                  Layout("qxiadsucbnrm", digits=2, claim_digits=3), limits=(-0.05, 0.05), rule="DR-03", coverage="t")


def humidity(d):
    rows = [
        d.certificate("dp", "calibration of the dew-point mirror, reference", "°C", 0.12, c=3.05),
        d.drift("drift", "drift of the dew-point mirror", "°C", 0.075, c=3.05),
        d.certificate("t", "temperature of the chamber", "°C", 0.10, c=2.9),
        d.limits("hom", "homogeneity of the chamber", "%RH", 0.30, "survey of 9 points"),
        d.limits("stab", "stability of the chamber humidity", "%RH", 0.12, "log of 30 min"),
        d.mean("rep", "repeatability of the hygrometer", "%RH", 0.22, counts=(5, 6, 8)),
        d.resolution("res", "resolution of the hygrometer", "%RH", (0.1, 0.2)),
        d.limits("hys", "hysteresis of the hygrometer", "%RH", 0.25, "rising and falling", shape="tri"),
        d.limits("repro", "reproducibility of the item", "%RH", 0.18, "second run"),
    ]
    return Budget("humidity", "en", "Thermohygrometer, 50 %RH at 23 °C, error", "Chamber with dew-point mirror", "%RH",
                  d.near(1.1, 2), rows, Layout("qxiadsucbnrm", ";", heads=0), capability=0.45)


def flow(d):
    m, t, rho = round(d.random.uniform(49.0, 51.0), 4), round(d.random.uniform(59.0, 61.0), 3), 998.21
    value = 6.0e4 * m / (rho * t)
    rows = [
        d.certificate("m", "m, Masse nach der Waage, Referenz", "kg", 0.020, c=6.0e4 / (rho * t), x=exact(m)),
        d.drift("dm", "dm, Drift der Waage", "kg", 0.015, c=6.0e4 / (rho * t)),
        d.limits("db", "db, Luftauftrieb", "kg", 0.010, "Luftdichte 1,2 kg/m³", c=6.0e4 / (rho * t)),
        d.limits("rho", "rho, Dichte des Wassers", "kg/m^3", 0.25, "Temperatur ±0,3 K", c=-value / rho, x=exact(rho)),
        d.limits("t", "t, Messzeit, Umschaltung", "s", 0.018, "Strahlschaltung", c=-value / t, x=exact(t)),
        d.mean("dq", "dq, Wiederholbarkeit", "L/min", 0.022, counts=(5, 6, 8)),
        d.resolution("dr", "dr, Auflösung des Prüflings", "L/min", (0.02, 0.05)),
        d.limits("ds", "ds, Reproduzierbarkeit", "L/min", 0.015, "zwei Tage"),
    ]
    return Budget("flow", "de", "Durchfluss 50 L/min", "Gravimetrisch", "L/min", value, rows,
                  Layout("qxiadsucbnm", ";", ",", digits=3), equation="q = 60000*(m + dm + db)/(rho*t) + dq + dr + ds")


def rotary_table(d):
    rows = [
        d.certificate("poly", "calibration of the reference polygon", "arcsec", 0.20),
        d.drift("drift", "drift of the reference polygon", "arcsec", 0.10),
        d.certificate("ac", "calibration of the autocollimator", "arcsec", 0.15),
        d.limits("flat", "flatness of the polygon faces", "arcsec", 0.16, "λ/20 over the aperture"),
        d.limits("ecc", "eccentric mounting and alignment", "arcsec", 0.10, "tilt below 5 arcsec", shape="tri"),
        d.mean("rep", "repeatability of the table", "arcsec", 0.17, counts=(4, 5, 6)),
        d.resolution("res", "resolution of the item's encoder", "arcsec", (0.1, 0.2), whole=True),
        d.limits("temp", "temperature gradient in the set-up", "arcsec", 0.08, "below 0.1 K/h"),
        d.limits("repro", "reproducibility, mounted again", "arcsec", 0.11, "three mountings"),
    ]
    return Budget("angle_table", "en", "Indexing table, deviation at 30°", "Polygon and autocollimator", "arcsec",
                  d.near(0.6, 2), rows, Layout("qiadsubnm", claims_above=True, heads=0), reference=(None, None))


def hardness(d):
    rows = [
        d.certificate("ref", "Härtevergleichsplatte, Referenz", "HRC", 0.30),
        d.drift("drift", "Drift der Härtevergleichsplatte", "HRC", 0.18),
        d.mean("rep", "Wiederholbarkeit der Härteprüfmaschine", "HRC", 0.27, counts=(5, 6)),
        d.resolution("res", "Auflösung der Anzeige der Prüfmaschine", "HRC", (0.1, 0.2)),
        d.limits("hom", "Inhomogenität der Platte", "HRC", 0.22, "Karte der Platte"),
        d.limits("temp", "Temperatur", "K", 3.0, "23 °C", c=0.02),
        d.specification("ind", "Eindringkörper", "HRC", 0.20),
        d.limits("repro", "Reproduzierbarkeit", "HRC", 0.15, "zwei Bediener"),
    ]
    return Budget("hardness", "de", "Härteprüfmaschine HRC, Abweichung bei 45 HRC", "Indirekte Kalibrierung", "HRC",
                  d.near(0.4, 2), rows, Layout("qiadtsucbnm", ";", ",", heads=0), reference=(None, None))


def attenuator(d):
    same = "certificate " + d.number()
    U = d.near(0.010)
    pad = d.certificate("pads", "two steps of the reference attenuator, one certificate", "dB", 0.010, c=2.0, source=same)
    pad.stated, pad.comment = U, f"U = {d.text(U)} dB, k = 2; {same}, the error of the step enters twice"
    rows = [
        pad,
        d.drift("drift", "drift of the reference attenuator", "dB", 0.0075, c=1.0),
        d.limits("mis", "mismatch", "dB", 0.012, "|Γ| below 0.05", shape="arcsine"),
        d.limits("leak", "leakage", "dB", 0.003, "isolated generator"),
        d.resolution("res_s", "resolution of the receiver, reference setting", "dB", (0.002, 0.005)),
        d.resolution("res_i", "resolution of the item setting", "dB", (0.005, 0.01)),
        d.mean("rep", "repeatability of the connection", "dB", 0.012, counts=(4, 5, 6)),
        d.limits("lin", "linearity of the receiver", "dB", 0.006, "two-tone test"),
        d.limits("temp", "temperature of the laboratory", "K", 1.0, "23 °C", c=0.0015),
    ]
    return Budget("attenuator", "en", "Step attenuator 30 dB at 1 GHz", "Substitution", "dB", 30.0 + d.near(0.04, 2), rows,
                  Layout("qxiadsucbnrm", digits=3, claim_digits=4))


def ph_meter(d):
    rows = [
        d.certificate("buf", "certified reference material, buffer solution", "1", 0.010),
        d.drift("drift", "stability of the buffer solution, reference, since opening", "1", 0.0075),
        d.certificate("ma", "calibration of the reference instrument, simulated voltage", "mV", 0.20, c=0.0169),
        d.limits("temp", "temperature of the solution", "K", 0.5, "sensor in the cell", c=0.0065),
        d.mean("rep", "repeatability of the readings", "1", 0.011, counts=(5, 6, 8)),
        d.resolution("res", "resolution of the pH meter under test", "1", (0.01, 0.02)),
        d.limits("lj", "liquid junction potential", "1", 0.009, "two buffers", shape="tri"),
        d.limits("repro", "reproducibility between operators", "1", 0.008, "rinsed and measured again"),
    ]
    return Budget("ph_meter", "en", "pH meter at pH 7, error", "Buffer solution", "1", d.near(0.025, 2), rows,
                  Layout("qxiadsucbnrm", ";", claims_above=True, heads=0), p=0.95)


def time_base(d):
    rows = [
        d.certificate("ref", "GPS-geführte Referenz, Kalibrierung", "µHz", 30.0),
        d.drift("drift", "Drift der Referenz", "µHz", 30.0),
        d.mean("rep", "Wiederholbarkeit der Frequenzmessung", "µHz", 52.0, counts=(5, 6, 8)),
        d.resolution("res", "Auflösung des Zählers, Prüfling", "µHz", (20.0, 50.0)),
        d.limits("trig", "Triggerabweichung", "µHz", 26.0, "Signal 1 V"),
        d.limits("temp", "Temperatur der Zeitbasis", "K", 1.0, "Raum 23 °C", c=13.0),
        d.limits("ageing", "Kurzzeitstabilität des Prüflings", "µHz", 16.0, "eine Stunde Einlaufzeit", shape="tri"),
        d.limits("repro", "Reproduzierbarkeit", "µHz", 15.0, "zwei Tage"),
    ]
    return Budget("time_base", "de", "Zeitbasis 10 MHz, Abweichung", "Frequenzvergleich", "µHz", d.near(240.0, 3), rows,
                  Layout("qiadtucbnrm", ";", ",", claims_above=True))


FIELDS = (end_gauge, gauge_block, multimeter, resistor, weight, balance, pt100, pressure_balance, pressure_gauge, torque, force,
          pipette, caliper, humidity, flow, rotary_table, hardness, attenuator, ph_meter, time_base)
GERMAN = (gauge_block, balance, pressure_gauge, force, flow, hardness, time_base)
