#include "engine/rotary_table/contact_point_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::CampaignPlan;
using synthetic::Vector6;

constexpr Eigen::Index k_contact_angles = 8;
constexpr Eigen::Index k_contact_inputs = 6 * k_contact_angles + 4;

/// A table whose reported quantities are its inputs: 6 error motions an angle, then the set-up.
class ReportedAsGiven final : public gum::MeasurementModel {
public:
    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return inputs_; }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override { return x; }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        return Eigen::MatrixXd::Identity(x.size(), x.size());
    }

private:
    std::vector<gum::InputGroup> inputs_;
    std::vector<gum::OutputQuantity> outputs_;
};

class ContactPoint : public testing::TestWithParam<RotaryAxis> {
protected:
    void SetUp() override {
        CampaignPlan plan;
        plan.axis = GetParam();
        plan.angles_deg = synthetic::full_turn(k_contact_angles);
        plan.noise = 0.0;
        const synthetic::Campaign campaign = synthetic::simulate(plan);
        measurement_ = campaign.measurement;
        reported_ = campaign.true_values(false);
        errors_ = campaign.truth.errors;
        set_up_ = campaign.truth.set_up;
    }
    [[nodiscard]] ContactPointModel model() const {
        return {std::make_shared<ReportedAsGiven>(), measurement_,
                transform_to_datum(measurement_, errors_, rigid_motion(set_up_), Datum::axis_average_line), point_};
    }

    RotaryTableMeasurement measurement_;
    Eigen::VectorXd reported_;
    Eigen::MatrixXd errors_;
    Vector6 set_up_;
    Eigen::Vector3d point_{0.15, -0.03, 0.02};
};

// The error motions of the campaign obey the axis average line to first order; the second is below 1e-13 m.
TEST_P(ContactPoint, MovesAsAPointOfTheTable) {
    const ContactPointModel contact = model();
    const Eigen::VectorXd displacement = contact.evaluate(reported_);
    ASSERT_EQ(displacement.size(), 3 * k_contact_angles);
    ASSERT_EQ(contact.outputs().size(), static_cast<std::size_t>(3 * k_contact_angles));
    EXPECT_EQ(contact.outputs()[4].name, "displacement y at angle number 2");
    EXPECT_EQ(contact.outputs()[4].unit, "m");
    for (Eigen::Index i = 0; i < k_contact_angles; ++i) {
        const Eigen::Vector3d expected = synthetic::moved(errors_.col(i), point_) - point_;
        EXPECT_LT((displacement.segment<3>(3 * i) - expected).norm(), 1e-13) << i;
    }
    EXPECT_EQ(contact.displacements(reported_), displacement);
}

TEST_P(ContactPoint, DoesNotSeeTheDatumOfTheCertificate) {
    const Eigen::VectorXd expected = model().evaluate(reported_);
    const DatumSolution home = transform_to_datum(measurement_, errors_, rigid_motion(set_up_), Datum::home);
    Eigen::VectorXd in_home(k_contact_inputs);
    const auto across = across_axis(measurement_.axis);
    in_home << home.errors.reshaped(), home.set_up[across[0]], home.set_up[across[1]], home.set_up[3 + across[0]],
        home.set_up[3 + across[1]];
    EXPECT_GT((in_home - reported_).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_LT((model().evaluate(in_home) - expected).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_P(ContactPoint, JacobianIsCentralDifferences) {
    constexpr double k_step = 1e-6;
    const ContactPointModel contact = model();
    const Eigen::MatrixXd jacobian = contact.jacobian(reported_);
    ASSERT_EQ(jacobian.rows(), 3 * k_contact_angles);
    ASSERT_EQ(jacobian.cols(), k_contact_inputs);
    for (Eigen::Index k = 0; k < k_contact_inputs; ++k) {
        const Eigen::VectorXd step = k_step * Eigen::VectorXd::Unit(k_contact_inputs, k);
        const Eigen::VectorXd difference =
            (contact.evaluate(reported_ + step) - contact.evaluate(reported_ - step)) / (2.0 * k_step);
        EXPECT_LT((jacobian.col(k) - difference).cwiseAbs().maxCoeff(), 1e-3) << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Axes, ContactPoint, testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                         [](const auto& axis) { return std::string(1, "ABC"[axial_coordinate(axis.param)]); });

}  // namespace
}  // namespace gumcert::engine
