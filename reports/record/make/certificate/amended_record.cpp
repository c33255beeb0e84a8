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
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::Certificate;
using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::Change;

/// Something that is stated, with its place.
struct StatedLeaf {
    std::string at, text;
    const char* kind;  ///< of Change
};
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
            found_.push_back({at, text, kind});
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

std::string text_at(const Texts& texts, const std::string& at) {
    const auto found = std::find_if(texts.begin(), texts.end(), [&](const StatedLeaf& t) { return t.at == at; });
    return found == texts.end() ? "" : found->text;
}

void compare_texts(const Certificate& earlier, const Certificate& later, std::vector<Change>& changes) {
    Texts before;
    Texts after;
    StatedTexts of_earlier(before);
    describe(of_earlier, earlier.data);
    StatedTexts of_later(after);
    describe(of_later, later.data);
    for (const StatedLeaf& now : after) {
        if (const std::string old = text_at(before, now.at); !is_left_out(now.at) && old != now.text) {
            changes.push_back({.kind = now.kind, .where = now.at, .before = old, .after = now.text});
        }
    }
    for (const StatedLeaf& old : before) {
        if (!is_left_out(old.at) && text_at(after, old.at).empty()) {
            changes.push_back({.kind = old.kind, .where = old.at, .before = old.text, .after = ""});
        }
    }
}

/// How a member of a certified value is called in a change. What is left out is not printed, or follows from what is compared:
/// the formula from the rule, the guard band from the limits, a capability from the scope.
struct PrintedMember {
    std::string_view at, kind;
    enum class Unit { none, of_column, percent } unit = Unit::none;
};
constexpr std::array<PrintedMember, 21> k_printed_members{{
    {"/printed_value", "value", PrintedMember::Unit::of_column},
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
    {"/verdict/printed/lower", "limit_low", PrintedMember::Unit::of_column},
    {"/verdict/printed/upper", "limit_high", PrintedMember::Unit::of_column},
    {"/verdict/printed/acceptance_lower", "acceptance_low", PrintedMember::Unit::of_column},
    {"/verdict/printed/acceptance_upper", "acceptance_high", PrintedMember::Unit::of_column},
    {"/verdict/printed/conformance_probability", "conformance_probability", PrintedMember::Unit::percent},
    {"/verdict/printed/specific_risk", "specific_risk", PrintedMember::Unit::percent},
    {"/verdict/printed/largest_specific_risk", "largest_specific_risk", PrintedMember::Unit::percent},
    {"/verdict/printed/false_accept", "false_accept", PrintedMember::Unit::percent},
    {"/verdict/printed/false_reject", "false_reject", PrintedMember::Unit::percent},
    {"/verdict/printed/test_uncertainty_ratio", "test_uncertainty_ratio"},
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
void show_value(const CertifiedColumn& column, const CertifiedValue& value, const std::string& where,
                std::vector<TableText>& shown) {
    Texts texts;
    StatedTexts of_value(texts);
    describe(of_value, value);
    std::map<std::string_view, std::string_view> at;
    for (const StatedLeaf& stated : texts) {
        at.emplace(stated.at, stated.text);
    }
    const auto show = [&](const PrintedMember& member) {
        const auto found = at.find(member.at);
        const std::string text(found == at.end() ? std::string_view() : found->second);
        const std::string unit = member.unit == PrintedMember::Unit::of_column ? column.printed_unit
                                 : member.unit == PrintedMember::Unit::percent ? "%"
                                                                               : "";
        shown.push_back({std::string(member.kind), where, with_unit(text, unit)});
    };
    std::for_each(k_printed_members.begin(), k_printed_members.end(), show);
    // Both ends of an interval are one statement.
    const std::string& unit = column.printed_unit;
    shown.push_back({"interval", where,
                     value.printed_low.empty()
                         ? ""
                         : with_unit(value.printed_low, unit) + " … " + with_unit(value.printed_high, unit)});
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
        shown.push_back({"stage", what, column.stage});
    }
    shown.push_back({"columns", name, columns});
    for (std::size_t row = 0; table.argument && row < table.argument->printed.size(); ++row) {
        const std::string point = " [" + table.argument->printed[row] + "]";
        shown.push_back({"group", name + point, layout.group});
        for (const certificate::PointColumn& column : layout.columns) {
            if (row < column.printed.size()) {
                const bool is_number = row < column.values.size() && column.values[row];
                shown.push_back({is_number ? "cell" : "words", column.name + point,
                                 with_unit(column.printed[row], is_number ? column.printed_unit : "")});
            }
        }
    }
    for (const certificate::PointColumn& column : layout.columns) {
        shown.push_back({"heading", column.name, in_all_languages(column.heading)});
        shown.push_back({"role", column.name, column.role});
    }
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
                show_value(column, column.values[i],
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
    [[nodiscard]] std::optional<std::string> text(const TableText& of, std::size_t nth) const {
        const auto found = texts_.find({of.kind, of.where});
        return found == texts_.end() || nth >= found->second.size() ? std::nullopt : std::optional(found->second[nth]);
    }

private:
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> texts_;
    std::set<std::string> places_;
};

/// Of a result or cell that only one of both has, its value says all: no line for each of its texts.
bool tells_a_place(const TableText& one) {
    return one.kind == "value" || one.kind == "cell" || one.kind == "words";
}

void compare_results(const Certificate& earlier, const Certificate& later, std::vector<Change>& changes) {
    const std::vector<TableText> before = shown_in_tables(earlier);
    const std::vector<TableText> after = shown_in_tables(later);
    const TableTexts of_before(before);
    const TableTexts of_after(after);
    std::map<std::pair<std::string, std::string>, std::size_t> seen;
    for (const TableText& one : after) {
        const std::optional<std::string> old = of_before.text(one, seen[{one.kind, one.where}]++);
        const bool is_told = of_before.has(one.where) || tells_a_place(one);
        if (old.value_or("") != one.text && is_told) {
            changes.push_back({.kind = one.kind, .where = one.where, .before = old.value_or(""), .after = one.text});
        }
    }
    seen.clear();
    for (const TableText& one : before) {
        const bool has_gone = !of_after.text(one, seen[{one.kind, one.where}]++);
        if (has_gone && !one.text.empty() && (of_after.has(one.where) || tells_a_place(one))) {
            changes.push_back({.kind = one.kind, .where = one.where, .before = one.text, .after = ""});
        }
    }
}

[[noreturn]] void refuse(const char* code, const std::string& where, std::string what, std::string rule,
                         std::string action) {
    throw gum::InputError(gum::Diagnostic{
        .code = code, .where = where, .what = std::move(what), .rule = std::move(rule), .action = std::move(action)});
}

}  // namespace

std::vector<Change> changes_between(const Certificate& earlier, const Certificate& later) {
    std::vector<Change> changes;
    compare_results(earlier, later, changes);
    compare_texts(earlier, later, changes);
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
    certificate.changes = changes_between(*earlier.certificate, certificate);
    certificate.amended_record_sha256 = encoding::sha256(*bytes);
    if (certificate.changes.empty()) {
        refuse("GC-CERT-0308", amendment.record,
               "no value, uncertainty, limit, verdict, column or text that the certificate states differs",
               "an amendment changes something (ISO/IEC 17025:2017, 7.8.8.1)",
               "change what is to be amended, or leave the amendment out");
    }
}

}  // namespace gumcert::reports
