#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "certificate/certificate_fields.h"
#include "engine/job/certificate_codes.h"
#include "engine/job/json_object.h"
#include "engine/job/problem_list.h"

namespace gumcert::engine {

/// A place in certificate data, for what is wrong there. The document and the list must outlive it.
struct CertificatePlace {
    const JsonDocument* document = nullptr;
    std::string pointer;
    ProblemList* problems = nullptr;

    [[nodiscard]] CertificatePlace child(std::string_view key) const {
        return {document, child_pointer(pointer, key), problems};
    }
    [[nodiscard]] CertificatePlace child(std::size_t index) const {
        return {document, child_pointer(pointer, index), problems};
    }
    /// The same with several tokens: "/rule/id".
    [[nodiscard]] CertificatePlace below(const std::string& relative) const {
        return {document, pointer + relative, problems};
    }
    void refuse(const InputCode& code, std::string what, std::string rule, std::string action) const {
        problems->refuse(code, document->where(pointer), std::move(what), std::move(rule), std::move(action));
    }
};

// What is demanded of a single value. Each returns whether it was accepted; else it has said why.
[[nodiscard]] bool acceptable_text(const std::string& text, certificate::TextForm form, const CertificatePlace& place);
[[nodiscard]] bool acceptable_number(double number, certificate::NumberRule rule, const CertificatePlace& place);
[[nodiscard]] bool acceptable_word(const std::string& word, std::initializer_list<const char*> words,
                                   const CertificatePlace& place);
void refuse_type(const nlohmann::json& value, std::string_view expected, const CertificatePlace& place);
void read_localised(const nlohmann::json& value, certificate::LocalisedText& text, bool may_be_empty,
                    const CertificatePlace& place);

// What must hold between the members of one entry; called where each member by itself was accepted.
template <class Struct>
void check_entry(const Struct&, const CertificatePlace&) {}
void check_entry(const certificate::Capability& capability, const CertificatePlace& place);
void check_entry(const certificate::ScopeEntry::Range& range, const CertificatePlace& place);
void check_entry(const certificate::ScopeEntry& entry, const CertificatePlace& place);
void check_entry(const certificate::StandardUsed& standard, const CertificatePlace& place);
void check_entry(const certificate::Condition& condition, const CertificatePlace& place);
void check_entry(const certificate::Method& method, const CertificatePlace& place);
void check_entry(const certificate::AgreedSpecification& specification, const CertificatePlace& place);
void check_entry(const certificate::ExternalResults& external, const CertificatePlace& place);
void check_entry(const certificate::Profile& profile, const CertificatePlace& place);

/// Names that must differ within a list: languages, scope entries, specifications, parameters.
void check_lists(const certificate::CertificateData& data, const CertificatePlace& place);

/// Reads the members that `describe` lists from one object of a document, and refuses what is not among them. What is
/// missing keeps its default. Nothing stops it: every problem is found in one go.
class CertificateArchive {
public:
    /// \param place  of an object
    explicit CertificateArchive(CertificatePlace place)
        : place_(std::move(place)), object_(&place_.document->value.at(nlohmann::json::json_pointer(place_.pointer))) {}

    template <class Type, class... Rule>
    void operator()(std::string_view key, Type& v, Rule... rule) {
        if (const nlohmann::json* value = find(key)) {
            read(*value, v, place_.child(key), rule...);
        }
    }
    template <class Type>
    void operator()(std::string_view key, Type& v, std::initializer_list<const char*> words) {
        if (const nlohmann::json* value = find(key)) {
            read(*value, v, place_.child(key), words);
        }
    }
    template <class Type, class... Rule>
    void needed(std::string_view key, Type& v, Rule... rule) {
        (*this)(key, v, rule...);
        require(key);
    }
    template <class Type>
    void needed(std::string_view key, Type& v, std::initializer_list<const char*> words) {
        (*this)(key, v, words);
        require(key);
    }
    /// The program fills it in: no key of a job.
    template <class Type>
    void filled(std::string_view, Type&) {}

    /// To be called when every key was asked for: what is left in the object is unknown.
    void finish() const;

    /// A whole struct.
    /// \param place  of any value
    template <class Struct>
    static void read_struct(Struct& v, const CertificatePlace& place) {
        const nlohmann::json& value = place.document->value.at(nlohmann::json::json_pointer(place.pointer));
        if (!value.is_object()) {
            refuse_type(value, "an object", place);
            return;
        }
        const std::size_t refusals = place.problems->refusals();
        CertificateArchive archive(place);
        describe(archive, v);
        archive.finish();
        if (place.problems->refusals() == refusals) {
            check_entry(v, place);
        }
    }

private:
    CertificatePlace place_;
    const nlohmann::json* object_;
    std::vector<std::string_view> keys_;

    const nlohmann::json* find(std::string_view key);
    void require(std::string_view key) const;

    template <class Type, class Rule = certificate::NumberRule>
    static void read(const nlohmann::json& value, Type& v, const CertificatePlace& place, Rule rule = {}) {
        if (value.is_discarded()) {
            return;  // a number that was refused while the text was read
        }
        if constexpr (std::same_as<Type, double> || std::same_as<Type, int>) {
            read_number(value, v, place, rule);
        } else if constexpr (std::same_as<Type, bool>) {
            if (value.is_boolean()) {
                v = value.get<bool>();
            } else {
                refuse_type(value, "true or false", place);
            }
        } else if constexpr (std::same_as<Type, std::string>) {
            read_text(value, v, place, rule);
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            bool may_be_empty = false;
            if constexpr (std::same_as<Rule, certificate::TextForm>) {
                may_be_empty = rule == certificate::TextForm::text_or_none;
            }
            read_localised(value, v, may_be_empty, place);
        } else if constexpr (requires { v.has_value(); }) {
            read(value, v.emplace(), place, rule);
        } else if constexpr (requires { v.resize(1); }) {
            read_list(value, v, place, rule);
        } else {
            read_struct(v, place);
        }
    }

    template <class Number>
    static void read_number(const nlohmann::json& value, Number& v, const CertificatePlace& place,
                            certificate::NumberRule rule) {
        if (!value.is_number()) {
            refuse_type(value, "a number", place);
        } else if (acceptable_number(value.get<double>(), rule, place)) {
            v = static_cast<Number>(value.get<double>());
        }
    }

    template <class Rule>
    static void read_text(const nlohmann::json& value, std::string& v, const CertificatePlace& place, Rule rule) {
        if (!value.is_string()) {
            refuse_type(value, "a text", place);
            return;
        }
        const std::string& text = value.get_ref<const std::string&>();
        bool accepted = false;
        if constexpr (std::same_as<Rule, std::initializer_list<const char*>>) {
            accepted = acceptable_word(text, rule, place);
        } else if constexpr (std::same_as<Rule, certificate::TextForm>) {
            accepted = acceptable_text(text, rule, place);
        } else {
            accepted = acceptable_text(text, certificate::TextForm::name, place);
        }
        if (accepted) {
            v = text;
        }
    }

    template <class List, class Rule>
    static void read_list(const nlohmann::json& value, List& v, const CertificatePlace& place, Rule rule) {
        if (!value.is_array()) {
            refuse_type(value, "an array", place);
            return;
        }
        v.clear();
        v.resize(value.size());
        for (std::size_t i = 0; i < v.size(); ++i) {
            read(value[i], v[i], place.child(i), rule);
        }
    }
};

}  // namespace gumcert::engine
