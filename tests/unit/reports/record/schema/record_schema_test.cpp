#include "reports/record/schema/record_schema.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/record/evaluation_record.h"
#include "reports/record/schema/schema_definitions.h"
#include "tests/support/file_content.h"
#include "tests/support/fuzz_corpus.h"
#include "tests/support/json_schema.h"
#include "tests/support/record_refusal.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_comparison_record.h"
#include "tests/support/sample_evidence.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

// What users and editors see is frozen: a change of a description is a change of this file.
TEST(DescribedRecord, IsTheSchema) {
    EXPECT_TRUE(record_schema_text() ==
                test::file_content(std::filesystem::path(GUMCERT_SOURCE_DIR) / "schemas/record-1.schema.json"))
        << "build the target write_schemas, run it in the tree, and look at the difference";
}

TEST(DescribedRecord, HasNoDefinitionThatNothingRefersTo) {
    const ordered_json schema = record_schema();
    std::set<std::string> defined;
    for (const auto& [name, definition] : schema.at("definitions").items()) {
        defined.insert(name);
        EXPECT_NE(schema.dump().find("\"#/definitions/" + name + '"'), std::string::npos) << name;
    }
    std::apply([&](const auto&... row) { EXPECT_EQ(defined, (std::set<std::string>{std::string(row.name)...})); },
               k_definitions);
}

TEST(AddToSchema, SaysMoreOfOneValue) {
    ordered_json schema = ordered_json::parse(R"j({
        "properties": {"whole": {"type": "array", "items": {"type": "number", "minimum": 1}}},
        "definitions": {"part": {"properties": {"u": {"type": "number"}, "other": {"$ref": "#/definitions/part"}}}}})j");
    add_to_schema(schema, "part/u", {{"minimum", 0}, {"description", "of it"}});
    add_to_schema(schema, "part/other", {{"description", "a reference"}});
    add_to_schema(schema, "/whole/*", {{"minimum", 3}});
    EXPECT_EQ(schema.dump(), ordered_json::parse(R"j({
        "properties": {"whole": {"type": "array", "items": {"type": "number", "minimum": 3}}},
        "definitions": {"part": {"properties": {
            "u": {"description": "of it", "type": "number", "minimum": 0},
            "other": {"description": "a reference", "$ref": "#/definitions/part"}}}}})j")
                                 .dump());
    for (const char* place : {"whole", "part/U", "part/u/*", "part/u/x", "/whole/*/u", "/part"}) {
        EXPECT_THROW(add_to_schema(schema, place, {{"minimum", 5}}), std::invalid_argument) << place;
    }
    EXPECT_THROW(add_to_schema(schema, "part/u", {{"minimum", 0}}), std::invalid_argument) << "it says so already";
    EXPECT_THROW(add_to_schema(schema, "part/other", {{"minimum", 0}}), std::invalid_argument) << "nobody would look";
}

class RecordSchema : public ::testing::Test {
protected:
    [[nodiscard]] bool accepts(const json& record) { return (messages_ = schema_.refusals(record)).empty(); }

    const test::JsonSchema schema_{"record-1.schema.json"};
    std::string messages_;
};

TEST_F(RecordSchema, AcceptsAWholeRecord) {
    const json record = json::parse(to_canonical_json(test::sample_record()));
    EXPECT_TRUE(accepts(record)) << messages_;
    EXPECT_TRUE(accepts(json::parse(to_canonical_json(test::record_with_evidence())))) << messages_;
    EvaluationRecord small = test::sample_record();
    small.rotary.reset();
    small.comparison.reset();
    EXPECT_TRUE(accepts(json::parse(to_canonical_json(small)))) << messages_;
}

TEST_F(RecordSchema, AcceptsBudgets) {
    for (const EvaluationRecord& r :
         {test::sample_budget_record(), test::sample_two_results_record(), test::sample_points_record(2)}) {
        EXPECT_TRUE(accepts(json::parse(to_canonical_json(r)))) << messages_;
    }
}

TEST_F(RecordSchema, RefusesBudgetsThatTheReaderRefuses) {
    const json one = json::parse(to_canonical_json(test::sample_budget_record()));
    const json two = json::parse(to_canonical_json(test::sample_two_results_record()));
    const std::vector<std::pair<const json*, std::function<void(json&)>>> breaks = {
        {&one, [](json& r) { r["results"]["l"]["monte_carlo"]["symmetric"].push_back(1); }},
        {&one, [](json& r) { r["results"]["l"]["monte_carlo"]["trials"] = 0; }},
        {&one, [](json& r) { r["results"]["l"]["monte_carlo"]["numerical_error"]["u"] = -1; }},
        {&one, [](json& r) { r["results"]["l"]["monte_carlo"]["validation"]["interval"] = "both"; }},
        {&one, [](json& r) { r["results"]["l"]["monte_carlo"]["printed"].erase("trials"); }},
        {&one, [](json& r) { r["results"]["l"]["monte_carlo"]["histogram"]["counts"][2] = 1.5; }},
        {&one, [](json& r) { r["results"]["l"]["second_order"].erase("shift"); }},
        {&one, [](json& r) { r["results"]["l"]["budget"][1]["components"][0]["type"] = "C"; }},
        {&one, [](json& r) { r["results"]["l"]["budget"][0]["printed"]["sensitivity"] = 1; }},
        {&one, [](json& r) { r["model"]["equations"] = "l"; }},
        {&two, [](json& r) { r["results"]["R"]["coverage"] = "k = 2"; }},
        {&two, [](json& r) { r["results"]["R"]["correlation"]["extra"] = 1; }},
        {&two, [](json& r) { r["covariance"].erase("names"); }},
        {&two, [](json& r) { r["covariance"]["matrix"][0][0] = "1"; }},
        {&two, [](json& r) { r["region"]["from"] = "guess"; }},
        {&two, [](json& r) { r["region"]["smallest_region"]["cells_per_axis"][0] = 0; }},
        {&two, [](json& r) { r["fits"][0]["method"] = "by eye"; }},
        {&two, [](json& r) { r["fits"][0]["parameters"][0].erase("u"); }},
        {&two, [](json& r) { r["fits"][0]["data"]["y"] = nullptr; }},
        {&two, [](json& r) { r["readings"][0]["dependent"] = "no"; }},
        {&two, [](json& r) { r["variance_analyses"][0]["p_value"] = 1.1; }},
        {&two, [](json& r) { r["variance_analyses"][0]["conclusion"] = ""; }},
    };
    for (std::size_t i = 0; i < breaks.size(); ++i) {
        json broken = *breaks[i].first;
        breaks[i].second(broken);
        EXPECT_FALSE(accepts(broken)) << "break " << i;
        EXPECT_THROW(static_cast<void>(record_from_json(broken.dump(), "x")), gum::InputError) << "break " << i;
    }
}

TEST_F(RecordSchema, AcceptsComparisons) {
    for (const EvaluationRecord& r : {test::sample_laboratories_record(), test::sample_methods_record()}) {
        EXPECT_TRUE(accepts(json::parse(to_canonical_json(r)))) << messages_;
    }
}

TEST_F(RecordSchema, RefusesComparisonsThatTheReaderRefuses) {
    const json between = json::parse(to_canonical_json(test::sample_laboratories_record()));
    const json methods = json::parse(to_canonical_json(test::sample_methods_record()));
    const std::vector<std::pair<const json*, std::function<void(json&)>>> breaks = {
        {&between, [](json& c) { c["items"][0].erase("value"); }},
        {&between, [](json& c) { c["items"][0]["u"] = -0.1; }},
        {&between, [](json& c) { c["items"][0]["k"] = 0; }},
        {&between, [](json& c) { c["items"][0]["score"] = "Q"; }},
        {&between, [](json& c) { c["items"][0]["method"] = "niqr"; }},
        {&between, [](json& c) { c["items"][0]["sigma_pt_method"] = "Horwitz"; }},
        {&between, [](json& c) { c["items"][0]["estimates"][1]["method"] = "given"; }},
        {&between, [](json& c) { c["items"][0]["missing"] = "L006"; }},
        {&between, [](json& c) { c["items"][0]["weights"][0]["share"] = 1; }},
        {&between, [](json& c) { c["items"][0]["consistency"]["p_value"] = 1.2; }},
        {&between, [](json& c) { c["items"][0]["consistency"]["pairs"] = 1.5; }},
        {&between, [](json& c) { c["items"][0]["estimates"][1]["used"] = "no"; }},
        {&between, [](json& c) { c["items"][0]["homogeneity"]["s_s"] = nullptr; }},
        {&between, [](json& c) { c["items"][0]["stability"].erase("stable"); }},
        {&between, [](json& c) { c["items"][0]["consensus"]["printed"]["ratio"] = 1; }},
        {&between, [](json& c) { c["items"][0]["pairs"][0]["U"] = -1; }},
        {&between, [](json& c) { c["points"][0]["signal"] = "alarm"; }},
        {&between, [](json& c) { c["points"][0]["realism"] = "good"; }},
        {&between, [](json& c) { c["points"][0]["contributes"] = 1; }},
        {&between, [](json& c) { c["points"][0]["nu"] = 0; }},
        {&between, [](json& c) { c["points"][0]["correlation"] = 1.1; }},
        {&between, [](json& c) { c["participants"][0]["p_low"] = -0.1; }},
        {&between, [](json& c) { c["vectors"][0].erase("quantities"); }},
        {&between, [](json& c) { c["youden"][0]["ellipse"][0].push_back(1); }},
        {&between, [](json& c) { c["youden"][0]["correlation"] = -1.5; }},
        {&between, [](json& c) { c["youden"][0]["points"][0].erase("first"); }},
        {&between, [](json& c) { c["shared_sources"][0]["correlation"] = 2; }},
        {&methods, [](json& c) { c["correlation"] = "guessed"; }},
        {&methods, [](json& c) { c["correlation_given"] = 1.5; }},
        {&methods, [](json& c) { c["tolerance"] = -1; }},
        {&methods, [](json& c) { c["summary"]["up"]["verdict"] = "passed"; }},
        {&methods, [](json& c) { c["summary"]["up"]["p_high"] = 2; }},
        {&methods, [](json& c) { c["summary"]["up"]["bias"]["against"] = "time"; }},
        {&methods, [](json& c) { c["summary"]["up"]["bias"].erase("slope"); }},
        {&methods, [](json& c) { c["summary"]["up"]["printed"]["D_fail"] = 1.3; }},
    };
    for (std::size_t i = 0; i < breaks.size(); ++i) {
        json broken = *breaks[i].first;
        breaks[i].second(broken["comparison"]);
        EXPECT_FALSE(accepts(broken)) << "break " << i;
        EXPECT_THROW(static_cast<void>(record_from_json(broken.dump(), "x")), gum::InputError) << "break " << i;
    }
}

TEST_F(RecordSchema, RefusesWhatTheReaderRefuses) {
    const json whole = json::parse(to_canonical_json(test::sample_record()));
    const std::vector<std::function<void(json&)>> breaks = {
        [](json& r) { r["schema"] = "gumcert/record/2"; },
        [](json& r) { r.erase("software"); },
        [](json& r) { r["extra"] = 1; },
        [](json& r) { r["audit"] = json::array(); },
        [](json& r) { r["results"]["O_y"]["U"] = "0.3"; },
        [](json& r) { r["results"]["O_y"].erase("order"); },
        [](json& r) { r["rotary"]["axis"] = "D"; },
        [](json& r) { r["rotary"]["set_up"]["O_um"].push_back(1); },
        [](json& r) { r["rotary"]["errors"][0].erase("EXA"); },
        [](json& r) { r["rotary"]["errors"][0]["EXA"]["k"] = 0; },
        [](json& r) { r["rotary"]["errors"][0]["EXA"]["printed"].erase("U"); },
        [](json& r) { r["rotary"]["adjustment"]["variance_factor"]["used"] = "both"; },
        [](json& r) { r["rotary"]["adjustment"]["p_value"] = 1.5; },
        [](json& r) { r["rotary"]["reliability"][1]["flagged"] = 1; },
        [](json& r) { r["rotary"]["iso230_2"]["M"] = "6.1"; },
        [](json& r) { r["rotary"]["iso230_2"]["U"]["M"] = -0.22; },
        [](json& r) { r["rotary"]["iso230_2"]["unit"] = "um"; },
        [](json& r) { r["rotary"]["iso230_2"]["parameters"][0]["name"] = "P"; },
        [](json& r) { r["rotary"]["iso230_2"]["parameters"][0].erase("monte_carlo"); },
        [](json& r) { r["rotary"]["iso230_2"]["targets"][0]["s_up"] = -1; },
        [](json& r) { r["rotary"]["axis_line"][0]["unit"] = "mm"; },
        [](json& r) { r["rotary"]["errors"][0]["EXA"]["monte_carlo"]["u"] = -1; },
        [](json& r) { r["rotary"]["ranges"][0]["u"] = -1; },
        [](json& r) { r["rotary"]["stations"][0]["covariance_mm2"][0].push_back(0); },
        [](json& r) { r["rotary"]["reflectors"][0]["u_cmm_mm"][0] = -1; },
        [](json& r) { r["rotary"]["adjustment"]["global_test"].erase("meaning"); },
        [](json& r) { r["rotary"]["variance_components"][0]["used"] = "yes"; },
        [](json& r) { r["rotary"]["flagged"][0]["reason"] = nullptr; },
        [](json& r) { r["rotary"]["fixture_reliability"][0]["coordinate"] = "w"; },
        [](json& r) { r["rotary"]["external_reliability"][0]["extra"] = 1; },
        [](json& r) { r["rotary"]["monte_carlo"]["trials"] = 0; },
        [](json& r) { r["rotary"]["fixture_budget"]["method"] = "guess"; },
        [](json& r) { r["comparison"]["summary"]["x"] = 1; },
        [](json& r) { r["comparison"]["summary"]["x"]["order"] = -1; },
        [](json& r) { r["comparison"]["form"] = "proficiency"; },
        [](json& r) { r["comparison"]["points"][0]["U_D"] = -1; },
        [](json& r) { r["diagnostics"][0]["severity"] = "fatal"; },
    };
    for (std::size_t i = 0; i < breaks.size(); ++i) {
        json broken = whole;
        breaks[i](broken);
        EXPECT_FALSE(accepts(broken)) << "break " << i;
        EXPECT_THROW(static_cast<void>(record_from_json(broken.dump(), "x")), gum::InputError) << "break " << i;
    }
}

/// Calls judge(place, record) for records that differ from a sound one in one value, once for each kind of place: a key is
/// missing, a key is unknown, a value is of another type, a number is negative or no whole one above 1, a text is another.
void spoil(json& record, const std::string& pointer, std::set<std::string>& seen, const std::string& pattern,
           const std::function<void(const std::string&, const json&)>& judge) {
    const json::json_pointer at(pointer);
    const json sound = record.at(at);
    const auto replace = [&](const char* what, const json& value) {
        record.at(at) = value;
        judge(pattern + what, record);
        record.at(at) = sound;
    };
    if (seen.insert(pattern).second) {
        replace(" of another type", sound.is_object() || sound.is_null() ? json(true) : json::object());
        if (sound.is_number()) {
            replace(" negative", -1);
            replace(" as 1.5", 1.5);
        } else if (sound.is_string()) {
            replace(" another text", "unheard of");
        } else if (sound.is_object()) {
            json more = sound;
            more["unheard_of"] = 1;
            replace(" with an unknown key", more);
        }
    }
    if (!sound.is_structured()) {
        return;
    }
    for (const auto& [key, value] : sound.items()) {
        const bool any_key = sound.is_array() || pattern == "/results" || pattern == "/comparison/summary";
        const std::string child = pattern + "/" + (any_key ? "*" : key);
        if (sound.is_object() && seen.insert(child + " missing").second) {
            json less = sound;
            less.erase(key);
            replace((child.substr(pattern.size()) + " missing").c_str(), less);
        }
        spoil(record, pointer + "/" + key, seen, child, judge);
    }
}

TEST_F(RecordSchema, AgreesWithTheReader) {
    std::set<std::string> seen;
    std::size_t refused = 0;
    for (const std::string& text : test::fuzz_corpus("record")) {
        json record = json::parse(text);
        record.erase("digest");  // it would refuse every change
        ASSERT_TRUE(accepts(record)) << messages_;
        spoil(record, "", seen, "", [&](const std::string& place, const json& spoilt) {
            const std::string by_reader = test::record_refusal(spoilt.dump());
            if (!accepts(spoilt)) {
                ++refused;
                EXPECT_NE(by_reader, "accepted") << place << ": " << messages_;
                return;
            }
            // What several values must be together is no matter of a schema.
            const bool of_several =
                place.starts_with("/rotary/budget_sources") || place.starts_with("/rotary/budget/*/shares") ||
                place.starts_with("/rotary/iso230_2/") || place.find("/order ") != std::string::npos;
            for (const char* code : {"GC-RECORD-0013", "GC-RECORD-0014", "GC-RECORD-0015", "GC-RECORD-0016"}) {
                EXPECT_TRUE(of_several || by_reader.find(code) == std::string::npos) << place << ": " << by_reader;
            }
        });
    }
    EXPECT_GT(refused, 3000U);
}

}  // namespace
}  // namespace gumcert::reports
