#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "engine/job/comparison_job.h"
#include "engine/job/json_document.h"
#include "tests/unit/engine/job/campaign.h"
#include "tests/unit/engine/job/comparison_campaign.h"

namespace gumcert::engine {
namespace {

using nlohmann::json;
using test::k_three_laboratories;

std::string content(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

class ComparisonSchemaTest : public testing::Test {
protected:
    void SetUp() override {
        document_ =
            parse_json_document(content(std::filesystem::path(GUMCERT_SOURCE_DIR) / "schemas/job-1.schema.json"),
                                "job-1.schema.json")
                .value;
        valijson::SchemaParser(valijson::SchemaParser::kDraft7)
            .populateSchema(valijson::adapters::NlohmannJsonAdapter(document_), schema_);
    }
    [[nodiscard]] bool accepts(const json& job) {
        valijson::Validator validator;
        return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(job), nullptr);
    }
    /// A node with its reference followed; among alternatives the array, or the object with the most keys.
    [[nodiscard]] const json& resolved(const json& node) const {
        if (node.contains("$ref")) {
            return resolved(document_.at(json::json_pointer(node.at("$ref").get<std::string>().substr(1))));
        }
        if (!node.contains("anyOf") || node.contains("properties")) {
            return node;
        }
        const json* best = &node;
        for (const json& alternative : node.at("anyOf")) {
            const json& candidate = resolved(alternative);
            if (candidate.contains("items") || (candidate.contains("properties") && !best->contains("items"))) {
                best = &candidate;
            }
        }
        return *best;
    }
    /// The schema of an object of the job; `*` stands for any position.
    [[nodiscard]] const json& schema_of(std::string_view pointer) const {
        const json* node = &document_.at("definitions").at("comparison");
        for (std::string_view rest = pointer; !rest.empty();) {
            rest.remove_prefix(1);
            const std::size_t end = std::min(rest.find('/'), rest.size());
            const std::string key{rest.substr(0, end)};
            node = &resolved(key == "*" ? node->at("items") : node->at("properties").at(key));
            rest.remove_prefix(end);
        }
        return *node;
    }
    json document_;
    valijson::Schema schema_;
};

TEST_F(ComparisonSchemaTest, HasTheKeysOfTheReader) {
    for (const JobKeys& object : comparison_job_keys()) {
        std::vector<std::string> of_schema;
        for (const auto& [key, value] : schema_of(object.pointer).at("properties").items()) {
            of_schema.push_back(key);
        }
        const std::vector<std::string> of_reader(object.keys.begin(), object.keys.end());
        EXPECT_THAT(of_schema, testing::UnorderedElementsAreArray(of_reader)) << object.pointer;
        EXPECT_EQ(schema_of(object.pointer).at("additionalProperties"), false) << object.pointer;
    }
}

TEST_F(ComparisonSchemaTest, EveryKeyIsExplainedInTheDocumentation) {
    const std::string text = content(std::filesystem::path(GUMCERT_SOURCE_DIR) / "docs/comparison_job.md");
    for (const JobKeys& object : comparison_job_keys()) {
        for (const std::string_view key : object.keys) {
            EXPECT_NE(text.find("`" + std::string(key) + "`"), std::string::npos) << object.pointer << "/" << key;
        }
    }
    for (const std::string_view word : assigned_value_words()) {
        EXPECT_NE(text.find("`" + std::string(word) + "`"), std::string::npos) << word;
    }
}

TEST_F(ComparisonSchemaTest, AcceptsTheShippedExamples) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/comparison";
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".json") {
            EXPECT_TRUE(accepts(parse_json_document(content(entry.path()), "job.json").value)) << entry.path();
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
}  // namespace gumcert::engine
