#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "jobs/comparison/comparison_participants.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using Method = gum::AssignedValueMethod;

bool is_consensus(Method method) {
    return method != Method::reference && method != Method::given;
}

/// Methods that weight results by their stated uncertainties.
bool needs_uncertainty(const gum::AssignedValueRequest& request) {
    switch (request.method) {
        case Method::weighted_mean:
        case Method::largest_consistent_subset:
        case Method::dersimonian_laird:
        case Method::mandel_paule:
        case Method::power_moderated_mean:
            return true;
        case Method::median:
            return request.median_by_trials;
        default:
            return false;
    }
}

/// Checks the results of one item after the other.
class ResultsCheck {
public:
    ResultsCheck(const ComparisonReading& reading, const ParticipantsReader& participants)
        : reading_(reading), participants_(participants), job_(reading.job), of_item_(job_.items.size()) {
        for (std::size_t i = 0; i < job_.results.size(); ++i) {
            of_item_[job_.results[i].item].push_back(i);
            parts_.emplace(job_.results[i].item, job_.results[i].round);
        }
        for (std::size_t item = 0; item < of_item_.size(); ++item) {
            if (of_item_[item].empty()) {
                parts_.emplace(item, 0);
            }
        }
    }

    void check() {
        if (job_.participants.size() < 2) {
            reading_.problems.refuse(
                k_too_few_participants, where("/participants"),
                std::to_string(job_.participants.size()) + " participant" + (job_.participants.size() == 1 ? "" : "s"),
                "a comparison has at least 2 participants",
                "add the results of the others, or compare a method with \"lab\" and "
                "\"reference\"");
            return;
        }
        for (std::size_t item = 0; item < job_.items.size(); ++item) {
            if (of_item_[item].size() < 2) {
                refuse_too_few(item);
            } else {
                check_item(item);
            }
        }
        refuse_where_nothing_is_left();
        warn_of_absent();
    }

private:
    /// What keeps one of several items, or one of its rounds, from being evaluated is reported in place of its result;
    /// the others are evaluated.
    /// \param round  none: it holds for all rounds of the item
    void refuse_item(std::size_t item, std::optional<std::size_t> round, ProblemList& problems, const InputCode& code,
                     const std::string& where, const std::string& what, const std::string& rule,
                     const std::string& action) {
        if (parts_.size() == 1) {
            problems.refuse(code, where, what, rule, action);
            return;
        }
        refusals_.push_back({&problems, &code, {std::string(code.code), where, what, rule, action}});
        reading_.job.refused_items.emplace(std::pair(item, round), refusals_.back().diagnostic);
    }

    void refuse_where_nothing_is_left() {
        const auto& refused = job_.refused_items;
        if (std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) {
                return !refused.contains({part.first, part.second}) && !refused.contains({part.first, std::nullopt});
            })) {
            return;
        }
        for (const Refusal& refusal : refusals_) {
            const gum::Diagnostic& told = refusal.diagnostic;
            refusal.problems->refuse(*refusal.code, told.where, told.what, told.rule, told.action);
        }
    }

    [[nodiscard]] std::string where(const std::string& pointer) const { return reading_.document.where(pointer); }

    /// "of the item …" where the job has several.
    [[nodiscard]] std::string of_item(std::size_t item) const {
        return job_.items[item].id.empty() ? "" : " for the item " + text::in_quotes(job_.items[item].id);
    }
    [[nodiscard]] std::string in_round(std::size_t round) const {
        return job_.rounds[round].empty() ? "" : " in the round " + text::in_quotes(job_.rounds[round]);
    }
    /// " (item "low", round "2")", as messages of the evaluation name places; "" where the job has one item.
    [[nodiscard]] std::string place_of(std::size_t item, std::size_t round) const {
        const std::string& id = job_.items[item].id;
        const std::string& name = job_.rounds[round];
        if (id.empty() && name.empty()) {
            return "";
        }
        return " (item" + (id.empty() ? "" : " " + text::in_quotes(id)) +
               (name.empty() ? "" : ", round " + text::in_quotes(name)) + ")";
    }
    [[nodiscard]] std::string where_of(std::size_t item) const {
        const std::string pointer = child_pointer("/items", item);
        return where(reading_.document.places.contains(pointer) ? pointer : "/participants");
    }

    void refuse_too_few(std::size_t item) {
        refuse_item(
            item, std::nullopt, reading_.problems, k_too_few_results, where_of(item),
            std::to_string(of_item_[item].size()) + " result" + (of_item_[item].size() == 1 ? "" : "s") + of_item(item),
            "an item is compared between at least 2 results", "add the results that are missing, or remove the item");
    }

    /// A key of one item: its own, or the one that stands for all items.
    [[nodiscard]] std::string where_of(std::size_t item, const std::string& key) const {
        const std::string pointer = child_pointer("/items", item) + "/" + key;
        return where(reading_.document.places.contains(pointer) ? pointer : "/" + key);
    }

    void check_replicates(std::size_t item) {
        const gum::ComparisonItem& of = job_.items[item];
        if ((of.homogeneity || of.stability) && !of.sigma_pt && !of.delta_E) {
            refuse_replicates(where_of(item, of.homogeneity ? "homogeneity" : "stability"),
                              "homogeneity or stability is to be checked, and neither sigma_pt nor delta_E is stated",
                              "differences between items are held against a part of one of them",
                              "add \"sigma_pt\" or \"delta_E\"");
        } else if (of.stability && !of.homogeneity) {
            refuse_replicates(where_of(item, "stability"), "stability without homogeneity",
                              "what is measured after the round is held against what was measured before it",
                              "add the results of the first check as \"homogeneity\"");
        }
    }
    void refuse_replicates(const std::string& place, const std::string& what, const std::string& rule,
                           const std::string& action) {
        if (told_.insert(place).second) {
            reading_.problems.refuse(k_check_without_criterion, place, what, rule, action);
        }
    }

    void check_item(std::size_t item) {
        const gum::AssignedValueRequest& request = job_.items[item].assigned_value;
        check_replicates(item);
        if (request.method == Method::reference) {
            check_reference(item, request);
        }
        if (is_consensus(request.method)) {
            check_contributors(item);
        }
        if (needs_uncertainty(request)) {
            check_contributions(item, k_result_without_uncertainty, "no uncertainty",
                                "weights or trials come from the stated uncertainties",
                                "add the uncertainties, leave these results out with \"contributes\": false and a "
                                "reason, or choose a method without weights, such as \"algorithm_a\"",
                                [](const ComparisonResult& result) { return result.uncertainty || result.budget; });
        }
        if (request.method == Method::vangel_rukhin) {
            check_contributions(
                item, k_result_without_replicates, "no s above 0 with n of at least 2",
                "the method of Vangel and Rukhin needs the standard deviation of single observations "
                "and their number",
                "add s and n, or choose \"dersimonian_laird\" or \"mandel_paule\"", [](const ComparisonResult& result) {
                    return result.standard_deviation && *result.standard_deviation > 0.0 && result.observations >= 2;
                });
        }
    }

    void check_reference(std::size_t item, const gum::AssignedValueRequest& request) {
        if (request.participant.empty()) {
            return;  // reported where the assigned value was read
        }
        const auto reference = participants_.participants().find(request.participant);
        if (!reference) {
            if (told_.insert(request.where).second) {
                reading_.problems.refuse(
                    k_unknown_participant, request.where,
                    "the reference " + text::in_quotes(request.participant) + " is none of the participants",
                    "the assigned value is the result of a participant",
                    participants_.participants().advice(request.participant, "correct the id"));
            }
            return;
        }
        std::map<std::size_t, bool> rounds;  // round → the reference has a result with uncertainty
        for (const std::size_t i : of_item_[item]) {
            const ComparisonResult& result = job_.results[i];
            bool& is_there = rounds[result.round];
            is_there = is_there || (result.participant == *reference && (result.uncertainty || result.budget));
        }
        for (const auto& [round, is_there] : rounds) {
            if (!is_there) {
                refuse_item(item, round, reading_.problems, k_reference_without_result, request.where,
                            "the reference " + text::in_quotes(request.participant) +
                                " has no result with an uncertainty" + of_item(item) + in_round(round),
                            "the assigned value and its uncertainty are those of the reference",
                            "add the result and its uncertainty, or choose another assigned value");
            }
        }
    }

    void check_contributors(std::size_t item) {
        std::map<std::size_t, std::size_t> rounds;  // round → number of results that contribute
        for (const std::size_t i : of_item_[item]) {
            rounds[job_.results[i].round] += job_.results[i].contributes ? std::size_t{1} : std::size_t{0};
        }
        for (const auto& [round, count] : rounds) {
            if (count < 2) {
                refuse_item(item, round, reading_.problems, k_too_few_results, where_of(item),
                            std::to_string(count) + " result" + (count == 1 ? " contributes" : "s contribute") +
                                " to the assigned value" + of_item(item) + in_round(round),
                            "a consensus has at least 2 results",
                            "let more results contribute, or give the assigned value");
            }
        }
    }

    template <typename Holds>
    void check_contributions(std::size_t item, const InputCode& code, const std::string& what, const std::string& rule,
                             const std::string& action, const Holds& holds) {
        std::map<std::size_t, std::vector<std::size_t>> without;  // round → results
        for (const std::size_t i : of_item_[item]) {
            if (job_.results[i].contributes && !holds(job_.results[i])) {
                without[job_.results[i].round].push_back(i);
            }
        }
        for (const auto& [round, results] : without) {
            std::string names;
            for (const std::size_t i : results) {
                names +=
                    (names.empty() ? "" : ", ") + text::in_quotes(job_.participants[job_.results[i].participant].id);
            }
            refuse_item(
                item, round, participants_.problems_of(results.front()), code, job_.results[results.front()].where,
                what + " is stated by " + names + place_of(item, round) + ", and the assigned value is " +
                    text::in_quotes(
                        gum::k_assigned_value_words[static_cast<std::size_t>(job_.items[item].assigned_value.method)]),
                rule, action);
        }
    }

    void warn_of_absent() {
        std::vector<bool> is_there(job_.participants.size(), false);
        for (const ComparisonResult& result : job_.results) {
            is_there[result.participant] = true;
        }
        for (const MissingResult& missing : job_.missing) {
            is_there[missing.participant] = true;  // known to be missing
        }
        std::vector<std::string> absent;
        for (std::size_t i = 0; i < is_there.size(); ++i) {
            if (!is_there[i]) {
                absent.push_back(job_.participants[i].id);
            }
        }
        if (!absent.empty()) {
            reading_.problems.warn(k_warn_no_result, where("/participants"),
                                   list_of(absent) + (absent.size() == 1 ? " has" : " have") + " not a single result",
                                   "a participant is listed because it reported something",
                                   "check the ids, or remove the participant");
        }
    }

    const ComparisonReading& reading_;
    const ParticipantsReader& participants_;
    const ComparisonJob& job_;
    std::vector<std::vector<std::size_t>> of_item_;        ///< positions of its results
    std::set<std::pair<std::size_t, std::size_t>> parts_;  ///< items and rounds with results
    std::set<std::string> told_;
    struct Refusal {
        ProblemList* problems;
        const InputCode* code;
        gum::Diagnostic diagnostic;
    };
    std::vector<Refusal> refusals_;
};

}  // namespace

void check_results(const ComparisonReading& reading, const ParticipantsReader& participants) {
    if (participants.is_whole()) {
        ResultsCheck(reading, participants).check();
    }
}

}  // namespace gumcert::jobs
