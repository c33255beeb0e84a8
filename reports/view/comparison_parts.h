#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

// What the sections of comparison reports share.

constexpr std::size_t k_most_rows = 200;       ///< of a table of results; beyond it, those with signals only
constexpr std::size_t k_most_unrounded = 100;  ///< of the table of unrounded numbers; beyond it, the files have them
constexpr std::size_t k_most_detailed = 24;    ///< items with a section of their own

/// A printed number with its unit as people write it; empty where there is no number.
[[nodiscard]] Text printed_quantity(const Wording& words, const std::string& printed, const std::string& unit);

/// A table without the columns that have no text in any row; nothing where there are no rows.
void table_of_filled_columns(CertificateBuilder& builder, const std::string& id, const Text& caption,
                             const std::vector<Column>& columns, const Rows& rows);

/// A figure; nothing where the plot has nothing to draw.
void figure_if_any(CertificateBuilder& builder, const std::string& id, const Text& caption, const Text& description,
                   const std::string& drawing);

/// Rows that a table shows: all, or of more than `most` those with a signal, the largest of these where they are too
/// many. Positions in ascending order.
/// \param weights  one a row: 0 without a signal, else how much it matters
[[nodiscard]] std::vector<std::size_t> shown_rows(const std::vector<double>& weights, std::size_t most);

/// Says which rows a table shows, where it does not show all.
void say_what_is_shown(CertificateBuilder& builder, const Wording& words, const std::vector<double>& weights,
                       std::size_t shown);

/// Sources that two results, or two methods, share; nothing where there are none.
void shared_sources_table(CertificateBuilder& builder, const Wording& words, const Comparison& comparison);

/// What the record remarks on the comparison; nothing where it has no remarks.
void remarks_section(CertificateBuilder& builder, const Wording& words, const Comparison& comparison);

/// That expanded uncertainties of differences, U(D), are those of E_n, with the coverage probability of the scores: where U(x)
/// beside them is for another one.
void add_probability_of_differences(Facts& facts, const Wording& words, const Comparison& comparison);

/// The first names of a list with the number of the others: "A, B, C and 17 more".
[[nodiscard]] Text some_of(const Wording& words, const std::vector<std::string>& names);

/// A number of the record without a printed text: all its digits, so that it reads back as the same number.
[[nodiscard]] std::string unrounded(const std::optional<double>& v);

}  // namespace gumcert::reports
