#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "tests/fuzz/record_target.h"
#include "tests/support/word_mutations.h"

namespace gumcert::reports {
namespace {

TEST(Mutations, RecordEndsInARecordOrARefusal) {
    static constexpr std::array<std::string_view, 28> k_words{
        "0", "-1", "1e300",   "1e-300",   "1e400",     "\"",       "null",       "true",    "[]",    "{}",
        ",", "}",  "]",       "\"u\"",    "\"value\"", "\"U\"",    "\"En\"",     "NaN",     "\"k\"", "\"all\"",
        "µ", "\n", "\\u0007", "\"none\"", "\"id\"",    "\"form\"", "\"points\"", "\"unit\""};
    test::run_word_mutations(
        {.target = "record", .seeds = 8, .accepted_seeds = 8, .words = k_words, .random_seed = 20261121, .count = 2000},
        fuzz::record);
}

}  // namespace
}  // namespace gumcert::reports
