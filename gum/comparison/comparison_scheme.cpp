#include "gum/comparison/comparison_scheme.h"

#include "gum/argument_check.h"

namespace gumcert::gum {

ResultUncertainty stated_expanded(double U, double k) {
    require_positive(U, "expanded uncertainty");
    require_positive(k, "coverage factor");
    return {.u = U / k, .U = U, .k = k, .stated_as_expanded = true};
}

std::string word_of(AssignedValueMethod method) {
    return std::string(k_assigned_value_words[static_cast<std::size_t>(method)]);
}

}  // namespace gumcert::gum
