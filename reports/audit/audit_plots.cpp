#include "reports/audit/audit_plots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "reports/plots/svg_drawing.h"
#include "reports/printable_text.h"

namespace gumcert::reports {
namespace {

constexpr std::size_t k_most_bars = 10;
constexpr std::size_t k_label = 32;  // characters of a name beside a bar

}  // namespace

bool has_range_plot(const AuditedFileView& file) {
    return file.results.size() > 1 &&
           std::all_of(file.results.begin(), file.results.end(), [&file](const AuditedResultView& result) {
               return result.unit == file.results.front().unit && is_ordinary(result.budget_U_number) &&
                      is_ordinary(result.audited.number.U) && is_ordinary(result.capability_number.value_or(0.0));
           });
}

Plot range_plot(const AuditedFileView& file, const AuditWords& words, const std::string& id) {
    const std::string& unit = file.results.front().unit;
    PlotSeries budget{.label = words("budget"), .points = {}, .joined = true};
    PlotSeries audited{.label = words("audited"), .points = {}, .marker = PlotMarker::cross};
    PlotSeries capability{
        .label = words("capability"), .points = {}, .marker = PlotMarker::none, .joined = true, .dashed = true};
    for (std::size_t i = 0; i < file.results.size(); ++i) {
        const AuditedResultView& result = file.results[i];
        const double x = static_cast<double>(i + 1);
        budget.points.push_back({.x = x, .y = result.budget_U_number});
        audited.points.push_back({.x = x, .y = result.audited.number.U});
        if (result.capability_number) {
            capability.points.push_back({.x = x, .y = *result.capability_number});
        }
    }
    PlotPanel panel{
        .heading = "", .y_label = unit.empty() ? "U" : "U / " + unit, .series = {budget, audited}, .limits = {}};
    if (!capability.points.empty()) {
        panel.series.push_back(capability);
    }
    return {.id = id,
            .title = words("range_title"),
            .description = words("range_description"),
            .x_label = words("number_of_result"),
            .panels = {panel},
            .x_is_angle = false,
            .x_is_number = true,
            .margin = 12.0};
}

BarPlot audited_share_plot(const AuditedResultView& result, const AuditWords& words, const std::string& id) {
    BarPlot plot{.id = id,
                 .title = words("section_rows") + ": " + shortened(result.name, k_label),
                 .description = words("rows_caption"),
                 .x_label = words("share"),
                 .bars = {}};
    const std::size_t single = result.rows.size() > k_most_bars ? k_most_bars - 1 : result.rows.size();
    for (std::size_t i = 0; i < single; ++i) {
        const AuditedRowView& row = result.rows[i];
        plot.bars.push_back({shortened(row.quantity, k_label), 100.0 * row.share, words.number(row.share_percent)});
    }
    if (single < result.rows.size()) {
        const AuditedRowView rest = summed_rows(result, single);
        plot.bars.push_back({words.filled("others", {{"count", std::to_string(result.rows.size() - single)}}),
                             100.0 * rest.share, words.number(rest.share_percent)});
    }
    return plot;
}

std::string share_bar(double share) {
    const double width = std::clamp(std::isfinite(share) ? 100.0 * share : 0.0, 0.0, 100.0);
    return "<svg class=\"bar\" viewBox=\"0 0 100 8\" preserveAspectRatio=\"none\" aria-hidden=\"true\" "
           "focusable=\"false\"><rect class=\"track\" width=\"100\" height=\"8\"/><rect class=\"filled\" width=\"" +
           drawing_number(width) + "\" height=\"8\"/></svg>";
}

std::string change_arrow(double before, double after, double largest) {
    constexpr double k_width = 240.0, k_middle = 10.0;
    const auto at = [largest](double U) {
        const double x = largest > 0.0 && std::isfinite(U) ? U / largest : 0.0;
        return 4.0 + (k_width - 8.0) * std::clamp(x, 0.0, 1.0);
    };
    const double from = at(before), to = at(after);
    const double sign = to < from ? -1.0 : 1.0;
    std::string svg = "<svg class=\"arrow ";
    svg += std::string(after > before ? "grows" : "shrinks") +
           "\" viewBox=\"0 0 240 20\" aria-hidden=\"true\" focusable=\"false\"><line class=\"axis\" x1=\"4\" y1=\"10\" "
           "x2=\"236\" y2=\"10\"/><line class=\"axis\" x1=\"4\" y1=\"5\" x2=\"4\" y2=\"15\"/>";
    if (std::abs(to - from) > 1.0) {
        const double head = std::min(8.0, std::abs(to - from));
        svg += "<line class=\"shaft\" x1=\"" + drawing_number(from) + "\" y1=\"10\" x2=\"" +
               drawing_number(to - sign * head) + "\" y2=\"10\"/><path class=\"head\" d=\"M" + drawing_number(to) +
               " 10L" + drawing_number(to - sign * head) + " " + drawing_number(k_middle - 5.0) + "L" +
               drawing_number(to - sign * head) + " " + drawing_number(k_middle + 5.0) + "Z\"/>";
    }
    return svg + "<circle class=\"start\" cx=\"" + drawing_number(from) + "\" cy=\"10\" r=\"3.5\"/></svg>";
}

}  // namespace gumcert::reports
