#include "engine/rotary_table/group_tests.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/fixed_parts.h"
#include "engine/median.h"
#include "engine/rotary_table/fixture_tests.h"
#include "engine/rotary_table/group_judgement.h"
#include "engine/rotary_table/visit_effects.h"
#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double k_median_of_absolute_normal = 0.674489750196082;
constexpr double k_spread_of_robust_scale = 1.17;  // times 1/sqrt(n): standard deviation of its relative error
constexpr std::size_t k_most_suspects = 40;        // groups that are taken away one after the other
constexpr int k_most_steps = 18;                   // by which the angles of a station are looked at to be off
constexpr double k_most_amplitude = 3.5;  // of the effect of angles that are off: J/(J - 2) of three stations is 3
constexpr double k_most_off_of_reversal = 0.4;  // of the reversal: by more an effect is not that of interchanged senses
constexpr double k_least_expansion = -10e-6;    // [1/K], of what a fixture is made of
constexpr double k_most_expansion = 200e-6;
constexpr double k_clearly_more = 1.02;  // of chi-square: what explains the same in other words explains it to rounding
// Of chi-square: of two causes the wrong one explains so much more in one of two thousand measurements at most, however alike
// they are: the difference has the mean -q and the variance 4q.
constexpr double k_more_than_chance = 10.8;
constexpr std::size_t k_fewest_for_scatter = 8;    // visits: fewer say nothing of a scatter
constexpr std::size_t k_drift_hypotheses = 3;      // all stations alike, each its own, one station
constexpr std::size_t k_most_angle_bounds = 36;    // between which a reflector is looked at to stand elsewhere
constexpr std::size_t k_most_fixture_places = 40;  // at which the fixture is looked at to have been moved
constexpr double k_seen_of_fixture = 1e-4;         // of what its motion does to the distances: less is not seen
constexpr std::size_t k_fewest_of_place = 4;       // distances: three always agree with some place of a reflector

/// Kinds that have their level from kinds of one side, and no row of their own where nothing is wrong.
bool only_where_suspicious(GroupKind kind) {
    return kind == GroupKind::expansion || kind == GroupKind::senses;
}

/// Both tests of one visit.
struct VisitTest {
    bool is_controlled = false;
    double deviate = 0.0;  ///< common error over its standard deviation
    double error = 0.0, spread = 0.0;
    double pose_chi_square = 0.0;
    int pose_rank = 0;
    double pose_error = 0.0;  ///< rms of what the pose does to the distances
};

/// What a relative change of all distances of a station does to them.
VisitEffects::Effect effect_of_scale(const JointAdjustment& adjustment, const VisitEffects& visits,
                                     std::size_t station) {
    const StartValues now = adjustment.present_values();
    VisitEffects::Effect effect(visits.size());
    for (std::size_t g = 0; g < visits.size(); ++g) {
        const Visit& visit = adjustment.visits()[g];
        if (visit.station != station || visits.is_out(g)) {
            continue;
        }
        effect[g].resize(static_cast<Index>(visit.observations.size()), 1);
        for (std::size_t i = 0; i < visit.observations.size(); ++i) {
            const LengthObservation& length = adjustment.measurement().lengths[visit.observations[i]];
            effect[g](static_cast<Index>(i), 0) = length.length + now.dead_paths[static_cast<Index>(length.dead_path)];
        }
    }
    return effect;
}

Eigen::MatrixX3d about_their_centre(const Eigen::MatrixX3d& points) {
    return points.rowwise() - points.colwise().mean();
}

class GroupSearch {
public:
    GroupSearch(const JointAdjustment& adjustment, const NormalEquations& normal, const BorderedCovariance& covariance,
                const GroupTestOptions& options)
        : adjustment_(adjustment), judgement_(options), visits_(adjustment, normal, covariance) {
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            poses_.push_back(adjustment.pose_jacobian(g));
        }
        for (int c = 0; c < 6 && adjustment.has_reversal() && !adjustment.reversal_by_angle(); ++c) {
            reversal_.push_back(normal.column(adjustment.reversal_block(), c));
        }
    }

    GroupTests run() {
        find_scale();
        sequences();
        estimate_drifts();
        // One group at a time: what the least probable one says is taken away before the others are tested again, so
        // that its effects elsewhere are not reported as causes of their own.
        std::vector<std::optional<Candidate>> last;
        for (std::size_t round = 0; round < std::min(k_most_suspects, visits_.size() / 4); ++round) {
            misfit_of_fixture_ =
                largest_fixture_misfit(fixture_misfit(), adjustment_.measurement().fixture, judgement_);
            const std::optional<Candidate> senses = best_senses();
            std::optional<Candidate> place = best_place();
            if (is_interchange(place, senses)) {
                place.reset();
            }
            last = {best_visit(),
                    best_change(),
                    place,
                    best_pair(),
                    best_drift(),
                    best_index(),
                    best_place_at_angles(),
                    best_place_from_visit(),
                    best_scale(),
                    best_fixture_place(),
                    best_expansion(),
                    senses};
            const std::optional<Candidate> worst = least_probable(last);
            if (!worst || !worst->test.suspicious) {
                break;
            }
            result_.tests.push_back(worst->test);
            if (worst->effect) {
                result_.tests.back().columns = columns_of(worst->effect());
            }
            worst->take_away();
            retest();
            sequences();
        }
        for (const std::optional<Candidate>& candidate : last) {
            if (candidate && !candidate->test.suspicious && !only_where_suspicious(candidate->test.kind)) {
                result_.tests.push_back(candidate->test);
            }
        }
        complete_visits();
        // What says no cause is of use only where no cause is found.
        if (std::none_of(result_.tests.begin(), result_.tests.end(),
                         [](const GroupTest& test) { return test.suspicious; })) {
            search_succession();
            search_stations();
        }
        std::vector<GroupTest> of_fixture =
            fixture_tests(fixture_misfit(), adjustment_.measurement().fixture, judgement_);
        for (GroupTest& test : of_fixture) {
            if (test.suspicious) {
                test.columns = columns_of_fixture(test);
            }
        }
        result_.tests.insert(result_.tests.end(), of_fixture.begin(), of_fixture.end());
        std::stable_sort(result_.tests.begin(), result_.tests.end(), [](const GroupTest& a, const GroupTest& b) {
            return a.suspicious != b.suspicious ? a.suspicious : a.suspicious && is_less_probable(a, b);
        });
        return std::move(result_);
    }

private:
    [[nodiscard]] VisitTest test_visit(std::size_t g) const {
        VisitTest test;
        test.spread = visits_.own(g).sum();
        test.is_controlled = test.spread > visits_.least(g);
        if (test.is_controlled) {
            test.deviate = visits_.weighted(g).sum() / std::sqrt(test.spread);
            test.error = visits_.weighted(g).sum() / test.spread;
        }
        const MatrixXd& pose = poses_[g];
        // Columns of unit length, so that metres and radians count alike in the rank of the pseudo-inverse.
        const VectorXd scale = pose.colwise().norm().cwiseMax(1e-300).cwiseInverse();
        const MatrixXd columns = pose * scale.asDiagonal();
        const Inverted inverted = pseudo_inverse(columns.transpose() * visits_.own(g) * columns, visits_.least(g));
        const VectorXd pull = columns.transpose() * visits_.weighted(g);
        test.pose_rank = inverted.rank;
        test.pose_chi_square = pull.dot(inverted.inverse * pull);
        test.pose_error = (columns * (inverted.inverse * pull)).norm() / std::sqrt(static_cast<double>(pose.rows()));
        return test;
    }

    /// Distances that a program made up exactly scatter by rounding alone, which is no measure of anything: a scale below it.
    static constexpr double k_exact = 1e-3;
    /// 1 where a robust scale may be 1, else its limit on the side of 1.
    static double within(double scale, double upper) {
        // The scale is known to 1.17/√n only. What chance explains of it is not used, or every sound measurement would
        // be divided by a scale of its own.
        return scale * upper < 1.0 ? std::max(k_exact, scale * upper) : std::max(1.0, scale / upper);
    }
    /// Wilson and Hilferty's, within 1 % from 1 degree of freedom on.
    static double median_of_chi_square(int degrees_of_freedom) {
        const double nu = degrees_of_freedom;
        return nu * std::pow(1.0 - 2.0 / (9.0 * nu), 3);
    }

    /// The scale of the test values from all visits, and their deviations for a plot.
    void find_scale() {
        std::vector<double> sizes;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            tests_.push_back(test_visit(g));
            if (tests_.back().is_controlled) {
                sizes.push_back(std::abs(tests_.back().deviate));
            }
        }
        if (sizes.size() >= k_fewest_for_scatter) {
            const double count = static_cast<double>(sizes.size());
            const double upper = 1.0 + 2.0 * k_spread_of_robust_scale / std::sqrt(count);
            // Median and not standard deviation: one visit that is off would make the scale large, and hide itself and
            // others.
            result_.scale = upper_median(sizes) / k_median_of_absolute_normal;
            used_scale_ = within(result_.scale, upper);
            std::vector<double> squares;
            for (const VisitTest& test : tests_) {
                // Poses have a scale of their own, because an estimated length noise and an estimated repeatability do
                // not grow alike (ADR 0031).
                if (test.pose_rank > 0) {
                    squares.push_back(test.pose_chi_square / median_of_chi_square(test.pose_rank));
                }
            }
            if (squares.size() >= k_fewest_for_scatter) {
                pose_scale_ = within(std::sqrt(upper_median(squares)), upper);
            }
            single_scale_ = within(scale_of_single_distances(), upper);
        }
        // A repeatability that is given does not grow with what disturbs the visits: there the cautious choice hides nothing.
        column_scale_ = adjustment_.measurement().table_repeatability.mode == RepeatabilityMode::given
                            ? scale_within_visits()
                            : used_scale_;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            if (tests_[g].is_controlled) {
                result_.visits.push_back(
                    {adjustment_.visits()[g], tests_[g].error, used_scale_ / std::sqrt(tests_[g].spread)});
            }
        }
    }

    /// Robust standard deviation of the test values of single distances. Where the repeatability of the table is stated larger than
    /// it is, visits scatter less than their weights say, and what the distances of one visit tell from each other does not.
    [[nodiscard]] double scale_of_single_distances() const {
        std::vector<double> sizes;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            for (Index i = 0; i < visits_.weighted(g).size(); ++i) {
                if (const double own = visits_.own(g)(i, i); own > visits_.least(g)) {
                    sizes.push_back(std::abs(visits_.weighted(g)[i]) / std::sqrt(own));
                }
            }
        }
        return sizes.empty() ? 1.0 : upper_median(sizes) / k_median_of_absolute_normal;
    }
    /// Of effects that differ between the distances of a visit, the cautious choice.
    [[nodiscard]] double scale_within_visits() const { return std::max(used_scale_, single_scale_); }

    [[nodiscard]] GroupTest judged(GroupKind kind, double chi_square, int degrees_of_freedom, std::size_t count) const {
        return judgement_.judged(kind, chi_square, degrees_of_freedom, count);
    }

    void place(GroupTest& test, std::size_t visit) const {
        const Visit& of = adjustment_.visits()[visit];
        test.visit = visit;
        test.station = of.station;
        test.pass = of.pass;
        test.angle = of.angle;
    }

    /// Smallest error with one column that is found with the power.
    /// \param scale  of its test value
    [[nodiscard]] double detectable(const GroupTest& test, double spread, double scale) const {
        return (std::sqrt(test.critical_value) + k_deviate_of_power) * scale / std::sqrt(spread);
    }

    [[nodiscard]] GroupTest length_test(std::size_t g, const VisitTest& test) const {
        const double deviate = test.deviate / used_scale_;
        GroupTest found = judged(GroupKind::visit_length, deviate * deviate, 1, visits_.size());
        place(found, g);
        found.estimate = test.error;
        found.minimal_detectable = detectable(found, test.spread, used_scale_);
        return found;
    }
    [[nodiscard]] GroupTest pose_test(std::size_t g, const VisitTest& test) const {
        GroupTest found = judged(GroupKind::visit_pose, test.pose_chi_square / (pose_scale_ * pose_scale_),
                                 std::max(test.pose_rank, 1), visits_.size());
        place(found, g);
        found.estimate = test.pose_error;
        return found;
    }

    /// A test, and how what it says is taken away before the next ones.
    struct Candidate {
        GroupTest test;
        std::function<void()> take_away;
        std::function<VisitEffects::Effect()> effect;  ///< none: no unknowns of its own
    };

    /// A group that takes its whole effect away.
    [[nodiscard]] Candidate with_effect(GroupTest test, VisitEffects::Effect effect, Index unknowns) {
        const auto shared = std::make_shared<const VisitEffects::Effect>(std::move(effect));
        return {std::move(test), [this, shared, unknowns] { visits_.take_away(*shared, unknowns); },
                [shared] { return *shared; }};
    }
    /// The same of effects that are alike at all distances of a visit, made when they are asked for.
    [[nodiscard]] Candidate with_columns(GroupTest test, const std::vector<VisitEffects::Column>& columns) {
        return {std::move(test), [this, columns] { visits_.take_away(columns); },
                [this, columns] { return visits_.effect_of(columns); }};
    }
    /// An effect by the distances of the measurement, which are the same in adjustments of other visits.
    [[nodiscard]] MatrixXd columns_of(const VisitEffects::Effect& effect) const {
        MatrixXd columns;
        for (std::size_t g = 0; g < effect.size(); ++g) {
            if (effect[g].size() > 0 && columns.size() == 0) {
                columns = MatrixXd::Zero(std::ssize(adjustment_.measurement().lengths), effect[g].cols());
            }
            for (Index i = 0; i < effect[g].rows(); ++i) {
                columns.row(static_cast<Index>(visits()[g].observations[static_cast<std::size_t>(i)])) =
                    effect[g].row(i);
            }
        }
        return columns;
    }
    /// Stated coordinates that are off by e make the distances agree with others, by ∂l/∂p e less.
    [[nodiscard]] MatrixXd columns_of_fixture(const GroupTest& test) const {
        const RotaryTableMeasurement& measurement = adjustment_.measurement();
        VisitEffects::Effect effect(visits_.size());
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            const VisitEffects::Triple by_place = reflector_columns(g);
            effect[g] = MatrixXd::Zero(by_place.rows(), test.kind == GroupKind::fixture_scale ? 1 : 3);
            for (Index i = 0; i < by_place.rows(); ++i) {
                const std::size_t m =
                    measurement.lengths[visits()[g].observations[static_cast<std::size_t>(i)]].reflector;
                if (test.kind == GroupKind::fixture_scale) {
                    effect[g](i, 0) = -by_place.row(i).dot(measurement.fixture.row(static_cast<Index>(m)));
                } else if (m == test.reflector) {
                    effect[g].row(i) = -by_place.row(i);
                }
            }
        }
        return columns_of(effect);
    }

    static void take(std::optional<Candidate>& best, Candidate candidate) {
        if (!best || is_less_probable(candidate.test, best->test)) {
            best = std::move(candidate);
        }
    }
    static std::optional<Candidate> least_probable(const std::vector<std::optional<Candidate>>& all) {
        std::optional<Candidate> best;
        for (const std::optional<Candidate>& candidate : all) {
            if (candidate) {
                take(best, *candidate);
            }
        }
        return best;
    }

    void retest() {
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            tests_[g] = test_visit(g);
        }
    }

    /// Whether a pose explains what one error of all distances leaves; else the simpler cause is taken.
    [[nodiscard]] bool is_more_than_length(const VisitTest& test) const {
        if (!test.is_controlled || test.pose_rank < 2) {
            return true;
        }
        const double left = test.pose_chi_square - test.deviate * test.deviate;
        const GroupTest length = judged(GroupKind::visit_length, std::pow(test.deviate / used_scale_, 2), 1, size());
        return !length.suspicious || judged(GroupKind::visit_pose, std::max(0.0, left) / (pose_scale_ * pose_scale_),
                                            test.pose_rank - 1, size())
                                         .suspicious;
    }
    [[nodiscard]] std::size_t size() const { return visits_.size(); }

    [[nodiscard]] std::optional<Candidate> best_visit() {
        std::optional<Candidate> best;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            if (visits_.is_out(g)) {
                continue;
            }
            const auto leave_out = [this, g] { visits_.leave_out(g); };
            if (tests_[g].is_controlled) {
                take(best, {length_test(g, tests_[g]), leave_out, [this, g] {
                                return visits_.effect_of({{{g, 1.0}}});
                            }});
            }
            if (tests_[g].pose_rank > 0 && is_more_than_length(tests_[g]) && is_worst_of_angle(g)) {
                const auto pose = [this, g] {
                    VisitEffects::Effect effect(visits_.size());
                    effect[g] = poses_[g];
                    return effect;
                };
                take(best, {pose_test(g, tests_[g]), leave_out, pose});
            }
        }
        return best;
    }
    /// Whether no other visit of its angle explains more at the same weights. They share one pose of the table: of a disturbed
    /// visit the others seem to stand elsewhere, and where its common error is judged by another scale than their poses,
    /// they would be told in its place.
    [[nodiscard]] bool is_worst_of_angle(std::size_t g) const {
        const std::vector<Visit>& visits = adjustment_.visits();
        for (std::size_t other = 0; other < visits_.size(); ++other) {
            if (visits[other].angle == visits[g].angle && !visits_.is_out(other) &&
                tests_[other].pose_chi_square > tests_[g].pose_chi_square) {
                return false;
            }
        }
        return true;
    }

    /// The largest test of visits of each of both kinds, where none of that kind was the largest of all.
    void complete_visits() {
        const auto none = [this](GroupKind kind) {
            return std::none_of(result_.tests.begin(), result_.tests.end(),
                                [kind](const GroupTest& test) { return test.kind == kind; });
        };
        std::optional<Candidate> length;
        std::optional<Candidate> pose;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            if (!visits_.is_out(g) && tests_[g].is_controlled) {
                take(length, {length_test(g, tests_[g]), {}, {}});
            }
            if (!visits_.is_out(g) && tests_[g].pose_rank > 0) {
                take(pose, {pose_test(g, tests_[g]), {}, {}});
            }
        }
        if (length && !length->test.suspicious && none(GroupKind::visit_length)) {
            result_.tests.push_back(length->test);
        }
        if (pose && !pose->test.suspicious && none(GroupKind::visit_pose)) {
            result_.tests.push_back(pose->test);
        }
    }

    /// Visits of one station with the same dead path, in the order in which they were measured.
    void sequences() {
        sequences_.clear();
        std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> by_path;
        const std::vector<LengthObservation>& lengths = adjustment_.measurement().lengths;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            if (visits_.is_out(g) || !tests_[g].is_controlled) {
                continue;
            }
            const Visit& visit = adjustment_.visits()[g];
            // With dead paths for each reflector a visit has several; the lowest one stands for it, so that all visits
            // of a station that share paths are one sequence.
            std::size_t path = lengths[visit.observations.front()].dead_path;
            for (const std::size_t i : visit.observations) {
                path = std::min(path, lengths[i].dead_path);
            }
            by_path[{visit.station, path}].push_back(g);
        }
        for (auto& [key, sequence] : by_path) {
            std::ranges::stable_sort(sequence, {}, [this](std::size_t g) { return time_of(g); });
            sequences_.push_back(std::move(sequence));
        }
    }

    /// Mean time of the distances of a visit, else its place in the measurement.
    [[nodiscard]] double time_of(std::size_t g) const {
        const std::vector<double>& times = adjustment_.measurement().times;
        if (times.empty()) {
            return static_cast<double>(g);
        }
        const std::vector<std::size_t>& observations = adjustment_.visits()[g].observations;
        double sum = 0.0;
        for (const std::size_t i : observations) {
            sum += times[i];
        }
        return sum / static_cast<double>(observations.size());
    }

    void keep(std::vector<GroupTest> all) {
        std::stable_sort(all.begin(), all.end(), [](const GroupTest& a, const GroupTest& b) {
            return a.p_value < b.p_value || (a.p_value == b.p_value && a.chi_square > b.chi_square);
        });
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i == 0 || all[i].suspicious) {
                result_.tests.push_back(all[i]);
            }
        }
    }

    static void add_errors(GroupTest& test, const VisitEffects::Column& column, double size) {
        for (const auto& [visit, value] : column) {
            test.errors.emplace_back(visit, size * value);
        }
    }

    [[nodiscard]] std::optional<GroupTest> column_test(GroupKind kind, const VisitEffects::Column& column,
                                                       std::size_t count) const {
        const VisitEffects::Projection projection = visits_.projection({column});
        const double spread = projection.spread(0, 0);
        // A drift that dead paths or poses take up wholly leaves nothing to test.
        if (!(spread > k_controlled * projection.weight)) {
            return std::nullopt;
        }
        const double deviate = projection.weighted[0] / std::sqrt(spread) / column_scale_;
        GroupTest test = judged(kind, deviate * deviate, 1, count);
        test.estimate = projection.weighted[0] / spread;
        add_errors(test, column, test.estimate);
        test.minimal_detectable = detectable(test, spread, column_scale_);
        return test;
    }

    /// Where in a sequence a change is most probable follows from sums of its visits; its test value is exact.
    [[nodiscard]] std::optional<Candidate> best_change() {
        std::size_t count = 0;
        for (const auto& sequence : sequences_) {
            count += sequence.size() - 1;
        }
        std::optional<Candidate> best;
        for (const auto& sequence : sequences_) {
            double spread = 0.0;
            for (const std::size_t g : sequence) {
                spread += tests_[g].spread;
            }
            double weighted_after = 0.0;
            double spread_after = 0.0;
            double largest = -1.0;
            std::size_t first = 0;
            // The dead path takes up the mean of a sequence. So only the difference between the visits before and after
            // counts: its square over its variance is w² S/(S_a (S − S_a)).
            for (std::size_t k = sequence.size(); k-- > 1;) {
                weighted_after += visits_.weighted(sequence[k]).sum();
                spread_after += tests_[sequence[k]].spread;
                const double square =
                    weighted_after * weighted_after * spread / (spread_after * (spread - spread_after));
                if (square > largest && k > 1 && k + 1 < sequence.size()) {  // of one visit it is that visit
                    largest = square;
                    first = k;
                }
            }
            if (first == 0) {
                continue;
            }
            VisitEffects::Column column;
            for (std::size_t k = first; k < sequence.size(); ++k) {
                column.emplace_back(sequence[k], 1.0);
            }
            if (std::optional<GroupTest> test = column_test(GroupKind::dead_path_change, column, count)) {
                place(*test, sequence[first]);
                take(best, with_columns(*test, {column}));
            }
        }
        return best;
    }

    /// Visits of a station that are in, by pass, in the order in which the passes were measured.
    [[nodiscard]] std::vector<std::vector<std::size_t>> passes_of(std::size_t station) const {
        std::vector<std::vector<std::size_t>> passes;
        std::map<std::size_t, std::size_t> place_of_pass;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            const Visit& visit = adjustment_.visits()[g];
            if (visit.station == station && !visits_.is_out(g)) {
                const auto [at, is_new] = place_of_pass.try_emplace(visit.pass, passes.size());
                if (is_new) {
                    passes.emplace_back();
                }
                passes[at->second].push_back(g);
            }
        }
        std::ranges::stable_sort(passes, {}, [this](const auto& pass) {
            double sum = 0.0;
            for (const std::size_t g : pass) {
                sum += time_of(g);
            }
            return sum / static_cast<double>(pass.size());
        });
        return passes;
    }

    /// A station that was moved between two of its passes: three coordinates from a pass on. The table, whose visits
    /// are seen by several stations, would take it up as its repeatability, pass by pass.
    [[nodiscard]] std::optional<Candidate> best_place() {
        const std::size_t stations = adjustment_.measurement().stations.size();
        std::vector<std::vector<std::vector<std::size_t>>> passes;
        std::size_t count = 0;
        for (std::size_t j = 0; j < stations; ++j) {
            passes.push_back(passes_of(j));
            count += passes.back().empty() ? 0 : passes.back().size() - 1;
        }
        std::optional<Candidate> best;
        for (std::size_t j = 0; j < stations; ++j) {
            for (std::size_t from = 1; from < passes[j].size(); ++from) {
                VisitEffects::Effect effect(visits_.size());
                for (std::size_t pass = from; pass < passes[j].size(); ++pass) {
                    for (const std::size_t g : passes[j][pass]) {
                        // The distance is |P - q|: what moves the table by t moves the station by -t (contract,
                        // section 4).
                        effect[g] = -poses_[g].leftCols(3);
                    }
                }
                if (const std::optional<GroupTest> test =
                        place_test(GroupKind::station_place, effect, count, column_scale_)) {
                    GroupTest placed = *test;
                    place(placed, passes[j][from].front());
                    placed.angle = GroupTest::k_none;  // the whole pass, not its first angle
                    take(best, with_effect(placed, std::move(effect), 3));
                }
            }
        }
        return best;
    }
    /// \param least_scale  of the test value, beside that of poses
    [[nodiscard]] std::optional<GroupTest> place_test(GroupKind kind, const VisitEffects::Effect& effect,
                                                      std::size_t count, double least_scale) const {
        const VisitEffects::Projection projection = visits_.projection(effect, 3);
        const Inverted inverted = pseudo_inverse(projection.spread, k_controlled * projection.weight);
        if (inverted.rank == 0) {
            return std::nullopt;
        }
        // By the larger of both scales, as the angles of a station: neither a common error nor a free pose.
        const double scale = std::max(least_scale, pose_scale_);
        const VectorXd error = inverted.inverse * projection.weighted;
        GroupTest test = judged(kind, projection.weighted.dot(error) / (scale * scale), inverted.rank, count);
        test.estimate = error.norm();
        test.minimal_detectable = (std::sqrt(test.critical_value) + k_deviate_of_power) * scale *
                                  std::sqrt(inverted.inverse.trace() / inverted.rank);
        return test;
    }

    /// What the distances of a visit change by with the place of their reflector in the fixture, distances×3.
    [[nodiscard]] VisitEffects::Triple reflector_columns(std::size_t g) const {
        // Small error motions turn the displacement by less than it is known.
        const Eigen::Matrix3d table_from_fixture =
            nominal_rotation(adjustment_.measurement(), adjustment_.visits()[g].angle) * adjustment_.set_up().rotation;
        return poses_[g].leftCols<3>() * table_from_fixture;
    }

    /// Visits that are in at which each reflector is seen, in the order of time.
    [[nodiscard]] std::vector<std::vector<VisitEffects::Seen>> seen_reflectors() const {
        std::vector<std::size_t> order;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            if (!visits_.is_out(g)) {
                order.push_back(g);
            }
        }
        std::ranges::stable_sort(order, {}, [this](std::size_t g) { return time_of(g); });
        const RotaryTableMeasurement& measurement = adjustment_.measurement();
        std::vector<std::vector<VisitEffects::Seen>> seen(measurement.reflectors.size());
        for (const std::size_t g : order) {
            const std::vector<std::size_t>& observations = adjustment_.visits()[g].observations;
            for (std::size_t i = 0; i < observations.size(); ++i) {
                std::vector<VisitEffects::Seen>& of = seen[measurement.lengths[observations[i]].reflector];
                if (of.empty() || of.back().visit != g) {
                    of.push_back({g, {}});
                }
                of.back().rows.push_back(static_cast<Index>(i));
            }
        }
        return seen;
    }

    /// The part of the visits of a reflector at which it most probably stood elsewhere.
    struct Elsewhere {
        double chi_square = -1.0;  ///< less than 0: none
        std::size_t begin = 0, end = 0;

        void consider(const VisitEffects::Sum& part, std::size_t all, std::size_t from, std::size_t to) {
            if (part.distances < k_fewest_of_place || all - part.distances < k_fewest_of_place) {
                return;
            }
            if (const double value = part.chi_square(); value > chi_square) {
                *this = {value, from, to};
            }
        }
    };

    /// \param find  Elsewhere of the visits of a reflector, which it may bring into another order
    /// \param describe  adds to a test which visits they are, begin to end of that order
    template <typename Find, typename Describe>
    [[nodiscard]] std::optional<Candidate> best_elsewhere(GroupKind kind, std::size_t count,
                                                          std::vector<std::vector<VisitEffects::Seen>> seen,
                                                          const Find& find, const Describe& describe) {
        std::vector<Elsewhere> found(seen.size());
        // What the reflectors share is only read here: limits are found afterwards, by one thread.
        FixedParts(seen.size(), 1)
            .run(adjustment_.adjustment().workers(),
                 [&](std::size_t m, std::size_t, std::size_t) { found[m] = find(seen[m]); });
        std::optional<Candidate> best;
        for (std::size_t m = 0; m < seen.size(); ++m) {
            // A reflector that stands elsewhere all the time, and a fixture of another size, leave something in a part of
            // the visits as well: where they explain more, at the same weights, it is they.
            if (found[m].chi_square < misfit_of_fixture_) {
                continue;
            }
            VisitEffects::Effect effect(visits_.size());
            for (std::size_t k = found[m].begin; k < found[m].end; ++k) {
                const std::size_t g = seen[m][k].visit;
                const VisitEffects::Triple columns = reflector_columns(g);
                effect[g] = MatrixXd::Zero(columns.rows(), 3);
                for (const Index i : seen[m][k].rows) {
                    effect[g].row(i) = columns.row(i);
                }
            }
            if (std::optional<GroupTest> test = place_test(kind, effect, count, scale_within_visits())) {
                describe(*test, seen[m], found[m]);
                test->reflector = m;
                take(best, with_effect(*test, std::move(effect), 3));
            }
        }
        return best;
    }

    /// A reflector that stands elsewhere in a part of the turn: its holder gives way, or something pulls at it.
    [[nodiscard]] std::optional<Candidate> best_place_at_angles() {
        visits_.prepare_sums(adjustment_.adjustment().workers());
        const std::vector<Visit>& visits = adjustment_.visits();
        const std::size_t angles = adjustment_.measurement().angles.size();
        std::vector<std::size_t> by_angle(angles);  // places of the angles in the turn
        std::iota(by_angle.begin(), by_angle.end(), std::size_t{0});
        std::ranges::stable_sort(by_angle, {},
                                 [this](std::size_t a) { return adjustment_.measurement().angles_deg[a]; });
        std::vector<std::size_t> place_of(angles);
        for (std::size_t k = 0; k < angles; ++k) {
            place_of[by_angle[k]] = k;
        }
        // Of many angles not every one is a bound of parts: what is between two of them is found by its neighbours.
        const std::size_t parts = std::min(angles, k_most_angle_bounds);
        std::vector<std::vector<VisitEffects::Seen>> seen = seen_reflectors();
        const std::size_t count = seen.size() * (parts * (parts + 1) / 2 - 1);
        const auto place = [&](const VisitEffects::Seen& at) { return place_of[visits[at.visit].angle]; };
        const auto find = [&](std::vector<VisitEffects::Seen>& of) {
            std::ranges::stable_sort(of, {}, place);
            VisitEffects::GrowingSum growing(visits_, angles);
            std::vector<VisitEffects::Sum> until{growing.sum()};
            std::vector<std::size_t> ends{0};
            std::size_t k = 0;
            for (std::size_t part = 1; part <= parts; ++part) {
                for (; k < of.size() && place(of[k]) < part * angles / parts; ++k) {
                    growing.add(of[k], visits[of[k].visit].angle, reflector_columns(of[k].visit));
                }
                until.push_back(growing.sum());
                ends.push_back(k);
            }
            Elsewhere best;
            for (std::size_t from = 0; from < parts; ++from) {
                for (std::size_t to = from + 1; to <= parts; ++to) {
                    best.consider(until[to] - until[from], until[parts].distances, ends[from], ends[to]);
                }
            }
            return best;
        };
        return best_elsewhere(GroupKind::reflector_at_angles, count, std::move(seen), find,
                              [&](GroupTest& test, const std::vector<VisitEffects::Seen>& of, const Elsewhere& part) {
                                  test.angle = visits[of[part.begin].visit].angle;
                                  test.last_angle = visits[of[part.end - 1].visit].angle;
                              });
    }

    /// A reflector that was moved, for good.
    [[nodiscard]] std::optional<Candidate> best_place_from_visit() {
        visits_.prepare_sums(adjustment_.adjustment().workers());
        const std::vector<Visit>& visits = adjustment_.visits();
        const std::size_t angles = adjustment_.measurement().angles.size();
        std::vector<std::vector<VisitEffects::Seen>> seen = seen_reflectors();
        std::size_t count = 0;
        for (const std::vector<VisitEffects::Seen>& of : seen) {
            count += of.empty() ? 0 : of.size() - 1;
        }
        const auto find = [&](const std::vector<VisitEffects::Seen>& of) {
            std::size_t all = 0;
            for (const VisitEffects::Seen& at : of) {
                all += at.rows.size();
            }
            VisitEffects::GrowingSum growing(visits_, angles);
            Elsewhere best;
            for (std::size_t k = of.size(); k-- > 1;) {
                growing.add(of[k], visits[of[k].visit].angle, reflector_columns(of[k].visit));
                best.consider(growing.sum(), all, k, of.size());
            }
            return best;
        };
        return best_elsewhere(GroupKind::reflector_from_visit, count, std::move(seen), find,
                              [this](GroupTest& test, const std::vector<VisitEffects::Seen>& of,
                                     const Elsewhere& part) { place(test, of[part.begin].visit); });
    }

    /// The test of one size along an effect, without its place. Nothing where the parameters take the effect up wholly, and where a
    /// displaced reflector or a fixture of another size explains more at the same weights: then it is they.
    /// \param more  how many times as much as they it must explain
    /// \param degrees_of_freedom  of what the effect was found in: one that is known beforehand has one
    [[nodiscard]] std::optional<GroupTest> test_of_one_size(GroupKind kind, const VisitEffects::Effect& effect,
                                                            std::size_t count, double more = 1.0,
                                                            int degrees_of_freedom = 1) const {
        const VisitEffects::Projection projection = visits_.projection(effect, 1);
        const double spread = projection.spread(0, 0);
        if (!(spread > k_controlled * projection.weight)) {
            return std::nullopt;
        }
        const double chi_square = projection.weighted[0] * projection.weighted[0] / spread;
        if (chi_square < more * misfit_of_fixture_) {
            return std::nullopt;
        }
        const double scale = scale_within_visits();
        GroupTest test = judged(kind, chi_square / (scale * scale), degrees_of_freedom, count);
        test.estimate = projection.weighted[0] / spread;
        test.minimal_detectable = detectable(test, spread, scale);
        return test;
    }

    /// One error of all distances between a station and a reflector: a beam that grazes something, a reflector that is
    /// seen from behind.
    [[nodiscard]] std::optional<Candidate> best_pair() {
        const RotaryTableMeasurement& measurement = adjustment_.measurement();
        const std::size_t stations = measurement.stations.size();
        const std::size_t reflectors = measurement.reflectors.size();
        std::vector<VisitEffects::Effect> effects(stations * reflectors, VisitEffects::Effect(visits_.size()));
        std::vector<std::size_t> first(effects.size(), visits_.size());
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            const Visit& visit = adjustment_.visits()[g];
            for (std::size_t i = 0; i < visit.observations.size() && !visits_.is_out(g); ++i) {
                const std::size_t pair =
                    visit.station * reflectors + measurement.lengths[visit.observations[i]].reflector;
                if (effects[pair][g].size() == 0) {
                    effects[pair][g] = MatrixXd::Zero(static_cast<Index>(visit.observations.size()), 1);
                }
                effects[pair][g](static_cast<Index>(i), 0) = 1.0;
                first[pair] = std::min(first[pair], g);
            }
        }
        std::optional<Candidate> best;
        for (std::size_t pair = 0; pair < effects.size(); ++pair) {
            if (first[pair] == visits_.size()) {
                continue;
            }
            // With dead paths for each reflector it is a dead path, and nothing is left to test.
            std::optional<GroupTest> test = test_of_one_size(GroupKind::pair_length, effects[pair], effects.size());
            if (!test) {
                continue;
            }
            test->station = pair / reflectors;
            test->reflector = pair % reflectors;
            take(best, with_effect(*test, std::move(effects[pair]), 1));
        }
        return best;
    }

    /// One factor on all distances of a station, beyond what its scale is known to: a refractive index, a wavelength, a unit;
    /// the temperature of the fixture while it was measured from there does the same. Pairs of the station with each of its
    /// reflectors, or a reflector, would take it up one by one.
    [[nodiscard]] std::optional<Candidate> best_scale() {
        const std::size_t stations = adjustment_.measurement().stations.size();
        std::optional<Candidate> best;
        for (std::size_t j = 0; j < stations; ++j) {
            VisitEffects::Effect effect = effect_of_scale(adjustment_, visits_, j);
            // A scale that is free takes it up wholly.
            std::optional<GroupTest> test = test_of_one_size(GroupKind::station_scale, effect, stations);
            if (!test) {
                continue;
            }
            test->station = j;
            take(best, with_effect(*test, std::move(effect), 1));
        }
        return best;
    }

    /// The coefficient of the fixture is one for all stations. One that is wrong makes the distances of each too long or too
    /// short by its temperature, and of the warmest the most: that station would be told for its scale.
    [[nodiscard]] std::optional<Candidate> best_expansion() {
        constexpr int k_temperature = 4;  // in the block of a station
        VisitEffects::Effect effect(visits_.size());
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            const std::size_t station = adjustment_.visits()[g].station;
            const double adjusted =
                adjustment_.adjustment().parameters(adjustment_.station_block(station))[k_temperature];
            if (!visits_.is_out(g) && adjusted != 0.0) {
                // What is stated too large predicts distances that are not observed. At the temperatures that are stated: a
                // station with a scale error has taken it for one of its own, and would be the warmest of all.
                const double stated = adjustment_.measurement().temperature_difference[static_cast<Index>(station)];
                effect[g] = -stated / adjusted * adjustment_.adjustment().jacobian(g, adjustment_.expansion_block());
            }
        }
        // At one temperature it is the size of the fixture: then that is told, which names temperature and coefficient as well;
        // and where temperatures are so alike that chance decides which of both explains more.
        std::optional<GroupTest> test = test_of_one_size(GroupKind::expansion, effect, 1, k_clearly_more);
        if (!test ||
            (misfit_of_fixture_ > 0.0 &&
             test->chi_square < misfit_of_fixture_ / std::pow(scale_within_visits(), 2) + k_more_than_chance)) {
            return std::nullopt;
        }
        const double coefficient = adjustment_.measurement().expansion - test->estimate;
        if (coefficient < k_least_expansion || coefficient > k_most_expansion || scales_explain_more(*test)) {
            return std::nullopt;
        }
        return with_effect(*test, std::move(effect), 1);
    }

    /// Whether scales of the stations, each its own, explain clearly more than one coefficient: then some stations have errors
    /// of their own, which follow the temperatures by chance.
    [[nodiscard]] bool scales_explain_more(const GroupTest& expansion) const {
        constexpr double k_share = 0.05;  // less is what a large error does to the linear model
        const auto stations = std::ssize(adjustment_.measurement().stations);
        VisitEffects::Effect effect(visits_.size());
        for (Index j = 0; j < stations; ++j) {
            const VisitEffects::Effect own = effect_of_scale(adjustment_, visits_, static_cast<std::size_t>(j));
            for (std::size_t g = 0; g < own.size(); ++g) {
                if (own[g].size() > 0) {
                    effect[g] = MatrixXd::Zero(own[g].rows(), stations);
                    effect[g].col(j) = own[g];
                }
            }
        }
        const VisitEffects::Projection projection = visits_.projection(effect, stations);
        const Inverted inverted = pseudo_inverse(projection.spread, k_controlled * projection.weight);
        const double more =
            projection.weighted.dot(inverted.inverse * projection.weighted) / std::pow(scale_within_visits(), 2) -
            expansion.chi_square;
        return inverted.rank > 1 && more > k_share * expansion.chi_square &&
               judged(GroupKind::expansion, more, inverted.rank - 1, 1).suspicious;
    }

    /// A station whose senses of approach are interchanged: at each visit the reversal is off, with the other sign. What all
    /// stations say of the reversal holds a part of the fault, in some directions more than half: compared is what this station
    /// says of it, as if it were not known, with what the others say.
    [[nodiscard]] std::optional<Candidate> best_senses() {
        std::optional<Candidate> best;
        if (reversal_.empty()) {
            return best;
        }
        const Eigen::Matrix<double, 6, 1> of_all = adjustment_.mean_reversal();
        const std::size_t stations = adjustment_.measurement().stations.size();
        for (std::size_t j = 0; j < stations; ++j) {
            VisitEffects::Effect free(visits_.size());
            VisitEffects::Effect effect = free;
            for (std::size_t g = 0; g < visits_.size(); ++g) {
                const Visit& visit = adjustment_.visits()[g];
                if (visit.station == j && !visits_.is_out(g)) {
                    free[g] = poses_[g] * (visit.approach == Approach::positive ? -1.0 : 1.0);
                }
            }
            const VisitEffects::Projection projection = visits_.projection(free, 6);
            const Inverted inverted = pseudo_inverse(projection.spread, k_controlled * projection.weight);
            if (inverted.rank == 0) {
                continue;
            }
            const VectorXd own = inverted.inverse * projection.weighted;
            const VectorXd of_others = of_all - visits_.shift_of_parameters(free, 6)(reversal_, Eigen::all) * own;
            for (std::size_t g = 0; g < visits_.size(); ++g) {
                if (free[g].size() > 0) {
                    effect[g] = free[g] * of_others;
                }
            }
            // The same distances say which reversal it is, and chance has all its directions to lie in: without one, a
            // single degree of freedom would accuse many times as often as it may.
            std::optional<GroupTest> test =
                test_of_one_size(GroupKind::senses, effect, stations, 1.0, static_cast<int>(inverted.rank));
            // What has another size is another fault, or the reversal is hardly there.
            if (!test || std::abs(test->estimate - 1.0) > k_most_off_of_reversal) {
                continue;
            }
            test->station = j;
            take(best, with_effect(*test, std::move(effect), 1));
        }
        return best;
    }
    /// Whether a place of its own between two passes explains no more of a station than interchanged senses, of which a rigid
    /// reversal moves it just so.
    static bool is_interchange(const std::optional<Candidate>& place, const std::optional<Candidate>& senses) {
        return place && senses && senses->test.suspicious && place->test.station == senses->test.station &&
               place->test.chi_square < senses->test.chi_square + place->test.critical_value;
    }

    /// The whole fixture, moved on the table: a clamp that gave way, a hand at the set-up between two stations. The table,
    /// whose angles several stations see, would take it up as its repeatability, and no visit deviates from many others.
    /// Six columns from a visit on; those that stations measured before or after only take up count nothing.
    [[nodiscard]] std::optional<Candidate> best_fixture_place() {
        std::vector<std::size_t> order;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            if (!visits_.is_out(g)) {
                order.push_back(g);
            }
        }
        std::ranges::stable_sort(order, {}, [this](std::size_t g) { return time_of(g); });
        const std::vector<Visit>& visits = adjustment_.visits();
        // Where hands are at the set-up: where a station or a pass begins. Where it was between, the next one sees it too.
        std::vector<std::size_t> starts;
        for (std::size_t k = 1; k < order.size(); ++k) {
            const Visit& before = visits[order[k - 1]];
            const Visit& visit = visits[order[k]];
            if (before.station != visit.station || before.pass != visit.pass) {
                starts.push_back(k);
            }
        }
        if (starts.empty()) {
            return std::nullopt;
        }
        if (starts.size() > k_most_fixture_places) {
            std::vector<std::size_t> spread;  // evenly over all of them
            for (std::size_t k = 0; k < k_most_fixture_places; ++k) {
                spread.push_back(starts[k * (starts.size() - 1) / (k_most_fixture_places - 1)]);
            }
            starts = std::move(spread);
        }
        std::size_t widest = std::max(starts.front(), order.size() - starts.back());
        for (std::size_t k = 1; k < starts.size(); ++k) {
            widest = std::max(widest, starts[k] - starts[k - 1]);
        }
        std::optional<GroupTest> best;
        std::size_t from = 0;
        const auto consider = [&](std::size_t k) {
            const std::optional<GroupTest> test = fixture_place_test(order, k);
            if (test && (!best || is_less_probable(*test, *best))) {
                best = test;
                from = k;
                return true;
            }
            return false;
        };
        for (const std::size_t start : starts) {
            consider(start);
        }
        if (!best) {
            return std::nullopt;
        }
        for (std::size_t step = widest; best->suspicious && step > 0; step /= 2) {
            const std::size_t middle = from;
            for (const bool later : {false, true}) {
                if (later ? middle + step < order.size() : middle > step) {
                    consider(later ? middle + step : middle - step);
                }
            }
        }
        place(*best, order[from]);
        return with_effect(*best, fixture_place_effect(order, from), 6);
    }
    [[nodiscard]] VisitEffects::Effect fixture_place_effect(const std::vector<std::size_t>& order,
                                                            std::size_t from) const {
        const double lever = about_their_centre(adjustment_.measurement().fixture).rowwise().norm().mean();
        // Poses turn about the origin of the table. The fixture turns about its middle: where the CMM has the origin of its
        // coordinates says nothing of what is seen of a motion, nor of its size.
        const RigidMotion& set_up = adjustment_.set_up();
        const Eigen::Vector3d centre = set_up.rotation.transpose() * set_up.translation +
                                       adjustment_.measurement().fixture.colwise().mean().transpose();
        Eigen::Matrix3d across_centre;  // times a turn: centre × turn
        for (int c = 0; c < 3; ++c) {
            across_centre.col(c) = centre.cross(Eigen::Vector3d::Unit(c));
        }
        VisitEffects::Effect effect(visits_.size());
        for (std::size_t k = from; k < order.size(); ++k) {
            const std::size_t g = order[k];
            const Eigen::Matrix3d table_from_fixture =
                nominal_rotation(adjustment_.measurement(), visits()[g].angle) * adjustment_.set_up().rotation;
            effect[g].resize(poses_[g].rows(), 6);
            effect[g].leftCols(3) = poses_[g].leftCols<3>() * table_from_fixture;
            // A turn of 1/lever moves the reflectors by about 1: metres and radians count alike in the rank.
            effect[g].rightCols(3) =
                (poses_[g].rightCols<3>() * table_from_fixture + effect[g].leftCols(3) * across_centre) / lever;
        }
        return effect;
    }
    [[nodiscard]] std::optional<GroupTest> fixture_place_test(const std::vector<std::size_t>& order,
                                                              std::size_t from) const {
        const VisitEffects::Projection projection = visits_.projection(fixture_place_effect(order, from), 6);
        const Inverted inverted = pseudo_inverse(projection.spread, k_seen_of_fixture * projection.weight);
        if (inverted.rank == 0) {
            return std::nullopt;
        }
        const double scale = std::max(column_scale_, pose_scale_);
        const VectorXd error = inverted.inverse * projection.weighted;
        GroupTest test = judged(GroupKind::fixture_place, projection.weighted.dot(error) / (scale * scale),
                                inverted.rank, order.size());
        test.estimate = size_of_error(test, error, adjustment_.measurement().fixture);
        // Of a motion in the same direction: what the stations take up is hardly seen, and would make a mean of all useless.
        if (test.chi_square > 0.0) {
            test.minimal_detectable =
                (std::sqrt(test.critical_value) + k_deviate_of_power) * test.estimate / std::sqrt(test.chi_square);
        }
        return test;
    }
    [[nodiscard]] const std::vector<Visit>& visits() const { return adjustment_.visits(); }

    /// Drifts that are tested: columns with the value -1/2 at the first visit and 1/2 at the last one.
    struct Drifts {
        std::vector<VisitEffects::Column> each;  ///< of every sequence
        std::vector<std::size_t> first;          ///< visit of each
        VisitEffects::Column common;             ///< one rate of all sequences; 1 over the longest one
    };
    [[nodiscard]] Drifts drifts() const {
        Drifts result;
        const bool has_times = !adjustment_.measurement().times.empty();
        std::vector<std::vector<double>> times;
        double longest = 0.0;
        for (const auto& sequence : sequences_) {
            times.emplace_back();
            for (std::size_t k = 0; k < sequence.size(); ++k) {
                // Where no times are known, visits count as equally distant.
                times.back().push_back(has_times ? time_of(sequence[k]) : static_cast<double>(k));
            }
            longest = std::max(longest, times.back().back() - times.back().front());
        }
        for (std::size_t s = 0; s < sequences_.size(); ++s) {
            const double duration = times[s].back() - times[s].front();
            if (sequences_[s].size() < 3 || !(duration > 0.0)) {
                continue;
            }
            VisitEffects::Column column;
            for (std::size_t k = 0; k < sequences_[s].size(); ++k) {
                // About the middle: a constant part is the dead path.
                const double value = (times[s][k] - times[s].front()) / duration - 0.5;
                column.emplace_back(sequences_[s][k], value);
                result.common.emplace_back(sequences_[s][k], value * duration / longest);
            }
            result.each.push_back(std::move(column));
            result.first.push_back(sequences_[s].front());
        }
        return result;
    }

    /// What there is to know of drifts before anything is taken away.
    void estimate_drifts() {
        const Drifts all = drifts();
        const auto add = [this](const VisitEffects::Column& column, std::size_t station, std::size_t count) {
            const VisitEffects::Projection projection = visits_.projection({column});
            const double spread = projection.spread(0, 0);
            // An estimate without a test, for the documents: a drift that is not suspicious is stated with what would
            // have been found.
            if (spread > k_controlled * projection.weight) {
                result_.drifts.push_back({station, projection.weighted[0] / spread, column_scale_ / std::sqrt(spread),
                                          detectable(judged(GroupKind::drift, 0.0, 1, count), spread, column_scale_)});
            }
        };
        for (std::size_t k = 0; k < all.each.size(); ++k) {
            add(all.each[k], adjustment_.visits()[all.first[k]].station, drift_tests(all.each.size()));
        }
        if (all.each.size() > 1) {
            add(all.common, GroupTest::k_none, k_drift_hypotheses);
        }
    }

    /// Tests among which the level of drift is divided for one sequence.
    /// All alike, each its own, and single ones have a third of the level each: one cause of all stations must not pay
    /// for the number of stations (ADR 0031).
    static std::size_t drift_tests(std::size_t sequences) { return sequences > 1 ? k_drift_hypotheses * sequences : 1; }

    /// Of every sequence, of all sequences alike, and of each sequence its own, jointly.
    [[nodiscard]] std::optional<Candidate> best_drift() {
        const Drifts all = drifts();
        const std::size_t count = all.each.size() > 1 ? all.each.size() + 2 : 1;
        std::optional<Candidate> best;
        const auto consider = [&](std::optional<GroupTest> test, const std::vector<VisitEffects::Column>& columns) {
            if (test) {
                test->family = count;
                take(best, with_columns(*test, columns));
            }
        };
        for (std::size_t k = 0; k < all.each.size(); ++k) {
            std::optional<GroupTest> test = column_test(GroupKind::drift, all.each[k], drift_tests(all.each.size()));
            if (test) {
                place(*test, all.first[k]);
            }
            consider(test, {all.each[k]});
        }
        if (all.each.size() > 1) {
            consider(column_test(GroupKind::drift, all.common, k_drift_hypotheses), {all.common});
            consider(joint_drift(all.each, k_drift_hypotheses), all.each);
        }
        return best;
    }

    [[nodiscard]] GroupTest joint_drift(const std::vector<VisitEffects::Column>& columns, std::size_t count) const {
        const VisitEffects::Projection projection = visits_.projection(columns);
        const Inverted inverted = pseudo_inverse(projection.spread, k_controlled * projection.weight);
        const VectorXd drifts = inverted.inverse * projection.weighted;
        GroupTest test = judged(GroupKind::drift, projection.weighted.dot(drifts) / (column_scale_ * column_scale_),
                                std::max(inverted.rank, 1), count);
        test.estimate = drifts.norm() / std::sqrt(static_cast<double>(drifts.size()));
        for (std::size_t k = 0; k < columns.size(); ++k) {
            add_errors(test, columns[k], drifts[static_cast<Index>(k)]);
        }
        return test;
    }

    /// A station whose angles are some steps off. Its place takes up the steps themselves; what is left is that the
    /// table deviates at the other angle in another way than at this one: R(-s) E(θ+s) R(s) in place of E(θ).
    [[nodiscard]] std::optional<Candidate> best_index() {
        const RotaryTableMeasurement& measurement = adjustment_.measurement();
        const std::size_t angles = measurement.angles.size();
        // Only where another angle of the measurement lies where the shifted one would be.
        if (angles < 4 || !is_uniform(measurement)) {
            return std::nullopt;
        }
        const MatrixXd poses = adjustment_.poses();
        const double step = measurement.angles[1] - measurement.angles[0];
        const int most = std::min(static_cast<int>(angles) / 2, k_most_steps);
        moved_.resize(measurement.stations.size(), false);
        index_spreads_.resize(measurement.stations.size(),
                              std::vector<IndexSpread>(2 * static_cast<std::size_t>(most) + 1));
        std::vector<IndexMisfit> worst_of(measurement.stations.size());
        // What the stations share is only read here: limits are found afterwards, by one thread.
        FixedParts(measurement.stations.size(), 1)
            .run(adjustment_.adjustment().workers(), [&](std::size_t j, std::size_t, std::size_t) {
                for (int steps = -most; steps <= most && !moved_[j]; ++steps) {
                    // Half a turn backwards is half a turn forwards.
                    if (steps != 0 && 2 * steps != -static_cast<int>(angles)) {
                        keep_worse(worst_of[j], index_misfit(j, steps, steps * step, most, poses));
                    }
                }
            });
        std::optional<Candidate> best;
        for (std::size_t j = 0; j < worst_of.size(); ++j) {
            IndexMisfit& worst = worst_of[j];
            if (worst.steps == 0) {
                continue;
            }
            GroupTest test = judged(GroupKind::angle_index, worst.chi_square, 1,
                                    2 * static_cast<std::size_t>(most) * measurement.stations.size());
            test.station = j;
            test.estimate = worst.steps;
            Candidate candidate = with_effect(std::move(test), std::move(worst.effect), 1);
            candidate.take_away = [this, j, take_effect_away = std::move(candidate.take_away)] {
                take_effect_away();
                moved_[j] = true;
            };
            take(best, std::move(candidate));
        }
        return best;
    }

    /// What the distances of a station say of its angles being some steps off.
    struct IndexMisfit {
        int steps = 0;  ///< 0: nothing controls it
        double chi_square = 0.0;
        VisitEffects::Effect effect;
    };
    static void keep_worse(IndexMisfit& worst, IndexMisfit other) {
        if (other.steps != 0 && (worst.steps == 0 || other.chi_square > worst.chi_square)) {
            worst = std::move(other);
        }
    }

    IndexMisfit index_misfit(std::size_t station, int steps, double angle, int most, const MatrixXd& poses) {
        const RotaryTableMeasurement& measurement = adjustment_.measurement();
        const std::size_t angles = measurement.angles.size();
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axial_coordinate(measurement.axis))).toRotationMatrix();
        VisitEffects::Effect effect(visits_.size());
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            const Visit& visit = adjustment_.visits()[g];
            if (visit.station != station) {
                continue;  // and one that is out says nothing: M is zero there
            }
            const std::size_t other =
                (visit.angle + angles + static_cast<std::size_t>(steps + static_cast<int>(angles))) % angles;
            Eigen::Matrix<double, 6, 1> change;
            change << turn.transpose() * poses.col(static_cast<Index>(other)).head<3>(),
                turn.transpose() * poses.col(static_cast<Index>(other)).tail<3>();
            change -= poses.col(static_cast<Index>(visit.angle));
            effect[g] = poses_[g] * change;
        }
        IndexSpread& spread = index_spreads_[station][static_cast<std::size_t>(steps + most)];
        // What an earlier round has found is only less what was taken away since: the projection itself is what costs.
        if (spread.weight > 0.0) {
            spread.value -= visits_.taken_from(effect, 1, spread.left_out)(0, 0);
        } else {
            const VisitEffects::Projection projection = visits_.projection(effect, 1);
            spread.value = projection.spread(0, 0);
            spread.weight = projection.weight;
        }
        spread.left_out = visits_.left_out_count();
        if (!(spread.value > k_controlled * spread.weight)) {
            return {};
        }
        // By the larger of both scales, the cautious choice: the effect is neither a common error nor a free pose.
        const double scale = std::max(used_scale_, pose_scale_);
        // Angles are off by the steps or they are not: the effect has the amplitude 1, and no other one. What is tested is by
        // how much chi-square falls when the angles are corrected: 2w - s with w = Cᵀ V⁻¹ v and
        // s = Cᵀ M C. w²/s, by how much it falls with the best amplitude, is large as well where a small part of an
        // effect that is large happens to look like another fault, and the correction makes everything worse.
        // The poses that the effect is made of hold a J-th part of the fault of one of J stations, so that the amplitude lies
        // between 1 and J/(J - 2), and the larger ones are another fault.
        const double weighted = visits_.weighted(effect);
        const double fall = weighted < k_most_amplitude * spread.value ? 2.0 * weighted - spread.value : 0.0;
        return {steps, std::max(0.0, fall) / (scale * scale), std::move(effect)};
    }

    /// Whether the angles divide a full turn evenly.
    static bool is_uniform(const RotaryTableMeasurement& measurement) {
        const std::vector<double>& angles = measurement.angles_deg;
        const double step = 360.0 / static_cast<double>(angles.size());
        for (std::size_t i = 0; i < angles.size(); ++i) {
            if (std::abs(angles[i] - angles[0] - step * static_cast<double>(i)) > 1e-3) {
                return false;
            }
        }
        return true;
    }

    /// Autocorrelation of lag 1 of the deviations of successive visits, over all sequences.
    ///
    /// What the stations say of an angle is not independent: its error motions have six unknowns, and of few stations they leave
    /// little more than one number, which all stations show. So the products of all stations at two successive angles are one
    /// observation where they scatter more than independent ones.
    void search_succession() {
        double products = 0.0;
        double squares = 0.0;
        std::size_t pairs = 0;
        std::map<std::pair<std::size_t, std::size_t>, double> of_angles;  // products of two successive angles
        for (const auto& sequence : sequences_) {
            // In terms of their standard deviations: visits of different weight count alike.
            for (std::size_t k = 0; k < sequence.size(); ++k) {
                const double deviate = tests_[sequence[k]].deviate;
                squares += deviate * deviate;
                if (k > 0) {
                    const double product = tests_[sequence[k - 1]].deviate * deviate;
                    products += product;
                    ++pairs;
                    of_angles[std::minmax(adjustment_.visits()[sequence[k - 1]].angle,
                                          adjustment_.visits()[sequence[k]].angle)] += product;
                }
            }
        }
        if (pairs < k_fewest_for_scatter || !(squares > 0.0) || result_.scale < k_exact) {
            return;
        }
        const double r = products / squares;
        const double mean = products / static_cast<double>(of_angles.size());
        double scatter = 0.0;
        for (const auto& [angles, product] : of_angles) {
            scatter += (product - mean) * (product - mean);
        }
        const double spread = std::max(squares / std::sqrt(static_cast<double>(pairs)), std::sqrt(scatter));
        // One side only: that visits deviate alike is drift, that they alternate is nothing that a laboratory could
        // look for.
        const double deviate = std::max(0.0, products / spread);
        GroupTest test = judged(GroupKind::succession, deviate * deviate, 1, 1);
        test.estimate = r;
        result_.tests.push_back(test);
    }

    /// Ratio of the mean squares of the deviations of one station and of all others. The logarithm of a ratio of
    /// variances with ν₁ and ν₂ degrees of freedom has the variance 2/ν₁ + 2/ν₂, nearly.
    void search_stations() {
        if (result_.scale < k_exact) {
            return;
        }
        const std::size_t stations = adjustment_.measurement().stations.size();
        VectorXd squares = VectorXd::Zero(static_cast<Index>(stations));
        VectorXd counts = squares;
        for (std::size_t g = 0; g < visits_.size(); ++g) {
            if (!visits_.is_out(g) && tests_[g].is_controlled) {
                const auto j = static_cast<Index>(adjustment_.visits()[g].station);
                squares[j] += tests_[g].deviate * tests_[g].deviate;
                counts[j] += 1.0;
            }
        }
        std::vector<GroupTest> all;
        for (std::size_t j = 0; j < stations; ++j) {
            const auto at = static_cast<Index>(j);
            const double others = counts.sum() - counts[at];
            if (counts[at] < static_cast<double>(k_fewest_for_scatter) ||
                others < static_cast<double>(k_fewest_for_scatter)) {
                continue;
            }
            const double ratio = squares[at] / counts[at] / ((squares.sum() - squares[at]) / others);
            // One side only: a station that scatters less than the others is no fault.
            const double deviate = std::max(0.0, std::log(ratio) / std::sqrt(2.0 / counts[at] + 2.0 / others));
            GroupTest test = judged(GroupKind::station, deviate * deviate, 1, stations);
            test.station = j;
            test.estimate = std::sqrt(ratio);
            all.push_back(test);
        }
        keep(std::move(all));
    }

    /// What the distances say of the coordinates of the fixture.
    [[nodiscard]] FixtureMisfit fixture_misfit() const {
        // Where the distances see hardly anything of a coordinate its residual is rounding, and it is not tested.
        return {visits_.weighted_fixture(), visits_.own_fixture(),
                1e-6 * visits_.whitening_fixture().colwise().squaredNorm().minCoeff()};
    }

    const JointAdjustment& adjustment_;
    GroupJudgement judgement_;
    VisitEffects visits_;
    std::vector<MatrixXd> poses_;
    std::vector<Index> reversal_;  ///< parameters of one reversal of all angles; empty: there is none
    std::vector<VisitTest> tests_;
    std::vector<std::vector<std::size_t>> sequences_;
    double misfit_of_fixture_ = 0.0;  ///< of this round
    double used_scale_ = 1.0, pose_scale_ = 1.0,
           single_scale_ = 1.0;  ///< of common errors, of poses, of single distances
    double column_scale_ = 1.0;  ///< of errors that successive visits have in common
    std::vector<bool> moved_;    ///< by station: its angles were found to be others
    /// Cᵀ M C of angles that are off, with which each later round begins.
    struct IndexSpread {
        double value = 0.0;
        double weight = 0.0;       ///< 0: not computed yet
        std::size_t left_out = 0;  ///< number of the last that was taken from it
    };
    std::vector<std::vector<IndexSpread>> index_spreads_;  ///< by station, then by steps
    GroupTests result_;
};

}  // namespace

double share_of_level(GroupKind kind) {
    // They add up to 0.9 with the half of succession and station that is theirs. The tenth that is left is that of the check of the fixture (ADR 0031).
    switch (kind) {
        case GroupKind::drift:
            return 0.365;
        case GroupKind::visit_length:
            return 0.30;
        case GroupKind::dead_path_change:
            return 0.08;
        case GroupKind::reflector:
            return 0.06;
        case GroupKind::visit_pose:
            return 0.02;
        case GroupKind::succession:
        case GroupKind::station:
            return 0.015;
        case GroupKind::pair_length:
            return 0.01;
        case GroupKind::station_place:
        case GroupKind::reflector_at_angles:
        case GroupKind::reflector_from_visit:
        case GroupKind::angle_index:
        case GroupKind::fixture_scale:
        case GroupKind::station_scale:
        case GroupKind::fixture_place:
        // Half of what succession and station have is not theirs: large values of one sign only count there.
        case GroupKind::expansion:
        case GroupKind::senses:
            return 0.005;
    }
    return 0.0;
}

double size_of_error(const GroupTest& test, const VectorXd& unknowns, const Eigen::MatrixX3d& fixture) {
    switch (test.kind) {
        case GroupKind::angle_index:  // it is there or it is not: of whole steps
        case GroupKind::succession:
        case GroupKind::station:
            return test.estimate;
        case GroupKind::visit_pose:
            return (test.columns * unknowns).norm() /
                   std::sqrt(static_cast<double>((test.columns.array() != 0.0).rowwise().any().count()));
        case GroupKind::station_place:
        case GroupKind::reflector:
        case GroupKind::reflector_at_angles:
        case GroupKind::reflector_from_visit:
            return unknowns.norm();
        case GroupKind::fixture_place: {
            const Eigen::MatrixX3d points = about_their_centre(fixture);
            const Eigen::Vector3d turn = unknowns.tail<3>() / points.rowwise().norm().mean();
            double squares = 0.0;
            for (Index m = 0; m < points.rows(); ++m) {
                squares += (unknowns.head<3>() + turn.cross(points.row(m).transpose())).squaredNorm();
            }
            return std::sqrt(squares / static_cast<double>(points.rows()));
        }
        default:
            return unknowns.size() == 1 ? unknowns[0]
                                        : unknowns.norm() / std::sqrt(static_cast<double>(unknowns.size()));
    }
}

Eigen::VectorXd scale_errors_of_stations(const JointAdjustment& adjustment, const NormalEquations& normal,
                                         const BorderedCovariance& covariance,
                                         const std::vector<std::size_t>& stations) {
    const VisitEffects visits(adjustment, normal, covariance);
    const Index count = std::ssize(stations);
    VisitEffects::Effect effect(visits.size());
    for (Index k = 0; k < count; ++k) {
        const VisitEffects::Effect own = effect_of_scale(adjustment, visits, stations[static_cast<std::size_t>(k)]);
        for (std::size_t g = 0; g < own.size(); ++g) {
            if (own[g].size() > 0) {
                effect[g] = MatrixXd::Zero(own[g].rows(), count);
                effect[g].col(k) = own[g];
            }
        }
    }
    const VisitEffects::Projection projection = visits.projection(effect, static_cast<int>(count));
    if (count == 1) {
        const double spread = projection.spread(0, 0);
        return VectorXd::Constant(1, spread > k_controlled * projection.weight ? projection.weighted[0] / spread : 0.0);
    }
    return pseudo_inverse(projection.spread, k_controlled * projection.weight).inverse * projection.weighted;
}

double scale_error_of_fixture(const JointAdjustment& adjustment, const NormalEquations& normal,
                              const BorderedCovariance& covariance) {
    const VisitEffects visits(adjustment, normal, covariance);
    const Eigen::MatrixX3d& fixture = adjustment.measurement().fixture;
    const VectorXd effect = fixture.transpose().reshaped(fixture.size(), 1);
    const double spread = effect.dot(visits.own_fixture() * effect);
    return spread > 0.0 ? effect.dot(visits.weighted_fixture()) / spread : 0.0;
}

GroupTests test_groups(const JointAdjustment& adjustment, const NormalEquations& normal,
                       const BorderedCovariance& covariance, const GroupTestOptions& options) {
    return GroupSearch(adjustment, normal, covariance, options).run();
}

}  // namespace gumcert::engine
