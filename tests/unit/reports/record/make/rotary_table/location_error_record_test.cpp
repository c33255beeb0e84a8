#include "reports/record/make/rotary_table/location_error_record.h"

#include <gtest/gtest.h>

namespace gumcert::reports {
namespace {

TEST(LocationErrorRecord, HasTheFrameThePointsAndTheErrors) {
    jobs::RotaryTableJob job;
    job.measurement.axis = engine::RotaryAxis::b;
    job.measurement.stations = {"S1", "S2", "S3"};
    engine::MachineFrame& frame = job.machine_frame.emplace();
    frame.by = engine::MachineFramePoints::stations;
    frame.points = {2, 0, 1};
    frame.u = Eigen::Vector3d::Constant(2e-6);
    frame.nominal_point = {0.1, 0.2, 0.3};
    frame.source = "calibrated axes";
    gum::LocationErrors errors;
    errors.fit.residuals = Eigen::Matrix3d::Constant(1.2e-6);
    errors.fit.degrees_of_freedom = 3.0;
    errors.p_value = 0.25;

    reports::RotaryTable without;
    fill_location_errors(without, job, errors);
    ASSERT_TRUE(without.machine_frame);
    EXPECT_EQ(without.machine_frame->by, "stations");
    EXPECT_EQ(without.machine_frame->source, "calibrated axes");
    EXPECT_DOUBLE_EQ(without.machine_frame->nominal_point_mm[1], 200.0);
    ASSERT_EQ(without.machine_frame->points.size(), 3U);
    EXPECT_EQ(without.machine_frame->points[0].name, "S3");
    EXPECT_DOUBLE_EQ(without.machine_frame->points[0].u_um, 2.0);
    EXPECT_DOUBLE_EQ(without.machine_frame->points[0].residual_um[2], 1.2);
    EXPECT_EQ(without.machine_frame->printed_residual, "1.2");
    EXPECT_EQ(without.machine_frame->p_value.text, "0.25");
    EXPECT_TRUE(without.location_errors.empty());

    gum::UncertaintyBudget& budget = errors.budget.emplace();
    budget.value = Eigen::Vector4d(1e-6, 2e-6, 1e-6, 2e-6);
    budget.standard_uncertainty = budget.coverage_factor = Eigen::Vector4d::Constant(2e-6);
    budget.expanded_uncertainty = budget.effective_degrees_of_freedom = Eigen::Vector4d::Constant(4e-6);
    reports::RotaryTable with;
    fill_location_errors(with, job, errors);
    ASSERT_EQ(with.location_errors.size(), 4U);
    EXPECT_EQ(with.location_errors[0].name, "EX0B");
    EXPECT_EQ(with.location_errors[0].unit, "um");
    EXPECT_DOUBLE_EQ(with.location_errors[1].stated.value, 2.0);
    EXPECT_EQ(with.location_errors[1].description, "position of the axis along z in the frame of the machine");
    EXPECT_EQ(with.location_errors[3].unit, "arcsec");
    EXPECT_EQ(with.location_errors[3].description, "tilt of the axis about z in the frame of the machine");
}

}  // namespace
}  // namespace gumcert::reports
