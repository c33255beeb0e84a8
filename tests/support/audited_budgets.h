#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/stated_number.h"
#include "audit/subject.h"

// Budgets as a reader of tables would fill them, in as few words as a test has room for.

namespace gumcert::test {

inline constexpr double k_infinite = std::numeric_limits<double>::infinity();

/// A number as it is printed in a table.
inline audit::StatedNumber printed(const std::string& text) {
    return audit::read_number(text, "").value_or(audit::StatedNumber{});
}

/// A row with all digits known.
inline audit::AuditedRow row(std::string quantity, double u, double c = 1.0, double nu = k_infinite) {
    audit::AuditedRow one;
    one.place = "row of " + quantity;
    one.quantity = std::move(quantity);
    one.unit = "um";
    one.u = audit::exact_number(u, "");
    one.sensitivity = audit::exact_number(c, "");
    one.nu = audit::exact_number(nu, "");
    one.used_u = u;
    one.used_sensitivity = c;
    one.used_nu = nu;
    return one;
}

/// A row that comes from a limit, a step or an expanded uncertainty.
inline audit::AuditedRow row_from(std::string quantity, audit::Origin origin, double value, double u,
                                  audit::Shape shape = audit::Shape::not_stated) {
    audit::AuditedRow one = row(std::move(quantity), u);
    one.origin = origin;
    one.origin_value = value;
    one.shape = shape;
    return one;
}

/// A row of Type A from readings.
inline audit::AuditedRow row_of_readings(std::string quantity, std::vector<double> readings, double u) {
    audit::AuditedRow one = row(std::move(quantity), u, 1.0, static_cast<double>(readings.size()) - 1.0);
    one.origin = audit::Origin::readings;
    one.contributor = audit::Contributor::repeatability;
    one.type_a = true;
    one.readings = std::move(readings);
    return one;
}

inline audit::AuditedBudget budget_of(std::vector<audit::AuditedRow> rows) {
    audit::AuditedBudget budget;
    budget.name = "length";
    budget.unit = "um";
    budget.place = "table 1";
    budget.rows = std::move(rows);
    return budget;
}

inline audit::AuditSubject subject_of(std::vector<audit::AuditedBudget> budgets) {
    audit::AuditSubject subject;
    subject.name = "budget.csv";
    subject.budgets = std::move(budgets);
    return subject;
}
inline audit::AuditSubject subject_of(audit::AuditedBudget budget) {
    return subject_of(std::vector<audit::AuditedBudget>{std::move(budget)});
}
inline audit::AuditSubject subject_of(audit::AuditedRow one) {
    return subject_of(budget_of({std::move(one), row("another", 0.01)}));
}

}  // namespace gumcert::test
