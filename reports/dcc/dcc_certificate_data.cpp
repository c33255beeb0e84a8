#include "reports/dcc/dcc_certificate_data.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "certificate/dates.h"
#include "reports/dcc/d_si_unit.h"
#include "reports/dcc/dcc_element.h"
#include "reports/dcc/printed_number.h"
#include "text/small_letters.h"

namespace gumcert::reports {

namespace {

const XmlElement* below(const XmlElement* from, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        from = from == nullptr ? nullptr : from->child(name);
    }
    return from;
}

std::string trimmed_text(const XmlElement* element) {
    return element == nullptr ? "" : element->trimmed();
}

/// The day of an xs:date, which may have a time zone; "" for what is none.
std::string day_of(const XmlElement* element) {
    constexpr std::size_t k_day = 10;
    const std::string text = trimmed_text(element).substr(0, k_day);
    return certificate::calendar_date(text) ? text : "";
}

/// Numbers of a quantity in the first unit that it is stated in, and the expanded uncertainty of one of them.
struct StatedNumbers {
    std::vector<double> values;
    std::string unit;
    std::optional<double> U;
};

void add_numbers(std::string_view words, std::vector<double>& values) {
    for (const std::string& word : xml_list(words)) {
        if (const std::optional<PrintedNumber> number = printed_number(word)) {
            values.push_back(number->value);
        }
    }
}

std::optional<StatedNumbers> numbers_of(const XmlElement& quantity) {
    for (const XmlElement& child : quantity.children) {
        if (child.name == "si:hybrid") {
            return numbers_of(child);
        }
        const bool one = child.name == "si:real" || child.name == "si:constant";
        if (!one && child.name != "si:realListXMLList") {
            continue;
        }
        StatedNumbers stated;
        add_numbers(child.child_text(one ? "si:value" : "si:valueXMLList"), stated.values);
        const std::vector<std::string> units = xml_list(child.child_text(one ? "si:unit" : "si:unitXMLList"));
        stated.unit = units.empty() ? "" : unit_from_d_si(units.front()).value_or("");
        for_each_element(child, [&](const XmlElement& e) {
            if ((e.name == "si:valueExpandedMU" || e.name == "si:uncertainty") && !stated.U) {
                const std::optional<PrintedNumber> U = printed_number(e.trimmed());
                stated.U = U ? std::optional(U->value) : std::nullopt;
            }
        });
        if (!stated.values.empty()) {
            return stated;
        }
    }
    return std::nullopt;
}

bool has_ref_type(const XmlElement& element, std::string_view name) {
    const std::vector<std::string> names = xml_list(element.attribute("refType"));
    return std::find(names.begin(), names.end(), name) != names.end();
}

certificate::StandardUsed standard_of(const XmlElement& equipment) {
    certificate::StandardUsed standard;
    standard.name = content_in(equipment.child("dcc:name"), "en");
    const XmlElement* const certificate = equipment.child("dcc:certificate");
    standard.certificate = trimmed_text(below(certificate, {"dcc:referralID"}));
    if (const XmlElement* const identifications = equipment.child("dcc:identifications"); identifications != nullptr) {
        for (const XmlElement* one : identifications->children_named("dcc:identification")) {
            if (standard.identification.empty()) {
                standard.identification = one->child_text("dcc:value");
            }
        }
    }
    standard.role = has_ref_type(equipment, "gumcert_referenceStandard") ? "reference" : "working";
    if (const XmlElement* const all = equipment.child("dcc:measuringEquipmentQuantities"); all != nullptr) {
        for (const XmlElement* quantity : all->children_named("dcc:measuringEquipmentQuantity")) {
            const std::optional<StatedNumbers> number = numbers_of(*quantity);
            if (number && has_ref_type(*quantity, "gumcert_expandedUncertaintyOfStandard")) {
                standard.U = number->values.front();
                standard.unit = number->unit;
            } else if (number && has_ref_type(*quantity, "gumcert_coverageFactorOfStandard")) {
                standard.k = number->values.front();
            }
        }
    }
    return standard;
}

std::string kind_of_condition(const std::string& words) {
    for (const auto& [word, kind] : {std::pair("temperature", "temperature"), std::pair("temperatur", "temperature"),
                                     std::pair("humidity", "humidity"), std::pair("feuchte", "humidity"),
                                     std::pair("pressure", "pressure"), std::pair("luftdruck", "pressure")}) {
        if (words.find(word) != std::string::npos) {
            return kind;
        }
    }
    return "";
}

std::optional<certificate::Condition> condition_of(const XmlElement& stated) {
    certificate::Condition condition;
    condition.quantity = content_in(stated.child("dcc:name"), "en");
    condition.kind =
        kind_of_condition(text::in_small_letters(stated.attribute("refType") + " " + condition.quantity.in("en")));
    std::vector<double> values;
    for_each_element(stated, [&](const XmlElement& e) {
        const std::optional<StatedNumbers> numbers = e.name == "dcc:quantity" ? numbers_of(e) : std::nullopt;
        if (!numbers) {
            return;
        }
        if (has_ref_type(e, "gumcert_expandedUncertaintyOfSensor")) {
            condition.U = numbers->values.front();
            return;
        }
        if (!values.empty() && numbers->unit != condition.unit) {
            return;  // another quantity of the same condition
        }
        condition.unit = numbers->unit;
        condition.U = condition.U ? condition.U : numbers->U;
        values.insert(values.end(), numbers->values.begin(), numbers->values.end());
    });
    if (values.empty()) {
        return std::nullopt;
    }
    // Documents state a condition as one value, as two limits or as a series: least and largest are what all of them
    // tell.
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    condition.minimum = *low;
    condition.maximum = *high;
    return condition;
}

bool has_any_word(const std::string& text, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&text](const char* word) { return text.find(word) != std::string::npos; });
}

/// Persons by what the document says that they did. The main signer authorises; so does the only one that there is.
void read_persons(const XmlElement* all, certificate::Persons& persons) {
    if (all == nullptr) {
        return;
    }
    const std::vector<const XmlElement*> stated = all->children_named("dcc:respPerson");
    const auto take = [](std::optional<certificate::Person>& into, const XmlElement& one) {
        const std::string name = content_in(below(&one, {"dcc:person", "dcc:name"}), "en");
        if (!into && !name.empty()) {
            into = certificate::Person{};
            into->name = name;
            into->function = content_in(one.child("dcc:description"), "en");
        }
    };
    for (const XmlElement* one : stated) {
        const std::string signer = one->child_text("dcc:mainSigner");
        // Before the roles are looked at: the role is a free text in any language, the mark of the main signer is not.
        if (signer == "true" || signer == "1" || stated.size() == 1) {
            take(persons.authorised_by, *one);
        }
    }
    for (const XmlElement* one : stated) {
        const std::string role = text::in_small_letters(one->child_text("dcc:role"));
        if (has_any_word(role, {"approv", "authori", "freigabe", "releas"})) {
            take(persons.authorised_by, *one);
        } else if (has_any_word(role, {"review", "verif", "prüf"})) {
            take(persons.reviewed_by, *one);
        } else if (has_any_word(role, {"calibrat", "kalibrier", "perform", "operator", "durchgef"})) {
            take(persons.performed_by, *one);
        }
    }
}

void read_circumstances(const XmlElement& root, certificate::CertificateData& data) {
    for_each_element(root, [&](const XmlElement& e) {
        if (e.name == "dcc:measuringEquipment") {
            data.standards.push_back(standard_of(e));
        } else if (e.name == "dcc:influenceCondition") {
            if (const std::optional<certificate::Condition> condition = condition_of(e)) {
                data.conditions.push_back(*condition);
            }
        } else if (e.name == "dcc:usedMethod" && data.method.title.empty() && !has_ref_type(e, "basic_uncertainty")) {
            data.method.title = content_in(e.child("dcc:name"), "en");
            data.method.description = content_in(e.child("dcc:description"), "en");
            data.method.standard = e.child_text("dcc:norm");
            data.method.identification = e.child_text("dcc:reference");
        }
    });
}

}  // namespace

std::vector<DccStatement> statements_of(const XmlElement& root) {
    std::vector<DccStatement> statements;
    for_each_element(root, [&](const XmlElement& e) {
        if (e.name == "dcc:statement") {
            statements.push_back({.id = e.attribute("id"),
                                  .ref_type = e.attribute("refType"),
                                  .norm = e.child_text("dcc:norm"),
                                  .reference = e.child_text("dcc:reference"),
                                  .declaration = content_in(e.child("dcc:declaration"), "en")});
        }
    });
    return statements;
}

std::vector<std::string> equipment_out_of_validity(const XmlElement& root) {
    std::vector<std::string> names;
    for_each_element(root, [&](const XmlElement& e) {
        const std::string valid = trimmed_text(below(&e, {"dcc:certificate", "dcc:inValidityRange"}));
        if (e.name == "dcc:measuringEquipment" && (valid == "false" || valid == "0")) {
            names.push_back(content_in(e.child("dcc:name"), "en"));
        }
    });
    return names;
}

certificate::CertificateData certificate_data_of(const XmlElement& root) {
    certificate::CertificateData data;
    const XmlElement* const administrative = root.child("dcc:administrativeData");
    const XmlElement* const core = below(administrative, {"dcc:coreData"});
    data.number = trimmed_text(below(core, {"dcc:uniqueIdentifier"}));
    data.dates.received = day_of(below(core, {"dcc:receiptDate"}));
    data.dates.performed_from = day_of(below(core, {"dcc:beginPerformanceDate"}));
    data.dates.performed_to = day_of(below(core, {"dcc:endPerformanceDate"}));
    data.dates.issued = day_of(below(core, {"dcc:issueDate"}));
    data.laboratory.name =
        content_in(below(administrative, {"dcc:calibrationLaboratory", "dcc:contact", "dcc:name"}), "en");
    data.laboratory.code =
        trimmed_text(below(administrative, {"dcc:calibrationLaboratory", "dcc:calibrationLaboratoryCode"}));
    data.customer.name = content_in(below(administrative, {"dcc:customer", "dcc:name"}), "en");
    const XmlElement* const item = below(administrative, {"dcc:items", "dcc:item"});
    data.item.description = content_in(below(item, {"dcc:name"}), "en");
    data.item.type = trimmed_text(below(item, {"dcc:model"}));
    data.item.manufacturer = content_in(below(item, {"dcc:manufacturer", "dcc:name"}), "en");
    read_persons(below(administrative, {"dcc:respPersons"}), data.persons);
    for (const DccStatement& statement : statements_of(root)) {
        const std::string kind = text::in_small_letters(statement.ref_type);
        if (!data.accreditation && kind.find("accreditation") != std::string::npos) {
            data.accreditation = certificate::Accreditation{};
            data.accreditation->body = statement.declaration;
            data.accreditation->number = statement.reference;
            data.accreditation->standard = statement.norm;
        }
    }
    data.status = data.accreditation ? "accredited" : "not_accredited";
    read_circumstances(root, data);
    return data;
}

}  // namespace gumcert::reports
