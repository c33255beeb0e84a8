#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "jobs/comparison/comparison_participants.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_reader.h"
#include "jobs/matrix_limits.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

/// Correlations of participants: pairs and groups, and whether they can hold together.
class CorrelationsReader {
public:
    CorrelationsReader(const ComparisonReading& reading, const JsonObject& root, const ParticipantsReader& participants)
        : reading_(reading), root_(root), participants_(participants) {}

    void read() {
        if (const json* pairs = root_.optional_array("correlations")) {
            for (std::size_t i = 0; i < pairs->size(); ++i) {
                read_pair((*pairs)[i], child_pointer("/correlations", i));
            }
        }
        read_groups();
        check_clusters();
    }

private:
    [[nodiscard]] std::string where(const std::string& pointer) const { return reading_.document.where(pointer); }

    std::optional<std::size_t> participant(const json& value, const std::string& pointer) {
        const auto label = label_of(value, where(pointer), reading_.problems);
        if (!label) {
            return std::nullopt;
        }
        const auto found = participants_.participants().find(*label);
        if (!found && participants_.is_whole()) {
            reading_.problems.refuse(k_unknown_participant, where(pointer),
                                     "the participant " + text::in_quotes(*label) + " is none of the job",
                                     "correlations are those of participants of the job",
                                     participants_.participants().advice(*label, "correct the id"));
        }
        return found;
    }

    void read_pair(const json& pair, const std::string& pointer) {
        if (!pair.is_array() || pair.size() != 3) {
            if (!pair.is_discarded()) {
                reading_.problems.refuse(
                    k_wrong_type, where(pointer),
                    pair.is_array() ? "an array of " + std::to_string(pair.size()) + " elements" : described(pair),
                    "a correlation is two participants and a number, [\"A\", \"B\", 0.5]", "correct it");
            }
            return;
        }
        const auto first = participant(pair[0], pointer + "/0");
        const auto second = participant(pair[1], pointer + "/1");
        if (!pair[2].is_number()) {
            if (!pair[2].is_discarded()) {
                reading_.problems.refuse(k_wrong_type, where(pointer + "/2"), described(pair[2]), "must be a number",
                                         "state r, from -1 to 1");
            }
            return;
        }
        const double r = pair[2].get<double>();
        if (!k_correlation_coefficient.contains(r)) {
            reading_.problems.refuse(k_number_out_of_range, where(pointer + "/2"), "r is " + text::shortest_plain(r),
                                     k_correlation_coefficient.rule(), k_correlation_coefficient.action());
            return;
        }
        if (!first || !second) {
            return;
        }
        const std::string& name = reading_.job.participants[*first].id;
        if (*first == *second) {
            reading_.problems.refuse(k_comparison_pair, where(pointer),
                                     "a correlation of " + text::in_quotes(name) + " with itself",
                                     "a correlation has two participants", "correct the ids");
            return;
        }
        const auto key = std::minmax(*first, *second);
        const auto [entry, is_new] = pairs_.try_emplace({key.first, key.second}, r, pointer);
        if (!is_new) {
            reading_.problems.refuse(k_comparison_pair, where(pointer),
                                     "the correlation of " + text::in_quotes(name) + " and " +
                                         text::in_quotes(reading_.job.participants[*second].id) +
                                         " is stated a second time, first at " + where(entry->second.second),
                                     "a pair has one correlation", "keep one of them");
            return;
        }
        reading_.job.correlations.push_back({key.first, key.second, r});
    }

    void read_groups() {
        const json* object = root_.find("groups");
        if (object == nullptr) {
            return;
        }
        if (!object->is_object()) {
            root_.refuse(k_wrong_type, "groups", described(*object), "must be an object",
                         "write {\"name of the group\": r}");
            return;
        }
        std::set<std::string> known;
        for (const gum::ComparisonParticipant& participant : reading_.job.participants) {
            known.insert(participant.group);
        }
        for (const std::string& name : keys_in_order(reading_.document, "/groups")) {
            const std::string at = where(child_pointer("/groups", name));
            const json& value = object->at(name);
            if (!known.contains(name) || name.empty()) {
                if (participants_.is_whole()) {
                    const std::vector<std::string_view> names(known.begin(), known.end());
                    const auto nearest = nearest_word(name, names);
                    reading_.problems.refuse(
                        k_unknown_group, at, "no participant is in the group " + text::in_quotes(name),
                        "groups are those that participants state",
                        nearest ? "did you mean " + text::in_quotes(*nearest) + "?" : "correct the name, or remove it");
                }
            } else if (!value.is_number()) {
                if (!value.is_discarded()) {
                    reading_.problems.refuse(k_wrong_type, at, described(value), "must be a number",
                                             "state r inside the group; a group without is \"unknown\"");
                }
            } else if (!k_correlation_coefficient.contains(value.get<double>())) {
                reading_.problems.refuse(k_number_out_of_range, at, "r is " + text::shortest_plain(value.get<double>()),
                                         k_correlation_coefficient.rule(), k_correlation_coefficient.action());
            } else {
                reading_.job.group_correlation[name] = value.get<double>();
            }
        }
    }

    // ---- whether they can hold together -----------------------------------------------------------------------------

    std::size_t root_of(std::size_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }

    void check_clusters() {
        const std::vector<gum::ComparisonParticipant>& participants = reading_.job.participants;
        parent_.resize(participants.size());
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
        std::map<std::string, std::size_t> first_of_group;
        for (std::size_t i = 0; i < participants.size(); ++i) {
            if (group_r(i) != 0.0) {
                const auto [entry, is_new] = first_of_group.try_emplace(participants[i].group, i);
                parent_[root_of(i)] = root_of(entry->second);
            }
        }
        for (const gum::ParticipantCorrelation& pair : reading_.job.correlations) {
            parent_[root_of(pair.first)] = root_of(pair.second);
        }
        std::map<std::size_t, std::vector<std::size_t>> clusters;
        for (std::size_t i = 0; i < parent_.size(); ++i) {
            clusters[root_of(i)].push_back(i);
        }
        std::set<std::size_t> with_pairs;
        for (const gum::ParticipantCorrelation& pair : reading_.job.correlations) {
            with_pairs.insert(root_of(pair.first));
        }
        for (const auto& [root, members] : clusters) {
            if (members.size() < 2) {
                continue;
            }
            if (with_pairs.contains(root)) {
                check_cluster(members);
            } else {
                check_group(members);
            }
        }
    }

    [[nodiscard]] double group_r(std::size_t participant) const {
        const std::string& group = reading_.job.participants[participant].group;
        const auto found = reading_.job.group_correlation.find(group);
        return group.empty() || found == reading_.job.group_correlation.end() ? 0.0 : found->second;
    }

    /// A group alone: its matrix has the eigenvalues 1 − r and 1 + (n − 1) r.
    void check_group(const std::vector<std::size_t>& members) {
        const double r = group_r(members.front());
        const double smallest = 1.0 + static_cast<double>(members.size() - 1) * r;
        if (smallest < -k_same_number) {
            const std::string& group = reading_.job.participants[members.front()].group;
            reading_.problems.refuse(
                k_comparison_correlations, where(child_pointer("/groups", group)),
                "r = " + text::shortest_plain(r) + " cannot hold between all " +
                    text::count_of(members.size(), "participant") + " of the group " + text::in_quotes(group) +
                    ": the smallest eigenvalue of their matrix is " + text::significant(smallest, 3),
                "n results that are all correlated alike have r of at least -1/(n - 1)", "correct r");
        }
    }

    void check_cluster(const std::vector<std::size_t>& members) {
        const std::vector<gum::ComparisonParticipant>& participants = reading_.job.participants;
        if (members.size() > k_most_in_matrix) {
            reading_.problems.refuse(
                k_too_many_correlated, where("/correlations"),
                text::count_of(members.size(), "participant") + " are correlated with " +
                    text::in_quotes(participants[members.front()].id) + " and with each other",
                "at most " + std::to_string(k_most_in_matrix) + " participants may be in one correlation matrix",
                "state fewer correlations");
            return;
        }
        const auto n = static_cast<Eigen::Index>(members.size());
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
        for (std::size_t i = 0; i < members.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (participants[members[i]].group == participants[members[j]].group) {
                    set(matrix, i, j, group_r(members[i]));
                }
            }
        }
        const auto place = [&](std::size_t participant) {
            return static_cast<std::size_t>(std::lower_bound(members.begin(), members.end(), participant) -
                                            members.begin());
        };
        std::string last;
        for (const auto& [pair, stated] : pairs_) {
            if (std::binary_search(members.begin(), members.end(), pair.first)) {
                set(matrix, place(pair.first), place(pair.second), stated.first);
                last = stated.second;
            }
        }
        const auto negative = negative_eigenvalue(matrix);
        if (!negative) {
            return;
        }
        std::vector<std::string> culprits;
        for (const std::size_t i : negative->culprits) {
            culprits.push_back(participants[members[i]].id);
        }
        reading_.problems.refuse(k_comparison_correlations, where(last),
                                 "the correlations of " + list_of(culprits) +
                                     " cannot hold together: the smallest eigenvalue of their matrix is " +
                                     text::significant(negative->eigenvalue, 3),
                                 "a correlation matrix is positive semi-definite",
                                 "correct the correlations of these participants");
    }

    static void set(Eigen::MatrixXd& matrix, std::size_t i, std::size_t j, double r) {
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = r;
        matrix(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = r;
    }

    const ComparisonReading& reading_;
    const JsonObject& root_;
    const ParticipantsReader& participants_;
    std::map<std::pair<std::size_t, std::size_t>, std::pair<double, std::string>> pairs_;  ///< → r and its pointer
    std::vector<std::size_t> parent_;
};

/// An item that a vector or a Youden plot names.
std::optional<std::size_t> item_named(const ComparisonReading& reading, const ParticipantsReader& participants,
                                      const json& value, const std::string& pointer) {
    const std::string where = reading.document.where(pointer);
    const auto label = label_of(value, where, reading.problems);
    if (!label) {
        return std::nullopt;
    }
    const auto found = participants.items().find(*label);
    if (!found && participants.is_whole()) {
        reading.problems.refuse(k_unknown_item, where, "the item " + text::in_quotes(*label) + " is none of the job",
                                "the items are those of the job",
                                participants.items().advice(*label, "correct the item"));
    }
    return found;
}

/// A correlation matrix of a vector.
/// \return identity where the key is absent; nothing when it was refused
std::optional<Eigen::MatrixXd> read_correlation_matrix(const ComparisonReading& reading, const JsonObject& object,
                                                       std::string_view key, const std::vector<std::string>& items) {
    const auto n = static_cast<Eigen::Index>(items.size());
    if (!object.has(key)) {
        return Eigen::MatrixXd::Identity(n, n);
    }
    auto matrix = read_rows(reading, object, key, items.size(), items.size());
    if (!matrix) {
        return std::nullopt;
    }
    const auto refuse = [&](const InputCode& code, const std::string& what, const std::string& rule) {
        object.refuse(code, key, what, rule, "correct the matrix");
        return std::nullopt;
    };
    if (matrix->rows() != n || matrix->cols() != n) {
        return refuse(k_correlation_matrix,
                      text::count_of(matrix->rows(), "row") + " of " + std::to_string(matrix->cols()) + " numbers",
                      "the matrix has one row and one column for each of the " + text::count_of(n, "item"));
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const std::string& name = items[static_cast<std::size_t>(i)];
        if ((*matrix)(i, i) != 1.0) {
            return refuse(
                k_correlation_matrix,
                "the element of " + text::in_quotes(name) + " with itself is " + text::shortest_plain((*matrix)(i, i)),
                "a correlation matrix has ones on its diagonal; it is no covariance matrix");
        }
        for (Eigen::Index j = 0; j < i; ++j) {
            const double r = (*matrix)(i, j);
            if (std::abs(r - (*matrix)(j, i)) > k_same_number || !k_correlation_coefficient.contains(r)) {
                return refuse(k_correlation_matrix,
                              "r of " + text::in_quotes(name) + " and " +
                                  text::in_quotes(items[static_cast<std::size_t>(j)]) + " is " +
                                  text::shortest_plain(r) + " in one place and " +
                                  text::shortest_plain((*matrix)(j, i)) + " in the other",
                              "a correlation matrix is symmetric, with numbers from -1 to 1");
            }
            (*matrix)(j, i) = r;
        }
    }
    if (const auto negative = negative_eigenvalue(*matrix)) {
        std::vector<std::string> culprits;
        for (const std::size_t i : negative->culprits) {
            culprits.push_back(items[i]);
        }
        return refuse(k_comparison_correlations,
                      "the correlations of " + list_of(culprits) +
                          " cannot hold together: the smallest eigenvalue is " +
                          text::significant(negative->eigenvalue, 3),
                      "a correlation matrix is positive semi-definite");
    }
    return matrix;
}

}  // namespace

void read_participant_correlations(const ComparisonReading& reading, const JsonObject& root,
                                   const ParticipantsReader& participants) {
    CorrelationsReader(reading, root, participants).read();
}

void read_vectors(const ComparisonReading& reading, const JsonObject& root, const ParticipantsReader& participants) {
    const json* array = root.optional_array("vectors");
    if (array == nullptr) {
        return;
    }
    std::set<std::string> names;
    for_each_object(reading, *array, "/vectors", keys_of<gum::ComparisonVector>(), {}, [&](const JsonObject& object) {
        gum::ComparisonVector vector;
        JobReader reader(object);
        reader.read(vector);
        if (reader.accepted("name") && !names.insert(vector.name).second) {
            object.refuse(k_repeated_id, "name", "the vector " + text::in_quotes(vector.name) + " occurs twice",
                          "a vector has a name of its own", "correct the name");
        }
        const json* items = object.required_array("items");
        if (items == nullptr) {
            return;
        }
        std::vector<std::string> ids;
        for (std::size_t i = 0; i < items->size(); ++i) {
            const std::string pointer = child_pointer(object.pointer("items"), i);
            const auto item = item_named(reading, participants, (*items)[i], pointer);
            if (!item) {
                continue;
            }
            ids.push_back(reading.job.items[*item].id);
            if (std::find(vector.items.begin(), vector.items.end(), *item) != vector.items.end()) {
                reading.problems.refuse(k_repeated_id, reading.document.where(pointer),
                                        "the item " + text::in_quotes(ids.back()) + " occurs twice in the vector",
                                        "a vector has each item once", "remove one of the two");
            }
            vector.items.push_back(*item);
        }
        if (items->size() < 2 || items->size() > 100) {
            object.refuse(k_wrong_size, "items", text::count_of(items->size(), "item"), "a vector has 2 to 100 items",
                          "list the quantities that were measured together");
            return;
        }
        if (vector.items.size() != items->size()) {
            return;
        }
        auto correlation = read_correlation_matrix(reading, object, "correlation", ids);
        auto reference = read_correlation_matrix(reading, object, "reference_correlation", ids);
        if (correlation && reference) {
            vector.correlation = std::move(*correlation);
            vector.reference_correlation = std::move(*reference);
            reading.job.vectors.push_back(std::move(vector));
        }
    });
}

void read_youden(const ComparisonReading& reading, const JsonObject& root, const ParticipantsReader& participants) {
    if (!root.has("youden")) {
        if (reading.job.items.size() == 2) {
            reading.job.youden.emplace_back(0, 1);
        }
        return;
    }
    const json* array = root.optional_array("youden");
    if (array == nullptr) {
        return;
    }
    for (std::size_t i = 0; i < array->size(); ++i) {
        const std::string pointer = child_pointer("/youden", i);
        const json& pair = (*array)[i];
        if (!pair.is_array() || pair.size() != 2) {
            if (!pair.is_discarded()) {
                reading.problems.refuse(k_wrong_type, reading.document.where(pointer), described(pair),
                                        "a Youden plot has two items, [\"A\", \"B\"]", "correct it");
            }
            continue;
        }
        const auto first = item_named(reading, participants, pair[0], pointer + "/0");
        const auto second = item_named(reading, participants, pair[1], pointer + "/1");
        if (first && second && *first == *second) {
            reading.problems.refuse(k_repeated_id, reading.document.where(pointer),
                                    "the item " + text::in_quotes(reading.job.items[*first].id) + " against itself",
                                    "a Youden plot has two items", "correct the pair");
        } else if (first && second) {
            reading.job.youden.emplace_back(*first, *second);
        }
    }
}

}  // namespace gumcert::jobs
