#include "reports/view/certificate_builder.h"

#include "certificate/statement_of_uncertainty.h"
#include "reports/printable_text.h"
#include "reports/view/certificate_view.h"
#include "text/numbers.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace gumcert::reports {

namespace {

using nlohmann::json;

std::string align_of(const Column& column) {
    return column.number ? "number" : "left";
}

/// Length of the decimals with their sign; only plain decimal numbers take part in the alignment.
std::optional<std::size_t> fraction_length(const std::string& text, const std::string& sign) {
    if (text.empty() || text.find_first_not_of("0123456789\u2212-+ " + sign) != std::string::npos) {
        return std::nullopt;
    }
    const std::size_t at = text.find(sign);
    return at == std::string::npos ? 0 : text.size() - at;
}

/// Characters; of UTF-8 those that begin one.
std::size_t length_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

bool is_decimal(const std::string& text) {
    const std::size_t from = text.starts_with("\u2212") ? std::string("\u2212").size() : text.starts_with('-') ? 1 : 0;
    return from < text.size() && text.find_first_not_of("0123456789.", from) == std::string::npos;
}

/// A text with the same decimal sign in all languages.
std::string with_one_sign(const std::string& text) {
    std::string out = text;
    for (std::size_t i = 1; i + 1 < out.size(); ++i) {
        const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
        if (out[i] == ',' && is_digit(out[i - 1]) && is_digit(out[i + 1])) {
            out[i] = '.';
        }
    }
    return out;
}

const char* name_of(RowKind kind) {
    return kind == RowKind::closing ? "closing" : kind == RowKind::part ? "part" : "plain";
}

}  // namespace

std::string with_decimal_signs(const std::string& drawing, const std::string& sign) {
    if (sign == ".") {
        return drawing;
    }
    std::string out;
    std::size_t at = 0;
    while (at < drawing.size()) {
        const std::size_t end = drawing.find("</text>", at);
        const std::size_t open = end == std::string::npos ? end : drawing.rfind('>', end);
        if (open == std::string::npos) {
            break;
        }
        const std::string text = drawing.substr(open + 1, end - open - 1);
        out +=
            drawing.substr(at, open + 1 - at) + (is_decimal(text) ? with_decimal_sign(text, sign) : text) + "</text>";
        at = end + std::string("</text>").size();
    }
    return out + drawing.substr(at);
}

std::vector<std::string> pads_of(const std::vector<std::string>& texts, const std::string& sign) {
    constexpr std::size_t k_most = 20;  // characters; decimals of all sizes do not stand below each other
    std::size_t longest = 0;
    for (const std::string& text : texts) {
        longest = std::max(longest, fraction_length(text, sign).value_or(0));
    }
    std::vector<std::string> pads(texts.size());
    std::size_t widest = 0;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        if (const auto length = fraction_length(texts[i], sign); length && *length < longest) {
            pads[i] = (*length == 0 ? sign : "") + std::string(longest - std::max<std::size_t>(*length, 1), '0');
            widest = std::max(widest, length_of(texts[i]) + pads[i].size());
        }
    }
    return widest <= k_most ? pads : std::vector<std::string>(texts.size());
}

std::string plain(double v) {
    constexpr double k_least = 1e-7;
    std::string text = text::shortest_plain(v, k_least);
    if (const std::size_t e = text.find('e'); e != std::string::npos) {  // "2e-08" as it is printed elsewhere, "2E-8"
        text[e] = 'E';
        const std::size_t first = e + (text[e + 1] == '-' || text[e + 1] == '+' ? 2 : 1);
        text.erase(first, text[first] == '0' ? 1 : 0);
    }
    return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
}

std::string plain(std::int64_t v) {
    return std::to_string(v);
}

Text degrees_of_freedom(const std::optional<double>& nu, const Wording& words) {
    return nu ? words.number(certificate::printed_degrees_of_freedom(nu)) : words("document", "infinite");
}

Text stated_degrees_of_freedom(const std::string& printed, const Wording& words) {
    return printed.starts_with('>') ? words.fill("nu_above", {{"nu", words.number(printed.substr(1))}})
                                    : words.fill("nu_one", {{"nu", words.number(printed)}});
}

void add_fact(Facts& facts, const Text& label, const Text& value) {
    if (!value.empty()) {
        facts.emplace_back(label, value);
    }
}

CertificateBuilder::CertificateBuilder(const Wording& wording)
    : wording_(wording), sections_(std::make_unique<json>(json::array())) {}

CertificateBuilder::~CertificateBuilder() = default;

nlohmann::json also(const Text& text, const std::vector<std::string>& languages) {
    if (languages.size() < 2 || !text.differs() || with_one_sign(text.in(0)) == with_one_sign(text.in(1))) {
        return json::array();
    }
    return json::array({{{"text", printable(text.in(1))}, {"language", languages[1]}}});
}

void put(nlohmann::json& object, const std::string& key, const Text& text, const std::vector<std::string>& languages) {
    object[key] = printable(text.first());
    object[key + "_also"] = also(text, languages);
}

void CertificateBuilder::section(const std::string& id) {
    section(id, wording_("heading", id));
}

void CertificateBuilder::section(const std::string& id, const Text& heading) {
    json entry = {{"id", id}, {"kind", annexes_ ? "annex" : ""}, {"blocks", json::array()}};
    put(entry, "heading",
        annexes_ ? wording_.filled("heading", outside_ ? "annex_outside" : "annex", {{"heading", heading}}) : heading,
        wording_.languages());
    sections_->push_back(std::move(entry));
}

void CertificateBuilder::paragraph(const Text& text) {
    block("paragraph", {{"text", printable(text.first())}, {"also", also(text, wording_.languages())}});
}

void CertificateBuilder::formula(const Text& text) {
    block("formula", {{"text", printable(text.first())}});
}

void CertificateBuilder::definitions(const std::vector<std::pair<Text, Text>>& rows) {
    json all = json::array();
    for (const auto& [label, value] : rows) {
        json row = json::object();
        put(row, "label", label, wording_.languages());
        put(row, "value", value.empty() ? wording_("document", "absent") : value, wording_.languages());
        all.push_back(std::move(row));
    }
    block("definitions", {{"rows", all}});
}

void CertificateBuilder::figure(const std::string& id, const Text& caption, const std::string& alternative_text,
                                const std::string& drawing) {
    json entry = {{"id", id},
                  {"alt", printable(alternative_text)},
                  {"svg", with_decimal_signs(drawing, wording_.decimal_sign())}};
    put(entry, "number", wording_("document", "figure") + " " + std::to_string(++figures_), wording_.languages());
    put(entry, "caption", caption, wording_.languages());
    block("figure", std::move(entry));
}

void CertificateBuilder::table(const std::string& id, const Text& caption, const std::vector<Column>& columns,
                               const std::vector<std::vector<Text>>& rows,
                               const std::vector<std::pair<Text, std::size_t>>& groups,
                               const std::vector<RowKind>& kinds) {
    const std::vector<std::string>& languages = wording_.languages();
    const std::string& sign = wording_.decimal_sign();
    const auto shown = [&](std::size_t row, std::size_t column) {
        // As Wording::number() prints it, and in one language: a number has no second one.
        return columns[column].number ? wording_.number(rows[row][column].first()).first() : rows[row][column].first();
    };
    std::vector<std::vector<std::string>> pads;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        std::vector<std::string> texts;
        for (std::size_t r = 0; r < rows.size() && columns[c].number; ++r) {
            texts.push_back(shown(r, c));
        }
        pads.push_back(texts.empty() ? std::vector<std::string>(rows.size()) : pads_of(texts, sign));
    }
    json heads = json::array();
    for (const Column& column : columns) {
        json head = {{"unit", column.unit.empty() ? json::array() : json::array({{{"text", printable(column.unit)}}})},
                     {"align", align_of(column)}};
        put(head, "head", column.head, languages);
        heads.push_back(std::move(head));
    }
    const std::string absent = wording_("document", "absent").first();
    json lines = json::array();
    for (std::size_t r = 0; r < rows.size(); ++r) {
        json cells = json::array();
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const std::string text = shown(r, c);
            absent_cells_ += text.empty() ? 1U : 0U;
            cells.push_back({{"text", text.empty() ? absent : printable(text)},
                             {"also", also(rows[r][c], languages)},
                             {"pad", pads[c][r]},
                             {"align", align_of(columns[c])}});
        }
        lines.push_back({{"cells", std::move(cells)}, {"kind", name_of(r < kinds.size() ? kinds[r] : RowKind::plain)}});
    }
    json spans = json::array();
    for (const auto& [text, span] : groups) {
        spans.push_back(
            {{"text", printable(text.first())}, {"also", also(text, languages)}, {"span", std::to_string(span)}});
    }
    json entry = {{"id", id},
                  {"columns", std::move(heads)},
                  {"groups", spans.empty() ? json::array() : json::array({{{"cells", std::move(spans)}}})},
                  {"rows", std::move(lines)}};
    put(entry, "number", wording_("document", "table") + " " + std::to_string(++tables_), languages);
    put(entry, "caption", caption, languages);
    block("table", std::move(entry));
}

nlohmann::json CertificateBuilder::take() {
    return std::exchange(*sections_, json::array());
}

void CertificateBuilder::block(const char* kind, nlohmann::json content) {
    json entry = {{"paragraph", json::array()},
                  {"formula", json::array()},
                  {"definitions", json::array()},
                  {"figure", json::array()},
                  {"table", json::array()}};
    entry[kind].push_back(std::move(content));
    sections_->back()["blocks"].push_back(std::move(entry));
}

}  // namespace gumcert::reports
