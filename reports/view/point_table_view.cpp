#include "reports/view/point_table_view.h"

#include "reports/printed_texts.h"
#include "reports/result_names.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::PointColumn;
using certificate::ShownColumn;
using certificate::Verdict;

/// A column of the document, cell by cell.
struct LayoutColumn {
    Column column;
    std::string stage;
    std::function<Text(std::size_t)> cell;
};

const std::string k_blank = "\u00A0";  // nothing is missing where nothing is to be said

/// Of a word that the wording has for a role or a usual name of a column; else the name itself.
Text word_or(const std::string& name, const Wording& words) {
    return !name.empty() && words.has("point_table", name) ? words("point_table", name) : Text(name);
}

/// The magnitude of a printed number below 0; "" for any other.
std::string without_minus(const std::string& printed) {
    for (const std::string_view minus : {"-", "\u2212"}) {
        if (printed.starts_with(minus)) {
            return printed.substr(minus.size());
        }
    }
    return {};
}

class LayoutColumns {
public:
    LayoutColumns(const CertifiedTable& table, const Wording& words, const CertifiedOverview& overview,
                  const CertifiedOverview::Holds& shown)
        : table_(table), words_(words), overview_(overview), shown_(shown) {}

    std::vector<LayoutColumn> all() {
        const std::vector<ShownColumn>& shown = table_.layout->shown;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            add(shown[i]);
            // Behind the last column of the number itself.
            const bool is_number = shown[i].show == "U" || shown[i].show == "k" || shown[i].show == "nu_eff";
            const bool goes_on =
                i + 1 < shown.size() && shown[i + 1].of == shown[i].of &&
                (shown[i + 1].show == "U" || shown[i + 1].show == "k" || shown[i + 1].show == "nu_eff");
            if (is_number && !goes_on) {
                add_what_U_needs(shown[i]);
            }
        }
        return std::move(columns_);
    }

private:
    const CertifiedTable& table_;
    const Wording& words_;
    const CertifiedOverview& overview_;
    const CertifiedOverview::Holds& shown_;
    std::vector<LayoutColumn> columns_;

    [[nodiscard]] const CertifiedColumn* result(const std::string& name) const {
        const auto found = std::find_if(table_.columns.begin(), table_.columns.end(),
                                        [&](const CertifiedColumn& c) { return c.result == name; });
        return found == table_.columns.end() ? nullptr : &*found;
    }

    [[nodiscard]] bool any(const CertifiedColumn& c, const std::function<bool(const CertifiedValue&)>& holds) const {
        return std::any_of(c.values.begin(), c.values.end(), [&](const auto& v) { return shown_(v) && holds(v); });
    }

    void put(const ShownColumn& as, const Text& head, const std::string& unit, bool number,
             std::function<Text(std::size_t)> cell) {
        columns_.push_back(
            {{as.heading.empty() ? head : words_.localised(as.heading), unit, number}, as.stage, std::move(cell)});
    }

    /// A text of each value of a result that is shown here.
    void put(const ShownColumn& as, const Text& head, const std::string& unit, bool number, const CertifiedColumn& of,
             const std::function<Text(const CertifiedValue&)>& text) {
        put(as, head, unit, number,
            [this, &of, text](std::size_t row) { return shown_(of.values[row]) ? text(of.values[row]) : Text(); });
    }

    void add(const ShownColumn& c) {
        if (c.show == "point") {
            put(c, words_("certificate", "point"), "", false,
                [this](std::size_t row) { return Text(table_.argument->printed[row]); });
            return;
        }
        if (c.show == "column") {
            const auto& columns = table_.layout->columns;
            const auto found =
                std::find_if(columns.begin(), columns.end(), [&](const PointColumn& p) { return p.name == c.of; });
            if (found != columns.end()) {
                const bool number = std::any_of(found->values.begin(), found->values.end(),
                                                [](const auto& v) { return v.has_value(); });
                put(c, heading_of(*found, words_), found->printed_unit, number,
                    [found](std::size_t row) { return Text(found->printed[row]); });
            }
            return;
        }
        if (const CertifiedColumn* const of = result(c.of)) {
            add_of_result(c, *of);
        }
    }

    void add_of_result(const ShownColumn& c, const CertifiedColumn& of) {
        const std::string& unit = of.printed_unit;
        if (c.show == "value") {
            put(c, c.role.empty() ? Text(of.result) : words_("point_table", c.role), unit, true, of,
                [](const CertifiedValue& v) { return Text(v.printed_value); });
        } else if (c.show == "U") {
            put(c, words_("certificate", "U_short"), unit, true, of,
                [](const CertifiedValue& v) { return Text(coverage_of(v) == Coverage::interval ? "" : v.printed_U); });
        } else if (c.show == "k") {
            put(c, words_("certificate", "k"), "", true, of,
                [](const CertifiedValue& v) { return Text(coverage_of(v) == Coverage::interval ? "" : v.printed_k); });
        } else if (c.show == "nu_eff") {
            put(c, words_("certificate", "nu_eff"), "", true, of, [](const CertifiedValue& v) {
                return Text(coverage_of(v) == Coverage::student_t ? v.printed_nu_eff : "");
            });
        } else if (c.show == "verdict") {
            put(c, words_("certificate", "verdict"), "", false, of, [this](const CertifiedValue& v) {
                return v.verdict ? words_("verdict_name", v.verdict->verdict) : Text();
            });
        } else if (c.show == "limit_low") {
            add_limit(c, of, "limit_low", [](const Verdict& v) { return v.printed.lower; });
        } else if (c.show == "limit_high") {
            add_limit(c, of, "limit_high", [](const Verdict& v) { return v.printed.upper; });
        } else if (c.show == "limit") {
            add_limits(c, of);
        }
    }

    void add_limit(const ShownColumn& c, const CertifiedColumn& of, const char* head,
                   const std::function<std::string(const Verdict&)>& limit) {
        put(c, words_("point_table", head), of.printed_unit, true, of,
            [limit](const CertifiedValue& v) { return Text(v.verdict ? limit(*v.verdict) : ""); });
    }

    void add_limits(const ShownColumn& c, const CertifiedColumn& of) {
        const auto lower = [](const CertifiedValue& v) { return v.verdict && !v.verdict->printed.lower.empty(); };
        const auto upper = [](const CertifiedValue& v) { return v.verdict && !v.verdict->printed.upper.empty(); };
        const bool symmetrical = !any(of, [&](const CertifiedValue& v) {
            return !lower(v) || !upper(v) || without_minus(v.verdict->printed.lower) != v.verdict->printed.upper;
        });
        if (symmetrical && overview_.plus_minus()) {
            add_limit(c, of, "limit", [](const Verdict& v) { return v.printed.upper; });
            return;
        }
        if (any(of, lower) || !any(of, upper)) {
            add_limit(c, of, "limit_low", [](const Verdict& v) { return v.printed.lower; });
        }
        if (any(of, upper)) {
            add_limit(c, of, "limit_high", [](const Verdict& v) { return v.printed.upper; });
        }
    }

    /// Intervals in place of U, k that is not the same for all with the ν_eff that it is taken for, and marks.
    void add_what_U_needs(const ShownColumn& of_result) {
        const CertifiedColumn* const of = result(of_result.of);
        if (of == nullptr) {
            return;
        }
        const ShownColumn c{.show = "", .of = of_result.of, .heading = {}, .role = "", .stage = of_result.stage};
        const auto is_interval = [](const CertifiedValue& v) { return coverage_of(v) == Coverage::interval; };
        if (any(*of, is_interval)) {
            const auto end = [&](const char* head, std::string CertifiedValue::*text) {
                put(c, words_("certificate", head), of->printed_unit, true, *of,
                    [=](const CertifiedValue& v) { return Text(is_interval(v) ? v.*text : ""); });
            };
            end("low", &CertifiedValue::printed_low);
            end("high", &CertifiedValue::printed_high);
        }
        const auto has = [&](const char* show) {
            return std::any_of(table_.layout->shown.begin(), table_.layout->shown.end(),
                               [&](const ShownColumn& s) { return s.of == of_result.of && s.show == show; });
        };
        const auto add_too = [&](const char* show) {
            ShownColumn too = c;
            too.show = show;
            add_of_result(too, *of);
        };
        if (overview_.k_column() && !has("k") && any(*of, [](const auto& v) { return !v.printed_k.empty(); })) {
            add_too("k");
        }
        const auto has_degrees = [](const CertifiedValue& v) {
            return coverage_of(v) == Coverage::student_t && !v.printed_nu_eff.empty();
        };
        if (overview_.nu_beside_k() && !has("nu_eff") && any(*of, has_degrees)) {
            add_too("nu_eff");
        }
        if (any(*of, [&](const auto& v) { return !overview_.note(v).empty(); })) {
            put(c, words_("certificate", "note"), "", false, *of, [this](const CertifiedValue& v) {
                const std::string note = overview_.note(v);
                return Text(note.empty() ? k_blank : note);
            });
        }
    }
};

/// Heads above the heads: before and after an adjustment. None where nothing was adjusted.
std::vector<std::pair<Text, std::size_t>> stages_of(const std::vector<LayoutColumn>& columns, const Wording& words) {
    std::vector<std::pair<Text, std::size_t>> stages;
    std::optional<std::string> last;
    bool any = false;
    for (const LayoutColumn& c : columns) {
        any = any || !c.stage.empty();
        if (last == c.stage) {
            ++stages.back().second;
            continue;
        }
        stages.emplace_back(c.stage.empty() ? Text() : words("point_table", c.stage), 1U);
        last = c.stage;
    }
    return any ? stages : std::vector<std::pair<Text, std::size_t>>();
}

}  // namespace

Text layout_caption(const certificate::TableLayout& layout, const Wording& words) {
    Text caption = layout.title.empty()
                       ? words("table_name", "results")
                       : words.filled("point_table", "title", {{"title", words.localised(layout.title)}});
    if (!layout.group.empty()) {
        const Text heading =
            layout.group_role.empty() ? words.localised(layout.group_heading) : word_or(layout.group_role, words);
        caption += " " + words.filled("point_table", "group", {{"heading", heading}, {"group", layout.group}});
    }
    return caption;
}

Text heading_of(const PointColumn& column, const Wording& words) {
    return !column.heading.empty() ? words.localised(column.heading)
                                   : word_or(column.role.empty() ? column.name : column.role, words);
}

void layout_table(CertificateBuilder& builder, const Wording& words, const CertifiedTable& table, const std::string& id,
                  const CertifiedOverview::Holds& shown, const CertifiedOverview& overview) {
    const std::vector<LayoutColumn> columns = LayoutColumns(table, words, overview, shown).all();
    Rows lines;
    std::vector<const CertifiedValue*> marked;
    for (std::size_t row = 0; row < table.argument->printed.size(); ++row) {
        bool any = false;
        for (const CertifiedColumn& c : table.columns) {
            if (shown(c.values[row])) {
                any = true;
                marked.push_back(&c.values[row]);
            }
        }
        if (!any) {
            continue;
        }
        std::vector<Text> line;
        for (const LayoutColumn& c : columns) {
            line.push_back(c.cell(row));
        }
        lines.push_back(std::move(line));
    }
    if (lines.empty()) {
        return;
    }
    std::vector<Column> heads;
    for (const LayoutColumn& c : columns) {
        heads.push_back(c.column);
    }
    Text caption = layout_caption(*table.layout, words);
    if (const Text marks = overview.meaning_of_marks(words, marked); !marks.empty()) {
        caption += " " + marks;
    }
    builder.table(id, caption, heads, lines, stages_of(columns, words));
}

bool shows_verdict(const CertifiedTable& table, const std::string& result) {
    const auto shows = [&](const auto& holds) {
        return table.layout && std::any_of(table.layout->shown.begin(), table.layout->shown.end(),
                                           [&](const ShownColumn& c) { return c.of == result && holds(c.show); });
    };
    return shows([](const std::string& show) { return show == "verdict"; }) &&
           shows([](const std::string& show) { return show.starts_with("limit"); });
}

}  // namespace gumcert::reports
