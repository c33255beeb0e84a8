#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "certificate/dates.h"
#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"
#include "certificate/placeholder_text.h"
#include "certificate/stated_text.h"
#include "certificate/text_words.h"
#include "gum/argument_check.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::certificate {

namespace {

/// A name, or the customer as a whole.
bool is_partner(const std::string& text) {
    constexpr std::array<std::u32string_view, 7> k_customer = {U"customer",     U"thecustomer", U"client", U"kunde",
                                                               U"auftraggeber", U"cliente",     U"客戶"};
    return is_name(text) || std::find(k_customer.begin(), k_customer.end(), letters_of(text)) != k_customer.end();
}

/// A standard, a regulation or somebody else than the laboratory, of three letters or one ideograph at least.
bool is_prescriber(const CertificateData& data, const std::string& text) {
    constexpr std::size_t k_least = 3;
    const std::u32string letters = letters_of(text);
    const bool long_enough = letters.size() >= k_least || (!letters.empty() && is_ideograph(letters.front()));
    return is_name(text) && long_enough && telling_words(text) > 0 &&
           !is_same_name(text, data.laboratory.name.in("en"));
}

/// The laboratory, or somebody who acts for it.
bool is_of_the_laboratory(const CertificateData& data, const std::string& text) {
    const auto person = [&](const std::optional<Person>& p) {
        return p && (is_same_name(text, p->name) || is_same_name(text, p->function.in("en")));
    };
    return is_same_name(text, data.laboratory.name.in("en")) || person(data.persons.performed_by) ||
           person(data.persons.reviewed_by) || person(data.persons.authorised_by);
}

/// A parameter that leaves next to nothing of what the rule is named for.
void empty_parameter(FindingList& found, const AgreedSpecification& s, std::size_t i) {
    // The name of a rule tells the reader how well he is protected. With such a parameter it is simple acceptance under
    // the name of a stricter rule.
    constexpr double k_least_factor = 0.1;       // of U, as a guard band
    constexpr double k_least_ratio = 1.0;        // U as large as half of the tolerance
    constexpr double k_least_probability = 0.8;  // to prove
    constexpr double k_largest_risk = 0.3;
    const AgreedSpecification::Rule& r = s.rule;
    const auto tell = [&](FindingSeverity severity, const char* key, double value) {
        found.add(severity, "D11", iso_17025("7.8.6.1"), place_in("/specifications", i, "rule/" + std::string(key)),
                  "the rule " + r.id + " of the specification \"" + s.id + "\" is stated with " + key + " = " +
                      text::shortest(value) + ", which demands next to nothing",
                  "State what was agreed, or the rule that this is: DR-01 is simple acceptance, DR-11 relaxed "
                  "acceptance.");
    };
    const bool guarded = r.id == "DR-04" || r.id == "DR-05" || r.id == "DR-08" || r.id == "DR-13";
    const FindingSeverity severity = r.id == "DR-13" ? FindingSeverity::minor : FindingSeverity::major;
    if (guarded && r.guard_factor && *r.guard_factor < k_least_factor) {
        tell(*r.guard_factor < 0.0 ? FindingSeverity::major : severity, "guard_factor", *r.guard_factor);
    }
    if (guarded && r.guard_band && *r.guard_band <= 0.0) {
        tell(*r.guard_band < 0.0 ? FindingSeverity::major : severity, "guard_band", *r.guard_band);
    }
    if (r.test_uncertainty_ratio && *r.test_uncertainty_ratio < k_least_ratio) {
        tell(FindingSeverity::major, "test_uncertainty_ratio", *r.test_uncertainty_ratio);
    }
    const bool proves = r.id == "DR-08" && r.probability && *r.probability < k_least_probability;
    const bool risks = (r.id == "DR-07" || r.id == "DR-09") && r.probability && *r.probability > k_largest_risk;
    if (proves || risks) {
        tell(FindingSeverity::major, "probability", *r.probability);
    }
}

/// What 7.1.3 wants to be clear before the work: specification and rule, agreed by somebody on a day.
void agreement(FindingList& found, const CertificateData& data, const AgreedSpecification& s, std::size_t i) {
    const auto where = [&](const char* key) { return place_in("/specifications", i, key); };
    const std::string name = "the specification \"" + s.id + "\"";
    const bool prescribed = is_prescriber(data, s.rule.prescribed_by);
    if (s.agreed_on.empty() && !prescribed) {
        found.major("D02", iso_17025("7.1.3"), where("agreed_on"), "it is not said when " + name + " was agreed on",
                    "State the date of the agreement, or who prescribes the rule.");
    }
    if (!is_partner(s.agreed_by) && !prescribed) {
        // What the page prints all the same, a letter or a dash, is not told as nothing.
        found.major("D02", iso_17025("7.1.3"), where("agreed_by"),
                    s.agreed_by.empty() ? "it is not said with whom " + name + " was agreed on"
                                        : "\"" + s.agreed_by + "\" does not say with whom " + name + " was agreed on",
                    "State the person or department of the customer, or who prescribes the rule.");
    }
    if (is_of_the_laboratory(data, s.agreed_by)) {
        found.major("D02", iso_17025("7.1.3"), where("agreed_by"), name + " was agreed on with the laboratory itself",
                    "State the person or department of the customer, or who prescribes the rule.");
    }
    constexpr long k_longest_agreement_in_days = 10 * 366;
    if (days_between(s.agreed_on, data.dates.performed_from).value_or(0) > k_longest_agreement_in_days) {
        found.major("D02", iso_17025("7.1.3"), where("agreed_on"),
                    name + " was agreed on " + s.agreed_on + ", more than ten years before the work",
                    "Correct the date.");
    }
    // A rule that is chosen when the values are known can be chosen by the wanted verdict.
    if (is_after(s.agreed_on, data.dates.performed_from)) {
        found.add(data.status == "accredited" ? FindingSeverity::critical : FindingSeverity::major, "D02",
                  iso_17025("7.1.3"), where("agreed_on"),
                  name + " was agreed on " + s.agreed_on + ", after the work began on " + data.dates.performed_from,
                  "Agree on specification and rule before the work.");
    }
}

/// DR-12 and DR-13 have no content of their own: somebody else's rule.
void rule_of_others(FindingList& found, const CertificateData& data, const AgreedSpecification& s, std::size_t i) {
    const bool prescribed = is_prescriber(data, s.rule.prescribed_by);
    const std::string where = place_in("/specifications", i, s.rule.id == "DR-12" ? "rule/prescribed_by" : "rule/text");
    if (s.rule.id == "DR-12" && !prescribed) {
        found.critical("D10", iso_17025("7.8.6.2 c"), where,
                       "the rule of the specification \"" + s.id +
                           "\" is prescribed, and it is not said by which standard or regulation",
                       "State it (\"prescribed_by\"), or the rule that was agreed (DR-01 to DR-11, DR-13).");
    }
    if (s.rule.id == "DR-13" && !is_stated(s.rule.text) && !is_identification(s.agreement) && !prescribed) {
        found.major("D10", iso_17025("7.8.6.2 c"), where,
                    "the rule of the specification \"" + s.id +
                        "\" is one of the customer, and neither its wording nor the agreement is stated",
                    "State the wording (\"text\"), or the reference of the contract (\"agreement\").");
    }
}

void specification(FindingList& found, const Certificate& certificate, std::size_t i) {
    const AgreedSpecification& s = certificate.data.specifications[i];
    const auto where = [&](const char* key) { return place_in("/specifications", i, key); };
    const std::string name = "the specification \"" + s.id + "\"";
    if (s.rule.id.empty()) {
        found.critical("D01", iso_17025("7.8.6.2 c"), where("rule/id"), name + " has no decision rule",
                       "State the rule that was agreed (DR-01 to DR-13).");
    }
    agreement(found, certificate.data, s, i);
    rule_of_others(found, certificate.data, s, i);
    empty_parameter(found, s, i);
    if (!is_name_of_document(s.document) || !is_stated(s.edition)) {
        found.major("D03", iso_17025("7.8.6.2 b"), where(!is_name_of_document(s.document) ? "document" : "edition"),
                    name + " has no document or no edition", "State both.");
    }
    if (is_stated(s.document) && letters_of(s.document) == letters_of(certificate.data.number)) {
        found.major("D03", iso_17025("7.8.6.2 b"), where("document"),
                    name + " names this certificate itself as its document",
                    "Name the document in which the limits stand.");
    }
    if (!s.lower && !s.upper && !s.limits) {
        found.major("D03", iso_17025("7.8.6.2 b"), where("upper"), name + " has no limit", "State the limit values.");
    }
    const std::vector<std::string> unknown = names_of_no_result(certificate, s.results);
    if (!certificate.tables.empty() && (!unknown.empty() || s.results.empty())) {
        std::vector<std::string> quoted;
        std::transform(unknown.begin(), unknown.end(), std::back_inserter(quoted),
                       [](const std::string& one) { return text::in_quotes(one); });
        found.major("D07", iso_17025("7.8.6.2 a"), where("results"),
                    unknown.size() == s.results.size()
                        ? name + " names no result of the certificate, so that nothing is decided by it"
                        : name + " names " + text::listed(quoted, 8) +
                              ", which no result of the certificate is called: nothing is decided there",
                    "Correct the names of the results; those of the certificate are " +
                        text::listed(result_names(certificate, unknown), 8) + ".");
    }
}

}  // namespace

std::vector<Finding> specification_findings(const Certificate& certificate) {
    FindingList found(certificate.data);
    for (std::size_t i = 0; i < certificate.data.specifications.size(); ++i) {
        specification(found, certificate, i);
    }
    return found.take();
}

}  // namespace gumcert::certificate
