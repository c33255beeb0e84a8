#include "reports/record/make/certificate/amended_record.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "certificate/certificate_fields.h"
#include "certificate/point_tables.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/certified_tables.h"
#include "reports/record/make/certificate/paired_points.h"
#include "reports/record/make/certificate/paired_rows.h"
#include "reports/record/record_sections.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::Certificate;
using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::Change;

using Texts = std::vector<StatedLeaf>;

/// A number of the data as documents print it: 2E-8, not 2e-08.
std::string data_number(double v) {
    const std::string shortest = text::shortest(v);
    return gum::round_as_written(v, text::most_decimals({&shortest, 1}));
}

/// Walks certificate data and writes down every leaf that is stated, with its place.
class StatedTexts {
public:
    explicit StatedTexts(Texts& found, std::string at = "") : found_(found), at_(std::move(at)) {}

    template <class Type, class... Rule>
    void operator()(const char* key, const Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void operator()(const char* key, const Type& v, std::initializer_list<const char*>) {
        look(at_ + "/" + key, v, k_code);
    }
    template <class Type, class... Rule>
    void needed(const char* key, const Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void needed(const char* key, const Type& v, std::initializer_list<const char*>) {
        look(at_ + "/" + key, v, k_code);
    }
    template <class Type, class... Rule>
    void stated(const char* key, const Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void stated(const char* key, const Type& v, std::initializer_list<const char*>) {
        look(at_ + "/" + key, v, k_code);
    }
    template <class Type, class... Rule>
    void added(const char* key, const Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Fields>
    void group(const char* key, const Fields& fields) {
        StatedTexts inside(found_, at_ + "/" + key);
        fields(inside);
    }
    template <class Type>
    void filled(const char*, const Type&) {}
    template <class Type>
    void filled_if_any(const char*, const Type&) {}

private:
    static constexpr const char* k_text = "text";
    static constexpr const char* k_code = "code";
    Texts& found_;
    std::string at_;

    void note(const std::string& at, const std::string& text, const char* kind) {
        if (!text.empty()) {
            found_.push_back({.at = at, .text = text, .kind = kind});
        }
    }

    /// \param kind  of texts that are found here
    template <class Type>
    void look(const std::string& at, const Type& v, const char* kind = k_text) {
        if constexpr (std::same_as<Type, std::string>) {
            note(at, at.ends_with("/unit") ? gum::unit_for_people(v) : v, kind);
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            note(at, v.plain, kind);
            for (const auto& [language, text] : v.by_language) {
                note(at + "/" + language, text, kind);
            }
        } else if constexpr (std::same_as<Type, bool>) {
            note(at, v ? "true" : "false", "flag");
        } else if constexpr (std::is_arithmetic_v<Type>) {
            note(at, data_number(static_cast<double>(v)), "number");
        } else if constexpr (requires { v.has_value(); }) {
            if (v) {
                look(at, *v, kind);
            }
        } else if constexpr (std::same_as<Type, std::pair<double, double>>) {
            look(at + "/0", v.first);
            look(at + "/1", v.second);
        } else if constexpr (requires { v.size(); }) {
            for (std::size_t i = 0; i < v.size(); ++i) {
                look(at + "/" + std::to_string(i), v[i], kind);
            }
        } else {
            StatedTexts inside(found_, at);
            describe(inside, v);
        }
    }
};

/// What differs between any two certificates, and what says nothing of the calibration.
bool is_left_out(std::string_view at) {
    static constexpr std::array<std::string_view, 4> k_left_out = {"/number", "/dates/issued", "/dates/authorised",
                                                                   "/annexes"};
    return at.starts_with("/amendment/") || std::find(k_left_out.begin(), k_left_out.end(), at) != k_left_out.end();
}

/// The unit of a number of the data: that which stands beside it or around it ("upper" of a specification, "mpe" of its
/// steps, "U" of a capability), or that of what it is a value of ("at" of a capability, "low" of a range).
std::string unit_of_number(const std::map<std::string, std::string>& units, std::string parent, std::string_view key) {
    static constexpr std::array<std::string_view, 15> k_around = {"lower",
                                                                  "upper",
                                                                  "minimum",
                                                                  "maximum",
                                                                  "value",
                                                                  "U",
                                                                  "U_to",
                                                                  "mpe",
                                                                  "guard_band",
                                                                  "largest_U",
                                                                  "population_deviation",
                                                                  "population_centre",
                                                                  "digit",
                                                                  "constant",
                                                                  "full_scale"};
    const auto at = [&](const std::string& place) {
        const auto unit = units.find(place);
        return unit == units.end() ? std::string() : unit->second;
    };
    if (key == "percent_of_reading" || key == "percent_of_range" || key == "percent_of_value") {
        return "%";
    }
    if (key == "ppm_of_value") {
        return "ppm";
    }
    if (key == "low" || key == "high") {
        return at(parent + "/argument");
    }
    const bool is_of_argument = key == "at" || key == "up_to";
    if (!is_of_argument && std::find(k_around.begin(), k_around.end(), key) == k_around.end()) {
        return "";
    }
    for (; !parent.empty(); parent.resize(parent.rfind('/'))) {
        const std::string unit = at(is_of_argument ? parent + "/arguments/0" : parent);
        if (!unit.empty()) {
            return unit;
        }
    }
    return "";
}

/// Numbers of the data with their units.
void add_units(Texts& texts) {
    std::map<std::string, std::string> units;
    for (const StatedLeaf& leaf : texts) {
        if (leaf.at.ends_with("/unit")) {
            units.emplace(leaf.at.substr(0, leaf.at.size() - std::string_view("/unit").size()), leaf.text);
        }
    }
    for (StatedLeaf& leaf : texts) {
        if (leaf.kind != std::string_view("number")) {
            continue;
        }
        const std::size_t slash = leaf.at.rfind('/');
        const std::string unit =
            unit_of_number(units, leaf.at.substr(0, slash), std::string_view(leaf.at).substr(slash + 1));
        leaf.text += unit.empty() ? "" : "\u00A0" + unit;
    }
}

void compare_texts(const Certificate& earlier, const Certificate& later, std::vector<Change>& changes) {
    Texts before;
    Texts after;
    StatedTexts of_earlier(before);
    describe(of_earlier, earlier.data);
    StatedTexts of_later(after);
    describe(of_later, later.data);
    // Compared without their units: where a unit alone is another one, it is told itself, and not at every number beside it.
    Texts shown_before = before;
    Texts shown_after = after;
    add_units(shown_before);
    add_units(shown_after);
    // Rows by what they are: one that came or went changes none of those behind it.
    const std::vector<std::string> counterparts = places_of_counterparts(before, after);
    std::map<std::string, std::size_t> of_before;
    for (std::size_t i = 0; i < before.size(); ++i) {
        of_before.emplace(counterparts[i], i);
    }
    std::set<std::string> places;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const StatedLeaf& now = after[i];
        places.insert(now.at);
        const auto old = of_before.find(now.at);
        if (!is_left_out(now.at) && (old == of_before.end() || before[old->second].text != now.text)) {
            changes.push_back({.kind = now.kind,
                               .where = now.at,
                               .before = old == of_before.end() ? "" : shown_before[old->second].text,
                               .after = shown_after[i].text});
        }
    }
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (!is_left_out(before[i].at) && !places.contains(counterparts[i])) {
            changes.push_back(
                {.kind = before[i].kind, .where = before[i].at, .before = shown_before[i].text, .after = ""});
        }
    }
}

/// How a member of a certified value is called in a change. What is left out is not printed, or follows from what is compared:
/// the formula from the rule, the guard band from the limits, a capability from the scope.
struct PrintedMember {
    std::string_view at, kind;
    enum class Unit { none, of_column, of_value, percent } unit = Unit::none;
    /// Stands in the table of verdicts only, which the certificate has where its results do not show their verdicts.
    bool of_verdict_table = false;
};
constexpr std::array<PrintedMember, 21> k_printed_members{{
    {"/printed_value", "value", PrintedMember::Unit::of_value},
    {"/printed_U", "U", PrintedMember::Unit::of_column},
    {"/printed_k", "k"},
    {"/printed_nu_eff", "nu_eff"},
    {"/printed_u", "u", PrintedMember::Unit::of_column},
    {"/coverage", "coverage"},
    {"/scope_entry", "scope_entry"},
    {"/raised", "raised"},
    {"/external", "external"},
    {"/verdict/verdict", "verdict"},
    {"/verdict/note", "note"},
    {"/verdict/printed/lower", "limit_low", PrintedMember::Unit::of_value},
    {"/verdict/printed/upper", "limit_high", PrintedMember::Unit::of_value},
    {"/verdict/printed/acceptance_lower", "acceptance_low", PrintedMember::Unit::of_value, true},
    {"/verdict/printed/acceptance_upper", "acceptance_high", PrintedMember::Unit::of_value, true},
    {"/verdict/printed/conformance_probability", "conformance_probability", PrintedMember::Unit::percent, true},
    {"/verdict/printed/specific_risk", "specific_risk", PrintedMember::Unit::percent, true},
    {"/verdict/printed/largest_specific_risk", "largest_specific_risk", PrintedMember::Unit::percent, true},
    {"/verdict/printed/false_accept", "false_accept", PrintedMember::Unit::percent, true},
    {"/verdict/printed/false_reject", "false_reject", PrintedMember::Unit::percent, true},
    {"/verdict/printed/test_uncertainty_ratio", "test_uncertainty_ratio", PrintedMember::Unit::none, true},
}};

/// Something that the tables of results show.
struct TableText {
    std::string kind, where;
    std::string text;
};

std::string with_unit(const std::string& number, const std::string& unit) {
    return number.empty() || unit.empty() ? number : number + "\u00A0" + unit;
}

std::string in_all_languages(const certificate::LocalisedText& text) {
    std::string all = text.plain;
    for (const auto& [language, own] : text.by_language) {
        all += (all.empty() ? "" : " / ") + own;
    }
    return all;
}

/// What is printed of one value; a member that is not printed is an empty text.
void show_value(const CertifiedTable& table, const CertifiedColumn& column, const CertifiedValue& value,
                const std::string& where, std::vector<TableText>& shown) {
    const bool in_results = shows_verdict(table, column.result);
    Texts texts;
    StatedTexts of_value(texts);
    describe(of_value, value);
    std::map<std::string_view, std::string_view> at;
    for (const StatedLeaf& stated : texts) {
        at.emplace(stated.at, stated.text);
    }
    // Values in degrees, minutes and seconds have no unit behind them.
    const auto as_value = [&](const std::string& printed) {
        return with_unit(certificate::value_as_shown(table, column, printed),
                         certificate::unit_of_values(table, column));
    };
    const auto show = [&](const PrintedMember& member) {
        const auto found = at.find(member.at);
        const bool is_printed = found != at.end() && !(in_results && member.of_verdict_table);
        const std::string text(is_printed ? found->second : std::string_view());
        if (member.unit == PrintedMember::Unit::of_value) {
            shown.push_back({std::string(member.kind), where, as_value(text)});
            return;
        }
        const std::string unit = member.unit == PrintedMember::Unit::of_column ? column.printed_unit
                                 : member.unit == PrintedMember::Unit::percent ? "%"
                                                                               : "";
        shown.push_back({std::string(member.kind), where, with_unit(text, unit)});
    };
    std::for_each(k_printed_members.begin(), k_printed_members.end(), show);
    // Both ends of an interval are one statement.
    shown.push_back(
        {"interval", where,
         value.printed_low.empty() ? "" : as_value(value.printed_low) + " … " + as_value(value.printed_high)});
}

/// Title, headings and columns of a table, and what its rows have beside the results.
void show_layout(const CertifiedTable& table, std::vector<TableText>& shown) {
    const certificate::TableLayout& layout = *table.layout;
    const std::string name = table.columns.empty() ? table.id : table.columns.front().result;
    shown.push_back({"title", name, in_all_languages(layout.title)});
    std::string columns;
    for (const certificate::ShownColumn& column : layout.shown) {
        const std::string what = column.show == "column" ? column.of
                                 : column.of.empty()     ? column.show
                                                         : column.show + "(" + column.of + ")";
        columns += (columns.empty() ? "" : ", ") + (column.show == "value" ? column.of : what);
        shown.push_back({"heading", what, in_all_languages(column.heading)});
        // Those of the columns themselves stand below: what is the same is told once.
        const auto own = std::find_if(layout.columns.begin(), layout.columns.end(),
                                      [&](const certificate::PointColumn& one) { return one.name == column.of; });
        const bool is_own = column.show == "column" && own != layout.columns.end();
        if (!is_own || own->role != column.role) {
            shown.push_back({"role", what, column.role});
        }
        if (!is_own || own->stage != column.stage) {
            shown.push_back({"stage", what, column.stage});
        }
    }
    shown.push_back({"group", name, in_all_languages(layout.group_heading)});
    shown.push_back({"role", name, layout.group_role});
    shown.push_back({"columns", name, columns});
    for (std::size_t row = 0; table.argument && row < table.argument->printed.size(); ++row) {
        const std::string point = " [" + table.argument->printed[row] + "]";
        shown.push_back({"group", name + point, layout.group});
        for (const certificate::PointColumn& column : layout.columns) {
            if (row < column.printed.size()) {
                const bool is_number = row < column.values.size() && column.values[row];
                shown.push_back({is_number ? "cell" : "words", column.name + point,
                                 with_unit(certificate::shown_cell(column, row),
                                           is_number ? certificate::shown_unit(column) : "")});
            }
        }
    }
    for (const certificate::PointColumn& column : layout.columns) {
        shown.push_back({"heading", column.name, in_all_languages(column.heading)});
        shown.push_back({"role", column.name, column.role});
        shown.push_back({"stage", column.name, column.stage});
    }
}

/// "D_u" of "D_u [10 bar]"; the whole where there is no point.
std::string result_of_place(const std::string& where) {
    return where.ends_with(']') ? where.substr(0, where.rfind(" [")) : where;
}

/// "10 bar" of "D_u [10 bar]", or "".
std::string point_of_place(const std::string& where) {
    const std::size_t result = result_of_place(where).size();
    constexpr std::size_t k_brackets = 3;
    return where.size() < result + k_brackets ? "" : where.substr(result + 2, where.size() - result - k_brackets);
}

std::string place_of_point(const std::string& result, const std::string& point) {
    return result + " [" + point + "]";
}

/// What the verdicts of a result have in common, once.
std::string of_verdicts(const CertifiedColumn& column, std::string certificate::Verdict::*member) {
    std::vector<std::string> all;
    for (const CertifiedValue& value : column.values) {
        if (value.verdict && std::find(all.begin(), all.end(), (*value.verdict).*member) == all.end()) {
            all.push_back((*value.verdict).*member);
        }
    }
    std::string text;
    for (const std::string& one : all) {
        text += (text.empty() ? "" : ", ") + one;
    }
    return text;
}

std::vector<TableText> shown_in_tables(const Certificate& certificate) {
    std::vector<TableText> shown;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            shown.push_back({"heading", column.result, in_all_languages(column.name)});
            shown.push_back(
                {"specification", column.result, of_verdicts(column, &certificate::Verdict::specification)});
            shown.push_back({"rule", column.result, of_verdicts(column, &certificate::Verdict::rule)});
            for (std::size_t i = 0; i < column.values.size(); ++i) {
                const bool at_points = table.argument && i < table.argument->printed.size();
                show_value(table, column, column.values[i],
                           at_points ? column.result + " [" + table.argument->printed[i] + "]" : column.result, shown);
            }
        }
        if (table.layout) {
            show_layout(table, shown);
        }
    }
    return shown;
}

/// Texts by what they are, where they stand, and the how many-th they are there.
class TableTexts {
public:
    explicit TableTexts(const std::vector<TableText>& shown) {
        for (const TableText& one : shown) {
            texts_[{one.kind, one.where}].push_back(one.text);
            places_.insert(one.where);
        }
    }

    [[nodiscard]] bool has(const std::string& where) const { return places_.contains(where); }
    /// Whether a place of no point has the same texts here and there, and in more tables or fewer: a table that came or went
    /// says nothing else of its result. In as many, texts that were exchanged are other ones.
    [[nodiscard]] bool says_the_same(const TableText& of, const TableTexts& there) const {
        return point_of_place(of.where).empty() && count(of) != there.count(of) && distinct(of) == there.distinct(of);
    }
    [[nodiscard]] std::optional<std::string> text(const TableText& of, std::size_t nth) const {
        const auto found = texts_.find({of.kind, of.where});
        return found == texts_.end() || nth >= found->second.size() ? std::nullopt : std::optional(found->second[nth]);
    }

private:
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> texts_;
    std::set<std::string> places_;

    [[nodiscard]] std::size_t count(const TableText& of) const {
        const auto found = texts_.find({of.kind, of.where});
        return found == texts_.end() ? 0 : found->second.size();
    }
    [[nodiscard]] std::set<std::string> distinct(const TableText& of) const {
        const auto found = texts_.find({of.kind, of.where});
        return found == texts_.end() ? std::set<std::string>()
                                     : std::set<std::string>(found->second.begin(), found->second.end());
    }
};

/// Texts of rows, point by point.
std::vector<ShownPoint> points_of(const std::vector<TableText>& shown) {
    std::vector<ShownPoint> points;
    std::map<std::string, std::size_t> positions;
    for (const TableText& one : shown) {
        const std::string number = point_of_place(one.where);
        if (number.empty() || one.text.empty()) {
            continue;
        }
        const auto [position, is_new] = positions.emplace(number, points.size());
        if (is_new) {
            points.push_back({.number = number, .texts = {}});
        }
        points[position->second].texts.emplace(one.kind + " " + result_of_place(one.where), one.text);
    }
    return points;
}

/// Of a result or cell that only one of both has, its value says all: no line for each of its texts.
bool tells_a_place(const TableText& one) {
    return one.kind == "value" || one.kind == "cell" || one.kind == "words";
}

void compare_results(std::vector<TableText> before, const std::vector<TableText>& after, const PointsOfBoth& points,
                     std::vector<Change>& changes) {
    for (TableText& one : before) {
        if (const std::string number = point_of_place(one.where); !number.empty()) {
            one.where = place_of_point(result_of_place(one.where), points.earlier_as_later(number));
        }
    }
    const TableTexts of_before(before);
    const TableTexts of_after(after);
    // What is said of a result stands with it in the table of each group of rows: it is told once.
    const auto tell = [&](const TableText& one, const std::string& old, const std::string& now) {
        const bool is_told = std::any_of(changes.begin(), changes.end(), [&](const Change& c) {
            return c.kind == one.kind && c.where == one.where && c.before == old && c.after == now;
        });
        if (!is_told || tells_a_place(one)) {
            changes.push_back({.kind = one.kind, .where = one.where, .before = old, .after = now});
        }
    };
    std::map<std::pair<std::string, std::string>, std::size_t> seen;
    for (const TableText& one : after) {
        const std::optional<std::string> old = of_before.text(one, seen[{one.kind, one.where}]++);
        const bool is_shown = of_before.has(one.where) || tells_a_place(one);
        if (old.value_or("") != one.text && is_shown && !of_before.says_the_same(one, of_after)) {
            tell(one, old.value_or(""), one.text);
        }
    }
    seen.clear();
    for (const TableText& one : before) {
        const bool has_gone = !of_after.text(one, seen[{one.kind, one.where}]++);
        if (has_gone && !one.text.empty() && (of_after.has(one.where) || tells_a_place(one)) &&
            !of_before.says_the_same(one, of_after)) {
            tell(one, one.text, "");
        }
    }
}

/// One change in place of those of all values of a result, where all are the same: a limit was agreed once, not at each point.
/// Numbers that were measured stay at their points. A limit whose specification is told to have changed is not told again.
/// \param texts  changes of the certificate data
std::vector<Change> with_common_changes_once(const std::vector<Change>& changes, const std::vector<Change>& texts,
                                             const Certificate& later) {
    static constexpr std::array<std::string_view, 5> k_agreed = {"limit_low", "limit_high", "acceptance_low",
                                                                 "acceptance_high", "note"};
    const auto is_agreed = [](const Change& c) {
        return std::find(k_agreed.begin(), k_agreed.end(), c.kind) != k_agreed.end();
    };
    std::map<std::string, std::size_t> rows;
    std::map<std::string, std::string> specification_of;
    for (const CertifiedTable& table : later.tables) {
        for (const CertifiedColumn& column : table.columns) {
            specification_of[column.result] = of_verdicts(column, &certificate::Verdict::specification);
            rows[column.result] += static_cast<std::size_t>(
                std::count_if(column.values.begin(), column.values.end(), [](const auto& v) { return v.verdict; }));
        }
    }
    const auto is_told_of_specification = [&](const std::string& result, const std::string& kind) {
        const auto& all = later.data.specifications;
        const std::string key = kind == "limit_low" ? "/lower" : kind == "limit_high" ? "/upper" : "";
        return !key.empty() && std::any_of(texts.begin(), texts.end(), [&](const Change& text) {
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (all[i].id == specification_of[result] &&
                    text.where == "/specifications/" + std::to_string(i) + key) {
                    return true;
                }
            }
            return false;
        });
    };
    std::vector<Change> once;
    std::set<std::array<std::string, 4>> told;
    for (const Change& change : changes) {
        const std::string result = result_of_place(change.where);
        const auto same = [&](const Change& other) {
            return other.kind == change.kind && other.before == change.before && other.after == change.after &&
                   result_of_place(other.where) == result;
        };
        const auto count = static_cast<std::size_t>(std::count_if(changes.begin(), changes.end(), same));
        if (!is_agreed(change) || count < 2 || count != rows[result]) {
            once.push_back(change);
        } else if (!is_told_of_specification(result, change.kind) &&
                   told.insert({result, change.kind, change.before, change.after}).second) {
            once.push_back({.kind = change.kind, .where = result, .before = change.before, .after = change.after});
        }
    }
    return once;
}

/// Titles of the document and of the sections of its job, by their names.
std::vector<Change> changes_of_titles(const EvaluationRecord& earlier, const EvaluationRecord& later) {
    std::vector<Change> changes;
    const auto tell = [&](const std::string& where, const std::string& before, const std::string& after) {
        if (before != after) {
            changes.push_back({.kind = "title", .where = where, .before = before, .after = after});
        }
    };
    tell("", in_all_languages(title_of(earlier)), in_all_languages(title_of(later)));
    const auto title_of = [](const EvaluationRecord& record, const std::string& name) {
        const auto found = std::find_if(record.sections.begin(), record.sections.end(),
                                        [&](const SectionSummary& section) { return section.name == name; });
        return found == record.sections.end() ? std::string() : in_all_languages(found->title);
    };
    for (const SectionSummary& section : later.sections) {
        tell(section.name, title_of(earlier, section.name), in_all_languages(section.title));
    }
    for (const SectionSummary& section : earlier.sections) {
        if (std::none_of(later.sections.begin(), later.sections.end(),
                         [&](const SectionSummary& one) { return one.name == section.name; })) {
            tell(section.name, in_all_languages(section.title), "");
        }
    }
    return changes;
}

[[noreturn]] void refuse(const char* code, const std::string& where, std::string what, std::string rule,
                         std::string action) {
    throw gum::InputError(gum::Diagnostic{
        .code = code, .where = where, .what = std::move(what), .rule = std::move(rule), .action = std::move(action)});
}

}  // namespace

std::vector<Change> changes_between(const Certificate& earlier, const Certificate& later) {
    const std::vector<TableText> before = shown_in_tables(earlier);
    const std::vector<TableText> after = shown_in_tables(later);
    const PointsOfBoth points(earlier, points_of(before), later, points_of(after));
    std::vector<Change> of_results;
    compare_results(before, after, points, of_results);
    std::vector<Change> of_texts;
    compare_texts(earlier, later, of_texts);
    of_results = with_common_changes_once(of_results, of_texts, later);
    for (Change& change : of_results) {
        if (const std::string number = point_of_place(change.where); !number.empty()) {
            change.where = place_of_point(result_of_place(change.where), points.name(number));
        }
    }
    // For whom and of what comes first, as on the certificate; then the results, then all else.
    const auto rest = std::stable_partition(of_texts.begin(), of_texts.end(), [](const Change& change) {
        return change.where.starts_with("/item") || change.where.starts_with("/customer");
    });
    std::vector<Change> changes(of_texts.begin(), rest);
    changes.insert(changes.end(), of_results.begin(), of_results.end());
    changes.insert(changes.end(), rest, of_texts.end());
    return changes;
}

std::vector<Change> changes_between(const EvaluationRecord& earlier, const EvaluationRecord& later) {
    std::vector<Change> changes = changes_of_titles(earlier, later);
    // What every U means, which k alone does not say.
    if (earlier.coverage_probability.text != later.coverage_probability.text) {
        changes.push_back({.kind = "number",
                           .where = "/coverage_probability",
                           .before = earlier.coverage_probability.text,
                           .after = later.coverage_probability.text});
    }
    if (earlier.certificate && later.certificate) {
        const std::vector<Change> of_certificate = changes_between(*earlier.certificate, *later.certificate);
        changes.insert(changes.end(), of_certificate.begin(), of_certificate.end());
    }
    return changes;
}

void state_changes(EvaluationRecord& record) {
    Certificate& certificate = *record.certificate;
    if (!certificate.data.amendment || certificate.data.amendment->record.empty()) {
        return;
    }
    const certificate::Amendment& amendment = *certificate.data.amendment;
    const auto file = std::find_if(record.job_files.begin(), record.job_files.end(),
                                   [&](const InputFile& f) { return f.name == amendment.record; });
    const std::optional<std::string> bytes = file == record.job_files.end() ? std::nullopt : bytes_of(*file);
    if (!bytes) {
        refuse("GC-CERT-0307", amendment.record, "a record that is not held", "a record of at most 8 MiB is compared",
               "leave \"record\" out of the amendment, and state the changes");
    }
    const EvaluationRecord earlier = record_from_json(*bytes, amendment.record);
    const std::string number = earlier.certificate ? earlier.certificate->data.number : "";
    if (!earlier.certificate || number != amendment.number) {
        refuse(
            "GC-CERT-0307", amendment.record,
            earlier.certificate ? "the record of certificate \"" + number + "\"" : "a record without certificate data",
            "the amendment is to certificate \"" + amendment.number + "\"",
            "name the record of that certificate, or correct the number");
    }
    certificate.changes = changes_between(earlier, record);
    certificate.amended_record_sha256 = encoding::sha256(*bytes);
    if (certificate.changes.empty()) {
        refuse("GC-CERT-0308", amendment.record,
               "no title, no text of the certificate data, and no value, uncertainty, limit, verdict or column of its "
               "tables of results differs; the order of rows, and annexes, are not compared",
               "an amendment changes something (ISO/IEC 17025:2017, 7.8.8.1)",
               "change what is to be amended; where it is an annex alone, leave \"record\" out, and state the changes");
    }
}

}  // namespace gumcert::reports
