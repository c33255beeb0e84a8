#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "certificate/dates.h"
#include "certificate/finding_list.h"
#include "certificate/gates.h"
#include "certificate/stated_text.h"
#include "certificate/text_words.h"

namespace gumcert::certificate {

namespace {

/// A name, or the customer as a whole.
bool is_partner(const std::string& text) {
    constexpr std::array<std::u32string_view, 7> k_customer = {U"customer",     U"thecustomer", U"client", U"kunde",
                                                               U"auftraggeber", U"cliente",     U"客戶"};
    return is_name(text) || std::find(k_customer.begin(), k_customer.end(), letters_of(text)) != k_customer.end();
}

/// What 7.1.3 wants to be clear before the work: specification and rule, agreed by somebody on a day.
void agreement(FindingList& found, const CertificateData& data, const AgreedSpecification& s, std::size_t i) {
    const auto where = [&](const char* key) { return place_in("/specifications", i, key); };
    const std::string name = "the specification \"" + s.id + "\"";
    const bool prescribed = is_name(s.rule.prescribed_by);
    if (s.agreed_on.empty() && !prescribed) {
        found.major("D02", iso_17025("7.1.3"), where("agreed_on"), "it is not said when " + name + " was agreed on",
                    "State the date of the agreement, or who prescribes the rule.");
    }
    if (!is_partner(s.agreed_by) && !prescribed) {
        found.major("D02", iso_17025("7.1.3"), where("agreed_by"),
                    "it is not said with whom " + name + " was agreed on",
                    "State the person or department of the customer, or who prescribes the rule.");
    }
    if (is_after(s.agreed_on, data.dates.performed_from)) {
        found.add(data.status == "accredited" ? FindingSeverity::critical : FindingSeverity::major, "D02",
                  iso_17025("7.1.3"), where("agreed_on"),
                  name + " was agreed on " + s.agreed_on + ", after the work began on " + data.dates.performed_from,
                  "Agree on specification and rule before the work.");
    }
}

/// DR-12 and DR-13 have no content of their own: somebody else's rule.
void rule_of_others(FindingList& found, const AgreedSpecification& s, std::size_t i) {
    const bool prescribed = is_name(s.rule.prescribed_by);
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
    rule_of_others(found, s, i);
    if (!is_name(s.document) || !is_stated(s.edition)) {
        found.major("D03", iso_17025("7.8.6.2 b"), where(!is_name(s.document) ? "document" : "edition"),
                    name + " has no document or no edition", "State both.");
    }
    if (!s.lower && !s.upper) {
        found.major("D03", iso_17025("7.8.6.2 b"), where("upper"), name + " has no limit", "State the limit values.");
    }
    if (!certificate.tables.empty() && !names_a_result(certificate, s.results)) {
        found.major("D07", iso_17025("7.8.6.2 a"), where("results"),
                    name + " names no result of the certificate, so that nothing is decided by it",
                    "Correct the names of the results.");
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
