#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certificate_identity_sections.h"
#include "reports/wording.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string_view>

namespace gumcert::reports {

/// Adds sections of a record to a document.
using Sections = void (*)(CertificateBuilder&, const Wording&, const EvaluationRecord&);

inline void no_sections(CertificateBuilder& /*builder*/, const Wording& /*words*/, const EvaluationRecord& /*record*/) {
}

// Lists of a record that holds its results with their budgets, and nothing of its own.
void specimen_of_results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);
void evaluation_of_results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);
void summary_of_results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// What documents of the records of one kind show, in one row. What is not stated is that of a record with results.
struct DocumentKind {
    std::string_view word;  ///< `kind` of the record
    /// Whether a record holds what the sections read; else it is shown as one that has results only.
    bool (*holds)(const EvaluationRecord&) = [](const EvaluationRecord&) { return true; };
    /// Not a certificate but a report, which identifies and certifies nothing: its words in the section "document" of
    /// the wording begin like this: "comparison_" of "comparison_type", "comparison_only_items", "comparison_end_mark".
    std::string_view report = "";
    /// {header_left, header_right, footer_left}
    nlohmann::json (*running_texts)(const Wording&, const EvaluationRecord&) = reports::running_texts;
    Sections specimen = specimen_of_results;      ///< of a record without certificate data, or of a report
    Sections conventions = no_sections;           ///< of a certificate, below the certified tables
    Sections evaluation = evaluation_of_results;  ///< of a certificate: how its results were found, an annex
    Sections summary = summary_of_results;        ///< of one with annexes in short, in place of that and all below
    Sections evidence = no_sections;              ///< below either
    Sections measured_values = no_sections;       ///< at the end

    [[nodiscard]] bool is_report() const { return !report.empty(); }
};

/// The kinds of the program.
[[nodiscard]] std::span<const DocumentKind> document_kinds();

/// The row of a record; that of a measurement model where there is none, or the record lacks what the row shows.
[[nodiscard]] const DocumentKind& document_kind(const EvaluationRecord& record,
                                                std::span<const DocumentKind> kinds = document_kinds());

}  // namespace gumcert::reports
