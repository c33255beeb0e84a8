#include "reports/studies/simulation_texts.h"

#include <cmath>

#include "engine/rotary_table/rotary_table_model.h"
#include "gum/quantity/units.h"
#include "gum/rounding.h"

namespace gumcert::reports::simulation {

using engine::Datum;
using engine::RotaryTableMeasurement;
using gum::Estimator;
using gum::k_linear_tally;
using gum::k_offset_tally;
using gum::k_tilt_tally;

double Scales::of(std::size_t tally) const {
    switch (tally) {
        case k_offset_tally:
            return offset;
        case k_tilt_tally:
            return tilt;
        case k_linear_tally:
            return linear;
        default:
            return angular;
    }
}

Scales scales_of(const gum::SimulationRequest& request) {
    return {std::abs(request.set_up_offset), std::abs(request.set_up_tilt), request.error_linear,
            request.error_angular};
}

std::string percent_text(double share, int decimals) {
    return gum::round_to_quantum(100.0 * share, decimals);
}

std::string micrometres(double value) {
    return gum::round_significant(value / gum::k_micrometre, 3);
}

std::string arcseconds(double value) {
    return gum::round_significant(value / gum::k_arcsecond, 3);
}

std::string method_text(const Estimator& estimator) {
    return std::string(estimator.method == engine::AdjustmentMethod::joint ? "joint" : "sequential") + ", " +
           (estimator.datum == Datum::axis_average_line ? "average line" : "home");
}

const char* method_word(const Estimator& estimator) {
    return estimator.method == engine::AdjustmentMethod::joint ? "joint" : "sequential";
}

const char* datum_word(Datum datum) {
    return datum == Datum::axis_average_line ? "axis_average_line" : "home";
}

std::string relative(double value, double scale) {
    return scale > 0.0 ? percent_text(value / scale) : "";
}

std::vector<std::pair<std::size_t, std::string>> named_tallies(const RotaryTableMeasurement& layout) {
    std::vector<std::pair<std::size_t, std::string>> names;
    const auto motions = engine::error_motion_names(layout.axis);
    for (std::size_t c = 0; c < motions.size(); ++c) {
        names.emplace_back(c, motions[c]);
    }
    const auto across = engine::across_axis(layout.axis);
    for (std::size_t c = 0; c < 2; ++c) {
        names.emplace_back(6 + c, std::string("O") + "xyz"[across[c]]);
    }
    for (std::size_t c = 0; c < 2; ++c) {
        names.emplace_back(8 + c, std::string("S") + "xyz"[across[c]]);
    }
    return names;
}

bool is_linear(std::size_t tally) {
    return tally < 3 || tally == 6 || tally == 7 || tally == k_linear_tally || tally == k_offset_tally;
}

}  // namespace gumcert::reports::simulation
