#include "jobs/comparison/comparison_participants.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "jobs/comparison/comparison_items.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_limits.h"
#include "jobs/job_reader.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 2> k_required_columns{"participant", "value"};
// In the order of ParticipantsReader::Column.
constexpr std::array<std::string_view, 15> k_optional_columns{"item",        "round", "u",    "U",           "k",
                                                              "nu",          "s",     "n",    "contributes", "reason",
                                                              "uncertainty", "unit",  "name", "group",       "cmc_U"};
constexpr std::size_t k_participant_columns = 3;  // the last ones
constexpr const char* k_what_a_reason_tells =
    "a reason tells why a result is outside of the assigned value, or why it is missing";

/// One number of a place in the table of results; a job has fewer than 2²¹ of each.
std::uint64_t key_of(std::size_t participant, std::size_t item, std::size_t round) {
    return (static_cast<std::uint64_t>(participant) << 42U) | (static_cast<std::uint64_t>(item) << 21U) |
           static_cast<std::uint64_t>(round);
}

bool are_too_many(std::size_t results, const std::string& where, ProblemList& problems) {
    if (results <= k_most_compared_results) {
        return false;
    }
    problems.refuse(k_too_many_results, where, text::count_of(results, "result"),
                    "a comparison has at most " + std::to_string(k_most_compared_results) + " results",
                    "split the data by items or rounds into several jobs");
    return true;
}

/// An id as it is whatever its capitals and separators. Those between digits tell numbers apart: "1-11" is not "11-1".
std::string spelling_apart(std::string_view id) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    std::string form;
    bool is_separated = false;
    for (const char c : text::in_small_letters(id)) {
        if (std::string_view(" -_.").find(c) != std::string_view::npos) {
            is_separated = true;
            continue;
        }
        if (is_separated && !form.empty() && is_digit(form.back()) && is_digit(c)) {
            form += ' ';
        }
        is_separated = false;
        form += c;
    }
    return form;
}

}  // namespace

void ParticipantsReader::read() {
    reading_.job.rounds.clear();  // also tables of results name them
    std::size_t refused = reading_.problems.refusals();
    read_items();
    items_are_read_ = reading_.problems.refusals() == refused;
    read_rounds();
    refused = reading_.problems.refusals();
    read_participants();
    read_results();
    refuse_mixed_labels();
    ask_about_similar_ids();
    is_whole_ = is_whole_ && reading_.problems.refusals() == refused;
    ComparisonJob& job = reading_.job;
    if (job.items.empty()) {
        job.items.push_back(defaults_);
    }
    if (job.rounds.empty()) {
        job.rounds.emplace_back();
    }
}

// ---- lists ----------------------------------------------------------------------------------------------------------

void ParticipantsReader::read_items() {
    read_item_keys(reading_, root_, defaults_);
    items_.are_listed = root_.has("items");
    const json* array = root_.optional_array("items");
    if (array == nullptr) {
        return;
    }
    if (array->empty()) {
        root_.refuse(k_wrong_size, "items", "an empty list of items", "there must be at least one",
                     "list the items, or leave the key out when there is one");
    }
    jobs::read_items(reading_, *array, defaults_, items_.index);
    is_whole_ = is_whole_ && reading_.job.items.size() == array->size();
}

void ParticipantsReader::read_rounds() {
    rounds_.are_listed = root_.has("rounds");
    if (!rounds_.are_listed) {
        return;
    }
    for (std::string& round : read_texts(reading_, root_, "rounds")) {
        if (!rounds_.index.add(round).second) {
            root_.refuse(k_repeated_id, "rounds", "the round " + text::in_quotes(round) + " occurs twice",
                         "a round is listed once", "remove one of the two");
            continue;
        }
        reading_.job.rounds.push_back(std::move(round));
    }
    if (const json* array = root_.find("rounds"); array != nullptr && array->is_array() && array->empty()) {
        root_.refuse(k_wrong_size, "rounds", "an empty list of rounds", "there must be at least one",
                     "list the rounds, or leave the key out");
    }
}

void ParticipantsReader::read_participants() {
    if (!root_.require("participants")) {
        return;
    }
    const json* value = root_.find("participants");
    if (value == nullptr) {
        return;
    }
    if (value->is_object()) {
        if (root_.has("results")) {
            root_.refuse(k_comparison_form, "results", "\"results\" beside a file of participants with their results",
                         "results stand with the participants, or on their own",
                         "list the participants in the job, or remove \"results\"");
            return;
        }
        if (const auto file = root_.optional_object("participants", k_file_object_keys)) {
            read_table(*file, true);
        }
        return;
    }
    if (!value->is_array()) {
        root_.refuse(k_wrong_type, "participants", described(*value),
                     "must be an array of participants or {\"file\": \"results.csv\"}", "correct the value");
        return;
    }
    const bool with_results = !root_.has("results");
    if (are_too_many(value->size(), root_.where("participants"), reading_.problems)) {
        return;
    }
    using Keys = std::span<const std::string_view>;
    for_each_object(reading_, *value, "/participants",
                    with_results ? keys_of<ParticipantStatement>() : keys_of<gum::ComparisonParticipant>(),
                    with_results ? keys_and_bare_of<ParticipantStatement>() : Keys{},
                    [&](const JsonObject& object) { read_participant(object); });
}

void ParticipantsReader::read_participant(const JsonObject& object) {
    const bool with_results = !root_.has("results");
    const Place place{object.where(), &reading_.problems};
    gum::ComparisonParticipant stated;
    JobReader reader(object);
    reader.read(stated);
    if (!reader.accepted("id")) {
        return;
    }
    if (!with_results && participants_.find(stated.id)) {
        object.refuse(k_repeated_id, "id", "the participant " + text::in_quotes(stated.id) + " occurs twice",
                      "a participant is listed once where the results stand on their own",
                      "correct the id, or remove one of the two");
        return;
    }
    const auto participant = participant_of(stated.id, true, place);
    if (participant) {
        describe(*participant, stated, place);
        if (with_results) {
            read_result(object, *participant);
        }
    }
}

void ParticipantsReader::read_results() {
    const json* value = root_.has("results") ? root_.find("results") : nullptr;
    if (value == nullptr) {
        return;
    }
    const json* participants = root_.find("participants");
    if (participants == nullptr || !participants->is_array()) {
        return;  // reported with the participants
    }
    if (value->is_object()) {
        if (const auto file = root_.optional_object("results", k_file_object_keys)) {
            read_table(*file, false);
        }
        return;
    }
    if (!value->is_array()) {
        root_.refuse(k_wrong_type, "results", described(*value),
                     "must be an array of results or {\"file\": \"results.csv\"}", "correct the value");
        return;
    }
    if (are_too_many(value->size(), root_.where("results"), reading_.problems)) {
        return;
    }
    for_each_object(reading_, *value, "/results", keys_of<ListedResult>(), keys_and_bare_of<ListedResult>(),
                    [&](const JsonObject& object) {
                        ListedResult stated;
                        JobReader reader(object);
                        reader.read(stated, {"participant"});
                        const auto participant = reader.accepted("participant")
                                                     ? participant_of(stated.participant, false,
                                                                      {object.where("participant"), &reading_.problems})
                                                     : std::nullopt;
                        if (participant) {
                            read_result(object, *participant);
                        }
                    });
}

// ---- whose, of which item, in which round ---------------------------------------------------------------------------

std::optional<std::size_t> ParticipantsReader::participant_of(std::string_view id, bool may_be_new,
                                                              const Place& place) {
    if (const auto found = participants_.find(id)) {
        return found;
    }
    if (!may_be_new) {
        place.problems->refuse(k_unknown_participant, place.text(),
                               "the participant " + text::in_quotes(id) + " is none of \"participants\"",
                               "results are those of participants of the job",
                               participants_.advice(id, "correct the id, or add the participant"));
        is_whole_ = false;
        return std::nullopt;
    }
    const std::size_t position = participants_.add(id).first;
    gum::ComparisonParticipant& participant = reading_.job.participants.emplace_back();
    participant.id = std::string(id);
    participant.name = participant.id;
    return position;
}

void ParticipantsReader::describe(std::size_t participant, const gum::ComparisonParticipant& stated,
                                  const Place& place) {
    gum::ComparisonParticipant& known = reading_.job.participants[participant];
    const auto take = [&](std::string& text, const std::string& other, std::string_view key, bool is_open) {
        if (other.empty() || text == other) {
            return;
        }
        if (is_open) {
            text = other;
            return;
        }
        place.problems->refuse(k_participant_differs, place.text(),
                               "the " + std::string(key) + " of " + text::in_quotes(known.id) + " is " +
                                   text::in_quotes(other) + ", and before it was " + text::in_quotes(text),
                               "a participant is one laboratory in all its results",
                               "state it once, or the same everywhere");
    };
    take(known.name, stated.name, "name", known.name == known.id);
    take(known.group, stated.group, "group", known.group.empty());
    if (stated.cmc_U && known.cmc_U && *known.cmc_U != *stated.cmc_U) {
        place.problems->refuse(k_participant_differs, place.text(),
                               "cmc_U of " + text::in_quotes(known.id) + " is " + text::shortest_plain(*stated.cmc_U) +
                                   ", and before it was " + text::shortest_plain(*known.cmc_U),
                               "a participant has one cmc_U", "state it once, or the same everywhere");
    } else if (stated.cmc_U) {
        known.cmc_U = stated.cmc_U;
    }
}

std::optional<std::size_t> ParticipantsReader::position_of(Labels& labels, const std::optional<std::string_view>& label,
                                                           const Place& place) {
    if (!labels.are_listed) {
        if (!label && !labels.without) {
            labels.without = Place{place.text(), place.problems};
        }
        return labels.index.add(label.value_or(std::string_view{})).first;
    }
    const std::string noun(labels.noun);
    if (label) {
        const auto found = labels.index.find(*label);
        if (!found) {
            place.problems->refuse(*labels.code, place.text(),
                                   "the " + noun + " " + text::in_quotes(*label) + " is none of \"" + noun + "s\"",
                                   "results are those of " + noun + "s of the job",
                                   labels.index.advice(*label, "correct the " + noun + ", or add it to the list"));
            is_whole_ = false;
        }
        return found;
    }
    if (labels.index.size() == 1) {
        return 0;
    }
    if (labels.index.size() > 1) {
        place.problems->refuse(*labels.code, place.text(), "the result does not say " + std::string(labels.which),
                               "a job with several " + noun + "s has results with " + text::in_quotes(noun),
                               "add the " + noun);
    }
    is_whole_ = false;
    return std::nullopt;
}

std::optional<std::size_t> ParticipantsReader::item_of(const std::optional<std::string_view>& label,
                                                       const Place& place) {
    std::vector<gum::ComparisonItem>& items = reading_.job.items;
    const auto position = position_of(items_, label, place);
    if (position && *position == items.size()) {
        gum::ComparisonItem& item = items.emplace_back(defaults_);
        item.id = std::string(label.value_or(std::string_view{}));
        item.name = item.id;
    }
    return position;
}

std::optional<std::size_t> ParticipantsReader::round_of(const std::optional<std::string_view>& label,
                                                        const Place& place) {
    std::vector<std::string>& rounds = reading_.job.rounds;
    const auto position = position_of(rounds_, label, place);
    if (position && *position == rounds.size()) {
        rounds.emplace_back(label.value_or(std::string_view{}));
    }
    return position;
}

void ParticipantsReader::refuse_mixed_labels() {
    for (const Labels* labels : {&items_, &rounds_}) {
        if (labels->without && labels->index.size() > 1) {
            const std::string noun(labels->noun);
            labels->without->problems->refuse(
                *labels->code, labels->without->text(),
                "the result does not say " + std::string(labels->which) + ", and others do",
                "all results state the " + noun + ", or none does", "add the " + noun);
            is_whole_ = false;
        }
    }
}

void ParticipantsReader::ask_about_similar_ids() {
    // One laboratory under two ids would count twice, and be missing where the other id reports.
    std::map<std::string, std::string_view> known;
    for (const gum::ComparisonParticipant& participant : reading_.job.participants) {
        const auto [first, is_new] = known.try_emplace(spelling_apart(participant.id), participant.id);
        if (!is_new) {
            reading_.problems.warn(k_warn_similar_participants, root_.where("participants"),
                                   "the participants " + text::in_quotes(first->second) + " and " +
                                       text::in_quotes(participant.id) + " are taken for two laboratories",
                                   "ids are compared letter by letter", "use one id where they are one laboratory");
        }
    }
}

bool ParticipantsReader::is_first(const Address& address, const Place& place) {
    const auto [entry, is_new] = first_.try_emplace(key_of(address.participant, address.item, address.round), place);
    if (is_new) {
        return true;
    }
    const ComparisonJob& job = reading_.job;
    const std::string& item = job.items[address.item].id;
    const std::string& round = job.rounds[address.round];
    place.problems->refuse(k_repeated_result, place.text(),
                           "the participant " + text::in_quotes(job.participants[address.participant].id) +
                               " has a second result" + (item.empty() ? "" : " for the item " + text::in_quotes(item)) +
                               (round.empty() ? "" : " in the round " + text::in_quotes(round)) +
                               ", the first one is at " + entry->second.text(),
                           "a participant has one result for each item and round",
                           "remove one of the two, or tell them apart by \"item\" or \"round\"");
    return false;
}

// ---- results in a table ---------------------------------------------------------------------------------------------

void ParticipantsReader::read_table(const JsonObject& file_object, bool with_participants) {
    const auto name = JobFiles::file_name(file_object, "file", true);
    auto file = name ? reading_.files.open(*name) : std::nullopt;
    if (!file) {
        is_whole_ = false;
        return;
    }
    ProblemList& problems = *file->problems;
    const std::span<const std::string_view> optional{k_optional_columns};
    const auto table =
        read_csv_table(std::move(file->bytes), k_required_columns,
                       optional.first(optional.size() - (with_participants ? 0 : k_participant_columns)), problems);
    if (!table || !check_uncertainty_columns(*table, k_uncertainty_columns, problems) ||
        are_too_many(table->rows(), text::visible(problems.file()), problems)) {
        is_whole_ = false;
        return;
    }
    reading_.job.results.reserve(table->rows());
    problems_of_result_.reserve(table->rows());
    first_.reserve(table->rows());
    for (std::size_t row = 0; row < table->rows(); ++row) {
        read_row(*table, row, with_participants, problems);
    }
    first_.clear();  // its places are those of cells of this table
    is_whole_ = is_whole_ && problems.refusals() == 0;
}

void ParticipantsReader::read_row(const CsvTable& table, std::size_t row, bool with_participants,
                                  ProblemList& problems) {
    const auto place_of = [&](Column column) {
        return Place{{}, &problems, &table, &table.cell(row, table.has_column(column) ? column : c_value)};
    };
    const Place place = place_of(c_value);
    const auto id = table.name(row, c_participant);
    std::optional<std::size_t> participant = {};
    if (id) {
        participant = participant_of(*id, with_participants, place_of(c_participant));
    }
    if (participant && with_participants) {
        gum::ComparisonParticipant stated;
        stated.name = std::string(text_of(table, row, c_name).value_or(""));
        stated.group = std::string(text_of(table, row, c_group).value_or(""));
        stated.cmc_U = table.number_if_any(row, c_cmc, k_compared_uncertainty);
        describe(*participant, stated, place_of(c_participant));
    }
    const auto item = item_of(text_of(table, row, c_item), place_of(c_item));
    const auto round = round_of(text_of(table, row, c_round), place_of(c_round));
    if (item && items_are_read_ && is_stated(table, row, c_value)) {  // a missing result is in no unit
        const gum::ComparisonItem& stated = reading_.job.items[*item];
        check_unit_of_row(table, row, c_unit, stated.unit,
                          stated.id.empty() ? "the comparison" : "the item " + text::in_quotes(stated.id), problems);
    }
    ComparisonResult result;
    result.where = place.text();
    const bool is_missing = !read_cells(table, row, result, problems);
    const Address address{participant.value_or(0), item.value_or(0), round.value_or(0)};
    if (!participant || !item || !round || !is_first(address, place)) {
        return;
    }
    if (is_missing) {
        add_missing(address, std::move(result.reason), result.uncertainty.has_value(), place);
        return;
    }
    result.participant = address.participant;
    result.item = address.item;
    result.round = address.round;
    reading_.job.results.push_back(std::move(result));
    problems_of_result_.push_back(&problems);
}

std::optional<std::string_view> ParticipantsReader::text_of(const CsvTable& table, std::size_t row, Column column) {
    return is_stated(table, row, column) ? table.name(row, column) : std::nullopt;
}

bool ParticipantsReader::read_cells(const CsvTable& table, std::size_t row, ComparisonResult& result,
                                    ProblemList& problems) const {
    static constexpr std::array<std::string_view, 4> k_words{"true", "yes", "false", "no"};
    result.uncertainty =
        read_uncertainty(table, row, k_uncertainty_columns, reading_.job.coverage_probability, problems);
    result.standard_deviation = table.number_if_any(row, c_s, k_deviation);
    const bool states_n = is_stated(table, row, c_n);
    const bool states_s = is_stated(table, row, c_s);
    if (states_n) {
        result.observations = static_cast<std::size_t>(table.integer(row, c_n, k_observations).value_or(0));
    }
    if (is_stated(table, row, c_contributes)) {
        result.contributes = table.choice(row, c_contributes, k_words).value_or(0) < 2;
    }
    result.reason = std::string(text_of(table, row, c_reason).value_or(""));
    if (!is_stated(table, row, c_value)) {
        return false;
    }
    result.value = read_value(table, row, c_value, "leave the cell empty: a missing result", problems).value_or(0.0);
    if (!result.contributes && result.reason.empty()) {
        problems.refuse(k_no_reason, table.where(table.cell(row, c_contributes)),
                        "the result does not contribute, without a reason",
                        "who is left out of an assigned value is told with the reason",
                        "write the reason into a column \"reason\"");
    }
    if (!result.reason.empty() && !is_stated(table, row, c_contributes)) {
        problems.refuse(
            k_reason_of_nothing, table.where(table.cell(row, c_reason)),
            "the reason " + text::in_quotes(result.reason) + " beside a value, without a word in \"contributes\"",
            k_what_a_reason_tells,
            "write \"no\" into a column \"contributes\", or \"yes\" where it is no such reason: the value is scored "
            "either way; of a result that was withdrawn leave the value empty");
    }
    if (states_s != states_n) {
        problems.refuse(k_result_without_replicates, table.where(table.cell(row, states_s ? c_s : c_n)),
                        states_s ? "s without n" : "n without s",
                        "the standard deviation of single observations is stated with their number",
                        "state both, or none");
    }
    return true;
}

void ParticipantsReader::add_missing(const Address& address, std::string reason, bool has_uncertainty,
                                     const Place& place) {
    if (has_uncertainty) {
        place.problems->warn(k_warn_uncertainty_without_value, place.text(), "an uncertainty without a value",
                             "a result without value is a missing result", "add the value, or remove the uncertainty");
    }
    reading_.job.missing.push_back({address.participant, address.item, address.round, std::move(reason)});
}

// ---- results in the job ---------------------------------------------------------------------------------------------

void ParticipantsReader::read_result(const JsonObject& object, std::size_t participant) {
    ResultStatement stated;
    ComparisonResult& result = stated.result;
    result.where = object.where();
    JobReader reader(object);
    reader.read(stated, {"item", "round"});
    const auto label = [&](std::string_view key, const std::string& text) {
        return object.has(key) ? std::optional<std::string_view>{text} : std::nullopt;
    };
    const auto item = object.has("item") && !reader.accepted("item")
                          ? std::nullopt
                          : item_of(label("item", stated.item), {object.where("item"), &reading_.problems});
    const auto round = object.has("round") && !reader.accepted("round")
                           ? std::nullopt
                           : round_of(label("round", stated.round), {object.where("round"), &reading_.problems});
    result.participant = participant;
    result.item = item.value_or(0);
    result.round = round.value_or(0);
    result.uncertainty = read_uncertainty(reading_, object);
    reader.read(stated, {"contributes", "reason"});
    const json* value = object.find("value");
    const bool is_null = value != nullptr && value->is_null();
    const bool is_missing = !object.has("budget") && (!object.has("value") || is_null);
    if (!is_null) {
        result.value = read_value(reading_, object, "write null: a missing result").value_or(0.0);
    }
    reader.read(stated, {"s", "n"});
    if (object.has("s") != object.has("n")) {
        object.refuse(k_result_without_replicates, object.has("s") ? "s" : "n",
                      object.has("s") ? "\"s\" without \"n\"" : "\"n\" without \"s\"",
                      "the standard deviation of single observations is stated with their number",
                      "state both, or none");
    }
    read_audited(object, result);
    if (object.has("budget")) {
        if (const json& file = *object.find("budget"); file.is_string()) {
            reading_.job.participant_budgets.push_back({participant, file.get<std::string>()});
        }
        if (item) {
            read_budget(object, result);
        }
    } else {
        result.sources =
            read_sources(reading_, object, result.uncertainty ? std::optional{result.uncertainty->u} : std::nullopt);
        if (!result.sources.empty() && !result.uncertainty && !object.has("u") && !object.has("U")) {
            object.refuse(k_parts_exceed_uncertainty, "sources", "parts of an uncertainty that is not stated",
                          "the parts belong to the uncertainty of the result", "add \"u\", or \"U\" and \"k\"");
        }
    }
    if (object.has("reason") && !object.has("contributes") && !is_missing) {
        object.refuse(k_reason_of_nothing, "reason", "a reason beside a value, without \"contributes\"",
                      k_what_a_reason_tells,
                      "add \"contributes\": false, or true where it is no such reason: the value is scored either way; "
                      "of a result that was withdrawn leave the value out");
    }
    if (!result.contributes && !object.has("reason") && !is_missing) {
        object.refuse(k_no_reason, "contributes", "the result does not contribute, without a reason",
                      "who is left out of an assigned value is told with the reason", "add \"reason\"");
    }
    const Place place{result.where, &reading_.problems};
    const Address address{participant, result.item, result.round};
    if (!item || !round || !is_first(address, place)) {
        return;
    }
    if (is_missing) {
        add_missing(address, std::move(result.reason), result.uncertainty.has_value(), place);
        return;
    }
    reading_.job.results.push_back(std::move(result));
    problems_of_result_.push_back(&reading_.problems);
}

void ParticipantsReader::read_audited(const JsonObject& object, ComparisonResult& result) {
    const auto audited = object.optional_object("audited", keys_of<gum::AuditedUncertainty>());
    if (!audited) {
        return;
    }
    gum::AuditedUncertainty stated;
    JobReader reader(*audited);
    reader.read(stated);
    const auto uncertainty = read_uncertainty(reading_, *audited);
    if (!states_uncertainty(*audited)) {
        audited->refuse(k_bare_uncertainty, "", "an audit finding without the corrected uncertainty",
                        "E_n is formed again with the corrected uncertainty", "add \"u\", or \"U\" and \"k\"");
    }
    if (reader.accepted("finding") && uncertainty) {
        stated.uncertainty = *uncertainty;
        result.audited = std::move(stated);
    }
}

void ParticipantsReader::read_budget(const JsonObject& object, ComparisonResult& result) {
    for (const std::string_view key : {"value", "u", "U", "k", "nu", "sources"}) {
        if (object.has(key)) {
            object.refuse(k_stated_beside_budget, key, text::in_quotes(key) + " beside a budget",
                          "value, uncertainty and sources are those of the budget", "remove the key, or the budget");
        }
    }
    const auto name = JobFiles::file_name(object, "budget", true);
    result.budget = name ? reading_.budgets.read(*name) : nullptr;
    if (!result.budget) {
        is_whole_ = false;
        return;
    }
    result.budget_file = *name;
    result.uncertainty.reset();
    if (result.budget->points.size() > 1) {
        object.refuse(k_comparison_budget, "budget",
                      "the budget has " + text::count_of(result.budget->points.size(), "point"),
                      "a result is one value: its budget has no points, or one",
                      "write a budget of this result alone, or compare methods point by point");
        return;
    }
    if (items_are_read_) {  // else the unit may be the one that was refused
        refuse_other_results(*result.budget, reading_.job.items[result.item].unit, object.where("budget"),
                             reading_.problems);
    }
}

}  // namespace gumcert::jobs
