#include "audit/tables/sheet_view.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "audit/words/column_heads.h"
#include "audit/words/unit_words.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellKind;
using workbook::CellValue;

/// Without the signs that set thousands apart: on a page in another language "2.440" would be another number.
std::string without_groups(const StatedNumber& number) {
    const std::size_t decimal = number.half_step > 0.0 ? number.text.find_last_of(".,") : std::string::npos;
    std::string plain;
    for (std::size_t i = 0; i < number.text.size(); ++i) {
        const char c = number.text[i];
        if ((c != '.' && c != ',' && c != '\'') || i == decimal) {
            plain += c;
        }
    }
    return plain;
}

}  // namespace

StatedNumber without_dimension(NumberWithUnit read) {
    if (read.unit == "%") {
        convert(read.number, 0.01);
    }
    return std::move(read.number);
}

DecimalSign decimal_sign_of(const workbook::Workbook& workbook) {
    std::size_t points = 0, commas = 0;
    bool open = false;
    const auto count = [&](DecimalSign shown) {
        points += shown == DecimalSign::point ? 1U : 0U;
        commas += shown == DecimalSign::comma ? 1U : 0U;
        open = open || shown == DecimalSign::open;
    };
    const auto each_cell = [&workbook](const auto& look) {
        for (const workbook::Sheet& sheet : workbook.sheets) {
            for (const Cell& cell : sheet.cells) {
                const bool is_text = cell.value.kind == CellKind::text ||
                                     (cell.value.kind == CellKind::number && workbook.csv_separator != '\0');
                if (is_text && sheet.state == workbook::SheetState::visible) {
                    look(cell.value.text);
                }
            }
        }
    };
    each_cell([&count](const std::string& text) {
        const std::optional<LeadingNumber> number = read_leading_number(text, "", Percent::unit);
        const bool is_number = number && (number->rest.empty() || known_unit(unit_in_rest(number->rest)));
        count(is_number ? number->shows : DecimalSign::each);
    });
    if (points + commas == 0) {
        each_cell([&count](const std::string& text) { count(decimal_sign_in(text)); });
    }
    // A slip of the keyboard or two do not make the sign of a table open.
    constexpr std::size_t k_few = 8;
    if (!open && points > k_few * commas) {
        return DecimalSign::point;
    }
    if (!open && commas > k_few * points) {
        return DecimalSign::comma;
    }
    return points + commas == 0 && !open && workbook.csv_separator == ',' ? DecimalSign::point : DecimalSign::open;
}

SheetView::SheetView(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation, std::size_t sheet,
                     DecimalSign sign, const std::optional<TurnedBlock>& turned)
    : workbook_(workbook),
      evaluation_(evaluation),
      turned_(turned),
      sheet_(sheet),
      sign_(sign),
      name_(workbook::quoted_sheet(workbook.sheets[sheet].name)) {
    if (turned_) {
        turn();
    }
    for (const Cell& cell : turned_ ? turned_cells_ : workbook.sheets[sheet].cells) {
        rows_[cell.address.row].push_back(&cell);
    }
}

namespace {

/// Lines below a turned block are no lines of its table: they keep their columns, and stand apart from it.
constexpr std::uint32_t k_apart = 3;

}  // namespace

void SheetView::turn() {
    const auto& [first, last] = *turned_;
    const std::uint32_t width = last.column - first.column + 1;
    bool has_corner = false;
    for (const Cell& cell : workbook_.sheets[sheet_].cells) {
        Cell copy = cell;
        const workbook::CellAddress at = cell.address;
        if (at.row > last.row) {
            copy.address.row = at.row - last.row - 1 + first.row + width + k_apart;
        } else if (at.row >= first.row) {
            if (at.column < first.column || at.column > last.column) {
                continue;
            }
            has_corner = has_corner || at == first;
            copy.address = {.row = first.row + (at.column - first.column), .column = 1 + (at.row - first.row)};
        }
        turned_cells_.push_back(std::move(copy));
    }
    if (!has_corner) {
        Cell corner;
        corner.address = {.row = first.row, .column = 1};
        corner.value = {.kind = CellKind::text, .text = "quantity"};
        turned_cells_.push_back(std::move(corner));
    }
    std::sort(turned_cells_.begin(), turned_cells_.end(),
              [](const Cell& a, const Cell& b) { return a.address < b.address; });
}

workbook::CellAddress SheetView::in_file(const workbook::CellAddress& address) const {
    if (!turned_ || address.row < turned_->first.row) {
        return address;
    }
    const auto& [first, last] = *turned_;
    const std::uint32_t width = last.column - first.column + 1, line = address.row - first.row;
    if (line < width) {
        return {.row = first.row + address.column - 1, .column = first.column + line};
    }
    return {.row = last.row + 1 + line - std::min(line, width + k_apart), .column = address.column};
}

CellValue SheetView::value(const Cell& cell) const {
    if (cell.formula_kind != workbook::FormulaKind::none) {
        const workbook::EvaluatedCell* evaluated =
            workbook::find_evaluated(evaluation_, workbook_, sheet_, in_file(cell.address));
        if (evaluated != nullptr && evaluated->state != workbook::EvaluationState::not_evaluated) {
            return evaluated->value;
        }
    }
    return cell.value;
}

std::optional<StatedNumber> SheetView::number(const Cell& cell) const {
    std::optional<NumberWithUnit> read = number_with_unit(cell);
    return read && !read->is_open && (read->unit.empty() || read->unit == "%") ? std::optional(std::move(read->number))
                                                                               : std::nullopt;
}

namespace {

/// Whether behind a number stands what it is multiplied by or divided by, its power, or more digits: "2×0.10", "0.20/2", "3^2", "3½",
/// "0.0 1523". The first number alone is another one.
bool goes_on(std::string_view rest) {
    const bool is_digit = !rest.empty() && rest.front() >= '0' && rest.front() <= '9';
    if (is_digit || rest.starts_with('^') || rest.starts_with("½")) {
        return true;
    }
    for (const std::string_view sign : {"×", "·", "*", "∙", "•", "/"}) {
        if (!rest.starts_with(sign)) {
            continue;
        }
        const std::size_t next = rest.find_first_not_of(' ', sign.size());
        return next != std::string_view::npos &&
               ((rest[next] >= '0' && rest[next] <= '9') || rest.substr(next).starts_with("√"));
    }
    return false;
}

}  // namespace

std::optional<NumberWithUnit> SheetView::number_in_text(std::string_view text, const Cell& cell) const {
    std::optional<LeadingNumber> leading = read_leading_number(text, place(cell.address), Percent::unit, sign_);
    if (!leading || goes_on(leading->rest)) {
        return std::nullopt;
    }
    leading->number.text = without_groups(leading->number);
    return NumberWithUnit{
        .number = std::move(leading->number), .unit = unit_in_rest(leading->rest), .is_open = leading->is_open};
}

namespace {

/// The position behind a part of a number format in square brackets that shows nothing by itself, a colour or a language, "[Blue]",
/// "[$-407]"; npos for hours that go on ([h]), currencies and conditions, by which the number is shown in another way.
std::size_t behind_colour_or_language(std::string_view format, std::size_t open) {
    constexpr std::size_t k_longest_of_time = 2;  // [hh]
    const std::size_t close = format.find(']', open);
    if (close == std::string_view::npos) {
        return close;
    }
    const std::string_view held = format.substr(open + 1, close - open - 1);
    const bool is_colour =
        held.size() > k_longest_of_time && std::all_of(held.begin(), held.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ';
        });
    return is_colour || held.starts_with("$-") ? close + 1 : std::string_view::npos;
}

/// Whether a number format multiplies by 100: by a % that is neither quoted nor escaped.
bool shows_percent(std::string_view format) {
    constexpr char k_quote = 0x22;
    bool is_quoted = false;
    for (std::size_t i = 0; i < format.size() && (is_quoted || format[i] != ';'); ++i) {
        if (format[i] == k_quote) {
            is_quoted = !is_quoted;
        } else if (!is_quoted && (format[i] == '\\' || format[i] == '_' || format[i] == '*')) {
            ++i;
        } else if (!is_quoted && format[i] == '%') {
            return true;
        }
    }
    return false;
}

/// The unit that a number format writes behind its digits, as 0.000" µm" does; "" where it writes none that is known, or something
/// else than the number: a date, thousands (a comma behind the digits), a percentage.
std::string unit_of_format(std::string_view format) {
    constexpr char k_quote = 0x22;
    constexpr std::string_view k_general = "General";
    std::string behind;
    bool has_digits = format.starts_with(k_general);
    for (std::size_t i = has_digits ? k_general.size() : 0; i < format.size() && format[i] != ';'; ++i) {
        const char c = format[i];
        if (c == k_quote) {
            const std::size_t close = format.find(k_quote, i + 1);
            if (close == std::string_view::npos) {
                return "";
            }
            behind += format.substr(i + 1, close - i - 1);
            i = close;
        } else if (c == '\\' && i + 1 < format.size()) {
            behind += format[++i];
        } else if (c == '_' || c == '*') {
            ++i;  // as wide as the next character, or filled with it
        } else if (c == '[') {
            const std::size_t behind_it = behind_colour_or_language(format, i);
            if (behind_it == std::string_view::npos) {
                return "";
            }
            i = behind_it - 1;
        } else if (c == '0' || c == '#' || c == '?' || c == '.') {
            has_digits = true;
            behind.clear();
        } else if (c == 'E' || c == '+' || c == '-' || c == ' ' || (c == ',' && !has_digits)) {
            continue;
        } else if (c == ',') {
            const bool is_between = i + 1 < format.size() && (format[i + 1] == '0' || format[i + 1] == '#');
            if (!is_between) {
                return "";
            }
        } else if (static_cast<unsigned char>(c) >= 0x80U) {
            behind += c;  // signs that need no quotes: µ, °, a space that does not break
        } else {
            return "";
        }
    }
    std::string unit = unit_in_rest(behind);
    return has_digits && !unit.empty() && known_unit(unit) ? unit : "";
}

}  // namespace

const std::string& SheetView::unit_shown(const Cell& cell) const {
    static const std::string none;
    const std::vector<std::string>& formats = workbook_.number_formats;
    if (cell.number_format >= formats.size()) {
        return none;
    }
    const auto [known, is_new] = units_of_formats_.try_emplace(cell.number_format);
    if (is_new) {
        known->second = unit_of_format(formats[cell.number_format]);
    }
    return known->second;
}

std::optional<NumberWithUnit> SheetView::number_with_unit(const Cell& cell) const {
    const CellValue held = value(cell);
    const bool is_csv = workbook_.csv_separator != '\0';
    if (held.kind == CellKind::text || (held.kind == CellKind::number && is_csv)) {
        return number_in_text(held.text, cell);
    }
    if (held.kind != CellKind::number) {
        return std::nullopt;
    }
    NumberWithUnit read{.number = exact_number(held.number, place(cell.address)), .unit = unit_shown(cell)};
    if (cell.formula_kind == workbook::FormulaKind::none && !has_formulas()) {
        if (std::optional<StatedNumber> printed = read_number(held.text, place(cell.address))) {
            printed->value = held.number;
            // A workbook stores a point, whatever sign it shows.
            if (sign_ == DecimalSign::comma) {
                std::replace(printed->text.begin(), printed->text.end(), '.', ',');
            }
            read.number = std::move(*printed);
        }
    }
    return read;
}

NumberWithUnit SheetView::as_shown(NumberWithUnit read, const Cell& cell) const {
    const std::vector<std::string>& formats = workbook_.number_formats;
    const bool in_percent = value(cell).kind == CellKind::number && cell.number_format < formats.size() &&
                            shows_percent(formats[cell.number_format]);
    return in_percent
               ? NumberWithUnit{.number = exact_number(100.0 * read.number.value, read.number.place), .unit = "%"}
               : std::move(read);
}

const SheetView::HeadCell& SheetView::head(const Cell& cell) const {
    static const HeadCell none;
    if (cell.formula_kind == workbook::FormulaKind::none && cell.value.kind != CellKind::text) {
        return none;
    }
    const auto [known, is_new] = heads_.try_emplace(&cell);
    if (is_new) {
        const CellValue held = value(cell);
        if (held.kind == CellKind::text) {
            known->second = {.is_text = true, .column = column_of(held.text)};
        }
    }
    return known->second;
}

std::string SheetView::words(const Cell& cell) const {
    const CellValue held = value(cell);
    if (held.kind == CellKind::text) {
        return held.text;
    }
    return held.kind == CellKind::number ? (held.text.empty() ? text::shortest(held.number) : held.text) : "";
}

const Cell* cell_in(const SheetView::Row& row, std::uint32_t column) {
    const auto found =
        std::find_if(row.begin(), row.end(), [column](const Cell* cell) { return cell->address.column == column; });
    return found == row.end() ? nullptr : *found;
}

bool says_nothing(std::string_view text) {
    constexpr std::string_view k_none[] = {"", "-", "–", "—", "n/a", "N/A", "n.a.", "k. A.", "k.A."};
    return std::find(std::begin(k_none), std::end(k_none), text) != std::end(k_none);
}

Sentence open_sign(const std::string& place, const std::string& held) {
    return say(
        "{cell}: {text} may be set apart in thousands or have three decimals, and no other number of the file shows "
        "which; the number is not used; what is meant?",
        place, text::in_quotes(held));
}

}  // namespace gumcert::audit
