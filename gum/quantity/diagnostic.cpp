#include "gum/quantity/diagnostic.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace gumcert::gum {

namespace {

/// "p = <1E-300" as "p < 1E-300": a bound takes the place of the equals sign, except in what is quoted.
std::string with_bounds(std::string text) {
    for (const std::string_view sign : {"<", ">"}) {
        const std::string equal_to = "= " + std::string(sign);
        for (std::size_t at = text.find(equal_to); at != std::string::npos; at = text.find(equal_to, at + 1)) {
            const std::size_t digit = at + equal_to.size();
            const bool is_quoted =
                std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '"') % 2 != 0;
            if (!is_quoted && digit < text.size() && text[digit] >= '0' && text[digit] <= '9') {
                text.replace(at, equal_to.size(), std::string(sign) + " ");
            }
        }
    }
    return text;
}

}  // namespace

std::string message(const Diagnostic& diagnostic) {
    std::string text;
    for (const std::string* part : {&diagnostic.where, &diagnostic.what, &diagnostic.rule, &diagnostic.action}) {
        if (part->empty()) {
            continue;
        }
        if (!text.empty()) {
            text += " — ";
        }
        text += *part;
    }
    return with_bounds(std::move(text));
}

namespace {

std::string all_messages(const std::vector<Diagnostic>& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (!text.empty()) {
            text += '\n';
        }
        text += message(diagnostic);
    }
    return text;
}

}  // namespace

DiagnosedError::DiagnosedError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(all_messages(diagnostics)), diagnostics_(std::move(diagnostics)) {}

}  // namespace gumcert::gum
