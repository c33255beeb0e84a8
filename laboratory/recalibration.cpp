#include "laboratory/recalibration.h"

#include <algorithm>
#include <cmath>

#include "certificate/dates.h"
#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/decimal_rounding.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "laboratory/standard_value.h"
#include "text/numbers.h"

namespace gumcert::laboratory {

namespace {

constexpr int k_most_digits = 15;
constexpr double k_well_within = 0.8;  // of the largest permissible error (ILAC-G24:2022 / OIML D 10:2022, 6.2)

Recalibration after(const Calibration& last, long days, std::string because) {
    return {days_after(last.calibrated, days), days, std::move(because)};
}

}  // namespace

long staircase_interval(const IntervalPlan& plan, double found, double scale) {
    const double factor = !gum::is_at_most(std::abs(found), plan.limit, scale)                  ? plan.reduce_by
                          : gum::is_at_most(std::abs(found), k_well_within * plan.limit, scale) ? plan.extend_by
                                                                                                : 1.0;
    // Downwards: a day less is on the safe side.
    const double days = std::floor(static_cast<double>(plan.present_days) * factor);
    return std::clamp(static_cast<long>(std::min(days, 1e6)), plan.least_days, plan.most_days);
}

long control_chart_interval(std::span<const SeriesPoint> series, bool weighted, double limit, double coverage_factor,
                            long most_days) {
    // |D| and u(D) are convex in time, so the days on which the limit is kept follow each other.
    const auto keeps = [&](long days) {
        const Drift drift = linear_drift(series, weighted, static_cast<double>(days));
        return std::abs(drift.value) + coverage_factor * drift.u <= limit;
    };
    if (!keeps(0)) {
        return 0;
    }
    long kept = 0, broken = most_days + 1;
    while (broken - kept > 1) {
        const long middle = kept + (broken - kept) / 2;
        (keeps(middle) ? kept : broken) = middle;
    }
    return kept;
}

TimeInUse time_in_use(const IntervalPlan& plan, double last_reading, double days) {
    TimeInUse out;
    out.used = last_reading - plan.hours_at_calibration;
    out.left = plan.hours - out.used;
    // Without use, or on the day of the calibration, no rate is known and no day follows from it.
    const double rate = days > 0.0 ? out.used / days : 0.0;
    if (rate > 0.0) {
        out.days_left = static_cast<long>(std::floor(std::clamp(out.left / rate, -1e6, 1e6)));
    }
    return out;
}

std::string days_after(std::string_view day, long days) {
    const std::optional<std::chrono::year_month_day> from = certificate::calendar_date(day);
    if (!from) {
        return {};
    }
    const std::chrono::year_month_day date{std::chrono::sys_days(*from) + std::chrono::days(days)};
    const auto digits = [](unsigned number, std::size_t width) {
        std::string text = std::to_string(number);
        return std::string(width - std::min(width, text.size()), '0') + text;
    };
    return digits(static_cast<unsigned>(static_cast<int>(date.year())), 4) + "-" +
           digits(static_cast<unsigned>(date.month()), 2) + "-" + digits(static_cast<unsigned>(date.day()), 2);
}

std::optional<Recalibration> next_calibration(const StandardRecord& record, const CalibrationResult& result) {
    if (!record.interval || record.calibrations.empty()) {
        return std::nullopt;
    }
    const IntervalPlan& plan = *record.interval;
    const Calibration& last = record.calibrations.back();
    if (plan.method == IntervalMethod::in_use_time) {
        const std::string day = plan.readings.empty() ? last.calibrated : plan.readings.back().date;
        const double reading = plan.readings.empty() ? plan.hours_at_calibration : plan.readings.back().hours;
        const long since = certificate::days_between(last.calibrated, day).value_or(0);
        const TimeInUse time = time_in_use(plan, reading, static_cast<double>(since));
        const std::string used =
            text::shortest_plain(time.used) + " h of " + text::shortest_plain(plan.hours) + " h used";
        return time.days_left ? after(last, since + *time.days_left, "in-use time: " + used)
                              : Recalibration{"", 0, "in-use time: " + used};
    }
    IntervalPlan in_unit = plan;
    in_unit.limit = change_in_unit_of(record, result, {plan.limit, plan.unit, "limit"});
    in_unit.unit = result.unit;
    const std::vector<SeriesPoint> series = history_of(record, last, result);
    if (plan.method == IntervalMethod::control_chart) {
        const long days =
            control_chart_interval(series, record.drift.weighted, in_unit.limit, plan.coverage_factor, plan.most_days);
        return after(last, std::max(days, std::min(plan.least_days, plan.most_days)), "control chart");
    }
    if (series.size() < 2) {
        return after(last, plan.present_days, "staircase: one calibration so far, the interval stays");
    }
    const double before = series[series.size() - 2].value;
    const double found = series.back().value - before;
    // 10.005 - 10.0041 is 0.0009 to the digits of the values, and to no more.
    const double scale = std::max(std::abs(before), std::abs(series.back().value));
    const long days = staircase_interval(in_unit, found, scale);
    std::string printed = gum::is_at_most(std::abs(found), 0.0, scale) ? "0" : gum::round_significant(found, 2);
    // 0.0104 V is not told as 0.010 V where the limit is 0.01 V: the printed number gives the same interval.
    const auto gives_the_interval = [&] {
        return staircase_interval(in_unit, certificate::number_of(printed).value_or(found), scale) == days;
    };
    for (int digits = 3; digits <= k_most_digits && !gives_the_interval(); ++digits) {
        printed = gum::round_significant(found, digits);
    }
    return after(last, days,
                 "staircase: found " + printed + " " + gum::unit_for_people(result.unit) + " from its value");
}

}  // namespace gumcert::laboratory
