#pragma once

#include "reports/record/evaluation_record.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// How a name in a document is drawn as a mathematical symbol: what stands upright and small below the first letters.
struct Symbol {
    std::string base;   ///< "l", "α": drawn in italics
    std::string index;  ///< "s", "eff", "α,1"; "" without
};

/// "alpha_s" is α with the index s, "T_L" is T with the index L, "theta" is ϑ as a letter: θ. A name whose first part is a
/// word ("offset_2") is no symbol: both parts are "".
[[nodiscard]] Symbol symbol_of(const std::string& name);

/// The names in the documents of a record that are symbols: those of its quantities, those that its equations define, and
/// those of the program. Templates draw them as such, wherever they stand.
///
/// {symbols[] {text, base, index}, letters[] {text}}: names that are found in running text, and single letters, which are
/// symbols only where they stand alone in the first cell of a row, in a formula or in a drawing.
[[nodiscard]] nlohmann::json symbols_in(const EvaluationRecord& record);

/// A stretch of a text: a symbol, or what stands between symbols.
struct SymbolPiece {
    std::string text;
    Symbol symbol;  ///< base "": no symbol
};

/// Finds the symbols of a view in its texts.
class SymbolFinder {
public:
    /// \param view  with the lists of symbols_in(); without them nothing is found
    explicit SymbolFinder(const nlohmann::json& view);

    /// The text in pieces; the texts of the pieces one after the other are the text.
    [[nodiscard]] std::vector<SymbolPiece> pieces(std::string_view text) const;
    /// The same of a formula: single letters are symbols as well. Names of functions and numbers are none.
    [[nodiscard]] std::vector<SymbolPiece> pieces_of_formula(std::string_view text) const;
    [[nodiscard]] bool is_letter(std::string_view text) const { return letters_.contains(text); }

private:
    std::map<std::string, Symbol, std::less<>> symbols_;
    std::vector<std::string> others_;  ///< symbols that begin with a letter of another script
    std::set<std::string, std::less<>> letters_;

    [[nodiscard]] std::vector<SymbolPiece> pieces(std::string_view text, bool formula) const;
};

}  // namespace gumcert::reports
