#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/evaluation_task.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/file_source.h"

namespace gumcert::evaluation {

/// A kind of jobs and of their records: everything that the program has to know of it, in one row.
struct Kind {
    std::string_view word;  ///< `kind` of the job and of its record
    /// Reads a job with all its files.
    /// \param job_file  its name in the source
    /// \return what the reader warns of
    /// \throws gum::InputError  with all that the reader refuses
    std::vector<gum::Diagnostic> (*read)(const jobs::FileSource& source, const std::string& job_file);
    /// Reads a job, evaluates it and makes its record.
    /// \throws gum::InputError, gum::NoResultError, gum::StorageError
    Evaluation (*evaluate)(const EvaluationTask& task);
    std::string_view document;                ///< name of its documents without ending: "certificate"
    std::span<const std::string_view> forms;  ///< in which `gumcert run` writes them: names of issuing/output_forms.h
};

/// The kinds of the program, in the order in which messages list them.
[[nodiscard]] std::span<const Kind> program_kinds();

/// The row with this word; none: there is no such kind.
[[nodiscard]] const Kind* find_kind(std::span<const Kind> kinds, std::string_view word);

/// The row of a record; where there is none, the first one, whose documents need nothing but results.
[[nodiscard]] const Kind& kind_of(const reports::EvaluationRecord& record, std::span<const Kind> kinds);

/// The words of all rows.
[[nodiscard]] std::vector<std::string_view> words_of(std::span<const Kind> kinds);

}  // namespace gumcert::evaluation
