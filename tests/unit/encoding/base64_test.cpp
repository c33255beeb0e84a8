#include "encoding/base64.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace gumcert::encoding {
namespace {

// RFC 4648, section 10.
TEST(Base64, IsThatOfRfc4648) {
    const std::vector<std::pair<std::string, std::string>> cases{{"", ""},
                                                                 {"f", "Zg=="},
                                                                 {"fo", "Zm8="},
                                                                 {"foo", "Zm9v"},
                                                                 {"foob", "Zm9vYg=="},
                                                                 {"fooba", "Zm9vYmE="},
                                                                 {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : cases) {
        EXPECT_EQ(base64(bytes), text);
        EXPECT_EQ(bytes_from_base64(text), bytes);
    }
}

TEST(Base64, OfManyBytesHasNoPaddingInside) {
    const std::string bytes(3'000'001, 'x');
    const std::string text = base64(bytes);
    EXPECT_EQ(text.size(), 4'000'004U);
    EXPECT_EQ(text.find('='), text.size() - 2);
    EXPECT_EQ(bytes_from_base64(text), bytes);
}

TEST(Base64, PassesOverLineBreaksAndRefusesTheRest) {
    EXPECT_EQ(bytes_from_base64("Zm9v\nYmFy "), "foobar");
    for (const char* text : {"Zm9", "Zm9v!mFy", "=m9v"}) {
        EXPECT_FALSE(bytes_from_base64(text).has_value()) << text;
    }
}

}  // namespace
}  // namespace gumcert::encoding
