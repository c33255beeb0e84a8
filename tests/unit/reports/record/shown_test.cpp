#include "reports/record/shown.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/evaluation_record.h"
#include "tests/support/record_refusal.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_comparison_record.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;
using test::record_refusal;
using ::testing::HasSubstr;

json sample() {
    json record = json::parse(to_canonical_json(test::sample_methods_record()));
    record.erase("digest");
    return record;
}

/// What the reader says of the sample with its first point changed.
std::string refusal_of(const std::function<void(json& point)>& change) {
    json record = sample();
    change(record["comparison"]["points"][0]);
    return record_refusal(record.dump());
}

TEST(Shown, IsANumberWithItsTextBesideItInTheRecord) {
    EvaluationRecord record = test::sample_methods_record();
    record.comparison->points[0].En = {-0.25, "a text"};
    record.comparison->points[0].U = {std::nullopt, "why there is none"};
    const std::string text = to_canonical_json(record);
    const json point = json::parse(text)["comparison"]["points"][0];
    EXPECT_EQ(point["En"], -0.25);
    EXPECT_EQ(point["printed"]["En"], "a text");
    EXPECT_TRUE(point["U"].is_null());
    EXPECT_EQ(point["printed"]["U"], "why there is none");
    const ComparisonPoint again = record_from_json(text, "x").comparison->points[0];
    EXPECT_EQ(again.En.number, -0.25);
    EXPECT_EQ(again.En.text, "a text");
    EXPECT_FALSE(again.U.number);
    EXPECT_EQ(again.U.text, "why there is none");
}

TEST(Shown, HasTextsWithoutANumberOfTheirKeyBesideIt) {
    const json point = sample()["comparison"]["points"][0];
    EXPECT_TRUE(point["printed"].contains("angle"));
    EXPECT_FALSE(point.contains("angle"));
}

TEST(Shown, OfAListHasATextOfEachElement) {
    EvaluationRecord record = test::sample_two_results_record();
    record.covariance->correlation = {{{1.0, 0.25}, {0.25, 1.0}}, {{"1", "a text"}, {"a text", "1"}}};
    record.fits[0].u_y = {std::vector<double>(11, 0.5), std::vector<std::string>(11, "half")};
    const std::string text = to_canonical_json(record);
    const json written = json::parse(text);
    EXPECT_EQ(written["covariance"]["correlation"][0], (json{1.0, 0.25}));
    EXPECT_EQ(written["covariance"]["printed"]["correlation"][0], (json{"1", "a text"}));
    const EvaluationRecord again = record_from_json(text, "x");
    EXPECT_EQ(again.covariance->correlation.number, record.covariance->correlation.number);
    EXPECT_EQ(again.covariance->correlation.text, record.covariance->correlation.text);
    EXPECT_EQ(again.fits[0].u_y.number, record.fits[0].u_y.number);
    EXPECT_EQ(again.fits[0].u_y.text, record.fits[0].u_y.text);
}

TEST(Shown, HasItsTextUnderAnotherKeyWhereTheRecordSaysSo) {
    EvaluationRecord record = test::sample_two_results_record();
    record.readings[0].autocorrelation_limit = {0.75, "a text"};
    const std::string text = to_canonical_json(record);
    const json readings = json::parse(text)["readings"][0];
    EXPECT_EQ(readings["autocorrelation_limit"], 0.75);
    EXPECT_EQ(readings["printed"]["limit"], "a text");
    EXPECT_FALSE(readings["printed"].contains("autocorrelation_limit"));
    const ReadingsSummary again = record_from_json(text, "x").readings[0];
    EXPECT_EQ(again.autocorrelation_limit.number, 0.75);
    EXPECT_EQ(again.autocorrelation_limit.text, "a text");
}

TEST(Shown, IsRefusedWithoutItsNumberOrItsText) {
    EXPECT_THAT(refusal_of([](json& point) { point.erase("D"); }), HasSubstr("/points/0/D — missing"));
    EXPECT_THAT(refusal_of([](json& point) { point["printed"].erase("D"); }),
                HasSubstr("GC-RECORD-0013 record.json#/comparison/points/0/printed/D — missing"));
    EXPECT_THAT(refusal_of([](json& point) { point["printed"]["D"] = 1; }), HasSubstr("/points/0/printed/D"));
    EXPECT_THAT(refusal_of([](json& point) { point.erase("printed"); }), HasSubstr("/points/0/printed — missing"));
    EXPECT_THAT(refusal_of([](json& point) { point["printed"]["E"] = "1"; }),
                HasSubstr("GC-RECORD-0014 record.json#/comparison/points/0/printed/E — unknown key"));
}

TEST(Shown, MayBeMissingWhereALaterReleaseAddedIt) {
    EXPECT_EQ(refusal_of([](json& point) {
                  point.erase("z");
                  point["printed"].erase("z");
                  point["printed"].erase("zeta");  // its number has always been there
              }),
              "accepted");
    EXPECT_THAT(refusal_of([](json& point) { point.erase("zeta"); }), HasSubstr("/points/0/zeta — missing"));
}

TEST(Shown, OfANumberStandsWhereOneMayBeAbsent) {
    const Shown<double> number{2.5, "2.5"};
    const Shown<std::optional<double>> same = number;
    EXPECT_EQ(same.number, 2.5);
    EXPECT_EQ(same.text, "2.5");
}

}  // namespace
}  // namespace gumcert::reports
