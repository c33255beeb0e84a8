#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "jobs/json_object.h"
#include "tests/support/bad_certificate_data.h"
#include "tests/support/certificate_json.h"
#include "tests/support/certificate_keys.h"
#include "tests/support/job_schema.h"

namespace gumcert::jobs {
namespace {

using gumcert::test::described_objects;
using gumcert::test::DescribedKey;
using nlohmann::json;

/// The certificate part of the schema of jobs.
class CertificateSchema : public gumcert::test::JobSchema {
protected:
    CertificateSchema() : JobSchema("certificate_data") {}

    [[nodiscard]] bool accepts_data(const json& data) const {
        return accepts(
            json{{"schema", "gumcert/job/1"}, {"kind", "budget"}, {"inputs", json::object()}, {"certificate", data}});
    }
};

TEST_F(CertificateSchema, HasTheKeysOfTheDescription) {
    std::size_t objects = 0;
    for (const auto& [pointer, keys] : described_objects<certificate::CertificateData>()) {
        if (pointer.starts_with("/own_profile")) {
            continue;  // a file of its own
        }
        ++objects;
        const json& schema = schema_of(pointer);
        std::set<std::string> expected, needed;
        for (const DescribedKey& key : keys) {
            if (key.filled) {
                continue;
            }
            expected.insert(key.name);
            if (key.needed) {
                needed.insert(key.name);
            }
            ASSERT_TRUE(schema.at("properties").contains(key.name)) << pointer << "/" << key.name;
            const json* property = &schema.at("properties").at(key.name);
            EXPECT_TRUE(property->contains("description")) << pointer << "/" << key.name;
            for (int i = 0; i < key.lists; ++i) {
                property = &property->at("items");
            }
            if (!key.words.empty()) {
                EXPECT_EQ(property->at("enum"), key.words) << pointer << "/" << key.name;
            }
        }
        std::set<std::string> found;
        for (const auto& [key, value] : schema.at("properties").items()) {
            found.insert(key);
        }
        EXPECT_EQ(found, expected) << pointer;
        EXPECT_EQ(schema.at("additionalProperties"), false) << pointer;
        EXPECT_EQ(schema.value("required", json::array()).get<std::set<std::string>>(), needed) << pointer;
    }
    EXPECT_GT(objects, 25U);
}

TEST_F(CertificateSchema, AcceptsEveryKey) {
    const json whole = test::CertificateJsonWriter::structure(test::complete_certificate_data());
    EXPECT_TRUE(accepts_data(whole));
    EXPECT_TRUE(accepts_data(json::object()));
    EXPECT_TRUE(accepts_data("certificate.json"));
    // And the complete data have every key, so that the tests of the reader leave none out.
    for (const auto& [pointer, keys] : described_objects<certificate::CertificateData>()) {
        if (pointer.starts_with("/own_profile")) {
            continue;
        }
        std::vector<const json*> objects{&whole};
        for (std::string_view rest = pointer; !rest.empty();) {
            rest.remove_prefix(1);
            const std::size_t end = std::min(rest.find('/'), rest.size());
            const std::string token{rest.substr(0, end)};
            rest.remove_prefix(end);
            std::vector<const json*> next;
            for (const json* node : objects) {
                if (token == "*") {
                    for (const json& element : *node) {
                        next.push_back(&element);
                    }
                } else if (node->contains(token)) {
                    next.push_back(&node->at(token));
                }
            }
            objects = next;
        }
        for (const DescribedKey& key : keys) {
            EXPECT_TRUE(key.filled || std::any_of(objects.begin(), objects.end(),
                                                  [&](const json* node) { return node->contains(key.name); }))
                << pointer << "/" << key.name << " is not in the complete data";
        }
    }
}

TEST_F(CertificateSchema, RefusesWhatTheReaderRefusesWhereASchemaCan) {
    // Characters, units, calendars, comparisons of two keys and names that must differ are beyond this schema.
    const std::set<std::string> beyond{"no_unit_of_U",
                                       "line_feed",
                                       "direction",
                                       "space",
                                       "date_day",
                                       "unit",
                                       "unit_of_scope",
                                       "rule_parameter",
                                       "scope_id",
                                       "specification_id",
                                       "limits_of_points_and_others",
                                       "accuracy_missing",
                                       "accuracy_part",
                                       "accuracy_empty",
                                       "accuracy_unit",
                                       "two_ways_of_limits",
                                       "expression_of_limits",
                                       "language_twice",
                                       "conditions",
                                       "limits_of_method",
                                       "limits",
                                       "range",
                                       "deviations",
                                       "section",
                                       "standard_of_section",
                                       "section_twice"};
    const json whole = test::CertificateJsonWriter::structure(test::complete_certificate_data());
    for (const test::BadData& bad : test::bad_certificate_data()) {
        EXPECT_EQ(accepts_data(bad.in(whole)), beyond.contains(bad.name)) << bad.name;
    }
}

TEST_F(CertificateSchema, AcceptsTheExamples) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/certificate";
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".json") {
            continue;
        }
        const json document = parse_json_document(gumcert::test::file_content(entry.path()), "job.json").value;
        EXPECT_TRUE(document.contains("kind") ? accepts(document) : accepts_data(document)) << entry.path();
        ++count;
    }
    EXPECT_EQ(count, 4U);
}

}  // namespace
}  // namespace gumcert::jobs
