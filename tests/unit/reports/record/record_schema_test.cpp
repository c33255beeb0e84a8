#include "reports/record/evaluation_record.h"
#include "tests/support/sample_record.h"

#define VALIJSON_USE_EXCEPTIONS 1
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <fstream>
#include <functional>
#include <string>

namespace gumcert::reports {
namespace {

using nlohmann::json;

class RecordSchema : public ::testing::Test {
protected:
    void SetUp() override {
        std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/schemas/record-1.schema.json");
        ASSERT_TRUE(file) << "schemas/record-1.schema.json is missing";
        document_ = json::parse(file);
        valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
        parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(document_), schema_);
    }

    bool accepts(const json& record) {
        valijson::Validator validator;
        valijson::ValidationResults results;
        const valijson::adapters::NlohmannJsonAdapter target(record);
        const bool valid = validator.validate(schema_, target, &results);
        valijson::ValidationResults::Error error;
        messages_.clear();
        while (results.popError(error)) {
            for (const std::string& part : error.context) {
                messages_ += part;
            }
            messages_ += ": " + error.description + "\n";
        }
        return valid;
    }

    json document_;
    valijson::Schema schema_;
    std::string messages_;
};

TEST_F(RecordSchema, AcceptsAWholeRecord) {
    const json record = json::parse(to_canonical_json(test::sample_record()));
    EXPECT_TRUE(accepts(record)) << messages_;
    EvaluationRecord small = test::sample_record();
    small.rotary.reset();
    small.comparison.reset();
    EXPECT_TRUE(accepts(json::parse(to_canonical_json(small)))) << messages_;
}

TEST_F(RecordSchema, RefusesWhatTheReaderRefuses) {
    const json whole = json::parse(to_canonical_json(test::sample_record()));
    const std::vector<std::function<void(json&)>> breaks = {
        [](json& r) { r["schema"] = "gumcert/record/2"; },
        [](json& r) { r.erase("software"); },
        [](json& r) { r["extra"] = 1; },
        [](json& r) { r["audit"] = json::object(); },
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
        [](json& r) { r["comparison"]["summary"]["w"] = r["comparison"]["summary"]["x"]; },
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

}  // namespace
}  // namespace gumcert::reports
