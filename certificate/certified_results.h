#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificate/certificate_data.h"
#include "certificate/point_tables.h"

namespace gumcert::certificate {

// What a certificate certifies, as tables of columns: HTML, PDF, text and DCC all print these texts, so that they
// cannot disagree. Made once, by reports/record/make/certificate; the record keeps it.

/// Decision on conformity of one value, with everything needed to check it by hand (JCGM 106:2012; ILAC-G8:09/2019).
/// Numbers are in the unit of the column.
struct Verdict {
    std::string specification;                                 ///< AgreedSpecification::id
    std::string rule;                                          ///< "DR-03"
    std::string formula;                                       ///< "AU = TU − U"
    std::optional<double> lower, upper;                        ///< tolerance limits TL, TU
    std::optional<double> acceptance_lower, acceptance_upper;  ///< AL, AU
    double guard_band = 0.0;                                   ///< w
    /// "pass", "fail", "conditional_pass", "conditional_fail", "undetermined", "not_applicable" (no value can pass, or
    /// the rule cannot be applied: `note`)
    std::string verdict;
    double conformance_probability = 0.0;              ///< p_c of this value
    double specific_risk = 0.0;                        ///< 1 − p_c where accepted, p_c where rejected
    std::optional<double> largest_specific_risk;       ///< at the acceptance limit, what the rule allows
    std::optional<double> false_accept, false_reject;  ///< global, where the rule rests on a population
    std::optional<double> test_uncertainty_ratio;
    std::string verdict_from_printed;  ///< the same decision from the printed numbers
    std::string note;                  ///< English sentence; "" without
    struct {
        std::string lower, upper, acceptance_lower, acceptance_upper, guard_band, conformance_probability,
            specific_risk, largest_specific_risk, false_accept, false_reject,
            test_uncertainty_ratio;  ///< risks in percent
    } printed;
};

struct CertifiedValue {
    double value = 0.0, u = 0.0;  ///< unrounded, in the unit of the column
    std::optional<double> U, k, nu_eff;
    std::optional<std::pair<double, double>> interval;  ///< Monte Carlo: what is printed in place of ± U
    std::string coverage = "student_t";                 ///< as Result::coverage
    /// printed; U is never below the capability. Low and high: of the interval
    std::string printed_value, printed_U, printed_k, printed_nu_eff, printed_low, printed_high;
    std::string printed_u;        ///< beside an interval; "" where the distribution has no variance
    std::string scope_entry;      ///< id of the scope entry that covers it; "" = outside of the accreditation
    std::string outside_because;  ///< English, for the findings; "" where it is inside
    /// How far outside, to tell the worst of many: by which share of its farther end a range was left. In no record.
    double outside_by = 0.0;
    std::optional<double> capability;  ///< U of the scope entry here, in the unit of the column
    std::string printed_capability;
    bool raised = false;  ///< printed_U is the capability, because U was smaller
    bool external = false;
    std::optional<Verdict> verdict;
};

/// Values of one quantity: one, or one a row of the table.
struct CertifiedColumn {
    std::string result;        ///< "l", "EXA": what ScopeEntry::results name
    LocalisedText name;        ///< for people; from the record, English where the record is
    std::string unit;          ///< UDUNITS-2: "um"
    std::string printed_unit;  ///< "µm"; "" for one
    std::vector<CertifiedValue> values;
};

struct CertifiedTable {
    /// "results" of a budget; "set_up", "error_motions", "reversal", "ranges", "axis_line", "positioning" of a
    /// rotary table: the wording has a name for each
    std::string id;
    struct Argument {
        std::string name;  ///< "angle", "point"
        std::string unit, printed_unit;
        std::vector<std::optional<double>> values;  ///< none: a name only
        std::vector<std::string> printed;
    };
    std::string section = {};              ///< of the job, by its name; "" where it has none
    std::optional<Argument> argument;      ///< none: every column has one value
    std::optional<TableLayout> layout;     ///< where the job says which columns are shown
    std::vector<CertifiedColumn> columns;  ///< all of the same length
};

enum class FindingSeverity { information, minor, major, critical };

/// Something that an assessor would remark. Critical ones block the issue of a certificate.
struct Finding {
    std::string id;      ///< stable: "R07-e", "X01", "D02" (docs/findings.md)
    std::string clause;  ///< "ISO/IEC 17025:2017, 7.8.2.1 e"
    FindingSeverity severity = FindingSeverity::major;
    std::string where;  ///< JSON pointer in the certificate data, or the name of a result
    std::string what, action;
};

/// Something that an amendment states otherwise than the certificate that it amends or replaces, as both print it.
struct Change {
    /// "value", "U", "limit_low", "verdict" … of a result; "cell" (a number) and "words" of another column at a point;
    /// "heading", "role", "stage", "title", "group" and "columns" of a table; "text", "number", "flag" (true or false) and
    /// "code" (one of some words) of the certificate data
    std::string kind;
    std::string where;          ///< name of the result or column with its point; JSON pointer in the certificate data
    std::string before, after;  ///< "" where one of the two states nothing; of a verdict its code
};

/// The part of a record that makes it a certificate.
struct Certificate {
    CertificateData data;
    Profile profile;  ///< as used
    std::vector<CertifiedTable> tables;
    std::vector<Finding> findings;
    bool blocked = false;               ///< a critical finding: documents are printed as drafts only
    bool symbol = false;                ///< the accreditation symbol may stand on it
    std::vector<Change> changes;        ///< against the record that the amendment names
    std::string amended_record_sha256;  ///< of the bytes of that record
    /// Number of the certificate that replaces or amends this one. Told when a document is printed again; in no record,
    /// because a record that was written does not change.
    std::string superseded_by = {};

    /// The sentences of an accreditation body that this certificate states. They speak of its accreditation: only where
    /// the symbol may stand.
    [[nodiscard]] std::span<const LocalisedText> sentences_of_the_body() const {
        return symbol ? std::span<const LocalisedText>(profile.first_page_sentences) : std::span<const LocalisedText>();
    }
};

}  // namespace gumcert::certificate
