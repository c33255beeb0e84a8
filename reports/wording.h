#pragma once

#include "certificate/localised_text.h"
#include "gum/quantity/diagnostic.h"
#include "reports/document_text.h"
#include "reports/program_sentences.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

/// Labels and sentences of a document in the languages that it is printed in (templates/wording/<language>.json), the
/// binding one first. A text that is missing in any of them is an error: a document is never printed with a hole.
class Wording {
public:
    static constexpr const char* k_sentences_key = "sentences_of_the_program";
    static constexpr const char* k_patterns_key = "patterns_of_the_audit";

    using Values = std::vector<std::pair<std::string, Text>>;

    /// \param texts  the object of a wording file, or an array of several. The first one may hold the catalogue of
    ///               ProgramSentences under k_sentences_key; read_wording() puts it there.
    explicit Wording(nlohmann::json texts);

    /// Codes of the languages: "de", "en".
    [[nodiscard]] const std::vector<std::string>& languages() const { return languages_; }
    [[nodiscard]] const std::string& language() const { return languages_.front(); }  ///< the binding one
    [[nodiscard]] const std::string& decimal_sign() const { return signs_.front(); }  ///< of the binding language

    [[nodiscard]] Text operator()(const std::string& group, const std::string& name) const;
    [[nodiscard]] Text operator()(const std::string& group, const std::string& name, const std::string& item) const;
    /// Whether there is a text that stands by itself: names that data bring are looked up by this. A text with a place for a value
    /// is none; it is for filled() alone.
    [[nodiscard]] bool has(const std::string& group, const std::string& name) const;
    /// All texts of a group in the binding language, for templates.
    /// \throws gum::StorageError if the wording does not have it
    [[nodiscard]] const nlohmann::json& group(const std::string& name) const;

    /// A text with every `{name}` replaced, and its forms of number chosen (forms_of_number.h). Values are placed once.
    /// \throws gum::StorageError if the text names a value that is not given
    [[nodiscard]] Text filled(const std::string& group, const std::string& name, const Values& values) const;
    [[nodiscard]] Text fill(const std::string& sentence, const Values& values) const {
        return filled("sentence", sentence, values);
    }

    /// A printed number, alone or with its unit, with the decimal sign of each language and U+2212 as its minus sign.
    /// The digits stay as they are.
    [[nodiscard]] Text number(const std::string& printed) const;

    /// A sentence that the record holds in English, in each language of the document; see ProgramSentences. English
    /// where the catalogue does not know it.
    [[nodiscard]] Text sentence(const std::string& english) const;
    /// \param otherwise  stands in place of English in the other languages where the catalogue does not know it
    [[nodiscard]] Text sentence(const std::string& english, const Text& otherwise) const;

    /// The translation of an English pattern of the audit into the binding language: of the object that stands under
    /// k_patterns_key in the first wording, `{"U = {U:number} …": {"de": "…", …}}`.
    [[nodiscard]] std::optional<std::string> pattern(std::string_view english) const;

    /// A message as gum::message() makes it, its parts in each language of the document.
    [[nodiscard]] Text message(const gum::Diagnostic& diagnostic) const;

    /// A text of the certificate data in each language of the document.
    [[nodiscard]] Text localised(const certificate::LocalisedText& text) const;

private:
    std::shared_ptr<const nlohmann::json> all_;  ///< shared by copies of this object
    std::vector<const nlohmann::json*> texts_;   ///< one a language, in all_
    std::vector<std::string> languages_;
    std::vector<std::string> signs_;
    std::shared_ptr<const ProgramSentences> sentences_;  ///< none: records are printed in English

    [[nodiscard]] Text text_of(const std::vector<std::string>& path) const;
};

/// "1.2E-6" as "1.2 × 10⁻⁶", with blanks that do not break; other texts as they are.
[[nodiscard]] std::string with_power_of_ten(const std::string& text);
/// The same with U+2212 for the hyphen of each number: "-0.008; -0.010 mg". Other hyphens stay.
[[nodiscard]] std::string with_minus_of_numbers(const std::string& text);
/// Appends a value to a text: "p = " and "<1E-300" are "p < 1E-300".
void append_value(std::string& text, const std::string& value);

/// A text with `sign` in place of every point that stands between two digits.
[[nodiscard]] std::string with_decimal_sign(const std::string& text, const std::string& sign);

}  // namespace gumcert::reports
