#include "workbook/evaluate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "text/counts.h"
#include "text/utf8.h"
#include "workbook/formula.h"
#include "workbook/limits.h"
#include "workbook/operand.h"
#include "workbook/sheet_index.h"

namespace gumcert::workbook {

namespace {

constexpr std::size_t k_most_elements = 500'000;      ///< of an array
constexpr std::size_t k_formulas_kept_open = 10'000;  ///< of cells that wait for others
/// A sum whose terms are this many times larger is rounding.
constexpr double k_all_rounding = 0x1p-49;

constexpr std::string_view k_circular = "a circular reference";

struct TooMuchWork {};

using FunctionTable = std::unordered_map<std::string_view, const SheetFunction*>;

const FunctionTable& function_table() {
    static const FunctionTable k_table = [] {
        FunctionTable table;
        for (const auto functions : {mathematical_functions(), statistical_functions(), distribution_functions(),
                                     lookup_functions(), logical_functions()}) {
            for (const SheetFunction& one : functions) {
                table.emplace(one.name, &one);
            }
        }
        return table;
    }();
    return k_table;
}

/// Functions that look at some of their arguments only.
bool is_choice(std::string_view name) {
    return name == "IF" || name == "IFERROR" || name == "IFNA" || name == "CHOOSE";
}

bool is_volatile(std::string_view name) {
    return name == "NOW" || name == "TODAY" || name == "RAND" || name == "RANDBETWEEN";
}

enum class NodeState : std::uint8_t { unseen, open, done };

/// A cell with a formula, or a defined name, that waits for what it reads.
struct Waiting {
    std::uint32_t node = 0;
    std::uint32_t asked_by = 0;  ///< the cell that needs it, which is itself for a cell
    std::optional<Formula> formula{};
    bool is_unreadable = false;
    std::uint32_t at = 0;  ///< nodes of the formula that were looked through
    std::optional<AreaCursor> cursor{};
    std::size_t lowest =
        0;  ///< the lowest place on the stack that it reads, directly or not; its own where there is none
    bool is_circular = false;
};

class Evaluator final : public CellReader {
public:
    Evaluator(const Workbook& workbook, const EvaluationOptions& options)
        : workbook_(workbook), options_(options), names_(workbook) {
        indexes_.reserve(workbook.sheets.size());
        for (std::size_t sheet = 0; sheet < workbook.sheets.size(); ++sheet) {
            const Sheet& one = workbook.sheets[sheet];
            indexes_.emplace_back(one);
            auto& nodes = nodes_.emplace_back(one.cells.size(), k_no_place);
            for (std::size_t cell = 0; cell < one.cells.size(); ++cell) {
                if (!one.cells[cell].formula.empty()) {
                    nodes[cell] = static_cast<std::uint32_t>(result_.cells.size());
                    result_.cells.push_back({.sheet = sheet, .cell = cell});
                }
            }
            UntakenPlaces& unfinished = unfinished_.emplace_back(one.cells.size());
            positions_.resize(result_.cells.size());
            for (std::uint32_t at = 0; at < one.cells.size(); ++at) {
                const std::uint32_t node = nodes[indexes_[sheet].places()[at]];
                if (node == k_no_place) {
                    unfinished.take(at);
                } else {
                    positions_[node] = at;
                }
            }
            std::vector<CellAddress>& arrays = array_cells_.emplace_back();
            for (const CellRange& range : one.array_ranges) {
                arrays.push_back(range.first);
            }
            std::sort(arrays.begin(), arrays.end());
        }
        states_.assign(result_.cells.size() + workbook.defined_names.size(), NodeState::unseen);
        on_stack_.assign(states_.size(), 0);
        name_values_.resize(workbook.defined_names.size());
        name_is_volatile_.assign(workbook.defined_names.size(), false);
    }

    Evaluation evaluate() {
        const auto count = static_cast<std::uint32_t>(result_.cells.size());
        for (std::uint32_t node = 0; node < count; ++node) {
            if (states_[node] == NodeState::unseen) {
                compute_with_precedents(node);
            }
        }
        return std::move(result_);
    }

    Operand cell(std::size_t sheet, const CellAddress& address) override {
        const Cell* const found = find_cell(workbook_.sheets[sheet], address);
        return found == nullptr
                   ? Operand()
                   : value_of(sheet, static_cast<std::uint32_t>(found - workbook_.sheets[sheet].cells.data()));
    }

    void each_cell(const Area& area, const std::function<bool(const Operand&)>& tell) override {
        AreaCursor cursor(indexes_[area.sheet], area.range);
        for (std::uint32_t place = cursor.next(); place != k_no_place; place = cursor.next()) {
            spend(cursor.take_steps());
            if (!tell(value_of(area.sheet, place))) {
                return;
            }
        }
        spend(cursor.take_steps());
    }

    Operand values(const Operand& operand) override {
        if (operand.kind == OperandKind::array || operand.stops()) {
            return operand;
        }
        auto array = std::make_shared<OperandArray>();
        if (operand.kind != OperandKind::area) {
            array->items.push_back(operand.kind == OperandKind::missing ? Operand() : operand);
            return of_array(std::move(array));
        }
        const CellRange& range = operand.area.range;
        const CellAddress used = indexes_[operand.area.sheet].last_used();
        array->rows = range.last.row - range.first.row + 1;
        array->columns = range.last.column - range.first.column + 1;
        array->stored_rows =
            used.row < range.first.row ? 0 : std::min<std::size_t>(array->rows, used.row - range.first.row + 1);
        array->stored_columns = used.column < range.first.column
                                    ? 0
                                    : std::min<std::size_t>(array->columns, used.column - range.first.column + 1);
        const std::size_t stored = array->stored_rows * array->stored_columns;
        if (stored > k_most_elements) {
            return not_evaluated("a range of more than 500000 cells");
        }
        spend(stored);
        array->items.resize(stored);
        AreaCursor cursor(indexes_[operand.area.sheet], range);
        for (std::uint32_t place = cursor.next(); place != k_no_place; place = cursor.next()) {
            const CellAddress address = workbook_.sheets[operand.area.sheet].cells[place].address;
            array->items[(address.row - range.first.row) * array->stored_columns +
                         (address.column - range.first.column)] = value_of(operand.area.sheet, place);
        }
        spend(cursor.take_steps());
        return of_array(std::move(array));
    }

    Operand single(const Operand& operand) override {
        if (operand.kind == OperandKind::array) {
            return operand.array->at(0, 0);
        }
        if (operand.kind != OperandKind::area) {
            return operand;
        }
        const CellRange& range = operand.area.range;
        if (range.first == range.last || is_array_) {
            return cell(operand.area.sheet, range.first);
        }
        if (has_address_ && range.first.column == range.last.column && address_.row >= range.first.row &&
            address_.row <= range.last.row) {
            return cell(operand.area.sheet, {address_.row, range.first.column});
        }
        if (has_address_ && range.first.row == range.last.row && address_.column >= range.first.column &&
            address_.column <= range.last.column) {
            return cell(operand.area.sheet, {range.first.row, address_.column});
        }
        return Operand::of(CellError::value);
    }

    [[nodiscard]] CellAddress last_used(std::size_t sheet) const override { return indexes_[sheet].last_used(); }

    Operand not_evaluated(const std::string& what) override {
        Operand operand;
        operand.kind = OperandKind::not_evaluated;
        operand.reason = reason(what, asked_by_);
        return operand;
    }

    void spend(std::size_t steps) override {
        steps_ += steps;
        if (steps_ > options_.most_steps) {
            throw TooMuchWork();
        }
    }

    [[nodiscard]] bool dates_from_1904() const override { return workbook_.metadata.dates_from_1904; }

private:
    static Operand of_array(std::shared_ptr<const OperandArray> array) {
        Operand operand;
        operand.kind = OperandKind::array;
        operand.array = std::move(array);
        return operand;
    }

    [[nodiscard]] bool is_name(std::uint32_t node) const { return node >= result_.cells.size(); }
    [[nodiscard]] const Cell& cell_of(std::uint32_t node) const {
        return workbook_.sheets[result_.cells[node].sheet].cells[result_.cells[node].cell];
    }
    [[nodiscard]] const std::string& formula_of(std::uint32_t node) const {
        return is_name(node) ? workbook_.defined_names[node - result_.cells.size()].formula : cell_of(node).formula;
    }
    /// Of the formula of a node; k_no_place for a name of the whole workbook.
    [[nodiscard]] std::size_t sheet_of(std::uint32_t node) const {
        return is_name(node) ? workbook_.defined_names[node - result_.cells.size()].sheet.value_or(k_no_place)
                             : result_.cells[node].sheet;
    }

    /// The place of a reason; the same one for the same cell.
    std::uint32_t reason(std::string_view what, std::uint32_t of_cell) {
        const EvaluatedCell& origin = result_.cells[of_cell];
        if (result_.reasons.empty() || result_.reasons.back().what != what ||
            result_.reasons.back().sheet != origin.sheet || result_.reasons.back().cell != origin.cell) {
            result_.reasons.push_back({std::string(what), origin.sheet, origin.cell});
        }
        return static_cast<std::uint32_t>(result_.reasons.size() - 1);
    }

    // The order of evaluation: a stack of its own, because chains of cells are longer than that of the machine.

    void compute_with_precedents(std::uint32_t first) {
        try {
            spend(1);
            open(first, first);
            while (!stack_.empty()) {
                const std::uint32_t next = next_precedent(stack_.back());
                if (next == k_no_place) {
                    close();
                } else if (states_[next] == NodeState::open) {
                    stack_.back().lowest = std::min(stack_.back().lowest, on_stack_[next]);
                    stack_.back().is_circular = true;
                } else {
                    open(next, is_name(next) ? stack_.back().asked_by : next);
                }
            }
        } catch (const TooMuchWork&) {
            // Whatever is still to come ends here as well, at its first step.
            states_[first] = NodeState::unseen;
            for (const Waiting& one : stack_) {
                abandon(one);
            }
            stack_.clear();
            if (states_[first] == NodeState::unseen) {
                abandon({.node = first, .asked_by = first});
            }
        }
    }

    void finish(std::uint32_t node) {
        states_[node] = NodeState::done;
        if (!is_name(node)) {
            unfinished_[result_.cells[node].sheet].take(positions_[node]);
        }
    }

    void abandon(const Waiting& one) {
        finish(one.node);
        if (!abandoned_) {
            abandoned_ = reason("more work than a workbook is given", one.asked_by);
        }
        const std::uint32_t why = *abandoned_;
        if (is_name(one.node)) {
            Operand& value = name_values_[one.node - result_.cells.size()];
            value.kind = OperandKind::not_evaluated;
            value.reason = why;
        } else {
            set_not_evaluated(one.node, why);
        }
    }

    void open(std::uint32_t node, std::uint32_t asked_by) {
        if (stack_.size() >= k_formulas_kept_open) {
            stack_.back().formula.reset();
        }
        states_[node] = NodeState::open;
        on_stack_[node] = stack_.size();
        stack_.push_back({.node = node, .asked_by = asked_by, .lowest = stack_.size()});
    }

    void read_formula(Waiting& waiting) {
        if (waiting.formula || waiting.is_unreadable) {
            return;
        }
        const std::string& text = formula_of(waiting.node);
        spend(text.size() / 8);
        try {
            waiting.formula = parse_formula(text, "");
        } catch (const gum::InputError&) {
            waiting.is_unreadable = true;
        }
    }

    /// A formula cell or a name that a formula reads and that has no value yet; each is told once.
    std::uint32_t next_precedent(Waiting& waiting) {
        read_formula(waiting);
        if (!waiting.formula) {
            return k_no_place;
        }
        const Formula& formula = *waiting.formula;
        const std::size_t sheet = sheet_of(waiting.node);
        for (; waiting.at < formula.nodes.size(); ++waiting.at) {
            const FormulaNode& node = formula.nodes[waiting.at];
            if (node.kind == FormulaNodeKind::name) {
                const std::uint32_t name = names_.defined_name(node.text, sheet);
                if (name != k_no_place && states_[result_.cells.size() + name] != NodeState::done) {
                    ++waiting.at;
                    return static_cast<std::uint32_t>(result_.cells.size() + name);
                }
            }
            if (node.kind != FormulaNodeKind::reference) {
                continue;
            }
            const Reference& reference = formula.references[node.reference];
            const std::size_t on = referenced_sheet(reference, sheet);
            if (on == k_no_place) {
                continue;
            }
            if (!waiting.cursor) {
                waiting.cursor.emplace(indexes_[on], area(reference));
            }
            if (const std::uint32_t place = waiting.cursor->next(unfinished_[on]); place != k_no_place) {
                spend(waiting.cursor->take_steps());
                return nodes_[on][place];
            }
            spend(waiting.cursor->take_steps() + 1);
            waiting.cursor.reset();
        }
        return k_no_place;
    }

    /// The sheet of a reference; k_no_place where it is none of this workbook, or several.
    [[nodiscard]] std::size_t referenced_sheet(const Reference& reference, std::size_t on_sheet) const {
        if (!reference.workbook.empty() || !reference.last_sheet.empty()) {
            return k_no_place;
        }
        return reference.sheet.empty() ? on_sheet : names_.sheet(reference.sheet);
    }

    void close() {
        Waiting& waiting = stack_.back();
        const std::size_t place = stack_.size() - 1;
        compute(waiting);
        finish(waiting.node);
        const std::size_t lowest = waiting.lowest;
        stack_.pop_back();
        if (lowest < place) {
            stack_.back().lowest = std::min(stack_.back().lowest, lowest);
            stack_.back().is_circular = true;
        }
    }

    void set_not_evaluated(std::uint32_t node, std::uint32_t why) {
        EvaluatedCell& entry = result_.cells[node];
        entry.value = {};
        entry.state = EvaluationState::not_evaluated;
        entry.agreement = Agreement::not_compared;
        entry.reason = why;
    }

    void compute(Waiting& waiting) {
        asked_by_ = waiting.asked_by;
        sheet_ = sheet_of(waiting.node);
        has_address_ = !is_name(waiting.node);
        reads_volatile_ = false;
        std::string_view prevented;
        if (waiting.is_unreadable) {
            prevented = "a formula that is not understood";
        } else if (waiting.is_circular) {
            prevented = k_circular;
        }
        nothing_stored_ = false;
        if (!is_name(waiting.node)) {
            compute_cell(waiting, prevented);
            return;
        }
        Operand& value = name_values_[waiting.node - result_.cells.size()];
        const auto is_relative = [](const Reference& one) {
            return one.sheet.empty() || !one.first.row_is_absolute || !one.first.column_is_absolute ||
                   !one.last.row_is_absolute || !one.last.column_is_absolute;
        };
        if (prevented.empty() &&
            std::any_of(waiting.formula->references.begin(), waiting.formula->references.end(), is_relative)) {
            prevented = "a name that means another cell in each cell";
        }
        if (prevented.empty()) {
            is_array_ = true;
            formula_ = &*waiting.formula;
            value = evaluate(formula_->root(), false);
        } else {
            value = not_evaluated(std::string(prevented));
        }
        name_is_volatile_[waiting.node - result_.cells.size()] = reads_volatile_;
    }

    void compute_cell(Waiting& waiting, std::string_view prevented) {
        const Cell& cell = cell_of(waiting.node);
        address_ = cell.address;
        is_array_ = cell.formula_kind == FormulaKind::array;
        const std::vector<CellAddress>& arrays = array_cells_[result_.cells[waiting.node].sheet];
        if (prevented.empty() && cell.formula_kind == FormulaKind::data_table) {
            prevented = "a data table";
        } else if (prevented.empty() && is_array_ && std::binary_search(arrays.begin(), arrays.end(), address_)) {
            prevented = "an array formula over several cells";
        }
        if (!prevented.empty()) {
            set_not_evaluated(waiting.node, reason(prevented, asked_by_));
            return;
        }
        formula_ = &*waiting.formula;
        nothing_stored_ = cell.value.kind == CellKind::blank;
        const Operand value = single(evaluate(formula_->root(), true));
        EvaluatedCell& entry = result_.cells[waiting.node];
        if (value.kind == OperandKind::stands_for_all) {
            if (cell.value.kind == CellKind::blank) {
                set_not_evaluated(waiting.node, reason(value.text + ", which has no stored value", asked_by_));
            } else {
                entry.value = cell.value;
                entry.state = EvaluationState::volatile_value;
            }
            return;
        }
        if (value.kind == OperandKind::not_evaluated) {
            set_not_evaluated(waiting.node, value.reason);
            return;
        }
        entry.value = stored_form(value);
        entry.state = reads_volatile_ ? EvaluationState::volatile_value : EvaluationState::evaluated;
        entry.agreement = agreement(entry.value, cell.value);
    }

    CellValue stored_form(const Operand& value) {
        switch (value.kind) {
            case OperandKind::text:
                if (text::character_count(value.text) > k_longest_text) {
                    return {.kind = CellKind::error, .error = CellError::value};
                }
                spend(value.text.size() / 2);
                return {.kind = CellKind::text, .text = value.text};
            case OperandKind::boolean:
                return {.kind = CellKind::boolean, .number = value.number};
            case OperandKind::error:
                return {.kind = CellKind::error, .error = value.error};
            default:
                return {.kind = CellKind::number, .number = value.number};  // blank is 0
        }
    }

    [[nodiscard]] Agreement agreement(const CellValue& computed, const CellValue& stored) const {
        if (stored.kind == CellKind::blank) {
            return Agreement::nothing_stored;
        }
        bool agrees = computed.kind == stored.kind;
        if (agrees && computed.kind == CellKind::number) {
            agrees = std::abs(computed.number - stored.number) <=
                     options_.relative_tolerance * std::max(std::abs(computed.number), std::abs(stored.number));
        } else if (agrees && computed.kind == CellKind::text) {
            agrees = computed.text == stored.text;
        } else if (agrees) {
            agrees = computed.number == stored.number && computed.error == stored.error;
        }
        return agrees ? Agreement::agrees : Agreement::differs;
    }

    /// \param place  of a cell of the sheet
    Operand value_of(std::size_t sheet, std::uint32_t place) {
        const std::uint32_t node = nodes_[sheet][place];
        const CellValue* value = &workbook_.sheets[sheet].cells[place].value;
        if (node != k_no_place) {
            const EvaluatedCell& entry = result_.cells[node];
            if (states_[node] != NodeState::done) {
                return not_evaluated(std::string(k_circular));
            }
            if (entry.state == EvaluationState::not_evaluated) {
                Operand operand;
                operand.kind = OperandKind::not_evaluated;
                operand.reason = entry.reason;
                return operand;
            }
            reads_volatile_ = reads_volatile_ || entry.state == EvaluationState::volatile_value;
            value = &entry.value;
        }
        switch (value->kind) {
            case CellKind::number:
                return Operand::of(value->number);
            case CellKind::text:
                spend(value->text.size() / 64);
                return Operand::of(value->text);
            case CellKind::boolean:
                return Operand::of(value->number != 0.0);
            case CellKind::error:
                return Operand::of(value->error);
            case CellKind::blank:
                break;
        }
        return {};
    }

    // The value of a part of the formula that is computed.

    Operand evaluate(std::uint32_t place, bool is_root) {
        spend(1);
        const FormulaNode& node = formula_->nodes[place];
        if (is_binary(node.kind)) {
            return chain(place, is_root);
        }
        switch (node.kind) {
            case FormulaNodeKind::number:
                return Operand::of(node.number);
            case FormulaNodeKind::text:
                return Operand::of(node.text);
            case FormulaNodeKind::boolean:
                return Operand::of(node.number != 0.0);
            case FormulaNodeKind::error:
                return Operand::of(node.error);
            case FormulaNodeKind::missing: {
                Operand missing;
                missing.kind = OperandKind::missing;
                return missing;
            }
            case FormulaNodeKind::reference:
                return referenced(formula_->references[node.reference]);
            case FormulaNodeKind::name:
                return named(node.text);
            case FormulaNodeKind::structured:
                return not_evaluated("a reference to a table");
            case FormulaNodeKind::array:
                return constant_array(node);
            case FormulaNodeKind::call:
                return call(node);
            default:
                return with_sign(node);
        }
    }

    Operand referenced(const Reference& reference) {
        if (!reference.workbook.empty()) {
            return not_evaluated("another workbook");
        }
        if (!reference.last_sheet.empty()) {
            return not_evaluated("a reference over several sheets");
        }
        const std::size_t sheet = referenced_sheet(reference, sheet_);
        return sheet == k_no_place ? Operand::of(CellError::reference) : Operand::of(Area{sheet, area(reference)});
    }

    Operand named(const std::string& name) {
        if (name.find('[') != std::string::npos) {
            return not_evaluated("another workbook");
        }
        const std::uint32_t place = names_.defined_name(name, sheet_);
        if (place == k_no_place) {
            return Operand::of(CellError::name);
        }
        if (states_[result_.cells.size() + place] != NodeState::done) {
            return not_evaluated(std::string(k_circular));
        }
        reads_volatile_ = reads_volatile_ || name_is_volatile_[place];
        return name_values_[place];
    }

    Operand constant_array(const FormulaNode& node) {
        auto array = std::make_shared<OperandArray>();
        array->columns = array->stored_columns = node.columns;
        array->rows = array->stored_rows = node.children / node.columns;
        for (const std::uint32_t child : formula_->children_of(node)) {
            array->items.push_back(evaluate(child, false));
        }
        return of_array(std::move(array));
    }

    /// Signs from the inside: percent signs in a row are a deep tree, and take a loop in place of as many calls.
    Operand with_sign(const FormulaNode& outermost) {
        std::vector<FormulaNodeKind> signs{outermost.kind};
        std::uint32_t place = formula_->children_of(outermost)[0];
        while (is_sign(formula_->nodes[place].kind)) {
            spend(1);
            signs.push_back(formula_->nodes[place].kind);
            place = formula_->children_of(formula_->nodes[place])[0];
        }
        Operand operand = evaluate(place, false);
        for (std::size_t i = signs.size(); i-- > 0;) {
            const FormulaNodeKind kind = signs[i];
            operand = for_each_element(std::array{operand}, [&](std::span<const Operand> one) {
                if (kind == FormulaNodeKind::plus) {
                    return one[0];  // leaves a text as it is
                }
                const Operand number = as_number(one[0], *this);
                if (!number.is_number()) {
                    return number;
                }
                return Operand::of(kind == FormulaNodeKind::negate ? -number.number : number.number / 100.0);
            });
        }
        return operand;
    }

    /// Operators from the left: a long sum is a deep tree, and takes a loop in place of as many calls.
    Operand chain(std::uint32_t place, bool is_root) {
        std::vector<std::uint32_t> operators;
        while (is_binary(formula_->nodes[place].kind)) {
            operators.push_back(place);
            place = formula_->children_of(formula_->nodes[place])[0];
        }
        Operand left = evaluate(place, false);
        for (std::size_t i = operators.size(); i-- > 0;) {
            const FormulaNode& node = formula_->nodes[operators[i]];
            const Operand right = evaluate(formula_->children_of(node)[1], false);
            if (node.kind >= FormulaNodeKind::range) {
                left = not_evaluated("references put together");
                continue;
            }
            const bool is_last = is_root && i == 0;
            left = for_each_element(std::array{left, right}, [&](std::span<const Operand> both) {
                return joined(node.kind, both[0], both[1], is_last);
            });
        }
        return left;
    }

    Operand joined(FormulaNodeKind kind, const Operand& a, const Operand& b, bool is_last) {
        for (const OperandKind first : {OperandKind::not_evaluated, OperandKind::stands_for_all, OperandKind::error}) {
            for (const Operand* one : {&a, &b}) {
                if (one->kind == first) {
                    return *one;
                }
            }
        }
        if (kind == FormulaNodeKind::concatenate) {
            Operand text = as_text(a, *this);
            const Operand more = as_text(b, *this);
            if (text.stops() || more.stops()) {
                return text.stops() ? text : more;
            }
            spend(text.text.size() + more.text.size());
            text.text += more.text;
            return text.text.size() > 4 * k_longest_text ? Operand::of(CellError::value) : text;
        }
        if (kind >= FormulaNodeKind::equal && only_rounding_decides(a, b)) {
            return not_evaluated("a comparison that only rounding decides");
        }
        if (kind >= FormulaNodeKind::equal) {
            return Operand::of(holds(kind, compared(a, b)));
        }
        const Operand x = as_number(a, *this);
        const Operand y = as_number(b, *this);
        if (!x.is_number() || !y.is_number()) {
            return x.is_number() || (x.kind == OperandKind::error && y.kind == OperandKind::not_evaluated) ? y : x;
        }
        return arithmetic(kind, x.number, y.number, is_last);
    }

    static bool holds(FormulaNodeKind kind, int order) {
        switch (kind) {
            case FormulaNodeKind::equal:
                return order == 0;
            case FormulaNodeKind::not_equal:
                return order != 0;
            case FormulaNodeKind::less:
                return order < 0;
            case FormulaNodeKind::less_equal:
                return order <= 0;
            case FormulaNodeKind::greater:
                return order > 0;
            default:
                return order >= 0;
        }
    }

    static Operand arithmetic(FormulaNodeKind kind, double x, double y, bool is_last) {
        switch (kind) {
            case FormulaNodeKind::add:
            case FormulaNodeKind::subtract: {
                const double sum = kind == FormulaNodeKind::add ? x + y : x - y;
                const bool is_rounding =
                    is_last && std::abs(sum) <= k_all_rounding * std::max(std::abs(x), std::abs(y));
                return Operand::of(is_rounding ? 0.0 : sum);
            }
            case FormulaNodeKind::multiply:
                return Operand::of(x * y);
            case FormulaNodeKind::divide:
                return y == 0.0 ? Operand::of(CellError::division_by_zero) : Operand::of(x / y);
            default:
                return power_of(x, y);
        }
    }

    /// One value of each operand; or, where one of them has several, each of them, in rows and columns.
    template <typename Function>
    Operand for_each_element(std::span<const Operand> operands, const Function& function) {
        const bool is_several = std::any_of(operands.begin(), operands.end(), [&](const Operand& one) {
            return one.kind == OperandKind::array ||
                   (is_array_ && one.kind == OperandKind::area && one.area.range.first != one.area.range.last);
        });
        std::vector<Operand> arguments;
        if (!is_several) {
            for (const Operand& one : operands) {
                arguments.push_back(single(one));
            }
            return function(std::span<const Operand>(arguments));
        }
        std::vector<Operand> arrays;
        std::size_t rows = 1, columns = 1;
        for (const Operand& one : operands) {
            if (one.kind == OperandKind::not_evaluated || one.kind == OperandKind::stands_for_all) {
                return one;
            }
            if (one.kind == OperandKind::error) {
                auto array = std::make_shared<OperandArray>();
                array->items.push_back(one);
                arrays.push_back(of_array(std::move(array)));
            } else {
                arrays.push_back(values(one));
            }
            if (arrays.back().kind != OperandKind::array) {
                return arrays.back();
            }
            rows = std::max(rows, arrays.back().array->rows);
            columns = std::max(columns, arrays.back().array->columns);
        }
        if (rows * columns > k_most_elements) {
            return not_evaluated("arithmetic with a range of more than 500000 cells");
        }
        auto result = std::make_shared<OperandArray>();
        result->rows = result->stored_rows = rows;
        result->columns = result->stored_columns = columns;
        result->items.reserve(rows * columns);
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                spend(1);
                arguments.clear();
                for (const Operand& one : arrays) {
                    arguments.push_back(element(*one.array, row, column));
                }
                result->items.push_back(function(std::span<const Operand>(arguments)));
            }
        }
        return of_array(std::move(result));
    }

    /// A row or column is repeated; what lies beyond of anything larger is not available.
    static Operand element(const OperandArray& array, std::size_t row, std::size_t column) {
        const std::size_t in_row = array.rows == 1 ? 0 : row;
        const std::size_t in_column = array.columns == 1 ? 0 : column;
        return in_row < array.rows && in_column < array.columns ? array.at(in_row, in_column)
                                                                : Operand::of(CellError::not_available);
    }

    /// A program that does not compute left no value behind: NOW and TODAY stand for the day on which it stored the file.
    Operand day_of_storing() {
        Operand text;
        text.kind = OperandKind::text;
        text.text = workbook_.metadata.modified.substr(0, std::string_view("2026-11-24").size());
        return function_table().at("DATEVALUE")->compute({&text, 1}, *this);
    }

    Operand call(const FormulaNode& node) {
        if (is_volatile(node.text)) {
            const bool has_day = workbook_.metadata.modified.size() >= std::string_view("2026-11-24").size();
            if (nothing_stored_ && has_day && (node.text == "NOW" || node.text == "TODAY")) {
                const Operand day = day_of_storing();
                if (day.is_number()) {
                    reads_volatile_ = true;
                    return day;
                }
            }
            Operand stored;
            stored.kind = OperandKind::stands_for_all;
            stored.text = node.text;
            return stored;
        }
        if (is_choice(node.text)) {
            return choice(node);
        }
        const auto found = function_table().find(node.text);
        if (found == function_table().end()) {
            return not_evaluated(node.text);
        }
        const SheetFunction& function = *found->second;
        if (node.children < function.least || node.children > function.most) {
            return not_evaluated(node.text + " with " + text::count_of(node.children, "argument"));
        }
        const bool was_array = is_array_;
        is_array_ = is_array_ || function.takes == SheetFunction::Takes::arrays;
        std::vector<Operand> arguments;
        for (const std::uint32_t child : formula_->children_of(node)) {
            arguments.push_back(evaluate(child, false));
        }
        Operand result;
        if (function.takes == SheetFunction::Takes::whole || function.takes == SheetFunction::Takes::arrays) {
            result = function.compute(arguments, *this);
        } else {
            const bool takes_errors = function.takes == SheetFunction::Takes::values_and_errors;
            result = for_each_element(arguments, [&](std::span<const Operand> one) {
                for (const OperandKind first :
                     {OperandKind::not_evaluated, OperandKind::stands_for_all, OperandKind::error}) {
                    for (const Operand& argument : one) {
                        if (argument.kind == first && !(takes_errors && first == OperandKind::error)) {
                            return argument;
                        }
                    }
                }
                return function.compute(one, *this);
            });
        }
        is_array_ = was_array;
        return result;
    }

    Operand choice(const FormulaNode& node) {
        const auto children = formula_->children_of(node);
        if (children.empty() || (node.text == "IF"       ? children.size() > 3
                                 : node.text == "CHOOSE" ? children.size() < 2
                                                         : children.size() != 2)) {
            return not_evaluated(node.text + " with " + text::count_of(children.size(), "argument"));
        }
        const Operand asked = evaluate(children[0], false);
        if (asked.kind == OperandKind::array ||
            (is_array_ && asked.kind == OperandKind::area && asked.area.range.first != asked.area.range.last)) {
            return choice_of_each(node, asked);
        }
        const Operand value = single(asked);
        if (value.kind == OperandKind::not_evaluated || value.kind == OperandKind::stands_for_all) {
            return value;
        }
        if (node.text == "IFERROR" || node.text == "IFNA") {
            const bool is_caught =
                value.kind == OperandKind::error && (node.text == "IFERROR" || value.error == CellError::not_available);
            return is_caught ? evaluate(children[1], false) : value;
        }
        if (node.text == "CHOOSE") {
            const Operand number = as_number(value, *this);
            if (!number.is_number()) {
                return number;
            }
            const double place = std::floor(number.number);
            if (place < 1.0 || place > static_cast<double>(children.size() - 1)) {
                return Operand::of(CellError::value);
            }
            return evaluate(children[static_cast<std::size_t>(place)], false);
        }
        const Operand truth = as_truth(value, *this);
        if (truth.stops()) {
            return truth;
        }
        if (truth.number != 0.0) {
            return children.size() > 1 ? evaluate(children[1], false) : Operand::of(true);
        }
        return children.size() > 2 ? evaluate(children[2], false) : Operand::of(false);
    }

    /// IF and IFERROR of a range or an array, in an array formula.
    Operand choice_of_each(const FormulaNode& node, const Operand& asked) {
        if (node.text == "CHOOSE") {
            return not_evaluated("CHOOSE with an array");
        }
        const auto children = formula_->children_of(node);
        std::vector<Operand> arguments{asked};
        for (const std::uint32_t child : children.subspan(1)) {
            arguments.push_back(evaluate(child, false));
        }
        return for_each_element(arguments, [&](std::span<const Operand> one) {
            if (node.text != "IF") {
                const bool is_caught = one[0].kind == OperandKind::error &&
                                       (node.text == "IFERROR" || one[0].error == CellError::not_available);
                return is_caught ? one[1] : one[0];
            }
            const Operand truth = as_truth(one[0], *this);
            if (truth.stops()) {
                return truth;
            }
            const std::size_t chosen = truth.number != 0.0 ? 1 : 2;
            return chosen < one.size() ? one[chosen] : Operand::of(chosen == 1);
        });
    }

    const Workbook& workbook_;
    const EvaluationOptions& options_;
    WorkbookNames names_;
    std::vector<SheetIndex> indexes_;
    std::vector<std::vector<std::uint32_t>> nodes_;      ///< of each cell of each sheet; k_no_place for a constant
    std::vector<std::vector<CellAddress>> array_cells_;  ///< of each sheet: that fill several cells, in order
    std::vector<UntakenPlaces> unfinished_;              ///< of the index of each sheet: formulas that are not done
    std::vector<std::uint32_t> positions_;               ///< of each cell with a formula in the index of its sheet
    Evaluation result_;
    // Cells with formulas first, defined names behind them.
    std::vector<NodeState> states_;
    std::vector<std::size_t> on_stack_;
    std::vector<Operand> name_values_;
    std::vector<bool> name_is_volatile_;
    std::vector<Waiting> stack_;
    std::size_t steps_ = 0;
    std::optional<std::uint32_t> abandoned_;  ///< the reason that all cells have for which no steps were left
    // Of the formula that is computed.
    const Formula* formula_ = nullptr;
    std::uint32_t asked_by_ = 0;
    std::size_t sheet_ = 0;
    CellAddress address_;
    bool has_address_ = true;
    bool is_array_ = false;
    bool reads_volatile_ = false;
    bool nothing_stored_ = false;  ///< with the cell that is computed
};

}  // namespace

Evaluation evaluate_workbook(const Workbook& workbook, const EvaluationOptions& options) {
    return Evaluator(workbook, options).evaluate();
}

bool is_evaluated_function(const std::string& name) {
    return is_choice(name) || function_table().contains(name);
}

const EvaluatedCell* find_evaluated(const Evaluation& evaluation, const Workbook& workbook, std::size_t sheet,
                                    const CellAddress& address) {
    const auto found =
        std::lower_bound(evaluation.cells.begin(), evaluation.cells.end(), std::pair(sheet, address),
                         [&](const EvaluatedCell& one, const std::pair<std::size_t, CellAddress>& wanted) {
                             return std::pair(one.sheet, workbook.sheets[one.sheet].cells[one.cell].address) < wanted;
                         });
    const bool is_it = found != evaluation.cells.end() && found->sheet == sheet &&
                       workbook.sheets[sheet].cells[found->cell].address == address;
    return is_it ? &*found : nullptr;
}

std::string why_not_evaluated(const Evaluation& evaluation, const Workbook& workbook, const EvaluatedCell& cell) {
    const NotEvaluated& reason = evaluation.reasons[cell.reason];
    if (reason.sheet == cell.sheet && reason.cell == cell.cell) {
        return reason.what;
    }
    const Sheet& sheet = workbook.sheets[reason.sheet];
    return reason.what + " in " + sheet_a1(sheet.name, sheet.cells[reason.cell].address);
}

}  // namespace gumcert::workbook
