#include "reports/agreement/document_facts.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "reports/printable_text.h"

namespace gumcert::reports {

namespace {

class Facts {
public:
    void add(std::string what, const std::string& text) { put(std::move(what), {text}); }

    void add(std::string what, const certificate::LocalisedText& text) {
        std::vector<std::string> spellings{text.plain};
        for (const auto& [language, worded] : text.by_language) {
            spellings.push_back(worded);
        }
        put(std::move(what), std::move(spellings));
    }

    void add(const std::string& whose, const certificate::Item& item) {
        add("serial number of " + whose, item.serial_number);
        add("identification of " + whose, item.identification);
        add("manufacturer of " + whose, item.manufacturer);
        add("type of " + whose, item.type);
        add("owner of " + whose, item.owner);
        add("description of " + whose, item.description);
    }

    void add(const certificate::Method& method) {
        add("method", method.identification);
        add("version of the method", method.version);
        add("standard of the method", method.standard);
    }

    std::vector<DocumentFact> take() && { return std::move(facts_); }

private:
    std::vector<DocumentFact> facts_;

    void put(std::string what, std::vector<std::string> spellings) {
        std::erase_if(spellings, [](const std::string& one) { return one.empty(); });
        for (std::string& one : spellings) {
            one = printable(one);
        }
        if (!spellings.empty()) {
            facts_.push_back({std::move(what), std::move(spellings)});
        }
    }
};

void add_texts(const nlohmann::json& part, std::string& texts) {
    if (part.is_string()) {
        texts += part.get_ref<const std::string&>() + '\n';
    } else if (part.is_structured()) {
        for (const auto& [key, inner] : part.items()) {
            if (key != "svg" && key != "data_uri" && key != "base64") {
                add_texts(inner, texts);
            }
        }
    }
}

}  // namespace

std::vector<DocumentFact> facts_of(const certificate::CertificateData& data) {
    Facts facts;
    facts.add("number", data.number);
    if (data.amendment) {
        facts.add("number of the document that it amends or replaces,", data.amendment->number);
    }
    facts.add("laboratory", data.laboratory.name);
    facts.add("customer", data.customer.name);
    facts.add("order number of the customer", data.customer.order);
    facts.add("the item", data.item);
    facts.add("date of receipt", data.dates.received);
    facts.add("first day of the work", data.dates.performed_from);
    facts.add("last day of the work", data.dates.performed_to);
    facts.add("date of issue", data.dates.issued);
    facts.add("date of authorisation", data.dates.authorised);
    facts.add(data.method);
    for (const auto& [what, person] : {std::pair("person that did the work", &data.persons.performed_by),
                                       {"person that reviewed it", &data.persons.reviewed_by},
                                       {"person that authorises it", &data.persons.authorised_by}}) {
        if (*person) {
            facts.add(what, (*person)->name);
        }
    }
    for (const certificate::SectionData& section : data.sections) {
        if (section.item) {
            facts.add("the item of a section", *section.item);
        }
        if (section.method) {
            facts.add(*section.method);
        }
    }
    for (const certificate::StandardUsed& standard : data.standards) {
        facts.add("identification of a standard", standard.identification);
        facts.add("certificate of a standard", standard.certificate);
    }
    return std::move(facts).take();
}

std::string texts_of_view(const nlohmann::json& view) {
    std::string texts;
    add_texts(view, texts);
    return texts;
}

}  // namespace gumcert::reports
