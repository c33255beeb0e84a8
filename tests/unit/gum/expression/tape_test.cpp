#include "gum/expression/tape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace gumcert::gum {
namespace {

/// y = a·sin(b) + 2, and a second output a.
Tape two_outputs() {
    TapeBuilder builder(2);
    const TapeBuilder::Node product = builder.step(
        Operation::multiply, builder.leaf(0), builder.step(Operation::sin, builder.leaf(1), builder.leaf(1), {}), {});
    return builder.finish({}, {builder.step(Operation::add, product, builder.constant(2.0), {}), builder.leaf(0)});
}

TapeWorkspace at(const Tape& tape, double a, double b) {
    TapeWorkspace workspace;
    tape.prepare(workspace);
    workspace.value[0] = a;
    workspace.value[1] = b;
    return workspace;
}

double root_value(const Tape& tape, const TapeWorkspace& workspace, std::size_t root) {
    return workspace.value[static_cast<std::size_t>(tape.roots()[root])];
}

TEST(Tape, HasTheValuesOfItsRoots) {
    const Tape tape = two_outputs();
    EXPECT_EQ(tape.leaf_count(), 2U);
    EXPECT_EQ(tape.step_count(), 3U);
    EXPECT_EQ(tape.residual_count(), 0U);
    TapeWorkspace workspace = at(tape, 3.0, 0.5);
    tape.values(workspace, 0, tape.step_count());
    EXPECT_EQ(root_value(tape, workspace, 0), 3.0 * std::sin(0.5) + 2.0);
    EXPECT_EQ(root_value(tape, workspace, 1), 3.0);
    EXPECT_TRUE(tape.is_finite(workspace, tape.step_count()));
    workspace = at(tape, std::numeric_limits<double>::infinity(), 0.5);
    tape.values(workspace, 0, tape.step_count());
    EXPECT_FALSE(tape.is_finite(workspace, tape.step_count()));
}

TEST(Tape, SweepsBackToTheDerivativesByHand) {
    const Tape tape = two_outputs();
    TapeWorkspace workspace = at(tape, 3.0, 0.5);
    tape.values_and_partials(workspace, 0, tape.step_count(), true);
    const double bound = tape.gradient(workspace, 0);
    EXPECT_DOUBLE_EQ(workspace.adjoint[0], std::sin(0.5));
    EXPECT_DOUBLE_EQ(workspace.adjoint[1], 3.0 * std::cos(0.5));
    EXPECT_GT(bound, 0.0);
    (void)tape.gradient(workspace, 1);
    EXPECT_EQ(workspace.adjoint[0], 1.0);
    EXPECT_EQ(workspace.adjoint[1], 0.0);
    const std::vector<Eigen::MatrixXd> second = tape.second_derivatives(workspace);
    ASSERT_EQ(second.size(), 2U);
    EXPECT_DOUBLE_EQ(second[0](0, 0), 0.0);
    EXPECT_DOUBLE_EQ(second[0](0, 1), std::cos(0.5));
    EXPECT_DOUBLE_EQ(second[0](1, 0), std::cos(0.5));
    EXPECT_DOUBLE_EQ(second[0](1, 1), -3.0 * std::sin(0.5));
    EXPECT_TRUE(second[1].isZero(0.0));
}

TEST(Tape, StepsOfResidualsComeFirst) {
    TapeBuilder builder(2);
    const TapeBuilder::Node output = builder.step(Operation::exp, builder.leaf(0), builder.leaf(0), {});
    const TapeBuilder::Node residual =
        builder.step(Operation::subtract, builder.leaf(0), builder.leaf(1), {.equation = 7, .node = 4});
    const Tape tape = builder.finish({residual}, {output});
    EXPECT_EQ(tape.residual_count(), 1U);
    EXPECT_EQ(tape.residual_step_count(), 1U);
    EXPECT_EQ(tape.steps()[0].operation, Operation::subtract);
    EXPECT_EQ(tape.origins()[0].equation, 7U);
    EXPECT_EQ(tape.origins()[0].node, 4U);
    TapeWorkspace workspace = at(tape, 3.0, 1.0);
    tape.values(workspace, 0, tape.residual_step_count());
    EXPECT_EQ(root_value(tape, workspace, 0), 2.0);
}

TEST(Tape, ConstantsAreKnownAsSuch) {
    TapeBuilder builder(1);
    const TapeBuilder::Node six = builder.step(Operation::multiply, builder.constant(2.0), builder.constant(3.0), {});
    const Tape tape = builder.finish({}, {six, builder.leaf(0)});
    EXPECT_EQ(tape.step_count(), 0U);
    EXPECT_TRUE(tape.is_constant(tape.roots()[0]));
    EXPECT_FALSE(tape.is_constant(tape.roots()[1]));
}

TEST(Tape, TrialsAreSingleEvaluations) {
    const Tape tape = two_outputs();
    Eigen::MatrixXd x(3, 2);
    x << 3.0, 0.5, -1.0, 2.0, 0.0, 0.1;
    Eigen::MatrixXd y(3, 2);
    tape.trials(x, y);
    for (Eigen::Index trial = 0; trial < 3; ++trial) {
        EXPECT_EQ(y(trial, 0), x(trial, 0) * std::sin(x(trial, 1)) + 2.0);
        EXPECT_EQ(y(trial, 1), x(trial, 0));
    }
}

TEST(Tape, RegistersAreUsedAgain) {
    TapeBuilder builder(2);
    TapeBuilder::Node sum = builder.leaf(0);
    for (int i = 1; i < 1000; ++i) {
        sum = builder.step(Operation::add, sum,
                           builder.step(Operation::multiply, builder.leaf(1), builder.constant(i + 0.5), {}), {});
    }
    const Tape chain = builder.finish({}, {sum});
    EXPECT_GT(chain.step_count(), 1900U);
    EXPECT_LE(chain.register_count(), 4U);
}

TEST(Tape, EqualPartsAreOneStep) {
    TapeBuilder builder(2);
    const auto product = [&] { return builder.step(Operation::multiply, builder.leaf(0), builder.leaf(1), {}); };
    const TapeBuilder::Node first = product();
    EXPECT_EQ(product(), first);
    EXPECT_EQ(builder.step(Operation::multiply, builder.leaf(1), builder.leaf(0), {}), first);
    EXPECT_EQ(builder.step(Operation::add, builder.constant(2), builder.constant(3), {}), builder.constant(5));
    EXPECT_EQ(builder.finish({}, {builder.step(Operation::subtract, first, first, {})}).step_count(), 2U);
}

TEST(Tape, RepeatsChoicesThatWereMadeElsewhere) {
    EXPECT_FALSE(two_outputs().has_choices());
    TapeBuilder builder(2);
    const TapeBuilder::Node a = builder.leaf(0);
    const TapeBuilder::Node b = builder.leaf(1);
    const Tape tape =
        builder.finish({}, {builder.step(Operation::maximum, a, b, {}), builder.step(Operation::absolute, a, a, {}),
                            builder.step(Operation::minimum, b, builder.constant(1.0), {})});
    EXPECT_TRUE(tape.has_choices());
    TapeWorkspace workspace = at(tape, -3.0, 0.5);
    tape.values(workspace, 0, tape.step_count());
    const std::vector<Choice> chosen = tape.choices(workspace, {true, true});
    EXPECT_EQ(chosen, (std::vector<Choice>{Choice::second, Choice::second, Choice::none}));
    EXPECT_EQ(tape.choices(workspace, {true, false})[0], Choice::none);
    workspace = at(tape, 4.0, 2.0);
    tape.values_as_chosen(workspace, chosen);
    EXPECT_EQ(root_value(tape, workspace, 0), 2.0);
    EXPECT_EQ(root_value(tape, workspace, 1), -4.0);
    EXPECT_EQ(root_value(tape, workspace, 2), 1.0);
    // Of two equal ones the first.
    workspace = at(tape, 2.0, 2.0);
    tape.values(workspace, 0, tape.step_count());
    EXPECT_EQ(tape.choices(workspace, {true, true})[0], Choice::first);
}

}  // namespace
}  // namespace gumcert::gum
