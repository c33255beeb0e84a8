#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "certificate/certified_results.h"
#include "certificate/gates/gates.h"
#include "tests/support/sample_certificate.h"

namespace gumcert::certificate {

/// A length with U = 92.6 nm, where the scope allows 56 nm.
inline CertifiedValue certified_length() {
    CertifiedValue v;
    v.value = 50000838.0;
    v.u = 31.7;
    v.U = 92.6;
    v.k = 2.92;
    v.printed_value = "50000838";
    v.printed_U = "93";
    v.printed_k = "2.92";
    v.scope_entry = "L1";
    v.capability = 55.9;
    v.printed_capability = "55.9";
    Verdict verdict;
    verdict.specification = "length";
    verdict.rule = "DR-03";
    verdict.verdict = verdict.verdict_from_printed = "pass";
    verdict.conformance_probability = 0.9999;
    verdict.printed.conformance_probability = ">99.99";
    v.verdict = verdict;
    return v;
}

/// A certificate that passes every gate without a finding: the sample data, with one length and one axial rotation.
inline Certificate passed_certificate() {
    Certificate c;
    c.data = test::sample_certificate_data();
    c.profile.id = "ilac";
    CertifiedValue angle = certified_length();
    angle.value = 1.23;
    angle.u = 0.33;
    angle.U = 0.66;
    angle.printed_value = "1.23";
    angle.printed_U = "0.66";
    angle.capability = 0.2;
    angle.printed_capability = "0.2";
    angle.scope_entry = "R2";
    CertifiedTable table;
    table.id = "results";
    table.columns = {
        {.result = "l", .name = "length", .unit = "nm", .printed_unit = "nm", .values = {certified_length()}},
        {.result = "EAA", .name = "axial", .unit = "arcsec", .printed_unit = "″", .values = {angle}}};
    c.tables = {table};
    return c;
}

inline std::vector<std::string> ids(const std::vector<Finding>& findings) {
    std::vector<std::string> all;
    for (const Finding& f : findings) {
        all.push_back(f.id);
    }
    return all;
}

/// The only finding; fails where there is none or more than one.
inline Finding only(const std::vector<Finding>& findings) {
    EXPECT_EQ(findings.size(), 1U);
    for (std::size_t i = 1; i < findings.size(); ++i) {
        ADD_FAILURE() << findings[i].id << " " << findings[i].where << ": " << findings[i].what;
    }
    return findings.empty() ? Finding() : findings.front();
}

inline void expect_finding(const Finding& found, const std::string& id, const std::string& clause,
                           FindingSeverity severity, const std::string& where) {
    EXPECT_EQ(found.id, id) << found.what;
    EXPECT_EQ(found.clause, clause);
    EXPECT_EQ(found.severity, severity) << found.id << " " << found.what;
    EXPECT_EQ(found.where, where);
    EXPECT_FALSE(found.what.empty());
}

}  // namespace gumcert::certificate
