#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/localised_text.h"
#include "text/angle_text.h"

namespace gumcert::certificate {

// Tables of points as certificates show them: what a point has beside its results, and which columns a table has.

/// What a quantity is to the reader of a certificate. The wording has a heading for each, the digital certificate a
/// name; "" says nothing.
inline constexpr std::array<std::string_view, 8> k_quantity_roles{
    "nominal", "setting", "reference", "indication", "measured_value", "error", "deviation", "correction"};
/// Before and after an adjustment; "" where nothing was adjusted.
inline constexpr std::array<std::string_view, 2> k_quantity_stages{"as_found", "as_left"};

/// Columns of points that state limits, in the order lower, upper, maximum permissible error.
inline constexpr std::array<std::string_view, 3> k_limit_columns{"limit_low", "limit_high", "mpe"};

/// One column of a table of points: words or numbers that belong to the points, no results.
struct PointColumn {
    std::string name;       ///< as the job has it: "range", "V_s"
    LocalisedText heading;  ///< empty: that of the role, else the name
    std::string role;       ///< of k_quantity_roles, or ""
    std::string stage;      ///< of k_quantity_stages, or ""
    std::string unit;       ///< UDUNITS-2; "" where the column has words, or limits in the unit of a specification
    std::string printed_unit;
    std::vector<std::optional<double>> values;  ///< one a point, in `unit`; none: a word
    std::vector<std::string> printed;           ///< one a point
    std::string decimals = {};  ///< "of_uncertainty": each value ends where its uncertainty does; "": as it was written
    std::string form = {};      ///< "sexagesimal": documents print the numbers in degrees, minutes and seconds
};

/// One column that a table shows.
struct ShownColumn {
    /// "point", "column" (`of` is a PointColumn), or of the result `of`: "value", "U", "k", "nu_eff", "limit",
    /// "limit_low", "limit_high", "verdict"
    std::string show;
    std::string of;
    LocalisedText heading;  ///< empty: that of what is shown
    std::string role, stage;
    std::string form = {};  ///< of a "value", as that of PointColumn
};

/// What a job wants of one table of the certificate.
struct TableRequest {
    /// Unit of numbers in one group of rows.
    struct GroupUnit {
        std::string group;  ///< word of the column `group_by`
        std::string of;     ///< column or result; "": all of this kind of quantity
        std::string unit;   ///< UDUNITS-2
    };
    /// Rows of the table: those that have this word in a column.
    struct RowChoice {
        std::string column, is;
    };
    std::string section = {};  ///< whose points it shows; "" in a job without sections
    LocalisedText title;       ///< empty: that of results
    std::string group_by;      ///< column with words; "": one group
    std::vector<RowChoice> where;
    std::vector<GroupUnit> units;
    std::vector<ShownColumn> columns;
    std::string plot = {};  ///< "": one of each group of rows; "none"
};

/// The points of a job, what they have beside their results, and the tables that show them.
struct PointTable {
    std::vector<std::string> points;  ///< their names
    std::vector<PointColumn> columns;
    std::vector<TableRequest> tables;
};

/// How a certified table shows one group of points.
struct TableLayout {
    LocalisedText title;          ///< empty: that of results
    LocalisedText group_heading;  ///< of the column that groups the rows; empty: none
    std::string group_role;
    std::string group;                 ///< what all rows have there
    std::vector<PointColumn> columns;  ///< values of the rows, in the units of this group
    std::vector<ShownColumn> shown;
    std::string plot = {};  ///< as TableRequest::plot
};

/// Whether a role says that a result is an error, a deviation or a correction: small beside the quantity that it is one of.
[[nodiscard]] bool is_role_of_difference(std::string_view role);

// Angles that documents print as 12° 30′ 05.0″. Records, digital certificates and whatever computes have the decimal number in
// the unit of the column; a number is rounded there, at the digit of U, and its parts are those of the rounded number.

inline constexpr std::string_view k_sexagesimal = "sexagesimal";

/// The last part of angles in a unit: seconds of `arcsec`, minutes of `arcmin`; nothing of any other unit.
[[nodiscard]] std::optional<text::AnglePart> last_part_of(const std::string& unit);

/// A number as documents print it. One that ends above its last part, 2.3E+5, keeps its power of ten, and its unit behind it.
/// \param printed  of the record
/// \param form     "" or k_sexagesimal, which stands for what it says in a unit that has parts alone
[[nodiscard]] std::string in_form(const std::string& printed, const std::string& form, const std::string& unit);
/// Its unit, beside the number or in the head of its column: "" where the number has the signs itself.
[[nodiscard]] std::string unit_in_form(const std::string& printed_unit, const std::string& form,
                                       const std::string& unit);

/// A cell of a column of points; words as they are.
[[nodiscard]] std::string shown_cell(const PointColumn& column, std::size_t row);
[[nodiscard]] std::string shown_unit(const PointColumn& column);

struct CertifiedTable;
struct CertifiedColumn;
/// The column in which a table shows the values of a result; none where it has no layout, or does not show them.
[[nodiscard]] const ShownColumn* column_of_values(const CertifiedTable& table, const std::string& result);
/// The form in which a table shows the values of a result; "" where it has no layout.
[[nodiscard]] std::string form_of_result(const CertifiedTable& table, const std::string& result);
/// A value of a result, or a limit of it, as its table shows it: in_form() of what the table says.
[[nodiscard]] std::string value_as_shown(const CertifiedTable& table, const CertifiedColumn& column,
                                         const std::string& printed);
/// Its unit: unit_in_form() of what the table says. U and u are numbers of the unit of the column.
[[nodiscard]] std::string unit_of_values(const CertifiedTable& table, const CertifiedColumn& column);

}  // namespace gumcert::certificate
