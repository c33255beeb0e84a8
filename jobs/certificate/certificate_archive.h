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
#include "jobs/certificate/certificate_codes.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"
#include "json/struct_reader.h"

namespace gumcert::jobs {

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

/// The title of a job of any kind: one line of at most 1000 bytes, or a text in each language. Nothing where it is left out.
void read_title(const JsonObject& job, const CertificatePlace& place, certificate::LocalisedText& title);

// What must hold between the members of one entry; called where each member by itself was accepted.
template <class Struct>
void check_entry(const Struct&, const CertificatePlace&) {}
void check_entry(const certificate::Capability& capability, const CertificatePlace& place);
void check_entry(const certificate::ScopeEntry::Range& range, const CertificatePlace& place);
void check_entry(const certificate::ScopeEntry& entry, const CertificatePlace& place);
void check_entry(const certificate::StandardUsed& standard, const CertificatePlace& place);
void check_entry(const certificate::Condition& condition, const CertificatePlace& place);
void check_entry(const certificate::Method& method, const CertificatePlace& place);
void check_entry(const certificate::PointLimits& limits, const CertificatePlace& place);
void check_entry(const certificate::PointLimits::Accuracy& accuracy, const CertificatePlace& place);
void check_entry(const certificate::AgreedSpecification& specification, const CertificatePlace& place);
void check_entry(const certificate::ExternalResults& external, const CertificatePlace& place);
void check_entry(const certificate::Profile& profile, const CertificatePlace& place);

/// Names that must differ within a list: languages, scope entries, specifications, parameters.
void check_lists(const certificate::CertificateData& data, const CertificatePlace& place);

/// Reads the members that `describe` lists from one object of a document, and refuses what is not among them. What is
/// missing keeps its default. Nothing stops it: every problem is found in one go.
class CertificateArchive : public gumcert::json::StructReader<CertificateArchive, CertificatePlace> {
public:
    /// \param place  of an object
    explicit CertificateArchive(const CertificatePlace& place) : CertificateArchive(value_at(place), place) {}

    /// A key that records of earlier releases do not have.
    template <class Type, class... Rule>
    void added(std::string_view key, Type& v, const Rule&... rule) {
        (*this)(key, v, rule...);
    }
    // Every key of a job may be missing.
    template <class Type, class Rule = gumcert::json::NoRule>
    void stated(std::string_view key, Type& v, const Rule& rule = {}) {
        (*this)(key, v, rule);
    }
    template <class Type>
    void stated(std::string_view key, Type& v, std::initializer_list<const char*> words) {
        (*this)(key, v, words);
    }

    /// The program fills it in: no key of a job.
    template <class Type>
    void filled(std::string_view, Type&) {}
    template <class Type>
    void filled_if_any(std::string_view, Type&) {}

    /// A whole struct.
    /// \param place  of any value
    template <class Struct>
    static void read_struct_at(Struct& v, const CertificatePlace& place) {
        const nlohmann::json& value = value_at(place);
        if (value.is_object()) {
            read_struct(value, v, place);
        } else {
            refuse_type(value, "an object", place);
        }
    }

private:
    friend StructReader;
    static constexpr bool k_null_is_none = false;
    std::vector<std::string_view> keys_;

    CertificateArchive(const nlohmann::json& object, const CertificatePlace& place) : StructReader(object, place) {}

    static const nlohmann::json& value_at(const CertificatePlace& place) {
        return place.document->value.at(nlohmann::json::json_pointer(place.pointer));
    }

    const nlohmann::json* find(std::string_view key) {
        keys_.push_back(key);
        return find_if_there(key);
    }
    void require(std::string_view key) const;
    void unknown_key(const std::string& key) const;
    static void wrong_type(const nlohmann::json& value, std::string_view expected, const CertificatePlace& place) {
        refuse_type(value, expected, place);
    }

    template <class Struct>
    static void read_struct(const nlohmann::json& object, Struct& v, const CertificatePlace& place) {
        const std::size_t refusals = place.problems->refusals();
        CertificateArchive archive(object, place);
        describe(archive, v);
        archive.finish();
        if (place.problems->refusals() == refusals) {
            check_entry(v, place);
        }
    }

    template <class Number, class Rule>
    requires std::same_as<Number, double> || std::same_as<Number, int>
    static void read_value(const nlohmann::json& value, Number& v, const CertificatePlace& place, const Rule& rule) {
        certificate::NumberRule allowed = certificate::NumberRule::any;
        if constexpr (std::same_as<Rule, certificate::NumberRule>) {
            allowed = rule;
        }
        if (!value.is_number()) {
            refuse_type(value, "a number", place);
        } else if (acceptable_number(value.get<double>(), allowed, place)) {
            v = static_cast<Number>(value.get<double>());
        }
    }

    template <class Rule>
    static void read_value(const nlohmann::json& value, std::string& v, const CertificatePlace& place,
                           const Rule& rule) {
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

    template <class Rule>
    static void read_value(const nlohmann::json& value, certificate::LocalisedText& v, const CertificatePlace& place,
                           const Rule& rule) {
        bool may_be_empty = false;
        if constexpr (std::same_as<Rule, certificate::TextForm>) {
            may_be_empty = rule == certificate::TextForm::text_or_none;
        }
        read_localised(value, v, may_be_empty, place);
    }
};

}  // namespace gumcert::jobs
