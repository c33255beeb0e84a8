#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "gum/expression/operation.h"

namespace gumcert::gum {

/// Where in the equations a step comes from, for messages.
struct StepOrigin {
    std::uint32_t equation = 0;
    std::uint32_t node = 0;
};

/// One elementary operation: value of its own slot from the slots a and b. A step of one argument has b = the tape's
/// spare slot, whose derivatives nobody reads.
struct TapeStep {
    Operation operation = Operation::number;
    std::int32_t a = 0;
    std::int32_t b = 0;
};

/// What a step takes that has a choice, max, min or abs: the operand that stands first (of abs: a), or the other (−a).
enum class Choice : std::uint8_t { none, first, second };

/// Memory that evaluations reuse; one a thread.
struct TapeWorkspace {
    std::vector<double> value;            // a slot
    std::vector<double> da, db;           // a step: first partial derivatives by its operands
    std::vector<double> daa, dab, dbb;    // a step: second ones
    std::vector<double> adjoint;          // a slot
    std::vector<double> tangent;          // a slot
    std::vector<double> adjoint_tangent;  // a slot
    std::vector<std::size_t> moving;      // a step: how many steps before it have a tangent that is not 0
};

/// Straight-line program for outputs (and residuals of implicit equations) as functions of the leaves.
///
/// Slots: leaves, constants, steps in the order of evaluation, one spare. Immutable after building, so that threads may
/// share it.
class Tape {
public:
    [[nodiscard]] std::size_t leaf_count() const { return leaf_count_; }
    [[nodiscard]] std::size_t step_count() const { return steps_.size(); }
    [[nodiscard]] std::size_t first_step_slot() const { return leaf_count_ + constants_.size(); }
    [[nodiscard]] const std::vector<TapeStep>& steps() const { return steps_; }
    [[nodiscard]] const std::vector<StepOrigin>& origins() const { return origins_; }
    /// Slots of the roots: first residuals, then outputs.
    [[nodiscard]] const std::vector<std::int32_t>& roots() const { return roots_; }
    [[nodiscard]] std::size_t residual_count() const { return residual_count_; }
    [[nodiscard]] bool is_constant(std::int32_t slot) const;
    /// Blocks of memory that a chunk of trials needs beside its input and output columns.
    [[nodiscard]] std::size_t register_count() const { return register_count_; }

    void prepare(TapeWorkspace& workspace) const;

    /// Values of the steps in [first, last) from the leaves in workspace.value.
    void values(TapeWorkspace& workspace, std::size_t first, std::size_t last) const;
    /// True when a step takes one of two values: max, min and abs.
    [[nodiscard]] bool has_choices() const;
    /// Which value each step takes from the values in the workspace, of two equal ones the first. A max or min of which only
    /// one operand varies keeps to a limit, and is no choice.
    /// \param varying  a leaf
    [[nodiscard]] std::vector<Choice> choices(const TapeWorkspace& workspace, const std::vector<bool>& varying) const;
    /// As values(), with the choices made elsewhere.
    void values_as_chosen(TapeWorkspace& workspace, const std::vector<Choice>& choices) const;
    /// Values and first partial derivatives of each step; with `second` the second ones, too.
    void values_and_partials(TapeWorkspace& workspace, std::size_t first, std::size_t last, bool second) const;
    /// Steps that the residuals need: they come first on the tape.
    [[nodiscard]] std::size_t residual_step_count() const { return residual_step_count_; }

    /// Reverse sweep: after it workspace.adjoint of the leaves is ∂root/∂leaf. Needs values_and_partials().
    /// \return a bound of what rounding of the steps adds to the root's value, in units of ε
    double gradient(TapeWorkspace& workspace, std::size_t root) const;

    /// Second derivatives of all roots by all leaves; `leaves` × `leaves` each. Needs values_and_partials(…, true).
    [[nodiscard]] std::vector<Eigen::MatrixXd> second_derivatives(TapeWorkspace& workspace) const;

    /// All outputs of a tape without residuals, for many trials.
    void trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const;

    /// True when every step up to `last` and every leaf is finite.
    [[nodiscard]] bool is_finite(const TapeWorkspace& workspace, std::size_t last) const;

private:
    friend class TapeBuilder;

    /// An operand of a step in trials: a column of numbers, or one number.
    struct TrialOperand {
        std::int32_t column = -1;  // -1: the number
        double number = 0.0;
    };
    struct TrialStep {
        Operation operation = Operation::number;
        TrialOperand a, b;
        std::int32_t result = 0;
        // The operation would make a finite number of an operand that is not: watch it.
        bool watch_a = false, watch_b = false;
    };

    void plan_trials();

    std::size_t leaf_count_ = 0;
    std::vector<double> constants_;
    std::vector<TapeStep> steps_;
    std::vector<StepOrigin> origins_;
    std::vector<std::int32_t> roots_;
    std::vector<std::size_t> lowest_;  // a root: the first step that it depends on
    std::size_t residual_count_ = 0;
    std::size_t residual_step_count_ = 0;

    // Columns of trials: inputs, registers, outputs.
    std::vector<TrialStep> trial_steps_;
    std::vector<TrialOperand> trial_outputs_;  // an output that is not the result of a step of its own
    std::vector<std::int32_t> used_inputs_;
    std::size_t register_count_ = 0;
    bool watched_ = false;
};

/// Builds a tape: equal sub-expressions become one step, operations of constants are done at once.
class TapeBuilder {
public:
    using Node = std::int32_t;

    explicit TapeBuilder(std::size_t leaves);
    [[nodiscard]] Node leaf(std::size_t index) const { return static_cast<Node>(index); }
    [[nodiscard]] Node constant(double value);
    [[nodiscard]] Node step(Operation operation, Node a, Node b, StepOrigin origin);
    [[nodiscard]] Tape finish(const std::vector<Node>& residuals, const std::vector<Node>& outputs) const;

private:
    struct Entry {
        Operation operation = Operation::quantity;
        Node a = -1, b = -1;
        double value = 0.0;
        StepOrigin origin;
    };
    [[nodiscard]] const Entry& entry(Node node) const { return entries_[static_cast<std::size_t>(node)]; }
    [[nodiscard]] bool is_number(Node node, double value) const;
    Node whole_power(Node base, int exponent, StepOrigin origin);

    std::size_t leaves_;
    std::vector<Entry> entries_;
    std::map<std::uint64_t, Node> constants_;
    std::map<std::tuple<Operation, Node, Node>, Node> steps_;
};

}  // namespace gumcert::gum
