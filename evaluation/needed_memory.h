#pragma once

#include <cstdint>
#include <optional>

#include "evaluation/evaluation_task.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::evaluation {

/// Says of a job that it takes much memory, before it does: GC-STORE-0026, an error where it is more than it may take, else a
/// note from 1 GB on.
/// \param most  that it may take, [byte]; 0: no limit
[[nodiscard]] std::optional<gum::Diagnostic> needed_memory(const ReadJob& job, std::uint64_t most);

}  // namespace gumcert::evaluation
