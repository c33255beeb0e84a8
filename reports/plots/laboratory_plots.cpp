// Values and scores of a comparison between laboratories.

#include "reports/plots/comparison_plots.h"
#include "reports/printable_text.h"

#include "gum/quantity/unit.h"
#include "reports/plots/plot_frame.h"
#include "reports/record/comparison_scores.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using Symbol = PlotKey::Symbol;

constexpr std::size_t k_most_names = 60;  // laboratories whose columns are wide enough for caps and outlines
constexpr double k_least_pitch = 9.0;     // of names side by side, else they stand in several rows
constexpr double k_small_name_size = 8.5;
constexpr std::size_t k_most_columns = 400;  // laboratories that are told apart at all
constexpr std::size_t k_name_length = 22;
constexpr double k_name_size = 9.5;
constexpr double k_panel = 230.0;
constexpr const char* k_line = "stroke=\"#000000\" stroke-width=\"1.2\"";
constexpr const char* k_band = "fill=\"#d9d9d9\" stroke=\"none\"";
constexpr const char* k_bar = "stroke=\"#555555\" stroke-width=\"0.8\"";

/// One laboratory of an item.
struct LaboratoryColumn {
    std::string name;
    double value = 0.0, U = 0.0;  ///< U = 0: none is stated
    bool contributes = true;
    std::optional<double> score = {};
};

/// The laboratories of an item in ascending order of their values.
/// \throws gum::NoResultError  GC-REPORT-0003 a value or its U is not finite
std::vector<LaboratoryColumn> columns_of(const Comparison& comparison, const ComparisonItemEvaluation& item,
                                         bool deviations, bool with_U_of_D = false) {
    std::vector<LaboratoryColumn> columns;
    for (const ComparisonPoint& p : comparison.points) {
        if (p.item == item.id && p.round == item.round) {
            require_finite("result of " + p.participant,
                           {p.value.number, p.D.number, p.U.number.value_or(0.0), p.U_D.number.value_or(0.0)});
            columns.push_back({.name = p.participant,
                               .value = deviations ? p.D.number : p.value.number,
                               .U = with_U_of_D ? p.U_D.number.value_or(0.0) : p.U.number.value_or(0.0),
                               .contributes = p.contributes,
                               .score = score_of(p, item.score).number});
        }
    }
    std::sort(columns.begin(), columns.end(), [](const LaboratoryColumn& a, const LaboratoryColumn& b) {
        return a.value != b.value ? a.value < b.value : a.name < b.name;
    });
    return columns;
}

/// Values, uncertainties and scores in the units of their axes.
void scale_columns(const std::string& id, std::vector<LaboratoryColumn>& columns, const AxisScale& values,
                   const AxisScale& scores) {
    for (LaboratoryColumn& c : columns) {
        c.value = on_axis(id + ", " + c.name, values(c.value));
        c.U = on_axis(id + ", " + c.name, values(c.U));
        if (c.score) {
            c.score = on_axis(id + ", " + c.name, scores(*c.score));
        }
    }
}

std::string short_name(const std::string& name) {
    return shortened_name(printable(name), k_name_length);
}

std::string name_of(const ComparisonItemEvaluation& item) {
    return shortened(printable(item.name.empty() ? item.id : item.name), 60);
}

/// Heights and widths that the names below the columns need.
struct NameRow {
    bool upright = false;
    double height = 0.0;
    std::size_t rows = 1;  ///< names stand in, one after the other, where one row has no room for them
    double row_height = 0.0;
    double size = k_name_size;

    NameRow(const std::vector<LaboratoryColumn>& columns, double pitch) {
        double widest = 0.0;
        for (const LaboratoryColumn& c : columns) {
            widest = std::max(widest, label_width(short_name(c.name), k_name_size));
        }
        upright = widest > pitch - 5.0;
        if (upright && pitch < k_least_pitch) {
            rows = static_cast<std::size_t>(std::ceil(k_least_pitch / pitch));
            size = k_small_name_size;
            widest *= k_small_name_size / k_name_size;
        }
        row_height = upright ? widest + 8.0 : 16.0;
        height = static_cast<double>(rows) * row_height;
    }

    void draw(Drawing& drawing, const std::string& name, std::size_t i, double x, double axis) const {
        const double bottom = axis + static_cast<double>(i % rows) * row_height;
        if (bottom > axis) {
            drawing.line(x, axis + 4.0, x, bottom + 4.0, "stroke=\"#8a8a8a\" stroke-width=\"0.4\"");
        }
        if (!upright) {
            drawing.text(x, bottom + 13.0, name, "middle", k_name_size);
            return;
        }
        draw_upright_name(drawing, x + 0.34 * size, bottom + 6.0, name, size);
    }
};

/// The horizontal axis of laboratories: their names, or their numbers in ascending order.
class LaboratoryAxis {
public:
    LaboratoryAxis(const std::vector<LaboratoryColumn>& columns, double width)
        : columns_(columns),
          pitch_(width / static_cast<double>(std::max<std::size_t>(1, columns.size()))),
          names_(columns.size() <= k_most_named_columns ? columns : std::vector<LaboratoryColumn>(), pitch_) {}

    [[nodiscard]] bool named() const { return columns_.size() <= k_most_named_columns; }
    [[nodiscard]] double pitch() const { return pitch_; }
    [[nodiscard]] double height() const { return (named() ? names_.height : 18.0) + 22.0; }
    /// Middle of the column of a laboratory.
    [[nodiscard]] static double middle(std::size_t i) { return static_cast<double>(i) + 0.5; }

    void draw(Drawing& drawing, const PlotFrame& frame, const Wording& words) const {
        if (named()) {
            for (std::size_t i = 0; i < columns_.size(); ++i) {
                const double x = frame.px(middle(i));
                drawing.line(x, frame.bottom(), x, frame.bottom() + 4.0, "stroke=\"#000000\" stroke-width=\"0.8\"");
                names_.draw(drawing, short_name(columns_[i].name), i, x, frame.bottom());
            }
        } else {
            const Ticks ticks = nice_ticks(0.0, static_cast<double>(columns_.size()), 10);
            for (int i = 1; i < ticks.count() && ticks.at(i) <= static_cast<double>(columns_.size()); ++i) {
                const double x = frame.px(ticks.at(i) - 0.5);
                drawing.line(x, frame.bottom(), x, frame.bottom() + 4.0, "stroke=\"#000000\" stroke-width=\"0.8\"");
                drawing.text(x, frame.bottom() + 15.0, tick_text(ticks.at(i), 0), "middle", 10.0);
            }
        }
        const char* title = named() ? "laboratory_axis" : "laboratory_number_axis";
        drawing.text(frame.x + 0.5 * frame.width, frame.bottom() + height() - 6.0, words("plot", title).first(),
                     "middle", 11.0);
    }

private:
    const std::vector<LaboratoryColumn>& columns_;
    double pitch_;
    NameRow names_;
};

/// What the vertical axis has to show of values: the bulk of the laboratories with their U and the assigned value;
/// outliers many spreads away would press all others into a line, and stand at the edge instead.
AxisRange range_of_values(const std::vector<LaboratoryColumn>& columns, double assigned, double assigned_U) {
    std::vector<double> values;
    std::vector<double> uncertainties;
    for (const LaboratoryColumn& c : columns) {
        values.push_back(c.value);
        uncertainties.push_back(c.U);
    }
    const double middle = middle_of(values);
    const double spread = std::max({spread_of(values), 0.5 * middle_of(uncertainties), 0.5 * assigned_U});
    constexpr double k_spreads = 10.0;
    constexpr double k_spreads_of_bar = 4.0;  // a longer bar of U is cut off at the edge
    AxisRange range{.low = assigned - assigned_U, .high = assigned + assigned_U};
    for (const LaboratoryColumn& c : columns) {
        const double reach = spread > 0.0 ? k_spreads * spread : std::abs(c.value - middle) + c.U;
        if (std::abs(c.value - middle) <= reach) {
            const double bar = spread > 0.0 ? std::min(c.U, k_spreads_of_bar * spread) : c.U;
            range.include(c.value - bar);
            range.include(c.value + bar);
        }
    }
    constexpr double k_room_at_ends = 0.03;  // no end of a bar on the frame
    return range.widened(k_room_at_ends);
}

/// Value by value: bar of U, then a mark.
void draw_columns(Drawing& drawing, const PlotFrame& frame, const std::vector<LaboratoryColumn>& columns) {
    const bool thin = columns.size() > k_most_names;
    const double cap = thin ? 0.0 : 1.8;
    const double radius = thin ? 1.3 : 2.4;
    std::vector<Stroke> bars;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const LaboratoryColumn& c = columns[i];
        const double x = frame.px(LaboratoryAxis::middle(i));
        const double low = frame.py_inside(c.value - c.U);
        const double high = frame.py_inside(c.value + c.U);
        if (c.U > 0.0 && low > high) {
            bars.push_back({.x = x, .low = low, .high = high});
            for (const auto& [end, y] : {std::pair(c.value - c.U, low), std::pair(c.value + c.U, high)}) {
                if (cap > 0.0 && end >= frame.up.low && end <= frame.up.high) {
                    drawing.line(x - cap, y, x + cap, y, k_bar);
                }
            }
        }
    }
    draw_strokes(drawing, bars, thin ? "stroke=\"#777777\" stroke-width=\"0.6\"" : k_bar);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const LaboratoryColumn& c = columns[i];
        const double x = frame.px(LaboratoryAxis::middle(i));
        if (c.value < frame.up.low || c.value > frame.up.high) {
            draw_beyond(drawing, frame, x, c.value > frame.up.high);
        } else {
            drawing.marker(c.contributes ? PlotMarker::disc : PlotMarker::ring, x, frame.py(c.value), radius);
        }
    }
}

/// Lowest and highest of what falls on one drawing unit of the horizontal axis.
struct Pixel {
    double x = 0.0, low = 0.0, high = 0.0;
};

/// \param ends  of a laboratory: what it spans on the vertical axis
template <class Ends>
std::vector<Pixel> pixels_of(const PlotFrame& frame, const std::vector<LaboratoryColumn>& columns, const Ends& ends) {
    std::vector<Pixel> pixels;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::optional<std::pair<double, double>> span = ends(columns[i]);
        if (!span) {
            continue;
        }
        const double x = std::round(frame.px(LaboratoryAxis::middle(i)));
        if (pixels.empty() || pixels.back().x != x) {
            pixels.push_back({.x = x, .low = span->first, .high = span->second});
        } else {
            pixels.back().low = std::min(pixels.back().low, span->first);
            pixels.back().high = std::max(pixels.back().high, span->second);
        }
    }
    return pixels;
}

/// Values in ascending order as a curve, the bars of U around it as a band, laboratories that do not contribute as
/// rings where they can be told apart.
void draw_curve(Drawing& drawing, const PlotFrame& frame, const std::vector<LaboratoryColumn>& columns) {
    std::vector<Stroke> bars;
    for (const Pixel& p : pixels_of(frame, columns, [](const LaboratoryColumn& c) {
             return std::optional(std::pair(c.value - c.U, c.value + c.U));
         })) {
        bars.push_back({.x = p.x, .low = frame.py_inside(p.low), .high = frame.py_inside(p.high)});
    }
    draw_strokes(drawing, bars, "stroke=\"#a8a8a8\" stroke-width=\"1\"");
    std::vector<std::pair<double, double>> curve;
    for (const Pixel& p : pixels_of(
             frame, columns, [](const LaboratoryColumn& c) { return std::optional(std::pair(c.value, c.value)); })) {
        curve.emplace_back(p.x, frame.py_inside(p.low));
        if (p.high > p.low) {
            curve.emplace_back(p.x, frame.py_inside(p.high));
        }
    }
    drawing.points("polyline", curve, "fill=\"none\" stroke=\"#000000\" stroke-width=\"1.4\"");
    const auto open =
        std::count_if(columns.begin(), columns.end(), [](const LaboratoryColumn& c) { return !c.contributes; });
    for (std::size_t i = 0; i < columns.size() && open <= static_cast<std::ptrdiff_t>(k_most_names); ++i) {
        if (!columns[i].contributes) {
            drawing.marker(PlotMarker::ring, frame.px(LaboratoryAxis::middle(i)), frame.py_inside(columns[i].value),
                           2.2);
        }
    }
    if (columns.front().value < frame.up.low) {
        draw_beyond(drawing, frame, frame.px(0.5), false);
    }
    if (columns.back().value > frame.up.high) {
        draw_beyond(drawing, frame, frame.px(LaboratoryAxis::middle(columns.size() - 1)), true);
    }
}

/// What the limits of a score are called; lines at plus and minus each of them.
std::vector<std::pair<double, std::string>> limits_of(const ComparisonItemEvaluation& item, const Wording& words) {
    if (item.score == "En") {
        return {{1.0, words("label", "En_limit").first()}};
    }
    if (item.score == "D") {
        return item.delta_E.number ? std::vector{std::pair(*item.delta_E.number, words("label", "En_limit").first())}
                                   : std::vector<std::pair<double, std::string>>();
    }
    return {{2.0, words("label", "warning_limit").first()}, {3.0, words("label", "action_limit").first()}};
}

struct LimitLine {
    double at = 0.0;
    std::string label;  ///< "" where it would cover another
};

/// The limits on both sides of zero, on the axis, outermost first. Where they lie too close for their labels, one
/// stands for several.
std::vector<LimitLine> limit_lines(const std::vector<std::pair<double, std::string>>& limits, const PlotFrame& frame,
                                   const AxisScale& scale, bool without_number) {
    constexpr double k_apart = 11.0;
    std::vector<LimitLine> lines;
    double last = -std::numeric_limits<double>::infinity();  // height of the last label above zero
    for (auto limit = limits.rbegin(); limit != limits.rend(); ++limit) {
        const double at = scale(limit->first);
        const double height = frame.py(at);
        const bool merged = frame.py(-at) - height < k_apart;
        const bool covered = height - last < k_apart;
        const std::string number = without_number ? "" : tick_text(at, 0) + " ";
        lines.push_back({at, covered ? "" : (merged ? "±" : without_number ? "" : "+") + number + limit->second});
        lines.push_back({-at, covered || merged ? "" : (without_number ? "" : "\u2212") + number + limit->second});
        last = covered ? last : height;
    }
    return lines;
}

std::string name_of_score(const ComparisonItemEvaluation& item, const Wording& words) {
    return item.score == "D" ? words("plot", "difference_axis").first() : words("label", item.score).first();
}

void draw_score_bars(Drawing& drawing, const PlotFrame& frame, const std::vector<LaboratoryColumn>& columns,
                     double pitch) {
    const double width = std::clamp(0.6 * pitch, 0.8, 26.0);
    const double zero = frame.py(0.0);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const double x = frame.px(LaboratoryAxis::middle(i));
        if (!columns[i].score) {
            if (columns.size() <= k_most_names) {
                drawing.marker(PlotMarker::cross, x, zero, 2.6);
            }
            continue;
        }
        const double score = *columns[i].score;
        const double end = frame.py_inside(score);
        const char* style = !columns[i].contributes ? "fill=\"#ffffff\" stroke=\"#000000\" stroke-width=\"0.8\""
                            : columns.size() > k_most_names
                                ? "fill=\"#777777\" stroke=\"none\""
                                : "fill=\"#b5b5b5\" stroke=\"#000000\" stroke-width=\"0.8\"";
        drawing.rectangle(x - 0.5 * width, std::min(zero, end), width, std::abs(zero - end), style);
        if (score < frame.up.low || score > frame.up.high) {
            draw_beyond(drawing, frame, x, score > frame.up.high);
        }
    }
}

void draw_score_curve(Drawing& drawing, const PlotFrame& frame, const std::vector<LaboratoryColumn>& columns) {
    std::vector<Stroke> bars;
    for (const Pixel& p : pixels_of(frame, columns, [](const LaboratoryColumn& c) {
             return c.score ? std::optional(std::pair(std::min(0.0, *c.score), std::max(0.0, *c.score))) : std::nullopt;
         })) {
        bars.push_back({.x = p.x, .low = frame.py_inside(p.low), .high = frame.py_inside(p.high)});
        for (const bool above : {false, true}) {
            if (above ? p.high > frame.up.high : p.low < frame.up.low) {
                draw_beyond(drawing, frame, p.x, above);
            }
        }
    }
    draw_strokes(drawing, bars, "stroke=\"#777777\" stroke-width=\"1\"");
}

void add_column_keys(PlotKey& key, const std::vector<LaboratoryColumn>& columns, Symbol contributing, Symbol other,
                     const Wording& words) {
    const auto open =
        std::count_if(columns.begin(), columns.end(), [](const LaboratoryColumn& c) { return !c.contributes; });
    const bool curve = columns.size() > k_most_columns;
    if (open > 0 && !(curve && open > static_cast<std::ptrdiff_t>(k_most_names))) {
        if (!curve && open < static_cast<std::ptrdiff_t>(columns.size())) {
            key.add(contributing, words("plot", "contributing_key").first());
        }
        key.add(other, words("plot", "not_contributing_key").first());
    }
}

}  // namespace

std::string laboratory_differences_plot(const Comparison& comparison, const ComparisonItemEvaluation& item,
                                        const std::string& id, const Wording& words) {
    std::vector<LaboratoryColumn> columns = columns_of(comparison, item, true, true);
    std::erase_if(columns, [](const LaboratoryColumn& c) { return !(c.U > 0.0); });
    if (columns.empty() || columns.size() > k_most_columns) {
        return "";
    }
    AxisRange range = range_of_values(columns, 0.0, 0.0);
    const AxisScale scale = AxisScale::of(std::max(std::abs(range.low), std::abs(range.high)));
    scale_columns(id, columns, scale, {});
    PlotKey key;
    add_column_keys(key, columns, Symbol::disc, Symbol::ring, words);
    key.add(Symbol::bar, words("plot", "difference_key").first());
    PlotFrame frame{.height = k_panel, .across = {.low = 0.0, .high = static_cast<double>(columns.size())}};
    frame.up = nice_ticks(scale(range.low), scale(range.high), 7);
    if (columns.front().value < frame.up.low || columns.back().value > frame.up.high) {
        key.add(Symbol::beyond, words("plot", "beyond_key").first());
    }
    Drawing body;
    frame.x = room_for_axis(frame.up);
    frame.width = k_drawing_width - frame.x - 10.0;
    frame.y = key.draw(body, frame.x, k_drawing_width) + 4.0;
    const LaboratoryAxis axis(columns, frame.width);
    draw_up_axis(body, frame,
                 scale.label(words("plot", "difference_axis").first(),
                             gum::unit_for_people(item.difference_unit.empty() ? item.unit : item.difference_unit)));
    body.line(frame.x, frame.py(0.0), frame.right(), frame.py(0.0), k_line);
    draw_columns(body, frame, columns);
    draw_outline(body, frame);
    axis.draw(body, frame, words);
    return plot_document(id, words.filled("plot", "laboratory_differences_title", {{"item", name_of(item)}}).first(),
                         words("plot", "laboratory_differences_description").first(), frame.bottom() + axis.height(),
                         body);
}

std::string laboratory_values_plot(const Comparison& comparison, const ComparisonItemEvaluation& item,
                                   const std::string& id, const Wording& words) {
    // Values that differ in their last digits only are shown as deviations from the assigned value.
    std::vector<LaboratoryColumn> columns = columns_of(comparison, item, false);
    if (columns.empty()) {
        return "";
    }
    double assigned = item.value.number;
    const double assigned_U = item.U.number.value_or(0.0);
    AxisRange range = range_of_values(columns, assigned, assigned_U);
    const double magnitude = std::max(std::abs(range.low), std::abs(range.high));
    constexpr double k_close = 2e-5;
    const bool deviations = range.high - range.low < k_close * magnitude;
    if (deviations) {
        columns = columns_of(comparison, item, true);
        assigned = 0.0;
        range = range_of_values(columns, assigned, assigned_U);
    }
    const AxisScale scale = AxisScale::of(std::max(std::abs(range.low), std::abs(range.high)));
    require_ordinary(id, {scale(assigned), scale(assigned_U)});
    scale_columns(id, columns, scale, {});

    PlotKey key;
    add_column_keys(key, columns, Symbol::disc, Symbol::ring, words);
    key.add(item.U.number ? Symbol::band : Symbol::line,
            words("plot", item.U.number ? "assigned_U_key" : "assigned_key").first());
    const bool bars = std::any_of(columns.begin(), columns.end(), [](const LaboratoryColumn& c) { return c.U > 0.0; });
    if (bars) {
        key.add(Symbol::bar, words("plot", "value_U_key").first());
    }
    Drawing body;
    PlotFrame frame{.height = k_panel, .across = {.low = 0.0, .high = static_cast<double>(columns.size())}};
    frame.up = nice_ticks(scale(range.low), scale(range.high), 7);
    const bool beyond = columns.front().value < frame.up.low || columns.back().value > frame.up.high;
    if (beyond) {
        key.add(Symbol::beyond, words("plot", "beyond_key").first());
    }
    frame.x = room_for_axis(frame.up);
    frame.width = k_drawing_width - frame.x - 10.0;
    frame.y = key.draw(body, frame.x, k_drawing_width) + 4.0;
    const LaboratoryAxis axis(columns, frame.width);

    draw_up_axis(
        body, frame,
        deviations ? scale.label(words("plot", "difference_axis").first(),
                                 gum::unit_for_people(item.difference_unit.empty() ? item.unit : item.difference_unit))
                   : scale.label(words("label", "value").first(), gum::unit_for_people(item.unit)));
    const double low = frame.py_inside(scale(assigned - assigned_U));
    const double high = frame.py_inside(scale(assigned + assigned_U));
    if (item.U.number) {
        body.rectangle(frame.x, high, frame.width, low - high, k_band);
    }
    if (columns.size() > k_most_columns) {
        draw_curve(body, frame, columns);
        body.line(frame.x, frame.py(scale(assigned)), frame.right(), frame.py(scale(assigned)), k_line);
        for (const double edge : {low, high}) {  // the bars cover the band
            body.line(frame.x, edge, frame.right(), edge, "stroke=\"#000000\" stroke-width=\"0.6\"");
        }
    } else {
        body.line(frame.x, frame.py(scale(assigned)), frame.right(), frame.py(scale(assigned)), k_line);
        draw_columns(body, frame, columns);
    }
    draw_outline(body, frame);
    axis.draw(body, frame, words);

    const double height = frame.bottom() + axis.height();
    return plot_document(id, words.filled("plot", "laboratory_values_title", {{"item", name_of(item)}}).first(),
                         words("plot", "laboratory_values_description").first(), height, body);
}

std::string laboratory_scores_plot(const Comparison& comparison, const ComparisonItemEvaluation& item,
                                   const std::string& id, const Wording& words) {
    std::vector<LaboratoryColumn> columns = columns_of(comparison, item, false);
    const bool any =
        std::any_of(columns.begin(), columns.end(), [](const LaboratoryColumn& c) { return c.score.has_value(); });
    if (!any) {
        return "";
    }
    const std::vector<std::pair<double, std::string>> limits = limits_of(item, words);
    double largest = 0.0;
    std::vector<double> magnitudes;
    for (const LaboratoryColumn& c : columns) {
        largest = std::max(largest, std::abs(c.score.value_or(0.0)));
        magnitudes.push_back(std::abs(c.score.value_or(0.0)));
    }
    constexpr double k_limits = 4.0;  // multiples of the outermost limit that are shown
    const double shown =
        limits.empty() ? largest : std::min(largest, std::max(k_limits * limits.back().first, middle_of(magnitudes)));
    const double most = 1.04 * std::max(shown, limits.empty() ? 0.0 : 1.15 * limits.back().first);
    double largest_value = 0.0;
    for (const LaboratoryColumn& c : columns) {
        largest_value = std::max({largest_value, std::abs(c.value), c.U});
    }
    const bool differences = item.score == "D";
    const AxisScale scale = differences ? AxisScale::of(most) : AxisScale{};
    scale_columns(id, columns, AxisScale::of(largest_value), scale);

    const std::string name = name_of_score(item, words);
    PlotKey key;
    if (columns.size() <= k_most_columns) {
        add_column_keys(key, columns, Symbol::filled_bar, Symbol::open_bar, words);
    }
    const bool missing =
        std::any_of(columns.begin(), columns.end(), [](const LaboratoryColumn& c) { return !c.score.has_value(); });
    if (missing && columns.size() <= k_most_names) {
        key.add(Symbol::cross, words("plot", "missing_score_key").first());
    }
    PlotFrame frame{.height = 0.85 * k_panel, .across = {.low = 0.0, .high = static_cast<double>(columns.size())}};
    frame.up = nice_ticks(-scale(most), scale(most), 7);
    if (scale(largest) > frame.up.high) {
        key.add(Symbol::beyond, words("plot", "beyond_key").first());
    }
    const std::vector<LimitLine> lines = limit_lines(limits, frame, scale, differences);
    double room = 10.0;
    for (const LimitLine& line : lines) {
        room = std::max(room, room_for_limit(line.label));
    }
    Drawing body;
    frame.x = room_for_axis(frame.up);
    frame.width = k_drawing_width - frame.x - room;
    frame.y = key.draw(body, frame.x, k_drawing_width) + 4.0;
    const LaboratoryAxis axis(columns, frame.width);

    draw_up_axis(
        body, frame,
        differences
            ? scale.label(name, gum::unit_for_people(item.difference_unit.empty() ? item.unit : item.difference_unit))
            : name);
    if (columns.size() > k_most_columns) {
        draw_score_curve(body, frame, columns);
    } else {
        draw_score_bars(body, frame, columns, axis.pitch());
    }
    body.line(frame.x, frame.py(0.0), frame.right(), frame.py(0.0), "stroke=\"#000000\" stroke-width=\"0.9\"");
    for (const LimitLine& line : lines) {
        draw_limit(body, frame, line.at, line.label);
    }
    draw_outline(body, frame);
    axis.draw(body, frame, words);

    const double height = frame.bottom() + axis.height();
    return plot_document(
        id, words.filled("plot", "laboratory_scores_title", {{"score", name}, {"item", name_of(item)}}).first(),
        words("plot", "laboratory_scores_description").first(), height, body);
}

}  // namespace gumcert::reports
