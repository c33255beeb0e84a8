#include "engine/distance_network.h"

#include <cmath>

#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

// Observation equation l = |P − Q| − l0, weights 1/u². Solved for the positions and constants, x̂ = (JᵀV⁻¹J)⁻¹JᵀV⁻¹l at
// the last linearisation, with the covariance (JᵀV⁻¹J)⁻¹ of stated uncertainties (a priori). Residuals of the groups
// are whitened, observed minus predicted over u; what is reported is adjusted minus observed in metres.

namespace {

constexpr double k_least_redundancy = 1e-6;  // what is less is nothing but rounding of 1 − leverage

/// |P - Q| - l0. Blocks: P, Q, then l0 when there is one.
class DistanceModel final : public ObservationModel {
public:
    void predict(const double* const* parameters, double* predicted, double* const* jacobians) const override {
        const Eigen::Map<const Eigen::Vector3d> from(parameters[0]);
        const Eigen::Map<const Eigen::Vector3d> to(parameters[1]);
        const Eigen::Vector3d difference = to - from;
        const double distance = difference.norm();
        predicted[0] = has_constant_ ? distance - parameters[2][0] : distance;
        if (jacobians == nullptr) {
            return;
        }
        // ∂|P − Q|/∂Q is the unit vector along the line of sight, that by P its negative.
        const Eigen::Vector3d direction = difference / distance;
        if (jacobians[0] != nullptr) {
            Eigen::Map<Eigen::Vector3d> derivative(jacobians[0]);
            derivative = -direction;
        }
        if (jacobians[1] != nullptr) {
            Eigen::Map<Eigen::Vector3d> derivative(jacobians[1]);
            derivative = direction;
        }
        if (has_constant_ && jacobians[2] != nullptr) {
            jacobians[2][0] = -1.0;
        }
    }

    explicit DistanceModel(bool has_constant) : has_constant_(has_constant) {}

private:
    bool has_constant_;
};

}  // namespace

NetworkSolution adjust_distance_network(const std::vector<NetworkPoint>& points, std::size_t constants,
                                        const std::vector<NetworkDistance>& distances, const SolverOptions& options,
                                        double non_centrality, PointCovariance wanted) {
    Adjustment adjustment;
    std::vector<Adjustment::BlockId> point_block;
    for (const NetworkPoint& point : points) {
        const auto block = adjustment.add_parameters({point.name + ", x", point.name + ", y", point.name + ", z"},
                                                     point.position, point.eliminated && !point.fixed);
        for (int c = 0; c < 3 && point.fixed; ++c) {
            adjustment.hold(block, c);
        }
        point_block.push_back(block);
    }
    std::vector<Adjustment::BlockId> constant_block;
    for (std::size_t i = 0; i < constants; ++i) {
        constant_block.push_back(
            // Constants act linearly: any start value does, and 0 is that of an instrument without one.
            adjustment.add_parameters({"additive constant " + std::to_string(i + 1)}, Eigen::VectorXd::Zero(1)));
    }
    const auto with_constant = std::make_shared<DistanceModel>(true);
    const auto without_constant = std::make_shared<DistanceModel>(false);
    for (const NetworkDistance& distance : distances) {
        std::vector<Adjustment::BlockId> blocks{point_block[distance.from], point_block[distance.to]};
        if (distance.constant) {
            blocks.push_back(constant_block[*distance.constant]);
        }
        adjustment.add_observations(distance.constant ? with_constant : without_constant, blocks,
                                    Eigen::VectorXd::Constant(1, distance.length),
                                    Eigen::MatrixXd::Constant(1, 1, distance.u * distance.u));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        // A point with a covariance is observed, not fixed: its residuals are part of chi-square.
        if (points[i].covariance && !points[i].fixed) {
            adjustment.add_prior(point_block[i], {0, 1, 2}, points[i].position, *points[i].covariance);
        }
    }

    NetworkSolution solution;
    solution.summary = adjustment.solve(options);
    // The rank is asked before convergence: a network that is not determined need not converge, and the names of what
    // is missing are the better message.
    const NormalEquations normal = adjustment.linearise();
    solution.rank = normal.rank(options.rank_tolerance);
    if (solution.rank.deficient) {
        std::string names;
        for (const std::string& name : solution.rank.parameters) {
            names += (names.empty() ? "" : "; ") + name;
        }
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0003", "distance network", "not determined by the distances: " + names,
            "every free point needs distances from directions that are not in one plane or on one cone",
            "add distances from other directions, or give the points a covariance", gum::Severity::error});
    }
    if (!solution.summary.converged) {
        throw gum::NoResultError(gum::Diagnostic{"GC-ADJUST-0004", "distance network",
                                                 "the adjustment did not converge (" + solution.summary.message + ")",
                                                 "a result needs the minimum of the weighted squares",
                                                 "check the start values and the distances", gum::Severity::error});
    }

    const Eigen::MatrixXd covariance = normal.covariance();
    for (std::size_t i = 0; i < points.size(); ++i) {
        solution.positions.emplace_back(adjustment.parameters(point_block[i]));
        Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
        if (!points[i].fixed) {
            const Eigen::Index first = normal.column(point_block[i], 0);
            block = covariance.block<3, 3>(first, first);
        }
        solution.covariances.push_back(block);
    }
    if (wanted == PointCovariance::joint) {
        const auto size = static_cast<Eigen::Index>(3 * points.size());
        solution.joint_covariance = Eigen::MatrixXd::Zero(size, size);
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (std::size_t k = 0; k < points.size(); ++k) {
                // A fixed point has no columns: it is exact by definition, and its rows and columns stay 0.
                if (!points[i].fixed && !points[k].fixed) {
                    solution.joint_covariance.block<3, 3>(static_cast<Eigen::Index>(3 * i),
                                                          static_cast<Eigen::Index>(3 * k)) =
                        covariance.block<3, 3>(normal.column(point_block[i], 0), normal.column(point_block[k], 0));
                }
            }
        }
    }
    solution.constants.resize(static_cast<Eigen::Index>(constants));
    solution.u_constants.resize(static_cast<Eigen::Index>(constants));
    for (std::size_t i = 0; i < constants; ++i) {
        const Eigen::Index column = normal.column(constant_block[i], 0);
        solution.constants[static_cast<Eigen::Index>(i)] = adjustment.parameters(constant_block[i])[0];
        solution.u_constants[static_cast<Eigen::Index>(i)] = std::sqrt(covariance(column, column));
    }
    solution.chi_square = solution.summary.chi_square;
    solution.degrees_of_freedom = static_cast<long>(normal.observation_count() - normal.parameter_count());

    // Distances were added before the priors: group i is distance i.
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const LinearisedGroup& group = normal.groups()[i];
        const auto size = static_cast<Eigen::Index>(group.columns.size());
        // r = 1 − J̃ C J̃ᵀ of a whitened distance, w = v/(σ √r), smallest bias that is found δ0 σ/√r (Baarda 1968).
        // Of a point that three distances give, each has the leverage 1.
        double leverage = 0.0;
        for (Eigen::Index a = 0; a < size; ++a) {
            for (Eigen::Index b = 0; b < size; ++b) {
                leverage +=
                    group.jacobian(0, a) * group.jacobian(0, b) *
                    covariance(group.columns[static_cast<std::size_t>(a)], group.columns[static_cast<std::size_t>(b)]);
            }
        }
        NetworkReliability row;
        row.redundancy_number = 1.0 - leverage;
        row.residual = -group.residual[0] * distances[i].u;
        // A distance that no other one controls has the redundancy 0: its error goes into the coordinates unseen, and a
        // test value would be 0/0.
        if (row.redundancy_number > k_least_redundancy) {
            const double root = std::sqrt(row.redundancy_number);
            row.test_value = -group.residual[0] / root;
            row.minimal_detectable_bias = non_centrality * distances[i].u / root;
        }
        solution.reliability.push_back(row);
    }
    return solution;
}

}  // namespace gumcert::engine
