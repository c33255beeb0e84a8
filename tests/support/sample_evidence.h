#pragma once

#include <cstddef>
#include <string>

#include "tests/support/sample_record.h"

namespace gumcert::test {

using reports::Environment;
using reports::GroupTestRow;
using reports::GroupTestSummary;
using reports::HarmonicOrder;
using reports::HarmonicRow;
using reports::StationEnvironment;

inline GroupTestRow sample_group_test(const std::string& kind, bool suspicious) {
    GroupTestRow row{.kind = kind, .tests = 216, .test_value = 61.25, .critical_value = 21.2, .p_value = 5e-15};
    row.station = "P2";
    row.pass = "P2-1";
    row.angle_deg = 20.0;
    row.estimate = 4.9;
    row.minimal_detectable = 1.8;
    row.suspicious = suspicious;
    row.printed = {"61.2", "21.2", "5.0E-15", "20", "4.9", "1.8"};
    return row;
}

inline HarmonicRow harmonics_of(const std::string& name, const std::string& unit) {
    HarmonicRow row{.name = name, .unit = unit, .orders = {}, .rms_rest = 0.05, .printed_rest = "0.050"};
    HarmonicOrder first{.order = 1, .amplitude = 1.234, .u = 0.03, .U = 0.06, .phase_deg = 271.0};
    first.printed = {"1.234", "0.060", "271"};
    HarmonicOrder second{.order = 2, .amplitude = 0.01, .u = 0.03, .U = 0.06, .phase_deg = 10.0};
    second.printed = {"0.010", "0.060", ""};
    row.orders = {first, second};
    return row;
}

inline Environment two_stations() {
    Environment e;
    e.expansion_per_K = 1.15e-5;
    e.u_expansion_per_K = 5e-7;
    e.largest_distance_mm = 312.4;
    e.largest_share = 0.012;
    StationEnvironment cold{.station = "P1", .fixture_degC = 20.1, .u_fixture_K = 0.03, .expansion_um = 0.36};
    cold.printed = {"20.100", "0.030", "", "", "", "0.36"};
    StationEnvironment warm = cold;
    warm.station = "P2";
    warm.fixture_degC = 20.3;
    warm.air_degC = 20.26;
    warm.printed = {"20.300", "0.030", "20.26", "", "", "1.08"};
    e.stations = {cold, warm};
    e.printed = {"20", "11.5", "0.50", "312", "1.2", "20.100", "20.300", "0.36", "1.08"};
    return e;
}

/// A sample record with everything that a rotary table has beside its results.
inline reports::EvaluationRecord record_with_evidence() {
    reports::EvaluationRecord record = sample_record();
    reports::RotaryTable& r = *record.rotary;
    r.group_tests = GroupTestSummary{.kinds = {sample_group_test("visit_length", false)}, .printed_scale = "1.00"};
    r.visits = {{.station = "P1",
                 .pass = "P1-1",
                 .direction = "+",
                 .angle_deg = 0.0,
                 .deviation_um = 0.1,
                 .limit_um = 0.5,
                 .axial_arcsec = 0.3},
                {.station = "P2",
                 .pass = "P2-1",
                 .direction = "-",
                 .angle_deg = 10.0,
                 .deviation_um = -0.2,
                 .limit_um = 0.5,
                 .axial_arcsec = {}}};
    for (const char* direction : {"+", "-"}) {
        reports::SenseCurve curve{.direction = direction, .points = {}};
        for (const reports::ErrorsAtAngle& at : r.errors) {
            reports::SensePoint p{.angle_deg = at.angle_deg};
            for (std::size_t i = 0; i < 6; ++i) {
                p.value[i] = at.errors[i].value;
                p.u[i] = 0.1;
                p.U[i] = 0.2;
            }
            curve.points.push_back(p);
        }
        r.sense_curves.push_back(curve);
    }
    for (std::size_t i = 0; i < 6; ++i) {
        r.harmonics.push_back(harmonics_of(r.error_names[i], r.error_units[i]));
    }
    r.environment = two_stations();
    if (r.iso230_2) {
        r.iso230_2->targets[0].runs_up = {0.5, 0.7};
        r.iso230_2->targets[0].runs_down = {-0.5};
    }
    return record;
}

}  // namespace gumcert::test
