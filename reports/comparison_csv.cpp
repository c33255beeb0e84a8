#include "reports/comparison_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

std::string shortest(double v) {
    std::array<char, 32> buffer{};
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), v).ptr};
}

bool is_number(std::string_view text) {
    if (text.starts_with('+')) {
        text.remove_prefix(1);
    }
    double v = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    return error == std::errc() && end == text.data() + text.size();
}

/// The signs that begin a formula; spreadsheets of East Asian languages know their wide forms, too.
bool begins_formula(std::string_view text) {
    static constexpr std::array<std::string_view, 8> k_signs = {"=", "+", "-", "@", "＝", "＋", "－", "＠"};
    return std::any_of(k_signs.begin(), k_signs.end(), [&](std::string_view s) { return text.starts_with(s); });
}

/// A text that no spreadsheet takes for a formula, whatever separator it was set up for.
std::string harmless(const std::string& text) {
    static constexpr std::string_view k_separators = ",;\t\r\n";
    if (text.size() <= 1 || is_number(text)) {
        return text == "=" || text == "@" ? "'" + text : text;
    }
    std::string out;
    bool at_start = true;  // of the text, or behind what may be a separator
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool separates = k_separators.find(text[i]) != std::string_view::npos;
        if (at_start && (begins_formula(std::string_view(text).substr(i)) || (i == 0 && separates))) {
            out += '\'';
        }
        out += text[i];
        at_start = separates;
    }
    return out;
}

/// RFC 4180, 2.5 to 2.7.
std::string field(const std::string& text) {
    if (text.find_first_of(",;\"\t\r\n") == std::string::npos) {
        return text;
    }
    std::string out = "\"";
    for (const char c : text) {
        out += c == '"' ? "\"\"" : std::string(1, c);
    }
    return out + '"';
}

using Point = ComparisonPoint;

/// One column: its head and the cell of a row; "" where the row has none.
struct CsvColumn {
    const char* head;
    std::function<std::string(const Point&)> cell;
};

CsvColumn text(const char* head, std::string Point::*member) {
    return {head, [member](const Point& p) { return harmless(p.*member); }};
}

CsvColumn number(const char* head, double Point::*member) {
    return {head, [member](const Point& p) { return shortest(p.*member); }};
}

CsvColumn number(const char* head, std::optional<double> Point::*member) {
    return {head, [member](const Point& p) { return p.*member ? shortest(*(p.*member)) : std::string(); }};
}

/// What a row needs of its item.
class Items {
public:
    explicit Items(const Comparison& comparison) : unit_(comparison.unit) {
        for (const ComparisonItemEvaluation& item : comparison.items) {
            by_id_.emplace(std::pair(item.id, item.round), &item);
        }
    }

    [[nodiscard]] CsvColumn text(const char* head, std::string ComparisonItemEvaluation::*member) const {
        return {head, [this, member](const Point& p) {
                    const ComparisonItemEvaluation* item = of(p);
                    return item == nullptr ? std::string() : harmless(item->*member);
                }};
    }
    [[nodiscard]] CsvColumn number(const char* head, std::optional<double> ComparisonItemEvaluation::*member) const {
        return {head, [this, member](const Point& p) {
                    const ComparisonItemEvaluation* item = of(p);
                    return item == nullptr || !(item->*member) ? std::string() : shortest(*(item->*member));
                }};
    }
    [[nodiscard]] CsvColumn unit() const {
        return {"unit", [this](const Point& p) {
                    const ComparisonItemEvaluation* item = of(p);
                    return harmless(item == nullptr ? unit_ : item->unit);
                }};
    }

private:
    std::string unit_;
    std::map<std::pair<std::string, std::string>, const ComparisonItemEvaluation*> by_id_;

    [[nodiscard]] const ComparisonItemEvaluation* of(const Point& p) const {
        const auto found = by_id_.find({p.item, p.round});
        return found == by_id_.end() ? nullptr : found->second;
    }
};

std::vector<CsvColumn> all_columns(const Comparison& comparison, const Items& items) {
    const bool all_contribute =
        std::all_of(comparison.points.begin(), comparison.points.end(), [](const Point& p) { return p.contributes; });
    return {text("participant", &Point::participant),
            text("item", &Point::item),
            text("round", &Point::round),
            text("point", &Point::name),
            text("direction", &Point::direction),
            number("angle_deg", &Point::angle_deg),
            number("position", &Point::position),
            items.unit(),
            items.text("difference_unit", &ComparisonItemEvaluation::difference_unit),
            {"contributes",
             [all_contribute](const Point& p) {
                 return std::string(all_contribute ? "" : p.contributes ? "true" : "false");
             }},
            text("reason", &Point::reason),
            number("value", &Point::value),
            number("u", &Point::u),
            number("U", &Point::U),
            number("k", &Point::k),
            number("nu", &Point::nu),
            number("reference_value", &Point::reference_value),
            number("reference_u", &Point::reference_u),
            number("reference_U", &Point::reference_U),
            number("reference_k", &Point::reference_k),
            number("correlation", &Point::correlation),
            items.number("sigma_pt", &ComparisonItemEvaluation::sigma_pt),
            items.number("delta_E", &ComparisonItemEvaluation::delta_E),
            number("D", &Point::D),
            number("u_D", &Point::u_D),
            number("U_D", &Point::U_D),
            number("D_percent", &Point::D_percent),
            number("P_A", &Point::P_A),
            number("En", &Point::En),
            number("En_worst", &Point::En_worst),
            number("En_audited", &Point::En_audited),
            number("zeta", &Point::zeta),
            number("z", &Point::z),
            number("z_prime", &Point::z_prime),
            text("signal", &Point::signal),
            text("realism", &Point::realism),
            number("U_over_CMC", &Point::U_over_CMC),
            number("U_over_median", &Point::U_over_median)};
}

}  // namespace

std::string comparison_csv(const EvaluationRecord& record) {
    if (!record.comparison) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-REPORT-0040",
                            .where = record.title.empty() ? "record" : "record \"" + record.title + '"',
                            .what = "holds no comparison",
                            .rule = "CSV is made of the points of a comparison",
                            .action = "ask for another format, or take the record of a comparison"});
    }
    const Comparison& comparison = *record.comparison;
    const Items items(comparison);
    std::vector<std::string> rows(comparison.points.size() + 1);
    for (const CsvColumn& column : all_columns(comparison, items)) {
        std::vector<std::string> cells;
        cells.reserve(comparison.points.size());
        bool any = false;
        for (const Point& p : comparison.points) {
            cells.push_back(column.cell(p));
            any = any || !cells.back().empty();
        }
        if (!any) {
            continue;
        }
        const char* separator = rows.front().empty() ? "" : ",";
        rows.front() += std::string(separator) + column.head;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            rows[i + 1] += separator + field(cells[i]);
        }
    }
    std::string out;
    for (const std::string& row : rows) {
        out += row + '\n';
    }
    return out;
}

}  // namespace gumcert::reports
