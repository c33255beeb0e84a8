#include "reports/reported_results.h"

#include "certificate/point_names.h"
#include "gum/quantity/unit.h"
#include "reports/point_headings.h"
#include "reports/printed_texts.h"
#include "reports/record/stated_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace gumcert::reports {

namespace {

constexpr std::array<const char*, 7> k_reasons{"asked",      "second_order", "vanishing",   "no_derivative",
                                               "not_linear", "asymmetric",   "contradicted"};
constexpr std::size_t k_most_names = 12;

struct ReportedQuantity {
    Text name;
    const ReportedResult* reported;
    std::string quantity = {};  ///< of a result at one of several points
};

/// "a, b and 3 more"
Text names_of(const std::vector<Text>& names, const Wording& words) {
    Text text;
    for (std::size_t i = 0; i < std::min(names.size(), k_most_names); ++i) {
        text += (i == 0 ? Text() : Text(", ")) + names[i];
    }
    return names.size() <= k_most_names
               ? text
               : words.fill("and_more", {{"names", text}, {"count", std::to_string(names.size() - k_most_names)}});
}

/// \param law_is_shown  the document has the budgets, and beside them what the law of propagation gives
std::vector<Text> sentences_of(const std::vector<ReportedQuantity>& quantities, bool law_is_shown,
                               const Wording& words) {
    std::vector<Text> sentences;
    const auto add = [&](const char* sentence, const char* reason, const std::string ReportedResult::*of) {
        const auto holds = [&](const ReportedQuantity& q) { return q.reported->*of == reason; };
        std::set<std::string> not_everywhere;
        for (const ReportedQuantity& q : quantities) {
            if (!holds(q)) {
                not_everywhere.insert(q.quantity);
            }
        }
        std::vector<Text> names;
        std::set<std::string> named;
        for (const ReportedQuantity& q : quantities) {
            const bool at_all_points = !q.quantity.empty() && !not_everywhere.contains(q.quantity);
            if (holds(q) && (!at_all_points || named.insert(q.quantity).second)) {
                names.push_back(at_all_points ? Text(q.quantity) : q.name);
            }
        }
        if (!names.empty()) {
            sentences.push_back(words.fill(
                sentence, {{"names", names_of(names, words)}, {"reason", words("value", "because", reason)}}));
        }
    };
    for (const char* reason : k_reasons) {
        add(law_is_shown ? "reported_monte_carlo" : "reported_monte_carlo_alone", reason, &ReportedResult::because);
        add("reported_against", reason, &ReportedResult::against);
    }
    return sentences;
}

/// "EXA (30°)", "range EXA", "R_up".
Text quantity_name(const StatedPlace<const StatedValue>& place, const RotaryTable& rotary, const Wording& words) {
    switch (place.group) {
        case StatedGroup::error_motions:
            return place.name + Text(" (") + words.number(rotary.errors[place.index].angle_deg.text) + "°)";
        case StatedGroup::reversal:
            return words("label", "reversal") + Text(" " + place.name);
        case StatedGroup::ranges:
            return words("label", "range") + Text(" " + place.name);
        default:
            return place.name;
    }
}

/// What is reported of the quantities of a rotary table, where that has to be told.
std::vector<ReportedQuantity> quantities_of(const RotaryTable& rotary, const Wording& words) {
    std::vector<ReportedQuantity> all;
    for (const auto& place : stated_values(rotary, ErrorOrder::by_motion)) {
        if (place.stated.reported) {
            all.push_back({quantity_name(place, rotary, words), &*place.stated.reported});
        }
    }
    return all;
}

/// \param certificate  whose tables may show what a point is in place of its name; may be null
std::vector<ReportedQuantity> quantities_of(const std::vector<Result>& results,
                                            const certificate::Certificate* certificate, const Wording& words) {
    const auto points = certificate != nullptr ? certificate::identities_of_rows(certificate->tables)
                                               : std::map<std::string, certificate::PointIdentity>();
    std::vector<ReportedQuantity> all;
    for (const Result& result : results) {
        const auto point = points.find(result.point);
        const bool is_named =
            !result.quantity.empty() && point != points.end() && point->second.results.contains(result.quantity);
        all.push_back({is_named ? result.quantity + "[" + point_in_words(point->second.name, words) + "]" : result.name,
                       &result.reported, result.point.empty() ? std::string() : result.quantity});
    }
    return all;
}

/// Whether the mean of the trials that is stated is another value than that of the model at the estimates, as printed and by
/// more than a tenth of u.
bool is_beside_model(const Result& result) {
    constexpr double k_least_shift = 0.1;
    const ReportedResult& reported = result.reported;
    return reported.method == "monte_carlo" && reported.u &&
           std::abs(reported.value - result.value) > k_least_shift * *reported.u &&
           result.printed.value != reported.printed.value;
}

/// That the stated values are means of trials, and what the model gives at the estimates; nothing where that is the same.
void add_model_values(std::vector<Text>& sentences, const std::vector<Result>& results,
                      const std::vector<ReportedQuantity>& named, const Wording& words) {
    std::vector<Text> values;
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (is_beside_model(results[i])) {
            values.push_back(
                named[i].name + Text(": ") +
                with_unit(words.number(results[i].printed.value), gum::unit_for_people(results[i].printed.unit)));
        }
    }
    if (!values.empty()) {
        sentences.push_back(words.fill("mean_of_trials", {{"values", names_of(values, words)}}));
    }
}

Text interval_or(const std::string& U, const ReportedResult& reported, const Wording& words) {
    return reported.printed_low.empty()
               ? Text(U)
               : words.number(reported.printed_low) + "\u00A0…\u00A0" + words.number(reported.printed_high);
}

}  // namespace

std::vector<Text> reasons_for_monte_carlo(const std::vector<Result>& results, const Wording& words) {
    const std::vector<ReportedQuantity> all = quantities_of(results, nullptr, words);
    std::vector<Text> sentences = sentences_of(all, true, words);
    add_model_values(sentences, results, all, words);
    return sentences;
}

std::vector<Text> reasons_for_monte_carlo(const EvaluationRecord& record, const Wording& words) {
    std::vector<ReportedQuantity> all =
        quantities_of(record.results, record.certificate ? &*record.certificate : nullptr, words);
    const std::vector<ReportedQuantity> of_results = all;
    if (record.rotary) {
        const std::vector<ReportedQuantity> of_table = quantities_of(*record.rotary, words);
        all.insert(all.end(), of_table.begin(), of_table.end());
    }
    const bool law_is_shown = !record.certificate || record.certificate->data.annexes != "none";
    std::vector<Text> sentences = sentences_of(all, law_is_shown, words);
    add_model_values(sentences, record.results, of_results, words);
    return sentences;
}

Text stated_uncertainty(const ReportedResult& reported, const Wording& words) {
    return interval_or(reported.printed.U, reported, words);
}

Text stated_uncertainty(const StatedValue& value, const Wording& words) {
    return value.reported ? interval_or(value.printed.U, *value.reported, words) : Text(value.printed.U);
}

std::vector<double> coverage_probabilities(const EvaluationRecord& record, const certificate::CertifiedTable& table,
                                           const certificate::CertifiedColumn& column) {
    // One result name can stand for many points, and each of them may state a probability of its own.
    const bool has_points = table.argument && table.argument->name == "point";
    std::map<std::string, double> of_point;
    for (const Result& r : record.results) {
        if ((r.quantity.empty() ? r.name : r.quantity) == column.result) {
            of_point.emplace(has_points ? r.point : std::string(), r.coverage_probability);
        }
    }
    std::vector<double> all;
    for (std::size_t row = 0; row < column.values.size(); ++row) {
        const auto found = of_point.find(has_points ? table.argument->printed.at(row) : std::string());
        all.push_back(found == of_point.end() ? record.coverage_probability.number : found->second);
    }
    return all;
}

Text values_of_model(const EvaluationRecord& record, const certificate::CertifiedTable& table,
                     const certificate::CertifiedColumn& column, const Wording& words) {
    const bool has_points = table.argument && table.argument->name == "point";
    std::vector<Result> of_column;
    for (const Result& r : record.results) {
        const bool is_in_table =
            !has_points || std::ranges::find(table.argument->printed, r.point) != table.argument->printed.end();
        if ((r.quantity.empty() ? r.name : r.quantity) == column.result && is_in_table && is_beside_model(r)) {
            of_column.push_back(r);
        }
    }
    std::vector<Text> sentences;
    add_model_values(sentences, of_column,
                     quantities_of(of_column, record.certificate ? &*record.certificate : nullptr, words), words);
    return sentences.empty() ? Text() : sentences.front();
}

}  // namespace gumcert::reports
