#include "reports/studies/plan_data.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "json/canonical_json.h"
#include "reports/studies/plan_figures.h"

namespace gumcert::reports::plan {

using gum::plan::Change;
using gum::plan::Expected;
using gum::plan::ExpectedParameters;
using gum::plan::k_sources;
using gum::plan::Motion;
using gum::plan::PlannedParameter;
using gum::plan::Proposal;
using gum::plan::Setting;
using gum::plan::sight_counts;
using gum::plan::SightCount;
using gum::plan::SourceShares;
using gum::plan::unit_of_motion;
using gum::plan::Variant;

namespace {

using engine::RotaryTableMeasurement;
using nlohmann::json;

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

json finite(double value) {
    return std::isfinite(value) ? json(value) : json();
}

json position_json(const Eigen::Vector3d& position) {
    return json::array({position[0] / gum::k_mm.si, position[1] / gum::k_mm.si, position[2] / gum::k_mm.si});
}

json motions_json(const Setting& setting, const RotaryTableMeasurement& layout, const std::array<Motion, 6>& motions) {
    json object = json::object();
    for (std::size_t c = 0; c < 6; ++c) {
        const gum::DocumentUnit& unit = unit_of_motion(c);
        object[setting.names[c]] = {{"unit", unit.record},
                                    {"U_rms", motions[c].rms / unit.si},
                                    {"U_largest", motions[c].largest / unit.si},
                                    {"angle_deg", layout.angles_deg[motions[c].worst_angle]},
                                    {"target", target_of(setting, c) / unit.si},
                                    {"target_met", motions[c].largest <= target_of(setting, c)}};
    }
    return object;
}

json parameters_json(const Setting& setting, const ExpectedParameters& parameters) {
    json list = json::array();
    for (const PlannedParameter& parameter : parameters.all) {
        const double unit = parameter.unit().si;
        json row{{"quantity", parameter.name}, {"unit", parameter.unit().record}};
        row["u"] = parameter.U ? json(*parameter.U / setting.k / unit) : json();
        row["U"] = parameter.U ? json(*parameter.U / unit) : json();
        row["target"] = parameter.target ? json(*parameter.target / unit) : json();
        row["target_met"] = parameter.target ? json(!parameter.missed()) : json();
        list.push_back(std::move(row));
    }
    return list;
}

json sight_json(const RotaryTableMeasurement& whole, const engine::LineOfSight& sight) {
    const std::vector<SightCount> counts = sight_counts(whole, sight);
    json list = json::array();
    for (std::size_t j = 0; j < counts.size(); ++j) {
        list.push_back({{"station", whole.stations[j]},
                        {"distances", counts[j].distances},
                        {"seen", counts[j].seen()},
                        {"behind_obstacles", counts[j].by_obstacles},
                        {"behind_reflectors", counts[j].by_reflectors},
                        {"beyond_acceptance", counts[j].not_accepted}});
    }
    return list;
}

json expected_json(const Setting& setting, const RotaryTableMeasurement& layout, const Expected& expected) {
    const engine::ExpectedUncertainty& uncertainty = expected.uncertainty;
    json object{{"error_motions", motions_json(setting, layout, expected.motions)},
                {"table_parameters", parameters_json(setting, expected.parameters)},
                {"u_of_one_run_arcsec", expected.parameters.u_deviation / gum::k_arcsec.si},
                {"largest_ratio", expected.ratio},
                {"observations", uncertainty.observations},
                {"parameters", uncertainty.parameters},
                {"degrees_of_freedom", uncertainty.degrees_of_freedom},
                {"condition_number", uncertainty.condition_number},
                {"mean_redundancy_number", uncertainty.mean_redundancy},
                {"largest_minimal_detectable_bias_um", uncertainty.largest_minimal_detectable_bias / gum::k_um.si},
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
        const double u = std::sqrt(uncertainty.covariance(i, i)) / gum::unit_of(quantity).si;
        object["others"].push_back(
            {{"quantity", quantity.name}, {"unit", gum::unit_of(quantity).record}, {"u", u}, {"U", setting.k * u}});
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

}  // namespace

std::string data_json(const Setting& setting, const StudiedJob& job, const Expected& now, const SourceShares& shares,
                      const std::vector<Variant>& variants, const std::optional<Proposal>& proposal) {
    const RotaryTableMeasurement& layout = setting.layout;
    json data{{"schema", "gumcert/plan/1"},
              {"job", job.name},
              {"title", job.title},
              {"axis", axis_letter(layout)},
              {"datum", layout.datum == engine::Datum::home ? "home" : "axis_average_line"},
              {"coverage_probability", setting.coverage_probability},
              {"coverage_factor", setting.k},
              {"targets",
               {{"linear_um", setting.request.target_linear / gum::k_um.si},
                {"angular_arcsec", setting.request.target_angular / gum::k_arcsec.si}}},
              {"distances", layout.lengths.size()},
              {"dead_paths", layout.dead_paths.size()},
              {"table_repeatability",
               {{"u_linear_um", std::sqrt(setting.stochastic.variance_linear) / gum::k_um.si},
                {"u_axial_arcsec", std::sqrt(setting.stochastic.variance_axial) / gum::k_arcsec.si},
                {"u_tilt_arcsec", std::sqrt(setting.stochastic.variance_tilt) / gum::k_arcsec.si}}}};
    data["expected"] = expected_json(setting, layout, now);
    data["sight"] = setting.sight ? sight_json(setting.whole, *setting.sight) : json();
    data["budget"] = json::object();
    for (std::size_t c = 0; c < 6; ++c) {
        json row = json::object();
        for (std::size_t s = 0; s < k_sources.size(); ++s) {
            row[k_sources[s]] = shares.of_motion[c][s];
        }
        data["budget"][setting.names[c]] = {{"angle_deg", layout.angles_deg[now.motions[c].worst_angle]},
                                            {"shares", std::move(row)}};
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
                            {"grid_step_mm", proposal->candidates.step / gum::k_mm.si},
                            {"angles_of_search", proposal->angles_of_search},
                            {"layouts_compared", proposal->stations.layouts},
                            {"exchanges", std::move(exchanges)},
                            {"targets_broken", proposal->broken},
                            {"keep_met_targets", setting.request.keep_met_targets},
                            {"exchanges_taken_back", proposal->taken_back},
                            {"sight", setting.sight ? sight_json(proposal->whole, *setting.sight) : json()},
                            {"improvement_factor", now.ratio / proposal->expected.ratio},
                            {"expected", expected_json(setting, proposal->layout, proposal->expected)}};
    }
    data["notes"] = setting.notes;
    return gumcert::json::canonical_json(data);
}

}  // namespace gumcert::reports::plan
