#include "jobs/rotary_table/rotary_table_environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "gum/quantity/units.h"
#include "jobs/rotary_table/rotary_table_limits.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using gum::k_millimetre;

/// Goes through a table with one row a station.
/// \param use  called with row and index of a known station
template <typename Use>
void for_each_station(const CsvTable& table, const MeasuredPlaces& places, bool has_lengths, ProblemList& problems,
                      const Use& use) {
    std::unordered_map<std::string_view, std::size_t> lines;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const auto name = table.name(row, 0);
        std::optional<std::size_t> station;
        if (name) {
            const auto [entry, is_new] = lines.try_emplace(*name, table.cell(row, 0).line);
            if (!is_new) {
                refuse_repeated_name(table, row, 0, "station", entry->second, problems);
            }
            station = places.stations.find(*name);
            if (is_new && !station && places.table) {
                problems.warn(k_warn_unused_station, table.where(table.cell(row, 0)),
                              "the station " + text::in_quotes(*name) +
                                  (has_lengths ? " has no distance" : " is not in the stations file"),
                              has_lengths ? "stations appear in the lengths file"
                                          : "the stations of a layout are those of the stations file",
                              "check the name, or remove the row");
            }
        }
        use(row, station);
    }
}

}  // namespace

void read_stations(const RotaryTableReading& reading, JobFiles::File&& file, MeasuredPlaces& places) {
    RotaryTableJob& job = reading.job();
    static constexpr std::array<std::string_view, 4> k_columns{"station", "x_mm", "y_mm", "z_mm"};
    static constexpr std::array<std::string_view, 1> k_optional{"u_mm"};
    enum : std::size_t { x = 1, u = 4 };
    std::optional<CsvTable> table = read_csv_table(std::move(file.bytes), k_columns, k_optional, *file.problems);
    if (!table) {
        return;
    }
    constexpr double k_among_reflectors = 0.01;  // [m]
    double farthest = 0.0;                       // coordinate of a station, [m]
    if (!job.has_lengths) {
        places.table = table;
        for (std::size_t row = 0; row < table->rows(); ++row) {
            const std::string_view name = table->cell(row, 0).text;
            if (!name_objection(name) && places.stations.index(name) == places.first_row_of_station.size()) {
                places.first_row_of_station.push_back(row);
            }
        }
        job.measurement.stations = places.stations.names();
        job.measurement.station_start.assign(places.stations.size(), std::nullopt);
    }
    for_each_station(*table, places, job.has_lengths, *file.problems,
                     [&](std::size_t row, std::optional<std::size_t> station) {
                         Eigen::Vector3d position = Eigen::Vector3d::Zero();
                         for (std::size_t k = 0; k < 3; ++k) {
                             position(static_cast<Eigen::Index>(k)) =
                                 table->number(row, x + k, k_station_coordinate).value_or(0.0) * k_millimetre;
                         }
                         (void)table->number_if_any(row, u, above_zero("mm"));
                         farthest = std::max(farthest, position.cwiseAbs().maxCoeff());
                         if (station && !job.measurement.station_start.empty()) {
                             job.measurement.station_start[*station] = position;
                         }
                     });
    // The origin lies on the rotary axis: where the fixture turns no station stands, and all of them least of all.
    if (file.problems->refusals() == 0 && table->rows() > 0 && farthest < k_among_reflectors) {
        file.problems->refuse(k_coordinates_in_metres, table->where(table->cell(0, x)),
                              "no coordinate of a station reaches 10 mm; the largest is " +
                                  text::shortest_plain(farthest / k_millimetre) + " mm",
                              "coordinates are in millimetres", "multiply by 1000 if the values are metres");
    }
}

void read_environment(const RotaryTableReading& reading, JobFiles::File&& file, const MeasuredPlaces& places) {
    RotaryTableJob& job = reading.job();
    static constexpr std::array<std::string_view, 3> k_columns{"station", "fixture_temperature_degC",
                                                               "u_temperature_K"};
    static constexpr std::array<std::string_view, 3> k_optional{"air_temperature_degC", "pressure_hPa",
                                                                "humidity_percent"};
    enum : std::size_t { temperature = 1, u_temperature, air_temperature, pressure, humidity };
    const std::optional<CsvTable> table = read_csv_table(std::move(file.bytes), k_columns, k_optional, *file.problems);
    if (!table) {
        return;
    }
    const auto count = static_cast<Eigen::Index>(places.stations.size());
    job.measurement.temperature_difference = Eigen::VectorXd::Zero(count);
    job.measurement.u_temperature = Eigen::VectorXd::Zero(count);
    job.air.assign(places.stations.size(), {});
    std::vector<bool> found(places.stations.size(), false);
    for_each_station(
        *table, places, job.has_lengths, *file.problems, [&](std::size_t row, std::optional<std::size_t> station) {
            const auto fixture = table->number(row, temperature, k_temperature);
            const auto u = table->number(row, u_temperature, not_negative("K"));
            StationAir air;
            air.temperature_degC = table->number_if_any(row, air_temperature, k_temperature);
            air.pressure_hPa = table->number_if_any(row, pressure, between(300.0, 1200.0, "hPa"));
            air.humidity_percent = table->number_if_any(row, humidity, between(0.0, 100.0, "%"));
            if (station) {
                const auto index = static_cast<Eigen::Index>(*station);
                found[*station] = true;
                job.measurement.temperature_difference(index) = fixture.value_or(0.0) - job.reference_temperature_degC;
                job.measurement.u_temperature(index) = u.value_or(0.0);
                job.air[*station] = air;
            }
        });
    constexpr double k_unlikely = 5.0;  // [K]
    if (const double largest = count > 0 ? job.measurement.u_temperature.maxCoeff() : 0.0; largest > k_unlikely) {
        file.problems->warn(
            k_warn_unlikely_uncertainty, table->where(table->cell(0, u_temperature)),
            "the largest standard uncertainty of a temperature is " + text::significant(largest, 2) + " K",
            "the temperature of a fixture is known to better than " + text::shortest_plain(k_unlikely) + " K",
            "check the unit: the column u_temperature_K is in kelvin");
    }
    // In another unit all of them are far off; one alone may be mistyped, which the distances of its station tell.
    constexpr double k_far = 20.0;  // [K]
    const Eigen::VectorXd& off = job.measurement.temperature_difference;
    if (const double least = count > 0 ? off.cwiseAbs().minCoeff() : 0.0; least > k_far) {
        file.problems->warn(
            k_warn_far_temperatures, table->where(table->cell(0, temperature)),
            "every temperature of the fixture is " + text::shortest_plain(std::floor(least)) + " K" +
                " and more from the reference temperature of " + text::shortest_plain(job.reference_temperature_degC) +
                " °C",
            "what the expansion of the fixture is not known to is multiplied by this difference",
            "check that temperatures are in °C, and reference_temperature_degC as well: 68 °F are 20 °C");
    }
    // A row that could not be read may be the one that seems to be missing.
    bool all_rows_read = table->is_complete();
    for (std::size_t row = 0; row < table->rows(); ++row) {
        all_rows_read = all_rows_read && !name_objection(table->cell(row, 0).text);
    }
    for (std::size_t i = 0; all_rows_read && i < found.size(); ++i) {
        if (!found[i]) {
            file.problems->refuse(k_unknown_station, places.where_station_appears(i),
                                  "the station " + text::in_quotes(places.stations.names()[i]) + " has no row in " +
                                      text::visible(file.problems->file()),
                                  "every station has a row in the environment file",
                                  "add the row, or correct the name of the station");
        }
    }
}

void assume_reference_temperature(const RotaryTableReading& reading, const MeasuredPlaces& places) {
    const auto count = static_cast<Eigen::Index>(places.stations.size());
    reading.job().measurement.temperature_difference = Eigen::VectorXd::Zero(count);
    reading.job().measurement.u_temperature = Eigen::VectorXd::Zero(count);
}

}  // namespace gumcert::jobs
