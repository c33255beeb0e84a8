#include "engine/job/rotary_table_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "engine/job/budget_job.h"
#include "engine/job/certificate_statement.h"
#include "engine/job/csv_table.h"
#include "engine/job/job_files.h"
#include "engine/job/job_kind.h"
#include "engine/job/json_object.h"
#include "engine/job/machine_frame_reading.h"
#include "engine/job/monte_carlo_request.h"
#include "engine/job/reference_budget.h"
#include "engine/job/rotary_table_exclusion.h"
#include "engine/job/rotary_table_limits.h"
#include "engine/job/rotary_table_study.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::engine {

namespace {

using gum::k_arcsecond;
using gum::k_degree;
using gum::k_micrometre;
using gum::k_millimetre;
using Words = std::span<const std::string_view>;

// ---- keys -----------------------------------------------------------------------------------------------------------

constexpr std::array<std::string_view, 25> k_job_keys{"$schema",
                                                      "schema",
                                                      "kind",
                                                      "title",
                                                      "axis",
                                                      "home_angle_deg",
                                                      "datum",
                                                      "method",
                                                      "coverage_probability",
                                                      "coverage",
                                                      "observations",
                                                      "length_uncertainty",
                                                      "fixture",
                                                      "table_repeatability",
                                                      "variance_components",
                                                      "outliers",
                                                      "exclude",
                                                      "reversal",
                                                      "machine_frame",
                                                      "reference_method",
                                                      "monte_carlo",
                                                      "simulation",
                                                      "plan",
                                                      "certificate",
                                                      "notes"};
constexpr std::array<std::string_view, 4> k_observations_keys{"lengths", "stations", "environment",
                                                              "temperature_distribution"};
constexpr std::array<std::string_view, 5> k_length_uncertainty_keys{"u_constant_um", "u_proportional_um_per_m",
                                                                    "resolution_um", "scale_u", "scale_model"};
constexpr std::array<std::string_view, 8> k_fixture_keys{"coordinates",
                                                         "covariance",
                                                         "budget",
                                                         "uncertainty",
                                                         "distribution",
                                                         "variance_component",
                                                         "reference_temperature_degC",
                                                         "thermal_expansion_per_K"};
constexpr std::array<std::string_view, 3> k_expansion_keys{"value", "u", "distribution"};
constexpr std::array<std::string_view, 4> k_repeatability_keys{"mode", "u_linear_um", "u_axial_arcsec",
                                                               "u_tilt_arcsec"};
constexpr std::array<std::string_view, 3> k_outliers_keys{"test", "alpha", "action"};
constexpr std::array<std::string_view, 7> k_reference_keys{"name",        "readings",  "description", "budget",
                                                           "correlation", "published", "audited"};
constexpr std::array<std::string_view, 2> k_published_keys{"source", "mean_abs_En"};
constexpr std::array<std::string_view, 3> k_direction_keys{"x", "y", "z"};
constexpr std::array<std::string_view, 2> k_audited_keys{"factor", "finding"};
constexpr std::array<std::string_view, 7> k_indicator_keys{
    "contact_point_mm", "resolution_um", "mpe_um", "mpe_common", "repeatability_um", "temperature_degC", "note"};

const std::vector<JobKeys>& all_keys() {
    static const std::vector<JobKeys> k_all = [] {
        std::vector<JobKeys> all{{"", k_job_keys},
                                 {"/observations", k_observations_keys},
                                 {"/length_uncertainty", k_length_uncertainty_keys},
                                 {"/fixture", k_fixture_keys},
                                 {"/fixture/thermal_expansion_per_K", k_expansion_keys},
                                 {"/table_repeatability", k_repeatability_keys},
                                 {"/outliers", k_outliers_keys},
                                 {"/reference_method", k_reference_keys},
                                 {"/reference_method/published", k_published_keys},
                                 {"/reference_method/published/mean_abs_En", k_direction_keys},
                                 {"/reference_method/audited", k_audited_keys},
                                 {"/monte_carlo", k_monte_carlo_keys},
                                 {"/monte_carlo/adaptive", k_adaptive_keys}};
        const std::span<const JobKeys> studies = rotary_table_study_keys();
        all.insert(all.end(), studies.begin(), studies.end());
        for (const std::span<const JobKeys> more : {exclusion_keys(), machine_frame_keys()}) {
            all.insert(all.end(), more.begin(), more.end());
        }
        return all;
    }();
    return k_all;
}

template <typename E>
using Choice = std::pair<std::string_view, E>;

constexpr std::array<Choice<RotaryAxis>, 3> k_axes{{{"A", RotaryAxis::a}, {"B", RotaryAxis::b}, {"C", RotaryAxis::c}}};
constexpr std::array<Choice<Datum>, 2> k_datums{
    {{"axis_average_line", Datum::axis_average_line}, {"home", Datum::home}}};
constexpr std::array<Choice<AdjustmentMethod>, 2> k_methods{
    {{"joint", AdjustmentMethod::joint}, {"sequential", AdjustmentMethod::sequential}}};
constexpr std::array<Choice<ReversalModel>, 3> k_reversals{
    {{"auto", ReversalModel::automatic}, {"constant", ReversalModel::constant}, {"by_angle", ReversalModel::by_angle}}};
constexpr std::array<Choice<ScaleModel>, 3> k_scale_models{
    {{"fixed", ScaleModel::fixed}, {"prior", ScaleModel::prior}, {"free", ScaleModel::free}}};
constexpr std::array<Choice<RepeatabilityMode>, 3> k_modes{{{"estimate", RepeatabilityMode::estimate},
                                                            {"given", RepeatabilityMode::given},
                                                            {"none", RepeatabilityMode::none}}};
constexpr std::array<Choice<bool>, 2> k_variance_components{{{"estimate", true}, {"fixed", false}}};
constexpr std::array<Choice<OutlierTest>, 2> k_tests{
    {{"data_snooping", OutlierTest::data_snooping}, {"none", OutlierTest::none}}};
constexpr std::array<Choice<OutlierAction>, 2> k_actions{
    {{"report", OutlierAction::report}, {"remove", OutlierAction::remove}}};
constexpr std::array<Choice<InputShape>, 2> k_shapes{
    {{"normal", InputShape::normal}, {"uniform", InputShape::uniform}}};
constexpr std::array<Choice<FixtureComponent>, 3> k_fixture_components{
    {{"check", FixtureComponent::check}, {"estimate", FixtureComponent::estimate}, {"given", FixtureComponent::given}}};
constexpr std::array<Choice<bool>, 2> k_fixture_uncertainties{{{"stated", false}, {"source_paper", true}}};

// ---- limits of what a campaign can be -------------------------------------------------------------------------------

constexpr double k_least_u = 1e-6;  // of a length, [µm]: a millionth of what the best interferometers reach
constexpr double k_most_u = 1e5;    // [µm] and [µm/m]
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
constexpr std::size_t k_least_at_angle = 6;     // a pose has six unknowns
constexpr std::size_t k_least_of_station = 4;   // a station has x, y, z and a dead path
constexpr std::size_t k_least_reflectors = 3;   // three points fix a rigid body
constexpr std::size_t k_most_reflectors = 500;  // their covariance is dense
constexpr double k_most_distances = 1e6;        // of a layout, as of a lengths file
constexpr NumberRange k_fixture_coordinate{
    .low = -10'000.0, .high = 10'000.0, .unit = "mm", .hint = "check the unit: coordinates are in millimetres"};
// A displayed length is counted from where the beam was made; with its dead path it is a distance. It may be negative.
constexpr NumberRange k_length{
    .low = -100'000.0, .high = 100'000.0, .unit = "mm", .hint = "check the unit: lengths are in millimetres"};
// From any origin: the beginning of the day, of the measurement, or of the epoch of a data logger.
constexpr NumberRange k_time{.low = -1e11, .high = 1e11, .unit = "s", .hint = "check the unit: times are in seconds"};
constexpr NumberRange k_temperature{
    .low = -50.0, .high = 100.0, .unit = "°C", .hint = "check the unit: temperatures are in degrees Celsius"};

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

std::string plural(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// Angles that are radians by mistake are no multiples of 0.1 as they stand, and multiples of half a degree once they
/// are converted.
/// \param angles  ascending, each once, as the file states them
bool look_like_radians(const std::vector<double>& angles) {
    const double span = angles.back() - angles.front();
    const auto off_multiple = [](double value, double step) {
        return std::abs(value - step * std::round(value / step));
    };
    return angles.size() >= 6 && span > 3.1 && span <= 6.2832 &&
           std::all_of(angles.begin(), angles.end(),
                       [&](double angle) { return off_multiple(angle / k_degree, 0.5) <= 0.01; }) &&
           std::any_of(angles.begin(), angles.end(), [&](double angle) { return off_multiple(angle, 0.1) > 1e-6; });
}

/// Reads one job; every step notes what it finds, and `result` throws or returns at the end.
class Reader {
public:
    Reader(const FileSource& source, const std::string& job_file, JobUse use)
        : source_(source), files_(source, job_file), use_(use) {}

    RotaryTableJob result() {
        read_job();
        files_.refuse_if_needed();
        job_.files = files_.names();
        job_.warnings = files_.warnings();
        return std::move(job_);
    }

private:
    /// A row of the lengths file that could be read.
    struct Row {
        std::size_t table_row = 0;
        std::size_t station = 0;
        std::size_t reflector = 0;  ///< in lengths_reflectors_
        std::size_t pass = 0;
        std::size_t dead_path = 0;
        std::size_t direction = 0;  ///< 0 for +, 1 for -
        double angle_deg = 0.0;
        double length_mm = 0.0;
        std::size_t angle = 0;  ///< in angles_deg_
        double time = 0.0;      ///< [s], where the file has times
    };

    // ---- files ------------------------------------------------------------------------------------------------------

    using File = JobFiles::File;

    /// The content of a file that the job names, and the list for its problems.
    std::optional<File> open(const std::optional<std::string>& name) {
        return name ? files_.open(*name) : std::nullopt;
    }

    // ---- the job file -----------------------------------------------------------------------------------------------

    void read_job() {
        const File file = files_.job();
        problems_ = file.problems;
        ProblemList& problems = *problems_;
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
        const std::optional<JsonObject> root = JsonObject::root(*document, k_job_keys, problems);
        if (!root) {
            return;
        }
        read_common(*document, *root);
        read_options(*root);
        const std::optional<JsonObject> observations = root->required_object("observations", k_observations_keys);
        const std::optional<JsonObject> fixture = root->required_object("fixture", k_fixture_keys);
        const std::optional<JsonObject> reference = root->optional_object("reference_method", k_reference_keys);
        const auto name_in = [&](const std::optional<JsonObject>& object, std::string_view key, bool required) {
            return object ? JobFiles::file_name(*object, key, required) : std::nullopt;
        };
        job_.has_lengths = use_ == JobUse::evaluate || !observations || observations->has("lengths");
        const std::optional<std::string> lengths_name = name_in(observations, "lengths", job_.has_lengths);
        const std::optional<std::string> stations_name = name_in(observations, "stations", false);
        const std::optional<std::string> environment_name = name_in(observations, "environment", false);
        const std::optional<std::string> fixture_name = name_in(fixture, "coordinates", true);
        const std::optional<std::string> covariance_name = name_in(fixture, "covariance", false);
        const std::optional<std::string> budget_name = name_in(fixture, "budget", false);
        std::optional<MachineFrameRequest> machine = read_machine_frame(*root);
        if (fixture) {
            read_fixture_options(*fixture, observations && observations->has("environment"));
        }
        if (observations) {
            read_temperature_shape(*observations);
        }
        if (observations && !observations->has("environment")) {
            problems.warn(
                k_warn_no_environment, observations->where(),
                "no environment file: the fixture is taken to be at its reference temperature, with no uncertainty",
                "thermal expansion of the fixture is corrected from the temperature at each station",
                "add \"environment\" if temperatures were measured");
        }
        std::optional<std::string> reference_name;
        if (reference) {
            reference_name = reference->required_name("name");
        }
        const std::optional<std::string> readings_name = name_in(reference, "readings", true);
        const std::optional<std::string> description_name = name_in(reference, "description", true);
        const std::optional<std::string> reference_budget_name = name_in(reference, "budget", false);

        // The lengths are read after the fixture because they name its reflectors; the lists of names and problems keep
        // the order of the documentation.
        std::optional<File> lengths = open(lengths_name);
        std::optional<File> stations = open(stations_name);
        std::optional<File> environment = open(environment_name);
        std::optional<File> coordinates = open(fixture_name);
        std::optional<File> covariance = open(covariance_name);
        std::optional<File> machine_points = machine ? open(machine->coordinates) : std::nullopt;
        std::optional<File> readings = open(readings_name);
        std::optional<File> description = open(description_name);
        if (coordinates) {
            read_fixture(std::move(*coordinates));
            if (job_.plan && !reflectors_.names().empty()) {
                check_facing(*job_.plan, reflectors_.names(), problems);
            }
        }
        job_.exclusions = read_exclusions(*document, *root, problems);
        if (lengths) {
            read_lengths(std::move(*lengths), *root);
        }
        if (stations) {
            read_stations(std::move(*stations));
        }
        if (!job_.has_lengths) {
            read_layout(*root, *observations);
        }
        check_home_of_plan(*root);
        check_sizes(*root);
        if (lengths_are_whole_) {
            check_reversal(*root);
        }
        if (environment) {
            read_environment(std::move(*environment));
        } else {
            const auto count = static_cast<Eigen::Index>(stations_.size());
            job_.measurement.temperature_difference = Eigen::VectorXd::Zero(count);
            job_.measurement.u_temperature = Eigen::VectorXd::Zero(count);
        }
        if (covariance) {
            read_covariance(*covariance);
        }
        if (machine_points) {
            read_frame_of_machine(*root, std::move(*machine), std::move(*machine_points));
        }
        if (reference) {
            ReferenceMethod& method = job_.reference.emplace();
            method.name = reference_name.value_or("");
            bool readings_are_whole = false;
            if (readings) {
                const std::size_t refused = readings->problems->refusals();
                const ProblemList& of_readings = *readings->problems;
                read_readings(std::move(*readings), method);
                readings_are_whole = of_readings.refusals() == refused && lengths_are_whole_;
            }
            if (description) {
                read_indicator(*description, method, reference->has("budget"));
            }
            read_reference_correlation(*reference, method);
            read_published(*reference, method, readings_are_whole);
            read_audited(*reference, method);
            read_budget_of_reference(reference_budget_name, readings_are_whole);
        }
        job_.certificate = read_certificate(files_, *document, problems);
        read_fixture_budget(budget_name);
        job_.document = std::move(document->value);
    }

    void read_common(const JsonDocument& document, const JsonObject& root) {
        if (root.has("title")) {
            job_.title = root.optional_name("title", 1000).value_or("");
        }
        const NumberRange probability{.low = 0.0,
                                      .high = 1.0,
                                      .low_open = true,
                                      .high_open = true,
                                      .hint = "state a probability, not a percentage, such as 0.9545"};
        job_.coverage_probability = root.optional_number("coverage_probability", probability).value_or(0.9545);
        read_unused_texts(root);
        job_.monte_carlo = read_monte_carlo(root, job_.coverage_probability, k_validated_digits, *problems_);
        job_.coverage =
            root.optional_choice("coverage", gum::k_coverage_choices).value_or(gum::CoverageChoice::as_validated);
        if (job_.coverage == gum::CoverageChoice::monte_carlo && !job_.monte_carlo && !root.has("monte_carlo")) {
            job_.monte_carlo = automatic_monte_carlo(root.where("coverage"));
        }
        job_.simulation = read_simulation(root, *problems_);
        job_.plan = read_plan(document, root, *problems_);
    }

    void read_options(const JsonObject& root) {
        RotaryTableMeasurement& measurement = job_.measurement;
        measurement.axis = root.required_choice<RotaryAxis>("axis", k_axes).value_or(RotaryAxis::a);
        measurement.datum = root.optional_choice<Datum>("datum", k_datums).value_or(Datum::axis_average_line);
        measurement.method =
            root.optional_choice<AdjustmentMethod>("method", k_methods).value_or(AdjustmentMethod::joint);
        measurement.reversal =
            root.optional_choice<ReversalModel>("reversal", k_reversals).value_or(ReversalModel::automatic);
        home_angle_deg_ = root.optional_number("home_angle_deg", k_angle);
        if (!root.has("home_angle_deg")) {
            home_angle_deg_ = 0.0;
        }
        if (const auto object = root.required_object("length_uncertainty", k_length_uncertainty_keys)) {
            read_length_uncertainty(*object);
        }
        if (const auto object = root.optional_object("table_repeatability", k_repeatability_keys)) {
            read_repeatability(*object);
        }
        const bool default_estimate = measurement.table_repeatability.mode == RepeatabilityMode::estimate;
        measurement.estimate_length_noise =
            root.optional_choice<bool>("variance_components", k_variance_components).value_or(default_estimate);
        if (const auto object = root.optional_object("outliers", k_outliers_keys)) {
            OutlierOptions& outliers = measurement.outliers;
            outliers.test = object->optional_choice<OutlierTest>("test", k_tests).value_or(outliers.test);
            const NumberRange alpha{.low = 0.0,
                                    .high = 0.5,
                                    .low_open = true,
                                    .high_open = true,
                                    .hint = "state the probability of flagging a good distance, such as 0.0001"};
            outliers.alpha = object->optional_number("alpha", alpha).value_or(outliers.alpha);
            outliers.action = object->optional_choice<OutlierAction>("action", k_actions).value_or(outliers.action);
        }
    }

    void read_length_uncertainty(const JsonObject& object) {
        LengthUncertainty& uncertainty = job_.measurement.length_uncertainty;
        const auto constant = object.required_number("u_constant_um", between(0.0, k_most_u, "µm"));
        const auto proportional = object.optional_number("u_proportional_um_per_m", between(0.0, k_most_u, "µm/m"));
        const bool proportional_is_zero =
            !object.has("u_proportional_um_per_m") || (proportional && *proportional == 0.0);
        if (constant && *constant < k_least_u && proportional_is_zero) {
            object.refuse(
                k_no_length_uncertainty, "u_constant_um",
                "u_constant_um is " + text::shortest_plain(*constant) + " µm, and u_proportional_um_per_m is 0 µm/m",
                "the standard uncertainty of a length must be greater than 0, and at least " +
                    text::shortest_plain(k_least_u) + " µm where it does not grow with the distance",
                "state the standard uncertainty of a length");
        }
        uncertainty.u_constant = constant.value_or(0.0) * k_micrometre;
        uncertainty.u_proportional = proportional.value_or(0.0) * k_micrometre;
        uncertainty.resolution =
            object.optional_number("resolution_um", not_negative("µm")).value_or(0.0) * k_micrometre;
        // A relative uncertainty of 1 % and more is a value in ppm or percent by mistake.
        const NumberRange relative{
            .low = 0.0,
            .high = 0.01,
            .low_open = true,
            .hint = "state it as a ratio: 0.15 ppm is 1.5e-7; leave it out if the scale is fixed"};
        const auto scale = object.optional_number("scale_u", relative);
        uncertainty.u_scale = scale.value_or(0.0);
        const ScaleModel default_model = object.has("scale_u") ? ScaleModel::prior : ScaleModel::fixed;
        uncertainty.scale_model =
            object.optional_choice<ScaleModel>("scale_model", k_scale_models).value_or(default_model);
        if (uncertainty.scale_model == ScaleModel::prior && !object.has("scale_u")) {
            object.refuse(k_scale_without_u, "scale_model", "scale_model is \"prior\" and scale_u is missing",
                          "a prior on the scale needs its standard uncertainty",
                          "add \"scale_u\", or choose \"fixed\" or \"free\"");
        }
        if (uncertainty.scale_model != ScaleModel::prior && scale) {
            problems_->warn(k_warn_unused_value, object.where("scale_u"),
                            "scale_u " + text::shortest_plain(*scale) + " is not used",
                            "it belongs to scale_model \"prior\"", "remove it, or choose \"prior\"");
        }
    }

    void read_repeatability(const JsonObject& object) {
        TableRepeatability& repeatability = job_.measurement.table_repeatability;
        repeatability.mode =
            object.optional_choice<RepeatabilityMode>("mode", k_modes).value_or(RepeatabilityMode::estimate);
        const bool is_given = repeatability.mode == RepeatabilityMode::given;
        bool any = false;
        bool all_read = true;
        const auto read = [&](std::string_view key, std::string_view unit, double factor) {
            const auto value = is_given ? object.required_number(key, not_negative(unit))
                                        : object.optional_number(key, not_negative(unit));
            any = any || value.value_or(0.0) > 0.0;
            all_read = all_read && (value || !object.has(key)) && (value || !is_given);
            if (repeatability.mode == RepeatabilityMode::none && value) {
                problems_->warn(
                    k_warn_unused_value, object.where(key),
                    std::string{key} + " " + text::shortest_plain(*value) + " " + std::string{unit} + " is not used",
                    "with mode \"none\" the table has no uncertainty of repeatability",
                    "remove it, or choose mode \"given\"");
            }
            return value.value_or(0.0) * factor;
        };
        repeatability.u_linear = read("u_linear_um", "µm", k_micrometre);
        repeatability.u_axial = read("u_axial_arcsec", "″", k_arcsecond);
        repeatability.u_tilt = read("u_tilt_arcsec", "″", k_arcsecond);
        if (is_given && all_read && !any) {
            object.refuse(k_no_repeatability, "mode", "mode is \"given\", and every standard uncertainty is 0",
                          "at least one must be greater than 0", "state the repeatability, or choose mode \"none\"");
        }
    }

    void read_fixture_options(const JsonObject& fixture, bool has_environment) {
        job_.reference_temperature_degC =
            fixture.optional_number("reference_temperature_degC", k_temperature).value_or(20.0);
        if (has_environment) {
            fixture.require("thermal_expansion_per_K");
        }
        if (const auto expansion = fixture.optional_object("thermal_expansion_per_K", k_expansion_keys)) {
            NumberRange coefficient = between(0.0, 1e-3, "1/K");
            coefficient.hint = "check the unit: steel has about 1.15e-5 1/K";
            job_.measurement.expansion = expansion->required_number("value", coefficient).value_or(0.0);
            job_.measurement.u_expansion = expansion->required_number("u", coefficient).value_or(0.0);
            job_.measurement.expansion_shape =
                expansion->optional_choice<InputShape>("distribution", k_shapes).value_or(InputShape::normal);
        }
        job_.measurement.fixture_component =
            fixture.optional_choice<FixtureComponent>("variance_component", k_fixture_components)
                .value_or(FixtureComponent::check);
        job_.measurement.fixture_shape =
            fixture.optional_choice<InputShape>("distribution", k_shapes).value_or(InputShape::normal);
        job_.source_paper_fixture =
            fixture.optional_choice<bool>("uncertainty", k_fixture_uncertainties).value_or(false);
        u_is_elsewhere_ = job_.source_paper_fixture || fixture.has("budget");
        refuse_second_uncertainty(fixture);
    }

    /// The uncertainty of the fixture comes from one place: columns, covariance, budget or the equation of the paper.
    void refuse_second_uncertainty(const JsonObject& fixture) const {
        std::vector<std::pair<std::string_view, std::string>> sources;
        if (job_.source_paper_fixture) {
            sources.emplace_back("uncertainty", "\"uncertainty\": \"source_paper\"");
        }
        for (const std::string_view key : {"covariance", "budget"}) {
            if (fixture.has(key)) {
                sources.emplace_back(key, text::in_quotes(key));
            }
        }
        if (job_.measurement.fixture_shape == InputShape::uniform) {
            sources.emplace_back("distribution", "\"distribution\": \"uniform\"");
        }
        for (std::size_t i = 1; i < sources.size(); ++i) {
            const bool is_shape = sources[i].first == "distribution";
            fixture.refuse(k_fixture_keys_exclude, sources[i].first,
                           sources[i].second + " is given beside " + sources.front().second,
                           is_shape ? "a uniform distribution belongs to uncorrelated coordinates with the standard "
                                      "uncertainties of the coordinates file"
                                    : "the uncertainty of the fixture comes from a covariance, a budget or the "
                                      "source paper",
                           "keep one of them");
        }
    }

    void read_temperature_shape(const JsonObject& observations) {
        const auto shape = observations.optional_choice<InputShape>("temperature_distribution", k_shapes);
        job_.measurement.temperature_shape = shape.value_or(InputShape::normal);
        if (shape && !observations.has("environment")) {
            problems_->warn(k_warn_unused_value, observations.where("temperature_distribution"),
                            "temperature_distribution is not used", "it belongs to the environment file",
                            "remove it, or add \"environment\"");
        }
    }

    // ---- fixture ----------------------------------------------------------------------------------------------------

    void read_fixture(File&& file) {
        enum : std::size_t { reflector, x, u_x = 4 };
        static constexpr std::array<std::string_view, 7> k_columns{"reflector", "x_mm",   "y_mm",  "z_mm",
                                                                   "u_x_um",    "u_y_um", "u_z_um"};
        const Words columns(k_columns);
        fixture_table_ = u_is_elsewhere_ ? read_csv_table(std::move(file.bytes), columns.first(u_x),
                                                          columns.subspan(u_x), *file.problems)
                                         : read_csv_table(std::move(file.bytes), columns, {}, *file.problems);
        if (!fixture_table_) {
            return;
        }
        const CsvTable& table = *fixture_table_;
        if (table.rows() > k_most_reflectors) {
            file.problems->refuse(k_too_many_reflectors, table.where(table.cell(k_most_reflectors, reflector)),
                                  plural(table.rows(), "reflector"),
                                  "a fixture has at most " + std::to_string(k_most_reflectors) + " reflectors",
                                  "check that the file is the fixture file");
            return;
        }
        const auto count = static_cast<Eigen::Index>(table.rows());
        Eigen::MatrixX3d coordinates = Eigen::MatrixX3d::Zero(count, 3);
        Eigen::VectorXd stated_u = Eigen::VectorXd::Zero(3 * count);
        std::vector<std::size_t> lines;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const auto r = static_cast<Eigen::Index>(row);
            if (const auto name = table.name(row, reflector)) {
                const std::size_t line = table.cell(row, reflector).line;
                if (const auto known = reflectors_.find(*name)) {
                    refuse_repeated_name(table, row, reflector, "reflector", lines[*known], *file.problems);
                } else {
                    reflectors_.index(*name);
                    lines.push_back(line);
                }
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const auto column = static_cast<Eigen::Index>(k);
                coordinates(r, column) = table.number(row, x + k, k_fixture_coordinate).value_or(0.0);
                const auto u = u_is_elsewhere_ ? table.number_if_any(row, u_x + k, above_zero("µm"))
                                               : table.number(row, u_x + k, above_zero("µm"));
                stated_u(3 * r + column) = u.value_or(0.0) * k_micrometre;
            }
        }
        if (file.problems->refusals() > 0) {
            return;
        }
        if (coordinates.cwiseAbs().maxCoeff() < 1.0) {
            file.problems->refuse(k_coordinates_in_metres, table.where(table.cell(0, x)),
                                  "no coordinate reaches 1 mm; the largest is " +
                                      text::shortest_plain(coordinates.cwiseAbs().maxCoeff()) + " mm",
                                  "coordinates are in millimetres", "multiply by 1000 if the values are metres");
        }
        job_.measurement.reflectors = reflectors_.names();
        job_.measurement.fixture = coordinates * k_millimetre;
        if (!u_is_elsewhere_) {
            job_.measurement.fixture_covariance = stated_u.array().square().matrix().asDiagonal();
        } else {
            Eigen::VectorXd variances = Eigen::VectorXd::Zero(3 * count);
            for (Eigen::Index i = 0; job_.source_paper_fixture && i < variances.size(); ++i) {
                variances(i) = std::pow(source_paper_fixture_uncertainty(job_.measurement.fixture(i / 3, i % 3)), 2);
            }
            job_.measurement.fixture_covariance = variances.asDiagonal();
            if (stated_u.maxCoeff() > 0.0) {
                job_.stated_fixture_u = stated_u;
            }
        }
        fixture_is_whole_ = true;
    }

    static void refuse_repeated_name(const CsvTable& table, std::size_t row, std::size_t column,
                                     const std::string& what, std::size_t first_line, ProblemList& problems) {
        const CsvCell& cell = table.cell(row, column);
        problems.refuse(k_repeated_name, table.where(cell),
                        "the " + what + " " + text::in_quotes(cell.text) + " has a second row, the first is line " +
                            std::to_string(first_line),
                        "every " + what + " has one row", "remove or rename one of the two");
    }

    void read_covariance(const File& file) {
        // Without a fixture the order of the matrix is not known.
        if (!fixture_is_whole_) {
            return;
        }
        const std::size_t order = 3 * reflectors_.size();
        const std::optional<Eigen::MatrixXd> matrix = read_csv_matrix(file.bytes, order, "µm²", *file.problems);
        if (!matrix) {
            return;
        }
        const std::string& name = file.problems->file();
        const auto element = [&](Eigen::Index i, Eigen::Index j) {
            return "element (" + std::to_string(i + 1) + ", " + std::to_string(j + 1) + ")";
        };
        const std::size_t problems_before = file.problems->refusals();
        for (Eigen::Index i = 0; i < matrix->rows(); ++i) {
            if (!((*matrix)(i, i) > 0.0)) {
                file.problems->refuse(k_covariance_not_positive, where_in_row(name, i),
                                      element(i, i) + " is " + text::shortest_plain((*matrix)(i, i)) + " µm²",
                                      "a variance must be greater than 0", "correct the matrix");
            }
            for (Eigen::Index j = 0; j < i; ++j) {
                const double a = (*matrix)(i, j);
                const double b = (*matrix)(j, i);
                // A few last digits may differ in a matrix that another program computed.
                const double scale = std::sqrt(std::abs((*matrix)(i, i)) * std::abs((*matrix)(j, j)));
                if (!(std::abs(a - b) <= 1e-9 * std::max({scale, std::abs(a), std::abs(b)}))) {
                    file.problems->refuse(k_covariance_not_symmetric, where_in_row(name, i),
                                          element(i, j) + " is " + text::shortest_plain(a) + " µm², " + element(j, i) +
                                              " is " + text::shortest_plain(b) + " µm²",
                                          "a covariance matrix is symmetric", "correct the matrix");
                }
            }
        }
        if (file.problems->refusals() != problems_before) {
            return;
        }
        const Eigen::MatrixXd symmetric = 0.5 * (*matrix + matrix->transpose());
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
        const double smallest = solver.eigenvalues().minCoeff();
        const double largest = solver.eigenvalues().maxCoeff();
        const double rounding = 10.0 * static_cast<double>(order) * std::numeric_limits<double>::epsilon() * largest;
        if (solver.info() != Eigen::Success || !std::isfinite(largest) || !(smallest >= -rounding)) {
            file.problems->refuse(k_covariance_not_positive, text::visible(name),
                                  "the smallest eigenvalue is " + text::shortest_plain(smallest) +
                                      " µm², the largest " + text::shortest_plain(largest) + " µm²",
                                  "a covariance matrix is positive semi-definite",
                                  "correct the matrix, and give it with all its digits");
            return;
        }
        const Eigen::MatrixXd si = symmetric * (k_micrometre * k_micrometre);
        const Eigen::VectorXd from_columns = job_.measurement.fixture_covariance.diagonal();
        for (Eigen::Index i = 0; i < si.rows(); ++i) {
            const double ratio = std::sqrt(si(i, i) / from_columns(i));
            if (std::abs(ratio - 1.0) > 0.01) {
                file.problems->warn(k_warn_covariance_differs, where_in_row(name, i),
                                    "u from the covariance is " + text::shortest_plain(std::sqrt(symmetric(i, i))) +
                                        " µm, from the column of the fixture file " +
                                        text::shortest_plain(std::sqrt(from_columns(i)) / k_micrometre) + " µm",
                                    "the covariance is used", "correct whichever is wrong");
            }
        }
        job_.measurement.fixture_covariance = si;
    }

    static std::string where_in_row(const std::string& file, Eigen::Index row) {
        return text::visible(file) + " (row " + std::to_string(row + 1) + ")";
    }

    /// The budget job with all its files; its problems are told with the others.
    void read_fixture_budget(const std::optional<std::string>& name) {
        const std::optional<File> file = open(name);
        if (!file) {
            return;
        }
        job_.fixture_budget_file = *name;
        try {
            auto budget = std::make_shared<const BudgetJob>(read_budget_job(source_, file->problems->file()));
            files_.add(budget->files, budget->warnings);
            if (fixture_is_whole_) {
                check_points(*budget, *file->problems);
            }
            job_.fixture_budget = std::move(budget);
        } catch (const gum::InputError& error) {
            files_.add(error);
        } catch (const gum::StorageError& error) {
            files_.add(error);
        }
    }

    void check_points(const BudgetJob& budget, ProblemList& problems) const {
        const std::string where = text::visible(problems.file()) + "#/points";
        std::vector<std::string> expected;
        for (const std::string& reflector : reflectors_.names()) {
            for (std::size_t k = 0; k < 3; ++k) {
                expected.push_back(fixture_coordinate_name(reflector, k));
            }
        }
        const std::string rule = "the budget of the fixture has one point for each coordinate, \"" + expected.front() +
                                 "\" to \"" + expected.back() + "\"";
        if (budget.points.empty()) {
            problems.refuse(k_fixture_budget_points, where, "the budget has no points", rule, "add \"points\"");
            return;
        }
        std::vector<std::string> stated;
        for (const gum::BudgetPoint& point : budget.points) {
            stated.push_back(point.name);
        }
        std::vector<std::string> sorted_expected = expected;
        std::vector<std::string> sorted_stated = stated;
        std::sort(sorted_expected.begin(), sorted_expected.end());
        std::sort(sorted_stated.begin(), sorted_stated.end());
        for (const std::string& name : expected) {
            if (!std::binary_search(sorted_stated.begin(), sorted_stated.end(), name)) {
                problems.refuse(k_fixture_budget_points, where,
                                "the coordinate " + text::in_quotes(name) + " has no point", rule,
                                "add the point, or correct its name");
            }
        }
        for (const std::string& name : stated) {
            if (!std::binary_search(sorted_expected.begin(), sorted_expected.end(), name)) {
                problems.refuse(k_fixture_budget_points, where,
                                "the point " + text::in_quotes(name) + " is no coordinate of the fixture file", rule,
                                "remove the point, or correct its name");
            }
        }
    }

    // ---- lengths ----------------------------------------------------------------------------------------------------

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

    void read_lengths(File&& file, const JsonObject& root) {
        static constexpr std::array<std::string_view, 7> k_columns{"station",   "reflector", "pass",     "direction",
                                                                   "angle_deg", "length_mm", "dead_path"};
        static constexpr std::array<std::string_view, 2> k_directions{"+", "-"};
        static constexpr std::array<std::string_view, 1> k_more_columns{"time_s"};
        lengths_table_ = read_csv_table(std::move(file.bytes), k_columns, k_more_columns, *file.problems);
        if (!lengths_table_) {
            return;
        }
        const CsvTable& table = *lengths_table_;
        ProblemList& problems = *file.problems;
        std::vector<Row> rows;
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
                stations_.index(*station);
            }
            if (station && reflector && pass && direction && angle && length && dead_path && time) {
                rows.push_back({i, stations_.index(*station), lengths_reflectors_.index(*reflector),
                                passes_.index(*pass), dead_paths_.index(*dead_path), *direction, *angle, *length, 0,
                                *time});
            }
        }
        refuse_idle_exclusions();
        if (rows.empty() && problems.refusals() == 0) {
            problems.refuse(k_bad_exclusion, root.where("exclude"), "every distance is left out",
                            "a measurement has distances", "leave some in");
        }
        lengths_are_whole_ = problems.refusals() == 0;
        first_row_of_station_.assign(stations_.size(), 0);
        for (std::size_t i = table.rows(); i-- > 0;) {
            if (const auto known = stations_.find(table.cell(i, c_station).text)) {
                first_row_of_station_[*known] = i;
            }
        }
        find_angles(rows);
        check_reflectors(rows, problems);
        check_passes(rows, problems);
        check_dead_paths(rows, problems);
        check_repeated(rows, problems);
        // What follows counts rows or compares all of them: rows that were refused above would be missed twice.
        if (lengths_are_whole_) {
            check_counts(rows, problems);
            check_units_and_span(rows, root, problems);
        }
        store_lengths(rows);
    }

    /// Counts the distance for the first entry that names it.
    bool is_excluded(const ExclusionKeys& distance) {
        bool excluded = false;
        for (std::size_t i = 0; i < job_.exclusions.size(); ++i) {
            if (selects(job_.exclusions[i], distance)) {
                job_.exclusions[i].count += excluded ? std::size_t{0} : std::size_t{1};
                excluded = true;
            }
        }
        return excluded;
    }

    void refuse_idle_exclusions() const {
        for (const Exclusion& exclusion : job_.exclusions) {
            if (exclusion.count == 0) {
                problems_->refuse(k_bad_exclusion, exclusion.where,
                                  "no distance of the lengths file agrees with it that an entry before it does not "
                                  "leave out",
                                  "an entry of \"exclude\" leaves out at least one distance",
                                  "correct it, or remove it");
            }
        }
    }

    void find_angles(std::vector<Row>& rows) {
        std::vector<double> all;
        all.reserve(rows.size());
        std::transform(rows.begin(), rows.end(), std::back_inserter(all), [](const Row& row) { return row.angle_deg; });
        std::sort(all.begin(), all.end());
        for (const double angle : all) {
            if (angles_deg_.empty() || angle - angles_deg_.back() > k_same_angle_deg) {
                angles_deg_.push_back(angle);
            }
        }
        for (Row& row : rows) {
            const auto above = std::upper_bound(angles_deg_.begin(), angles_deg_.end(), row.angle_deg);
            row.angle = static_cast<std::size_t>(above - angles_deg_.begin()) - 1;
        }
    }

    /// The index of an angle of another file among the measured ones.
    [[nodiscard]] std::optional<std::size_t> angle_index(double angle_deg) const {
        const auto found = std::lower_bound(angles_deg_.begin(), angles_deg_.end(), angle_deg - k_same_angle_deg);
        if (found == angles_deg_.end() || std::abs(*found - angle_deg) > k_same_angle_deg) {
            return std::nullopt;
        }
        return static_cast<std::size_t>(found - angles_deg_.begin());
    }

    [[nodiscard]] std::string where(const Row& row, LengthsColumn column) const {
        return lengths_table_->where(lengths_table_->cell(row.table_row, column));
    }
    [[nodiscard]] std::string line_of(const Row& row) const {
        return "line " + std::to_string(lengths_table_->cell(row.table_row, c_station).line);
    }

    void check_reflectors(const std::vector<Row>& rows, ProblemList& problems) const {
        if (!fixture_is_whole_) {
            return;
        }
        std::vector<std::size_t> count(lengths_reflectors_.size(), 0);
        std::vector<const Row*> first(lengths_reflectors_.size(), nullptr);
        for (const Row& row : rows) {
            if (count[row.reflector]++ == 0) {
                first[row.reflector] = &row;
            }
        }
        const std::vector<std::string>& fixture_names = reflectors_.names();
        const std::vector<std::string_view> known(fixture_names.begin(), fixture_names.end());
        for (std::size_t i = 0; i < count.size(); ++i) {
            const std::string& name = lengths_reflectors_.names()[i];
            if (reflectors_.find(name)) {
                continue;
            }
            const std::optional<std::string_view> nearest = nearest_word(name, known);
            problems.refuse(k_unknown_reflector, where(*first[i], c_reflector),
                            "the reflector " + text::in_quotes(name) + " (" + plural(count[i], "row") +
                                ") is not in the fixture file",
                            "every reflector has coordinates in the fixture file",
                            nearest ? "is it " + text::in_quotes(*nearest) + "? Else add it to the fixture file"
                                    : "add it to the fixture file, or remove its rows");
        }
        for (std::size_t i = 0; i < fixture_names.size(); ++i) {
            if (!lengths_reflectors_.find(fixture_names[i])) {
                problems.warn(
                    k_warn_unused_reflector, text::visible(problems.file()),
                    "the reflector " + text::in_quotes(fixture_names[i]) + " of the fixture file has no distance",
                    "reflectors are measured", "check that no rows are missing");
            }
        }
    }

    void check_passes(const std::vector<Row>& rows, ProblemList& problems) const {
        std::vector<const Row*> first(passes_.size(), nullptr);
        std::vector<bool> told(passes_.size(), false);
        static constexpr std::array<const char*, 2> k_signs{"+", "-"};
        for (const Row& row : rows) {
            const Row*& other = first[row.pass];
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
                                pass + " has station " + text::in_quotes(stations_.names()[row.station]) +
                                    " here and " + text::in_quotes(stations_.names()[other->station]) + " in " +
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

    void check_dead_paths(const std::vector<Row>& rows, ProblemList& problems) const {
        std::vector<const Row*> first(dead_paths_.size(), nullptr);
        std::vector<bool> told(dead_paths_.size(), false);
        for (const Row& row : rows) {
            const Row*& other = first[row.dead_path];
            if (other == nullptr) {
                other = &row;
            } else if (other->station != row.station && !told[row.dead_path]) {
                told[row.dead_path] = true;
                problems.refuse(k_dead_path_of_two_stations, where(row, c_dead_path),
                                "the dead path " + text::in_quotes(dead_paths_.names()[row.dead_path]) +
                                    " has station " + text::in_quotes(stations_.names()[row.station]) + " here and " +
                                    text::in_quotes(stations_.names()[other->station]) + " in " + line_of(*other),
                                "a dead path belongs to one station", "give every station dead paths of its own");
            }
        }
    }

    void check_repeated(const std::vector<Row>& rows, ProblemList& problems) const {
        const auto key = [&](const Row* row) {
            return std::tuple(row->station, row->reflector, row->pass, row->angle);
        };
        std::vector<std::pair<decltype(key(nullptr)), const Row*>> sorted;
        sorted.reserve(rows.size());
        for (const Row& row : rows) {
            sorted.emplace_back(key(&row), &row);
        }
        std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::pair<const Row*, const Row*>> repeated;  // second one, first one
        const Row* first = nullptr;
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
                            "the distance of station " + text::in_quotes(stations_.names()[row->station]) +
                                ", reflector " + text::in_quotes(lengths_reflectors_.names()[row->reflector]) +
                                ", pass " + text::in_quotes(passes_.names()[row->pass]) + ", " +
                                text::shortest_plain(row->angle_deg) + "° occurs a second time, the first is " +
                                line_of(*earlier),
                            "station, reflector, pass and angle occur together once",
                            "remove one of the two, or give the repetition a pass of its own");
        }
    }

    void check_counts(const std::vector<Row>& rows, ProblemList& problems) const {
        std::vector<std::size_t> at_angle(angles_deg_.size(), 0);
        std::vector<const Row*> first_at_angle(angles_deg_.size(), nullptr);
        std::vector<std::size_t> of_station(stations_.size(), 0);
        for (const Row& row : rows) {
            if (at_angle[row.angle]++ == 0) {
                first_at_angle[row.angle] = &row;
            }
            ++of_station[row.station];
        }
        for (std::size_t i = 0; i < at_angle.size(); ++i) {
            if (at_angle[i] < k_least_at_angle) {
                problems.refuse(
                    k_too_few_at_angle, where(*first_at_angle[i], c_angle),
                    plural(at_angle[i], "distance") + " at the angle " + text::shortest_plain(angles_deg_[i]) + "°",
                    "a pose has six unknowns: every angle needs at least 6 distances",
                    "add distances, or remove the angle");
            }
        }
        for (std::size_t i = 0; i < of_station.size(); ++i) {
            if (of_station[i] < k_least_of_station) {
                problems.refuse(
                    k_too_few_of_station, where_station_appears(i),
                    plural(of_station[i], "distance") + " of the station " + text::in_quotes(stations_.names()[i]),
                    "a station has four unknowns (x, y, z and a dead path): it needs at least 4 distances",
                    "add distances, or remove the station");
            }
        }
        if (lengths_reflectors_.size() < k_least_reflectors) {
            problems.refuse(k_too_few_reflectors, where(rows.front(), c_reflector),
                            plural(lengths_reflectors_.size(), "reflector"),
                            "the pose of the table needs at least 3 reflectors", "measure further reflectors");
        }
    }

    void check_units_and_span(const std::vector<Row>& rows, const JsonObject& root, ProblemList& problems) const {
        const auto longest = std::max_element(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
            return std::abs(a.length_mm) < std::abs(b.length_mm);
        });
        if (std::abs(longest->length_mm) < 10.0) {
            problems.refuse(
                k_lengths_in_metres, where(*longest, c_length),
                "no length reaches 10 mm; the longest is " + text::shortest_plain(longest->length_mm) + " mm",
                "lengths are in millimetres", "multiply by 1000 if the values are metres");
        }
        check_angles(root, where(rows.front(), c_angle), text::visible(problems.file()), problems);
    }

    /// \param where_angles  place of the first angle
    /// \param where_all  place for a warning of all angles
    void check_angles(const JsonObject& root, const std::string& where_angles, const std::string& where_all,
                      ProblemList& problems) const {
        if (look_like_radians(angles_deg_)) {
            problems.refuse(k_angles_in_radians, where_angles,
                            plural(angles_deg_.size(), "angle") + " from " + text::shortest_plain(angles_deg_.front()) +
                                " to " + text::shortest_plain(angles_deg_.back()) +
                                " are multiples of half a degree when they are taken as radians",
                            "angles are in degrees", "convert the angles to degrees");
            return;
        }
        const double span = angles_deg_.back() - angles_deg_.front();
        if (span < 180.0) {
            problems.warn(
                k_warn_angle_span, where_all,
                "the angles span " + text::shortest_plain(span) + "°, from " +
                    text::shortest_plain(angles_deg_.front()) + "° to " + text::shortest_plain(angles_deg_.back()) +
                    "°",
                "below half a turn, set-up errors and the first harmonics of the error motions are poorly separated",
                "measure over a full turn if the table allows it");
        }
        warn_of_same_positions(angles_deg_, text::visible(problems.file()), problems);
        if (home_angle_deg_ && !angle_index(*home_angle_deg_)) {
            const bool measured = job_.has_lengths;
            root.refuse(k_home_not_measured, "home_angle_deg",
                        home_angle(root) + (measured ? " has no distance" : " is not planned"),
                        std::string("the home angle is one of the ") + (measured ? "measured" : "planned") + " angles",
                        std::string("state a home_angle_deg that ") + (measured ? "was measured" : "is planned") +
                            ", from " + text::shortest_plain(angles_deg_.front()) + "° to " +
                            text::shortest_plain(angles_deg_.back()) + "°");
        }
    }

    [[nodiscard]] std::string home_angle(const JsonObject& root) const {
        return "the home angle " + text::shortest_plain(*home_angle_deg_) + "°" +
               (root.has("home_angle_deg") ? "" : " (the default)");
    }

    /// A plan beside measured lengths has angles of its own; home is one of them, too.
    void check_home_of_plan(const JsonObject& root) const {
        if (!job_.has_lengths || !job_.plan || job_.plan->angles_deg.empty() || !home_angle_deg_) {
            return;
        }
        const std::vector<double>& planned = job_.plan->angles_deg;
        if (std::none_of(planned.begin(), planned.end(),
                         [&](double angle) { return std::abs(angle - *home_angle_deg_) <= k_same_angle_deg; })) {
            root.refuse(k_home_not_measured, "plan", home_angle(root) + " is not among the angles of plan",
                        "the home angle is one of the planned angles", "add it to plan.angles_deg");
        }
    }

    // ---- a layout without lengths -----------------------------------------------------------------------------------

    /// Stations from their file and angles from the plan; distances are not there yet.
    void read_layout(const JsonObject& root, const JsonObject& observations) {
        const char* rule = "a layout that was not measured is described by the stations file and plan.angles_deg";
        if (!observations.has("stations")) {
            observations.refuse(k_layout_incomplete, "stations", "neither lengths nor stations are given", rule,
                                "add \"stations\", or \"lengths\" if there are some");
        }
        if (!job_.plan || job_.plan->angles_deg.empty()) {
            // Angles that were refused are told already.
            const nlohmann::json* plan = root.find("plan");
            if (plan == nullptr || (plan->is_object() && !plan->contains("angles_deg"))) {
                root.refuse(k_layout_incomplete, "plan", "neither lengths nor planned angles are given", rule,
                            "add \"plan\": {\"angles_deg\": {\"first\": 0, \"step\": 10, \"count\": 36}}");
            }
            return;
        }
        angles_deg_ = job_.plan->angles_deg;
        lengths_are_whole_ = true;
        store_angles();
        check_angles(root, root.where("plan"), root.where("plan"), *problems_);
        if (!stations_table_ || !fixture_is_whole_) {
            return;
        }
        const std::size_t at_angle = stations_.size() * reflectors_.size();
        if (at_angle < k_least_at_angle) {
            root.refuse(k_too_few_at_angle, "observations",
                        plural(stations_.size(), "station") + " and " + plural(reflectors_.size(), "reflector"),
                        "a pose has six unknowns: every angle needs at least 6 distances",
                        "add stations or reflectors");
        }
        if (reflectors_.size() < k_least_reflectors) {
            root.refuse(k_too_few_reflectors, "fixture", plural(reflectors_.size(), "reflector"),
                        "the pose of the table needs at least 3 reflectors", "add further reflectors");
        }
    }

    /// What is planned or simulated must fit into memory as a measurement does.
    void check_sizes(const JsonObject& root) const {
        const auto check = [&](std::string_view key, std::size_t angles, std::size_t senses) {
            const double distances = static_cast<double>(stations_.size() * reflectors_.size()) *
                                     static_cast<double>(angles) * static_cast<double>(senses);
            if (distances > k_most_distances) {
                root.refuse(k_layout_too_large, key, text::shortest_plain(distances) + " distances",
                            "a layout has at most " + text::shortest_plain(k_most_distances) + " distances",
                            "state fewer angles");
            }
        };
        if (job_.plan) {
            check("plan", job_.plan->angles_deg.size(), job_.plan->both_senses ? 2 : 1);
        }
        if (job_.simulation && !job_.simulation->angle_counts.empty()) {
            check("simulation",
                  *std::max_element(job_.simulation->angle_counts.begin(), job_.simulation->angle_counts.end()), 2);
        }
    }

    void store_angles() {
        job_.measurement.angles_deg = angles_deg_;
        for (const double angle : angles_deg_) {
            job_.measurement.angles.push_back(angle * k_degree);
        }
        job_.measurement.home = angle_index(home_angle_deg_.value_or(0.0)).value_or(0);
    }

    [[nodiscard]] std::string where_station_appears(std::size_t station) const {
        const CsvTable& table = job_.has_lengths ? *lengths_table_ : *stations_table_;
        return table.where(table.cell(first_row_of_station_[station], c_station));
    }

    void store_lengths(const std::vector<Row>& rows) {
        RotaryTableMeasurement& measurement = job_.measurement;
        measurement.stations = stations_.names();
        measurement.passes = passes_.names();
        measurement.dead_paths = dead_paths_.names();
        measurement.station_start.assign(stations_.size(), std::nullopt);
        store_angles();
        measurement.lengths.reserve(rows.size());
        for (const Row& row : rows) {
            LengthObservation observation;
            observation.station = row.station;
            observation.reflector = reflectors_.find(lengths_reflectors_.names()[row.reflector]).value_or(0);
            observation.pass = row.pass;
            observation.angle = row.angle;
            observation.dead_path = row.dead_path;
            observation.approach = row.direction == 0 ? Approach::positive : Approach::negative;
            observation.length = row.length_mm * k_millimetre;
            observation.line = lengths_table_->cell(row.table_row, c_station).line;
            measurement.lengths.push_back(observation);
            if (lengths_table_->has_column(c_time)) {
                measurement.times.push_back(row.time);
            }
        }
    }

    // ---- reversal ---------------------------------------------------------------------------------------------------

    /// A reversal of each angle needs both senses at each angle, and at each station, whose place would else take part
    /// in it.
    void check_reversal(const JsonObject& root) {
        const RotaryTableMeasurement& measurement = job_.measurement;
        if (measurement.reversal != ReversalModel::by_angle) {
            return;
        }
        const auto refuse = [&](const std::string& what) {
            root.refuse(k_bad_reversal, "reversal", what,
                        "a reversal by angle is the difference of both senses of approach at every angle and station",
                        "measure both senses, or choose \"auto\" or \"constant\"");
        };
        if (measurement.method != AdjustmentMethod::joint) {
            root.refuse(k_bad_reversal, "reversal", "reversal is \"by_angle\", and method is \"sequential\"",
                        "the sequential method knows one reversal of all angles",
                        "choose \"method\": \"joint\", or \"reversal\": \"constant\"");
            return;
        }
        std::vector<std::array<bool, 2>> of_station(measurement.stations.size(), {false, false});
        std::vector<std::array<bool, 2>> of_angle(measurement.angles.size(), {false, false});
        for (const LengthObservation& length : measurement.lengths) {
            const std::size_t sense = length.approach == Approach::positive ? 0 : 1;
            of_station[length.station][sense] = true;
            of_angle[length.angle][sense] = true;
        }
        const auto one_sense = [](const std::array<bool, 2>& senses) { return !(senses[0] && senses[1]); };
        if (const auto at = std::ranges::find_if(of_station, one_sense); at != of_station.end()) {
            refuse("station " + measurement.stations[static_cast<std::size_t>(at - of_station.begin())] +
                   " was measured in one sense of approach only");
        } else if (const auto angle = std::ranges::find_if(of_angle, one_sense); angle != of_angle.end()) {
            refuse("the angle " +
                   text::shortest_plain(measurement.angles_deg[static_cast<std::size_t>(angle - of_angle.begin())]) +
                   "° was measured in one sense of approach only");
        }
    }

    // ---- the frame of the machine -----------------------------------------------------------------------------------

    void read_frame_of_machine(const JsonObject& root, MachineFrameRequest&& machine, File&& file) {
        const bool stations = machine.frame.by == MachineFramePoints::stations;
        const RotaryTableMeasurement& measurement = job_.measurement;
        if (measurement.datum != Datum::axis_average_line) {
            root.refuse(k_bad_machine_frame, "machine_frame", "the datum is that of the home angle",
                        "location errors are those of the axis average line",
                        "choose \"datum\": \"axis_average_line\"");
            return;
        }
        if (stations && measurement.method != AdjustmentMethod::joint) {
            root.refuse(k_bad_machine_frame, "machine_frame", "the machine is known by its stations",
                        "the covariance of the stations is that of the joint adjustment",
                        "choose \"method\": \"joint\", or probe the reflectors");
            return;
        }
        if (measurement.reflectors.empty() || measurement.stations.empty()) {
            return;  // their own files were refused
        }
        job_.machine_frame = read_machine_points(std::move(machine), std::move(file),
                                                 stations ? measurement.stations : measurement.reflectors);
    }

    // ---- stations and environment -----------------------------------------------------------------------------------

    /// Goes through a table with one row a station.
    /// \param use  called with row and index of a known station
    template <typename Use>
    void for_each_station(const CsvTable& table, ProblemList& problems, const Use& use) {
        std::unordered_map<std::string_view, std::size_t> lines;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const auto name = table.name(row, 0);
            std::optional<std::size_t> station;
            if (name) {
                const auto [entry, is_new] = lines.try_emplace(*name, table.cell(row, 0).line);
                if (!is_new) {
                    refuse_repeated_name(table, row, 0, "station", entry->second, problems);
                }
                station = stations_.find(*name);
                if (is_new && !station && (lengths_table_ || stations_table_)) {
                    problems.warn(k_warn_unused_station, table.where(table.cell(row, 0)),
                                  "the station " + text::in_quotes(*name) +
                                      (job_.has_lengths ? " has no distance" : " is not in the stations file"),
                                  job_.has_lengths ? "stations appear in the lengths file"
                                                   : "the stations of a layout are those of the stations file",
                                  "check the name, or remove the row");
                }
            }
            use(row, station);
        }
    }

    void read_stations(File&& file) {
        static constexpr std::array<std::string_view, 4> k_columns{"station", "x_mm", "y_mm", "z_mm"};
        static constexpr std::array<std::string_view, 1> k_optional{"u_mm"};
        enum : std::size_t { x = 1, u = 4 };
        std::optional<CsvTable> table = read_csv_table(std::move(file.bytes), k_columns, k_optional, *file.problems);
        if (!table) {
            return;
        }
        if (!job_.has_lengths) {
            stations_table_ = table;
            for (std::size_t row = 0; row < table->rows(); ++row) {
                const std::string_view name = table->cell(row, 0).text;
                if (!name_objection(name) && stations_.index(name) == first_row_of_station_.size()) {
                    first_row_of_station_.push_back(row);
                }
            }
            job_.measurement.stations = stations_.names();
            job_.measurement.station_start.assign(stations_.size(), std::nullopt);
        }
        for_each_station(*table, *file.problems, [&](std::size_t row, std::optional<std::size_t> station) {
            Eigen::Vector3d position = Eigen::Vector3d::Zero();
            for (std::size_t k = 0; k < 3; ++k) {
                position(static_cast<Eigen::Index>(k)) =
                    table->number(row, x + k, k_station_coordinate).value_or(0.0) * k_millimetre;
            }
            (void)table->number_if_any(row, u, above_zero("mm"));
            if (station && !job_.measurement.station_start.empty()) {
                job_.measurement.station_start[*station] = position;
            }
        });
    }

    void read_environment(File&& file) {
        static constexpr std::array<std::string_view, 3> k_columns{"station", "fixture_temperature_degC",
                                                                   "u_temperature_K"};
        static constexpr std::array<std::string_view, 3> k_optional{"air_temperature_degC", "pressure_hPa",
                                                                    "humidity_percent"};
        enum : std::size_t { temperature = 1, u_temperature, air_temperature, pressure, humidity };
        const std::optional<CsvTable> table =
            read_csv_table(std::move(file.bytes), k_columns, k_optional, *file.problems);
        if (!table) {
            return;
        }
        const auto count = static_cast<Eigen::Index>(stations_.size());
        job_.measurement.temperature_difference = Eigen::VectorXd::Zero(count);
        job_.measurement.u_temperature = Eigen::VectorXd::Zero(count);
        job_.air.assign(stations_.size(), {});
        std::vector<bool> found(stations_.size(), false);
        for_each_station(*table, *file.problems, [&](std::size_t row, std::optional<std::size_t> station) {
            const auto fixture = table->number(row, temperature, k_temperature);
            const auto u = table->number(row, u_temperature, not_negative("K"));
            StationAir air;
            air.temperature_degC = table->number_if_any(row, air_temperature, k_temperature);
            air.pressure_hPa = table->number_if_any(row, pressure, between(300.0, 1200.0, "hPa"));
            air.humidity_percent = table->number_if_any(row, humidity, between(0.0, 100.0, "%"));
            if (station) {
                const auto index = static_cast<Eigen::Index>(*station);
                found[*station] = true;
                job_.measurement.temperature_difference(index) =
                    fixture.value_or(0.0) - job_.reference_temperature_degC;
                job_.measurement.u_temperature(index) = u.value_or(0.0);
                job_.air[*station] = air;
            }
        });
        // A row that could not be read may be the one that seems to be missing.
        bool all_rows_read = table->is_complete();
        for (std::size_t row = 0; row < table->rows(); ++row) {
            all_rows_read = all_rows_read && !name_objection(table->cell(row, 0).text);
        }
        for (std::size_t i = 0; all_rows_read && i < found.size(); ++i) {
            if (!found[i]) {
                file.problems->refuse(k_unknown_station, where_station_appears(i),
                                      "the station " + text::in_quotes(stations_.names()[i]) + " has no row in " +
                                          text::visible(file.problems->file()),
                                      "every station has a row in the environment file",
                                      "add the row, or correct the name of the station");
            }
        }
    }

    // ---- reference method -------------------------------------------------------------------------------------------

    void read_readings(File&& file, ReferenceMethod& method) {
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
                index = angle_index(*angle);
                if (!index && lengths_are_whole_) {
                    file.problems->refuse(k_reading_at_unknown_angle, table->where(table->cell(row, c_at)),
                                          "the angle " + text::shortest_plain(*angle) + "° " +
                                              (job_.has_lengths ? "has no distance" : "is not planned"),
                                          "the reference method is compared at the measured angles",
                                          "correct the angle, or remove the row");
                }
            }
            if (direction && index && run && reading) {
                seen.emplace_back(*direction, *index, static_cast<std::size_t>(*run), row);
                method.readings.push_back(
                    {*direction, *index, static_cast<std::size_t>(*run), *reading * k_micrometre});
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

    void read_indicator(const File& file, ReferenceMethod& method, bool has_budget) {
        const std::optional<JsonDocument> document = read_json_document(file.bytes, *file.problems);
        if (!document) {
            return;
        }
        const std::optional<JsonObject> object = JsonObject::root(*document, k_indicator_keys, *file.problems);
        if (!object) {
            return;
        }
        if (const auto point = object->required_numbers("contact_point_mm", 3, k_fixture_coordinate)) {
            method.contact_point = Eigen::Vector3d((*point)[0], (*point)[1], (*point)[2]) * k_millimetre;
        }
        const auto stated = [&](std::string_view key) {
            return has_budget ? object->optional_number(key, not_negative("µm"))
                              : object->required_number(key, not_negative("µm"));
        };
        const auto resolution = stated("resolution_um");
        const auto mpe = stated("mpe_um");
        method.mpe_common = object->optional_boolean("mpe_common").value_or(true);
        const auto repeatability = stated("repeatability_um");
        (void)object->optional_number("temperature_degC", k_temperature);
        (void)object->optional_string("note");
        if (has_budget) {
            return;  // it states what is known; the file may be one of another job
        }
        if (resolution && mpe && repeatability && *resolution == 0.0 && *mpe == 0.0 && *repeatability == 0.0) {
            file.problems->refuse(k_no_indicator_uncertainty, object->where(),
                                  "resolution_um, mpe_um and repeatability_um are all 0 µm",
                                  "at least one must be greater than 0", "state what is known of the dial indicator");
        }
        method.resolution = resolution.value_or(0.0) * k_micrometre;
        method.maximum_permissible_error = mpe.value_or(0.0) * k_micrometre;
        method.repeatability = repeatability.value_or(0.0) * k_micrometre;
    }

    void read_reference_correlation(const JsonObject& reference, ReferenceMethod& method) const {
        const nlohmann::json* const value = reference.find("correlation");
        if (value == nullptr) {
            return;
        }
        if (value->is_number()) {
            method.correlation = ReferenceCorrelation::given;
            method.r = reference.optional_number("correlation", between(-1.0, 1.0, "")).value_or(0.0);
        } else if (value->is_string() && *value == "none") {
            method.correlation = ReferenceCorrelation::none;
        } else if (!value->is_string() || *value != "unknown") {
            reference.refuse(k_reference_correlation, "correlation", "the value is " + described(*value),
                             "the correlation of both methods is a number from -1 to 1, \"none\" or \"unknown\"",
                             "write \"unknown\" where it is not known whether both use one standard or sensor");
        }
    }

    void read_published(const JsonObject& reference, ReferenceMethod& method, bool readings_are_whole) const {
        const auto published = reference.optional_object("published", k_published_keys);
        if (!published) {
            return;
        }
        method.published_source = published->required_name("source", 1000).value_or("");
        const auto means = published->required_object("mean_abs_En", k_direction_keys);
        if (!means) {
            return;
        }
        bool any = false;
        for (std::size_t d = 0; d < k_direction_keys.size(); ++d) {
            const std::string_view key = k_direction_keys[d];
            any = any || means->has(key);
            method.published_mean_abs_En[d] = means->optional_number(key, between(0.0, 1e6, ""));
            const bool is_read = std::any_of(method.readings.begin(), method.readings.end(),
                                             [&](const ReferenceReading& reading) { return reading.direction == d; });
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

    static void read_audited(const JsonObject& reference, ReferenceMethod& method) {
        const auto audited = reference.optional_object("audited", k_audited_keys);
        if (!audited) {
            return;
        }
        const NumberRange factor{.low = 0.0,
                                 .high = 1e3,
                                 .low_open = true,
                                 .hint =
                                     "state what the uncertainty of the reference is to be multiplied by, such as "
                                     "0.577 for a maximum permissible error that was taken as a standard "
                                     "uncertainty"};
        method.audited_factor = audited->required_number("factor", factor).value_or(1.0);
        method.audit_finding = audited->required_name("finding", 1000).value_or("");
    }

    void read_budget_of_reference(const std::optional<std::string>& name, bool readings_are_whole) {
        const std::optional<File> file = open(name);
        if (!file) {
            return;
        }
        job_.reference_budget_file = *name;
        try {
            const std::vector<ReferencePoint> points =
                readings_are_whole ? reference_points(job_.reference->readings) : std::vector<ReferencePoint>{};
            auto budget = std::make_shared<const BudgetJob>(
                read_reference_budget(source_, file->problems->file(), points, job_.measurement.angles_deg));
            files_.add(budget->files, budget->warnings);
            job_.reference_budget = std::move(budget);
        } catch (const gum::InputError& error) {
            files_.add(error);
        } catch (const gum::StorageError& error) {
            files_.add(error);
        }
    }

    const FileSource& source_;
    JobFiles files_;
    JobUse use_;
    RotaryTableJob job_;
    ProblemList* problems_ = nullptr;  ///< of the job file

    std::optional<double> home_angle_deg_;
    std::optional<CsvTable> fixture_table_;
    bool fixture_is_whole_ = false;
    bool u_is_elsewhere_ = false;  ///< the u columns of the fixture file are not used
    NameList reflectors_;          ///< of the fixture
    std::optional<CsvTable> lengths_table_;
    std::optional<CsvTable> stations_table_;  ///< kept for a layout without lengths, whose names are in it
    bool lengths_are_whole_ = false;
    NameList stations_;
    NameList lengths_reflectors_;
    NameList passes_;
    NameList dead_paths_;
    std::vector<std::size_t> first_row_of_station_;
    std::vector<double> angles_deg_;
};

struct DiskJob {
    DiskFileSource source;
    std::string name;
};

DiskJob on_disk(const std::filesystem::path& job_file) {
    return {DiskFileSource(job_file.parent_path()), job_file.filename().string()};
}

}  // namespace

double source_paper_fixture_uncertainty(double coordinate) {
    constexpr double k_constant = 0.401 * k_micrometre;
    constexpr double k_proportional = 3.32e-7;  // L and u_c in the same unit
    return std::hypot(k_constant, k_proportional * coordinate);
}

std::string fixture_coordinate_name(const std::string& reflector, std::size_t axis) {
    static constexpr std::array<const char*, 3> k_suffixes{".x", ".y", ".z"};
    return reflector + k_suffixes[axis];
}

std::span<const JobKeys> rotary_table_job_keys() {
    return all_keys();
}

RotaryTableJob read_rotary_table_job(const FileSource& source, const std::string& job_file, JobUse use) {
    return Reader(source, job_file, use).result();
}

RotaryTableJob read_rotary_table_job(const std::filesystem::path& job_file, JobUse use) {
    const DiskJob disk = on_disk(job_file);
    return read_rotary_table_job(disk.source, disk.name, use);
}

}  // namespace gumcert::engine
