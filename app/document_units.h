#pragma once

#include <Eigen/Core>

#include "gum/propagation.h"
#include "gum/quantity/measurement_model.h"
#include "gum/quantity/units.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// A unit of a document: factor to SI, name in the record, name in print.
struct DocumentUnit {
    double si;
    const char* record;
    const char* print;
};
constexpr DocumentUnit k_um{gum::k_micrometre, "um", "µm"};
constexpr DocumentUnit k_arcsec{gum::k_arcsecond, "arcsec", "″"};
constexpr DocumentUnit k_mm{gum::k_millimetre, "mm", "mm"};

/// The unit of that name in a record, "um" or "arcsec".
[[nodiscard]] const DocumentUnit& unit_of(const std::string& record_name);

/// Micrometres for lengths, arcseconds for angles.
[[nodiscard]] const DocumentUnit& unit_of(const gum::OutputQuantity& quantity);

/// Value and expanded uncertainty in a unit of the document. Without uncertainty (the home angle of the home datum)
/// the value is zero by definition.
[[nodiscard]] reports::Printed printed(double value, double U, const DocumentUnit& unit);

/// One output of a law of propagation in the unit of the document, as it is stated and printed.
[[nodiscard]] reports::StatedValue stated_value(const gum::UncertaintyBudget& propagation, Eigen::Index i,
                                                const DocumentUnit& unit);

}  // namespace gumcert::app
