#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "tests/fuzz/budget_job_target.h"
#include "tests/support/word_mutations.h"

namespace gumcert::jobs {
namespace {

TEST(Mutations, BudgetJobEndsInAResultOrARefusal) {
    static constexpr std::array<std::string_view, 30> k_words{"0",
                                                              "-1",
                                                              "1e300",
                                                              "1e-300",
                                                              "\"",
                                                              "null",
                                                              "true",
                                                              "[]",
                                                              "{}",
                                                              ",",
                                                              "}",
                                                              "]",
                                                              "\"u\"",
                                                              "\"value\"",
                                                              "\"U\"",
                                                              "\"components\"",
                                                              "\"nu\"",
                                                              "\"a\"",
                                                              "\"inf\"",
                                                              "degF",
                                                              "\"d\"",
                                                              "\"limits\"",
                                                              "\"constant\"",
                                                              "\"samples\"",
                                                              "\"of\"",
                                                              "\"covariance\"",
                                                              "\\u0007",
                                                              "µ",
                                                              "\"observations\"",
                                                              "1e7"};
    gumcert::test::run_word_mutations({.target = "budget_job",
                                       .seeds = 3,
                                       .accepted_seeds = 2,
                                       .words = k_words,
                                       .random_seed = 20240229,
                                       .count = 3000},
                                      fuzz::budget_job);
}

}  // namespace
}  // namespace gumcert::jobs
