#include "encoding/sha2.h"

#include <gtest/gtest.h>

#include <string>

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

// The same examples, and the text of 896 bits, for the longer digests.
TEST(Sha2, HasTheLongerDigestsOfFips180) {
    EXPECT_EQ(hexadecimal(sha2_bytes("SHA2-384", "abc")),
              "cb00753f45a35e8bb5a03d699ac65007272c32ab0eded1631a8b605a43ff5bed8086072ba1e7cc2358baeca134c825a7");
    EXPECT_EQ(hexadecimal(sha2_bytes("SHA2-512", "abc")),
              "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a"
              "2192992a274fc1a836ba3c23a3feebbd454d4423643ce80e2a9ac94fa54ca49f");
    EXPECT_EQ(hexadecimal(sha2_bytes("SHA2-512",
                                     "abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmn"
                                     "hijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu")),
              "8e959b75dae313da8cf4f72814fc143f8f7779c6eb9f7fa17299aeadb6889018"
              "501d289e4900f7e4331b99dec4b5433ac7d329eeb6dd26545e96e55b874be909");
    EXPECT_EQ(sha2_bytes("SHA2-256", "abc"), sha256_bytes("abc"));
    EXPECT_EQ(hexadecimal(sha256_bytes("abc")), sha256("abc"));
}

TEST(Hexadecimal, OfEveryByteHasTwoDigits) {
    EXPECT_EQ(hexadecimal(std::string("\x00\x0f\x7f\x80\xff", 5)), "000f7f80ff");
    EXPECT_EQ(hexadecimal(""), "");
}

TEST(Sha2, ReadsHexadecimalDigits) {
    EXPECT_EQ(bytes_from_hexadecimal("00ff10"), std::string("\0\xFF\x10", 3));
    EXPECT_EQ(bytes_from_hexadecimal(""), "");
    EXPECT_EQ(bytes_from_hexadecimal("0"), std::nullopt);
    EXPECT_EQ(bytes_from_hexadecimal("FF"), std::nullopt);
    EXPECT_EQ(bytes_from_hexadecimal("0x"), std::nullopt);
}

TEST(Sha2, KnowsTheFormOfADigest) {
    EXPECT_TRUE(is_sha256(sha256("")));
    EXPECT_FALSE(is_sha256(""));
    EXPECT_FALSE(is_sha256(sha256("").substr(1)));
    EXPECT_FALSE(is_sha256(std::string(63, '0') + "A"));
    EXPECT_FALSE(is_sha256(std::string(65, '0')));
}

}  // namespace
}  // namespace gumcert::encoding
