#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "json/canonical_json.h"
#include "json/step.h"
#include "reports/record/record_check.h"
#include "reports/record/record_fields.h"
#include "reports/record/record_rules.h"
#include "reports/record/record_value.h"
#include "reports/record/reported_result.h"

namespace gumcert::reports {

namespace {

using gumcert::json::canonical_json;
using gumcert::json::Step;
using nlohmann::json;
using Range = certificate::NumberRule;

/// \param action  a record that breaks its own rules is a fault of the program, unless the caller knows better
[[noreturn]] void refuse_record(const std::string& pointer, std::string what, std::string rule,
                                std::string action = "nothing was written; report this as a defect") {
    throw gum::NoResultError(gum::Diagnostic{.code = "GC-RECORD-0028",
                                             .where = "record#" + pointer,
                                             .what = std::move(what),
                                             .rule = std::move(rule),
                                             .action = std::move(action)});
}

[[noreturn]] void refuse_record(const Step& at, std::string what, std::string rule) {
    refuse_record(at.pointer(), std::move(what), std::move(rule));
}

class Writer {
public:
    /// \param place  its steps above and their keys outlive the writer
    explicit Writer(const Step& place) : place_(place) {}
    json object = json::object();

    template <class Type>
    void operator()(const char* key, const Type& v, Range range = Range::any) {
        object[key] = to_json(v, place_.child(key), range);
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

    /// What documents print, in the object `printed`.
    template <class Text>
    void text(const char* key, const Text& v) {
        object["printed"][key] = v;
    }
    template <class Text>
    void text_added(const char* key, const Text& v) {
        text(key, v);
    }

    /// A number whose text a later release added.
    template <class Number>
    void text_added(const char* key, const Shown<Number>& v, Range range = Range::any) {
        (*this)(key, v, range);
    }

    void operator()(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        if (std::find(allowed.begin(), allowed.end(), v) == allowed.end()) {
            refuse_record(place_.child(key), '"' + v + '"', "is not one of the names that a record may hold here");
        }
        object[key] = v;
    }

    void operator()(const char* key, const std::vector<std::string>& v, std::initializer_list<const char*> allowed) {
        const Step at = place_.child(key);
        json all = json::array();
        for (std::size_t i = 0; i < v.size(); ++i) {
            Writer inner(at);
            inner(std::to_string(i).c_str(), v[i], allowed);
            all.push_back(v[i]);
        }
        object[key] = std::move(all);
    }

    /// A record keeps texts as they were stated: their contents are not checked here.
    template <class Type>
    void operator()(const char* key, const Type& v, certificate::TextForm) {
        (*this)(key, v);
    }

    // In a record every key is present, so what a job must state is written like the rest.
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
        stated(key, v);
    }

    template <class Enumerator>
    void named(const char* key, Enumerator v, std::initializer_list<const char*> words) {
        object[key] = *(words.begin() + static_cast<std::ptrdiff_t>(v));
    }

    /// A key that a later release added to the schema: always written, may be missing where it is read.
    template <class Type, class... Rule>
    void added(const char* key, const Type& v, const Rule&... rule) {
        (*this)(key, v, rule...);
    }
    void added(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        (*this)(key, v, allowed);
    }

    /// A key that a later release added, and that is written only where there is something to say: records without it
    /// keep their bytes.
    template <class Type, class... Rule>
    void stated(const char* key, const Type& v, const Rule&... rule) {
        if (!is_nothing(v)) {
            (*this)(key, v, rule...);
        }
    }
    void stated(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        if (!v.empty()) {
            (*this)(key, v, allowed);
        }
    }

    template <class Describe>
    void group(const char* key, const Describe& describe_group) {
        Writer inner(place_.child(key));
        describe_group(inner);
        object[key] = std::move(inner.object);
    }

    void constant(const char* key, const char* v) { object[key] = v; }
    void digest(const char*, const std::string&) {}  // with_digest() adds it to the finished record

    void severity(const char* key, gum::Severity v) { object[key] = k_severities.at(static_cast<std::size_t>(v)); }

    void document(const char* key, const std::string& text) {
        json value = text.empty() ? json() : json::parse(text, nullptr, false);
        if (value.is_discarded()) {
            refuse_record(place_.child(key), "text that is not JSON", "job, options and audit are JSON texts");
        }
        object[key] = std::move(value);
    }

    void object_or_null(const char* key, const std::string& text) { document(key, text); }

    void results(const char* key, const std::vector<Result>& v) {
        json all = json::object();
        const Step all_at = place_.child(key);
        for (std::size_t i = 0; i < v.size(); ++i) {
            const Step at = all_at.child(v[i].name);
            json item = structure(v[i], at);
            item["reported"] = structure(reported_result(v[i]), at.child("reported"));
            item["order"] = i;
            insert(all, v[i].name, std::move(item), at);
        }
        object[key] = std::move(all);
    }

    void summary(const char* key, const std::vector<ComparisonSummary>& v) {
        json all = json::object();
        const Step all_at = place_.child(key);
        for (std::size_t i = 0; i < v.size(); ++i) {
            const Step at = all_at.child(v[i].direction);
            json item = structure(v[i], at);
            item["order"] = i;
            insert(all, v[i].direction, std::move(item), at);
        }
        object[key] = std::move(all);
    }

    void errors(const char* key, const std::vector<ErrorsAtAngle>& v, const RotaryTable& rotary) {
        const Step all_at = place_.child(key);
        json all = json::array();
        for (std::size_t i = 0; i < v.size(); ++i) {
            Writer inner(all_at.child(i));
            inner("angle_deg", v[i].angle_deg.number);
            inner("printed_angle", v[i].angle_deg.text);
            for (std::size_t m = 0; m < v[i].errors.size(); ++m) {
                const std::string& name = rotary.error_names[m];
                const Step at = inner.place_.child(name);
                insert(inner.object, name, structure(v[i].errors[m], at), at);
            }
            all.push_back(std::move(inner.object));
        }
        object[key] = std::move(all);
    }

    void quantity_budgets(const char* key, const std::vector<QuantityBudget>& v,
                          const std::vector<std::string>& sources) {
        const Step all_at = place_.child(key);
        json all = json::array();
        for (std::size_t i = 0; i < v.size(); ++i) {
            Writer inner(all_at.child(i));
            inner("quantity", v[i].quantity);
            inner("angle_deg", v[i].angle_deg);
            inner("u", v[i].u, Range::not_negative);
            inner("unit", v[i].unit);
            json shares = json::object();
            for (std::size_t s = 0; s < std::min(sources.size(), v[i].shares.size()); ++s) {
                shares[sources[s]] = to_json(v[i].shares[s], inner.place_.child("shares"), Range::any);
            }
            inner.object["shares"] = std::move(shares);
            all.push_back(std::move(inner.object));
        }
        object[key] = std::move(all);
    }

    /// The numbers of the parameters under their names, as the contract has them, beside the list with everything.
    void by_name(const std::vector<TableParameter>& v) {
        json U = json::object();
        for (const TableParameter& p : v) {
            object[p.name] = p.stated.value;
            U[p.name] = p.stated.U;
        }
        object["U"] = std::move(U);
    }

private:
    Step place_;

    template <class Type>
    static bool is_nothing(const Type& v) {
        if constexpr (requires { v.empty(); }) {
            return v.empty();
        } else {
            return !v;
        }
    }

    static void insert(json& into, const std::string& name, json item, const Step& at) {
        if (!into.emplace(name, std::move(item)).second) {
            refuse_record(at, "the name \"" + name + "\" is used twice", "names of one list differ");
        }
    }

    template <class Struct>
    static json structure(const Struct& v, const Step& at) {
        Writer inner(at);
        describe(inner, v);
        return std::move(inner.object);
    }

    /// A text for all languages is a string, else an object with one text a language.
    static json text_to_json(const certificate::LocalisedText& v, const Step& at) {
        if (v.by_language.empty()) {
            return v.plain;
        }
        if (!v.plain.empty()) {
            refuse_record(at, "a text for all languages beside one in " + v.by_language.front().first,
                          "a text is given once for all languages, or once in each");
        }
        json all = json::object();
        for (const auto& [language, text] : v.by_language) {
            if (std::find(certificate::k_languages.begin(), certificate::k_languages.end(), language) ==
                certificate::k_languages.end()) {
                refuse_record(at, "the language \"" + language + '"', "is none of those that a certificate may have");
            }
            insert(all, language, text, at);
        }
        return all;
    }

    template <class Type>
    static json to_json(const Type& v, const Step& at, Range range) {
        if constexpr (std::same_as<Type, double>) {
            if (!std::isfinite(v)) {
                throw gum::NoResultError(
                    gum::Diagnostic{.code = "GC-RECORD-0001",
                                    .where = "record#" + at.pointer(),
                                    .what = record_number(v),
                                    .rule = "every number of a record is finite",
                                    .action = "nothing was written; check the input that leads to it"});
            }
            if (!is_allowed(v, range)) {
                refuse_record(at, record_number(v), text_of_rule(range));
            }
            return v;
        } else if constexpr (std::same_as<Type, std::int64_t> || std::same_as<Type, int>) {
            if (!is_allowed(static_cast<double>(v), range)) {
                refuse_record(at, std::to_string(v), text_of_rule(range));
            }
            return v;
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            return text_to_json(v, at);
        } else if constexpr (std::same_as<Type, std::pair<double, double>>) {
            return json::array({to_json(v.first, at.child(0), range), to_json(v.second, at.child(1), range)});
        } else if constexpr (std::same_as<Type, bool> || std::same_as<Type, std::string>) {
            return v;
        } else if constexpr (requires { v.has_value(); }) {
            return v.has_value() ? to_json(*v, at, range) : json();
        } else if constexpr (requires { v.size(); }) {
            json all = json::array();
            for (std::size_t i = 0; i < v.size(); ++i) {
                all.push_back(to_json(v[i], at.child(i), range));
            }
            return all;
        } else {
            return structure(v, at);
        }
    }
};

json checked_value(const EvaluationRecord& record) {
    check_record(record, [](const std::string& at, std::string what, std::string rule) {
        refuse_record(at, std::move(what), std::move(rule));
    });
    Writer writer(Step{});
    describe(writer, record);
    return std::move(writer.object);
}

void require_size(const std::string& text) {
    if (text.size() > k_max_record_bytes) {
        refuse_record("", std::to_string(text.size()) + " bytes",
                      "a record has at most " + std::to_string(k_max_record_bytes) + " bytes",
                      "nothing was written; split the job into several");
    }
}

}  // namespace

std::string to_canonical_json(const EvaluationRecord& record) {
    std::string text = with_digest(checked_value(record));
    require_size(text);
    return text;
}

json to_json_value(const EvaluationRecord& record) {
    json value = checked_value(record);
    require_size(canonical_json(value));  // which refuses what no text can hold
    return value;
}

std::string with_digest(json record) {
    record.erase(k_digest_key);
    std::string text = canonical_json(record);
    const std::string member = std::string("\n \"") + k_digest_key + "\": {\n  \"algorithm\": \"" + k_digest_algorithm +
                               "\",\n  \"value\": \"" + encoding::sha256(text) + "\"\n }";
    // Put in its place among the sorted keys, for a record is large. Only a key of the outermost object stands behind
    // one blank at the beginning of a line.
    for (const auto& [key, item] : record.items()) {
        if (key > k_digest_key) {
            std::string name = canonical_json(json(key));
            name.pop_back();
            text.insert(text.find("\n " + name + ": "), member + ',');
            return text;
        }
    }
    record[k_digest_key] = {{"algorithm", k_digest_algorithm}, {"value", encoding::sha256(text)}};
    return canonical_json(record);
}

}  // namespace gumcert::reports
