#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/budget/budget_job.h"
#include "jobs/json_object.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/campaign.h"
#include "tests/support/job_schema.h"

namespace gumcert::jobs {
namespace {

using nlohmann::json;

class BudgetSchemaTest : public gumcert::test::JobSchema {
protected:
    BudgetSchemaTest() : JobSchema("budget") {}
};

TEST_F(BudgetSchemaTest, HasTheKeysOfTheReader) {
    expect_keys(budget_job_keys());
}

TEST_F(BudgetSchemaTest, AgreesWithTheReader) {
    const std::string good = R"j("inputs": {"X": {"value": 1, "u": 0.1}})j";
    const std::string x = R"j("inputs": {"X": {"value": 1, )j";
    const std::vector<std::pair<std::string, bool>> jobs{
        {good, true},
        {good + R"j(, "model": "y = X", "outputs": {"y": {"unit": "1", "coverage_probability": 0.99}}, "notes": "n")j",
         true},
        {good + R"j(, "$schema": "../schemas/job-1.schema.json")j", true},
        {good + R"j(, "$schema": {})j", false},
        {good + R"j(, "model": [3])j", false},
        {good + R"j(, "coverage_probability": 95)j", false},
        {good + R"j(, "outputs": {"X": {"units": "1"}})j", false},
        {good + R"j(, "monte_carlo": {"trials": 1e6, "seed": 3, "validate": true, "digits": 1})j", true},
        {good + R"j(, "monte_carlo": {"adaptive": {"digits": 2, "max_trials": 1e9}})j", true},
        {good + R"j(, "monte_carlo": {"trials": 1e11})j", false},
        {good + R"j(, "monte_carlo": {"trials": 1000000.5})j", false},
        {good + R"j(, "points": [{"X": 3, "point": 1}, {"X": {"u": 1, "between_points": "common"}}])j", true},
        {good + R"j(, "points": [{"X": "3"}])j", false},
        {R"j("inputs": {"X": {"unit": "arcsec", "value": "0° 30'", "u": 1}}, "points": [{"X": "12° 30' 05.0\""}])j",
         true},
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
}  // namespace gumcert::jobs
