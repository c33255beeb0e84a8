#include "reports/studies/plan_document.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/rotary_table/geometry_check.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rotary_table/positioning_scope.h"
#include "gum/rotary_table/studies/plan_texts.h"
#include "gum/rounding.h"
#include "reports/studies/plan_data.h"
#include "reports/studies/plan_figures.h"
#include "text/csv_field.h"
#include "text/lists.h"

namespace gumcert::reports::plan {

using gum::plan::Change;
using gum::plan::coordinates;
using gum::plan::counted;
using gum::plan::Expected;
using gum::plan::ExpectedParameters;
using gum::plan::k_drawn_tables;
using gum::plan::k_sources;
using gum::plan::Motion;
using gum::plan::place_text;
using gum::plan::plain;
using gum::plan::PlannedParameter;
using gum::plan::Proposal;
using gum::plan::ratio_text;
using gum::plan::Setting;
using gum::plan::sight_counts;
using gum::plan::SightCount;
using gum::plan::SourceShares;
using gum::plan::U_text;
using gum::plan::unit_of_motion;
using gum::plan::Variant;

namespace {

using engine::RotaryTableMeasurement;
using engine::StochasticModel;
using reports::StudySection;
using reports::StudyTable;

std::string angle_text(const RotaryTableMeasurement& layout, std::size_t angle) {
    return plain(layout.angles_deg[angle]) + "°";
}

/// How many of the targets a layout meets.
std::string targets_sentence(const Setting& setting, const Expected& expected) {
    std::size_t missed = 0;
    for (std::size_t c = 0; c < 6; ++c) {
        missed += expected.motions[c].largest > target_of(setting, c) ? 1U : 0U;
    }
    std::string text = missed == 0
                           ? "The layout meets the targets of all six error motions."
                           : "The layout misses the target of " + std::to_string(missed) + " of the six error motions.";
    std::vector<std::string> parameters;
    std::size_t wanted = 0;
    for (const PlannedParameter& parameter : expected.parameters.all) {
        wanted += parameter.target ? 1U : 0U;
        if (parameter.missed()) {
            parameters.push_back(parameter.name);
        }
    }
    if (wanted > 0) {
        text += parameters.empty()
                    ? " It meets those of the parameters of the table."
                    : " Of the parameters of the table it misses the target of " + text::all_of(parameters) + ".";
    }
    return text;
}

/// What a proposal costs, said plainly; empty where it costs no target.
std::string broken_sentence(const Proposal& proposal) {
    return proposal.broken.empty()
               ? ""
               : "The proposed stations break what the planned ones meet: the target of " +
                     text::all_of(proposal.broken) + ". State \"keep_met_targets\": true to keep what is met.";
}

std::string U_of(const PlannedParameter& parameter) {
    return parameter.U ? U_text(*parameter.U, parameter.unit()) : "not stated";
}

std::string yes_or_no(bool yes) {
    return yes ? "yes" : "no";
}

StudyTable parameter_table(const Expected& expected) {
    StudyTable table{
        "Expected expanded uncertainty of the parameters of the table: ranges, location of the axis average "
        "line in the frame of the fixture, positioning (ISO 230-2)",
        {{"quantity", "", false},
         {"unit", "", false},
         {"U", "", true},
         {"target", "", true},
         {"target met", "", false}},
        {}};
    for (const PlannedParameter& parameter : expected.parameters.all) {
        table.rows.push_back({parameter.name, parameter.unit().print, U_of(parameter),
                              parameter.target ? plain(*parameter.target / parameter.unit().si) : "",
                              parameter.target ? yes_or_no(!parameter.missed()) : ""});
    }
    return table;
}

std::string parameters_sentence(const Expected& expected) {
    std::string text =
        "U of a range and of E, R and A depends on which angles are extreme and on how the runs scatter: it is the "
        "root mean square over " +
        std::to_string(k_drawn_tables) +
        " drawn tables, of each as an evaluation states it, for every angle that may be extreme. Their error motions "
        "are large against the uncertainties, and one angle is independent of the next; of a smooth curve more angles "
        "lie near the extreme, and an evaluation may state up to a half more.";
    const ExpectedParameters& parameters = expected.parameters;
    if (parameters.u_deviation > 0.0) {
        text += " The deviation of one run will have a standard uncertainty of " +
                gum::round_significant(parameters.u_deviation / gum::k_arcsec.si, 2) + "″, which makes " +
                gum::percent(parameters.share_of_the_noise) + " % of the variance of the runs";
        const std::string least =
            gum::round_significant(parameters.u_deviation / gum::k_largest_u_against_E / gum::k_arcsec.si, 2);
        text += (parameters.share_of_the_noise > gum::k_largest_scatter_share
                     ? ": an evaluation will not state R and A, because they would be those of the measurement. It "
                       "states E"
                     : ". An evaluation states E, R and A") +
                std::string(" of a table whose E is at least ") + least + "″, four times that uncertainty.";
    }
    return text;
}

StudyTable sight_table(const std::vector<std::string>& stations, const std::vector<SightCount>& counts) {
    StudyTable table{"Distances that the stations see",
                     {{"station", "", false},
                      {"distances", "", true},
                      {"seen", "", true},
                      {"behind obstacles", "", true},
                      {"behind reflectors", "", true},
                      {"beyond the acceptance angle", "", true}},
                     {}};
    for (std::size_t j = 0; j < stations.size(); ++j) {
        const SightCount& count = counts[j];
        table.rows.push_back({stations[j], std::to_string(count.distances), std::to_string(count.seen()),
                              std::to_string(count.by_obstacles), std::to_string(count.by_reflectors),
                              std::to_string(count.not_accepted)});
    }
    return table;
}

/// What was looked at of the lines of sight, and what was not.
std::vector<std::string> sight_sentences(const Setting& setting) {
    const engine::SightRules rules = setting.sight ? setting.sight->rules() : engine::SightRules{};
    std::vector<std::string> sentences;
    std::vector<std::string> names;
    for (const engine::Obstacle& obstacle : rules.obstacles) {
        names.push_back(obstacle.name);
    }
    sentences.push_back(names.empty()
                            ? "The job states no obstacle: whether the table, the fixture or the machine is in "
                              "the way of a beam was not looked at."
                            : "Obstacles: " + text::all_of(names) +
                                  ". Whatever else is in the way of a beam was not "
                                  "looked at.");
    sentences.push_back(rules.reflector_diameter > 0.0
                            ? "A reflector hides what is behind a sphere of " +
                                  plain(rules.reflector_diameter / gum::k_mm.si) + " mm about its centre."
                            : "The job states no diameter of the reflectors: whether one hides another was not looked "
                              "at.");
    std::vector<std::string> open;
    for (std::size_t m = 0; rules.acceptance_angle && m < rules.facing.size(); ++m) {
        if (!rules.facing[m]) {
            open.push_back(setting.layout.reflectors[m]);
        }
    }
    if (!rules.acceptance_angle) {
        sentences.emplace_back(
            "The job does not state which beams the reflectors accept (acceptance_angle_deg and facing): it was not "
            "looked at.");
    } else {
        sentences.push_back("Reflectors accept beams within " + plain(*rules.acceptance_angle / gum::k_degree) +
                            "° of the direction in which they look" +
                            (open.empty() ? "."
                                          : "; of " + text::all_of(open) +
                                                " the direction is not stated, and it was not "
                                                "looked at."));
    }
    if (setting.sight) {
        sentences.emplace_back(
            "What is not seen is left out of the plan. A dead path is taken to last through the angles at which its "
            "beam "
            "is broken: where it does not, state the distances in a lengths file.");
    }
    return sentences;
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
        const gum::DocumentUnit& unit = unit_of_motion(c);
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
        const gum::DocumentUnit& unit = gum::unit_of(quantity);
        table.rows.push_back(
            {quantity.name, unit.print, U_text(setting.k * std::sqrt(uncertainty.covariance(i, i)), unit)});
    }
    return table;
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

/// The change that helps most; nothing where none helps by a per cent, which nobody would pay for.
const Variant* best_change(const std::vector<Variant>& variants) {
    const Variant* best = nullptr;
    for (const Variant& variant : variants) {
        const bool a_gain = variant.change == Change::twice_angles || variant.change == Change::half_noise ||
                            variant.change == Change::half_repeatability;
        if (a_gain && variant.ratio < 0.99 * (best == nullptr ? variants.front().ratio : best->ratio / 0.99)) {
            best = &variant;
        }
    }
    return best;
}

std::vector<std::string> sensitivity_sentences(const std::vector<Variant>& variants) {
    const double planned = variants.front().ratio;
    const Variant* best = best_change(variants);
    const Variant* costly = nullptr;
    const Variant* cheap = nullptr;
    for (const Variant& variant : variants) {
        if (variant.change == Change::without_station) {
            costly = costly == nullptr || variant.ratio > costly->ratio ? &variant : costly;
            cheap = cheap == nullptr || variant.ratio < cheap->ratio ? &variant : cheap;
        }
    }
    std::vector<std::string> sentences;
    if (best != nullptr) {
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

void add_proposal(const Setting& setting, const Expected& now, const Proposal& proposal, StudySection& section) {
    const RotaryTableMeasurement& before = setting.layout;
    const std::vector<engine::StationExchange>& exchanges = proposal.stations.exchanges;
    section.paragraphs.push_back(
        "Every station was tried at each of " + counted(proposal.candidates.positions.size(), "position") +
        " of the region of the job, and the one exchange that lowers the largest U in units of its target most was "
        "made, again and again, until none lowered it by more than 0.5 % (greedy exchange). This finds a good layout, "
        "not provably the best one.");
    if (setting.request.keep_met_targets) {
        section.paragraphs.push_back("No exchange may make a target missed that the planned layout meets." +
                                     (proposal.taken_back == 0
                                          ? std::string()
                                          : " The last " + counted(proposal.taken_back, "exchange") +
                                                " found would have, and " + (proposal.taken_back == 1 ? "is" : "are") +
                                                " taken back."));
    }
    if (!proposal.broken.empty()) {
        section.paragraphs.push_back(broken_sentence(proposal));
    }
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
        csv.rows.push_back({text::csv_field(before.stations[j]) + "," + texts[0] + "," + texts[1] + "," + texts[2]});
    }
    StudyTable gains{"Expected U before and after",
                     {{"quantity", "", false},
                      {"unit", "", false},
                      {"largest U before", "", true},
                      {"largest U after", "", true},
                      {"before / after", "", true},
                      {"target", "", true},
                      {"met before", "", false},
                      {"met after", "", false}},
                     {}};
    for (std::size_t c = 0; c < 6; ++c) {
        const gum::DocumentUnit& unit = unit_of_motion(c);
        const double from = now.motions[c].largest;
        const double to = proposal.expected.motions[c].largest;
        gains.rows.push_back({setting.names[c], unit.print, U_text(from, unit), U_text(to, unit), ratio_text(from / to),
                              plain(target_of(setting, c) / unit.si), yes_or_no(from <= target_of(setting, c)),
                              yes_or_no(to <= target_of(setting, c))});
    }
    for (std::size_t i = 0; i < now.parameters.all.size() && i < proposal.expected.parameters.all.size(); ++i) {
        const PlannedParameter& from = now.parameters.all[i];
        const PlannedParameter& to = proposal.expected.parameters.all[i];
        gains.rows.push_back(
            {from.name, from.unit().print, U_of(from), U_of(to), from.U && to.U ? ratio_text(*from.U / *to.U) : "",
             from.target ? plain(*from.target / from.unit().si) : "", from.target ? yes_or_no(!from.missed()) : "",
             from.target ? yes_or_no(!to.missed()) : ""});
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
    if (setting.sight) {
        StudyTable sight = sight_table(before.stations, sight_counts(proposal.whole, *setting.sight));
        sight.caption += " from the proposed positions";
        section.tables.push_back(std::move(sight));
    }
}

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
            row.push_back(gum::round_significant(std::sqrt(station.covariance(c, c)) / gum::k_um.si, 2));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::vector<std::pair<std::string, std::string>> facts_of(const Setting& setting, const StudiedJob& job,
                                                          const Expected& now) {
    const RotaryTableMeasurement& layout = setting.layout;
    const engine::ExpectedUncertainty& uncertainty = now.uncertainty;
    const engine::LengthUncertainty& noise = layout.length_uncertainty;
    const auto um = [](double value) { return gum::round_significant(value / gum::k_um.si, 3) + " µm"; };
    std::vector<std::pair<std::string, std::string>> facts{
        {"Job", job.name},
        {"Axis", axis_letter(layout)},
        {"Datum", layout.datum == engine::Datum::home ? "home" : "axis average line"},
        {"Layout", counted(layout.stations.size(), "station") + ", " + counted(layout.reflectors.size(), "reflector") +
                       ", " + counted(layout.angles.size(), "angle")},
        {"Distances", std::to_string(layout.lengths.size()) + ": " + setting.distances_from +
                          (layout.lengths.size() < setting.whole.lengths.size()
                               ? ", without " + std::to_string(setting.whole.lengths.size() - layout.lengths.size()) +
                                     " that are not seen"
                               : "")},
        {"Dead paths", std::to_string(layout.dead_paths.size())},
        {"Length noise, standard uncertainty",
         um(noise.u_constant) + " and " + um(noise.u_proportional) + " per metre, added in squares"}};
    if (noise.resolution > 0.0) {
        facts.emplace_back("Resolution of the lengths", um(noise.resolution));
    }
    const StochasticModel& variances = setting.stochastic;
    facts.emplace_back(
        "Table repeatability, standard deviation",
        um(std::sqrt(variances.variance_linear)) + ", " +
            gum::round_significant(std::sqrt(variances.variance_axial) / gum::k_arcsec.si, 3) + "″ about the axis, " +
            gum::round_significant(std::sqrt(variances.variance_tilt) / gum::k_arcsec.si, 3) + "″ across it");
    facts.insert(facts.end(),
                 {{"Coverage", gum::round_significant(100.0 * setting.coverage_probability, 4) +
                                   " %, k = " + gum::round_significant(setting.k, 3) + ", infinite degrees of freedom"},
                  {"Targets", plain(setting.request.target_linear / gum::k_um.si) + " µm and " +
                                  plain(setting.request.target_angular / gum::k_arcsec.si) + "″"},
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

/// What a reader who reads no further must know.
std::string found_text(const Setting& setting, const Expected& now, const std::vector<Variant>& variants,
                       const std::optional<Proposal>& proposal) {
    std::string text = "Of this layout, U of at most ";
    for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
        std::size_t worst = first;
        for (std::size_t c = first; c < first + 3; ++c) {
            worst = now.motions[c].largest > now.motions[worst].largest ? c : worst;
        }
        const gum::DocumentUnit& unit = unit_of_motion(worst);
        const std::string gap = first == 0 ? " " : "";
        text += (first == 0 ? "" : ", and at most ") + U_text(now.motions[worst].largest, unit) + gap + unit.print +
                " is to be expected for the " + (first == 0 ? "linear" : "angular") + " error motions (target " +
                plain(target_of(setting, worst) / unit.si) + gap + unit.print + ")";
    }
    text += ". " + targets_sentence(setting, now);
    if (proposal && !proposal->stations.exchanges.empty()) {
        text += " With the proposed stations the largest U in units of its target would go from " +
                ratio_text(now.ratio) + " to " + ratio_text(proposal->expected.ratio) + ".";
        text += proposal->broken.empty() ? "" : " " + broken_sentence(*proposal);
    } else if (const Variant* best = best_change(variants)) {
        text += " Of the changes studied, " + best->label + " would help most.";
    }
    return text;
}

void add_standing_notes(const StudiedJob& job, Setting& setting) {
    std::vector<Eigen::Vector3d> positions;
    for (const auto& position : setting.layout.station_start) {
        positions.push_back(*position);
    }
    for (const gum::Diagnostic& note : engine::geometry_notes(setting.layout, positions)) {
        setting.notes.push_back(gum::message(note));
    }
    for (const gum::Diagnostic& warning : job.warnings) {
        setting.notes.push_back(gum::message(warning));
    }
    setting.notes.emplace_back(
        "The plan is the covariance of the joint adjustment at an ideal table, with the variances stated. Set-up "
        "errors "
        "and error motions of micrometres change it by less than it is printed with.");
    setting.notes.emplace_back(
        "An evaluation that estimates variances states finite degrees of freedom and hence a somewhat larger coverage "
        "factor; distances that it leaves out as outlying are missing there.");
}

}  // namespace

reports::StudyDocument document_of(const StudiedJob& job, Setting setting, const Expected& now,
                                   const SourceShares& shares, const std::vector<Variant>& variants,
                                   const std::optional<Proposal>& proposal) {
    add_standing_notes(job, setting);

    reports::StudyDocument document;
    document.kind = "plan";
    document.title = job.title.empty() ? job.name : job.title;
    document.subtitle = found_text(setting, now, variants, proposal);
    document.facts = facts_of(setting, job, now);

    document.sections.push_back(
        {.heading = "What to expect",
         .paragraphs = {"The largest U in units of its target is " + ratio_text(now.ratio) +
                            "; it is what this plan compares layouts by. U is rounded up to two digits.",
                        parameters_sentence(now)},
         .tables = {expected_table(setting, now), parameter_table(now),
                    other_quantities_table(setting, now.uncertainty)},
         .figures = {bars_figure(setting, now, proposal)}});
    document.sections.push_back({.heading = "Layout",
                                 .paragraphs = {},
                                 .tables = {layout_table(setting, now)},
                                 .figures = {layout_figure(setting, now, proposal)}});
    document.sections.push_back(
        {.heading = "Lines of sight",
         .paragraphs = sight_sentences(setting),
         .tables = setting.sight ? std::vector<StudyTable>{sight_table(setting.whole.stations,
                                                                       sight_counts(setting.whole, *setting.sight))}
                                 : std::vector<StudyTable>{},
         .figures = {}});
    document.sections.push_back({.heading = "What the uncertainties are made of",
                                 .paragraphs = {},
                                 .tables = {budget_table(setting, now, shares)},
                                 .figures = {}});
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
    document.data_json = data_json(setting, job, now, shares, variants, proposal);
    return document;
}

}  // namespace gumcert::reports::plan
