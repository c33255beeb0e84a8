// What must hold for every decision rule: on limits, uncertainties, distributions and parameters made at random.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "gum/conformity/conformity.h"
#include "tests/support/case_count.h"

namespace gumcert::gum {
namespace {

using Parameters = DecisionRuleParameters;

constexpr double k_infinite = std::numeric_limits<double>::infinity();

/// Numbers from the raw words of the generator: the same ones with every standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : words_(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(words_() >> 11) * 0x1p-53;
    }
    double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    std::size_t whole(std::size_t count) { return static_cast<std::size_t>(words_() % count); }

private:
    std::mt19937_64 words_;
};

/// A rule with its parameters where the tolerance is of about the size 1.
struct Rule {
    DecisionRule rule;
    Parameters parameters;
};

/// Every rule in every variant that the limits allow, with numbers drawn for it.
std::vector<Rule> rules_for(Random& random, bool two_sided, double middle) {
    using enum DecisionRule;
    const double r = random.uniform(0.0, 2.0);
    const double w = random.log_uniform(0.01, 3.0);
    const double risk = random.uniform(0.001, 0.5);
    std::vector<Rule> rules{{simple_acceptance, {}},
                            {simple_acceptance_with_ratio, {.largest_U = random.log_uniform(0.01, 10.0)}},
                            {guard_band_u, {}},
                            {guard_band_factor, {.guard_factor = r}},
                            {non_binary, {}},
                            {non_binary, {.guard_factor = r}},
                            {non_binary, {.guard_band = w}},
                            {three_way, {}},
                            {specific_risk, {.probability = risk}},
                            {iso_14253_1, {}},
                            {iso_14253_1, {.probability = random.uniform(0.501, 0.999)}},
                            {iso_14253_1, {.guard_factor = r + 0.01}},
                            {z540_3, {.method = "5"}},
                            {b89_7_3_1, {.guard_factor = random.uniform(-1.0, 2.0)}},
                            {relaxed, {}},
                            {prescribed, {}},
                            {agreed, {.guard_factor = random.uniform(-1.0, 2.0)}},
                            {agreed, {.guard_band = random.uniform(-1.0, 2.0)}}};
    const double s0 = random.log_uniform(0.05, 5.0);
    for (const char* method : {"1", "2", "3", "4"}) {
        rules.push_back({z540_3,
                         {.probability = random.uniform(0.005, 0.3),
                          .population_deviation = s0,
                          .population_centre = middle,
                          .method = method}});
    }
    if (two_sided) {
        const double ratio = random.log_uniform(0.2, 10.0);
        rules.insert(rules.end(),
                     {{simple_acceptance_with_ratio, {.test_uncertainty_ratio = ratio}},
                      {simple_acceptance_with_ratio, {.test_uncertainty_ratio = ratio, .alternative = guard_band_u}},
                      {simple_acceptance_with_ratio, {.test_uncertainty_ratio = ratio, .alternative = three_way}},
                      {z540_3, {.method = "6"}},
                      {z540_3, {.method = "rds"}},
                      {z540_3, {.method = "rp10"}},
                      {z540_3, {.test_uncertainty_ratio = ratio}},
                      {b89_7_3_1, {.test_uncertainty_ratio = ratio}},
                      {b89_7_3_1, {.guard_factor = 1.0, .test_uncertainty_ratio = ratio, .alternative = relaxed}}});
    }
    return rules;
}

/// A dispersion: the same one about every value.
struct Shape {
    double u = 1.0, U = 2.0, nu = k_infinite;
    std::function<double(double)> below = {};  ///< P(Y − y ≤ d); empty: normal or t
    bool one_peak = true;                      ///< and symmetric

    [[nodiscard]] MeasuredValue at(double y) const {
        MeasuredValue value{.value = y, .standard_uncertainty = u, .expanded_uncertainty = U, .degrees_of_freedom = nu};
        if (below) {
            value.distribution = [y, f = below](double x) { return f(x - y); };
        }
        return value;
    }
};

/// A rectangle and a triangle as a convolution gives them, a skewed distribution, and trials that are counted.
Shape some_shape(Random& random, std::size_t kind) {
    const double u = random.log_uniform(0.02, 5.0);
    Shape shape{.u = u, .U = 2.0 * u};
    if (kind == 1) {
        shape.nu = random.log_uniform(1.0, 100.0);
        shape.U = 2.0 * u * (1.0 + 4.0 / shape.nu);
    } else if (kind == 2) {
        const double a = u * std::sqrt(3.0);
        shape.U = 0.9545 * a;
        shape.below = [a](double d) { return std::clamp(0.5 + 0.5 * d / a, 0.0, 1.0); };
    } else if (kind == 3) {
        const double a = u * std::sqrt(6.0);
        shape.below = [a](double d) {
            const double s = std::clamp(d / a, -1.0, 1.0);
            return s < 0.0 ? 0.5 * (1.0 + s) * (1.0 + s) : 1.0 - 0.5 * (1.0 - s) * (1.0 - s);
        };
    } else if (kind == 4) {  // an exponential distribution about its mean
        shape.one_peak = false;
        shape.U = 2.5 * u;
        shape.below = [u](double d) { return d < -u ? 0.0 : -std::expm1(-(d + u) / u); };
    } else if (kind == 5) {
        shape.one_peak = false;
        std::vector<double> trials(999);
        for (double& d : trials) {
            d = u * (random.uniform(-1.0, 1.0) + random.uniform(-1.0, 1.0) + random.uniform(-1.0, 1.0));
        }
        std::sort(trials.begin(), trials.end());
        shape.below = [trials](double d) {
            const auto last = std::upper_bound(trials.begin(), trials.end(), d);
            return static_cast<double>(last - trials.begin()) / static_cast<double>(trials.size());
        };
    }
    return shape;
}
constexpr std::size_t k_shapes = 6;

/// Limits of one kind each time: two, the lower one, the upper one.
ToleranceLimits some_limits(Random& random, std::size_t kind) {
    const double middle = random.uniform(-3.0, 3.0);
    const double half = random.log_uniform(0.2, 2.0);
    ToleranceLimits limits{.lower = middle - half, .upper = middle + half};
    if (kind == 1) {
        limits.upper.reset();
    } else if (kind == 2) {
        limits.lower.reset();
    }
    return limits;
}
double middle_of(const ToleranceLimits& limits) {
    return limits.two_sided() ? 0.5 * (*limits.lower + *limits.upper)
           : limits.lower     ? *limits.lower + 1.0
                              : *limits.upper - 1.0;
}

const int k_times = gumcert::test::cases(1, 2);

/// Calls a law for every rule, kind of limits and shape, many times.
void for_all(std::uint64_t seed, int times,
             const std::function<void(Random&, const Rule&, const ToleranceLimits&, const Shape&)>& law) {
    Random random(seed);
    for (int i = 0; i < times; ++i) {
        for (std::size_t kind = 0; kind < 3; ++kind) {
            const ToleranceLimits limits = some_limits(random, kind);
            for (std::size_t form = 0; form < k_shapes; ++form) {
                const Shape shape = some_shape(random, form);
                for (const Rule& rule : rules_for(random, limits.two_sided(), middle_of(limits))) {
                    if (check_decision_rule(rule.rule, rule.parameters, limits).empty()) {
                        law(random, rule, limits, shape);
                    }
                }
            }
        }
    }
}

std::string named(const Rule& rule, const ToleranceLimits& limits, const Shape& shape, double y) {
    const auto number = [](const std::optional<double>& x) { return x ? std::to_string(*x) : std::string("none"); };
    return decision_rule_id(rule.rule) + " method " + rule.parameters.method + " limits " + number(limits.lower) +
           " to " + number(limits.upper) + " u " + std::to_string(shape.u) + " nu " + std::to_string(shape.nu) + " y " +
           std::to_string(y);
}

/// 0 for pass to 4 for fail; where nothing can be said stands between the two.
int rank(ConformityVerdict verdict) {
    switch (verdict) {
        case ConformityVerdict::pass:
            return 0;
        case ConformityVerdict::conditional_pass:
            return 1;
        case ConformityVerdict::undetermined:
        case ConformityVerdict::not_applicable:
            return 2;
        case ConformityVerdict::conditional_fail:
            return 3;
        case ConformityVerdict::fail:
            return 4;
    }
    return -1;
}

TEST(ConformityProperties, FarOutsideOfTheLimitsEveryRuleFails) {
    std::size_t decided = 0;
    for_all(14253, 4, [&](Random&, const Rule& rule, const ToleranceLimits& limits, const Shape& shape) {
        for (const double far : {1e7, 1e12, 1e100, 1e300}) {
            for (const double y : {limits.upper ? far : k_infinite, limits.lower ? -far : k_infinite}) {
                if (std::isinf(y)) {
                    continue;
                }
                const ConformityDecision decision = decide_conformity(rule.rule, rule.parameters, limits, shape.at(y));
                ASSERT_EQ(decision.verdict, ConformityVerdict::fail)
                    << named(rule, limits, shape, y) << ": " << decision.note;
                ASSERT_LT(decision.conformance_probability, 0.02) << named(rule, limits, shape, y);
                ++decided;
            }
        }
    });
    EXPECT_GT(decided, 5000U);
}

TEST(ConformityProperties, BeyondALimitByMoreThanUNothingIsLeftOpen) {
    // Where the rule rejects what y ± U excludes: all but those with a guard band of another width, a population as
    // prior knowledge, or a probability above that of U.
    for_all(3, 6, [](Random& random, const Rule& rule, const ToleranceLimits& limits, const Shape& shape) {
        const bool other_width =
            rule.parameters.guard_factor || rule.parameters.guard_band || rule.parameters.method == "4" ||
            (rule.rule == DecisionRule::iso_14253_1 && rule.parameters.probability) || shape.nu < 3.0 || shape.below;
        if (other_width) {
            return;
        }
        const double out = shape.U * random.uniform(1.01, 3.0);
        const double y = limits.upper ? *limits.upper + out : *limits.lower - out;
        const ConformityDecision decision = decide_conformity(rule.rule, rule.parameters, limits, shape.at(y));
        EXPECT_EQ(decision.verdict, ConformityVerdict::fail) << named(rule, limits, shape, y) << decision.note;
    });
}

TEST(ConformityProperties, MovingFurtherOutsideNeverImprovesTheVerdict) {
    for_all(106, 2, [](Random& random, const Rule& rule, const ToleranceLimits& limits, const Shape& shape) {
        for (const double direction : {limits.upper ? 1.0 : 0.0, limits.lower ? -1.0 : 0.0}) {
            if (direction == 0.0) {
                continue;
            }
            // From the middle where the dispersion is symmetric with one peak, else from the limit on.
            const double from = shape.one_peak ? middle_of(limits) : direction > 0.0 ? *limits.upper : *limits.lower;
            double y = from;
            int before = 0;
            for (int step = 0; step < gumcert::test::cases(20, 30); ++step) {
                const ConformityVerdict verdict =
                    decide_conformity(rule.rule, rule.parameters, limits, shape.at(y)).verdict;
                ASSERT_GE(rank(verdict), before) << named(rule, limits, shape, y);
                before = rank(verdict);
                y += direction * random.uniform(0.0, 0.7) * std::min(1.0 + std::abs(y - from), 2.0 * shape.u);
            }
        }
    });
}

TEST(ConformityProperties, NoValueThatPassesHasALargerRiskThanOneThatFails) {
    for_all(540, k_times, [](Random& random, const Rule& rule, const ToleranceLimits& limits, const Shape& shape) {
        if (!shape.one_peak && rule.rule != DecisionRule::specific_risk) {
            return;  // guard bands are symmetric, and the risks of a skewed distribution are not
        }
        double passes = 0.0;
        double fails = 1.0;
        const double reach = 2.0 + 2.0 * shape.U;
        for (int i = 0; i < 60; ++i) {
            const double y = middle_of(limits) + random.uniform(-reach, reach);
            const ConformityDecision decision = decide_conformity(rule.rule, rule.parameters, limits, shape.at(y));
            const double risk = 1.0 - decision.conformance_probability;
            if (decision.verdict == ConformityVerdict::pass) {
                passes = std::max(passes, risk);
                ASSERT_NEAR(decision.specific_risk, risk, 1e-12);
            } else if (decision.verdict == ConformityVerdict::fail) {
                fails = std::min(fails, risk);
            }
        }
        ASSERT_LE(passes, fails + 1e-9) << named(rule, limits, shape, 0.0);
    });
}

TEST(ConformityProperties, OnePlaceOneScaleAndOneSideAreAsGoodAsAnother) {
    for_all(8, k_times, [](Random& random, const Rule& rule, const ToleranceLimits& limits, const Shape& shape) {
        const double scale = random.log_uniform(1e-6, 1e6);
        const double shift = random.uniform(-5.0, 5.0);
        const double sign = random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
        const auto place = [&](double x) { return sign * scale * (x + shift); };
        const auto size = [&](std::optional<double>& x) {
            if (x) {
                *x *= scale;
            }
        };
        Rule moved = rule;
        size(moved.parameters.guard_band);
        size(moved.parameters.largest_U);
        size(moved.parameters.population_deviation);
        if (moved.parameters.population_centre) {
            moved.parameters.population_centre = place(*moved.parameters.population_centre);
        }
        ToleranceLimits there;
        (sign > 0.0 ? there.lower : there.upper) = limits.lower ? std::optional(place(*limits.lower)) : std::nullopt;
        (sign > 0.0 ? there.upper : there.lower) = limits.upper ? std::optional(place(*limits.upper)) : std::nullopt;
        Shape other{.u = scale * shape.u, .U = scale * shape.U, .nu = shape.nu};
        if (shape.below) {
            other.below = [&](double d) { return sign > 0.0 ? shape.below(d / scale) : 1.0 - shape.below(-d / scale); };
        }
        for (int i = 0; i < 12; ++i) {
            const double y = middle_of(limits) + random.uniform(-2.0, 2.0) * (1.0 + shape.U);
            const ConformityDecision here = decide_conformity(rule.rule, rule.parameters, limits, shape.at(y));
            const ConformityDecision moved_there =
                decide_conformity(moved.rule, moved.parameters, there, other.at(place(y)));
            ASSERT_EQ(here.verdict, moved_there.verdict) << named(rule, limits, shape, y) << " scale " << scale;
            ASSERT_NEAR(here.conformance_probability, moved_there.conformance_probability, 2e-3);
        }
    });
}

/// An exponential, or two peaks, about y.
std::function<double(double)> skew_distribution(Random& random, double y, double u) {
    if (random.whole(2) == 0) {
        const double side = random.whole(2) == 0 ? 1.0 : -1.0;
        const double blur = u * random.uniform(0.001, 0.3);
        return [=](double x) {
            const double t = side * (x - y) / u + 1.0;
            const double P = t > 0.0 ? 1.0 - std::exp(-t) : 0.0;
            return (1.0 - blur / u) * (side > 0.0 ? P : 1.0 - P) +
                   blur / u * 0.5 * std::erfc(-(x - y) / (blur * std::sqrt(2.0)));
        };
    }
    const double share = random.uniform(0.02, 0.98);
    const double apart = u * random.uniform(0.5, 6.0);
    const double width = u * random.uniform(0.05, 1.0);
    return [=](double x) {
        const auto P = [&](double middle) { return 0.5 * std::erfc(-(x - middle) / (width * std::sqrt(2.0))); };
        return share * P(y - (1.0 - share) * apart) + (1.0 - share) * P(y + share * apart);
    };
}

// What is printed beside a verdict by risk agrees with it: limits in their order, around a value that passes.
TEST(ConformityProperties, LimitsOfAcceptanceEncloseWhatPassesWhateverTheDistribution) {
    Random random(1014);
    int passed = 0, failed = 0;
    for (int i = 0; i < 3000; ++i) {
        const double y = random.uniform(-1.5, 1.5);
        const double u = random.log_uniform(0.01, 1.0);
        const MeasuredValue value{.value = y,
                                  .standard_uncertainty = u,
                                  .expanded_uncertainty = 2.0 * u,
                                  .distribution = skew_distribution(random, y, u)};
        const double risk = random.uniform(0.005, 0.4);
        const bool by_risk = random.whole(2) == 0;
        const ConformityDecision decision =
            by_risk ? decide_conformity(DecisionRule::specific_risk, {.probability = risk},
                                        {.lower = -1.0, .upper = 1.0}, value)
                    : decide_conformity(DecisionRule::iso_14253_1, {.probability = 1.0 - risk},
                                        {.lower = -1.0, .upper = 1.0}, value);
        const ToleranceLimits& accepted = decision.acceptance;
        SCOPED_TRACE(i);
        if (accepted.lower && accepted.upper) {
            ASSERT_LE(*accepted.lower, *accepted.upper);
            const double noise = 1e-9;
            const bool inside = *accepted.lower - noise <= y && y <= *accepted.upper + noise;
            const bool well_inside = *accepted.lower + noise < y && y < *accepted.upper - noise;
            if (decision.verdict == ConformityVerdict::pass) {
                ASSERT_TRUE(inside);
                ++passed;
            } else {
                ASSERT_FALSE(well_inside);
                ++failed;
            }
        } else {
            ASSERT_NE(decision.verdict, ConformityVerdict::pass);
        }
    }
    EXPECT_GT(passed, 300);
    EXPECT_GT(failed, 300);
}

// A limit belongs to the tolerance: what lies exactly on it conforms, at the lower limit as at the upper one.
TEST(ConformityProperties, ValuesOnALimitConform) {
    Random random(98);
    for (int i = 0; i < 200; ++i) {
        std::vector<double> values(1 + random.whole(50));
        for (double& value : values) {
            value = static_cast<double>(random.whole(7));
        }
        const auto share = [&](const std::function<bool(double)>& counts) {
            return static_cast<double>(std::count_if(values.begin(), values.end(), counts)) /
                   static_cast<double>(values.size());
        };
        MeasuredValue y{.value = random.uniform(0.0, 6.0), .standard_uncertainty = 2.0, .expanded_uncertainty = 4.0};
        const auto nearest = [](double x) { return std::round(x * 1e9) * 1e-9; };  // the limit, whatever was rounded
        y.distribution = [=](double x) { return share([=](double v) { return v <= nearest(x); }); };
        y.distribution_below = [=](double x) { return share([=](double v) { return v < nearest(x); }); };
        const auto low = static_cast<double>(random.whole(6));
        const double high = low + 1.0 + static_cast<double>(random.whole(6));
        const double within = share([=](double v) { return v >= low && v <= high; });
        ASSERT_NEAR(conformance_probability(y, {.lower = low, .upper = high}), within, 1e-12);
        ASSERT_NEAR(nonconformance_probability(y, {.lower = low, .upper = high}), 1.0 - within, 1e-12);
        ASSERT_NEAR(conformance_probability(y, {.lower = low}), share([=](double v) { return v >= low; }), 1e-12);
        ASSERT_NEAR(conformance_probability(y, {.upper = high}), share([=](double v) { return v <= high; }), 1e-12);
        const ConformityDecision decision =
            decide_conformity(DecisionRule::simple_acceptance, {}, {.lower = low, .upper = high}, y);
        ASSERT_NEAR(decision.conformance_probability, within, 1e-12);
    }
}

TEST(ConformityProperties, NothingIsLeftOpenWithoutAReason) {
    for_all(13, 2, [](Random& random, const Rule& rule, const ToleranceLimits& limits, const Shape& shape) {
        const double y = middle_of(limits) + random.uniform(-3.0, 3.0) * (1.0 + shape.U);
        const ConformityDecision decision = decide_conformity(rule.rule, rule.parameters, limits, shape.at(y));
        EXPECT_FALSE(decision.formula.empty()) << named(rule, limits, shape, y);
        if (decision.verdict == ConformityVerdict::not_applicable) {
            EXPECT_NE(decision.note.find("cannot be applied: "), std::string::npos) << named(rule, limits, shape, y);
            EXPECT_FALSE(decision.largest_specific_risk);
        }
        const bool somewhere = decision.acceptance.lower || decision.acceptance.upper;
        EXPECT_TRUE(somewhere || decision.guard_band == 0.0);
        EXPECT_TRUE(somewhere || decision.verdict != ConformityVerdict::pass ||
                    decision.rule == DecisionRule::specific_risk || decision.rule == DecisionRule::iso_14253_1);
    });
}

}  // namespace
}  // namespace gumcert::gum
