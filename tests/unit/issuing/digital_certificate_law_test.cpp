#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "certificate/statement_of_uncertainty.h"
#include "gum/rounding.h"
#include "imports/foreign_certificate.h"
#include "reports/dcc/dcc_document.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

// The law of digital certificates: what the program writes passes its own check, whatever the values of a column state.

namespace gumcert::issuing {
namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

void drop_expanded(CertifiedValue& value) {
    value.U.reset();
    value.k.reset();
    value.printed_U.clear();
    value.printed_k.clear();
    value.printed_nu_eff.clear();
}

void state_interval(CertifiedValue& value) {
    const double U = *value.U;
    const int decimals = certificate::decimals_of(value.printed_U);
    value.interval = {value.value - U, value.value + U};
    value.printed_low = gum::round_to_quantum(value.interval->first, decimals);
    value.printed_high = gum::round_to_quantum(value.interval->second, decimals);
    value.coverage = "monte_carlo";
    drop_expanded(value);
}

/// What a value may state of its uncertainty, by number.
/// \return as the reader calls it
std::string state(CertifiedValue& value, unsigned what) {
    switch (what) {
        case 0:
            return "expanded";
        case 1:
            state_interval(value);
            return "coverage_interval";
        case 2:  // of a distribution without variance
            state_interval(value);
            value.u = 0.0;
            return "coverage_interval";
        case 3:
            value.printed_k = "0.45";
            value.k = 0.45;
            return "standard";
        case 4:
            drop_expanded(value);
            value.coverage = "none";
            return "standard";
        default:
            drop_expanded(value);
            value.u = 0.0;
            return "none";
    }
}

bool is_number(const std::string& text) {
    return text != "NaN";
}

TEST(DigitalCertificate, PassesItsOwnCheckWhateverItsValuesState) {
    std::mt19937 random(20261129);
    constexpr int k_certificates = 60;
    for (int n = 0; n < k_certificates; ++n) {
        reports::EvaluationRecord record = test::certified_rotary_record();
        CertifiedTable& table = record.certificate->tables.at(0);
        std::map<std::string, std::map<std::size_t, std::string>> kinds;
        for (CertifiedColumn& column : table.columns) {
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                kinds[column.result][row] = state(column.values[row], static_cast<unsigned>(random() % 6));
            }
        }
        const std::string document = reports::render_dcc(record, reports::assets());
        for (const gum::Diagnostic& d : imports::check_certificate(document, "document", {})) {
            // The limits of the sample are invented.
            EXPECT_TRUE(d.severity != gum::Severity::error || d.code == "GC-DCC-0116") << message(d);
        }
        std::map<std::string, std::map<std::size_t, std::string>> read;
        std::map<std::string, std::map<std::size_t, bool>> decided;
        for (const reports::ImportedQuantity& q : reports::read_dcc(document, "document").quantities) {
            const std::size_t at = q.ref_type.find("gumcert_");
            const std::string name = at == std::string::npos ? "" : q.ref_type.substr(at + 8);
            if (q.row && kinds.contains(name) && is_number(q.value)) {
                EXPECT_TRUE(read[name].emplace(*q.row, q.kind).second) << name << " stands twice";
                decided[name][*q.row] = q.conformity == "pass" || q.conformity == "fail";
            }
        }
        EXPECT_EQ(read, kinds);
        for (const CertifiedColumn& column : table.columns) {
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                EXPECT_EQ(decided[column.result][row], column.values[row].verdict.has_value()) << column.result;
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::issuing
