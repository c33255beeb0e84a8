#include "engine/rotary_table/studies/station_proposal.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();

}  // namespace

std::array<double, 6> motion_ratios(const Eigen::VectorXd& variances, Eigen::Index angles,
                                    const std::array<double, 2>& wanted) {
    std::array<double, 6> largest{};
    for (Eigen::Index i = 0; i < 6 * angles; ++i) {
        const auto c = static_cast<std::size_t>(i % 6);
        const double ratio = std::sqrt(variances[i]) / wanted[c < 3 ? 0 : 1];
        // Written so that a NaN is never the smaller one: a layout without a number is no good layout.
        if (!(ratio <= largest[c])) {
            largest[c] = std::isnan(ratio) ? k_infinite : ratio;
        }
    }
    return largest;
}

double largest_ratio(const std::optional<Eigen::VectorXd>& variances, Eigen::Index angles,
                     const std::array<double, 2>& wanted) {
    if (!variances) {
        return k_infinite;
    }
    const std::array<double, 6> ratios = motion_ratios(*variances, angles, wanted);
    return *std::max_element(ratios.begin(), ratios.end());
}

StationCandidates station_candidates(const RotaryTableMeasurement& measurement, const StationRegion& region) {
    std::vector<Eigen::Vector3d> reflectors;
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        const Eigen::Matrix3d rotation = nominal_rotation(measurement, i);
        for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
            reflectors.emplace_back(rotation * measurement.fixture.row(m).transpose());
        }
    }
    const Eigen::Vector3d low = region.corners[0].cwiseMin(region.corners[1]);
    const Eigen::Vector3d size = region.corners[0].cwiseMax(region.corners[1]) - low;
    const auto across = across_axis(measurement.axis);
    const auto count = [&](double step, int c) {
        // A side that is a whole number of steps up to rounding has its far face on the grid.
        return static_cast<std::size_t>(std::ceil(size[c] / step - 1e-9)) + 1;
    };
    StationCandidates candidates{{}, region.step};
    // The grid becomes coarser as a whole. Leaving out a part of it would leave out a part of the room.
    while (static_cast<double>(count(candidates.step, 0)) * static_cast<double>(count(candidates.step, 1)) *
               static_cast<double>(count(candidates.step, 2)) >
           static_cast<double>(region.most_candidates)) {
        candidates.step *= 1.1;
    }
    std::array<std::size_t, 3> counts{};
    for (int c = 0; c < 3; ++c) {
        counts[static_cast<std::size_t>(c)] = count(candidates.step, c);
    }
    for (std::size_t x = 0; x < counts[0]; ++x) {
        for (std::size_t y = 0; y < counts[1]; ++y) {
            for (std::size_t z = 0; z < counts[2]; ++z) {
                const std::array<std::size_t, 3> at{x, y, z};
                Eigen::Vector3d position = low;
                for (int c = 0; c < 3; ++c) {
                    const auto k = static_cast<std::size_t>(c);
                    if (counts[k] > 1) {
                        position[c] += size[c] * static_cast<double>(at[k]) / static_cast<double>(counts[k] - 1);
                    }
                }
                const double from_axis = std::hypot(position[across[0]], position[across[1]]);
                const bool free = std::all_of(reflectors.begin(), reflectors.end(), [&](const Eigen::Vector3d& p) {
                    return (p - position).norm() >= region.least_distance;
                });
                if (free && from_axis >= region.least_axis_distance) {
                    candidates.positions.push_back(position);
                }
            }
        }
    }
    return candidates;
}

std::vector<StationAmongReflectors> stations_among_reflectors(const RotaryTableMeasurement& measurement,
                                                              double least_distance) {
    std::vector<StationAmongReflectors> nearest(measurement.stations.size(), {0, 0, 0, k_infinite});
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        const Eigen::Matrix3d rotation = nominal_rotation(measurement, i);
        for (std::size_t m = 0; m < measurement.reflectors.size(); ++m) {
            const Eigen::Vector3d reflector =
                rotation * measurement.fixture.row(static_cast<Eigen::Index>(m)).transpose();
            for (std::size_t j = 0; j < nearest.size(); ++j) {
                const double distance = (reflector - *measurement.station_start[j]).norm();
                if (distance < nearest[j].distance) {
                    nearest[j] = {j, m, i, distance};
                }
            }
        }
    }
    std::erase_if(nearest, [&](const StationAmongReflectors& station) { return station.distance >= least_distance; });
    return nearest;
}

namespace {

/// The exchanges of single stations, round by round.
class StationSearch {
public:
    StationSearch(const RotaryTableMeasurement& measurement, const StochasticModel& stochastic,
                  const std::vector<Eigen::Vector3d>& candidates, const ExchangeRules& rules,
                  const ParallelTasks& parallel)
        : layout_(measurement, stochastic),
          candidates_(candidates),
          rules_(rules),
          parallel_(parallel),
          stations_(measurement.stations.size()),
          angles_(static_cast<Eigen::Index>(measurement.angles.size())),
          workers_(parallel.workers),
          parts_(stations_),
          others_(stations_) {
        for (Worker& worker : workers_) {
            worker.observers.resize(stations_);
        }
        if (static_cast<double>(tasks()) * static_cast<double>(angles_) * 36.0 <= k_most_remembered) {
            remembered_.resize(tasks());
        }
        start();
    }

    StationProposal run(const Progress& progress) {
        while (!candidates_.empty() && proposal_.exchanges.size() < k_most_exchanges) {
            for (std::size_t j = 0; j < stations_; ++j) {
                others_[j] = layout_.prior();
                for (std::size_t k = 0; k < stations_; ++k) {
                    if (k != j) {
                        add(others_[j], parts_[k]);
                    }
                }
            }
            const std::vector<double> ratios = ratios_of_round();
            proposal_.layouts += ratios.size();
            // Of equal exchanges the one of the lowest number, whatever thread was sooner.
            const auto best = static_cast<std::size_t>(std::min_element(ratios.begin(), ratios.end()) - ratios.begin());
            if (!(ratios[best] < wanted_ratio())) {
                break;
            }
            exchange(best, ratios[best]);
            if (progress) {
                progress("station " + layout_.measurement().stations[best / candidates_.size()] + " moved, exchange " +
                         std::to_string(proposal_.exchanges.size()));
            }
        }
        return proposal_;
    }

private:
    // Two instruments, or one at two times, do not stand in one place: such a layout is a repetition, not a position.
    static constexpr double k_same_place = 0.05;  // [m]
    static constexpr std::size_t k_most_exchanges = 200;
    static constexpr double k_most_remembered = 4e6;  // numbers, 32 MB
    // Of a lower bound, for the rounding errors of both ways to compute it.
    static constexpr double k_surely = 1.0 - 1e-6;

    struct Worker {
        std::vector<std::unique_ptr<LayoutVariances::Observer>> observers;
        LayoutVariances::Information part, sum;
        Eigen::MatrixXd poses;
    };

    [[nodiscard]] std::size_t tasks() const { return stations_ * candidates_.size(); }
    [[nodiscard]] double wanted_ratio() const { return (1.0 - rules_.least_gain) * proposal_.ratio_after; }

    void start() {
        LayoutVariances::Information all = layout_.prior();
        for (std::size_t j = 0; j < stations_; ++j) {
            const Eigen::Vector3d position = *layout_.measurement().station_start[j];
            proposal_.positions.push_back(position);
            if (const auto seer = observer(workers_.front(), j, position)) {
                seer->information(position, parts_[j]);
            } else {
                parts_[j] = nothing();
            }
            add(all, parts_[j]);
        }
        const std::optional<Eigen::VectorXd> variances = layout_.variances(all);
        proposal_.ratio_before = largest_ratio(variances, angles_, rules_.wanted);
        proposal_.ratio_after = proposal_.ratio_before;
        if (variances) {
            const std::array<double, 6> ratios = motion_ratios(*variances, angles_, rules_.wanted);
            for (std::size_t c = 0; c < 6; ++c) {
                // A target that is met already may be kept: what one motion gains must not be paid for by another one.
                kept_[c] = rules_.keep_met && ratios[c] <= 1.0;
            }
        }
    }

    [[nodiscard]] LayoutVariances::Information nothing() const {
        LayoutVariances::Information result = layout_.prior();
        result.border.setZero();
        return result;  // a prior says nothing about the poses
    }

    /// What the station sees from there; null where it sees nothing.
    std::shared_ptr<LayoutVariances::Observer> observer(Worker& worker, std::size_t station,
                                                        const Eigen::Vector3d& position) const {
        const std::vector<LengthObservation>& lengths = layout_.measurement().lengths;
        if (rules_.sight != nullptr) {
            std::vector<bool> seen(lengths.size(), false);
            std::size_t all = 0;
            std::size_t hidden = 0;
            for (std::size_t i = 0; i < lengths.size(); ++i) {
                if (lengths[i].station == station) {
                    seen[i] = !rules_.sight->hindrance(position, lengths[i].angle, lengths[i].reflector);
                    ++all;
                    hidden += seen[i] ? 0U : 1U;
                }
            }
            if (hidden == all) {
                return nullptr;
            }
            // What is partly hidden depends on the place: it is set up for this place alone. What is wholly seen is set
            // up once.
            if (hidden > 0) {
                return layout_.observer(station, seen);
            }
        }
        if (!worker.observers[station]) {
            worker.observers[station] = layout_.observer(station);
        }
        return {std::shared_ptr<void>(), worker.observers[station].get()};  // without a part in its life
    }

    /// Largest ratio of a layout; infinite where it breaks a target that is to be kept.
    [[nodiscard]] double ratio_of(const std::optional<Eigen::VectorXd>& variances, double surely = 1.0) const {
        if (!variances) {
            return k_infinite;
        }
        const std::array<double, 6> ratios = motion_ratios(*variances, angles_, rules_.wanted);
        for (std::size_t c = 0; c < 6; ++c) {
            if (kept_[c] && surely * ratios[c] > 1.0) {
                return k_infinite;
            }
        }
        return surely * *std::max_element(ratios.begin(), ratios.end());
    }

    /// What no ratio of this exchange is below.
    double least_ratio(Worker& worker, std::size_t task) {
        const std::size_t j = task / candidates_.size();
        const Eigen::Vector3d& position = candidates_[task % candidates_.size()];
        for (const Eigen::Vector3d& other : proposal_.positions) {
            if ((other - position).norm() < k_same_place) {
                return k_infinite;
            }
        }
        Eigen::MatrixXd& poses = remembered_.empty() ? worker.poses : remembered_[task];
        if (remembered_.empty() || poses.size() == 0) {
            const auto seer = observer(worker, j, position);
            if (!seer) {
                return k_infinite;
            }
            seer->pose_information(position, poses);
        }
        // A bound from another computation: taken down by a little more than rounding, so that no best exchange is
        // lost.
        return ratio_of(layout_.least_variances(poses + others_[j].poses), k_surely);
    }

    double ratio(Worker& worker, std::size_t task) {
        const std::size_t j = task / candidates_.size();
        const Eigen::Vector3d& position = candidates_[task % candidates_.size()];
        observer(worker, j, position)->information(position, worker.part);
        worker.sum = others_[j];
        add(worker.sum, worker.part);
        return ratio_of(layout_.variances(worker.sum));
    }

    /// Of every exchange; infinite also for those that are surely not the best, or surely not wanted.
    std::vector<double> ratios_of_round() {
        // The bound takes the poses alone, with all else as known. The border, the costly part, is factored only for
        // exchanges that may still be the best, the most promising first.
        // The bound costs a twentieth of the variances, and leaves most exchanges out.
        std::vector<double> least(tasks());
        parallel_.run(least.size(),
                      [&](unsigned worker, std::size_t task) { least[task] = least_ratio(workers_[worker], task); });
        std::vector<std::size_t> order(least.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        // What cannot be below the ratio that is wanted is not computed further.
        std::erase_if(order, [&](std::size_t task) { return !(least[task] < wanted_ratio()); });
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t left, std::size_t right) { return least[left] < least[right]; });
        std::vector<double> ratios(least.size(), k_infinite);
        // Which exchanges are left out depends on the order in which threads come to them; none of them is the best.
        std::atomic<double> best = k_infinite;
        parallel_.run(order.size(), [&](unsigned worker, std::size_t at) {
            const std::size_t task = order[at];
            if (least[task] > best.load()) {
                return;
            }
            const double found = ratio(workers_[worker], task);
            ratios[task] = found;
            double before = best.load();
            while (found < before && !best.compare_exchange_weak(before, found)) {
            }
        });
        return ratios;
    }

    void exchange(std::size_t task, double ratio_after) {
        const std::size_t j = task / candidates_.size();
        const Eigen::Vector3d& position = candidates_[task % candidates_.size()];
        proposal_.exchanges.push_back({j, proposal_.positions[j], position, ratio_after});
        proposal_.positions[j] = position;
        proposal_.ratio_after = ratio_after;
        // Normal equations add up station by station: only the part of the one that moved is new.
        observer(workers_.front(), j, position)->information(position, parts_[j]);
    }

    const LayoutVariances layout_;
    const std::vector<Eigen::Vector3d>& candidates_;
    const ExchangeRules& rules_;
    const ParallelTasks& parallel_;
    std::size_t stations_;
    Eigen::Index angles_;
    std::vector<Worker> workers_;
    std::vector<LayoutVariances::Information> parts_, others_;  ///< of each station; of all but it
    std::vector<Eigen::MatrixXd> remembered_;  ///< information about the poses, by task; empty where it is too much
    std::array<bool, 6> kept_{};
    StationProposal proposal_;
};

}  // namespace

StationProposal propose_stations(const RotaryTableMeasurement& measurement, const StochasticModel& stochastic,
                                 const std::vector<Eigen::Vector3d>& candidates, const ExchangeRules& rules,
                                 const ParallelTasks& parallel, const Progress& progress) {
    return StationSearch(measurement, stochastic, candidates, rules, parallel).run(progress);
}

}  // namespace gumcert::engine
