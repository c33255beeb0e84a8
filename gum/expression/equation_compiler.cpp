#include "gum/expression/equation_compiler.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "gum/expression/conversion_check.h"
#include "gum/expression/name.h"
#include "gum/expression/temperature_check.h"
#include "gum/expression/unit_check.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"

namespace gumcert::gum {

// From texts to a tape. The order of the steps: names of inputs and unknowns must be known before the equations are
// read, so that d(x) can be told as a forgotten "*"; all left sides before a name on a right side can be called
// unknown; and equations are checked for units in the order in which they use each other, because the unit of a left
// side is that of its right side. The tape is built in the same order, last, of equations without any problem.

namespace {

constexpr std::size_t k_most_problems = 100;
constexpr std::size_t k_most_suggestions = 20;
constexpr std::ptrdiff_t k_longest_cycle_shown = 20;
constexpr std::size_t k_none = std::numeric_limits<std::size_t>::max();

/// What a name means in a system of equations.
struct Symbol {
    enum class Kind : std::uint8_t { input, unknown, equation, radian };
    Kind kind = Kind::input;
    std::size_t index = 0;  // input, unknown or equation
};

class Compiler {
public:
    Compiler(std::span<const EquationText> equations, std::span<const InputSymbol> inputs,
             std::span<const UnknownSymbol> unknowns, std::span<const OutputSymbol> outputs,
             const ExpressionLimits& limits)
        : equations_(equations), inputs_(inputs), unknowns_(unknowns), asked_(outputs), limits_(limits) {}

    void run(CompiledEquations& compiled) {
        if (equations_.empty()) {
            refuse("GC-MODEL-0019", "model", "there is no equation", "a model has at least one equation",
                   "Write \"name = expression\".");
            finish();
        }
        // Each step notes its problems and goes on with what is sound: finish() refuses with all of them at once.
        declare_quantities();
        parse();
        declare_left_sides();
        resolve_names();
        put_in_order();
        check_implicit();
        check_units();
        choose_outputs(compiled.outputs);
        finish();
        warn_of_log();
        compiled.warnings = std::move(warnings_);
        compile(compiled);
    }

private:
    void refuse(std::string code, std::string where, std::string what, std::string rule, std::string action) {
        problems_.push_back({.code = std::move(code),
                             .where = std::move(where),
                             .what = std::move(what),
                             .rule = std::move(rule),
                             .action = std::move(action)});
    }

    void finish() {
        if (problems_.empty()) {
            return;
        }
        if (problems_.size() > k_most_problems) {
            const std::size_t more = problems_.size() - k_most_problems;
            problems_.resize(k_most_problems);
            refuse("GC-MODEL-0018", "model", text::count_of(more, "more problem"), "they are not listed",
                   "Correct the listed ones first.");
        }
        throw InputError(std::move(problems_));
    }

    /// A name enters the table, unless it cannot be a name or is taken.
    bool declare(const std::string& name, Symbol symbol, const std::string& where) {
        if (const std::optional<std::string> reason = reason_against_name(name)) {
            refuse("GC-MODEL-0029", where, "the name \"" + name.substr(0, 64) + "\" " + *reason,
                   "a name is a letter or _, then letters, digits, _ and '", "Give the quantity another name.");
            return false;
        }
        if (is_reserved_name(name)) {
            refuse("GC-MODEL-0023", where, "a quantity has the name \"" + name + "\"",
                   "names of functions and pi cannot be names of quantities", "Give the quantity another name.");
            return false;
        }
        const std::string canonical = canonical_name(name);
        if (symbols_.contains(canonical)) {
            refuse("GC-MODEL-0029", where, "the name \"" + name + "\" is there twice", "a name stands for one quantity",
                   "Give one of the two another name.");
            return false;
        }
        // Two names that look alike on paper would make an equation that nobody can check.
        const auto [twin, is_new] = skeletons_.try_emplace(look_alike_skeleton(name), canonical);
        if (!is_new) {
            refuse("GC-MODEL-0029", where, "\"" + name + "\" looks like \"" + twin->second + "\" but is another name",
                   "names can be told apart on paper", "Type the name anew, with letters of one script.");
        }
        symbols_.emplace(canonical, symbol);
        all_names_.push_back(canonical);
        return true;
    }

    void declare_quantities() {
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            declare(inputs_[i].name, {Symbol::Kind::input, i},
                    inputs_[i].where.empty() ? "input " + inputs_[i].name : inputs_[i].where);
        }
        for (std::size_t i = 0; i < unknowns_.size(); ++i) {
            declare(unknowns_[i].name, {Symbol::Kind::unknown, i}, "unknown " + unknowns_[i].name);
            if (!std::isfinite(unknowns_[i].start)) {
                refuse("GC-MODEL-0045", "unknown " + unknowns_[i].name, "the start value is not finite",
                       "the search begins at a number", "Give a start value near the solution.");
            }
        }
    }

    void parse() {
        std::map<std::string, bool, std::less<>> left_sides;
        for (const EquationText& equation : equations_) {
            const std::string_view text = equation.text;
            // The left sides before anything is parsed: an equation may use one that stands below it.
            const std::string_view left = text.substr(0, std::min(text.find('='), std::size_t{512}));
            const std::size_t first = left.find_first_not_of(" \t\r\n");
            if (first != std::string_view::npos) {
                left_sides.emplace(left.substr(first, left.find_last_not_of(" \t\r\n") - first + 1), true);
            }
        }
        const IsQuantity is_quantity = [&](std::string_view name) {
            return symbols_.contains(canonical_name(name)) || left_sides.find(name) != left_sides.end();
        };
        // The limit of nodes holds for all equations together; each takes off what it used.
        ExpressionLimits left_over = limits_;
        for (const EquationText& equation : equations_) {
            trees_.push_back(parse_equation(equation, left_over, problems_, is_quantity));
            left_over.nodes -= std::min(left_over.nodes, trees_.back().nodes.size());
        }
    }

    void declare_left_sides() {
        for (std::size_t i = 0; i < trees_.size(); ++i) {
            const SyntaxTree& tree = trees_[i];
            if (!tree.has_left_side || tree.is_implicit() || is_reserved_name(tree.defines) ||
                reason_against_name(tree.defines)) {
                continue;
            }
            const std::string where = place(tree.where, tree.defines_column);
            const auto taken = symbols_.find(tree.defines);
            if (taken == symbols_.end()) {
                declare(tree.defines, {Symbol::Kind::equation, i}, where);
                continue;
            }
            switch (taken->second.kind) {
                case Symbol::Kind::input:
                    refuse("GC-MODEL-0022", where, "\"" + tree.defines + "\" is an input and has an equation",
                           "a quantity is an input or has an equation, not both",
                           "Remove the input or the equation, or give one of them another name.");
                    break;
                case Symbol::Kind::unknown:
                    refuse("GC-MODEL-0022", where, "\"" + tree.defines + "\" is solved for and has an equation",
                           "an unknown is defined by equations \"0 = …\" only",
                           "Write \"0 = … - " + tree.defines + "\", or take the name out of \"solve_for\".");
                    break;
                default:
                    refuse("GC-MODEL-0021", where, "a second equation for \"" + tree.defines + "\"",
                           "a quantity has one equation (the first is at " +
                               place(trees_[taken->second.index].where, 1) + ")",
                           "Remove one of the two, or give it another name.");
            }
        }
        // The unit may stand in an equation as the factor 1; a quantity of that name goes before.
        if (!symbols_.contains("rad")) {
            symbols_.emplace("rad", Symbol{Symbol::Kind::radian, 0});
        }
    }

    void resolve_names() {
        meanings_.resize(trees_.size());
        for (std::size_t i = 0; i < trees_.size(); ++i) {
            const SyntaxTree& tree = trees_[i];
            std::vector<std::uint32_t> column(tree.names.size(), 1);
            // Backwards, so that the first place of a name is the one that stays.
            for (std::size_t n = tree.nodes.size(); n-- > 0;) {
                if (tree.nodes[n].operation == Operation::quantity) {
                    column[tree.nodes[n].name] = tree.nodes[n].column;
                }
            }
            for (std::size_t n = 0; !tree.nodes.empty() && n < tree.names.size(); ++n) {
                const std::string& name = tree.names[n];
                const auto found = symbols_.find(name);
                meanings_[i].push_back(found == symbols_.end() ? nullptr : &found->second);
                if (found != symbols_.end() || name == tree.defines || is_reserved_name(name) ||
                    reason_against_name(name)) {
                    continue;
                }
                const auto twin = skeletons_.find(look_alike_skeleton(name));
                // With a long list of unknown names the table of inputs is missing, not one letter.
                const std::optional<std::string> nearest =
                    problems_.size() < k_most_suggestions ? nearest_name(name, all_names_) : std::nullopt;
                std::string action = "Add it to the inputs, or write an equation for it.";
                if (twin != skeletons_.end()) {
                    action = "\"" + twin->second + "\" looks the same, with other letters: type the name anew.";
                } else if (name == "π") {
                    action = "Write \"pi\".";
                } else if (nearest) {
                    action = "Write \"" + *nearest + "\" if that is meant; else add it to the inputs.";
                }
                refuse("GC-MODEL-0020", place(tree.where, column[n]), "\"" + name + "\" is not known",
                       "every name is an input or has an equation", std::move(action));
            }
        }
    }

    /// Equations that equation i uses, by the names in it.
    [[nodiscard]] std::size_t used_equation(std::size_t i, std::size_t name) const {
        const Symbol* symbol = meanings_[i][name];
        return symbol != nullptr && symbol->kind == Symbol::Kind::equation ? symbol->index : k_none;
    }

    void put_in_order() {
        // Depth-first search with a path of its own: an equation is put down after all that it uses, whatever the order
        // in the job, and an open one that is met again closes a cycle. No recursion: jobs can be made long on purpose.
        enum class Mark : std::uint8_t { fresh, open, done };
        std::vector<Mark> marks(trees_.size(), Mark::fresh);
        struct Visit {
            std::size_t equation, next_name;
        };
        std::vector<Visit> path;
        const auto visit_from = [&](std::size_t start) {
            if (marks[start] != Mark::fresh) {
                return;
            }
            marks[start] = Mark::open;
            path.push_back({start, 0});
            while (!path.empty()) {
                Visit& visit = path.back();
                const std::size_t i = visit.equation;
                if (visit.next_name == meanings_[i].size()) {
                    marks[i] = Mark::done;
                    order_.push_back(i);
                    path.pop_back();
                    continue;
                }
                const std::size_t next = used_equation(i, visit.next_name++);
                if (next == k_none || marks[next] == Mark::done) {
                    continue;
                }
                if (marks[next] == Mark::fresh) {
                    marks[next] = Mark::open;
                    path.push_back({next, 0});
                    continue;
                }
                const auto begin =
                    std::find_if(path.begin(), path.end(), [&](const Visit& one) { return one.equation == next; });
                if (path.end() - begin == 1) {
                    refuse("GC-MODEL-0025", place(trees_[next].where, trees_[next].defines_column),
                           "\"" + trees_[next].defines + "\" stands on both sides",
                           "a quantity is not defined by itself",
                           "Solve the equation for it, or write \"0 = …\" with \"solve_for\".");
                    continue;
                }
                std::string cycle;
                for (auto one = begin; one != path.end(); ++one) {
                    if (one - begin == k_longest_cycle_shown) {
                        cycle += "… → ";
                        break;
                    }
                    cycle += trees_[one->equation].defines + " → ";
                }
                refuse("GC-MODEL-0024", place(trees_[next].where, trees_[next].defines_column),
                       cycle + trees_[next].defines + " is a cycle", "equations can be put in an order",
                       "Break the cycle, or write its equations as \"0 = …\" with \"solve_for\".");
            }
        };
        for (std::size_t i = 0; i < trees_.size(); ++i) {
            visit_from(i);
        }
    }

    void check_implicit() {
        bool all_read = true;
        for (std::size_t i = 0; i < trees_.size(); ++i) {
            all_read = all_read && trees_[i].is_whole();
            if (trees_[i].is_implicit()) {
                implicit_.push_back(i);
            }
        }
        if (!all_read) {
            return;
        }
        // With fewer equations the unknowns are not determined, with more they contradict each other for measured
        // values.
        if (implicit_.size() != unknowns_.size()) {
            std::string names;
            for (const UnknownSymbol& unknown : unknowns_) {
                names += (names.empty() ? "" : ", ") + unknown.name;
            }
            refuse("GC-MODEL-0026", implicit_.empty() ? "model" : place(trees_[implicit_.front()].where, 1),
                   text::count_of(implicit_.size(), "equation") + " \"0 = …\" and " +
                       text::count_of(unknowns_.size(), "unknown") + (names.empty() ? "" : " (" + names + ")"),
                   "there are as many implicit equations as unknowns", "Complete the equations or \"solve_for\".");
        }
        const std::vector<bool> reached = reach(implicit_).unknowns;
        for (std::size_t i = 0; i < unknowns_.size(); ++i) {
            if (!reached[i]) {
                refuse("GC-MODEL-0027", "unknown " + unknowns_[i].name, "no equation \"0 = …\" depends on it",
                       "an unknown is found from the implicit equations",
                       "Use it in an equation \"0 = …\", or take it out of \"solve_for\".");
            }
        }
    }

    struct Reach {
        std::vector<bool> inputs, unknowns, equations;
    };
    /// All that some equations depend on, directly or through others.
    [[nodiscard]] Reach reach(const std::vector<std::size_t>& from) const {
        Reach reach{std::vector<bool>(inputs_.size()), std::vector<bool>(unknowns_.size()),
                    std::vector<bool>(trees_.size())};
        std::vector<std::size_t> open = from;
        while (!open.empty()) {
            const std::size_t i = open.back();
            open.pop_back();
            if (reach.equations[i]) {
                continue;
            }
            reach.equations[i] = true;
            for (const Symbol* symbol : meanings_[i]) {
                if (symbol == nullptr) {
                    continue;
                }
                switch (symbol->kind) {
                    case Symbol::Kind::input:
                        reach.inputs[symbol->index] = true;
                        break;
                    case Symbol::Kind::unknown:
                        reach.unknowns[symbol->index] = true;
                        break;
                    case Symbol::Kind::equation:
                        open.push_back(symbol->index);
                        break;
                    case Symbol::Kind::radian:
                        break;
                }
            }
        }
        return reach;
    }

    void check_units() {
        for (const InputSymbol& input : inputs_) {
            input_kinds_.push_back(QuantityKind::of(input.unit, input.constant));
        }
        for (const UnknownSymbol& unknown : unknowns_) {
            unknown_kinds_.push_back(QuantityKind::of(unknown.unit));
        }
        QuantityKind radian;
        radian.dimension = Dimension::angle();
        radian.constant = 1.0;
        radian.unit = "rad";
        equation_kinds_.assign(trees_.size(), QuantityKind::unknown());
        temperatures_.assign(trees_.size(), TemperatureContent{});
        products_.assign(trees_.size(), std::nullopt);
        constants_.resize(trees_.size());
        for (const std::size_t i : order_) {
            const SyntaxTree& tree = trees_[i];
            if (!tree.is_whole()) {
                continue;
            }
            // A kind that is not known stays silent: one wrong unit is told once, and not again by all that use it.
            std::vector<const QuantityKind*> quantities;
            for (const Symbol* symbol : meanings_[i]) {
                const QuantityKind* kind = nullptr;
                if (symbol != nullptr) {
                    switch (symbol->kind) {
                        case Symbol::Kind::input:
                            kind = &input_kinds_[symbol->index];
                            break;
                        case Symbol::Kind::unknown:
                            kind = &unknown_kinds_[symbol->index];
                            break;
                        case Symbol::Kind::equation:
                            kind = &equation_kinds_[symbol->index];
                            break;
                        case Symbol::Kind::radian:
                            kind = &radian;
                            break;
                    }
                }
                quantities.push_back(kind);
            }
            const std::vector<QuantityKind> kinds = gum::check_units(tree, quantities, problems_);
            equation_kinds_[i] = kinds.back();
            std::vector<const TemperatureContent*> contents;
            for (const Symbol* symbol : meanings_[i]) {
                const bool has_equation = symbol != nullptr && symbol->kind == Symbol::Kind::equation;
                contents.push_back(has_equation ? &temperatures_[symbol->index] : nullptr);
            }
            temperatures_[i] = check_temperatures(tree, kinds, contents, warnings_);
            products_[i] =
                written_product(tree, [&](std::uint32_t name) { return written_product_of(meanings_[i][name]); });
            if (tree.is_implicit()) {
                check_balance(tree, kinds.back(), problems_);
                check_result(temperatures_[i], kinds.back(), warnings_);
            }
            for (const SyntaxNode& node : tree.nodes) {
                // Units have told whether an exponent is constant; the tape takes that value.
                if (node.operation == Operation::power) {
                    constants_[i].emplace(node.right, kinds[static_cast<std::size_t>(node.right)].constant);
                }
            }
        }
    }

    void choose_outputs(std::vector<CompiledEquations::Output>& outputs) {
        if (!asked_.empty()) {
            std::map<std::string, bool> seen;
            for (const OutputSymbol& asked : asked_) {
                const std::string where = asked.where.empty() ? "output " + asked.name : asked.where;
                const std::string canonical = canonical_name(asked.name);
                if (!seen.emplace(canonical, true).second) {
                    refuse("GC-MODEL-0044", where, "the output \"" + asked.name + "\" is there twice",
                           "an output is asked for once", "Remove one of the two.");
                    continue;
                }
                const auto found = symbols_.find(canonical);
                if (found == symbols_.end() || found->second.kind == Symbol::Kind::input ||
                    found->second.kind == Symbol::Kind::radian) {
                    const bool is_input = found != symbols_.end() && found->second.kind == Symbol::Kind::input;
                    std::vector<std::string> names;
                    for (const SyntaxTree& tree : trees_) {
                        if (!tree.defines.empty()) {
                            names.push_back(tree.defines);
                        }
                    }
                    const std::optional<std::string> nearest = nearest_name(asked.name, names);
                    refuse("GC-MODEL-0028", where,
                           "the output \"" + asked.name + (is_input ? "\" is an input" : "\" has no equation"),
                           "an output stands on the left of an equation or is solved for",
                           nearest && !is_input ? "Write \"" + *nearest + "\" if that is meant, or add its equation."
                                                : "Write an equation for it.");
                    continue;
                }
                add_output(outputs, asked.name, found->second, asked.unit, where);
            }
            return;
        }
        // What no other equation uses is what the author wants to know; the others are steps on the way.
        std::vector<bool> equation_used(trees_.size(), false);
        std::vector<bool> unknown_used(unknowns_.size(), false);
        for (std::size_t i = 0; i < trees_.size(); ++i) {
            for (const Symbol* symbol : meanings_[i]) {
                if (symbol != nullptr && symbol->kind == Symbol::Kind::equation && symbol->index != i) {
                    equation_used[symbol->index] = true;
                } else if (symbol != nullptr && symbol->kind == Symbol::Kind::unknown && !trees_[i].is_implicit()) {
                    unknown_used[symbol->index] = true;
                }
            }
        }
        const auto add_unknowns = [&](bool every_one) {
            for (std::size_t i = 0; i < unknowns_.size(); ++i) {
                if (every_one || !unknown_used[i]) {
                    add_output(outputs, unknowns_[i].name, {Symbol::Kind::unknown, i}, std::nullopt,
                               "unknown " + unknowns_[i].name);
                }
            }
        };
        for (std::size_t i = 0; i < trees_.size(); ++i) {
            const auto found = symbols_.find(trees_[i].defines);
            const bool defines = !trees_[i].defines.empty() && found != symbols_.end() &&
                                 found->second.kind == Symbol::Kind::equation && found->second.index == i;
            if (defines && !equation_used[i]) {
                add_output(outputs, trees_[i].defines, found->second, std::nullopt,
                           place(trees_[i].where, trees_[i].defines_column));
            }
        }
        add_unknowns(false);
        // Every unknown is used, and no left side stands alone: then the unknowns are what was asked for.
        if (outputs.empty()) {
            add_unknowns(true);
        }
    }

    void add_output(std::vector<CompiledEquations::Output>& outputs, const std::string& name, const Symbol& symbol,
                    const std::optional<Unit>& declared, const std::string& where) {
        if (symbol.kind == Symbol::Kind::unknown) {
            const Unit& own = unknowns_[symbol.index].unit;
            outputs.push_back(
                {name, output_unit(name, unknown_kinds_[symbol.index], declared ? declared : own, where, problems_)});
        } else {
            const QuantityKind& kind = equation_kinds_[symbol.index];
            outputs.push_back({name, output_unit(name, kind, declared, where, problems_)});
            if (!declared && kind.known) {
                check_default_unit(name, temperatures_[symbol.index], kind, where, problems_);
                outputs.back().unit = preferred_unit(outputs.back().unit, units_used_by(symbol.index));
            }
            check_result(temperatures_[symbol.index], kind, warnings_);
            if (declared && products_[symbol.index]) {
                check_conversion(name, *products_[symbol.index], *declared, where, warnings_);
            }
        }
        chosen_.push_back(symbol);
    }

    [[nodiscard]] std::optional<WrittenProduct> written_product_of(const Symbol* symbol) const {
        if (symbol == nullptr) {
            return std::nullopt;
        }
        const auto of_unit = [](const Unit& unit) { return WrittenProduct{.size = unit.difference_to_si(1.0)}; };
        switch (symbol->kind) {
            case Symbol::Kind::input:
                return of_unit(inputs_[symbol->index].unit);
            case Symbol::Kind::unknown:
                return of_unit(unknowns_[symbol->index].unit);
            case Symbol::Kind::equation:
                return products_[symbol->index];
            case Symbol::Kind::radian:
                return WrittenProduct{};
        }
        return std::nullopt;
    }

    /// Units of the inputs and unknowns of an equation, in the order in which they stand in it and in those it uses.
    [[nodiscard]] std::vector<const Unit*> units_used_by(std::size_t equation) const {
        std::vector<const Unit*> units;
        std::vector<bool> seen(trees_.size(), false);
        std::vector<std::size_t> open{equation};
        while (!open.empty()) {
            const std::size_t i = open.back();
            open.pop_back();
            if (seen[i]) {
                continue;
            }
            seen[i] = true;
            std::vector<std::size_t> next;
            for (const Symbol* symbol : meanings_[i]) {
                if (symbol == nullptr || symbol->kind == Symbol::Kind::radian) {
                    continue;
                }
                if (symbol->kind == Symbol::Kind::equation) {
                    next.push_back(symbol->index);
                } else {
                    units.push_back(symbol->kind == Symbol::Kind::input ? &inputs_[symbol->index].unit
                                                                        : &unknowns_[symbol->index].unit);
                }
            }
            // Last in, first out: turned round, the first name of the text is visited first.
            open.insert(open.end(), next.rbegin(), next.rend());
        }
        return units;
    }

    /// Spreadsheets mean the decimal logarithm with it. Once, at the first place.
    void warn_of_log() {
        for (const SyntaxTree& tree : trees_) {
            for (const SyntaxNode& node : tree.nodes) {
                if (node.operation != Operation::ln) {
                    continue;
                }
                std::string_view text = std::string_view(tree.text).substr(node.begin, node.end - node.begin);
                text.remove_prefix(std::min(text.find_first_not_of("( \t"), text.size()));
                if (!text.starts_with("log")) {
                    continue;
                }
                warnings_.push_back({.code = "GC-MODEL-0042",
                                     .where = place(tree.where, node.column),
                                     .what = "\"" + tree.excerpt(node) + "\" is taken as the natural logarithm",
                                     .rule = "log is the same as ln here; spreadsheets mean the decimal logarithm with "
                                             "it, which is log10",
                                     .action = "Write ln or log10, whichever is meant.",
                                     .severity = Severity::warning});
                return;
            }
        }
    }

    void compile(CompiledEquations& compiled) {
        TapeBuilder builder(inputs_.size() + unknowns_.size());
        std::vector<TapeBuilder::Node> results(trees_.size(), -1);
        for (const std::size_t i : order_) {
            const SyntaxTree& tree = trees_[i];
            std::vector<TapeBuilder::Node> nodes;
            nodes.reserve(tree.nodes.size());
            for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
                const SyntaxNode& node = tree.nodes[n];
                const StepOrigin origin{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(n)};
                switch (node.operation) {
                    case Operation::number:
                        nodes.push_back(builder.constant(node.value));
                        break;
                    case Operation::pi:
                        nodes.push_back(builder.constant(3.14159265358979323846));
                        break;
                    case Operation::quantity: {
                        const Symbol& symbol = *meanings_[i][node.name];
                        nodes.push_back(symbol.kind == Symbol::Kind::input ? builder.leaf(symbol.index)
                                        : symbol.kind == Symbol::Kind::unknown
                                            ? builder.leaf(inputs_.size() + symbol.index)
                                        : symbol.kind == Symbol::Kind::radian ? builder.constant(1.0)
                                                                              : results[symbol.index]);
                        break;
                    }
                    default: {
                        const TapeBuilder::Node a = nodes[static_cast<std::size_t>(node.left)];
                        TapeBuilder::Node b = node.right < 0 ? a : nodes[static_cast<std::size_t>(node.right)];
                        if (node.operation == Operation::power) {
                            // A constant exponent becomes a number of the tape: x^2 is then a product, also for a
                            // negative x.
                            if (const std::optional<double>& exponent = constants_[i].at(node.right)) {
                                b = builder.constant(*exponent);
                            }
                        }
                        nodes.push_back(builder.step(node.operation, a, b, origin));
                    }
                }
            }
            results[i] = nodes.back();
        }
        std::vector<TapeBuilder::Node> residuals;
        for (const std::size_t i : implicit_) {
            residuals.push_back(results[i]);
        }
        std::vector<TapeBuilder::Node> outputs;
        std::vector<std::size_t> roots;
        bool uses_unknowns = false;
        for (const Symbol& symbol : chosen_) {
            if (symbol.kind == Symbol::Kind::unknown) {
                outputs.push_back(builder.leaf(inputs_.size() + symbol.index));
                uses_unknowns = true;
            } else {
                outputs.push_back(results[symbol.index]);
                roots.push_back(symbol.index);
            }
        }
        Reach reached = reach(roots);
        for (const bool unknown : reached.unknowns) {
            uses_unknowns = uses_unknowns || unknown;
        }
        // Implicit equations are solved together: who uses one unknown depends on all that stands in any of them.
        if (uses_unknowns) {
            roots.insert(roots.end(), implicit_.begin(), implicit_.end());
            reached = reach(roots);
        }
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            compiled.input_names.push_back(inputs_[i].name);
            if (!reached.inputs[i]) {
                compiled.unused_inputs.push_back(i);
            }
        }
        for (const UnknownSymbol& unknown : unknowns_) {
            compiled.unknown_names.push_back(unknown.name);
            compiled.start.push_back(unknown.start);
        }
        compiled.tape = builder.finish(residuals, outputs);
        compiled.implicit = std::move(implicit_);
        compiled.trees = std::move(trees_);
    }

    std::span<const EquationText> equations_;
    std::span<const InputSymbol> inputs_;
    std::span<const UnknownSymbol> unknowns_;
    std::span<const OutputSymbol> asked_;
    const ExpressionLimits& limits_;

    std::vector<Diagnostic> problems_;
    std::map<std::string, Symbol> symbols_;
    std::map<std::string, std::string> skeletons_;
    std::vector<std::string> all_names_;
    std::vector<SyntaxTree> trees_;
    std::vector<std::vector<const Symbol*>> meanings_;  // of tree.names
    std::vector<std::size_t> order_;
    std::vector<std::size_t> implicit_;
    std::vector<QuantityKind> input_kinds_, unknown_kinds_, equation_kinds_;
    std::vector<TemperatureContent> temperatures_;  // of the equations
    std::vector<std::optional<WrittenProduct>> products_;
    std::vector<Diagnostic> warnings_;
    std::vector<std::map<std::int32_t, std::optional<double>>> constants_;  // exponents of an equation, by node
    std::vector<Symbol> chosen_;                                            // what the outputs are
};

}  // namespace

CompiledEquations compile_equations(std::span<const EquationText> equations, std::span<const InputSymbol> inputs,
                                    std::span<const UnknownSymbol> unknowns, std::span<const OutputSymbol> outputs,
                                    const ExpressionLimits& limits) {
    CompiledEquations compiled;
    Compiler(equations, inputs, unknowns, outputs, limits).run(compiled);
    return compiled;
}

}  // namespace gumcert::gum
