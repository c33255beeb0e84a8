#include "reports/forms_of_number.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace gumcert::reports {

namespace {

/// `{name?one|several}` in a pattern.
struct Forms {
    std::size_t begin = 0, end = 0;
    std::string name, one, several;
};

std::optional<Forms> next_forms(const std::string& pattern, std::size_t from) {
    for (std::size_t open = pattern.find('{', from); open != std::string::npos; open = pattern.find('{', open + 1)) {
        const std::size_t close = pattern.find('}', open);
        const std::size_t question = pattern.find('?', open);
        const std::size_t bar = pattern.find('|', question);
        const bool is_name =
            question != std::string::npos && std::all_of(pattern.begin() + static_cast<std::ptrdiff_t>(open + 1),
                                                         pattern.begin() + static_cast<std::ptrdiff_t>(question),
                                                         [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
        if (close != std::string::npos && is_name && question > open + 1 && bar < close) {
            return Forms{.begin = open,
                         .end = close + 1,
                         .name = pattern.substr(open + 1, question - open - 1),
                         .one = pattern.substr(question + 1, bar - question - 1),
                         .several = pattern.substr(bar + 1, close - bar - 1)};
        }
    }
    return std::nullopt;
}

}  // namespace

std::vector<std::string> names_with_forms(const std::string& pattern) {
    std::vector<std::string> names;
    for (auto forms = next_forms(pattern, 0); forms; forms = next_forms(pattern, forms->end)) {
        if (std::find(names.begin(), names.end(), forms->name) == names.end()) {
            names.push_back(forms->name);
        }
    }
    return names;
}

std::string with_forms_of(const std::string& pattern, const std::function<bool(const std::string& name)>& is_one) {
    std::string out;
    std::size_t at = 0;
    for (auto forms = next_forms(pattern, 0); forms; forms = next_forms(pattern, forms->end)) {
        std::string form = is_one(forms->name) ? forms->one : forms->several;
        if (const std::size_t place = form.find('#'); place != std::string::npos) {
            form.replace(place, 1, "{" + forms->name + "}");
        }
        out += pattern.substr(at, forms->begin - at) + form;
        at = forms->end;
    }
    return out + pattern.substr(at);
}

}  // namespace gumcert::reports
