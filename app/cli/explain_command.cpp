#include "app/cli/explain_command.h"

#include <cstddef>
#include <filesystem>
#include <utility>

#include "app/cli/terminal/share_folder.h"
#include "evaluation/limits.h"
#include "evaluation/read_file.h"
#include "gum/quantity/diagnostic.h"
#include "reports/message_explanation.h"
#include "reports/message_register.h"
#include "text/lists.h"

namespace gumcert::cli {

namespace {

/// "R07-e", "G04"
bool looks_like_a_finding(const std::string& word) {
    const auto digit = [&](std::size_t i) { return word[i] >= '0' && word[i] <= '9'; };
    return word.size() >= 3 && word[0] >= 'A' && word[0] <= 'Z' && digit(1) && digit(2) &&
           (word.size() == 3 || word[3] == '-');
}

gum::Diagnostic unknown_word(const reports::MessageRegister& all, const std::string& word, const std::string& code) {
    constexpr std::size_t k_most_suggested = 3;
    if (looks_like_a_finding(word)) {
        const std::vector<std::string> becoming = all.codes_of_finding(word);
        return usage_problem("explain", "\"" + word + "\" is a finding of a certificate, and no code of a message",
                             "findings are explained in docs/findings.md",
                             becoming.empty() ? "look it up there"
                                              : "look it up there; messages that become it: " + text::listed(becoming));
    }
    return usage_problem("explain", "\"" + word + "\" is no code of a message",
                         "a code is GC, a family and four digits, as in brackets at the end of a message",
                         "perhaps one of " + text::listed(all.nearest(code, k_most_suggested)) +
                             " is meant; gumcert explain lists the families");
}

}  // namespace

ExitCode explain(const std::vector<std::string>& words, const std::string& share) {
    const std::filesystem::path file = templates_folder(share) / "messages.json";
    const reports::MessageRegister all(evaluation::read_file(file), file.string());
    std::string text = words.empty() ? reports::list_of_families(all) : "";
    std::vector<gum::Diagnostic> unknown;
    for (const std::string& word : words) {
        const std::string code = reports::code_as_registered(word);
        text += text.empty() ? "" : "\n";
        if (all.codes().contains(code)) {
            text += reports::explanation_of_code(all, code);
        } else if (all.families().contains(code)) {
            text += reports::list_of_codes(all, code);
        } else {
            unknown.push_back(unknown_word(all, word, code));
        }
    }
    if (!unknown.empty()) {
        throw gum::UsageError(std::move(unknown));
    }
    write_to_stdout(text);
    return done;
}

ExitCode list_limits() {
    write_to_stdout(evaluation::limits_text());
    return done;
}

}  // namespace gumcert::cli
