#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::gum {

/// Limits of the equation language, against input that is made to exhaust memory or stack.
struct ExpressionLimits {
    std::size_t bytes = 65536;    ///< one equation
    std::size_t depth = 200;      ///< parentheses, signs, powers and calls inside each other
    std::size_t nodes = 100'000;  ///< all equations together
};

/// An equation as the job gives it, and the place to name in messages.
struct EquationText {
    std::string text;   ///< "l = l_s + d", or "0 = expression" of an implicit model
    std::string where;  ///< e.g. "budget.json#/model/0 (line 2, column 15)"
};

/// A quantity that the equations may use.
struct InputSymbol {
    std::string name;
    Unit unit;
    std::optional<double> constant;  ///< its value, coherent SI, when it is a constant: it may then be an exponent
    std::string where = {};          ///< place to name in messages; "input NAME" where it is empty
};

/// An unknown of the implicit equations.
struct UnknownSymbol {
    std::string name;
    double start = 0.0;  ///< where the search begins, coherent SI
    Unit unit;
};

/// A quantity that is asked for. Without a unit it has one that its inputs use, or else the SI unit of its dimension by
/// its name (ohm, V, N …), or else the coherent one.
struct OutputSymbol {
    std::string name;
    std::optional<Unit> unit;
    std::string where;
};

/// Equations of a measurement model, checked, put in order and compiled (VIM 2.49).
///
/// Grammar:  equation = name "=" sum | "0" "=" sum;   sum = product { ("+" | "-") product };
///           product = signed { ("*" | "/") signed };   signed = { "+" | "-" } power;   power = atom [ "^" signed ];
///           atom = number | name | function "(" sum { "," sum } ")" | "(" sum ")".
/// "^" binds to the right and closer than a sign on its left: -2^2 is -4, 2^-1 is a half. Names: letter or _, then
/// letters, digits, subscript digits, _ and '; letters of other scripts are allowed, look-alikes of ASCII in one name
/// are refused, and so are two names that look the same. Accents are part of their letter (Unicode normalisation form
/// C): combining marks are refused. The micro sign and μ are one letter, and so are the ohm sign and Ω. Functions: sqrt
/// exp ln log (= ln) log10 sin cos tan asin acos atan atan2 sinh cosh tanh abs min max pow hypot, and celsius(T),
/// kelvin(t), which turn thermodynamic into Celsius temperature and back. Constants: pi, and rad = 1 rad unless an
/// input has that name. Names of functions and pi cannot be names of quantities.
///
/// Units: every sum balances; arguments of exp, ln … are numbers; sin, cos, tan take an angle and asin, acos, atan,
/// atan2 give one; an exponent is a number, and a constant one where its base has a unit. Celsius temperatures (kind):
/// t1 − t2 and t − t is a difference in K; t + ΔT is a Celsius temperature; a sum of a Celsius and a thermodynamic
/// temperature that is neither is refused where the result is declared (see the messages).
///
/// The literal 0 is 0 in every unit. A constant input in an exponent stands there with its constant value: the exponent
/// is not varied with it, and has no sensitivity coefficient.
///
/// Evaluation is by one tape of elementary operations: no recursion, no allocation after the first call of a workspace.
/// An object never changes after compile(); threads may share it.
/// Accuracy: values to the last bit of the operations as they are written, derivatives by exact rules: 1e-12 of first,
/// 1e-10 of second ones (docs/accuracy.md#equations-and-their-derivatives).
/// Example: examples/api/budget_by_hand.cpp
class EquationSystem {
public:
    /// \throws InputError  with every problem: syntax (GC-MODEL-0001 …), names and order (GC-MODEL-0019 …; a cycle is
    ///                     printed: "a → b → a"), units (GC-MODEL-0030 …)
    [[nodiscard]] static EquationSystem compile(std::span<const EquationText> equations,
                                                std::span<const InputSymbol> inputs,
                                                std::span<const UnknownSymbol> unknowns = {},
                                                std::span<const OutputSymbol> outputs = {},
                                                const ExpressionLimits& limits = {});

    [[nodiscard]] std::size_t input_count() const;
    [[nodiscard]] std::size_t output_count() const;
    /// Outputs in the order asked for; when none were asked for: every left-hand side that no other equation uses, and
    /// every unknown that no equation with a left-hand side uses, in the order of the equations.
    [[nodiscard]] const std::string& output_name(std::size_t output) const;
    [[nodiscard]] const Unit& output_unit(std::size_t output) const;
    /// What is accepted, and a person should look at: Celsius temperatures in quotients, roots and powers
    /// (GC-MODEL-0040), results proportional to one (-0041), `log` (-0042).
    [[nodiscard]] const std::vector<Diagnostic>& warnings() const;
    /// Inputs that no output depends on (a warning on the draft).
    [[nodiscard]] const std::vector<std::size_t>& unused_inputs() const;
    /// Whether the equations behind an output use an input, for each input: of implicit equations all that stands in them.
    [[nodiscard]] std::vector<bool> inputs_of(std::size_t output) const;
    /// True when every output is an affine function of these inputs, the others held: no second derivative.
    [[nodiscard]] bool is_affine_in(std::span<const std::size_t> inputs) const;
    /// The same of one output.
    [[nodiscard]] bool is_affine_in(std::span<const std::size_t> inputs, std::size_t output) const;

    [[nodiscard]] std::size_t unknown_count() const;

    /// \param x  n inputs, coherent SI
    /// \return m outputs, coherent SI
    /// \throws NoResultError  GC-MODEL-0060 an operation without a finite value (which equation, what, at which values:
    ///     division by zero, logarithm of a negative number), -0061 implicit equations that do not converge, -0062
    ///     singular ones, and double solutions
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const;
    /// m×n, exact (no differences; implicit models by the theorem of implicit functions).
    /// \throws NoResultError  as evaluate(); GC-MODEL-0063 at min and max of equal arguments and abs of 0, where only
    ///                        one-sided derivatives are defined; -0064 where a derivative is not finite (sqrt of 0)
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const;
    /// m symmetric matrices n×n, exact. Errors as jacobian().
    [[nodiscard]] std::vector<Eigen::MatrixXd> hessians(const Eigen::VectorXd& x) const;
    /// How far each output may be off because inputs and intermediate values are rounded to double precision: Σ |∂y/∂v|
    /// of every input and step v times its decimal_rounding(). Large values that cancel show here. Of an implicit
    /// model, the steps behind its unknowns only. Errors as jacobian().
    [[nodiscard]] Eigen::VectorXd rounding(const Eigen::VectorXd& x) const;
    /// The unknowns of an implicit model, coherent SI; nothing of an explicit one. Errors as evaluate().
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& x) const;

    /// Many trials at once; see MeasurementModel::evaluate_trials. Trials whose operation has no finite value, and
    /// those whose implicit equations do not converge, get NaN in every output. Explicit models give what evaluate()
    /// gives, to the last bit.
    /// \param start  where the search for the unknowns begins in every trial, e.g. solve(estimates); empty: the start
    ///     values that were declared
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y,
                         const Eigen::VectorXd& start = {}) const;

    /// True when the equations have a max, min or abs.
    [[nodiscard]] bool has_choices() const;
    /// As evaluate_trials(), but every max, min and abs takes the operand, or the sign, that it takes at `estimates`,
    /// whichever would be chosen in the trial: the model without the kinks. A max or min with a value that is the same in all
    /// trials, as max(x, 0), keeps to a limit and is taken as it is. NaN where implicit equations choose otherwise, or have
    /// no solution; where an operation has no finite value, whatever follows from that.
    /// \throws NoResultError  as evaluate(), at the estimates
    void evaluate_as_chosen(const Eigen::VectorXd& estimates, const Eigen::Ref<const Eigen::MatrixXd>& x,
                            Eigen::Ref<Eigen::MatrixXd> y, const Eigen::VectorXd& start = {}) const;

private:
    struct Compiled;
    explicit EquationSystem(std::shared_ptr<const Compiled> compiled) : compiled_(std::move(compiled)) {}
    std::shared_ptr<const Compiled> compiled_;
};

/// The names that an equation defines and uses, without compiling: for readers that need them early. Names of functions
/// and pi are left out, rad is not. They are in the form in which names are compared (canonical_name() in name.h).
struct EquationNames {
    std::string defines;  ///< empty for "0 = …"
    std::vector<std::string> uses;
};
/// \throws InputError  with every syntax problem
[[nodiscard]] EquationNames equation_names(const EquationText& equation, const ExpressionLimits& limits = {});

/// The expression as text again, with the fewest parentheses: parsed again it gives the same tree.
[[nodiscard]] std::string equation_text(const EquationText& equation, const ExpressionLimits& limits = {});

}  // namespace gumcert::gum
