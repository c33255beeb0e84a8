#include "reports/view/certified_overview.h"

#include "certificate/point_names.h"
#include "reports/point_headings.h"
#include "reports/printed_texts.h"
#include "reports/result_names.h"
#include "reports/view/certified_value_tables.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace gumcert::reports {

namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

constexpr std::size_t k_least_rows_of_a_range = 4;

/// "30 °", "10 µL": where a row stands.
Text name_of_row(const CertifiedTable::Argument& argument, std::size_t row, const Wording& words) {
    const std::string& printed = argument.printed.at(row);
    return is_numeric(argument) ? with_unit(words.number(printed), argument.printed_unit) : Text(printed);
}

bool is_printed(const CertifiedValue& v) {
    return !v.printed_value.empty() || v.verdict;
}

using PointIdentities = std::map<std::string, certificate::PointIdentity>;

/// Rows of one column that a sentence is about.
/// \param points  those whose names nobody sees: they are called by what their rows show
void name_rows(std::vector<Text>& names, const CertifiedTable& table, const CertifiedColumn& column,
               const CertifiedOverview::Holds& named, const PointIdentities& points, const Wording& words) {
    const Text result = name_of_result(table.id, column.result, words);
    const bool is_hidden = certificate::hides_points(table);
    const auto holds = [&](std::size_t row) { return is_printed(column.values[row]) && named(column.values[row]); };
    const auto name = [&](std::size_t row) {
        const Text point = is_hidden        ? point_in_words(points.at(table.argument->printed.at(row)).name, words)
                           : table.argument ? name_of_row(*table.argument, row, words)
                                            : Text();
        return table.argument ? result + "[" + point + "]" : result;
    };
    for (std::size_t first = 0; first < column.values.size();) {
        std::size_t end = first;
        while (end < column.values.size() && holds(end)) {
            ++end;
        }
        if (end - first >= k_least_rows_of_a_range) {
            names.push_back(words.filled("certificate", "from_to", {{"low", name(first)}, {"high", name(end - 1)}}));
            first = end;
        }
        for (; first < end; ++first) {
            names.push_back(name(first));
        }
        ++first;
    }
}

constexpr std::array<Coverage, 6> k_coverages = {Coverage::normal,      Coverage::student_t, Coverage::convolution,
                                                 Coverage::monte_carlo, Coverage::interval,  Coverage::none};

}  // namespace

bool is_exact(const CertifiedValue& v) {
    return v.printed_U == "0" && v.printed_k.empty();
}

Coverage coverage_of(const CertifiedValue& v) {
    if (v.interval && !v.printed_low.empty()) {
        return Coverage::interval;
    }
    if (is_exact(v)) {
        return Coverage::nothing;  // U = 0 is no multiple of a standard uncertainty
    }
    if (v.printed_U.empty()) {
        return v.coverage == "none" ? Coverage::none : Coverage::nothing;
    }
    if (v.coverage == "convolution") {
        return Coverage::convolution;
    }
    if (v.coverage == "monte_carlo") {
        return Coverage::monte_carlo;
    }
    return v.coverage == "student_t" && v.nu_eff ? Coverage::student_t : Coverage::normal;
}

CertifiedOverview::CertifiedOverview(const certificate::Certificate& certificate) : certificate_(certificate) {
    std::vector<std::string> ks;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (const CertifiedValue& v : column.values) {
                const Coverage c = coverage_of(v);
                exact_ = exact_ || is_exact(v);
                if (c == Coverage::nothing) {
                    continue;
                }
                (v.raised ? raised_values_ : by_coverage_.at(static_cast<std::size_t>(c))).push_back(&v);
                if (!v.printed_k.empty() && c != Coverage::interval) {
                    ks.push_back(v.printed_k);
                }
                raised_ = raised_ || v.raised;
            }
        }
    }
    k_column_ = !ks.empty() && (certificate.profile.k_position == "column" || !common(ks));
    std::vector<std::string> student_ks;
    for (const CertifiedValue* const v : values(Coverage::student_t)) {
        student_ks.push_back(v->printed_k);
    }
    nu_beside_k_ = !student_ks.empty() && !common(student_ks);
    for (const Coverage c : k_coverages) {
        if (!values(c).empty()) {
            used_.push_back(c);
        }
    }
}

bool CertifiedOverview::separates() const {
    return certificate_.profile.mixed_results == "separate";
}

std::string CertifiedOverview::letter(Coverage c) const {
    const auto at = std::find(used_.begin(), used_.end(), c);
    return !has_letters() || at == used_.end() ? ""
                                               : std::string("(") + static_cast<char>('a' + (at - used_.begin())) + ")";
}

std::string CertifiedOverview::note(const CertifiedValue& v) const {
    std::string text = v.raised ? "" : letter(coverage_of(v));  // # has a sentence of its own
    const auto mark = [&](const char* m) { text += (text.empty() ? "" : " ") + std::string(m); };
    if (is_outside(v)) {
        mark("*");
    }
    if (v.external) {
        mark("‡");
    }
    if (v.raised) {
        mark(k_raised_mark);
    }
    return text;
}

Text CertifiedOverview::meaning_of_marks(const Wording& words, const std::vector<const CertifiedValue*>& values) const {
    Text text;
    const auto mark = [&](const Text& sentence) { text += text.empty() ? sentence : " " + sentence; };
    const auto some = [&](const Holds& holds) {
        return std::any_of(values.begin(), values.end(), [&](const CertifiedValue* v) { return holds(*v); });
    };
    if (!separates() && some([&](const auto& v) { return is_outside(v); })) {
        mark(words("statement", "outside_mark"));
    }
    if (some([](const auto& v) { return v.external; })) {
        mark(words.filled("statement", "external_mark", {{"heading", words("heading", "external")}}));
    }
    if (some([](const auto& v) { return v.raised; })) {
        mark(words("statement", "raised_mark"));
    }
    return text;
}

bool CertifiedOverview::is_outside(const CertifiedValue& v) const {
    return certificate_.data.status == "accredited" && v.scope_entry.empty() && !v.printed_value.empty();
}

bool CertifiedOverview::any(const Holds& holds) const {
    for (const CertifiedTable& table : certificate_.tables) {
        for (const CertifiedColumn& column : table.columns) {
            if (std::any_of(column.values.begin(), column.values.end(), holds)) {
                return true;
            }
        }
    }
    return false;
}

std::vector<Text> names_of_values(const certificate::Certificate& certificate, const CertifiedOverview::Holds& named,
                                  const Wording& words) {
    std::map<std::string, std::pair<std::size_t, std::size_t>> counts;  // of a name: values, and those that are named
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            auto& [all, of_them] = counts[name_of_result(table.id, column.result, words).first()];
            for (const CertifiedValue& v : column.values) {
                all += is_printed(v) ? 1U : 0U;
                of_them += is_printed(v) && named(v) ? 1U : 0U;
            }
        }
    }
    const PointIdentities points = certificate::identities_of_rows(certificate.tables);
    std::vector<Text> names;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            const Text result = name_of_result(table.id, column.result, words);
            const auto& [all, of_them] = counts.at(result.first());
            if (of_them < all) {
                name_rows(names, table, column, named, points, words);
            } else if (of_them > 0 && std::find(names.begin(), names.end(), result) == names.end()) {
                names.push_back(result);
            }
        }
    }
    return names;
}

Text enumerated(const std::vector<Text>& names, const Wording& words) {
    Text text;
    for (const Text& name : names) {
        text += text.empty() ? name : words("document", "enumeration") + name;
    }
    return text;
}

bool is_without_verdict(const CertifiedValue& v) {
    return !v.printed_value.empty() && !v.verdict;
}

}  // namespace gumcert::reports
