#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gumcert::audit {

/// The value of a row, or of a result, that may be a factor of a product.
struct Factor {
    double value = 0.0;
    double relative_half_step = 0.0;  ///< what its printed digits leave open, over the value
    std::string unit;                 ///< "" and "-" are one
};

/// How the values of rows make up that of a result as a product.
struct ProductOfRows {
    /// The exponents of the rows in each way that fits units and numbers, the first one of 1 and −1 alone. Of a row without dimension
    /// others fit as well, as of a recovery of 1.00.
    std::vector<std::vector<double>> choices;
    bool has_all_choices = true;  ///< no more fit than those
    bool has_equal_factors =
        false;  ///< two rows of one dimension have one value: one of them may be no factor, as a repeatability
};

/// The exponents with which the values of rows multiply to that of the result: m P/V of 100.28 mg, 0.9999 and 100 mL is 1002.7 mg/L. Units
/// and numbers have to fit together in SI. Nothing where no choice of 1 and −1 fits, all rows have one dimension (they may be those of a
/// sum; mg/g beside 1 is none), a unit is not known, or a value is 0 or one on a scale with another zero, as 20 °C.
[[nodiscard]] std::optional<ProductOfRows> product_of_rows(const std::vector<Factor>& rows, const Factor& result);

}  // namespace gumcert::audit
