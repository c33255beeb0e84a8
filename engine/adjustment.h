#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/fixed_parts.h"

namespace gumcert::engine {

/// A matrix with many rows of which a few neighbours are used at a time: they stand together in memory.
using TallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Functional model of one group of observations: predicted values and their derivatives.
class ObservationModel {
public:
    virtual ~ObservationModel() = default;

    /// \param parameters  one pointer a parameter block, in the order in which the group was added
    /// \param predicted   n predicted observations, written
    /// \param jacobians   null, or one pointer a block: n×size of the block, row-major, written; a pointer may be null
    virtual void predict(const double* const* parameters, double* predicted, double* const* jacobians) const = 0;
};

struct SolverOptions {
    int max_iterations = 50;    ///< of Ceres
    int max_refinements = 500;  ///< Gauss-Newton steps after it; outliers that are kept make them slow
    /// Converged when the next Gauss-Newton step of every parameter is below this fraction of its standard uncertainty.
    double step_tolerance = 1e-6;
    /// Above 0, for solve() only: groups whose whitened residuals are together larger than this count less and less
    /// (Cauchy's loss), and nothing is refined. Finds where all others agree when some are grossly wrong; no result.
    double robust_scale = 0.0;
    /// Squared ratio of smallest to largest singular value of the column-scaled Jacobian below which the parameters
    /// count as not determined.
    double rank_tolerance = 1e-12;
};

struct SolveSummary {
    bool converged = false;
    int iterations = 0;
    double chi_square = 0.0;  ///< vᵀ V⁻¹ v, with the residuals that the last step leaves
    std::string message;      ///< of the solver, for diagnostics
};

/// One free parameter of an adjustment.
struct FreeParameter {
    std::size_t block = 0;
    int component = 0;
    std::string name;
};

/// A group of observations, linearised and whitened with the Cholesky factor L of its covariance V = L Lᵀ.
struct LinearisedGroup {
    std::vector<Eigen::Index> columns;  ///< free parameters that the group depends on
    Eigen::MatrixXd jacobian;           ///< L⁻¹ J, n×columns
    Eigen::VectorXd residual;           ///< L⁻¹ (observed - predicted), n
    Eigen::MatrixXd cholesky;           ///< L, n×n lower triangular
};

/// What is not determined by the observations.
struct RankReport {
    bool deficient = false;
    double smallest_to_largest = 0.0;     ///< eigenvalue ratio of the column-scaled normal equations
    std::vector<std::string> parameters;  ///< names of the parameters that take part in the undetermined combination
};

/// (Jᵀ V⁻¹ J)⁻¹ of bordered block-diagonal normal equations, in a form whose size is proportional to the parameters.
///
/// With the covariance C of the border, F = ∂(eliminated)/∂border and the covariance W of every eliminated block at a
/// known border: covariance of the border C, across F C, of the eliminated F C Fᵀ + W.
class BorderedCovariance {
public:
    using Indices = std::vector<Eigen::Index>;

    [[nodiscard]] Eigen::Index size() const { return border_covariance_.rows() + elimination_.rows(); }
    [[nodiscard]] Eigen::Index border() const { return border_covariance_.rows(); }
    /// C, b×b.
    [[nodiscard]] const Eigen::MatrixXd& border_covariance() const { return border_covariance_; }
    /// A root R of C = R Rᵀ, b×b.
    [[nodiscard]] const Eigen::MatrixXd& border_root() const { return border_root_; }
    /// F, (p-b)×b, row i for parameter b + i.
    [[nodiscard]] const TallMatrix& elimination() const { return elimination_; }
    /// W of the eliminated block that a parameter i ≥ b is in, and the first parameter of that block.
    [[nodiscard]] const Eigen::MatrixXd& own(Eigen::Index parameter) const;
    [[nodiscard]] Eigen::Index first_of(Eigen::Index parameter) const;

    [[nodiscard]] double operator()(Eigen::Index row, Eigen::Index column) const;
    [[nodiscard]] Eigen::MatrixXd operator()(const Indices& rows, const Indices& columns) const;
    /// X times the covariance, k×p, for k×p; its costs are proportional to k p.
    [[nodiscard]] Eigen::MatrixXd times_left(const Eigen::Ref<const Eigen::MatrixXd>& rows) const;
    /// The covariance times v, p.
    [[nodiscard]] Eigen::VectorXd times(const Eigen::Ref<const Eigen::VectorXd>& vector) const;
    /// All p×p elements.
    [[nodiscard]] Eigen::MatrixXd dense() const;

private:
    friend class NormalEquations;
    struct Own {
        Eigen::Index first = 0;      ///< parameter
        Eigen::MatrixXd covariance;  ///< W
        Eigen::MatrixXd total;       ///< F C Fᵀ + W
    };
    Eigen::MatrixXd border_covariance_, border_root_;
    TallMatrix elimination_;
    TallMatrix cross_;  ///< F C
    std::vector<Own> own_;
    std::vector<std::size_t> own_of_;  ///< by eliminated parameter
};

/// Normal equations of a linearised adjustment, kept in their bordered block-diagonal form.
///
/// Parameters are ordered border first, then the eliminated blocks one after the other; no observation group touches
/// two eliminated blocks. Jᵀ V⁻¹ J is then block-diagonal with a border, and everything below costs a Schur complement
/// of the size of the border.
class NormalEquations {
public:
    [[nodiscard]] Eigen::Index parameter_count() const { return static_cast<Eigen::Index>(parameters_.size()); }
    /// Parameters of the border, which come first.
    [[nodiscard]] Eigen::Index border_count() const { return border_; }
    [[nodiscard]] const std::vector<FreeParameter>& parameters() const { return parameters_; }
    [[nodiscard]] const std::vector<LinearisedGroup>& groups() const { return groups_; }
    /// Index of a free parameter, or -1 when it is held.
    [[nodiscard]] Eigen::Index column(std::size_t block, int component) const;
    /// Of the first component that is not held, or -1 when all are.
    [[nodiscard]] Eigen::Index first_column(std::size_t block) const;

    [[nodiscard]] RankReport rank(double tolerance) const;
    /// (Jᵀ V⁻¹ J)⁻¹, order of `parameters()`; requires full rank.
    [[nodiscard]] BorderedCovariance bordered_covariance() const;
    /// The same with all its p×p elements.
    [[nodiscard]] Eigen::MatrixXd covariance() const { return bordered_covariance().dense(); }
    /// Gauss-Newton step (Jᵀ V⁻¹ J)⁻¹ Jᵀ V⁻¹ (observed - predicted), p.
    [[nodiscard]] Eigen::VectorXd step() const;
    /// Ratio of the largest to the smallest singular value of the whitened Jacobian with columns of unit length; by
    /// Lanczos iteration, whose costs are proportional to the parameters. Accuracy: relative error about 1e-16 times
    /// its square, as of any method on normal equations.
    [[nodiscard]] double condition_number() const;
    [[nodiscard]] double chi_square() const;
    [[nodiscard]] Eigen::Index observation_count() const;

private:
    friend class Adjustment;
    struct EliminatedBlock {
        Eigen::Index first = 0;
        std::vector<std::size_t> groups;  ///< that touch it
        Eigen::MatrixXd normal;           ///< A_ee, size×size
        TallMatrix border;                ///< A_eb, size×border columns
        Eigen::MatrixXd inverse;          ///< A_ee⁻¹
        TallMatrix elimination;           ///< A_ee⁻¹ A_eb
    };
    /// Of one part of the blocks.
    struct Sums {
        Eigen::MatrixXd border, eliminated;  ///< A_bb, and what the elimination takes off it (lower triangle), b×b
        Eigen::VectorXd gradient;            ///< of the border
        Eigen::MatrixXd product = {};        ///< of the group that is added
        Eigen::VectorXd pull = {};
    };
    /// Adds up the groups, and eliminates the blocks.
    void accumulate();
    void add(const LinearisedGroup& group, EliminatedBlock* block, Sums& sums);
    /// Residuals that a step leaves where the model is linear.
    void move(const Eigen::VectorXd& step);
    [[nodiscard]] FixedParts blocks_in_parts() const;
    /// (Jᵀ V⁻¹ J) v.
    [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& vector) const;

    std::vector<FreeParameter> parameters_;
    std::vector<std::vector<Eigen::Index>> column_of_;  ///< per block and component
    Eigen::Index border_ = 0;
    std::vector<LinearisedGroup> groups_;
    std::vector<std::size_t> groups_of_border_;  ///< that touch no eliminated block
    Eigen::MatrixXd border_normal_;
    Eigen::MatrixXd reduced_;   ///< of the border, after the elimination
    Eigen::VectorXd gradient_;  ///< Jᵀ V⁻¹ (observed - predicted), p
    std::vector<EliminatedBlock> blocks_;
    Workers workers_;
};

/// Least-squares adjustment with correlated groups of observations and groups of pseudo-observations.
///
/// Minimises Σ_g (l_g - f_g(x))ᵀ V_g⁻¹ (l_g - f_g(x)) (generalised least squares; JCGM 102:2011 calls the result a
/// multivariate, implicitly defined measurement model). Solved by Ceres with the eliminated blocks as the first group
/// of the Schur complement, on one thread, then finished by Gauss-Newton steps on the exact normal equations until the
/// next step is negligible against the standard uncertainties: tolerances of a general solver are not evidence.
/// Accuracy: covariance within 1e-9 of u_i u_j of the dense inverse (docs/accuracy.md#adjustment-of-distances).
/// Example: examples/api/distances.cpp
class Adjustment {
public:
    using BlockId = std::size_t;
    using GroupId = std::size_t;

    /// \param names       one name a component, as messages say it ("station P1, x")
    /// \param eliminated  true for many small blocks of which no two meet in one group
    BlockId add_parameters(std::vector<std::string> names, Eigen::VectorXd start, bool eliminated = false);
    /// Keep a component at its present value.
    void hold(BlockId block, int component);

    /// \param observed    n values
    /// \param covariance  V, n×n, positive definite
    GroupId add_observations(std::shared_ptr<const ObservationModel> model, std::vector<BlockId> blocks,
                             Eigen::VectorXd observed, const Eigen::MatrixXd& covariance);
    /// Pseudo-observations of components of one block: `observed` with covariance V (a prior, e.g. CMM coordinates).
    GroupId add_prior(BlockId block, std::vector<int> components, Eigen::VectorXd observed,
                      const Eigen::MatrixXd& covariance);
    void set_covariance(GroupId group, const Eigen::MatrixXd& covariance);
    void set_observed(GroupId group, Eigen::VectorXd observed) { groups_[group].observed = std::move(observed); }

    [[nodiscard]] const Eigen::VectorXd& parameters(BlockId block) const { return blocks_[block].value; }
    void set_parameters(BlockId block, Eigen::VectorXd value) { blocks_[block].value = std::move(value); }
    /// Observed minus predicted of a group at the present parameters, not whitened.
    [[nodiscard]] Eigen::VectorXd residual(GroupId group) const;
    /// Derivatives of the predicted observations of a group with respect to one of its blocks, n×size, not whitened.
    [[nodiscard]] Eigen::MatrixXd jacobian(GroupId group, BlockId block) const;

    /// The threads that the following calls share their work among; results are the same bytes with any.
    void set_workers(Workers workers) { workers_ = std::move(workers); }
    [[nodiscard]] const Workers& workers() const { return workers_; }

    [[nodiscard]] NormalEquations linearise() const;
    /// Solve from the present parameters.
    [[nodiscard]] SolveSummary solve(const SolverOptions& options);
    /// Gauss-Newton steps only, from parameters that are close already (new weights, one observation less).
    [[nodiscard]] SolveSummary refine(const SolverOptions& options);
    /// The same.
    /// \param last  where it ends: the equations of the last step with the residuals that this step leaves. Their
    ///              derivatives are those before it, which differ by what is below the tolerance of the step.
    [[nodiscard]] SolveSummary refine(const SolverOptions& options, NormalEquations& last);
    /// Add `step`, in the order of NormalEquations::parameters(), to the free parameters.
    void apply(const NormalEquations& normal, const Eigen::VectorXd& step);

private:
    struct Block {
        std::vector<std::string> names;
        Eigen::VectorXd value;
        std::vector<bool> held;
        bool eliminated = false;
    };
    struct Group {
        std::shared_ptr<const ObservationModel> model;
        std::vector<BlockId> blocks;
        Eigen::VectorXd observed;
        Eigen::MatrixXd cholesky;
        bool is_prior = false;
    };
    class WhitenedCost;
    [[nodiscard]] NormalEquations structure() const;
    void linearise(NormalEquations& normal) const;

    std::vector<Block> blocks_;
    std::vector<Group> groups_;
    Workers workers_;
};

}  // namespace gumcert::engine
