// The plots of a comparison between laboratories.

#include "reports/comparison_plots.h"

#include "gum/quantity/unit.h"
#include "reports/certificate_view.h"
#include "reports/plot_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using Symbol = PlotKey::Symbol;

constexpr std::size_t k_most_names = 60;     // laboratories whose names fit below their columns
constexpr std::size_t k_most_columns = 400;  // laboratories that are told apart at all
constexpr std::size_t k_most_pairs = 40;
constexpr std::size_t k_name_length = 22;
constexpr double k_name_size = 9.5;
constexpr double k_panel = 230.0;
constexpr const char* k_line = "stroke=\"#000000\" stroke-width=\"1.2\"";
constexpr const char* k_band = "fill=\"#d9d9d9\" stroke=\"none\"";
constexpr const char* k_bar = "stroke=\"#555555\" stroke-width=\"0.8\"";

/// One laboratory of an item.
struct Column {
    std::string name;
    double value = 0.0, U = 0.0;  ///< U = 0: none is stated
    bool contributes = true;
    std::optional<double> score = {};
};

std::optional<double> deciding_score(const ComparisonPoint& p, const std::string& score) {
    if (score == "En") {
        return p.En;
    }
    if (score == "zeta") {
        return p.zeta;
    }
    if (score == "z") {
        return p.z;
    }
    if (score == "z_prime") {
        return p.z_prime;
    }
    return score == "D" ? std::optional<double>(p.D) : std::nullopt;
}

/// The laboratories of an item in ascending order of their values.
/// \throws gum::NoResultError  GC-REPORT-0003 a value or its U is not finite
std::vector<Column> columns_of(const Comparison& comparison, const ComparisonItemEvaluation& item, bool deviations) {
    std::vector<Column> columns;
    for (const ComparisonPoint& p : comparison.points) {
        if (p.item == item.id && p.round == item.round) {
            require_finite("result of " + p.participant, {p.value, p.D, p.U.value_or(0.0)});
            columns.push_back({.name = p.participant,
                               .value = deviations ? p.D : p.value,
                               .U = p.U.value_or(0.0),
                               .contributes = p.contributes,
                               .score = deciding_score(p, item.score)});
        }
    }
    std::sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) {
        return a.value != b.value ? a.value < b.value : a.name < b.name;
    });
    return columns;
}

/// Values, uncertainties and scores in the units of their axes.
void scale_columns(const std::string& id, std::vector<Column>& columns, const AxisScale& values,
                   const AxisScale& scores) {
    for (Column& c : columns) {
        c.value = on_axis(id + ", " + c.name, values(c.value));
        c.U = on_axis(id + ", " + c.name, values(c.U));
        if (c.score) {
            c.score = on_axis(id + ", " + c.name, scores(*c.score));
        }
    }
}

std::string short_name(const std::string& name) {
    return shortened(printable(name), k_name_length);
}

std::string name_of(const ComparisonItemEvaluation& item) {
    return shortened(printable(item.name.empty() ? item.id : item.name), 60);
}

/// Heights and widths that the names below the columns need.
struct NameRow {
    bool upright = false;
    double height = 0.0;

    NameRow(const std::vector<Column>& columns, double pitch) {
        double widest = 0.0;
        for (const Column& c : columns) {
            widest = std::max(widest, label_width(short_name(c.name), k_name_size));
        }
        upright = widest > pitch - 5.0;
        height = upright ? widest + 8.0 : 16.0;
    }

    void draw(Drawing& drawing, const std::string& name, double x, double bottom) const {
        if (!upright) {
            drawing.text(x, bottom + 13.0, name, "middle", k_name_size);
            return;
        }
        const double tx = x + 3.2;
        const double ty = bottom + 6.0;
        const std::string turn = " transform=\"rotate(-90 " + drawing_number(tx) + " " + drawing_number(ty) + ")\"";
        drawing.text(tx, ty, name, "end", k_name_size, turn.c_str());
    }
};

/// The horizontal axis of laboratories: their names, or their numbers in ascending order.
class LaboratoryAxis {
public:
    LaboratoryAxis(const std::vector<Column>& columns, double width)
        : columns_(columns),
          pitch_(width / static_cast<double>(std::max<std::size_t>(1, columns.size()))),
          names_(columns.size() <= k_most_names ? columns : std::vector<Column>(), pitch_) {}

    [[nodiscard]] bool named() const { return columns_.size() <= k_most_names; }
    [[nodiscard]] double pitch() const { return pitch_; }
    [[nodiscard]] double height() const { return (named() ? names_.height : 18.0) + 22.0; }
    /// Middle of the column of a laboratory.
    [[nodiscard]] static double middle(std::size_t i) { return static_cast<double>(i) + 0.5; }

    void draw(Drawing& drawing, const PlotFrame& frame, const Wording& words) const {
        if (named()) {
            for (std::size_t i = 0; i < columns_.size(); ++i) {
                const double x = frame.px(middle(i));
                drawing.line(x, frame.bottom(), x, frame.bottom() + 4.0, "stroke=\"#000000\" stroke-width=\"0.8\"");
                names_.draw(drawing, short_name(columns_[i].name), x, frame.bottom());
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
    const std::vector<Column>& columns_;
    double pitch_;
    NameRow names_;
};

/// What the vertical axis has to show of values: the bulk of the laboratories with their U and the assigned value;
/// outliers many spreads away would press all others into a line, and stand at the edge instead.
AxisRange range_of_values(const std::vector<Column>& columns, double assigned, double assigned_U) {
    std::vector<double> values;
    std::vector<double> uncertainties;
    for (const Column& c : columns) {
        values.push_back(c.value);
        uncertainties.push_back(c.U);
    }
    const double middle = middle_of(values);
    const double spread = std::max({spread_of(values), 0.5 * middle_of(uncertainties), 0.5 * assigned_U});
    constexpr double k_spreads = 10.0;
    constexpr double k_spreads_of_bar = 4.0;  // a longer bar of U is cut off at the edge
    AxisRange range{.low = assigned - assigned_U, .high = assigned + assigned_U};
    for (const Column& c : columns) {
        const double reach = spread > 0.0 ? k_spreads * spread : std::abs(c.value - middle) + c.U;
        if (std::abs(c.value - middle) <= reach) {
            const double bar = spread > 0.0 ? std::min(c.U, k_spreads_of_bar * spread) : c.U;
            range.include(c.value - bar);
            range.include(c.value + bar);
        }
    }
    return range;
}

/// Value by value: bar of U, then a mark.
void draw_columns(Drawing& drawing, const PlotFrame& frame, const std::vector<Column>& columns) {
    const bool thin = columns.size() > k_most_names;
    const double cap = thin ? 0.0 : 1.8;
    const double radius = thin ? 1.3 : 2.4;
    std::vector<Stroke> bars;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const Column& c = columns[i];
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
        const Column& c = columns[i];
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
std::vector<Pixel> pixels_of(const PlotFrame& frame, const std::vector<Column>& columns, const Ends& ends) {
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
void draw_curve(Drawing& drawing, const PlotFrame& frame, const std::vector<Column>& columns) {
    std::vector<Stroke> bars;
    for (const Pixel& p : pixels_of(
             frame, columns, [](const Column& c) { return std::optional(std::pair(c.value - c.U, c.value + c.U)); })) {
        bars.push_back({.x = p.x, .low = frame.py_inside(p.low), .high = frame.py_inside(p.high)});
    }
    draw_strokes(drawing, bars, "stroke=\"#a8a8a8\" stroke-width=\"1\"");
    std::vector<std::pair<double, double>> curve;
    for (const Pixel& p :
         pixels_of(frame, columns, [](const Column& c) { return std::optional(std::pair(c.value, c.value)); })) {
        curve.emplace_back(p.x, frame.py_inside(p.low));
        if (p.high > p.low) {
            curve.emplace_back(p.x, frame.py_inside(p.high));
        }
    }
    drawing.points("polyline", curve, "fill=\"none\" stroke=\"#000000\" stroke-width=\"1.4\"");
    const auto open = std::count_if(columns.begin(), columns.end(), [](const Column& c) { return !c.contributes; });
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
        return item.delta_E ? std::vector{std::pair(*item.delta_E, words("label", "En_limit").first())}
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

void draw_score_bars(Drawing& drawing, const PlotFrame& frame, const std::vector<Column>& columns, double pitch) {
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

void draw_score_curve(Drawing& drawing, const PlotFrame& frame, const std::vector<Column>& columns) {
    std::vector<Stroke> bars;
    for (const Pixel& p : pixels_of(frame, columns, [](const Column& c) {
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

void add_column_keys(PlotKey& key, const std::vector<Column>& columns, Symbol contributing, Symbol other,
                     const Wording& words) {
    const auto open = std::count_if(columns.begin(), columns.end(), [](const Column& c) { return !c.contributes; });
    const bool curve = columns.size() > k_most_columns;
    if (open > 0 && !(curve && open > static_cast<std::ptrdiff_t>(k_most_names))) {
        if (!curve && open < static_cast<std::ptrdiff_t>(columns.size())) {
            key.add(contributing, words("plot", "contributing_key").first());
        }
        key.add(other, words("plot", "not_contributing_key").first());
    }
}

/// Ids of the pairs, those with the lowest values first. Σ d over the partners of a laboratory is n times its distance
/// from the mean.
std::vector<std::string> in_ascending_order(const std::vector<PairEquivalence>& pairs) {
    std::map<std::string, double> height;
    for (const PairEquivalence& p : pairs) {
        require_finite("pair " + p.first + ", " + p.second, {p.d});
        height[p.first] += p.d;
        height[p.second] -= p.d;
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

bool is_inside(const std::vector<std::pair<double, double>>& curve, double x, double y) {
    bool inside = false;
    for (std::size_t i = 0, j = curve.size() - 1; i < curve.size(); j = i++) {
        const auto& [xi, yi] = curve[i];
        const auto& [xj, yj] = curve[j];
        if ((yi > y) != (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi) {
            inside = !inside;
        }
    }
    return inside;
}

/// One axis of a Youden plot: the ellipse and the bulk of the points; what is beyond stands at the edge.
AxisRange range_of_youden(const std::vector<double>& points, const std::vector<double>& ellipse, double centre) {
    AxisRange range{.low = centre, .high = centre};
    for (const double v : ellipse) {
        range.include(v);
    }
    constexpr double k_spreads = 10.0;
    const double reach = std::max(k_spreads * spread_of(points), 2.0 * (range.high - range.low));
    for (const double v : points) {
        if (reach == 0.0 || std::abs(v - centre) <= reach) {
            range.include(v);
        }
    }
    const double room = 0.04 * (range.high - range.low);
    return {.low = range.low - room, .high = range.high + room};
}

std::vector<double> scaled(const std::string& where, std::vector<double> numbers, const AxisScale& scale) {
    for (double& v : numbers) {
        v = on_axis(where, scale(v));
    }
    return numbers;
}

/// Numbers of one of the two items.
struct YoudenAxis {
    std::vector<double> points, ellipse;
    double centre = 0.0;
    AxisScale scale;
    std::string title;

    YoudenAxis(std::vector<double> p, std::vector<double> e, double c, const std::string& item, const std::string& unit,
               const Wording& words) {
        double largest = std::abs(c);
        for (const auto* numbers : {&p, &e}) {
            for (const double v : *numbers) {
                largest = std::max(largest, std::abs(v));
            }
        }
        // An outlier must not take the digits of all others.
        const double bulk = std::max({std::abs(c), std::abs(middle_of(p)), 10.0 * spread_of(p)});
        scale = AxisScale::of(bulk > 0.0 ? std::min(bulk, largest) : largest);
        points = scaled("Youden, " + item, std::move(p), scale);
        ellipse = scaled("Youden, " + item, std::move(e), scale);
        centre = on_axis("Youden, " + item, scale(c));
        title =
            scale.label(words.filled("plot", "deviation_of_axis", {{"item", shortened(printable(item), 40)}}).first(),
                        gum::unit_for_people(unit));
    }
    [[nodiscard]] AxisRange range() const { return range_of_youden(points, ellipse, centre); }
};

}  // namespace

std::string laboratory_values_plot(const Comparison& comparison, const ComparisonItemEvaluation& item,
                                   const std::string& id, const Wording& words) {
    // Values that differ in their last digits only are shown as deviations from the assigned value.
    std::vector<Column> columns = columns_of(comparison, item, false);
    if (columns.empty()) {
        return "";
    }
    double assigned = item.value;
    const double assigned_U = item.U.value_or(0.0);
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
    key.add(item.U ? Symbol::band : Symbol::line, words("plot", item.U ? "assigned_U_key" : "assigned_key").first());
    const bool bars = std::any_of(columns.begin(), columns.end(), [](const Column& c) { return c.U > 0.0; });
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
    if (item.U) {
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
    Drawing drawing;
    drawing.rectangle(0.0, 0.0, k_drawing_width, height, "fill=\"#ffffff\" stroke=\"none\"");
    drawing.body += body.body;
    return svg_document(id, words.filled("plot", "laboratory_values_title", {{"item", name_of(item)}}).first(),
                        words("plot", "laboratory_values_description").first(), height, drawing);
}

std::string laboratory_scores_plot(const Comparison& comparison, const ComparisonItemEvaluation& item,
                                   const std::string& id, const Wording& words) {
    std::vector<Column> columns = columns_of(comparison, item, false);
    const bool any = std::any_of(columns.begin(), columns.end(), [](const Column& c) { return c.score.has_value(); });
    if (!any) {
        return "";
    }
    const std::vector<std::pair<double, std::string>> limits = limits_of(item, words);
    double largest = 0.0;
    std::vector<double> magnitudes;
    for (const Column& c : columns) {
        largest = std::max(largest, std::abs(c.score.value_or(0.0)));
        magnitudes.push_back(std::abs(c.score.value_or(0.0)));
    }
    constexpr double k_limits = 4.0;  // multiples of the outermost limit that are shown
    const double shown =
        limits.empty() ? largest : std::min(largest, std::max(k_limits * limits.back().first, middle_of(magnitudes)));
    const double most = 1.04 * std::max(shown, limits.empty() ? 0.0 : 1.15 * limits.back().first);
    double largest_value = 0.0;
    for (const Column& c : columns) {
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
        std::any_of(columns.begin(), columns.end(), [](const Column& c) { return !c.score.has_value(); });
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
    Drawing drawing;
    drawing.rectangle(0.0, 0.0, k_drawing_width, height, "fill=\"#ffffff\" stroke=\"none\"");
    drawing.body += body.body;
    return svg_document(
        id, words.filled("plot", "laboratory_scores_title", {{"score", name}, {"item", name_of(item)}}).first(),
        words("plot", "laboratory_scores_description").first(), height, drawing);
}

std::string pairs_plot(const ComparisonItemEvaluation& item, const std::string& id, const Wording& words) {
    const std::vector<std::string> ids = in_ascending_order(item.pairs);
    if (ids.size() < 2 || ids.size() > k_most_pairs) {
        return "";
    }
    std::map<std::string, std::size_t> place;
    double names = 0.0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        place[ids[i]] = i;
        names = std::max(names, label_width(short_name(ids[i]), k_name_size));
    }
    names += 10.0;
    const auto count = static_cast<double>(ids.size());
    const double cell = std::min({24.0, 500.0 / count, (k_drawing_width - names - 10.0) / count});
    const double height_of_names = names;
    names += 0.5 * (k_drawing_width - names - cell * count);  // in the middle
    PlotKey key;
    key.add(Symbol::ring, words("plot", "pairs_key").first());
    key.add(Symbol::square, words("plot", "pairs_above_key").first());
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
        const std::string name = short_name(ids[i]);
        body.text(names - 5.0, top + middle + 3.2, name, "end", k_name_size);
        const double tx = names + middle + 3.2;
        const std::string turn =
            " transform=\"rotate(-90 " + drawing_number(tx) + " " + drawing_number(bottom + 5.0) + ")\"";
        body.text(tx, bottom + 5.0, name, "end", k_name_size, turn.c_str());
        body.rectangle(names + middle - 0.5 * cell, top + middle - 0.5 * cell, cell, cell,
                       "fill=\"#ececec\" stroke=\"none\"");
    }
    for (const PairEquivalence& p : item.pairs) {
        if (!p.En) {
            continue;
        }
        const double En = on_axis(id + ", " + p.first + ", " + p.second, *p.En);
        const double a = cell * (static_cast<double>(place.at(p.first)) + 0.5);
        const double b = cell * (static_cast<double>(place.at(p.second)) + 0.5);
        draw_pair(body, names + a, top + b, cell, std::abs(En));
        draw_pair(body, names + b, top + a, cell, std::abs(En));
    }
    body.rectangle(names, top, cell * count, cell * count, "fill=\"none\" stroke=\"#000000\" stroke-width=\"0.9\"");
    const double height = bottom + height_of_names + 4.0;
    Drawing drawing;
    drawing.rectangle(0.0, 0.0, k_drawing_width, height, "fill=\"#ffffff\" stroke=\"none\"");
    drawing.body += body.body;
    return svg_document(id, words.filled("plot", "pairs_title", {{"item", name_of(item)}}).first(),
                        words("plot", "pairs_description").first(), height, drawing);
}

std::string youden_plot(const YoudenDiagram& diagram, const std::string& id, const Wording& words) {
    if (diagram.points.empty()) {
        return "";
    }
    std::vector<double> first;
    std::vector<double> second;
    for (const YoudenPoint& p : diagram.points) {
        first.push_back(p.first);
        second.push_back(p.second);
    }
    std::vector<double> ellipse_first;
    std::vector<double> ellipse_second;
    for (const auto& [x, y] : diagram.ellipse) {
        ellipse_first.push_back(x);
        ellipse_second.push_back(y);
    }
    const YoudenAxis across(first, ellipse_first, diagram.centre_first, diagram.first_item, diagram.first_unit, words);
    const YoudenAxis up(second, ellipse_second, diagram.centre_second, diagram.second_item, diagram.second_unit, words);
    const AxisRange x_range = across.range();
    const AxisRange y_range = up.range();
    PlotFrame frame{.width = 400.0, .height = 400.0};
    frame.across = nice_ticks(x_range.low, x_range.high, 7);
    frame.up = nice_ticks(y_range.low, y_range.high, 8);
    frame.x = 0.5 * (k_drawing_width - frame.width - room_for_axis(frame.up)) + room_for_axis(frame.up);

    const auto is_shown = [&](std::size_t i) {
        return across.points[i] >= frame.across.low && across.points[i] <= frame.across.high &&
               up.points[i] >= frame.up.low && up.points[i] <= frame.up.high;
    };
    bool beyond = false;
    for (std::size_t i = 0; i < diagram.points.size(); ++i) {
        beyond = beyond || !is_shown(i);
    }
    PlotKey key;
    const bool with_ellipse = diagram.ellipse.size() > 2;
    if (with_ellipse) {
        key.add(Symbol::line, words("plot", "ellipse_95_key").first());
    }
    key.add(Symbol::dashed, words("plot", "medians_key").first());
    const bool same_unit = diagram.first_unit == diagram.second_unit;
    const double slope = same_unit ? 1.0 : diagram.scale_first > 0.0 ? diagram.scale_second / diagram.scale_first : 0.0;
    // In the units of the axes.
    const double drawn_slope = up.scale(slope) / across.scale(1.0);
    if (drawn_slope > 0.0) {
        key.add(Symbol::grey_line, words("plot", "equal_key").first());
    }
    if (beyond) {
        key.add(Symbol::cross, words("plot", "beyond_key").first());
    }
    Drawing body;
    frame.y = key.draw(body, 40.0, k_drawing_width) + 4.0;
    draw_up_axis(body, frame, up.title);
    draw_across_axis(body, frame, across.title);
    if (drawn_slope > 0.0) {
        // The part of the line through the medians that lies inside the panel.
        const auto height_at = [&](double x) { return up.centre + drawn_slope * (x - across.centre); };
        const auto at_height = [&](double y) { return across.centre + (y - up.centre) / drawn_slope; };
        const double from = std::max(frame.across.low, at_height(frame.up.low));
        const double to = std::min(frame.across.high, at_height(frame.up.high));
        body.line(frame.px(from), frame.py(height_at(from)), frame.px(to), frame.py(height_at(to)),
                  "stroke=\"#8a8a8a\" stroke-width=\"0.9\"");
    }
    constexpr const char* k_median = "stroke=\"#000000\" stroke-width=\"0.9\" stroke-dasharray=\"4 2\"";
    body.line(frame.px(across.centre), frame.y, frame.px(across.centre), frame.bottom(), k_median);
    body.line(frame.x, frame.py(up.centre), frame.right(), frame.py(up.centre), k_median);
    std::vector<std::pair<double, double>> outline;
    for (std::size_t i = 0; i < diagram.ellipse.size(); ++i) {
        outline.emplace_back(frame.px(across.ellipse[i]), frame.py(up.ellipse[i]));
    }
    if (with_ellipse) {
        body.points("polygon", outline, "fill=\"none\" stroke=\"#000000\" stroke-width=\"1.2\"");
    }
    constexpr std::size_t k_all_named = 15;
    const double radius = diagram.points.size() > k_most_columns ? 1.2
                          : diagram.points.size() > k_most_names ? 1.8
                                                                 : 2.4;
    std::size_t named = 0;
    for (std::size_t i = 0; i < diagram.points.size(); ++i) {
        const double x = frame.px(std::clamp(across.points[i], frame.across.low, frame.across.high));
        const double y = frame.py_inside(up.points[i]);
        body.marker(is_shown(i) ? PlotMarker::disc : PlotMarker::cross, x, y, is_shown(i) ? radius : 3.0);
        const bool outside = with_ellipse && !is_inside(outline, x, y);
        if ((diagram.points.size() <= k_all_named || outside) && named < k_most_pairs) {
            ++named;
            const bool left = x > frame.x + 0.75 * frame.width;
            body.text(left ? x - 5.0 : x + 5.0, std::max(y - 3.0, frame.y + 9.0),
                      shortened(printable(diagram.points[i].participant), 18), left ? "end" : "start", 9.0);
        }
    }
    draw_outline(body, frame);
    const double height = frame.bottom() + 42.0;
    Drawing drawing;
    drawing.rectangle(0.0, 0.0, k_drawing_width, height, "fill=\"#ffffff\" stroke=\"none\"");
    drawing.body += body.body;
    const Wording::Values items = {{"first", shortened(printable(diagram.first_item), 60)},
                                   {"second", shortened(printable(diagram.second_item), 60)}};
    return svg_document(id, words.filled("plot", "youden_title", items).first(),
                        words.filled("plot", "youden_description", items).first(), height, drawing);
}

}  // namespace gumcert::reports
