#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "archive/head.h"
#include "archive/log_times.h"
#include "archive/store/store.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

/// At most so many findings are listed of one archive.
inline constexpr std::size_t k_most_findings = 20;

/// What was found when everything was computed again.
struct Verification {
    std::size_t entries = 0, contents = 0, certificates = 0;
    LogTimes::SetBack set_back;             ///< entries after clocks that were ahead
    std::optional<Head> head;               ///< of the log as it is; none where it is empty
    std::vector<gum::Diagnostic> findings;  ///< of severity error; empty: nothing was changed
    [[nodiscard]] bool sound() const { return findings.empty(); }
};

/// Computes every hash of a store again: contents, entries, the chain, the Merkle root; holds every entry against the
/// rules of the log (archive/log_rules.h), lists and contents against the log and the other way round, the store against its own
/// checks. GC-ARCHIVE-0040 to -0046, -0052, -0053.
/// \param heads     published earlier: the log must begin with what they are heads of, GC-ARCHIVE-0045. Their signatures
///                  are not looked at here.
/// \param progress  called now and then with what is being done
[[nodiscard]] Verification verify_store(Store& store, const std::vector<Head>& heads = {},
                                        const std::function<void(const std::string&)>& progress = {});

}  // namespace gumcert::archive
