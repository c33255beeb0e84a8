#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/certificate_data.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/job_files.h"
#include "jobs/json_object.h"

namespace gumcert::jobs {

/// Fills in what certificate data refer to in the files of the laboratory (jobs/laboratory), before they are read.
class CertificateCompletion {
public:
    virtual ~CertificateCompletion() = default;
    /// \param document  a copy of that of the data, to be changed
    /// \param place     of the object with the data in it; its list receives what is wrong
    virtual void complete(JsonDocument& document, const CertificatePlace& place) = 0;
};

/// The key `certificate` of a job: an object, or the name of a file with one. Checked completely; files that it names
/// (symbol, profile) are read too. docs/certificate_data.md says every key.
/// \param job       document whose value is an object
/// \param problems  of the job
/// \param completion  none: what the data say is all there is
/// \return nothing without the key, or when it was refused (the problems are in `files`)
[[nodiscard]] std::optional<certificate::CertificateData> read_certificate(JobFiles& files, const JsonDocument& job,
                                                                           ProblemList& problems,
                                                                           CertificateCompletion* completion = nullptr);

/// Waivers of findings of an audit in a file of their own, for tables and workbooks, which have no certificate data: a list
/// of objects as `waivers` of certificate data has them.
/// \throws gum::InputError  with every problem
[[nodiscard]] std::vector<certificate::Waiver> parse_waivers(std::string_view bytes, const std::string& file);

/// A profile of an accreditation body.
/// \param bytes  content of templates/profiles/<id>.json
/// \throws gum::InputError  with every problem
[[nodiscard]] certificate::Profile parse_profile(std::string_view bytes, const std::string& file);

}  // namespace gumcert::jobs
