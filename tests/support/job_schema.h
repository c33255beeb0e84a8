#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/job_kind.h"
#include "jobs/json_object.h"
#include "tests/support/file_content.h"
#include "tests/support/json_schema.h"

namespace gumcert::test {

/// The schema of jobs, schemas/job-1.schema.json.
class JobSchema : public testing::Test {
protected:
    /// \param definition  the one of the schema that the pointers below start from
    explicit JobSchema(std::string definition) : definition_(std::move(definition)) {}

    [[nodiscard]] bool accepts(const nlohmann::json& job) const { return schema_.accepts(job); }
    /// A job in a file.
    [[nodiscard]] bool accepts(const std::filesystem::path& job) const {
        return accepts(jobs::parse_json_document(file_content(job), job.filename().string()).value);
    }

    /// A node with its reference followed.
    [[nodiscard]] const nlohmann::json& followed(const nlohmann::json& node) const { return schema_.followed(node); }
    /// The schema of an object of the job; `*` stands for any name or position.
    [[nodiscard]] const nlohmann::json& schema_of(std::string_view pointer) const {
        const nlohmann::json* node = &schema_.document().at("definitions").at(definition_);
        for (std::string_view rest = pointer; !rest.empty();) {
            rest.remove_prefix(1);
            const std::size_t end = std::min(rest.find('/'), rest.size());
            node = child(*node, std::string(rest.substr(0, end)));
            if (node == nullptr) {
                throw std::out_of_range("the schema has no " + std::string(pointer));
            }
            rest.remove_prefix(end);
        }
        const nlohmann::json* object = first_of(*node, [](const nlohmann::json& one) -> const nlohmann::json* {
            return one.contains("properties") ? &one : nullptr;
        });
        return object == nullptr ? *node : *object;
    }
    void expect_keys(std::span<const jobs::JobKeys> of_reader) const {
        for (const jobs::JobKeys& object : of_reader) {
            std::vector<std::string> of_schema;
            for (const auto& [key, value] : schema_of(object.pointer).at("properties").items()) {
                of_schema.push_back(key);
            }
            EXPECT_THAT(of_schema, testing::UnorderedElementsAreArray(
                                       std::vector<std::string>(object.keys.begin(), object.keys.end())))
                << object.pointer;
            EXPECT_EQ(schema_of(object.pointer).at("additionalProperties"), false) << object.pointer;
        }
    }

private:
    /// What `find` finds in a node, or in the first of its alternatives where it finds something.
    template <typename Find>
    [[nodiscard]] const nlohmann::json* first_of(const nlohmann::json& node, const Find& find) const {
        const nlohmann::json& here = followed(node);
        const nlohmann::json* found = find(here);
        if (found == nullptr && here.contains("anyOf")) {
            for (const nlohmann::json& alternative : here.at("anyOf")) {
                found = found == nullptr ? first_of(alternative, find) : found;
            }
        }
        return found;
    }
    [[nodiscard]] const nlohmann::json* child(const nlohmann::json& node, const std::string& key) const {
        return first_of(node, [&](const nlohmann::json& one) -> const nlohmann::json* {
            if (key != "*") {
                return one.contains("properties") && one.at("properties").contains(key) ? &one.at("properties").at(key)
                                                                                        : nullptr;
            }
            const char* const of_any = one.contains("items") ? "items" : "additionalProperties";
            return one.contains(of_any) && one.at(of_any).is_object() ? &one.at(of_any) : nullptr;
        });
    }

    std::string definition_;
    JsonSchema schema_{"job-1.schema.json"};
};

}  // namespace gumcert::test
