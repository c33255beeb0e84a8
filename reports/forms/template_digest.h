#pragma once

#include <filesystem>
#include <string>

namespace gumcert::reports {

/// SHA-256 of what documents are made with, 64 hexadecimal digits: the files of templates/ whose names begin with
/// "certificate.", pictures beside them, and all files in pdf/ and wording/. It is that of the lines "SHA-256  name" of
/// these files in the order of their names, as sha256sum writes them.
/// \throws gum::StorageError  GC-REPORT-0002 if one cannot be read
[[nodiscard]] std::string template_digest(const std::filesystem::path& templates);

}  // namespace gumcert::reports
