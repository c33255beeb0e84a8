#pragma once

#include <filesystem>
#include <string>

namespace gumcert::outputs {

/// A line of a log of refusals. What is wrong with a value is not in it, nor the value.
struct Refusal {
    std::string at;       ///< UTC, "2026-11-24T18:55:00Z"
    std::string command;  ///< "run"
    std::string code;     ///< "GC-INPUT-0023"
    std::string where;    ///< the place that the message names
};

/// Adds a line to a log of refusals, an object in JSON. Lines of several commands at once do not mix. The file is made
/// where there is none, for its user only; one that is no such log is left alone.
/// \return what went wrong; "" where nothing did
[[nodiscard]] std::string append_refusal(const std::filesystem::path& log, const Refusal& refusal);

}  // namespace gumcert::outputs
