#include "app/adjustment_record.h"

#include <cmath>
#include <string>
#include <utility>

#include "app/document_units.h"
#include "app/record_parts.h"
#include "gum/coverage.h"
#include "gum/rounding.h"

namespace gumcert::app {

using engine::RotaryTableSolution;
using reports::Printed;

void fill_adjustment(reports::RotaryTable& rotary, const RotaryTableSolution& solution,
                     const engine::RotaryTableMeasurement& measurement, const engine::EvaluationOptions& options,
                     double k) {
    for (std::size_t j = 0; j < solution.stations.size(); ++j) {
        const engine::StationEstimate& from = solution.stations[j];
        reports::Station station;
        station.name = measurement.stations[j];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto at = static_cast<Eigen::Index>(c);
            station.position_mm[c] = from.position[at] / gum::k_millimetre;
            station.u_mm[c] = from.u[at] / gum::k_millimetre;
            const Printed text = printed(station.position_mm[c], k * station.u_mm[c], k_mm);
            station.printed_position.push_back(text.value);
            station.printed_U.push_back(text.U);
        }
        station.scale_deviation = from.scale_deviation;
        station.u_scale = from.u_scale;
        if (from.u_scale > 0.0) {
            const gum::RoundedPair scale =
                gum::round_to_uncertainty(1e6 * from.scale_deviation, 1e6 * k * from.u_scale);
            station.printed_scale = {scale.value, scale.U, "1e-6"};
        }
        rotary.stations.push_back(std::move(station));
    }
    for (std::size_t d = 0; d < measurement.dead_paths.size(); ++d) {
        const auto at = static_cast<Eigen::Index>(d);
        reports::DeadPath path;
        path.name = measurement.dead_paths[d];
        path.value_mm = solution.dead_paths[at] / gum::k_millimetre;
        path.u_mm = solution.u_dead_paths[at] / gum::k_millimetre;
        path.printed = printed(path.value_mm, k * path.u_mm, k_mm);
        rotary.dead_paths.push_back(std::move(path));
    }
    for (std::size_t m = 0; m < measurement.reflectors.size(); ++m) {
        const auto row = static_cast<Eigen::Index>(m);
        reports::Reflector reflector;
        reflector.name = measurement.reflectors[m];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto at = static_cast<Eigen::Index>(c);
            reflector.position_mm[c] = solution.fixture(row, at) / gum::k_millimetre;
            reflector.u_mm[c] = solution.u_fixture(row, at) / gum::k_millimetre;
            reflector.correction_um[c] = (solution.fixture(row, at) - measurement.fixture(row, at)) / gum::k_micrometre;
            const Printed text = printed(reflector.position_mm[c], k * reflector.u_mm[c], k_mm);
            reflector.printed_correction.push_back(gum::round_to_quantum(reflector.correction_um[c], 2));
            reflector.printed_position.push_back(text.value);
            reflector.printed_U.push_back(text.U);
        }
        rotary.reflectors.push_back(std::move(reflector));
    }

    reports::AdjustmentSummary& adjustment = rotary.adjustment;
    adjustment.method = rotary.method;
    adjustment.observations = solution.observations;
    adjustment.parameters = solution.parameters;
    adjustment.degrees_of_freedom = solution.degrees_of_freedom;
    adjustment.iterations = solution.iterations;
    adjustment.chi_square = solution.chi_square;
    const auto nu = static_cast<double>(solution.degrees_of_freedom);
    adjustment.p_value = nu > 0.0 ? gum::chi_square_upper_tail(solution.chi_square, nu) : 1.0;
    adjustment.condition_number = solution.condition_number;
    adjustment.variance_factor = {1.0, nu > 0.0 ? solution.chi_square / nu : 1.0, "a_priori"};
    adjustment.printed.chi_square = gum::round_to_quantum(adjustment.chi_square, 1);
    adjustment.printed.p_value = gum::round_significant(adjustment.p_value, 2);
    adjustment.printed.variance_factor = gum::round_to_quantum(adjustment.variance_factor.a_posteriori, 3);
    adjustment.printed.condition_number = gum::round_significant(adjustment.condition_number, 2);

    for (const engine::VarianceComponent& from : solution.components) {
        const DocumentUnit& unit = from.angular ? k_arcsec : k_um;
        reports::VarianceComponent component;
        component.name = from.name;
        component.value = from.value / unit.si;
        component.u = from.u / unit.si;
        component.unit = unit.record;
        component.redundancy = from.redundancy;
        component.estimated = from.estimated;
        component.printed = component.u > 0.0 ? printed(component.value, component.u, unit)
                                              : Printed{gum::round_significant(component.value, 2), "", unit.print};
        rotary.variance_components.push_back(std::move(component));
    }

    rotary.outlier_critical_value = options.critical_value;
    rotary.outlier_alpha = measurement.outliers.alpha;
    rotary.printed_critical_value = gum::round_to_quantum(options.critical_value, 2);
    for (std::size_t i = 0; i < solution.reliability.size(); ++i) {
        const engine::LengthObservation& length = measurement.lengths[i];
        const engine::DistanceReliability& from = solution.reliability[i];
        reports::ReliabilityRow row;
        row.station = measurement.stations[length.station];
        row.reflector = measurement.reflectors[length.reflector];
        row.pass = measurement.passes[length.pass];
        row.angle_deg = measurement.angles_deg[length.angle];
        row.residual_um = from.residual / gum::k_micrometre;
        row.redundancy_number = from.redundancy_number;
        row.test_value = from.test_value;
        row.minimal_detectable_bias_um = from.minimal_detectable_bias / gum::k_micrometre;
        row.flagged = from.flagged;
        row.removed = from.removed;
        if (from.flagged) {
            rotary.flagged.push_back({row.station, row.reflector, row.pass, shortest(row.angle_deg),
                                      gum::round_to_quantum(row.residual_um, 2),
                                      gum::round_to_quantum(row.test_value, 1), row.removed});
        }
        rotary.reliability.push_back(std::move(row));
    }
}

}  // namespace gumcert::app
