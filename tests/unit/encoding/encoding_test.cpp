#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "encoding/base64.h"
#include "encoding/sha2.h"

namespace gumcert::encoding {
namespace {

// NIST, examples of FIPS 180-4: "abc" (one block) and the text of 448 bits (two blocks); the others with Python's
// hashlib.
TEST(Sha256, IsThatOfFips180) {
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    EXPECT_EQ(sha256(std::string(55, 'x')), "d5e285683cd4efc02d021a5c62014694958901005d6f71e89e0989fac77e4072");
    EXPECT_EQ(sha256(std::string(64, 'x')), "7ce100971f64e7001e8fe5a51973ecdfe1ced42befe7ee8d5fd6219506b5393c");
}

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
