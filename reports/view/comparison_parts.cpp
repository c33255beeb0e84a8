#include "reports/view/comparison_parts.h"

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "reports/printed_texts.h"

#include <algorithm>
#include <cstdint>

namespace gumcert::reports {

Text printed_quantity(const Wording& words, const std::string& printed, const std::string& unit) {
    return printed.empty() ? Text() : with_unit(words.number(printed), gum::unit_for_people(unit));
}

void table_of_filled_columns(CertificateBuilder& builder, const std::string& id, const Text& caption,
                             const std::vector<Column>& columns, const Rows& rows) {
    if (rows.empty()) {
        return;
    }
    std::vector<std::size_t> filled;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return !row[c].empty(); })) {
            filled.push_back(c);
        }
    }
    std::vector<Column> kept;
    for (const std::size_t c : filled) {
        kept.push_back(columns[c]);
    }
    Rows lines;
    lines.reserve(rows.size());
    for (const auto& row : rows) {
        std::vector<Text> line;
        for (const std::size_t c : filled) {
            line.push_back(row[c]);
        }
        lines.push_back(std::move(line));
    }
    builder.table(id, caption, kept, lines);
}

void figure_if_any(CertificateBuilder& builder, const std::string& id, const Text& caption, const Text& description,
                   const std::string& drawing) {
    if (!drawing.empty()) {
        builder.figure(id, caption, description.first(), drawing);
    }
}

std::vector<std::size_t> shown_rows(const std::vector<double>& weights, std::size_t most) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights.size() <= most || weights[i] > 0.0) {
            rows.push_back(i);
        }
    }
    if (rows.size() > most) {
        std::stable_sort(rows.begin(), rows.end(),
                         [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
        rows.resize(most);
        std::sort(rows.begin(), rows.end());
    }
    return rows;
}

void say_what_is_shown(CertificateBuilder& builder, const Wording& words, const std::vector<double>& weights,
                       std::size_t shown) {
    if (shown == weights.size()) {
        return;
    }
    const auto signals = static_cast<std::size_t>(
        std::count_if(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; }));
    const char* sentence = shown == 0 ? "no_rows_with_signal" : shown < signals ? "rows_largest" : "rows_with_signal";
    const auto count = [](std::size_t n) { return plain(static_cast<std::int64_t>(n)); };
    builder.paragraph(
        words.filled("comparison", sentence,
                     {{"shown", count(shown)}, {"signals", count(signals)}, {"count", count(weights.size())}}));
}

void shared_sources_table(CertificateBuilder& builder, const Wording& words, const Comparison& comparison) {
    const std::size_t count = comparison.shared_sources.size();
    Rows rows;
    for (const SharedSource& s : comparison.shared_sources) {
        if (rows.size() < k_most_rows) {
            rows.push_back({s.source, s.first, s.second, s.correlation.text});
        }
    }
    if (rows.size() < count) {
        builder.paragraph(
            words.fill("more_in_record", {{"count", plain(static_cast<std::int64_t>(count - rows.size()))}}));
    }
    table_of_filled_columns(builder, "shared-sources", words("comparison", "shared_sources_table"),
                            {{words("label", "source"), ""},
                             {words("comparison", "first"), ""},
                             {words("comparison", "second"), ""},
                             {"r", "", true}},
                            rows);
}

void remarks_section(CertificateBuilder& builder, const Wording& words, const Comparison& comparison) {
    if (comparison.remarks.empty()) {
        return;
    }
    builder.section("comparison_remarks");
    for (const std::string& remark : comparison.remarks) {
        builder.paragraph(words.sentence(remark));
    }
}

void add_probability_of_differences(Facts& facts, const Wording& words, const Comparison& comparison) {
    const std::string probability = certificate::printed_coverage_probability(comparison.score_probability) + " %";
    add_fact(facts, words("comparison", "expanded_differences_label"),
             words.filled("comparison", "expanded_differences_text", {{"p", words.number(probability)}}));
}

Text some_of(const Wording& words, const std::vector<std::string>& names) {
    constexpr std::size_t k_most_names = 12;
    if (names.size() <= k_most_names) {
        return joined(names);
    }
    const std::vector<std::string> first(names.begin(), names.begin() + k_most_names);
    return words.fill("and_more", {{"names", joined(first)},
                                   {"count", plain(static_cast<std::int64_t>(names.size() - k_most_names))}});
}

std::string unrounded(const std::optional<double>& v) {
    return v ? plain(*v) : "";
}

}  // namespace gumcert::reports
