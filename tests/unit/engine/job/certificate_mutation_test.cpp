#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/certificate_target.h"

namespace gumcert::engine {
namespace {

/// Replays the corpus of the fuzz target, cut off and with single characters exchanged; the target throws when
/// something other than a result or a refusal comes out.
TEST(Mutations, CertificateDataEndInAResultOrARefusal) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(GUMCERT_SOURCE_DIR) /
                                                                 "tests/fuzz/corpus/certificate")) {
        paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    ASSERT_FALSE(paths.empty());
    std::size_t accepted_seeds = 0;
    std::size_t accepted = 0;
    std::size_t runs = 0;
    for (const auto& path : paths) {
        std::ifstream stream(path, std::ios::binary);
        const std::string seed{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        ASSERT_NO_THROW(accepted_seeds += fuzz::certificate_data(seed) ? 1U : 0U) << path;
        const std::size_t step = std::max<std::size_t>(1, seed.size() / 100);
        for (std::size_t at = 0; at < seed.size(); at += step) {
            for (const char c : {'"', '}', ',', '-', '9', '\x80', '\0'}) {
                std::string text = seed;
                text[at] = c;
                ASSERT_NO_THROW(accepted += fuzz::certificate_data(text) ? 1U : 0U) << path << " at " << at;
                ++runs;
            }
            ASSERT_NO_THROW((void)fuzz::certificate_data(seed.substr(0, at))) << path << " to " << at;
        }
    }
    EXPECT_GT(accepted_seeds, 0U);
    EXPECT_LT(accepted_seeds, paths.size());
    EXPECT_GT(accepted, 0U);
    EXPECT_LT(accepted, runs);
}

}  // namespace
}  // namespace gumcert::engine
