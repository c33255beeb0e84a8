#include "reports/agreement/document_words.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "json/members.h"
#include "reports/forms/pdf_page_texts.h"

namespace gumcert::reports {

using json::part_of;
using json::text_of;

namespace {

/// Whether a text of the wording is the mark of a document. They are found by their names, not listed: a document of a new
/// kind or state has a mark of its own, and is none that may be issued.
bool is_mark(std::string_view group, std::string_view key) {
    if (group == "document") {
        return key == "draft" || key == "superseded" || key == "mark" ||
               (key.ends_with("_mark") && !key.ends_with("end_mark"));
    }
    return key == "mark";
}

DocumentWords::Mark parts_of_mark(const std::string& text) {
    const std::size_t open = text.find('{');
    const std::size_t close = text.find('}');
    const bool is_filled = open != std::string::npos && close != std::string::npos && open < close;
    return {.text = text,
            .before = without_blanks(text.substr(0, is_filled ? open : std::string::npos)),
            .behind = without_blanks(is_filled ? text.substr(close + 1, text.find('{', close) - close - 1)
                                               : "")};  // up to the next value
}

}  // namespace

DocumentWords document_words(const std::vector<nlohmann::json>& wordings) {
    DocumentWords words;
    for (const nlohmann::json& wording : wordings) {
        if (std::string language = text_of(wording, "language");
            words.languages.empty() || words.languages.back() != language) {
            words.languages.push_back(std::move(language));
        }
        const nlohmann::json& of_document = part_of(wording, "document");
        words.other_templates.push_back(parts_of_mark(text_of(of_document, "changed_templates")));
        words.head_of_archive.push_back(parts_of_mark(text_of(of_document, "archive_head")));
        words.pages.push_back({without_blanks(text_of(of_document, "page")), without_blanks(text_of(of_document, "of")),
                               without_blanks(text_of(of_document, "page_end"))});
        for (const auto& [code, word] : part_of(wording, "verdict_name").items()) {
            if (word.is_string()) {
                words.verdicts.emplace_back(without_blanks(word.get<std::string>()), code);
            }
        }
        for (const auto& [group, texts] : wording.items()) {
            if (!texts.is_object()) {
                continue;  // the language
            }
            for (const auto& [key, text] : texts.items()) {
                if (text.is_string() && is_mark(group, key)) {
                    words.marks.push_back(parts_of_mark(text.get<std::string>()));
                }
            }
        }
    }
    if (words.verdicts.empty()) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0001",
                                                .where = "templates/wording",
                                                .what = "no language has words for verdicts",
                                                .rule = "every text of a document is in the wording file",
                                                .action = "take the templates of this release"});
    }
    std::sort(words.verdicts.begin(), words.verdicts.end(), [](const auto& a, const auto& b) {
        return std::tuple(b.first.size(), a.first) < std::tuple(a.first.size(), b.first);
    });
    return words;
}

}  // namespace gumcert::reports
