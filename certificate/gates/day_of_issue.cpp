#include "certificate/gates/day_of_issue.h"

#include <string>

#include "certificate/dates.h"
#include "certificate/gates/finding_list.h"

namespace gumcert::certificate {

bool block_issue_ahead_of_time(Certificate& certificate, std::string_view today) {
    constexpr long k_days_between_time_zones = 1;
    const std::string& issued = certificate.data.dates.issued;
    if (certificate.data.status == "specimen" || days_between(today, issued).value_or(0) <= k_days_between_time_zones) {
        return false;
    }
    certificate.findings.insert(certificate.findings.begin(),
                                {.id = "P12",
                                 .clause = iso_17025("7.8.2.1 j"),
                                 .severity = FindingSeverity::critical,
                                 .where = "/dates/issued",
                                 .what = "the date of issue, " + issued + ", is after today, " + std::string(today),
                                 .action = "Correct the date, or issue the certificate on that day."});
    certificate.blocked = true;
    certificate.symbol = false;
    return true;
}

}  // namespace gumcert::certificate
