#pragma once

#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "certificate/dates.h"
#include "jobs/certificate/certificate_statement.h"
#include "tests/fuzz/job_targets.h"

namespace gumcert::jobs::fuzz {

inline void demand_consistent(const certificate::CertificateData& data) {
    demand(data.status == "accredited" || data.status == "not_accredited" || data.status == "specimen", "a status");
    demand(!data.languages.empty() && data.languages.size() <= 4, "languages");
    demand(data.profile.ends_with(".json") == data.own_profile.has_value(), "a profile of its own");
    for (const std::string* date : {&data.dates.received, &data.dates.issued, &data.recalibration_date}) {
        demand(date->empty() || certificate::calendar_date(*date).has_value(), "a date");
    }
    for (const certificate::StandardUsed& standard : data.standards) {
        demand(!standard.U || (*standard.U > 0.0 && !standard.unit.empty()), "U of a standard");
        demand(!standard.k || *standard.k >= 1.0, "k of a standard");
    }
    for (const certificate::Condition& condition : data.conditions) {
        demand(condition.minimum <= condition.maximum && !condition.unit.empty(), "a condition");
    }
    for (const certificate::AgreedSpecification& s : data.specifications) {
        demand((s.lower || s.upper) && !(s.lower && s.upper && *s.lower >= *s.upper), "limits");
        demand(!s.results.empty() && !s.id.empty(), "a specification");
    }
    if (data.accreditation) {
        const certificate::Accreditation& a = *data.accreditation;
        demand(a.symbol_base64.empty() == a.symbol_media_type.empty() &&
                   a.symbol_sha256.size() == (a.symbol_base64.empty() ? 0U : 64U),
               "a symbol");
        demand(a.symbol_file.has_value() == !a.symbol_base64.empty(), "a symbol that was not read");
    }
}

/// \param bundle  the files of certificate data, as job_targets.h has them; the data themselves are `certificate.json`,
///                or the whole text where it names no files
inline bool certificate_data(std::string_view bundle) {
    std::map<std::string, std::string> files = files_of_bundle(bundle);
    if (!files.contains("certificate.json")) {
        files["certificate.json"] = std::string(bundle);
    }
    files["job.json"] = R"({"certificate": "certificate.json"})";
    const MemoryFileSource source(files);
    const auto read = [&] {
        JobFiles job(source, "job.json");
        const JobFiles::File file = job.job();
        const std::optional<JsonDocument> document = read_json_document(file.bytes, *file.problems);
        const std::optional<certificate::CertificateData> data = read_certificate(job, *document, *file.problems);
        job.refuse_if_needed();
        demand(data.has_value(), "refused without a reason");
        demand_consistent(*data);
        demand_honest(job.warnings());
    };
    bool accepted = false;
    try {
        read();
        accepted = true;
    } catch (const gum::InputError& error) {
        demand_honest(error.diagnostics());
    } catch (const gum::StorageError& error) {
        demand_honest(error.diagnostics());
    }
    try {
        for (const certificate::Waiver& waiver : parse_waivers(files["certificate.json"], "certificate.json")) {
            demand(!waiver.finding.empty() && !waiver.by.empty() && !waiver.reason.empty(), "what a waiver needs");
            demand(certificate::calendar_date(waiver.date).has_value(), "the date of a waiver");
        }
        accepted = true;
    } catch (const gum::InputError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
        demand_honest(error.diagnostics());
    }
    try {
        const certificate::Profile profile = parse_profile(files["certificate.json"], "certificate.json");
        demand(profile.digits == 1 || profile.digits == 2, "digits of a profile");
        accepted = true;
    } catch (const gum::InputError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
        demand_honest(error.diagnostics());
    }
    return accepted;
}

}  // namespace gumcert::jobs::fuzz
