#include "gum/rotary_table/studies/plan_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/rotary_table_contributions.h"
#include "engine/rotary_table/rotary_table_model.h"
#include "engine/rotary_table/studies/measurement_plan.h"
#include "engine/rotary_table/table_parameters.h"
#include "gum/coverage.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/propagation.h"
#include "gum/rotary_table/positioning_scope.h"

namespace gumcert::gum::plan {

namespace {

using engine::RotaryTableMeasurement;
using engine::TableParameterModel;

constexpr std::uint64_t k_seed = 230;
// Two digits of U are enough before a measurement, and every layout that is looked at costs these draws.
constexpr std::size_t k_draws_of_a_plan = 2048;
// Error motions of the drawn tables, so large that noise does not decide which angle is extreme.
constexpr double k_drawn_linear = 1e-5;           // [m]
constexpr double k_drawn_against_scatter = 10.0;  // of the angular ones against the scatter of a run
// Angles, of all tables together, of which it is found out how much more E, R and A have than by the law of propagation. One table of
// many angles shows it as well as several of few, and costs the square of their number.
constexpr std::size_t k_angles_of_widened_tables = 240;

/// A standard normal deviate that a number stands for.
double deviate(std::uint64_t table, std::uint64_t number) {
    constexpr double k_step = 0x1p-53;
    const std::uint64_t word = philox_4x64_10({k_seed, 0}, {number, table, 0, 0})[0];
    return standard_normal_quantile((static_cast<double>(word >> 11U) + 0.5) * k_step);
}

/// The law of propagation at a table that shows certain values.
class ShownTable final : public MeasurementModel {
public:
    ShownTable(const TableParameterModel& model, const TableValues& values) : model_(model), values_(values) {}

    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return model_.inputs(); }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return model_.outputs(); }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& /*x*/) const override {
        Eigen::VectorXd result(static_cast<Eigen::Index>(outputs().size()));
        model_.parameters()->values(values_.reported, values_.positions, result);
        return result;
    }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& /*x*/) const override {
        return model_.jacobian_of_table(values_.reported, values_.positions);
    }

private:
    const TableParameterModel& model_;
    const TableValues& values_;
};

int widened_tables(std::size_t angles) {
    return static_cast<int>(
        std::clamp(k_angles_of_widened_tables / angles, std::size_t{1}, static_cast<std::size_t>(k_drawn_tables)));
}

/// \param scatter  of a run
TableValues drawn_table(const TableParameterModel& model, const RotaryTableMeasurement& layout, double scatter,
                        int table) {
    const auto number = static_cast<std::uint64_t>(table);
    const auto angles = static_cast<Eigen::Index>(layout.angles.size());
    const auto visits = static_cast<Eigen::Index>(model.visits().size());
    TableValues values{.reported = Eigen::VectorXd::Zero(6 * angles + 4 + (model.has_reversal() ? 6 : 0)),
                       .positions = Eigen::VectorXd::Zero(visits)};
    for (Eigen::Index i = 0; i < 6 * angles; ++i) {
        const bool zero = layout.datum == engine::Datum::home && i / 6 == static_cast<Eigen::Index>(layout.home);
        const double size = i % 6 < 3 ? k_drawn_linear : k_drawn_against_scatter * scatter;
        values.reported[i] = zero ? 0.0 : size * deviate(2 * number, static_cast<std::uint64_t>(i));
    }
    const int axial = 3 + engine::axial_coordinate(layout.axis);
    for (Eigen::Index v = 0; v < visits; ++v) {
        const auto angle = static_cast<Eigen::Index>(model.visits()[static_cast<std::size_t>(v)].angle);
        values.positions[v] =
            values.reported[6 * angle + axial] + scatter * deviate(2 * number + 1, static_cast<std::uint64_t>(v));
    }
    return values;
}

/// The name of a parameter of ISO 230-2 that a plan states: of both senses where there are such, else of the one sense.
std::optional<std::string> stated_name(const std::vector<std::string>& names, const std::string& letter) {
    for (const std::string& name : {letter, letter + "_up", letter + "_down"}) {
        if (std::find(names.begin(), names.end(), name) != names.end()) {
            return name;
        }
    }
    return std::nullopt;
}

/// E, R and A of both senses where there are such, else those of the one sense; with their targets.
void add_positioning(const engine::TableParameters& parameters, const Eigen::VectorXd& u, bool scatter_stated,
                     const ParameterTargets& targets, double k, ExpectedParameters& expected) {
    const std::vector<std::string>& names = parameters.short_names();
    const std::array<std::pair<const char*, std::optional<double>>, 3> wanted{
        {{"E", targets.systematic}, {"R", targets.repeatability}, {"A", targets.accuracy}}};
    for (const auto& [letter, target] : wanted) {
        const std::string name = letter;
        const std::optional<std::string> found = stated_name(names, name);
        PlannedParameter parameter{found.value_or(name), true, std::nullopt, target};
        if (found && (scatter_stated || !rests_on_scatter(name))) {
            parameter.U = k * u[std::find(names.begin(), names.end(), *found) - names.begin()];
        }
        if (found || target) {
            expected.all.push_back(std::move(parameter));
        }
    }
}

}  // namespace

TableUncertainties uncertainties_of_table(const TableParameterModel& model, const MotionCovariances& covariance,
                                          const TableValues& values, const ScopeOfPositioning& scope,
                                          double coverage_probability) {
    const std::vector<std::string>& names = model.parameters()->short_names();
    const auto is_stated = [&](const std::string& name) {
        const std::string letter = name.substr(0, 1);
        const bool is_planned = letter == "E" || letter == "R" || letter == "A";
        return is_planned && (scope.scatter_stated || !rests_on_scatter(name)) && stated_name(names, letter) == name;
    };
    Propagation stated = propagate(ShownTable(model, values), coverage_probability);
    const TableDeviations deviations{.model = model,
                                     .reported = values.reported,
                                     .covariance = covariance,
                                     .positions = values.positions,
                                     .u_deviation = scope.u_deviation,
                                     .draws = k_draws_of_a_plan};
    widen_ranges(stated, deviations);
    TableUncertainties u{.clear = stated.standard_uncertainty, .stated = {}};
    if (scope.widened) {
        widen_positioning(stated, deviations, is_stated);
    }
    u.stated = stated.standard_uncertainty;
    return u;
}

ExpectedParameters expected_parameters(const RotaryTableMeasurement& layout, const engine::StochasticModel& stochastic,
                                       const ParameterTargets& targets, double k, double coverage_probability) {
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    const engine::JointAdjustment adjustment = engine::planned_adjustment(layout, stochastic);
    const auto table = std::make_shared<engine::RotaryTableModel>(
        layout, adjustment, stochastic,
        engine::SourceDegreesOfFreedom{k_infinite, k_infinite, k_infinite, k_infinite, k_infinite});
    const TableParameterModel model(
        table, engine::transform_to_datum(layout, adjustment.poses(), adjustment.set_up(), layout.datum));

    ExpectedParameters expected;
    expected.u_deviation = model.rms_position_uncertainty();
    const double noise = expected.u_deviation * expected.u_deviation;
    const double scatter = noise + stochastic.variance_axial;
    expected.share_of_the_noise = scatter > 0.0 ? noise / scatter : 0.0;
    const bool scatter_stated = expected.share_of_the_noise <= k_largest_scatter_share * (1.0 + 1e-12);
    const MotionCovariances covariance =
        motion_covariances(engine::contributions_of(*table).covariance, layout.angles.size());
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.outputs().size()));
    Eigen::VectorXd squares = none;          // of all tables, for clear extremes of positioning
    Eigen::VectorXd squares_clear = none;    // of those whose extremes of positioning are looked at
    Eigen::VectorXd squares_widened = none;  // and as an evaluation states them
    const int widened = widened_tables(layout.angles.size());
    for (int number = 0; number < k_drawn_tables; ++number) {
        const TableUncertainties of = uncertainties_of_table(
            model, covariance, drawn_table(model, layout, std::sqrt(scatter), number),
            {.scatter_stated = scatter_stated, .u_deviation = expected.u_deviation, .widened = number < widened},
            coverage_probability);
        squares += of.clear.cwiseAbs2();
        if (number < widened) {
            squares_clear += of.clear.cwiseAbs2();
            squares_widened += of.stated.cwiseAbs2();
        }
    }
    const Eigen::VectorXd more =
        (squares_clear.array() > 0.0).select(squares_widened.array() / squares_clear.array(), 1.0).matrix();
    const Eigen::VectorXd u = (squares.cwiseProduct(more) / k_drawn_tables).cwiseSqrt();
    const engine::TableParameterLayout& places = model.parameters()->layout();
    const auto add = [&](Eigen::Index index, bool angular, const std::optional<double>& target) {
        expected.all.push_back({model.outputs()[static_cast<std::size_t>(index)].name, angular, k * u[index], target});
    };
    for (Eigen::Index c = 0; c < 6; ++c) {
        add(places.ranges + c, c >= 3, c < 3 ? targets.range_linear : targets.range_angular);
    }
    for (Eigen::Index c = 0; c < 4; ++c) {
        add(places.axis_line + c, c >= 2, c < 2 ? targets.location_linear : targets.location_angular);
    }
    add_positioning(*model.parameters(), u, scatter_stated, targets, k, expected);
    return expected;
}

}  // namespace gumcert::gum::plan
