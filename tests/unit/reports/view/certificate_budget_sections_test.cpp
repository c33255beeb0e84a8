#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/diagnostic.h"
#include "reports/forms/render.h"
#include "reports/record/reported_result.h"
#include "reports/view/certificate_view.h"
#include "tests/support/sample_budget_record.h"
#include "tests/unit/reports/document_text.h"
#include "text/utf8.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

json view_of(const EvaluationRecord& record) {
    std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/en.json");
    return certificate_view(record, Wording(json::parse(file)));
}

std::vector<std::string> section_ids(const json& view) {
    std::vector<std::string> ids;
    for (const json& section : view["sections"]) {
        ids.push_back(section["id"]);
    }
    return ids;
}

const json& table(const json& view, const std::string& id) {
    for (const json& section : view["sections"]) {
        for (const json& block : section["blocks"]) {
            if (!block["table"].empty() && block["table"][0]["id"] == id) {
                return block["table"][0];
            }
        }
    }
    throw std::out_of_range(id);
}

std::vector<std::string> cells(const json& table, std::size_t row) {
    std::vector<std::string> texts;
    for (const json& cell : table["rows"].at(row)["cells"]) {
        texts.push_back(squeezed(cell["text"]).substr(1));
        texts.back().pop_back();
    }
    return texts;
}

std::vector<std::string> heads(const json& table) {
    std::vector<std::string> texts;
    for (const json& column : table["columns"]) {
        texts.push_back(column["head"]);
    }
    return texts;
}

std::string text_of(const EvaluationRecord& record) {
    return squeezed(render_text(record, assets()));
}

TEST(BudgetCertificate, SectionsComeInTheOrderOfACertificate) {
    EXPECT_THAT(section_ids(view_of(test::sample_budget_record())),
                ElementsAre("identification", "results", "model", "uncertainty", "second_order", "monte_carlo",
                            "messages", "input"));
    EXPECT_THAT(section_ids(view_of(test::sample_two_results_record())),
                ElementsAre("identification", "results", "model", "uncertainty", "joint", "fits", "type_a", "input"));
}

TEST(BudgetCertificate, BudgetHasTheLayoutOfTableH1) {
    const json view = view_of(test::sample_budget_record());
    const json& budget = table(view, "budget-0");
    EXPECT_THAT(heads(budget),
                ElementsAre("Quantity X_i", "Estimate x_i", "Standard uncertainty u(x_i)", "Distribution", "Type",
                            "ν_i", "Sensitivity coefficient c_i", "Contribution u_i(y)", "Share"));
    EXPECT_EQ(budget["columns"][7]["unit"][0]["text"], "nm");
    ASSERT_EQ(budget["rows"].size(), 10U);
    EXPECT_THAT(cells(budget, 0), ElementsAre("l_s", "50000623 nm", "25 nm", "t", "B", "18", "1", "25.0", "62.2"));
    EXPECT_THAT(cells(budget, 1), ElementsAre("d", "215.0 nm", "9.7 nm", "t", "A, B", "25", "1", "9.7", "9.4"));
    EXPECT_EQ(budget["rows"][1]["kind"], "plain");
    EXPECT_THAT(cells(budget, 2),
                ElementsAre("repeatability", "215.0 nm", "5.8 nm", "t", "A", "24", "1", "(5.8)", "(3.3)"));
    EXPECT_EQ(budget["rows"][2]["kind"], "part");
    EXPECT_THAT(cells(budget, 5), ElementsAre("alpha_s", "1.15 × 10⁻⁵ K⁻¹", "1.2 × 10⁻⁶ K⁻¹", "rectangular", "B", "∞",
                                              "0 nm·K", "0", "0.0"));
    // A Celsius temperature has an uncertainty in kelvin, and a sensitivity coefficient per kelvin.
    EXPECT_THAT(cells(budget, 7), ElementsAre("theta", "−0.10 °C", "0.41 K", "normal", "B", "∞", "0 nm/K", "0", "0.0"));
    EXPECT_THAT(cells(budget, 9), ElementsAre("l", "50000838 nm", "–", "t", "–", "16.7", "–", "32", "100"));
    EXPECT_EQ(budget["rows"][9]["kind"], "closing");
}

TEST(BudgetCertificate, ShowsTheCorrelationOfTheInputs) {
    const json view = view_of(test::sample_two_results_record());
    const json& budget = table(view, "budget-0");
    EXPECT_THAT(cells(budget, 3), ElementsAre("correlation", "–", "–", "–", "–", "–", "–", "−0.1806", "−647.3"));
    EXPECT_THAT(cells(budget, 0),
                ElementsAre("V", "4.9990 V", "0.0032 V", "t", "A", "4", "25.55 Ω/V", "0.0818", "132.6"));
    EXPECT_THAT(text_of(test::sample_two_results_record()),
                HasSubstr("the shares of the inputs exceed 100 % together"));
}

TEST(BudgetCertificate, SaysHowTheCoverageFactorWasFound) {
    EvaluationRecord r = test::sample_budget_record();
    EXPECT_THAT(text_of(r), HasSubstr("multiplied by the coverage factor k = 2.92, which for a t-distribution with "
                                      "effective degrees of freedom ν_eff = 16.7 corresponds to a coverage probability "
                                      "of approximately 99 %."));
    r.results[0].nu_eff.reset();
    r.results[0].coverage = "normal";
    r.results[0].k = 2.576;
    EXPECT_THAT(text_of(r), HasSubstr("the coverage factor k = 2.58, which for a normal distribution corresponds to"));
    r.results[0].coverage = "convolution";
    r.results[0].k = 1.65;
    r.results[0].coverage_note = "theta, uniform, has 90 % of the variance";
    std::string text = text_of(r);
    EXPECT_THAT(
        text,
        HasSubstr(
            "the coverage factor k = 1.65. The factor was calculated from the distribution of the result itself"));
    EXPECT_THAT(text, HasSubstr("On the coverage of l: theta, uniform, has 90 % of the variance."));
    EXPECT_THAT(text, Not(HasSubstr("which for a t-distribution")));
    r.results[0].coverage = "monte_carlo";
    text = text_of(r);
    EXPECT_THAT(text, HasSubstr("half the width of the probabilistically symmetric interval that holds 99 % of the"));
    EXPECT_THAT(text, HasSubstr(" l length of the end gauge at 20 °C 50000838 93 nm 1.65 – "));
    r.results[0].coverage = "none";
    r.results[0].coverage_note = "the inputs are correlated";
    r.results[0].k.reset();
    r.results[0].U.reset();
    r.results[0].printed.U = "";
    r.results[0].monte_carlo.reset();  // else its interval is stated
    text = text_of(r);
    EXPECT_THAT(text, HasSubstr("An expanded uncertainty cannot be stated; the standard uncertainty u is given"));
    EXPECT_THAT(text, HasSubstr("On the coverage of l: the inputs are correlated."));
    EXPECT_THAT(text, HasSubstr(" 50000838 – 32 nm – – "));
    EXPECT_THAT(text, Not(HasSubstr("coverage factor k")));
}

// What is reported is printed, and why: not the law of propagation beside it.
TEST(BudgetCertificate, PrintsTheReportedResult) {
    EvaluationRecord r = test::sample_budget_record();
    Result& l = r.results[0];
    l.reported = monte_carlo_result(50000203.0, 568.0, {49999020.0, 50000856.0}, 0.99, "second_order");
    print_reported(l.reported, l.unit);
    const json view = view_of(r);
    EXPECT_THAT(heads(table(view, "results-0")),
                ElementsAre("Name", "Description", "Value", "u", "Lower end", "Upper end", "Unit"));
    EXPECT_THAT(cells(table(view, "results-0"), 0),
                ElementsAre("l", "length of the end gauge at 20 °C", "5.000020 × 10⁷", "5.7 × 10²", "4.999902 × 10⁷",
                            "5.000086 × 10⁷", "nm"));
    std::string text = text_of(r);
    EXPECT_THAT(text, HasSubstr("no expanded uncertainty is stated."));
    EXPECT_THAT(text, HasSubstr("is reported for l, because second-order terms change the standard uncertainty or the "
                                "estimate noticeably"));
    EXPECT_THAT(text, HasSubstr("the measurement model gives another value: l: 50000838 nm."));
    l.reported = monte_carlo_result(50000838.0, 35.6, {50000744.0, 50000932.0}, 0.99, "contradicted");
    print_reported(l.reported, l.unit);
    text = text_of(r);
    EXPECT_THAT(text, HasSubstr(" 50000838 94 nm 2.64 – "));
    EXPECT_THAT(text, Not(HasSubstr("gives another value")));
    EXPECT_THAT(text, HasSubstr("half the width of the probabilistically symmetric interval"));
    l.reported = law_of_propagation_result(50000838.0, 31.7, 92.6, 2.92, 0.99);
    l.reported.against = "vanishing";
    print_reported(l.reported, l.unit);
    EXPECT_THAT(text_of(r), HasSubstr("reported for l although the first derivatives of the model vanish"));
}

/// A sound record is printed whatever the size of its numbers; the figure alone is left out, and it is said.
TEST(BudgetCertificate, LeavesOutAFigureThatNoPlotCanShow) {
    EvaluationRecord r = test::sample_budget_record();
    ASSERT_THAT(text_of(r), Not(HasSubstr("A figure is left out")));
    r.results[0].budget[0].share.number = 1e13;
    EXPECT_THAT(text_of(r),
                HasSubstr("A figure is left out, because its numbers are of a size that no plot can show: What "
                          "dominates the uncertainty of l"));
    ASSERT_FALSE(r.results[0].monte_carlo->histogram.empty());
    r.results[0].monte_carlo->symmetric.number[1] = 1e300;
    EXPECT_THAT(text_of(r),
                testing::AllOf(HasSubstr("can show: l"), HasSubstr(": histogram of the Monte Carlo trials")));
}

/// The digits of u are those that the record holds.
TEST(BudgetCertificate, PrintsUWithTheDigitsThatTheTrialsHold) {
    EvaluationRecord r = test::sample_budget_record();
    r.results[0].reported = monte_carlo_result(50000203.0, 568.0, {49999020.0, 50000856.0}, 0.99, "second_order");
    ReportedRounding one;
    one.digits_of_u = 1;
    print_reported(r.results[0].reported, r.results[0].unit, one);
    EXPECT_THAT(cells(table(view_of(r), "results-0"), 0), testing::Contains("6 × 10²"));
}

TEST(BudgetCertificate, PointsOfDifferentMethodsStandInTheirColumns) {
    EvaluationRecord r = test::sample_points_record(3);
    r.results[1].reported = monte_carlo_result(5.2, 1.4, {4.0, 8.3}, 0.99, "not_linear");
    print_reported(r.results[1].reported, r.results[1].unit);
    const json view = view_of(r);
    EXPECT_THAT(heads(table(view, "results-0")),
                ElementsAre("Point", "Value", "U", "u", "Lower end", "Upper end", "k", "ν_eff", "Coverage"));
    EXPECT_THAT(cells(table(view, "results-0"), 1),
                ElementsAre("2 mm", "5.2", "–", "1.4", "4.0", "8.3", "–", "–", "(b)"));
}

/// Half of the last printed digit of k: the sentence says what the certified tables say.
TEST(BudgetCertificate, PrintsCoverageFactorsAsCertifiedTablesDo) {
    EvaluationRecord r = test::sample_budget_record();
    for (int i = 0; i < 40; ++i) {
        r.results[0].k = std::stod(std::to_string(165 + i) + "5e-3");
        const std::string printed = certificate::printed_coverage_factor(*r.results[0].k);
        EXPECT_THAT(text_of(r), HasSubstr("the coverage factor k = " + printed + ","));
    }
}

TEST(BudgetCertificate, MarksResultsOfDifferentCoverage) {
    const std::string text = text_of(test::sample_two_results_record());
    EXPECT_THAT(text, HasSubstr(" R resistance 127.73 0.20 0.071 Ω 2.87 4 (a) "));
    EXPECT_THAT(text, HasSubstr(" X reactance 219.85 – 0.30 Ω – – (b) "));
    EXPECT_THAT(text, HasSubstr("(a) The reported expanded uncertainty"));
    EXPECT_THAT(text, HasSubstr("(b) An expanded uncertainty cannot be stated"));
    EvaluationRecord r = test::sample_points_record(3);
    r.results[1].k = 3.1;
    r.results[1].nu_eff = 11.9;
    EXPECT_THAT(text_of(r), HasSubstr("coverage factor k between 2.92 and 3.10, which for a t-distribution with "
                                      "effective degrees of freedom ν_eff of 11 or more"));
}

TEST(BudgetCertificate, SaysWhatMonteCarloFound) {
    EvaluationRecord r = test::sample_budget_record();
    EXPECT_THAT(text_of(r), HasSubstr("l: the law of propagation is not validated (JCGM 101:2008, clause 8)"));
    EXPECT_THAT(text_of(r), HasSubstr("by 0.20 nm and 1.3 nm; at least one exceeds the tolerance δ = 0.50 nm"));
    EXPECT_THAT(text_of(r), HasSubstr(" symmetric interval, lower end 50000745 0.41 "));
    r.results[0].monte_carlo->validation->validated = true;
    EXPECT_THAT(text_of(r), HasSubstr("l: the law of propagation is validated"));
    r.results[0].monte_carlo->validation->precise_enough = false;
    EXPECT_THAT(text_of(r), HasSubstr("it cannot be said whether the law of propagation is valid"));
    r.results[0].monte_carlo->validation.reset();
    EXPECT_THAT(text_of(r), Not(HasSubstr("clause 8")));
    r.results[0].monte_carlo->adaptive = true;
    r.results[0].monte_carlo->stabilised = false;
    EXPECT_THAT(text_of(r), HasSubstr("had not become stable"));
    // Without a variance: what is stated goes by what is reported, and stability is told of the ends.
    r.results[0].monte_carlo->u = {};
    for (const char* method : {"law_of_propagation", "monte_carlo"}) {
        const bool by_trials = std::string(method) == "monte_carlo";
        if (by_trials) {
            r.results[0].reported = monte_carlo_result(50000838.0, {}, {50000744.0, 50000932.0}, 0.99, "contradicted");
            print_reported(r.results[0].reported, r.results[0].unit);
        }
        EXPECT_EQ(text_of(r).find("Only the coverage interval is stated") != std::string::npos, by_trials) << method;
        EXPECT_EQ(text_of(r).find("The result is that of the law of propagation, which") != std::string::npos,
                  !by_trials);
        EXPECT_THAT(text_of(r), HasSubstr("had not become stable"));
    }
}

/// What every form of the documents of the samples must show, as texts that stand side by side.
const std::vector<std::string> k_end_gauge = {
    " l length of the end gauge at 20 °C 50000838 93 nm 2.92 16.7 ",
    " 50000623 nm 25 nm t B 18 1 25.0 62.2 ",
    " 215.0 nm 5.8 nm t A 24 1 (5.8) (3.3) ",
    " 0 K⁻¹ 5.8 × 10⁻⁷ K⁻¹ rectangular B 50 5.00 × 10⁶ nm·K 2.9 0.8 ",
    " l 50000838 nm – t – 16.7 – 32 100 ",
    " d: repeatability five readings ",
    " l 32 34 0 nm ",
    " mean of the trials 50000838.1 0.036 ",
    " standard uncertainty u 35.6 0.025 ",
    " shortest interval, upper end 50000931.1 0.55 ",
    " warning GC-ENGINE-0101 ",
};
const std::vector<std::string> k_two_results = {
    " R resistance 127.73 0.20 0.071 Ω 2.87 4 (a) ",
    " X reactance 219.85 – 0.30 Ω – – (b) ",
    " 0 = X − V/I·sin(",
    " The equations are solved for X. ",
    " correlation – – – – – – −0.1806 −647.3 ",
    " R 1 −0.588 ",
    " X −0.588 1 ",
    " = 2.49 ",
    " = 2.21 ",
    " y1 −0.1712 0.0029 °C 1 −0.9300 ",
    " Residual standard deviation 0.0035 K ",
    " Sum of squares of the residuals 0.00011 K² ",
    " V 5 4.9990 0.0072 0.0032 – V 0.31 0.88 ",
    " I: repeatability 5 0.0196610 0.000021 0.0000095 2.4 × 10⁻⁵ A – 0.88 dependent ",
    " between groups 1.5 × 10⁻⁷ 9 1.6 × 10⁻⁸ 2.25 2.12 0.038 ",
    " within groups 2.9 × 10⁻⁷ 40 7.2 × 10⁻⁹ – – – ",
    " s within groups, pooled 0.000085 V ",
    " the differences between the groups are significant at the 5 % level. ",
};

TEST(BudgetCertificate, EquationsAreWrittenAsMathematics) {
    EXPECT_THAT(text_of(test::sample_budget_record()),
                HasSubstr(" l = l_s + d − l_s·(d_alpha·theta + alpha_s·d_theta) "));
    EXPECT_THAT(
        render_html(test::sample_budget_record(), assets()),
        HasSubstr("= <i>l</i><sub>s</sub> + <i>d</i> − <i>l</i><sub>s</sub>·(<i>d</i><sub>α</sub>·<i>θ</i> + "));
}

TEST(BudgetCertificate, EquationsHaveTheDecimalSignOfTheDocument) {
    EvaluationRecord record = test::sample_budget_record();
    record.model->equations = {"y = max(1.5*a, 0.25) - 1e-5", "z = max(a, b)", "v = min(1,2)"};
    const auto dump = [&](const char* language) {
        std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/" + language + ".json");
        return certificate_view(record, Wording(json::parse(file))).dump();
    };
    EXPECT_THAT(dump("de"), HasSubstr("y = max(1,5·a; 0,25) − 1e-5"));
    EXPECT_THAT(dump("de"), HasSubstr("z = max(a, b)"));
    EXPECT_THAT(dump("de"), HasSubstr("v = min(1;2)")) << "not 1.2";
    EXPECT_THAT(dump("en"), HasSubstr("v = min(1,2)"));
    EXPECT_THAT(dump("en"), HasSubstr("y = max(1.5·a, 0.25) − 1e-5"));
}

TEST(BudgetCertificate, EquationsHaveRaisedExponentsWhereTheyAreWhole) {
    EvaluationRecord record = test::sample_budget_record();
    record.model->equations = {"R = R_0*(1 + A*t + B*t^2 + C*(t - 100)*t**3)", "y = x^-12/z^2.5",
                               "z = a^2^3 + a^(2) + a^2b", "v = 1e-5^2*w ** 2"};
    const std::string view =
        certificate_view(record, Wording(json::parse(read_asset(assets().templates / "wording/en.json")))).dump();
    EXPECT_THAT(view, HasSubstr("R = R_0·(1 + A·t + B·t² + C·(t − 100)·t³)"));
    EXPECT_THAT(view, HasSubstr("y = x⁻¹²/z^2.5"));
    EXPECT_THAT(view, HasSubstr("z = a^2³ + a^(2) + a^2b"));
    EXPECT_THAT(view, HasSubstr("v = 1e-5²·w ** 2"));
}

TEST(BudgetCertificate, HtmlAndTextShowTheSameNumbers) {
    for (const auto& [record, rows] : {std::pair(test::sample_budget_record(), k_end_gauge),
                                       std::pair(test::sample_two_results_record(), k_two_results)}) {
        const std::string html = html_text(render_html(record, assets()));
        const std::string text = text_of(record);
        for (const std::string& row : rows) {
            EXPECT_THAT(html, HasSubstr(row));
            EXPECT_THAT(text, HasSubstr(row));
        }
    }
}

TEST(BudgetCertificate, PdfShowsTheSameNumbers) {
    SKIP_WITHOUT_PDF();
    for (const auto& [record, rows] : {std::pair(test::sample_budget_record(), k_end_gauge),
                                       std::pair(test::sample_two_results_record(), k_two_results)}) {
        const std::string text = pdf_text(render_pdf(record, assets()));
        if (text.empty()) {
            GTEST_SKIP() << "pdftotext is missing: the texts of the PDF were not compared";
        }
        for (const std::string& row : rows) {
            EXPECT_THAT(text, HasSubstr(row));
        }
    }
}

TEST(BudgetCertificate, PlotsHaveAlternativeTexts) {
    const std::string html = render_html(test::sample_budget_record(), assets());
    EXPECT_THAT(html, HasSubstr("largest first: l_s 62.2 %, d_theta 27.7 %, d 9.4 %, d_alpha 0.8 %"));
    EXPECT_THAT(html, HasSubstr("Symmetric coverage interval from 50000745 to 50000932 nm."));
    EXPECT_THAT(html, HasSubstr("deviation from the reported value of l / nm"));
    EXPECT_THAT(render_html(test::sample_two_results_record(), assets()), HasSubstr("Residual / 10⁻³ K"));
}

/// The shares are those of the law: of a result of trials they are not what its uncertainty consists of.
TEST(BudgetCertificate, SharesAreSaidToBeThoseOfTheLawWhereTrialsAreReported) {
    EvaluationRecord r = test::sample_budget_record();
    EXPECT_THAT(render_html(r, assets()), HasSubstr("What dominates the uncertainty of "));
    r.results[0].reported = monte_carlo_result(50000203.0, 568.0, {49999020.0, 50000856.0}, 0.99, "vanishing");
    print_reported(r.results[0].reported, r.results[0].unit);
    const std::string html = render_html(r, assets());
    EXPECT_THAT(html, Not(HasSubstr("What dominates")));
    EXPECT_THAT(
        html,
        HasSubstr("by the law of propagation of uncertainty. The reported result is that of the Monte Carlo method."));
}

TEST(BudgetCertificate, HostileNamesAreShownAsTexts) {
    const auto with = [](const std::string& name) {
        EvaluationRecord r = test::sample_two_results_record();
        r.results[0].monte_carlo = test::sample_budget_record().results[0].monte_carlo;
        r.results[0].monte_carlo->symmetric.number = r.results[0].monte_carlo->shortest.number = {127.5, 128.0};
        r.results[0].name = r.covariance->names[0] = name;
        r.results[0].description = r.results[1].coverage_note = name;
        r.results[0].budget[0].input = r.results[0].budget[0].source = r.results[0].budget[0].unit = name;
        r.results[0].budget[0].distribution = name;
        r.model->equations[0] = r.model->unknowns[0] = name;
        r.fits[0].name = r.fits[0].equation = r.fits[0].x_name = r.fits[0].parameters[0].name = name;
        r.fits[0].y_unit = r.readings[0].input = r.readings[0].unit = r.variance_analyses[0].component = name;
        return r;
    };
    // Single letters of an equation are italic, whoever wrote it.
    const auto tags = [](std::string html) {
        for (const std::string italic : {"<i>", "</i>"}) {
            for (std::size_t at = html.find(italic); at != std::string::npos; at = html.find(italic, at)) {
                html.erase(at, italic.size());
            }
        }
        return std::count(html.begin(), html.end(), '<');
    };
    const auto plain = tags(render_html(with("Smith"), assets()));
    for (const std::string name : {"<script>alert(1)</script>", "\" onload=\"alert(1)", "{{title}} {name}", "</svg>",
                                   "]]> --> <!--", "#panic(\"x\")"}) {
        EXPECT_EQ(tags(render_html(with(name), assets())), plain) << name;
        std::istringstream lines(render_text(with(name + std::string(300, 'W')), assets()));
        for (std::string line; std::getline(lines, line);) {
            const auto characters =
                std::count_if(line.begin(), line.end(), [](char c) { return !text::is_continuation(c); });
            EXPECT_LE(characters, 100) << line;
        }
    }
    EXPECT_THAT(render_html(with("<b>"), assets()), HasSubstr("Uncertainty budget of &lt;b&gt; (&lt;b&gt;)."));
    if (pdf_is_possible()) {
        EXPECT_THAT(render_pdf(with("#panic(\"x\") $x$ *b* `raw` @ref <label>"), assets()), HasSubstr("%PDF-1.7"));
    }
}

// "E[1]" alone tells nobody what it is a budget of.
TEST(BudgetCertificate, CaptionsSayWhatAResultIs) {
    EvaluationRecord record = test::sample_points_record(2);
    record.results[0].description = "error of indication";
    record.results[1].description = "Fehler";
    record.results[1].description_by_language.by_language = {{"en", "error"}, {"de", "Abweichung"}};
    const std::string name = record.results[0].name;
    const std::string text = text_of(record);
    EXPECT_THAT(text, HasSubstr("Uncertainty budget of " + name + " (error of indication)."));
    EXPECT_THAT(text, HasSubstr("Monte Carlo of " + name + " (error of indication):"));
    EXPECT_THAT(text, HasSubstr("Uncertainty budget of " + record.results[1].name + " (error)."));
    record.results[0].description.clear();
    EXPECT_THAT(text_of(record), HasSubstr("Uncertainty budget of " + name + "."));
}

TEST(BudgetCertificate, PointsBecomeOneTable) {
    const json view = view_of(test::sample_points_record(13));
    const json& points = table(view, "results-0");
    EXPECT_EQ(points["rows"].size(), 13U);
    EXPECT_THAT(heads(points), ElementsAre("Point", "Value", "U", "k", "ν_eff"));
    EXPECT_THAT(cells(points, 12), ElementsAre("13 mm", "50000850", "93", "2.92", "16.7"));
    EXPECT_THROW(static_cast<void>(table(view, "budget-12")), std::out_of_range);
    EXPECT_THAT(text_of(test::sample_points_record(13)),
                HasSubstr("The budgets of the first 12 of 13 results are shown."));
    EXPECT_EQ(table(view, "monte-carlo")["rows"].size(), 13U);
    EXPECT_THAT(text_of(test::sample_points_record(13)), HasSubstr("validated for 0 results, not validated for 13"));
}

TEST(BudgetCertificate, AThousandPointsStayReasonable) {
    const EvaluationRecord record = test::sample_points_record(1000);
    const std::string html = render_html(record, assets());
    EXPECT_LT(html.size(), 2'000'000U);
    EXPECT_THAT(html, HasSubstr(">1000 mm<"));
    EXPECT_LT(render_text(record, assets()).size(), 400'000U);
    if (pdf_is_possible()) {
        EXPECT_LT(render_pdf(record, assets()).size(), 6'000'000U);
    }
}

TEST(BudgetCertificate, WorksWithoutOptionalParts) {
    EvaluationRecord r = test::sample_budget_record();
    r.model.reset();
    r.results[0].budget.clear();
    r.results[0].second_order.reset();
    r.results[0].monte_carlo.reset();
    r.diagnostics.clear();
    EXPECT_THAT(section_ids(view_of(r)), ElementsAre("identification", "results", "input"));
    EvaluationRecord two = test::sample_two_results_record();
    two.covariance->file = "covariance.csv";
    two.region->k_p.number.reset();
    two.region->smallest_region.reset();
    two.fits[0].x_name = "";
    two.fits[0].x.number.clear();
    const std::string text = text_of(two);
    EXPECT_THAT(text, HasSubstr("in the file covariance.csv"));
    EXPECT_THAT(text, HasSubstr("cannot be stated: the covariance matrix is singular"));
    EXPECT_THAT(render_html(two, assets()), HasSubstr("number of the observation"));
}

TEST(BudgetCertificate, ExactResultsAreNoMultipleOfAStandardUncertainty) {
    EvaluationRecord r = test::sample_budget_record();
    for (Result& result : r.results) {
        result.u = 0.0;
        result.U = 0.0;
        result.k.reset();
        result.coverage = "normal";
        result.coverage_note.clear();
        result.reported = {};
        result.printed = {.value = "0.3", .U = "0", .unit = ""};
    }
    EXPECT_THAT(text_of(r), HasSubstr("Values with U = 0 follow from constants alone"));
    EXPECT_THAT(text_of(r), Not(HasSubstr("multiplied by the coverage factor")));
}

// Every name that the program gives to a component, in every language.
TEST(CertificateBudget, ComponentsHaveTheirNamesInTheLanguageOfTheDocument) {
    EvaluationRecord record = test::sample_budget_record();
    const auto row = std::find_if(record.results.front().budget.begin(), record.results.front().budget.end(),
                                  [](const BudgetRow& one) { return !one.components.empty(); });
    ASSERT_NE(row, record.results.front().budget.end());
    BudgetRow& part = row->components.front();
    for (const std::string kind : {"calibration", "interpolation", "drift", "readings", "resolution"}) {
        part.part = kind;
        part.input = "The English name of " + kind;
        part.source = "The English source";
        part.standard = "STD-17";
        part.certificate = "C-2";
        part.since = "2026-01-01";
        std::set<std::string> names;
        for (const std::string language : {"en", "de", "es", "zh-Hant"}) {
            std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/" + language + ".json");
            const json wording = json::parse(file);
            const std::string view = certificate_view(record, Wording(wording)).dump();
            EXPECT_THAT(view, Not(HasSubstr("The English"))) << language << " " << kind;
            EXPECT_THAT(view, HasSubstr("C-2")) << "its source";
            if (kind != "readings" && kind != "resolution") {
                EXPECT_THAT(view, HasSubstr("STD-17"));
            }
            EXPECT_EQ(view.find("2026-01-01") != std::string::npos, kind == "drift") << language << " " << kind;
            names.insert(wording.at("budget_part").at(kind).get<std::string>());
        }
        EXPECT_EQ(names.size(), 4U) << kind;
    }
}

}  // namespace
}  // namespace gumcert::reports
