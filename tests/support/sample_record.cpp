#include "tests/support/sample_record.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace gumcert::test {

std::string decimals(double v, int count) {
    std::array<char, 64> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(v), std::chars_format::fixed, count).ptr;
    const std::string text(buffer.data(), end);
    const bool zero = text.find_first_not_of("0.") == std::string::npos;
    return v < 0.0 && !zero ? "\u2212" + text : text;
}

reports::Printed printed(double value, double U, const std::string& unit) {
    int count = 1;
    for (double top = 0.995; top > U && count < 6; top /= 10.0) {
        ++count;
    }
    return {.value = decimals(value, count), .U = decimals(U, count), .unit = unit};
}

reports::StatedValue stated_value(double value, double u, const std::string& unit) {
    reports::StatedValue e;
    e.value = value;
    e.u = u;
    e.nu_eff = 412.7;
    e.U = e.k * u;
    e.printed = printed(value, e.U, unit);
    return e;
}

reports::MonteCarloSummary trials_of(double value, double u, bool validated, bool precise) {
    reports::MonteCarloSummary m;
    m.trials = {100000, "100000"};
    m.seed = 7;
    m.mean = {value, decimals(value, 3)};
    m.u = {u, decimals(u, 3)};
    const double stretch = validated ? 2.0 : 2.3;
    m.symmetric.number = {value - 2.0 * u, value + stretch * u};
    m.shortest.number = {value - 2.01 * u, value + stretch * u};
    m.numerical_error = {
        .mean = 0.003 * u, .u = 0.002 * u, .symmetric = {0.01 * u, 0.01 * u}, .shortest = {0.02 * u, 0.02 * u}};
    reports::GufValidation v;
    v.delta = {0.05 * u, "0.005"};
    v.d_low = {0.01 * u, "0.002"};
    v.d_high = {(stretch - 2.0) * u, validated ? "0.002" : "0.063"};
    v.validated = validated && precise;
    v.precise_enough = precise;
    v.interval = "symmetric";
    v.digits = 2;
    m.validation = v;
    m.symmetric.text = {decimals(m.symmetric.number[0], 2), decimals(m.symmetric.number[1], 2)};
    m.shortest.text = {decimals(m.shortest.number[0], 2), decimals(m.shortest.number[1], 2)};
    return m;
}

reports::TableParameter table_parameter(const std::string& name, const std::string& description, double value, double u,
                                        const std::string& unit) {
    reports::TableParameter p;
    p.name = name;
    p.description = description;
    p.unit = unit;
    p.stated = stated_value(value, u, unit == "um" ? "µm" : "″");
    p.stated.nu_eff = 380.0;
    p.stated.monte_carlo = trials_of(value, u);
    return p;
}

reports::EvaluationRecord sample_record() {
    using namespace gumcert::reports;
    EvaluationRecord r;
    r.software = {.name = "gumcert", .version = "0.1.0", .commit = "0123456789abcdef0123456789abcdef01234567"};
    r.kind = "rotary_table";
    r.title = "Rotary table, A axis, 36 angles, 6 stations, 6 reflectors";
    r.coverage_probability.text = "95.45 %";
    r.job_json = R"({"schema": "gumcert/job/1", "kind": "rotary_table", "home_angle_deg": 0, "scale_u": 1.5e-07})";
    r.options_json = R"({"adjustment": {"max_iterations": 20, "step_tolerance": 1e-12}, "audit": "none"})";
    r.job_files = {{"job.json", std::string(64, 'a')},
                   {"lengths.csv", "3f786850e387550fdab836ed7e6dc881de23001b0f0a4a5e0a4b0c8d1b2e3f40"},
                   {"fixture.csv", std::string(64, '7')}};

    RotaryTable t;
    t.axis = "A";
    t.datum = "axis_average_line";
    t.method = "joint";
    t.error_names = {"EXA", "EYA", "EZA", "EAA", "EBA", "ECA"};
    t.error_units = {"um", "um", "um", "arcsec", "arcsec", "arcsec"};
    const std::array<const char*, 6> units = {"µm", "µm", "µm", "″", "″", "″"};

    t.set_up.O_um = {0.0, 59.43, -192.61};
    t.set_up.S_arcsec = {0.0, 50.782, -108.704};
    t.set_up.u_O_um = {0.0, 0.147, 0.151};
    t.set_up.u_S_arcsec = {0.0, 0.122, 0.131};
    for (std::size_t i = 0; i < 3; ++i) {
        t.set_up.U_O_um[i] = 2.0 * t.set_up.u_O_um[i];
        t.set_up.U_S_arcsec[i] = 2.0 * t.set_up.u_S_arcsec[i];
        t.set_up.printed_O[i] = printed(t.set_up.O_um[i], t.set_up.U_O_um[i], "µm");
        t.set_up.printed_S[i] = printed(t.set_up.S_arcsec[i], t.set_up.U_S_arcsec[i], "″");
    }
    t.set_up.printed_O[0] = {.value = "0", .U = "", .unit = "µm"};
    t.set_up.printed_S[0] = {.value = "0", .U = "", .unit = "″"};
    t.axis_in_fixture = t.set_up;
    for (std::size_t i = 1; i < 3; ++i) {
        t.axis_in_fixture.O_um[i] = -t.set_up.O_um[i];
        t.axis_in_fixture.S_arcsec[i] = -t.set_up.S_arcsec[i];
        t.axis_in_fixture.printed_O[i] = printed(-t.set_up.O_um[i], t.set_up.U_O_um[i], "µm");
        t.axis_in_fixture.printed_S[i] = printed(-t.set_up.S_arcsec[i], t.set_up.U_S_arcsec[i], "″");
    }

    const std::array<double, 6> amplitude = {1.3, 4.2, 3.8, 6.1, 2.4, 2.9};
    const std::array<double, 6> u = {0.21, 0.19, 0.20, 0.33, 0.42, 0.45};
    for (int i = 0; i < 36; ++i) {
        ErrorsAtAngle row;
        row.angle_deg.number = 10.0 * i;
        row.angle_deg.text = decimals(row.angle_deg.number, 0);
        const double theta = row.angle_deg.number * std::numbers::pi / 180.0;
        for (std::size_t m = 0; m < 6; ++m) {
            const double phase = 0.7 * static_cast<double>(m);
            const double value = amplitude[m] * (std::sin(2.0 * theta + phase) + 0.3 * std::cos(5.0 * theta - phase) +
                                                 0.12 * std::sin(17.0 * theta + 2.0 * phase));
            row.errors[m] = stated_value(value, u[m] * (1.0 + 0.15 * std::cos(theta)), units[m]);
            row.errors[m].monte_carlo = trials_of(value, row.errors[m].u, !(i == 3 && m == 0), !(i == 4 && m == 5));
        }
        t.errors.push_back(row);
    }
    for (std::size_t m = 0; m < 6; ++m) {
        reports::StatedValue range = stated_value(2.3 * amplitude[m], 1.4 * u[m], units[m]);
        range.nu_eff.reset();
        range.monte_carlo = trials_of(range.value, range.u, m != 4);
        t.ranges.push_back({.name = t.error_names[m], .stated = range});
        t.reversal.push_back(
            {.name = t.error_names[m],
             .stated = stated_value(m == 3 ? 0.61 : 0.02 * static_cast<double>(m), 0.3 * u[m], units[m])});
    }
    t.covariance_file = "covariance.csv";
    t.covariance_order = {"EXA(0)", "EYA(0)", "O_y", "S_y"};
    t.covariance_unit = "um and arcsec, products";

    for (int i = 1; i <= 6; ++i) {
        const double d = i;
        Station s;
        s.name = "P" + std::to_string(i);
        s.position_mm = {544.0 + 31.0 * d, -817.0 + 190.123 * d, -284.0 + 77.5 * d};
        s.u_mm = {0.0011, 0.0012, 0.0013};
        s.scale_deviation = 1.1e-7 * (d - 3.0);
        s.u_scale = 1.4e-7;
        for (std::size_t c = 0; c < 3; ++c) {
            s.printed_position.push_back(decimals(s.position_mm[c], 4));
            s.printed_U.push_back(decimals(2.0 * s.u_mm[c], 4));
        }
        s.covariance_mm2 = {{{1.21e-6, 0.6e-6 * (d - 3.0) / 3.0, 0.0},
                             {0.6e-6 * (d - 3.0) / 3.0, 1.44e-6, 0.2e-6},
                             {0.0, 0.2e-6, 1.69e-6}}};
        s.printed_scale = {.value = decimals(0.11 * (d - 3.0), 2), .U = "0.28", .unit = "1e-6"};
        t.stations.push_back(s);
        t.dead_paths.push_back({.name = s.name,
                                .value_mm = 190.0 + 10.0 * d,
                                .u_mm = 0.0008,
                                .printed = {.value = decimals(190.0 + 10.0 * d, 4), .U = "0.0016", .unit = "mm"}});
        Reflector m;
        m.name = "R" + std::to_string(i);
        m.position_mm = {33.2569 + 21.0 * (i % 3), 136.307 * std::cos(1.05 * d), 136.307 * std::sin(1.05 * d)};
        m.u_mm = {0.0002, 0.0002, 0.0002};
        m.correction_um = {0.11 * d, -0.07 * d, 0.05};
        for (std::size_t c = 0; c < 3; ++c) {
            m.printed_position.push_back(decimals(m.position_mm[c], 4));
            m.printed_U.push_back("0.0004");
            m.printed_correction.push_back(decimals(m.correction_um[c], 2));
            m.home_position_mm[c] = m.position_mm[c] + 1e-3 * t.set_up.O_um[c];
            m.covariance_mm2[c][c] = m.u_mm[c] * m.u_mm[c];
            m.cmm_mm[c] = m.position_mm[c] - 1e-3 * m.correction_um[c];
            m.u_cmm_mm[c] = 0.0004 + 1e-6 * d;
            m.printed_cmm.push_back(decimals(m.cmm_mm[c], 4));
            m.printed_U_cmm.push_back("0.0008");
        }
        t.reflectors.push_back(m);
    }

    t.budget_sources = {"length noise", "scale", "dead path", "fixture CMM", "fixture thermal", "table repeatability"};
    const std::vector<double> shares = {0.021, 0.034, 0.005, 0.06, 0.0, 0.88};
    for (std::size_t m = 0; m < 6; ++m) {
        for (const ErrorsAtAngle& row : t.errors) {
            t.budget.push_back({.quantity = t.error_names[m],
                                .angle_deg = row.angle_deg.number,
                                .u = row.errors[m].u,
                                .unit = t.error_units[m],
                                .shares = shares});
        }
        t.budget_summary.push_back({.quantity = t.error_names[m],
                                    .rms_u = {u[m], decimals(u[m], 2)},
                                    .unit = t.error_units[m],
                                    .shares = {shares, {"2.1", "3.4", "0.5", "6.0", "0.0", "88.0"}}});
    }
    t.budget.push_back({.quantity = "O_y", .angle_deg = {}, .u = 0.147, .unit = "um", .shares = shares});

    t.adjustment.method = "joint";
    t.adjustment.observations = 1314;
    t.adjustment.parameters = 268;
    t.adjustment.degrees_of_freedom = 1046;
    t.adjustment.iterations = 4;
    t.adjustment.chi_square = {1032.647, "1032.6"};
    t.adjustment.p_value = {0.61, "0.61"};
    t.adjustment.condition_number = {2960.0, "3.0e3"};
    t.adjustment.variance_factor = {.a_priori = 1.0,
                                    .a_posteriori = {0.98723, "0.987"},
                                    .used = "a_priori",
                                    .reason =
                                        "The variance components were estimated, so the a-posteriori factor is 1 but "
                                        "for the iteration; the stated factor is used."};
    t.adjustment.global_test = {.probability = 0.95,
                                .lower = {958.271, "958.3"},
                                .upper = {1137.503, "1137.5"},
                                .accepted = true,
                                .meaning =
                                    "Three components were estimated from the same residuals: the test can only "
                                    "find what they do not describe."};
    t.variance_components = {{"length noise", 0.0512, 0.0011, "um", 812.0, true, {"0.0512", "0.0011", "µm"}},
                             {"table linear", 0.148, 0.011, "um", 96.2, true, {"0.148", "0.011", "µm"}},
                             {"table angular, axial", 0.31, 0.04, "arcsec", 33.0, true, {"0.31", "0.04", "″"}},
                             {"table angular, tilt", 0.29, 0.02, "arcsec", 68.0, false, {"0.290", "0.020", "″"}}};
    for (std::size_t i = 0; i < t.variance_components.size(); ++i) {
        VarianceComponent& v = t.variance_components[i];
        v.used = i != 3;
        if (i == 0 || i == 3) {
            v.stated = i == 0 ? Shown<double>{0.05, "0.05"} : Shown<double>{0.3, "0.3"};
        }
        if (i != 3) {
            v.degrees_of_freedom = 0.97 * v.redundancy;
        }
    }
    for (int station = 1; station <= 6; ++station) {
        for (int i = 0; i < 36; ++i) {
            for (int m = 1; m <= 6; ++m) {
                const bool removed = station == 1 && m == 3 && i == 2;
                const double wave = std::sin(1.7 * station + 2.9 * i * i + 5.3 * m * i);
                t.reliability.push_back({.station = "P" + std::to_string(station),
                                         .reflector = "R" + std::to_string(m),
                                         .pass = "P" + std::to_string(station) + "-1",
                                         .angle_deg = 10.0 * i,
                                         .residual_um = removed ? 3.12 : 0.07 * wave * (station == 4 ? 1.8 : 1.0),
                                         .redundancy_number = 0.81 - 0.25 * wave * wave - 0.05 * m,
                                         .test_value = removed ? 61.2 : 1.4 * wave,
                                         .minimal_detectable_bias_um = 0.33 + 0.1 * wave,
                                         .flagged = removed || (station == 4 && m == 6 && i == 31),
                                         .removed = removed});
            }
        }
    }
    t.flagged = {{"P1", "R3", "P1-1", "20", "3.12", "61.2", true, "3.24", "58.7 (3.89)",
                  "largest test value of the first search"},
                 {"P4", "R6", "P4-1", "310", "\u22120.24", "4.3", false, "\u22120.27", "4.3 (3.89)",
                  "flagged; outliers.action is \"report\""}};
    for (std::size_t i = 0; i < 18; ++i) {
        t.fixture_reliability.push_back({.reflector = "R" + std::to_string(i / 3 + 1),
                                         .coordinate = std::string(1, static_cast<char>('x' + i % 3)),
                                         .residual_um = 0.05 * static_cast<double>(i % 5) - 0.1,
                                         .redundancy_number = 0.62 + 0.01 * static_cast<double>(i),
                                         .test_value = 0.3 * static_cast<double>(i % 7) - 0.9,
                                         .minimal_detectable_bias_um = 2.1 - 0.02 * static_cast<double>(i)});
    }
    for (std::size_t m = 0; m < 6; ++m) {
        for (const ErrorsAtAngle& row : t.errors) {
            t.external_reliability.push_back({.quantity = t.error_names[m],
                                              .angle_deg = row.angle_deg.number,
                                              .influence = 0.12 + 0.001 * row.angle_deg.number,
                                              .unit = t.error_units[m],
                                              .ratio_to_U = 0.3 + 0.001 * row.angle_deg.number,
                                              .station = "P4",
                                              .reflector = "R6",
                                              .pass = "P4-1",
                                              .at_angle_deg = row.angle_deg.number,
                                              .minimal_detectable_bias_um = 0.33});
        }
    }
    for (const char* name : {"O_y", "O_z", "S_y", "S_z"}) {
        t.external_reliability.push_back({.quantity = name,
                                          .angle_deg = {},
                                          .influence = 0.021,
                                          .unit = name[0] == 'O' ? "um" : "arcsec",
                                          .ratio_to_U = 0.07,
                                          .station = "P2",
                                          .reflector = "R1",
                                          .pass = "P2-1",
                                          .at_angle_deg = 90.0,
                                          .minimal_detectable_bias_um = 0.35});
    }
    t.axis_line = {table_parameter("axis_y", "position of the axis average line along y", -59.43, 0.147, "um"),
                   table_parameter("axis_z", "position of the axis average line along z", 192.61, 0.151, "um"),
                   table_parameter("axis_b", "orientation of the axis average line about y", -50.782, 0.122, "arcsec"),
                   table_parameter("axis_c", "orientation of the axis average line about z", 108.704, 0.131, "arcsec")};
    t.axis_line[2].stated.monte_carlo = trials_of(-50.782, 0.122, false);

    PositioningAccuracy positioning;
    positioning.runs_up = 5;
    positioning.runs_down = 5;
    const std::array<const char*, 12> positioning_names = {"M",      "E", "E_up",   "E_down", "R",    "R_up",
                                                           "R_down", "B", "B_mean", "A",      "A_up", "A_down"};
    for (std::size_t i = 0; i < positioning_names.size(); ++i) {
        positioning.parameters.push_back(table_parameter(positioning_names[i], "parameter of the positioning",
                                                         6.1 - 0.37 * static_cast<double>(i), 0.11, "arcsec"));
    }
    for (int i = 0; i < 12; ++i) {
        PositioningTarget target;
        target.angle_deg.number = 30.0 * i;
        target.mean_up.number = 2.0 * std::sin(0.5 * i);
        target.mean_down.number = *target.mean_up.number - 0.61;
        target.s_up.number = 0.21;
        target.s_down.number = 0.24;
        target.reversal.number = 0.61;
        target.angle_deg.text = decimals(target.angle_deg.number, 0);
        target.mean_up.text = decimals(*target.mean_up.number, 2);
        target.mean_down.text = decimals(*target.mean_down.number, 2);
        target.s_up.text = "0.21";
        target.s_down.text = "0.24";
        target.reversal.text = "0.61";
        positioning.targets.push_back(target);
    }
    positioning.u_deviation = {0.092, "0.092"};
    positioning.remarks = {"Five runs in each direction: the positional deviations are corrected for nothing."};
    t.iso230_2 = positioning;

    t.monte_carlo = {.trials = 100000,
                     .seed = 7,
                     .most_steps = 4,
                     .mean_steps = 2.31,
                     .compared = 238,
                     .validated = 235,
                     .not_validated = {"EXA(30)", "EBA range", "axis_b"},
                     .statement =
                         "Monte Carlo of the whole measurement: every input was drawn from its own "
                         "distribution, and every trial was adjusted anew."};
    t.exclusions = {{"P1", "R2", "", "+", "30", "14–20", 7, "The beam was broken by a person."},
                    {"", "", "P1-1", "", "", "", 36, "The table was warming up."}};
    t.fixture_budget = {.method = "budget",
                        .file = "fixture_budget.json",
                        .largest = {{"maximum permissible error of the CMM",
                                     {{}, "0"},
                                     "um",
                                     {0.24, "0.24"},
                                     {},
                                     "B",
                                     "uniform",
                                     {1.0, "1"},
                                     {0.24, "0.240"},
                                     {0.92, "92.0"},
                                     "certificate of the CMM",
                                     {},
                                     ""},
                                    {"repeatability of the CMM",
                                     {{}, "0"},
                                     "um",
                                     {0.0708, "0.071"},
                                     {9.0},
                                     "A",
                                     "normal",
                                     {1.0, "1"},
                                     {0.0708, "0.071"},
                                     {0.08, "8.0"},
                                     "ten measurements",
                                     {},
                                     ""}},
                        .largest_coordinate = "x of R6",
                        .remarks = {"The maximum permissible error is taken as a uniform bound."}};
    t.outlier_critical_value = {3.89, "3.89"};
    t.outlier_alpha = 0.0001;
    r.rotary = t;

    Comparison c;
    c.reference_name = "dial indicator";
    c.contact_point_mm = {180.0, 60.0, 40.0};
    c.reference_budget = {{"maximum permissible error",
                           {{}, "0"},
                           "um",
                           {0.577, "0.577"},
                           {},
                           "B",
                           "uniform",
                           {1.0, "1"},
                           {0.577, "0.577"},
                           {0.83, "83"},
                           "dial indicator",
                           {},
                           ""},
                          {"repeatability",
                           {{}, "0"},
                           "um",
                           {0.25, "0.250"},
                           {10.0},
                           "A",
                           "normal",
                           {1.0, "1"},
                           {0.25, "0.250"},
                           {0.157, "16"},
                           "dial indicator",
                           {},
                           ""},
                          {"resolution",
                           {{}, "0"},
                           "um",
                           {0.0289, "0.029"},
                           {},
                           "B",
                           "uniform",
                           {1.0, "1"},
                           {0.0289, "0.029"},
                           {0.002, "0.2"},
                           "dial indicator",
                           {},
                           ""}};
    for (const char* direction : {"x", "y", "z"}) {
        for (int i = 0; i < 36; ++i) {
            const double theta = 10.0 * i * std::numbers::pi / 180.0;
            ComparisonPoint p;
            p.direction = direction;
            p.angle_deg = 10.0 * i;
            p.value.number = 3.1 * std::sin(2.0 * theta + direction[0]);
            p.u = 0.21;
            p.U.number = 0.42;
            p.reference_value.number =
                p.value.number + 0.9 * std::cos(3.0 * theta + direction[0]) + 0.2 * std::sin(23.0 * theta);
            p.reference_u = 0.63;
            p.reference_U.number = 1.26;
            p.D.number = p.value.number - p.reference_value.number;
            p.u_D = std::hypot(*p.u, *p.reference_u);
            p.U_D.number = 2.0 * *p.u_D;
            p.En.number = p.D.number / *p.U_D.number * (i == 9 && p.direction == "z" ? 1.9 : 1.0) -
                          (i == 30 && p.direction == "x" ? 0.9 : 0.0);
            p.zeta.number = 2.0 * *p.En.number;
            p.printed_angle = decimals(*p.angle_deg, 0);
            p.value.text = decimals(p.value.number, 2);
            p.U.text = decimals(*p.U.number, 2);
            p.reference_value.text = decimals(p.reference_value.number, 1);
            p.reference_U.text = decimals(*p.reference_U.number, 1);
            p.D.text = decimals(p.D.number, 1);
            p.U_D.text = decimals(*p.U_D.number, 1);
            p.En.text = decimals(*p.En.number, 2);
            c.points.push_back(p);
        }
    }
    for (const char* direction : {"x", "y", "z", "all"}) {
        ComparisonSummary s;
        s.direction = direction;
        s.points = s.direction == "all" ? 108 : 36;
        s.count_above_1 = s.direction == "all" ? 1 : 0;
        s.mean_abs_En.number = 0.43;
        s.max_abs_En.number = 1.12;
        s.rms_En.number = 0.5;
        s.mean_abs_En.text = "0.43";
        s.max_abs_En.text = "1.12";
        s.rms_En.text = "0.50";
        c.summary.push_back(s);
    }
    c.remarks = {
        "The uncertainty of the dial indicator is not smaller than that of the laser method: |En| below 1 does "
        "not prove the stated uncertainty.",
        "Points of one set-up share systematic errors: 108 scores are not 108 independent proofs."};
    r.comparison = c;

    Result o;
    o.name = "O_y";
    o.description = "offset of the fixture along y";
    o.value = t.set_up.O_um[1];
    o.unit = "um";
    o.u = t.set_up.u_O_um[1];
    o.nu_eff = 380.25;
    o.k = 2.0;
    o.U = 2.0 * o.u;
    o.distribution = "normal";
    o.printed = t.set_up.printed_O[1];
    Result s = o;
    s.name = "A_first_by_name";  // the order of documents is not the order of names
    s.description = "tilt of the fixture about y";
    s.unit = "arcsec";
    s.value = t.set_up.S_arcsec[1];
    s.u = t.set_up.u_S_arcsec[1];
    s.U = 2.0 * s.u;
    s.nu_eff = {};
    s.printed = t.set_up.printed_S[1];
    r.results = {o, s};
    r.diagnostics = {{.code = "GC-ENGINE-0031",
                      .where = "lengths.csv:17",
                      .what = "distance P1 R3 at 20°: test value 61.2",
                      .rule = "the critical value is 3.89",
                      .action = "removed; look at the reflector",
                      .severity = gum::Severity::warning}};
    return r;
}

}  // namespace gumcert::test
