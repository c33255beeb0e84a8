#include "issuing/run_files.h"

#include <cstddef>
#include <span>
#include <utility>

#include "evaluation/audit_evaluation.h"
#include "issuing/issue_documents.h"
#include "reports/audit/audit_html.h"

namespace gumcert::issuing {

namespace fs = std::filesystem;

std::vector<fs::path> evaluated_places(const fs::path& folder) {
    return {folder / k_record_file, folder / "covariance.csv", folder / k_audit_file};
}

std::vector<fs::path> document_places(const evaluation::Kind& kind, const fs::path& folder) {
    std::vector<fs::path> places;
    for (const std::string& name : document_names(kind)) {
        places.push_back(folder / name);
    }
    return places;
}

std::vector<outputs::OutputFile> evaluated_files(const evaluation::Evaluation& evaluation,
                                                 const fs::path& record_file) {
    std::vector<outputs::OutputFile> files{{record_file, reports::to_canonical_json(evaluation.record)}};
    if (!evaluation.covariance.empty()) {
        files.push_back({record_file.parent_path() / evaluation.covariance_file, evaluation.covariance});
    }
    return files;
}

outputs::OutputFile audit_file(const evaluation::Evaluation& evaluation, const fs::path& folder,
                               const reports::RenderAssets& assets) {
    return {folder / k_audit_file,
            reports::audit_as_html(evaluation::audit_view(std::span(evaluation.audit.get(), 1),
                                                          {evaluation.record.job_files.front().sha256}),
                                   assets)};
}

std::vector<outputs::OutputFile> document_files(const reports::EvaluationRecord& record, const fs::path& folder,
                                                const IssueOptions& options) {
    const std::vector<fs::path> places = document_places(evaluation::kind_of(record, options.kinds), folder);
    std::vector<IssuedDocument> issued = issue_documents(record, options);
    std::vector<outputs::OutputFile> files;
    for (std::size_t i = 0; i < issued.size(); ++i) {
        files.push_back({places[i], std::move(issued[i].bytes)});
    }
    return files;
}

}  // namespace gumcert::issuing
