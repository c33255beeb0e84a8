#include "laboratory/drift.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "text/counts.h"

namespace gumcert::laboratory {

namespace {

[[noreturn]] void refuse_history(const char* code, std::string what, std::string rule) {
    throw gum::InputError(gum::Diagnostic{.code = code,
                                          .where = "history of the standard",
                                          .what = std::move(what),
                                          .rule = std::move(rule),
                                          .action = "add the earlier calibrations, or state another drift model"});
}

Drift uniform_within(double half_width) {
    Drift drift;
    drift.half_width = half_width;
    // A limit without more knowledge: rectangular (JCGM 100:2008, 4.3.7).
    drift.u = half_width / std::sqrt(3.0);
    return drift;
}

}  // namespace

Drift drift_within_limit(double limit_per_year, double days) {
    return uniform_within(limit_per_year * days / k_days_in_year);
}

Drift drift_as_last_difference(std::span<const SeriesPoint> series, double days) {
    if (series.size() < 2 || series[series.size() - 2].days >= series.back().days) {
        refuse_history("GC-LAB-0011", text::count_of(series.size(), "calibration") + " of this value",
                       "the difference between the last two needs two, of different days");
    }
    const SeriesPoint& before = series[series.size() - 2];
    const double change = std::abs(series.back().value - before.value);
    // Two calibrations show no direction that could be relied on, so that the change is a half-width and not a
    // correction. Within the first interval it counts in full: when the standard moved is not known.
    return uniform_within(change * std::max(1.0, days / (series.back().days - before.days)));
}

Drift linear_drift(std::span<const SeriesPoint> series, bool weighted, double days) {
    const auto n = static_cast<double>(series.size());
    const bool has_u = std::all_of(series.begin(), series.end(), [](const SeriesPoint& p) { return p.u > 0.0; });
    if (series.size() < 3 || (weighted && !has_u)) {
        refuse_history("GC-LAB-0012", text::count_of(series.size(), "calibration") + " of this value",
                       "a straight line with its uncertainty needs three, and weights need an uncertainty of each");
    }
    // The last value is the origin: values and their differences then have the same digits.
    const double last = series.back().value;
    double W = 0.0, t_mean = 0.0, y_mean = 0.0;
    const auto weight = [&](const SeriesPoint& p) { return weighted ? 1.0 / (p.u * p.u) : 1.0; };
    for (const SeriesPoint& p : series) {
        W += weight(p);
        t_mean += weight(p) * p.days;
        y_mean += weight(p) * (p.value - last);
    }
    t_mean /= W;
    y_mean /= W;
    // About the mean of t: intercept and slope are uncorrelated there, and u² is a sum of squares alone.
    double S = 0.0, S_ty = 0.0;
    for (const SeriesPoint& p : series) {
        S += weight(p) * (p.days - t_mean) * (p.days - t_mean);
        S_ty += weight(p) * (p.days - t_mean) * (p.value - last - y_mean);
    }
    if (!(S > 0.0)) {
        refuse_history("GC-LAB-0012", "all calibrations are of one day", "a drift needs calibrations of several days");
    }
    const double slope = S_ty / S;
    double squares = 0.0;
    for (const SeriesPoint& p : series) {
        const double residual = p.value - last - y_mean - slope * (p.days - t_mean);
        squares += weight(p) * residual * residual;
    }
    const double nu = n - 2.0;
    const double distance = (days - t_mean) * (days - t_mean) / S;
    Drift drift;
    drift.value = y_mean + slope * (days - t_mean);
    if (weighted) {
        // Stated uncertainties are enlarged where the history contradicts them, and never made smaller: a few points on
        // a line by chance do not show that the laboratories were better than they said.
        const double c = std::max(1.0, squares / nu);
        drift.u = std::sqrt(c * (1.0 / W + distance) + (c - 1.0) * series.back().u * series.back().u);
        // With c = 1 nothing was estimated from the scatter.
        drift.nu = squares > nu ? nu : drift.nu;
    } else {
        // The 1 under the root: the standard scatters about its line as it did before, and one further value is asked
        // for, not the line.
        drift.u = std::sqrt(squares / nu * (1.0 + 1.0 / n + distance));
        drift.nu = nu;
    }
    return drift;
}

}  // namespace gumcert::laboratory
