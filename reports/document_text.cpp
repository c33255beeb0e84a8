#include "reports/document_text.h"

#include <algorithm>

namespace gumcert::reports {

const std::string& Text::in(std::size_t language) const {
    return texts_[texts_.size() == 1 ? 0 : std::min(language, texts_.size() - 1)];
}

bool Text::empty() const {
    return std::all_of(texts_.begin(), texts_.end(), [](const std::string& text) { return text.empty(); });
}

bool Text::differs() const {
    return std::any_of(texts_.begin(), texts_.end(), [&](const std::string& text) { return text != texts_.front(); });
}

Text& Text::operator+=(const Text& other) {
    if (texts_.size() < other.texts_.size()) {
        texts_.resize(other.texts_.size(), texts_.back());
    }
    for (std::size_t i = 0; i < texts_.size(); ++i) {
        // A copy: a text may be added to itself.
        const std::string more = other.in(i);
        texts_[i] += more;
    }
    return *this;
}

}  // namespace gumcert::reports
