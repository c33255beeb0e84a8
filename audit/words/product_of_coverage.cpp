#include "audit/words/product_of_coverage.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string>

#include "audit/stated_number.h"
#include "audit/words/bare_text.h"

namespace gumcert::audit {
namespace {

constexpr std::string_view k_signs_of_product[] = {"·", "×", "*", "⋅", "x "};
constexpr std::string_view k_signs_of_equality[] = {"=", "≅", "≈", "≃"};

/// The symbol or number at the beginning that may be a coverage factor; empty where there is none.
std::string_view leading_factor(std::string_view text) {
    for (const std::string_view k : {"k", "t_95", "t95", "t_p", "t"}) {
        if (text.starts_with(k)) {
            return text.substr(0, k.size());
        }
    }
    return text.substr(0, text.find_first_not_of("0123456789.,"));
}

bool may_be_k(double number) {
    return number >= 1.0 && number <= 14.0;
}

double value_of(std::string_view digits) {
    const std::optional<StatedNumber> number = read_number(std::string(digits), "");
    return number ? number->value : 0.0;
}

/// Which of two factors is k, where the first one stands where k does in symbols.
/// \param has_unit  the second one, which is u
FactorInNumbers factor_of_two(std::string_view first, std::string_view second, bool has_unit) {
    const double one = value_of(first), other = value_of(second);
    if (may_be_k(one) && (has_unit || !may_be_k(other) || one == other)) {
        return {.k = first};
    }
    if (has_unit || !may_be_k(other)) {
        return {.k = {}, .is_open = true};
    }
    // Both may be k: the usual one before the other, else the first as in "k·u"; u_c of the rows tells whether it is.
    if (!may_be_k(one)) {
        return {.k = second};
    }
    const auto is_usual_k = [](double number) {
        constexpr std::array k_usual{1.64, 1.645, 1.65, 1.96, 2.0, 2.576, 2.58, 3.0};
        return std::find(k_usual.begin(), k_usual.end(), number) != k_usual.end();
    };
    const bool is_second = is_usual_k(other) && !is_usual_k(one);
    return {.k = is_second ? second : first, .other = is_second ? first : second};
}

}  // namespace

FactorOfU factor_of_u(std::string_view product) {
    product = trimmed(product);
    if (product.find_first_of("+|-/") != std::string_view::npos) {
        return {};
    }
    const auto is_u = [](std::string_view text) {
        return text == "u" || text.starts_with("u_") || text.starts_with("uc") || text.starts_with("u(");
    };
    if (is_u(product)) {
        for (const std::string_view sign : k_signs_of_product) {
            if (const std::size_t at = product.find(sign); at != std::string_view::npos) {
                const std::string_view behind = trimmed(product.substr(at + sign.size()));
                const std::string_view factor = leading_factor(behind);
                return {.factor = factor == behind ? factor : std::string_view(), .is_last = true};
            }
        }
        return {};
    }
    const std::string_view factor = leading_factor(product);
    std::string_view behind = product.substr(factor.size());
    bool has_sign = false;
    const auto take = [&](std::string_view sign) {
        const bool is_next = behind.starts_with(sign);
        behind.remove_prefix(is_next ? sign.size() : 0);
        has_sign = has_sign || is_next;
        return is_next;
    };
    while (take(" ") || std::any_of(std::begin(k_signs_of_product), std::end(k_signs_of_product), take)) {
    }
    return {.factor = has_sign && is_u(behind) ? factor : std::string_view()};
}

FactorInNumbers factor_in_numbers(std::string_view product, bool is_last) {
    const std::size_t equal = product.find('=');
    const std::string_view numbers =
        equal == std::string_view::npos ? std::string_view() : trimmed(product.substr(equal + 1));
    const auto leading = [](std::string_view text) { return text.substr(0, text.find_first_not_of("0123456789.,")); };
    const std::string_view first = leading(numbers);
    for (const std::string_view times : k_signs_of_product) {
        const std::size_t at = numbers.find(times);
        if (first.empty() || at == std::string_view::npos) {
            continue;
        }
        const std::string_view unit = trimmed(numbers.substr(first.size(), at - first.size()));
        const std::string_view rest = trimmed(numbers.substr(at + times.size())), second = leading(rest);
        if (is_last && !second.empty() && unit.find('=') == std::string_view::npos) {
            return factor_of_two(second, first, !unit.empty());
        }
        if (is_last || !unit.empty()) {
            continue;
        }
        if (second.empty()) {  // "2 × (0.05² + 0.03²)^(1/2)", "2 × √0.0034 mV"
            const bool is_sum = rest.starts_with('(') || rest.starts_with("√") || rest.starts_with("sqrt");
            const bool is_k = may_be_k(value_of(first));
            return {.k = is_sum && is_k ? first : std::string_view(), .is_open = is_sum && !is_k};
        }
        const std::string_view behind = trimmed(rest.substr(second.size()));
        const bool has_unit =
            !behind.empty() && std::none_of(std::begin(k_signs_of_equality), std::end(k_signs_of_equality),
                                            [behind](std::string_view sign) { return behind.starts_with(sign); });
        return factor_of_two(first, second, has_unit);
    }
    return {};
}

std::string_view number_at_end(std::string_view product) {
    std::size_t last = std::string_view::npos, behind = 0;
    for (const std::string_view sign : k_signs_of_equality) {
        const std::size_t at = product.rfind(sign);
        if (at != std::string_view::npos && (last == std::string_view::npos || at > last)) {
            last = at;
            behind = at + sign.size();
        }
    }
    const std::string_view number =
        last == std::string_view::npos ? std::string_view() : trimmed(product.substr(behind));
    const bool is_product =
        std::any_of(std::begin(k_signs_of_product), std::end(k_signs_of_product),
                    [number](std::string_view times) { return number.find(times) != std::string_view::npos; });
    return number.empty() || !is_of_number(number.front()) || is_product ? std::string_view() : number;
}

}  // namespace gumcert::audit
