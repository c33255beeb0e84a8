#include "app/simulation_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/joint_adjustment.h"
#include "engine/rotary_table_evaluation.h"
#include "engine/sequential_evaluation.h"
#include "gum/coverage.h"
#include "gum/propagation.h"

namespace gumcert::app {

namespace {

using engine::AdjustmentMethod;
using engine::CampaignTruth;
using engine::Datum;
using engine::RotaryTableMeasurement;

constexpr double k_station_half_width = 0.01;  // a tripod stands within a centimetre of where it was planned, [m]
constexpr double k_dead_path_centre = 0.2;     // [m]
constexpr double k_dead_path_half_width = 0.05;
constexpr double k_detection_power = 0.8;  // of the minimal detectable bias, as Baarda chose it

// Groups of random numbers; the order is their stream.
enum Group : std::size_t {
    k_errors,
    k_stations,
    k_dead_paths,
    k_fixture,
    k_scale,
    k_temperature,
    k_expansion,
    k_table,
    k_length_noise,
    k_resolution,
    k_outliers,
    k_groups
};
constexpr std::uint64_t k_streams_of_a_study = 16;
constexpr std::size_t k_batch = 256;  // campaigns

/// `size` independent uniform numbers within ±1.
gum::InputGroup uniform_numbers(Eigen::Index size) {
    gum::InputGroup group;
    group.value = Eigen::VectorXd::Zero(size);
    group.covariance = Eigen::MatrixXd::Constant(size, 1, 1.0 / 3.0);
    group.marginals.assign(static_cast<std::size_t>(size), gum::Distribution::uniform(0.0, 1.0));
    return group;
}

/// `size` independent standard deviates, normal or uniform with unit variance.
gum::InputGroup standard_numbers(Eigen::Index size, engine::InputShape shape = engine::InputShape::normal) {
    gum::InputGroup group;
    group.value = Eigen::VectorXd::Zero(size);
    group.covariance = Eigen::MatrixXd::Ones(size, 1);
    if (shape == engine::InputShape::uniform) {
        group.marginals.assign(static_cast<std::size_t>(size), gum::Distribution::uniform(0.0, std::sqrt(3.0)));
    }
    return group;
}

gum::InputGroup fixture_numbers(const RotaryTableMeasurement& layout) {
    gum::InputGroup group;
    group.value = Eigen::VectorXd::Zero(layout.fixture_covariance.rows());
    group.covariance = layout.fixture_covariance;
    if (layout.fixture_shape == engine::InputShape::uniform) {
        for (Eigen::Index i = 0; i < group.value.size(); ++i) {
            group.marginals.push_back(
                gum::Distribution::uniform(0.0, std::sqrt(3.0 * layout.fixture_covariance(i, i))));
        }
    }
    return group;
}

double square(double value) {
    return value * value;
}

double root_mean(double sum, std::size_t count) {
    return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
}

/// Tally of a reported quantity by its index, and of its kind.
std::pair<std::size_t, std::size_t> tallies_of(Eigen::Index index, Eigen::Index errors) {
    if (index < errors) {
        const auto component = static_cast<std::size_t>(index % 6);
        return {component, component < 3 ? k_linear_tally : k_angular_tally};
    }
    const auto set_up = static_cast<std::size_t>(index - errors);
    if (set_up < 4) {
        return {6 + set_up, set_up < 2 ? k_offset_tally : k_tilt_tally};
    }
    return {k_reversal_tally, k_reversal_tally};
}

/// One run of one estimator. \param u, k  empty where no uncertainty is looked at
Tallies tally_run(const Eigen::VectorXd& value, const Eigen::VectorXd& assumed, const Eigen::VectorXd& in_datum,
                  const Eigen::VectorXd& u, const Eigen::VectorXd& k, Eigen::Index errors) {
    Tallies tallies;
    for (Eigen::Index i = 0; i < value.size(); ++i) {
        DifferenceTally one;
        const double difference = value[i] - assumed[i];
        const double measurement = value[i] - in_datum[i];
        one.count = 1;
        one.sum_absolute = one.maximum = std::abs(difference);
        one.sum_squares = square(difference);
        one.sum_datum_squares = square(in_datum[i] - assumed[i]);
        one.sum_measurement_squares = square(measurement);
        if (u.size() > 0 && u[i] > 0.0) {  // at home nothing is stated in the datum of the home position
            one.judged = 1;
            one.sum_stated_squares = square(u[i]);
            one.sum_normalised_squares = square(measurement / u[i]);
            one.covered = std::abs(measurement) <= k[i] * u[i] ? 1 : 0;
        }
        const auto [own, kind] = tallies_of(i, errors);
        tallies[own].add(one);
        if (kind != own) {
            tallies[kind].add(one);
        }
        tallies[k_all_tally].add(one);
    }
    for (DifferenceTally& tally : tallies) {
        if (tally.judged > 0) {
            tally.runs = 1;
            tally.sum_coverage = static_cast<double>(tally.covered) / static_cast<double>(tally.judged);
            tally.sum_coverage_squares = square(tally.sum_coverage);
        }
    }
    return tallies;
}

void add(Tallies& sum, const Tallies& run) {
    for (std::size_t t = 0; t < k_tallies; ++t) {
        sum[t].add(run[t]);
    }
}

/// The same campaign with the weights, and without the outliers, that the joint adjustment found: what the sequential
/// method itself cannot find out.
RotaryTableMeasurement with_findings(const RotaryTableMeasurement& measurement,
                                     const engine::RotaryTableSolution& joint) {
    RotaryTableMeasurement result = measurement;
    result.lengths.clear();
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
    result.table_repeatability = {perfect ? engine::RepeatabilityMode::none : engine::RepeatabilityMode::given,
                                  std::sqrt(found.variance_linear), std::sqrt(found.variance_axial),
                                  std::sqrt(found.variance_tilt)};
    result.outliers.test = engine::OutlierTest::none;
    result.method = AdjustmentMethod::sequential;
    result.datum = Datum::home;
    return result;
}

/// Everything that one campaign says.
struct RunResult {
    std::array<std::optional<Tallies>, k_estimators.size()> tallies;
    std::array<std::optional<gum::Diagnostic>, 2> failure;
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

    [[nodiscard]] RunResult evaluate() {
        RunResult result;
        RotaryTableMeasurement measurement = campaign_.measurement;
        measurement.method = AdjustmentMethod::joint;
        measurement.datum = Datum::axis_average_line;
        engine::EvaluationOptions options;
        options.critical_value = gum::two_sided_normal_critical_value(measurement.outliers.alpha);
        options.non_centrality = options.critical_value + gum::standard_normal_quantile(k_detection_power);
        RotaryTableMeasurement for_sequential;
        try {
            const engine::RotaryTableSolution joint = engine::evaluate_jointly(measurement, options);
            judge(joint, result);
            for_sequential = with_findings(measurement, joint);
        } catch (const gum::NoResultError& error) {
            result.failure[0] = error.diagnostics().front();
            return result;
        }
        try {
            const engine::RotaryTableSolution sequential = engine::evaluate_sequentially(for_sequential, options);
            compare(for_sequential, sequential.values, sequential.covariance, Datum::home, 2, result);
        } catch (const gum::NoResultError& error) {
            result.failure[1] = error.diagnostics().front();
        }
        return result;
    }

private:
    void judge(const engine::RotaryTableSolution& joint, RunResult& result) {
        if (noisy_) {
            coverage_factor_ = gum::propagate(*joint.model, probability_).coverage_factor;
        }
        compare(campaign_.measurement, joint.values, joint.covariance, Datum::axis_average_line, 0, result);
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

    /// A solution in its own datum and in the other one. \param first  index of the method's first estimator
    void compare(const RotaryTableMeasurement& measurement, const Eigen::VectorXd& values,
                 const Eigen::MatrixXd& covariance, Datum own, std::size_t first, RunResult& result) const {
        for (std::size_t d = 0; d < 2; ++d) {
            const Datum datum = k_estimators[first + d].datum;
            engine::DatumView view{values, covariance};
            if (datum != own) {
                view = engine::seen_in_datum(measurement, values, covariance, datum);
            }
            Eigen::VectorXd u;
            Eigen::VectorXd k;
            if (noisy_) {
                u = view.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
                k = coverage_factor_.head(values.size());
            }
            result.tallies[first + d] =
                tally_run(view.values, assumed_.head(values.size()), in_datum_[d].head(values.size()), u, k, errors_);
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

void DifferenceTally::add(const DifferenceTally& other) {
    count += other.count;
    sum_absolute += other.sum_absolute;
    sum_squares += other.sum_squares;
    maximum = std::max(maximum, other.maximum);
    sum_datum_squares += other.sum_datum_squares;
    sum_measurement_squares += other.sum_measurement_squares;
    sum_stated_squares += other.sum_stated_squares;
    judged += other.judged;
    sum_normalised_squares += other.sum_normalised_squares;
    covered += other.covered;
    runs += other.runs;
    sum_coverage += other.sum_coverage;
    sum_coverage_squares += other.sum_coverage_squares;
}

double DifferenceTally::mean_absolute() const {
    return count == 0 ? 0.0 : sum_absolute / static_cast<double>(count);
}

double DifferenceTally::rms() const {
    return root_mean(sum_squares, count);
}

double DifferenceTally::datum_rms() const {
    return root_mean(sum_datum_squares, count);
}

double DifferenceTally::measurement_rms() const {
    // Where something is stated, nothing is at home in its datum: zeros would only dilute.
    return root_mean(sum_measurement_squares, judged > 0 ? judged : count);
}

double DifferenceTally::stated_rms() const {
    return root_mean(sum_stated_squares, judged);
}

double DifferenceTally::normalised_rms() const {
    return root_mean(sum_normalised_squares, judged);
}

double DifferenceTally::coverage() const {
    return judged == 0 ? 0.0 : static_cast<double>(covered) / static_cast<double>(judged);
}

double DifferenceTally::coverage_standard_error() const {
    if (runs < 2) {
        return 0.0;
    }
    const auto n = static_cast<double>(runs);
    const double variance = std::max(0.0, (sum_coverage_squares - square(sum_coverage) / n) / (n - 1.0));
    return std::sqrt(variance / n);
}

CampaignDraws::CampaignDraws(const RotaryTableMeasurement& layout, const engine::SimulationRequest& request,
                             const engine::TableRepeatability& table, std::uint64_t seed, std::uint64_t stream)
    : layout_(layout), request_(request), table_(table) {
    const auto stations = static_cast<Eigen::Index>(layout.stations.size());
    const auto lengths = static_cast<Eigen::Index>(layout.lengths.size());
    visits_ = engine::visits_of(layout, std::vector<bool>(layout.lengths.size(), true)).size();
    request_.outliers = std::min(request.outliers, layout.lengths.size());
    std::array<gum::InputGroup, k_groups> groups;
    groups[k_errors] = uniform_numbers(6 * static_cast<Eigen::Index>(layout.angles.size()));
    groups[k_stations] = uniform_numbers(3 * stations);
    groups[k_dead_paths] = uniform_numbers(static_cast<Eigen::Index>(layout.dead_paths.size()));
    groups[k_fixture] = fixture_numbers(layout);
    groups[k_scale] = standard_numbers(stations);
    groups[k_temperature] = standard_numbers(stations, layout.temperature_shape);
    groups[k_expansion] = standard_numbers(1, layout.expansion_shape);
    groups[k_table] = standard_numbers(6 * static_cast<Eigen::Index>(visits_));
    groups[k_length_noise] = standard_numbers(lengths);
    groups[k_resolution] = uniform_numbers(lengths);
    groups[k_outliers] = uniform_numbers(2 * static_cast<Eigen::Index>(request_.outliers) + 1);
    for (std::size_t g = 0; g < k_groups; ++g) {
        const std::array<std::uint64_t, 1> own{stream * k_streams_of_a_study + g};
        draws_.emplace_back(std::vector<gum::InputGroup>{groups[g]}, seed, own);
    }
}

Eigen::VectorXd CampaignDraws::draw(std::size_t group, std::uint64_t run) const {
    Eigen::MatrixXd x(1, draws_[group].size());
    draws_[group].draw(run, x);
    return x.transpose();
}

CampaignTruth CampaignDraws::exact_truth(std::uint64_t run) const {
    CampaignTruth truth;
    const auto angles = static_cast<Eigen::Index>(layout_.angles.size());
    const auto stations = static_cast<Eigen::Index>(layout_.stations.size());
    truth.errors = draw(k_errors, run).reshaped(6, angles);
    truth.errors.topRows<3>() *= request_.error_linear;
    truth.errors.bottomRows<3>() *= request_.error_angular;
    truth.errors.col(static_cast<Eigen::Index>(layout_.home)).setZero();
    for (const int c : engine::across_axis(layout_.axis)) {
        truth.set_up[c] = request_.set_up_offset;
        truth.set_up[3 + c] = request_.set_up_tilt;
    }
    const Eigen::VectorXd place = draw(k_stations, run);
    for (Eigen::Index j = 0; j < stations; ++j) {
        truth.stations.emplace_back(*layout_.station_start[static_cast<std::size_t>(j)] +
                                    k_station_half_width * place.segment<3>(3 * j));
    }
    truth.dead_paths = (k_dead_path_centre + k_dead_path_half_width * draw(k_dead_paths, run).array()).matrix();
    truth.scale_deviation = Eigen::VectorXd::Zero(stations);
    truth.fixture = layout_.fixture;
    truth.temperature_difference = layout_.temperature_difference;
    truth.expansion = layout_.expansion;
    return truth;
}

CampaignDraws::Campaign CampaignDraws::campaign(std::uint64_t run, bool with_noise) const {
    Campaign campaign;
    campaign.truth = exact_truth(run);
    engine::CampaignNoise noise;
    if (with_noise) {
        CampaignTruth& truth = campaign.truth;
        truth.fixture.reshaped<Eigen::RowMajor>() += draw(k_fixture, run);
        const engine::LengthUncertainty& u = layout_.length_uncertainty;
        if (u.scale_model != engine::ScaleModel::fixed) {
            truth.scale_deviation = u.u_scale * draw(k_scale, run);
        }
        truth.temperature_difference += layout_.u_temperature.cwiseProduct(draw(k_temperature, run));
        truth.expansion += layout_.u_expansion * draw(k_expansion, run)[0];

        const auto order = engine::repeatability_order(layout_.axis);
        noise.table = draw(k_table, run).reshaped(6, static_cast<Eigen::Index>(visits_));
        for (std::size_t c = 0; c < 6; ++c) {
            noise.table.row(order[c]) *= c < 3 ? table_.u_linear : (c == 3 ? table_.u_axial : table_.u_tilt);
        }
        const Eigen::VectorXd distance = engine::true_distances(layout_, truth);
        noise.lengths = draw(k_length_noise, run);
        for (Eigen::Index i = 0; i < distance.size(); ++i) {
            noise.lengths[i] *= std::hypot(u.u_constant, u.u_proportional * distance[i]);
        }
        if (u.resolution > 0.0) {
            noise.lengths += 0.5 * u.resolution * draw(k_resolution, run);
        }
        // Without replacement: the k-th outlier is one of the lengths that are still good.
        const Eigen::VectorXd place = draw(k_outliers, run);
        std::vector<std::size_t> good(layout_.lengths.size());
        for (std::size_t i = 0; i < good.size(); ++i) {
            good[i] = i;
        }
        for (std::size_t o = 0; o < request_.outliers; ++o) {
            const auto at = static_cast<Eigen::Index>(2 * o);
            const auto left = static_cast<double>(good.size() - o);
            const auto chosen =
                o + static_cast<std::size_t>(std::clamp(std::floor(0.5 * (place[at] + 1.0) * left), 0.0, left - 1.0));
            std::swap(good[o], good[chosen]);
            noise.outliers.push_back({good[o], place[at + 1] < 0.0 ? -request_.outlier_size : request_.outlier_size});
            campaign.planted.push_back(good[o]);
        }
        std::sort(campaign.planted.begin(), campaign.planted.end());
    }
    campaign.measurement = engine::simulate_campaign(layout_, campaign.truth, noise);
    if (!with_noise) {
        // Exact distances have no noise to estimate, and nothing to find.
        engine::RotaryTableMeasurement& measurement = campaign.measurement;
        measurement.estimate_length_noise = false;
        measurement.fixture_component = engine::FixtureComponent::given;
        measurement.outliers.test = engine::OutlierTest::none;
        if (measurement.table_repeatability.mode == engine::RepeatabilityMode::estimate) {
            measurement.table_repeatability.mode = engine::RepeatabilityMode::none;
        }
    }
    return campaign;
}

AngleStudy study_layout(const RotaryTableMeasurement& layout, const engine::SimulationRequest& request,
                        const engine::TableRepeatability& table, double coverage_probability, std::uint64_t stream,
                        gum::WorkerThreads& workers, const Progress& progress) {
    const CampaignDraws draws(layout, request, table, request.seed, stream);
    AngleStudy study;
    study.angles = layout.angles.size();
    study.lengths = layout.lengths.size();
    study.evaluated = study.angles <= k_most_evaluated_angles;
    struct Everything {
        std::array<Tallies, 2> datum_only;
        RunResult exact, noisy;
    };
    // Added up in the order of the runs, whoever did them; a batch at a time, so that memory does not grow with them.
    for (std::size_t first = 0; first < request.runs; first += k_batch) {
        std::vector<Everything> batch(std::min(k_batch, request.runs - first));
        workers.run(batch.size(), [&](unsigned worker, std::size_t task) {
            const std::size_t run = first + task;
            if (worker == 0 && progress) {
                progress("simulation, " + std::to_string(study.angles) + " angles, campaign " +
                         std::to_string(run + 1) + " of " + std::to_string(request.runs));
            }
            const CampaignTruth assumed = draws.exact_truth(run);
            const Eigen::VectorXd values = engine::reported_order(layout, assumed.errors, assumed.set_up, nullptr);
            for (std::size_t d = 0; d < 2; ++d) {
                const Eigen::VectorXd in_datum =
                    engine::truth_in_datum(layout, assumed, d == 0 ? Datum::axis_average_line : Datum::home, false);
                batch[task].datum_only[d] = tally_run(in_datum, values, in_datum, {}, {}, assumed.errors.size());
            }
            if (study.evaluated) {
                batch[task].exact = Run(draws.campaign(run, false), assumed, coverage_probability, false).evaluate();
                batch[task].noisy = Run(draws.campaign(run, true), assumed, coverage_probability, true).evaluate();
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

}  // namespace gumcert::app
