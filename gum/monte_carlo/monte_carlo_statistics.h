#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gumcert::gum {

/// Count, mean, sums of powers of the deviations from the mean, and extremes of a series of numbers.
///
/// Two series are merged by the formulas of Chan, Golub and LeVeque (1979) and Pébay (2008); merged in a fixed order
/// they give the same bytes.
struct Moments {
    std::uint64_t count = 0;
    double mean = 0.0;
    double m2 = 0.0;  ///< Σ (y - mean)²
    double m3 = 0.0;  ///< Σ (y - mean)³
    double m4 = 0.0;  ///< Σ (y - mean)⁴
    double smallest = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();

    void merge(const Moments& other);

    /// √(m2 / (count - 1)); 0 for fewer than two numbers (JCGM 101:2008, 7.6)
    [[nodiscard]] double standard_deviation() const;

    /// Standard deviation of standard_deviation() from sample to sample, by the fourth moment:
    /// var(u²) ≈ (m4/M - (m2/M)² (M-3)/(M-1)) / M. Never above u itself, which is what it comes to where a few values
    /// of a heavy tail make up the whole of u.
    [[nodiscard]] double error_of_standard_deviation() const;
};

/// \param values  count numbers. If one is not finite, the mean is not finite either.
[[nodiscard]] Moments moments_of(const double* values, Eigen::Index count);

/// Σ (a - mean_a)(b - mean_b)
[[nodiscard]] double sum_of_products(const double* a, double mean_a, const double* b, double mean_b,
                                     Eigen::Index count);

/// Ranks of the ends of coverage intervals among M numbers in ascending order, the first of rank 0.
struct CoverageRanks {
    std::uint64_t inside = 0;  ///< q = integer part of pM + 1/2, at most M - 1: the upper end has rank low + q
    std::uint64_t low =
        0;  ///< of the symmetric interval: r - 1 with r = (M - q)/2, or half more (JCGM 101:2008, 7.7.2)

    CoverageRanks(double coverage_probability, std::uint64_t trials);
};

/// An order statistic, and what is not known of it.
struct RankValue {
    double value = 0.0;
    double resolution = 0.0;  ///< half the width of the bin that holds it; 0: exact
};

/// Shortest interval with a given number of values inside.
struct ShortestRange {
    RankValue low;
    RankValue high;
};

/// Shortest of the intervals y_(r) … y_(r+inside) of M values in any order, the first one where several are equally
/// short (JCGM 101:2008, 7.7.4 in the notation of order statistics). Rearranges the values.
[[nodiscard]] ShortestRange shortest_range(std::span<double> values, std::uint64_t inside);

/// Exact order statistics, and the exact shortest interval, of a series of numbers that is too long to keep, in a few
/// passes over it: the first counts how many values fall into each of many bins, and the bins then tell which values
/// can matter; only those are collected and sorted. If they are too many, the bins that matter are divided by 256 and
/// counted again. No pass depends on the order of the values.
///
/// Bins are ranges of the sign and leading bits of y - c, with c and the finest size taken from the first values: bins
/// of one relative width in the distance from the middle, up to any distance. They need no range, and heavy tails do
/// them no harm.
class RankSearch {
public:
    /// What one worker adds up in one pass.
    struct Tally {
        std::vector<std::uint64_t> counts;
        std::vector<double> values;
    };

    /// \param pilot      first values of the series, at least one; they set the bins, not the results
    /// \param bits       bins of an octave of |y - c|: 2^bits, 2 … 12
    /// \param most_values  how many may be collected
    RankSearch(std::span<const double> pilot, int bits, std::uint64_t most_values);

    /// Order statistics that are wanted; before the first pass is finished.
    void want_rank(std::uint64_t rank) { ranks_.push_back(rank); }
    void want_shortest(std::uint64_t inside) { inside_ = inside; }

    [[nodiscard]] bool is_done() const { return stage_ == Stage::done; }
    [[nodiscard]] Tally tally() const;
    void add(const double* values, Eigen::Index count, Tally& tally) const;
    void absorb(Tally& tally);

    /// All values of the series have been added once more.
    /// \param smallest, largest  of the series
    void finish_pass(double smallest, double largest);

    [[nodiscard]] RankValue value(std::uint64_t rank) const;
    [[nodiscard]] ShortestRange shortest() const { return shortest_; }

private:
    enum class Stage { counting, collecting, done };
    struct Bin {
        std::int64_t low = 0;  // keys, both inside
        std::int64_t high = 0;
        std::int64_t leaf = -1;  // in the counts of the present level; -1: counted before and left alone
        std::uint64_t count = 0;
        std::uint64_t start = 0;     // rank of its smallest value
        std::uint64_t position = 0;  // of that in the collected values
        bool wanted = false;         // its values have to be collected
        bool may_begin = false;      // the shortest interval may begin in it
    };
    struct Level {
        int shift = 0;                    // bits of the key that its bins leave out
        std::vector<std::int32_t> slots;  // of the leaves of the level above; -1: not divided
    };

    [[nodiscard]] std::int64_t key(double y) const;
    [[nodiscard]] std::int64_t leaf(double y) const;
    [[nodiscard]] double low_edge(const Bin& bin) const;
    [[nodiscard]] double high_edge(const Bin& bin) const;
    [[nodiscard]] std::size_t bin_of(std::uint64_t rank) const;
    [[nodiscard]] RankValue between_edges(const Bin& bin) const;
    void take_counts();
    std::uint64_t mark_wanted(bool with_shortest);
    bool divide();
    void begin_collecting();
    void find_shortest();
    void estimate_shortest();

    double centre_ = 0.0;
    std::int64_t base_ = 0;  // bits of the smallest |y - c| that is told from 0
    std::int64_t top_key_ = 0;
    std::int64_t offset_ = 0;  // leaf of key 0
    std::uint64_t most_values_;
    std::vector<std::uint64_t> ranks_;
    std::uint64_t inside_ = 0;  // 0: no shortest interval wanted
    Stage stage_ = Stage::counting;
    std::vector<Level> levels_;
    std::vector<Bin> bins_;  // ascending, without empty ones once counted
    std::vector<std::uint64_t> counts_;
    std::vector<char> collected_leaves_;
    std::vector<double> values_;
    double smallest_ = 0.0;
    double largest_ = 0.0;
    ShortestRange shortest_;
};

}  // namespace gumcert::gum
