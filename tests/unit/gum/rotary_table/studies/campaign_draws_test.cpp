#include "gum/rotary_table/studies/campaign_draws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "tests/support/planned_layout.h"

namespace gumcert::gum {
namespace {

using engine::RotaryTableMeasurement;
using engine::TableRepeatability;

constexpr TableRepeatability k_perfect{engine::RepeatabilityMode::none, 0.0, 0.0, 0.0};

RotaryTableMeasurement drawn_layout(engine::RotaryAxis axis = engine::RotaryAxis::a) {
    engine::synthetic::CampaignPlan plan;
    plan.axis = axis;
    plan.angles_deg = engine::synthetic::full_turn(6);
    plan.home = 2;
    return engine::planned::layout_of(plan);
}

/// Nothing is uncertain but what a test adds.
RotaryTableMeasurement certain_layout() {
    RotaryTableMeasurement layout = drawn_layout();
    layout.fixture_covariance.setZero();
    layout.length_uncertainty = {};
    return layout;
}

/// Lengths of one campaign minus those of another.
Eigen::VectorXd length_differences(const CampaignDraws::Campaign& one, const CampaignDraws::Campaign& other) {
    Eigen::VectorXd difference(static_cast<Eigen::Index>(one.measurement.lengths.size()));
    for (Eigen::Index i = 0; i < difference.size(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        difference[i] = one.measurement.lengths[at].length - other.measurement.lengths[at].length;
    }
    return difference;
}

TEST(DrawsOfCampaigns, TruthIsWithinWhatIsAskedFor) {
    SimulationRequest request;
    request.error_linear = 3e-6;
    request.error_angular = 7e-6;
    request.set_up_offset = 40e-6;
    request.set_up_tilt = 90e-6;
    const RotaryTableMeasurement layout = drawn_layout(engine::RotaryAxis::b);
    const CampaignDraws draws(layout, request, k_perfect, 1, 0);
    double largest_linear = 0.0;
    double largest_angular = 0.0;
    for (std::uint64_t run = 0; run < 20; ++run) {
        const engine::CampaignTruth truth = draws.exact_truth(run);
        ASSERT_EQ(truth.errors.cols(), 6);
        EXPECT_EQ(truth.errors.col(2).cwiseAbs().maxCoeff(), 0.0) << "home";
        largest_linear = std::max(largest_linear, truth.errors.topRows(3).cwiseAbs().maxCoeff());
        largest_angular = std::max(largest_angular, truth.errors.bottomRows(3).cwiseAbs().maxCoeff());
        engine::synthetic::Vector6 set_up;
        set_up << 40e-6, 0.0, 40e-6, 90e-6, 0.0, 90e-6;  // nothing along the axis of B
        EXPECT_EQ(truth.set_up, set_up);
        for (std::size_t j = 0; j < layout.stations.size(); ++j) {
            EXPECT_LE((truth.stations[j] - *layout.station_start[j]).cwiseAbs().maxCoeff(), 0.01 + 1e-12);
            EXPECT_GT((truth.stations[j] - *layout.station_start[j]).norm(), 0.0);
        }
        EXPECT_GE(truth.dead_paths.minCoeff(), 0.15);
        EXPECT_LE(truth.dead_paths.maxCoeff(), 0.25);
        EXPECT_EQ(truth.fixture, layout.fixture);
        EXPECT_EQ(truth.scale_deviation.cwiseAbs().maxCoeff(), 0.0);
    }
    // Of 300 uniform numbers the largest is within 5 % of the bound, unless with a probability of 2e-7.
    EXPECT_LE(largest_linear, request.error_linear);
    EXPECT_GT(largest_linear, 0.95 * request.error_linear);
    EXPECT_LE(largest_angular, request.error_angular);
    EXPECT_GT(largest_angular, 0.95 * request.error_angular);
}

TEST(DrawsOfCampaigns, WithoutNoiseLengthsAreThoseOfTheTruth) {
    RotaryTableMeasurement layout = drawn_layout();
    layout.estimate_length_noise = true;
    layout.table_repeatability.mode = engine::RepeatabilityMode::estimate;
    layout.outliers.test = engine::OutlierTest::data_snooping;
    layout.length_uncertainty.resolution = 1e-6;
    SimulationRequest request;
    request.outliers = 3;
    const CampaignDraws draws(layout, request, {engine::RepeatabilityMode::given, 1e-6, 1e-6, 1e-6}, 5, 0);
    const CampaignDraws::Campaign exact = draws.campaign(4, false);
    for (const engine::LengthObservation& length : exact.measurement.lengths) {
        const Eigen::Vector3d point = engine::synthetic::point_in_table(
            layout.axis, layout.angles[length.angle] - layout.angles[layout.home],
            exact.truth.errors.col(static_cast<Eigen::Index>(length.angle)), exact.truth.set_up,
            layout.fixture.row(static_cast<Eigen::Index>(length.reflector)).transpose());
        const double expected = (point - exact.truth.stations[length.station]).norm() -
                                exact.truth.dead_paths[static_cast<Eigen::Index>(length.dead_path)];
        EXPECT_NEAR(length.length, expected, 4e-15);
    }
    EXPECT_THAT(exact.planted, testing::IsEmpty());
    // There is no noise to estimate, and nothing to find.
    EXPECT_FALSE(exact.measurement.estimate_length_noise);
    EXPECT_EQ(exact.measurement.table_repeatability.mode, engine::RepeatabilityMode::none);
    EXPECT_EQ(exact.measurement.outliers.test, engine::OutlierTest::none);
    EXPECT_EQ(exact.measurement.fixture_component, engine::FixtureComponent::given);
    const RotaryTableMeasurement noisy = draws.campaign(4, true).measurement;
    EXPECT_TRUE(noisy.estimate_length_noise);
    EXPECT_EQ(noisy.table_repeatability.mode, engine::RepeatabilityMode::estimate);
    EXPECT_EQ(noisy.outliers.test, engine::OutlierTest::data_snooping);
}

TEST(DrawsOfCampaigns, WithNothingUncertainNoiseIsNone) {
    const CampaignDraws draws(certain_layout(), {}, k_perfect, 5, 0);
    const CampaignDraws::Campaign noisy = draws.campaign(1, true);
    EXPECT_EQ(length_differences(noisy, draws.campaign(1, false)).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(noisy.truth.errors, draws.exact_truth(1).errors);
}

TEST(DrawsOfCampaigns, OutliersAreAddedToDistancesOfTheirOwn) {
    SimulationRequest request;
    request.outlier_size = 5e-6;
    const RotaryTableMeasurement layout = drawn_layout();
    const CampaignDraws good(layout, request, k_perfect, 9, 0);
    request.outliers = 7;
    const CampaignDraws bad(layout, request, k_perfect, 9, 0);
    std::set<std::size_t> places;
    int positive = 0;
    for (std::uint64_t run = 0; run < 10; ++run) {
        const CampaignDraws::Campaign campaign = bad.campaign(run, true);
        ASSERT_EQ(campaign.planted.size(), 7U);
        EXPECT_EQ(std::adjacent_find(campaign.planted.begin(), campaign.planted.end(), std::greater_equal<>()),
                  campaign.planted.end());
        const Eigen::VectorXd added = length_differences(campaign, good.campaign(run, true));
        for (Eigen::Index i = 0; i < added.size(); ++i) {
            const bool planted =
                std::binary_search(campaign.planted.begin(), campaign.planted.end(), static_cast<std::size_t>(i));
            EXPECT_NEAR(std::abs(added[i]), planted ? 5e-6 : 0.0, 1e-15) << i;
            positive += added[i] > 1e-6 ? 1 : 0;
        }
        places.insert(campaign.planted.begin(), campaign.planted.end());
    }
    EXPECT_GT(places.size(), 40U) << "every campaign has them elsewhere";
    EXPECT_NEAR(positive, 35, 4 * std::sqrt(70.0) / 2.0) << "in either sense";
}

TEST(DrawsOfCampaigns, ThereAreNoMoreOutliersThanDistances) {
    SimulationRequest request;
    request.outliers = 100'000;
    const RotaryTableMeasurement layout = drawn_layout();
    const std::vector<std::size_t> planted = CampaignDraws(layout, request, k_perfect, 9, 0).campaign(0, true).planted;
    ASSERT_EQ(planted.size(), layout.lengths.size());
    for (std::size_t i = 0; i < planted.size(); ++i) {
        EXPECT_EQ(planted[i], i);
    }
}

TEST(DrawsOfCampaigns, StudiesAndSeedsAreIndependent) {
    const RotaryTableMeasurement layout = drawn_layout();
    const Eigen::MatrixXd first = CampaignDraws(layout, {}, k_perfect, 1, 0).exact_truth(0).errors;
    EXPECT_EQ(CampaignDraws(layout, {}, k_perfect, 1, 0).exact_truth(0).errors, first);
    EXPECT_NE(CampaignDraws(layout, {}, k_perfect, 1, 1).exact_truth(0).errors, first);
    EXPECT_NE(CampaignDraws(layout, {}, k_perfect, 2, 0).exact_truth(0).errors, first);
}

TEST(DrawsOfCampaigns, NoiseOfALengthIsAsLargeAsStated) {
    RotaryTableMeasurement layout = certain_layout();
    layout.length_uncertainty.u_constant = 0.2e-6;
    layout.length_uncertainty.u_proportional = 0.3e-6;
    const CampaignDraws draws(layout, {}, k_perfect, 3, 0);
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (std::uint64_t run = 0; run < 5; ++run) {
        const CampaignDraws::Campaign exact = draws.campaign(run, false);
        const Eigen::VectorXd noise = length_differences(draws.campaign(run, true), exact);
        for (Eigen::Index i = 0; i < noise.size(); ++i) {
            const engine::LengthObservation& length = exact.measurement.lengths[static_cast<std::size_t>(i)];
            const double distance = length.length + exact.truth.dead_paths[static_cast<Eigen::Index>(length.dead_path)];
            const double normalised = noise[i] / std::hypot(0.2e-6, 0.3e-6 * distance);
            sum += normalised;
            squares += normalised * normalised;
            count += 1.0;
        }
    }
    ASSERT_EQ(count, 5 * 6 * 6 * 6);
    EXPECT_NEAR(sum / count, 0.0, 4.0 / std::sqrt(count));
    EXPECT_NEAR(squares / count, 1.0, 4.0 * std::sqrt(2.0 / count));
}

TEST(DrawsOfCampaigns, ResolutionIsUniformWithinHalfAStep) {
    RotaryTableMeasurement layout = certain_layout();
    layout.length_uncertainty.resolution = 2e-6;
    const CampaignDraws draws(layout, {}, k_perfect, 3, 0);
    const Eigen::VectorXd noise = length_differences(draws.campaign(0, true), draws.campaign(0, false));
    EXPECT_LE(noise.cwiseAbs().maxCoeff(), 1e-6 + 1e-15);
    EXPECT_GT(noise.cwiseAbs().maxCoeff(), 0.95e-6);
    // E(x²) = a²/3 and var(x²) = 4a⁴/45 for a uniform x within ±a.
    const double squares = noise.squaredNorm() / static_cast<double>(noise.size()) / 1e-12;
    EXPECT_NEAR(squares, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / static_cast<double>(noise.size())));
}

TEST(DrawsOfCampaigns, ATableThatTurnsAboutItsAxisLeavesTheAxisWhereItIs) {
    RotaryTableMeasurement layout = certain_layout();
    layout.fixture.row(5) << 0.1, 0.0, 0.0;  // on the axis of A
    SimulationRequest request;
    request.error_linear = request.error_angular = request.set_up_offset = request.set_up_tilt = 0.0;
    const auto deviations = [&](const TableRepeatability& table) {
        const CampaignDraws draws(layout, request, table, 3, 0);
        return length_differences(draws.campaign(0, true), draws.campaign(0, false));
    };
    const Eigen::VectorXd once = deviations({engine::RepeatabilityMode::given, 0.0, 1e-6, 0.0});
    const Eigen::VectorXd twice = deviations({engine::RepeatabilityMode::given, 0.0, 2e-6, 0.0});
    const Eigen::VectorXd tilted = deviations({engine::RepeatabilityMode::given, 0.0, 0.0, 1e-6});
    EXPECT_GT(once.cwiseAbs().maxCoeff(), 1e-8);
    for (Eigen::Index i = 0; i < once.size(); ++i) {
        EXPECT_NEAR(twice[i], 2.0 * once[i], 1e-11);  // distances are linear in rotations of a microradian
        if (layout.lengths[static_cast<std::size_t>(i)].reflector == 5) {
            EXPECT_NEAR(once[i], 0.0, 1e-15);
            EXPECT_GT(std::abs(tilted[i]), 0.0);
        }
    }
}

TEST(DrawsOfCampaigns, ScaleAndFixtureAreDrawnAsTheyAreStated) {
    RotaryTableMeasurement layout = certain_layout();
    layout.length_uncertainty.u_scale = 1e-6;
    EXPECT_EQ(CampaignDraws(layout, {}, k_perfect, 3, 0).campaign(0, true).truth.scale_deviation.norm(), 0.0)
        << "fixed";
    layout.length_uncertainty.scale_model = engine::ScaleModel::prior;
    layout.fixture_covariance = 4e-12 * Eigen::MatrixXd::Identity(18, 18);
    layout.fixture_shape = engine::InputShape::uniform;
    layout.u_temperature.setConstant(0.5);
    layout.expansion = 11e-6;
    layout.u_expansion = 1e-6;
    const CampaignDraws draws(layout, {}, k_perfect, 3, 0);
    constexpr std::uint64_t k_runs = 40;
    Eigen::Vector4d squares = Eigen::Vector4d::Zero();  // of scale, temperature, expansion and fixture against u
    for (std::uint64_t run = 0; run < k_runs; ++run) {
        const engine::CampaignTruth truth = draws.campaign(run, true).truth;
        const Eigen::MatrixX3d moved = truth.fixture - layout.fixture;
        EXPECT_LE(moved.cwiseAbs().maxCoeff(), std::sqrt(3.0) * 2e-6 * (1.0 + 1e-9)) << "uniform";
        squares += Eigen::Vector4d(truth.scale_deviation.squaredNorm() / 1e-12,
                                   (truth.temperature_difference - layout.temperature_difference).squaredNorm() / 0.25,
                                   std::pow((truth.expansion - 11e-6) / 1e-6, 2), moved.squaredNorm() / 4e-12);
    }
    const Eigen::Vector4d counts = static_cast<double>(k_runs) * Eigen::Vector4d(6.0, 6.0, 1.0, 18.0);
    for (Eigen::Index i = 0; i < 4; ++i) {
        EXPECT_NEAR(squares[i] / counts[i], 1.0, 4.0 * std::sqrt(2.0 / counts[i])) << i;
    }
}

}  // namespace
}  // namespace gumcert::gum
