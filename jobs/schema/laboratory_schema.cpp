#include "jobs/schema/laboratory_schema.h"

#include <stdexcept>
#include <string_view>
#include <vector>

#include "jobs/laboratory/laboratory_statement.h"
#include "jobs/schema/job_schema.h"

namespace gumcert::jobs {

namespace {

using nlohmann::ordered_json;

constexpr std::string_view k_reference = "#/definitions/";

/// The names of the definitions that a schema refers to, in their order.
void add_references(const ordered_json& schema, std::vector<std::string>& names) {
    if (schema.is_object()) {
        for (const auto& [key, value] : schema.items()) {
            if (key == "$ref" && value.is_string()) {
                names.push_back(value.get<std::string>().substr(k_reference.size()));
            } else {
                add_references(value, names);
            }
        }
    } else if (schema.is_array()) {
        for (const ordered_json& item : schema) {
            add_references(item, names);
        }
    }
}

std::vector<const JobFields*> laboratory_objects() {
    return with_objects_in_them({&fields_of<LaboratoryStatement>(), &fields_of<StandardStatement>()});
}

ordered_json reference_to(std::string_view name) {
    return {{"$ref", std::string(k_reference) + std::string(name)}};
}

}  // namespace

ordered_json laboratory_schema(const ordered_json& job_schema) {
    ordered_json definitions = ordered_json::object();
    for (const JobFields* object : laboratory_objects()) {
        definitions[std::string(object->definition)] = schema_of(*object);
    }
    ordered_json files =
        ordered_json::array({reference_to("laboratory"), reference_to("standard"), reference_to("certificate_customer"),
                             reference_to("certificate_method")});
    std::vector<std::string> open;
    add_references(definitions, open);
    add_references(files, open);
    while (!open.empty()) {
        const std::string name = open.front();
        open.erase(open.begin());
        if (definitions.contains(name)) {
            continue;
        }
        if (!job_schema.at("definitions").contains(name)) {
            throw std::invalid_argument("the schema of jobs has no definition " + name);
        }
        definitions[name] = job_schema.at("definitions").at(name);
        add_references(definitions[name], open);
    }
    return {{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"$id", "https://gumcert.example/schemas/laboratory-1.schema.json"},
            {"title", "gumcert laboratory, version 1"},
            {"description",
             "A file of the folder of a laboratory: laboratory.json, standards/ID.json, customers/ID.json or "
             "methods/ID.json. The program also accepts // comments."},
            {"anyOf", std::move(files)},
            {"definitions", std::move(definitions)}};
}

std::string page_of_laboratory_keys() {
    return "# The keys of the files of a laboratory\n\n"
           "What the readers of `laboratory.json` and of `standards/ID.json` allow under each key, object by object. "
           "This "
           "page and\n"
           "`schemas/laboratory-1.schema.json` are written from the description of the files ([ADR "
           "0044](adr/0044-jobs-described-once.md)).\n"
           "[laboratory.md](laboratory.md) explains the folder; customers and methods have the keys of `customer` and "
           "`method` in\n"
           "[certificate_data.md](certificate_data.md).\n" +
           tables_of_keys(laboratory_objects());
}

}  // namespace gumcert::jobs
