#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gum/expression/equation_model.h"
#include "gum/monte_carlo/monte_carlo.h"

namespace gumcert::gum {

constexpr double k_gauge_block_probability = 0.99;

/// The gauge block of JCGM 101:2008, 9.5, as examples/gauge_block/job.json has it: an equation with units, nine
/// uncertain inputs and a constant.
inline EquationModel gauge_block() {
    std::vector<InputSymbol> symbols;
    std::vector<InputGroup> groups;
    const auto add = [&](std::string name, std::string_view unit, const Distribution& marginal, double u, double nu) {
        symbols.push_back({.name = name, .unit = Unit::parse(unit), .constant = {}});
        if (marginal.kind == DistributionKind::constant) {
            symbols.back().constant = marginal.location;
        }
        InputGroup& group = groups.emplace_back();
        group.name = std::move(name);
        group.unit = unit;
        group.distribution = std::string(distribution_name(marginal.kind));
        group.value = Eigen::VectorXd::Constant(1, marginal.location);
        group.covariance = Eigen::MatrixXd::Constant(1, 1, u * u);
        group.degrees_of_freedom = nu;
        group.marginals = {marginal};
    };
    const auto add_student_t = [&](std::string name, double value, double u, double nu) {
        add(std::move(name), "m", Distribution::student_t(value, u, nu), u, nu);
    };
    const auto add_stated = [&](std::string name, std::string_view unit, const Distribution& marginal) {
        add(std::move(name), unit, marginal, standard_deviation(marginal), std::numeric_limits<double>::infinity());
    };
    add_student_t("L_s", 50000623e-9, 25e-9, 18.0);
    add_stated("L_nom", "m", Distribution::constant(50e-3));
    add_student_t("D", 215e-9, 6e-9, 24.0);
    add_student_t("d_1", 0.0, 4e-9, 5.0);
    add_student_t("d_2", 0.0, 7e-9, 8.0);
    add_stated("alpha_s", "1/K", Distribution::uniform(11.5e-6, 2e-6));
    add_stated("theta_0", "K", Distribution::normal(-0.1, 0.2));
    add_stated("Delta", "K", {.kind = DistributionKind::arcsine, .scale = 0.5});
    add_stated("d_alpha", "1/K", {.kind = DistributionKind::curvilinear_trapezoid, .scale = 1e-6, .shape = 0.1});
    add_stated("d_theta", "K", {.kind = DistributionKind::curvilinear_trapezoid, .scale = 0.05, .shape = 0.5});
    const std::vector<EquationText> equations{
        {.text = "dL = L_s + D + d_1 + d_2 - L_s*(d_alpha*(theta_0 + Delta) + alpha_s*d_theta) - L_nom",
         .where = "gauge block"}};
    return {EquationSystem::compile(equations, symbols), std::move(groups)};
}

/// Shortest interval and histogram are always found.
inline MonteCarloOptions gauge_block_options() {
    MonteCarloOptions options;
    options.trials = 1'000'000;
    options.coverage_probability = k_gauge_block_probability;
    return options;
}

}  // namespace gumcert::gum
