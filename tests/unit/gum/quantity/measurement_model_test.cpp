#include "gum/quantity/measurement_model.h"

#include <gtest/gtest.h>

namespace gumcert::gum {
namespace {

class TwoGroups : public MeasurementModel {
public:
    TwoGroups() : groups_(2) {
        groups_[0].value = Eigen::Vector2d(1.0, 2.0);
        groups_[0].covariance = Eigen::Vector2d(0.1, 0.2);
        groups_[1].value = Eigen::VectorXd::Constant(1, 3.0);
        groups_[1].covariance = Eigen::MatrixXd::Constant(1, 1, 0.3);
    }
    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override { return x; }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        return Eigen::MatrixXd::Identity(x.size(), x.size());
    }

private:
    std::vector<InputGroup> groups_;
    std::vector<OutputQuantity> outputs_{{"a", "m"}, {"b", "m"}, {"c", "m"}};
};

TEST(InputEstimates, AreTheGroupsOneAfterTheOther) {
    EXPECT_EQ(input_estimates(TwoGroups()), Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(InputGroup, KnowsHowItsCovarianceIsStored) {
    const TwoGroups model;
    EXPECT_TRUE(model.inputs()[0].is_diagonal());
    EXPECT_FALSE(model.inputs()[1].is_diagonal()) << "1×1: the matrix and its diagonal are the same";
}

TEST(InputGroup, NamesEachQuantityWithItsOwnUnit) {
    InputGroup group;
    group.name = "offset";
    group.unit = "m";
    group.value = Eigen::VectorXd::Zero(1);
    EXPECT_EQ(group.quantity(0).name, "offset");
    group.value = Eigen::VectorXd::Zero(2);
    EXPECT_EQ(group.quantity(1).name, "offset[2]");
    EXPECT_EQ(group.quantity(1).unit, "m");
    group.unit.clear();
    group.quantities = {{"offset", "m"}, {"slope", "m/K"}};
    EXPECT_EQ(group.quantity(1).name, "slope");
    EXPECT_EQ(group.quantity(1).unit, "m/K");
}

}  // namespace
}  // namespace gumcert::gum
