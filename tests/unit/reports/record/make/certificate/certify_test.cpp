#include "reports/record/make/certificate/certify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "certificate/statement_of_uncertainty.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "reports/record/reported_result.h"
#include "reports/record/stated_values.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_certificate.h"

namespace gumcert::reports {
namespace {

using certificate::Capability;
using certificate::CertificateData;
using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::Finding;
using certificate::Profile;
using certificate::Verdict;
using reports::EvaluationRecord;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A budget with one result "l", normal, k = 2.
EvaluationRecord one_result(double value, double U, const std::string& unit) {
    EvaluationRecord record;
    record.kind = "budget";
    record.options_json = "{}";
    reports::Result r;
    r.name = r.quantity = "l";
    r.value = value;
    r.unit = unit;
    r.u = 0.5 * U;
    r.k = 2.0;
    r.U = U;
    r.coverage = "normal";
    r.distribution = "normal";
    r.printed = {.value = "not certified", .U = "not certified", .unit = unit};
    record.results = {r};
    return record;
}

EvaluationRecord at_two_points(EvaluationRecord record) {
    record.results.push_back(record.results.front());
    certificate::PointTable& points = record.points.emplace();
    points.points = {"a", "b"};
    for (std::size_t p = 0; p < points.points.size(); ++p) {
        record.results[p].point = points.points[p];
        record.results[p].name = "l[" + points.points[p] + "]";
    }
    return record;
}

/// The sample data with one entry in the scope, for "l", and no specification.
CertificateData data_with(const Capability& capability) {
    CertificateData data = test::sample_certificate_data();
    certificate::ScopeEntry entry;
    entry.id = "S";
    entry.results = {"l"};
    entry.capability = capability;
    data.accreditation->scope = {entry};
    data.specifications.clear();
    return data;
}

CertifiedValue certified(EvaluationRecord record, const CertificateData& data, const Profile& profile = {},
                         const certificate::CapabilityInputs& inputs = {}) {
    certify(record, data, profile, inputs);
    return record.certificate->tables.at(0).columns.at(0).values.at(0);
}

std::vector<std::string> ids(const EvaluationRecord& record) {
    std::vector<std::string> all;
    for (const Finding& f : record.certificate->findings) {
        all.push_back(f.id);
    }
    return all;
}

const CertifiedColumn& column(const EvaluationRecord& record, const std::string& table, const std::string& result) {
    for (const CertifiedTable& t : record.certificate->tables) {
        for (const CertifiedColumn& c : t.columns) {
            if (t.id == table && c.result == result) {
                return c;
            }
        }
    }
    throw std::out_of_range(table + "/" + result);
}

// --- the capability as the floor, in each of its forms (golden vector 10: 1.30 at 0.35; 0.557 and not 0.745) ---

TEST(Certify, PutsTheFloorOfOneValueUnderU) {
    const CertifiedValue v =
        certified(one_result(299792.458, 1450.0, "m"), data_with(test::capability_of_one_value(1450.0, "m")));
    EXPECT_EQ(v.printed_value, "2.998E+5");
    EXPECT_EQ(v.printed_U, "1.5E+3");
    EXPECT_EQ(v.scope_entry, "S");
    EXPECT_EQ(v.capability, 1450.0);
    EXPECT_EQ(v.printed_capability, "1450");
    EXPECT_FALSE(v.raised);  // U is not below, only its rounding was
}

TEST(Certify, PutsTheFloorOfARangeUnderU) {
    Capability c = test::capability_of_one_value(0.0, "um");
    c.form = "range";
    c.arguments = {{.name = "L", .unit = "m", .of = "value"}};
    c.points = {{.at = 0.1, .U = 0.8}, {.at = 0.5, .U = 1.6}};
    const CertifiedValue v = certified(one_result(0.35, 1.0e-6, "m"), data_with(c));
    EXPECT_NEAR(*v.capability, 1.30e-6, 1e-18);
    EXPECT_EQ(v.printed_U, "0.0000013");
    EXPECT_EQ(v.printed_value, "0.3500000");
    EXPECT_TRUE(v.raised);
    const CertifiedValue outside = certified(one_result(0.6, 1.0e-6, "m"), data_with(c));
    EXPECT_EQ(outside.scope_entry, "");
    EXPECT_EQ(outside.printed_U, "0.0000010");
    EXPECT_FALSE(outside.outside_because.empty());
}

TEST(Certify, PutsTheFloorOfAFunctionUnderU) {
    Capability c = test::capability_of_one_value(0.0, "um");
    c.form = "function";
    c.arguments = {{.name = "L", .unit = "m", .of = "value"}};
    c.expression = "Q[0.5, 0.7*L]";
    const CertifiedValue v = certified(one_result(350000.0, 0.2, "um"), data_with(c));  // 0.35 m
    EXPECT_NEAR(*v.capability, 0.5567989, 1e-7);  // √(0.5² + 0.245²); a sum would give 0.745
    EXPECT_EQ(v.printed_U, "0.56");
    EXPECT_EQ(v.printed_value, "350000.00");
    EXPECT_TRUE(v.raised);
}

TEST(Certify, PutsTheFloorOfATableUnderU) {
    Capability c = test::capability_of_one_value(0.0, "um");
    c.form = "table";
    c.lookup = "next_worse";
    c.arguments = {{.name = "L", .unit = "mm", .of = "value"}};
    c.points = {{.at = 10.0, .U = 0.10}, {.at = 50.0, .U = 0.12}, {.at = 100.0, .U = 0.15}};
    EXPECT_EQ(certified(one_result(60.0, 1e-5, "mm"), data_with(c)).printed_U, "0.00015");
    c.lookup = "linear";
    EXPECT_EQ(certified(one_result(75.0, 1e-5, "mm"), data_with(c)).printed_U, "0.00014");  // 0.135, never less
}

TEST(Certify, PutsTheFloorOfAMatrixUnderU) {
    Capability c = test::capability_of_one_value(0.0, "um");
    c.form = "matrix";
    c.lookup = "next_worse";
    c.arguments = {{.name = "L", .unit = "mm", .of = "value"}, {.name = "f", .unit = "Hz", .of = "f"}};
    c.rows = {10.0, 100.0};
    c.columns = {50.0, 1000.0};
    c.matrix = {{0.10, 0.20}, {0.30, 0.40}};
    certificate::CapabilityInputs inputs;
    inputs.values["f"] = {.unit = "kHz", .values = {0.5}};
    EXPECT_EQ(certified(one_result(10.0, 1e-5, "mm"), data_with(c), {}, inputs).printed_U, "0.00020");
    CertificateData data = data_with(c);
    data.parameters = {{.name = "f", .unit = "Hz", .value = 50.0}};
    EXPECT_EQ(certified(one_result(60.0, 1e-5, "mm"), data).printed_U, "0.00030");
    data.parameters.clear();
    EXPECT_THAT(certified(one_result(60.0, 1e-5, "mm"), data).outside_because, HasSubstr("\"f\""));
}

TEST(Certify, LeavesUThatIsNotBelowAlone) {
    const CertifiedValue v =
        certified(one_result(693.1, 11.8, "m"), data_with(test::capability_of_one_value(12.0, "m")));
    EXPECT_EQ(v.printed_U, "12");
    EXPECT_FALSE(v.raised);
}

TEST(Certify, ConvertsTheCapabilityToTheUnitOfTheResult) {
    const CertifiedValue v =
        certified(one_result(1234.5, 300.0, "nm"), data_with(test::capability_of_one_value(0.5, "um")));
    EXPECT_EQ(v.capability, 500.0);
    EXPECT_EQ(v.printed_U, "5.0E+2");
    EXPECT_TRUE(v.raised);
    const CertifiedValue other =
        certified(one_result(1234.5, 300.0, "nm"), data_with(test::capability_of_one_value(0.5, "arcsec")));
    EXPECT_EQ(other.scope_entry, "");
    EXPECT_THAT(other.outside_because, HasSubstr("arcsec"));
}

TEST(Certify, FollowsTheProfileBelowTheCapability) {
    const CertificateData data = data_with(test::capability_of_one_value(12.0, "m"));
    Profile profile;
    profile.below_capability = "outside";
    EvaluationRecord record = one_result(693.1, 11.4, "m");
    certify(record, data, profile);
    const CertifiedValue& outside = record.certificate->tables[0].columns[0].values[0];
    EXPECT_EQ(outside.printed_U, "11");
    EXPECT_EQ(outside.scope_entry, "");
    EXPECT_THAT(ids(record), Contains("X02"));  // nothing is left in scope

    profile.below_capability = "refuse";
    record = one_result(693.1, 11.4, "m");
    certify(record, data, profile);
    EXPECT_EQ(record.certificate->tables[0].columns[0].values[0].printed_U, "11");
    EXPECT_THAT(ids(record), Contains("X01"));
    EXPECT_TRUE(record.certificate->blocked);

    profile.below_capability = "raise";
    record = one_result(693.1, 11.4, "m");
    certify(record, data, profile);
    EXPECT_THAT(ids(record), Contains("X03"));
    EXPECT_FALSE(record.certificate->blocked);
    EXPECT_TRUE(record.certificate->symbol);
}

TEST(Certify, RoundsByTheProfileAndByTheJob) {
    const CertificateData data = data_with(test::capability_of_one_value(1.0, "m"));
    Profile profile;
    EXPECT_EQ(certified(one_result(299792.458, 1450.0, "m"), data, profile).printed_U, "1.4E+3");
    profile.rounding = "up";
    EXPECT_EQ(certified(one_result(299792.458, 1450.0, "m"), data, profile).printed_U, "1.5E+3");
    profile.rounding = "half_even";
    certificate::CapabilityInputs by_job;
    by_job.rounding = gum::RoundingMode::up;
    EXPECT_EQ(certified(one_result(299792.458, 1450.0, "m"), data, profile, by_job).printed_U, "1.5E+3");
    profile.digits = 1;
    EXPECT_EQ(certified(one_result(299792.458, 1450.0, "m"), data, profile).printed_U, "2E+3");  // 1E+3 is 31 % less
    EXPECT_EQ(certified(one_result(299792.458, 1030.0, "m"), data, profile).printed_U, "1E+3");
    EXPECT_EQ(certified(one_result(299792.458, 1450.0, "m"), data, profile).printed_value, "3.00E+5");
}

TEST(Certify, SuppressesANegativeZero) {
    const CertifiedValue v =
        certified(one_result(-0.0004, 0.0123, "m"), data_with(test::capability_of_one_value(0.001, "m")));
    EXPECT_EQ(v.printed_value, "0.000");
    EXPECT_EQ(v.printed_U, "0.012");
    EXPECT_EQ(v.printed_k, "2.00");
    EXPECT_EQ(v.printed_nu_eff, "∞");
}

TEST(Certify, CarriesTheCapabilityToTheProbabilityOfTheResult) {
    EvaluationRecord record = one_result(100.0, 2.3, "m");
    record.results[0].coverage_probability = 0.99;
    certify(record, data_with(test::capability_of_one_value(2.0, "m")), {});
    const CertifiedValue& v = record.certificate->tables[0].columns[0].values[0];
    EXPECT_NEAR(*v.capability, 2.0 * 2.5758293 / 1.9599640, 1e-6);
    EXPECT_EQ(v.printed_U, "2.7");
    EXPECT_THAT(ids(record), Contains("K03"));
}

TEST(Certify, BlocksAnUncertaintyOfLessThanAbout95Percent) {
    EvaluationRecord record = one_result(100.0, 2.3, "m");
    record.results[0].coverage_probability = 0.6827;
    certify(record, data_with(test::capability_of_one_value(0.1, "m")), {});
    EXPECT_THAT(ids(record), Contains("K03"));
    EXPECT_TRUE(record.certificate->blocked);
    EXPECT_FALSE(record.certificate->symbol);
}

TEST(Certify, HidesNoUncertaintyOfZeroUnderACapability) {
    EvaluationRecord record = one_result(100.0, 0.0, "m");
    certify(record, data_with(test::capability_of_one_value(0.1, "m")), {});
    EXPECT_THAT(ids(record), Contains("R07-4a"));
    EXPECT_FALSE(record.certificate->symbol);
    record = one_result(100.0, 0.0, "m");
    CertificateData data = data_with(test::capability_of_one_value(0.1, "m"));
    data.status = "not_accredited";
    certify(record, data, {});
    EXPECT_THAT(ids(record), Contains("R07-4a"));
    EXPECT_FALSE(record.certificate->blocked);
}

// --- scope ---

TEST(Certify, SaysWhyAResultIsOutsideOfTheScope) {
    CertificateData data = data_with(test::capability_of_one_value(1.0, "m"));
    const auto why = [&]() { return certified(one_result(100.0, 2.0, "m"), data).outside_because; };
    EXPECT_EQ(why(), "");
    data.place.kind = "customer_site";
    EXPECT_THAT(why(), HasSubstr("customer_site"));
    data.accreditation->scope[0].places = {"customer_site"};
    EXPECT_EQ(why(), "");
    data.accreditation->scope[0].methods = {"CP-02"};
    EXPECT_THAT(why(), HasSubstr("CP-01"));
    data.accreditation->scope[0].methods = {"CP-02", "CP-01"};
    EXPECT_EQ(why(), "");
    data.accreditation->scope[0].ranges = {
        {.argument = {.name = "L", .unit = "km", .of = "value"}, .low = 0.0, .high = 0.1}};
    EXPECT_EQ(why(), "");  // 100 m is the end of the range, whatever a conversion makes of it
    data.accreditation->scope[0].ranges[0].high = 0.099;
    EXPECT_THAT(why(), HasSubstr("0.1 km is not in 0 km to 0.099 km"));
    data.accreditation->scope[0].results = {"d"};
    EXPECT_THAT(why(), HasSubstr("names the result \"l\""));
}

TEST(Certify, TakesTheSignWhereTheScopeSpeaksOfNegativeValues) {
    CertificateData data = data_with(test::capability_of_one_value(0.1, "K"));
    data.accreditation->scope[0].ranges = {
        {.argument = {.name = "t", .unit = "degC", .of = "value"}, .low = -10.0, .high = 50.0}};
    EXPECT_EQ(certified(one_result(-5.0, 0.2, "degC"), data).scope_entry, "S");
    EXPECT_EQ(certified(one_result(-30.0, 0.2, "degC"), data).scope_entry, "");
    EXPECT_EQ(certified(one_result(30.0, 0.2, "degC"), data).scope_entry, "S");
}

TEST(Certify, TakesACelsiusTemperatureWithItsSign) {
    CertificateData data = data_with(test::capability_of_one_value(0.1, "K"));
    data.accreditation->scope[0].ranges = {
        {.argument = {.name = "t", .unit = "degC", .of = "value"}, .low = 0.0, .high = 50.0}};
    EXPECT_EQ(certified(one_result(30.0, 0.2, "degC"), data).scope_entry, "S");
    const CertifiedValue cold = certified(one_result(-30.0, 0.2, "degC"), data);
    EXPECT_EQ(cold.scope_entry, "");
    EXPECT_THAT(cold.outside_because, HasSubstr("-30"));
    // The magnitude of a deviation is meant where the scope speaks of no sign.
    data.accreditation->scope[0].capability = test::capability_of_one_value(0.01, "um");
    data.accreditation->scope[0].ranges[0].argument.unit = "um";
    EXPECT_EQ(certified(one_result(-30.0, 0.2, "um"), data).scope_entry, "S");
}

TEST(Certify, TakesTheLargestOfSeveralCapabilities) {
    CertificateData data = data_with(test::capability_of_one_value(1.0, "m"));
    data.accreditation->scope.push_back(data.accreditation->scope.front());
    data.accreditation->scope[1].id = "worse";
    data.accreditation->scope[1].capability.U = 3.0;
    const CertifiedValue v = certified(one_result(100.0, 2.0, "m"), data);
    EXPECT_EQ(v.scope_entry, "worse");
    EXPECT_EQ(v.printed_U, "3.0");
}

certificate::ScopeEntry entry_of(const std::string& id, double low, double high, double U) {
    certificate::ScopeEntry entry;
    entry.id = id;
    entry.results = {"l"};
    entry.ranges = {{.argument = {.name = "L", .unit = "m", .of = "value"}, .low = low, .high = high}};
    entry.capability = test::capability_of_one_value(U, "m");
    return entry;
}

/// Where one range of the scope ends and the next one begins, the value belongs to the lower one.
TEST(Certify, TakesTheRangeThatEndsAtTheValue) {
    CertificateData data = data_with(test::capability_of_one_value(1.0, "m"));
    const auto entry = [&](double value, std::vector<certificate::ScopeEntry> scope) {
        data.accreditation->scope = std::move(scope);
        return certified(one_result(value, 9.0, "m"), data).scope_entry;
    };
    const auto low = entry_of("low", 1.0, 100.0, 1.0);
    const auto high = entry_of("high", 100.0, 1000.0, 3.0);
    EXPECT_EQ(entry(100.0, {low, high}), "low");
    EXPECT_EQ(entry(100.0, {high, low}), "low");
    EXPECT_EQ(entry(-100.0, {high, low}), "low") << "of magnitudes";
    EXPECT_EQ(entry(100.0001, {low, high}), "high");
    EXPECT_EQ(entry(100.0, {low, entry_of("high", 99.0, 1000.0, 3.0)}), "high") << "both cover it: the larger one";
    EXPECT_EQ(entry(0.0, {entry_of("below", -10.0, 0.0, 1.0), entry_of("above", 0.0, 10.0, 3.0)}), "above")
        << "at 0 nobody knows which one is meant";
    for (const auto& scope : {std::vector{low, high}, std::vector{high, low}}) {
        data.accreditation->scope = scope;
        const auto why = [&](double value) { return certified(one_result(value, 9.0, "m"), data).outside_because; };
        EXPECT_THAT(why(1200.0), HasSubstr("\"high\"")) << "the range that is nearest is told";
        EXPECT_THAT(why(0.5), HasSubstr("\"low\""));
    }
    auto in_km = entry_of("high", 0.1, 1.0, 3.0);
    in_km.ranges[0].argument.unit = "km";
    EXPECT_EQ(entry(100.0, {low, in_km}), "low") << "in another unit";
    auto of_other = high;
    of_other.ranges[0].argument.of = "T";
    data.parameters = {{.name = "T", .unit = "m", .value = 100.0}};
    EXPECT_EQ(entry(100.0, {low, of_other}), "high") << "not of one quantity";
    // The corner of two quantities: the lower one of each.
    const auto cell = [&](const char* id, bool l, bool t, double U) {
        auto one = l ? entry_of(id, 100.0, 1000.0, U) : entry_of(id, 1.0, 100.0, U);
        one.ranges.push_back(
            {.argument = {.name = "T", .unit = "m", .of = "T"}, .low = t ? 100.0 : 1.0, .high = t ? 200.0 : 100.0});
        return one;
    };
    EXPECT_EQ(entry(100.0, {cell("hh", true, true, 4.0), cell("hl", true, false, 3.0), cell("lh", false, true, 2.0),
                            cell("ll", false, false, 1.0)}),
              "ll");
    EXPECT_EQ(entry(100.0, {cell("hl", true, false, 3.0), cell("lh", false, true, 2.0)}), "hl");
}

TEST(Certify, TakesTheRangeOfTheScopeThatThePointIsIn) {
    EvaluationRecord record = at_two_points(one_result(100.0, 9.0, "m"));
    record.points->columns = {{.name = "range",
                               .heading = {},
                               .role = "",
                               .stage = "",
                               .unit = "",
                               .printed_unit = "",
                               .values = {{}, {}},
                               .printed = {"100 m", "1 km"}}};
    CertificateData data = data_with(test::capability_of_one_value(1.0, "m"));
    data.accreditation->scope = {entry_of("low", 1.0, 100.0, 1.0), entry_of("high", 100.0, 1000.0, 3.0)};
    const auto entries = [&] {
        EvaluationRecord certified = record;
        certify(certified, data, {}, {});
        const auto& values = certified.certificate->tables.at(0).columns.at(0).values;
        return values.at(0).scope_entry + " " + values.at(1).scope_entry;
    };
    EXPECT_EQ(entries(), "low high");
    record.points->columns[0].printed = {"±1000 m", "long"};
    EXPECT_EQ(entries(), "high low") << "what is no size says nothing";
    record.points->columns[0].printed = {"10 V", "-1000 m"};
    EXPECT_EQ(entries(), "low low");
    // A result at some of the points only.
    record.points->columns[0].printed = {"1 km", "100 m"};
    EvaluationRecord at_b = record;
    at_b.results.erase(at_b.results.begin());
    certify(at_b, data, {}, {});
    EXPECT_EQ(at_b.certificate->tables.at(0).columns.at(0).values.at(0).scope_entry, "low");
    // A result that has no point has no range.
    record.points->columns[0].printed = {"1 km", "1 km"};
    EvaluationRecord beside = record;
    beside.results.push_back(one_result(100.0, 9.0, "m").results.front());
    beside.results.back().name = beside.results.back().quantity = "m";
    for (certificate::ScopeEntry& one : data.accreditation->scope) {
        one.results.emplace_back("m");
    }
    certify(beside, data, {}, {});
    std::string found;
    for (const certificate::CertifiedTable& table : beside.certificate->tables) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            found += " " + column.result + ":" + column.values.front().scope_entry;
        }
    }
    EXPECT_THAT(found, HasSubstr("l:high"));
    EXPECT_THAT(found, HasSubstr("m:low"));
}

/// The points of a capability end and begin as ranges do.
TEST(Certify, TakesThePointsThatEndAtTheValue) {
    CertificateData data = data_with(test::capability_of_one_value(1.0, "m"));
    const auto of = [](const std::string& id, const std::string& form, double low, double high, double U) {
        certificate::ScopeEntry entry;
        entry.id = id;
        entry.results = {"l"};
        const certificate::CapabilityArgument length{.name = "L", .unit = "m"};
        if (form == "matrix") {
            entry.capability = Capability{.form = form,
                                          .unit = "m",
                                          .arguments = {{.name = "T", .unit = "m", .of = "T"}, length},
                                          .rows = {0.0, 5.0},
                                          .columns = {low, high},
                                          .matrix = {{U, U}, {U, U}},
                                          .lookup = "linear"};
        } else {
            entry.capability = Capability{.form = form,
                                          .unit = "m",
                                          .arguments = {length},
                                          .points = {{.at = low, .U = U}, {.at = high, .U = U}},
                                          .lookup = "linear"};
        }
        return entry;
    };
    data.parameters = {{.name = "T", .unit = "m", .value = 2.0}};
    const auto entry = [&](double value, std::vector<certificate::ScopeEntry> scope) {
        data.accreditation->scope = std::move(scope);
        return certified(one_result(value, 9.0, "m"), data).scope_entry;
    };
    for (const char* form : {"range", "table", "matrix"}) {
        for (const char* other : {"range", "table", "matrix", "ranges"}) {
            SCOPED_TRACE(std::string(form) + " and " + other);
            const auto low = of("low", form, 1.0, 100.0, 1.0);
            const auto high = other == std::string("ranges") ? entry_of("high", 100.0, 1000.0, 3.0)
                                                             : of("high", other, 100.0, 1000.0, 3.0);
            EXPECT_EQ(entry(100.0, {low, high}), "low");
            EXPECT_EQ(entry(100.0, {high, low}), "low");
            EXPECT_EQ(entry(101.0, {low, high}), "high");
            EXPECT_EQ(entry(100.0, {of("low", form, 1.0, 101.0, 1.0), high}), "high") << "both cover it";
        }
    }
}

/// A result that is small beside an input of its kind may be an error of it, and its capability is that of the input then.
/// Whatever the scope is worded by, U is not stated below that in silence.
TEST(Certify, SaysThatACapabilityMayHaveToBeTakenElsewhere) {
    const certificate::CapabilityArgument length{.name = "L", .unit = "m"};
    // Each allows 1 mm at 1 cm, and 100 mm at 100 m, or a little more.
    const std::vector<Capability> forms{
        {.form = "function", .unit = "mm", .arguments = {length}, .expression = "1 + 0.99*L"},
        {.form = "value", .unit = "mm", .U = 1.0, .ppm_of_value = 990.0, .arguments = {length}},
        {.form = "range", .unit = "mm", .arguments = {length}, .points = {{.at = 0, .U = 1}, {.at = 100, .U = 100}}},
        {.form = "table",
         .unit = "mm",
         .arguments = {length},
         .points = {{.at = 0, .U = 1}, {.at = 1, .U = 1}, {.at = 100, .U = 100}},
         .lookup = "linear"}};
    std::vector<CertificateData> scopes;
    for (const Capability& form : forms) {
        scopes.push_back(data_with(form));
        scopes.back().accreditation->scope[0].ranges = {{.argument = length, .low = 0.0, .high = 200.0}};
    }
    scopes.push_back(data_with(forms[0]));
    scopes.back().accreditation->scope = {entry_of("short", 0.0, 1.0, 0.001), entry_of("long", 1.0, 200.0, 0.1)};
    for (CertificateData& data : scopes) {
        SCOPED_TRACE(data.accreditation->scope[0].capability.form);
        const auto found = [&](double y, double U, const certificate::CapabilityInputs& inputs) {
            EvaluationRecord record = one_result(y, U, "m");
            certify(record, data, {}, inputs);
            std::string told;
            for (const Finding& f : record.certificate->findings) {
                if (f.id == "X12") {
                    EXPECT_EQ(f.severity, certificate::FindingSeverity::major);
                    EXPECT_EQ(f.where, "l");
                    told += f.what;
                }
            }
            return told;
        };
        // Where lines of ranges state one value each, a tenth of the input would be in the right one.
        const double y = data.accreditation->scope.size() > 1 ? 0.5 : 15.0;
        certificate::CapabilityInputs inputs;
        inputs.values["l_0"] = {.unit = "cm", .values = {10000.0}};
        EXPECT_THAT(found(y, 0.05, inputs), HasSubstr("an error of \"l_0\" = 10000 cm"));
        inputs.sensitivities["l"] = {{"l_0", -1.0}};
        // A share of a small result is none by another rule: it is outside.
        if (!data.accreditation->scope[0].capability.ppm_of_value) {
            EXPECT_THAT(found(0.01, 0.05, inputs), HasSubstr("allows U from 0.1 m"));
        }
        EXPECT_EQ(found(y, 0.2, inputs), "") << "U is what the scope allows there";
        EXPECT_EQ(found(60.0, 0.05, inputs), "") << "no small part of it";
        inputs.sensitivities["l"] = {{"l_0", 0.01 * y}};
        EXPECT_EQ(found(y, 0.05, inputs), "") << "a ratio of it, and no difference";
        inputs.sensitivities["l"] = {};
        EXPECT_NE(found(y, 0.05, inputs), "") << "perhaps its nominal value";
        inputs.sensitivities["l"] = {{"l_0", -1.0}, {"l_x", 1.0}};
        inputs.values["l_x"] = {.unit = "m", .values = {101.0}};
        EXPECT_THAT(found(y, 0.05, inputs), HasSubstr("\"l_0\"")) << "of two that are equal but for an error";
        inputs.values["n"] = {.unit = "m", .values = {99.0}};
        EXPECT_THAT(found(y, 0.05, inputs), HasSubstr("\"n\" = 99 m")) << "the nominal value";
        inputs.values = {{"range", {.unit = "m", .values = {100.0}}}, {"t", {.unit = "s", .values = {1e6}}}};
        EXPECT_EQ(found(y, 0.05, inputs), "") << "a range of the item, and another kind";
        inputs.values = {{"l_0", {.unit = "m", .values = {300.0}}}};
        EXPECT_EQ(found(y, 0.05, inputs), "") << "not in the scope: it is one of small quantities";
    }
}

/// Who says what the result is, is not asked.
TEST(Certify, TakesACapabilityWhereTheRoleSays) {
    CertificateData data = data_with(
        {.form = "function", .unit = "mm", .arguments = {{.name = "L", .unit = "m"}}, .expression = "1 + 0.99*L"});
    data.accreditation->scope[0].ranges = {{.argument = {.name = "L", .unit = "m"}, .low = 0.0, .high = 200.0}};
    certificate::CapabilityInputs inputs;
    inputs.values["l_0"] = {.unit = "m", .values = {100.0, 100.0}};
    EvaluationRecord record = at_two_points(one_result(1.0, 0.05, "m"));
    record.points->columns = {{.name = "l_0",
                               .heading = {},
                               .role = "nominal",
                               .stage = "",
                               .unit = "m",
                               .printed_unit = "m",
                               .values = {100.0, 100.0},
                               .printed = {"100", "100"}}};
    const auto found = [&](const std::string& role, const std::string& of_column = "nominal") {
        EvaluationRecord one = record;
        certificate::TableRequest& table = one.points->tables.emplace_back();
        table.columns = {{.show = "column", .of = "l_0", .heading = {}, .role = of_column, .stage = ""},
                         {.show = "value", .of = "l", .heading = {}, .role = role, .stage = ""},
                         {.show = "U", .of = "l", .heading = {}, .role = "", .stage = ""}};
        one.points->columns[0].role = of_column;
        certify(one, data, {}, inputs);
        const auto& value = one.certificate->tables.at(0).columns.at(0).values.at(0);
        for (const Finding& f : one.certificate->findings) {
            if (f.id == "X12") {
                EXPECT_EQ(f.where, "l, points a, b");
                return value.printed_U + " X12";
            }
        }
        return value.printed_U;
    };
    EXPECT_EQ(found(""), "0.050 X12");
    EXPECT_EQ(found("measured_value"), "0.050");
    EXPECT_EQ(found("error"), "0.10") << "at its nominal value, as the scope has it there";
    EXPECT_EQ(found("error", ""), "0.050 X12") << "an error of nothing";
    // A scope that ends below what it may be an error of covers no error of it, however small; a small quantity it may.
    data.accreditation->scope[0].ranges[0].high = 10.0;
    data.accreditation->scope[0].capability = test::capability_of_one_value(1.0, "mm");
    EXPECT_EQ(found("error", ""), "0.050 X12");
    EXPECT_EQ(found("deviation", ""), "0.050 X12");
    EXPECT_EQ(found("", ""), "0.050");
    EXPECT_EQ(found("measured_value", ""), "0.050");
}

/// An error is far less than what it is an error of, and so would be its share.
TEST(Certify, TakesNoShareOfAnErrorOrOfAnotherNumber) {
    CertificateData data = data_with(test::capability_of_one_value(1.0, "percent"));
    data.accreditation->scope[0].ranges = {
        {.argument = {.name = "L", .unit = "mm", .of = "value"}, .low = 0.0, .high = 1e6}};
    certificate::CapabilityInputs inputs;
    const auto value = [&](double y) { return certified(one_result(y, 0.001, "m"), data, {}, inputs); };
    inputs.values["l_0"] = {.unit = "cm", .values = {9999.0}};
    EXPECT_EQ(value(100.0).capability, 1.0);
    EXPECT_THAT(value(1.0).outside_because, HasSubstr("small beside \"l_0\"")) << "100 m beside 1 m";
    inputs.sensitivities["l"] = {{"l_0", -1.0}};
    EXPECT_THAT(value(1.0).outside_because, HasSubstr("small beside"));
    inputs.sensitivities["l"] = {{"l_0", 0.01}};
    EXPECT_EQ(value(1.0).capability, 0.01) << "a hundredth of it by a ratio is no difference";
    inputs.sensitivities.clear();
    inputs.values = {{"range", {.unit = "km", .values = {1.0}}}, {"t", {.unit = "s", .values = {1e6}}}};
    EXPECT_EQ(value(1.0).capability, 0.01) << "a range of the item, and another kind";
    inputs.values = {{"l_0", {.unit = "m", .values = {100.0}}}};
    data.accreditation->scope[0].capability = Capability{
        .form = "value", .unit = "mm", .U = 1.0, .percent_of_value = 1.0, .arguments = {{.name = "L", .unit = "m"}}};
    EXPECT_NEAR(value(100.0).capability.value(), 1.001, 1e-12);
    EXPECT_THAT(value(1.0).outside_because, HasSubstr("small beside"));
    // A parameter that has nothing to do with what was measured, and one that is its nominal value.
    data.accreditation->scope[0].capability = test::capability_of_one_value(1.0, "percent");
    data.accreditation->scope[0].ranges[0].argument = {.name = "L", .unit = "m", .of = "L_0"};
    data.parameters = {{.name = "L_0", .unit = "m", .value = 1.0}};
    EXPECT_EQ(value(100.0).capability, 1.0) << "and not 1 % of 1 m";
    data.parameters[0].value = 99.0;
    EXPECT_EQ(value(100.0).capability, 0.99);
}

/// "10 ppm" of the scope is 10 ppm of what was measured.
TEST(Certify, TakesACapabilityThatIsAShare) {
    CertificateData data = data_with(test::capability_of_one_value(1.0, "percent"));
    const auto value = [&](double y, const std::string& unit) { return certified(one_result(y, 0.001, unit), data); };
    EXPECT_THAT(value(100.0, "m").outside_because, HasSubstr("a share (\"percent\")")) << "of what, nobody says";
    data.accreditation->scope[0].ranges = {
        {.argument = {.name = "L", .unit = "mm", .of = "value"}, .low = 0.0, .high = 1e6}};
    EXPECT_EQ(value(100.0, "m").capability, 1.0);
    EXPECT_EQ(value(100.0, "m").printed_U, "1.0");
    EXPECT_EQ(value(-100.0, "m").capability, 1.0);
    EXPECT_THAT(value(0.0, "m").outside_because, HasSubstr("here one of 0"));
    data.accreditation->scope[0].capability = Capability{
        .form = "function", .unit = "ppm", .arguments = {{.name = "L", .unit = "km"}}, .expression = "10 + 1/L"};
    EXPECT_NEAR(value(100.0, "m").capability.value(), 20e-6 * 100.0, 1e-12);
    data.accreditation->scope[0].capability = test::capability_of_one_value(1.0, "percent");
    data.accreditation->scope[0].ranges[0].argument.unit = "degC";
    data.accreditation->scope[0].ranges[0].low = -100.0;
    EXPECT_THAT(value(100.0, "degC").outside_because, HasSubstr("the capability has the unit")) << "of no origin";
    data.accreditation->scope[0].ranges[0].argument.unit = "dB";
    EXPECT_THAT(value(50.0, "dB").outside_because, HasSubstr("the capability has the unit"));
    data.accreditation->scope[0].ranges.clear();
    EXPECT_EQ(value(5.0, "percent").capability, 1.0) << "of a result that is a ratio it is a difference";
}

TEST(Certify, MarksResultsOfAnotherLaboratory) {
    CertificateData data = data_with(test::capability_of_one_value(1.0, "m"));
    data.external_results = {{.results = {"l"}, .provider = "Other laboratory"}};
    const CertifiedValue v = certified(one_result(100.0, 2.0, "m"), data);
    EXPECT_TRUE(v.external);
    EXPECT_EQ(v.scope_entry, "");
    EXPECT_FALSE(v.capability);
}

TEST(Certify, AsksNoScopeWithoutAccreditation) {
    CertificateData data = data_with(test::capability_of_one_value(12.0, "m"));
    data.status = "not_accredited";
    EvaluationRecord record = one_result(693.1, 11.4, "m");
    certify(record, data, {});
    EXPECT_EQ(record.certificate->tables[0].columns[0].values[0].printed_U, "11");
    EXPECT_FALSE(record.certificate->blocked);
    EXPECT_FALSE(record.certificate->symbol);
}

// --- Monte Carlo ---

EvaluationRecord with_trials(double value, double low, double high) {
    EvaluationRecord record = one_result(value, 0.5 * (high - low), "m");
    record.results[0].coverage = "monte_carlo";
    reports::MonteCarloSummary m = test::trials_of(value, 0.25 * (high - low));
    m.validation.reset();
    m.symmetric.number = {low, high};
    record.results[0].monte_carlo = m;
    record.results[0].printed = {.value = "12.35", .U = "0.25", .unit = "m"};
    return record;
}

TEST(Certify, PrintsPlusMinusUWhereTheMonteCarloIntervalIsSymmetric) {
    const CertifiedValue v =
        certified(with_trials(12.3456, 12.1001, 12.5911), data_with(test::capability_of_one_value(0.1, "m")));
    EXPECT_EQ(v.printed_value, "12.35");
    EXPECT_EQ(v.printed_U, "0.25");  // 0.2455
    EXPECT_FALSE(v.interval);
    EXPECT_EQ(v.printed_low, "");
    EXPECT_EQ(v.printed_nu_eff, "");
}

TEST(Certify, StatesTheCapabilityInPlaceOfAnIntervalThatIsTooNarrow) {
    const CertifiedValue v =
        certified(with_trials(12.3456, 12.1001, 12.5911), data_with(test::capability_of_one_value(0.3, "m")));
    EXPECT_EQ(v.printed_U, "0.30");
    EXPECT_TRUE(v.raised);
    EXPECT_FALSE(v.interval);
    EXPECT_EQ(v.printed_low, "");
}

TEST(Certify, StatesAnIntervalAloneWhereThereIsNoU) {
    EvaluationRecord record = with_trials(12.3456, 12.2, 12.7);
    record.results[0].coverage = "none";
    record.results[0].U.reset();
    record.results[0].k.reset();
    record.results[0].printed.U.clear();
    const CertifiedValue v = certified(record, data_with(test::capability_of_one_value(0.1, "m")));
    EXPECT_EQ(v.printed_U, "");
    EXPECT_EQ(v.printed_k, "");
    EXPECT_EQ(v.printed_value, "12.35");
    EXPECT_EQ(v.printed_low, "12.20");
    EXPECT_EQ(v.printed_high, "12.70");
    EXPECT_EQ(v.scope_entry, "S");
    const CertifiedValue narrow = certified(record, data_with(test::capability_of_one_value(0.3, "m")));
    EXPECT_EQ(narrow.scope_entry, "");
    EXPECT_THAT(narrow.outside_because, HasSubstr("narrower"));
}

// --- conformity ---

CertificateData data_with_rule(const std::string& rule, double lower, double upper, const std::string& unit) {
    CertificateData data = data_with(test::capability_of_one_value(1e-9, "m"));
    data.specifications = {test::sample_specification("spec", "l", lower, upper, unit)};
    data.specifications[0].rule.id = rule;
    return data;
}

TEST(Certify, DecidesOnConformityInTheUnitOfTheResult) {
    const Verdict v = *certified(one_result(9.7, 0.2, "m"), data_with_rule("DR-03", 9000.0, 10000.0, "mm")).verdict;
    EXPECT_EQ(v.specification, "spec");
    EXPECT_EQ(v.rule, "DR-03");
    EXPECT_EQ(v.verdict, "pass");
    EXPECT_EQ(v.verdict_from_printed, "pass");
    EXPECT_NEAR(*v.lower, 9.0, 1e-15);
    EXPECT_NEAR(*v.upper, 10.0, 1e-15);
    EXPECT_NEAR(*v.acceptance_upper, 9.8, 1e-12);
    EXPECT_EQ(v.printed.lower, "9.00");
    EXPECT_EQ(v.printed.upper, "10.00");
    EXPECT_EQ(v.printed.acceptance_lower, "9.20");
    EXPECT_EQ(v.printed.acceptance_upper, "9.80");
    EXPECT_EQ(v.printed.guard_band, "0.20");
    EXPECT_EQ(v.printed.test_uncertainty_ratio, "2.50");
}

// 9 m and 10 m have no end in feet: guard band and acceptance limits have the decimals of U, on the safe side.
TEST(Certify, PrintsNoDigitsOfAConvertedLimitInTheGuardBand) {
    const Verdict v = *certified(one_result(31.1, 0.66, "ft"), data_with_rule("DR-03", 9.0, 10.0, "m")).verdict;
    EXPECT_EQ(v.verdict, "pass");
    EXPECT_EQ(v.printed.guard_band, "0.66");
    EXPECT_EQ(v.printed.acceptance_lower, "30.19");
    EXPECT_EQ(v.printed.acceptance_upper, "32.14");
    for (const double y : {30.188, 30.19, 32.14, 32.148}) {
        const Verdict near = *certified(one_result(y, 0.66, "ft"), data_with_rule("DR-03", 9.0, 10.0, "m")).verdict;
        EXPECT_EQ(near.verdict, "pass") << y;
    }
}

/// The record of one result with that result at the points "a" and "b".

/// The result of another laboratory may be that of one point: what names mean is the same for specifications and for these.
TEST(Certify, MarksOnePointThatAnotherLaboratoryProvided) {
    const EvaluationRecord record = at_two_points(one_result(100.0, 2.0, "m"));
    CertificateData data = data_with(test::capability_of_one_value(1.0, "m"));
    data.specifications = {test::sample_specification("s", "l", 90.0, 110.0, "m")};
    struct Named {
        std::vector<std::string> names;
        bool first, second;
    };
    const std::vector<Named> all = {{{"l[b]"}, false, true},
                                    {{"l[a]", "l[b]"}, true, true},
                                    {{"l"}, true, true},
                                    {{"l*"}, true, true},
                                    {{"l[c]"}, false, false}};
    for (const Named& named : all) {
        SCOPED_TRACE(named.names.front());
        data.external_results = {{.results = named.names, .provider = "Other laboratory"}};
        EvaluationRecord marked = record;
        certify(marked, data, {}, {});
        const std::vector<CertifiedValue>& values = marked.certificate->tables.at(0).columns.at(0).values;
        ASSERT_EQ(values.size(), 2U);
        for (std::size_t p = 0; p < 2; ++p) {
            const bool external = p == 0 ? named.first : named.second;
            EXPECT_EQ(values[p].external, external);
            EXPECT_EQ(values[p].scope_entry.empty(), external);
            EXPECT_EQ(values[p].verdict->verdict == "not_applicable", external);
        }
    }
}

// Golden vector 4: y = 9.8, u = 0.1, limits 9 and 10: p_c = 0.977250.
TEST(Certify, DecidesByTheLimitsOfEachPoint) {
    EvaluationRecord record = at_two_points(one_result(0.3, 0.1, "mV"));
    certificate::PointTable& points = *record.points;
    points.columns = {{.name = "mpe",
                       .heading = {},
                       .role = "",
                       .stage = "",
                       .unit = "uV",
                       .printed_unit = "µV",
                       .values = {250.0, 350.0},
                       .printed = {"250", "350"}}};
    CertificateData data = data_with(test::capability_of_one_value(1e-3, "mV"));
    data.specifications = {test::sample_specification("mpe", "l", 0.0, 0.0, "mV")};
    data.specifications[0].lower.reset();
    data.specifications[0].upper.reset();
    data.specifications[0].limits.emplace();
    data.specifications[0].limits->by = "points";
    data.specifications[0].rule.id = "DR-01";
    EvaluationRecord with_limits = record;
    certify(with_limits, data, {}, {});
    const std::vector<CertifiedValue>& values = with_limits.certificate->tables.at(0).columns.at(0).values;
    ASSERT_EQ(values.size(), 2U);
    EXPECT_EQ(values[0].verdict->verdict, "fail");
    EXPECT_EQ(values[1].verdict->verdict, "pass");
    EXPECT_NEAR(*values[1].verdict->upper, 0.35, 1e-15);
    EXPECT_EQ(values[1].verdict->printed.upper, "0.35");
    // Of one point alone, by the name of its result.
    data.specifications[0].results = {"l[b]"};
    EvaluationRecord of_one = record;
    certify(of_one, data, {}, {});
    EXPECT_FALSE(of_one.certificate->tables.at(0).columns.at(0).values[0].verdict);
    EXPECT_TRUE(of_one.certificate->tables.at(0).columns.at(0).values[1].verdict);
    // Without points nothing is decided, and that is said.
    record.points.reset();
    data.specifications[0].results = {"l"};
    certify(record, data, {}, {});
    EXPECT_EQ(record.certificate->tables.at(0).columns.at(0).values[0].verdict->verdict, "not_applicable");
}

TEST(Certify, StatesTheSpecificRiskOfTheGoldenVector) {
    const Verdict v = *certified(one_result(9.8, 0.2, "m"), data_with_rule("DR-01", 9.0, 10.0, "m")).verdict;
    EXPECT_NEAR(v.conformance_probability, 0.977250, 1e-6);
    EXPECT_NEAR(v.specific_risk, 0.022750, 1e-6);
    EXPECT_EQ(v.printed.conformance_probability, "97.7");
    EXPECT_EQ(v.printed.specific_risk, "2.3");
}

TEST(Certify, FindsAVerdictThatRoundingChanges) {
    // AU = 10 − 0.204 = 9.796, printed 10 − 0.20 = 9.80: 9.7962 fails, printed as 9.80 it passes.
    EvaluationRecord record = one_result(9.7962, 0.204, "m");
    certify(record, data_with_rule("DR-03", 9.0, 10.0, "m"), {});
    const Verdict& v = *record.certificate->tables[0].columns[0].values[0].verdict;
    EXPECT_EQ(v.verdict, "fail");
    EXPECT_EQ(v.verdict_from_printed, "pass");
    EXPECT_THAT(ids(record), Contains("D04"));
    EXPECT_TRUE(record.certificate->blocked);
}

TEST(Certify, WhereThePrintedUIsTheToleranceNothingIsDecided) {
    for (int i = 490; i <= 510; ++i) {
        const double U = 0.001 * i + 0.0003;
        for (const double y : {-0.3, 0.0, 0.2}) {
            CertificateData data = data_with_rule("DR-03", -0.5, 0.5, "m");
            data.accreditation.reset();
            const CertifiedValue value = certified(one_result(y, U, "m"), data);
            const Verdict& v = *value.verdict;
            EXPECT_EQ(v.verdict, v.verdict_from_printed) << y << " ± " << U;
            if (certificate::number_of(value.printed_U).value_or(0.0) >= 0.5) {
                EXPECT_EQ(v.verdict, "not_applicable") << y << " ± " << U;
                EXPECT_THAT(v.note, HasSubstr("no value can pass")) << y << " ± " << U;
            }
        }
    }
}

TEST(Certify, DecidesWithTheCapabilityWhereItReplacesU) {
    CertificateData data = data_with_rule("DR-03", 9.0, 10.0, "m");
    EXPECT_EQ(certified(one_result(9.85, 0.1, "m"), data).verdict->verdict, "pass");
    data.accreditation->scope[0].capability.U = 0.2;
    const CertifiedValue v = certified(one_result(9.85, 0.1, "m"), data);
    EXPECT_TRUE(v.raised);
    EXPECT_EQ(v.verdict->verdict, "fail");
    EXPECT_NEAR(v.verdict->guard_band, 0.2, 1e-15);
}

// Seen on paper: rule w = U, U = 0.78 (a capability of 0.771), guard band "0.77", acceptance limits beside it from
// 0.771.
TEST(Certify, PrintsAGuardBandAndLimitsThatCanBeCheckedByHand) {
    CertificateData data = data_with_rule("DR-03", 1230.0, 1240.0, "m");
    data.accreditation->scope[0].capability.U = 0.771;
    const CertifiedValue v = certified(one_result(1234.56789, 0.1227, "m"), data);
    EXPECT_EQ(v.printed_U, "0.78");
    EXPECT_EQ(v.verdict->printed.guard_band, "0.78");
    EXPECT_EQ(v.verdict->printed.acceptance_lower, "1230.78");
    EXPECT_EQ(v.verdict->printed.acceptance_upper, "1239.22");
    EXPECT_EQ(v.verdict->printed.test_uncertainty_ratio, "6.41");  // 5/0.78
    EXPECT_NEAR(v.verdict->guard_band, 0.771, 1e-12);
}

/// w = 0.5·1.1 is 0.55: with the one decimal of the value it would be 0.6, and no reader could find r·U in it.
TEST(Certify, PrintsAGuardBandToTwoDigits) {
    CertificateData data = data_with_rule("DR-04", -3.0, 3.0, "m");
    data.specifications[0].rule.guard_factor = 0.5;
    data.accreditation.reset();
    const Verdict v = *certified(one_result(1.0, 1.1, "m"), data).verdict;
    EXPECT_EQ(v.printed.guard_band, "0.55");
    EXPECT_EQ(v.printed.acceptance_lower, "-2.45");
    EXPECT_EQ(v.printed.acceptance_upper, "2.45");
    data.specifications[0].rule.guard_factor = 1.0;
    EXPECT_EQ(certified(one_result(1.0, 1.1, "m"), data).verdict->printed.guard_band, "1.1");
    data = data_with_rule("DR-07", -3.0, 3.0, "m");
    data.specifications[0].rule.probability = 0.05;
    data.accreditation.reset();
    EXPECT_EQ(certified(one_result(1.0, 1.1, "m"), data).verdict->printed.guard_band, "0.91");  // 1.645·0.55 = 0.9047
}

TEST(Certify, SaysNothingOfProbabilitiesThatItDoesNotPrint) {
    EvaluationRecord record = one_result(0.1, 2.0, "m");
    record.results[0].coverage = "convolution";
    CertificateData data = data_with_rule("DR-03", -0.8, 0.8, "m");
    data.accreditation.reset();
    const Verdict open = *certified(record, data).verdict;
    EXPECT_EQ(open.verdict, "not_applicable");
    EXPECT_THAT(open.note, Not(HasSubstr("Probabilities")));
    EXPECT_EQ(open.printed.conformance_probability + open.printed.specific_risk, "");
    const Verdict decided = *certified(record, data_with_rule("DR-03", -8.0, 8.0, "m")).verdict;
    EXPECT_THAT(decided.note, HasSubstr("Probabilities"));
    EXPECT_NE(decided.printed.conformance_probability, "");
}

TEST(Certify, PrintsAValueOutsideOfTheLimitsWhereItFails) {
    // AU = 10 − 0.83 · 0.027 = 9.97759: rounded to the place of the value it would be 9.978, which the value is.
    CertificateData data = data_with_rule("DR-04", 9.0, 10.0, "m");
    data.specifications[0].rule.guard_factor = 0.83;
    const CertifiedValue v = certified(one_result(9.978, 0.027, "m"), data);
    EXPECT_EQ(v.printed_value, "9.978");
    EXPECT_EQ(v.verdict->verdict, "fail");
    EXPECT_EQ(v.verdict->verdict_from_printed, "fail");
    EXPECT_EQ(v.verdict->printed.acceptance_upper, "9.977");
    EXPECT_EQ(v.verdict->printed.acceptance_lower, "9.023");
    EXPECT_EQ(v.verdict->printed.guard_band, "0.023");
}

TEST(Certify, PrintsARatioThatIsNotReachedAsNotReached) {
    CertificateData data = data_with_rule("DR-02", 9.0, 10.0, "m");
    data.specifications[0].rule.test_uncertainty_ratio = 4.0;
    const Verdict v = *certified(one_result(9.5, 0.12505, "m"), data).verdict;  // 0.5/0.12505 = 3.9984, printed U 0.13
    EXPECT_EQ(v.verdict, "not_applicable");
    EXPECT_EQ(v.printed.test_uncertainty_ratio, "3.84");
}

TEST(Certify, PrintsTheRiskOfRejectingAGoodItem) {
    CertificateData data = data_with_rule("DR-04", 0.0, 10.0, "m");
    data.specifications[0].rule.guard_factor = 6.0;
    const Verdict v = *certified(one_result(9.1, 0.2, "m"), data).verdict;
    EXPECT_EQ(v.verdict, "fail");
    EXPECT_EQ(v.printed.specific_risk, ">99.99");
}

TEST(Certify, DecidesWithTheCapabilityWhereRoundingLiftsUToIt) {
    CertificateData data = data_with_rule("DR-03", 9.0, 10.0, "m");
    data.accreditation->scope[0].capability.U = 0.12;
    Profile profile;
    profile.rounding = "up";
    const CertifiedValue v = certified(one_result(9.5, 0.114, "m"), data, profile);
    EXPECT_EQ(v.printed_U, "0.12");
    EXPECT_FALSE(v.raised);
    EXPECT_NEAR(v.verdict->guard_band, 0.12, 1e-12);
}

TEST(Certify, TakesTheDistributionOfAConvolution) {
    EvaluationRecord record = one_result(9.97, 0.0954, "m");  // rectangular, half-width 0.1
    record.results[0].coverage = "convolution";
    record.results[0].u = 0.1 / std::sqrt(3.0);
    record.results[0].k = 0.0954 / record.results[0].u;
    certificate::CapabilityInputs inputs;
    inputs.distributions["l"] = [] {
        return certificate::ResultDistribution{
            .function = [](double x) { return std::clamp((x - 9.87) / 0.2, 0.0, 1.0); }, .below = {}};
    };
    const CertificateData data = data_with_rule("DR-01", 9.0, 10.0, "m");
    const Verdict exact = *certified(record, data, {}, inputs).verdict;
    EXPECT_NEAR(exact.conformance_probability, 0.65, 1e-12);
    EXPECT_THAT(exact.note, HasSubstr("convolution"));
    // Also where k is that of t_p(ν_eff): it agrees at 95 % and nowhere else.
    EvaluationRecord with_t = record;
    with_t.results[0].coverage = "student_t";
    const Verdict of_terms = *certified(with_t, data_with_rule("DR-01", 9.0, 10.0, "m"), {}, inputs).verdict;
    EXPECT_NEAR(of_terms.conformance_probability, 0.65, 1e-12);
    EXPECT_EQ(of_terms.note, exact.note);
    const Verdict normal = *certified(record, data).verdict;
    EXPECT_THAT(normal.note, HasSubstr("normal distribution"));
    EXPECT_NEAR(normal.conformance_probability, 0.698, 1e-3);  // Φ(0.03 / 0.057735)
}

/// y = x, rectangular between 9.7 and 10.1.
class UniformModel final : public gum::MeasurementModel {
public:
    UniformModel() {
        gum::InputGroup x;
        x.name = "x";
        x.unit = "m";
        x.value = Eigen::VectorXd::Constant(1, 9.9);
        x.covariance = Eigen::MatrixXd::Constant(1, 1, 0.04 / 3.0);
        x.marginals = {gum::Distribution::uniform(9.9, 0.2)};
        inputs_ = {x};
        outputs_ = {{"y", "m"}};
    }
    const std::vector<gum::InputGroup>& inputs() const override { return inputs_; }
    const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override { return x; }
    Eigen::MatrixXd jacobian(const Eigen::VectorXd&) const override { return Eigen::MatrixXd::Identity(1, 1); }

private:
    std::vector<gum::InputGroup> inputs_;
    std::vector<gum::OutputQuantity> outputs_;
};

TEST(Certify, CountsTheTrialsOfMonteCarlo) {
    const auto model = std::make_shared<const UniformModel>();
    certificate::CapabilityInputs inputs;
    inputs.trials["l"] = {.model = model, .unit = gum::Unit::parse("m"), .seed = 7, .streams = {}, .trials = 9999};
    EvaluationRecord record = with_trials(9.9, 9.7, 10.1);
    const Verdict v = *certified(record, data_with_rule("DR-01", 9.0, 10.0, "m"), {}, inputs).verdict;
    int inside = 0;
    for (std::uint64_t trial = 0; trial < 9999; ++trial) {
        const double y = gum::monte_carlo_trial(*model, 7, trial)(0);
        inside += y >= 9.0 && y <= 10.0 ? 1 : 0;
    }
    EXPECT_NEAR(v.conformance_probability, inside / 9999.0, 1e-14);
    EXPECT_NEAR(v.conformance_probability, 0.75, 0.02);
    EXPECT_THAT(v.note, HasSubstr("9999 Monte Carlo trials"));
    EXPECT_THAT(v.note, HasSubstr("is 0.4 %"));  // √(0.75 · 0.25/9999)
    const Verdict far = *certified(record, data_with_rule("DR-01", 0.0, 100.0, "m"), {}, inputs).verdict;
    EXPECT_THAT(far.note, HasSubstr("is 0.01 %"));
    EXPECT_THAT(far.note, Not(HasSubstr("E-")));
    EXPECT_THAT(certified(record, data_with_rule("DR-01", 9.0, 10.0, "m")).verdict->note,
                HasSubstr("normal distribution"));
}

TEST(Certify, SaysWhyNothingCanBeDecided) {
    EvaluationRecord record = one_result(9.7, 0.2, "m");
    certify(record, data_with_rule("DR-99", 9.0, 10.0, "m"), {});
    const Verdict unknown = *record.certificate->tables[0].columns[0].values[0].verdict;
    EXPECT_EQ(unknown.verdict, "not_applicable");
    EXPECT_THAT(unknown.note, HasSubstr("DR-99"));
    EXPECT_THAT(ids(record), Contains("D05"));
    EXPECT_THAT(certified(one_result(9.7, 0.2, "m"), data_with_rule("DR-03", 9.0, 10.0, "kg")).verdict->note,
                HasSubstr("\"kg\""));
    record = one_result(9.7, 0.2, "m");
    record.results[0].U.reset();
    record.results[0].k.reset();
    record.results[0].coverage = "none";
    record.results[0].printed.U.clear();
    const Verdict without_U = *certified(record, data_with_rule("DR-03", 9.0, 10.0, "m")).verdict;
    EXPECT_THAT(without_U.note, HasSubstr("no expanded uncertainty"));
    EXPECT_FALSE(without_U.printed.lower.empty() || without_U.printed.upper.empty());
}

TEST(Certify, NeverDropsASpecificationThatWasAgreedOn) {
    CertificateData data = data_with_rule("DR-03", 9.0, 10.0, "m");
    data.external_results = {{.results = {"l"}, .provider = "Other Example Laboratory"}};
    EvaluationRecord record = one_result(9.7, 0.2, "m");
    certify(record, data, {});
    const Verdict v = *record.certificate->tables[0].columns[0].values[0].verdict;
    EXPECT_EQ(v.verdict, "not_applicable");
    EXPECT_EQ(v.formula, "AL = TL + U, AU = TU − U");
    EXPECT_THAT(v.note, HasSubstr("another laboratory provided"));
    EXPECT_EQ(v.printed.lower + " " + v.printed.upper, "9.00 10.00") << "they were agreed all the same";
    EXPECT_EQ(v.printed.acceptance_upper, "");
    EXPECT_THAT(ids(record), Contains("D05"));
}

TEST(Certify, PrintsNoGuardBandOfARuleThatHasNone) {
    for (const char* rule : {"DR-01", "DR-12"}) {
        const Verdict v = *certified(one_result(9.5, 0.2, "m"), data_with_rule(rule, 9.0, 10.0, "m")).verdict;
        EXPECT_EQ(v.printed.guard_band, "") << rule;
        EXPECT_EQ(v.printed.acceptance_lower, "9.00") << rule;
    }
    EXPECT_EQ(certified(one_result(9.5, 0.2, "m"), data_with_rule("DR-03", 9.0, 10.0, "m")).verdict->printed.guard_band,
              "0.20");
    // M = 0: the rule has a guard band, and it is 0 here.
    CertificateData data = data_with_rule("DR-09", 0.0, 20.0, "m");
    data.specifications[0].rule.method = "6";
    const Verdict wide = *certified(one_result(9.5, 0.2, "m"), data).verdict;
    EXPECT_EQ(certificate::number_of(wide.printed.guard_band), 0.0) << wide.formula;
}

TEST(Certify, PrintsNoGuardBandWhereNoValueIsAccepted) {
    const Verdict far = *certified(one_result(50.0, 0.6, "m"), data_with_rule("DR-08", -0.5, 0.5, "m")).verdict;
    EXPECT_EQ(far.verdict, "fail");
    EXPECT_EQ(far.printed.guard_band, "");
    EXPECT_EQ(far.printed.acceptance_lower, "");
    EXPECT_THAT(far.note, HasSubstr("Nonconformity is proven all the same"));
    for (const char* rule : {"DR-01", "DR-03", "DR-05", "DR-06", "DR-08", "DR-11", "DR-12"}) {
        EXPECT_EQ(certified(one_result(50.0, 0.6, "m"), data_with_rule(rule, -0.5, 0.5, "m")).verdict->verdict, "fail");
    }
}

TEST(Certify, DecidesOneSpecificationForAResult) {
    CertificateData data = data_with_rule("DR-01", 9.0, 10.0, "m");
    data.specifications.push_back(data.specifications.front());
    data.specifications.back().id = "second";
    EvaluationRecord record = one_result(9.7, 0.2, "m");
    certify(record, data, {});
    EXPECT_EQ(record.certificate->tables[0].columns[0].values[0].verdict->specification, "spec");
    EXPECT_THAT(ids(record), Contains("D09"));
}

// --- whole records ---

/// Monte Carlo confirms every value that the law of propagation gives: the samples hold some that it does not.
EvaluationRecord confirmed(EvaluationRecord record) {
    const auto confirm = [](std::optional<reports::MonteCarloSummary>& trials) {
        if (trials && trials->validation) {
            trials->validation->validated = true;
        }
    };
    for (reports::Result& result : record.results) {
        confirm(result.monte_carlo);
    }
    if (record.rotary) {
        for (const auto& place : reports::stated_values(*record.rotary)) {
            confirm(place.stated.monte_carlo);
        }
    }
    return record;
}

TEST(Certify, MakesTheSampleBudgetACertificateThatPasses) {
    EvaluationRecord record = confirmed(test::sample_budget_record());
    record.coverage_probability.number = record.results[0].coverage_probability = 0.9545;  // the sample states 99 %
    CertificateData data = test::sample_certificate_data();
    data.specifications.pop_back();  // of the rotary table
    certify(record, data, {});
    EXPECT_FALSE(record.certificate->blocked);
    EXPECT_TRUE(record.certificate->symbol);
    for (const Finding& f : record.certificate->findings) {
        EXPECT_NE(f.severity, certificate::FindingSeverity::critical) << f.id << " " << f.where << ": " << f.what;
    }
    const CertifiedValue& l = column(record, "results", "l").values.at(0);
    EXPECT_EQ(l.scope_entry, "L1");
    EXPECT_EQ(l.printed_U, "93");
    EXPECT_EQ(l.verdict->verdict, "pass");
}

TEST(Certify, MakesTheSampleRotaryTableACertificateThatPasses) {
    EvaluationRecord record = confirmed(test::sample_record());
    CertificateData data = test::sample_certificate_data();
    data.specifications.erase(data.specifications.begin());  // of the length
    certify(record, data, {});
    EXPECT_FALSE(record.certificate->blocked);
    EXPECT_TRUE(record.certificate->symbol);
    for (const Finding& f : record.certificate->findings) {
        EXPECT_NE(f.severity, certificate::FindingSeverity::critical) << f.id << " " << f.where << ": " << f.what;
    }
    EXPECT_THAT(ids(record), Contains("X06"));  // ranges and others are not in the scope
    const CertifiedColumn& axial = column(record, "error_motions", "EAA");
    ASSERT_EQ(axial.values.size(), 36U);
    for (std::size_t i = 0; i < axial.values.size(); ++i) {
        EXPECT_EQ(axial.values[i].scope_entry, "R2");
        EXPECT_TRUE(axial.values[i].verdict);
        EXPECT_EQ(record.rotary->errors[i].errors[3].printed.value, axial.values[i].printed_value);
        EXPECT_EQ(record.rotary->errors[i].errors[3].printed.U, axial.values[i].printed_U);
    }
    EXPECT_EQ(column(record, "ranges", "range_EXA").values.at(0).scope_entry, "");
}

TEST(Certify, PrintsOneTextForOneNumberEverywhere) {
    EvaluationRecord record = test::sample_record();
    CertificateData data = test::sample_certificate_data();
    data.specifications.clear();
    data.accreditation->scope[1].capability.U = 0.5;  // µm, above every linear U
    data.accreditation->scope[2].capability.U = 2.0;
    certify(record, data, {});
    const CertifiedValue& O_y = column(record, "set_up", "O_y").values.at(0);
    EXPECT_TRUE(O_y.raised);
    EXPECT_EQ(O_y.printed_value, "59.43");
    EXPECT_EQ(O_y.printed_U, "0.50");
    const reports::RotaryTable& rotary = *record.rotary;
    EXPECT_EQ(rotary.set_up.printed_O[1].U, "0.50");
    EXPECT_EQ(rotary.axis_in_fixture.printed_O[1].value, "-59.43");
    EXPECT_EQ(rotary.axis_in_fixture.printed_O[1].U, "0.50");
    EXPECT_EQ(rotary.axis_in_fixture.printed_O[2].value, "192.61");
    EXPECT_EQ(rotary.set_up.printed_O[0].value, "0");  // along the axis, by definition
    EXPECT_EQ(rotary.set_up.printed_O[0].U, "");
    for (const reports::ErrorsAtAngle& at : rotary.errors) {
        EXPECT_EQ(at.errors[0].printed.U, "0.50");
        EXPECT_EQ(at.errors[5].printed.U, "2.0");
        EXPECT_EQ(certificate::decimals_of(at.errors[5].printed.value), 1);
    }
    for (const reports::Result& result : record.results) {
        if (result.name.starts_with("O_") || result.name.starts_with("S_")) {
            EXPECT_EQ(result.printed.U, result.unit == "um" ? "0.50" : "2.0") << result.name;
        }
    }
    EXPECT_THAT(ids(record), Contains("X03"));
}

TEST(Certify, PrintsTheDegreesOfFreedomOfARange) {
    EvaluationRecord record = test::sample_record();
    reports::StatedValue& range = record.rotary->ranges[0].stated;
    range.k = 2.28;
    range.nu_eff = 10.0;
    certify(record, test::sample_certificate_data(), {});
    EXPECT_EQ(column(record, "ranges", "range_EXA").values.at(0).printed_k, "2.28");
    EXPECT_EQ(column(record, "ranges", "range_EXA").values.at(0).printed_nu_eff, "10");
    EXPECT_EQ(column(record, "ranges", "range_EYA").values.at(0).printed_nu_eff, "∞");
}

TEST(Certify, HoldsTheSetUpToTheRangeOfAllAngles) {
    EvaluationRecord record = test::sample_record();
    CertificateData data = test::sample_certificate_data();
    data.accreditation->scope[1].ranges[0].high = 340.0;  // 350° was measured
    certify(record, data, {});
    EXPECT_THAT(column(record, "set_up", "O_y").values.at(0).outside_because, HasSubstr("350"));
    const CertifiedColumn& motion = column(record, "error_motions", "EXA");
    EXPECT_EQ(motion.values.at(34).scope_entry, "R1");
    EXPECT_EQ(motion.values.at(35).scope_entry, "");
}

TEST(Certify, LeavesValuesWithoutUncertaintyByDefinitionAsTheyAre) {
    EvaluationRecord record = confirmed(test::sample_record());
    reports::StatedValue& home = record.rotary->errors[0].errors[0];
    home.value = home.u = home.U = 0.0;
    home.monte_carlo.reset();
    home.printed = {.value = "0", .U = "", .unit = "µm"};
    CertificateData data = test::sample_certificate_data();
    data.specifications = {test::sample_specification("linear", "EXA", -10.0, 10.0, "um")};
    certify(record, data, {});
    const CertifiedValue& v = column(record, "error_motions", "EXA").values.at(0);
    EXPECT_EQ(v.printed_value, "0");
    EXPECT_EQ(v.printed_U, "");
    EXPECT_EQ(v.printed_k, "");
    EXPECT_FALSE(v.U);
    EXPECT_FALSE(v.capability);
    EXPECT_EQ(v.verdict->verdict, "not_applicable");
    EXPECT_THAT(v.verdict->note, HasSubstr("defined, not measured"));
    EXPECT_TRUE(column(record, "error_motions", "EXA").values.at(1).verdict);
    EXPECT_FALSE(record.certificate->blocked);
}

// U = 0 of constants is stated; a result that cancels has u = 0 and no U, and was measured all the same.
TEST(Certify, TellsAnExactValueFromOneThatCancels) {
    const auto note = [](std::optional<double> U, const std::string& coverage) {
        EvaluationRecord record = confirmed(test::sample_budget_record());
        Result& result = record.results.front();
        result.reported = {};
        result.monte_carlo.reset();
        result.u = 0.0;
        result.U = U;
        result.k.reset();
        result.nu_eff.reset();
        result.coverage = coverage;
        result.printed.U = U ? "0" : "";
        CertificateData data = test::sample_certificate_data();
        data.specifications = {test::sample_specification("limits", result.name, -1e9, 1e9, result.unit)};
        certify(record, data, {});
        return column(record, "results", result.name).values.at(0).verdict->note;
    };
    EXPECT_THAT(note(0.0, "student_t"), HasSubstr("defined, not measured"));
    EXPECT_THAT(note({}, "none"), HasSubstr("no expanded uncertainty is stated"));
}

TEST(Certify, SaysWhereMonteCarloDoesNotValidate) {
    EvaluationRecord record = test::sample_record();  // EXA at 30° is not validated
    certify(record, test::sample_certificate_data(), {});
    const auto& findings = record.certificate->findings;
    const auto found = std::find_if(findings.begin(), findings.end(), [](const Finding& f) { return f.id == "S05"; });
    ASSERT_NE(found, findings.end());
    EXPECT_EQ(found->where, "EXA");
    EXPECT_EQ(found->severity, certificate::FindingSeverity::critical);
    EXPECT_TRUE(record.certificate->blocked);
}

TEST(Certify, BlocksALawOfPropagationThatWasForced) {
    EvaluationRecord record = one_result(9.7, 0.2, "m");
    certify(record, test::sample_certificate_data(), {});
    EXPECT_THAT(ids(record), Not(Contains("S05")));
    record = one_result(9.7, 0.2, "m");
    record.results[0].reported = reports::reported_result(record.results[0]);
    record.results[0].reported.against = "second_order";
    certify(record, test::sample_certificate_data(), {});
    const auto& findings = record.certificate->findings;
    const auto found = std::find_if(findings.begin(), findings.end(), [](const Finding& f) { return f.id == "S05"; });
    ASSERT_NE(found, findings.end());
    EXPECT_EQ(found->severity, certificate::FindingSeverity::critical);
    EXPECT_TRUE(record.certificate->blocked);
}

// p, k and U that are printed together agree: the deviations of the known distribution grow with U.
TEST(Certify, WidensTheKnownDistributionWhereTheCapabilityIsStated) {
    EvaluationRecord record = one_result(9.97, 0.0954, "m");  // rectangular, half-width 0.1
    record.results[0].coverage = "convolution";
    record.results[0].u = 0.1 / std::sqrt(3.0);
    record.results[0].k = 0.0954 / record.results[0].u;
    certificate::CapabilityInputs inputs;
    inputs.distributions["l"] = [] {
        return certificate::ResultDistribution{
            .function = [](double x) { return std::clamp((x - 9.87) / 0.2, 0.0, 1.0); }, .below = {}};
    };
    CertificateData data = data_with(test::capability_of_one_value(0.1908, "m"));
    data.specifications = data_with_rule("DR-01", 9.0, 10.0, "m").specifications;
    const CertifiedValue v = certified(record, data, {}, inputs);
    EXPECT_TRUE(v.raised);
    EXPECT_NEAR(v.verdict->conformance_probability, 0.575, 1e-12);  // rectangular, half-width 0.2
    EXPECT_THAT(v.verdict->note, HasSubstr("widened"));
}

// The end of an interval that is nearer to a limit counts.
TEST(Certify, DecidesWithTheFartherEndOfAnInterval) {
    EvaluationRecord record = with_trials(9.5, 9.4, 9.8);
    record.results[0].coverage = "none";
    record.results[0].U.reset();
    record.results[0].k.reset();
    record.results[0].printed = {.value = "9.50", .U = "", .unit = "m"};
    const auto model = std::make_shared<const UniformModel>();
    certificate::CapabilityInputs inputs;
    inputs.trials["l"] = {.model = model, .unit = gum::Unit::parse("m"), .seed = 7, .streams = {}, .trials = 9999};
    const Verdict v = *certified(record, data_with_rule("DR-03", 9.0, 10.0, "m"), {}, inputs).verdict;
    EXPECT_NEAR(v.guard_band, 0.3, 1e-12);
    EXPECT_EQ(v.verdict, "pass");
    EXPECT_THAT(v.note, HasSubstr("larger distance"));
    EXPECT_THAT(certified(record, data_with_rule("DR-01", 9.0, 10.0, "m"), {}, inputs).verdict->note,
                Not(HasSubstr("larger distance")))
        << "its formula has no U";
    EXPECT_EQ(certified(record, data_with_rule("DR-03", 9.0, 9.75, "m"), {}, inputs).verdict->verdict, "fail");
}

TEST(Certify, CertifiesEveryPointOfATable) {
    EvaluationRecord record = one_result(10.0, 0.002, "mm");
    for (const char* point : {"1", "2", "3"}) {
        reports::Result r = record.results[0];
        r.point = point;
        r.name = "l[" + r.point + "]";
        r.value = 10.0 * std::stod(r.point);
        record.results.push_back(r);
    }
    record.results.erase(record.results.begin());
    Capability c = test::capability_of_one_value(0.0, "mm");
    c.form = "function";
    c.arguments = {{.name = "s", .unit = "m", .of = "s"}};
    c.expression = "0.001 + 2*s";
    certificate::CapabilityInputs inputs;
    inputs.values["s"] = {.unit = "mm", .values = {0.4, 0.6, 1.0}};  // 0.0018, 0.0022, 0.0030 mm
    certify(record, data_with(c), {}, inputs);
    const CertifiedColumn& l = column(record, "results", "l");
    ASSERT_EQ(l.values.size(), 3U);
    EXPECT_EQ(l.values[0].printed_U, "0.0020");
    EXPECT_EQ(l.values[1].printed_U, "0.0022");
    EXPECT_EQ(l.values[2].printed_U, "0.0030");
    EXPECT_EQ(record.results[1].printed.U, "0.0022");
    EXPECT_EQ(record.results[2].printed.value, "30.0000");
}

}  // namespace
}  // namespace gumcert::reports
