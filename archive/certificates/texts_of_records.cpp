#include "archive/certificates/texts_of_records.h"

#include <algorithm>

#include "gum/expression/name_spelling.h"

namespace gumcert::archive {

namespace {

/// Without spelling there are no blanks between words; but "std171" is another standard than "std17".
bool contains_name(std::string_view text, std::string_view name) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        const bool goes_on = end < text.size() && is_digit(text[end]) && is_digit(name.back());
        const bool began_before = at > 0 && is_digit(text[at - 1]) && is_digit(name.front());
        if (!goes_on && !began_before) {
            return true;
        }
    }
    return false;
}

}  // namespace

void TextsOfRecords::add(std::size_t record, const RecordReferences& references) {
    for (const StandardReference& one : references.references) {
        const auto [text, is_new] = records_.try_emplace(one.text);
        if (text->second.empty() || text->second.back() != record) {
            text->second.push_back(record);
        }
        if (!is_new) {
            continue;
        }
        for (const std::string_view word : plain_words_of(text->first)) {
            std::vector<const Text*>& with_word = with_word_[word];
            if (with_word.empty() || with_word.back() != &*text) {
                with_word.push_back(&*text);
            }
        }
    }
}

std::set<std::size_t> TextsOfRecords::that_name(const std::string& name) const {
    std::set<std::size_t> found;
    const auto look_at = [&](const Text& one) {
        if (names(one.first, name)) {
            found.insert(one.second.begin(), one.second.end());
        }
    };
    const std::vector<std::string_view> words = plain_words_of(name);
    if (words.empty()) {
        std::for_each(records_.begin(), records_.end(), look_at);
        return found;
    }
    static const std::vector<const Text*> k_none;
    const std::vector<const Text*>* rarest = nullptr;
    for (const std::string_view word : words) {
        const auto with_word = with_word_.find(word);
        const std::vector<const Text*>& these = with_word == with_word_.end() ? k_none : with_word->second;
        rarest = rarest == nullptr || these.size() < rarest->size() ? &these : rarest;
    }
    for (const Text* const one : *rarest) {
        look_at(*one);
    }
    return found;
}

std::set<std::string> TextsOfRecords::that_may_mean(const std::string& name) const {
    std::set<std::string> found;
    const std::string wanted = gum::without_spelling(name);
    for (const auto& [text, records] : records_) {
        if (!wanted.empty() && !names(text, name) && contains_name(gum::without_spelling(text), wanted)) {
            found.insert(text);
        }
    }
    return found;
}

}  // namespace gumcert::archive
