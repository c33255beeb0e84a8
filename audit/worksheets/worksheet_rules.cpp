#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/worksheets/cell_findings.h"
#include "audit/worksheets/read_cells.h"
#include "audit/worksheets/worksheet_rules.h"
#include "audit/worksheets/worksheet_view.h"
#include "workbook/formula_text.h"

namespace gumcert::audit {
namespace {

using workbook::CellKind;
using workbook::CellPlace;
using workbook::CellValue;
using workbook::FormulaNode;
using workbook::FormulaNodeKind;

constexpr Clause k_data_control{.text = "ISO/IEC 17025:2017, 7.11.2", .verified = true};
constexpr Clause k_data_transfer{.text = "ISO/IEC 17025:2017, 7.11.6", .verified = true};
constexpr Clause k_evaluation{.text = "ISO/IEC 17025:2017, 7.6", .verified = true};

// W03 -----------------------------------------------------------------------------------------------------------------

void volatile_function(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for (const SheetFormula& formula : view->formulas()) {
        // Elsewhere the day of today does no harm: a date of printing, the days left to a calibration.
        if (view->stands_under_results(formula.cell) &&
            calls_one_of(formula.formula, {"NOW", "TODAY", "RAND", "RANDBETWEEN"})) {
            AuditFinding finding =
                finding_in(view->place(formula.cell),
                           say("U rests on a function that gives another value each time the file is opened"));
            finding.evidence = {text_of(*view, formula)};
            findings.add(std::move(finding));
        }
    }
}

// W09 -----------------------------------------------------------------------------------------------------------------

void component_left_out(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (at.is.in_sum || !at.of.claims.u_c) {
            return;
        }
        AuditFinding finding = finding_at(
            at, place_of(at.is.contribution),
            say("the combined uncertainty in {place} leaves this contribution out", at.of.claims.u_c->place));
        finding.evidence = {
            equals(say("contribution"), in_words(std::abs(at.is.used_sensitivity) * at.is.used_u, at.of.unit))};
        finding.correct = put_in(at.row);
        findings.add(std::move(finding));
    });
}

// W10 -----------------------------------------------------------------------------------------------------------------

void choice_over_text(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ReadCells cells(*view);
    for (const SheetFormula& formula : view->formulas()) {
        const FormulaNode& root = formula.formula.nodes[formula.formula.root()];
        if (!is_call(root, {"MAX", "MIN"})) {
            continue;
        }
        const std::vector<CellRun> runs = cells.runs(formula.cell);
        std::size_t numbers = 0;
        Sentence where;
        for (const CellRun& run : runs) {
            numbers += cells.numbers(run);
            if (const std::optional<std::uint32_t> at = cells.text(run); at && where.empty()) {
                const CellPlace text = cells.cell(run.sheet, *at);
                where = say("{cell} = \"{text}\"", view->place(text), view->value(text).text);
            }
        }
        // One number is left to choose from: the other one, the floor, is no number.
        if (numbers != 1) {
            continue;
        }
        for (const workbook::Area& area : view->areas_read(formula.cell)) {
            if (const std::optional<CellPlace> blank = where.empty() ? cells.blank(area) : std::nullopt) {
                where = say("{cell} is empty", view->place(*blank));
            }
        }
        if (where.empty()) {
            continue;
        }
        AuditFinding finding =
            finding_in(view->place(formula.cell),
                       say("{function} chooses between a number and {cell}, which it leaves out: the floor is gone",
                           root.text, where));
        finding.evidence = {where};
        findings.add(std::move(finding));
    }
    tell_limit(cells, findings);
}

// W11, W12 ------------------------------------------------------------------------------------------------------------

void value_of_another_workbook(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for (const SheetFormula& formula : view->formulas()) {
        const auto link =
            std::find_if(formula.formula.references.begin(), formula.formula.references.end(),
                         [](const workbook::Reference& reference) { return !reference.workbook.empty(); });
        if (link != formula.formula.references.end()) {
            AuditFinding finding = finding_in(
                view->place(formula.cell), say("the value comes from another workbook, [{workbook}]", link->workbook));
            finding.kind = finding.what.english();
            findings.add(std::move(finding));
        }
    }
}

/// The first cell of a sheet with something in it that stands in a hidden row or column, and under the results; nothing where there is none.
std::optional<CellPlace> hidden_under_results(const WorksheetView& view, std::size_t sheet) {
    const workbook::Sheet& of = view.workbook().sheets[sheet];
    const auto lies_in = [](const std::vector<workbook::Span>& spans, std::uint32_t at) {
        return std::any_of(spans.begin(), spans.end(),
                           [at](const workbook::Span& span) { return span.first <= at && at <= span.last; });
    };
    for (const workbook::Cell& cell : of.cells) {
        const CellPlace at{.sheet = sheet, .address = cell.address};
        if ((lies_in(of.hidden_rows, cell.address.row) || lies_in(of.hidden_columns, cell.address.column)) &&
            view.stands_under_results(at)) {
            return at;
        }
    }
    return std::nullopt;
}

Sentence error_in_words(bool hidden, bool under_results) {
    if (under_results) {
        return hidden ? say("an error value on a hidden sheet, and U rests on it")
                      : say("an error value, and U rests on it");
    }
    return hidden ? say("an error value on a hidden sheet; no result that we found rests on it")
                  : say("an error value; no result that we found rests on it");
}

void error_in_chain(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    // Where an error reaches a result, nothing is claimed.
    const bool any_broken = std::any_of(subject.budgets.begin(), subject.budgets.end(),
                                        [](const AuditedBudget& budget) { return budget.claims.broken.any(); });
    for (std::size_t s = 0; s < view->workbook().sheets.size(); ++s) {
        const workbook::Sheet& sheet = view->workbook().sheets[s];
        const bool hidden = sheet.state != workbook::SheetState::visible;
        for (const workbook::Cell& cell : sheet.cells) {
            const CellPlace at{.sheet = s, .address = cell.address};
            const CellValue value = view->value(at);
            const SheetFormula* formula = view->formula_at(at);
            const bool broken =
                value.kind == CellKind::error ||
                (formula != nullptr &&
                 std::any_of(formula->formula.nodes.begin(), formula->formula.nodes.end(),
                             [](const FormulaNode& node) { return node.kind == FormulaNodeKind::error; }));
            if (!broken) {
                continue;
            }
            const bool under_results = view->stands_under_results(at);
            AuditFinding finding = finding_in(view->place(at), error_in_words(hidden, under_results));
            finding.kind = finding.what.english();
            findings.add(std::move(finding),
                         any_broken && under_results ? FindingSeverity::critical : FindingSeverity::minor);
        }
        const bool used = std::any_of(sheet.cells.begin(), sheet.cells.end(), [&](const workbook::Cell& cell) {
            return view->stands_under_results({.sheet = s, .address = cell.address});
        });
        if (hidden && used) {
            findings.add(finding_in(sheet.name, say("U rests on a hidden sheet")));
        } else if (const std::optional<CellPlace> first = hidden_under_results(*view, s)) {
            findings.add(finding_in(view->place(*first), say("U rests on a hidden row or column")));
        }
    }
}

// W13 -----------------------------------------------------------------------------------------------------------------

bool is_rate_per_year(const std::string& label) {
    return says(label, {"per year", "je jahr", "/yr", "/year", "p.a.", "pro jahr", "/a", "/jahr", "annual"});
}

/// Whether a formula has days: a function of dates, or the difference of two cells that hold days of the last or this
/// century as spreadsheets count them.
bool counts_days(const WorksheetView& view, const SheetFormula& formula) {
    constexpr double k_first_day = 18'000.0, k_last_day = 80'000.0;  // 1949 to 2119
    if (calls_one_of(formula.formula, {"NOW", "TODAY", "DATEVALUE", "DATE", "DAYS"})) {
        return true;
    }
    const auto is_day = [&](const FormulaNode& node) {
        const std::optional<CellPlace> cell = view.cell_of(formula, node);
        const CellValue value = cell ? view.value(*cell) : CellValue{};
        return value.kind == CellKind::number && value.number >= k_first_day && value.number <= k_last_day;
    };
    return std::any_of(formula.formula.nodes.begin(), formula.formula.nodes.end(), [&](const FormulaNode& node) {
        if (node.kind != FormulaNodeKind::subtract || node.children != 2) {
            return false;
        }
        const auto operands = formula.formula.children_of(node);
        return is_day(formula.formula.nodes[operands[0]]) && is_day(formula.formula.nodes[operands[1]]);
    });
}

bool is_of_year(double days) {
    return days >= 360.0 && days <= 366.0;
}

/// Whether one of the cells that a formula reads holds a rate per year.
/// \param labels_left  how many labels may be looked at; none is left where that was not enough
bool reads_rate_per_year(const WorksheetView& view, ReadCells& cells, const SheetFormula& formula,
                         std::size_t& labels_left) {
    for (const CellRun& run : cells.runs(formula.cell)) {
        for (std::uint32_t at = run.begin; at < run.end && labels_left > 0; ++at, --labels_left) {
            if (is_rate_per_year(view.label(cells.cell(run.sheet, at)))) {
                return true;
            }
        }
    }
    return false;
}

void time_units(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ReadCells cells(*view);
    std::size_t labels_left = 1'000'000;
    std::map<std::string, std::pair<std::size_t, std::size_t>> row_of_place;  // budget and row
    for_each_row(subject, [&row_of_place](const RowAt& at) {
        for (const std::optional<StatedNumber>* number : {&at.is.stated, &at.is.u}) {
            if (*number) {
                row_of_place[(*number)->place] = {at.budget, at.row};
            }
        }
    });
    for (const SheetFormula& formula : view->formulas()) {
        if (!counts_days(*view, formula)) {
            continue;
        }
        const std::string place = view->place(formula.cell);
        const auto of_row = row_of_place.find(place);
        const auto says_rate = [&] {  // of the row itself, where the rate stands in the formula
            return of_row != row_of_place.end() &&
                   is_rate_per_year(text_of_row(subject.budgets[of_row->second.first].rows[of_row->second.second]));
        };
        const std::vector<workbook::FormulaLiteral> literals = workbook::literal_numbers(formula.formula);
        const auto divides = [&formula](const workbook::FormulaLiteral& literal) {
            return formula.formula.nodes[literal.parent].kind == FormulaNodeKind::divide && literal.argument == 1;
        };
        const bool closes = std::any_of(literals.begin(), literals.end(),
                                        [](const auto& literal) { return is_of_year(literal.number); });
        for (const workbook::FormulaLiteral& literal : literals) {
            if (closes || !divides(literal) ||
                !(says_rate() || reads_rate_per_year(*view, cells, formula, labels_left))) {
                continue;
            }
            AuditFinding finding = finding_in(
                place,
                say("a rate per year times days divided by {divisor}: the units of time do not close", literal.text));
            finding.expected = say("days/365");
            finding.actual = say("days/{divisor}", literal.text);
            finding.evidence = {text_of(*view, formula)};
            if (of_row != row_of_place.end()) {
                finding.budgets = {of_row->second.first};
                finding.correct = scale_u(of_row->second.second, literal.number / 365.0);
            }
            findings.add(std::move(finding));
            break;  // what else divides belongs to something else
        }
    }
    if (labels_left == 0) {
        findings.leave_unchecked(say("formulas with days read more cells than an audit looks at the labels of"));
    }
    tell_limit(cells, findings);
}

// W14 -----------------------------------------------------------------------------------------------------------------

/// The rows of the tables of a subject, as sheet and row, and the cells of their own numbers.
struct CellsOfTables {
    std::set<std::pair<std::size_t, std::uint32_t>> rows;
    std::set<CellPlace> numbers;
    /// Contributions of rows that a sum, which follows from all rows, takes from their other cells: √SUMPRODUCT(u²; c²).
    std::set<CellPlace> shown_alone;
};
CellsOfTables cells_of_tables(const WorksheetView& view, const AuditSubject& subject) {
    CellsOfTables cells;
    for_each_row(subject, [&](const RowAt& at) {
        if (const std::optional<CellPlace> cell = view.cell_at(at.is.place)) {
            cells.rows.emplace(cell->sheet, cell->address.row);
        }
        for (const std::optional<StatedNumber>* number : {&at.is.estimate, &at.is.stated, &at.is.divisor, &at.is.u,
                                                          &at.is.sensitivity, &at.is.contribution, &at.is.nu}) {
            if (const std::optional<CellPlace> cell = view.cell_at(place_of(*number))) {
                cells.numbers.insert(*cell);
            }
        }
        const std::optional<CellPlace> contribution = view.cell_at(place_of(at.is.contribution));
        const std::optional<CellPlace> u = view.cell_at(place_of(at.is.u)),
                                       stated = view.cell_at(place_of(at.is.stated));
        if (contribution && at.is.in_sum && at.of.u_c_over_rows == 1.0 &&
            ((u && view.stands_under_results(*u)) || (stated && view.stands_under_results(*stated)))) {
            cells.shown_alone.insert(*contribution);
        }
    });
    return cells;
}

/// Cells of u_c and U that a subject claims. What is made of the value or of k is no result of the rows.
std::set<CellPlace> cells_of_claims(const WorksheetView& view, const AuditSubject& subject) {
    std::set<CellPlace> cells;
    for (const AuditedBudget& budget : subject.budgets) {
        for (const std::optional<StatedNumber>* claim : {&budget.claims.u_c, &budget.claims.U}) {
            if (const std::optional<CellPlace> cell = view.cell_at(place_of(*claim))) {
                cells.insert(*cell);
            }
        }
    }
    return cells;
}

void computed_and_not_used(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    const std::set<CellPlace> claims = cells_of_claims(*view, subject);
    // What a page of results shows of U is made of U, and nobody has to read it.
    const auto shows_result = [&](const CellPlace& cell) {
        constexpr std::size_t k_most = 50;
        const std::vector<CellPlace> read = view->cells_read(cell, k_most);
        return std::any_of(read.begin(), read.end(), [&claims](const CellPlace& one) { return claims.contains(one); });
    };
    const std::vector<CellPlace> unread = view->unread_cells();
    const CellsOfTables tables = cells_of_tables(*view, subject);
    for (const SheetFormula& formula : view->formulas()) {
        const bool visible = view->workbook().sheets[formula.cell.sheet].state == workbook::SheetState::visible;
        if (!visible || view->stands_under_results(formula.cell) || tables.shown_alone.contains(formula.cell) ||
            !std::binary_search(unread.begin(), unread.end(), formula.cell)) {
            continue;
        }
        const std::string label = view->label(formula.cell);
        // In a row of a budget, what is no number of the row is of another column, and only its head says of what: a share
        // of the variance belongs to the drift, and is none.
        const bool is_beside = tables.rows.contains({formula.cell.sheet, formula.cell.address.row}) &&
                               !tables.numbers.contains(formula.cell);
        // Many cells are read by nobody, notes and checks for instance. Only these words tell that something is missing
        // in the result.
        if (is_beside ? says(view->head(formula.cell),
                             {"correction", "korrektion", "korrektur", "drift", "deviation", "abweichung"})
                      : says(label, {"correction", "korrektion", "korrektur", "drift", "deviation", "abweichung",
                                     "uncertainty", "unsicherheit"})) {
            const bool is_of_result = !is_beside && !says(label, {"correction", "korrektion", "korrektur", "drift",
                                                                  "deviation", "abweichung"});
            if (is_of_result && shows_result(formula.cell)) {
                continue;
            }
            AuditFinding finding =
                finding_in(view->place(formula.cell), say("computed, and never used: \"{label}\"", label));
            finding.kind = finding.what.english();
            findings.add(std::move(finding));
        }
    }
}

// W16 -----------------------------------------------------------------------------------------------------------------

void not_protected(const AuditSubject& subject, FindingCollector& findings) {
    const workbook::Workbook& workbook = subject.workbook->workbook;
    const bool any = workbook.metadata.structure_is_protected ||
                     std::any_of(workbook.sheets.begin(), workbook.sheets.end(),
                                 [](const workbook::Sheet& sheet) { return sheet.is_protected; });
    if (!any) {
        findings.add(finding_in(
            subject.name, say("no sheet is protected, and nothing says which version of the workbook was validated")));
    }
}

}  // namespace

std::vector<Rule> worksheet_rules() {
    std::vector<Rule> rules = {
        {.id = "W03",
         .title = "Volatile function under U",
         .clause = k_data_control,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::workbook},
         .detection = "NOW, TODAY, RAND or RANDBETWEEN in a cell on which a result stands",
         .correction = "Type the date of the calibration into a cell, and compute with that.",
         .question = "For which day was the issued uncertainty computed, and how is it found again?",
         .examine = volatile_function},
        {.id = "W09",
         .title = "Component not in the sum",
         .clause = {.text = "JCGM 100:2008, 5.1.2", .verified = true},
         .needs = {Need::workbook},
         .detection = "the formula of u_c reads the contributions of other rows, and not this one",
         .correction = "Let the sum reach over all contributions.",
         .question = "Is the row left out on purpose, and why does it stand in the table?",
         .examine = component_left_out},
        {.id = "W10",
         .title = "MAX or MIN over text or nothing",
         .clause = k_data_control,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::workbook},
         .detection = "MAX or MIN over one number and cells with text or nothing",
         .correction = "Put the number that is meant into the cell, and let the formula fail where there is none.",
         .question = "Which floor should hold here, and since when has it been missing?",
         .examine = choice_over_text},
        {.id = "W11",
         .title = "Value of another workbook",
         .clause = k_data_transfer,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::workbook},
         .detection = "a formula names another workbook",
         .correction = "Bring the value into this workbook, with its source and version.",
         .question = "Which version of the other workbook was read, and who controls it?",
         .examine = value_of_another_workbook},
        {.id = "W12",
         .title = "Error value, or something hidden",
         .clause = k_data_control,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::minor,
         .needs = {Need::workbook},
         .detection = "#REF!, #VALUE! and their like, on any sheet, critical where a result is one; a hidden sheet, "
                      "row or column under a "
                      "result",
         .correction = "Repair or remove the cell; show what a result rests on.",
         .question = "What did the cell hold, and what still reads it?",
         .examine = error_in_chain},
        {.id = "W13",
         .title = "Units of time do not close",
         .clause = {.text = "JCGM 100:2008, 5.1.3", .verified = false},
         .needs = {Need::workbook},
         .detection =
             "a rate per year times days (of a function of dates, or a difference of two cells with dates), divided "
             "by something else than 365",
         .correction = "Divide days by 365.",
         .question = "Is the age of the calibration meant in days, months or years?",
         .examine = time_units},
        {.id = "W14",
         .title = "Computed and never used",
         .clause = k_evaluation,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::workbook},
         .detection = "a correction, drift or uncertainty that no formula reads and no result stands on",
         .correction = "Use it, or say why it does not count.",
         .question = "Was the correction meant to be applied?",
         .examine = computed_and_not_used},
        {.id = "W16",
         .title = "Workbook not protected",
         .clause = k_data_control,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::minor,
         .needs = {Need::workbook},
         .detection = "no sheet and no structure is protected",
         .correction = "Protect the cells with formulas, and note version and validation.",
         .question = "How is it made sure that the formulas are those that were validated?",
         .examine = not_protected},
        worksheet_address_rule(),
        stored_value_rule(),
    };
    for (std::vector<Rule> (*part)() : {worksheet_divisor_rules, worksheet_reading_rules, worksheet_standard_rules}) {
        std::vector<Rule> more = part();
        rules.insert(rules.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    }
    std::sort(rules.begin(), rules.end(), [](const Rule& a, const Rule& b) { return a.id < b.id; });
    return rules;
}

}  // namespace gumcert::audit
