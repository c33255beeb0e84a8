#include "reports/record/make/certificate/certified_traceability.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "certificate/gates/finding_list.h"
#include "certificate/stated_text.h"
#include "certificate/text_words.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/make/certificate/certified_measurand.h"
#include "reports/record/record_kinds.h"

namespace gumcert::reports {

namespace {

using certificate::Finding;
using certificate::FindingSeverity;
using certificate::StandardUsed;

using Words = std::vector<std::u32string>;

constexpr double k_usual_factor = 2.0;  // of a certificate that states no k

void collect_sources(const std::vector<reports::BudgetRow>& rows, std::vector<Words>& sources) {
    for (const reports::BudgetRow& row : rows) {
        sources.push_back(certificate::words_of(row.source));
        collect_sources(row.components, sources);
    }
}

/// Whether whole words of a source are a text, however both are divided: "STD-017" is in "STD 017, certificate 4", and
/// "ST" is not in "best estimate".
bool has_words(const Words& source, const std::u32string& letters) {
    for (std::size_t first = 0; first < source.size(); ++first) {
        std::u32string run;
        for (std::size_t last = first; last < source.size() && run.size() < letters.size(); ++last) {
            run += source[last];
            if (run == letters) {
                return true;
            }
        }
    }
    return false;
}

bool is_named(const std::string& text, const std::vector<Words>& sources) {
    const std::u32string letters = certificate::letters_of(text);
    return certificate::is_stated(text) && letters.size() > 1 &&
           std::any_of(sources.begin(), sources.end(), [&](const Words& source) { return has_words(source, letters); });
}

bool is_named(const StandardUsed& s, const std::vector<Words>& sources) {
    return is_named(s.identification, sources) || is_named(s.certificate, sources) ||
           is_named(s.name.in("en"), sources);
}

/// What the rows of one result take from a standard.
using Taken = std::vector<const reports::BudgetRow*>;

void collect_rows(const std::vector<reports::BudgetRow>& rows, const StandardUsed& s, Taken& taken) {
    for (const reports::BudgetRow& row : rows) {
        const bool by_component = std::any_of(row.components.begin(), row.components.end(),
                                              [](const reports::BudgetRow& c) { return !c.source.empty(); });
        if (!by_component && is_named(s, {certificate::words_of(row.source)})) {
            taken.push_back(&row);
        }
        collect_rows(row.components, s, taken);
    }
}

bool is_relative(const gum::Unit& unit) {
    return unit.dimension().is_one();
}

/// The standard uncertainty that a certificate states for a row, in SI units; nothing where its unit is another one.
std::optional<double> stated_u(const StandardUsed& s, const reports::BudgetRow& row) {
    const gum::Unit stated = gum::Unit::parse(s.unit);
    const gum::Unit of_row = gum::Unit::parse(row.unit);
    const double u = stated.difference_to_si(*s.U) / s.k.value_or(k_usual_factor);
    if (stated.dimension() == of_row.dimension()) {
        return u;
    }
    if (!is_relative(stated) || !row.value.number || of_row.is_celsius_temperature()) {
        return std::nullopt;
    }
    return u * std::abs(of_row.to_si(*row.value.number));
}

/// One finding of what a budget takes from a standard; none where it fits.
struct Comparison {
    double u = 0.0, stated = 0.0;  ///< SI units, summed in quadrature over the rows of a result
    bool any = false;              ///< a row has the unit of the certificate
    const reports::BudgetRow* constant = nullptr;
};

Comparison compared(const StandardUsed& s, const Taken& taken) {
    Comparison out;
    for (const reports::BudgetRow* row : taken) {
        const std::optional<double> stated = stated_u(s, *row);
        if (!stated) {
            continue;
        }
        out.any = true;
        const double u = gum::Unit::parse(row->unit).difference_to_si(row->u.number);
        out.u = std::hypot(out.u, u);
        out.stated = std::max(out.stated, *stated);
        if (row->u.number == 0.0 && row->value.number) {
            out.constant = row;
        }
    }
    return out;
}

Finding finding(FindingSeverity severity, std::size_t standard, std::string what) {
    return {.id = "T09",
            .clause = certificate::iso_17025("7.6.1"),
            .severity = severity,
            .where = certificate::place_in("/standards", standard, "U"),
            .what = std::move(what),
            .action =
                "Put the uncertainty of the certificate of the standard into the budget, or correct what is "
                "stated of the standard."};
}

/// The uncertainty that a budget takes from a standard is the one of its certificate: half of it may stand for a part
/// of a range, or for one of several contributions; much less cannot.
std::optional<Finding> against_budget(const reports::EvaluationRecord& record, const StandardUsed& s, std::size_t i) {
    constexpr double k_part = 0.5;
    constexpr double k_little = 0.2;
    constexpr double k_nothing = 0.01;
    bool named = false;
    bool any = false;
    Comparison best;
    for (const reports::Result& result : record.results) {
        Taken taken;
        collect_rows(result.budget, s, taken);
        const Comparison one = compared(s, taken);
        named = named || !taken.empty();
        any = any || one.any;
        if (one.any && (best.stated <= 0.0 || one.u * best.stated > best.u * one.stated)) {
            best = one;
        }
    }
    const std::string standard = "the standard \"" + s.name.in("en") + "\"";
    if (named && !any) {
        return finding(FindingSeverity::minor, i,
                       "the uncertainty of " + standard + " is stated in \"" + s.unit +
                           "\", and no input that names it has such a unit");
    }
    if (any && best.u == 0.0 && best.constant != nullptr) {
        return finding(FindingSeverity::critical, i,
                       "the input \"" + best.constant->input + "\" comes from " + standard + " and has no uncertainty");
    }
    if (!any || best.u >= k_part * best.stated) {
        return std::nullopt;
    }
    const gum::Unit unit = gum::Unit::parse(s.unit);
    const auto in_unit = [&](double u) {
        const double stated =
            is_relative(unit) ? u / best.stated * *s.U / s.k.value_or(k_usual_factor) : unit.difference_from_si(u);
        return gum::round_significant(stated, 2) + " " + s.unit;
    };
    return finding(best.u < k_nothing * best.stated  ? FindingSeverity::critical
                   : best.u < k_little * best.stated ? FindingSeverity::major
                                                     : FindingSeverity::minor,
                   i,
                   "the budget takes a standard uncertainty of " + in_unit(best.u) + " from " + standard +
                       ", and its certificate states " + in_unit(best.stated));
}

std::vector<Finding> source_findings(const reports::EvaluationRecord& record) {
    std::vector<Words> sources;
    for (const reports::Result& result : record.results) {
        collect_sources(result.budget, sources);
    }
    const std::vector<StandardUsed>& standards = record.certificate->data.standards;
    if (sources.empty() || standards.empty()) {
        return {};
    }
    const std::string clause = certificate::iso_17025("6.5");
    if (std::none_of(standards.begin(), standards.end(), [&](const StandardUsed& s) { return is_named(s, sources); })) {
        return {{.id = "T06",
                 .clause = clause,
                 .severity = FindingSeverity::major,
                 .where = "/standards",
                 .what = "no input of the budget names one of the standards as its source",
                 .action =
                     "State in \"source\" of the inputs the identification of the standard or its certificate, or "
                     "list the standards that were used."}};
    }
    std::vector<Finding> findings;
    for (std::size_t i = 0; i < standards.size(); ++i) {
        if (!is_named(standards[i], sources)) {
            findings.push_back({.id = "T06",
                                .clause = clause,
                                .severity = FindingSeverity::minor,
                                .where = certificate::place_in("/standards", i),
                                .what = "no input of the budget names the standard \"" + standards[i].name.in("en") +
                                        "\" as its source",
                                .action = "State it in \"source\" of the input that comes from it, or remove it from "
                                          "the list."});
        }
    }
    for (std::size_t i = 0; i < standards.size(); ++i) {
        if (standards[i].U && !standards[i].unit.empty()) {
            if (std::optional<Finding> one = against_budget(record, standards[i], i)) {
                findings.push_back(std::move(*one));
            }
        }
    }
    return findings;
}

}  // namespace

std::vector<Finding> traceability_findings(const reports::EvaluationRecord& record) {
    // The sources of a rotary table are not inputs of a model; those of a comparison are of other laboratories.
    if (record.kind == reports::k_rotary_table_kind || record.kind == reports::k_comparison_kind ||
        !record.certificate) {
        return {};
    }
    std::vector<Finding> findings = source_findings(record);
    for (Finding& more : measurand_findings(record)) {
        findings.push_back(std::move(more));
    }
    return findings;
}

}  // namespace gumcert::reports
