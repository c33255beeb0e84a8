#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/job_targets.h"
#include "tests/support/fuzz_corpus.h"

namespace gumcert::jobs {
namespace {

/// One to four small changes, of the kinds that find holes in readers of text.
std::string mutated(std::string text, std::mt19937_64& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    static const std::vector<std::string> k_pieces{",",
                                                   "\n",
                                                   "\r\n",
                                                   "\r",
                                                   "\"",
                                                   "\"\"",
                                                   "{",
                                                   "}",
                                                   "[",
                                                   "]",
                                                   ":",
                                                   "//",
                                                   "/*",
                                                   "nan",
                                                   "inf",
                                                   "-",
                                                   "+",
                                                   "0",
                                                   "1e999",
                                                   "1e-999",
                                                   "e",
                                                   ".",
                                                   "-1",
                                                   "99999999999999999999",
                                                   "null",
                                                   "true",
                                                   "\\",
                                                   ";",
                                                   "\t",
                                                   " ",
                                                   "\xFF",
                                                   "\xC3",
                                                   "é",
                                                   "\xE2\x80\xAE",
                                                   "\\ud800",
                                                   "../",
                                                   "P1",
                                                   "R2",
                                                   "=== ",
                                                   "x",
                                                   "45",
                                                   "NaN",
                                                   "\xEF\xBB\xBF",
                                                   "\\u0000",
                                                   std::string(1, '\0'),
                                                   std::string(70, '[')};
    for (std::size_t change = 0, changes = 1 + below(4); change < changes; ++change) {
        const std::size_t at = below(text.size() + 1);
        const std::size_t count = std::min(text.size() - at, below(12));
        switch (below(5)) {
            case 0:
                text.erase(at, count);
                break;
            case 1:
                text.insert(at, k_pieces[below(k_pieces.size())]);
                break;
            case 2:
                text.replace(at, count, k_pieces[below(k_pieces.size())]);
                break;
            case 3:
                text.insert(below(text.size() + 1), text.substr(at, below(60)));
                break;
            default:
                if (at < text.size()) {
                    text[at] = static_cast<char>(static_cast<unsigned char>(below(256)));
                }
                break;
        }
    }
    return text;
}

/// Replays the corpus and mutations of it; the target throws when something other than a result or a refusal comes out.
void replay(const std::string& target, const std::function<bool(std::string_view)>& run, std::size_t mutations) {
    const std::vector<std::string> seeds = gumcert::test::fuzz_corpus(target);
    ASSERT_FALSE(seeds.empty());
    std::size_t accepted_seeds = 0;
    for (const std::string& seed : seeds) {
        ASSERT_NO_THROW(accepted_seeds += run(seed) ? 1U : 0U) << seed;
    }
    EXPECT_GT(accepted_seeds, 0U) << "the corpus must reach the far end of the reader";
    EXPECT_LT(accepted_seeds, seeds.size()) << "the corpus must reach the refusals";
    std::mt19937_64 random(20230117);
    std::size_t accepted = 0;
    for (std::size_t i = 0; i < mutations; ++i) {
        const std::string text = mutated(seeds[i % seeds.size()], random);
        ASSERT_NO_THROW(accepted += run(text) ? 1U : 0U) << "mutation " << i << ":\n" << text;
    }
    EXPECT_GT(accepted, 0U);
    EXPECT_LT(accepted, mutations);
}

TEST(Mutations, JsonTextEndsInAResultOrARefusal) {
    replay(
        "json_text", [](std::string_view text) { return gumcert::json::fuzz::json_text(text); }, 10'000);
}

TEST(Mutations, CsvTableEndsInAResultOrARefusal) {
    replay("csv_table", fuzz::csv_table, 6'000);
}

TEST(Mutations, RotaryTableJobEndsInAResultOrARefusal) {
    replay("rotary_table_job", fuzz::rotary_table_job, 4'000);
}

}  // namespace
}  // namespace gumcert::jobs
