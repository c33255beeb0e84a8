#include "audit/rules/budget_model.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "audit/row_meaning.h"
#include "gum/expression/name.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::audit {
namespace {

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) {
        return "";
    }
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

std::vector<gum::EquationText> equations_of(const AuditedBudget& budget) {
    std::vector<gum::EquationText> equations;
    std::string_view rest = budget.equation;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_of("\n;"), rest.size());
        std::string one = trimmed(rest.substr(0, end));
        if (!one.empty()) {
            equations.push_back({.text = std::move(one), .where = budget.place});
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return equations;
}

/// The row that stands for a quantity: by its whole name, else by the first word of it. All parts of one that is a sum;
/// none where there is no row, or another one beside it.
std::vector<std::size_t> rows_of(const AuditedBudget& budget, const std::string& name) {
    std::vector<std::size_t> parts;
    for (std::size_t i = 0; i < budget.rows.size(); ++i) {
        if (!budget.rows[i].part_of.empty() && gum::canonical_name(budget.rows[i].part_of) == name) {
            parts.push_back(i);
        }
    }
    if (!parts.empty()) {
        return parts;
    }
    const auto find = [&](const auto& name_of) -> std::optional<std::size_t> {
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < budget.rows.size(); ++i) {
            if (budget.rows[i].part_of.empty() && gum::canonical_name(name_of(budget.rows[i].quantity)) == name) {
                if (found) {
                    return std::nullopt;  // two rows for one name: neither is taken
                }
                found = i;
            }
        }
        return found;
    };
    std::optional<std::size_t> row = find([](const std::string& quantity) { return trimmed(quantity); });
    if (!row) {
        row = find([](const std::string& quantity) {
            const std::string text = trimmed(quantity);
            return text.substr(0, text.find_first_of(" (,:"));
        });
    }
    return row ? std::vector{*row} : std::vector<std::size_t>{};
}

double reach_of(const AuditedRow& row, double k) {
    if (!row.in_sum) {
        return 0.0;
    }
    // A quantity between limits has no values beyond them, whatever k is.
    return divisor_of_shape(row.shape).value_or(k) * row.used_u;
}

/// The unit of a row; nothing for a text that is none. "-" stands for one.
std::optional<gum::Unit> unit_of(const std::string& text) {
    if (text.empty() || text == "-" || text == "1") {
        return gum::Unit();
    }
    try {
        return gum::Unit::parse(text);
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

}  // namespace

std::optional<BudgetModel> BudgetModel::of(const AuditedBudget& budget) {
    const std::vector<gum::EquationText> equations = equations_of(budget);
    if (equations.empty()) {
        return std::nullopt;
    }
    BudgetModel model;
    std::set<std::string> defined, used;
    try {
        for (const gum::EquationText& equation : equations) {
            const gum::EquationNames names = gum::equation_names(equation);
            if (names.defines.empty()) {
                return std::nullopt;  // implicit: rows do not say where to begin
            }
            defined.insert(names.defines);
            used.insert(names.uses.begin(), names.uses.end());
        }
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
    bool units_known = true, any_unit = !budget.unit.empty() && budget.unit != "1", estimates_known = true;
    for (const std::string& name : used) {
        if (defined.contains(name)) {
            continue;
        }
        std::vector<std::size_t> rows = rows_of(budget, name);
        if (rows.empty()) {
            model.without_row_.push_back(name);
            continue;
        }
        const AuditedRow& is = budget.rows[rows.front()];
        const std::optional<gum::Unit> unit = unit_of(is.unit);
        units_known = units_known && unit;
        any_unit = any_unit || !is.unit.empty();
        for (const std::size_t row : rows) {
            const std::optional<StatedNumber>& estimate = budget.rows[row].estimate;
            estimates_known = estimates_known && estimate && std::isfinite(estimate->value);
        }
        model.quantities_.push_back(name);
        model.rows_.push_back(rows.front());
        model.parts_.push_back(std::move(rows));
        model.units_.push_back(unit.value_or(gum::Unit()));
    }
    if (model.rows_.empty()) {
        return std::nullopt;
    }
    const std::optional<gum::Unit> result_unit = unit_of(budget.unit);
    if (!model.without_row_.empty() || !estimates_known || (any_unit && (!units_known || !result_unit))) {
        return model;
    }
    model.result_unit_ = result_unit.value_or(gum::Unit());
    model.compile(equations, budget);
    // Some tables write their equation for the numbers in their units, with a factor such as 1000 in it. The stated
    // value tells which of the two is meant; where neither gives it, the equation with units stays.
    if (any_unit && budget.value && !model.gives_value(budget)) {
        BudgetModel of_numbers = model;
        of_numbers.system_.reset();
        of_numbers.units_.assign(model.units_.size(), gum::Unit());
        of_numbers.result_unit_ = gum::Unit();
        of_numbers.compile(equations, budget);
        if (of_numbers.gives_value(budget)) {
            return of_numbers;
        }
    }
    return model;
}

/// Leaves the model without a system where units do not balance: the numbers of the table cannot be told then.
void BudgetModel::compile(const std::vector<gum::EquationText>& equations, const AuditedBudget& budget) {
    std::vector<gum::InputSymbol> inputs;
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
        inputs.push_back({.name = quantities_[i], .unit = units_[i], .constant = std::nullopt});
    }
    try {
        gum::EquationSystem system = gum::EquationSystem::compile(equations, inputs);
        std::optional<std::size_t> output;
        for (std::size_t i = 0; i < system.output_count(); ++i) {
            if (system.output_count() == 1 || system.output_name(i) == gum::canonical_name(budget.name)) {
                output = i;
            }
        }
        if (output && system.output_unit(*output).dimension() == result_unit_.dimension()) {
            output_ = *output;
            system_ = std::move(system);
            equations_ = equations;
            inputs_ = std::move(inputs);
        }
    } catch (const gum::DiagnosedError&) {
        system_.reset();
    }
}

/// Whether the equation gives the value that the budget states, within 0.1 % and U.
bool BudgetModel::gives_value(const AuditedBudget& budget) const {
    const std::vector<double> x = estimates(budget);
    Eigen::VectorXd at(static_cast<Eigen::Index>(units_.size()));
    for (std::size_t i = 0; i < units_.size(); ++i) {
        at(static_cast<Eigen::Index>(i)) = units_[i].to_si(x[i]);
    }
    if (!system_ || !budget.value || !at.allFinite()) {
        return false;
    }
    try {
        const double y = result_unit_.from_si(system_->evaluate(at)(static_cast<Eigen::Index>(output_)));
        constexpr double k_rounded = 1e-3;
        const double U = budget.claims.U ? std::abs(budget.claims.U->value) : 0.0;
        return std::abs(y - *budget.value) <= k_rounded * std::abs(*budget.value) + U;
    } catch (const gum::DiagnosedError&) {
        return false;
    }
}

std::vector<double> BudgetModel::estimates(const AuditedBudget& budget) const {
    std::vector<double> x(parts_.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (const std::size_t row : parts_[i]) {
            const bool known = row < budget.rows.size() && budget.rows[row].estimate;
            x[i] += known ? budget.rows[row].estimate->value : std::numeric_limits<double>::quiet_NaN();
        }
    }
    return x;
}

std::vector<double> BudgetModel::reach(const AuditedBudget& budget, double k) const {
    std::vector<double> reach(parts_.size(), 0.0);
    for (std::size_t i = 0; i < reach.size(); ++i) {
        for (const std::size_t row : parts_[i]) {
            reach[i] += reach_of(budget.rows[row], k);
        }
    }
    return reach;
}

std::optional<std::vector<double>> BudgetModel::derivatives(const std::vector<double>& x) const {
    const auto n = static_cast<Eigen::Index>(units_.size());
    Eigen::VectorXd at(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        at(i) = units_[static_cast<std::size_t>(i)].to_si(x[static_cast<std::size_t>(i)]);
    }
    if (!system_ || !at.allFinite()) {
        return std::nullopt;
    }
    try {
        const Eigen::MatrixXd jacobian = system_->jacobian(at);
        std::vector<double> c(units_.size());
        for (std::size_t i = 0; i < c.size(); ++i) {
            const double si = jacobian(static_cast<Eigen::Index>(output_), static_cast<Eigen::Index>(i));
            c[i] = result_unit_.difference_from_si(units_[i].difference_to_si(si));
        }
        return c;
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

std::optional<std::vector<double>> BudgetModel::second_derivatives(const std::vector<double>& x) const {
    const auto n = static_cast<Eigen::Index>(units_.size());
    Eigen::VectorXd at(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        at(i) = units_[static_cast<std::size_t>(i)].to_si(x[static_cast<std::size_t>(i)]);
    }
    if (!system_ || !at.allFinite()) {
        return std::nullopt;
    }
    try {
        const Eigen::MatrixXd hessian = system_->hessians(at)[output_];
        std::vector<double> all(units_.size() * units_.size());
        for (std::size_t i = 0; i < units_.size(); ++i) {
            for (std::size_t j = 0; j < units_.size(); ++j) {
                const double si = hessian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                all[i * units_.size() + j] =
                    result_unit_.difference_from_si(units_[i].difference_to_si(units_[j].difference_to_si(si)));
            }
        }
        return all;
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

gum::OutputBound BudgetModel::tangent_bound(const std::vector<double>& x, const std::vector<double>& reach) const {
    gum::OutputBound none{.bound = std::nullopt, .why_not = "the equation cannot be evaluated"};
    const auto n = static_cast<Eigen::Index>(units_.size());
    Eigen::VectorXd at(n), low(n), high(n);
    constexpr double k_outside = 1.0 + 1e-9;  // what conversions of units round
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto position = static_cast<std::size_t>(i);
        const double d = units_[position].difference_to_si(reach[position]) * k_outside;
        at(i) = units_[position].to_si(x[position]);
        low(i) = at(i) - d;
        high(i) = at(i) + d;
    }
    if (!system_ || !low.allFinite() || !high.allFinite()) {
        return none;
    }
    gum::OutputBound bound = gum::tangent_bound(equations_, inputs_, output_, at, low, high);
    if (bound.bound) {
        const auto converted = [this](double si) { return result_unit_.difference_from_si(si); };
        bound.bound = gum::TangentBound{.low = converted(bound.bound->low),
                                        .high = converted(bound.bound->high),
                                        .certain = converted(bound.bound->certain)};
    }
    return bound;
}

}  // namespace gumcert::audit
