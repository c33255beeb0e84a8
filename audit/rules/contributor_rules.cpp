#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audit/budget_outcome.h"
#include "audit/checklists.h"
#include "audit/row_edits.h"
#include "audit/rules/gate_findings.h"
#include "audit/rules/registry.h"
#include "audit/stated_outcome.h"
#include "audit/word_line.h"
#include "certificate/dates.h"
#include "certificate/text_words.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::audit {
namespace {

constexpr Clause k_contributions{.text = "ISO/IEC 17025:2017, 7.6.1", .verified = true};
constexpr Clause k_item_contributions{.text = "ILAC-P14:09/2020, 5.4", .verified = true};
constexpr Clause k_minimum_list{.text = "A2LA R205, minimum contributors", .verified = false};
constexpr Clause k_type_b{.text = "JCGM 100:2008, 4.3", .verified = true};
constexpr Clause k_interpolation{.text = "ANAB GD 2702", .verified = false};

enum class Presence { missing, without_number, with_number };

/// The rows of a budget with what they are called.
struct RowWithName {
    Presence presence;  ///< of what it stands for
    NamedRow name;
};

/// Whether two rows may be of one quantity by their units. The step of a thermometer is none of a length.
bool may_have_one_dimension(const AuditedRow& one, const AuditedRow& other) {
    if (one.unit == other.unit || one.unit.empty() || other.unit.empty()) {
        return true;
    }
    try {
        return gum::Unit::parse(one.unit).dimension() == gum::Unit::parse(other.unit).dimension();
    } catch (const gum::DiagnosedError&) {
        return false;
    }
}

/// Readings that are all equal: they were taken, and their scatter is below the step of the display, which is the contribution
/// then (JCGM 100:2008, F.2.2.1) and stands in the budget.
bool are_equal_readings(const AuditedBudget& budget, const AuditedRow& row) {
    const auto is_resolution = [&row](const AuditedRow& other) {
        return contribution_of(other) > 0.0 &&
               (other.origin == Origin::resolution || other.contributor == Contributor::item_resolution) &&
               may_have_one_dimension(row, other);
    };
    return row.type_a.value_or(false) && std::max(row.readings.size(), row.n.value_or(0)) >= 2 && row.used_u == 0.0 &&
           std::any_of(budget.rows.begin(), budget.rows.end(), is_resolution);
}

std::vector<RowWithName> named_rows(const AuditedBudget& budget) {
    std::vector<RowWithName> rows;
    for (const AuditedRow& row : budget.rows) {
        const bool has_number = row.used_u > 0.0 || are_equal_readings(budget, row);
        rows.push_back(
            {.presence = has_number ? Presence::with_number : Presence::without_number, .name = NamedRow(row)});
    }
    return rows;
}

Presence presence_of(const std::vector<RowWithName>& rows, const RequiredContributor& required) {
    Presence presence = Presence::missing;
    for (const RowWithName& row : rows) {
        if (row.presence > presence && row.name.stands_for(required)) {
            presence = row.presence;
        }
    }
    return presence;
}
/// The same, where one contributor alone is asked for.
Presence presence_of(const AuditedBudget& budget, const RequiredContributor& required) {
    return presence_of(named_rows(budget), required);
}

bool has_row_of(const AuditedBudget& budget, std::initializer_list<Contributor> contributors) {
    return std::any_of(budget.rows.begin(), budget.rows.end(), [&](const AuditedRow& row) {
        return row.used_u > 0.0 &&
               std::find(contributors.begin(), contributors.end(), row.contributor) != contributors.end();
    });
}

std::size_t rows_not_recognised(const AuditedBudget& budget) {
    return static_cast<std::size_t>(std::count_if(budget.rows.begin(), budget.rows.end(), [](const AuditedRow& row) {
        return row.contributor == Contributor::other;
    }));
}

/// A contribution that nobody put into the budgets. Rows that the program did not recognise may be it: minor then.
void add_missing_contribution(const AuditSubject& subject, std::vector<std::size_t> budgets, const Sentence& what,
                              FindingSeverity severity, std::vector<Sentence> evidence, FindingCollector& findings) {
    std::optional<AuditFinding> finding = finding_of_all(subject, std::move(budgets), what);
    if (!finding) {
        return;
    }
    finding->evidence = std::move(evidence);
    finding->contribution_missing = true;
    const std::size_t unknown = rows_not_recognised(subject.budgets[finding->budgets.front()]);
    if (unknown > 0) {
        finding->evidence.push_back(say("rows that were not recognised: {count:number}", std::to_string(unknown)));
        severity = std::min(severity, FindingSeverity::minor);
    }
    findings.add(std::move(*finding), severity);
}

/// Budgets that leave something out, of those whose words are read.
std::vector<std::size_t> budgets_without(const AuditSubject& subject, FindingCollector& findings,
                                         const std::function<bool(const AuditedBudget&)>& leaves_out) {
    return budgets_where(subject, [&](const AuditedBudget& budget) {
        return leaves_out(budget) && reads_words(budget, budget.place, findings);
    });
}

/// What B01 asks of a budget: the checklist of its method, and of the minimum of every method what the checklist does not
/// name and no other rule of the family looks for.
std::vector<RequiredContributor> asked_of(const AuditedBudget& budget) {
    const auto asks = [](const RequiredContributor& required, Contributor contributor) {
        return std::find(required.by.begin(), required.by.end(), contributor) != required.by.end();
    };
    std::vector<RequiredContributor> asked;
    if (const MethodChecklist* checklist = checklist_of(budget.method)) {
        for (const RequiredContributor& required : checklist->required) {
            if (!asks(required, Contributor::fit) && !asks(required, Contributor::reproducibility)) {
                asked.push_back(required);
            }
        }
    }
    const std::size_t of_checklist = asked.size();
    for (const RequiredContributor& required : minimum_contributors()) {
        const bool other_rule =
            asks(required, Contributor::reproducibility) || asks(required, Contributor::reference_drift);
        const bool named = std::any_of(asked.begin(), asked.begin() + static_cast<std::ptrdiff_t>(of_checklist),
                                       [&](const RequiredContributor& of_method) {
                                           return std::any_of(required.by.begin(), required.by.end(),
                                                              [&](Contributor by) { return asks(of_method, by); });
                                       });
        // A weight or a gauge shows nothing that could have a resolution.
        const bool is_of_display = asks(required, Contributor::item_resolution) &&
                                   (names_material_measure(budget.title) || names_material_measure(budget.name));
        if (!other_rule && !named && !is_of_display) {
            asked.push_back(required);
        }
    }
    return asked;
}

/// B01: one finding for all that a budget leaves out, and one for what it names without a number.
void required_contributor_missing(const AuditSubject& subject, FindingCollector& findings) {
    std::vector<std::pair<Sentence, std::vector<std::size_t>>> gaps;  // sentence and budgets, in their order
    const auto note = [&gaps](const Sentence& what, std::size_t budget) {
        // The points of a table have their rows in common, and so their gaps: one finding for all of them.
        const auto same = std::find_if(gaps.begin(), gaps.end(), [&](const auto& gap) { return gap.first == what; });
        if (same == gaps.end()) {
            gaps.emplace_back(what, std::vector{budget});
        } else {
            same->second.push_back(budget);
        }
    };
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        if (subject.budgets[i].rows.empty() || !reads_words(subject.budgets[i], subject.budgets[i].place, findings)) {
            continue;
        }
        const std::vector<RowWithName> rows = named_rows(subject.budgets[i]);
        std::vector<Sentence> missing, without_number;
        for (const RequiredContributor& required : asked_of(subject.budgets[i])) {
            const Presence presence = presence_of(rows, required);
            if (presence == Presence::missing) {
                missing.emplace_back(required.name);
            } else if (presence == Presence::without_number) {
                without_number.emplace_back(required.name);
            }
        }
        if (!missing.empty()) {
            note(say("no row for {contributors}", all_of(missing)), i);
        }
        if (!without_number.empty()) {
            note(say("named without a number: {contributors}", all_of(without_number)), i);
        }
    }
    for (auto& [what, budgets] : gaps) {
        const MethodChecklist* checklist = checklist_of(subject.budgets[budgets.front()].method);
        std::vector<Sentence> evidence{checklist == nullptr
                                           ? say("checklist: every method")
                                           : say("checklist: {method}, after {documents} (clauses to be verified)",
                                                 checklist->title, std::string(checklist->source))};
        add_missing_contribution(subject, std::move(budgets), what, FindingSeverity::major, std::move(evidence),
                                 findings);
    }
}

/// B02
void drift_missing(const AuditSubject& subject, FindingCollector& findings) {
    std::vector<std::size_t> budgets = budgets_without(subject, findings, [](const AuditedBudget& budget) {
        return has_row_of(budget, {Contributor::reference}) && !has_row_of(budget, {Contributor::reference_drift});
    });
    std::vector<Sentence> evidence;
    if (subject.certificate) {
        const certificate::CertificateData& data = subject.certificate->data;
        for (const certificate::StandardUsed& standard : data.standards) {
            const std::optional<long> days = certificate::days_between(standard.calibrated, data.dates.performed_from);
            if (days && *days > 0) {
                evidence.push_back(say("{standard}: calibrated {days:number} days before the work",
                                       standard.identification, std::to_string(*days)));
            }
        }
    }
    add_missing_contribution(
        subject, std::move(budgets),
        say("no contribution, or 0, for the drift of the reference standard since its calibration"),
        FindingSeverity::major, std::move(evidence), findings);
}

/// B03
void drift_of_few_calibrations(const AuditSubject& subject, FindingCollector& findings) {
    // A line through two calibrations leaves no residual, so nothing says how well the drift is known.
    constexpr std::size_t k_least = 3;
    for_each_row(subject, [&findings](const RowAt& at) {
        if (at.is.contributor != Contributor::reference_drift) {
            return;
        }
        const std::optional<std::size_t> count = WordLine(at.is.comment)
                                                     .count_of({"calibration", "recalibration", "kalibrierung",
                                                                "rekalibrierung", "certificates", "kalibrierschein"});
        if (!count || *count >= k_least) {
            return;
        }
        AuditFinding finding = finding_at(at, "",
                                          say_count(*count, "the drift is estimated from {count:number} calibration",
                                                    "the drift is estimated from {count:number} calibrations"));
        finding.expected = say("3 calibrations at least");
        finding.actual = say_number(std::to_string(*count));
        findings.add(std::move(finding));
    });
}

/// B04
void item_missing(const AuditSubject& subject, FindingCollector& findings) {
    const RequiredContributor of_item{
        "item",
        {Contributor::item, Contributor::item_resolution, Contributor::repeatability},
        {"dut ", "uut ", "device under", "unit under", "prufling", "pruefling", "kalibriergegenstand", "customer"}};
    add_missing_contribution(
        subject,
        budgets_without(
            subject, findings,
            [&](const AuditedBudget& budget) { return presence_of(budget, of_item) != Presence::with_number; }),
        say("no contribution of the customer's device: no resolution, repeatability or stability of it"),
        FindingSeverity::major, {}, findings);
}

/// B05
void reproducibility_missing(const AuditSubject& subject, FindingCollector& findings) {
    const RequiredContributor required{"reproducibility",
                                       {Contributor::reproducibility},
                                       {"reproducib", "reproduzier", "operator", "bediener", "set up", "setup"}};
    add_missing_contribution(
        subject,
        budgets_without(
            subject, findings,
            [&](const AuditedBudget& budget) { return presence_of(budget, required) != Presence::with_number; }),
        say("no contribution of reproducibility (operator, day, set-up)"), FindingSeverity::minor, {}, findings);
}

/// B06
void fit_missing(const AuditSubject& subject, FindingCollector& findings) {
    add_missing_contribution(
        subject,
        budgets_without(subject, findings,
                        [](const AuditedBudget& budget) {
                            const WordLine words(budget.name + "; " + budget.equation + "; " + budget.method);
                            const bool fitted = words.has_any({"multilateration", "fit ", "fitted", "best fit",
                                                               "bestfit", "regression", "polynom", "least squares",
                                                               "calibration curve", "ausgleichs", "kleinste quadrate"});
                            return fitted && !has_row_of(budget, {Contributor::fit});
                        }),
        say("the result comes from a fit, and no contribution of its parameters and residuals is there"),
        FindingSeverity::major, {}, findings);
}

/// B07
void interpolation_missing(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const bool of_table = at.is.contributor == Contributor::reference || at.is.origin == Origin::certificate;
        if (!of_table || has_row_of(at.of, {Contributor::fit}) ||
            !WordLine(at.is.comment + "; " + at.is.source)
                 .has_any({"interpol", "between points", "between the points", "zwischen den", "zwischenwert"})) {
            return;
        }
        AuditFinding finding = finding_at(
            at, "", say("a calibration value is interpolated, and no contribution of the interpolation is there"));
        finding.contribution_missing = true;
        findings.add(std::move(finding));
    });
}

std::set<std::string> quantities_of(const AuditedBudget& budget) {
    std::set<std::string> names;
    for (const AuditedRow& row : budget.rows) {
        if (!certificate::letters_of(row.quantity).empty()) {
            names.insert(row.quantity);
        }
    }
    return names;
}

/// B08
void structures_differ(const AuditSubject& subject, FindingCollector& findings) {
    std::map<std::string, std::size_t> first_of_method;
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const std::string key = (budget.method.empty() ? budget.name : budget.method) + "|" + budget.unit;
        const std::set<std::string> names = quantities_of(budget);
        if (names.empty()) {
            continue;
        }
        const auto [entry, is_new] = first_of_method.emplace(key, i);
        if (is_new) {
            continue;
        }
        const AuditedBudget& other = subject.budgets[entry->second];
        const std::set<std::string> others = quantities_of(other);
        std::vector<std::string> only;
        std::set_symmetric_difference(names.begin(), names.end(), others.begin(), others.end(),
                                      std::back_inserter(only));
        if (only.empty()) {
            continue;
        }
        AuditFinding finding =
            finding_of(subject, i,
                       say("this budget and that of {other}, of the same method, have different rows: {rows}",
                           other.place.empty() ? other.name : other.place, listed(sentences_of(only), 6)));
        findings.add(std::move(finding));
    }
}

}  // namespace

std::vector<Rule> contributor_rules() {
    return {
        {.id = "B01",
         .title = "Required contributor missing",
         .clause = k_contributions,
         .severity = FindingSeverity::major,
         .needs = {Need::rows},
         .detection =
             "the checklist of the method and the minimum of every method against the rows, recognised by their "
             "words; a row without a number does not count. Minor where rows were not recognised",
         .correction = "Add the contribution with a number. \"Not significant\" is a number, too.",
         .question = "How large is this contribution, and from which data do you know?",
         .examine = required_contributor_missing},
        {.id = "B02",
         .title = "Drift of the reference standard missing or 0",
         .clause = k_contributions,
         .severity = FindingSeverity::major,
         .needs = {Need::rows},
         .detection = "a row of a reference standard, and no row of its drift with a number greater than 0",
         .correction = "Add the drift since the last calibration, from the history of the standard.",
         .question = "How much did the standard change between its last calibrations?",
         .examine = drift_missing},
        {.id = "B03",
         .title = "Drift from fewer than three calibrations",
         .clause = k_type_b,
         .severity = FindingSeverity::minor,
         .needs = {Need::rows},
         .detection = "the comment of a row of drift counts fewer than three calibrations",
         .correction = "Use the specification of the stability until three calibrations are there.",
         .question = "Which calibrations is the drift estimated from?",
         .examine = drift_of_few_calibrations},
        {.id = "B04",
         .title = "No contribution of the customer's device",
         .clause = k_item_contributions,
         .severity = FindingSeverity::major,
         .needs = {Need::rows},
         .detection = "no row of resolution, repeatability or stability of the item with a number",
         .correction = "Add the contributions of the device under calibration.",
         .question = "What do resolution and repeatability of the customer's device contribute?",
         .examine = item_missing},
        {.id = "B05",
         .title = "Reproducibility missing",
         .clause = k_minimum_list,
         .severity = FindingSeverity::minor,
         .needs = {Need::rows},
         .detection = "no row of reproducibility, operator, day or set-up with a number",
         .correction = "Add the contribution, from a study with operators and days.",
         .question = "How much do results of two operators, or of two set-ups, differ?",
         .examine = reproducibility_missing},
        {.id = "B06",
         .title = "Uncertainty of a fit missing, or refuted by its residuals",
         .clause = k_contributions,
         .severity = FindingSeverity::major,
         .needs = {Need::rows},
         .detection = "a budget of a fit or of multilateration without a row of it; findings F, G, C01, C02 and C03 of "
                      "the evaluation",
         .correction = "Add parameters and residuals of the fit, with their covariance.",
         .question = "Where do residual variance and covariance of the fit stand in the budget?",
         .examine = fit_missing},
        {.id = "B07",
         .title = "Interpolation without a contribution of its own",
         .clause = k_interpolation,
         .severity = FindingSeverity::minor,
         .needs = {Need::rows},
         .detection = "a row of a certificate that speaks of interpolation, and no row of a fit or an interpolation",
         .correction = "Add what the values between the points may differ from the line between them.",
         .question = "How far can the standard leave the line between two points of its certificate?",
         .examine = interpolation_missing},
        {.id = "B08",
         .title = "Budgets of one method differ in structure",
         .clause = k_contributions,
         .severity = FindingSeverity::minor,
         .needs = {Need::rows},
         .detection = "the names of the rows of two budgets of the same method and unit",
         .correction = "Use the same rows for all points, or say why one is left out.",
         .question = "Why does one budget of this method have rows that another one has not?",
         .examine = structures_differ},
    };
}

}  // namespace gumcert::audit
