#include "gum/expression/conversion_check.h"

#include <cmath>
#include <cstddef>
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
                return WrittenProduct{.factor = 3.14159265358979323846};
            case Operation::quantity:
                return of_name_(node.name);
            case Operation::negate:
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
        return node.operation == Operation::multiply
                   ? WrittenProduct{.factor = left->factor * right->factor, .size = left->size * right->size}
                   : WrittenProduct{.factor = left->factor / right->factor, .size = left->size / right->size};
    }

    [[nodiscard]] Product of_power(const SyntaxNode& node) const {
        if (!at(node.left)) {
            return std::nullopt;
        }
        if (!is_literal(node.right) || !at(node.right)) {
            return at(node.left)->size == 1.0 ? Product(WrittenProduct{}) : std::nullopt;
        }
        const double sign =
            tree_.nodes[static_cast<std::size_t>(node.right)].operation == Operation::negate ? -1.0 : 1.0;
        const double exponent = sign * at(node.right)->factor;
        return WrittenProduct{.factor = std::pow(std::fabs(at(node.left)->factor), exponent),
                              .size = std::pow(at(node.left)->size, exponent)};
    }

    /// A sum is not multiplied by a number unless its terms are, by the same one. Terms in different units are none of a spreadsheet.
    [[nodiscard]] Product of_sum(const SyntaxNode& node) const {
        if (is_literal(node.left) || is_literal(node.right)) {
            const std::int32_t other = is_literal(node.left) ? node.right : node.left;
            return at(other) ? Product(WrittenProduct{.size = at(other)->size}) : std::nullopt;
        }
        const Product &left = at(node.left), &right = at(node.right);
        if (!left || !right || std::fabs(left->size - right->size) > 1e-9 * left->size) {
            return std::nullopt;
        }
        const bool same = std::fabs(left->factor - right->factor) <= 1e-9 * std::fabs(left->factor);
        return WrittenProduct{.factor = same ? left->factor : 1.0, .size = left->size};
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
