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
    fields_.fields.push_back({key, needed, sentence, shape, nullptr,
                              shape == Shape::list    ? "objects"
                              : shape == Shape::named ? "an object of objects"
                                                      : "an object",
                              std::make_shared<const JobFields>(std::move(fields))});
}

void FieldList::limit_list(std::size_t most) {
    JobFields::Field& field = fields_.fields.back();
    field.schema = ordered_json::object();
    if (most > 0) {
        field.schema["maxItems"] = most;
        field.value = "at most " + std::to_string(most) + " objects";
    }
}

void FieldList::or_part(JobFields fields) {
    JobFields::Field& field = fields_.fields.back();
    field.shape = Shape::array_or_part;
    field.value += "; or an object";
    field.fields = std::make_shared<const JobFields>(std::move(fields));
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
                                                         : "any number of them";
    rule.value = "an array, " + count + ": each " + element.value;
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
