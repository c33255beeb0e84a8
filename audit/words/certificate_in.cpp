#include "audit/words/certificate_in.h"

#include "audit/words/bare_text.h"
#include "text/small_letters.h"

namespace gumcert::audit {

std::string certificate_in(std::string_view text) {
    const std::string lower = text::in_small_letters(text);
    for (const std::string_view word : {"certificate", "cert.", "kalibrierschein", "zertifikat", "certificado"}) {
        const std::size_t at = lower.find(word);
        if (at == std::string::npos || lower.size() != text.size()) {
            continue;
        }
        const std::size_t number = text.find_first_not_of(" :#", at + word.size());
        if (number == std::string_view::npos) {
            continue;
        }
        const std::string_view rest = text.substr(number);
        const std::string_view named = trimmed(rest.substr(0, rest.find_first_of(";,()")));
        const std::string_view first = named.substr(0, named.find(' '));
        // What has no digit in its first words is no number: "certificate of the maker, 2024".
        constexpr std::size_t k_longest = 40;
        const bool is_number_word =
            first == "No" || first == "No." || first == "Nr" || first == "Nr." || first == "no.";
        if (named.size() <= k_longest &&
            (first.find_first_of("0123456789") != std::string_view::npos ||
             (is_number_word && named.find_first_of("0123456789") != std::string_view::npos))) {
            return std::string(word == "cert." ? "certificate" : text.substr(at, word.size())) + " " +
                   std::string(named);
        }
    }
    return "";
}

}  // namespace gumcert::audit
