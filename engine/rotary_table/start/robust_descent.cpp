#include "engine/rotary_table/start/robust_descent.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/median.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

// Set-up errors are of millimetres and a degree at most; this prior only keeps what a short turn leaves open near zero.
constexpr double k_set_up_offset = 5.0 * gum::k_millimetre;
constexpr double k_set_up_tilt = gum::k_degree;
constexpr double k_typical_deviation = gum::k_micrometre;  // against which the prior is weighed
// Of the strong prior, weighed against what error motions leave.
constexpr double k_rough_deviation = 10.0 * gum::k_micrometre;
constexpr double k_rough_offset = 20.0 * gum::k_millimetre;
constexpr double k_rough_tilt = 5.0 * gum::k_degree;
constexpr double k_reach = 2.0;  // [m], of a station from the middle of its points

/// Weight of Cauchy's function for the scale c. It falls with the square of a deviation: a length that is wrong by a metre has
/// no pull left.
double weight_of(double deviation, double c) {
    const double ratio = deviation / c;
    return 1.0 / (1.0 + ratio * ratio);
}

/// Deviations centred by their weighted means, path by path. Weights and weighted centres depend on each other, so that both
/// are made again.
Eigen::VectorXd centred(const StationDistances& data, Eigen::VectorXd deviation, double c) {
    for (const std::vector<Eigen::Index>& members : data.members) {
        for (int round = 0; round < 2; ++round) {
            double sum = 0.0;
            double weights = 0.0;
            for (const Eigen::Index i : members) {
                const double weight = weight_of(deviation[i], c);
                sum += weight * deviation[i];
                weights += weight;
            }
            const double centre = sum / weights;
            for (const Eigen::Index i : members) {
                deviation[i] -= centre;
            }
        }
    }
    return deviation;
}

/// Cost of centred deviations, or some value that is above it as soon as it and what there is already are above `most`: then
/// the rest of the deviations does not matter.
double cost_of(const Eigen::VectorXd& deviation, double c, double already = 0.0,
               double most = std::numeric_limits<double>::infinity()) {
    double cost = 0.0;
    for (const double one : deviation) {
        const double ratio = one / c;
        cost += std::log1p(ratio * ratio);
        if (already + cost > most) {
            break;
        }
    }
    return cost;
}

/// Steps that a set-up and stations take before they are near, in units of which plain least squares are damped
/// (Levenberg–Marquardt): damping in units of the distances leaves a narrow valley for another one.
Eigen::VectorXd usual_steps(std::size_t stations) {
    Eigen::VectorXd steps = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(4 + 3 * stations), 0.1);  // [m]
    steps.head<4>() << 0.001, 0.001, 0.01, 0.01;  // [m], [m], [rad], [rad]
    return steps;
}

}  // namespace

double StationFit::upright_misfit() const {
    constexpr double k_overturned = 0.5;  // [rad]
    constexpr double k_hopeless = 1.0;    // [m]
    return set_up.tail<2>().norm() > k_overturned ? k_hopeless : misfit;
}

bool StationFit::is_settled() const {
    return upright_misfit() <= k_good_misfit;
}

void descend(const ObservedStations& observed, const std::vector<std::size_t>& of, Eigen::Vector4d& set_up,
             std::vector<StationFit>& fits, bool free_set_up, double step_tolerance, Pull pull, Prior knowledge) {
    constexpr int k_steps = 60;
    constexpr double k_most_usual_steps = 6.0;  // at once
    const std::vector<StationDistances>& stations = observed.stations();
    const bool plain = pull == Pull::of_all;
    const auto size = static_cast<Eigen::Index>(4 + 3 * of.size());
    double damping = 1e-6;
    std::vector<PointPositions> at(of.size());
    std::vector<Eigen::VectorXd> raw(of.size());
    std::vector<double> values;
    const auto evaluate = [&](const Eigen::Vector4d& with, const std::vector<StationFit>& where, bool new_set_up) {
        for (std::size_t k = 0; k < of.size(); ++k) {
            if (new_set_up) {
                observed.locate(of[k], with, at[k]);
            }
            raw[k] = deviations_from(stations[of[k]], at[k].point, where[of[k]].position).each;
        }
    };
    // The scale follows the deviations down: far from the solution all lengths pull, near it only those that agree.
    // At exact data it ends at a nanometre.
    const auto scale_of = [&] {
        values.clear();
        for (std::size_t k = 0; k < of.size(); ++k) {
            collect_sizes(stations[of[k]], raw[k], values);
        }
        if (values.empty()) {
            return 1e-9;
        }
        if (plain) {
            constexpr double k_far_above_all = 1e3;
            return std::max(k_far_above_all * *std::ranges::max_element(values), 1e-6);
        }
        return std::max(2.5 * k_mad_to_deviation * median(values), 1e-9);
    };
    const bool strong = knowledge == Prior::strong;
    std::vector<Eigen::Vector3d> middle(of.size(), Eigen::Vector3d::Zero());  // of the points of each station
    // The weak one is weak beside any distance: it only decides what they leave open (k_set_up_offset).
    const auto prior = [&](const Eigen::Vector4d& with, const std::vector<StationFit>& where, double c) {
        if (!strong) {
            return std::pow(k_typical_deviation / c, 2) *
                   (with.head<2>().squaredNorm() / (k_set_up_offset * k_set_up_offset) +
                    with.tail<2>().squaredNorm() / (k_set_up_tilt * k_set_up_tilt));
        }
        double squares = with.head<2>().squaredNorm() / (k_rough_offset * k_rough_offset) +
                         with.tail<2>().squaredNorm() / (k_rough_tilt * k_rough_tilt);
        for (std::size_t k = 0; k < of.size(); ++k) {
            squares += (where[of[k]].position - middle[k]).squaredNorm() / (k_reach * k_reach);
        }
        return std::pow(k_rough_deviation / c, 2) * squares;
    };
    Eigen::MatrixXd normal(size, size);
    Eigen::VectorXd right(size);
    std::vector<StationFit> trial = fits;
    // Positions and deviations are those of the present set-up and places at the beginning of every step.
    evaluate(set_up, fits, true);
    for (std::size_t k = 0; k < of.size() && strong; ++k) {
        for (const Eigen::Vector3d& point : at[k].point) {
            middle[k] += point / static_cast<double>(at[k].point.size());
        }
    }
    for (int step = 0; step < k_steps; ++step) {
        for (std::size_t k = 0; k < of.size(); ++k) {
            if (free_set_up || step == 0) {
                observed.derive(of[k], set_up, at[k]);
            }
        }
        const double c = scale_of();
        normal.setZero();
        right.setZero();
        double cost = prior(set_up, fits, c);
        for (std::size_t k = 0; k < of.size(); ++k) {
            const StationDistances& data = stations[of[k]];
            const Eigen::VectorXd deviation = centred(data, raw[k], c);
            const Eigen::VectorXd weight = deviation.unaryExpr([c](double one) { return weight_of(one, c); });
            cost += cost_of(deviation, c);
            Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> rows(deviation.size(), 7);
            for (Eigen::Index i = 0; i < rows.rows(); ++i) {
                const auto index = static_cast<std::size_t>(i);
                const Eigen::Vector3d direction = (at[k].point[index] - fits[of[k]].position).normalized();
                rows.row(i).head<4>() = direction.transpose() * at[k].by_set_up[index];
                rows.row(i).tail<3>() = -direction.transpose();
            }
            // A dead path is eliminated by taking off the weighted means of its rows, as its constant was taken off
            // the deviations.
            for (const std::vector<Eigen::Index>& members : data.members) {
                Eigen::Matrix<double, 1, 7> mean = Eigen::Matrix<double, 1, 7>::Zero();
                double weights = 0.0;
                for (const Eigen::Index i : members) {
                    mean += weight[i] * rows.row(i);
                    weights += weight[i];
                }
                mean /= weights;
                for (const Eigen::Index i : members) {
                    rows.row(i) -= mean;
                }
            }
            const auto from = static_cast<Eigen::Index>(4 + 3 * k);
            const Eigen::Matrix<double, 7, 7> part = rows.transpose() * weight.asDiagonal() * rows / (c * c);
            const Eigen::Matrix<double, 7, 1> gradient = rows.transpose() * weight.cwiseProduct(deviation) / (c * c);
            normal.topLeftCorner<4, 4>() += part.topLeftCorner<4, 4>();
            normal.block<3, 3>(from, from) = part.bottomRightCorner<3, 3>();
            normal.block<3, 4>(from, 0) = part.bottomLeftCorner<3, 4>();
            normal.block<4, 3>(0, from) = part.topRightCorner<4, 3>();
            right.head<4>() -= gradient.head<4>();
            right.segment<3>(from) = -gradient.tail<3>();
            if (strong) {
                const double weight_of_reach = std::pow(k_rough_deviation / (c * k_reach), 2);
                normal.diagonal().segment<3>(from).array() += weight_of_reach;
                right.segment<3>(from) += weight_of_reach * (middle[k] - fits[of[k]].position);
            }
        }
        for (Eigen::Index z = 0; z < 4; ++z) {
            const double width = z < 2 ? k_set_up_offset : k_set_up_tilt;
            const double weight = strong
                                      ? std::pow(k_rough_deviation / (c * (z < 2 ? k_rough_offset : k_rough_tilt)), 2)
                                      : std::pow(k_typical_deviation / (c * width), 2);
            normal(z, z) += weight;
            right[z] -= weight * set_up[z];
            // Rows and columns of a held set-up become those of the identity: the system keeps its size.
            if (!free_set_up) {
                normal.row(z).setZero();
                normal.col(z).setZero();
                normal(z, z) = 1.0;
                right[z] = 0.0;
            }
        }
        const Eigen::VectorXd scale =
            plain ? usual_steps(of.size())
                  : normal.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse().eval();
        const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
        const double unit = plain ? scaled.trace() : 1.0;
        bool better = false;
        double largest = 0.0;
        // At exact data the cost is rounding, and rounding must not look like a step in the wrong direction.
        const double most = cost * (1.0 + 1e-9);
        while (damping < 1e8) {
            Eigen::MatrixXd damped = scaled;
            damped.diagonal().array() += damping * unit;
            const Eigen::VectorXd change = scale.asDiagonal() * damped.ldlt().solve(scale.asDiagonal() * right);
            const Eigen::Vector4d next = set_up + change.head<4>();
            largest = change.cwiseAbs().maxCoeff();
            for (std::size_t k = 0; k < of.size(); ++k) {
                trial[of[k]].position = fits[of[k]].position + change.segment<3>(static_cast<Eigen::Index>(4 + 3 * k));
            }
            double after = std::numeric_limits<double>::infinity();
            // A step of many metres or radians leads nowhere: it is damped before anything is evaluated.
            if (change.allFinite() && largest < 5.0 &&
                (!plain || change.cwiseQuotient(scale).norm() < k_most_usual_steps)) {
                evaluate(next, trial, free_set_up);
                after = prior(next, trial, c);
                for (std::size_t k = 0; k < of.size() && !(after > most); ++k) {
                    after += cost_of(centred(stations[of[k]], raw[k], c), c, after, most);
                }
            }
            if (after <= most) {
                better = true;
                set_up = next;
                for (const std::size_t j : of) {
                    fits[j].position = trial[j].position;
                }
                damping = std::max(0.1 * damping, 1e-12);
                break;
            }
            damping = std::max(10.0 * damping, 1e-9);
        }
        if (!better || largest < step_tolerance) {
            break;
        }
    }
    for (const std::size_t j : of) {
        fits[j].misfit = misfit_of(stations[j], observed.deviations(j, set_up, fits[j].position).each);
    }
}

StationFit refined(const ObservedStations& observed, std::size_t station, const Eigen::Vector3d& from,
                   const Eigen::Vector4d& set_up, bool free_set_up, Pull pull, Prior knowledge) {
    std::vector<StationFit> fits(observed.stations().size());
    fits[station].position = from;
    Eigen::Vector4d own = set_up;
    const double tolerance = free_set_up ? k_coarse_step : k_fine_step;
    if (pull == Pull::of_all) {
        descend(observed, {station}, own, fits, free_set_up, tolerance, Pull::of_all, knowledge);
    }
    descend(observed, {station}, own, fits, free_set_up, tolerance, Pull::of_those_that_agree, knowledge);
    fits[station].set_up = own;
    return fits[station];
}

}  // namespace gumcert::engine
