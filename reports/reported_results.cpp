#include "reports/reported_results.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace gumcert::reports {

namespace {

constexpr std::array<const char*, 7> k_reasons{"asked",      "second_order", "vanishing",   "no_derivative",
                                               "not_linear", "asymmetric",   "contradicted"};
constexpr std::size_t k_most_names = 12;

/// "a, b and 3 more"
Text names_of(const std::vector<std::string>& names, const Wording& words) {
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), k_most_names); ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    return names.size() <= k_most_names
               ? Text(text)
               : words.fill("and_more", {{"names", text}, {"count", std::to_string(names.size() - k_most_names)}});
}

}  // namespace

std::vector<Text> reasons_for_monte_carlo(const std::vector<Result>& results, const Wording& words) {
    std::vector<Text> sentences;
    const auto add = [&](const char* sentence, const char* reason, const std::string ReportedResult::*of) {
        std::vector<std::string> names;
        for (const Result& r : results) {
            if (r.reported.*of == reason) {
                names.push_back(r.name);
            }
        }
        if (!names.empty()) {
            sentences.push_back(words.fill(
                sentence, {{"names", names_of(names, words)}, {"reason", words("value", "because", reason)}}));
        }
    };
    for (const char* reason : k_reasons) {
        add("reported_monte_carlo", reason, &ReportedResult::because);
        add("reported_against", reason, &ReportedResult::against);
    }
    return sentences;
}

std::vector<Text> reasons_for_monte_carlo(const EvaluationRecord& record, const Wording& words) {
    return reasons_for_monte_carlo(record.results, words);
}

}  // namespace gumcert::reports
