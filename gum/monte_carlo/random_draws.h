#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gum/monte_carlo/correlated_normal.h"
#include "gum/quantity/distribution.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

class WorkerThreads;

/// The four words of Philox 4x64-10 for a key and a counter (Salmon, Moraes, Dror, Shaw: Parallel random numbers: as
/// easy as 1, 2, 3; SC11, 2011): the one source of randomness of the Monte Carlo method here.
[[nodiscard]] std::array<std::uint64_t, 4> philox_4x64_10(const std::array<std::uint64_t, 2>& key,
                                                          const std::array<std::uint64_t, 4>& counter);

/// Quantile function of a standard distribution, tabulated for drawing.
///
/// A half of the distribution (below or above the median) is described by the probability q of the tail beyond a value,
/// 0 < q < 1/2. Each octave of q has 128 cells of equal width with a cubic piece (Hermite: exact quantiles and slopes
/// at the ends), from q = 1/2 down to 2^-14: the same relative fineness everywhere. A cell where the cubic misses the
/// quantile by more than 1e-9 relative, as where the density has a bend, holds NaN, as do all q below 2^-14: there the
/// exact quantile function is asked. (Relative to the quantile, or to 0.1 near the middle of a symmetric distribution.)
class QuantileTable {
public:
    enum class Filled { now, later };

    /// \param distribution  without a problem; its location and scale are left out of the table
    /// \param filled  later: only after fill() may anything but standard(), is_symmetric() and exact() be asked
    explicit QuantileTable(const Distribution& distribution, Filled filled = Filled::now);

    void fill();

    [[nodiscard]] const Distribution& standard() const { return standard_; }
    [[nodiscard]] bool is_symmetric() const { return symmetric_; }

    /// Exact quantile of the standard distribution: the value with probability q beyond it in the lower or upper tail.
    [[nodiscard]] double exact(double q, bool upper) const;

    /// The same by the table, or NaN where the table has none.
    /// \param scaled_q  2^32 q, 1/2 ≤ scaled_q < 2^31
    [[nodiscard]] double tabulated(double scaled_q, bool upper) const;

    /// The same for any 0 < q ≤ 1/2, by the table where it has a value.
    [[nodiscard]] double value(double q, bool upper) const;

    /// Turns random words into location + scale × draws of the standard distribution; NaN where the table has no value.
    /// Bit 31 of a word says which half, the lower bits w say q = (w + 1/2) 2^-32.
    /// \return true when one of the draws is NaN
    bool draw(const std::uint32_t* words, Eigen::Index count, double location, double scale, double* draws) const;

private:
    void fill(bool upper);

    Distribution standard_;
    bool symmetric_;
    std::vector<double>
        coefficients_;  // rows of 4: 32 octaves of 128 cells for the upper half, then for the lower half
};

/// Draws the input quantities of Monte Carlo trials.
///
/// Draw j of trial r of the group with stream s takes 32 bits from Philox 4x64-10 with key (seed, s) and counter
/// (r div 8, j, 0, 0), which serves 8 trials; where these bits fall into the outermost 2^-13 of the distribution, or
/// into a cell without a cubic piece, 53 more bits come from counter (r, j, 1, 0) and the quantile is exact: tails are
/// resolved to 2^-85. Nothing is remembered from trial to trial: any range of trials may be drawn, by any thread, in
/// any order.
///
/// A group is drawn by its `dependence` if any two of its quantities are correlated, else each quantity on its own:
/// - normal: x = μ + D L z, with L Lᵀ the correlation matrix and z independent standard normal deviates
///   (JCGM 101:2008, 6.4.8.4); L by Cholesky steps that pass over the columns of a singular matrix, so that r = ±1
///   gives the same deviate to the last bit
/// - student_t: x = μ + D L z √(ν/w), one w from χ²_ν a group and trial (JCGM 102:2011, 5.3.2)
/// - gaussian_copula: x_j = G_j⁻¹(Φ((L z)_j)), L Lᵀ = InputGroup::normal_correlation
/// - same_probability: all take the quantile of one probability; the sign of a correlation is not looked at
/// - joint_samples: a row of the samples a trial
///
/// Quantities with a stream of their own (InputGroup::own_streams) get normal deviates that are drawn anew, given those
/// of the shared quantities: L z of the whole group is drawn first, so that shared quantities have the same values
/// whichever others are not.
class InputDraws {
public:
    /// \param streams  one number a group; empty: the index of the group
    /// \throws InputError  every problem of the groups: GC-GUM-0122 (marginals), GC-GUM-0123 (dependence), GC-GUM-0127
    ///                     (streams), and those that `propagate` finds in covariances
    /// \param workers  to share out the making of tables, a millisecond each; none: not shared out
    InputDraws(const std::vector<InputGroup>& groups, std::uint64_t seed, std::span<const std::uint64_t> streams,
               WorkerThreads* workers = nullptr);

    [[nodiscard]] Eigen::Index size() const { return size_; }  ///< n, number of input quantities

    /// \param first  number of the first trial
    /// \param x      trials×n, receives the draws in the order of the inputs, coherent SI
    void draw(std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const;

private:
    struct Quantity {
        Distribution marginal;
        std::shared_ptr<const QuantileTable> table;  // none for constant, uniform and empirical
    };
    struct Group {
        std::uint64_t stream = 0;
        Eigen::Index first = 0;
        std::vector<Quantity> quantities;
        Dependence dependence = Dependence::normal;
        Eigen::MatrixXd root;  // n×n lower triangular, of the correlation matrix; empty: independent quantities
        double degrees_of_freedom = 0.0;
        std::shared_ptr<const QuantileTable> chi_square;  // gamma with shape ν/2
        std::shared_ptr<const Eigen::MatrixXd> samples;   // joint samples
        std::vector<std::uint64_t> own_streams;           // as InputGroup
        std::optional<ConditionalNormal> conditional;     // where there are own streams
    };

    void draw_independent(const Group& group, std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const;
    void draw_correlated(const Group& group, std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const;
    void draw_own(const Group& group, std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const;
    void draw_rows(const Group& group, std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const;
    void draw_column(const Quantity& quantity, std::uint64_t stream, std::uint64_t index, std::uint64_t first,
                     Eigen::Index count, double* column) const;
    void draw_table(const QuantileTable& table, std::uint64_t stream, std::uint64_t index, std::uint64_t first,
                    Eigen::Index count, double location, double scale, double* column) const;
    void draw_standard(const QuantileTable& table, std::uint64_t stream, std::uint64_t index, std::uint64_t first,
                       Eigen::Index count, double* column) const;
    void draw_words(std::uint64_t stream, std::uint64_t index, std::uint64_t first, Eigen::Index count,
                    std::uint32_t* words) const;
    [[nodiscard]] double more_bits(std::uint64_t stream, std::uint64_t index, std::uint64_t trial) const;

    std::uint64_t seed_;
    Eigen::Index size_ = 0;
    std::vector<Group> groups_;
    std::shared_ptr<const QuantileTable> normal_;
};

}  // namespace gumcert::gum
