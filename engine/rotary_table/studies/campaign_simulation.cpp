#include "engine/rotary_table/studies/campaign_simulation.h"

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_model.h"
#include "engine/rotary_table/rotation.h"

namespace gumcert::engine {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// s |P - q| of every length.
Eigen::VectorXd distances(const RotaryTableMeasurement& layout, const CampaignTruth& truth,
                          const Eigen::MatrixXd& table) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(layout.lengths.size()));
    const RigidMotion set_up = rigid_motion(truth.set_up);
    const Eigen::Matrix<double, 6, 6> of_deviation = pose_by_deviation(repeatability_point(layout, set_up));
    const std::vector<Visit> visits = visits_of(layout, std::vector<bool>(layout.lengths.size(), true));
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const Visit& visit = visits[v];
        // Half of the reversal in each sense, as the adjustment has it: the assumed error motions are the mean of both.
        const double sense = visit.approach == Approach::positive ? 0.5 : -0.5;
        Vector6 pose = truth.errors.col(static_cast<Eigen::Index>(visit.angle)) + sense * truth.reversal;
        if (table.size() > 0) {
            pose += of_deviation * table.col(static_cast<Eigen::Index>(v));
        }
        const RigidMotion turn{nominal_rotation(layout, visit.angle), Eigen::Vector3d::Zero()};
        const RigidMotion table_from_fixture = rigid_motion(pose) * turn * set_up;
        const auto station = static_cast<Eigen::Index>(visit.station);
        const double stretch = 1.0 + truth.expansion * truth.temperature_difference[station];
        for (const std::size_t i : visit.observations) {
            const Eigen::Vector3d point =
                stretch * truth.fixture.row(static_cast<Eigen::Index>(layout.lengths[i].reflector)).transpose();
            result[static_cast<Eigen::Index>(i)] = (1.0 + truth.scale_deviation[station]) *
                                                   (table_from_fixture * point - truth.stations[visit.station]).norm();
        }
    }
    return result;
}

}  // namespace

Eigen::VectorXd true_distances(const RotaryTableMeasurement& layout, const CampaignTruth& truth) {
    return distances(layout, truth, Eigen::MatrixXd());
}

RotaryTableMeasurement simulate_campaign(const RotaryTableMeasurement& layout, const CampaignTruth& truth,
                                         const CampaignNoise& noise) {
    RotaryTableMeasurement result = layout;
    const Eigen::VectorXd distance = distances(layout, truth, noise.table);
    for (std::size_t i = 0; i < result.lengths.size(); ++i) {
        LengthObservation& length = result.lengths[i];
        // l = s |P − q| − l0: a tracer shows what lies beyond its dead path.
        length.length =
            distance[static_cast<Eigen::Index>(i)] - truth.dead_paths[static_cast<Eigen::Index>(length.dead_path)];
        if (noise.lengths.size() > 0) {
            length.length += noise.lengths[static_cast<Eigen::Index>(i)];
        }
    }
    // On top of the noise: an outlier is what a good distance would show, and an error.
    for (const PlantedOutlier& outlier : noise.outliers) {
        result.lengths[outlier.length].length += outlier.error;
    }
    return result;
}

Eigen::VectorXd truth_in_datum(const RotaryTableMeasurement& layout, const CampaignTruth& truth, Datum datum,
                               bool has_reversal) {
    // Assumed motions have by chance a mean and a part that turns with the table, which no distance tells from the
    // frame and the set-up. Compared as they were drawn, they would differ from any result without a measurement
    // (docs/simulation.md).
    const DatumSolution solution = transform_to_datum(layout, truth.errors, rigid_motion(truth.set_up), datum);
    return reported_order(layout, solution.errors, solution.set_up, has_reversal ? &truth.reversal : nullptr);
}

DatumView seen_in_datum(const RotaryTableMeasurement& measurement, const Eigen::VectorXd& values,
                        const Eigen::MatrixXd& covariance, Datum datum) {
    const auto angles = static_cast<Eigen::Index>(measurement.angles.size());
    const Eigen::Index size = 6 * angles;
    const auto across = across_axis(measurement.axis);
    Vector6 set_up = Vector6::Zero();
    for (int c = 0; c < 2; ++c) {
        set_up[across[static_cast<std::size_t>(c)]] = values[size + c];
        set_up[3 + across[static_cast<std::size_t>(c)]] = values[size + 2 + c];
    }
    const DatumSolution solution =
        transform_to_datum(measurement, values.head(size).reshaped(6, angles), rigid_motion(set_up), datum);
    DatumView view;
    view.values = values;
    view.values.head(size + 4) = reported_order(measurement, solution.errors, solution.set_up, nullptr);
    // Both sides of the covariance by the maps of the datum: the set-up changes by what the error motions give up.
    const auto carry = [&](const Eigen::MatrixXd& rows) {
        Eigen::MatrixXd result = rows;
        result.topRows(size) = solution.carried(rows.topRows(size));
        result.middleRows<4>(size).noalias() += solution.stated_set_up_map() * rows.topRows(size);
        return result;
    };
    // A V Aᵀ by the same map on rows and columns.
    view.covariance = carry(carry(covariance).transpose());
    return view;
}

}  // namespace gumcert::engine
