#include "reports/record/schema/record_schema.h"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "json/readable_json.h"
#include "reports/record/record_fields.h"
#include "reports/record/record_kinds.h"
#include "reports/record/record_rules.h"
#include "reports/record/schema/schema_additions.h"
#include "reports/record/schema/schema_definitions.h"

namespace gumcert::reports {

namespace {

using nlohmann::ordered_json;
using Range = certificate::NumberRule;

ordered_json words(std::initializer_list<const char*> all) {
    return {{"enum", std::vector<std::string>(all.begin(), all.end())}};
}

ordered_json number(Range range, bool whole = false) {
    ordered_json schema{{"type", whole ? "integer" : "number"}};
    switch (range) {
        case Range::not_negative:
            schema["minimum"] = 0;
            break;
        case Range::positive:
            schema.update(whole ? ordered_json{{"minimum", 1}} : ordered_json{{"exclusiveMinimum", 0}});
            break;
        case Range::probability:
            schema["minimum"] = 0;
            schema["maximum"] = 1;
            break;
        case Range::at_least_one:
            schema["minimum"] = 1;
            break;
        case Range::one_or_two:
            schema["enum"] = {1, 2};
            break;
        case Range::any:
            break;
    }
    return schema;
}

ordered_json list_of(ordered_json items) {
    return {{"type", "array"}, {"items", std::move(items)}};
}

ordered_json list_of(ordered_json items, std::size_t size) {
    return {{"type", "array"}, {"items", std::move(items)}, {"minItems", size}, {"maxItems", size}};
}

ordered_json or_null(ordered_json schema) {
    if (!schema.contains("type")) {
        return {{"oneOf", {{{"type", "null"}}, std::move(schema)}}};
    }
    schema["type"] = {schema["type"], "null"};
    return schema;
}

/// The archive that makes the schema of one object.
class SchemaWriter {
public:
    /// \param definitions  receives those of the structs in the object
    explicit SchemaWriter(ordered_json& definitions) : definitions_(definitions) {}

    template <class Type>
    void operator()(const char* key, const Type&, Range range = Range::any) {
        add(key, schema_of<Type>(range));
    }
    template <class Number>
    void operator()(const char* key, const Shown<Number>& v, Range range = Range::any) {
        shown(key, key, v, range);
    }
    template <class Number>
    void shown(const char* key, const char* text_key, const Shown<Number>& v, Range range = Range::any) {
        (*this)(key, v.number, range);
        text(text_key, v.text);
    }
    void operator()(const char* key, const std::string&, std::initializer_list<const char*> allowed) {
        add(key, words(allowed));
    }
    void operator()(const char* key, const std::vector<std::string>&, std::initializer_list<const char*> allowed) {
        add(key, list_of(words(allowed)));
    }
    /// A record keeps texts as they were stated.
    template <class Type>
    void operator()(const char* key, const Type& v, certificate::TextForm) {
        (*this)(key, v);
    }
    template <class Type, class... Rule>
    void needed(const char* key, const Type& v, const Rule&... rule) {
        (*this)(key, v, rule...);
    }
    void needed(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        (*this)(key, v, allowed);
    }
    template <class Type>
    void filled(const char* key, const Type& v) {
        (*this)(key, v);
    }
    template <class Type>
    void filled_if_any(const char* key, const Type& v) {
        added(key, v);
    }
    template <class Enumerator>
    void named(const char* key, Enumerator, std::initializer_list<const char*> allowed) {
        add(key, words(allowed));
    }
    template <class Type, class... Rule>
    void added(const char* key, const Type& v, const Rule&... rule) {
        (*this)(key, v, rule...);
        required_.erase(required_.size() - 1);
    }
    void added(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        (*this)(key, v, allowed);
        required_.erase(required_.size() - 1);
    }
    /// Absent, and never null or empty, where there is nothing to say.
    template <class Type, class... Rule>
    void stated(const char* key, const Type& v, const Rule&... rule) {
        added(key, v, rule...);
    }
    template <class Type, class... Rule>
    void stated(const char* key, const std::optional<Type>&, const Rule&... rule) {
        added(key, Type{}, rule...);
    }
    void stated(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        added(key, v, allowed);
    }
    template <class Number, class... Rule>
    void added(const char* key, const Shown<Number>& v, const Rule&... rule) {
        added(key, v.number, rule...);
        text_added(key, v.text);
    }
    template <class Text>
    void text(const char* key, const Text&) {
        texts_.push_back([key](SchemaWriter& printed) { printed(key, Text{}); });
    }
    template <class Text>
    void text_added(const char* key, const Text&) {
        texts_.push_back([key](SchemaWriter& printed) { printed.added(key, Text{}); });
    }
    template <class Number>
    void text_added(const char* key, const Shown<Number>& v, Range range = Range::any) {
        (*this)(key, v.number, range);
        text_added(key, v.text);
    }

    template <class Describe>
    void group(const char* key, const Describe& describe_group) {
        SchemaWriter inner(definitions_);
        describe_group(inner);
        add(key, inner.schema());
    }
    void constant(const char* key, const char* v) { add(key, {{"const", v}}); }
    void severity(const char* key, gum::Severity) {
        add(key, {{"enum", std::vector<std::string>(k_severities.begin(), k_severities.end())}});
    }
    void document(const char* key, const std::string&) { add(key, ordered_json::object()); }
    void object_or_null(const char* key, const std::string&) { add(key, {{"type", {"object", "null"}}}); }
    void digest(const char* key, const std::string& v) {
        SchemaWriter inner(definitions_);
        inner("algorithm", v, {k_digest_algorithm});
        inner.add("value", {{"type", "string"}, {"pattern", "^[0-9a-f]{64}$"}});
        add(key, inner.schema());
        required_.erase(required_.size() - 1);
    }

    void results(const char* key, const std::vector<Result>&) {
        add_by_name(key, definition<Result>([](SchemaWriter& inner, const Result& v) {
                        describe(inner, v);
                        inner("order", std::int64_t{}, Range::not_negative);
                    }));
    }
    void summary(const char* key, const std::vector<ComparisonSummary>&) {
        add_by_name(key, definition<ComparisonSummary>([](SchemaWriter& inner, const ComparisonSummary& v) {
                        describe(inner, v);
                        inner.added("order", std::int64_t{}, Range::not_negative);
                    }));
    }
    void errors(const char* key, const std::vector<ErrorsAtAngle>&, const RotaryTable& rotary) {
        add(key, list_of(definition<ErrorsAtAngle>([&](SchemaWriter& inner, const ErrorsAtAngle& v) {
                inner("angle_deg", v.angle_deg.number);
                inner("printed_angle", v.angle_deg.text);
                const std::size_t size = inner.properties_.size() + rotary.error_names.size();
                inner.more_ = {{"minProperties", size},
                               {"maxProperties", size},
                               {"patternProperties", {{"^E[XYZABC][ABC]$", inner.schema_of<StatedValue>(Range::any)}}}};
            })));
    }
    void quantity_budgets(const char* key, const std::vector<QuantityBudget>&, const std::vector<std::string>&) {
        add(key, list_of(definition<QuantityBudget>([](SchemaWriter& inner, const QuantityBudget& v) {
                inner("quantity", v.quantity);
                inner("angle_deg", v.angle_deg);
                inner("u", v.u, Range::not_negative);
                inner("unit", v.unit);
                inner.add_by_name("shares", number(Range::any));
            })));
    }
    void by_name(const std::vector<TableParameter>&) {
        ordered_json U = ordered_json::object();
        for (const char* name : k_positioning_names) {
            properties_[name] = number(Range::any);
            U[name] = number(Range::not_negative);
        }
        add("U", {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(U)}});
        ordered_json& parameters = properties_["parameters"]["items"];
        const ordered_json named{{"properties", {{"name", {{"enum", k_positioning_names}}}}}};
        parameters = {{"allOf", {parameters, named}}};
    }

    /// Of what was described until now.
    [[nodiscard]] ordered_json schema(std::string_view sentence = {}) {
        if (!texts_.empty()) {
            group("printed", [&](SchemaWriter& printed) {
                for (const auto& describe_text : texts_) {
                    describe_text(printed);
                }
            });
        }
        ordered_json schema = ordered_json::object();
        if (!sentence.empty()) {
            schema["description"] = sentence;
        }
        schema["type"] = "object";
        if (!required_.empty()) {
            schema["required"] = required_;
        }
        schema["additionalProperties"] = false;
        schema["properties"] = properties_;
        schema.update(more_);
        return schema;
    }

private:
    ordered_json& definitions_;
    ordered_json properties_ = ordered_json::object();
    ordered_json required_ = ordered_json::array();
    ordered_json more_ = ordered_json::object();
    std::vector<std::function<void(SchemaWriter&)>> texts_;  ///< of the object `printed`

    void add(const char* key, ordered_json schema) {
        if (!properties_.emplace(key, std::move(schema)).second) {
            throw std::logic_error(std::string(key) + " is described twice");
        }
        required_.push_back(key);
    }
    void add_by_name(const char* key, ordered_json schema) {
        add(key, {{"type", "object"}, {"additionalProperties", std::move(schema)}});
    }

    /// A reference to the definition of a struct, which is made where it is not there yet.
    template <class Struct, class Describe>
    ordered_json definition(const Describe& describe_struct) {
        constexpr const auto& k_row = std::get<DefinitionOf<Struct>>(k_definitions);
        const std::string name(k_row.name);
        if (!definitions_.contains(name)) {
            definitions_[name] = nullptr;  // its place: a struct may hold others of its kind
            const Struct v{};
            SchemaWriter writer(definitions_);
            describe_struct(writer, v);
            definitions_[name] = writer.schema(k_row.sentence);
        }
        return {{"$ref", "#/definitions/" + name}};
    }

    ordered_json text_in_languages() {
        const auto& [name, sentence] = std::get<DefinitionOf<certificate::LocalisedText>>(k_definitions);
        ordered_json languages = ordered_json::object();
        for (const std::string_view language : certificate::k_languages) {
            languages[std::string(language)] = {{"type", "string"}};
        }
        definitions_[std::string(name)] = {{"description", sentence},
                                           {"anyOf",
                                            {{{"type", "string"}},
                                             {{"type", "object"},
                                              {"minProperties", 1},
                                              {"additionalProperties", false},
                                              {"properties", std::move(languages)}}}}};
        return {{"$ref", "#/definitions/" + std::string(name)}};
    }

    template <class Type>
    ordered_json schema_of(Range range) {
        if constexpr (std::same_as<Type, double>) {
            return number(range);
        } else if constexpr (std::same_as<Type, std::int64_t> || std::same_as<Type, int>) {
            return number(range, true);
        } else if constexpr (std::same_as<Type, bool>) {
            return {{"type", "boolean"}};
        } else if constexpr (std::same_as<Type, std::string>) {
            return {{"type", "string"}};
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            return text_in_languages();
        } else if constexpr (std::same_as<Type, std::pair<double, double>>) {
            return list_of(number(range), 2);
        } else if constexpr (requires(const Type& v) { v.has_value(); }) {
            return or_null(schema_of<typename Type::value_type>(range));
        } else if constexpr (requires { std::tuple_size<Type>::value; }) {
            return list_of(schema_of<typename Type::value_type>(range), std::tuple_size_v<Type>);
        } else if constexpr (requires(const Type& v) { v.size(); }) {
            return list_of(schema_of<typename Type::value_type>(range));
        } else {
            return definition<Type>([](SchemaWriter& inner, const Type& v) { describe(inner, v); });
        }
    }
};

/// The value of a schema that add_to_schema() means; none where there is none.
ordered_json* value_at(ordered_json& schema, std::string_view place) {
    ordered_json* node = &schema;
    for (bool first = true; !place.empty() || first; first = false) {
        const std::string key(place.substr(0, place.find('/')));
        place.remove_prefix(std::min(place.size(), key.size() + 1));
        if (first && key.empty()) {
            continue;  // of the record itself
        }
        const auto [keyword, is_element] =
            first ? std::pair("definitions", false) : std::pair("properties", key == "*");
        const auto found = node->find(is_element ? "items" : keyword);
        if (found == node->end() || (!is_element && !found->contains(key))) {
            return nullptr;
        }
        node = is_element ? &*found : &(*found)[key];
    }
    return node;
}

}  // namespace

void add_to_schema(ordered_json& schema, std::string_view place, const ordered_json& addition) {
    ordered_json* const value = value_at(schema, place);
    if (value == nullptr) {
        throw std::invalid_argument("the schema has no " + std::string(place));
    }
    ordered_json whole = ordered_json::object();
    for (const auto& [keyword, says] : addition.items()) {
        if (const auto found = value->find(keyword); found != value->end() && *found == says) {
            throw std::invalid_argument("the schema says \"" + keyword + "\" of " + std::string(place) + " already");
        }
        if (value->contains("$ref") && keyword != "description") {
            throw std::invalid_argument("a validator reads no \"" + keyword + "\" beside the reference at " +
                                        std::string(place));
        }
        if (keyword == "description") {
            whole[keyword] = says;  // people read it first
        }
    }
    whole.update(*value);
    whole.update(addition);
    *value = std::move(whole);
}

ordered_json record_schema() {
    ordered_json definitions = ordered_json::object();
    SchemaWriter writer(definitions);
    const EvaluationRecord record{};
    describe(writer, record);
    ordered_json schema{
        {"$schema", "http://json-schema.org/draft-07/schema#"},
        {"$id", "https://gumcert.example/schemas/record-1.schema.json"},
        {"title", "gumcert record, version 1"},
        {"description",
         "Everything that a document prints and a third party needs to recompute it. Numbers are unrounded; every "
         "\"printed\" holds the texts of documents."}};
    schema.update(writer.schema());
    schema["properties"]["kind"] = {{"enum", k_record_kinds}};
    schema["definitions"] = std::move(definitions);
    for (const auto& [place, sentence] : k_sentences_of_values) {
        add_to_schema(schema, place, {{"description", sentence}});
    }
    for (const auto& [place, keywords] : k_rules_of_values) {
        add_to_schema(schema, place, ordered_json::parse(keywords));
    }
    return schema;
}

std::string record_schema_text() {
    return json::readable_json(record_schema()) + "\n";
}

}  // namespace gumcert::reports
