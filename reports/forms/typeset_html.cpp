#include "reports/forms/typeset_html.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using nlohmann::json;

bool is_of_a_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string drawn(const std::string& base, const std::string& index) {
    return "<i>" + base + "</i>" + (index.empty() ? "" : "<sub>" + index + "</sub>");
}

class Typesetter {
public:
    Typesetter(const std::string& html, const json& view) : html_(html) {
        for (const json& symbol : view.value("symbols", json::array())) {
            const std::string text = symbol.at("text").get<std::string>();
            drawings_[text] = drawn(symbol.at("base").get<std::string>(), symbol.at("index").get<std::string>());
            if (!text.empty() && !is_of_a_name(text[0])) {
                others_.push_back(text);
            }
        }
        for (const json& letter : view.value("letters", json::array())) {
            letters_.insert(letter.at("text").get<std::string>());
        }
    }

    std::string typeset() {
        const std::size_t body = std::min(html_.find("<body"), html_.size());
        out_ = html_.substr(0, body);
        for (std::size_t at = body; at < html_.size();) {
            const std::size_t open = std::min(html_.find('<', at), html_.size());
            text(std::string_view(html_).substr(at, open - at));
            at = open;
            if (at < html_.size()) {
                at = tag(at);
            }
        }
        return std::move(out_);
    }

private:
    const std::string& html_;
    std::string out_;
    std::map<std::string, std::string, std::less<>> drawings_;
    std::vector<std::string> others_;  ///< symbols that begin with a letter of another script
    std::set<std::string, std::less<>> letters_;
    bool in_cell_ = false;

    /// Copies a tag, and a whole drawing.
    /// \return where it ends
    std::size_t tag(std::size_t at) {
        std::size_t end = html_.find('>', at);
        end = end == std::string::npos ? html_.size() : end + 1;
        const std::string_view whole = std::string_view(html_).substr(at, end - at);
        if (whole.starts_with("<svg")) {
            end = std::min(html_.find("</svg>", at), html_.size());
        } else if (whole.starts_with("<td") || whole.starts_with("<th")) {
            in_cell_ = whole.starts_with("<td") && !whole.starts_with("<thead");
        } else if (whole.starts_with("</t") || whole.starts_with("<span")) {
            in_cell_ = false;
        }
        out_ += html_.substr(at, end - at);
        return end;
    }

    void text(std::string_view text) {
        if (in_cell_ && letters_.contains(text)) {
            out_ += drawn(std::string(text), "");
        } else {
            running(text);
        }
    }

    void running(std::string_view text) {
        for (std::size_t at = 0; at < text.size();) {
            std::size_t end = at;
            const auto other = std::find_if(others_.begin(), others_.end(),
                                            [&](const std::string& s) { return text.substr(at).starts_with(s); });
            if (other != others_.end()) {
                end = at + other->size();
            } else if (is_of_a_name(text[at])) {
                end = std::min(static_cast<std::size_t>(std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                                         text.end(), is_of_a_name) -
                                                        text.begin()),
                               text.size());
            } else {
                out_ += text[at++];
                continue;
            }
            const std::string_view name = text.substr(at, end - at);
            const bool goes_on = other != others_.end() && end < text.size() && is_of_a_name(text[end]);
            const auto found = drawings_.find(name);
            out_ += found == drawings_.end() || goes_on ? name : std::string_view(found->second);
            at = end;
        }
    }
};

}  // namespace

std::string typeset_html(const std::string& html, const json& view) {
    return Typesetter(html, view).typeset();
}

}  // namespace gumcert::reports
