#include "audit/expanded_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::audit {
namespace {

bool is_word_of(const Piece& piece, std::initializer_list<std::string_view> words) {
    return piece.kind == Piece::Kind::word && std::find(words.begin(), words.end(), piece.word) != words.end();
}
bool begins_with_one_of(const Piece& piece, std::initializer_list<std::string_view> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(), [&piece](auto word) { return piece.begins(word); });
}

/// What the unit behind a number is worth where it is of dimension one: 1E-6 of "ppm" and "µm/m". Nothing of other units.
std::optional<double> part_in_unit(const std::string& text) {
    try {
        const gum::Unit unit = gum::Unit::parse(text);
        return unit.dimension().is_one() ? std::optional(unit.difference_to_si(1.0)) : std::nullopt;
    } catch (const gum::InputError&) {
        return std::nullopt;
    }
}

/// A sum or product, as far as it has been read.
struct Quantity {
    enum class Kind {
        of_row,
        pure,
        part
    };  ///< with the unit of the row; a bare number; a part of a base that is not stated
    Kind kind = Kind::pure;
    double value = 0.0;
    double part = 0.0;      ///< of `part`, and of a sum that has one
    bool is_open = false;   ///< a factor or term has no number
    double at_least = 0.0;  ///< of a sum that is open: its terms that are known
};

/// Reads one expression of a comment from left to right.
class ExpressionReader {
public:
    ExpressionReader(const Pieces& pieces, const AuditedRow& row, std::size_t at)
        : pieces_(pieces), row_(row), at_(at) {}

    [[nodiscard]] std::size_t position() const { return at_; }

    /// Terms with plus signs between them; nothing where no number stands there.
    std::optional<Quantity> sum(int depth = 0) {
        std::optional<Quantity> all = product(depth);
        std::optional<Quantity> last;
        const double first = all && !all->is_open ? all->value : 0.0;
        while (all && follows_plus()) {
            if (!has(0) || !pieces_[at_].is_number()) {
                ++at_;
            }
            last = product(depth);
            add(*all, last);
            last = last.value_or(Quantity{.is_open = true});
        }
        if (all && goes_on(last)) {
            *all = Quantity{.kind = Quantity::Kind::of_row, .is_open = true, .at_least = last ? first : 0.0};
        }
        return all;
    }

private:
    [[nodiscard]] bool has(std::size_t ahead) const { return at_ + ahead < pieces_.size(); }
    [[nodiscard]] bool follows_plus() const {
        return has(0) && (pieces_[at_].is_sign("+") || pieces_[at_].word == "plus" ||
                          (pieces_[at_].is_number() && pieces_[at_].plus));
    }
    /// Whether what stands behind an expression belongs to it, and is not understood: a divisor, a term that is taken away, a raised
    /// number, or, behind a sum, a number or a word that may be a factor of its last term.
    /// \param last  term of a sum; none of a single one
    [[nodiscard]] bool goes_on(const std::optional<Quantity>& last) const {
        if (!has(0)) {
            return false;
        }
        const Piece& next = pieces_[at_];
        const bool is_raised =
            next.kind == Piece::Kind::word &&
            (next.raw.starts_with("\xE2\x81") || next.raw.starts_with("²") || next.raw.starts_with("³"));
        const bool is_factor = last && !last->is_open && last->kind == Quantity::Kind::pure &&
                               next.kind == Piece::Kind::word &&
                               !is_word_of(next, {"k", "p", "at", "bei", "for", "fur", "with", "mit", "and", "und"});
        return is_raised || is_factor || next.is_sign("/") || (next.is_number() && (last || next.value < 0.0));
    }
    [[nodiscard]] bool follows_times() const {
        return has(0) && (pieces_[at_].is_sign("×") || pieces_[at_].is_sign("·") || pieces_[at_].is_sign("*") ||
                          (pieces_[at_].word == "x" && has(1) && pieces_[at_ + 1].is_number()));
    }
    /// Numbers without a unit in a sum have that of the others.
    static void add(Quantity& all, const std::optional<Quantity>& term) {
        const bool is_part = term && term->kind == Quantity::Kind::part;
        if (!all.is_open && all.kind != Quantity::Kind::part) {
            all.at_least = all.value;
        }
        if (!term || term->is_open || is_part || all.is_open || all.kind == Quantity::Kind::part) {
            const bool is_number = term && !term->is_open && !is_part;
            all.at_least += is_number ? term->value : term ? term->at_least : 0.0;
            all.part += is_part ? term->part : 0.0;
            // A part beside known terms is known but for its base.
            all.is_open = all.is_open || !term || term->is_open;
            all.kind = all.part > 0.0 ? Quantity::Kind::part : Quantity::Kind::of_row;
            return;
        }
        all.value += term->value;
        all.kind = term->kind == Quantity::Kind::of_row ? term->kind : all.kind;
    }
    std::optional<Quantity> product(int depth) {
        std::optional<Quantity> all = factor(depth);
        while (all && follows_times()) {
            ++at_;
            const std::optional<Quantity> next = factor(depth);
            if (!next || next->is_open || all->is_open ||
                (next->kind == Quantity::Kind::of_row && all->kind == Quantity::Kind::of_row)) {
                all = Quantity{.kind = Quantity::Kind::of_row, .is_open = true};
                continue;
            }
            const auto size = [](const Quantity& one) {
                return one.kind == Quantity::Kind::part ? one.part : one.value;
            };
            const double value = size(*all) * size(*next);
            const bool of_row = all->kind == Quantity::Kind::of_row || next->kind == Quantity::Kind::of_row;
            const bool is_part = all->kind == Quantity::Kind::part || next->kind == Quantity::Kind::part;
            all = of_row    ? Quantity{.kind = Quantity::Kind::of_row, .value = value}
                  : is_part ? Quantity{.kind = Quantity::Kind::part, .part = value}
                            : Quantity{.kind = Quantity::Kind::pure, .value = value};
        }
        return all;
    }
    std::optional<Quantity> factor(int depth) {
        constexpr int k_deepest = 3;
        if (!has(0)) {
            return std::nullopt;
        }
        const Piece& piece = pieces_[at_];
        if (piece.is_number()) {
            ++at_;
            return number(piece);
        }
        if (piece.is_sign("(") && depth < k_deepest) {
            ++at_;
            std::optional<Quantity> inside = sum(depth + 1);
            while (has(0) && !pieces_[at_].is_sign(")")) {
                ++at_;
                if (inside) {
                    inside->is_open = true;
                }
            }
            ++at_;
            return inside ? with_unit_behind(*inside) : inside;
        }
        if (piece.kind == Piece::Kind::word) {
            ++at_;
            return symbol(piece.raw);
        }
        return std::nullopt;
    }
    Quantity number(const Piece& piece) {
        const double size = std::abs(piece.value);
        const std::optional<NumberOfRow> of_row = in_unit_of_row(piece, row_);
        if (of_row && of_row->has_unit) {
            if (!piece.percent) {
                skip_unit(piece.unit);
            }
            return {.kind = Quantity::Kind::of_row, .value = of_row->value};
        }
        const std::optional<double> per_unit = piece.percent        ? std::optional(1.0)
                                               : piece.unit.empty() ? std::nullopt
                                                                    : part_in_unit(piece.unit);
        if (per_unit) {
            if (!piece.percent) {
                skip_unit(piece.unit);
            }
            const double part = size * *per_unit;
            if (follows_times()) {
                return {.kind = Quantity::Kind::part, .part = part};
            }
            const std::optional<double> base = base_behind();
            return base ? Quantity{.kind = Quantity::Kind::of_row, .value = part * *base}
                        : Quantity{.kind = Quantity::Kind::part, .part = part};
        }
        if (!has(0) || follows_times() || pieces_[at_].kind != Piece::Kind::word || piece.unit.empty() ||
            pieces_[at_].raw != piece.unit.substr(0, pieces_[at_].raw.size())) {
            return {.kind = Quantity::Kind::pure, .value = size};
        }
        // A word directly behind it: a quantity it is multiplied by, "0.5E-6 L", or the sentence goes on.
        const std::string name = pieces_[at_].raw;
        const bool is_letter = name == "L" || name == "l";
        if (!is_letter && !begins_with_one_of(pieces_[at_], {"fs", "rdg", "reading", "digit", "lsd", "count"})) {
            return of_row ? Quantity{.kind = Quantity::Kind::pure, .value = size} : Quantity{.is_open = true};
        }
        const bool is_alone = name == piece.unit;
        skip_unit(piece.unit);
        const Quantity by = is_alone ? symbol(name) : Quantity{.is_open = true};
        return by.is_open ? Quantity{.kind = Quantity::Kind::of_row, .is_open = true}
                          : Quantity{.kind = Quantity::Kind::of_row, .value = size * by.value};
    }
    /// The unit of what stands in brackets, where one stands behind them.
    Quantity with_unit_behind(Quantity inside) {
        if (!has(0) || pieces_[at_].kind != Piece::Kind::word) {
            return inside;
        }
        std::string unit = pieces_[at_].raw;
        if (has(2) && pieces_[at_ + 1].is_sign("/")) {
            unit += "/" + pieces_[at_ + 2].raw;
        }
        Piece of_one;
        of_one.kind = Piece::Kind::number;
        of_one.value = 1.0;
        of_one.unit = unit;
        const std::optional<NumberOfRow> one = in_unit_of_row(of_one, row_);
        if (one && one->has_unit) {
            skip_unit(unit);
            inside.value *= inside.kind == Quantity::Kind::pure ? one->value : 1.0;
            inside.at_least *= one->value;
            inside.kind = inside.kind == Quantity::Kind::pure ? Quantity::Kind::of_row : inside.kind;
        }
        return inside;
    }
    /// Goes behind the pieces that a unit is made of.
    void skip_unit(const std::string& unit) {
        std::string passed;
        while (has(0) && !pieces_[at_].is_number() && passed.size() < unit.size()) {
            passed += pieces_[at_].raw;
            if (!unit.starts_with(passed)) {
                return;
            }
            ++at_;
        }
    }
    /// "L = 400 mm" anywhere in the text, in the unit of the row.
    [[nodiscard]] Quantity symbol(const std::string& name) const {
        for (std::size_t i = 0; i + 2 < pieces_.size(); ++i) {
            const bool is_set = pieces_[i].kind == Piece::Kind::word && pieces_[i].raw == name &&
                                (pieces_[i + 1].is_sign("=") || pieces_[i + 1].is_sign(":")) &&
                                pieces_[i + 2].is_number();
            const std::optional<NumberOfRow> number = is_set ? in_unit_of_row(pieces_[i + 2], row_) : std::nullopt;
            if (number && number->has_unit) {
                return {.kind = Quantity::Kind::of_row, .value = number->value};
            }
        }
        return {.kind = Quantity::Kind::of_row, .is_open = true};
    }
    /// What a percentage is a part of: the number that follows it behind words of a base alone, or the full scale that is
    /// stated further on.
    [[nodiscard]] std::optional<double> base_behind() {
        const auto is_full_scale = [](const Piece& piece) {
            return is_word_of(piece, {"fs", "scale", "endwert", "skalenendwert", "span", "range", "messbereich",
                                      "messbereichsendwert", "messspanne", "fso"});
        };
        std::size_t next = at_;
        while (next < pieces_.size() && !pieces_[next].is_number() &&
               (is_filler(pieces_[next]) || is_full_scale(pieces_[next]) || pieces_[next].is_sign(".") ||
                is_word_of(pieces_[next], {"f",     "s",       "v",         "e",          "m",        "of",
                                           "von",   "vom",     "der",       "des",        "full",     "reading",
                                           "rdg",   "value",   "messwert",  "messwertes", "wert",     "at",
                                           "bei",   "nominal", "measured",  "indication", "anzeige",  "upper",
                                           "limit", "spanne",  "measuring", "output",     "indicated"}))) {
            ++next;
        }
        const bool is_far = next < pieces_.size() && !pieces_[next].is_number();
        at_ = next;
        if (is_far) {  // the full scale stands elsewhere in the text
            for (std::size_t i = next; i + 1 < pieces_.size() && !ends_sentence(pieces_[i]); ++i) {
                std::size_t number = i + 1;
                while (number < pieces_.size() && is_filler(pieces_[number])) {
                    ++number;
                }
                if (is_full_scale(pieces_[i]) && number < pieces_.size() && pieces_[number].is_number()) {
                    return base_at(number);
                }
            }
            return std::nullopt;
        }
        if (next >= pieces_.size()) {
            return std::nullopt;
        }
        return base_at(next);
    }
    /// A number that is a base, and what was read of it; of a range from 0, its end. Nothing of any other range.
    [[nodiscard]] std::optional<double> base_at(std::size_t place) {
        const auto end_of_range = [this](std::size_t from) -> std::optional<std::size_t> {
            for (std::size_t i = from + 1; i < pieces_.size() && i <= from + 4; ++i) {
                if (is_word_of(pieces_[i], {"to", "bis"}) || pieces_[i].is_sign("–") || pieces_[i].is_sign("-")) {
                    return i + 1 < pieces_.size() && pieces_[i + 1].is_number() ? std::optional(i + 1) : std::nullopt;
                }
            }
            return std::nullopt;
        };
        const bool is_behind = place == at_;
        if (const std::optional<std::size_t> end = end_of_range(place)) {
            if (pieces_[place].value != 0.0) {
                return std::nullopt;
            }
            place = *end;
        }
        const std::optional<NumberOfRow> base = in_unit_of_row(pieces_[place], row_);
        if (!base || !base->has_unit || pieces_[place].percent) {
            return std::nullopt;
        }
        if (is_behind) {
            at_ = place + 1;
            skip_unit(pieces_[place].unit);
        }
        return base->value;
    }

    const Pieces& pieces_;
    const AuditedRow& row_;
    std::size_t at_ = 0;
};

/// Where an expression may begin, and what its number must have.
struct Start {
    std::size_t at = 0;
    bool is_assigned = false;  ///< a number without unit is U as well
};

/// Goes behind brackets that stand at a place; the place itself where they do not end.
std::size_t behind_brackets(const Pieces& pieces, std::size_t open) {
    std::size_t depth = 0;
    for (std::size_t i = open; i < pieces.size(); ++i) {
        depth += pieces[i].is_sign("(") || pieces[i].is_sign("[") ? 1U : 0U;
        depth -= pieces[i].is_sign(")") || pieces[i].is_sign("]") ? 1U : 0U;
        if (depth == 0) {
            return i + 1;
        }
    }
    return open;
}

/// "4711" behind "certificate" or "No.": a whole number, which nothing says to be one of a unit.
bool is_number_of_document(const Pieces& pieces, std::size_t i) {
    const std::size_t back = i > 1 && pieces[i - 1].is_sign(".") ? 2 : 1;  // "No. 4711"
    if (i < back || i >= pieces.size() || !pieces[i].is_number()) {
        return false;
    }
    const Piece& before = pieces[i - back];
    const Piece& number = pieces[i];
    return (is_word_of(before, {"cert", "no", "nr", "number", "nummer", "report"}) ||
            begins_with_one_of(before, {"certif", "zertifik", "kalibrierschein", "prufschein"})) &&
           number.value >= 1.0 && std::floor(number.value) == number.value && !number.percent && !number.plus_minus &&
           (number.unit.empty() || number.unit == "k" || number.unit == "p");
}

/// The piece at which the expression of U begins that a symbol or the words name; nothing where none follows.
/// \param by_words  "expanded uncertainty": other words may stand before the number
std::optional<Start> start_of_expression(const Pieces& pieces, std::size_t symbol, bool by_words) {
    const auto is_assignment = [&pieces](std::size_t i) {
        return i < pieces.size() && (pieces[i].is_sign("=") || pieces[i].is_sign(":") || pieces[i].is_sign("±") ||
                                     is_word_of(pieces[i], {"is", "ist", "betragt", "was"}));
    };
    bool is_assigned = by_words;
    std::size_t i = symbol + 1;
    while (i < pieces.size() && !ends_sentence(pieces[i])) {
        const Piece& piece = pieces[i];
        const bool of_coverage = piece.raw == "k" || piece.raw == "p" || piece.word == "factor";
        if (is_number_of_document(pieces, i)) {
            ++i;
        } else if (piece.is_number()) {
            constexpr double k_least_probability = 0.5;
            const bool is_probability = piece.percent && std::abs(piece.value) >= k_least_probability &&
                                        !(i > 0 && is_assignment(i - 1) && !by_words);
            if (!is_probability) {
                return Start{.at = i, .is_assigned = is_assigned || piece.plus_minus};
            }
            ++i;
        } else if (of_coverage) {
            ++i;
            while (i < pieces.size() && is_filler(pieces[i])) {
                ++i;
            }
            if (i < pieces.size() && pieces[i].is_number()) {
                ++i;
            }
        } else if (piece.is_sign("(") || piece.is_sign("[")) {
            const std::size_t behind = behind_brackets(pieces, i);
            if (is_assigned && i > 0 && is_assignment(i - 1)) {
                return Start{.at = i, .is_assigned = true};  // "U = (0.12 + 0.5E-6 L) µm"
            }
            // "U(100 bar) = 0.2 bar" and "U (k = 2) 0.2 bar", but "U (0.2 bar, k = 2)".
            const bool has_number_behind = behind < pieces.size() && pieces[behind].is_number();
            i = behind > i && (is_assignment(behind) || has_number_behind) ? behind : i + 1;
        } else if (is_word_of(piece, {"at", "bei", "for", "fur"})) {
            ++i;
            while (i < pieces.size() && is_word_of(pieces[i], {"a", "the", "x", "p", "t", "l"})) {
                ++i;
            }
            while (i < pieces.size() && is_filler(pieces[i]) && pieces[i].kind == Piece::Kind::sign) {
                ++i;
            }
            if (i < pieces.size() && pieces[i].is_number()) {
                ++i;
            }
        } else if (is_assignment(i)) {
            is_assigned = true;
            ++i;
        } else if (i > 0 && is_assignment(i - 1) && is_word_of(piece, {"q", "max", "sqrt"})) {
            return Start{.at = i, .is_assigned = true};  // "U = Q[0.12; 0.5 L] µm"
        } else if (!by_words && piece.kind == Piece::Kind::word && i > 0 && pieces[i - 1].is_sign("=")) {
            return std::nullopt;  // "U = R I": a voltage
        } else if (begins_with_one_of(piece, {"resolut", "auflos", "drift", "repeat", "wiederhol", "scatter", "mpe"}) ||
                   (!by_words && piece.is_sign(",") && i + 1 < pieces.size() && !pieces[i + 1].is_number() &&
                    pieces[i + 1].raw != "k" && pieces[i + 1].raw != "p")) {
            return std::nullopt;
        } else {
            ++i;
        }
    }
    return std::nullopt;
}

/// Further U behind the first one: "0.12 µm up to 100 mm and 0.32 µm up to 500 mm".
void take_alternatives(const Pieces& pieces, const AuditedRow& row, std::size_t from, std::vector<double>& found) {
    for (std::size_t i = from; i + 1 < pieces.size(); ++i) {
        if (is_word_of(pieces[i], {"u", "k", "expanded"})) {
            return;
        }
        const bool is_range = i == from && (is_word_of(pieces[i], {"to", "bis"}) || pieces[i].is_sign("–"));
        const bool is_next = is_word_of(pieces[i], {"and", "und", "or", "oder", "bzw", "resp", "respectively"}) ||
                             pieces[i].is_sign(",") || pieces[i].is_sign(";") || pieces[i].is_sign("/");
        if (!(is_range || is_next) || !pieces[i + 1].is_number()) {
            continue;
        }
        const std::optional<NumberOfRow> number = in_unit_of_row(pieces[i + 1], row);
        if (number && number->has_unit) {
            found.push_back(number->value);
        }
    }
}

}  // namespace

std::optional<ExpandedInWords> expanded_uncertainty_in(const Pieces& pieces, const AuditedRow& row) {
    std::vector<double> values;
    OpenExpansion open;
    bool is_open = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (piece.kind != Piece::Kind::word) {
            continue;
        }
        const bool symbol = piece.raw == "U" || piece.raw == "U95" || piece.raw.starts_with("U_") ||
                            piece.raw == "Ucal" || piece.raw == "Ucert";
        const bool words = piece.word == "expanded" || piece.begins("erweitert");
        const std::optional<Start> start = symbol || words ? start_of_expression(pieces, i, words) : std::nullopt;
        if (!start) {
            continue;
        }
        // A number of another kind than the row is that of something else.
        const Piece& first = pieces[start->at];
        ExpressionReader reader(pieces, row, start->at);
        const std::optional<Quantity> U = reader.sum();
        if (!U || (first.is_number() && !first.percent && !in_unit_of_row(first, row) && !part_in_unit(first.unit))) {
            continue;
        }
        if (U->is_open || U->kind == Quantity::Kind::part) {
            is_open = true;
            open.part = U->is_open ? std::nullopt : std::optional(U->part);
            if (!U->is_open || U->at_least > 0.0) {
                open.at_least = U->at_least;
            }
        } else if (U->value > 0.0 && (U->kind == Quantity::Kind::of_row || start->is_assigned)) {
            values.push_back(U->value);
            take_alternatives(pieces, row, reader.position(), values);
        }
        i = std::max(i, std::min(reader.position(), pieces.size()) - 1);
    }
    if (values.empty() && !is_open) {
        return std::nullopt;
    }
    constexpr double k_same = 1e-9;
    const bool is_one = !is_open && std::all_of(values.begin(), values.end(), [&values](double value) {
        return std::abs(value - values.front()) <= k_same * values.front();
    });
    if (is_one) {
        return ExpandedInWords{.value = values.front(), .open = {}};
    }
    open.may_be = std::move(values);
    return ExpandedInWords{.value = std::nullopt, .open = std::move(open)};
}

void settle_expanded_uncertainty(AuditedRow& row) {
    if (!row.open_expansion || row.origin_value || row.origin != Origin::certificate) {
        return;
    }
    const OpenExpansion& open = *row.open_expansion;
    std::vector<double> may_be = open.may_be;
    if (open.part && row.estimate && row.estimate->value != 0.0) {
        // U where the base is the estimate; if it is not, the columns will not agree with it.
        may_be.push_back(open.at_least.value_or(0.0) + *open.part * std::abs(row.estimate->value));
    }
    constexpr double k_near = 0.01;
    const auto is_near = [](double a, double b, double half_step) { return std::abs(a - b) <= half_step + k_near * b; };
    const bool has_size = row.stated && row.stated->value != 0.0;
    const std::optional<double> divided = has_size ? std::optional(std::abs(row.stated->value)) : std::nullopt;
    const double half = row.stated ? printed_half_step(*row.stated) : 0.0;
    const auto is_usable = [](double U) { return U > 0.0 && std::isfinite(U); };  // "U = 0" says nothing of a size
    std::vector<double> may_be_divided = may_be;
    if (open.part && open.at_least.value_or(0.0) == 0.0) {
        may_be_divided.push_back(100.0 * *open.part);  // of a row of relative uncertainties in percent
    }
    for (const double U : may_be_divided) {  // the row is right with this one
        if (is_usable(U) && row.certificate_k && *row.certificate_k > 0.0 &&
            is_near(row.used_u, U / *row.certificate_k, row.u_half_step)) {
            row.origin_value = U;
            return;
        }
    }
    for (const double U : may_be) {
        if (divided && is_near(*divided, U, half)) {
            row.origin_value = divided;
            return;
        }
        if (is_usable(U) && !divided && is_near(row.used_u, U, row.u_half_step)) {
            row.origin_value = U;
            return;
        }
    }
    // An expression that grows with a length or a range that nobody states: the column has its value.
    const bool grows = open.may_be.empty() && open.at_least && *open.at_least > 0.0;
    if (grows && divided && *divided > *open.at_least * (1.0 - k_near)) {
        row.origin_value = divided;
    }
}

}  // namespace gumcert::audit
