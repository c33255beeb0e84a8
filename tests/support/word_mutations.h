#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/fuzz_corpus.h"

namespace gumcert::test {

struct WordMutations {
    std::string target;  ///< folder of the corpus
    std::size_t seeds = 0, accepted_seeds = 0;
    std::span<const std::string_view> words;  ///< of the format
    std::uint64_t random_seed = 0;
    std::size_t count = 0;
};

/// Runs the seeds of a fuzz target and small changes of them: words of the format put in, taken out and exchanged.
/// \param run  true where the text is accepted; throws when something other than a result or a refusal comes out
inline void run_word_mutations(const WordMutations& of, const std::function<bool(std::string_view)>& run) {
    const std::vector<std::string> seeds = fuzz_corpus(of.target);
    ASSERT_EQ(seeds.size(), of.seeds);
    EXPECT_EQ(static_cast<std::size_t>(std::count_if(seeds.begin(), seeds.end(), run)), of.accepted_seeds);
    std::mt19937_64 random(of.random_seed);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    std::size_t accepted = 0;
    for (std::size_t i = 0; i < of.count; ++i) {
        std::string text = seeds[i % seeds.size()];
        for (std::size_t change = 0, changes = 1 + below(3); change < changes; ++change) {
            const std::size_t at = below(text.size());
            const std::size_t length = std::min(text.size() - at, below(9));
            const std::size_t replaced = below(3) == 0 ? 0 : length;
            text.replace(at, replaced, below(4) == 0 ? std::string_view{} : of.words[below(of.words.size())]);
        }
        ASSERT_NO_THROW(accepted += run(text) ? 1U : 0U) << "mutation " << i << ":\n" << text;
    }
    EXPECT_GT(accepted, 0U);
    EXPECT_LT(accepted, of.count);
}

}  // namespace gumcert::test
