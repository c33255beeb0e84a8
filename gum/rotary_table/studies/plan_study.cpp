#include "gum/rotary_table/studies/plan_study.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/rotary_table/geometry_check.h"
#include "engine/rotary_table/rotary_table_contributions.h"
#include "engine/rotary_table/start/start_values.h"
#include "engine/rotary_table/studies/campaign_layout.h"
#include "engine/rotary_table/variance_components.h"
#include "gum/coverage.h"
#include "gum/propagation.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "gum/rotary_table/fixture_budget.h"
#include "gum/rotary_table/studies/plan_texts.h"
#include "gum/rotary_table/studies/stated_sight.h"
#include "gum/rounding.h"
#include "text/counts.h"

namespace gumcert::gum::plan {

namespace {

using engine::RotaryTableMeasurement;
using engine::StochasticModel;

constexpr double k_infinite = std::numeric_limits<double>::infinity();
// More angles add time and next to nothing to what a comparison of stations says.
constexpr std::size_t k_most_angles_of_search = 36;
constexpr std::size_t k_most_doubled_angles = 720;
constexpr std::size_t k_most_left_out = 60;  // stations, and reflectors, that are left out one by one

std::array<Motion, 6> motions_of(const Eigen::VectorXd& variances, std::size_t angles, double k) {
    std::array<Motion, 6> motions;
    for (std::size_t c = 0; c < 6; ++c) {
        double squares = 0.0;
        std::size_t stated = 0;
        for (std::size_t i = 0; i < angles; ++i) {
            const double U = k * std::sqrt(variances[static_cast<Eigen::Index>(6 * i + c)]);
            squares += U * U;
            stated += U > 0.0 ? 1U : 0U;  // the home angle of the home datum is zero by definition
            // Equal ones up to rounding: the first angle.
            if (U > (1.0 + 1e-9) * motions[c].largest) {
                motions[c].largest = U;
                motions[c].worst_angle = i;
            }
        }
        motions[c].rms = stated > 0 ? std::sqrt(squares / static_cast<double>(stated)) : 0.0;
    }
    return motions;
}

double ratio_of(const Setting& setting, const std::array<Motion, 6>& motions) {
    double ratio = 0.0;
    for (std::size_t c = 0; c < 6; ++c) {
        ratio = std::max(ratio, motions[c].largest / target_of(setting, c));
    }
    return ratio;
}

/// Angles of the plan instead of those that were measured; the home angle stays.
void use_planned_angles(RotaryTableMeasurement& layout, const std::vector<double>& angles_deg) {
    const double home = layout.angles_deg[layout.home];
    layout.angles_deg = angles_deg;
    layout.angles.clear();
    for (const double angle : angles_deg) {
        layout.angles.push_back(angle * k_degree);
    }
    const auto nearest = std::min_element(angles_deg.begin(), angles_deg.end(), [home](double left, double right) {
        return std::abs(left - home) < std::abs(right - home);
    });
    layout.home = static_cast<std::size_t>(nearest - angles_deg.begin());
}

void note_limits(Setting& setting) {
    if (std::max(setting.layout.stations.size(), setting.layout.reflectors.size()) > k_most_left_out) {
        setting.notes.push_back("What a single station or reflector is worth is studied for up to " +
                                std::to_string(k_most_left_out) + " of them; it is left out here.");
    }
    const engine::TableRepeatability& table = setting.layout.table_repeatability;
    if (table.mode == engine::RepeatabilityMode::none) {
        setting.notes.emplace_back(
            "The job takes the table as perfectly repeatable. What it does not repeat is missing "
            "in every uncertainty here.");
        return;
    }
    if (table.mode == engine::RepeatabilityMode::given) {
        return;
    }
    const bool stated = table.u_linear > 0.0 && table.u_axial > 0.0 && table.u_tilt > 0.0;
    setting.notes.push_back(
        "The evaluation will estimate the repeatability of the table. The plan rests on " +
        round_significant(std::sqrt(setting.stochastic.variance_linear) / k_um.si, 3) + " µm linear, " +
        round_significant(std::sqrt(setting.stochastic.variance_axial) / k_arcsec.si, 3) + "″ about the axis and " +
        round_significant(std::sqrt(setting.stochastic.variance_tilt) / k_arcsec.si, 3) + "″ across it, " +
        (stated ? "the start values of the job."
                : "of which the job does not state all: the others are those that an evaluation starts from. State the "
                  "repeatability that you expect of this table in table_repeatability."));
}

}  // namespace

const DocumentUnit& unit_of_motion(std::size_t motion) {
    return motion < 3 ? k_um : k_arcsec;
}

double target_of(const Setting& setting, std::size_t motion) {
    return motion < 3 ? setting.request.target_linear : setting.request.target_angular;
}

namespace {

/// Leaves out what no station sees.
void leave_out_hidden(Setting& setting) {
    setting.whole = setting.layout;
    setting.sight = sight_of(setting.request.sight, setting.layout);
    if (setting.sight) {
        setting.layout = seen_layout(setting.whole, *setting.sight);
    }
}

void note_stations_among_reflectors(Setting& setting) {
    const RotaryTableMeasurement& layout = setting.layout;
    const double least = setting.request.least_distance;
    const auto millimetres = [](double length) { return round_significant(length / k_mm.si, 3) + " mm"; };
    for (const engine::StationAmongReflectors& near : engine::stations_among_reflectors(layout, least)) {
        setting.notes.push_back(message(
            {"GC-PLAN-0005", "station " + layout.stations[near.station],
             "stands " + millimetres(near.distance) + " from reflector " + layout.reflectors[near.reflector] + " at " +
                 plain(layout.angles_deg[near.angle]) + "°, and not " + plain(least / k_mm.si) + " mm",
             "a station clears every reflector at every angle by least_distance_mm",
             "correct its position, which is in millimetres from the axis of the table, or state the least_distance_mm "
             "of the instrument",
             Severity::warning}));
    }
}

}  // namespace

std::vector<SightCount> sight_counts(const RotaryTableMeasurement& whole, const engine::LineOfSight& sight) {
    std::vector<SightCount> counts(whole.stations.size());
    for (const engine::LengthObservation& length : whole.lengths) {
        SightCount& count = counts[length.station];
        ++count.distances;
        if (const auto hidden = sight.hindrance(*whole.station_start[length.station], length.angle, length.reflector)) {
            switch (hidden->kind) {
                case engine::Hindrance::Kind::obstacle:
                    ++count.by_obstacles;
                    break;
                case engine::Hindrance::Kind::reflector:
                    ++count.by_reflectors;
                    break;
                case engine::Hindrance::Kind::acceptance:
                    ++count.not_accepted;
                    break;
            }
        }
    }
    return counts;
}

std::vector<Target> targets_of(const Setting& setting, const Expected& expected) {
    std::vector<Target> targets;
    for (std::size_t c = 0; c < 6; ++c) {
        targets.push_back({setting.names[c], expected.motions[c].largest <= target_of(setting, c)});
    }
    for (const PlannedParameter& parameter : expected.parameters.all) {
        if (parameter.target) {
            targets.push_back({parameter.name, !parameter.missed()});
        }
    }
    return targets;
}

Setting setting_of(RotaryTableRequest request, const PlanRequest& plan, const Progress& progress) {
    Setting setting;
    setting.where = request.where;
    setting.coverage_probability = request.coverage_probability;
    (void)apply_fixture_budget(request);
    setting.request = plan;
    RotaryTableMeasurement& layout = setting.layout;
    layout = std::move(request.measurement);
    const bool has_lengths = !layout.lengths.empty();
    layout.reversal = engine::ReversalModel::constant;  // planned is the mean over the angles
    const bool positions_known = std::all_of(layout.station_start.begin(), layout.station_start.end(),
                                             [](const auto& q) { return q.has_value(); });
    if (!positions_known && has_lengths) {
        if (progress) {
            progress("positions of the stations from the measured lengths");
        }
        const engine::StartValues start = engine::find_start_values(layout);
        for (std::size_t j = 0; j < layout.stations.size(); ++j) {
            layout.station_start[j] = start.stations[j];
        }
        setting.notes.emplace_back(
            "The job does not state the positions of all stations: they were found from the measured lengths.");
    }
    if (has_lengths && setting.request.angles_deg.empty()) {
        setting.distances_from = "those of the lengths file";
    } else {
        if (has_lengths) {
            use_planned_angles(layout, setting.request.angles_deg);
        }
        engine::lay_out(layout, setting.request.both_senses, setting.request.dead_path_per_reflector);
        setting.distances_from = "every station to every reflector at every planned angle";
    }
    engine::predict_lengths(layout);
    leave_out_hidden(setting);
    note_stations_among_reflectors(setting);
    setting.stochastic = engine::start_variances(layout.table_repeatability);
    setting.k = coverage_factor(setting.coverage_probability, k_infinite);
    setting.wanted = {setting.request.target_linear / setting.k, setting.request.target_angular / setting.k};
    setting.names = engine::error_motion_names(layout.axis);
    note_limits(setting);
    if (layout.method == engine::AdjustmentMethod::sequential) {
        setting.notes.emplace_back("The job asks for the sequential method; the plan is that of the joint adjustment.");
    }
    return setting;
}

void note_undetermined_repeatability(Setting& setting) {
    // An estimate with fewer is less than about two of its standard uncertainties: what is plausible beside it counts.
    constexpr double k_hardly_determined = 8.0;
    const RotaryTableMeasurement& layout = setting.layout;
    if (layout.table_repeatability.mode != engine::RepeatabilityMode::estimate) {
        return;
    }
    const engine::JointAdjustment adjustment = engine::planned_adjustment(layout, setting.stochastic);
    const engine::NormalEquations normal = adjustment.adjustment().linearise();
    const engine::VarianceComponentStep step = engine::estimate_variance_components(
        adjustment, normal, normal.bordered_covariance(), setting.stochastic,
        {layout.estimate_length_noise, true, layout.fixture_component == engine::FixtureComponent::estimate});
    std::string names;
    for (const std::size_t k : {engine::table_linear, engine::table_axial, engine::table_tilt}) {
        const double nu = step.expected_degrees_of_freedom[k];
        if (nu < k_hardly_determined) {
            names += (names.empty() ? "" : ", ") + step.components[k].name + " (" + round_significant(nu, 2) + ")";
        }
    }
    if (!names.empty()) {
        setting.notes.push_back(
            "The distances will hardly determine these components of the repeatability, by their expected degrees of "
            "freedom: " +
            names +
            ". The evaluation then takes what they leave plausible, and its U may be several times that of this plan. "
            "State the repeatability where it is known (\"mode\": \"given\"), or plan more stations, reflectors or "
            "passes.");
    }
}

Expected expect(const Setting& setting, const RotaryTableMeasurement& layout) {
    Expected expected;
    expected.uncertainty = engine::expected_uncertainty(layout, setting.stochastic, evaluation_options(setting.layout));
    expected.motions = motions_of(expected.uncertainty.covariance.diagonal(), layout.angles.size(), setting.k);
    expected.ratio = ratio_of(setting, expected.motions);
    expected.parameters = expected_parameters(layout, setting.stochastic, setting.request.parameter_targets, setting.k,
                                              setting.coverage_probability);
    return expected;
}

SourceShares source_shares(const Setting& setting, const std::array<Motion, 6>& motions) {
    const RotaryTableMeasurement& layout = setting.layout;
    const engine::JointAdjustment adjustment = engine::planned_adjustment(layout, setting.stochastic);
    const engine::RotaryTableModel model(layout, adjustment, setting.stochastic,
                                         {k_infinite, k_infinite, k_infinite, k_infinite, k_infinite});
    const UncertaintyBudget budget =
        uncertainty_budget(model, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.outputs().size())),
                           engine::contributions_of(model).variance, setting.coverage_probability);
    SourceShares shares;
    for (std::size_t c = 0; c < 6; ++c) {
        const auto output = static_cast<Eigen::Index>(6 * motions[c].worst_angle + c);
        for (std::size_t s = 0; s < k_sources.size(); ++s) {
            for (const BudgetContribution& contribution : budget.shares_by_source) {
                if (contribution.name == k_sources[s]) {
                    shares.of_motion[c][s] = contribution.share[output];
                }
            }
        }
    }
    return shares;
}

// ---- one thing changed at a time ------------------------------------------------------------------------------------

namespace {

void evaluate_variant(const Setting& setting, const RotaryTableMeasurement& layout, const StochasticModel& stochastic,
                      Variant& variant) {
    try {
        engine::require_enough_angles(layout);
        variant.why = engine::undetermined_by(layout, stochastic, engine::SolverOptions{});
    } catch (const NoResultError& error) {
        variant.why = error.diagnostics().front();
    }
    if (variant.why) {
        return;
    }
    const std::optional<Eigen::VectorXd> variances = engine::LayoutVariances(layout, stochastic).variances();
    if (variances) {
        variant.motions = motions_of(*variances, layout.angles.size(), setting.k);
        variant.ratio = ratio_of(setting, *variant.motions);
    }
}

}  // namespace

std::vector<Variant> variants_of(const Setting& setting, WorkerThreads& workers) {
    const RotaryTableMeasurement& layout = setting.layout;
    std::vector<Variant> variants{{Change::none, "as planned", "", {}, {}, k_infinite}};
    std::vector<std::size_t> subjects{0};
    const auto add = [&](Change change, std::string label, std::string subject, std::size_t index) {
        variants.push_back({change, std::move(label), std::move(subject), {}, {}, k_infinite});
        subjects.push_back(index);
    };
    for (std::size_t j = 0;
         layout.stations.size() > 1 && layout.stations.size() <= k_most_left_out && j < layout.stations.size(); ++j) {
        add(Change::without_station, "without station " + layout.stations[j], layout.stations[j], j);
    }
    for (std::size_t m = 0;
         layout.reflectors.size() > 1 && layout.reflectors.size() <= k_most_left_out && m < layout.reflectors.size();
         ++m) {
        add(Change::without_reflector, "without reflector " + layout.reflectors[m], layout.reflectors[m], m);
    }
    add(Change::half_angles, "every second angle", "", 0);
    if (layout.angles.size() <= k_most_doubled_angles) {
        add(Change::twice_angles, "twice the angles", "", 0);
    }
    add(Change::half_noise, "half the length noise", "", 0);
    if (setting.stochastic.variance_linear + setting.stochastic.variance_axial + setting.stochastic.variance_tilt >
        0.0) {
        add(Change::half_repeatability, "half the table repeatability", "", 0);
    }
    workers.run(variants.size(), [&](unsigned, std::size_t task) {
        Variant& variant = variants[task];
        StochasticModel stochastic = setting.stochastic;
        switch (variant.change) {
            case Change::none:
                return evaluate_variant(setting, layout, stochastic, variant);
            case Change::without_station:
                return evaluate_variant(setting, engine::without_station(layout, subjects[task]), stochastic, variant);
            case Change::without_reflector:
                return evaluate_variant(setting, engine::without_reflector(layout, subjects[task]), stochastic,
                                        variant);
            case Change::half_angles:
                return evaluate_variant(setting, engine::with_every_angle(layout, 2), stochastic, variant);
            case Change::twice_angles:
                return evaluate_variant(setting, engine::with_twice_the_angles(layout), stochastic, variant);
            case Change::half_noise: {
                RotaryTableMeasurement quieter = layout;
                quieter.length_uncertainty.u_constant *= 0.5;
                quieter.length_uncertainty.u_proportional *= 0.5;
                return evaluate_variant(setting, quieter, stochastic, variant);
            }
            case Change::half_repeatability:
                stochastic.variance_linear *= 0.25;
                stochastic.variance_axial *= 0.25;
                stochastic.variance_tilt *= 0.25;
                return evaluate_variant(setting, layout, stochastic, variant);
        }
    });
    return variants;
}

// ---- proposal of stations -------------------------------------------------------------------------------------------

namespace {

/// The whole layout with the stations of the proposal.
void stand_at_proposal(const Setting& setting, Proposal& proposal) {
    proposal.whole = setting.whole;
    for (std::size_t j = 0; j < proposal.whole.stations.size(); ++j) {
        proposal.whole.station_start[j] = proposal.stations.positions[j];
    }
    engine::predict_lengths(proposal.whole);
    proposal.layout =
        setting.sight ? engine::with_distances(proposal.whole, engine::seen_distances(proposal.whole, *setting.sight))
                      : proposal.whole;
    proposal.expected = expect(setting, proposal.layout);
}

std::vector<std::string> broken_targets(const Setting& setting, const Expected& before, const Expected& after) {
    const std::vector<Target> was = targets_of(setting, before);
    const std::vector<Target> is = targets_of(setting, after);
    std::vector<std::string> broken;
    for (std::size_t t = 0; t < was.size(); ++t) {
        if (was[t].met && !is[t].met) {
            broken.push_back(was[t].name);
        }
    }
    return broken;
}

}  // namespace

std::optional<Proposal> propose(Setting& setting, const Expected& now, WorkerThreads& workers,
                                const Progress& progress) {
    if (!setting.request.station_region) {
        return std::nullopt;
    }
    Proposal proposal;
    engine::StationRegion region;
    region.corners = *setting.request.station_region;
    region.step = setting.request.station_step;
    region.least_distance = setting.request.least_distance;
    proposal.candidates = engine::station_candidates(setting.layout, region);
    if (proposal.candidates.positions.empty()) {
        throw InputError(Diagnostic{"GC-PLAN-0002", setting.where + "#/plan/station_region",
                                    "no position of the region is at least " + plain(region.least_distance / k_mm.si) +
                                        " mm from every reflector at every angle",
                                    "stations are proposed where they clear the turning fixture and the rotary axis",
                                    "state a larger region or a smaller least_distance_mm", Severity::error});
    }
    const std::size_t angles = setting.layout.angles.size();
    const std::size_t stride = (angles + k_most_angles_of_search - 1) / k_most_angles_of_search;
    const RotaryTableMeasurement searched =
        stride > 1 ? engine::with_every_angle(setting.whole, stride) : setting.whole;
    proposal.angles_of_search = searched.angles.size();
    if (proposal.candidates.step > region.step) {
        setting.notes.push_back("The region has more positions than are compared: the grid is " +
                                round_significant(proposal.candidates.step / k_mm.si, 3) + " mm instead of " +
                                plain(region.step / k_mm.si) + " mm.");
    }
    if (stride > 1) {
        setting.notes.push_back("Stations were compared at every " + std::to_string(stride) +
                                "th angle; what is stated "
                                "of the proposed layout is for all angles.");
    }
    if (progress) {
        progress("comparing stations at " + counted(proposal.candidates.positions.size(), "position"));
    }
    const engine::ParallelTasks parallel{
        workers.size(), [&workers](std::size_t tasks, const std::function<void(unsigned, std::size_t)>& work) {
            workers.run(tasks, work);
        }};
    engine::ExchangeRules rules;
    rules.wanted = setting.wanted;
    rules.keep_met = setting.request.keep_met_targets;
    // At the angles of the search, which may be fewer.
    const std::optional<engine::LineOfSight> sight =
        setting.sight ? std::optional(engine::LineOfSight(searched, setting.sight->rules())) : std::nullopt;
    rules.sight = sight ? &*sight : nullptr;
    proposal.stations = engine::propose_stations(searched, setting.stochastic, proposal.candidates.positions, rules,
                                                 parallel, progress);
    stand_at_proposal(setting, proposal);
    proposal.broken = broken_targets(setting, now, proposal.expected);
    // The search knows the error motions at its angles; what else is wanted shows in the whole layout.
    while (setting.request.keep_met_targets && !proposal.broken.empty() && !proposal.stations.exchanges.empty()) {
        const engine::StationExchange last = proposal.stations.exchanges.back();
        proposal.stations.exchanges.pop_back();
        proposal.stations.positions[last.station] = last.from;
        ++proposal.taken_back;
        stand_at_proposal(setting, proposal);
        proposal.broken = broken_targets(setting, now, proposal.expected);
    }
    return proposal;
}

}  // namespace gumcert::gum::plan
