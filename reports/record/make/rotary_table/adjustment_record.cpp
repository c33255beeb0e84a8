#include "reports/record/make/rotary_table/adjustment_record.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "gum/coverage.h"
#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/rotary_table/document_units.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using engine::RotaryTableMeasurement;
using engine::RotaryTableSolution;
using reports::Printed;

constexpr double k_acceptance = 0.95;  // of the global test
constexpr int k_decimals_of_chi_square = 1;

std::array<std::array<double, 3>, 3> in_square_millimetres(const Eigen::Matrix3d& covariance) {
    std::array<std::array<double, 3>, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            result[i][j] = covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) /
                           (gum::k_millimetre * gum::k_millimetre);
        }
    }
    return result;
}

void fill_stations(reports::RotaryTable& rotary, const RotaryTableSolution& solution,
                   const RotaryTableMeasurement& measurement, double k) {
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
        station.covariance_mm2 = in_square_millimetres(from.covariance);
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
}

void fill_reflectors(reports::RotaryTable& rotary, const RotaryTableSolution& solution,
                     const RotaryTableMeasurement& measurement, double k) {
    for (std::size_t m = 0; m < measurement.reflectors.size(); ++m) {
        const auto row = static_cast<Eigen::Index>(m);
        reports::Reflector reflector;
        reflector.name = measurement.reflectors[m];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto at = static_cast<Eigen::Index>(c);
            reflector.position_mm[c] = solution.fixture(row, at) / gum::k_millimetre;
            reflector.u_mm[c] = solution.u_fixture(row, at) / gum::k_millimetre;
            reflector.correction_um[c] = (solution.fixture(row, at) - measurement.fixture(row, at)) / gum::k_micrometre;
            reflector.cmm_mm[c] = measurement.fixture(row, at) / gum::k_millimetre;
            const Eigen::Index element = 3 * row + at;
            reflector.u_cmm_mm[c] = std::sqrt(measurement.fixture_covariance(element, element)) / gum::k_millimetre;
            const Printed text = printed(reflector.position_mm[c], k * reflector.u_mm[c], k_mm);
            const Printed cmm = printed(reflector.cmm_mm[c], k * reflector.u_cmm_mm[c], k_mm);
            reflector.printed_correction.push_back(gum::round_to_quantum(reflector.correction_um[c], 2));
            reflector.printed_position.push_back(text.value);
            reflector.printed_U.push_back(text.U);
            reflector.printed_cmm.push_back(cmm.value);
            reflector.printed_U_cmm.push_back(cmm.U);
            if (solution.fixture_at_home.rows() > row) {
                reflector.home_position_mm[c] = solution.fixture_at_home(row, at) / gum::k_millimetre;
            }
        }
        if (solution.fixture_position_covariance.size() > m) {
            reflector.covariance_mm2 = in_square_millimetres(solution.fixture_position_covariance[m]);
        }
        rotary.reflectors.push_back(std::move(reflector));
    }
}

/// Chi-square of the adjustment against its distribution, both tails.
/// \param chi_square  gets its text: on the side of the limits on which the number is
reports::GlobalTest global_test(const RotaryTableSolution& solution, reports::Shown<double>& chi_square) {
    const auto nu = static_cast<std::size_t>(solution.degrees_of_freedom);
    // The quantile of chi-square is the square of the factor of the ellipsoid for nu quantities.
    const auto limit = [nu](double probability) {
        return std::pow(gum::ellipsoid_coverage_factor(probability, nu, std::numeric_limits<double>::infinity()), 2);
    };
    reports::GlobalTest test;
    test.probability = k_acceptance;
    const double lower = limit(0.5 * (1.0 - k_acceptance));
    const double upper = limit(0.5 * (1.0 + k_acceptance));
    const std::vector<std::string> texts =
        gum::round_in_order({solution.chi_square, lower, upper}, k_decimals_of_chi_square, &gum::round_to_quantum);
    chi_square.text = texts[0];
    test.lower = {lower, texts[1]};
    test.upper = {upper, texts[2]};
    test.accepted = test.lower.number <= solution.chi_square && solution.chi_square <= test.upper.number;
    if (test.accepted && solution.variance_basis == engine::VarianceBasis::estimated) {
        test.meaning =
            "Variance components were estimated from the same residuals, so that chi-square is near its degrees of "
            "freedom by construction: the test confirms the adjustment, not the stated uncertainties.";
    } else if (test.accepted) {
        test.meaning = "The residuals agree with the stated uncertainties.";
    } else if (solution.chi_square > test.upper.number &&
               gum::chi_square_upper_tail(solution.chi_square, static_cast<double>(nu)) >=
                   reports::k_refuting_probability) {
        test.meaning =
            "The residuals are larger than those of 39 in 40 adjustments with these uncertainties: chance explains "
            "that, but "
            "the uncertainties are in doubt.";
    } else if (solution.chi_square > test.upper.number) {
        test.meaning =
            "The residuals are larger than the stated uncertainties allow: an uncertainty is stated too small, or an "
            "effect is not in the model.";
    } else {
        test.meaning =
            "The residuals are smaller than the stated uncertainties let expect: an uncertainty may be stated too "
            "large.";
    }
    return test;
}

void fill_test(reports::RotaryTable& rotary, const RotaryTableSolution& solution) {
    reports::AdjustmentSummary& adjustment = rotary.adjustment;
    adjustment.method = rotary.method;
    adjustment.observations = solution.observations;
    adjustment.parameters = solution.parameters;
    adjustment.degrees_of_freedom = solution.degrees_of_freedom;
    adjustment.iterations = solution.iterations;
    adjustment.chi_square = shown_to_quantum(solution.chi_square, k_decimals_of_chi_square);
    const auto nu = static_cast<double>(solution.degrees_of_freedom);
    adjustment.p_value = shown_significant(nu > 0.0 ? gum::chi_square_upper_tail(solution.chi_square, nu) : 1.0, 2);
    adjustment.condition_number = shown_significant(solution.condition_number, 2);
    // Estimated components are in the weights; nothing is multiplied by chi-square per degree of freedom.
    adjustment.variance_factor = {.a_priori = 1.0,
                                  .a_posteriori = shown_to_quantum(solution.variance_factor, 3),
                                  .used = "a_priori",
                                  .reason = solution.variance_factor_reason};
    if (solution.degrees_of_freedom > 0) {
        adjustment.global_test = global_test(solution, adjustment.chi_square);
    }
}

void fill_components(reports::RotaryTable& rotary, const RotaryTableSolution& solution) {
    for (const engine::VarianceComponent& from : solution.components) {
        const DocumentUnit& unit = from.angular ? k_arcsec : k_um;
        reports::VarianceComponent component;
        component.name = from.name;
        component.value = from.value / unit.si;
        component.u = from.u / unit.si;
        component.unit = unit.record;
        component.redundancy = from.redundancy;
        component.estimated = from.estimated;
        component.used = from.used;
        component.printed = component.u > 0.0 ? printed(component.value, component.u, unit)
                                              : Printed{gum::round_significant(component.value, 2), "", unit.print};
        if (from.stated) {
            component.stated = shown_significant(*from.stated / unit.si, 2);
        }
        if (from.estimated) {
            component.degrees_of_freedom = finite_or_none(from.degrees_of_freedom);
        }
        if (from.residuals_give) {
            component.residuals_give = *from.residuals_give / unit.si;
        }
        rotary.variance_components.push_back(std::move(component));
    }
}

/// Names of a distance, as the lists of a record have them.
template <class Row>
void name_distance(Row& row, const RotaryTableMeasurement& measurement, std::size_t length) {
    const engine::LengthObservation& from = measurement.lengths[length];
    row.station = measurement.stations[from.station];
    row.reflector = measurement.reflectors[from.reflector];
    row.pass = measurement.passes[from.pass];
}

reports::FlaggedDistance flagged_distance(const RotaryTableSolution& solution,
                                          const RotaryTableMeasurement& measurement,
                                          const engine::OutlierFinding& finding) {
    const engine::DistanceReliability& reliability = solution.reliability[finding.length];
    reports::FlaggedDistance row;
    name_distance(row, measurement, finding.length);
    row.angle = text::shortest(measurement.angles_deg[measurement.lengths[finding.length].angle]);
    row.residual_um = gum::round_to_quantum(reliability.residual / gum::k_micrometre, 2);
    row.test_value = gum::round_to_quantum(reliability.test_value, 1);
    row.removed = finding.removed;
    row.estimated_error_um = gum::round_to_quantum(finding.estimated_error / gum::k_micrometre, 2);
    if (finding.reason == engine::OutlierReason::gross_error) {
        row.reason = "off by more than the start values can be: found before the adjustment";
    } else {
        row.found_with = gum::round_to_quantum(std::abs(finding.test_value), 2) + " > " +
                         gum::round_to_quantum(finding.critical_value, 2);
        row.reason = "largest test value, above the critical one";
    }
    return row;
}

void fill_reliability(reports::RotaryTable& rotary, const RotaryTableSolution& solution,
                      const RotaryTableMeasurement& measurement, const gum::UncertaintyBudget& propagation) {
    rotary.outlier_critical_value = shown_to_quantum(solution.critical_value, 2);
    rotary.outlier_alpha = measurement.outliers.alpha;
    for (std::size_t i = 0; i < solution.reliability.size(); ++i) {
        const engine::DistanceReliability& from = solution.reliability[i];
        reports::ReliabilityRow row;
        name_distance(row, measurement, i);
        row.angle_deg = measurement.angles_deg[measurement.lengths[i].angle];
        row.residual_um = from.residual / gum::k_micrometre;
        row.redundancy_number = from.redundancy_number;
        row.test_value = from.test_value;
        row.minimal_detectable_bias_um = from.minimal_detectable_bias / gum::k_micrometre;
        row.flagged = from.flagged;
        row.removed = from.removed;
        rotary.reliability.push_back(std::move(row));
    }
    for (const engine::OutlierFinding& finding : solution.outliers) {
        if (!finding.came_back) {
            rotary.flagged.push_back(flagged_distance(solution, measurement, finding));
        }
    }
    for (std::size_t i = 0; i < solution.fixture_reliability.size(); ++i) {
        const engine::CoordinateReliability& from = solution.fixture_reliability[i];
        rotary.fixture_reliability.push_back({measurement.reflectors[i / 3], std::string(1, "xyz"[i % 3]),
                                              from.residual / gum::k_micrometre, from.redundancy_number,
                                              from.test_value, from.minimal_detectable_bias / gum::k_micrometre});
    }
    const std::size_t errors = 6 * measurement.angles.size();
    for (const engine::ExternalReliability& from : solution.external_reliability) {
        const gum::OutputQuantity& quantity = solution.quantities.outputs[from.quantity];
        const DocumentUnit& unit = unit_of(quantity);
        reports::ExternalReliability row;
        row.quantity = from.quantity < errors ? rotary.error_names[from.quantity % 6] : quantity.name;
        if (from.quantity < errors) {
            row.angle_deg = measurement.angles_deg[from.quantity / 6];
        }
        row.influence = from.influence / unit.si;
        row.unit = unit.record;
        const double U = propagation.expanded_uncertainty[static_cast<Eigen::Index>(from.quantity)];
        row.ratio_to_U = U > 0.0 ? std::abs(from.influence) / U : 0.0;
        name_distance(row, measurement, from.length);
        row.at_angle_deg = measurement.angles_deg[measurement.lengths[from.length].angle];
        row.minimal_detectable_bias_um = solution.reliability[from.length].minimal_detectable_bias / gum::k_micrometre;
        rotary.external_reliability.push_back(std::move(row));
    }
}

}  // namespace

void fill_adjustment(reports::RotaryTable& rotary, const RotaryTableSolution& solution,
                     const RotaryTableMeasurement& measurement, const gum::UncertaintyBudget& propagation, double k) {
    fill_stations(rotary, solution, measurement, k);
    fill_reflectors(rotary, solution, measurement, k);
    fill_test(rotary, solution);
    fill_components(rotary, solution);
    fill_reliability(rotary, solution, measurement, propagation);
}

}  // namespace gumcert::reports
