#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::json {

/// A member without a rule of its own.
struct NoRule {};

/// Reads one JSON object into a struct by the description of that struct, `describe(archive, value)`: finds the members,
/// goes into optional values, lists and structs, and knows which keys nobody asked for.
///
/// What a value must be, and how a breach is reported, is decided by `Reader`, which derives from this and has
///
///   k_null_is_none                     whether null stands for an optional value that is none
///   find(key)                          find_if_there(key), and what it means that a key is missing
///   require(key)                       what it means that a key is missing without which the object means nothing
///   unknown_key(key)                   a key that nobody asked for
///   wrong_type(value, expected, place)
///   wrong_size(value, size, place)     an array for a list of another, fixed size
///   read_value(value, v, place, rule)  numbers, texts, and all that is neither a list nor a described struct
///   read_struct(value, v, place)       an object: describe(a Reader of it, v), finish(), and what holds between members
///
/// \tparam Place  where a value stands; has child(key) and child(index)
template <class Reader, class Place>
class StructReader {
public:
    template <class Type, class Rule = NoRule>
    void operator()(std::string_view key, Type& v, const Rule& rule = {}) {
        if (const nlohmann::json* value = self().find(key)) {
            read(*value, v, place_.child(key), rule);
        }
    }
    template <class Type>
    void operator()(std::string_view key, Type& v, std::initializer_list<const char*> words) {
        if (const nlohmann::json* value = self().find(key)) {
            read(*value, v, place_.child(key), words);
        }
    }
    template <class Type, class Rule = NoRule>
    void needed(std::string_view key, Type& v, const Rule& rule = {}) {
        (*this)(key, v, rule);
        self().require(key);
    }
    template <class Type>
    void needed(std::string_view key, Type& v, std::initializer_list<const char*> words) {
        (*this)(key, v, words);
        self().require(key);
    }

    /// A member that is stated only where it holds something, and may be missing without a word, whatever else a missing
    /// one means.
    template <class Type, class Rule = NoRule>
    void stated(std::string_view key, Type& v, const Rule& rule = {}) {
        if (object_.contains(key)) {
            (*this)(key, v, rule);
        }
    }
    template <class Type>
    void stated(std::string_view key, Type& v, std::initializer_list<const char*> words) {
        if (object_.contains(key)) {
            (*this)(key, v, words);
        }
    }

    /// To be called when every key was asked for: what is left in the object is unknown.
    void finish() {
        std::sort(asked_.begin(), asked_.end(), std::less<>());
        asked_.erase(std::unique(asked_.begin(), asked_.end()), asked_.end());
        if (asked_.size() == object_.size()) {
            return;
        }
        for (const auto& [key, value] : object_.items()) {
            if (!std::binary_search(asked_.begin(), asked_.end(), &key, std::less<>())) {
                self().unknown_key(key);
            }
        }
    }

protected:
    StructReader(const nlohmann::json& object, Place place) : object_(object), place_(std::move(place)) {}

    const nlohmann::json& object_;
    const Place place_;

    /// The value of a key, which is known from now on; none where it is missing.
    const nlohmann::json* find_if_there(std::string_view key) {
        const auto found = object_.find(key);
        if (found == object_.end()) {
            return nullptr;
        }
        asked_.push_back(&found.key());
        return &*found;
    }

    template <class Type, class Rule = NoRule>
    void read(const nlohmann::json& value, Type& v, const Place& place, const Rule& rule = {}) {
        if (value.is_discarded()) {
            return;  // a number that was refused while the text was read
        }
        if constexpr (std::same_as<Type, bool>) {
            if (value.is_boolean()) {
                v = value.get<bool>();
            } else {
                self().wrong_type(value, "true or false", place);
            }
        } else if constexpr (requires { self().read_value(value, v, place, rule); }) {
            self().read_value(value, v, place, rule);
        } else if constexpr (requires { v.has_value(); }) {
            if (Reader::k_null_is_none && value.is_null()) {
                v.reset();
            } else {
                // Not emplace(): for Clang a nested struct with initialisers is not constructible there.
                v = typename Type::value_type{};
                read(value, *v, place, rule);
            }
        } else if constexpr (requires { v.size(); }) {
            read_list(value, v, place, rule);
        } else if (value.is_object()) {
            self().read_struct(value, v, place);
        } else {
            self().wrong_type(value, "an object", place);
        }
    }

private:
    std::vector<const std::string*> asked_;

    Reader& self() { return static_cast<Reader&>(*this); }

    template <class List, class Rule>
    void read_list(const nlohmann::json& value, List& v, const Place& place, const Rule& rule) {
        if (!value.is_array()) {
            self().wrong_type(value, "an array", place);
            return;
        }
        if constexpr (requires { v.resize(value.size()); }) {
            v.clear();
            v.resize(value.size());
        } else if (value.size() != v.size()) {
            self().wrong_size(value, v.size(), place);
            return;
        }
        for (std::size_t i = 0; i < v.size(); ++i) {
            read(value[i], v[i], place.child(i), rule);
        }
    }
};

}  // namespace gumcert::json
