#include "gum/expression/temperature_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "equations.h"

namespace gumcert::gum {
namespace {

using testing::HasSubstr;

std::vector<InputSymbol> quantities() {
    return {input("p", "Pa"),
            input("M", "kg/mol", 0.028964),
            input("R", "J/(mol K)", 8.314462618),
            input("t", "degC"),
            input("t2", "degC"),
            input("t_F", "degF"),
            input("T", "K"),
            input("dt", "K"),
            input("t_0", "degC", 0.0),
            input("t_0C", "degC", 0.0),
            input("t_0F", "degF", 255.37222222222223),
            input("d_c", "K", 0.05),
            input("T_0", "K", 273.15),
            input("b_m", "K", 243.12),
            input("s", "W/(m2 K4)", 5.67e-8),
            input("A", "1/K", 3.9083e-3),
            input("B", "1/K2", -5.775e-7),
            input("C", "1/K4", -4.183e-12),
            input("R_0", "ohm"),
            input("S", "uV/K"),
            input("n", "mol"),
            input("w", "1"),
            input("w2", "1"),
            input("c", "J/(kg K)"),
            input("m", "kg"),
            input("E_a", "J/mol"),
            input("q_0", "W/m2"),
            input("b", "m3", 0.001),
            input("L", "m"),
            input("Q", "J")};
}

std::string warned(const std::vector<std::string>& equations, const std::vector<OutputSymbol>& outputs = {}) {
    std::string list;
    const EquationSystem system = system_of(equations, quantities(), {}, outputs);
    for (const Diagnostic& warning : system.warnings()) {
        EXPECT_EQ(warning.severity, Severity::warning);
        list += (list.empty() ? "" : "; ") + warning.code.substr(9) + " " + warning.where;
    }
    return list;
}

TEST(TemperatureCheck, WarnsOfQuotientsRootsAndPowers) {
    EXPECT_EQ(warned({"rho = p*M/(R*t)"}), "0040 m/0, column 10");
    EXPECT_EQ(warned({"y = p/t"}), "0040 m/0, column 6");
    EXPECT_EQ(warned({"y = t/t2"}), "0040 m/0, column 6");
    EXPECT_EQ(warned({"rho = p*M/(R*(t + dt))"}), "0040 m/0, column 10");
    EXPECT_EQ(warned({"q = s*t^4"}), "0041 m/0, column 6");
    EXPECT_EQ(warned({"q = s*(t^4 - t2^4)"}), "0041 m/0, column 6");
    EXPECT_EQ(warned({"q = q_0 + s*t*t*t*t"}), "0041 m/0, column 18") << "a + s t⁴ is no polynomial";
    EXPECT_EQ(warned({"v = sqrt(R*t/M)"}), "0040 m/0, column 5");
    EXPECT_EQ(warned({"v = (R*t/M)^0.5"}), "0040 m/0, column 12");
    EXPECT_EQ(warned({"v = (R*t)^-1*n"}), "0040 m/0, column 10");
    EXPECT_EQ(warned({"y = ln(t/T)"}), "0040 m/0, column 5");
    EXPECT_EQ(warned({"y = exp(-E_a/(R*t))"}), "0040 m/0, column 13");
    EXPECT_EQ(warned({"V = n*R*t/p"}), "0041 m/0, column 10");
    EXPECT_EQ(warned({"y = w*t"}, {output("y", "K")}), "0041 m/0, column 6");
}

/// A law in a larger sum is no polynomial: another quantity per kelvin than a plain 1/K, and one more with a unit.
TEST(TemperatureCheck, WarnsOfALawInALargerSum) {
    EXPECT_EQ(warned({"y = n*R*t/p - b"}), "0041 m/0, column 10");
    EXPECT_EQ(warned({"y = b - n*R*t/p"}), "0041 m/0, column 14");
    EXPECT_EQ(warned({"y = 2*(b + (n*R*t)/p)"}), "0041 m/0, column 19");
    EXPECT_EQ(warned({"y = b + (n*R/p)*t + b"}), "0041 m/0, column 16");
    EXPECT_EQ(warned({"y = p*b - n*R*t"}), "0041 m/0, column 14");
    EXPECT_EQ(warned({"y = x - b", "x = n*R*t/p"}), "0041 m/1, column 10");
    EXPECT_EQ(warned({"y = Q + m*c*t"}), "0041 m/0, column 12");
    for (const char* equation :
         {"y = L + A*L*t", "y = q_0 + S*t*q_0/S/dt", "y = R_0 + R_0*A*t", "y = w + A*t", "y = b + n*R*kelvin(t)/p",
          "y = b + n*R*(t - t_0)/p", "y = n*R*(t - t2)/p + b", "y = Q + m*c*t - m*c*t2", "y = Q - m*c*t + m*c*t2",
          "y = Q + S*t*Q/S/dt", "y = b*(1 + A*t)"}) {
        EXPECT_EQ(warned({equation}), "") << equation;
    }
}

/// Texts for °F speak of °F, and their cures are for it.
TEST(TemperatureCheck, SpeaksOfFahrenheitWhereItIsMeant) {
    const std::vector<Diagnostic> warnings{system_of({"y = sqrt(t_F)"}, quantities()).warnings()};
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0].what, HasSubstr("a Fahrenheit temperature"));
    EXPECT_THAT(warnings[0].rule, HasSubstr("the number in degF is a difference from 0 degF"));
    EXPECT_THAT(warnings[0].action, HasSubstr(R"((t_F - t_0) with the input "t_0": {"value": 0, "unit": "degF")"));
    EXPECT_EQ(warned({"y = sqrt(kelvin(t_F))"}), "");
    EXPECT_EQ(warned({"y = sqrt((t_F - t_0F))"}), "");
    EXPECT_THAT(system_of({"y = t_F^4"}, quantities()).warnings().front().what,
                HasSubstr("power 4 of the Fahrenheit temperature"));
}

TEST(TemperatureCheck, ACorrectionMovesNoZero) {
    EXPECT_EQ(warned({"rho = p*M/(R*(t + d_c))"}), "0040 m/0, column 10");
    EXPECT_EQ(warned({"v = sqrt(R*(t + d_c)/M)"}), "0040 m/0, column 5");
    EXPECT_EQ(warned({"V = n*R*t/p + 0"}), "0041 m/0, column 10");
    EXPECT_EQ(warned({"V = n*R*t/p + n*R*t/p"}), "0041 m/0, column 10");
    EXPECT_EQ(warned({"rho = p*M/(R*T_m)", "T_m = w*t + (1 - w)*t2"}, {output("rho", "kg/m3")}), "0040 m/0, column 10");
}

/// Without a declared unit "K" would be a guess; the cure gives the value in degC.
TEST(TemperatureCheck, StatesNoKelvinWhereTheWeightOfATemperatureIsNotKnown) {
    for (const char* equation : {"y = w*t + (1 - w)*t2", "y = (1 + w)*t + dt", "y = (w*t + w2*t2)/(w + w2)"}) {
        try {
            (void)warned({equation});
            ADD_FAILURE() << equation;
        } catch (const InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-MODEL-0036") << equation;
            EXPECT_THAT(error.diagnostics().front().action, HasSubstr("\" + t_0\""));
        }
        const EquationSystem cured = system_of({std::string(equation) + " + t_0"}, quantities(), {}, {});
        EXPECT_TRUE(cured.output_unit(0).is_celsius_temperature()) << equation;
        EXPECT_TRUE(cured.warnings().empty()) << equation;
    }
}

TEST(TemperatureCheck, RefusesFahrenheitInProducts) {
    for (const char* equation : {"y = R_0*(1 + A*t_F)", "y = p*M/R/t_F", "y = A*(t_F + dt)", "y = w*t_F"}) {
        try {
            (void)warned({equation});
            ADD_FAILURE() << equation;
        } catch (const InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-MODEL-0043") << equation;
            EXPECT_THAT(error.diagnostics().front().action, HasSubstr("kelvin("));
        }
    }
    EXPECT_EQ(warned({"y = (t_F + t2)/2"}), "");
    EXPECT_EQ(warned({"y = R_0*(1 + A*(t_F - t_0F))"}), "") << "the first cure";
    EXPECT_EQ(warned({"y = R_0*(1 + A*t)"}), "") << "the second";
    EXPECT_EQ(warned({"y = p*M/(R*kelvin(t_F))"}), "") << "the third";
}

TEST(TemperatureCheck, TheNameOfTheCureIsFree) {
    const EquationSystem system = system_of({"y = p*M/(R*t)*(t2 - t_0)/dt"}, quantities(), {}, {});
    ASSERT_FALSE(system.warnings().empty());
    EXPECT_THAT(system.warnings().front().action, HasSubstr("(t - t_0C)"));
}

TEST(TemperatureCheck, FollowsIntermediateQuantities) {
    EXPECT_EQ(warned({"rho = p*M/x", "x = R*y", "y = t"}), "0040 m/0, column 10");
    EXPECT_EQ(warned({"rho = p*M/(R*t_c)", "t_c = t + dt"}), "0040 m/0, column 10");
    EXPECT_EQ(warned({"W = 1 + x", "x = A*t"}), "");
    EXPECT_EQ(warned({"rho = p*M/(R*T_c)", "T_c = kelvin(t + dt)"}), "");
}

TEST(TemperatureCheck, IsSilentWhereADifferenceFromZeroIsMeant) {
    for (const char* equation : {
             "y = R_0*(1 + A*t + B*t^2)",                       // Callendar-Van Dusen above 0 °C
             "y = R_0*(1 + A*t + B*t^2 + C*(t - 100*dt)*t^3)",  // below it
             "y = R_0*(1 + t*(A + B*t))",                       // Horner's form
             "y = A*t + B*t^2",                                 //
             "y = m*c*(t - t2)",                                //
             "y = m*c*t - m*c*t2",                              //
             "y = p*M/(R*kelvin(t))",                           //
             "y = p*M/(R*(t + T_0))",                           // the conversion by hand
             "y = p*M/(R*(t - t_0))",                           // on purpose
             "y = p*exp(17.62*t/(b_m + t))",                    // Magnus
             "y = p*exp(w*A*t)",                                //
             "y = p/(1 + A*t)",                                 //
             "y = s*(kelvin(t)^4 - kelvin(t2)^4)",              //
             "y = (t + t2)/2",                                  //
             "y = t + dt",                                      //
             "y = 0.5*t + 0.5*t2",                              //
             "y = log10(p/p) + w/(t + b_m)*dt",                 // Antoine
             "y = (w*t + w2*t2)/(w + w2) + t_0",                // a mean with weights
             "y = 1/(t - t2)*dt",                               //
             "y = sqrt(T/dt)",
             "y = s*T^4",
             "y = n*R*T/p",  // kelvin
         }) {
        std::string list;
        try {
            list = warned({equation});
        } catch (const InputError& error) {
            list = message(error.diagnostics().front());
        }
        EXPECT_EQ(list, "") << equation;
    }
}

TEST(TemperatureCheck, WarnsOfLogOnce) {
    EXPECT_EQ(warned({"y = log(w) + log(w2)", "z = log(w)"}), "0042 m/0, column 5");
    EXPECT_EQ(warned({"y = ln(w) + log10(w2)"}), "");
    EXPECT_EQ(warned({"y = (log(w))"}), "0042 m/0, column 6");
}

/// Replaces every quoted expression after a word of a message by what the message tells to write.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const std::size_t from = text.find(before);
    EXPECT_NE(from, std::string::npos) << text;
    const std::size_t begin = from + before.size();
    return text.substr(begin, text.find(after, begin) - begin);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.rfind(what);
    EXPECT_NE(at, std::string::npos) << what << " in " << text;
    return text.replace(at, what.size(), by);
}

/// Both cures of every message, followed to the letter, give what they promise.
TEST(TemperatureCheck, CuresLeadToTheRightNumber) {
    struct Cure {
        std::string equation;
        double with_kelvin, with_difference;  // at t = 25 °C, dt = 1 K, p = 101325, n = 2, T = 300 K
    };
    const double R = 8.314462618;
    const std::vector<Cure> cases{
        {"y = p*M/(R*t)", 101325 * 0.028964 / (R * 298.15), 101325 * 0.028964 / (R * 25.0)},
        {"y = p*M/(R*(t + dt))", 101325 * 0.028964 / (R * 299.15), 101325 * 0.028964 / (R * 26.0)},
        {"y = s*t^4", 5.67e-8 * std::pow(298.15, 4), 5.67e-8 * std::pow(25.0, 4)},
        {"y = n*R*t/p", 2.0 * R * 298.15 / 101325, 2.0 * R * 25.0 / 101325},
        {"y = sqrt(R*t/M)", std::sqrt(R * 298.15 / 0.028964), std::sqrt(R * 25.0 / 0.028964)},
        {"y = ln(t/T)", std::log(298.15 / 300.0), std::log(25.0 / 300.0)},
        {"y = n*R*t/p - b", 2.0 * R * 298.15 / 101325 - 0.001, 2.0 * R * 25.0 / 101325 - 0.001},
        {"y = b + n*R*(t + dt)/p", 2.0 * R * 299.15 / 101325 + 0.001, 2.0 * R * 26.0 / 101325 + 0.001},
    };
    const std::map<std::string, double> values{{"p", 101325}, {"t", 25.0}, {"dt", 1.0}, {"n", 2.0}, {"T", 300.0}};
    const std::vector<InputSymbol> symbols = quantities();
    const auto value = [&](const std::string& equation) {
        const EquationSystem system = system_of({equation}, symbols);
        EXPECT_TRUE(system.warnings().empty()) << equation;
        Eigen::VectorXd x(static_cast<Eigen::Index>(symbols.size()));
        for (std::size_t i = 0; i < symbols.size(); ++i) {
            const auto known = values.find(symbols[i].name);
            x(static_cast<Eigen::Index>(i)) = known != values.end() ? known->second : symbols[i].constant.value_or(1.0);
        }
        return system.evaluate(x)(0);
    };
    for (const Cure& one : cases) {
        SCOPED_TRACE(one.equation);
        const std::vector<Diagnostic> warnings{system_of({one.equation}, symbols).warnings()};
        ASSERT_FALSE(warnings.empty());
        const std::string& action = warnings.front().action;
        const std::string meant = between(action, " for \"", "\"");
        const std::string kelvin = between(action, "Write ", " for ");
        const std::string difference = between(action, "is meant, write ", " with the input");
        EXPECT_NEAR(value(replaced(one.equation, meant, kelvin)), one.with_kelvin, 1e-12 * std::fabs(one.with_kelvin));
        EXPECT_NEAR(value(replaced(one.equation, meant, difference)), one.with_difference,
                    1e-12 * std::fabs(one.with_difference));
        EXPECT_THAT(action, HasSubstr(R"("t_0": {"value": 0, "unit": "degC", "constant": true})"));
    }
}

}  // namespace
}  // namespace gumcert::gum
