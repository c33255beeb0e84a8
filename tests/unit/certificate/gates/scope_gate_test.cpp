#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

constexpr const char* k_p8 = "ILAC-P8";
constexpr const char* k_p14 = "ILAC-P14:09/2020";

TEST(ScopeGate, HasNothingToSayOfCompleteData) {
    EXPECT_THAT(ids(scope_findings(passed_certificate())), testing::IsEmpty());
    Certificate c = passed_certificate();
    c.data.accreditation.reset();
    EXPECT_THAT(ids(scope_findings(c)), testing::IsEmpty());
}

TEST(ScopeGate, WantsTheValidityOfTheScope) {
    Certificate c = passed_certificate();
    c.data.accreditation->valid_to.clear();
    expect_finding(only(scope_findings(c)), "X09", k_p8, k_major, "/accreditation/valid_to");
    c.data.accreditation->valid_from.clear();
    expect_finding(only(scope_findings(c)), "X09", k_p8, k_critical, "/accreditation/valid_to");
    c.data.accreditation->valid_from = "2026-01-01";
    c.data.accreditation->valid_to = "2025-01-01";
    expect_finding(only(scope_findings(c)), "X09", k_p8, k_critical, "/accreditation/valid_to");
    c.data.accreditation->valid_to = "2099-01-01";
    expect_finding(only(scope_findings(c)), "X09", k_p8, k_major, "/accreditation/valid_to");
}

TEST(ScopeGate, WantsSignatoriesSymbolAndMeasurand) {
    Certificate c = passed_certificate();
    c.data.accreditation->signatories.clear();
    expect_finding(only(scope_findings(c)), "X10", "ISO/IEC 17025:2017, 6.2.6", k_critical,
                   "/accreditation/signatories");
    c = passed_certificate();
    c.data.accreditation->symbol_file.reset();
    expect_finding(only(scope_findings(c)), "X15", k_p8, k_minor, "/accreditation/symbol_file");
    c = passed_certificate();
    c.data.accreditation->scope[0].measurand = "any";
    expect_finding(only(scope_findings(c)), "X13", k_p8, k_minor, "/accreditation/scope/0/measurand");
}

TEST(ScopeGate, WantsARangeOfWhatWasMeasured) {
    Certificate c = passed_certificate();
    ScopeEntry& entry = c.data.accreditation->scope[0];
    entry.ranges.clear();
    expect_finding(only(scope_findings(c)), "X11", k_p14, k_major, "/accreditation/scope/0/ranges");
    // The points of a table are a range.
    entry.capability = {.form = "table",
                        .unit = "nm",
                        .arguments = {{.name = "L", .unit = "mm"}},
                        .points = {{.at = 0.5, .U = 50.0}, {.at = 100.0, .U = 70.0}},
                        .lookup = "linear"};
    EXPECT_THAT(ids(scope_findings(c)), testing::IsEmpty());
    // Of a parameter of another kind it is none.
    c = passed_certificate();
    c.data.parameters = {{.name = "f", .unit = "Hz", .value = 50.0}};
    c.data.accreditation->scope[0].ranges = {
        {.argument = {.name = "f", .unit = "Hz", .of = "f"}, .low = 1.0, .high = 99.0}};
    expect_finding(only(scope_findings(c)), "X11", k_p14, k_major, "/accreditation/scope/0/ranges");
}

TEST(ScopeGate, HoldsAParameterAgainstTheResult) {
    const auto with_nominal = [](double nominal, double low, double high) {
        Certificate c = passed_certificate();
        c.data.parameters = {{.name = "nominal", .unit = "mm", .value = nominal}};
        c.data.accreditation->scope[0].ranges = {
            {.argument = {.name = "L", .unit = "mm", .of = "nominal"}, .low = low, .high = high}};
        return scope_findings(c);
    };
    EXPECT_THAT(ids(with_nominal(50.0, 0.5, 100.0)), testing::IsEmpty());  // the result is 50.0008 mm
    expect_finding(only(with_nominal(20.0, 0.5, 30.0)), "X12", k_p14, k_critical, "/accreditation/scope/0/ranges");
    expect_finding(only(with_nominal(80.0, 60.0, 100.0)), "X12", k_p14, k_minor, "/accreditation/scope/0/ranges");
}

// Pins: the small deviation of the first value of a table hid the grave one of another.
TEST(ScopeGate, TellsTheGravestOfManyValuesInAnyOrder) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> decades(-4.0, 0.0);
    std::uniform_real_distribution<double> factors(0.2, 1.6);
    std::map<std::string, std::set<FindingSeverity>> seen;
    for (int i = 0; i < 100; ++i) {
        Certificate c = passed_certificate();
        c.data.parameters = {{.name = "nominal", .unit = "mm", .value = 50.0}};
        ScopeEntry& entry = c.data.accreditation->scope[0];
        entry.ranges = {{.argument = {.name = "L", .unit = "mm", .of = "nominal"}, .low = 0.5, .high = 60.0}};
        for (CapabilityArgument& argument : entry.capability.arguments) {
            argument.of = "nominal";
        }
        std::vector<CertifiedValue>& values = c.tables[0].columns[0].values;
        const CertifiedValue first = values[0];
        values.clear();
        for (int n = 0; n < 4; ++n) {
            values.push_back(first);
            values.back().value *= factors(random);
            values.back().capability = *first.U * std::pow(10.0, decades(random));
        }
        const auto severities = [&] {
            std::map<std::string, FindingSeverity> all;
            for (const Finding& finding : scope_findings(c)) {
                all[finding.id + " " + finding.where] = finding.severity;
                seen[finding.id].insert(finding.severity);
            }
            return all;
        };
        const auto before = severities();
        for (int n = 0; n < 5; ++n) {
            std::shuffle(values.begin(), values.end(), random);
            EXPECT_EQ(severities(), before);
        }
    }
    EXPECT_THAT(seen["X12"], testing::UnorderedElementsAre(k_minor, k_critical));
    EXPECT_THAT(seen["X14"], testing::UnorderedElementsAre(k_minor, k_major));
}

TEST(ScopeGate, FindsCapabilitiesThatCannotBeTrue) {
    Certificate c = passed_certificate();
    c.data.accreditation->scope[0].capability.expression = "Q[50, 0.5*L] - 60";
    EXPECT_THAT(ids(scope_findings(c)), testing::ElementsAre("X05", "X14"));
    expect_finding(scope_findings(c)[0], "X05", k_p14, k_critical, "/accreditation/scope/0/capability/expression");
    expect_finding(scope_findings(c)[1], "X14", k_p14, k_minor, "/accreditation/scope/0/capability/expression");
    for (const char* fine : {"5E-2 + 0.5*L", "Q[-50, 0.5*L]", "50*(L/1)^-0.1"}) {
        c.data.accreditation->scope[0].capability.expression = fine;
        EXPECT_THAT(ids(scope_findings(c)), testing::IsEmpty()) << fine;
    }
    // The reference standard has U = 25 nm.
    c = passed_certificate();
    c.tables[0].columns[0].values[0].capability = 2.4;
    expect_finding(only(scope_findings(c)), "X14", k_p14, k_major, "/accreditation/scope/0/capability");
    c.tables[0].columns[0].values[0].U = 10.0;  // at the lower end of a wide range
    EXPECT_THAT(ids(scope_findings(c)), testing::IsEmpty());
}

}  // namespace
}  // namespace gumcert::certificate
