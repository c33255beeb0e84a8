#include "archive/certificates/report_changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// The names of the rows of a list, by some of their members.
/// \return none where a row has none, or two have one
std::optional<std::vector<std::string>> names_in(const json& list, const std::vector<const char*>& members) {
    std::vector<std::string> names;
    std::set<std::string> seen;
    for (const json& row : list) {
        std::string name;
        for (const char* const member : members) {
            const std::string part = row.value(member, "");
            name += name.empty() || part.empty() ? part : ", " + part;
        }
        if (name.empty() || !seen.insert(name).second) {
            return std::nullopt;
        }
        names.push_back(std::move(name));
    }
    return names;
}

json named(const json& list, const std::vector<std::string>& names) {
    json rows = json::object();
    for (std::size_t i = 0; i < names.size(); ++i) {
        rows[names[i]] = list[i];
    }
    return rows;
}

/// Rows of participants stand by their codes in both records, not by their number: one that goes, comes or stands elsewhere would be
/// a change of every row behind it.
/// \return the names of both, where they are names
std::optional<std::array<std::vector<std::string>, 2>> name_rows(json& before, json& after,
                                                                 const std::vector<const char*>& members) {
    if (!before.is_array() || !after.is_array()) {
        return std::nullopt;
    }
    std::optional<std::vector<std::string>> was = names_in(before, members);
    std::optional<std::vector<std::string>> is = names_in(after, members);
    if (!was || !is) {
        return std::nullopt;
    }
    before = named(before, *was);
    after = named(after, *is);
    return std::array{std::move(*was), std::move(*is)};
}

/// Those of the one that are in the other, too, in their order.
std::string common_names(const std::vector<std::string>& names, const std::vector<std::string>& others) {
    std::string text;
    for (const std::string& name : names) {
        if (std::ranges::find(others, name) != others.end()) {
            text += (text.empty() ? "" : ", ") + name;
        }
    }
    return text;
}

void name_rows_of_participants(json& before, json& after) {
    name_rows(before["points"], after["points"], {"participant", "item"});
    for (std::size_t i = 0; i < std::min(before["items"].size(), after["items"].size()); ++i) {
        json& was = before["items"][i];
        json& is = after["items"][i];
        name_rows(was["pairs"], is["pairs"], {"first", "second"});
        name_rows(was["weights"], is["weights"], {"participant"});
    }
    for (std::size_t i = 0; i < std::min(before["youden"].size(), after["youden"].size()); ++i) {
        name_rows(before["youden"][i]["points"], after["youden"][i]["points"], {"participant"});
    }
    if (const auto names = name_rows(before["participants"], after["participants"], {"id"})) {
        std::string was = common_names(names->front(), names->back());
        std::string is = common_names(names->back(), names->front());
        if (was != is) {
            before["order_of_participants"] = std::move(was);
            after["order_of_participants"] = std::move(is);
        }
    }
}

/// A record; what documents do not print of names is not in it.
json told_of(const reports::EvaluationRecord& record, bool names_may_be_told) {
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
    return reports::to_json_value(told);
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
    json told_before = told_of(earlier, names_may_be_told);
    json told_after = told_of(later, names_may_be_told);
    name_rows_of_participants(told_before["comparison"], told_after["comparison"]);
    const json before = told_before.flatten();
    const json after = told_after.flatten();
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
