#include "jobs/job_fields.h"

#include <cmath>

#include "text/lists.h"
#include "text/numbers.h"

namespace gumcert::jobs {

namespace {

using nlohmann::ordered_json;
using Shape = JobFields::Field::Shape;

/// Whole numbers without a point, as people write them.
ordered_json json_of(double number) {
    constexpr double k_largest_exact = 9007199254740992.0;
    if (std::abs(number) <= k_largest_exact && number == std::floor(number)) {
        return static_cast<std::int64_t>(number);
    }
    return number;
}

/// "`a`, `b` or `c`"
std::string alternatives(const std::vector<std::string_view>& words) {
    std::string all;
    for (std::size_t i = 0; i < words.size(); ++i) {
        all += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + ("`" + std::string(words[i]) + "`");
    }
    return all;
}

}  // namespace

std::vector<std::string_view> JobFields::keys() const {
    std::vector<std::string_view> all;
    for (const Field& field : fields) {
        all.push_back(field.key);
    }
    return all;
}

void FieldList::constant(std::string_view key, std::string_view word, std::string_view sentence) {
    add(key, true, {{{"const", word}}, "`" + std::string(word) + "`"}, sentence);
}

void FieldList::by_hand(std::string_view key, std::string_view schema, std::string value, std::string_view sentence) {
    add(key, false, {ordered_json::parse(schema), std::move(value)}, sentence);
}

void FieldList::needed_by_hand(std::string_view key, std::string_view schema, std::string value,
                               std::string_view sentence) {
    add(key, true, {ordered_json::parse(schema), std::move(value)}, sentence);
}

void FieldList::add(std::string_view key, bool needed, Rule rule, std::string_view sentence) {
    fields_.fields.push_back(
        {key, needed, sentence, Shape::value, std::move(rule.schema), std::move(rule.value), nullptr});
}

void FieldList::add_fields(std::string_view key, bool needed, Shape shape, JobFields fields,
                           std::string_view sentence) {
    fields_.fields.push_back(
        {key, needed, sentence, shape, nullptr, "an object", std::make_shared<const JobFields>(std::move(fields))});
}

void FieldList::add_named(std::string_view key, bool needed, JobFields fields, std::string_view sentence,
                          ListSize size) {
    add_fields(key, needed, Shape::named, std::move(fields), sentence);
    fields_.fields.back().size = size;
    fields_.fields.back().value = "an object of objects";
}

void FieldList::add_list(std::string_view key, bool needed, JobFields fields, std::string_view sentence,
                         ListSize size) {
    add_fields(key, needed, Shape::list, std::move(fields), sentence);
    JobFields::Field& field = fields_.fields.back();
    field.size = size;
    field.value = size.most > 0 ? (size.least > 0 ? std::to_string(size.least) + " to " : "at most ") +
                                      std::to_string(size.most) + " objects"
                  : size.least > 0 ? "an array of objects, at least " + std::to_string(size.least)
                                   : "objects";
}

void FieldList::or_value(Rule rule) {
    JobFields::Field& field = fields_.fields.back();
    field.schema = std::move(rule.schema);
    field.value = std::move(rule.value) + "; or " + field.value;
}

void FieldList::all_need(std::span<const std::string_view> keys, std::string_view other) {
    for (const std::string_view key : keys) {
        if (key != other) {
            needs(key, other);
        }
    }
}

FieldList::Rule FieldList::number(const NumberRange& range, bool whole) {
    Rule rule{{{"type", "number"}}, whole ? "a whole number" : "a number"};
    const bool has_low = range.low != -std::numeric_limits<double>::max();
    const bool has_high = range.high != std::numeric_limits<double>::max();
    if (has_low) {
        rule.schema[range.low_open ? "exclusiveMinimum" : "minimum"] = json_of(range.low);
        rule.value += (range.low_open ? " greater than " : ", at least ") + range.with_unit(range.low);
    }
    if (has_high) {
        rule.schema[range.high_open ? "exclusiveMaximum" : "maximum"] = json_of(range.high);
        rule.value += std::string(has_low ? " and " : ", ") + (range.high_open ? "less than " : "at most ") +
                      range.with_unit(range.high);
    }
    if (!has_low && !has_high && !range.unit.empty()) {
        rule.value += " of " + std::string(range.unit);
    }
    if (whole) {
        rule.schema["multipleOf"] = 1.0;  // an editor may take 1 for a demand that numbers have no point
    }
    return rule;
}

FieldList::Rule FieldList::array_of(Rule element, std::size_t least, std::size_t most) {
    Rule rule{{{"type", "array"}}, {}};
    if (least > 0) {
        rule.schema["minItems"] = least;
    }
    if (most > 0) {
        rule.schema["maxItems"] = most;
    }
    rule.schema["items"] = std::move(element.schema);
    const std::string count = least > 0 && least == most ? std::to_string(least) + " of them"
                              : most > 0                 ? std::to_string(least) + " to " + std::to_string(most)
                              : least > 0                ? "at least " + std::to_string(least)
                                                         : "any number of them";
    rule.value = "an array, " + count + ": each " + element.value;
    return rule;
}

FieldList::Rule FieldList::row_of(std::vector<Rule> elements) {
    Rule rule{{{"type", "array"}, {"minItems", elements.size()}, {"maxItems", elements.size()}}, "an array"};
    for (Rule& element : elements) {
        rule.schema["items"].push_back(std::move(element.schema));
        rule.value += (rule.schema["items"].size() == 1 ? ": " : "; ") + element.value;
    }
    return rule;
}

FieldList::Rule FieldList::by_name(Rule element) {
    return {{{"type", "object"}, {"additionalProperties", std::move(element.schema)}},
            "an object, under each name " + element.value};
}

FieldList::Rule FieldList::either(std::vector<Rule> rules) {
    Rule rule;
    for (Rule& one : rules) {
        rule.schema["anyOf"].push_back(std::move(one.schema));
        rule.value += (rule.value.empty() ? "" : "; or ") + one.value;
    }
    return rule;
}

FieldList::Rule FieldList::words(std::vector<std::string_view> words) {
    return {{{"enum", words}}, alternatives(words)};
}

FieldList::Rule FieldList::text(const Line& line) {
    constexpr std::size_t k_of_a_name = 256;
    constexpr std::size_t k_of_a_title = 1000;
    const std::string value = "one line of at most " + std::to_string(line.longest) + " bytes";
    if (line.longest == k_of_a_name || line.longest == k_of_a_title) {
        return {{{"$ref", line.longest == k_of_a_name ? "#/definitions/name" : "#/definitions/title"}}, value};
    }
    return {{{"type", "string"}, {"minLength", 1}, {"maxLength", line.longest}}, value};
}

FieldList::Rule FieldList::text(AnyText) {
    return {{{"type", "string"}}, "a text"};
}

FieldList::Rule FieldList::text(FileName) {
    return {{{"$ref", "#/definitions/file_name"}}, "the name of a file"};
}

FieldList::Rule FieldList::text(FileObject) {
    return {{{"$ref", "#/definitions/file_object"}}, "an object with the name of a `file`"};
}

FieldList::Rule FieldList::text(Label) {
    return {{{"$ref", "#/definitions/label"}}, "one line of at most 256 bytes, or a number"};
}

FieldList::Rule FieldList::text(Null) {
    return {{{"type", "null"}}, "`null`"};
}

FieldList::Rule FieldList::truth() {
    return {{{"type", "boolean"}}, "`true` or `false`"};
}

void JobKeyTable::add(std::string pointer, const JobFields& fields) {
    const auto& own = texts_.emplace_back(
        std::make_unique<std::pair<std::string, std::vector<std::string_view>>>(std::move(pointer), fields.keys()));
    objects_.push_back({own->first, own->second});
    const std::string here = own->first;
    for (const JobFields::Field& field : fields.fields) {
        if (field.fields) {
            add(here + "/" + std::string(field.key) + (field.has_many() ? "/*" : ""), *field.fields);
        }
    }
}

}  // namespace gumcert::jobs
