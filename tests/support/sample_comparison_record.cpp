#include "tests/support/sample_comparison_record.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::test {

std::string laboratory_id(std::size_t i) {
    const std::string number = std::to_string(i + 1);
    return "L" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number;
}

reports::EvaluationRecord comparison_frame(const std::string& title, const std::string& job) {
    reports::EvaluationRecord r;
    r.software = {.name = "gumcert", .version = "0.1.0", .commit = "0123456789abcdef0123456789abcdef01234567"};
    r.kind = "comparison";
    r.title = title;
    r.coverage_probability.text = "95.45 %";
    r.job_json = job;
    r.options_json = R"({"comparison": {"iterations": 100, "tolerance": 1e-13}})";
    r.job_files = {{"job.json", std::string(64, 'a')}, {"results.csv", std::string(64, 'b')}};
    r.diagnostics = {{.code = "GC-COMPARE-0001",
                      .where = "job.json#/items",
                      .what = "a note of the sample",
                      .rule = "a record keeps its notes",
                      .action = "nothing is to be done",
                      .severity = gum::Severity::note}};
    return r;
}

void add_sample_item(reports::Comparison& c, const std::string& id, const std::string& round, std::size_t laboratories,
                     double value, double spread) {
    using namespace gumcert::reports;
    ComparisonItemEvaluation item;
    item.id = id;
    item.name = "Gauge block " + id;
    item.round = round;
    item.unit = "um";
    item.difference_unit = "um";
    item.method = "weighted_mean";
    item.reference_participant = laboratory_id(0);
    item.traceability = "SI through the national standard of length of the pilot laboratory";
    item.value.number = value;
    item.u.number = 0.06 * spread;
    item.U.number = 0.12 * spread;
    item.k.number = 2.0;
    item.u_characterisation.number = 0.05 * spread;
    item.u_homogeneity.number = 0.03 * spread;
    item.u_stability.number = 0.013 * spread;
    item.s_star.number = 0.4 * spread;
    item.pooled_standard_deviation.number = 0.1 * spread;
    item.sigma_pt.number = 0.5 * spread;
    item.delta_E.number = 1.5 * spread;
    item.sigma_pt_method = "percent";
    item.criterion.number = 0.12;
    item.criterion_met = true;
    item.score = "En";
    item.value.text = decimals(value, 2);
    item.u.text = decimals(*item.u.number, 3);
    item.U.text = decimals(*item.U.number, 3);
    item.k.text = "2.00";
    item.u_characterisation.text = decimals(*item.u_characterisation.number, 3);
    item.u_homogeneity.text = decimals(*item.u_homogeneity.number, 3);
    item.u_stability.text = decimals(*item.u_stability.number, 3);
    item.sigma_pt.text = decimals(*item.sigma_pt.number, 2);
    item.delta_E.text = decimals(*item.delta_E.number, 2);
    item.criterion.text = "0.12";
    item.s_star.text = decimals(*item.s_star.number, 2);
    item.pooled_standard_deviation.text = decimals(*item.pooled_standard_deviation.number, 2);
    for (std::size_t i = 0; i < laboratories; ++i) {
        const auto d = static_cast<double>(i);
        if (i == 5) {
            item.missing.push_back(laboratory_id(i));
            continue;
        }
        ComparisonPoint p;
        p.participant = laboratory_id(i);
        p.item = id;
        p.round = round;
        p.value.number = value + spread * (0.55 * std::sin(2.39996 * d + value) + 0.1 * std::cos(0.7 * d));
        p.reference_value.number = value;
        p.reference_u = item.u.number;
        p.reference_U.number = item.U.number;
        p.reference_k = 2.0;
        p.D.number = p.value.number - p.reference_value.number;
        p.D_percent.number = 100.0 * p.D.number / p.reference_value.number;
        p.P_A.number = 100.0 * p.D.number / *item.delta_E.number;
        p.z.number = p.D.number / *item.sigma_pt.number;
        p.z_prime.number = p.D.number / std::hypot(*item.sigma_pt.number, *item.u.number);
        p.contributes = i != 3;
        p.signal = "none";
        if (!p.contributes) {
            p.reason = "artefact damaged, stated before the results were known";
            item.not_contributing.push_back(p.participant);
        }
        if (i != 4) {
            p.u = spread * (0.15 + 0.05 * std::cos(1.3 * d));
            p.k.number = i == 2 ? 2.13 : 2.0;
            p.nu = i == 2 ? std::optional<double>(14.0) : std::nullopt;
            p.U.number = *p.k.number * *p.u;
            p.correlation = p.contributes ? *item.u.number / *p.u : 0.0;
            p.u_D = std::sqrt(*p.u * *p.u + (p.contributes ? -1.0 : 1.0) * *item.u.number * *item.u.number);
            p.U_D.number = 2.0 * *p.u_D;
            p.En.number = p.D.number / *p.U_D.number;
            p.zeta.number = p.D.number / *p.u_D;
            p.En_audited.number = 0.9 * *p.En.number;
            p.En_worst.number = 1.2 * *p.En.number;
            p.signal = std::abs(*p.En.number) >= 1.0 ? "action" : "none";
            p.realism = i % 3 == 0 ? "plausible" : i % 3 == 1 ? "small" : "large";
            p.U_over_CMC = 1.0 + 0.1 * d;
            p.U_over_median = 0.9;
        }
        p.printed_angle = "";
        p.value.text = decimals(p.value.number, 2);
        p.U.text = p.U.number ? decimals(*p.U.number, 2) : "";
        p.reference_value.text = item.value.text;
        p.reference_U.text = item.U.text;
        p.D.text = decimals(p.D.number, 2);
        p.U_D.text = p.U_D.number ? decimals(*p.U_D.number, 2) : "";
        p.En.text = p.En.number ? decimals(*p.En.number, 2) : "";
        p.zeta.text = p.zeta.number ? decimals(*p.zeta.number, 2) : "";
        p.z.text = decimals(*p.z.number, 2);
        p.z_prime.text = decimals(*p.z_prime.number, 2);
        p.D_percent.text = decimals(*p.D_percent.number, 3);
        p.P_A.text = decimals(*p.P_A.number, 1);
        p.En_audited.text = p.En_audited.number ? decimals(*p.En_audited.number, 2) : "";
        p.En_worst.text = p.En_worst.number ? decimals(*p.En_worst.number, 2) : "";
        p.k.text = p.k.number ? decimals(*p.k.number, 2) : "";
        c.points.push_back(p);
        ++item.results;
        if (p.contributes && p.u) {
            ++item.contributing;
            item.weights.push_back({.participant = p.participant, .weight = {0.1, "0.100"}});
        }
    }
    item.not_consistent = {laboratory_id(1)};
    item.consistency = {.chi_square = {9.3, "9.30"},
                        .critical_value = {12.6, "12.59"},
                        .p_value = {0.16, "0.16"},
                        .alpha = 0.05,
                        .degrees_of_freedom = 6,
                        .consistent = true,
                        .birge_ratio = {1.24, "1.24"},
                        .birge_limit = {1.47, "1.47"},
                        .pairs = 21,
                        .incompatible_pairs = 2};
    item.estimates = {{.method = "weighted_mean",
                       .value = {value, decimals(value, 2)},
                       .u = {item.u.number, decimals(*item.u.number, 3)},
                       .scale = {{}, ""},
                       .between = {{}, ""},
                       .results = item.contributing,
                       .used = true},
                      {.method = "dersimonian_laird",
                       .value = {value + 0.02 * spread, decimals(value + 0.02 * spread, 2)},
                       .u = {0.08 * spread, decimals(0.08 * spread, 3)},
                       .scale = {0.4 * spread, decimals(0.4 * spread, 2)},
                       .between = {0.21 * spread, decimals(0.21 * spread, 3)},
                       .results = item.contributing,
                       .used = false}};
    item.homogeneity = {.items = 10,
                        .replicates = 2,
                        .mean = {value, decimals(value, 2)},
                        .s_x = {0.04 * spread, "0.040"},
                        .s_w = {0.03 * spread, "0.030"},
                        .s_s = {0.03 * spread, "0.030"},
                        .limit = {0.15 * spread, "0.15"},
                        .expanded_limit = {0.18 * spread, "0.18"},
                        .sufficient = true,
                        .sufficient_expanded = true};
    item.stability = {.mean = {value, decimals(value, 2)},
                      .difference = {0.02 * spread, "0.020"},
                      .u_difference = 0.01 * spread,
                      .limit = {0.15 * spread, "0.15"},
                      .expanded_limit = {0.17 * spread, "0.17"},
                      .stable = true,
                      .stable_expanded = true};
    item.consensus = {.reference_value = {value + 0.05 * spread, decimals(value + 0.05 * spread, 2)},
                      .consensus = {value, decimals(value, 2)},
                      .u_reference = 0.05 * spread,
                      .u_consensus = *item.u.number,
                      .difference = {-0.05 * spread, "\u22120.050"},
                      .u_difference = {0.078 * spread, "0.078"},
                      .ratio = {-0.64, "\u22120.64"},
                      .consistent = true};
    if (laboratories <= 40) {
        for (std::size_t i = 0; i < c.points.size(); ++i) {
            for (std::size_t j = i + 1; j < c.points.size(); ++j) {
                const ComparisonPoint& a = c.points[i];
                const ComparisonPoint& b = c.points[j];
                if (a.item != id || b.item != id || a.round != round || b.round != round || !a.u || !b.u) {
                    continue;
                }
                PairEquivalence pair{.first = a.participant, .second = b.participant};
                pair.d.number = a.value.number - b.value.number;
                pair.u = std::hypot(*a.u, *b.u);
                pair.U.number = 2.0 * pair.u;
                pair.En.number = pair.d.number / pair.U.number;
                pair.d.text = decimals(pair.d.number, 2);
                pair.U.text = decimals(pair.U.number, 2);
                pair.En.text = decimals(*pair.En.number, 2);
                item.pairs.push_back(pair);
            }
        }
    }
    c.items.push_back(std::move(item));
}

reports::EvaluationRecord sample_laboratories_record(std::size_t laboratories) {
    using namespace gumcert::reports;
    EvaluationRecord r = comparison_frame("Comparison of gauge block calibrations",
                                          R"({"schema": "gumcert/job/1", "kind": "comparison", "organiser": "pilot"})");
    Comparison c;
    c.form = "laboratories";
    c.reference_name = "weighted mean";
    c.unit = "um";
    c.organiser = "Example Proficiency Scheme";
    add_sample_item(c, "A", "1", laboratories, 10.42, 0.3);
    add_sample_item(c, "B", "1", laboratories, 50.07, 0.8);
    for (std::size_t i = 0; i < laboratories; ++i) {
        ParticipantSummary p{.id = laboratory_id(i),
                             .name = "Example Calibration Laboratory " + std::to_string(i + 1),
                             .group = i % 2 == 0 ? "NMI-X" : ""};
        p.results = i == 5 ? 0 : 2;
        if (i != 4 && i != 5) {
            p.scored = 2;
            p.warnings = 0;
            p.actions = static_cast<std::int64_t>(i % 3);
            p.mean_abs_En.number = 0.4;
            p.max_abs_En.number = 0.9;
            p.rms_En.number = 0.5;
            p.p_low.number = 0.3;
            p.p_high.number = 0.7;
            p.mean_abs_En.text = "0.40";
            p.max_abs_En.text = "0.90";
            p.rms_En.text = "0.50";
            p.p_low.text = "0.30";
            p.p_high.text = "0.70";
        }
        c.participants.push_back(p);
    }
    c.vectors = {{.name = "both blocks",
                  .participant = laboratory_id(0),
                  .round = "1",
                  .mahalanobis_square = 1.9,
                  .vector_En = {0.55, "0.55"},
                  .max_abs_En = {0.61, "0.61"},
                  .quantities = 2}};
    YoudenDiagram youden{.first_item = "A", .second_item = "B", .round = "1", .first_unit = "um", .second_unit = "um"};
    youden.centre_first = 0.01;
    youden.centre_second = -0.03;
    youden.scale_first = 0.13;
    youden.scale_second = 0.35;
    youden.correlation = 0.31;
    for (int i = 0; i <= 90; ++i) {
        const double t = 2.0 * std::numbers::pi * i / 90.0;
        youden.ellipse.emplace_back(
            youden.centre_first + 2.448 * youden.scale_first * std::cos(t),
            youden.centre_second + 2.448 * youden.scale_second *
                                       (youden.correlation * std::cos(t) +
                                        std::sqrt(1.0 - std::pow(youden.correlation, 2)) * std::sin(t)));
    }
    for (const ComparisonPoint& first : c.points) {
        const auto second = std::find_if(c.points.begin(), c.points.end(), [&](const ComparisonPoint& p) {
            return p.item == "B" && p.participant == first.participant;
        });
        if (first.item == "A" && second != c.points.end()) {
            youden.points.push_back(
                {.participant = first.participant, .first = first.D.number, .second = second->D.number});
        }
        if (youden.points.size() >= 1000) {
            break;  // the search above is for samples of ordinary size
        }
    }
    c.youden.push_back(youden);
    c.shared_sources = {{.source = "laser wavelength standard",
                         .first = laboratory_id(0),
                         .second = laboratory_id(1),
                         .covariance = 4.0e-4,
                         .correlation = {0.21, "0.21"}}};
    c.audit_finding = "maximum permissible error taken as normal; corrected to a uniform bound";
    c.remarks = {"An E\u2099 number at or below 1 shows no contradiction; it proves no uncertainty."};
    r.comparison = std::move(c);
    return r;
}

reports::EvaluationRecord sample_methods_record(std::size_t points_of_direction) {
    using namespace gumcert::reports;
    EvaluationRecord r = comparison_frame("Laser method against a dial indicator",
                                          R"({"schema": "gumcert/job/1", "kind": "comparison", "unit": "um"})");
    Comparison c;
    c.form = "methods";
    c.method_name = "laser method";
    c.reference_name = "dial indicator";
    c.unit = "um";
    c.position_name = "angle";
    c.position_unit = "deg";
    c.organiser = "Example Calibration Laboratory";
    c.reference_budget = sample_record().comparison->reference_budget;
    c.method_budget = {c.reference_budget.front()};
    c.correlation = "given";
    c.correlation_given = 0.15;
    c.shared_sources = {{.source = "temperature sensor",
                         .first = "laser method",
                         .second = "dial indicator",
                         .covariance = 0.02,
                         .correlation = {0.15, "0.15"}}};
    c.audit_finding = "the maximum permissible error was divided by 3; corrected to a uniform bound";
    c.published_source = "Example Journal of Metrology, table 4";
    c.tolerance = {2.5, "2.5"};
    for (const char* direction : {"up", "down"}) {
        for (std::size_t i = 0; i < points_of_direction; ++i) {
            const auto d = static_cast<double>(i);
            ComparisonPoint p;
            p.direction = direction;
            p.name = std::string(direction) + " " + std::to_string(i + 1);
            p.position = 30.0 * d;
            p.value.number = 3.1 * std::sin(0.5 * d + direction[0]);
            p.u = 0.21;
            p.k.number = 2.0;
            p.nu = 45.0;
            p.U.number = 0.42;
            p.reference_value.number = p.value.number + 0.7 * std::cos(1.1 * d + direction[0]);
            p.reference_u = 0.63;
            p.reference_k = 2.0;
            p.reference_U.number = 1.26;
            p.D.number = p.value.number - p.reference_value.number;
            p.correlation = 0.15;
            p.u_D = std::sqrt(0.21 * 0.21 + 0.63 * 0.63 - 2.0 * 0.15 * 0.21 * 0.63);
            p.U_D.number = 2.0 * *p.u_D;
            p.En.number = p.D.number / *p.U_D.number;
            p.zeta.number = p.D.number / *p.u_D;
            p.En_worst.number = 1.3 * *p.En.number;
            p.En_audited.number = 0.8 * *p.En.number;
            p.signal = "none";
            p.printed_angle = decimals(*p.position, 0);
            p.value.text = decimals(p.value.number, 2);
            p.U.text = decimals(*p.U.number, 2);
            p.reference_value.text = decimals(p.reference_value.number, 1);
            p.reference_U.text = decimals(*p.reference_U.number, 1);
            p.D.text = decimals(p.D.number, 1);
            p.U_D.text = decimals(*p.U_D.number, 1);
            p.En.text = decimals(*p.En.number, 2);
            p.zeta.text = decimals(*p.zeta.number, 2);
            p.En_audited.text = decimals(*p.En_audited.number, 2);
            p.En_worst.text = decimals(*p.En_worst.number, 2);
            p.k.text = "2.00";
            c.points.push_back(p);
        }
    }
    for (const char* direction : {"up", "down", "all"}) {
        ComparisonSummary s;
        s.direction = direction;
        s.points = static_cast<std::int64_t>(points_of_direction) * (s.direction == "all" ? 2 : 1);
        s.mean_abs_En.number = 0.33;
        s.max_abs_En.number = 0.56;
        s.rms_En.number = 0.39;
        s.rms_En_low.number = 0.21;
        s.rms_En_high.number = 0.82;
        s.p_low.number = 0.21;
        s.p_high.number = 0.79;
        s.D_fail.number = 1.25;
        s.D_fail_largest.number = 1.31;
        s.effective_points.number = 5.4;
        s.mahalanobis_square = 8.2;
        s.p_mahalanobis.number = 0.77;
        s.p_pattern = {0.78, "0.78"};
        s.p_low_least = {0.19, "0.19"};
        s.p_high_least = {0.75, "0.75"};
        s.p_mahalanobis_least = 0.7;
        s.verdict_audited = "uncertainty_too_large";
        s.vector_En.number = 0.61;
        s.rank = 12;
        s.ratio_reference.number = 3.0;
        s.max_abs_En_worst.number = 0.73;
        s.count_above_1_worst = 0;
        s.mean_abs_En_audited.number = 0.26;
        s.max_abs_En_audited.number = 0.45;
        s.count_above_1_audited = 0;
        s.published_mean_abs_En.number = 0.39;
        s.verdict = "reference_not_better";
        s.bias = {.against = "position",
                  .centre = {165.0, "165"},
                  .constant = {-0.02, "\u22120.02"},
                  .U_constant = {0.4, "0.40"},
                  .u_constant = 0.2,
                  .slope = {0.001, "0.001"},
                  .U_slope = {0.004, "0.004"},
                  .u_slope = 0.002,
                  .chi_square = 7.9,
                  .p_value = {0.64, "0.64"}};
        s.mean_abs_En.text = "0.33";
        s.max_abs_En.text = "0.56";
        s.rms_En.text = "0.39";
        s.rms_En_low.text = "0.21";
        s.rms_En_high.text = "0.82";
        s.p_low.text = "0.21";
        s.p_high.text = "0.79";
        s.D_fail.text = "1.3";
        s.D_fail_largest.text = "1.3";
        s.effective_points.text = "5.4";
        s.p_mahalanobis.text = "0.77";
        s.vector_En.text = "0.61";
        s.ratio_reference.text = "3.0";
        s.max_abs_En_worst.text = "0.73";
        s.mean_abs_En_audited.text = "0.26";
        s.max_abs_En_audited.text = "0.45";
        s.published_mean_abs_En.text = "0.39";
        c.summary.push_back(s);
    }
    c.remarks = {"The uncertainty of the reference is not smaller than that of the method."};
    r.comparison = std::move(c);
    return r;
}

}  // namespace gumcert::test
