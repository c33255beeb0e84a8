#include "jobs/schema/job_schema.h"

#include <array>
#include <stdexcept>

#include "jobs/budget/budget_job_statement.h"
#include "jobs/circle_closure/circle_closure_statement.h"
#include "jobs/rotary_table/rotary_table_statement.h"

namespace gumcert::jobs {

namespace {

using nlohmann::ordered_json;
using Field = JobFields::Field;

ordered_json alternatives_of(const std::vector<std::string_view>& keys) {
    ordered_json all = ordered_json::array();
    for (const std::string_view key : keys) {
        all.push_back({{"required", {key}}});
    }
    return all;
}

ordered_json schema_of_field(const Field& field) {
    ordered_json schema = ordered_json::object();
    if (!field.sentence.empty()) {
        schema["description"] = field.sentence;
    }
    switch (field.shape) {
        case Field::Shape::value:
            schema.update(field.schema);
            break;
        case Field::Shape::part:
            schema.update(schema_of(*field.fields));
            break;
        case Field::Shape::list:
            schema["type"] = "array";
            schema.update(field.schema);
            schema["items"] = schema_of(*field.fields);
            break;
        case Field::Shape::named:
            schema["type"] = "object";
            schema["additionalProperties"] = schema_of(*field.fields);
            break;
        case Field::Shape::array_or_part:
            schema.update(field.schema);
            schema.update(schema_of(*field.fields));
            schema["type"] = {"array", "object"};
            break;
    }
    return schema;
}

/// As people write it: what fits stands on one line.
void lay_out(const ordered_json& value, std::size_t indent, std::size_t column, std::string& out) {
    constexpr std::size_t k_line = 120;
    const auto in_one_line = [](const auto& self, const ordered_json& v) -> std::string {
        if (!v.is_structured() || v.empty()) {
            return v.dump();
        }
        std::string text = v.is_object() ? "{ " : "[";
        for (const auto& [key, element] : v.items()) {
            text += (text.size() > 2 || (v.is_array() && text.size() > 1) ? ", " : "") +
                    (v.is_object() ? ordered_json(key).dump() + ": " : std::string()) + self(self, element);
        }
        return text + (v.is_object() ? " }" : "]");
    };
    const std::string line = in_one_line(in_one_line, value);
    if (!value.is_structured() || value.empty() || column + line.size() < k_line) {
        out += line;
        return;
    }
    out += value.is_object() ? "{" : "[";
    const char* separator = "\n";
    for (const auto& [key, element] : value.items()) {
        const std::string start =
            std::string(indent + 2, ' ') + (value.is_object() ? ordered_json(key).dump() + ": " : std::string());
        out += separator + start;
        lay_out(element, indent + 2, start.size(), out);
        separator = ",\n";
    }
    out += "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
}

/// Where the next definition begins, or the last one ends.
std::size_t end_of_definition(const std::string& schema, std::size_t from) {
    for (std::size_t line = schema.find('\n', from); line != std::string::npos; line = schema.find('\n', line + 1)) {
        const std::string_view next = std::string_view(schema).substr(line + 1, 5);
        if (next.starts_with("    \"") || next.starts_with("  }")) {
            return line;
        }
    }
    throw std::invalid_argument("the definitions do not end");
}

void add_tables(const std::string& heading, const JobFields& fields, std::string& page) {
    page += "\n## " + heading + "\n\n| key | value | meaning |\n|---|---|---|\n";
    for (const Field& field : fields.fields) {
        page += "| `" + std::string(field.key) + "`" + (field.needed ? " (required)" : "") + " | " + field.value +
                " | " + std::string(field.sentence) + " |\n";
    }
    for (const auto& [keys, count] :
         {std::pair(&fields.at_least_one_of, "At least one"), std::pair(&fields.exactly_one_of, "Exactly one")}) {
        for (const std::vector<std::string_view>& group : *keys) {
            page += std::string("\n") + count + " of";
            for (std::size_t i = 0; i < group.size(); ++i) {
                page += (i == 0 ? " `" : i + 1 == group.size() ? " and `" : ", `") + std::string(group[i]) + "`";
            }
            page += " is stated.\n";
        }
    }
    for (const Field& field : fields.fields) {
        if (field.fields) {
            add_tables(heading + "/" + std::string(field.key) + (field.has_many() ? "/*" : ""), *field.fields, page);
        }
    }
}

}  // namespace

std::span<const DescribedObject> described_objects() {
    static const std::array<DescribedObject, 3> k_objects{{{"budget", budget_fields()},
                                                           {"rotary_table", rotary_table_fields()},
                                                           {"circle_closure", circle_closure_fields()}}};
    return k_objects;
}

ordered_json schema_of(const JobFields& fields) {
    ordered_json schema{{"type", "object"}};
    ordered_json properties = ordered_json::object();
    ordered_json needed = ordered_json::array();
    for (const Field& field : fields.fields) {
        properties[std::string(field.key)] = schema_of_field(field);
        if (field.needed) {
            needed.push_back(field.key);
        }
    }
    if (!needed.empty()) {
        schema["required"] = std::move(needed);
    }
    for (const std::vector<std::string_view>& keys : fields.at_least_one_of) {
        schema["anyOf"] = alternatives_of(keys);
    }
    for (const std::vector<std::string_view>& keys : fields.exactly_one_of) {
        schema["oneOf"] = alternatives_of(keys);
    }
    schema["additionalProperties"] = false;
    schema["properties"] = std::move(properties);
    return schema;
}

std::string with_described_definitions(const std::string& schema) {
    std::string written = schema;
    for (const DescribedObject& object : described_objects()) {
        const std::string start = "    \"" + std::string(object.definition) + "\": ";
        const std::size_t begin = written.find("\n" + start);
        if (begin == std::string::npos) {
            throw std::invalid_argument("the schema has no definition " + std::string(object.definition));
        }
        const std::size_t end = end_of_definition(written, begin + 1);
        std::string definition = "\n" + start;
        lay_out(schema_of(object.fields), 4, start.size(), definition);
        if (written[end - 1] == ',') {
            definition += ',';
        }
        written.replace(begin, end - begin, definition);
    }
    return written;
}

std::string page_of_job_keys() {
    std::string page =
        "# The keys of jobs\n\n"
        "What the reader of a job allows under each key, object by object; `*` stands for each of many. This page and "
        "the\n"
        "definitions of the same objects in `schemas/job-1.schema.json` are written from the description that reads "
        "the job\n"
        "([ADR 0044](adr/0044-jobs-described-once.md)). What holds between keys, and what files contain, is explained "
        "in\n"
        "[budget_job.md](budget_job.md), which has the keys of inputs, points and fits as well,\n"
        "[rotary_table_job.md](rotary_table_job.md) and [circle_closure_job.md](circle_closure_job.md). The keys of "
        "comparisons\n"
        "are in [comparison_job.md](comparison_job.md).\n";
    for (const DescribedObject& object : described_objects()) {
        add_tables(std::string(object.definition), object.fields, page);
    }
    return page;
}

}  // namespace gumcert::jobs
