#include "audit/tables/claims_of_table.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "audit/claims.h"
#include "audit/tables/parts_of_value.h"
#include "audit/words/coverage_words.h"
#include "audit/words/stated_rule.h"
#include "audit/words/unit_words.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

std::string verdict_in_our_words(const std::string& verdict) {
    const std::string lower = text::in_small_letters(verdict);
    const auto is_one_of = [&lower](std::initializer_list<std::string_view> words) {
        return std::find(words.begin(), words.end(), lower) != words.end();
    };
    if (is_one_of({"pass", "passed", "conform", "conforms", "in tolerance", "ok", "erfüllt", "bestanden", "konform"})) {
        return "pass";
    }
    if (is_one_of({"fail", "failed", "does not conform", "out of tolerance", "nicht erfüllt", "nicht konform"})) {
        return "fail";
    }
    return verdict;
}

std::string words_of(const Statements& statements, Statement statement) {
    const auto found = statements.words.find(statement);
    return found == statements.words.end() ? "" : found->second;
}

/// Takes k and p out of the words beside U, where no line of their own states them.
void state_coverage_words(Claims& claims, const Statements& statements, std::vector<Sentence>& not_read) {
    claims.coverage_sentence = statements.coverage;
    const CoverageText words = coverage_in(statements.coverage);
    if (!words.k.empty()) {
        std::optional<LeadingNumber> k = read_leading_number(words.k, statements.coverage_place, Percent::unit);
        if (k && claims.k && !claims.k->interval().meets(k->number.interval())) {
            not_read.push_back(say("{cell}: {text} beside U, and k = {k:number} in {other}; which one holds?",
                                   statements.coverage_place, text::in_quotes(statements.coverage),
                                   text_of_claim(*claims.k), claims.k->place));
        }
        if (k && !claims.k) {
            claims.k = std::move(k->number);
        }
    }
    if (words.p && !claims.coverage_probability) {
        claims.coverage_probability = words.p;
    }
}

/// The numbers of statements, in the unit of the result.
class ResultNumbers {
public:
    /// \param of_contributions  the unit that contributions state
    /// \param of_rows           that of all rows that are added as they are
    ResultNumbers(const Statements& statements, const std::string& of_contributions, const std::string& of_rows,
                  std::vector<Sentence>& not_read)
        : statements_(statements), not_read_(not_read) {
        const std::string of_value = own(Statement::value);
        // U in percent below rows and u_c in volts is a part of the value: the budget is in volts.
        // So is u_c in percent.
        const std::string& of_added = of_contributions.empty() ? of_rows : of_contributions;
        const std::string of_u_c = is_part_beside(own(Statement::u_c), of_added) ? "" : own(Statement::u_c);
        for (const std::string& unit : {of_u_c, of_contributions, of_rows}) {
            of_sum_ = of_sum_.empty() ? unit : of_sum_;
        }
        if (!statements.unit_of_parts.empty()) {  // and U in volts below rows in percent is their U times the value
            of_sum_.clear();
            for (const Statement statement : {Statement::reported_U, Statement::U, Statement::u_c}) {
                const std::string unit = own(statement);
                unit_ = unit_.empty() && is_unit_of_part(unit) ? unit : unit_;
            }
            unit_ = of_sum_ = unit_.empty() ? statements.unit_of_parts : unit_;
            return;
        }
        for (const std::string& unit :
             {own(Statement::reported_U), own(Statement::U), own(Statement::u_c), of_contributions, of_value,
              own(Statement::capability), own(Statement::lower_limit), own(Statement::upper_limit),
              own(Statement::tolerance), own(Statement::reference_value), of_rows}) {
            unit_ = unit_.empty() ? unit : unit_;
        }
        unit_ = shared_unit(unit_, of_value);
        const std::optional<double> factor = factor_between(of_value, unit_);
        has_two_units_ = !of_value.empty() && factor != 1.0;
    }

    [[nodiscard]] const std::string& unit() const { return unit_; }
    /// Nothing where the statement is not there, or its unit cannot be turned into that of the result; then it is said.
    [[nodiscard]] std::optional<StatedNumber> number(Statement statement) {
        const auto found = statements_.numbers.find(statement);
        if (found == statements_.numbers.end()) {
            return std::nullopt;
        }
        StatedNumber number = found->second.number;
        if (!is_of_result(statement)) {
            return number;
        }
        const std::string& from = found->second.unit;
        const bool is_uncertainty = statement == Statement::U || statement == Statement::reported_U ||
                                    statement == Statement::u_c || statement == Statement::value;
        if (from.empty() && has_two_units_ && !is_uncertainty && number.value != 0.0) {
            not_read_.push_back(
                say("{cell}: no unit is stated, and value and U are in {value} and {unit}; the number is not "
                    "used; in which unit is it?",
                    number.place, text::in_quotes(own(Statement::value)), text::in_quotes(unit_)));
            return std::nullopt;
        }
        const std::optional<double> factor = factor_between(from, unit_);
        const bool is_of_whole = !statements_.unit_of_parts.empty() && is_part_beside(unit_, from);
        const bool may_be_held = may_be_part(statement) && statement != Statement::capability && has_parts_of_value();
        if (!factor && ((is_of_whole && statement == Statement::value) ||
                        (may_be_held && (is_of_whole || is_part_beside(from, unit_))))) {
            return std::nullopt;  // take_parts_of_value() looks at it
        }
        if (!factor) {
            not_read_.push_back(
                say("{cell}: a number in {from} beside a result in {to}; it is not used, as one unit cannot "
                    "be turned into the other",
                    number.place, text::in_quotes(from), text::in_quotes(unit_)));
            return std::nullopt;
        }
        if (*factor != 1.0 && statement != Statement::value) {
            number.half_step = printed_half_step(number);
        }
        convert(number, *factor);
        return number;
    }
    [[nodiscard]] std::optional<double> value(Statement statement) {
        const std::optional<StatedNumber> stated = number(statement);
        return stated ? std::optional(stated->value) : std::nullopt;
    }

private:
    [[nodiscard]] const std::string& value_unit() const {
        static const std::string none;
        const auto value = statements_.numbers.find(Statement::value);
        return value == statements_.numbers.end() ? none : value->second.unit;
    }
    [[nodiscard]] bool has_parts_of_value() const {
        const auto value = statements_.numbers.find(Statement::value);
        const std::string& of = statements_.unit_of_parts.empty() ? unit_ : value_unit();
        return value != statements_.numbers.end() && factor_between(value->second.unit, of) &&
               has_parts(value->second.number, of);
    }
    /// The unit of a statement; "" where it has none, or is a part of a result whose rows are added in a unit.
    [[nodiscard]] std::string own(Statement statement) const {
        const auto found = statements_.numbers.find(statement);
        const std::string unit = found == statements_.numbers.end() ? "" : found->second.unit;
        return may_be_part(statement) && is_part_beside(unit, of_sum_) ? "" : unit;
    }

    std::string of_sum_;  ///< unit in which rows are added
    const Statements& statements_;
    std::vector<Sentence>& not_read_;
    std::string unit_;
    bool has_two_units_ = false;  ///< the value is in another unit than its uncertainty
};

void state_limits(AuditedBudget& budget, const Statements& statements, ResultNumbers& numbers,
                  std::vector<Sentence>& not_read) {
    budget.limits.lower = numbers.value(Statement::lower_limit);
    budget.limits.upper = numbers.value(Statement::upper_limit);
    const std::optional<double> tolerance = numbers.value(Statement::tolerance);
    const std::optional<double> nominal = numbers.value(Statement::nominal);
    // A nominal value that could not be read is not 0.
    const bool has_nominal = nominal || !statements.numbers.contains(Statement::nominal);
    if (tolerance && has_nominal && !budget.limits.lower && !budget.limits.upper) {
        budget.limits.lower = nominal.value_or(0.0) - std::abs(*tolerance);
        budget.limits.upper = nominal.value_or(0.0) + std::abs(*tolerance);
    }
    const std::string rule = words_of(statements, Statement::decision_rule);
    if (const std::optional<StatedRule> stated = stated_rule(rule)) {
        budget.rule = stated->rule;
        budget.rule_parameters = stated->parameters;
    } else if (!rule.empty()) {
        budget.rule_not_known = rule;
        not_read.push_back(
            say("the decision rule {text} is not known; nothing is decided by it; which one of DR-01 to "
                "DR-13 is it?",
                text::in_quotes(rule)));
    }
}

}  // namespace

void state_coverage(AuditedBudget& budget) {
    const Claims& claims = budget.claims;
    if (claims.coverage_probability) {
        budget.coverage.probability = *claims.coverage_probability;
    }
    std::optional<double> k;
    if (claims.k) {
        k = claims.k->value;
    } else if (claims.U && claims.u_c && claims.u_c->value > 0.0) {
        k = claims.U->value / claims.u_c->value;
    }
    if (!k || !(*k > 0.0)) {
        return;
    }
    budget.coverage.k = *k;
    budget.coverage.kind = CoverageRule::Kind::fixed;
}

void state_claims(AuditedBudget& budget, const Statements& statements, const std::string& of_contributions,
                  const std::string& of_rows, std::vector<Sentence>& not_read) {
    ResultNumbers numbers(statements, of_contributions, of_rows, not_read);
    Claims& claims = budget.claims;
    claims.value = numbers.number(Statement::value);
    claims.u_c = numbers.number(Statement::u_c);
    claims.nu_eff = numbers.number(Statement::nu_eff);
    claims.k = numbers.number(Statement::k);
    claims.U = numbers.number(Statement::reported_U);
    if (!claims.U) {
        claims.U = numbers.number(Statement::U);
    }
    claims.coverage_probability = numbers.value(Statement::coverage_probability);
    if (claims.coverage_probability && *claims.coverage_probability > 1.0) {
        *claims.coverage_probability /= 100.0;  // "95" and "95 %"
    }
    state_coverage_words(claims, statements, not_read);
    claims.verdict = verdict_in_our_words(words_of(statements, Statement::verdict));
    claims.en = numbers.number(Statement::en);
    budget.value = claims.value ? std::optional(claims.value->value) : std::nullopt;
    budget.unit = numbers.unit();
    budget.equation = words_of(statements, Statement::equation);
    budget.method = words_of(statements, Statement::method);
    budget.capability = numbers.value(Statement::capability);
    if (budget.capability && claims.U) {
        budget.floor_applied = claims.U->value + claims.U->half_step >= *budget.capability;
    }
    const std::optional<double> reference = numbers.value(Statement::reference_value);
    const std::optional<double> reference_U = numbers.value(Statement::reference_U);
    if (reference && reference_U) {
        budget.reference =
            ComparedReference{.value = *reference, .expanded_uncertainty = *reference_U, .name = "reference value"};
    }
    state_limits(budget, statements, numbers, not_read);
    if (const std::string measurand = words_of(statements, Statement::measurand); !measurand.empty()) {
        budget.name = measurand;
    }
}

}  // namespace gumcert::audit
