#include "reports/record/make/certificate/certified_measurand.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificate/gates/finding_list.h"
#include "certificate/gates/held_against.h"
#include "gum/argument_check.h"
#include "gum/quantity/unit.h"
#include "reports/record/certified_tables.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::CapabilityArgument;
using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::Finding;
using certificate::FindingList;
using certificate::FindingSeverity;
using certificate::ScopeEntry;
using gum::Unit;

/// One value of the results of a budget, with the rows of its budget.
struct Budgeted {
    const CertifiedTable& table;
    const CertifiedColumn& column;
    std::size_t row;
    const reports::Result& result;

    [[nodiscard]] certificate::Measured measured(const Unit& unit) const {
        return certificate::measured_at(table, column, row, unit);
    }
};

std::vector<Budgeted> values_in_scope(const reports::EvaluationRecord& record, const ScopeEntry& entry) {
    std::vector<Budgeted> all;
    for (const CertifiedTable& table : record.certificate->tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (std::size_t row = 0; table.id == "results" && row < column.values.size(); ++row) {
                const reports::Result* result = reports::result_of(record, table, column.result, row);
                if (result != nullptr && column.values[row].scope_entry == entry.id) {
                    all.push_back({.table = table, .column = column, .row = row, .result = *result});
                }
            }
        }
    }
    return all;
}

/// The input of a budget that an argument names; a parameter of the certificate has been looked at before.
const reports::BudgetRow* row_of(const Budgeted& budgeted, const CapabilityArgument& argument) {
    if (argument.of == "value" || argument.of == "argument") {
        return nullptr;
    }
    const auto& rows = budgeted.result.budget;
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const reports::BudgetRow& r) {
        return r.input == argument.of && r.value.number && r.role.empty();
    });
    return row == rows.end() ? nullptr : &*row;
}

/// A constant is the statement of the author; what has an uncertainty was measured, and a result beyond the range of it
/// may be an amplified one.
std::optional<Finding> range_of_input(const ScopeEntry& entry, std::size_t i, const ScopeEntry::Range& range,
                                      const Budgeted& budgeted) {
    const reports::BudgetRow* row = row_of(budgeted, range.argument);
    if (row == nullptr) {
        return std::nullopt;
    }
    const Unit unit = Unit::parse(range.argument.unit);
    const certificate::Measured measured = budgeted.measured(unit);
    const Unit of = Unit::parse(measured.unit);
    const Unit stated = Unit::parse(row->unit);
    if (!gum::of_one_kind(of, unit) || !gum::of_one_kind(stated, unit)) {
        return std::nullopt;
    }
    const double value = certificate::value_for_scope(measured.value, of, unit, range.low);
    const double low = certificate::has_sign(unit, range.low) ? range.low : 0.0;
    const bool beyond = certificate::is_beyond(value, low, range.high);
    const bool nominal = certificate::is_nominal_in(
        certificate::value_for_scope(*row->value.number, stated, unit, range.low), value, low, range.high);
    if (!beyond && (nominal || row->u.number > 0.0)) {
        return std::nullopt;
    }
    return Finding{.id = "X12",
                   .clause = "ILAC-P14:09/2020",
                   .severity = !beyond                ? FindingSeverity::minor
                               : row->u.number == 0.0 ? FindingSeverity::critical
                                                      : FindingSeverity::major,
                   .where = certificate::place_in("/accreditation/scope", i, "ranges"),
                   .what = "the range of \"" + entry.id + "\" is held against the input \"" + row->input + "\" = " +
                           text::shortest(*row->value.number) + " " + row->unit + ", and " + measured.in_words,
                   .action = certificate::action_of_range(measured)};
}

std::optional<Finding> capability_of_input(const ScopeEntry& entry, std::size_t i, const CapabilityArgument& argument,
                                           const Budgeted& budgeted) {
    const reports::BudgetRow* row = row_of(budgeted, argument);
    const certificate::Measured measured = budgeted.measured(Unit::parse(argument.unit));
    if (row == nullptr || measured.value == 0.0) {
        return std::nullopt;
    }
    return certificate::capability_taken_elsewhere(
        entry, i, argument, {.name = row->input, .value = *row->value.number, .unit = row->unit}, measured);
}

/// One finding for all values of an entry: the gravest.
template <class OfValue>
void add_gravest(FindingList& found, const std::vector<Budgeted>& values, const OfValue& of_value) {
    std::vector<Finding> all;
    for (const Budgeted& value : values) {
        if (std::optional<Finding> finding = of_value(value)) {
            all.push_back(std::move(*finding));
        }
    }
    found.add_gravest(all);
}

}  // namespace

std::vector<Finding> measurand_findings(const reports::EvaluationRecord& record) {
    const certificate::CertificateData& data = record.certificate->data;
    FindingList found(data);
    if (!data.accreditation || data.status != "accredited") {
        return {};
    }
    for (std::size_t i = 0; i < data.accreditation->scope.size(); ++i) {
        const ScopeEntry& entry = data.accreditation->scope[i];
        const std::vector<Budgeted> values = values_in_scope(record, entry);
        for (const ScopeEntry::Range& one : entry.ranges) {
            add_gravest(found, values, [&](const Budgeted& value) { return range_of_input(entry, i, one, value); });
        }
        for (const CapabilityArgument& argument : entry.capability.arguments) {
            add_gravest(found, values,
                        [&](const Budgeted& value) { return capability_of_input(entry, i, argument, value); });
        }
    }
    return found.take();
}

}  // namespace gumcert::reports
