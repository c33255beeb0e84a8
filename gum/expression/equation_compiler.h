#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gum/expression/equation_system.h"
#include "gum/expression/syntax_tree.h"
#include "gum/expression/tape.h"
#include "gum/quantity/unit.h"

namespace gumcert::gum {

/// Equations that were read, checked, put in order and turned into a tape.
struct CompiledEquations {
    struct Output {
        std::string name;
        Unit unit;
    };

    std::vector<SyntaxTree> trees;  ///< for messages
    std::vector<std::string> input_names;
    std::vector<std::string> unknown_names;
    std::vector<double> start;          ///< of the unknowns, coherent SI
    std::vector<std::size_t> implicit;  ///< the equations "0 = …"
    std::vector<Output> outputs;
    std::vector<std::size_t> unused_inputs;
    std::vector<Diagnostic> warnings;
    Tape tape;  ///< leaves: inputs, then unknowns; roots: one residual for each implicit equation, then the outputs

    [[nodiscard]] std::size_t inputs() const { return input_names.size(); }
    [[nodiscard]] std::size_t unknowns() const { return unknown_names.size(); }
};

/// See EquationSystem::compile().
[[nodiscard]] CompiledEquations compile_equations(std::span<const EquationText> equations,
                                                  std::span<const InputSymbol> inputs,
                                                  std::span<const UnknownSymbol> unknowns,
                                                  std::span<const OutputSymbol> outputs,
                                                  const ExpressionLimits& limits);

}  // namespace gumcert::gum
