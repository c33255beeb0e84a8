#include "jobs/rotary_table/rotary_table_job.h"

#include <array>
#include <cmath>
#include <utility>

#include "gum/quantity/units.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/certificate/certificate_statement.h"
#include "jobs/job_reader.h"
#include "jobs/laboratory/laboratory_certificate.h"
#include "jobs/laboratory/laboratory_use.h"
#include "jobs/rotary_table/rotary_table_environment.h"
#include "jobs/rotary_table/rotary_table_exclusion.h"
#include "jobs/rotary_table/rotary_table_fields.h"
#include "jobs/rotary_table/rotary_table_fixture.h"
#include "jobs/rotary_table/rotary_table_layout.h"
#include "jobs/rotary_table/rotary_table_lengths.h"
#include "jobs/rotary_table/rotary_table_reference.h"
#include "jobs/rotary_table/rotary_table_study.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using gum::k_micrometre;

constexpr double k_least_u = 1e-6;  // of a length, [µm]: a millionth of what the best interferometers reach
// With two digits of u some of the hundreds of quantities would need millions of trials to be decided.
constexpr int k_validated_digits = 1;
constexpr std::uint64_t k_most_automatic_trials = 1'000'000;  // minutes

/// The Monte Carlo of a job that asks for its result and says no more: adaptive, to the two digits that are printed.
gum::MonteCarloRequest automatic_monte_carlo(const std::string& where) {
    gum::MonteCarloRequest request;
    request.most_trials = k_most_automatic_trials;
    request.where = where;
    return request;
}

void read_common(const RotaryTableReading& reading) {
    const JsonObject& root = reading.root;
    RotaryTableJob& job = reading.job();
    JobReader reader(root);
    read_title(root, {&reading.document, root.pointer("title"), &reading.problems}, job.title);
    reader.read(reading.stated, {"coverage_probability"});
    read_unused_texts(root);
    job.monte_carlo = read_monte_carlo(root, job.coverage_probability, k_validated_digits, reading.problems);
    reader.read(reading.stated, {"coverage"});
    if (job.coverage == gum::CoverageChoice::monte_carlo && !job.monte_carlo && !root.has("monte_carlo")) {
        job.monte_carlo = automatic_monte_carlo(root.where("coverage"));
    }
    job.simulation = read_simulation(root, reading.problems);
    job.plan = read_plan(reading.document, root, reading.problems);
}

void read_length_uncertainty(const RotaryTableReading& reading, const JsonObject& object) {
    engine::LengthUncertainty& uncertainty = reading.job().measurement.length_uncertainty;
    JobReader reader(object);
    reader.read(uncertainty, {"u_constant_um", "u_proportional_um_per_m"});
    const auto constant = reader.number("u_constant_um");
    const bool proportional_is_zero =
        !object.has("u_proportional_um_per_m") || reader.number("u_proportional_um_per_m") == 0.0;
    if (constant && *constant < k_least_u && proportional_is_zero) {
        object.refuse(
            k_no_length_uncertainty, "u_constant_um",
            "u_constant_um is " + text::shortest_plain(*constant) + " µm, and u_proportional_um_per_m is 0 µm/m",
            "the standard uncertainty of a length must be greater than 0, and at least " +
                text::shortest_plain(k_least_u) + " µm where it does not grow with the distance",
            "state the standard uncertainty of a length");
    }
    uncertainty.scale_model = object.has("scale_u") ? engine::ScaleModel::prior : engine::ScaleModel::fixed;
    reader.read(uncertainty, {"resolution_um", "scale_u", "scale_model"});
    constexpr double k_unlikely = 1e-9;  // [m]
    const double at_1_m =
        std::hypot(uncertainty.u_constant, uncertainty.u_proportional, uncertainty.resolution / std::sqrt(12.0));
    if (constant && *constant >= k_least_u && at_1_m < k_unlikely) {
        reading.problems.warn(k_warn_unlikely_uncertainty, object.where("u_constant_um"),
                              "the standard uncertainty of a length of 1 m is " +
                                  text::significant(at_1_m / gum::k_micrometre, 2) + " µm",
                              "a length is hardly known to a nanometre",
                              "check the unit: u_constant_um is in micrometres");
    }
    if (uncertainty.scale_model == engine::ScaleModel::prior && !object.has("scale_u")) {
        object.refuse(k_scale_without_u, "scale_model", "scale_model is \"prior\" and scale_u is missing",
                      "a prior on the scale needs its standard uncertainty",
                      "add \"scale_u\", or choose \"fixed\" or \"free\"");
    }
    if (uncertainty.scale_model != engine::ScaleModel::prior && reader.accepted("scale_u")) {
        reading.problems.warn(k_warn_unused_value, object.where("scale_u"),
                              "scale_u " + text::shortest_plain(*reader.number("scale_u")) + " is not used",
                              "it belongs to scale_model \"prior\"", "remove it, or choose \"prior\"");
    }
}

void read_repeatability(const RotaryTableReading& reading, const JsonObject& object) {
    engine::TableRepeatability& repeatability = reading.job().measurement.table_repeatability;
    JobReader reader(object);
    reader.read(repeatability, {"mode", "at_mm"});
    const bool is_given = repeatability.mode == engine::RepeatabilityMode::given;
    bool any = false;
    bool all_read = true;
    const auto read = [&](std::string_view key, std::string_view unit) {
        if (is_given) {
            (void)object.require(key);
        }
        reader.read(repeatability, {key});
        const std::optional<double> value = reader.number(key);
        any = any || value.value_or(0.0) > 0.0;
        all_read = all_read && (value || !object.has(key)) && (value || !is_given);
        if (repeatability.mode == engine::RepeatabilityMode::none && value) {
            reading.problems.warn(
                k_warn_unused_value, object.where(key),
                std::string{key} + " " + text::shortest_plain(*value) + " " + std::string{unit} + " is not used",
                "with mode \"none\" the table has no uncertainty of repeatability",
                "remove it, or choose mode \"given\"");
        }
    };
    read("u_linear_um", "µm");
    read("u_axial_arcsec", "″");
    read("u_tilt_arcsec", "″");
    if (is_given && all_read && !any) {
        object.refuse(k_no_repeatability, "mode", "mode is \"given\", and every standard uncertainty is 0",
                      "at least one must be greater than 0", "state the repeatability, or choose mode \"none\"");
    }
}

void read_options(const RotaryTableReading& reading) {
    const JsonObject& root = reading.root;
    engine::RotaryTableMeasurement& measurement = reading.job().measurement;
    JobReader reader(root);
    for (const std::string_view key : {"axis", "datum", "method", "reversal", "home_angle_deg"}) {
        reader.read(reading.stated, {key});
    }
    if (!root.has("home_angle_deg")) {
        reading.stated.home_angle_deg = 0.0;
    }
    if (const auto object = root.required_object("length_uncertainty", keys_of<engine::LengthUncertainty>())) {
        read_length_uncertainty(reading, *object);
    }
    if (const auto object = root.optional_object("table_repeatability", keys_of<engine::TableRepeatability>())) {
        read_repeatability(reading, *object);
    }
    reader.read(reading.stated, {"variance_components", "outliers"});
    measurement.estimate_length_noise = reading.stated.estimates_length_noise.value_or(
        measurement.table_repeatability.mode == engine::RepeatabilityMode::estimate);
}

void read_observations(const RotaryTableReading& reading, const JsonObject& observations) {
    ObservationsStatement& stated = reading.stated.observations;
    JobReader(observations).read(stated, {"temperature_distribution"});
    reading.job().measurement.temperature_shape = stated.temperature_shape.value_or(engine::InputShape::normal);
    if (stated.temperature_shape && !observations.has("environment")) {
        reading.problems.warn(k_warn_unused_value, observations.where("temperature_distribution"),
                              "temperature_distribution is not used", "it belongs to the environment file",
                              "remove it, or add \"environment\"");
    }
    if (!observations.has("environment")) {
        reading.problems.warn(
            k_warn_no_environment, observations.where(),
            "no environment file: the fixture is taken to be at its reference temperature, with no uncertainty",
            "thermal expansion of the fixture is corrected from the temperature at each station",
            "add \"environment\" if temperatures were measured");
    }
}

void read_frame_of_machine(const RotaryTableReading& reading, MachineFrameRequest&& machine, JobFiles::File&& file) {
    const bool stations = machine.frame.by == engine::MachineFramePoints::stations;
    const engine::RotaryTableMeasurement& measurement = reading.job().measurement;
    if (measurement.datum != engine::Datum::axis_average_line) {
        reading.root.refuse(k_bad_machine_frame, "machine_frame", "the datum is that of the home angle",
                            "location errors are those of the axis average line",
                            "choose \"datum\": \"axis_average_line\"");
        return;
    }
    if (stations && measurement.method != engine::AdjustmentMethod::joint) {
        reading.root.refuse(k_bad_machine_frame, "machine_frame", "the machine is known by its stations",
                            "the covariance of the stations is that of the joint adjustment",
                            "choose \"method\": \"joint\", or probe the reflectors");
        return;
    }
    if (measurement.reflectors.empty() || measurement.stations.empty()) {
        return;  // their own files were refused
    }
    reading.job().machine_frame = read_machine_points(std::move(machine), std::move(file),
                                                      stations ? measurement.stations : measurement.reflectors);
}

/// Reads one job; every step notes what it finds, and `result` throws or returns at the end.
class RotaryTableReader {
public:
    RotaryTableReader(const FileSource& source, const std::string& job_file, JobUse use)
        : source_(source), files_(source, job_file), use_(use) {}

    RotaryTableJob result() {
        read_job();
        files_.refuse_if_needed();
        job_.files = files_.names();
        job_.where = job_.files.front();
        job_.warnings = files_.warnings();
        return std::move(job_);
    }

private:
    using File = JobFiles::File;

    void read_job() {
        const File file = files_.job();
        ProblemList& problems = *file.problems;
        std::optional<JsonDocument> document = read_json_document(file.bytes, problems);
        if (!document) {
            return;
        }
        const std::optional<std::string> kind = read_kind(*document, problems);
        if (!kind) {
            return;
        }
        if (*kind != k_rotary_table_kind) {
            problems.refuse(k_wrong_kind, document->where("/kind"), "a job of kind " + text::in_quotes(*kind),
                            "a job of kind \"rotary_table\" is expected here", "use the command for this kind of job");
            return;
        }
        if (const auto root = JsonObject::root(*document, keys_of<RotaryTableStatement>(), problems)) {
            const RotaryTableReading reading{files_, *document, *root, problems, stated_};
            read_common(reading);
            read_options(reading);
            read_files(reading);
            job_.document = std::move(document->value);
        }
    }

    /// The content of a file that the job names, and the list for its problems.
    std::optional<File> open(const std::optional<std::string>& name) {
        return name ? files_.open(*name) : std::nullopt;
    }

    void read_files(const RotaryTableReading& reading) {
        const JsonObject& root = reading.root;
        const auto observations = root.required_object("observations", keys_of<ObservationsStatement>());
        const auto fixture = root.required_object("fixture", keys_of<FixtureStatement>());
        const auto reference = root.optional_object("reference_method", keys_of<ReferenceStatement>());
        job_.has_lengths = use_ == JobUse::evaluate || !observations || observations->has("lengths");
        if (observations) {
            if (job_.has_lengths) {
                (void)observations->require("lengths");
            }
            JobReader(*observations).read(stated_.observations, {"lengths", "stations", "environment"});
        }
        if (fixture) {
            JobReader(*fixture).read(stated_.fixture, {"coordinates", "covariance", "budget"});
        }
        std::optional<MachineFrameRequest> machine = read_machine_frame(root);
        if (fixture) {
            read_fixture_statement(reading, *fixture, observations && observations->has("environment"));
        }
        if (observations) {
            read_observations(reading, *observations);
        }
        if (reference) {
            JobReader(*reference).read(stated_.reference, {"name", "readings", "description", "budget"});
        }

        // The lengths are read after the fixture because they name its reflectors; the lists of names and problems keep
        // the order of the documentation.
        std::optional<File> lengths = open(stated_.observations.lengths);
        std::optional<File> stations = open(stated_.observations.stations);
        std::optional<File> environment = open(stated_.observations.environment);
        std::optional<File> coordinates = open(stated_.fixture.coordinates);
        std::optional<File> covariance = open(stated_.fixture.covariance);
        std::optional<File> machine_points = machine ? open(machine->coordinates) : std::nullopt;
        ReferenceFiles reference_files{.readings = open(stated_.reference.readings),
                                       .description = open(stated_.reference.description)};
        FixtureNames names;
        if (coordinates) {
            names = read_fixture(reading, std::move(*coordinates));
            if (job_.plan && !names.reflectors.names().empty()) {
                check_facing(*job_.plan, names.reflectors.names(), reading.problems);
            }
        }
        job_.exclusions = read_exclusions(reading.document, root, reading.problems);
        MeasuredPlaces places;
        if (lengths) {
            places = read_lengths(reading, names, std::move(*lengths));
        }
        if (stations) {
            read_stations(reading, std::move(*stations), places);
        }
        if (!job_.has_lengths) {
            read_layout(reading, *observations, names, places);
        }
        check_home_of_plan(reading);
        warn_of_idle_plan(reading, use_);
        check_sizes(reading, names, places);
        if (places.is_whole) {
            check_reversal(reading);
        }
        if (environment) {
            read_environment(reading, std::move(*environment), places);
        } else {
            assume_reference_temperature(reading, places);
        }
        if (covariance) {
            read_fixture_covariance(reading, names, *covariance);
        }
        if (machine_points) {
            read_frame_of_machine(reading, std::move(*machine), std::move(*machine_points));
        }
        if (reference) {
            read_reference(reading, *reference, std::move(reference_files), places, source_);
        }
        LaboratoryUse laboratory(files_, reading.document, reading.problems);
        LaboratoryCertificate completion(laboratory);
        job_.certificate = read_certificate(files_, reading.document, reading.problems, &completion);
        read_fixture_budget(reading, names, source_);
    }

    const FileSource& source_;
    JobFiles files_;
    JobUse use_;
    RotaryTableStatement stated_;
    RotaryTableJob& job_ = stated_.job;
};

struct DiskJob {
    DiskFileSource source;
    std::string name;
};

DiskJob on_disk(const std::filesystem::path& job_file) {
    return {DiskFileSource::of_job(job_file), job_file.filename().string()};
}

}  // namespace

const JobFields& rotary_table_fields() {
    return fields_of<RotaryTableStatement>();
}

std::span<const JobKeys> rotary_table_job_keys() {
    static const JobKeyTable k_table(rotary_table_fields());
    return k_table.objects();
}

RotaryTableJob read_rotary_table_job(const FileSource& source, const std::string& job_file, JobUse use) {
    return RotaryTableReader(source, job_file, use).result();
}

RotaryTableJob read_rotary_table_job(const std::filesystem::path& job_file, JobUse use) {
    const DiskJob disk = on_disk(job_file);
    return read_rotary_table_job(disk.source, disk.name, use);
}

}  // namespace gumcert::jobs
