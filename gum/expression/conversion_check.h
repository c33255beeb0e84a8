#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gum/expression/syntax_tree.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::gum {

/// What an equation gives when its numbers are taken as they are written, as a spreadsheet does.
struct WrittenProduct {
    double factor = 1.0;  ///< the literal numbers that everything else is multiplied by, and pi
    double size = 1.0;    ///< in SI, of 1 in the units in which its quantities are stated
    double terms = 1.0;   ///< how many are added: a factor of 1/terms makes a mean of them, and converts nothing
};

/// The product that an equation is; nothing where its units do not say what a spreadsheet would get.
/// \param of_name  that of each of tree.names: {1, its unit} of an input, that of its equation else
[[nodiscard]] std::optional<WrittenProduct> written_product(
    const SyntaxTree& tree, const std::function<std::optional<WrittenProduct>(std::uint32_t)>& of_name);

/// GC-MODEL-0046 where the literal factor of a result is just the one that leads to its declared unit: (a - b)/b*1e6 in ppm.
/// The program converts units, so that such a factor is applied twice.
void check_conversion(const std::string& name, const WrittenProduct& product, const Unit& declared,
                      const std::string& where, std::vector<Diagnostic>& warnings);

}  // namespace gumcert::gum
