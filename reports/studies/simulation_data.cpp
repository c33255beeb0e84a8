#include "reports/studies/simulation_data.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "json/canonical_json.h"

namespace gumcert::reports::simulation {

using gum::AngleStudy;
using gum::CampaignResults;
using gum::DifferenceTally;
using gum::k_all_tally;
using gum::k_angular_tally;
using gum::k_estimators;
using gum::k_histogram_first;
using gum::k_histogram_width;
using gum::k_linear_tally;
using gum::k_offset_tally;
using gum::k_tilt_tally;
using gum::Tallies;
using gum::simulation::Basis;

namespace {

using engine::Datum;
using engine::RotaryTableMeasurement;
using nlohmann::json;

json tally_json(const DifferenceTally& tally) {
    json object{{"count", tally.count},
                {"difference",
                 {{"mean_absolute", tally.mean_absolute()},
                  {"rms", tally.rms()},
                  {"mean_largest_of_a_campaign", tally.mean_largest()},
                  {"largest", tally.maximum}}},
                {"datum_part_rms", tally.datum_rms()},
                {"measurement_part_rms", tally.measurement_rms()}};
    if (tally.judged > 0) {
        object["judged"] = tally.judged;
        object["stated_u_rms"] = tally.stated_rms();
        object["normalised_rms"] = tally.normalised_rms();
        object["coverage"] = tally.coverage();
        object["coverage_standard_error"] = tally.coverage_standard_error();
    }
    return object;
}

json tallies_json(const Tallies& tallies, const RotaryTableMeasurement& layout) {
    auto names = named_tallies(layout);
    for (const auto& [t, name] :
         {std::pair{k_linear_tally, "error_motions_linear"}, std::pair{k_angular_tally, "error_motions_angular"},
          std::pair{k_offset_tally, "set_up_offset"}, std::pair{k_tilt_tally, "set_up_tilt"}}) {
        names.emplace_back(t, name);
    }
    json list = json::array();
    for (const auto& [t, name] : names) {
        json object = tally_json(tallies[t]);
        object["name"] = name;
        object["unit"] = is_linear(t) ? "m" : "rad";
        list.push_back(std::move(object));
    }
    return list;
}

json results_json(const CampaignResults& results, const RotaryTableMeasurement& layout, bool noisy) {
    json object;
    object["estimators"] = json::array();
    for (std::size_t e = 0; e < k_estimators.size(); ++e) {
        const std::size_t method = e / 2;
        json estimator{{"method", method_word(k_estimators[e])},
                       {"datum", datum_word(k_estimators[e].datum)},
                       {"campaigns", results.evaluated[method]},
                       {"quantities", json::array()}};
        if (results.evaluated[method] > 0) {
            estimator["quantities"] = tallies_json(results.tallies[e], layout);
            if (noisy) {
                const DifferenceTally& all = results.tallies[e][k_all_tally];
                estimator["agreement"] = {{"values", all.judged},
                                          {"normalised_rms", all.normalised_rms()},
                                          {"coverage", all.coverage()},
                                          {"coverage_standard_error", all.coverage_standard_error()}};
            }
        }
        estimator["first_failure"] = results.failure[method] ? json(gum::message(*results.failure[method])) : json();
        object["estimators"].push_back(std::move(estimator));
    }
    if (noisy && results.evaluated[0] > 0) {
        const auto n = static_cast<double>(results.evaluated[0]);
        object["chi_square_mean"] = results.sum_chi_square / n;
        object["degrees_of_freedom_mean"] = results.sum_degrees_of_freedom / n;
        object["outliers"] = {{"planted", results.planted},
                              {"found", results.planted_found},
                              {"good", results.good},
                              {"good_flagged", results.good_flagged}};
        object["histogram"] = {
            {"first_edge", k_histogram_first}, {"cell_width", k_histogram_width}, {"counts", results.histogram}};
    }
    return object;
}

}  // namespace

std::string data_json(const StudiedJob& job, const Basis& basis, const std::vector<AngleStudy>& studies) {
    const gum::SimulationRequest& request = basis.request;
    const engine::LengthUncertainty& length = basis.layout.length_uncertainty;
    json data{{"schema", "gumcert/simulation/1"},
              {"job", job.name},
              {"title", job.title},
              {"axis", std::string(1, "ABC"[engine::axial_coordinate(basis.layout.axis)])},
              {"runs", request.runs},
              {"seed", request.seed},
              {"coverage_probability", job.coverage_probability}};
    data["assumed"] = {{"set_up_offset", request.set_up_offset},
                       {"set_up_tilt", request.set_up_tilt},
                       {"error_linear", request.error_linear},
                       {"error_angular", request.error_angular},
                       {"outliers", request.outliers},
                       {"outlier_size", request.outlier_size},
                       {"table_u_linear", basis.table.u_linear},
                       {"table_u_axial", basis.table.u_axial},
                       {"table_u_tilt", basis.table.u_tilt},
                       {"length_u_constant", length.u_constant},
                       {"length_u_proportional", length.u_proportional}};
    data["source_paper"] = {{"set_up_offset", k_paper[0].largest},
                            {"set_up_tilt", k_paper[1].largest},
                            {"error_linear", k_paper[2].largest},
                            {"error_angular", k_paper[3].largest}};
    data["studies"] = json::array();
    for (const AngleStudy& study : studies) {
        json object{{"angles", study.angles},
                    {"lengths", study.lengths},
                    {"adjusted_campaigns", study.adjusted},
                    {"sequential_method", study.sequential}};
        object["datum_only"] = json::array();
        for (std::size_t d = 0; d < 2; ++d) {
            object["datum_only"].push_back({{"datum", datum_word(d == 0 ? Datum::axis_average_line : Datum::home)},
                                            {"quantities", tallies_json(study.datum_only[d], basis.layout)}});
        }
        object["without_noise"] = study.adjusted > 0 ? results_json(study.exact, basis.layout, false) : json();
        object["with_noise"] = study.adjusted > 0 ? results_json(study.noisy, basis.layout, true) : json();
        data["studies"].push_back(std::move(object));
    }
    return gumcert::json::canonical_json(data);
}

}  // namespace gumcert::reports::simulation
