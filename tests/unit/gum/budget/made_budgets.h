#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/type_a.h"

// Budgets made by hand. All numbers are coherent SI.

namespace gumcert::gum::test {

inline BudgetInput input(const std::string& name, const StatedQuantity& stated, const std::string& unit = "1") {
    BudgetInput made;
    made.name = name;
    made.unit = Unit::parse(unit);
    made.constant = stated.statement == "constant";
    made.components = {stated};
    return made;
}

/// An input that is the sum of components, named p, q, r …
inline BudgetInput sum_of(const std::string& name, std::vector<StatedQuantity> components,
                          const std::string& unit = "1") {
    BudgetInput made;
    made.name = name;
    made.unit = Unit::parse(unit);
    char letter = 'p';
    for (StatedQuantity& component : components) {
        component.name = std::string(1, letter++);
    }
    made.components = std::move(components);
    return made;
}

inline StatedQuantity rectangular(double value, double half_width) {
    return state_distribution(Distribution::uniform(value, half_width));
}

inline StatedQuantity shaped(DistributionKind kind, double location, double scale, double shape = 0.0) {
    return state_distribution({.kind = kind, .location = location, .scale = scale, .shape = shape});
}

/// \param file  "": samples of their own
inline StatedQuantity samples(std::vector<double> values, const std::string& file = "") {
    StatedQuantity stated;
    stated.statement = "samples";
    stated.value = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    stated.degrees_of_freedom = static_cast<double>(values.size()) - 1.0;
    if (!file.empty()) {
        stated.sample_file = file;
        stated.sample_rows = std::make_shared<const std::vector<double>>(values);
    }
    std::sort(values.begin(), values.end());
    stated.distribution = {.kind = DistributionKind::empirical,
                           .location = 0.0,
                           .scale = 1.0,
                           .samples = std::make_shared<const std::vector<double>>(std::move(values))};
    stated.u = standard_deviation(stated.distribution);
    return stated;
}

inline Budget budget(const std::vector<std::string>& model, std::vector<BudgetInput> inputs) {
    Budget made;
    for (const std::string& equation : model) {
        made.model.push_back({.text = equation, .where = "model"});
    }
    made.inputs = std::move(inputs);
    return made;
}

inline std::size_t position(const Budget& of, const std::string& name) {
    const auto found =
        std::find_if(of.inputs.begin(), of.inputs.end(), [&](const BudgetInput& i) { return i.name == name; });
    return static_cast<std::size_t>(found - of.inputs.begin());
}

inline void correlate(Budget& of, const std::string& first, const std::string& second, double r) {
    of.correlations.push_back({.first = position(of, first), .second = position(of, second), .r = r});
}

/// All inputs are observations that were made together.
inline void take_together(Budget& of) {
    const auto n = static_cast<Eigen::Index>(of.inputs.front().components.front().observations.size());
    Eigen::MatrixXd readings(n, static_cast<Eigen::Index>(of.inputs.size()));
    SimultaneousInputs set;
    for (std::size_t i = 0; i < of.inputs.size(); ++i) {
        readings.col(static_cast<Eigen::Index>(i)) =
            Eigen::Map<const Eigen::VectorXd>(of.inputs[i].components.front().observations.data(), n);
        set.inputs.push_back(i);
    }
    set.observations = static_cast<std::size_t>(n);
    const Eigen::MatrixXd R = evaluate_simultaneous(readings).correlation;
    for (std::size_t i = 0; i < of.inputs.size(); ++i) {
        for (std::size_t j = i + 1; j < of.inputs.size(); ++j) {
            if (const double r = R(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)); r != 0.0) {
                of.correlations.push_back({.first = i, .second = j, .r = r, .is_computed = true});
            }
        }
    }
    of.simultaneous.push_back(std::move(set));
}

/// A point that states one input anew.
inline BudgetPoint point(const Budget& of, const std::string& name,
                         const std::vector<std::pair<std::string, StatedQuantity>>& stated) {
    BudgetPoint made;
    made.name = name;
    for (const auto& [quantity, statement] : stated) {
        const std::size_t at = position(of, quantity);
        BudgetInput own = of.inputs[at];
        own.components = {statement};
        own.common = false;
        made.inputs.emplace_back(at, std::move(own));
    }
    return made;
}

/// A line V = a + b x through points at x = 0, 1, 2 …, with parameters without units.
inline BudgetFit line(const std::vector<double>& y, double u_y = 0.0) {
    const auto n = static_cast<Eigen::Index>(y.size());
    BudgetFit fit;
    fit.name = "f";
    fit.equation = {.text = "V = a + b*x", .where = "fit"};
    fit.parameters = {{.name = "a", .unit = {}, .start = {}}, {.name = "b", .unit = {}, .start = {}}};
    fit.ordinate = "V";
    fit.regressors = {"x"};
    fit.regressor_units = {Unit()};
    fit.x = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));
    fit.y = Eigen::Map<const Eigen::VectorXd>(y.data(), n);
    if (u_y > 0.0) {
        fit.y_uncertainty = Eigen::MatrixXd::Constant(n, 1, u_y);
    }
    return fit;
}

/// The first result of the first point.
inline BudgetOutputResult first_result(const Budget& of) {
    return evaluate_budget(of, 1).points.at(0).outputs.at(0);
}

inline bool tells(const BudgetResult& result, const std::string& code) {
    return std::any_of(result.notes.begin(), result.notes.end(),
                       [&](const Diagnostic& note) { return note.code == code; });
}

/// The shortest text that reads back as the number.
inline std::string digits(double value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace gumcert::gum::test
