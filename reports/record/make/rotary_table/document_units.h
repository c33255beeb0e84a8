#pragma once

#include <Eigen/Core>

#include "gum/propagation.h"
#include "gum/rotary_table/document_units.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

using gum::DocumentUnit;
using gum::k_arcsec;
using gum::k_mm;
using gum::k_um;
using gum::unit_of;

/// Value and expanded uncertainty in a unit of the document. Without uncertainty (the home angle of the home datum)
/// the value is zero by definition.
[[nodiscard]] reports::Printed printed(double value, double U, const DocumentUnit& unit);

/// One output of a law of propagation in the unit of the document, as it is stated and printed.
[[nodiscard]] reports::StatedValue stated_value(const gum::UncertaintyBudget& propagation, Eigen::Index i,
                                                const DocumentUnit& unit);

}  // namespace gumcert::reports
