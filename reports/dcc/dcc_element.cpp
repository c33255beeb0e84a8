#include "reports/dcc/dcc_element.h"

#include "reports/printable_text.h"

#include <algorithm>
#include <array>

#include "gum/quantity/diagnostic.h"
#include "reports/view/certificate_view.h"

namespace gumcert::reports {

XmlElement read_dcc_root(std::string_view bytes, const std::string& file) {
    XmlElement root = read_xml(bytes, file);
    constexpr std::size_t k_shown = 80;
    if (root.name != "dcc:digitalCalibrationCertificate") {
        throw gum::InputError(gum::Diagnostic{.code = "GC-DCC-0005",
                                              .where = place_of(root, file),
                                              .what = "the document is a " + shortened(printable(root.name), k_shown),
                                              .rule = "a digital calibration certificate is a "
                                                      "digitalCalibrationCertificate of https://ptb.de/dcc",
                                              .action = "name the XML file of the certificate"});
    }
    const std::string version = root.attribute("schemaVersion");
    static constexpr std::array<std::string_view, 4> k_read{"3.0.", "3.1.", "3.2.", "3.3."};
    if (std::none_of(k_read.begin(), k_read.end(), [&](std::string_view v) { return version.starts_with(v); })) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-DCC-0006",
                                              .where = place_of(root, file),
                                              .what = "schemaVersion \"" + shortened(printable(version), k_shown) + '"',
                                              .rule = "versions 3.0 to 3.3 of the DCC are known",
                                              .action = "ask the issuer for a certificate of one of these versions"});
    }
    return root;
}

std::string first_content(const XmlElement* text) {
    return text == nullptr ? "" : text->child_text("dcc:content");
}

std::string content_in(const XmlElement* text, std::string_view language) {
    if (text == nullptr) {
        return "";
    }
    for (const XmlElement* content : text->children_named("dcc:content")) {
        if (content->attribute("lang") == language) {
            return content->trimmed();
        }
    }
    return first_content(text);
}

}  // namespace gumcert::reports
