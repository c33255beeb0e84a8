#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jobs/job_fields.h"
#include "jobs/job_files.h"
#include "jobs/json_object.h"

namespace gumcert::jobs {

/// The archive that reads an object of a job into its struct (jobs/job_fields.h), in SI. What is absent or was
/// refused stays as it is in the struct.
///
/// Messages come in the order of the description, so code that checks one key against another reads in steps:
/// `reader.read(v, {"u"})`, its check, and then the rest.
class JobReader {
public:
    /// \param object  with keys_of() the struct; must outlive the reader
    explicit JobReader(const JsonObject& object) : object_(object) {}

    template <class Struct, class Description = OwnDescription>
    void read(Struct& v, const Description& description = {}) {
        only_ = {};
        description(*this, v);
    }
    /// \param keys  those that are read now
    template <class Struct>
    void read(Struct& v, std::initializer_list<std::string_view> keys) {
        only_ = {keys.begin(), keys.size()};
        describe(*this, v);
    }
    /// Whether the value of a key was read, and not refused.
    [[nodiscard]] bool accepted(std::string_view key) const {
        return std::find(accepted_.begin(), accepted_.end(), key) != accepted_.end();
    }
    /// An accepted number in the unit of the job.
    [[nodiscard]] std::optional<double> number(std::string_view key) const {
        return accepted(key) ? std::optional(object_.find(key)->get<double>()) : std::nullopt;
    }

    // What a description calls.

    template <class Type, class Rule>
    void operator()(std::string_view key, Type& v, const Rule& rule, std::string_view) {
        if (is_wanted(key)) {
            accept(key, v, rule);
        }
    }
    template <class Type, class Rule>
    void needed(std::string_view key, Type& v, const Rule& rule, std::string_view) {
        if (is_wanted(key)) {
            (void)object_.require(key);
            accept(key, v, rule);
        }
    }
    template <class Struct, class Description = OwnDescription>
    void part(std::string_view key, Struct& v, std::string_view, const Description& description = {}) {
        if (is_wanted(key)) {
            read_part(key, v, description);
        }
    }
    template <class Struct, class Description = OwnDescription>
    void needed_part(std::string_view key, Struct& v, std::string_view, const Description& description = {}) {
        if (is_wanted(key)) {
            (void)object_.require(key);
            read_part(key, v, description);
        }
    }
    static void constant(std::string_view, std::string_view, std::string_view) {}
    template <class Struct>
    static void list(std::string_view, std::vector<Struct>&, std::string_view, ListSize = {}) {}
    template <class Struct>
    static void needed_list(std::string_view, std::vector<Struct>&, std::string_view, ListSize = {}) {}
    template <class Struct>
    static void named(std::string_view, std::vector<Struct>&, std::string_view, ListSize = {}) {}
    template <class Struct>
    static void needed_named(std::string_view, std::vector<Struct>&, std::string_view, ListSize = {}) {}
    template <class Rule>
    static void by_code(std::string_view, const Rule&, std::string_view) {}
    template <class Rule>
    static void needed_by_code(std::string_view, const Rule&, std::string_view) {}
    template <class Rule, class Struct>
    static void part_or(std::string_view, const Rule&, Struct&, std::string_view) {}
    template <class Rule, class Struct>
    static void list_or(std::string_view, const Rule&, std::vector<Struct>&, std::string_view, ListSize = {}) {}
    static void by_hand(std::string_view, std::string_view, std::string_view, std::string_view) {}
    static void needed_by_hand(std::string_view, std::string_view, std::string_view, std::string_view) {}
    static void definition(std::string_view, std::string_view = {}) {}
    static void at_least_one_of(std::initializer_list<std::string_view>) {}
    static void exactly_one_of(std::initializer_list<std::string_view>) {}
    static void at_most_one_of(std::initializer_list<std::string_view>) {}
    static void needs(std::string_view, std::string_view) {}
    static void all_need(std::span<const std::string_view>, std::string_view) {}

private:
    const JsonObject& object_;
    std::span<const std::string_view> only_;
    std::vector<std::string_view> accepted_;

    [[nodiscard]] bool is_wanted(std::string_view key) const {
        return only_.empty() || std::find(only_.begin(), only_.end(), key) != only_.end();
    }

    template <class Type, class Rule>
    void accept(std::string_view key, Type& v, const Rule& rule) {
        if (read_value(key, v, rule)) {
            accepted_.push_back(key);
        }
    }

    template <class Struct, class Description>
    void read_part(std::string_view key, Struct& v, const Description& description) {
        if constexpr (requires { v.has_value(); }) {
            using Inner = typename Struct::value_type;
            if (const auto object = object_.optional_object(key, keys_of<Inner, Description>())) {
                v = Inner{};
                JobReader(*object).read(*v, description);
            }
        } else if (const auto object = object_.optional_object(key, keys_of<Struct, Description>())) {
            JobReader(*object).read(v, description);
        }
    }

    template <class Type>
    bool read_value(std::string_view key, Type& v, const In& rule) {
        if constexpr (requires { std::tuple_size<Type>::value; } || std::is_same_v<Type, Eigen::Vector3d>) {
            return read_numbers(key, v, rule.range, rule.unit);
        } else {
            const std::optional<double> number = object_.optional_number(key, rule.range);
            if (!number || (rule.then && !object_.optional_number(key, *rule.then))) {
                return false;
            }
            v = *number * rule.unit;
            return true;
        }
    }
    template <class Type>
    bool read_value(std::string_view key, Type& v, const Whole& rule) {
        if constexpr (requires { std::tuple_size<Type>::value; }) {
            return read_numbers(key, v, rule.range, 1.0);
        } else if constexpr (requires { v.has_value(); }) {
            typename Type::value_type number{};
            if (!read_value(key, number, rule)) {
                return false;
            }
            v = number;
            return true;
        } else {
            const std::optional<std::int64_t> number = object_.optional_integer(key, rule.range);
            if (number) {
                v = static_cast<Type>(*number);
            }
            return number.has_value();
        }
    }
    bool read_value(std::string_view key, bool& v, const Truth&) { return take(object_.optional_boolean(key), v); }
    template <class Type>
    bool read_value(std::string_view key, Type& v, const Line& rule) {
        return take(object_.optional_name(key, rule.longest), v);
    }
    template <class Type>
    bool read_value(std::string_view key, Type& v, const AnyText&) {
        return take(object_.optional_string(key), v);
    }
    template <class Type>
    bool read_value(std::string_view key, Type& v, const Label&) {
        return take(object_.optional_label(key), v);
    }
    bool read_value(std::string_view key, std::optional<std::string>& v, const FileName&) {
        return take(JobFiles::file_name(object_, key, false), v);
    }
    template <class Type, class E, std::size_t n>
    bool read_value(std::string_view key, Type& v, const Words<E, n>& words) {
        return take(object_.optional_choice<E>(key, words), v);
    }

    template <class Read, class Type>
    static bool take(std::optional<Read> read, Type& v) {
        if (read) {
            v = *std::move(read);
        }
        return read.has_value();
    }
    template <class Numbers>
    bool read_numbers(std::string_view key, Numbers& v, const NumberRange& range, double unit) {
        const auto size = static_cast<std::size_t>(v.size());
        const auto numbers = object_.has(key) ? object_.required_numbers(key, size, range) : std::nullopt;
        for (std::size_t i = 0; numbers && i < size; ++i) {
            v[static_cast<decltype(v.size())>(i)] = (*numbers)[i] * unit;
        }
        return numbers.has_value();
    }
};

}  // namespace gumcert::jobs
