#include "reports/audit/audit_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/budget_outcome.h"
#include "audit/checklists.h"
#include "audit/claims.h"
#include "audit/row_meaning.h"
#include "reports/printable_text.h"
#include "tests/support/audited_budgets.h"
#include "tests/support/hostile_strings.h"
#include "tests/support/sample_audit.h"
#include "text/numbers.h"

namespace gumcert::reports {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

AuditView view_of(const audit::AuditReport& report) {
    return make_audit_view(std::vector{report}, test::sample_rules(),
                           {.program = "gumcert 0.1.0", .digests = {std::string(64, 'a')}});
}

TEST(AuditViewOfABudget, HoldsNumbersBesideTheirTexts) {
    const audit::AuditReport report = test::sample_audit();
    const AuditView view = view_of(report);
    const AuditedResultView& result = view.files.at(0).results.at(0);
    EXPECT_EQ(result.claimed.U, "1.3");
    EXPECT_EQ(result.claimed.u_c, "0.66") << "as the file prints it";
    EXPECT_EQ(result.recomputed.u_c, "0.659");
    EXPECT_EQ(result.audited.U, "1.5");
    EXPECT_EQ(result.audited.number.U, report.results[0].audited.U);
    EXPECT_EQ(result.claimed.verdict, "pass");
    EXPECT_EQ(result.audited.verdict, "fail");
    EXPECT_TRUE(result.change.verdict_turns);
    EXPECT_TRUE(result.change.En_crosses_one);
    EXPECT_EQ(result.change.direction, "understated");
    EXPECT_EQ(result.capability, "0.9");
    EXPECT_EQ(result.coverage_probability, "95.45");
    EXPECT_EQ(view.files[0].sha256, std::string(64, 'a'));
}

TEST(AuditViewOfABudget, RoundingOfTheClaimIsNoError) {
    // 2 × 29.3 mg was rounded to 59 mg, and the rows give 58.48 mg, which rounds to 58 mg.
    audit::AuditReport report = test::sample_audit();
    audit::AuditedResult& result = report.results[0];
    result.claimed.U = 59.0;
    result.claimed.printed_U = "59";
    result.claimed.stated_step = 1.0;
    result.audited.U = 58.48;
    result.audited.printed_U = "58";
    result.unrounded_U = 58.48;
    const AuditView unchanged = view_of(report);
    EXPECT_EQ(unchanged.files.at(0).results.at(0).change.direction, "unchanged");
    EXPECT_EQ(unchanged.files.at(0).results.at(0).change.percent, "0.0");
    result.audited.U = 50.0;
    const AuditView changed = view_of(report);
    EXPECT_EQ(changed.files.at(0).results.at(0).change.direction, "overstated");
}

double corrected_by = 1.0;
void first_row_is_another(const audit::AuditSubject&, audit::FindingCollector& findings) {
    audit::AuditFinding finding;
    finding.where = "row 1";
    finding.what = "another u";
    finding.budgets = {0};
    finding.correct = [by = corrected_by](audit::AuditedBudget& budget) { budget.rows[0].used_u *= by; };
    findings.add(std::move(finding));
}

/// A number rounded to some digits, as a table prints it.
std::string to_digits(double number, int digits, bool up = false) {
    const double step = std::pow(10.0, std::floor(std::log10(number)) - digits + 1);
    const double rounded = (up ? std::ceil(number / step) : std::round(number / step)) * step;
    return text::fixed(rounded, static_cast<int>(std::max(0.0, -std::round(std::log10(step)))));
}

/// What stands beside each other of a change: two numbers, a percentage, and a word.
/// \param off  relative, what is stated off what the rows give: what lies between both changes neither
void expect_no_contradiction(const std::string& from, double from_step, double off, const std::string& to,
                             const Change& change, const std::string& which) {
    const double before = std::stod(from), after = std::stod(to), percent = 100.0 * change.relative;
    EXPECT_EQ(change.direction == "unchanged", before == after) << which;
    EXPECT_TRUE(change.percent != "0.0" || before == after) << which;
    // Half a unit of two digits is 5 % at most: a larger effect is seen in the numbers, whatever the digits of the claim.
    EXPECT_TRUE(before != after || std::abs(percent) <= 5.05 + 100.0 * off) << which;
    if (change.direction == "understated") {
        EXPECT_GT(after, before) << which;
        EXPECT_GT(percent, 0.0) << which;
    } else if (change.direction == "overstated") {
        EXPECT_LT(after, before) << which;
        EXPECT_LT(percent, 0.0) << which;
    }
    // What was rounded to the numbers that are printed may have changed by this percentage.
    const std::size_t point = to.find('.');
    const double to_step = point == std::string::npos ? std::pow(10.0, std::floor(std::log10(after)) - 1.0)
                                                      : std::pow(10.0, -static_cast<double>(to.size() - point - 1));
    const double least = (after - to_step) / (before + from_step) - 1.0;
    const double most = (after + to_step) / std::max(1e-300, before - from_step) - 1.0;
    EXPECT_LE(100.0 * least, percent + 0.05) << which;
    EXPECT_TRUE(100.0 * most >= percent - 0.05 || before <= from_step) << which;
}

TEST(AuditViewOfABudget, WordPercentageAndBothNumbersOfAChangeNeverContradictEachOther) {
    std::mt19937 draws(7);
    const auto uniform = [&draws](double low, double high) {
        return low + (high - low) * static_cast<double>(draws()) / 4294967296.0;
    };
    const audit::Rule rule{.id = "Z01",
                           .title = "Another u",
                           .clause = {.text = "none"},
                           .needs = {audit::Need::rows},
                           .examine = first_row_is_another};
    std::size_t left_open = 0;
    for (int i = 0; i < 600; ++i) {
        const int rows = 2 + static_cast<int>(uniform(0.0, 5.0)), digits = 1 + static_cast<int>(uniform(0.0, 3.0));
        const int digits_of_U = 1 + static_cast<int>(uniform(0.0, 3.0));
        const double scale = std::pow(10.0, std::round(uniform(-3.0, 1.0)));
        audit::AuditedBudget budget = test::budget_of({});
        double squares = 0.0;
        for (int j = 0; j < rows; ++j) {
            const double u = scale * std::pow(10.0, uniform(-0.8, 0.0));
            audit::AuditedRow row = test::row("a" + std::to_string(j), u);
            row.u = test::printed(to_digits(u, digits));
            row.contribution = row.u;
            audit::complete_row(row);
            budget.rows.push_back(row);
            squares += u * u;
        }
        const bool up = uniform(0.0, 1.0) < 0.3;
        const double wrong = uniform(0.0, 1.0) < 0.3 ? uniform(0.9, 1.15) : 1.0;
        const std::string U = to_digits(2.0 * wrong * std::sqrt(squares), digits_of_U, up);
        budget.claims.U = test::printed(U);
        budget.claims.k = test::printed("2");
        if (uniform(0.0, 1.0) < 0.7) {
            budget.claims.u_c = test::printed(to_digits(wrong * std::sqrt(squares), digits_of_U));
        }
        budget.coverage.kind = audit::CoverageRule::Kind::fixed;
        audit::note_unexplained(budget);
        corrected_by = uniform(0.0, 1.0) < 0.25 ? 1.0 : uniform(0.5, 1.8);
        const audit::AuditReport report = audit::audit(test::subject_of(budget), std::vector{rule});
        left_open += report.subject.budgets[0].within_digits != 1.0 ? 1U : 0U;
        const AuditView view = make_audit_view(std::vector{report}, std::vector{rule}, {});
        const AuditedResultView& result = view.files.at(0).results.at(0);
        const std::size_t point = U.find('.');
        const double step = point == std::string::npos
                                ? std::pow(10.0, std::floor(std::log10(std::stod(U))) - digits_of_U + 1)
                                : std::pow(10.0, -static_cast<double>(U.size() - point - 1));
        // u_c and k that were rounded on the way move a U of three digits by two units.
        const double open = digits_of_U < 3 ? step : 2.0 * step;
        const std::string which = std::to_string(i) + ": U " + U + " → " + result.audited.U + " (" +
                                  result.change.percent + " %), " + result.change.direction;
        EXPECT_EQ(result.claimed.U, U);
        const std::optional<audit::UncorrectedU>& uncorrected = report.subject.budgets[0].uncorrected_U;
        const double off = uncorrected ? std::abs(uncorrected->stated / uncorrected->evaluated - 1.0) : 0.0;
        expect_no_contradiction(U, open, off, result.audited.U, result.change, which);
        const AuditFindingView& finding = view.files[0].findings.at(0);
        ASSERT_TRUE(finding.effect) << which;
        expect_no_contradiction(finding.effect->claimed.U, open, off, finding.effect->alone.U,
                                finding.effect->change_alone, which + ", alone");
    }
    EXPECT_GT(left_open, 50U);
}

TEST(AuditViewOfABudget, DoesNotRecomputeTheDegreesOfFreedomOfAResultWithoutRows) {
    audit::AuditedBudget budget = test::budget_of({});
    budget.correlation_variance = 0.25;
    budget.coverage = {.kind = audit::CoverageRule::Kind::fixed, .k = 2.37};
    budget.claims.U = test::printed("1.2");
    budget.claims.nu_eff = test::printed("8");
    const auto result_of = [](const audit::AuditedBudget& one) {
        return view_of(audit::audit(test::subject_of(one), {})).files.at(0).results.at(0);
    };
    const AuditedResultView result = result_of(budget);
    EXPECT_EQ(result.claimed.nu_eff, "8");
    EXPECT_TRUE(result.claim_nu_eff.allowed);
    EXPECT_EQ(result.recomputed.nu_eff, "–");
    EXPECT_EQ(result.audited.nu_eff, "–");
    EXPECT_EQ(result.nu_eff.low, "–");
    EXPECT_EQ(result.nu_eff.high, "–");
    budget.claims.nu_eff.reset();
    EXPECT_EQ(result_of(budget).claimed.nu_eff, "–");
}

TEST(AuditViewOfABudget, SortsRowsByTheirShareAndTiesFindingsToThem) {
    const AuditView view = view_of(test::sample_audit());
    const AuditedResultView& result = view.files[0].results[0];
    ASSERT_EQ(result.rows.size(), 7U);
    double sum = 0.0;
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        sum += result.rows[i].share;
        EXPECT_TRUE(i == 0 || result.rows[i].contribution <= result.rows[i - 1].contribution);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_EQ(result.rows[0].quantity, "parallelism of the faces");
    ASSERT_THAT(result.rows[0].findings, ElementsAre(1U));
    EXPECT_EQ(view.files[0].findings[1].id, "U10");
    EXPECT_EQ(result.rows[3].divisor, "2");
    EXPECT_EQ(result.rows[3].nu, "") << "the table says nothing";
    EXPECT_EQ(result.rows[1].nu, "9");
}

TEST(AuditViewOfABudget, APlaceThatBeginsLikeAnotherIsAnotherRow) {
    audit::AuditReport report = test::sample_audit();
    report.findings[0].where = "row 11";
    const AuditView view = view_of(report);
    for (const AuditedRowView& row : view.files[0].results[0].rows) {
        EXPECT_TRUE(row.findings.empty() || row.place != "row 1") << row.place;
    }
}

TEST(AuditViewOfABudget, SaysWhichClaimsTheRowsDoNotAllow) {
    const AuditedResultView honest = view_of(test::sample_audit()).files[0].results[0];
    EXPECT_TRUE(honest.claim_U.stated);
    EXPECT_TRUE(honest.claim_U.allowed) << "1.3 may stand for 1.33";
    EXPECT_FALSE(honest.claim_k.stated);
    EXPECT_FALSE(honest.all_stated());

    audit::AuditSubject subject;
    subject.budgets = {test::sample_audited_budget()};
    subject.budgets[0].claims.u_c = test::printed_number("0.60", "row 9");
    const audit::AuditReport report = audit::audit(std::move(subject), test::sample_rules());
    EXPECT_FALSE(view_of(report).files[0].results[0].claim_u_c.allowed);
}

/// The law: the page calls outside what the rule on claims does, in a sheet whose numbers have all of their digits as well.
TEST(AuditViewOfABudget, CallsNoClaimOutsideThatTheRuleAllows) {
    const audit::BudgetOutcome outcome = audit::evaluate(test::sample_audited_budget());
    for (const double arithmetic : {-5e-7, -1e-12, 0.0, 1e-12, 5e-7, 1e-2}) {
        audit::AuditSubject subject;
        subject.budgets = {test::sample_audited_budget()};
        audit::AuditedBudget& budget = subject.budgets[0];
        for (audit::AuditedRow& row : budget.rows) {
            row.u_half_step = row.sensitivity_half_step = 0.0;
        }
        const double u_c = audit::evaluate(budget).u_c * (1.0 + arithmetic);
        budget.claims.u_c = audit::exact_number(u_c, "");
        budget.claims.nu_eff = audit::exact_number(std::floor(outcome.nu_eff), "");
        const audit::ClaimCheck check = audit::check_claims(budget);
        const audit::AuditReport report = audit::audit(std::move(subject), test::sample_rules());
        const AuditedResultView view = view_of(report).files[0].results[0];
        EXPECT_EQ(view.claim_u_c.allowed, !check.u_c_outside) << arithmetic;
        EXPECT_EQ(view.claim_u_c.allowed, std::abs(arithmetic) < 1e-3) << arithmetic;
        EXPECT_TRUE(view.claim_nu_eff.allowed) << "cut to a whole number";
    }
}

TEST(AuditViewOfABudget, PrintsTypedNumbersAsTypedAndRoundsComputedOnes) {
    const auto row_with = [](double u, double estimate) {
        audit::AuditReport report = test::sample_audit();
        audit::AuditedRow& row = report.subject.budgets[0].rows[3];
        row.u = row.sensitivity = audit::exact_number(u, "");
        row.estimate = audit::exact_number(estimate, "");
        row.nu = audit::exact_number(5.783117190965824, "");
        return view_of(report).files[0].results[0].rows[0];
    };
    const AuditedRowView typed = row_with(0.00125, 50.000623);
    EXPECT_EQ(typed.u, "0.00125");
    EXPECT_EQ(typed.sensitivity, "0.00125");
    EXPECT_EQ(typed.estimate, "50.000623");
    const AuditedRowView computed = row_with(0.1 * 39.0 + 0.1 - 0.1, 49.99999999999999);
    EXPECT_EQ(computed.u, "3.9") << "not 3.9000000000000004";
    EXPECT_EQ(computed.estimate, "50");
    EXPECT_EQ(row_with(std::sqrt(0.125), 1e6 / 3.0).u, "0.354");
    EXPECT_EQ(row_with(std::sqrt(0.125), 1e6 / 3.0).estimate, "333333.3333");
    EXPECT_EQ(computed.nu, "5.8");
}

TEST(AuditViewOfABudget, AClaimThatWasComputedIsRoundedLikeTheOthers) {
    audit::AuditSubject subject;
    subject.budgets = {test::sample_audited_budget()};
    audit::AuditedBudget& budget = subject.budgets[0];
    budget.claims.u_c = audit::exact_number(0.658761, "");
    budget.claims.U = audit::exact_number(1.31752301, "");
    budget.claims.k = audit::exact_number(2.000004, "");
    const audit::AuditReport report = audit::audit(std::move(subject), test::sample_rules());
    const AuditedResultView result = view_of(report).files[0].results[0];
    EXPECT_EQ(result.claimed.u_c, "0.659");
    EXPECT_EQ(result.claimed.U, "1.3");
    EXPECT_EQ(result.claimed.k, "2.00");
}

TEST(AuditViewOfABudget, AsksForSixContributors) {
    const AuditView view = view_of(test::sample_audit());
    const std::vector<ContributorView>& all = view.files[0].results[0].contributors;
    ASSERT_EQ(all.size(), 6U);
    EXPECT_EQ(all[0].id, "reference");
    EXPECT_EQ(all[0].contribution_text, "0.280");
    EXPECT_EQ(all[1].reason, "two calibrations only, no trend seen") << "0 with a reason";
    EXPECT_TRUE(all[4].rows.empty()) << "no row of reproducibility";
    EXPECT_THAT(all[5].rows, ElementsAre("temperature difference", "expansion coefficient"));
    EXPECT_NEAR(all[5].contribution, std::hypot(0.12, 0.035), 1e-12);
}

/// The law: a row of any kind that a minimum contributor takes is on the page under it.
TEST(AuditViewOfABudget, LooksForContributorsAsTheRuleDoes) {
    const std::span<const audit::RequiredContributor> minimum = audit::minimum_contributors();
    for (const audit::RequiredContributor& required : minimum) {
        for (const audit::Contributor kind : required.by) {
            audit::AuditReport report = test::sample_audit();
            audit::AuditedRow row;
            row.contributor = kind;
            report.subject.budgets[0].rows = {row};
            const std::vector<ContributorView> all = view_of(report).files[0].results[0].contributors;
            ASSERT_EQ(all.size(), minimum.size());
            EXPECT_EQ(
                std::count_if(all.begin(), all.end(), [](const ContributorView& one) { return !one.rows.empty(); }), 1)
                << required.name.english();
        }
    }
}

TEST(AuditViewOfABudget, SumsTheRestOfTheRows) {
    const AuditedResultView result = view_of(test::sample_audit()).files[0].results[0];
    const AuditedRowView rest = summed_rows(result, 4);
    EXPECT_NEAR(rest.contribution, std::hypot(0.12, 0.035), 1e-12);
    EXPECT_EQ(rest.contribution_text, "0.125");
    EXPECT_NEAR(rest.share, result.rows[4].share + result.rows[5].share + result.rows[6].share, 1e-15);
    EXPECT_EQ(summed_rows(result, 7).contribution_text, "0");
}

TEST(AuditViewOfABudget, HasEffectsBoundsAndQuestions) {
    const AuditView view = view_of(test::sample_audit());
    const AuditedFileView& file = view.files[0];
    ASSERT_EQ(file.findings.size(), 3U);
    EXPECT_EQ(file.counts, (std::array<std::size_t, 4>{1, 1, 1, 0}));
    const AuditFindingView& first = file.findings[0];
    EXPECT_EQ(first.id, "U13");
    EXPECT_EQ(first.severity, "critical");
    EXPECT_EQ(first.title, "Certificate uncertainty divided by the wrong number");
    EXPECT_FALSE(first.clause_verified);
    ASSERT_TRUE(first.effect);
    EXPECT_EQ(first.effect->change_alone.percent, "+23.7");
    EXPECT_EQ(first.effect->change_alone.direction, "understated");
    const AuditFindingView& last = file.findings[2];
    ASSERT_TRUE(last.missing_term);
    EXPECT_EQ(last.missing_term->unit, "µm");
    EXPECT_NE(last.missing_term->u_for_digit, "");
    EXPECT_EQ(file.questions.size(), 3U);
    ASSERT_EQ(file.not_checked.size(), 2U);
    EXPECT_EQ(file.not_checked[0].title, "Calibration of a standard expired");
    ASSERT_EQ(file.linearity.size(), 1U);
    EXPECT_EQ(file.linearity[0].id, "S05");
    EXPECT_EQ(file.not_read.size(), 1U);
    // The shares of all findings are the change from claimed to audited.
    const double whole = first.effect->share + file.findings[1].effect->share;
    EXPECT_NEAR(whole, first.effect->audited.number.U / first.effect->claimed.number.U - 1.0, 1e-9);
    EXPECT_NEAR(whole, file.results[0].change.relative, 1e-9) << "whatever the rounding of the claimed U";
}

TEST(AuditViewOfABudget, ShowsWhatARuleAnswersBesideTheLinearModel) {
    audit::AuditReport report = test::sample_audit();
    report.notes.push_back({.rule = "S05", .what = "bounded by 1e-9 m"});
    const std::vector<RuleAnswer> answers = view_of(report).files[0].linearity;
    ASSERT_EQ(answers.size(), 2U);
    EXPECT_EQ(answers[1].id, "S05");
    EXPECT_EQ(answers[1].answer, "bounded by 1e-9 m");
}

TEST(AuditViewOfABudget, NamesAMethodInWords) {
    audit::AuditReport report = test::sample_audit();
    report.subject.budgets.front().method = "cmm_fixture";
    EXPECT_EQ(view_of(report).files[0].results.front().method, "Measurement of a fixture by CMM");
}

TEST(AuditViewOfABudget, FindsTheWaiverOfAFinding) {
    audit::AuditReport report = test::sample_audit();
    report.subject.waivers = {
        {.finding = "B05", .where = {}, .by = "A. N.", .date = "2026-03-04", .reason = "one operator"},
        {.finding = "U10", .where = "row 9", .by = "A. N.", .date = "2026-03-04", .reason = "other"}};
    const AuditView view = view_of(report);
    ASSERT_EQ(view.waivers.size(), 2U);
    EXPECT_EQ(view.waivers[0].reason, "one operator");
    EXPECT_EQ(view.files[0].findings[2].waiver, 0U);
    EXPECT_FALSE(view.files[0].findings[1].waiver);
}

TEST(AuditViewOfSeveralFiles, PutsTheWorstForward) {
    audit::AuditSubject quiet;
    quiet.name = "quiet.csv";
    quiet.budgets = {test::sample_audited_budget()};
    const std::vector<audit::AuditReport> reports = {audit::audit(std::move(quiet), {}), test::sample_audit()};
    const AuditView view = make_audit_view(reports, test::sample_rules(), {});
    EXPECT_EQ(view.worst, 1U);
    EXPECT_EQ(view.files[0].findings.size(), 0U);
    EXPECT_EQ(view.files[0].sha256, "");
}

TEST(AuditViewOfSeveralFiles, TheWorstResultIsOneWhoseDecisionTurns) {
    audit::AuditReport report = test::sample_audit_of_points();
    AuditedFileView file = view_of(report).files[0];
    ASSERT_EQ(file.results.size(), 4U);
    const AuditedResultView& worst = file.results[file.worst];
    EXPECT_TRUE(worst.change.decision_turns());
    for (const AuditedResultView& result : file.results) {
        EXPECT_TRUE(!result.change.decision_turns() || result.change.relative <= worst.change.relative) << result.name;
    }
}

/// Points that corrections change alike but for the last bits: the one with the largest |E_n|, else the first.
TEST(AuditViewOfSeveralFiles, OfResultsThatChangeAlikeTheLargestScoreIsTheWorst) {
    for (std::size_t largest = 0; largest < 4; ++largest) {
        audit::AuditReport report = test::sample_audit_of_points();
        for (std::size_t i = 0; i < report.results.size(); ++i) {
            audit::AuditedResult& result = report.results[i];
            result.claimed.U = 0.3 * (1.0 + static_cast<double>(i));
            result.audited = result.claimed;
            result.audited.U *= 1.25 * (1.0 + 1e-15 * static_cast<double>((7 * i) % 4));
            result.claimed.en = result.audited.en = 0.4;
        }
        EXPECT_EQ(view_of(report).files[0].worst, 0U);
        report.results[largest].claimed.en = report.results[largest].audited.en = -0.7;
        EXPECT_EQ(view_of(report).files[0].worst, largest);
    }
}

TEST(AuditViewOfSeveralFiles, ABudgetWithoutAnOutcomeShiftsNoPosition) {
    audit::AuditSubject subject;
    audit::AuditedBudget empty;
    empty.name = "empty";
    subject.budgets = {empty, test::sample_audited_budget()};
    const audit::AuditReport report = audit::audit(std::move(subject), test::sample_rules());
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_EQ(report.results[0].budget, 1U);
    const AuditView view = view_of(report);
    EXPECT_EQ(view.files[0].results[0].rows.size(), 7U);
    ASSERT_TRUE(view.files[0].findings[0].effect);
    EXPECT_EQ(view.files[0].findings[0].effect->result, 0U);
}

TEST(ChangeOf, SaysDirectionAndDecisions) {
    audit::BudgetOutcome before;
    before.U = 1.0;
    before.printed_U = before.rounded_U = "1.0";
    before.verdict = "pass";
    before.en = 0.9;
    audit::BudgetOutcome after = before;
    EXPECT_EQ(change_of(before, after).percent, "0.0");
    EXPECT_EQ(change_of(before, after).direction, "unchanged");
    EXPECT_FALSE(change_of(before, after).decision_turns());
    after.U = 0.8;
    after.printed_U = after.rounded_U = "0.80";
    after.en = -1.1;
    EXPECT_EQ(change_of(before, after).percent, "-20.0");
    EXPECT_EQ(change_of(before, after).direction, "overstated");
    EXPECT_TRUE(change_of(before, after).En_crosses_one);
    EXPECT_FALSE(change_of(before, after).verdict_turns);
}

TEST(AuditViewOfHostileNames, TakesNoHiddenCharacterOver) {
    for (const std::string& hostile : test::hostile::characters()) {
        const AuditView view = view_of(test::hostile_audit(hostile));
        const AuditedFileView& file = view.files[0];
        EXPECT_EQ(file.name, printable(hostile));
        EXPECT_EQ(file.results[0].name, printable(hostile));
        EXPECT_TRUE(std::any_of(file.results[0].rows.begin(), file.results[0].rows.end(),
                                [&](const AuditedRowView& row) { return row.quantity == printable(hostile); }));
        EXPECT_EQ(file.findings[0].what.english(), printable(file.findings[0].what.english()));
        EXPECT_EQ(file.findings[0].where, printable(file.findings[0].where));
    }
}

}  // namespace
}  // namespace gumcert::reports
