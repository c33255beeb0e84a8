#include "gum/budget/budget_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "gum/coverage.h"
#include "gum/monte_carlo/copula_correlation.h"
#include "gum/nearest_correlation.h"
#include "gum/nearest_turn.h"
#include "gum/propagation.h"
#include "gum/quantity/decimal_rounding.h"
#include "gum/quantity/special_values.h"
#include "gum/rounding.h"
#include "text/degrees_of_freedom.h"
#include "text/numbers.h"

namespace gumcert::gum {

// How the inputs of a budget become what is propagated and drawn:
// 1. Inputs tied by correlations or by common readings, directly or through others, make one group: degrees of freedom
// can be combined for independent contributions only (JCGM 100:2008, G.4.1), and a covariance is valid as a whole or
// not at all.
// 2. Columns of one file of samples make one group. All other components are groups of one.
// 3. A group gets values, covariance, degrees of freedom, and what Monte Carlo draws of it; ADR 0025 says why.
// 4. Parameters of fits follow as groups of their own.
// The symbol of an equation is the sum of its components, so that each of them has the sensitivity coefficient of the
// symbol.

namespace {

constexpr std::size_t k_streams_an_input = 4096;  // more components than an input may have

constexpr double k_attained = 1e-9;  // beyond the largest coefficient of correlation: rounding

/// Of random numbers: of one component of an input, at one point of a table or of all that share it. An input that all
/// points share has the same draws at all of them, which makes the results of the points correlated as they are.
std::uint64_t stream_of(std::size_t input, std::size_t component, std::optional<std::size_t> point) {
    // Below 2^32 there is room for a million inputs, so that no two streams have one number; 0 in the upper half is
    // what all points share.
    return (point ? std::uint64_t{*point + 1} << 32U : std::uint64_t{0}) + input * k_streams_an_input + component;
}

std::string shown(double degrees_of_freedom) {
    if (std::isinf(degrees_of_freedom)) {
        return "infinite";
    }
    return text::without_trailing_zeros(text::fixed(degrees_of_freedom, 6));
}

/// Sets of inputs that correlations, or readings taken together, tie to each other, each ascending, in the order of
/// their first input.
std::vector<std::vector<std::size_t>> clusters(const Budget& budget) {
    std::vector<std::size_t> parent(budget.inputs.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        return i;
    };
    const auto join = [&](std::size_t i, std::size_t j) {
        const std::size_t a = root(i);
        const std::size_t b = root(j);
        // The first input stays the root: groups come in the order of the inputs, whatever the order of the
        // correlations.
        parent[std::max(a, b)] = std::min(a, b);
    };
    for (const InputCorrelation& correlation : budget.correlations) {
        join(correlation.first, correlation.second);
    }
    for (const SimultaneousInputs& set : budget.simultaneous) {
        for (const std::size_t input : set.inputs) {
            join(set.inputs.front(), input);
        }
    }
    std::vector<std::vector<std::size_t>> members(budget.inputs.size());
    for (std::size_t i = 0; i < budget.inputs.size(); ++i) {
        members[root(i)].push_back(i);
    }
    std::erase_if(members, [](const std::vector<std::size_t>& m) { return m.empty(); });
    return members;
}

Evaluation evaluation_of(const BudgetInput& input) {
    const bool all_a = std::all_of(input.components.begin(), input.components.end(),
                                   [](const StatedQuantity& q) { return q.evaluation == Evaluation::type_a; });
    return all_a ? Evaluation::type_a : Evaluation::type_b;
}

std::string coherent_unit(const Unit& unit) {
    return Unit::coherent(unit.dimension()).text();
}

InputGroup single_group(const std::string& name, const BudgetInput& input, const StatedQuantity& quantity) {
    InputGroup group;
    group.name = name;
    group.source = quantity.source;
    group.unit = coherent_unit(input.unit);
    group.evaluation = quantity.evaluation;
    group.distribution = std::string(distribution_name(quantity.distribution.kind));
    group.value = Eigen::VectorXd::Constant(1, quantity.value);
    group.covariance = Eigen::MatrixXd::Constant(1, 1, quantity.u * quantity.u);
    group.degrees_of_freedom = quantity.degrees_of_freedom;
    group.marginals = {quantity.distribution};
    return group;
}

std::string printed_coefficient(double r) {
    return round_to_quantum(r, 4);
}

/// A component of an input, as it stands in a group.
struct Member {
    std::size_t input = 0;
    std::size_t component = 0;
    const BudgetInput* stated = nullptr;

    [[nodiscard]] const StatedQuantity& quantity() const { return stated->components[component]; }
    [[nodiscard]] std::string name() const {
        return stated->components.size() == 1 ? stated->name : stated->name + ": " + quantity().name;
    }
};

std::vector<Member> members_of(const Budget& budget, const std::vector<std::size_t>& inputs,
                               std::optional<std::size_t> point) {
    std::vector<Member> members;
    for (const std::size_t input : inputs) {
        const BudgetInput& stated = input_at(budget, input, point);
        for (std::size_t c = 0; c < stated.components.size(); ++c) {
            members.push_back({input, c, &stated});
        }
    }
    return members;
}

/// Values, marginals and quantities of a group, and a covariance without correlations.
void begin_group(const std::vector<Member>& members, InputGroup& group, BudgetInputs& result) {
    const auto n = static_cast<Eigen::Index>(members.size());
    group.evaluation = Evaluation::type_a;
    group.value.resize(n);
    group.covariance = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Member& member = members[static_cast<std::size_t>(i)];
        const StatedQuantity& quantity = member.quantity();
        if (i == 0 || members[static_cast<std::size_t>(i - 1)].input != member.input) {
            group.name += (group.name.empty() ? "" : ", ") + member.stated->name;
        }
        if (evaluation_of(*member.stated) == Evaluation::type_b) {
            group.evaluation = Evaluation::type_b;
        }
        group.value(i) = quantity.value;
        group.covariance(i, i) = quantity.u * quantity.u;
        group.marginals.push_back(quantity.distribution);
        group.quantities.push_back({member.name(), coherent_unit(member.stated->unit)});
        result.quantities.push_back({member.input, member.component});
    }
}

void add_note(BudgetInputs& result, const std::string& code, const std::string& inputs, std::string what,
              std::string rule, std::string action) {
    result.notes.push_back({.code = code,
                            .where = "inputs " + inputs,
                            .what = std::move(what),
                            .rule = std::move(rule),
                            .action = std::move(action),
                            .severity = Severity::note});
}

/// Degrees of freedom of a group of correlated inputs as one contribution.
void set_degrees_of_freedom(const Budget& budget, const std::vector<std::size_t>& inputs,
                            std::optional<std::size_t> point, const SimultaneousInputs* observed, InputGroup& group,
                            BudgetInputs& result) {
    // n sets of readings taken together: every linear combination of the means has n − 1 degrees of freedom.
    if (observed != nullptr) {
        group.degrees_of_freedom = static_cast<double>(observed->observations - 1);
        group.is_estimated_matrix = true;
        return;
    }
    double least = k_infinity;
    double most = 0.0;
    std::string all;
    for (const std::size_t input : inputs) {
        const double nu = input_total(input_at(budget, input, point)).degrees_of_freedom;
        least = std::min(least, nu);
        most = std::max(most, nu);
        all += (all.empty() ? "" : ", ") + shown(nu);
    }
    group.degrees_of_freedom = least;
    if (least == most && !std::isinf(least)) {
        add_note(result, "GC-BUDGET-0010", group.name,
                 "correlated, with " + text::degrees_of_freedom(shown(least)) + " each",
                 "taken as one ensemble of observations, which has that number as a whole",
                 "State `simultaneous` observations where there are some.");
    } else if (least < most) {
        add_note(result, "GC-BUDGET-0012", group.name,
                 "correlated, with different degrees of freedom (" + all + "); " + shown(least) +
                     " are taken for all of them together",
                 "the Welch-Satterthwaite formula holds for independent contributions (JCGM 100:2008, G.4.1); k and "
                 "probabilities are those of the joint distribution that Monte Carlo draws, not of this number",
                 "State `simultaneous` observations where there are some.");
    }
}

/// Correlations of the normal deviates that give the components of a group the coefficients of its covariance.
/// \throws InputError  GC-BUDGET-0002
void set_copula(const std::vector<Member>& members, InputGroup& group, BudgetInputs& result) {
    const auto n = static_cast<Eigen::Index>(members.size());
    const Eigen::MatrixXd R = correlation_matrix(group.covariance);
    std::vector<std::optional<HermiteProfile>> profiles(members.size());
    const HermiteProfile normal(Distribution::normal(0.0, 1.0));
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (members[i].quantity().u > 0.0 && members[i].quantity().distribution.kind != DistributionKind::constant) {
            profiles[i].emplace(members[i].quantity().distribution);
        }
    }
    const auto is_t = [&](std::size_t i) {
        return members[i].quantity().distribution.kind == DistributionKind::student_t;
    };
    // Correlation of the deviates pair by pair, as if a pair were alone; whether all of them exist together is asked
    // below.
    Eigen::MatrixXd N = Eigen::MatrixXd::Identity(n, n);
    std::vector<Diagnostic> problems;
    for (Eigen::Index row = 0; row < n; ++row) {
        for (Eigen::Index column = 0; column < row; ++column) {
            const auto i = static_cast<std::size_t>(column);
            const auto j = static_cast<std::size_t>(row);
            const double r = R(row, column);
            if (r == 0.0 || !profiles[i] || !profiles[j]) {
                continue;
            }
            // Degrees of freedom say how well u is known, not what the quantity is like: t counts as normal here.
            const HermiteProfile& a = is_t(i) ? normal : *profiles[i];
            const HermiteProfile& b = is_t(j) ? normal : *profiles[j];
            const auto [lowest, highest] = HermiteProfile::attainable(a, b);
            // Two quantities of different shape cannot have any coefficient: r = 1 would make one a linear function of
            // the other.
            if (r < lowest - k_attained || r > highest + k_attained) {
                problems.push_back({.code = "GC-BUDGET-0002",
                                    .where = "inputs " + members[i].name() + " and " + members[j].name(),
                                    .what = "correlated with r = " + printed_coefficient(r) + ", as " +
                                            std::string(distribution_name(members[i].quantity().distribution.kind)) +
                                            " and " +
                                            std::string(distribution_name(members[j].quantity().distribution.kind)),
                                    .rule = "two quantities with these distributions have a coefficient from " +
                                            printed_coefficient(lowest) + " to " + printed_coefficient(highest),
                                    .action = "Correct the coefficient, or state distributions of one shape."});
                continue;
            }
            // A quantity keeps its own distribution, and its coefficient with another is then not that of the normal
            // deviates: it is solved for. Taken over as it is, Monte Carlo would have other coefficients than the job
            // states.
            N(row, column) = profiles[i]->has_correlation() && profiles[j]->has_correlation()
                                 ? HermiteProfile::normal_correlation(*profiles[i], *profiles[j], r)
                                 : r;
            N(column, row) = N(row, column);
        }
    }
    if (!problems.empty()) {
        throw InputError(std::move(problems));
    }
    if (!is_positive_semidefinite(N)) {
        // 2 is no limit: no coefficient can move by more.
        const auto nearest = nearest_correlation(N, Eigen::MatrixXd::Constant(n, n, 2.0));
        if (!nearest) {
            throw InputError(
                Diagnostic{.code = "GC-BUDGET-0002",
                           .where = "inputs " + group.name,
                           .what = "the coefficients of correlation cannot hold together for these distributions",
                           .rule = "quantities are drawn by correlated normal deviates, whose matrix is positive "
                                   "semi-definite",
                           .action = "Correct the coefficients, or state distributions of one shape."});
        }
        double most = 0.0;
        for (Eigen::Index row = 0; row < n; ++row) {
            for (Eigen::Index column = 0; column < row; ++column) {
                const auto i = static_cast<std::size_t>(column);
                const auto j = static_cast<std::size_t>(row);
                if (profiles[i] && profiles[j] && profiles[i]->has_correlation() && profiles[j]->has_correlation()) {
                    const double r = HermiteProfile::pearson(*profiles[i], *profiles[j], (*nearest)(row, column));
                    // Told in the coefficients that the job states, not in those of the deviates.
                    most = std::max(most, std::abs(r - R(row, column)));
                }
            }
        }
        N = *nearest;
        add_note(result, "GC-BUDGET-0014", group.name,
                 "no correlated normal deviates give all the stated coefficients; Monte Carlo has the nearest that "
                 "exist, off by " +
                     round_significant(most, 2) + " at most",
                 "a correlation matrix is positive semi-definite",
                 "Correct the coefficients if they are not meant so.");
    }
    group.normal_correlation = std::move(N);
}

/// What Monte Carlo draws of a group of correlated inputs.
void set_dependence(const Budget& budget, const std::vector<Member>& members, const SimultaneousInputs* observed,
                    InputGroup& group, BudgetInputs& result) {
    const auto all_of_kind = [&](DistributionKind kind) {
        return std::all_of(group.marginals.begin(), group.marginals.end(),
                           [&](const Distribution& marginal) { return marginal.kind == kind; });
    };
    const bool same_shape = std::all_of(group.marginals.begin(), group.marginals.end(), [&](const Distribution& m) {
        return m.shape == group.marginals.front().shape;
    });
    const bool single = std::all_of(members.begin(), members.end(),
                                    [](const Member& member) { return member.stated->components.size() == 1; });
    // From the most that is known to the least: an ensemble, jointly normal, jointly t; a copula where the marginals
    // alone are known.
    if (observed != nullptr && all_of_kind(DistributionKind::student_t)) {
        // t with n − 1 degrees of freedom, however many inputs were observed: each linear combination has the
        // distribution of the mean of its n rows then (docs/adr/0030-simultaneous-observations.md).
        for (std::size_t i = 0; i < members.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            group.marginals[i] = Distribution::student_t(group.value(at), std::sqrt(group.covariance(at, at)),
                                                         static_cast<double>(observed->observations - 1));
        }
        group.dependence = Dependence::student_t;
    } else if (all_of_kind(DistributionKind::normal)) {
        group.dependence = Dependence::normal;
    } else if (all_of_kind(DistributionKind::student_t) && same_shape && single) {
        group.dependence = Dependence::student_t;
    } else {
        group.dependence = Dependence::gaussian_copula;
        set_copula(members, group, result);
        // k by convolution takes the copula too, but for normal distributions.
        const bool for_k = !std::all_of(group.marginals.begin(), group.marginals.end(), [](const Distribution& m) {
            return m.kind == DistributionKind::normal || m.kind == DistributionKind::constant;
        });
        if (budget.monte_carlo || for_k) {
            add_note(result, "GC-BUDGET-0011", group.name,
                     "correlated, and not all normal or all t with one number of degrees of freedom",
                     "Monte Carlo joins them by a Gaussian copula that gives them the stated coefficients of "
                     "correlation; a coefficient does not say what else they have in common",
                     "State samples of the joint distribution where it is known.");
        }
    }
    group.distribution = group.dependence == Dependence::normal      ? "normal"
                         : group.dependence == Dependence::student_t ? "student_t"
                                                                     : "Gaussian copula";
}

/// D L with L Lᵀ = R, lower triangular, of inputs of which some are one quantity but for their size: r = ±1, as stated.
///
/// From the covariance, which is rounded, u² of a difference of such inputs is known to some ε of their own u² only, and u
/// to the root of that; from D and R it is known as well as D is: a − b with r = 1 has |u(a) − u(b)|.
/// \return empty where no two inputs are so, or where R is known to rounding only
Eigen::MatrixXd factor_of_stated(const Budget& budget, const std::vector<Member>& members) {
    using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
    constexpr long double k_least_pivot = 1e-14L;  // what is nearer to singular is so by rounding
    std::map<std::size_t, Eigen::Index> place;
    for (const Member& member : members) {
        if (member.stated->components.size() != 1) {
            return {};
        }
        place.emplace(member.input, static_cast<Eigen::Index>(place.size()));
    }
    const auto n = static_cast<Eigen::Index>(members.size());
    Matrix R = Matrix::Identity(n, n);
    bool any = false;
    for (const InputCorrelation& correlation : budget.correlations) {
        const auto first = place.find(correlation.first);
        const auto second = place.find(correlation.second);
        if (first == place.end() || second == place.end()) {
            continue;
        }
        if (correlation.is_computed) {
            return {};
        }
        any = any || std::abs(correlation.r) == 1.0;
        R(first->second, second->second) = R(second->second, first->second) = correlation.r;
    }
    if (!any) {
        return {};
    }
    // Each input is the first one that it is equal to, or the negative of it.
    std::vector<Eigen::Index> firsts, first_of;
    std::vector<long double> sign;
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto equal = std::find_if(firsts.begin(), firsts.end(),
                                        [&](Eigen::Index first) { return std::abs(R(i, first)) == 1.0L; });
        first_of.push_back(equal - firsts.begin());
        sign.push_back(equal == firsts.end() ? 1.0L : R(i, *equal));
        if (equal == firsts.end()) {
            firsts.push_back(i);
        }
    }
    const auto m = static_cast<Eigen::Index>(firsts.size());
    Matrix different(m, m);
    for (Eigen::Index i = 0; i < m; ++i) {
        for (Eigen::Index j = 0; j < m; ++j) {
            different(i, j) = R(firsts[static_cast<std::size_t>(i)], firsts[static_cast<std::size_t>(j)]);
        }
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < i; ++j) {
            const auto a = static_cast<std::size_t>(i);
            const auto b = static_cast<std::size_t>(j);
            // What is correlated with one of two equal inputs otherwise than with the other contradicts them.
            if (R(i, j) != sign[a] * sign[b] * different(first_of[a], first_of[b])) {
                return {};
            }
        }
    }
    const Eigen::LLT<Matrix> root(different);
    if (root.info() != Eigen::Success || !(root.matrixLLT().diagonal().cwiseAbs2().minCoeff() > k_least_pivot)) {
        return {};
    }
    const Matrix L = root.matrixL();
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        for (Eigen::Index c = 0; c <= first_of[at]; ++c) {
            factor(i, firsts[static_cast<std::size_t>(c)]) =
                members[at].quantity().u * static_cast<double>(sign[at] * L(first_of[at], c));
        }
    }
    return factor;
}

/// Adds inputs that are correlated with each other as one group of their components.
void add_correlated(const Budget& budget, const std::vector<std::size_t>& inputs, std::optional<std::size_t> point,
                    BudgetInputs& result) {
    const std::vector<Member> members = members_of(budget, inputs, point);
    InputGroup group;
    begin_group(members, group, result);
    // r u_a u_b is the covariance of two inputs; each component has the part of it that its variance has in that of its
    // input: r (u_i²/u_a)(u_j²/u_b).
    std::map<std::pair<std::size_t, std::size_t>, double> r_of;
    for (const InputCorrelation& correlation : budget.correlations) {
        r_of.emplace(std::minmax(correlation.first, correlation.second), correlation.r);
    }
    std::map<std::size_t, double> u_of;
    for (const std::size_t input : inputs) {
        u_of.emplace(input, input_total(input_at(budget, input, point)).u);
    }
    for (std::size_t j = 0; j < members.size(); ++j) {
        for (std::size_t i = 0; i < j; ++i) {
            const auto found = r_of.find({members[i].input, members[j].input});
            if (found == r_of.end()) {
                continue;
            }
            const auto part = [&](const Member& member) {
                const double u = member.quantity().u;
                return member.stated->components.size() == 1 ? u : u * (u / u_of.at(member.input));
            };
            const auto a = static_cast<Eigen::Index>(i);
            const auto b = static_cast<Eigen::Index>(j);
            group.covariance(a, b) = group.covariance(b, a) = found->second * part(members[i]) * part(members[j]);
        }
    }
    // Inputs that were observed together, and nothing else, are an ensemble by construction.
    const auto observed =
        std::find_if(budget.simultaneous.begin(), budget.simultaneous.end(), [&](const SimultaneousInputs& set) {
            std::vector<std::size_t> sorted = set.inputs;
            std::sort(sorted.begin(), sorted.end());
            return sorted == inputs;
        });
    const SimultaneousInputs* set = observed == budget.simultaneous.end() ? nullptr : &*observed;
    set_degrees_of_freedom(budget, inputs, point, set, group, result);
    set_dependence(budget, members, set, group, result);

    // Where some of the inputs are common to all points and others are not, these are drawn given those.
    const auto is_own = [&](const Member& member) { return point && !member.stated->common; };
    const bool any_shared = !std::all_of(members.begin(), members.end(), is_own);
    result.streams.push_back(stream_of(members.front().input, 0, any_shared ? std::nullopt : point));
    if (any_shared && std::any_of(members.begin(), members.end(), is_own)) {
        for (const Member& member : members) {
            group.own_streams.push_back(is_own(member) ? stream_of(member.input, member.component, point)
                                                       : InputGroup::k_shared);
        }
    } else if (group.dependence == Dependence::normal || group.dependence == Dependence::student_t) {
        group.factor = factor_of_stated(budget, members);  // a copula joins other deviates than the quantities
    }
    result.groups.push_back(std::move(group));
}

/// Adds quantities whose samples come from one file as one group that is drawn by rows.
void add_joint_samples(const std::vector<Member>& members, std::optional<std::size_t> point, BudgetInputs& result) {
    InputGroup group;
    begin_group(members, group, result);
    const auto n = static_cast<Eigen::Index>(members.size());
    const auto rows = static_cast<Eigen::Index>(members.front().quantity().sample_rows->size());
    Eigen::MatrixXd samples(rows, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        const std::vector<double>& column = *members[static_cast<std::size_t>(j)].quantity().sample_rows;
        samples.col(j) = Eigen::Map<const Eigen::VectorXd>(column.data(), rows);
    }
    const Eigen::MatrixXd deviations = samples.rowwise() - group.value.transpose();
    std::string coefficients;
    for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index i = 0; i < j; ++i) {
            // Divisor n, as u of samples has it.
            const double covariance = deviations.col(i).dot(deviations.col(j)) / static_cast<double>(rows);
            // Rounding may take |r| above 1.
            const double scale = std::sqrt(group.covariance(i, i)) * std::sqrt(group.covariance(j, j));
            group.covariance(i, j) = group.covariance(j, i) = std::clamp(covariance, -scale, scale);
            coefficients += (coefficients.empty() ? "r(" : ", r(") + members[static_cast<std::size_t>(i)].name() +
                            ", " + members[static_cast<std::size_t>(j)].name() +
                            ") = " + printed_coefficient(group.covariance(i, j) / scale);
        }
    }
    group.samples = std::make_shared<const Eigen::MatrixXd>(std::move(samples));
    group.dependence = Dependence::joint_samples;
    group.distribution = "joint samples";
    group.degrees_of_freedom = static_cast<double>(rows - 1);
    add_note(result, "GC-BUDGET-0013", group.name,
             "samples of the file " + members.front().quantity().sample_file +
                 ", taken together row by row: " + coefficients,
             "the columns of one file of samples are one joint distribution",
             "Put samples that do not belong together into files of their own.");
    const bool is_own = point && !members.front().stated->common;
    result.streams.push_back(
        stream_of(members.front().input, members.front().component, is_own ? point : std::nullopt));
    result.groups.push_back(std::move(group));
}

/// Quantities with samples of one file, in the order of the inputs; those that a point states apart from the others.
/// \throws InputError  GC-BUDGET-0003
std::vector<std::vector<Member>> joint_samples(const Budget& budget, std::optional<std::size_t> point) {
    // Columns of one file that all points share, and columns that one point states, are drawn by different rows, so
    // that they are two groups.
    std::map<std::pair<std::string, bool>, std::vector<Member>> by_file;
    for (std::size_t i = 0; i < budget.inputs.size(); ++i) {
        const BudgetInput& stated = input_at(budget, i, point);
        for (std::size_t c = 0; c < stated.components.size(); ++c) {
            if (stated.components[c].sample_rows) {
                by_file[{stated.components[c].sample_file, stated.common}].push_back({i, c, &stated});
            }
        }
    }
    std::vector<std::vector<Member>> joint;
    std::vector<Diagnostic> problems;
    for (auto& [key, members] : by_file) {
        if (members.size() < 2) {
            continue;
        }
        for (const InputCorrelation& correlation : budget.correlations) {
            const auto has = [&members = members](std::size_t input) {
                return std::any_of(members.begin(), members.end(), [&](const Member& m) { return m.input == input; });
            };
            // Rows are drawn whole. A coefficient beside them would ask for another joint distribution than the one
            // that the rows are.
            if (has(correlation.first) || has(correlation.second)) {
                const bool both = has(correlation.first) && has(correlation.second);
                problems.push_back(
                    {.code = "GC-BUDGET-0003",
                     .where = "inputs " + budget.inputs[correlation.first].name + " and " +
                              budget.inputs[correlation.second].name,
                     .what = "r = " + printed_coefficient(correlation.r) + " is stated beside samples of the file " +
                             key.first,
                     .rule = both ? "the rows of the file say how its columns are correlated"
                                  : "quantities that are drawn by the rows of a file can be correlated with others by "
                                    "its columns only",
                     .action = both ? "Remove the correlation." : "Add a column for the other input to the file."});
            }
        }
        joint.push_back(std::move(members));
    }
    if (!problems.empty()) {
        throw InputError(std::move(problems));
    }
    return joint;
}

}  // namespace

BudgetModel::BudgetModel(std::optional<EquationSystem> system, const std::vector<InputSymbol>& symbols,
                         std::vector<InputGroup> groups, std::vector<BudgetQuantity> quantities,
                         std::vector<std::size_t> results)
    : system_(std::move(system)),
      symbol_count_(static_cast<Eigen::Index>(symbols.size())),
      groups_(std::move(groups)),
      quantities_(std::move(quantities)) {
    one_to_one_ = quantities_.size() == symbols.size();
    for (std::size_t i = 0; i < quantities_.size() && one_to_one_; ++i) {
        one_to_one_ = quantities_[i].symbol == i;
    }
    if (system_) {
        for (std::size_t i = 0; i < system_->output_count(); ++i) {
            outputs_.push_back({system_->output_name(i), coherent_unit(system_->output_unit(i))});
        }
        unused_.resize(symbols.size());
        for (const std::size_t unused : system_->unused_inputs()) {
            unused_[unused] = true;
        }
        if (system_->unknown_count() > 0) {
            // Implicit models are solved anew in each trial, from here: the solutions of the trials lie about it.
            start_ = system_->solve(this->symbols(input_estimates(*this)));
        }
    } else {
        if (results.empty()) {
            results.resize(symbols.size());
            std::iota(results.begin(), results.end(), std::size_t{0});
        }
        for (const std::size_t result : results) {
            results_.push_back(static_cast<Eigen::Index>(result));
            outputs_.push_back({symbols[result].name, coherent_unit(symbols[result].unit)});
        }
    }
}

bool BudgetModel::uses(std::size_t symbol) const {
    return system_ ? !unused_[symbol]
                   : std::find(results_.begin(), results_.end(), static_cast<Eigen::Index>(symbol)) != results_.end();
}

std::vector<bool> BudgetModel::quantities_of(Eigen::Index output) const {
    std::vector<bool> of_symbols(static_cast<std::size_t>(symbol_count_));
    if (system_) {
        of_symbols = system_->inputs_of(static_cast<std::size_t>(output));
    } else {
        of_symbols[static_cast<std::size_t>(results_[static_cast<std::size_t>(output)])] = true;
    }
    std::vector<bool> used;
    for (const BudgetQuantity& quantity : quantities_) {
        used.push_back(of_symbols[quantity.symbol]);
    }
    return used;
}

Eigen::VectorXd BudgetModel::symbols(const Eigen::VectorXd& x) const {
    if (one_to_one_) {
        return x;
    }
    Eigen::VectorXd z = Eigen::VectorXd::Zero(symbol_count_);
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
        z(static_cast<Eigen::Index>(quantities_[i].symbol)) += x(static_cast<Eigen::Index>(i));
    }
    return z;
}

Eigen::VectorXd BudgetModel::evaluate(const Eigen::VectorXd& x) const {
    Eigen::VectorXd y = system_ ? system_->evaluate(symbols(x)) : Eigen::VectorXd(symbols(x)(results_));
    for (const auto& [output, estimate] : turned_) {
        y(output) = nearest_turn(y(output), estimate);
    }
    return y;
}

std::shared_ptr<const BudgetModel> BudgetModel::turned(Eigen::Index output, const Eigen::VectorXd& values) const {
    auto model = std::make_shared<BudgetModel>(*this);
    model->turned_[output] = values(output);
    return model;
}

Eigen::VectorXd BudgetModel::rounding(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd z = symbols(x);
    return system_ ? system_->rounding(z)
                   : Eigen::VectorXd(z(results_).unaryExpr([](double value) { return decimal_rounding(value); }));
}

Eigen::MatrixXd BudgetModel::by_symbol(const Eigen::VectorXd& x) const {
    if (system_) {
        return system_->jacobian(symbols(x));
    }
    Eigen::MatrixXd chosen = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(results_.size()), symbol_count_);
    for (std::size_t i = 0; i < results_.size(); ++i) {
        chosen(static_cast<Eigen::Index>(i), results_[i]) = 1.0;
    }
    return chosen;
}

Eigen::MatrixXd BudgetModel::jacobian(const Eigen::VectorXd& x) const {
    const Eigen::MatrixXd by_symbol = this->by_symbol(x);
    if (one_to_one_) {
        return by_symbol;
    }
    Eigen::MatrixXd by_quantity(by_symbol.rows(), static_cast<Eigen::Index>(quantities_.size()));
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
        by_quantity.col(static_cast<Eigen::Index>(i)) = by_symbol.col(static_cast<Eigen::Index>(quantities_[i].symbol));
    }
    return by_quantity;
}

std::vector<Eigen::MatrixXd> BudgetModel::hessians(const Eigen::VectorXd& x) const {
    const auto n = static_cast<Eigen::Index>(quantities_.size());
    if (!system_) {
        return std::vector<Eigen::MatrixXd>(outputs_.size(), Eigen::MatrixXd::Zero(n, n));
    }
    std::vector<Eigen::MatrixXd> all = system_->hessians(symbols(x));
    if (one_to_one_) {
        return all;
    }
    for (Eigen::MatrixXd& H : all) {
        Eigen::MatrixXd by_quantity(n, n);
        for (Eigen::Index j = 0; j < n; ++j) {
            for (Eigen::Index i = 0; i < n; ++i) {
                by_quantity(i, j) = H(static_cast<Eigen::Index>(quantities_[static_cast<std::size_t>(i)].symbol),
                                      static_cast<Eigen::Index>(quantities_[static_cast<std::size_t>(j)].symbol));
            }
        }
        H = std::move(by_quantity);
    }
    return all;
}

void BudgetModel::evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const {
    if (one_to_one_ && system_) {
        system_->evaluate_trials(x, y, start_);
    } else {
        const Eigen::MatrixXd z = symbols_of_trials(x);
        if (system_) {
            system_->evaluate_trials(z, y, start_);
        } else {
            y = z(Eigen::all, results_);
        }
    }
    turn(y);
}

void BudgetModel::evaluate_as_chosen(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const {
    system_->evaluate_as_chosen(symbols(input_estimates(*this)), symbols_of_trials(x), y, start_);
    turn(y);
}

Eigen::MatrixXd BudgetModel::symbols_of_trials(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
    Eigen::MatrixXd z = Eigen::MatrixXd::Zero(x.rows(), symbol_count_);
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
        z.col(static_cast<Eigen::Index>(quantities_[i].symbol)) += x.col(static_cast<Eigen::Index>(i));
    }
    return z;
}

void BudgetModel::turn(Eigen::Ref<Eigen::MatrixXd> y) const {
    for (const auto& [output, estimate] : turned_) {
        y.col(output) = y.col(output).unaryExpr([to = estimate](double angle) { return nearest_turn(angle, to); });
    }
}

std::vector<InputSymbol> budget_symbols(const Budget& budget) {
    std::vector<InputSymbol> symbols;
    for (const BudgetInput& input : budget.inputs) {
        symbols.push_back({input.name, input.unit, std::nullopt});
    }
    for (const BudgetFit& fit : budget.fits) {
        for (const BudgetFit::Parameter& parameter : fit.parameters) {
            symbols.push_back({parameter.name, parameter.unit, std::nullopt});
        }
    }
    return symbols;
}

BudgetInputs budget_inputs(const Budget& budget, const std::vector<engine::CurveFit>& fits,
                           std::optional<std::size_t> point) {
    BudgetInputs result;
    std::vector<std::vector<Member>> joint = joint_samples(budget, point);
    const auto group_of = [&](std::size_t input, std::size_t component) {
        return std::find_if(joint.begin(), joint.end(), [&](const std::vector<Member>& members) {
            return std::any_of(members.begin(), members.end(), [&](const Member& member) {
                return member.input == input && member.component == component;
            });
        });
    };
    for (const std::vector<std::size_t>& members : clusters(budget)) {
        if (members.size() > 1) {
            add_correlated(budget, members, point, result);
            continue;
        }
        const std::size_t index = members.front();
        const BudgetInput& input = input_at(budget, index, point);
        for (std::size_t c = 0; c < input.components.size(); ++c) {
            if (const auto together = group_of(index, c); together != joint.end()) {
                // The group stands at the place of its first member; the others find it there already.
                if (together->front().input == index && together->front().component == c) {
                    add_joint_samples(*together, point, result);
                }
                continue;
            }
            const std::string& component = input.components[c].name;
            result.groups.push_back(single_group(component.empty() ? input.name : input.name + ": " + component, input,
                                                 input.components[c]));
            result.quantities.push_back({index, c});
            result.streams.push_back(stream_of(index, c, input.common ? std::nullopt : point));
        }
    }
    std::size_t symbol = budget.inputs.size();
    for (std::size_t f = 0; f < budget.fits.size(); ++f) {
        const engine::CurveFit& fit = fits[f];
        InputGroup group;
        group.name = budget.fits[f].name;
        group.source = budget.fits[f].name;
        // A covariance that is scaled by the residuals has one estimated variance for all parameters: together they are
        // t with its degrees of freedom. Where the uncertainties of the points are stated, nothing is estimated:
        // normal.
        group.evaluation = fit.covariance_scaled ? Evaluation::type_a : Evaluation::type_b;
        group.value = fit.parameters;
        group.covariance = fit.covariance;
        group.factor = fit.factor;
        group.degrees_of_freedom = fit.covariance_scaled ? fit.degrees_of_freedom : k_infinity;
        for (Eigen::Index i = 0; i < fit.parameters.size(); ++i) {
            group.marginals.push_back(
                Distribution::student_t(fit.parameters(i), std::sqrt(fit.covariance(i, i)), group.degrees_of_freedom));
            const BudgetFit::Parameter& parameter = budget.fits[f].parameters[static_cast<std::size_t>(i)];
            group.quantities.push_back({parameter.name, coherent_unit(parameter.unit)});
            result.quantities.push_back({symbol++, BudgetQuantity::k_whole});
        }
        group.dependence = fit.covariance_scaled ? Dependence::student_t : Dependence::normal;
        group.distribution = fit.covariance_scaled ? "student_t" : "normal";
        result.groups.push_back(std::move(group));
        // A fit belongs to no point: its parameters have the same draws at all points of a table.
        result.streams.push_back((budget.inputs.size() + f) * k_streams_an_input);
    }
    return result;
}

}  // namespace gumcert::gum
