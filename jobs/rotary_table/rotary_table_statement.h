#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "jobs/job_fields.h"
#include "jobs/monte_carlo_request.h"
#include "jobs/rotary_table/machine_frame_reading.h"
#include "jobs/rotary_table/rotary_table_job.h"

namespace gumcert::jobs {

// What the file of a rotary_table job says beside what goes into the job as it stands. File names are those of the job.

struct ObservationsStatement {
    std::optional<std::string> lengths, stations, environment;
    std::optional<engine::InputShape> temperature_shape;
};

struct ExpansionStatement {
    double value = 0.0;  ///< [1/K]
    double u = 0.0;      ///< [1/K]
    engine::InputShape shape = engine::InputShape::normal;
};

struct FixtureStatement {
    std::optional<std::string> coordinates, covariance, budget;
    bool source_paper = false;
    engine::InputShape shape = engine::InputShape::normal;
    engine::FixtureComponent component = engine::FixtureComponent::check;
    double reference_temperature_degC = 20.0;
    std::optional<ExpansionStatement> expansion;
};

struct PublishedStatement {
    std::string source;
    std::array<std::optional<double>, 3> mean_abs_En;  ///< in x, y, z
};

struct AuditStatement {
    double factor = 1.0;
    std::string finding;
};

struct ReferenceStatement {
    std::string name;
    std::optional<std::string> readings, description, budget;
    std::optional<PublishedStatement> published;
    std::optional<AuditStatement> audited;
};

/// The file that describes the dial indicator of a reference method, in SI.
struct IndicatorStatement {
    Eigen::Vector3d contact_point = Eigen::Vector3d::Zero();                     ///< [m]
    std::optional<double> resolution, maximum_permissible_error, repeatability;  ///< [m]
    bool mpe_common = true;
    double temperature_degC = 20.0;
    std::string note;
};

/// `simulation`.
struct PlantedOutliers {
    std::size_t count = 0;
    std::optional<double> size;  ///< [m]
};
struct SimulationStatement {
    gum::SimulationRequest request;  ///< but for the outliers and `angle_counts`
    PlantedOutliers outliers;
};

/// `plan`.
struct AngleSteps {
    double first = 0.0;  ///< [°]
    double step = 0.0;   ///< [°]
    std::size_t count = 0;
};
using LimitsMm = std::array<double, 2>;
struct RegionStatement {
    LimitsMm x{}, y{}, z{};
    std::optional<double> step;  ///< [m]
};
struct CylinderStatement {
    std::string name;
    double radius = 0.0;  ///< [m]
    LimitsMm along_axis{};
};
struct BoxStatement {
    std::string name;
    LimitsMm x{}, y{}, z{};
    bool turns = true;
};
struct FacingStatement {
    std::string reflector;
    std::array<double, 3> direction{};
};
struct SightKeys {
    std::vector<CylinderStatement> cylinders;
    std::vector<BoxStatement> boxes;
    std::optional<double> reflector_diameter;  ///< [m]
    std::optional<double> acceptance_angle;    ///< [rad]
    std::vector<FacingStatement> facing;
};
struct PlanStatement {
    gum::PlanRequest request;  ///< but for its angles, region, least distance and lines of sight
    AngleSteps steps;
    std::optional<RegionStatement> region;
    std::optional<double> least_distance;  ///< [m]
    SightKeys sight;
};

/// One entry of `exclude`.
struct ExclusionStatement {
    Exclusion exclusion;
    std::array<double, 2> lines{};
};

/// The whole job file.
struct RotaryTableStatement {
    RotaryTableJob job;
    std::optional<double> home_angle_deg;
    std::optional<bool> estimates_length_noise;
    ObservationsStatement observations;
    FixtureStatement fixture;
    bool has_fixture_budget = false;  ///< stated, though its name may have been refused
    std::vector<ExclusionStatement> exclude;
    MachineFrameRequest machine_frame;
    ReferenceStatement reference;
    MonteCarloStatement monte_carlo;
    SimulationStatement simulation;
    PlanStatement plan;
};

/// The keys of a rotary_table job, what they mean and what they allow.
[[nodiscard]] const JobFields& rotary_table_fields();

}  // namespace gumcert::jobs
