#include "reports/studies/simulation_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "gum/quantity/units.h"
#include "gum/rounding.h"
#include "reports/studies/simulation_data.h"
#include "reports/studies/simulation_explanation.h"
#include "reports/studies/simulation_figures.h"

namespace gumcert::reports::simulation {

using gum::AngleStudy;
using gum::CampaignResults;
using gum::DifferenceTally;
using gum::k_all_tally;
using gum::k_estimators;
using gum::k_most_adjusted_angles;
using gum::k_most_sequential_angles;
using gum::k_reversal_tally;
using gum::Tallies;
using gum::simulation::Basis;

namespace {

using reports::StudyFigure;
using reports::StudySection;
using reports::StudyTable;

// Rows of the tables: without the sequential method in a datum that its paper does not use. Indices of k_estimators.
constexpr std::array<std::size_t, 3> k_shown{0, 1, 3};
constexpr const char* k_percent = "%";

std::string counted_campaigns(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " campaign" : " campaigns");
}

/// Differences of two kinds of quantities as the source paper's tables state them.
StudyTable difference_table(const std::string& caption, const std::vector<AngleStudy>& studies, bool noisy,
                            std::size_t first_figure, const Scales& scales) {
    const std::array<PaperFigure, 2> figures{k_paper[first_figure], k_paper[first_figure + 1]};
    StudyTable table;
    table.caption = caption;
    table.columns = {{"angles", "", true}, {"method, datum", "", false}};
    for (const PaperFigure& figure : figures) {
        for (const char* statistic : {"mean", "rms", "largest"}) {
            table.columns.push_back({std::string(figure.name) + ", " + statistic, k_percent, true});
        }
    }
    const auto add_row = [&](std::size_t angles, const std::string& method, const Tallies& tallies) {
        std::vector<std::string> row{std::to_string(angles), method};
        for (const PaperFigure& figure : figures) {
            const DifferenceTally& tally = tallies[figure.tally];
            for (const double value : {tally.mean_absolute(), tally.rms(), tally.maximum}) {
                row.push_back(tally.count > 0 ? relative(value, scales.of(figure.tally)) : "");
            }
        }
        table.rows.push_back(std::move(row));
    };
    for (const AngleStudy& study : studies) {
        const CampaignResults& results = noisy ? study.noisy : study.exact;
        for (const std::size_t e : k_shown) {
            if (results.evaluated[e / 2] > 0) {
                add_row(study.angles, method_text(k_estimators[e]), results.tallies[e]);
            }
        }
        if (study.adjusted == 0 && !noisy) {
            add_row(study.angles, "datum alone, average line", study.datum_only[0]);
            add_row(study.angles, "datum alone, home", study.datum_only[1]);
        }
    }
    table.rows.push_back({"not stated", "source paper", "", "", percent_text(figures[0].largest), "", "",
                          percent_text(figures[1].largest)});
    return table;
}

StudyTable parts_table(const std::string& caption, const std::vector<AngleStudy>& studies, std::size_t first_figure,
                       const Scales& scales) {
    StudyTable table;
    table.caption = caption;
    table.columns = {{"angles", "", true}, {"method, datum", "", false}};
    for (const std::size_t f : {first_figure, first_figure + 1}) {
        for (const char* part : {"whole", "datum", "measured"}) {
            table.columns.push_back({std::string(k_paper[f].name) + ", " + part, k_percent, true});
        }
    }
    for (const AngleStudy& study : studies) {
        for (const std::size_t e : k_shown) {
            if (study.noisy.evaluated[e / 2] == 0) {
                continue;
            }
            std::vector<std::string> row{std::to_string(study.angles), method_text(k_estimators[e])};
            for (const std::size_t f : {first_figure, first_figure + 1}) {
                const DifferenceTally& tally = study.noisy.tallies[e][k_paper[f].tally];
                for (const double value : {tally.rms(), tally.datum_rms(), tally.measurement_rms()}) {
                    row.push_back(relative(value, scales.of(k_paper[f].tally)));
                }
            }
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

StudyTable agreement_table(const AngleStudy& study, std::size_t estimator,
                           const engine::RotaryTableMeasurement& layout) {
    StudyTable table;
    table.caption = std::to_string(study.angles) + " angles, " + method_text(k_estimators[estimator]) + ", " +
                    counted_campaigns(study.noisy.evaluated[estimator / 2]) +
                    ": errors against stated standard uncertainties, and shares within the expanded uncertainty";
    table.columns = {{"quantity", "", false},
                     {"unit", "", false},
                     {"rms of errors", "", true},
                     {"rms of stated u", "", true},
                     {"rms of error / u", "", true},
                     {"within U", k_percent, true},
                     {"standard error of the share", k_percent, true}};
    auto names = named_tallies(layout);
    names.emplace_back(k_reversal_tally, "reversal");
    names.emplace_back(k_all_tally, "all");
    for (const auto& [t, name] : names) {
        const DifferenceTally& tally = study.noisy.tallies[estimator][t];
        if (tally.judged == 0) {
            continue;
        }
        const bool mixed = t == k_reversal_tally || t == k_all_tally;
        const auto in_unit = [&, linear = is_linear(t)](double value) {
            return mixed ? std::string()
                         : gum::round_to_quantum(value / (linear ? gum::k_micrometre : gum::k_arcsecond), 3);
        };
        table.rows.push_back({name, mixed ? "" : (is_linear(t) ? "µm" : "″"), in_unit(tally.measurement_rms()),
                              in_unit(tally.stated_rms()), gum::round_to_quantum(tally.normalised_rms(), 3),
                              percent_text(tally.coverage()),
                              tally.runs > 1 ? percent_text(tally.coverage_standard_error()) : ""});
    }
    return table;
}

StudyTable campaign_table(const std::vector<AngleStudy>& studies) {
    StudyTable table;
    table.caption = "Joint adjustments with measurement noise";
    table.columns = {{"angles", "", true},
                     {"distances a campaign", "", true},
                     {"campaigns with a result", "", true},
                     {"mean chi-square", "", true},
                     {"mean degrees of freedom", "", true},
                     {"planted outliers", "", true},
                     {"found", k_percent, true},
                     {"good distances flagged", k_percent, true}};
    for (const AngleStudy& study : studies) {
        if (study.adjusted == 0) {
            continue;
        }
        const CampaignResults& r = study.noisy;
        const auto n = static_cast<double>(r.evaluated[0]);
        const auto share = [](std::size_t part, std::size_t whole, int decimals) {
            return whole == 0 ? std::string()
                              : percent_text(static_cast<double>(part) / static_cast<double>(whole), decimals);
        };
        table.rows.push_back({std::to_string(study.angles), std::to_string(study.lengths),
                              std::to_string(r.evaluated[0]) + " of " + std::to_string(study.adjusted),
                              n > 0.0 ? gum::round_to_quantum(r.sum_chi_square / n, 1) : "",
                              n > 0.0 ? gum::round_to_quantum(r.sum_degrees_of_freedom / n, 1) : "",
                              std::to_string(r.planted), share(r.planted_found, r.planted, 1),
                              share(r.good_flagged, r.good, 3)});
    }
    return table;
}

std::string angle_list(const std::vector<AngleStudy>& studies) {
    std::string text;
    for (const AngleStudy& study : studies) {
        text += (text.empty() ? "" : ", ") + std::to_string(study.angles);
    }
    return text;
}

/// What was left out because it takes too long, for every number of angles that it concerns.
std::vector<std::string> left_out(const std::vector<AngleStudy>& studies, std::size_t runs) {
    std::vector<std::string> paragraphs;
    for (const AngleStudy& study : studies) {
        const std::string angles = std::to_string(study.angles) + " angles: ";
        if (study.adjusted == 0) {
            paragraphs.push_back(angles + "not adjusted, which is done up to " +
                                 std::to_string(k_most_adjusted_angles) +
                                 "; the assumed values are carried to the datum exactly, as an exact measurement "
                                 "gives them.");
            continue;
        }
        if (study.adjusted < runs) {
            paragraphs.push_back(angles + "the first " + std::to_string(study.adjusted) + " of the " +
                                 counted_campaigns(runs) + " are adjusted, to limit the computing time.");
        }
        if (!study.sequential) {
            paragraphs.push_back(angles +
                                 "without the sequential method. Its uncertainties are propagated from every distance "
                                 "through all its stages, which is done up to " +
                                 std::to_string(k_most_sequential_angles) + " angles.");
        }
    }
    return paragraphs;
}

std::vector<std::pair<std::string, std::string>> facts_of(const StudiedJob& job, const Basis& basis,
                                                          const std::vector<AngleStudy>& studies) {
    const gum::SimulationRequest& request = basis.request;
    const engine::LengthUncertainty& length = basis.layout.length_uncertainty;
    return {
        {"Job", job.name},
        {"Campaigns",
         std::to_string(request.runs) + " for each number of angles, seed " + std::to_string(request.seed)},
        {"Axis", std::string(1, "ABC"[engine::axial_coordinate(basis.layout.axis)])},
        {"Angles", angle_list(studies)},
        {"Stations and reflectors", std::to_string(basis.layout.stations.size()) + " and " +
                                        std::to_string(basis.layout.reflectors.size()) +
                                        " (stations from: " + basis.stations_from + ")"},
        {"Assumed set-up", micrometres(request.set_up_offset) + " µm and " + arcseconds(request.set_up_tilt) +
                               "″, both directions across the axis"},
        {"Assumed error motions", "uniform within ±" + micrometres(request.error_linear) + " µm and ±" +
                                      arcseconds(request.error_angular) +
                                      "″, independent at every angle, zero at home"},
        {"Noise of a length, standard uncertainty", micrometres(length.u_constant) + " µm and " +
                                                        micrometres(length.u_proportional) +
                                                        " µm per metre, added in squares"},
        {"Table repeatability, standard deviation",
         micrometres(basis.table.u_linear) + " µm, " + arcseconds(basis.table.u_axial) + "″ about the axis, " +
             arcseconds(basis.table.u_tilt) + "″ across it (" + basis.table_from + ")"},
        {"Planted outliers", request.outliers == 0 ? std::string("none")
                                                   : std::to_string(request.outliers) + " of ±" +
                                                         micrometres(request.outlier_size) + " µm in every campaign"},
        {"Coverage probability", percent_text(job.coverage_probability) + " %"}};
}

/// Only with the set-up and the amplitudes of the source paper can its figures be compared with the datum part here.
bool as_in_paper(const gum::SimulationRequest& request) {
    const gum::SimulationRequest paper;  // the defaults are those of the paper
    const auto same = [](double value, double expected) { return std::abs(value - expected) <= 1e-9 * expected; };
    return same(request.set_up_offset, paper.set_up_offset) && same(request.set_up_tilt, paper.set_up_tilt) &&
           same(request.error_linear, paper.error_linear) && same(request.error_angular, paper.error_angular);
}

StudySection comparison_section(const Basis& basis, const std::vector<AngleStudy>& studies, const Scales& scales) {
    StudySection section{
        .heading = "Differences from the assumed values, as the source paper states them",
        .paragraphs = {"Set-up: |calculated - assumed| / assumed. Error motions: |calculated - assumed| divided by the "
                       "amplitude of the assumed ones (" +
                       micrometres(basis.request.error_linear) + " µm, " + arcseconds(basis.request.error_angular) +
                       "″). Mean, root mean square and largest over all campaigns, components and angles. Datum: the "
                       "axis average line, or the home position as in the source paper. The paper states the largest; "
                       "it does not state the number of angles."},
        .tables = {},
        .figures = {}};
    for (std::string& paragraph : left_out(studies, basis.request.runs)) {
        section.paragraphs.push_back(std::move(paragraph));
    }
    for (const bool noisy : {false, true}) {
        const std::string noise = noisy ? "with measurement noise" : "without measurement noise";
        section.tables.push_back(difference_table("Set-up, " + noise, studies, noisy, 0, scales));
        section.tables.push_back(difference_table("Six error motions, " + noise, studies, noisy, 2, scales));
    }
    return section;
}

StudySection parts_section(const std::vector<AngleStudy>& studies, const Scales& scales) {
    const std::string what =
        " with measurement noise: root mean square of the whole difference, of its datum part and "
        "of its measurement part, relative as above";
    StudySection section{.heading = "Which part is datum and which is measurement",
                         .paragraphs = parts_paragraphs(studies, scales),
                         .tables = {parts_table("Set-up" + what, studies, 0, scales),
                                    parts_table("Six error motions" + what, studies, 2, scales)},
                         .figures = {}};
    if (std::optional<StudyFigure> figure = parts_figure(studies, scales)) {
        section.figures.push_back(std::move(*figure));
    }
    return section;
}

StudySection agreement_section(const StudiedJob& job, const Basis& basis, const std::vector<AngleStudy>& studies) {
    StudySection section{
        .heading = "Agreement with the stated uncertainties",
        .paragraphs =
            {"Errors are differences from the truth in the datum of the result. The root mean square of error "
             "divided by standard uncertainty should be near 1, and the share within the expanded "
             "uncertainty near " +
             percent_text(job.coverage_probability) +
             " %. All errors of one campaign depend on the same stations and the same fixture; the standard error of "
             "a share comes from its scatter between campaigns and holds for such dependent errors too. The sequential "
             "method takes weights, outliers and coverage factors from the joint adjustment of the same campaign."},
        .tables = {campaign_table(studies)},
        .figures = {}};
    for (const AngleStudy& study : studies) {
        const std::string angles = std::to_string(study.angles) + " angles";
        const CampaignResults& noisy = study.noisy;
        if (noisy.evaluated[0] > 0) {
            section.tables.push_back(agreement_table(study, 0, basis.layout));
        }
        if (noisy.evaluated[1] > 0) {
            section.tables.push_back(agreement_table(study, 3, basis.layout));
        }
        if (noisy.failure[1]) {
            section.paragraphs.push_back(angles + ", sequential method, " +
                                         counted_campaigns(noisy.evaluated[0] - noisy.evaluated[1]) +
                                         " without a result; the first: " + gum::message(*noisy.failure[1]));
        }
        if (noisy.failure[0]) {
            section.paragraphs.push_back(angles + ", " + counted_campaigns(study.adjusted - noisy.evaluated[0]) +
                                         " without a result; the first: " + gum::message(*noisy.failure[0]));
        }
    }
    if (std::optional<StudyFigure> figure = histogram_figure(studies)) {
        section.figures.push_back(std::move(*figure));
    }
    return section;
}

/// What the reader of the job warns of, such as keys that a simulation does not use.
StudySection job_section(const StudiedJob& job) {
    StudySection section{.heading = "Warnings about the job", .paragraphs = {}, .tables = {}, .figures = {}};
    for (const gum::Diagnostic& warning : job.warnings) {
        section.paragraphs.push_back(gum::message(warning));
    }
    return section;
}

}  // namespace

reports::StudyDocument document_of(const StudiedJob& job, const Basis& basis, const std::vector<AngleStudy>& studies) {
    const Scales scales = scales_of(basis.request);
    reports::StudyDocument document;
    document.kind = "simulation";
    document.title = job.title.empty() ? job.name : job.title;
    document.subtitle = found_text(studies, scales);
    document.facts = facts_of(job, basis, studies);
    document.sections.push_back(comparison_section(basis, studies, scales));
    document.sections.push_back(parts_section(studies, scales));
    if (as_in_paper(basis.request)) {
        document.sections.push_back({.heading = "What the figures of the source paper can mean",
                                     .paragraphs = paper_paragraphs(studies, scales),
                                     .tables = {paper_angles_table(studies, scales)},
                                     .figures = {}});
    }
    document.sections.push_back(agreement_section(job, basis, studies));
    if (!job.warnings.empty()) {
        document.sections.push_back(job_section(job));
    }
    document.data_json = data_json(job, basis, studies);
    return document;
}

}  // namespace gumcert::reports::simulation
