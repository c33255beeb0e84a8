#pragma once

#include <string>
#include <string_view>

namespace gumcert::archive {

/// Under which number a record says that its certificate, or the report of its comparison, is issued: what the number of an entry is
/// held against. "" where it states none, or is no JSON (docs/adr/0053-the-archive.md, 5).
[[nodiscard]] std::string number_stated_in(std::string_view record);

inline constexpr const char* k_number_rule = "a record is drafted under the number that it states";

}  // namespace gumcert::archive
