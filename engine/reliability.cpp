#include "engine/reliability.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <map>

namespace gumcert::engine {

namespace {

Eigen::MatrixXd local_covariance(const Eigen::MatrixXd& covariance, const std::vector<Eigen::Index>& columns) {
    return covariance(columns, columns);
}

}  // namespace

std::vector<DistanceReliability> distance_reliability(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                      const Eigen::MatrixXd& covariance,
                                                      const StochasticModel& stochastic, double non_centrality) {
    const RotaryTableMeasurement& measurement = adjustment.measurement();
    std::vector<DistanceReliability> rows(measurement.lengths.size());
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        const LinearisedGroup& group = normal.groups()[v];
        const Eigen::Index n = group.residual.size();
        const Eigen::MatrixXd cofactor =  // Q̃_v = I - J̃ C J̃ᵀ
            Eigen::MatrixXd::Identity(n, n) -
            group.jacobian * local_covariance(covariance, group.columns) * group.jacobian.transpose();
        const auto lower = group.cholesky.triangularView<Eigen::Lower>();
        const Eigen::MatrixXd inverse = lower.solve(Eigen::MatrixXd::Identity(n, n));  // L⁻¹
        const Eigen::VectorXd weighted = inverse.transpose() * group.residual;         // V⁻¹ v
        const Eigen::MatrixXd spread = inverse.transpose() * cofactor * inverse;       // V⁻¹ Q_v V⁻¹
        const Eigen::MatrixXd redundancy = group.cholesky * cofactor * inverse;        // Q_v V⁻¹
        const Eigen::VectorXd raw = group.cholesky * group.residual;
        for (Eigen::Index i = 0; i < n; ++i) {
            DistanceReliability& row = rows[adjustment.visits()[v].observations[static_cast<std::size_t>(i)]];
            row.residual = -raw[i];
            row.redundancy_number = redundancy(i, i);
            // A distance that nothing controls has no test value: its residual is zero whatever its error.
            if (spread(i, i) > 1e-12 * inverse.col(i).squaredNorm()) {
                row.test_value = -weighted[i] / std::sqrt(spread(i, i));
                row.minimal_detectable_bias = non_centrality / std::sqrt(spread(i, i));
            }
        }
    }

    std::vector<bool> active = adjustment.active();
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> visit_of;
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        visit_of[{adjustment.visits()[v].pass, adjustment.visits()[v].angle}] = v;
    }
    for (std::size_t i = 0; i < active.size(); ++i) {
        if (active[i]) {
            continue;
        }
        // Rebuild its visit with it as the last member, at the present solution.
        std::vector<bool> only(active.size(), false);
        std::vector<std::size_t> members;
        const auto found = visit_of.find({measurement.lengths[i].pass, measurement.lengths[i].angle});
        if (found != visit_of.end()) {
            members = adjustment.visits()[found->second].observations;
        }
        members.push_back(i);
        for (const std::size_t member : members) {
            only[member] = true;
        }
        JointAdjustment single(measurement, only, adjustment.set_up(), adjustment.present_values(), stochastic);
        single.copy_parameters_from(adjustment);
        if (adjustment.has_reversal() && !single.has_reversal()) {
            // One visit alone has one sense; carry the reversal in the pose.
            const Visit& visit = single.visits()[0];
            const double sense = visit.approach == Approach::positive ? 0.5 : -0.5;
            single.adjustment().set_parameters(
                single.pose_block(visit.angle),
                adjustment.adjustment().parameters(adjustment.pose_block(visit.angle)) +
                    sense * adjustment.adjustment().parameters(adjustment.reversal_block()));
        }
        const Visit& visit = single.visits()[0];
        const Eigen::VectorXd difference = single.adjustment().residual(0);
        const Eigen::MatrixXd noise = single.visit_covariance(0, stochastic);
        // Derivatives with respect to the free parameters of the full adjustment, by block.
        const Eigen::Index p = normal.parameter_count();
        Eigen::MatrixXd design = Eigen::MatrixXd::Zero(difference.size(), p);
        const auto fill = [&](Adjustment::BlockId from, Adjustment::BlockId to, double factor) {
            const Eigen::MatrixXd block = single.adjustment().jacobian(0, from);
            for (Eigen::Index c = 0; c < block.cols(); ++c) {
                if (const Eigen::Index column = normal.column(to, static_cast<int>(c)); column >= 0) {
                    design.col(column) += factor * block.col(c);
                }
            }
        };
        fill(single.station_block(visit.station), adjustment.station_block(visit.station), 1.0);
        fill(single.fixture_block(), adjustment.fixture_block(), 1.0);
        fill(single.expansion_block(), adjustment.expansion_block(), 1.0);
        fill(single.pose_block(visit.angle), adjustment.pose_block(visit.angle), 1.0);
        if (adjustment.has_reversal()) {
            fill(single.pose_block(visit.angle), adjustment.reversal_block(),
                 visit.approach == Approach::positive ? 0.5 : -0.5);
        }
        std::vector<bool> filled(measurement.dead_paths.size(), false);
        for (const std::size_t member : visit.observations) {
            const std::size_t path = measurement.lengths[member].dead_path;
            if (!filled[path]) {
                filled[path] = true;
                fill(single.dead_path_block(path), adjustment.dead_path_block(path), 1.0);
            }
        }
        Eigen::Index self = 0;
        std::vector<Eigen::Index> others;
        for (std::size_t k = 0; k < visit.observations.size(); ++k) {
            if (visit.observations[k] == i) {
                self = static_cast<Eigen::Index>(k);
            } else {
                others.push_back(static_cast<Eigen::Index>(k));
            }
        }
        double deviation = difference[self];
        double variance = noise(self, self);
        Eigen::RowVectorXd rate = design.row(self);
        if (!others.empty()) {
            const Eigen::MatrixXd block = noise(others, others);
            const Eigen::VectorXd cross = noise(others, self);
            const Eigen::VectorXd weight = block.llt().solve(cross);
            deviation -= weight.dot(difference(others));
            variance -= weight.dot(cross);
            rate -= weight.transpose() * design(others, Eigen::all);
        }
        variance += rate * covariance * rate.transpose();
        DistanceReliability& row = rows[i];
        row.residual = -difference[self];
        row.redundancy_number = 1.0;
        row.test_value = -deviation / std::sqrt(variance);
        row.minimal_detectable_bias = non_centrality * std::sqrt(variance);
        row.removed = true;
    }
    return rows;
}

}  // namespace gumcert::engine
