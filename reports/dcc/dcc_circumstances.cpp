#include <algorithm>
#include <optional>

#include "gum/quantity/unit.h"
#include "reports/dcc/dcc_quantity.h"
#include "reports/dcc/dcc_writer.h"
#include "reports/deviations.h"

namespace gumcert::reports {

namespace {

bool uses_monte_carlo(const EvaluationRecord& record) {
    const auto has = [](const auto& list) {
        return std::any_of(list.begin(), list.end(), [](const auto& r) { return r.monte_carlo.has_value(); });
    };
    return has(record.results) || (record.rotary && record.rotary->monte_carlo);
}

void calibration_method(DccWriter& w) {
    const certificate::Method& m = w.data().method;
    const Wording& words = w.words();
    if (m.identification.empty() && m.title.empty() && m.standard.empty()) {
        return;
    }
    w.xml.open("dcc:usedMethod", {{"refType", w.ref_types()("method")}});
    w.text("dcc:name", m.title.empty() ? Text(m.identification) : words.localised(m.title));
    Text description = words.localised(m.description);
    std::vector<Text> deviations = deviations_in_words(words, w.data());
    if (deviations.empty() && m.no_deviations) {
        deviations.push_back(words("certificate", "none"));
    }
    for (const Text& deviation : deviations) {
        append_line(description, words("certificate", "deviations") + ": " + deviation);
    }
    w.optional_text("dcc:description", description);
    w.optional_string("dcc:norm", m.standard);
    w.optional_string("dcc:reference", m.identification + (m.version.empty() ? "" : " " + m.version));
    w.xml.close();
}

void methods(DccWriter& w) {
    const Wording& words = w.words();
    w.xml.open("dcc:usedMethods");
    calibration_method(w);
    w.xml.open("dcc:usedMethod", {{"refType", w.ref_types()("uncertainty")}});
    w.text("dcc:name", words("dcc", "uncertainty_method"));
    w.text("dcc:description", words("dcc", "uncertainty_text"));
    w.xml.element("dcc:norm", "JCGM 100:2008");
    w.xml.close();
    if (uses_monte_carlo(w.record())) {
        w.xml.open("dcc:usedMethod", {{"refType", w.ref_types()("monte_carlo")}});
        w.text("dcc:name", words("dcc", "monte_carlo_method"));
        w.xml.element("dcc:norm", "JCGM 101:2008");
        w.xml.close();
    }
    w.xml.close();
}

void software_used(DccWriter& w) {
    w.xml.open("dcc:usedSoftware");
    w.xml.open("dcc:software");
    w.text("dcc:name", w.record().software.name);
    w.xml.element("dcc:release", dcc_release(w.record().software.version));
    w.text("dcc:description", w.words()("dcc", "evaluation"));
    w.xml.close();
    w.xml.close();
}

/// The certificate of a standard, as a link that can be checked where the digest of its file is stated. The format
/// wants a procedure and a value in any case.
void certificate_of(DccWriter& w, const certificate::StandardUsed& s) {
    if (without_outer_blanks(s.certificate).empty()) {
        return;
    }
    const std::string not_stated = w.words()("dcc", "not_stated").first();
    w.xml.open("dcc:certificate");
    w.text("dcc:referral", w.words()("dcc", "certificate_of_standard"));
    w.optional_string("dcc:referralID", s.certificate);
    w.xml.element("dcc:procedure", s.sha256.empty() ? not_stated : "SHA-256");
    w.xml.element("dcc:value", s.sha256.empty() ? not_stated : s.sha256);
    const std::string performed = date_or_nothing(w.data().dates.performed_to);
    const std::string valid_to = date_or_nothing(s.valid_to);
    // The statement is about the day of the calibration, not about the day of issue. Dates of this form sort as texts.
    if (!performed.empty() && !valid_to.empty()) {
        const std::string calibrated = date_or_nothing(s.calibrated);
        w.xml.element("dcc:inValidityRange", calibrated <= performed && performed <= valid_to ? "true" : "false");
    }
    w.xml.close();
}

void standard(DccWriter& w, const certificate::StandardUsed& s) {
    const Wording& words = w.words();
    w.xml.open("dcc:measuringEquipment",
               {{"refType", w.ref_types()(s.role == "reference" ? "standard" : "instrument")}});
    w.text("dcc:name", words.localised(s.name));
    Text description;
    const auto line = [&](const char* label, const Text& value) {
        if (!value.empty()) {
            append_line(description, words("certificate", label) + ": " + value);
        }
    };
    line("standard_certificate", s.certificate);
    line("issuer", words.localised(s.issuer) +
                       (s.issuer_accreditation.empty() ? Text() : Text(" (" + s.issuer_accreditation + ")")));
    line("calibrated", s.calibrated);
    line("valid_to", s.valid_to);
    // Quantities of equipment have no place for the definition of a unit.
    // One quantity would state one U for all that was used.
    const bool has_quantity = s.U && !s.U_to && s.further.empty() && !needs_unit_definition(s.unit);
    line("k", s.k && !has_quantity ? words.number(d_si_number(*s.k)) : Text());
    const auto from_to = [&](double U, const std::optional<double>& U_to, const std::string& unit) {
        const auto with_unit_of = [&](double number) { return words.number(d_si_number(number)) + (" " + unit); };
        return U_to ? words.filled("certificate", "from_to", {{"low", with_unit_of(U)}, {"high", with_unit_of(*U_to)}})
                    : with_unit_of(U);
    };
    if (s.U && !has_quantity) {
        line("standard_U", from_to(*s.U, s.U_to, s.unit));
    }
    for (const certificate::StandardUsed::FurtherUncertainty& one : s.further) {
        const Text k = one.k ? "; " + words("certificate", "k") + ": " + words.number(d_si_number(*one.k)) : Text();
        line("standard_U", from_to(one.U, one.U_to, one.unit) + k);
    }
    w.optional_text("dcc:description", description);
    certificate_of(w, s);
    if (!without_outer_blanks(s.identification).empty()) {
        w.xml.open("dcc:identifications");
        w.xml.open("dcc:identification");
        w.xml.element("dcc:issuer", "calibrationLaboratory");
        w.optional_string("dcc:value", s.identification);
        w.xml.close();
        w.xml.close();
    }
    if (has_quantity) {
        w.xml.open("dcc:measuringEquipmentQuantities");
        write_plain_quantity(w, {.element = "dcc:measuringEquipmentQuantity",
                                 .name = words("dcc", "standard_uncertainty"),
                                 .ref_type = w.ref_types()("standard_uncertainty"),
                                 .value = d_si_number(*s.U),
                                 .unit = s.unit});
        if (s.k) {
            write_plain_quantity(w, {.element = "dcc:measuringEquipmentQuantity",
                                     .name = words("certificate", "k"),
                                     .ref_type = w.ref_types()("standard_coverage_factor"),
                                     .value = d_si_number(*s.k),
                                     .unit = "1"});
        }
        w.xml.close();
    }
    w.xml.close();
}

void equipment(DccWriter& w) {
    if (w.data().standards.empty()) {
        return;
    }
    w.xml.open("dcc:measuringEquipments");
    for (const certificate::StandardUsed& s : w.data().standards) {
        standard(w, s);
    }
    w.xml.close();
}

void condition(DccWriter& w, const certificate::Condition& c) {
    const Wording& words = w.words();
    const bool known = c.kind == "temperature" || c.kind == "humidity" || c.kind == "pressure";
    const std::string kind = known ? c.kind : "condition";
    const auto line = [&](const char* label, const Text& value) {
        return value.empty() ? Text() : words("certificate", label) + ": " + value;
    };
    w.xml.open("dcc:influenceCondition", {{"refType", w.ref_types()(kind)}});
    w.text("dcc:name", words.localised(c.quantity));
    Text description = line("sensor", c.sensor);
    const auto limit = [&](const std::optional<double>& value) {
        return value ? words.number(d_si_number(*value)) + (" " + gum::unit_for_people(c.unit)) : Text();
    };
    append_line(description, line("lower_limit", limit(c.lower_limit)));
    append_line(description, line("upper_limit", limit(c.upper_limit)));
    w.optional_text("dcc:description", description);
    w.xml.open("dcc:data");
    const auto quantity = [&](const Text& name, const std::string& ref_type, double value, const std::string& unit) {
        write_plain_quantity(w, {.element = "dcc:quantity",
                                 .name = name,
                                 .ref_type = w.ref_types()(ref_type),
                                 .value = d_si_number(value),
                                 .unit = unit});
    };
    quantity(words("dcc", "minimum"), kind + "_minimum", c.minimum, c.unit);
    quantity(words("dcc", "maximum"), kind + "_maximum", c.maximum, c.unit);
    if (c.U) {
        quantity(words("dcc", "sensor_uncertainty"), "sensor_uncertainty", *c.U, unit_of_uncertainty(c.unit));
    }
    w.xml.close();
    w.xml.close();
}

void conditions(DccWriter& w) {
    w.xml.open("dcc:influenceConditions");
    for (const certificate::Condition& c : w.data().conditions) {
        condition(w, c);
    }
    if (w.data().conditions.empty()) {
        w.xml.open("dcc:influenceCondition", {{"refType", w.ref_types()("condition")}});
        w.text("dcc:name", w.words()("dcc", "conditions"));
        w.data_sentence(w.words()("dcc", "no_conditions"));
        w.xml.close();
    }
    w.xml.close();
}

}  // namespace

void write_circumstances(DccWriter& w) {
    methods(w);
    software_used(w);
    equipment(w);
    conditions(w);
}

}  // namespace gumcert::reports
