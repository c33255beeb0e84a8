#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "audit/row_edits.h"
#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

using test::found_by;
using test::subject_with;
using testing::HasSubstr;

/// E_n and ζ as they follow from the numbers.
AuditedScore score_of(const std::string& name, double value, double U, double reference_U) {
    AuditedScore score;
    score.name = name;
    score.value = value;
    score.U = U;
    score.u = 0.5 * U;
    score.reference_U = reference_U;
    score.reference_u = 0.5 * reference_U;
    score.k = score.reference_k = 2.0;
    score.en = value / std::sqrt(U * U + reference_U * reference_U);
    return score;
}
AuditSubject comparison_of(std::vector<AuditedScore> scores) {
    AuditSubject subject = subject_with({});
    subject.comparison.emplace().scores = std::move(scores);
    subject.comparison->instability_in_reference = true;
    return subject;
}
/// Differences as large as their uncertainties make them expect.
std::vector<AuditedScore> sound_scores() {
    return {score_of("A", 0.5, 1.0, 0.3), score_of("B", -0.6, 1.0, 0.3), score_of("C", 0.4, 1.0, 0.3),
            score_of("D", -0.3, 1.0, 0.3), score_of("E", 0.7, 1.0, 0.3)};
}

TEST(ComparisonRules, find_nothing_in_a_sound_comparison) {
    for (const Rule& rule : comparison_rules()) {
        EXPECT_EQ(found_by(comparison_rules(), rule.id, comparison_of(sound_scores())), "") << rule.id;
    }
}

TEST(ComparisonRules, N01_states_its_thresholds) {
    std::vector<AuditedScore> small;
    for (const char* name : {"A", "B", "C", "D", "E", "F"}) {
        small.push_back(score_of(name, 0.05, 1.0, 0.3));
    }
    EXPECT_THAT(found_by(comparison_rules(), "N01", comparison_of(small)), HasSubstr("threshold 0.025"));
    std::vector<AuditedScore> wide = sound_scores();
    wide[2] = score_of("C", 0.4, 3.0, 0.3);
    EXPECT_THAT(found_by(comparison_rules(), "N01", comparison_of(wide)), HasSubstr("u = 1.5 is larger than 1.5 s*"));
    AuditedBudget budget = test::sound_budget();
    budget.reference = ComparedReference{.value = 10.1, .expanded_uncertainty = 0.1, .correlation = 0.0, .name = "NMI"};
    budget.capability = 0.15;
    EXPECT_THAT(found_by(comparison_rules(), "N01", subject_with({budget})),
                HasSubstr("more than twice the capability"));
    budget.capability = 0.16;
    EXPECT_EQ(found_by(comparison_rules(), "N01", subject_with({budget})), "");
}

TEST(ComparisonRules, N01_sees_a_success_that_only_inflation_made) {
    AuditedBudget budget = test::sound_budget();
    budget.reference = ComparedReference{.value = 10.3, .expanded_uncertainty = 0.1, .correlation = 0.0, .name = "NMI"};
    std::vector<Rule> rules = comparison_rules();
    rules.push_back(
        {.id = "U10", .title = "planted", .examine = [](const AuditSubject& subject, FindingCollector& findings) {
             AuditFinding finding = finding_of(subject, 0, "u is too large");
             finding.correct = scale_u(0, 0.1);
             findings.add(std::move(finding));
         }});
    const AuditReport report = audit(subject_with({budget}), rules);
    EXPECT_TRUE(std::any_of(report.findings.begin(), report.findings.end(), [](const AuditFinding& finding) {
        return finding.rule == "N01" && finding.severity == FindingSeverity::critical &&
               finding.what.english().find("passes only because U is inflated") != std::string::npos;
    }));
    budget.reference->value = 10.1;
    const AuditReport sound = audit(subject_with({budget}), rules);
    EXPECT_TRUE(std::none_of(sound.findings.begin(), sound.findings.end(),
                             [](const AuditFinding& finding) { return finding.rule == "N01"; }));
}

TEST(ComparisonRules, N02_recomputes_the_score) {
    std::vector<AuditedScore> scores = sound_scores();
    scores[0].en = 0.5 / std::sqrt(0.25 + 0.09);  // u of one side, U of the other
    EXPECT_THAT(found_by(comparison_rules(), "N02", comparison_of(scores)), HasSubstr("E_n is stated as 0.857"));
    scores = sound_scores();
    scores[1].reference_k = 3.0;
    scores[1].reference_u = 0.1;
    EXPECT_THAT(found_by(comparison_rules(), "N02", comparison_of(scores)), HasSubstr("meet in one E_n"));
    scores = sound_scores();
    scores[1].u = 1.0;
    EXPECT_THAT(found_by(comparison_rules(), "N02", comparison_of(scores)), HasSubstr("is not k·u"));
}

TEST(ComparisonRules, N03_asks_for_the_correlation) {
    AuditSubject subject = comparison_of(sound_scores());
    subject.comparison->shared_sources = {"laser EX-1"};
    EXPECT_THAT(found_by(comparison_rules(), "N03", subject), HasSubstr("laser EX-1"));
    for (AuditedScore& score : subject.comparison->scores) {
        score.correlation_known = true;
    }
    EXPECT_EQ(found_by(comparison_rules(), "N03", subject), "");
    AuditedBudget budget = test::sound_budget();
    budget.reference =
        ComparedReference{.value = 10.1, .expanded_uncertainty = 0.1, .correlation = 0.0, .name = "Block EX-4"};
    EXPECT_EQ(found_by(comparison_rules(), "N03", subject_with({budget})), "");
    budget.rows[0].source = "calibrated against block EX-4";
    EXPECT_THAT(found_by(comparison_rules(), "N03", subject_with({budget})), HasSubstr("the correlation is 0"));
    budget.reference->correlation = 0.4;
    EXPECT_EQ(found_by(comparison_rules(), "N03", subject_with({budget})), "");
}

TEST(ComparisonRules, N04_compares_the_assigned_value_with_sigma) {
    std::vector<AuditedScore> scores = sound_scores();
    scores[0].z = 1.0;
    scores[0].sigma_pt = 0.4;
    EXPECT_THAT(found_by(comparison_rules(), "N04", comparison_of(scores)), HasSubstr("more than 0.3 σ_pt"));
    scores[0].sigma_pt = 0.5;
    EXPECT_EQ(found_by(comparison_rules(), "N04", comparison_of(scores)), "");
}

TEST(ComparisonRules, N05_asks_for_a_better_reference) {
    std::vector<AuditedScore> scores = sound_scores();
    scores[0] = score_of("A", 0.5, 1.0, 1.0);
    EXPECT_THAT(found_by(comparison_rules(), "N05", comparison_of(scores)), HasSubstr("is not smaller"));
}

TEST(ComparisonRules, N05_names_the_sides_as_they_are) {
    // The budget of a reference with U = 0.27 beside a result with U = 0.30, and the other way round.
    for (const auto& [U, other, fires] : {std::tuple(0.27, 0.30, false), std::tuple(0.30, 0.27, true)}) {
        AuditedBudget budget = test::sound_budget();
        budget.claims.U = exact_number(U, "here");
        budget.reference.emplace();
        budget.reference->expanded_uncertainty = other;
        budget.reference->budget_is_reference = true;
        const std::string found = found_by(comparison_rules(), "N05", subject_with({budget}));
        EXPECT_EQ(!found.empty(), fires) << found;
    }
}

TEST(ComparisonRules, N06_does_not_accuse_what_chance_explains) {
    std::vector<AuditedScore> scores = sound_scores();
    scores[0] = score_of("A", 1.0037 * std::hypot(1.0, 0.3), 1.0, 0.3);
    AuditSubject subject = comparison_of(scores);
    EXPECT_THAT(found_by(comparison_rules(), "N06", subject), HasSubstr("|E_n| = 1.004 is above 1, and no action"));
    subject.comparison->scores[0].is_without_objection = true;
    EXPECT_THAT(found_by(comparison_rules(), "N06", subject), HasSubstr("by chance alone"));
    for (const AuditFinding& finding : audit(subject, comparison_rules()).findings) {
        EXPECT_TRUE(finding.rule != "N06" || finding.severity == FindingSeverity::information);
    }
    // What the evaluation objects to is above the limit of the largest of so many, whatever that limit is.
    subject.comparison->scores[0] = score_of("A", 6.54 * std::hypot(1.0, 0.3), 1.0, 0.3);
    EXPECT_THAT(found_by(comparison_rules(), "N06", subject), HasSubstr("|E_n| = 6.54 is above 1, and no action"));
}

TEST(ComparisonRules, N06_says_of_each_score_what_holds_of_it) {
    std::vector<AuditedScore> scores = sound_scores();
    scores[1] = score_of("B", 1.1 * std::hypot(1.0, 0.3), 1.0, 0.3);
    scores[1].is_without_objection = true;
    scores[3] = score_of("D", 3.0, 1.0, 0.3);
    scores[4] = score_of("E", 4.0, 1.0, 0.3);
    std::size_t grave = 0, by_chance = 0;
    for (const AuditFinding& finding : audit(comparison_of(scores), comparison_rules()).findings) {
        if (finding.rule == "N06" && finding.severity == FindingSeverity::critical) {
            ++grave;
            EXPECT_EQ(finding.where, "E") << "the largest shows";
            EXPECT_EQ(finding.other_places, std::vector<std::string>{"D"});
        } else if (finding.rule == "N06") {
            ++by_chance;
            EXPECT_EQ(finding.where, "B");
        }
    }
    EXPECT_EQ(grave, 1U);
    EXPECT_EQ(by_chance, 1U);
}

TEST(ComparisonRules, form_no_score_without_both_uncertainties) {
    for (const auto& [U, reference_U] : {std::pair(0.0, 0.3), std::pair(1.0, 0.0), std::pair(0.0, 0.0)}) {
        std::vector<AuditedScore> scores = sound_scores();
        scores[0] = score_of("A", 9.0, U, reference_U);
        scores[0].en = std::nullopt;
        scores[0].z = 1.0;
        EXPECT_EQ(found_by(comparison_rules(), "N06", comparison_of(scores)), "") << U << " " << reference_U;
        EXPECT_EQ(found_by(comparison_rules(), "N09", comparison_of(scores)), "") << U << " " << reference_U;
    }
}

TEST(ComparisonRules, take_an_evaluated_comparison_as_it_is) {
    std::vector<AuditedScore> scores = sound_scores();
    for (AuditedScore& score : scores) {
        score.is_evaluated = true;
        score.k = 2.21;  // both t of their own degrees of freedom
        score.reference_k = 2.65;
        score.probability = score.reference_probability = 0.9545;
    }
    scores[0].value = 30.0;
    scores[0].en = std::nullopt;  // the evaluation has none
    for (const Rule& rule : comparison_rules()) {
        EXPECT_EQ(found_by(comparison_rules(), rule.id, comparison_of(scores)), "") << rule.id;
    }
    scores[1].reference_probability = 0.99;
    EXPECT_THAT(found_by(comparison_rules(), "N02", comparison_of(scores)),
                HasSubstr("U for 95.45 % and U for 99 % meet"));
    scores[1].reference_probability = 0.95;
    EXPECT_EQ(found_by(comparison_rules(), "N02", comparison_of(scores)), "");
    scores[2] = score_of("C", 3.0, 1.0, 0.3);
    scores[2].is_signal = false;
    EXPECT_EQ(found_by(comparison_rules(), "N06", comparison_of(scores)), "") << "no signal is given";
}

TEST(ComparisonRules, consistency_is_that_of_each_item) {
    AuditSubject subject = comparison_of(sound_scores());
    for (AuditedScore& score : subject.comparison->scores) {
        score.is_evaluated = true;
    }
    subject.comparison->p_high = 1e-9;  // of scores against a value that is made of some of them
    subject.comparison->items.resize(3);
    for (AuditedItem& item : subject.comparison->items) {
        item.has_stability = true;
    }
    subject.comparison->items[0].name = "block 1";
    EXPECT_EQ(found_by(comparison_rules(), "N09", subject), "") << "nothing was tested";
    subject.comparison->items[1].name = "block 2";
    subject.comparison->items[1].p_consistent = 0.0010;
    EXPECT_THAT(found_by(comparison_rules(), "N09", subject), HasSubstr("p = 0.001, threshold 0.05"));
    subject.comparison->items[1].p_consistent = 0.0;
    EXPECT_THAT(found_by(comparison_rules(), "N09", subject), HasSubstr("p is below 1e-300"));
    subject.comparison->items[1].p_consistent = 0.3;
    subject.comparison->items[1].inconsistent = {"C", "D"};
    EXPECT_THAT(found_by(comparison_rules(), "N09", subject), HasSubstr("largest consistent subset are C, D"));
    EXPECT_EQ(found_by(comparison_rules(), "N01", subject), "");
    subject.comparison->items[2].p_low = 0.02;
    EXPECT_THAT(found_by(comparison_rules(), "N01", subject), HasSubstr("p_low = 0.02"));
    EXPECT_EQ(found_by(comparison_rules(), "N07", subject), "");
    subject.comparison->items[0].has_stability = false;
    EXPECT_THAT(found_by(comparison_rules(), "N07", subject), HasSubstr("stability of the artefact"));
}

// Of 40 items of right uncertainties one has a p_low or a p below 2.5 % or 5 % nearly always.
TEST(ComparisonRules, N01_and_N09_take_many_items_as_one_family) {
    AuditSubject subject = comparison_of(sound_scores());
    for (AuditedScore& score : subject.comparison->scores) {
        score.is_evaluated = true;
    }
    subject.comparison->between_laboratories = true;
    subject.comparison->items.resize(40);
    for (AuditedItem& item : subject.comparison->items) {
        item.has_stability = true;
        item.p_low = 0.5;
        item.p_consistent = 0.5;
    }
    AuditedItem& item = subject.comparison->items[7];
    item.name = "P07";
    item.p_low = 0.015;
    EXPECT_EQ(found_by(comparison_rules(), "N01", subject), "");
    item.p_low = 0.0005;
    EXPECT_THAT(found_by(comparison_rules(), "N01", subject), HasSubstr("threshold 0.00063"));
    item.p_consistent = 0.03;
    EXPECT_THAT(found_by(comparison_rules(), "N09", subject), HasSubstr("threshold 0.05"));
    item.by_chance = true;
    EXPECT_EQ(found_by(comparison_rules(), "N09", subject), "");
}

TEST(ComparisonRules, N06_asks_what_was_done) {
    std::vector<AuditedScore> scores = sound_scores();
    scores[0] = score_of("A", 1.5, 1.0, 0.3);
    AuditSubject subject = comparison_of(scores);
    EXPECT_THAT(found_by(comparison_rules(), "N06", subject), HasSubstr("|E_n| = 1.44 is above 1"));
    subject.comparison->action_record = "CAPA 26-014";
    EXPECT_EQ(found_by(comparison_rules(), "N06", subject), "");
    // The organiser of a comparison between laboratories reports the signal; the laboratory acts.
    subject.comparison->action_record.clear();
    subject.comparison->between_laboratories = true;
    EXPECT_THAT(found_by(comparison_rules(), "N06", subject), HasSubstr("a signal for this laboratory"));
    for (const AuditFinding& finding : audit(subject, comparison_rules()).findings) {
        EXPECT_TRUE(finding.rule != "N06" || finding.severity == FindingSeverity::information);
    }
}

TEST(ComparisonRules, N07_asks_for_the_stability_of_the_artefact) {
    AuditSubject subject = comparison_of(sound_scores());
    subject.comparison->instability_in_reference = false;
    EXPECT_THAT(found_by(comparison_rules(), "N07", subject), HasSubstr("stability of the artefact"));
}

TEST(ComparisonRules, N08_asks_for_the_uncertainty_of_the_reference) {
    std::vector<AuditedScore> scores = sound_scores();
    scores[0] = score_of("A", 0.5, 1.0, 0.0);
    EXPECT_THAT(found_by(comparison_rules(), "N08", comparison_of(scores)), HasSubstr("has no uncertainty"));
}

TEST(ComparisonRules, N09_sees_contradicting_results) {
    std::vector<AuditedScore> scores = sound_scores();
    scores[0] = score_of("A", 2.5, 1.0, 0.3);
    EXPECT_THAT(found_by(comparison_rules(), "N09", comparison_of(scores)), HasSubstr("threshold 0.05"));
    AuditSubject with_covariance = comparison_of(scores);
    with_covariance.comparison->p_high = 0.03;  // the verdict of a comparison objects below 0.025
    EXPECT_EQ(found_by(comparison_rules(), "N09", with_covariance), "");
    with_covariance.comparison->p_high = 0.02;
    EXPECT_THAT(found_by(comparison_rules(), "N09", with_covariance), HasSubstr("threshold 0.025"));
}

TEST(ComparisonRules, N10_asks_for_a_joint_statement) {
    AuditSubject subject = comparison_of(sound_scores());
    subject.comparison->shared_sources = {"one set-up"};
    EXPECT_THAT(found_by(comparison_rules(), "N10", subject), HasSubstr("5 scores share a source"));
    subject.comparison->p_low = 0.4;
    EXPECT_EQ(found_by(comparison_rules(), "N10", subject), "");
}

TEST(ComparisonRules, N02_computes_the_score_of_a_table_again) {
    AuditedBudget budget;
    budget.rows.resize(1);
    budget.rows[0].used_u = 0.5;
    budget.value = 1.6;
    budget.claims.value = read_number("1.6", "");
    budget.claims.U = read_number("1.0", "");
    budget.reference = ComparedReference{.value = 0.8, .expanded_uncertainty = 0.75, .name = "reference value"};
    budget.claims.en = read_number("0.64", "");
    EXPECT_EQ(found_by(comparison_rules(), "N02", subject_with({budget})), "");
    budget.claims.en = read_number("0.80", "");
    EXPECT_THAT(found_by(comparison_rules(), "N02", subject_with({budget})), HasSubstr("over U alone"));
    budget.claims.en = read_number("1.28", "");
    EXPECT_THAT(found_by(comparison_rules(), "N02", subject_with({budget})), HasSubstr("u in place of U"));
}

/// The score that decides is the one that N02 leaves standing.
TEST(ComparisonRules, N06_asks_by_the_score_that_N02_computes) {
    AuditedBudget budget;
    budget.rows.resize(1);
    budget.rows[0].used_u = 0.5;
    budget.claims.U = read_number("1.0", "");
    for (const char* const value : {"0.9", "1.6", "2.0", "2.2", "3.1", "-1.4", "-2.9"}) {
        for (const char* const stated : {"0.30", "0.64", "0.96", "1.20", "2.40", "-0.5", "-1.7"}) {
            budget.claims.value = read_number(value, "");
            budget.value = budget.claims.value->value;
            budget.reference = ComparedReference{.value = 0.0, .expanded_uncertainty = 0.75, .name = "reference value"};
            budget.claims.en = read_number(stated, "");
            const std::string refuted = found_by(comparison_rules(), "N02", subject_with({budget}));
            const double right = refuted.empty() ? budget.claims.en->value : *budget.value / 1.25;
            EXPECT_EQ(!found_by(comparison_rules(), "N06", subject_with({budget})).empty(), std::abs(right) > 1.0)
                << value << " " << stated << " " << refuted;
        }
    }
    std::vector<AuditedScore> scores = sound_scores();
    scores[0].en = 1.3;  // follows as 0.48
    EXPECT_EQ(found_by(comparison_rules(), "N06", comparison_of(scores)), "");
    scores[0] = score_of("A", 1.5, 1.0, 0.3);
    scores[0].en = 0.7;
    EXPECT_THAT(found_by(comparison_rules(), "N06", comparison_of(scores)), HasSubstr("|E_n| = 1.44"));
}

}  // namespace
}  // namespace gumcert::audit
