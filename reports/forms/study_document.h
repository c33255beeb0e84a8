#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/forms/render.h"

namespace gumcert::reports {

struct StudyColumn {
    std::string head;
    std::string unit;  ///< "" leaves it out
    bool number = false;
};

struct StudyTable {
    std::string caption;
    std::vector<StudyColumn> columns;
    std::vector<std::vector<std::string>> rows;  ///< printed texts; "" is shown as "–"
};

struct StudyFigure {
    std::string caption;
    std::string alternative_text;
    std::string drawing;  ///< SVG
};

struct StudySection {
    std::string heading;
    std::vector<std::string> paragraphs;
    std::vector<StudyTable> tables;    ///< after the paragraphs
    std::vector<StudyFigure> figures;  ///< after the tables
};

/// What `gumcert simulate` and `gumcert plan` say: numbers for programs beside the same numbers for people. It is no
/// certificate: nothing in it was measured, and every form of it says so.
struct StudyDocument {
    std::string kind;  ///< "simulation" or "plan"
    std::string title;
    std::string subtitle;                                    ///< what was studied, one sentence
    std::vector<std::pair<std::string, std::string>> facts;  ///< label and value: job, runs, seed, program version
    std::vector<StudySection> sections;
    std::string data_json;  ///< canonical JSON, schema "gumcert/simulation/1" or "gumcert/plan/1"
};

[[nodiscard]] std::string render_text(const StudyDocument& study);
/// \throws StorageError if templates or the PDF program are missing
[[nodiscard]] std::string render_html(const StudyDocument& study, const RenderAssets& assets);
/// \param worker  none: a process for this document alone
[[nodiscard]] std::string render_pdf(const StudyDocument& study, const RenderAssets& assets,
                                     PdfWorker* worker = nullptr);

/// Which of some characters no font of a PDF has: a page with nothing else is set for it, in headings and in text.
/// \return in their order
/// \throws gum::StorageError  where no page can be set at all, as render_pdf() of a record
[[nodiscard]] std::vector<std::string> characters_without_glyph(const std::vector<std::string>& characters,
                                                                const RenderAssets& assets, PdfWorker& worker);

}  // namespace gumcert::reports
