// The uncertainty budget of an end gauge (JCGM 100:2008, H.1), made with the C++ libraries and printed.
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "gum/expression/equation_model.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"
#include "gum/type_b.h"

using namespace gumcert::gum;

namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

struct Input {
    const char* name;
    const char* unit;
    double value, u, degrees_of_freedom;
};

// Values in the unit of the row, as the GUM states them. A rectangular distribution has u = a/√3; relative
// uncertainties of u of 10 % and 50 % mean 50 and 2 degrees of freedom (G.4.2).
const std::vector<Input> k_inputs{
    {"l_s", "nm", 50000623.0, 25.0, 18.0},
    {"d", "nm", 215.0, 5.8, 24.0},
    {"d_1", "nm", 0.0, 3.9, 5.0},
    {"d_2", "nm", 0.0, 6.7, 8.0},
    {"alpha_s", "1/K", 11.5e-6, u_from_half_width(2e-6), k_infinity},
    {"theta", "K", -0.1, 0.2, k_infinity},
    {"Delta", "K", 0.0, 0.5 / std::sqrt(2.0), k_infinity},  // cyclic: arcsine distribution
    {"d_alpha", "1/K", 0.0, u_from_half_width(1e-6), 50.0},
    {"d_theta", "K", 0.0, u_from_half_width(0.05), 2.0},
};

}  // namespace

int main() try {
    // Inside the libraries everything is in coherent SI units; a Unit converts at the border.
    std::vector<InputSymbol> symbols;
    std::vector<InputGroup> groups;
    for (const Input& input : k_inputs) {
        const Unit unit = Unit::parse(input.unit);
        symbols.push_back({.name = input.name, .unit = unit, .constant = {}});
        const double u = unit.difference_to_si(input.u);
        InputGroup group;  // inputs of one group may be correlated; here each stands alone
        group.name = input.name;
        group.value = Eigen::VectorXd::Constant(1, unit.to_si(input.value));
        group.covariance = Eigen::MatrixXd::Constant(1, 1, u * u);
        group.degrees_of_freedom = input.degrees_of_freedom;
        groups.push_back(group);
    }
    const std::vector<EquationText> equations{
        {.text = "l = l_s + d + d_1 + d_2 - l_s*(d_alpha*(theta + Delta) + alpha_s*d_theta)", .where = "model"}};
    const EquationModel model(EquationSystem::compile(equations, symbols), groups);
    const Propagation result = propagate(model, 0.99);

    const Unit nanometre = Unit::parse("nm");
    for (const BudgetContribution& row : result.budget) {
        const double contribution = nanometre.difference_from_si(std::sqrt(row.variance[0]));
        std::printf("%-8s %5.1f nm %5s %%\n", row.name.c_str(), contribution, percent(row.share[0]).c_str());
    }
    const RoundedPair printed = round_to_uncertainty(nanometre.from_si(result.value[0]),
                                                     nanometre.difference_from_si(result.expanded_uncertainty[0]));
    std::printf("l = %s nm, U = %s nm (k = %.2f, %.1f degrees of freedom, p = 99 %%)\n", printed.value.c_str(),
                printed.U.c_str(), result.coverage_factor[0], result.effective_degrees_of_freedom[0]);
    // The model is a product where both factors are near 0: the terms of second order matter (H.1.7).
    if (const auto second = propagate_to_second_order(model, result)) {
        std::printf("u = %.1f nm, with terms of second order %.1f nm\n", 1e9 * result.standard_uncertainty[0],
                    1e9 * second->standard_uncertainty[0]);
    }
    return 0;
} catch (const DiagnosedError& error) {  // carries every problem: where, what is wrong, the rule, what to do
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
