#pragma once

#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_certificate.h"
#include "tests/support/sample_record.h"

#include "gum/quantity/unit.h"
#include "reports/view/certificate_builder.h"
#include "text/numbers.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace gumcert::test {

// Records with a certificate as the evaluation makes one, so that documents can be looked at without it. Decisions
// are made up: nothing here tests them.

inline certificate::CertifiedValue certified_value(double value, double u, double k, std::optional<double> nu_eff,
                                                   const reports::Printed& printed, const std::string& scope_entry) {
    certificate::CertifiedValue v;
    v.value = value;
    v.u = u;
    v.k = k;
    v.U = k * u;
    v.nu_eff = nu_eff;
    v.printed_value = printed.value;
    v.printed_U = printed.U;
    v.printed_k = "2.00";
    v.printed_nu_eff = nu_eff ? reports::plain(*nu_eff) : "";
    v.scope_entry = scope_entry;
    return v;
}

inline certificate::Verdict sample_verdict(const certificate::CertifiedValue& v) {
    certificate::Verdict d;
    d.specification = "axial";
    d.rule = "DR-03";
    d.formula = "A_U = T_U − U, A_L = T_L + U";
    d.lower = -10.0;
    d.upper = 10.0;
    d.acceptance_lower = -10.0 + v.U.value_or(0.0);
    d.acceptance_upper = 10.0 - v.U.value_or(0.0);
    d.guard_band = v.U.value_or(0.0);
    d.verdict = v.value < *d.acceptance_lower || v.value > *d.acceptance_upper ? "fail" : "pass";
    d.verdict_from_printed = d.verdict;
    d.printed.lower = "\u221210.00";
    d.printed.upper = "10.00";
    d.printed.acceptance_lower = decimals(*d.acceptance_lower, 2);
    d.printed.acceptance_upper = decimals(*d.acceptance_upper, 2);
    d.printed.guard_band = v.printed_U;
    d.printed.conformance_probability = "100.0";
    d.printed.specific_risk = "0.0";
    d.printed.largest_specific_risk = "2.3";
    d.printed.test_uncertainty_ratio = "21";
    return d;
}

/// The sample of a rotary table as an accredited certificate; the ranges are outside of the scope.
inline reports::EvaluationRecord certified_rotary_record() {
    reports::EvaluationRecord record = sample_record();
    certificate::Certificate c;
    c.data = sample_certificate_data();
    c.profile.id = "ilac";
    c.profile.first_page_sentences = {
        in_two_languages("A sentence of the accreditation body.", "Ein Satz der Akkreditierungsstelle.")};
    c.symbol = true;
    const reports::RotaryTable& r = *record.rotary;
    certificate::CertifiedTable errors;
    errors.id = "error_motions";
    errors.argument = {.name = "angle", .unit = "degree", .printed_unit = "°", .values = {}, .printed = {}};
    for (const reports::ErrorsAtAngle& at : r.errors) {
        errors.argument->values.emplace_back(at.angle_deg.number);
        errors.argument->printed.push_back(at.angle_deg.text);
    }
    for (std::size_t i = 0; i < 6; ++i) {
        certificate::CertifiedColumn column;
        column.result = r.error_names[i];
        column.unit = r.error_units[i];
        column.printed_unit = gum::unit_for_people(column.unit);
        for (const reports::ErrorsAtAngle& at : r.errors) {
            const reports::StatedValue& e = at.errors[i];
            column.values.push_back(certified_value(e.value, e.u, e.k, e.nu_eff, e.printed, i < 3 ? "R1" : "R2"));
            if (column.result == "EAA") {
                column.values.back().verdict = sample_verdict(column.values.back());
            }
        }
        errors.columns.push_back(std::move(column));
    }
    certificate::CertifiedTable ranges;
    ranges.id = "ranges";
    for (const reports::RangeRow& row : r.ranges) {
        certificate::CertifiedColumn column;
        column.result = "range_" + row.name;
        column.name = "Range of " + row.name;
        column.printed_unit = row.stated.printed.unit;
        column.values.push_back(certified_value(row.stated.value, row.stated.u, 2.0, 412.7, row.stated.printed, ""));
        ranges.columns.push_back(std::move(column));
    }
    c.tables = {errors, ranges};
    record.certificate = std::move(c);
    return record;
}

/// The sample of a budget as an accredited certificate without conformity.
inline reports::EvaluationRecord certified_budget_record() {
    reports::EvaluationRecord record = sample_budget_record();
    certificate::Certificate c;
    c.data = sample_certificate_data();
    c.data.specifications.clear();
    c.profile.id = "ilac";
    c.symbol = true;
    certificate::CertifiedTable table;
    table.id = "results";
    for (const reports::Result& r : record.results) {
        certificate::CertifiedColumn column;
        column.result = r.name;
        column.name = r.description;
        column.unit = r.unit;
        column.printed_unit = r.printed.unit;
        column.values.push_back(certified_value(r.value, r.u, r.k.value_or(2.0), r.nu_eff, r.printed, "L1"));
        column.values.back().coverage = r.coverage;
        column.values.back().printed_k = text::fixed(r.k.value_or(2.0), 2);
        table.columns.push_back(std::move(column));
    }
    c.tables = {table};
    record.certificate = std::move(c);
    return record;
}

/// The same as a draft, with findings.
inline reports::EvaluationRecord drafted(reports::EvaluationRecord record) {
    certificate::Certificate& c = *record.certificate;
    c.blocked = true;
    c.symbol = false;
    c.data.item.serial_number.clear();
    c.data.item.identification.clear();
    c.findings = {{.id = "R07-g",
                   .clause = "ISO/IEC 17025:2017, 7.8.2.1 g",
                   .severity = certificate::FindingSeverity::critical,
                   .where = "/item/serial_number",
                   .what = "neither a serial number nor an identification is stated, so the item is not identified",
                   .action = "state the serial number, or the number that the laboratory gave to the item"},
                  {.id = "R07-h",
                   .clause = "ISO/IEC 17025:2017, 7.8.2.1 h",
                   .severity = certificate::FindingSeverity::major,
                   .where = "/dates/received",
                   .what = "the date of receipt is after the calibration",
                   .action = "correct one of the dates"}};
    return record;
}

}  // namespace gumcert::test
