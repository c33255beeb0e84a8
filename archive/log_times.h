#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "archive/store/entry.h"

namespace gumcert::archive {

/// "2026-11-24T18:52:52Z", as entries, heads and statements have times: one that there is.
[[nodiscard]] bool is_utc_time(std::string_view text);
/// Such a time as seconds since 1970-01-01.
[[nodiscard]] std::int64_t seconds_of(std::string_view at);

/// Member of a body: what the clock said, where that was earlier than the entry before, which a clock that was ahead has
/// written. The entry has the time of that one. (docs/adr/0087-a-clock-that-was-ahead.md)
inline constexpr const char* k_clock = "clock";
/// What the clock of an entry said, where its body states it; "" else, and where it is no time before that of the entry.
[[nodiscard]] std::string clock_of(const LogEntry& entry);

inline constexpr const char* k_clock_rule =
    "a clock that was set right is not behind one that was, and goes back no further than the log once went ahead";

/// How far a clock goes back that was set right after it was ahead, over a whole log. An entry that states its clock says of
/// all entries with later times that their clock was ahead; were nothing demanded of it, a keeper could so take numbers and issue
/// certificates of the year before. (docs/adr/0088-how-far-a-clock-goes-back.md)
class LogTimes {
public:
    /// Takes an entry in any case.
    /// \return what its clock breaks of k_clock_rule, in words; "" where nothing
    std::string take(const LogEntry& entry);

    /// What whoever looks at the log should know of it.
    struct SetBack {
        std::size_t entries = 0;       ///< that state their clock
        std::size_t ahead = 0;         ///< entries before them with later times
        std::size_t certificates = 0;  ///< that have such entries
        std::string earliest;          ///< of the clocks that were stated; "" without
        std::int64_t seq = 0;          ///< of its entry
    };
    [[nodiscard]] SetBack set_back() const;
    /// Sequence numbers of the entries that a later one says were written by a clock that was ahead.
    [[nodiscard]] std::set<std::int64_t> ahead() const;

private:
    struct Taken {
        std::int64_t seq = 0;
        std::int64_t at = 0;                ///< [s]
        std::optional<std::int64_t> clock;  ///< [s]
        std::string certificate;
    };
    std::vector<Taken> taken_;
    std::optional<std::int64_t> first_, last_, latest_clock_;  // [s]
    std::int64_t offset_ = 0;  // of the last entry with a clock, before the latest clock [s]
    std::int64_t step_ = 0;    // largest one from entry to entry since then [s]
    std::string earliest_;
    std::int64_t seq_of_earliest_ = 0;
};

/// The same for programs.
[[nodiscard]] nlohmann::json to_json(const LogTimes::SetBack& set_back);
/// The same as a line for a reader; "" where no entry states its clock.
[[nodiscard]] std::string in_words(const LogTimes::SetBack& set_back);

}  // namespace gumcert::archive
