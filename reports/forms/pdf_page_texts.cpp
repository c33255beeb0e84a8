#include "reports/forms/pdf_page_texts.h"

#include "reports/forms/pdf_drawn_codes.h"
#include "reports/forms/qpdf_objects.h"
#include "text/utf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <new>
#include <stdexcept>
#include <utility>

namespace gumcert::reports {

namespace {

using Object = QPDFObjectHandle;

/// Text of each code of a font (ISO 32000-1:2008, 9.10.3).
using CodeTexts = std::map<unsigned, std::string>;

std::string from_utf16(const std::string& bytes) {
    std::string text;
    const auto unit = [&](std::size_t i) {
        return (static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) << 8U) |
               static_cast<unsigned>(static_cast<unsigned char>(bytes[i + 1]));
    };
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        unsigned code = unit(i);
        if (code >= 0xD800U && code < 0xDC00U && i + 3 < bytes.size()) {
            code = 0x10000U + ((code - 0xD800U) << 10U) + (unit(i + 2) - 0xDC00U);
            i += 2;
        }
        text += text::encode_utf8(code);
    }
    return text;
}

unsigned code_of(std::string_view bytes) {
    unsigned code = 0;
    for (const char c : bytes.substr(0, 4)) {
        code = (code << 8U) | static_cast<unsigned>(static_cast<unsigned char>(c));
    }
    return code;
}

constexpr std::size_t k_largest_content = std::size_t{32} << 20U;     // of a page, or a map of a font, unpacked
constexpr std::size_t k_largest_of_document = std::size_t{1} << 30U;  // all of them, each time that one is read
constexpr std::size_t k_largest_text = std::size_t{256} << 20U;       // of all pages
constexpr std::size_t k_most_codes = std::size_t{1} << 20U;           // that one map states, repetitions among them
constexpr unsigned k_last_code = 0xFFFFU;                             // codes have two bytes (Identity-H)

[[noreturn]] void refuse_content(const std::string& what) {
    throw std::length_error(what);
}

/// Takes what a stream unpacks to, up to a limit.
class LimitedContent : public Pipeline {
public:
    explicit LimitedContent(std::size_t most) : Pipeline("content", nullptr), most_(most) {}
    void write(unsigned char const* data, std::size_t length) override {
        if (length > most_ - content_.size()) {
            is_too_large_ = true;
            throw std::length_error("too large");  // ends the unpacking; qpdf keeps it to itself
        }
        content_.append(reinterpret_cast<const char*>(data), length);
    }
    void finish() override {}
    [[nodiscard]] bool is_too_large() const { return is_too_large_; }
    [[nodiscard]] std::string take() { return std::move(content_); }

private:
    std::size_t most_;
    std::string content_;
    bool is_too_large_ = false;
};

/// Unpacks the streams of one document. What is packed twice can unpack to nothing, and take any time for it.
class Unpacker {
public:
    [[nodiscard]] std::string content_of(Object stream) {
        Object filters = stream.getDict().getKey("/Filter");
        if (filters.isArray() && filters.getArrayNItems() > 1) {
            refuse_content("a part is packed more than once");
        }
        LimitedContent content(std::min(k_largest_content, left_));
        bool is_filtered = false;
        stream.pipeStreamData(&content, &is_filtered, 0, qpdf_dl_all);
        if (content.is_too_large()) {
            refuse_content("a page unpacks to more than 32 MiB, or all of them to more than 1 GiB");
        }
        if (!is_filtered) {
            refuse_content("a part is packed in a way that is not known");
        }
        std::string taken = content.take();
        left_ -= taken.size();
        return taken;
    }

private:
    std::size_t left_ = k_largest_of_document;
};

/// A ToUnicode map is a small PostScript program; the tokens that matter are strings, arrays and the operators.
class CodeReader : public Object::ParserCallbacks {
public:
    explicit CodeReader(CodeTexts& texts) : texts_(texts) {}
    void handleObject(Object object) override {
        if (!object.isOperator()) {
            operands_.push_back(object);
            return;
        }
        const std::string name = object.getOperatorValue();
        if (name == "endbfchar") {
            for (std::size_t i = 0; i + 1 < operands_.size(); i += 2) {
                put(operands_[i], 0, operands_[i + 1], 0);
            }
        } else if (name == "endbfrange") {
            for (std::size_t i = 0; i + 2 < operands_.size(); i += 3) {
                range(operands_[i], operands_[i + 1], operands_[i + 2]);
            }
        }
        operands_.clear();
    }
    void handleEOF() override {}

private:
    void range(Object first, Object last, Object to) {
        if (!first.isString() || !last.isString()) {
            return;
        }
        const unsigned low = code_of(first.getStringValue());
        const unsigned high = std::min(code_of(last.getStringValue()), k_last_code);
        for (unsigned code = low; code <= high; ++code) {
            if (to.isArray()) {
                put(first, code - low, to.getArrayItem(static_cast<int>(code - low)), 0);
            } else {
                put(first, code - low, to, code - low);
            }
        }
    }
    void put(Object code, unsigned further, Object text, unsigned beyond) {
        if (!code.isString() || !text.isString()) {
            return;
        }
        if (++codes_ > k_most_codes) {
            refuse_content("a font states more than 1048576 codes");
        }
        std::string utf16 = text.getStringValue();
        if (!utf16.empty()) {
            utf16.back() = static_cast<char>(
                static_cast<unsigned char>(static_cast<unsigned>(static_cast<unsigned char>(utf16.back())) + beyond));
        }
        if (const unsigned of = code_of(code.getStringValue()) + further; of <= k_last_code) {
            texts_[of] = from_utf16(utf16);
        }
    }

    CodeTexts& texts_;
    std::size_t codes_ = 0;
    std::vector<Object> operands_;
};

CodeTexts code_texts(Object font, Unpacker& unpacker) {
    CodeTexts texts;
    Object map = font.getKey("/ToUnicode");
    if (map.isStream()) {
        (void)unpacker.content_of(map);  // only to see that it may be: the parser takes the stream itself
        CodeReader reader(texts);
        // The reader of page contents knows the same tokens.
        Object::parseContentStream(map, &reader);
    }
    return texts;
}

bool is_left_out(std::string_view character) {
    if (character.size() == 1) {  // most are, and each is asked for
        const char c = character.front();
        return c == ' ' || c == k_end_of_drawn_text || c == '\n' || c == '\t' || c == '-';
    }
    return character == "\u00A0" || character == "\u200B" || character == "\u202F" || character == "\u00AD" ||
           character == "\u2010" || character == "\u2011";
}

/// Without blanks and hyphens.
std::string bare(const std::string& text) {
    std::string out;
    out.reserve(text.size());
    const std::string_view all = text;
    for (std::size_t i = 0; i < all.size();) {
        std::size_t length = 1;
        while (i + length < all.size() && text::is_continuation(all[i + length])) {
            ++length;
        }
        if (const std::string_view character = all.substr(i, length); !is_left_out(character)) {
            out += character;
        }
        i += length;
    }
    return out;
}

/// The decoded content of a page; of several streams with a blank between them, as if they were one.
std::string content_of(Object page, Unpacker& unpacker) {
    std::string content;
    for (Object& part : page.getPageContents()) {
        content += unpacker.content_of(part);
        content += '\n';
        if (content.size() > 2 * k_largest_content) {
            refuse_content("a page unpacks to more than 64 MiB");
        }
    }
    return content;
}

/// The texts of the fonts of a document, each read when a page first draws with it.
class Fonts {
public:
    explicit Fonts(Unpacker& unpacker) : unpacker_(unpacker) {}

    /// \return null where there is no such font
    const CodeTexts* find(Object resources, const std::string& name) {
        Object font = resources.isDictionary() ? resources.getKey("/" + name) : Object::newNull();
        if (!font.isDictionary()) {
            return nullptr;
        }
        const auto [found, is_new] = known_.try_emplace(font.getObjGen());
        if (is_new) {
            found->second = code_texts(font, unpacker_);
        }
        return &found->second;
    }

private:
    Unpacker& unpacker_;
    std::map<QPDFObjGen, CodeTexts> known_;
};

/// \param most  length of the text
std::string text_of_codes(const std::vector<DrawnCodes>& codes, const Object& resources, Fonts& fonts,
                          std::size_t most) {
    std::string text;
    for (const DrawnCodes& drawn : codes) {
        const CodeTexts* font = fonts.find(resources, drawn.font);
        // Two bytes a code (Identity-H).
        for (std::size_t i = 0; font != nullptr && i + 1 < drawn.codes.size(); i += 2) {
            const auto found = font->find(code_of(std::string_view(drawn.codes).substr(i, 2)));
            if (found != font->end()) {
                text += found->second;
            }
            if (text.size() > most) {
                refuse_content("its pages have more than 256 MiB of text");
            }
        }
        text += k_end_of_drawn_text;
    }
    return text;
}

Object fonts_of(Object page) {
    Object resources = page.getKey("/Resources");
    return resources.isDictionary() ? resources.getKey("/Font") : Object::newNull();
}

/// Without what draws nothing; the hyphens of the ends of lines are hyphens.
std::string as_drawn(const std::string& text) {
    std::string drawn;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t length = 1;
        while (i + length < text.size() && text::is_continuation(text[i + length])) {
            ++length;
        }
        const std::string character = text.substr(i, length);
        const bool is_hyphen =
            character == "-" || character == "\u00AD" || character == "\u2010" || character == "\u2011";
        drawn += is_hyphen ? "-" : is_left_out(character) ? "" : character;
        i += length;
    }
    return drawn;
}

std::string digits_of(std::string_view text) {
    std::string digits;
    for (const char c : text) {
        if (c >= '0' && c <= '9') {
            digits += c;
        }
    }
    return digits;
}

/// Looks for the digits of a view in those of a document. Between digits that belong together a document draws none.
class NumberSearch {
public:
    explicit NumberSearch(const std::string& drawn) : drawn_(drawn) {}

    void look_at(const nlohmann::json& parts) {
        for (const nlohmann::json& part : parts) {
            for (const nlohmann::json& section : part.value("sections", nlohmann::json::array())) {
                for (const nlohmann::json& block : section.at("blocks")) {
                    look_at_block(block);
                }
            }
        }
    }
    [[nodiscard]] std::vector<gum::Diagnostic> take() { return std::move(findings_); }

private:
    static constexpr std::size_t k_most_findings = 20;
    const std::string& drawn_;
    std::size_t at_ = 0;
    std::vector<gum::Diagnostic> findings_;

    void look_at_block(const nlohmann::json& block) {
        for (const nlohmann::json& paragraph : block.at("paragraph")) {
            look_for_text(paragraph.at("text").get<std::string>());
        }
        for (const nlohmann::json& definitions : block.at("definitions")) {
            for (const nlohmann::json& row : definitions.at("rows")) {
                look_for_text(row.at("value").get<std::string>());
            }
        }
        for (const nlohmann::json& table : block.at("table")) {
            for (const nlohmann::json& row : table.at("rows")) {
                std::string digits;
                std::string text;
                for (const nlohmann::json& cell : row.at("cells")) {
                    text += (text.empty() ? "" : " | ") + cell.at("text").get<std::string>();
                    digits += digits_of(cell.at("text").get<std::string>());
                    for (const nlohmann::json& also : cell.at("also")) {
                        digits += digits_of(also.at("text").get<std::string>());
                    }
                }
                if (!is_drawn(digits)) {
                    missing(table.at("number").get<std::string>(), text);
                }
            }
        }
    }

    /// A sentence may go on at the next page, behind its head: then each of its numbers is looked for.
    void look_for_text(const std::string& text) {
        if (is_drawn(digits_of(text))) {
            return;
        }
        std::string number;
        for (const char c : text + " ") {
            if (c >= '0' && c <= '9') {
                number += c;
            } else if (c != '.' && c != ',') {
                if (!is_drawn(std::exchange(number, {}))) {
                    missing("text", text);
                    return;
                }
            }
        }
    }

    /// What comes next in the view mostly comes next in the document.
    bool is_drawn(const std::string& digits) {
        std::size_t found = drawn_.find(digits, at_);
        if (found == std::string::npos) {
            found = drawn_.find(digits);
        }
        if (found != std::string::npos && digits.size() > 3) {
            at_ = found;
        }
        return found != std::string::npos;
    }

    void missing(const std::string& where, const std::string& text) {
        if (findings_.size() < k_most_findings) {
            findings_.push_back({.code = "GC-REPORT-0033",
                                 .where = "PDF, " + where,
                                 .what = "\"" + text + "\" of the record is not in the document with these digits",
                                 .rule = "a template places the numbers of the record and changes none",
                                 .action = "correct the template; rows of tables keep their columns in order"});
        }
    }
};

}  // namespace

std::string without_blanks(const std::string& text) {
    return bare(text);
}

namespace {

std::vector<std::string> drawn_texts_of(QPDF& pdf) {
    Unpacker unpacker;
    Fonts fonts(unpacker);
    std::vector<std::string> texts;
    std::size_t left = k_largest_text;
    for (const Object& page : pdf.getAllPages()) {
        texts.push_back(text_of_codes(drawn_codes(content_of(page, unpacker)), fonts_of(page), fonts, left));
        left -= std::min(left, texts.back().size());
    }
    for (const QPDFExc& warning : pdf.getWarnings()) {
        // qpdf goes on where an allocation failed; what it reads then is not what stands there.
        if (std::string_view(warning.what()).find("std::bad_alloc") != std::string_view::npos) {
            throw std::bad_alloc();
        }
    }
    return texts;
}

std::vector<std::string> bare_texts(std::vector<std::string> texts) {
    std::transform(texts.begin(), texts.end(), texts.begin(), bare);
    return texts;
}

}  // namespace

std::vector<std::string> drawn_texts_of_pages(std::string_view bytes) {
    QPDF pdf;
    pdf.setSuppressWarnings(true);
    pdf.processMemoryFile("PDF", bytes.data(), bytes.size());
    return drawn_texts_of(pdf);
}

std::vector<TextBesideDrawn> texts_beside_drawn(std::string_view bytes) {
    QPDF pdf;
    pdf.setSuppressWarnings(true);
    pdf.processMemoryFile("PDF", bytes.data(), bytes.size());
    Unpacker unpacker;
    Fonts fonts(unpacker);
    std::vector<TextBesideDrawn> texts;
    std::size_t left = k_largest_text;
    for (const Object& page : pdf.getAllPages()) {
        for (const TextBesideDrawn& one : texts_beside_drawn_codes(content_of(page, unpacker))) {
            const std::string text = Object::newString(one.text).getUTF8Value();
            const std::string drawn = text_of_codes(one.drawn, fonts_of(page), fonts, left);
            left -= std::min(left, drawn.size());
            // Typst says of a hyphen at the end of a line that it is a soft one, and where a line may be broken.
            if (!one.replaces || as_drawn(text) != as_drawn(drawn)) {
                texts.push_back({one.replaces, text});
            }
        }
    }
    return texts;
}

std::vector<std::string> texts_of_pages(std::string_view bytes) {
    return bare_texts(drawn_texts_of_pages(bytes));
}

std::vector<std::string> texts_of_pages(QPDF& pdf) {
    return bare_texts(drawn_texts_of(pdf));
}

gum::Diagnostic missing_on_a_page(const std::string& where, const std::string& text) {
    return {.code = "GC-REPORT-0032",
            .where = where,
            .what = "\"" + text + "\" is not on it",
            .rule =
                "every page has the number of its certificate, its mark while it is a draft or a specimen (ISO/IEC "
                "17025:2017, 7.8.2.1 d), and the digest of templates that were changed",
            .action =
                "take header_right of the view into the head and footer_left into the foot of every page of your "
                "template, and mark into the first page"};
}

std::vector<gum::Diagnostic> check_pages(const std::vector<std::string>& pages, const std::vector<std::string>& texts) {
    std::vector<gum::Diagnostic> findings;
    for (std::size_t page = 0; page < pages.size(); ++page) {
        for (const std::string& text : texts) {
            if (!bare(text).empty() && pages[page].find(bare(text)) == std::string::npos) {
                findings.push_back(missing_on_a_page(
                    "PDF, page " + std::to_string(page + 1) + " of " + std::to_string(pages.size()), text));
            }
        }
    }
    return findings;
}

std::vector<gum::Diagnostic> check_numbers(const std::vector<std::string>& pages, const nlohmann::json& view) {
    std::string all;
    for (const std::string& page : pages) {
        all += digits_of(page) + ' ';
    }
    NumberSearch search(all);
    search.look_at(view.value("identity", nlohmann::json::array()));
    search.look_at(nlohmann::json::array({{{"sections", view.value("sections", nlohmann::json::array())}}}));
    return search.take();
}

}  // namespace gumcert::reports
