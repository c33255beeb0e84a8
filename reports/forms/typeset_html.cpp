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

bool is_digit_of_a_number(char c) {
    return c >= '0' && c <= '9';
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
    bool in_number_ = false, in_cell_ = false;
    std::size_t pad_digits_ = 0;

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
            in_number_ = in_cell_ && whole.find("class=\"number\"") != std::string_view::npos;
            pad_digits_ = in_number_ ? digits_of_pad(end) : 0;
        } else if (whole.starts_with("</t") || whole.starts_with("<span")) {
            in_number_ = in_cell_ = false;
        }
        out_ += html_.substr(at, end - at);
        return end;
    }

    /// Digits of the invisible continuation of the number in a cell, which count for the groups of its fraction.
    [[nodiscard]] std::size_t digits_of_pad(std::size_t from) const {
        const std::size_t close = html_.find("</td>", from);
        const std::size_t pad = html_.find("data-pad=\"", from);
        if (pad == std::string::npos || pad > close) {
            return 0;
        }
        const std::string_view rest = std::string_view(html_).substr(pad + 10, html_.find('"', pad + 10) - pad - 10);
        return static_cast<std::size_t>(std::count_if(rest.begin(), rest.end(), is_digit_of_a_number));
    }

    void text(std::string_view text) {
        if (in_cell_ && letters_.contains(text)) {
            out_ += drawn(std::string(text), "");
        } else if (in_number_) {
            number(text);
        } else {
            running(text);
        }
    }

    /// "−50000838.12" in groups, where the whole text is one number.
    void number(std::string_view text) {
        const std::size_t from = text.starts_with("−") ? std::string_view("−").size() : 0;
        const std::size_t end = std::min(text.find_first_not_of("0123456789", from), text.size());
        const bool has_fraction = end + 1 < text.size() && (text[end] == '.' || text[end] == ',');
        const std::size_t last = has_fraction ? text.find_first_not_of("0123456789", end + 1) : std::string_view::npos;
        if (end == from || (end < text.size() && !has_fraction) || last != std::string_view::npos) {
            running(text);
            return;
        }
        const std::size_t whole = end - from;
        const std::size_t fraction = has_fraction ? text.size() - end - 1 : 0;
        constexpr std::size_t k_ungrouped = 4;  // up to four digits stay together (ISO 80000-1:2022, 7.3.1)
        out_ += text.substr(0, from);
        for (std::size_t i = 0; i < whole; ++i) {
            put_digit(text[from + i], whole > k_ungrouped && i > 0 && (whole - i) % 3 == 0);
        }
        out_ += has_fraction ? std::string(1, text[end]) : "";
        for (std::size_t i = 0; i < fraction; ++i) {
            put_digit(text[end + 1 + i], fraction + pad_digits_ > k_ungrouped && i > 0 && i % 3 == 0);
        }
        for (std::size_t i = fraction; i < fraction + pad_digits_; ++i) {
            out_ += fraction + pad_digits_ > k_ungrouped && i > 0 && i % 3 == 0 ? "<span class=\"g\"></span>" : "";
        }
    }

    void put_digit(char digit, bool after_a_gap) {
        out_ += after_a_gap ? std::string("<span class=\"g\">") + digit + "</span>" : std::string(1, digit);
    }

    /// Where a number ends that has a unit behind it: the blank between them does not break.
    /// \return `at` where there is none, which may be a date or a name
    static std::size_t end_of_quantity(std::string_view text, std::size_t at) {
        const auto digits_end = [&](std::size_t from) {
            return std::min(text.find_first_not_of("0123456789", from), text.size());
        };
        std::size_t end = digits_end(at);
        if (end + 1 < text.size() && (text[end] == '.' || text[end] == ',') && is_digit_of_a_number(text[end + 1])) {
            end = digits_end(end + 1);
        }
        const bool begins = at == 0 || (text[at - 1] != '.' && text[at - 1] != ',' && text[at - 1] != '-');
        return begins && text.substr(end).starts_with("\u00A0") ? end : at;
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
            if (is_digit_of_a_number(text[at])) {
                const std::size_t behind = end_of_quantity(text, at);
                if (behind > at) {
                    number(text.substr(at, behind - at));
                    at = behind;
                    continue;
                }
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
