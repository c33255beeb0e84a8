#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/fuzz/certificate_target.h"
#include "tests/support/fuzz_corpus.h"

namespace gumcert::jobs {
namespace {

/// Replays the corpus of the fuzz target, cut off and with single characters exchanged; the target throws when
/// something other than a result or a refusal comes out.
TEST(Mutations, CertificateDataEndInAResultOrARefusal) {
    const std::vector<std::string> seeds = gumcert::test::fuzz_corpus("certificate");
    ASSERT_FALSE(seeds.empty());
    std::size_t accepted_seeds = 0;
    std::size_t accepted = 0;
    std::size_t runs = 0;
    for (const std::string& seed : seeds) {
        ASSERT_NO_THROW(accepted_seeds += fuzz::certificate_data(seed) ? 1U : 0U) << seed;
        const std::size_t step = std::max<std::size_t>(1, seed.size() / 100);
        for (std::size_t at = 0; at < seed.size(); at += step) {
            for (const char c : {'"', '}', ',', '-', '9', '\x80', '\0'}) {
                std::string text = seed;
                text[at] = c;
                ASSERT_NO_THROW(accepted += fuzz::certificate_data(text) ? 1U : 0U) << seed << "\nat " << at;
                ++runs;
            }
            ASSERT_NO_THROW((void)fuzz::certificate_data(seed.substr(0, at))) << seed << "\nto " << at;
        }
    }
    EXPECT_GT(accepted_seeds, 0U);
    EXPECT_LT(accepted_seeds, seeds.size());
    EXPECT_GT(accepted, 0U);
    EXPECT_LT(accepted, runs);
}

}  // namespace
}  // namespace gumcert::jobs
