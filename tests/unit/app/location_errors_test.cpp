#include "app/location_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

#include "app/evaluate_rotary_table.h"
#include "gum/quantity/units.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::app {
namespace {

using engine::MachineFramePoints;
using engine::synthetic::Campaign;
using engine::synthetic::CampaignPlan;

constexpr double k_u = 2e-6;

Eigen::Matrix3d machine_rotation() {
    return (Eigen::AngleAxisd(2e-3, Eigen::Vector3d(0.2, 0.7, -0.4).normalized()) *
            Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
}
const Eigen::Vector3d k_translation(0.4, -0.2, 0.7);

Eigen::Vector3d in_machine(const Eigen::Vector3d& point) {
    return machine_rotation() * point + k_translation;
}

/// A measured table whose reflectors or stations were located in the machine, with what they are off by.
engine::RotaryTableJob job_of(MachineFramePoints by, std::uint64_t seed, double factor = 1.0) {
    CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(12);
    plan.start_values = true;
    plan.seed = seed;
    const Campaign campaign = engine::synthetic::simulate(plan);
    engine::RotaryTableJob job;
    job.measurement = campaign.measurement;
    engine::MachineFrame& frame = job.machine_frame.emplace();
    frame.by = by;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const bool stations = by == MachineFramePoints::stations;
    const std::size_t count = stations ? campaign.truth.stations.size() : job.measurement.reflectors.size();
    frame.coordinates.resize(static_cast<Eigen::Index>(count), 3);
    frame.u = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(count), k_u);
    for (std::size_t i = 0; i < count; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const Eigen::Vector3d at_home =
            stations ? campaign.truth.stations[i]
                     : engine::synthetic::point_in_table(plan.axis, 0.0, campaign.truth.errors.col(0),
                                                         campaign.truth.set_up, campaign.truth.fixture.row(row));
        frame.points.push_back(i);
        for (int c = 0; c < 3; ++c) {
            frame.coordinates(row, c) = in_machine(at_home)[c] + factor * k_u * normal(random);
        }
    }
    frame.nominal_point = in_machine(Eigen::Vector3d::Zero());
    return job;
}

LocationErrors evaluated(engine::RotaryTableJob job) {
    return *evaluate_rotary_table(job, 1).location_errors;
}

/// The axis is x of the table.
Eigen::Vector4d truth() {
    const Eigen::Vector3d slope = machine_rotation().col(0) / machine_rotation()(0, 0);
    return {0.0, 0.0, -std::atan(slope[2]), std::atan(slope[1])};
}

TEST(LocationErrors, ErrorsOfSimulatedMeasurementsAreAsLargeAsTheirUncertainties) {
    for (const MachineFramePoints by : {MachineFramePoints::reflectors, MachineFramePoints::stations}) {
        constexpr int k_campaigns = 25;
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        for (int i = 0; i < k_campaigns; ++i) {
            const LocationErrors found = evaluated(job_of(by, static_cast<std::uint64_t>(i) + 1));
            ASSERT_TRUE(found.budget) << i << (found.notes.empty() ? "" : found.notes.front().what);
            const Eigen::Vector4d error =
                (found.budget->value - truth()).cwiseQuotient(found.budget->standard_uncertainty);
            sum += error.cwiseAbs2();
        }
        for (int c = 0; c < 4; ++c) {
            const double rms = std::sqrt(sum[c] / k_campaigns);
            EXPECT_GT(rms, 0.55) << c;  // 3.2 standard deviations of 25 campaigns
            EXPECT_LT(rms, 1.45) << c;
        }
    }
}

TEST(LocationErrors, PointsThatDisagreeStateNone) {
    const LocationErrors found = evaluated(job_of(MachineFramePoints::reflectors, 1, 10.0));
    EXPECT_FALSE(found.budget);
    ASSERT_EQ(found.notes.size(), 1U);
    EXPECT_EQ(found.notes.front().code, "GC-FRAME-0002");
}

TEST(LocationErrors, CoordinatesInAnotherOrderStateNone) {
    engine::RotaryTableJob job = job_of(MachineFramePoints::reflectors, 1);
    const Eigen::MatrixXd coordinates = job.machine_frame->coordinates;
    job.machine_frame->coordinates << coordinates.col(1), coordinates.col(2), coordinates.col(0);
    const LocationErrors found = evaluated(job);
    EXPECT_FALSE(found.budget);
    ASSERT_EQ(found.notes.size(), 1U);
    EXPECT_EQ(found.notes.front().code, "GC-FRAME-0003");
}

TEST(LocationErrors, OfARecordHaveTheirFrame) {
    engine::RotaryTableJob job = job_of(MachineFramePoints::stations, 3);
    job.machine_frame->source = "calibrated axes";
    reports::RotaryTable rotary;
    fill_location_errors(rotary, job, evaluated(job));
    ASSERT_EQ(rotary.location_errors.size(), 4U);
    EXPECT_EQ(rotary.location_errors[0].name, "EY0A");
    EXPECT_EQ(rotary.location_errors[3].description, "tilt of the axis about z in the frame of the machine");
    ASSERT_TRUE(rotary.machine_frame);
    EXPECT_EQ(rotary.machine_frame->by, "stations");
    EXPECT_EQ(rotary.machine_frame->points.size(), 6U);
    EXPECT_NEAR(rotary.location_errors[2].stated.value, truth()[2] / gum::k_arcsecond, 20.0);
}

}  // namespace
}  // namespace gumcert::app
