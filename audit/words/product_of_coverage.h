#pragma once

#include <string_view>

namespace gumcert::audit {

/// What "U =" is a product of.
struct FactorOfU {
    std::string_view factor;  ///< the number or "k"; empty where it is no product
    bool is_last = false;     ///< it stands behind u
};
/// Of "k·u_c", "2 · u(y)" or "u_c·k". Nothing where something is added to it.
[[nodiscard]] FactorOfU factor_of_u(std::string_view product);

/// What k is in a product of numbers.
struct FactorInNumbers {
    std::string_view k;           ///< empty where none is known
    std::string_view other = {};  ///< what may be k as well, and the first one u
    bool is_open = false;         ///< one of the numbers is k, and nothing says which
};
/// 2 of "k · u(y) = 2 × 37.7 mg", as EA-4/02 writes U; of "k·u_c = 0.0651·2", too, where u is no k. Nothing where no product of
/// numbers follows.
/// \param is_last  k stands behind u: "u_c·k = 37.7 mg · 2"
[[nodiscard]] FactorInNumbers factor_in_numbers(std::string_view product, bool is_last);

/// 59 mg of "k·u(m_X) = 2·29.3 mg ≅ 59 mg"; empty where a product ends the text.
[[nodiscard]] std::string_view number_at_end(std::string_view product);

}  // namespace gumcert::audit
