#include "jobs/statement_keys.h"
#include "text/visible_text.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace gumcert::jobs {

namespace {

using nlohmann::json;

/// A pointer to a value that something else owns.
std::shared_ptr<const json> borrowed(const json& value) {
    return {std::shared_ptr<const json>{}, &value};
}

}  // namespace

StatementKeys::StatementKeys(const JsonDocument& document, const std::string& pointer,
                             std::span<const std::string_view> keys, ProblemList& problems) {
    stands_at(document, pointer, problems);
    const json& object = document.value.at(json::json_pointer(pointer));
    for (const std::string_view key : keys) {
        if (const auto found = object.find(key); found != object.end()) {
            entries_.push_back({key, borrowed(*found), origin_, true});
        }
    }
}

void StatementKeys::stands_at(const JsonDocument& document, const std::string& pointer, ProblemList& problems) {
    origin_ = std::make_shared<const Origin>(Origin{&document, pointer, nullptr, {}, &problems, {}});
}

void StatementKeys::stands_at(const CsvTable& table, const CsvCell& cell, ProblemList& problems,
                              const std::string& column) {
    origin_ = std::make_shared<const Origin>(Origin{nullptr, {}, &table, cell, &problems, column});
}

StatementKeys StatementKeys::with(const StatementKeys& other) const {
    StatementKeys both = *this;
    both.origin_ = other.origin_;
    for (const Entry& entry : other.entries_) {
        both.put(entry);
    }
    return both;
}

StatementKeys StatementKeys::with(std::string_view key, double number, const JsonDocument& document,
                                  const std::string& pointer, ProblemList& problems) const {
    StatementKeys both = *this;
    both.stands_at(document, pointer, problems);
    both.put({key, std::make_shared<const json>(number), both.origin_, false});
    return both;
}

StatementKeys StatementKeys::with(std::string_view key, double number, const CsvTable& table, const CsvCell& cell,
                                  ProblemList& problems, const std::string& column) const {
    StatementKeys both = *this;
    both.stands_at(table, cell, problems, column);
    both.put({key, std::make_shared<const json>(number), both.origin_, false});
    return both;
}

StatementKeys StatementKeys::with(std::string_view key, const std::vector<double>& numbers, int decimals,
                                  const CsvTable& table, const CsvCell& cell, ProblemList& problems,
                                  const std::string& column) const {
    StatementKeys both = *this;
    both.stands_at(table, cell, problems, column);
    both.put({key, std::make_shared<const json>(numbers), both.origin_, false, decimals});
    return both;
}

StatementKeys StatementKeys::without(std::span<const std::string_view> keys) const {
    StatementKeys rest = *this;
    std::erase_if(rest.entries_,
                  [&](const Entry& entry) { return std::find(keys.begin(), keys.end(), entry.key) != keys.end(); });
    return rest;
}

void StatementKeys::put(Entry entry) {
    const auto same =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& known) { return known.key == entry.key; });
    if (same == entries_.end()) {
        entries_.push_back(std::move(entry));
    } else {
        *same = std::move(entry);
    }
}

const StatementKeys::Entry* StatementKeys::find(std::string_view key) const {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
    return found == entries_.end() ? nullptr : &*found;
}

const json* StatementKeys::value(std::string_view key) const {
    const Entry* entry = find(key);
    return entry == nullptr || entry->value->is_discarded() ? nullptr : entry->value.get();
}

std::vector<std::string_view> StatementKeys::present() const {
    std::vector<std::string_view> keys;
    for (const Entry& entry : entries_) {
        keys.push_back(entry.key);
    }
    return keys;
}

std::string StatementKeys::where_of(const Entry& entry) {
    const Origin& origin = *entry.origin;
    if (origin.table != nullptr) {
        return origin.table->where(origin.cell);
    }
    return origin.document->where(entry.is_member ? child_pointer(origin.pointer, entry.key) : origin.pointer);
}

std::string StatementKeys::group_of(const Origin& origin, std::string_view key) {
    if (origin.table != nullptr) {
        return "column " + origin.column;
    }
    constexpr std::string_view k_points = "/points/";
    if (!origin.pointer.starts_with(k_points)) {
        return {};
    }
    const std::size_t input = origin.pointer.find('/', k_points.size());
    return "points" + (input == std::string::npos ? std::string{} : origin.pointer.substr(input)) + "/" +
           std::string{key};
}

std::string StatementKeys::where() const {
    return origin_->table != nullptr ? origin_->table->where(origin_->cell)
                                     : origin_->document->where(origin_->pointer);
}

std::string StatementKeys::where(std::string_view key) const {
    const Entry* entry = find(key);
    return entry == nullptr ? where() : where_of(*entry);
}

std::string StatementKeys::pointer(std::string_view key) const {
    const Entry* entry = find(key);
    return entry->is_member ? child_pointer(entry->origin->pointer, key) : entry->origin->pointer;
}

ProblemList& StatementKeys::problems(std::string_view key) const {
    const Entry* entry = find(key);
    return entry == nullptr ? *origin_->problems : *entry->origin->problems;
}

void StatementKeys::refuse(const InputCode& code, std::string_view key, std::string what, std::string rule,
                           std::string action) const {
    const Entry* entry = find(key);
    problems(key).refuse(code, where(key), std::move(what), std::move(rule), std::move(action),
                         group_of(entry == nullptr ? *origin_ : *entry->origin, key));
}

void StatementKeys::refuse(const InputCode& code, std::string what, std::string rule, std::string action) const {
    origin_->problems->refuse(code, where(), std::move(what), std::move(rule), std::move(action),
                              group_of(*origin_, {}));
}

void StatementKeys::warn(const InputCode& code, std::string_view key, std::string what, std::string rule,
                         std::string action) const {
    const Entry* entry = find(key);
    problems(key).warn(code, where(key), std::move(what), std::move(rule), std::move(action),
                       group_of(entry == nullptr ? *origin_ : *entry->origin, key));
}

void StatementKeys::refuse_type(const Entry& entry, std::string_view expected) const {
    entry.origin->problems->refuse(k_wrong_type, where_of(entry), described(*entry.value),
                                   "must be " + std::string{expected},
                                   entry.value->is_string() && expected.find("number") != std::string_view::npos
                                       ? advice_for_number(entry.value->get_ref<const std::string&>())
                                       : "correct the value",
                                   group_of(*entry.origin, entry.key));
}

std::optional<double> StatementKeys::number(std::string_view key, const NumberRange& range) const {
    const json* found = value(key);
    if (found == nullptr) {
        return std::nullopt;
    }
    if (!found->is_number()) {
        refuse_type(*find(key), "a number");
        return std::nullopt;
    }
    const double number = found->get<double>();
    if (!range.contains(number)) {
        refuse(find(key)->origin->table == nullptr ? k_number_out_of_range : k_csv_out_of_range, key,
               std::string{key} + " is " + range.with_unit(number), range.rule(), range.action());
        return std::nullopt;
    }
    return number;
}

std::optional<std::string> StatementKeys::text(std::string_view key) const {
    const json* found = value(key);
    if (found == nullptr) {
        return std::nullopt;
    }
    if (!found->is_string()) {
        refuse_type(*find(key), "a string");
        return std::nullopt;
    }
    return found->get<std::string>();
}

std::optional<std::string> StatementKeys::name(std::string_view key) const {
    std::optional<std::string> found = text(key);
    if (const auto objection = found ? name_objection(*found) : std::nullopt) {
        refuse(k_text_not_allowed, key, text::in_quotes(*found) + " " + *objection,
               "must be one line of at most 256 bytes, without spaces around it and without control or hidden "
               "characters",
               "correct the text");
        return std::nullopt;
    }
    return found;
}

std::optional<bool> StatementKeys::boolean(std::string_view key) const {
    const json* found = value(key);
    if (found == nullptr) {
        return std::nullopt;
    }
    if (!found->is_boolean()) {
        refuse_type(*find(key), "true or false");
        return std::nullopt;
    }
    return found->get<bool>();
}

std::optional<double> StatementKeys::degrees_of_freedom(std::string_view key) const {
    const json* found = value(key);
    if (found != nullptr && found->is_string()) {
        if (found->get_ref<const std::string&>() == "inf") {
            return std::numeric_limits<double>::infinity();
        }
        refuse_type(*find(key), "a number or \"inf\"");
        return std::nullopt;
    }
    NumberRange range = above_zero("");
    range.hint = "state the degrees of freedom, or \"inf\"";
    return number(key, range);
}

std::optional<std::vector<double>> StatementKeys::numbers(std::string_view key) const {
    const json* elements = array(key);
    if (elements == nullptr) {
        return std::nullopt;
    }
    std::vector<double> numbers;
    numbers.reserve(elements->size());
    for (const json& element : *elements) {
        if (element.is_number()) {
            numbers.push_back(element.get<double>());
        } else if (!element.is_discarded()) {
            const Entry& entry = *find(key);
            const auto index = static_cast<std::size_t>(&element - &elements->front());
            entry.origin->problems->refuse(
                k_wrong_type, entry.origin->document->where(child_pointer(pointer(key), index)), described(element),
                "must be a number",
                element.is_string() ? advice_for_number(element.get_ref<const std::string&>()) : "correct the value");
        }
    }
    return numbers.size() == elements->size() ? std::optional{std::move(numbers)} : std::nullopt;
}

int StatementKeys::decimals_as_written(std::string_view key) const {
    const Entry* entry = find(key);
    if (entry == nullptr) {
        return 0;
    }
    return entry->origin->document == nullptr ? entry->decimals : document(key).decimals_as_written(pointer(key));
}

const json* StatementKeys::array(std::string_view key) const {
    const json* found = value(key);
    if (found != nullptr && !found->is_array()) {
        refuse_type(*find(key), "an array");
        return nullptr;
    }
    return found;
}

std::optional<JsonObject> StatementKeys::object(std::string_view key, std::span<const std::string_view> keys) const {
    const json* found = value(key);
    if (found == nullptr) {
        return std::nullopt;
    }
    if (!found->is_object()) {
        refuse_type(*find(key), "an object");
        return std::nullopt;
    }
    return JsonObject(document(key), pointer(key), keys, *find(key)->origin->problems);
}

}  // namespace gumcert::jobs
