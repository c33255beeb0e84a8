#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// Words of documents, in every language that the templates have.
struct DocumentWords {
    std::vector<std::pair<std::string, std::string>> verdicts;  ///< as printed; code: "pass". The longest first
    struct Mark {
        std::string text;            ///< "SUPERSEDED by {number}"
        std::string before, behind;  ///< of the value that is filled in, as printed
    };
    /// What says that a document is no issued certificate, of every kind and state that the wording knows: a draft, a
    /// specimen, superseded, internal, an audit.
    std::vector<Mark> marks;
};
/// \throws gum::StorageError  if the wording is missing or damaged
[[nodiscard]] DocumentWords document_words(const std::filesystem::path& templates);

/// A document as text, and what of it differs from its record.
///
/// Compared is what a certificate certifies: each printed value with its U or interval, in the order in which every version
/// and template prints them, each verdict behind its value, and that no mark says that it is something else. Of other numbers, and of
/// texts, nothing is asked: templates and languages are the business of the laboratory.
class PrintedDocument {
public:
    /// \param pages  of a PDF as of reports::texts_of_pages(); of a page of HTML its text in one piece
    explicit PrintedDocument(const std::vector<std::string>& pages);

    /// \return what is missing or too much, for a message; "" where document and record agree
    [[nodiscard]] std::string disagreement_with(const certificate::Certificate& certificate,
                                                const DocumentWords& words) const;
    /// Of a report without certified results, such as that of a comparison: the numbers of its tables, as it is made now.
    [[nodiscard]] std::string disagreement_with_report(const nlohmann::json& view, const DocumentWords& words) const;

private:
    std::vector<std::string> pages_;
    std::string text_;                 // without blanks and hyphens; a line end between pages
    std::string digits_;               // of it; a blank between pages
    std::vector<std::size_t> places_;  // of each digit in text_
    struct Row;
    [[nodiscard]] std::string mark_on(const DocumentWords& words) const;
    [[nodiscard]] bool has(const Row& row, const std::vector<std::string>& numbers, const DocumentWords& words,
                           std::size_t& from) const;
    [[nodiscard]] bool has_in_parts(const Row& row, const DocumentWords& words) const;
    [[nodiscard]] static Row row_of(const std::string& name, const std::vector<std::string>& cells, std::size_t gap);
    [[nodiscard]] static std::vector<Row> rows_of(const certificate::CertifiedTable& table);
    [[nodiscard]] bool is_followed_by(std::size_t digit, const Row& row, const DocumentWords& words) const;
};

/// Whether a page of HTML says that it is the certificate with this number: as a word of its own, in the head of the pages
/// where it has one.
[[nodiscard]] bool says_number(std::string_view html, const std::string& number);

/// Holds the results of a digital certificate against those of the one that the record gives now: values, units, U,
/// intervals and conformity. Names and order are free.
/// \return as PrintedDocument::disagreement_with()
/// \throws gum::InputError  if it cannot be read
[[nodiscard]] std::string disagreement_of_dcc(std::string_view bytes, const std::string& name,
                                              std::string_view made_of_record);

}  // namespace gumcert::app
