// What is reported of a budget, against distributions that are known exactly.
#include "reports/record/make/budget/budget_reported_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "gum/monte_carlo/monte_carlo.h"
#include "reports/record/certified_tables.h"
#include "reports/record/make/budget/budget_record.h"
#include "reports/record/make/budget/capability_inputs.h"
#include "reports/record/make/certificate/certified_conformity.h"
#include "reports/record/reported_result.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/case_count.h"
#include "tests/support/sample_certificate.h"
#include "tests/support/sample_laboratory.h"

namespace gumcert::reports {
namespace {

constexpr double k_p = 0.9545;

std::string number(double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
}

jobs::BudgetJob budget(const std::string& model, const std::string& inputs, const std::string& more = "") {
    return jobs::test::read_budget("\"model\": [\"" + model + "\"], \"inputs\": {" + inputs + "}" + more);
}

struct Evaluated {
    gum::BudgetResult result;
    reports::EvaluationRecord record;
    [[nodiscard]] const reports::Result& y() const { return record.results.front(); }
    [[nodiscard]] const reports::ReportedResult& reported() const { return y().reported; }
    [[nodiscard]] bool tells(const std::string& code) const {
        return std::any_of(result.notes.begin(), result.notes.end(),
                           [&](const gum::Diagnostic& note) { return note.code == code; });
    }
};

Evaluated evaluated(const jobs::BudgetJob& job) {
    Evaluated out;
    out.result = gum::evaluate_budget(job, 1);
    out.record = budget_record(job, out.result, {}, {}, "");
    return out;
}

/// The distribution function of an input, and its statement in a job.
struct Input {
    std::string statement;
    std::function<double(double)> P;
    double centre = 0.0, width = 0.0;  ///< all of it, or 9 standard deviations, lies within centre ± width
};

double normal_P(double z) {
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

Input normal(double m, double u) {
    return {R"({"value": )" + number(m) + R"(, "u": )" + number(u) + "}",
            [m, u](double x) { return normal_P((x - m) / u); }, m, 9.0 * u};
}
Input uniform(double m, double a) {
    return {R"({"value": )" + number(m) + R"(, "half_width": )" + number(a) + "}",
            [m, a](double x) { return std::clamp((x - m + a) / (2.0 * a), 0.0, 1.0); }, m, a};
}
Input triangular(double m, double a) {
    return {R"({"value": )" + number(m) + R"(, "half_width": )" + number(a) + R"(, "distribution": "triangular"})",
            [m, a](double x) {
                const double t = std::clamp((x - m) / a, -1.0, 1.0);
                return t < 0.0 ? 0.5 * (1.0 + t) * (1.0 + t) : 1.0 - 0.5 * (1.0 - t) * (1.0 - t);
            },
            m, a};
}

/// A budget whose result has a distribution that is known.
struct Case {
    std::string model, inputs;
    std::function<double(double)> P;  ///< P(Y ≤ y)
};

/// P(Y ≤ y) where Y = f(x, Z): the mean over x, by Gauss-Legendre in many panels, of P(Y ≤ y | x).
std::function<double(double)> over(const Input& x, const std::function<double(double, double)>& conditional) {
    return [x, conditional](double y) {
        constexpr int k_panels = 4000;
        const double step = 2.0 * x.width / k_panels;
        double sum = 0.0;
        for (int i = 0; i < k_panels; ++i) {
            const double low = x.centre - x.width + i * step;
            sum += (x.P(low + step) - x.P(low)) * conditional(low + 0.5 * step, y);
        }
        return sum;
    };
}

constexpr int k_kinds = 17;

/// \param kind  of the model, from 0
Case random_case(std::mt19937_64& random, int kind) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto between = [&](double low, double high) { return low + (high - low) * unit(random); };
    const auto input = [&](double m, double half) {
        const double which = unit(random);
        return which < 0.4 ? normal(m, 0.5 * half) : which < 0.7 ? uniform(m, half) : triangular(m, half);
    };
    const auto bounded = [&](double m, double half) {
        return unit(random) < 0.5 ? uniform(m, half) : triangular(m, half);
    };
    const auto of_x = [](const Input& x) { return "\"x\": " + x.statement; };
    const double at = unit(random) < 0.3 ? 0.0 : between(-1.0, 1.0);
    const Input x = input(at, std::pow(10.0, between(-1.0, 0.5)));
    const double l = between(0.3, 3.0);
    switch (kind) {
        case 0:
            return {"y = x^2", of_x(x),
                    [x](double y) { return y <= 0.0 ? 0.0 : x.P(std::sqrt(y)) - x.P(-std::sqrt(y)); }};
        case 1:
            return {"y = exp(x)", of_x(x), [x](double y) { return y <= 0.0 ? 0.0 : x.P(std::log(y)); }};
        case 2: {
            const Input positive = bounded(l, between(0.1, 0.95) * l);
            return {"y = ln(x)", of_x(positive), [positive](double y) { return positive.P(std::exp(y)); }};
        }
        case 3: {
            const Input positive = bounded(l, between(0.1, 1.0) * l);
            return {"y = sqrt(x)", of_x(positive), [positive](double y) { return y < 0.0 ? 0.0 : positive.P(y * y); }};
        }
        case 4: {
            const Input positive = bounded(l, between(0.1, 0.9) * l);
            return {"y = 1/x", of_x(positive),
                    [positive](double y) { return y <= 0.0 ? 0.0 : 1.0 - positive.P(1.0 / y); }};
        }
        case 5:
            return {"y = abs(x)", of_x(x), [x](double y) { return y < 0.0 ? 0.0 : x.P(y) - x.P(-y); }};
        case 6:
            return {"y = max(x, 0)", of_x(x), [x](double y) { return y < 0.0 ? 0.0 : x.P(y); }};
        case 7:
            return {"y = x^3", of_x(x), [x](double y) { return x.P(std::cbrt(y)); }};
        case 8: {
            const Input angle = bounded(unit(random) < 0.5 ? 0.0 : between(-0.1, 0.1), between(0.1, 1.5));
            return {"y = " + number(l) + "*cos(x*rad)", of_x(angle), [angle, l](double y) {
                        const double a = std::acos(std::clamp(y / l, -1.0, 1.0));
                        return 1.0 - (angle.P(a) - angle.P(-a));
                    }};
        }
        case 9: {
            const Input angle = bounded(0.0, between(0.3, std::numbers::pi / 2.0));
            return {"y = sin(x*rad)", of_x(angle),
                    [angle](double y) { return angle.P(std::asin(std::clamp(y, -1.0, 1.0))); }};
        }
        case 10:
            return {"y = tanh(x)", of_x(x), [x](double y) {
                        return y <= -1.0 ? 0.0 : y >= 1.0 ? 1.0 : x.P(std::atanh(y));
                    }};
        case 11:
            return {"y = sinh(x)", of_x(x), [x](double y) { return x.P(std::asinh(y)); }};
        case 12:
            return {"y = min(x, " + number(at) + ")", of_x(x), [x, at](double y) { return y >= at ? 1.0 : x.P(y); }};
        case 13: {
            const double u = std::pow(10.0, between(-1.0, 1.0));
            const Input z = normal(0.0, u);
            return {"y = sqrt(x^2 + z^2)", of_x(z) + ", \"z\": " + z.statement,
                    [u](double y) { return y < 0.0 ? 0.0 : -std::expm1(-0.5 * y * y / (u * u)); }};
        }
        case 14: {
            const double m = between(-1.0, 1.0);
            const double u = between(0.2, 1.0);
            return {"y = x*z", of_x(x) + ", \"z\": " + normal(m, u).statement, over(x, [m, u](double at_x, double y) {
                        const double z = at_x == 0.0 ? (y >= 0.0 ? 1e9 : -1e9) : y / at_x;
                        return at_x >= 0.0 ? normal_P((z - m) / u) : 1.0 - normal_P((z - m) / u);
                    })};
        }
        case 15: {
            const double u = between(0.05, 1.0);
            return {"y = x^2 + z", of_x(x) + ", \"z\": " + normal(0.0, u).statement,
                    over(x, [u](double at_x, double y) { return normal_P((y - at_x * at_x) / u); })};
        }
        default: {
            const double u = between(0.2, 1.0);
            const Input difference = normal(at, std::numbers::sqrt2 * u);
            return {"y = abs(a - b)",
                    "\"a\": " + normal(5.0 + at, u).statement + ", \"b\": " + normal(5.0, u).statement,
                    [difference](double y) { return y < 0.0 ? 0.0 : difference.P(y) - difference.P(-y); }};
        }
    }
}

/// The value with probability P below it, by bisection.
double quantile(const std::function<double(double)>& P, double p, double about, double width) {
    double low = about - width;
    double high = about + width;
    for (int i = 0; i < 60 && P(low) > p; ++i) {
        low -= width *= 2.0;
    }
    for (int i = 0; i < 60 && P(high) < p; ++i) {
        high += width *= 2.0;
    }
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (P(middle) < p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

const char* const k_rules[] = {"DR-01", "DR-03", "DR-04", "DR-05", "DR-06", "DR-07", "DR-08", "DR-11", "DR-13"};

certificate::AgreedSpecification specification(const std::string& rule, double upper) {
    certificate::AgreedSpecification s = test::sample_specification("limit", "y", 0.0, upper, "1");
    s.lower.reset();
    s.rule.id = rule;
    if (rule == "DR-04" || rule == "DR-13") {
        s.rule.guard_factor = 0.5;
    }
    if (rule == "DR-07") {
        s.rule.probability = 0.05;
    }
    return s;
}

TEST(ReportedResult, HasTheIntervalAndTheVerdictsOfTheExactDistribution) {
    std::mt19937_64 random(14);
    int by_trials = 0;
    int decided = 0;
    const int cases = k_kinds * test::cases(2, 12);
    for (int i = 0; i < cases; ++i) {
        const Case c = random_case(random, i % k_kinds);
        SCOPED_TRACE(c.model + "; " + c.inputs);
        const jobs::BudgetJob job = [&] {
            jobs::BudgetJob read = budget(c.model, c.inputs);
            read.certificate = test::sample_certificate_data();
            return read;
        }();
        const Evaluated e = evaluated(job);
        const reports::ReportedResult& reported = e.reported();
        if (!reported.interval) {  // all values are one: the uncertain inputs cancel
            EXPECT_EQ(c.P(reported.value - 1e-9), 0.0);
            EXPECT_EQ(c.P(reported.value + 1e-9), 1.0);
            continue;
        }
        const double low = (*reported.interval)[0];
        const double high = (*reported.interval)[1];
        const double tail = 0.5 * (1.0 - k_p);
        const double half = 0.5 * (high - low);
        if (reported.method == "monte_carlo") {
            ++by_trials;
            // An order statistic is off by the binomial scatter of its rank.
            const double scatter =
                5.0 * std::sqrt(tail * (1.0 - tail) / static_cast<double>(e.y().monte_carlo->trials.number));
            const double nothing = 1e-9 * half;  // a distribution with a jump: just below and just above it
            EXPECT_LE(c.P(low - nothing), tail + scatter);
            EXPECT_GE(c.P(low + nothing), tail - scatter);
            EXPECT_LE(c.P(high - nothing), 1.0 - tail + scatter);
            EXPECT_GE(c.P(high + nothing), 1.0 - tail - scatter);
        } else {
            EXPECT_NEAR(low, quantile(c.P, tail, low, half), 0.1 * half) << "what the law is held adequate for";
            EXPECT_NEAR(high, quantile(c.P, 1.0 - tail, high, half), 0.1 * half);
            continue;
        }
        const certificate::CertifiedTable table = reports::certified_tables(e.record).front();
        const certificate::CertifiedValue& value = table.columns.front().values.front();
        const gum::TrialDistribution trials = gum::count_trials(capability_inputs(job, e.result).trials.at("y"));
        const KnownDistribution counted{
            .function = trials.function, .below = trials.below, .note = "counted", .trials = trials.counted};
        const KnownDistribution exact{.function = c.P, .below = {}, .note = "exact", .trials = 0};
        std::uniform_real_distribution<double> place(-2.0, 4.0);
        const double limit = reported.value + place(random) * half;
        for (const char* rule : k_rules) {
            SCOPED_TRACE(rule + std::string(", limit ") + number(limit));
            const auto verdict = [&](double at, const KnownDistribution& known) {
                return verdict_of(specification(rule, at), table.columns.front(), value, known);
            };
            const certificate::Verdict of_trials = verdict(limit, counted);
            const certificate::Verdict of_exact = verdict(limit, exact);
            const double p = of_exact.conformance_probability;
            EXPECT_NEAR(of_trials.conformance_probability, p,
                        5.0 * std::sqrt(p * (1.0 - p) / static_cast<double>(trials.counted)) + 1e-6);
            // Not where the limit is within 1 % of U of one where the exact verdict changes.
            if (verdict(limit - 0.01 * half, exact).verdict == of_exact.verdict &&
                verdict(limit + 0.01 * half, exact).verdict == of_exact.verdict) {
                EXPECT_EQ(of_trials.verdict, of_exact.verdict);
                ++decided;
            }
        }
    }
    EXPECT_GT(by_trials, 7 * cases / 10);
    EXPECT_GT(decided, 9 * cases / 2);
}

TEST(ReportedResult, IsThatOfTheLawForEveryLinearBudgetWithoutOneTrial) {
    std::mt19937_64 random(15);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 100; ++i) {
        std::string model = "y = 1";
        std::string inputs;
        for (int n = 0; n < 1 + i % 6; ++n) {
            const std::string name = "x" + std::to_string(n);
            model += " + " + number(2.0 * unit(random) - 1.0) + "*" + name;
            const double scale = std::pow(10.0, 6.0 * unit(random) - 3.0);
            const Input x = unit(random) < 0.5   ? normal(unit(random), scale)
                            : unit(random) < 0.5 ? uniform(unit(random), scale)
                                                 : triangular(unit(random), scale);
            inputs += (inputs.empty() ? "\"" : ", \"") + name + "\": " + x.statement;
        }
        const Evaluated e = evaluated(budget(model, inputs));
        EXPECT_EQ(e.reported().method, "law_of_propagation") << model << inputs;
        EXPECT_FALSE(e.y().monte_carlo) << model << inputs;
        EXPECT_EQ(e.reported().U, e.y().U);
        EXPECT_EQ(e.reported().printed.value, e.y().printed.value);
        EXPECT_EQ(e.reported().printed.U, e.y().printed.U);
    }
}

TEST(ReportedResult, OfADirectionDoesNotDependOnTheDirection) {
    // atan2 leaps at ±180°, the direction does not: u = 0.02 rad, by the law and by trials.
    const double u = 0.02 * 180.0 / std::numbers::pi;
    for (int degrees = -180; degrees < 180; degrees += 9) {
        SCOPED_TRACE(degrees);
        const double angle = (degrees + 0.1) * std::numbers::pi / 180.0;
        const std::string inputs = R"("s": {"value": )" + number(std::sin(angle)) + R"(, "u": 0.02}, "c": {"value": )" +
                                   number(std::cos(angle)) + R"(, "u": 0.02})";
        for (const bool by_trials : {false, true}) {
            const std::string more =
                std::string(R"(, "outputs": {"y": {"unit": "deg"}})") +
                (by_trials ? R"(, "coverage": "monte_carlo", "monte_carlo": {"trials": 20000, "seed": 3})" : "");
            const reports::ReportedResult reported = evaluated(budget("y = atan2(s, c)", inputs, more)).reported();
            EXPECT_EQ(reported.method, by_trials ? "monte_carlo" : "law_of_propagation");
            ASSERT_TRUE(reported.u);
            EXPECT_NEAR(*reported.u, u, by_trials ? 0.02 * u : 1e-3 * u);
            EXPECT_NEAR(std::remainder(reported.value - (degrees + 0.1), 360.0), 0.0, 0.1 * u);
            if (by_trials) {
                EXPECT_LT((*reported.interval)[1] - (*reported.interval)[0], 4.5 * u);
            }
        }
    }
}

TEST(ReportedResult, SaysWhyItIsThatOfMonteCarlo) {
    const auto because = [](const std::string& model, const std::string& inputs, const std::string& more = "") {
        return evaluated(budget(model, inputs, more)).reported().because;
    };
    const std::string x0 = R"("x": {"value": 0, "u": 1})";
    const std::string pair = R"("a": {"value": 3, "u": 1}, "b": {"value": 3, "u": 1})";
    EXPECT_EQ(because("y = x^2", x0), "vanishing");
    EXPECT_EQ(because("y = x^2", R"("x": {"value": 1e-9, "u": 1})"), "vanishing");
    EXPECT_EQ(because("y = x^3", x0), "vanishing");
    EXPECT_EQ(because("y = sin(x)", R"("x": {"value": 90, "u": 0.001, "unit": "deg"})"), "vanishing");
    EXPECT_EQ(because("y = x^2", R"("x": {"value": 1, "u": 0.5})"), "second_order");
    EXPECT_EQ(because("y = abs(a - b)", pair), "no_derivative");
    EXPECT_EQ(because("y = max(a, b)", pair), "no_derivative");
    EXPECT_EQ(because("y = sqrt(x^2 + z^2)", x0 + R"(, "z": {"value": 0, "u": 1})"), "no_derivative");
    EXPECT_EQ(because("y = max(x, 0)", R"("x": {"value": 0.01, "u": 1})"), "not_linear");
    EXPECT_EQ(because("y = x", R"("x": {"distribution": {"kind": "lognormal", "mu": 1, "sigma": 0.8}})"), "asymmetric");
    EXPECT_EQ(because("y = 2*x", x0, R"(, "coverage": "monte_carlo")"), "asked");
    EXPECT_EQ(because("y = 2*x", x0, R"(, "coverage": "monte_carlo", "outputs": {"y": {"coverage": "as_validated"}})"),
              "");
    // Readings with ν = 3 and a normal contribution: k of the convolution is what Monte Carlo finds.
    EXPECT_EQ(because("y = a", R"("a": {"components": [{"name": "r", "observations": [9.9, 10.0, 10.1, 10.0]},
                                                       {"name": "i", "u": 0.05}]})",
                      R"(, "monte_carlo": {"trials": 1000000})"),
              "");
    EXPECT_EQ(because("y = 2*x", x0, R"(, "monte_carlo": {"trials": 1000000})"), "");
}

TEST(ReportedResult, IsForcedWithAWarning) {
    const Evaluated e =
        evaluated(budget("y = x^2", R"("x": {"value": 1, "u": 0.5})", R"(, "coverage": "law_of_propagation")"));
    EXPECT_EQ(e.reported().method, "law_of_propagation");
    EXPECT_EQ(e.reported().against, "second_order");
    EXPECT_TRUE(e.y().monte_carlo) << "trials tell by how much the law is wrong";
    EXPECT_TRUE(e.tells("GC-BUDGET-0026"));
    EXPECT_THROW(
        (void)evaluated(budget("y = abs(x)", R"("x": {"value": 0, "u": 1})", R"(, "coverage": "law_of_propagation")")),
        gum::NoResultError);
}

// One output without a derivative does not take it from the others.
TEST(ReportedResult, IsThatOfTheLawForOutputsBesideOneWithoutDerivative) {
    const Evaluated e = evaluated(jobs::test::read_budget(
        R"json("model": ["d = abs(a - b)", "s = a + b"],
               "inputs": {"a": {"value": 3, "u": 1}, "b": {"value": 3, "u": 1}})json"));
    ASSERT_EQ(e.record.results.size(), 2U);
    EXPECT_EQ(e.record.results[0].reported.because, "no_derivative");
    EXPECT_EQ(e.record.results[1].reported.method, "law_of_propagation");
    EXPECT_NEAR(e.record.results[1].u, std::sqrt(2.0), 1e-12);
    EXPECT_FALSE(e.record.results[0].budget.front().sensitivity.number) << "there is none";
    EXPECT_TRUE(e.record.results[1].budget.front().sensitivity.number);
}

TEST(ReportedResult, StatesNoMomentThatDoesNotExist) {
    const auto of = [](const std::string& model, const std::string& inputs, const std::string& more) {
        return evaluated(budget(model, inputs, more));
    };
    const std::string trials = R"(, "coverage": "monte_carlo", "monte_carlo": {"trials": 1000000})";
    const Evaluated ratio = of("y = a/b", R"("a": {"value": 1, "u": 0.1}, "b": {"value": 0.5, "u": 0.5})", trials);
    EXPECT_FALSE(ratio.reported().u || ratio.reported().U);
    EXPECT_FALSE(ratio.y().monte_carlo->u.number || ratio.y().monte_carlo->mean.number);
    EXPECT_EQ(ratio.reported().value, 2.0);
    EXPECT_TRUE(ratio.tells("GC-BUDGET-0027"));
    const Evaluated three = of("y = x", R"("x": {"observations": [1, 1.1, 1.05]})", trials);
    EXPECT_FALSE(three.reported().u);
    EXPECT_FALSE(three.y().monte_carlo->u.number);
    EXPECT_TRUE(three.y().monte_carlo->mean.number) << "ν = 2 has an expectation";
    const Evaluated two = of("y = x", R"("x": {"observations": [1, 1.1]})", trials);
    EXPECT_FALSE(two.y().monte_carlo->mean.number);
    // Heavy, but with a variance; and bounded.
    EXPECT_TRUE(of("y = x", R"("x": {"value": 1, "u": 0.1, "nu": 4})", trials).reported().u);
    EXPECT_TRUE(of("y = exp(x)", R"("x": {"value": 0, "u": 0.5})", trials).reported().u);
    EXPECT_TRUE(of("y = atan(x)", R"("x": {"value": 0, "u": 1, "nu": 2})", trials).reported().u);
}

TEST(ReportedResult, EndsClearlyWhereTrialsLeaveTheDomain) {
    try {
        (void)evaluated(budget("y = ln(x)", R"("x": {"value": 1, "u": 0.6})"));
        FAIL();
    } catch (const gum::NoResultError& error) {
        const gum::Diagnostic& d = error.diagnostics().front();
        EXPECT_THAT(d.where, testing::HasSubstr("result y"));
        EXPECT_THAT(d.rule, testing::HasSubstr("second-order"));
        EXPECT_THAT(d.action, testing::HasSubstr("law_of_propagation"));
    }
}

// Second-order terms with the moments of what was stated: x² at 0.
TEST(SecondOrder, TakesTheMomentsOfTheDistributions) {
    const auto u = [](const std::string& statement) {
        return evaluated(budget("y = x^2", "\"x\": {" + statement + "}")).y().u;
    };
    EXPECT_NEAR(u(R"("value": 0, "half_width": 1)"), std::sqrt(4.0 / 45.0), 1e-12);
    EXPECT_NEAR(u(R"("value": 0, "half_width": 1, "distribution": "arcsine")"), std::sqrt(1.0 / 8.0), 1e-12);
    EXPECT_NEAR(u(R"("value": 0, "half_width": 1, "distribution": "triangular")"), std::sqrt(7.0 / 180.0), 1e-12);
    EXPECT_NEAR(u(R"("value": 0, "u": 1)"), std::sqrt(2.0), 1e-12);
}

// Limits and kinks that no probe along a line meets, against a million and a half trials of NumPy.
TEST(ReportedResult, SeesWhatOnlyTheScatterOfAllInputsShows) {
    struct Interval {
        std::string model, inputs;
        double low, high;
    };
    const std::vector<Interval> cases{
        {"y = min(a, b)", R"("a": {"value": 5, "u": 1}, "b": {"value": 7, "half_width": 2})", 2.996, 6.743},
        {"y = hypot(x, z)", R"("x": {"value": 1, "half_width": 1}, "z": {"value": 0, "u": 0.3})", 0.1506, 1.978},
        {"y = sqrt(x^2 + z^2)", R"("x": {"value": 5, "u": 1}, "z": {"value": 0, "u": 1})", 3.129, 7.086}};
    for (const Interval& one : cases) {
        const Evaluated result = evaluated(budget(one.model, one.inputs));
        EXPECT_EQ(result.reported().because, "not_linear") << one.model;
        EXPECT_NEAR((*result.reported().interval)[0], one.low, 0.02) << one.model;
        EXPECT_NEAR((*result.reported().interval)[1], one.high, 0.02) << one.model;
    }
}

// What the program called so, documents call so in their languages.
TEST(BudgetRecordTest, SaysWhatTheComponentsOfAStandardAre) {
    std::map<std::string, std::string> files = gumcert::test::sample_laboratory_files("lab/");
    const Evaluated out = evaluated(jobs::test::read_budget(
        R"j("laboratory": "lab", "model": ["y = x + s"], "inputs": {
            "x": {"unit": "mV", "observations": [1.0, 1.2, 1.1], "resolution": 0.1},
            "s": {"standard": "STD-1", "date": "2026-07-01", "unit": "mV",
                  "components": [{"name": "drift of the cable", "u": 0.1}]}})j",
        files));
    const std::vector<reports::BudgetRow>& rows = out.y().budget;
    ASSERT_EQ(rows.size(), 2U);
    ASSERT_EQ(rows[0].components.size(), 2U);
    EXPECT_EQ(rows[0].components[0].part, "readings");
    EXPECT_EQ(rows[0].components[1].part, "resolution");
    ASSERT_EQ(rows[1].components.size(), 3U);
    EXPECT_EQ(rows[1].components[0].part, "calibration");
    EXPECT_EQ(rows[1].components[1].part, "drift");
    EXPECT_EQ(rows[1].components[2].part, "") << "the words of the laboratory";
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(rows[1].components[i].standard, "STD-1");
        EXPECT_EQ(rows[1].components[i].certificate, "C-2");
        EXPECT_EQ(rows[1].components[i].since, "2026-01-01");
    }
    EXPECT_EQ(rows[1].certificate, "C-2");
    EXPECT_EQ(rows[1].part, "");
}

// The law of printed digits, over numbers of trials, digits and seeds: of a result of Monte Carlo half a unit of the last digit
// is no smaller than the numerical error, and there are no more digits than were asked for; only what begins with 1 or 2
// keeps a second one. U is never printed smaller than it is where it has one.
TEST(ReportedDigits, AreThoseThatTheTrialsHold) {
    for (const std::string model : {"e^2", "3*e^2", "exp(e)", "e^2 + 20*f"}) {
        for (const std::string more : {"\"digits\": 1", "\"digits\": 2", "\"trials\": 10000", "\"trials\": 400000"}) {
            for (int seed = 1; seed <= 2; ++seed) {
                const Evaluated out = evaluated(budget(
                    "y = " + model, R"("e": {"value": 0, "u": 1}, "f": {"value": 0, "u": 1})",
                    R"(, "coverage": "monte_carlo", "monte_carlo": {)" + more + R"(, "seed": )" + number(seed) + "}"));
                const reports::ReportedResult& r = out.reported();
                const std::string where = model + ", " + more + ": " + r.printed.U + r.printed_high;
                ASSERT_EQ(r.method, "monte_carlo");
                const auto& error = out.y().monte_carlo->numerical_error;
                const int digits = reports::printed_digits(r);
                const double half_width = 0.5 * ((*r.interval)[1] - (*r.interval)[0]);
                const bool from_three = half_width >= 5.9 * gum::numerical_tolerance(half_width, 1);
                const bool held =
                    gum::numerical_tolerance(half_width, 2) >= std::max(error.symmetric[0], error.symmetric[1]);
                EXPECT_EQ(digits, from_three && (more == "\"digits\": 1" || !held) ? 1 : 2) << where;
                if (r.U && digits == 1) {
                    EXPECT_GE(std::stod(r.printed.U), *r.U * (1.0 - 1e-12)) << where;
                }
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
