#include "gum/monte_carlo/monte_carlo_statistics.h"
#include "gum/quantity/special_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/sort/pdqsort/pdqsort.hpp>
#include <cmath>

namespace gumcert::gum {
namespace {

// 42 octaves of 2^10 bins on each side of the centre are 86 000 counts, 0.7 MB a worker and output. Four levels tell
// values apart by 10 + 3·8 = 34 leading bits of their distance from the centre.
constexpr int k_octaves_below = 20;  // of the spread of the pilot values, told apart from the centre
constexpr int k_octaves_above = 22;
constexpr int k_division_bits = 8;
constexpr std::size_t k_most_levels = 4;
constexpr std::size_t k_most_leaves = std::size_t{1} << 22;

constexpr std::size_t k_lanes = 8;  // partial sums, added up in a fixed order: what wide registers do, without them too
using Lanes = std::array<double, k_lanes>;

double sum(const Lanes& lanes) {
    return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

}  // namespace

void Moments::merge(const Moments& other) {
    if (other.count == 0) {
        return;
    }
    if (count == 0) {
        *this = other;
        return;
    }
    // Central moments of two parts, moved to the mean of both: no second pass over the trials, and none of the
    // cancellation of raw powers.
    const double na = static_cast<double>(count);
    const double nb = static_cast<double>(other.count);
    const double n = na + nb;
    const double d = other.mean - mean;
    const double d2 = d * d;
    const double share = na * nb / n;
    m4 += other.m4 + d2 * d2 * share * (na * na - na * nb + nb * nb) / (n * n) +
          6.0 * d2 * (na * na * other.m2 + nb * nb * m2) / (n * n) + 4.0 * d * (na * other.m3 - nb * m3) / n;
    m3 += other.m3 + d2 * d * share * (na - nb) / n + 3.0 * d * (na * other.m2 - nb * m2) / n;
    m2 += other.m2 + d2 * share;
    mean += d * (nb / n);
    count += other.count;
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
}

double Moments::standard_deviation() const {
    return count > 1 ? std::sqrt(m2 / static_cast<double>(count - 1)) : 0.0;
}

double Moments::error_of_standard_deviation() const {
    const double u = standard_deviation();
    if (count < 4 || !(u > 0.0)) {
        return u;
    }
    const double n = static_cast<double>(count);
    const double variance = m2 / n;
    // Var(s²) = σ⁴ (κ − (n − 3)/(n − 1))/n; of s relative to σ it is a quarter of that. Heavy tails show in κ, so that
    // the error does not rest on normal trials.
    const double relative = (m4 / n / variance / variance - (n - 3.0) / (n - 1.0)) / n;  // of u², squared
    return std::isfinite(relative) ? std::min(0.5 * std::sqrt(std::max(relative, 0.0)), 1.0) * u : u;
}

Moments moments_of(const double* values, Eigen::Index count) {
    Moments result;
    result.count = static_cast<std::uint64_t>(count);
    if (count == 0) {
        return result;
    }
    constexpr auto lanes = static_cast<Eigen::Index>(k_lanes);
    const Eigen::Index whole = count / lanes * lanes;
    Lanes total{};
    Lanes low;
    Lanes high;
    low.fill(k_infinity);
    high.fill(-k_infinity);
    for (Eigen::Index i = 0; i < whole; i += lanes) {
        for (std::size_t l = 0; l < k_lanes; ++l) {
            const double y = values[i + static_cast<Eigen::Index>(l)];
            total[l] += y;
            low[l] = y < low[l] ? y : low[l];
            // Written so that a NaN never takes the place of an extreme; the mean tells that there is one.
            high[l] = y > high[l] ? y : high[l];
        }
    }
    for (Eigen::Index i = whole; i < count; ++i) {
        total[0] += values[i];
        low[0] = std::min(low[0], values[i]);
        high[0] = std::max(high[0], values[i]);
    }
    // Two passes: the moments are taken about the mean, never from sums of powers.
    result.mean = sum(total) / static_cast<double>(count);
    result.smallest = *std::min_element(low.begin(), low.end());
    result.largest = *std::max_element(high.begin(), high.end());

    const double mean = result.mean;
    Lanes s1{};
    Lanes s2{};
    Lanes s3{};
    Lanes s4{};
    for (Eigen::Index i = 0; i < whole; i += lanes) {
        for (std::size_t l = 0; l < k_lanes; ++l) {
            const double d = values[i + static_cast<Eigen::Index>(l)] - mean;
            const double d2 = d * d;
            s1[l] += d;
            s2[l] += d2;
            s3[l] += d2 * d;
            s4[l] += d2 * d2;
        }
    }
    for (Eigen::Index i = whole; i < count; ++i) {
        const double d = values[i] - mean;
        const double d2 = d * d;
        s1[0] += d;
        s2[0] += d2;
        s3[0] += d2 * d;
        s4[0] += d2 * d2;
    }
    // What rounding left of Σ d corrects the mean and the sums to the first order.
    // Σ d² − n r², Σ d³ − 3 r Σ d², Σ d⁴ − 4 r Σ d³ with r the mean that is left of d.
    const double rest = sum(s1) / static_cast<double>(count);
    result.mean = mean + rest;
    result.m2 = std::max(sum(s2) - rest * rest * static_cast<double>(count), 0.0);
    result.m3 = sum(s3) - 3.0 * rest * sum(s2);
    result.m4 = sum(s4) - 4.0 * rest * sum(s3);
    return result;
}

double sum_of_products(const double* a, double mean_a, const double* b, double mean_b, Eigen::Index count) {
    constexpr auto lanes = static_cast<Eigen::Index>(k_lanes);
    const Eigen::Index whole = count / lanes * lanes;
    Lanes total{};
    for (Eigen::Index i = 0; i < whole; i += lanes) {
        for (std::size_t l = 0; l < k_lanes; ++l) {
            const Eigen::Index at = i + static_cast<Eigen::Index>(l);
            total[l] += (a[at] - mean_a) * (b[at] - mean_b);
        }
    }
    for (Eigen::Index i = whole; i < count; ++i) {
        total[0] += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return sum(total);
}

CoverageRanks::CoverageRanks(double coverage_probability, std::uint64_t trials) {
    const auto wanted =
        // q = pM rounded, r = (M − q)/2 (JCGM 101:2008, 7.7.2).
        static_cast<std::uint64_t>(std::floor(coverage_probability * static_cast<double>(trials) + 0.5));
    // One value at least stays outside, or the interval could not be shortest anywhere.
    inside = trials > 1 ? std::clamp<std::uint64_t>(wanted, 1, trials - 1) : 0;
    const std::uint64_t outside = trials - inside;
    // r = (M − q)/2, or (M − q + 1)/2 where that is no whole number; here as a rank from 0.
    low = (outside + 1) / 2 - 1;
}

ShortestRange shortest_range(std::span<double> values, std::uint64_t inside) {
    // Only the values that can begin or end an interval are put in order.
    const auto ends = static_cast<std::ptrdiff_t>(values.size() - inside);
    if (2 * ends < static_cast<std::ptrdiff_t>(values.size())) {
        std::nth_element(values.begin(), values.begin() + ends, values.end());
        std::nth_element(values.begin() + ends, values.end() - ends, values.end());
        boost::sort::pdqsort(values.begin(), values.begin() + ends);
        boost::sort::pdqsort(values.end() - ends, values.end());
    } else {
        boost::sort::pdqsort(values.begin(), values.end());
    }
    std::size_t best = 0;
    for (std::size_t r = 1; r + inside < values.size(); ++r) {
        // Only a shorter interval takes the place: of equally short ones the lowest stays, in whatever way the values
        // were sorted.
        if (values[r + inside] - values[r] < values[best + inside] - values[best]) {
            best = r;
        }
    }
    return {.low = {.value = values[best]}, .high = {.value = values[best + inside]}};
}

RankSearch::RankSearch(std::span<const double> pilot, int bits, std::uint64_t most_values) : most_values_(most_values) {
    std::vector<double> sorted(pilot.begin(), pilot.end());
    boost::sort::pdqsort(sorted.begin(), sorted.end());
    const std::size_t n = sorted.size();
    // Median and sixths of the pilot values: heavy tails do not move them.
    centre_ = sorted[n / 2];
    // About one standard deviation of the bulk: a standard deviation itself would follow a single outlier.
    double spread = 0.5 * (sorted[n - 1 - n / 6] - sorted[n / 6]);
    // More than two thirds of the pilot values are equal: their range, then. All equal: any size that is small beside
    // them.
    if (!(spread > 0.0)) {
        spread = 0.5 * (sorted.back() - sorted.front());
    }
    if (!(spread > 0.0) || !std::isfinite(spread)) {
        spread = std::abs(centre_) * 0x1p-20;
    }
    // 20 octaves below and 22 above stay within the exponents of normal doubles, −1022 to 1023.
    spread = std::clamp(spread, 0x1p-900, 0x1p900);
    const int shift = 52 - bits;
    // The bits of a positive double, read as a whole number, rise with it: bins are cut on these bits, fine near the
    // centre and coarse far out, without knowing the range of the trials beforehand.
    base_ = std::bit_cast<std::int64_t>(std::ldexp(1.0, std::ilogb(spread) - k_octaves_below));
    top_key_ = (std::int64_t{k_octaves_below + k_octaves_above} << 52) - 1;
    offset_ = (top_key_ >> shift) + 1;
    levels_.push_back({.shift = shift, .slots = {}});
    counts_.assign(static_cast<std::size_t>(2 * offset_), 0);
}

inline std::int64_t RankSearch::key(double y) const {
    // ± (bits of |y − c| − bits of the smallest size told from 0), cut off at 0 and at the last octave. Neither this
    // nor the rounding of y − c ever changes the order of two values: on that all counts of ranks rest.
    const auto bits = std::bit_cast<std::int64_t>(y - centre_);
    const std::int64_t sign = bits >> 63;
    const std::int64_t size = (bits & std::numeric_limits<std::int64_t>::max()) - base_;
    return (std::clamp(size, std::int64_t{0}, top_key_) ^ sign) - sign;
}

inline std::int64_t RankSearch::leaf(double y) const {
    const std::int64_t k = key(y);
    std::int64_t at = (k >> levels_[0].shift) + offset_;
    for (std::size_t l = 1; l < levels_.size(); ++l) {
        const std::int32_t slot = levels_[l].slots[static_cast<std::size_t>(at)];
        if (slot < 0) {
            return -1;
        }
        // The next bits of the key say which part of the divided bin it is.
        constexpr std::int64_t within = (std::int64_t{1} << k_division_bits) - 1;
        at = (std::int64_t{slot} << k_division_bits) + ((k >> levels_[l].shift) & within);
    }
    return at;
}

RankSearch::Tally RankSearch::tally() const {
    return {.counts = std::vector<std::uint64_t>(stage_ == Stage::counting ? counts_.size() : 0, 0), .values = {}};
}

void RankSearch::add(const double* values, Eigen::Index count, Tally& tally) const {
    if (stage_ == Stage::counting) {
        if (levels_.size() == 1) {
            std::uint64_t* counts = tally.counts.data() + offset_;
            const int shift = levels_[0].shift;
            for (Eigen::Index i = 0; i < count; ++i) {
                ++counts[key(values[i]) >> shift];
            }
            return;
        }
        for (Eigen::Index i = 0; i < count; ++i) {
            const std::int64_t at = leaf(values[i]);
            if (at >= 0) {
                ++tally.counts[static_cast<std::size_t>(at)];
            }
        }
    } else if (stage_ == Stage::collecting) {
        for (Eigen::Index i = 0; i < count; ++i) {
            const std::int64_t at = leaf(values[i]);
            if (at >= 0 && collected_leaves_[static_cast<std::size_t>(at)] != 0) {
                tally.values.push_back(values[i]);
            }
        }
    }
}

void RankSearch::absorb(Tally& tally) {
    if (stage_ == Stage::counting) {
        // Counts are whole numbers and collected values are sorted later: the order in which the threads deliver is not
        // seen.
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            counts_[i] += tally.counts[i];
        }
    } else if (stage_ == Stage::collecting) {
        values_.insert(values_.end(), tally.values.begin(), tally.values.end());
    }
}

double RankSearch::low_edge(const Bin& bin) const {
    if (bin.low <= -top_key_) {
        return smallest_;
    }
    const double d = bin.low > 0 ? std::bit_cast<double>(base_ + bin.low) : -std::bit_cast<double>(base_ + 1 - bin.low);
    // y − c was rounded when it got its key, and c + d is rounded here: no value of the bin lies beyond the edge.
    const double slack = 4.0 * std::numeric_limits<double>::epsilon() * (std::abs(centre_) + std::abs(d));
    return std::max(smallest_, centre_ + d - slack);
}

double RankSearch::high_edge(const Bin& bin) const {
    if (bin.high >= top_key_) {
        return largest_;
    }
    const double d =
        bin.high >= 0 ? std::bit_cast<double>(base_ + 1 + bin.high) : -std::bit_cast<double>(base_ - bin.high);
    const double slack = 4.0 * std::numeric_limits<double>::epsilon() * (std::abs(centre_) + std::abs(d));
    return std::min(largest_, centre_ + d + slack);
}

std::size_t RankSearch::bin_of(std::uint64_t rank) const {
    const auto after =
        std::partition_point(bins_.begin(), bins_.end(), [&](const Bin& bin) { return bin.start + bin.count <= rank; });
    return static_cast<std::size_t>(after - bins_.begin());
}

std::uint64_t RankSearch::mark_wanted(bool with_shortest) {
    // Marks are found anew in each pass: with narrower bins fewer of them can matter.
    for (Bin& bin : bins_) {
        bin.wanted = false;
        bin.may_begin = false;
    }
    for (const std::uint64_t rank : ranks_) {
        bins_[bin_of(rank)].wanted = true;
    }
    if (with_shortest) {
        const std::uint64_t all = bins_.back().start + bins_.back().count;
        const std::uint64_t last = all - inside_ - 1;  // rank where the last interval begins
        // From the edges of the bins: no interval that begins in a bin is shorter than from its upper edge to the lower
        // edge of the bin where it ends. A bin whose shortest possible interval is longer than the longest possible one of
        // another bin cannot hold it.
        double shortest_at_most = k_infinity;
        std::size_t begin = 0;
        for (const Bin& bin : bins_) {
            if (bin.count == 0 || bin.start > last) {
                continue;
            }
            while (bins_[begin].start + bins_[begin].count <= bin.start + inside_) {
                ++begin;
            }
            shortest_at_most = std::min(shortest_at_most, high_edge(bins_[begin]) - low_edge(bin));
        }
        begin = 0;
        std::size_t end = 0;
        for (Bin& bin : bins_) {
            if (bin.count == 0 || bin.start > last) {
                continue;
            }
            const std::uint64_t first_end = bin.start + inside_;
            const std::uint64_t last_end = std::min(bin.start + bin.count - 1, last) + inside_;
            // Ranks rise with the bins: both ends only move on, and one pass over the bins is enough.
            while (bins_[begin].start + bins_[begin].count <= first_end) {
                ++begin;
            }
            end = std::max(begin, end);
            while (bins_[end].start + bins_[end].count <= last_end) {
                ++end;
            }
            if (low_edge(bins_[begin]) - high_edge(bin) <= shortest_at_most) {
                bin.may_begin = true;
                bin.wanted = true;
                for (std::size_t i = begin; i <= end; ++i) {
                    bins_[i].wanted = true;
                }
            }
        }
    }
    std::uint64_t total = 0;
    for (Bin& bin : bins_) {
        bin.wanted = bin.wanted && bin.count > 0;
        total += bin.wanted ? bin.count : 0;
    }
    return total;
}

bool RankSearch::divide() {
    const int shift = levels_.back().shift;
    const auto wanted =
        static_cast<std::size_t>(std::count_if(bins_.begin(), bins_.end(), [](const Bin& bin) { return bin.wanted; }));
    constexpr std::size_t parts = std::size_t{1} << k_division_bits;
    // No bits are left to divide by, or the counts would not fit into memory.
    if (levels_.size() >= k_most_levels || shift < k_division_bits || wanted * parts > k_most_leaves) {
        return false;
    }
    // A bin of an earlier level that was left alone then may matter now only if it mattered then: bins get narrower.
    if (std::any_of(bins_.begin(), bins_.end(), [](const Bin& bin) { return bin.wanted && bin.leaf < 0; })) {
        return false;
    }
    Level level{.shift = shift - k_division_bits, .slots = std::vector<std::int32_t>(counts_.size(), -1)};
    std::vector<Bin> bins;
    bins.reserve(bins_.size() + wanted * (parts - 1));
    std::int32_t slot = 0;
    for (const Bin& bin : bins_) {
        if (!bin.wanted) {
            bins.push_back(bin);
            bins.back().leaf = -1;
            continue;
        }
        level.slots[static_cast<std::size_t>(bin.leaf)] = slot;
        for (std::size_t part = 0; part < parts; ++part) {
            Bin piece;
            piece.low = bin.low + static_cast<std::int64_t>(part) * (std::int64_t{1} << level.shift);
            piece.high = piece.low + (std::int64_t{1} << level.shift) - 1;
            piece.leaf = (std::int64_t{slot} << k_division_bits) + static_cast<std::int64_t>(part);
            bins.push_back(piece);
        }
        ++slot;
    }
    bins_ = std::move(bins);
    counts_.assign(wanted * parts, 0);
    levels_.push_back(std::move(level));
    return true;
}

void RankSearch::begin_collecting() {
    collected_leaves_.assign(counts_.size(), 0);
    // The counts say how many values each bin will bring, so that each has its place before the first one comes.
    std::uint64_t position = 0;
    for (Bin& bin : bins_) {
        if (bin.wanted) {
            collected_leaves_[static_cast<std::size_t>(bin.leaf)] = 1;
            bin.position = position;
            position += bin.count;
        }
    }
    values_.reserve(position);
    stage_ = Stage::collecting;
}

void RankSearch::take_counts() {
    if (levels_.size() == 1) {
        const std::int64_t width = std::int64_t{1} << levels_[0].shift;
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            if (counts_[i] > 0) {
                Bin& bin = bins_.emplace_back();
                bin.low = (static_cast<std::int64_t>(i) - offset_) * width;
                bin.high = bin.low + width - 1;
                bin.leaf = static_cast<std::int64_t>(i);
            }
        }
    }
    for (Bin& bin : bins_) {
        if (bin.leaf >= 0) {
            bin.count = counts_[static_cast<std::size_t>(bin.leaf)];
        }
    }
    std::erase_if(bins_, [](const Bin& bin) { return bin.count == 0; });
    std::uint64_t start = 0;
    for (Bin& bin : bins_) {
        bin.start = start;
        start += bin.count;
    }
}

void RankSearch::finish_pass(double smallest, double largest) {
    smallest_ = smallest;
    largest_ = largest;
    if (stage_ == Stage::collecting) {
        // Sorting takes away the order in which threads delivered the values.
        boost::sort::pdqsort(values_.begin(), values_.end());
        if (inside_ > 0) {
            find_shortest();
        }
        stage_ = Stage::done;
        return;
    }
    // Collect what is wanted as soon as it fits the memory; else divide and count again; else the bins are the answer.
    take_counts();
    if (smallest == largest) {
        shortest_ = {.low = {.value = smallest}, .high = {.value = smallest}};
        stage_ = Stage::done;
        return;
    }
    const bool with_shortest = inside_ > 0;
    if (mark_wanted(with_shortest) <= most_values_) {
        begin_collecting();
        return;
    }
    if (divide()) {
        return;
    }
    // The values that matter stay too many, as where very many are equal. The bins themselves are the answer then.
    if (with_shortest) {
        estimate_shortest();
        inside_ = 0;
    }
    if (mark_wanted(false) <= most_values_ &&
        std::all_of(bins_.begin(), bins_.end(), [](const Bin& bin) { return !bin.wanted || bin.leaf >= 0; })) {
        begin_collecting();
    } else {
        for (Bin& bin : bins_) {
            bin.wanted = false;
        }
        stage_ = Stage::done;
    }
}

void RankSearch::find_shortest() {
    const std::uint64_t all = bins_.back().start + bins_.back().count;
    const std::uint64_t last = all - inside_ - 1;
    // The end rises with the beginning: both go once through the values. Only a shorter interval takes the place, so
    // that of equally short ones the lowest stays.
    double best = k_infinity;
    std::size_t end = 0;
    for (const Bin& bin : bins_) {
        if (!bin.may_begin) {
            continue;
        }
        for (std::uint64_t i = 0; i < bin.count && bin.start + i <= last; ++i) {
            const std::uint64_t end_rank = bin.start + i + inside_;
            while (bins_[end].start + bins_[end].count <= end_rank) {
                ++end;
            }
            const double low = values_[bin.position + i];
            const double high = values_[bins_[end].position + (end_rank - bins_[end].start)];
            if (high - low < best) {
                best = high - low;
                shortest_ = {.low = {.value = low}, .high = {.value = high}};
            }
        }
    }
}

RankValue RankSearch::between_edges(const Bin& bin) const {
    const double low = low_edge(bin);
    const double high = high_edge(bin);
    // Anywhere in the bin: the middle, and half its width is the error that is stated with it.
    return {.value = low + 0.5 * (high - low), .resolution = 0.5 * (high - low)};
}

void RankSearch::estimate_shortest() {
    const std::uint64_t last = bins_.back().start + bins_.back().count - inside_ - 1;
    double best = k_infinity;
    for (const Bin& bin : bins_) {
        if (bin.count == 0 || bin.start > last) {
            continue;
        }
        const RankValue low = between_edges(bin);
        const RankValue high = between_edges(bins_[bin_of(bin.start + inside_)]);
        if (high.value - low.value < best) {
            best = high.value - low.value;
            shortest_ = {.low = low, .high = high};
        }
    }
}

RankValue RankSearch::value(std::uint64_t rank) const {
    if (smallest_ == largest_) {
        return {.value = smallest_};
    }
    const Bin& bin = bins_[bin_of(rank)];
    return bin.wanted ? RankValue{.value = values_[bin.position + (rank - bin.start)]} : between_edges(bin);
}

}  // namespace gumcert::gum
