#include "gum/quantity/unit.h"
#include "reports/plots/comparison_plots.h"
#include "reports/printed_texts.h"
#include "reports/view/comparison_laboratory_sections.h"
#include "reports/view/comparison_parts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

/// Names of the laboratories of the pairs, in the order in which they first appear.
std::vector<std::string> laboratories_of(const std::vector<PairEquivalence>& pairs) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(name);
        }
    };
    for (const PairEquivalence& pair : pairs) {
        add(pair.first);
        add(pair.second);
    }
    return names;
}

void pair_list(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared, const std::string& id) {
    const std::string unit = gum::unit_for_people(compared.item->difference_unit);
    Rows rows;
    for (const PairEquivalence& pair : compared.item->pairs) {
        rows.push_back({pair.first, pair.second, pair.d.text, pair.U.text, pair.En.text});
    }
    table_of_filled_columns(builder, "pairs-" + id, words("comparison", "pairs_table"),
                            {{words("comparison", "laboratory_i"), ""},
                             {words("comparison", "laboratory_j"), ""},
                             {"d_ij", unit, true},
                             {"U(d_ij)", unit, true},
                             {words("label", "En"), "", true}},
                            rows);
}

void pair_matrix(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared, const std::string& id,
                 const std::vector<std::string>& names) {
    std::map<std::pair<std::string, std::string>, std::string> En;
    for (const PairEquivalence& pair : compared.item->pairs) {
        En[{pair.first, pair.second}] = pair.En.text;
    }
    const auto number = [](std::size_t i) { return plain(static_cast<std::int64_t>(i + 1)); };
    // Long names are heads of rows only, and their numbers heads of columns.
    constexpr std::size_t k_longest_head = 8;
    const bool numbered =
        std::any_of(names.begin(), names.end(), [](const std::string& name) { return name.size() > k_longest_head; });
    std::vector<Column> columns = {{"i \\ j", ""}};
    Rows rows;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string& first = names[i];
        columns.push_back({numbered ? number(i) : first, "", true});
        std::vector<Text> row = {numbered ? number(i) + ": " + first : first};
        for (const std::string& second : names) {
            const auto found = En.find({first, second});
            row.push_back(found == En.end() ? "\u00A0" : found->second);
        }
        rows.push_back(std::move(row));
    }
    builder.table("pairs-" + id, words("comparison", "pairs_matrix"), columns, rows);
}

}  // namespace

void pairs_of_item(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared,
                   const std::string& id) {
    constexpr std::size_t k_most_listed = 7;
    constexpr std::size_t k_most_in_matrix = 12;
    if (compared.item->pairs.empty()) {
        return;
    }
    const std::vector<std::string> names = laboratories_of(compared.item->pairs);
    if (names.size() <= k_most_listed) {
        pair_list(builder, words, compared, id);
    } else if (names.size() <= k_most_in_matrix) {
        pair_matrix(builder, words, compared, id, names);
    }
    if (compared.item->u_homogeneity.number.value_or(0.0) > 0.0 ||
        compared.item->u_stability.number.value_or(0.0) > 0.0) {
        builder.paragraph(words("comparison", "pairs_of_items"));
    }
    const std::string plot = "plot-pairs-" + id;
    figure_if_any(builder, plot, words.filled("comparison", "figure_pairs", {{"item", compared.name}}),
                  words("plot", "pairs_description"), pairs_plot(*compared.item, plot, words));
}

}  // namespace gumcert::reports
