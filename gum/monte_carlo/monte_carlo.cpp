#include "gum/monte_carlo/monte_carlo.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

#include "gum/argument_check.h"
#include "gum/monte_carlo/monte_carlo_statistics.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/monte_carlo/worker_threads.h"
#include "gum/propagation.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {

// A run with a fixed number of trials goes over them in passes:
// 1. The first trials, the pilot, tell the searches for order statistics where the values lie.
// 2. All trials: moments, products, first counts of the searches; values are kept as far as memory allows.
// 3. As often as a search asks for it: kept values, or the same trials drawn again. Regions need mean and covariance of
// all trials and histograms their range, so that neither can be counted in the pass before.
// An adaptive run only finds the number of trials (JCGM 101:2008, 7.9.4). A run with that number then gives the result,
// which so does not depend on how the number was found.
// Sums of numbers are merged in the order of the trials, for the sum of rounded numbers depends on its order; counts
// are whole numbers, which any thread may add at any time.

namespace {

constexpr std::uint64_t k_block = 4096;  // trials; part of what the bytes of a result depend on
constexpr std::uint64_t k_most_trials = 10'000'000'000;
constexpr std::uint64_t k_pilot = 1024;
// A standard deviation of 16 batches is known to 1/√(2·15) = 18 %: enough for an error of an end.
constexpr std::uint64_t k_batches = 16;
constexpr std::uint64_t k_largest_batch = 8192;
constexpr std::uint64_t k_smallest_batch = 20;
constexpr Eigen::Index k_few_outputs = 16;
constexpr Eigen::Index k_product_rows = 128;  // short enough for one pass of a matrix product, whatever the caches are

using Values = Eigen::Ref<const Eigen::MatrixXd>;

Eigen::Index index(std::uint64_t number) {
    return static_cast<Eigen::Index>(number);
}

/// Moments of all outputs over some trials; the lower triangle of the products is filled.
struct Sums {
    std::vector<Moments> moments;
    Eigen::MatrixXd products;  // m×m, Σ (y_i - mean)(y_j - mean); empty for one output
    std::uint64_t not_finite = 0;
    std::uint64_t first_not_finite = 0;

    void merge(const Sums& other) {
        if (moments.empty()) {
            *this = other;
            return;
        }
        // Σ (y_i − ȳ_i)(y_j − ȳ_j) of both parts = A + B + n_a n_b/(n_a + n_b) d_i d_j, d the difference of the means.
        // It comes before the moments are merged, which takes the mean of this part away.
        const Eigen::Index m = products.rows();
        if (m > 0) {
            const double na = static_cast<double>(moments.front().count);
            const double nb = static_cast<double>(other.moments.front().count);
            Eigen::VectorXd d(m);
            for (Eigen::Index j = 0; j < m; ++j) {
                d(j) = other.moments[static_cast<std::size_t>(j)].mean - moments[static_cast<std::size_t>(j)].mean;
            }
            const double share = na * nb / (na + nb);
            for (Eigen::Index j = 0; j < m; ++j) {
                for (Eigen::Index i = j; i < m; ++i) {
                    products(i, j) += other.products(i, j) + share * d(i) * d(j);
                }
            }
        }
        for (std::size_t j = 0; j < moments.size(); ++j) {
            moments[j].merge(other.moments[j]);
        }
        // Parts come in the order of the trials, so that the first one found is the one of the lowest number.
        if (not_finite == 0) {
            first_not_finite = other.first_not_finite;
        }
        not_finite += other.not_finite;
    }

    [[nodiscard]] Eigen::MatrixXd covariance() const {
        const auto m = static_cast<Eigen::Index>(moments.size());
        Eigen::MatrixXd result(m, m);
        const double n = static_cast<double>(moments.front().count);
        const double divisor = std::max(n - 1.0, 1.0);
        for (Eigen::Index j = 0; j < m; ++j) {
            for (Eigen::Index i = j + 1; i < m; ++i) {
                result(i, j) = products(i, j) / divisor;
                result(j, i) = result(i, j);
            }
            // The u that is stated, squared: covariance and results agree to the last bit.
            const double u = moments[static_cast<std::size_t>(j)].standard_deviation();
            result(j, j) = u * u;
        }
        return result;
    }
};

Sums sums_of(const Values& y, std::uint64_t first) {
    Sums sums;
    const Eigen::Index m = y.cols();
    sums.moments.reserve(static_cast<std::size_t>(m));
    bool finite = true;
    for (Eigen::Index j = 0; j < m; ++j) {
        sums.moments.push_back(moments_of(y.col(j).data(), y.rows()));
        // One trial that is not finite makes the mean so. Testing the mean costs nothing in the usual case.
        finite = finite && std::isfinite(sums.moments.back().mean);
    }
    if (!finite) {
        // A sum of finite numbers may overflow too: only the numbers themselves tell.
        for (Eigen::Index i = 0; i < y.rows(); ++i) {
            if (!y.row(i).allFinite()) {
                if (sums.not_finite == 0) {
                    sums.first_not_finite = first + static_cast<std::uint64_t>(i);
                }
                ++sums.not_finite;
            }
        }
    }
    if (m == 1) {
        return sums;
    }
    sums.products = Eigen::MatrixXd::Zero(m, m);
    if (m <= k_few_outputs) {
        for (Eigen::Index j = 0; j < m; ++j) {
            for (Eigen::Index i = j + 1; i < m; ++i) {
                sums.products(i, j) =
                    sum_of_products(y.col(i).data(), sums.moments[static_cast<std::size_t>(i)].mean, y.col(j).data(),
                                    sums.moments[static_cast<std::size_t>(j)].mean, y.rows());
            }
        }
        return sums;
    }
    Eigen::RowVectorXd mean(m);
    for (Eigen::Index j = 0; j < m; ++j) {
        mean(j) = sums.moments[static_cast<std::size_t>(j)].mean;
    }
    for (Eigen::Index begin = 0; begin < y.rows(); begin += k_product_rows) {
        const Eigen::MatrixXd centred =
            y.middleRows(begin, std::min(k_product_rows, y.rows() - begin)).rowwise() - mean;
        sums.products.selfadjointView<Eigen::Lower>().rankUpdate(centred.transpose());
    }
    return sums;
}

/// Deviations of trials from the mean in terms of the spread of all outputs together.
class RegionDistances {
public:
    RegionDistances(const std::vector<Moments>& moments, const Eigen::MatrixXd& covariance) {
        const Eigen::Index m = covariance.rows();
        mean_.resize(m);
        u_.resize(m);
        for (Eigen::Index j = 0; j < m; ++j) {
            mean_(j) = moments[static_cast<std::size_t>(j)].mean;
            u_(j) = std::sqrt(covariance(j, j));
        }
        if (!(u_.minCoeff() > 0.0)) {
            no_ellipsoid_because_ = "An output does not vary, so the covariance matrix of the outputs is singular.";
            return;
        }
        // With correlations in place of covariances no unit decides what is singular. An eigenvalue is off by rounding
        // by some m ε λ_max; below a hundred times that the smallest one cannot be told from 0.
        const Eigen::MatrixXd correlation = correlation_matrix(covariance);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation, Eigen::EigenvaluesOnly);
        const double limit = 100.0 * static_cast<double>(m) * std::numeric_limits<double>::epsilon();
        const Eigen::LLT<Eigen::MatrixXd> cholesky(correlation);
        if (!(eigen.eigenvalues()(0) > limit * eigen.eigenvalues()(m - 1)) || cholesky.info() != Eigen::Success) {
            no_ellipsoid_because_ =
                "The outputs depend on each other linearly, so their covariance matrix is singular.";
            return;
        }
        root_ = cholesky.matrixL();
    }

    [[nodiscard]] bool has_ellipsoid() const { return root_.size() > 0; }
    [[nodiscard]] const std::string& no_ellipsoid_because() const { return no_ellipsoid_because_; }

    /// \param to  trials×2: Mahalanobis distance (0 if there is none), largest |η_j - y_j| / u(y_j)
    void evaluate(const Values& y, Eigen::MatrixXd& to, Eigen::MatrixXd& scratch) const {
        const Eigen::Index m = y.cols();
        to.setZero(y.rows(), 2);
        scratch.resize(y.rows(), m);
        for (Eigen::Index j = 0; j < m; ++j) {
            // In terms of u, so that outputs of different units count alike; one that does not vary has no distance.
            if (u_(j) > 0.0) {
                scratch.col(j) = (y.col(j).array() - mean_(j)) / u_(j);
            } else {
                scratch.col(j).setZero();
            }
            to.col(1) = to.col(1).cwiseMax(scratch.col(j).cwiseAbs());
        }
        if (!has_ellipsoid()) {
            return;
        }
        // (η − y)ᵀ V⁻¹ (η − y) = zᵀ z where L z = (η_j − y_j)/u_j and L Lᵀ is the correlation matrix: no inverse is
        // formed.
        for (Eigen::Index j = 0; j < m; ++j) {  // L z = scaled deviations, for all trials at once
            for (Eigen::Index k = 0; k < j; ++k) {
                scratch.col(j) -= root_(j, k) * scratch.col(k);
            }
            scratch.col(j) /= root_(j, j);
            to.col(0).array() += scratch.col(j).array().square();
        }
        to.col(0) = to.col(0).cwiseSqrt();
    }

private:
    Eigen::VectorXd mean_;
    Eigen::VectorXd u_;
    Eigen::MatrixXd root_;
    std::string no_ellipsoid_because_;
};

/// Counts of trials in the cells of a grid over two or three outputs.
class RegionGrid {
public:
    RegionGrid() = default;
    RegionGrid(const std::vector<Moments>& moments, std::uint64_t trials) {
        const std::size_t m = moments.size();
        // With four outputs or more there would be more cells than trials, most of them with one trial or none.
        if (m < 2 || m > 3) {
            return;
        }
        // Cells shrink as trials grow in number, more slowly than the trials in each of them grow.
        const double millions = static_cast<double>(trials) * 1e-6;
        const double wanted = m == 2 ? 100.0 * std::pow(millions, 0.25) : 30.0 * std::pow(millions, 0.2);
        const int cells = static_cast<int>(std::clamp(wanted, 8.0, m == 2 ? 400.0 : 100.0));
        for (const Moments& output : moments) {
            // From the smallest to the largest trial: the region has to be able to hold all of them.
            const bool varies = output.largest > output.smallest;
            low_.push_back(output.smallest);
            width_.push_back(varies ? (output.largest - output.smallest) / cells : 0.0);
            cells_.push_back(varies ? cells : 1);
        }
        size_ = 1;
        for (const int axis : cells_) {
            size_ *= static_cast<std::size_t>(axis);
        }
    }

    [[nodiscard]] std::size_t size() const { return size_; }

    void add(const Values& y, std::vector<std::uint64_t>& counts) const {
        for (Eigen::Index i = 0; i < y.rows(); ++i) {
            std::size_t cell = 0;
            for (std::size_t j = 0; j < cells_.size(); ++j) {
                // The largest trial lies on the upper limit of the last cell and belongs to it.
                const double place = width_[j] > 0.0 ? (y(i, static_cast<Eigen::Index>(j)) - low_[j]) / width_[j] : 0.0;
                cell = cell * static_cast<std::size_t>(cells_[j]) +
                       static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, cells_[j] - 1));
            }
            ++counts[cell];
        }
    }

    void fill(MonteCarloRegions& regions, std::vector<std::uint64_t> counts, std::uint64_t trials, double p) const {
        // Cells have one volume: the fullest ones first make up the fraction p with the fewest of them.
        std::sort(counts.begin(), counts.end(), std::greater<>());
        const double wanted = p * static_cast<double>(trials);
        std::uint64_t inside = 0;
        for (const std::uint64_t count : counts) {
            if (static_cast<double>(inside) >= wanted) {
                break;
            }
            inside += count;
            ++regions.smallest_cells;
        }
        regions.cells_per_axis = cells_;
        regions.smallest_volume = static_cast<double>(regions.smallest_cells);
        for (const double width : width_) {
            regions.smallest_volume *= width;
        }
        regions.smallest_probability = static_cast<double>(inside) / static_cast<double>(trials);
    }

private:
    std::vector<double> low_;
    std::vector<double> width_;
    std::vector<int> cells_;
    std::size_t size_ = 0;
};

/// Order statistic that encloses the fraction p: q = integer part of pM + 1/2, as a rank from 0 (JCGM 102:2011, 7.7).
std::uint64_t enclosing_rank(double p, std::uint64_t trials) {
    const auto wanted = static_cast<std::uint64_t>(std::floor(p * static_cast<double>(trials) + 0.5));
    return std::clamp<std::uint64_t>(wanted, 1, trials) - 1;
}

/// Draws and evaluates blocks of trials on some threads.
class TrialSource {
public:
    TrialSource(const MeasurementModel& model, const MonteCarloOptions& options)
        : model_(model),
          workers_(options.threads),
          draws_(model.inputs(), options.seed, options.streams, &workers_),
          m_(static_cast<Eigen::Index>(model.outputs().size())),
          scratch_(workers_.size()) {
        // Wide models are evaluated in parts of a block, so that the drawn values stay near the processor: a megabyte.
        const std::uint64_t most = (std::uint64_t{1} << 17) / static_cast<std::uint64_t>(draws_.size() + m_ + 1);
        // By the model alone, never by the threads: the moments of a block are merged part by part.
        rows_ = std::clamp<std::uint64_t>(most / 32 * 32, 32, k_block);
    }

    [[nodiscard]] Eigen::Index outputs() const { return m_; }
    [[nodiscard]] const InputDraws& draws() const { return draws_; }
    [[nodiscard]] WorkerThreads& workers() { return workers_; }

    /// Evaluates `count` trials from `first` on, part by part: use(first of the part, trials×m).
    template <class Use>
    void evaluate(unsigned worker, std::uint64_t first, std::uint64_t count, Use&& use) {
        Scratch& scratch = scratch_[worker];
        if (scratch.y.size() == 0) {
            scratch.x.resize(index(rows_), draws_.size());
            scratch.y.resize(index(rows_), m_);
        }
        for (std::uint64_t done = 0; done < count; done += rows_) {
            const Eigen::Index here = index(std::min(rows_, count - done));
            auto x = scratch.x.topRows(here);
            auto y = scratch.y.topRows(here);
            draws_.draw(first + done, x);
            model_.evaluate_trials(x, y);
            use(first + done, Values(y));
        }
    }

    [[noreturn]] void refuse_trial(const Sums& sums, std::uint64_t trials) const {
        // The trial is drawn again by its number: the inputs that had no value are named, not the block.
        Eigen::MatrixXd x(1, draws_.size());
        draws_.draw(sums.first_not_finite, x);
        std::string inputs;
        Eigen::Index column = 0;
        for (const InputGroup& group : model_.inputs()) {
            for (Eigen::Index i = 0; i < group.size() && column < 20; ++i, ++column) {
                const InputQuantity quantity = group.quantity(i);
                inputs += inputs.empty() ? "" : ", ";
                inputs += quantity.name + " = " + text::shortest(x(0, column)) +
                          (quantity.unit.empty() || quantity.unit == "1" ? "" : " " + quantity.unit);
            }
        }
        if (column < draws_.size()) {
            inputs += ", … (" + text::count_of(draws_.size(), "input") + ")";
        }
        throw NoResultError(Diagnostic{
            .code = "GC-GUM-0120",
            .where = "monte carlo, trial " + std::to_string(sums.first_not_finite),
            .what = "the model has no finite value at " + inputs + " (" + std::to_string(sums.not_finite) +
                    " such trials among the first " + std::to_string(trials) + ")",
            .rule = "every trial must have a value",
            .action = "Check whether the distributions reach outside the domain of the model, and choose ones that do "
                      "not; or say in the equation what holds beyond it, as sqrt(max(x, 0)) does."});
    }

private:
    struct Scratch {
        Eigen::MatrixXd x, y;
    };

    const MeasurementModel& model_;
    WorkerThreads workers_;
    InputDraws draws_;
    Eigen::Index m_;
    std::vector<Scratch> scratch_;
    std::uint64_t rows_ = k_block;
};

void report_progress(const MonteCarloOptions& options, double fraction) {
    if (options.progress) {
        options.progress(std::clamp(fraction, 0.0, 1.0));
    }
}

/// A run with a fixed number of trials.
class FixedRun {
public:
    FixedRun(TrialSource& source, const MonteCarloOptions& options, std::uint64_t trials, double progress_from)
        : source_(source),
          options_(options),
          trials_(trials),
          m_(source.outputs()),
          ranks_(options.coverage_probability, trials),
          progress_from_(progress_from) {
        const auto outputs = static_cast<std::uint64_t>(m_);
        // Memory decides only whether trials are kept or drawn again: the numbers are the same.
        keeps_all_ = trials <= options.memory.kept_trials && trials <= options.memory.kept_values / outputs;
        // All batches of all outputs are kept: 2^22 values, 32 MiB, up to a thousand outputs.
        batch_ = std::clamp<std::uint64_t>((std::uint64_t{1} << 22) / k_batches / outputs, 256, k_largest_batch);
        batch_ = std::min(batch_, trials / k_batches);
        with_regions_ = options.regions && m_ > 1;
    }

    MonteCarloResult run() {
        begin();
        evaluate_all();
        for (std::size_t j = 0; j < searches_.size(); ++j) {
            searches_[j].finish_pass(sums_.moments[j].smallest, sums_.moments[j].largest);
        }
        covariance_ = sums_.covariance();
        if (with_regions_) {
            begin_regions();
        }
        for (const Moments& moments : sums_.moments) {
            histograms_.push_back(options_.histogram ? empty_histogram(moments) : Histogram());
        }
        while (needs_pass()) {
            pass_again();
        }
        return result();
    }

private:
    void begin() {
        const std::uint64_t pilot = std::min(k_pilot, trials_);
        kept_.resize(index(keeps_all_ ? trials_ : std::max(batch_ * k_batches, pilot)), m_);
        // Drawn once more in the first pass. Here they set the bins of the searches only, and no result rests on them.
        Eigen::MatrixXd first(index(pilot), m_);
        source_.evaluate(0, 0, pilot,
                         [&](std::uint64_t from, const Values& y) { first.middleRows(index(from), y.rows()) = y; });
        const auto outputs = static_cast<std::uint64_t>(m_);
        bits_ = outputs <= 8      ? 10
                : outputs <= 48   ? 8
                : outputs <= 200  ? 6
                : outputs <= 1000 ? 4
                                  : 3;  // some MB a worker
        // Where all trials are kept, a search may collect them all: it never divides its bins then, and is always
        // exact.
        const std::uint64_t most = keeps_all_ ? std::max(options_.memory.collected_values / outputs, trials_)
                                              : std::max<std::uint64_t>(options_.memory.collected_values / outputs, 64);
        searches_.reserve(static_cast<std::size_t>(m_));
        for (Eigen::Index j = 0; j < m_; ++j) {
            RankSearch& search = searches_.emplace_back(
                std::span<const double>(first.col(j).data(), static_cast<std::size_t>(pilot)), bits_, most);
            search.want_rank(ranks_.low);
            search.want_rank(ranks_.low + ranks_.inside);
            for (const std::uint64_t rank : {ranks_.low, ranks_.low + ranks_.inside}) {
                // Two more ranks for each end: what the finite number of trials does to it is read from its neighbours.
                const auto [below, above] = spread_of(rank);
                search.want_rank(below);
                search.want_rank(above);
            }
            if (ranks_.inside > 0) {
                search.want_shortest(ranks_.inside);
            }
        }
    }

    /// Ranks one binomial standard deviation below and above.
    [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> spread_of(std::uint64_t rank) const {
        const double M = static_cast<double>(trials_);
        const double fraction = (static_cast<double>(rank) + 1.0) / M;
        const auto spread = static_cast<std::uint64_t>(
            std::max(std::ceil(std::sqrt(M * fraction * std::max(1.0 - fraction, 0.0))), 1.0));
        return {rank > spread ? rank - spread : 0, std::min(rank + spread, trials_ - 1)};
    }

    /// First pass: moments, first counts of the searches, and the values that are kept.
    void evaluate_all() {
        std::vector<std::vector<RankSearch::Tally>> tallies = new_tallies(searches_);
        const std::uint64_t blocks = (trials_ + k_block - 1) / k_block;
        const std::uint64_t round =
            m_ <= 64 ? 64 : std::uint64_t{2} * static_cast<std::uint64_t>(source_.workers().size());
        // Merged after each round: with m×m products a block, sums of all blocks could not be held.
        std::vector<Sums> partial(static_cast<std::size_t>(round));
        for (std::uint64_t begin = 0; begin < blocks; begin += round) {
            const std::uint64_t here = std::min(round, blocks - begin);
            source_.workers().run(static_cast<std::size_t>(here), [&](unsigned worker, std::size_t task) {
                const std::uint64_t first = (begin + task) * k_block;
                Sums sums;
                source_.evaluate(
                    worker, first, std::min(k_block, trials_ - first), [&](std::uint64_t from, const Values& y) {
                        sums.merge(sums_of(y, from));
                        for (std::size_t j = 0; j < searches_.size(); ++j) {
                            searches_[j].add(y.col(static_cast<Eigen::Index>(j)).data(), y.rows(), tallies[worker][j]);
                        }
                        keep(from, y);
                    });
                partial[task] = std::move(sums);
            });
            // In the order of the blocks: sums have the same bytes, and the trial that is refused is the same one, for
            // any number of threads.
            for (std::uint64_t block = 0; block < here; ++block) {
                sums_.merge(partial[static_cast<std::size_t>(block)]);
                if (sums_.not_finite > 0) {
                    source_.refuse_trial(sums_, std::min((begin + block + 1) * k_block, trials_));
                }
            }
            done_ += here;
            progress(blocks);
        }
        absorb(searches_, tallies);
    }

    void keep(std::uint64_t from, const Values& y) {
        const Eigen::Index first = index(from);
        if (first < kept_.rows()) {
            const Eigen::Index rows = std::min(y.rows(), kept_.rows() - first);
            kept_.middleRows(first, rows) = y.topRows(rows);
        }
    }

    void progress(std::uint64_t blocks) {
        // Without kept trials they are gone through about four times; what exactly is only known at the end.
        const double passes = keeps_all_ ? 1.0 : (with_regions_ ? 4.0 : 2.0);
        const double fraction = static_cast<double>(done_) / (static_cast<double>(blocks) * passes);
        report_progress(options_, progress_from_ + (1.0 - progress_from_) * std::min(fraction, 1.0));
    }

    // Distances need mean and covariance of all trials, hence a pass of their own after the first one.
    void begin_regions() {
        distances_ = std::make_unique<RegionDistances>(sums_.moments, covariance_);
        grid_ = RegionGrid(sums_.moments, trials_);
        grid_counts_.assign(grid_.size(), 0);
        Eigen::MatrixXd first;
        Eigen::MatrixXd scratch;
        const Eigen::Index pilot = index(std::min(k_pilot, trials_));
        // kept_ has the pilot trials in any case, see begin().
        distances_->evaluate(kept_.topRows(pilot), first, scratch);
        const std::uint64_t rank = enclosing_rank(options_.coverage_probability, trials_);
        for (Eigen::Index j = 0; j < 2; ++j) {
            RankSearch& search = region_searches_.emplace_back(
                std::span<const double>(first.col(j).data(), static_cast<std::size_t>(pilot)), 10,
                std::max<std::uint64_t>(options_.memory.collected_values / 2, 64));
            search.want_rank(rank);
        }
    }

    [[nodiscard]] bool needs_pass() const {
        const auto waits = [](const RankSearch& search) { return !search.is_done(); };
        return std::any_of(searches_.begin(), searches_.end(), waits) ||
               std::any_of(region_searches_.begin(), region_searches_.end(), waits) || waits_for_histograms();
    }

    [[nodiscard]] bool waits_for_histograms() const {
        return !histograms_done_ && std::any_of(histograms_.begin(), histograms_.end(),
                                                [](const Histogram& histogram) { return !histogram.counts.empty(); });
    }

    [[nodiscard]] std::vector<std::vector<RankSearch::Tally>> new_tallies(const std::vector<RankSearch>& searches) {
        std::vector<std::vector<RankSearch::Tally>> tallies(source_.workers().size());
        for (std::vector<RankSearch::Tally>& of_worker : tallies) {
            for (const RankSearch& search : searches) {
                of_worker.push_back(search.is_done() ? RankSearch::Tally() : search.tally());
            }
        }
        return tallies;
    }

    static void absorb(std::vector<RankSearch>& searches, std::vector<std::vector<RankSearch::Tally>>& tallies) {
        for (std::vector<RankSearch::Tally>& of_worker : tallies) {
            for (std::size_t j = 0; j < searches.size(); ++j) {
                if (!searches[j].is_done()) {
                    searches[j].absorb(of_worker[j]);
                }
            }
        }
    }

    /// One more pass over all trials, kept or drawn again, for what the searches still need.
    void pass_again() {
        std::vector<std::vector<RankSearch::Tally>> tallies = new_tallies(searches_);
        std::vector<std::vector<RankSearch::Tally>> region_tallies = new_tallies(region_searches_);
        struct RegionScratch {
            Eigen::MatrixXd distances, work;
            std::vector<std::uint64_t> counts;
        };
        std::vector<RegionScratch> scratch(source_.workers().size());
        const bool counts_grid = !grid_done_ && grid_.size() > 0;
        const bool counts_histograms = waits_for_histograms();
        std::vector<std::vector<Histogram>> histograms(counts_histograms ? source_.workers().size() : 0, histograms_);
        const auto use = [&](unsigned worker, const Values& y) {
            for (std::size_t j = 0; j < searches_.size(); ++j) {
                if (!searches_[j].is_done()) {
                    searches_[j].add(y.col(static_cast<Eigen::Index>(j)).data(), y.rows(), tallies[worker][j]);
                }
            }
            for (std::size_t j = 0; counts_histograms && j < histograms_.size(); ++j) {
                count_values(y.col(static_cast<Eigen::Index>(j)).data(), y.rows(), histograms[worker][j]);
            }
            RegionScratch& mine = scratch[worker];
            if (!region_searches_.empty()) {
                distances_->evaluate(y, mine.distances, mine.work);
            }
            for (std::size_t j = 0; j < region_searches_.size(); ++j) {
                if (!region_searches_[j].is_done()) {
                    region_searches_[j].add(mine.distances.col(static_cast<Eigen::Index>(j)).data(), y.rows(),
                                            region_tallies[worker][j]);
                }
            }
            if (counts_grid) {
                mine.counts.resize(grid_.size(), 0);
                grid_.add(y, mine.counts);
            }
        };
        const std::uint64_t blocks = (trials_ + k_block - 1) / k_block;
        constexpr std::uint64_t round = 256;
        for (std::uint64_t begin = 0; begin < blocks; begin += round) {
            const std::uint64_t here = std::min(round, blocks - begin);
            source_.workers().run(static_cast<std::size_t>(here), [&](unsigned worker, std::size_t task) {
                const std::uint64_t first = (begin + task) * k_block;
                const std::uint64_t count = std::min(k_block, trials_ - first);
                if (keeps_all_) {
                    use(worker, kept_.middleRows(index(first), index(count)));
                } else {
                    source_.evaluate(worker, first, count,
                                     [&](std::uint64_t /*from*/, const Values& y) { use(worker, y); });
                }
            });
            // Drawing and evaluating the model is what costs: with kept trials a further pass is hardly noticed.
            done_ += keeps_all_ ? 0 : here;
            progress(blocks);
        }
        absorb(searches_, tallies);
        absorb(region_searches_, region_tallies);
        for (const RegionScratch& mine : scratch) {
            for (std::size_t cell = 0; cell < mine.counts.size(); ++cell) {
                grid_counts_[cell] += mine.counts[cell];
            }
        }
        grid_done_ = grid_done_ || counts_grid;
        for (const std::vector<Histogram>& of_worker : histograms) {
            for (std::size_t j = 0; j < histograms_.size(); ++j) {
                std::transform(histograms_[j].counts.begin(), histograms_[j].counts.end(), of_worker[j].counts.begin(),
                               histograms_[j].counts.begin(), std::plus<>());
            }
        }
        histograms_done_ = true;
        // What all threads have counted is together now; a search decides on whole counts only.
        for (std::size_t j = 0; j < searches_.size(); ++j) {
            if (!searches_[j].is_done()) {
                searches_[j].finish_pass(sums_.moments[j].smallest, sums_.moments[j].largest);
            }
        }
        for (RankSearch& search : region_searches_) {
            if (!search.is_done()) {
                // The exact extremes of the distances are not known. They bound only the outermost bins.
                search.finish_pass(0.0, std::numeric_limits<double>::max());
            }
        }
    }

    /// Shortest intervals of all batches of all outputs, those of an output together; none of batches that are too
    /// small.
    [[nodiscard]] std::vector<ShortestRange> shortest_of_batches() {
        std::vector<ShortestRange> ranges;
        // Too few trials in a batch: its shortest interval would say nothing of that of all trials.
        if (batch_ < k_smallest_batch || ranks_.inside == 0) {
            return ranges;
        }
        ranges.resize(static_cast<std::size_t>(m_) * k_batches);
        const std::uint64_t inside = CoverageRanks(options_.coverage_probability, batch_).inside;
        source_.workers().run(ranges.size(), [&](unsigned /*worker*/, std::size_t task) {
            const double* begin = kept_.col(index(task / k_batches)).data() + index(task % k_batches * batch_);
            std::vector<double> values(begin, begin + batch_);
            ranges[task] = shortest_range(values, inside);
        });
        return ranges;
    }

    /// Standard uncertainty of the ends of the shortest interval of an output.
    [[nodiscard]] CoverageInterval shortest_error(std::span<const ShortestRange> batches, double u) const {
        if (batches.empty()) {
            return {.low = u, .high = u};
        }
        Moments low;
        Moments high;
        for (const ShortestRange& range : batches) {
            low.merge(moments_of(&range.low.value, 1));
            high.merge(moments_of(&range.high.value, 1));
        }
        // The shortest interval settles as M^(-1/3) (NumericalError).
        const double scale = std::cbrt(static_cast<double>(batch_) / static_cast<double>(trials_));
        return {.low = low.standard_deviation() * scale, .high = high.standard_deviation() * scale};
    }

    MonteCarloOutput output(Eigen::Index j, std::span<const ShortestRange> batches) const {
        const Moments& moments = sums_.moments[static_cast<std::size_t>(j)];
        const RankSearch& search = searches_[static_cast<std::size_t>(j)];
        MonteCarloOutput result;
        result.mean = moments.mean;
        result.standard_uncertainty = moments.standard_deviation();
        result.histogram = histograms_[static_cast<std::size_t>(j)];
        // Where a distribution has no variance, the largest deviation keeps its share of the sum of squares however
        // many trials there are: then u means nothing.
        const double farthest = std::max(moments.largest - moments.mean, moments.mean - moments.smallest);
        result.largest_share = moments.m2 > 0.0 ? farthest * farthest / moments.m2 : 0.0;
        NumericalError& error = result.numerical_error;
        error.mean = result.standard_uncertainty / std::sqrt(static_cast<double>(trials_));
        error.standard_uncertainty = moments.error_of_standard_deviation();

        const auto end = [&](std::uint64_t rank, double& value, double& value_error) {
            const RankValue at = search.value(rank);
            const auto [below, above] = spread_of(rank);
            const double distance = search.value(above).value - search.value(below).value;
            // Near the smallest or largest value one side is cut off: then the whole distance.
            // The rank of a quantile scatters binomially: the order statistics one standard deviation away show what
            // this does to the value, whatever the density is.
            const bool cut = below == 0 || above == trials_ - 1;
            value = at.value;
            value_error = std::hypot(cut ? distance : 0.5 * distance, at.resolution);
        };
        end(ranks_.low, result.symmetric.low, error.symmetric.low);
        end(ranks_.low + ranks_.inside, result.symmetric.high, error.symmetric.high);
        // A single trial has no interval.
        if (ranks_.inside == 0) {
            result.shortest = result.symmetric;
            return result;
        }
        const ShortestRange shortest = search.shortest();
        result.shortest = {.low = shortest.low.value, .high = shortest.high.value};
        error.shortest = shortest_error(batches, result.standard_uncertainty);
        error.shortest.low = std::hypot(error.shortest.low, shortest.low.resolution);
        error.shortest.high = std::hypot(error.shortest.high, shortest.high.resolution);
        return result;
    }

    MonteCarloResult result() {
        MonteCarloResult result;
        result.trials = trials_;
        result.seed = options_.seed;
        result.coverage_probability = options_.coverage_probability;
        result.outputs.resize(static_cast<std::size_t>(m_));
        const std::vector<ShortestRange> batches = shortest_of_batches();
        source_.workers().run(static_cast<std::size_t>(m_), [&](unsigned /*worker*/, std::size_t j) {
            std::span<const ShortestRange> of_output(batches);
            if (!batches.empty()) {
                of_output = of_output.subspan(j * k_batches, k_batches);
            }
            result.outputs[j] = output(static_cast<Eigen::Index>(j), of_output);
        });
        result.covariance = covariance_;
        if (with_regions_) {
            MonteCarloRegions& regions = result.regions.emplace();
            const std::uint64_t rank = enclosing_rank(options_.coverage_probability, trials_);
            if (distances_->has_ellipsoid()) {
                regions.ellipsoid_factor = region_searches_[0].value(rank).value;
            }
            regions.no_ellipsoid_because = distances_->no_ellipsoid_because();
            regions.parallelepiped_factor = region_searches_[1].value(rank).value;
            if (grid_.size() > 0) {
                grid_.fill(regions, grid_counts_, trials_, options_.coverage_probability);
            }
        }
        report_progress(options_, 1.0);
        return result;
    }

    TrialSource& source_;
    const MonteCarloOptions& options_;
    std::uint64_t trials_;
    Eigen::Index m_;
    CoverageRanks ranks_;
    double progress_from_;
    bool keeps_all_ = false;
    bool with_regions_ = false;
    std::uint64_t batch_ = 0;
    int bits_ = 10;
    std::uint64_t done_ = 0;
    Eigen::MatrixXd kept_;
    Sums sums_;
    Eigen::MatrixXd covariance_;
    std::vector<RankSearch> searches_;
    std::unique_ptr<RegionDistances> distances_;
    std::vector<RankSearch> region_searches_;
    RegionGrid grid_;
    std::vector<std::uint64_t> grid_counts_;
    bool grid_done_ = false;
    std::vector<Histogram> histograms_;  // one an output
    bool histograms_done_ = false;
};

/// What one sequence of the adaptive procedure gives.
struct SequenceResult {
    Sums sums;
    std::vector<CoverageInterval> symmetric;
    double largest_eigenvalue = 0.0;
    double ellipsoid_factor = 0.0;
    double parallelepiped_factor = 0.0;
};

SequenceResult evaluate_sequence(TrialSource& source, const MonteCarloOptions& options, unsigned worker,
                                 std::uint64_t first, std::uint64_t trials) {
    const Eigen::Index m = source.outputs();
    Eigen::MatrixXd y(index(trials), m);
    SequenceResult result;
    source.evaluate(worker, first, trials, [&](std::uint64_t from, const Values& part) {
        y.middleRows(index(from - first), part.rows()) = part;
    });
    result.sums = sums_of(y, first);
    if (result.sums.not_finite > 0) {
        return result;
    }
    if (options.regions && m > 1) {
        const Eigen::MatrixXd covariance = result.sums.covariance();
        // The largest eigenvalue of the correlation matrix, as JCGM 102:2011, 7.8, watches it: it does not depend on
        // units.
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation_matrix(covariance),
                                                                   Eigen::EigenvaluesOnly);
        result.largest_eigenvalue = eigen.eigenvalues()(m - 1);
        const RegionDistances distances(result.sums.moments, covariance);
        Eigen::MatrixXd to;
        Eigen::MatrixXd scratch;
        distances.evaluate(y, to, scratch);
        const auto rank = index(enclosing_rank(options.coverage_probability, trials));
        for (Eigen::Index j = 0; j < 2; ++j) {
            std::nth_element(to.col(j).data(), to.col(j).data() + rank, to.col(j).data() + trials);
        }
        result.ellipsoid_factor = to(rank, 0);
        result.parallelepiped_factor = to(rank, 1);
    }
    // Each column is put in another order by itself from here on: nothing that needs whole trials may follow.
    const CoverageRanks ranks(options.coverage_probability, trials);
    for (Eigen::Index j = 0; j < m; ++j) {
        double* begin = y.col(j).data();
        double* end = begin + trials;
        // JCGM 101:2008, 7.7.2: only two order statistics are asked for, so nothing is sorted.
        std::nth_element(begin, begin + ranks.low, end);
        const double low = begin[ranks.low];
        double* high = begin + ranks.low + ranks.inside;
        // All values below the first end lie before it already: the second one is looked for among the rest.
        std::nth_element(begin + ranks.low, high, end);
        result.symmetric.push_back({.low = low, .high = *high});
    }
    return result;
}

/// Decides after each sequence whether there are enough (JCGM 101:2008, 7.9.4).
class StoppingTest {
public:
    StoppingTest(const MonteCarloOptions& options, Eigen::Index outputs)
        : digits_(options.adaptive->digits),
          tolerance_divisor_(options.adaptive->tolerance_divisor),
          regions_(options.regions && outputs > 1),
          without_variance_(static_cast<std::size_t>(outputs)),
          numbers_(static_cast<std::size_t>(4 * outputs + 3)) {}

    void add(const SequenceResult& sequence) {
        // u, and with it the tolerance, is that of all trials so far: that of one sequence would scatter too much.
        all_.merge(sequence.sums);
        for (std::size_t j = 0; j < sequence.symmetric.size(); ++j) {
            const Moments& moments = sequence.sums.moments[j];
            take(4 * j, moments.mean);
            take(4 * j + 1, moments.standard_deviation());
            take(4 * j + 2, sequence.symmetric[j].low);
            take(4 * j + 3, sequence.symmetric[j].high);
        }
        const std::size_t regions = numbers_.size() - 3;
        take(regions, sequence.largest_eigenvalue);
        take(regions + 1, sequence.ellipsoid_factor);
        take(regions + 2, sequence.parallelepiped_factor);
    }

    [[nodiscard]] std::vector<double> tolerance() const {
        std::vector<double> result;
        for (std::size_t j = 0; j < all_.moments.size(); ++j) {
            result.push_back(of(without_variance_[j] ? quarter(j) : all_.moments[j].standard_deviation()));
        }
        return result;
    }

    /// Of this output alone: mean, u and both ends, or the ends where it has no variance.
    [[nodiscard]] bool is_stable(std::size_t output) const {
        // A standard deviation of the sequences needs two of them.
        return numbers_.front().count >= 2 && settled(4 * output + 2) && settled(4 * output + 3) &&
               (without_variance_[output] || (settled(4 * output) && settled(4 * output + 1)));
    }

    [[nodiscard]] bool is_stable() const {
        for (std::size_t j = 0; j < without_variance_.size(); ++j) {
            if (!is_stable(j)) {
                return false;
            }
        }
        // What outputs have together is measured by u of each of them.
        if (!regions_ ||
            std::find(without_variance_.begin(), without_variance_.end(), true) != without_variance_.end()) {
            return true;
        }
        // Eigenvalue and factors are numbers of their own, with digits of their own: their tolerance follows from their
        // mean.
        return std::all_of(numbers_.end() - 3, numbers_.end(),
                           [&](const Moments& number) { return settled(number, of(number.mean)); });
    }

    /// Outputs that wait for their mean or u alone.
    [[nodiscard]] std::vector<std::size_t> waiting_for_moments() const {
        std::vector<std::size_t> outputs;
        for (std::size_t j = 0; j < without_variance_.size(); ++j) {
            if (!without_variance_[j] && !is_stable(j) && settled_ends(j)) {
                outputs.push_back(j);
            }
        }
        return outputs;
    }

    void set_without_variance(std::size_t output) { without_variance_[output] = true; }
    [[nodiscard]] bool is_without_variance(std::size_t output) const { return without_variance_[output]; }

private:
    void take(std::size_t at, double value) { numbers_[at].merge(moments_of(&value, 1)); }
    /// A quarter of the width of the interval: u of a normal output for a probability of 95 %.
    [[nodiscard]] double quarter(std::size_t output) const {
        return 0.25 * (numbers_[4 * output + 3].mean - numbers_[4 * output + 2].mean);
    }
    [[nodiscard]] bool settled(std::size_t at) const {
        const std::size_t output = at / 4;
        return settled(numbers_[at],
                       of(without_variance_[output] ? quarter(output) : all_.moments[output].standard_deviation()));
    }
    [[nodiscard]] bool settled_ends(std::size_t output) const {
        const double tolerance = of(quarter(output));
        return settled(numbers_[4 * output + 2], tolerance) && settled(numbers_[4 * output + 3], tolerance);
    }
    /// A number that is 0 does not vary either: nothing is asked of it.
    [[nodiscard]] double of(double u) const {
        return u > 0.0 ? numerical_tolerance(u, digits_) / tolerance_divisor_ : 0.0;
    }
    /// Twice the standard deviation of the average.
    [[nodiscard]] static bool settled(const Moments& number, double tolerance) {
        // 2 s/√h ≤ δ, s the standard deviation of the h sequences, s/√h that of their average.
        return 2.0 * number.standard_deviation() / std::sqrt(static_cast<double>(number.count)) <= tolerance;
    }

    int digits_;
    double tolerance_divisor_;
    bool regions_;
    std::vector<bool> without_variance_;
    Sums all_;
    std::vector<Moments> numbers_;
};

/// Whether the numerical errors of the numbers that a run states of an output are below the tolerance that it was ended
/// by. A few sequences may agree by chance where trials are rare at an end of the interval, as between two clusters.
bool errors_are_within(const MonteCarloOutput& output, double tolerance) {
    const NumericalError& error = output.numerical_error;
    const bool ends = error.symmetric.low <= tolerance && error.symmetric.high <= tolerance;
    return ends && (output.without_variance || (error.mean <= tolerance && error.standard_uncertainty <= tolerance));
}

constexpr std::uint64_t k_first_look_at_tails = 1'000'000;  // trials, then at each doubling of them

MonteCarloResult run_adaptive(TrialSource& source, const MonteCarloOptions& options) {
    const AdaptiveTrials& adaptive = *options.adaptive;
    // JCGM 101:2008, 7.9.4: J is the smallest integer not below 100/(1 − p); 1 − p is rounded, and must not add one.
    const double wanted = std::ceil(100.0 / (1.0 - options.coverage_probability) * (1.0 - 1e-12));
    // At least 10⁴ trials a sequence, where J would be less (JCGM 101:2008, 7.9.4).
    const auto sequence_trials =
        static_cast<std::uint64_t>(std::clamp(wanted, 1e4, static_cast<double>(k_most_trials)));
    const std::uint64_t most = adaptive.most_trials / sequence_trials;
    if (most < 2) {
        refuse("GC-GUM-0126", "monte carlo", "at most " + std::to_string(adaptive.most_trials) + " trials",
               "the adaptive procedure takes two sequences of " + std::to_string(sequence_trials) +
                   " trials or more for this coverage probability",
               "Raise the limit, or give a fixed number of trials.");
    }
    StoppingTest test(options, source.outputs());
    Sums all;
    std::uint64_t sequences = 0;
    std::uint64_t least = 2;
    std::uint64_t look = k_first_look_at_tails;
    bool stable = false;
    // A round has one sequence a thread. The test takes them in their order and ends in the middle of a round where it
    // has to, or the number of trials would depend on the threads.
    const std::uint64_t round = source.workers().size();
    std::vector<SequenceResult> results(static_cast<std::size_t>(round));
    for (;;) {
        while (!stable && sequences < most) {
            const std::uint64_t here = std::min(round, most - sequences);
            source.workers().run(static_cast<std::size_t>(here), [&](unsigned worker, std::size_t task) {
                results[task] =
                    evaluate_sequence(source, options, worker, (sequences + task) * sequence_trials, sequence_trials);
            });
            // Sequences of this round beyond the one that settles the matter are as if they had not been drawn.
            for (std::uint64_t task = 0; task < here && !stable; ++task) {
                ++sequences;
                const SequenceResult& sequence = results[static_cast<std::size_t>(task)];
                if (sequence.sums.not_finite > 0) {
                    source.refuse_trial(sequence.sums, sequences * sequence_trials);
                }
                test.add(sequence);
                stable = sequences >= least && test.is_stable();
                if (!stable && options.has_no_variance && sequences * sequence_trials >= look) {
                    look = 2 * sequences * sequence_trials;
                    for (const std::size_t output : test.waiting_for_moments()) {
                        if (options.has_no_variance(index(output), sequences * sequence_trials)) {
                            test.set_without_variance(output);
                        }
                    }
                    stable = sequences >= least && test.is_stable();
                }
            }
            report_progress(options, 0.5 * static_cast<double>(sequences) / static_cast<double>(most));
        }
        FixedRun run(source, options, sequences * sequence_trials, 0.5);
        MonteCarloResult result = run.run();
        result.tolerance = test.tolerance();
        result.stabilised = stable;
        for (std::size_t j = 0; j < result.outputs.size(); ++j) {
            MonteCarloOutput& output = result.outputs[j];
            output.without_variance = test.is_without_variance(j);
            output.stabilised = test.is_stable(j) && errors_are_within(output, result.tolerance[j]);
            result.stabilised = result.stabilised && output.stabilised;
        }
        if (result.stabilised || sequences >= most) {
            return result;
        }
        // The sequences agree by chance: at least twice as many are looked at before they are believed again.
        least = std::min(most, 2 * sequences);
        stable = false;
    }
}

void require_digits(int digits) {
    if (digits != 1 && digits != 2) {
        refuse("GC-GUM-0126", "significant digits", std::to_string(digits),
               "one or two digits of an uncertainty are meaningful", "Give 1 or 2.");
    }
}

}  // namespace

double numerical_tolerance(double u, int digits) {
    require_positive(u, "standard uncertainty");
    require_digits(digits);
    // The decimal exponent from decimal digits: a logarithm may be off by one at powers of ten. Those after the 14th
    // are the rounding of a computation: 9.999999999999998 is 10.
    constexpr int k_digits = 14;
    std::array<char, 32> text{};
    const std::to_chars_result written =
        std::to_chars(text.data(), text.data() + text.size(), u, std::chars_format::scientific, k_digits - 1);
    const char* exponent = std::find(static_cast<const char*>(text.data()), static_cast<const char*>(written.ptr), 'e');
    int power = 0;
    std::from_chars(exponent[1] == '+' ? exponent + 2 : exponent + 1, written.ptr, power);
    // u = c 10^ℓ with ℓ = power − digits + 1: ½ 10^ℓ is 5·10^(power − digits). Read as text it is the double nearest to
    // that, which a product with a power of ten need not be.
    const std::string half_unit = "5e" + std::to_string(power - digits);
    double tolerance = 0.0;
    std::from_chars(half_unit.data(), half_unit.data() + half_unit.size(), tolerance);
    return tolerance;
}

MonteCarloResult run_monte_carlo(const MeasurementModel& model, const MonteCarloOptions& options) {
    require_probability(options.coverage_probability, "coverage probability");
    const auto require_trials = [](std::uint64_t trials) {
        if (trials == 0 || trials > k_most_trials) {
            refuse("GC-GUM-0121", "monte carlo trials", std::to_string(trials),
                   "the number of trials lies between 1 and 10^10", "Give a number of trials in that range.");
        }
    };
    if (options.adaptive) {
        require_digits(options.adaptive->digits);
        require_trials(options.adaptive->most_trials);
    } else {
        require_trials(options.trials);
    }
    if (model.outputs().empty()) {
        throw std::logic_error("measurement model: no outputs");
    }
    TrialSource source(model, options);
    if (options.adaptive) {
        return run_adaptive(source, options);
    }
    return FixedRun(source, options, options.trials, 0.0).run();
}

Eigen::VectorXd monte_carlo_trial(const MeasurementModel& model, std::uint64_t seed, std::uint64_t trial,
                                  const std::vector<std::uint64_t>& streams) {
    const InputDraws draws(model.inputs(), seed, streams);
    Eigen::MatrixXd x(1, draws.size());
    draws.draw(trial, x);
    return x.row(0).transpose();
}

Validation validate(double value, double standard_uncertainty, double expanded_uncertainty,
                    const CoverageInterval& interval, const CoverageInterval& interval_error, int digits) {
    require_finite(value, "value");
    require_positive(standard_uncertainty, "standard uncertainty");
    require_not_negative(expanded_uncertainty, "expanded uncertainty");
    require_finite(interval.low, "lower end of the coverage interval");
    require_finite(interval.high, "upper end of the coverage interval");
    require_not_negative(interval_error.low, "numerical error of the lower end");
    require_not_negative(interval_error.high, "numerical error of the upper end");
    Validation result;
    result.tolerance = numerical_tolerance(standard_uncertainty, digits);
    // Both ends are compared, because an interval that is shifted may have the same width.
    result.distance_low = std::abs(value - expanded_uncertainty - interval.low);
    result.distance_high = std::abs(value + expanded_uncertainty - interval.high);
    result.validated = result.distance_low <= result.tolerance && result.distance_high <= result.tolerance;
    // A fifth of the tolerance: only then the numerical error does not decide on the validation (JCGM 101:2008, 8.2).
    result.numerical_limit = result.tolerance / 5.0;
    // An end that is off by more than its numerical error could explain is off, however few the trials.
    constexpr double k_beyond_doubt = 5.0;
    const bool is_off = result.distance_low > result.tolerance + k_beyond_doubt * interval_error.low ||
                        result.distance_high > result.tolerance + k_beyond_doubt * interval_error.high;
    result.precise_enough =
        is_off || (interval_error.low < result.numerical_limit && interval_error.high < result.numerical_limit);
    return result;
}

}  // namespace gumcert::gum
