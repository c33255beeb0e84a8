// A law: no sound budget is accused of anything critical, however its digits were rounded; and an error that is planted
// is found by its rule, with the effect that it has.
//
// Budgets are made at random. The seed is fixed, so that one tree gives one verdict; GUMCERT_AUDIT_SEED in the
// environment looks elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "audit/claims.h"
#include "gum/rounding.h"
#include "tests/support/audit_rules.h"
#include "tests/support/audited_budgets.h"
#include "text/numbers.h"

namespace gumcert::audit {
namespace {

using test::printed;

unsigned seed_of_run() {
    const char* text = std::getenv("GUMCERT_AUDIT_SEED");
    return text != nullptr ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : 20080930U;
}

class Maker {
public:
    explicit Maker(unsigned seed) : random_(seed) {}

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    std::size_t one_of(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
    /// A number with some significant digits, spread over two powers of ten.
    double rounded(int digits) { return std::stod(gum::round_significant(std::pow(10.0, between(-1.0, 1.0)), digits)); }

    /// A row of one kind, with all of its digits.
    AuditedRow exact_row(const std::string& name) {
        switch (one_of(6)) {
            case 0:
                return type_a(name);
            case 1: {
                AuditedRow row = made(name, Origin::certificate, rounded(2), 2.0, Shape::normal);
                row.certificate_k = 2.0;
                return row;
            }
            case 2: {
                AuditedRow row = made(name, Origin::specification, rounded(2), std::numbers::sqrt3, Shape::rectangular);
                row.comment = "verified";
                return row;
            }
            case 3:
                return made(name, Origin::resolution, rounded(1), std::sqrt(12.0), Shape::rectangular);
            case 4:
                return made(name, Origin::limits, rounded(2), std::numbers::sqrt3, Shape::rectangular);
            default:
                return made(name, Origin::limits, rounded(2), std::sqrt(6.0), Shape::triangular);
        }
    }

    AuditedRow made(const std::string& name, Origin origin, double value, double divisor, Shape shape) {
        AuditedRow row = test::row_from(name, origin, value, value / divisor, shape);
        row.stated = exact_number(value, "");
        row.divisor = exact_number(divisor, "");
        finish(row, name);
        return row;
    }
    AuditedRow type_a(const std::string& name) {
        std::vector<double> readings(5 + one_of(16));
        double sum = 0.0, squares = 0.0;
        const double sigma = rounded(3);
        for (double& reading : readings) {
            reading = std::normal_distribution<double>(10.0, sigma)(random_);
            sum += reading;
        }
        for (const double reading : readings) {
            const double deviation = reading - sum / static_cast<double>(readings.size());
            squares += deviation * deviation;
        }
        const double n = static_cast<double>(readings.size()), s = std::sqrt(squares / (n - 1.0));
        AuditedRow row = test::row_of_readings(name, readings, s / std::sqrt(n));
        finish(row, name);
        return row;
    }

    std::vector<AuditedRow> exact_rows() {
        std::vector<AuditedRow> rows;
        const std::size_t n = 3 + one_of(6);
        for (std::size_t i = 0; i < n; ++i) {
            rows.push_back(exact_row("x" + std::to_string(i)));
        }
        return rows;
    }

private:
    void finish(AuditedRow& row, const std::string& name) {
        row.source = "source of " + name;
        const double c = one_of(2) == 0 ? 1.0 : rounded(4);
        row.sensitivity = exact_number(c, "");
        row.used_sensitivity = c;
    }

    std::mt19937 random_;
};

AuditedBudget budget_from(std::vector<AuditedRow> rows) {
    AuditedBudget budget = test::budget_of(std::move(rows));
    budget.coverage.probability = 0.9545;
    return budget;
}

/// What a laboratory prints of a budget: every number with few digits, and claims from all digits.
AuditedBudget as_printed(AuditedBudget budget, int digits_of_u) {
    const BudgetOutcome outcome = evaluate(budget);
    const auto print = [](std::optional<StatedNumber>& column, double& used, double& half, int digits) {
        column = printed(gum::round_significant(used, digits));
        used = column->value;
        half = column->half_step;
    };
    for (AuditedRow& row : budget.rows) {
        print(row.u, row.used_u, row.u_half_step, digits_of_u);
        if (row.used_sensitivity != 1.0) {
            print(row.sensitivity, row.used_sensitivity, row.sensitivity_half_step, 4);
        }
    }
    budget.claims.u_c = printed(gum::round_significant(outcome.u_c, 3));
    budget.claims.k = printed(text::fixed(outcome.k, 2));
    budget.claims.U = printed(gum::round_significant(outcome.U, 2));
    budget.claims.coverage_probability = 0.9545;
    budget.claims.coverage_sentence = "k = " + text::fixed(outcome.k, 2) + ", p = 95.45 %";
    note_unexplained(budget);
    return budget;
}

TEST(SoundBudgets, AreNeverAccusedOfAnythingCritical) {
    Maker maker(seed_of_run());
    const std::vector<Rule> rules = test::rules_of_families("USK");
    for (int i = 0; i < 400; ++i) {
        const AuditedBudget budget = as_printed(budget_from(maker.exact_rows()), 2 + i % 3);
        const AuditReport report = audit(test::subject_of(budget), rules);
        EXPECT_EQ(budget.u_c_over_rows, 1.0) << "budget " << i;
        EXPECT_EQ(budget.U_over_k_u_c, 1.0) << "budget " << i;
        for (const AuditFinding& finding : report.findings) {
            EXPECT_NE(finding.severity, FindingSeverity::critical)
                << "budget " << i << ": " << finding.rule << " " << finding.where << ": " << finding.what.english();
            // Beyond what is worth knowing, only dominance and the GUM's own choice may be remarked.
            const bool remark = finding.rule == "U02" || finding.rule == "K04" || finding.rule == "K05" ||
                                finding.rule == "K06" || finding.rule == "K11";
            EXPECT_TRUE(remark) << "budget " << i << ": " << finding.rule << " " << finding.where << ": "
                                << finding.what.english();
        }
    }
}

/// An error: the rule that must find it, and how it is planted in a right budget at a row of its kind.
struct PlantedError {
    const char* rule;
    std::function<AuditedRow(Maker&)> right;
    std::function<void(AuditedBudget&, std::size_t)> plant;
};

AuditedRow with_k(Maker& maker) {
    AuditedRow row = maker.made("planted", Origin::certificate, maker.rounded(2), 2.0, Shape::normal);
    row.certificate_k = 2.0;
    return row;
}
AuditedRow of_limits(Maker& maker) {
    return maker.made("planted", Origin::limits, maker.rounded(2), std::numbers::sqrt3, Shape::rectangular);
}
AuditedRow of_specification(Maker& maker) {
    AuditedRow row =
        maker.made("planted", Origin::specification, maker.rounded(2), std::numbers::sqrt3, Shape::rectangular);
    row.comment = "verified";
    return row;
}
AuditedRow of_display(Maker& maker) {
    AuditedRow row = maker.made("planted", Origin::resolution, maker.rounded(1), std::sqrt(12.0), Shape::rectangular);
    row.comment = "step " + text::shortest(*row.origin_value);
    return row;
}
AuditedRow of_readings(Maker& maker) {
    return maker.type_a("planted");
}

std::vector<PlantedError> planted_errors() {
    const auto scaled = [](double factor) {
        return [factor](AuditedBudget& budget, std::size_t row) { budget.rows[row].used_u *= factor; };
    };
    return {
        {"U10", of_specification, scaled(std::numbers::sqrt3)},
        {"U24", of_specification, scaled(0.5 * std::numbers::sqrt3)},
        {"U13", with_k, scaled(2.0 / std::numbers::sqrt3)},
        {"U13", with_k, scaled(2.0 / 3.0)},
        {"U13", with_k, scaled(2.0 / 1.96)},
        {"U08", of_limits, scaled(std::pow(3.0, 0.25))},
        {"U08", of_limits, scaled(1.0 / std::numbers::sqrt3)},
        {"U08", of_limits, scaled(std::numbers::sqrt3)},
        {"U09", of_display, scaled(2.0)},
        {"U09", of_display, scaled(0.5)},
        {"U03", of_readings,
         [](AuditedBudget& budget, std::size_t row) {
             AuditedRow& is = budget.rows[row];
             is.used_u *=
                 std::sqrt(static_cast<double>(is.readings.size()) / static_cast<double>(is.readings.size() + 3));
         }},
        {"U01", of_readings,
         [](AuditedBudget& budget, std::size_t row) {
             budget.rows[row].nu.reset();
             budget.rows[row].used_nu = test::k_infinite;
         }},
        {"S16", of_limits,
         [](AuditedBudget& budget, std::size_t row) {
             budget.rows.push_back(budget.rows[row]);
             budget.rows.back().quantity += " (2)";
         }},
        {"K02", of_readings,
         [](AuditedBudget& budget, std::size_t) { budget.coverage.kind = CoverageRule::Kind::fixed; }},
        {"K01", of_limits,
         [](AuditedBudget& budget, std::size_t) {
             const BudgetOutcome outcome = evaluate(budget);
             budget.claims.u_c = exact_number(0.7 * outcome.u_c, "");
             budget.claims.U = exact_number(0.7 * outcome.U, "");
             note_unexplained(budget);
         }},
    };
}

TEST(SoundBudgets, ShowPlantedErrorsWithTheirEffects) {
    Maker maker(seed_of_run() + 1);
    const std::vector<Rule> rules = test::rules_of_families("USK");
    const std::vector<PlantedError> errors = planted_errors();
    int planted = 0;
    for (int attempt = 0; planted < 150 && attempt < 2000; ++attempt) {
        const PlantedError& error = errors[static_cast<std::size_t>(planted) % errors.size()];
        std::vector<AuditedRow> rows = maker.exact_rows();
        const std::size_t row = maker.one_of(rows.size());
        rows[row] = error.right(maker);
        AuditedBudget right = budget_from(std::move(rows)), wrong = right;
        // An error is seen where its row counts; k = 2 is one where ν_eff is small.
        const BudgetOutcome outcome = evaluate(right);
        if (std::string_view(error.rule) == "K02" && !(outcome.nu_eff < 15.0)) {
            continue;
        }
        error.plant(wrong, row);
        ++planted;
        const AuditReport report = audit(test::subject_of(wrong), rules);
        const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                        [&error](const AuditFinding& finding) { return finding.rule == error.rule; });
        ASSERT_NE(found, report.findings.end()) << error.rule << ", error " << planted;
        ASSERT_TRUE(found->effect) << error.rule;
        EXPECT_NEAR(found->effect->claimed.U, evaluate(wrong).U, 1e-9 * outcome.U)
            << error.rule << ", error " << planted;
        EXPECT_NEAR(found->effect->alone.U, outcome.U, 1e-9 * outcome.U) << error.rule << ", error " << planted;
        // And no other rule takes the blame for what another correction puts right.
        for (const AuditFinding& finding : report.findings) {
            const bool remark = finding.rule == error.rule || finding.rule == "U02" || finding.rule == "K04" ||
                                finding.rule == "K05" || finding.rule == "K06" || finding.rule == "K11";
            EXPECT_TRUE(remark) << error.rule << " is also seen by " << finding.rule << ": " << finding.what.english();
        }
    }
    EXPECT_EQ(planted, 150);
}

}  // namespace
}  // namespace gumcert::audit
