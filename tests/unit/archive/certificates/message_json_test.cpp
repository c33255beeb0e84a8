#include "archive/certificates/message_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gumcert::archive {
namespace {

TEST(MessageJson, HasFiveParts) {
    const gum::Diagnostic message{.code = "GC-X-0001", .where = "a", .what = "b", .rule = "c", .action = "d"};
    EXPECT_EQ(as_json(message).dump(), R"({"action":"d","code":"GC-X-0001","rule":"c","what":"b","where":"a"})");
}

TEST(MessageJson, OfNoneIsAnEmptyList) {
    EXPECT_EQ(as_json(std::vector<gum::Diagnostic>{}).dump(), "[]");
    EXPECT_EQ(as_json(std::vector<gum::Diagnostic>(2)).size(), 2U);
}

}  // namespace
}  // namespace gumcert::archive
