#include "reports/record/make/rotary_table/document_units.h"

#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"

namespace gumcert::reports {

reports::Printed printed(double value, double U, const DocumentUnit& unit) {
    if (!(U > 0.0)) {
        return {"0", "", unit.print};
    }
    const gum::RoundedPair pair = gum::round_to_uncertainty(value, U);
    return {pair.value, pair.U, unit.print};
}

reports::StatedValue stated_value(const gum::UncertaintyBudget& propagation, Eigen::Index i, const DocumentUnit& unit) {
    reports::StatedValue result;
    result.value = propagation.value[i] / unit.si;
    result.u = propagation.standard_uncertainty[i] / unit.si;
    result.U = propagation.expanded_uncertainty[i] / unit.si;
    result.k = propagation.coverage_factor[i];
    result.nu_eff = finite_or_none(propagation.effective_degrees_of_freedom[i]);
    result.printed = printed(result.value, result.U, unit);
    return result;
}

}  // namespace gumcert::reports
