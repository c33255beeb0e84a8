#include "jobs/json_object.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/place.h"
#include "text/visible_text.h"

#include <algorithm>
#include <cassert>

namespace gumcert::jobs {

namespace {

/// The code of a fault of the text.
const InputCode& code_of(gumcert::json::Fault fault) {
    switch (fault) {
        case gumcert::json::Fault::empty:
            return k_empty_file;
        case gumcert::json::Fault::syntax:
            break;
        case gumcert::json::Fault::trailing_text:
            return k_json_trailing_text;
        case gumcert::json::Fault::comment:
            return k_json_comment;
        case gumcert::json::Fault::not_utf8:
            return k_not_utf8;
        case gumcert::json::Fault::nul_character:
            return k_nul_character;
        case gumcert::json::Fault::depth:
            return k_json_depth;
        case gumcert::json::Fault::string_too_long:
            return k_json_string_too_long;
        case gumcert::json::Fault::too_many_values:
            return k_json_too_many_values;
        case gumcert::json::Fault::duplicate_key:
            return k_json_duplicate_key;
        case gumcert::json::Fault::number_range:
            return k_json_number_range;
        case gumcert::json::Fault::inexact_integer:
            return k_json_inexact_integer;
        case gumcert::json::Fault::not_finite:
            return k_json_not_finite;
    }
    return k_json_syntax;
}

std::string where_of(const gumcert::json::ParsingProblem& problem, const std::string& file) {
    if (problem.fault == gumcert::json::Fault::empty) {
        return text::visible(file);
    }
    if (problem.fault == gumcert::json::Fault::duplicate_key) {
        return text::visible(file) + "#" + text::visible(problem.pointer) + " (" +
               text::line_and_column(problem.place) + ")";
    }
    return text::where_in_text(file, problem.place);
}

/// What the author of a job can do about it.
std::string action_of(const gumcert::json::ParsingProblem& problem) {
    return problem.fault == gumcert::json::Fault::depth             ? "check that the file is a job"
           : problem.fault == gumcert::json::Fault::too_many_values ? "move tables of numbers to CSV files"
                                                                    : problem.action;
}

}  // namespace

std::optional<JsonDocument> read_json_document(std::string_view bytes, ProblemList& problems) {
    const std::optional<std::string_view> text = check_text(bytes, problems);
    if (!text) {
        return std::nullopt;
    }
    JsonDocument document{problems.file(), {}, {}, std::string{*text}};
    std::optional<nlohmann::json> value = json::parse(
        *text, {.comments = true},
        [&](const gumcert::json::ParsingProblem& problem) {
            problems.refuse(code_of(problem.fault), where_of(problem, problems.file()), problem.what, problem.rule,
                            action_of(problem));
        },
        &document.places);
    if (!value) {
        return std::nullopt;
    }
    document.value = std::move(*value);
    return document;
}

JsonDocument parse_json_document(std::string_view bytes, const std::string& file) {
    ProblemList problems(file);
    std::optional<JsonDocument> document = read_json_document(bytes, problems);
    if (problems.refusals() > 0) {
        throw gum::InputError(problems.refused());
    }
    return std::move(*document);
}

std::optional<std::string> label_of(const nlohmann::json& value, const std::string& where, ProblemList& problems) {
    if (value.is_discarded()) {
        return std::nullopt;
    }
    if (value.is_number()) {
        return text::shortest_plain(value.get<double>());
    }
    if (!value.is_string()) {
        problems.refuse(k_wrong_type, where, described(value), "must be a text or a number", "correct the value");
        return std::nullopt;
    }
    const auto& text = value.get_ref<const std::string&>();
    if (const auto objection = name_objection(text)) {
        problems.refuse(k_text_not_allowed, where, text::in_quotes(text) + " " + *objection,
                        "must be one line of at most 256 bytes, without spaces around it and without control or "
                        "hidden characters",
                        "correct the text");
        return std::nullopt;
    }
    return text;
}

JsonObject::JsonObject(const JsonDocument& document, std::string pointer, std::span<const std::string_view> keys,
                       ProblemList& problems)
    : document_(&document),
      pointer_(std::move(pointer)),
      object_(&document.value.at(nlohmann::json::json_pointer(pointer_))),
      keys_(keys),
      problems_(&problems) {
    assert(object_->is_object());
    for (const auto& [key, value] : object_->items()) {
        if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) {
            continue;
        }
        if (key == "sections" && pointer_.empty() && object_->contains("kind")) {
            refuse(
                k_sections_of_other_kind, key, "sections in a job of kind " + described(object_->at("kind")),
                "sections are parts of a budget; the results of this kind are a certificate of their own",
                "issue a certificate for each job, and refer to the other one in the remarks of the certificate data");
            continue;
        }
        // A key that is there already is not what a misspelt one was meant to be.
        std::vector<std::string_view> absent;
        std::copy_if(keys_.begin(), keys_.end(), std::back_inserter(absent),
                     [&](std::string_view known) { return !object_->contains(known); });
        const std::optional<std::string_view> nearest = nearest_word(key, absent);
        problems_->refuse(k_unknown_key, where(key), "the key " + text::in_quotes(key) + " is not known here",
                          "the keys here are " + text::any_of(keys_),
                          nearest ? "did you mean \"" + std::string{*nearest} + "\"?" : "remove it");
    }
}

std::optional<JsonObject> JsonObject::root(const JsonDocument& document, std::span<const std::string_view> keys,
                                           ProblemList& problems) {
    if (document.value.is_discarded()) {
        return std::nullopt;
    }
    if (!document.value.is_object()) {
        problems.refuse(k_wrong_type, document.where(""), "the document is " + described(document.value),
                        "must be an object", "write { \"key\": value, … }");
        return std::nullopt;
    }
    return JsonObject(document, "", keys, problems);
}

bool JsonObject::has(std::string_view key) const {
    return object_->contains(key);
}

const nlohmann::json* JsonObject::find(std::string_view key) const {
    // An accessor that asks for a key outside the table would contradict the refusal of unknown keys.
    assert(std::find(keys_.begin(), keys_.end(), key) != keys_.end());
    const auto found = object_->find(key);
    return found == object_->end() || found->is_discarded() ? nullptr : &*found;
}

std::string JsonObject::where(std::string_view key) const {
    return has(key) ? document_->where(pointer(key)) : where();
}

bool JsonObject::require(std::string_view key) const {
    if (has(key)) {
        return true;
    }
    problems_->refuse(k_missing_key, where(), "the key " + text::in_quotes(key) + " is missing", "the key is required",
                      "add it");
    return false;
}

void JsonObject::refuse(const InputCode& code, std::string_view key, std::string what, std::string rule,
                        std::string action) const {
    problems_->refuse(code, where(key), std::move(what), std::move(rule), std::move(action));
}

void JsonObject::refuse_type(const std::string& pointer, const nlohmann::json& value, std::string_view expected) const {
    problems_->refuse(k_wrong_type, document_->where(pointer), described(value), "must be " + std::string{expected},
                      value.is_string() && expected.find("number") != std::string_view::npos
                          ? advice_for_number(value.get_ref<const std::string&>())
                          : "correct the value");
}

const nlohmann::json* JsonObject::typed(std::string_view key, nlohmann::json::value_t type,
                                        std::string_view expected) const {
    const nlohmann::json* value = find(key);
    if (value != nullptr && value->type() != type) {
        refuse_type(pointer(key), *value, expected);
        return nullptr;
    }
    return value;
}

std::optional<double> JsonObject::number_at(const std::string& pointer, const nlohmann::json& value,
                                            const NumberRange& range) const {
    if (value.is_discarded()) {
        return std::nullopt;
    }
    if (!value.is_number()) {
        refuse_type(pointer, value, "a number");
        return std::nullopt;
    }
    const double number = value.get<double>();
    if (!range.contains(number)) {
        problems_->refuse(k_number_out_of_range, document_->where(pointer), range.with_unit(number), range.rule(),
                          range.action());
        return std::nullopt;
    }
    return number;
}

std::optional<double> JsonObject::optional_number(std::string_view key, const NumberRange& range) const {
    const nlohmann::json* value = find(key);
    return value == nullptr ? std::nullopt : number_at(pointer(key), *value, range);
}

std::optional<double> JsonObject::required_number(std::string_view key, const NumberRange& range) const {
    require(key);
    return optional_number(key, range);
}

std::optional<std::int64_t> JsonObject::optional_integer(std::string_view key, const NumberRange& range) const {
    const nlohmann::json* value = find(key);
    if (value == nullptr) {
        return std::nullopt;
    }
    if (!value->is_number()) {
        refuse_type(pointer(key), *value, "a whole number");
        return std::nullopt;
    }
    // Whole numbers may be written with a point or an exponent: "trials": 1e6. Beyond 2^53 not every one has a double.
    constexpr double k_largest = 9007199254740992.0;
    const double number = value->get<double>();
    if (!(number >= -k_largest && number <= k_largest)) {
        // A double of that size is whole: what is wrong with it is its size, unless the key allows it.
        if (number_at(pointer(key), *value, range)) {
            refuse(k_number_out_of_range, key, range.with_unit(number), "must lie within ±9007199254740992",
                   "write a smaller number");
        }
        return std::nullopt;
    }
    if (number != static_cast<double>(static_cast<std::int64_t>(number))) {
        refuse(k_not_an_integer, key, range.with_unit(number), "must be a whole number",
               "write a number without fraction");
        return std::nullopt;
    }
    if (!number_at(pointer(key), *value, range)) {
        return std::nullopt;
    }
    return static_cast<std::int64_t>(number);
}

std::optional<std::int64_t> JsonObject::required_integer(std::string_view key, const NumberRange& range) const {
    require(key);
    return optional_integer(key, range);
}

std::optional<bool> JsonObject::optional_boolean(std::string_view key) const {
    const nlohmann::json* value = typed(key, nlohmann::json::value_t::boolean, "true or false");
    return value == nullptr ? std::nullopt : std::optional<bool>{value->get<bool>()};
}

std::optional<std::string> JsonObject::optional_string(std::string_view key) const {
    const nlohmann::json* value = typed(key, nlohmann::json::value_t::string, "a string");
    return value == nullptr ? std::nullopt : std::optional<std::string>{value->get<std::string>()};
}

std::optional<std::string> JsonObject::required_string(std::string_view key) const {
    require(key);
    return optional_string(key);
}

std::optional<std::string> JsonObject::optional_name(std::string_view key, std::size_t longest) const {
    std::optional<std::string> text = optional_string(key);
    if (text) {
        if (const auto objection = name_objection(*text, longest)) {
            refuse(k_text_not_allowed, key, text::in_quotes(*text) + " " + *objection,
                   "must be one line of at most " + std::to_string(longest) +
                       " bytes, without spaces around it and without control or hidden characters",
                   "correct the text");
            return std::nullopt;
        }
    }
    return text;
}

std::optional<std::string> JsonObject::required_name(std::string_view key, std::size_t longest) const {
    require(key);
    return optional_name(key, longest);
}

std::optional<std::string> JsonObject::optional_label(std::string_view key) const {
    const nlohmann::json* value = find(key);
    return value == nullptr ? std::nullopt : label_of(*value, where(key), *problems_);
}

std::optional<JsonObject> JsonObject::optional_object(std::string_view key,
                                                      std::span<const std::string_view> keys) const {
    if (typed(key, nlohmann::json::value_t::object, "an object") == nullptr) {
        return std::nullopt;
    }
    return JsonObject(*document_, pointer(key), keys, *problems_);
}

std::optional<JsonObject> JsonObject::required_object(std::string_view key,
                                                      std::span<const std::string_view> keys) const {
    require(key);
    return optional_object(key, keys);
}

const nlohmann::json* JsonObject::optional_array(std::string_view key) const {
    return typed(key, nlohmann::json::value_t::array, "an array");
}

const nlohmann::json* JsonObject::required_array(std::string_view key) const {
    require(key);
    return optional_array(key);
}

std::optional<std::vector<double>> JsonObject::required_numbers(std::string_view key, std::size_t size,
                                                                const NumberRange& range) const {
    const nlohmann::json* array = required_array(key);
    if (array == nullptr) {
        return std::nullopt;
    }
    if (array->size() != size) {
        refuse(k_wrong_size, key, "an array of " + std::to_string(array->size()) + " elements",
               "must have " + text::count_of(size, "number"), "correct the array");
        return std::nullopt;
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < size; ++i) {
        if (const auto number = number_at(child_pointer(pointer(key), i), (*array)[i], range)) {
            numbers.push_back(*number);
        }
    }
    return numbers.size() == size ? std::optional{std::move(numbers)} : std::nullopt;
}

std::optional<std::size_t> JsonObject::choice_index(std::string_view key,
                                                    std::span<const std::string_view> words) const {
    const std::optional<std::string> text = optional_string(key);
    if (!text) {
        return std::nullopt;
    }
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found == words.end()) {
        const std::optional<std::string_view> nearest = nearest_word(*text, words);
        refuse(k_unknown_choice, key, text::in_quotes(*text), "must be " + text::any_of(words),
               nearest ? "did you mean \"" + std::string{*nearest} + "\"?" : "choose one of them");
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - words.begin());
}

}  // namespace gumcert::jobs
