// A repeatability that is given and that the distances refute is told, whatever else it makes suspicious.
#include "engine/rotary_table/evaluation/repeatability_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "gum/quantity/units.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

double above_of_repeatability(double value, double degrees_of_freedom) {
    return boost::math::cdf(boost::math::complement(boost::math::chi_squared_distribution<double>(degrees_of_freedom),
                                                    std::max(value, 0.0)));
}

double fisher_above_of_repeatability(double value, double above, double below) {
    if (std::isinf(below)) {
        return above_of_repeatability(above * value, above);
    }
    return boost::math::cdf(boost::math::complement(boost::math::fisher_f_distribution<double>(above, below), value));
}

constexpr double k_linear = 0.3e-6;
constexpr double k_angular = 2e-6;

CampaignPlan repeating(std::uint64_t seed, bool both_senses = false) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(both_senses ? 12 : 18);
    plan.both_senses = both_senses;
    plan.runs = both_senses ? 1 : 2;
    plan.stations.resize(4);
    plan.table_linear = k_linear;
    plan.table_axial = plan.table_tilt = k_angular;
    plan.start_values = true;
    plan.seed = seed;
    return plan;
}

RotaryTableSolution evaluated_as_given(RotaryTableMeasurement measurement, double linear, double axial, double tilt) {
    TableRepeatability& given = measurement.table_repeatability;  // where it acts is right
    given.mode = linear + axial + tilt > 0.0 ? RepeatabilityMode::given : RepeatabilityMode::none;
    given.u_linear = linear * k_linear;
    given.u_axial = axial * k_angular;
    given.u_tilt = tilt * k_angular;
    EvaluationOptions options;
    options.chi_square_upper_tail = above_of_repeatability;
    options.fisher_upper_tail = fisher_above_of_repeatability;
    return evaluate_jointly(measurement, options);
}

std::vector<std::string> notes_of(const RotaryTableSolution& solution, const std::string& code) {
    std::vector<std::string> found;
    for (const gum::Diagnostic& note : solution.notes) {
        if (note.code == code) {
            found.push_back(note.where);
        }
    }
    return found;
}

TEST(RepeatabilityCheck, SaysNothingOfARepeatabilityThatIsRight) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Campaign campaign = synthetic::simulate(repeating(seed, seed % 2 == 0));
        for (const double factor : {1.0, 0.9, 1.2}) {  // one digit of what is stated
            const RotaryTableSolution solution = evaluated_as_given(campaign.measurement, factor, factor, factor);
            EXPECT_TRUE(notes_of(solution, k_repeatability_too_small).empty()) << seed << ", " << factor;
            EXPECT_TRUE(notes_of(solution, k_repeatability_too_large).empty()) << seed << ", " << factor;
        }
    }
}

TEST(RepeatabilityCheck, NamesWhatIsTooSmallAndNothingElse) {
    const Campaign campaign = synthetic::simulate(repeating(1));
    for (const double factor : {0.4, 0.1}) {
        const RotaryTableSolution solution = evaluated_as_given(campaign.measurement, factor, factor, factor);
        EXPECT_FALSE(notes_of(solution, k_repeatability_too_small).empty()) << factor;
        EXPECT_TRUE(notes_of(solution, "GC-GROUP-0001").empty()) << factor;
    }
    EXPECT_EQ(notes_of(evaluated_as_given(campaign.measurement, 0.2, 1.0, 1.0), k_repeatability_too_small),
              std::vector<std::string>{"variance components, table linear"});
    EXPECT_FALSE(notes_of(evaluated_as_given(campaign.measurement, 0.0, 0.0, 0.0), k_repeatability_too_small).empty())
        << "a table that is said to come back perfectly";
    const RotaryTableSolution solution = evaluated_as_given(campaign.measurement, 5.0, 5.0, 5.0);
    EXPECT_FALSE(notes_of(solution, k_repeatability_too_large).empty());
    EXPECT_TRUE(notes_of(solution, k_repeatability_too_small).empty());
}

// One step from weights that are wrong in one component points to the wrong side of another one; and what is left where good
// distances were left out scatters less than the table.
TEST(RepeatabilityCheck, SaysWhatTheDistancesGive) {
    const Campaign campaign = synthetic::simulate(repeating(1));
    const double number_of_estimate = 0.25;  // of 18 angles in two passes
    for (const std::array<double, 3>& factors :
         {std::array{0.003, 0.25, 0.001}, std::array{0.003, 2.0, 0.001}, std::array{0.0, 0.0, 0.0},
          std::array{3.0, 0.1, 1.0}, std::array{0.1, 3.0, 0.1}}) {
        const RotaryTableSolution solution =
            evaluated_as_given(campaign.measurement, factors[0], factors[1], factors[2]);
        std::size_t told = 0;
        for (const gum::Diagnostic& note : solution.notes) {
            const bool too_small = note.code == k_repeatability_too_small;
            if (!too_small && note.code != k_repeatability_too_large) {
                continue;
            }
            ++told;
            const std::size_t row = note.where.ends_with("linear") ? 0 : note.where.ends_with("axial") ? 1 : 2;
            const std::string before = "the distances give a repeatability of the table of ";
            const double stated = std::stod(note.what.substr(before.size()));
            const double unit = row == 0 ? k_linear / gum::k_micrometre : k_angular / gum::k_arcsecond;
            EXPECT_NEAR(stated / unit, 1.0, number_of_estimate) << note.what;
            EXPECT_EQ(too_small, stated > factors[row] * unit) << note.what;
        }
        EXPECT_GT(told, 0U) << factors[0];
    }
}

// The differences of both senses scatter with the table: a repeatability that is given too small made them a reversal of each
// angle, which hid the scatter.
TEST(RepeatabilityCheck, AReversalIsNotTakenForOneOfEachAngle) {
    for (const std::uint64_t seed : {1U, 2U}) {
        const Campaign campaign = synthetic::simulate(repeating(seed, true));
        const RotaryTableSolution solution = evaluated_as_given(campaign.measurement, 0.1, 0.1, 0.1);
        EXPECT_EQ(solution.reversal_model, ReversalModel::constant) << seed;
        EXPECT_FALSE(notes_of(solution, k_repeatability_too_small).empty()) << seed;
    }
    CampaignPlan plan = repeating(7, true);
    plan.reversal_second[0] = 3e-6;
    const RotaryTableSolution solution = evaluated_as_given(synthetic::simulate(plan).measurement, 1.0, 1.0, 1.0);
    EXPECT_EQ(solution.reversal_model, ReversalModel::by_angle);
    EXPECT_TRUE(notes_of(solution, k_repeatability_too_small).empty());
}

// What makes visits scatter may be a blunder: then that is told, and a right repeatability is not accused.
TEST(RepeatabilityCheck, ABlunderIsNotTakenForTheTable) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        Campaign campaign = synthetic::simulate(repeating(seed));
        for (LengthObservation& length : campaign.measurement.lengths) {
            if (length.station == 1 && length.pass % 2 == 1 && length.angle > 8) {
                length.length += 8e-6;  // an interrupted beam
            }
        }
        const RotaryTableSolution solution = evaluated_as_given(campaign.measurement, 1.0, 1.0, 1.0);
        EXPECT_FALSE(notes_of(solution, "GC-GROUP-0001").empty()) << seed;
        EXPECT_TRUE(notes_of(solution, k_repeatability_too_small).empty()) << seed;
    }
}

// The size of a blunder is an estimate: a hundredth of a large one scatters more than the table, which was told for it. And where
// whole visits were left out as outlying, the group was taken away from other visits than its own.
TEST(RepeatabilityCheck, ALargeBlunderLeavesTheTableInPeace) {
    for (const bool snooping : {false, true}) {
        for (const double error : {8e-6, 25e-6}) {
            CampaignPlan plan = repeating(3);
            plan.runs = 1;
            Campaign campaign = synthetic::simulate(plan);
            if (snooping) {
                campaign.measurement.outliers = {OutlierTest::data_snooping, 1e-4, OutlierAction::remove};
            }
            for (LengthObservation& length : campaign.measurement.lengths) {
                if (length.station == 1) {  // it drifts
                    length.length += error * (static_cast<double>(length.angle) / 17.0 - 0.5);
                }
            }
            const RotaryTableSolution solution = evaluated_as_given(campaign.measurement, 1.0, 1.0, 1.0);
            EXPECT_FALSE(notes_of(solution, "GC-GROUP-0001").empty()) << error;
            EXPECT_TRUE(notes_of(solution, k_repeatability_too_small).empty()) << error << ", " << snooping;
        }
    }
}

// Of few stations a large interruption moves most visits: their robust scale hid it, and "successive visits deviate alike" was told.
TEST(RepeatabilityCheck, AnInterruptedBeamIsToldAtGivenWeights) {
    constexpr double k_interruption = 20e-6;
    CampaignPlan plan = repeating(5);
    plan.runs = 1;
    plan.angles_deg = synthetic::full_turn(24);
    plan.stations = CampaignPlan{}.stations;
    plan.stations.resize(5);
    plan.table_linear = 0.5 * k_linear;
    Campaign campaign = synthetic::simulate(plan);
    campaign.measurement.outliers = {OutlierTest::data_snooping, 1e-4, OutlierAction::remove};
    for (LengthObservation& length : campaign.measurement.lengths) {
        if (length.station == 2 && length.angle > 12) {
            length.length += k_interruption;
        }
    }
    const RotaryTableSolution solution = evaluated_as_given(campaign.measurement, 0.5, 1.0, 1.0);
    ASSERT_TRUE(solution.groups);
    const GroupTest& first = solution.groups->tests.front();
    EXPECT_TRUE(first.suspicious);
    EXPECT_EQ(first.kind, GroupKind::dead_path_change);
    EXPECT_NEAR(first.estimate / k_interruption, 1.0, 0.1);
    EXPECT_TRUE(notes_of(solution, k_repeatability_too_small).empty());
}

// A step from what is given may come to many times of it by chance where the distances hardly determine a component.
TEST(RepeatabilityCheck, AComponentThatIsHardlyDeterminedIsRefutedByNothing) {
    VarianceComponentStep step;
    for (std::size_t k = 0; k < 5; ++k) {
        VarianceComponent component;
        component.estimated = true;
        component.value = k == table_linear ? 4e-7 : 1e-6;
        step.components.push_back(component);
        step.expected_spread.push_back(k == table_linear ? 1e-13 : 2e-13);
        step.form_degrees_of_freedom.push_back(20.0);
    }
    TableRepeatability given{RepeatabilityMode::given, 1e-7, 1e-6, 1e-6};
    EXPECT_TRUE(refuted_repeatability(step, given, above_of_repeatability).empty()) << "1.5 standard deviations";
    step.expected_spread[table_linear] = 2.5e-14;
    const auto refuted = refuted_repeatability(step, given, above_of_repeatability);
    ASSERT_EQ(refuted.size(), 1U);
    EXPECT_EQ(refuted[0].row, table_linear);
    EXPECT_TRUE(refuted[0].larger);
    const gum::Diagnostic note = repeatability_note(refuted[0], 4e-7);
    EXPECT_EQ(note.what.find("the distances give a repeatability of the table of 0.4 µm, and 0.1 µm is given"), 0U)
        << note.what;
    given.mode = RepeatabilityMode::estimate;
    EXPECT_TRUE(refuted_repeatability(step, given, above_of_repeatability).empty());
}

}  // namespace
}  // namespace gumcert::engine
