#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/comparison_job_target.h"

namespace gumcert::engine {
namespace {

/// The seeds of the fuzz target and small changes of them: words of the format put in, taken out and exchanged.
TEST(Mutations, ComparisonJobEndsInAResultOrARefusal) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(GUMCERT_SOURCE_DIR) /
                                                                 "tests/fuzz/corpus/comparison_job")) {
        paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> seeds;
    std::size_t accepted_seeds = 0;
    for (const auto& path : paths) {
        std::ifstream stream(path, std::ios::binary);
        seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
        accepted_seeds += fuzz::comparison_job(seeds.back()) ? 1U : 0U;
    }
    ASSERT_EQ(seeds.size(), 5U);
    EXPECT_EQ(accepted_seeds, 4U);
    static constexpr std::array<std::string_view, 32> k_pieces{
        "0",        "-1",        "1e300",   "1e-300",   "1e400",   "\"",    "null",        "true",
        "[]",       "{}",        ",",       "}",        "]",       "\"u\"", "\"value\"",   "\"U\"",
        "\"k\"",    "\"nu\"",    "\"id\"",  "\"<0.3\"", "\"inf\"", "degF",  "\"sources\"", "\"median\"",
        "\"item\"", "\"round\"", "\\u0007", "µ",        "\n",      "A,,",   "\"budget\"",  "NaN"};
    std::mt19937_64 random(20240301);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    std::size_t accepted = 0;
    constexpr std::size_t k_mutations = 4000;
    for (std::size_t i = 0; i < k_mutations; ++i) {
        std::string text = seeds[i % seeds.size()];
        for (std::size_t change = 0, changes = 1 + below(3); change < changes; ++change) {
            const std::size_t at = below(text.size());
            const std::size_t count = std::min(text.size() - at, below(9));
            text.replace(at, below(3) == 0 ? 0 : count,
                         below(4) == 0 ? std::string_view{} : k_pieces[below(k_pieces.size())]);
        }
        ASSERT_NO_THROW(accepted += fuzz::comparison_job(text) ? 1U : 0U) << "mutation " << i << ":\n" << text;
    }
    EXPECT_GT(accepted, 0U);
    EXPECT_LT(accepted, k_mutations);
}

}  // namespace
}  // namespace gumcert::engine
