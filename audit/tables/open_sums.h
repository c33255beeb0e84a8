#pragma once

#include <vector>

#include "audit/sentence.h"
#include "audit/tables/table_so_far.h"

namespace gumcert::audit {

/// Whether nobody knows how the rows of a table make up its result, so that a sum of them would be a number of nobody; that is said.
/// \param table  with its statements and units settled, and no product
[[nodiscard]] bool has_open_sum(const TableSoFar& table, std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
