#include "reports/view/point_table_view.h"

#include "certificate/point_tables.h"
#include "reports/point_headings.h"
#include "reports/printed_texts.h"
#include "reports/result_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
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
    std::string stage, role;
    std::string result;  ///< that it belongs to; "" of points
    bool is_value = false;
    Text heading = {};  ///< of the value of a result, for captions
    std::function<Text(std::size_t)> cell;
};

const std::string k_blank = "\u00A0";  // nothing is missing where nothing is to be said

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

    /// Of an object that stays: the cells look into it.
    std::vector<LayoutColumn> all() && = delete;
    std::vector<LayoutColumn> all() & {
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
        const Text heading = as.heading.empty() ? head : words_.localised(as.heading);
        columns_.push_back({.column = {heading, unit, number},
                            .stage = as.stage,
                            .role = as.role,
                            .result = as.show == "point" || as.show == "column" ? "" : as.of,
                            .is_value = as.show == "value",
                            .heading = heading,
                            .cell = std::move(cell)});
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
                put(c, heading_of_shown(table_, c, words_), certificate::shown_unit(*found), number,
                    [found](std::size_t row) { return Text(certificate::shown_cell(*found, row)); });
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
            put(c, heading_of_shown(table_, c, words_), certificate::unit_of_values(table_, of), true, of,
                [this, &of](const CertifiedValue& v) {
                    return Text(certificate::value_as_shown(table_, of, v.printed_value));
                });
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
        put(c, words_("point_table", head), certificate::unit_of_values(table_, of), true, of,
            [this, &of, limit](const CertifiedValue& v) {
                return Text(v.verdict ? certificate::value_as_shown(table_, of, limit(*v.verdict)) : "");
            });
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
            const auto column = [&](const char* head, std::string CertifiedValue::*text) {
                const bool is_value = text != &CertifiedValue::printed_u;
                put(c, words_("certificate", head),
                    is_value ? certificate::unit_of_values(table_, *of) : of->printed_unit, true, *of,
                    [=, this](const CertifiedValue& v) {
                        const std::string& printed = v.*text;
                        return Text(!is_interval(v) ? ""
                                    : is_value      ? certificate::value_as_shown(table_, *of, printed)
                                                    : printed);
                    });
            };
            if (any(*of, [&](const auto& v) { return is_interval(v) && !v.printed_u.empty(); })) {
                column("u", &CertifiedValue::printed_u);
            }
            column("low", &CertifiedValue::printed_low);
            column("high", &CertifiedValue::printed_high);
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
std::vector<std::pair<Text, std::size_t>> stages_of(const std::vector<const LayoutColumn*>& columns,
                                                    const Wording& words) {
    std::vector<std::pair<Text, std::size_t>> stages;
    std::optional<std::string> last;
    bool any = false;
    for (const LayoutColumn* const c : columns) {
        any = any || !c->stage.empty();
        if (last == c->stage) {
            ++stages.back().second;
            continue;
        }
        stages.emplace_back(c->stage.empty() ? Text() : words("point_table", c->stage), 1U);
        last = c->stage;
    }
    return any ? stages : std::vector<std::pair<Text, std::size_t>>();
}

// Room on a page, as templates/pdf/certificate.typ sets tables on A4 upright: bold, 8.2 pt where there are more than eight
// columns, else 8.5 pt.
constexpr double k_page = 480.0;  // [pt] 172 mm, and some points for what is not looked at
constexpr double k_em = 8.2;      // [pt]
constexpr double k_larger = 8.5 / 8.2;
constexpr std::size_t k_few_columns = 8, k_many_columns = 11;
constexpr double k_column_of_words = 40.0;
constexpr double k_gap = 0.095;             // [em] between groups of three digits, where there are more than four
constexpr std::size_t k_longest_part = 11;  // letters of a word that is hyphenated
constexpr double k_uneven_parts = 1.15;
constexpr double k_second_language = 0.85;

// Advance widths of Libertinus Serif Bold, from the blank to the tilde, in thousandths of an em: digits as in tables.
constexpr std::array<int, 95> k_advance = {
    250, 266, 376, 514, 514, 637, 729, 215, 315, 315, 433, 537, 244, 358, 244, 316, 514, 514,  514,
    514, 514, 514, 514, 514, 514, 514, 256, 256, 512, 551, 512, 430, 988, 740, 654, 706, 734,  609,
    545, 732, 817, 367, 373, 736, 577, 899, 740, 730, 614, 730, 716, 504, 652, 732, 700, 1028, 718,
    624, 624, 397, 307, 397, 518, 486, 392, 506, 542, 456, 561, 489, 391, 521, 619, 322, 312,  613,
    325, 905, 616, 551, 581, 573, 428, 427, 358, 598, 529, 777, 561, 558, 452, 307, 220, 307,  473};

/// Of the letter that begins with a byte, in em; 0 within a letter. Of letters with accents those of the wider ones.
double width_of_letter(char first) {
    const auto byte = static_cast<unsigned char>(first);
    if ((byte & 0xC0U) == 0x80U) {
        return 0.0;
    }
    if (byte >= 0xE3U) {
        return 1.0;  // U+3000 and above: as wide as high
    }
    constexpr double k_other = 0.62;
    const std::size_t place = byte - std::size_t{' '};
    return place < k_advance.size() ? 1e-3 * k_advance[place] : k_other;
}

double width_of(std::string_view text) {
    double width = 0.0;
    for (const char c : text) {
        width += k_em * width_of_letter(c);
    }
    return width;
}

/// Left and right of the cells of a column.
double insets_of(std::size_t columns) {
    return columns > k_many_columns ? 6.4 : columns > k_few_columns ? 8.0 : 9.0;
}

/// A number as it is shown, with what stands invisibly behind it, and gaps behind groups of three digits.
double width_of_number(const std::string& text, const std::string& pad) {
    constexpr std::size_t k_without_gaps = 4;
    std::size_t gaps = 0;
    std::size_t digits = 0;
    for (const char c : text + pad + ' ') {
        if (c >= '0' && c <= '9') {
            ++digits;
        } else {
            gaps += digits > k_without_gaps ? (digits - 1) / 3 : 0;
            digits = 0;
        }
    }
    return width_of(text) + width_of(pad) + k_gap * k_em * static_cast<double>(gaps);
}

/// Width of the longest part of a text that is not broken into lines.
double width_of_words(const std::string& text) {
    double widest = 0.0;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t blank = std::min(text.find(' ', begin), text.size());
        const std::string_view word = std::string_view(text).substr(begin, blank - begin);
        const auto letters = static_cast<std::size_t>(
            std::count_if(word.begin(), word.end(), [](char c) { return width_of_letter(c) > 0.0; }));
        const std::size_t parts = (letters + k_longest_part - 1) / k_longest_part;
        widest = std::max(widest, width_of(word) * (parts > 1 ? k_uneven_parts / static_cast<double>(parts) : 1.0));
        begin = blank + 1;
    }
    return widest;
}

/// Room that a column takes.
struct ColumnWidth {
    double least = 0.0;      ///< so that nothing breaks that must not
    double with_room = 0.0;  ///< the same, where a column of words has some room
    double whole = 0.0;      ///< in one line
};

ColumnWidth width_of(const LayoutColumn& column, const Rows& lines, std::size_t position, const Wording& words) {
    ColumnWidth width;
    const auto see = [&](double least, double whole) {
        width.least = std::max(width.least, least);
        width.whole = std::max(width.whole, whole);
    };
    for (std::size_t language = 0; language < column.column.head.languages(); ++language) {
        const std::string& head = column.column.head.in(language);
        const double size = language == 0 ? 1.0 : k_second_language;
        see(size * width_of_words(head), size * width_of(head));
    }
    const double unit = column.column.unit.empty() ? 0.0 : width_of("/ " + column.column.unit);
    see(unit, unit);
    std::vector<std::string> numbers;
    for (const std::vector<Text>& line : lines) {
        const std::string& cell = line[position].first();
        if (column.column.number) {
            numbers.push_back(words.number(cell).first());
        } else {
            see(width_of_words(cell), width_of(cell));
        }
    }
    const std::vector<std::string> pads = pads_of(numbers, words.decimal_sign());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double number = width_of_number(numbers[i], pads[i]);
        see(number, number);
    }
    width.with_room = column.column.number ? width.least : std::max(width.least, k_column_of_words);
    return width;
}

/// Whether columns fit side by side: where the template gives them their widths, or where it leaves them to the setter,
/// who makes the widest ones equal until all fit.
bool fit_on_a_page(const std::vector<ColumnWidth>& columns) {
    const double insets = insets_of(columns.size());
    const double size = columns.size() > k_few_columns ? 1.0 : k_larger;
    double with_room = 0.0;
    std::vector<double> whole;
    for (const ColumnWidth& column : columns) {
        with_room += size * column.with_room + insets;
        whole.push_back(size * column.whole + insets);
    }
    if (with_room <= k_page) {
        return true;
    }
    std::sort(whole.begin(), whole.end());
    double left = k_page, widest = 0.0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const double fair = left / static_cast<double>(whole.size() - i);
        widest = fair;
        if (whole[i] > fair) {
            break;
        }
        left -= whole[i];
        widest = whole[i];
    }
    return std::all_of(columns.begin(), columns.end(),
                       [&](const ColumnWidth& column) { return size * column.least + insets <= widest; });
}

/// The first of some columns that has another text in every row; the first one where none has.
std::size_t column_that_tells_rows(const std::vector<std::size_t>& columns, const Rows& lines) {
    const auto tells = [&](std::size_t column) {
        std::set<std::string> texts;
        for (const std::vector<Text>& line : lines) {
            texts.insert(line[column].first());
        }
        return texts.size() == lines.size();
    };
    const auto found = std::find_if(columns.begin(), columns.end(), tells);
    return found == columns.end() ? columns.front() : *found;
}

/// How many of the last columns before the first result belong to it: where later results have before them such columns of their
/// own, an indication with its standard deviation, as many and with the same roles.
std::size_t columns_of_first_result(const std::vector<LayoutColumn>& columns, const std::vector<std::size_t>& leading,
                                    const std::vector<std::vector<std::size_t>>& blocks) {
    std::size_t most = 0;
    const auto see = [&](const std::vector<std::string>& roles) {
        const bool has_role = std::any_of(roles.begin(), roles.end(), [](const auto& role) { return !role.empty(); });
        const auto is_of = [&](const std::string& role, std::size_t i) { return role == columns[i].role; };
        if (has_role && roles.size() < leading.size() &&
            std::equal(roles.rbegin(), roles.rend(), leading.rbegin(), is_of)) {
            most = std::max(most, roles.size());
        }
    };
    for (std::size_t b = 1; b < blocks.size(); ++b) {
        std::vector<std::string> roles;  // of the columns of points that the block begins with
        for (std::size_t i = 0; i < blocks[b].size() && columns[blocks[b][i]].result.empty(); ++i) {
            roles.push_back(columns[blocks[b][i]].role);
        }
        see(roles);
        see({columns[blocks[b].front()].result.empty() ? columns[blocks[b].front()].role : ""});
    }
    return most;
}

/// The columns of each table that what is shown becomes: one, where it fits on a page.
std::vector<std::vector<std::size_t>> columns_of_parts(const std::vector<LayoutColumn>& columns, const Rows& lines,
                                                       const Wording& words) {
    std::vector<ColumnWidth> widths;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        widths.push_back(width_of(columns[i], lines, i, words));
    }
    const auto fit = [&](const std::vector<std::size_t>& some, const std::vector<std::size_t>& others) {
        std::vector<ColumnWidth> both;
        for (const std::vector<std::size_t>* const all : {&some, &others}) {
            for (const std::size_t i : *all) {
                both.push_back(widths[i]);
            }
        }
        return fit_on_a_page(both);
    };
    std::size_t first_result = 0;
    while (first_result < columns.size() && columns[first_result].result.empty()) {
        ++first_result;
    }
    // A result with its columns, and the columns of points that stand before it.
    std::vector<std::vector<std::size_t>> blocks;
    for (std::size_t i = first_result; i < columns.size(); ++i) {
        const LayoutColumn& before = columns[i - (i > first_result ? 1 : 0)];
        const bool begins = i == first_result || (columns[i].result.empty() && !before.result.empty()) ||
                            (columns[i].is_value && !before.result.empty() && before.result != columns[i].result);
        if (begins) {
            blocks.emplace_back();
        }
        blocks.back().push_back(i);
    }
    std::vector<std::size_t> leading(first_result);
    std::iota(leading.begin(), leading.end(), std::size_t{0});
    const std::size_t of_first = columns_of_first_result(columns, leading, blocks);
    const auto first_of_them = leading.end() - static_cast<std::ptrdiff_t>(of_first);
    if (of_first > 0) {
        blocks.front().insert(blocks.front().begin(), first_of_them, leading.end());
        leading.erase(first_of_them, leading.end());
    }
    const std::size_t end_of_leading = leading.size();
    std::vector<std::vector<std::size_t>> parts = {leading};
    // Where points have so many columns that a result hardly fits beside them, one of them says which row it is.
    const bool all_fit = std::all_of(blocks.begin(), blocks.end(),
                                     [&](const std::vector<std::size_t>& block) { return fit(leading, block); });
    if (!all_fit && leading.size() > 1) {
        leading = {column_that_tells_rows(leading, lines)};
    }
    for (const std::vector<std::size_t>& block : blocks) {
        const bool has_result = parts.back().size() > leading.size() && parts.back().back() >= end_of_leading;
        const bool crowded = parts.back().size() > leading.size() && !all_fit;
        if ((has_result || crowded) && !fit(parts.back(), block)) {
            parts.push_back(leading);
        }
        parts.back().insert(parts.back().end(), block.begin(), block.end());
    }
    return parts;
}

}  // namespace

Text layout_caption(const certificate::TableLayout& layout, const Wording& words) {
    Text caption = layout.title.empty()
                       ? words("table_name", "results")
                       : words.filled("point_table", "title", {{"title", words.localised(layout.title)}});
    if (!layout.group.empty()) {
        const Text heading = layout.group_role.empty() ? words.localised(layout.group_heading)
                                                       : word_of_column(layout.group_role, words);
        caption += " " + words.filled("point_table", "group", {{"heading", heading}, {"group", layout.group}});
    }
    return caption;
}

void layout_table(CertificateBuilder& builder, const Wording& words, const CertifiedTable& table, const std::string& id,
                  const CertifiedOverview::Holds& shown, const CertifiedOverview& overview) {
    LayoutColumns layout(table, words, overview, shown);
    const std::vector<LayoutColumn> columns = layout.all();
    Rows lines;
    std::multimap<std::string, const CertifiedValue*> marked;  // by the result
    for (std::size_t row = 0; row < table.argument->printed.size(); ++row) {
        bool any = false;
        for (const CertifiedColumn& c : table.columns) {
            if (shown(c.values[row])) {
                any = true;
                marked.emplace(c.result, &c.values[row]);
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
    const std::vector<std::vector<std::size_t>> parts = columns_of_parts(columns, lines, words);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        std::vector<const LayoutColumn*> of_part;
        std::vector<Column> heads;
        Rows cells(lines.size());
        Text names;
        std::set<std::string> results;
        for (const std::size_t i : parts[p]) {
            results.insert(columns[i].result);
            of_part.push_back(&columns[i]);
            heads.push_back(columns[i].column);
            for (std::size_t row = 0; row < lines.size(); ++row) {
                cells[row].push_back(lines[row][i]);
            }
            if (columns[i].is_value) {
                const std::string& stage = columns[i].stage;
                names += (names.empty() ? Text() : words("document", "enumeration")) +
                         (stage.empty() ? Text() : words("point_table", stage) + ": ") + columns[i].heading;
            }
        }
        Text caption = layout_caption(*table.layout, words);
        if (parts.size() > 1 && !names.empty()) {
            caption += " " + words.filled("point_table", "title", {{"title", names}});
        }
        std::vector<const CertifiedValue*> of_results;
        for (const auto& [result, value] : marked) {
            if (results.contains(result)) {
                of_results.push_back(value);
            }
        }
        const Text marks = overview.meaning_of_marks(words, of_results);
        caption += marks.empty() ? Text() : " " + marks;
        builder.table(id + (p == 0 ? "" : "-" + std::to_string(p)), caption, heads, cells, stages_of(of_part, words));
    }
}

}  // namespace gumcert::reports
