#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "jobs/csv_table.h"
#include "jobs/problem_list.h"

namespace gumcert::jobs {

/// A number, and the decimal text that it was written as.
struct WrittenNumber {
    double value = 0.0;
    std::string written;
};

/// Whether a value of a job is written as an angle with signs.
[[nodiscard]] bool is_angle_text(const nlohmann::json& value);

/// An angle in degrees, minutes and seconds, in a unit that has these parts.
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

/// Refuses a number without signs in a column of angles with signs, which would be so many seconds. 0 is 0 in every unit.
void refuse_bare_numbers(const CsvTable& table, std::size_t column, const std::string& name, ProblemList& problems);

}  // namespace gumcert::jobs
