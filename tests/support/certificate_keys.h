#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "certificate/certificate_fields.h"

namespace gumcert::test {

/// One key as certificate/certificate_fields.h describes it.
struct DescribedKey {
    std::string name;
    std::string type;  ///< "number", "whole", "boolean", "text", "localised", "pair", "object"
    int lists = 0;     ///< how many arrays are around it
    bool optional = false, needed = false, filled = false;
    std::vector<std::string> words;
    std::optional<certificate::NumberRule> number;
    std::optional<certificate::TextForm> form;
};

/// JSON pointer of an object, with `*` for any position of an array, and its keys.
using DescribedObjects = std::map<std::string, std::vector<DescribedKey>>;

/// Walks a description and writes down the keys.
class KeyCollector {
public:
    KeyCollector(std::string pointer, DescribedObjects& objects) : pointer_(std::move(pointer)), objects_(&objects) {
        (*objects_)[pointer_];
    }

    template <class Type, class... Rule>
    DescribedKey& operator()(const std::string& key, const Type& v, Rule... rule) {
        DescribedKey described;
        described.name = key;
        (note(described, rule), ...);
        look(described, v, pointer_ + "/" + key);
        return (*objects_)[pointer_].emplace_back(std::move(described));
    }
    template <class Type>
    DescribedKey& operator()(const std::string& key, const Type& v, std::initializer_list<const char*> words) {
        DescribedKey& described = (*this)(key, v);
        described.words.assign(words.begin(), words.end());
        return described;
    }
    /// A key that records of earlier releases do not have.
    template <class Type>
    void added(const std::string& key, const Type& v) {
        (*this)(key, v);
    }
    template <class Type, class... Rule>
    void stated(const std::string& key, const Type& v, Rule... rule) {
        (*this)(key, v, rule...);
    }
    template <class Type>
    void stated(const std::string& key, const Type& v, std::initializer_list<const char*> words) {
        (*this)(key, v, words);
    }
    template <class Type, class... Rule>
    void needed(const std::string& key, const Type& v, Rule... rule) {
        (*this)(key, v, rule...).needed = true;
    }
    template <class Type>
    void needed(const std::string& key, const Type& v, std::initializer_list<const char*> words) {
        (*this)(key, v, words).needed = true;
    }
    template <class Type>
    void filled(const std::string& key, const Type& v) {
        (*this)(key, v).filled = true;
    }
    template <class Type>
    void filled_if_any(const std::string& key, const Type& v) {
        (*this)(key, v).filled = true;
    }
    template <class Enumerator>
    void named(const std::string& key, Enumerator, std::initializer_list<const char*> words) {
        (*this)(key, std::string(), words);
    }
    template <class Describe>
    void group(const std::string& key, const Describe& describe_group) {
        DescribedKey described;
        described.name = key;
        described.type = "object";
        (*objects_)[pointer_].push_back(described);
        KeyCollector inner(pointer_ + "/" + key, *objects_);
        describe_group(inner);
    }

private:
    std::string pointer_;
    DescribedObjects* objects_;

    static void note(DescribedKey& key, certificate::NumberRule rule) { key.number = rule; }
    static void note(DescribedKey& key, certificate::TextForm form) { key.form = form; }

    template <class Type>
    void look(DescribedKey& key, const Type& v, const std::string& at) {
        if constexpr (std::same_as<Type, double>) {
            key.type = "number";
        } else if constexpr (std::same_as<Type, int>) {
            key.type = "whole";
        } else if constexpr (std::same_as<Type, bool>) {
            key.type = "boolean";
        } else if constexpr (std::same_as<Type, std::string>) {
            key.type = "text";
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            key.type = "localised";
        } else if constexpr (std::same_as<Type, std::pair<double, double>>) {
            key.type = "pair";
        } else if constexpr (requires { v.has_value(); }) {
            key.optional = true;
            look(key, typename Type::value_type{}, at);
        } else if constexpr (requires { v.size(); }) {
            ++key.lists;
            look(key, typename Type::value_type{}, at + "/*");
        } else {
            key.type = "object";
            KeyCollector inner(at, *objects_);
            describe(inner, v);
        }
    }
};

template <class Struct>
DescribedObjects described_objects() {
    DescribedObjects objects;
    KeyCollector collector("", objects);
    const Struct value{};
    describe(collector, value);
    return objects;
}

}  // namespace gumcert::test
