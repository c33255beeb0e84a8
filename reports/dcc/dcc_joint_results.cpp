#include "reports/dcc/dcc_joint_results.h"
#include "encoding/base64.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gum/rounding.h"
#include "reports/dcc/dcc_quantity.h"

namespace gumcert::reports {

namespace {

// A matrix of D-SI takes about 150 bytes an element: 50 quantities make 400 kB.
constexpr std::size_t k_most_quantities = 50;

bool is_square(const ResultCovariance& c) {
    const std::size_t n = c.names.size();
    return n > 0 && c.units.size() == n && c.matrix.size() == n &&
           std::all_of(c.matrix.begin(), c.matrix.end(), [&](const auto& row) { return row.size() == n; });
}

const Result* result_of(const EvaluationRecord& record, const std::string& name) {
    const auto found =
        std::find_if(record.results.begin(), record.results.end(), [&](const Result& r) { return r.name == name; });
    return found == record.results.end() ? nullptr : &*found;
}

/// Unit of a covariance: the product of the units of two results.
std::string product_of(const std::string& a, const std::string& b) {
    const std::string first = d_si_unit(unit_of_uncertainty(a));
    const std::string second = d_si_unit(unit_of_uncertainty(b));
    if (first == "\\one") {
        return second;
    }
    if (second == "\\one") {
        return first;
    }
    const bool one_unit =
        std::all_of(a.begin(), a.end(), [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); });
    return a == b && one_unit ? first + "\\tothe{2}" : first + second;
}

void matrix_of(DccWriter& w, const ResultCovariance& c) {
    w.xml.open("si:covarianceMatrixXMLList");
    for (std::size_t column = 0; column < c.names.size(); ++column) {
        w.xml.open("si:columnXMLList");
        for (std::size_t row = 0; row < c.names.size(); ++row) {
            w.xml.open("si:covarianceXMLList");
            w.xml.element("si:valueXMLList", d_si_number(c.matrix[row][column]));
            w.xml.element("si:unitXMLList", product_of(c.units[row], c.units[column]));
            w.xml.close();
        }
        w.xml.close();
    }
    w.xml.close();
}

/// Factor and probability of the ellipsoid for all results together, where the record states one.
std::optional<std::pair<std::string, std::string>> region_of(const EvaluationRecord& record) {
    if (!record.region || !record.region->k_p || record.results.size() != record.covariance->names.size()) {
        return std::nullopt;
    }
    const std::string k = d_si_coverage_factor(record.region->printed.k_p);
    return k == "NaN" ? std::nullopt
                      : std::optional(std::pair(k, d_si_probability(record.region->coverage_probability)));
}

/// The value that the certificate prints for a result.
std::string printed_value(const DccWriter& w, const Result& r) {
    const std::string quantity = r.quantity.empty() ? r.name : r.quantity;
    for (const certificate::CertifiedTable& table : w.tables()) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            if (column.result != quantity) {
                continue;
            }
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                const bool same_point = r.point.empty() || (table.argument && row < table.argument->printed.size() &&
                                                            table.argument->printed[row] == r.point);
                if (same_point) {
                    return required_d_si_number(column.values[row].printed_value, r.name);
                }
            }
        }
    }
    return required_d_si_number(r.printed.value, r.name);
}

void joint_quantity(DccWriter& w, const ResultCovariance& c) {
    std::vector<std::string> labels;
    std::vector<std::string> values;
    std::vector<std::string> units;
    std::vector<std::string> uncertainties;
    for (std::size_t i = 0; i < c.names.size(); ++i) {
        const Result& r = *result_of(w.record(), c.names[i]);
        labels.push_back(as_token(c.names[i]));
        values.push_back(printed_value(w, r));
        units.push_back(d_si_unit(c.units[i]));
        uncertainties.push_back(r.u > 0.0 ? d_si_number(gum::round_significant(r.u, 2)) : "0");
    }
    w.xml.open("dcc:quantity", {{"refType", w.ref_types()("covariance")}});
    w.text("dcc:description", w.words()("dcc", "joint_text"));
    w.xml.open("si:realListXMLList");
    w.xml.element("si:labelXMLList", full_list(labels));
    w.xml.element("si:valueXMLList", full_list(values));
    w.xml.element("si:unitXMLList", joined_list(units));
    w.xml.open("si:measurementUncertaintyUnivariateXMLList");
    w.xml.open("si:standardMUXMLList");
    w.xml.element("si:valueStandardMUXMLList", full_list(uncertainties));
    w.xml.close();
    w.xml.close();
    w.xml.open("si:measurementUncertaintyMultivariateXMLList");
    w.xml.open("si:ellipsoidalRegionMUXMLList");
    matrix_of(w, c);
    const auto region = region_of(w.record());
    w.xml.element("si:coverageFactorXMLList", region ? region->first : "NaN");
    w.xml.element("si:coverageProbabilityXMLList", region ? region->second : "NaN");
    w.xml.close();
    w.xml.close();
    w.xml.close();
    w.xml.close();
}

std::string quoted_csv(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        out += c == '"' ? "\"\"" : std::string(1, c);
    }
    return out + "\"";
}

std::string csv_of(const ResultCovariance& c) {
    std::string csv = "result,unit";
    for (const std::string& name : c.names) {
        csv += "," + quoted_csv(name);
    }
    csv += "\n";
    for (std::size_t row = 0; row < c.names.size(); ++row) {
        csv += quoted_csv(c.names[row]) + "," + quoted_csv(c.units[row]);
        for (const double value : c.matrix[row]) {
            csv += "," + d_si_number(value);
        }
        csv += "\n";
    }
    return csv;
}

void covariance_table(DccWriter& w, const ResultCovariance& c) {
    w.xml.open("dcc:byteData", {{"refType", w.ref_types()("covariance")}});
    w.text("dcc:name", w.words()("dcc", "covariance_table"));
    w.xml.element("dcc:fileName", "covariance.csv");
    w.xml.element("dcc:mimeType", "text/csv");
    w.xml.element("dcc:dataBase64", encoding::base64(csv_of(c)));
    w.xml.close();
}

}  // namespace

void write_joint_results(DccWriter& w) {
    const EvaluationRecord& record = w.record();
    const bool in_file = record.rotary && record.rotary->covariance_file;
    if (!record.covariance && !in_file) {
        return;
    }
    w.xml.open("dcc:result");
    w.text("dcc:name", w.words()("dcc", "joint"));
    if (in_file || !is_square(*record.covariance)) {
        w.data_sentence(w.words().filled(
            "dcc", "covariance_file", {{"file", in_file ? *record.rotary->covariance_file : record.covariance->file}}));
        w.xml.close();
        return;
    }
    const ResultCovariance& c = *record.covariance;
    const bool in_d_si = std::none_of(c.units.begin(), c.units.end(), needs_unit_definition);
    const bool known = std::all_of(c.names.begin(), c.names.end(),
                                   [&](const std::string& name) { return result_of(record, name) != nullptr; });
    w.xml.open("dcc:data");
    if (c.names.size() <= k_most_quantities && in_d_si && known) {
        joint_quantity(w, c);
    } else {
        covariance_table(w, c);
    }
    w.xml.close();
    w.xml.close();
}

}  // namespace gumcert::reports
