#pragma once

#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "jobs/file_source.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"
#include "text/place.h"

namespace gumcert::jobs {

/// The files of one job while it is read: their content, and for each the list of its problems.
///
/// Names in a job are relative to it: those of a job "budgets/fixture.json" are looked for, and named in messages, as
/// "budgets/…".
class JobFiles {
public:
    JobFiles(const FileSource& source, const std::string& job_file);

    struct File {
        std::string bytes;
        ProblemList* problems = nullptr;  ///< lives as long as the JobFiles
    };
    /// The job itself.
    /// \throws StorageError  if it cannot be read
    [[nodiscard]] File job();
    /// A file that the job names; nothing when it cannot be read, which is noted.
    [[nodiscard]] std::optional<File> open(const std::string& name);
    /// The same of a file that need not be there: nothing is noted then.
    [[nodiscard]] std::optional<File> open_if_there(const std::string& name);
    /// The bytes of a file that is opened later, for what has to be known before; nothing is noted.
    [[nodiscard]] std::optional<std::string> peek(const std::string& name) const;
    /// Names without ".json" of the JSON files in a folder, "lab/standards/", for messages; none where nobody can say.
    [[nodiscard]] std::vector<std::string> json_files(const std::string& folder) const;
    /// What stands before the names of files of the laboratory, where the caller named its folder; else nothing.
    [[nodiscard]] std::optional<std::string> laboratory() const;

    /// A file name under a key: relative to the job, with / between folders.
    /// \return nothing when it is absent or was refused
    [[nodiscard]] static std::optional<std::string> file_name(const JsonObject& object, std::string_view key,
                                                              bool required);
    /// Why a text is not acceptable as such a file name; nothing when it is.
    [[nodiscard]] static std::optional<std::string> file_name_objection(std::string_view name);

    /// Takes over what another reader found in the files of a job of its own, which this job names.
    void add(const std::vector<std::string>& names, const std::vector<gum::Diagnostic>& warnings);
    void add(const gum::InputError& error);
    void add(const gum::StorageError& error);

    /// \throws StorageError  if a file could not be read; with the problems of the other files after it
    /// \throws InputError    with every problem of every file, those of the job first
    void refuse_if_needed() const;
    [[nodiscard]] std::vector<gum::Diagnostic> warnings() const;
    /// Names as the job gives them, after the folder of the job in the source, each once, the job first.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

private:
    [[nodiscard]] std::string name_in_source(const std::string& name_in_job) const;
    [[nodiscard]] std::optional<std::string> peek_source(const std::string& name_in_source) const;
    /// Where the job names a file; "" where it does not, as of those that other files name.
    [[nodiscard]] std::string place_of(const std::string& name_in_job) const;

    const FileSource& source_;
    std::string folder_;  ///< of the job in the source, with its /; empty at the top
    std::vector<std::string> names_;
    std::deque<ProblemList> problems_;  ///< a deque because readers keep addresses of its elements
    std::vector<gum::Diagnostic> not_readable_;
    std::vector<gum::Diagnostic> refused_elsewhere_;
    std::vector<gum::Diagnostic> warnings_elsewhere_;
};

/// One field of the header of a table.
struct CsvHeaderField {
    std::string name;
    text::Place place;
};

/// The names in the first line of a table that is not blank, for readers whose columns are not known beforehand.
///
/// None where the line is no UTF-8 text or its columns are separated by what read_csv_table refuses: that says what is
/// wrong. A field in double quotes is taken without them.
[[nodiscard]] std::vector<CsvHeaderField> csv_header(std::string_view bytes);

/// The keys of an object of a document in the order in which they stand in the file, which nlohmann-json forgets.
[[nodiscard]] std::vector<std::string> keys_in_order(const JsonDocument& document, const std::string& pointer);

}  // namespace gumcert::jobs
