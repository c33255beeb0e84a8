#include "audit/correction_effect.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {
namespace {

/// Outcomes of sets of corrections, each evaluated once.
class Outcomes {
public:
    explicit Outcomes(const std::function<BudgetOutcome(const ChosenCorrections&)>& outcome) : outcome_(outcome) {}

    const BudgetOutcome& of(const ChosenCorrections& chosen) {
        const auto found = known_.find(chosen);
        return found != known_.end() ? found->second : known_.emplace(chosen, outcome_(chosen)).first->second;
    }

private:
    const std::function<BudgetOutcome(const ChosenCorrections&)>& outcome_;
    std::map<ChosenCorrections, BudgetOutcome> known_;
};

/// The mean over all sets without i of the change that i makes: weights s!(n − s − 1)!/n! of sets of s corrections.
std::vector<double> exact_shares(Outcomes& outcomes, std::size_t n) {
    std::vector<double> weights(n);
    for (std::size_t s = 0; s < n; ++s) {
        // 1/(n C(n − 1, s))
        double combinations = 1.0;
        for (std::size_t i = 1; i <= s; ++i) {
            combinations = combinations * static_cast<double>(n - i) / static_cast<double>(i);
        }
        weights[s] = 1.0 / (static_cast<double>(n) * combinations);
    }
    std::vector<double> shares(n, 0.0);
    for (std::uint32_t set = 0; set < (1U << n); ++set) {
        ChosenCorrections chosen(n);
        std::size_t size = 0;
        for (std::size_t i = 0; i < n; ++i) {
            chosen[i] = ((set >> i) & 1U) != 0U;
            size += chosen[i] ? 1U : 0U;
        }
        const double before = std::log(outcomes.of(chosen).U);
        for (std::size_t i = 0; i < n; ++i) {
            if (!chosen[i]) {
                chosen[i] = true;
                // ln U, because corrections multiply U: factors of 2 and of 1/2 make no change together, which
                // differences of U would not say.
                shares[i] += weights[size] * (std::log(outcomes.of(chosen).U) - before);
                chosen[i] = false;
            }
        }
    }
    return shares;
}

/// The same over random orders. The generator is written out, so that every build has the same orders.
std::vector<double> sampled_shares(Outcomes& outcomes, std::size_t n, std::size_t orders) {
    std::uint64_t state = 1;
    const auto next = [&state](std::size_t below) {  // SplitMix64
        state += 0x9E3779B97F4A7C15ULL;
        std::uint64_t z = state;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return static_cast<std::size_t>((z ^ (z >> 31U)) % below);
    };
    std::vector<double> shares(n, 0.0);
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t round = 0; round < orders; ++round) {
        // Fisher and Yates: each order has the same probability.
        for (std::size_t i = n - 1; i > 0; --i) {
            std::swap(order[i], order[next(i + 1)]);
        }
        ChosenCorrections chosen(n, false);
        double before = std::log(outcomes.of(chosen).U);
        for (const std::size_t i : order) {
            chosen[i] = true;
            const double after = std::log(outcomes.of(chosen).U);
            shares[i] += (after - before) / static_cast<double>(orders);
            before = after;
        }
    }
    return shares;
}

bool is_seen(const BudgetOutcome& before, const BudgetOutcome& after) {
    return before.rounded_U != after.rounded_U;
}
bool changes_decision(const BudgetOutcome& before, const BudgetOutcome& after) {
    const bool en = before.en && after.en && (std::abs(*before.en) > 1.0) != (std::abs(*after.en) > 1.0);
    return en || verdict_turns(before.verdict, after.verdict);
}

}  // namespace

AuditedBudget without_texts(AuditedBudget budget) {
    for (AuditedRow& row : budget.rows) {
        for (std::string* text : {&row.quantity, &row.unit, &row.place, &row.source, &row.comment, &row.shape_text,
                                  &row.sensitivity_unit, &row.input}) {
            *text = std::string();
        }
        for (std::optional<StatedNumber>* number :
             {&row.estimate, &row.stated, &row.divisor, &row.u, &row.sensitivity, &row.contribution, &row.nu}) {
            if (*number) {
                (*number)->text = (*number)->place = std::string();
            }
        }
    }
    return budget;
}

ShareDivision share_division(std::size_t corrections, std::size_t rows) {
    // Fewer orders for a table of hundreds of rows that are all corrected.
    constexpr std::size_t k_most_rows_copied = 20'000'000;
    const std::size_t an_order = std::max<std::size_t>(corrections, 1) * std::max<std::size_t>(rows, 1);
    return {.is_exact = corrections <= k_exact_shares,
            .orders = std::clamp<std::size_t>(k_most_rows_copied / an_order, 1, k_sampled_orders)};
}

ShareDivision share_division(std::size_t corrections, std::size_t rows, std::size_t nested) {
    constexpr std::size_t k_exact_nested = 4, k_evaluations = 32;
    const ShareDivision of_rows = share_division(corrections, rows);
    if (nested <= k_exact_nested) {
        return of_rows;
    }
    return {.is_exact = false, .orders = std::min(of_rows.orders, std::max<std::size_t>(1, k_evaluations / nested))};
}

std::vector<Effect> effects_of(std::size_t n, const ShareDivision& division,
                               const std::function<BudgetOutcome(const ChosenCorrections&)>& outcome) {
    if (n == 0) {
        return {};
    }
    Outcomes outcomes(outcome);
    const BudgetOutcome claimed = outcomes.of(ChosenCorrections(n, false)),
                        audited = outcomes.of(ChosenCorrections(n, true));
    const std::vector<double> shares =
        division.is_exact ? exact_shares(outcomes, n) : sampled_shares(outcomes, n, division.orders);
    const double log_total = std::accumulate(shares.begin(), shares.end(), 0.0);
    // Of a capability of 1e308 the ratio is infinite; what is stated is a number.
    const double total = std::min(audited.U / claimed.U - 1.0, 1e300);
    std::vector<Effect> effects(n);
    for (std::size_t i = 0; i < n; ++i) {
        ChosenCorrections only(n, false), all_others(n, true);
        // "Alone" is what the correction does to the budget as it was claimed, "last" what it does when all others are
        // made: the two may differ much, and a reader who fixes one thing sees the first.
        only[i] = true;
        all_others[i] = false;
        effects[i].claimed = claimed;
        effects[i].audited = audited;
        effects[i].alone = outcomes.of(only);
        effects[i].last = outcomes.of(all_others);
        // ln U is divided, and the parts are stated in the relative change of U, of which they are the same parts.
        effects[i].share = std::abs(log_total) > 1e-12 ? total * shares[i] / log_total : shares[i];
    }
    return effects;
}

double size_of_change(double U_from, double U_to) {
    constexpr double k_same = 1e-9;
    const double ratio = U_to / U_from;
    return ratio > 0.0 && std::isfinite(ratio) ? k_same * std::round(std::abs(std::log(ratio)) / k_same) : 0.0;
}

std::vector<Effect> effects_of(const AuditedBudget& budget, const std::vector<const Correction*>& corrections) {
    const AuditedBudget bare = without_texts(budget);
    BudgetOutcome itself;
    try {
        itself = evaluate(bare);
    } catch (const gum::DiagnosedError&) {
        return {};
    }
    return effects_of(corrections.size(), share_division(corrections.size(), bare.rows.size()),
                      [&](const ChosenCorrections& chosen) {
                          AuditedBudget corrected = bare;
                          for (std::size_t i = 0; i < corrections.size(); ++i) {
                              if (chosen[i]) {
                                  (*corrections[i])(corrected);
                              }
                          }
                          try {
                              return evaluate(corrected);
                          } catch (const gum::DiagnosedError&) {
                              return itself;  // a correction that leaves nothing to evaluate changes nothing
                          }
                      });
}

std::optional<MissingTerm> missing_term(const AuditedBudget& budget) {
    BudgetOutcome without;
    try {
        without = evaluate(budget);
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
    AuditedBudget more = without_texts(budget);
    more.rows.emplace_back();
    AuditedBudget undecided = more;  // digits do not ask what is decided, which takes longest
    undecided.rule.reset();
    undecided.reference.reset();
    /// The smallest u for which something has changed; nothing where even the largest changes nothing.
    const auto smallest = [&](AuditedBudget& budget_with, const auto& changed) -> std::optional<double> {
        constexpr double k_largest = 100.0;  // in parts of u_c
        const auto changes = [&](double u) {
            budget_with.rows.back().used_u = u;
            return changed(without, evaluate(budget_with));
        };
        double low = 0.0, high = k_largest * without.u_c;
        if (!changes(high)) {
            return std::nullopt;
        }
        // What changes first is looked for from below, in steps of a factor 2.
        for (double u = 1e-4 * without.u_c; u < high; u *= 2.0) {
            if (changes(u)) {
                high = u;
                break;
            }
            low = u;
        }
        while (high - low > 1e-6 * high) {
            const double middle = 0.5 * (low + high);
            (changes(middle) ? high : low) = middle;
        }
        return high;
    };
    MissingTerm term;
    term.u_for_digit = smallest(undecided, is_seen).value_or(0.0);
    term.u_for_verdict = smallest(more, changes_decision);
    term.is_decided = without.undecided.empty();
    return term;
}

}  // namespace gumcert::audit
