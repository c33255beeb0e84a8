#include "reports/forms/qr_code.h"

#include <qrencode.h>

#include <cerrno>
#include <cstddef>
#include <memory>
#include <new>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

constexpr std::size_t k_longest_code = 2000;  // [byte]
constexpr int k_margin = 4;                   // modules

}  // namespace

QrCode qr_code(const std::string& text) {
    std::unique_ptr<QRcode, decltype(&QRcode_free)> made(nullptr, QRcode_free);
    errno = 0;
    if (text.size() <= k_longest_code) {
        constexpr int k_smallest_version = 0;
        constexpr int k_case_sensitive = 1;
        made.reset(QRcode_encodeString(text.c_str(), k_smallest_version, QR_ECLEVEL_M, QR_MODE_8, k_case_sensitive));
    }
    if (made == nullptr && errno == ENOMEM) {
        throw std::bad_alloc();  // says nothing of the text
    }
    if (made == nullptr) {
        throw gum::NoResultError(gum::Diagnostic{.code = "GC-REPORT-0044",
                                                 .where = "label",
                                                 .what = "a text of " + std::to_string(text.size()) + " bytes",
                                                 .rule = "a QR code holds 1 to 2000 bytes",
                                                 .action = "give the certificate a number, and a shorter one"});
    }
    QrCode code{.size = made->width, .dark = {}};
    const auto modules = static_cast<std::size_t>(made->width) * static_cast<std::size_t>(made->width);
    code.dark.reserve(modules);
    for (std::size_t i = 0; i < modules; ++i) {
        code.dark.push_back((made->data[i] & 1U) != 0);  // the lowest bit is the colour (qrencode.h)
    }
    return code;
}

std::string svg_of(const QrCode& code, double x, double y, double side) {
    const std::string all = std::to_string(code.size + 2 * k_margin);
    std::string path;
    const auto size = static_cast<std::size_t>(code.size);
    for (std::size_t row = 0; row < size; ++row) {
        for (std::size_t column = 0; column < size;) {
            std::size_t end = column;
            while (end < size && code.dark[row * size + end]) {
                ++end;
            }
            if (end > column) {  // modules side by side are one rectangle: no gaps where a printer rounds
                const std::string width = std::to_string(end - column);
                path += "M" + std::to_string(column + k_margin) + " " + std::to_string(row + k_margin) + "h" + width +
                        "v1h-" + width + "z";
            }
            column = end + 1;
        }
    }
    const std::string place = side > 0.0 ? " x=\"" + text::shortest_plain(x) + "\" y=\"" + text::shortest_plain(y) +
                                               "\" width=\"" + text::shortest_plain(side) + "\" height=\"" +
                                               text::shortest_plain(side) + "\""
                                         : " width=\"" + all + "\" height=\"" + all + "\"";
    return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + place + " viewBox=\"0 0 " + all + " " + all +
           "\" shape-rendering=\"crispEdges\"><rect width=\"" + all + "\" height=\"" + all +
           "\" fill=\"#fff\"/><path fill=\"#000\" d=\"" + path + "\"/></svg>";
}

}  // namespace gumcert::reports
