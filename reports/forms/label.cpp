#include "reports/forms/label.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/qr_code.h"
#include "reports/view/label_view.h"
#include "text/markup.h"
#include "text/numbers.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace gumcert::reports {

namespace {

using nlohmann::json;

// All lengths in millimetres.
constexpr double k_width = 60.0;
constexpr double k_height = 30.0;
constexpr double k_edge = 1.5;
constexpr double k_code_side = 25.0;
constexpr double k_text_width = k_width - 2.0 * k_edge - k_code_side;

json checked_label_view(const EvaluationRecord& record, const RenderAssets& assets) {
    if (!record.certificate) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-REPORT-0043",
                                              .where = "record",
                                              .what = "no certificate data",
                                              .rule = "a label names the certificate of the item",
                                              .action = "state the certificate data in the job"});
    }
    return label_view(record, read_wording(assets, record));
}

/// How wide a text is at a height of one, at most: a Latin letter takes about half of it, a Chinese one all.
double estimated_width(std::string_view utf8) {
    double width = 0.0;
    for (const char c : utf8) {
        const auto byte = static_cast<unsigned char>(c);
        width += byte >= 0xE2U ? 1.0 : byte >= 0xC0U || byte < 0x80U ? 0.58 : 0.0;
    }
    return width;
}

/// A line of text, smaller where it would not fit. Nothing of a label is cut off.
std::string line_of_text(const std::string& text, double y, double size, const char* weight = "normal") {
    const double fitting = std::min(size, k_text_width / std::max(estimated_width(text), 1.0));
    return "<text x=\"" + text::shortest_plain(k_edge) + "\" y=\"" + text::shortest_plain(y) + "\" font-size=\"" +
           text::fixed(fitting, 2) + "\" font-weight=\"" + weight + "\">" + text::escaped_markup(text) + "</text>\n";
}

}  // namespace

std::string render_label_svg(const EvaluationRecord& record, const RenderAssets& assets) {
    const json view = checked_label_view(record, assets);
    const auto text = [](const json& object, const char* key) { return object.at(key).get<std::string>(); };
    std::string out =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60mm\" height=\"30mm\" viewBox=\"0 0 60 30\" "
        "font-family=\"Arial, Helvetica, 'Noto Sans', sans-serif\" xml:lang=\"" +
        text(view, "language") + "\">\n<title>" + text::escaped_markup(text(view, "title")) +
        "</title>\n<rect width=\"60\" height=\"30\" fill=\"#fff\"/>\n";
    double y = 4.2;
    out += line_of_text(text(view, "laboratory"), y, 2.6, "bold");
    for (const json& line : view.at("accreditation")) {
        out += line_of_text(text(line, "text"), y += 2.6, 2.2);
    }
    for (const json& mark : view.at("mark")) {
        out += line_of_text(text(mark, "text"), y += 3.2, 2.8, "bold");
    }
    out += line_of_text(text(view, "heading"), y += 3.6, 2.8, "bold");
    const json& rows = view.at("rows");
    const double step = (k_height - k_edge - y) / static_cast<double>(std::max<std::size_t>(rows.size(), 1));
    for (const json& row : rows) {
        out += line_of_text(text(row, "label") + ": " + text(row, "value"), y += step, std::min(2.6, 0.8 * step));
    }
    out += svg_of(qr_code(text(view, "code")), k_width - k_edge - k_code_side, k_edge, k_code_side);
    return out + "\n</svg>\n";
}

std::string render_label_pdf(const EvaluationRecord& record, const RenderAssets& assets, PdfWorker* worker) {
    json view = checked_label_view(record, assets);
    view["code_svg"] = svg_of(qr_code(view.at("code").get<std::string>()));
    return label_as_pdf(view, assets, worker);
}

}  // namespace gumcert::reports
