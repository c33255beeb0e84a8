#include "reports/dcc/dcc_writer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "certificate/section_data.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "reports/dcc/d_si_unit.h"
#include "reports/record/certified_tables.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

constexpr std::string_view k_not_a_number = "NaN";

bool is_a_digit(char c) {
    return c >= '0' && c <= '9';
}

std::size_t digits_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && is_a_digit(text[end])) {
        ++end;
    }
    return end - at;
}

/// Digits with a point and at least one digit; the length of it, 0 where there is none.
std::size_t plain_decimal_at(std::string_view text, std::size_t at) {
    const std::size_t before = digits_at(text, at);
    std::size_t length = before;
    if (at + length < text.size() && text[at + length] == '.') {
        const std::size_t after = digits_at(text, at + length + 1);
        if (before + after == 0) {
            return 0;
        }
        length += 1 + after;
    }
    return length;
}

bool is_number(std::string_view text) {
    std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const std::size_t length = plain_decimal_at(text, at);
    at += length;
    if (length > 0 && at < text.size() && (text[at] == 'E' || text[at] == 'e')) {
        ++at;
        at += at < text.size() && (text[at] == '-' || text[at] == '+') ? 1U : 0U;
        const std::size_t exponent = digits_at(text, at);
        return exponent > 0 && at + exponent == text.size();
    }
    return length > 0 && at == text.size();
}

/// A record may print U+2212; D-SI wants the ASCII sign.
std::string with_ascii_minus(const std::string& printed) {
    constexpr std::string_view k_minus = "\u2212";
    return printed.starts_with(k_minus) ? "-" + printed.substr(k_minus.size()) : printed;
}

std::string one_line(const std::string& text) {
    std::string line;
    for (const std::string& word : xml_list(text)) {
        line += (line.empty() ? "" : " ") + word;
    }
    return line;
}

}  // namespace

DccWriter::DccWriter(const EvaluationRecord& record, const Wording& words, const RefTypes& ref_types)
    : record_(record), words_(words), ref_types_(ref_types) {
    if (record.certificate) {
        data_ = record.certificate->data;
        tables_ = record.certificate->tables;
    } else {
        tables_ = certified_tables(record);
    }
    for (const std::string& language : words.languages()) {
        languages_.push_back(iso_639_1(language));
    }
    pieces_ = SetPieces(record, [this](const std::string& section) { return item_id(section); });
}

void DccWriter::enter_section(const std::string& section) {
    section_ = Section{.data = certificate::data_of_section(data_, section), .tables = {}};
    std::copy_if(tables_.begin(), tables_.end(), std::back_inserter(section_->tables),
                 [&](const certificate::CertifiedTable& table) { return table.section == section; });
}

std::string DccWriter::item_id(const std::string& section) const {
    // One instrument that several sections are about is one item, with one id.
    std::vector<const certificate::Item*> items;
    if (!certificate::stated_by_sections(data_, tables_).item) {
        items.push_back(&data_.item);
    } else {
        items.push_back(nullptr);  // the first id is that of the item of the certificate, also where it states none
    }
    for (const certificate::SectionData& own : data_.sections) {
        if (!own.item) {
            continue;
        }
        auto known = std::find_if(items.begin(), items.end(), [&](const certificate::Item* item) {
            return item != nullptr && certificate::is_same_item(*item, *own.item);
        });
        if (known == items.end()) {
            known = items.insert(known, &*own.item);
        }
        if (own.section == section) {
            return "item_" + std::to_string(known - items.begin() + 1);
        }
    }
    return "item_1";
}

Text DccWriter::not_stated() const {
    return words_("dcc", is_specimen() ? "not_stated_specimen" : "not_stated");
}

bool DccWriter::is_decided(const std::string& specification) const {
    for (const certificate::CertifiedTable& table : tables_) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            for (const certificate::CertifiedValue& value : column.values) {
                if (value.verdict && value.verdict->specification == specification) {
                    return true;
                }
            }
        }
    }
    return false;
}

std::string DccWriter::specification_id(const std::string& specification) const {
    for (std::size_t i = 0; i < data_.specifications.size(); ++i) {
        if (data_.specifications[i].id == specification) {
            return "rule_" + std::to_string(i + 1);
        }
    }
    return "";
}

void DccWriter::contents(const Text& text) {
    if (languages_.size() < 2 || !text.differs()) {
        xml.element("dcc:content", without_outer_blanks(text.first()));
        return;
    }
    for (std::size_t i = 0; i < languages_.size(); ++i) {
        const std::string in_language = without_outer_blanks(text.in(i));
        xml.element("dcc:content", in_language.empty() ? without_outer_blanks(text.first()) : in_language,
                    {{"lang", languages_[i]}});
    }
}

void DccWriter::text(const std::string& element, const Text& text, const XmlWriter::Attributes& attributes) {
    xml.open(element, attributes);
    // The format demands a text here. "Not stated" is better than an element that is empty, or a whole document that is
    // refused.
    contents(without_outer_blanks(text.first()).empty() ? not_stated() : text);
    xml.close();
}

void DccWriter::optional_text(const std::string& element, const Text& value) {
    if (!without_outer_blanks(value.first()).empty()) {
        text(element, value);
    }
}

void DccWriter::optional_string(const std::string& element, const std::string& value) {
    if (const std::string line = one_line(value); !line.empty()) {
        xml.element(element, line);
    }
}

void DccWriter::statement(const std::string& ref_type, const Text& declaration, const std::string& id) {
    xml.open("dcc:statement", {{"id", id}, {"refType", ref_types_(ref_type)}});
    text("dcc:declaration", declaration);
    xml.close();
}

void DccWriter::data_sentence(const Text& sentence) {
    xml.open("dcc:data");
    text("dcc:text", sentence);
    xml.close();
}

void append_line(Text& lines, const Text& line) {
    if (!line.empty()) {
        lines += (lines.empty() ? Text() : Text("\n")) + line;
    }
}

std::string iso_639_1(const std::string& language) {
    return language.substr(0, language.find('-'));
}

std::string date_or_nothing(const std::string& text) {
    constexpr std::string_view k_form = "dddd-dd-dd";
    bool fits = text.size() == k_form.size();
    for (std::size_t i = 0; fits && i < text.size(); ++i) {
        fits = k_form[i] == 'd' ? is_a_digit(text[i]) : text[i] == '-';
    }
    return fits ? text : "";
}

std::string d_si_number(double value) {
    return std::isfinite(value) ? text::shortest(value) : std::string(k_not_a_number);
}

std::string d_si_number(const std::string& printed) {
    const std::string text = with_ascii_minus(printed);
    return is_number(text) ? text : std::string(k_not_a_number);
}

std::string required_d_si_number(const std::string& printed, const std::string& where) {
    std::string text = d_si_number(printed);
    if (text == k_not_a_number) {
        throw gum::NoResultError(gum::Diagnostic{.code = "GC-DCC-0120",
                                                 .where = where,
                                                 .what = "the printed text is \"" + printed + '"',
                                                 .rule = "a digital certificate holds every number that is printed",
                                                 .action = "evaluate the job again with this version"});
    }
    return text;
}

std::string d_si_coverage_factor(const std::string& printed) {
    // The schema has a factor of at least 1, without sign and exponent. Anything else would make the whole document
    // invalid, so it becomes NaN here.
    const bool fits = !printed.empty() && printed.front() >= '1' && printed.front() <= '9' &&
                      plain_decimal_at(printed, 0) == printed.size();
    return fits ? printed : std::string(k_not_a_number);
}

std::string d_si_probability(double value) {
    return value >= 0.0 && value <= 1.0 ? text::shortest_plain(value, 0.0) : std::string(k_not_a_number);
}

namespace {

/// Whether a unit of D-SI is the unit that is meant: it is read back, because a symbol such as "ft" or "yd" looks like
/// a prefix with a unit.
bool means_the_same(const std::string& d_si, const std::string& udunits) {
    const std::optional<std::string> back = unit_from_d_si(d_si);
    if (!back) {
        return false;
    }
    try {
        const gum::Unit a = gum::Unit::parse(*back);
        const gum::Unit b = gum::Unit::parse(udunits);
        constexpr double k_noise = 1e-12;  // of powers of the factors, relative
        const double size = b.difference_to_si(1.0);
        return a.dimension() == b.dimension() && a.is_celsius_temperature() == b.is_celsius_temperature() &&
               std::abs(a.difference_to_si(1.0) - size) <= k_noise * std::abs(size);
    } catch (const gum::InputError&) {
        return false;
    }
}

std::string checked_d_si_unit(const std::string& udunits) {
    if (const auto unit = gum::unit_in_d_si(udunits); unit && means_the_same(*unit, udunits)) {
        return *unit;
    }
    std::string text = "|";
    for (const std::string& word : xml_list(udunits)) {
        text += (text.size() == 1 ? "" : "_") + word;  // lists split at blanks
    }
    return text;
}

}  // namespace

std::string d_si_unit(const std::string& udunits) {
    // A certificate has hundreds of quantities in a few units, and the check takes 20 µs.
    constexpr std::size_t k_most_kept = 100;
    thread_local std::map<std::string, std::string> kept;
    if (const auto found = kept.find(udunits); found != kept.end()) {
        return found->second;
    }
    std::string unit = checked_d_si_unit(udunits);
    if (kept.size() < k_most_kept) {
        kept.emplace(udunits, unit);
    }
    return unit;
}

std::string as_token(const std::string& text) {
    std::string token;
    for (const char c : text) {
        const bool plain = is_a_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (plain || (!token.empty() && token.back() != '_')) {
            token += plain ? c : '_';
        }
    }
    while (!token.empty() && token.back() == '_') {
        token.pop_back();
    }
    return token.empty() ? "x" : token;
}

}  // namespace gumcert::reports
