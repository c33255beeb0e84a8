#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::audit {

/// What the name of a line says of a correlation of two rows.
struct CorrelationWords {
    /// A coefficient by its name, "Correlation r(T1; T2)", "r(T1; T2) = 0.6": its number is r, whatever the column that it stands in.
    bool is_coefficient = false;
    bool is_covariance = false;    ///< a term of the sum, and no coefficient
    std::optional<double> r = {};  ///< that the name has: "r(T1, T2) = 0.6", "(r = 0.6)"
    /// What may be the symbols of the two rows, likeliest first: of "r(T1; T2)", "T1 and T2", "T1/T2".
    std::vector<std::pair<std::string, std::string>> pairs = {};
};
/// A coefficient that a text states by its symbol: 0.9 of "r = 0.9" or "calibrated together, ρ(A; B) = 0.9".
[[nodiscard]] std::optional<double> stated_correlation(std::string_view text);
/// What the r of a note may belong to, by its words.
enum class NotedCorrelation {
    of_rows,  ///< "A and B were calibrated together, r = 0.9"
    of_fit,   ///< of a regression, which is no correlation of two contributions: "Drift line: r = 0.98"
    open,
};
[[nodiscard]] NotedCorrelation noted_correlation(std::string_view note);
/// Nothing where the name says nothing of a correlation.
[[nodiscard]] std::optional<CorrelationWords> correlation_words(std::string_view name);

}  // namespace gumcert::audit
