#include "gum/conformity/conformity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/conformity/posterior_risk.h"
#include "gum/distribution_quantile.h"
#include "gum/quantity/decimal_rounding.h"
#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

constexpr double k_rounding = 16.0 * std::numeric_limits<double>::epsilon();
constexpr double k_noise_of_a_risk = 1e-12;  // relative
constexpr double k_rounded_risk = 1e-6;      // relative: 1 − 0.9999999 is 1e-7
constexpr double k_z540_3_risk = 0.02;       // ANSI/NCSL Z540.3, 5.3
constexpr double k_iso_14253_1_probability = 0.95;
constexpr double k_sure = 3.0;  // standard uncertainties of a count: 0.3 % of sound decisions stay open

/// How the zones of a rule become verdicts.
enum class Zones {
    two,       ///< pass between the acceptance limits, else fail
    three,     ///< fail beyond the rejection limits, undetermined between
    four,      ///< conditional pass inside of the tolerance, conditional fail up to the rejection limits
    by_risk,   ///< pass where the specific risk is not above `largest_risk`, else fail
    by_proof,  ///< as by_risk; fail where p_c is not above it, undetermined between
};

/// One rule on its way to a decision.
class Application {
public:
    Application(DecisionRule rule, const DecisionRuleParameters& parameters, const ToleranceLimits& limits,
                const MeasuredValue& y)
        : rule_(rule),
          p_(parameters),
          limits_(limits),
          y_(y),
          passable_(limits_that_can_be_passed(y, limits)),
          is_bounded_(limits.lower.has_value() != passable_.lower.has_value() ||
                      limits.upper.has_value() != passable_.upper.has_value()),
          population_(stated_population(parameters, limits)) {
        decision_.rule = rule;
        if (limits.two_sided()) {
            half_ = 0.5 * (*limits.upper - *limits.lower);
            decision_.test_uncertainty_ratio = half_ / y.expanded_uncertainty;
        }
    }

    [[nodiscard]] ConformityDecision decide();
    [[nodiscard]] const std::string& reason() const { return reason_; }
    /// Whether the rule can be applied, and some value passes.
    [[nodiscard]] bool applies() const { return reason_.empty(); }

private:
    void set_zones();
    void z540_3();
    void posterior();
    void guard(double w, const std::string& text, const std::string& where = "");
    void guard_by_factor(double r);
    void solve_risk(double risk);
    void prove(double probability);
    bool ratio_holds();
    void cannot(std::string why);
    void probabilities();
    void verdict();
    void global_risks();
    void explain();
    void forget_what_no_trial_tells();

    [[nodiscard]] bool nonconformity_is_proven();
    [[nodiscard]] bool proven_on_one_side(double probability) const;
    void take_as_normal();
    [[nodiscard]] std::optional<ToleranceLimits> posterior_limits_of_normal(double u) const;
    [[nodiscard]] std::optional<ToleranceLimits> posterior_zone(const std::optional<ToleranceLimits>& normal);
    [[nodiscard]] std::optional<ToleranceLimits> without_tails(ToleranceLimits zone,
                                                               const std::optional<ToleranceLimits>& normal,
                                                               double accepted, double low, double high);
    [[nodiscard]] double before_tail(double accepted, double limit) const;
    [[nodiscard]] bool is_known(double risk);
    [[nodiscard]] bool trials_leave_open(double risk) const;
    [[nodiscard]] double width_of_normal(double risk) const;
    [[nodiscard]] bool at_most(double a, double b) const;
    [[nodiscard]] bool inside(const ToleranceLimits& zone) const;
    [[nodiscard]] bool beyond(const ToleranceLimits& zone) const;
    [[nodiscard]] bool some_value_passes() const;
    [[nodiscard]] double risk_of(double value) const;
    [[nodiscard]] std::string in_tolerance() const;

    DecisionRule rule_;
    const DecisionRuleParameters& p_;
    const ToleranceLimits& limits_;
    const MeasuredValue& y_;
    ToleranceLimits passable_;  ///< without one that is a bound of the quantity itself
    bool is_bounded_ = false;   ///< one of the limits is
    std::optional<Population> population_;
    double half_ = 0.0;  // T, two-sided limits only
    Zones zones_ = Zones::two;
    double largest_risk_ = 0.0;  // of by_risk and by_proof
    bool with_prior_ = false;
    MeasuredValue measured_;                  // with_prior_: what is combined with the population
    std::optional<PosteriorRisk> posterior_;  // with_prior_
    bool contradicts_ = false;                // with_prior_: only a tail of the measurement meets the population
    std::string reason_;                      // why the rule cannot be applied, or no value can pass
    ConformityDecision decision_;
};

/// "AL = TL + w, AU = TU − w", the sides that there are.
std::string acceptance_text(const ToleranceLimits& limits, const std::string& guard_band, bool outwards = false) {
    const auto side = [&](const char* name, const char* limit, const char* sign) {
        return std::string(name) + " = " + limit + (guard_band.empty() ? "" : std::string(sign) + guard_band);
    };
    std::string text = limits.lower ? side("AL", "TL", outwards ? " − " : " + ") : "";
    if (limits.upper) {
        text += (text.empty() ? "" : ", ") + side("AU", "TU", outwards ? " + " : " − ");
    }
    return text;
}

void add_sentence(std::string& text, std::string_view sentence) {
    text += (text.empty() ? "" : " ") + std::string(sentence);
}

bool Application::at_most(double a, double b) const {
    // A value that stands on a limit in decimal numbers passes: in binary it may lie a rounding beyond.
    const double scale = std::max({std::abs(y_.value), std::abs(limits_.lower.value_or(0.0)),
                                   std::abs(limits_.upper.value_or(0.0)), std::abs(decision_.guard_band)});
    return is_at_most(a, b, scale);
}

bool Application::inside(const ToleranceLimits& zone) const {
    return (!zone.lower || at_most(*zone.lower, y_.value)) && (!zone.upper || at_most(y_.value, *zone.upper));
}

bool Application::beyond(const ToleranceLimits& zone) const {
    return (zone.lower && !at_most(*zone.lower, y_.value)) || (zone.upper && !at_most(y_.value, *zone.upper));
}

bool Application::some_value_passes() const {
    const ToleranceLimits& a = decision_.acceptance;
    // A zone without width accepts nothing that is measured; whether it has one must not hang on the last bit.
    return (a.lower || a.upper) && (!a.two_sided() || !at_most(*a.upper, *a.lower));
}

std::string Application::in_tolerance() const {
    if (limits_.two_sided()) {
        return "P(TL ≤ Y ≤ TU)";
    }
    return limits_.lower ? "P(Y ≥ TL)" : "P(Y ≤ TU)";
}

void Application::cannot(std::string why) {
    if (reason_.empty()) {
        reason_ = std::move(why);
    }
}

void Application::guard(double w, const std::string& text, const std::string& where) {
    decision_.guard_band = w;
    decision_.acceptance = guarded_limits(limits_, w);
    decision_.formula = acceptance_text(limits_, text) + (where.empty() ? "" : ", " + where);
}

void Application::guard_by_factor(double r) {
    guard(r * y_.expanded_uncertainty, "r·U", "r = " + text::shortest(r));
}

/// Least ratio and largest U, where they are stated.
bool Application::ratio_holds() {
    std::string condition;
    bool holds = true;
    if (p_.test_uncertainty_ratio) {
        condition = "TUR ≥ " + text::shortest(*p_.test_uncertainty_ratio);
        if (*decision_.test_uncertainty_ratio < *p_.test_uncertainty_ratio * (1.0 - k_rounding)) {
            holds = false;
            cannot("the test uncertainty ratio is below the least one of the rule");
        }
    }
    if (p_.largest_U) {
        // Not its number: here it has the unit of the value, and beside the parameters of the rule the one that was agreed.
        condition += condition.empty() ? "U ≤ U_max" : " and U ≤ U_max";
        if (y_.expanded_uncertainty > *p_.largest_U * (1.0 + k_rounding)) {
            holds = false;
            cannot("the expanded uncertainty is above the largest one of the rule");
        }
    }
    if (!condition.empty()) {
        decision_.formula += ", if " + condition;
    }
    return holds;
}

void Application::solve_risk(double risk) {
    largest_risk_ = risk;
    // The guard band is what lies between the tolerance limit and the acceptance limit; where both sides differ,
    // because the distribution is not symmetric, the larger one is stated. Without limits no value has so small a risk.
    if (!passable_.lower && !passable_.upper) {
        decision_.acceptance = limits_;
        return;
    }
    if (!is_known(risk)) {
        return;
    }
    if (auto solved = acceptance_limits_for_risk(y_, passable_, risk)) {
        solved->lower = limits_.lower && !passable_.lower ? limits_.lower : solved->lower;
        solved->upper = limits_.upper && !passable_.upper ? limits_.upper : solved->upper;
        decision_.acceptance = *solved;
        decision_.guard_band =
            std::max(limits_.lower ? *solved->lower - *limits_.lower : -std::numeric_limits<double>::infinity(),
                     limits_.upper ? *limits_.upper - *solved->upper : -std::numeric_limits<double>::infinity());
    }
}

/// Whether the distribution goes so far out that it tells the value with a risk. What a numerical convolution leaves out
/// would make a guard band half as wide as it is.
bool Application::is_known(double risk) {
    if (risk < y_.least_probability * (1.0 - k_rounded_risk)) {
        cannot("the distribution of the measurand is not known for so small a probability of nonconformity");
    }
    return reason_.empty();
}

void Application::prove(double probability) {
    zones_ = Zones::by_proof;
    solve_risk(1.0 - probability);
    if (reason_.empty()) {
        decision_.rejection = rejection_limits_for_probability(y_, limits_, probability);
    }
    decision_.formula = "pass: " + in_tolerance() + " ≥ p; fail: " + in_tolerance() +
                        " ≤ 1 − p; else undetermined; p = " + text::shortest(probability);
}

/// The standard deviation of a normal distribution whose quantiles for a risk are as far out as the farther one of the
/// measurement; at least u.
double Application::width_of_normal(double risk) const {
    constexpr double k_largest_risk = 0.3;  // beyond it a quantile says little of the width
    if (risk >= k_largest_risk) {
        return y_.standard_uncertainty;
    }
    MeasuredValue about_zero = y_;  // a value that is large against u would cost the digits of the quantile
    about_zero.value = 0.0;
    if (y_.distribution) {
        about_zero.distribution = [this](double x) { return y_.distribution(y_.value + x); };
    }
    // What one limit alone keeps off a tolerance limit is the quantile.
    const double above = -*acceptance_limits_for_risk(about_zero, {.upper = 0.0}, risk)->upper;
    const double below = *acceptance_limits_for_risk(about_zero, {.lower = 0.0}, risk)->lower;
    const double width = std::max(above, below) / upper_quantile(Distribution::normal(0.0, 1.0), risk);
    constexpr double k_widest = 1e6;  // [u]: the digits of the value are spent
    return width < k_widest * y_.standard_uncertainty ? std::max(y_.standard_uncertainty, width)
                                                      : y_.standard_uncertainty;
}

/// DR-09, method 4: the specific risk of this value, with the population as prior.
void Application::posterior() {
    with_prior_ = true;
    zones_ = Zones::by_risk;
    largest_risk_ = p_.probability.value_or(k_z540_3_risk);
    decision_.formula =
        "pass: 1 − " + in_tolerance() + " ≤ R with the population as prior; R = " + text::shortest(largest_risk_);
    if (!is_known(largest_risk_)) {
        with_prior_ = false;
        return;
    }
    measured_ = y_;
    if (std::isfinite(y_.degrees_of_freedom) || has_long_tails(y_)) {
        // Tails that fall off more slowly than those of the population let it speak for any value far outside of the
        // limits. The normal distribution that is as wide at the risk of the rule does not.
        take_as_normal();
    } else {
        posterior_.emplace(measured_, limits_, *population_);
    }
    std::optional<ToleranceLimits> solved = posterior_limits_of_normal(
        measured_.distribution ? width_of_normal(largest_risk_) : measured_.standard_uncertainty);
    if (measured_.distribution) {
        solved = posterior_zone(solved);
        if (contradicts_ || posterior_->rests_on_tail(y_.value)) {
            // What a tail says of both together is no knowledge: the measurement is left, and judges as without a rule
            // that applies.
            with_prior_ = false;
            decision_.note.clear();
            cannot(
                "population and measurement contradict each other, and probabilities are those of the measurement "
                "alone");
        }
    }
    if (solved) {
        decision_.acceptance = *solved;
        decision_.guard_band =
            std::max(limits_.lower ? *solved->lower - *limits_.lower : -std::numeric_limits<double>::infinity(),
                     limits_.upper ? *limits_.upper - *solved->upper : -std::numeric_limits<double>::infinity());
    }
}

void Application::take_as_normal() {
    measured_ = {.value = y_.value,
                 .standard_uncertainty = width_of_normal(largest_risk_),
                 .expanded_uncertainty = y_.expanded_uncertainty};
    add_sentence(decision_.note,
                 "The measurement is taken as normally distributed, as wide as its own distribution at the risk of the "
                 "rule.");
    posterior_.emplace(measured_, limits_, *population_);
}

/// Limits of the values that a normal measurement with u may show. Prior and normal measurement give a normal
/// distribution whose value is a weighted mean: its limits, taken back to values that a measurement shows.
std::optional<ToleranceLimits> Application::posterior_limits_of_normal(double u) const {
    const double s0 = population_->deviation;
    const double weight = s0 * s0 / (s0 * s0 + u * u);
    const MeasuredValue after{.value = population_->centre + weight * (y_.value - population_->centre),
                              .standard_uncertainty = u * std::sqrt(weight),
                              .expanded_uncertainty = y_.expanded_uncertainty * std::sqrt(weight)};
    std::optional<ToleranceLimits> solved = acceptance_limits_for_risk(after, limits_, largest_risk_);
    if (solved) {
        for (std::optional<double>* limit : {&solved->lower, &solved->upper}) {
            if (*limit) {
                **limit = population_->centre + (**limit - population_->centre) / weight;
            }
        }
    }
    return solved;
}

/// The farthest value towards a limit for which no tail decides.
double Application::before_tail(double accepted, double limit) const {
    constexpr int k_bisections = 60;
    if (!posterior_->rests_on_tail(limit)) {
        return limit;
    }
    for (int i = 0; i < k_bisections; ++i) {
        const double middle = 0.5 * (accepted + limit);
        if (middle == accepted || middle == limit) {
            break;  // every further step would ask the same
        }
        (posterior_->rests_on_tail(middle) ? limit : accepted) = middle;
    }
    return accepted;
}

/// Accepted values as far as the measurement tells. On the long side of a skewed distribution only its farthest tail
/// may set a limit, or none at all: then it lies where that tail begins, or where a normal distribution as wide at the
/// risk of the rule has it, whichever is nearer.
/// \param normal     limits of that distribution
/// \param accepted   a value that no tail decides
/// \param low, high  where the search ended
std::optional<ToleranceLimits> Application::without_tails(ToleranceLimits zone,
                                                          const std::optional<ToleranceLimits>& normal, double accepted,
                                                          double low, double high) {
    const bool open_below = zone.lower && (*zone.lower <= low || posterior_->rests_on_tail(*zone.lower));
    const bool open_above = zone.upper && (*zone.upper >= high || posterior_->rests_on_tail(*zone.upper));
    if (!open_below && !open_above) {
        return zone;
    }
    if (!normal) {
        return std::nullopt;
    }
    if (open_below) {
        zone.lower = std::max(before_tail(accepted, *zone.lower), *normal->lower);
        contradicts_ = contradicts_ || y_.value < *zone.lower;
    }
    if (open_above) {
        zone.upper = std::min(before_tail(accepted, *zone.upper), *normal->upper);
        contradicts_ = contradicts_ || y_.value > *zone.upper;
    }
    add_sentence(decision_.note,
                 "An acceptance limit that only the farthest tail of the measurement would set lies where that tail "
                 "begins, or where a normal distribution as wide at the risk of the rule has it.");
    return zone;
}

/// DR-09, method 4, of a measurement that is not normal: the accepted values around y, or around the best one.
/// \param normal  limits of a normal measurement that is as wide at the risk
std::optional<ToleranceLimits> Application::posterior_zone(const std::optional<ToleranceLimits>& normal) {
    const double u = y_.standard_uncertainty;
    const double low = std::min(limits_.lower.value_or(*limits_.upper - 8.0 * u),
                                normal && normal->lower ? *normal->lower : std::numeric_limits<double>::infinity()) -
                       4.0 * u;
    const double high = std::max(limits_.upper.value_or(*limits_.lower + 8.0 * u),
                                 normal && normal->upper ? *normal->upper : -std::numeric_limits<double>::infinity()) +
                        4.0 * u;
    double best = y_.value;
    double least = posterior_->rests_on_tail(best) ? 1.0 : risk_of(best);
    constexpr int k_tried = 32;
    for (int i = 0; least > largest_risk_ && i <= k_tried; ++i) {
        const double s = low + (high - low) * i / k_tried;
        if (const double risk = risk_of(s); risk < least && !posterior_->rests_on_tail(s)) {
            least = risk;
            best = s;
        }
    }
    if (least > largest_risk_) {
        return std::nullopt;
    }
    ToleranceLimits zone =
        accepted_around([&](double s) { return risk_of(s); }, largest_risk_, best, low, high, y_.value);
    zone.lower = limits_.lower ? zone.lower : std::nullopt;
    zone.upper = limits_.upper ? zone.upper : std::nullopt;
    return without_tails(zone, normal, best, low, high);
}

void Application::z540_3() {
    const double U = y_.expanded_uncertainty;
    const std::string& method = p_.method;
    if (method.empty()) {
        guard(0.0, "");
        (void)ratio_holds();
    } else if (method == "4") {
        posterior();
    } else if (method == "5") {
        guard(U, "U");
    } else if (method == "6") {
        // Guard band managed by the ratio (Dobbert): it keeps 2 % for any population.
        const double ratio = *decision_.test_uncertainty_ratio;
        const double multiple = std::max(0.0, 1.04 - std::exp(0.38 * std::log(ratio) - 0.54));
        guard(multiple * U, "M·U", "M = 1.04 − exp(0.38·ln TUR − 0.54), not below 0");
    } else if (method == "rds") {
        const double square = 1.0 - (U / half_) * (U / half_);
        decision_.formula = acceptance_text(limits_, "w") + ", w = T − √(T² − U²), T = (TU − TL)/2";
        if (square < -k_rounding) {
            cannot("U is larger than half of the tolerance");
        } else {
            const std::string formula = decision_.formula;
            guard(half_ * (1.0 - std::sqrt(std::max(0.0, square))), "w");
            decision_.formula = formula;
        }
    } else if (method == "rp10") {
        // From a ratio of 4 on the formula would put the acceptance limits outside of the tolerance: no guard band
        // then.
        const double factor = std::min(1.0, 1.25 - 1.0 / *decision_.test_uncertainty_ratio);
        guard(half_ * (1.0 - factor), "w", "w = T·(1/TUR − 0.25), not below 0, T = (TU − TL)/2");
    } else {
        const bool conditional = method == "3";
        const double risk = p_.probability.value_or(k_z540_3_risk);
        const auto w =
            guard_band_for_global_risk(limits_, population_->centre, population_->deviation, y_.standard_uncertainty,
                                       risk, conditional ? FalseAccept::conditional : FalseAccept::unconditional);
        const std::string text = std::string("w ≥ 0 the smallest with ") +
                                 (conditional ? "conditional PFA ≤ " : "global PFA ≤ ") + text::shortest(risk);
        if (w) {
            guard(*w, "w", text);
        } else {
            decision_.formula = acceptance_text(limits_, "w") + ", " + text;
            cannot("no guard band brings the false accept probability of this population down to the limit");
        }
    }
}

void Application::set_zones() {
    const double U = y_.expanded_uncertainty;
    switch (rule_) {
        case DecisionRule::simple_acceptance:
        case DecisionRule::prescribed:
            guard(0.0, "");
            return;
        case DecisionRule::simple_acceptance_with_ratio:
            guard(0.0, "");
            (void)ratio_holds();
            return;
        case DecisionRule::guard_band_u:
            guard(U, "U");
            return;
        case DecisionRule::guard_band_factor:
            guard_by_factor(*p_.guard_factor);
            return;
        case DecisionRule::non_binary: {
            zones_ = Zones::four;
            const double w = p_.guard_band ? *p_.guard_band : p_.guard_factor.value_or(1.0) * U;
            guard(w, "w");
            decision_.rejection = guarded_limits(limits_, -w);
            decision_.formula = "pass: " + acceptance_text(limits_, "w") + "; conditional pass: up to the limit; " +
                                "conditional fail: up to w beyond the limit; " +
                                (p_.guard_factor ? "w = r·U, r = " + text::shortest(*p_.guard_factor)
                                                 : std::string(p_.guard_band ? "w as agreed" : "w = U"));
            return;
        }
        case DecisionRule::three_way:
            zones_ = Zones::three;
            guard(U, "U");
            decision_.rejection = guarded_limits(limits_, -U);
            decision_.formula = "pass: y ± U inside of the limits; fail: y ± U outside; else undetermined";
            return;
        case DecisionRule::specific_risk:
            zones_ = Zones::by_risk;
            solve_risk(*p_.probability);
            decision_.formula = "pass: 1 − " + in_tolerance() + " ≤ R, R = " + text::shortest(*p_.probability);
            return;
        case DecisionRule::iso_14253_1:
            if (p_.guard_factor) {
                zones_ = Zones::three;
                guard_by_factor(*p_.guard_factor);
                decision_.rejection = guarded_limits(limits_, -decision_.guard_band);
                decision_.formula += "; fail: beyond r·U outside of the limits; else undetermined";
                return;
            }
            prove(p_.probability.value_or(k_iso_14253_1_probability));
            return;
        case DecisionRule::z540_3:
            z540_3();
            return;
        case DecisionRule::b89_7_3_1:
            if (p_.guard_factor) {
                guard_by_factor(*p_.guard_factor);
            } else {
                guard(0.0, "");
            }
            (void)ratio_holds();
            return;
        case DecisionRule::relaxed:
            guard(-U, "");
            decision_.formula = acceptance_text(limits_, "U", true);
            return;
        case DecisionRule::agreed:
            if (p_.guard_factor) {
                guard_by_factor(*p_.guard_factor);
            } else {
                guard(*p_.guard_band, "w", "w as agreed");
            }
            return;
    }
}

double Application::risk_of(double value) const {
    return with_prior_ ? posterior_->at(value).both() : nonconformance_probability_at(value, y_, limits_);
}

void Application::probabilities() {
    decision_.conformance_probability =
        with_prior_ ? 1.0 - risk_of(y_.value) : gum::conformance_probability(y_, limits_);
    if (!applies()) {
        return;
    }
    if (is_bounded_ && !with_prior_) {
        // At a limit of acceptance the distribution would have another shape, which nobody knows.
        if (zones_ == Zones::by_risk || zones_ == Zones::by_proof) {
            decision_.largest_specific_risk = largest_risk_;
        }
        return;
    }
    double largest = 0.0;
    for (const std::optional<double>& limit : {decision_.acceptance.lower, decision_.acceptance.upper}) {
        if (limit) {
            largest = std::max(largest, risk_of(*limit));
        }
    }
    decision_.largest_specific_risk = largest;
}

/// Whether the item lies beyond one of the limits with a probability. Both tails together say nothing where the
/// tolerance is narrow: each value has a small probability of conformity then, also the best one.
bool Application::proven_on_one_side(double probability) const {
    const double least = probability * (1.0 - k_noise_of_a_risk);
    if (with_prior_) {
        const OutsideProbabilities outside = posterior_->at(y_.value);
        return outside.below >= least || outside.above >= least;
    }
    return (limits_.lower && probability_below(y_, *limits_.lower) >= least) ||
           (limits_.upper && 1.0 - distribution_function(y_, *limits_.upper) >= least);
}

/// Whether a risk that is counted lies so near to the one of the rule that other trials could decide otherwise.
bool Application::trials_leave_open(double risk) const {
    if (!(y_.trials > 0.0)) {
        return false;
    }
    const double scatter = k_sure * std::sqrt(largest_risk_ * (1.0 - largest_risk_) / y_.trials);
    return std::abs(risk - largest_risk_) < scatter ||
           (zones_ == Zones::by_proof && std::abs(risk - (1.0 - largest_risk_)) < scatter);
}

/// Whether a value fails although none can pass, or the rule cannot be applied: nonconformity needs no zone of
/// conformity (ISO 14253-1). Rules with zones of rejection or a probability to prove have their own; with any other one
/// y ± U lies outside of the tolerance.
bool Application::nonconformity_is_proven() {
    if (largest_risk_ > 0.0 && largest_risk_ < y_.least_probability * (1.0 - k_rounded_risk)) {
        return zones_ == Zones::by_risk && beyond(guarded_limits(limits_, -y_.expanded_uncertainty));
    }
    if (zones_ == Zones::by_proof || with_prior_) {
        return proven_on_one_side(1.0 - largest_risk_);
    }
    if (!decision_.rejection.lower && !decision_.rejection.upper) {
        decision_.rejection = guarded_limits(limits_, -y_.expanded_uncertainty);
    }
    return beyond(decision_.rejection);
}

void Application::verdict() {
    using enum ConformityVerdict;
    const bool by_risk = zones_ == Zones::by_risk || zones_ == Zones::by_proof;
    const double risk = risk_of(y_.value);
    // By the risk itself and not by solved acceptance limits: those carry the error of a search, and a value near them
    // would get a verdict that the printed risk contradicts.
    const bool passes = by_risk ? risk <= largest_risk_ * (1.0 + k_noise_of_a_risk) : inside(decision_.acceptance);
    if (!reason_.empty()) {
        decision_.acceptance = {};
        decision_.guard_band = 0.0;
    } else if (!some_value_passes() && !(by_risk && passes && decision_.acceptance.two_sided())) {
        // By risk, y that keeps to it is itself what is accepted.
        decision_.accepts_nothing = true;
        const ToleranceLimits& a = decision_.acceptance;
        // A distribution of several peaks may exceed the risk of the rule wherever it lies, though U is small.
        const bool U_fits = limits_.two_sided() && 2.0 * y_.expanded_uncertainty < *limits_.upper - *limits_.lower;
        cannot(p_.guard_band ? (a.two_sided() && at_most(*a.lower, *a.upper)
                                    ? "no value can pass, because the guard band is half of the tolerance"
                                    : "no value can pass, because the guard band is larger than half of the tolerance")
               : by_risk && U_fits
                   ? "no value can pass, because the probability of nonconformity is above R for each of them"
                   : "no value can pass, because U is too large against the tolerance");
    }
    if (!applies()) {
        decision_.verdict = nonconformity_is_proven() ? fail : not_applicable;
    } else if (by_risk && trials_leave_open(risk)) {
        // A verdict must not depend on the seed of the trials.
        decision_.verdict = zones_ == Zones::by_proof ? undetermined : not_applicable;
        add_sentence(
            decision_.note,
            "The Monte Carlo trials do not decide: the probability is as near to that of the rule as their number "
            "lets it scatter. More trials may decide.");
    } else if (passes) {
        decision_.verdict = pass;
    } else if (zones_ == Zones::two || zones_ == Zones::by_risk) {
        decision_.verdict = fail;
    } else if (zones_ == Zones::by_proof) {
        decision_.verdict = risk >= (1.0 - largest_risk_) * (1.0 - k_noise_of_a_risk) ? fail : undetermined;
    } else if (beyond(decision_.rejection)) {
        decision_.verdict = fail;
    } else if (zones_ == Zones::three) {
        decision_.verdict = undetermined;
    } else {
        decision_.verdict = inside(limits_) ? conditional_pass : conditional_fail;
    }
}

void Application::global_risks() {
    if (!applies()) {
        return;
    }
    if (population_) {
        const GlobalRisk risk = global_risk(limits_, decision_.acceptance, population_->centre, population_->deviation,
                                            y_.standard_uncertainty);
        decision_.false_accept = risk.false_accept;
        decision_.false_reject = risk.false_reject;
    } else if (rule_ == DecisionRule::z540_3 && limits_.two_sided()) {
        decision_.false_accept = largest_false_accept(limits_, decision_.acceptance, y_.standard_uncertainty);
        add_sentence(decision_.note,
                     "The global probability of false acceptance is the largest one of all normal populations that are "
                     "centred between the limits.");
    }
    const bool normal = !y_.distribution && std::isinf(y_.degrees_of_freedom);
    if (decision_.false_accept && !normal) {
        add_sentence(decision_.note, "The global risk takes the measurement as normally distributed with u.");
    }
}

/// Why nothing can pass, and why a value fails all the same.
void Application::explain() {
    if (applies()) {
        return;
    }
    const bool fails = decision_.verdict == ConformityVerdict::fail;
    add_sentence(decision_.note, decision_rule_id(rule_) +
                                     (fails ? " accepts no value here: " : " cannot be applied: ") + reason_ + ".");
    if (fails) {
        const bool by_U = zones_ == Zones::two || (zones_ == Zones::by_risk && !with_prior_);
        add_sentence(decision_.note, by_U ? "Nonconformity is proven all the same: y ± U lies outside of the limits."
                                          : "Nonconformity is proven all the same: the value lies where the rule "
                                            "rejects.");
    }
}

/// Of a risk of which hardly a trial is expected, the limits of acceptance would be the outermost trials.
void Application::forget_what_no_trial_tells() {
    const bool by_risk = zones_ == Zones::by_risk || zones_ == Zones::by_proof;
    if (by_risk && y_.trials > 0.0 && largest_risk_ * y_.trials < k_sure * k_sure) {
        decision_.acceptance = {};
        decision_.guard_band = 0.0;
        decision_.largest_specific_risk.reset();
    }
}

ConformityDecision Application::decide() {
    set_zones();
    verdict();
    probabilities();
    // The specific risk is that of the decision that was taken: of a wrong rejection p_c, of a wrong acceptance 1 −
    // p_c.
    const bool rejected =
        decision_.verdict == ConformityVerdict::fail || decision_.verdict == ConformityVerdict::conditional_fail;
    decision_.specific_risk = rejected ? decision_.conformance_probability : risk_of(y_.value);
    global_risks();
    explain();
    forget_what_no_trial_tells();
    return decision_;
}

}  // namespace

std::string verdict_name(ConformityVerdict verdict) {
    switch (verdict) {
        case ConformityVerdict::pass:
            return "pass";
        case ConformityVerdict::fail:
            return "fail";
        case ConformityVerdict::conditional_pass:
            return "conditional_pass";
        case ConformityVerdict::conditional_fail:
            return "conditional_fail";
        case ConformityVerdict::undetermined:
            return "undetermined";
        case ConformityVerdict::not_applicable:
            return "not_applicable";
    }
    return "not_applicable";
}

ConformityDecision decide_conformity(DecisionRule rule, const DecisionRuleParameters& parameters,
                                     const ToleranceLimits& limits, const MeasuredValue& y) {
    require_limits(limits);
    require_measured_value(y);
    std::vector<Diagnostic> faults;
    for (const std::string& sentence : check_decision_rule(rule, parameters, limits)) {
        faults.push_back({.code = "GC-GUM-0082",
                          .where = "decision rule " + decision_rule_id(rule),
                          .what = sentence,
                          .rule = "a rule is applied with the parameters that it has, and with no others",
                          .action = "Correct the decision rule of the specification."});
    }
    if (!faults.empty()) {
        throw InputError(std::move(faults));
    }
    Application application(rule, parameters, limits, y);
    ConformityDecision decision = application.decide();
    if (application.applies() || !parameters.alternative) {
        return decision;
    }
    const DecisionRuleParameters others = parameters_of_alternative(parameters);
    ConformityDecision other = Application(*parameters.alternative, others, limits, y).decide();
    // What was agreed for this case decides, also where nonconformity is proven without it.
    std::string note = decision_rule_id(rule) + " cannot be applied: " + application.reason() +
                       ". The agreed alternative " + decision_rule_id(other.rule) + " takes its place.";
    if (!other.note.empty()) {
        note += " " + other.note;
    }
    other.note = std::move(note);
    return other;
}

std::string decision_formula(DecisionRule rule, const DecisionRuleParameters& parameters,
                             const ToleranceLimits& limits) {
    if (!check_decision_rule(rule, parameters, limits).empty()) {
        return {};
    }
    // Any value has the same formula.
    const double U = limits.two_sided() ? 0.25 * (*limits.upper - *limits.lower) : 1.0;
    const MeasuredValue any{.value = limits.lower ? *limits.lower : *limits.upper,
                            .standard_uncertainty = 0.5 * U,
                            .expanded_uncertainty = U};
    return Application(rule, parameters, limits, any).decide().formula;
}

}  // namespace gumcert::gum
