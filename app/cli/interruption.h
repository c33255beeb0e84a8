#pragma once

#include <filesystem>
#include <string>

namespace gumcert::cli {

/// From here on SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGPIPE end the program by a thread that first ends its children
/// and removes its temporary files and folders (system/cleanup.h), says how far it came, and then lets the signal do what
/// it does. A signal that was ignored when the program began stays ignored.
/// \param json_messages  the form of what is said
void clean_up_at_signals(bool json_messages);

/// What the program is doing, for the words of an interruption.
void tell_stage(const std::string& text);
/// A file that is in its place.
void tell_written(const std::filesystem::path& file);

}  // namespace gumcert::cli
