#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "jobs/input_text.h"
#include "jobs/job_kind.h"

namespace gumcert::jobs {

// Every object of a job is described once, by a function `describe(archive, value)`; what reads a job, what knows its keys,
// and what writes the JSON Schema and the table of the documentation all walk that description. So a key exists once.
// The functions are found by argument-dependent lookup.
//
// What an archive has; the sentence at the end says what the key means:
//   a(key, member, rule, sentence)         a member; `needed` in place of (): one that the object cannot do without
//   a.constant(key, word, sentence)        a key with one possible value, needed
//   a.part(key, struct, sentence)          an object; `needed_part`; the struct may be optional. With a fourth argument, a
//                                          function (archive, struct), the struct needs no description of its own
//   a.list(key, vector, sentence)          an array of objects; with a fourth argument, of how many; `needed_list`
//   a.named(key, vector, sentence)         an object of objects, each under a name; `needed_named`
//   a.by_code(key, rule, sentence)         a value without member; `needed_by_code`
//   a.part_or(key, rule, struct, sentence), a.list_or(key, rule, vector, sentence)    objects, or another value
//   a.by_hand(key, schema, value, sentence)               what no rule states: its JSON Schema, and the same for people
//   a.definition(name, sentence)           an object that stands in several places: it is written out once
//   a.at_least_one_of({ keys }), a.exactly_one_of({ keys }), a.at_most_one_of({ keys })
//   a.needs(key, other), a.all_need(keys, other)          keys that stand beside another one only
// Lists, and what has no member or stands in place of an object, are read by code, which checks them element by element and
// decides among alternatives. What keys say of each other is for the schema and for people: code has a message for each case.

// What is demanded of a value.
/// A number in the unit in which a job states it, and that unit in SI.
struct In {
    NumberRange range = {};
    double unit = 1.0;
    std::optional<NumberRange> then = {};  ///< asked for next, with a message of its own: what can be computed with
};
/// A whole number; 1e6 is one.
struct Whole {
    NumberRange range = {};
    std::optional<double> least = {};  ///< where a check of its own refuses smaller ones, with its own message
};
struct Truth {};
/// One line, not empty.
struct Line {
    std::size_t longest = 256;  ///< [byte]
};
/// A text as it stands.
struct AnyText {};
/// Relative to the job.
struct FileName {};
/// An object with the name of a file, k_file_object_keys.
struct FileObject {};
/// A name of one line; a number is taken as its shortest text.
struct Label {};
struct Null {};
/// Each enumerator of E with its word: what a job may say, and what a record repeats.
template <class E, std::size_t n>
using Words = std::array<std::pair<std::string_view, E>, n>;

// Values made of values, read by code.
/// An array of values of one rule.
template <class Rule>
struct Several {
    Rule each;
    std::size_t least, most;  ///< `most` 0: any number
    constexpr explicit Several(Rule rule, std::size_t at_least = 0, std::size_t at_most = 0)
        : each(rule), least(at_least), most(at_most) {}
};
/// An array of values with a rule each.
template <class... Rules>
struct Row {
    std::tuple<Rules...> each;
    constexpr explicit Row(Rules... rules) : each(rules...) {}
};
/// An object of values of one rule, each under a name.
template <class Rule>
struct ByName {
    Rule each;
    constexpr explicit ByName(Rule rule) : each(rule) {}
};
/// A value that one of the rules allows.
template <class... Rules>
struct Either {
    std::tuple<Rules...> rules;
    constexpr explicit Either(Rules... all) : rules(all...) {}
};
/// Degrees of freedom.
inline constexpr Either k_degrees_of_freedom{In{above_zero("")}, Words<bool, 1>{{{"inf", true}}}};

/// How many objects a list has; `most` 0: any number.
struct ListSize {
    std::size_t least = 0, most = 0;
};

/// The word of an enumerator that the words have.
template <class E, std::size_t n>
[[nodiscard]] constexpr std::string_view word_of(const Words<E, n>& words, std::type_identity_t<E> value) {
    for (const auto& [word, meaning] : words) {
        if (meaning == value) {
            return word;
        }
    }
    return {};
}

template <class E, std::size_t n>
[[nodiscard]] std::vector<std::string_view> words_of(const Words<E, n>& words) {
    std::vector<std::string_view> all;
    for (const auto& [word, meaning] : words) {
        all.push_back(word);
    }
    return all;
}

/// What a description says, as data.
struct JobFields {
    struct Field {
        enum class Shape { value, part, list, named };
        std::string_view key;
        bool needed = false;
        std::string_view sentence;
        Shape shape = Shape::value;
        nlohmann::ordered_json schema;            ///< of a value, or of what may stand in place of objects; else null
        std::string value;                        ///< what the value may be, for people
        std::shared_ptr<const JobFields> fields;  ///< of a part, or of each of many
        ListSize size = {};

        [[nodiscard]] bool has_many() const { return shape == Shape::list || shape == Shape::named; }
    };
    /// A key that stands beside another one only.
    struct Need {
        std::string_view key, other;
    };
    std::string_view definition, sentence;  ///< of an object that stands in several places, or of a kind of job
    std::vector<Field> fields;
    std::vector<std::vector<std::string_view>> at_least_one_of, exactly_one_of, at_most_one_of;
    std::vector<Need> needs;

    [[nodiscard]] std::vector<std::string_view> keys() const;
};

/// The description that a struct has.
struct OwnDescription {
    template <class Archive, class Struct>
    void operator()(Archive& a, Struct& v) const {
        describe(a, v);
    }
};

/// The archive that collects a description.
class FieldList {
public:
    template <class Type, class Rule>
    void operator()(std::string_view key, const Type& v, const Rule& rule, std::string_view sentence) {
        add(key, false, rule_of(v, rule), sentence);
    }
    template <class Type, class Rule>
    void needed(std::string_view key, const Type& v, const Rule& rule, std::string_view sentence) {
        add(key, true, rule_of(v, rule), sentence);
    }
    void constant(std::string_view key, std::string_view word, std::string_view sentence);
    template <class Struct, class Description = OwnDescription>
    void part(std::string_view key, Struct& v, std::string_view sentence, const Description& description = {}) {
        add_fields(key, false, JobFields::Field::Shape::part, fields_of(v, description), sentence);
    }
    template <class Struct, class Description = OwnDescription>
    void needed_part(std::string_view key, Struct& v, std::string_view sentence, const Description& description = {}) {
        add_fields(key, true, JobFields::Field::Shape::part, fields_of(v, description), sentence);
    }
    template <class Struct>
    void list(std::string_view key, std::vector<Struct>&, std::string_view sentence, ListSize size = {}) {
        Struct one{};
        add_list(key, false, fields_of(one, OwnDescription()), sentence, size);
    }
    template <class Struct>
    void needed_list(std::string_view key, std::vector<Struct>&, std::string_view sentence, ListSize size = {}) {
        Struct one{};
        add_list(key, true, fields_of(one, OwnDescription()), sentence, size);
    }
    template <class Struct>
    void named(std::string_view key, std::vector<Struct>&, std::string_view sentence, ListSize size = {}) {
        Struct one{};
        add_named(key, false, fields_of(one, OwnDescription()), sentence, size);
    }
    template <class Struct>
    void needed_named(std::string_view key, std::vector<Struct>&, std::string_view sentence, ListSize size = {}) {
        Struct one{};
        add_named(key, true, fields_of(one, OwnDescription()), sentence, size);
    }
    template <class Rule>
    void by_code(std::string_view key, const Rule& rule, std::string_view sentence) {
        add(key, false, rule_of(0.0, rule), sentence);
    }
    template <class Rule>
    void needed_by_code(std::string_view key, const Rule& rule, std::string_view sentence) {
        add(key, true, rule_of(0.0, rule), sentence);
    }
    template <class Rule, class Struct>
    void part_or(std::string_view key, const Rule& rule, Struct& v, std::string_view sentence) {
        part(key, v, sentence);
        or_value(rule_of(0.0, rule));
    }
    template <class Rule, class Struct>
    void list_or(std::string_view key, const Rule& rule, std::vector<Struct>& v, std::string_view sentence,
                 ListSize size = {}) {
        list(key, v, sentence, size);
        or_value(rule_of(0.0, rule));
    }
    void by_hand(std::string_view key, std::string_view schema, std::string value, std::string_view sentence);
    void needed_by_hand(std::string_view key, std::string_view schema, std::string value, std::string_view sentence);
    void definition(std::string_view name, std::string_view sentence = {}) {
        fields_.definition = name;
        fields_.sentence = sentence;
    }
    void at_least_one_of(std::initializer_list<std::string_view> keys) { fields_.at_least_one_of.emplace_back(keys); }
    void exactly_one_of(std::initializer_list<std::string_view> keys) { fields_.exactly_one_of.emplace_back(keys); }
    void at_most_one_of(std::initializer_list<std::string_view> keys) { fields_.at_most_one_of.emplace_back(keys); }
    void needs(std::string_view key, std::string_view other) { fields_.needs.push_back({key, other}); }
    void all_need(std::span<const std::string_view> keys, std::string_view other);

    /// What a description says of a struct.
    template <class Struct, class Description>
    [[nodiscard]] static JobFields fields_of(Struct& v, const Description& description) {
        if constexpr (requires { v.has_value(); }) {
            typename Struct::value_type inner{};
            return fields_of(inner, description);
        } else {
            FieldList list;
            description(list, v);
            return std::move(list.fields_);
        }
    }

private:
    /// What a rule says of a value: its schema, and the same for people.
    struct Rule {
        nlohmann::ordered_json schema;
        std::string value;
    };
    JobFields fields_;

    void add(std::string_view key, bool needed, Rule rule, std::string_view sentence);
    void add_fields(std::string_view key, bool needed, JobFields::Field::Shape shape, JobFields fields,
                    std::string_view sentence);
    void add_list(std::string_view key, bool needed, JobFields fields, std::string_view sentence, ListSize size);
    void add_named(std::string_view key, bool needed, JobFields fields, std::string_view sentence, ListSize size);
    void or_value(Rule rule);

    static Rule number(const NumberRange& range, bool whole);
    static Rule array_of(Rule element, std::size_t least, std::size_t most);
    static Rule row_of(std::vector<Rule> elements);
    static Rule by_name(Rule element);
    static Rule either(std::vector<Rule> rules);
    static Rule words(std::vector<std::string_view> words);
    static Rule text(const Line& line);
    static Rule text(AnyText);
    static Rule text(FileName);
    static Rule text(FileObject);
    static Rule text(Label);
    static Rule text(Null);
    static Rule truth();

    template <class Type>
    static Rule rule_of(const Type&, const In& rule) {
        NumberRange range = rule.range;
        range.high = rule.then ? rule.then->high : range.high;
        return numbers<Type>(number(range, false));
    }
    template <class Type>
    static Rule rule_of(const Type&, const Whole& rule) {
        NumberRange range = rule.range;
        range.low = rule.least.value_or(range.low);
        return numbers<Type>(number(range, true));
    }
    template <class Type>
    static Rule rule_of(const Type&, const Truth&) {
        return truth();
    }
    template <class Type, class Form>
    requires requires(const Form& form) { text(form); }
    static Rule rule_of(const Type&, const Form& form) { return text(form); }
    template <class Type, class E, std::size_t n>
    static Rule rule_of(const Type&, const Words<E, n>& choices) {
        return words(words_of(choices));
    }
    template <class Type, class Each>
    static Rule rule_of(const Type&, const Several<Each>& rule) {
        return array_of(rule_of(0.0, rule.each), rule.least, rule.most);
    }
    template <class Type, class... Each>
    static Rule rule_of(const Type&, const Row<Each...>& rule) {
        return row_of(std::apply([](const Each&... each) { return std::vector{rule_of(0.0, each)...}; }, rule.each));
    }
    template <class Type, class Each>
    static Rule rule_of(const Type&, const ByName<Each>& rule) {
        return by_name(rule_of(0.0, rule.each));
    }
    template <class Type, class... Each>
    static Rule rule_of(const Type&, const Either<Each...>& rule) {
        return either(std::apply([](const Each&... each) { return std::vector{rule_of(0.0, each)...}; }, rule.rules));
    }
    /// One number, or as many as the member holds.
    template <class Type>
    static Rule numbers(Rule one) {
        if constexpr (std::is_same_v<Type, Eigen::Vector3d>) {
            return array_of(std::move(one), 3, 3);
        } else if constexpr (requires { std::tuple_size<Type>::value; }) {
            return array_of(std::move(one), std::tuple_size_v<Type>, std::tuple_size_v<Type>);
        } else {
            return one;
        }
    }
};

/// What the description of a struct says, once for all.
template <class Struct, class Description = OwnDescription>
[[nodiscard]] const JobFields& fields_of() {
    static const JobFields k_fields = [] {
        Struct v{};
        return FieldList::fields_of(v, Description());
    }();
    return k_fields;
}

/// The keys that the description of a struct has, in its order.
template <class Struct, class Description = OwnDescription>
[[nodiscard]] std::span<const std::string_view> keys_of() {
    static const std::vector<std::string_view> k_keys = fields_of<Struct, Description>().keys();
    return k_keys;
}

/// The keys of an object and of all objects in it, object by object. What it was made of must outlive it.
class JobKeyTable {
public:
    explicit JobKeyTable(const JobFields& fields) { add("", fields); }
    JobKeyTable(const JobKeyTable&) = delete;
    JobKeyTable& operator=(const JobKeyTable&) = delete;

    [[nodiscard]] std::span<const JobKeys> objects() const { return objects_; }

private:
    void add(std::string pointer, const JobFields& fields);

    std::vector<std::unique_ptr<std::pair<std::string, std::vector<std::string_view>>>> texts_;
    std::vector<JobKeys> objects_;
};

}  // namespace gumcert::jobs
