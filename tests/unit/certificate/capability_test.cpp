#include "certificate/capability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::certificate {
namespace {

using gum::test::agrees;
using gum::test::code_of;
using gum::test::message_of;
using gum::test::prints_as;

CapabilityArgument length() {
    return {.name = "L", .unit = "m", .of = "value"};
}
Capability value() {
    return {.form = "value", .unit = "um", .U = 0.6};
}
Capability range() {
    return {.form = "range", .unit = "um", .arguments = {length()}, .points = {{0.1, 0.8}, {0.5, 1.6}}};
}
Capability function(const std::string& expression) {
    return {.form = "function", .unit = "um", .arguments = {length()}, .expression = expression};
}
Capability table(const std::string& lookup) {
    return {.form = "table",
            .unit = "um",
            .arguments = {length()},
            .points = {{0.0, 0.3}, {0.1, 0.8}, {0.5, 0.6}},
            .lookup = lookup};
}
Capability matrix(const std::string& lookup) {
    return {.form = "matrix",
            .unit = "mV",
            .arguments = {{.name = "V", .unit = "V"}, {.name = "f", .unit = "kHz", .of = "frequency"}},
            .rows = {1.0, 10.0},
            .columns = {0.1, 1.0, 10.0},
            .matrix = {{0.1, 0.2, 0.4}, {0.5, 0.9, 0.7}},
            .lookup = lookup};
}

double at(const Capability& capability, double argument) {
    const CapabilityAt found = capability_at(capability, {{"other", 7.0}, {"L", argument}});
    EXPECT_TRUE(found.U) << found.reason;
    return found.U.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Keys of the problems that are found.
std::vector<std::string> keys(const Capability& capability) {
    std::vector<std::string> found;
    for (const CapabilityProblem& problem : check_capability(capability)) {
        found.push_back(problem.key);
        EXPECT_FALSE(problem.what.empty() || problem.rule.empty() || problem.action.empty()) << problem.key;
    }
    return found;
}

TEST(Capability, ValueHoldsEverywhere) {
    EXPECT_EQ(capability_at(value(), {}).U, 0.6);
}

TEST(Capability, ValueHasAShareOfItsArgument) {
    Capability share{
        .form = "value", .unit = "uV", .U = 2.0, .ppm_of_value = 10.0, .arguments = {{.name = "V", .unit = "V"}}};
    EXPECT_TRUE(agrees(*capability_at(share, {{"V", 10.0}}).U, 102.0, 1e-15));  // 10 V: 10 ppm are 100 µV
    EXPECT_TRUE(agrees(*capability_at(share, {{"V", -10.0}}).U, 102.0, 1e-15));
    EXPECT_EQ(capability_at(share, {{"V", 0.0}}).U, 2.0);
    share.ppm_of_value.reset();
    share.percent_of_value = 0.001;
    EXPECT_TRUE(agrees(*capability_at(share, {{"V", 10.0}}).U, 102.0, 1e-15));
    share.U = 0.0;
    EXPECT_TRUE(agrees(*capability_at(share, {{"V", 1.0}}).U, 10.0, 1e-15));
    EXPECT_EQ(capability_at(share, {{"V", 0.0}}).reason, "the capability is a share of V, which is 0 here");
}

TEST(CheckCapability, AsksForWhatAShareIsOf) {
    const Capability share{
        .form = "value", .unit = "uV", .ppm_of_value = 10.0, .arguments = {{.name = "V", .unit = "V"}}};
    const auto keys_with = [&](const auto& change) {
        Capability changed = share;
        change(changed);
        return keys(changed);
    };
    using Keys = std::vector<std::string>;
    EXPECT_EQ(keys(share), Keys{});
    EXPECT_EQ(keys_with([](Capability& c) { c.arguments.clear(); }), Keys{"/arguments"});
    EXPECT_EQ(keys_with([](Capability& c) { c.arguments[0].unit = "A"; }), Keys{"/arguments/0/unit"});
    EXPECT_EQ(keys_with([](Capability& c) { c.percent_of_value = 1.0; }), Keys{"/ppm_of_value"});
    EXPECT_EQ(keys_with([](Capability& c) { c.ppm_of_value = -1.0; }), Keys{"/ppm_of_value"});
    EXPECT_EQ(keys_with([](Capability& c) { c.U = -1.0; }), Keys{"/U"});
    EXPECT_EQ(keys_with([](Capability& c) {
                  c.form = "function";
                  c.expression = "2*V";
              }),
              Keys{"/ppm_of_value"});
    EXPECT_EQ(keys_with([](Capability& c) {
                  c.unit = "K";
                  c.arguments[0].unit = "degC";
              }),
              Keys{"/arguments/0/unit"});
}

TEST(Capability, RangeIsLinearBetweenItsEnds) {
    EXPECT_TRUE(prints_as(at(range(), 0.35), "1.30"));  // certificate notes, 2.1; golden vector 10
    EXPECT_TRUE(agrees(at(range(), 0.35), 1.3, 1e-15));
    EXPECT_EQ(at(range(), 0.1), 0.8);
    EXPECT_EQ(at(range(), 0.5), 1.6);
    Capability falling = range();
    falling.points = {{0.1, 1.6}, {0.5, 0.8}};
    EXPECT_TRUE(agrees(at(falling, 0.2), 1.4, 1e-15));
}

TEST(Capability, NeverExtrapolates) {
    for (const Capability& capability : {range(), table("linear"), table("next_worse")}) {
        const double last = capability.points.back().at;
        const CapabilityAt above = capability_at(capability, {{"L", last * 1.000001}});
        EXPECT_FALSE(above.U);
        const CapabilityAt below = capability_at(capability, {{"L", capability.points.front().at - 1e-9}});
        EXPECT_FALSE(below.U);
    }
    EXPECT_EQ(capability_at(range(), {{"L", 0.6}}).reason, "L = 0.6 m is outside of 0.1 m to 0.5 m");
    EXPECT_EQ(capability_at(matrix("linear"), {{"V", 0.5}, {"f", 1.0}}).reason, "V = 0.5 V is outside of 1 V to 10 V");
    EXPECT_EQ(capability_at(matrix("linear"), {{"V", 5.0}, {"f", 11.0}}).reason,
              "f = 11 kHz is outside of 0.1 kHz to 10 kHz");
}

TEST(Capability, RoundingOfAConversionIsNotOutside) {
    const double beyond = std::nextafter(std::nextafter(0.5, 1.0), 1.0);
    EXPECT_EQ(at(range(), beyond), 1.6);
    EXPECT_EQ(at(table("next_worse"), std::nextafter(0.1, 1.0)), 0.8);
    EXPECT_FALSE(capability_at(range(), {{"L", 0.5 + 1e-12}}).U);
}

TEST(Capability, FunctionOfPlainNumbers) {
    EXPECT_TRUE(prints_as(at(function("0.5 + 0.7*L"), 0.35), "0.745"));
    EXPECT_TRUE(prints_as(at(function("Q[0.5, 0.7*L]"), 0.35), "0.557"));  // not 0.745
    EXPECT_TRUE(agrees(at(function("Q[0.5, 0.7*L]"), 0.35), std::hypot(0.5, 0.245), 1e-15));
    EXPECT_TRUE(agrees(at(function("0.1 + 2*Q [ 0.3,0.4 , 1.2*L ]"), 1.0), 0.1 + 2.0 * 1.3, 1e-15));
    EXPECT_TRUE(agrees(at(function("Q[Q[0.3, 0.4*L], max(1.2*L, 0.1)]"), 1.0), 1.3, 1e-15));
    EXPECT_TRUE(agrees(at(function("Q[(0.1+0.2)*(1+L), -0.8*L]"), 1.0), 1.0, 1e-15));
    EXPECT_TRUE(agrees(at(function("sin(L*rad)"), 0.5), std::sin(0.5), 1e-15));
}

TEST(Capability, FunctionOfSeveralArguments) {
    Capability capability = function("Q[0.1, 0.2*I] + 0.01*Q");
    capability.arguments = {{.name = "I", .unit = "A"}, {.name = "Q", .unit = "C"}};  // a charge may be called Q
    EXPECT_TRUE(agrees(*capability_at(capability, {{"Q", 3.0}, {"I", 1.0}}).U, std::hypot(0.1, 0.2) + 0.03, 1e-15));
}

TEST(Capability, FunctionWithoutAValueHereSaysSo) {
    EXPECT_EQ(capability_at(function("0.5 - L"), {{"L", 0.5}}).reason,
              "the expression of the capability gives U = 0 um here, which is not greater than 0");
    const CapabilityAt root = capability_at(function("sqrt(L)"), {{"L", -1.0}});
    EXPECT_FALSE(root.U);
    EXPECT_NE(root.reason.find("has no value here"), std::string::npos) << root.reason;
    EXPECT_FALSE(capability_at(function("1/L"), {{"L", 0.0}}).U);
}

TEST(Capability, TableByItsRule) {
    EXPECT_TRUE(agrees(at(table("linear"), 0.05), 0.55, 1e-15));
    EXPECT_TRUE(agrees(at(table("linear"), 0.3), 0.7, 1e-15));
    EXPECT_EQ(at(table("next_worse"), 0.05), 0.8);
    EXPECT_EQ(at(table("next_worse"), 0.3), 0.8);
    for (const char* lookup : {"linear", "next_worse"}) {
        EXPECT_EQ(at(table(lookup), 0.0), 0.3) << lookup;
        EXPECT_EQ(at(table(lookup), 0.1), 0.8) << lookup;
        EXPECT_EQ(at(table(lookup), 0.5), 0.6) << lookup;
    }
}

TEST(Capability, MatrixByItsRule) {
    const auto look = [](const char* lookup, double v, double f) {
        return capability_at(matrix(lookup), {{"f", f}, {"V", v}}).U.value();
    };
    EXPECT_EQ(look("linear", 1.0, 10.0), 0.4);
    EXPECT_EQ(look("next_worse", 10.0, 1.0), 0.9);
    EXPECT_EQ(look("next_worse", 1.0, 0.5), 0.2);  // on a row: the other row is no neighbour
    EXPECT_EQ(look("next_worse", 2.0, 5.0), 0.9);
    // Bilinear by hand: V = 5.5 is half way, f = 5.5 as well.
    EXPECT_TRUE(agrees(look("linear", 5.5, 5.5), 0.25 * (0.2 + 0.4 + 0.9 + 0.7), 1e-15));
    EXPECT_TRUE(agrees(look("linear", 3.25, 1.0), 0.2 + 0.25 * 0.7, 1e-15));
}

TEST(Capability, NextWorseIsNeverBelowLinear) {
    for (int i = 0; i <= 50; ++i) {
        const double l = 0.01 * i;
        EXPECT_GE(at(table("next_worse"), l) * (1.0 + 1e-15), at(table("linear"), l)) << l;
        const std::vector<ArgumentValue> where{{"V", 1.0 + 0.18 * i}, {"f", 0.1 + 0.198 * i}};
        EXPECT_GE(capability_at(matrix("next_worse"), where).U.value() * (1.0 + 1e-15),
                  capability_at(matrix("linear"), where).U.value());
    }
}

TEST(Capability, NeedsAValueForEachArgument) {
    EXPECT_EQ(code_of<gum::InputError>([] { (void)capability_at(range(), {{"l", 0.2}}); }), "GC-CERT-0202");
    EXPECT_EQ(message_of<gum::InputError>([] {
                  (void)capability_at(range(), {{"L", std::numeric_limits<double>::quiet_NaN()}});
              }),
              "capability, argument L — the value NaN — each argument of a capability has a finite value — State where "
              "the value comes from.");
}

TEST(CapabilityEvaluator, IsCompiledOnceAndShared) {
    const CapabilityEvaluator first(function("Q[0.5, 0.7*L]"));
    const CapabilityEvaluator copy = first;
    EXPECT_EQ(copy.at({{"L", 0.35}}).U, first.at({{"L", 0.35}}).U);
    EXPECT_EQ(first.at({{"L", 0.35}}).U, capability_at(function("Q[0.5, 0.7*L]"), {{"L", 0.35}}).U);
}

TEST(CheckCapability, AcceptsEveryForm) {
    for (const Capability& capability :
         {value(), range(), function("0.5 + 0.7*L"), table("linear"), table("next_worse"), matrix("linear")}) {
        EXPECT_TRUE(keys(capability).empty()) << capability.form;
    }
    Capability said = range();
    said.lookup = "linear";
    EXPECT_TRUE(keys(said).empty());
}

using Keys = std::vector<std::string>;

TEST(CheckCapability, RefusesOpenOnes) {
    Capability open = value();
    open.form = "< 0.5 um";
    EXPECT_EQ(keys(open), Keys{"/form"});
    EXPECT_EQ(keys(function("< 0.5")), Keys{"/expression"});
    EXPECT_EQ(keys(function("0.5 ≤ 0.7*L")), Keys{"/expression"});
    Capability endless = range();
    endless.points[1].at = std::numeric_limits<double>::infinity();
    EXPECT_EQ(keys(endless), Keys{"/points/1/at"});
    EXPECT_EQ(code_of<gum::InputError>([&] { (void)capability_at(endless, {{"L", 0.2}}); }), "GC-CERT-0201");
}

TEST(CheckCapability, RefusesAmbiguousOnes) {
    EXPECT_EQ(keys(table("")), Keys{"/lookup"});
    EXPECT_EQ(keys(table("nearest")), Keys{"/lookup"});
    EXPECT_EQ(keys(matrix("")), Keys{"/lookup"});
    Capability stepped = range();
    stepped.lookup = "next_worse";
    EXPECT_EQ(keys(stepped), Keys{"/lookup"});
    Capability both = value();
    both.expression = "0.5 + L";
    both.points = {{0.0, 1.0}};
    EXPECT_EQ(keys(both), (Keys{"/expression", "/points"}));
    Capability two = range();
    two.U = 0.5;
    EXPECT_EQ(keys(two), Keys{"/U"});
    Capability dependent = value();
    dependent.arguments = {length()};
    EXPECT_EQ(keys(dependent), Keys{"/arguments"});
    Capability unused = function("0.5");
    EXPECT_EQ(keys(unused), Keys{"/expression"});
}

TEST(CheckCapability, RefusesNumbersOutOfRange) {
    for (const double U :
         {0.0, -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Capability single = value();
        single.U = U;
        EXPECT_EQ(keys(single), Keys{"/U"}) << U;
        Capability points = table("linear");
        points.points[1].U = U;
        EXPECT_EQ(keys(points), Keys{"/points/1/U"}) << U;
        Capability cells = matrix("linear");
        cells.matrix[1][2] = U;
        EXPECT_EQ(keys(cells), Keys{"/matrix/1/2"}) << U;
    }
    Capability twice = table("linear");
    twice.points[2].at = 0.1;
    EXPECT_EQ(keys(twice), Keys{"/points/2/at"});
    Capability backwards = matrix("linear");
    backwards.columns = {0.1, 10.0, 1.0};
    EXPECT_EQ(keys(backwards), Keys{"/columns/2"});
    Capability certain = value();
    certain.coverage_probability = 1.0;
    EXPECT_EQ(keys(certain), Keys{"/coverage_probability"});
}

TEST(CheckCapability, RefusesWrongShapes) {
    Capability three = range();
    three.points.push_back({0.9, 2.0});
    EXPECT_EQ(keys(three), Keys{"/points"});
    Capability one = table("linear");
    one.points.resize(1);
    EXPECT_EQ(keys(one), Keys{"/points"});
    Capability ragged = matrix("linear");
    ragged.matrix[0].pop_back();
    EXPECT_EQ(keys(ragged), Keys{"/matrix"});
    Capability missing = matrix("linear");
    missing.arguments.pop_back();
    EXPECT_EQ(keys(missing), Keys{"/arguments"});
    Capability lonely = range();
    lonely.arguments.clear();
    EXPECT_EQ(keys(lonely), Keys{"/arguments"});
    Capability unknown = value();
    unknown.form = "graph";
    EXPECT_EQ(keys(unknown), Keys{"/form"});
    EXPECT_EQ(keys(Capability{}), Keys{"/form"});
}

TEST(CheckCapability, RefusesUnitsAndNamesThatAreNone) {
    Capability unit = value();
    unit.unit = "no unit";
    EXPECT_EQ(keys(unit), Keys{"/unit"});
    Capability argument = range();
    argument.arguments[0].unit = "Q[1, 2]";
    EXPECT_EQ(keys(argument), Keys{"/arguments/0/unit"});
    Capability name = function("0.5 + 0.7*L");
    name.arguments[0].name = "L 1";
    EXPECT_EQ(keys(name), Keys{"/arguments/0/name"});
    Capability twice = matrix("linear");
    twice.arguments[1].name = "V";
    EXPECT_EQ(keys(twice), Keys{"/arguments/1/name"});
    Capability taken = function("0.5 + U_of_capability");
    taken.arguments[0].name = "U_of_capability";
    EXPECT_TRUE(keys(taken).empty());
}

TEST(CheckCapability, RefusesExpressionsThatDoNotCompile) {
    for (const char* text :
         {"", "  ", "0.5 +", "0.5 + 0.7 L", "0.5 + 0.7*l", "0.5 = L", "0.5; 0.7*L", "0.5 + 0.7*L\n+ = 3", "Q", "Q*L",
          "0,5 + 0,7*L", "exec(L)", "L = L", "sin(L)", "0.5 + {L}", "\"0.5\" + L", "1e999*L", "0x10*L"}) {
        const Keys found = keys(function(text));
        EXPECT_FALSE(found.empty()) << text;
        for (const std::string& key : found) {
            EXPECT_EQ(key, "/expression") << text;
        }
    }
}

std::string expanded(const std::string& text) {
    std::string problem;
    const std::string out = expanded_capability_expression(text, problem);
    return problem.empty() ? out : "! " + problem;
}

TEST(CapabilityExpression, ExpandsRootsOfSquares) {
    EXPECT_EQ(expanded("Q[0.5, 0.7*L]"), "sqrt((0.5)^2+( 0.7*L)^2)");
    EXPECT_EQ(expanded("Q[a]"), "sqrt((a)^2)");
    EXPECT_EQ(expanded("Q[a,b,c,d]"), "sqrt((a)^2+(b)^2+(c)^2+(d)^2)");
    EXPECT_EQ(expanded("2*Q \t[a,Q[b,c]]/3"), "2*sqrt((a)^2+(sqrt((b)^2+(c)^2))^2)/3");
    EXPECT_EQ(expanded("Q[max(a,b),(c+(d))]"), "sqrt((max(a,b))^2+((c+(d)))^2)");
    EXPECT_EQ(expanded("max(Q[a,b],Q[c,d])"), "max(sqrt((a)^2+(b)^2),sqrt((c)^2+(d)^2))");
    EXPECT_EQ(expanded("Q + Qa + aQ*Q(1)"), "Q + Qa + aQ*Q(1)");
    EXPECT_EQ(expanded(""), "");
}

TEST(CapabilityExpression, RefusesHostileText) {
    EXPECT_EQ(expanded("Q[a, b"), "! a Q[ that is not closed");
    EXPECT_EQ(expanded("Q["), "! an empty term in Q[…]");
    EXPECT_EQ(expanded("Q[]"), "! an empty term in Q[…]");
    EXPECT_EQ(expanded("Q[a,,b]"), "! an empty term in Q[…]");
    EXPECT_EQ(expanded("Q[a, b]]"), "! a ] that closes nothing");
    EXPECT_EQ(expanded("Q[a) + (b]"), "! a Q[ that is not closed");
    EXPECT_EQ(expanded("Q[(a]"), "! a ( that is not closed");
    EXPECT_EQ(expanded("(a"), "! a ( that is not closed");
    EXPECT_EQ(expanded("a) + (b"), "! a ) that closes nothing");
    EXPECT_EQ(expanded("aQ[1]"), "! a [ without Q before it");
    EXPECT_EQ(expanded("µQ[1]"), "! a [ without Q before it");
    EXPECT_EQ(expanded("q[1]"), "! a [ without Q before it");
    EXPECT_EQ(expanded("[1]"), "! a [ without Q before it");
    EXPECT_EQ(expanded(std::string(5000, '1')), "! an expression of more than 4096 bytes");
    EXPECT_EQ(expanded(std::string(4000, '(')), "! brackets deeper than 20");
    std::string deep;
    for (int i = 0; i < 1000; ++i) {
        deep += "Q[";
    }
    EXPECT_EQ(expanded(deep), "! brackets deeper than 20");
}

TEST(CapabilityExpression, SurvivesEveryCutOfAnExpression) {
    const std::string text = "0.1 + Q[0.5, 0.7*max(L, 2), Q[(L + 1)*3, 2]] - sqrt(Q[L])";
    const Capability whole = function(text);
    EXPECT_TRUE(keys(whole).empty());
    for (std::size_t i = 0; i < text.size(); ++i) {
        (void)check_capability(function(text.substr(0, i)));
        (void)check_capability(function(text.substr(i)));
        for (const char c : {'[', ']', '(', ')', ',', 'Q', '\0', '\xC3', '"'}) {
            std::string changed = text;
            changed[i] = c;
            (void)check_capability(function(changed));
            (void)expanded(changed);
        }
    }
}

}  // namespace
}  // namespace gumcert::certificate
