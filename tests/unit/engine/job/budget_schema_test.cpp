#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

#include "engine/job/budget_job.h"
#include "engine/job/json_document.h"
#include "tests/unit/engine/job/budget_campaign.h"
#include "tests/unit/engine/job/campaign.h"

namespace gumcert::engine {
namespace {

using nlohmann::json;

class BudgetSchemaTest : public testing::Test {
protected:
    void SetUp() override {
        std::ifstream stream(std::filesystem::path(GUMCERT_SOURCE_DIR) / "schemas/job-1.schema.json", std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        document_ = parse_json_document(text, "job-1.schema.json").value;
        valijson::SchemaParser(valijson::SchemaParser::kDraft7)
            .populateSchema(valijson::adapters::NlohmannJsonAdapter(document_), schema_);
    }
    [[nodiscard]] bool accepts(const json& job) {
        valijson::Validator validator;
        return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(job), nullptr);
    }
    /// A node with its reference followed; among alternatives the object with keys of its own.
    [[nodiscard]] const json& resolved(const json& node) const {
        if (node.contains("$ref")) {
            return document_.at(json::json_pointer(node.at("$ref").get<std::string>().substr(1)));
        }
        if (node.contains("anyOf")) {
            for (const json& alternative : node.at("anyOf")) {
                if (alternative.contains("properties")) {
                    return alternative;
                }
            }
        }
        return node;
    }
    /// The schema of an object of the job; `*` stands for any name or position.
    [[nodiscard]] const json& schema_of(std::string_view pointer) const {
        const json* node = &document_.at("definitions").at("budget");
        for (std::string_view rest = pointer; !rest.empty();) {
            rest.remove_prefix(1);
            const std::size_t end = std::min(rest.find('/'), rest.size());
            const std::string key{rest.substr(0, end)};
            node = &resolved(key != "*"                ? node->at("properties").at(key)
                             : node->contains("items") ? node->at("items")
                                                       : node->at("additionalProperties"));
            rest.remove_prefix(end);
        }
        return *node;
    }
    json document_;
    valijson::Schema schema_;
};

TEST_F(BudgetSchemaTest, HasTheKeysOfTheReader) {
    for (const JobKeys& object : budget_job_keys()) {
        std::vector<std::string> of_schema;
        for (const auto& [key, value] : schema_of(object.pointer).at("properties").items()) {
            of_schema.push_back(key);
        }
        const std::vector<std::string> of_reader(object.keys.begin(), object.keys.end());
        EXPECT_THAT(of_schema, testing::UnorderedElementsAreArray(of_reader)) << object.pointer;
        EXPECT_EQ(schema_of(object.pointer).at("additionalProperties"), false) << object.pointer;
    }
}

TEST_F(BudgetSchemaTest, AgreesWithTheReader) {
    const std::string good = R"j("inputs": {"X": {"value": 1, "u": 0.1}})j";
    const std::string x = R"j("inputs": {"X": {"value": 1, )j";
    const std::vector<std::pair<std::string, bool>> jobs{
        {good, true},
        {good + R"j(, "model": "y = X", "outputs": {"y": {"unit": "1", "coverage_probability": 0.99}}, "notes": "n")j",
         true},
        {good + R"j(, "model": [3])j", false},
        {good + R"j(, "coverage_probability": 95)j", false},
        {good + R"j(, "outputs": {"X": {"units": "1"}})j", false},
        {good + R"j(, "monte_carlo": {"trials": 1e6, "seed": 3, "validate": true, "digits": 1})j", true},
        {good + R"j(, "monte_carlo": {"adaptive": {"digits": 2, "max_trials": 1e9}})j", true},
        {good + R"j(, "monte_carlo": {"trials": 1e11})j", false},
        {good + R"j(, "monte_carlo": {"trials": 1000000.5})j", false},
        {good + R"j(, "points": [{"X": 3, "point": 1}, {"X": {"u": 1, "between_points": "common"}}])j", true},
        {good + R"j(, "points": [{"X": "3"}])j", false},
        {good + R"j(, "points": [{"X": {"unit": "mm"}}])j", false},
        {good + R"j(, "correlations": [["X", "X2"]])j", false},
        {good + R"j(, "certificate": 3)j", false},
        {good +
             R"j(, "fits": {"f": {"equation": "y = a*t", "parameters": {"a": {}}, "data": {"t": [1, 2], "y": [1, 2]}}})j",
         true},
        {good + R"j(, "fits": {"f": {"equation": "y = a*t", "parameters": {"a": {}}}})j", false},
        {x + R"j("u": -1}})j", false},
        {x + R"j("U": 1, "k": 2, "type": "B", "source": "s", "note": "n", "significance": "s"}})j", true},
        {x + R"j("U": 1, "k": 0}})j", false},
        {x + R"j("half_width": 1, "distribution": "uniform", "reliability": 0.1}})j", true},
        {x + R"j("half_width": 1, "distribution": "square"}})j", false},
        {x + R"j("half_width": 1, "halfwidth": 1}})j", false},
        {x + R"j("u": 1, "nu": "inf"}})j", true},
        {x + R"j("u": 1, "nu": "many"}})j", false},
        {x + R"j("u": 1, "type": "C"}})j", false},
        {x + R"j("constant": true}})j", true},
        {R"j("inputs": {"X": {"observations": [3], "pooled": {"s": 1, "nu": 4}}})j", true},
        {R"j("inputs": {"X": {"observations": [3], "pooled": {"s": 1}}})j", false},
        {R"j("inputs": {"X": {"groups": [[1, 2], [2, 3]]}})j", true},
        {R"j("inputs": {"X": {"groups": [[1], [2, 3]]}})j", false},
        {R"j("inputs": {"X": {"limits": [1, 2, 3]}})j", false},
        {R"j("inputs": {"X": {"distribution": {"kind": "gamma", "shape": 1, "scale": 1}}})j", true},
        {R"j("inputs": {"X": {"distribution": {"kind": "gama", "shape": 1, "scale": 1}}})j", false},
        {R"j("inputs": {"X": {"components": [{"name": "a", "value": 1, "u": 1}]}})j", true},
        {R"j("inputs": {"X": {"components": [{"value": 1, "u": 1}]}})j", false},
        {R"j("inputs": {"X": {"components": []}})j", false}};
    for (const auto& [keys, is_good] : jobs) {
        EXPECT_EQ(accepts(json::parse(test::budget_text(keys))), is_good) << keys;
        const auto found = test::budget_refusals(keys);
        EXPECT_EQ(found.empty(), is_good) << keys << "\n" << test::texts(found);
    }
}

}  // namespace
}  // namespace gumcert::engine
