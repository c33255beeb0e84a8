#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "certificate/certified_results.h"

namespace gumcert::certificate {

/// What is wrong with one value of a column. Table and column live as long as this.
struct FoundInRow {
    const CertifiedTable* table = nullptr;
    const CertifiedColumn* column = nullptr;
    std::size_t row = 0;
    Finding finding;       ///< its place is not read
    double badness = 0.0;  ///< among findings of one cause; the larger, the worse
};

/// Words behind the number of values that have one thing in common.
struct CountedAs {
    std::string one = {}, many = {};
};

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
    /// finding gives it, and has the severity that is left: `severity_of_omission`.
    /// \param letter  "a" … "p"
    void item(FindingSeverity severity, char letter, const std::string& where, const std::string& what,
              const std::string& action);

    void append(std::vector<Finding> findings);

    /// What was found of values, one by one: one finding a cause, which lists its results and points. Findings have one
    /// cause where they say the same but for their numbers; those of the worst are told, and how many there are.
    /// \param counted  what stands between the number of values and what is wrong with them; empty: no number
    void add_by_cause(const std::vector<FoundInRow>& of_values, const CountedAs& counted = {});

    /// Of findings that say the same of many points, the gravest, and the first of equals. None where there are none.
    /// \return whether there was one
    bool add_gravest(const std::vector<Finding>& of_points);

    [[nodiscard]] std::vector<Finding> take() { return std::exchange(findings_, {}); }

private:
    const CertificateData& data_;
    std::vector<Finding> findings_;
};

/// Whether a stored reason is enough for an item of ISO/IEC 17025:2017, 7.8.2.1 ("7.8.2.1 h"). Laboratory, number,
/// method, item, dates of performance and issue, results and the person who authorises are what makes a certificate
/// one, and what scope and authorisation are held against: no reason replaces them.
[[nodiscard]] bool may_be_left_out(const std::string& clause);

/// What an omission with a reason still is: major where customer or provider are not named (e, p), minor for place and
/// deviations (c, n), else an information.
[[nodiscard]] FindingSeverity severity_of_omission(const std::string& clause);

/// The last day of the performance.
[[nodiscard]] const std::string& last_day(const Dates& dates);

/// What the dates of a standard that the certificate lists say against its use: T01, T02, T05.
void validity_of_standard(FindingList& found, const StandardUsed& standard, std::size_t i, const Dates& dates);

/// Whether an accredited certificate is authorised by somebody who is none of the signatories that it names.
[[nodiscard]] bool is_authorised_by_no_signatory(const CertificateData& data);

/// Whether a result of the certificate has one of the names of a scope, a specification …
[[nodiscard]] bool names_a_result(const Certificate& certificate, const std::vector<std::string>& names);

/// Those of the names that no result of the certificate has.
[[nodiscard]] std::vector<std::string> names_of_no_result(const Certificate& certificate,
                                                          const std::vector<std::string>& names);

/// Names of the results of a certificate in quotes, each once: of all points, where there is a table of them; and each
/// point by itself, "E[10 mm]", where one of the names that were meant is that of a point.
[[nodiscard]] std::vector<std::string> result_names(const Certificate& certificate,
                                                    const std::vector<std::string>& meant);

/// "ISO/IEC 17025:2017, 7.8.2.1 e" from "7.8.2.1 e".
[[nodiscard]] std::string iso_17025(const std::string& clause);

/// What is wrong with a name that does not count as stated, and what to do. Where nothing was given, `missing` and
/// `action`; else that what was given is taken for a placeholder: nobody should look for what is there.
[[nodiscard]] std::string what_of_name(const std::string& given, const std::string& missing);
[[nodiscard]] std::string action_of_name(const std::string& given, const std::string& action);

/// "/standards/3/valid_to".
[[nodiscard]] std::string place_in(const std::string& list, std::size_t index, const std::string& key = "");

}  // namespace gumcert::certificate
