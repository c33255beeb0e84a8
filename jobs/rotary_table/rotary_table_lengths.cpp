#include "jobs/rotary_table/rotary_table_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "gum/quantity/units.h"
#include "jobs/rotary_table/rotary_table_layout.h"
#include "jobs/rotary_table/rotary_table_limits.h"
#include "jobs/rotary_table/rotary_table_rounding.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using gum::k_millimetre;

constexpr std::size_t k_least_of_station = 4;  // a station has x, y, z and a dead path
// A displayed length is counted from where the beam was made; with its dead path it is a distance. It may be negative.
constexpr NumberRange k_length{
    .low = -100'000.0, .high = 100'000.0, .unit = "mm", .hint = "check the unit: lengths are in millimetres"};
// From any origin: the beginning of the day, of the measurement, or of the epoch of a data logger.
constexpr NumberRange k_time{.low = -1e11, .high = 1e11, .unit = "s", .hint = "check the unit: times are in seconds"};

enum LengthsColumn : std::size_t {
    c_station,
    c_reflector,
    c_pass,
    c_direction,
    c_angle,
    c_length,
    c_dead_path,
    c_time
};

/// A row of the lengths file that could be read.
struct LengthsRow {
    std::size_t table_row = 0;
    std::size_t station = 0;
    std::size_t reflector = 0;  ///< of the lengths file
    std::size_t pass = 0;
    std::size_t dead_path = 0;
    std::size_t direction = 0;  ///< 0 for +, 1 for -
    double angle_deg = 0.0;
    double length_mm = 0.0;
    std::size_t angle = 0;  ///< of the measurement
    double time = 0.0;      ///< [s], where the file has times
};

class LengthsReader {
public:
    LengthsReader(const RotaryTableReading& reading, const FixtureNames& fixture)
        : reading_(reading), fixture_(fixture) {}

    MeasuredPlaces read(JobFiles::File&& file) {
        static constexpr std::array<std::string_view, 7> k_columns{"station",   "reflector", "pass",     "direction",
                                                                   "angle_deg", "length_mm", "dead_path"};
        static constexpr std::array<std::string_view, 2> k_directions{"+", "-"};
        static constexpr std::array<std::string_view, 1> k_more_columns{"time_s"};
        places_.table = read_csv_table(std::move(file.bytes), k_columns, k_more_columns, *file.problems);
        if (!places_.table) {
            return std::move(places_);
        }
        const CsvTable& table = *places_.table;
        ProblemList& problems = *file.problems;
        std::vector<LengthsRow> rows;
        rows.reserve(table.rows());
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const auto station = table.name(i, c_station);
            const auto reflector = table.name(i, c_reflector);
            const auto pass = table.name(i, c_pass);
            const auto direction = table.choice(i, c_direction, k_directions);
            const auto angle = table.number(i, c_angle, k_angle);
            const auto length = table.number(i, c_length, k_length);
            const auto dead_path = table.name(i, c_dead_path);
            const auto time = table.has_column(c_time) ? table.number(i, c_time, k_time) : std::optional(0.0);
            if (station && reflector && pass && direction && angle &&
                is_excluded(
                    {*station, *reflector, *pass, k_directions[*direction], *angle, table.cell(i, c_station).line})) {
                continue;
            }
            if (station) {
                // Also of a row with another problem: else its station would be missing elsewhere, too.
                places_.stations.index(*station);
            }
            if (station && reflector && pass && direction && angle && length && dead_path && time) {
                rows.push_back({i, places_.stations.index(*station), reflectors_.index(*reflector),
                                passes_.index(*pass), dead_paths_.index(*dead_path), *direction, *angle, *length, 0,
                                *time});
            }
        }
        refuse_idle_exclusions();
        if (rows.empty() && problems.refusals() == 0) {
            problems.refuse(k_bad_exclusion, reading_.root.where("exclude"), "every distance is left out",
                            "a measurement has distances", "leave some in");
        }
        places_.is_whole = problems.refusals() == 0;
        places_.first_row_of_station.assign(places_.stations.size(), 0);
        for (std::size_t i = table.rows(); i-- > 0;) {
            if (const auto known = places_.stations.find(table.cell(i, c_station).text)) {
                places_.first_row_of_station[*known] = i;
            }
        }
        find_angles(rows);
        check_reflectors(rows, problems);
        check_passes(rows, problems);
        check_dead_paths(rows, problems);
        check_repeated(rows, problems);
        // What follows counts rows or compares all of them: rows that were refused above would be missed twice.
        if (places_.is_whole) {
            check_counts(rows, problems);
            check_units_and_span(rows, problems);
        }
        store_lengths(rows);
        if (places_.is_whole) {
            check_rounding(reading_);
        }
        return std::move(places_);
    }

private:
    const RotaryTableReading& reading_;
    const FixtureNames& fixture_;
    MeasuredPlaces places_;
    NameList reflectors_;  ///< of the lengths file
    NameList passes_;
    NameList dead_paths_;

    /// Counts the distance for the first entry that names it.
    bool is_excluded(const ExclusionKeys& distance) {
        bool excluded = false;
        for (std::size_t i = 0; i < reading_.job().exclusions.size(); ++i) {
            if (selects(reading_.job().exclusions[i], distance)) {
                reading_.job().exclusions[i].count += excluded ? std::size_t{0} : std::size_t{1};
                excluded = true;
            }
        }
        return excluded;
    }

    void refuse_idle_exclusions() const {
        for (const Exclusion& exclusion : reading_.job().exclusions) {
            if (exclusion.count == 0) {
                reading_.problems.refuse(
                    k_bad_exclusion, exclusion.where,
                    "no distance of the lengths file agrees with it that an entry before it does not "
                    "leave out",
                    "an entry of \"exclude\" leaves out at least one distance", "correct it, or remove it");
            }
        }
    }

    void find_angles(std::vector<LengthsRow>& rows) {
        std::vector<double> all;
        all.reserve(rows.size());
        std::transform(rows.begin(), rows.end(), std::back_inserter(all),
                       [](const LengthsRow& row) { return row.angle_deg; });
        std::sort(all.begin(), all.end());
        for (const double angle : all) {
            if (places_.angles_deg.empty() || angle - places_.angles_deg.back() > k_same_angle_deg) {
                places_.angles_deg.push_back(angle);
            }
        }
        for (LengthsRow& row : rows) {
            const auto above = std::upper_bound(places_.angles_deg.begin(), places_.angles_deg.end(), row.angle_deg);
            row.angle = static_cast<std::size_t>(above - places_.angles_deg.begin()) - 1;
        }
    }

    [[nodiscard]] std::string where(const LengthsRow& row, LengthsColumn column) const {
        return places_.table->where(places_.table->cell(row.table_row, column));
    }

    [[nodiscard]] std::string line_of(const LengthsRow& row) const {
        return "line " + std::to_string(places_.table->cell(row.table_row, c_station).line);
    }

    void check_reflectors(const std::vector<LengthsRow>& rows, ProblemList& problems) const {
        if (!fixture_.is_whole) {
            return;
        }
        std::vector<std::size_t> count(reflectors_.size(), 0);
        std::vector<const LengthsRow*> first(reflectors_.size(), nullptr);
        for (const LengthsRow& row : rows) {
            if (count[row.reflector]++ == 0) {
                first[row.reflector] = &row;
            }
        }
        const std::vector<std::string>& fixture_names = fixture_.reflectors.names();
        const std::vector<std::string_view> known(fixture_names.begin(), fixture_names.end());
        for (std::size_t i = 0; i < count.size(); ++i) {
            const std::string& name = reflectors_.names()[i];
            if (fixture_.reflectors.find(name)) {
                continue;
            }
            const std::optional<std::string_view> nearest = nearest_word(name, known);
            problems.refuse(k_unknown_reflector, where(*first[i], c_reflector),
                            "the reflector " + text::in_quotes(name) + " (" + counted(count[i], "row") +
                                ") is not in the fixture file",
                            "every reflector has coordinates in the fixture file",
                            nearest ? "is it " + text::in_quotes(*nearest) + "? Else add it to the fixture file"
                                    : "add it to the fixture file, or remove its rows");
        }
        for (std::size_t i = 0; i < fixture_names.size(); ++i) {
            if (!reflectors_.find(fixture_names[i])) {
                problems.warn(
                    k_warn_unused_reflector, text::visible(problems.file()),
                    "the reflector " + text::in_quotes(fixture_names[i]) + " of the fixture file has no distance",
                    "reflectors are measured", "check that no rows are missing");
            }
        }
    }

    void check_passes(const std::vector<LengthsRow>& rows, ProblemList& problems) const {
        std::vector<const LengthsRow*> first(passes_.size(), nullptr);
        std::vector<bool> told(passes_.size(), false);
        static constexpr std::array<const char*, 2> k_signs{"+", "-"};
        for (const LengthsRow& row : rows) {
            const LengthsRow*& other = first[row.pass];
            if (other == nullptr) {
                other = &row;
                continue;
            }
            const bool same_station = other->station == row.station;
            if (told[row.pass] || (same_station && other->direction == row.direction)) {
                continue;
            }
            told[row.pass] = true;
            const std::string pass = "the pass " + text::in_quotes(passes_.names()[row.pass]);
            if (!same_station) {
                problems.refuse(k_pass_of_two_stations, where(row, c_pass),
                                pass + " has station " + text::in_quotes(places_.stations.names()[row.station]) +
                                    " here and " + text::in_quotes(places_.stations.names()[other->station]) + " in " +
                                    line_of(*other),
                                "a pass belongs to one station", "give every pass a name of its own");
            } else {
                problems.refuse(k_pass_of_two_directions, where(row, c_pass),
                                pass + " has direction " + k_signs[row.direction] + " here and " +
                                    k_signs[other->direction] + " in " + line_of(*other),
                                "a pass has one direction of approach", "give every pass a name of its own");
            }
        }
    }

    void check_dead_paths(const std::vector<LengthsRow>& rows, ProblemList& problems) const {
        std::vector<const LengthsRow*> first(dead_paths_.size(), nullptr);
        std::vector<bool> told(dead_paths_.size(), false);
        for (const LengthsRow& row : rows) {
            const LengthsRow*& other = first[row.dead_path];
            if (other == nullptr) {
                other = &row;
            } else if (other->station != row.station && !told[row.dead_path]) {
                told[row.dead_path] = true;
                problems.refuse(k_dead_path_of_two_stations, where(row, c_dead_path),
                                "the dead path " + text::in_quotes(dead_paths_.names()[row.dead_path]) +
                                    " has station " + text::in_quotes(places_.stations.names()[row.station]) +
                                    " here and " + text::in_quotes(places_.stations.names()[other->station]) + " in " +
                                    line_of(*other),
                                "a dead path belongs to one station", "give every station dead paths of its own");
            }
        }
    }

    void check_repeated(const std::vector<LengthsRow>& rows, ProblemList& problems) const {
        const auto key = [&](const LengthsRow* row) {
            return std::tuple(row->station, row->reflector, row->pass, row->angle);
        };
        std::vector<std::pair<decltype(key(nullptr)), const LengthsRow*>> sorted;
        sorted.reserve(rows.size());
        for (const LengthsRow& row : rows) {
            sorted.emplace_back(key(&row), &row);
        }
        std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::pair<const LengthsRow*, const LengthsRow*>> repeated;  // second one, first one
        const LengthsRow* first = nullptr;
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            if (i > 0 && sorted[i].first == sorted[i - 1].first) {
                repeated.emplace_back(sorted[i].second, first);
            } else {
                first = sorted[i].second;
            }
        }
        std::sort(repeated.begin(), repeated.end(),
                  [](const auto& a, const auto& b) { return a.first->table_row < b.first->table_row; });
        for (const auto& [row, earlier] : repeated) {
            problems.refuse(k_repeated_length, where(*row, c_station),
                            "the distance of station " + text::in_quotes(places_.stations.names()[row->station]) +
                                ", reflector " + text::in_quotes(reflectors_.names()[row->reflector]) + ", pass " +
                                text::in_quotes(passes_.names()[row->pass]) + ", " +
                                text::shortest_plain(row->angle_deg) + "° occurs a second time, the first is " +
                                line_of(*earlier),
                            "station, reflector, pass and angle occur together once",
                            "remove one of the two, or give the repetition a pass of its own");
        }
    }

    void check_counts(const std::vector<LengthsRow>& rows, ProblemList& problems) const {
        std::vector<std::size_t> at_angle(places_.angles_deg.size(), 0);
        std::vector<const LengthsRow*> first_at_angle(places_.angles_deg.size(), nullptr);
        std::vector<std::size_t> of_station(places_.stations.size(), 0);
        for (const LengthsRow& row : rows) {
            if (at_angle[row.angle]++ == 0) {
                first_at_angle[row.angle] = &row;
            }
            ++of_station[row.station];
        }
        for (std::size_t i = 0; i < at_angle.size(); ++i) {
            if (at_angle[i] < k_least_at_angle) {
                problems.refuse(k_too_few_at_angle, where(*first_at_angle[i], c_angle),
                                counted(at_angle[i], "distance") + " at the angle " +
                                    text::shortest_plain(places_.angles_deg[i]) + "°",
                                "a pose has six unknowns: every angle needs at least 6 distances",
                                "add distances, or remove the angle");
            }
        }
        for (std::size_t i = 0; i < of_station.size(); ++i) {
            if (of_station[i] < k_least_of_station) {
                problems.refuse(k_too_few_of_station, places_.where_station_appears(i),
                                counted(of_station[i], "distance") + " of the station " +
                                    text::in_quotes(places_.stations.names()[i]),
                                "a station has four unknowns (x, y, z and a dead path): it needs at least 4 distances",
                                "add distances, or remove the station");
            }
        }
        if (reflectors_.size() < k_least_reflectors) {
            problems.refuse(k_too_few_reflectors, where(rows.front(), c_reflector),
                            counted(reflectors_.size(), "reflector"),
                            "the pose of the table needs at least 3 reflectors", "measure further reflectors");
        }
    }

    void check_units_and_span(const std::vector<LengthsRow>& rows, ProblemList& problems) const {
        const auto longest = std::max_element(rows.begin(), rows.end(), [](const LengthsRow& a, const LengthsRow& b) {
            return std::abs(a.length_mm) < std::abs(b.length_mm);
        });
        if (std::abs(longest->length_mm) < 10.0) {
            problems.refuse(
                k_lengths_in_metres, where(*longest, c_length),
                "no length reaches 10 mm; the longest is " + text::shortest_plain(longest->length_mm) + " mm",
                "lengths are in millimetres", "multiply by 1000 if the values are metres");
        }
        check_angles(reading_, places_, where(rows.front(), c_angle), text::visible(problems.file()), problems);
    }

    void store_lengths(const std::vector<LengthsRow>& rows) {
        engine::RotaryTableMeasurement& measurement = reading_.job().measurement;
        measurement.stations = places_.stations.names();
        measurement.passes = passes_.names();
        measurement.dead_paths = dead_paths_.names();
        measurement.station_start.assign(places_.stations.size(), std::nullopt);
        store_angles(reading_, places_);
        measurement.lengths.reserve(rows.size());
        for (const LengthsRow& row : rows) {
            engine::LengthObservation observation;
            observation.station = row.station;
            observation.reflector = fixture_.reflectors.find(reflectors_.names()[row.reflector]).value_or(0);
            observation.pass = row.pass;
            observation.angle = row.angle;
            observation.dead_path = row.dead_path;
            observation.approach = row.direction == 0 ? engine::Approach::positive : engine::Approach::negative;
            observation.length = row.length_mm * k_millimetre;
            observation.line = places_.table->cell(row.table_row, c_station).line;
            measurement.lengths.push_back(observation);
            if (places_.table->has_column(c_time)) {
                measurement.times.push_back(row.time);
            }
        }
    }
};

}  // namespace

MeasuredPlaces read_lengths(const RotaryTableReading& reading, const FixtureNames& fixture, JobFiles::File&& file) {
    return LengthsReader(reading, fixture).read(std::move(file));
}

}  // namespace gumcert::jobs
