#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "jobs/json_object.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "tests/support/campaign.h"
#include "tests/support/job_schema.h"

namespace gumcert::jobs {
namespace {

using nlohmann::json;
using test::Files;
using test::refusals;
using test::replace;
using test::small_campaign;

class JobSchemaTest : public gumcert::test::JobSchema {
protected:
    JobSchemaTest() : JobSchema("rotary_table") {}
};

json job_of(const Files& files) {
    return parse_json_document(files.at("job.json"), "job.json").value;
}

/// Two jobs that use every key of the schema between them, because some keys exclude each other.
Files complete_campaign(bool with_budget = false) {
    Files files = small_campaign();
    std::string& job = files["job.json"];
    replace(job, "0.05", R"(0.05, "u_proportional_um_per_m": 0.1, "resolution_um": 0.01, "scale_u": 1.5e-7,
        "scale_model": "prior")");
    replace(job, "\"coordinates\"",
            with_budget ? R"("budget": "fixture_budget.json", "coordinates")"
                        : R"("covariance": "covariance.csv", "reference_temperature_degC": 20, "uncertainty": "stated",
        "distribution": "normal", "variance_component": "estimate", "coordinates")");
    replace(job, "\"u\": 5e-7", R"("u": 5e-7, "distribution": "uniform")");
    replace(job, "\"environment\"", R"("temperature_distribution": "uniform", "environment")");
    replace(job, "{",
            with_budget
                ? R"({ "monte_carlo": {"adaptive": {"digits": 1, "max_trials": 1e7}, "digits": 1},)"
                : R"({ "coverage": "as_validated", "monte_carlo": {"trials": 1000000, "seed": 3, "validate": true},)");
    replace(
        job, "{",
        R"({ "$schema": "job-1.schema.json", "home_angle_deg": 0, "datum": "home", "method": "joint", "coverage_probability": 0.95,
        "certificate": {"customer": {}}, "notes": "n", "variance_components": "estimate", "reversal": "auto",
        "table_repeatability": {"mode": "given", "u_linear_um": 0.3, "u_axial_arcsec": 0.2, "u_tilt_arcsec": 0.1,
            "at_mm": -40},
        "outliers": {"test": "data_snooping", "alpha": 0.001, "action": "remove"},
        "exclude": [{"station": "P1", "reflector": "R1", "pass": "P1+", "direction": "+", "angle_deg": 45,
            "lines": [2, 200], "reason": "The beam was broken"}],
        "simulation": {"runs": 20, "seed": 7, "set_up_offset_um": 5, "set_up_tilt_arcsec": 10, "error_linear_um": 3,
            "error_angular_arcsec": 4, "outliers": {"count": 2, "size_um": 5}, "angle_counts": [12, 36],
            "table_repeatability": {"u_linear_um": 0.1, "u_axial_arcsec": 0, "u_tilt_arcsec": 0.3}},
        "plan": {"angles_deg": {"first": -90, "step": 30, "count": 12}, "senses": "both", "dead_paths": "reflector",
            "targets": {"linear_um": 0.5, "angular_arcsec": 0.7, "range_linear_um": 1, "range_angular_arcsec": 2,
                "location_um": 3, "location_arcsec": 4, "E_arcsec": 5, "R_arcsec": 6, "A_arcsec": 7},
            "keep_met_targets": true, "sight": {"cylinders": [{"name": "table", "radius_mm": 50,
                "along_axis_mm": [-900, -500]}], "boxes": [{"name": "bed", "x_mm": [-900, -800], "y_mm": [0, 10],
                "z_mm": [-5, 5], "turns": false}], "reflector_diameter_mm": 12, "acceptance_angle_deg": 170,
                "facing": [{"reflector": "R1", "direction": [0, 0, 1]}]}, "least_distance_mm": 300,
            "station_region": {"x_mm": [0, 1000], "y_mm": [-500, 500], "z_mm": [0, 0], "step_mm": 100}},)");
    if (with_budget) {  // location errors are those of the other datum
        replace(job, R"("datum": "home")", R"("datum": "axis_average_line", "machine_frame": {"by": "probing",
            "coordinates": "machine.csv", "nominal_point_mm": [100, 0, 0], "source": "probed"})");
        files["machine.csv"] = test::small_machine_points();
    }
    for (int i = 0; i < 12; ++i) {
        for (int j = 0; j < 12; ++j) {
            files["covariance.csv"] += (j == 0 ? "" : ",") + std::string(i != j ? "0" : i == 1 ? "0.25" : "0.16");
        }
        files["covariance.csv"] += "\n";
    }
    replace(job, "\"description\"",
            with_budget ? R"("budget": "indicator_budget.json", "correlation": 0.25, "description")"
                        : R"("correlation": "none", "published": {"source": "a paper",
        "mean_abs_En": {"x": 0.77, "y": 0.39, "z": 0.32}}, "audited": {"factor": 0.5, "finding": "f"}, "description")");
    files["dial_indicator.csv"] += "z,0.0,1,0.5\n";
    files["indicator_budget.json"] = R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["X = reading + d"],
        "inputs": {"reading": {"value": 0, "unit": "um", "constant": true}, "d": {"value": 0, "unit": "um", "u": 1}}})";
    files["fixture_budget.json"] = test::small_fixture_budget();
    files["fixture_points.csv"] = test::small_fixture_points();
    return files;
}

TEST_F(JobSchemaTest, AcceptsTheJobsOfTheSimulatedCampaigns) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "tests/reference/campaigns";
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.is_directory()) {
            EXPECT_TRUE(accepts(entry.path() / "job.json")) << entry.path();
            ++count;
        }
    }
    EXPECT_EQ(count, 5);
}

TEST_F(JobSchemaTest, AcceptsTheShippedExamples) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/rotary_table";
    for (const char* const name : {"job.json", "job_with_fixture_budget.json", "fixture_budget.json"}) {
        EXPECT_TRUE(accepts(folder / name)) << name;
    }
    EXPECT_TRUE(read_rotary_table_job(folder / "job_with_fixture_budget.json").fixture_budget);
}

TEST_F(JobSchemaTest, AcceptsOtherKindsWithAnyKeys) {
    EXPECT_TRUE(
        accepts(json::parse(R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["y = a"], "inputs": {}})")));
    EXPECT_TRUE(accepts(json::parse(R"({"schema": "gumcert/job/1", "kind": "comparison", "participants": []})")));
    EXPECT_FALSE(accepts(json::parse(R"({"schema": "gumcert/job/1", "kind": "table"})")));
    EXPECT_FALSE(accepts(json::parse(R"({"schema": "gumcert/job/2", "kind": "budget"})")));
    EXPECT_FALSE(accepts(json::parse(R"({"kind": "budget"})")));
    EXPECT_FALSE(accepts(json::parse("[]")));
}

TEST_F(JobSchemaTest, HasTheKeysOfTheReader) {
    expect_keys(rotary_table_job_keys());
    // And no object of the schema is missing in the table of the reader.
    std::size_t objects = 0;
    const auto count = [&](const auto& self, const json& node) -> void {
        if (node.contains("properties")) {
            ++objects;
            for (const auto& [key, value] : node.at("properties").items()) {
                if (key != "certificate" && key != "title") {  // have readers of their own
                    self(self, followed(value));
                }
            }
        }
        for (const json& alternative : node.value("anyOf", json::array())) {
            self(self, followed(alternative));
        }
        if (node.contains("items")) {
            self(self, followed(node.at("items")));
        }
    };
    count(count, schema_of(""));
    EXPECT_EQ(objects, rotary_table_job_keys().size());
}

TEST_F(JobSchemaTest, AgreesWithTheReaderOnEveryKey) {
    // A demand that depends on other keys is beyond this schema.
    const std::set<std::string> conditional{"/table_repeatability/u_linear_um",   "/table_repeatability/u_axial_arcsec",
                                            "/table_repeatability/u_tilt_arcsec", "/fixture/thermal_expansion_per_K",
                                            "/length_uncertainty/scale_u",        "/observations/lengths"};
    std::set<std::string> used;
    for (const bool with_budget : {false, true}) {
        const Files files = complete_campaign(with_budget);
        const json complete = job_of(files);
        ASSERT_EQ(test::texts(refusals(files)), "");
        ASSERT_TRUE(accepts(complete));
        const auto with_job = [&](const json& job) {
            Files changed = files;
            changed["job.json"] = job.dump();
            return changed;
        };
        for (const JobKeys& object : rotary_table_job_keys()) {
            // Of a list its first element stands for all.
            std::string place(object.pointer);
            if (const std::size_t star = place.find('*'); star != std::string::npos) {
                place.replace(star, 1, "0");
            }
            if (!complete.contains(json::json_pointer(place))) {
                continue;
            }
            for (const std::string_view key : object.keys) {
                const std::string pointer = place + "/" + std::string(key);
                if (!complete.contains(json::json_pointer(pointer))) {
                    continue;
                }
                used.insert(std::string(object.pointer) + "/" + std::string(key));
                // Every key is read: a value of the wrong type is refused at its place, or at that of its element.
                json wrong = complete;
                wrong[json::json_pointer(pointer)] = json::array({true});
                EXPECT_FALSE(accepts(wrong)) << pointer;
                const auto found = refusals(with_job(wrong));
                EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                        [&](const auto& d) {
                                            return d.where.find("#" + pointer + " (") != std::string::npos ||
                                                   d.where.find("#" + pointer + "/0 (") != std::string::npos;
                                        }))
                    << pointer << "\n"
                    << test::texts(found);
                if (conditional.contains(pointer)) {
                    continue;
                }
                json without = complete;
                without.at(json::json_pointer(place)).erase(std::string(key));
                EXPECT_EQ(accepts(without), refusals(with_job(without)).empty()) << pointer;
            }
            json unknown = complete;
            unknown[json::json_pointer(place + "/unheard_of")] = 1;
            EXPECT_FALSE(accepts(unknown)) << object.pointer;
            EXPECT_FALSE(refusals(with_job(unknown)).empty()) << object.pointer;
        }
    }
    for (const JobKeys& object : rotary_table_job_keys()) {
        for (const std::string_view key : object.keys) {
            const std::string pointer = std::string(object.pointer) + "/" + std::string(key);
            if (key == "laboratory") {
                continue;  // names a folder, from which a job is filled in before it is read (tests/unit/jobs/laboratory)
            }
            EXPECT_TRUE(used.contains(pointer)) << pointer << " is in neither of the complete jobs";
        }
    }
}

TEST_F(JobSchemaTest, AcceptsALayoutWithoutLengths) {
    const Files files = test::small_layout();
    EXPECT_TRUE(accepts(job_of(files)));
    EXPECT_EQ(test::texts(refusals(files, JobUse::plan)), "");
    json none = job_of(files);
    none["observations"].erase("stations");
    EXPECT_FALSE(accepts(none));
}

TEST_F(JobSchemaTest, AgreesWithTheReaderOnValues) {
    const Files files = complete_campaign();
    const json complete = job_of(files);
    const std::vector<std::pair<std::string, std::vector<std::string>>> values{
        {"/axis", {"\"A\"", "\"C\"", "\"a\"", "\"D\""}},
        {"/schema", {"\"gumcert/job/1\"", "\"gumcert/job/2\""}},
        {"/$schema", {"\"\"", "3", "null"}},
        {"/title", {"\"t\"", "\"\""}},
        {"/coverage_probability", {"0.5", "0", "1", "95", "-0.1"}},
        {"/home_angle_deg", {"90", "3601"}},
        {"/datum", {"\"home\"", "\"axis_average_line\"", "\"axis\""}},
        {"/method", {"\"joint\"", "\"sequential\"", "\"two\""}},
        {"/observations/lengths", {"\"lengths.csv\"", "\"/lengths.csv\"", "\"\"", "\"a\\\\b\"", "\"C:x.csv\""}},
        {"/length_uncertainty/u_constant_um", {"1", "0", "-1"}},
        {"/length_uncertainty/u_proportional_um_per_m", {"0", "1", "-1"}},
        {"/length_uncertainty/scale_u", {"1e-6", "0.01", "0.011", "0", "-1"}},
        {"/length_uncertainty/scale_model", {"\"fixed\"", "\"prior\"", "\"free\"", "\"none\""}},
        {"/fixture/reference_temperature_degC", {"-50", "100", "-50.5", "100.5"}},
        {"/fixture/thermal_expansion_per_K/value", {"0", "0.001", "-1e-9", "0.0011"}},
        {"/fixture/thermal_expansion_per_K/u", {"0", "0.001", "-1e-9", "0.0011"}},
        {"/table_repeatability/mode", {"\"estimate\"", "\"given\"", "\"none\"", "\"off\""}},
        {"/table_repeatability/u_linear_um", {"0", "1", "-1"}},
        {"/variance_components", {"\"estimate\"", "\"fixed\"", "\"given\""}},
        {"/outliers/test", {"\"data_snooping\"", "\"none\"", "\"grubbs\""}},
        {"/outliers/alpha", {"0.49", "0.5", "0"}},
        {"/outliers/action", {"\"report\"", "\"remove\"", "\"keep\""}},
        {"/reference_method/name", {"\"n\"", "\"\""}},
        {"/reference_method/correlation", {"-1", "0.5", "1.5", "\"unknown\"", "\"some\"", "true"}},
        {"/reference_method/published/mean_abs_En", {"{\"z\": 1}", "{}"}},
        {"/reference_method/published/mean_abs_En/x", {"0", "-1"}},
        {"/reference_method/audited/factor", {"2", "0", "1001"}},
        {"/certificate", {"{}", "1", "\"\"", "\"/certificate.json\""}},
        {"/monte_carlo/trials", {"1e6", "0", "1e11", "1000000.5"}},
        {"/length_uncertainty/resolution_um", {"0", "0.1", "-0.1"}},
        {"/observations/temperature_distribution", {"\"normal\"", "\"uniform\"", "\"triangular\""}},
        {"/fixture/thermal_expansion_per_K/distribution", {"\"normal\"", "\"uniform\"", "\"\""}},
        {"/fixture/uncertainty", {"\"stated\"", "\"paper\""}},
        {"/fixture/distribution", {"\"normal\"", "\"arcsine\""}},
        {"/fixture/variance_component", {"\"check\"", "\"given\"", "\"fixed\""}},
        {"/simulation/runs", {"1", "1e6", "0", "1.5", "1000001"}},
        {"/simulation/set_up_offset_um", {"0", "10000", "-1", "10001"}},
        {"/simulation/error_angular_arcsec", {"0", "36000", "36001"}},
        {"/simulation/outliers/count", {"0", "3", "-1", "0.5"}},
        {"/simulation/outliers/size_um", {"0.1", "0", "1e9"}},
        {"/simulation/angle_counts", {"[]", "[3]", "[2]", "[12.5]", "[36, 36001]", "12"}},
        {"/plan/angles_deg", {"[0]", "[0, 3600]", "[]", "[0, 3601]", "3", "{\"first\": 0, \"step\": 10}"}},
        {"/plan/angles_deg/step", {"10", "0", "-10"}},
        {"/plan/angles_deg/count", {"4", "0", "4.5"}},
        {"/plan/senses", {"\"one\"", "\"two\""}},
        {"/plan/dead_paths", {"\"station\"", "\"pass\""}},
        {"/plan/targets/linear_um", {"1", "0"}},
        {"/plan/station_region/x_mm", {"[0, 1]", "[0, 100001]", "[0]", "[0, 1, 2]"}},
        {"/plan/station_region/step_mm", {"50", "0", "-1"}},
        {"/plan/least_distance_mm", {"0", "-1"}},
        {"/plan/targets/E_arcsec", {"1", "0"}},
        {"/plan/targets/location_um", {"1e6", "1e7"}},
        {"/plan/sight/reflector_diameter_mm", {"38.1", "0", "1001"}},
        {"/plan/sight/acceptance_angle_deg", {"180", "0", "181"}},
        {"/plan/sight/cylinders", {"[]", "[1]", "{}"}},
        {"/plan/sight/cylinders/0/radius_mm", {"0.1", "0", "100001"}},
        {"/plan/sight/cylinders/0/along_axis_mm", {"[0, 1]", "[0]", "[0, 1e6]"}},
        {"/plan/sight/boxes/0/turns", {"true", "1"}},
        {"/plan/sight/facing/0/direction", {"[1, 1, 0]", "[1, 1]", "[0, 0, 1e7]"}}};
    for (const auto& [pointer, texts] : values) {
        bool any_refused = false;
        for (const std::string& text : texts) {
            json job = complete;
            job[json::json_pointer(pointer)] = json::parse(text);
            Files changed = files;
            changed["job.json"] = job.dump();
            const auto found = refusals(changed);
            EXPECT_EQ(accepts(job), found.empty()) << pointer << " = " << text << "\n" << test::texts(found);
            any_refused = any_refused || !found.empty();
        }
        EXPECT_TRUE(any_refused) << pointer;
    }
}

}  // namespace
}  // namespace gumcert::jobs
