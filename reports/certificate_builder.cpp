#include "reports/certificate_builder.h"

#include "reports/certificate_view.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace gumcert::reports {

namespace {

using nlohmann::json;

std::string align_of(const Column& column) {
    return column.number ? "number" : "left";
}

/// Position of the decimal sign, or the end; only plain decimal numbers take part in the alignment.
std::optional<std::size_t> fraction_length(const std::string& text) {
    if (text.empty() || text.find_first_not_of("0123456789.\u2212-+ ") != std::string::npos) {
        return std::nullopt;
    }
    const std::size_t point = text.find('.');
    return point == std::string::npos ? 0 : text.size() - point;
}

const char* name_of(RowKind kind) {
    return kind == RowKind::closing ? "closing" : kind == RowKind::part ? "part" : "plain";
}

}  // namespace

std::string plain(double v) {
    std::array<char, 64> buffer{};
    char* const last = buffer.data() + buffer.size();
    const bool ordinary = v == 0.0 || (std::abs(v) >= 1e-7 && std::abs(v) < 1e12);
    const auto end = (ordinary ? std::to_chars(buffer.data(), last, v, std::chars_format::fixed)
                               : std::to_chars(buffer.data(), last, v))
                         .ptr;
    std::string text(buffer.data(), end);
    return !text.empty() && text.front() == '-' ? "\u2212" + text.substr(1) : text;
}

std::string plain(std::int64_t v) {
    return std::to_string(v);
}

std::string fixed(double v, int decimals) {
    std::array<char, 512> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), v, std::chars_format::fixed, decimals).ptr;
    return {buffer.data(), end};
}

std::string whole_below(double v) {
    return v < 10000.0 ? fixed(std::floor(v * (1.0 + 1e-12)), 0) : ">9999";  // 3.999…9 is 4
}

std::string degrees_of_freedom(double v) {
    if (v >= 100.0) {
        return whole_below(v);
    }
    const std::string text = fixed(v, 1);
    return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

CertificateBuilder::CertificateBuilder(const Wording& wording)
    : wording_(wording), sections_(std::make_unique<json>(json::array())) {}

CertificateBuilder::~CertificateBuilder() = default;

void CertificateBuilder::section(const std::string& id) {
    section(id, wording_("heading", id));
}

void CertificateBuilder::section(const std::string& id, const std::string& heading) {
    sections_->push_back({{"id", id}, {"heading", printable(heading)}, {"blocks", json::array()}});
}

void CertificateBuilder::paragraph(const std::string& text) {
    block("paragraph", {{"text", printable(text)}});
}

void CertificateBuilder::formula(const std::string& text) {
    block("formula", {{"text", printable(text)}});
}

void CertificateBuilder::definitions(const std::vector<std::pair<std::string, std::string>>& rows) {
    json all = json::array();
    for (const auto& [label, value] : rows) {
        all.push_back({{"label", printable(label)},
                       {"value", value.empty() ? wording_("document", "absent") : printable(value)}});
    }
    block("definitions", {{"rows", all}});
}

void CertificateBuilder::figure(const std::string& id, const std::string& caption, const std::string& alternative_text,
                                const std::string& drawing) {
    block("figure", {{"id", id},
                     {"number", wording_("document", "figure") + " " + std::to_string(++figures_)},
                     {"caption", printable(caption)},
                     {"alt", printable(alternative_text)},
                     {"svg", drawing}});
}

void CertificateBuilder::table(const std::string& id, const std::string& caption, const std::vector<Column>& columns,
                               const std::vector<std::vector<std::string>>& rows,
                               const std::vector<std::pair<std::string, std::size_t>>& groups,
                               const std::vector<RowKind>& kinds) {
    std::vector<std::size_t> longest(columns.size(), 0);
    for (const auto& row : rows) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            longest[c] = std::max(longest[c], fraction_length(row[c]).value_or(0));
        }
    }
    json heads = json::array();
    for (const Column& column : columns) {
        heads.push_back(
            {{"head", printable(column.head)},
             {"unit", column.unit.empty() ? json::array() : json::array({{{"text", printable(column.unit)}}})},
             {"align", align_of(column)}});
    }
    json lines = json::array();
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const auto& row = rows[r];
        json cells = json::array();
        for (std::size_t c = 0; c < columns.size(); ++c) {
            std::string pad;
            if (const auto length = fraction_length(row[c]); columns[c].number && length && *length < longest[c]) {
                pad = (*length == 0 ? "." : "") + std::string(longest[c] - std::max<std::size_t>(*length, 1), '0');
            }
            const std::string text = row[c].empty() ? wording_("document", "absent") : printable(row[c]);
            cells.push_back({{"text", text}, {"pad", pad}, {"align", align_of(columns[c])}});
        }
        lines.push_back({{"cells", std::move(cells)}, {"kind", name_of(r < kinds.size() ? kinds[r] : RowKind::plain)}});
    }
    json spans = json::array();
    for (const auto& [text, span] : groups) {
        spans.push_back({{"text", text}, {"span", std::to_string(span)}});
    }
    block("table", {{"id", id},
                    {"number", wording_("document", "table") + " " + std::to_string(++tables_)},
                    {"caption", printable(caption)},
                    {"columns", std::move(heads)},
                    {"groups", spans.empty() ? json::array() : json::array({{{"cells", std::move(spans)}}})},
                    {"rows", std::move(lines)}});
}

nlohmann::json CertificateBuilder::take() {
    return std::exchange(*sections_, json::array());
}

void CertificateBuilder::block(const char* kind, const nlohmann::json& content) {
    json entry = {{"paragraph", json::array()},
                  {"formula", json::array()},
                  {"definitions", json::array()},
                  {"figure", json::array()},
                  {"table", json::array()}};
    entry[kind].push_back(content);
    sections_->back()["blocks"].push_back(std::move(entry));
}

}  // namespace gumcert::reports
