#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "certificate/address_lines.h"
#include "certificate/section_data.h"
#include "reports/dcc/dcc_quantity.h"
#include "reports/dcc/dcc_writer.h"
#include "reports/view/certificate_conformity_section.h"
#include "reports/view/certificate_identity_sections.h"

namespace gumcert::reports {

namespace {

using certificate::CertificateData;
using certificate::LocalisedText;

constexpr const char* k_no_date = "0001-01-01";  // where the format wants a date and none is stated

/// Two capital letters, as the format wants it; ZZ, which ISO 3166-1 leaves to users, where none is stated.
std::string country_or_unknown(const std::string& country) {
    const auto capital = [](char c) { return c >= 'A' && c <= 'Z'; };
    return country.size() == 2 && capital(country[0]) && capital(country[1]) ? country : "ZZ";
}

/// Addresses of the web go into elements that are checked as such; anything unusual stays a text.
bool is_plain_link(const std::string& text) {
    const bool web = text.starts_with("https://") || text.starts_with("http://");
    return web && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      std::string_view(":/.-_~").find(c) != std::string_view::npos;
           });
}

void software(DccWriter& w) {
    const Software& s = w.record().software;
    w.xml.open("dcc:software");
    w.text("dcc:name", s.name);
    w.xml.element("dcc:release", dcc_release(s.version));
    w.xml.element("dcc:type", "application");
    w.text("dcc:description",
           w.words().filled("dcc", "software_version", {{"version", s.version}, {"commit", s.commit}}));
    w.xml.close();
}

void ref_type_definitions(DccWriter& w) {
    w.xml.open("dcc:refTypeDefinitions");
    for (const RefTypes::Definition& definition : w.ref_types().definitions()) {
        w.xml.open("dcc:refTypeDefinition");
        w.text("dcc:name", definition.name);
        if (definition.space == "gumcert") {
            w.text("dcc:description", w.words()("dcc", "names_of_program"));
        }
        w.xml.element("dcc:namespace", definition.space);
        w.xml.element("dcc:link", definition.link);
        w.xml.close();
    }
    w.xml.close();
}

void identification(DccWriter& w, const char* issuer, const std::string& value, const Text& name,
                    const std::string& ref_type) {
    w.xml.open("dcc:identification", {{"refType", w.ref_types()(ref_type)}});
    w.xml.element("dcc:issuer", issuer);
    w.optional_string("dcc:value", value);
    w.optional_text("dcc:name", name);
    w.xml.close();
}

void amendment(DccWriter& w) {
    const auto& amendment = w.data().amendment;
    if (!amendment || without_outer_blanks(amendment->number).empty()) {
        return;
    }
    w.xml.open("dcc:reportAmendedSubstituted");
    w.xml.element("dcc:typeOfChange", amendment->kind == "replaced" ? "substituted" : "amended");
    w.optional_string("dcc:replacedUniqueIdentifier", amendment->number);
    w.xml.close();
    if (amendment->sha256.empty()) {
        return;  // without the file there is nothing to check it by; the statement says what changed
    }
    w.xml.open("dcc:previousReport");
    w.text("dcc:referral", w.words()("dcc", "earlier_certificate"));
    w.optional_string("dcc:referralID", amendment->number);
    w.xml.element("dcc:procedure", "SHA-256");
    w.optional_string("dcc:value", amendment->sha256);
    w.optional_text("dcc:description", w.words().localised(amendment->reason));
    w.xml.close();
}

void core_data(DccWriter& w) {
    const CertificateData& d = w.data();
    w.xml.open("dcc:coreData");
    w.xml.element("dcc:countryCodeISO3166_1", country_or_unknown(d.laboratory.address.country));
    for (const std::string& language : w.words().languages()) {
        w.xml.element("dcc:usedLangCodeISO639_1", iso_639_1(language));
    }
    w.xml.element("dcc:mandatoryLangCodeISO639_1", iso_639_1(w.words().language()));
    w.optional_string("dcc:uniqueIdentifier",
                      without_outer_blanks(d.number).empty() ? w.not_stated().first() : d.number);
    if (!without_outer_blanks(d.customer.order).empty()) {
        w.xml.open("dcc:identifications");
        identification(w, "customer", d.customer.order, w.words()("certificate", "order"), "order");
        w.xml.close();
    }
    w.optional_string("dcc:receiptDate", date_or_nothing(d.dates.received));
    const std::string from = date_or_nothing(d.dates.performed_from);
    const std::string to = date_or_nothing(d.dates.performed_to);
    const std::string first = from.empty() ? to : from;
    const std::string last = to.empty() ? from : to;
    w.xml.element("dcc:beginPerformanceDate", first.empty() ? k_no_date : first);
    w.xml.element("dcc:endPerformanceDate", last.empty() ? k_no_date : last);
    const bool known = w.record().certificate.has_value();
    w.xml.element("dcc:performanceLocation", known && d.place.kind == "laboratory"      ? "laboratory"
                                             : known && d.place.kind == "customer_site" ? "customer"
                                                                                        : "other");
    w.optional_string("dcc:issueDate", date_or_nothing(d.dates.issued));
    amendment(w);
    w.xml.close();
}

/// "Nominal value 0.5 mm"
Text nominal_value(DccWriter& w, const SetPiece::Nominal& nominal) {
    const Wording& words = w.words();
    const Text heading = nominal.heading.empty() ? words("point_table", "nominal") : words.localised(nominal.heading);
    return heading + " " + words.number(nominal.printed) +
           (nominal.printed_unit.empty() ? "" : " " + nominal.printed_unit);
}

/// A gauge block of a set, a weight: what the points say of it. What the set has in common stands at the set.
void piece_of_set(DccWriter& w, const SetPiece& piece, bool has_number_of_customer) {
    const Wording& words = w.words();
    const Text serial_number = words("dcc", "serial_number");
    const Text identified = words("dcc", "identification");
    w.xml.open("dcc:item", {{"id", piece.id}});
    w.text("dcc:name", piece.nominal                 ? nominal_value(w, *piece.nominal)
                       : piece.serial_number.empty() ? identified + (" " + piece.identification)
                                                     : serial_number + (" " + piece.serial_number));
    w.xml.open("dcc:identifications");
    if (!piece.serial_number.empty()) {
        identification(w, "manufacturer", piece.serial_number, serial_number, "serial_number");
    }
    if (!piece.identification.empty()) {
        identification(w, has_number_of_customer ? "customer" : "calibrationLaboratory", piece.identification,
                       identified, "identification");
    }
    w.xml.close();
    if (piece.nominal) {
        w.xml.open("dcc:itemQuantities");
        write_plain_quantity(w, {.element = "dcc:itemQuantity",
                                 .name = words("point_table", "nominal"),
                                 .ref_type = w.ref_types()("role_nominal"),
                                 .value = required_d_si_number(piece.nominal->printed, "nominal value"),
                                 .unit = piece.nominal->unit});
        w.xml.close();
    }
    w.xml.close();
}

void pieces_of_set(DccWriter& w, const std::string& item, bool has_numbers_of_customer) {
    const std::vector<SetPiece> pieces = w.pieces().of_item(item);
    if (pieces.empty()) {
        return;
    }
    w.xml.open("dcc:subItems");
    for (const SetPiece& piece : pieces) {
        piece_of_set(w, piece, has_numbers_of_customer);
    }
    w.xml.close();
}

/// "Condition on receipt: No damage seen", a fact a line.
Text facts_in_lines(const Wording& words, const std::vector<std::pair<const char*, Text>>& facts) {
    Text lines;
    for (const auto& [label, value] : facts) {
        if (!value.empty()) {
            lines += (lines.empty() ? Text() : Text("\n")) + words("certificate", label) + ": " + value;
        }
    }
    return lines;
}

/// What the customer stated of an item, each key once: sections of one item may say it each for itself.
std::vector<std::string> stated_by_customer(const CertificateData& data, const certificate::Item& item) {
    std::vector<std::string> keys = item.stated_by_customer;
    for (const certificate::SectionData& section : data.sections) {
        if (!section.item || !certificate::is_same_item(*section.item, item)) {
            continue;
        }
        for (const std::string& key : section.item->stated_by_customer) {
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
                keys.push_back(key);
            }
        }
    }
    return keys;
}

/// \param id  "" for one that no result is of
void item(DccWriter& w, const certificate::Item& i, const std::string& id) {
    const Wording& words = w.words();
    w.xml.open("dcc:item", {{"id", id}});
    w.text("dcc:name", words.localised(i.description));
    std::vector<Text> conditions{words.localised(i.condition)}, owners{i.owner};
    for (const certificate::SectionData& section : w.data().sections) {
        if (!section.item || !certificate::is_same_item(*section.item, i)) {
            continue;
        }
        // Sections may state another condition, or another owner, of one item.
        const auto add = [](std::vector<Text>& known, const Text& one) {
            if (std::find(known.begin(), known.end(), one) == known.end()) {
                known.push_back(one);
            }
        };
        add(conditions, words.localised(section.item->condition));
        add(owners, section.item->owner);
    }
    std::vector<std::pair<const char*, Text>> facts;
    for (const Text& one : conditions) {
        facts.emplace_back("condition", one);
    }
    for (const Text& one : owners) {
        facts.emplace_back("owner", one);
    }
    w.optional_text("dcc:description", facts_in_lines(words, facts));
    if (!without_outer_blanks(i.manufacturer).empty()) {
        w.xml.open("dcc:manufacturer");
        w.text("dcc:name", i.manufacturer);
        w.xml.close();
    }
    w.optional_string("dcc:model", i.type);
    w.xml.open("dcc:identifications");
    const std::vector<std::string> of_customer = stated_by_customer(w.data(), i);
    const bool has_number_of_customer =
        std::find(of_customer.begin(), of_customer.end(), "identification") != of_customer.end();
    const bool has_serial = !without_outer_blanks(i.serial_number).empty();
    const bool has_own = !without_outer_blanks(i.identification).empty();
    if (has_serial) {
        identification(w, "manufacturer", i.serial_number, words("dcc", "serial_number"), "serial_number");
    }
    if (has_own) {
        identification(w, has_number_of_customer ? "customer" : "calibrationLaboratory", i.identification,
                       words("dcc", "identification"), "identification");
    }
    if (!has_serial && !has_own) {
        identification(w, "other", w.not_stated().first(), {}, "identification");
    }
    w.xml.close();
    pieces_of_set(w, id, has_number_of_customer);
    w.xml.close();
}

/// The item of the certificate, then those of sections that have one of their own.
void items(DccWriter& w) {
    w.xml.open("dcc:items");
    const std::vector<SectionSummary>& sections = w.record().sections;
    const bool is_of_results =
        sections.empty() || std::any_of(sections.begin(), sections.end(), [&](const SectionSummary& section) {
            return w.item_id(section.name) == "item_1";
        });
    const certificate::Item& of_all = w.data().item;
    if (certificate::stated_by_sections(w.data(), w.all_tables()).item) {
        const Wording& words = w.words();
        w.optional_text("dcc:name", words.localised(of_all.description));
        w.optional_text("dcc:description", facts_in_lines(words, {{"condition", words.localised(of_all.condition)},
                                                                  {"owner", of_all.owner},
                                                                  {"manufacturer", of_all.manufacturer},
                                                                  {"type", of_all.type}}));
    } else {
        item(w, of_all, is_of_results ? "item_1" : "");
    }
    std::set<std::string> written{"item_1"};
    for (const certificate::SectionData& section : w.data().sections) {
        if (section.item && written.insert(w.item_id(section.section)).second) {
            item(w, *section.item, w.item_id(section.section));
        }
    }
    w.xml.close();
}

void location(DccWriter& w, const certificate::Address& address, const std::string& contact,
              const std::string& web = {}) {
    w.xml.open("dcc:location");
    bool any = false;
    for (const std::string& line : address.lines) {
        if (!without_outer_blanks(line).empty()) {
            w.text("dcc:further", line);
            any = true;
        }
    }
    using Part = std::pair<const char*, const std::string*>;
    for (const auto& [element, part] :
         {Part{"dcc:street", &address.street}, Part{"dcc:streetNo", &address.street_no},
          Part{"dcc:postOfficeBox", &address.post_office_box}, Part{"dcc:postCode", &address.postcode},
          Part{"dcc:city", &address.city}, Part{"dcc:state", &address.state}}) {
        any = any || !without_outer_blanks(*part).empty();
        w.optional_string(element, *part);
    }
    for (const std::string& line : {contact, web}) {
        if (!without_outer_blanks(line).empty()) {
            w.text("dcc:further", line);
            any = true;
        }
    }
    if (country_or_unknown(address.country) == address.country) {
        w.xml.element("dcc:countryCode", address.country);
        any = true;
    }
    if (!any) {
        w.text("dcc:further", w.not_stated());
    }
    w.xml.close();
}

void laboratory(DccWriter& w) {
    const certificate::Laboratory& l = w.data().laboratory;
    w.xml.open("dcc:calibrationLaboratory");
    w.optional_string("dcc:calibrationLaboratoryCode", l.code);
    w.xml.open("dcc:contact");
    w.text("dcc:name", w.words().localised(l.name));
    w.optional_string("dcc:eMail", l.email);
    w.optional_string("dcc:phone", l.telephone);
    const bool link = is_plain_link(l.web);
    if (link) {
        w.xml.element("dcc:link", l.web);
    }
    location(w, l.address, {}, link ? "" : l.web);
    w.xml.close();
    w.xml.close();
}

void person(DccWriter& w, const Text& name, const Text& function, const char* role, bool main_signer) {
    w.xml.open("dcc:respPerson");
    w.xml.open("dcc:person");
    w.text("dcc:name", name);
    w.xml.close();
    w.optional_text("dcc:description", function);
    w.xml.element("dcc:role", role);
    if (main_signer) {
        w.xml.element("dcc:mainSigner", "true");
    }
    w.xml.close();
}

void persons(DccWriter& w) {
    const certificate::Persons& p = w.data().persons;
    w.xml.open("dcc:respPersons");
    if (p.authorised_by) {
        person(w, p.authorised_by->name, w.words().localised(p.authorised_by->function), "approval", true);
    } else {
        person(w, w.not_stated(), {}, "approval", false);
    }
    if (p.reviewed_by) {
        person(w, p.reviewed_by->name, w.words().localised(p.reviewed_by->function), "review", false);
    }
    if (p.performed_by) {
        person(w, p.performed_by->name, w.words().localised(p.performed_by->function), "calibration", false);
    }
    w.xml.close();
}

void customer(DccWriter& w) {
    const certificate::Customer& c = w.data().customer;
    w.xml.open("dcc:customer");
    w.text("dcc:name", w.words().localised(c.name));
    w.optional_string("dcc:eMail", c.email);
    location(w, c.address, c.contact);
    w.xml.close();
}

void status_statements(DccWriter& w) {
    const Wording& words = w.words();
    const auto& certificate = w.record().certificate;
    if (w.is_specimen()) {
        Text text = words("document", "mark");
        append_line(text, certificate ? words("document", "specimen_reason") : words("document", "mark_reason"));
        append_line(text, words("dcc", "placeholders"));
        w.statement("specimen", text);
    } else if (w.data().status == "not_accredited") {
        w.statement("not_accredited", words("statement", "outside_of_accreditation"));
    }
    if (certificate && certificate->blocked) {
        Text text = words("document", "draft");
        append_line(text, words("document", "draft_reason"));
        w.statement("draft", text);
        for (const certificate::Finding& finding : certificate->findings) {
            Text finding_text = finding.id + " (" + finding.clause + ") " + words.sentence(finding.where) + ": " +
                                words.sentence(finding.what);
            if (!finding.action.empty()) {
                finding_text += " " + words.sentence(finding.action);
            }
            w.statement("finding", finding_text);
        }
    }
    if (certificate && !certificate->superseded_by.empty()) {
        Text text = words.filled("document", "superseded", {{"number", certificate->superseded_by}});
        append_line(text, words("document", "superseded_reason"));
        w.statement("superseded", text);
    }
    if (w.has_scope() && certificate->symbol) {
        const certificate::Accreditation& a = *w.data().accreditation;
        w.xml.open("dcc:statement", {{"refType", w.ref_types()("accreditation")}});
        w.optional_string("dcc:norm", a.standard);
        w.optional_string("dcc:reference", a.number);
        w.text("dcc:declaration", words("certificate", "accredited_by") + ": " + words.localised(a.body));
        w.xml.close();
    }
    if (w.has_scope()) {
        w.statement("capability", words("dcc", "capability"), w.tables().empty() ? "" : "scope");
    }
    if (!w.changed_templates.empty()) {
        w.xml.open("dcc:statement", {{"refType", w.ref_types()("changed_templates")}});
        w.optional_string("dcc:reference", w.changed_templates);
        w.text("dcc:declaration", words.filled("document", "changed_templates", {{"digest", w.changed_templates}}));
        w.xml.close();
    }
}

void decision_rules(DccWriter& w) {
    const Wording& words = w.words();
    for (const certificate::AgreedSpecification& s : w.data().specifications) {
        const bool decided = w.is_decided(s.id);
        w.xml.open("dcc:statement",
                   {{"id", decided ? w.specification_id(s.id) : ""}, {"refType", w.ref_types()("conformity")}});
        w.optional_string("dcc:norm", s.document + (s.edition.empty() ? "" : ", " + s.edition));
        w.optional_string("dcc:reference", s.clause);
        Text text = words("certificate", "decision_rule") + ": " + s.rule.id;
        if (words.has("rule_name", s.rule.id)) {
            text += Text(", ") + words("rule_name", s.rule.id);
        }
        for (const auto& [label, condition] : conditions_of_rule(s, words)) {
            append_line(text, label + ": " + condition);
        }
        append_line(text, words.localised(s.rule.text));
        if (!s.rule.prescribed_by.empty()) {
            append_line(text, words("certificate", "prescribed_by") + ": " + s.rule.prescribed_by);
        }
        w.text("dcc:declaration", text);
        w.xml.close();
    }
    if (w.record().certificate && w.data().specifications.empty()) {
        w.statement("conformity", words("statement", "no_conformity"));
    }
}

void amendment_statement(DccWriter& w) {
    const auto& a = w.data().amendment;
    if (!a) {
        return;
    }
    const Wording& words = w.words();
    Text text = words.filled("statement", a->kind == "replaced" ? "replaced" : "amended", {{"number", a->number}});
    append_line(text, words.localised(a->reason));
    for (const LocalisedText& change : a->changes) {
        append_line(text, words.localised(change));
    }
    for (const certificate::Change& change : w.record().certificate->changes) {
        append_line(text, place_of_change(change, words) + ": " + side_of_change(change, change.before, words) + " → " +
                              side_of_change(change, change.after, words));
    }
    w.statement("amendment", text);
}

void recalibration(DccWriter& w) {
    const std::string date = date_or_nothing(w.data().recalibration_date);
    if (date.empty()) {
        return;
    }
    w.xml.open("dcc:statement", {{"refType", w.ref_types()("recalibration")}});
    w.text("dcc:declaration", w.words().filled("statement", "recalibration",
                                               {{"date", date}, {"agreement", w.data().recalibration_agreement}}));
    w.xml.element("dcc:date", date);
    w.xml.close();
}

/// Place of the calibration where it has more to say than its kind.
void place(DccWriter& w) {
    const certificate::Place& p = w.data().place;
    if (!w.record().certificate || (p.description.empty() && certificate::address_lines(p.address).empty())) {
        return;
    }
    w.xml.open("dcc:statement", {{"refType", w.ref_types()("performance_location")}});
    Text text = w.words()("place_kind", p.kind);
    append_line(text, w.words().localised(p.description));
    w.text("dcc:declaration", text);
    if (!certificate::address_lines(p.address).empty()) {
        location(w, p.address, {});
    }
    w.xml.close();
}

/// "identification, owner": of several items that do not have it in common, behind what each is called.
void statement_of_customer(DccWriter& w) {
    const CertificateData& d = w.data();
    const Wording& words = w.words();
    std::vector<const certificate::Item*> items = certificate::items_of(d);
    if (items.empty()) {
        items.push_back(&d.item);
    }
    std::vector<std::vector<std::string>> stated;
    for (const certificate::Item* one : items) {
        stated.push_back(stated_by_customer(d, *one));
    }
    const bool is_common = std::ranges::all_of(stated, [&](const auto& keys) { return keys == stated.front(); });
    if (is_common) {
        items.resize(1);
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
        const certificate::Item* one = items[i];
        Text names;
        for (const std::string& key : stated[i]) {
            names += (names.empty() ? Text() : Text(", ")) +
                     (words.has("certificate", key) ? words("certificate", key) : Text(key));
        }
        if (names.empty()) {
            continue;
        }
        if (!is_common) {
            const std::string& number = one->serial_number.empty() ? one->identification : one->serial_number;
            names = words.localised(one->description) + (number.empty() ? "" : " (" + number + ")") + ": " + names;
        }
        w.statement("stated_by_customer", words.filled("dcc", "stated_by_customer", {{"names", names}}));
    }
}

void texts_of_laboratory(DccWriter& w) {
    const CertificateData& d = w.data();
    const Wording& words = w.words();
    statement_of_customer(w);
    if (d.adjustment) {
        w.statement("adjustment", adjustment_sentence(d, *d.adjustment, words));
    }
    if (!d.sampling.empty()) {
        w.statement("sampling", words.localised(d.sampling));
    }
    if (!d.simplified_agreement.empty()) {
        w.statement("simplified", words("certificate", "simplified") + ": " + d.simplified_agreement);
    }
    for (const LocalisedText& remark : d.remarks) {
        w.statement("remark", words.localised(remark));
    }
    for (const certificate::Opinion& opinion : d.opinions) {
        Text text = words.localised(opinion.text);
        append_line(text, words("certificate", "basis") + ": " + words.localised(opinion.basis));
        append_line(text, words("certificate", "author") + ": " + opinion.author.name);
        w.statement("opinion", text);
    }
    for (const certificate::ExternalResults& external : d.external_results) {
        std::string names;
        for (const std::string& name : external.results) {
            names += (names.empty() ? "" : ", ") + name;
        }
        w.statement(
            "external_results",
            words.filled("dcc", "external", {{"provider", words.localised(external.provider)}, {"results", names}}));
    }
    for (const certificate::Omission& omission : d.omissions) {
        w.statement("omission", words.filled("certificate", "omission", {{"clause", omission.clause}}) + ": " +
                                    words.localised(omission.reason));
    }
}

void statements(DccWriter& w) {
    const Wording& words = w.words();
    w.xml.open("dcc:statements");
    status_statements(w);
    if (!w.data().standards.empty()) {
        w.xml.open("dcc:statement", {{"refType", w.ref_types()("traceability")}});
        w.xml.element("dcc:traceable", "true");
        w.xml.element("dcc:norm", "ISO/IEC 17025:2017");
        w.text("dcc:declaration", words("dcc", "traceable"));
        w.xml.close();
    }
    decision_rules(w);
    w.statement("validity", validity_sentence(w.data(), words));
    if (w.record().certificate) {
        w.statement("only_item", only_item_sentence(w.data(), words));
        if (w.record().certificate->profile.reproduction_sentence_mandatory) {
            w.statement("reproduction", words("statement", "reproduction"));
        }
        for (const LocalisedText& sentence : w.record().certificate->sentences_of_the_body()) {
            w.statement("profile_sentence", words.localised(sentence));
        }
    } else {
        w.statement("only_item", words("document", "only_items"));
    }
    place(w);
    amendment_statement(w);
    recalibration(w);
    texts_of_laboratory(w);
    w.xml.close();
}

}  // namespace

void write_administrative_data(DccWriter& w) {
    w.xml.open("dcc:administrativeData");
    w.xml.open("dcc:dccSoftware");
    software(w);
    w.xml.close();
    ref_type_definitions(w);
    core_data(w);
    items(w);
    laboratory(w);
    persons(w);
    customer(w);
    statements(w);
    w.xml.close();
}

}  // namespace gumcert::reports
