#include "reports/view/certificate_identity_sections.h"

#include "certificate/address_lines.h"
#include "certificate/point_tables.h"
#include "certificate/section_data.h"
#include "reports/point_headings.h"
#include "reports/printable_text.h"
#include "reports/printed_texts.h"
#include "reports/record/record_sections.h"
#include "reports/view/certificate_conformity_section.h"
#include "reports/view/certificate_uncertainty_section.h"
#include "reports/view/certificate_view.h"
#include "reports/view/certified_overview.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using certificate::Certificate;
using certificate::CertificateData;
using nlohmann::json;

/// The form of the documents: it changes when their layout changes in a way that an assessor would see.
constexpr const char* k_form = "gumcert-certificate-1";

json line(const Text& text, const Wording& words) {
    return {{"text", printable(text.first())}, {"also", also(text, words.languages())}};
}

constexpr const char* k_mark = " †";  // of what the customer stated

bool is_marked(const Text& text) {
    // At the end of a fact, in a line of several before a comma; else it is a dagger in a text of the laboratory.
    return text.first().ends_with(k_mark) || text.first().find(std::string(k_mark) + ",") != std::string::npos;
}

bool is_draft(const EvaluationRecord& record) {
    return record.certificate && record.certificate->blocked;
}

bool is_specimen(const EvaluationRecord& record) {
    return !record.certificate || record.certificate->data.status == "specimen";
}

/// Number of the certificate or report that supersedes it; "" where none does.
std::string superseding_number(const EvaluationRecord& record) {
    return record.certificate                               ? record.certificate->superseded_by
           : record.comparison && record.comparison->issuer ? record.comparison->issuer->superseded_by
                                                            : "";
}

bool is_superseded(const EvaluationRecord& record) {
    return !superseding_number(record).empty();
}

/// Of a position.
std::size_t number_of(const std::string& token) {
    std::size_t number = 0;
    std::from_chars(token.data(), token.data() + token.size(), number);
    return number;
}

/// Whether a part of a JSON pointer is one in a list.
bool is_position(const std::string& token) {
    return !token.empty() && token.size() < 9 && token.find_first_not_of("0123456789") == std::string::npos;
}

/// What a part of the certificate data, or something that is printed of a result, is called in the list of changes.
Text word_of_change(const std::string& name, const Wording& words) {
    if (name == "interval") {
        return words("label", "symmetric");
    }
    return words.has("change", name)        ? words("change", name)
           : words.has("certificate", name) ? words("certificate", name)
                                            : Text(name);
}

/// Lines of an address with the country, joined by commas.
std::string in_one_line(const certificate::Address& address) {
    std::string text;
    for (const std::string& part : certificate::address_lines(address)) {
        text += (text.empty() ? "" : ", ") + part;
    }
    if (!address.country.empty()) {
        text += (text.empty() ? "" : ", ") + address.country;
    }
    return text;
}

json contact_lines(const certificate::Laboratory& laboratory, const Wording& words) {
    json lines = json::array();
    if (const std::string address = in_one_line(laboratory.address); !address.empty()) {
        lines.push_back(line(address, words));
    }
    std::string contact;
    const auto add = [&](const std::string& text) { contact += text.empty() || contact.empty() ? text : " · " + text; };
    add(laboratory.telephone);
    add(laboratory.email);
    add(laboratory.web);
    if (!contact.empty()) {
        lines.push_back(line(contact, words));
    }
    return lines;
}

/// What the head says of the accreditation. The number may stand only where the symbol may: both claim the same.
json accreditation_lines(const Certificate& certificate, const Wording& words) {
    const CertificateData& data = certificate.data;
    json lines = json::array();
    if (certificate.symbol && data.accreditation) {
        lines.push_back(
            line(words("certificate", "accredited_by") + ": " + words.localised(data.accreditation->body), words));
        lines.push_back(line(words("certificate", "accreditation") + ": " + data.accreditation->number, words));
        lines.push_back(line(data.accreditation->standard, words));
    } else if (data.status == "not_accredited") {
        lines.push_back(line(words("statement", "outside_of_accreditation"), words));
    } else if (data.status == "accredited") {
        lines.push_back(line(words("statement", "no_symbol"), words));
    }
    if (!data.laboratory.code.empty()) {
        lines.push_back(line(words("certificate", "laboratory_code") + ": " + data.laboratory.code, words));
    }
    return lines;
}

/// \param name  of the file in the workspace of the PDF, without its ending
/// \return an array of none or one {data_uri, base64, file, alt}
json picture(const std::string& name, const std::string& media_type, const std::string& base64, const Text& alt) {
    if (base64.empty()) {
        return json::array();
    }
    const bool png = media_type == "image/png";
    const bool svg = media_type == "image/svg+xml";
    return json::array({{{"data_uri", "data:" +
                                          std::string(png   ? "image/png"
                                                      : svg ? "image/svg+xml"
                                                            : "image/jpeg") +
                                          ";base64," + base64},
                         {"base64", base64},
                         {"file", name + (png   ? ".png"
                                          : svg ? ".svg"
                                                : ".jpg")},
                         {"alt", printable(alt.first())}}});
}

}  // namespace

json accreditation_symbol(const Certificate& certificate, const Wording& words) {
    if (!certificate.symbol || !certificate.data.accreditation) {
        return json::array();
    }
    const certificate::Accreditation& a = *certificate.data.accreditation;
    return picture("symbol", a.symbol_media_type, a.symbol_base64, words.localised(a.body) + ", " + a.number);
}

namespace {

/// Description, manufacturer, type and numbers of an item, marked where the customer stated them.
Text item_in_one_line(const certificate::Item& item, const Wording& words) {
    Text text = item_text(item, "description", words.localised(item.description));
    for (const auto& [key, part] : {std::pair("manufacturer", &item.manufacturer),
                                    {"type", &item.type},
                                    {"serial_number", &item.serial_number},
                                    {"identification", &item.identification}}) {
        if (!part->empty()) {
            text += (text.empty() ? Text() : Text(", ")) + item_text(item, key, *part);
        }
    }
    return text;
}

void item_section(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const CertificateData& data = record.certificate->data;
    builder.section("item", words("heading", certificate::has_several_items(data) ? "items" : "item"));
    Facts rows = item_facts(words, data.item);
    if (certificate::stated_by_sections(data, record.certificate->tables).item) {
        // What is stated of all of them, then each one in a line; its other facts stand with its results.
        std::erase_if(rows, [](const auto& fact) { return fact.second.empty(); });
        for (const SectionSummary& section : record.sections) {
            for (const certificate::SectionData& own : data.sections) {
                if (own.section == section.name && own.item) {
                    rows.emplace_back(words.localised(title_of(section)), item_in_one_line(*own.item, words));
                }
            }
        }
    }
    builder.definitions(rows);
    explain_marks(builder, words, rows);
}

void customer_section(CertificateBuilder& builder, const Wording& words, const certificate::Customer& customer) {
    builder.section("customer");
    Facts rows = {{words("certificate", "customer"), words.localised(customer.name)},
                  {words("certificate", "address"), in_one_line(customer.address)}};
    std::string contact = customer.contact;
    contact += contact.empty() || customer.email.empty() ? customer.email : ", " + customer.email;
    add_fact(rows, words("certificate", "contact"), contact);
    add_fact(rows, words("certificate", "order"), customer.order);
    builder.definitions(rows);
}

Text place_text(const CertificateData& data, const Wording& words) {
    Text text = words("place_kind", data.place.kind);
    const bool is_elsewhere = !certificate::address_lines(data.place.address).empty();
    const certificate::Address& address =
        !is_elsewhere && data.place.kind == "laboratory" ? data.laboratory.address : data.place.address;
    if (!data.place.description.empty()) {
        text += ", " + words.localised(data.place.description);
    }
    const std::string where = in_one_line(address);
    return where.empty() ? text : text + ", " + where;
}

void dates_section(CertificateBuilder& builder, const Wording& words, const CertificateData& data) {
    builder.section("dates");
    Facts rows;
    add_fact(rows, words("certificate", "received"), data.dates.received);
    rows.emplace_back(words("certificate", "performed"), from_to(data.dates.performed_from, data.dates.performed_to));
    rows.emplace_back(words("certificate", "issued"), data.dates.issued);
    rows.emplace_back(words("certificate", "place"), place_text(data, words));
    builder.definitions(rows);
}

/// "pass (10 of 12 values), fail (2 of 12 values)"
Text verdict_counts(const std::vector<const certificate::Verdict*>& verdicts, const Wording& words) {
    static constexpr const char* k_order[] = {"pass", "conditional_pass", "conditional_fail", "undetermined",
                                              "fail", "not_applicable"};
    Text text;
    for (const char* name : k_order) {
        const auto count =
            std::count_if(verdicts.begin(), verdicts.end(), [&](const auto* v) { return v->verdict == name; });
        if (count == 0) {
            continue;
        }
        const Text part = verdicts.size() == 1 ? words("verdict_name", name)
                                               : words.filled("statement", "verdict_count",
                                                              {{"verdict", words("verdict_name", name)},
                                                               {"count", std::to_string(count)},
                                                               {"all", std::to_string(verdicts.size())}});
        text = text.empty() ? part : text + ", " + part;
    }
    return text;
}

/// "DR-02, simple acceptance with a condition on the uncertainty; where a condition of it is not kept DR-03, guarded …"
Text rule_with_alternative(const certificate::AgreedSpecification::Rule& rule, const Wording& words) {
    const auto named = [&](const std::string& id) { return id + ", " + words("rule_name", id); };
    return rule.alternative.empty()
               ? named(rule.id)
               : words.filled("statement", "conformity_alternative",
                              {{"rule", named(rule.id)}, {"alternative", named(rule.alternative)}});
}

/// The one certified value of the certificate with its column; nothing where there are none or several.
std::pair<const certificate::CertifiedColumn*, const certificate::CertifiedValue*> only_value(
    const Certificate& certificate) {
    std::pair<const certificate::CertifiedColumn*, const certificate::CertifiedValue*> found = {};
    for (const certificate::CertifiedTable& table : certificate.tables) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            for (const certificate::CertifiedValue& value : column.values) {
                if (found.first != nullptr) {
                    return {};
                }
                found = {&column, &value};
            }
        }
    }
    return found;
}

/// As the table of a result shows its values.
std::string form_of(const Certificate& certificate, const std::string& result) {
    for (const certificate::CertifiedTable& table : certificate.tables) {
        if (std::string form = certificate::form_of_result(table, result); !form.empty()) {
            return form;
        }
    }
    return {};
}

/// "l = 50000838 nm ± 68 nm, k = 2.16" where that is the whole of the results; else where they stand. A value with a
/// mark (outside of the accreditation, external) stands where the mark is explained.
Text results_in_one_line(const EvaluationRecord& record, const Wording& words) {
    const Certificate& certificate = *record.certificate;
    const auto only = only_value(certificate);  // Clang 14 lets no lambda below capture a structured binding
    const certificate::CertifiedColumn* column = only.first;
    const certificate::CertifiedValue* value = only.second;
    const std::string note = value == nullptr ? "" : CertifiedOverview(certificate).note(*value);
    if (column == nullptr || value->printed_value.empty() || (!note.empty() && note != k_raised_mark)) {
        return words("statement", "see_following_pages");
    }
    const auto quantity = [&](const std::string& printed) {
        return with_unit(words.number(printed), column->printed_unit);
    };
    const std::string form = form_of(certificate, column->result);
    const auto value_of = [&](const std::string& printed) {
        return with_unit(words.number(certificate::in_form(printed, form, column->unit)),
                         certificate::unit_in_form(column->printed_unit, form, column->unit));
    };
    const Coverage kind = coverage_of(*value);
    if (kind == Coverage::interval) {
        const bool has_u = !value->printed_u.empty();
        return words.filled("statement", has_u ? "result_interval_and_u" : "result_interval",
                            {{"name", column->result},
                             {"value", value_of(value->printed_value)},
                             {"u", has_u ? quantity(value->printed_u) : Text()},
                             {"low", value_of(value->printed_low)},
                             {"high", value_of(value->printed_high)},
                             {"p", stated_probability(record, {value}, words)}});
    }
    if (kind == Coverage::none || kind == Coverage::nothing) {
        return words("statement", "see_following_pages");
    }
    Text text = words.filled(
        "statement", certificate.profile.plus_minus_in_tables ? "result_with_U" : "result_and_U",
        {{"name", column->result}, {"value", value_of(value->printed_value)}, {"U", quantity(value->printed_U)}});
    if (!value->printed_k.empty()) {
        text += words("document", "separator") + words.fill("k_one", {{"k", words.number(value->printed_k)}});
    }
    if (value->raised) {
        text += " " + words("statement", "raised_mark");
    }
    return text;
}

/// The values that a line of the first page is about; the first ones of many.
Text summarised_names(const std::vector<Text>& names, const Wording& words) {
    constexpr std::size_t k_most = 12;
    constexpr std::size_t k_shown_of_more = 6;
    if (names.size() <= k_most) {
        return enumerated(names, words);
    }
    return words.fill("and_more", {{"names", enumerated({names.begin(), names.begin() + k_shown_of_more}, words)},
                                   {"count", std::to_string(names.size() - k_shown_of_more)}});
}

Text superseded_mark(const EvaluationRecord& record, const Wording& words) {
    return words.filled("document", "superseded", {{"number", superseding_number(record)}});
}

/// Values that one specification decides before, or after, an adjustment.
struct DecidedValues {
    std::vector<const certificate::Verdict*> verdicts;
    std::set<const certificate::CertifiedValue*> values;
};

/// By the stage of their columns in the order "", as found, as left.
std::map<std::size_t, DecidedValues> decided_by_stage(const Certificate& certificate,
                                                      const certificate::AgreedSpecification& s) {
    std::map<std::size_t, DecidedValues> all;
    for (const certificate::CertifiedTable& table : certificate.tables) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            std::size_t stage = 0;
            for (const certificate::ShownColumn& shown :
                 table.layout ? table.layout->shown : std::vector<certificate::ShownColumn>()) {
                if (shown.show == "value" && shown.of == column.result && !shown.stage.empty()) {
                    stage = shown.stage == certificate::k_quantity_stages.front() ? 1 : 2;
                }
            }
            for (const certificate::CertifiedValue& value : column.values) {
                if (value.verdict && value.verdict->specification == s.id) {
                    all[stage].verdicts.push_back(&*value.verdict);
                    all[stage].values.insert(&value);
                }
            }
        }
    }
    return all;
}

/// One line a specification; where results before and after an adjustment are decided, one for each: that an item failed
/// before says nothing of how it leaves the laboratory.
void summarise_verdicts(Facts& rows, const certificate::AgreedSpecification& s, const Wording& words,
                        const Certificate& certificate) {
    const std::map<std::size_t, DecidedValues> by_stage = decided_by_stage(certificate, s);
    for (const auto& [stage, decided] : by_stage) {
        const std::set<const certificate::CertifiedValue*>& values = decided.values;
        const auto is_decided = [&values](const certificate::CertifiedValue& v) { return values.contains(&v); };
        Text names = summarised_names(names_of_values(certificate, is_decided, words), words);
        if (by_stage.size() > 1 && stage > 0) {
            names = words("point_table", std::string(certificate::k_quantity_stages.at(stage - 1))) +
                    words("document", "separator") + names;
        }
        rows.emplace_back(words("certificate", "conformity"),
                          words.filled("statement", "conformity_summary",
                                       {{"specification", document_of(s)},
                                        {"results", names},
                                        {"verdicts", verdict_counts(decided.verdicts, words)},
                                        {"rule", rule_with_alternative(s.rule, words)}}));
    }
}

void summary_section(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const Certificate& certificate = *record.certificate;
    builder.section("summary");
    Facts rows = {{words("certificate", "results"), results_in_one_line(record, words)}};
    if (certificate.data.specifications.empty()) {
        rows.emplace_back(words("certificate", "conformity"), words("statement", "no_conformity"));
    }
    for (const certificate::AgreedSpecification& s : certificate.data.specifications) {
        summarise_verdicts(rows, s, words, certificate);
    }
    const std::vector<Text> without = names_of_values(certificate, is_without_verdict, words);
    if (!certificate.data.specifications.empty() && !without.empty()) {
        rows.emplace_back(
            words("certificate", "conformity"),
            words.filled("statement", "conformity_without", {{"results", summarised_names(without, words)}}));
    }
    if (const auto& amendment = certificate.data.amendment) {
        rows.emplace_back(words("heading", "amendment"), amendment_sentence(*amendment, words));
    }
    builder.definitions(rows);
}

void authorisation_section(CertificateBuilder& builder, const Wording& words, const CertificateData& data) {
    builder.section("authorisation");
    Facts rows;
    const certificate::Person nobody;
    const certificate::Person& person = data.persons.authorised_by ? *data.persons.authorised_by : nobody;
    rows.emplace_back(words("certificate", "authorised_by"), person.name);
    rows.emplace_back(words("certificate", "function"), words.localised(person.function));
    rows.emplace_back(words("certificate", "authorised"), data.dates.authorised);
    builder.definitions(rows);
    builder.paragraph(words("statement", "signature"));
}

json foot(const Certificate& certificate, const Wording& words) {
    json lines = json::array({line(only_item_sentence(certificate.data, words), words)});
    if (certificate.profile.reproduction_sentence_mandatory) {
        lines.push_back(line(words("statement", "reproduction"), words));
    }
    for (const certificate::LocalisedText& sentence : certificate.sentences_of_the_body()) {
        lines.push_back(line(words.localised(sentence), words));
    }
    return lines;
}

}  // namespace

std::string document_status(const EvaluationRecord& record) {
    return is_draft(record)        ? "draft"
           : is_specimen(record)   ? "specimen"
           : is_superseded(record) ? "superseded"
                                   : "issued";
}

Text document_type(const EvaluationRecord& record, const Wording& words) {
    const auto& amendment = record.certificate->data.amendment;
    return amendment ? words.filled("document", amendment->kind == "replaced" ? "type_replaced" : "type_amended",
                                    {{"number", amendment->number}})
                     : words("document", "type");
}

nlohmann::json issued_status(const Wording& words, const EvaluationRecord& record) {
    if (document_status(record) != "issued") {
        return json::array();
    }
    const std::string& date = record.certificate->data.dates.issued;
    const Text text = date.empty() ? words("certificate_status", "issued")
                                   : words.filled("certificate_status", "issued_on", {{"date", date}});
    return json::array({{{"text", printable(text.first())}}});
}

namespace {

/// With what a point is called by in the words of the language: "E [1 kV, 0.50 V]".
Text place_of_result(const std::string& where, const Wording& words) {
    const std::size_t point = where.ends_with(']') ? where.rfind(" [") : std::string::npos;
    if (point == std::string::npos) {
        return where;
    }
    const std::string name = where.substr(point + 2, where.size() - point - 3);
    return where.substr(0, point + 2) + point_in_words(name, words) + "]";
}

}  // namespace

Text place_of_change(const certificate::Change& change, const Wording& words) {
    if (change.where.empty()) {
        return word_of_change(change.kind, words);
    }
    if (!change.where.starts_with('/')) {
        const bool is_place = change.kind == "value" || change.kind == "cell" || change.kind == "words";
        const Text place = place_of_result(change.where, words);
        return is_place ? place : place + ": " + word_of_change(change.kind, words);
    }
    Text text;
    std::string rest = change.where;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('/', 1), rest.size());
        const std::string token = rest.substr(1, end - 1);
        rest = rest.substr(end);
        if (is_position(token)) {
            text = text + " " + Text(std::to_string(number_of(token) + 1));
            continue;
        }
        const std::string heading = token == "standards"        ? "traceability"
                                    : token == "method"         ? "method_used"
                                    : token == "specifications" ? "conformity"
                                                                : token;
        const Text word = text.empty() && words.has("heading", heading) && heading != "adjustment"
                              ? words("heading", heading)
                              : word_of_change(token, words);
        text = text.empty() ? word : text + ": " + word;
    }
    return text;
}

Text side_of_change(const certificate::Change& change, const std::string& side, const Wording& words) {
    const std::string& kind = change.kind;
    if (kind == "verdict" && words.has("verdict_name", side)) {
        return words("verdict_name", side);
    }
    if (kind == "flag" || kind == "raised" || kind == "external") {
        return side == "true"    ? words("change_value", "yes")
               : side == "false" ? words("change_value", "no")
                                 : Text(side);
    }
    if (kind == "role" || kind == "stage") {
        return word_of_column(side, words);
    }
    if (kind == "code" || kind == "coverage") {
        const std::string word = kind == "coverage" && side == "none" ? "no_coverage" : side;
        return words.has("change_value", word) ? words("change_value", word) : Text(side);
    }
    if (kind == "note") {
        return words.sentence(side);
    }
    static constexpr std::array<std::string_view, 8> k_words{"text",  "words",   "heading",       "title",
                                                             "group", "columns", "specification", "rule"};
    const bool is_text = kind == "scope_entry" || std::find(k_words.begin(), k_words.end(), kind) != k_words.end();
    return is_text ? Text(side) : words.number(side);
}

Facts item_facts(const Wording& words, const certificate::Item& item) {
    Facts rows;
    const auto row = [&](const char* key, const Text& value, bool always) {
        if (always || !value.empty()) {
            rows.emplace_back(words("certificate", key), item_text(item, key, value));
        }
    };
    row("description", words.localised(item.description), true);
    row("manufacturer", item.manufacturer, true);
    row("type", item.type, true);
    row("serial_number", item.serial_number, item.identification.empty());
    row("identification", item.identification, false);
    row("condition", words.localised(item.condition), true);
    row("owner", item.owner, false);
    return rows;
}

void explain_marks(CertificateBuilder& builder, const Wording& words, const Facts& facts) {
    if (std::any_of(facts.begin(), facts.end(), [](const auto& fact) { return is_marked(fact.second); })) {
        builder.paragraph(words("statement", "stated_by_customer"));
    }
}

Text items_in_one_line(const CertificateData& data, const Wording& words) {
    Text text;
    for (const certificate::Item* item : certificate::items_of(data)) {
        certificate::Item unmarked = *item;
        unmarked.stated_by_customer.clear();
        text += (text.empty() ? Text() : Text("; ")) + item_in_one_line(unmarked, words);
    }
    return text;
}

Text only_item_sentence(const CertificateData& data, const Wording& words) {
    return words("statement", certificate::has_several_items(data) ? "only_items" : "only_item");
}

Text adjustment_sentence(const CertificateData& data, const certificate::Adjustment& adjustment, const Wording& words) {
    const bool several = certificate::has_several_items(data);
    return adjustment.adjusted ? words.filled("statement", several ? "adjusted_items" : "adjusted",
                                              {{"as_found", words.localised(adjustment.as_found)}})
                               : words("statement", several ? "not_adjusted_items" : "not_adjusted");
}

Text validity_sentence(const CertificateData& data, const Wording& words) {
    return words("sentence", certificate::has_several_items(data) ? "validity_items" : "validity");
}

Text item_text(const certificate::Item& item, const std::string& key, const Text& text) {
    const auto& marked = item.stated_by_customer;
    const bool by_customer = std::find(marked.begin(), marked.end(), key) != marked.end();
    return by_customer && !text.empty() ? text + k_mark : text;
}

std::string from_to(const std::string& from, const std::string& to) {
    return from.empty() || to.empty() || from == to ? (from.empty() ? to : from) : from + " – " + to;
}

Text amendment_sentence(const certificate::Amendment& amendment, const Wording& words) {
    return words.filled("statement", amendment.kind == "replaced" ? "replaced" : "amended",
                        {{"number", amendment.number}});
}

nlohmann::json identity_page(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const Certificate& certificate = *record.certificate;
    const CertificateData& data = certificate.data;
    item_section(builder, words, record);
    customer_section(builder, words, data.customer);
    dates_section(builder, words, data);
    summary_section(builder, words, record);
    authorisation_section(builder, words, data);
    const Text name = words.localised(data.laboratory.name);
    const Text number = words("certificate", "number");
    return {{"laboratory", printable(name.first())},
            {"laboratory_also", also(name, words.languages())},
            {"address", contact_lines(data.laboratory, words)},
            {"accreditation", accreditation_lines(certificate, words)},
            {"symbol", accreditation_symbol(certificate, words)},
            {"logo", picture("laboratory-logo", data.laboratory.logo_media_type, data.laboratory.logo_base64,
                             words.filled("certificate", "logo", {{"laboratory", name.first()}}))},
            {"number_label", number.first()},
            {"number_label_also", also(number, words.languages())},
            {"number", printable(data.number)},
            {"sections", builder.take()},
            {"foot", foot(certificate, words)}};
}

nlohmann::json document_marks(const Wording& words, const EvaluationRecord& record, std::string_view report) {
    json marks = json::array();
    const auto mark = [&](const Text& text, const Text& reason) {
        marks.push_back({{"text", printable(text.first())},
                         {"also", also(text, words.languages())},
                         {"reason", reason.first()},
                         {"reason_also", also(reason, words.languages())}});
    };
    if (is_draft(record)) {
        mark(words("document", "draft"), words("document", "draft_reason"));
    }
    if (report.empty() && is_specimen(record)) {
        mark(words("document", "mark"), words("document", record.certificate ? "specimen_reason" : "mark_reason"));
    }
    if (is_superseded(record)) {
        mark(superseded_mark(record, words), words("document", std::string(report) + "superseded_reason"));
    }
    return marks;
}

std::string superseded_in_head(const Wording& words, const EvaluationRecord& record) {
    return is_superseded(record) ? " · " + printable(superseded_mark(record, words).first()) : "";
}

nlohmann::json running_texts(const Wording& words, const EvaluationRecord& record) {
    const std::string title = shortened(printable(words.localised(title_of(record)).first()), 80);
    if (!record.certificate) {
        return {{"header_left", title}, {"header_right", words("document", "mark").first()}, {"footer_left", title}};
    }
    const CertificateData& data = record.certificate->data;
    // Not shortened: the number makes the page a part of this certificate.
    std::string head = printable(words
                                     .filled("certificate", "certificate_of_head",
                                             {{"type", words("document", "type")}, {"number", data.number}})
                                     .first());
    if (is_draft(record)) {
        head += " · " + words("document", "draft").first();
    }
    if (is_specimen(record)) {
        head += " · " + words("document", "mark").first();
    }
    head += superseded_in_head(words, record);
    return {{"header_left", shortened(printable(words.localised(data.laboratory.name).first()), 80)},
            {"header_right", head},
            {"footer_left", std::string(k_form) + " · " + record.software.name + " " + record.software.version}};
}

}  // namespace gumcert::reports
