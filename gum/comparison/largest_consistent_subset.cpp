#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/comparison/correlated_results.h"
#include "gum/comparison/reference_value.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

using Eigen::Index;

constexpr double k_tie = 1e-9;                      // relative, of chi-square: closer subsets are a tie
constexpr double k_rounding_of_chi_square = 1e-11;  // relative, of chi-square as it is computed
constexpr double k_same_result = 1e-13;             // of u: results that are taken as equal
constexpr double k_largest_alpha = 0.3;

using Members = std::vector<std::uint32_t>;

struct Subset {
    Members members;  // ascending
    double chi_square = k_infinity;
};

/// Search among independent results for the subset of a given size with the smallest chi-square.
///
/// χ² of a subset is the least value over y of Σ f_i(y) with f_i(y) = (x_i − y)²/u_i². So the least χ² of all subsets
/// of size k is the least value over y of the sum of the k smallest f_i(y). An interval of y is left out when the sum
/// cannot come below the bound there; else it is halved, until few results are left of which it is not certain whether
/// they belong to the k smallest. Then the points where two of those change places divide the interval into pieces with
/// one subset each, and these are compared exactly.
class SubsetSearch {
public:
    explicit SubsetSearch(const LaboratoryResults& results) {
        // f_i(y) is formed with 1/u_i: digits that all values share would cost those of the most precise result most.
        const double centre = results.x(most_precise(results));
        x_.assign(results.x.data(), results.x.data() + results.x.size());
        u_.assign(results.u.data(), results.u.data() + results.u.size());
        for (double& x : x_) {
            x -= centre;
        }
    }

    /// \param bound  subsets with a greater chi-square are of no interest
    /// \param any    the first subset that is found will do
    /// \return the best subset; infinite chi-square: none has a chi-square up to the bound
    Subset best_of_size(std::size_t size, double bound, bool any) { return best_with(std::nullopt, size, bound, any); }
    /// The same among the subsets that hold one of the results.
    Subset best_with(std::optional<std::uint32_t> member, std::size_t size, double bound, bool any) {
        member_ = member;
        size_ = size;
        bound_ = bound;
        any_ = any;
        best_ = {};
        another_ = false;
        Members all(x_.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i] = static_cast<std::uint32_t>(i);
        }
        // A good subset at once makes the bound tight: most intervals are left out at the first look.
        descend_from_each_quantile(all);
        const auto [low, high] = std::minmax_element(x_.begin(), x_.end());
        search(*low, *high, std::move(all));
        return best_;
    }

    /// Whether the last search, not for any, met another subset with the same chi-square.
    [[nodiscard]] bool is_unique() const { return !another_ && !has_equal_neighbour(); }

private:
    [[nodiscard]] double f(std::uint32_t i, double y) const {
        const double z = (x_[i] - y) / u_[i];
        return z * z;
    }
    /// f as results are ordered by it: one that has to be a member comes before all others.
    [[nodiscard]] double rank_of(std::uint32_t i, double y) const { return i == member_ ? -1.0 : f(i, y); }
    // Subsets that tie with the best one are still of interest: whether it is the only one is part of the answer.
    [[nodiscard]] double limit() const { return std::min(bound_, best_.chi_square * (1.0 + k_tie)); }

    /// Weighted mean and chi-square of a subset, centred on its most precise member: a mean far from it would round by
    /// more than the uncertainty of that member.
    struct Fit {
        double y = 0.0, chi_square = 0.0, weight = 0.0;
    };
    [[nodiscard]] Fit fit(const Members& members) const {
        const double centre =
            x_[*std::min_element(members.begin(), members.end(), [&](auto a, auto b) { return u_[a] < u_[b]; })];
        double weight = 0.0;
        double sum = 0.0;
        for (const std::uint32_t i : members) {
            const double w = 1.0 / (u_[i] * u_[i]);
            weight += w;
            sum += w * (x_[i] - centre);
        }
        Fit result{.y = sum / weight, .weight = weight};
        for (const std::uint32_t i : members) {
            const double z = (x_[i] - centre - result.y) / u_[i];
            result.chi_square += z * z;
        }
        result.y += centre;
        return result;
    }

    /// The members with the smallest f at y; of equal ones those that come first.
    [[nodiscard]] Members smallest_at(double y, const Members& active) const {
        Members chosen = active;
        const auto smaller = [&](std::uint32_t a, std::uint32_t b) {
            const double f_a = rank_of(a, y);
            const double f_b = rank_of(b, y);
            return f_a < f_b || (f_a == f_b && a < b);
        };
        std::nth_element(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(size_ - 1), chosen.end(),
                         smaller);
        chosen.resize(size_);
        std::sort(chosen.begin(), chosen.end());
        return chosen;
    }

    /// Takes the subset if it is better than the best one so far. Of equal ones the first in the order of numbers
    /// stays.
    Fit consider(Members members) {
        const Fit found = fit(members);
        // The same subset is met again from many y; it is not "another" one.
        if (found.chi_square > bound_ || members == best_.members) {
            return found;
        }
        const bool equal =
            !best_.members.empty() && std::abs(found.chi_square - best_.chi_square) <= k_tie * best_.chi_square;
        // Chi-squares that differ by rounding only are equal. Else the order of the search would decide which subset is
        // reported.
        const bool better = equal ? members < best_.members : found.chi_square < best_.chi_square;
        if (equal) {
            another_ = true;
        } else if (better) {
            another_ = false;
        }
        if (better) {
            best_ = {.members = std::move(members), .chi_square = found.chi_square};
        }
        return found;
    }

    /// From a y to the best subset there, to its mean, to the best subset there, and so on: chi-square falls.
    void descend(double y, const Members& active) {
        constexpr int k_most_steps = 50;
        double before = k_infinity;
        for (int step = 0; step < k_most_steps; ++step) {
            const Fit found = consider(smallest_at(y, active));
            // Each of the two steps, the best members for y and the best y for the members, cannot raise chi-square:
            // when it no longer falls the descent has arrived. It may be a local minimum, so that it bounds the search
            // but does not replace it.
            if (!(found.chi_square < before)) {
                return;
            }
            before = found.chi_square;
            y = found.y;
        }
    }
    void descend_from_each_quantile(const Members& all) {
        constexpr std::size_t k_starts = 16;
        std::vector<double> sorted = x_;
        std::sort(sorted.begin(), sorted.end());
        for (std::size_t start = 1; start < k_starts; ++start) {
            descend(sorted[start * (sorted.size() - 1) / k_starts], all);
        }
    }

    /// What is known of an interval: who belongs to the k smallest everywhere in it, who may.
    struct Interval {
        Members certain, possible;
        double least = 0.0;  // chi-square of a subset of size k that is among the k smallest somewhere in it
    };

    [[nodiscard]] Interval look_at(double low, double high, const Members& active) {
        const std::size_t count = active.size();
        least_.resize(count);
        greatest_.resize(count);
        for (std::size_t j = 0; j < count; ++j) {
            // A parabola is largest at one of the ends of an interval, and smallest at its vertex x_i or, where that
            // lies outside, at the nearer end.
            const double at_low = rank_of(active[j], low);
            const double at_high = rank_of(active[j], high);
            const double x = x_[active[j]];
            least_[j] = x >= low && x <= high && active[j] != member_ ? 0.0 : std::min(at_low, at_high);
            greatest_[j] = std::max(at_low, at_high);
        }
        // Inside: fewer than k others can be smaller. Outside: k others are.
        const double inside_below = count > size_ ? nth(least_, size_) : k_infinity;
        const double outside_above = nth(greatest_, size_ - 1);
        Interval interval;
        possible_least_.clear();
        for (std::size_t j = 0; j < count; ++j) {
            if (greatest_[j] < inside_below) {
                interval.certain.push_back(active[j]);
            } else if (!(least_[j] > outside_above)) {
                interval.possible.push_back(active[j]);
                possible_least_.push_back(least_[j]);
            }
        }
        interval.least = least_of_certain(interval.certain, low, high);
        const std::size_t missing = size_ - interval.certain.size();
        if (missing > 0) {
            const auto end = possible_least_.begin() + static_cast<std::ptrdiff_t>(missing);
            std::nth_element(possible_least_.begin(), end - 1, possible_least_.end());
            for (auto term = possible_least_.begin(); term != end; ++term) {
                interval.least += *term;
            }
        }
        return interval;
    }
    [[nodiscard]] double nth(const std::vector<double>& values, std::size_t rank) {
        scratch_ = values;
        const auto position = scratch_.begin() + static_cast<std::ptrdiff_t>(rank);
        std::nth_element(scratch_.begin(), position, scratch_.end());
        return *position;
    }
    [[nodiscard]] double least_of_certain(const Members& certain, double low, double high) const {
        if (certain.empty()) {
            return 0.0;
        }
        // χ²(y) of a fixed subset is a parabola about its own mean, with curvature Σ 1/u²: its least value in the
        // interval is at the point of the interval that is nearest to that mean.
        const Fit found = fit(certain);
        const double away = std::clamp(found.y, low, high) - found.y;
        return found.chi_square + found.weight * away * away;
    }

    void search(double low, double high, Members active) {
        // Members of a subset of interest have terms up to its chi-square, so the others are left behind.
        const double most = limit() * (1.0 + k_rounding_of_chi_square);
        const auto is_beyond = [&](std::uint32_t i) {
            return !(x_[i] >= low && x_[i] <= high) && std::min(f(i, low), f(i, high)) > most;
        };
        std::erase_if(active, is_beyond);
        if (member_ && is_beyond(*member_)) {
            return;
        }
        if (active.size() < size_ || (any_ && !best_.members.empty())) {
            return;
        }
        const Interval interval = look_at(low, high, active);
        if (interval.least * (1.0 - k_rounding_of_chi_square) > limit()) {
            return;
        }
        const double middle = low + 0.5 * (high - low);
        constexpr std::size_t k_few = 24;
        const std::size_t distinct = distinct_results(interval.possible, k_few);
        // Equal results are exchangeable, so all choices among them have one chi-square; and an interval of two
        // neighbouring numbers cannot be halved.
        if (distinct <= 1 || !(low < middle && middle < high)) {
            consider(smallest_at(middle, active));
            return;
        }
        // Some hundred crossings are cheaper now than to go on halving; near a crossing halving never ends.
        if (distinct <= k_few) {
            compare_pieces(low, high, interval, active);
            return;
        }
        consider(smallest_at(middle, active));
        search(low, middle, active);
        search(middle, high, std::move(active));
    }

    [[nodiscard]] bool same(std::uint32_t a, std::uint32_t b) const {
        const double u = std::min(u_[a], u_[b]);
        return std::abs(x_[a] - x_[b]) <= k_same_result * u && std::abs(u_[a] - u_[b]) <= k_same_result * u;
    }

    /// Representatives of the results that differ from each other; no more than most + 1 are counted.
    std::size_t distinct_results(const Members& results, std::size_t most) {
        representatives_.clear();
        for (const std::uint32_t i : results) {
            const bool known = std::any_of(representatives_.begin(), representatives_.end(),
                                           [&](std::uint32_t other) { return same(i, other); });
            if (!known) {
                representatives_.push_back(i);
            }
            if (representatives_.size() > most) {
                break;
            }
        }
        return representatives_.size();
    }

    /// Divides the interval at all points where two of the doubtful results change places.
    void compare_pieces(double low, double high, const Interval& interval, const Members& active) {
        std::vector<double> ends{low, high};
        const auto add = [&](double y) {
            if (y > low && y < high) {
                ends.push_back(y);
            }
        };
        for (std::size_t j = 0; j < representatives_.size(); ++j) {
            for (std::size_t i = 0; i < j; ++i) {
                std::uint32_t a = representatives_[i];
                std::uint32_t b = representatives_[j];
                if (u_[b] < u_[a]) {
                    std::swap(a, b);  // both points lie closer to the more precise one: they round least from there
                }
                // |x_a − y|/u_a = |x_b − y|/u_b at one point between both results and, with different u, at one beyond
                // the more precise.
                const double gap = x_[b] - x_[a];
                add(x_[a] + gap * u_[a] / (u_[a] + u_[b]));
                if (u_[a] != u_[b]) {
                    add(x_[a] + gap * u_[a] / (u_[a] - u_[b]));
                }
            }
        }
        std::sort(ends.begin(), ends.end());
        for (std::size_t piece = 1; piece < ends.size(); ++piece) {
            const double y = 0.5 * (ends[piece - 1] + ends[piece]);
            if (ends[piece] > ends[piece - 1] && least_in(ends[piece - 1], ends[piece], interval) <= limit()) {
                consider(smallest_at(y, active));
            }
        }
    }

    /// Bound of chi-square in a piece of an interval: the certain ones and the smallest of the doubtful.
    [[nodiscard]] double least_in(double low, double high, const Interval& interval) {
        possible_least_.clear();
        for (const std::uint32_t i : interval.possible) {
            const bool inside = x_[i] >= low && x_[i] <= high;
            possible_least_.push_back(inside ? 0.0 : std::min(f(i, low), f(i, high)));
        }
        double least = least_of_certain(interval.certain, low, high);
        const std::size_t missing = size_ - interval.certain.size();
        std::sort(possible_least_.begin(), possible_least_.end());
        for (std::size_t j = 0; j < missing; ++j) {
            least += possible_least_[j];
        }
        return least * (1.0 - k_rounding_of_chi_square);
    }

    /// Another subset with the same chi-square that differs in one result, as where two laboratories report the same.
    [[nodiscard]] bool has_equal_neighbour() const {
        const Fit found = fit(best_.members);
        for (std::uint32_t outside = 0; outside < x_.size(); ++outside) {
            if (std::binary_search(best_.members.begin(), best_.members.end(), outside)) {
                continue;
            }
            for (const std::uint32_t inside : best_.members) {
                if (std::abs(chi_square_with(found, inside, outside) - best_.chi_square) <= k_tie * best_.chi_square ||
                    same(inside, outside)) {
                    return true;
                }
            }
        }
        return false;
    }
    /// Chi-square with one member exchanged: both terms at y, less what the mean gains by moving.
    [[nodiscard]] double chi_square_with(const Fit& found, std::uint32_t inside, std::uint32_t outside) const {
        const double w_in = 1.0 / (u_[inside] * u_[inside]);
        const double w_out = 1.0 / (u_[outside] * u_[outside]);
        const double pull = w_out * (x_[outside] - found.y) - w_in * (x_[inside] - found.y);
        return found.chi_square + f(outside, found.y) - f(inside, found.y) -
               pull * pull / (found.weight + w_out - w_in);
    }

    std::vector<double> x_, u_;
    std::optional<std::uint32_t> member_;  ///< of every subset
    std::size_t size_ = 0;
    double bound_ = k_infinity;
    bool any_ = false;
    Subset best_;
    bool another_ = false;
    std::vector<double> least_, greatest_, scratch_, possible_least_;  // of look_at(), kept for their memory
    Members representatives_;
};

struct Largest {
    Subset subset;
    bool unique = true;
    Members in_another = {};  ///< ascending, of those outside
};

/// Results outside the subset that another consistent subset of its size holds.
Members in_another_subset(SubsetSearch& search, const Members& members, std::size_t n, double critical) {
    constexpr std::size_t k_most_asked = 100;  // each takes a search
    Members found;
    std::size_t asked = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        if (std::binary_search(members.begin(), members.end(), i)) {
            continue;
        }
        // Of very many that are left out the last ones are not asked: nothing is said against them then.
        if (++asked > k_most_asked || !search.best_with(i, members.size(), critical, true).members.empty()) {
            found.push_back(i);
        }
    }
    return found;
}

/// Where k results are consistent, k − 1 of them are: leaving out the one with the greatest share of chi-square brings
/// χ²/(k − 1) down or leaves it, while the critical value over its degrees of freedom grows (for α up to 0.3).
std::optional<Largest> largest_of_independent(const LaboratoryResults& results, double alpha) {
    const auto n = static_cast<std::size_t>(results.x.size());
    SubsetSearch search(results);
    const auto consistent = [&](std::size_t size) {
        return !search.best_of_size(size, critical_chi_square(size, alpha, k_infinity), true).members.empty();
    };
    if (!consistent(2)) {
        return std::nullopt;
    }
    std::size_t possible = 2;
    std::size_t impossible = n + 1;
    while (impossible - possible > 1) {
        // Most sets of results have few that do not belong: the large sizes first.
        const std::size_t gap = impossible - possible;
        const std::size_t size = impossible == n + 1 ? n : impossible - std::max<std::size_t>(1, gap / 2);
        (consistent(size) ? possible : impossible) = size;
    }
    // The bisection stopped at the first subset of each size; for the final size the best one is wanted.
    const double critical = critical_chi_square(possible, alpha, k_infinity);
    Largest largest{.subset = search.best_of_size(possible, critical, false)};
    largest.unique = search.is_unique();
    largest.in_another = in_another_subset(search, largest.subset.members, n, critical);
    return largest;
}

double correlated_chi_square(const LaboratoryResults& results, const std::vector<std::size_t>& members) {
    const LaboratoryResults part = selected_results(results, members);
    const double centre = part.x(most_precise(part));
    // χ² = |L⁻¹(x − y1)|² with R = L Lᵀ after division by u: a sum of squares, whatever the common value of the
    // results.
    const Eigen::LLT<Eigen::MatrixXd> cholesky(correlations_of(part));
    const Eigen::VectorXd ones = cholesky.matrixL().solve(part.u.cwiseInverse());
    const Eigen::VectorXd x = cholesky.matrixL().solve(Eigen::VectorXd((part.x.array() - centre) / part.u.array()));
    const double y = ones.dot(x) / ones.squaredNorm();
    return (x - y * ones).squaredNorm();
}

/// The next set of `members.size()` numbers below n in lexicographic order; false after the last one.
bool next_combination(std::vector<std::size_t>& members, std::size_t n) {
    const std::size_t k = members.size();
    for (std::size_t i = k; i-- > 0;) {
        if (members[i] < n - k + i) {
            ++members[i];
            for (std::size_t j = i + 1; j < k; ++j) {
                members[j] = members[j - 1] + 1;
            }
            return true;
        }
    }
    return false;
}

Largest best_of_correlated(const LaboratoryResults& results, std::size_t size, double critical) {
    Largest largest;
    std::set<std::uint32_t> consistent;  // in any subset that is
    std::vector<std::size_t> members(size);
    for (std::size_t i = 0; i < size; ++i) {
        members[i] = i;
    }
    do {
        const double chi_square = correlated_chi_square(results, members);
        if (chi_square <= critical) {
            consistent.insert(members.begin(), members.end());
        }
        if (std::abs(chi_square - largest.subset.chi_square) <= k_tie * chi_square) {
            largest.unique = false;
        } else if (chi_square < largest.subset.chi_square) {
            largest = {.subset = {.members = Members(members.begin(), members.end()), .chi_square = chi_square}};
        }
    } while (next_combination(members, static_cast<std::size_t>(results.x.size())));
    std::set_difference(consistent.begin(), consistent.end(), largest.subset.members.begin(),
                        largest.subset.members.end(), std::back_inserter(largest.in_another));
    return largest;
}

std::optional<Largest> largest_of_correlated(const LaboratoryResults& results, double alpha) {
    (void)weighted_mean(results);  // refuses a singular covariance; parts of one that is not are not either
    // With correlations χ² is no sum of one term per result, which the search by intervals rests on: all subsets of a
    // size are compared.
    for (auto size = static_cast<std::size_t>(results.x.size()); size >= 2; --size) {
        const double critical = critical_chi_square(
            size, alpha, results.degrees_of_freedom.size() == 0 ? k_infinity : results.degrees_of_freedom(0));
        Largest largest = best_of_correlated(results, size, critical);
        if (largest.subset.chi_square <= critical) {
            return largest;
        }
    }
    return std::nullopt;
}

void require_possible_search(const LaboratoryResults& results, double alpha) {
    require_results(results);
    require_probability(alpha, "alpha of the consistency test");
    if (alpha > k_largest_alpha) {
        refuse("GC-GUM-0004", "alpha of the consistency test", text::shortest(alpha),
               "the search for the largest consistent subset needs at most " + text::shortest(k_largest_alpha),
               "State the probability of rejecting a good set of results, 0.05 as a rule.");
    }
    const bool correlated = results.covariance.size() != 0;
    const std::size_t most = correlated ? k_most_correlated_results_of_subset : k_most_results_of_subset;
    if (static_cast<std::size_t>(results.x.size()) > most) {
        refuse("GC-GUM-0133", "largest consistent subset",
               std::to_string(results.x.size()) + (correlated ? " correlated results" : " results"),
               "an exact search takes at most " + std::to_string(most),
               correlated ? "Leave the correlations out, or take a median or another reference value."
                          : "Take a median, algorithm A or another reference value that is made for many results.");
    }
}

/// Results in ascending order of x, then of u: of subsets that tie the same one is taken in whatever order the results
/// are listed.
std::vector<Eigen::Index> order_of_values(const LaboratoryResults& results) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(results.x.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return results.x(a) != results.x(b) ? results.x(a) < results.x(b) : results.u(a) < results.u(b);
    });
    return order;
}

LaboratoryResults in_order(const LaboratoryResults& results, const std::vector<Eigen::Index>& order) {
    LaboratoryResults sorted{.x = results.x(order), .u = results.u(order)};
    if (results.covariance.size() > 0) {
        sorted.covariance = results.covariance(order, order);
    }
    if (results.degrees_of_freedom.size() > 0) {
        sorted.degrees_of_freedom = results.degrees_of_freedom(order);
    }
    return sorted;
}

/// Positions in the given order, ascending.
std::vector<std::size_t> as_listed(const Members& members, const std::vector<Eigen::Index>& order) {
    std::vector<std::size_t> listed;
    for (const std::uint32_t member : members) {
        listed.push_back(static_cast<std::size_t>(order[member]));
    }
    std::sort(listed.begin(), listed.end());
    return listed;
}

}  // namespace

ConsistentSubset largest_consistent_subset(const LaboratoryResults& results, double alpha) {
    require_possible_search(results, alpha);
    const std::vector<Eigen::Index> order = order_of_values(results);
    const LaboratoryResults normal = as_normal_results(results);
    const LaboratoryResults sorted = in_order(normal, order);
    const std::optional<Largest> largest =
        results.covariance.size() == 0 ? largest_of_independent(sorted, alpha) : largest_of_correlated(sorted, alpha);
    if (!largest) {
        throw NoResultError(Diagnostic{
            .code = "GC-GUM-0134",
            .where = "largest consistent subset",
            .what = "no two of the " + text::count_of(results.x.size(), "result") + " are consistent with each other",
            .rule = "chi-square of a subset must not exceed its critical value for alpha = " + text::shortest(alpha),
            .action = "Review the uncertainties, or choose a median or a random-effects mean."});
    }
    ConsistentSubset subset;
    subset.members = as_listed(largest->subset.members, order);
    subset.unique = largest->unique;
    subset.in_another = as_listed(largest->in_another, order);
    const LaboratoryResults members = selected_results(results, subset.members);
    subset.mean = spread_weights(weighted_mean(members), subset.members, static_cast<std::size_t>(results.x.size()));
    subset.test = consistency_test(selected_results(normal, subset.members), alpha);
    subset.test.of_finite_degrees = results.degrees_of_freedom.size() > 0;
    return subset;
}

}  // namespace gumcert::gum
