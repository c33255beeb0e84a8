#pragma once

#include "gum/quantity/units.h"
#include "jobs/job_common_fields.h"
#include "jobs/monte_carlo_request.h"
#include "jobs/rotary_table/rotary_table_limits.h"
#include "jobs/rotary_table/rotary_table_statement.h"
#include "jobs/rotary_table/rotary_table_words.h"

// The descriptions of the objects of a rotary_table job (jobs/job_fields.h).

namespace gumcert::jobs {

/// A range with another lower limit, that is itself not allowed.
[[nodiscard]] constexpr NumberRange above(double low, NumberRange range) {
    range.low = low;
    range.low_open = true;
    return range;
}

[[nodiscard]] constexpr NumberRange with_hint(NumberRange range, std::string_view hint) {
    range.hint = hint;
    return range;
}

inline constexpr double k_most_u = 1e5;  // [µm] and [µm/m]
// Beyond a centimetre and ten degrees it is not a set-up error and not an error motion.
inline constexpr In k_small_linear{
    {.low = 0.0, .high = 10'000.0, .unit = "µm", .hint = "check the unit: it is stated in micrometres"},
    gum::k_micrometre};
inline constexpr In k_small_angular{
    {.low = 0.0, .high = 36'000.0, .unit = "″", .hint = "check the unit: it is stated in seconds of arc"},
    gum::k_arcsecond};
inline constexpr In k_wanted_linear{between(1e-6, 1e6, "µm"), gum::k_micrometre};
inline constexpr In k_wanted_angular{between(1e-6, 1e6, "″"), gum::k_arcsecond};
inline constexpr In k_mean_abs_En{between(0.0, 1e6, "")};
inline constexpr Whole k_angle_count{
    with_hint(between(3.0, 36'000.0, ""), "state numbers of angles over a full turn, such as 36")};
inline constexpr Line k_remark{1000};

template <class Archive>
void describe(Archive& a, ObservationsStatement& r) {
    a("lengths", r.lengths, FileName{}, "The measured distances.");
    a("stations", r.stations, FileName{},
      "Start values of the places of the stations, which the program finds without them; those of a layout without "
      "lengths.");
    a("environment", r.environment, FileName{},
      "The temperature of the fixture at each station. Without it the fixture is taken to be at its reference "
      "temperature.");
    a("temperature_distribution", r.temperature_shape, k_shapes,
      "What Monte Carlo draws for the temperature of the fixture; normal when left out.");
    a.at_least_one_of({"lengths", "stations"});
}

template <class Archive>
void describe(Archive& a, engine::LengthUncertainty& r) {
    a.needed("u_constant_um", r.u_constant, In{between(0.0, k_most_u, "µm"), gum::k_micrometre},
             "Standard uncertainty of one length, its constant part.");
    a("u_proportional_um_per_m", r.u_proportional, In{between(0.0, k_most_u, "µm/m"), gum::k_micrometre},
      "Its part proportional to the distance; both add in squares.");
    a("resolution_um", r.resolution, In{not_negative("µm"), gum::k_micrometre},
      "Full step of the displayed length; left out: part of u_constant_um.");
    // A relative uncertainty of 1 % and more is a value in ppm or percent by mistake.
    a("scale_u", r.u_scale,
      In{{.low = 0.0,
          .high = 0.01,
          .low_open = true,
          .hint = "state it as a ratio: 0.15 ppm is 1.5e-7; leave it out if the scale is fixed"}},
      "Standard uncertainty of the scale of a station, as a ratio.");
    a("scale_model", r.scale_model, k_scale_models, "prior when scale_u is given, else fixed.");
}

template <class Archive>
void describe(Archive& a, ExpansionStatement& r) {
    constexpr In k_coefficient{with_hint(between(0.0, 1e-3, "1/K"), "check the unit: steel has about 1.15e-5 1/K")};
    a.needed("value", r.value, k_coefficient, "The coefficient.");
    a.needed("u", r.u, k_coefficient, "Its standard uncertainty.");
    a("distribution", r.shape, k_shapes, "What Monte Carlo draws for it; normal when left out.");
}

template <class Archive>
void describe(Archive& a, FixtureStatement& r) {
    a.needed("coordinates", r.coordinates, FileName{},
             "The coordinates of the reflectors at the reference temperature, with standard uncertainties.");
    a("covariance", r.covariance, FileName{},
      "CSV without header, 3n x 3n, um^2, order x1 y1 z1 x2 ... of the coordinates file.");
    a("budget", r.budget, FileName{}, "A job of kind budget with a point REFLECTOR.x, .y, .z for each coordinate.");
    a("uncertainty", r.source_paper, k_fixture_uncertainties,
      "stated when left out; source_paper is an equation that is there to reproduce the paper.");
    a("distribution", r.shape, k_shapes, "What Monte Carlo draws for each coordinate; normal when left out.");
    a("variance_component", r.component, k_fixture_components,
      "Whether the factor on the stated uncertainty that the residuals suggest is reported (check, when left out), "
      "used "
      "or not looked for.");
    a("reference_temperature_degC", r.reference_temperature_degC, In{k_temperature}, "20 when left out.");
    a.part("thermal_expansion_per_K", r.expansion,
           "The expansion coefficient of the fixture. Required when the observations have an environment file.");
}

template <class Archive>
void describe(Archive& a, engine::TableRepeatability& r) {
    a("mode", r.mode, k_repeatability_modes,
      "From the residuals, starting at the values below (estimate, when left out), as stated, or none.");
    a("u_linear_um", r.u_linear, In{not_negative("µm"), gum::k_micrometre},
      "Standard uncertainty of one visit: each translation.");
    a("u_axial_arcsec", r.u_axial, In{not_negative("″"), gum::k_arcsecond}, "The rotation about the axis.");
    a("u_tilt_arcsec", r.u_tilt, In{not_negative("″"), gum::k_arcsecond}, "Each of the other two rotations.");
    a("at_mm", r.axial_position, In{k_fixture_coordinate, gum::k_millimetre},
      "Coordinate along the rotary axis, in the frame of the fixture, of the point whose translations these are; "
      "left out: the centroid of the reflectors where it is estimated, 0 where it is given.");
}

template <class Archive>
void describe(Archive& a, engine::OutlierOptions& r) {
    a("test", r.test, k_outlier_tests, "data_snooping when left out.");
    a("alpha", r.alpha,
      In{{.low = 0.0,
          .high = 0.5,
          .low_open = true,
          .high_open = true,
          .hint = "state the probability of flagging a good distance, such as 0.0001"}},
      "Probability of flagging a good distance; 0.0001 when left out.");
    a("action", r.action, k_outlier_actions, "remove when left out: one at a time, listed with the reason.");
}

template <class Archive>
void describe(Archive& a, ExclusionStatement& r) {
    constexpr Words<const char*, 2> k_directions{{{"+", "+"}, {"-", "-"}}};
    a("station", r.exclusion.station, Line{}, "Of this station.");
    a("reflector", r.exclusion.reflector, Line{}, "To this reflector.");
    a("pass", r.exclusion.pass, Line{}, "Of this pass.");
    a("direction", r.exclusion.direction, k_directions, "In this sense of approach.");
    a("angle_deg", r.exclusion.angle_deg, In{k_angle}, "At this angle.");
    a("lines", r.lines,
      Whole{{.low = 2.0, .high = 1e7, .hint = "the first line of the file holds the names of columns"}},
      "The first and the last line of the lengths file.");
    a.needed("reason", r.exclusion.reason, k_remark, "Why; the documents print it.");
    a.at_least_one_of({"station", "reflector", "pass", "direction", "angle_deg", "lines"});
}

template <class Archive>
void describe(Archive& a, MachineFrameRequest& r) {
    a.needed("by", r.frame.by, k_machine_points,
             "Reflectors that the axes of the machine probed, or stations that they located.");
    a.needed("coordinates", r.coordinates, FileName{}, "Their coordinates in the frame of the machine.");
    a.needed("nominal_point_mm", r.frame.nominal_point, In{k_station_coordinate, gum::k_millimetre},
             "Where the axis should be: a point on it, in the frame of the machine.");
    a("source", r.frame.source, k_remark, "How the coordinates were found.");
}

template <class Archive>
void describe(Archive& a, PublishedStatement& r) {
    a.needed("source", r.source, k_remark, "The publication.");
    a.needed_part("mean_abs_En", r.mean_abs_En, "Its mean |En| of each direction.",
                  [](auto& in, std::array<std::optional<double>, 3>& mean) {
                      in("x", mean[0], k_mean_abs_En, "Along x.");
                      in("y", mean[1], k_mean_abs_En, "Along y.");
                      in("z", mean[2], k_mean_abs_En, "Along z.");
                      in.at_least_one_of({"x", "y", "z"});
                  });
}

template <class Archive>
void describe(Archive& a, AuditStatement& r) {
    a.needed("factor", r.factor,
             In{{.low = 0.0,
                 .high = 1e3,
                 .low_open = true,
                 .hint = "state what the uncertainty of the reference is to be multiplied by, such as 0.577 for a "
                         "maximum permissible error that was taken as a standard uncertainty"}},
             "On every uncertainty of the reference.");
    a.needed("finding", r.finding, k_remark, "What the audit found.");
}

template <class Archive>
void describe(Archive& a, ReferenceStatement& r) {
    a.needed("name", r.name, Line{}, "Of the method.");
    a.needed("readings", r.readings, FileName{}, "Its readings.");
    a.needed("description", r.description, FileName{}, "A JSON file that describes the dial indicator.");
    a("budget", r.budget, FileName{}, "A job of kind budget with the reference value as its one output.");
    a.by_code("correlation", Either{In{between(-1.0, 1.0, "")}, Words<bool, 2>{{{"unknown", true}, {"none", false}}}},
              "Of our value and the reference value at the same point.");
    a.part("published", r.published, "Figures of a publication, printed beside those of the job.");
    a.part("audited", r.audited, "A correction of the uncertainty of the reference after an audit.");
}

template <class Archive>
void describe(Archive& a, IndicatorStatement& r) {
    constexpr In k_stated{not_negative("µm"), gum::k_micrometre};
    a.needed("contact_point_mm", r.contact_point, In{k_fixture_coordinate, gum::k_millimetre},
             "Where it touches, in the frame of the table.");
    a("resolution_um", r.resolution, k_stated, "Full step of the indication; required without a budget.");
    a("mpe_um", r.maximum_permissible_error, k_stated, "Maximum permissible error; required without a budget.");
    a("mpe_common", r.mpe_common, Truth{},
      "Whether the error of the indication is one of all points of a direction; true when left out.");
    a("repeatability_um", r.repeatability, k_stated, "Standard deviation of one reading; required without a budget.");
    a("temperature_degC", r.temperature_degC, In{k_temperature}, "For people.");
    a("note", r.note, AnyText{}, "For people.");
}

template <class Archive>
void describe(Archive& a, PlantedOutliers& r) {
    constexpr NumberRange k_size{
        .low = 0.0, .high = 1e8, .low_open = true, .unit = "µm", .hint = "check the unit: it is stated in micrometres"};
    a.needed("count", r.count, Whole{between(0.0, 1e6, "")}, "In every campaign.");
    a("size_um", r.size, In{k_size, gum::k_micrometre}, "Of the error; its sign is random.");
}

template <class Archive>
void describe(Archive& a, SimulationStatement& r) {
    gum::SimulationRequest& request = r.request;
    a("runs", request.runs, Whole{between(1.0, 1e6, "")}, "Campaigns; 100 when left out.");
    a("seed", request.seed, Whole{between(0.0, k_largest_seed, "")}, "1 when left out.");
    a("set_up_offset_um", request.set_up_offset, k_small_linear, "Both offsets of the fixture across the axis.");
    a("set_up_tilt_arcsec", request.set_up_tilt, k_small_angular, "Both tilts of the fixture.");
    a("error_linear_um", request.error_linear, k_small_linear, "Linear error motions, uniform within this.");
    a("error_angular_arcsec", request.error_angular, k_small_angular, "Angular error motions, uniform within this.");
    a.part("table_repeatability", request.table_repeatability,
           "Of the simulated table; left out: as table_repeatability of the job states it.",
           [](auto& in, engine::TableRepeatability& table) {
               table.mode = engine::RepeatabilityMode::given;
               in.needed("u_linear_um", table.u_linear, k_small_linear, "Each translation.");
               in.needed("u_axial_arcsec", table.u_axial, k_small_angular, "The rotation about the axis.");
               in.needed("u_tilt_arcsec", table.u_tilt, k_small_angular, "Each of the other two rotations.");
           });
    a.part("outliers", r.outliers, "Distances with a planted error.");
    a.by_code("angle_counts", Several{k_angle_count}, "Studies over full turns of these many angles.");
}

template <class Archive>
void describe(Archive& a, AngleSteps& r) {
    a.needed("first", r.first, In{k_angle}, "The first angle.");
    a.needed("step", r.step, In{above(0.0, k_angle)}, "From each to the next.");
    a.needed("count", r.count, Whole{between(1.0, k_most_planned_angles, "")}, "Of the angles.");
}

template <class Archive>
void describe(Archive& a, RegionStatement& r) {
    constexpr In k_limit{k_station_coordinate};
    a.needed("x_mm", r.x, k_limit, "The lower limit, then the upper one.");
    a.needed("y_mm", r.y, k_limit, "The lower limit, then the upper one.");
    a.needed("z_mm", r.z, k_limit, "The lower limit, then the upper one.");
    a("step_mm", r.step, In{above(0.0, k_station_coordinate), gum::k_millimetre},
      "Of the grid of places that are tried; 200 when left out.");
}

template <class Archive>
void describe(Archive& a, CylinderStatement& r) {
    a.needed("name", r.name, Line{}, "Of the obstacle.");
    a.needed("radius_mm", r.radius, In{above(0.0, k_station_coordinate), gum::k_millimetre}, "About the rotary axis.");
    a.needed("along_axis_mm", r.along_axis, In{k_station_coordinate}, "The lower limit, then the upper one.");
}

template <class Archive>
void describe(Archive& a, BoxStatement& r) {
    constexpr In k_limit{k_station_coordinate};
    a.needed("name", r.name, Line{}, "Of the obstacle.");
    a.needed("x_mm", r.x, k_limit, "The lower limit, then the upper one.");
    a.needed("y_mm", r.y, k_limit, "The lower limit, then the upper one.");
    a.needed("z_mm", r.z, k_limit, "The lower limit, then the upper one.");
    a("turns", r.turns, Truth{}, "Whether it turns with the table; true when left out.");
}

template <class Archive>
void describe(Archive& a, FacingStatement& r) {
    a.needed("reflector", r.reflector, Line{}, "Of the coordinates file.");
    a.needed("direction", r.direction, In{between(-1e6, 1e6, "")}, "Where it looks, of any length.");
}

template <class Archive>
void describe(Archive& a, SightKeys& r) {
    a.list("cylinders", r.cylinders, "About the rotary axis.");
    a.list("boxes", r.boxes, "Fixed to the table; with turns false, to the machine.");
    a("reflector_diameter_mm", r.reflector_diameter, In{above(0.0, between(0.0, 1000.0, "mm")), gum::k_millimetre},
      "Reflectors hide each other.");
    a("acceptance_angle_deg", r.acceptance_angle, In{above(0.0, between(0.0, 180.0, "°")), gum::k_degree},
      "Largest angle between the beam and the direction in which a reflector looks.");
    a.list("facing", r.facing, "Where reflectors look, in the frame of the fixture.");
}

template <class Archive>
void describe(Archive& a, PlanStatement& r) {
    constexpr Words<bool, 2> k_senses{{{"one", false}, {"both", true}}};
    constexpr Words<bool, 2> k_dead_paths{{{"station", false}, {"reflector", true}}};
    a.part_or("angles_deg", Several{In{k_angle}, 1, static_cast<std::size_t>(k_most_planned_angles)}, r.steps,
              "An array of angles, or first, step and count.");
    a("senses", r.request.both_senses, k_senses, "Senses of approach; one when left out.");
    a("dead_paths", r.request.dead_path_per_reflector, k_dead_paths,
      "One of each station (when left out), or one of each station and reflector.");
    a.part("targets", r.request, "Expanded uncertainties that are wanted.", [](auto& in, gum::PlanRequest& request) {
        gum::ParameterTargets& parameters = request.parameter_targets;
        in("linear_um", request.target_linear, k_wanted_linear, "Of the linear error motions; 1 when left out.");
        in("angular_arcsec", request.target_angular, k_wanted_angular, "Of the angular ones; 1 when left out.");
        in("range_linear_um", parameters.range_linear, k_wanted_linear, "Of the ranges of the linear ones.");
        in("range_angular_arcsec", parameters.range_angular, k_wanted_angular, "Of the ranges of the angular ones.");
        in("location_um", parameters.location_linear, k_wanted_linear, "Of the place of the axis.");
        in("location_arcsec", parameters.location_angular, k_wanted_angular, "Of the direction of the axis.");
        in("E_arcsec", parameters.systematic, k_wanted_angular, "Of E of ISO 230-2.");
        in("R_arcsec", parameters.repeatability, k_wanted_angular, "Of R of ISO 230-2.");
        in("A_arcsec", parameters.accuracy, k_wanted_angular, "Of A of ISO 230-2.");
    });
    a.part("station_region", r.region, "A box in which stations may stand; left out: stations are not moved.");
    a("least_distance_mm", r.least_distance, In{between(0.0, 100'000.0, "mm"), gum::k_millimetre},
      "Of a station from every reflector at every angle; 200 when left out.");
    a("keep_met_targets", r.request.keep_met_targets, Truth{},
      "No station is moved where that makes a target missed that was met; false when left out.");
    a.part("sight", r.sight, "What stands in the way of beams, and where reflectors look; frame of the table at home.");
}

template <class Archive>
void describe(Archive& a, RotaryTableStatement& r) {
    engine::RotaryTableMeasurement& measurement = r.job.measurement;
    describe_head(a, k_rotary_table_kind);
    describe_title(a);
    a.needed("axis", measurement.axis, k_axes, "The table turns about x, y or z.");
    a("home_angle_deg", r.home_angle_deg, In{k_angle}, "One of the measured angles; 0 when left out.");
    a("datum", measurement.datum, k_datums,
      "What the error motions are stated against; axis_average_line when left out.");
    a("method", measurement.method, k_methods,
      "joint when left out; sequential has the two stages of the source paper.");
    describe_coverage(a, r.job);
    a.needed_part("observations", r.observations,
                  "gumcert plan and gumcert simulate do without lengths when stations and plan.angles_deg are given.");
    a.needed_part("length_uncertainty", measurement.length_uncertainty, "Of one distance.");
    a.needed_part("fixture", r.fixture,
                  "covariance, budget, uncertainty source_paper and distribution uniform exclude each other.");
    a.part(
        "table_repeatability", measurement.table_repeatability,
        "With what the table comes back to an angle. With mode given, all three standard uncertainties are required.");
    a("variance_components", r.estimates_length_noise, k_length_noises,
      "Whether the residuals give the standard uncertainty of a length; estimate when left out and the repeatability "
      "is "
      "estimated too, else fixed.");
    a.part("outliers", measurement.outliers, "What is done about gross errors.");
    a.list("exclude", r.exclude,
           "Distances that the laboratory leaves out: those that agree with everything that is named.");
    a("reversal", measurement.reversal, k_reversals,
      "One of all angles, one of each, or (auto) that of each where the distances refute one of all.");
    a.part(
        "machine_frame", r.machine_frame,
        "Points that are known in the reference frame of the machine: location errors of the axis are stated in it.");
    a.part("reference_method", r.reference, "A dial indicator for comparison.");
    a.part("monte_carlo", r.monte_carlo, "Monte Carlo of the whole measurement; left out: none.");
    a.part("simulation", r.simulation, "gumcert simulate: what is simulated.");
    a.part("plan", r.plan, "gumcert plan: a layout that is not measured yet.");
    describe_certificate(a);
    describe_notes(a);
}

}  // namespace gumcert::jobs
