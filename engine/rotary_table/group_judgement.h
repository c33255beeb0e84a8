#pragma once

#include <cstddef>
#include <map>
#include <utility>

#include "engine/rotary_table/group_tests.h"

namespace gumcert::engine {

/// Standard deviations by which an error must exceed the limit of its test to be found with a probability of 80 %.
constexpr double k_deviate_of_power = 0.841621233572914;

/// Test values of groups against the levels of their kinds.
class GroupJudgement {
public:
    /// \param options  must outlive this
    explicit GroupJudgement(const GroupTestOptions& options) : options_(options) {}

    /// Chi-square of one of several tests of a kind, with its probability and its limit. Not for several threads at once.
    /// \param count  tests of the kind, among which its level is divided
    /// \throws gum::NoResultError  GC-ADJUST-0015 where it is no sum of squares: distances that are off by metres leave rounding
    ///                             that is larger than what the other groups say
    [[nodiscard]] GroupTest judged(GroupKind kind, double chi_square, int degrees_of_freedom, std::size_t count) const;

private:
    const GroupTestOptions& options_;
    mutable std::map<std::pair<int, double>, double> limits_;  ///< by degrees of freedom and level
};

/// Whether a test is of more weight than another one where nothing is wrong.
[[nodiscard]] bool is_less_probable(const GroupTest& a, const GroupTest& b);

}  // namespace gumcert::engine
