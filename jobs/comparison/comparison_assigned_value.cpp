#include <algorithm>
#include <array>
#include <utility>

#include "jobs/comparison/comparison_items.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_reader.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;
using Method = gum::AssignedValueMethod;

/// A key that belongs to one method only.
struct KeyOfMethod {
    std::string_view key;
    Method method;
};
constexpr std::array<KeyOfMethod, 10> k_keys_of_methods{{{"participant", Method::reference},
                                                         {"value", Method::given},
                                                         {"u", Method::given},
                                                         {"U", Method::given},
                                                         {"k", Method::given},
                                                         {"nu", Method::given},
                                                         {"sources", Method::given},
                                                         {"constants", Method::algorithm_a},
                                                         {"uncertainty", Method::median},
                                                         {"power", Method::power_moderated_mean}}};

void refuse_word_alone(const JsonObject& object, Method method) {
    if (method == Method::reference) {
        object.refuse(k_assigned_value_incomplete, "assigned_value", "a reference without its participant",
                      "the assigned value is the result of one participant",
                      "write {\"method\": \"reference\", \"participant\": …}");
    } else {
        object.refuse(k_assigned_value_incomplete, "assigned_value", "a given assigned value without the value",
                      "a given value is stated with its uncertainty", "write {\"value\": …, \"U\": …, \"k\": …}");
    }
}

void warn_of_unused_keys(const ComparisonReading& reading, const JsonObject& object, Method method) {
    const auto warn = [&](std::string_view key, const std::string& rule) {
        reading.problems.warn(k_warn_unused_value, object.where(key),
                              "the key " + text::in_quotes(key) + " is not used", rule,
                              "remove it, or choose the method that it is for");
    };
    for (const KeyOfMethod& entry : k_keys_of_methods) {
        if (object.has(entry.key) && entry.method != method) {
            warn(entry.key, "the method " +
                                text::in_quotes(gum::k_assigned_value_words[static_cast<std::size_t>(method)]) +
                                " has no use for it");
        }
    }
    for (const std::string_view key : {"trials", "seed"}) {
        if (object.has(key) && !object.has("uncertainty")) {
            warn(key, "trials are those of a median with \"uncertainty\": \"trials\"");
        }
    }
}

void read_given(const ComparisonReading& reading, const JsonObject& object, gum::AssignedValueRequest& request) {
    request.value = object.required_number("value", k_compared_value).value_or(0.0);
    request.uncertainty = read_uncertainty(reading, object);
    if (!states_uncertainty(object)) {
        reading.problems.warn(k_warn_exact_assigned_value, object.where(),
                              "the assigned value " + text::shortest_plain(request.value) + " has no uncertainty",
                              "it is taken as exactly known, and Eₙ then judges the laboratories alone",
                              "add \"u\", or \"U\" and \"k\", unless the value is exact by definition");
    }
    request.sources =
        read_sources(reading, object, request.uncertainty ? std::optional{request.uncertainty->u} : std::nullopt);
}

gum::AssignedValueRequest read_object(const ComparisonReading& reading, const JsonObject& object, Method method) {
    // The search for the subset rests on a critical value that holds up to here (gum/comparison/reference_value.h).
    constexpr NumberRange k_alpha_of_subset{.low = 0.0, .high = 0.3, .low_open = true, .hint = k_alpha.hint};
    gum::AssignedValueRequest request;
    request.method = method;
    request.by_default = false;
    request.where = object.where();
    JobReader reader(object);
    reader.read(request, {"traceability"});
    const bool searches_subset = method == Method::largest_consistent_subset;
    request.alpha = object.optional_number("alpha", searches_subset ? k_alpha_of_subset : k_alpha).value_or(0.05);
    // All keys are read, also those without use: a wrong one is refused wherever it stands.
    reader.read(request, {"participant", "constants", "power"});
    reader.read(request, {"uncertainty", "trials", "seed"});
    if (method == Method::given) {
        read_given(reading, object, request);
    } else {
        (void)object.optional_number("value", k_compared_value);
        (void)read_uncertainty(reading, object);
        (void)read_sources(reading, object, std::nullopt);
    }
    if (method == Method::reference && !object.has("participant")) {
        refuse_word_alone(object, method);
    }
    warn_of_unused_keys(reading, object, method);
    return request;
}

}  // namespace

std::optional<gum::AssignedValueRequest> read_assigned_value(const ComparisonReading& reading,
                                                             const JsonObject& object) {
    const json* value = object.find("assigned_value");
    if (value == nullptr) {
        return std::nullopt;
    }
    if (value->is_object()) {
        const auto assigned = object.optional_object("assigned_value", keys_of<gum::AssignedValueRequest>());
        if (!assigned->has("method") && !assigned->has("value")) {
            assigned->refuse(k_assigned_value_incomplete, "", "an assigned value without \"method\" or \"value\"",
                             "the assigned value is given, or follows from the results by a method",
                             "add \"method\": " + text::any_of(gum::k_assigned_value_words));
            return std::nullopt;
        }
        const auto method = assigned->has("method") ? assigned->optional_choice("method", k_assigned_value_methods)
                                                    : std::optional{Method::given};
        return method ? std::optional{read_object(reading, *assigned, *method)} : std::nullopt;
    }
    if (!value->is_string()) {
        object.refuse(k_wrong_type, "assigned_value", described(*value), "must be a word or an object",
                      value->is_number() ? "write {\"value\": " + described(*value) + ", \"U\": …, \"k\": …}"
                                         : "choose " + text::any_of(gum::k_assigned_value_words));
        return std::nullopt;
    }
    const auto method = object.optional_choice("assigned_value", k_assigned_value_methods);
    if (!method) {
        return std::nullopt;
    }
    if (*method == Method::reference || *method == Method::given) {
        refuse_word_alone(object, *method);
        return std::nullopt;
    }
    gum::AssignedValueRequest request;
    request.method = *method;
    request.by_default = false;
    request.where = object.where("assigned_value");
    return request;
}

}  // namespace gumcert::jobs
