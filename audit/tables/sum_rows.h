#pragma once

#include <string>
#include <vector>

#include "audit/sentence.h"
#include "audit/tables/table_sums.h"

namespace gumcert::audit {

/// What is told of a line that is not added, for the rows that it is made of were added.
[[nodiscard]] Sentence taken_for_a_sum(const std::string& place, const std::string& name);

/// Says of the rows of a table which are sums of others: subtotals between them, which are not added again, and results in its last
/// lines, which become its statements. What is taken away is told.
/// \param has_result_line  whether a line of the table states the value and more
/// \return whether nobody can know what the result is, and it was said
[[nodiscard]] bool settle_sums(const TableSums& table, bool has_result_line, std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
