#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

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
    return text;
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
