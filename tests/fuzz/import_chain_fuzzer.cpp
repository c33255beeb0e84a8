#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "evaluation/evaluate_job.h"
#include "gum/quantity/diagnostic.h"
#include "imports/import_certificate.h"
#include "imports/import_standard.h"
#include "jobs/budget/budget_job.h"
#include "jobs/laboratory/register_reader.h"
#include "reports/record/evaluation_record.h"
#include "tests/fuzz/job_targets.h"

namespace gumcert::fuzz {
namespace {

/// What was imported is a job that is read, evaluated, written as a record and read again.
void evaluate_imported(const imports::ImportedJob& imported) {
    jobs::fuzz::demand_honest(imported.remarks);
    const jobs::MemoryFileSource files({{"job.json", imported.job}});
    try {
        (void)jobs::read_budget_job(files, "job.json");
    } catch (const gum::InputError& error) {
        demand(false, gum::message(error.diagnostics().front()).c_str());
    }
    try {
        const evaluation::Evaluation evaluation = evaluation::evaluate_job(
            files, "job.json", evaluation::CovarianceFile::none, 1, GUMCERT_SOURCE_DIR "/templates");
        const std::string written = reports::to_canonical_json(evaluation.record);
        demand(reports::to_canonical_json(reports::record_from_json(written, "written")) == written,
               "another record comes back");
    } catch (const gum::DiagnosedError& error) {
        demand(false, gum::message(error.diagnostics().front()).c_str());
    }
}

/// What was imported as a standard is refused for its drift alone, which no certificate states.
void read_imported_standard(const imports::ImportedJob& imported) {
    jobs::ProblemList problems("standard.json");
    const std::optional<jobs::JsonDocument> document = jobs::read_json_document(imported.job, problems);
    demand(document.has_value() && problems.refusals() == 0, "a standard that is no JSON");
    demand(!jobs::read_standard(*document, problems), "a standard without a drift");
    jobs::fuzz::demand_honest(problems.refused());
}

template <class Import>
bool imported_or_refused(const Import& import) {
    try {
        import();
        return true;
    } catch (const gum::InputError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
        jobs::fuzz::demand_honest(error.diagnostics());
        return false;
    }
}

}  // namespace
}  // namespace gumcert::fuzz

/// Any bytes are refused, or are a certificate from which a job is made that can be evaluated as it is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    (void)fuzz::imported_or_refused(
        [&] { fuzz::evaluate_imported(imports::import_certificate(bytes, "certificate.xml")); });
    (void)fuzz::imported_or_refused(
        [&] { fuzz::read_imported_standard(imports::import_standard(bytes, "certificate.xml", "STD-1")); });
    return 0;
}
