#include "gum/expression/conversion_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "equations.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

using testing::HasSubstr;

std::vector<InputSymbol> stated() {
    return {input("a", "V"),         input("b", "V"),    input("c", "mV"),    input("x", "mm"),
            input("l", "mm"),        input("m", "kg"),   input("V", "L"),     input("t", "s"),
            input("phi", "rad"),     input("T", "degC"), input("T2", "degC"), input("n", "1"),
            input("one", "dB", 1.0), input("F", "N"),    input("d", "mm"),    input("p", "percent")};
}

/// Codes of the warnings of the last equation's result, declared in a unit.
std::string warned(const std::vector<std::string>& equations, const std::string& name, const std::string& unit) {
    std::string list;
    const EquationSystem system = system_of(equations, stated(), {}, {output(name, unit)});
    for (const Diagnostic& warning : system.warnings()) {
        EXPECT_EQ(warning.severity, Severity::warning);
        list += (list.empty() ? "" : "; ") + warning.code;
    }
    return list;
}

/// People who come from a spreadsheet convert by hand what the program converts as well.
TEST(ConversionCheck, WarnsOfAFactorThatLeadsToTheDeclaredUnit) {
    for (const auto& [equation, unit] :
         std::vector<std::pair<std::string, std::string>>{{"y = (a - b)/b*100", "percent"},
                                                          {"y = 100*(a - b)/b", "percent"},
                                                          {"y = (100*a - 100*b)/b", "percent"},
                                                          {"y = (a - b)/b*1e6", "ppm"},
                                                          {"y = (a/b - 1)*10^6", "ppm"},
                                                          {"y = (a - b)/(1e-6*b)", "ppm"},
                                                          {"y = -1000*(x - l)", "um"},
                                                          {"y = abs(x - l)*1000", "um"},
                                                          {"y = (x - l)/1000", "m"},
                                                          {"y = c/a*0.1", "percent"},
                                                          {"y = phi*180/pi", "deg"},
                                                          {"y = 57.3*phi", "deg"},
                                                          {"y = asin(x/l)*180/pi", "deg"},
                                                          {"y = x/l*3600*180/pi", "1"},
                                                          {"y = V/t*3600", "L/h"},
                                                          {"y = 1000*(T - T2)", "mK"},
                                                          {"y = sqrt(a^2 + b^2)*1000", "mV"},
                                                          {"y = 100*a/b - 100", "percent"},
                                                          {"y = 100 - 100*a/b", "percent"},
                                                          {"y = -100 + a/b*100", "percent"},
                                                          {"y = p^(-1/2)*10", "1"},
                                                          {"y = p^-0.5*10", "1"},
                                                          {"y = p^((-1)^3)*100", "1"},
                                                          {"y = x^(2*-1)*1e6", "1/m2"},
                                                          {"y = x^(-2)*1e6", "1/m2"},
                                                          {"y = (x + l + d)/3/10", "cm"},
                                                          {"y = (x + l + d)*2/10/2", "cm"},
                                                          {"y = (10*x - (-10)*l)/100", "cm"}}) {
        EXPECT_EQ(warned({equation}, "y", unit), equation == "y = x/l*3600*180/pi" ? "" : "GC-MODEL-0046")
            << equation << " in " << unit;
    }
    EXPECT_EQ(warned({"y = -r", "r = (a - b)/b*100"}, "y", "percent"), "GC-MODEL-0046") << "by way of another equation";
    const Diagnostic warning = system_of({"y = (a - b)/b*1e6"}, stated(), {}, {output("y", "ppm")}).warnings().front();
    EXPECT_THAT(warning.what, HasSubstr("y is declared in ppm, and its equation multiplies by 1000000, which"));
    EXPECT_THAT(warning.action, HasSubstr("Leave the factor out"));
}

TEST(ConversionCheck, IsSilentOfAllOtherFactors) {
    for (const auto& [equation, unit] :
         std::vector<std::pair<std::string, std::string>>{{"y = (a - b)/b", "percent"},
                                                          {"y = (a - b)/b", "ppm"},
                                                          {"y = 2*(a - b)/b", "percent"},
                                                          {"y = 1000*(x - l)", "mm"},
                                                          {"y = 1000*x", "m"},
                                                          {"y = 4/3*pi*x^3", "mL"},
                                                          {"y = pi*d^2/4", "mm2"},
                                                          {"y = 4*F/(pi*d^2)", "MPa"},
                                                          {"y = 4*F/(pi*d^2)", "Pa"},
                                                          {"y = 20*log10(a/b)*one", "dB"},
                                                          {"y = 10*log10(10^(n/10) + 10^(n/10))*one", "dB"},
                                                          {"y = x + 100*(a - b)/b*x", "um"},
                                                          {"y = (a - b)/b + 100*n", "percent"},
                                                          {"y = V/t", "L/h"},
                                                          {"y = n*(a - b)/b", "percent"},
                                                          {"y = x*exp(1000*n)", "um"},
                                                          {"y = phi/2", "deg"},
                                                          {"y = p^(-1/2)/10", "1"},
                                                          {"y = p^((-1)^3)/100", "1"},
                                                          {"y = x^(2*-1)*1e-6", "1/m2"},
                                                          {"y = x^(-2)*1e-6", "1/m2"},
                                                          {"y = 100*a/b - 10", "percent"},
                                                          {"y = a/b*(100 + 100)", "percent"}}) {
        EXPECT_EQ(warned({equation}, "y", unit), "") << equation << " in " << unit;
    }
    // A factor that is an input was meant.
    const std::vector<InputSymbol> with_factor{input("f", "1", 100.0), input("a", "V"), input("b", "V")};
    EXPECT_TRUE(system_of({"y = f*(a - b)/b"}, with_factor, {}, {output("y", "percent")}).warnings().empty());
    // Without a declared unit a number stays a number.
    EXPECT_TRUE(system_of({"y = (a - b)/b*1e6"}, with_factor).warnings().empty());
}

/// The number of readings is no conversion, however the mean of them is written.
TEST(ConversionCheck, IsSilentOfMeans) {
    for (const int n : {10, 100}) {
        std::string sum = "x";
        std::string of_differences = "x - l";
        for (int i = 1; i < n; ++i) {
            sum += i % 2 == 0 ? " + x" : " + l";
            of_differences += " + x - d";
        }
        const std::string count = std::to_string(n), share = n == 10 ? "0.1" : "0.01";
        const std::string unit = n == 10 ? "cm" : "dm";
        for (const std::string& equation : {"y = (" + sum + ")/" + count, "y = (" + of_differences + ")/" + count,
                                            "y = " + share + "*(" + sum + ")", "y = 1/" + count + "*(" + sum + ")",
                                            "y = n*(" + sum + ")/" + count, "y = (" + sum + ")/(" + count + "*n)"}) {
            EXPECT_EQ(warned({equation}, "y", unit), "") << equation;
        }
        EXPECT_EQ(warned({"y = r/" + count, "r = " + sum}, "y", unit), "") << "by way of another equation";
        EXPECT_EQ(warned({"y = (" + sum + ")/" + count + "/" + count}, "y", unit), "GC-MODEL-0046");
    }
}

/// A law: in front of any conversion, its own factor is told, and no factor that is a fifth off.
TEST(ConversionCheck, HoldsForEveryUnit) {
    const std::vector<std::string> lengths{"nm", "um", "mm", "cm", "m", "km", "in", "ft"};
    for (const std::string& from : lengths) {
        for (const std::string& to : lengths) {
            const double factor = Unit::parse(from).difference_to_si(1.0) / Unit::parse(to).difference_to_si(1.0);
            for (const double off : {1.0, 1.2, 0.8}) {
                const std::string equation = "y = (p - q)*" + text::shortest(factor * off);
                const auto found =
                    system_of({equation}, {input("p", from), input("q", from)}, {}, {output("y", to)}).warnings();
                EXPECT_EQ(found.size(), from != to && off == 1.0 ? 1U : 0U) << equation << " " << from << " " << to;
            }
        }
    }
}

/// The product of an equation by itself: what a spreadsheet multiplies by, and what 1 of its units is.
TEST(ConversionCheck, ReadsTheProductAsItIsWritten) {
    const ExpressionLimits limits;
    std::vector<Diagnostic> problems;
    const auto product = [&](const std::string& text) {
        const SyntaxTree tree = parse_equation({.text = text, .where = "m"}, limits, problems);
        return written_product(tree, [](std::uint32_t) { return std::optional(WrittenProduct{.size = 1e-3}); });
    };
    ASSERT_TRUE(product("y = 3*x*2/z"));
    EXPECT_NEAR(product("y = 3*x*2/z")->factor, 6.0, 1e-12);
    EXPECT_NEAR(product("y = 3*x*2/z")->size, 1.0, 1e-12);
    EXPECT_NEAR(product("y = x^2*10^-3")->factor, 1e-3, 1e-15);
    EXPECT_NEAR(product("y = x^2*10^-3")->size, 1e-6, 1e-18);
    EXPECT_NEAR(product("y = 5*cos(x)")->size, 1.0, 1e-15);
    EXPECT_FALSE(product("y = x^z")) << "a power of a unit that is not known";
    std::vector<Diagnostic> warnings;
    check_conversion("y", {.factor = 1000.0, .size = 1e-3}, Unit::parse("um"), "w", warnings);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].where, "w");
    EXPECT_TRUE(problems.empty());
}

}  // namespace
}  // namespace gumcert::gum
