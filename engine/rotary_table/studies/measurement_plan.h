#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/anglewise_covariance.h"
#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_model.h"

namespace gumcert::engine {

// What a layout will give before anything is measured. The covariance of a least-squares estimate depends on the
// geometry and on the variances of the observations, not on the observations themselves: linearised at an ideal table
// (E = 0), a fixture without set-up errors (T_s = identity) and dead paths of zero it is that of the later evaluation,
// up to set-up errors and error motions of micrometres against distances of decimetres.

/// Replaces every length by the one that an ideal table would show: dead paths zero, no set-up errors, the fixture at
/// its stated temperature. `station_start` must be there for every station; empty temperature vectors become zeros.
/// \throws gum::InputError  GC-PLAN-0001 with every station that has no position
void predict_lengths(RotaryTableMeasurement& measurement);

/// Adjustment of a planned measurement at the ideal values. The measurement must outlive it.
[[nodiscard]] JointAdjustment planned_adjustment(const RotaryTableMeasurement& measurement,
                                                 const StochasticModel& stochastic);

/// Nothing when the layout determines every parameter; else what it does not determine, and the cure (GC-RANK-0001).
/// \param measurement  with predicted lengths
[[nodiscard]] std::optional<gum::Diagnostic> undetermined_by(const RotaryTableMeasurement& measurement,
                                                             const StochasticModel& stochastic,
                                                             const SolverOptions& options);

struct PlannedStation {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< in T, [m]
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the estimated position in the datum, [m²]
};

/// What the evaluation of a planned measurement will state, coherent SI, without estimated variance components.
struct ExpectedUncertainty {
    ReportedQuantities quantities;
    AnglewiseCovariance covariance;  ///< of the reported quantities in the datum of the measurement
    std::vector<PlannedStation> stations;
    Eigen::Index observations = 0, parameters = 0, degrees_of_freedom = 0;
    double condition_number = 0.0;
    double mean_redundancy = 0.0;                  ///< mean of the redundancy numbers of the distances
    double largest_minimal_detectable_bias = 0.0;  ///< of the distances that others control, [m]
    std::size_t uncontrolled_distances = 0;        ///< distances whose bias nothing would show
};

/// \param measurement  with predicted lengths
/// \throws gum::NoResultError  as evaluate_jointly where the layout leaves parameters undetermined (geometry_check.h)
[[nodiscard]] ExpectedUncertainty expected_uncertainty(const RotaryTableMeasurement& measurement,
                                                       const StochasticModel& stochastic,
                                                       const EvaluationOptions& options);

// Layouts that differ in one thing. Dead paths that no distance has any more are left out with it.
/// \param measured  one flag a length: false = not measured
[[nodiscard]] RotaryTableMeasurement with_distances(const RotaryTableMeasurement& measurement,
                                                    const std::vector<bool>& measured);
[[nodiscard]] RotaryTableMeasurement without_station(const RotaryTableMeasurement& measurement, std::size_t station);
[[nodiscard]] RotaryTableMeasurement without_reflector(const RotaryTableMeasurement& measurement,
                                                       std::size_t reflector);
/// Every `stride`-th angle, counted from the home angle in both directions.
[[nodiscard]] RotaryTableMeasurement with_every_angle(const RotaryTableMeasurement& measurement, std::size_t stride);
/// One angle more in the middle between two neighbours; on a full turn also between the last and the first. It is
/// measured as the lower neighbour is.
[[nodiscard]] RotaryTableMeasurement with_twice_the_angles(const RotaryTableMeasurement& measurement);

/// Variances of the reported quantities of a layout by station: normal equations add up station by station, so a
/// station that moves replaces its own part only.
///
/// The poses are eliminated angle by angle, and the S-transformation to the datum has ten dimensions: one layout costs
/// time proportional to its angles, and no covariance matrix is formed. The observation equations are those of
/// JointAdjustment.
class LayoutVariances {
public:
    /// \param measurement  with predicted lengths; copied
    LayoutVariances(const RotaryTableMeasurement& measurement, const StochasticModel& stochastic);
    ~LayoutVariances();
    LayoutVariances(const LayoutVariances&) = delete;
    LayoutVariances& operator=(const LayoutVariances&) = delete;

    /// Information (inverse covariance) about poses and all other parameters (the border), of one or more stations.
    struct Information {
        Eigen::MatrixXd border;  ///< b×b
        Eigen::MatrixXd poses;   ///< 6N×6, the blocks of the angles one below the other; of the home angle zero
        Eigen::MatrixXd mixed;   ///< 6N×b
    };

    /// What a station tells from a position; has a state of its own, so use one a thread.
    class Observer;
    [[nodiscard]] std::unique_ptr<Observer> observer(std::size_t station) const;
    /// The same of some of its distances.
    /// \param measured  one flag a length of the measurement; those of other stations are not looked at
    [[nodiscard]] std::unique_ptr<Observer> observer(std::size_t station, const std::vector<bool>& measured) const;

    /// What is known without any distance: fixture coordinates, expansion.
    [[nodiscard]] const Information& prior() const { return prior_; }

    /// Variances in the order of ReportedQuantities, [m²] and [rad²]; nothing where a parameter is not determined.
    [[nodiscard]] std::optional<Eigen::VectorXd> variances(const Information& information) const;

    /// The same with all stations where the measurement has them.
    [[nodiscard]] std::optional<Eigen::VectorXd> variances() const;

    /// What the variances of the error motions would be if everything but the poses were known, 6N, [m²] and [rad²]: no
    /// variance of a layout with this information about the poses is smaller. Nothing where a pose is not determined.
    /// It costs a small part of `variances`.
    [[nodiscard]] std::optional<Eigen::VectorXd> least_variances(const Eigen::MatrixXd& poses) const;

    [[nodiscard]] const RotaryTableMeasurement& measurement() const { return measurement_; }

private:
    struct Border {
        std::vector<Eigen::Index> stations;    ///< first column of each station
        std::vector<Eigen::Index> dead_paths;  ///< column of each dead path
        Eigen::Index fixture = 0, expansion = 0, reversal = 0, size = 0;
    };

    RotaryTableMeasurement measurement_;
    StochasticModel stochastic_;
    bool has_reversal_ = false;
    Border border_;
    Information prior_;
    DatumSolution datum_;     ///< of the ideal table
    Eigen::MatrixXd change_;  ///< K of its datum
};

/// Adds what one station (or prior knowledge) tells.
void add(LayoutVariances::Information& sum, const LayoutVariances::Information& part);

class LayoutVariances::Observer {
public:
    Observer(const LayoutVariances& layout, std::size_t station, const std::vector<bool>& measured);
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;

    /// \param position  of the station in T, [m]
    void information(const Eigen::Vector3d& position, Information& result);

    /// The part of it about the poses alone, 6N×6.
    void pose_information(const Eigen::Vector3d& position, Eigen::MatrixXd& result);

private:
    void stand_at(const Eigen::Vector3d& position);

    friend class LayoutVariances;
    /// Where a free parameter of the adjustment of this station stands in the layout.
    struct Place {
        bool pose = false;
        Eigen::Index index = 0;  ///< row of the poses, or column of the border
    };

    StochasticModel stochastic_;
    Eigen::Index border_size_;
    RotaryTableMeasurement measurement_;  ///< of this station alone
    std::unique_ptr<JointAdjustment> adjustment_;
    std::vector<Eigen::VectorXd> observed_;  ///< of every visit, as the adjustment was made
    std::vector<Place> places_;
};

}  // namespace gumcert::engine
