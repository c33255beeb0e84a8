#include "gum/expression/equation_system.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "gum/expression/equation_compiler.h"
#include "gum/expression/syntax_tree.h"
#include "gum/expression/tape.h"
#include "gum/quantity/decimal_rounding.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {

// Implicit equations F(x, z) = 0 are solved for z by Newton's method. The outputs y = g(x, z(x)) then have the
// derivatives
// dy/dx = ∂g/∂x + ∂g/∂z S, S = dz/dx = −(∂F/∂z)⁻¹ ∂F/∂x
// by the theorem of implicit functions: exact at the solution, whatever way the search took, and not where ∂F/∂z is
// singular. So a search that ends there has no result.

namespace {

/// Memory of one thread for all that is evaluated one point at a time.
struct Workspace {
    TapeWorkspace tape;
    std::vector<double> unknowns, start, trial, scale;
    Eigen::MatrixXd slope, scaled, inverse;  // ∂F/∂z, the same with rows and columns near 1, and its inverse
    Eigen::VectorXd residual, rounding, step, probe, row_scale, column_scale;
    Eigen::FullPivLU<Eigen::MatrixXd> decomposition;
};

Workspace& workspace_of_thread() {
    thread_local Workspace workspace;
    return workspace;
}

enum class Search : std::uint8_t { converged, no_value, not_converged, singular };

}  // namespace

/// The equations with what is needed to run them. It never changes.
struct EquationSystem::Compiled : CompiledEquations {
    void check_size(Eigen::Index values) const;
    void set_inputs(Workspace& workspace, const Eigen::VectorXd& x) const;
    Search search(Workspace& workspace, const double* start_values) const;
    bool invert_slope(Workspace& workspace) const;
    void run(Workspace& workspace, const Eigen::VectorXd& x, bool partials, bool second) const;

    [[nodiscard]] Diagnostic why_not_finite(const Workspace& workspace, std::size_t last) const;
    [[nodiscard]] Diagnostic why_no_derivative(const Workspace& workspace, std::size_t last, bool second) const;
    [[nodiscard]] Diagnostic why_no_solution(const Workspace& workspace, Search outcome) const;
    [[nodiscard]] std::string step_text(const Workspace& workspace, std::size_t step) const;
    [[nodiscard]] std::string step_place(std::size_t step) const;
};

EquationSystem EquationSystem::compile(std::span<const EquationText> equations, std::span<const InputSymbol> inputs,
                                       std::span<const UnknownSymbol> unknowns, std::span<const OutputSymbol> outputs,
                                       const ExpressionLimits& limits) {
    auto compiled = std::make_shared<Compiled>();
    static_cast<CompiledEquations&>(*compiled) = compile_equations(equations, inputs, unknowns, outputs, limits);
    return EquationSystem(std::move(compiled));
}

std::size_t EquationSystem::input_count() const {
    return compiled_->inputs();
}

std::size_t EquationSystem::output_count() const {
    return compiled_->outputs.size();
}

std::size_t EquationSystem::unknown_count() const {
    return compiled_->unknowns();
}

const std::string& EquationSystem::output_name(std::size_t output) const {
    return compiled_->outputs.at(output).name;
}

const Unit& EquationSystem::output_unit(std::size_t output) const {
    return compiled_->outputs.at(output).unit;
}

const std::vector<Diagnostic>& EquationSystem::warnings() const {
    return compiled_->warnings;
}

const std::vector<std::size_t>& EquationSystem::unused_inputs() const {
    return compiled_->unused_inputs;
}

std::vector<bool> EquationSystem::inputs_of(std::size_t output) const {
    // Backwards along the steps: from the output, and from all residuals where it needs an unknown, because implicit
    // equations are solved together.
    const Tape& tape = compiled_->tape;
    const std::size_t base = tape.first_step_slot();
    std::vector<bool> used(base + tape.step_count() + 1);
    const auto follow = [&] {
        for (std::size_t k = tape.step_count(); k-- > 0;) {
            if (used[base + k]) {
                const TapeStep& step = tape.steps()[k];
                used[static_cast<std::size_t>(step.a)] = true;
                used[static_cast<std::size_t>(step.b)] = true;
            }
        }
    };
    used.at(static_cast<std::size_t>(tape.roots().at(tape.residual_count() + output))) = true;
    follow();
    const auto inputs = static_cast<std::ptrdiff_t>(compiled_->inputs());
    const auto unknowns = used.begin() + inputs;
    if (std::find(unknowns, unknowns + static_cast<std::ptrdiff_t>(compiled_->unknowns()), true) !=
        unknowns + static_cast<std::ptrdiff_t>(compiled_->unknowns())) {
        for (std::size_t i = 0; i < tape.residual_count(); ++i) {
            used[static_cast<std::size_t>(tape.roots()[i])] = true;
        }
        follow();
    }
    return {used.begin(), used.begin() + inputs};
}

bool EquationSystem::is_affine_in(std::span<const std::size_t> inputs) const {
    for (std::size_t output = 0; output < output_count(); ++output) {
        if (!is_affine_in(inputs, output)) {
            return false;
        }
    }
    return true;
}

bool EquationSystem::is_affine_in(std::span<const std::size_t> inputs, std::size_t output) const {
    // Degrees are followed step by step without any value, so that what is found holds everywhere and not at the
    // estimates only. Where in doubt, a step counts as curved.
    enum Degree : std::uint8_t { independent, affine, curved };
    const Tape& tape = compiled_->tape;
    const std::size_t base = tape.first_step_slot();
    std::vector<Degree> degree(base + tape.step_count() + 1, independent);
    const auto run = [&](Degree of_unknowns) {
        std::fill(degree.begin(), degree.end(), independent);
        for (const std::size_t input : inputs) {
            degree.at(input) = affine;
        }
        std::fill_n(degree.begin() + static_cast<std::ptrdiff_t>(compiled_->inputs()), compiled_->unknowns(),
                    of_unknowns);
        for (std::size_t k = 0; k < tape.step_count(); ++k) {
            const TapeStep& step = tape.steps()[k];
            const Degree a = degree[static_cast<std::size_t>(step.a)];
            const Degree b = degree[static_cast<std::size_t>(step.b)];
            Degree result = std::max(a, b);
            switch (step.operation) {
                case Operation::negate:
                case Operation::add:
                case Operation::subtract:
                    break;
                case Operation::multiply:
                    result = a != independent && b != independent ? curved : result;
                    break;
                case Operation::divide:
                    result = b != independent ? curved : result;
                    break;
                default:
                    result = result != independent ? curved : result;
            }
            degree[base + k] = result;
        }
    };
    const auto largest = [&](std::size_t first, std::size_t last) {
        Degree result = independent;
        for (std::size_t i = first; i < last; ++i) {
            result = std::max(result, degree[static_cast<std::size_t>(tape.roots()[i])]);
        }
        return result;
    };
    run(independent);
    if (largest(0, tape.residual_count()) != independent) {
        run(affine);  // unknowns are affine in the inputs where the equations are affine in both together
        if (largest(0, tape.residual_count()) == curved) {
            run(curved);
        }
    }
    return degree[static_cast<std::size_t>(tape.roots().at(tape.residual_count() + output))] != curved;
}

void EquationSystem::Compiled::check_size(Eigen::Index values) const {
    if (static_cast<std::size_t>(values) != inputs()) {
        throw InputError(Diagnostic{.code = "GC-MODEL-0071",
                                    .where = "inputs",
                                    .what = text::count_of(values, "value"),
                                    .rule = "the number of inputs of the equations is " + std::to_string(inputs()),
                                    .action = "Give one value for every input."});
    }
}

void EquationSystem::Compiled::set_inputs(Workspace& workspace, const Eigen::VectorXd& x) const {
    check_size(x.size());
    tape.prepare(workspace.tape);
    std::copy(x.data(), x.data() + x.size(), workspace.tape.value.begin());
}

/// ∂F/∂z is inverted with rows and columns scaled near 1, so that units do not decide what is singular.
bool EquationSystem::Compiled::invert_slope(Workspace& workspace) const {
    const Eigen::MatrixXd& slope = workspace.slope;
    if (!slope.allFinite()) {
        return false;
    }
    // One equation needs no factorisation, which counts: it is solved in every trial of Monte Carlo.
    if (slope.rows() == 1) {
        workspace.inverse.resize(1, 1);
        workspace.inverse(0, 0) = 1.0 / slope(0, 0);
        return std::isfinite(workspace.inverse(0, 0));
    }
    // A_s = R A C with C for the units of the unknowns and R for those of the equations; A⁻¹ = C A_s⁻¹ R.
    workspace.column_scale = slope.cwiseAbs().colwise().maxCoeff().transpose();
    if (workspace.column_scale.minCoeff() == 0.0) {
        return false;
    }
    workspace.column_scale = workspace.column_scale.cwiseInverse();
    workspace.scaled.noalias() = slope * workspace.column_scale.asDiagonal();
    workspace.row_scale = workspace.scaled.cwiseAbs().rowwise().maxCoeff();
    if (workspace.row_scale.minCoeff() == 0.0) {
        return false;
    }
    workspace.row_scale = workspace.row_scale.cwiseInverse();
    workspace.scaled = workspace.row_scale.asDiagonal() * workspace.scaled;
    // Full pivoting tells the rank: partial pivoting divides by what is left of a singular matrix and goes on.
    workspace.decomposition.compute(workspace.scaled);
    if (!workspace.decomposition.isInvertible()) {
        return false;
    }
    workspace.inverse = workspace.decomposition.inverse();
    workspace.inverse =
        (workspace.column_scale.asDiagonal() * workspace.inverse * workspace.row_scale.asDiagonal()).eval();
    return workspace.inverse.allFinite();
}

/// Newton's method with steps shortened until the next correction is smaller (natural monotonicity: it does not depend
/// on the units of equations and unknowns). Leaves the solution in workspace.unknowns and in the leaves of the tape.
Search EquationSystem::Compiled::search(Workspace& workspace, const double* start_values) const {
    constexpr int k_most_steps = 100;
    constexpr double k_converged = 1e-14;     // of the step, relative to the unknown
    constexpr double k_shortest_step = 1e-9;  // of Newton's
    constexpr double k_lost = 1e-6;           // relative to the unknown, by rounding alone: no solution to state
    constexpr int k_linear_steps = 12;        // this many steps, each half of the one before: a double solution
    constexpr double k_epsilon = std::numeric_limits<double>::epsilon();
    const std::size_t n = inputs();
    const auto u = static_cast<Eigen::Index>(unknowns());
    const std::size_t steps = tape.residual_step_count();
    double* const z = workspace.tape.value.data() + n;
    const auto index = [](Eigen::Index i) { return static_cast<std::size_t>(i); };
    const auto residual_value = [&](Eigen::Index i) {
        return workspace.tape.value[static_cast<std::size_t>(tape.roots()[index(i)])];
    };

    workspace.unknowns.assign(start_values, start_values + u);
    workspace.scale.assign(index(u), 0.0);
    workspace.slope.resize(u, u);
    workspace.residual.resize(u);
    workspace.rounding.resize(u);
    std::copy(workspace.unknowns.begin(), workspace.unknowns.end(), z);
    double last_size = 0.0;
    bool last_was_whole = false;
    int linear = 0;
    for (int iteration = 0; iteration < k_most_steps; ++iteration) {
        tape.values_and_partials(workspace.tape, 0, steps, false);
        if (!tape.is_finite(workspace.tape, steps)) {
            return Search::no_value;
        }
        for (Eigen::Index i = 0; i < u; ++i) {
            // A residual cannot be known better than this: a step that only follows its rounding counts as convergence.
            workspace.rounding(i) = k_epsilon * tape.gradient(workspace.tape, index(i));
            workspace.residual(i) = residual_value(i);
            for (Eigen::Index j = 0; j < u; ++j) {
                workspace.slope(i, j) = workspace.tape.adjoint[n + index(j)];
            }
        }
        if (!invert_slope(workspace)) {
            return Search::singular;
        }
        workspace.step.noalias() = workspace.inverse * -workspace.residual;
        workspace.probe.noalias() = workspace.inverse.cwiseAbs() * workspace.rounding;
        if (!workspace.step.allFinite()) {
            return Search::singular;
        }
        bool converged = true;
        bool lost = false;
        double size = 0.0;
        for (Eigen::Index j = 0; j < u; ++j) {
            double& scale = workspace.scale[index(j)];
            if (iteration == 0) {
                // An unknown that starts at 0, or ends there, has no size of its own to hold a step against.
                scale = std::max(std::fabs(z[j]), std::fabs(workspace.step(j)));
            }
            const double step = std::fabs(workspace.step(j));
            const double magnitude = std::max(std::fabs(z[j]), scale);
            converged = converged && step <= std::max(k_converged * std::fabs(z[j]), 4.0 * workspace.probe(j));
            lost = lost || workspace.probe(j) > k_lost * magnitude;
            size = magnitude == 0.0 ? size : std::max(size, step / magnitude);
        }
        // Newton's steps shrink quadratically at a single solution. Steps that only halve tell a double one, where
        // there are no sensitivity coefficients.
        // At a double solution the derivative vanishes with the residual, and each step is half of the one before: 0.5
        // lies above the 0.3, near a single solution the ratio goes to 0.
        linear = last_was_whole && size > 0.3 * last_size && size < 1e-3 ? linear + 1 : 0;
        if (linear >= k_linear_steps || (converged && lost)) {
            return Search::singular;
        }
        // This step is taken as well: it is at hand, and leaves an error of its square.
        if (converged) {
            for (Eigen::Index j = 0; j < u; ++j) {
                z[j] += workspace.step(j);
                workspace.unknowns[index(j)] = z[j];
            }
            return Search::converged;
        }
        last_size = size;
        // The same inverse is applied to the residual at the shortened step: what it gives is the next correction as
        // seen from here, in the units of the unknowns. A step of length λ should leave 1 − λ of it; a quarter of that
        // is asked for.
        double length = 1.0;
        for (;; length *= 0.5) {
            if (length < k_shortest_step) {
                std::copy(workspace.unknowns.begin(), workspace.unknowns.end(), z);
                return Search::not_converged;
            }
            for (Eigen::Index j = 0; j < u; ++j) {
                z[j] = workspace.unknowns[index(j)] + length * workspace.step(j);
            }
            tape.values(workspace.tape, 0, steps);
            if (!tape.is_finite(workspace.tape, steps)) {
                continue;
            }
            for (Eigen::Index i = 0; i < u; ++i) {
                workspace.residual(i) = residual_value(i);
            }
            workspace.probe.noalias() = workspace.inverse * workspace.residual;
            double next_size = 0.0;
            for (Eigen::Index j = 0; j < u; ++j) {
                const double magnitude = std::max(std::fabs(workspace.unknowns[index(j)]), workspace.scale[index(j)]);
                next_size =
                    magnitude == 0.0 ? next_size : std::max(next_size, std::fabs(workspace.probe(j)) / magnitude);
            }
            // Steps as small as rounding are taken as they are.
            if (next_size <= (1.0 - 0.25 * length) * size || size < 1e-13) {
                break;
            }
        }
        last_was_whole = length == 1.0;
        std::copy(z, z + u, workspace.unknowns.begin());
    }
    // Steps that were only halving at the end point to a double solution, which more steps would approach without an
    // end.
    return linear >= 3 ? Search::singular : Search::not_converged;
}

std::string EquationSystem::Compiled::step_place(std::size_t step) const {
    const StepOrigin& origin = tape.origins()[step];
    const SyntaxTree& tree = trees[origin.equation];
    return place(tree.where, tree.nodes[origin.node].column);
}

/// "ln(a - b)" at -2
std::string EquationSystem::Compiled::step_text(const Workspace& workspace, std::size_t step) const {
    const StepOrigin& origin = tape.origins()[step];
    const TapeStep& operation = tape.steps()[step];
    const SyntaxTree& tree = trees[origin.equation];
    const auto value = [&](std::int32_t slot) {
        return text::shortest(workspace.tape.value[static_cast<std::size_t>(slot)]);
    };
    std::string text = "\"" + tree.excerpt(tree.nodes[origin.node]) + "\" of " + value(operation.a);
    if (is_binary(operation.operation)) {
        text += " and " + value(operation.b);
    }
    return text + " (coherent SI units)";
}

Diagnostic EquationSystem::Compiled::why_not_finite(const Workspace& workspace, std::size_t last) const {
    for (std::size_t i = 0; i < inputs() + unknowns(); ++i) {
        if (!std::isfinite(workspace.tape.value[i])) {
            const std::string& name = i < inputs() ? input_names[i] : unknown_names[i - inputs()];
            return {.code = "GC-MODEL-0060",
                    .where = name,
                    .what = "the value is not finite",
                    .rule = "a model is evaluated at finite values",
                    .action = "Correct the input."};
        }
    }
    for (std::size_t k = 0; k < last; ++k) {
        if (!std::isfinite(workspace.tape.value[tape.first_step_slot() + k])) {
            return {.code = "GC-MODEL-0060",
                    .where = step_place(k),
                    .what = step_text(workspace, k) + " has no finite value",
                    .rule = "every operation of the model has a finite value at the estimates",
                    .action = "Correct the equation, or the values of its inputs."};
        }
    }
    return {.code = "GC-MODEL-0060",
            .where = "model",
            .what = "the values are too large",
            .rule = "every operation of the model has a finite value at the estimates",
            .action = "Correct the equation, or the values of its inputs."};
}

Diagnostic EquationSystem::Compiled::why_no_derivative(const Workspace& workspace, std::size_t last,
                                                       bool second) const {
    for (std::size_t k = 0; k < last; ++k) {
        const TapeStep& step = tape.steps()[k];
        const bool a = !tape.is_constant(step.a);
        const bool b = !tape.is_constant(step.b);
        const bool first_exists =
            (!a || std::isfinite(workspace.tape.da[k])) && (!b || std::isfinite(workspace.tape.db[k]));
        const bool second_exists =
            !second || ((!a || std::isfinite(workspace.tape.daa[k])) && (!b || std::isfinite(workspace.tape.dbb[k])) &&
                        (!a || !b || std::isfinite(workspace.tape.dab[k])));
        if (first_exists && second_exists) {
            continue;
        }
        const bool tie = step.operation == Operation::absolute || step.operation == Operation::minimum ||
                         step.operation == Operation::maximum;
        if (tie) {
            return {.code = "GC-MODEL-0063",
                    .where = step_place(k),
                    .what = step_text(workspace, k) + " has different derivatives to the left and to the right",
                    .rule = "the law of propagation needs the derivative of the model at the estimates",
                    .action = "Use Monte Carlo, or write the branch that applies."};
        }
        return {.code = "GC-MODEL-0064",
                .where = step_place(k),
                .what = step_text(workspace, k) + " has no finite " + (first_exists ? "second " : "") + "derivative",
                .rule = "the law of propagation needs the derivatives of the model at the estimates",
                .action = "Use Monte Carlo, or write the model in another form."};
    }
    return {.code = "GC-MODEL-0064",
            .where = "model",
            .what = "a derivative is too large to be represented",
            .rule = "the law of propagation needs the derivatives of the model at the estimates",
            .action = "Check the values and units of the inputs."};
}

Diagnostic EquationSystem::Compiled::why_no_solution(const Workspace& workspace, Search outcome) const {
    const std::string where = place(trees[implicit.front()].where, 1);
    std::string values;
    for (std::size_t i = 0; i < unknowns(); ++i) {
        values += (values.empty() ? "" : ", ") + unknown_names[i] + " = " + text::shortest(workspace.unknowns[i]);
    }
    values += " (coherent SI units)";
    if (outcome == Search::singular) {
        return {
            .code = "GC-MODEL-0062",
            .where = where,
            .what = "the equations do not determine the unknowns at " + values,
            .rule = "at the solution the equations change with each unknown on its own (no double solution)",
            .action =
                "Choose other start values; if that does not help, the model has no sensitivity coefficients here."};
    }
    return {.code = "GC-MODEL-0061",
            .where = where,
            .what = "the search for a solution does not converge; it ended at " + values,
            .rule = "Newton's method reaches a solution from the start values",
            .action = "Choose start values near the solution, and check that there is one."};
}

void EquationSystem::Compiled::run(Workspace& workspace, const Eigen::VectorXd& x, bool partials, bool second) const {
    set_inputs(workspace, x);
    if (unknowns() != 0) {
        const Search outcome = search(workspace, start.data());
        if (outcome == Search::no_value) {
            throw NoResultError(why_not_finite(workspace, tape.residual_step_count()));
        }
        // Told as what it is: a step of the equations without a derivative, with its place, and not "singular".
        if (outcome == Search::singular && !workspace.slope.allFinite()) {
            throw NoResultError(why_no_derivative(workspace, tape.residual_step_count(), false));
        }
        if (outcome != Search::converged) {
            throw NoResultError(why_no_solution(workspace, outcome));
        }
    }
    if (partials) {
        tape.values_and_partials(workspace.tape, 0, tape.step_count(), second);
    } else {
        tape.values(workspace.tape, 0, tape.step_count());
    }
    if (!tape.is_finite(workspace.tape, tape.step_count())) {
        throw NoResultError(why_not_finite(workspace, tape.step_count()));
    }
}

Eigen::VectorXd EquationSystem::evaluate(const Eigen::VectorXd& x) const {
    Workspace& workspace = workspace_of_thread();
    compiled_->run(workspace, x, false, false);
    const Tape& tape = compiled_->tape;
    Eigen::VectorXd y(static_cast<Eigen::Index>(output_count()));
    for (std::size_t i = 0; i < output_count(); ++i) {
        y(static_cast<Eigen::Index>(i)) =
            workspace.tape.value[static_cast<std::size_t>(tape.roots()[tape.residual_count() + i])];
    }
    return y;
}

Eigen::VectorXd EquationSystem::rounding(const Eigen::VectorXd& x) const {
    Workspace& workspace = workspace_of_thread();
    compiled_->run(workspace, x, true, false);
    const Tape& tape = compiled_->tape;
    const std::size_t base = tape.first_step_slot();
    Eigen::VectorXd lost = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(output_count()));
    for (std::size_t i = 0; i < output_count(); ++i) {
        TapeWorkspace& at = workspace.tape;
        std::fill(at.adjoint.begin(), at.adjoint.end(), 0.0);  // a sweep leaves the steps that it does not meet alone
        tape.gradient(at, tape.residual_count() + i);
        double sum = 0.0;
        for (std::size_t slot = 0; slot < base + tape.step_count(); ++slot) {
            if (slot < compiled_->inputs() || slot >= base) {
                sum += std::fabs(at.adjoint[slot]) * decimal_rounding(at.value[slot]);
            }
        }
        lost(static_cast<Eigen::Index>(i)) = sum;
    }
    return lost;
}

Eigen::VectorXd EquationSystem::solve(const Eigen::VectorXd& x) const {
    Workspace& workspace = workspace_of_thread();
    compiled_->run(workspace, x, false, false);
    return Eigen::Map<const Eigen::VectorXd>(workspace.tape.value.data() + compiled_->inputs(),
                                             static_cast<Eigen::Index>(compiled_->unknowns()));
}

namespace {

/// First derivatives of the roots [first, last) by all leaves, one a row.
Eigen::MatrixXd gradients(const Tape& tape, TapeWorkspace& workspace, std::size_t first, std::size_t last) {
    const auto leaves = static_cast<Eigen::Index>(tape.leaf_count());
    Eigen::MatrixXd result(static_cast<Eigen::Index>(last - first), leaves);
    for (std::size_t root = first; root < last; ++root) {
        tape.gradient(workspace, root);
        result.row(static_cast<Eigen::Index>(root - first)) =
            Eigen::Map<const Eigen::RowVectorXd>(workspace.adjoint.data(), leaves);
    }
    return result;
}

}  // namespace

Eigen::MatrixXd EquationSystem::jacobian(const Eigen::VectorXd& x) const {
    Workspace& workspace = workspace_of_thread();
    compiled_->run(workspace, x, true, false);
    const Tape& tape = compiled_->tape;
    const std::size_t residuals = tape.residual_count();
    Eigen::MatrixXd result = gradients(tape, workspace.tape, residuals, tape.roots().size());
    if (residuals != 0) {
        const auto n = static_cast<Eigen::Index>(compiled_->inputs());
        const auto u = static_cast<Eigen::Index>(residuals);
        const Eigen::MatrixXd slopes = gradients(tape, workspace.tape, 0, residuals);
        // Columns: ∂F/∂x, then ∂F/∂z.
        workspace.slope = slopes.rightCols(u);
        if (!compiled_->invert_slope(workspace)) {
            throw NoResultError(compiled_->why_no_solution(workspace, Search::singular));
        }
        const Eigen::MatrixXd sensitivity = -workspace.inverse * slopes.leftCols(n);
        result = (result.leftCols(n) + result.rightCols(u) * sensitivity).eval();
    }
    if (!result.allFinite()) {
        throw NoResultError(compiled_->why_no_derivative(workspace, tape.step_count(), false));
    }
    return result;
}

std::vector<Eigen::MatrixXd> EquationSystem::hessians(const Eigen::VectorXd& x) const {
    Workspace& workspace = workspace_of_thread();
    compiled_->run(workspace, x, true, true);
    const Tape& tape = compiled_->tape;
    const std::size_t residuals = tape.residual_count();
    std::vector<Eigen::MatrixXd> all = tape.second_derivatives(workspace.tape);
    std::vector<Eigen::MatrixXd> result(all.begin() + static_cast<std::ptrdiff_t>(residuals), all.end());
    if (residuals != 0) {
        // F(x, z(x)) = 0 differentiated twice along S = (I; ∂z/∂x):  Sᵀ F″ S + ∂F/∂z · z″ = 0.
        const auto n = static_cast<Eigen::Index>(compiled_->inputs());
        const auto u = static_cast<Eigen::Index>(residuals);
        const Eigen::MatrixXd slopes = gradients(tape, workspace.tape, 0, residuals);
        const Eigen::MatrixXd output_slopes = gradients(tape, workspace.tape, residuals, tape.roots().size());
        workspace.slope = slopes.rightCols(u);
        if (!compiled_->invert_slope(workspace)) {
            throw NoResultError(compiled_->why_no_solution(workspace, Search::singular));
        }
        Eigen::MatrixXd along(n + u, n);
        along.topRows(n).setIdentity();
        along.bottomRows(u) = -workspace.inverse * slopes.leftCols(n);
        std::vector<Eigen::MatrixXd> bent(residuals);
        for (std::size_t k = 0; k < residuals; ++k) {
            bent[k] = along.transpose() * all[k] * along;
        }
        for (std::size_t i = 0; i < result.size(); ++i) {
            Eigen::MatrixXd total = along.transpose() * result[i] * along;
            // y″ = Sᵀ g″ S + ∂g/∂z z″ with z″ = −(∂F/∂z)⁻¹ Sᵀ F″ S: the row ∂g/∂z (∂F/∂z)⁻¹ is formed once for all F_k.
            const Eigen::RowVectorXd weights =
                output_slopes.row(static_cast<Eigen::Index>(i)).tail(u) * workspace.inverse;
            for (std::size_t k = 0; k < residuals; ++k) {
                total -= weights(static_cast<Eigen::Index>(k)) * bent[k];
            }
            result[i] = (0.5 * (total + total.transpose())).eval();
        }
    }
    for (const Eigen::MatrixXd& matrix : result) {
        if (!matrix.allFinite()) {
            throw NoResultError(compiled_->why_no_derivative(workspace, tape.step_count(), true));
        }
    }
    return result;
}

void EquationSystem::evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y,
                                     const Eigen::VectorXd& start) const {
    assert(x.rows() == y.rows() && y.cols() == static_cast<Eigen::Index>(output_count()));
    compiled_->check_size(x.cols());
    const Tape& tape = compiled_->tape;
    if (compiled_->unknowns() == 0) {
        tape.trials(x, y);
        return;
    }
    Workspace& workspace = workspace_of_thread();
    tape.prepare(workspace.tape);
    // Every trial starts from the same point: its result does not depend on the trial before it.
    const double* const first = start.size() == 0 ? compiled_->start.data() : start.data();
    for (Eigen::Index trial = 0; trial < x.rows(); ++trial) {
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            workspace.tape.value[static_cast<std::size_t>(i)] = x(trial, i);
        }
        bool good = compiled_->search(workspace, first) == Search::converged;
        if (good) {
            tape.values(workspace.tape, 0, tape.step_count());
            good = tape.is_finite(workspace.tape, tape.step_count());
        }
        for (Eigen::Index i = 0; i < y.cols(); ++i) {
            const std::int32_t root = tape.roots()[tape.residual_count() + static_cast<std::size_t>(i)];
            y(trial, i) =
                good ? workspace.tape.value[static_cast<std::size_t>(root)] : std::numeric_limits<double>::quiet_NaN();
        }
    }
}

bool EquationSystem::has_choices() const {
    return compiled_->tape.has_choices();
}

void EquationSystem::evaluate_as_chosen(const Eigen::VectorXd& estimates, const Eigen::Ref<const Eigen::MatrixXd>& x,
                                        Eigen::Ref<Eigen::MatrixXd> y, const Eigen::VectorXd& start) const {
    assert(x.rows() == y.rows() && y.cols() == static_cast<Eigen::Index>(output_count()));
    compiled_->check_size(x.cols());
    const Tape& tape = compiled_->tape;
    Workspace& workspace = workspace_of_thread();
    compiled_->run(workspace, estimates, false, false);
    std::vector<bool> varying(tape.leaf_count(), true);  // unknowns do
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        varying[static_cast<std::size_t>(i)] = (x.col(i).array() != x(0, i)).any();
    }
    const std::vector<Choice> chosen = tape.choices(workspace.tape, varying);
    const std::size_t implicit = tape.residual_step_count();
    const double* const first = start.size() == 0 ? compiled_->start.data() : start.data();
    for (Eigen::Index trial = 0; trial < x.rows(); ++trial) {
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            workspace.tape.value[static_cast<std::size_t>(i)] = x(trial, i);
        }
        bool same = true;
        if (compiled_->unknowns() != 0) {
            same = compiled_->search(workspace, first) == Search::converged;
            tape.values(workspace.tape, 0, tape.step_count());
            const std::vector<Choice> here = tape.choices(workspace.tape, varying);
            same =
                same && std::equal(here.begin(), here.begin() + static_cast<std::ptrdiff_t>(implicit), chosen.begin());
        }
        tape.values_as_chosen(workspace.tape, chosen);
        for (Eigen::Index i = 0; i < y.cols(); ++i) {
            const std::int32_t root = tape.roots()[tape.residual_count() + static_cast<std::size_t>(i)];
            y(trial, i) =
                same ? workspace.tape.value[static_cast<std::size_t>(root)] : std::numeric_limits<double>::quiet_NaN();
        }
    }
}

}  // namespace gumcert::gum
