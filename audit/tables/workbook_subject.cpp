#include "audit/tables/workbook_subject.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audit/audited_workbook.h"
#include "audit/budget_outcome.h"
#include "audit/claims.h"
#include "audit/tables/foreign_table.h"
#include "audit/words/named_statement.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {
namespace {

using workbook::CellPlace;

/// Marks the rows that the formula of u_c leaves out.
/// \param under  the cells on which u_c stands, in order
void mark_sum(AuditedBudget& budget, const AuditedWorkbook& held, const std::vector<CellPlace>& under) {
    const auto reached = [&](const AuditedRow& row) {
        for (const std::optional<StatedNumber>* number : {&row.contribution, &row.u, &row.stated}) {
            const std::optional<CellPlace> cell = *number ? held.cell_at((*number)->place) : std::nullopt;
            if (cell && std::binary_search(under.begin(), under.end(), *cell)) {
                return true;
            }
        }
        return false;
    };
    std::size_t in = 0;
    for (const AuditedRow& row : budget.rows) {
        in += reached(row) ? 1U : 0U;
    }
    if (in < 2 || in == budget.rows.size()) {
        return;
    }
    for (AuditedRow& row : budget.rows) {
        row.in_sum = reached(row);
    }
    note_unexplained(budget);
}

void mark_sums(std::vector<AuditedBudget>& budgets, const AuditedWorkbook& held) {
    std::vector<CellPlace> sums;
    std::vector<AuditedBudget*> of;
    for (AuditedBudget& budget : budgets) {
        const std::optional<StatedNumber>& u_c = budget.claims.u_c;
        if (const std::optional<CellPlace> cell = u_c ? held.cell_at(u_c->place) : std::nullopt) {
            sums.push_back(*cell);
            of.push_back(&budget);
        }
    }
    held.graph.each_closure(sums,
                            [&](std::size_t i, const std::vector<CellPlace>& under) { mark_sum(*of[i], held, under); });
}

/// The number of values of which the formula of a cell takes the standard deviation, "=STDEV(L3:L12)", directly or through
/// cells that only pass it on. Nothing where it reads anything else.
std::optional<std::size_t> values_of_deviation(const AuditedWorkbook& held, CellPlace cell) {
    constexpr int k_most_steps = 4;
    constexpr std::size_t k_most_values = 10'000;
    for (int step = 0; step < k_most_steps; ++step) {
        const SheetFormula* const formula = held.formula_at(cell);
        const std::vector<workbook::Area> read =
            formula != nullptr ? held.graph.areas_read(cell) : std::vector<workbook::Area>();
        const std::vector<CellPlace> values =
            read.empty() ? std::vector<CellPlace>() : held.graph.precedents(cell, k_most_values);
        const auto is_call = [](const workbook::FormulaNode& node) {
            return node.kind == workbook::FormulaNodeKind::call;
        };
        const std::vector<workbook::FormulaNode>* const nodes = formula != nullptr ? &formula->formula.nodes : nullptr;
        if (values.empty() || values.size() == k_most_values) {
            return std::nullopt;
        }
        if (nodes->size() == 1 && values.size() == 1) {
            cell = values.front();
            continue;
        }
        const bool is_deviation = std::any_of(nodes->begin(), nodes->end(), [&](const workbook::FormulaNode& node) {
            return is_call(node) && (node.text == "STDEV" || node.text == "STDEV.S");
        });
        const bool reads_once = std::all_of(read.begin(), read.end(), [&read](const workbook::Area& area) {
            return area.sheet == read.front().sheet && area.range == read.front().range;
        });
        const auto numbers = std::count_if(values.begin(), values.end(), [&held](const CellPlace& value) {
            const workbook::Cell* const stored = find_cell(held.workbook.sheets[value.sheet], value.address);
            return stored != nullptr && stored->value.kind == workbook::CellKind::number;
        });
        return is_deviation && reads_once && numbers > 1 ? std::optional(static_cast<std::size_t>(numbers))
                                                         : std::nullopt;
    }
    return std::nullopt;
}

/// The readings of Type A rows that say nothing of them, where their cell takes the standard deviation of some.
void count_readings(AuditedBudget& budget, const AuditedWorkbook& held) {
    for (AuditedRow& row : budget.rows) {
        if (!row.type_a.value_or(false) || row.nu || row.n || !row.readings.empty() || row.pooled_s) {
            continue;
        }
        for (const std::optional<StatedNumber>* number : {&row.stated, &row.u}) {
            const std::optional<CellPlace> cell = *number ? held.cell_at((*number)->place) : std::nullopt;
            row.n = row.n || !cell ? row.n : values_of_deviation(held, *cell);
        }
    }
}

/// The cell of k of a workbook, computed for other ν_eff than its own.
class FactorCell {
public:
    /// \param under  the cells on which k stands, with it
    FactorCell(const workbook::Workbook& of, std::span<const CellPlace> under, CellPlace nu, CellPlace k)
        : nu_(nu), k_(k), workbook_(of) {
        for (std::size_t i = 0; i < workbook_.sheets.size(); ++i) {
            std::erase_if(workbook_.sheets[i].cells, [&](const workbook::Cell& cell) {
                return !std::binary_search(under.begin(), under.end(), CellPlace{.sheet = i, .address = cell.address});
            });
        }
        for (workbook::Cell& cell : workbook_.sheets[nu.sheet].cells) {
            if (cell.address == nu.address) {
                cell.formula.clear();
                cell.formula_kind = workbook::FormulaKind::none;
            }
        }
    }

    [[nodiscard]] std::optional<double> at(double nu_eff) {
        constexpr double k_infinite = 1e9;  // spreadsheets know no infinity
        const double nu = std::min(nu_eff, k_infinite);
        const std::lock_guard lock(mutex_);
        if (const auto found = known_.find(nu); found != known_.end()) {
            return found->second;
        }
        for (workbook::Cell& cell : workbook_.sheets[nu_.sheet].cells) {
            if (cell.address == nu_.address) {
                cell.value = {.kind = workbook::CellKind::number, .number = nu, .text = ""};
            }
        }
        const workbook::Evaluation evaluation = workbook::evaluate_workbook(workbook_);
        const workbook::EvaluatedCell* k = workbook::find_evaluated(evaluation, workbook_, k_.sheet, k_.address);
        const bool is_number = k != nullptr && k->state == workbook::EvaluationState::evaluated &&
                               k->value.kind == workbook::CellKind::number && k->value.number > 0.0;
        return known_.emplace(nu, is_number ? std::optional(k->value.number) : std::nullopt).first->second;
    }

private:
    CellPlace nu_, k_;
    workbook::Workbook workbook_;
    std::map<double, std::optional<double>> known_;
    std::mutex mutex_;
};

/// Whether the cell of k gives what t_p(ν_eff) gives, ν_eff as it is or cut, as far as spreadsheets round it.
bool is_student_factor(FactorCell& cell, double probability) {
    constexpr double k_some_nu[] = {2.5, 4.2, 7.6, 15.5, 19.7, 30.6, 75.5, 300.5, 1e5};
    constexpr double k_two_decimals = 0.0051;
    for (const double p : {probability, 0.9545, 0.95}) {
        for (const bool truncate : {false, true}) {
            const CoverageRule rule{.kind = CoverageRule::Kind::student_t, .probability = p, .truncate = truncate};
            if (std::all_of(std::begin(k_some_nu), std::end(k_some_nu), [&](double nu) {
                    const std::optional<double> k = cell.at(nu);
                    return k && std::abs(*k - student_factors(rule, {nu, nu}).low) <= k_two_decimals;
                })) {
                return true;
            }
        }
    }
    return false;
}

/// Where the cell of k is no t_p(ν_eff), what it gives for another ν_eff is asked of itself.
void take_factor_of_sheet(AuditedBudget& budget, const AuditedWorkbook& held, const std::vector<CellPlace>& under) {
    constexpr std::size_t k_most_cells = 2000;  // a table of t is small
    const Claims& claims = budget.claims;
    const std::optional<CellPlace> nu = claims.nu_eff ? held.cell_at(claims.nu_eff->place) : std::nullopt,
                                   k = claims.k ? held.cell_at(claims.k->place) : std::nullopt;
    if (!nu || !k || *nu == *k || under.size() > k_most_cells || budget.k_over_rows != 1.0 ||
        budget.U_over_k_u_c != 1.0 || !std::binary_search(under.begin(), under.end(), *nu)) {
        return;
    }
    std::vector<CellPlace> cells = under;
    cells.insert(std::upper_bound(cells.begin(), cells.end(), *k), *k);
    const auto cell = std::make_shared<FactorCell>(held.workbook, cells, *nu, *k);
    try {
        constexpr double k_same = 1e-3;
        const std::optional<double> of_rows = cell->at(evaluate(budget).nu_eff);
        if (!of_rows || std::abs(*of_rows - claims.k->value) > k_same * claims.k->value ||
            (budget.coverage.kind == CoverageRule::Kind::student_t &&
             is_student_factor(*cell, budget.coverage.probability))) {
            return;
        }
    } catch (const gum::DiagnosedError&) {
        return;  // the budget gives no outcome
    }
    budget.coverage = {
        .kind = CoverageRule::Kind::fixed,
        .k = claims.k->value,
        .probability = budget.coverage.probability,
        .k_of_nu = std::make_shared<const FactorOfNu>([cell](double nu_eff) { return cell->at(nu_eff); })};
    note_claims_beyond_rows(budget);
}

/// The cell of k computes with ν_eff, or with the degrees of freedom of a row: then k is none of the numbers that stand for
/// all budgets, also where it shows one of them.
/// \param under  the cells on which k stands, in order
void mark_k_of_nu(AuditedBudget& budget, const AuditedWorkbook& held, const std::vector<CellPlace>& under) {
    const auto reads = [&](const std::optional<StatedNumber>& number) {
        const std::optional<CellPlace> cell = number ? held.cell_at(number->place) : std::nullopt;
        return cell && std::binary_search(under.begin(), under.end(), *cell);
    };
    budget.claims.k_follows_nu =
        reads(budget.claims.nu_eff) ||
        std::any_of(budget.rows.begin(), budget.rows.end(), [&reads](const AuditedRow& row) { return reads(row.nu); });
    if (!budget.claims.k_follows_nu) {
        return;
    }
    note_claims_beyond_rows(budget);
    take_factor_of_sheet(budget, held, under);
}

void mark_factors(std::vector<AuditedBudget>& budgets, const AuditedWorkbook& held) {
    std::vector<CellPlace> factors;
    std::vector<AuditedBudget*> of;
    for (AuditedBudget& budget : budgets) {
        const std::optional<StatedNumber>& k = budget.claims.k;
        if (const std::optional<CellPlace> cell = k ? held.cell_at(k->place) : std::nullopt) {
            factors.push_back(*cell);
            of.push_back(&budget);
        }
    }
    held.graph.each_closure(
        factors, [&](std::size_t i, const std::vector<CellPlace>& under) { mark_k_of_nu(*of[i], held, under); });
}

/// What the file shows is what it claims, also where its formulas give something else.
void take_shown_claims(AuditedBudget& budget, const AuditedWorkbook& held) {
    const ComputedClaims computed{.claims = budget.claims,
                                  .coverage = budget.coverage,
                                  .u_c_over_rows = budget.u_c_over_rows,
                                  .k_over_rows = budget.k_over_rows,
                                  .U_over_k_u_c = budget.U_over_k_u_c};
    Claims& claims = budget.claims;
    bool any = false;
    for (std::optional<StatedNumber>* claim : {&claims.value, &claims.u_c, &claims.nu_eff, &claims.k, &claims.U}) {
        const std::optional<CellPlace> cell = *claim ? held.cell_at((*claim)->place) : std::nullopt;
        if (const std::optional<double> shown = cell ? held.stale_number(*cell) : std::nullopt) {
            (*claim)->value = *shown;
            (*claim)->half_step = 0.0;  // that of what its formula gives
            any = true;
        }
    }
    if (any) {
        budget.computed_claims = computed;
        if (claims.k) {
            budget.coverage = {
                .kind = CoverageRule::Kind::fixed, .k = claims.k->value, .probability = budget.coverage.probability};
        }
        note_claims_beyond_rows(budget);
    }
}

/// What a cell shows is an error: by its formula, or as it is stored.
bool is_error(const AuditedWorkbook& held, std::size_t sheet, const workbook::Cell& cell) {
    const workbook::EvaluatedCell* computed =
        workbook::find_evaluated(held.evaluation, held.workbook, sheet, cell.address);
    const bool is_computed = computed != nullptr && computed->state != workbook::EvaluationState::not_evaluated;
    return (is_computed ? computed->value : cell.value).kind == workbook::CellKind::error;
}

/// Notes an error value where a row of a sheet names a result.
void take_broken_claim(AuditedBudget& budget, Statement statement, const std::string& place) {
    Claims& claims = budget.claims;
    const auto take = [&place](const std::optional<StatedNumber>& claim, std::string& broken) {
        if (!claim && broken.empty()) {
            broken = place;
        }
    };
    switch (statement) {
        case Statement::value:
            return take(claims.value, claims.broken.value);
        case Statement::u_c:
            return take(claims.u_c, claims.broken.u_c);
        case Statement::nu_eff:
            return take(claims.nu_eff, claims.broken.nu_eff);
        case Statement::k:
            return take(claims.k, claims.broken.k);
        case Statement::U:
        case Statement::reported_U:
            return take(claims.U, claims.broken.U);
        default:
            return;
    }
}

/// Rows that name a result and hold an error value belong to the table above them, else to the first of their sheet.
void take_broken_claims(std::vector<AuditedBudget>& budgets, const AuditedWorkbook& held) {
    std::map<std::size_t, std::map<std::uint32_t, AuditedBudget*>> tables;  // by sheet and row of the heads
    for (AuditedBudget& budget : budgets) {
        if (const std::optional<CellPlace> heads = held.cell_at(budget.place)) {
            tables[heads->sheet].emplace(heads->address.row, &budget);
        }
    }
    for (const auto& [sheet, of_sheet] : tables) {
        const workbook::Cell* first = nullptr;  // of its row
        for (const workbook::Cell& cell : held.workbook.sheets[sheet].cells) {
            first = first != nullptr && first->address.row == cell.address.row ? first : &cell;
            if (first == &cell || first->value.kind != workbook::CellKind::text || !is_error(held, sheet, cell)) {
                continue;
            }
            if (const std::optional<Statement> statement = statement_of(first->value.text)) {
                const auto below = of_sheet.upper_bound(cell.address.row);
                AuditedBudget& budget = *(below == of_sheet.begin() ? below : std::prev(below))->second;
                take_broken_claim(budget, *statement, held.place({.sheet = sheet, .address = cell.address}));
            }
        }
    }
}

}  // namespace

AuditSubject subject_of(workbook::Workbook workbook, const std::string& name) {
    AuditSubject subject;
    subject.name = name;
    auto held = std::make_shared<const AuditedWorkbook>(std::move(workbook));
    ForeignTables tables = budgets_in(held->workbook, held->evaluation, name);
    subject.budgets = std::move(tables.budgets);
    subject.not_read = std::move(tables.not_read);
    subject.kind = AuditSubject::Kind::table;
    if (!held->evaluation.cells.empty()) {
        subject.kind = AuditSubject::Kind::workbook;
        mark_sums(subject.budgets, *held);
        mark_factors(subject.budgets, *held);
        for (AuditedBudget& budget : subject.budgets) {
            count_readings(budget, *held);
        }
        for (AuditedBudget& budget : subject.budgets) {
            take_shown_claims(budget, *held);
        }
        take_broken_claims(subject.budgets, *held);
        for (const workbook::NotEvaluated& reason : held->evaluation.reasons) {
            const workbook::Sheet& sheet = held->workbook.sheets[reason.sheet];
            const std::string cell = workbook::sheet_a1(sheet.name, sheet.cells[reason.cell].address);
            const bool names_function = reason.what.find(' ') == std::string::npos;
            subject.not_read.push_back(
                names_function
                    ? say("{cell}: not evaluated here ({function}); the value that the file stored is taken", cell,
                          reason.what)
                    : say("{cell}: not evaluated here ({reason:sentence}); the value that the file stored is taken",
                          cell, reason.what));
        }
        subject.workbook = std::move(held);
    }
    for (const AuditedBudget& budget : subject.budgets) {
        if (!budget.claims.U && budget.claims.broken.U.empty()) {
            subject.not_read.push_back(
                say("{table}: no U was read; what stands as claimed U is what the rows give", budget.place));
        }
    }
    return subject;
}

}  // namespace gumcert::audit
