#include "gum/expression/tape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace gumcert::gum {

// Derivatives are those of the rules of calculus, step by step, not differences.
// First ones by a reverse sweep: from the root back, each step passes its adjoint w = ∂root/∂v on to its operands, w
// ∂v/∂a and w ∂v/∂b. One sweep gives the derivatives by all leaves, and a model has many inputs and few outputs.
// Second ones by the derivative of that sweep in the direction of each leaf (forward over reverse): tangents ∂v/∂x_j
// forwards, then adjoints and their tangents backwards. One leaf gives one column of the matrix.
// Trials run step by step over columns of 256 of them: each step is decoded once for all of them.

namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_ln_10 = 2.302585092994045684;
constexpr int k_largest_product_power = 64;        // above, pow() is more accurate than a chain of products
constexpr Eigen::Index k_trials_in_a_chunk = 256;  // 2 KiB a column: a dozen of them stay in the first-level cache

std::size_t at(std::int32_t slot) {
    return static_cast<std::size_t>(slot);
}

/// d·t, but 0 where t is 0: a derivative that does not exist is harmless in a direction in which nothing moves.
double times(double d, double t) {
    return t == 0.0 ? 0.0 : d * t;
}

struct First {
    double a = 0.0, b = 0.0;
};
struct Second {
    double aa = 0.0, ab = 0.0, bb = 0.0;
};

template <Operation operation>
First first_partials(double a, double b, double v) {
    using enum Operation;
    if constexpr (operation == negate) {
        return {-1.0};
    } else if constexpr (operation == absolute) {
        return {a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : k_nan};
    } else if constexpr (operation == Operation::sqrt) {
        return {0.5 / v};
    } else if constexpr (operation == Operation::exp) {
        return {v};
    } else if constexpr (operation == ln) {
        return {1.0 / a};
    } else if constexpr (operation == Operation::log10) {
        return {1.0 / (a * k_ln_10)};
    } else if constexpr (operation == Operation::sin) {
        return {std::cos(a)};
    } else if constexpr (operation == Operation::cos) {
        return {-std::sin(a)};
    } else if constexpr (operation == Operation::tan) {
        return {1.0 + v * v};
    } else if constexpr (operation == Operation::asin) {
        // (1 − a)(1 + a): 1 − a² loses the digits of an a near 1.
        return {1.0 / std::sqrt((1.0 - a) * (1.0 + a))};
    } else if constexpr (operation == Operation::acos) {
        return {-1.0 / std::sqrt((1.0 - a) * (1.0 + a))};
    } else if constexpr (operation == Operation::atan) {
        return {1.0 / (1.0 + a * a)};
    } else if constexpr (operation == Operation::sinh) {
        return {std::cosh(a)};
    } else if constexpr (operation == Operation::cosh) {
        return {std::sinh(a)};
    } else if constexpr (operation == Operation::tanh) {
        const double c = 1.0 / std::cosh(a);  // 1 − v² would lose digits
        return {c * c};
    } else if constexpr (operation == add) {
        return {1.0, 1.0};
    } else if constexpr (operation == subtract) {
        return {1.0, -1.0};
    } else if constexpr (operation == multiply) {
        return {b, a};
    } else if constexpr (operation == divide) {
        // v/b and not a/b²: b² may leave the range of numbers where the quotient does not.
        return {1.0 / b, -v / b};
    } else if constexpr (operation == power) {
        // By the base b a^(b−1); by the exponent a^b ln a, whose limit at a = 0 is 0 for b > 0 and does not exist else.
        return {b == 0.0 ? 0.0 : b * std::pow(a, b - 1.0), a == 0.0 ? (b > 0.0 ? 0.0 : k_nan) : v * std::log(a)};
    } else if constexpr (operation == Operation::atan2) {
        // b/h² in two quotients, for the same reason.
        const double h = std::hypot(a, b);
        return {b / h / h, -a / h / h};
    } else if constexpr (operation == minimum) {
        return a < b ? First{1.0, 0.0} : b < a ? First{0.0, 1.0} : First{k_nan, k_nan};
    } else if constexpr (operation == maximum) {
        return a > b ? First{1.0, 0.0} : b > a ? First{0.0, 1.0} : First{k_nan, k_nan};
    } else if constexpr (operation == Operation::hypot) {
        return {a / v, b / v};
    } else {
        return {k_nan, k_nan};
    }
}

template <Operation operation>
Second second_partials(double a, double b, double v, const First& d) {
    using enum Operation;
    if constexpr (operation == Operation::sqrt) {
        return {-0.25 / (a * v)};
    } else if constexpr (operation == Operation::exp || operation == Operation::sinh || operation == Operation::cosh) {
        return {v};
    } else if constexpr (operation == ln) {
        return {-1.0 / (a * a)};
    } else if constexpr (operation == Operation::log10) {
        return {-1.0 / (a * a * k_ln_10)};
    } else if constexpr (operation == Operation::sin || operation == Operation::cos) {
        return {-v};
    } else if constexpr (operation == Operation::tan) {
        return {2.0 * v * d.a};
    } else if constexpr (operation == Operation::asin || operation == Operation::acos) {
        // ± a/√(1 − a²)³; the cube of the first derivative brings the sign.
        return {a * d.a * d.a * d.a};
    } else if constexpr (operation == Operation::atan) {
        return {-2.0 * a * d.a * d.a};
    } else if constexpr (operation == Operation::tanh) {
        return {-2.0 * v * d.a};
    } else if constexpr (operation == absolute || operation == minimum || operation == maximum) {
        const double none = std::isnan(d.a) ? k_nan : 0.0;  // at a tie there is no second derivative either
        return {none, none, none};
    } else if constexpr (operation == multiply) {
        return {0.0, 1.0, 0.0};
    } else if constexpr (operation == divide) {
        return {0.0, -1.0 / (b * b), 2.0 * v / (b * b)};
    } else if constexpr (operation == power) {
        const double coefficient = b * (b - 1.0);
        Second second;
        second.aa = coefficient == 0.0 ? 0.0 : coefficient * std::pow(a, b - 2.0);
        if (a == 0.0) {
            second.ab = b > 1.0 ? 0.0 : k_nan;
            second.bb = b > 0.0 ? 0.0 : k_nan;
        } else {
            second.ab = std::pow(a, b - 1.0) * (1.0 + b * std::log(a));
            second.bb = d.b * std::log(a);
        }
        return second;
    } else if constexpr (operation == Operation::atan2) {
        return {2.0 * d.a * d.b, d.b * d.b - d.a * d.a, -2.0 * d.a * d.b};
    } else if constexpr (operation == Operation::hypot) {
        return {d.b * d.b / v, -d.a * d.b / v, d.a * d.a / v};
    } else {
        return {};
    }
}

using ConstColumn = Eigen::Map<const Eigen::ArrayXd>;
using Column = Eigen::Map<Eigen::ArrayXd>;

/// One step for a chunk of trials. The four rules of arithmetic and the root go through Eigen's packets; they are
/// rounded correctly, so that a packet gives what apply() gives.
template <Operation operation>
void run_unary(const double* a, double* result, Eigen::Index n) {
    const ConstColumn column(a, n);
    if constexpr (operation == Operation::negate) {
        Column(result, n) = -column;
    } else if constexpr (operation == Operation::absolute) {
        Column(result, n) = column.abs();
    } else if constexpr (operation == Operation::sqrt) {
        Column(result, n) = column.sqrt();
    } else {
        for (Eigen::Index i = 0; i < n; ++i) {
            result[i] = apply<operation>(a[i], 0.0);
        }
    }
}

template <Operation operation, class A, class B>
void run_arithmetic(const A& a, const B& b, double* result, Eigen::Index n) {
    if constexpr (operation == Operation::add) {
        Column(result, n) = a + b;
    } else if constexpr (operation == Operation::subtract) {
        Column(result, n) = a - b;
    } else if constexpr (operation == Operation::multiply) {
        Column(result, n) = a * b;
    } else {
        Column(result, n) = a / b;
    }
}

template <Operation operation>
void run_binary(const double* a, double a_number, const double* b, double b_number, double* result, Eigen::Index n) {
    if constexpr (operation == Operation::add || operation == Operation::subtract || operation == Operation::multiply ||
                  operation == Operation::divide) {
        if (a == nullptr) {
            run_arithmetic<operation>(Eigen::ArrayXd::Constant(n, a_number), ConstColumn(b, n), result, n);
        } else if (b == nullptr) {
            run_arithmetic<operation>(ConstColumn(a, n), Eigen::ArrayXd::Constant(n, b_number), result, n);
        } else {
            run_arithmetic<operation>(ConstColumn(a, n), ConstColumn(b, n), result, n);
        }
    } else if (a == nullptr) {
        for (Eigen::Index i = 0; i < n; ++i) {
            result[i] = apply<operation>(a_number, b[i]);
        }
    } else if (b == nullptr) {
        for (Eigen::Index i = 0; i < n; ++i) {
            result[i] = apply<operation>(a[i], b_number);
        }
    } else {
        for (Eigen::Index i = 0; i < n; ++i) {
            result[i] = apply<operation>(a[i], b[i]);
        }
    }
}

/// Operands that may be infinite or NaN while the result is an ordinary number: 1/∞, atan ∞, min(NaN, 1) …
bool hides_a(Operation operation) {
    using enum Operation;
    return operation == Operation::exp || operation == Operation::atan || operation == Operation::tanh ||
           operation == power || operation == Operation::atan2 || operation == minimum || operation == maximum;
}
bool hides_b(Operation operation) {
    using enum Operation;
    return operation == divide || operation == power || operation == Operation::atan2 || operation == minimum ||
           operation == maximum;
}

}  // namespace

bool Tape::is_constant(std::int32_t slot) const {
    return (at(slot) >= leaf_count_ && at(slot) < first_step_slot()) || at(slot) == first_step_slot() + steps_.size();
}

void Tape::prepare(TapeWorkspace& workspace) const {
    const std::size_t slots = first_step_slot() + steps_.size() + 1;
    const auto grow = [](std::vector<double>& memory, std::size_t size) {
        if (memory.size() < size) {
            memory.resize(size);
        }
    };
    grow(workspace.value, slots);
    grow(workspace.da, steps_.size());
    grow(workspace.db, steps_.size());
    grow(workspace.adjoint, slots);
    std::copy(constants_.begin(), constants_.end(), workspace.value.begin() + static_cast<std::ptrdiff_t>(leaf_count_));
    workspace.value[slots - 1] = 0.0;
}

void Tape::values(TapeWorkspace& workspace, std::size_t first, std::size_t last) const {
    double* const value = workspace.value.data();
    double* const result = value + first_step_slot();
    for (std::size_t k = first; k < last; ++k) {
        const TapeStep& step = steps_[k];
        result[k] = apply(step.operation, value[step.a], value[step.b]);
    }
}

bool Tape::has_choices() const {
    return std::any_of(steps_.begin(), steps_.end(), [](const TapeStep& step) { return is_choice(step.operation); });
}

std::vector<Choice> Tape::choices(const TapeWorkspace& workspace, const std::vector<bool>& varying) const {
    std::vector<bool> varies(first_step_slot() + steps_.size() + 1, false);
    std::copy(varying.begin(), varying.end(), varies.begin());
    std::vector<Choice> chosen(steps_.size(), Choice::none);
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        const auto [operation, slot_a, slot_b] = steps_[k];
        const double a = workspace.value[at(slot_a)];
        const double b = workspace.value[at(slot_b)];
        varies[first_step_slot() + k] = varies[at(slot_a)] || varies[at(slot_b)];
        if (operation == Operation::absolute) {
            chosen[k] = a < 0.0 ? Choice::second : Choice::first;
        } else if (is_choice(operation) && varies[at(slot_a)] && varies[at(slot_b)]) {
            chosen[k] = (operation == Operation::minimum ? b < a : b > a) ? Choice::second : Choice::first;
        }
    }
    return chosen;
}

void Tape::values_as_chosen(TapeWorkspace& workspace, const std::vector<Choice>& choices) const {
    double* const value = workspace.value.data();
    double* const result = value + first_step_slot();
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        const TapeStep& step = steps_[k];
        const double a = value[step.a];
        const double b = value[step.b];
        result[k] = choices[k] == Choice::none              ? apply(step.operation, a, b)
                    : choices[k] == Choice::first           ? a
                    : step.operation == Operation::absolute ? -a
                                                            : b;
    }
}

void Tape::values_and_partials(TapeWorkspace& workspace, std::size_t first, std::size_t last, bool second) const {
    if (second && workspace.daa.size() < steps_.size()) {
        workspace.daa.resize(steps_.size());
        workspace.dab.resize(steps_.size());
        workspace.dbb.resize(steps_.size());
    }
    double* const value = workspace.value.data();
    double* const result = value + first_step_slot();
    for (std::size_t k = first; k < last; ++k) {
        const TapeStep& step = steps_[k];
        const double a = value[step.a];
        const double b = value[step.b];
        visit_step(step.operation, [&]<Operation operation>() {
            const double v = apply<operation>(a, b);
            const First d = first_partials<operation>(a, b, v);
            result[k] = v;
            workspace.da[k] = d.a;
            workspace.db[k] = d.b;
            if (second) {
                const Second dd = second_partials<operation>(a, b, v, d);
                workspace.daa[k] = dd.aa;
                workspace.dab[k] = dd.ab;
                workspace.dbb[k] = dd.bb;
            }
        });
    }
}

double Tape::gradient(TapeWorkspace& workspace, std::size_t root) const {
    const std::size_t base = first_step_slot();
    const std::size_t slot = at(roots_[root]);
    double* const adjoint = workspace.adjoint.data();
    std::fill_n(adjoint, leaf_count_, 0.0);
    if (slot < base) {
        if (slot < leaf_count_) {
            adjoint[slot] = 1.0;
        }
        return 0.0;
    }
    const std::size_t lowest = lowest_[root];
    const std::size_t top = slot - base;
    // Steps before the first one that the root depends on are left alone: a budget of hundreds of results would
    // otherwise clear the whole tape for each.
    std::fill(adjoint + base + lowest, adjoint + slot, 0.0);
    adjoint[slot] = 1.0;
    double rounding = 0.0;
    for (std::size_t k = top + 1; k-- > lowest;) {
        const double w = adjoint[base + k];
        // What the root does not depend on here is passed over: its partials may be infinite, and 0·∞ would be NaN.
        if (w == 0.0) {
            continue;
        }
        const TapeStep& step = steps_[k];
        rounding += std::fabs(w * workspace.value[base + k]);
        adjoint[step.a] += w * workspace.da[k];
        adjoint[step.b] += w * workspace.db[k];
    }
    return rounding;
}

std::vector<Eigen::MatrixXd> Tape::second_derivatives(TapeWorkspace& workspace) const {
    const std::size_t base = first_step_slot();
    const std::size_t slots = base + steps_.size() + 1;
    const auto leaves = static_cast<Eigen::Index>(leaf_count_);
    std::vector<Eigen::MatrixXd> result(roots_.size(), Eigen::MatrixXd::Zero(leaves, leaves));
    workspace.tangent.assign(slots, 0.0);
    workspace.adjoint_tangent.assign(slots, 0.0);
    // Numbers of moving steps are summed up: whether one of a range moves is a difference of two sums.
    workspace.moving.assign(steps_.size() + 1, 0);
    double* const adjoint = workspace.adjoint.data();
    double* const tangent = workspace.tangent.data();
    double* const adjoint_tangent = workspace.adjoint_tangent.data();
    for (std::size_t j = 0; j < leaf_count_; ++j) {
        // Forward in the direction of leaf j …
        std::fill(tangent, tangent + slots, 0.0);
        tangent[j] = 1.0;
        for (std::size_t k = 0; k < steps_.size(); ++k) {
            const TapeStep& step = steps_[k];
            const double t = times(workspace.da[k], tangent[step.a]) + times(workspace.db[k], tangent[step.b]);
            tangent[base + k] = t;
            workspace.moving[k + 1] = workspace.moving[k] + (t == 0.0 ? 0 : 1);
        }
        // … and the derivative of the reverse sweep of each root in that direction.
        for (std::size_t root = 0; root < roots_.size(); ++root) {
            const std::size_t slot = at(roots_[root]);
            if (slot < base) {
                continue;
            }
            const std::size_t lowest = lowest_[root];
            const std::size_t top = slot - base;
            // Every path from leaf j to the root begins with a step that moves, or stands still to first order and has
            // no second derivative by a product: the sweep is needed only where a step of the root has j under it.
            if (workspace.moving[top + 1] == workspace.moving[lowest]) {
                bool touches = false;
                for (std::size_t k = lowest; k <= top && !touches; ++k) {
                    touches = at(steps_[k].a) == j || at(steps_[k].b) == j;
                }
                if (!touches) {
                    continue;
                }
            }
            std::fill_n(adjoint, leaf_count_, 0.0);
            std::fill_n(adjoint_tangent, leaf_count_, 0.0);
            std::fill(adjoint + base + lowest, adjoint + slot, 0.0);
            std::fill(adjoint_tangent + base + lowest, adjoint_tangent + slot + 1, 0.0);
            adjoint[slot] = 1.0;
            for (std::size_t k = top + 1; k-- > lowest;) {
                const double w = adjoint[base + k];
                const double wt = adjoint_tangent[base + k];
                if (w == 0.0 && wt == 0.0) {
                    continue;
                }
                const TapeStep& step = steps_[k];
                const double ta = tangent[step.a];
                const double tb = tangent[step.b];
                const double along_a = times(workspace.daa[k], ta) + times(workspace.dab[k], tb);
                const double along_b = times(workspace.dab[k], ta) + times(workspace.dbb[k], tb);
                adjoint[step.a] += times(workspace.da[k], w);
                adjoint[step.b] += times(workspace.db[k], w);
                adjoint_tangent[step.a] += times(workspace.da[k], wt) + times(along_a, w);
                adjoint_tangent[step.b] += times(workspace.db[k], wt) + times(along_b, w);
            }
            result[root].col(static_cast<Eigen::Index>(j)) = Eigen::Map<const Eigen::VectorXd>(adjoint_tangent, leaves);
        }
    }
    for (Eigen::MatrixXd& matrix : result) {
        matrix = (0.5 * (matrix + matrix.transpose())).eval();  // equal but for rounding
    }
    return result;
}

bool Tape::is_finite(const TapeWorkspace& workspace, std::size_t last) const {
    // x − x is 0 for every number and NaN for what is none: one sum, and no branch for each value.
    double sum = 0.0;  // of zeros, or NaN
    const std::size_t slots = first_step_slot() + last;
    for (std::size_t i = 0; i < slots; ++i) {
        sum += workspace.value[i] - workspace.value[i];
    }
    return sum == 0.0;
}

void Tape::plan_trials() {
    const std::size_t base = first_step_slot();
    const std::size_t outputs = roots_.size();
    constexpr std::size_t k_for_ever = std::numeric_limits<std::size_t>::max();
    // A value lives in a column until it is used for the last time; then the column is free for another one. So a block
    // of trials stays in the cache, however long the equations are.
    std::vector<std::size_t> last_use(steps_.size(), 0);
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        for (const std::int32_t slot : {steps_[k].a, steps_[k].b}) {
            if (at(slot) >= base && at(slot) < base + steps_.size()) {
                last_use[at(slot) - base] = k;
            }
        }
    }
    // Columns are numbered inputs, outputs, registers here: the number of registers is the last to be known.
    const std::size_t first_register = leaf_count_ + outputs;
    std::vector<std::int32_t> home(steps_.size(), -1);
    for (std::size_t output = 0; output < outputs; ++output) {
        const std::size_t slot = at(roots_[output]);
        if (slot >= base && home[slot - base] < 0) {
            home[slot - base] = static_cast<std::int32_t>(leaf_count_ + output);
            last_use[slot - base] = k_for_ever;
        }
    }
    std::vector<bool> used(leaf_count_, false);
    const auto operand = [&](std::int32_t slot) {
        TrialOperand result;
        if (at(slot) < leaf_count_) {
            used[at(slot)] = true;
            result.column = slot;
        } else if (at(slot) < base) {
            result.number = constants_[at(slot) - leaf_count_];
        } else if (at(slot) < base + steps_.size()) {
            result.column = home[at(slot) - base];
        }
        return result;
    };
    std::vector<std::int32_t> free_registers;
    register_count_ = 0;
    trial_steps_.reserve(steps_.size());
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        const TapeStep& step = steps_[k];
        TrialStep trial{.operation = step.operation, .a = operand(step.a), .b = operand(step.b)};
        if (home[k] < 0) {
            // Taken before the operands are given back: a result never overwrites what it is made of.
            if (free_registers.empty()) {
                free_registers.push_back(static_cast<std::int32_t>(first_register + register_count_++));
            }
            home[k] = free_registers.back();
            free_registers.pop_back();
        }
        trial.result = home[k];
        trial.watch_a = trial.a.column >= 0 && hides_a(step.operation);
        trial.watch_b = trial.b.column >= 0 && hides_b(step.operation);
        watched_ = watched_ || trial.watch_a || trial.watch_b;
        trial_steps_.push_back(trial);
        for (const std::int32_t slot : {step.a, step.b}) {
            if (at(slot) >= base && at(slot) < base + steps_.size() && last_use[at(slot) - base] == k) {
                free_registers.push_back(home[at(slot) - base]);
                last_use[at(slot) - base] = k_for_ever;  // both operands may be the same
            }
        }
    }
    for (std::size_t output = 0; output < outputs; ++output) {
        TrialOperand source = operand(roots_[output]);
        trial_outputs_.push_back(source);
    }
    for (std::size_t i = 0; i < leaf_count_; ++i) {
        if (used[i]) {
            used_inputs_.push_back(static_cast<std::int32_t>(i));
        }
    }
}

void Tape::trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const {
    struct Memory {
        Eigen::ArrayXd registers;  // one after the other, then the watch
        std::vector<double*> columns;
    };
    thread_local Memory memory;
    const auto registers = static_cast<Eigen::Index>(register_count_);
    if (memory.registers.size() < (registers + 1) * k_trials_in_a_chunk) {
        memory.registers.resize((registers + 1) * k_trials_in_a_chunk);
    }
    const std::size_t outputs = roots_.size();
    const std::size_t first_register = leaf_count_ + outputs;
    std::vector<double*>& columns = memory.columns;
    columns.assign(first_register + register_count_, nullptr);
    for (std::size_t i = 0; i < register_count_; ++i) {
        columns[first_register + i] = memory.registers.data() + static_cast<Eigen::Index>(i) * k_trials_in_a_chunk;
    }
    double* const watch = memory.registers.data() + registers * k_trials_in_a_chunk;

    for (Eigen::Index first = 0; first < x.rows(); first += k_trials_in_a_chunk) {
        const Eigen::Index n = std::min(k_trials_in_a_chunk, x.rows() - first);
        for (const std::int32_t input : used_inputs_) {
            // Never written to: results have columns of their own.
            columns[at(input)] = const_cast<double*>(&x.coeffRef(first, input));
        }
        for (std::size_t i = 0; i < outputs; ++i) {
            columns[leaf_count_ + i] = &y.coeffRef(first, static_cast<Eigen::Index>(i));
        }
        if (watched_) {
            Column(watch, n).setZero();
        }
        for (const TrialStep& step : trial_steps_) {
            const double* const a = step.a.column < 0 ? nullptr : columns[at(step.a.column)];
            const double* const b = step.b.column < 0 ? nullptr : columns[at(step.b.column)];
            double* const result = columns[at(step.result)];
            visit_step(step.operation, [&]<Operation operation>() {
                if constexpr (operation == Operation::number) {
                    return;
                } else if constexpr (is_binary(operation)) {
                    if (a == nullptr && b == nullptr) {  // a constant without a finite value, e.g. 1/0
                        Column(result, n).setConstant(apply<operation>(step.a.number, step.b.number));
                    } else {
                        run_binary<operation>(a, step.a.number, b, step.b.number, result, n);
                    }
                } else if (a == nullptr) {
                    Column(result, n).setConstant(apply<operation>(step.a.number, 0.0));
                } else {
                    run_unary<operation>(a, result, n);
                }
            });
            if (step.watch_a) {
                Column(watch, n) += ConstColumn(a, n) - ConstColumn(a, n);
            }
            if (step.watch_b) {
                Column(watch, n) += ConstColumn(b, n) - ConstColumn(b, n);
            }
        }
        for (std::size_t i = outputs; i-- > 0;) {
            Column result(columns[leaf_count_ + i], n);
            const TrialOperand& source = trial_outputs_[i];
            if (source.column < 0) {
                result.setConstant(source.number);
            } else if (columns[at(source.column)] != result.data()) {
                result = ConstColumn(columns[at(source.column)], n);
            }
        }
        for (std::size_t i = 0; i < outputs; ++i) {
            // ×1 leaves every number as it is; ∞ − ∞ is NaN, and so becomes the result.
            Column result(columns[leaf_count_ + i], n);
            if (watched_) {
                result *= (ConstColumn(watch, n) + (result - result)) + 1.0;
            } else {
                result *= (result - result) + 1.0;
            }
        }
    }
}

TapeBuilder::TapeBuilder(std::size_t leaves) : leaves_(leaves), entries_(leaves) {}

TapeBuilder::Node TapeBuilder::constant(double value) {
    const auto [place, is_new] =
        // By bits: 0 and −0 are two constants, for 1/0 and 1/−0 are two values. NaN is equal to itself so.
        constants_.try_emplace(std::bit_cast<std::uint64_t>(value), static_cast<Node>(entries_.size()));
    if (is_new) {
        entries_.push_back({.operation = Operation::number, .value = value, .origin = {}});
    }
    return place->second;
}

bool TapeBuilder::is_number(Node node, double value) const {
    return entry(node).operation == Operation::number &&
           std::bit_cast<std::uint64_t>(entry(node).value) == std::bit_cast<std::uint64_t>(value);
}

TapeBuilder::Node TapeBuilder::whole_power(Node base, int exponent, StepOrigin origin) {
    // By squaring: x^n takes at most 2 log2 n products, which trials run in packets; pow() is called for each trial.
    Node square = base;
    Node result = -1;
    for (int rest = std::abs(exponent); rest != 0; rest >>= 1) {
        if ((rest & 1) != 0) {
            result = result < 0 ? square : step(Operation::multiply, result, square, origin);
        }
        if (rest > 1) {
            square = step(Operation::multiply, square, square, origin);
        }
    }
    return exponent < 0 ? step(Operation::divide, constant(1.0), result, origin) : result;
}

TapeBuilder::Node TapeBuilder::step(Operation operation, Node a, Node b, StepOrigin origin) {
    // Beside whole powers, only what gives the same bits for every value is rewritten: x·0 stays a product, since it is
    // NaN where x is infinite, and x + 0, since −0 + 0 is 0. min(x, x) is x: as a step it would be a tie without
    // derivative.
    switch (operation) {
        case Operation::celsius:
            return step(Operation::subtract, a, constant(k_ice_point), origin);
        case Operation::kelvin:
            return step(Operation::add, a, constant(k_ice_point), origin);
        case Operation::power:
            if (entry(b).operation == Operation::number) {
                const double exponent = entry(b).value;
                if (exponent == 0.0) {
                    return constant(1.0);
                }
                if (std::fabs(exponent) <= k_largest_product_power && exponent == std::nearbyint(exponent)) {
                    return whole_power(a, static_cast<int>(exponent), origin);
                }
            }
            break;
        case Operation::multiply:
            if (is_number(b, 1.0)) {
                return a;
            }
            if (is_number(a, 1.0)) {
                return b;
            }
            break;
        case Operation::divide:
            if (is_number(b, 1.0)) {
                return a;
            }
            break;
        case Operation::negate:
            if (entry(a).operation == Operation::negate) {
                return entry(a).a;
            }
            break;
        case Operation::minimum:
        case Operation::maximum:
            if (a == b) {
                return a;
            }
            break;
        default:
            break;
    }
    if (!is_binary(operation)) {
        b = -1;
    } else if ((operation == Operation::add || operation == Operation::multiply) && b < a) {
        std::swap(a, b);  // both orders give the same bits
    }
    if (entry(a).operation == Operation::number && (b < 0 || entry(b).operation == Operation::number)) {
        const double value = apply(operation, entry(a).value, b < 0 ? 0.0 : entry(b).value);
        // 1/0 stays a step with its place in the text, for the message.
        if (std::isfinite(value)) {
            return constant(value);
        }
    }
    const auto [place, is_new] = steps_.try_emplace({operation, a, b}, static_cast<Node>(entries_.size()));
    if (is_new) {
        entries_.push_back({.operation = operation, .a = a, .b = b, .origin = origin});
    }
    return place->second;
}

Tape TapeBuilder::finish(const std::vector<Node>& residuals, const std::vector<Node>& outputs) const {
    // Operands come before their steps, so one pass backwards finds what the roots need.
    const auto needed_by = [&](const std::vector<Node>& roots) {
        std::vector<bool> needed(entries_.size(), false);
        for (const Node root : roots) {
            needed[at(root)] = true;
        }
        for (std::size_t i = entries_.size(); i-- > leaves_;) {
            if (needed[i] && entries_[i].a >= 0) {
                needed[at(entries_[i].a)] = true;
                if (entries_[i].b >= 0) {
                    needed[at(entries_[i].b)] = true;
                }
            }
        }
        return needed;
    };
    const std::vector<bool> for_residuals = needed_by(residuals);
    const std::vector<bool> for_outputs = needed_by(outputs);

    Tape tape;
    tape.leaf_count_ = leaves_;
    std::vector<std::int32_t> slot(entries_.size(), -1);
    for (std::size_t i = 0; i < leaves_; ++i) {
        slot[i] = static_cast<std::int32_t>(i);
    }
    for (std::size_t i = leaves_; i < entries_.size(); ++i) {
        if (entries_[i].operation == Operation::number && (for_residuals[i] || for_outputs[i])) {
            slot[i] = static_cast<std::int32_t>(leaves_ + tape.constants_.size());
            tape.constants_.push_back(entries_[i].value);
        }
    }
    const std::size_t base = tape.first_step_slot();
    std::vector<std::size_t> chosen;
    // Steps of the residuals first: the search for the unknowns runs these alone, again and again.
    for (const bool first_pass : {true, false}) {
        for (std::size_t i = leaves_; i < entries_.size(); ++i) {
            if (entries_[i].operation != Operation::number &&
                (first_pass ? for_residuals[i] : for_outputs[i] && !for_residuals[i])) {
                slot[i] = static_cast<std::int32_t>(base + chosen.size());
                chosen.push_back(i);
            }
        }
        if (first_pass) {
            tape.residual_step_count_ = chosen.size();
        }
    }
    const auto spare = static_cast<std::int32_t>(base + chosen.size());
    std::vector<std::size_t> lowest(chosen.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const Entry& from = entries_[chosen[k]];
        const TapeStep step{
            .operation = from.operation, .a = slot[at(from.a)], .b = from.b < 0 ? spare : slot[at(from.b)]};
        lowest[k] = k;
        for (const std::int32_t operand : {step.a, step.b}) {
            if (at(operand) >= base && operand != spare) {
                lowest[k] = std::min(lowest[k], lowest[at(operand) - base]);
            }
        }
        tape.steps_.push_back(step);
        tape.origins_.push_back(from.origin);
    }
    tape.residual_count_ = residuals.size();
    for (const std::vector<Node>* roots : {&residuals, &outputs}) {
        for (const Node root : *roots) {
            tape.roots_.push_back(slot[at(root)]);
            tape.lowest_.push_back(at(slot[at(root)]) >= base ? lowest[at(slot[at(root)]) - base] : 0);
        }
    }
    if (residuals.empty()) {
        tape.plan_trials();
    }
    return tape;
}

}  // namespace gumcert::gum
