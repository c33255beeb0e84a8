#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "equations.h"

namespace gumcert::gum {
namespace {

using testing::HasSubstr;

std::vector<InputSymbol> checked_quantities() {
    return {input("x", "mm"),
            input("l", "m"),
            input("T", "K"),
            input("t", "degC"),
            input("t2", "degC"),
            input("phi", "rad"),
            input("n"),
            input("two", "1", 2.0),
            input("alpha", "1/K"),
            input("R", "ohm"),
            input("A", "1/K"),
            input("third", "1", 1.0 / 3.0),
            input("deg", "arcsec"),
            input("A_m", "m2"),
            input("dT", "delta_degC")};
}

std::string code(const std::string& equation, const std::vector<OutputSymbol>& outputs = {}) {
    return codes(problems_of({equation}, checked_quantities(), {}, outputs));
}

TEST(UnitCheck, SumsBalance) {
    EXPECT_EQ(code("y = x + l"), "");
    EXPECT_EQ(code("y = x + T"), "0030 m/0, column 7");
    EXPECT_EQ(code("y = x*l - l"), "0030 m/0, column 9");
    EXPECT_EQ(code("y = l*(1 + alpha*T)"), "");
    EXPECT_EQ(code("y = l*(1 + alpha*l)"), "0030 m/0, column 10");
    EXPECT_EQ(code("y = min(x, T)"), "0030 m/0, column 5");
    EXPECT_EQ(code("y = hypot(x, l) + sqrt(A_m) + abs(x)"), "");
    EXPECT_EQ(code("y = x + 1"), "0030 m/0, column 7");
    EXPECT_EQ(code("y = x + 0 - max(x, 0) + min(0, l, -0)"), "");
    EXPECT_EQ(code("y = 0 + x + l"), "");
    EXPECT_EQ(code("y = 0 + x + T"), "0030 m/0, column 11");
    EXPECT_EQ(code("y = (0 + 0) + x - min(0, 0)"), "");
    const std::string text = messages(problems_of({"y = 2*x + T"}, checked_quantities()));
    EXPECT_THAT(text, HasSubstr("m + K"));
    EXPECT_THAT(text, HasSubstr("\"2*x\" is in m"));
    EXPECT_THAT(text, HasSubstr("\"T\" is in K"));
    EXPECT_THAT(messages(problems_of({"y = x + T"}, checked_quantities())), HasSubstr("mm + K"));
}

TEST(UnitCheck, GoesThroughIntermediateQuantitiesAndImplicitEquations) {
    EXPECT_EQ(codes(problems_of({"y = z + x", "z = l*T"}, checked_quantities())), "0030 m/0, column 7");
    EXPECT_EQ(codes(problems_of({"0 = R*(1 + A*q) - l"}, checked_quantities(), {unknown("q", 20, "degC")})),
              "0030 m/0, column 17");
    EXPECT_EQ(codes(problems_of({"0 = R*(1 + A*q) - R"}, checked_quantities(), {unknown("q", 20, "degC")})), "");
    // One problem, not one for every equation that follows from it.
    EXPECT_EQ(codes(problems_of({"y = z + x", "z = l + T", "w = z*2"}, checked_quantities())), "0030 m/1, column 7");
}

TEST(UnitCheck, ArgumentsOfFunctions) {
    EXPECT_EQ(code("y = ln(x)"), "0031 m/0, column 5");
    EXPECT_EQ(code("y = ln(x/l) + exp(n) + tanh(alpha*T) + ln(2)"), "");
    EXPECT_EQ(code("y = exp(phi)"), "0031 m/0, column 5");
    EXPECT_EQ(code("y = sin(phi) + cos(deg) + tan(asin(n)) + sin(0)"), "");
    EXPECT_EQ(code("y = sin(n)"), "0032 m/0, column 5");
    EXPECT_EQ(code("y = sin(x)"), "0032 m/0, column 5");
    EXPECT_THAT(messages(problems_of({"y = sin(n)"}, checked_quantities())), HasSubstr("*rad"));
    EXPECT_EQ(code("y = asin(n) + acos(n) + atan(x/l) + atan2(x, l) - phi"), "");
    EXPECT_EQ(code("y = atan2(x, T)"), "0030 m/0, column 5");
}

/// Wherever a level and a number meet, the message says how one is made of the other, and what it says balances.
TEST(UnitCheck, TheDecibelIsNotOne) {
    std::vector<InputSymbol> quantities = checked_quantities();
    quantities.push_back(input("L", "dB"));
    quantities.push_back(input("dB_1", "dB", 1.0));
    const auto problems = [&](const std::string& equation, const std::vector<OutputSymbol>& outputs = {}) {
        return problems_of({equation}, quantities, {}, outputs);
    };
    EXPECT_EQ(codes(problems("y = L - 2*L + 20*log10(x/l)*dB_1", {output("y", "dB")})), "");
    EXPECT_EQ(codes(problems("y = l*10^(L/(20*dB_1))", {output("y", "m")})), "");
    for (const std::vector<Diagnostic>& found :
         {problems("y = L + 20*log10(x/l)"), problems("y = l*10^(L/20)"),
          problems("y = 20*log10(x/l)", {output("y", "dB")}), problems("y = L", {output("y", "1")})}) {
        ASSERT_EQ(found.size(), 1U);
        EXPECT_THAT(found[0].action, HasSubstr("dB_1"));
    }
}

TEST(UnitCheck, TheRadianIsNotOne) {
    EXPECT_EQ(code("y = l*phi", {output("y", "m")}), "0035 output y");
    EXPECT_EQ(code("y = l*phi/rad", {output("y", "m")}), "");
    EXPECT_THAT(messages(problems_of({"y = l*phi"}, checked_quantities(), {}, {output("y", "m")})), HasSubstr("/rad"));
    EXPECT_THAT(messages(problems_of({"y = l*phi + x"}, checked_quantities())), HasSubstr("(\"/rad\")"));
    EXPECT_EQ(code("y = n*rad + phi"), "");
}

TEST(UnitCheck, Exponents) {
    EXPECT_EQ(code("y = x^2", {output("y", "m2")}), "");
    EXPECT_EQ(code("y = x^two", {output("y", "m2")}), "");
    EXPECT_EQ(code("y = A_m^(1/2)", {output("y", "m")}), "");
    EXPECT_EQ(code("y = x^-3", {output("y", "m-3")}), "");
    EXPECT_EQ(code("y = (x^3)^third", {output("y", "m")}), "");
    EXPECT_EQ(code("y = x^n"), "0034 m/0, column 6");
    EXPECT_EQ(code("y = n^n"), "");
    EXPECT_EQ(code("y = n^x"), "0033 m/0, column 6");
    EXPECT_EQ(code("y = x^0.5", {output("y", "m^(1/2)")}), "");
    EXPECT_EQ(code("y = x^(1/11)"), "0039 m/0, column 1");
    EXPECT_EQ(code("y = sqrt(x)*sqrt(l)", {output("y", "m")}), "");
}

TEST(UnitCheck, UnitsOfOutputs) {
    EXPECT_EQ(code("y = x", {output("y", "nm")}), "");
    EXPECT_EQ(code("y = x", {output("y", "K")}), "0035 output y");
    EXPECT_EQ(system_of({"y = x*l"}, checked_quantities()).output_unit(0).dimension().text(), "m2");
    EXPECT_EQ(system_of({"y = x*l"}, checked_quantities(), {}, {output("y", "mm2")}).output_unit(0).text(), "mm2");
    EXPECT_EQ(code("y = 0", {output("y", "m")}), "");
}

TEST(TemperatureKind, Table) {
    const std::vector<std::tuple<std::string, std::string, std::string>> table{
        // equation, declared unit ("" = none), codes
        {"y = t - t2", "K", ""},
        {"y = t - t2", "degC", "0036 output y"},
        {"y = t - t2", "delta_degC", ""},
        {"y = t + dT", "degC", ""},
        {"y = t + T", "degC", ""},
        {"y = t + T", "K", "0036 output y"},
        {"y = (t + t2)/2", "degC", ""},
        {"y = (t + t2)/2", "K", "0036 output y"},
        {"y = t + t2", "degC", "0036 output y"},
        {"y = t + t2", "", "0038 m/0, column 1"},
        {"y = 0.5*t + 0.5*t2", "degC", ""},
        {"y = third*t + 2*third*t2", "degC", ""},
        {"y = t", "K", "0036 output y"},
        {"y = kelvin(t)", "K", ""},
        {"y = kelvin(t)", "degC", "0036 output y"},
        {"y = T", "degC", "0036 output y"},
        {"y = celsius(T)", "degC", ""},
        {"y = celsius(T)", "degF", ""},
        {"y = celsius(t)", "", "0037 m/0, column 5"},
        {"y = kelvin(T)", "", "0037 m/0, column 5"},
        {"y = celsius(x)", "", "0037 m/0, column 5"},
        {"y = -t", "", "0038 m/0, column 1"},
        {"y = t2 - -t + -t", "degC", ""},
        {"y = n*t", "K", ""},
        {"y = alpha*t", "1", ""},
        {"y = alpha*t*T", "K", ""},
        {"y = 2*t - t2", "degC", ""},
        {"y = min(t, t2)", "degC", ""},
        {"y = max(t, T)", "", "0037 m/0, column 5"},
        {"y = max(t, 0)", "degC", ""},
        {"y = abs(t)", "", "0037 m/0, column 5"},
        {"y = abs(t - t2)", "K", ""},
        {"y = hypot(t, t2)", "", "0037 m/0, column 5"},
        {"y = atan2(t, t2)", "", "0037 m/0, column 5"},
        {"y = t^1", "degC", ""},
        {"y = A*t^2", "K", ""},
        {"y = t + 0", "degC", ""},
        {"y = t + 20", "", "0030 m/0, column 7"},
    };
    for (const auto& [equation, unit, expected] : table) {
        const std::vector<OutputSymbol> outputs =
            unit.empty() ? std::vector<OutputSymbol>{} : std::vector<OutputSymbol>{output("y", unit)};
        EXPECT_EQ(code(equation, outputs), expected) << equation << " in " << unit;
    }
}

TEST(TemperatureKind, IsInferredAndCured) {
    EXPECT_TRUE(system_of({"y = (t + t2)/2"}, checked_quantities()).output_unit(0).is_celsius_temperature());
    EXPECT_FALSE(system_of({"y = t - t2"}, checked_quantities()).output_unit(0).is_celsius_temperature());
    EXPECT_THAT(messages(problems_of({"y = T"}, checked_quantities(), {}, {output("y", "degC")})),
                HasSubstr("celsius(…)"));
    EXPECT_THAT(messages(problems_of({"y = t"}, checked_quantities(), {}, {output("y", "K")})), HasSubstr("kelvin(t)"));
    EXPECT_EQ(codes(problems_of({"0 = q - T"}, checked_quantities(), {unknown("q", 20, "degC")})),
              "0036 m/0, column 1");
    EXPECT_EQ(codes(problems_of({"0 = q - celsius(T)"}, checked_quantities(), {unknown("q", 20, "degC")})), "");
    EXPECT_EQ(system_of({"y = celsius(T)"}, {input("T", "K")}).evaluate(vector({293.15}))(0), 293.15 - 273.15);
}

/// What a message advises, followed, gives the right number. Every message of the unit check that tells a cure is here.
TEST(UnitCheck, CuresLeadToTheRightNumber) {
    struct Cure {
        std::string equation, unit;       ///< refused
        std::string code, advice;         ///< a part of what is advised
        std::string corrected, new_unit;  ///< as advised
        double value;                     ///< coherent SI
    };
    const double pi = 3.14159265358979323846;
    const std::vector<Cure> cures{
        {"y = x + l*phi", "", "0030", "divide the second by it (\"/rad\")", "y = x + l*phi/rad", "", 1.002},
        {"y = l*phi + x", "", "0030", "divide the first by it (\"/rad\")", "y = l*phi/rad + x", "", 1.002},
        {"y = exp(phi)", "", "0031", "Divide the angle by rad: exp(phi/rad)", "y = exp(phi/rad)", "", std::exp(0.5)},
        {"y = sin(n)", "", "0032", "write sin(n*rad)", "y = sin(n*rad)", "", std::sin(3.0)},
        {"y = n^phi", "", "0033", "Divide the angle by rad", "y = n^(phi/rad)", "", std::sqrt(3.0)},
        {"y = x^n", "", "0034", "Divide the base by a quantity of the same unit", "y = (x/l)^n", "", 1e-9},
        {"y = phi*l", "m", "0035", "divide the right side by it (\"/rad\")", "y = phi*l/rad", "m", 1.0},
        {"y = (R - R)/R/A + T", "degC", "0036", "celsius(…) around the right side", "y = celsius((R - R)/R/A + T)",
         "degC", 300.0 - 273.15},
        {"y = (R/100 - R/200)/R/A", "degC", "0036", "\" + t_0\" to the right side", "y = (R/100 - R/200)/R/A + t_0",
         "degC", 0.005 / 4e-3},
        {"y = T - dT", "degC", "0036", "declare y in K", "y = T - dT", "K", 299.0},
        {"y = t", "K", "0036", "Write kelvin(t)", "y = kelvin(t)", "K", 293.15},
        {"y = t", "K", "0036", "or declare y in degC", "y = t", "degC", 20.0},
        {"y = t + t2", "degC", "0036", "Divide by 2 where a mean", "y = (t + t2)/2", "degC", 25.0},
        {"y = t + t2", "", "0038", "subtract Celsius temperatures until a difference is left", "y = t - t2", "", -10.0},
        {"y = t + t2", "", "0038", "write kelvin(t) for each", "y = kelvin(t) + kelvin(t2)", "", 596.3},
        {"y = T - t", "", "0038", "Write kelvin(t) for each", "y = T - kelvin(t)", "", 300.0 - 293.15},
        {"y = T - t", "", "0038", "or celsius(T) for the thermodynamic temperature T", "y = celsius(T) - t", "",
         300.0 - 293.15},
        {"y = -t", "K", "0036", "Write kelvin(t) for each", "y = -kelvin(t)", "K", -293.15},
        {"y = t_F", "K", "0036", "Write kelvin(t) for a Fahrenheit temperature t", "y = kelvin(t_F)", "K", 298.15},
        {"y = t_F", "K", "0036", "or declare y in degF", "y = t_F", "degF", 25.0},
        {"y = T", "degF", "0036", "celsius(…) around the right side", "y = celsius(T)", "degF", 300.0 - 273.15},
        {"y = (R/100 - R/200)/R/A", "degF", "0036", "\"t_0\": {\"value\": 0, \"unit\": \"degF\"",
         "y = (R/100 - R/200)/R/A + t_0F", "degF", 0.005 / 4e-3 - 160.0 / 9.0},
        {"y = T - dT", "degF", "0036", "declare y in K or delta_degF", "y = T - dT", "delta_degF", 299.0},
        {"y = abs(t)", "", "0037", "Take a difference of two temperatures", "y = abs(t - t2)", "", 10.0},
        {"y = abs(t)", "", "0037", "or kelvin(t)", "y = abs(kelvin(t))", "", 293.15},
        {"y = celsius(t)", "", "0037", "Leave celsius(…) out", "y = t", "", 20.0},
        {"y = kelvin(T)", "", "0037", "Leave kelvin(…) out", "y = T", "", 300.0},
        {"y = min(t, T)", "", "0037", "Write kelvin(t) or celsius(T) for one of them", "y = min(kelvin(t), T)", "",
         293.15},
        {"y = min(t, T)", "", "0037", "Write kelvin(t) or celsius(T) for one of them", "y = min(t, celsius(T))", "",
         20.0},
        {"y = x^n", "", "0034", "declare the exponent as \"constant\"", "y = x^two", "", 1e-6 * 4.0},
        {"y = asin(x/l)*l", "m", "0035", "divide the right side by it", "y = asin(x/l)*l/rad", "m",
         2.0 * std::asin(1e-3)},
        {"y = cos(n*pi)", "", "0032", "write cos((n*pi)*rad)", "y = cos((n*pi)*rad)", "", std::cos(3.0 * pi)},
        {"y = v", "Hz", "0035", "by a turn (\"/(2*pi*rad)\")", "y = v/(2*pi*rad)", "Hz", 1.0},
        {"y = v", "Hz", "0035", "by the radian (\"/rad\")", "y = v/rad", "Hz", 2.0 * pi},
        {"y = f_v - v", "", "0030", "divide the second by a turn (\"/(2*pi*rad)\")", "y = f_v - v/(2*pi*rad)", "", 2.0},
        {"y = N_v", "1", "0035", "by a turn (\"/(2*pi*rad)\")", "y = N_v/(2*pi*rad)", "1", 3.0}};
    std::vector<InputSymbol> inputs = checked_quantities();
    inputs.push_back(input("v", "rpm"));
    inputs.push_back(input("f_v", "Hz"));
    inputs.push_back(input("N_v", "turn"));
    inputs.push_back(input("t_0", "degC", 0.0));
    inputs.push_back(input("t_F", "degF"));
    inputs.push_back(input("t_0F", "degF", -160.0 / 9.0));
    const std::map<std::string, double> values{
        {"x", 2e-3},     {"l", 2.0},   {"T", 300.0},      {"t", 20.0},   {"t2", 30.0},          {"phi", 0.5},
        {"n", 3.0},      {"two", 2.0}, {"A", 4e-3},       {"R", 100.0},  {"dT", 1.0},           {"t_0", 0.0},
        {"v", 2.0 * pi}, {"f_v", 3.0}, {"N_v", 6.0 * pi}, {"t_F", 25.0}, {"t_0F", -160.0 / 9.0}};
    for (const Cure& cure : cures) {
        SCOPED_TRACE(cure.equation);
        const auto outputs = [](const std::string& unit) {
            return unit.empty() ? std::vector<OutputSymbol>{} : std::vector{output("y", unit)};
        };
        const std::vector<Diagnostic> problems = problems_of({cure.equation}, inputs, {}, outputs(cure.unit));
        ASSERT_EQ(problems.size(), 1U);
        EXPECT_EQ(problems[0].code, "GC-MODEL-" + cure.code);
        EXPECT_THAT(problems[0].action, HasSubstr(cure.advice));
        const EquationSystem system = system_of({cure.corrected}, inputs, {}, outputs(cure.new_unit));
        EXPECT_TRUE(system.warnings().empty()) << system.warnings().front().what;
        Eigen::VectorXd at = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(inputs.size()));
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const auto known = values.find(inputs[i].name);
            at(static_cast<Eigen::Index>(i)) = known == values.end() ? 1.0 : known->second;
        }
        EXPECT_NEAR(system.evaluate(at)(0), cure.value, 1e-12 + 1e-12 * std::fabs(cure.value));
    }
}

TEST(UnitCheck, NamesTheOperandThatIsMeant) {
    std::vector<InputSymbol> inputs = checked_quantities();
    inputs.push_back(input("t_0", "degC", 0.0));
    inputs.push_back(input("t_F", "degF"));
    inputs.push_back(input("v", "rpm"));
    inputs.push_back(input("f_v", "Hz"));
    const auto text = [&](const std::string& equation) { return messages(problems_of({equation}, inputs)); };
    // The Celsius temperature, not the difference beside it.
    for (const char* equation : {"y = hypot(t, dT)", "y = hypot(dT, t)", "y = hypot(T - T, t)"}) {
        EXPECT_THAT(text(equation), HasSubstr("hypot of degC, a Celsius temperature")) << equation;
    }
    EXPECT_THAT(text("y = atan2(dT, t)"), HasSubstr("atan2 of degC, a Celsius temperature"));
    // The Fahrenheit temperature, on either side of a factor; its zero has a name that is not taken.
    for (const char* equation : {"y = t_F*R", "y = R*t_F", "y = t_F/R"}) {
        EXPECT_THAT(text(equation), HasSubstr("\"t_F\", a Fahrenheit temperature, is a factor")) << equation;
        EXPECT_THAT(text(equation), HasSubstr("Write (t_F - t_0) for \"t_F\"")) << equation;
    }
    EXPECT_THAT(text("y = t_F*R + (t - t_0)*R"), HasSubstr("Write (t_F - t_0F) for \"t_F\""));
    // The term that has an angle more.
    EXPECT_THAT(text("y = v - f_v"), HasSubstr("divide the first by a turn"));
    EXPECT_THAT(text("y = f_v - v"), HasSubstr("divide the second by a turn"));
}

TEST(UnitCheck, ResultsWithoutAUnitHaveOneThatTheInputsUse) {
    const auto unit = [](const std::string& equation, const std::vector<InputSymbol>& inputs) {
        return system_of({equation}, inputs).output_unit(0).text();
    };
    EXPECT_EQ(unit("y = a - b", {input("a", "V"), input("b", "V")}), "V");
    EXPECT_EQ(unit("y = a - b", {input("a", "mV"), input("b", "V")}), "mV");
    EXPECT_EQ(unit("y = a/b", {input("a", "V"), input("b", "mA")}), "ohm");
    EXPECT_EQ(unit("y = a/b", {input("a", "mV"), input("b", "mV")}), "1");
    EXPECT_EQ(unit("y = a*(1 + b)", {input("a", "um"), input("b", "percent")}), "um");
    EXPECT_EQ(unit("y = a*b", {input("a", "percent"), input("b", "percent")}), "1");
    EXPECT_EQ(unit("y = a*b", {input("a", "V"), input("b", "A")}), "W");
    EXPECT_EQ(unit("y = a/b", {input("a", "N"), input("b", "mm2")}), "Pa");
    EXPECT_EQ(unit("y = a*b", {input("a", "mm"), input("b", "mm")}), "m2");
    EXPECT_EQ(unit("y = a + b", {input("a", "degC"), input("b", "mK")}), "degC");
    EXPECT_EQ(unit("y = a - b", {input("a", "degC"), input("b", "degC")}), "K");
    EXPECT_EQ(unit("y = atan(a/b)", {input("a", "m"), input("b", "m")}), "rad");
}

}  // namespace
}  // namespace gumcert::gum
