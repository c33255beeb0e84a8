#include "jobs/rotary_table/rotary_table_reading.h"

#include <algorithm>
#include <cmath>

#include "jobs/rotary_table/rotary_table_limits.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

std::optional<std::size_t> MeasuredPlaces::angle_index(double angle_deg) const {
    const auto found = std::lower_bound(angles_deg.begin(), angles_deg.end(), angle_deg - k_same_angle_deg);
    if (found == angles_deg.end() || std::abs(*found - angle_deg) > k_same_angle_deg) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - angles_deg.begin());
}

std::string MeasuredPlaces::where_station_appears(std::size_t station) const {
    return table->where(table->cell(first_row_of_station[station], 0));
}

std::string counted(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void refuse_repeated_name(const CsvTable& table, std::size_t row, std::size_t column, const std::string& what,
                          std::size_t first_line, ProblemList& problems) {
    const CsvCell& cell = table.cell(row, column);
    problems.refuse(k_repeated_name, table.where(cell),
                    "the " + what + " " + text::in_quotes(cell.text) + " has a second row, the first is line " +
                        std::to_string(first_line),
                    "every " + what + " has one row", "remove or rename one of the two");
}

}  // namespace gumcert::jobs
