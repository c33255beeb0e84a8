#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/csv_table.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"
#include "jobs/statement_keys.h"

namespace gumcert::jobs {

/// A number, and the decimal text that it was written as.
struct WrittenNumber {
    double value = 0.0;
    std::string written;
};

/// Whether a value of a job is written as an angle with signs.
[[nodiscard]] bool is_angle_text(const nlohmann::json& value);

/// An angle in degrees, minutes and seconds, in a unit that has these parts.
/// \param unit  "" of limits in the unit of a specification, which are no angles
/// \return nothing when it was refused
[[nodiscard]] std::optional<WrittenNumber> angle_number(const std::string& written, const std::string& unit,
                                                        const std::string& where, ProblemList& problems);

/// The number of a cell, which may be such an angle.
/// \param unit  "" where it is none
[[nodiscard]] std::optional<WrittenNumber> number_in_cell(const CsvTable& table, std::size_t row, std::size_t column,
                                                          const std::string& unit, const std::string& name,
                                                          ProblemList& problems);

/// Decimals of the seconds, or of the minutes, with which such an angle is written; nothing of anything else.
/// \param value  may be null
[[nodiscard]] std::optional<int> decimals_of_angle(const nlohmann::json* value, const std::string& unit);

/// The numbers of a list, some of which may be such angles, and the most decimals of one of them.
struct WrittenNumbers {
    std::vector<double> values;
    int decimals = 0;
};
/// \return nothing where the list is missing or was refused
[[nodiscard]] std::optional<WrittenNumbers> numbers_in_list(const StatementKeys& keys, std::string_view key,
                                                            const std::string& unit);

/// The most decimals of such angles in a list; 0 where it has none.
[[nodiscard]] int decimals_of_angles(const nlohmann::json& list, const std::string& unit);

/// Whether values of one quantity are angles with signs, and the first number without them, which would be so many seconds
/// beside them. 0 is 0 in every unit.
class AngleNotation {
public:
    void see(const CsvTable& table, std::size_t column);
    /// A number or an angle, or an array of them.
    void see(const nlohmann::json& value, const JsonDocument& document, const std::string& pointer);
    /// \param of  "column phi"
    void refuse_mixture(const std::string& of, ProblemList& problems) const;

private:
    bool has_signs_ = false;
    std::string bare_, where_;
};

}  // namespace gumcert::jobs
