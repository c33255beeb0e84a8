#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "gum/quantity/distribution.h"

namespace gumcert::gum {

enum class Evaluation { type_a, type_b };  ///< how a standard uncertainty was obtained (JCGM 100:2008, 2.3.2 and 2.3.3)

/// How the quantities of a correlated group are drawn together. It has no meaning where the covariance is diagonal.
enum class Dependence {
    normal,            ///< multivariate normal (JCGM 101:2008, 6.4.8); all marginals are normal
    student_t,         ///< multivariate t (JCGM 102:2011, 5.3.2); all marginals are t with the same ν
    gaussian_copula,   ///< any marginals over correlated normal deviates; a choice, and recorded as one
    same_probability,  ///< all take the quantile of one probability: r = 1 for marginals of one shape
    joint_samples,     ///< one row of `InputGroup::samples` a trial, each with the same probability
};

/// An input quantity as messages name it.
struct InputQuantity {
    std::string name;
    std::string unit;  ///< coherent SI unit, e.g. "m"
};

/// Input quantities that share one source of uncertainty and one covariance block.
///
/// Quantities of different groups are uncorrelated; inside a group the covariance says everything. A budget has one row
/// a group, or one row a `source` when several groups name the same one.
struct InputGroup {
    std::string name;    ///< what the budget row is called, e.g. "table repeatability, linear"
    std::string source;  ///< the source that it belongs to, e.g. "table repeatability"
    std::string unit;    ///< coherent SI unit of the values, e.g. "m"; empty where `quantities` has one of each
    Evaluation evaluation = Evaluation::type_b;
    std::string distribution = "normal";
    Eigen::VectorXd value;       ///< n estimates, [unit]
    Eigen::MatrixXd covariance;  ///< n×n, [unit²]; or n×1: the diagonal of a diagonal matrix
    /// n×n, lower triangular, L with L Lᵀ = covariance, where it is known better than from the covariance: the rounded
    /// covariance of a fit far from 0 is singular, and u² of what it predicts is lost in it. Empty: from the covariance.
    Eigen::MatrixXd factor = {};
    /// Of the whole group as one contribution. NaN: none can be stated, because Welch-Satterthwaite does not hold for
    /// correlated quantities with different degrees of freedom (JCGM 100:2008, G.4.1); the reason is beside it.
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    std::string no_degrees_of_freedom_because = {};  ///< a sentence for people; empty where there are some
    /// Finite degrees of freedom are those of the whole covariance matrix, estimated from readings of all quantities that
    /// were taken together (Wishart); else they are those of one scale of it.
    bool is_estimated_matrix = false;

    /// What Monte Carlo draws, one a quantity: empty means the normal distribution with `value` and `covariance`. Where
    /// the quantities are correlated, `dependence` says how they are tied together.
    std::vector<Distribution> marginals = {};
    Dependence dependence = Dependence::normal;
    /// Gaussian copula: correlation of the normal deviates behind the quantities, n×n; empty: that of `covariance`.
    Eigen::MatrixXd normal_correlation = {};
    /// Joint samples: a row a sample, a column a quantity, [unit].
    std::shared_ptr<const Eigen::MatrixXd> samples = {};
    /// Where test points share some quantities of a correlated group and not others: the random stream from which a
    /// quantity is drawn at this point alone, given those that are shared; k_shared for these. Empty: none.
    static constexpr std::uint64_t k_shared = ~std::uint64_t{0};
    std::vector<std::uint64_t> own_streams = {};
    /// Each by its own name and unit; empty: numbered, and all in the unit of the group.
    std::vector<InputQuantity> quantities = {};

    [[nodiscard]] Eigen::Index size() const { return value.size(); }
    /// \param i  from 0, below size()
    [[nodiscard]] InputQuantity quantity(Eigen::Index i) const;
    [[nodiscard]] bool is_diagonal() const { return covariance.cols() == 1 && value.size() != 1; }
};

struct OutputQuantity {
    std::string name;  ///< e.g. "EXA(30°)"
    std::string unit;  ///< coherent SI unit, e.g. "m"
};

/// A measurement model y = f(x) as the GUM layer sees it (VIM 2.48; JCGM 100:2008, 4.1.1).
///
/// An equation, a least-squares fit and the adjustment of a rotary table are models alike. The inputs x are the groups
/// one after the other, each in the order of its `value`.
class MeasurementModel {
public:
    virtual ~MeasurementModel() = default;

    [[nodiscard]] virtual const std::vector<InputGroup>& inputs() const = 0;
    [[nodiscard]] virtual const std::vector<OutputQuantity>& outputs() const = 0;

    /// \param x  n estimates of the inputs, coherent SI
    /// \return   m values of the outputs, coherent SI
    /// \throws NoResultError if the model has no finite value there
    [[nodiscard]] virtual Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const = 0;

    /// \return sensitivity coefficients c = ∂y/∂x at x, m×n, [unit of y / unit of x] (JCGM 100:2008, 5.1.3)
    [[nodiscard]] virtual Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const = 0;

    /// Second derivatives ∂²y_k/∂x_i∂x_j at x for the second-order terms of JCGM 100:2008, 5.1.2 note.
    /// \return m symmetric matrices n×n; nothing when the model does not offer them
    [[nodiscard]] virtual std::vector<Eigen::MatrixXd> hessians(const Eigen::VectorXd& x) const;

    /// Evaluates many trials at once, for Monte Carlo. Called from several threads at a time.
    /// \param x  trials×n: column i holds the drawn values of input i, coherent SI
    /// \param y  trials×m, receives the outputs. A trial without a finite value gets one that is not finite: it is
    ///           counted and stops the run there, not here.
    virtual void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const;
};

/// The estimates of all groups, one after the other: n values, coherent SI.
[[nodiscard]] Eigen::VectorXd input_estimates(const MeasurementModel& model);

}  // namespace gumcert::gum
