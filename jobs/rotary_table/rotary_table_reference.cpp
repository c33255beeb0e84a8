#include "jobs/rotary_table/rotary_table_reference.h"

#include <algorithm>
#include <array>
#include <memory>
#include <tuple>
#include <utility>

#include "gum/quantity/units.h"
#include "jobs/budget/budget_job.h"
#include "jobs/job_reader.h"
#include "jobs/rotary_table/reference_budget.h"
#include "jobs/rotary_table/rotary_table_fields.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using gum::k_micrometre;

void read_readings(JobFiles::File&& file, const MeasuredPlaces& places, bool has_lengths,
                   engine::ReferenceMethod& method) {
    static constexpr std::array<std::string_view, 4> k_columns{"direction", "angle_deg", "run", "reading_um"};
    static constexpr std::array<std::string_view, 3> k_directions{"x", "y", "z"};
    enum : std::size_t { c_axis, c_at, c_run, c_reading };
    const std::optional<CsvTable> table = read_csv_table(std::move(file.bytes), k_columns, {}, *file.problems);
    if (!table) {
        return;
    }
    NumberRange displacement = between(-100'000.0, 100'000.0, "µm");
    displacement.hint = "check the unit: readings are in micrometres";
    std::vector<std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>> seen;  // direction, angle, run, row
    for (std::size_t row = 0; row < table->rows(); ++row) {
        const auto direction = table->choice(row, c_axis, k_directions);
        const auto angle = table->number(row, c_at, k_angle);
        const auto run = table->integer(row, c_run, between(0.0, 1e6, ""));
        const auto reading = table->number(row, c_reading, displacement);
        std::optional<std::size_t> index;
        if (angle) {
            index = places.angle_index(*angle);
            if (!index && places.is_whole) {
                file.problems->refuse(k_reading_at_unknown_angle, table->where(table->cell(row, c_at)),
                                      "the angle " + text::shortest_plain(*angle) + "° " +
                                          (has_lengths ? "has no distance" : "is not planned"),
                                      "the reference method is compared at the measured angles",
                                      "correct the angle, or remove the row");
            }
        }
        if (direction && index && run && reading) {
            seen.emplace_back(*direction, *index, static_cast<std::size_t>(*run), row);
            method.readings.push_back({*direction, *index, static_cast<std::size_t>(*run), *reading * k_micrometre});
        }
    }
    std::sort(seen.begin(), seen.end());
    std::vector<std::pair<std::size_t, std::size_t>> repeated;  // row, row of the one before
    for (std::size_t i = 1; i < seen.size(); ++i) {
        const auto& [direction, angle, run, row] = seen[i];
        const auto& [other_direction, other_angle, other_run, other_row] = seen[i - 1];
        if (direction == other_direction && angle == other_angle && run == other_run) {
            repeated.emplace_back(row, other_row);
        }
    }
    std::sort(repeated.begin(), repeated.end());
    for (const auto& [row, earlier] : repeated) {
        file.problems->refuse(
            k_repeated_reading, table->where(table->cell(row, c_axis)),
            "the reading of direction " + std::string{table->cell(row, c_axis).text} + ", " +
                std::string{table->cell(row, c_at).text} + "°, run " + std::string{table->cell(row, c_run).text} +
                " occurs twice, before in line " + std::to_string(table->cell(earlier, c_axis).line),
            "direction, angle and run occur together once", "remove one of the two, or number the runs");
    }
}

void read_indicator(const JobFiles::File& file, engine::ReferenceMethod& method, bool has_budget) {
    const std::optional<JsonDocument> document = read_json_document(file.bytes, *file.problems);
    if (!document) {
        return;
    }
    const std::optional<JsonObject> object = JsonObject::root(*document, keys_of<IndicatorStatement>(), *file.problems);
    if (!object) {
        return;
    }
    IndicatorStatement stated;
    JobReader reader(*object);
    reader.read(stated, {"contact_point_mm"});
    const auto read = [&](std::string_view key) {
        if (!has_budget) {
            (void)object->require(key);
        }
        reader.read(stated, {key});
    };
    read("resolution_um");
    read("mpe_um");
    reader.read(stated, {"mpe_common"});
    read("repeatability_um");
    reader.read(stated, {"temperature_degC", "note"});
    method.contact_point = stated.contact_point;
    method.mpe_common = stated.mpe_common;
    if (has_budget) {
        return;  // it states what is known; the file may be one of another job
    }
    if (stated.resolution == 0.0 && stated.maximum_permissible_error == 0.0 && stated.repeatability == 0.0) {
        file.problems->refuse(k_no_indicator_uncertainty, object->where(),
                              "resolution_um, mpe_um and repeatability_um are all 0 µm",
                              "at least one must be greater than 0", "state what is known of the dial indicator");
    }
    method.resolution = stated.resolution.value_or(0.0);
    method.maximum_permissible_error = stated.maximum_permissible_error.value_or(0.0);
    method.repeatability = stated.repeatability.value_or(0.0);
}

void read_reference_correlation(const JsonObject& reference, engine::ReferenceMethod& method) {
    const nlohmann::json* const value = reference.find("correlation");
    if (value == nullptr) {
        return;
    }
    if (value->is_number()) {
        method.correlation = engine::ReferenceCorrelation::given;
        method.r = reference.optional_number("correlation", between(-1.0, 1.0, "")).value_or(0.0);
    } else if (value->is_string() && *value == "none") {
        method.correlation = engine::ReferenceCorrelation::none;
    } else if (!value->is_string() || *value != "unknown") {
        reference.refuse(k_reference_correlation, "correlation", "the value is " + described(*value),
                         "the correlation of both methods is a number from -1 to 1, \"none\" or \"unknown\"",
                         "write \"unknown\" where it is not known whether both use one standard or sensor");
    }
}

void read_published(const JsonObject& reference, engine::ReferenceMethod& method, bool readings_are_whole) {
    const auto published = reference.optional_object("published", keys_of<PublishedStatement>());
    if (!published) {
        return;
    }
    PublishedStatement stated;
    JobReader(*published).read(stated, {"source"});
    method.published_source = stated.source;
    constexpr std::array<std::string_view, 3> k_directions{"x", "y", "z"};
    const auto means = published->required_object("mean_abs_En", k_directions);
    if (!means) {
        return;
    }
    bool any = false;
    for (std::size_t d = 0; d < k_directions.size(); ++d) {
        const std::string_view key = k_directions[d];
        any = any || means->has(key);
        method.published_mean_abs_En[d] = means->optional_number(key, k_mean_abs_En.range);
        const bool is_read =
            std::any_of(method.readings.begin(), method.readings.end(),
                        [&](const engine::ReferenceReading& reading) { return reading.direction == d; });
        if (method.published_mean_abs_En[d] && readings_are_whole && !is_read) {
            means->refuse(k_published_direction, key, "the readings have no direction " + text::in_quotes(key),
                          "a published mean |En| stands beside that of the same direction",
                          "remove it, or correct the direction");
        }
    }
    if (!any) {
        published->refuse(k_missing_key, "mean_abs_En", "no direction is stated",
                          "at least one of \"x\", \"y\", \"z\" has a published mean |En|",
                          "state it, or remove \"published\"");
    }
}

void read_budget(const RotaryTableReading& reading, const FileSource& source, bool readings_are_whole) {
    RotaryTableJob& job = reading.job();
    const std::optional<std::string>& name = reading.stated.reference.budget;
    const std::optional<JobFiles::File> file = name ? reading.files.open(*name) : std::nullopt;
    if (!file) {
        return;
    }
    job.reference_budget_file = *name;
    try {
        const std::vector<ReferencePoint> points =
            readings_are_whole ? reference_points(job.reference->readings) : std::vector<ReferencePoint>{};
        auto budget = std::make_shared<const BudgetJob>(
            read_reference_budget(source, file->problems->file(), points, job.measurement.angles_deg));
        reading.files.add(budget->files, budget->warnings);
        job.reference_budget = std::move(budget);
    } catch (const gum::InputError& error) {
        reading.files.add(error);
    } catch (const gum::StorageError& error) {
        reading.files.add(error);
    }
}

}  // namespace

void read_reference(const RotaryTableReading& reading, const JsonObject& reference, ReferenceFiles&& files,
                    const MeasuredPlaces& places, const FileSource& source) {
    ReferenceStatement& stated = reading.stated.reference;
    engine::ReferenceMethod& method = reading.job().reference.emplace();
    method.name = stated.name;
    bool readings_are_whole = false;
    if (files.readings) {
        const std::size_t refused = files.readings->problems->refusals();
        const ProblemList& of_readings = *files.readings->problems;
        read_readings(std::move(*files.readings), places, reading.job().has_lengths, method);
        readings_are_whole = of_readings.refusals() == refused && places.is_whole;
    }
    if (files.description) {
        read_indicator(*files.description, method, reference.has("budget"));
    }
    read_reference_correlation(reference, method);
    read_published(reference, method, readings_are_whole);
    JobReader(reference).read(stated, {"audited"});
    if (stated.audited) {
        method.audited_factor = stated.audited->factor;
        method.audit_finding = stated.audited->finding;
    }
    read_budget(reading, source, readings_are_whole);
}

}  // namespace gumcert::jobs
