#pragma once

#include "reports/program_sentences.h"
#include "reports/record/evaluation_record.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace gumcert::reports {

/// Every sentence that the program put into a record in English (findings, remarks, notes, messages), each once. What
/// a person wrote is not among them.
[[nodiscard]] std::vector<std::string> program_sentences_of(const EvaluationRecord& record);

/// The catalogue of the program, read before an evaluation that would be lost without it. As long as the file stays the same,
/// all evaluations of a process share it. Any thread may ask.
/// \param templates  folder with wording/sentences.json
/// \throws gum::StorageError if it is missing or damaged
[[nodiscard]] std::shared_ptr<const ProgramSentences> read_sentences(const std::filesystem::path& templates);

/// Fills EvaluationRecord::statements from the catalogue of ProgramSentences. A sentence that the catalogue does not
/// know has no entry; documents print it in English.
void identify_sentences(EvaluationRecord& record, const ProgramSentences& catalogue);

}  // namespace gumcert::reports
