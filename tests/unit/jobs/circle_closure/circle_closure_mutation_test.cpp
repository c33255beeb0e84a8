#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "tests/fuzz/circle_closure_job_target.h"
#include "tests/support/word_mutations.h"

namespace gumcert::jobs {
namespace {

TEST(Mutations, CircleClosureJobEndsInAResultOrARefusal) {
    static constexpr std::array<std::string_view, 30> k_words{
        "0",       "-1",  "1e300", "1e-300",   "\"",           "null",      "true",        "[]",           "{}",
        ",",       "}",   "]",     "\"u\"",    "\"value\"",    "\"U\"",     "\"acts_on\"", "\"nu\"",       "\"a\"",
        "\"inf\"", "\\n", "\"d\"", "\"turn\"", "\"constant\"", "\"steps\"", "\"scale\"",   "\"readings\"", "\\u0007",
        "µ",       "4,0", "1e7"};
    gumcert::test::run_word_mutations({.target = "circle_closure_job",
                                       .seeds = 3,
                                       .accepted_seeds = 2,
                                       .words = k_words,
                                       .random_seed = 20260401,
                                       .count = 3000},
                                      fuzz::circle_closure_job);
}

}  // namespace
}  // namespace gumcert::jobs
