#include "laboratory/standard_record.h"

#include <limits>

#include "certificate/dates.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::laboratory {

double standard_uncertainty(const CalibrationResult& result) {
    if (result.k) {
        return result.U / *result.k;
    }
    if (!result.p) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-LAB-0010",
                                              .where = "result \"" + result.quantity + "\"",
                                              .what = "U without coverage factor and without coverage probability",
                                              .rule = "an expanded uncertainty means something with k or p only",
                                              .action = "state k, or p, as the certificate does"});
    }
    // Without k the certificate states p: U is taken back to u with the t-distribution of its ν, normal where none is
    // stated.
    return result.U / gum::coverage_factor(*result.p, result.nu.value_or(std::numeric_limits<double>::infinity()));
}

const Calibration* calibration_on(const StandardRecord& record, std::string_view day) {
    const Calibration* last = nullptr;
    for (const Calibration& calibration : record.calibrations) {
        if (!certificate::is_after(calibration.calibrated, day)) {
            last = &calibration;
        }
    }
    return last;
}

}  // namespace gumcert::laboratory
