#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/fuzz/archive_target.h"
#include "tests/support/fuzz_corpus.h"

namespace gumcert::archive {
namespace {

/// Replays the corpus of the fuzz target, cut off and with single characters exchanged; the target throws when
/// something other than a verdict or a refusal comes out.
TEST(Mutations, EvidenceEndsInAVerdictOrARefusal) {
    std::size_t accepted_seeds = 0;
    std::size_t accepted = 0;
    std::size_t runs = 0;
    const std::vector<std::string> seeds = gumcert::test::fuzz_corpus("archive");
    for (const std::string& seed : seeds) {
        ASSERT_NO_THROW(accepted_seeds += fuzz::evidence_or_head(seed) ? 1U : 0U) << seed;
        const std::size_t step = std::max<std::size_t>(1, seed.size() / 100);
        for (std::size_t at = 0; at < seed.size(); at += step) {
            for (const char c : {'"', '}', ',', '-', '9', '\x80', '\0'}) {
                std::string text = seed;
                text[at] = c;
                ASSERT_NO_THROW(accepted += fuzz::evidence_or_head(text) ? 1U : 0U) << seed << "\nat " << at;
                ++runs;
            }
            ASSERT_NO_THROW((void)fuzz::evidence_or_head(seed.substr(0, at))) << seed << "\nto " << at;
        }
    }
    EXPECT_GT(accepted_seeds, 0U);
    EXPECT_LT(accepted_seeds, seeds.size());
    EXPECT_GT(accepted, 0U);
    EXPECT_LT(accepted, runs);
}

}  // namespace
}  // namespace gumcert::archive
