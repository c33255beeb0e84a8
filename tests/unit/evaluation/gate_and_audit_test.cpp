#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/budget_outcome.h"
#include "audit/rules/registry.h"
#include "audit/sources/record_subject.h"
#include "certificate/statement_of_uncertainty.h"
#include "evaluation/audit_evaluation.h"
#include "evaluation/evaluate_job.h"
#include "gum/conformity/decision_rule.h"
#include "reports/forms/render.h"
#include "tests/support/case_count.h"
#include "tests/support/file_content.h"
#include "tests/unit/reports/document_text.h"

// The gates look at a certificate, the audit at its record. What one of them lets pass the other does not block.

namespace gumcert::evaluation {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::filesystem::path k_source_tree = GUMCERT_SOURCE_DIR;

/// A length of 10 mm at points of an offset, normal, u = 0.1 µm, under the certificate of the example.
class GateAndAudit : public testing::Test {
protected:
    GateAndAudit() {
        const std::filesystem::path example = k_source_tree / "examples" / "certificate";
        symbol_ = test::file_content(example / "symbol.png");
        data_ = json::parse(test::file_content(example / "end_gauge_certificate.json"));
        data_["specifications"][0]["lower"] = 9.999;
        data_["specifications"][0]["upper"] = 10.001;
        data_["accreditation"]["scope"][0]["ranges"][0]["argument"]["of"] = "n";
        data_["accreditation"]["scope"][0]["capability"] = {{"form", "value"}, {"unit", "nm"}, {"U", 50}};
    }
    [[nodiscard]] Evaluation evaluated(const json& data, double u = 0.1, const std::string& profile = "{}") const {
        return evaluated_with(data, {{"unit", "um"}, {"u", u}}, json::object(), profile);
    }
    /// \param d     what the job says of the offset
    /// \param more  keys of the job
    [[nodiscard]] Evaluation evaluated_with(const json& data, const json& d_stated, const json& more,
                                            const std::string& profile = "{}") const {
        json points = json::array();
        for (const double d : {-1.5, -1.05, -0.95, -0.5, 0.0, 0.5, 0.85, 0.95, 1.05, 1.5}) {
            points.push_back({{"d", d}});
        }
        json job = {{"schema", "gumcert/job/1"},
                    {"kind", "budget"},
                    {"title", "Length"},
                    {"coverage_probability", 0.9545},
                    {"model", {"l = n + d"}},
                    {"inputs", {{"n", {{"value", 10}, {"unit", "mm"}, {"constant", true}}}, {"d", d_stated}}},
                    {"outputs", {{"l", {{"unit", "um"}}}}},
                    {"points", points},
                    {"certificate", data}};
        job.update(more);
        const jobs::MemoryFileSource files({{"job.json", job.dump()}, {"symbol.png", symbol_}, {"own.json", profile}});
        return evaluate_job(files, "job.json", CovarianceFile::none, 1, k_source_tree / "templates");
    }
    std::string symbol_;
    json data_;
};

std::string text_of(const reports::EvaluationRecord& record) {
    return reports::squeezed(reports::render_text(record, reports::assets()));
}

/// Findings of the audit alone that block, of some rules ("audit-D").
std::string blocking(const Evaluation& evaluation, const std::string& of) {
    std::string all;
    for (const certificate::Finding& finding : evaluation.record.certificate->findings) {
        if (finding.id.starts_with(of)) {
            all += finding.id + " " + finding.where + ": " + finding.what + "\n";
        }
    }
    return all;
}

/// Each rule as a job states it, with the first parameters that it can be applied with.
/// \param alternative  none: the rule by itself
std::optional<json> rule_of_a_job(gum::DecisionRule rule, std::optional<gum::DecisionRule> alternative, double ratio) {
    for (unsigned chosen = 0; chosen < 64U; ++chosen) {
        gum::DecisionRuleParameters p;
        json stated = {{"id", gum::decision_rule_id(rule)}};
        p.alternative = alternative;
        if (alternative) {
            stated["alternative"] = gum::decision_rule_id(*alternative);
        }
        const auto take = [&](unsigned bit, std::optional<double>& to, const char* key, double value) {
            if ((chosen & bit) != 0) {
                to = value;
                stated[key] = value;
            }
        };
        take(1U, p.test_uncertainty_ratio, "test_uncertainty_ratio", ratio);
        take(2U, p.guard_factor, "guard_factor", 0.5);
        take(4U, p.probability, "probability", 0.02);
        take(8U, p.population_reliability, "population_reliability", 0.9);
        take(16U, p.guard_band, "guard_band", 1e-4);
        if ((chosen & 32U) != 0) {
            stated["method"] = p.method = "6";
        }
        if (rule == gum::DecisionRule::prescribed || alternative == gum::DecisionRule::prescribed) {
            stated["prescribed_by"] = "Regulation 12";
        }
        if (gum::check_decision_rule(rule, p, {.lower = 9.999, .upper = 10.001}).empty()) {
            return stated;
        }
    }
    return std::nullopt;
}

TEST_F(GateAndAudit, DecideAlikeWhateverTheDistribution) {
    const json shapes = {{{"unit", "um"}, {"half_width", 0.17}},
                         {{"unit", "um"}, {"half_width", 0.14}, {"distribution", "arcsine"}},
                         {{"unit", "um"}, {"half_width", 0.24}, {"distribution", "triangular"}},
                         {{"unit", "um"}, {"u", 0.1}, {"nu", 3}}};
    const json rules = {{{"id", "DR-03"}},
                        {{"id", "DR-07"}, {"probability", 0.05}},
                        {{"id", "DR-08"}},
                        {{"id", "DR-09"}, {"method", "4"}, {"population_deviation", 0.0005}}};
    const bool has_all_cases = test::cases(false, true);
    std::size_t decided = 0, evaluations = 0;
    for (std::size_t r = 0; r < rules.size(); ++r) {
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            for (const bool by_trials : {false, true}) {
                if (!has_all_cases && by_trials != ((r + s) % 2 == 0)) {
                    continue;
                }
                const json& rule = rules[r];
                const json& shape = shapes[s];
                ++evaluations;
                SCOPED_TRACE(rule.dump() + shape.dump() + (by_trials ? " by trials" : ""));
                json data = data_;
                data["specifications"][0]["rule"] = rule;
                data["annexes"] = "none";
                const json trials = {{"coverage", "monte_carlo"}, {"monte_carlo", {{"trials", 20000}, {"seed", 7}}}};
                const Evaluation evaluation = evaluated_with(data, shape, by_trials ? trials : json::object());
                EXPECT_EQ(blocking(evaluation, "audit-D"), "");
                for (const auto& value : evaluation.record.certificate->tables.at(0).columns.at(0).values) {
                    ASSERT_TRUE(value.verdict);
                    const certificate::Verdict& v = *value.verdict;
                    const bool passes = v.verdict == "pass";
                    decided += passes || v.verdict == "fail" ? 1U : 0U;
                    if (passes && v.acceptance_lower && v.acceptance_upper) {
                        EXPECT_LE(*v.acceptance_lower, value.value);
                        EXPECT_GE(*v.acceptance_upper, value.value);
                    }
                }
            }
        }
    }
    EXPECT_GT(decided, 6 * evaluations);
}

TEST_F(GateAndAudit, DecideAlikeByEveryRuleWithEveryAlternative) {
    std::vector<std::optional<gum::DecisionRule>> others = {std::nullopt};
    for (const std::string_view id : gum::decision_rule_ids()) {
        others.push_back(gum::decision_rule_from_id(std::string(id)));
    }
    const auto stride = test::cases<std::size_t>(3, 1);
    std::size_t with_alternative = 0, by_alternative = 0, first = 0;
    for (const std::string_view id : gum::decision_rule_ids()) {
        const gum::DecisionRule rule = *gum::decision_rule_from_id(std::string(id));
        ASSERT_TRUE(rule_of_a_job(rule, std::nullopt, 2.0)) << id << " is not applied at all";
        first = (first + 1) % stride;  // of the next rule other alternatives
        for (std::size_t k = first; k < others.size(); k += stride) {
            const auto& other = others[k];
            for (const double ratio : {2.0, 1000.0}) {
                const std::optional<json> stated = rule_of_a_job(rule, other, ratio);
                if (!stated) {
                    continue;
                }
                SCOPED_TRACE(stated->dump());
                json data = data_;
                data["specifications"][0]["rule"] = *stated;
                data["annexes"] = "none";
                const Evaluation evaluation = evaluated(data);
                EXPECT_EQ(blocking(evaluation, "audit-"), "");
                const audit::AuditSubject subject = audit::subject_of(evaluation.record, "job.json");
                const auto& values = evaluation.record.certificate->tables.at(0).columns.at(0).values;
                ASSERT_EQ(values.size(), subject.budgets.size());
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const certificate::Verdict& verdict = values[i].verdict.value();
                    const std::string decided = audit::evaluate(subject.budgets[i]).verdict;
                    EXPECT_TRUE(verdict.verdict == "not_applicable" || verdict.verdict == decided)
                        << values[i].printed_value << ": " << verdict.verdict << ", the audit: " << decided;
                    by_alternative += verdict.rule != id ? 1U : 0U;
                }
                if (other) {
                    ++with_alternative;
                    const std::string page = text_of(evaluation.record);
                    EXPECT_THAT(page, HasSubstr("Where a condition of the rule is not " +
                                                gum::decision_rule_id(*other) + ": "));  // and "kept" below
                    EXPECT_THAT(
                        page, HasSubstr("where a condition of it is not kept " + gum::decision_rule_id(*other) + ", "));
                }
                if (!stated->contains("test_uncertainty_ratio")) {
                    break;  // a second ratio is the same rule
                }
            }
        }
    }
    EXPECT_GE(with_alternative, test::cases<std::size_t>(15, 60));
    EXPECT_GE(by_alternative, test::cases<std::size_t>(60, 250));
}

/// The number behind some words, in percent; none: the page does not have them.
std::optional<double> percent_behind(const std::string& page, const std::string& words) {
    const std::size_t at = page.find(words);
    if (at == std::string::npos) {
        return std::nullopt;
    }
    const std::size_t sign = page.find_first_of("0123456789", at + words.size());  // behind "<" and ">"
    return std::stod(page.substr(sign));
}

TEST_F(GateAndAudit, EachSentenceOnConformityHoldsForEachRow) {
    std::size_t conditional = 0, undetermined = 0;
    for (const std::string_view id : gum::decision_rule_ids()) {
        std::vector<json> rules = {*rule_of_a_job(*gum::decision_rule_from_id(std::string(id)), {}, 2.0)};
        if (id == "DR-05") {
            rules.push_back({{"id", id}, {"guard_factor", 0.25}});
            rules.push_back({{"id", id}, {"guard_band", 3e-4}});
        }
        if (id == "DR-08") {
            rules.push_back({{"id", id}, {"guard_factor", 1.5}});
            rules.push_back({{"id", id}, {"probability", 0.999}});
        }
        for (const json& stated : rules) {
            for (const double u : {0.05, 0.1, 0.2, 0.45}) {
                SCOPED_TRACE(stated.dump() + " " + std::to_string(u));
                json data = data_;
                data["specifications"][0]["rule"] = stated;
                data["annexes"] = "none";
                const Evaluation evaluation = evaluated(data, u);
                const std::string page = text_of(evaluation.record);
                const auto of_pass = percent_behind(page, "false acceptance that the rule allows for a pass: ");
                const auto of_conditional = percent_behind(page, "for the values listed at most ");
                for (const auto& value : evaluation.record.certificate->tables.at(0).columns.at(0).values) {
                    const certificate::Verdict& v = value.verdict.value();
                    const double risk = certificate::number_of(v.printed.specific_risk).value_or(0.0);
                    SCOPED_TRACE(value.printed_value + " " + v.verdict);
                    if (v.verdict == "pass" && of_pass) {
                        EXPECT_LE(risk, *of_pass);
                    } else if (v.verdict == "conditional_pass") {
                        ++conditional;
                        ASSERT_TRUE(of_conditional);
                        EXPECT_LE(risk, *of_conditional);
                        EXPECT_GE(risk, of_pass.value_or(0.0)) << "it is no pass";
                    } else if (v.verdict == "undetermined") {
                        ++undetermined;
                        EXPECT_THAT(page, HasSubstr("the measured value is outside of the acceptance limits"));
                        EXPECT_TRUE(value.value < *v.acceptance_lower || value.value > *v.acceptance_upper);
                    }
                }
            }
        }
    }
    EXPECT_GE(conditional, 10U);
    EXPECT_GE(undetermined, 10U);
}

TEST_F(GateAndAudit, TheLargestUOfARuleIsInTheUnitOfItsSpecification) {
    for (const double largest_U : {1e-4, 3e-4}) {  // in mm; U is 0.2 µm
        json data = data_;
        data["specifications"][0]["rule"] = {{"id", "DR-02"}, {"largest_U", largest_U}, {"alternative", "DR-03"}};
        const Evaluation evaluation = evaluated(data);
        EXPECT_EQ(blocking(evaluation, "audit-"), "");
        const auto& values = evaluation.record.certificate->tables.at(0).columns.at(0).values;
        EXPECT_EQ(values.at(7).printed_value, "10000.95");
        EXPECT_EQ(values.at(7).verdict->rule, largest_U > 2e-4 ? "DR-02" : "DR-03");
        EXPECT_EQ(values.at(7).verdict->verdict, largest_U > 2e-4 ? "pass" : "fail");
    }
}

// The page says by which rule it was decided, and on which condition: the U that it prints has to keep it, or not.
TEST_F(GateAndAudit, StateTheRuleWhoseConditionThePrintedNumbersKeep) {
    json profile = json::parse(test::file_content(k_source_tree / "templates" / "profiles" / "ilac.json"));
    profile["id"] = "own";
    std::size_t moved = 0, kept = 0, missed = 0;
    for (const char* rounding : {"half_even", "up"}) {
        profile["rounding"] = rounding;
        for (const double U : {0.196, 0.199, 0.2, 0.2012, 0.2049, 0.2055, 0.25}) {
            for (const double largest : {0.197, 0.2, 0.2025}) {  // µm
                json data = data_;
                data["profile"] = "own.json";
                data["annexes"] = "none";
                data["specifications"][0]["rule"] = {
                    {"id", "DR-02"}, {"largest_U", 1e-3 * largest}, {"alternative", "DR-03"}};
                SCOPED_TRACE(std::string(rounding) + " " + std::to_string(U) + " " + std::to_string(largest));
                const Evaluation evaluation = evaluated(data, 0.5 * U, profile.dump());
                EXPECT_EQ(blocking(evaluation, "audit-"), "");
                for (const auto& value : evaluation.record.certificate->tables.at(0).columns.at(0).values) {
                    if (value.verdict->verdict_from_printed != value.verdict->verdict) {
                        EXPECT_NE(blocking(evaluation, "D04"), "");
                        continue;
                    }
                    constexpr double k_noise = 1e-9;
                    const double printed = certificate::number_of(value.printed_U).value_or(0.0);
                    const bool keeps = printed <= largest * (1.0 + k_noise);
                    EXPECT_EQ(value.verdict->rule, keeps ? "DR-02" : "DR-03") << value.printed_value;
                    moved += keeps != (value.U.value_or(0.0) <= largest * (1.0 + k_noise)) ? 1U : 0U;
                    kept += keeps ? 1U : 0U;
                    missed += keeps ? 0U : 1U;
                }
                const std::string page = text_of(evaluation.record);
                EXPECT_THAT(page, testing::Not(HasSubstr("U ≤ 0")));
                EXPECT_EQ(page.find("if U ≤ U_max") != std::string::npos,
                          page.find("decided by rule DR-02") != std::string::npos);
            }
        }
    }
    EXPECT_GE(moved, 20U);
    EXPECT_GE(kept, 100U);
    EXPECT_GE(missed, 100U);
}

TEST_F(GateAndAudit, StateWhatLimitsWithoutARangeHoldFor) {
    const auto page = [&](bool with_range) {
        json data = data_;
        data["annexes"] = "none";
        json first = {{"constant", 1.0}};
        if (with_range) {
            first["range"] = "fine";
        }
        json& specification = data["specifications"][0];
        specification.erase("lower");
        specification.erase("upper");
        specification["unit"] = "um";
        specification["limits"] = {{"by", "accuracy"}, {"of", "n"}, {"about", "n"}, {"accuracy", json::array({first})}};
        if (with_range) {
            specification["limits"]["accuracy"].push_back({{"constant", 2.0}});
        }
        const json points = {{"columns", {{"range", "text"}}},
                             {"list", json::array({{{"range", "fine"}, {"d", 0.1}}, {{"range", "wide"}, {"d", 0.2}}})}};
        return text_of(evaluated_with(data, {{"unit", "um"}, {"u", 0.1}}, {{"points", points}}).record);
    };
    EXPECT_THAT(page(true), HasSubstr("fine: ±(1 µm); other ranges: ±(2 µm)"));
    EXPECT_THAT(page(false), testing::Not(HasSubstr("other ranges")));
    EXPECT_THAT(page(false), HasSubstr("±(1 µm)"));
}

TEST_F(GateAndAudit, StateDegreesOfFreedomThatAreTooManyToPrintAsSuch) {
    for (const double nu : {12.0, 9999.0, 10000.0, 5e4}) {
        const std::string page =
            text_of(evaluated_with(data_, {{"unit", "um"}, {"u", 0.1}, {"nu", nu}}, json::object()).record);
        EXPECT_THAT(page, testing::Not(HasSubstr("= >")));
        EXPECT_THAT(page, HasSubstr(nu < 1e4 ? "ν_eff = " + std::to_string(static_cast<int>(nu)) : "ν_eff > 9999"));
    }
}

TEST_F(GateAndAudit, HoldUAgainstTheCapabilityAlikeByEveryProfile) {
    std::size_t outside = 0, refused = 0, raised = 0, profiles = 0;
    for (const auto& file : std::filesystem::directory_iterator(k_source_tree / "templates" / "profiles")) {
        json profile = json::parse(test::file_content(file.path()));
        profile["id"] = "own";
        profile["required_languages"] = json::array();
        profile.erase("terms");  // of shipped profiles only
        ++profiles;
        for (const char* below : {"raise", "outside", "refuse"}) {
            for (const int digits : {1, 2}) {
                for (const double U : {0.1049, 0.1949, 0.1778, 0.1951, 0.2, 0.2049, 0.26}) {
                    profile["below_capability"] = below;
                    profile["digits"] = digits;
                    SCOPED_TRACE(profile.dump() + " " + std::to_string(U));
                    json data = data_;
                    data["profile"] = "own.json";
                    data["annexes"] = "none";
                    data["accreditation"]["scope"][0]["capability"] = {{"form", "value"}, {"unit", "um"}, {"U", 0.2}};
                    const Evaluation evaluation = evaluated(data, 0.5 * U, profile.dump());
                    const bool gate = !blocking(evaluation, "X01").empty();
                    const audit::AuditReport report =
                        audit::audit(audit::subject_of(evaluation.record, "job.json"), audit::all_rules());
                    const bool audited = std::ranges::any_of(report.findings, [](const audit::AuditFinding& finding) {
                        return finding.rule == "X01" && !finding.of_gate;
                    });
                    EXPECT_EQ(gate, audited);
                    EXPECT_TRUE(gate || blocking(evaluation, "audit-").empty()) << blocking(evaluation, "audit-");
                    const certificate::CertifiedValue& value =
                        evaluation.record.certificate->tables.at(0).columns.at(0).values.at(0);
                    EXPECT_EQ(gate, value.printed_U < std::string("0.2") && !value.scope_entry.empty());
                    refused += gate ? 1U : 0U;
                    outside += value.scope_entry.empty() ? 1U : 0U;
                    raised += value.raised ? 1U : 0U;
                }
            }
        }
    }
    EXPECT_GE(profiles, 8U);
    EXPECT_GE(refused, 2 * profiles);
    EXPECT_GE(outside, 2 * profiles);
    EXPECT_GE(raised, 2 * profiles);
}

}  // namespace
}  // namespace gumcert::evaluation
