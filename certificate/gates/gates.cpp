#include "certificate/gates/gates.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "certificate/section_data.h"

namespace gumcert::certificate {

namespace {

bool has_accredited_value(const Certificate& certificate) {
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            const bool any = std::any_of(column.values.begin(), column.values.end(), [](const CertifiedValue& value) {
                return !value.scope_entry.empty() && !value.external && (value.U || value.interval);
            });
            if (any) {
                return true;
            }
        }
    }
    return false;
}

/// What a section states of its own passes the gates as that of the certificate does.
/// \param all  findings of the certificate, to which those of the sections are added
void add_sections(const Certificate& certificate, std::vector<Finding>& all) {
    const std::vector<SectionData>& sections = certificate.data.sections;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        Certificate part;
        // The gates look at the section as if it were a certificate of its own, so that no rule is written twice. Kept
        // is only what belongs to what the section states itself; the rest was told for the certificate already.
        part.data = data_of_section(certificate.data, sections[i].section);
        part.data.sections.clear();
        part.profile = certificate.profile;
        for (const CertifiedTable& table : certificate.tables) {
            if (table.section == sections[i].section) {
                part.tables.push_back(table);
            }
        }
        std::vector<std::string> own;
        if (sections[i].item) {
            own.emplace_back("/item");
        }
        if (sections[i].method) {
            own.emplace_back("/method");
        }
        if (!sections[i].conditions.empty()) {
            own.emplace_back("/conditions");
        }
        std::vector<Finding> found = completeness_findings(part);
        const std::vector<Finding> more = plausibility_findings(part);
        found.insert(found.end(), more.begin(), more.end());
        for (Finding& finding : found) {
            const bool is_own = std::any_of(own.begin(), own.end(), [&](const std::string& key) {
                return finding.where == key || finding.where.starts_with(key + "/");
            });
            if (is_own) {
                finding.where = "/sections/" + std::to_string(i) + finding.where;
                all.push_back(std::move(finding));
            }
        }
    }
}

}  // namespace

void pass_gates(Certificate& certificate, const std::vector<Finding>& audit) {
    std::vector<Finding> all = completeness_findings(certificate);
    for (const std::vector<Finding>& more : {plausibility_findings(certificate), uncertainty_findings(certificate),
                                             symbol_findings(certificate), language_findings(certificate), audit}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    add_sections(certificate, all);
    certificate.findings.clear();
    // The symbol claims that something on the page is accredited: without such a value it would be misused.
    certificate.symbol = certificate.data.status == "accredited" && has_accredited_value(certificate);
    add_findings(certificate, all);
}

void add_findings(Certificate& certificate, const std::vector<Finding>& later) {
    std::vector<Finding>& all = certificate.findings;
    all.insert(all.end(), later.begin(), later.end());
    std::stable_sort(all.begin(), all.end(),
                     [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
    // A specimen shows the form, with placeholders for what is not known, so gaps do not block it.
    const bool critical = !all.empty() && all.front().severity == FindingSeverity::critical;
    certificate.blocked = critical && certificate.data.status != "specimen";
    certificate.symbol = certificate.symbol && !critical;
}

}  // namespace gumcert::certificate
