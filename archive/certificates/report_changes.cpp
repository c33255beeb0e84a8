#include "archive/certificates/report_changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "certificate/statement_of_uncertainty.h"
#include "gum/rounding.h"
#include "reports/record/record_value.h"
#include "text/numbers.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;

std::string_view key_of(std::string_view place) {
    return place.substr(place.rfind('/') + 1);
}

/// A record, leaf by leaf; what documents do not print of names is not in it.
json leaves_of(const reports::EvaluationRecord& record, bool names_may_be_told) {
    reports::EvaluationRecord told = record;
    reports::Comparison& comparison = *told.comparison;
    comparison.budget_files.clear();  // the name of a file tells whose it is
    if (comparison.issuer) {
        comparison.issuer = reports::ComparisonIssuer{
            .laboratory = comparison.issuer->laboratory, .number = {}, .issued = {}, .amendment = {}};
    }
    if (comparison.form == "laboratories" && !(names_may_be_told && comparison.names_released)) {
        for (reports::ParticipantSummary& participant : comparison.participants) {
            participant.name.clear();
        }
        comparison.reference_name.clear();  // stands with its id at each item
    }
    for (reports::YoudenDiagram& diagram : comparison.youden) {
        diagram.ellipse.clear();  // a curve, which is drawn of the numbers beside it
    }
    return reports::to_json_value(told).flatten();
}

/// Whether a report says what stands at a place of its record. Unrounded numbers are among it: it ends with a table of them.
/// Messages and files are no statements of the comparison, and the audit stands in no report. Titles are told in all languages:
/// a document may be in another one than the record asks for.
bool is_said(std::string_view place) {
    return place.starts_with("/comparison/") || place.starts_with("/title") || place == "/printed/coverage_probability";
}

/// The text that is printed of a number, where the record keeps one beside it: in `printed`, under a key of its own, or, of a weight,
/// as `printed`.
const json* printed_beside(const json& leaves, const std::string& place) {
    const std::string parent = place.substr(0, place.rfind('/'));
    const std::string key(key_of(place));
    for (const std::string& beside : {parent + "/printed/" + key, parent + "/printed_" + key, parent + "/printed"}) {
        if (const auto found = leaves.find(beside); found != leaves.end() && found->is_string()) {
            return &*found;
        }
    }
    return nullptr;
}

/// As the report prints it; "" where nothing stands there.
std::string text_at(const json& leaves, const std::string& place) {
    const auto leaf = leaves.find(place);
    if (leaf == leaves.end() || leaf->is_null()) {
        return "";
    }
    if (leaf->is_string()) {
        return leaf->get<std::string>();
    }
    if (!leaf->is_number_float()) {
        return leaf->dump();
    }
    const double number = leaf->get<double>();
    const std::string_view key = key_of(place);
    if (key == "U_over_CMC" || key == "U_over_median") {
        return gum::round_significant(number, 2);
    }
    return key == "score_probability" ? certificate::printed_coverage_probability(number) : text::shortest(number);
}

/// Two programs, or two versions of one, leave the last digits of a number otherwise, which nobody changed.
bool is_one_number(const json& before, const json& after, const std::string& place) {
    const auto was = before.find(place);
    const auto is = after.find(place);
    if (was == before.end() || is == after.end() || !was->is_number() || !is->is_number()) {
        return false;
    }
    const double a = was->get<double>();
    const double b = is->get<double>();
    return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

/// Of a number whose printed text changes the text is told, and not the number once more.
bool is_told_beside(const json& before, const json& after, const std::string& place) {
    const json* const was = printed_beside(before, place);
    const json* const is = printed_beside(after, place);
    return (was != nullptr || is != nullptr) && (was == nullptr || is == nullptr || *was != *is);
}

/// What stands at a place: "printed", digits as documents print them; "number", one without such digits; "verdict", "flag" or "text".
const char* kind_of(const json& leaf, std::string_view place) {
    static constexpr std::array<std::string_view, 5> k_verdicts{"realism", "signal", "verdict", "verdict_audited",
                                                                "verdict_by"};
    if (place.find("/printed") != std::string_view::npos) {
        return "printed";
    }
    if (std::ranges::find(k_verdicts, key_of(place)) != k_verdicts.end()) {
        return "verdict";
    }
    return leaf.is_boolean() ? "flag" : leaf.is_number() ? "number" : "text";
}

}  // namespace

std::vector<certificate::Change> changes_of_report(const reports::EvaluationRecord& earlier,
                                                   const reports::EvaluationRecord& later) {
    const bool names_may_be_told = later.comparison->names_released;
    const json before = leaves_of(earlier, names_may_be_told);
    const json after = leaves_of(later, names_may_be_told);
    std::set<std::string> places;
    for (const json* const leaves : {&before, &after}) {
        for (const auto& [place, leaf] : leaves->items()) {
            if (is_said(place)) {
                places.insert(place);
            }
        }
    }
    std::vector<certificate::Change> changes;
    for (const std::string& place : places) {
        std::string was = text_at(before, place);
        std::string is = text_at(after, place);
        if (was != is && !is_one_number(before, after, place) && !is_told_beside(before, after, place)) {
            changes.push_back({.kind = kind_of((after.contains(place) ? after : before).at(place), place),
                               .where = place,
                               .before = std::move(was),
                               .after = std::move(is)});
        }
    }
    return changes;
}

}  // namespace gumcert::archive
