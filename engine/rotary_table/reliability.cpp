#include "engine/rotary_table/reliability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/fixed_parts.h"
#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

namespace {

// Share of the weight of an observation below which its residual is rounding: nothing else controls it, it has no test
// value, and its residual is zero whatever its error.
constexpr double k_uncontrolled = 1e-12;

/// What the reliability of the observations of one group follows from.
struct GroupReliability {
    Eigen::VectorXd residual;           ///< observed minus adjusted
    Eigen::VectorXd weighted;           ///< V⁻¹ v
    Eigen::VectorXd diagonal;           ///< of V⁻¹ Q_v V⁻¹
    Eigen::VectorXd redundancy;         ///< diagonal of Q_v V⁻¹
    std::vector<bool> is_uncontrolled;  ///< by any other observation
};

GroupReliability reliability_of(const LinearisedGroup& group, const BorderedCovariance& covariance) {
    const Eigen::Index n = group.residual.size();
    // From whitened derivatives: 1 − leverage in the metric of the full covariance. The residual alone would not do,
    // because distances of a visit are correlated and an error in one shows in all.
    const Eigen::MatrixXd cofactor =  // Q̃_v = I - J̃ C J̃ᵀ
        Eigen::MatrixXd::Identity(n, n) -
        group.jacobian * covariance(group.columns, group.columns) * group.jacobian.transpose();
    const auto lower = group.cholesky.triangularView<Eigen::Lower>();
    const Eigen::MatrixXd inverse = lower.solve(Eigen::MatrixXd::Identity(n, n));  // L⁻¹
    const Eigen::MatrixXd half = cofactor * inverse;
    GroupReliability result;
    result.residual = lower * group.residual;
    result.weighted = inverse.transpose() * group.residual;
    result.diagonal = inverse.cwiseProduct(half).colwise().sum().transpose();
    result.redundancy = group.cholesky.cwiseProduct(half.transpose()).rowwise().sum();
    for (Eigen::Index i = 0; i < n; ++i) {
        result.is_uncontrolled.push_back(!(result.diagonal[i] > k_uncontrolled * inverse.col(i).squaredNorm()));
    }
    return result;
}

}  // namespace

std::vector<DistanceReliability> distance_reliability(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                      const BorderedCovariance& covariance,
                                                      const StochasticModel& stochastic, double non_centrality) {
    const RotaryTableMeasurement& measurement = adjustment.measurement();
    const std::vector<bool>& active = adjustment.active();
    std::vector<DistanceReliability> rows(measurement.lengths.size());
    const auto tested = [&](std::size_t v) {
        const GroupReliability group = reliability_of(normal.groups()[v], covariance);
        const std::vector<std::size_t>& observations = adjustment.visits()[v].observations;
        for (std::size_t k = 0; k < observations.size(); ++k) {
            const auto i = static_cast<Eigen::Index>(k);
            DistanceReliability& row = rows[observations[k]];
            row.residual = -group.residual[i];
            row.redundancy_number = group.redundancy[i];
            if (!group.is_uncontrolled[k]) {
                // w = e_iᵀ V⁻¹ v/√M_ii with M = V⁻¹ Q_v V⁻¹: of all tests of one distance the most powerful one, also
                // with correlations.
                const double root = std::sqrt(group.diagonal[i]);
                row.test_value = -group.weighted[i] / root;
                row.minimal_detectable_bias = non_centrality / root;
                row.estimated_error = group.weighted[i] / group.diagonal[i];
            }
        }
    };
    constexpr std::size_t k_visits_of_a_part = 256;
    FixedParts(adjustment.visits().size(), k_visits_of_a_part)
        .run(adjustment.adjustment().workers(), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                tested(v);
            }
        });
    if (std::find(active.begin(), active.end(), false) == active.end()) {
        return rows;
    }

    // The visits with all their distances, at the present solution. Their parameters are the same blocks.
    JointAdjustment whole(measurement, std::vector<bool>(active.size(), true), adjustment.set_up(),
                          adjustment.present_values(), stochastic);
    whole.copy_parameters_from(adjustment);
    whole.set_weights(stochastic);
    const NormalEquations whole_normal = whole.adjustment().linearise();
    for (std::size_t v = 0; v < whole.visits().size(); ++v) {
        const std::vector<std::size_t>& observations = whole.visits()[v].observations;
        std::vector<Eigen::Index> kept;
        std::vector<Eigen::Index> left_out;
        for (std::size_t k = 0; k < observations.size(); ++k) {
            (active[observations[k]] ? kept : left_out).push_back(static_cast<Eigen::Index>(k));
        }
        if (left_out.empty()) {
            continue;
        }
        const LinearisedGroup& group = whole_normal.groups()[v];
        // A parameter that only the left-out distances would bring in (a reversal) is held, hence without column.
        std::vector<Eigen::Index> columns;
        std::vector<Eigen::Index> local;
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            const FreeParameter& parameter = whole_normal.parameters()[static_cast<std::size_t>(group.columns[c])];
            if (const Eigen::Index column = normal.column(parameter.block, parameter.component); column >= 0) {
                columns.push_back(column);
                local.push_back(static_cast<Eigen::Index>(c));
            }
        }
        const Eigen::MatrixXd design = (group.cholesky * group.jacobian)(Eigen::all, local);
        const Eigen::VectorXd difference = group.cholesky * group.residual;
        const Eigen::MatrixXd noise = group.cholesky * group.cholesky.transpose();
        const Eigen::MatrixXd parameters = covariance(columns, columns);
        // A distance that was left out is predicted from all others: through the parameters, and through the kept
        // distances of its visit, with which it has the deviation of the table in common.
        const Eigen::LLT<Eigen::MatrixXd> kept_factor(Eigen::MatrixXd(noise(kept, kept)));
        for (const Eigen::Index self : left_out) {
            double deviation = difference[self];
            double variance = noise(self, self);
            Eigen::RowVectorXd rate = design.row(self);
            if (!kept.empty()) {
                const Eigen::VectorXd cross = noise(kept, self);
                const Eigen::VectorXd weight = kept_factor.solve(cross);
                deviation -= weight.dot(difference(kept));
                variance -= weight.dot(cross);
                rate -= weight.transpose() * design(kept, Eigen::all);
            }
            variance += rate * parameters * rate.transpose();
            DistanceReliability& row = rows[observations[static_cast<std::size_t>(self)]];
            row.residual = -difference[self];
            // Nothing of it is in the solution: its whole error would show.
            row.redundancy_number = 1.0;
            row.test_value = -deviation / std::sqrt(variance);
            row.minimal_detectable_bias = non_centrality * std::sqrt(variance);
            row.estimated_error = deviation;
            row.removed = true;
        }
    }
    return rows;
}

std::vector<CoordinateReliability> fixture_reliability(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                       const BorderedCovariance& covariance, double non_centrality) {
    const GroupReliability group = reliability_of(normal.groups()[adjustment.fixture_prior()], covariance);
    std::vector<CoordinateReliability> rows(static_cast<std::size_t>(group.residual.size()));
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        rows[k].residual = -group.residual[i];
        rows[k].redundancy_number = group.redundancy[i];
        if (!group.is_uncontrolled[k]) {
            rows[k].test_value = -group.weighted[i] / std::sqrt(group.diagonal[i]);
            rows[k].minimal_detectable_bias = non_centrality / std::sqrt(group.diagonal[i]);
            rows[k].estimated_error = group.weighted[i] / group.diagonal[i];
        }
    }
    return rows;
}

double tau_critical_value(double student_critical_value, double degrees_of_freedom) {
    // Pope's tau: the residual is part of the estimate of the variance that it is divided by.
    const double t = student_critical_value;
    return std::sqrt(degrees_of_freedom) * t / std::sqrt(degrees_of_freedom - 1.0 + t * t);
}

OneAtATime::OneAtATime(const JointAdjustment& adjustment, const NormalEquations& normal,
                       const BorderedCovariance& covariance)
    : normal_(normal), covariance_(covariance), place_of_(adjustment.measurement().lengths.size(), 0) {
    Eigen::Index count = 0;
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        first_.push_back(count);
        count += normal.groups()[v].residual.size();
    }
    weighted_.resize(count);
    diagonal_.resize(count);
    floor_.resize(count);
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        const GroupReliability group = reliability_of(normal.groups()[v], covariance);
        const Eigen::Index n = group.residual.size();
        weighted_.segment(first_[v], n) = group.weighted;
        diagonal_.segment(first_[v], n) = group.diagonal;
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto at = static_cast<std::size_t>(i);
            // A distance that only the left-out ones controlled has no test value any more.
            floor_[first_[v] + i] =
                group.is_uncontrolled[at] ? std::numeric_limits<double>::infinity() : 1e-9 * group.diagonal[i];
            place_of_[adjustment.visits()[v].observations[at]] = places_.size();
            lengths_.push_back(adjustment.visits()[v].observations[at]);
            places_.push_back({v, i, first_[v] + i});
        }
    }
    out_.assign(places_.size(), false);
}

std::optional<OneAtATime::Suspect> OneAtATime::largest(double critical) const {
    double largest = critical * critical;
    std::size_t found = places_.size();
    for (std::size_t k = 0; k < places_.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        if (out_[k] || !(diagonal_[i] > floor_[i])) {
            continue;
        }
        if (const double square = weighted_[i] * weighted_[i] / diagonal_[i]; square > largest) {
            largest = square;
            found = k;
        }
    }
    if (found == places_.size()) {
        return std::nullopt;
    }
    const Place& place = places_[found];
    // The column of M is formed for the suspect only: all of them would be the dense matrix.
    const Eigen::MatrixXd& cholesky = normal_.groups()[place.visit].cholesky;
    const Eigen::VectorXd within = column(place).segment(first_[place.visit], cholesky.rows());
    const double redundancy = (cholesky.transpose() * within).dot(cholesky.row(place.row).transpose());  // (V M)_ii
    const double diagonal = diagonal_[place.index];
    return Suspect{lengths_[found], -weighted_[place.index] / std::sqrt(diagonal), redundancy,
                   weighted_[place.index] / diagonal};
}

Eigen::VectorXd OneAtATime::column(const Place& place) const {
    const LinearisedGroup& own = normal_.groups()[place.visit];
    Eigen::VectorXd whitened = Eigen::VectorXd::Unit(own.residual.size(), place.row);
    own.cholesky.triangularView<Eigen::Lower>().solveInPlace(whitened);
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(covariance_.size());
    pull(own.columns) = own.jacobian.transpose() * whitened;
    const Eigen::VectorXd shift = covariance_.times(pull);  // of the parameters
    Eigen::VectorXd result(weighted_.size());
    for (std::size_t v = 0; v < first_.size(); ++v) {
        // M e_i = V⁻¹ (e_i − J Q Jᵀ V⁻¹ e_i): what its error does to the residuals of all visits.
        const LinearisedGroup& group = normal_.groups()[v];
        Eigen::VectorXd part = -(group.jacobian * shift(group.columns));
        if (v == place.visit) {
            part += whitened;
        }
        group.cholesky.triangularView<Eigen::Lower>().transpose().solveInPlace(part);
        result.segment(first_[v], part.size()) = part;
    }
    for (const LeftOut& left_out : left_out_) {
        result -= left_out.column * (left_out.column[place.index] / left_out.diagonal);
    }
    return result;
}

void OneAtATime::leave_out(std::size_t length) {
    const std::size_t at = place_of_[length];
    const Place& place = places_[at];
    LeftOut left_out{column(place), diagonal_[place.index]};
    // Leaving out is a change of rank one at fixed weights: no new adjustment for every suspect.
    weighted_ -= left_out.column * (weighted_[place.index] / left_out.diagonal);
    diagonal_ -= left_out.column.cwiseAbs2() / left_out.diagonal;
    out_[at] = true;
    left_out_.push_back(std::move(left_out));
}

}  // namespace gumcert::engine
