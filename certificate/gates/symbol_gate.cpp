#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "certificate/dates.h"
#include "certificate/gates/accreditation_standard.h"
#include "certificate/gates/cited_documents.h"
#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"
#include "certificate/stated_text.h"
#include "certificate/statement_of_uncertainty.h"
#include "certificate/text_words.h"

namespace gumcert::certificate {

namespace {

constexpr const char* k_p10 = "ILAC-P10:07/2020";

/// A value that is neither from another laboratory nor without uncertainty by definition.
bool is_claim(const CertifiedValue& value) {
    return !value.external && (value.U || value.interval || value.u > 0.0);
}

/// How the values of a column or of a certificate stand to the scope.
struct Tally {
    std::size_t inside = 0, outside = 0, external = 0;
    std::size_t at_capability = 0;  ///< printed U is exactly the capability
    std::string because;            ///< of the first one outside

    void count(const CertifiedValue& value) {
        if (value.external) {
            ++external;
        }
        if (!is_claim(value)) {
            return;
        }
        if (value.scope_entry.empty()) {
            ++outside;
            because = because.empty() ? value.outside_because : because;
            return;
        }
        ++inside;
        const std::optional<double> U = number_of(value.printed_U);
        const std::optional<double> capability = number_of(value.printed_capability);
        if (value.raised || (U && capability && *U == *capability)) {
            ++at_capability;
        }
    }
    void add(const Tally& other) {
        inside += other.inside;
        outside += other.outside;
        external += other.external;
        at_capability += other.at_capability;
        because = because.empty() ? other.because : because;
    }
};

void accreditation(FindingList& found, const CertificateData& data) {
    const Accreditation& a = *data.accreditation;
    if (!is_identification(a.number) || !is_name(a.body)) {
        found.critical("X08", k_p8, is_identification(a.number) ? "/accreditation/body" : "/accreditation/number",
                       "the accreditation has no number or no body", "State both.");
    }
    if (!is_of_calibration_laboratories(a.standard)) {
        found.critical(
            "X08", k_p8, "/accreditation/standard",
            "the accreditation is one by \"" + a.standard + "\", which is not one of a calibration laboratory",
            "State the accreditation by ISO/IEC 17025, or \"status\": \"not_accredited\".");
    }
    // A scope that has ended before the work is not told again for each later day.
    bool begins_later = false, has_ended = false;
    const auto valid_on = [&](const std::string& day, const char* what) {
        bool& is_told = is_after(a.valid_from, day) ? begins_later : has_ended;
        if (!day.empty() && !is_within(day, a.valid_from, a.valid_to) && !std::exchange(is_told, true)) {
            found.critical("X04", k_p8, "/accreditation/valid_to",
                           "the scope of accreditation is not valid on the day of " + std::string(what) + ", " + day +
                               " (valid" + (a.valid_from.empty() ? "" : " from " + a.valid_from) +
                               (a.valid_to.empty() ? "" : " to " + a.valid_to) + ")",
                           "Issue the certificate without the accreditation, or correct the dates.");
        }
    };
    // On the days of the work and on that of the issue: results are accredited by the scope under which they were made,
    // and the certificate by that under which it is issued.
    valid_on(data.dates.performed_from, "performance");
    if (data.dates.performed_to != data.dates.performed_from) {
        valid_on(data.dates.performed_to, "the end of the performance");
    }
    valid_on(data.dates.issued, "issue");
    for (std::size_t i = 0; i < a.scope.size(); ++i) {
        for (const CapabilityProblem& problem : check_capability(a.scope[i].capability)) {
            found.major("X05", k_p14, place_in("/accreditation/scope", i, "capability") + problem.key,
                        problem.what + ": " + problem.rule, problem.action);
        }
    }
    if (is_authorised_by_no_signatory(data)) {
        found.critical("P03", iso_17025("6.2.6"), "/persons/authorised_by",
                       data.persons.authorised_by->name + " is not one of the signatories of accredited certificates",
                       "Let a signatory authorise the certificate.");
    }
}

bool is_institute(const std::string& accreditation) {
    return letters_of(accreditation) == U"nmi";
}

/// Documents that show competence have a number, or are described in a sentence.
bool is_evidence(const std::string& text) {
    return is_name(text) && (text.find_first_of("0123456789") != std::string::npos || is_statement(text));
}

void routes(FindingList& found, const CertificateData& data) {
    for (std::size_t i = 0; i < data.standards.size(); ++i) {
        const StandardUsed& s = data.standards[i];
        const std::string name = "the standard \"" + s.name.in("en") + "\"";
        const bool accredited = is_identification(s.issuer_accreditation) && !is_institute(s.issuer_accreditation);
        const bool by_evidence =
            s.route == "3a" || s.route == "3b" || s.route == "in_house" || (s.route == "crm" && !accredited);
        if (s.route.empty()) {
            found.critical("T03", k_p10, place_in("/standards", i, "route"),
                           "it is not said by which route " + name + " is traceable",
                           "State 1 (national institute), 2 (accredited laboratory), 3a, 3b, in_house or crm.");
        } else if (by_evidence && !is_evidence(s.evidence)) {
            found.critical("T03", k_p10, place_in("/standards", i, "evidence"),
                           name + " is traceable by route " + s.route + ", and no evidence of competence is named",
                           "Name the documents that show the competence of who calibrated it.");
        } else if (s.route == "2" && !accredited) {
            found.critical("T03", k_p10, place_in("/standards", i, "issuer_accreditation"),
                           "the accreditation of the laboratory that calibrated " + name + " is missing",
                           "State its number.");
        } else if (s.route == "1" && !is_identification(s.issuer_accreditation)) {
            found.major("T03", k_p10, place_in("/standards", i, "issuer_accreditation"),
                        name + " is traceable by route 1, and it is not said that a national institute calibrated it",
                        "State \"issuer_accreditation\": \"NMI\", or the route that it is.");
        }
    }
}

void capabilities(const CertifiedTable& table, const CertifiedColumn& column, std::vector<FoundInRow>& of_values) {
    for (std::size_t row = 0; row < column.values.size(); ++row) {
        const CertifiedValue& value = column.values[row];
        const std::optional<double> U = number_of(value.printed_U);
        if (value.scope_entry.empty() || !value.capability || !U) {
            continue;
        }
        // Compared as printed, because the printed U is what the laboratory states.
        if (is_below_capability(value.printed_U, *value.capability)) {
            of_values.push_back(
                {.table = &table,
                 .column = &column,
                 .row = row,
                 .finding = {.id = "X01",
                             .clause = k_p14,
                             .severity = FindingSeverity::critical,
                             .where = {},
                             .what = "U is stated as " + value.printed_U + ", smaller than the capability " +
                                     value.printed_capability + " of the scope entry \"" + value.scope_entry + "\"",
                             .action = "State the capability, or the result as outside of the accreditation."},
                 .badness = -*U / *value.capability});
        }
    }
}

/// What is wrong with a value that is outside of the accreditation, its number of alike values not said.
/// \param inside  whether the same column has accredited values
Finding mixed(const CertifiedValue& value, bool inside, const Profile& profile) {
    Finding finding{.id = "X06",
                    .clause = k_p8,
                    .severity = FindingSeverity::information,
                    .where = {},
                    .what = value.outside_because,
                    .action = "They stand in columns of their own and are marked as not accredited."};
    if (profile.mixed_results == "mark") {
        finding.action = "The values are marked as not accredited; extend the scope where that is wrong.";
    } else if (profile.mixed_results == "refuse" || inside) {
        finding.severity = FindingSeverity::critical;
        finding.what += ", and the profile " + profile.id +
                        (profile.mixed_results == "refuse" ? " does not allow them on a certificate with the symbol"
                                                           : " wants them apart from accredited values");
        finding.action = "State them on a certificate of their own without the accreditation.";
    }
    return finding;
}

void scope(FindingList& found, const Certificate& certificate) {
    Tally all;
    std::vector<FoundInRow> below, outside;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            Tally tally;
            for (const CertifiedValue& value : column.values) {
                tally.count(value);
            }
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                const CertifiedValue& value = column.values[row];
                if (is_claim(value) && value.scope_entry.empty()) {
                    outside.push_back({.table = &table,
                                       .column = &column,
                                       .row = row,
                                       .finding = mixed(value, tally.inside > 0, certificate.profile),
                                       .badness = value.outside_by});
                }
            }
            capabilities(table, column, below);
            all.add(tally);
        }
    }
    found.add_by_cause(outside, {.one = " value is outside of the accreditation: ",
                                 .many = " values are outside of the accreditation: "});
    found.add_by_cause(below);
    // The symbol may stand only where at least one result is accredited (X02). U at the capability throughout says that
    // the item under calibration adds nothing, which is seldom true (X03).
    if (all.inside == 0) {
        found.critical(
            "X02", k_p8, "results",
            "no result is inside the scope of accreditation" + (all.because.empty() ? "" : ": " + all.because),
            "Issue the certificate without the accreditation, or correct scope, method or place.");
    } else if (all.at_capability == all.inside) {
        found.major("X03", k_p14, "results",
                    "the expanded uncertainty of every accredited result is exactly the capability",
                    "A capability stands for the best existing device: see whether the contributions of the item "
                    "under calibration are in the budget.");
    }
}

}  // namespace

std::vector<Finding> symbol_findings(const Certificate& certificate) {
    const CertificateData& data = certificate.data;
    FindingList found(data);
    if (data.status != "accredited") {
        return {};
    }
    if (!data.accreditation) {
        found.critical("X08", k_p8, "/accreditation",
                       "the certificate is to be accredited, and no accreditation is stated",
                       "State the accreditation, or \"status\": \"not_accredited\".");
        return found.take();
    }
    accreditation(found, data);
    routes(found, data);
    scope(found, certificate);
    found.append(scope_findings(certificate));
    if (!data.opinions.empty() && certificate.profile.opinions_with_symbol && data.own_profile) {
        found.major("X07", k_p8, "/opinions",
                    "opinions stand on a certificate with the symbol, because a profile of the laboratory itself, " +
                        certificate.profile.id + ", allows them",
                    "Give them in a document of their own, or show that the accreditation covers them.");
    }
    if (!data.opinions.empty() && !certificate.profile.opinions_with_symbol) {
        found.critical("X07", k_p8, "/opinions",
                       "opinions stand on a certificate with the symbol, which the profile " + certificate.profile.id +
                           " does not allow",
                       "Give them in a document of their own.");
    }
    return found.take();
}

}  // namespace gumcert::certificate
