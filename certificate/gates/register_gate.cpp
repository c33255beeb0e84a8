#include "certificate/gates/register_gate.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificate/dates.h"
#include "certificate/gates/finding_list.h"
#include "certificate/stated_text.h"
#include "text/lists.h"

namespace gumcert::certificate {

namespace {

void contradictions(FindingList& found, const LaboratoryRegister& registered) {
    for (const LaboratoryRegister::Contradiction& one : registered.contradictions) {
        const bool is_standard = one.where.starts_with("/standards/");
        found.critical(
            is_standard ? "T10" : "L01", iso_17025(is_standard ? "6.5" : "7.8.2.1"), one.where,
            "the certificate states of " + one.subject + " " + one.stated + ", and the register " + one.registered,
            "Correct the one that is wrong, or leave it out of the certificate data: the register fills it "
            "in.");
    }
}

/// The gravest that the dates of the row of a standard say against its use; nothing where they say nothing, or the
/// certificate does not list it.
std::optional<FindingSeverity> told_of_validity(const CertificateData& data, const std::string& standard) {
    FindingList of_rows(data);
    for (std::size_t i = 0; i < data.standards.size(); ++i) {
        if (data.standards[i].identification == standard) {
            validity_of_standard(of_rows, data.standards[i], i, data.dates);
        }
    }
    std::vector<Finding> told = of_rows.take();
    // A day that nobody stated shows nothing.
    std::erase_if(told, [](const Finding& one) { return one.id != "T01" && one.id != "T02" && one.id != "T05"; });
    const auto gravest = std::ranges::max_element(told, {}, &Finding::severity);
    return gravest == told.end() ? std::nullopt : std::optional(gravest->severity);
}

/// Whether the row of a standard says that it is valid to a day that the work exceeds.
bool is_told_to_end_on(const CertificateData& data, const std::string& standard, const std::string& day) {
    return std::ranges::any_of(data.standards, [&](const StandardUsed& s) {
        return s.identification == standard && s.valid_to == day && is_after(last_day(data.dates), day);
    });
}

void standards(FindingList& found, const CertificateData& data, const LaboratoryRegister& registered) {
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> inputs;  // by standard and reason
    for (const LaboratoryRegister::Use& use : registered.uses) {
        std::vector<std::string>& names = inputs[{use.standard, use.because}];
        if (std::find(names.begin(), names.end(), use.input) == names.end()) {
            names.push_back(use.input);
        }
    }
    for (const LaboratoryRegister::Use& use : registered.uses) {
        // The points of a table use a standard for one reason, as a rule: it is told once, with the inputs.
        const auto found_inputs = inputs.extract({use.standard, use.because});
        if (use.answer == "yes" || found_inputs.empty()) {
            continue;
        }
        const std::vector<std::string>& names = found_inputs.mapped();
        // "No" is known to be wrong. Where nobody knows, the issue is not blocked, but the certificate does not stay
        // silent.
        const bool is_refuted = use.answer == "no";
        const FindingSeverity severity = is_refuted ? FindingSeverity::critical : FindingSeverity::major;
        if (use.is_of_validity && told_of_validity(data, use.standard) >= severity) {
            continue;  // the dates of its row tell it
        }
        found.add(
            severity, "T11", iso_17025("6.4"), names.size() == 1 ? names.front() : "inputs " + text::listed(names),
            std::string(is_refuted
                            ? "the standard \"" + use.standard + "\" cannot be used here: "
                            : "it is not known whether the standard \"" + use.standard + "\" can be used here: ") +
                use.because,
            is_refuted ? "Use a standard that is calibrated for this."
                       : "State it in the register, or where the input uses the standard.");
    }
    for (const LaboratoryRegister::Overdue& one : registered.overdue) {
        if (is_told_to_end_on(data, one.standard, one.due)) {
            continue;
        }
        // Its last day of use may be later: the laboratory has found since that it moves faster (6.4.7).
        found.critical("T14", iso_17025("6.4"), "/standards",
                       "the standard \"" + one.standard + "\" was used on " + one.day +
                           ", and by the plan of the laboratory its calibration was due on " + one.due,
                       "Use a standard whose calibration is not due, or bring its plan in the register up to date.");
    }
    for (const std::string& id : registered.not_registered) {
        found.major("T12", iso_17025("6.4"), "/standards",
                    "the standard \"" + id + "\" of the certificate is not in the register of the laboratory",
                    "Add it to the register, or correct its identification.");
    }
    for (const std::string& id : registered.not_listed) {
        found.add(FindingSeverity::minor, "T13", iso_17025("7.8.4.1 c"), "/standards",
                  "the budget uses the standard \"" + id + "\", and the list of the certificate does not name it",
                  "Name it in the list; its row was added from the register.");
    }
}

void signatory(FindingList& found, const CertificateData& data, const LaboratoryRegister& registered) {
    const std::optional<Person>& person = data.persons.authorised_by;
    if (!person || person->name.empty() || registered.signatories.empty()) {
        return;
    }
    const auto refute = [&](const std::string& why) {
        found.critical("P14", iso_17025("6.2.6"), "/persons/authorised_by",
                       "by the register, " + person->name + " may not authorise this certificate: " + why,
                       "Let a person authorise it whom the register allows to, or bring the register up to date.");
    };
    const auto one =
        std::find_if(registered.signatories.begin(), registered.signatories.end(),
                     [&](const LaboratoryRegister::Signatory& s) { return is_same_name(s.name, person->name); });
    if (one == registered.signatories.end()) {
        if (!is_authorised_by_no_signatory(data)) {  // told of the signatories of the accreditation else
            refute("it does not name this person");
        }
        return;
    }
    const std::string& day = data.dates.authorised.empty() ? data.dates.issued : data.dates.authorised;
    if (!one->authorises && !is_authorised_by_no_signatory(data)) {
        refute("the person signs, and does not authorise");
    }
    // The days that a certificate states of a person are held against the work without a register, too.
    if (!day.empty() && !is_within(day, one->from, one->to) &&
        is_within(day, person->authorised_from, person->authorised_to)) {
        refute("the authorisation is valid" + (one->from.empty() ? std::string() : " from " + one->from) +
               (one->to.empty() ? std::string() : " to " + one->to) + ", and not on " + day);
    }
    const auto hold_against = [&](const Method& method) {
        const std::vector<std::string>& methods = one->methods;
        if (!methods.empty() && std::find(methods.begin(), methods.end(), method.identification) == methods.end()) {
            refute("the method \"" + method.identification + "\" is not among those of this person");
        }
    };
    if (!data.method.identification.empty()) {  // else the sections have theirs, or the gate on completeness tells
        hold_against(data.method);
    }
    for (const SectionData& section : data.sections) {
        if (section.method && section.method->identification != data.method.identification) {
            hold_against(*section.method);
        }
    }
}

}  // namespace

std::vector<Finding> register_findings(const CertificateData& data, const LaboratoryRegister& registered) {
    FindingList found(data);
    contradictions(found, registered);
    standards(found, data, registered);
    signatory(found, data, registered);
    return found.take();
}

}  // namespace gumcert::certificate
