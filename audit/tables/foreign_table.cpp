#include "audit/tables/foreign_table.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "audit/tables/sheet_view.h"
#include "audit/tables/table_heads.h"
#include "audit/tables/table_reader.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

/// Budgets of one name are told apart by the line above their heads, or by their place.
void tell_apart(std::vector<AuditedBudget>& budgets, const std::vector<std::string>& titles) {
    const auto add = [&budgets](const auto& words) {
        std::map<std::string, std::size_t> names;
        for (const AuditedBudget& budget : budgets) {
            ++names[budget.name];
        }
        for (std::size_t i = 0; i < budgets.size(); ++i) {
            if (names[budgets[i].name] > 1 && !words(i).empty()) {
                budgets[i].name += ", " + words(i);
            }
        }
    };
    add([&titles](std::size_t i) { return titles[i]; });
    add([&budgets](std::size_t i) { return budgets[i].place; });
}

/// What the points of one table have in common is said once.
void tell_once(std::vector<Sentence>& sentences, std::size_t from) {
    constexpr std::size_t k_most = 500;  // of so many nobody reads all
    if (sentences.size() - from > k_most) {
        return;
    }
    for (std::size_t i = from; i < sentences.size(); ++i) {
        const auto at = sentences.begin() + static_cast<std::ptrdiff_t>(i);
        sentences.erase(std::remove(at + 1, sentences.end(), Sentence(*at)), sentences.end());
    }
}

/// Says what of the heads of a sheet without a table is known, and what is missing.
void tell_nearest_heads(const SheetView& sheet, std::vector<Sentence>& not_read) {
    constexpr std::size_t k_most = 6;
    const std::optional<NearestHeads> heads = nearest_heads(sheet);
    if (!heads) {
        return;
    }
    const std::string place = sheet.place({.row = heads->row, .column = heads->column});
    const auto quoted = [](const std::vector<std::string>& texts) {
        std::vector<std::string> all;
        std::transform(texts.begin(), texts.end(), std::back_inserter(all),
                       [](const std::string& text) { return text::in_quotes(text); });
        return listed(sentences_of(all), k_most);
    };
    not_read.push_back(
        heads->has_quantity
            ? say("{cell}: nearest to such heads; known are {known}; none names u, the contributions, or what "
                  "is divided and by what",
                  place, quoted(heads->known))
            : say("{cell}: nearest to such heads; known are {known}; none names the quantities", place,
                  quoted(heads->known)));
    if (!heads->unknown.empty()) {
        not_read.push_back(say("{cell}: not known are {heads}", place, quoted(heads->unknown)));
    }
}

}  // namespace

ForeignTables budgets_in(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation,
                         const std::string& file) {
    ForeignTables tables;
    std::vector<std::string> titles;
    const DecimalSign sign = decimal_sign_of(workbook);
    for (std::size_t i = 0; i < workbook.sheets.size(); ++i) {
        if (workbook.sheets[i].state != workbook::SheetState::visible) {
            continue;
        }
        const SheetView sheet(workbook, evaluation, i, sign);
        const std::string name = workbook.sheets.size() == 1 ? file : file + ", " + workbook.sheets[i].name;
        const std::size_t before = tables.budgets.size(), told = tables.not_read.size();
        const bool was_unusable = tables.has_unusable;
        const auto read = [&](const SheetView& view) {
            for (const TablePart& part : parts_of(view)) {
                read_tables(view, part, name, tables, titles);
            }
        };
        read(sheet);
        if (tables.budgets.size() == before && tables.has_unusable == was_unusable) {
            if (const std::optional<TurnedBlock> block = turned_block(sheet)) {
                // What was said of its rows as they stand there is not of the table.
                const auto first = tables.not_read.begin() + static_cast<std::ptrdiff_t>(told);
                const std::vector<Sentence> as_it_stands(first, tables.not_read.end());
                tables.not_read.erase(first, tables.not_read.end());
                read(SheetView(workbook, evaluation, i, sign, block));
                if (tables.budgets.size() == before) {
                    tables.not_read.resize(told);
                    tables.not_read.insert(tables.not_read.end(), as_it_stands.begin(), as_it_stands.end());
                }
            }
        }
        tell_once(tables.not_read, told);
    }
    tell_apart(tables.budgets, titles);
    if (tables.budgets.empty() && !tables.has_unusable) {
        tables.not_read.push_back(
            say("{file}: no uncertainty budget was found — a table begins with a row of heads, of which one names the "
                "quantities and one u, the contributions, or, beside a third column, what is divided — name the "
                "columns so, "
                "in English or German",
                file));
        for (std::size_t i = 0; i < workbook.sheets.size(); ++i) {
            if (workbook.sheets[i].state == workbook::SheetState::visible) {
                tell_nearest_heads(SheetView(workbook, evaluation, i, sign), tables.not_read);
            }
        }
    }
    return tables;
}

}  // namespace gumcert::audit