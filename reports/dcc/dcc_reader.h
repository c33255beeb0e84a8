#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/xml_document.h"

namespace gumcert::reports {

/// A number of a foreign certificate with its uncertainty; digits as they stand in the document.
struct ImportedNumber {
    std::string value;
    std::string d_si_unit;              ///< "\milli\metre"
    std::string unit;                   ///< UDUNITS-2; "" where the unit has no equivalent: a remark says so
    std::string kind = "none";          ///< "expanded", "standard", "coverage_interval", "none"
    std::string U, k, p, u, low, high;  ///< "" where absent
    std::string distribution;
    std::string label;  ///< si:label: the symbol of the quantity; "" without
    /// Why the statement of uncertainty must not be used: "" where it may. It is stated as NaN; two statements (of the
    /// old and the new notation, say) contradict each other; k is not one that its p can have.
    std::string objection;
};

/// One number of a foreign certificate, ready to be an input of a budget. Where the document states the same number in
/// several units, this is the first of those that have an uncertainty (else the first); the others are in `also`.
struct ImportedQuantity : ImportedNumber {
    std::string name;    ///< unique in the document, made from quantity, result and row: a name of the job language
    std::string column;  ///< `name` without the number of the row
    std::string symbol;  ///< that `column` is made from: quantities of several tables may share it
    std::string result, quantity;  ///< names as the document gives them (first language)
    std::string result_name;       ///< of `result`, a beginning of names of the job language; "" where it gives none
    std::string ref_type, id;      ///< attributes; "" without
    /// What the number is part of: "result", "influence_condition", "meta_data" (limits, nominal values …),
    /// "statement", "equipment", "method", "item", "location"
    std::string role = "result";
    std::optional<std::size_t> row;  ///< in a list, from 0
    /// What the number is about, where the document has several items and refers to one: in ImportedCertificate::items
    std::optional<std::size_t> about;
    /// By dcc:status of its influence conditions, or of those of what it is part of; none: it does not say.
    std::optional<bool> before_adjustment;
    std::size_t table = 0;  ///< quantities of one dcc:list share a number; 0 outside of any
    std::vector<ImportedNumber> also;
    std::string remark;
    /// Whether the issuer says that it is inside of its accreditation (basic_isInCMC); none: it says nothing
    std::optional<bool> in_scope;
    /// dcc:conformity of its row ("pass", "fail", "conditionalPass" …), the first that is not "noPass"; "" without one
    std::string conformity;
    std::string conformity_id;           ///< refId of it: the statement with the decision rule
    std::string conformity_declaration;  ///< what is declared beside it, in English where it is
};

/// Whether two numbers may belong together: not where one was found before an adjustment and the other after it.
[[nodiscard]] bool may_be_of_one_stage(const std::optional<bool>& before_adjustment, const std::optional<bool>& other);

/// A column of words beside columns of numbers, such as the names of the points.
struct ImportedWords {
    std::size_t table = 0;  ///< as ImportedQuantity::table
    std::string quantity;
    std::vector<std::string> words;  ///< one a row
    std::optional<bool> before_adjustment;
};

/// An item of a certificate, or a piece of a set.
struct ImportedItem {
    std::string id;  ///< attribute
    std::string name;
    std::vector<std::string> identifications;  ///< "Serial number 40210": as they are called, and their values
};

struct ImportedCertificate {
    std::string schema_version;  ///< "3.3.0"
    std::string identifier, laboratory, item, issued, performed_from, performed_to;
    std::string sha256;  ///< of the file
    /// "draft", "specimen" or "superseded document" where the document says that it is one, else ""
    std::string state;
    std::vector<ImportedItem> items;  ///< those with an id, pieces of sets among them
    std::vector<ImportedQuantity> quantities;
    std::vector<ImportedWords> words;
    std::vector<gum::Diagnostic> remarks;
};

/// Reads a DCC of version 3.0 to 3.3: every number with its uncertainty, in the spellings of D-SI 1.3 to 2.2.1.
/// \param file  for messages
/// \throws gum::InputError  GC-DCC-0001 … -0004 as read_xml(), -0004 also for more than 100 000 numbers, -0005 another
///                          root element, -0006 another version
[[nodiscard]] ImportedCertificate read_dcc(std::string_view bytes, const std::string& file);

/// A DCC that was parsed once, for whoever looks at more of it than its numbers.
struct ParsedDcc {
    std::string bytes;
    XmlElement root;
    ImportedCertificate certificate;
};

/// read_dcc(), with the elements that it was read from.
/// \throws gum::InputError  as read_dcc()
[[nodiscard]] ParsedDcc parse_dcc(std::string bytes, const std::string& file);

}  // namespace gumcert::reports
