#include "jobs/comparison/comparison_compared_job.h"

#include <cmath>
#include <utility>

#include "jobs/circle_closure/circle_closure_job.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_kind.h"
#include "jobs/job_reader.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

/// An angle as the name of a point: from 0 to below 360 degrees, to a millionth.
double named_angle(double degrees) {
    constexpr double k_turn = 360.0;
    constexpr double k_shown = 1e6;
    const double rounded = std::round(degrees * k_shown) / k_shown;
    const double within = std::fmod(rounded, k_turn);
    return within < 0.0 ? within + k_turn : within + 0.0;
}

/// The job itself, and its angles.
std::vector<double> read_job_of(const FileSource& source, const std::string& file, JobFiles& files, bool of_artefact,
                                ComparisonSide& side) {
    std::vector<double> angles;
    if (probable_job_kind(source, file) == k_circle_closure_kind) {
        side.circle_closure = std::make_shared<const CircleClosureJob>(read_circle_closure_job(source, file));
        files.add(side.circle_closure->files, side.circle_closure->warnings);
        for (std::size_t i = 0; i < side.circle_closure->measurement.steps; ++i) {
            angles.push_back(of_artefact ? side.circle_closure->side_angle_deg(i)
                                         : side.circle_closure->step_angle_deg(i));
        }
        return angles;
    }
    side.rotary_table = std::make_shared<const RotaryTableJob>(read_rotary_table_job(source, file));
    files.add(side.rotary_table->files, side.rotary_table->warnings);
    return side.rotary_table->measurement.angles_deg;
}

}  // namespace

void read_compared_job(const ComparisonReading& reading, const JsonObject& object, const std::optional<gum::Unit>& unit,
                       SideReading& side) {
    JobReader(object).read(side, {"of"});
    for (const std::string_view key : {"points", "covariance", "budget"}) {
        if (object.has(key)) {
            object.refuse(k_stated_beside_budget, key, text::in_quotes(key) + " beside a job",
                          "points, values and covariance are those of the job", "remove the key, or \"job\"");
        }
    }
    if (unit && !(unit->dimension() == gum::Dimension::angle())) {
        object.refuse(k_unit_does_not_fit, "job", "a comparison in " + text::in_quotes(unit->text()),
                      "a job gives deviations of an angle", "state the \"unit\" of the comparison, such as \"arcsec\"");
    }
    const auto name = JobFiles::file_name(object, "job", true);
    const auto file = name ? reading.files.open(*name) : std::nullopt;
    if (!file) {
        side.is_whole = false;
        return;
    }
    side.side.job_file = *name;
    std::vector<double> angles;
    try {
        angles = read_job_of(reading.budgets.source(), file->problems->file(), reading.files, side.side.of_artefact,
                             side.side);
    } catch (const gum::InputError& error) {
        reading.files.add(error);
        side.is_whole = false;
        return;
    } catch (const gum::StorageError& error) {
        reading.files.add(error);
        side.is_whole = false;
        return;
    }
    if (side.side.rotary_table && side.side.of_artefact) {
        object.refuse(k_compared_job, "of", "\"artefact\" of a job of kind \"rotary_table\"",
                      "only a circle closure measures an artefact", "remove \"of\"");
    }
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const double angle = named_angle(angles[i]);
        SidePoint point;
        point.point.name = text::shortest_plain(angle);
        point.point.position = angle;
        point.where = object.where("job");
        side.points.push_back(std::move(point));
        side.side.job_angles.push_back(i);
    }
}

}  // namespace gumcert::jobs
