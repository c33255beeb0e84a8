#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace gumcert::signing {

/// Runs a program without a shell and with a small environment of its own, gives it a text and takes what it says until
/// it ends. It leads a process group of its own, and what it has started in it ends with it, at the time limit at the
/// latest; a terminal of the command is lent to it, so that it can ask for a PIN.
/// \param command  path of the program, then its words
/// \param input    at most 4096 bytes
/// \return standard output, at most 1 MB
/// \throws gum::StorageError  GC-SIGN-0020 if it cannot be started, ends with a status other than 0, or takes too long
[[nodiscard]] std::string run_program(const std::vector<std::string>& command, const std::string& input,
                                      std::chrono::seconds time_limit);

}  // namespace gumcert::signing
