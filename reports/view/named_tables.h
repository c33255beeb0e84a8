#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "certificate/certified_results.h"

namespace gumcert::reports {

/// The tables of its own document that a text names in any of the four languages: "Table 2", "see Tables 2 to 4".
/// \return their numbers; none where the text says more than where the results stand, "Table 2 of the logbook", or has
///         numbers that are none of tables: whose tables they are cannot be told then
[[nodiscard]] std::vector<std::size_t> own_tables_named(std::string_view text);

/// Whether a certificate says by numbers of tables where the results before an adjustment stand, in any language.
[[nodiscard]] bool names_tables_before_adjustment(const certificate::Certificate& certificate);

/// That the results before an adjustment are said to stand in a table that the document does not have, or that has no
/// results (R07-4d): numbers of tables are those of a document. What the certificate has among its findings is not told again.
/// \param view  of the document, see certificate_view.h
/// \param languages  in which it is printed
[[nodiscard]] std::vector<certificate::Finding> findings_on_named_tables(const certificate::Certificate& certificate,
                                                                         const nlohmann::json& view,
                                                                         const std::vector<std::string>& languages);

}  // namespace gumcert::reports
