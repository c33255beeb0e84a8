#include "gum/rotary_table/widened_extremes.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "engine/rotary_table/positioning_accuracy.h"
#include "gum/rotary_table/positioning_scope.h"

namespace gumcert::gum {

namespace {

/// Combinations of the positions of visits, for their covariance.
class CombinedPositions final : public MeasurementModel {
public:
    CombinedPositions(const engine::TableParameterModel& table, Eigen::VectorXd value,
                      const Eigen::MatrixXd& by_position)
        : table_(table), value_(std::move(value)), jacobian_(table.jacobian_of_positions(by_position)) {
        outputs_.assign(static_cast<std::size_t>(value_.size()), {"deviation", "rad"});
    }

    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return table_.inputs(); }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& /*x*/) const override { return value_; }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& /*x*/) const override { return jacobian_; }

private:
    const engine::TableParameterModel& table_;
    Eigen::VectorXd value_;
    Eigen::MatrixXd jacobian_;
    std::vector<OutputQuantity> outputs_;
};

/// Those of some values that lie near their extreme one.
std::vector<Eigen::Index> near_extreme(const std::vector<Eigen::Index>& some, const Eigen::VectorXd& value, double sign,
                                       double distance) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Eigen::Index i : some) {
        most = std::max(most, sign * value[i]);
    }
    std::vector<Eigen::Index> near;
    std::ranges::copy_if(some, std::back_inserter(near),
                         [&](Eigen::Index i) { return most - sign * value[i] <= distance; });
    return near;
}

/// The values of an extreme without those that lie so far from it that they need no covariance.
/// \param kept  receives the places of those that are left
ExtremeValues near_values(const engine::PositioningExtremes& all, double distance, std::vector<Eigen::Index>& kept) {
    ExtremeValues values{.value = {},
                         .covariance = {},
                         .upper = near_extreme(all.upper, all.value, 1.0, distance),
                         .lower = near_extreme(all.lower, all.value, -1.0, distance)};
    kept = values.upper;
    kept.insert(kept.end(), values.lower.begin(), values.lower.end());
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (std::vector<Eigen::Index>* some : {&values.upper, &values.lower}) {
        for (Eigen::Index& one : *some) {
            one = std::lower_bound(kept.begin(), kept.end(), one) - kept.begin();
        }
    }
    values.value = all.value(kept);
    return values;
}

}  // namespace

MotionCovariances motion_covariances(const engine::AnglewiseCovariance& reported, std::size_t angles) {
    MotionCovariances result;
    for (std::size_t motion = 0; motion < result.size(); ++motion) {
        std::vector<Eigen::Index> at;
        for (std::size_t angle = 0; angle < angles; ++angle) {
            at.push_back(static_cast<Eigen::Index>(6 * angle + motion));
        }
        result.at(motion) = reported.of(at);
    }
    return result;
}

void widen_ranges(UncertaintyBudget& parameters, const TableDeviations& of) {
    const Eigen::Index first = of.model.parameters()->layout().ranges;
    for (Eigen::Index motion = 0; motion < 6; ++motion) {
        const Eigen::MatrixXd& covariance = of.covariance.at(static_cast<std::size_t>(motion));
        const Eigen::VectorXd errors = of.reported(Eigen::seqN(motion, covariance.rows(), Eigen::fix<6>));
        state_extreme(parameters, first + motion,
                      extreme_uncertainty(range_of(errors, covariance), parameters.coverage_probability,
                                          parameters.effective_degrees_of_freedom[first + motion], of.draws));
    }
}

void widen_positioning(UncertaintyBudget& parameters, const TableDeviations& of,
                       const std::function<bool(const std::string&)>& stated) {
    const engine::TableParameters& table = *of.model.parameters();
    const engine::TableParameterLayout& layout = table.layout();
    // Many times the u of a difference of two.
    constexpr double k_far = 12.0;
    const auto& names = engine::positioning_parameter_names();
    for (Eigen::Index i = layout.positioning; i < layout.positioning + layout.positioning_count; ++i) {
        const std::string& name = table.short_names()[static_cast<std::size_t>(i)];
        if (!holds_noise_already(table, i) || !stated(name)) {
            continue;
        }
        const auto parameter =
            static_cast<engine::PositioningParameter>(std::find(names.begin(), names.end(), name) - names.begin());
        const engine::PositioningExtremes all = engine::positioning_extremes(table.runs(), of.positions, parameter);
        const double distance = k_far * std::max(parameters.standard_uncertainty[i], of.u_deviation);
        std::vector<Eigen::Index> kept;
        ExtremeValues values = near_values(all, distance, kept);
        if (values.upper.size() <= 1 && values.lower.size() <= 1) {
            continue;
        }
        values.covariance = propagate(CombinedPositions(of.model, values.value, all.by_deviation(kept, Eigen::all)),
                                      parameters.coverage_probability)
                                .covariance;
        state_extreme(parameters, i,
                      extreme_uncertainty(values, parameters.coverage_probability,
                                          parameters.effective_degrees_of_freedom[i], of.draws));
    }
}

}  // namespace gumcert::gum
