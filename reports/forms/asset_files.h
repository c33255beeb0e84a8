#pragma once

#include "reports/forms/render.h"

#include "reports/wording.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gumcert::reports {

/// The whole of a file of the product.
/// \throws gum::StorageError if it cannot be read
[[nodiscard]] std::string read_asset(const std::filesystem::path& file);

/// The object of a JSON file of the product, read strictly.
/// \throws gum::StorageError if it cannot be read, or is none
[[nodiscard]] nlohmann::json read_json_asset(const std::filesystem::path& file);
/// The same of its text, for which the file is named in messages.
[[nodiscard]] nlohmann::json json_of_asset(const std::string& text, const std::filesystem::path& file);

/// Languages that a document is printed in, the binding one first: those that the assets ask for, else the first two of
/// the certificate data, else English.
[[nodiscard]] std::vector<std::string> languages_of(const EvaluationRecord& record, const RenderAssets& assets);

/// The same for a document in one language, the binding one.
[[nodiscard]] RenderAssets in_one_language(RenderAssets assets);

/// The wording of a document. It is read once for all documents of the same languages and terms, see ReadWordings.
/// \throws gum::StorageError if there is none of a language, or there are more than two languages
[[nodiscard]] Wording read_wording(const RenderAssets& assets, const EvaluationRecord& record);
/// The wording of the languages that the assets ask for, else of English.
[[nodiscard]] Wording read_wording(const RenderAssets& assets);
/// The wording of every language that the templates have, in the order of their names; behind one that a laboratory has changed
/// the same with its own texts.
/// \throws gum::StorageError if one cannot be read
[[nodiscard]] std::vector<nlohmann::json> read_every_wording(const std::filesystem::path& templates);
/// The wording of an audit, in the first of the languages: with what audits say of files.
[[nodiscard]] Wording read_audit_wording(const RenderAssets& assets);

}  // namespace gumcert::reports
