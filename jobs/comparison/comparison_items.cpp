#include "jobs/comparison/comparison_items.h"

#include <utility>

#include "jobs/budget/budget_fit_statement.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_reader.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

constexpr std::size_t k_usual_items_to_check = 10;

/// σ_pt as an object: exactly one of its three forms.
std::optional<gum::SigmaPtRequest> read_sigma_object(const JsonObject& object) {
    gum::SigmaPtRequest request;
    const bool has_precision = object.has("reproducibility") || object.has("repeatability") || object.has("replicates");
    const int forms =
        (object.has("percent") ? 1 : 0) + (object.has("mass_fraction_per_unit") ? 1 : 0) + (has_precision ? 1 : 0);
    if (forms != 1) {
        object.refuse(k_sigma_pt, "", forms == 0 ? "no statement of sigma_pt" : "several statements of sigma_pt",
                      "it is a percentage, a mass fraction for the Horwitz curve, or the precision of a method",
                      "state \"percent\", or \"mass_fraction_per_unit\", or \"reproducibility\" and "
                      "\"repeatability\"");
        return std::nullopt;
    }
    JobReader reader(object);
    for (const auto& [key, method] : {std::pair("percent", gum::SigmaPtMethod::percent_of_assigned),
                                      std::pair("mass_fraction_per_unit", gum::SigmaPtMethod::mass_fraction)}) {
        if (object.has(key)) {
            request.method = method;
            reader.read(request, {key});
            return reader.accepted(key) ? std::optional{request} : std::nullopt;
        }
    }
    request.method = gum::SigmaPtMethod::precision;
    for (const char* key : {"reproducibility", "repeatability"}) {
        object.require(key);
        reader.read(request, {key});
    }
    reader.read(request, {"replicates"});
    if (!reader.accepted("reproducibility") || !reader.accepted("repeatability") ||
        (object.has("replicates") && !reader.accepted("replicates"))) {
        return std::nullopt;
    }
    if (request.repeatability > request.reproducibility) {
        object.refuse(k_sigma_pt, "repeatability",
                      "the repeatability " + text::shortest_plain(request.repeatability) +
                          " is larger than the reproducibility " + text::shortest_plain(request.reproducibility),
                      "reproducibility holds repeatability and what differs between laboratories",
                      "check which number is which");
        return std::nullopt;
    }
    return request;
}

std::optional<gum::SigmaPtRequest> read_sigma_pt(const JsonObject& object) {
    const json* value = object.find("sigma_pt");
    if (value == nullptr) {
        return std::nullopt;
    }
    if (value->is_string()) {
        const auto method = object.optional_choice("sigma_pt", k_sigma_pt_words);
        return method ? std::optional{gum::SigmaPtRequest{.method = *method}} : std::nullopt;
    }
    if (value->is_object()) {
        const auto sigma = object.optional_object("sigma_pt", keys_of<gum::SigmaPtRequest>());
        return read_sigma_object(*sigma);
    }
    gum::SigmaPtRequest given;
    JobReader reader(object);
    reader("sigma_pt", given.value, k_given_sigma_pt, {});
    return reader.accepted("sigma_pt") ? std::optional{given} : std::nullopt;
}

void read_replicates(const ComparisonReading& reading, const JsonObject& object, gum::ComparisonItem& item) {
    if (object.has("homogeneity")) {
        item.homogeneity = read_rows(reading, object, "homogeneity", 2, 2);
        if (item.homogeneity && item.homogeneity->rows() < static_cast<Eigen::Index>(k_usual_items_to_check)) {
            reading.problems.warn(k_warn_few_to_check, object.where("homogeneity"),
                                  text::count_of(item.homogeneity->rows(), "item") + " in the check of homogeneity",
                                  "a check with fewer than 10 items finds large differences only",
                                  "measure more items, or say in the report why so few are enough");
        }
    }
    if (object.has("stability")) {
        item.stability = read_rows(reading, object, "stability", 1, 1);
    }
}

}  // namespace

void read_item_keys(const ComparisonReading& reading, const JsonObject& object, gum::ComparisonItem& item) {
    if (object.has("unit")) {
        if (auto unit = read_unit(object, "unit", reading.problems)) {
            item.unit = std::move(*unit);
        }
    }
    if (auto assigned = read_assigned_value(reading, object)) {
        item.assigned_value = std::move(*assigned);
    }
    if (const auto sigma = read_sigma_pt(object)) {
        item.sigma_pt = sigma;
    }
    JobReader(object).read(item, {"delta_E", "kernel_bandwidth"});
    read_replicates(reading, object, item);
    if (const auto reference = object.optional_object("reference_value", keys_of<ReferenceValueStatement>())) {
        ReferenceValueStatement stated;
        JobReader reader(*reference);
        reader.read(stated);
        const auto uncertainty = read_uncertainty(reading, *reference);
        if (!states_uncertainty(*reference)) {
            reference->refuse(k_assigned_value_incomplete, "", "a reference value without uncertainty",
                              "it is held against the consensus with the uncertainties of both",
                              "add \"u\", or \"U\" and \"k\"");
        }
        if (reader.accepted("value") && uncertainty) {
            item.reference_value = stated.value;
            item.u_reference_value = uncertainty->u;
        }
    }
}

void read_items(const ComparisonReading& reading, const json& array, const gum::ComparisonItem& defaults,
                LabelIndex& labels) {
    for_each_object(reading, array, "/items", keys_of<ListedItem>(), {}, [&](const JsonObject& object) {
        ListedItem stated{defaults};
        JobReader reader(object);
        reader.read(stated, {"id", "name"});
        read_item_keys(reading, object, stated.item);
        if (!reader.accepted("id")) {
            return;
        }
        const std::string& id = stated.item.id;
        if (!reader.accepted("name")) {
            stated.item.name = id;
        }
        if (!labels.add(id).second) {
            object.refuse(k_repeated_id, "id", "the item " + text::in_quotes(id) + " occurs twice",
                          "an item is stated once", "correct the id, or remove one of the two");
            return;
        }
        reading.job.items.push_back(std::move(stated.item));
    });
}

}  // namespace gumcert::jobs
