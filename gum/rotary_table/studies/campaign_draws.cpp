#include "gum/rotary_table/studies/campaign_draws.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_model.h"

namespace gumcert::gum {

namespace {

using engine::CampaignTruth;
using engine::RotaryTableMeasurement;

constexpr double k_station_half_width = 0.01;  // a tripod stands within a centimetre of where it was planned, [m]
constexpr double k_dead_path_centre = 0.2;     // [m]
constexpr double k_dead_path_half_width = 0.05;

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

/// `size` independent uniform numbers within ±1.
InputGroup uniform_numbers(Eigen::Index size) {
    InputGroup group;
    group.value = Eigen::VectorXd::Zero(size);
    group.covariance = Eigen::MatrixXd::Constant(size, 1, 1.0 / 3.0);
    group.marginals.assign(static_cast<std::size_t>(size), Distribution::uniform(0.0, 1.0));
    return group;
}

/// `size` independent standard deviates, normal or uniform with unit variance.
InputGroup standard_numbers(Eigen::Index size, engine::InputShape shape = engine::InputShape::normal) {
    InputGroup group;
    group.value = Eigen::VectorXd::Zero(size);
    group.covariance = Eigen::MatrixXd::Ones(size, 1);
    if (shape == engine::InputShape::uniform) {
        group.marginals.assign(static_cast<std::size_t>(size), Distribution::uniform(0.0, std::sqrt(3.0)));
    }
    return group;
}

InputGroup fixture_numbers(const RotaryTableMeasurement& layout) {
    InputGroup group;
    group.value = Eigen::VectorXd::Zero(layout.fixture_covariance.rows());
    group.covariance = layout.fixture_covariance;
    if (layout.fixture_shape == engine::InputShape::uniform) {
        for (Eigen::Index i = 0; i < group.value.size(); ++i) {
            group.marginals.push_back(Distribution::uniform(0.0, std::sqrt(3.0 * layout.fixture_covariance(i, i))));
        }
    }
    return group;
}

}  // namespace

CampaignDraws::CampaignDraws(const RotaryTableMeasurement& layout, const SimulationRequest& request,
                             const engine::TableRepeatability& table, std::uint64_t seed, std::uint64_t stream)
    : layout_(layout), request_(request), table_(table) {
    const auto stations = static_cast<Eigen::Index>(layout.stations.size());
    const auto lengths = static_cast<Eigen::Index>(layout.lengths.size());
    visits_ = engine::visits_of(layout, std::vector<bool>(layout.lengths.size(), true)).size();
    request_.outliers = std::min(request.outliers, layout.lengths.size());
    std::array<InputGroup, k_groups> groups;
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
        draws_.emplace_back(std::vector<InputGroup>{groups[g]}, seed, own);
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

}  // namespace gumcert::gum
