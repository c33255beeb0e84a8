#include "reports/view/certified_value_tables.h"

#include "reports/printed_texts.h"
#include "reports/result_names.h"
#include "reports/view/point_table_view.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

constexpr std::size_t k_most_columns = 13;  // of a table on A4 upright

/// Which columns stand under one quantity.
struct Parts {
    bool U = false, u = false, interval = false, k = false, nu_eff = false, note = false;

    void see(const CertifiedValue& v, const CertifiedOverview& overview) {
        interval = interval || coverage_of(v) == Coverage::interval;
        u = u || (coverage_of(v) == Coverage::interval && !v.printed_u.empty());
        U = U || (!v.printed_U.empty() && coverage_of(v) != Coverage::interval);
        k = k || (overview.k_column() && !v.printed_k.empty());
        nu_eff = nu_eff || (overview.k_column() && coverage_of(v) == Coverage::student_t && !v.printed_nu_eff.empty());
        note = note || !overview.note(v).empty();
    }
    [[nodiscard]] std::size_t count() const {
        return 1U + (U ? 1U : 0U) + (u ? 1U : 0U) + (interval ? 2U : 0U) + (k ? 1U : 0U) + (nu_eff ? 1U : 0U) +
               (note ? 1U : 0U);
    }
};

void heads(std::vector<Column>& columns, const Parts& parts, const std::string& unit, const Wording& words,
           bool narrow) {
    columns.push_back({words("certificate", "value"), unit, true});
    if (parts.U) {
        columns.push_back({words("certificate", narrow ? "U_short" : "U"), unit, true});
    }
    if (parts.u) {
        columns.push_back({words("certificate", "u"), unit, true});
    }
    if (parts.interval) {
        columns.push_back({words("certificate", "low"), unit, true});
        columns.push_back({words("certificate", "high"), unit, true});
    }
    if (parts.k) {
        columns.push_back({words("certificate", "k"), "", true});
    }
    if (parts.nu_eff) {
        columns.push_back({words("certificate", "nu_eff"), "", true});
    }
    if (parts.note) {
        columns.push_back({words("certificate", "note"), ""});
    }
}

/// \param value  none: it is not shown here
void cells(std::vector<Text>& row, const Parts& parts, const CertifiedValue* value, const CertifiedOverview& overview) {
    const CertifiedValue nothing;
    const CertifiedValue& v = value == nullptr ? nothing : *value;
    const bool interval = coverage_of(v) == Coverage::interval;
    row.emplace_back(v.printed_value);
    if (parts.U) {
        row.emplace_back(interval ? "" : v.printed_U);
    }
    if (parts.u) {
        row.emplace_back(interval ? v.printed_u : "");
    }
    if (parts.interval) {
        row.emplace_back(interval ? v.printed_low : "");
        row.emplace_back(interval ? v.printed_high : "");
    }
    if (parts.k) {
        row.emplace_back(interval ? "" : v.printed_k);
    }
    if (parts.nu_eff) {
        row.emplace_back(coverage_of(v) == Coverage::student_t ? v.printed_nu_eff : "");
    }
    if (parts.note) {
        // A blank and not "–": nothing is missing where nothing is to be said.
        const std::string note = value == nullptr ? "" : overview.note(v);
        row.emplace_back(note.empty() ? "\u00A0" : note);
    }
}

/// What the name of a quantity stands for; empty where the name says it.
Text meaning(const CertifiedTable& table, const CertifiedColumn& column, const Wording& words) {
    const std::string name = name_in_table(table.id, column.result);
    if (column.name.empty() || column.name.in("en") == column.result || column.name.in("en") == name ||
        name != column.result) {
        return {};
    }
    return result_meaning(table, column, words);
}

Text with_marks(Text caption, const CertifiedOverview& overview, const Wording& words,
                const std::vector<const CertifiedValue*>& values) {
    const Text marks = overview.meaning_of_marks(words, values);
    return marks.empty() ? caption : std::move(caption) + " " + marks;
}

/// One row a quantity: for a table without argument.
void quantity_table(CertificateBuilder& builder, const Wording& words, const CertifiedTable& table,
                    const std::string& id, const CertifiedOverview::Holds& shown, const CertifiedOverview& overview) {
    std::vector<const CertifiedColumn*> rows_of;
    Parts parts;
    bool named = false;
    std::vector<std::string> units;
    for (const CertifiedColumn& column : table.columns) {
        if (!column.values.empty() && shown(column.values.front())) {
            rows_of.push_back(&column);
            parts.see(column.values.front(), overview);
            named = named || !meaning(table, column, words).empty();
            units.push_back(column.printed_unit);
        }
    }
    if (rows_of.empty()) {
        return;
    }
    const std::optional<std::string> unit = common(units);
    std::vector<Column> columns = {{words("certificate", "quantity"), ""}};
    if (named) {
        columns.push_back({words("certificate", "meaning"), ""});
    }
    heads(columns, parts, unit.value_or(""), words, false);
    if (!unit) {
        columns.push_back({words("certificate", "unit"), ""});
    }
    Rows lines;
    std::vector<const CertifiedValue*> marked;
    for (const CertifiedColumn* column : rows_of) {
        std::vector<Text> row = {name_in_table(table.id, column->result)};
        if (named) {
            row.push_back(meaning(table, *column, words));
        }
        cells(row, parts, &column->values.front(), overview);
        marked.push_back(&column->values.front());
        if (!unit) {
            row.emplace_back(column->printed_unit.empty() ? "1" : column->printed_unit);
        }
        lines.push_back(std::move(row));
    }
    builder.table(id, with_marks(certified_table_name(table, words), overview, words, marked), columns, lines);
}

/// Rows of the argument, a group of columns a quantity; more than one table where they do not fit side by side.
void argument_table(CertificateBuilder& builder, const Wording& words, const CertifiedTable& table,
                    const std::string& id, const CertifiedOverview::Holds& shown, const CertifiedOverview& overview) {
    struct Quantity {
        const CertifiedColumn* column = nullptr;
        Parts parts = {};
    };
    std::vector<Quantity> quantities;
    for (const CertifiedColumn& column : table.columns) {
        Quantity q{.column = &column};
        bool any = false;
        for (const CertifiedValue& v : column.values) {
            if (shown(v)) {
                any = true;
                q.parts.see(v, overview);
            }
        }
        if (any) {
            quantities.push_back(q);
        }
    }
    const CertifiedTable::Argument& argument = *table.argument;
    std::size_t part = 0;
    for (std::size_t first = 0; first < quantities.size();) {
        std::size_t last = first;
        std::size_t width = 1;
        while (last < quantities.size() &&
               (last == first || width + quantities[last].parts.count() <= k_most_columns)) {
            width += quantities[last++].parts.count();
        }
        std::vector<Column> columns = {{argument_head(argument, words), argument.printed_unit, is_numeric(argument)}};
        std::vector<std::pair<Text, std::size_t>> groups = {{"", 1}};
        for (std::size_t q = first; q < last; ++q) {
            heads(columns, quantities[q].parts, quantities[q].column->printed_unit, words, width > 6);
            groups.emplace_back(name_in_table(table.id, quantities[q].column->result), quantities[q].parts.count());
        }
        Rows lines;
        std::vector<const CertifiedValue*> marked;
        for (std::size_t r = 0; r < argument.printed.size(); ++r) {
            std::vector<Text> row = {argument.printed[r]};
            bool any = false;
            for (std::size_t q = first; q < last; ++q) {
                const CertifiedValue& v = quantities[q].column->values.at(r);
                any = any || shown(v);
                cells(row, quantities[q].parts, shown(v) ? &v : nullptr, overview);
                if (shown(v)) {
                    marked.push_back(&v);
                }
            }
            if (any) {
                lines.push_back(std::move(row));
            }
        }
        Text caption = certified_table_name(table, words);
        if (part > 0 || last < quantities.size()) {
            std::vector<std::string> names;
            for (std::size_t q = first; q < last; ++q) {
                names.push_back(quantities[q].column->result);
            }
            caption += " " + joined(names) + ".";
        }
        builder.table(id + (part == 0 ? "" : "-" + std::to_string(part)),
                      with_marks(std::move(caption), overview, words, marked), columns, lines, groups);
        ++part;
        first = last;
    }
}

}  // namespace

Text certified_table_name(const CertifiedTable& table, const Wording& words) {
    if (table.layout) {
        return layout_caption(*table.layout, words);
    }
    static const std::set<std::string> known = {"results", "set_up",    "error_motions",   "reversal",
                                                "ranges",  "axis_line", "location_errors", "positioning"};
    return known.contains(table.id) ? words("table_name", table.id)
                                    : words.filled("table_name", "other", {{"name", table.id}});
}

Text argument_head(const CertifiedTable::Argument& argument, const Wording& words) {
    return argument.name == "angle" || argument.name == "point" ? words("certificate", argument.name)
                                                                : Text(argument.name);
}

bool is_numeric(const CertifiedTable::Argument& argument) {
    return std::all_of(argument.values.begin(), argument.values.end(), [](const auto& v) { return v.has_value(); });
}

void certified_meanings(CertificateBuilder& builder, const Wording& words, const CertifiedTable& table) {
    std::vector<std::pair<Text, Text>> rows;
    for (const CertifiedColumn& column : table.columns) {
        if (Text text = meaning(table, column, words); !text.empty()) {
            rows.emplace_back(column.result, std::move(text));
        }
    }
    if (!rows.empty()) {
        builder.definitions(rows);
    }
}

void certified_table(CertificateBuilder& builder, const Wording& words, const CertifiedTable& table,
                     const std::string& id, const CertifiedOverview::Holds& shown, const CertifiedOverview& overview) {
    if (table.layout && table.argument) {
        layout_table(builder, words, table, id, shown, overview);
    } else if (table.argument) {
        argument_table(builder, words, table, id, shown, overview);
    } else {
        quantity_table(builder, words, table, id, shown, overview);
    }
}

}  // namespace gumcert::reports
