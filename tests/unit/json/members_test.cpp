#include "json/members.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gumcert::json {
namespace {

TEST(Members, AreThereOrNothing) {
    const nlohmann::json record = {{"data", {{"method", "CP-01"}, {"number", 3}}}};
    EXPECT_EQ(text_of(part_of(record, "data"), "method"), "CP-01");
    EXPECT_EQ(text_of(part_of(record, "data"), "number"), "") << "no text";
    EXPECT_EQ(text_of(part_of(record, "nothing"), "method"), "");
    EXPECT_TRUE(part_of(nlohmann::json::array({1}), "data").is_null());
}

}  // namespace
}  // namespace gumcert::json
