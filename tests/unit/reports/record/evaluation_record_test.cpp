#include "reports/record/evaluation_record.h"

#include "encoding/sha2.h"

#include "json/canonical_json.h"
#include "reports/record/record_rules.h"
#include "tests/support/record_refusal.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_record.h"
#include "text/utf8.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace gumcert::reports {
namespace {

using gumcert::json::canonical_json;
using nlohmann::json;
using test::record_refusal;
using ::testing::HasSubstr;

json sample_json() {
    return json::parse(to_canonical_json(test::sample_record()));
}

TEST(EvaluationRecord, ReadsBackToTheSameBytes) {
    const std::string text = to_canonical_json(test::sample_record());
    const EvaluationRecord again = record_from_json(text, "record.json");
    EXPECT_EQ(to_canonical_json(again), text);
    EXPECT_EQ(again.results.front().name, "O_y");  // order of documents, not of names
    EXPECT_EQ(again.rotary->errors[7].errors[3].value, test::sample_record().rotary->errors[7].errors[3].value);
    EXPECT_FALSE(again.results[1].nu_eff.has_value());
    EXPECT_EQ(again.diagnostics, test::sample_record().diagnostics);
}

TEST(EvaluationRecord, HoldsTheKeysOfTheContract) {
    const json r = sample_json();
    EXPECT_EQ(r["schema"], "gumcert/record/1");
    EXPECT_TRUE(r["audit"].is_null());
    EXPECT_EQ(r["job"]["document"]["kind"], "rotary_table");
    EXPECT_EQ(r["job"]["files"][1]["name"], "lengths.csv");
    EXPECT_EQ(r["results"]["O_y"]["order"], 0);
    EXPECT_TRUE(r["results"]["A_first_by_name"]["nu_eff"].is_null());
    EXPECT_EQ(r["rotary"]["set_up"]["O_um"][1], 59.43);
    EXPECT_EQ(r["rotary"]["axis_in_fixture"]["O_um"][1], -59.43);
    EXPECT_EQ(r["rotary"]["errors"].size(), 36U);
    for (const char* name : {"EXA", "EYA", "EZA", "EAA", "EBA", "ECA"}) {
        for (const char* key : {"value", "u", "U", "k", "nu_eff"}) {
            EXPECT_TRUE(r["rotary"]["errors"][35][name].contains(key)) << name << key;
        }
    }
    for (const char* key : {"observations", "parameters", "degrees_of_freedom", "chi_square", "p_value",
                            "condition_number", "iterations"}) {
        EXPECT_TRUE(r["rotary"]["adjustment"].contains(key)) << key;
    }
    EXPECT_EQ(r["rotary"]["adjustment"]["variance_factor"]["used"], "a_priori");
    EXPECT_EQ(r["rotary"]["budget"][0]["shares"]["table repeatability"], 0.88);
    EXPECT_TRUE(r["rotary"]["budget"].back()["angle_deg"].is_null());
    EXPECT_EQ(r["rotary"]["covariance"]["file"], "covariance.csv");
    EXPECT_EQ(r["rotary"]["reliability"][14]["flagged"], true);
    EXPECT_EQ(r["comparison"]["summary"]["all"]["points"], 108);
    EXPECT_EQ(r["comparison"]["points"][0]["printed"]["En"], test::sample_record().comparison->points[0].En.text);
}

TEST(EvaluationRecord, PositioningHasTheFormOfTheContract) {
    const json p = sample_json()["rotary"]["iso230_2"];
    EXPECT_EQ(p["unit"], "arcsec");
    for (const char* name : {"M", "E", "E_up", "E_down", "R", "R_up", "R_down", "B", "B_mean", "A", "A_up", "A_down"}) {
        EXPECT_TRUE(p[name].is_number()) << name;
        EXPECT_EQ(p["U"][name], 0.22) << name;
    }
    EXPECT_EQ(p["M"], 6.1);
    EXPECT_EQ(p["parameters"][0]["name"], "M");
    EXPECT_EQ(p["targets"][2]["mean_down"], 2.0 * std::sin(1.0) - 0.61);

    EvaluationRecord one_direction = test::sample_record();
    PositioningAccuracy& up = *one_direction.rotary->iso230_2;
    std::erase_if(up.parameters, [](const TableParameter& x) { return !x.name.ends_with("_up"); });
    up.runs_down = 0;
    up.targets[0].mean_down.number.reset();
    const std::string text = to_canonical_json(one_direction);
    const json few = json::parse(text)["rotary"]["iso230_2"];
    EXPECT_FALSE(few.contains("M"));
    EXPECT_FALSE(few["U"].contains("E_down"));
    EXPECT_TRUE(few.contains("R_up"));
    EXPECT_TRUE(few["targets"][0]["mean_down"].is_null());
    EXPECT_EQ(to_canonical_json(record_from_json(text, "x")), text);
}

TEST(EvaluationRecord, HoldsWhatTheAdjustmentSaysInDepth) {
    const json r = sample_json()["rotary"];
    EXPECT_EQ(r["errors"][3]["EXA"]["monte_carlo"]["validation"]["validated"], false);
    EXPECT_EQ(r["errors"][3]["EYA"]["monte_carlo"]["validation"]["validated"], true);
    EXPECT_EQ(r["ranges"][0]["monte_carlo"]["trials"], 100000);
    EXPECT_EQ(r["stations"][0]["covariance_mm2"][1][2], 0.2e-6);
    EXPECT_EQ(r["reflectors"][5]["u_cmm_mm"][0], 0.0004 + 6e-6);
    EXPECT_EQ(r["reflectors"][5]["printed"]["U_cmm"][2], "0.0008");
    EXPECT_EQ(r["adjustment"]["global_test"]["printed"]["upper"], "1137.5");
    EXPECT_EQ(r["adjustment"]["variance_factor"]["reason"].get<std::string>().substr(0, 23), "The variance components");
    EXPECT_EQ(r["variance_components"][0]["stated"], 0.05);
    EXPECT_TRUE(r["variance_components"][1]["stated"].is_null());
    EXPECT_EQ(r["variance_components"][3]["used"], false);
    EXPECT_EQ(r["flagged"][0]["found_with"], "58.7 (3.89)");
    EXPECT_EQ(r["fixture_reliability"][4]["coordinate"], "y");
    EXPECT_EQ(r["external_reliability"].size(), 220U);
    EXPECT_EQ(r["axis_line"][3]["name"], "axis_c");
    EXPECT_EQ(r["monte_carlo"]["not_validated"], json({"EXA(30)", "EBA range", "axis_b"}));
    EXPECT_EQ(r["fixture_budget"]["largest"][0]["u"], 0.24);
}

/// A record as the first release wrote it: without the keys that came later.
json of_the_first_release() {
    json r = sample_json();
    json& rotary = r["rotary"];
    for (const char* key :
         {"fixture_reliability", "external_reliability", "axis_line", "iso230_2", "monte_carlo", "fixture_budget"}) {
        rotary.erase(key);
    }
    for (json& row : rotary["errors"]) {
        for (json& item : row) {
            if (item.is_object()) {
                item.erase("monte_carlo");
            }
        }
    }
    for (const char* list : {"reversal", "ranges"}) {
        for (json& item : rotary[list]) {
            item.erase("monte_carlo");
        }
    }
    for (json& item : rotary["ranges"]) {
        item.erase("u");
    }
    for (json& item : rotary["stations"]) {
        item.erase("covariance_mm2");
    }
    for (json& item : rotary["reflectors"]) {
        for (const char* key : {"home_position_mm", "covariance_mm2", "cmm_mm", "u_cmm_mm"}) {
            item.erase(key);
        }
        item["printed"].erase("cmm");
        item["printed"].erase("U_cmm");
    }
    rotary["adjustment"].erase("global_test");
    rotary["adjustment"]["variance_factor"].erase("reason");
    for (json& item : rotary["variance_components"]) {
        for (const char* key : {"stated", "degrees_of_freedom", "used", "printed_stated"}) {
            item.erase(key);
        }
    }
    for (json& item : rotary["flagged"]) {
        for (const char* key : {"estimated_error_um", "found_with", "reason"}) {
            item.erase(key);
        }
    }
    r.erase("digest");
    return r;
}

TEST(EvaluationRecord, StatesTheDigestOfItsOwnContents) {
    const std::string text = to_canonical_json(test::sample_record());
    json without = json::parse(text);
    EXPECT_EQ(without["digest"]["algorithm"], "SHA-256");
    const std::string digest = without["digest"]["value"];
    EXPECT_EQ(record_from_json(text, "x").digest, digest);
    without.erase("digest");
    EXPECT_EQ(encoding::sha256(canonical_json(without)), digest);
    EXPECT_EQ(with_digest(without), text);
    EXPECT_EQ(with_digest(json::parse(text)), text);
    EXPECT_EQ(canonical_json(json::parse(text)), text);
    for (const json& other : {json{{"a", 1}}, json{{"z", 1}}, json{{"a", "\n \"z\": 1"}, {"z", {{"z", 1}}}}}) {
        const std::string closed = with_digest(other);
        EXPECT_EQ(canonical_json(json::parse(closed)), closed);
        EXPECT_EQ(json::parse(closed)["digest"]["value"], encoding::sha256(canonical_json(other)));
    }
    EXPECT_EQ(record_from_json(canonical_json(without), "x").digest, "");  // records of earlier releases
    // How it is laid out does not matter, and what it says does.
    EXPECT_EQ(record_refusal(json::parse(text).dump(4)), "accepted");
    json changed = json::parse(text);
    changed["title"] = "Another";
    EXPECT_THAT(record_refusal(changed.dump()), HasSubstr("GC-RECORD-0021 record.json#/digest"));
    EXPECT_EQ(record_refusal(with_digest(changed)), "accepted");
    changed = json::parse(text);
    changed["digest"]["value"] = std::string(64, '0');
    EXPECT_THAT(record_refusal(changed.dump()), HasSubstr(std::string(64, '0')));
    changed["digest"]["value"] = "";
    EXPECT_THAT(record_refusal(changed.dump()), HasSubstr("GC-RECORD-0016 record.json#/digest/value"));
    changed["digest"] = "none";
    EXPECT_THAT(record_refusal(changed.dump()), HasSubstr("GC-RECORD-0015 record.json#/digest"));
}

TEST(EvaluationRecord, NoTextHoldsNul) {
    json record = json::parse(to_canonical_json(test::sample_record()));
    record["title"] = std::string("a\0b", 3);
    EXPECT_THAT(record_refusal(with_digest(record)), HasSubstr("GC-RECORD-0016 record.json#/title"));
}

TEST(EvaluationRecord, HoldsTheFilesOfItsJob) {
    for (const std::string& bytes : {std::string(), std::string("a,b\n1,2\n"), std::string("\xEF\xBB\xBF°C\r\n"),
                                     std::string("\x89PNG\r\n\x1A\n"), std::string("a\0b", 3)}) {
        EvaluationRecord record = test::sample_record();
        record.job_files.push_back(input_file("x", bytes, true));
        const EvaluationRecord again = record_from_json(to_canonical_json(record), "x");
        EXPECT_EQ(bytes_of(again.job_files.back()), bytes);
        EXPECT_EQ(again.job_files.back().sha256, encoding::sha256(bytes));
    }
    EXPECT_EQ(input_file("x", "°", true).encoding, "utf-8");
    EXPECT_EQ(input_file("x", "\xFF", true).encoding, "base64");
    EXPECT_EQ(bytes_of(input_file("x", "a", false)), std::nullopt);
    EXPECT_EQ(input_file("x", "a", false).sha256, encoding::sha256("a"));
}

TEST(EvaluationRecord, ARotaryRecordOfTheFirstReleaseIsRead) {
    const json old = of_the_first_release();
    EXPECT_EQ(record_refusal(old.dump()), "accepted");
    const EvaluationRecord r = record_from_json(old.dump(), "x");
    EXPECT_FALSE(r.rotary->iso230_2.has_value());
    EXPECT_TRUE(r.rotary->variance_components[0].used);
    EXPECT_TRUE(r.rotary->reflectors[0].printed_cmm.empty());
    // What it said is said again, unchanged, beside the keys that came later.
    const json again = json::parse(to_canonical_json(r));
    const json patch = json::diff(old, again);
    for (const json& step : patch) {
        EXPECT_EQ(step["op"], "add") << step.dump();
    }
}

TEST(EvaluationRecord, LocationErrorsWithoutAMachineAreTheAxisInTheFixture) {
    json old = sample_json();
    old["rotary"]["location_errors"] = old["rotary"]["axis_line"];
    old["rotary"].erase("axis_line");
    old["rotary"]["location_errors"][0]["name"] = "EY0A";
    old.erase("digest");
    const EvaluationRecord r = record_from_json(old.dump(), "x");
    EXPECT_TRUE(r.rotary->location_errors.empty());
    ASSERT_EQ(r.rotary->axis_line.size(), 4U);
    EXPECT_EQ(r.rotary->axis_line[0].name, "EY0A");
}

TEST(EvaluationRecord, RefusesPartsOfTheRotaryTableThatDoNotFit) {
    const auto refused = [](const std::function<void(json&)>& alter) {
        json r = sample_json();
        alter(r["rotary"]);
        return record_refusal(r.dump());
    };
    EXPECT_THAT(refused([](json& r) { r["iso230_2"]["M"] = 6.2; }),
                HasSubstr("GC-RECORD-0016 record.json#/rotary/iso230_2/M — 6.2 — must be 6.1, as the parameter"));
    EXPECT_THAT(refused([](json& r) { r["iso230_2"].erase("M"); }), HasSubstr("/rotary/iso230_2/M — missing"));
    EXPECT_THAT(refused([](json& r) { r["iso230_2"]["U"].erase("R_up"); }), HasSubstr("/iso230_2/U/R_up — missing"));
    EXPECT_THAT(refused([](json& r) { r["iso230_2"]["U"]["X"] = 1; }), HasSubstr("/iso230_2/U/X — unknown key"));
    EXPECT_THAT(refused([](json& r) { r["iso230_2"]["parameters"].erase(0); }), HasSubstr("/iso230_2/M — unknown key"));
    EXPECT_THAT(refused([](json& r) {
                    r["iso230_2"]["parameters"][0]["name"] = "P";
                    r["iso230_2"]["P"] = r["iso230_2"]["M"];
                    r["iso230_2"]["U"]["P"] = r["iso230_2"]["U"]["M"];
                    r["iso230_2"].erase("M");
                    r["iso230_2"]["U"].erase("M");
                }),
                HasSubstr("/iso230_2/parameters/0/name — \"P\" — must be a parameter of ISO 230-2"));
    EXPECT_THAT(refused([](json& r) { r["axis_line"][1]["name"] = "axis_y"; }),
                HasSubstr("/axis_line/1/name — \"axis_y\" — a parameter is listed once"));
    EXPECT_THAT(refused([](json& r) { r["stations"][0]["covariance_mm2"][0][1] = 1; }),
                HasSubstr("/stations/0/covariance_mm2/0/1"));
    EXPECT_THAT(refused([](json& r) { r["stations"][0]["covariance_mm2"].erase(2); }),
                HasSubstr("/stations/0/covariance_mm2 — 2 items — must be 3"));
    EXPECT_THAT(refused([](json& r) { r["reflectors"][0]["printed"]["cmm"].erase(2); }),
                HasSubstr("/reflectors/0/printed/cmm — 2 items"));
    EXPECT_THAT(refused([](json& r) { r["adjustment"]["global_test"]["lower"] = 2000; }),
                HasSubstr("/adjustment/global_test/lower"));
    EXPECT_THAT(refused([](json& r) { r["monte_carlo"]["validated"] = 239; }), HasSubstr("/monte_carlo/validated"));
    EXPECT_THAT(refused([](json& r) { r["errors"][2]["EXA"]["monte_carlo"]["shortest"][0] = 1e6; }),
                HasSubstr("/rotary/errors/2/EXA/monte_carlo/shortest"));
    EXPECT_THAT(refused([](json& r) { r["fixture_budget"]["method"] = "guess"; }), HasSubstr("/fixture_budget/method"));
    EXPECT_THAT(refused([](json& r) { r["fixture_reliability"][0]["coordinate"] = "w"; }),
                HasSubstr("/fixture_reliability/0/coordinate"));
    EXPECT_THAT(refused([](json& r) { r["external_reliability"][0].erase("ratio_to_U"); }),
                HasSubstr("/external_reliability/0/ratio_to_U — missing"));
}

TEST(EvaluationRecord, NumbersThatAreNotFiniteNeverReachAText) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EvaluationRecord r = test::sample_record();
        r.rotary->errors[3].errors[2].U = bad;
        try {
            static_cast<void>(to_canonical_json(r));
            FAIL() << "accepted " << bad;
        } catch (const gum::NoResultError& e) {
            EXPECT_EQ(e.diagnostics().front().code, "GC-RECORD-0001");
            EXPECT_EQ(e.diagnostics().front().where, "record#/rotary/errors/3/EZA/U");
        }
    }
}

TEST(EvaluationRecord, WriterRefusesWhatTheReaderWouldRefuse) {
    EvaluationRecord r = test::sample_record();
    r.results[1].name = r.results[0].name;
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
    r = test::sample_record();
    r.rotary->error_names[0] = "EXC";
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
    r = test::sample_record();
    r.rotary->budget[4].shares.pop_back();
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
    r = test::sample_record();
    r.rotary->errors[0].errors[0].u = -1e-9;
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
    r = test::sample_record();
    r.title = "bad \xC3( bytes";
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
    r = test::sample_record();
    r.job_json = "{\"a\": ";
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
}

TEST(EvaluationRecord, ReportsEveryProblemWithItsPointer) {
    json r = sample_json();
    r["rotary"]["errors"][5].erase("EBA");
    r["rotary"]["errors"][6]["EXA"]["U"] = "0.4";
    r["rotary"]["set_up"]["O_um"] = {1, 2};
    r["rotary"]["adjustment"]["observations"] = 12.5;
    r["rotary"]["datum"] = "elsewhere";
    r["rotary"]["a~b/c"] = 1;
    r["results"]["O_y"]["u"] = -0.1;
    r["comparison"]["points"][2]["En"] = "0.4";
    r["audit"] = json::array();
    const std::string all = record_refusal(r.dump());
    EXPECT_THAT(all, HasSubstr("GC-RECORD-0013 record.json#/rotary/errors/5/EBA — missing"));
    EXPECT_THAT(all, HasSubstr("GC-RECORD-0015 record.json#/rotary/errors/6/EXA/U — string — must be a number"));
    EXPECT_THAT(all, HasSubstr("GC-RECORD-0017 record.json#/rotary/set_up/O_um — 2 items — must be 3"));
    EXPECT_THAT(all, HasSubstr("record.json#/rotary/adjustment/observations — number — must be a whole number"));
    EXPECT_THAT(all, HasSubstr("GC-RECORD-0016 record.json#/rotary/datum — \"elsewhere\""));
    EXPECT_THAT(all, HasSubstr("GC-RECORD-0014 record.json#/rotary/a~0b~1c — unknown key"));
    EXPECT_THAT(all, HasSubstr("record.json#/results/O_y/u — -0.1 — must be 0 or greater"));
    EXPECT_THAT(all, HasSubstr("record.json#/comparison/points/2/En — string — must be a number"));
    EXPECT_THAT(all, HasSubstr("record.json#/audit — array"));
}

TEST(EvaluationRecord, RefusesAnotherSchemaBeforeAnythingElse) {
    EXPECT_THAT(record_refusal(R"({"schema": "gumcert/record/2", "x": 1})"),
                HasSubstr("GC-RECORD-0020 record.json#/schema — \"gumcert/record/2\""));
    EXPECT_THAT(record_refusal("{}"), HasSubstr("GC-RECORD-0020"));
    EXPECT_THAT(record_refusal("[1]"), HasSubstr("GC-RECORD-0015"));
}

TEST(EvaluationRecord, RefusesTextsThatAreNotStrictJson) {
    EXPECT_THAT(record_refusal(""), HasSubstr("GC-RECORD-0011"));
    EXPECT_THAT(record_refusal(R"({"schema": )"), HasSubstr("GC-RECORD-0011"));
    EXPECT_THAT(record_refusal(R"({"a": 1e999})"), HasSubstr("GC-RECORD-0011"));
    EXPECT_THAT(record_refusal(R"({"a": NaN})"), HasSubstr("GC-RECORD-0011"));
    EXPECT_THAT(record_refusal(R"({"a": 1} trailing)"), HasSubstr("GC-RECORD-0011"));
    EXPECT_THAT(record_refusal("{\"a\": \"\xC3(\"}"), HasSubstr("GC-RECORD-0011"));
    EXPECT_THAT(record_refusal(R"({"b": {"a": 1, "a": 2}, "b": 3})"), HasSubstr("GC-RECORD-0012 record.json#/b/a"));
    EXPECT_THAT(record_refusal(std::string(100'000, '[')), HasSubstr("nested deeper than 64 levels"));
    std::string inside = "/a~0";
    for (int i = 0; i < 62; ++i) {
        inside += "/0";
    }
    EXPECT_THAT(record_refusal(R"({"a~": )" + std::string(64, '[')),
                HasSubstr("GC-RECORD-0018 record.json#" + inside + " — nested deeper than 64 levels"));
    EXPECT_THAT(record_refusal("{\"schema\": \"a\",\n \"b\": }"),
                HasSubstr("GC-RECORD-0011 record.json#/b — parse error at line 2, column 7: \"}\" where a value is "
                          "expected — a record is one JSON value in UTF-8, byte 23 breaks it — take the record"));
    EXPECT_THAT(record_refusal(R"({"a": 1e-999})"), HasSubstr("GC-RECORD-0011"));
    EXPECT_THAT(record_refusal(R"({} // a comment)"), HasSubstr("GC-RECORD-0011"));
    EXPECT_THAT(record_refusal(R"({"a": ["\u0000"]})"),
                HasSubstr("GC-RECORD-0016 record.json#/a/0 — a text with a NUL character (\\u0000)"));
    EXPECT_THAT(record_refusal(std::string(k_max_record_bytes + 1, ' ')), HasSubstr("GC-RECORD-0010"));
}

TEST(EvaluationRecord, RefusesAWholeNumberThatADoubleWouldChange) {
    json r = sample_json();
    r["rotary"]["errors"][0]["angle_deg"] = 9007199254740995;
    EXPECT_THAT(record_refusal(r.dump()),
                HasSubstr("GC-RECORD-0016 record.json#/rotary/errors/0/angle_deg — 9007199254740995 — must be a number "
                          "that a double holds exactly"));
}

TEST(EvaluationRecord, ListsAtMostTwoHundredProblems) {
    json r = sample_json();
    for (json& row : r["rotary"]["errors"]) {
        row = {{"unknown", 1}};
    }
    const std::string all = record_refusal(r.dump());
    EXPECT_THAT(all, HasSubstr("GC-RECORD-0019"));
    EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 201);
}

TEST(EvaluationRecord, OptionalPartsMayBeNull) {
    EvaluationRecord r = test::sample_record();
    r.rotary.reset();
    r.comparison.reset();
    r.kind = "budget";
    const std::string text = to_canonical_json(r);
    EXPECT_EQ(to_canonical_json(record_from_json(text, "x")), text);
}

TEST(BudgetRecord, ReadsBackToTheSameBytes) {
    for (const EvaluationRecord& r :
         {test::sample_budget_record(), test::sample_two_results_record(), test::sample_points_record(3)}) {
        const std::string text = to_canonical_json(r);
        EXPECT_EQ(to_canonical_json(record_from_json(text, "record.json")), text);
    }
    const EvaluationRecord again = record_from_json(to_canonical_json(test::sample_budget_record()), "x");
    EXPECT_EQ(again.results[0].budget[1].components[2].u.text, "6.7");
    EXPECT_EQ(again.results[0].monte_carlo->histogram, test::sample_budget_record().results[0].monte_carlo->histogram);
    EXPECT_EQ(again.results[0].monte_carlo->numerical_error.shortest[1], 0.55);
}

TEST(BudgetRecord, HoldsTheKeysOfTheContract) {
    const json one = json::parse(to_canonical_json(test::sample_budget_record()));
    const json& l = one["results"]["l"];
    EXPECT_EQ(l["second_order"]["u"], 33.8);
    EXPECT_EQ(l["monte_carlo"]["trials"], 1000000);
    EXPECT_EQ(l["monte_carlo"]["symmetric"][0], 50000745.2);
    for (const char* key : {"mean", "u", "symmetric", "shortest"}) {
        EXPECT_TRUE(l["monte_carlo"]["numerical_error"].contains(key)) << key;
        EXPECT_TRUE(l["monte_carlo"].contains(key)) << key;
    }
    for (const char* key : {"delta", "d_low", "d_high", "validated"}) {
        EXPECT_TRUE(l["monte_carlo"]["validation"].contains(key)) << key;
    }
    EXPECT_EQ(l["budget"][1]["components"][0]["input"], "repeatability");
    EXPECT_TRUE(one["covariance"].is_null());
    EXPECT_TRUE(one["region"].is_null());
    const json two = json::parse(to_canonical_json(test::sample_two_results_record()));
    EXPECT_TRUE(two["results"]["X"]["k"].is_null());
    EXPECT_TRUE(two["results"]["X"]["U"].is_null());
    EXPECT_TRUE(two["results"]["R"]["second_order"].is_null());
    EXPECT_TRUE(two["results"]["R"]["monte_carlo"].is_null());
    EXPECT_EQ(two["covariance"]["names"], json({"R", "X"}));
    EXPECT_EQ(two["covariance"]["correlation"][0][1], -0.588);
    EXPECT_EQ(two["covariance"]["matrix"][1][1], 0.08738);
    EXPECT_EQ(two["region"]["ellipsoid"]["k_p"], 2.486);
    EXPECT_EQ(two["region"]["parallelepiped"]["k_q"], 2.211);
    EXPECT_EQ(two["region"]["smallest_region"]["cells"], 512);
    EXPECT_EQ(two["fits"][0]["data"]["x"].size(), 11U);
    EXPECT_EQ(two["readings"][1]["component"], "repeatability");
    EXPECT_EQ(two["variance_analyses"][0]["printed"]["mean_square"][1], "7.2E-9");
    EXPECT_EQ(two["model"]["unknowns"][0], "X");
}

TEST(BudgetRecord, ARecordFromBeforeTheseKeysIsRead) {
    json r = sample_json();
    for (const char* key : {"model", "covariance", "region", "fits", "readings", "variance_analyses", "digest"}) {
        r.erase(key);
    }
    for (json& result : r["results"]) {
        for (const char* key :
             {"coverage", "coverage_note", "correlation", "quantity", "point", "second_order", "monte_carlo"}) {
            result.erase(key);
        }
    }
    for (json& row : r["comparison"]["reference_budget"]) {
        row.erase("components");
        for (const char* key : {"value", "nu", "sensitivity"}) {
            row["printed"].erase(key);
        }
    }
    EXPECT_EQ(record_refusal(r.dump()), "accepted");
}

TEST(BudgetRecord, RefusesPartsThatDoNotFitTogether) {
    const auto refused = [](const std::function<void(json&)>& alter) {
        json r = json::parse(to_canonical_json(test::sample_two_results_record()));
        alter(r);
        return record_refusal(r.dump());
    };
    EXPECT_THAT(refused([](json& r) { r["covariance"]["matrix"][1].erase(0); }),
                HasSubstr("GC-RECORD-0017 record.json#/covariance/matrix/1 — 1 items — must be 2, one a name"));
    EXPECT_THAT(refused([](json& r) { r["covariance"]["correlation"][0][1] = 0.5; }),
                HasSubstr("record.json#/covariance/correlation/1/0 — -0.588 — a covariance or correlation matrix is "
                          "symmetric"));
    EXPECT_THAT(refused([](json& r) { r["covariance"]["names"][0] = "Z"; }),
                HasSubstr("/covariance/names/0 — \"Z\" — must be the name of a result"));
    EXPECT_THAT(refused([](json& r) { r["covariance"]["units"].push_back("V"); }), HasSubstr("/covariance/units"));
    EXPECT_THAT(refused([](json& r) { r["covariance"]["file"] = "c.csv"; }),
                HasSubstr("because the matrix is in a file"));
    EXPECT_THAT(refused([](json& r) { r["covariance"]["printed"]["correlation"].clear(); }),
                HasSubstr("/covariance/printed/correlation"));
    EXPECT_THAT(refused([](json& r) { r["fits"][0]["data"]["x"].erase(3); }), HasSubstr("/fits/0/data/x — 10 items"));
    EXPECT_THAT(refused([](json& r) { r["fits"][0]["data"]["residual"].clear(); }), HasSubstr("/fits/0/data/residual"));
    EXPECT_THAT(refused([](json& r) { r["fits"][0]["correlation"].erase(0); }), HasSubstr("one a parameter"));
    EXPECT_THAT(refused([](json& r) { r["results"]["R"]["U"] = nullptr; }), HasSubstr("/results/R/U — not stated"));
    EXPECT_THAT(refused([](json& r) { r["results"]["X"]["U"] = 0.8; }), HasSubstr("/results/X/U — stated"));
    EXPECT_THAT(refused([](json& r) { r["results"]["X"]["k"] = 2; }), HasSubstr("/results/X/U"));
    EXPECT_THAT(refused([](json& r) { r["results"]["R"]["coverage"] = "guess"; }), HasSubstr("/results/R/coverage"));
    EXPECT_THAT(refused([](json& r) { r["region"]["ellipsoid"]["k_p"] = 0; }), HasSubstr("must be greater than 0"));
    EXPECT_THAT(refused([](json& r) { r["readings"][0]["n"] = 0; }), HasSubstr("/readings/0/n — 0"));
    const auto trials_refused = [](const std::function<void(json&)>& alter) {
        json r = json::parse(to_canonical_json(test::sample_budget_record()));
        alter(r["results"]["l"]["monte_carlo"]);
        return record_refusal(r.dump());
    };
    EXPECT_THAT(trials_refused([](json& m) { m["trials"] = 10; }),
                HasSubstr("/histogram/counts — more than the trials"));
    EXPECT_THAT(trials_refused([](json& m) { m["histogram"]["counts"][0] = -1; }), HasSubstr("must be 0 or greater"));
    EXPECT_THAT(trials_refused([](json& m) { m["histogram"]["high"] = 0; }), HasSubstr("must be above the low end"));
    EXPECT_THAT(trials_refused([](json& m) { std::swap(m["shortest"][0], m["shortest"][1]); }),
                HasSubstr("the lower end of an interval is not above the upper end"));
}

TEST(BudgetRecord, WriterRefusesPartsThatDoNotFitTogether) {
    EvaluationRecord r = test::sample_two_results_record();
    r.covariance->matrix.pop_back();
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
    r = test::sample_budget_record();
    r.results[0].U.reset();
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
    r = test::sample_budget_record();
    r.results[0].monte_carlo->u.number = std::numeric_limits<double>::infinity();
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
    r = test::sample_two_results_record();
    r.fits[0].y.number.pop_back();
    EXPECT_THROW(static_cast<void>(to_canonical_json(r)), gum::NoResultError);
}

TEST(Utf8, KnowsTheForbiddenForms) {
    EXPECT_TRUE(text::is_utf8("µ″−校😀"));
    for (const char* bad : {"\x80", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8\x88\x80\x80",
                            "\xE2\x82", "\xC3("}) {
        EXPECT_FALSE(text::is_utf8(bad));
    }
}

}  // namespace
}  // namespace gumcert::reports
