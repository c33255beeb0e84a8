#include "engine/rotary_table/rotary_table_contributions.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "engine/rotary_table/datum.h"

namespace gumcert::engine {

namespace {

/// Groups of inputs whose members belong to single visits: C of a visit is H T + O (AnglewiseSensitivity).
class OfVisits {
public:
    OfVisits(Eigen::Index group, const AnglewiseMap& map, Eigen::Index shared)
        : group_(group),
          all_(Eigen::MatrixXd::Zero(shared, shared)),
          angle_(all_),
          direct_(Eigen::VectorXd::Zero(map.rows())) {}

    [[nodiscard]] Eigen::Index group() const { return group_; }

    /// \param shared, own  T and O by the inputs of a visit, times their standard uncertainties
    /// \param rows         H of the angle of the visit
    void add(const Eigen::MatrixXd& shared, const Eigen::MatrixXd& own, const Eigen::Ref<const TallMatrix>& rows,
             Eigen::Index first_row) {
        // A visit acts on the quantities of its own angle through O as well: there the whole H T + O is squared, and
        // close_angle() takes off the square of H T alone, which all quantities get.
        angle_.selfadjointView<Eigen::Lower>().rankUpdate(shared);
        direct_.segment(first_row, rows.rows()) += (rows * shared + own).rowwise().squaredNorm();
    }

    /// After all visits of an angle: its own quantities have these contributions already, as whole squares.
    void close_angle(const Eigen::Ref<const TallMatrix>& rows, Eigen::Index first_row) {
        direct_.segment(first_row, rows.rows()) -= squares(rows, angle_);
        all_ += angle_;
        angle_.setZero();
    }

    /// Contribution to every quantity, with all angles closed.
    [[nodiscard]] Eigen::VectorXd variance(const TallMatrix& rows) const {
        // The subtraction of close_angle() may leave rounding of either sign.
        return (direct_ + squares(rows, all_)).cwiseMax(0.0);
    }

private:
    /// Diagonal of H M Hᵀ; M is stored below its diagonal.
    static Eigen::VectorXd squares(const Eigen::Ref<const TallMatrix>& rows, const Eigen::MatrixXd& middle) {
        const TallMatrix product = rows * middle.selfadjointView<Eigen::Lower>();
        return product.cwiseProduct(rows).rowwise().sum();
    }

    Eigen::Index group_;
    Eigen::MatrixXd all_, angle_;
    Eigen::VectorXd direct_;
};

/// Standard uncertainties of the members of a group without correlation.
Eigen::ArrayXd uncertainties(const gum::InputGroup& group) {
    return group.covariance.col(0).array().sqrt();
}

/// Standard uncertainty of a group whose members have the same.
double common_uncertainty(const gum::InputGroup& group) {
    return std::sqrt(group.covariance(0, 0));
}

/// A root R of the covariance of a group, n×n: R Rᵀ.
Eigen::MatrixXd root_of(const gum::InputGroup& group) {
    if (group.is_diagonal()) {
        return uncertainties(group).matrix().asDiagonal();
    }
    // To correlations first: a root by LDLᵀ with pivots exists for singular groups as well.
    const Eigen::VectorXd u = group.covariance.diagonal().cwiseSqrt();
    const Eigen::VectorXd inverse = (u.array() > 0.0).select(u.array().inverse(), 0.0);
    Eigen::MatrixXd correlation = inverse.asDiagonal() * group.covariance * inverse.asDiagonal();
    correlation.diagonal().setOnes();
    const Eigen::LDLT<Eigen::MatrixXd> factor(correlation);
    Eigen::MatrixXd root = factor.matrixL();
    root = (root * factor.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal()).eval();
    return u.asDiagonal() * (factor.transpositionsP().transpose() * root);
}

std::vector<std::vector<std::size_t>> visits_by_angle(const JointAdjustment& adjustment) {
    std::vector<std::vector<std::size_t>> result(adjustment.measurement().angles.size());
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        result[adjustment.visits()[v].angle].push_back(v);
    }
    return result;
}

/// First length of every visit among the inputs.
std::vector<Eigen::Index> first_lengths(const JointAdjustment& adjustment) {
    std::vector<Eigen::Index> result;
    Eigen::Index next = 0;
    for (const Visit& visit : adjustment.visits()) {
        result.push_back(next);
        next += static_cast<Eigen::Index>(visit.observations.size());
    }
    return result;
}

// In proportion to the angles. A row a quantity and a column an input took 10 s and 1 GB for 360 angles, and grew with
// the cube and the square of them (ADR 0032).
class Contributions {
public:
    Contributions(const RotaryTableModel& model, const AnglewiseMap& map)
        : model_(model),
          map_(map),
          adjustment_(model.solved()),
          normal_(model.equations()),
          covariance_(model.parameter_covariance()),
          sensitivity_(map, adjustment_, normal_, covariance_),
          middle_(Eigen::MatrixXd::Zero(sensitivity_.shared().cols(), sensitivity_.shared().cols())),
          cross_(TallMatrix::Zero(map.rows(), middle_.cols())),
          own_(TallMatrix::Zero(map.local.rows(), map.per_angle())) {
        result_.variance.resize(model.inputs().size());
        result_.sensitivity.resize(model.inputs().size());
    }

    RotaryTableContributions all() {
        add_visits();
        add_priors();
        finish();
        return std::move(result_);
    }

private:
    /// Index of the group of inputs that starts at an index among all inputs.
    [[nodiscard]] Eigen::Index group_at(Eigen::Index input) const {
        Eigen::Index first = 0;
        for (std::size_t g = 0; g < model_.inputs().size(); ++g) {
            if (first == input) {
                return static_cast<Eigen::Index>(g);
            }
            first += model_.inputs()[g].size();
        }
        return -1;
    }
    [[nodiscard]] const gum::InputGroup& input(const OfVisits& of) const {
        return model_.inputs()[static_cast<std::size_t>(of.group())];
    }

    /// Inputs of single visits, angle by angle, and what the dead paths take from their lengths.
    void add_visits() {
        const RotaryTableInputs& layout = model_.layout();
        const Eigen::Index columns = middle_.cols();
        OfVisits lengths(group_at(0), map_, columns);
        OfVisits linear(group_at(layout.linear), map_, columns);
        OfVisits axial(group_at(layout.axial), map_, columns);
        OfVisits tilt(group_at(layout.tilt), map_, columns);
        std::optional<OfVisits> resolution;
        if (layout.resolution < layout.size) {
            resolution.emplace(group_at(layout.resolution), map_, columns);
        }
        std::vector<OfVisits*> groups{&lengths, &linear, &axial, &tilt};
        if (resolution) {
            groups.push_back(&*resolution);
        }
        const RotaryTableMeasurement& measurement = model_.measurement();
        const auto order = repeatability_order(measurement.axis);
        const auto paths = static_cast<Eigen::Index>(measurement.dead_paths.size());
        path_shared_ = Eigen::MatrixXd::Zero(columns, paths);
        path_own_ = TallMatrix::Zero(map_.rows(), paths);
        const Eigen::ArrayXd u_length = uncertainties(input(lengths));
        const std::vector<Eigen::Index> first = first_lengths(adjustment_);
        const std::vector<std::vector<std::size_t>> by_angle = visits_by_angle(adjustment_);
        const Eigen::Index q = map_.per_angle();
        // Angle by angle, so that the sums of one can be closed before the next one begins.
        for (std::size_t a = 0; a < by_angle.size(); ++a) {
            const Eigen::Index row = q * static_cast<Eigen::Index>(a);
            const auto rows = sensitivity_.shared().middleRows(row, q);
            for (const std::size_t v : by_angle[a]) {
                const AnglewiseSensitivity::OfVisit of = sensitivity_.of_visit(v);
                const Eigen::Index n = of.shared.cols();
                const auto u = u_length.segment(first[v], n).matrix().asDiagonal();
                lengths.add(of.shared * u, of.own * u, rows, row);
                Eigen::MatrixXd spread = u_length.segment(first[v], n).square().matrix().asDiagonal();
                if (resolution) {
                    const double u_step = common_uncertainty(input(*resolution));
                    resolution->add(of.shared * u_step, of.own * u_step, rows, row);
                    spread.diagonal().array() += u_step * u_step;
                }
                const Eigen::MatrixXd pose = model_.visit_pose(v)(Eigen::all, order);
                Eigen::Index c = 0;
                for (OfVisits* group : {&linear, &axial, &tilt}) {
                    const Eigen::Index size = group == &linear ? 3 : group == &axial ? 1 : 2;
                    const Eigen::MatrixXd moved = common_uncertainty(input(*group)) * pose.middleCols(c, size);
                    group->add(of.shared * moved, of.own * moved, rows, row);
                    spread.noalias() += moved * moved.transpose();
                    c += size;
                }
                // V of the visit once, from all its sources: the covariance needs their sum, only the budget needs them
                // apart.
                middle_.noalias() += of.shared * spread * of.shared.transpose();
                const Eigen::MatrixXd own_spread = of.own * spread;
                cross_.middleRows(row, q).noalias() += own_spread * of.shared.transpose();
                own_.middleRows(row, q).noalias() += own_spread * of.own.transpose();
                const std::vector<std::size_t>& observations = adjustment_.visits()[v].observations;
                for (std::size_t k = 0; k < observations.size(); ++k) {
                    // l + l0 = s |P - q|: a longer dead path acts as a longer length.
                    const auto path = static_cast<Eigen::Index>(measurement.lengths[observations[k]].dead_path);
                    path_shared_.col(path) += of.shared.col(static_cast<Eigen::Index>(k));
                    path_own_.col(path).segment(row, q) += of.own.col(static_cast<Eigen::Index>(k));
                }
            }
            for (OfVisits* group : groups) {
                group->close_angle(rows, row);
            }
        }
        for (const OfVisits* group : groups) {
            result_.variance[static_cast<std::size_t>(group->group())] = group->variance(sensitivity_.shared());
        }
    }

    /// Inputs that all angles share: the dead paths, and the priors of the border.
    void add_priors() {
        const RotaryTableInputs& layout = model_.layout();
        const TallMatrix by_path = sensitivity_.shared() * path_shared_ + path_own_;
        place(layout.dead_paths, by_path);
        paths_ = by_path * root_of(model_.inputs()[static_cast<std::size_t>(group_at(layout.dead_paths))]);

        const std::size_t stations = model_.measurement().stations.size();
        std::vector<std::size_t> scale;
        std::vector<std::size_t> temperature;
        for (std::size_t j = 0; j < stations; ++j) {
            if (adjustment_.scale_prior(j) != JointAdjustment::k_none) {
                scale.push_back(adjustment_.scale_prior(j));
            }
            if (adjustment_.temperature_prior(j) != JointAdjustment::k_none) {
                temperature.push_back(adjustment_.temperature_prior(j));
            }
        }
        add_prior(layout.scale, scale);
        add_prior(layout.fixture, {adjustment_.fixture_prior()});
        add_prior(layout.temperature, temperature);
        if (adjustment_.expansion_prior() != JointAdjustment::k_none) {
            add_prior(layout.expansion, {adjustment_.expansion_prior()});
        }
    }

    void add_prior(Eigen::Index first_input, const std::vector<std::size_t>& priors) {
        if (priors.empty()) {
            return;
        }
        const gum::InputGroup& group = model_.inputs()[static_cast<std::size_t>(group_at(first_input))];
        Eigen::MatrixXd shared(middle_.rows(), group.size());
        Eigen::Index column = 0;
        for (const std::size_t prior : priors) {
            const Eigen::MatrixXd part = sensitivity_.of_prior(prior);
            shared.middleCols(column, part.cols()) = part;
            column += part.cols();
        }
        place(first_input, sensitivity_.shared() * shared);
        const Eigen::MatrixXd spread = shared * root_of(group);
        middle_.noalias() += spread * spread.transpose();
    }

    /// Sensitivity coefficients of a small group, m×n, into its place among the results.
    void place(Eigen::Index first_input, const TallMatrix& by_input) {
        const auto g = static_cast<std::size_t>(group_at(first_input));
        const gum::InputGroup& group = model_.inputs()[g];
        result_.variance[g] = (by_input * root_of(group)).rowwise().squaredNorm();
        if (group.size() == 1) {
            result_.sensitivity[g] = by_input.col(0);
        }
    }

    /// V = H M Hᵀ + X Hᵀ + H Xᵀ + O + P Pᵀ with the dead paths P.
    void finish() {
        const TallMatrix& rows = sensitivity_.shared();
        TallMatrix shared(rows.rows(), rows.cols() + paths_.cols());
        TallMatrix half(shared.rows(), shared.cols());
        shared << rows, paths_;
        half << 0.5 * rows * middle_ + cross_, 0.5 * paths_;
        result_.covariance = AnglewiseCovariance(std::move(shared), std::move(half), std::move(own_));
    }

    const RotaryTableModel& model_;
    const AnglewiseMap& map_;
    const JointAdjustment& adjustment_;
    const NormalEquations& normal_;
    const BorderedCovariance& covariance_;
    AnglewiseSensitivity sensitivity_;
    Eigen::MatrixXd middle_;       ///< M
    TallMatrix cross_, own_;       ///< X and the blocks of O
    Eigen::MatrixXd path_shared_;  ///< T by the dead paths
    TallMatrix path_own_;          ///< O by the dead paths
    TallMatrix paths_;             ///< P
    RotaryTableContributions result_;
};

/// Map of the reported quantities by the parameters of the solved adjustment.
AnglewiseMap map_of(const RotaryTableModel& model) {
    const JointAdjustment& solved = model.solved();
    return reported_map(
        solved, model.equations(),
        transform_to_datum(model.measurement(), solved.poses(), solved.set_up(), model.measurement().datum));
}

}  // namespace

RotaryTableContributions contributions_of(const RotaryTableModel& model, const AnglewiseMap& map) {
    return Contributions(model, map).all();
}

RotaryTableContributions contributions_of(const RotaryTableModel& model) {
    return contributions_of(model, map_of(model));
}

RotaryTableContributions contributions_of(const RotaryTableModel& model, const ContactPointModel& contact) {
    return contributions_of(model, contact.seen_through(map_of(model)));
}

}  // namespace gumcert::engine
