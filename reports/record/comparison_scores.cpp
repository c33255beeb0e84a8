#include "reports/record/comparison_scores.h"

namespace gumcert::reports {

std::optional<double> score_of(const ComparisonPoint& p, const std::string& score) {
    return score == "En"        ? p.En.number
           : score == "zeta"    ? p.zeta.number
           : score == "z"       ? p.z.number
           : score == "z_prime" ? p.z_prime.number
           : score == "D"       ? std::optional<double>(p.D.number)
                                : std::nullopt;
}

}  // namespace gumcert::reports
