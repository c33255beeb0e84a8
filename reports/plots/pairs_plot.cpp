// Pairs of laboratories of one item.

#include "reports/plots/comparison_plots.h"
#include "reports/printable_text.h"

#include "reports/plots/plot_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gumcert::reports {

namespace {

constexpr std::size_t k_most_laboratories = 40;
constexpr std::size_t k_pair_name_length = 22;
constexpr double k_pair_name_size = 9.5;

/// Ids of the pairs, those with the lowest values first. Σ d over the partners of a laboratory is n times its distance
/// from the mean.
std::vector<std::string> in_ascending_order(const std::vector<PairEquivalence>& pairs) {
    std::map<std::string, double> height;
    for (const PairEquivalence& p : pairs) {
        require_finite("pair " + p.first + ", " + p.second, {p.d.number});
        height[p.first] += p.d.number;
        height[p.second] -= p.d.number;
    }
    std::vector<std::string> ids;
    for (const auto& [id, sum] : height) {
        ids.push_back(id);
    }
    std::stable_sort(ids.begin(), ids.end(),
                     [&](const std::string& a, const std::string& b) { return height.at(a) < height.at(b); });
    return ids;
}

/// Mark of one pair in its cell; its area grows with |E_n|.
void draw_pair(Drawing& drawing, double x, double y, double cell, double absolute_En) {
    constexpr double k_full = 1.5;  // |E_n| whose mark fills the cell
    const double r = 0.44 * cell * std::sqrt(std::min(absolute_En, k_full) / k_full);
    if (absolute_En > 1.0) {
        drawing.rectangle(x - r, y - r, 2.0 * r, 2.0 * r, "fill=\"#000000\" stroke=\"none\"");
    } else if (r > 0.0) {
        drawing.marker(PlotMarker::ring, x, y, r);
    }
}

}  // namespace

std::string pairs_plot(const ComparisonItemEvaluation& item, const std::string& id, const Wording& words) {
    const std::vector<std::string> ids = in_ascending_order(item.pairs);
    if (ids.size() < 2 || ids.size() > k_most_laboratories) {
        return "";
    }
    std::map<std::string, std::size_t> place;
    double names = 0.0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        place[ids[i]] = i;
        names = std::max(names, label_width(shortened_name(printable(ids[i]), k_pair_name_length), k_pair_name_size));
    }
    names += 10.0;
    const auto count = static_cast<double>(ids.size());
    const double cell = std::min({24.0, 500.0 / count, (k_drawing_width - names - 10.0) / count});
    const double height_of_names = names;
    names += 0.5 * (k_drawing_width - names - cell * count);  // in the middle
    PlotKey key;
    key.add(PlotKey::Symbol::ring, words("plot", "pairs_key").first());
    key.add(PlotKey::Symbol::square, words("plot", "pairs_above_key").first());
    Drawing body;
    const double top = key.draw(body, std::min(names, 220.0), k_drawing_width) + 4.0;
    const double bottom = top + cell * count;
    for (std::size_t i = 0; i <= ids.size(); ++i) {
        const double at = cell * static_cast<double>(i);
        constexpr const char* k_grid = "stroke=\"#d0d0d0\" stroke-width=\"0.6\"";
        body.line(names, top + at, names + cell * count, top + at, k_grid);
        body.line(names + at, top, names + at, bottom, k_grid);
    }
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const double middle = cell * (static_cast<double>(i) + 0.5);
        const std::string name = shortened_name(printable(ids[i]), k_pair_name_length);
        body.text(names - 5.0, top + middle + 3.2, name, "end", k_pair_name_size);
        draw_upright_name(body, names + middle + 3.2, bottom + 5.0, name, k_pair_name_size);
        body.rectangle(names + middle - 0.5 * cell, top + middle - 0.5 * cell, cell, cell,
                       "fill=\"#ececec\" stroke=\"none\"");
    }
    for (const PairEquivalence& p : item.pairs) {
        if (!p.En.number) {
            continue;
        }
        const double En = on_axis(id + ", " + p.first + ", " + p.second, *p.En.number);
        const double a = cell * (static_cast<double>(place.at(p.first)) + 0.5);
        const double b = cell * (static_cast<double>(place.at(p.second)) + 0.5);
        draw_pair(body, names + a, top + b, cell, std::abs(En));
        draw_pair(body, names + b, top + a, cell, std::abs(En));
    }
    body.rectangle(names, top, cell * count, cell * count, "fill=\"none\" stroke=\"#000000\" stroke-width=\"0.9\"");
    const double height = bottom + height_of_names + 4.0;
    const std::string item_name = shortened(printable(item.name.empty() ? item.id : item.name), 60);
    return plot_document(id, words.filled("plot", "pairs_title", {{"item", item_name}}).first(),
                         words("plot", "pairs_description").first(), height, body);
}

}  // namespace gumcert::reports
