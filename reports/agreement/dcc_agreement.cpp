#include "reports/agreement/dcc_agreement.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "reports/dcc/xml_document.h"
#include "text/visible_text.h"

namespace gumcert::reports {

namespace {

constexpr const char* k_made_now = "digital certificate of the record";

/// Left out: a signature is made behind the document. That nothing else is in it, its check says (GC-SIGN-0120).
bool is_of_no_statement(const XmlElement& element) {
    return element.name == "ds:Signature";
}

std::vector<const XmlElement*> compared_children(const XmlElement& element) {
    std::vector<const XmlElement*> children;
    for (const XmlElement& child : element.children) {
        if (!is_of_no_statement(child)) {
            children.push_back(&child);
        }
    }
    return children;
}

std::string without_prefix(const std::string& name) {
    const std::size_t colon = name.starts_with('{') ? std::string::npos : name.find(':');
    return colon == std::string::npos ? name : name.substr(colon + 1);
}

/// Words of a text with one blank between them: how lines are broken states nothing.
std::string words_of_text(const std::string& text) {
    std::string words;
    for (const std::string& word : xml_list(text)) {
        words += (words.empty() ? "" : " ") + word;
    }
    return words;
}

std::string shown_part(const std::string& text) {
    constexpr std::size_t k_most = 80;
    std::size_t end = std::min(text.size(), k_most);
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
        --end;
    }
    return text::in_quotes(text.substr(0, end) + (end < text.size() ? "\u2026" : ""));
}

/// The words around the first place where two lists differ.
std::string difference_of(const std::string& stated, const std::string& expected) {
    const std::vector<std::string> left = xml_list(stated);
    const std::vector<std::string> right = xml_list(expected);
    constexpr std::size_t k_list = 3;
    if (left.size() == right.size() && left.size() >= k_list) {
        const auto [a, b] = std::mismatch(left.begin(), left.end(), right.begin());
        if (a != left.end()) {
            return shown_part(*a) + " as word " + std::to_string(a - left.begin() + 1) + ", and the record gives " +
                   shown_part(*b);
        }
    }
    return shown_part(stated) + ", and the record gives " + shown_part(expected);
}

/// \return "" where both are the same
std::string difference_of(const XmlElement& stated, const XmlElement& expected, const std::string& path) {
    const std::string here = path + (path.empty() ? "" : "/") + without_prefix(expected.name);
    if (stated.name != expected.name) {
        return "has " + shown_part(without_prefix(stated.name)) + " in place of " + here + " (line " +
               std::to_string(stated.line) + ")";
    }
    auto left = stated.attributes;
    auto right = expected.attributes;
    std::sort(left.begin(), left.end());
    std::sort(right.begin(), right.end());
    if (left != right) {
        const auto of = [](const auto& attributes) {
            std::string text;
            for (const auto& [name, value] : attributes) {
                text += (text.empty() ? "" : " ") + name + "=" + value;
            }
            return text;
        };
        return "has the attributes " + difference_of(of(left), of(right)) + ", of " + here + " (line " +
               std::to_string(stated.line) + ")";
    }
    const std::string text = words_of_text(stated.text);
    const std::string wanted = words_of_text(expected.text);
    if (text != wanted) {
        return "states in " + here + " " + difference_of(text, wanted) + " (line " + std::to_string(stated.line) + ")";
    }
    const std::vector<const XmlElement*> children = compared_children(stated);
    const std::vector<const XmlElement*> expected_children = compared_children(expected);
    for (std::size_t i = 0; i < std::min(children.size(), expected_children.size()); ++i) {
        if (std::string found = difference_of(*children[i], *expected_children[i], here); !found.empty()) {
            return found;
        }
    }
    if (children.size() > expected_children.size()) {
        return "states " + shown_part(without_prefix(children[expected_children.size()]->name)) + " in " + here +
               ", and the record does not (line " + std::to_string(children[expected_children.size()]->line) + ")";
    }
    return children.size() == expected_children.size()
               ? ""
               : "does not state " + shown_part(without_prefix(expected_children[children.size()]->name)) + " in " +
                     here;
}

}  // namespace

std::string disagreement_of_dcc(std::string_view bytes, const std::string& name, std::string_view made_of_record) {
    std::vector<XmlNote> notes;
    const XmlElement stated = read_xml(bytes, name, &notes);
    std::string found = difference_of(stated, read_xml(made_of_record, k_made_now), "");
    if (found.empty() && !notes.empty()) {
        found = "has " + shown_part(notes.front().what) +
                ", which the record does not give, and by which programs may show something else (line " +
                std::to_string(notes.front().line) + ")";
    }
    return found;
}

std::vector<std::string> languages_of_dcc(std::string_view bytes, const std::string& name) {
    const XmlElement root = read_xml(bytes, name);
    const XmlElement* const data = root.child("dcc:administrativeData");
    const XmlElement* const core = data == nullptr ? nullptr : data->child("dcc:coreData");
    std::vector<std::string> languages;
    if (core != nullptr) {
        languages.push_back(core->child_text("dcc:mandatoryLangCodeISO639_1"));
        for (const XmlElement* const one : core->children_named("dcc:usedLangCodeISO639_1")) {
            if (one->trimmed() != languages.front()) {
                languages.push_back(one->trimmed());
            }
        }
    }
    return languages;
}

std::string changed_templates_of_dcc(std::string_view bytes, const std::string& name) {
    constexpr std::size_t k_digits = 12;  // of a digest that a document shows
    const XmlElement root = read_xml(bytes, name);
    const XmlElement* const data = root.child("dcc:administrativeData");
    const XmlElement* const statements = data == nullptr ? nullptr : data->child("dcc:statements");
    if (statements == nullptr) {
        return "";
    }
    for (const XmlElement* const one : statements->children_named("dcc:statement")) {
        const std::string digest = one->child_text("dcc:reference");
        if (one->attribute("refType").ends_with("_changedTemplates") && digest.size() == k_digits &&
            digest.find_first_not_of("0123456789abcdef") == std::string::npos) {
            return digest;
        }
    }
    return "";
}

}  // namespace gumcert::reports
