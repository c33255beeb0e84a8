#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gumcert::engine {

enum class RotaryAxis { a, b, c };           ///< about x, y or z of the table frame T
enum class Approach { positive, negative };  ///< sense in which the table was driven to the angle
enum class Datum { axis_average_line, home };
enum class AdjustmentMethod { joint, sequential };
enum class ScaleModel { fixed, prior, free };
enum class RepeatabilityMode { estimate, given, none };
enum class OutlierTest { data_snooping, none };
enum class OutlierAction { report, remove };
/// What is done with the factor on the stated covariance of the fixture that the residuals suggest.
enum class FixtureComponent { given, check, estimate };
/// Shape of the distribution that is drawn for a quantity with a stated standard uncertainty.
enum class InputShape { normal, uniform };

/// One distance, as read. The indices point into the lists of names of `RotaryTableMeasurement`.
struct LengthObservation {
    std::size_t station = 0;
    std::size_t reflector = 0;
    std::size_t pass = 0;
    std::size_t angle = 0;
    std::size_t dead_path = 0;
    Approach approach = Approach::positive;
    double length = 0.0;   ///< displayed length l, [m]; l + l0 = s |P - q|
    std::size_t line = 0;  ///< line of the file that it came from, for messages
};

struct LengthUncertainty {
    double u_constant = 0.0;      ///< standard uncertainty of one length, constant part, [m]
    double u_proportional = 0.0;  ///< part proportional to the distance, [1]; both add in squares
    ScaleModel scale_model = ScaleModel::fixed;
    double u_scale = 0.0;  ///< standard uncertainty of the scale of a station, [1]; used with `prior`
    /// Full step of the displayed length, [m]; 0: part of the length noise. Uniform, its variance is known and stays
    /// outside the estimated variance component.
    double resolution = 0.0;
};

/// Standard uncertainties with which the table comes back to an angle, of one visit, given or as start values.
struct TableRepeatability {
    RepeatabilityMode mode = RepeatabilityMode::estimate;
    double u_linear = 0.0;  ///< each of the three translations, [m]
    double u_axial = 0.0;   ///< rotation about the axis, [rad]
    double u_tilt = 0.0;    ///< rotation about each of the other two, [rad]
    /// Coordinate along the axis, in the frame of the fixture, of the point that it acts at; none: that of the centroid of
    /// the reflectors. [m]
    std::optional<double> axial_position = {};
};

struct OutlierOptions {
    OutlierTest test = OutlierTest::data_snooping;
    double alpha = 0.0001;  ///< probability of flagging a good distance
    OutlierAction action = OutlierAction::remove;
};

/// What the two senses of approach differ by: six values for all angles, or six at every angle.
enum class ReversalModel {
    automatic,  ///< constant, unless the distances refute it (choose_reversal_model)
    constant,
    by_angle,
};

/// Everything that the adjustment of one rotary table needs, in coherent SI.
///
/// Frame T is the table frame with its axis along x (A), y (B) or z (C). Fixture coordinates are in the fixture frame
/// at the reference temperature; T_s = Trans(O) Rz(S_z) Ry(S_y) Rx(S_x) carries them to T at the home angle.
struct RotaryTableMeasurement {
    RotaryAxis axis = RotaryAxis::a;
    std::vector<std::string> stations;
    std::vector<std::string> reflectors;
    std::vector<std::string> passes;
    std::vector<std::string> dead_paths;
    std::vector<double> angles;      ///< nominal angles, ascending, each once, [rad]
    std::vector<double> angles_deg;  ///< the same as the file states them, [°], for documents only
    std::size_t home = 0;            ///< index of the home angle

    std::vector<LengthObservation> lengths;
    std::vector<double> times;           ///< one a length, from any origin, [s]; empty: known by their order only
    Eigen::MatrixX3d fixture;            ///< reflectors×3, [m]
    Eigen::MatrixXd fixture_covariance;  ///< 3n×3n, order x1 y1 z1 x2 …, [m²]
    std::vector<std::optional<Eigen::Vector3d>> station_start;  ///< per station, in T, [m]; empty when not known
    Eigen::VectorXd temperature_difference;  ///< fixture temperature minus reference temperature, per station, [K]
    Eigen::VectorXd u_temperature;           ///< its standard uncertainty, per station, [K]
    InputShape fixture_shape = InputShape::normal;  ///< of each coordinate; uniform only where they are uncorrelated
    InputShape temperature_shape = InputShape::normal;
    InputShape expansion_shape = InputShape::normal;
    FixtureComponent fixture_component = FixtureComponent::check;
    double expansion = 0.0;    ///< linear thermal expansion coefficient of the fixture, [1/K]
    double u_expansion = 0.0;  ///< [1/K]

    LengthUncertainty length_uncertainty;
    TableRepeatability table_repeatability;
    bool estimate_length_noise = true;  ///< variance component of the length noise estimated, else as stated
    OutlierOptions outliers;
    Datum datum = Datum::axis_average_line;
    AdjustmentMethod method = AdjustmentMethod::joint;
    ReversalModel reversal = ReversalModel::automatic;  ///< where both senses of approach were measured
};

/// One reading of the reference method at one angle.
struct ReferenceReading {
    std::size_t direction = 0;  ///< 0, 1, 2 for x, y, z of T
    std::size_t angle = 0;      ///< index into RotaryTableMeasurement::angles
    std::size_t run = 0;        ///< number of the run as the file states it
    double reading = 0.0;       ///< displacement of the contact point, [m]
};

/// What is known of the correlation between the reference value and the value of the table at the same point.
enum class ReferenceCorrelation { unknown, none, given };

/// Readings of a dial indicator on a point of the table, and what is known of the indicator.
struct ReferenceMethod {
    std::string name;
    std::vector<ReferenceReading> readings;
    Eigen::Vector3d contact_point = Eigen::Vector3d::Zero();  ///< in T, [m]
    // What the indicator is known by where no budget of the reference value is given; all 0 then.
    double resolution = 0.0;                 ///< full step of the indication, [m]
    double maximum_permissible_error = 0.0;  ///< half width, [m]
    double repeatability = 0.0;              ///< standard deviation of one reading, [m]
    /// The error of the indication is one unknown error of all points of a direction; else one of its own at each.
    bool mpe_common = true;

    ReferenceCorrelation correlation = ReferenceCorrelation::unknown;
    double r = 0.0;  ///< with `given`: of both values at each point, −1 … 1
    std::string published_source = {};
    std::array<std::optional<double>, 3> published_mean_abs_En = {};  ///< in x, y, z, of that publication
    double audited_factor = 1.0;     ///< on every uncertainty of the reference, once the finding is corrected
    std::string audit_finding = {};  ///< "": there is none
};

/// ISO 230-7 names of the six error motions in the order d_x, d_y, d_z, e_a, e_b, e_c, e.g. "EXA" … "ECA".
[[nodiscard]] std::array<std::string, 6> error_motion_names(RotaryAxis axis);

/// 0, 1 or 2: the coordinate along the axis; the two across it follow in right-handed order.
[[nodiscard]] constexpr int axial_coordinate(RotaryAxis axis) {
    return static_cast<int>(axis);
}

}  // namespace gumcert::engine
