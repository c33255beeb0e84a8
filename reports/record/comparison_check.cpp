#include "reports/record/comparison_check.h"
#include "text/numbers.h"

#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

constexpr const char* k_a_participant = "must be one of the participants";

std::string in_quotes(const std::string& text) {
    return '"' + text + '"';
}

/// The place of an element of a list; its text is made only for a breach, for a record has a million elements.
struct Element {
    std::string_view list;
    std::size_t position = 0;

    [[nodiscard]] std::string pointer(std::string_view key) const {
        return "/" + std::string(list) + "/" + std::to_string(position) + "/" + std::string(key);
    }
};

class ComparisonCheck {
public:
    ComparisonCheck(const Comparison& comparison, const RecordBreach& report)
        : comparison_(comparison), is_between_laboratories_(comparison.form == "laboratories"), report_(report) {}

    void check() {
        check_participants();
        check_items();
        check_points();
        check_vectors();
        check_youden();
        check_shared_sources();
        if (comparison_.correlation_given) {
            correlation("/correlation_given", *comparison_.correlation_given);
        }
        for (std::size_t i = 0; i + 1 < comparison_.summary.size(); ++i) {
            if (comparison_.summary[i].direction == "all") {
                report_("/summary/all", "before other directions", "the summary of all directions comes last");
            }
        }
    }

private:
    void correlation(const std::string& at, double r) const {
        if (!(std::abs(r) <= 1.0 + 1e-9)) {
            report_(at, text::shortest(r), "a correlation coefficient lies between -1 and 1");
        }
    }
    void participant(const Element& element, std::string_view key, const std::string& id) const {
        if (!participants_.contains(id)) {
            report_(element.pointer(key), in_quotes(id), k_a_participant);
        }
    }
    void item(const Element& element, std::string_view key, const std::string& id, const std::string& round) const {
        if (!items_.contains({id, round})) {
            report_(element.pointer(key), in_quotes(id) + " in round " + in_quotes(round),
                    "must be one of the items, in its round");
        }
    }
    /// A participant named by an element of a list inside an element.
    /// \param key  "" where the id is the element itself
    void participant(const Element& element, std::string_view list, std::size_t position, std::string_view key,
                     const std::string& id) const {
        if (!participants_.contains(id)) {
            report_(element.pointer(list) + "/" + std::to_string(position) + std::string(key), in_quotes(id),
                    k_a_participant);
        }
    }
    void participants(const Element& element, std::string_view list, const std::vector<std::string>& ids) const {
        for (std::size_t i = 0; i < ids.size(); ++i) {
            participant(element, list, i, "", ids[i]);
        }
    }

    void check_participants() {
        for (std::size_t i = 0; i < comparison_.participants.size(); ++i) {
            const std::string& id = comparison_.participants[i].id;
            if (!participants_.insert(id).second) {
                report_(Element{"participants", i}.pointer("id"), in_quotes(id), "a participant is listed once");
            }
        }
    }

    void check_items() {
        for (std::size_t i = 0; i < comparison_.items.size(); ++i) {
            const ComparisonItemEvaluation& of = comparison_.items[i];
            const Element at{"items", i};
            if (!items_.emplace(of.id, of.round).second) {
                report_(at.pointer("id"), in_quotes(of.id), "an item is listed once in a round");
            }
            check_consistency(at, of);
            if (of.criterion.number.has_value() != of.criterion_met.has_value()) {
                report_(at.pointer("criterion_met"), of.criterion_met ? "without criterion" : "missing",
                        "criterion and criterion_met stand together");
            }
            if (!of.reference_participant.empty()) {
                participant(at, "reference_participant", of.reference_participant);
            }
            participants(at, "not_contributing", of.not_contributing);
            participants(at, "not_consistent", of.not_consistent);
            participants(at, "in_another_subset", of.in_another_subset);
            participants(at, "missing", of.missing);
            for (std::size_t j = 0; j < of.weights.size(); ++j) {
                participant(at, "weights", j, "/participant", of.weights[j].participant);
            }
            for (std::size_t j = 0; j < of.pairs.size(); ++j) {
                participant(at, "pairs", j, "/first", of.pairs[j].first);
                participant(at, "pairs", j, "/second", of.pairs[j].second);
            }
        }
    }

    void check_consistency(const Element& at, const ComparisonItemEvaluation& of) const {
        if (of.consistency && of.consistency->pairs && of.consistency->incompatible_pairs &&
            *of.consistency->incompatible_pairs > *of.consistency->pairs) {
            report_(at.pointer("consistency/incompatible_pairs"), std::to_string(*of.consistency->incompatible_pairs),
                    "not more than the " + std::to_string(*of.consistency->pairs) + " pairs");
        }
    }

    void check_points() const {
        for (std::size_t i = 0; i < comparison_.points.size(); ++i) {
            const ComparisonPoint& point = comparison_.points[i];
            const Element at{"points", i};
            if (point.correlation) {
                correlation(at.pointer("correlation"), *point.correlation);
            }
            if (is_between_laboratories_) {
                participant(at, "participant", point.participant);
                item(at, "item", point.item, point.round);
            }
        }
    }

    void check_vectors() const {
        for (std::size_t i = 0; i < comparison_.vectors.size(); ++i) {
            participant({"vectors", i}, "participant", comparison_.vectors[i].participant);
        }
    }

    void check_youden() const {
        for (std::size_t i = 0; i < comparison_.youden.size(); ++i) {
            const YoudenDiagram& diagram = comparison_.youden[i];
            const Element at{"youden", i};
            item(at, "first_item", diagram.first_item, diagram.round);
            item(at, "second_item", diagram.second_item, diagram.round);
            correlation(at.pointer("correlation"), diagram.correlation);
            for (std::size_t j = 0; j < diagram.points.size(); ++j) {
                participant(at, "points", j, "/participant", diagram.points[j].participant);
            }
        }
    }

    /// What shares a source are two participants, or the two methods.
    void check_shared_sources() const {
        const std::set<std::string> methods{comparison_.method_name, comparison_.reference_name};
        const std::set<std::string>& known = is_between_laboratories_ ? participants_ : methods;
        for (std::size_t i = 0; i < comparison_.shared_sources.size(); ++i) {
            const SharedSource& source = comparison_.shared_sources[i];
            const Element at{"shared_sources", i};
            for (const auto& [key, name] : {std::pair("first", &source.first), std::pair("second", &source.second)}) {
                if (!known.contains(*name)) {
                    report_(at.pointer(key), in_quotes(*name),
                            is_between_laboratories_ ? k_a_participant : "must be one of the two methods");
                }
            }
            correlation(at.pointer("correlation"), source.correlation.number);
        }
    }

    const Comparison& comparison_;
    bool is_between_laboratories_;
    const RecordBreach& report_;
    std::set<std::string> participants_;
    std::set<std::pair<std::string, std::string>> items_;  ///< item and round
};

}  // namespace

void check_comparison(const Comparison& comparison, const RecordBreach& report) {
    ComparisonCheck(comparison, report).check();
}

}  // namespace gumcert::reports
