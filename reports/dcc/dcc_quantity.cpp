#include "reports/dcc/dcc_quantity.h"

#include <algorithm>

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::reports {

void write_plain_quantity(DccWriter& w, const PlainQuantity& quantity) {
    w.xml.open(quantity.element, {{"refType", quantity.ref_type}});
    w.text("dcc:name", quantity.name);
    w.xml.open("si:real");
    w.optional_string("si:label", quantity.label);
    w.xml.element("si:value", quantity.value);
    w.xml.element("si:unit", d_si_unit(quantity.unit));
    w.xml.close();
    // Quantities of equipment have no place for the definition of a unit.
    if (quantity.element == "dcc:quantity" && needs_unit_definition(quantity.unit)) {
        w.xml.open("dcc:measurementMetaData");
        write_unit_definition(w, quantity.unit);
        w.xml.close();
    }
    w.xml.close();
}

void write_plain_list(DccWriter& w, const PlainList& list) {
    w.xml.open("dcc:quantity", {{"refType", list.ref_type}});
    w.text("dcc:name", list.name);
    w.xml.open("si:realListXMLList");
    w.optional_string("si:labelXMLList", list.label);
    w.xml.element("si:valueXMLList", full_list(list.values));
    w.xml.element("si:unitXMLList", d_si_unit(list.unit));
    w.xml.close();
    write_stage(w, list.stage);
    if (needs_unit_definition(list.unit)) {
        w.xml.open("dcc:measurementMetaData");
        write_unit_definition(w, list.unit);
        w.xml.close();
    }
    w.xml.close();
}

void write_stage(DccWriter& w, const std::string& stage) {
    if (stage.empty()) {
        return;
    }
    const Text name = w.words()("point_table", stage);
    w.xml.open("dcc:influenceConditions");
    w.xml.open("dcc:influenceCondition", {{"refType", w.ref_types()("stage")}});
    w.text("dcc:name", name);
    w.xml.element("dcc:status", stage == "as_found" ? "beforeAdjustment" : "afterAdjustment");
    w.data_sentence(name);
    w.xml.close();
    w.xml.close();
}

std::string full_list(const std::vector<std::string>& entries) {
    std::string text;
    for (const std::string& entry : entries) {
        if (!text.empty()) {
            text += ' ';
        }
        text += entry;
    }
    return text;
}

std::string joined_list(const std::vector<std::string>& entries) {
    const bool same =
        std::all_of(entries.begin(), entries.end(), [&](const std::string& e) { return e == entries.front(); });
    return same && !entries.empty() ? entries.front() : full_list(entries);
}

bool needs_unit_definition(const std::string& udunits) {
    return d_si_unit(udunits).starts_with('|');
}

namespace {

/// "1 inch = 0.0254 m"; without numbers for a unit that nobody knows.
Text definition_of(const Wording& words, const std::string& udunits) {
    try {
        const gum::Unit unit = gum::Unit::parse(udunits);
        return words.filled("dcc", "non_si_definition",
                            {{"unit", udunits},
                             {"factor", certificate::printed_limit(unit.difference_to_si(1.0), 0)},
                             {"si", unit.dimension().text()}});
    } catch (const gum::InputError&) {
        return udunits;
    }
}

}  // namespace

void write_unit_definition(DccWriter& w, const std::string& udunits) {
    if (!needs_unit_definition(udunits)) {
        return;
    }
    w.xml.open("dcc:metaData", {{"refType", w.ref_types()("non_si_unit")}});
    w.optional_string("dcc:nonSIDefinition", definition_of(w.words(), udunits).first());
    w.xml.element("dcc:nonSIUnit", d_si_unit(udunits));
    w.xml.close();
}

std::string unit_of_uncertainty(const std::string& udunits) {
    try {
        // An uncertainty is a difference: U of a temperature in °C is in kelvins, since D-SI would read 0.1 °C as a
        // temperature with its origin.
        return gum::unit_of_difference(udunits);
    } catch (const gum::InputError&) {
        return udunits;  // not a unit: it is written as the text that it is
    }
}

std::string dcc_release(const std::string& version) {
    constexpr int k_most_points = 3;
    std::string release = "v";
    int points = 0;
    for (const char c : version) {
        const bool point = c == '.' && release.size() > 1 && release.back() != '.' && points < k_most_points;
        if (!(c >= '0' && c <= '9') && !point) {
            break;
        }
        points += point ? 1 : 0;
        release += c;
    }
    while (release.back() == '.') {
        release.pop_back();
    }
    return release.size() > 1 ? release : "v0";
}

}  // namespace gumcert::reports
