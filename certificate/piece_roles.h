#pragma once

#include <array>
#include <string_view>

namespace gumcert::certificate {

/// What a column of words says of the points of a table: which piece of a set they are about, by the number that the
/// manufacturer gave, or by an identification of the customer or the laboratory. A role as those of quantities are
/// (certificate/point_tables.h).
inline constexpr std::array<std::string_view, 2> k_piece_roles{"serial_number", "identification"};

}  // namespace gumcert::certificate
