#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/stated_outcome.h"
#include "audit/worksheets/cell_findings.h"
#include "audit/worksheets/read_cells.h"
#include "audit/worksheets/worksheet_rules.h"
#include "audit/worksheets/worksheet_view.h"
#include "text/numbers.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

using workbook::CellKind;
using workbook::CellPlace;
using workbook::CellValue;
using workbook::Formula;
using workbook::FormulaNode;
using workbook::FormulaNodeKind;

// W04 -----------------------------------------------------------------------------------------------------------------

bool is_over_readings(const Formula& formula) {
    return calls_one_of(formula, {"AVERAGE", "STDEV", "STDEV.S", "STDEVA", "STDEV.P", "STDEVP", "VAR", "VAR.S", "VARP",
                                  "VAR.P", "MEDIAN", "DEVSQ", "COUNT"});
}

/// How many cells areas have, blank ones too.
std::size_t cells_in(const WorksheetView& view, const CellPlace& formula, const std::vector<workbook::Area>& areas) {
    constexpr std::size_t k_most_areas = 16, k_most_cells = 10'000;
    std::size_t cells = 0;
    bool overlap = false;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const workbook::CellRange& range = areas[i].range;
        const auto meets = [&](const workbook::Area& other) {
            return other.sheet == areas[i].sheet && other.range.first.row <= range.last.row &&
                   range.first.row <= other.range.last.row && other.range.first.column <= range.last.column &&
                   range.first.column <= other.range.last.column;
        };
        const auto end = areas.begin() + static_cast<std::ptrdiff_t>(std::min(i, k_most_areas));
        overlap = overlap || std::any_of(areas.begin(), end, meets);
        cells += std::size_t{range.last.row - range.first.row + 1} * (range.last.column - range.first.column + 1);
    }
    return overlap ? view.count_of_read(formula, k_most_cells) : cells;
}

/// What stands in the cells that a formula over readings reads.
struct ReadingsRange {
    std::size_t numbers = 0, cells = 0;
    std::vector<CellRun> runs;
    std::string area;
};
Sentence numbers_in_words(const ReadingsRange& range) {
    return say_count(range.numbers, "{count:number} number", "{count:number} numbers");
}
Sentence cells_in_words(const ReadingsRange& range) {
    return say_count(range.cells, "{count:number} cell", "{count:number} cells");
}

ReadingsRange readings_of(const WorksheetView& view, ReadCells& cells, const SheetFormula& formula) {
    ReadingsRange range;
    range.runs = cells.runs(formula.cell);
    for (const CellRun& run : range.runs) {
        range.numbers += cells.numbers(run);
    }
    const std::vector<workbook::Area> areas = view.areas_read(formula.cell);
    range.area = areas.empty() ? "" : workbook::a1_text(areas.front().range);
    range.cells = cells_in(view, formula.cell, areas);
    return range;
}

/// n whose root a formula like SQRT(5) or SQRT(D5) takes.
std::optional<double> rooted_number(const WorksheetView& view, const SheetFormula& formula) {
    const FormulaNode& root = formula.formula.nodes[formula.formula.root()];
    if (!is_call(root, {"SQRT"}) || root.children != 1) {
        return std::nullopt;
    }
    const FormulaNode& inner = formula.formula.nodes[formula.formula.children_of(root)[0]];
    if (inner.kind == FormulaNodeKind::number) {
        return inner.number;
    }
    const std::optional<CellPlace> cell = view.cell_of(formula, inner);
    const CellValue value = cell ? view.value(*cell) : CellValue{};
    return value.kind == CellKind::number ? std::optional(value.number) : std::nullopt;
}

/// Each text among readings is told once, with the first formula that reads it.
void tell_texts(const WorksheetView& view, const ReadCells& cells, const SheetFormula& formula,
                const ReadingsRange& range, CellRun run, workbook::UntakenPlaces& told, FindingCollector& findings) {
    for (run.begin = told.first_from(run.begin); run.begin < run.end; run.begin = told.first_from(run.begin)) {
        const std::uint32_t at = run.begin;
        told.take(at);
        if (cells.texts({.sheet = run.sheet, .begin = at, .end = at + 1}) == 0) {
            continue;
        }
        AuditFinding finding =
            finding_in(view.place(cells.cell(run.sheet, at)),
                       say("text among the readings {area}: mean and standard deviation leave it out", range.area));
        finding.evidence = {say("{cell} reads {area}", view.place(formula.cell), range.area),
                            say("{numbers} of {cells}", numbers_in_words(range), cells_in_words(range))};
        findings.add(std::move(finding));
    }
}

/// Standard deviation of readings about their mean with the divisor n, and how many they are; nothing where the formula reads
/// other than two numbers or more in one range.
struct DeviationByN {
    double s = 0.0, n = 0.0;
};
std::optional<DeviationByN> deviation_by_n_of(const WorksheetView& view, const SheetFormula& formula) {
    constexpr std::size_t k_most = 1000;
    const std::vector<workbook::Area> areas = view.areas_read(formula.cell);
    std::vector<double> values;
    const bool reads_one =
        !areas.empty() && std::all_of(areas.begin(), areas.end(), [&areas](const workbook::Area& area) {
            return area.sheet == areas.front().sheet && area.range == areas.front().range;
        });
    if (!reads_one || view.count_of_read(formula.cell, k_most) == k_most) {
        return std::nullopt;
    }
    const workbook::CellRange& range = areas.front().range;
    for (std::uint32_t row = range.first.row; row <= range.last.row; ++row) {
        for (std::uint32_t column = range.first.column; column <= range.last.column; ++column) {
            const CellValue value =
                view.value({.sheet = areas.front().sheet, .address = {.row = row, .column = column}});
            if (value.kind == CellKind::number) {
                values.push_back(value.number);
            }
        }
    }
    if (values.size() < 2) {
        return std::nullopt;
    }
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double sum = 0.0;
    for (const double value : values) {
        sum += (value - mean) * (value - mean);
    }
    return DeviationByN{.s = std::sqrt(sum / n), .n = n};
}

/// W04: the scatter of readings about their own mean is that of n − 1 (JCGM 100:2008, 4.2.2); STDEV.P divides by n. Over
/// √(n − 1) it is s/√n, and right.
void deviation_by_n(const WorksheetView& view, const RowAt& at, FindingCollector& findings) {
    const std::optional<StatedNumber>& number = at.is.stated ? at.is.stated : at.is.u;
    const SheetFormula* maker = number ? view.maker_of(number->place) : nullptr;
    // How a bath or a plate varies over all its places has no n − 1.
    const bool is_scatter = at.is.type_a.value_or(at.is.origin == Origin::readings) ||
                            at.is.contributor == Contributor::repeatability ||
                            at.is.contributor == Contributor::reproducibility;
    if (maker == nullptr || !is_scatter ||
        !calls_one_of(maker->formula, {"STDEV.P", "STDEVP", "STDEVPA", "VAR.P", "VARP", "VARPA"})) {
        return;
    }
    const std::optional<DeviationByN> spread = deviation_by_n_of(view, *maker);
    const CellValue made = view.value(maker->cell);
    if (!spread || made.kind != CellKind::number || !(made.number > 0.0)) {
        return;
    }
    constexpr double k_same = 1e-6;
    const double over = spread->s / made.number;  // what the formula divides by
    const bool by_n = is_about(over, 1.0, k_same) || is_about(over, std::sqrt(spread->n), k_same);
    // Without a column of divisors the row divides by what its u is smaller by; two readings need no divisor.
    const bool is_divided = !at.is.divisor && at.is.stated && at.is.used_u > 0.0;
    const double divisor = at.is.divisor ? at.is.divisor->value
                           : is_divided  ? std::abs(at.is.stated->value) / at.is.used_u
                                         : 1.0;
    const bool is_put_right = is_about(over, 1.0, k_same) && is_about(divisor, std::sqrt(spread->n - 1.0), 1e-3);
    if (!by_n || is_put_right) {
        return;
    }
    AuditFinding finding = finding_at(
        at, number->place,
        say("the deviations of {count:number} readings from their own mean are divided by n, and not by n − 1",
            text::shortest(spread->n)));
    finding.evidence = {say_number(text_of(view, *maker)), equals("n", text::shortest(spread->n))};
    finding.expected = say("STDEV.S, which divides by n − 1");
    finding.actual = say("STDEV.P, which divides by n");
    finding.correct = scale_u(at.row, std::sqrt(spread->n / (spread->n - 1.0)));
    findings.add(std::move(finding));
}

/// Whether a node of a formula is a standard deviation of readings: a function of them, or a cell with one or called so.
bool is_deviation(const WorksheetView& view, const SheetFormula& formula, const FormulaNode& node) {
    // Of itself alone: STDEV(…)/SQRT(n) is that of the mean.
    const auto is_function = [](const FormulaNode& of) { return is_call(of, {"STDEV", "STDEV.S", "STDEVA"}); };
    const std::optional<CellPlace> cell = view.cell_of(formula, node);
    if (!cell) {
        return is_function(node);
    }
    const SheetFormula* of_cell = view.formula_at(*cell);
    const std::string label = " " + view.label(*cell);  // "s of" is a word, and no end of "readings of"
    return (of_cell != nullptr && is_function(of_cell->formula.nodes[of_cell->formula.root()])) ||
           (of_cell == nullptr && !says(label, {"mean", "mittel", "average"}) &&
            says(label, {"standard deviation", "standardabweichung", "stdev", "std dev", " s of "}));
}

/// Whether words have a number twice, once of pieces, as those of a row that has n readings of n pieces together: "stack of 10
/// sheets, 10 readings".
bool counts_pieces(const std::string& words, const std::string& number) {
    constexpr std::string_view k_of_numbers = "0123456789.,";
    constexpr std::array k_pieces = {"sheet", "layer", "swing",   "period", "oscillation", "turn",   "revolution",
                                     "piece", "blatt", "blätter", "lage",   "schwing",     "umdreh", "stück"};
    std::size_t times = 0;
    bool of_pieces = false;
    for (std::size_t at = words.find(number); at != std::string::npos; at = words.find(number, at + number.size())) {
        const std::size_t end = at + number.size();
        const bool begins = at == 0 || k_of_numbers.find(words[at - 1]) == std::string_view::npos;
        const bool ends = end == words.size() || words[end] < '0' || words[end] > '9';
        if (begins && ends) {
            ++times;
            // Directly behind the number: "Anlage 5", "return after 5 min" and "Workpiece 5" count nothing.
            const std::string behind = text::in_small_letters(words.substr(end));
            of_pieces = of_pieces || std::any_of(k_pieces.begin(), k_pieces.end(), [&behind](const char* piece) {
                            return behind.starts_with(" " + std::string(piece));
                        });
        }
    }
    return times > 1 && of_pieces;
}

/// A standard deviation of readings over something, as one formula that makes u of a row.
struct DividedDeviation {
    const SheetFormula* maker = nullptr;
    const FormulaNode* spread = nullptr;
    const FormulaNode* by = nullptr;
};

/// Nothing where u is stated or 0, or made in another way.
std::optional<DividedDeviation> divided_deviation(const WorksheetView& view, const RowAt& at) {
    const SheetFormula* maker = at.is.u && !at.is.stated ? view.maker_of(at.is.u->place) : nullptr;
    if (maker == nullptr || !(at.is.used_u > 0.0)) {
        return std::nullopt;
    }
    const FormulaNode& quotient = maker->formula.nodes[maker->formula.root()];
    if (quotient.kind != FormulaNodeKind::divide || quotient.children != 2) {
        return std::nullopt;
    }
    const auto operands = maker->formula.children_of(quotient);
    const FormulaNode &spread = maker->formula.nodes[operands[0]], &by = maker->formula.nodes[operands[1]];
    return is_deviation(view, *maker, spread) ? std::optional(DividedDeviation{maker, &spread, &by}) : std::nullopt;
}

/// W04: s/n in place of s/√n, of a row that says how many readings there are.
void divided_by_n(const WorksheetView& view, const RowAt& at, FindingCollector& findings) {
    const std::optional<DividedDeviation> made = divided_deviation(view, at);
    if (!made) {
        return;
    }
    const SheetFormula* maker = made->maker;
    const FormulaNode& by = *made->by;
    const std::optional<CellPlace> cell = view.cell_of(*maker, by);
    const CellValue value = cell ? view.value(*cell) : CellValue{};
    const double n = by.kind == FormulaNodeKind::number ? by.number
                     : value.kind == CellKind::number   ? value.number
                                                        : 0.0;
    const bool is_count = (at.is.n && static_cast<double>(*at.is.n) == n) || at.is.used_nu + 1.0 == n;
    if (!(n >= 2.0) || !is_count) {
        return;
    }
    AuditFinding finding = finding_at(
        at, at.is.u->place,
        say("the standard deviation of {count:number} readings is divided by n, and not by √n", text::shortest(n)));
    finding.evidence = {say_number(text_of(view, *maker)), equals("n", text::shortest(n))};
    finding.expected = say("√{n:number}", text::shortest(n));
    finding.actual = say_number(text::shortest(n));
    if (counts_pieces(words_of_row(at.is), text::shortest(n))) {  // s of a stack is n times that of a sheet
        findings.add(std::move(finding), FindingSeverity::minor);
        return;
    }
    finding.correct = scale_u(at.row, std::sqrt(n));
    findings.add(std::move(finding));
}

/// What COUNT gives of an area, or COUNTA, which counts words as well; nothing of a large one.
std::optional<std::size_t> counted_in(const WorksheetView& view, const workbook::Area& area, bool with_words) {
    constexpr std::uint64_t k_most = 1000;
    const workbook::CellRange& range = area.range;
    const std::uint64_t rows = range.last.row - range.first.row + 1U,
                        columns = range.last.column - range.first.column + 1U;
    if (rows * columns > k_most) {
        return std::nullopt;
    }
    std::size_t numbers = 0;
    for (std::uint32_t row = range.first.row; row <= range.last.row; ++row) {
        for (std::uint32_t column = range.first.column; column <= range.last.column; ++column) {
            const CellValue value = view.value({.sheet = area.sheet, .address = {.row = row, .column = column}});
            const bool is_counted =
                value.kind == CellKind::number || (with_words && value.kind == CellKind::text && !value.text.empty());
            numbers += is_counted ? 1U : 0U;
        }
    }
    return numbers;
}

/// Areas of several cells that a formula reads, each once.
std::vector<workbook::Area> ranges_read(const WorksheetView& view, const CellPlace& cell) {
    std::vector<workbook::Area> ranges;
    for (const workbook::Area& area : view.areas_read(cell)) {
        const bool is_known = std::any_of(ranges.begin(), ranges.end(), [&area](const workbook::Area& other) {
            return other.sheet == area.sheet && other.range == area.range;
        });
        if (!is_known && !(area.range.first == area.range.last)) {
            ranges.push_back(area);
        }
    }
    return ranges;
}

/// Whether numbers of a range that are no cells of another one are all made by formulas. Typed ones may be readings: s may be that
/// of earlier readings, and the mean that of all (JCGM 100:2008, 4.2.4).
bool has_formulas_only_beyond(const WorksheetView& view, const workbook::Area& whole, const workbook::CellRange& part) {
    for (std::uint32_t row = whole.range.first.row; row <= whole.range.last.row; ++row) {
        for (std::uint32_t column = whole.range.first.column; column <= whole.range.last.column; ++column) {
            const bool is_part = row >= part.first.row && row <= part.last.row && column >= part.first.column &&
                                 column <= part.last.column;
            const CellPlace place{.sheet = whole.sheet, .address = {.row = row, .column = column}};
            if (!is_part && view.value(place).kind == CellKind::number && view.formula_at(place) == nullptr) {
                return false;
            }
        }
    }
    return true;
}

/// W04 of a row whose u is s/√n in one formula: n counts a range that reaches beyond the readings, as over their mean and s below them.
void counted_beyond_readings(const WorksheetView& view, const RowAt& at, FindingCollector& findings) {
    const std::optional<DividedDeviation> made = divided_deviation(view, at);
    if (!made || !is_call(*made->by, {"SQRT"}) || made->by->children != 1) {
        return;
    }
    const SheetFormula* maker = made->maker;
    const FormulaNode &spread = *made->spread, &root = *made->by;
    const FormulaNode& count = maker->formula.nodes[maker->formula.children_of(root)[0]];
    const bool with_words = is_call(count, {"COUNTA"});
    if (!with_words && !is_call(count, {"COUNT"})) {
        return;
    }
    const std::optional<CellPlace> cell = view.cell_of(*maker, spread);
    std::vector<workbook::Area> of_formula = ranges_read(view, maker->cell),
                                of_spread = cell ? ranges_read(view, *cell) : std::vector<workbook::Area>();
    if (!cell && of_formula.size() == 2) {
        of_spread.push_back(of_formula.front());
        of_formula.erase(of_formula.begin());
    }
    if (of_formula.size() != 1 || of_spread.size() != 1) {
        return;
    }
    const workbook::Area &counted = of_formula.front(), &readings = of_spread.front();
    const workbook::CellRange &outer = counted.range, &inner = readings.range;
    const bool reaches_beyond = counted.sheet == readings.sheet && outer.first.row <= inner.first.row &&
                                outer.first.column <= inner.first.column && outer.last.row >= inner.last.row &&
                                outer.last.column >= inner.last.column;
    const std::optional<std::size_t> n = counted_in(view, counted, with_words),
                                     of_readings = counted_in(view, readings, false);
    if (!reaches_beyond || !n || !of_readings || *of_readings < 2 || *n <= *of_readings ||
        !has_formulas_only_beyond(view, counted, inner)) {
        return;
    }
    const auto used = static_cast<double>(*n), right = static_cast<double>(*of_readings);
    const ReadingsRange range{
        .numbers = *of_readings, .cells = *of_readings, .runs = {}, .area = workbook::a1_text(inner)};
    AuditFinding finding =
        finding_at(at, at.is.u->place,
                   say("√{n:number} divides a standard deviation of {area}, which has {numbers} in {cells}",
                       text::shortest(used), range.area, numbers_in_words(range), cells_in_words(range)));
    finding.expected = say("√{n:number}", text::shortest(right));
    finding.actual = say("√{n:number}", text::shortest(used));
    finding.evidence = {say_number(text_of(view, *maker))};
    finding.correct = scale_u(at.row, std::sqrt(used / right));
    findings.add(std::move(finding));
}

void count_of_readings(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ReadCells cells(*view);
    std::vector<workbook::UntakenPlaces> told;
    for (const workbook::SheetIndex& index : view->indexes()) {
        told.emplace_back(index.places().size());
    }
    for (const SheetFormula& formula : view->formulas()) {
        if (!is_over_readings(formula.formula)) {
            continue;
        }
        const ReadingsRange range = readings_of(*view, cells, formula);
        if (range.numbers < 2) {
            continue;
        }
        for (const CellRun& run : range.runs) {
            tell_texts(*view, cells, formula, range, run, told[run.sheet], findings);
        }
    }
    for_each_row(subject, [&](const RowAt& at) {
        const SheetFormula* stated = view->formula_at(place_of(at.is.stated));
        const SheetFormula* divisor = view->formula_at(place_of(at.is.divisor));
        if (stated == nullptr || divisor == nullptr) {
            return;
        }
        const std::optional<double> n = rooted_number(*view, *divisor);
        // The cell itself, or the one that it passes on.
        const SheetFormula* spread = stated;
        const std::optional<CellPlace> passed_on = view->only_cell_read(stated->cell);
        if (!is_over_readings(spread->formula) && passed_on) {
            spread = view->formula_at(*passed_on);
        }
        if (!n || spread == nullptr || !is_over_readings(spread->formula)) {
            return;
        }
        const ReadingsRange range = readings_of(*view, cells, *spread);
        const auto numbers = static_cast<double>(range.numbers);
        if (range.numbers < 2 || (*n == numbers && range.cells == range.numbers)) {
            return;
        }
        AuditFinding finding =
            finding_at(at, at.is.divisor->place,
                       say("√{n:number} divides a standard deviation of {area}, which has {numbers} in {cells}",
                           text::shortest(*n), range.area, numbers_in_words(range), cells_in_words(range)));
        finding.expected = say("√{n:number}", text::shortest(numbers));
        finding.actual = say("√{n:number}", text::shortest(*n));
        finding.evidence = {say("n of the divisor: {n:number}", text::shortest(*n)),
                            say("numbers in the range: {count:number}", text::shortest(numbers)),
                            say("cells of the range: {count:number}", std::to_string(range.cells))};
        finding.correct = both(scale_u(at.row, std::sqrt(*n / numbers)), set_degrees_of_freedom(at.row, numbers - 1.0));
        findings.add(std::move(finding));
    });
    for_each_row(subject, [&](const RowAt& at) {
        deviation_by_n(*view, at, findings);
        divided_by_n(*view, at, findings);
        counted_beyond_readings(*view, at, findings);
    });
    tell_limit(cells, findings);
}

// W06 -----------------------------------------------------------------------------------------------------------------

/// A run of cells one below the other that pass on single cells of one column.
struct CopiedRun {
    std::vector<const SheetFormula*> formulas;
    std::vector<CellPlace> read;
};

std::vector<CopiedRun> copied_runs(const WorksheetView& view) {
    std::map<std::pair<std::size_t, std::uint32_t>, std::map<std::uint32_t, const SheetFormula*>> columns;
    for (const SheetFormula& formula : view.formulas()) {
        if (formula.formula.nodes.size() == 1 && view.cell_of(formula, formula.formula.nodes[0])) {
            columns[{formula.cell.sheet, formula.cell.address.column}][formula.cell.address.row] = &formula;
        }
    }
    std::vector<CopiedRun> runs;
    for (const auto& [column, formulas] : columns) {
        CopiedRun run;
        std::uint32_t last_row = 0;
        const auto close = [&] {
            // Of two cells nobody can tell whether they are copies of one column.
            if (run.formulas.size() >= 3) {
                runs.push_back(run);
            }
            run = {};
        };
        for (const auto& [row, formula] : formulas) {
            const CellPlace read = *view.cell_of(*formula, formula->formula.nodes[0]);
            const bool goes_on = !run.read.empty() && row == last_row + 1 && read.sheet == run.read.front().sheet &&
                                 read.address.column == run.read.front().address.column;
            if (!goes_on) {
                close();
            }
            run.formulas.push_back(formula);
            run.read.push_back(read);
            last_row = row;
        }
        close();
    }
    return runs;
}

/// \param never_read  so many cells are read by no copy
Sentence second_reading(const std::string& cell, std::size_t count, const Sentence& never_read) {
    if (count == 0) {
        return say("reads {cell} a second time", cell);
    }
    return count == 1 ? say("reads {cell} a second time, and {cells} is never read", cell, never_read)
                      : say("reads {cell} a second time, and {cells} are never read", cell, never_read);
}

void reading_read_twice(const AuditSubject& subject, FindingCollector& findings) {
    constexpr std::size_t k_most_named = 6;
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for (const CopiedRun& run : copied_runs(*view)) {
        const std::set<CellPlace> read(run.read.begin(), run.read.end());
        if (read.size() == run.read.size()) {
            continue;
        }
        std::vector<std::string> missing;
        CellPlace expected = *read.begin();
        for (std::size_t i = 0; i < run.read.size(); ++i, ++expected.address.row) {
            if (!read.contains(expected) && view->value(expected).kind == CellKind::number) {
                missing.push_back(view->place(expected));
            }
        }
        const Sentence never_read = listed(sentences_of(missing), k_most_named);
        const Sentence column = say("column of copies {first} to {last}", view->place(run.formulas.front()->cell),
                                    view->place(run.formulas.back()->cell));
        std::set<CellPlace> seen;
        for (std::size_t i = 0; i < run.read.size(); ++i) {
            if (seen.insert(run.read[i]).second) {
                continue;
            }
            AuditFinding finding = finding_in(view->place(run.formulas[i]->cell),
                                              second_reading(view->place(run.read[i]), missing.size(), never_read));
            finding.evidence = {column};
            finding.kind = column.english() + finding.what.english();
            findings.add(std::move(finding));
        }
    }
}

}  // namespace

std::vector<Rule> worksheet_reading_rules() {
    return {
        {.id = "W04",
         .title = "Numbers of readings differ",
         .clause = {.text = "JCGM 100:2008, 4.2.3", .verified = true},
         .needs = {Need::workbook},
         .detection = "text among readings; n of the divisor is not the number of readings in the range; STDEV.P of "
                      "readings about their own mean, unless √(n − 1) divides it; s/n of n readings, asked where these "
                      "are of n pieces together",
         .correction = "Correct the reading, and divide by the root of the number of readings that count.",
         .question = "How many readings were taken, and which of them count?",
         .examine = count_of_readings},
        {.id = "W06",
         .title = "A reading is read twice, another never",
         .clause = {.text = "ISO/IEC 17025:2017, 7.11.6", .verified = true},
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::workbook},
         .detection = "a column of copies of readings reads one cell twice",
         .correction = "Copy each reading once.",
         .question = "Which readings belong to the result?",
         .examine = reading_read_twice},
    };
}

}  // namespace gumcert::audit
