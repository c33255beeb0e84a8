#include "reports/forms/asset_files.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/render.h"
#include "reports/forms/text_columns.h"
#include "reports/view/certificate_view.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

namespace {

using nlohmann::json;

constexpr std::size_t k_part_indent = 2;
constexpr std::size_t k_least_column = 8;  // of texts, and of numbers that are shorter
constexpr std::string_view k_minus = "\u2212";

std::string text_of(const json& object, const char* key) {
    return object.at(key).get<std::string>();
}

/// A text, and that of the second language behind a stroke where it differs.
std::string both(const json& object, const char* key) {
    std::string text = text_of(object, key);
    for (const json& second : object.at(std::string_view(key) == "text" ? "also" : std::string(key) + "_also")) {
        text += " / " + text_of(second, "text");
    }
    return text;
}

std::string centred(const std::string& text) {
    std::string out;
    for (const std::string& line : wrapped(text, k_columns)) {
        out += std::string((k_columns - width(line)) / 2, ' ') + line + "\n";
    }
    return out;
}

std::string paragraph(const std::string& text, std::size_t indent) {
    std::string out;
    for (const std::string& line : wrapped(text, k_columns - indent)) {
        out += std::string(line.empty() ? 0 : indent, ' ') + line + "\n";
    }
    return out;
}

/// A sentence in the binding language, below it the same in the second one.
std::string sentences(const json& object, const char* key, const std::string& before = {}) {
    std::string out = paragraph(before + text_of(object, key), 0);
    for (const json& second : object.at(std::string_view(key) == "text" ? "also" : std::string(key) + "_also")) {
        out += paragraph("/ " + text_of(second, "text"), 0);
    }
    return out;
}

std::string definitions(const json& block) {
    std::size_t labels = 0;
    for (const json& row : block.at("rows")) {
        labels = std::max(labels, std::min<std::size_t>(40, width(both(row, "label"))));
    }
    std::string out;
    for (const json& row : block.at("rows")) {
        const std::vector<std::string> left = wrapped(both(row, "label"), labels);
        const std::vector<std::string> right = wrapped(both(row, "value"), k_columns - labels - 4);
        for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
            const std::string value = i < right.size() ? right[i] : "";
            const std::string label = "  " + padded(i < left.size() ? left[i] : "", value.empty() ? 0 : labels, false);
            out += label + (value.empty() ? "" : "  " + value) + "\n";
        }
    }
    return out;
}

/// One table line of cells that may each have several lines.
std::string table_line(const std::vector<std::vector<std::string>>& cells, const std::vector<std::size_t>& widths,
                       const std::vector<bool>& numbers, std::size_t gap, bool at_bottom) {
    std::size_t height = 1;
    for (const auto& cell : cells) {
        height = std::max(height, cell.size());
    }
    std::string out;
    for (std::size_t i = 0; i < height; ++i) {
        std::string line;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const std::size_t skip = at_bottom ? height - cells[c].size() : 0;
            const bool here = i >= skip && i - skip < cells[c].size();
            line += std::string(c == 0 ? 0 : gap, ' ') + padded(here ? cells[c][i - skip] : "", widths[c], numbers[c]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    return out;
}

std::size_t span_of(const json& cell) {
    const std::string text = text_of(cell, "span");
    std::size_t span = 1;
    (void)std::from_chars(text.data(), text.data() + text.size(), span);
    return span;
}

bool bilingual(const json& columns) {
    return std::any_of(columns.begin(), columns.end(), [](const json& c) { return !c.at("head_also").empty(); });
}

/// The least width of a column of which no word is broken, in its head or in its cells; numbers are one word.
std::size_t longest_word(const json& column, const json& rows, std::size_t c) {
    std::size_t longest = 2;
    const auto see = [&](const std::string& text, std::size_t indent) {
        std::size_t word = indent;
        for (const Glyph& g : glyphs(text)) {
            word = g.bytes == " " || g.width == 2 ? indent : word + g.width;
            longest = std::max(longest, word);
        }
    };
    see(both(column, "head"), 0);
    for (const json& unit : column.at("unit")) {
        see("/" + text_of(unit, "text"), 0);
    }
    const bool number = text_of(column, "align") == "number";
    for (const json& row : rows) {
        const json& cell = row.at("cells").at(c);
        const std::size_t indent = c == 0 && text_of(row, "kind") == "part" ? k_part_indent : 0;
        if (number) {
            longest = std::max(longest, indent + width(both(cell, "text")) + text_of(cell, "pad").size());
        } else {
            see(both(cell, "text"), indent);
        }
    }
    return longest;
}

/// The width of the longest number of a column; a text that stands among numbers is none.
std::size_t longest_number(const json& rows, std::size_t c) {
    constexpr std::size_t k_longest = 40;  // [columns]: more digits than any number has
    std::size_t longest = 0;
    for (const json& row : rows) {
        const json& cell = row.at("cells").at(c);
        const std::string text = both(cell, "text");
        const std::size_t own = width(text) + text_of(cell, "pad").size();
        const std::size_t first = text.starts_with(k_minus) ? k_minus.size() : 0;
        if (own <= k_longest && first < text.size() && text[first] >= '0' && text[first] <= '9') {
            longest = std::max(longest, own + (c == 0 && text_of(row, "kind") == "part" ? k_part_indent : 0));
        }
    }
    return longest;
}

/// The width of the longest word of a column that has a digit: an identification, a limit within a text.
std::size_t longest_word_with_digits(const json& rows, std::size_t c) {
    constexpr std::size_t k_longest = 40;
    std::size_t longest = 0;
    for (const json& row : rows) {
        const std::string text = both(row.at("cells").at(c), "text");
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find(' ', begin), text.size());
            const std::string word = text.substr(begin, end - begin);
            const std::size_t own = width(word);
            if (own <= k_longest && word.find_first_of("0123456789") != std::string::npos) {
                longest = std::max(longest, own);
            }
            begin = end + 1;
        }
    }
    return longest;
}

std::string table(const json& block) {
    const json& columns = block.at("columns");
    const std::size_t count = columns.size();
    std::vector<std::size_t> widths(count, 1);
    std::vector<bool> numbers(count);
    std::vector<bool> may_shrink(count);
    std::vector<std::string> heads(count);
    for (std::size_t c = 0; c < count; ++c) {
        heads[c] = both(columns[c], "head");
        for (const json& unit : columns[c].at("unit")) {
            heads[c] += " /" + text_of(unit, "text");
        }
        numbers[c] = text_of(columns[c], "align") == "number";
        may_shrink[c] = !numbers[c];
        for (std::size_t from = 0; from < heads[c].size();) {  // a head is wrapped, but never inside a word
            const std::size_t to = std::min(heads[c].find(' ', from), heads[c].size());
            widths[c] = std::max(widths[c], width(heads[c].substr(from, to - from)));
            from = to + 1;
        }
        std::size_t two_lines = 0;
        for (const std::string& line : wrapped(heads[c], std::max(widths[c], 1 + width(heads[c]) / 2))) {
            two_lines = std::max(two_lines, width(line));
        }
        widths[c] = std::max(widths[c], two_lines);
        for (const json& row : block.at("rows")) {
            const json& cell = row.at("cells").at(c);
            const std::size_t indent = c == 0 && text_of(row, "kind") == "part" ? k_part_indent : 0;
            widths[c] = std::max(widths[c], indent + width(both(cell, "text")) + text_of(cell, "pad").size());
        }
    }
    std::size_t gap = 2;
    for (const json& group : block.at("groups")) {  // the head of a group fits above its columns
        std::size_t first = 0;
        for (const json& cell : group.at("cells")) {
            const std::size_t span = span_of(cell);
            std::size_t room = span - 1;  // with the narrow gap
            for (std::size_t c = first; c < first + span; ++c) {
                room += widths[c];
            }
            const std::size_t own = width(both(cell, "text"));
            widths[first] += own > room ? own - room : 0;
            first += span;
        }
    }
    const auto total = [&] {
        std::size_t sum = gap * (count - 1);
        for (const std::size_t w : widths) {
            sum += w;
        }
        return sum;
    };
    if (total() > k_columns) {
        gap = 1;
    }
    // Heads in two languages take as many lines as they have words before anything else gives way. A number is never broken
    // into two lines, where it would read as another one: a table that is too wide for that is wider than the page.
    std::vector<std::size_t> least = widths;
    std::vector<std::size_t> of_words(count), of_numbers(count), of_texts(count);
    for (std::size_t c = 0; c < count; ++c) {
        of_words[c] = longest_word(columns[c], block.at("rows"), c);
        if (bilingual(columns)) {
            least[c] = std::min(widths[c], of_words[c]);
        }
        of_numbers[c] = std::max(k_least_column, longest_number(block.at("rows"), c));
        of_texts[c] = std::max(k_least_column, longest_word_with_digits(block.at("rows"), c));
    }
    // The widest column of texts gives way, then heads of numbers, both between words; words are broken where that is not
    // enough, those of texts first.
    while (total() > k_columns) {
        std::size_t widest = count;
        for (const int step : {0, 1, 2, 3, 4}) {
            for (std::size_t c = 0; c < count; ++c) {
                const std::size_t own = may_shrink[c] ? of_texts[c] : of_numbers[c];
                const bool candidate = step == 0 ? widths[c] > least[c]
                                                 : may_shrink[c] == (step % 2 == 1) &&
                                                       widths[c] > (step < 3 ? std::max(own, of_words[c]) : own);
                if (candidate && (widest == count || widths[c] > widths[widest])) {
                    widest = c;
                }
            }
            if (widest != count) {
                break;
            }
        }
        if (widest == count) {
            break;
        }
        --widths[widest];
    }

    std::string out = sentences(block, "caption", both(block, "number") + ". ");
    const std::string rule(total(), '-');
    out += rule + "\n";
    for (const json& group : block.at("groups")) {
        std::string line;
        std::size_t c = 0;
        for (const json& cell : group.at("cells")) {
            const std::size_t span = span_of(cell);
            std::size_t room = gap * (span - 1);
            for (std::size_t i = 0; i < span; ++i) {
                room += widths[c + i];
            }
            line += std::string(c == 0 ? 0 : gap, ' ') + padded(both(cell, "text"), room, true);
            c += span;
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    std::vector<std::vector<std::string>> cells;
    for (std::size_t c = 0; c < count; ++c) {
        cells.push_back(wrapped(heads[c], widths[c]));
    }
    out += table_line(cells, widths, numbers, gap, true) + rule + "\n";
    for (const json& row : block.at("rows")) {
        cells.clear();
        const std::string kind = text_of(row, "kind");
        if (kind == "closing") {
            out += rule + "\n";
        }
        for (std::size_t c = 0; c < count; ++c) {
            const json& cell = row.at("cells").at(c);
            const std::size_t indent = c == 0 && kind == "part" ? k_part_indent : 0;
            std::vector<std::string> lines = wrapped(both(cell, "text"), widths[c] - indent);
            for (std::string& line : lines) {
                line.insert(0, indent, ' ');
            }
            lines.back() += std::string(text_of(cell, "pad").size(), ' ');
            cells.push_back(std::move(lines));
        }
        out += table_line(cells, widths, numbers, gap, false);
    }
    return out + rule + "\n";
}

std::string section_text(const json& section) {
    std::string out;
    std::size_t longest = 0;
    for (const std::string& line : wrapped(both(section, "heading"), k_columns)) {
        out += line + "\n";
        longest = std::max(longest, width(line));
    }
    out += std::string(longest, '=') + "\n";
    for (const json& block : section.at("blocks")) {
        std::string text;
        for (const json& item : block.at("paragraph")) {
            text = sentences(item, "text");
        }
        for (const json& item : block.at("formula")) {
            text = paragraph(text_of(item, "text"), 4);
        }
        for (const json& item : block.at("definitions")) {
            text = definitions(item);
        }
        for (const json& item : block.at("table")) {
            text = table(item);
        }
        if (!text.empty()) {
            out += "\n" + text;
        }
    }
    return out;
}

/// The first page of a certificate.
std::string identity_text(const json& identity, const json& view) {
    std::string out = centred(both(identity, "laboratory"));
    for (const json& line : identity.at("address")) {
        out += centred(both(line, "text"));
    }
    out += identity.at("accreditation").empty() ? "" : "\n";
    for (const json& line : identity.at("accreditation")) {
        out += centred(both(line, "text"));
    }
    out += "\n" + centred(both(view, "type")) +
           centred(both(identity, "number_label") + ": " + text_of(identity, "number"));
    for (const json& section : identity.at("sections")) {
        out += "\n\n" + section_text(section);
    }
    for (const json& line : identity.at("foot")) {
        out += "\n" + sentences(line, "text");
    }
    return out;
}

}  // namespace

std::string view_as_text(const nlohmann::json& view) {
    const std::string rule(k_columns, '=');
    std::string out;
    for (const json& mark : view.at("mark")) {
        out += rule + "\n" + centred(both(mark, "text")) + rule + "\n" + sentences(mark, "reason") + "\n";
    }
    for (const json& identity : view.at("identity")) {
        out += identity_text(identity, view);
    }
    if (view.at("identity").empty()) {
        out += centred(both(view, "type")) + centred(both(view, "title"));
    }
    for (const json& section : view.at("sections")) {
        out += "\n\n" + section_text(section);
    }
    out += "\n" + std::string(k_columns, '-') + "\n";
    for (const json& line : view.at("closing")) {
        out += sentences(line, "text") + "\n";
    }
    if (const auto changed = view.find("changed_templates"); changed != view.end()) {
        for (const json& mark : *changed) {
            out += paragraph(text_of(mark, "text"), 0) + "\n";
        }
    }
    return out + centred(both(view, "end_mark"));
}

std::string render_text(const EvaluationRecord& record, const RenderAssets& assets) {
    return view_as_text(view_of_document(record, assets));
}

}  // namespace gumcert::reports
