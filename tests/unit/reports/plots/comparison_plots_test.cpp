#include "reports/plots/comparison_plots.h"

#include "tests/support/sample_comparison_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ComparisonPlots : public ::testing::Test {
protected:
    void SetUp() override {
        for (const char* language : {"en", "de", "zh-Hant", "es"}) {
            std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/" + language + ".json");
            ASSERT_TRUE(file) << language;
            texts_.push_back(nlohmann::json::parse(file));
        }
    }

    [[nodiscard]] Wording words(std::size_t language = 0) const { return Wording(texts_.at(language)); }

    /// All plots of the first item of a comparison between laboratories.
    [[nodiscard]] std::vector<std::string> laboratory_plots(const Comparison& c, std::size_t language = 0) const {
        const Wording w = words(language);
        return {laboratory_values_plot(c, c.items[0], "plot-values", w),
                laboratory_scores_plot(c, c.items[0], "plot-scores", w), pairs_plot(c.items[0], "plot-pairs", w),
                youden_plot(c.youden[0], "plot-youden", w)};
    }
    [[nodiscard]] std::vector<std::string> method_plots(const Comparison& c, std::size_t language = 0) const {
        const Wording w = words(language);
        return {method_scores_plot(c, "plot-en", w), method_values_plot(c, "plot-values", w),
                bias_plot(c, "plot-bias", w)};
    }

private:
    std::vector<nlohmann::json> texts_;
};

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++n;
    }
    return n;
}

/// Numbers only, elements closed, inside the drawing.
void expect_sound(const std::string& svg) {
    ASSERT_FALSE(svg.empty());
    EXPECT_THAT(svg, ::testing::StartsWith("<svg xmlns="));
    EXPECT_THAT(svg, ::testing::EndsWith("</svg>\n"));
    for (const char* bad : {"\"nan", "\"-nan", "\"inf", "\"-inf", " nan", ",nan", ",inf", ",-inf", "e+", "<script"}) {
        EXPECT_THAT(svg, Not(HasSubstr(bad)));
    }
    EXPECT_EQ(occurrences(svg, "<text "), occurrences(svg, "</text>"));
    EXPECT_LT(svg.size(), 500'000U);
}

TEST_F(ComparisonPlots, AnyNumberOfLaboratories) {
    for (const std::size_t laboratories : {1U, 2U, 6U, 30U, 60U, 61U, 400U, 500U, 10'000U}) {
        const EvaluationRecord r = test::sample_laboratories_record(laboratories);
        const std::vector<std::string> plots = laboratory_plots(*r.comparison);
        for (const std::size_t i : {0U, 1U, 3U}) {
            expect_sound(plots[i]);
        }
        EXPECT_EQ(plots[2].empty(), laboratories < 2 || laboratories > 40) << laboratories;
        EXPECT_EQ(laboratory_plots(*r.comparison), plots) << "the same bytes";
    }
}

TEST_F(ComparisonPlots, LaboratoriesStandInAscendingOrder) {
    const Comparison c = *test::sample_laboratories_record(9).comparison;
    const std::string svg = laboratory_values_plot(c, c.items[0], "p", words());
    std::size_t last = 0;
    std::vector<ComparisonPoint> points(c.points.begin(), c.points.begin() + 8);
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.value.number < b.value.number; });
    for (const ComparisonPoint& p : points) {
        const std::size_t at = svg.find(">" + p.participant + "</text>");
        ASSERT_NE(at, std::string::npos) << p.participant;
        EXPECT_GT(at, last) << p.participant;
        last = at;
    }
    // Seven contribute and one does not; the key shows one of each, and a mark with a bar.
    EXPECT_EQ(occurrences(svg, "fill=\"#000000\" stroke=\"none\"/>"), 7U + 2U);
    EXPECT_EQ(occurrences(svg, "<circle"), 8U + 3U);
    EXPECT_THAT(svg, HasSubstr("fill=\"#d9d9d9\""));  // the band of the assigned value
    EXPECT_THAT(svg, HasSubstr(">Value / µm</text>"));
}

TEST_F(ComparisonPlots, EveryLaboratoryIsFoundInEveryFigure) {
    for (const std::size_t laboratories : {60U, 62U, 100U, 150U}) {
        const Comparison some = *test::sample_laboratories_record(laboratories).comparison;
        for (const std::string& svg : {laboratory_values_plot(some, some.items[0], "p", words()),
                                       laboratory_differences_plot(some, some.items[0], "p", words())}) {
            for (const ComparisonPoint& p : some.points) {
                if (p.item == some.items[0].id && p.round == some.items[0].round && p.U_D.number) {
                    EXPECT_THAT(svg, HasSubstr(">" + p.participant + "</text>")) << laboratories;
                }
            }
        }
    }
    // Of more there are numbers, which the table of results gives.
    const Comparison many = *test::sample_laboratories_record(162).comparison;
    EXPECT_THAT(laboratory_values_plot(many, many.items[0], "p", words()), Not(HasSubstr(">L031</text>")));
    const Comparison most = *test::sample_laboratories_record(500).comparison;
    EXPECT_LT(occurrences(laboratory_values_plot(most, most.items[0], "p", words()), "<circle"), 5U);
}

TEST_F(ComparisonPlots, LimitsAreThoseOfTheScore) {
    Comparison c = *test::sample_laboratories_record(9).comparison;
    const auto with = [&](const char* score) {
        c.items[0].score = score;
        return laboratory_scores_plot(c, c.items[0], "p", words());
    };
    EXPECT_THAT(with("En"), HasSubstr(">+1 limit</text>"));
    EXPECT_THAT(with("En"), HasSubstr(">\u22121 limit</text>"));
    EXPECT_THAT(with("z"), HasSubstr(">+2 warning</text>"));
    EXPECT_THAT(with("z_prime"), HasSubstr(">\u22123 action</text>"));
    EXPECT_THAT(with("zeta"), HasSubstr("action</text>"));
    EXPECT_THAT(with("D"), HasSubstr(">difference D / µm</text>"));
    EXPECT_EQ(with(""), "");
}

TEST_F(ComparisonPlots, OutliersStandAtTheEdge) {
    Comparison c = *test::sample_laboratories_record(9).comparison;
    const std::string before = laboratory_values_plot(c, c.items[0], "p", words());
    EXPECT_THAT(before, Not(HasSubstr("beyond the axis")));
    EXPECT_THAT(before, HasSubstr(">10.3</text>"));
    for (const double huge : {1e6, 1e17, -1e300}) {
        c.points[0].value.number = huge;
        c.points[0].D.number = huge;
        c.points[0].En.number = huge;
        c.youden[0].points[0].first = huge;
        for (const std::string& svg : laboratory_plots(c)) {
            expect_sound(svg);
        }
        const std::string svg = laboratory_values_plot(c, c.items[0], "p", words());
        EXPECT_THAT(svg, HasSubstr("beyond the axis"));
        EXPECT_THAT(svg, HasSubstr(">10.3</text>"));  // the others keep their axis
    }
    c.points[1].U.number = 1e18;
    expect_sound(laboratory_values_plot(c, c.items[0], "p", words()));
}

TEST_F(ComparisonPlots, MissingUncertaintiesAndEqualValues) {
    Comparison c = *test::sample_laboratories_record(9).comparison;
    for (ComparisonPoint& p : c.points) {
        p.u = p.U.number = p.En.number = p.zeta.number = {};
    }
    EXPECT_EQ(laboratory_scores_plot(c, c.items[0], "p", words()), "");
    c.items[0].u.number = c.items[0].U.number = {};
    const std::string svg = laboratory_values_plot(c, c.items[0], "p", words());
    expect_sound(svg);
    EXPECT_THAT(svg, HasSubstr(">assigned value</text>"));
    EXPECT_THAT(svg, Not(HasSubstr("#d9d9d9")));
    for (ComparisonPoint& p : c.points) {
        p.value.number = c.items[0].value.number;
        p.D.number = 0.0;
    }
    expect_sound(laboratory_values_plot(c, c.items[0], "p", words()));
    for (YoudenPoint& p : c.youden[0].points) {
        p.first = p.second = 0.0;
    }
    c.youden[0].ellipse.clear();
    c.youden[0].centre_first = c.youden[0].centre_second = 0.0;
    expect_sound(youden_plot(c.youden[0], "p", words()));
    c.points.clear();
    EXPECT_EQ(laboratory_values_plot(c, c.items[0], "p", words()), "");
}

TEST_F(ComparisonPlots, ValuesThatDifferInTheirLastDigitsAreShownAsDifferences) {
    Comparison c = *test::sample_laboratories_record(9).comparison;
    for (ComparisonPoint& p : c.points) {
        p.value.number += 50'000'613.0;
    }
    c.items[0].value.number += 50'000'613.0;
    const std::string svg = laboratory_values_plot(c, c.items[0], "p", words());
    EXPECT_THAT(svg, HasSubstr(">difference D / µm</text>"));
    EXPECT_THAT(svg, HasSubstr(">\u22120.2</text>"));
}

TEST_F(ComparisonPlots, VerySmallAndVeryLargeNumbersHaveAPowerOfTen) {
    for (const auto& [factor, power] : {std::pair(1e-12, "10⁻¹²"), std::pair(1e20, "10²¹")}) {
        Comparison c = *test::sample_laboratories_record(9).comparison;
        for (ComparisonPoint& p : c.points) {
            p.value.number *= factor;
            p.D.number *= factor;
            p.U.number = p.U.number ? std::optional(*p.U.number * factor) : std::nullopt;
        }
        c.items[0].value.number *= factor;
        c.items[0].U.number = *c.items[0].U.number * factor;
        c.items[0].unit = "V";
        const std::string svg = laboratory_values_plot(c, c.items[0], "p", words());
        expect_sound(svg);
        EXPECT_THAT(svg, HasSubstr(std::string(">Value / (") + power + " V)</text>"));
    }
}

TEST_F(ComparisonPlots, EveryTextIsEscaped) {
    Comparison c = *test::sample_laboratories_record(9).comparison;
    const std::string name = "<b>\"A&B'";
    for (ComparisonPoint& p : c.points) {
        p.participant = p.participant == "L001" ? name : p.participant;
    }
    for (PairEquivalence& p : c.items[0].pairs) {
        p.first = p.first == "L001" ? name : p.first;
    }
    c.youden[0].points[0].participant = name;
    c.youden[0].first_item = name;
    c.items[0].name = name;
    c.items[0].unit = "<u>";
    for (const std::string& svg : laboratory_plots(c)) {
        expect_sound(svg);
        EXPECT_THAT(svg, HasSubstr("&lt;b&gt;&quot;A&amp;B'"));
        EXPECT_THAT(svg, Not(HasSubstr("<b>")));
        EXPECT_THAT(svg, Not(HasSubstr("<u>")));
    }
    Comparison m = *test::sample_methods_record().comparison;
    m.method_name = m.reference_name = name;
    m.position_name = name;
    for (ComparisonPoint& p : m.points) {
        p.direction = p.direction == "up" ? name : p.direction;
    }
    m.summary[0].direction = name;
    for (const std::string& svg : method_plots(m)) {
        expect_sound(svg);
        EXPECT_THAT(svg, HasSubstr("&lt;b&gt;&quot;A&amp;B'"));
        EXPECT_THAT(svg, Not(HasSubstr("<b>")));
    }
}

TEST_F(ComparisonPlots, PairsAboveOneAreBlack) {
    Comparison c = *test::sample_laboratories_record(9).comparison;
    std::size_t above = 0;
    for (const PairEquivalence& p : c.items[0].pairs) {
        above += std::abs(*p.En.number) > 1.0 ? 1U : 0U;
    }
    ASSERT_GT(above, 0U);
    const std::string svg = pairs_plot(c.items[0], "p", words());
    EXPECT_EQ(occurrences(svg, "fill=\"#000000\" stroke=\"none\"/>"), 2 * above + 1);  // both halves, and the key
    c.items[0].pairs[0].En.number = {};
    expect_sound(pairs_plot(c.items[0], "p", words()));
    c.items[0].pairs.clear();
    EXPECT_EQ(pairs_plot(c.items[0], "p", words()), "");
}

TEST_F(ComparisonPlots, MethodsAgainstPositionAngleOrNumber) {
    Comparison c = *test::sample_methods_record().comparison;
    for (const std::string& svg : method_plots(c)) {
        expect_sound(svg);
        EXPECT_THAT(svg, HasSubstr(">angle / °</text>"));
    }
    EXPECT_THAT(bias_plot(c, "p", words()), HasSubstr(">bias line</text>"));
    for (ComparisonPoint& p : c.points) {
        p.position = {};
    }
    EXPECT_THAT(method_scores_plot(c, "p", words()), HasSubstr(">number of the point</text>"));
    for (ComparisonSummary& s : c.summary) {
        s.bias->against = "reference_value";
    }
    EXPECT_THAT(bias_plot(c, "p", words()), HasSubstr(">value of dial indicator / µm</text>"));

    const Comparison rotary = *test::sample_record().comparison;
    const std::string svg = method_scores_plot(rotary, "p", words());
    EXPECT_THAT(svg, HasSubstr(">table angle θ / °</text>"));
    EXPECT_THAT(svg, HasSubstr(">z</text>"));
    EXPECT_EQ(bias_plot(rotary, "p", words()), "");
}

TEST_F(ComparisonPlots, AnyNumberOfPointsAndDirections) {
    for (const std::size_t points : {1U, 2U, 151U, 5000U}) {
        const Comparison c = *test::sample_methods_record(points).comparison;
        for (const std::string& svg : {method_scores_plot(c, "p", words()), bias_plot(c, "p", words())}) {
            expect_sound(svg);
        }
        EXPECT_LT(method_values_plot(c, "p", words()).size(), 1'000'000U);
    }
    Comparison c = *test::sample_methods_record(40).comparison;
    for (std::size_t i = 0; i < c.points.size(); ++i) {
        c.points[i].direction = "direction of measurement " + std::to_string(i % 20);
    }
    expect_sound(method_scores_plot(c, "p", words()));
    EXPECT_EQ(method_values_plot(c, "p", words()), "");  // twenty panels are no graph
    c.points[3].En.number = -1e12;
    EXPECT_THAT(method_scores_plot(c, "p", words()), HasSubstr("beyond the axis"));
    for (ComparisonPoint& p : c.points) {
        p.En.number = {};
    }
    EXPECT_EQ(method_scores_plot(c, "p", words()), "");
}

std::vector<double> coordinates_of(const std::string& svg, const std::string& before) {
    std::vector<double> numbers;
    for (std::size_t at = svg.find(before); at != std::string::npos; at = svg.find(before, at + 1)) {
        numbers.push_back(std::stod(svg.substr(at + before.size())));
    }
    return numbers;
}

double height_of(const std::string& svg) {
    return coordinates_of(svg, "viewBox=\"0 0 680 ").at(0);
}

TEST_F(ComparisonPlots, NoPointLiesOnTheFrame) {
    Comparison c = *test::sample_methods_record().comparison;
    for (ComparisonPoint& p : c.points) {
        p.direction = "x";
    }
    c.summary[0].direction = "x";
    c.points[1].En.number = 1.5;  // a tick
    for (const std::string& svg : method_plots(c)) {
        const std::string panel = "\" fill=\"none\" stroke=\"#000000\" stroke-width=\"0.9\"/>";
        const std::size_t frame = svg.rfind("<rect", svg.find(panel));
        const std::string rectangle = svg.substr(frame, 120);
        const double x = coordinates_of(rectangle, " x=\"").at(0);
        const double y = coordinates_of(rectangle, " y=\"").at(0);
        const double right = x + coordinates_of(rectangle, " width=\"").at(0);
        const double bottom = y + coordinates_of(rectangle, " height=\"").at(0);
        const std::vector<double> xs = coordinates_of(svg, "cx=\"");
        const std::vector<double> ys = coordinates_of(svg, "cy=\"");
        std::size_t inside = 0;
        for (std::size_t i = 0; i < xs.size(); ++i) {
            if (ys[i] > y - 1.0) {  // the others are those of the key
                ++inside;
                EXPECT_GE(xs[i], x + 5.0);
                EXPECT_LE(xs[i], right - 5.0);
                EXPECT_GE(ys[i], y + 3.0);
                EXPECT_LE(ys[i], bottom - 3.0);
            }
        }
        EXPECT_EQ(inside, c.points.size());
    }
}

TEST_F(ComparisonPlots, NumbersOfPointsAreWhole) {
    Comparison c = *test::sample_methods_record().comparison;
    for (const std::size_t points : {1U, 2U, 3U}) {
        c.points.resize(points == 1 ? 1 : c.points.size());
        if (points > 1) {
            c = *test::sample_methods_record(points).comparison;
        }
        for (ComparisonPoint& p : c.points) {
            p.position = {};
            p.direction = "x";
        }
        const std::string svg = method_scores_plot(c, "p", words());
        EXPECT_THAT(svg, HasSubstr(">1</text>"));
        EXPECT_THAT(svg, Not(HasSubstr(">1.2</text>")));
        EXPECT_THAT(svg, Not(HasSubstr(">1.05</text>")));
    }
}

TEST_F(ComparisonPlots, PanelsOfManyDirectionsFitOnAPage) {
    constexpr double k_page = 900.0;  // drawing units: 228 mm at the width of a page
    Comparison c = *test::sample_methods_record(48).comparison;
    const ComparisonSummary summary = c.summary[0];
    for (const std::size_t directions : {4U, 5U, 8U, 12U}) {
        c.summary.assign(directions, summary);
        for (std::size_t i = 0; i < c.points.size(); ++i) {
            c.points[i].direction = "d" + std::to_string(i % directions);
            c.summary[i % directions].direction = c.points[i].direction;
        }
        for (const std::string& svg : method_plots(c)) {
            expect_sound(svg);
            EXPECT_LT(height_of(svg), k_page) << directions;
        }
        // A mark for each direction: a cross says that a point is beyond the axis, and nothing else.
        EXPECT_EQ(occurrences(method_scores_plot(c, "p", words()), ">direction d"), directions > 4 ? directions : 0U);
    }
}

TEST_F(ComparisonPlots, LongNamesCanBeToldApart) {
    Comparison c = *test::sample_laboratories_record(9).comparison;
    const auto lengthened = [](std::string& id) { id = "Calibration laboratory of the region " + id; };
    for (ComparisonPoint& p : c.points) {
        lengthened(p.participant);
    }
    for (PairEquivalence& p : c.items[0].pairs) {
        lengthened(p.first);
        lengthened(p.second);
    }
    for (YoudenPoint& p : c.youden[0].points) {
        lengthened(p.participant);
    }
    for (const std::string& svg : laboratory_plots(c)) {
        EXPECT_THAT(svg, HasSubstr("ion L001</text>"));
        EXPECT_THAT(svg, HasSubstr("ion L002</text>"));
    }
}

TEST_F(ComparisonPlots, NamesOfNeighboursInAYoudenPlotDoNotCoverEachOther) {
    YoudenDiagram d = test::sample_laboratories_record(9).comparison->youden[0];
    d.points.resize(3);
    for (YoudenPoint& p : d.points) {
        p.first = d.centre_first;
        p.second = d.centre_second;
    }
    const std::string svg = youden_plot(d, "p", words());
    std::set<std::string> places;
    for (const YoudenPoint& p : d.points) {
        const std::size_t name = svg.find(">" + p.participant + "</text>");
        ASSERT_NE(name, std::string::npos);
        const std::size_t begin = svg.rfind("<text", name);
        places.insert(svg.substr(begin, svg.find(" font-size", begin) - begin));
    }
    EXPECT_EQ(places.size(), 3U);
}

TEST_F(ComparisonPlots, ALineForAllDirectionsIsDrawnOnce) {
    Comparison c = *test::sample_methods_record().comparison;
    c.summary[0].bias.reset();
    c.summary[1].bias.reset();
    const std::string svg = bias_plot(c, "p", words());
    EXPECT_EQ(occurrences(svg, "stroke-width=\"1.2\"/>"), 2U);  // the line and its key
    EXPECT_EQ(occurrences(svg, "<circle"), c.points.size() + 1);
}

TEST_F(ComparisonPlots, NumbersThatAreNotFiniteAreRefused) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const auto refused = [&](const std::function<void(Comparison&)>& alter,
                                 const std::function<std::string(const Comparison&)>& draw) {
            Comparison c = *test::sample_laboratories_record().comparison;
            alter(c);
            EXPECT_THROW(static_cast<void>(draw(c)), gum::NoResultError);
        };
        const auto values = [&](const Comparison& c) { return laboratory_values_plot(c, c.items[0], "p", words()); };
        const auto scores = [&](const Comparison& c) { return laboratory_scores_plot(c, c.items[0], "p", words()); };
        refused([&](Comparison& c) { c.points[1].value.number = bad; }, values);
        refused([&](Comparison& c) { c.points[1].U.number = bad; }, values);
        refused([&](Comparison& c) { c.items[0].value.number = bad; }, values);
        refused([&](Comparison& c) { c.points[1].En.number = bad; }, scores);
        refused([&](Comparison& c) { c.items[0].pairs[2].En.number = bad; },
                [&](const Comparison& c) { return pairs_plot(c.items[0], "p", words()); });
        refused([&](Comparison& c) { c.youden[0].points[2].second = bad; },
                [&](const Comparison& c) { return youden_plot(c.youden[0], "p", words()); });
        Comparison m = *test::sample_methods_record().comparison;
        m.points[2].D.number = bad;
        EXPECT_THROW(static_cast<void>(bias_plot(m, "p", words())), gum::NoResultError);
        m.points[2].En.number = bad;
        EXPECT_THROW(static_cast<void>(method_scores_plot(m, "p", words())), gum::NoResultError);
    }
}

TEST_F(ComparisonPlots, AllLanguagesHaveTheirTexts) {
    const Comparison between = *test::sample_laboratories_record().comparison;
    const Comparison methods = *test::sample_methods_record().comparison;
    for (std::size_t language = 0; language < 4; ++language) {
        for (const std::string& svg : laboratory_plots(between, language)) {
            expect_sound(svg);
        }
        for (const std::string& svg : method_plots(methods, language)) {
            expect_sound(svg);
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
