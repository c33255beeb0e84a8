#include "audit/sources/certificate_subject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/budget_outcome.h"
#include "audit/finding.h"
#include "audit/word_line.h"
#include "audit/words/stated_rule.h"
#include "certificate/stated_text.h"
#include "gum/conformity/decision_rule.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "reports/dcc/dcc_certificate_data.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

using reports::ImportedNumber;
using reports::ImportedQuantity;

constexpr double k_usual_probability = 0.9545;

std::string unit_stated(const ImportedNumber& number) {
    return number.unit.empty() ? number.d_si_unit : number.unit;
}

/// A number of the document as its rules look at it; nothing where it has none.
std::optional<StatedNumber> number_stated(const std::string& text, const std::string& place) {
    return text.empty() ? std::nullopt : read_number(text, place);
}

/// A number in another unit of the same kind; nothing where one cannot be turned into the other.
std::optional<double> in_unit(double number, const std::string& from, const std::string& to) {
    if (from == to) {
        return number;
    }
    try {
        const gum::Unit source = gum::Unit::parse(from), target = gum::Unit::parse(to);
        if (source.dimension() == target.dimension() &&
            source.is_celsius_temperature() == target.is_celsius_temperature()) {
            return target.from_si(source.to_si(number));
        }
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
    return std::nullopt;
}

/// Digits of a printed U, which its value and its verdict are printed with.
int digits_of(const StatedNumber& U) {
    if (!(U.half_step > 0.0) || !(U.value > 0.0)) {
        return 2;
    }
    const double places = std::floor(std::log10(U.value)) - std::round(std::log10(2.0 * U.half_step)) + 1.0;
    return places < 1.5 ? 1 : 2;
}

/// Limits beside a result, in its unit.
struct LimitsBeside {
    gum::ToleranceLimits tolerance, acceptance;
    bool other_unit = false;  ///< there are some that cannot be converted
};

/// One result with what stands in the document about it.
class Results {
public:
    Results(const reports::ImportedCertificate& certificate, std::vector<reports::DccStatement> statements,
            AuditSubject& subject)
        : certificate_(certificate), statements_(std::move(statements)), subject_(subject) {}

    void read();

private:
    [[nodiscard]] std::string point_of(const ImportedQuantity& quantity) const;
    [[nodiscard]] LimitsBeside limits_of(std::size_t position) const;
    [[nodiscard]] std::optional<StatedNumber> degrees_of_freedom_of(const ImportedQuantity& quantity) const;
    [[nodiscard]] AuditedBudget budget_of(std::size_t position);
    void state_conformity(const ImportedQuantity& quantity, const LimitsBeside& limits, AuditedBudget& budget);
    void tell(Sentence sentence) {
        if (std::find(subject_.not_read.begin(), subject_.not_read.end(), sentence) == subject_.not_read.end()) {
            subject_.not_read.push_back(std::move(sentence));
        }
    }

    const reports::ImportedCertificate& certificate_;
    std::vector<reports::DccStatement> statements_;
    AuditSubject& subject_;
};

/// "306.248 K", "upper end", or "row 2" in a table; "" outside of one.
std::string Results::point_of(const ImportedQuantity& quantity) const {
    if (!quantity.row) {
        return "";
    }
    for (const reports::ImportedWords& words : certificate_.words) {
        if (quantity.table > 0 && words.table == quantity.table && *quantity.row < words.words.size()) {
            return words.words[*quantity.row];
        }
    }
    for (const char* column : {"*nominalvalue", "*referencevalue"}) {
        for (const ImportedQuantity& other : certificate_.quantities) {
            if (quantity.table > 0 && other.table == quantity.table && other.row == quantity.row &&
                other.role == "result" && WordLine(other.ref_type).has(column)) {
                const std::string unit = gum::unit_for_people(unit_stated(other));
                return other.value + (unit.empty() ? "" : " ") + unit;
            }
        }
    }
    return "row " + std::to_string(*quantity.row + 1);
}

/// Effective degrees of freedom as this program writes them: a column beside, with the label of its result.
std::optional<StatedNumber> Results::degrees_of_freedom_of(const ImportedQuantity& quantity) const {
    for (const ImportedQuantity& other : certificate_.quantities) {
        if (!quantity.label.empty() && other.label == quantity.label && other.table == quantity.table &&
            other.row == quantity.row && other.ref_type.find("effectiveDegreesOfFreedom") != std::string::npos) {
            return number_stated(other.value, quantity.result);
        }
    }
    return std::nullopt;
}

/// Limits follow their quantity: they stand in its meta data, one for all rows or one for each.
LimitsBeside Results::limits_of(std::size_t position) const {
    const ImportedQuantity& quantity = certificate_.quantities[position];
    LimitsBeside limits;
    const std::vector<ImportedQuantity>& all = certificate_.quantities;
    const auto is_next_row = [&](std::size_t next) {
        return next < all.size() && all[next].row && all[next - 1].row && *all[next].row == *all[next - 1].row + 1 &&
               all[next].quantity == all[next - 1].quantity && all[next].role == all[next - 1].role;
    };
    std::size_t i = position + 1;
    while (is_next_row(i)) {
        ++i;
    }
    for (; i < all.size() && all[i].role == "meta_data"; ++i) {
        const ImportedQuantity& limit = all[i];
        const bool one_for_all = limit.row && *limit.row == 0 && !is_next_row(i + 1);
        const bool of_another_row = limit.row && quantity.row && limit.row != quantity.row && !one_for_all;
        const WordLine words(limit.ref_type + " " + limit.quantity);
        if (of_another_row || !words.has_any({"*limit", "*grenz", "*toler"})) {
            continue;
        }
        const bool lower = words.has_any({"*limitlower", "lower", "*untere", "min"});
        const bool upper = words.has_any({"*limitupper", "upper", "*obere", "max"});
        const std::optional<StatedNumber> value = number_stated(limit.value, "");
        if (lower == upper || !value) {
            continue;
        }
        const std::optional<double> converted = in_unit(value->value, unit_stated(limit), unit_stated(quantity));
        limits.other_unit = limits.other_unit || !converted;
        gum::ToleranceLimits& kind = words.has_any({"*accept", "*akzept"}) ? limits.acceptance : limits.tolerance;
        std::optional<double>& end = lower ? kind.lower : kind.upper;
        end = end ? end : converted;
    }
    return limits;
}

/// "DR-03" in a declaration.
std::optional<gum::DecisionRule> rule_in(const std::string& declaration) {
    return rule_of_id_in(declaration);
}

/// The guard band that acceptance limits show.
std::optional<double> guard_band_of(const LimitsBeside& limits) {
    if (limits.tolerance.upper && limits.acceptance.upper) {
        return *limits.tolerance.upper - *limits.acceptance.upper;
    }
    if (limits.tolerance.lower && limits.acceptance.lower) {
        return *limits.acceptance.lower - *limits.tolerance.lower;
    }
    return std::nullopt;
}

/// Takes a rule with the parameters that the document shows, where it can be applied with them.
bool take_rule(gum::DecisionRule rule, const std::optional<double>& guard_band, AuditedBudget& budget) {
    std::vector<gum::DecisionRuleParameters> possible(1);
    if (guard_band) {
        possible.push_back({.guard_band = guard_band});
        if (budget.claims.U && budget.claims.U->value > 0.0) {
            possible.push_back({.guard_factor = *guard_band / budget.claims.U->value});
        }
    }
    // A guard band that is shown is the one that was used, where the rule takes one.
    for (auto parameters = possible.rbegin(); parameters != possible.rend(); ++parameters) {
        if (gum::check_decision_rule(rule, *parameters, budget.limits).empty()) {
            budget.rule = rule;
            budget.rule_parameters = *parameters;
            return true;
        }
    }
    return false;
}

/// Whether a budget has a verdict; not where its numbers leave the range that can be evaluated.
bool gives_verdict(const AuditedBudget& budget, const std::string& verdict) {
    try {
        return evaluate(budget).verdict == verdict;
    } catch (const gum::DiagnosedError&) {
        return false;
    }
}

/// Of the half-widths that a rule with U may take of an interval, the one that gives the stated verdict, else the first.
void take_half_width_of_verdict(const std::vector<double>& half_widths, double u, AuditedBudget& budget) {
    if (half_widths.empty() || !(u > 0.0) || !budget.rule || budget.claims.verdict.empty()) {
        return;
    }
    for (const double half_width : half_widths) {
        budget.coverage.k = half_width / u;
        if (half_width > 0.0 && gives_verdict(budget, budget.claims.verdict)) {
            return;
        }
    }
    budget.coverage.k = half_widths.front() / u;
}

void Results::state_conformity(const ImportedQuantity& quantity, const LimitsBeside& limits, AuditedBudget& budget) {
    if (gum::limits_problem(limits.tolerance).empty()) {
        budget.limits = limits.tolerance;
    }
    if (quantity.conformity.empty() || quantity.conformity == "noPass") {
        return;
    }
    const auto statement = std::find_if(statements_.begin(), statements_.end(), [&](const reports::DccStatement& s) {
        return !s.id.empty() && s.id == quantity.conformity_id;
    });
    std::string words = statement == statements_.end() ? "" : statement->declaration;
    if (words.empty()) {
        // A statement on conformity of the whole certificate is about its results.
        const auto about_all = std::find_if(statements_.begin(), statements_.end(), [](const reports::DccStatement& s) {
            return WordLine(s.ref_type).has_any({"*conformity"}) && !s.declaration.empty();
        });
        words = about_all == statements_.end() ? quantity.conformity_declaration : about_all->declaration;
    }
    const bool has_tolerance = budget.limits.lower || budget.limits.upper;
    const std::optional<double> guard_band = guard_band_of(limits);
    const std::optional<gum::DecisionRule> named = rule_in(words);
    const bool taken =
        has_tolerance && ((named && take_rule(*named, guard_band, budget)) ||
                          (!named && guard_band && take_rule(gum::DecisionRule::agreed, guard_band, budget)));
    if (!taken && !has_tolerance && gum::limits_problem(limits.acceptance).empty()) {
        // Limits of acceptance alone: what lies within them passes.
        budget.limits = limits.acceptance;
        budget.rule = gum::DecisionRule::simple_acceptance;
    }
    if (!budget.rule && (!words.empty() || limits.other_unit)) {
        tell(limits.other_unit ? say("{result}: the verdict \"{verdict}\" was not decided again, because its limits "
                                     "are stated in another unit",
                                     budget.place, quantity.conformity)
                               : say("{result}: the verdict \"{verdict}\" was not decided again, because its decision "
                                     "rule is stated in words only, or without its limits",
                                     budget.place, quantity.conformity));
        return;
    }
    budget.claims.verdict = quantity.conformity == "conditionalPass"   ? "conditional_pass"
                            : quantity.conformity == "conditionalFail" ? "conditional_fail"
                                                                       : quantity.conformity;
}

AuditedBudget Results::budget_of(std::size_t position) {
    const ImportedQuantity& q = certificate_.quantities[position];
    AuditedBudget budget;
    const std::string point = point_of(q);
    const std::string name = !q.quantity.empty() ? q.quantity : !q.label.empty() ? q.label : q.name;
    budget.name = name + (point.empty() ? "" : ", " + point);
    budget.unit = unit_stated(q);
    budget.place = (q.result.empty() || q.result == name ? "" : q.result + " / ") + budget.name +
                   (q.ref_type.empty() ? "" : " (" + q.ref_type + ")");
    Claims& claims = budget.claims;
    claims.value = number_stated(q.value, budget.place);
    budget.value = claims.value ? std::optional(claims.value->value) : std::nullopt;
    claims.U = number_stated(q.U, budget.place);
    claims.k = number_stated(q.k, budget.place);
    claims.u_c = number_stated(q.u, budget.place);
    claims.distribution = text::in_small_letters(q.distribution);
    if (const std::optional<StatedNumber> p = number_stated(q.p, budget.place); p && p->value > 0.0 && p->value < 1.0) {
        claims.coverage_probability = p->value;
    }
    const double p = claims.coverage_probability.value_or(k_usual_probability);
    const double normal = gum::coverage_factor(p, std::numeric_limits<double>::infinity());
    budget.coverage = {.kind = CoverageRule::Kind::fixed,
                       .k = claims.k && claims.k->value > 0.0 ? claims.k->value : normal,
                       .probability = p};
    double u = claims.u_c ? claims.u_c->value : claims.U ? claims.U->value / budget.coverage.k : 0.0;
    const std::optional<StatedNumber> low = number_stated(q.low, budget.place),
                                      high = number_stated(q.high, budget.place);
    std::vector<double> half_widths;  ///< that rules with U may take of an interval
    if (q.kind == "coverage_interval" && low && high) {
        half_widths = {0.5 * (high->value - low->value)};
        if (budget
                .value) {  // the larger distance of an end from the value: neither end is nearer to a limit than U says
            half_widths.insert(half_widths.begin(), std::max(*budget.value - low->value, high->value - *budget.value));
        }
        u = claims.u_c ? u : half_widths.back() / normal;
        budget.coverage.k = u > 0.0 ? half_widths.front() / u : normal;
        claims.coverage_probability.reset();  // no k belongs to the p of an interval
    }
    claims.nu_eff = degrees_of_freedom_of(q);
    budget.correlation_variance = u * u;
    budget.digits = claims.U ? digits_of(*claims.U) : 2;
    state_conformity(q, limits_of(position), budget);
    // Beside one limit, that of the end on its side: the whole interval lies within the limit then.
    if (!half_widths.empty() && budget.value && budget.limits.lower.has_value() != budget.limits.upper.has_value()) {
        half_widths.push_back(budget.limits.upper ? high->value - *budget.value : *budget.value - low->value);
    }
    take_half_width_of_verdict(half_widths, u, budget);
    return budget;
}

void Results::read() {
    std::size_t left_out = 0, without = 0;
    for (std::size_t i = 0; i < certificate_.quantities.size(); ++i) {
        const ImportedQuantity& q = certificate_.quantities[i];
        if (q.role != "result" || !q.objection.empty()) {
            continue;  // an objection is a finding of its own
        }
        if (q.kind == "none") {
            ++without;
        } else if (subject_.budgets.size() < k_most_certified_results) {
            subject_.budgets.push_back(budget_of(i));
        } else {
            ++left_out;
        }
    }
    if (left_out > 0) {
        tell(say("{count:number} more results are not looked at: an audit takes up to {most:number} of a certificate",
                 std::to_string(left_out), std::to_string(k_most_certified_results)));
    }
    if (subject_.budgets.empty() && without > 0) {
        tell(say("the results have no uncertainty"));
    }
}

/// What concerns the form of the document is counted, and told once.
bool is_of_form(const std::string& code) {
    return code.starts_with("GC-DCC-01") && code != "GC-DCC-0116" && code != "GC-DCC-0117";
}

FindingSeverity severity_of_check(const gum::Diagnostic& check) {
    return check.severity == gum::Severity::error ? FindingSeverity::major : FindingSeverity::minor;
}

void take_checks(std::span<const gum::Diagnostic> checks, AuditSubject& subject) {
    std::size_t broken = 0;
    const gum::Diagnostic* first = nullptr;
    for (const gum::Diagnostic& check : checks) {
        const bool error = check.severity == gum::Severity::error;
        if (is_of_form(check.code)) {
            broken += error ? 1U : 0U;
            first = first == nullptr && error ? &check : first;
        } else if (check.code.starts_with("GC-DCC-002")) {
            subject.not_read.push_back(
                say("{where}: {what:sentence}: {rule:sentence}", check.where, check.what, check.rule));
        } else if (check.severity != gum::Severity::note && check.code != "GC-DCC-0043") {
            subject.certificate->findings.push_back({.id = check.code,
                                                     .clause = check.rule,
                                                     .severity = severity_of_check(check),
                                                     .where = check.where,
                                                     .what = check.what,
                                                     .action = check.action});
        }
    }
    if (first != nullptr) {
        subject.certificate->findings.push_back({.id = "DCC-form",
                                                 .clause = first->rule,
                                                 .severity = FindingSeverity::minor,
                                                 .where = first->where,
                                                 .what = std::to_string(broken) + (broken == 1 ? " rule" : " rules") +
                                                         " of the format broken, the first: " + first->what,
                                                 .action = "gumcert check dcc lists all of them"});
    }
}

void take_traceability(const reports::XmlElement& root, AuditSubject& subject) {
    std::vector<certificate::Finding>& findings = subject.certificate->findings;
    for (const std::string& name : reports::equipment_out_of_validity(root)) {
        findings.push_back(
            {.id = "T01",
             .clause = "ISO/IEC 17025:2017, 6.4",
             .severity = FindingSeverity::critical,
             .where = "measuringEquipments / " + name,
             .what = "the document itself says that the certificate of " + name + " was not valid when it was used",
             .action = "show a calibration that was valid, or repeat the work"});
    }
}

bool is_same_person(const std::optional<certificate::Person>& a, const std::optional<certificate::Person>& b) {
    return a && b && certificate::is_same_name(a->name, b->name);
}

/// Who did what, as far as the document says; the days of authorisations are in no such document.
void take_persons(const reports::XmlElement& root, AuditSubject& subject) {
    std::vector<certificate::Finding>& findings = subject.certificate->findings;
    const auto& [performed_by, reviewed_by, authorised_by] = subject.certificate->data.persons;
    const reports::XmlElement* const administrative = root.child("dcc:administrativeData");
    if (!authorised_by && administrative != nullptr && administrative->child("dcc:respPersons") != nullptr) {
        findings.push_back({.id = "R07-o",
                            .clause = "ISO/IEC 17025:2017, 7.8.2.1 o",
                            .severity = FindingSeverity::minor,
                            .where = "administrativeData / respPersons",
                            .what = "the document does not say which person authorised it",
                            .action = "Mark the main signer, or state a role that authorises."});
    }
    if (is_same_person(performed_by, reviewed_by)) {
        findings.push_back(
            {.id = "P07",
             .clause = "ISO/IEC 17025:2017, 7.8.1.1",
             .severity = FindingSeverity::major,
             .where = "administrativeData / respPersons",
             .what = performed_by->name + " did the work and reviewed it" +
                     (is_same_person(performed_by, authorised_by) ? ", and authorised the document" : ""),
             .action = "Let another person review."});
    }
}

/// Texts that no rule looks at: silence about them is no judgement.
void tell_what_is_not_read(std::span<const reports::DccStatement> statements, AuditSubject& subject) {
    std::vector<Sentence> kinds;
    for (const reports::DccStatement& statement : statements) {
        const WordLine kind(statement.ref_type);
        if (kind.has_any({"*conformity", "*accreditation", "*draft", "*specimen"})) {
            continue;
        }
        const Sentence name = statement.ref_type.empty() ? say("of no stated kind") : Sentence(statement.ref_type);
        if (std::find(kinds.begin(), kinds.end(), name) == kinds.end()) {
            kinds.push_back(name);
        }
    }
    constexpr std::size_t k_shown = 6;
    if (!kinds.empty()) {
        subject.not_read.push_back(say("statements in words were not read: {kinds}", listed(kinds, k_shown)));
    }
    if (!subject.certificate->data.method.description.empty()) {
        subject.not_read.push_back(
            say("the description of the method is free text: whether it names deviations was not read"));
    }
}

}  // namespace

AuditSubject subject_of(const reports::ParsedDcc& document, std::span<const gum::Diagnostic> checks,
                        const std::string& name) {
    const reports::XmlElement& root = document.root;
    AuditSubject subject;
    subject.kind = AuditSubject::Kind::certificate;
    subject.name = name;
    subject.certificate.emplace();
    subject.certificate->data = reports::certificate_data_of(root);
    take_checks(checks, subject);
    take_traceability(root, subject);
    take_persons(root, subject);
    std::vector<reports::DccStatement> statements = reports::statements_of(root);
    tell_what_is_not_read(statements, subject);
    Results(document.certificate, std::move(statements), subject).read();
    return subject;
}

}  // namespace gumcert::audit
