// Redundancy, test values, minimal detectable biases and data snooping.
#include "engine/rotary_table/reliability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

CampaignPlan real_table() {
    CampaignPlan plan;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 5e-6 / 3.0;
    return plan;
}

/// An adjustment solved at given weights, with what reliability needs.
struct Solved {
    Solved(const Campaign& campaign, const StochasticModel& stochastic_model, std::vector<bool> active)
        : stochastic(stochastic_model),
          adjustment(campaign.measurement, std::move(active), rigid_motion(campaign.truth.set_up),
                     StartValues{campaign.truth.stations, campaign.truth.dead_paths}, stochastic) {
        EXPECT_TRUE(adjustment.adjustment().solve(SolverOptions{}).converged);
        adjustment.set_weights(stochastic);
        EXPECT_TRUE(adjustment.adjustment().refine(SolverOptions{}).converged);
        normal = adjustment.adjustment().linearise();
        covariance = normal.bordered_covariance();
    }

    [[nodiscard]] std::vector<DistanceReliability> rows(double non_centrality) const {
        return distance_reliability(adjustment, normal, covariance, stochastic, non_centrality);
    }

    /// tr(Q_v V⁻¹) of one group.
    [[nodiscard]] double redundancy(std::size_t group) const {
        const LinearisedGroup& linear = normal.groups()[group];
        const Eigen::MatrixXd local = covariance(linear.columns, linear.columns);
        return static_cast<double>(linear.residual.size()) -
               (linear.jacobian * local * linear.jacobian.transpose()).trace();
    }

    StochasticModel stochastic;
    JointAdjustment adjustment;
    NormalEquations normal;
    BorderedCovariance covariance;
};

StochasticModel weights(const CampaignPlan& plan) {
    return {1.0, plan.table_linear * plan.table_linear, plan.table_axial * plan.table_axial,
            plan.table_tilt * plan.table_tilt};
}

std::vector<bool> all(const Campaign& campaign) {
    return std::vector<bool>(campaign.measurement.lengths.size(), true);
}

TEST(Reliability, RedundancyNumbersSumToTheDegreesOfFreedom) {
    for (const bool correlated : {false, true}) {
        CampaignPlan plan = correlated ? real_table() : CampaignPlan{};
        plan.angles_deg = synthetic::full_turn(18);
        plan.missing_share = 0.05;
        plan.scale_model = ScaleModel::prior;
        plan.u_scale = 1e-7;
        plan.temperature_difference = 1.0;
        plan.u_temperature = 0.1;
        plan.expansion = 11.5e-6;
        plan.u_expansion = 1e-6;
        const Campaign campaign = simulate(plan);
        const Solved solved(campaign, weights(plan), all(campaign));
        const auto degrees = static_cast<double>(solved.normal.observation_count() - solved.normal.parameter_count());
        double groups = 0.0;
        double priors = 0.0;
        for (std::size_t g = 0; g < solved.normal.groups().size(); ++g) {
            const double r = solved.redundancy(g);
            groups += r;
            priors += g >= solved.adjustment.visits().size() ? r : 0.0;
        }
        EXPECT_NEAR(groups, degrees, 1e-6 * degrees) << (correlated ? "correlated" : "uncorrelated");
        double rows = priors;
        for (const DistanceReliability& row : solved.rows(4.13)) {
            rows += row.redundancy_number;
            if (!correlated) {
                EXPECT_GT(row.redundancy_number, 0.0);
                EXPECT_LT(row.redundancy_number, 1.0);
            }
        }
        EXPECT_NEAR(rows, degrees, 1e-6 * degrees) << (correlated ? "correlated" : "uncorrelated");
    }
}

TEST(Reliability, NumbersOfTheNote) {
    // rotary-table.md, 4d: distances 0.60 … 0.93, mean 0.810; CMM 0.52 … 0.82; minimal detectable bias 0.9 … 1.4 µm
    // with δ0 = 4.13 (0.1 %, 80 %).
    const CampaignPlan plan;
    const Campaign campaign = simulate(plan);
    const Solved solved(campaign, weights(plan), all(campaign));
    double smallest = 1.0, largest = 0.0, mean = 0.0, smallest_bias = 1.0, largest_bias = 0.0;
    for (const DistanceReliability& row : solved.rows(4.13)) {
        smallest = std::min(smallest, row.redundancy_number);
        largest = std::max(largest, row.redundancy_number);
        mean += row.redundancy_number / 1296.0;
        smallest_bias = std::min(smallest_bias, row.minimal_detectable_bias);
        largest_bias = std::max(largest_bias, row.minimal_detectable_bias);
    }
    EXPECT_NEAR(smallest, 0.60, 0.03);
    EXPECT_NEAR(largest, 0.93, 0.02);
    EXPECT_NEAR(mean, 0.810, 0.005);
    EXPECT_NEAR(smallest_bias, 0.9e-6, 0.1e-6);
    EXPECT_NEAR(largest_bias, 1.4e-6, 0.1e-6);
    // Coordinates of the CMM: 0.52 … 0.82, minimal detectable bias 1.9 … 2.3 µm.
    double sum = 0.0;
    for (const CoordinateReliability& row :
         fixture_reliability(solved.adjustment, solved.normal, solved.covariance, 4.13)) {
        EXPECT_GT(row.redundancy_number, 0.51);
        EXPECT_LT(row.redundancy_number, 0.83);
        EXPECT_GT(row.minimal_detectable_bias, 1.85e-6);
        EXPECT_LT(row.minimal_detectable_bias, 2.35e-6);
        sum += row.redundancy_number;
    }
    EXPECT_NEAR(sum, solved.redundancy(solved.adjustment.fixture_prior()), 1e-9);
    EXPECT_NEAR(sum, fixture_redundancy(solved.adjustment, solved.normal, solved.covariance), 1e-9);
}

TEST(Reliability, TestValueForUncorrelatedDistancesIsBaardas) {
    // w = v / (σ sqrt(r)) and δ0 σ / sqrt(r) (Baarda 1968) for a diagonal covariance.
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    const Campaign campaign = simulate(plan);
    const Solved solved(campaign, weights(plan), all(campaign));
    const auto rows = solved.rows(4.0);
    for (std::size_t v = 0; v < solved.adjustment.visits().size(); ++v) {
        const Eigen::VectorXd variance = solved.adjustment.stated_variance(v);
        const Eigen::VectorXd residual = solved.adjustment.adjustment().residual(v);
        const Visit& visit = solved.adjustment.visits()[v];
        for (std::size_t k = 0; k < visit.observations.size(); ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            const DistanceReliability& row = rows[visit.observations[k]];
            const double sigma = std::sqrt(variance[at]);
            EXPECT_NEAR(row.residual, -residual[at], 1e-15);
            EXPECT_NEAR(row.test_value, row.residual / (sigma * std::sqrt(row.redundancy_number)),
                        1e-6 * (1.0 + std::abs(row.test_value)));
            EXPECT_NEAR(row.minimal_detectable_bias / (4.0 * sigma / std::sqrt(row.redundancy_number)), 1.0, 1e-6);
        }
    }
}

TEST(Reliability, LeavingADistanceOutGivesTheTestValueThatItHadInside) {
    // Identity of least squares with known covariance: the deviation of a distance from the prediction of all others,
    // over its standard deviation, is its w inside the adjustment. Checks both branches against each other, with
    // repeatability (full blocks), reversal, temperature and both senses.
    CampaignPlan plan = real_table();
    plan.axis = RotaryAxis::b;
    plan.angles_deg = synthetic::full_turn(9);
    plan.both_senses = true;
    plan.reversal << 1e-6, -2e-6, 1.5e-6, 4e-6, -3e-6, 2e-6;
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    plan.scale_model = ScaleModel::prior;
    plan.u_scale = 1e-7;
    plan.temperature_difference = 1.0;
    plan.u_temperature = 0.1;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 1e-6;
    const Campaign campaign = simulate(plan);
    const Solved inside(campaign, weights(plan), all(campaign));
    const auto inside_rows = inside.rows(4.13);
    for (const std::size_t i :
         {std::size_t{0}, std::size_t{57}, std::size_t{200}, std::size_t{411}, std::size_t{640}}) {
        std::vector<bool> active = all(campaign);
        active[i] = false;
        const Solved outside(campaign, weights(plan), active);
        const DistanceReliability row = outside.rows(4.13)[i];
        EXPECT_TRUE(row.removed);
        EXPECT_NEAR(row.test_value, inside_rows[i].test_value, 1e-3 * (0.1 + std::abs(row.test_value)))
            << "distance " << i;
        EXPECT_NEAR(row.minimal_detectable_bias / inside_rows[i].minimal_detectable_bias, 1.0, 1e-3)
            << "distance " << i;
    }
}

TEST(Reliability, TestValuesOfGoodDataAreStandardNormal) {
    for (const bool correlated : {false, true}) {
        CampaignPlan plan = correlated ? real_table() : CampaignPlan{};
        plan.seed = 21;
        const Campaign campaign = simulate(plan);
        const Solved solved(campaign, weights(plan), all(campaign));
        double sum = 0.0;
        double squares = 0.0;
        double within = 0.0;
        const auto rows = solved.rows(4.13);
        for (const DistanceReliability& row : rows) {
            sum += row.test_value;
            squares += row.test_value * row.test_value;
            within += std::abs(row.test_value) < 1.96 ? 1.0 : 0.0;
        }
        const auto n = static_cast<double>(rows.size());
        EXPECT_NEAR(sum / n, 0.0, 0.1);
        EXPECT_NEAR(std::sqrt(squares / n), 1.0, 0.1);
        EXPECT_NEAR(within / n, 0.95, 0.02);
    }
}

/// 12 distances of 1296 wrong by 3 µm, everything else estimated.
Campaign with_outliers(const CampaignPlan& base, OutlierAction action, std::uint64_t seed) {
    CampaignPlan plan = base;
    plan.outliers = 12;
    plan.seed = seed;
    Campaign campaign = simulate(plan);
    campaign.measurement.outliers = {OutlierTest::data_snooping, 0.0001, action};
    campaign.measurement.estimate_length_noise = true;
    campaign.measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    return campaign;
}

void expect_found(const Campaign& campaign, const RotaryTableSolution& solution) {
    std::size_t false_alarms = 0;
    for (std::size_t i = 0; i < solution.reliability.size(); ++i) {
        const bool planted = std::binary_search(campaign.truth.outliers.begin(), campaign.truth.outliers.end(), i);
        if (planted) {
            EXPECT_TRUE(solution.reliability[i].flagged)
                << "distance " << i << ", test value " << solution.reliability[i].test_value;
        } else if (solution.reliability[i].flagged) {
            ++false_alarms;
        }
    }
    EXPECT_LE(static_cast<double>(false_alarms), 0.002 * static_cast<double>(solution.reliability.size()));
}

TEST(Reliability, PlantedOutliersAreFoundAndRemoved) {
    for (const std::uint64_t seed : {31U, 32U, 33U}) {
        const CampaignPlan base = seed == 33U ? real_table() : CampaignPlan{};
        const Campaign campaign = with_outliers(base, OutlierAction::remove, seed);
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        expect_found(campaign, solution);
        Eigen::Index removed = 0;
        for (const DistanceReliability& row : solution.reliability) {
            EXPECT_EQ(row.removed, row.flagged);
            removed += row.removed ? 1 : 0;
            if (row.removed) {
                EXPECT_EQ(row.redundancy_number, 1.0);
                EXPECT_GT(std::abs(row.test_value), 3.89);
                EXPECT_NEAR(std::abs(row.residual), 3e-6, 2e-6);
            } else {
                EXPECT_LT(std::abs(row.test_value), 3.8906);
            }
        }
        EXPECT_EQ(solution.observations, 1296 + 18 - removed);
        // What is left is honest: the outliers no longer inflate the length noise.
        EXPECT_LT(std::abs(solution.components[0].value - rms_length_noise(base, campaign)),
                  3.0 * solution.components[0].u);
        const Eigen::VectorXd normalised =
            (solution.values - campaign.true_values(false)).array() / solution.covariance.diagonal().array().sqrt();
        EXPECT_NEAR(std::sqrt(normalised.squaredNorm() / static_cast<double>(normalised.size())), 1.0, 0.3);
    }
}

TEST(Reliability, ReportFlagsButKeepsThem) {
    const Campaign campaign = with_outliers(CampaignPlan{}, OutlierAction::report, 31);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    expect_found(campaign, solution);
    EXPECT_EQ(solution.observations, 1296 + 18);
    for (const DistanceReliability& row : solution.reliability) {
        EXPECT_FALSE(row.removed);
        EXPECT_LT(row.redundancy_number, 1.0);
    }
    for (const OutlierFinding& finding : solution.outliers) {
        EXPECT_FALSE(finding.removed);
        EXPECT_EQ(solution.reliability[finding.length].flagged, !finding.came_back);
    }
    // Kept outliers are paid for: the estimated length noise is larger than what was simulated.
    EXPECT_GT(solution.components[0].value, 0.158e-6 + 3.0 * solution.components[0].u);
}

TEST(Reliability, WithoutTestNothingIsFlagged) {
    Campaign campaign = with_outliers(CampaignPlan{}, OutlierAction::remove, 31);
    campaign.measurement.outliers.test = OutlierTest::none;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_TRUE(std::none_of(solution.reliability.begin(), solution.reliability.end(),
                             [](const DistanceReliability& row) { return row.flagged || row.removed; }));
}

TEST(Reliability, GoodDataIsLeftAlone) {
    std::size_t flagged = 0;
    for (const std::uint64_t seed : {71U, 72U, 73U, 74U}) {
        CampaignPlan plan = real_table();
        plan.seed = seed;
        Campaign campaign = simulate(plan);
        campaign.measurement.outliers.test = OutlierTest::data_snooping;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        flagged += static_cast<std::size_t>(std::count_if(solution.reliability.begin(), solution.reliability.end(),
                                                          [](const DistanceReliability& row) { return row.flagged; }));
    }
    EXPECT_LE(flagged, 4U);  // 5184 distances at α = 0.0001: 0.5 expected
}

TEST(Reliability, OneAtATimeIsTheAdjustmentWithoutThem) {
    // Each step against an adjustment that was made anew, with correlated distances of one visit among those left out.
    CampaignPlan plan = real_table();
    plan.angles_deg = synthetic::full_turn(12);
    plan.missing_share = 0.05;
    const Campaign campaign = simulate(plan);
    const Solved solved(campaign, weights(plan), all(campaign));
    OneAtATime search(solved.adjustment, solved.normal, solved.covariance);
    std::vector<bool> active = all(campaign);
    for (int step = 0; step < 4; ++step) {
        const Solved anew(campaign, weights(plan), active);
        const auto rows = anew.rows(4.13);
        std::size_t expected = rows.size();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (active[i] &&
                (expected == rows.size() || std::abs(rows[i].test_value) > std::abs(rows[expected].test_value))) {
                expected = i;
            }
        }
        const auto suspect = search.largest(0.0);
        ASSERT_TRUE(suspect.has_value());
        EXPECT_EQ(suspect->length, expected);
        EXPECT_NEAR(suspect->test_value, rows[expected].test_value, 1e-3);  // second order of leaving out
        EXPECT_NEAR(suspect->redundancy_number, rows[expected].redundancy_number, 1e-4);
        EXPECT_NEAR(suspect->estimated_error / rows[expected].estimated_error, 1.0, 1e-3);
        EXPECT_FALSE(search.largest(std::abs(suspect->test_value) * 1.0001).has_value());
        // The largest, and one of the same visit, which the search is told of.
        for (const Visit& visit : anew.adjustment.visits()) {
            if (std::find(visit.observations.begin(), visit.observations.end(), expected) != visit.observations.end()) {
                const std::size_t neighbour =
                    visit.observations[0] == expected ? visit.observations[1] : visit.observations[0];
                search.leave_out(expected);
                search.leave_out(neighbour);
                active[expected] = false;
                active[neighbour] = false;
            }
        }
    }
}

TEST(Reliability, EstimatedErrorIsWhatWasPlanted) {
    CampaignPlan plan = real_table();
    plan.angles_deg = synthetic::full_turn(12);
    Campaign campaign = simulate(plan);
    const Solved before(campaign, weights(plan), all(campaign));
    const auto rows_before = before.rows(4.13);
    for (const std::size_t i : {std::size_t{17}, std::size_t{200}}) {
        Campaign wrong = campaign;
        wrong.measurement.lengths[i].length += 4e-6;
        const Solved after(wrong, weights(plan), all(wrong));
        EXPECT_NEAR(after.rows(4.13)[i].estimated_error - rows_before[i].estimated_error, 4e-6, 1e-10);
        std::vector<bool> active = all(wrong);
        active[i] = false;
        const Solved without(wrong, weights(plan), active);
        EXPECT_NEAR(without.rows(4.13)[i].estimated_error, after.rows(4.13)[i].estimated_error, 1e-10);
    }
}

TEST(Reliability, ExternalReliabilityIsTheLargestChangeByAnUndetectedBias) {
    CampaignPlan plan = real_table();
    plan.angles_deg = synthetic::full_turn(4);
    plan.datum = Datum::home;
    Campaign campaign = simulate(plan);
    campaign.measurement.table_repeatability.mode = RepeatabilityMode::given;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    // Nothing moves what the datum fixes: six zeros at home.
    ASSERT_EQ(solution.external_reliability.size(), static_cast<std::size_t>(solution.values.size()) - 6);
    Eigen::MatrixXd change(solution.values.size(), campaign.measurement.lengths.size());
    for (std::size_t i = 0; i < campaign.measurement.lengths.size(); ++i) {
        Campaign wrong = campaign;
        wrong.measurement.lengths[i].length += solution.reliability[i].minimal_detectable_bias;
        change.col(static_cast<Eigen::Index>(i)) =
            evaluate_jointly(wrong.measurement, EvaluationOptions{}).values - solution.values;
    }
    for (const ExternalReliability& row : solution.external_reliability) {
        const auto q = static_cast<Eigen::Index>(row.quantity);
        EXPECT_NEAR(change(q, static_cast<Eigen::Index>(row.length)) / row.influence, 1.0, 2e-3) << row.quantity;
        EXPECT_NEAR(change.row(q).cwiseAbs().maxCoeff() / std::abs(row.influence), 1.0, 2e-3) << row.quantity;
    }
}

TEST(Reliability, TauIsPopes) {
    // Quantiles of Student's t and of the beta distribution (tau²/nu is beta with 1/2 and (nu - 1)/2) by SciPy 1.10.1,
    // two-sided 0.0001.
    EXPECT_NEAR(tau_critical_value(6.593682585486598, 10.0), 2.8783591676609492, 1e-9);
    EXPECT_NEAR(tau_critical_value(4.055041309114334, 100.0), 3.7740774079924417, 1e-9);
    EXPECT_NEAR(tau_critical_value(3.912546063357392, 719.5), 3.874214272888896, 1e-9);
}

TEST(Reliability, EstimatedLengthNoiseIsTestedWithTau) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    Campaign campaign = simulate(plan);
    campaign.measurement.outliers.test = OutlierTest::data_snooping;
    campaign.measurement.estimate_length_noise = true;
    EvaluationOptions options;
    std::vector<double> asked;
    options.student_critical_value = [&asked](double degrees_of_freedom) {
        asked.push_back(degrees_of_freedom);
        return 4.0;
    };
    const RotaryTableSolution estimated = evaluate_jointly(campaign.measurement, options);
    const double nu = estimated.components[length_noise].redundancy;
    ASSERT_TRUE(estimated.critical_value_degrees_of_freedom.has_value());
    EXPECT_NEAR(*estimated.critical_value_degrees_of_freedom / nu, 1.0, 1e-4);
    EXPECT_NEAR(asked.back(), nu - 1.0, 1e-3 * nu);
    EXPECT_NEAR(estimated.critical_value, std::sqrt(nu) * 4.0 / std::sqrt(nu - 1.0 + 16.0), 1e-6);
    EXPECT_NEAR(estimated.non_centrality - options.non_centrality, estimated.critical_value - options.critical_value,
                1e-12);
    campaign.measurement.estimate_length_noise = false;
    const RotaryTableSolution given = evaluate_jointly(campaign.measurement, options);
    EXPECT_FALSE(given.critical_value_degrees_of_freedom.has_value());
    EXPECT_EQ(given.critical_value, options.critical_value);
    EXPECT_EQ(given.variance_basis, VarianceBasis::stated);
}

TEST(Reliability, LogTellsWhatWasFoundInWhichOrderAndWhy) {
    Campaign campaign = with_outliers(CampaignPlan{}, OutlierAction::remove, 31);
    std::size_t gross = 600;
    while (std::binary_search(campaign.truth.outliers.begin(), campaign.truth.outliers.end(), gross)) {
        ++gross;
    }
    campaign.measurement.lengths[gross].length += 0.08;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    ASSERT_GE(solution.outliers.size(), 13U);
    EXPECT_EQ(solution.outliers[0].length, gross);
    EXPECT_EQ(solution.outliers[0].reason, OutlierReason::gross_error);
    EXPECT_NEAR(solution.outliers[0].estimated_error, 0.08, 1e-6);
    EXPECT_TRUE(solution.outliers[0].removed);
    EXPECT_FALSE(solution.outliers[0].came_back);
    std::vector<bool> removed(solution.reliability.size(), false);
    for (const OutlierFinding& finding : solution.outliers) {
        EXPECT_NE(finding.removed, finding.came_back);
        removed[finding.length] = removed[finding.length] || finding.removed;
        if (finding.reason == OutlierReason::data_snooping) {
            EXPECT_GT(std::abs(finding.test_value), finding.critical_value);
            EXPECT_GT(finding.redundancy_number, 0.0);
            EXPECT_LE(finding.redundancy_number, 1.0);
            EXPECT_LT(finding.test_value * finding.estimated_error, 0.0);  // w has the sign of adjusted - observed
            EXPECT_NEAR(std::abs(finding.estimated_error), 3e-6, 2e-6);
        }
    }
    for (std::size_t i = 0; i < removed.size(); ++i) {
        EXPECT_EQ(removed[i], solution.reliability[i].removed);
    }
    EXPECT_FALSE(std::any_of(solution.notes.begin(), solution.notes.end(),
                             [](const gum::Diagnostic& note) { return note.code.starts_with("GC-OUTLIER"); }));
}

TEST(Reliability, TwentyCampaignsAllFoundAndFewGoodOnesFlagged) {
    std::size_t good = 0;
    std::size_t false_alarms = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        CampaignPlan plan = seed % 2 == 0 ? CampaignPlan{} : real_table();
        plan.axis = std::array{RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}[seed % 3];
        plan.angles_deg = synthetic::full_turn(24);
        plan.outlier_size = (3.0 + static_cast<double>(seed % 4)) * 1e-6;
        const Campaign campaign = with_outliers(plan, OutlierAction::remove, 8000 + seed);
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        for (std::size_t i = 0; i < solution.reliability.size(); ++i) {
            if (std::binary_search(campaign.truth.outliers.begin(), campaign.truth.outliers.end(), i)) {
                EXPECT_TRUE(solution.reliability[i].removed) << "seed " << seed << ", distance " << i;
            } else {
                ++good;
                false_alarms += solution.reliability[i].flagged ? 1U : 0U;
            }
        }
    }
    EXPECT_LE(static_cast<double>(false_alarms), 0.002 * static_cast<double>(good));
}

TEST(Reliability, ManyOutliersOfManySizesInALongMeasurement) {
    CampaignPlan plan = real_table();
    plan.both_senses = true;
    plan.outliers = 60;
    plan.seed = 4;
    Campaign campaign = simulate(plan);
    for (std::size_t k = 0; k < campaign.truth.outliers.size(); k += 4) {
        LengthObservation& length = campaign.measurement.lengths[campaign.truth.outliers[k]];
        length.length += (k % 8 == 0 ? 1.0 : -1.0) * 1e-5 * std::pow(10.0, static_cast<double>(k / 4 % 4));
    }
    campaign.measurement.outliers = {OutlierTest::data_snooping, 0.0001, OutlierAction::remove};
    campaign.measurement.estimate_length_noise = true;
    campaign.measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    ASSERT_EQ(solution.reliability.size(), 2592U);
    expect_found(campaign, solution);
    // The largest first.
    EXPECT_GT(std::abs(solution.outliers.front().estimated_error), 0.009);
}

TEST(Reliability, WrongCoordinateOfTheFixtureIsNamed) {
    CampaignPlan plan;
    plan.seed = 6;
    Campaign campaign = simulate(plan);
    campaign.measurement.outliers.test = OutlierTest::data_snooping;
    campaign.measurement.fixture(2, 1) += 8e-6;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    ASSERT_EQ(solution.fixture_reliability.size(), 18U);
    std::size_t largest = 0;
    for (std::size_t k = 0; k < 18; ++k) {
        if (std::abs(solution.fixture_reliability[k].test_value) >
            std::abs(solution.fixture_reliability[largest].test_value)) {
            largest = k;
        }
    }
    EXPECT_EQ(largest, 7U);
    EXPECT_NEAR(solution.fixture_reliability[7].estimated_error, 8e-6, 2e-6);
    EXPECT_TRUE(std::any_of(solution.notes.begin(), solution.notes.end(), [](const gum::Diagnostic& note) {
        return note.code == "GC-OUTLIER-0003" && note.where == "fixture, reflector R3, y";
    }));
}

TEST(Reliability, UncertaintyStatedMuchTooSmallIsNotTakenForOutliersInSilence) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.seed = 13;
    Campaign campaign = simulate(plan);
    campaign.measurement.length_uncertainty.u_constant /= 3.0;
    campaign.measurement.length_uncertainty.u_proportional /= 3.0;
    campaign.measurement.outliers.test = OutlierTest::data_snooping;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_TRUE(std::any_of(solution.notes.begin(), solution.notes.end(),
                            [](const gum::Diagnostic& note) { return note.code == "GC-OUTLIER-0001"; }));
}

}  // namespace
}  // namespace gumcert::engine
