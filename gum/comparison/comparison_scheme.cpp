#include "gum/comparison/comparison_scheme.h"

#include "gum/argument_check.h"

namespace gumcert::gum {

ResultUncertainty stated_expanded(double U, double k) {
    require_positive(U, "expanded uncertainty");
    require_positive(k, "coverage factor");
    return {.u = U / k, .U = U, .k = k, .stated_as_expanded = true};
}

EnUncertainty en_uncertainty(const ResultUncertainty& uncertainty, double coverage_probability) {
    return uncertainty.of_scores ? *uncertainty.of_scores
                                 : en_uncertainty(uncertainty.u, uncertainty.U, uncertainty.k,
                                                  uncertainty.degrees_of_freedom, coverage_probability);
}

bool has_conventional_zero(const Unit& unit) {
    constexpr std::size_t k_decibel = Dimension::k_base_units - 1;
    return unit.is_celsius_temperature() || unit.dimension().exponent(k_decibel) != 0.0;
}

std::string word_of(AssignedValueMethod method) {
    return std::string(k_assigned_value_words[static_cast<std::size_t>(method)]);
}

}  // namespace gumcert::gum
