#include "gum/monte_carlo/random_draws.h"

#include <Random123/philox.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "gum/argument_check.h"
#include "gum/distribution_quantile.h"
#include "gum/monte_carlo/correlated_normal.h"
#include "gum/monte_carlo/worker_threads.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/register_widths.h"
#include "gum/quantity/special_values.h"
#include "text/counts.h"

namespace gumcert::gum {
namespace {

constexpr int k_cell_bits = 7;
constexpr int k_cells = 1 << k_cell_bits;  // of an octave
constexpr int k_octaves = 32;              // of 2^32 q, from 1/2 up to 2^31
constexpr int k_tabulated_octaves = 13;
constexpr int k_rows = k_octaves * k_cells;  // of one half
constexpr int k_shift = 52 - k_cell_bits;
constexpr std::int64_t k_first_row = std::bit_cast<std::int64_t>(0.5) >> k_shift;
constexpr std::uint32_t k_upper = 0x80000000U;
constexpr double k_word = 0x1p-32;
constexpr Eigen::Index k_chunk = 512;  // draws whose words stay in the nearest cache
constexpr double k_table_tolerance = 1e-9;

/// The piece of the table for a row and the place in it.
struct Place {
    std::int64_t row;
    double t;  // 0 … 1
};

inline Place place(double scaled_q) {
    const auto bits = std::bit_cast<std::int64_t>(scaled_q);
    constexpr std::int64_t one = std::bit_cast<std::int64_t>(1.0);
    constexpr std::int64_t fraction = (std::int64_t{1} << 52) - 1;
    const std::int64_t within = ((bits << k_cell_bits) & fraction) | one;
    return {.row = (bits >> k_shift) - k_first_row, .t = std::bit_cast<double>(within) - 1.0};
}

/// Loops go in runs of this length and then over what is left: the compiler makes wide registers of a loop only where
/// it knows how often it goes round.
constexpr Eigen::Index k_run = 32;

using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));
using FourWords = std::uint32_t __attribute__((vector_size(16)));
using FourLong = std::uint64_t __attribute__((vector_size(32)));
constexpr Eigen::Index k_four = 4;
constexpr std::uint64_t k_sign = ~(~std::uint64_t{0} >> 1);

/// location + scale × draws of the standard distribution for up to k_chunk words, a multiple of four: first the row and
/// the place in it of all words, then the cubic pieces of four words at a time, loaded by halves of rows and turned.
/// All of it is exact integer work and the same + and × as QuantileTable::tabulated. Whole numbers become double by way
/// of the bits of 2^52 + w, and rows go through memory: both spare the unit that moves numbers between lanes.
/// \return true when one of the draws is NaN
template <bool symmetric>
__attribute__((always_inline)) inline bool draw_cells(const double* __restrict coefficients,
                                                      const std::uint32_t* __restrict words, Eigen::Index count,
                                                      double location, double scale, double* __restrict draws) {
    constexpr auto one = std::bit_cast<std::uint64_t>(1.0);
    constexpr std::uint64_t fraction = (std::uint64_t{1} << 52) - 1;
    constexpr auto two_to_52 = std::bit_cast<std::uint64_t>(0x1p52);
    alignas(32) std::array<std::uint64_t, static_cast<std::size_t>(k_chunk)> rows;  // in bytes from the first
    const auto widened = [&](Eigen::Index i, FourLong & wide) __attribute__((always_inline)) {
        FourWords word;
        std::memcpy(&word, words + i, sizeof word);
        wide = __builtin_convertvector(word, FourLong);
    };
    for (Eigen::Index i = 0; i < count; i += k_four) {
        FourLong wide;
        widened(i, wide);
        const FourLong shifted = (wide & std::uint64_t{k_upper - 1}) | two_to_52;
        Four scaled_q;
        std::memcpy(&scaled_q, &shifted, sizeof scaled_q);
        // w + ½ is the middle of what a word stands for: q is never 0, where a quantile may be infinite.
        scaled_q = (scaled_q - 0x1p52) + 0.5;
        FourLong bits;
        std::memcpy(&bits, &scaled_q, sizeof bits);
        FourLong row = (bits >> k_shift) - static_cast<std::uint64_t>(k_first_row);
        if constexpr (!symmetric) {
            row += ((wide >> 31) ^ 1) * std::uint64_t{k_rows};
        }
        row *= sizeof(Four);
        std::memcpy(rows.data() + i, &row, sizeof row);
        // What is below the bits of the row, as the fraction of a number from 1 to 2.
        const FourLong within = ((bits << k_cell_bits) & fraction) | one;
        Four t;
        std::memcpy(&t, &within, sizeof t);
        t -= 1.0;
        std::memcpy(draws + i, &t, sizeof t);
    }
    FourLong nan{};
    const auto* const table = reinterpret_cast<const std::byte*>(coefficients);
    for (Eigen::Index i = 0; i < count; i += k_four) {
        const std::uint64_t* const four = rows.data() + i;
        const auto halves = [&](std::size_t first, std::size_t second, std::size_t offset, Four & both)
            __attribute__((always_inline)) {
            Two low;
            Two high;
            std::memcpy(&low, table + four[first] + offset, sizeof low);
            std::memcpy(&high, table + four[second] + offset, sizeof high);
            both = __builtin_shufflevector(low, high, 0, 1, 2, 3);
        };
        Four even01;
        Four odd01;
        Four even23;
        Four odd23;
        halves(0, 2, 0, even01);
        halves(1, 3, 0, odd01);
        halves(0, 2, sizeof(Two), even23);
        halves(1, 3, sizeof(Two), odd23);
        const Four c0 = __builtin_shufflevector(even01, odd01, 0, 4, 2, 6);
        const Four c1 = __builtin_shufflevector(even01, odd01, 1, 5, 3, 7);
        const Four c2 = __builtin_shufflevector(even23, odd23, 0, 4, 2, 6);
        const Four c3 = __builtin_shufflevector(even23, odd23, 1, 5, 3, 7);
        Four t;
        std::memcpy(&t, draws + i, sizeof t);
        // In the order of tabulated(): a draw has the same bits whichever way it goes.
        Four x = ((c3 * t + c2) * t + c1) * t + c0;
        nan |= static_cast<FourLong>(x != x);
        if constexpr (symmetric) {
            FourLong wide;
            widened(i, wide);
            FourLong signed_x;
            std::memcpy(&signed_x, &x, sizeof x);
            // Bit 31 is 1 in the upper half, whose quantiles are positive: the sign is turned where it is 0.
            signed_x ^= ~(wide << 32) & k_sign;
            std::memcpy(&x, &signed_x, sizeof x);
        }
        x = location + scale * x;
        std::memcpy(draws + i, &x, sizeof x);
    }
    return (nan[0] | nan[1] | nan[2] | nan[3]) != 0;
}

GUMCERT_WIDE_CLONES
bool draw_symmetric(const double* coefficients, const std::uint32_t* words, Eigen::Index count, double location,
                    double scale, double* draws) {
    return draw_cells<true>(coefficients, words, count, location, scale, draws);
}

GUMCERT_WIDE_CLONES
bool draw_asymmetric(const double* coefficients, const std::uint32_t* words, Eigen::Index count, double location,
                     double scale, double* draws) {
    return draw_cells<false>(coefficients, words, count, location, scale, draws);
}

/// ±(1 - 2q), the uniform distribution on -1 … 1 in the order of the words of the tables.
inline double uniform_draw(std::uint32_t word) {
    // Words mean the same probability for every distribution. Quantities that take the quantile of one probability rest
    // on that.
    const auto number = static_cast<std::int32_t>(word);
    const std::int32_t ascending = number ^ ((number >> 31) & 0x7FFFFFFF) ^ std::numeric_limits<std::int32_t>::min();
    return (static_cast<double>(ascending) + 0.5) * 0x1p-31;
}

GUMCERT_WIDE_CLONES
void draw_uniform(const std::uint32_t* __restrict words, Eigen::Index count, double* __restrict draws) {
    Eigen::Index i = 0;
    for (; i + k_run <= count; i += k_run) {
        for (Eigen::Index j = 0; j < k_run; ++j) {
            draws[i + j] = uniform_draw(words[i + j]);
        }
    }
    for (; i < count; ++i) {
        draws[i] = uniform_draw(words[i]);
    }
}

GUMCERT_WIDE_CLONES
void locate_and_scale(double location, double scale, Eigen::Index count, double* column) {
    Eigen::Index i = 0;
    for (; i + k_run <= count; i += k_run) {
        for (Eigen::Index j = 0; j < k_run; ++j) {
            column[i + j] = location + scale * column[i + j];
        }
    }
    for (; i < count; ++i) {
        column[i] = location + scale * column[i];
    }
}

GUMCERT_WIDE_CLONES
void add_multiple(double factor, const double* __restrict from, Eigen::Index count, double* __restrict to) {
    Eigen::Index i = 0;
    for (; i + k_run <= count; i += k_run) {
        for (Eigen::Index j = 0; j < k_run; ++j) {
            to[i + j] += factor * from[i + j];
        }
    }
    for (; i < count; ++i) {
        to[i] += factor * from[i];
    }
}

__extension__ using Product = unsigned __int128;

/// philox_4x64_10 for counters (first_eight, index, 0, 0) and the following, as 32-bit words, the lower half first.
///
/// The rounds of Random123, written out for two counters at once: twice as fast at the -O2 of a release, where the
/// compiler does not unroll them by itself. A test holds both against each other.
void philox_words(const std::array<std::uint64_t, 2>& key, std::uint64_t first_eight, std::uint64_t index,
                  Eigen::Index eights, std::uint32_t* words) {
    constexpr std::size_t both = 2;
    for (Eigen::Index eight = 0; eight < eights; eight += Eigen::Index{both}) {
        const std::uint64_t counter = first_eight + static_cast<std::uint64_t>(eight);
        std::array<std::array<std::uint64_t, 4>, both> c{{{counter, index, 0, 0}, {counter + 1, index, 0, 0}}};
        std::uint64_t k0 = key[0];
        std::uint64_t k1 = key[1];
#pragma GCC unroll 10
        for (int round = 0; round < 10; ++round) {
#pragma GCC unroll 2
            for (std::size_t i = 0; i < both; ++i) {
                const Product p0 = static_cast<Product>(PHILOX_M4x64_0) * c[i][0];
                const Product p1 = static_cast<Product>(PHILOX_M4x64_1) * c[i][2];
                const std::uint64_t c0 = static_cast<std::uint64_t>(p1 >> 64) ^ c[i][1] ^ k0;
                const std::uint64_t c2 = static_cast<std::uint64_t>(p0 >> 64) ^ c[i][3] ^ k1;
                c[i][1] = static_cast<std::uint64_t>(p1);
                c[i][3] = static_cast<std::uint64_t>(p0);
                c[i][0] = c0;
                c[i][2] = c2;
            }
            k0 += PHILOX_W64_0;
            k1 += PHILOX_W64_1;
        }
        const std::size_t used = eight + 1 < eights ? both : 1;
        for (std::size_t i = 0; i < used; ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                words[2 * k] = static_cast<std::uint32_t>(c[i][k]);
                words[2 * k + 1] = static_cast<std::uint32_t>(c[i][k] >> 32);
            }
            words += 8;
        }
    }
}

/// First element that is NaN at or after `from`; `count` if there is none.
GUMCERT_WIDE_CLONES
Eigen::Index next_nan(const double* values, Eigen::Index from, Eigen::Index count) {
    Eigen::Index i = from;
    for (; i + k_run <= count; i += k_run) {
        std::int64_t found = 0;
        for (Eigen::Index j = 0; j < k_run; ++j) {
            found |= values[i + j] != values[i + j] ? std::int64_t{1} : std::int64_t{0};
        }
        if (found != 0) {
            break;
        }
    }
    while (i < count && values[i] == values[i]) {
        ++i;
    }
    return i;
}

/// Quantiles of Student's t at the upper ends q of the cells, going outwards from the median.
///
/// Each is found from its neighbour by one step of the series of the quantile function and one Newton step with the
/// probability between the two by Gauss-Legendre: a fifth of the time of an inversion, to nearly the last digit. The
/// exact quantile at the beginning of each octave keeps errors from adding up.
class StudentTChain {
public:
    explicit StudentTChain(double nu)
        : nu_(nu),
          normaliser_(std::exp(log_gamma(0.5 * (nu + 1.0)) - log_gamma(0.5 * nu)) / std::sqrt(nu * std::numbers::pi)) {}

    [[nodiscard]] double density(double x) const {
        return normaliser_ * std::exp(-0.5 * (nu_ + 1.0) * std::log1p(x * x / nu_));
    }

    /// \param probability  between x and the next, > 0
    [[nodiscard]] double next(double x, double density_at_x, double probability) const {
        const double scale = nu_ + x * x;
        const double g = -(nu_ + 1.0) * x / scale;
        const double slope_of_g = -(nu_ + 1.0) * (nu_ - x * x) / (scale * scale);
        const double step = probability / density_at_x;
        const double x1 = x + step * (1.0 - step * (g / 2.0 - step * (2.0 * g * g - slope_of_g) / 6.0));
        static constexpr std::array<double, 3> nodes{0.0, 0.5384693101056831, 0.9061798459386640};
        static constexpr std::array<double, 3> weights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
        const double half = 0.5 * (x1 - x);
        const double middle = 0.5 * (x1 + x);
        double sum = weights[0] * density(middle);
        for (std::size_t i = 1; i < nodes.size(); ++i) {
            sum += weights[i] * (density(middle - half * nodes[i]) + density(middle + half * nodes[i]));
        }
        return x1 - (half * sum - probability) / density(x1);
    }

private:
    /// std::lgamma writes the sign to a variable that all threads share, and tables are made by several.
    static double log_gamma(double x) {
        int sign = 0;
        return ::lgamma_r(x, &sign);
    }

    double nu_;
    double normaliser_;
};

}  // namespace

std::array<std::uint64_t, 4> philox_4x64_10(const std::array<std::uint64_t, 2>& key,
                                            const std::array<std::uint64_t, 4>& counter) {
    const r123::Philox4x64 generator;
    const r123::Philox4x64::ctr_type words =
        generator({{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
    return {words[0], words[1], words[2], words[3]};
}

QuantileTable::QuantileTable(const Distribution& distribution, Filled filled)
    : standard_(distribution),
      symmetric_(gum::is_symmetric(distribution) && distribution.kind != DistributionKind::beta) {
    standard_.location = 0.0;
    standard_.scale = 1.0;
    if (filled == Filled::now) {
        fill();
    }
}

void QuantileTable::fill() {
    coefficients_.assign(static_cast<std::size_t>(4 * k_rows * (symmetric_ ? 1 : 2)), k_nan);
    fill(true);
    if (!symmetric_) {
        fill(false);
    }
}

double QuantileTable::exact(double q, bool upper) const {
    return upper ? upper_quantile(standard_, q) : quantile(standard_, q);
}

void QuantileTable::fill(bool upper) {
    const DistributionKind kind = standard_.kind;
    const double shape = standard_.shape;
    // A chain needs a density that changes little in a cell, which far out is so for ν not far below 1.
    const bool chain = kind == DistributionKind::student_t && shape >= 1.0 && shape <= 1e5;
    const bool smooth = chain || kind == DistributionKind::normal || kind == DistributionKind::triangular ||
                        kind == DistributionKind::arcsine || kind == DistributionKind::exponential;
    const bool bends = kind == DistributionKind::trapezoidal || kind == DistributionKind::curvilinear_trapezoid;
    // Where the density has a bend, a check in the middle alone may miss it.
    const int parts = bends ? 4 : 2;  // of a cell, between which the piece is checked
    const StudentTChain student_t(chain ? shape : 1.0);
    const auto density = [&](double x) { return chain ? student_t.density(x) : probability_density(standard_, x); };
    const double direction = upper ? -1.0 : 1.0;  // of x with q

    const double floor =
        symmetric_ ? 0.1 : 0.0;  // about 0 a relative error would ask for more than location + scale keep
    double* half = coefficients_.data() + (upper ? 0 : 4 * k_rows);
    double x_outer = 0.0;
    double f_outer = 0.0;
    for (int octave = 0; octave < k_tabulated_octaves; ++octave) {
        const double octave_q = std::ldexp(0.5, -octave);  // at its upper end
        const double width = octave_q / 2.0 / k_cells;
        // Anew from the exact quantile in each octave: errors of the chain do not add up over the table.
        double x_inner = exact(octave_q, upper);
        double f_inner = density(x_inner);
        for (int cell = k_cells - 1; cell >= 0; --cell) {
            const double q_outer = octave_q / 2.0 + cell * width;
            x_outer = chain ? student_t.next(x_inner, f_inner, width) : exact(q_outer, upper);
            f_outer = density(x_outer);
            // Hermite piece: values and slopes, ∓1/density by q, agree at both ends. Its error falls with the fourth
            // power of the width, and neighbouring pieces join without a step.
            const double slope_outer = direction * width / f_outer;
            const double slope_inner = direction * width / f_inner;
            const double rise = x_inner - x_outer;
            const double c1 = slope_outer;
            const double c2 = 3.0 * rise - 2.0 * slope_outer - slope_inner;
            const double c3 = slope_outer + slope_inner - 2.0 * rise;
            bool usable = std::isfinite(x_outer) && std::isfinite(c1) && std::isfinite(c2) && std::isfinite(c3) &&
                          std::max(slope_outer / rise, slope_inner / rise) <= 3.0;  // monotone (Fritsch, Carlson)
            // Halves of a cell are compared with the exact quantile, other than for densities that are known to be
            // smooth: there the width of the cells keeps the error small.
            if (usable && !smooth) {
                for (int part = 1; part < parts; ++part) {
                    const double t = static_cast<double>(part) / parts;
                    const double wanted = exact(q_outer + t * width, upper);
                    const double found = ((c3 * t + c2) * t + c1) * t + x_outer;
                    usable =
                        usable && std::abs(found - wanted) <= k_table_tolerance * std::max(std::abs(wanted), floor);
                }
            }
            if (usable) {
                double* row = half + std::ptrdiff_t{4} * ((k_octaves - 1 - octave) * k_cells + cell);
                row[0] = x_outer;
                row[1] = c1;
                row[2] = c2;
                row[3] = c3;
            }
            x_inner = x_outer;
            f_inner = f_outer;
        }
    }
}

double QuantileTable::tabulated(double scaled_q, bool upper) const {
    const Place p = place(scaled_q);
    const double* c = coefficients_.data() + 4 * (p.row + (upper || symmetric_ ? 0 : k_rows));
    const double x = ((c[3] * p.t + c[2]) * p.t + c[1]) * p.t + c[0];
    return upper || !symmetric_ ? x : -x;
}

double QuantileTable::value(double q, bool upper) const {
    const double scaled_q = q * 0x1p32;
    if (scaled_q >= 0.5 && scaled_q < 0x1p31) {
        const double x = tabulated(scaled_q, upper);
        if (!std::isnan(x)) {
            return x;
        }
    }
    return exact(q, upper);
}

bool QuantileTable::draw(const std::uint32_t* words, Eigen::Index count, double location, double scale,
                         double* draws) const {
    // A look-up has no branches and takes one word a draw. Rejection takes a varying number of words: a trial could not
    // be drawn again alone (ADR 0013).
    const auto draw_fours = symmetric_ ? draw_symmetric : draw_asymmetric;
    bool has_nan = false;
    const Eigen::Index fours = count / k_four * k_four;
    for (Eigen::Index i = 0; i < fours; i += k_chunk) {
        has_nan |=
            draw_fours(coefficients_.data(), words + i, std::min(k_chunk, fours - i), location, scale, draws + i);
    }
    for (Eigen::Index i = fours; i < count; ++i) {
        const double scaled_q = static_cast<double>(words[i] & ~k_upper) + 0.5;
        draws[i] = location + scale * tabulated(scaled_q, (words[i] & k_upper) != 0);
        has_nan |= std::isnan(draws[i]);
    }
    return has_nan;
}

namespace {

/// Input groups with a model that is 0: `propagate` looks at them, and finds nothing else to look at.
class GroupsAlone : public MeasurementModel {
public:
    explicit GroupsAlone(const std::vector<InputGroup>& groups) : groups_(groups), outputs_(1) {}
    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& /*x*/) const override {
        return Eigen::VectorXd::Zero(1);
    }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        return Eigen::MatrixXd::Zero(1, x.size());
    }

private:
    const std::vector<InputGroup>& groups_;
    std::vector<OutputQuantity> outputs_;
};

/// Whether the quantities of a group depend on each other.
bool has_correlation(const InputGroup& group) {
    const Eigen::MatrixXd& V = group.covariance;
    if (V.cols() == 1) {
        return false;
    }
    if (group.dependence == Dependence::student_t) {
        return true;  // one χ² for all of them, also where no two are correlated
    }
    // A group that is stated with correlations may have none that is not 0: then each quantity is drawn by itself, and
    // the kind of dependence does not matter.
    for (Eigen::Index j = 0; j < V.cols(); ++j) {
        for (Eigen::Index i = 0; i < V.rows(); ++i) {
            if (i != j && V(i, j) != 0.0) {
                return true;
            }
        }
    }
    return false;
}

/// The quantities of a group as they are drawn.
std::vector<Distribution> marginals_of(const InputGroup& group) {
    if (!group.marginals.empty()) {
        return group.marginals;
    }
    std::vector<Distribution> marginals;
    const bool diagonal = group.covariance.cols() == 1;
    for (Eigen::Index i = 0; i < group.size(); ++i) {
        const double u = std::sqrt(diagonal ? group.covariance(i, 0) : group.covariance(i, i));
        // A quantity without uncertainty is a constant: a normal one of scale 0 has no table.
        marginals.push_back(u > 0.0 ? Distribution::normal(group.value(i), u) : Distribution::constant(group.value(i)));
    }
    return marginals;
}

void report_problems(const InputGroup& group, std::vector<Diagnostic>& problems) {
    const auto report = [&](const char* code, std::string what, std::string rule, std::string action) {
        problems.push_back(Diagnostic{.code = code,
                                      .where = "input group '" + group.name + "'",
                                      .what = std::move(what),
                                      .rule = std::move(rule),
                                      .action = std::move(action)});
    };
    const std::vector<Distribution>& marginals = group.marginals;
    if (marginals.empty()) {
        return;
    }
    if (group.dependence == Dependence::joint_samples &&
        (!group.samples || group.samples->rows() < 1 || group.samples->cols() != group.size())) {
        report("GC-GUM-0123", "joint samples without a column for each quantity",
               "a group that is drawn by rows has one column of samples for each of its quantities",
               "Give the samples.");
        return;
    }
    if (marginals.size() != static_cast<std::size_t>(group.size())) {
        report("GC-GUM-0122",
               text::count_of(marginals.size(), "distribution") + " for " + text::count_of(group.size(), "quantity"),
               "every quantity has one distribution", "Give one distribution for every quantity.");
        return;
    }
    bool usable = true;
    for (std::size_t i = 0; i < marginals.size(); ++i) {
        const std::string problem = distribution_problem(marginals[i]);
        if (!problem.empty()) {
            usable = false;
            report("GC-GUM-0122",
                   "distribution " + std::string(distribution_name(marginals[i].kind)) + " of quantity " +
                       std::to_string(i + 1) + ": " + problem,
                   "a distribution needs parameters inside its range", "Correct the parameters.");
        }
    }
    if (!usable || !has_correlation(group)) {
        return;
    }
    const auto all_random_are = [&](DistributionKind kind) {
        return std::all_of(marginals.begin(), marginals.end(), [&](const Distribution& marginal) {
            return marginal.kind == kind || marginal.kind == DistributionKind::constant;
        });
    };
    // What the stated distributions contradict is refused, not replaced: a multivariate normal has normal marginals and
    // nothing else.
    if (group.dependence == Dependence::normal && !all_random_are(DistributionKind::normal)) {
        report("GC-GUM-0123",
               "correlated quantities of which not all are normal are to be drawn as multivariate normal",
               "the multivariate normal distribution has normal marginals (JCGM 101:2008, 6.4.8)",
               "State the dependence, for example a Gaussian copula.");
    }
    if (group.dependence == Dependence::student_t) {
        bool same = all_random_are(DistributionKind::student_t);
        double nu = 0.0;
        for (const Distribution& marginal : marginals) {
            if (same && marginal.kind == DistributionKind::student_t) {
                same = nu == 0.0 || nu == marginal.shape;
                nu = marginal.shape;
            }
        }
        if (!same) {
            report("GC-GUM-0123",
                   "correlated quantities that are not all t with the same degrees of freedom are to be drawn as "
                   "multivariate t",
                   "the multivariate t distribution has one number of degrees of freedom (JCGM 102:2011, 5.3.2)",
                   "State the dependence, for example a Gaussian copula.");
        }
    }
}

/// Tables of one run, one for each shape that occurs. They are handed out empty, and filled together.
class TableCache {
public:
    std::shared_ptr<const QuantileTable> table(const Distribution& distribution) {
        // The table is that of the standard form: quantities that differ in location and scale only share it.
        const auto key = std::tuple(distribution.kind, distribution.shape, distribution.second_shape);
        std::shared_ptr<QuantileTable>& entry = tables_[key];
        if (!entry) {
            entry = std::make_shared<QuantileTable>(distribution, QuantileTable::Filled::later);
            new_.push_back(entry.get());
        }
        return entry;
    }

    void fill(WorkerThreads* workers) {
        if (workers == nullptr || new_.size() < 2) {
            for (QuantileTable* table : new_) {
                table->fill();
            }
        } else {
            workers->run(new_.size(), [&](unsigned /*worker*/, std::size_t task) { new_[task]->fill(); });
        }
    }

private:
    std::map<std::tuple<DistributionKind, double, double>, std::shared_ptr<QuantileTable>> tables_;
    std::vector<QuantileTable*> new_;
};

}  // namespace

InputDraws::InputDraws(const std::vector<InputGroup>& groups, std::uint64_t seed,
                       std::span<const std::uint64_t> streams, WorkerThreads* workers)
    : seed_(seed) {
    // The checks of covariances are those of the law of propagation: both methods refuse the same inputs.
    static_cast<void>(propagate(GroupsAlone(groups), 0.5));
    std::vector<Diagnostic> problems;
    for (const InputGroup& group : groups) {
        report_problems(group, problems);
    }
    const auto report_streams = [&](std::string what, std::string rule) {
        problems.push_back(Diagnostic{.code = "GC-GUM-0127",
                                      .where = "monte carlo streams",
                                      .what = std::move(what),
                                      .rule = std::move(rule),
                                      .action = "Give every group of inputs a number of its own."});
    };
    if (!streams.empty() && streams.size() != groups.size()) {
        report_streams(
            text::count_of(streams.size(), "stream") + " for " + std::to_string(groups.size()) + " input groups",
            "every group draws from one stream");
    } else {
        std::unordered_set<std::uint64_t> seen(streams.begin(), streams.end());
        std::size_t count = streams.size();
        for (const InputGroup& group : groups) {
            for (const std::uint64_t own : group.own_streams) {
                count += own == InputGroup::k_shared ? 0 : 1;
                if (own != InputGroup::k_shared) {
                    seen.insert(own);
                }
            }
        }
        // Two groups with one stream would get the same random numbers, and be correlated without a word of it.
        if (seen.size() != count) {
            report_streams("two groups have the same stream", "quantities of different groups are independent");
        }
    }
    if (!problems.empty()) {
        throw InputError(std::move(problems));
    }

    TableCache cache;
    groups_.reserve(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const InputGroup& from = groups[g];
        Group group;
        group.stream = streams.empty() ? g : streams[g];
        group.first = size_;
        group.dependence = from.dependence;
        group.samples = from.dependence == Dependence::joint_samples ? from.samples : nullptr;
        const bool correlated = has_correlation(from) && !group.samples;
        const bool needs_normal = correlated && from.dependence != Dependence::same_probability;
        for (const Distribution& marginal : marginals_of(from)) {
            Quantity quantity{.marginal = marginal, .table = nullptr};
            const bool tabulated = marginal.kind != DistributionKind::constant &&
                                   marginal.kind != DistributionKind::uniform &&
                                   marginal.kind != DistributionKind::empirical;
            const bool drawn_by_table = !needs_normal || from.dependence == Dependence::gaussian_copula;
            if (tabulated && drawn_by_table && !group.samples) {
                quantity.table = cache.table(marginal);
            }
            if (marginal.kind == DistributionKind::student_t) {
                group.degrees_of_freedom = marginal.shape;
            }
            group.quantities.push_back(std::move(quantity));
        }
        if (correlated) {
            // The correlation of the normal deviates of a copula is not Pearson's r of the quantities, which the
            // covariance has: it was found for it beforehand (copula_correlation.h).
            const Eigen::MatrixXd correlation =
                from.dependence == Dependence::gaussian_copula && from.normal_correlation.size() > 0
                    ? from.normal_correlation
                    : correlation_matrix(from.covariance);
            group.root = from.factor.size() > 0 ? known_correlation_root(from) : semidefinite_root(correlation);
            if (!from.own_streams.empty()) {
                std::vector<bool> is_given;
                for (const std::uint64_t own : from.own_streams) {
                    is_given.push_back(own == InputGroup::k_shared);
                }
                group.own_streams = from.own_streams;
                group.conditional = conditional_normal(correlation, is_given);
            }
        }
        if (needs_normal) {
            normal_ = cache.table(Distribution::normal(0.0, 1.0));
            if (from.dependence == Dependence::student_t && group.degrees_of_freedom > 0.0) {
                group.chi_square = cache.table(Distribution{
                    .kind = DistributionKind::gamma, .scale = 1.0, .shape = 0.5 * group.degrees_of_freedom});
            }
        }
        size_ += from.size();
        groups_.push_back(std::move(group));
    }
    cache.fill(workers);
}

void InputDraws::draw_words(std::uint64_t stream, std::uint64_t index, std::uint64_t first, Eigen::Index count,
                            std::uint32_t* words) const {
    philox_words({seed_, stream}, first / 8, index, count / 8, words);
}

double InputDraws::more_bits(std::uint64_t stream, std::uint64_t index, std::uint64_t trial) const {
    // The third word of the counter is 0 for all other draws: these bits are independent of them.
    const std::array<std::uint64_t, 4> words = philox_4x64_10({seed_, stream}, {trial, index, 1, 0});
    return (static_cast<double>(words[0] >> 11) + 0.5) * 0x1p-53;
}

namespace {

/// Calls work(offset, words of that chunk, first trial, count) for chunks whose words begin at multiples of 8 trials.
template <class Words, class Work>
void in_chunks(std::uint64_t first, Eigen::Index count, Words&& draw_words, Work&& work) {
    std::array<std::uint32_t, static_cast<std::size_t>(k_chunk)> words;
    Eigen::Index done = 0;
    while (done < count) {
        const std::uint64_t trial = first + static_cast<std::uint64_t>(done);
        // One call of the generator serves eight trials: a range that begins between them skips the first words, so
        // that trial and word belong together wherever a block begins.
        const auto skipped = static_cast<Eigen::Index>(trial % 8);
        const Eigen::Index here = std::min(count - done, k_chunk - skipped);
        draw_words(trial - trial % 8, (skipped + here + 7) / 8 * 8, words.data());
        work(done, words.data() + skipped, trial, here);
        done += here;
    }
}

}  // namespace

void InputDraws::draw_table(const QuantileTable& table, std::uint64_t stream, std::uint64_t index, std::uint64_t first,
                            Eigen::Index count, double location, double scale, double* column) const {
    in_chunks(
        first, count,
        [&](std::uint64_t trial, Eigen::Index words, std::uint32_t* to) {
            draw_words(stream, index, trial, words, to);
        },
        [&](Eigen::Index offset, const std::uint32_t* words, std::uint64_t trial, Eigen::Index here) {
            double* draws = column + offset;
            if (!table.draw(words, here, location, scale, draws)) {
                return;
            }
            // NaN marks the places that the cubic pieces do not serve: the outermost tails and cells with a bend.
            for (Eigen::Index i = next_nan(draws, 0, here); i < here; i = next_nan(draws, i + 1, here)) {
                const double bits = more_bits(stream, index, trial + static_cast<std::uint64_t>(i));
                const double q = (static_cast<double>(words[i] & ~k_upper) + bits) * k_word;
                draws[i] = location + scale * table.exact(q, (words[i] & k_upper) != 0);
            }
        });
}

void InputDraws::draw_standard(const QuantileTable& table, std::uint64_t stream, std::uint64_t index,
                               std::uint64_t first, Eigen::Index count, double* column) const {
    draw_table(table, stream, index, first, count, -0.0, 1.0, column);  // adding -0 leaves every number as it is
}

void InputDraws::draw_column(const Quantity& quantity, std::uint64_t stream, std::uint64_t index, std::uint64_t first,
                             Eigen::Index count, double* column) const {
    const Distribution& marginal = quantity.marginal;
    const auto words_for = [&](std::uint64_t trial, Eigen::Index words, std::uint32_t* to) {
        draw_words(stream, index, trial, words, to);
    };
    if (marginal.kind == DistributionKind::constant) {
        std::fill(column, column + count, marginal.location);
        return;
    }
    if (marginal.kind == DistributionKind::uniform) {
        in_chunks(first, count, words_for,
                  [&](Eigen::Index offset, const std::uint32_t* words, std::uint64_t /*trial*/, Eigen::Index here) {
                      draw_uniform(words, here, column + offset);
                  });
    } else if (marginal.kind == DistributionKind::empirical) {
        const std::vector<double>& samples = *marginal.samples;
        in_chunks(first, count, words_for,
                  [&](Eigen::Index offset, const std::uint32_t* words, std::uint64_t trial, Eigen::Index here) {
                      for (Eigen::Index i = 0; i < here; ++i) {
                          const bool upper = (words[i] & k_upper) != 0;
                          // In rising order of the values: the upper half counts from the end of the distribution.
                          const std::uint32_t ascending = upper ? ~words[i] ^ k_upper : words[i];
                          // 32 bits give each of a million values its probability within 0.03 %; more values, more
                          // bits.
                          double bits = 0.5;
                          if (samples.size() > (std::size_t{1} << 20)) {
                              bits = more_bits(stream, index, trial + static_cast<std::uint64_t>(i));
                              bits = upper ? 1.0 - bits : bits;
                          }
                          const double p = (static_cast<double>(ascending) + bits) * k_word;
                          const auto chosen = static_cast<std::size_t>(p * static_cast<double>(samples.size()));
                          column[offset + i] = samples[std::min(chosen, samples.size() - 1)];
                      }
                  });
    } else {
        draw_table(*quantity.table, stream, index, first, count, marginal.location, marginal.scale, column);
        return;
    }
    locate_and_scale(marginal.location, marginal.scale, count, column);
}

void InputDraws::draw_independent(const Group& group, std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const {
    for (std::size_t i = 0; i < group.quantities.size(); ++i) {
        draw_column(group.quantities[i], group.stream, i, first, x.rows(),
                    x.col(group.first + static_cast<Eigen::Index>(i)).data());
    }
}

void InputDraws::draw_correlated(const Group& group, std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const {
    const Eigen::Index trials = x.rows();
    const auto n = static_cast<Eigen::Index>(group.quantities.size());
    // The same stream and index: the same word for each quantity, hence the same probability.
    if (group.dependence == Dependence::same_probability) {
        for (Eigen::Index i = 0; i < n; ++i) {
            draw_column(group.quantities[static_cast<std::size_t>(i)], group.stream, 0, first, trials,
                        x.col(group.first + i).data());
        }
        return;
    }
    // Columns of L z in place, from the last to the first, because row i of L reaches back to the columns before it.
    for (Eigen::Index i = 0; i < n; ++i) {
        draw_standard(*normal_, group.stream, static_cast<std::uint64_t>(i), first, trials,
                      x.col(group.first + i).data());
    }
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        double* column = x.col(group.first + i).data();
        locate_and_scale(0.0, group.root(i, i), trials, column);
        for (Eigen::Index k = 0; k < i; ++k) {
            if (group.root(i, k) != 0.0) {
                add_multiple(group.root(i, k), x.col(group.first + k).data(), trials, column);
            }
        }
    }
    draw_own(group, first, x);
    // ν = n − 1 for inputs that were observed together n times, however many they are: each combination of them then
    // has the t distribution that the combination of each row has by itself (ADR 0030).
    if (group.chi_square) {
        Eigen::ArrayXd factor(trials);
        draw_standard(*group.chi_square, group.stream, static_cast<std::uint64_t>(n), first, trials, factor.data());
        // One χ² for all quantities of a group and trial makes the distribution a multivariate t (JCGM 102:2011,
        // 5.3.2).
        factor = (0.5 * group.degrees_of_freedom / factor).sqrt();  // χ² is twice the gamma deviate
        for (Eigen::Index i = 0; i < n; ++i) {
            x.col(group.first + i).array() *= factor;
        }
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const Quantity& quantity = group.quantities[static_cast<std::size_t>(i)];
        const Distribution& marginal = quantity.marginal;
        double* column = x.col(group.first + i).data();
        if (marginal.kind == DistributionKind::constant) {
            std::fill(column, column + trials, marginal.location);
            continue;
        }
        if (group.dependence == Dependence::gaussian_copula && marginal.kind != DistributionKind::normal) {
            for (Eigen::Index trial = 0; trial < trials; ++trial) {
                const bool upper = column[trial] > 0.0;
                // The probability of the nearer tail: 1 − Φ(z) would lose the digits of the upper one.
                const double q = 0.5 * std::erfc(std::abs(column[trial]) / std::numbers::sqrt2);
                if (quantity.table) {
                    column[trial] = quantity.table->value(q, upper);
                } else if (marginal.kind == DistributionKind::uniform) {
                    column[trial] = upper ? 1.0 - 2.0 * q : 2.0 * q - 1.0;
                } else {
                    const std::vector<double>& samples = *marginal.samples;
                    const double p = upper ? 1.0 - q : q;
                    const auto chosen = static_cast<std::size_t>(p * static_cast<double>(samples.size()));
                    column[trial] = samples[std::min(chosen, samples.size() - 1)];
                }
            }
        }
        locate_and_scale(marginal.location, marginal.scale, trials, column);
    }
}

// The shared quantities keep what L z of the whole group gave them. The others are drawn anew, given those: two points
// of a table so have their common inputs in common, and nothing else.
void InputDraws::draw_own(const Group& group, std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const {
    if (!group.conditional) {
        return;
    }
    const ConditionalNormal& conditional = *group.conditional;
    const auto count = static_cast<Eigen::Index>(conditional.others.size());
    Eigen::MatrixXd own(x.rows(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto position = static_cast<std::size_t>(conditional.others[static_cast<std::size_t>(i)]);
        draw_standard(*normal_, group.own_streams[position], 0, first, x.rows(), own.col(i).data());
    }
    for (Eigen::Index i = count - 1; i >= 0; --i) {
        double* column = x.col(group.first + conditional.others[static_cast<std::size_t>(i)]).data();
        std::fill(column, column + x.rows(), 0.0);
        for (std::size_t g = 0; g < conditional.given.size(); ++g) {
            add_multiple(conditional.coefficients(i, static_cast<Eigen::Index>(g)),
                         x.col(group.first + conditional.given[g]).data(), x.rows(), column);
        }
        for (Eigen::Index k = 0; k <= i; ++k) {
            add_multiple(conditional.root(i, k), own.col(k).data(), x.rows(), column);
        }
    }
}

void InputDraws::draw_rows(const Group& group, std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const {
    const Eigen::MatrixXd& samples = *group.samples;
    const auto rows = static_cast<std::uint64_t>(samples.rows());
    in_chunks(
        first, x.rows(),
        [&](std::uint64_t trial, Eigen::Index words, std::uint32_t* to) {
            draw_words(group.stream, 0, trial, words, to);
        },
        [&](Eigen::Index offset, const std::uint32_t* words, std::uint64_t trial, Eigen::Index here) {
            for (Eigen::Index i = 0; i < here; ++i) {
                // 32 bits give each of a million rows its probability within 0.03 %; more rows, more bits.
                const double bits = rows > (std::uint64_t{1} << 20U)
                                        ? more_bits(group.stream, 0, trial + static_cast<std::uint64_t>(i))
                                        : 0.5;
                const double p = (static_cast<double>(words[i]) + bits) * k_word;
                const auto row = std::min(static_cast<std::uint64_t>(p * static_cast<double>(rows)), rows - 1);
                x.row(offset + i).segment(group.first, samples.cols()) = samples.row(static_cast<Eigen::Index>(row));
            }
        });
}

void InputDraws::draw(std::uint64_t first, Eigen::Ref<Eigen::MatrixXd> x) const {
    for (const Group& group : groups_) {
        if (group.samples) {
            draw_rows(group, first, x);
        } else if (group.root.size() == 0) {
            draw_independent(group, first, x);
        } else {
            draw_correlated(group, first, x);
        }
    }
}

}  // namespace gumcert::gum
