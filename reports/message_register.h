#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// How a message can end: a refusal, a warning in a record, an error that a check finds …
struct MessageOutcome {
    std::string severity;     ///< note, warning or error
    std::string text;         ///< what has been written, and the exit code
    std::string certificate;  ///< whether one can be issued where the message becomes no finding; "" = the text says it
};

/// What a code of a message means: what the message itself, which names place, value and rule, has no room for.
struct MessageEntry {
    std::vector<std::string> outcomes;  ///< names; more than one where the severity depends on the case
    std::string meaning, cause, remedy;
    std::vector<std::string> rules;  ///< as messages state them; "…" stands for what each of them fills in
    std::string finding;             ///< id of the finding that it becomes on a certificate; "" = none
    std::string finding_severity;    ///< "critical where accredited, else major"
    std::string formerly;            ///< what the code meant besides in earlier versions; "" = nothing
    std::string retired;             ///< what the code was; then everything else is empty
};

struct MessageFamily {
    std::string title, text;
};

/// The register of all codes (templates/messages.json), in English. The lint `codes` holds it against the sources.
class MessageRegister {
public:
    /// \param text  JSON
    /// \param file  as messages name it
    /// \throws gum::StorageError  GC-STORE-0011 if it is not the register of a release
    MessageRegister(const std::string& text, const std::string& file);

    [[nodiscard]] const std::map<std::string, MessageEntry, std::less<>>& codes() const noexcept { return codes_; }
    [[nodiscard]] const std::map<std::string, MessageFamily, std::less<>>& families() const noexcept {
        return families_;
    }
    [[nodiscard]] const std::map<std::string, MessageOutcome, std::less<>>& outcomes() const noexcept {
        return outcomes_;
    }
    [[nodiscard]] const std::string& text_on_findings() const noexcept { return text_on_findings_; }

    /// Codes of a family that are in use, in their order.
    [[nodiscard]] std::vector<std::string> codes_of(std::string_view family) const;
    /// Codes that become a finding of a certificate.
    [[nodiscard]] std::vector<std::string> codes_of_finding(std::string_view id) const;
    /// Codes, or families where no code is as near, that may have been meant: those nearest by edit distance.
    [[nodiscard]] std::vector<std::string> nearest(std::string_view word, std::size_t most) const;

private:
    std::map<std::string, MessageEntry, std::less<>> codes_;
    std::map<std::string, MessageFamily, std::less<>> families_;
    std::map<std::string, MessageOutcome, std::less<>> outcomes_;
    std::string text_on_findings_;
};

/// A code or a family as somebody copies it from a terminal, "[gc-rank-0001]", "rank-0001", as the register writes it.
[[nodiscard]] std::string code_as_registered(std::string_view word);

/// "GC-RANK" of "GC-RANK-0001"; "" of what is no code.
[[nodiscard]] std::string_view family_of_code(std::string_view code);

}  // namespace gumcert::reports
