#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gum/expression/equation_model.h"
#include "gum/expression/equation_system.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/demand.h"

namespace gumcert::fuzz {
namespace {

constexpr std::array<const char*, 4> k_quantities{"a", "b", "c", "d"};

/// A sum of a random tree of operations, with all the parentheses that it may need.
std::string expression_from(ByteSource& bytes, int depth) {
    static constexpr std::array<const char*, 13> k_functions{"sqrt", "exp",  "ln",   "log10", "sin",  "cos", "tan",
                                                             "asin", "acos", "atan", "sinh",  "tanh", "abs"};
    static constexpr std::array<const char*, 5> k_operators{" + ", " - ", "*", "/", "^"};
    static constexpr std::array<const char*, 5> k_of_two{"atan2", "min", "max", "pow", "hypot"};
    if (depth == 0 || bytes.empty()) {
        return k_quantities[bytes.below(k_quantities.size())];
    }
    switch (bytes.below(8)) {
        case 0:
            return k_quantities[bytes.below(k_quantities.size())];
        case 1:
            return std::to_string(bytes.below(8)) + "." + std::to_string(bytes.below(100));
        case 2:
            return std::string(k_functions[bytes.below(k_functions.size())]) + "(" + expression_from(bytes, depth - 1) +
                   ")";
        case 3: {
            const char* const name = k_of_two[bytes.below(k_of_two.size())];
            const std::string first = expression_from(bytes, depth - 1);
            return std::string(name) + "(" + first + ", " + expression_from(bytes, depth - 1) + ")";
        }
        default: {
            const char* const sign = k_operators[bytes.below(k_operators.size())];
            const std::string left = expression_from(bytes, depth - 1);
            return "(" + left + sign + expression_from(bytes, depth - 1) + ")";
        }
    }
}

/// Four quantities near 1, each with an uncertainty of its own far below; the first two may be correlated.
std::vector<gum::InputGroup> inputs_from(ByteSource& bytes) {
    const auto value = [&] { return (bytes.below(4) == 0 ? -1.0 : 1.0) * std::exp2(-2.0 + 4.0 * bytes.share()); };
    const auto u = [&](double x) { return std::abs(x) * std::pow(10.0, -6.0 + 3.0 * bytes.share()); };
    gum::InputGroup pair;
    pair.name = "a and b";
    pair.value = Eigen::Vector2d(value(), value());
    const double u_a = u(pair.value(0)), u_b = u(pair.value(1));
    const double covariance = (2.0 * bytes.share() - 1.0) * 0.99 * u_a * u_b;
    pair.covariance = (Eigen::Matrix2d() << u_a * u_a, covariance, covariance, u_b * u_b).finished();
    std::vector<gum::InputGroup> groups{pair};
    for (const char* const name : {"c", "d"}) {
        gum::InputGroup group;
        group.name = name;
        group.value = Eigen::VectorXd::Constant(1, value());
        const double own = u(group.value(0));
        group.covariance = Eigen::MatrixXd::Constant(1, 1, own * own);
        groups.push_back(group);
    }
    return groups;
}

Eigen::MatrixXd joint_covariance(const gum::MeasurementModel& model) {
    const Eigen::VectorXd x = gum::input_estimates(model);
    Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(x.size(), x.size());
    Eigen::Index at = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        joint.block(at, at, group.size(), group.size()) = group.covariance;
        at += group.size();
    }
    return joint;
}

/// Sensitivity coefficients by differences, and how well each is known: by comparing two steps.
struct Differences {
    Eigen::RowVectorXd c, error;
};

std::optional<Differences> by_differences(const gum::EquationModel& model, const Eigen::VectorXd& x) {
    Differences found{.c = Eigen::RowVectorXd(x.size()), .error = Eigen::RowVectorXd(x.size())};
    const double y = std::abs(model.evaluate(x)(0)) + 1e5 * model.system().rounding(x)(0);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const auto slope = [&](double step) {
            Eigen::VectorXd above = x, below = x;
            above(i) += step;
            below(i) -= step;
            return (model.evaluate(above)(0) - model.evaluate(below)(0)) / (above(i) - below(i));
        };
        const double step = 2e-4 * std::abs(x(i));
        const double wide = slope(step), narrow = slope(step / 2.0), narrowest = slope(step / 4.0);
        // Richardson: the error of a central difference falls with the square of the step.
        const double extrapolated = (4.0 * narrow - wide) / 3.0;
        found.c(i) = (4.0 * narrowest - narrow) / 3.0;
        found.error(i) =
            4.0 * std::abs(found.c(i) - extrapolated) + 1e-10 * y / std::abs(x(i)) + 1e-9 * std::abs(found.c(i));
    }
    return found.c.allFinite() && found.error.allFinite() ? std::optional(found) : std::nullopt;
}

/// Whether the model is straight over some steps of u, so that its trials have the u of the law of propagation: no kink or
/// pole is near, and the terms of second order are small.
bool is_straight(const gum::EquationModel& model, const Eigen::VectorXd& x, const gum::Propagation& first) {
    const double u = first.standard_uncertainty(0);
    if (!(u > 1e-14 * std::abs(first.value(0)))) {
        return false;
    }
    constexpr double k_steps = 8.0;  // of u: no trial of thousands is farther off
    const Eigen::VectorXd scatter = joint_covariance(model).diagonal().cwiseSqrt();
    for (unsigned corner = 0; corner < 16; ++corner) {
        Eigen::VectorXd far = x;
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            far(i) += ((corner >> static_cast<unsigned>(i) & 1U) == 0 ? -k_steps : k_steps) * scatter(i);
        }
        const double expected = first.value(0) + first.jacobian.row(0).dot(far - x);
        if (!(std::abs(model.evaluate(far)(0) - expected) < 0.02 * u)) {
            return false;
        }
    }
    return true;
}

/// Trials scatter as the law of propagation says.
void compare_trials(const gum::EquationModel& model, const gum::Propagation& first, std::uint64_t seed) {
    constexpr std::uint64_t k_trials = 2048;
    const gum::MonteCarloResult trials = gum::run_monte_carlo(model, {.trials = k_trials,
                                                                      .adaptive = {},
                                                                      .seed = seed,
                                                                      .streams = {},
                                                                      .has_no_variance = {},
                                                                      .threads = 1,
                                                                      .regions = false,
                                                                      .histogram = false,
                                                                      .progress = {},
                                                                      .memory = {}});
    const double u = first.standard_uncertainty(0);
    // Of normal trials s has the relative standard deviation 1/sqrt(2 M); 7 of them happen once in 10^11 times.
    const double ratio = trials.outputs[0].standard_uncertainty / u;
    demand(std::abs(ratio - 1.0) < 7.0 / std::sqrt(2.0 * k_trials) + 0.005, "trials scatter otherwise");
    demand(std::abs(trials.outputs[0].mean - first.value(0)) < (7.0 / std::sqrt(1.0 * k_trials) + 0.02) * u,
           "trials lie elsewhere");
}

void propagate_model(ByteSource& bytes) {
    std::vector<gum::InputGroup> groups = inputs_from(bytes);
    const std::uint64_t seed = bytes.bits(4);
    const std::vector<gum::EquationText> equations{{"y = " + expression_from(bytes, 5), "fuzz"}};
    std::vector<gum::InputSymbol> symbols;
    for (const char* const name : k_quantities) {
        symbols.push_back({.name = name, .unit = gum::Unit(), .constant = {}});
    }
    const gum::EquationModel model(gum::EquationSystem::compile(equations, symbols), std::move(groups));
    const Eigen::VectorXd x = gum::input_estimates(model);
    const gum::Propagation first = gum::propagate(model, 0.9545);
    const Eigen::RowVectorXd c = model.jacobian(x).row(0);
    demand(first.jacobian.row(0) == c, "other sensitivity coefficients");
    const Eigen::MatrixXd V = joint_covariance(model);
    const double u2 = c * V * c.transpose();
    const double size = c.cwiseAbs() * V.cwiseAbs() * c.cwiseAbs().transpose();
    const double u = first.standard_uncertainty(0);
    demand(std::abs(u * u - std::max(u2, 0.0)) <= 1e-12 * size, "another u than c V c");
    double sum = 0.0;
    for (const gum::BudgetContribution& contribution : first.budget) {
        demand(contribution.variance(0) >= 0.0, "a negative variance");
        sum += contribution.variance(0);
    }
    demand(std::abs(sum - u * u) <= 1e-12 * size, "contributions that do not sum to u");
    if (!is_straight(model, x, first)) {
        return;  // a kink, a pole or a bend: differences and trials say something else there
    }
    if (const auto found = by_differences(model, x)) {
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            demand(std::abs(found->c(i) - c(i)) <= found->error(i) + 1e-8 * std::abs(c(i)),
                   "differences say otherwise");
        }
    }
    compare_trials(model, first, seed);
}

}  // namespace
}  // namespace gumcert::fuzz

/// A random model of up to four quantities: the law of propagation, differences and trials agree, or it is told why there is
/// no result.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gumcert::fuzz::ByteSource bytes({reinterpret_cast<const char*>(data), size});
    try {
        gumcert::fuzz::propagate_model(bytes);
    } catch (const gumcert::gum::InputError&) {
        return 0;
    } catch (const gumcert::gum::NoResultError&) {
        return 0;
    }
    return 0;
}
