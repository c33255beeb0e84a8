#include "reports/record/reported_result.h"

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"

#include <cmath>

namespace gumcert::reports {

namespace {

double half_width_of(const std::array<double, 2>& interval) {
    return 0.5 * (interval[1] - interval[0]);
}

/// A value with the decimals that are asked for, or fewer: half a unit of the last one is no smaller than its numerical
/// error, and a double holds 15 digits.
std::string held_value(double value, const gum::RoundedPair& asked, double error) {
    constexpr int k_digits_of_a_double = 15;
    std::string text = asked.value;
    const auto end_at = [&](double unit_of_last) {
        // One digit of a number of the size of its unit: the place where the value ends.
        const gum::RoundedPair held = gum::round_to_uncertainty(value, unit_of_last, 1);
        if (certificate::decimals_of(held.U) < certificate::decimals_of(text)) {
            text = held.value;
        }
    };
    if (error > 0.0) {
        // Half a unit of 10^n holds an error of up to that.
        const double power = std::ceil(std::log10(2.0 * error) - 1e-12);
        end_at(std::pow(10.0, power));
    }
    if (value != 0.0) {
        end_at(std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1.0 - k_digits_of_a_double));
    }
    return text;
}

}  // namespace

bool is_symmetric_as_printed(double value, const std::array<double, 2>& interval, int digits) {
    const double half_width = half_width_of(interval);
    if (!(half_width > 0.0)) {
        return value == interval[0];  // there is no digit of a half-width to compare to
    }
    const int decimals = certificate::decimals_of(gum::round_to_uncertainty(value, half_width, digits).U);
    const double half_a_unit = 0.5 * std::pow(10.0, -decimals);
    return std::abs(value - (interval[0] + half_width)) <= half_a_unit;
}

ReportedResult monte_carlo_result(double value, std::optional<double> u, const std::array<double, 2>& interval,
                                  double coverage_probability, const std::string& because, int digits) {
    ReportedResult result;
    result.method = "monte_carlo";
    result.value = value;
    result.u = u;
    result.interval = interval;
    result.coverage_probability = coverage_probability;
    result.because = because;
    // An interval may have no width though the result varies, where more than p of it is one value: U = 0 would say that
    // nothing is uncertain.
    const bool has_width = half_width_of(interval) > 0.0;
    if (u && (has_width ? is_symmetric_as_printed(value, interval, digits) : *u == 0.0)) {
        result.U = half_width_of(interval);
        if (*u > 0.0 && *result.U > 0.0) {
            result.k = *result.U / *u;
        }
    }
    return result;
}

ReportedResult law_of_propagation_result(double value, double u, std::optional<double> U, std::optional<double> k,
                                         double coverage_probability) {
    ReportedResult result;
    result.value = value;
    result.u = u;
    result.coverage_probability = coverage_probability;
    result.U = U;
    result.k = k;
    if (U) {
        result.interval = {value - *U, value + *U};
    }
    return result;
}

void print_reported(ReportedResult& result, const std::string& unit, const ReportedRounding& rounding) {
    result.printed = {.value = {}, .U = {}, .unit = gum::unit_for_people(unit)};
    result.printed_low.clear();
    result.printed_high.clear();
    result.printed_u = result.u && *result.u > 0.0 ? gum::round_significant(*result.u, rounding.digits_of_u) : "";
    if (result.U && *result.U > 0.0) {
        const gum::RoundedPair pair =
            gum::round_to_uncertainty(result.value, *result.U, rounding.digits, rounding.rounding);
        result.printed.value = pair.value;
        result.printed.U = pair.U;
        return;
    }
    if (!result.U && result.interval && half_width_of(*result.interval) > 0.0) {
        const gum::RoundedPair pair =
            gum::round_to_uncertainty(result.value, half_width_of(*result.interval), rounding.digits);
        const int decimals = certificate::decimals_of(pair.U);
        result.printed.value = held_value(result.value, pair, rounding.value_error);
        result.printed_low = gum::round_to_quantum((*result.interval)[0], decimals);
        result.printed_high = gum::round_to_quantum((*result.interval)[1], decimals);
        return;
    }
    if (!result.U && result.interval) {
        // Without a width: the ends have the digits of the value, which are those that u leaves it.
        const std::optional<int> decimals =
            result.u && *result.u > 0.0
                ? std::optional<int>(certificate::decimals_of(
                      gum::round_to_uncertainty(result.value, *result.u, rounding.digits_of_u).U))
                : std::nullopt;
        const auto end = [&](double of) {
            return decimals ? gum::round_to_quantum(of, *decimals) : text::shortest(of);
        };
        result.printed_low = end((*result.interval)[0]);
        result.printed_high = end((*result.interval)[1]);
    }
    result.printed.value = result.u && *result.u > 0.0
                               ? gum::round_to_uncertainty(result.value, *result.u, rounding.digits_of_u).value
                               : text::shortest(result.value);
    result.printed.U = result.U ? "0" : "";
}

int printed_digits(const ReportedResult& result) {
    // From the texts: they are two digits where they are what two digits give, in either mode of rounding.
    constexpr int k_two = 2;
    if (result.method != "monte_carlo" || !result.interval || !(half_width_of(*result.interval) > 0.0)) {
        return k_two;
    }
    const double half_width = result.U.value_or(half_width_of(*result.interval));
    for (const gum::RoundingMode mode : {gum::RoundingMode::half_even, gum::RoundingMode::up}) {
        const gum::RoundedPair pair = gum::round_to_uncertainty(result.value, half_width, k_two, mode);
        const int decimals = certificate::decimals_of(pair.U);
        const bool same = result.U ? result.printed.U == pair.U && result.printed.value == pair.value
                                   : result.printed_low == gum::round_to_quantum((*result.interval)[0], decimals) &&
                                         result.printed_high == gum::round_to_quantum((*result.interval)[1], decimals);
        if (same) {
            return k_two;
        }
    }
    return 1;
}

std::string negated(const std::string& printed) {
    if (printed.find_first_of("123456789") == std::string::npos) {
        return printed;
    }
    return printed.starts_with('-') ? printed.substr(1) : "-" + printed;
}

ReportedResult reported_result(const Result& result) {
    if (!result.reported.printed.value.empty()) {
        return result.reported;
    }
    ReportedResult stated =
        law_of_propagation_result(result.value, result.u, result.U, result.k, result.coverage_probability);
    const bool of_trials = result.coverage == "monte_carlo" || (result.coverage == "none" && !result.U);
    if (result.monte_carlo && of_trials) {
        stated.method = "monte_carlo";
        stated.interval = result.monte_carlo->symmetric.number;
        stated.because = "vanishing";
    }
    print_reported(stated, result.unit);
    stated.printed = result.printed;  // the texts that the record was issued with
    return stated;
}

}  // namespace gumcert::reports
