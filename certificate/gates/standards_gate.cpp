#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "certificate/dates.h"
#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"
#include "certificate/section_data.h"
#include "certificate/stated_text.h"
#include "certificate/text_words.h"
#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"
#include "text/rounded_number.h"
#include "text/visible_text.h"

namespace gumcert::certificate {

namespace {

constexpr long k_days_without_recalibration = 5 * 366;  // of a standard for which no end of validity is stated
constexpr long k_longest_validity_in_days = 10 * 366;

std::string named(const StandardUsed& s) {
    return "the standard \"" + s.name.in("en") + "\"";
}

void identity(FindingList& found, const StandardUsed& s, std::size_t i) {
    const auto where = [&](const char* key) { return place_in("/standards", i, key); };
    // Each by its own place, and with what was given: nobody should look for what is there.
    struct Member {
        const char* key;
        std::string given;
        bool counts;
    };
    for (const Member& member : {Member{"identification", s.identification, is_identification(s.identification)},
                                 Member{"certificate", s.certificate, is_identification(s.certificate)},
                                 Member{"issuer", s.issuer.in("en"), is_name(s.issuer)}}) {
        if (!member.counts) {
            found.critical("R07-4c", iso_17025("7.8.4.1 c"), where(member.key),
                           member.given.empty()
                               ? named(s) + " has no identification, no certificate or no issuer"
                               : text::in_quotes(member.given) +
                                     " does not count as the identification, certificate or issuer of " + named(s),
                           "State all three: the statement of traceability rests on them.");
        }
    }
    if (!is_name(s.name)) {
        found.major("R07-4c", iso_17025("7.8.4.1 c"), where("name"), "it is not said what " + named(s) + " is",
                    "Name the standard or instrument.");
    }
}

void uncertainty(FindingList& found, const StandardUsed& s, std::size_t i) {
    const auto where = [&](const char* key) { return place_in("/standards", i, key); };
    if (!s.U && !s.conformity_statement_only) {
        found.critical("T04", iso_17025("6.5"), where("U"), "the certificate of " + named(s) + " states no uncertainty",
                       "State U and k of the certificate, or \"conformity_statement_only\": true where its limits of "
                       "error stand in the budget.");
    } else if (s.U && !s.k) {
        found.major("T04", iso_17025("6.5"), where("k"), "the coverage factor of " + named(s) + " is missing",
                    "State it.");
    }
    constexpr double k_largest_factor = 14.0;  // of 95 % with one degree of freedom
    if (s.U && s.k && *s.k > k_largest_factor) {
        found.major("T04", iso_17025("6.5"), where("k"),
                    "the coverage factor of " + named(s) + " is " + text::shortest(*s.k),
                    "State U and k as the certificate of the standard does.");
    }
}

struct SameText {
    const char* key;  ///< of the standard
    std::string text, other;
    const char* what;
    FindingSeverity severity;
};

/// Texts of a standard that belong to something else of the certificate.
void same_texts(FindingList& found, const CertificateData& data, const StandardUsed& s, std::size_t i) {
    const std::string issuer = s.issuer.in("en");
    const std::string body = data.accreditation ? data.accreditation->body.in("en") : std::string();
    std::vector<SameText> all{
        {"certificate", s.certificate, data.customer.order, "the order of the customer", FindingSeverity::critical},
        {"issuer", issuer, data.customer.name.in("en"), "the name of the customer", FindingSeverity::major},
        {"issuer", issuer, body, "the accreditation body", FindingSeverity::major},
    };
    for (const Item* item : items_of(data)) {
        for (const std::string* number : {&item->serial_number, &item->identification}) {
            all.push_back(
                {"certificate", s.certificate, *number, "the serial number of the item", FindingSeverity::critical});
        }
        all.push_back({"name", s.name.in("en"), item->description.in("en"), "the description of the item",
                       FindingSeverity::minor});
    }
    std::set<std::string> told;  // of several items once
    for (const SameText& one : all) {
        if (is_stated(one.text) && letters_of(one.text) == letters_of(one.other) && told.insert(one.what).second) {
            found.add(one.severity, "T08", iso_17025("6.5"), place_in("/standards", i, one.key),
                      named(s) + " has in " + one.key + " the same text as " + one.what,
                      "State each of them as it is.");
        }
    }
}

/// What cannot be the certificate of another body about another thing.
void independence(FindingList& found, const CertificateData& data, const StandardUsed& s, std::size_t i) {
    const auto same = [](const std::string& a, const std::string& b) {
        return is_stated(a) && letters_of(a) == letters_of(b);
    };
    if (same(s.certificate, data.number)) {
        found.critical("T08", iso_17025("6.5"), place_in("/standards", i, "certificate"),
                       named(s) + " rests on this certificate itself, " + data.number,
                       "State the number of the certificate of the standard.");
    }
    const std::vector<const Item*> items = items_of(data);
    if (std::any_of(items.begin(), items.end(), [&](const Item* item) {
            return same(s.identification, item->serial_number) || same(s.identification, item->identification);
        })) {
        found.critical("T08", iso_17025("6.5"), place_in("/standards", i, "identification"),
                       named(s) + " has the identification of the item itself, " + s.identification,
                       "State the standard to which the item was compared.");
    }
    same_texts(found, data, s, i);
    const bool own = is_stated(s.issuer) && letters_of(s.issuer.in("en")) == letters_of(data.laboratory.name.in("en"));
    const std::string accreditation = data.accreditation ? data.accreditation->number : std::string();
    if (!own && same(s.issuer_accreditation, accreditation)) {
        found.major("T08", iso_17025("6.5"), place_in("/standards", i, "issuer_accreditation"),
                    named(s) + " was calibrated under the accreditation of this laboratory by another one",
                    "State it as it is.");
    }
    if (!own && s.route == "in_house" && is_stated(s.issuer)) {
        found.major(
            "T08", iso_17025("6.5"), place_in("/standards", i, "route"),
            named(s) + " is traceable by route in_house, and another laboratory calibrated it: " + s.issuer.in("en"),
            "State the route by which the other laboratory is competent.");
    }
    if (own && s.route != "in_house" && s.route != "2") {
        found.major(
            "T08", iso_17025("6.5"), place_in("/standards", i, "issuer"),
            "the laboratory itself calibrated " + named(s) + ", and the route of traceability is \"" + s.route + "\"",
            "State the route \"in_house\" with its evidence, or who calibrated it.");
    }
}

void repetitions(FindingList& found, const CertificateData& data) {
    const std::vector<StandardUsed>& all = data.standards;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const bool thing = is_stated(all[i].identification) &&
                               letters_of(all[i].identification) == letters_of(all[j].identification);
            const bool paper =
                is_stated(all[i].certificate) && letters_of(all[i].certificate) == letters_of(all[j].certificate);
            if (thing || paper) {
                found.major("T08", iso_17025("6.5"),
                            place_in("/standards", i, paper ? "certificate" : "identification"),
                            named(all[i]) + " has the " + (paper ? "certificate" : "identification") + " of " +
                                named(all[j]) + ", " + (paper ? all[i].certificate : all[i].identification),
                            "List each standard once, with its own certificate.");
                break;
            }
        }
    }
}

/// The largest standard uncertainty of the results of a dimension, in SI units; nothing where there is none. Results of
/// a rotary table are differences, which lack what its standards have in common: they may be three times better.
std::optional<double> largest_u(const Certificate& certificate, const gum::Unit& unit) {
    constexpr double k_better_as_a_difference = 3.0;
    // The largest and not the smallest: a standard that is used for one of several results has to be good enough for
    // that one only.
    std::optional<double> largest;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            gum::Unit of;
            try {
                of = gum::Unit::parse(column.unit);
            } catch (const gum::InputError&) {
                continue;
            }
            for (const CertifiedValue& value : column.values) {
                if (of.dimension() == unit.dimension() && !value.external && value.u > 0.0) {
                    const double factor = table.id == "results" ? 1.0 : k_better_as_a_difference;
                    largest = std::max(largest.value_or(0.0), factor * of.difference_to_si(value.u));
                }
            }
        }
    }
    return largest;
}

/// The least that a stated U may have been before it was rounded: half a unit of its last digit less. One digit, "2E-5", stands
/// for two.
double least_before_rounding(double U) {
    constexpr int k_all_digits = 17;
    const auto is_in = [U](int digits) { return text::rounded_number(U, digits) == U; };
    int digits = 2;
    while (digits < k_all_digits && !is_in(digits)) {
        ++digits;
    }
    return U - 0.5 * std::pow(10.0, std::floor(std::log10(U)) - (digits - 1));
}

/// Nothing that is compared with a standard of the same kind is known better than the standard.
void against_results(FindingList& found, const Certificate& certificate, const StandardUsed& s, std::size_t i) {
    // Of ratios nobody can tell whether they are of the same kind.
    if (!s.U || s.unit.empty() || s.unit == "1" || s.unit == "percent") {
        return;
    }
    gum::Unit unit;
    try {
        unit = gum::Unit::parse(s.unit);
    } catch (const gum::InputError&) {
        return;
    }
    const std::optional<double> largest = largest_u(certificate, unit);
    const double u = unit.difference_to_si(least_before_rounding(*s.U)) / s.k.value_or(2.0);
    if (largest && u > *largest * (1.0 + 1e-9)) {
        found.major("T07", iso_17025("7.6.1"), place_in("/standards", i, "U"),
                    named(s) + " has a larger standard uncertainty than every result of its kind",
                    "See whether its uncertainty is in the budget, and whether it is the standard that was used.");
    }
}

}  // namespace

void validity_of_standard(FindingList& found, const StandardUsed& s, std::size_t i, const Dates& dates) {
    const auto where = [&](const char* key) { return place_in("/standards", i, key); };
    const std::string& last = last_day(dates);
    if (s.calibrated.empty()) {
        found.critical("R07-4c", iso_17025("7.8.4.1 c"), where("calibrated"),
                       "the date of the calibration of " + named(s) + " is missing",
                       "State it: without it nobody can see that the calibration was valid.");
    }
    if (is_after(last, s.valid_to)) {
        found.critical(
            "T01", iso_17025("6.4"), where("valid_to"),
            "the calibration of " + named(s) + " was valid to " + s.valid_to + ", and the work ended on " + last,
            "Use a standard with a valid calibration, or correct the dates.");
    }
    if (is_after(s.calibrated, dates.performed_from)) {
        found.critical(
            "T02", iso_17025("6.5"), where("calibrated"),
            named(s) + " was calibrated on " + s.calibrated + ", after the work began on " + dates.performed_from,
            "State the certificate that was valid during the work.");
    }
    if (s.valid_to.empty()) {
        const bool old = days_between(s.calibrated, last).value_or(0) > k_days_without_recalibration;
        found.add(old ? FindingSeverity::critical : FindingSeverity::major, "T05", iso_17025("6.4"), where("valid_to"),
                  "it is not said until when the calibration of " + named(s) + " is valid" +
                      (old ? ", and it is of " + s.calibrated + ", more than five years before the work" : ""),
                  "State the day until which the laboratory uses it (\"valid_to\"), or have it calibrated.");
    } else if (days_between(s.calibrated, s.valid_to).value_or(0) > k_longest_validity_in_days) {
        found.major("T05", iso_17025("6.4"), where("valid_to"),
                    "the calibration of " + named(s) + " is to be valid from " + s.calibrated + " to " + s.valid_to +
                        ", more than ten years",
                    "Correct the dates, or have it calibrated.");
    }
}

std::vector<Finding> standard_findings(const Certificate& certificate) {
    const CertificateData& data = certificate.data;
    FindingList found(data);
    if (data.standards.empty()) {
        found.critical("R07-4c", iso_17025("7.8.4.1 c"), "/standards",
                       "it is not said how the results are traceable: no standard is named",
                       "List the standards with their certificates.");
    }
    for (std::size_t i = 0; i < data.standards.size(); ++i) {
        const StandardUsed& s = data.standards[i];
        identity(found, s, i);
        uncertainty(found, s, i);
        validity_of_standard(found, s, i, data.dates);
        independence(found, data, s, i);
        against_results(found, certificate, s, i);
    }
    repetitions(found, data);
    return found.take();
}

}  // namespace gumcert::certificate
