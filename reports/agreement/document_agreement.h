#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "certificate/certified_results.h"
#include "reports/agreement/document_facts.h"
#include "reports/agreement/document_words.h"
#include "reports/agreement/numbers_as_printed.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// A document as text, and what of it differs from its record.
///
/// Compared is what a certificate certifies: each printed value with its U or interval, as signed decimals with their exponents,
/// in the order in which every version and template prints them; the units of each table; each verdict behind its value; whose
/// certificate it is; and that no mark says that it is something else. Of other numbers, and of texts, nothing is asked:
/// templates and languages are the business of the laboratory. A number that is right in one place may be wrong in another.
class PrintedDocument {
public:
    /// \param pages  of a PDF as of drawn_texts_of_pages(); of a page of HTML its text in one piece
    explicit PrintedDocument(const std::vector<std::string>& pages);

    /// \return what is missing or too much, for a message; "" where document and record agree
    [[nodiscard]] std::string disagreement_with(const certificate::Certificate& certificate,
                                                const DocumentWords& words) const;
    /// Of a report without certified results, such as that of a comparison: the numbers of its tables, as it is made now.
    [[nodiscard]] std::string disagreement_with_report(const nlohmann::json& view, const DocumentWords& words) const;

    /// The digits of all numbers of a view: of tables, sentences and what is told beside its name.
    [[nodiscard]] std::string disagreement_with_view(const nlohmann::json& view) const;
    [[nodiscard]] bool names_other_templates(const DocumentWords& words) const;
    [[nodiscard]] bool has_head_of_archive(const DocumentWords& words) const;
    /// \return which page does not say that it is this page of so many; "" where all do, in some language
    [[nodiscard]] std::string disagreement_with_pages(const DocumentWords& words) const;
    /// Of texts that say whose certificate it is, those that the document as it is made now prints.
    [[nodiscard]] std::string disagreement_with_facts(const std::vector<DocumentFact>& facts,
                                                      const PrintedDocument& made_now) const;
    /// Whether a text stands in it, and is no part of a longer word or number. Blanks and hyphens may be set otherwise.
    [[nodiscard]] bool says(const std::string& text) const;

private:
    std::vector<std::string> pages_;
    std::string text_;                      // without blanks and hyphens; a line end between pages
    std::string digits_;                    // of it; a blank between pages
    std::vector<std::size_t> places_;       // of each digit in text_
    std::vector<std::size_t> read_places_;  // of each byte of text_ in read_
    std::string read_;                      // as the document has it
    struct Cell;
    struct Row;
    [[nodiscard]] const DocumentWords::Mark* mark_of(const std::vector<DocumentWords::Mark>& marks) const;
    [[nodiscard]] std::string mark_on(const DocumentWords& words) const;
    [[nodiscard]] bool is_at(std::size_t digit, const Cell& cell) const;
    [[nodiscard]] bool has(const Row& row, const std::vector<Cell>& numbers, const DocumentWords& words,
                           std::size_t& from) const;
    [[nodiscard]] bool has_in_parts(const Row& row, const DocumentWords& words) const;
    [[nodiscard]] bool has_units(std::size_t first, std::size_t end, const std::vector<Cell>& numbers,
                                 bool may_stand_behind, std::size_t rows_above) const;
    [[nodiscard]] bool has_unit_at(const std::string& unit, std::size_t begin) const;
    [[nodiscard]] std::size_t read_place_of_digit(std::size_t digit) const;
    [[nodiscard]] static Cell cell_of(const std::string& printed, const std::string& unit);
    [[nodiscard]] static Row row_of(const std::string& name, const std::vector<std::string>& printed, std::size_t gap,
                                    const std::string& unit);
    [[nodiscard]] static std::vector<Row> rows_of(const certificate::CertifiedTable& table);
    [[nodiscard]] bool is_followed_by(std::size_t digit, const Row& row, const DocumentWords& words) const;
};

/// \return the first words in which two texts differ, for a message; "" where they have the same words
[[nodiscard]] std::string difference_of_texts(std::string_view stated, std::string_view expected,
                                              std::string_view verb = "says ");

/// Whether a page of HTML says that it is the certificate with this number: as a word of its own, in the head of the pages
/// where it has one.
[[nodiscard]] bool says_number(std::string_view html, const std::string& number);

}  // namespace gumcert::reports
