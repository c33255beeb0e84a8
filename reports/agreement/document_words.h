#pragma once

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

/// Words of documents, in every language that the templates have.
struct DocumentWords {
    std::vector<std::pair<std::string, std::string>> verdicts;  ///< as printed; code: "pass". The longest first
    struct Mark {
        std::string text;            ///< "SUPERSEDED by {number}"
        std::string before, behind;  ///< of the value that is filled in, as printed
    };
    /// What says that a document is no issued certificate, of every kind and state that the wording knows: a draft, a
    /// specimen, superseded, internal, an audit.
    std::vector<Mark> marks;
    std::vector<Mark> other_templates;              ///< what is printed where the templates were changed
    std::vector<Mark> head_of_archive;              ///< and where a head of the archive is
    std::vector<std::array<std::string, 3>> pages;  ///< what stands around the numbers of "page 1 of 3", without blanks
    std::vector<std::string> languages;             ///< "en", "zh-Hant"
};
/// \param wordings  of every language, as read_every_wording() has them
/// \throws gum::StorageError  if none of them has words for verdicts
[[nodiscard]] DocumentWords document_words(const std::vector<nlohmann::json>& wordings);

}  // namespace gumcert::reports
