#include "reports/dcc/dcc_joint_results.h"
#include "encoding/base64.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gum/rounding.h"
#include "reports/dcc/dcc_quantity.h"
#include "text/csv_field.h"

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

/// Unit of the difference of two values of a result.
struct DifferenceUnit {
    std::string d_si;
    bool one_name = false;  ///< one unit, with a prefix or without, and no product

    explicit DifferenceUnit(const std::string& udunits) : d_si(d_si_unit(unit_of_uncertainty(udunits))) {
        // Behind a product an exponent would belong to its last factor alone.
        one_name = std::all_of(udunits.begin(), udunits.end(),
                               [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); });
    }
};

/// Unit of a covariance: the product of the units of two results.
std::string product_of(const DifferenceUnit& a, const DifferenceUnit& b) {
    if (a.d_si == "\\one") {
        return b.d_si;
    }
    if (b.d_si == "\\one") {
        return a.d_si;
    }
    return a.d_si == b.d_si && a.one_name ? a.d_si + "\\tothe{2}" : a.d_si + b.d_si;
}

void matrix_of(DccWriter& w, const ResultCovariance& c) {
    const std::vector<DifferenceUnit> units(c.units.begin(), c.units.end());
    w.xml.open("si:covarianceMatrixXMLList");
    for (std::size_t column = 0; column < c.names.size(); ++column) {
        w.xml.open("si:columnXMLList");
        for (std::size_t row = 0; row < c.names.size(); ++row) {
            w.xml.open("si:covarianceXMLList");
            w.xml.element("si:valueXMLList", d_si_number(c.matrix[row][column]));
            w.xml.element("si:unitXMLList", product_of(units[row], units[column]));
            w.xml.close();
        }
        w.xml.close();
    }
    w.xml.close();
}

/// The region for all results together that the record states: the ellipsoid, or the rectangle where the covariance is
/// singular and there is no ellipsoid.
struct Region {
    const char* element = "si:ellipsoidalRegionMUXMLList";
    std::string k = "NaN", p = "NaN";
};

/// \param results  how many of them are in the matrix
Region region_of(const EvaluationRecord& record, std::size_t results) {
    const auto& region = record.region;
    // The factor of a region depends on the number of results that are in it. One of a part of them would be too large
    // or too small for the matrix.
    if (!region || record.results.size() != results) {
        return {};
    }
    const bool ellipsoid = region->k_p.number.has_value();
    if (!ellipsoid && !region->k_q.number) {
        return {};
    }
    const std::string k = d_si_coverage_factor(ellipsoid ? region->k_p.text : region->k_q.text);
    if (k == "NaN") {
        return {};
    }
    return {.element = ellipsoid ? "si:ellipsoidalRegionMUXMLList" : "si:rectangularRegionMUXMLList",
            .k = k,
            .p = d_si_probability(region->coverage_probability)};
}

/// What the certificate states for a result; nullptr where it has no row for it.
const certificate::CertifiedValue* certified_value(const DccWriter& w, const Result& r) {
    const std::string quantity = r.quantity.empty() ? r.name : r.quantity;
    for (const certificate::CertifiedTable& table : w.all_tables()) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            if (column.result != quantity) {
                continue;
            }
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                const bool same_point = r.point.empty() || (table.argument && row < table.argument->printed.size() &&
                                                            table.argument->printed[row] == r.point);
                if (same_point) {
                    return &column.values[row];
                }
            }
        }
    }
    return nullptr;
}

/// Which of the joint results are within the scope of accreditation. One whose U was raised to the capability is not:
/// the uncertainty that follows from the covariance is smaller than the laboratory may state.
void scope_of_joint_results(DccWriter& w, const std::vector<const certificate::CertifiedValue*>& certified) {
    if (!w.has_scope()) {
        return;
    }
    std::vector<std::string> in_scope;
    for (const certificate::CertifiedValue* v : certified) {
        const bool valid = v != nullptr && !v->scope_entry.empty() && !v->external && !v->raised;
        in_scope.emplace_back(valid ? "true" : "false");
    }
    w.xml.open("dcc:measurementMetaData");
    w.xml.open("dcc:metaData", {{"refId", "scope"}, {"refType", w.ref_types()("capability")}});
    w.xml.element("dcc:validXMLList", full_list(in_scope));
    w.xml.close();
    w.xml.close();
}

void joint_quantity(DccWriter& w, const ResultCovariance& c) {
    std::vector<std::string> labels;
    std::vector<std::string> values;
    std::vector<std::string> units;
    std::vector<std::string> uncertainties;
    std::vector<const certificate::CertifiedValue*> certified;
    for (std::size_t i = 0; i < c.names.size(); ++i) {
        const Result& r = *result_of(w.record(), c.names[i]);
        labels.push_back(as_token(c.names[i]));
        certified.push_back(certified_value(w, r));
        values.push_back(required_d_si_number(
            certified.back() == nullptr ? r.printed.value : certified.back()->printed_value, r.name));
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
    const Region region = region_of(w.record(), c.names.size());
    w.xml.open(region.element);
    matrix_of(w, c);
    w.xml.element("si:coverageFactorXMLList", region.k);
    w.xml.element("si:coverageProbabilityXMLList", region.p);
    w.xml.close();
    w.xml.close();
    w.xml.close();
    scope_of_joint_results(w, certified);
    w.xml.close();
}

/// Without exact results: they have no covariance, and a standard uncertainty of 0 is no statement of one.
ResultCovariance without_exact_results(const EvaluationRecord& record, const ResultCovariance& all) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < all.names.size(); ++i) {
        const Result* const result = result_of(record, all.names[i]);
        if (result == nullptr || result->u != 0.0 || all.matrix[i][i] != 0.0) {
            kept.push_back(i);
        }
    }
    ResultCovariance out = all;
    out.names.clear();
    out.units.clear();
    out.matrix.clear();
    for (const std::size_t i : kept) {
        out.names.push_back(all.names[i]);
        out.units.push_back(all.units[i]);
        std::vector<double>& row = out.matrix.emplace_back();
        for (const std::size_t j : kept) {
            row.push_back(all.matrix[i][j]);
        }
    }
    return out;
}

std::string csv_of(const ResultCovariance& c) {
    std::string csv = "result,unit";
    for (const std::string& name : c.names) {
        csv += "," + text::quoted_csv_field(name);
    }
    csv += "\n";
    for (std::size_t row = 0; row < c.names.size(); ++row) {
        csv += text::quoted_csv_field(c.names[row]) + "," + text::quoted_csv_field(c.units[row]);
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
    const bool is_here = !in_file && is_square(*record.covariance);
    const ResultCovariance c = is_here ? without_exact_results(record, *record.covariance) : ResultCovariance();
    if (is_here && c.names.empty()) {
        return;  // all of them are exact
    }
    w.xml.open("dcc:result");
    w.text("dcc:name", w.words()("dcc", "joint"));
    if (!is_here) {
        w.data_sentence(w.words().filled(
            "dcc", "covariance_file", {{"file", in_file ? *record.rotary->covariance_file : record.covariance->file}}));
        w.xml.close();
        return;
    }
    // A product with a unit that D-SI does not have would need a definition of its own for each element of the matrix.
    // The table in CSV states the units of the results instead.
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
