#pragma once

#include "reports/record/evaluation_record.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gumcert::reports {

/// Every sentence that the program put into a record in English (findings, remarks, notes, messages), each once. What
/// a person wrote is not among them.
[[nodiscard]] std::vector<std::string> program_sentences_of(const EvaluationRecord& record);

/// Fills EvaluationRecord::statements from the catalogue of ProgramSentences. A sentence that the catalogue does not
/// know has no entry; documents print it in English.
/// \param templates  folder with wording/sentences.json
/// \throws gum::StorageError if the catalogue is missing or damaged
void identify_sentences(EvaluationRecord& record, const std::filesystem::path& templates);

}  // namespace gumcert::reports
