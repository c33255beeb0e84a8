#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "certificate/capability.h"
#include "certificate/dates.h"
#include "certificate/gates/cited_documents.h"
#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"
#include "certificate/gates/held_against.h"
#include "certificate/stated_text.h"
#include "certificate/text_words.h"
#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"

namespace gumcert::certificate {

namespace {

using gum::Unit;

void validity(FindingList& found, const Accreditation& a) {
    constexpr long k_longest_in_days = 20 * 366;
    if (a.valid_from.empty() || a.valid_to.empty()) {
        // With one of the two days the dates of the work can still be held against the scope, with none they cannot.
        const bool both = a.valid_from.empty() && a.valid_to.empty();
        found.add(both ? FindingSeverity::critical : FindingSeverity::major, "X09", k_p8,
                  a.valid_to.empty() ? "/accreditation/valid_to" : "/accreditation/valid_from",
                  both ? "it is not said when the scope of accreditation is valid"
                       : "it is not said " + std::string(a.valid_to.empty() ? "until" : "since") +
                             " when the scope of accreditation is valid",
                  "State the days of the certificate of accreditation.");
    } else if (is_after(a.valid_from, a.valid_to)) {
        found.critical("X09", k_p8, "/accreditation/valid_to",
                       "the scope of accreditation ends on " + a.valid_to + ", before it begins on " + a.valid_from,
                       "Correct the dates.");
    } else if (days_between(a.valid_from, a.valid_to).value_or(0) > k_longest_in_days) {
        found.major("X09", k_p8, "/accreditation/valid_to",
                    "the scope of accreditation is to be valid from " + a.valid_from + " to " + a.valid_to +
                        ", more than twenty years",
                    "State the days of the certificate of accreditation.");
    }
}

void signatories(FindingList& found, const Accreditation& a) {
    const bool any =
        std::any_of(a.signatories.begin(), a.signatories.end(), [](const std::string& name) { return is_name(name); });
    if (!any) {
        const std::string given = a.signatories.empty() ? "" : a.signatories.front();
        found.critical("X10", iso_17025("6.2.6"), "/accreditation/signatories",
                       what_of_name(given, "no signatory of accredited certificates is named"),
                       action_of_name(given, "Name the persons who may authorise accredited certificates."));
    }
}

/// Which values of the results an entry of the scope covers, each in the unit of its column; measured() converts.
struct Covered {
    std::vector<const CertifiedValue*> values;
    std::vector<const CertifiedColumn*> columns;  ///< of each value
    std::vector<const CertifiedTable*> tables;
    std::vector<std::size_t> rows;

    [[nodiscard]] Measured measured(std::size_t v, const Unit& unit) const {
        return measured_at(*tables[v], *columns[v], rows[v], unit);
    }
};

Covered covered_by(const Certificate& certificate, const ScopeEntry& entry) {
    Covered covered;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                const CertifiedValue& value = column.values[row];
                if (value.scope_entry == entry.id && !value.external) {
                    covered.values.push_back(&value);
                    covered.columns.push_back(&column);
                    covered.tables.push_back(&table);
                    covered.rows.push_back(row);
                }
            }
        }
    }
    return covered;
}

const Parameter* parameter_of(const CertificateData& data, const std::string& name) {
    const auto found = std::find_if(data.parameters.begin(), data.parameters.end(),
                                    [&](const Parameter& p) { return p.name == name; });
    return found == data.parameters.end() ? nullptr : &*found;
}

/// Whether the certificate itself states the number that a range is held against, and no result or input does.
bool is_stated_by_author(const CertificateData& data, const CapabilityArgument& argument) {
    return argument.of != "value" && argument.of != "argument" && parameter_of(data, argument.of) != nullptr;
}

/// Whether a range, or the points of a capability, limit the measurand itself.
/// \param inputs  whether an input of another kind does: that of a relative error, or of a ratio
bool limits_the_measurand(const CertificateData& data, const ScopeEntry& entry, const CertifiedColumn& column,
                          bool inputs) {
    const auto limits = [&](const CapabilityArgument& argument) {
        const bool input = argument.of != "value" && argument.of != "argument" && !is_stated_by_author(data, argument);
        const gum::Unit of = Unit::parse(argument.unit);
        const gum::Unit result = Unit::parse(column.unit);
        return argument.of == "value" || argument.of == "argument" || of_one_kind(of, result) ||
               (input && (inputs || of.dimension() == result.dimension() || result.dimension().is_one()));
    };
    const bool points =
        entry.capability.form == "range" || entry.capability.form == "table" || entry.capability.form == "matrix";
    return std::any_of(entry.ranges.begin(), entry.ranges.end(),
                       [&](const ScopeEntry::Range& range) { return limits(range.argument); }) ||
           (points && std::any_of(entry.capability.arguments.begin(), entry.capability.arguments.end(), limits));
}

void ranges(FindingList& found, const Certificate& certificate, const ScopeEntry& entry, std::size_t i,
            const Covered& covered) {
    const std::string where = place_in("/accreditation/scope", i, "ranges");
    if (!limits_the_measurand(certificate.data, entry, *covered.columns.front(), false)) {
        const bool by_input = limits_the_measurand(certificate.data, entry, *covered.columns.front(), true);
        found.add(by_input ? FindingSeverity::minor : FindingSeverity::major, "X11", k_p14, where,
                  "the scope entry \"" + entry.id + "\" has no range of the quantity that was measured",
                  "State between which values the scope holds, as it is worded there.");
    }
    for (const ScopeEntry::Range& range : entry.ranges) {
        if (!is_stated_by_author(certificate.data, range.argument)) {
            continue;
        }
        const Parameter& parameter = *parameter_of(certificate.data, range.argument.of);
        const Unit unit = Unit::parse(range.argument.unit);
        const Unit stated = Unit::parse(parameter.unit);
        std::vector<Finding> of_points;
        for (std::size_t v = 0; v < covered.values.size(); ++v) {
            const Measured measured = covered.measured(v, unit);
            const Unit of = Unit::parse(measured.unit);
            if (!of_one_kind(of, unit) || !of_one_kind(stated, unit)) {
                continue;
            }
            const double value = value_for_scope(measured.value, of, unit, range.low);
            const double claimed = value_for_scope(parameter.value, stated, unit, range.low);
            // Below a range of magnitudes lies 0, the result of a zero point or of a small error; that an item was
            // better than the range is no breach of it.
            const double low = has_sign(unit, range.low) ? range.low : 0.0;
            if (is_nominal_in(claimed, value, low, range.high) && !is_beyond(value, low, range.high)) {
                continue;
            }
            const bool beyond = is_beyond(value, low, range.high);
            of_points.push_back(
                {.id = "X12",
                 .clause = k_p14,
                 .severity = beyond ? FindingSeverity::critical : FindingSeverity::minor,
                 .where = where,
                 .what = "the range of \"" + entry.id + "\" is held against the parameter \"" + parameter.name +
                         "\" = " + text::shortest(parameter.value) + " " + parameter.unit + ", and " +
                         measured.in_words,
                 .action = beyond ? action_of_range(measured)
                                  : "See whether the parameter is the nominal value of what was measured."});
        }
        found.add_gravest(of_points);
    }
}

void parameters_of_capability(FindingList& found, const Certificate& certificate, const ScopeEntry& entry,
                              std::size_t i, const Covered& covered) {
    for (const CapabilityArgument& argument : entry.capability.arguments) {
        if (!is_stated_by_author(certificate.data, argument)) {
            continue;
        }
        const Parameter& parameter = *parameter_of(certificate.data, argument.of);
        const HeldAgainst held{.name = parameter.name, .value = parameter.value, .unit = parameter.unit};
        std::vector<Finding> of_points;
        for (std::size_t v = 0; v < covered.values.size(); ++v) {
            if (std::optional<Finding> finding = capability_taken_elsewhere(
                    entry, i, argument, held, covered.measured(v, Unit::parse(argument.unit)))) {
                of_points.push_back(std::move(*finding));
            }
        }
        found.add_gravest(of_points);
    }
}

/// Values of the arguments at the ends and in the middle of the ranges; empty where an argument has no range.
std::vector<std::vector<ArgumentValue>> places_of(const ScopeEntry& entry) {
    std::vector<std::vector<ArgumentValue>> places = {{}};
    for (const CapabilityArgument& argument : entry.capability.arguments) {
        const auto range = std::find_if(entry.ranges.begin(), entry.ranges.end(),
                                        [&](const ScopeEntry::Range& r) { return r.argument.name == argument.name; });
        if (range == entry.ranges.end() || range->argument.unit != argument.unit) {
            return {};
        }
        constexpr int k_steps = 8;
        std::vector<std::vector<ArgumentValue>> more;
        for (const std::vector<ArgumentValue>& place : places) {
            for (int step = 0; step <= k_steps; ++step) {
                more.push_back(place);
                more.back().push_back({argument.name, range->low + (range->high - range->low) * step / k_steps});
            }
        }
        places = std::move(more);
        // Nine places for each argument: four arguments would make 6561 of them. The check is one for slips, and may
        // stay incomplete.
        if (places.size() > 1000) {
            return {};
        }
    }
    return places;
}

/// Whether the bracket before a sign follows an operator: "+(-45)", "*(-1)", not "^(-1)".
bool is_behind_operator(const std::string& expression, std::size_t sign) {
    const std::size_t bracket = expression.rfind('(', sign);
    const std::size_t before = bracket == 0 ? std::string::npos : expression.find_last_not_of(" \t", bracket - 1);
    return before != std::string::npos && std::string("+-*/").find(expression[before]) != std::string::npos;
}

/// A minus of an expression that takes away: capabilities add up, they do not subtract. Exponents ("1E-3", "L^-1",
/// "L^(-1)") and signs at the beginning of a term of Q do not count; those of a factor or of a term in brackets do.
bool subtracts(const std::string& expression) {
    char before = '(';
    for (std::size_t at = 0; at < expression.size(); ++at) {
        const char c = expression[at];
        if (c == '-' && before == '(' && at > 0 && is_behind_operator(expression, at)) {
            return true;
        }
        if (c == '-' && std::string("([,+-*/^").find(before) == std::string::npos) {
            const bool of_exponent =
                (before == 'e' || before == 'E') && at >= 2 && expression[at - 2] >= '0' && expression[at - 2] <= '9';
            if (!of_exponent) {
                return true;
            }
        }
        before = c == ' ' ? before : c;
    }
    return false;
}

/// The smallest expanded uncertainty (k = 2) of a reference standard of the dimension of a capability, in SI units.
/// Where none is called one, of every standard.
std::optional<double> best_reference(const CertificateData& data, const Unit& unit) {
    std::optional<double> best;
    const bool any = std::any_of(data.standards.begin(), data.standards.end(),
                                 [](const StandardUsed& s) { return s.role == "reference"; });
    for (const StandardUsed& s : data.standards) {
        if (!s.U || s.unit.empty() || (any && s.role != "reference")) {
            continue;
        }
        const Unit of = Unit::parse(s.unit);
        if (of.dimension() == unit.dimension() && !unit.dimension().is_one()) {
            // For k = 2, as capabilities are stated.
            const double U = 2.0 * of.difference_to_si(*s.U) / s.k.value_or(2.0);
            best = std::min(best.value_or(U), U);
        }
    }
    return best;
}

/// \param v  number of the covered value
Finding capability_too_small(FindingSeverity severity, const std::string& where, const ScopeEntry& entry,
                             const Covered& covered, std::size_t v, const std::string& how) {
    return {.id = "X14",
            .clause = k_p14,
            .severity = severity,
            .where = where,
            .what = "the capability of \"" + entry.id + "\" is " + covered.values[v]->printed_capability + " " +
                    covered.columns[v]->unit + " for \"" + covered.columns[v]->result + "\", " + how,
            .action = "Correct the capability as the scope states it, or name the standard that allows it."};
}

/// A result that is known as well as a reference standard has no capability far below of the standard. One at the lower
/// end of a wide range may.
void capability_against_reference(FindingList& found, const ScopeEntry& entry, const std::string& where,
                                  const Covered& covered, double best) {
    constexpr double k_far_below = 0.1;
    constexpr double k_below = 0.5;
    std::vector<Finding> of_points;
    for (std::size_t v = 0; v < covered.values.size(); ++v) {
        const CertifiedValue& value = *covered.values[v];
        const Unit unit = Unit::parse(covered.columns[v]->unit);
        // Only a result whose own U is not below that of the standard is of the kind of the standard: at the lower end
        // of a wide range both may be far apart rightly.
        const bool comparable = value.U && value.capability &&
                                unit.dimension() == Unit::parse(entry.capability.unit).dimension() &&
                                2.0 * unit.difference_to_si(*value.U) >= best;
        if (!comparable || unit.difference_to_si(*value.capability) >= k_below * best) {
            continue;
        }
        const bool far = unit.difference_to_si(*value.capability) < k_far_below * best;
        of_points.push_back(capability_too_small(far ? FindingSeverity::major : FindingSeverity::minor, where, entry,
                                                 covered, v,
                                                 std::string("less than ") + (far ? "a tenth" : "half") +
                                                     " of the uncertainty of every reference standard"));
    }
    found.add_gravest(of_points);
}

/// A capability is what the laboratory reaches: a result with a hundred times its uncertainty is of another kind of
/// item, or the capability is none.
bool capability_against_results(FindingList& found, const std::string& where, const ScopeEntry& entry,
                                const Covered& covered) {
    constexpr double k_far_below = 0.01;
    constexpr double k_never = 0.001;
    std::vector<Finding> of_points;
    for (std::size_t v = 0; v < covered.values.size(); ++v) {
        const CertifiedValue& value = *covered.values[v];
        if (value.U && value.capability && *value.capability < k_far_below * *value.U) {
            of_points.push_back(capability_too_small(
                *value.capability < k_never * *value.U ? FindingSeverity::major : FindingSeverity::minor, where, entry,
                covered, v, "less than a hundredth of the expanded uncertainty that was evaluated"));
        }
    }
    return found.add_gravest(of_points);
}

void capability(FindingList& found, const Certificate& certificate, const ScopeEntry& entry, std::size_t i,
                const Covered& covered) {
    const std::string where = place_in("/accreditation/scope", i, "capability");
    const Capability& c = entry.capability;
    if (!check_capability(c).empty()) {
        return;  // reported by X05
    }
    if (c.form == "function") {
        const CapabilityEvaluator evaluator(c);
        for (const std::vector<ArgumentValue>& place : places_of(entry)) {
            const CapabilityAt at = evaluator.at(place);
            if (!at.U) {
                found.critical("X05", k_p14, where + "/expression",
                               "the capability of \"" + entry.id + "\" has no value in its own range, at " +
                                   place.front().name + " = " + text::shortest(place.front().value) + ": " + at.reason,
                               "State the expression as the scope does, or the range in which it holds.");
                break;
            }
        }
        if (subtracts(c.expression)) {
            found.add(FindingSeverity::minor, "X14", k_p14, where + "/expression",
                      "the capability of \"" + entry.id + "\" is a difference: " + c.expression,
                      "See whether it is the expression of the scope: contributions to an uncertainty add up.");
        }
    }
    if (capability_against_results(found, where, entry, covered)) {
        return;
    }
    if (const auto best = best_reference(certificate.data, Unit::parse(c.unit))) {
        capability_against_reference(found, entry, where, covered, *best);
    }
}

void symbol(FindingList& found, const Accreditation& a) {
    if (!a.symbol_file) {
        found.add(FindingSeverity::minor, "X15", k_p8, "/accreditation/symbol_file",
                  "the certificate is accredited, and no accreditation symbol is given",
                  "Give the file of the symbol, as the body supplied it.");
    }
}

/// An entry that does not say for which measurand it holds.
void measurands(FindingList& found, const Accreditation& a) {
    for (std::size_t i = 0; i < a.scope.size(); ++i) {
        if (!is_name(a.scope[i].measurand)) {
            found.add(FindingSeverity::minor, "X13", k_p8, place_in("/accreditation/scope", i, "measurand"),
                      "it is not said what the scope entry \"" + a.scope[i].id + "\" is for",
                      "State the measurand as the scope words it.");
        }
    }
}

}  // namespace

std::vector<Finding> scope_findings(const Certificate& certificate) {
    FindingList found(certificate.data);
    if (!certificate.data.accreditation) {
        return {};
    }
    const Accreditation& a = *certificate.data.accreditation;
    validity(found, a);
    signatories(found, a);
    symbol(found, a);
    measurands(found, a);
    for (std::size_t i = 0; i < a.scope.size(); ++i) {
        const Covered covered = covered_by(certificate, a.scope[i]);
        if (!covered.values.empty()) {
            ranges(found, certificate, a.scope[i], i, covered);
            parameters_of_capability(found, certificate, a.scope[i], i, covered);
            capability(found, certificate, a.scope[i], i, covered);
        }
    }
    return found.take();
}

}  // namespace gumcert::certificate
