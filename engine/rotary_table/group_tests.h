#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// What the distances of a group would have in common if something were wrong with it.
enum class GroupKind {
    visit_length,          ///< one error of all distances of a visit: beam, dead path
    visit_pose,            ///< a visit in which the table stood elsewhere
    dead_path_change,      ///< one error of all distances of a station from some visit on: an interrupted beam
    station_place,         ///< a station that stood elsewhere from one of its passes on
    pair_length,           ///< one error of all distances between a station and a reflector
    drift,                 ///< an error of the distances of a station, or of all, that grows from visit to visit
    angle_index,           ///< the angles of a station are some steps off
    succession,            ///< successive visits deviate alike
    station,               ///< the visits of one station scatter more than those of all others
    reflector,             ///< a point of the fixture that is not where its coordinates say
    reflector_at_angles,   ///< a reflector that stands elsewhere in a part of the turn
    reflector_from_visit,  ///< a reflector that stands elsewhere from some visit on
    fixture_scale,         ///< the whole fixture larger or smaller than its coordinates at its temperature say
    station_scale,         ///< all distances of a station longer or shorter by one factor than its scale is known
    fixture_place,         ///< the whole fixture elsewhere on the table from some visit on
    expansion,             ///< the fixture expands with the temperatures otherwise than its coefficient says
    senses,                ///< the senses of approach of a station are interchanged
};

/// Share of the level of all tests of groups that a kind has. The rest, a tenth, is for the check of the stated
/// covariance of the fixture. Drift and single visits have most: the others are found at any level. Expansion and senses have
/// theirs from succession and station, whose shares are two-sided and whose tests are one-sided.
[[nodiscard]] double share_of_level(GroupKind kind);

/// A hypothesis on one group of distances, tested against the adjustment without it.
struct GroupTest {
    static constexpr std::size_t k_none = std::numeric_limits<std::size_t>::max();

    GroupKind kind = GroupKind::visit_length;
    // Of the measurement; k_none where the kind has none.
    std::size_t station = k_none, reflector = k_none;
    std::size_t pass = k_none, angle = k_none;  ///< of the visit, of the first one after a change or of a drift
    std::size_t last_angle = k_none;            ///< of a part of the turn, which begins at `angle`
    std::size_t visit = k_none;                 ///< of the visit, of the adjustment
    /// Chi-square of `degrees_of_freedom` where nothing is wrong; of succession and station the square of a normal
    /// deviate.
    double chi_square = 0.0;
    int degrees_of_freedom = 1;
    std::size_t family = 1;       ///< tests of its kind, among which the level is divided
    double p_value = 1.0;         ///< probability of a chi-square as large as this where nothing is wrong
    double critical_value = 0.0;  ///< of chi-square: the family of its kind exceeds it with its share of alpha
    /// Visit and change: error of the distances; pose: rms of what it does to the distances; drift: error at the last
    /// visit less that at the first, rms where every station has its own; reflector, constant or not, and place of
    /// a station: displacement, [m]; of the fixture: rms of that of its reflectors, [m]; scale of fixture or station: relative,
    /// [1]; expansion: stated coefficient less that of the distances, [1/K]; senses: part of the reversal that the distances
    /// of the station are off by, nearly 1; angle index: steps. Succession: autocorrelation coefficient of lag 1. Station: ratio of the
    /// standard deviations of its visits and of the others.
    double estimate = 0.0;
    double u = 0.0;  ///< standard uncertainty of `estimate` beside the other suspicious groups; 0: told alone
    double minimal_detectable = 0.0;  ///< found with a probability of 80 %, in the unit of `estimate`; 0: not stated
    bool suspicious = false;
    /// False of an error whose size no adjustment without it confirms: `estimate` is that of a linear model that does not hold
    /// so far, and is not told.
    bool is_settled = true;
    /// False of an error whose size is not determined beside the other suspicious ones: `estimate` is that of this error alone, and
    /// is not told.
    bool is_determined = true;
    /// Of drift and change: visits of the adjustment, and what all distances of each are off by, [m].
    std::vector<std::pair<std::size_t, double>> errors = {};
    /// Where suspicious, of a kind that names a cause: what each unknown of the error does to each distance of the measurement,
    /// distances×unknowns. 0 of distances that were not active.
    Eigen::MatrixXd columns = {};

    [[nodiscard]] bool has_size() const { return is_settled && is_determined; }
};

/// `estimate` of a group whose unknowns have these values.
/// \param fixture  coordinates of the points, [m]
[[nodiscard]] double size_of_error(const GroupTest& test, const Eigen::VectorXd& unknowns,
                                   const Eigen::MatrixX3d& fixture);

/// What all distances of a visit deviate by from what all other visits say.
struct VisitDeviation {
    Visit visit;
    double deviation = 0.0;  ///< observed minus predicted, mean of the distances, [m]
    double u = 0.0;          ///< its standard deviation where nothing is wrong, [m]
};

/// What the distances say of a drift of one station, or of all alike, whether suspicious or not.
struct DriftEstimate {
    std::size_t station = GroupTest::k_none;  ///< k_none: all alike
    double estimate = 0.0;                    ///< from the first visit to the last, [m]
    double u = 0.0;                           ///< its standard deviation where nothing is wrong, [m]
    double minimal_detectable = 0.0;          ///< found with a probability of 80 %, [m]
};

/// What still contradicts the weights once all errors that are told are taken off: of the global test, or else of the least
/// probable group.
struct ContradictionLeft {
    double p_value = 0.0;
    bool is_of_a_group = false;
};

struct GroupTests {
    /// Of each kind the group with the largest test value and all that are suspicious; those that are suspicious first,
    /// the least probable one first of all.
    /// Expansion and senses only where they are suspicious.
    std::vector<GroupTest> tests;
    std::vector<VisitDeviation> visits;      ///< in the order of the measurement
    std::vector<DriftEstimate> drifts = {};  ///< with all visits in; what the other distances do not tell is left out
    /// Robust standard deviation of the test values of the visits, nearly 1 where the weights are right. Weights that
    /// were estimated with a disturbed visit in the data are too small, and all test values with them.
    double scale = 1.0;
    /// None where nothing does, or where nothing was taken off: then what is told may be all that is wrong.
    std::optional<ContradictionLeft> left = {};
};

struct GroupTestOptions {
    /// Probability that a sound measurement makes any group of any kind, or its fixture, suspicious.
    double alpha = 0.01;
    /// Probability above a value of chi-square, by value and degrees of freedom.
    std::function<double(double, double)> chi_square_upper_tail;
};

/// Tests groups of distances of an adjustment at its solution by the mean-shift model: with the columns C of the effect
/// of an error on the distances, T = (Cᵀ V⁻¹ v)ᵀ (Cᵀ V⁻¹ Q_v V⁻¹ C)⁻¹ (Cᵀ V⁻¹ v) is chi-square with as many degrees of
/// freedom as C has columns (W. Baarda, A testing procedure for use in geodetic networks, 1968; P. Teunissen, Testing
/// theory, 2000).
///
/// The least probable visit, change, place, pair, scale, drift or step of the angles is taken away before the others are tested
/// again. A reflector that stands elsewhere in a part of the turn is looked for between 36 bounds at most. Test
/// values are divided by the robust scale of all visits where it differs from 1 by more than two of its standard
/// deviations, at the limit towards 1; what tells the distances of one visit apart by the larger of that scale and the one
/// of single distances, because a repeatability that is given too large makes the visits scatter little, and not the
/// distances of each. The scatter of stations and the succession of visits, which name no cause, are
/// tested where nothing else is suspicious. Of the
/// level each kind has its share, and within a kind it is divided by the number of its tests (Bonferroni); of drift a
/// third each for all stations alike, each its own jointly, and single stations. A fixture whose misfit one scale
/// explains better than any displaced point is reported as scaled.
///
/// A drift is proportional to the times of the visits where the measurement has them, else to their order.
///
/// \param normal, covariance  of the adjustment, at the weights of its result
[[nodiscard]] GroupTests test_groups(const JointAdjustment& adjustment, const NormalEquations& normal,
                                     const BorderedCovariance& covariance, const GroupTestOptions& options);

/// By how much, relatively, all distances of each of some stations are too long beside those of the others, jointly; of one
/// alone GroupTest::estimate of GroupKind::station_scale. 0 of what the others do not control.
[[nodiscard]] Eigen::VectorXd scale_errors_of_stations(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                       const BorderedCovariance& covariance,
                                                       const std::vector<std::size_t>& stations);

/// By how much, relatively, the coordinates of the fixture are too large as a whole; GroupTest::estimate of
/// GroupKind::fixture_scale. 0 where the distances do not tell it.
[[nodiscard]] double scale_error_of_fixture(const JointAdjustment& adjustment, const NormalEquations& normal,
                                            const BorderedCovariance& covariance);

}  // namespace gumcert::engine
