#pragma once

#include <Eigen/Core>
#include <optional>

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

/// Micrometres for lengths, arcseconds for angles.
[[nodiscard]] const DocumentUnit& unit_of(const gum::OutputQuantity& quantity);

/// Value and expanded uncertainty in a unit of the document. Without uncertainty (the home angle of the home datum)
/// the value is zero by definition.
[[nodiscard]] reports::Printed printed(double value, double U, const DocumentUnit& unit);

/// One reported quantity in the unit of the document.
struct Reported {
    double value, u, U, k;
    std::optional<double> nu_eff;
    reports::Printed text;
};

[[nodiscard]] Reported reported(const gum::UncertaintyBudget& propagation, Eigen::Index i, const DocumentUnit& unit);

}  // namespace gumcert::app
