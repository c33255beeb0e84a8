#pragma once

#include <string>

#include "gum/quantity/measurement_model.h"
#include "gum/quantity/units.h"

namespace gumcert::gum {

/// A unit in which quantities of a rotary table are stated and validated: factor to SI, name in the record, name in
/// print.
struct DocumentUnit {
    double si;
    const char* record;
    const char* print;
};
inline constexpr DocumentUnit k_um{k_micrometre, "um", "µm"};
inline constexpr DocumentUnit k_arcsec{k_arcsecond, "arcsec", "″"};
inline constexpr DocumentUnit k_mm{k_millimetre, "mm", "mm"};

/// The unit of that name in a record, "um" or "arcsec".
[[nodiscard]] const DocumentUnit& unit_of(const std::string& record_name);

/// Micrometres for lengths, arcseconds for angles.
[[nodiscard]] const DocumentUnit& unit_of(const OutputQuantity& quantity);

}  // namespace gumcert::gum
