#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"
#include "evaluation/limits.h"
#include "gum/quantity/progress.h"

namespace gumcert::cli {

/// From here on SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGPIPE end the program by a thread that first ends its children
/// and removes its temporary files and folders (system/cleanup.h), says how far it came, and then lets the signal do what
/// it does. A signal that was ignored when the program began stays ignored.
/// \param json_messages  the form of what is said
void clean_up_at_signals(bool json_messages);

/// Where --memory-limit and --time-limit are not given: what reading files of others may take, evaluation::walls_of().
[[nodiscard]] CommonOptions with_walls(CommonOptions common, const std::vector<std::filesystem::path>& files);

/// Keeps the command within its ceilings: one that is reached ends it by exit code 5 with a message that names it
/// (GC-STORE-0024), after its children are ended and its temporary files removed.
void keep_ceilings(const CommonOptions& common);

/// Keeps a part of a command that reads files of others within walls, where no limit was given for all of it: the rest has
/// none.
void work_within_walls(const CommonOptions& common, const std::vector<std::filesystem::path>& files,
                       const std::function<void()>& work);
/// \param whose  for the message: "for the evaluation of record.json"
void work_within_walls(const CommonOptions& common, const evaluation::Walls& walls, const std::string& whose,
                       const std::function<void()>& work);

/// The same of the time of one evaluation among many, evaluation::walls_of_evaluation(), from now on: told as progress, so that
/// it ends alone. What does not tell of its progress goes on.
/// \param record  for the message: "old.json"
/// \param files   that hold it: a large one may take longer
/// \return throws gum::StorageError, GC-STORE-0024, where its time is used up
[[nodiscard]] gum::Progress progress_within_walls(const CommonOptions& common, const std::string& record,
                                                  gum::Progress progress = {},
                                                  const std::vector<std::filesystem::path>& files = {});

/// What the program is doing, for the words of an interruption.
void tell_stage(const std::string& text);
/// A file that is in its place.
void tell_written(const std::filesystem::path& file);

/// An entry of an archive that is asked for. While it lives nobody knows whether the entry is in the log; a signal waits a
/// little for its end. None begins when a signal has been answered.
class EntryUnderWay {
public:
    EntryUnderWay();
    ~EntryUnderWay();
    EntryUnderWay(const EntryUnderWay&) = delete;
    EntryUnderWay& operator=(const EntryUnderWay&) = delete;

    /// \param entry  in words: "N-1 numbered, entry 57"
    void is_in_the_log(const std::string& entry);
};

}  // namespace gumcert::cli
