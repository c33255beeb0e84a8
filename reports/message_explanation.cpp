#include "reports/message_explanation.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "text/lists.h"
#include "text/utf8.h"

namespace gumcert::reports {

namespace {

constexpr std::size_t k_width = 100;  // of a line, in characters
constexpr std::size_t k_label = 13;   // of the column of labels

/// In a column of `width` characters, on its left side.
std::string in_column(std::string_view text, std::size_t width) {
    return std::string(text) + std::string(width - std::min(width, text.size()), ' ');
}

std::string row(std::string_view label, std::string_view text) {
    return "  " + in_column(label, k_label) + in_lines(text, k_width - k_label - 2, k_label + 2) + "\n";
}

std::string on_right(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string first_sentence(const std::string& text) {
    const std::size_t end = text.find(". ");
    return end == std::string::npos ? text : text.substr(0, end + 1);
}

/// "error", or "note or warning" where it depends on the case.
std::string severities(const MessageRegister& all, const MessageEntry& entry) {
    std::vector<std::string_view> words;
    for (const std::string& outcome : entry.outcomes) {
        const std::string& severity = all.outcomes().find(outcome)->second.severity;
        if (std::find(words.begin(), words.end(), severity) == words.end()) {
            words.push_back(severity);
        }
    }
    return text::any_of(words);
}

}  // namespace

std::string in_lines(std::string_view text, std::size_t width, std::size_t indent) {
    std::string lines;
    std::size_t used = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t length = text::character_count(word);
        if (used > 0 && used + 1 + length > width) {
            lines += '\n' + std::string(indent, ' ');
            used = 0;
        }
        lines += (used > 0 ? " " : "") + std::string(word);
        used += length + (used > 0 ? 1 : 0);
    }
    return lines;
}

std::string explanation_of_code(const MessageRegister& all, std::string_view code) {
    const MessageEntry& entry = all.codes().find(code)->second;
    if (!entry.retired.empty()) {
        return std::string(code) + ": no longer in use\n\n" + row("Was", entry.retired);
    }
    std::string text = std::string(code) + ": " + severities(all, entry) + "\n\n";
    text += row("Meaning", entry.meaning);
    text += row("Usual cause", entry.cause);
    text += row("What to do", entry.remedy);
    for (std::size_t i = 0; i < entry.rules.size(); ++i) {
        text += row(i > 0 ? "" : entry.rules.size() > 1 ? "Rules" : "Rule", "“" + entry.rules[i] + "”");
    }
    for (std::size_t i = 0; i < entry.outcomes.size(); ++i) {
        const MessageOutcome& outcome = all.outcomes().find(entry.outcomes[i])->second;
        const bool tells = entry.finding.empty() && !outcome.certificate.empty();
        text += row(i > 0 ? "" : "Result", (entry.outcomes.size() > 1 ? "As " + outcome.severity + ": " : "") +
                                               outcome.text + (tells ? " " + outcome.certificate : ""));
    }
    if (!entry.finding.empty()) {
        text += row("Certificate",
                    "Finding " + entry.finding + ": " + entry.finding_severity + ". " + all.text_on_findings());
    }
    if (!entry.formerly.empty()) {
        text += row("Formerly", entry.formerly);
    }
    return text;
}

std::string list_of_codes(const MessageRegister& all, std::string_view family) {
    const MessageFamily& described = all.families().find(family)->second;
    std::string text =
        std::string(family) + ": " + described.title + "\n\n" + in_lines(described.text, k_width, 0) + "\n\n";
    for (const std::string& code : all.codes_of(family)) {
        const std::string meaning = first_sentence(all.codes().find(code)->second.meaning);
        text += "  " + code + "  " + in_lines(meaning, k_width - code.size() - 4, code.size() + 4) + "\n";
    }
    return text;
}

std::string list_of_families(const MessageRegister& all) {
    std::string text = "Every message ends with its code in brackets. The families of codes:\n\n";
    for (const auto& [family, described] : all.families()) {
        text += "  " + in_column(family, 14) + on_right(std::to_string(all.codes_of(family).size()), 4) + "  " +
                described.title + "\n";
    }
    return text + "\ngumcert explain GC-RANK lists the codes of a family, gumcert explain GC-RANK-0001 explains one.\n";
}

}  // namespace gumcert::reports
