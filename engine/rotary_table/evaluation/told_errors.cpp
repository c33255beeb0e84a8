#include "engine/rotary_table/evaluation/told_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <ranges>

#include "engine/rotary_table/visit_effects.h"

namespace gumcert::engine {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd columns_of_all(const std::vector<GroupTest>& told) {
    const Index unknowns = std::accumulate(told.begin(), told.end(), Index{0},
                                           [](Index sum, const GroupTest& test) { return sum + test.columns.cols(); });
    MatrixXd columns(told.front().columns.rows(), unknowns);
    Index at = 0;
    for (const GroupTest& test : told) {
        columns.middleCols(at, test.columns.cols()) = test.columns;
        at += test.columns.cols();
    }
    return columns;
}

/// What an adjustment says of unknowns, of which each is counted in parts that do as much to the distances as all others: metres and
/// relative sizes count alike in the rank.
struct JointEstimate {
    VectorXd part;      ///< of each unknown
    VectorXd values;    ///< in parts
    MatrixXd spread;    ///< Cᵀ M C
    MatrixXd cofactor;  ///< its pseudo-inverse
    double least = 0.0;
};

JointEstimate estimate_jointly(const MatrixXd& columns, const JointAdjustment& at, const NormalEquations& normal,
                               const BorderedCovariance& covariance) {
    const VisitEffects visits(at, normal, covariance);
    JointEstimate result;
    result.part = columns.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    VisitEffects::Effect effect(visits.size());
    for (std::size_t g = 0; g < visits.size(); ++g) {
        const std::vector<std::size_t>& observations = at.visits()[g].observations;
        const MatrixXd own = columns(observations, Eigen::all) * result.part.asDiagonal();
        if ((own.array() != 0.0).any()) {
            effect[g] = own;
        }
    }
    VisitEffects::Projection projection = visits.projection(effect, columns.cols());
    result.least = k_controlled * projection.weight;
    result.spread = std::move(projection.spread);
    result.cofactor = pseudo_inverse(result.spread, result.least).inverse;
    result.values = result.cofactor * projection.weighted;
    return result;
}

bool is_of_coordinates(const GroupTest& test) {
    return test.kind == GroupKind::reflector || test.kind == GroupKind::fixture_scale;
}

/// Takes one error off, of stated values where it is one of them.
void take_error_off(RotaryTableMeasurement& measurement, const GroupTest& test, const VectorXd& unknowns) {
    switch (test.kind) {
        case GroupKind::fixture_scale:
            measurement.fixture /= 1.0 + unknowns[0];
            return;
        case GroupKind::reflector:
            measurement.fixture.row(static_cast<Index>(test.reflector)) -= unknowns.transpose();
            return;
        case GroupKind::expansion:
            measurement.expansion -= unknowns[0];
            return;
        case GroupKind::station_scale:
            for (LengthObservation& length : measurement.lengths) {
                length.length /= length.station == test.station ? 1.0 + unknowns[0] : 1.0;
            }
            return;
        default: {
            const VectorXd errors = test.columns * unknowns;
            for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
                measurement.lengths[i].length -= errors[static_cast<Index>(i)];
            }
        }
    }
}

/// A group among those that are told: its unknowns, and what the others leave of it.
struct Told {
    std::vector<Index> unknowns;
    int rank = 0;         ///< of its own
    int rank_beside = 0;  ///< that is left of it beside the others
    double chi_square = 0.0;
    MatrixXd cofactor = {};  ///< of its unknowns, in parts

    [[nodiscard]] bool is_determined() const { return rank > 0 && rank_beside == rank; }
};

/// Unknowns of all groups but one.
std::vector<Index> unknowns_of(const std::vector<Told>& all, const Told* but = nullptr) {
    std::vector<Index> unknowns;
    for (const Told& group : all) {
        if (&group != but) {
            unknowns.insert(unknowns.end(), group.unknowns.begin(), group.unknowns.end());
        }
    }
    return unknowns;
}

/// Errors of some of the groups, where those of the others are none. In the linear model J of all of them: S x = Cᵀ V⁻¹ v.
/// \param pull  S x of all of them
/// \return of all unknowns, 0 of those of other groups
VectorXd errors_beside_each_other(std::vector<Told>& groups, const JointEstimate& estimate, const VectorXd& pull) {
    const auto rank = [&](const std::vector<Index>& of) {
        return of.empty() ? 0 : pseudo_inverse(MatrixXd(estimate.spread(of, of)), estimate.least).rank;
    };
    const std::vector<Index> all = unknowns_of(groups);
    const Inverted inverted = pseudo_inverse(MatrixXd(estimate.spread(all, all)), estimate.least);
    VectorXd errors = VectorXd::Zero(pull.size());
    errors(all) = inverted.inverse * pull(all);
    Index at = 0;
    for (Told& group : groups) {
        const Index count = std::ssize(group.unknowns);
        group.rank = rank(group.unknowns);
        group.rank_beside = inverted.rank - rank(unknowns_of(groups, &group));
        group.cofactor = inverted.inverse.block(at, at, count, count);
        const VectorXd own = errors(group.unknowns);
        group.chi_square = own.dot(pseudo_inverse(group.cofactor, k_controlled * group.cofactor.trace()).inverse * own);
        at += count;
    }
    return errors;
}

/// Standard uncertainty of the size of a group; the derivatives by the unknowns are differences over their uncertainties.
double u_of_size(const GroupTest& test, const VectorXd& unknowns, const MatrixXd& covariance,
                 const Eigen::MatrixX3d& fixture) {
    VectorXd derivatives = VectorXd::Zero(unknowns.size());
    for (Index k = 0; k < unknowns.size(); ++k) {
        const double step = std::sqrt(std::max(0.0, covariance(k, k)));
        if (step > 0.0) {
            const VectorXd by = step * VectorXd::Unit(unknowns.size(), k);
            derivatives[k] =
                (size_of_error(test, unknowns + by, fixture) - size_of_error(test, unknowns - by, fixture)) /
                (2.0 * step);
        }
    }
    return std::sqrt(std::max(0.0, derivatives.dot(covariance * derivatives)));
}

}  // namespace

ErrorModel errors_of_groups(const std::vector<GroupTest>& told) {
    const MatrixXd columns = columns_of_all(told);
    const auto take_off = [told](RotaryTableMeasurement& measurement, const VectorXd& unknowns) {
        // Coordinates last: what a group does to the distances is not changed by where they are.
        for (const bool of_coordinates : {false, true}) {
            Index at = 0;
            for (const GroupTest& test : told) {
                if (is_of_coordinates(test) == of_coordinates) {
                    take_error_off(measurement, test, unknowns.segment(at, test.columns.cols()));
                }
                at += test.columns.cols();
            }
        }
    };
    const auto sizes = [columns](const JointAdjustment& at, const NormalEquations& normal,
                                 const BorderedCovariance& covariance) {
        const JointEstimate estimate = estimate_jointly(columns, at, normal, covariance);
        return SizesLeft{estimate.part.cwiseProduct(estimate.values),
                         estimate.part.cwiseProduct(estimate.cofactor.diagonal().cwiseMax(0.0).cwiseSqrt())};
    };
    return {columns.cols(), take_off, sizes};
}

bool take_joint_sizes(std::vector<GroupTest>& told, const std::vector<Visit>& visits, const VectorXd& taken_off,
                      const JointAdjustment& without, double scale,
                      const std::function<double(double, double)>& upper_tail) {
    constexpr double k_three_u = 0.0027;  // of a normal deviate
    const NormalEquations normal = without.adjustment().linearise();
    const JointEstimate left = estimate_jointly(columns_of_all(told), without, normal, normal.bordered_covariance());
    const VectorXd pull = left.spread * (taken_off.cwiseQuotient(left.part) + left.values);
    std::vector<Told> groups(told.size());
    Index at = 0;
    for (std::size_t k = 0; k < told.size(); ++k) {
        for (Index j = 0; j < told[k].columns.cols(); ++j) {
            groups[k].unknowns.push_back(at++);
        }
    }
    VectorXd errors = errors_beside_each_other(groups, left, pull);
    const std::size_t count = told.size();
    while (groups.size() > 1) {
        const auto explained = [&](const Told& group) {
            return group.is_determined() &&
                   upper_tail(std::max(0.0, group.chi_square) / (scale * scale), group.rank) >= k_three_u;
        };
        auto least = groups.end();
        for (auto group = groups.begin(); group != groups.end(); ++group) {
            if (explained(*group) && (least == groups.end() || group->chi_square < least->chi_square)) {
                least = group;
            }
        }
        if (least == groups.end()) {
            break;
        }
        told.erase(told.begin() + (least - groups.begin()));
        groups.erase(least);
        errors = errors_beside_each_other(groups, left, pull);
    }
    errors = errors.cwiseProduct(left.part);
    for (std::size_t k = 0; k < told.size(); ++k) {
        GroupTest& test = told[k];
        test.is_determined = groups[k].is_determined();
        test.is_settled = test.is_settled || test.is_determined;
        const VectorXd own = errors(groups[k].unknowns);
        test.estimate = size_of_error(test, own, without.measurement().fixture);
        const VectorXd part = scale * left.part(groups[k].unknowns);
        test.u = u_of_size(test, own, part.asDiagonal() * groups[k].cofactor * part.asDiagonal(),
                           without.measurement().fixture);
        const VectorXd of_distances = test.columns * own;
        for (auto& [visit, error] : test.errors) {
            error = of_distances[static_cast<Index>(visits[visit].observations.front())];
        }
    }
    return told.size() == count;
}

}  // namespace gumcert::engine
