#include "reports/forms/asset_files.h"

#include "encoding/file_bytes.h"
#include "gum/quantity/diagnostic.h"
#include "json/strict_parser.h"
#include "reports/wording.h"
#include "text/place.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace gumcert::reports {

std::string read_asset(const std::filesystem::path& file) {
    constexpr std::size_t k_largest_asset = std::size_t{1} << 30U;
    encoding::FileBytes read = encoding::read_regular_file(file, k_largest_asset);
    if (read.bytes.empty() || !read.failure.empty() || read.too_long) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-REPORT-0002",
                            .where = file.string(),
                            .what = "missing, empty or not readable",
                            .rule = "documents are made with the templates of this release",
                            .action = "install the program again, or name the folder of templates"});
    }
    return std::move(read.bytes);
}

nlohmann::json read_json_asset(const std::filesystem::path& file) {
    return json_of_asset(read_asset(file), file);
}

nlohmann::json json_of_asset(const std::string& text, const std::filesystem::path& file) {
    const auto refuse = [](std::string where, std::string what) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0001",
                                                .where = std::move(where),
                                                .what = std::move(what),
                                                .rule = "wording files are JSON",
                                                .action = "take the templates of this release"});
    };
    std::optional<nlohmann::json> read =
        gumcert::json::parse(text, {.byte_order_mark = true}, [&](const gumcert::json::ParsingProblem& problem) {
            refuse(file.string() + " (" + text::line_and_column(problem.place) + ")", problem.what);
        });
    if (!read || !read->is_object()) {
        refuse(file.string(), "not a JSON object");
    }
    return std::move(*read);
}

namespace {

/// Texts of a laboratory in place of those of the program.
/// \param where  of `own`, for messages
/// \throws gum::StorageError for a key that the program does not have, or a text that lacks a value
void put_own_texts(nlohmann::json& texts, const nlohmann::json& own, const std::string& where) {
    for (const auto& [key, text] : own.items()) {
        const std::string at = where + "/" + key;
        const auto found = texts.find(key);
        if (found == texts.end() || found->type() != text.type()) {
            throw gum::StorageError(gum::Diagnostic{
                .code = "GC-REPORT-0007",
                .where = at,
                .what = found == texts.end() ? "a key that the wording of the program does not have" : text.type_name(),
                .rule = "a file of own wording holds keys of the wording beside it, each with a text",
                .action = "take the key as it stands there; its group is the object around it"});
        }
        if (text.is_object()) {
            put_own_texts(*found, text, at);
        } else {
            *found = text;
        }
    }
}

/// A language becomes part of a file name: letters and hyphens only.
bool is_name_of_a_language(const std::string& name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
    });
}

/// The texts of a laboratory for a language; not always there.
std::filesystem::path own_wording_file(const std::string& language, const std::filesystem::path& templates) {
    return templates / "wording" / (language + ".own.json");
}

/// \throws gum::StorageError if there is no wording of this language
nlohmann::json wording_of(const std::string& language, const RenderAssets& assets) {
    const std::filesystem::path file = assets.templates / "wording" / (language + ".json");
    if (!is_name_of_a_language(language) || !std::filesystem::is_regular_file(file)) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0006",
                                                .where = "language",
                                                .what = '"' + language + '"',
                                                .rule = "a document is printed in a language of templates/wording",
                                                .action = "choose another language, e.g. en"});
    }
    nlohmann::json texts = read_json_asset(file);
    const std::filesystem::path own = own_wording_file(language, assets.templates);
    if (std::filesystem::exists(own)) {
        put_own_texts(texts, read_json_asset(own), own.string() + "#");
    }
    return texts;
}

nlohmann::json wording_of(const std::vector<std::string>& languages, const RenderAssets& assets) {
    if (languages.size() > 2) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0006",
                                                .where = "language",
                                                .what = std::to_string(languages.size()) + " languages",
                                                .rule = "at most two languages stand side by side on a document",
                                                .action = "choose one or two, the binding one first"});
    }
    nlohmann::json all = nlohmann::json::array();
    for (const std::string& language : languages) {
        if (language != languages.front() || all.empty()) {
            all.push_back(wording_of(language, assets));
        }
    }
    all.front()[Wording::k_sentences_key] = read_json_asset(assets.templates / "wording" / "sentences.json");
    return all;
}

/// Every text with one word in place of another. Names of files and signs have none of these words.
void put_term(nlohmann::json& texts, const std::string& word, const std::string& term) {
    for (nlohmann::json& one : texts) {
        if (one.is_object()) {
            put_term(one, word, term);
        } else if (one.is_string()) {
            std::string& text = one.get_ref<std::string&>();
            for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + term.size())) {
                text.replace(at, word.size(), term);
            }
        }
    }
}

/// The terms of an accreditation body in its languages. Patterns of sentences are English, and are found by that.
void put_terms(nlohmann::json& all, const std::vector<certificate::Profile::Term>& terms) {
    nlohmann::json sentences = std::move(all.front()[Wording::k_sentences_key]);
    all.front().erase(Wording::k_sentences_key);
    for (const certificate::Profile::Term& term : terms) {
        for (nlohmann::json& texts : all) {
            if (texts.value("language", "") == term.language) {
                put_term(texts, term.word, term.term);
            }
        }
        for (nlohmann::json& sentence : sentences) {
            if (const auto text = sentence.find(term.language); term.language != "en" && text != sentence.end()) {
                nlohmann::json one = nlohmann::json::array({std::move(*text)});
                put_term(one, term.word, term.term);
                *text = std::move(one.front());
            }
        }
    }
    all.front()[Wording::k_sentences_key] = std::move(sentences);
}

using Terms = std::vector<certificate::Profile::Term>;

Wording read_wording(const RenderAssets& assets, const std::vector<std::string>& languages, const Terms& terms) {
    std::vector<std::string> key = languages;
    key.insert(key.begin(), assets.templates.string());
    for (const certificate::Profile::Term& term : terms) {
        key.insert(key.end(), {term.language, term.word, term.term});
    }
    return assets.wordings->find_or_read(key, [&] {
        nlohmann::json all = wording_of(languages, assets);
        if (!terms.empty()) {
            put_terms(all, terms);
        }
        return Wording(std::move(all));
    });
}

}  // namespace

std::vector<std::string> languages_of(const EvaluationRecord& record, const RenderAssets& assets) {
    std::vector<std::string> languages = assets.languages;
    if (languages.empty() && record.certificate) {
        languages = record.certificate->data.languages;
        languages.resize(std::min<std::size_t>(languages.size(), 2));
    }
    if (languages.empty() && record.comparison) {
        languages = record.comparison->languages;
        languages.resize(std::min<std::size_t>(languages.size(), 2));
    }
    return languages.empty() ? std::vector<std::string>{"en"} : languages;
}

RenderAssets in_one_language(RenderAssets assets) {
    assets.languages.resize(std::min<std::size_t>(assets.languages.size(), 1));
    return assets;
}

Wording read_wording(const RenderAssets& assets, const EvaluationRecord& record) {
    return read_wording(assets, languages_of(record, assets),
                        record.certificate ? record.certificate->profile.terms : Terms());
}

Wording read_wording(const RenderAssets& assets) {
    return read_wording(assets, assets.languages.empty() ? std::vector<std::string>{"en"} : assets.languages, {});
}

std::vector<nlohmann::json> read_every_wording(const std::filesystem::path& templates) {
    RenderAssets assets;
    assets.templates = templates;
    std::vector<nlohmann::json> wordings;
    for (const std::string& name : encoding::json_files_in(templates / "wording")) {
        if (!is_name_of_a_language(name)) {
            continue;
        }
        nlohmann::json texts = read_json_asset(templates / "wording" / (name + ".json"));
        if (!texts.contains("language")) {
            continue;  // sentences of all languages
        }
        texts["language"] = name;
        wordings.push_back(std::move(texts));
        if (std::filesystem::exists(own_wording_file(name, templates))) {
            wordings.push_back(wording_of(name, assets));
        }
    }
    return wordings;
}

Wording read_audit_wording(const RenderAssets& assets) {
    const std::vector<std::string> languages{assets.languages.empty() ? "en" : assets.languages.front()};
    return assets.wordings->find_or_read({assets.templates.string(), languages.front(), "audit"}, [&] {
        nlohmann::json all = wording_of(languages, assets);
        if (languages.front() != "en") {
            all.front()[Wording::k_patterns_key] =
                read_json_asset(assets.templates / "wording" / "audit_sentences.json");
        }
        return Wording(std::move(all));
    });
}

}  // namespace gumcert::reports
