#include "reports/forms/comparison_csv.h"

#include "text/csv_field.h"
#include "text/numbers.h"

#include <algorithm>
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

using Point = ComparisonPoint;

/// One column: its head and the cell of a row; "" where the row has none.
struct CsvColumn {
    const char* head;
    std::function<std::string(const Point&)> cell;
};

CsvColumn text(const char* head, std::string Point::*member) {
    return {head, [member](const Point& p) { return (p.*member); }};
}

std::string cell(double number) {
    return text::shortest(number);
}
std::string cell(const std::optional<double>& number) {
    return number ? text::shortest(*number) : std::string();
}
template <class Number>
std::string cell(const Shown<Number>& shown) {
    return cell(shown.number);
}

template <class Number>
CsvColumn number(const char* head, Number Point::*member) {
    return {head, [member](const Point& p) { return cell(p.*member); }};
}

/// "En z": words of the record have no blanks.
std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) {
        all += (all.empty() ? "" : " ") + word;
    }
    return all;
}

/// Of an item without a result, a row that says so.
std::string cell_of(const ItemWithoutResult& item, std::string_view head) {
    return head == "item" ? item.id : head == "round" ? item.round : "";
}

/// "inf" where no finite number bounds it.
CsvColumn worst_en() {
    return {"En_worst", [](const Point& p) {
                const Shown<std::optional<double>>& en = p.En_worst;
                return en.number || en.text.empty() ? cell(en) : std::string(en.text.front() == '-' ? "-inf" : "inf");
            }};
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
                    return item == nullptr ? std::string() : (item->*member);
                }};
    }
    template <class Number>
    [[nodiscard]] CsvColumn number(const char* head, Number ComparisonItemEvaluation::*member) const {
        return {head, [this, member](const Point& p) {
                    const ComparisonItemEvaluation* item = of(p);
                    return item == nullptr ? std::string() : cell(item->*member);
                }};
    }
    [[nodiscard]] CsvColumn unit() const {
        return {"unit", [this](const Point& p) {
                    const ComparisonItemEvaluation* item = of(p);
                    return (item == nullptr ? unit_ : item->unit);
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
            worst_en(),
            number("En_audited", &Point::En_audited),
            number("zeta", &Point::zeta),
            number("z", &Point::z),
            number("z_prime", &Point::z_prime),
            text("signal", &Point::signal),
            {"signal_by", [](const Point& p) { return joined(p.signal_by); }},
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
    const std::vector<ItemWithoutResult>& without = comparison.items_without_result;
    std::vector<std::string> rows(comparison.points.size() + without.size() + 1);
    const auto add = [&rows](std::string_view head, const std::vector<std::string>& cells) {
        if (std::all_of(cells.begin(), cells.end(), [](const std::string& one) { return one.empty(); })) {
            return;
        }
        const std::string separator = rows.front().empty() ? "" : ",";
        rows.front() += separator + std::string(head);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            rows[i + 1] += separator + text::csv_field(cells[i]);
        }
    };
    for (const CsvColumn& column : all_columns(comparison, items)) {
        std::vector<std::string> cells;
        cells.reserve(rows.size());
        for (const Point& p : comparison.points) {
            cells.push_back(column.cell(p));
        }
        for (const ItemWithoutResult& item : without) {
            cells.push_back(cell_of(item, column.head));
        }
        add(column.head, cells);
    }
    std::vector<std::string> because(comparison.points.size());
    for (const ItemWithoutResult& item : without) {
        because.push_back(item.what + " [" + item.code + "]");
    }
    add("no_result_because", because);
    std::string out;
    for (const std::string& row : rows) {
        out += row + '\n';
    }
    return out;
}

}  // namespace gumcert::reports
