#include <cstddef>
#include <cstdint>
#include <string>

#include "reports/agreement/document_agreement.h"
#include "reports/forms/html_texts.h"
#include "tests/fuzz/demand.h"

/// Any bytes as a page of HTML have a text that is no longer than they are, but for a blank a tag, and are looked through for
/// what they hide and for numbers; words that were written as HTML are read back as they were.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const std::string bytes(data, data + size);
    const std::string text = reports::text_of_html(bytes);
    fuzz::demand(text.size() <= 2 * size, "a text that is longer than its page");
    (void)reports::says_number(bytes, "EX-2026-0001");
    (void)reports::hidden_part_of_html(bytes, "p { margin: 0 }");
    const reports::PrintedDocument document({text, bytes});
    (void)document.says("EX-2026-0001");
    (void)reports::numbers_as_printed(bytes);
    std::string written;
    for (const char c : bytes) {
        written += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&#62;" : std::string(1, c);
    }
    fuzz::demand(reports::text_of_html(written) == bytes, "words that are read as others");
    (void)reports::structure_of_html(bytes);
    fuzz::demand(reports::structure_of_html(written).find('<') == std::string::npos, "words that are read as elements");
    return 0;
}
