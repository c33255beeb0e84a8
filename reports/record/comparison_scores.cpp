#include "reports/record/comparison_scores.h"

namespace gumcert::reports {

Shown<std::optional<double>> score_of(const ComparisonPoint& p, const std::string& score) {
    return score == "En"        ? p.En
           : score == "zeta"    ? p.zeta
           : score == "z"       ? p.z
           : score == "z_prime" ? p.z_prime
           : score == "D"       ? Shown<std::optional<double>>(p.D)
                                : Shown<std::optional<double>>();
}

}  // namespace gumcert::reports
