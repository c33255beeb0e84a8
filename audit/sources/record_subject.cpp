#include "audit/sources/record_subject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/budget_outcome.h"
#include "audit/checklists.h"
#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/sources/job_statements.h"
#include "certificate/agreed_rule.h"
#include "certificate/statement_of_uncertainty.h"
#include "certificate/waiver.h"
#include "gum/coverage.h"
#include "reports/record/record_sections.h"

namespace gumcert::audit {
namespace {

using nlohmann::json;

std::optional<double> number_at(const json& statement, const char* key) {
    const auto found = statement.find(key);
    return found != statement.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

/// The number that a key or its `relative_` twin states.
std::optional<double> absolute_at(const json& statement, const std::string& key, double value) {
    if (const std::optional<double> stated = number_at(statement, key.c_str())) {
        return stated;
    }
    const std::optional<double> relative = number_at(statement, ("relative_" + key).c_str());
    return relative ? std::optional(*relative * std::abs(value)) : std::nullopt;
}

Shape shape_of_record(const std::string& distribution) {
    static const std::map<std::string, Shape> k_shapes = {
        {"normal", Shape::normal},         {"student_t", Shape::student_t}, {"uniform", Shape::rectangular},
        {"triangular", Shape::triangular}, {"arcsine", Shape::arcsine},     {"trapezoidal", Shape::trapezoidal},
    };
    const auto found = k_shapes.find(distribution);
    return found == k_shapes.end() ? (distribution.empty() ? Shape::not_stated : Shape::other) : found->second;
}

/// What the job states of an input, or of a component of it, put to its row: where u comes from.
void state_origin(AuditedRow& row, const json& statement, double value) {
    if (const std::optional<double> mpe = number_at(statement, "mpe")) {
        row.origin = Origin::specification;
        row.origin_value = *mpe;
    } else if (const std::optional<double> step = number_at(statement, "resolution")) {
        row.origin = Origin::resolution;
        row.origin_value = *step;
    } else if (const std::optional<double> half_width = number_at(statement, "half_width")) {
        row.origin = Origin::limits;
        row.origin_value = *half_width;
    } else if (const std::optional<double> U = absolute_at(statement, "U", value)) {
        row.origin = Origin::certificate;
        row.origin_value = *U;
        row.certificate_k = number_at(statement, "k");
        row.certificate_probability = number_at(statement, "p");
    }
    if (const auto limits = statement.find("limits"); limits != statement.end() && limits->is_array() &&
                                                      limits->size() == 2 && limits->at(0).is_number() &&
                                                      limits->at(1).is_number()) {
        row.origin = Origin::limits;
        row.origin_value = 0.5 * (limits->at(1).get<double>() - limits->at(0).get<double>());
    }
    if (const auto readings = statement.find("observations"); readings != statement.end() && readings->is_array()) {
        row.origin = Origin::readings;
        for (const json& reading : *readings) {
            if (reading.is_number()) {
                row.readings.push_back(reading.get<double>());
            }
        }
        row.n = row.readings.size();
    }
    if (const auto pooled = statement.find("pooled"); pooled != statement.end() && pooled->is_object()) {
        row.pooled_s = number_at(*pooled, "s");
    }
    for (const char* key : {"note", "significance"}) {
        if (const auto text = statement.find(key); text != statement.end() && text->is_string()) {
            row.comment += (row.comment.empty() ? "" : "; ") + text->get<std::string>();
        }
    }
}

/// \param result_unit  of the result
AuditedRow row_of(const reports::BudgetRow& stated, const std::string& quantity, const std::string& pointer,
                  const std::string& result_unit, const json& statement) {
    AuditedRow row;
    row.quantity = quantity;
    row.unit = stated.unit;
    row.source = stated.source;
    row.place = pointer;
    if (stated.value.number) {
        row.estimate = exact_number(*stated.value.number, pointer + "/value");
    }
    row.u = exact_number(stated.u.number, pointer + "/u");
    row.used_u = stated.u.number;
    if (stated.sensitivity.number) {
        row.sensitivity = exact_number(*stated.sensitivity.number, pointer + "/sensitivity");
        row.used_sensitivity = *stated.sensitivity.number;
    } else {
        // The row stands for many quantities: its contribution is known, and what is beside it is one typical u.
        row.unit = result_unit;
        row.used_u = stated.contribution.number;
        row.u = exact_number(stated.contribution.number, pointer + "/contribution");
        row.used_sensitivity = 1.0;
    }
    row.used_nu = stated.nu.number.value_or(std::numeric_limits<double>::infinity());
    row.nu = exact_number(row.used_nu, pointer + "/nu");
    row.type_a = stated.type == "A";
    row.shape = shape_of_record(stated.distribution);
    row.shape_text = stated.distribution;
    if (statement.is_object()) {
        state_origin(row, statement, stated.value.number.value_or(0.0));
    }
    row.contributor = contributor_of(row.quantity, row.comment, row.source);
    // The job says by its keys what u was made of; where it states u alone, its note or its source may say more.
    if (statement.is_object() && statement.contains("u") && !(row.comment.empty() && row.source.empty())) {
        read_comment(row);
        note_row_facts(row);
        if (row.origin == Origin::certificate && !row.origin_value) {
            row.origin = Origin::not_stated;  // a word is no certificate
        }
    }
    return row;
}

std::string description_of(const reports::EvaluationRecord& record, const std::string& input) {
    const auto found =
        std::find_if(record.inputs.begin(), record.inputs.end(),
                     [&input](const reports::InputQuantity& quantity) { return quantity.name == input; });
    return found == record.inputs.end() || found->description.empty() ? "" : found->description.in("en");
}

/// Whether a row is the value of a standard of the register, or has a role in the tables of results.
bool is_measured(const reports::BudgetRow& row, const json& statement) {
    return !row.standard.empty() || statement.contains("role") || statement.contains("standard") ||
           std::any_of(row.components.begin(), row.components.end(),
                       [](const reports::BudgetRow& part) { return !part.standard.empty(); });
}

void add_rows(AuditedBudget& budget, const std::vector<reports::BudgetRow>& rows, const std::string& pointer,
              const reports::EvaluationRecord* record, const JobStatements* job, const std::string& point) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const reports::BudgetRow& stated = rows[i];
        const std::string place = pointer + "/" + std::to_string(i);
        const std::string description = record == nullptr ? "" : description_of(*record, stated.input);
        const std::string name = description.empty() ? stated.input : stated.input + ", " + description;
        const bool measured = is_measured(stated, job == nullptr ? json() : job->of(stated.input, point));
        if (stated.role.empty() && stated.components.size() > 1) {
            for (std::size_t c = 0; c < stated.components.size(); ++c) {
                const reports::BudgetRow& part = stated.components[c];
                budget.rows.push_back(row_of(part, name + ": " + part.input, place + "/components/" + std::to_string(c),
                                             budget.unit,
                                             job == nullptr ? json() : job->of_part(stated.input, point, part)));
                budget.rows.back().part_of = budget.rows.back().input = stated.input;
                budget.rows.back().component = c;
                budget.rows.back().is_measured = measured;
            }
            continue;
        }
        const json statement = job == nullptr ? json() : job->of_whole(stated.input, point);
        budget.rows.push_back(row_of(stated, name, place, budget.unit, statement));
        budget.rows.back().input = stated.input;
        budget.rows.back().is_measured = measured;
    }
}

/// Whether corrected copies of a budget can take k as the evaluation would: its rows are independent, and say by which
/// distributions they enter.
bool is_sum_of_known_shapes(const AuditedBudget& budget) {
    return budget.correlation_variance == 0.0 && budget.variance_beyond_tangent == 0.0 &&
           std::all_of(budget.rows.begin(), budget.rows.end(), [](const AuditedRow& row) {
               return contribution_of(row) == 0.0 || row.shape == Shape::normal || row.shape == Shape::student_t ||
                      row.shape == Shape::rectangular || row.shape == Shape::triangular || row.shape == Shape::arcsine;
           });
}

/// Whether two of the rows belong to inputs that correlate, also where what that adds to u² cancels.
bool has_correlated_rows(const AuditedBudget& budget) {
    return std::any_of(budget.inputs_with_correlation.begin(), budget.inputs_with_correlation.end(),
                       [&](const std::set<std::string>& together) {
                           std::set<std::string> contributing;
                           for (const AuditedRow& row : budget.rows) {
                               if (contribution_of(row) > 0.0 && together.count(row.input) > 0) {
                                   contributing.insert(row.input);
                               }
                           }
                           return contributing.size() > 1;
                       });
}

/// Whether the result is normal, however its rows correlate, or a single row is all there is.
bool is_normal_or_one_student(const AuditedBudget& budget) {
    std::size_t contributing = 0, normal = 0, student = 0;
    for (const AuditedRow& row : budget.rows) {
        if (contribution_of(row) > 0.0) {
            ++contributing;
            normal += row.shape == Shape::normal && !std::isfinite(row.used_nu) ? 1U : 0U;
            student += row.shape == Shape::normal || row.shape == Shape::student_t ? 1U : 0U;
        }
    }
    return normal == contributing || (contributing == 1 && student == 1);
}

/// The rule that gives the k of a result again: that of the evaluation, which every corrected copy takes anew; of ν_eff, of
/// the convolution of its rows, or none of both.
/// \param truncated  the job cuts ν_eff to the next lower whole number
CoverageRule coverage_of(AuditedBudget budget, const std::string& coverage, double k, double probability,
                         bool truncated) {
    CoverageRule rule{.kind = CoverageRule::Kind::student_t, .k = k, .probability = probability};
    const auto gives_k = [&](const CoverageRule& tried) {
        budget.coverage = tried;
        budget.floor_applied = false;
        return std::abs(evaluate(budget).k / k - 1.0) < 1e-3;  // a convolution is exact to 5e-4 at least
    };
    if (coverage == "convolution") {
        rule.kind = CoverageRule::Kind::convolution;
    }
    rule.truncate = truncated;
    rule.chosen_anew = coverage != "monte_carlo" && is_sum_of_known_shapes(budget);
    if (rule.chosen_anew && gives_k(rule)) {
        return rule;
    }
    rule.chosen_anew = false;
    for (const bool truncate : {truncated, !truncated}) {
        rule.truncate = truncate;
        if (gives_k(rule)) {
            return rule;
        }
    }
    rule.truncate = false;
    rule.kind = CoverageRule::Kind::fixed;
    return rule;
}

void state_coverage(AuditedBudget& budget, const std::string& coverage, std::optional<double> k, double probability,
                    bool truncated) {
    if (!k || !(*k > 0.0)) {
        return;
    }
    try {
        budget.coverage = coverage_of(budget, coverage, *k, probability, truncated);
    } catch (const gum::DiagnosedError&) {
        budget.coverage = {.kind = CoverageRule::Kind::fixed, .k = *k, .probability = probability};
    }
}

/// The certified value of a result: capability, and the specification that it was held against.
struct CertifiedAt {
    const certificate::CertifiedValue* value = nullptr;
    const certificate::AgreedSpecification* specification = nullptr;
};

/// The values that a certificate certifies: those of points by the name of the point, because a table shows its rows in an
/// order of its own (groups, rows that are chosen), and others in the order of the results of a name.
class CertifiedValues {
public:
    explicit CertifiedValues(const std::optional<certificate::Certificate>& certificate) : certificate_(certificate) {
        if (!certificate) {
            return;
        }
        for (const certificate::CertifiedTable& table : certificate->tables) {
            const bool has_points = table.argument && table.argument->name == "point";
            for (const certificate::CertifiedColumn& column : table.columns) {
                for (std::size_t row = 0; row < column.values.size(); ++row) {
                    if (has_points && row < table.argument->printed.size()) {
                        at_point_[{column.result, table.argument->printed[row]}] = &column.values[row];
                    } else {
                        by_result_[column.result].push_back(&column.values[row]);
                    }
                }
            }
        }
    }
    [[nodiscard]] CertifiedAt of(const reports::Result& result) {
        const certificate::CertifiedValue* const value = value_of(result);
        CertifiedAt at{.value = value};
        if (value != nullptr && value->verdict) {
            for (const certificate::AgreedSpecification& specification : certificate_->data.specifications) {
                if (specification.id == value->verdict->specification) {
                    at.specification = &specification;
                }
            }
        }
        return at;
    }

private:
    [[nodiscard]] const certificate::CertifiedValue* value_of(const reports::Result& result) {
        // "l" or, at a point of a table, "l[20 mm]"
        const std::string name = result.name.substr(0, result.name.find('['));
        if (const auto found = at_point_.find({name, result.point}); found != at_point_.end()) {
            return found->second;
        }
        const auto values = by_result_.find(name);
        std::size_t& taken = taken_[name];
        return values == by_result_.end() || taken >= values->second.size() ? nullptr : values->second[taken++];
    }

    const std::optional<certificate::Certificate>& certificate_;
    std::map<std::pair<std::string, std::string>, const certificate::CertifiedValue*> at_point_;
    std::map<std::string, std::vector<const certificate::CertifiedValue*>> by_result_;
    std::map<std::string, std::size_t> taken_;
};

void state_conformity(AuditedBudget& budget, const CertifiedAt& certified) {
    if (certified.value == nullptr) {
        return;
    }
    const certificate::CertifiedValue& value = *certified.value;
    if (!value.scope_entry.empty()) {
        budget.capability = value.capability;  // it holds for what is accredited; a smaller U is stated outside of it
    }
    if (value.U) {
        // Where the printed U stands for the capability, also by rounding alone, that is what is claimed.
        const bool at_capability = certificate::states_capability(*value.U, value.printed_U, budget.capability);
        budget.claims.U = exact_number(at_capability ? *budget.capability : *value.U, budget.place);
    }
    if (!certified.value->verdict) {
        return;
    }
    const certificate::Verdict& verdict = *certified.value->verdict;
    if (verdict.verdict == "not_applicable") {
        return;  // nothing was decided: nothing can be held against the rule
    }
    budget.limits = {.lower = verdict.lower, .upper = verdict.upper};
    budget.claims.verdict = verdict.verdict;
    // The agreed rule with its alternative, not the one of both that decided: the alternative has no parameters of its own,
    // and which of both decides follows from U. A rule that cannot be applied here is none: the verdict of the
    // certificate stays what it claims.
    if (certified.specification != nullptr) {
        const certificate::AgreedRule agreed =
            certificate::agreed_rule(*certified.specification, budget.unit, budget.limits);
        if (agreed.problem.empty()) {
            budget.rule = agreed.rule;
            budget.rule_parameters = agreed.parameters;
        }
    }
}

double variance_of_rows(const AuditedBudget& budget) {
    double variance = 0.0;
    for (const AuditedRow& row : budget.rows) {
        variance += row.used_sensitivity * row.used_sensitivity * row.used_u * row.used_u;
    }
    return variance;
}

/// Σ (c u)⁴/ν of the rows that have degrees of freedom.
double fourth_powers_of_rows(const AuditedBudget& budget) {
    double sum = 0.0;
    for (const AuditedRow& row : budget.rows) {
        const double part = contribution_of(row);
        sum += std::isfinite(row.used_nu) && row.used_nu > 0.0 ? part * part * part * part / row.used_nu : 0.0;
    }
    return sum;
}

/// ν_eff of the evaluation, where the formula of Welch and Satterthwaite gives another one for the rows: it takes them for
/// independent, and the evaluation takes those that correlate for one contribution.
/// \param u  of the law of propagation
void state_degrees_of_freedom(AuditedBudget& budget, double u, const std::optional<double>& nu_eff) {
    constexpr double k_arithmetic = 1e-6;
    const double u4 = u * u * u * u, of_rows = fourth_powers_of_rows(budget);
    if (!nu_eff && of_rows > 0.0) {
        budget.nu_eff_over_rows = std::numeric_limits<double>::infinity();
    } else if (nu_eff && of_rows > 0.0 && std::abs(*nu_eff * of_rows / u4 - 1.0) > k_arithmetic) {
        budget.nu_eff_over_rows = *nu_eff * of_rows / u4;
    } else if (nu_eff && *nu_eff > 0.0 && of_rows == 0.0) {
        budget.fourth_powers_beyond_rows = u4 / *nu_eff;
    }
}

/// U of a result, or the larger distance of an end of its interval from the value: what rules with U take where the interval
/// alone is stated, on the certificate too.
std::optional<double> half_width_of(const reports::ReportedResult& reported) {
    if (reported.U || !reported.interval) {
        return reported.U;
    }
    const auto [low, high] = *reported.interval;
    return std::max(reported.value - low, high - reported.value);
}

/// Whether the evaluation cut ν_eff to the next lower whole number.
bool cuts_degrees_of_freedom(const reports::EvaluationRecord& record) {
    const json options = json::parse(record.options_json, nullptr, false);
    const json::json_pointer stated("/reporting/degrees_of_freedom");
    return options.is_object() && options.contains(stated) && options.at(stated) == "truncated";
}

AuditedBudget budget_of(const reports::EvaluationRecord& record, const reports::Result& result,
                        const JobStatements& job, CertifiedValues& certified) {
    AuditedBudget budget;
    budget.name = result.name;
    budget.unit = result.unit;
    budget.place = "/results/" + result.name;
    budget.evaluated_here = true;
    add_rows(budget, result.budget, budget.place + "/budget", &record, &job, result.point);
    budget.inputs_with_correlation = job.inputs_with_correlation();
    const std::string& quantity = result.quantity.empty() ? result.name : result.quantity;
    for (const std::string& equation : reports::equations_of(record, quantity)) {
        budget.equation += (budget.equation.empty() ? "" : "; ") + equation;
    }
    if (record.certificate) {
        budget.method = record.certificate->data.method.identification;
        const reports::SectionSummary* const section = reports::section_of(record, quantity);
        for (const certificate::SectionData& own : record.certificate->data.sections) {
            if (section != nullptr && own.section == section->name && own.method) {
                budget.method = own.method->identification;
            }
        }
    }
    // What the program evaluates is the method; the title of a budget names it.
    if (record.kind == "rotary_table") {
        budget.method = "rotary_table_multilateration";
    } else if (record.kind != "budget") {
        budget.method.clear();
    } else if (checklist_of(budget.method) == nullptr) {
        budget.method = method_in_title(budget.method + " " + record.title);
    }
    const reports::ReportedResult& reported = result.reported;
    const bool by_trials = reported.method == "monte_carlo";
    budget.value = reported.value;
    const double u = reported.u.value_or(result.u);
    // What is not in the rows: correlations, second-order terms, the scatter of trials.
    const auto beyond = [u](double whole, double part) {
        return std::abs(whole - part) > 1e-9 * u * u ? whole - part : 0.0;
    };
    budget.correlation_variance = beyond(result.u * result.u, variance_of_rows(budget));
    budget.variance_beyond_tangent = beyond(u * u, result.u * result.u);
    budget.rests_on_trials = by_trials;
    if (budget.correlation_variance != 0.0) {
        state_degrees_of_freedom(budget, result.u, result.nu_eff);
    }
    const std::optional<double> k = by_trials ? reported.k : result.k;
    state_coverage(budget, by_trials ? "monte_carlo" : result.coverage, k, reported.coverage_probability,
                   cuts_degrees_of_freedom(record));
    if (const std::optional<double> half_width = half_width_of(reported); by_trials && !k && half_width && u > 0.0) {
        budget.coverage = {
            .kind = CoverageRule::Kind::fixed, .k = *half_width / u, .probability = reported.coverage_probability};
    }
    const bool is_of_rows = budget.coverage.kind != CoverageRule::Kind::fixed && is_sum_of_known_shapes(budget) &&
                            !has_correlated_rows(budget);
    budget.has_known_distribution = !by_trials && (is_of_rows || is_normal_or_one_student(budget));
    Claims& claims = budget.claims;
    claims.value = exact_number(reported.value, budget.place);
    claims.value->text = reported.printed.value;
    claims.u_c = exact_number(u, budget.place);
    if (result.nu_eff) {
        claims.nu_eff = exact_number(*result.nu_eff, budget.place);
    }
    if (k) {
        claims.k = exact_number(*k, budget.place);
    }
    if (reported.U) {
        claims.U = exact_number(*reported.U, budget.place);
    }
    claims.coverage_probability = reported.coverage_probability;
    state_conformity(budget, certified.of(result));
    return budget;
}

/// "gauge, round 2"; "" where there is one item in one round.
std::string name_in_round(const std::string& item, const std::string& round) {
    return item + (item.empty() || round.empty() ? "" : ", ") + (round.empty() ? "" : "round " + round);
}

const reports::ComparisonItemEvaluation* item_of(const reports::Comparison& comparison,
                                                 const reports::ComparisonPoint& point) {
    const auto found = std::find_if(comparison.items.begin(), comparison.items.end(), [&point](const auto& item) {
        return item.id == point.item && item.round == point.round;
    });
    return found == comparison.items.end() ? nullptr : &*found;
}

/// One side of a score: U, and the probability that it covers.
struct TakenU {
    double U = 0.0;
    std::optional<double> probability;
};
/// U as E_n takes it: where the stated factor means another probability for its degrees of freedom, the evaluation has
/// formed U anew (gum::en_uncertainty), so that k of both sides need not be the same.
/// \param of_scores    U that was formed anew; none: as stated
/// \param probability  that is stated beside a k that is none of Student's distribution
TakenU taken_by_en(const reports::Comparison& comparison, const std::optional<double>& stated_U,
                   const std::optional<double>& of_scores, const std::optional<double>& probability) {
    const double wanted = comparison.score_probability;
    return of_scores ? TakenU{.U = *of_scores, .probability = wanted}
                     : TakenU{.U = stated_U.value_or(0.0), .probability = probability.value_or(wanted)};
}

/// Whether the evaluation has no objection to the scores of the direction of a point together. Its verdict has held the
/// largest of them against the limit of so many: another limit here would contradict it.
bool is_without_objection(const reports::Comparison& comparison, const reports::ComparisonPoint& point) {
    const std::string direction = point.direction.empty() ? "all" : point.direction;
    const auto found = std::find_if(comparison.summary.begin(), comparison.summary.end(),
                                    [&direction](const auto& row) { return row.direction == direction; });
    if (found == comparison.summary.end() || found->verdict.empty() || found->points < 1 ||
        found->count_above_1 > found->count_by_chance.value_or(-1)) {
        return false;
    }
    // Chance is reckoned from uncertainties that nothing refutes.
    constexpr std::array<std::string_view, 3> k_objections{"disagreement", "points_above_1", "side_refuted"};
    return std::find(k_objections.begin(), k_objections.end(), found->verdict) == k_objections.end();
}

AuditedScore score_of(const reports::Comparison& comparison, const reports::ComparisonPoint& point) {
    AuditedScore score;
    score.is_evaluated = true;
    score.name = point.name;
    if (score.name.empty()) {
        const std::string item = name_in_round(point.item, point.round);
        score.name = point.participant + (point.participant.empty() || item.empty() ? "" : ", ") + item;
    }
    if (score.name.empty()) {
        score.name = point.direction + " " + point.printed_angle;
    }
    const reports::ComparisonItemEvaluation* item = item_of(comparison, point);
    const TakenU own = taken_by_en(comparison, point.U.number, point.U_of_scores.number, point.coverage_probability);
    const bool has_scatter = item != nullptr && item->U_rests_on == "scatter";
    const TakenU reference = taken_by_en(comparison, point.reference_U.number,
                                         has_scatter       ? std::nullopt
                                         : item != nullptr ? item->U_of_scores.number
                                                           : point.reference_U_of_scores,
                                         point.reference_coverage_probability);
    score.value = point.value.number;
    score.u = point.u.value_or(0.0);
    score.U = own.U;
    score.probability = own.probability;
    score.reference_value = point.reference_value.number;
    score.reference_u = point.reference_u.value_or(0.0);
    score.reference_U = reference.U;
    // Against a value that comes from the scatter of the results E_n takes no U(X): U of the difference is formed from
    // what all other results show, or from the u that are stated. How well the value is known, U(X) by the scatter says.
    const bool by_scatter = has_scatter || point.u_others;
    score.reference_probability = by_scatter ? std::nullopt : reference.probability;
    score.en = point.En.number;
    score.zeta = point.zeta.number;
    score.z = point.z.number;
    // A result without a score of its uncertainty has no correlation to state.
    score.correlation_known = point.correlation.has_value() || (!point.En.number && !point.zeta.number);
    score.is_signal = point.signal != "inconclusive" && point.signal != "none";
    score.is_without_objection = is_without_objection(comparison, point);
    return score;
}

AuditedItem audited_item(const reports::ComparisonItemEvaluation& stated) {
    AuditedItem item;
    item.name = name_in_round(stated.name.empty() ? stated.id : stated.name, stated.round);
    item.has_stability = stated.u_stability.number.has_value() || (stated.stability && stated.stability->stable);
    item.inconsistent = stated.not_consistent;
    if (stated.consistency) {
        const reports::ConsistencySummary& test = *stated.consistency;
        item.p_consistent = test.p_value.number;
        item.threshold = test.alpha;
        item.by_chance = test.by_chance;
        // What a subset has left out of the test makes it too good.
        if (item.inconsistent.empty() && test.degrees_of_freedom > 0) {
            // Of the stated uncertainties: what the items add is none that a laboratory has stated too large.
            item.p_low = gum::chi_square_lower_tail(test.chi_square_of_statements.value_or(test.chi_square.number),
                                                    static_cast<double>(test.degrees_of_freedom));
        }
    }
    return item;
}

AuditedComparison comparison_of(const reports::Comparison& stated) {
    AuditedComparison comparison;
    comparison.between_laboratories = stated.form == "laboratories";
    comparison.score_probability = stated.score_probability;
    for (const reports::ComparisonPoint& point : stated.points) {
        if (point.En.number || point.zeta.number || point.z.number) {
            comparison.scores.push_back(score_of(stated, point));
        }
    }
    if (!stated.summary.empty()) {
        comparison.p_low = stated.summary.back().p_low.number;
        comparison.p_high = stated.summary.back().p_high.number;
    }
    for (const reports::SharedSource& shared : stated.shared_sources) {
        comparison.shared_sources.push_back(shared.source);
    }
    for (const reports::ComparisonItemEvaluation& item : stated.items) {
        comparison.items.push_back(audited_item(item));
        comparison.items.back().has_stability |= !stated.artefact_stability.empty();
    }
    comparison.instability_in_reference = !stated.artefact_stability.empty();
    return comparison;
}

std::size_t point_with_largest_score(const reports::Comparison& comparison) {
    const auto score = [](const reports::ComparisonPoint& point) { return std::abs(point.En.number.value_or(0.0)); };
    return static_cast<std::size_t>(
        std::max_element(comparison.points.begin(), comparison.points.end(),
                         [&](const auto& a, const auto& b) { return score(a) < score(b); }) -
        comparison.points.begin());
}

/// The budget of one side of a comparison, where the record holds it: what correcting it does to E_n is seen at one point.
/// \param side  with its rows, name and place
/// \param at    position of the point
void add_side(AuditSubject& subject, const reports::Comparison& comparison, AuditedBudget side, bool is_reference,
              std::size_t at) {
    if (side.rows.empty() || at >= comparison.points.size()) {
        return;
    }
    const reports::ComparisonPoint& point = comparison.points[at];
    if (!point.U.number || !point.reference_U.number) {
        return;
    }
    const double U = is_reference ? *point.reference_U.number : *point.U.number;
    const double other_U = is_reference ? *point.U.number : *point.reference_U.number;
    side.value = is_reference ? point.reference_value.number : point.value.number;
    side.reference = ComparedReference{.value = is_reference ? point.value.number : point.reference_value.number,
                                       .expanded_uncertainty = other_U,
                                       .correlation = point.correlation.value_or(0.0),
                                       .name = is_reference ? comparison.method_name : comparison.reference_name,
                                       .point = at,
                                       .budget_is_reference = is_reference};
    const reports::ComparisonPoint& largest = comparison.points[point_with_largest_score(comparison)];
    if (point.En.number && std::abs(largest.En.number.value_or(0.0)) > std::abs(*point.En.number)) {
        side.reference->largest_difference = difference_of_score(*largest.En.number, U, *side.reference);
    }
    const double u = is_reference ? point.reference_u.value_or(0.0) : point.u.value_or(0.0);
    if (u > 0.0) {
        side.coverage = {.kind = CoverageRule::Kind::fixed, .k = U / u, .probability = comparison.score_probability};
        side.claims.k = exact_number(U / u, side.place);
        side.claims.coverage_probability = comparison.score_probability;
        // The rows are those of a typical value; this point has its own u and ν, and the difference stays.
        side.correlation_variance = u * u - variance_of_rows(side);
        if (!is_reference && point.nu) {
            side.fourth_powers_beyond_rows = std::max(0.0, u * u * u * u / *point.nu - fourth_powers_of_rows(side));
            side.claims.nu_eff = exact_number(*point.nu, side.place);
        }
    }
    side.claims.U = exact_number(U, side.place);
    side.claims.en = point.En.number ? std::optional(exact_number(*point.En.number, side.place)) : std::nullopt;
    subject.budgets.push_back(std::move(side));
}

/// \param job  what is stated of the inputs; nullptr where the rows are no inputs of a job
AuditedBudget side_of(const reports::Comparison& comparison, const std::vector<reports::BudgetRow>& rows,
                      const std::string& name, const std::string& place, const JobStatements* job = nullptr) {
    AuditedBudget side;
    side.name = name;
    side.unit = comparison.unit;
    side.place = place;
    side.evaluated_here = true;
    add_rows(side, rows, place, nullptr, job, "");
    if (job != nullptr) {
        side.inputs_with_correlation = job->inputs_with_correlation();
    }
    return side;
}

/// What the budget of the reference method of a rotary table states of its inputs: a file of the job.
JobStatements statements_of_reference(const reports::EvaluationRecord& record) {
    const json job = json::parse(record.job_json, nullptr, false);
    const json file = job.is_object() ? job.value(json::json_pointer("/reference_method/budget"), json()) : json();
    reports::EvaluationRecord of_reference;
    of_reference.job_files = record.job_files;
    for (const reports::InputFile& held : record.job_files) {
        if (file.is_string() && held.name == file.get_ref<const std::string&>()) {
            of_reference.job_json = reports::bytes_of(held).value_or("");
        }
    }
    return JobStatements(of_reference);
}

/// The waivers of a certificate that have effect; of another record those that its audit shows beside its findings.
std::vector<certificate::Waiver> waivers_of(const reports::EvaluationRecord& record) {
    std::vector<certificate::Waiver> waivers;
    if (record.certificate) {
        const certificate::CertificateData& data = record.certificate->data;
        std::copy_if(data.waivers.begin(), data.waivers.end(), std::back_inserter(waivers),
                     [&data](const auto& waiver) { return certificate::has_effect(waiver, data.dates.issued); });
        return waivers;
    }
    const json audit = json::parse(record.audit_json, nullptr, false);
    if (!audit.is_object() || !audit.contains("findings") || !audit.at("findings").is_array()) {
        return waivers;
    }
    for (const json& finding : audit.at("findings")) {
        const auto text = [](const json& object, const char* key) {
            const auto found = object.find(key);
            return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
        };
        if (finding.is_object() && finding.contains("waiver") && finding.at("waiver").is_object()) {
            const json& waiver = finding.at("waiver");
            waivers.push_back({.finding = text(finding, "id"),
                               .where = text(finding, "where"),
                               .by = text(waiver, "by"),
                               .date = text(waiver, "when"),
                               .reason = text(waiver, "reason")});
        }
    }
    return waivers;
}

}  // namespace

AuditSubject subject_of(const reports::EvaluationRecord& record, const std::string& name,
                        std::optional<std::size_t> compared_point) {
    AuditSubject subject;
    subject.kind = AuditSubject::Kind::record;
    subject.name = name;
    subject.certificate = record.certificate;
    subject.waivers = waivers_of(record);
    const JobStatements job(record);
    CertifiedValues certified(subject.certificate);
    for (const reports::Result& result : record.results) {
        if (!result.budget.empty()) {
            subject.budgets.push_back(budget_of(record, result, job, certified));
        }
    }
    if (record.comparison) {
        subject.comparison = comparison_of(*record.comparison);
        const reports::Comparison& comparison = *record.comparison;
        AuditedBudget method =
            side_of(comparison, comparison.method_budget,
                    comparison.method_name.empty() ? "displacement of the contact point" : comparison.method_name,
                    "/comparison/method_budget");
        const JobStatements of_reference = statements_of_reference(record);
        const std::size_t at = compared_point.value_or(point_with_largest_score(comparison));
        add_side(subject, comparison, std::move(method), false, at);
        add_side(subject, comparison,
                 side_of(comparison, comparison.reference_budget, comparison.reference_name,
                         "/comparison/reference_budget", &of_reference),
                 true, at);
    }
    return subject;
}

}  // namespace gumcert::audit
