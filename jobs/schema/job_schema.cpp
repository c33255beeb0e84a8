#include "jobs/schema/job_schema.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "jobs/budget/budget_job_statement.h"
#include "jobs/circle_closure/circle_closure_statement.h"
#include "jobs/comparison/comparison_job.h"
#include "jobs/rotary_table/rotary_table_statement.h"
#include "json/readable_json.h"

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

/// Written out, or a reference to where it is.
ordered_json schema_of_object(const JobFields& fields) {
    return fields.definition.empty() ? schema_of(fields)
                                     : ordered_json{{"$ref", "#/definitions/" + std::string(fields.definition)}};
}

ordered_json schema_of_objects(const Field& field) {
    ordered_json object = schema_of_object(*field.fields);
    if (!field.has_many()) {
        return object;
    }
    const bool is_list = field.shape == Field::Shape::list;
    ordered_json many{{"type", is_list ? "array" : "object"}};
    if (field.size.least > 0) {
        many[is_list ? "minItems" : "minProperties"] = field.size.least;
    }
    if (field.size.most > 0) {
        many[is_list ? "maxItems" : "maxProperties"] = field.size.most;
    }
    many[is_list ? "items" : "additionalProperties"] = std::move(object);
    return many;
}

ordered_json schema_of_field(const Field& field) {
    ordered_json schema = ordered_json::object();
    if (!field.sentence.empty()) {
        schema["description"] = field.sentence;
    }
    if (!field.fields) {
        schema.update(field.schema);
    } else if (field.schema.is_null()) {
        schema.update(schema_of_objects(field));
    } else {
        const bool are_several = field.schema.contains("anyOf");
        schema["anyOf"] = are_several ? field.schema.at("anyOf") : ordered_json::array({field.schema});
        schema["anyOf"].push_back(schema_of_objects(field));
    }
    return schema;
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

/// "`a`, `b` and `c`"
std::string keys_in_words(const std::vector<std::string_view>& keys) {
    std::string words;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        words += (i == 0 ? "`" : i + 1 == keys.size() ? " and `" : ", `") + std::string(keys[i]) + "`";
    }
    return words;
}

void add_rules(const JobFields& fields, std::string& page) {
    std::string rules;
    for (const auto& [keys, count] :
         {std::pair(&fields.at_least_one_of, "At least one"), std::pair(&fields.exactly_one_of, "Exactly one"),
          std::pair(&fields.at_most_one_of, "At most one")}) {
        for (const std::vector<std::string_view>& group : *keys) {
            rules += std::string(" ") + count + " of " + keys_in_words(group) + " is stated.";
        }
    }
    for (std::size_t i = 0; i < fields.needs.size();) {
        const std::string_view other = fields.needs[i].other;
        std::vector<std::string_view> keys;
        for (; i < fields.needs.size() && fields.needs[i].other == other; ++i) {
            keys.push_back(fields.needs[i].key);
        }
        rules += " " + keys_in_words(keys) + (keys.size() == 1 ? " needs `" : " need `") + std::string(other) + "`.";
    }
    if (!rules.empty()) {
        page += "\n" + rules.substr(1) + "\n";
    }
}

void add_tables(const std::string& heading, const JobFields& fields, std::string& page) {
    page += "\n## " + heading + "\n\n";
    if (!fields.sentence.empty()) {
        page += std::string(fields.sentence) + "\n\n";
    }
    page += "| key | value | meaning |\n|---|---|---|\n";
    const auto has_table_of_its_own = [](const Field& field) {
        return field.fields && !field.fields->definition.empty();
    };
    for (const Field& field : fields.fields) {
        page += "| `" + std::string(field.key) + "`" + (field.needed ? " (required)" : "") + " | " + field.value;
        if (has_table_of_its_own(field)) {
            const std::string name(field.fields->definition);
            page += ": [" + name + "](#" + name + ")";
        }
        page += " | " + std::string(field.sentence) + " |\n";
    }
    add_rules(fields, page);
    for (const Field& field : fields.fields) {
        if (field.fields && !has_table_of_its_own(field)) {
            add_tables(heading + "/" + std::string(field.key) + (field.has_many() ? "/*" : ""), *field.fields, page);
        }
    }
}

/// The definitions that an object refers to, each once.
void add_definitions(const JobFields& fields, std::vector<const JobFields*>& all) {
    for (const Field& field : fields.fields) {
        if (!field.fields) {
            continue;
        }
        const auto is_it = [&](const JobFields* known) { return known->definition == field.fields->definition; };
        if (!field.fields->definition.empty() && std::none_of(all.begin(), all.end(), is_it)) {
            all.push_back(field.fields.get());
        }
        add_definitions(*field.fields, all);
    }
}

/// The objects with a definition of the schema, and a heading of docs/job_keys.md, of their own.
std::vector<const JobFields*> described_objects() {
    // The points of a budget are described by hand.
    return with_objects_in_them({&budget_fields(), &fields_of<OverrideStatement>(), &rotary_table_fields(),
                                 &circle_closure_fields(), &comparison_fields()});
}

}  // namespace

ordered_json schema_of(const JobFields& fields) {
    ordered_json schema = ordered_json::object();
    if (!fields.sentence.empty()) {
        schema["description"] = fields.sentence;
    }
    schema["type"] = "object";
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
    for (const std::vector<std::string_view>& keys : fields.at_most_one_of) {
        for (auto key = keys.begin(); key != keys.end(); ++key) {
            for (auto other = key + 1; other != keys.end(); ++other) {
                schema["not"]["anyOf"].push_back({{"required", {*key, *other}}});
            }
        }
    }
    for (const JobFields::Need& need : fields.needs) {
        schema["dependencies"][std::string(need.key)].push_back(need.other);
    }
    schema["additionalProperties"] = false;
    schema["properties"] = std::move(properties);
    return schema;
}

std::string with_described_definitions(const std::string& schema) {
    std::string written = schema;
    for (const JobFields* object : described_objects()) {
        const std::string start = "    \"" + std::string(object->definition) + "\": ";
        const std::size_t begin = written.find("\n" + start);
        if (begin == std::string::npos) {
            throw std::invalid_argument("the schema has no definition " + std::string(object->definition));
        }
        const std::size_t end = end_of_definition(written, begin + 1);
        std::string definition = "\n" + start + json::readable_json(schema_of(*object), 4, start.size());
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
        "definitions of the same objects in `schemas/job-1.schema.json` are written from the description of the job\n"
        "([ADR 0044](adr/0044-jobs-described-once.md)). What else holds between keys, and what files contain, is "
        "explained in\n"
        "[budget_job.md](budget_job.md), [rotary_table_job.md](rotary_table_job.md),\n"
        "[circle_closure_job.md](circle_closure_job.md) and [comparison_job.md](comparison_job.md).\n";
    return page + tables_of_keys(described_objects());
}

std::vector<const JobFields*> with_objects_in_them(const std::vector<const JobFields*>& objects) {
    std::vector<const JobFields*> all;
    for (const JobFields* object : objects) {
        all.push_back(object);
        add_definitions(*object, all);
    }
    return all;
}

std::string tables_of_keys(const std::vector<const JobFields*>& objects) {
    std::string tables;
    for (const JobFields* object : objects) {
        add_tables(std::string(object->definition), *object, tables);
    }
    return tables;
}

}  // namespace gumcert::jobs
