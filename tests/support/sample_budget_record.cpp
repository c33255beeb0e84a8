#include "tests/support/sample_budget_record.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace gumcert::test {

void fill_histogram(reports::MonteCarloSummary& m, double low, double high, int cells) {
    m.histogram_low = low;
    m.histogram_high = high;
    const double width = (high - low) / cells;
    const auto below = [&](double x) {
        return 0.5 * std::erfc((*m.mean.number - x) / (*m.u.number * std::numbers::sqrt2));
    };
    for (int i = 0; i < cells; ++i) {
        const double fraction = below(low + (i + 1) * width) - below(low + i * width);
        m.histogram.push_back(static_cast<std::int64_t>(std::floor(fraction * static_cast<double>(m.trials.number))));
    }
}

reports::BudgetRow budget_row(const std::string& input, double value, const std::string& unit, double u,
                              std::optional<double> nu, const std::string& type, const std::string& distribution,
                              double sensitivity, double u_result) {
    reports::BudgetRow row;
    row.input = input;
    row.value.number = value;
    row.unit = unit;
    row.u.number = u;
    row.nu.number = nu;
    row.type = type;
    row.distribution = distribution;
    row.sensitivity.number = sensitivity;
    row.contribution.number = std::abs(sensitivity) * u;
    row.share.number = std::pow(row.contribution.number / u_result, 2);
    row.contribution.text = decimals(row.contribution.number, row.contribution.number < 1.0 ? 4 : 1);
    row.share.text = decimals(100.0 * row.share.number, 1);
    return row;
}

reports::EvaluationRecord sample_budget_record() {
    using namespace gumcert::reports;
    EvaluationRecord r;
    r.software = {.name = "gumcert", .version = "0.2.0", .commit = "0123456789abcdef0123456789abcdef01234567"};
    r.kind = "budget";
    r.title = "End gauge, nominal length 50 mm";
    r.coverage_probability = {0.99, "99 %"};
    r.job_json = R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["l = l_s + d"]})";
    r.options_json = R"({"monte_carlo": {"trials": 1000000}})";
    r.job_files = {{"end_gauge.json", std::string(64, 'b')}};
    r.model = ModelSummary{.equations = {"l = l_s + d - l_s*(d_alpha*theta + alpha_s*d_theta)"}, .unknowns = {}};

    Result l;
    l.name = "l";
    l.quantity = "l";
    l.description = "length of the end gauge at 20 °C";
    l.value = 50000838.0;
    l.unit = "nm";
    l.u = 31.7;
    l.nu_eff = 16.7;
    l.k = 2.92;
    l.coverage_probability = 0.99;
    l.U = 92.6;
    l.distribution = "t";
    l.coverage = "student_t";
    l.printed = {.value = "50000838", .U = "93", .unit = "nm"};
    BudgetRow l_s = budget_row("l_s", 50000623.0, "nm", 25.0, 18.0, "B", "t", 1.0, l.u);
    l_s.source = "certificate of the standard, No. 4711";
    l_s.value.text = "50000623";
    l_s.u.text = "25";
    l_s.nu.text = "18";
    l_s.sensitivity.text = "1";
    BudgetRow d = budget_row("d", 215.0, "nm", 9.7, 25.6, "A", "t", 1.0, l.u);
    d.value.text = "215.0";
    d.u.text = "9.7";
    d.nu.text = "25";
    d.sensitivity.text = "1";
    const auto part = [&](const char* name, double value, double u, double nu, const char* type, const char* source) {
        BudgetRow row = budget_row(name, value, "nm", u, nu, type, "t", 1.0, l.u);
        row.source = source;
        row.value.text = decimals(value, 1);
        row.u.text = decimals(u, 1);
        row.nu.text = decimals(nu, 0);
        row.sensitivity.text = "1";
        return row;
    };
    d.components = {part("repeatability", 215.0, 5.8, 24.0, "A", "five readings"),
                    part("comparator, random", 0.0, 3.9, 5.0, "B", "certificate of the comparator"),
                    part("comparator, systematic", 0.0, 6.7, 8.0, "B", "certificate of the comparator")};
    BudgetRow alpha_s = budget_row("alpha_s", 11.5e-6, "1/K", 1.2e-6, {}, "B", "uniform", 0.0, l.u);
    alpha_s.value.text = "1.15E-5";
    alpha_s.u.text = "1.2E-6";
    alpha_s.sensitivity.text = "0";
    alpha_s.contribution.text = "0";
    BudgetRow d_alpha = budget_row("d_alpha", 0.0, "1/K", 0.58e-6, 50.0, "B", "uniform", 5000062.3, l.u);
    d_alpha.value.text = "0";
    d_alpha.u.text = "5.8E-7";
    d_alpha.nu.text = "50";
    d_alpha.sensitivity.text = "5.00E+6";
    BudgetRow theta = budget_row("theta", -0.1, "degC", 0.41, {}, "B", "normal", 0.0, l.u);
    theta.value.text = "-0.10";
    theta.u.text = "0.41";
    theta.sensitivity.text = "0";
    theta.contribution.text = "0";
    BudgetRow d_theta = budget_row("d_theta", 0.0, "K", 0.029, 2.0, "B", "uniform", -575.0, l.u);
    d_theta.value.text = "0";
    d_theta.u.text = "0.029";
    d_theta.nu.text = "2";
    d_theta.sensitivity.text = "-575";
    l.budget = {l_s, d, alpha_s, d_alpha, theta, d_theta};
    l.second_order = SecondOrder{.first_order_u = {31.7, "32"}, .u = {33.8, "34"}, .shift = {0.0, "0"}};

    MonteCarloSummary m;
    m.trials = {1000000, "1000000"};
    m.seed = 1;
    m.mean = {50000838.1, "50000838.1"};
    m.u = {35.6, "35.6"};
    m.symmetric = {{50000745.2, 50000931.9}, {"50000745", "50000932"}};
    m.shortest = {{50000744.8, 50000931.1}, {"50000744.8", "50000931.1"}};
    m.numerical_error = {.mean = 0.036, .u = 0.025, .symmetric = {0.41, 0.43}, .shortest = {0.52, 0.55}};
    m.validation = GufValidation{.delta = {0.5, "0.50"},
                                 .d_low = {0.2, "0.20"},
                                 .d_high = {1.3, "1.3"},
                                 .validated = false,
                                 .precise_enough = true,
                                 .interval = "symmetric",
                                 .digits = 2};
    fill_histogram(m, l.value - 180.0, l.value + 180.0, 90);
    l.monte_carlo = m;
    r.results = {l};
    r.diagnostics = {{.code = "GC-ENGINE-0101",
                      .where = "end_gauge.json#/model/0",
                      .what = "second-order terms raise u(l) from 32 nm to 34 nm",
                      .rule = "the law of propagation takes the first order only",
                      .action = "use the Monte Carlo result",
                      .severity = gum::Severity::warning}};
    return r;
}

reports::EvaluationRecord sample_two_results_record() {
    using namespace gumcert::reports;
    EvaluationRecord r = sample_budget_record();
    r.title = "Resistance and reactance of a circuit element";
    r.coverage_probability = {0.9545, "95.45 %"};
    r.model = ModelSummary{.equations = {"R = V/I*cos(phi)", "0 = X - V/I*sin(phi)"}, .unknowns = {"X"}};
    r.results.clear();
    r.diagnostics.clear();
    struct Numbers {
        const char* name;
        const char* description;
        double value, u, c_V, c_I, c_phi;
        Printed printed;
        const char* correlation;
        const char* share;
    };
    const std::array<Numbers, 2> both = {
        Numbers{
            "R", "resistance", 127.732, 0.071, 25.551, -6496.7, -219.85, {"127.73", "0.20", "Ω"}, "-0.1806", "-647.3"},
        Numbers{
            "X", "reactance", 219.847, 0.2956, 43.978, -11182.0, 127.73, {"219.85", "0.82", "Ω"}, "0.2146", "52.7"}};
    for (const Numbers& n : both) {
        Result y;
        y.name = n.name;
        y.quantity = n.name;
        y.description = n.description;
        y.value = n.value;
        y.unit = "ohm";
        y.u = n.u;
        y.nu_eff = 4.0;
        y.k = 2.869;
        y.coverage_probability = 0.9545;
        y.U = 2.869 * n.u;
        y.distribution = "t";
        y.printed = n.printed;
        BudgetRow V = budget_row("V", 4.999, "V", 0.0032, 4.0, "A", "t", n.c_V, n.u);
        V.value.text = "4.9990";
        V.u.text = "0.0032";
        V.nu.text = "4";
        V.sensitivity.text = decimals(n.c_V, 2);
        V.source = "voltmeter 17";
        BudgetRow I = budget_row("I", 0.019661, "A", 0.0000095, 4.0, "A", "t", n.c_I, n.u);
        I.value.text = "0.0196610";
        I.u.text = "0.0000095";
        I.nu.text = "4";
        I.sensitivity.text = decimals(n.c_I, 1);
        BudgetRow phi = budget_row("phi", 1.04446, "rad", 0.00075, 4.0, "A", "t", n.c_phi, n.u);
        phi.value.text = "1.04446";
        phi.u.text = "0.00075";
        phi.nu.text = "4";
        phi.sensitivity.text = decimals(n.c_phi, 2);
        y.budget = {V, I, phi};
        double sum = 0.0;
        for (const BudgetRow& row : y.budget) {
            sum += row.contribution.number * row.contribution.number;
        }
        const double variance = n.u * n.u - sum;
        y.correlation = CorrelationRow{
            .variance = variance, .printed_contribution = n.correlation, .share = {variance / (n.u * n.u), n.share}};
        r.results.push_back(y);
    }
    // The second result takes its coverage from elsewhere, so that a document needs two sentences.
    r.results[1].coverage = "none";
    r.results[1].coverage_note =
        "The inputs are correlated and have few degrees of freedom; no effective number follows from them.";
    r.results[1].k.reset();
    r.results[1].U.reset();
    r.results[1].nu_eff.reset();
    r.results[1].printed.U = "";

    r.covariance = ResultCovariance{.names = {"R", "X"},
                                    .units = {"ohm", "ohm"},
                                    .matrix = {{0.005041, -0.01234}, {-0.01234, 0.08738}},
                                    .correlation = {{{1.0, -0.588}, {-0.588, 1.0}}, {{"1", "-0.588"}, {"-0.588", "1"}}},
                                    .file = ""};
    r.region = CoverageRegion{.coverage_probability = 0.9545,
                              .from = "Monte Carlo",
                              .degrees_of_freedom = {},
                              .k_p = {2.486, "2.49"},
                              .k_q = {2.211, "2.21"},
                              .smallest_region =
                                  CoverageRegion::SmallestRegion{
                                      .volume = 0.337, .probability = 0.9547, .cells = 512, .cells_per_axis = {50, 50}},
                              .validation = CoverageRegion::Validation{.delta = {0.005, 0.05},
                                                                       .d_value = {0.0004, 0.002},
                                                                       .d_u = {0.0001, 0.003},
                                                                       .delta_eigenvalue = 0.05,
                                                                       .d_eigenvalue = 0.002,
                                                                       .delta_k_p = 0.05,
                                                                       .d_k_p = 0.004,
                                                                       .validated = true}};

    FitSummary fit;
    fit.name = "thermometer";
    fit.equation = "b = y1 + y2*(t - 20)";
    fit.method = "ordinary";
    fit.parameters = {
        {.name = "y1", .unit = "degC", .printed_unit = "°C", .value = {-0.1712, "-0.1712"}, .u = {0.0029, "0.0029"}},
        {.name = "y2", .unit = "1", .value = {0.00218, "0.00218"}, .u = {0.00067, "0.00067"}}};
    fit.covariance = {{8.41e-6, -1.81e-6}, {-1.81e-6, 4.489e-7}};
    fit.correlation = {{1.0, -0.930}, {-0.930, 1.0}};
    fit.degrees_of_freedom = 9.0;
    fit.sum_of_squares = {1.1e-4, "0.00011"};
    fit.residual_standard_deviation = {0.0035, "0.0035"};
    fit.r_squared = {0.54, "0.54"};
    fit.condition_number = 21.0;
    fit.iterations = 1;
    fit.covariance_scaled = true;
    fit.x_name = "t";
    fit.x_unit = "degC";
    fit.y_name = "b";
    fit.y_unit = "K";
    const std::array<double, 11> t = {21.521, 22.012, 22.512, 23.003, 23.507, 23.999,
                                      24.513, 25.002, 25.503, 26.010, 26.511};
    const std::array<double, 11> b = {-0.171, -0.169, -0.166, -0.159, -0.164, -0.165,
                                      -0.156, -0.157, -0.159, -0.161, -0.160};
    for (std::size_t i = 0; i < t.size(); ++i) {
        const double fitted = -0.1712 + 0.00218 * (t[i] - 20.0);
        fit.x.number.push_back(t[i]);
        fit.x.text.push_back(std::to_string(t[i]).substr(0, 6));
        fit.y.number.push_back(b[i]);
        fit.y.text.push_back(std::to_string(b[i]).substr(0, 6));
        fit.fitted.push_back(fitted);
        fit.residual.number.push_back(b[i] - fitted);
        fit.residual.text.push_back(std::to_string(b[i] - fitted).substr(0, 7));
    }
    r.fits = {fit};

    r.readings = {{.input = "V",
                   .component = "",
                   .unit = "V",
                   .point = "",
                   .observations = {"5.007", "4.994", "5.005", "4.990", "4.999"},
                   .n = 5,
                   .mean = {4.999, "4.9990"},
                   .standard_deviation = {0.0072, "0.0072"},
                   .standard_deviation_of_mean = {0.0032, "0.0032"},
                   .pooled_standard_deviation = {},
                   .autocorrelation = {1.0, 0.31, -0.2},
                   .printed_r1 = "0.31",
                   .autocorrelation_limit = {0.88, "0.88"},
                   .dependent = false},
                  {.input = "I",
                   .component = "repeatability",
                   .unit = "A",
                   .point = "",
                   .observations = {},
                   .n = 5,
                   .mean = {0.019661, "0.0196610"},
                   .standard_deviation = {2.1e-5, "0.000021"},
                   .standard_deviation_of_mean = {9.5e-6, "0.0000095"},
                   .pooled_standard_deviation = 2.4e-5,
                   .autocorrelation = {},
                   .autocorrelation_limit = {0.88, "0.88"},
                   .dependent = true}};
    r.outliers = {{.input = "V",
                   .component = "",
                   .unit = "V",
                   .point = "",
                   .of = "observations",
                   .group = 0,
                   .position = 4,
                   .n = 5,
                   .value = {4.990, "4.990"},
                   .G = {1.25, "1.25"},
                   .p_value = {0.004, "0.0040"}}};
    VarianceAnalysis v;
    v.input = "V_S";
    v.unit = "V";
    v.groups = 10;
    v.readings = 50;
    v.mean = {10.000097, "10.000097"};
    v.sum_of_squares_between = 1.4742e-7;
    v.sum_of_squares_within = 2.888e-7;
    v.degrees_of_freedom_between = 9.0;
    v.degrees_of_freedom_within = 40.0;
    v.mean_square_between = 1.638e-8;
    v.mean_square_within = 7.22e-9;
    v.printed_mean_square = {"1.6E-8", "7.2E-9"};
    v.F = {2.25, "2.25"};
    v.p_value = {0.038, "0.038"};
    v.F_critical = {2.124, "2.12"};
    v.r_squared = 0.34;
    v.standard_deviation_within = {85e-6, "0.000085"};
    v.standard_deviation_of_group_means = {57e-6, "0.000057"};
    v.standard_deviation_between = {43e-6, "0.000043"};
    v.u_with_between_effect = 18e-6;
    v.u_without_between_effect = 13e-6;
    v.conclusion = "significant";
    r.variance_analyses = {v};
    return r;
}

reports::EvaluationRecord sample_points_record(std::size_t count) {
    using namespace gumcert::reports;
    EvaluationRecord r = sample_budget_record();
    const Result pattern = r.results.front();
    r.results.clear();
    r.diagnostics.clear();
    for (std::size_t i = 0; i < count; ++i) {
        Result y = pattern;
        y.point = std::to_string(i + 1) + " mm";
        y.name = "l[" + y.point + "]";
        y.value = pattern.value + static_cast<double>(i);
        y.printed.value = decimals(y.value, 0);
        y.monte_carlo->histogram.clear();
        y.second_order.reset();
        r.results.push_back(y);
    }
    return r;
}

}  // namespace gumcert::test
