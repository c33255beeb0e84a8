#include "jobs/comparison/comparison_items.h"

#include <array>
#include <utility>

#include "jobs/budget/budget_fit_statement.h"
#include "jobs/comparison/comparison_keys.h"
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
    if (object.has("percent")) {
        request.method = gum::SigmaPtMethod::percent_of_assigned;
        const auto percent =
            object.required_number("percent", {.low = 1e-12, .high = 1e6, .unit = "%", .hint = "state a percentage"});
        request.value = percent.value_or(1.0);
        return percent ? std::optional{request} : std::nullopt;
    }
    if (object.has("mass_fraction_per_unit")) {
        request.method = gum::SigmaPtMethod::mass_fraction;
        const auto fraction = object.required_number(
            "mass_fraction_per_unit",
            {.low = 1e-30, .high = 1.0, .hint = "state the mass fraction that 1 of the unit is: 1e-6 for mg/kg"});
        request.mass_fraction_per_unit = fraction.value_or(1.0);
        return fraction ? std::optional{request} : std::nullopt;
    }
    request.method = gum::SigmaPtMethod::precision;
    const auto reproducibility = object.required_number(
        "reproducibility", {.low = k_least_compared_u,
                            .high = k_largest_compared,
                            .hint = "state the standard deviation under conditions of reproducibility"});
    const auto repeatability = object.required_number("repeatability", between(0.0, k_largest_compared, ""));
    const auto replicates = object.optional_integer("replicates", between(1.0, 1e6, ""));
    if (!reproducibility || !repeatability || (object.has("replicates") && !replicates)) {
        return std::nullopt;
    }
    if (*repeatability > *reproducibility) {
        object.refuse(k_sigma_pt, "repeatability",
                      "the repeatability " + text::shortest_plain(*repeatability) +
                          " is larger than the reproducibility " + text::shortest_plain(*reproducibility),
                      "reproducibility holds repeatability and what differs between laboratories",
                      "check which number is which");
        return std::nullopt;
    }
    request.reproducibility = *reproducibility;
    request.repeatability = *repeatability;
    request.replicates = static_cast<std::size_t>(replicates.value_or(1));
    return request;
}

std::optional<gum::SigmaPtRequest> read_sigma_pt(const JsonObject& object) {
    const json* value = object.find("sigma_pt");
    if (value == nullptr) {
        return std::nullopt;
    }
    if (value->is_string()) {
        constexpr std::array<std::pair<std::string_view, gum::SigmaPtMethod>, 2> k_words{
            {{"robust", gum::SigmaPtMethod::robust}, {"standard_deviation", gum::SigmaPtMethod::standard_deviation}}};
        const auto method = object.optional_choice("sigma_pt", k_words);
        return method ? std::optional{gum::SigmaPtRequest{.method = *method}} : std::nullopt;
    }
    if (value->is_object()) {
        const auto sigma = object.optional_object("sigma_pt", k_sigma_keys);
        return read_sigma_object(*sigma);
    }
    const auto number = read_positive(object, "sigma_pt", "state the standard deviation that results are scored with");
    return number ? std::optional{gum::SigmaPtRequest{.method = gum::SigmaPtMethod::given, .value = *number}}
                  : std::nullopt;
}

void read_replicates(const ComparisonReading& reading, const JsonObject& object, gum::ComparisonItem& item) {
    if (object.has("homogeneity")) {
        item.homogeneity = read_rows(reading, object, "homogeneity", 2, 2);
        if (item.homogeneity && item.homogeneity->rows() < static_cast<Eigen::Index>(k_usual_items_to_check)) {
            reading.problems.warn(k_warn_few_to_check, object.where("homogeneity"),
                                  std::to_string(item.homogeneity->rows()) + " items in the check of homogeneity",
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
    if (const auto delta = read_positive(object, "delta_E", "state the largest error that is allowed")) {
        item.delta_E = delta;
    }
    if (const auto bandwidth = read_positive(object, "kernel_bandwidth", "state the width of the kernel")) {
        item.kernel_bandwidth = bandwidth;
    }
    read_replicates(reading, object, item);
    if (const auto reference = object.optional_object("reference_value", k_reference_value_keys)) {
        const auto value = reference->required_number("value", compared_value());
        const auto uncertainty = read_uncertainty(reading, *reference);
        if (!states_uncertainty(*reference)) {
            reference->refuse(k_assigned_value_incomplete, "", "a reference value without uncertainty",
                              "it is held against the consensus with the uncertainties of both",
                              "add \"u\", or \"U\" and \"k\"");
        }
        if (value && uncertainty) {
            item.reference_value = *value;
            item.u_reference_value = uncertainty->u;
        }
    }
}

void read_items(const ComparisonReading& reading, const json& array, const gum::ComparisonItem& defaults,
                LabelIndex& labels) {
    for_each_object(reading, array, "/items", k_listed_item_keys, {}, [&](const JsonObject& object) {
        gum::ComparisonItem item = defaults;
        const auto id = required_label(object, "id", reading.problems);
        item.name = object.optional_name("name", 1000).value_or(id.value_or(""));
        read_item_keys(reading, object, item);
        if (!id) {
            return;
        }
        item.id = *id;
        if (!labels.add(*id).second) {
            object.refuse(k_repeated_id, "id", "the item " + text::in_quotes(*id) + " occurs twice",
                          "an item is stated once", "correct the id, or remove one of the two");
            return;
        }
        reading.job.items.push_back(std::move(item));
    });
}

}  // namespace gumcert::jobs
