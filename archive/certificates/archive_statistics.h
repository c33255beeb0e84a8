#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "archive/archive.h"

namespace gumcert::archive {

/// Scatter of the repeated readings of one input, in one certificate.
struct ArchivedScatter {
    std::string number;               ///< of the certificate
    std::string day;                  ///< last day of the work; "" where the record states none
    double mean = 0.0;                ///< of the readings, [unit of the input]
    double standard_deviation = 0.0;  ///< of a reading, [unit of the input]
    std::int64_t n = 0;               ///< readings
    bool has_one_step = false;        ///< its readings differ by at most one step of their last digit
    /// In statistical control a standard deviation lies below it with p = 0.99865; none where the others are all 0, or its
    /// readings have one step.
    std::optional<double> limit = {};
    [[nodiscard]] bool is_above() const { return limit && standard_deviation > *limit; }
};

/// A control chart of standard deviations: readings of the same input of the same method near the same value. Near is
/// within 5 % of the smallest one; readings whose mean is less than ten usual standard deviations away from 0 are near 0.
/// Usual is the median of all sets of this input: what a set is compared with does not depend on its own scatter. Only a set that
/// scatters beyond the limit of a chart, and so much that its readings may be of a value of it, is in it as well.
///
/// The limit of a set with ν degrees of freedom is s_o √F(ν, ν_o; 0.99865), where s_o pools the other sets of the chart: a ratio of
/// variances that are independent of each other, so that it is exact for any number of sets.
struct RepeatabilityChart {
    std::string method, input, unit;
    double near = 0.0;                       ///< the mean of the readings that is next to 0, [unit]; 0: near 0
    double pooled_standard_deviation = 0.0;  ///< √(Σ ν s² / Σ ν), [unit]
    std::int64_t degrees_of_freedom = 0;     ///< Σ ν
    std::vector<ArchivedScatter> scatters;   ///< by day, then by number
};

/// Readings that no chart has, because no others are near them: nobody can say whether they are in control.
struct UnchartedScatter {
    std::string method = {}, input = {}, unit = {};
    ArchivedScatter scatter;
};

/// E_n scores of one certificate or report of a comparison.
struct ArchivedScores {
    std::string number, day;
    std::size_t scores = 0, above_one = 0;  ///< of |E_n|
    double largest = 0.0;                   ///< |E_n|
};

/// What an archive says of the work of a laboratory. What was not issued is counted by state only.
struct ArchiveStatistics {
    std::map<std::string, std::size_t> by_state;
    std::map<std::string, std::size_t> by_kind, by_method;  ///< certificates that were issued
    LogTimes::SetBack set_back;  ///< entries after clocks that were ahead: months of issue may be those of such a clock
    std::map<std::string, std::size_t> by_month;  ///< of issue by the log, "2026-11"; certificates that were issued
    std::map<std::string, std::size_t> by_authoriser;  ///< person of the log; certificates that were issued
    std::size_t amendments = 0;               ///< certificates that were issued and amend or replace another one
    std::vector<std::string> not_read;        ///< certificates whose records cannot be read
    std::vector<ArchivedScores> scores;       ///< by day, then by number
    std::vector<RepeatabilityChart> charts;   ///< of two sets of readings or more, by method, input, value
    std::vector<UnchartedScatter> uncharted;  ///< by method, input and unit, then by value
};

/// Reads all records of an archive. Withdrawn certificates are counted by state only. Of a certificate and its amendments scores
/// and readings are those of the one that holds.
[[nodiscard]] ArchiveStatistics statistics_of(Archive& archive);

/// For people: tables of counts, scores, and charts with what lies above their limits.
[[nodiscard]] std::string statistics_text(const ArchiveStatistics& statistics);
/// For programs: schema "gumcert/archive-statistics/1", with every value of the charts.
[[nodiscard]] std::string statistics_json(const ArchiveStatistics& statistics);

}  // namespace gumcert::archive
