#include "app/budget_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "gum/coverage.h"

namespace gumcert::app {

namespace {

using engine::BudgetInput;
using engine::BudgetJob;
using engine::StatedQuantity;
using gum::Dependence;
using gum::Diagnostic;
using gum::Distribution;
using gum::DistributionKind;
using gum::InputGroup;

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t k_streams_an_input = 4096;  // more components than an input may have

std::string shown(double degrees_of_freedom) {
    if (std::isinf(degrees_of_freedom)) {
        return "infinite";
    }
    std::string text = std::to_string(degrees_of_freedom);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
        text.pop_back();
    }
    return text;
}

/// Sets of inputs that correlations tie together, each ascending, in the order of their first input.
std::vector<std::vector<std::size_t>> clusters(const BudgetJob& job) {
    std::vector<std::size_t> parent(job.inputs.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        return i;
    };
    for (const engine::InputCorrelation& correlation : job.correlations) {
        const std::size_t a = root(correlation.first);
        const std::size_t b = root(correlation.second);
        parent[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::vector<std::size_t>> members(job.inputs.size());
    for (std::size_t i = 0; i < job.inputs.size(); ++i) {
        members[root(i)].push_back(i);
    }
    std::erase_if(members, [](const std::vector<std::size_t>& m) { return m.empty(); });
    return members;
}

/// The distribution of a whole input that is drawn together with others.
Distribution whole_distribution(const BudgetInput& input, const InputTotal& total) {
    if (input.components.size() == 1) {
        return input.components.front().distribution;
    }
    return Distribution::student_t(total.value, total.u, total.degrees_of_freedom);
}

gum::Evaluation evaluation_of(const BudgetInput& input) {
    const bool all_a = std::all_of(input.components.begin(), input.components.end(),
                                   [](const StatedQuantity& q) { return q.evaluation == gum::Evaluation::type_a; });
    return all_a ? gum::Evaluation::type_a : gum::Evaluation::type_b;
}

InputGroup single_group(const std::string& name, const BudgetInput& input, const StatedQuantity& quantity) {
    InputGroup group;
    group.name = name;
    group.source = quantity.source;
    group.unit = gum::Unit::coherent(input.unit.dimension()).text();
    group.evaluation = quantity.evaluation;
    group.distribution = std::string(gum::distribution_name(quantity.distribution.kind));
    group.value = Eigen::VectorXd::Constant(1, quantity.value);
    group.covariance = Eigen::MatrixXd::Constant(1, 1, quantity.u * quantity.u);
    group.degrees_of_freedom = quantity.degrees_of_freedom;
    group.marginals = {quantity.distribution};
    return group;
}

/// Adds inputs that are correlated with each other as one group.
void add_correlated(const BudgetJob& job, const std::vector<std::size_t>& members, std::optional<std::size_t> point,
                    BudgetInputs& result) {
    const auto n = static_cast<Eigen::Index>(members.size());
    InputGroup group;
    group.unit = "mixed units";
    group.evaluation = gum::Evaluation::type_a;
    group.value.resize(n);
    Eigen::VectorXd u(n);
    std::vector<double> degrees_of_freedom;
    for (Eigen::Index i = 0; i < n; ++i) {
        const std::size_t index = members[static_cast<std::size_t>(i)];
        const BudgetInput& input = input_at(job, index, point);
        const InputTotal total = input_total(input);
        group.name += (group.name.empty() ? "" : ", ") + input.name;
        if (evaluation_of(input) == gum::Evaluation::type_b) {
            group.evaluation = gum::Evaluation::type_b;
        }
        group.value(i) = total.value;
        u(i) = total.u;
        degrees_of_freedom.push_back(total.degrees_of_freedom);
        group.marginals.push_back(whole_distribution(input, total));
        result.quantities.push_back({index, BudgetQuantity::k_whole});
    }
    group.covariance = u.array().square().matrix().asDiagonal();
    const auto position = [&](std::size_t input) {
        return static_cast<Eigen::Index>(std::find(members.begin(), members.end(), input) - members.begin());
    };
    for (const engine::InputCorrelation& correlation : job.correlations) {
        const Eigen::Index a = position(correlation.first);
        const Eigen::Index b = position(correlation.second);
        if (a < n && b < n) {
            group.covariance(a, b) = group.covariance(b, a) = correlation.r * u(a) * u(b);
        }
    }

    // Degrees of freedom. Inputs that were observed together, and nothing else, are an ensemble by construction.
    const auto observed =
        std::find_if(job.simultaneous.begin(), job.simultaneous.end(), [&](const engine::SimultaneousInputs& set) {
            std::vector<std::size_t> sorted = set.inputs;
            std::sort(sorted.begin(), sorted.end());
            return sorted == members;
        });
    const bool all_equal = std::all_of(degrees_of_freedom.begin(), degrees_of_freedom.end(),
                                       [&](double nu) { return nu == degrees_of_freedom.front(); });
    if (observed != job.simultaneous.end()) {
        group.degrees_of_freedom = static_cast<double>(observed->observations - 1);
    } else if (all_equal) {
        group.degrees_of_freedom = degrees_of_freedom.front();
        if (!std::isinf(group.degrees_of_freedom)) {
            result.notes.push_back(
                {.code = "GC-BUDGET-0010",
                 .where = "inputs " + group.name,
                 .what = "correlated, with " + shown(group.degrees_of_freedom) + " degrees of freedom each",
                 .rule = "taken as one ensemble of observations, which has that number as a whole",
                 .action = "State `simultaneous` observations where there are some.",
                 .severity = gum::Severity::note});
        }
    } else {
        group.degrees_of_freedom = std::numeric_limits<double>::quiet_NaN();
        group.no_degrees_of_freedom_because =
            "the correlated inputs " + group.name + " have different degrees of freedom (";
        for (std::size_t i = 0; i < degrees_of_freedom.size(); ++i) {
            group.no_degrees_of_freedom_because += (i == 0 ? "" : ", ") + shown(degrees_of_freedom[i]);
        }
        group.no_degrees_of_freedom_because += "), and the Welch-Satterthwaite formula holds for independent ones only";
    }

    // What Monte Carlo draws.
    const auto all_of_kind = [&](DistributionKind kind) {
        return std::all_of(group.marginals.begin(), group.marginals.end(),
                           [&](const Distribution& marginal) { return marginal.kind == kind; });
    };
    const bool same_shape = std::all_of(group.marginals.begin(), group.marginals.end(), [&](const Distribution& m) {
        return m.shape == group.marginals.front().shape;
    });
    if (observed != job.simultaneous.end() && all_of_kind(DistributionKind::student_t)) {
        const std::size_t inputs = members.size();
        if (observed->observations <= inputs) {
            if (job.monte_carlo) {
                throw gum::NoResultError(
                    Diagnostic{.code = "GC-BUDGET-0001",
                               .where = job.monte_carlo->where,
                               .what = std::to_string(observed->observations) + " joint observations of " +
                                       std::to_string(inputs) + " inputs (" + group.name + ")",
                               .rule = "the multivariate t-distribution needs more observations than inputs "
                                       "(JCGM 102:2011, 5.3.2)",
                               .action = "Take more observations, or evaluate without monte_carlo."});
            }
        } else {
            const auto nu = static_cast<double>(observed->observations - inputs);
            const double widening = std::sqrt(static_cast<double>(observed->observations - 1) / nu);
            for (Eigen::Index i = 0; i < n; ++i) {
                group.marginals[static_cast<std::size_t>(i)] =
                    Distribution::student_t(group.value(i), u(i) * widening, nu);
            }
        }
        group.dependence = Dependence::student_t;
    } else if (all_of_kind(DistributionKind::normal)) {
        group.dependence = Dependence::normal;
    } else if (all_of_kind(DistributionKind::student_t) && same_shape) {
        group.dependence = Dependence::student_t;
    } else {
        group.dependence = Dependence::gaussian_copula;
        if (job.monte_carlo) {
            result.notes.push_back(
                {.code = "GC-BUDGET-0011",
                 .where = "inputs " + group.name,
                 .what = "correlated, and not all normal or all t with one number of degrees of freedom",
                 .rule = "Monte Carlo joins them by a Gaussian copula: the coefficients stated are "
                         "those of the normal deviates behind them",
                 .action = "State samples of the joint distribution where it is known.",
                 .severity = gum::Severity::note});
        }
    }
    group.distribution = group.dependence == Dependence::normal      ? "normal"
                         : group.dependence == Dependence::student_t ? "student_t"
                                                                     : "Gaussian copula";
    result.groups.push_back(std::move(group));
}

}  // namespace

BudgetModel::BudgetModel(std::optional<gum::EquationSystem> system, const std::vector<BudgetSymbol>& symbols,
                         std::vector<InputGroup> groups, std::vector<BudgetQuantity> quantities)
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
            outputs_.push_back(
                {system_->output_name(i), gum::Unit::coherent(system_->output_unit(i).dimension()).text()});
        }
        if (system_->unknown_count() > 0) {
            start_ = system_->solve(this->symbols(gum::input_estimates(*this)));
        }
    } else {
        for (const BudgetSymbol& symbol : symbols) {
            outputs_.push_back({symbol.name, gum::Unit::coherent(symbol.unit.dimension()).text()});
        }
    }
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
    return system_ ? system_->evaluate(symbols(x)) : symbols(x);
}

Eigen::MatrixXd BudgetModel::jacobian(const Eigen::VectorXd& x) const {
    const Eigen::MatrixXd by_symbol =
        system_ ? system_->jacobian(symbols(x)) : Eigen::MatrixXd::Identity(symbol_count_, symbol_count_);
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
        return;
    }
    Eigen::MatrixXd z = Eigen::MatrixXd::Zero(x.rows(), symbol_count_);
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
        z.col(static_cast<Eigen::Index>(quantities_[i].symbol)) += x.col(static_cast<Eigen::Index>(i));
    }
    if (system_) {
        system_->evaluate_trials(z, y, start_);
    } else {
        y = z;
    }
}

std::vector<BudgetSymbol> budget_symbols(const BudgetJob& job) {
    std::vector<BudgetSymbol> symbols;
    for (const BudgetInput& input : job.inputs) {
        symbols.push_back({input.name, input.unit});
    }
    for (const engine::BudgetFit& fit : job.fits) {
        for (const engine::BudgetFit::Parameter& parameter : fit.parameters) {
            symbols.push_back({parameter.name, parameter.unit});
        }
    }
    return symbols;
}

const BudgetInput& input_at(const BudgetJob& job, std::size_t input, std::optional<std::size_t> point) {
    if (point) {
        for (const auto& [index, own] : job.points[*point].inputs) {
            if (index == input) {
                return own;
            }
        }
    }
    return job.inputs[input];
}

InputTotal input_total(const BudgetInput& input) {
    if (input.components.size() == 1) {
        const StatedQuantity& only = input.components.front();
        return {.value = only.value, .u = only.u, .degrees_of_freedom = only.degrees_of_freedom};
    }
    InputTotal total;
    double variance = 0.0;
    std::vector<gum::UncertaintyContribution> contributions;
    for (const StatedQuantity& component : input.components) {
        total.value += component.value;
        variance += component.u * component.u;
        contributions.push_back({.uncertainty = component.u, .degrees_of_freedom = component.degrees_of_freedom});
    }
    total.u = std::sqrt(variance);
    total.degrees_of_freedom = gum::effective_degrees_of_freedom(contributions);
    return total;
}

BudgetInputs budget_inputs(const BudgetJob& job, const std::vector<engine::CurveFit>& fits,
                           std::optional<std::size_t> point) {
    BudgetInputs result;
    const auto stream_of = [&](std::size_t input, std::size_t component) {
        const bool own = point && !input_at(job, input, point).common;
        return (own ? std::uint64_t{*point + 1} << 32U : std::uint64_t{0}) + input * k_streams_an_input + component;
    };
    for (const std::vector<std::size_t>& members : clusters(job)) {
        if (members.size() > 1) {
            result.streams.push_back(stream_of(members.front(), 0));
            add_correlated(job, members, point, result);
            continue;
        }
        const std::size_t index = members.front();
        const BudgetInput& input = input_at(job, index, point);
        for (std::size_t c = 0; c < input.components.size(); ++c) {
            const std::string& component = input.components[c].name;
            result.groups.push_back(single_group(component.empty() ? input.name : input.name + ": " + component, input,
                                                 input.components[c]));
            result.quantities.push_back({index, c});
            result.streams.push_back(stream_of(index, c));
        }
    }
    std::size_t symbol = job.inputs.size();
    for (std::size_t f = 0; f < job.fits.size(); ++f) {
        const engine::CurveFit& fit = fits[f];
        InputGroup group;
        group.name = job.fits[f].name;
        group.source = job.fits[f].name;
        group.unit = "mixed units";
        group.evaluation = fit.covariance_scaled ? gum::Evaluation::type_a : gum::Evaluation::type_b;
        group.value = fit.parameters;
        group.covariance = fit.covariance;
        group.degrees_of_freedom = fit.covariance_scaled ? fit.degrees_of_freedom : k_infinity;
        for (Eigen::Index i = 0; i < fit.parameters.size(); ++i) {
            group.marginals.push_back(
                Distribution::student_t(fit.parameters(i), std::sqrt(fit.covariance(i, i)), group.degrees_of_freedom));
            result.quantities.push_back({symbol++, BudgetQuantity::k_whole});
        }
        group.dependence = fit.covariance_scaled ? Dependence::student_t : Dependence::normal;
        group.distribution = fit.covariance_scaled ? "student_t" : "normal";
        result.groups.push_back(std::move(group));
        result.streams.push_back((job.inputs.size() + f) * k_streams_an_input);
    }
    return result;
}

}  // namespace gumcert::app
