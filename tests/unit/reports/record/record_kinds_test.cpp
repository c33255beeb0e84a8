#include "reports/record/record_kinds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

std::string with_kind(const char* kind) {
    nlohmann::json record = nlohmann::json::parse(to_canonical_json(test::sample_record()));
    record["kind"] = kind;
    return with_digest(std::move(record));
}

TEST(RecordKinds, AnotherWordIsRefusedWithTheWordsThatThereAre) {
    try {
        (void)record_from_json(with_kind("toy"), "record.json");
        FAIL() << "not refused";
    } catch (const gum::InputError& refused) {
        const gum::Diagnostic& told = refused.diagnostics().front();
        EXPECT_EQ(told.code, "GC-RECORD-0016");
        EXPECT_EQ(told.where, "record.json#/kind");
        EXPECT_EQ(told.what, "\"toy\"");
        EXPECT_EQ(told.rule, R"(must be one of "budget" "rotary_table" "circle_closure" "comparison")");
    }
}

TEST(RecordKinds, MayBeThoseOfTheCaller) {
    const std::vector<std::string_view> words{"toy"};
    EXPECT_EQ(record_from_json(with_kind("toy"), "record.json", words).kind, "toy");
    EXPECT_THROW((void)record_from_json(with_kind("rotary_table"), "record.json", words), gum::InputError);
}

}  // namespace
}  // namespace gumcert::reports
