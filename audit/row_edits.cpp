#include "audit/row_edits.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

constexpr double k_same_factor = 0.01;

}  // namespace

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
    const std::string written = gum::unit_for_people(unit);
    return written.empty() ? digits : digits + " " + written;
}

std::string printed_unit(const std::string& unit) {
    const std::string written = gum::unit_for_people(unit);
    return written.empty() ? unit : written;
}

Correction set_u(std::size_t row, double u) {
    return [row, u](AuditedBudget& budget) {
        AuditedRow& is = budget.rows[row];
        const double left_open = is.used_u > 0.0 ? is.u_half_step / is.used_u : 0.0;
        double as_stated = is.used_u, tolerance = k_same_factor + left_open;
        for (const FactorOfU& made : is.factors_of_u) {
            as_stated /= made.factor;
            tolerance = std::max(tolerance, made.tolerance);
        }
        is.factors_of_u.clear();
        if (as_stated > 0.0 && u > 0.0) {
            is.factors_of_u.push_back({.factor = u / as_stated, .tolerance = tolerance});
        }
        is.used_u = u;
        is.u_half_step = 0.0;
        is.contribution.reset();
    };
}
namespace {

Correction scale_within(std::size_t row, double factor, double tolerance) {
    return [row, factor, tolerance](AuditedBudget& budget) {
        AuditedRow& is = budget.rows[row];
        if (std::any_of(is.factors_of_u.begin(), is.factors_of_u.end(), [factor, tolerance](const FactorOfU& made) {
                return !made.of_rounding && is_about(made.factor, factor, std::max(made.tolerance, tolerance));
            })) {
            return;
        }
        is.factors_of_u.push_back({.factor = factor, .tolerance = tolerance});
        is.used_u *= factor;
        is.u_half_step *= factor;
        is.contribution.reset();
    };
}

}  // namespace

Correction scale_u(std::size_t row, double factor) {
    return scale_within(row, factor, k_same_factor);
}
Correction change_u(const RowAt& at, double to) {
    const double tolerance = k_same_factor + at.is.u_half_step / at.is.used_u;
    return [row = at.row, scale = scale_within(at.row, to / at.is.used_u, tolerance)](AuditedBudget& budget) {
        AuditedRow& is = budget.rows[row];
        std::erase_if(is.factors_of_u, [&is](const FactorOfU& made) {
            is.used_u = made.of_rounding ? is.used_u / made.factor : is.used_u;
            return made.of_rounding;
        });
        scale(budget);
    };
}
Correction unround_u(std::size_t row, double u) {
    return [row, u](AuditedBudget& budget) {
        AuditedRow& is = budget.rows[row];
        if (!is.factors_of_u.empty() || !(is.used_u > 0.0)) {
            return;  // what corrected it knows better
        }
        is.factors_of_u.push_back(
            {.factor = u / is.used_u, .tolerance = k_same_factor + is.u_half_step / is.used_u, .of_rounding = true});
        is.used_u = u;
        is.u_half_step = 0.0;
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

bool reads_words(const AuditedBudget& budget, const std::string& place, FindingCollector& findings) {
    if (budget.in_other_language) {
        findings.leave_unchecked(
            say("{table}: words of rows are read in English and German, and the heads of the table are of another "
                "language",
                place));
    }
    return !budget.in_other_language;
}

bool u_differs(const AuditedRow& row, double expected, double relative, double left_open) {
    return std::abs(row.used_u - expected) > row.u_half_step + left_open + relative * std::abs(expected);
}

bool may_be_u(const AuditedRow& row, double number) {
    constexpr double k_beyond_digits = 0.01;
    if (u_differs(row, number)) {
        return false;
    }
    const std::optional<StatedNumber> quotient = quotient_of_columns(row);
    const bool gives_u =
        quotient && !u_differs(row, quotient->value, k_beyond_digits, quotient->half_step);  // else U26
    return !gives_u || std::abs(quotient->value - number) <= quotient->half_step + k_beyond_digits * std::abs(number);
}

double number_divided(const AuditedRow& row) {
    return row.origin_value.value_or(row.stated ? std::abs(row.stated->value) : 0.0);
}

bool is_slip_of(const AuditedRow& row, double words) {
    if (!row.stated || !(words > 0.0)) {
        return false;
    }
    constexpr double k_factors[] = {2.0, 10.0, 0.1, 100.0, 0.01, 1000.0, 0.001};
    const double ratio = std::abs(row.stated->value) / words;
    return std::any_of(std::begin(k_factors), std::end(k_factors),
                       [ratio](double factor) { return is_about(ratio, factor, 1e-9); });
}

std::optional<double> u_by_words(const AuditedRow& row) {
    const double number = number_divided(row);
    if (!(number > 0.0)) {
        return std::nullopt;
    }
    if (row.origin == Origin::resolution) {
        return number / std::sqrt(12.0);
    }
    if (row.origin == Origin::readings) {
        return row.n && *row.n > 0 ? std::optional(number / std::sqrt(static_cast<double>(*row.n))) : std::nullopt;
    }
    if (row.origin == Origin::certificate) {
        return row.certificate_k && *row.certificate_k > 0.0 ? std::optional(number / *row.certificate_k)
                                                             : std::nullopt;
    }
    switch (row.shape) {
        case Shape::rectangular:
            return number / std::numbers::sqrt3;
        case Shape::triangular:
            return number / std::sqrt(6.0);
        case Shape::arcsine:
            return number / std::numbers::sqrt2;
        default:
            return std::nullopt;
    }
}

bool is_step_of_column(const AuditedRow& row) {
    return row.origin == Origin::resolution && row.stated && row.origin_value &&
           is_about(row.stated->value, *row.origin_value, 1e-9) &&
           (row.quantity + row.comment + row.source).find_first_of("0123456789") == std::string::npos;
}

std::optional<double> u_of_divided(const AuditedRow& row, double divisor) {
    if (!quotient_of_columns(row) || !(divisor > 0.0)) {
        return std::nullopt;
    }
    const double column = std::abs(row.stated->value), words = row.origin_value.value_or(column);
    const bool is_number_of_words = is_about(column, words, 1e-9);
    const std::optional<double> by_words = u_by_words(row);
    if (row.origin == Origin::resolution) {
        constexpr double k_half_of_step = 0.55;  // of a larger u the column has half of the step
        // Without a number in its words nothing tells the step from half of it, and the distribution counts.
        const bool is_step = row.origin_value && row.shape == Shape::rectangular && is_number_of_words &&
                             !(is_step_of_column(row) && row.used_u > k_half_of_step * words);
        return is_step ? by_words : column / divisor;
    }
    if (row.cyclic && row.origin != Origin::certificate && !row.type_a.value_or(false)) {
        return number_divided(row) / std::numbers::sqrt2;
    }
    const bool is_slip = mentions(row, {"\u00B1", "+/-"}) && is_slip_of(row, words);
    return (is_number_of_words || is_slip) && by_words ? by_words : column / divisor;
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
