#include "reports/audit/audit_view.h"

#include "audit/correction_effect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "audit/checklists.h"
#include "audit/claims.h"
#include "audit/severity.h"
#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/printable_text.h"
#include "text/numbers.h"

namespace gumcert::reports {
namespace {

using audit::AuditedBudget;
using audit::AuditedRow;
using audit::BudgetOutcome;
using audit::Contributor;

constexpr int k_digits = 3;  // of numbers that stand alone

std::string rounded(double number, int digits = k_digits) {
    return std::isfinite(number) ? gum::round_significant(number, digits) : number > 0.0 ? "∞" : "";
}

std::string printed_nu(double nu) {
    return std::isfinite(nu) ? certificate::printed_degrees_of_freedom(nu) : "∞";
}

std::string printed_k(double k) {
    return std::isfinite(k) ? gum::round_to_quantum(k, 2) : "∞";
}

std::string signed_percent(double share) {
    if (!std::isfinite(share)) {
        return share > 0.0 ? "+∞" : "";
    }
    const std::string text = gum::percent(std::abs(share));
    return text == "0.0" ? text : (share > 0.0 ? "+" : "-") + text;
}

/// Of the shortest text that gives the number.
std::ptrdiff_t significant_digits(double number) {
    const std::string all = text::shortest(number);
    const std::string_view digits = std::string_view(all).substr(0, all.find('e'));
    const std::size_t first = digits.find_first_of("123456789");
    return first == digits.npos ? 0
                                : std::count_if(digits.begin() + static_cast<std::ptrdiff_t>(first), digits.end(),
                                                [](char c) { return c != '.'; });
}

/// A number without a text, of a record: as it was typed into the job where it has `most` significant digits at most. What was
/// computed has more, and is rounded to `digits`.
std::string typed_or_rounded(double number, int most, int digits) {
    if (!std::isfinite(number)) {
        return "∞";
    }
    return significant_digits(number) <= most ? text::shortest_plain(number)
                                              : text::without_trailing_zeros(gum::round_significant(number, digits));
}

/// The number as the file prints it.
std::string stated_text(const std::optional<audit::StatedNumber>& number) {
    constexpr int k_most = 10;
    return !number                ? ""
           : number->text.empty() ? typed_or_rounded(number->value, k_most, k_most)
                                  : printable(audit::text_of_claim(*number));
}

/// The same of an uncertainty or a sensitivity.
std::string stated_part(const std::optional<audit::StatedNumber>& number, double used) {
    constexpr int k_most = 6;
    return number && !number->text.empty() ? printable(audit::text_of_claim(*number))
                                           : typed_or_rounded(number ? number->value : used, k_most, k_digits);
}

PrintedOutcome printed(const BudgetOutcome& outcome, const audit::Claims* claims = nullptr) {
    PrintedOutcome all{.number = outcome,
                       .value = printable(outcome.printed_value),
                       .u_c = rounded(outcome.u_c),
                       .nu_eff = printed_nu(outcome.nu_eff),
                       .k = printed_k(outcome.k),
                       .U = printable(outcome.printed_U),
                       .En = outcome.en ? gum::round_to_quantum(*outcome.en, 2) : "",
                       .verdict = printable(outcome.verdict)};
    if (claims != nullptr) {
        // A number without a text was computed here: it is rounded like the others beside it.
        const auto take = [](const std::optional<audit::StatedNumber>& claim, std::string& text) {
            text = claim && !claim->text.empty() ? printable(audit::text_of_claim(*claim)) : text;
        };
        take(claims->value, all.value);
        take(claims->u_c, all.u_c);
        take(claims->nu_eff, all.nu_eff);
        take(claims->k, all.k);
        take(claims->U, all.U);
        take(claims->en, all.En);
        // What is an error in the file is no number of it, also where the rows give one.
        const auto leave = [](const std::string& broken, std::string& text, double& number) {
            if (!broken.empty()) {
                text = "–";
                number = std::numeric_limits<double>::quiet_NaN();
            }
        };
        leave(claims->broken.u_c, all.u_c, all.number.u_c);
        leave(claims->broken.nu_eff, all.nu_eff, all.number.nu_eff);
        leave(claims->broken.k, all.k, all.number.k);
        leave(claims->broken.U, all.U, all.number.U);
        if (!claims->broken.value.empty()) {
            all.value.clear();
            all.number.value.reset();
        }
    }
    return all;
}

PrintedInterval printed(const audit::Interval& interval, std::string (*text)(double)) {
    return {.number = interval, .low = text(interval.low), .high = text(interval.high)};
}

const char* name_of(audit::Shape shape) {
    switch (shape) {
        case audit::Shape::normal:
            return "normal";
        case audit::Shape::student_t:
            return "student_t";
        case audit::Shape::rectangular:
            return "uniform";
        case audit::Shape::triangular:
            return "triangular";
        case audit::Shape::arcsine:
            return "arcsine";
        case audit::Shape::trapezoidal:
            return "trapezoidal";
        default:
            return "";
    }
}

const char* name_of(audit::CoverageRule::Kind kind) {
    switch (kind) {
        case audit::CoverageRule::Kind::fixed:
            return "fixed";
        case audit::CoverageRule::Kind::student_t:
            return "student_t";
        case audit::CoverageRule::Kind::convolution:
            return "convolution";
    }
    return "";
}

const char* name_of(audit::AuditSubject::Kind kind) {
    switch (kind) {
        case audit::AuditSubject::Kind::job:
            return "job";
        case audit::AuditSubject::Kind::record:
            return "record";
        case audit::AuditSubject::Kind::table:
            return "table";
        case audit::AuditSubject::Kind::workbook:
            return "workbook";
        case audit::AuditSubject::Kind::certificate:
            return "certificate";
    }
    return "";
}

const char* name_of(audit::FindingSeverity severity) {
    return k_audit_severities[3 - static_cast<std::size_t>(severity)];
}

std::string unit_text(const std::string& unit) {
    return printable(gum::unit_for_people(unit));
}

AuditedRowView row_view(const AuditedRow& row, double sum_of_squares) {
    const double part = contribution_of(row);
    AuditedRowView view{.quantity = printable(row.quantity),
                        .unit = unit_text(row.unit),
                        .estimate = stated_text(row.estimate),
                        .stated = stated_text(row.stated),
                        .divisor = stated_text(row.divisor),
                        .u = stated_part(row.u, row.used_u),
                        .sensitivity = stated_part(row.sensitivity, row.used_sensitivity),
                        .nu = !row.nu                ? ""
                              : row.nu->text.empty() ? printed_nu(row.nu->value)
                                                     : printable(audit::text_of_claim(*row.nu)),
                        .source = printable(row.source),
                        .comment = printable(row.comment),
                        .place = printable(row.place),
                        .shape = printable(row.shape_text),
                        .shape_name = name_of(row.shape),
                        .contribution = part,
                        .contribution_text = rounded(part),
                        .share = part * part / sum_of_squares,
                        .share_percent = "",
                        .in_sum = row.in_sum,
                        .findings = {}};
    view.share_percent = gum::percent(view.share);
    if (view.divisor.empty() && row.certificate_k) {
        view.divisor = text::shortest_plain(*row.certificate_k);
    }
    return view;
}

/// Whether a finding is about a row: its place begins with that of the row, up to the end or a sign that ends a place.
bool is_about_row(const std::string& where, const std::string& place) {
    return !place.empty() && where.starts_with(place) &&
           (where.size() == place.size() || where[place.size()] == ' ' || where[place.size()] == ',' ||
            where[place.size()] == '/');
}

/// What every budget has to name, in the order of the page, by the id of its wording and by one kind of row that it is.
struct ContributorKind {
    const char* id;
    Contributor one;
};
constexpr std::array<ContributorKind, 6> k_contributor_kinds{{{"reference", Contributor::reference},
                                                              {"stability", Contributor::reference_drift},
                                                              {"resolution", Contributor::item_resolution},
                                                              {"repeatability", Contributor::repeatability},
                                                              {"reproducibility", Contributor::reproducibility},
                                                              {"environment", Contributor::environment}}};

/// The contributor of audit::minimum_contributors() that a kind is: page and rule B01 look for the same rows.
const audit::RequiredContributor& required_of(const ContributorKind& kind) {
    const std::span<const audit::RequiredContributor> all = audit::minimum_contributors();
    return *std::find_if(all.begin(), all.end(), [&kind](const audit::RequiredContributor& required) {
        return std::find(required.by.begin(), required.by.end(), kind.one) != required.by.end();
    });
}

/// \param names  of the rows of the budget
ContributorView contributor_view(const ContributorKind& kind, const AuditedBudget& budget,
                                 const std::vector<audit::NamedRow>& names, double sum_of_squares) {
    ContributorView view;
    view.id = kind.id;
    const audit::RequiredContributor& required = required_of(kind);
    double squares = 0.0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!names[i].stands_for(required)) {
            continue;
        }
        const AuditedRow& row = budget.rows[i];
        view.rows.push_back(printable(row.quantity));
        const double part = contribution_of(row);
        squares += part * part;
        if (part == 0.0 && !row.comment.empty()) {
            view.reason += (view.reason.empty() ? "" : "; ") + printable(row.comment);
        }
    }
    view.contribution = std::sqrt(squares);
    if (!view.rows.empty()) {
        view.contribution_text = rounded(view.contribution);
        view.share_percent = gum::percent(squares / sum_of_squares);
    }
    return view;
}

/// A capability, limit or reference of a budget.
std::string plain_number(const std::optional<double>& number) {
    return number ? typed_or_rounded(*number, 10, 10) : "";
}

AuditedResultView::Claim claim_of(const std::optional<audit::StatedNumber>& claim, bool is_outside) {
    return {.stated = claim.has_value(), .allowed = !claim || !is_outside};
}

AuditedResultView result_view(const audit::AuditedResult& result, const AuditedBudget& budget) {
    AuditedResultView view;
    view.name = printable(result.name);
    view.unit = unit_text(result.unit);
    view.place = printable(budget.place);
    view.equation = printable(budget.equation);
    view.method = printable(audit::method_in_words(budget.method));
    view.capability = plain_number(budget.capability);
    view.capability_number = budget.capability;
    view.coverage = budget.coverage.k_of_nu ? "of_sheet" : name_of(budget.coverage.kind);
    if (budget.coverage.kind == audit::CoverageRule::Kind::fixed) {
        view.stated_k = typed_or_rounded(budget.coverage.k, 6, k_digits);
    } else {
        view.coverage_probability = text::without_trailing_zeros(text::fixed(100.0 * budget.coverage.probability, 2));
    }
    view.lower_limit = plain_number(budget.limits.lower);
    view.upper_limit = plain_number(budget.limits.upper);
    if (budget.reference) {
        view.reference_name = printable(budget.reference->name);
        view.reference_value = plain_number(budget.reference->value);
        view.reference_U = plain_number(budget.reference->expanded_uncertainty);
    }
    view.claimed = printed(result.claimed, &budget.claims);
    view.recomputed = printed(result.recomputed);
    view.audited = printed(result.audited);
    const auto three_digits = [](double number) { return rounded(number); };
    view.u_c = printed(result.allowed.u_c, three_digits);
    view.nu_eff = printed(result.allowed.nu_eff, printed_nu);
    view.k = printed(result.allowed.k, printed_k);
    view.U = printed(result.allowed.U, three_digits);
    // A result of a certificate has no rows, of which ν_eff could be computed again.
    if (budget.rows.empty() && !budget.evaluated_here) {
        for (PrintedOutcome* outcome : {&view.recomputed, &view.audited}) {
            outcome->nu_eff = "–";
            outcome->number.nu_eff = std::numeric_limits<double>::quiet_NaN();
        }
        view.nu_eff.low = view.nu_eff.high = "–";
        view.nu_eff.number = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
        if (!budget.claims.nu_eff) {
            view.claimed.nu_eff = "–";
            view.claimed.number.nu_eff = std::numeric_limits<double>::quiet_NaN();
        }
    }
    // By the same look as rule K01. What was evaluated here needs none: its sum and its k come from the evaluation.
    const audit::ClaimCheck check = budget.evaluated_here ? audit::ClaimCheck{} : audit::check_claims(budget);
    view.claim_u_c = claim_of(budget.claims.u_c, check.u_c_outside);
    view.claim_nu_eff = claim_of(budget.claims.nu_eff, check.nu_eff_apart && !budget.rows.empty());
    view.claim_k = claim_of(budget.claims.k, check.k_outside);
    view.claim_U = claim_of(budget.claims.U, check.U_outside);
    view.change = change_of(result.claimed, result.audited);
    if (result.unrounded_U > 0.0) {
        // From the same number as the effects of corrections, whose shares then add up to it: rounding of the claim is
        // no error.
        view.change.relative = result.audited.U / result.unrounded_U - 1.0;
        view.change.percent = signed_percent(view.change.relative);
        constexpr double k_no_percent = 5e-4;  // what prints as 0.0 %
        if (std::abs(view.change.relative) < k_no_percent) {
            view.change.direction = "unchanged";  // nothing was corrected: what is stated stands
        }
    }
    if (budget.rests_on_trials && !budget.claims.U && view.change.direction == "unchanged") {
        view.change.direction = "interval";
    }
    if (!budget.claims.broken.U.empty()) {
        view.change.percent = "–";
        view.change.direction = "not_stated";
    }
    view.sampled_shares = result.sampled_shares;
    view.is_nested = result.is_nested;
    view.budget_U_number = result.recomputed.k * result.recomputed.u_c;
    view.budget_U = rounded(view.budget_U_number, 2);

    const double squares = std::accumulate(
        budget.rows.begin(), budget.rows.end(), 0.0,
        [](double sum, const AuditedRow& row) { return sum + contribution_of(row) * contribution_of(row); });
    // A budget has an outcome where its rows add up to more than 0, or its claim does.
    const double whole = squares > 0.0 ? squares : 1.0;
    for (const AuditedRow& row : budget.rows) {
        view.rows.push_back(row_view(row, whole));
    }
    std::stable_sort(view.rows.begin(), view.rows.end(),
                     [](const AuditedRowView& a, const AuditedRowView& b) { return a.contribution > b.contribution; });
    const std::vector<audit::NamedRow> names(budget.rows.begin(), budget.rows.end());
    for (const ContributorKind& kind : k_contributor_kinds) {
        view.contributors.push_back(contributor_view(kind, budget, names, whole));
    }
    return view;
}

/// How much the corrections change a result: a result of the file before a nested one, a decision before U; of those that
/// change alike, the one with the largest |E_n|.
using RankOfResult = std::tuple<bool, bool, double, double>;

RankOfResult rank_of(const AuditedResultView& result) {
    return {!result.is_nested, result.change.decision_turns(),
            audit::size_of_change(result.claimed.number.U, result.audited.number.U),
            std::round(1e9 * std::abs(result.claimed.number.en.value_or(0.0)))};
}

std::string form_of(const certificate::ScopeEntry& entry) {
    const certificate::Capability& capability = entry.capability;
    const std::string unit = capability.unit.empty() ? "" : " " + unit_text(capability.unit);
    if (capability.form == "value") {
        return text::shortest_plain(capability.U) + unit;
    }
    return capability.form == "function" ? printable(capability.expression) + unit : capability.form;
}

AuditedFileView::ScopeLine scope_line(const certificate::ScopeEntry& entry) {
    AuditedFileView::ScopeLine line{.id = printable(entry.id),
                                    .measurand = printable(entry.measurand.in("en")),
                                    .range = "",
                                    .form = form_of(entry)};
    for (const certificate::ScopeEntry::Range& range : entry.ranges) {
        const std::string unit = unit_text(range.argument.unit);
        line.range += (line.range.empty() ? "" : "; ") + text::shortest_plain(range.low) + " … " +
                      text::shortest_plain(range.high) + (unit.empty() ? "" : " " + unit);
    }
    return line;
}

const audit::Rule* rule_of(const std::string& id, std::span<const audit::Rule> rules) {
    const auto found =
        std::find_if(rules.begin(), rules.end(), [&id](const audit::Rule& rule) { return rule.id == id; });
    return found == rules.end() ? nullptr : &*found;
}

audit::Sentence printable_sentence(const audit::Sentence& sentence) {
    return sentence.with_texts(printable);
}

PrintedWaiver printed_waiver(const certificate::Waiver& waiver) {
    return {.rule = printable(waiver.finding),
            .where = printable(waiver.where),
            .by = printable(waiver.by),
            .when = printable(waiver.date),
            .reason = printable(waiver.reason.in("en"))};
}

/// Position of the waiver of a finding among those that are printed.
std::optional<std::size_t> position_of_waiver(const audit::AuditFinding& finding, const audit::AuditReport& report,
                                              const std::vector<PrintedWaiver>& printed) {
    const certificate::Waiver* waiver = audit::waiver_of(finding, report.subject.waivers);
    if (waiver == nullptr) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(std::find(printed.begin(), printed.end(), printed_waiver(*waiver)) -
                                    printed.begin());
}

/// Positions of results by positions of budgets; of two results of a budget the first. A finding may name every budget.
using ResultOfBudget = std::unordered_map<std::size_t, std::size_t>;

ResultOfBudget results_by_budget(const audit::AuditReport& report) {
    ResultOfBudget results;
    for (std::size_t i = 0; i < report.results.size(); ++i) {
        results.emplace(report.results[i].budget, i);
    }
    return results;
}

EffectView effect_view(const audit::Effect& effect, const ResultOfBudget& result_of) {
    const auto result = result_of.find(effect.budget);
    return {.claimed = printed(effect.claimed),
            .alone = printed(effect.alone),
            .last = printed(effect.last),
            .audited = printed(effect.audited),
            .share = effect.share,
            .share_percent = signed_percent(effect.share),
            .change_alone = change_of(effect.claimed, effect.alone),
            .change_last = change_of(effect.last, effect.audited),
            .result = result == result_of.end() ? 0 : result->second};
}

AuditFindingView finding_view(const audit::AuditFinding& finding, const audit::AuditReport& report,
                              const ResultOfBudget& result_of, std::span<const audit::Rule> rules,
                              const std::vector<PrintedWaiver>& waivers) {
    AuditFindingView view;
    view.id = printable(finding.rule);
    if (const audit::Rule* rule = rule_of(finding.rule, rules)) {
        view.title = rule->title;
        view.clause = rule->clause.text;
        view.clause_verified = rule->clause.verified;
    }
    view.severity = name_of(finding.severity);
    view.where = printable(finding.where);
    view.what = printable_sentence(finding.what);
    view.expected = printable_sentence(finding.expected);
    view.actual = printable_sentence(finding.actual);
    view.correction = printable(finding.correction);
    view.question = printable(finding.question);
    for (const audit::Sentence& evidence : finding.evidence) {
        view.evidence.push_back(printable_sentence(evidence));
    }
    std::unordered_set<std::size_t> named;
    for (const std::size_t budget : finding.budgets) {
        const auto result = result_of.find(budget);
        if (result != result_of.end() && named.insert(result->second).second) {
            view.results.push_back(result->second);
        }
    }
    if (finding.effect) {
        view.effect = effect_view(*finding.effect, result_of);
    }
    if (finding.effect_on_score) {
        view.effect_on_score = effect_view(*finding.effect_on_score, result_of);
    }
    if (finding.missing_term) {
        const audit::MissingTerm& term = *finding.missing_term;
        view.missing_term = MissingTermView{
            .number = term,
            .u_for_digit = rounded(term.u_for_digit, 2),
            .u_for_verdict = term.u_for_verdict ? rounded(*term.u_for_verdict, 2) : "",
            .unit = finding.budgets.empty() ? "" : unit_text(report.subject.budgets[finding.budgets.front()].unit)};
    }
    view.waiver = position_of_waiver(finding, report, waivers);
    return view;
}

void tie_findings_to_results(AuditedFileView& file) {
    for (std::size_t i = 0; i < file.findings.size(); ++i) {
        for (const std::size_t at : file.findings[i].results) {
            AuditedResultView& result = file.results[at];
            result.findings.push_back(i);
            for (AuditedRowView& row : result.rows) {
                if (is_about_row(file.findings[i].where, row.place)) {
                    row.findings.push_back(i);
                }
            }
        }
    }
}

/// What is known of the law of propagation against Monte Carlo.
std::vector<RuleAnswer> linearity_of(const AuditedFileView& file, const audit::AuditReport& report,
                                     std::span<const audit::Rule> rules) {
    std::vector<RuleAnswer> answers;
    for (const char* rule : {"S04", "S05", "S06", "S07", "S18", "S19"}) {
        for (const AuditFindingView& finding : file.findings) {
            if (finding.id == rule) {
                answers.push_back({.id = finding.id, .title = finding.title, .answer = finding.what});
            }
        }
        for (const NotCheckedView& one : file.not_checked) {
            if (one.id == rule) {
                answers.push_back({.id = one.id, .title = one.title, .answer = one.because});
            }
        }
        for (const audit::RuleNote& note : report.notes) {
            if (const audit::Rule* of = note.rule == rule ? rule_of(note.rule, rules) : nullptr) {
                answers.push_back({.id = printable(note.rule),
                                   .title = std::string(of->title),
                                   .answer = printable_sentence(note.what)});
            }
        }
    }
    return answers;
}

/// The gravest finding, 0 for none; then the worst result.
std::pair<std::size_t, RankOfResult> rank_of(const AuditedFileView& file) {
    std::size_t gravest = 0;
    for (std::size_t i = 0; i < file.counts.size() && gravest == 0; ++i) {
        gravest = file.counts[i] > 0 ? file.counts.size() - i : 0;
    }
    RankOfResult worst = file.results.empty() ? RankOfResult() : rank_of(file.results[file.worst]);
    std::get<0>(worst) = true;  // a file is as grave whosever its worst result is
    return {gravest, worst};
}

/// The position of a waiver among those of others, to which it is added where it is not there yet.
std::size_t add_waiver(PrintedWaiver waiver, std::vector<PrintedWaiver>& waivers) {
    const auto same = std::find(waivers.begin(), waivers.end(), waiver);
    if (same != waivers.end()) {
        return static_cast<std::size_t>(same - waivers.begin());
    }
    waivers.push_back(std::move(waiver));
    return waivers.size() - 1;
}

}  // namespace

std::size_t AuditedFileView::own_results() const {
    return static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(), [](const AuditedResultView& one) { return !one.is_nested; }));
}

std::vector<std::string> english_of(const std::vector<audit::Sentence>& sentences) {
    std::vector<std::string> all;
    all.reserve(sentences.size());
    for (const audit::Sentence& sentence : sentences) {
        all.push_back(sentence.english());
    }
    return all;
}

Change change_of(const BudgetOutcome& before, const BudgetOutcome& after) {
    Change change;
    change.relative = after.U / before.U - 1.0;
    change.percent = signed_percent(change.relative);
    // direction_in_words() says "U understated"; forms put the word into their own language.
    change.direction = audit::direction_in_words(before, after).substr(2);
    change.verdict_turns = audit::verdict_turns(before.verdict, after.verdict);
    change.En_crosses_one = before.en && after.en && (std::abs(*before.en) > 1.0) != (std::abs(*after.en) > 1.0);
    return change;
}

AuditedRowView summed_rows(const AuditedResultView& result, std::size_t from) {
    AuditedRowView sum;
    double squares = 0.0;
    for (std::size_t i = from; i < result.rows.size(); ++i) {
        squares += result.rows[i].contribution * result.rows[i].contribution;
        sum.share += result.rows[i].share;
    }
    sum.contribution = std::sqrt(squares);
    sum.contribution_text = rounded(sum.contribution);
    sum.share_percent = gum::percent(sum.share);
    return sum;
}

void run_tasks(const TaskRunner& run, std::size_t n, const std::function<void(std::size_t)>& task) {
    if (run) {
        run(n, task);
        return;
    }
    for (std::size_t i = 0; i < n; ++i) {
        task(i);
    }
}

AuditedFileView make_file_view(const audit::AuditReport& report, std::span<const audit::Rule> rules,
                               const std::string& sha256) {
    AuditedFileView file;
    file.sha256 = printable(sha256);
    for (const certificate::Waiver& waiver : report.subject.waivers) {
        add_waiver(printed_waiver(waiver), file.waivers);
    }
    file.name = printable(report.subject.name);
    file.kind = name_of(report.subject.kind);
    if (report.subject.certificate) {
        const certificate::CertificateData& data = report.subject.certificate->data;
        if (data.accreditation) {
            for (const certificate::ScopeEntry& entry : data.accreditation->scope) {
                file.scope.push_back(scope_line(entry));
            }
        }
        file.method = printable(data.method.identification) +
                      (data.method.version.empty() ? "" : " (" + printable(data.method.version) + ")");
    }
    for (const audit::AuditedResult& result : report.results) {
        file.results.push_back(result_view(result, report.subject.budgets[result.budget]));
        file.sampled_shares = file.sampled_shares || result.sampled_shares;
    }
    for (std::size_t i = 1; i < file.results.size(); ++i) {
        file.worst = rank_of(file.results[i]) > rank_of(file.results[file.worst]) ? i : file.worst;
    }
    const ResultOfBudget result_of = results_by_budget(report);
    for (const audit::AuditFinding& finding : report.findings) {
        file.findings.push_back(finding_view(finding, report, result_of, rules, file.waivers));
        ++file.counts[3 - static_cast<std::size_t>(finding.severity)];
        const std::string& question = file.findings.back().question;
        if (question.empty()) {
            continue;
        }
        const auto asked = std::find_if(file.questions.begin(), file.questions.end(),
                                        [&question](const QuestionView& one) { return one.question == question; });
        if (asked == file.questions.end()) {
            file.questions.push_back({.question = question, .findings = {file.findings.size() - 1}});
        } else {
            asked->findings.push_back(file.findings.size() - 1);
        }
    }
    tie_findings_to_results(file);
    for (const audit::RuleNotChecked& one : report.not_checked) {
        const audit::Rule* rule = rule_of(one.rule, rules);
        file.not_checked.push_back({.id = printable(one.rule),
                                    .title = rule == nullptr ? "" : std::string(rule->title),
                                    .because = printable_sentence(one.because)});
    }
    file.linearity = linearity_of(file, report, rules);
    for (const audit::Sentence& sentence : report.subject.not_read) {
        file.not_read.push_back(printable_sentence(sentence));
    }
    return file;
}

void add_not_read(AuditedFileView& file, const audit::Sentence& sentence) {
    file.not_read.push_back(printable_sentence(sentence));
}

AuditView make_audit_view(std::vector<AuditedFileView> files, const AuditContext& context) {
    AuditView view;
    view.program = printable(context.program);
    view.files = std::move(files);
    for (AuditedFileView& file : view.files) {
        std::vector<std::size_t> position_of;
        for (PrintedWaiver& waiver : file.waivers) {
            position_of.push_back(add_waiver(std::move(waiver), view.waivers));
        }
        file.waivers.clear();
        for (AuditFindingView& finding : file.findings) {
            finding.waiver = finding.waiver ? std::optional(position_of[*finding.waiver]) : std::nullopt;
        }
    }
    for (std::size_t i = 0; i < view.files.size(); ++i) {
        view.worst = rank_of(view.files[i]) > rank_of(view.files[view.worst]) ? i : view.worst;
    }
    for (const UnauditedFile& one : context.unaudited) {
        view.unaudited.push_back({.kind = one.kind, .file = printable(one.file), .because = printable(one.because)});
    }
    return view;
}

AuditView make_audit_view(std::span<const audit::AuditReport> reports, std::span<const audit::Rule> rules,
                          const AuditContext& context, const TaskRunner& run) {
    std::vector<AuditedFileView> files(reports.size());
    run_tasks(run, reports.size(), [&](std::size_t i) {
        files[i] = make_file_view(reports[i], rules, i < context.digests.size() ? context.digests[i] : "");
    });
    return make_audit_view(std::move(files), context);
}

}  // namespace gumcert::reports
