// A simulated calibration of a rotary table with known truth, for tests.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine::synthetic {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double k_um = 1e-6;
constexpr double k_arcsec = std::numbers::pi / 180.0 / 3600.0;

/// Standard normal and uniform numbers. The C++ standard fixes the bits of std::mt19937_64, but not those of
/// std::normal_distribution: the transformation of Box and Muller is written out, so that a seed means one campaign.
class Noise {
public:
    explicit Noise(std::uint64_t seed) : bits_(seed) {}

    /// Open interval 0 … 1.
    double uniform() { return (static_cast<double>(bits_() >> 11U) + 0.5) * 0x1p-53; }

    double normal() {
        const double radius = std::sqrt(-2.0 * std::log(uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

private:
    std::mt19937_64 bits_;
};

enum class DeadPaths { per_station, per_station_and_reflector };

/// `count` angles of a full turn, the last one short of 360°.
std::vector<double> full_turn(int count);

/// `count` angles from 0 to `last_deg`, both included.
std::vector<double> partial_turn(double last_deg, int count);

/// What is simulated. Geometry, set-up and noise are those of the design note (rotary-table.md, 4e), written for axis
/// A; for B and C all coordinates are turned cyclically, so that the three campaigns are the same up to names.
struct CampaignPlan {
    RotaryAxis axis = RotaryAxis::a;
    Datum datum = Datum::axis_average_line;  ///< whose conditions the true error motions obey
    std::vector<double> angles_deg = full_turn(36);
    std::size_t home = 0;
    std::vector<Eigen::Vector3d> stations{{0.70, 0.45, 0.10},   {0.75, -0.40, 0.35}, {0.55, 0.10, -0.60},
                                          {1.20, -0.55, -0.45}, {1.10, 0.60, 0.70},  {0.45, -0.75, 0.05}};
    std::vector<Eigen::Vector3d> reflectors{{0.030, 0.120, 0.000},   {0.150, 0.050, 0.100},  {0.060, -0.085, 0.090},
                                            {0.180, -0.070, -0.050}, {0.040, 0.010, -0.120}, {0.220, 0.020, 0.010}};
    std::size_t runs = 1;               ///< of every station, in each sense
    bool both_senses = false;           ///< every run up and down, else up only
    bool one_reflector_a_pass = false;  ///< the table is driven once a reflector: one distance a visit
    bool closed_runs = false;           ///< the first angle again at the end of each run, as a pass of its own
    DeadPaths dead_paths = DeadPaths::per_station;
    bool start_values = false;                                  ///< stations given to about a centimetre, else none
    Eigen::Vector2d offset{59.4 * k_um, 192.6 * k_um};          ///< O across the axis, [m]
    Eigen::Vector2d tilt{50.78 * k_arcsec, 108.70 * k_arcsec};  ///< S across the axis, [rad]
    double error_factor = 1.0;                                  ///< on the error motions of the table
    Vector6 reversal = Vector6::Zero();                         ///< E(+) - E(-), used with both senses, [m] and [rad]
    Vector6 reversal_second = Vector6::Zero();                  ///< times sin 2θ, added to the reversal of each angle
    ReversalModel reversal_model = ReversalModel::automatic;    ///< that the measurement asks for
    double u_constant = 0.158 * k_um;                           ///< close to 0.1 µm + 0.15 µm/m over 0.6 … 1.5 m,
    double u_proportional = 0.1936 * k_um;                      ///< which the note adds linearly
    ScaleModel scale_model = ScaleModel::fixed;
    double u_scale = 0.0;
    double cmm_factor = 1.0;                                         ///< on u_c of the paper, eq. (11)
    double temperature_difference = 0.0, u_temperature = 0.0;        ///< of the fixture; rises by 0.1 K a station, [K]
    double expansion = 0.0, u_expansion = 0.0;                       ///< [1/K]
    double table_linear = 0.0, table_axial = 0.0, table_tilt = 0.0;  ///< true repeatability, [m], [rad], [rad]
    double repeatability_off = 0.0;    ///< acts this far along the axis from the reflectors' centroid, [m]
    double missing_share = 0.0;        ///< share of the distances that were lost
    std::size_t outliers = 0;          ///< number of distances that are wrong
    double outlier_size = 3.0 * k_um;  ///< by this much, in either sense
    double noise = 1.0;                ///< factor on everything random; 0: exact data
    std::uint64_t seed = 1;
};

struct CampaignTruth {
    Eigen::MatrixXd errors;                 ///< 6×angles, in the datum of the plan
    Vector6 set_up = Vector6::Zero();       ///< O and S
    Vector6 reversal = Vector6::Zero();     ///< mean over the angles
    Eigen::MatrixXd reversals;              ///< of each angle, 6×angles
    std::vector<Eigen::Vector3d> stations;  ///< in T
    Eigen::VectorXd scale_deviation;        ///< s - 1
    Eigen::VectorXd dead_paths;
    Eigen::MatrixX3d fixture;
    std::vector<std::size_t> outliers;  ///< indices into the lengths, ascending
};

struct Campaign {
    RotaryTableMeasurement measurement;
    CampaignTruth truth;

    /// Truth in the order of the reported quantities, without and with the reversals.
    [[nodiscard]] Eigen::VectorXd true_values(bool has_reversal) const;
};

/// Standard deviation of the noise of a distance, root mean square over all of them, [m].
double rms_length_noise(const CampaignPlan& plan, const Campaign& campaign);

/// Rotation about the coordinate axes by Eigen, not by the engine: the tests need a second opinion.
Eigen::Matrix3d turn(int axis, double angle);

Eigen::Vector3d moved(const Vector6& motion, const Eigen::Vector3d& point);

/// P = E(θ) R(θ) T_s p, all coordinates in T (contract, section 4).
Eigen::Vector3d point_in_table(RotaryAxis axis, double angle_from_home, const Vector6& error, const Vector6& set_up,
                               const Eigen::Vector3d& point);

/// Carry error motions to a datum by its conditions, to first order: what is taken away belongs to world and set-up.
void obey_datum(Eigen::MatrixXd& errors, RotaryAxis axis, const std::vector<double>& angle_from_home, std::size_t home,
                Datum datum, const Eigen::MatrixX3d& fixture);

Campaign simulate(const CampaignPlan& plan);

/// Root mean square over the angles of the six error motions' values, 6; the home angle left out where it is zero.
Vector6 rms_over_angles(const Eigen::VectorXd& values, Eigen::Index angles);

}  // namespace gumcert::engine::synthetic
