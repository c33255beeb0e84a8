#include "gum/expression/tangent_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gum/expression/enclosure.h"
#include "gum/expression/equation_compiler.h"
#include "gum/expression/syntax_tree.h"
#include "gum/expression/tape.h"

namespace gumcert::gum {

namespace {

std::size_t slot_of(std::int32_t slot) {
    return static_cast<std::size_t>(slot);
}

/// A tape over a box, for one of its roots.
class BoxedTape {
public:
    BoxedTape(const Tape& tape, std::size_t root)
        : tape_(tape), base_(tape.first_step_slot()), root_(slot_of(tape.roots()[root])) {
        TapeWorkspace constants;
        tape.prepare(constants);
        value_.resize(base_ + tape.step_count() + 1);
        for (std::size_t slot = tape.leaf_count(); slot < base_; ++slot) {
            value_[slot] = enclosure_of(constants.value[slot]);
        }
        find_needed();
    }

    [[nodiscard]] const std::vector<std::size_t>& steps() const { return needed_; }
    /// Whether the root depends on a leaf.
    [[nodiscard]] bool needs_leaf(std::size_t leaf) const { return is_needed_[leaf]; }
    [[nodiscard]] const Enclosure& output() const { return value_[root_]; }

    /// Values over leaves.
    /// \return the step without a value, if there is one
    std::optional<std::size_t> values(const std::vector<Enclosure>& leaves) {
        std::copy(leaves.begin(), leaves.end(), value_.begin());
        for (const std::size_t k : needed_) {
            const TapeStep& step = tape_.steps()[k];
            const std::optional<Enclosure> value =
                // x·x of an interval with 0 in it: as a product of two unrelated numbers it would reach below 0.
                is_square(step) ? std::optional(square(value_[slot_of(step.a)]))
                                : enclose(step.operation, value_[slot_of(step.a)], value_[slot_of(step.b)]);
            if (!value || !value->is_finite()) {
                return k;
            }
            value_[base_ + k] = *value;
        }
        return std::nullopt;
    }

    /// Values and partial derivatives of all steps, and the gradient by all slots.
    std::optional<std::size_t> partials(const std::vector<Enclosure>& leaves) {
        std::copy(leaves.begin(), leaves.end(), value_.begin());
        step_.resize(tape_.step_count());
        for (const std::size_t k : needed_) {
            const TapeStep& step = tape_.steps()[k];
            const std::optional<EnclosedStep> enclosed =
                enclose_with_partials(step.operation, value_[slot_of(step.a)], value_[slot_of(step.b)]);
            if (!enclosed) {
                return k;
            }
            step_[k] = *enclosed;
            value_[base_ + k] = is_square(step) ? square(value_[slot_of(step.a)]) : enclosed->value;
        }
        adjoint_.assign(value_.size(), {});
        adjoint_[root_] = enclosure_of(1.0);
        for (std::size_t i = needed_.size(); i-- > 0;) {
            const std::size_t k = needed_[i];
            const Enclosure w = adjoint_[base_ + k];
            add(adjoint_[slot_of(tape_.steps()[k].a)], step_[k].da * w);
            add(adjoint_[slot_of(tape_.steps()[k].b)], step_[k].db * w);
        }
        return std::nullopt;
    }
    [[nodiscard]] const Enclosure& slope(std::size_t leaf) const { return adjoint_[leaf]; }

    /// Row j of the second derivatives by all leaves; after partials().
    const std::vector<Enclosure>& second(std::size_t j) {
        tangent_.assign(value_.size(), {});
        adjoint_tangent_.assign(value_.size(), {});
        tangent_[j] = enclosure_of(1.0);
        for (const std::size_t k : needed_) {
            const TapeStep& step = tape_.steps()[k];
            tangent_[base_ + k] = step_[k].da * tangent_[slot_of(step.a)];
            add(tangent_[base_ + k], step_[k].db * tangent_[slot_of(step.b)]);
        }
        for (std::size_t i = needed_.size(); i-- > 0;) {
            const std::size_t k = needed_[i];
            const TapeStep& step = tape_.steps()[k];
            const EnclosedStep& d = step_[k];
            const std::size_t a = slot_of(step.a), b = slot_of(step.b);
            const Enclosure w = adjoint_[base_ + k], wt = adjoint_tangent_[base_ + k];
            const Enclosure ta = tangent_[a], tb = tangent_[b];
            add(adjoint_tangent_[a], d.da * wt);
            add(adjoint_tangent_[a], (d.daa * ta + d.dab * tb) * w);
            add(adjoint_tangent_[b], d.db * wt);
            add(adjoint_tangent_[b], (d.dab * ta + d.dbb * tb) * w);
        }
        return adjoint_tangent_;
    }

private:
    static void add(Enclosure& sum, const Enclosure& part) {
        if (!part.is_zero()) {
            sum = sum + part;
        }
    }
    [[nodiscard]] static bool is_square(const TapeStep& step) {
        return step.operation == Operation::multiply && step.a == step.b;
    }

    /// Steps and leaves that the root depends on, steps in their order: a budget may have hundreds of results.
    void find_needed() {
        is_needed_.assign(value_.size(), false);
        is_needed_[root_] = true;
        for (std::size_t k = tape_.step_count(); k-- > 0;) {
            if (is_needed_[base_ + k]) {
                is_needed_[slot_of(tape_.steps()[k].a)] = true;
                is_needed_[slot_of(tape_.steps()[k].b)] = true;
                needed_.push_back(k);
            }
        }
        std::reverse(needed_.begin(), needed_.end());
    }

    const Tape& tape_;
    std::size_t base_, root_;
    std::vector<std::size_t> needed_;
    std::vector<bool> is_needed_;  // by slot
    std::vector<Enclosure> value_, adjoint_, tangent_, adjoint_tangent_;
    std::vector<EnclosedStep> step_;
};

/// What of two enclosures of one number is common to both.
Enclosure common(const Enclosure& a, const Enclosure& b) {
    return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

/// The box, and the deviations from its centre.
struct Box {
    std::vector<Enclosure> leaves, centre, deviation;
    std::vector<std::size_t> moving;  // of the leaves that the root depends on
};

Box box_of(const BoxedTape& tape, const Eigen::VectorXd& x, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
    Box box;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        box.leaves.push_back({low(i), high(i)});
        box.centre.push_back(enclosure_of(x(i)));
        box.deviation.push_back(box.leaves.back() - box.centre.back());
        if (low(i) < high(i) && tape.needs_leaf(static_cast<std::size_t>(i))) {
            box.moving.push_back(static_cast<std::size_t>(i));
        }
    }
    return box;
}

/// ½ Σ_ij H_ij d_i d_j over the box; after partials().
Enclosure remainder_over(BoxedTape& tape, const Box& box) {
    const std::size_t n = box.moving.size();
    std::vector<Enclosure> hessian(n * n);
    for (std::size_t j = 0; j < n; ++j) {
        const std::vector<Enclosure>& row = tape.second(box.moving[j]);
        for (std::size_t i = 0; i < n; ++i) {
            hessian[j * n + i] = row[box.moving[i]];
        }
    }
    Enclosure sum;
    for (std::size_t i = 0; i < n; ++i) {
        const Enclosure& d = box.deviation[box.moving[i]];
        sum = sum + enclosure_of(0.5) * hessian[i * n + i] * square(d);
        for (std::size_t j = i + 1; j < n; ++j) {
            // The matrix is symmetric: both entries enclose one number.
            sum = sum + common(hessian[i * n + j], hessian[j * n + i]) * d * box.deviation[box.moving[j]];
        }
    }
    return sum;
}

/// |f − tangent| that is certain at one of some points of the box.
double certain_remainder(BoxedTape& tape, const Box& box) {
    if (tape.partials(box.centre)) {
        return 0.0;
    }
    const Enclosure f0 = tape.output();
    std::vector<Enclosure> slope(box.leaves.size());
    for (const std::size_t i : box.moving) {
        slope[i] = tape.slope(i);
    }
    double certain = 0.0;
    const auto look_at = [&](const std::vector<Enclosure>& point) {
        if (tape.values(point)) {
            return;
        }
        // f − tangent at one point, with every rounding on the outside: the smallest size of it is certain, whatever
        // rounding did.
        Enclosure remainder = tape.output() - f0;
        for (const std::size_t i : box.moving) {
            remainder = remainder - slope[i] * (point[i] - box.centre[i]);
        }
        certain = remainder.is_finite() ? std::max(certain, remainder.smallest()) : certain;
    };
    double length = 0.0;  // of the slope in units of the reach of each leaf
    const auto reach = [&](std::size_t i) { return std::min(-box.deviation[i].low, box.deviation[i].high); };
    const auto middle = [&](std::size_t i) { return 0.5 * (slope[i].low + slope[i].high); };
    for (const std::size_t i : box.moving) {
        for (const double end : {box.leaves[i].low, box.leaves[i].high}) {
            std::vector<Enclosure> point = box.centre;
            point[i] = enclosure_of(end);
            look_at(point);
        }
        length = std::hypot(length, middle(i) * reach(i));
    }
    if (!(length > 0.0)) {
        return certain;
    }
    // With one input moved alone the mixed second derivatives stay out of sight. Here all inputs move together.
    std::vector<Enclosure> up = box.centre, down = box.centre;
    for (const std::size_t i : box.moving) {
        const double x = box.centre[i].low, d = middle(i) * reach(i) / length * reach(i);
        up[i] = enclosure_of(std::clamp(x + d, box.leaves[i].low, box.leaves[i].high));
        down[i] = enclosure_of(std::clamp(x - d, box.leaves[i].low, box.leaves[i].high));
    }
    look_at(up);
    look_at(down);
    return certain;
}

std::string why_no_bound(const CompiledEquations& compiled, std::optional<std::size_t> step) {
    if (!step) {
        return "the model is too large for interval arithmetic, or its bound is not finite";
    }
    const StepOrigin& origin = compiled.tape.origins()[*step];
    const SyntaxTree& tree = compiled.trees[origin.equation];
    const std::string text = "\"" + tree.excerpt(tree.nodes[origin.node]) + "\"";
    switch (compiled.tape.steps()[*step].operation) {
        case Operation::divide:
            return text + ": the divisor may be 0 there";
        case Operation::sqrt:
        case Operation::ln:
        case Operation::log10:
        case Operation::power:
            return text + ": the argument may be 0 or negative there";
        case Operation::absolute:
        case Operation::minimum:
        case Operation::maximum:
            return text + ": a kink may lie there";
        case Operation::asin:
        case Operation::acos:
            return text + ": the argument may reach 1 or -1 there";
        case Operation::tan:
        case Operation::atan2:
        case Operation::hypot:
            return text + ": a point without derivative may lie there";
        default:
            return text + ": there may be no finite value there";
    }
}

}  // namespace

TapeBound tangent_bound(const Tape& tape, std::size_t root, const Eigen::VectorXd& x, const Eigen::VectorXd& low,
                        const Eigen::VectorXd& high) {
    BoxedTape boxed(tape, root);
    const Box box = box_of(boxed, x, low, high);
    TapeBound result;
    // One sweep of all steps for each leaf that varies: time grows with the product.
    if (boxed.steps().size() * box.moving.size() > k_largest_bounded_model) {
        return result;
    }
    result.step = boxed.partials(box.leaves);
    if (result.step) {
        return result;
    }
    const Enclosure remainder = remainder_over(boxed, box);
    if (remainder.is_finite()) {
        result.bound =
            TangentBound{.low = remainder.low, .high = remainder.high, .certain = certain_remainder(boxed, box)};
    }
    return result;
}

OutputBound tangent_bound(std::span<const EquationText> equations, std::span<const InputSymbol> inputs,
                          std::size_t output, const Eigen::VectorXd& x, const Eigen::VectorXd& low,
                          const Eigen::VectorXd& high) {
    const CompiledEquations compiled = compile_equations(equations, inputs, {}, {}, {});
    const TapeBound bound = tangent_bound(compiled.tape, output, x, low, high);
    return {.bound = bound.bound, .why_not = bound.bound ? "" : why_no_bound(compiled, bound.step)};
}

}  // namespace gumcert::gum
