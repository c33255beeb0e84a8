#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/input_text.h"
#include "jobs/problem_list.h"

namespace gumcert::jobs {

struct CsvLimits {
    std::size_t rows = 1'000'000;
};

/// One field of a table: its text without quotes, and the place of its first character.
struct CsvCell {
    std::string_view text;
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

/// What separates the fields of a table: what a first line "sep=;" states; else a semicolon where the first line that is not
/// blank has one and no comma outside of double quotes, as spreadsheets of countries with a decimal comma write it; else a
/// comma.
/// \param text  without byte order mark
[[nodiscard]] char csv_separator(std::string_view text);

/// A table with named columns from a CSV file (RFC 4180), read strictly.
///
/// Columns are asked for by number: the required ones first, then the optional ones, in the order in which the reader
/// was given them; their order in the file does not matter. Every typed reading puts what is wrong into the list of
/// problems that the table was read with, and returns nothing then. The list must outlive the table.
class CsvTable {
public:
    [[nodiscard]] std::size_t rows() const noexcept { return width_ == 0 ? 0 : cells_.size() / width_; }
    /// The columns that were asked for and are not there.
    [[nodiscard]] std::vector<std::string_view> missing_columns() const;
    /// Headers of the columns that nobody asked for; each was warned of.
    [[nodiscard]] std::span<const CsvCell> unused_columns() const noexcept { return unused_; }
    /// False when ragged rows were refused and left out.
    [[nodiscard]] bool is_complete() const noexcept { return is_complete_; }
    [[nodiscard]] bool has_column(std::size_t column) const { return positions_[column].has_value(); }
    /// The column must be there.
    [[nodiscard]] const CsvCell& cell(std::size_t row, std::size_t column) const;
    /// `lengths.csv:17:5`
    [[nodiscard]] std::string where(const CsvCell& cell) const;

    /// The whole cell as a number, by std::from_chars; a leading plus sign is accepted.
    [[nodiscard]] std::optional<double> number(std::size_t row, std::size_t column, const NumberRange& range) const;
    /// A number as it was written, with a decimal point and without a plus sign.
    [[nodiscard]] std::string number_text(std::size_t row, std::size_t column) const;
    /// Nothing when the column is absent or its cell is empty.
    [[nodiscard]] std::optional<double> number_if_any(std::size_t row, std::size_t column,
                                                      const NumberRange& range) const;
    [[nodiscard]] std::optional<std::int64_t> integer(std::size_t row, std::size_t column,
                                                      const NumberRange& range) const;
    /// A name: at most 256 bytes, no spaces around it, no control or hidden characters. Valid as long as the table.
    [[nodiscard]] std::optional<std::string_view> name(std::size_t row, std::size_t column) const;
    /// Which of a few words the cell is.
    [[nodiscard]] std::optional<std::size_t> choice(std::size_t row, std::size_t column,
                                                    std::span<const std::string_view> words) const;

private:
    friend std::optional<CsvTable> read_csv_table(std::string bytes, std::span<const std::string_view> required,
                                                  std::span<const std::string_view> optional, ProblemList& problems,
                                                  const CsvLimits& limits);
    CsvTable() = default;

    std::shared_ptr<const void> storage_;  ///< what the texts of the cells point into
    ProblemList* problems_ = nullptr;
    std::vector<std::string> names_;                     ///< of the columns asked for
    std::vector<std::optional<std::size_t>> positions_;  ///< of the columns asked for, in the file
    std::size_t width_ = 0;                              ///< columns of the file
    bool is_complete_ = true;
    bool decimal_comma_ = false;  ///< of its numbers; columns are separated by semicolons then
    std::vector<CsvCell> unused_;
    std::vector<CsvCell> cells_;  ///< row by row
};

/// Reads a table: UTF-8, LF or CRLF, comma, decimal point, a header with names, at least one row. Blank lines are
/// skipped, and so is a first line that states the separator (text::separator_line). Where columns are not separated by commas
/// (csv_separator), numbers may have decimal commas: all of them then.
///
/// A column that nobody asked for is a warning. Rows that are ragged are refused and left out of the table.
/// \return nothing when the text cannot be read as this table; with problems in single rows, the table *and* refusals
[[nodiscard]] std::optional<CsvTable> read_csv_table(std::string bytes, std::span<const std::string_view> required,
                                                     std::span<const std::string_view> optional, ProblemList& problems,
                                                     const CsvLimits& limits = {});

/// Reads a square matrix of numbers without a header. Semicolons may separate its columns, with decimal commas or points.
///
/// \param order  number of rows and columns that it must have, at least 1
/// \param unit   of its elements, for messages
/// \return order×order; nothing when anything was refused
[[nodiscard]] std::optional<Eigen::MatrixXd> read_csv_matrix(const std::string& bytes, std::size_t order,
                                                             std::string_view unit, ProblemList& problems);

}  // namespace gumcert::jobs
