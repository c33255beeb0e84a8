#include "certificate/gates/printed_languages.h"

#include <algorithm>

#include "certificate/gates/gates.h"

namespace gumcert::certificate {

namespace {

bool is_among(const std::vector<Finding>& findings, const Finding& finding) {
    return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
        return f.id == finding.id && f.where == finding.where && f.what == finding.what;
    });
}

/// The languages that the profile demands and the document leaves out.
std::vector<Finding> demanded(const Profile& profile, const std::vector<std::string>& printed) {
    std::vector<Finding> findings;
    for (const std::string& language : profile.required_languages) {
        if (std::find(printed.begin(), printed.end(), language) == printed.end()) {
            findings.push_back(
                {.id = "R13",
                 .clause = "profile " + profile.id,
                 .severity = FindingSeverity::critical,
                 .where = "/languages",
                 .what = "the certificate is not given in \"" + language + "\", which the profile demands",
                 .action = "Add it."});
        }
    }
    return findings;
}

}  // namespace

bool judge_printed_languages(Certificate& certificate, const std::vector<std::string>& printed) {
    if (printed.empty() || certificate.data.status == "specimen") {
        return false;
    }
    const std::vector<Finding> left_out = demanded(certificate.profile, printed);
    Certificate as_printed = certificate;
    as_printed.data.languages = printed;
    std::vector<Finding> lacking = language_findings(as_printed);
    // What the gates told already for the languages of the data is not told twice.
    std::erase_if(lacking, [&](const Finding& finding) { return is_among(certificate.findings, finding); });
    certificate.findings.insert(certificate.findings.begin(), left_out.begin(), left_out.end());
    certificate.findings.insert(certificate.findings.end(), lacking.begin(), lacking.end());
    if (!left_out.empty()) {
        certificate.blocked = true;
        certificate.symbol = false;
    }
    return !left_out.empty() || !lacking.empty();
}

}  // namespace gumcert::certificate
