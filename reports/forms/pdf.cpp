#include "gum/quantity/diagnostic.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/pdf_conformity.h"
#include "reports/forms/pdf_page_texts.h"
#include "reports/forms/pdf_worker.h"
#include "reports/forms/render.h"
#include "reports/forms/typeset_drawing.h"
#include "reports/forms/typeset_table.h"
#include "text/small_letters.h"
#include "text/utf8.h"
#include "text/visible_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

/// Whether a text has characters of scripts that the built-in fonts lack: from U+2E80 (CJK radicals) upwards, without
/// the replacement character U+FFFD.
bool needs_further_fonts(std::string_view utf8) {
    for (std::size_t i = 0; i < utf8.size();) {
        const auto [code, bytes] = text::decode_utf8(utf8, i);
        if (code >= 0x2E80U && code != 0xFFFDU) {
            return true;
        }
        i += std::max<std::size_t>(bytes, 1);
    }
    return false;
}
bool needs_further_fonts(const nlohmann::json& view) {
    if (view.is_string()) {
        return needs_further_fonts(std::string_view(view.get_ref<const std::string&>()));
    }
    return view.is_structured() &&
           std::any_of(view.begin(), view.end(), [](const nlohmann::json& part) { return needs_further_fonts(part); });
}

/// What the PDF template needs beyond the view that all forms share.
nlohmann::json with_pdf_keys(const nlohmann::json& plain_view, bool further_fonts, bool attachment) {
    nlohmann::json view = with_typeset_tables(with_typeset_drawings(plain_view));
    // Noto Serif CJK has the Chinese, Japanese and Korean characters; TC draws them as in Taiwan and Hong Kong.
    view["fonts"] = further_fonts ? nlohmann::json::array({"Noto Serif CJK TC"}) : nlohmann::json::array();
    view["attachment"] = nlohmann::json::array();
    if (attachment) {
        view["attachment"].push_back(
            {{"name", "certificate.xml"}, {"description", "Digital calibration certificate (DCC)"}});
    }
    // PDF/A demands a date of creation; that of the computer would change the bytes with every run.
    if (!view.contains("created")) {
        view["created"] = {{"year", "1970"}, {"month", "1"}, {"day", "1"}};
    }
    return view;
}

std::string checked_pdf(const nlohmann::json& view, const RenderAssets& assets, const std::string& dcc,
                        PdfWorker& worker, const std::string& main) {
    const bool further_fonts = !assets.fonts.empty() && needs_further_fonts(view);
    std::string pdf = worker.set(with_pdf_keys(view, further_fonts, !dcc.empty()).dump(), dcc, further_fonts, main);
    auto [findings, pages] = check_and_read_pdf(pdf, dcc);
    if (findings.empty()) {
        findings = check_pages(pages, texts_of_every_page(view));
        if (findings.empty()) {
            findings = check_numbers(pages, view);
        }
    }
    if (!findings.empty()) {
        throw gum::NoResultError(std::move(findings));
    }
    return pdf;
}

/// \param worker  none: a process for this document alone
std::string set_by(PdfWorker* worker, const nlohmann::json& view, const RenderAssets& assets, const std::string& dcc,
                   const std::string& main = PdfWorker::k_certificate) {
    if (worker != nullptr) {
        return checked_pdf(view, assets, dcc, *worker, main);
    }
    PdfWorker own(assets);
    return checked_pdf(view, assets, dcc, own, main);
}

}  // namespace

std::string view_as_pdf(const nlohmann::json& view, const RenderAssets& assets, PdfWorker* worker) {
    return set_by(worker, view, assets, {});
}

std::vector<std::string> without_glyph(const std::vector<std::string>& characters, const nlohmann::json& view,
                                       const RenderAssets& assets, PdfWorker& worker) {
    const bool further_fonts = !assets.fonts.empty() && needs_further_fonts(view);
    if (worker.has_shown(characters, further_fonts)) {
        return {};
    }
    const auto texts = worker.texts_without_glyph(with_pdf_keys(view, further_fonts, false).dump(), further_fonts);
    if (!texts) {
        return {};
    }
    if (texts->empty()) {
        worker.remember_shown(characters, further_fonts);
    }
    std::string lacking;
    for (const std::string& quoted : *texts) {
        lacking += quoted + ' ';
    }
    std::vector<std::string> found;
    for (const std::string& character : characters) {
        // As Rust quotes what cannot be seen: u{200d}.
        const std::string escaped =
            "u{" + text::in_small_letters(text::hexadecimal(text::decode_utf8(character, 0).code, 1)) + "}";
        if (lacking.find(character) != std::string::npos || lacking.find(escaped) != std::string::npos) {
            found.push_back(character);
        }
    }
    return found;
}

std::string label_as_pdf(const nlohmann::json& view, const RenderAssets& assets, PdfWorker* worker) {
    return set_by(worker, view, assets, {}, "label.typ");
}

std::string document_as_pdf(const nlohmann::json& view, const RenderAssets& assets, const std::string& dcc,
                            PdfWorker* worker) {
    std::string pdf = set_by(worker, view, assets, dcc);
    require_head(pdf, "PDF", assets);
    return pdf;
}

std::string render_pdf(const EvaluationRecord& record, const RenderAssets& assets, const std::string& dcc,
                       PdfWorker* worker) {
    return document_as_pdf(view_of_document(record, assets), assets, dcc, worker);
}

std::string render_budget_report_pdf(const EvaluationRecord& record, const RenderAssets& assets, PdfWorker* worker) {
    return set_by(worker, view_of_budget_report(record, assets), assets, {});
}

}  // namespace gumcert::reports
