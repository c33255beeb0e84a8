#include "engine/rotary_table/external_reliability.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

namespace {

/// Minimal detectable biases of all active distances as changes of what the quantities are made of.
struct Biases {
    std::vector<std::size_t> length;             ///< of each column
    std::vector<std::vector<Eigen::Index>> own;  ///< columns of each angle
    Eigen::MatrixXd shared;                      ///< T times the bias, r×n
    Eigen::MatrixXd local;                       ///< O times the bias, q×n
};

Biases biases_of(const AnglewiseSensitivity& sensitivity, const JointAdjustment& adjustment,
                 const std::vector<DistanceReliability>& rows) {
    Biases biases;
    biases.own.resize(adjustment.measurement().angles.size());
    Eigen::Index count = 0;
    for (const Visit& visit : adjustment.visits()) {
        count += static_cast<Eigen::Index>(visit.observations.size());
    }
    biases.shared.resize(sensitivity.shared().cols(), count);
    Eigen::Index column = 0;
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        const AnglewiseSensitivity::OfVisit of = sensitivity.of_visit(v);
        biases.local.resize(v == 0 ? of.own.rows() : biases.local.rows(), v == 0 ? count : biases.local.cols());
        const std::vector<std::size_t>& observations = adjustment.visits()[v].observations;
        for (std::size_t k = 0; k < observations.size(); ++k, ++column) {
            // A distance that nothing controls has no detectable bias, and 0 stands here: it takes no part in the
            // search.
            const double bias = rows[observations[k]].minimal_detectable_bias;
            biases.shared.col(column) = bias * of.shared.col(static_cast<Eigen::Index>(k));
            biases.local.col(column) = bias * of.own.col(static_cast<Eigen::Index>(k));
            biases.length.push_back(observations[k]);
            biases.own[static_cast<std::size_t>(of.angle)].push_back(column);
        }
    }
    return biases;
}

/// Upper bounds |h·t| ≤ row(h) column(t) by the inequality of Cauchy and Schwarz in the metric of the biases, in which
/// it is close.
struct Bounds {
    Eigen::VectorXd row, column;
    std::vector<Eigen::Index> order;  ///< columns by falling bound
};

Bounds bounds_of(const TallMatrix& quantities, const Eigen::MatrixXd& biases) {
    constexpr double k_floor = 1e-12;  // directions that no bias has are no part of any product
    const Eigen::VectorXd scale = biases.rowwise().norm();
    const Eigen::VectorXd inverse = (scale.array() > 0.0).select(scale.array().inverse(), 0.0);
    const Eigen::MatrixXd scaled = inverse.asDiagonal() * biases;
    Eigen::MatrixXd metric = Eigen::MatrixXd::Identity(scaled.rows(), scaled.rows()) * k_floor;
    metric.selfadjointView<Eigen::Lower>().rankUpdate(scaled);
    const Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd(metric.selfadjointView<Eigen::Lower>()));
    Bounds bounds;
    bounds.row = (quantities * scale.asDiagonal() * factor.matrixL()).rowwise().norm();
    bounds.column = factor.matrixL().solve(scaled).colwise().norm();
    bounds.order.resize(static_cast<std::size_t>(biases.cols()));
    std::iota(bounds.order.begin(), bounds.order.end(), Eigen::Index{0});
    std::ranges::stable_sort(bounds.order,
                             [&](Eigen::Index a, Eigen::Index b) { return bounds.column[a] > bounds.column[b]; });
    return bounds;
}

}  // namespace

std::vector<ExternalReliability> external_reliability(const AnglewiseSensitivity& sensitivity,
                                                      const JointAdjustment& adjustment,
                                                      const std::vector<DistanceReliability>& rows) {
    constexpr double k_slack = 1.0 + 1e-9;  // rounding of the bounds
    const Biases biases = biases_of(sensitivity, adjustment, rows);
    const Eigen::MatrixXd by_quantity = sensitivity.shared().transpose();  // a quantity is a column in memory
    const Bounds bounds = bounds_of(sensitivity.shared(), biases.shared);
    const Eigen::Index q = biases.local.rows();
    const Eigen::Index of_angles = q * static_cast<Eigen::Index>(biases.own.size());
    std::vector<ExternalReliability> worst;
    for (Eigen::Index i = 0; i < by_quantity.cols(); ++i) {
        const auto quantity = by_quantity.col(i);
        const auto angle = static_cast<std::size_t>(i / q);
        double largest = 0.0;
        Eigen::Index place = biases.shared.cols();
        // Of equal influences the first column, so that the order in which they are looked at is not seen.
        const auto look_at = [&](Eigen::Index column, double influence) {
            const double size = std::abs(influence);
            if (size > std::abs(largest) || (size == std::abs(largest) && size > 0.0 && column < place)) {
                largest = influence;
                place = column;
            }
        };
        if (i < of_angles) {
            // Distances of the same angle first: they act on its own pose too, which the bounds of the shared part do
            // not cover. A large value found here also ends the search below early.
            for (const Eigen::Index column : biases.own[angle]) {
                look_at(column, quantity.dot(biases.shared.col(column)) + biases.local(i % q, column));
            }
        }
        // By falling bounds: from the first one on that cannot exceed what was found, none can.
        for (const Eigen::Index column : bounds.order) {
            if (bounds.row[i] * bounds.column[column] * k_slack < std::abs(largest)) {
                break;
            }
            // These were looked at with both parts; the shared part alone would be another number for the same
            // distance.
            const bool own = i < of_angles && std::ranges::binary_search(biases.own[angle], column);
            if (!own) {
                look_at(column, quantity.dot(biases.shared.col(column)));
            }
        }
        // A quantity that no bias moves, as those of home in its own datum, has no worst distance.
        if (largest != 0.0) {
            worst.push_back({static_cast<std::size_t>(i), biases.length[static_cast<std::size_t>(place)], largest});
        }
    }
    return worst;
}

}  // namespace gumcert::engine
