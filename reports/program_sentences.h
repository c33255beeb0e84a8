#pragma once

#include "reports/record/identified_sentence.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

/// The sentences that the program writes into a record in English (findings, remarks, notes, messages), each with its
/// id and its wording in every language: templates/wording/sentences.json.
///
///     "finding/T01": {"en": "the calibration of {standard:sentence} was valid to {date}, …", "de": "…", …}
///
/// A sentence is found by its English pattern, as a translation is found in a catalogue of messages: layers that make
/// sentences know no wording, and a record of an earlier release is worded as well. What a placeholder stands for is
/// taken from the sentence and is never changed, except by its kind in the English pattern:
///
///     {name}            as it is: names, what a person wrote
///     {name:number}     a number, alone or with its unit; gets the decimal sign of the language
///     {name:list}       numbers or phrases of the catalogue with commas between them
///     {name:sentence}   one or several sentences or phrases of the catalogue; as it is where it is none
///
/// `{{` and `}}` are braces. Forms of number, `{points} {points?point|points}` (forms_of_number.h), make several patterns of
/// one, in every language the same forms; only values that English has forms of may have some. A pattern with more letters of its own is preferred to one with fewer.
class ProgramSentences {
public:
    /// \param catalogue  the object of sentences.json; copied
    /// \throws gum::StorageError if a pattern cannot be read
    explicit ProgramSentences(const nlohmann::json& catalogue);
    ~ProgramSentences();
    ProgramSentences(ProgramSentences&&) noexcept;
    ProgramSentences& operator=(ProgramSentences&&) noexcept;
    ProgramSentences(const ProgramSentences&) = delete;
    ProgramSentences& operator=(const ProgramSentences&) = delete;

    /// The sentence, or the sentences one after the other ("…. …", "…; …"), that a text consists of; none where a part
    /// of it is not in the catalogue.
    [[nodiscard]] std::optional<std::vector<IdentifiedSentence>> identified(const std::string& english) const;

    /// The text in a language. Parts that are not in the catalogue, or not in that language, stay in English.
    /// \param sign  decimal sign of the language
    [[nodiscard]] std::string worded(const std::string& english, const std::string& language,
                                     const std::string& sign) const;

private:
    struct Pattern;
    struct Found;
    std::unique_ptr<const std::vector<Pattern>> patterns_;

    [[nodiscard]] bool holds_another(const Found& found) const;
    [[nodiscard]] std::optional<Found> find(const std::string& text) const;
    [[nodiscard]] std::string worded_list(const std::string& english, const std::string& language,
                                          const std::string& sign) const;
    [[nodiscard]] std::vector<std::pair<std::string, std::optional<Found>>> parts(const std::string& text) const;
};

}  // namespace gumcert::reports
