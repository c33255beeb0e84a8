#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/comparison/comparison_job.h"
#include "tests/support/campaign.h"
#include "tests/support/comparison_campaign.h"
#include "tests/support/job_schema.h"

namespace gumcert::jobs {
namespace {

using nlohmann::json;
using test::k_three_laboratories;

class ComparisonSchemaTest : public gumcert::test::JobSchema {
protected:
    ComparisonSchemaTest() : JobSchema("comparison") {}
};

TEST_F(ComparisonSchemaTest, HasTheKeysOfTheReader) {
    expect_keys(comparison_job_keys());
}

TEST_F(ComparisonSchemaTest, EveryKeyIsExplainedInTheDocumentation) {
    const std::string text =
        gumcert::test::file_content(std::filesystem::path(GUMCERT_SOURCE_DIR) / "docs/comparison_job.md");
    for (const JobKeys& object : comparison_job_keys()) {
        for (const std::string_view key : object.keys) {
            EXPECT_NE(text.find("`" + std::string(key) + "`"), std::string::npos) << object.pointer << "/" << key;
        }
    }
    for (const std::string_view word : gum::k_assigned_value_words) {
        EXPECT_NE(text.find("`" + std::string(word) + "`"), std::string::npos) << word;
    }
}

TEST_F(ComparisonSchemaTest, AcceptsTheShippedExamples) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/comparison";
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".json") {
            EXPECT_TRUE(accepts(entry.path())) << entry.path();
            ++count;
        }
    }
    EXPECT_EQ(count, 5U);
}

TEST_F(ComparisonSchemaTest, AgreesWithTheReader) {
    const auto with = [](const std::string& keys) { return k_three_laboratories + ", " + keys; };
    const auto first = [](const std::string& keys) {
        return R"("assigned_value": "median", "participants": [{"id": "A", "value": 1, )" + keys +
               R"(}, {"id": "B", "value": 2, "u": 1}])";
    };
    const auto points = [](const std::string& first_point, const std::string& more = "") {
        return R"("lab": {"points": [)" + first_point +
               R"(]}, "reference": {"points": [{"point": "P", "value": 1, "u": 1}]})" + more;
    };
    const std::string point = R"({"point": "P", "value": 1, "u": 1, "position": 3})";
    const std::vector<std::pair<std::string, bool>> jobs{
        {k_three_laboratories, true},
        {R"("title": "none")", false},
        {with(R"("organiser": "o", "notes": "n", "coverage_probability": 0.95, "rounds": [1])"), true},
        {with(R"("organiser": "o", "notes": "n", "coverage_probability": 0.95, "certificate": {})"), true},
        {with(R"("$schema": "../schemas/job-1.schema.json")"), true},
        {with(R"("$schema": true)"), false},
        {with(R"("coverage_probability": 95)"), false},
        {with(R"("lab": "l.csv")"), false},
        {with(R"("tolerance": 1)"), false},
        {with(R"("unheard_of": 1)"), false},
        {with(R"("unit": 3)"), false},
        {with(R"("independent_sources": ["a", "b"])"), true},
        {with(R"("independent_sources": "a")"), false},
        {with(R"("correlations": [["A", "B", 0.5]])"), true},
        {with(R"("correlations": [["A", "B", 1.5]])"), false},
        {with(R"("correlations": [["A", "B"]])"), false},
        {with(R"("sigma_pt": 1)"), true},
        {with(R"("sigma_pt": 0)"), false},
        {with(R"("sigma_pt": "robust")"), true},
        {with(R"("sigma_pt": "horwitz")"), false},
        {with(R"("sigma_pt": {"percent": 5})"), true},
        {with(R"("sigma_pt": {"percent": 5, "mass_fraction_per_unit": 1e-6})"), false},
        {with(R"("sigma_pt": {"mass_fraction_per_unit": 2})"), false},
        {with(R"("sigma_pt": {"reproducibility": 5})"), false},
        {with(R"("sigma_pt": {"reproducibility": 5, "repeatability": 3, "replicates": 2})"), true},
        {with(R"("sigma_pt": {"reproducibility": 5, "repeatability": 3, "replicates": 0})"), false},
        {with(R"("delta_E": 1, "kernel_bandwidth": 0.1, "homogeneity": [[1, 2], [2, 1]], "stability": [[1, 2]])"),
         true},
        {with(R"("delta_E": -1)"), false},
        {with(R"("kernel_bandwidth": 0)"), false},
        {with(R"("stability": [1, 2])"), false},
        {with(R"("homogeneity": [["a", 2], [1, 2]])"), false},
        {with(R"("reference_value": {"value": 1, "u": 1})"), true},
        {with(R"("reference_value": {"value": 1, "U": 1})"), false},
        {with(R"("reference_value": {"u": 1})"), false},
        {with(R"("assigned_value": "mean")"), false},
        {with(R"("assigned_value": "reference")"), false},
        {with(R"("assigned_value": 3)"), false},
        {with(R"("assigned_value": {"value": 3})"), true},
        {with(R"("assigned_value": {"value": 3, "U": 1})"), false},
        {with(R"("assigned_value": {"value": 3, "u": 1, "sources": [{"source": "S", "u": -0.1}]})"), true},
        {with(R"("assigned_value": {"value": 3, "u": 1, "sources": [{"source": "S"}]})"), false},
        {with(R"("assigned_value": {"traceability": "t"})"), false},
        {with(R"("assigned_value": {"method": "median", "uncertainty": "trials", "trials": 1e4, "seed": 1})"), true},
        {with(R"("assigned_value": {"method": "median", "uncertainty": "trials", "trials": 10})"), false},
        {with(R"("assigned_value": {"method": "algorithm_a", "constants": "rounded"})"), false},
        {with(R"("assigned_value": {"method": "power_moderated_mean", "power": 3})"), false},
        {with(R"("assigned_value": {"method": "weighted_mean", "alpha": 0.5})"), false},
        {with(R"("items": [])"), false},
        {first(R"("u": 1)"), true},
        {first(R"("u": 1, "U": 2, "k": 2)"), false},
        {first(R"("U": 2)"), false},
        {first(R"("uncertainty": 2)"), false},
        {first(R"("u": 0)"), false},
        {first(R"("u": 1, "nu": "inf", "contributes": true, "group": "g", "name": "n", "cmc_U": 1)"), true},
        {first(R"("u": 1, "nu": "many")"), false},
        {first(R"("u": 1, "contributes": "yes")"), false},
        {first(R"("s": 1, "n": 4)"), true},
        {first(R"("s": 1, "n": 0)"), false},
        {first(R"("u": 1, "audited": {"u": 2, "finding": "f"})"), true},
        {first(R"("u": 1, "audited": {"u": 2})"), false},
        {first(R"("u": 1, "audited": {"finding": "f"})"), false},
        {R"("assigned_value": "median", "participants": [{"id": 1, "value": null}, {"id": 2, "value": 2},
            {"id": 3, "value": 2}])",
         true},
        {R"("participants": [{"id": "A", "value": "<0.3", "u": 1}, {"id": "B", "value": 2, "u": 1},
            {"id": "C", "value": 2, "u": 1}])",
         false},
        {points(point), true},
        {points(point, R"(, "correlation": 0.3, "bias_line": "position", "tolerance": 1, "unit": "um")"), true},
        {points(point, R"(, "correlation": "some")"), false},
        {points(point, R"(, "correlation": 2)"), false},
        {points(point, R"(, "bias_line": "none")"), false},
        {points(point, R"(, "tolerance": 0)"), false},
        {points(point, R"(, "position": {"unit": "deg"})"), false},
        {points(point, R"(, "position": {"name": "angle", "unit": "deg"})"), true},
        {points(point, R"(, "groups": {})"), false},
        {points(R"({"value": 1, "u": 1})"), false},
        {points(R"({"point": "P", "value": 1, "u": 1, "u_common": -1})"), false},
        {R"("lab": {"name": "l"}, "reference": {"points": [{"point": "P", "value": 1, "u": 1}]})", false},
        {R"("lab": {"points": [{"point": "P", "value": 1, "u": 1}]})", false}};
    for (const auto& [keys, is_good] : jobs) {
        EXPECT_EQ(accepts(json::parse(test::comparison_text(keys))), is_good) << keys;
        const auto found = test::comparison_refusals(keys);
        EXPECT_EQ(found.empty(), is_good) << keys << "\n" << test::texts(found);
    }
}

}  // namespace
}  // namespace gumcert::jobs
