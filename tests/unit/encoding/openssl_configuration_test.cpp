#include "encoding/openssl_configuration.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "encoding/sha2.h"

namespace gumcert::encoding {
namespace {

// A file that asks for algorithms of a provider that is not there takes every digest away.
TEST(ConfigurationOfOpenssl, IsNotRead) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "no_digests.cnf";
    std::ofstream(file) << "openssl_conf = all\n[all]\nalg_section = algorithms\n[algorithms]\n"
                           "default_properties = fips=yes\n";
    setenv("OPENSSL_CONF", file.c_str(), 1);
    read_no_configuration_of_openssl();
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    unsetenv("OPENSSL_CONF");
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace gumcert::encoding
