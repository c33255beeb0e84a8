#include "gum/rotary_table/widened_extremes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gum/rotary_table/evaluate_rotary_table.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::gum {
namespace {

constexpr std::size_t k_twelve = 12;

/// A table that scatters by much more than the measurement, so that R and A are stated.
const RotaryTableResult& evaluated_table() {
    static const RotaryTableResult result = [] {
        engine::synthetic::CampaignPlan plan;
        plan.angles_deg = engine::synthetic::full_turn(k_twelve);
        plan.start_values = true;
        plan.table_linear = 0.05e-6;
        plan.table_tilt = 0.2e-6;
        plan.table_axial = 4e-6;
        RotaryTableRequest request;
        request.measurement = engine::synthetic::simulate(plan).measurement;
        return evaluate_rotary_table(request, 1);
    }();
    return result;
}

struct Widened {
    Propagation law;
    UncertaintyBudget stated;
};

Widened widened(const Eigen::VectorXd& reported, bool positioning) {
    const RotaryTableResult& table = evaluated_table();
    Widened both;
    both.law = propagate(*table.parameter_model, 0.9545);
    both.stated = both.law;
    const MotionCovariances covariances = motion_covariances(table.reported.covariance, k_twelve);
    const TableDeviations of{.model = *table.parameter_model,
                             .reported = reported,
                             .covariance = covariances,
                             .positions = table.parameter_model->nominal_positions(),
                             .u_deviation = table.positioning.u_deviation};
    widen_ranges(both.stated, of);
    if (positioning) {
        widen_positioning(both.stated, of, [](const std::string& name) { return name == "A_up"; });
    }
    return both;
}

TEST(WidenedExtremes, OfClearOnesAreThoseOfTheLaw) {
    Eigen::VectorXd reported = evaluated_table().reported.budget.value;
    for (Eigen::Index motion = 0; motion < 6; ++motion) {
        for (Eigen::Index angle = 0; angle < 12; ++angle) {
            reported[6 * angle + motion] = angle == 3 ? 1e-3 : angle == 7 ? -1e-3 : 0.0;
        }
    }
    // The law at the estimates has other angles as extremes: only whether they are clear is asked here.
    const Widened clear = widened(reported, false);
    EXPECT_EQ(clear.stated.standard_uncertainty, clear.law.standard_uncertainty);
    EXPECT_EQ(clear.stated.budget.size(), clear.law.budget.size());
}

TEST(WidenedExtremes, OfEqualOnesAreLarger) {
    Eigen::VectorXd reported = evaluated_table().reported.budget.value;
    reported.head(72).setZero();
    const Widened equal = widened(reported, false);
    for (Eigen::Index range = 0; range < 6; ++range) {
        EXPECT_GT(equal.stated.standard_uncertainty[range], 1.2 * equal.law.standard_uncertainty[range]) << range;
    }
    for (Eigen::Index other = 6; other < equal.law.value.size(); ++other) {
        EXPECT_EQ(equal.stated.standard_uncertainty[other], equal.law.standard_uncertainty[other]) << other;
    }
    EXPECT_EQ(equal.stated.budget.back().name, k_which_are_extreme);
}

// Of what is asked for, and as an evaluation states it.
TEST(WidenedExtremes, OfPositioningAreThoseOfAnEvaluation) {
    const RotaryTableResult& table = evaluated_table();
    const Widened found = widened(table.reported.budget.value, true);
    const engine::TableParameters& parameters = *table.parameter_model->parameters();
    bool any = false;
    for (std::size_t i = 0; i < parameters.short_names().size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        const bool asked = at < 6 || parameters.short_names()[i] == "A_up";
        EXPECT_EQ(found.stated.standard_uncertainty[at],
                  asked ? table.parameters.standard_uncertainty[at] : found.law.standard_uncertainty[at])
            << parameters.short_names()[i];
        any = any || (at >= 6 && asked && found.stated.standard_uncertainty[at] > found.law.standard_uncertainty[at]);
    }
    EXPECT_TRUE(any) << "A_up of runs that scatter is not clear";
}

}  // namespace
}  // namespace gumcert::gum
