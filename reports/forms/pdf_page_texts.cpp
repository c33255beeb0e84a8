#include "reports/forms/pdf_page_texts.h"

#include "reports/forms/qpdf_objects.h"
#include "text/utf8.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
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

unsigned code_of(const std::string& bytes) {
    unsigned code = 0;
    for (const char c : bytes.substr(0, 4)) {
        code = (code << 8U) | static_cast<unsigned>(static_cast<unsigned char>(c));
    }
    return code;
}

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
        const unsigned high = code_of(last.getStringValue());
        for (unsigned code = low; code <= high && code - low < 0x10000U; ++code) {
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
        std::string utf16 = text.getStringValue();
        if (!utf16.empty()) {
            utf16.back() = static_cast<char>(
                static_cast<unsigned char>(static_cast<unsigned>(static_cast<unsigned char>(utf16.back())) + beyond));
        }
        texts_[code_of(code.getStringValue()) + further] = from_utf16(utf16);
    }

    CodeTexts& texts_;
    std::vector<Object> operands_;
};

CodeTexts code_texts(QPDF& pdf, Object font) {
    CodeTexts texts;
    Object map = font.getKey("/ToUnicode");
    if (map.isStream()) {
        CodeReader reader(texts);
        const std::shared_ptr<Buffer> data = map.getStreamData(qpdf_dl_all);
        const std::string program(reinterpret_cast<const char*>(data->getBuffer()), data->getSize());
        // The reader of page contents knows the same tokens.
        Object stream = Object::newStream(&pdf, program);
        Object::parseContentStream(stream, &reader);
    }
    return texts;
}

bool is_left_out(const std::string& character) {
    return character == " " || character == "\n" || character == "\t" || character == "\u00A0" ||
           character == "\u200B" || character == "\u202F" || character == "-" || character == "\u00AD" ||
           character == "\u2010" || character == "\u2011";
}

/// Without blanks and hyphens.
std::string bare(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t length = 1;
        while (i + length < text.size() && text::is_continuation(text[i + length])) {
            ++length;
        }
        const std::string character = text.substr(i, length);
        out += is_left_out(character) ? "" : character;
        i += length;
    }
    return out;
}

class PageReader : public Object::ParserCallbacks {
public:
    PageReader(QPDF& pdf, Object fonts, std::map<QPDFObjGen, CodeTexts>& known)
        : pdf_(pdf), fonts_(std::move(fonts)), known_(known) {}
    void handleObject(Object object) override {
        if (!object.isOperator()) {
            operands_.push_back(object);
            return;
        }
        const std::string name = object.getOperatorValue();
        if (name == "Tf" && operands_.size() == 2 && operands_[0].isName() && fonts_.isDictionary()) {
            Object font = fonts_.getKey(operands_[0].getName());
            const QPDFObjGen id = font.getObjGen();
            if (font.isDictionary() && !known_.contains(id)) {
                known_.emplace(id, code_texts(pdf_, font));
            }
            font_ = font.isDictionary() ? &known_.at(id) : nullptr;
        } else if (name == "Tj" || name == "TJ" || name == "'" || name == "\"") {
            for (Object& operand : operands_) {
                show(operand);
            }
        }
        operands_.clear();
    }
    void handleEOF() override {}
    [[nodiscard]] std::string text() const { return bare(text_); }

private:
    void show(Object operand) {
        if (operand.isArray()) {
            for (Object item : operand.getArrayAsVector()) {
                show(item);
            }
        } else if (operand.isString() && font_ != nullptr) {
            const std::string bytes = operand.getStringValue();
            for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {  // two bytes a code (Identity-H)
                const auto found = font_->find(code_of(bytes.substr(i, 2)));
                text_ += found == font_->end() ? "" : found->second;
            }
        }
    }

    QPDF& pdf_;
    Object fonts_;
    std::map<QPDFObjGen, CodeTexts>& known_;
    const CodeTexts* font_ = nullptr;
    std::vector<Object> operands_;
    std::string text_;
};

}  // namespace

std::vector<std::string> texts_of_pages(std::string_view bytes) {
    QPDF pdf;
    pdf.setSuppressWarnings(true);
    pdf.processMemoryFile("PDF", bytes.data(), bytes.size());
    std::map<QPDFObjGen, CodeTexts> fonts;
    std::vector<std::string> texts;
    for (Object page : pdf.getAllPages()) {
        Object resources = page.getKey("/Resources");
        PageReader reader(pdf, resources.isDictionary() ? resources.getKey("/Font") : Object::newNull(), fonts);
        page.parsePageContents(&reader);
        texts.push_back(reader.text());
    }
    return texts;
}

std::vector<gum::Diagnostic> check_pages(std::string_view pdf, const std::vector<std::string>& texts) {
    std::vector<gum::Diagnostic> findings;
    const std::vector<std::string> pages = texts_of_pages(pdf);
    for (std::size_t page = 0; page < pages.size(); ++page) {
        for (const std::string& text : texts) {
            if (!bare(text).empty() && pages[page].find(bare(text)) == std::string::npos) {
                findings.push_back(
                    {.code = "GC-REPORT-0032",
                     .where = "PDF, page " + std::to_string(page + 1) + " of " + std::to_string(pages.size()),
                     .what = "\"" + text + "\" is not on it",
                     .rule = "every page has the number of its certificate, and its mark while it is a draft or a "
                             "specimen (ISO/IEC 17025:2017, 7.8.2.1 d)",
                     .action = "take header_right of the view into the head of every page of your template, and mark "
                               "into the first page"});
            }
        }
    }
    return findings;
}

}  // namespace gumcert::reports
