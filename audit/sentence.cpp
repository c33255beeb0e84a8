#include "audit/sentence.h"

#include <algorithm>

namespace gumcert::audit {

PatternPieces pattern_pieces(std::string_view pattern) {
    PatternPieces pieces;
    for (std::size_t open = pattern.find('{'); open != std::string_view::npos; open = pattern.find('{')) {
        const std::size_t close = std::min(pattern.find('}', open), pattern.size() - 1);
        const std::string_view inside = pattern.substr(open + 1, close - open - 1);
        pieces.literals.push_back(pattern.substr(0, open));
        pieces.places.push_back({.name = inside.substr(0, inside.find(':')),
                                 .is_number = inside.ends_with(":number"),
                                 .is_sentence = inside.ends_with(":sentence")});
        pattern.remove_prefix(close + 1);
    }
    pieces.literals.push_back(pattern);
    return pieces;
}

Sentence::Sentence(std::string_view pattern, std::vector<Sentence> arguments)
    : pattern_(pattern), arguments_(std::move(arguments)) {
    const PatternPieces pieces = pattern_pieces(pattern_);
    for (std::size_t i = 0; i < pieces.literals.size(); ++i) {
        english_ += pieces.literals[i];
        english_ += i < pieces.places.size() ? arguments_.at(i).english_ : "";
    }
}

Sentence Sentence::with_texts(const std::function<std::string(const std::string&)>& change) const {
    if (pattern_.empty()) {
        return change(english_);
    }
    std::vector<Sentence> arguments;
    arguments.reserve(arguments_.size());
    for (const Sentence& argument : arguments_) {
        arguments.push_back(argument.with_texts(change));
    }
    return {pattern_, std::move(arguments)};
}

Sentence say_count(std::size_t count, Pattern<1> one, Pattern<1> several) {
    return say(count == 1 ? one : several, std::to_string(count));
}

Sentence say_number(std::string shown) {
    return say("{number:number}", std::move(shown));
}

Sentence equals(Sentence symbol, Sentence shown) {
    return say("{symbol} = {value:number}", std::move(symbol), std::move(shown));
}

Sentence joined(const std::vector<Sentence>& sentences) {
    Sentence all;
    for (const Sentence& one : sentences) {
        all = &one == &sentences.front() ? one : say("{before}, {next}", std::move(all), one);
    }
    return all;
}

Sentence all_of(const std::vector<Sentence>& sentences) {
    if (sentences.size() < 2) {
        return joined(sentences);
    }
    return say("{before} and {last}", joined({sentences.begin(), sentences.end() - 1}), sentences.back());
}

Sentence listed(const std::vector<Sentence>& sentences, std::size_t most) {
    if (sentences.size() <= most) {
        return joined(sentences);
    }
    return say("{named} and {count:number} more",
               joined({sentences.begin(), sentences.begin() + static_cast<std::ptrdiff_t>(most)}),
               std::to_string(sentences.size() - most));
}

std::vector<Sentence> sentences_of(const std::vector<std::string>& texts) {
    return {texts.begin(), texts.end()};
}

}  // namespace gumcert::audit
