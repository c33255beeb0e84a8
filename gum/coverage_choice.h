#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace gumcert::gum {

/// Which evaluation is reported of a result.
enum class CoverageChoice {
    as_validated,        ///< the law of propagation where it is adequate, Monte Carlo elsewhere
    law_of_propagation,  ///< whatever speaks against it
    monte_carlo,         ///< always
};

inline constexpr std::array<std::pair<std::string_view, CoverageChoice>, 3> k_coverage_choices{
    {{"as_validated", CoverageChoice::as_validated},
     {"law_of_propagation", CoverageChoice::law_of_propagation},
     {"monte_carlo", CoverageChoice::monte_carlo}}};

/// The word that jobs and records write.
[[nodiscard]] constexpr std::string_view coverage_choice_name(CoverageChoice choice) {
    for (const auto& [name, value] : k_coverage_choices) {
        if (value == choice) {
            return name;
        }
    }
    return "";
}

}  // namespace gumcert::gum
