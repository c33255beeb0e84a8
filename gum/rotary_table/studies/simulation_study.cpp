#include "gum/rotary_table/studies/simulation_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/evaluation/sequential_evaluation.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_contributions.h"
#include "engine/rotary_table/studies/campaign_simulation.h"
#include "gum/propagation.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "gum/rotary_table/studies/campaign_draws.h"
#include "text/counts.h"

namespace gumcert::gum {

namespace {

using engine::AdjustmentMethod;
using engine::CampaignTruth;
using engine::Datum;
using engine::RotaryTableMeasurement;

constexpr std::size_t k_batch = 256;  // campaigns

/// The same campaign with the weights, and without the outliers, that the joint adjustment found: what the sequential
/// method itself cannot find out.
RotaryTableMeasurement with_findings(const RotaryTableMeasurement& measurement,
                                     const engine::RotaryTableSolution& joint) {
    RotaryTableMeasurement result = measurement;
    result.lengths.clear();
    result.times.clear();
    for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
        if (!joint.reliability[i].removed) {
            result.lengths.push_back(measurement.lengths[i]);
        }
    }
    const engine::StochasticModel& found = joint.stochastic;
    result.length_uncertainty.u_constant *= std::sqrt(found.length_factor);
    result.length_uncertainty.u_proportional *= std::sqrt(found.length_factor);
    result.fixture_covariance *= found.fixture_factor;
    result.fixture_component = engine::FixtureComponent::given;
    result.estimate_length_noise = false;
    const bool perfect = found.variance_linear <= 0.0 && found.variance_axial <= 0.0 && found.variance_tilt <= 0.0;
    // The components are those of the point where the joint adjustment let them act.
    result.table_repeatability = {perfect ? engine::RepeatabilityMode::none : engine::RepeatabilityMode::given,
                                  std::sqrt(found.variance_linear), std::sqrt(found.variance_axial),
                                  std::sqrt(found.variance_tilt), engine::repeatability_position(measurement)};
    result.outliers.test = engine::OutlierTest::none;
    result.method = AdjustmentMethod::sequential;
    result.datum = Datum::home;
    return result;
}

/// Everything that one campaign says.
struct RunResult {
    std::array<std::optional<Tallies>, k_estimators.size()> tallies;
    std::array<std::optional<Diagnostic>, 2> failure;
    double chi_square = 0.0, degrees_of_freedom = 0.0;
    std::size_t planted = 0, planted_found = 0, good = 0, good_flagged = 0;
    std::vector<std::size_t> histogram;
};

void count_histogram(std::vector<std::size_t>& histogram, const Eigen::VectorXd& normalised) {
    histogram.assign(k_histogram_cells, 0);
    for (const double z : normalised) {
        const double cell = std::floor((z - k_histogram_first) / k_histogram_width);
        ++histogram[static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(k_histogram_cells - 1)))];
    }
}

/// The sequential method for exact distances of one layout, values only.
///
/// The inputs of the method that are not distances are the stated ones in every exact campaign: the model of the first
/// campaign gives the values of all others, without the derivatives that the uncertainties of each would need.
class SequentialOfExactDistances {
public:
    /// \param first  an exact campaign of the layout
    /// \throws NoResultError  when a stage of the method is not determined
    explicit SequentialOfExactDistances(RotaryTableMeasurement first) {
        first.method = AdjustmentMethod::sequential;
        first.datum = Datum::home;
        model_ = engine::evaluate_sequentially(first, single_test_options(first)).model;
        inputs_ = input_estimates(*model_);
        for (const engine::Visit& visit : engine::visits_of(first, std::vector<bool>(first.lengths.size(), true))) {
            order_.insert(order_.end(), visit.observations.begin(), visit.observations.end());
        }
        if (inputs_.head(std::ssize(order_)) != lengths_of(first)) {
            throw std::logic_error("the inputs of the sequential method do not begin with the distances");
        }
    }

    /// In the datum of the home position, in the order of `engine::reported_quantities` without a reversal.
    [[nodiscard]] Eigen::VectorXd values(const RotaryTableMeasurement& campaign) const {
        Eigen::VectorXd x = inputs_;
        x.head(std::ssize(order_)) = lengths_of(campaign);
        return model_->evaluate(x);
    }

private:
    [[nodiscard]] Eigen::VectorXd lengths_of(const RotaryTableMeasurement& campaign) const {
        Eigen::VectorXd lengths(std::ssize(order_));
        for (Eigen::Index i = 0; i < lengths.size(); ++i) {
            lengths[i] = campaign.lengths[order_[static_cast<std::size_t>(i)]].length;
        }
        return lengths;
    }

    std::shared_ptr<const MeasurementModel> model_;
    Eigen::VectorXd inputs_;
    std::vector<std::size_t> order_;  ///< of the lengths among the inputs
};

/// The model of the sequential method, or why there is none.
struct ExactSequential {
    std::optional<SequentialOfExactDistances> method;
    std::optional<Diagnostic> failure;
};

class Run {
public:
    Run(const CampaignDraws::Campaign& campaign, const CampaignTruth& assumed, double coverage_probability, bool noisy)
        : campaign_(campaign), probability_(coverage_probability), noisy_(noisy) {
        const RotaryTableMeasurement& measurement = campaign.measurement;
        errors_ = assumed.errors.size();
        assumed_ = engine::reported_order(measurement, assumed.errors, assumed.set_up, &assumed.reversal);
        for (std::size_t d = 0; d < 2; ++d) {
            in_datum_[d] =
                engine::truth_in_datum(measurement, assumed, d == 0 ? Datum::axis_average_line : Datum::home, true);
        }
    }

    /// \param exact       of the layout, for exact campaigns
    /// \param sequential  whether the sequential method is asked for
    [[nodiscard]] RunResult evaluate(const ExactSequential& exact, bool sequential) {
        RunResult result;
        RotaryTableMeasurement measurement = campaign_.measurement;
        measurement.method = AdjustmentMethod::joint;
        measurement.datum = Datum::axis_average_line;
        // Checked with a run of its own that changes nothing in the result.
        if (measurement.fixture_component == engine::FixtureComponent::check) {
            measurement.fixture_component = engine::FixtureComponent::given;
        }
        const engine::EvaluationOptions options = single_test_options(measurement);
        RotaryTableMeasurement for_sequential;
        try {
            const engine::RotaryTableSolution joint = engine::evaluate_jointly(measurement, options);
            judge(joint, result);
            if (sequential && noisy_) {
                for_sequential = with_findings(measurement, joint);
            }
        } catch (const NoResultError& error) {
            result.failure[0] = error.diagnostics().front();
            return result;
        }
        if (!sequential) {
            return result;
        }
        try {
            if (noisy_) {
                const engine::RotaryTableSolution solution = engine::evaluate_sequentially(for_sequential, options);
                compare(for_sequential, solution.values, solution.covariance.dense(), Datum::home, 2, result);
            } else if (exact.method) {
                const Eigen::VectorXd values = exact.method->values(measurement);
                compare(measurement, values, Eigen::MatrixXd(), Datum::home, 2, result);
            } else {
                result.failure[1] = exact.failure;
            }
        } catch (const NoResultError& error) {
            result.failure[1] = error.diagnostics().front();
        }
        return result;
    }

private:
    /// Coverage factors as an evaluation states them.
    [[nodiscard]] Eigen::VectorXd coverage_factors(const engine::RotaryTableSolution& joint) const {
        const auto& model = dynamic_cast<const engine::RotaryTableModel&>(*joint.model);
        return uncertainty_budget(model, joint.values, engine::contributions_of(model).variance, probability_)
            .coverage_factor;
    }

    void judge(const engine::RotaryTableSolution& joint, RunResult& result) {
        if (noisy_) {
            coverage_factor_ = coverage_factors(joint);
        }
        compare(campaign_.measurement, joint.values, joint.covariance.dense(), Datum::axis_average_line, 0, result);
        result.chi_square = joint.chi_square;
        result.degrees_of_freedom = static_cast<double>(joint.degrees_of_freedom);
        for (std::size_t i = 0; i < joint.reliability.size(); ++i) {
            const bool planted = std::binary_search(campaign_.planted.begin(), campaign_.planted.end(), i);
            const std::size_t flagged = joint.reliability[i].flagged ? 1 : 0;
            result.planted += planted ? 1 : 0;
            result.planted_found += planted ? flagged : 0;
            result.good += planted ? 0 : 1;
            result.good_flagged += planted ? 0 : flagged;
        }
        if (noisy_) {
            const Eigen::VectorXd u = joint.covariance.diagonal().head(errors_).cwiseSqrt();
            count_histogram(result.histogram,
                            (joint.values.head(errors_) - in_datum_[0].head(errors_)).cwiseQuotient(u));
        }
    }

    /// A solution in its own datum and in the other one.
    /// \param covariance  empty where no uncertainty is looked at
    /// \param first       index of the method's first estimator
    void compare(const RotaryTableMeasurement& measurement, const Eigen::VectorXd& values,
                 const Eigen::MatrixXd& covariance, Datum own, std::size_t first, RunResult& result) const {
        for (std::size_t d = 0; d < 2; ++d) {
            const Datum datum = k_estimators[first + d].datum;
            engine::DatumView view{values, covariance};
            if (datum != own) {
                view = engine::seen_in_datum(measurement, values,
                                             noisy_ ? covariance : Eigen::MatrixXd::Zero(values.size(), values.size()),
                                             datum);
            }
            Eigen::VectorXd u;
            Eigen::VectorXd k;
            if (noisy_) {
                u = view.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
                k = coverage_factor_.head(values.size());
            }
            result.tallies[first + d] = tally_of_campaign(view.values, assumed_.head(values.size()),
                                                          in_datum_[d].head(values.size()), u, k, errors_);
        }
    }

    const CampaignDraws::Campaign& campaign_;
    double probability_;
    bool noisy_;
    Eigen::Index errors_ = 0;
    Eigen::VectorXd assumed_, coverage_factor_;
    std::array<Eigen::VectorXd, 2> in_datum_;  // axis average line, home
};

void add(CampaignResults& results, const RunResult& run) {
    results.histogram.resize(k_histogram_cells, 0);
    for (std::size_t e = 0; e < k_estimators.size(); ++e) {
        if (run.tallies[e]) {
            add(results.tallies[e], *run.tallies[e]);
        }
    }
    for (std::size_t m = 0; m < 2; ++m) {
        results.evaluated[m] += run.tallies[2 * m] ? 1U : 0U;
        if (run.failure[m] && !results.failure[m]) {
            results.failure[m] = run.failure[m];
        }
    }
    results.sum_chi_square += run.chi_square;
    results.sum_degrees_of_freedom += run.degrees_of_freedom;
    results.planted += run.planted;
    results.planted_found += run.planted_found;
    results.good += run.good;
    results.good_flagged += run.good_flagged;
    for (std::size_t c = 0; c < run.histogram.size(); ++c) {
        results.histogram[c] += run.histogram[c];
    }
}

}  // namespace

std::size_t adjusted_campaigns(std::size_t angles, std::size_t runs) {
    constexpr std::size_t k_usual_angles = 36;
    constexpr std::size_t k_least = 10;
    if (angles > k_most_adjusted_angles) {
        return 0;
    }
    return angles <= k_most_sequential_angles ? runs
                                              : std::min(runs, std::max(k_least, runs * k_usual_angles / angles));
}

AngleStudy study_layout(const RotaryTableMeasurement& layout, const SimulationRequest& request,
                        const engine::TableRepeatability& table, double coverage_probability, std::uint64_t stream,
                        WorkerThreads& workers, const Progress& progress) {
    const CampaignDraws draws(layout, request, table, request.seed, stream);
    AngleStudy study;
    study.angles = layout.angles.size();
    study.lengths = layout.lengths.size();
    study.adjusted = adjusted_campaigns(study.angles, request.runs);
    study.sequential = study.adjusted > 0 && study.angles <= k_most_sequential_angles;
    ExactSequential exact;
    if (study.sequential) {
        try {
            exact.method.emplace(draws.campaign(0, false).measurement);
        } catch (const NoResultError& error) {
            exact.failure = error.diagnostics().front();
        }
    }
    struct Everything {
        std::array<Tallies, 2> datum_only;
        RunResult exact, noisy;
    };
    std::atomic<std::size_t> begun = 0;
    // Added up in the order of the runs, whoever did them; a batch at a time, so that memory does not grow with them.
    for (std::size_t first = 0; first < request.runs; first += k_batch) {
        std::vector<Everything> batch(std::min(k_batch, request.runs - first));
        workers.run(batch.size(), [&](unsigned worker, std::size_t task) {
            const std::size_t run = first + task;
            const std::size_t number = ++begun;
            if (worker == 0 && progress) {
                progress("simulation, " + text::count_of(study.angles, "angle") + ", campaign " +
                         std::to_string(number) + " of " + std::to_string(request.runs));
            }
            const CampaignTruth assumed = draws.exact_truth(run);
            const Eigen::VectorXd values = engine::reported_order(layout, assumed.errors, assumed.set_up, nullptr);
            for (std::size_t d = 0; d < 2; ++d) {
                const Eigen::VectorXd in_datum =
                    engine::truth_in_datum(layout, assumed, d == 0 ? Datum::axis_average_line : Datum::home, false);
                batch[task].datum_only[d] =
                    tally_of_campaign(in_datum, values, in_datum, {}, {}, assumed.errors.size());
            }
            if (run < study.adjusted) {
                const auto evaluated = [&](bool noisy) {
                    return Run(draws.campaign(run, noisy), assumed, coverage_probability, noisy)
                        .evaluate(exact, study.sequential);
                };
                batch[task].exact = evaluated(false);
                batch[task].noisy = evaluated(true);
            }
        });
        for (const Everything& run : batch) {
            add(study.datum_only[0], run.datum_only[0]);
            add(study.datum_only[1], run.datum_only[1]);
            add(study.exact, run.exact);
            add(study.noisy, run.noisy);
        }
    }
    return study;
}

}  // namespace gumcert::gum
