#include "tests/support/sample_evidence.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace gumcert::test {

GroupTestRow sample_group_test(const std::string& kind, bool suspicious) {
    GroupTestRow row{.kind = kind,
                     .tests = 216,
                     .test_value = {61.25, "61.2"},
                     .critical_value = {21.2, "21.2"},
                     .p_value = {5e-15, "5.0E-15"}};
    row.station = "P2";
    row.pass = "P2-1";
    row.angle_deg = {20.0, "20"};
    row.estimate = {4.9, "4.9"};
    row.minimal_detectable = {1.8, "1.8"};
    row.suspicious = suspicious;
    return row;
}

HarmonicRow harmonics_of(const std::string& name, const std::string& unit) {
    HarmonicRow row{.name = name, .unit = unit, .orders = {}, .rms_rest = {0.05, "0.050"}};
    row.orders = {
        {.order = 1, .amplitude = {1.234, "1.234"}, .U = {0.06, "0.060"}, .u = 0.03, .phase_deg = {271.0, "271"}},
        {.order = 2, .amplitude = {0.01, "0.010"}, .U = {0.06, "0.060"}, .u = 0.03, .phase_deg = {10.0, ""}}};
    return row;
}

Environment two_stations() {
    Environment e;
    e.reference_degC.text = "20";
    e.expansion_per_K = {1.15e-5, "11.5"};
    e.u_expansion_per_K = {5e-7, "0.50"};
    e.largest_distance_mm = {312.4, "312"};
    e.largest_share = {0.012, "1.2"};
    StationEnvironment cold{.station = "P1",
                            .fixture_degC = {20.1, "20.100"},
                            .u_fixture_K = {0.03, "0.030"},
                            .expansion_um = {0.36, "0.36"}};
    StationEnvironment warm = cold;
    warm.station = "P2";
    warm.fixture_degC = {20.3, "20.300"};
    warm.air_degC = {20.26, "20.26"};
    warm.expansion_um.text = "1.08";
    e.stations = {cold, warm};
    e.printed_lowest = "20.100";
    e.printed_highest = "20.300";
    e.printed_least_expansion = "0.36";
    e.printed_most_expansion = "1.08";
    return e;
}

reports::EvaluationRecord record_with_evidence() {
    reports::EvaluationRecord record = sample_record();
    reports::RotaryTable& r = *record.rotary;
    r.group_tests = GroupTestSummary{.scale = {1.0, "1.00"}, .kinds = {sample_group_test("visit_length", false)}};
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
            reports::SensePoint p{.angle_deg = at.angle_deg.number};
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
