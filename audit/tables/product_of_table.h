#pragma once

#include <vector>

#include "audit/sentence.h"
#include "audit/tables/stated_results.h"
#include "audit/tables/table_so_far.h"

namespace gumcert::audit {

/// How the values of rows without coefficients make up that of the result as a product or quotient, as in chemistry, goes to
/// `table.product`. The result may be the last row, without a name that is known, where U is k times its u, and no line states u_c.
void take_product(TableSoFar& table, std::vector<Sentence>& not_read);

/// Gives the rows of a product y = Π x^e their sensitivity coefficients, e y/x, unless their u were added as they stand. What is stated
/// has to follow, or to follow from no exponents that fit.
/// \param table  with its statements and units settled
void settle_product(TableSoFar& table, std::vector<Sentence>& not_read);

/// Whether an amount beside the value of a product is its u_c: U that is stated is k times it, or the rows give it with c = y/x.
/// \param table  with a product and a value
[[nodiscard]] bool is_u_c_beside_product(TableSoFar& table, const StatedResult& amount);

}  // namespace gumcert::audit
