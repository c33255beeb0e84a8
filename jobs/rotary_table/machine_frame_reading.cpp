#include "jobs/rotary_table/machine_frame_reading.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "gum/quantity/units.h"
#include "jobs/csv_table.h"
#include "jobs/input_codes.h"
#include "jobs/input_text.h"
#include "jobs/job_reader.h"
#include "jobs/rotary_table/rotary_table_fields.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using gum::k_micrometre;
using gum::k_millimetre;

constexpr NumberRange k_u{.low = 0.0,
                          .high = 1e5,
                          .low_open = true,
                          .unit = "µm",
                          .hint = "state the standard uncertainty of a coordinate in micrometres"};
constexpr std::size_t k_least_points = 3;

}  // namespace

std::optional<MachineFrameRequest> read_machine_frame(const JsonObject& root) {
    const std::optional<JsonObject> object = root.optional_object("machine_frame", keys_of<MachineFrameRequest>());
    if (!object) {
        return std::nullopt;
    }
    MachineFrameRequest request;
    request.where = object->where();
    JobReader reader(*object);
    reader.read(request);
    const bool is_whole =
        reader.accepted("by") && reader.accepted("coordinates") && reader.accepted("nominal_point_mm");
    return is_whole ? std::optional(std::move(request)) : std::nullopt;
}

std::optional<engine::MachineFrame> read_machine_points(MachineFrameRequest request, JobFiles::File file,
                                                        const std::vector<std::string>& names) {
    const bool stations = request.frame.by == engine::MachineFramePoints::stations;
    const std::string noun = stations ? "station" : "reflector";
    const std::array<std::string_view, 5> columns{noun, "x_mm", "y_mm", "z_mm", "u_um"};
    enum : std::size_t { x = 1, u = 4 };
    const std::optional<CsvTable> table =
        read_csv_table(std::move(file.bytes), columns, std::span<const std::string_view>{}, *file.problems);
    if (!table) {
        return std::nullopt;
    }
    engine::MachineFrame frame = std::move(request.frame);
    const std::size_t refused = file.problems->refusals();
    const auto rows = static_cast<Eigen::Index>(table->rows());
    frame.coordinates = Eigen::MatrixXd::Zero(rows, 3);
    frame.u = Eigen::VectorXd::Zero(rows);
    for (std::size_t row = 0; row < table->rows(); ++row) {
        const auto at = static_cast<Eigen::Index>(row);
        if (const auto name = table->name(row, 0)) {
            const auto found = std::find(names.begin(), names.end(), *name);
            const auto index = static_cast<std::size_t>(found - names.begin());
            if (found == names.end()) {
                file.problems->refuse(k_bad_machine_frame, table->where(table->cell(row, 0)),
                                      "the " + noun + " " + text::in_quotes(*name) + " is not in the measurement",
                                      "the frame of the machine is found from points that were measured",
                                      "check the name, or remove the row");
            } else if (std::find(frame.points.begin(), frame.points.end(), index) != frame.points.end()) {
                file.problems->refuse(k_repeated_name, table->where(table->cell(row, 0)),
                                      "the " + noun + " " + text::in_quotes(*name) + " has another row",
                                      "each " + noun + " has one row", "remove one of the rows");
            }
            frame.points.push_back(index);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            frame.coordinates(at, static_cast<Eigen::Index>(c)) =
                table->number(row, x + c, k_station_coordinate).value_or(0.0) * k_millimetre;
        }
        frame.u[at] = table->number(row, u, k_u).value_or(1.0) * k_micrometre;
    }
    if (table->rows() < k_least_points) {
        file.problems->refuse(k_bad_machine_frame, request.where,
                              std::to_string(table->rows()) + " " + noun + (table->rows() == 1 ? "" : "s"),
                              "three points that are not on a line determine the frame of the machine",
                              "measure the coordinates of more of them in the frame of the machine");
    }
    if (!table->is_complete() || file.problems->refusals() != refused) {
        return std::nullopt;
    }
    return frame;
}

}  // namespace gumcert::jobs
