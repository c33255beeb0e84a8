#include "reports/record/make/rotary_table/location_error_record.h"

#include <cctype>
#include <cmath>
#include <string>

#include "engine/rotary_table/machine_frame.h"
#include "gum/quantity/units.h"
#include "jobs/rotary_table/rotary_table_words.h"
#include "reports/record/make/rotary_table/document_units.h"
#include "reports/record/make/rotary_table/table_parameter_record.h"
#include "text/numbers.h"

namespace gumcert::reports {

void fill_location_errors(reports::RotaryTable& rotary, const jobs::RotaryTableJob& job,
                          const gum::LocationErrors& errors) {
    const engine::MachineFrame& frame = *job.machine_frame;
    const bool stations = frame.by == engine::MachineFramePoints::stations;
    reports::MachineFrame& record = rotary.machine_frame.emplace();
    record.by = jobs::word_of(jobs::k_machine_points, frame.by);
    record.source = frame.source;
    for (int c = 0; c < 3; ++c) {
        record.nominal_point_mm[static_cast<std::size_t>(c)] = frame.nominal_point[c] / gum::k_millimetre;
    }
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const std::size_t point = frame.points[i];
        reports::MachinePoint entry;
        entry.name = stations ? job.measurement.stations[point] : job.measurement.reflectors[point];
        entry.u_um = frame.u[row] / gum::k_micrometre;
        for (int c = 0; c < 3; ++c) {
            entry.residual_um[static_cast<std::size_t>(c)] = errors.fit.residuals(row, c) / gum::k_micrometre;
        }
        record.points.push_back(std::move(entry));
    }
    record.chi_square = errors.fit.chi_square;
    record.degrees_of_freedom = errors.fit.degrees_of_freedom;
    record.p_value = {errors.p_value, text::significant(errors.p_value, 2)};
    record.printed_residual = text::significant(
        std::sqrt(errors.fit.residuals.squaredNorm() / static_cast<double>(errors.fit.residuals.size())) /
            gum::k_micrometre,
        2);
    if (!errors.budget) {
        return;
    }
    const auto names = engine::location_error_names(job.measurement.axis);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const char coordinate = static_cast<char>(std::tolower(names[i][1]));
        const DocumentUnit& unit = i < 2 ? k_um : k_arcsec;
        const std::string letter(1, i < 2 ? coordinate : static_cast<char>(coordinate - 'a' + 'x'));
        rotary.location_errors.push_back(
            table_parameter(*errors.budget, static_cast<Eigen::Index>(i), unit, names[i],
                            (i < 2 ? "position of the axis along " : "tilt of the axis about ") + letter +
                                " in the frame of the machine"));
    }
}

}  // namespace gumcert::reports
