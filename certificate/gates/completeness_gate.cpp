#include <algorithm>
#include <string>

#include "certificate/address_lines.h"
#include "certificate/dates.h"
#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"
#include "certificate/section_data.h"
#include "certificate/stated_text.h"
#include "certificate/text_words.h"
#include "text/visible_text.h"

namespace gumcert::certificate {

// In the order of ISO/IEC 17025:2017, 7.8.2.1; the letter of a finding is the item there. FindingList::item() knows
// which items may be left out for a reason; what is no such item is critical or major in its own right.
// A field counts as filled in only where its text says something: "n/a", a dash or "SN-tbd" are not empty, and tell a
// reader nothing.
// Dates and persons are checked against each other where both are there. What must not be missing has a finding of its
// own, and one gap should not be told twice.

namespace {

constexpr FindingSeverity k_critical = FindingSeverity::critical;
constexpr FindingSeverity k_major = FindingSeverity::major;

void laboratory_and_customer(FindingList& found, const CertificateData& data) {
    if (!is_name(data.laboratory.name)) {
        const std::string given = data.laboratory.name.in("en");
        found.item(k_critical, 'b', "/laboratory/name", what_of_name(given, "the name of the laboratory is missing"),
                   action_of_name(given, "State it as the accreditation does."));
    }
    if (!is_postal_address(address_lines(data.laboratory.address))) {
        found.item(k_critical, 'b', "/laboratory/address", "the address of the laboratory is missing", "State it.");
    }
    // Work in the laboratory has its address for the place; only elsewhere it says something of its own.
    if (data.place.kind != "laboratory" && !is_postal_address(address_lines(data.place.address))) {
        found.item(k_critical, 'c', "/place/address", "the place where the work was done is missing",
                   "State its address: the work was not done in the laboratory.");
    }
    if (!is_document_number(data.number)) {
        found.item(k_critical, 'd', "/number",
                   data.number.empty()
                       ? "the number of the certificate is missing"
                       : text::in_quotes(data.number) + " does not count as the number of a certificate",
                   "Give it a number that no other certificate has.");
    }
    if (!is_name(data.customer.name)) {
        found.item(k_critical, 'e', "/customer/name",
                   what_of_name(data.customer.name.in("en"), "the name of the customer is missing"),
                   action_of_name(data.customer.name.in("en"), "State it."));
    }
    // ISO/IEC 17025:2017, 7.8.2.1 e asks for contact information, not for a postal address.
    const bool reachable = is_postal_address(address_lines(data.customer.address)) || is_name(data.customer.contact) ||
                           is_email(data.customer.email) || is_email(data.customer.contact);
    if (!reachable) {
        found.item(k_critical, 'e', "/customer/address", "the contact information of the customer is missing",
                   "State an address, a contact or an e-mail address.");
    }
}

/// \param by_sections  a method that each section states passes this gate as that of the section
void method(FindingList& found, const CertificateData& data, bool by_sections) {
    const Method& m = data.method;
    if (by_sections) {
        return;
    }
    if (!is_method_identification(m.identification)) {
        found.item(k_critical, 'f', "/method/identification", "the method is not identified",
                   "State the identification of the procedure.");
    }
    if (!is_stated(m.version)) {
        found.item(k_major, 'f', "/method/version", "the version of the method is missing", "State it.");
    }
    if (!any_stated(m.deviations) && !m.no_deviations) {
        found.item(k_major, 'n', "/method/deviations",
                   "nothing is said of additions to, deviations or exclusions from the method",
                   "List them, or state \"no_deviations\": true.");
    }
    // First and last day: a version that ended in between was not the method of the whole work.
    const std::string& last = last_day(data.dates);
    if (!last.empty() && (!is_within(data.dates.performed_from, m.valid_from, m.valid_to) ||
                          !is_within(last, m.valid_from, m.valid_to))) {
        found.critical("P08", iso_17025("7.2.1"), "/method/valid_from",
                       "version " + m.version + " of the method is not valid on the dates of performance (valid " +
                           (m.valid_from.empty() ? "" : "from " + m.valid_from) +
                           (m.valid_from.empty() || m.valid_to.empty() ? "" : " ") +
                           (m.valid_to.empty() ? "" : "to " + m.valid_to) + ")",
                       "State the version that was used, or correct the dates.");
    }
}

/// \param by_sections  an item that each section states passes this gate as that of the section
void item(FindingList& found, const CertificateData& data, bool by_sections) {
    if (by_sections) {
        return;
    }
    if (!is_name(data.item.description)) {
        found.item(k_critical, 'g', "/item/description", "the description of the item is missing", "State it.");
    }
    if (!is_identification(data.item.serial_number) && !is_identification(data.item.identification)) {
        found.item(k_critical, 'g', "/item/serial_number", "the item is not identified",
                   "State a serial number, or an identification that customer or laboratory assigned.");
    }
    if (!is_name(data.item.condition)) {
        found.item(k_critical, 'g', "/item/condition", "the condition of the item on receipt is missing",
                   "State it; \"no damage seen\" is a condition.");
    }
}

void receipt(FindingList& found, const CertificateData& data, const Profile& profile) {
    if (data.dates.received.empty() && profile.receipt_date_mandatory) {
        found.item(k_major, 'h', "/dates/received",
                   "the date of receipt is missing, which the profile " + profile.id + " demands", "State it.");
    }
}

/// Two days of a certificate that cannot stand in this order.
void order(FindingList& found, const std::string& earlier, const std::string& later, const std::string& where,
           const std::string& what) {
    if (is_after(earlier, later)) {
        found.critical("P05", iso_17025("7.5.1"), where, what + " (" + earlier + ", " + later + ")",
                       "Correct the dates.");
    }
}

void dates(FindingList& found, const CertificateData& data) {
    const Dates& d = data.dates;
    if (d.performed_from.empty()) {
        found.item(k_critical, 'i', "/dates/performed_from", "the date of performance is missing", "State it.");
    }
    if (d.issued.empty()) {
        found.item(k_critical, 'j', "/dates/issued", "the date of issue is missing", "State it.");
    }
    order(found, d.received, d.performed_from, "/dates/received", "the item was received after the work began");
    order(found, d.performed_from, d.performed_to, "/dates/performed_to", "the work ended before it began");
    order(found, last_day(d), d.authorised, "/dates/authorised", "the results were authorised before the work ended");
    order(found, d.authorised, d.issued, "/dates/issued", "the certificate was issued before it was authorised");
    order(found, last_day(d), d.issued, "/dates/issued", "the certificate was issued before the work ended");
}

void persons(FindingList& found, const CertificateData& data, const Profile& profile) {
    const auto& [performed_by, reviewed_by, authorised_by] = data.persons;
    if (!authorised_by || !is_name(authorised_by->name)) {
        const std::string given = authorised_by ? authorised_by->name : "";
        found.item(k_critical, 'o', "/persons/authorised_by",
                   what_of_name(given, "nobody is named who authorises the certificate"),
                   action_of_name(given, "State name and function."));
    } else if (!is_stated(authorised_by->function)) {
        found.item(FindingSeverity::minor, 'o', "/persons/authorised_by/function",
                   "the function of the person who authorises the certificate is missing", "State it.");
    }
    const auto check = [&](const std::optional<Person>& person, const std::string& key, const std::string& day) {
        if (person && !day.empty() && !is_within(day, person->authorised_from, person->authorised_to)) {
            found.critical("P03", iso_17025("6.2.6"), "/persons/" + key,
                           person->name + " was not authorised for this work on " + day,
                           "Let an authorised person do it, or correct the dates of the authorisation.");
        }
    };
    // Who reviews and authorises acts on the day of the authorisation, who performs on those of the work.
    const std::string& authorised = data.dates.authorised.empty() ? data.dates.issued : data.dates.authorised;
    // A person who was authorised for a part of the work only: the day that is not covered is the one that is named.
    const bool first_day =
        !performed_by || data.dates.performed_from.empty() ||
        is_within(data.dates.performed_from, performed_by->authorised_from, performed_by->authorised_to);
    check(performed_by, "performed_by", first_day ? last_day(data.dates) : data.dates.performed_from);
    check(reviewed_by, "reviewed_by", authorised);
    check(authorised_by, "authorised_by", authorised);
    if (profile.reviewer_may_be_performer) {
        return;
    }
    if (!reviewed_by || !performed_by) {
        found.major("P04", iso_17025("7.8.1.1"), reviewed_by ? "/persons/performed_by" : "/persons/reviewed_by",
                    "the profile " + profile.id +
                        " demands a reviewer who did not do the work, and it is not stated who did which",
                    "State who performed and who reviewed.");
    } else if (is_same_name(reviewed_by->name, performed_by->name)) {
        found.major(
            "P04", iso_17025("7.8.1.1"), "/persons/reviewed_by",
            reviewed_by->name + " reviewed work of his or her own, which the profile " + profile.id + " forbids",
            "Let another person review.");
    }
}

/// U = 0 says that nothing was evaluated; a capability in its place would only hide that.
void no_uncertainty(FindingList& found, const CertifiedColumn& column) {
    const auto zero = [](const CertifiedValue& v) {
        // Contributions that cancel leave u = 0 and no k, hence no U that could be compared with 0.
        const bool cancelled = !v.U && v.u == 0.0 && !v.interval && v.coverage == "none";
        return (v.U == 0.0 || cancelled) && !v.external;
    };
    const auto accredited = [&](const CertifiedValue& v) { return zero(v) && !v.scope_entry.empty(); };
    if (std::any_of(column.values.begin(), column.values.end(), zero)) {
        const bool any = std::any_of(column.values.begin(), column.values.end(), accredited);
        // Within the scope of an accreditation a U of 0 is below any capability: it blocks the issue.
        found.add(any ? k_critical : k_major, "R07-4a", iso_17025("7.8.4.1 a"), column.result,
                  "the evaluated expanded uncertainty is 0", "State the uncertainties of the inputs.");
    }
}

void results(FindingList& found, const Certificate& certificate) {
    bool any = false;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            any = any || !column.values.empty();
            if (column.unit.empty()) {
                found.item(k_critical, 'm', column.result, "the result has no unit", "State its unit.");
            }
            const bool without = std::any_of(column.values.begin(), column.values.end(), [](const CertifiedValue& v) {
                // A result of another laboratory has what that one stated.
                return v.u > 0.0 && v.printed_U.empty() && !v.interval && !v.external;
            });
            if (without) {
                found.critical("R07-4a", iso_17025("7.8.4.1 a"), column.result,
                               "no expanded uncertainty and no coverage interval is stated",
                               "See why in the remarks of the result; Monte Carlo in the job gives an interval.");
            }
            no_uncertainty(found, column);
        }
    }
    if (!any) {
        found.item(k_critical, 'm', "results", "there are no results", "Evaluate a job that has some.");
    }
    const CertificateData& data = certificate.data;
    for (std::size_t i = 0; i < data.external_results.size(); ++i) {
        const ExternalResults& external = data.external_results[i];
        if (!is_name(external.provider)) {
            found.item(k_critical, 'p', place_in("/external_results", i, "provider"),
                       "the laboratory that provided results is not named", "Name it.");
        }
        if (!names_a_result(certificate, external.results)) {
            found.major("R09", iso_17025("7.8.2.1 p"), place_in("/external_results", i, "results"),
                        "no result of the certificate has one of these names, so that nothing is marked",
                        "Correct the names.");
        }
    }
}

void conditions(FindingList& found, const CertificateData& data, bool by_sections) {
    if (data.conditions.empty() && !by_sections) {
        found.critical("R07-4b", iso_17025("7.8.4.1 b"), "/conditions",
                       "the conditions that influence the results are missing", "State them as observed.");
    }
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        const Condition& c = data.conditions[i];
        const bool outside =
            (c.lower_limit && c.minimum < *c.lower_limit) || (c.upper_limit && c.maximum > *c.upper_limit);
        // What was measured outside of the limits of the method is a deviation from it (7.8.2.1 n), and the reader must
        // learn so.
        if (outside && !any_statement(data.method.deviations)) {
            found.critical("E01", iso_17025("7.8.2.1 n"), place_in("/conditions", i),
                           "\"" + c.quantity.in("en") + "\" left the limits of the method, and no deviation is stated",
                           "State the deviation from the method and what it does to the results, or repeat the work.");
        }
    }
}

/// A reference with a number ("Table 2"), or a sentence.
bool says_where(const LocalisedText& text) {
    // "Table 2" is no sentence, and says where all the same.
    const bool numbered = text.in("en").find_first_of("0123456789") != std::string::npos;
    return is_stated(text) && (numbered || is_statement(text));
}

/// Whether results stand under the heading "As found" or "As left", which says that there was an adjustment between.
bool shows_stage(const Certificate& certificate, std::string_view stage) {
    return std::any_of(certificate.tables.begin(), certificate.tables.end(), [&](const CertifiedTable& table) {
        return table.layout && std::any_of(table.layout->shown.begin(), table.layout->shown.end(),
                                           [&](const ShownColumn& c) { return c.stage == stage; });
    });
}

void adjustment(FindingList& found, const Certificate& certificate) {
    const CertificateData& data = certificate.data;
    if (data.adjustment && !data.adjustment->adjusted) {
        const bool after = shows_stage(certificate, "as_left");
        if (after || shows_stage(certificate, "as_found")) {
            // "As found" alone is what some laboratories print of every item; after an adjustment is plainly wrong.
            found.add(after ? k_critical : k_major, "R07-4d", iso_17025("7.8.4.1 d"), "/adjustment/adjusted",
                      after ? "the item was not adjusted, and results stand under \"as left\""
                            : "the item was not adjusted, and results stand under \"as found\"",
                      "State \"adjusted\": true, or leave \"stage\" of the results out.");
        }
    }
    if (!data.adjustment) {
        found.critical("R07-4d", iso_17025("7.8.4.1 d"), "/adjustment", "it is not said whether the item was adjusted",
                       "State \"adjusted\": true or false.");
    } else if (data.adjustment->adjusted && !says_where(data.adjustment->as_found)) {
        found.critical("R07-4d", iso_17025("7.8.4.1 d"), "/adjustment/as_found",
                       "the item was adjusted, and it is not said where the results before the adjustment are",
                       "Name the table or the certificate with its number, as in \"Table 2\", or say in a sentence "
                       "why there are none.");
    }
}

void opinions(FindingList& found, const CertificateData& data) {
    for (std::size_t i = 0; i < data.opinions.size(); ++i) {
        const Opinion& o = data.opinions[i];
        if (!is_name(o.author.name)) {
            found.critical("R14", iso_17025("7.8.7.1"), place_in("/opinions", i, "author"), "the opinion has no author",
                           "Name the authorised person who gives it.");
        } else if (!data.dates.issued.empty() &&
                   !is_within(data.dates.issued, o.author.authorised_from, o.author.authorised_to)) {
            found.critical("R14", iso_17025("7.8.7.1"), place_in("/opinions", i, "author"),
                           o.author.name + " was not authorised to give opinions on " + data.dates.issued,
                           "Let an authorised person give it.");
        }
        if (!is_stated(o.text) || !is_stated(o.basis)) {
            found.major("R14", iso_17025("7.8.7.1"), place_in("/opinions", i, is_stated(o.text) ? "basis" : "text"),
                        "the opinion has no text, or the basis on which it was made is not documented", "State both.");
        }
    }
}

void amendment(FindingList& found, const CertificateData& data) {
    if (!data.amendment) {
        return;
    }
    const Amendment& a = *data.amendment;
    const bool replaced = a.kind == "replaced";
    // A new certificate takes a number of its own, and says which one it replaces; compared by letters and digits, so
    // that a space more does not make another number.
    if (!is_identification(a.number)) {
        found.critical("R12", iso_17025(replaced ? "7.8.8.3" : "7.8.8.2"), "/amendment/number",
                       "the certificate that this one amends or replaces is not named", "State its number.");
    } else if (letters_of(a.number) == letters_of(data.number)) {
        found.critical("R12", iso_17025(replaced ? "7.8.8.3" : "7.8.8.2"), "/amendment/number",
                       "the certificate has the number of the one that it amends or replaces",
                       "Give it a number of its own.");
    }
    if (!any_stated(a.changes) && a.record.empty()) {
        found.critical("R12", iso_17025("7.8.8.1"), "/amendment/changes", "the changed information is not identified",
                       "List the changes, or name the record of the earlier certificate.");
    }
    if (!states_a_reason(a.reason)) {
        found.major("R12", iso_17025("7.8.8.1"), "/amendment/reason", "the reason of the change is missing",
                    "State it.");
    }
}

void languages(FindingList& found, const CertificateData& data, const Profile& profile) {
    for (const std::string& language : profile.required_languages) {
        if (std::find(data.languages.begin(), data.languages.end(), language) == data.languages.end()) {
            found.major("R13", "profile " + profile.id, "/languages",
                        "the certificate is not given in \"" + language + "\", which the profile demands", "Add it.");
        }
    }
}

void omissions(FindingList& found, const CertificateData& data) {
    for (std::size_t i = 0; i < data.omissions.size(); ++i) {
        const Omission& o = data.omissions[i];
        if (!may_be_left_out(o.clause)) {
            found.major("R16", iso_17025(o.clause), place_in("/omissions", i),
                        "the item of " + o.clause +
                            " cannot be left out for a reason: only those of 7.8.2.1 c, e, h, k, n and p can",
                        "Give the item; the omission has no effect.");
        } else if (!is_statement(o.reason)) {
            found.major("R16", iso_17025(o.clause), place_in("/omissions", i, "reason"),
                        "the reason why the item is left out is missing, or says nothing",
                        "State it in a sentence; the omission has no effect.");
        }
    }
}

void waivers(FindingList& found, const CertificateData& data) {
    for (std::size_t i = 0; i < data.waivers.size(); ++i) {
        const Waiver& waiver = data.waivers[i];
        const std::string of_finding = "the waiver of " + waiver.finding;
        if (!is_name(waiver.by)) {
            found.major("R18", iso_17025("7.8.2.1 n"), place_in("/waivers", i, "by"),
                        of_finding + " names nobody who accepts the finding",
                        "Name the person; the waiver has no effect.");
        }
        if (!is_statement(waiver.reason)) {
            found.major("R18", iso_17025("7.8.2.1 n"), place_in("/waivers", i, "reason"),
                        of_finding + " has no reason, or one that says nothing",
                        "State it in a sentence; the waiver has no effect.");
        }
        if (!data.dates.issued.empty() && waiver.date > data.dates.issued) {
            found.major("R18", iso_17025("7.8.2.1 n"), place_in("/waivers", i, "date"),
                        of_finding + " is dated later than the certificate",
                        "Correct the date; the waiver has no effect.");
        }
    }
}

}  // namespace

std::vector<Finding> completeness_findings(const Certificate& certificate) {
    const CertificateData& data = certificate.data;
    const StatedBySections by_sections = stated_by_sections(data, certificate.tables);
    FindingList found(data);
    laboratory_and_customer(found, data);
    method(found, data, by_sections.method);
    item(found, data, by_sections.item);
    receipt(found, data, certificate.profile);
    dates(found, data);
    persons(found, data, certificate.profile);
    results(found, certificate);
    conditions(found, data, by_sections.conditions);
    adjustment(found, certificate);
    for (const auto& gate : {standard_findings, specification_findings}) {
        found.append(gate(certificate));
    }
    opinions(found, data);
    amendment(found, data);
    languages(found, data, certificate.profile);
    omissions(found, data);
    waivers(found, data);
    if (!data.recalibration_date.empty() && !is_identification(data.recalibration_agreement)) {
        found.critical("R08", iso_17025("7.8.4.3"), "/recalibration_date",
                       "a date of recalibration is stated without an agreement with the customer",
                       "State the agreement (\"recalibration_agreement\"), or leave the date out.");
    }
    return found.take();
}

}  // namespace gumcert::certificate
