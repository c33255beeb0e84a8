#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "jobs/csv_table.h"
#include "jobs/job_files.h"
#include "jobs/json_object.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "jobs/rotary_table/rotary_table_statement.h"

namespace gumcert::jobs {

// What the parts of the reader of rotary_table jobs share.

/// The job file, and where what is read goes.
struct RotaryTableReading {
    JobFiles& files;
    const JsonDocument& document;
    const JsonObject& root;
    ProblemList& problems;  ///< of the job file
    RotaryTableStatement& stated;

    [[nodiscard]] RotaryTableJob& job() const { return stated.job; }
};

/// Names in the order in which they first appear.
class NameList {
public:
    /// The index of a name, a new one if it was not there. The text must outlive the list.
    std::size_t index(std::string_view name) {
        const auto [entry, is_new] = indices_.try_emplace(name, names_.size());
        if (is_new) {
            names_.emplace_back(name);
        }
        return entry->second;
    }
    [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const {
        const auto found = indices_.find(name);
        return found == indices_.end() ? std::nullopt : std::optional{found->second};
    }
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] std::size_t size() const { return names_.size(); }

private:
    std::unordered_map<std::string_view, std::size_t> indices_;
    std::vector<std::string> names_;
};

/// The reflectors of the coordinates file.
struct FixtureNames {
    std::optional<CsvTable> table;
    NameList reflectors;
    bool is_whole = false;  ///< the file was accepted
};

/// Where the table was measured, or is to be: angles and stations of the lengths file, or those of a plan.
struct MeasuredPlaces {
    std::optional<CsvTable> table;  ///< that names the stations in its first column
    NameList stations;
    std::vector<std::size_t> first_row_of_station;
    std::vector<double> angles_deg;  ///< ascending, each once
    bool is_whole = false;           ///< what states them was accepted

    /// The index of an angle of another file.
    [[nodiscard]] std::optional<std::size_t> angle_index(double angle_deg) const;
    [[nodiscard]] std::string where_station_appears(std::size_t station) const;
};

/// "1 reflector", "2 reflectors"
[[nodiscard]] std::string counted(std::size_t count, const std::string& noun);

/// Refuses the second row of something that has one.
void refuse_repeated_name(const CsvTable& table, std::size_t row, std::size_t column, const std::string& what,
                          std::size_t first_line, ProblemList& problems);

}  // namespace gumcert::jobs
