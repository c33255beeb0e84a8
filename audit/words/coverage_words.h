#pragma once

#include <optional>
#include <string_view>

namespace gumcert::audit {

/// What a text says of coverage: "k = 2.08, p = 95.45 %", "Normal (k=2)", "Erweiterungsfaktor 2", "95 %".
struct CoverageText {
    std::string_view k;       ///< the number that k is, and what follows it; empty where it says none
    std::optional<double> p;  ///< between 0.5 and 1
    [[nodiscard]] bool says_any() const { return !k.empty() || p.has_value(); }
};
[[nodiscard]] CoverageText coverage_in(std::string_view text);
/// Whether what follows a name begins with what is said of coverage: ", k=2", " (95 %", " 95,45 %".
[[nodiscard]] bool begins_with_coverage(std::string_view text);
/// What is said of coverage as one of U: k above those of u_c, or a probability above 68 %.
[[nodiscard]] bool is_of_expanded(const CoverageText& coverage);
/// Whether a text beside a relative uncertainty says nothing but its coverage, its unit, and that it is of the value: "(%)",
/// "k = 2, p = 95 %", "of reading", and not "of full scale" or "v. E.".
[[nodiscard]] bool says_coverage_alone(std::string_view text);

/// The k that a distribution is said with: "normal (k = 2)", "Normal 2σ", "N (2 sigma)".
[[nodiscard]] std::optional<double> k_of_distribution(std::string_view text);

}  // namespace gumcert::audit
