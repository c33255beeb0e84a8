#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "jobs/comparison/comparison_reading.h"

namespace gumcert::jobs {

/// Reads who took part in a comparison between laboratories, what was compared, and what everybody reported.
class ParticipantsReader {
public:
    ParticipantsReader(const ComparisonReading& reading, const JsonObject& root) : reading_(reading), root_(root) {}

    /// Items, rounds, participants and results into the job.
    void read();

    [[nodiscard]] const LabelIndex& participants() const { return participants_; }
    [[nodiscard]] const LabelIndex& items() const { return items_.index; }
    /// False when something was refused that may have hidden a participant, an item or a result: what seems to be
    /// missing may then be there.
    [[nodiscard]] bool is_whole() const { return is_whole_; }
    /// The list of the file in which a result of the job stands.
    [[nodiscard]] ProblemList& problems_of(std::size_t result) const { return *problems_of_result_[result]; }

private:
    /// The place in the job that messages about one result name.
    struct Place {
        std::string where = {};  ///< unless it is a cell, whose text is made only where it is needed
        ProblemList* problems = nullptr;
        const CsvTable* table = nullptr;
        const CsvCell* cell = nullptr;

        [[nodiscard]] std::string text() const { return cell == nullptr ? where : table->where(*cell); }
    };
    /// The items, or the rounds: listed by the job, or as the results name them.
    struct Labels {
        const InputCode* code;
        std::string_view noun, which;  ///< for messages
        LabelIndex index = {};
        bool are_listed = false;
        std::optional<Place> without = {};  ///< the first result that states none, where they are not listed
    };
    /// What a result states of whose, of which item and in which round it is; positions in the job.
    struct Address {
        std::size_t participant = 0, item = 0, round = 0;
    };
    /// Columns of the table of results, in the order in which it is asked for them.
    enum Column : std::size_t {
        c_participant,
        c_value,
        c_item,
        c_round,
        c_u,
        c_U,
        c_k,
        c_nu,
        c_s,
        c_n,
        c_contributes,
        c_reason,
        c_bare,
        c_unit,
        c_name,
        c_group,
        c_cmc,
    };
    static constexpr std::array<std::string_view, 1> k_idle_columns{"name"};
    static constexpr UncertaintyColumns k_uncertainty_columns{
        .u = c_u, .U = c_U, .k = c_k, .nu = c_nu, .bare = c_bare, .idle = k_idle_columns};

    void read_items();
    void read_rounds();
    void read_participants();
    void read_participant(const JsonObject& object);
    void read_results();
    void read_table(const JsonObject& file_object, bool with_participants);
    void read_row(const CsvTable& table, std::size_t row, bool with_participants, ProblemList& problems);
    /// What a row states of the result itself.
    /// \return false for a missing result, a row without value
    bool read_cells(const CsvTable& table, std::size_t row, ComparisonResult& result, ProblemList& problems) const;
    [[nodiscard]] static std::optional<std::string_view> text_of(const CsvTable& table, std::size_t row, Column column);
    void read_result(const JsonObject& object, std::size_t participant);

    /// A participant by its id, a new one if the results name them.
    /// \return nothing when it was refused
    [[nodiscard]] std::optional<std::size_t> participant_of(std::string_view id, bool may_be_new, const Place& place);
    /// Position of a label; one that is new comes last.
    /// \return nothing when it was refused
    [[nodiscard]] std::optional<std::size_t> position_of(Labels& labels, const std::optional<std::string_view>& label,
                                                         const Place& place);
    [[nodiscard]] std::optional<std::size_t> item_of(const std::optional<std::string_view>& label, const Place& place);
    [[nodiscard]] std::optional<std::size_t> round_of(const std::optional<std::string_view>& label, const Place& place);
    /// Takes over what one row or entry says of a participant beside its result.
    void describe(std::size_t participant, const gum::ComparisonParticipant& stated, const Place& place);
    /// \return false when the participant has a result for this item and round already
    bool is_first(const Address& address, const Place& place);

    void read_budget(const JsonObject& object, ComparisonResult& result);
    void read_audited(const JsonObject& object, ComparisonResult& result);
    void add_missing(const Address& address, std::string reason, bool has_uncertainty, const Place& place);
    void refuse_mixed_labels();
    void ask_about_similar_ids();

    const ComparisonReading& reading_;
    const JsonObject& root_;
    gum::ComparisonItem defaults_;
    bool items_are_read_ = false;  ///< nothing of them was refused
    LabelIndex participants_;
    Labels items_{.code = &k_unknown_item, .noun = "item", .which = "of which item it is"};
    Labels rounds_{.code = &k_unknown_round, .noun = "round", .which = "in which round it is"};
    std::unordered_map<std::uint64_t, Place> first_;  ///< (participant, item, round) → place of the result
    std::vector<ProblemList*> problems_of_result_;
    bool is_whole_ = true;
};

/// Correlations of participants, groups, vectors and Youden pairs into the job.
void read_participant_correlations(const ComparisonReading& reading, const JsonObject& root,
                                   const ParticipantsReader& participants);
void read_vectors(const ComparisonReading& reading, const JsonObject& root, const ParticipantsReader& participants);
void read_youden(const ComparisonReading& reading, const JsonObject& root, const ParticipantsReader& participants);

/// What concerns all results of an item: enough of them, with what the assigned value needs.
void check_results(const ComparisonReading& reading, const ParticipantsReader& participants);

}  // namespace gumcert::jobs
