#include "certificate/gates/worded_verdicts.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/text_words.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::certificate {

namespace {

using std::u32string_view;

// As letters_of() gives them, in the languages of certificates.
constexpr std::array<u32string_view, 16> k_headings = {U"verdict",
                                                       U"passfail",
                                                       U"conformity",
                                                       U"conformance",
                                                       U"statementofconformity",
                                                       U"aussage",
                                                       U"bewertung",
                                                       U"konformitat",
                                                       U"konformitatsaussage",
                                                       U"dictamen",
                                                       U"veredicto",
                                                       U"conformidad",
                                                       U"判定",
                                                       U"符合性",
                                                       U"結果判定",
                                                       U"合格判定"};
constexpr std::array<u32string_view, 19> k_passing = {
    U"pass",     U"passed",    U"ok",      U"conform", U"conforms",  U"conforming", U"compliant",
    U"complies", U"bestanden", U"konform", U"io",      U"inordnung", U"erfullt",    U"conforme",
    U"cumple",   U"apto",      U"合格",    U"符合",    U"通過"};
constexpr std::array<u32string_view, 20> k_failing = {
    U"fail",         U"failed",         U"nok",          U"notok",         U"nonconforming",  U"notconforming",
    U"noncompliant", U"nichtbestanden", U"nichtkonform", U"nio",           U"nichtinordnung", U"nichterfullt",
    U"noconforme",   U"nocumple",       U"noapto",       U"durchgefallen", U"不合格",         U"不符合",
    U"未通過",       U"nopasa"};

template <class Words>
bool is_one_of(const Words& words, const std::u32string& letters) {
    return std::find(words.begin(), words.end(), letters) != words.end();
}

bool is_headed_as_verdict(const PointColumn& column) {
    std::vector<std::string> headings{column.name, column.heading.plain};
    for (const auto& [language, heading] : column.heading.by_language) {
        headings.push_back(heading);
    }
    return std::any_of(headings.begin(), headings.end(),
                       [](const std::string& heading) { return is_one_of(k_headings, letters_of(heading)); });
}

/// What the rules have decided of a row; conditional verdicts count to their side.
struct DecidedRow {
    bool passes = false, fails = false;
};

/// The stage of a result, before or after an adjustment; "" where it has none.
std::string stage_of(const CertifiedTable& table, const std::string& result) {
    const ShownColumn* const shown = column_of_values(table, result);
    return shown == nullptr ? std::string() : shown->stage;
}

/// \param stage  of the words: what they say of the item before an adjustment is no verdict on it afterwards
DecidedRow decided_in(const CertifiedTable& table, std::size_t row, const std::string& stage) {
    DecidedRow decided;
    for (const CertifiedColumn& column : table.columns) {
        const bool is_of_stage = stage.empty() || stage_of(table, column.result) == stage;
        if (is_of_stage && row < column.values.size() && column.values[row].verdict) {
            const std::string& verdict = column.values[row].verdict->verdict;
            decided.passes = decided.passes || verdict == "pass" || verdict == "conditional_pass";
            decided.fails = decided.fails || verdict == "fail" || verdict == "conditional_fail";
        }
    }
    return decided;
}

void look_at(FindingList& found, const CertifiedTable& table, const PointColumn& column) {
    std::vector<std::string> against, undecided;
    for (std::size_t row = 0; row < column.printed.size(); ++row) {
        const std::u32string letters = letters_of(column.printed[row]);
        const bool passes = is_one_of(k_passing, letters);
        if (!passes && !is_one_of(k_failing, letters)) {
            continue;
        }
        const DecidedRow decided = decided_in(table, row, column.stage);
        const bool has_name = table.argument && row < table.argument->printed.size();
        const std::string point = text::in_quotes(has_name ? table.argument->printed[row] : std::to_string(row + 1));
        if (!decided.passes && !decided.fails) {
            undecided.push_back(point);
        } else if (passes ? !decided.passes : !decided.fails) {
            against.push_back(point);
        }
    }
    constexpr std::size_t k_most_named = 5;
    const std::string name = text::in_quotes(column.name);
    if (!against.empty()) {
        found.critical("D12", iso_17025("7.8.6.2"), column.name,
                       "the column " + name +
                           " states verdicts of its own, and those of the decision rule are others: point " +
                           text::listed(against, k_most_named),
                       "Leave the column out: the certificate states the verdicts of the rule.");
    }
    if (!undecided.empty()) {
        found.major("D12", iso_17025("7.8.6.2"), column.name,
                    "the column " + name + " states verdicts where no decision rule has decided: point " +
                        text::listed(undecided, k_most_named),
                    "State a specification with its decision rule, or leave the column out.");
    }
}

}  // namespace

void worded_verdicts(FindingList& found, const Certificate& certificate) {
    for (const CertifiedTable& table : certificate.tables) {
        for (std::size_t c = 0; table.layout && c < table.layout->columns.size(); ++c) {
            const PointColumn& column = table.layout->columns[c];
            if (column.unit.empty() && is_headed_as_verdict(column)) {
                look_at(found, table, column);
            }
        }
    }
}

}  // namespace gumcert::certificate
