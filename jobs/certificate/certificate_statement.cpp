#include "jobs/certificate/certificate_statement.h"

#include <algorithm>
#include <set>

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/image_format.h"
#include "jobs/input_text.h"
#include "jobs/job_limits.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using certificate::CertificateData;
using certificate::Profile;
using nlohmann::json;

/// \return nothing when it was refused, with the problems in the list of the file
std::optional<Profile> read_profile(std::string_view bytes, ProblemList& problems) {
    const std::optional<JsonDocument> document = read_json_document(bytes, problems);
    if (!document || document->value.is_discarded()) {
        return std::nullopt;
    }
    Profile profile;
    CertificateArchive::read_struct_at(profile, {&*document, "", &problems});
    return problems.refusals() == 0 ? std::optional{std::move(profile)} : std::nullopt;
}

/// A picture as it goes into the record, which can be printed by itself then.
struct Picture {
    std::string sha256, media_type, base64;
};

/// \param what  it is, for messages: "the logo of a laboratory"
/// \return nothing when it was refused
std::optional<Picture> read_picture(JobFiles& files, const std::string& name, const std::string& what) {
    const std::optional<JobFiles::File> file = files.open(name);
    if (!file) {
        return std::nullopt;
    }
    const auto refuse = [&](std::string found, std::string rule, std::string action) {
        file->problems->refuse(k_certificate_symbol, text::visible(file->problems->file()), std::move(found),
                               std::move(rule), std::move(action));
        return std::nullopt;
    };
    if (file->bytes.size() > k_largest_picture) {
        return refuse(
            file->bytes.size() > k_file_limit ? "more than 64 MiB" : std::to_string(file->bytes.size()) + " bytes",
            what + " has at most 1 MiB (1048576 bytes)", "use a smaller picture");
    }
    ImageFormat format = image_format(file->bytes);
    if (format.media_type.empty()) {
        return refuse(std::move(format.objection),
                      what +
                          " is a whole PNG or JPEG picture of 1 to 10000 pixels a side, or an SVG drawing of plain "
                          "shapes that needs nothing outside of its file",
                      "export it as plain SVG with texts turned into paths, or as PNG");
    }
    return Picture{encoding::sha256(file->bytes), std::move(format.media_type), encoding::base64(file->bytes)};
}

void read_pictures(JobFiles& files, CertificateData& data) {
    if (data.accreditation && data.accreditation->symbol_file && !data.accreditation->symbol_file->empty()) {
        certificate::Accreditation& a = *data.accreditation;
        if (auto picture = read_picture(files, *a.symbol_file, "the symbol of an accreditation")) {
            a.symbol_sha256 = std::move(picture->sha256);
            a.symbol_media_type = std::move(picture->media_type);
            a.symbol_base64 = std::move(picture->base64);
        }
    }
    if (certificate::Laboratory& l = data.laboratory; !l.logo.empty()) {
        if (auto picture = read_picture(files, l.logo, "the logo of a laboratory")) {
            l.logo_sha256 = std::move(picture->sha256);
            l.logo_media_type = std::move(picture->media_type);
            l.logo_base64 = std::move(picture->base64);
        }
    }
}

/// Sections are those of the job, and their standards rows of the certificate.
void check_sections(const CertificateData& data, const json& job, const CertificatePlace& place) {
    const auto known = job.find("sections");
    std::set<std::string> seen;
    for (std::size_t i = 0; i < data.sections.size(); ++i) {
        const certificate::SectionData& section = data.sections[i];
        const CertificatePlace here = place.below("/sections").child(i);
        if (known == job.end() || !known->is_object() || !known->contains(section.section)) {
            here.below("/section")
                .refuse(k_certificate_section, "the job has no section " + text::in_quotes(section.section),
                        "certificate data name sections by their names in the job",
                        "correct the name, or remove the entry");
        }
        if (!seen.insert(section.section).second) {
            here.below("/section")
                .refuse(k_certificate_repeated,
                        "the section " + text::in_quotes(section.section) + " for the second time",
                        "a section is stated once", "put the two together");
        }
        for (std::size_t s = 0; s < section.standards.size(); ++s) {
            const bool is_row = std::any_of(data.standards.begin(), data.standards.end(), [&](const auto& row) {
                return row.identification == section.standards[s];
            });
            if (!is_row) {
                here.below("/standards")
                    .child(s)
                    .refuse(k_certificate_section,
                            "no standard has the identification " + text::in_quotes(section.standards[s]),
                            "a section names rows of \"standards\" by their identification",
                            "correct it, or add the row to \"standards\"");
            }
        }
    }
}

/// \param job        that the data belong to
/// \param as_stated  of the object
std::optional<CertificateData> read_data(JobFiles& files, const json& job, const CertificatePlace& as_stated,
                                         CertificateCompletion* completion) {
    const std::size_t refusals = as_stated.problems->refusals();
    std::optional<JsonDocument> completed;
    CertificatePlace place = as_stated;
    if (completion != nullptr) {
        completed = *as_stated.document;
        place.document = &*completed;
        completion->complete(*completed, place);
    }
    CertificateData data;
    CertificateArchive::read_struct_at(data, place);
    check_lists(data, place);
    if (place.problems->refusals() == refusals) {
        check_sections(data, job, place);
    }
    if (!place.document->value.at(json::json_pointer(place.pointer)).contains("status")) {
        data.status = data.accreditation ? "accredited" : "specimen";
    }
    read_pictures(files, data);
    if (data.amendment && !data.amendment->record.empty()) {
        (void)files.open(data.amendment->record);  // it is read as a record where the certificate is made
    }
    if (data.profile.ends_with(".json")) {
        if (const std::optional<JobFiles::File> file = files.open(data.profile)) {
            data.own_profile = read_profile(file->bytes, *file->problems);
        }
    }
    return place.problems->refusals() == refusals ? std::optional{std::move(data)} : std::nullopt;
}

}  // namespace

std::optional<CertificateData> read_certificate(JobFiles& files, const JsonDocument& job, ProblemList& problems,
                                                CertificateCompletion* completion) {
    const auto found = job.value.find("certificate");
    if (found == job.value.end() || found->is_discarded()) {
        return std::nullopt;
    }
    const CertificatePlace place{&job, "/certificate", &problems};
    if (found->is_object()) {
        return read_data(files, job.value, place, completion);
    }
    if (!found->is_string()) {
        place.refuse(k_wrong_type, described(*found), "must be an object or the name of a file", "correct the value");
        return std::nullopt;
    }
    const std::string& name = found->get_ref<const std::string&>();
    if (!acceptable_text(name, certificate::TextForm::file, place)) {
        return std::nullopt;
    }
    const std::optional<JobFiles::File> file = files.open(name);
    const std::optional<JsonDocument> document = file ? read_json_document(file->bytes, *file->problems) : std::nullopt;
    if (!document) {
        return std::nullopt;
    }
    const CertificatePlace root{&*document, "", file->problems};
    if (!document->value.is_object()) {
        root.refuse(k_wrong_type, "the document is " + described(document->value), "must be an object",
                    "write { \"key\": value, … }");
        return std::nullopt;
    }
    return read_data(files, job.value, root, completion);
}

std::vector<certificate::Waiver> parse_waivers(std::string_view bytes, const std::string& file) {
    ProblemList problems(file);
    std::vector<certificate::Waiver> waivers;
    const std::optional<JsonDocument> document = read_json_document(bytes, problems);
    const CertificatePlace root{document ? &*document : nullptr, "", &problems};
    if (document && document->value.is_array()) {
        waivers.resize(document->value.size());
        for (std::size_t i = 0; i < waivers.size(); ++i) {
            CertificateArchive::read_struct_at(waivers[i], root.child(i));
        }
    } else if (document && !document->value.is_discarded()) {
        root.refuse(k_wrong_type, "the document is " + described(document->value), "must be a list of waivers",
                    R"(write [{"finding": "U10", "by": …, "date": …, "reason": …}])");
    }
    if (problems.refusals() > 0) {
        throw gum::InputError(problems.refused());
    }
    return waivers;
}

Profile parse_profile(std::string_view bytes, const std::string& file) {
    ProblemList problems(file);
    std::optional<Profile> profile = read_profile(bytes, problems);
    if (!profile) {
        throw gum::InputError(problems.refused());
    }
    return std::move(*profile);
}

}  // namespace gumcert::jobs
