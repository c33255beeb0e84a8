#include "reports/record/make/certificate/certify.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"
#include "certificate/point_limits.h"
#include "certificate/result_names.h"
#include "certificate/section_data.h"
#include "certificate/statement_of_uncertainty.h"
#include "gum/budget/evaluation_choice.h"
#include "gum/coverage.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/certified_tables.h"
#include "reports/record/make/certificate/amended_record.h"
#include "reports/record/make/certificate/certified_conformity.h"
#include "reports/record/make/certificate/certified_scope.h"
#include "reports/record/make/certificate/certified_traceability.h"
#include "reports/record/make/certificate/environment_findings.h"
#include "reports/record/make/certificate/evaluation_findings.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/reported_choice.h"
#include "reports/record/reported_result.h"
#include "reports/record/stated_values.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::CertificateData;
using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::Finding;
using certificate::PrintRule;
using certificate::Profile;
using reports::EvaluationRecord;
using reports::Result;

constexpr double k_about_95_percent = 0.01;  // 95 % and 95.45 % are the same statement

/// What is certified, in the place where the record has that number as well.
void show(reports::Printed& text, const CertifiedValue& value) {
    text.value = value.printed_value;
    text.U = value.printed_U;
}

/// What is certified is what is reported; the law of propagation has the same texts where it is reported itself.
void show(Result& result, const CertifiedValue& value) {
    show(result.reported.printed, value);
    result.reported.printed_low = value.printed_low;
    result.reported.printed_high = value.printed_high;
    if (result.reported.method == "law_of_propagation") {
        show(result.printed, value);
    }
}

/// Makes the tables of one record certified.
class Certifier {
public:
    Certifier(EvaluationRecord& record, const certificate::CapabilityInputs& inputs)
        : record_(record), inputs_(inputs) {
        const certificate::Certificate& c = *record.certificate;
        rule_ = certificate::print_rule(c.profile);
        if (inputs.rounding == gum::RoundingMode::up) {
            rule_.rounding = gum::RoundingMode::up;
        }
        if (record.points) {
            for (std::size_t p = 0; p < record.points->points.size(); ++p) {
                points_.emplace(record.points->points[p], p);
            }
        }
        scoped_ = c.data.accreditation.has_value() && c.data.status != "not_accredited";
    }

    /// Every value is printed once, and its texts are put into the place of the record that it comes from.
    void certify_tables(std::vector<CertifiedTable>& tables) {
        reports::StatedPlaces stated;  // in the order of the tables
        if (record_.rotary) {
            stated = reports::stated_values(*record_.rotary, reports::ErrorOrder::by_motion);
        }
        auto next = stated.begin();
        for (CertifiedTable& table : tables) {
            for (CertifiedColumn& column : table.columns) {
                for (std::size_t row = 0; row < column.values.size(); ++row) {
                    Result* const result = reports::result_of(record_, table, column.result, row);
                    certify_value(tables, table, column, row, result);
                    if (result != nullptr) {
                        show(*result, column.values[row]);
                    } else if (next != stated.end()) {
                        show((next++)->stated.printed, column.values[row]);
                    }
                    if (result != nullptr && record_.rotary) {
                        reports::print_set_up(*record_.rotary, *result);
                    }
                }
            }
        }
        certificate::FindingList of_values(data());
        of_values.add_by_cause(std::exchange(doubtful_, {}));
        std::ranges::move(of_values.take(), std::back_inserter(findings_));
    }

    [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

private:
    EvaluationRecord& record_;
    const certificate::CapabilityInputs& inputs_;
    PrintRule rule_;
    bool scoped_ = false;
    std::map<std::string, CertificateData> of_section_;
    std::map<std::string, std::size_t> points_;  ///< of the job, by their names
    std::vector<Finding> findings_;
    std::vector<certificate::FoundInRow> doubtful_;

    /// Position of a row of a table among the points of the job.
    [[nodiscard]] std::size_t point_of(const CertifiedTable& table, std::size_t row) const {
        // Without tables of its own a result may stand at some of the points only.
        const bool has_point = table.argument && row < table.argument->printed.size();
        const auto found = has_point ? points_.find(table.argument->printed[row]) : points_.end();
        return found == points_.end() ? row : found->second;
    }

    /// What the column "range" says of a point, as people read it: "10 V"; "" where there is none.
    [[nodiscard]] std::string range_of(std::size_t point) const {
        if (!record_.points) {
            return {};
        }
        for (const certificate::PointColumn& one : record_.points->columns) {  // each section may have one
            if (one.name == "range" && point < one.printed.size() && !one.printed[point].empty()) {
                return one.printed[point] + (one.unit.empty() ? "" : " " + one.unit);
            }
        }
        return {};
    }

    [[nodiscard]] const CertificateData& data() const { return record_.certificate->data; }

    /// What holds for a section: scope and capability depend on the method.
    [[nodiscard]] const CertificateData& data_of(const std::string& section) {
        if (data().sections.empty()) {
            return data();
        }
        const auto known = of_section_.find(section);
        return known != of_section_.end()
                   ? known->second
                   : of_section_.emplace(section, certificate::data_of_section(data(), section)).first->second;
    }

    void certify_value(const std::vector<CertifiedTable>& tables, const CertifiedTable& table, CertifiedColumn& column,
                       std::size_t row, const Result* result) {
        CertifiedValue& value = column.values[row];
        const double p = result != nullptr ? result->coverage_probability : record_.coverage_probability.number;
        const ScopePlace place{.tables = tables,
                               .table = table,
                               .column = column,
                               .row = row,
                               .point = point_of(table, row),
                               .coverage_probability = p,
                               .range = table.argument ? range_of(point_of(table, row)) : std::string(),
                               .result = result != nullptr ? result->name : std::string()};
        place_in_scope(place, value, result);
        PrintRule rule = rule_;
        if (result != nullptr) {
            rule.digits = std::min(rule.digits, reports::printed_digits(reports::reported_result(*result)));
        }
        if (rule.digits < rule_.digits) {
            rule.rounding = gum::RoundingMode::up;  // as the evaluation prints it
        }
        print(value, rule);
        note_doubt(place, value);
        note_coverage(column, p);
        decide(column, value, result, point_of(table, row));
    }

    /// Whether names mean a value: by its column, "E", or by its point, "E[10 V]".
    [[nodiscard]] static bool is_named(const std::vector<std::string>& names, const CertifiedColumn& column,
                                       const Result* result) {
        return certificate::is_named(names, column.result) ||
               (result != nullptr && certificate::is_named(names, result->name));
    }

    void place_in_scope(const ScopePlace& place, CertifiedValue& value, const Result* result) {
        for (const certificate::ExternalResults& external : data().external_results) {
            if (is_named(external.results, place.column, result)) {
                value.external = true;
                value.outside_because = "another laboratory provided it";
                return;
            }
        }
        if (!scoped_) {
            return;
        }
        ScopeAnswer answer = scope_of(data_of(place.table.section), place, inputs_);
        value.scope_entry = std::move(answer.entry);
        value.outside_because = std::move(answer.outside_because);
        value.outside_by = answer.outside_by;
        if (value.U || value.interval || value.u > 0.0) {  // by definition without uncertainty: no capability either
            value.capability = answer.capability;
        }
    }

    void leave_accreditation(CertifiedValue& value, const std::string& because) {
        value.scope_entry.clear();
        value.outside_because = because;
    }

    void print(CertifiedValue& value, const PrintRule& rule) {
        if (value.k && value.U) {
            value.printed_k = certificate::printed_coverage_factor(*value.k);
        }
        const bool has_degrees = value.U && value.coverage != "monte_carlo" && value.coverage != "none";
        value.printed_nu_eff = has_degrees ? certificate::printed_degrees_of_freedom(value.nu_eff) : "";
        if (value.capability) {
            value.printed_capability = certificate::printed_capability(*value.capability);
        }
        if (value.U && (*value.U > 0.0 || value.capability)) {
            print_with_uncertainty(value, rule);
        } else if (value.interval) {
            print_interval(value, rule);
        }
    }

    void print_with_uncertainty(CertifiedValue& value, const PrintRule& rule) {
        const std::string& policy = record_.certificate->profile.below_capability;
        const certificate::StatedPair stated =
            certificate::state_uncertainty(value.value, *value.U, value.capability, rule, policy == "raise");
        value.printed_value = stated.value;
        value.printed_U = stated.U;
        value.raised = stated.raised;
        if (stated.below && policy == "outside") {
            leave_accreditation(value, "its expanded uncertainty is smaller than the capability of the scope entry \"" +
                                           value.scope_entry + "\"");
        }
        if (value.raised) {
            value.interval.reset();  // what is certified is the value with the capability
            value.printed_low.clear();
            value.printed_high.clear();
        } else if (value.interval) {
            print_ends(value, certificate::decimals_of(value.printed_U));
        }
    }

    void print_interval(CertifiedValue& value, const PrintRule& rule) {
        const double half_width = 0.5 * (value.interval->second - value.interval->first);
        if (!(half_width > 0.0)) {
            return;
        }
        const gum::RoundedPair pair = gum::round_to_uncertainty(value.value, half_width, rule.digits, rule.rounding);
        // The evaluation knows the numerical errors of value and u: what it printed with fewer digits stays.
        if (value.printed_value.empty() ||
            certificate::decimals_of(value.printed_value) >= certificate::decimals_of(pair.value)) {
            value.printed_value = pair.value;
        }
        const std::string u = value.u > 0.0 ? gum::round_significant(value.u, rule.digits) : "";
        if (value.printed_u.empty() || certificate::decimals_of(value.printed_u) >= certificate::decimals_of(u)) {
            value.printed_u = u;
        }
        print_ends(value, certificate::decimals_of(pair.U));
        if (value.capability && half_width < *value.capability) {
            leave_accreditation(value, "its coverage interval is narrower than the capability of the scope entry \"" +
                                           value.scope_entry + "\"");
        }
    }

    static void print_ends(CertifiedValue& value, int decimals) {
        value.printed_low = gum::round_to_quantum(value.interval->first, decimals);
        value.printed_high = gum::round_to_quantum(value.interval->second, decimals);
    }

    /// A result that may be an error of a larger quantity, where the scope allows no U as small as the one that is stated.
    void note_doubt(const ScopePlace& place, const CertifiedValue& value) {
        const auto doubtful =
            value.capability && !value.scope_entry.empty() ? doubtful_place(place, inputs_) : std::nullopt;
        if (!doubtful) {
            return;
        }
        ScopePlace other = place;
        other.assumed = doubtful;
        const ScopeAnswer there = scope_of(data_of(place.table.section), other, inputs_);
        constexpr double k_same = 1.02;  // what two digits of U do not show
        const auto with_unit = [](const std::string& number, const std::string& unit) {
            const std::string people = gum::unit_for_people(unit);
            return people.empty() ? number : number + " " + people;
        };
        const std::string named =
            "\"" + doubtful->name + "\" = " + with_unit(text::shortest_plain(doubtful->value), doubtful->unit);
        const auto note = [&](std::string what, std::string action, double badness) {
            doubtful_.push_back({.table = &place.table,
                                 .column = &place.column,
                                 .row = place.row,
                                 .finding = {.id = "X12",
                                             .clause = "ILAC-P14:09/2020",
                                             .severity = certificate::FindingSeverity::major,
                                             .where = {},
                                             .what = std::move(what),
                                             .action = std::move(action)},
                                 .badness = badness});
        };
        // What is no error may be a small quantity that the scope means; an error is within no scope of its own size.
        if (!there.capability && is_difference_by_role(place)) {
            constexpr double k_outside = 1e9;  // worse than any U
            note("it is not said at which value \"" + place.column.result + "\" was measured, and at " + named +
                     " the scope does not cover it: " + there.outside_because,
                 "State the role of its nominal value (\"role\": \"nominal\") in a column of points that the table "
                 "shows.",
                 k_outside);
            return;
        }
        if (!there.capability || *there.capability <= k_same * *value.capability) {
            return;
        }
        const double half_width = value.interval ? 0.5 * (value.interval->second - value.interval->first) : 0.0;
        const bool is_below = value.printed_U.empty()
                                  ? half_width < *there.capability
                                  : certificate::is_below_capability(value.printed_U, *there.capability);
        if (!is_below) {
            return;
        }
        const std::string U = value.printed_U.empty() ? gum::round_significant(half_width, 2) : value.printed_U;
        note(
            "it is not said whether \"" + place.column.result + "\" is an error of " + named + ": the scope entry \"" +
                there.entry + "\" allows U from " +
                with_unit(certificate::printed_capability(*there.capability), place.column.unit) +
                " there, and U is stated as " + with_unit(U, place.column.unit),
            "Where the result is an error, a deviation or a correction, state its role in the outputs of the job, and "
            "that of its nominal value (\"role\": \"nominal\") in a column of points that the table shows; where it is "
            "the quantity itself, state \"role\": \"measured_value\". A job without points needs one of them "
            "(\"points\").",
            *there.capability / *value.capability);
    }

    void note_coverage(const CertifiedColumn& column, double p) {
        if (!scoped_ || std::abs(p - 0.95) <= k_about_95_percent) {
            return;
        }
        add({.id = "K03",
             .clause = "ILAC-P14:09/2020",
             .severity = certificate::FindingSeverity::critical,
             .where = column.result,
             .what = "the expanded uncertainty has a coverage probability of " +
                     certificate::printed_coverage_probability(p) + " %",
             .action = "State accredited results with a coverage probability of about 95 % (coverage_probability in "
                       "the job)."});
    }

    /// Once a result, however many rows it has.
    void add(Finding finding) {
        const bool known = std::any_of(findings_.begin(), findings_.end(), [&](const Finding& f) {
            return f.id == finding.id && f.where == finding.where;
        });
        if (!known) {
            findings_.push_back(std::move(finding));
        }
    }

    void decide(const CertifiedColumn& column, CertifiedValue& value, const Result* result, std::size_t point) {
        for (const certificate::AgreedSpecification& specification : data().specifications) {
            if (!is_named(specification.results, column, result)) {
                continue;
            }
            if (value.verdict) {
                add({.id = "D09",
                     .clause = "ISO/IEC 17025:2017, 7.8.6.2 b",
                     .severity = certificate::FindingSeverity::major,
                     .where = column.result,
                     .what = "the specification \"" + specification.id + "\" names the result too, and only \"" +
                             value.verdict->specification + "\" is decided",
                     .action = "Name a result in one specification; decide the other on a certificate of its own."});
                continue;
            }
            KnownDistribution known = value.external ? KnownDistribution() : known_distribution(value, result);
            if (const auto found = inputs_.at_estimates.find(result != nullptr ? result->name : "");
                found != inputs_.at_estimates.end()) {
                known.at_estimates = found->second;
            }
            value.verdict = specification.limits ? at_point(specification, column, value, known, point)
                                                 : verdict_of(specification, column, value, known);
        }
    }

    /// By the limits of one point.
    [[nodiscard]] certificate::Verdict at_point(const certificate::AgreedSpecification& specification,
                                                const CertifiedColumn& column, const CertifiedValue& value,
                                                const KnownDistribution& known, std::size_t point) const {
        const certificate::LimitsAt limits =
            record_.points ? certificate::limits_at(specification, certificate::lookup_at(*record_.points, point))
                           : certificate::LimitsAt{.lower = {}, .upper = {}, .problem = "no points"};
        if (!limits.problem.empty()) {
            certificate::Verdict none;
            none.specification = specification.id;
            none.rule = specification.rule.id;
            none.verdict = none.verdict_from_printed = "not_applicable";
            none.note = "the specification states limits of points, and the result has none";
            return none;
        }
        certificate::AgreedSpecification here = specification;
        here.lower = limits.lower;
        here.upper = limits.upper;
        return verdict_of(here, column, value, known);
    }

    [[nodiscard]] KnownDistribution known_distribution(const CertifiedValue& value, const Result* result) const;
};

/// \param result  of a budget or of the set-up; none for another quantity of a rotary table
KnownDistribution Certifier::known_distribution(const CertifiedValue& value, const Result* result) const {
    if (value.coverage == "monte_carlo") {
        const auto found = result != nullptr ? inputs_.trials.find(result->name) : inputs_.trials.end();
        if (found != inputs_.trials.end()) {
            gum::TrialDistribution trials = gum::count_trials(found->second);
            return {.function = std::move(trials.function),
                    .below = std::move(trials.below),
                    .note = "Probabilities are counted from " + std::to_string(trials.counted) + " Monte Carlo trials.",
                    .trials = trials.counted};
        }
        return {.function = {},
                .below = {},
                .note =
                    "Probabilities are those of a normal distribution with the stated U and k; the Monte Carlo "
                    "trials were not kept."};
    }
    if (result == nullptr) {
        return {};
    }
    // Also where k is that of t_p(ν_eff): a k that agrees at 95 % says nothing of the tails.
    if (const auto found = inputs_.distributions.find(result->name); found != inputs_.distributions.end()) {
        certificate::ResultDistribution known = found->second();
        if (!known.function) {
            return {};
        }
        // Draws of correlated inputs leave a probability open as trials do.
        const std::string drawn =
            known.draws > 0 ? " Correlated inputs enter it by " + std::to_string(known.draws) + " draws." : "";
        return {.function = std::move(known.function),
                .below = std::move(known.below),
                .note = "Probabilities are those of the convolution of all input distributions." + drawn,
                .trials = known.draws,
                .least_probability = known.least_probability};
    }
    if (result->coverage == "convolution") {
        return {.function = {},
                .below = {},
                .note =
                    "Probabilities are those of a normal distribution with the stated U and k; the result itself "
                    "is not normally distributed."};
    }
    return {};
}

/// Once a result, however many points it has.
void add_s05(std::vector<Finding>& findings, const std::string& result, const std::string& what,
             const std::string& action) {
    const bool known =
        std::any_of(findings.begin(), findings.end(), [&](const Finding& f) { return f.where == result; });
    if (!known) {
        findings.push_back({.id = "S05",
                            .clause = "JCGM 101:2008, clause 8",
                            .severity = certificate::FindingSeverity::critical,
                            .where = result,
                            .what = what,
                            .action = action});
    }
}

void add_against(std::vector<Finding>& findings, const std::string& result, const std::string& against) {
    add_s05(findings, result,
            "the law of propagation is reported because the job asks for it, although " + gum::reason_in_words(against),
            "Leave out \"coverage\": \"law_of_propagation\" in the job: then the result of Monte Carlo is reported.");
}

/// The same with what the law and the trials give, where the evaluation tells it of the result.
std::string with_numbers(const EvaluationRecord& record, const std::string& result, const std::string& what) {
    for (const gum::Diagnostic& message : record.diagnostics) {
        const bool is_of_result =
            message.where == "result " + result || message.where.starts_with("result " + result + " at ");
        if (is_of_result && message.what.starts_with(what + ": ")) {
            return message.what;
        }
    }
    return what;
}

/// Results that Monte Carlo does not confirm, although ±U of the law of propagation is certified.
void note_validation(std::vector<Finding>& findings, const std::string& result,
                     const std::optional<reports::MonteCarloSummary>& trials) {
    if (trials && trials->validation && trials->validation->precise_enough && !trials->validation->validated) {
        add_s05(findings, result, "Monte Carlo does not validate the stated expanded uncertainty",
                "See the Monte Carlo interval in the record; improve the measurement, or agree on the interval as the "
                "result.");
    }
}

std::vector<Finding> validation_findings(const EvaluationRecord& record) {
    std::vector<Finding> findings;
    for (const Result& result : record.results) {
        const std::string name = result.quantity.empty() ? result.name : result.quantity;
        const reports::ReportedResult reported = reports::reported_result(result);
        if (!reported.against.empty()) {
            add_against(findings, name, reported.against);
            findings.back().what = with_numbers(record, name, findings.back().what);
        }
        if (reported.method == "law_of_propagation") {
            note_validation(findings, name, result.monte_carlo);
        }
    }
    if (!record.rotary) {
        return findings;
    }
    for (const auto& place : reports::stated_values(*record.rotary)) {
        const std::string name = reports::result_name(place.group, place.name);
        if (!place.stated.reported) {
            note_validation(findings, name, place.stated.monte_carlo);
        } else if (!place.stated.reported->against.empty()) {
            add_against(findings, name, place.stated.reported->against);
        }
    }
    return findings;
}

}  // namespace

void certify(EvaluationRecord& record, CertificateData data, Profile profile,
             const certificate::CapabilityInputs& inputs, const std::vector<Finding>& of_register) {
    record.certificate.emplace();
    record.certificate->data = std::move(data);
    record.certificate->profile = std::move(profile);
    for (Result& result : record.results) {
        result.reported = reports::reported_result(result);
    }
    std::vector<CertifiedTable> tables = reports::certified_tables(record);
    Certifier certifier(record, inputs);
    certifier.certify_tables(tables);
    record.certificate->tables = std::move(tables);
    std::vector<Finding> audit = certifier.findings();
    std::vector<Finding> validation = validation_findings(record);
    if (record.certificate->data.status != "accredited") {
        for (Finding& finding : validation) {
            finding.severity = certificate::FindingSeverity::major;
        }
    }
    audit.insert(audit.end(), validation.begin(), validation.end());
    const std::vector<Finding> evaluation = evaluation_findings(record);
    audit.insert(audit.end(), evaluation.begin(), evaluation.end());
    const std::vector<Finding> environment = environment_findings(record);
    audit.insert(audit.end(), environment.begin(), environment.end());
    const std::vector<Finding> traceability = traceability_findings(record);
    audit.insert(audit.end(), traceability.begin(), traceability.end());
    audit.insert(audit.end(), of_register.begin(), of_register.end());
    state_changes(record);
    certificate::pass_gates(*record.certificate, audit);
}

}  // namespace gumcert::reports
