#include "jobs/schema/job_schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/support/file_content.h"
#include "tests/unit/jobs/described_sample.h"

namespace gumcert::jobs {
namespace {

using gumcert::test::file_content;
using nlohmann::json;
using test::Sample;

const std::filesystem::path k_root(GUMCERT_SOURCE_DIR);
constexpr const char* k_advice = "build the target write_schemas, run it in the tree, and look at the difference";

// What users and editors see is frozen: a change of a description is a change of these files.
TEST(DescribedJobs, AreTheDefinitionsOfTheSchema) {
    const std::string schema = file_content(k_root / "schemas/job-1.schema.json");
    EXPECT_TRUE(with_described_definitions(schema) == schema) << k_advice;
}

TEST(DescribedJobs, AreThePageOfTheDocumentation) {
    EXPECT_TRUE(page_of_job_keys() == file_content(k_root / "docs/job_keys.md")) << k_advice;
}

TEST(DescribedJobs, AddNoDefinition) {
    EXPECT_THROW((void)with_described_definitions(R"({"definitions": {}})"), std::invalid_argument);
}

TEST(DescribedJobs, SayInTheSchemaWhatTheRulesSay) {
    const json schema = schema_of(fields_of<Sample>());
    EXPECT_EQ(schema.at("type"), "object");
    EXPECT_EQ(schema.at("additionalProperties"), false);
    EXPECT_EQ(schema.at("required"), json::parse(R"(["kind", "length_um", "outer", "by_name", "pair"])"));
    EXPECT_EQ(schema.at("anyOf"), json::parse(R"([{"required": ["count"]}, {"required": ["name"]}])"));
    EXPECT_EQ(schema.at("dependencies"), json::parse(R"({"count": ["name"], "turns": ["count"]})"));
    const json expected = json::parse(R"j({
        "kind": {"description": "What it is.", "const": "sample"},
        "length_um": {"description": "A length.", "type": "number", "exclusiveMinimum": 0, "maximum": 5},
        "count": {"description": "A number of things.", "type": "number", "minimum": 1, "maximum": 10, "multipleOf": 1.0},
        "shape": {"description": "A choice.", "enum": ["round", "square"]},
        "name": {"description": "A name.", "$ref": "#/definitions/name"},
        "file": {"description": "A file.", "$ref": "#/definitions/file_name"},
        "point_mm": {"description": "A place.", "type": "array", "minItems": 3, "maxItems": 3,
                     "items": {"type": "number"}},
        "turns": {"description": "True or false.", "type": "boolean"},
        "inner": {"description": "A struct that may be absent.", "type": "object", "required": ["u"],
                  "additionalProperties": false,
                  "properties": {"u": {"type": "number"},
                                 "v": {"description": "Of it.", "type": "number", "minimum": 0}}},
        "outer": {"description": "An object without a struct.", "type": "object", "oneOf": [{"required": ["a"]}],
                  "additionalProperties": false, "properties": {"a": {"description": "A number.", "type": "number"}}},
        "entries": {"description": "Several of them.", "type": "array", "maxItems": 3,
                    "items": {"type": "object", "required": ["name"], "additionalProperties": false,
                              "properties": {"name": {"description": "Of the entry.", "type": "string"}}}},
        "by_name": {"description": "Several of them, by name.", "type": "object", "minProperties": 1,
                    "maxProperties": 9, "additionalProperties":
                    {"type": "object", "required": ["name"], "additionalProperties": false,
                     "properties": {"name": {"description": "Of the entry.", "type": "string"}}}},
        "angles": {"description": "Several numbers.", "type": "array", "minItems": 1, "maxItems": 4,
                   "items": {"type": "number"}},
        "either": {"description": "The ones or the other.", "anyOf": [
                   {"type": "array", "minItems": 1, "maxItems": 4, "items": {"type": "number"}},
                   {"type": "object", "required": ["u"], "additionalProperties": false,
                    "properties": {"u": {"type": "number"},
                                   "v": {"description": "Of it.", "type": "number", "minimum": 0}}}]},
        "shared": {"description": "A number, a word or an object.", "anyOf": [
                   {"type": "number"}, {"enum": ["round", "square"]}, {"$ref": "#/definitions/shared"}]},
        "all_shared": {"description": "A file, or objects.", "anyOf": [
                       {"$ref": "#/definitions/file_object"},
                       {"type": "array", "minItems": 1, "items": {"$ref": "#/definitions/shared"}}]},
        "pair": {"description": "A row.", "type": "array", "minItems": 2, "maxItems": 2,
                 "items": [{"$ref": "#/definitions/label"}, {"type": "null"}]},
        "rows": {"description": "Rows of numbers.", "type": "array",
                 "items": {"type": "array", "minItems": 2, "items": {"type": "number"}}},
        "numbers": {"description": "Numbers by name.", "type": "object", "additionalProperties":
                    {"anyOf": [{"type": "number", "exclusiveMinimum": 0}, {"enum": ["inf"]}]}},
        "computed": {"description": "Above zero, and not too large.", "type": "number", "exclusiveMinimum": 0,
                     "maximum": 1000},
        "label": {"description": "A name or a number.", "$ref": "#/definitions/label"},
        "special": {"description": "Read by code."}})j");
    for (const auto& [key, value] : expected.items()) {
        EXPECT_EQ(schema.at("properties").at(key), value) << key;
    }
    EXPECT_EQ(schema.at("properties").size(), expected.size());
    const json shared = schema_of(fields_of<test::SampleShared>());
    EXPECT_EQ(shared.at("description"), "Written out once.");
    EXPECT_EQ(shared.at("not"), json::parse(R"({"anyOf": [{"required": ["a", "b"]}]})"));
}

}  // namespace
}  // namespace gumcert::jobs
