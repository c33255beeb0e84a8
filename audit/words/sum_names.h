#pragma once

#include <string_view>

namespace gumcert::audit {

/// What the name of a line says of a sum of rows.
enum class SumName {
    none,
    of_quantity,  ///< "Temperature total": a sum of some rows, if it is one
    whole,        ///< "Total", "RSS": of all rows, or of a part of them
    of_type,      ///< "Type A", "RSS of type B": of a part of the rows, or a contribution
    part,         ///< "Subtotal", "Zwischensumme"
    of_squares,   ///< "Sum of squares", "u_c²"
};
[[nodiscard]] SumName sum_name(std::string_view name);
/// Whether a name says that its row is a part of the one above it: "of which sensor", "davon Fühler".
[[nodiscard]] bool is_called_part(std::string_view name);
/// Whether two names are those of u_c and U: the same but for their first letter, as "u(f)" and "U(f) (k = 2)".
[[nodiscard]] bool are_u_and_U(std::string_view u_c, std::string_view U);

}  // namespace gumcert::audit
