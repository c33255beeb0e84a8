#include "audit/tables/parts_of_value.h"

#include <cmath>
#include <optional>
#include <string>

#include "audit/claims.h"
#include "audit/words/unit_words.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

/// A number in the unit of the budget, with what the digits of it and of the value leave open: a part of the value times it, or, where
/// the budget is one of parts, a number in the unit of the value over it.
StatedNumber in_unit_of_rows(const StatedResult& stated, const StatedResult& value, const std::string& unit) {
    StatedNumber number = stated.number;
    const double size = std::abs(value.number.value), open = value.number.half_step / size;
    number.half_step = printed_half_step(number);
    if (const std::optional<double> whole = factor_between(stated.unit, value.unit);
        whole && !is_unit_of_part(stated.unit)) {
        convert(number, *whole / size / known_unit(unit)->difference_to_si(1.0));
    } else {
        convert(number,
                known_unit(stated.unit)->difference_to_si(1.0) * size * factor_between(value.unit, unit).value_or(1.0));
    }
    number.half_step += std::abs(number.value) * open;
    return number;
}

/// Rounded, or rounded up (JCGM 100:2008, 7.2.6), by itself or after it was divided by the value.
Interval left_open(const StatedNumber& number, double k) {
    return {(number.value - 2.0 * number.half_step) / k, (number.value + 2.0 * number.half_step) / k};
}

std::string in_unit(double number, const std::string& unit) {
    constexpr int k_digits = 3;
    return text::significant(number, k_digits) + (unit.empty() ? "" : " " + unit);
}

class PartsOfValue {
public:
    PartsOfValue(AuditedBudget& budget, const Statements& statements, std::vector<Sentence>& not_read)
        : budget_(budget),
          statements_(statements),
          value_(statements.numbers.at(Statement::value)),
          not_read_(not_read) {}

    void take() {
        take(Statement::u_c, budget_.claims.u_c, 1.0);
        const double k = budget_.claims.k ? budget_.claims.k->value : 0.0;
        take(Statement::reported_U, budget_.claims.U, k);
        take(Statement::U, budget_.claims.U, k);
    }

private:
    /// \param k  0: nobody states it
    void take(Statement statement, std::optional<StatedNumber>& claim, double k) {
        const StatedResult* part = nullptr;
        for (const std::map<Statement, StatedResult>* from : {&statements_.numbers, &statements_.parts}) {
            const auto found = from->find(statement);
            part =
                part == nullptr && found != from->end() && is_in_other_unit(found->second.unit) ? &found->second : part;
        }
        if (part == nullptr || part->number.value <= 0.0) {
            return;
        }
        const StatedNumber number = in_unit_of_rows(*part, value_, budget_.unit);
        if (claim) {
            const Interval other = printed_interval(*claim);
            if (!left_open(number, 1.0).meets({other.low, other.high + (other.high - other.low)})) {
                ask(*part, number, in_unit(claim->value, budget_.unit));
            }
            return;
        }
        const ClaimCheck rows = check_u_c(budget_);
        if (!rows.allowed || !(k > 0.0)) {
            return;
        }
        const Interval sum = budget_.claims.u_c && k != 1.0 ? left_open(*budget_.claims.u_c, 1.0) : rows.u_c;
        const double ratio = number.value / k / sum.high;
        constexpr double k_same_size = 3.0;
        // Where u_c is that of the rows by this value, U is by it, too.
        const bool may_be_of_value = part->is_relative || is_by_value_;
        const bool is_of_value = may_be_of_value && ratio < k_same_size && ratio > 1.0 / k_same_size;
        const bool is_that_of_rows = left_open(number, k).meets(sum);
        if (is_that_of_rows || is_of_value) {
            is_by_value_ = is_by_value_ || is_that_of_rows;
            not_read_.push_back(say("{cell}: {text} is taken as {number:number}, by the value", part->number.place,
                                    quoted(*part), in_unit(number.value, budget_.unit)));
            claim = number;
            return;
        }
        ask(*part, number, in_unit(k * 0.5 * (sum.low + sum.high), budget_.unit));
    }
    /// Whether a unit is that of a part of a value in the unit of the budget, or the other way round.
    [[nodiscard]] bool is_in_other_unit(const std::string& unit) const {
        return statements_.unit_of_parts.empty()
                   ? is_part_beside(unit, budget_.unit)
                   : is_part_beside(budget_.unit, unit) && factor_between(unit, value_.unit).has_value();
    }
    void ask(const StatedResult& part, const StatedNumber& number, const std::string& other) {
        not_read_.push_back(say(
            "{cell}: by the value, {text} is {number:number}, and not {other:number}; it is not used; to which value "
            "does it belong?",
            part.number.place, quoted(part), in_unit(number.value, budget_.unit), other));
    }
    [[nodiscard]] static std::string quoted(const StatedResult& part) {
        return text::in_quotes(part.number.text + " " + part.unit);
    }

    AuditedBudget& budget_;
    const Statements& statements_;
    const StatedResult& value_;
    std::vector<Sentence>& not_read_;
    bool is_by_value_ = false;
};

}  // namespace

bool has_parts(const std::optional<StatedNumber>& value, const std::string& unit) {
    const std::optional<gum::Unit> known = known_unit(unit);
    return value && value->value != 0.0 && std::isfinite(value->value) && known && !known->is_celsius_temperature() &&
           !known->dimension().is_one();
}

void take_parts_of_value(AuditedBudget& budget, const Statements& statements, std::vector<Sentence>& not_read) {
    const auto value = statements.numbers.find(Statement::value);
    if (value == statements.numbers.end()) {
        return;
    }
    const std::string& unit = statements.unit_of_parts.empty() ? budget.unit : value->second.unit;
    if (factor_between(value->second.unit, unit) && has_parts(value->second.number, unit)) {
        PartsOfValue(budget, statements, not_read).take();
    }
}

}  // namespace gumcert::audit
