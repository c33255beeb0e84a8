#include "gum/expression/equation_model.h"

#include <gtest/gtest.h>

#include "equations.h"

namespace gumcert::gum {
namespace {

InputGroup group(const std::string& name, std::initializer_list<double> values) {
    InputGroup result;
    result.name = name;
    result.value = vector(values);
    result.covariance = Eigen::MatrixXd::Identity(result.value.size(), result.value.size());
    return result;
}

TEST(EquationModel, CutsInputsIntoGroups) {
    const EquationModel model(
        system_of({"y = V/I*cos(phi)", "z = V"}, {input("V", "mV"), input("I", "mA"), input("phi", "rad")}, {},
                  {output("y", "mohm"), output("z", "uV")}),
        {group("V, I", {5.0, 0.02}), group("phi", {1.0})});
    EXPECT_EQ(model.outputs()[0].name, "y");
    EXPECT_EQ(Unit::parse(model.outputs()[0].unit).to_si(1.0), 1.0);
    EXPECT_EQ(model.outputs()[1].name, "z");
    const Eigen::VectorXd x = input_estimates(model);
    EXPECT_DOUBLE_EQ(model.evaluate(x)(0), 250.0 * std::cos(1.0));
    EXPECT_EQ(model.jacobian(x).rows(), 2);
    EXPECT_EQ(model.hessians(x).size(), 2U);
    Eigen::MatrixXd y(2, 2);
    model.evaluate_trials(x.transpose().replicate(2, 1), y);
    EXPECT_EQ(y.row(1).transpose(), model.evaluate(x));
}

TEST(EquationModel, RefusesGroupsOfAnotherSize) {
    try {
        const EquationModel model(system_of({"y = a + b"}, numbers({"a", "b"})), {group("a", {1.0})});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-MODEL-0070");
    }
}

TEST(EquationModel, TrialsOfImplicitModelsStartAtTheSolutionOfTheEstimates) {
    const EquationModel model(system_of({"0 = z^2 - a"}, numbers({"a"}), {unknown("z", -0.1)}), {group("a", {4.0})});
    Eigen::MatrixXd y(1, 1);
    model.evaluate_trials(Eigen::MatrixXd::Constant(1, 1, 4.0), y);
    EXPECT_DOUBLE_EQ(y(0, 0), -2.0);
    EXPECT_DOUBLE_EQ(model.evaluate(vector({4.0}))(0), -2.0);
}

}  // namespace
}  // namespace gumcert::gum
