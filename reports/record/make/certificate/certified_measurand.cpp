#include "reports/record/make/certificate/certified_measurand.h"

#include <algorithm>
#include <cstddef>
#include <string>

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
        return r.input == argument.of && r.value && r.role.empty();
    });
    return row == rows.end() ? nullptr : &*row;
}

/// A constant is the statement of the author; what has an uncertainty was measured, and a result beyond the range of it
/// may be an amplified one.
/// \return whether it added a finding
bool range(FindingList& found, const ScopeEntry& entry, std::size_t i, const ScopeEntry::Range& range,
           const Budgeted& budgeted) {
    const reports::BudgetRow* row = row_of(budgeted, range.argument);
    if (row == nullptr) {
        return false;
    }
    const Unit unit = Unit::parse(range.argument.unit);
    const certificate::Measured measured = budgeted.measured(unit);
    const Unit of = Unit::parse(measured.unit);
    const Unit stated = Unit::parse(row->unit);
    if (!certificate::of_one_kind(of, unit) || !certificate::of_one_kind(stated, unit)) {
        return false;
    }
    const double value = certificate::value_for_scope(measured.value, of, unit);
    const double low = unit.is_celsius_temperature() ? range.low : 0.0;
    const bool beyond = certificate::is_beyond(value, low, range.high);
    const bool nominal = certificate::is_nominal_of(certificate::value_for_scope(*row->value, stated, unit), value);
    if (!beyond && (nominal || row->u > 0.0)) {
        return false;
    }
    found.add(!beyond         ? FindingSeverity::minor
              : row->u == 0.0 ? FindingSeverity::critical
                              : FindingSeverity::major,
              "X12", "ILAC-P14:09/2020", certificate::place_in("/accreditation/scope", i, "ranges"),
              "the range of \"" + entry.id + "\" is held against the input \"" + row->input +
                  "\" = " + text::shortest(*row->value) + " " + row->unit + ", and " + measured.in_words,
              "Hold the range against the result (\"of\": \"value\"), or state the true parameter.");
    return true;
}

bool capability(FindingList& found, const ScopeEntry& entry, std::size_t i, const CapabilityArgument& argument,
                const Budgeted& budgeted) {
    const reports::BudgetRow* row = row_of(budgeted, argument);
    if (row == nullptr) {
        return false;
    }
    const certificate::Measured measured = budgeted.measured(Unit::parse(argument.unit));
    return measured.value != 0.0 &&
           certificate::capability_taken_elsewhere(
               found, entry, i, argument, {.name = row->input, .value = *row->value, .unit = row->unit}, measured);
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
            (void)std::any_of(values.begin(), values.end(),
                              [&](const Budgeted& value) { return range(found, entry, i, one, value); });
        }
        for (const CapabilityArgument& argument : entry.capability.arguments) {
            (void)std::any_of(values.begin(), values.end(),
                              [&](const Budgeted& value) { return capability(found, entry, i, argument, value); });
        }
    }
    return found.take();
}

}  // namespace gumcert::reports
