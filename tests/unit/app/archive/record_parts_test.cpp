#include "app/archive/record_parts.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gumcert::app {
namespace {

TEST(RecordParts, AreThereOrNothing) {
    const nlohmann::json record = {{"data", {{"method", "CP-01"}, {"number", 3}}}};
    EXPECT_EQ(text_of(part_of(record, "data"), "method"), "CP-01");
    EXPECT_EQ(text_of(part_of(record, "data"), "number"), "") << "no text";
    EXPECT_EQ(text_of(part_of(record, "nothing"), "method"), "");
    EXPECT_TRUE(part_of(nlohmann::json::array({1}), "data").is_null());
}

TEST(RecordParts, AMessageHasFiveParts) {
    const gum::Diagnostic message{.code = "GC-X-0001", .where = "a", .what = "b", .rule = "c", .action = "d"};
    EXPECT_EQ(as_json(message).dump(), R"({"action":"d","code":"GC-X-0001","rule":"c","what":"b","where":"a"})");
}

}  // namespace
}  // namespace gumcert::app
