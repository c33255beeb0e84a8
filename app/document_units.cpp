#include "app/document_units.h"

#include "app/record_parts.h"
#include "gum/rounding.h"

namespace gumcert::app {

const DocumentUnit& unit_of(const std::string& record_name) {
    return record_name == k_um.record ? k_um : k_arcsec;
}

const DocumentUnit& unit_of(const gum::OutputQuantity& quantity) {
    return quantity.unit == "m" ? k_um : k_arcsec;
}

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

}  // namespace gumcert::app
