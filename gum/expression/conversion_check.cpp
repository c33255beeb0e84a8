#include "gum/expression/conversion_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "text/numbers.h"

namespace gumcert::gum {

namespace {

using Product = std::optional<WrittenProduct>;

class WrittenProducts {
public:
    WrittenProducts(const SyntaxTree& tree, const std::function<Product(std::uint32_t)>& of_name)
        : tree_(tree), of_name_(of_name) {}

    Product run() {
        for (const SyntaxNode& node : tree_.nodes) {
            literal_.push_back(is_number(node));
            products_.push_back(of(node));
        }
        return products_.empty() ? std::nullopt : products_.back();
    }

private:
    const SyntaxTree& tree_;
    const std::function<Product(std::uint32_t)>& of_name_;
    std::vector<Product> products_;
    std::vector<bool> literal_;

    [[nodiscard]] const Product& at(std::int32_t index) const { return products_[static_cast<std::size_t>(index)]; }
    [[nodiscard]] bool is_literal(std::int32_t index) const { return literal_[static_cast<std::size_t>(index)]; }
    /// A number without a name in it; operands stand before their operator, so that this is no recursion.
    [[nodiscard]] bool is_number(const SyntaxNode& node) const {
        switch (node.operation) {
            case Operation::number:
            case Operation::pi:
                return true;
            case Operation::negate:
                return is_literal(node.left);
            case Operation::multiply:
            case Operation::divide:
            case Operation::power:
                return is_literal(node.left) && is_literal(node.right);
            default:
                return false;
        }
    }

    [[nodiscard]] Product of(const SyntaxNode& node) const {
        switch (node.operation) {
            case Operation::number:
                return WrittenProduct{.factor = node.value};
            case Operation::pi:
                return WrittenProduct{.factor = std::numbers::pi};
            case Operation::quantity:
                return of_name_(node.name);
            case Operation::negate:
                // Of a number the sign counts, as that of an exponent; of everything else it is left out.
                return is_literal(node.left) && at(node.left)
                           ? Product(WrittenProduct{.factor = -at(node.left)->factor, .size = at(node.left)->size})
                           : at(node.left);
            case Operation::absolute:
                return at(node.left);
            case Operation::multiply:
            case Operation::divide:
                return of_two(node);
            case Operation::power:
                return of_power(node);
            case Operation::sqrt:
                return at(node.left) ? Product(WrittenProduct{.factor = std::sqrt(std::fabs(at(node.left)->factor)),
                                                              .size = std::sqrt(at(node.left)->size)})
                                     : std::nullopt;
            case Operation::add:
            case Operation::subtract:
            case Operation::minimum:
            case Operation::maximum:
            case Operation::hypot:
                return of_sum(node);
            case Operation::celsius:
            case Operation::kelvin:
                return std::nullopt;
            default:
                return WrittenProduct{};  // numbers, and angles in radians
        }
    }

    [[nodiscard]] Product of_two(const SyntaxNode& node) const {
        const Product &left = at(node.left), &right = at(node.right);
        if (!left || !right) {
            return std::nullopt;
        }
        const bool multiplies = node.operation == Operation::multiply;
        WrittenProduct product{.factor = multiplies ? left->factor * right->factor : left->factor / right->factor,
                               .size = multiplies ? left->size * right->size : left->size / right->size,
                               .terms = multiplies ? left->terms * right->terms : left->terms};
        // A sum that is divided by the number of its terms is a mean.
        if (is_share(multiplies ? 1.0 / right->factor : right->factor, left->terms)) {
            product.factor = left->factor;
            product.terms = 1.0;
        } else if (multiplies && is_share(1.0 / left->factor, right->terms)) {
            product.factor = right->factor;
            product.terms = 1.0;
        }
        return product;
    }

    [[nodiscard]] static bool is_share(double divisor, double terms) {
        return terms > 1.0 && std::fabs(std::fabs(divisor) - terms) <= 1e-9 * terms;
    }

    [[nodiscard]] Product of_power(const SyntaxNode& node) const {
        if (!at(node.left)) {
            return std::nullopt;
        }
        if (!is_literal(node.right) || !at(node.right)) {
            return at(node.left)->size == 1.0 ? Product(WrittenProduct{}) : std::nullopt;
        }
        const double exponent = at(node.right)->factor;
        const double factor = at(node.left)->factor;
        return WrittenProduct{.factor = std::pow(is_literal(node.left) ? factor : std::fabs(factor), exponent),
                              .size = std::pow(at(node.left)->size, exponent)};
    }

    [[nodiscard]] static bool is_same(double a, double b) {
        return std::fabs(std::fabs(a) - std::fabs(b)) <= 1e-9 * std::fabs(a);
    }

    /// A sum is not multiplied by a number unless its terms are, by the same one. Terms in different units are none of a spreadsheet.
    [[nodiscard]] Product of_sum(const SyntaxNode& node) const {
        const Product &left = at(node.left), &right = at(node.right);
        if (is_literal(node.left) && is_literal(node.right)) {
            return WrittenProduct{};
        }
        if (is_literal(node.left) || is_literal(node.right)) {
            const Product &number = is_literal(node.left) ? left : right, &other = is_literal(node.left) ? right : left;
            if (!number || !other) {
                return std::nullopt;
            }
            // 100*a/b - 100 is (a/b - 1)*100.
            return WrittenProduct{.factor = is_same(number->factor, other->factor) ? other->factor : 1.0,
                                  .size = other->size,
                                  .terms = terms_of(node.operation, 1.0, other->terms)};
        }
        if (!left || !right || std::fabs(left->size - right->size) > 1e-9 * left->size) {
            return std::nullopt;
        }
        return WrittenProduct{.factor = is_same(left->factor, right->factor) ? left->factor : 1.0,
                              .size = left->size,
                              .terms = terms_of(node.operation, left->terms, right->terms)};
    }

    /// Of differences that are added, a - b + c - d, each is one term.
    [[nodiscard]] static double terms_of(Operation operation, double left, double right) {
        return operation == Operation::add        ? left + right
               : operation == Operation::subtract ? std::max(left, right)
                                                  : 1;
    }
};

double six_digits(double value) {
    const double step = std::pow(10.0, 5.0 - std::floor(std::log10(value)));
    return std::round(value * step) / step;
}

}  // namespace

std::optional<WrittenProduct> written_product(
    const SyntaxTree& tree, const std::function<std::optional<WrittenProduct>(std::uint32_t)>& of_name) {
    return WrittenProducts(tree, of_name).run();
}

void check_conversion(const std::string& name, const WrittenProduct& product, const Unit& declared,
                      const std::string& where, std::vector<Diagnostic>& warnings) {
    constexpr double k_as_people_round = 2e-4;  // 57.3 for 180/pi
    const double factor = std::fabs(product.factor);
    const double conversion = product.size / declared.difference_to_si(1.0);
    const bool is_one = std::fabs(conversion - 1.0) <= k_as_people_round;
    if (is_one || !(std::fabs(factor - conversion) <= k_as_people_round * conversion)) {
        return;
    }
    warnings.push_back({.code = "GC-MODEL-0046",
                        .where = where,
                        .what = name + " is declared in " + declared.text() + ", and its equation multiplies by " +
                                text::shortest_plain(six_digits(factor)) + ", which is what converts to this unit",
                        .rule = "units are converted by the program: a factor that converts them is applied twice",
                        .action =
                            "Leave the factor out of the equation. Where a multiple is meant, state the factor as "
                            "an input, \"constant\": true.",
                        .severity = Severity::warning});
}

}  // namespace gumcert::gum
