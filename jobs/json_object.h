#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jobs/input_text.h"
#include "jobs/problem_list.h"
#include "json/json_document.h"
#include "json/json_pointer.h"

namespace gumcert::jobs {

using gumcert::json::child_pointer;
using gumcert::json::described;
using gumcert::json::JsonDocument;

/// Reads the JSON of a job (json/strict_parser.h); `//` comments are allowed.
///
/// \param bytes     the content of the file; a UTF-8 byte order mark and CRLF are accepted
/// \param problems  receives what is wrong; its file is the name in the messages
/// \return the document; nothing when its text cannot be read to the end. With problems that let reading go on, such
///         as duplicate keys (the first one is kept), the document is returned *and* the list has refusals. A number
///         that was refused has the nlohmann type `discarded`; the readers below say nothing more about it.
[[nodiscard]] std::optional<JsonDocument> read_json_document(std::string_view bytes, ProblemList& problems);

/// The same.
/// \throws InputError with every problem
[[nodiscard]] JsonDocument parse_json_document(std::string_view bytes, const std::string& file);

/// An id, a round, the name of a point: a text of one line or a number, which is taken as its shortest text.
/// \return nothing when it was refused, here or while the text was read
[[nodiscard]] std::optional<std::string> label_of(const nlohmann::json& value, const std::string& where,
                                                  ProblemList& problems);

/// The keys of an object that stands for a table or a matrix.
inline constexpr std::array<std::string_view, 1> k_file_object_keys{"file"};

/// Typed reading of one object of a document. Every reader puts what is wrong into the list and returns nothing, so
/// that all problems of a document are found in one go.
///
/// The document, the keys and the list must outlive it.
class JsonObject {
public:
    /// \param pointer  where the object stands; it must be an object of the document
    /// \param keys     every key that it may have; any other is refused, with the nearest one as a suggestion
    JsonObject(const JsonDocument& document, std::string pointer, std::span<const std::string_view> keys,
               ProblemList& problems);

    /// The document itself as an object.
    /// \return nothing when it is not one; refused then
    [[nodiscard]] static std::optional<JsonObject> root(const JsonDocument& document,
                                                        std::span<const std::string_view> keys, ProblemList& problems);

    [[nodiscard]] bool has(std::string_view key) const;
    /// The value of a key of any type; null pointer when it is absent, or was refused while the text was read.
    [[nodiscard]] const nlohmann::json* find(std::string_view key) const;
    [[nodiscard]] std::string pointer(std::string_view key) const { return child_pointer(pointer_, key); }
    /// Where the value of a key stands, or the object when it has no such key.
    [[nodiscard]] std::string where(std::string_view key) const;
    [[nodiscard]] std::string where() const { return document_->where(pointer_); }

    // `required_…` refuses an absent key; `optional_…` returns nothing for it.
    [[nodiscard]] std::optional<double> required_number(std::string_view key, const NumberRange& range = {}) const;
    [[nodiscard]] std::optional<double> optional_number(std::string_view key, const NumberRange& range = {}) const;
    [[nodiscard]] std::optional<std::int64_t> required_integer(std::string_view key,
                                                               const NumberRange& range = {}) const;
    [[nodiscard]] std::optional<std::int64_t> optional_integer(std::string_view key,
                                                               const NumberRange& range = {}) const;
    [[nodiscard]] std::optional<bool> optional_boolean(std::string_view key) const;
    /// Text as it stands, any characters.
    [[nodiscard]] std::optional<std::string> required_string(std::string_view key) const;
    [[nodiscard]] std::optional<std::string> optional_string(std::string_view key) const;
    /// A name or title: one line, not empty, at most `longest` bytes, no control or hidden characters.
    [[nodiscard]] std::optional<std::string> required_name(std::string_view key, std::size_t longest = 256) const;
    [[nodiscard]] std::optional<std::string> optional_name(std::string_view key, std::size_t longest = 256) const;
    /// The same of at most 256 bytes, or a number, which is taken as its shortest text.
    [[nodiscard]] std::optional<std::string> optional_label(std::string_view key) const;
    [[nodiscard]] std::optional<JsonObject> required_object(std::string_view key,
                                                            std::span<const std::string_view> keys) const;
    [[nodiscard]] std::optional<JsonObject> optional_object(std::string_view key,
                                                            std::span<const std::string_view> keys) const;
    /// The array itself, for elements of any type.
    [[nodiscard]] const nlohmann::json* required_array(std::string_view key) const;
    [[nodiscard]] const nlohmann::json* optional_array(std::string_view key) const;
    /// An array of exactly `size` numbers.
    [[nodiscard]] std::optional<std::vector<double>> required_numbers(std::string_view key, std::size_t size,
                                                                      const NumberRange& range = {}) const;

    /// One of a few words, e.g. `optional_choice<Datum>("datum", {{{"home", Datum::home}}})`.
    template <typename E, std::size_t n>
    [[nodiscard]] std::optional<E> required_choice(std::string_view key,
                                                   const std::array<std::pair<std::string_view, E>, n>& choices) const {
        require(key);
        return optional_choice(key, choices);
    }
    template <typename E, std::size_t n>
    [[nodiscard]] std::optional<E> optional_choice(std::string_view key,
                                                   const std::array<std::pair<std::string_view, E>, n>& choices) const {
        std::array<std::string_view, n> words{};
        for (std::size_t i = 0; i < n; ++i) {
            words[i] = choices[i].first;
        }
        const std::optional<std::size_t> index = choice_index(key, words);
        return index ? std::optional<E>{choices[*index].second} : std::nullopt;
    }

    /// Refuses the value of a key for a reason of the caller's own.
    void refuse(const InputCode& code, std::string_view key, std::string what, std::string rule,
                std::string action) const;
    /// Refuses an absent key, with the suggestion of a key that it was perhaps mistaken for.
    bool require(std::string_view key) const;

private:
    [[nodiscard]] std::optional<std::size_t> choice_index(std::string_view key,
                                                          std::span<const std::string_view> words) const;
    [[nodiscard]] const nlohmann::json* typed(std::string_view key, nlohmann::json::value_t type,
                                              std::string_view expected) const;
    void refuse_type(const std::string& pointer, const nlohmann::json& value, std::string_view expected) const;
    [[nodiscard]] std::optional<double> number_at(const std::string& pointer, const nlohmann::json& value,
                                                  const NumberRange& range) const;

    const JsonDocument* document_;
    std::string pointer_;
    const nlohmann::json* object_;
    std::span<const std::string_view> keys_;
    ProblemList* problems_;
};

}  // namespace gumcert::jobs
