#include "tests/support/json_schema.h"

#include <fstream>
#include <stdexcept>
#define VALIJSON_USE_EXCEPTIONS 1
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace gumcert::test {

struct JsonSchema::Compiled {
    valijson::Schema schema;
};

JsonSchema::JsonSchema(const std::string& name) : compiled_(std::make_unique<Compiled>()) {
    const std::string path = std::string(GUMCERT_SOURCE_DIR) + "/schemas/" + name;
    std::ifstream file(path);
    if (!file) {
        throw std::runtime_error(path + " cannot be read");
    }
    document_ = nlohmann::json::parse(file);
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(document_), compiled_->schema);
}

JsonSchema::~JsonSchema() = default;

std::string JsonSchema::refusals(const nlohmann::json& value) const {
    valijson::Validator validator;
    valijson::ValidationResults results;
    if (validator.validate(compiled_->schema, valijson::adapters::NlohmannJsonAdapter(value), &results)) {
        return "";
    }
    std::string all;
    for (valijson::ValidationResults::Error error; results.popError(error);) {
        for (const std::string& part : error.context) {
            all += part;
        }
        all += ": " + error.description + "\n";
    }
    return all.empty() ? "refused without a reason" : all;
}

const nlohmann::json& JsonSchema::followed(const nlohmann::json& node) const {
    return node.contains("$ref")
               ? document_.at(nlohmann::json::json_pointer(node.at("$ref").get<std::string>().substr(1)))
               : node;
}

}  // namespace gumcert::test
