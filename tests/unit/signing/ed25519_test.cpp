#include "signing/ed25519.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "encoding/sha2.h"

namespace gumcert::signing {
namespace {

namespace fs = std::filesystem;

/// Keys of RFC 8410, 10.3: they sign nothing but this test.
constexpr const char* k_private_pem =
    "-----BEGIN PRIVATE KEY-----\n"
    "MC4CAQAwBQYDK2VwBCIEINTuctv5E1hK1bbY8fdp+K06/nwoy/HU++CXqI9EdVhC\n"
    "-----END PRIVATE KEY-----\n";
constexpr const char* k_public_pem =
    "-----BEGIN PUBLIC KEY-----\n"
    "MCowBQYDK2VwAyEAGb9ECWmEzf6FQbrBZ9w7lshQhqowtrbLDFw4rXAxZuE=\n"
    "-----END PUBLIC KEY-----\n";

class Ed25519OfHeads : public testing::Test {
protected:
    Ed25519OfHeads() {
        std::string name = (fs::path(testing::TempDir()) / "gumcert-ed25519-XXXXXX").string();
        EXPECT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
        std::ofstream(folder_ / "key.pem") << k_private_pem;
        std::ofstream(folder_ / "public.pem") << k_public_pem;
    }
    ~Ed25519OfHeads() override { fs::remove_all(folder_); }
    fs::path folder_;
};

TEST_F(Ed25519OfHeads, SignsAndKnowsItsOwn) {
    const Ed25519Signature signature = sign_ed25519("a head", folder_ / "key.pem");
    EXPECT_EQ(encoding::hexadecimal(signature.public_key),
              "19bf44096984cdfe8541bac167dc3b96c85086aa30b6b6cb0c5c38ad703166e1");
    EXPECT_EQ(signature.value.size(), 64U);
    EXPECT_EQ(ed25519_public_key(folder_ / "public.pem"), signature.public_key);
    EXPECT_TRUE(is_signed_ed25519("a head", signature));
    EXPECT_EQ(sign_ed25519("a head", folder_ / "key.pem").value, signature.value) << "without random numbers";
}

TEST_F(Ed25519OfHeads, KnowsNothingElse) {
    const Ed25519Signature signature = sign_ed25519("a head", folder_ / "key.pem");
    EXPECT_FALSE(is_signed_ed25519("another head", signature));
    Ed25519Signature other = signature;
    other.value[5] ^= 1;
    EXPECT_FALSE(is_signed_ed25519("a head", other));
    other = signature;
    other.public_key[5] ^= 1;
    EXPECT_FALSE(is_signed_ed25519("a head", other));
    EXPECT_FALSE(is_signed_ed25519("a head", {"", ""}));
}

TEST_F(Ed25519OfHeads, RefusesOtherKeys) {
    std::ofstream(folder_ / "other.pem") << "no key\n";
    EXPECT_THROW((void)sign_ed25519("a head", folder_ / "other.pem"), gum::InputError);
    EXPECT_THROW((void)sign_ed25519("a head", folder_ / "public.pem"), gum::InputError);
    EXPECT_THROW((void)ed25519_public_key(folder_ / "other.pem"), gum::InputError);
    EXPECT_THROW((void)sign_ed25519("a head", folder_ / "missing.pem"), gum::StorageError);
}

}  // namespace
}  // namespace gumcert::signing
