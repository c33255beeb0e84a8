#include "engine/rotary_table/group_judgement.h"

#include <algorithm>
#include <cmath>

#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

namespace {

/// Value of chi-square that is exceeded with a probability.
double critical_chi_square(const GroupTestOptions& options, double probability, int degrees_of_freedom) {
    double low = 0.0;
    double high = 1e4;
    // By bisection of the tail that the caller gives: the engine may not use the layer that has quantiles (ADR 0001).
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (options.chi_square_upper_tail(middle, degrees_of_freedom) > probability ? low : high) = middle;
    }
    return high;
}

}  // namespace

GroupTest GroupJudgement::judged(GroupKind kind, double chi_square, int degrees_of_freedom, std::size_t count) const {
    constexpr double k_rounding = 1e-3;  // below what any test tells from 0; of exact distances it may lie below 0
    chi_square = std::abs(chi_square) < k_rounding ? std::max(chi_square, 0.0) : chi_square;
    if (!(chi_square >= 0.0)) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0015", "tests of groups",
            "the distances fit no rigid table that turns by the stated angles: they differ from it by so much that "
            "what a group of them says is lost in rounding",
            "what a place of the station leaves are error motions, far below a millimetre",
            "compare units and signs of the distances of each station, and the names of reflectors and stations, "
            "with the protocol of the measurement",
            gum::Severity::error});
    }
    GroupTest test;
    test.kind = kind;
    test.degrees_of_freedom = degrees_of_freedom;
    test.family = count;
    test.chi_square = chi_square;
    test.p_value = options_.chi_square_upper_tail(chi_square, degrees_of_freedom);
    const double level = share_of_level(kind) * options_.alpha / static_cast<double>(std::max<std::size_t>(count, 1));
    // The level is divided among all tests of a kind (Bonferroni): alpha is the probability of a false alarm in the
    // whole measurement.
    const auto [limit, is_new] = limits_.try_emplace({degrees_of_freedom, level}, 0.0);
    if (is_new) {
        limit->second = critical_chi_square(options_, level, degrees_of_freedom);
    }
    test.critical_value = limit->second;
    test.suspicious = test.p_value < level;
    return test;
}

bool is_less_probable(const GroupTest& a, const GroupTest& b) {
    // Far out both probabilities are 0 in double; then the misfit counts, less two for each degree of freedom.
    if (a.p_value != b.p_value) {
        return a.p_value < b.p_value;
    }
    return a.chi_square - 2.0 * a.degrees_of_freedom > b.chi_square - 2.0 * b.degrees_of_freedom;
}

}  // namespace gumcert::engine
