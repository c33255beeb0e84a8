#include "reports/dcc/dcc_statements.h"

#include "reports/printable_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "gum/coverage.h"
#include "gum/quantity/unit.h"
#include "reports/dcc/breach_limits.h"
#include "reports/dcc/d_si_unit.h"
#include "reports/dcc/dcc_element.h"
#include "reports/dcc/printed_number.h"
#include "reports/view/certificate_view.h"
#include "text/small_letters.h"

namespace gumcert::reports {

namespace {

std::string shown(const std::string& text) {
    return shortened(printable(text), k_shown);
}

/// Numbers with their unit, as one si:real or si:realListXMLList states them.
struct Numbers {
    std::vector<std::string> texts;
    std::string unit;
};

/// The entry of a row of a list, which may have one entry for all rows.
std::string entry(const std::vector<std::string>& list, std::size_t row) {
    return list.size() == 1 ? list.front() : row < list.size() ? list[row] : std::string();
}

std::vector<Numbers> forms_of(const XmlElement& quantity) {
    std::vector<Numbers> forms;
    for (const XmlElement& form : quantity.children) {
        if (form.name == "si:hybrid") {
            const std::vector<Numbers> inner = forms_of(form);
            forms.insert(forms.end(), inner.begin(), inner.end());
        } else if (form.name == "si:real" || form.name == "si:constant") {
            forms.push_back({{form.child_text("si:value")}, form.child_text("si:unit")});
        } else if (form.name == "si:realListXMLList") {
            const std::vector<std::string> units = xml_list(form.child_text("si:unitXMLList"));
            const bool one = !units.empty() && std::all_of(units.begin(), units.end(),
                                                           [&](const std::string& u) { return u == units.front(); });
            forms.push_back({xml_list(form.child_text("si:valueXMLList")), one ? units.front() : ""});
        }
    }
    return forms;
}

/// What one of the second unit is in the first; nothing where the units are of different kinds, or temperatures of
/// different scales.
std::optional<double> factor_between(const std::string& to, const std::string& from) {
    if (to == from) {
        return 1.0;
    }
    const std::optional<std::string> a = unit_from_d_si(to);
    const std::optional<std::string> b = unit_from_d_si(from);
    // A factor alone does not lead from °C to K. Two values in °C have the same unit and were answered above.
    if (!a || !b || *a == "degC" || *b == "degC") {
        return std::nullopt;
    }
    const gum::Unit first = gum::Unit::parse(*a);
    const gum::Unit second = gum::Unit::parse(*b);
    return first.dimension() == second.dimension()
               ? std::optional(second.difference_to_si(1.0) / first.difference_to_si(1.0))
               : std::nullopt;
}

/// Limits beside a statement of conformity: what stands in their refType or their name.
struct Limit {
    std::vector<Numbers> forms;
    bool lower = false, acceptance = false;
};

bool holds(const std::string& text, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

std::optional<Limit> limit_from(const XmlElement& quantity) {
    const std::string ref_type = text::in_small_letters(quantity.attribute("refType"));
    const std::string name = text::in_small_letters(content_in(quantity.child("dcc:name"), "en"));
    const std::string& words = ref_type.find("limit") != std::string::npos ? ref_type : name;
    const bool lower = holds(words, {"lower", "min"});
    const bool upper = holds(words, {"upper", "max"});
    if (words.find("limit") == std::string::npos || lower == upper) {
        return std::nullopt;
    }
    return Limit{.forms = forms_of(quantity), .lower = lower, .acceptance = holds(words, {"accept"})};
}

std::vector<Limit> limits_in(const XmlElement& element) {
    std::vector<Limit> limits;
    for_each_element(element, [&](const XmlElement& e) {
        const std::optional<Limit> limit = e.name == "dcc:quantity" ? limit_from(e) : std::nullopt;
        if (limit) {
            limits.push_back(*limit);
        }
    });
    return limits;
}

class Statements {
public:
    explicit Statements(std::string file) : file_(std::move(file)) {}

    void in(const XmlElement& root) {
        for_each_element(root, [&](const XmlElement& e) {
            siblings(e);
            coverage(e);
            units(e);
        });
    }
    std::vector<gum::Diagnostic> found;

private:
    void report(const char* code, const XmlElement& at, std::string what, std::string rule, std::string action,
                gum::Severity severity = gum::Severity::error) {
        if (found.size() < k_most_breaches) {
            found.push_back({.code = code,
                             .where = place_of(at, file_),
                             .what = std::move(what),
                             .rule = std::move(rule),
                             .action = std::move(action),
                             .severity = severity});
        }
    }
    void siblings(const XmlElement& parent);
    void conformity(const XmlElement& quantity, const std::vector<Limit>& beside);
    void verdicts(const XmlElement& at, const std::vector<std::string>& words, const std::vector<Numbers>& values,
                  const std::vector<Limit>& limits);
    void coverage(const XmlElement& e);
    void units(const XmlElement& e);

    std::string file_;
};

/// Quantities with a conformity; limits may stand in its data, in other meta data of the quantity, or as quantities
/// beside it where only one has a conformity.
void Statements::siblings(const XmlElement& parent) {
    std::vector<const XmlElement*> decided;
    std::vector<Limit> beside;
    for (const XmlElement* quantity : parent.children_named("dcc:quantity")) {
        if (quantity->child("dcc:measurementMetaData") != nullptr) {
            decided.push_back(quantity);
        }
        const bool named = text::in_small_letters(quantity->attribute("refType")).find("limit") != std::string::npos;
        const std::optional<Limit> limit = named ? limit_from(*quantity) : std::nullopt;
        if (limit) {
            beside.push_back(*limit);
        }
    }
    for (const XmlElement* quantity : decided) {
        // With several decided quantities nobody can know which of them a limit beside belongs to.
        conformity(*quantity, decided.size() == 1 ? beside : std::vector<Limit>());
    }
}

void Statements::conformity(const XmlElement& quantity, const std::vector<Limit>& beside) {
    const XmlElement& meta = *quantity.child("dcc:measurementMetaData");
    const std::vector<Numbers> values = forms_of(quantity);
    for (const XmlElement* data : meta.children_named("dcc:metaData")) {
        const XmlElement* const list = data->child("dcc:conformityXMLList");
        const XmlElement* const one = list == nullptr ? data->child("dcc:conformity") : list;
        if (one == nullptr) {
            continue;
        }
        std::vector<Limit> limits = limits_in(*data);
        limits = limits.empty() ? limits_in(meta) : limits;
        verdicts(*one, xml_list(one->text), values, limits.empty() ? beside : limits);
    }
}

/// How far a value lies outside of a limit, in words: 1 outside by more than rounding can explain, -1 inside, 0
/// neither.
int outside(const Numbers& value, const Limit& limit, std::size_t row) {
    for (const Numbers& form : limit.forms) {
        const std::optional<double> factor = factor_between(value.unit, form.unit);
        const auto y = printed_number(entry(value.texts, row));
        const auto end = printed_number(entry(form.texts, row));
        if (factor && y && end) {
            const double beyond = (limit.lower ? -1.0 : 1.0) * (y->value - *factor * end->value);
            // Printed numbers stand for a range of half a unit of the last digit on both sides. A value is called
            // outside only if every value in its range is outside of every limit in the limit's range.
            const double rounding = (y->half_unit + *factor * end->half_unit) * (1.0 + 1e-9);
            return beyond > rounding ? 1 : beyond < -rounding ? -1 : 0;
        }
    }
    return 0;
}

/// Told once for a list: the others will have the same reason.
void Statements::verdicts(const XmlElement& at, const std::vector<std::string>& words,
                          const std::vector<Numbers>& values, const std::vector<Limit>& limits) {
    const bool acceptance = std::any_of(limits.begin(), limits.end(), [](const Limit& l) { return l.acceptance; });
    for (const Numbers& value : values) {
        for (std::size_t row = 0; row < value.texts.size(); ++row) {
            std::size_t inside = 0;
            bool beyond = false;
            for (const Limit& limit : limits) {
                const int where = outside(value, limit, row);
                // With acceptance limits the verdict follows from them; a tolerance limit that stands beside them
                // decides nothing. Without them the tolerance limits decide.
                beyond = beyond || (where > 0 && limit.acceptance == acceptance);
                inside += where < 0 ? 1U : 0U;
            }
            const std::string word = entry(words, row);
            const std::string number = shown(value.texts[row]) + " " + shown(value.unit);
            if (word == "pass" && beyond) {
                report("GC-DCC-0116", at, "pass for " + number + ", which is outside of a limit beside it",
                       "what passes lies within its acceptance limits, or without such within its tolerance",
                       "correct the conformity, the value or the limit");
                return;
            }
            // A warning only: a rule may demand more than the limits that are stated, so a value inside of them can
            // still fail.
            if (word == "fail" && inside > 0 && inside == limits.size()) {
                report("GC-DCC-0116", at, "fail for " + number + ", which is inside of all limits beside it",
                       "what fails lies outside of a limit", "correct the conformity, the value or the limit",
                       gum::Severity::warning);
                return;
            }
        }
    }
}

struct CoverageNames {
    std::string_view element, factor, probability, distribution;
};

constexpr std::array k_coverage{
    CoverageNames{"si:expandedMU", "si:coverageFactor", "si:coverageProbability", "si:distribution"},
    CoverageNames{"si:expandedUnc", "si:coverageFactor", "si:coverageProbability", "si:distribution"},
    CoverageNames{"si:expandedMUXMLList", "si:coverageFactorXMLList", "si:coverageProbabilityXMLList",
                  "si:distributionXMLList"},
    CoverageNames{"si:expandedUncXMLList", "si:coverageFactorXMLList", "si:coverageProbabilityXMLList",
                  "si:distributionXMLList"}};

/// The factor of a distribution that its name fixes; nothing for others.
std::optional<double> factor_of(const std::string& distribution, double p) {
    const std::string name = text::in_small_letters(distribution);
    if (name == "normal" || name == "gaussian" || name == "gauss") {
        return gum::coverage_factor(p, std::numeric_limits<double>::infinity());
    }
    // A rectangle of half-width a has u = a/√3, and its fraction p lies within p·a: so k = √3 p.
    return name == "uniform" || name == "rectangular" ? std::optional(std::sqrt(3.0) * p) : std::nullopt;
}

void Statements::coverage(const XmlElement& e) {
    const auto names =
        std::find_if(k_coverage.begin(), k_coverage.end(), [&](const CoverageNames& n) { return n.element == e.name; });
    if (names == k_coverage.end()) {
        return;
    }
    const std::vector<std::string> factors = xml_list(e.child_text(names->factor));
    const std::vector<std::string> probabilities = xml_list(e.child_text(names->probability));
    const std::vector<std::string> distributions = xml_list(e.child_text(names->distribution));
    for (std::size_t row = 0; row < std::max(factors.size(), probabilities.size()); ++row) {
        const auto k = printed_number(entry(factors, row));
        const auto p = printed_number(entry(probabilities, row));
        if (!k || !p || !(p->value > 0.0 && p->value < 1.0)) {
            continue;
        }
        const std::optional<double> expected = factor_of(entry(distributions, row), p->value);
        constexpr double k_same = 0.05;  // k = 2 stands for 95 % as for 95.45 %
        constexpr double k_far = 0.10;
        constexpr double k_rounding = 0.05;  // a factor "2" is 2, and not any number from 1.5 to 2.5
        const double difference = expected ? std::abs(k->value - *expected) - std::min(k->half_unit, k_rounding) : 0.0;
        if (expected && difference > k_same * *expected) {
            report("GC-DCC-0117", e,
                   "coverage factor " + shown(entry(factors, row)) + " and probability " +
                       shown(entry(probabilities, row)) + " of a distribution that is called " +
                       shown(entry(distributions, row)),
                   "the probability and the distribution give the coverage factor",
                   "correct one of the three, or name the distribution that was used",
                   difference > k_far * *expected ? gum::Severity::error : gum::Severity::warning);
            return;
        }
    }
}

void Statements::units(const XmlElement& e) {
    static constexpr std::array<std::string_view, 5> k_units{"si:unit", "si:unitXMLList", "si:listUnit", "si:unitPhase",
                                                             "si:unitPhaseXMLList"};
    if (std::find(k_units.begin(), k_units.end(), e.name) == k_units.end()) {
        return;
    }
    for (const std::string& unit : xml_list(e.text)) {
        if (!is_d_si(unit)) {
            report("GC-DCC-0118", e, "the unit \"" + shown(unit) + '"',
                   "units are written as D-SI does: \\milli\\metre, \\metre\\per\\second, \\metre\\tothe{2}; what D-SI "
                   "does not have begins with | and is defined",
                   "write it so");
            return;
        }
    }
}

}  // namespace

std::vector<gum::Diagnostic> contradicting_statements(const XmlElement& root, const std::string& file) {
    Statements statements(file);
    statements.in(root);
    return std::move(statements.found);
}

}  // namespace gumcert::reports
