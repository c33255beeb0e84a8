#pragma once

#include <string>
#include <utility>
#include <vector>

#include "certificate/certified_results.h"

namespace gumcert::certificate {

/// Collects the findings of a gate.
class FindingList {
public:
    explicit FindingList(const CertificateData& data) : data_(data) {}

    void add(FindingSeverity severity, const std::string& id, const std::string& clause, const std::string& where,
             const std::string& what, const std::string& action);

    void critical(const std::string& id, const std::string& clause, const std::string& where, const std::string& what,
                  const std::string& action) {
        add(FindingSeverity::critical, id, clause, where, what, action);
    }
    void major(const std::string& id, const std::string& clause, const std::string& where, const std::string& what,
               const std::string& action) {
        add(FindingSeverity::major, id, clause, where, what, action);
    }

    /// An item of ISO/IEC 17025:2017, 7.8.2.1. Where it may be left out for a valid reason and a reason is stored, the
    /// finding is an information that gives it.
    /// \param letter  "a" … "p"
    void item(FindingSeverity severity, char letter, const std::string& where, const std::string& what,
              const std::string& action);

    [[nodiscard]] std::vector<Finding> take() { return std::exchange(findings_, {}); }

private:
    const CertificateData& data_;
    std::vector<Finding> findings_;
};

/// Whether a stored reason is enough for an item of ISO/IEC 17025:2017, 7.8.2.1 ("7.8.2.1 h"). Laboratory, number,
/// dates of performance and issue, results and the person who authorises are what makes a certificate one, and what
/// scope and authorisation are held against: no reason replaces them.
[[nodiscard]] bool may_be_left_out(const std::string& clause);

/// "ISO/IEC 17025:2017, 7.8.2.1 e" from "7.8.2.1 e".
[[nodiscard]] std::string iso_17025(const std::string& clause);

/// "/standards/3/valid_to".
[[nodiscard]] std::string place_in(const std::string& list, std::size_t index, const std::string& key = "");

}  // namespace gumcert::certificate
