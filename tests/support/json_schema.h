#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace gumcert::test {

/// One of the schemas of the program, and a validator of another project that judges by it.
class JsonSchema {
public:
    /// \param name  of the file in schemas/
    explicit JsonSchema(const std::string& name);
    ~JsonSchema();
    JsonSchema(const JsonSchema&) = delete;
    JsonSchema& operator=(const JsonSchema&) = delete;

    /// What the schema refuses in a value, a line each; empty where it accepts the value.
    [[nodiscard]] std::string refusals(const nlohmann::json& value) const;
    [[nodiscard]] bool accepts(const nlohmann::json& value) const { return refusals(value).empty(); }
    [[nodiscard]] const nlohmann::json& document() const { return document_; }
    /// A node with its reference followed.
    [[nodiscard]] const nlohmann::json& followed(const nlohmann::json& node) const;

private:
    struct Compiled;
    nlohmann::json document_;
    std::unique_ptr<Compiled> compiled_;
};

}  // namespace gumcert::test
