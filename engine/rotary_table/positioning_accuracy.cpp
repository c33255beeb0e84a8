#include "engine/rotary_table/positioning_accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gumcert::engine {

namespace {

using Parameter = PositioningParameter;
using Indices = std::vector<Eigen::Index>;

struct Moments {
    double mean = 0.0, s = 0.0;
};

Moments moments(const Indices& runs, const Eigen::Ref<const Eigen::VectorXd>& x) {
    Moments result;
    const auto n = static_cast<double>(runs.size());
    for (const Eigen::Index j : runs) {
        result.mean += x[j];
    }
    result.mean /= n;
    if (runs.size() > 1) {
        double squares = 0.0;
        for (const Eigen::Index j : runs) {
            // About the mean, in a second pass: the sum of the squares less the square of the sum would lose the digits
            // of a repeatability that is small against the deviation itself.
            squares += (x[j] - result.mean) * (x[j] - result.mean);
        }
        result.s = std::sqrt(squares / (n - 1.0));
    }
    return result;
}

/// The largest of many values of c_mean x̄ + c_s s + constant, and where it was found.
class Extreme {
public:
    void offer(double value, std::size_t target, bool up) {
        // Strictly greater: of targets that tie the first one stands, and the derivatives follow the same one.
        if (value > value_) {
            value_ = value;
            target_ = target;
            up_ = up;
        }
    }
    [[nodiscard]] double value() const { return value_; }
    [[nodiscard]] std::size_t target() const { return target_; }
    [[nodiscard]] bool up() const { return up_; }

private:
    double value_ = -std::numeric_limits<double>::infinity();
    std::size_t target_ = 0;
    bool up_ = true;
};

/// All extremes of one set of runs. Those over both senses are of no meaning where one sense is missing.
struct Extremes {
    std::array<Extreme, 2> mean_high, mean_low, limit_high, limit_low, spread;  ///< of each sense: up, down
    Extreme both_high, both_low;                                                ///< of x̄_i, the mean of both senses
    Extreme repeatability, reversal;                                            ///< R_i, |B_i|
    double reversal_sum = 0.0;
};

Extremes find_extremes(const std::array<std::vector<Moments>, 2>& senses) {
    Extremes extremes;
    for (std::size_t sense = 0; sense < 2; ++sense) {
        for (std::size_t i = 0; i < senses[sense].size(); ++i) {
            const auto [mean, s] = senses[sense][i];
            extremes.mean_high[sense].offer(mean, i, sense == 0);
            extremes.mean_low[sense].offer(-mean, i, sense == 0);
            // x̄ ± 2 s of ISO 230-2: A is the distance of the outermost of these limits.
            extremes.limit_high[sense].offer(mean + 2.0 * s, i, sense == 0);
            extremes.limit_low[sense].offer(-(mean - 2.0 * s), i, sense == 0);
            extremes.spread[sense].offer(4.0 * s, i, sense == 0);
        }
    }
    for (std::size_t i = 0; i < std::min(senses[0].size(), senses[1].size()); ++i) {
        const Moments& up = senses[0][i];
        const Moments& down = senses[1][i];
        const double reversal = up.mean - down.mean;
        extremes.both_high.offer(0.5 * (up.mean + down.mean), i, true);
        extremes.both_low.offer(-0.5 * (up.mean + down.mean), i, true);
        extremes.repeatability.offer(2.0 * up.s + 2.0 * down.s + std::abs(reversal), i, true);
        extremes.reversal.offer(std::abs(reversal), i, true);
        extremes.reversal_sum += reversal;
    }
    return extremes;
}

const Extreme& larger(const Extreme& a, const Extreme& b) {
    return b.value() > a.value() ? b : a;
}

/// Moments of every target where a sense was measured at all of them, else none.
std::array<std::vector<Moments>, 2> all_moments(const PositioningRuns& runs,
                                                const Eigen::Ref<const Eigen::VectorXd>& deviations) {
    std::array<std::vector<Moments>, 2> result;
    for (std::size_t sense = 0; sense < 2; ++sense) {
        const std::vector<Indices>& targets = sense == 0 ? runs.up : runs.down;
        if (std::none_of(targets.begin(), targets.end(), [](const Indices& list) { return list.empty(); })) {
            result[sense].reserve(targets.size());
            for (const Indices& list : targets) {
                result[sense].push_back(moments(list, deviations));
            }
        }
    }
    return result;
}

}  // namespace

const std::array<std::string_view, k_positioning_parameters>& positioning_parameter_names() {
    static constexpr std::array<std::string_view, k_positioning_parameters> k_names{
        "M", "E", "E_up", "E_down", "R", "R_up", "R_down", "B", "B_mean", "A", "A_up", "A_down"};
    return k_names;
}

std::array<bool, k_positioning_parameters> allowed_parameters(const PositioningRuns& runs) {
    const auto fewest = [](const std::vector<Indices>& targets) {
        // The least number of runs decides: there is no parameter over some of the targets.
        std::size_t result = targets.empty() ? 0 : std::numeric_limits<std::size_t>::max();
        for (const Indices& list : targets) {
            result = std::min(result, list.size());
        }
        return result;
    };
    const std::size_t up = fewest(runs.up);
    const std::size_t down = fewest(runs.down);
    const bool both = up > 0 && down > 0 && runs.up.size() == runs.down.size();
    // A standard deviation needs two runs at every target. With a single run its 0 would stand for a perfect
    // repeatability.
    const bool both_s = both && up > 1 && down > 1;
    return {both, both, up > 0, down > 0, both_s, up > 1, down > 1, both, both, both_s, up > 1, down > 1};
}

PositioningAccuracy evaluate_positioning(const PositioningRuns& runs,
                                         const Eigen::Ref<const Eigen::VectorXd>& deviations) {
    PositioningAccuracy result;
    const auto allowed = allowed_parameters(runs);
    const Extremes e = find_extremes(all_moments(runs, deviations));
    const auto set = [&](Parameter parameter, double value) {
        if (allowed[static_cast<std::size_t>(parameter)]) {
            result.parameters[static_cast<std::size_t>(parameter)] = value;
        }
    };
    set(Parameter::mean_deviation_range, e.both_high.value() + e.both_low.value());
    set(Parameter::systematic,
        larger(e.mean_high[0], e.mean_high[1]).value() + larger(e.mean_low[0], e.mean_low[1]).value());
    set(Parameter::systematic_up, e.mean_high[0].value() + e.mean_low[0].value());
    set(Parameter::systematic_down, e.mean_high[1].value() + e.mean_low[1].value());
    // R of both senses can be less than that of one sense alone, where the spreads differ; then the larger one holds.
    set(Parameter::repeatability, std::max({e.repeatability.value(), e.spread[0].value(), e.spread[1].value()}));
    set(Parameter::repeatability_up, e.spread[0].value());
    set(Parameter::repeatability_down, e.spread[1].value());
    set(Parameter::reversal, e.reversal.value());
    set(Parameter::mean_reversal, e.reversal_sum / static_cast<double>(runs.up.size()));
    set(Parameter::accuracy,
        larger(e.limit_high[0], e.limit_high[1]).value() + larger(e.limit_low[0], e.limit_low[1]).value());
    set(Parameter::accuracy_up, e.limit_high[0].value() + e.limit_low[0].value());
    set(Parameter::accuracy_down, e.limit_high[1].value() + e.limit_low[1].value());

    result.targets.resize(std::max(runs.up.size(), runs.down.size()));
    for (std::size_t i = 0; i < result.targets.size(); ++i) {
        PositioningTarget& target = result.targets[i];
        if (i < runs.up.size() && !runs.up[i].empty()) {
            const auto [mean, s] = moments(runs.up[i], deviations);
            target.mean_up = mean;
            if (runs.up[i].size() > 1) {
                target.s_up = s;
            }
        }
        if (i < runs.down.size() && !runs.down[i].empty()) {
            const auto [mean, s] = moments(runs.down[i], deviations);
            target.mean_down = mean;
            if (runs.down[i].size() > 1) {
                target.s_down = s;
            }
        }
        if (target.mean_up && target.mean_down) {
            target.reversal = *target.mean_up - *target.mean_down;
        }
    }
    return result;
}

Eigen::MatrixXd positioning_derivatives(const PositioningRuns& runs,
                                        const Eigen::Ref<const Eigen::VectorXd>& deviations) {
    Eigen::MatrixXd result =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(k_positioning_parameters), deviations.size());
    const auto allowed = allowed_parameters(runs);
    const auto senses = all_moments(runs, deviations);
    const Extremes e = find_extremes(senses);

    // Adds by_mean ∂x̄_i + by_s ∂s_i to the row of a parameter: ∂x̄/∂x_j = 1/n, ∂s/∂x_j = (x_j - x̄)/((n - 1) s).
    const auto add = [&](Parameter parameter, std::size_t target, bool up, double by_mean, double by_s) {
        if (!allowed[static_cast<std::size_t>(parameter)]) {
            return;
        }
        const Indices& list = up ? runs.up[target] : runs.down[target];
        const auto [mean, s] = senses[up ? 0 : 1][target];
        const auto n = static_cast<double>(list.size());
        for (const Eigen::Index j : list) {
            double& element = result(static_cast<Eigen::Index>(parameter), j);
            element += by_mean / n;
            // At s = 0 the standard deviation has no derivative.
            if (by_s != 0.0 && s > 0.0) {
                element += by_s * (deviations[j] - mean) / ((n - 1.0) * s);
            }
        }
    };
    const auto add_range = [&](Parameter parameter, const Extreme& high, const Extreme& low, double by_s) {
        add(parameter, high.target(), high.up(), 1.0, by_s);
        add(parameter, low.target(), low.up(), -1.0, by_s);
    };
    const auto add_reversal = [&](Parameter parameter, std::size_t target) {
        if (!allowed[static_cast<std::size_t>(parameter)]) {
            return;
        }
        const double reversal = senses[0][target].mean - senses[1][target].mean;
        // |B| has no derivative at 0; 0 stands in for it.
        const double sign = reversal > 0.0 ? 1.0 : reversal < 0.0 ? -1.0 : 0.0;
        add(parameter, target, true, sign, 0.0);
        add(parameter, target, false, -sign, 0.0);
    };
    for (const bool up : {true, false}) {
        add(Parameter::mean_deviation_range, e.both_high.target(), up, 0.5, 0.0);
        add(Parameter::mean_deviation_range, e.both_low.target(), up, -0.5, 0.0);
    }
    add_range(Parameter::systematic, larger(e.mean_high[0], e.mean_high[1]), larger(e.mean_low[0], e.mean_low[1]), 0.0);
    add_range(Parameter::systematic_up, e.mean_high[0], e.mean_low[0], 0.0);
    add_range(Parameter::systematic_down, e.mean_high[1], e.mean_low[1], 0.0);
    const Extreme& one_sense = larger(e.spread[0], e.spread[1]);
    // R is a maximum of different formulas: the derivative is that of the formula which gave the value.
    if (one_sense.value() > e.repeatability.value()) {
        add(Parameter::repeatability, one_sense.target(), one_sense.up(), 0.0, 4.0);
    } else {
        add(Parameter::repeatability, e.repeatability.target(), true, 0.0, 2.0);
        add(Parameter::repeatability, e.repeatability.target(), false, 0.0, 2.0);
        add_reversal(Parameter::repeatability, e.repeatability.target());
    }
    add(Parameter::repeatability_up, e.spread[0].target(), true, 0.0, 4.0);
    add(Parameter::repeatability_down, e.spread[1].target(), false, 0.0, 4.0);
    add_reversal(Parameter::reversal, e.reversal.target());
    for (std::size_t i = 0; allowed[static_cast<std::size_t>(Parameter::mean_reversal)] && i < runs.up.size(); ++i) {
        add(Parameter::mean_reversal, i, true, 1.0 / static_cast<double>(runs.up.size()), 0.0);
        add(Parameter::mean_reversal, i, false, -1.0 / static_cast<double>(runs.up.size()), 0.0);
    }
    add_range(Parameter::accuracy, larger(e.limit_high[0], e.limit_high[1]), larger(e.limit_low[0], e.limit_low[1]),
              2.0);
    add_range(Parameter::accuracy_up, e.limit_high[0], e.limit_low[0], 2.0);
    add_range(Parameter::accuracy_down, e.limit_high[1], e.limit_low[1], 2.0);
    return result;
}

namespace {

/// Values that are combinations of means and standard deviations of targets, and their derivatives.
class CombinedMoments {
public:
    CombinedMoments(const PositioningRuns& runs, const Eigen::Ref<const Eigen::VectorXd>& deviations)
        : runs_(runs), deviations_(deviations), senses_(all_moments(runs, deviations)) {}

    [[nodiscard]] std::size_t targets(bool up) const { return senses_[up ? 0 : 1].size(); }
    [[nodiscard]] Moments of(std::size_t target, bool up) const { return senses_[up ? 0 : 1][target]; }

    /// Begins a value.
    CombinedMoments& value() {
        values_.push_back(0.0);
        rows_.emplace_back(Eigen::RowVectorXd::Zero(deviations_.size()));
        return *this;
    }
    /// Adds by_mean x̄ + by_s s of a target to the value that was begun last.
    CombinedMoments& add(std::size_t target, bool up, double by_mean, double by_s) {
        const Indices& list = up ? runs_.up[target] : runs_.down[target];
        const auto [mean, s] = of(target, up);
        const auto n = static_cast<double>(list.size());
        values_.back() += by_mean * mean + by_s * s;
        for (const Eigen::Index j : list) {
            rows_.back()[j] += by_mean / n;
            if (by_s != 0.0 && s > 0.0) {
                rows_.back()[j] += by_s * (deviations_[j] - mean) / ((n - 1.0) * s);
            }
        }
        return *this;
    }
    [[nodiscard]] Eigen::Index last() const { return static_cast<Eigen::Index>(values_.size()) - 1; }

    [[nodiscard]] PositioningExtremes extremes(Indices upper, Indices lower) const {
        PositioningExtremes result;
        result.value = Eigen::Map<const Eigen::VectorXd>(values_.data(), static_cast<Eigen::Index>(values_.size()));
        result.by_deviation.resize(result.value.size(), deviations_.size());
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            result.by_deviation.row(static_cast<Eigen::Index>(i)) = rows_[i];
        }
        result.upper = std::move(upper);
        result.lower = std::move(lower);
        return result;
    }

private:
    const PositioningRuns& runs_;
    Eigen::VectorXd deviations_;
    std::array<std::vector<Moments>, 2> senses_;
    std::vector<double> values_;
    std::vector<Eigen::RowVectorXd> rows_;
};

/// Senses of approach that a parameter looks at.
std::vector<bool> senses_of(Parameter parameter) {
    switch (parameter) {
        case Parameter::systematic_up:
        case Parameter::repeatability_up:
        case Parameter::accuracy_up:
            return {true};
        case Parameter::systematic_down:
        case Parameter::repeatability_down:
        case Parameter::accuracy_down:
            return {false};
        default:
            return {true, false};
    }
}

}  // namespace

PositioningExtremes positioning_extremes(const PositioningRuns& runs,
                                         const Eigen::Ref<const Eigen::VectorXd>& deviations, Parameter parameter) {
    CombinedMoments all(runs, deviations);
    Indices upper;
    Indices lower;
    if (parameter == Parameter::mean_deviation_range) {
        for (std::size_t i = 0; i < all.targets(true); ++i) {
            upper.push_back(all.value().add(i, true, 0.5, 0.0).add(i, false, 0.5, 0.0).last());
        }
        return all.extremes(upper, upper);
    }
    if (parameter == Parameter::reversal) {
        for (std::size_t i = 0; i < all.targets(true); ++i) {
            for (const double sign : {1.0, -1.0}) {
                upper.push_back(all.value().add(i, true, sign, 0.0).add(i, false, -sign, 0.0).last());
            }
        }
        return all.extremes(upper, {});
    }
    const bool is_accuracy = parameter == Parameter::accuracy || parameter == Parameter::accuracy_up ||
                             parameter == Parameter::accuracy_down;
    const bool is_repeatability = parameter == Parameter::repeatability || parameter == Parameter::repeatability_up ||
                                  parameter == Parameter::repeatability_down;
    for (const bool up : senses_of(parameter)) {
        for (std::size_t i = 0; i < all.targets(up); ++i) {
            if (is_repeatability) {
                upper.push_back(all.value().add(i, up, 0.0, 4.0).last());
            } else {
                const double by_s = is_accuracy ? 2.0 : 0.0;
                upper.push_back(all.value().add(i, up, 1.0, by_s).last());
                lower.push_back(is_accuracy ? all.value().add(i, up, 1.0, -by_s).last() : upper.back());
            }
        }
    }
    if (parameter == Parameter::repeatability) {
        for (std::size_t i = 0; i < all.targets(true); ++i) {
            for (const double sign : {1.0, -1.0}) {  // of the reversal, whose magnitude R_i holds
                upper.push_back(all.value().add(i, true, sign, 2.0).add(i, false, -sign, 2.0).last());
            }
        }
    }
    return all.extremes(upper, lower);
}

}  // namespace gumcert::engine
