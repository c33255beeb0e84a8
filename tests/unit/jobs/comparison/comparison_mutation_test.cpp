#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "tests/fuzz/comparison_job_target.h"
#include "tests/support/word_mutations.h"

namespace gumcert::jobs {
namespace {

TEST(Mutations, ComparisonJobEndsInAResultOrARefusal) {
    static constexpr std::array<std::string_view, 32> k_words{
        "0",        "-1",        "1e300",   "1e-300",   "1e400",   "\"",    "null",        "true",
        "[]",       "{}",        ",",       "}",        "]",       "\"u\"", "\"value\"",   "\"U\"",
        "\"k\"",    "\"nu\"",    "\"id\"",  "\"<0.3\"", "\"inf\"", "degF",  "\"sources\"", "\"median\"",
        "\"item\"", "\"round\"", "\\u0007", "µ",        "\n",      "A,,",   "\"budget\"",  "NaN"};
    gumcert::test::run_word_mutations({.target = "comparison_job",
                                       .seeds = 5,
                                       .accepted_seeds = 4,
                                       .words = k_words,
                                       .random_seed = 20240301,
                                       .count = 4000},
                                      fuzz::comparison_job);
}

}  // namespace
}  // namespace gumcert::jobs
