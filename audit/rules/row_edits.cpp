#include "audit/rules/row_edits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "audit/row_facts.h"
#include "text/numbers.h"
#include "text/small_letters.h"

namespace gumcert::audit {

void for_each_row(const AuditSubject& subject, const std::function<void(const RowAt&)>& look) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        for (std::size_t r = 0; r < budget.rows.size(); ++r) {
            look({.budget = b, .row = r, .of = budget, .is = budget.rows[r]});
        }
    }
}

AuditFinding finding_at(const RowAt& at, const std::string& column, Sentence what) {
    AuditFinding finding;
    finding.where = at.is.place;
    if (!at.is.quantity.empty()) {
        finding.where += " (" + at.is.quantity + ")";
    }
    if (!column.empty()) {
        finding.where += ", " + column;
    }
    finding.what = std::move(what);
    finding.budgets = {at.budget};
    finding.kind = at.is.quantity.empty() ? "" : at.is.quantity + "/" + column;
    return finding;
}

AuditFinding finding_of(const AuditSubject& subject, std::size_t budget, Sentence what) {
    AuditFinding finding;
    const AuditedBudget& of = subject.budgets[budget];
    finding.where = of.place.empty() ? of.name : of.place;
    finding.what = std::move(what);
    finding.budgets = {budget};
    finding.kind = "budget";
    return finding;
}

std::string in_words(double number, const std::string& unit) {
    const std::string digits = std::isfinite(number) ? text::significant(number, 4) : "infinite";
    return unit.empty() || unit == "1" ? digits : digits + " " + unit;
}

Correction set_u(std::size_t row, double u) {
    return [row, u](AuditedBudget& budget) {
        AuditedRow& is = budget.rows[row];
        double as_stated = is.used_u;
        for (const double factor : is.factors_of_u) {
            as_stated /= factor;
        }
        is.factors_of_u.clear();
        if (as_stated > 0.0 && u > 0.0) {
            is.factors_of_u.push_back(u / as_stated);
        }
        is.used_u = u;
        is.u_half_step = 0.0;
        is.contribution.reset();
    };
}
Correction scale_u(std::size_t row, double factor) {
    return [row, factor](AuditedBudget& budget) {
        AuditedRow& is = budget.rows[row];
        if (std::any_of(is.factors_of_u.begin(), is.factors_of_u.end(),
                        [factor](double made) { return is_about(made, factor); })) {
            return;
        }
        is.factors_of_u.push_back(factor);
        is.used_u *= factor;
        is.u_half_step *= factor;
        is.contribution.reset();
    };
}
Correction set_u_and_shape(std::size_t row, double u, Shape shape) {
    return [set = set_u(row, u), row, shape](AuditedBudget& budget) {
        set(budget);
        if (budget.evaluated_here) {
            budget.rows[row].shape = shape;
        }
    };
}
Correction set_sensitivity(std::size_t row, double sensitivity) {
    return [row, sensitivity](AuditedBudget& budget) {
        budget.rows[row].used_sensitivity = sensitivity;
        budget.rows[row].sensitivity_half_step = 0.0;
        budget.rows[row].contribution.reset();
    };
}
Correction set_degrees_of_freedom(std::size_t row, double nu) {
    return [row, nu](AuditedBudget& budget) { budget.rows[row].used_nu = nu; };
}
Correction leave_out(std::size_t row) {
    return [row](AuditedBudget& budget) { budget.rows[row].in_sum = false; };
}
Correction put_in(std::size_t row) {
    return [row](AuditedBudget& budget) { budget.rows[row].in_sum = true; };
}
Correction add_contribution(double contribution, std::string quantity) {
    return [contribution, quantity = std::move(quantity)](AuditedBudget& budget) {
        AuditedRow row;
        row.quantity = quantity;
        row.used_u = contribution;
        budget.rows.push_back(std::move(row));
    };
}
Correction both(Correction first, Correction second) {
    return [first = std::move(first), second = std::move(second)](AuditedBudget& budget) {
        first(budget);
        second(budget);
    };
}

std::string text_of_row(const AuditedRow& row) {
    return text::in_small_letters(row.quantity + " " + row.source + " " + row.comment);
}

bool mentions(const std::string& text_of_row, const std::vector<std::string_view>& words) {
    return std::any_of(words.begin(), words.end(),
                       [&text_of_row](std::string_view word) { return text_of_row.find(word) != std::string::npos; });
}

bool mentions(const AuditedRow& row, const std::vector<std::string_view>& words) {
    return mentions(text_of_row(row), words);
}

bool u_differs(const AuditedRow& row, double expected, double relative, double left_open) {
    return std::abs(row.used_u - expected) > row.u_half_step + left_open + relative * std::abs(expected);
}

Sentence place_in_words(const std::string& place) {
    const std::string row = "row ";
    const bool counted = place.starts_with(row) && place.size() > row.size() &&
                         place.find_first_not_of("0123456789", row.size()) == std::string::npos;
    return counted ? say("row {row:number}", place.substr(row.size())) : Sentence(place);
}

Sentence name_of_row(const AuditedBudget& budget, std::size_t row) {
    const AuditedRow& is = budget.rows[row];
    const Sentence place =
        is.place.empty() ? say("row {row:number}", std::to_string(row + 1)) : place_in_words(is.place);
    return is.quantity.empty() ? place : say("{place} ({quantity})", place, is.quantity);
}

bool is_about(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

}  // namespace gumcert::audit
