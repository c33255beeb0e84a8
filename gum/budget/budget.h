#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gum/budget/stated_quantity.h"
#include "gum/coverage_choice.h"
#include "gum/expression/equation_system.h"
#include "gum/monte_carlo/monte_carlo_request.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"

namespace gumcert::gum {

struct BudgetInput {
    std::string name;
    Unit unit;
    bool constant = false;                   ///< u = 0 on purpose
    std::vector<StatedQuantity> components;  ///< one, or several that are added up
    /// Where the budget has a table of points: true when all points share the quantity, so that their results are
    /// correlated through it; false when each point has one of its own.
    bool common = true;
    /// False where only the points of the table state the quantity: what stands here is what the first of them says.
    bool stated = true;
    std::string where;  ///< place to name in messages
};

/// Correlation coefficient of two inputs, from any of the ways to state it. Never 0.
struct InputCorrelation {
    std::size_t first = 0, second = 0;  ///< positions in Budget::inputs
    double r = 0.0;
    bool is_computed = false;  ///< of a covariance or of readings: known to rounding, where a stated one is exact
};

/// Inputs that were observed together (JCGM 100:2008, 5.2.3): their correlations are in `correlations` as well.
struct SimultaneousInputs {
    std::vector<std::size_t> inputs;
    std::size_t observations = 0;  ///< n, of each
};

/// A least-squares fit whose parameters become inputs of the model.
struct BudgetFit {
    std::string name;
    EquationText equation;  ///< "V = a + b*t": the left side was observed
    struct Parameter {
        std::string name;
        Unit unit;
        std::optional<double> start;  ///< coherent SI; needed unless the equation is linear in the parameters
    };
    std::vector<Parameter> parameters;
    std::string ordinate;  ///< name of the left side
    Unit ordinate_unit;
    std::vector<std::string> regressors;  ///< names of the columns on the right side
    std::vector<Unit> regressor_units;
    Eigen::MatrixXd x;              ///< n×q, coherent SI
    Eigen::VectorXd y;              ///< n, coherent SI
    Eigen::MatrixXd y_uncertainty;  ///< empty, n×1 standard uncertainties or n×n covariance, coherent SI
    Eigen::MatrixXd x_uncertainty;  ///< the same of the only regressor
    /// With which the data are written: of each regressor, then of the ordinate; empty where nobody knows.
    std::vector<int> decimals = {};
    bool scale_by_residuals = false;
    std::string where;
};

/// One point of a table: the inputs that it states itself, in place of those of the budget.
struct BudgetPoint {
    std::string name;                                         ///< for messages and names of results
    std::vector<std::pair<std::size_t, BudgetInput>> inputs;  ///< position in Budget::inputs and what stands there
};

struct BudgetOutput {
    std::string name;
    std::optional<Unit> unit;
    std::optional<double> coverage_probability;
    std::optional<CoverageChoice> coverage;  ///< none: that of the budget
    std::string where;
};

/// Results that come from equations of their own, at points of their own, among others of one budget: DC voltage and
/// resistance of one instrument. Inputs, correlations and fits are those of the budget, so that what sections have in
/// common correlates their results. Equations, unknowns, outputs and points of a budget are those of its sections, one
/// section after the other.
struct BudgetSection {
    std::string name;
    std::size_t equations = 0;  ///< 0: inputs and parameters of fits are the results, those that `outputs` names
    std::size_t unknowns = 0, outputs = 0;
    std::size_t points = 0;  ///< 0: one evaluation
};

/// An uncertainty budget to be evaluated (gum/budget/evaluate_budget.h): measurement model, inputs in coherent SI, and
/// what is asked for.
struct Budget {
    double coverage_probability = 0.9545;
    CoverageChoice coverage = CoverageChoice::as_validated;  ///< of all results that do not state their own
    /// ν_eff is cut to the next lower whole number before k is taken, as the tables of JCGM 100:2008, G.4.1 and EA-4/02
    /// want it.
    bool truncate_degrees_of_freedom = false;
    RoundingMode rounding = RoundingMode::half_even;  ///< of printed expanded uncertainties
    std::vector<EquationText> model;  ///< empty: the inputs and the parameters of the fits are the results
    std::vector<UnknownSymbol> unknowns;
    std::vector<BudgetInput> inputs;
    std::vector<InputCorrelation> correlations;
    std::vector<SimultaneousInputs> simultaneous;
    std::vector<BudgetFit> fits;
    std::vector<BudgetOutput> outputs;    ///< empty: those of the model
    std::vector<BudgetPoint> points;      ///< empty: one evaluation
    std::vector<BudgetSection> sections;  ///< empty: the budget is one
    std::optional<MonteCarloRequest> monte_carlo;
};

/// What the equations of a budget may use: its inputs, then the parameters of its fits, each in their order. The value
/// of a constant is with it unless a point of the table states another one.
[[nodiscard]] std::vector<InputSymbol> model_inputs(const Budget& budget);
/// What is asked of the equations, in the order of the budget; empty: what the model gives by itself.
[[nodiscard]] std::vector<OutputSymbol> model_outputs(const Budget& budget);

/// A section as a budget of its own: its equations, unknowns, outputs and points, and all inputs, correlations and fits.
/// \param section  position in Budget::sections
[[nodiscard]] Budget budget_of_section(const Budget& budget, std::size_t section);

/// Where the points of a section begin in Budget::points.
[[nodiscard]] std::size_t first_point_of(const Budget& budget, std::size_t section);

/// The section that a point of the table belongs to; nothing in a budget without sections.
[[nodiscard]] std::optional<std::size_t> section_of_point(const Budget& budget, std::size_t point);

/// The input of a budget that holds at a point of its table.
/// \param point  position in Budget::points, or nothing
[[nodiscard]] const BudgetInput& input_at(const Budget& budget, std::size_t input, std::optional<std::size_t> point);

/// Estimate, standard uncertainty and degrees of freedom (Welch–Satterthwaite) of an input as the sum of its
/// components.
struct InputTotal {
    double value = 0.0, u = 0.0;
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
};
[[nodiscard]] InputTotal input_total(const BudgetInput& input);

}  // namespace gumcert::gum
