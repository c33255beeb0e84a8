#include "audit/tables/product_of_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "audit/tables/sheet_view.h"
#include "audit/words/unit_words.h"
#include "gum/quantity/unit.h"

namespace gumcert::audit {
namespace {

constexpr std::size_t k_least_rows = 2, k_most_rows_of_product = 14;
constexpr std::size_t k_most_choices = 64, k_most_tries = 200'000;
constexpr double k_arithmetic = 2e-4;  // relative: values that somebody rounded on the way

/// A factor in SI: the logarithm of its size.
struct SizeInSi {
    double logarithm = 0.0;
    gum::Dimension dimension;
    double of_unit = 1.0;  ///< that of one of its unit
};

std::optional<SizeInSi> size_in_si(const Factor& factor) {
    const bool is_one = says_nothing(factor.unit) || factor.unit == "1";
    const std::optional<gum::Unit> unit = is_one ? std::optional(gum::Unit()) : known_unit(factor.unit);
    const double size = unit ? std::abs(unit->difference_to_si(factor.value)) : 0.0;
    if (!(size > 0.0) || !std::isfinite(size) || unit->is_celsius_temperature()) {
        return std::nullopt;
    }
    return SizeInSi{
        .logarithm = std::log(size), .dimension = unit->dimension(), .of_unit = unit->difference_to_si(1.0)};
}

/// Finds the exponents that fit: 1 and −1, and of rows without dimension 2 and ½ as well.
class ChoicesOfExponents {
public:
    ChoicesOfExponents(const std::vector<SizeInSi>& sizes, const SizeInSi& wanted, double open)
        : sizes_(sizes), wanted_(wanted), open_(open), exponents_(sizes.size(), 1.0) {}

    [[nodiscard]] ProductOfRows find() {
        from(0, 0.0, gum::Dimension());
        const auto is_plain = [](const std::vector<double>& choice) {
            return std::all_of(choice.begin(), choice.end(), [](double one) { return std::abs(one) == 1.0; });
        };
        const auto first = std::find_if(product_.choices.begin(), product_.choices.end(), is_plain);
        if (first == product_.choices.end()) {
            product_.choices.clear();
        } else {
            std::rotate(product_.choices.begin(), first, first + 1);
        }
        return std::move(product_);
    }

private:
    void from(std::size_t row, double logarithm, const gum::Dimension& dimension) {
        if (++tries_ > k_most_tries || product_.choices.size() >= k_most_choices) {
            product_.has_all_choices = false;
            return;
        }
        if (row == sizes_.size()) {
            if (dimension == wanted_.dimension && std::abs(logarithm - wanted_.logarithm) <= open_) {
                product_.choices.push_back(exponents_);
            }
            return;
        }
        constexpr std::array<double, 6> k_exponents = {1.0, -1.0, 2.0, -2.0, 0.5, -0.5};
        const std::size_t count = sizes_[row].dimension.is_one() ? k_exponents.size() : 2;
        for (std::size_t i = 0; i < count; ++i) {
            exponents_[row] = k_exponents[i];
            const gum::Dimension next = k_exponents[i] == 1.0    ? dimension * sizes_[row].dimension
                                        : k_exponents[i] == -1.0 ? dimension / sizes_[row].dimension
                                                                 : dimension;
            from(row + 1, logarithm + k_exponents[i] * sizes_[row].logarithm, next);
        }
    }

    const std::vector<SizeInSi>& sizes_;
    const SizeInSi& wanted_;
    double open_;
    std::vector<double> exponents_;
    ProductOfRows product_;
    std::size_t tries_ = 0;
};

}  // namespace

std::optional<ProductOfRows> product_of_rows(const std::vector<Factor>& rows, const Factor& result) {
    const std::optional<SizeInSi> wanted = size_in_si(result);
    if (!wanted || rows.size() < k_least_rows || rows.size() > k_most_rows_of_product) {
        return std::nullopt;
    }
    std::vector<SizeInSi> sizes;
    double open = k_arithmetic + result.relative_half_step;
    bool differ = false, has_equal = false;
    for (const Factor& row : rows) {
        const std::optional<SizeInSi> size = size_in_si(row);
        if (!size) {
            return std::nullopt;
        }
        for (const SizeInSi& other : sizes) {
            const bool is_of_one_kind = other.dimension == size->dimension;
            // A content in mg/g beside a factor is no sum, for what is added has one unit.
            differ = differ || !is_of_one_kind || (size->dimension.is_one() && other.of_unit != size->of_unit);
            has_equal = has_equal || (is_of_one_kind && std::abs(other.logarithm - size->logarithm) <= k_arithmetic);
        }
        sizes.push_back(*size);
        open += row.relative_half_step;
    }
    constexpr double k_most_open = 0.05;  // values of one digit fit anything
    if (!differ || open > k_most_open) {
        return std::nullopt;
    }
    ProductOfRows product = ChoicesOfExponents(sizes, *wanted, open).find();
    product.has_equal_factors = has_equal;
    return product.choices.empty() ? std::nullopt : std::optional(std::move(product));
}

}  // namespace gumcert::audit
