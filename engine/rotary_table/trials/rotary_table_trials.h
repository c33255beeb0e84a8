#pragma once

#include <Eigen/Core>

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_model.h"
#include "engine/rotary_table/table_parameters.h"
#include "engine/rotary_table/trials/trial_solution.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::engine {

struct TrialBatch;
struct TrialDatum;
struct TrialNetwork;

/// How many steps the trials took. Trials that are evaluated twice count twice.
struct TrialSteps {
    std::uint64_t trials = 0;
    std::uint64_t steps = 0;  ///< of all trials together
    int most = 0;             ///< of one trial
    std::uint64_t alone = 0;  ///< trials that needed new normal equations
    std::uint64_t not_converged = 0;

    [[nodiscard]] double mean() const {
        return trials > 0 ? static_cast<double>(steps) / static_cast<double>(trials) : 0.0;
    }
};

/// What else goes into the trials.
struct TrialExtras {
    /// Model of the CMM coordinates, 3n outputs in the order x1 y1 z1 x2 …, [m]. The deviations of its values from
    /// its value at its estimates are added to the stated coordinates.
    std::shared_ptr<const gum::MeasurementModel> fixture = {};
    std::shared_ptr<const DerivedQuantities> derived = {};
    TrialOptions options = {};
};

/// The adjustment of a rotary table for the propagation of distributions (JCGM 101:2008, clause 7): every trial draws
/// the data and solves the adjustment again, not linearised.
///
/// Inputs, in this order; groups with variance zero are left out:
/// - "length noise": deviations of the measured lengths, in the order of the visits and their distances, [m]
/// - "resolution of the lengths": what the display rounded away, uniform within half a step, [m]
/// - "table repeatability, linear", "…, axial", "…, tilt": deviation δ of the table at every visit, three, one and two
///   a visit (`repeatability_order`), [m] and [rad]
/// - "scale of the stations": where the scale has a prior, [1]
/// - "CMM coordinates of the fixture", [m]; or, where the fixture has a model of its own, the groups of that model
/// - "temperature of the fixture", [K], and "expansion coefficient of the fixture", [1/K], where they are uncertain
/// - "…, estimated variance": one a component whose variance was estimated, χ²_ν/ν with its ν degrees of freedom. The
///   deviations of the component are divided by its root, all by the same: together they are scaled and shifted t with
///   one estimate of the variance (JCGM 101:2008, 6.4.9), not as many t as there are deviations.
///
/// The lengths are corrected as in RotaryTableModel: l + noise + r - A δ, A = ∂l/∂pose of the visit. Dead paths are no
/// inputs: every trial finds them again, as the measurement did.
///
/// A trial minimises vᵀ V⁻¹ v with the exact kinematics and the weights of the solution (held): steps N⁻¹ Jᵀ V⁻¹ v with
/// N of the solution and J, v of the trial, until they are negligible (`TrialOptions`). Expansion and temperatures,
/// whose products act on the lengths, are no part of N: every step finds their own minimum (TrialNetwork). A trial for
/// which N is too far off gets its own by Adjustment::refine(), whose minimum is the same in any case. A trial is
/// computed with 15 others at a time, but none depends on another: how trials are cut into parts changes no bit.
///
/// Outputs: `ReportedQuantities`, then the derived quantities if there are any.
class RotaryTableTrials final : public gum::MeasurementModel {
public:
    /// A variance estimated with no more degrees of freedom than these is not drawn: a t-distribution without a fourth
    /// moment would draw deviations thousands of times larger than any of the measurement. Trials that take it as known
    /// lack its spread (JCGM 101:2008, 6.4.9), so that they say nothing of a quantity in which it has a part: there the
    /// law of propagation stands, with its degrees of freedom (RotaryTableMonteCarlo::law_stands).
    static constexpr double k_least_degrees_of_freedom = 4.0;

    /// \param solved      converged, at its final weights, which are held; is not referred to afterwards
    /// \param stochastic  of these weights
    /// \throws gum::NoResultError  if the normal equations are singular
    RotaryTableTrials(const JointAdjustment& solved, const StochasticModel& stochastic,
                      const SourceDegreesOfFreedom& degrees_of_freedom, TrialExtras extras = {});
    /// Of the model for the law of propagation, with the degrees of freedom that its groups of inputs have.
    explicit RotaryTableTrials(const RotaryTableModel& model, TrialExtras extras = {});
    ~RotaryTableTrials() override;
    RotaryTableTrials(const RotaryTableTrials&) = delete;
    RotaryTableTrials& operator=(const RotaryTableTrials&) = delete;

    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return inputs_; }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    /// \throws gum::NoResultError  if the trial does not converge
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    /// By central differences, a tenth of the standard uncertainty of each input to either side.
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;
    /// A trial that does not converge even with its own normal equations gets NaN.
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const override;

    [[nodiscard]] const ReportedQuantities& quantities() const { return quantities_; }
    /// Of all trials so far, by whatever thread.
    [[nodiscard]] TrialSteps steps() const;

private:
    /// Columns of the inputs; -1: not there.
    struct Columns {
        Eigen::Index noise = -1, resolution = -1, linear = -1, axial = -1, tilt = -1, scale = -1, fixture = -1,
                     temperature = -1, expansion = -1;
        Eigen::Index noise_variance = -1, linear_variance = -1, axial_variance = -1, tilt_variance = -1,
                     fixture_variance = -1;
    };

    void add_inputs(const JointAdjustment& solved, const StochasticModel& stochastic,
                    const SourceDegreesOfFreedom& degrees_of_freedom);
    void draw_in(const Eigen::Ref<const Eigen::MatrixXd>& x, const Eigen::MatrixXd& coordinates, Eigen::Index first,
                 Eigen::Index count, TrialBatch& batch) const;
    void write_derived(Eigen::Index first, Eigen::Index count, const TrialBatch& batch,
                       Eigen::Ref<Eigen::MatrixXd> y) const;

    TrialExtras extras_;
    ReportedQuantities quantities_;
    std::vector<gum::OutputQuantity> outputs_;
    std::vector<gum::InputGroup> inputs_;
    Columns columns_;
    Eigen::Index fixture_inputs_ = 0;  ///< of the model of the fixture
    Eigen::VectorXd fixture_value_;    ///< of that model at its estimates; else the stated coordinates
    double fixture_deviation_ = 1.0;   ///< factor on the deviations of that model
    Eigen::VectorXd temperature_;      ///< estimates of the inputs, [K]
    double expansion_ = 0.0;           ///< estimate, [1/K]
    std::unique_ptr<const TrialNetwork> network_;
    std::unique_ptr<const TrialDatum> datum_;
    mutable std::atomic<std::uint64_t> trials_{0}, steps_{0}, alone_{0}, not_converged_{0};
    mutable std::atomic<int> most_steps_{0};
};

}  // namespace gumcert::engine
