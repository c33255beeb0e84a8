#include "app/plan_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/document_units.h"
#include "app/evaluate_rotary_table.h"
#include "app/fixture_budget.h"
#include "app/record_parts.h"
#include "engine/campaign_layout.h"
#include "engine/geometry_check.h"
#include "engine/job/rotary_table_job.h"
#include "engine/measurement_plan.h"
#include "engine/start_values.h"
#include "gum/coverage.h"
#include "gum/propagation.h"
#include "gum/rounding.h"
#include "gum/worker_threads.h"
#include "reports/layout_plot.h"
#include "reports/svg_plot.h"

namespace gumcert::app {

namespace {

using engine::RotaryTableMeasurement;
using engine::StochasticModel;
using nlohmann::json;
using reports::StudyColumn;
using reports::StudySection;
using reports::StudyTable;

constexpr double k_infinite = std::numeric_limits<double>::infinity();
// More angles add time and next to nothing to what a comparison of stations says.
constexpr std::size_t k_most_angles_of_search = 36;
// The sensitivities of the budget are held whole; beyond this many numbers it is left out.
constexpr double k_most_sensitivities = 4e7;
constexpr std::size_t k_most_doubled_angles = 720;

constexpr std::array<const char*, 6> k_sources{"length noise", "scale",           "dead path",
                                               "fixture CMM",  "fixture thermal", "table repeatability"};

/// What is planned, and with what it is compared.
struct Setting {
    engine::RotaryTableJob job;
    RotaryTableMeasurement layout;  ///< with predicted lengths
    engine::PlanRequest request;
    StochasticModel stochastic;
    double k = 0.0;                    ///< coverage factor
    std::array<double, 2> wanted{};    ///< standard uncertainties of the targets, linear and angular
    std::array<std::string, 6> names;  ///< of the error motions
    std::string distances_from;        ///< for the document
    std::vector<std::string> notes;
};

/// Expanded uncertainties of one error motion over the angles, [m] or [rad].
struct Motion {
    double rms = 0.0, largest = 0.0;
    std::size_t worst_angle = 0;
};

const DocumentUnit& unit_of_motion(std::size_t motion) {
    return motion < 3 ? k_um : k_arcsec;
}

double target_of(const Setting& setting, std::size_t motion) {
    return motion < 3 ? setting.request.target_linear : setting.request.target_angular;
}

/// Rounded up, so that a printed U that is within a target is so (JCGM 100:2008, 7.2.6).
std::string U_text(double U, const DocumentUnit& unit) {
    return U > 0.0 ? gum::round_to_uncertainty(0.0, U / unit.si, 2, gum::RoundingMode::up).U : "0";
}

/// A stated number without the last digits of its conversion: 0.3, not 0.30000000000000004.
std::string plain(double value) {
    std::string text = gum::round_significant(value, 9);
    if (text.find('.') != std::string::npos && text.find('E') == std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') {
            text.pop_back();
        }
    }
    return text;
}

std::string mm_text(double value) {
    return gum::round_to_quantum(value / k_mm.si, 1);
}

std::string ratio_text(double ratio) {
    return std::isfinite(ratio) ? gum::round_significant(ratio, 3) : "not determined";
}

std::string angle_text(const RotaryTableMeasurement& layout, std::size_t angle) {
    return plain(layout.angles_deg[angle]) + "°";
}

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

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

/// How many of the targets a layout meets.
std::string targets_sentence(const Setting& setting, const std::array<Motion, 6>& motions) {
    std::size_t missed = 0;
    for (std::size_t c = 0; c < 6; ++c) {
        missed += motions[c].largest > target_of(setting, c) ? 1U : 0U;
    }
    return missed == 0 ? "The layout meets the targets of all six error motions."
                       : "The layout misses the target of " + std::to_string(missed) + " of the six error motions.";
}

// ---- what is planned ------------------------------------------------------------------------------------------------

/// Angles of the plan instead of those that were measured; the home angle stays.
void use_planned_angles(RotaryTableMeasurement& layout, const std::vector<double>& angles_deg) {
    const double home = layout.angles_deg[layout.home];
    layout.angles_deg = angles_deg;
    layout.angles.clear();
    for (const double angle : angles_deg) {
        layout.angles.push_back(angle * gum::k_degree);
    }
    const auto nearest = std::min_element(angles_deg.begin(), angles_deg.end(), [home](double left, double right) {
        return std::abs(left - home) < std::abs(right - home);
    });
    layout.home = static_cast<std::size_t>(nearest - angles_deg.begin());
}

void note_repeatability(Setting& setting) {
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
        gum::round_significant(std::sqrt(setting.stochastic.variance_linear) / k_um.si, 3) + " µm linear, " +
        gum::round_significant(std::sqrt(setting.stochastic.variance_axial) / k_arcsec.si, 3) +
        "″ about the axis and " + gum::round_significant(std::sqrt(setting.stochastic.variance_tilt) / k_arcsec.si, 3) +
        "″ across it, " +
        (stated ? "the start values of the job."
                : "of which the job does not state all: the others are those that an evaluation starts from. State the "
                  "repeatability that you expect of this table in table_repeatability."));
}

Setting setting_of(const std::filesystem::path& job_file, const Progress& progress) {
    Setting setting;
    setting.job = engine::read_rotary_table_job(job_file, engine::JobUse::plan);
    (void)apply_fixture_budget(setting.job);
    setting.request = setting.job.plan.value_or(engine::PlanRequest{});
    RotaryTableMeasurement& layout = setting.layout;
    layout = setting.job.measurement;
    const bool positions_known = std::all_of(layout.station_start.begin(), layout.station_start.end(),
                                             [](const auto& q) { return q.has_value(); });
    if (!positions_known && setting.job.has_lengths) {
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
    if (setting.job.has_lengths && setting.request.angles_deg.empty()) {
        setting.distances_from = "those of the lengths file";
    } else {
        if (setting.job.has_lengths) {
            use_planned_angles(layout, setting.request.angles_deg);
        }
        engine::lay_out(layout, setting.request.both_senses, setting.request.dead_path_per_reflector);
        setting.distances_from = "every station to every reflector at every planned angle";
    }
    engine::predict_lengths(layout);
    setting.stochastic = engine::planned_variances(layout.table_repeatability);
    setting.k = gum::coverage_factor(setting.job.coverage_probability, k_infinite);
    setting.wanted = {setting.request.target_linear / setting.k, setting.request.target_angular / setting.k};
    setting.names = engine::error_motion_names(layout.axis);
    note_repeatability(setting);
    if (layout.method == engine::AdjustmentMethod::sequential) {
        setting.notes.emplace_back("The job asks for the sequential method; the plan is that of the joint adjustment.");
    }
    return setting;
}

// ---- expected uncertainty -------------------------------------------------------------------------------------------

struct Expected {
    engine::ExpectedUncertainty uncertainty;
    std::array<Motion, 6> motions;
    double ratio = 0.0;  ///< largest U in units of its target
};

Expected expect(const Setting& setting, const RotaryTableMeasurement& layout) {
    Expected expected;
    expected.uncertainty = engine::expected_uncertainty(layout, setting.stochastic, evaluation_options(setting.layout));
    expected.motions = motions_of(expected.uncertainty.covariance.diagonal(), layout.angles.size(), setting.k);
    expected.ratio = ratio_of(setting, expected.motions);
    return expected;
}

StudyTable expected_table(const Setting& setting, const Expected& expected) {
    StudyTable table{"Expected expanded uncertainty of the six error motions over the angles",
                     {{"quantity", "", false},
                      {"unit", "", false},
                      {"U, root mean square", "", true},
                      {"U, largest", "", true},
                      {"at angle", "", true},
                      {"target", "", true},
                      {"target met", "", false}},
                     {}};
    for (std::size_t c = 0; c < 6; ++c) {
        const Motion& motion = expected.motions[c];
        const DocumentUnit& unit = unit_of_motion(c);
        table.rows.push_back({setting.names[c], unit.print, U_text(motion.rms, unit), U_text(motion.largest, unit),
                              angle_text(setting.layout, motion.worst_angle), plain(target_of(setting, c) / unit.si),
                              motion.largest <= target_of(setting, c) ? "yes" : "no"});
    }
    return table;
}

StudyTable other_quantities_table(const Setting& setting, const engine::ExpectedUncertainty& uncertainty) {
    StudyTable table{"Expected expanded uncertainty of the set-up errors of the fixture" +
                         std::string(uncertainty.quantities.has_reversal ? " and of the reversals" : ""),
                     {{"quantity", "", false}, {"unit", "", false}, {"U", "", true}},
                     {}};
    for (Eigen::Index i = uncertainty.quantities.set_up; i < uncertainty.covariance.rows(); ++i) {
        const gum::OutputQuantity& quantity = uncertainty.quantities.outputs[static_cast<std::size_t>(i)];
        const DocumentUnit& unit = unit_of(quantity);
        table.rows.push_back(
            {quantity.name, unit.print, U_text(setting.k * std::sqrt(uncertainty.covariance(i, i)), unit)});
    }
    return table;
}

/// What the largest U of each error motion is made of; nothing where it is too large to compute.
struct SourceShares {
    std::array<std::array<double, 6>, 6> of_motion{};  ///< by motion and source, [1]
};

std::optional<SourceShares> source_shares(const Setting& setting, const std::array<Motion, 6>& motions) {
    const RotaryTableMeasurement& layout = setting.layout;
    const engine::JointAdjustment adjustment = engine::planned_adjustment(layout, setting.stochastic);
    const double inputs = static_cast<double>(layout.lengths.size() + 6 * adjustment.visits().size());
    if (6.0 * static_cast<double>(layout.angles.size()) * inputs > k_most_sensitivities) {
        return std::nullopt;
    }
    const engine::RotaryTableModel model(layout, adjustment, setting.stochastic,
                                         {k_infinite, k_infinite, k_infinite, k_infinite, k_infinite});
    const gum::Propagation propagation = gum::propagate(model, setting.job.coverage_probability);
    SourceShares shares;
    for (std::size_t c = 0; c < 6; ++c) {
        const auto output = static_cast<Eigen::Index>(6 * motions[c].worst_angle + c);
        for (std::size_t s = 0; s < k_sources.size(); ++s) {
            for (const gum::BudgetContribution& contribution : propagation.shares_by_source) {
                if (contribution.name == k_sources[s]) {
                    shares.of_motion[c][s] = contribution.share[output];
                }
            }
        }
    }
    return shares;
}

StudyTable budget_table(const Setting& setting, const Expected& expected, const SourceShares& shares) {
    StudyTable table{"Shares of the sources in the variance, at the angle of the largest U of each error motion, in %",
                     {{"quantity", "", false}, {"at angle", "", true}},
                     {}};
    for (const char* source : k_sources) {
        table.columns.push_back({source, "", true});
    }
    for (std::size_t c = 0; c < 6; ++c) {
        std::vector<std::string> row{setting.names[c], angle_text(setting.layout, expected.motions[c].worst_angle)};
        for (const double share : shares.of_motion[c]) {
            row.push_back(gum::percent(share));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

// ---- sensitivity ----------------------------------------------------------------------------------------------------

enum class Change {
    none,
    without_station,
    without_reflector,
    half_angles,
    twice_angles,
    half_noise,
    half_repeatability
};

struct Variant {
    Change change = Change::none;
    std::string label;
    std::string subject;                           ///< station or reflector that is left out
    std::optional<std::array<Motion, 6>> motions;  ///< none: not determined
    std::optional<gum::Diagnostic> why;
    double ratio = k_infinite;
};

const char* change_word(Change change) {
    switch (change) {
        case Change::without_station:
            return "without_station";
        case Change::without_reflector:
            return "without_reflector";
        case Change::half_angles:
            return "half_the_angles";
        case Change::twice_angles:
            return "twice_the_angles";
        case Change::half_noise:
            return "half_the_length_noise";
        case Change::half_repeatability:
            return "half_the_table_repeatability";
        case Change::none:
            break;
    }
    return "as_planned";
}

void evaluate_variant(const Setting& setting, const RotaryTableMeasurement& layout, const StochasticModel& stochastic,
                      Variant& variant) {
    try {
        engine::require_enough_angles(layout);
        variant.why = engine::undetermined_by(layout, stochastic, engine::SolverOptions{});
    } catch (const gum::NoResultError& error) {
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

std::vector<Variant> variants_of(const Setting& setting, gum::WorkerThreads& workers) {
    const RotaryTableMeasurement& layout = setting.layout;
    std::vector<Variant> variants{{Change::none, "as planned", "", {}, {}, k_infinite}};
    std::vector<std::size_t> subjects{0};
    const auto add = [&](Change change, std::string label, std::string subject, std::size_t index) {
        variants.push_back({change, std::move(label), std::move(subject), {}, {}, k_infinite});
        subjects.push_back(index);
    };
    for (std::size_t j = 0; layout.stations.size() > 1 && j < layout.stations.size(); ++j) {
        add(Change::without_station, "without station " + layout.stations[j], layout.stations[j], j);
    }
    for (std::size_t m = 0; layout.reflectors.size() > 1 && m < layout.reflectors.size(); ++m) {
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

StudyTable sensitivity_table(const Setting& setting, const std::vector<Variant>& variants) {
    StudyTable table{"Largest U of each error motion when one thing changes", {{"change", "", false}}, {}};
    for (std::size_t c = 0; c < 6; ++c) {
        table.columns.push_back({setting.names[c], unit_of_motion(c).print, true});
    }
    table.columns.push_back({"largest U / target", "", true});
    for (const Variant& variant : variants) {
        std::vector<std::string> row{variant.label};
        for (std::size_t c = 0; c < 6; ++c) {
            row.push_back(variant.motions ? U_text((*variant.motions)[c].largest, unit_of_motion(c)) : "");
        }
        row.push_back(ratio_text(variant.ratio));
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::vector<std::string> sensitivity_sentences(const std::vector<Variant>& variants) {
    const double planned = variants.front().ratio;
    const Variant* best = nullptr;
    const Variant* costly = nullptr;
    const Variant* cheap = nullptr;
    for (const Variant& variant : variants) {
        if (variant.change == Change::without_station) {
            costly = costly == nullptr || variant.ratio > costly->ratio ? &variant : costly;
            cheap = cheap == nullptr || variant.ratio < cheap->ratio ? &variant : cheap;
        } else if (variant.change == Change::twice_angles || variant.change == Change::half_noise ||
                   variant.change == Change::half_repeatability) {
            best = best == nullptr || variant.ratio < best->ratio ? &variant : best;
        }
    }
    std::vector<std::string> sentences;
    // Less than a per cent is no help that anybody would pay for.
    if (best != nullptr && best->ratio < 0.99 * planned) {
        sentences.push_back("Of the changes studied, " + best->label +
                            " helps most: the largest U in units of its target goes from " + ratio_text(planned) +
                            " to " + ratio_text(best->ratio) + ".");
    } else {
        sentences.emplace_back("None of the changes studied lowers the largest U by more than 1 %.");
    }
    const auto fewer = std::find_if(variants.begin(), variants.end(),
                                    [](const Variant& variant) { return variant.change == Change::half_angles; });
    if (fewer != variants.end() && fewer->ratio < planned) {
        sentences.emplace_back(
            "Fewer angles do not measure better: the datum takes what all angles share and what turns with them out of "
            "the "
            "error motions, and the fewer angles there are, the more of the noise goes with them.");
    }
    if (costly != nullptr) {
        sentences.push_back("The station that is missed most is " + costly->subject + " (" + ratio_text(costly->ratio) +
                            " without it), the one that is missed least is " + cheap->subject + " (" +
                            ratio_text(cheap->ratio) + ").");
    }
    for (const Variant& variant : variants) {
        if (variant.why) {
            sentences.push_back(variant.label + ": " + gum::message(*variant.why) + ".");
        }
    }
    return sentences;
}

// ---- proposal of stations -------------------------------------------------------------------------------------------

struct Proposal {
    engine::StationCandidates candidates;
    engine::StationProposal stations;
    RotaryTableMeasurement layout;
    Expected expected;
    std::size_t angles_of_search = 0;
};

std::optional<Proposal> propose(Setting& setting, gum::WorkerThreads& workers, const Progress& progress) {
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
        throw gum::InputError(
            gum::Diagnostic{"GC-PLAN-0002", setting.job.files.front() + "#/plan/station_region",
                            "no position of the region is at least " + plain(region.least_distance / k_mm.si) +
                                " mm from every reflector at every angle",
                            "stations are proposed where they clear the turning fixture and the rotary axis",
                            "state a larger region or a smaller least_distance_mm", gum::Severity::error});
    }
    const std::size_t angles = setting.layout.angles.size();
    const std::size_t stride = (angles + k_most_angles_of_search - 1) / k_most_angles_of_search;
    const RotaryTableMeasurement searched =
        stride > 1 ? engine::with_every_angle(setting.layout, stride) : setting.layout;
    proposal.angles_of_search = searched.angles.size();
    if (proposal.candidates.step > region.step) {
        setting.notes.push_back("The region has more positions than are compared: the grid is " +
                                gum::round_significant(proposal.candidates.step / k_mm.si, 3) + " mm instead of " +
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
    proposal.stations = engine::propose_stations(searched, setting.stochastic, proposal.candidates.positions,
                                                 setting.wanted, parallel, progress);
    proposal.layout = setting.layout;
    for (std::size_t j = 0; j < proposal.layout.stations.size(); ++j) {
        proposal.layout.station_start[j] = proposal.stations.positions[j];
    }
    engine::predict_lengths(proposal.layout);
    proposal.expected = expect(setting, proposal.layout);
    return proposal;
}

std::vector<std::string> coordinates(const Eigen::Vector3d& position) {
    return {mm_text(position[0]), mm_text(position[1]), mm_text(position[2])};
}

/// The figures of a position in words, for lists.
std::string place_text(const Eigen::Vector3d& position) {
    const auto texts = coordinates(position);
    return texts[0] + ", " + texts[1] + ", " + texts[2];
}

void add_proposal(const Setting& setting, const Expected& now, const Proposal& proposal, StudySection& section) {
    const RotaryTableMeasurement& before = setting.layout;
    const std::vector<engine::StationExchange>& exchanges = proposal.stations.exchanges;
    section.paragraphs.push_back(
        "Every station was tried at each of " + counted(proposal.candidates.positions.size(), "position") +
        " of the region of the job, and the one exchange that lowers the largest U in units of its target most was "
        "made, again and again, until none lowered it by more than 0.5 % (greedy exchange). This finds a good layout, "
        "not provably the best one.");
    if (exchanges.empty()) {
        section.paragraphs.emplace_back("No exchange of one station improves the planned layout: it stays as it is.");
    } else {
        section.paragraphs.push_back("With the proposed stations the largest U in units of its target goes from " +
                                     ratio_text(now.ratio) + " to " + ratio_text(proposal.expected.ratio) +
                                     ": better by a factor of " + ratio_text(now.ratio / proposal.expected.ratio) +
                                     ".");
    }
    StudyTable positions{"Stations before and after, in the frame of the table",
                         {{"station", "", false},
                          {"x before", "mm", true},
                          {"y before", "mm", true},
                          {"z before", "mm", true},
                          {"x after", "mm", true},
                          {"y after", "mm", true},
                          {"z after", "mm", true},
                          {"moved", "", false}},
                         {}};
    StudyTable csv{"The proposed stations as a stations file: copy the lines into stations.csv",
                   {{"station,x_mm,y_mm,z_mm", "", false}},
                   {}};
    for (std::size_t j = 0; j < before.stations.size(); ++j) {
        const Eigen::Vector3d& from = *before.station_start[j];
        const Eigen::Vector3d& to = proposal.stations.positions[j];
        std::vector<std::string> row{before.stations[j]};
        const auto texts = coordinates(to);
        for (const auto& list : {coordinates(from), texts}) {
            row.insert(row.end(), list.begin(), list.end());
        }
        row.emplace_back(from == to ? "no" : "yes");
        positions.rows.push_back(std::move(row));
        csv.rows.push_back({before.stations[j] + "," + texts[0] + "," + texts[1] + "," + texts[2]});
    }
    StudyTable gains{"Expected U before and after",
                     {{"quantity", "", false},
                      {"unit", "", false},
                      {"largest U before", "", true},
                      {"largest U after", "", true},
                      {"before / after", "", true},
                      {"target", "", true},
                      {"target met", "", false}},
                     {}};
    for (std::size_t c = 0; c < 6; ++c) {
        const DocumentUnit& unit = unit_of_motion(c);
        const double from = now.motions[c].largest;
        const double to = proposal.expected.motions[c].largest;
        gains.rows.push_back({setting.names[c], unit.print, U_text(from, unit), U_text(to, unit), ratio_text(from / to),
                              plain(target_of(setting, c) / unit.si), to <= target_of(setting, c) ? "yes" : "no"});
    }
    section.tables = {std::move(positions), std::move(gains)};
    if (!exchanges.empty()) {
        StudyTable steps{"Exchanges in their order",
                         {{"no.", "", true},
                          {"station", "", false},
                          {"from x, y, z", "mm", false},
                          {"to x, y, z", "mm", false},
                          {"largest U / target after it", "", true}},
                         {}};
        for (std::size_t e = 0; e < exchanges.size(); ++e) {
            steps.rows.push_back({std::to_string(e + 1), before.stations[exchanges[e].station],
                                  place_text(exchanges[e].from), place_text(exchanges[e].to),
                                  ratio_text(exchanges[e].ratio)});
        }
        section.tables.push_back(std::move(steps));
        section.tables.push_back(std::move(csv));
    }
}

// ---- figures --------------------------------------------------------------------------------------------------------

std::array<double, 3> millimetres(const Eigen::Vector3d& position) {
    return {position[0] / k_mm.si, position[1] / k_mm.si, position[2] / k_mm.si};
}

std::array<std::array<double, 3>, 3> square_millimetres(const Eigen::Matrix3d& covariance) {
    std::array<std::array<double, 3>, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            result[i][j] = covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) / (k_mm.si * k_mm.si);
        }
    }
    return result;
}

std::string axis_letter(const RotaryTableMeasurement& layout) {
    return std::string(1, "ABC"[engine::axial_coordinate(layout.axis)]);
}

reports::StudyFigure layout_figure(const Setting& setting, const Expected& now,
                                   const std::optional<Proposal>& proposal) {
    const RotaryTableMeasurement& layout = setting.layout;
    reports::LayoutPlot plot;
    plot.id = "plot-plan-layout";
    plot.title = "Planned layout";
    plot.description = "Stations and reflectors in three views";
    plot.axis = axis_letter(layout);
    plot.stations_label = "station, planned";
    plot.marked_label = "station, proposed";
    for (std::size_t j = 0; j < layout.stations.size(); ++j) {
        plot.stations.push_back({.name = layout.stations[j],
                                 .position_mm = millimetres(*layout.station_start[j]),
                                 .covariance_mm2 = square_millimetres(now.uncertainty.stations[j].covariance)});
    }
    for (std::size_t j = 0; proposal && j < layout.stations.size(); ++j) {
        if (proposal->stations.positions[j] != *layout.station_start[j]) {
            plot.stations.push_back({.name = layout.stations[j],
                                     .position_mm = millimetres(proposal->stations.positions[j]),
                                     .marked = true});
        }
    }
    for (std::size_t m = 0; m < layout.reflectors.size(); ++m) {
        const auto at = static_cast<Eigen::Index>(m);
        plot.reflectors.push_back(
            {.name = layout.reflectors[m],
             .position_mm = millimetres(layout.fixture.row(at).transpose()),
             .covariance_mm2 = square_millimetres(layout.fixture_covariance.block<3, 3>(3 * at, 3 * at))});
    }
    const reports::LayoutMagnification magnified = reports::layout_magnification(plot);
    std::string caption = "Stations and reflectors at the home angle in the frame of the table";
    if (magnified.stations > 0.0) {
        caption +=
            "; confidence ellipses (95 %) of the planned stations magnified " + plain(magnified.stations) + " times";
    }
    if (magnified.reflectors > 0.0) {
        caption += ", of the reflectors " + plain(magnified.reflectors) + " times";
    }
    return {caption + ".", "Three views of the layout; the positions are in the tables.", reports::svg(plot)};
}

reports::StudyFigure bars_figure(const Setting& setting, const Expected& now, const std::optional<Proposal>& proposal) {
    reports::BarPlot plot{.id = "plot-plan-uncertainty",
                          .title = "Largest expected U of each error motion",
                          .description = "Bars in per cent of the target",
                          .x_label = "largest U in % of its target",
                          .bars = {}};
    for (std::size_t c = 0; c < 6; ++c) {
        const DocumentUnit& unit = unit_of_motion(c);
        const auto add = [&](const std::string& label, const Motion& motion) {
            const std::string gap = c < 3 ? " " : "";
            plot.bars.push_back({label, 100.0 * motion.largest / target_of(setting, c),
                                 U_text(motion.largest, unit) + gap + unit.print});
        };
        add(setting.names[c] + (proposal ? ", planned" : ""), now.motions[c]);
        if (proposal) {
            add(setting.names[c] + ", proposed", proposal->expected.motions[c]);
        }
    }
    return {std::string("Largest expected U of each error motion") +
                (proposal ? ", planned and with the proposed stations." : "."),
            "Bars; the numbers are in the tables.", reports::svg(plot)};
}

// ---- data -----------------------------------------------------------------------------------------------------------

json finite(double value) {
    return std::isfinite(value) ? json(value) : json();
}

json position_json(const Eigen::Vector3d& position) {
    const auto mm = millimetres(position);
    return json::array({mm[0], mm[1], mm[2]});
}

json motions_json(const Setting& setting, const RotaryTableMeasurement& layout, const std::array<Motion, 6>& motions) {
    json object = json::object();
    for (std::size_t c = 0; c < 6; ++c) {
        const DocumentUnit& unit = unit_of_motion(c);
        object[setting.names[c]] = {{"unit", unit.record},
                                    {"U_rms", motions[c].rms / unit.si},
                                    {"U_largest", motions[c].largest / unit.si},
                                    {"angle_deg", layout.angles_deg[motions[c].worst_angle]},
                                    {"target", target_of(setting, c) / unit.si},
                                    {"target_met", motions[c].largest <= target_of(setting, c)}};
    }
    return object;
}

json expected_json(const Setting& setting, const RotaryTableMeasurement& layout, const Expected& expected) {
    const engine::ExpectedUncertainty& uncertainty = expected.uncertainty;
    json object{{"error_motions", motions_json(setting, layout, expected.motions)},
                {"largest_ratio", expected.ratio},
                {"observations", uncertainty.observations},
                {"parameters", uncertainty.parameters},
                {"degrees_of_freedom", uncertainty.degrees_of_freedom},
                {"condition_number", uncertainty.condition_number},
                {"mean_redundancy_number", uncertainty.mean_redundancy},
                {"largest_minimal_detectable_bias_um", uncertainty.largest_minimal_detectable_bias / k_um.si},
                {"uncontrolled_distances", uncertainty.uncontrolled_distances}};
    object["angles"] = json::array();
    for (std::size_t i = 0; i < layout.angles.size(); ++i) {
        json row{{"angle_deg", layout.angles_deg[i]}};
        for (std::size_t c = 0; c < 6; ++c) {
            const auto at = static_cast<Eigen::Index>(6 * i + c);
            const double u = std::sqrt(uncertainty.covariance(at, at)) / unit_of_motion(c).si;
            row[setting.names[c]] = {{"u", u}, {"U", setting.k * u}};
        }
        object["angles"].push_back(std::move(row));
    }
    object["others"] = json::array();
    for (Eigen::Index i = uncertainty.quantities.set_up; i < uncertainty.covariance.rows(); ++i) {
        const gum::OutputQuantity& quantity = uncertainty.quantities.outputs[static_cast<std::size_t>(i)];
        const double u = std::sqrt(uncertainty.covariance(i, i)) / unit_of(quantity).si;
        object["others"].push_back(
            {{"quantity", quantity.name}, {"unit", unit_of(quantity).record}, {"u", u}, {"U", setting.k * u}});
    }
    object["stations"] = json::array();
    for (std::size_t j = 0; j < layout.stations.size(); ++j) {
        const engine::PlannedStation& station = uncertainty.stations[j];
        object["stations"].push_back({{"station", layout.stations[j]},
                                      {"position_mm", position_json(station.position)},
                                      {"u_mm", position_json(station.covariance.diagonal().cwiseSqrt())}});
    }
    return object;
}

std::string data_json(const Setting& setting, const std::string& job_name, const Expected& now,
                      const std::optional<SourceShares>& shares, const std::vector<Variant>& variants,
                      const std::optional<Proposal>& proposal) {
    const RotaryTableMeasurement& layout = setting.layout;
    json data{{"schema", "gumcert/plan/1"},
              {"job", job_name},
              {"title", setting.job.title},
              {"axis", axis_letter(layout)},
              {"datum", layout.datum == engine::Datum::home ? "home" : "axis_average_line"},
              {"coverage_probability", setting.job.coverage_probability},
              {"coverage_factor", setting.k},
              {"targets",
               {{"linear_um", setting.request.target_linear / k_um.si},
                {"angular_arcsec", setting.request.target_angular / k_arcsec.si}}},
              {"distances", layout.lengths.size()},
              {"dead_paths", layout.dead_paths.size()},
              {"table_repeatability",
               {{"u_linear_um", std::sqrt(setting.stochastic.variance_linear) / k_um.si},
                {"u_axial_arcsec", std::sqrt(setting.stochastic.variance_axial) / k_arcsec.si},
                {"u_tilt_arcsec", std::sqrt(setting.stochastic.variance_tilt) / k_arcsec.si}}}};
    data["expected"] = expected_json(setting, layout, now);
    data["budget"] = nullptr;
    if (shares) {
        data["budget"] = json::object();
        for (std::size_t c = 0; c < 6; ++c) {
            json row = json::object();
            for (std::size_t s = 0; s < k_sources.size(); ++s) {
                row[k_sources[s]] = shares->of_motion[c][s];
            }
            data["budget"][setting.names[c]] = {{"angle_deg", layout.angles_deg[now.motions[c].worst_angle]},
                                                {"shares", std::move(row)}};
        }
    }
    data["sensitivity"] = json::array();
    for (const Variant& variant : variants) {
        json row{{"change", change_word(variant.change)},
                 {"subject", variant.subject},
                 {"determined", variant.motions.has_value()},
                 {"largest_ratio", finite(variant.ratio)}};
        row["U_largest"] = nullptr;
        if (variant.motions) {
            row["U_largest"] = json::object();
            for (std::size_t c = 0; c < 6; ++c) {
                row["U_largest"][setting.names[c]] = (*variant.motions)[c].largest / unit_of_motion(c).si;
            }
        }
        row["message"] = variant.why ? json(gum::message(*variant.why)) : json();
        data["sensitivity"].push_back(std::move(row));
    }
    data["proposal"] = nullptr;
    if (proposal) {
        json exchanges = json::array();
        for (const engine::StationExchange& exchange : proposal->stations.exchanges) {
            exchanges.push_back({{"station", layout.stations[exchange.station]},
                                 {"from_mm", position_json(exchange.from)},
                                 {"to_mm", position_json(exchange.to)},
                                 {"largest_ratio", exchange.ratio}});
        }
        data["proposal"] = {{"candidates", proposal->candidates.positions.size()},
                            {"grid_step_mm", proposal->candidates.step / k_mm.si},
                            {"angles_of_search", proposal->angles_of_search},
                            {"layouts_compared", proposal->stations.layouts},
                            {"exchanges", std::move(exchanges)},
                            {"improvement_factor", now.ratio / proposal->expected.ratio},
                            {"expected", expected_json(setting, proposal->layout, proposal->expected)}};
    }
    data["notes"] = setting.notes;
    return reports::canonical_json(data);
}

// ---- the document ---------------------------------------------------------------------------------------------------

StudyTable layout_table(const Setting& setting, const Expected& now) {
    const RotaryTableMeasurement& layout = setting.layout;
    StudyTable table{"Planned stations, with the standard uncertainty with which the measurement will find them",
                     {{"station", "", false},
                      {"x", "mm", true},
                      {"y", "mm", true},
                      {"z", "mm", true},
                      {"u(x)", "µm", true},
                      {"u(y)", "µm", true},
                      {"u(z)", "µm", true}},
                     {}};
    for (std::size_t j = 0; j < layout.stations.size(); ++j) {
        const engine::PlannedStation& station = now.uncertainty.stations[j];
        std::vector<std::string> row{layout.stations[j]};
        const auto texts = coordinates(station.position);
        row.insert(row.end(), texts.begin(), texts.end());
        for (int c = 0; c < 3; ++c) {
            row.push_back(gum::round_significant(std::sqrt(station.covariance(c, c)) / k_um.si, 2));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::vector<std::pair<std::string, std::string>> facts_of(const Setting& setting, const std::string& job_name,
                                                          const Expected& now) {
    const RotaryTableMeasurement& layout = setting.layout;
    const engine::ExpectedUncertainty& uncertainty = now.uncertainty;
    const engine::LengthUncertainty& noise = layout.length_uncertainty;
    const auto um = [](double value) { return gum::round_significant(value / k_um.si, 3) + " µm"; };
    std::vector<std::pair<std::string, std::string>> facts{
        {"Job", job_name},
        {"Axis", axis_letter(layout)},
        {"Datum", layout.datum == engine::Datum::home ? "home" : "axis average line"},
        {"Layout", counted(layout.stations.size(), "station") + ", " + counted(layout.reflectors.size(), "reflector") +
                       ", " + counted(layout.angles.size(), "angle")},
        {"Distances", std::to_string(layout.lengths.size()) + ": " + setting.distances_from},
        {"Dead paths", std::to_string(layout.dead_paths.size())},
        {"Length noise, standard uncertainty",
         um(noise.u_constant) + " and " + um(noise.u_proportional) + " per metre, added in squares"}};
    if (noise.resolution > 0.0) {
        facts.emplace_back("Resolution of the lengths", um(noise.resolution));
    }
    const StochasticModel& variances = setting.stochastic;
    facts.emplace_back("Table repeatability, standard deviation",
                       um(std::sqrt(variances.variance_linear)) + ", " +
                           gum::round_significant(std::sqrt(variances.variance_axial) / k_arcsec.si, 3) +
                           "″ about the axis, " +
                           gum::round_significant(std::sqrt(variances.variance_tilt) / k_arcsec.si, 3) + "″ across it");
    facts.insert(facts.end(),
                 {{"Coverage", gum::round_significant(100.0 * setting.job.coverage_probability, 4) +
                                   " %, k = " + gum::round_significant(setting.k, 3) + ", infinite degrees of freedom"},
                  {"Targets", plain(setting.request.target_linear / k_um.si) + " µm and " +
                                  plain(setting.request.target_angular / k_arcsec.si) + "″"},
                  {"Observations, parameters, degrees of freedom", std::to_string(uncertainty.observations) + ", " +
                                                                       std::to_string(uncertainty.parameters) + ", " +
                                                                       std::to_string(uncertainty.degrees_of_freedom)},
                  {"Condition number", gum::round_significant(uncertainty.condition_number, 2)},
                  {"Mean redundancy number of the distances", gum::round_significant(uncertainty.mean_redundancy, 2)},
                  {"Largest minimal detectable bias of a distance (false alarm " +
                       plain(100.0 * layout.outliers.alpha) + " %, power 80 %)",
                   um(uncertainty.largest_minimal_detectable_bias)}});
    if (uncertainty.uncontrolled_distances > 0) {
        facts.emplace_back("Distances that no other controls", std::to_string(uncertainty.uncontrolled_distances));
    }
    return facts;
}

void add_standing_notes(Setting& setting) {
    std::vector<Eigen::Vector3d> positions;
    for (const auto& position : setting.layout.station_start) {
        positions.push_back(*position);
    }
    for (const gum::Diagnostic& note : engine::geometry_notes(setting.layout, positions)) {
        setting.notes.push_back(gum::message(note));
    }
    for (const gum::Diagnostic& warning : setting.job.warnings) {
        setting.notes.push_back(gum::message(warning));
    }
    setting.notes.emplace_back(
        "The plan is the covariance of the joint adjustment at an ideal table, with the variances stated. Set-up "
        "errors "
        "and error motions of micrometres change it by less than it is printed with.");
    setting.notes.emplace_back(
        "An evaluation that estimates variances states finite degrees of freedom and hence a somewhat larger coverage "
        "factor; distances that it leaves out as outlying are missing there.");
    setting.notes.emplace_back(
        "Lines of sight are not examined: whether the table, the fixture or another reflector is in the way of a beam, "
        "and whether a reflector faces it, is for the planner to see.");
}

}  // namespace

reports::StudyDocument plan_job(const std::filesystem::path& job, unsigned threads, const Progress& progress) {
    const auto report = [&](const char* text) {
        if (progress) {
            progress(text);
        }
    };
    Setting setting = setting_of(job, progress);
    gum::WorkerThreads workers(threads);
    report("expected uncertainties");
    const Expected now = expect(setting, setting.layout);
    report("budget by source");
    const std::optional<SourceShares> shares = source_shares(setting, now.motions);
    report("one thing changed at a time");
    const std::vector<Variant> variants = variants_of(setting, workers);
    const std::optional<Proposal> proposal = propose(setting, workers, progress);
    add_standing_notes(setting);

    const std::string job_name = job.filename().string();
    reports::StudyDocument document;
    document.kind = "plan";
    document.title = setting.job.title.empty() ? job_name : setting.job.title;
    document.subtitle = "Uncertainties to expect of this layout before anything is measured";
    document.facts = facts_of(setting, job_name, now);

    document.sections.push_back(
        {.heading = "What to expect",
         .paragraphs = {targets_sentence(setting, now.motions),
                        "The largest U in units of its target is " + ratio_text(now.ratio) +
                            "; it is what this plan compares layouts by. U is rounded up to two digits."},
         .tables = {expected_table(setting, now), other_quantities_table(setting, now.uncertainty)},
         .figures = {bars_figure(setting, now, proposal)}});
    document.sections.push_back({.heading = "Layout",
                                 .paragraphs = {},
                                 .tables = {layout_table(setting, now)},
                                 .figures = {layout_figure(setting, now, proposal)}});
    if (shares) {
        document.sections.push_back({.heading = "What the uncertainties are made of",
                                     .paragraphs = {},
                                     .tables = {budget_table(setting, now, *shares)},
                                     .figures = {}});
    } else {
        setting.notes.emplace_back("The budget by source is left out: it is made for smaller numbers of distances.");
    }
    document.sections.push_back({.heading = "What each part of the layout is worth",
                                 .paragraphs = sensitivity_sentences(variants),
                                 .tables = {sensitivity_table(setting, variants)},
                                 .figures = {}});
    if (proposal) {
        StudySection section{.heading = "Proposed stations", .paragraphs = {}, .tables = {}, .figures = {}};
        add_proposal(setting, now, *proposal, section);
        document.sections.push_back(std::move(section));
    }
    document.sections.push_back(
        {.heading = "What this rests on", .paragraphs = setting.notes, .tables = {}, .figures = {}});
    document.data_json = data_json(setting, job_name, now, shares, variants, proposal);
    return document;
}

}  // namespace gumcert::app
