#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/budget_outcome.h"
#include "audit/row_edits.h"
#include "audit/rules/registry.h"
#include "audit/word_line.h"
#include "audit/worksheets/worksheet_view.h"
#include "gum/analysis_of_variance.h"
#include "gum/quantity/diagnostic.h"

#include "text/numbers.h"

namespace gumcert::audit {
namespace {

bool is_type_a(const AuditedRow& row) {
    return row.type_a.value_or(row.origin == Origin::readings);
}
std::optional<std::size_t> readings_of(const AuditedRow& row) {
    return row.readings.empty() ? row.n : std::optional(row.readings.size());
}
double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
/// Experimental standard deviation of two values or more (JCGM 100:2008, 4.2.2).
double deviation_of(const std::vector<double>& values) {
    const double mean = mean_of(values);
    double sum = 0.0;
    for (const double value : values) {
        sum += (value - mean) * (value - mean);
    }
    return std::sqrt(sum / (static_cast<double>(values.size()) - 1.0));
}
std::string nu_in_words(double nu) {
    return std::isfinite(nu) ? text::significant(nu, 4) : "infinite";
}

Sentence with_nu(Sentence said, const std::string& nu) {
    return say("{said}, ν = {nu:number}", std::move(said), nu);
}

/// Whether the printed U stays what it is for any ν of a row from 1 on: ν of more readings lies between that and infinity. A
/// fixed k hides what ν does, so that it is asked of t_p(ν_eff).
bool leaves_printed_U(const AuditedBudget& budget, std::size_t row) {
    AuditedBudget fewest = budget;
    fewest.rows[row].used_nu = 1.0;
    CoverageRule rule = budget.coverage;
    if (rule.kind == CoverageRule::Kind::fixed) {
        rule.kind = CoverageRule::Kind::student_t;
        rule.probability = budget.claims.coverage_probability.value_or(rule.probability);
    }
    try {
        return evaluate(fewest, rule).printed_U == evaluate(budget, rule).printed_U;
    } catch (const gum::DiagnosedError&) {
        return false;
    }
}

/// A half-width and its divisor need no readings, whatever the row is called: the evaluation is Type B.
bool has_bounds(const AuditedRow& row) {
    return row.shape == Shape::rectangular || row.shape == Shape::triangular || row.shape == Shape::arcsine ||
           row.shape == Shape::trapezoidal;
}

/// U01
void no_degrees_of_freedom(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (!at.is.type_a.value_or(false) || at.is.nu || std::isfinite(at.is.used_nu) || has_bounds(at.is)) {
            return;
        }
        const std::optional<std::size_t> n = readings_of(at.is);
        AuditFinding finding =
            finding_at(at, "ν", say("a Type A evaluation without degrees of freedom; it counts as exactly known"));
        finding.evidence = {equals("u", in_words(at.is.used_u, at.is.unit))};
        if (n && *n >= 2 && !at.is.pooled_s) {
            finding.evidence.push_back(say_count(*n, "{count:number} reading", "{count:number} readings"));
            finding.expected = equals("ν", std::to_string(*n - 1));
            finding.actual = say("no ν");
            finding.correct = set_degrees_of_freedom(at.row, static_cast<double>(*n - 1));
        } else if (leaves_printed_U(at.of, at.row)) {
            finding.evidence.push_back(say("no ν from 1 on changes the printed U"));
            findings.add(std::move(finding), FindingSeverity::minor);
            return;
        }
        findings.add(std::move(finding));
    });
}

/// t_p(ν_eff) of a budget with a fixed k that is more than 1 % smaller; nothing where its k accounts for ν_eff.
std::optional<double> k_of_few(const AuditedBudget& budget) {
    constexpr double k_smaller = 0.01;
    // Trials draw from the t-distributions of few readings: their k accounts for them.
    if (budget.coverage.kind != CoverageRule::Kind::fixed || budget.rests_on_trials) {
        return std::nullopt;
    }
    CoverageRule student = budget.coverage;
    student.kind = CoverageRule::Kind::student_t;
    student.probability = budget.claims.coverage_probability.value_or(student.probability);
    try {
        double k = 0.0;
        if (budget.correlations.empty() && budget.correlation_variance == 0.0) {
            k = evaluate(budget, student).k;
        } else {
            // The formula of Welch and Satterthwaite is one of independent rows (JCGM 100:2008, G.4.1): of correlated ones
            // it gives a ν_eff far below that of any row. What is stated holds, else the fewest of a row.
            double nu = std::numeric_limits<double>::infinity();
            for (const AuditedRow& row : budget.rows) {
                nu = std::min(nu, row.used_nu);
            }
            nu = budget.claims.nu_eff ? budget.claims.nu_eff->value : nu;
            k = student_factors(student, {nu, nu}).high;
        }
        return budget.coverage.k * budget.k_over_rows < (1.0 - k_smaller) * k ? std::optional(k) : std::nullopt;
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

/// U02
void few_readings(const AuditSubject& subject, FindingCollector& findings) {
    constexpr std::size_t k_enough = 10;
    for_each_row(subject, [&findings](const RowAt& at) {
        const std::optional<std::size_t> n = readings_of(at.is);
        // Readings that are all equal give no scatter, however few they are.
        const bool are_equal = n && *n >= 2 && at.is.used_u == 0.0;
        if (!is_type_a(at.is) || !n || *n >= k_enough || at.is.pooled_s || at.is.group_sizes.size() > 1 || are_equal ||
            (has_bounds(at.is) && !std::isfinite(at.is.used_nu))) {
            return;
        }
        // Where s is that of more series, n is how many readings make the mean, and ν how many the scatter comes of.
        const bool tells_of_more = mentions(at.is, {"pool", "earlier", "previous", "history", "study", " each",
                                                    "fr\u00FCher", "vorherig", "studie", "je "});
        if (tells_of_more && std::isfinite(at.is.used_nu) && at.is.used_nu + 1.0 >= static_cast<double>(k_enough)) {
            return;
        }
        // s of n readings about their mean has ν = n − 1 (JCGM 100:2008, 4.2.6): n itself is how many they are.
        if (*n >= 2 && at.is.nu && at.is.used_nu == static_cast<double>(*n) && !tells_of_more) {
            AuditFinding finding = finding_at(
                at, "ν", say("ν is the number of readings, {count:number}; s has one less", std::to_string(*n)));
            finding.evidence = {equals("n", std::to_string(*n)), equals("ν", nu_in_words(at.is.used_nu))};
            finding.expected = equals("ν", std::to_string(*n - 1));
            finding.actual = equals("ν", nu_in_words(at.is.used_nu));
            finding.correct = set_degrees_of_freedom(at.row, static_cast<double>(*n - 1));
            findings.add(std::move(finding));
            return;
        }
        const bool has_nu = *n >= 2 && std::isfinite(at.is.used_nu);
        const std::optional<double> missing_k = has_nu ? k_of_few(at.of) : std::nullopt;
        if (has_nu && !missing_k) {
            // ν and k follow from the few readings: all that is left is to know of them.
            AuditFinding finding =
                finding_at(at, "",
                           say_count(*n, "the scatter comes of {count:number} reading; ν and k account for it",
                                     "the scatter comes of {count:number} readings; ν and k account for it"));
            finding.evidence = {equals("n", std::to_string(*n)), equals("ν", nu_in_words(at.is.used_nu))};
            findings.add(std::move(finding));
            return;
        }
        AuditFinding finding = finding_at(
            at, "",
            *n < 2 ? say("one reading has no scatter: s cannot come from it")
            : missing_k
                ? say("the scatter comes of {count:number} readings; ν accounts for it, and k does not: t_p(ν_eff) is "
                      "{k:number}",
                      std::to_string(*n), in_words(*missing_k))
                : say("the scatter comes of {count:number} readings, and neither ν nor k accounts for so few",
                      std::to_string(*n)));
        finding.evidence = {equals("n", std::to_string(*n)), equals("ν", nu_in_words(at.is.used_nu))};
        if (*n >= 2 && at.is.nu && !std::isfinite(at.is.used_nu)) {
            finding.expected = equals("ν", std::to_string(*n - 1));
            finding.actual = say("ν infinite");
            finding.correct = set_degrees_of_freedom(at.row, static_cast<double>(*n - 1));
        }
        findings.add(std::move(finding));
    });
}

/// What the words of a row and the formula of what it divides say of that number.
class NumberOfReadings {
public:
    /// \param view  of a workbook; nullptr without
    NumberOfReadings(const AuditedRow& row, const WorksheetView* view)
        : row_(row),
          view_(view),
          maker_(view == nullptr || !row.stated ? nullptr : view->maker_of(row.stated->place)),
          words_{WordLine(row.quantity), WordLine(row.description), WordLine(row.comment), WordLine(row.source)} {}

    /// Largest less smallest: the full width of a distribution with bounds (b' of DKD-R 6-1), and no s.
    /// \param is_divisor_of_bounds  what divides it is √12, or √3
    [[nodiscard]] bool is_range(bool is_divisor_of_bounds) const {
        if (maker_ != nullptr && calls_one_of(maker_->formula, {"MAX", "LARGE", "MAXA"}) &&
            calls_one_of(maker_->formula, {"MIN", "SMALL", "MINA"})) {
            return true;
        }
        return !is_deviation() &&
               (has_bounds(row_) ||
                say_one_of({"spannweite", "spanne ", "max min ", "maximum minus minimum", "maximum less minimum",
                            "largest less smallest", "largest minus smallest", "largest smallest",
                            "highest less lowest", "highest minus lowest", "peak to peak", "spitze spitze",
                            "grosster minus kleinster", "groster minus kleinster"}) ||
                (is_divisor_of_bounds && say_one_of({"range ", "span ", "b "})));
    }
    /// s/√n already, by the formula.
    [[nodiscard]] bool is_divided_in_formula(std::size_t n) const {
        if (maker_ == nullptr) {
            return false;
        }
        const std::vector<FormulaDivision> divisions = divisions_in(*view_, *maker_);
        return std::any_of(divisions.begin(), divisions.end(), [n](const FormulaDivision& one) {
            return one.by_root || (one.by && is_about(*one.by, std::sqrt(static_cast<double>(n))));
        });
    }
    /// s/√n already, by the words: "standard deviation of the mean", "s/√n".
    [[nodiscard]] bool is_called_that_of_the_mean() const {
        const std::string text = text_of_row(row_);
        return say_one_of({"of the mean ", "of mean ", "of the average", "of the arithmetic mean", "standard error",
                           "sem ", "des mittelwert", "des mittels ", "des arithmetischen mittel",
                           "mittelwertabweichung", "standardfehler", "esdm ", "sdom ", "sdm ", "de la media ",
                           "del promedio"}) ||
               // "s; mean of 6 readings" names two numbers: s, and how many readings make the mean.
               std::any_of(words_.begin(), words_.end(),
                           [](const WordLine& words) {
                               return words.has_word("s mean", {"of ", "value of "});
                           }) ||
               mentions(text,
                        {"s_mean", "s(mean", "/√", "/ √", "/sqrt", "/ sqrt", "/wurzel", "/ wurzel", "divided by √",
                         "divided by sqrt", "already divided", "geteilt durch √", "bereits geteilt"});
    }

private:
    /// What is called a standard deviation is one, whatever distribution stands beside it.
    [[nodiscard]] bool is_deviation() const {
        return (maker_ != nullptr && calls_one_of(maker_->formula, {"STDEV", "STDEV.S", "STDEVA", "STDEV.P", "STDEVP",
                                                                    "VAR", "VAR.S", "VARA", "VAR.P", "VARP"})) ||
               (row_.origin_value && row_.origin == Origin::readings) ||
               say_one_of({"standard deviation", "standardabweich", "stdev", "std dev", "desviacion"});
    }
    [[nodiscard]] bool say_one_of(std::initializer_list<std::string_view> beginnings) const {
        return std::any_of(words_.begin(), words_.end(),
                           [&beginnings](const WordLine& words) { return words.has_any(beginnings); });
    }

    const AuditedRow& row_;
    const WorksheetView* view_;
    const SheetFormula* maker_;
    std::array<WordLine, 4> words_;
};

/// U03: s/√m where the result is the mean of another number of readings.
void other_number_of_readings(const AuditSubject& subject, FindingCollector& findings) {
    constexpr std::size_t k_most = 1000;
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for_each_row(subject, [&findings, &view](const RowAt& at) {
        const std::optional<std::size_t> counted = at.is.averaged ? at.is.averaged : readings_of(at.is);
        if (!is_type_a(at.is) || !counted || *counted < 1 || !(at.is.used_u > 0.0)) {
            return;
        }
        const double right = std::sqrt(static_cast<double>(*counted));
        std::optional<double> s, root;
        if (at.is.stated && at.is.divisor && at.is.divisor->value > 0.0) {
            s = at.is.stated->value;
            root = at.is.divisor->value;
            if (std::abs(*root - right) <= at.is.divisor->half_step + 0.01 * right) {
                return;
            }
        } else if (at.is.origin_value && *at.is.origin_value > 0.0 && at.is.readings.empty()) {
            s = at.is.origin_value;
            root = *s / at.is.used_u;
            if (!u_differs(at.is, *s / right)) {
                return;
            }
        } else if (at.is.readings.size() >= 2 && !at.is.pooled_s) {
            s = deviation_of(at.is.readings);
            root = *s / at.is.used_u;
            if (!(*s > 0.0) || !u_differs(at.is, *s / right)) {
                return;
            }
        } else {
            return;
        }
        // A divisor that is the root of no whole number means something else.
        const double m = std::round(*root * *root);
        const bool is_root = m >= 1.0 && m <= static_cast<double>(k_most) && is_about(*root, std::sqrt(m), 0.01);
        // A single reading has the scatter s itself; only where a mean is known to be stated, s/√1 is wrong.
        const auto n = static_cast<double>(*counted);
        if (!is_root || (m == 1.0 && !at.is.averaged) || m == n) {
            return;
        }
        // s of a study of n readings divides by the root of those that the result is the mean of, which nobody states: it is
        // wrong to say so only where m readings cannot be, or the degrees of freedom are those of m.
        if (!at.is.averaged && m < n && is_about(at.is.used_nu, n - 1.0, 1e-9)) {
            return;
        }
        // "5 readings each", up and down: ten make the mean.
        const std::size_t in_mean = static_cast<std::size_t>(m);
        if (!at.is.averaged && in_mean % *counted == 0 && is_about(at.is.used_nu, m - 1.0, 1e-9) &&
            mentions(at.is, {" each", "both ", " per ", "je ", " pro ", "beide", "cada "})) {
            return;
        }
        // Only an s is divided by √n. A range has bounds, and what was divided before needs no second divisor.
        const NumberOfReadings number(at.is, view ? &*view : nullptr);
        const bool is_of_column = at.is.stated && at.is.divisor && at.is.divisor->value > 0.0;
        if (number.is_range(m == 3.0 || m == 12.0) ||
            (is_of_column && at.is.origin_value && may_be_u(at.is, *at.is.origin_value / right)) ||
            (is_of_column &&
             (number.is_divided_in_formula(*counted) || (m == 1.0 && number.is_called_that_of_the_mean())))) {
            return;
        }
        const std::string used = text::significant(m, 6);
        AuditFinding finding = finding_at(
            at, "divisor",
            *counted == 1 ? say("s is divided by √{used:number}, but {counted:number} reading makes the mean", used,
                                std::to_string(*counted))
                          : say("s is divided by √{used:number}, but {counted:number} readings make the mean", used,
                                std::to_string(*counted)));
        finding.evidence = {equals("s", in_words(*s, at.is.unit)), equals("u", in_words(at.is.used_u, at.is.unit)),
                            equals("n", std::to_string(*counted))};
        finding.expected = say("divisor √{divisor:number}", std::to_string(*counted));
        finding.actual = say("divisor √{divisor:number}", used);
        finding.correct = scale_u(at.row, std::sqrt(m / static_cast<double>(*counted)));
        // s of the readings that are there has one degree of freedom less than they are.
        if (!at.is.averaged && *counted >= 2 && at.is.used_nu == m - 1.0) {
            finding.expected = with_nu(std::move(finding.expected), std::to_string(*counted - 1));
            finding.actual = with_nu(std::move(finding.actual), nu_in_words(at.is.used_nu));
            finding.correct =
                both(std::move(finding.correct), set_degrees_of_freedom(at.row, static_cast<double>(*counted - 1)));
        }
        findings.add(std::move(finding));
    });
}

/// U05: all points of a table are one family: 1 % for a false alarm in any of them (Šidák).
void scatter_above_budget(const AuditSubject& subject, FindingCollector& findings) {
    const auto is_compared = [](const AuditedRow& row) {
        return row.readings.size() >= 2 && row.pooled_s && *row.pooled_s > 0.0;
    };
    std::size_t tests = 0;
    for_each_row(subject, [&](const RowAt& at) { tests += is_compared(at.is) ? 1U : 0U; });
    if (tests == 0) {
        return;
    }
    constexpr double k_family = 0.01;
    // 1 − (1 − 0.01)^(1/tests), which for many tests would be a difference of two numbers close to 1. With 1 % for each
    // of a hundred points two of three sound tables would be accused.
    const double level = -std::expm1(std::log1p(-k_family) / static_cast<double>(tests));
    for_each_row(subject, [&](const RowAt& at) {
        if (!is_compared(at.is)) {
            return;
        }
        const double s = deviation_of(at.is.readings), pooled = *at.is.pooled_s;
        const double nu = static_cast<double>(at.is.readings.size() - 1);
        // Both variances are estimates: F has ν of the readings and ν of the pooled estimate. χ² with the pooled s as
        // exact would accuse more often where it comes from few series.
        const double p = gum::f_upper_tail(s * s / (pooled * pooled), nu, at.is.used_nu);
        if (p >= level) {
            return;
        }
        AuditFinding finding = finding_at(at, "u",
                                          say("the readings scatter more than the pooled standard deviation of the "
                                              "budget: {s:number} against {pooled:number}",
                                              in_words(s, at.is.unit), in_words(pooled, at.is.unit)));
        finding.evidence = {
            equals("F", in_words(s * s / (pooled * pooled))), equals("p", text::significant(p, 2)),
            say("level of one test = {level:number} (1 % over {tests})", text::significant(level, 2),
                say_count(static_cast<std::size_t>(tests), "{count:number} test", "{count:number} tests"))};
        finding.expected = say("s ≤ pooled s within chance");
        finding.actual = equals("s", in_words(s, at.is.unit));
        finding.correct = both(scale_u(at.row, s / pooled), set_degrees_of_freedom(at.row, nu));
        findings.add(std::move(finding));
    });
}

/// U06
void identical_readings(const AuditSubject& subject, FindingCollector& findings) {
    constexpr std::size_t k_least = 3;
    for_each_row(subject, [&findings](const RowAt& at) {
        const std::vector<double>& readings = at.is.readings;
        const bool equal = readings.size() >= k_least && std::all_of(readings.begin(), readings.end(),
                                                                     [&](double x) { return x == readings.front(); });
        const bool has_resolution = std::any_of(at.of.rows.begin(), at.of.rows.end(), [](const AuditedRow& row) {
            return row.in_sum && row.used_u > 0.0 &&
                   (row.origin == Origin::resolution || row.contributor == Contributor::item_resolution ||
                    row.contributor == Contributor::reference_resolution);
        });
        // Equal readings say that the scatter is below the resolution; a row for the resolution then stands for both.
        if (!equal || has_resolution) {
            return;
        }
        AuditFinding finding =
            finding_at(at, "readings",
                       say("all {count:number} readings are equal, and no row stands for the resolution",
                           std::to_string(readings.size())));
        finding.evidence = {say("every reading = {reading:number}", in_words(readings.front(), at.is.unit))};
        finding.contribution_missing = true;
        findings.add(std::move(finding));
    });
}

/// Pooled standard deviation of several series (sizes n_i, n_i − 1 degrees of freedom each).
struct PooledSeries {
    double s = 0.0, nu = 0.0, largest = 0.0, smallest = 0.0;
    bool same_size = true;
};
std::optional<PooledSeries> pooled_series(const AuditedRow& row) {
    if (row.group_deviations.size() < 2 || row.group_deviations.size() != row.group_sizes.size()) {
        return std::nullopt;
    }
    PooledSeries pooled{.smallest = row.group_deviations.front()};
    double sum = 0.0;
    for (std::size_t i = 0; i < row.group_deviations.size(); ++i) {
        if (row.group_sizes[i] < 2) {
            return std::nullopt;
        }
        const double nu = static_cast<double>(row.group_sizes[i] - 1), s = row.group_deviations[i];
        // Variances weighted by their degrees of freedom (JCGM 100:2008, 4.2.4): the mean of standard deviations would
        // be too small.
        sum += nu * s * s;
        pooled.nu += nu;
        pooled.largest = std::max(pooled.largest, s);
        pooled.smallest = std::min(pooled.smallest, s);
        pooled.same_size = pooled.same_size && row.group_sizes[i] == row.group_sizes.front();
    }
    pooled.s = std::sqrt(sum / pooled.nu);
    return pooled;
}
/// The standard deviation that a row starts from: before its divisor, where it has one.
double deviation_used(const AuditedRow& row) {
    return row.stated ? row.stated->value : row.used_u;
}
double digits_of_deviation(const AuditedRow& row) {
    return row.stated ? row.stated->half_step : row.u_half_step;
}
Sentence deviation_in_words(double s, double nu, const std::string& unit) {
    return say("s = {s:number}, ν = {nu:number}", in_words(s, unit), nu_in_words(nu));
}

/// U21
void largest_deviation(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (const std::optional<PooledSeries> pooled = pooled_series(at.is)) {
            const double s = deviation_used(at.is);
            if (std::abs(s - pooled->largest) > digits_of_deviation(at.is) + 0.002 * pooled->largest ||
                !(pooled->s < 0.99 * pooled->largest)) {
                return;
            }
            AuditFinding finding =
                finding_at(at, "u",
                           say("the largest of {count:number} standard deviations is used, with the degrees of "
                               "freedom of one series: neither pooled nor the distribution of a maximum",
                               std::to_string(at.is.group_sizes.size())));
            finding.evidence = {
                equals("s", in_words(s, at.is.unit)), say("pooled s = {s:number}", in_words(pooled->s, at.is.unit)),
                equals("ν", nu_in_words(at.is.used_nu)), say("ν of all series = {nu:number}", nu_in_words(pooled->nu))};
            finding.expected = deviation_in_words(pooled->s, pooled->nu, at.is.unit);
            finding.actual = deviation_in_words(s, at.is.used_nu, at.is.unit);
            finding.correct = both(scale_u(at.row, pooled->s / s), set_degrees_of_freedom(at.row, pooled->nu));
            findings.add(std::move(finding));
            return;
        }
        // Only the largest s is known: it stays, as a bound of the pooled one.
        if (at.is.group_sizes.size() < 2 || !at.is.group_deviations.empty() ||
            !mentions(at.is, {"largest", "maximum of", "max(", "max of", "größte", "groesste", "maximale"})) {
            return;
        }
        double nu = 0.0;
        for (const std::size_t size : at.is.group_sizes) {
            nu += size > 1 ? static_cast<double>(size - 1) : 0.0;
        }
        if (!(nu > at.is.used_nu)) {
            return;
        }
        AuditFinding finding = finding_at(at, "ν",
                                          say("the largest of {count:number} standard deviations is used with "
                                              "the degrees of freedom of one series; pooled, all series would count",
                                              std::to_string(at.is.group_sizes.size())));
        finding.evidence = {say("u = {u:number}, kept as a bound", in_words(at.is.used_u, at.is.unit)),
                            equals("ν", nu_in_words(at.is.used_nu)),
                            say("ν of all series = {nu:number}", nu_in_words(nu))};
        finding.expected = equals("ν", nu_in_words(nu));
        finding.actual = equals("ν", nu_in_words(at.is.used_nu));
        finding.correct = set_degrees_of_freedom(at.row, nu);
        findings.add(std::move(finding));
    });
}

/// U22
void deviation_of_deviations(const AuditSubject& subject, FindingCollector& findings) {
    constexpr std::size_t k_least = 3;
    for_each_row(subject, [&findings](const RowAt& at) {
        const std::optional<PooledSeries> pooled = pooled_series(at.is);
        if (!pooled || at.is.group_deviations.size() < k_least) {
            return;
        }
        const double s = deviation_used(at.is), spread = deviation_of(at.is.group_deviations);
        // A spread as large as the pooled s may be the pooled s itself.
        if (std::abs(s - spread) > digits_of_deviation(at.is) + 0.01 * spread || !(spread < 0.9 * pooled->s)) {
            return;
        }
        AuditFinding finding =
            finding_at(at, "u",
                       say("the standard deviation of {count:number} standard deviations is taken for the "
                           "repeatability: it says how the scatter varies, not how large it is",
                           std::to_string(at.is.group_deviations.size())));
        finding.evidence = {
            equals("s", in_words(s, at.is.unit)),
            say("smallest of the standard deviations = {smallest:number}", in_words(pooled->smallest, at.is.unit)),
            say("pooled s = {s:number}", in_words(pooled->s, at.is.unit)), equals("ν", nu_in_words(at.is.used_nu))};
        finding.expected = deviation_in_words(pooled->s, pooled->nu, at.is.unit);
        finding.actual = equals("s", in_words(s, at.is.unit));
        finding.correct = both(scale_u(at.row, pooled->s / s), set_degrees_of_freedom(at.row, pooled->nu));
        findings.add(std::move(finding));
    });
}

/// U25
void deviation_in_place_of_range(const AuditSubject& subject, FindingCollector& findings) {
    constexpr std::size_t k_few = 3;
    for_each_row(subject, [&findings](const RowAt& at) {
        const std::vector<double>& readings = at.is.readings;
        if (readings.size() < 2 || readings.size() > k_few || !at.is.stated ||
            !mentions(at.is, {"range", "max-min", "max - min", "max \u2212 min", "spannweite", "parallelism",
                              "parallelität"})) {
            return;
        }
        const auto [low, high] = std::minmax_element(readings.begin(), readings.end());
        const double range = *high - *low, s = deviation_of(readings);
        const double digits = at.is.stated->half_step + 0.005 * range;
        if (!(range > 0.0) || std::abs(at.is.stated->value - s) > digits ||
            std::abs(at.is.stated->value - range) <= digits) {
            return;
        }
        AuditFinding finding =
            finding_at(at, "stated",
                       say("the quantity is a range, and the standard deviation of {count:number} values stands for it",
                           std::to_string(readings.size())));
        finding.evidence = {say("largest − smallest = {range:number}", in_words(range, at.is.unit)),
                            equals("s", in_words(s, at.is.unit))};
        finding.expected = say_number(in_words(range, at.is.unit));
        finding.actual = say_number(in_words(at.is.stated->value, at.is.unit));
        finding.correct = scale_u(at.row, range / s);
        findings.add(std::move(finding));
    });
}

}  // namespace

std::vector<Rule> type_a_rules() {
    using enum SeverityPolicy;
    using enum FindingSeverity;
    return {
        {.id = "U01",
         .title = "Type A evaluation without degrees of freedom",
         .clause = {.text = "JCGM 100:2008, 4.2.6", .verified = true},
         .needs = {Need::rows},
         .detection = "a row of Type A without a bounded distribution, for which the table gives no ν; ν = n − 1 of "
                      "the readings "
                      "that its words or the range of its STDEV name; minor where no ν from 1 on changes the printed U",
         .correction = "State ν: n − 1 of a mean of n readings, the sum over all series of a pooled estimate.",
         .question =
             "The row counts with infinite degrees of freedom, so k is too small where it is large. From how many "
             "readings does it come?",
         .examine = no_degrees_of_freedom},
        {.id = "U02",
         .title = "Few readings",
         .clause = {.text = "JCGM 100:2008, 4.2.6 and E.4.3", .verified = false},
         .severity = minor,
         .needs = {Need::readings},
         .detection = "a Type A row from fewer than 10 readings, without bounds and a pooled estimate; from 2 readings "
                      "on, and with ν and k that account for it, only to be known; ν that is n itself",
         .correction = "Use a pooled estimate of s, or state ν = n − 1 and take k from it.",
         .question =
             "A standard deviation of so few readings is itself uncertain. Is there a pooled estimate from earlier "
             "calibrations, or do ν and k account for the number?",
         .examine = few_readings},
        {.id = "U03",
         .title = "Divisor of another number of readings",
         .clause = {.text = "JCGM 100:2008, 4.2.3", .verified = true},
         .needs = {Need::readings},
         .detection = "s divided by √m where the result is the mean of n ≠ m readings; not a range, nor what formula "
                      "or words say was divided already",
         .correction = "Divide s by the root of the number of readings that the stated value is the mean of.",
         .question =
             "Of how many readings is the value on the certificate the mean: of those of the study, or of those of "
             "the calibration?",
         .examine = other_number_of_readings},
        {.id = "U05",
         .title = "Observed scatter larger than budgeted",
         .clause = {.text = "ISO/IEC 17025:2017, 7.6.1", .verified = false},
         .needs = {Need::readings},
         .detection =
             "F-test of the readings against the pooled s, 1 % for a false alarm over all points together (Šidák)",
         .correction = "Use the scatter that was observed, or find its cause and repeat the readings.",
         .question =
             "The readings scatter more than the budget says they do. What was different in this calibration, and "
             "why does the pooled value still hold?",
         .examine = scatter_above_budget},
        {.id = "U06",
         .title = "All readings identical",
         .clause = {.text = "ISO/IEC 17025:2017, 7.5.1", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::readings},
         .detection = "three or more equal readings where no row stands for a resolution",
         .correction = "State the resolution as a row of its own, or show that the display was not frozen.",
         .question =
             "Readings without any scatter say that the display is coarse, frozen or copied. Which is it, and which "
             "row stands for the resolution?",
         .examine = identical_readings},
        {.id = "U21",
         .title = "Largest of several standard deviations",
         .clause = {.text = "JCGM 100:2008, 4.2.4", .verified = true},
         .severity = minor,
         .needs = {Need::rows},
         .detection = "s is the largest of the standard deviations of several series, with ν of one of them",
         .correction = "Pool the series: s² is the mean of the variances weighted by ν_i, ν the sum of ν_i.",
         .question =
             "The largest s with the ν of one series makes k large for no reason. Do the series scatter alike, so "
             "that they may be pooled?",
         .examine = largest_deviation},
        {.id = "U22",
         .title = "Standard deviation of standard deviations",
         .clause = {.text = "JCGM 100:2008, 4.2.4", .verified = true},
         .severity = critical,
         .needs = {Need::rows},
         .detection = "s is the standard deviation of the standard deviations of several series",
         .correction = "Pool the series: s² is the mean of the variances weighted by ν_i, ν the sum of ν_i.",
         .question = "The number says how much the daily scatter varies, not how large it is. Was the pooled standard "
                     "deviation meant, as ν suggests?",
         .examine = deviation_of_deviations},
        {.id = "U25",
         .title = "Standard deviation in place of a range",
         .clause = {.text = "JCGM 100:2008, 4.2.2", .verified = true},
         .needs = {Need::readings},
         .detection = "a row that speaks of a range, with two or three values and their standard deviation",
         .correction = "Use largest less smallest where the quantity is defined so.",
         .question =
             "The standard deviation of two values is 0.71 of their difference. Which of the two is the quantity "
             "that the specification limits?",
         .examine = deviation_in_place_of_range},
    };
}

}  // namespace gumcert::audit
