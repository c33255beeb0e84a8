#include "reports/record/evaluation_record.h"
#include "reports/record/record_rules.h"
#include "tests/support/record_refusal.h"
#include "tests/support/sample_comparison_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {
namespace {

using nlohmann::json;
using test::record_refusal;
using ::testing::HasSubstr;

std::string write_refusal(const EvaluationRecord& record) {
    try {
        static_cast<void>(to_canonical_json(record));
    } catch (const gum::NoResultError& e) {
        return e.diagnostics().front().code + " " + gum::message(e.diagnostics().front());
    }
    return "accepted";
}

TEST(ComparisonRecord, ReadsBackToTheSameBytes) {
    for (const EvaluationRecord& r : {test::sample_laboratories_record(), test::sample_methods_record(),
                                      test::sample_laboratories_record(2), test::sample_methods_record(1)}) {
        const std::string text = to_canonical_json(r);
        EXPECT_EQ(to_canonical_json(record_from_json(text, "record.json")), text);
    }
    const Comparison c =
        *record_from_json(to_canonical_json(test::sample_laboratories_record()), "record.json").comparison;
    const Comparison expected = *test::sample_laboratories_record().comparison;
    EXPECT_EQ(c.points[2].nu, 14.0);
    EXPECT_FALSE(c.points[4].u.has_value());
    EXPECT_FALSE(c.points[4].En.number.has_value());
    EXPECT_FALSE(c.points[3].contributes);
    EXPECT_EQ(c.points[3].reason, expected.points[3].reason);
    EXPECT_EQ(c.items[1].missing, std::vector<std::string>{"L006"});
    EXPECT_EQ(c.items[1].consistency->incompatible_pairs, 2);
    EXPECT_EQ(c.items[1].consensus->ratio.number, -0.64);
    EXPECT_EQ(c.items[0].pairs.size(), expected.items[0].pairs.size());
    EXPECT_EQ(c.youden[0].ellipse[17], expected.youden[0].ellipse[17]);
    EXPECT_EQ(c.youden[0].points.back().participant, "L009");
}

TEST(ComparisonRecord, DirectionsKeepTheOrderOfTheJob) {
    const std::string text = to_canonical_json(test::sample_methods_record());
    const EvaluationRecord again = record_from_json(text, "x");
    std::vector<std::string> names;
    for (const ComparisonSummary& s : again.comparison->summary) {
        names.push_back(s.direction);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"up", "down", "all"}));
    EXPECT_EQ(again.comparison->summary[1].bias->U_slope.number, 0.004);

    json r = json::parse(text);
    for (json& s : r["comparison"]["summary"]) {
        s.erase("order");  // as earlier releases wrote it
    }
    r.erase("digest");
    const EvaluationRecord old = record_from_json(r.dump(), "x");
    EXPECT_EQ(old.comparison->summary.front().direction, "down");
    EXPECT_EQ(old.comparison->summary.back().direction, "all");

    EvaluationRecord unnamed = test::sample_methods_record();
    unnamed.comparison->summary[0].direction = "";  // a job that names no direction
    const std::string written = to_canonical_json(unnamed);
    EXPECT_EQ(to_canonical_json(record_from_json(written, "x")), written);
}

/// A comparison as releases before the comparisons between laboratories wrote it.
json of_an_earlier_release() {
    static const std::set<std::string> k_comparison = {"reference_name", "contact_point_mm", "reference_budget",
                                                       "points",         "summary",          "remarks"};
    static const std::set<std::string> k_point = {
        "direction", "angle_deg", "value", "u",  "U",    "reference_value", "reference_u", "reference_U",
        "D",         "u_D",       "U_D",   "En", "zeta", "printed"};
    static const std::set<std::string> k_point_printed = {"angle",       "value", "U",   "reference_value",
                                                          "reference_U", "D",     "U_D", "En"};
    static const std::set<std::string> k_summary = {"points",     "count_above_1", "mean_abs_En",
                                                    "max_abs_En", "rms_En",        "printed"};
    static const std::set<std::string> k_summary_printed = {"mean_abs_En", "max_abs_En", "rms_En"};
    const auto keep = [](json& object, const std::set<std::string>& keys) {
        json kept = json::object();
        for (const std::string& key : keys) {
            kept[key] = object.at(key);
        }
        object = kept;
    };
    json r = json::parse(to_canonical_json(test::sample_record()));
    json& c = r["comparison"];
    keep(c, k_comparison);
    for (json& p : c["points"]) {
        keep(p, k_point);
        keep(p["printed"], k_point_printed);
    }
    for (json& s : c["summary"]) {
        keep(s, k_summary);
        keep(s["printed"], k_summary_printed);
    }
    r.erase("digest");
    return r;
}

TEST(ComparisonRecord, ARecordOfAnEarlierReleaseIsRead) {
    const json old = of_an_earlier_release();
    EXPECT_EQ(record_refusal(old.dump()), "accepted");
    const EvaluationRecord r = record_from_json(old.dump(), "x");
    EXPECT_EQ(r.comparison->form, "rotary_table");
    EXPECT_EQ(r.comparison->unit, "um");
    EXPECT_TRUE(r.comparison->points[0].contributes);
    EXPECT_EQ(r.comparison->points[40].En.number, test::sample_record().comparison->points[40].En.number);
    EXPECT_EQ(r.comparison->summary[3].direction, "all");
    EXPECT_FALSE(r.comparison->summary[3].p_low.number.has_value());
    // What it said is said again, unchanged, beside the keys that came later.
    for (const json& step : json::diff(old, json::parse(to_canonical_json(r)))) {
        EXPECT_EQ(step["op"], "add") << step.dump();
    }
}

TEST(ComparisonRecord, ARecordOfThisKindSaysItsForm) {
    json without_form = json::parse(to_canonical_json(test::sample_laboratories_record()));
    without_form["comparison"].erase("form");
    EXPECT_THAT(record_refusal(without_form.dump()), HasSubstr("/comparison/form"));
    json without_comparison = json::parse(to_canonical_json(test::sample_methods_record()));
    without_comparison["comparison"] = nullptr;
    EXPECT_THAT(record_refusal(without_comparison.dump()), HasSubstr("GC-RECORD-0017 record.json#/comparison"));
}

TEST(ComparisonRecord, RefusesPartsThatDoNotFitTogether) {
    const auto refused = [](const EvaluationRecord& record, const std::function<void(json&)>& alter) {
        json r = json::parse(to_canonical_json(record));
        alter(r["comparison"]);
        return record_refusal(r.dump());
    };
    const EvaluationRecord between = test::sample_laboratories_record();
    const EvaluationRecord methods = test::sample_methods_record();
    EXPECT_THAT(refused(between, [](json& c) { c["participants"][1]["id"] = "L001"; }),
                HasSubstr("GC-RECORD-0017 record.json#/comparison/participants/1/id — \"L001\" — a participant is "
                          "listed once"));
    EXPECT_THAT(refused(between, [](json& c) { c["points"][1]["participant"] = "L999"; }),
                HasSubstr("/comparison/points/1/participant — \"L999\" — must be one of the participants"));
    EXPECT_THAT(refused(between, [](json& c) { c["points"][1]["round"] = "2"; }),
                HasSubstr("/comparison/points/1/item — \"A\" in round \"2\" — must be one of the items"));
    EXPECT_THAT(refused(between, [](json& c) { c["items"][1]["id"] = "A"; }),
                HasSubstr("/comparison/items/1/id — \"A\" — an item is listed once in a round"));
    EXPECT_THAT(refused(between, [](json& c) { c["items"][0]["consistency"]["incompatible_pairs"] = 22; }),
                HasSubstr("/incompatible_pairs — 22 — not more than the 21 pairs"));
    EXPECT_THAT(refused(between, [](json& c) { c["points"][0]["correlation"] = -1.01; }),
                HasSubstr("/comparison/points/0/correlation — -1.01 — a correlation coefficient lies between"));
    EXPECT_THAT(refused(between, [](json& c) { c["points"][0]["signal"] = "alarm"; }),
                HasSubstr("/comparison/points/0/signal — \"alarm\" — must be one of \"\" \"none\" \"inconclusive\""));
    EXPECT_THAT(refused(between, [](json& c) { c["items"][0].erase("estimates"); }),
                HasSubstr("/comparison/items/0/estimates — missing"));
    EXPECT_THAT(refused(between, [](json& c) { c["extra"] = 1; }), HasSubstr("/comparison/extra — unknown key"));
    EXPECT_THAT(refused(methods, [](json& c) { c["summary"]["up"]["order"] = 1; }),
                HasSubstr("/order — 1 — the orders of all directions are 0, 1, 2 …, each once"));
    EXPECT_THAT(refused(methods, [](json& c) { c["summary"]["up"].erase("order"); }),
                HasSubstr("/comparison/summary/up/order — missing"));
    EXPECT_THAT(refused(methods,
                        [](json& c) {
                            c["summary"]["up"]["order"] = 2;
                            c["summary"]["all"]["order"] = 0;
                        }),
                HasSubstr("/comparison/summary/all — before other directions"));
    EXPECT_THAT(refused(methods, [](json& c) { c["summary"]["up"]["verdict"] = "passed"; }),
                HasSubstr("/comparison/summary/up/verdict — \"passed\""));
    EXPECT_THAT(refused(methods, [](json& c) { c["shared_sources"][0]["correlation"] = 1.2; }),
                HasSubstr("/comparison/shared_sources/0/correlation — 1.2"));
}

TEST(ComparisonRecord, RefusesWordsThatItDoesNotKnow) {
    const std::vector<std::pair<const char*, const char*>> words = {{"/items/0/method", "mean_of_friends"},
                                                                    {"/items/0/method", "niqr"},
                                                                    {"/items/0/method", ""},
                                                                    {"/items/0/estimates/0/method", "reference"},
                                                                    {"/items/0/estimates/1/method", "mean"},
                                                                    {"/items/0/sigma_pt_method", "Horwitz"},
                                                                    {"/items/0/score", "zeta_prime"},
                                                                    {"/points/0/realism", "good"},
                                                                    {"/points/0/signal", "alarm"},
                                                                    {"/correlation", "guessed"},
                                                                    {"/summary/all/verdict", "validated twice"},
                                                                    {"/summary/all/bias/against", "time"}};
    for (const auto& [pointer, word] : words) {
        const bool between = std::string_view(pointer).find("summary") == std::string_view::npos;
        json r = json::parse(
            to_canonical_json(between ? test::sample_laboratories_record() : test::sample_methods_record()));
        r["comparison"].at(json::json_pointer(pointer)) = word;
        EXPECT_THAT(record_refusal(r.dump()), HasSubstr("GC-RECORD-0016 record.json#/comparison" +
                                                        std::string(pointer) + " — \"" + word + "\" — must be one of"));
    }
}

TEST(ComparisonRecord, RefusesACriterionWithoutItsVerdict) {
    for (const char* const key : {"criterion", "criterion_met"}) {
        json r = json::parse(to_canonical_json(test::sample_laboratories_record()));
        r["comparison"]["items"][0][key] = nullptr;
        EXPECT_THAT(record_refusal(r.dump()), HasSubstr("criterion and criterion_met stand together")) << key;
    }
}

TEST(ComparisonRecord, RefusesIdsThatNameNothing) {
    const std::vector<std::pair<const char*, const char*>> ids = {
        {"/items/0/reference_participant", "participants"}, {"/items/0/not_contributing/0", "participants"},
        {"/items/0/not_consistent/0", "participants"},      {"/items/0/missing/0", "participants"},
        {"/items/1/weights/2/participant", "participants"}, {"/items/1/pairs/3/first", "participants"},
        {"/items/1/pairs/3/second", "participants"},        {"/points/1/participant", "participants"},
        {"/points/1/item", "items, in its round"},          {"/points/1/round", "items, in its round"},
        {"/vectors/0/participant", "participants"},         {"/youden/0/first_item", "items, in its round"},
        {"/youden/0/second_item", "items, in its round"},   {"/youden/0/points/2/participant", "participants"},
        {"/shared_sources/0/first", "participants"},        {"/shared_sources/0/second", "participants"}};
    const json record = json::parse(to_canonical_json(test::sample_laboratories_record()));
    for (const auto& [pointer, what] : ids) {
        for (const char* const id : {"L999", ""}) {
            if (id == std::string_view{} && std::string_view(pointer) == "/items/0/reference_participant") {
                continue;  // "": the assigned value is not the result of a reference
            }
            json r = record;
            r["comparison"].at(json::json_pointer(pointer)) = id;
            const std::string told = record_refusal(r.dump());
            EXPECT_THAT(told, HasSubstr("GC-RECORD-0017 record.json#/comparison/")) << pointer;
            EXPECT_THAT(told, HasSubstr("must be one of the " + std::string(what))) << pointer;
        }
    }
    for (const char* const side : {"first", "second"}) {
        json r = json::parse(to_canonical_json(test::sample_methods_record()));
        r["comparison"]["shared_sources"][0][side] = "another method";
        EXPECT_THAT(record_refusal(r.dump()),
                    HasSubstr("GC-RECORD-0017 record.json#/comparison/shared_sources/0/" + std::string(side) +
                              " — \"another method\" — must be one of the two methods"));
    }
}

TEST(ComparisonRecord, WriterRefusesWhatTheReaderWouldRefuse) {
    const auto refused = [](const std::function<void(Comparison&)>& alter) {
        EvaluationRecord r = test::sample_laboratories_record();
        alter(*r.comparison);
        return write_refusal(r);
    };
    EXPECT_THAT(refused([](Comparison& c) { c.points[7].En.number = std::numeric_limits<double>::quiet_NaN(); }),
                HasSubstr("GC-RECORD-0001 record#/comparison/points/7/En — NaN"));
    EXPECT_THAT(refused([](Comparison& c) { c.items[1].pairs[3].U.number = -1.0; }),
                HasSubstr("record#/comparison/items/1/pairs/3/U — -1 — must be 0 or greater"));
    EXPECT_THAT(refused([](Comparison& c) { c.points[0].signal = "alarm"; }),
                HasSubstr("record#/comparison/points/0/signal"));
    EXPECT_THAT(refused([](Comparison& c) { c.points[0].participant = "nobody"; }),
                HasSubstr("record#/comparison/points/0/participant"));
    EXPECT_THAT(refused([](Comparison& c) { c.youden[0].ellipse[2].second = 1.0 / 0.0; }),
                HasSubstr("record#/comparison/youden/0/ellipse/2/1 — infinity"));
    EXPECT_THAT(refused([](Comparison& c) {
                    c.summary.resize(2);
                    c.summary[0].direction = c.summary[1].direction = "x";
                }),
                HasSubstr("the name \"x\" is used twice"));
    EXPECT_THAT(refused([](Comparison& c) { c.items[1].weights[3].participant = "nobody"; }),
                HasSubstr("record#/comparison/items/1/weights/3/participant — \"nobody\" — must be one of the "
                          "participants — nothing was written; report this as a defect"));
}

TEST(ComparisonRecord, ARecordThatIsTooLargeIsNoDefectOfTheProgram) {
    EvaluationRecord r = test::sample_methods_record();
    r.comparison->remarks.emplace_back(k_max_record_bytes, 'x');
    const std::string told = write_refusal(r);
    EXPECT_THAT(told, HasSubstr("a record has at most 536870912 bytes — nothing was written; split the job"));
    EXPECT_THAT(told, testing::Not(HasSubstr("defect")));
}

TEST(ComparisonRecord, TenThousandLaboratoriesFitIntoARecord) {
    const EvaluationRecord r = test::sample_laboratories_record(10'000);
    const std::string text = to_canonical_json(r);
    EXPECT_EQ(to_canonical_json(record_from_json(text, "x")), text);
}

}  // namespace
}  // namespace gumcert::reports
