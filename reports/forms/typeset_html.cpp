#include "reports/forms/typeset_html.h"

#include "reports/view/symbols.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

std::string drawn(const Symbol& symbol) {
    return "<i>" + symbol.base + "</i>" + (symbol.index.empty() ? "" : "<sub>" + symbol.index + "</sub>");
}

class Typesetter {
public:
    Typesetter(const std::string& html, const nlohmann::json& view) : html_(html), finder_(view) {}

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
    enum class Place { running, first_cell, formula };

    const std::string& html_;
    const SymbolFinder finder_;
    std::string out_;
    Place place_ = Place::running;
    bool row_begins_ = false;

    /// Copies a tag, and a whole drawing.
    /// \return where it ends
    std::size_t tag(std::size_t at) {
        std::size_t end = html_.find('>', at);
        end = end == std::string::npos ? html_.size() : end + 1;
        const std::string_view whole = std::string_view(html_).substr(at, end - at);
        if (whole.starts_with("<svg")) {
            end = std::min(html_.find("</svg>", at), html_.size());
        } else if (whole.starts_with("<tr")) {
            row_begins_ = true;
        } else if (whole.starts_with("<td")) {
            place_ = std::exchange(row_begins_, false) ? Place::first_cell : Place::running;
        } else if (whole.starts_with("</t") || whole.starts_with("<span") || whole.starts_with("</p")) {
            place_ = Place::running;
        } else if (whole.starts_with("<p class=\"formula\"")) {
            place_ = Place::formula;
        }
        out_ += html_.substr(at, end - at);
        return end;
    }

    void text(std::string_view text) {
        if (place_ == Place::first_cell && finder_.is_letter(text)) {
            out_ += drawn({.base = std::string(text), .index = {}});
            return;
        }
        for (const SymbolPiece& piece :
             place_ == Place::formula ? finder_.pieces_of_formula(text) : finder_.pieces(text)) {
            out_ += piece.symbol.base.empty() ? piece.text : drawn(piece.symbol);
        }
    }
};

}  // namespace

std::string typeset_html(const std::string& html, const nlohmann::json& view) {
    return Typesetter(html, view).typeset();
}

}  // namespace gumcert::reports
