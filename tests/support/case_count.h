#pragma once

#include <cstdlib>

namespace gumcert::test {

/// How many cases a law over generated inputs is tried with: a few that have the same spread in every run of the tests,
/// all of them where GUMCERT_ALL_CASES is set, as `scripts/test --all` does.
template <typename Count>
Count cases(Count of_every_run, Count all) {
    return std::getenv("GUMCERT_ALL_CASES") == nullptr ? of_every_run : all;
}

}  // namespace gumcert::test
