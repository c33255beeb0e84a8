#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reports/forms/render.h"

namespace gumcert::reports {

/// One style of a font that a template may use.
struct TemplateFont {
    std::string family, style;
    std::string from;  ///< its folder; "" where it is built in
};

/// A Node process that stays, for many documents: the Typst compiler and its fonts are loaded once. It is started at
/// the first document, and again when it ended, took too long, or has set so many documents that its memory may have
/// grown. One document at a time; not for several threads at once.
///
/// Typst sees the files of one document in a private folder, which is removed after it, the fonts that are built in,
/// those in the folder `fonts` beside the template, and those of RenderAssets::fonts; never the fonts of the machine. So the bytes depend on the document alone.
class PdfWorker {
public:
    static constexpr const char* k_certificate = "certificate.typ";

    explicit PdfWorker(RenderAssets assets);
    ~PdfWorker();
    PdfWorker(const PdfWorker&) = delete;
    PdfWorker& operator=(const PdfWorker&) = delete;

    /// \param view           what the template reads as view.json, JSON text
    /// \param attachment     the DCC, read by the template as certificate.xml; "" without
    /// \param further_fonts  whether the document needs RenderAssets::fonts, which take time to open
    /// \param main           name of the template in templates/pdf
    /// \return the PDF, unchecked
    /// \throws gum::StorageError, gum::NoResultError  as render_pdf()
    [[nodiscard]] std::string set(const std::string& view, const std::string& attachment, bool further_fonts = false,
                                  const std::string& main = k_certificate);

    /// Sets a document and throws it away.
    /// \return the texts in it that no font can show, as Typst quotes them; no list where it cannot be set for another reason
    /// \throws gum::StorageError  as render_pdf()
    [[nodiscard]] std::optional<std::vector<std::string>> texts_without_glyph(const std::string& view,
                                                                              bool further_fonts);

    /// Whether a page has been set with all of these characters, and the same fonts. Jobs of one command have most characters
    /// in common; the first one sets a page also where it has none, so that node and Typst are known to work.
    [[nodiscard]] bool has_shown(const std::vector<std::string>& characters, bool further_fonts) const;
    void remember_shown(const std::vector<std::string>& characters, bool further_fonts);

    /// Looks for what a page needs, so that it is told before work begins that would be lost: node, the Typst package,
    /// the template, and a folder for its files.
    /// \throws gum::StorageError  GC-REPORT-0010
    void require_ready() const;

    /// The fonts that templates may use, built-in ones first, in the order of their files.
    /// \throws gum::StorageError  as render_pdf()
    [[nodiscard]] std::vector<TemplateFont> fonts();

private:
    class Process;
    RenderAssets assets_;
    std::unique_ptr<Process> process_;
    std::map<bool, std::set<std::string>> shown_;  ///< characters, by whether there were further fonts

    Process& running();
};

}  // namespace gumcert::reports
