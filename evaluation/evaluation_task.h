#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "certificate/certificate_data.h"
#include "certificate/laboratory_register.h"
#include "certificate/profile.h"
#include "gum/quantity/progress.h"
#include "jobs/file_source.h"
#include "reports/record/evaluation_record.h"
#include "reports/record/make/certificate/certify.h"
#include "reports/record/make/covariance_file.h"

namespace gumcert::evaluation {

/// Where the covariance file of a record will stand, which decides its name. The name never depends on that of the
/// record: a job gives the same record wherever it is written.
enum class CovarianceFile {
    none,         ///< it will not be written
    own_folder,   ///< alone in its folder: covariance.csv, .npy or -parts.npy by its form
    with_others,  ///< beside those of other jobs: covariance-<digest of the files of the job>.csv …
};

/// The covariance file that is asked for.
struct CovarianceOutput {
    CovarianceFile file = CovarianceFile::none;
    reports::CovarianceForm form = reports::CovarianceForm::automatic;

    // NOLINTNEXTLINE(google-explicit-constructor): a place alone asks for the form that suits the size
    CovarianceOutput(CovarianceFile place, reports::CovarianceForm as = reports::CovarianceForm::automatic)
        : file(place), form(as) {}
    /// Whether a covariance file is to be written at all.
    [[nodiscard]] bool is_written() const {
        return file != CovarianceFile::none && form != reports::CovarianceForm::none;
    }
    /// Its name in this form, for a job with these files.
    [[nodiscard]] std::string name(reports::CovarianceForm written, const std::vector<reports::InputFile>& files) const;
};

struct Evaluation {
    reports::EvaluationRecord record;
    std::string covariance;       ///< contents of the file that the record names; empty: there is none
    std::string covariance_file;  ///< its name; empty where `covariance` is
    bool negative = false;        ///< evaluated, and the answer is no: not validated where validation was demanded
    bool blocked = false;         ///< critical findings block the issue of the certificate
    /// Puts budgets that the results rest on beside them, for the audit; empty where there are none.
    std::function<void(audit::AuditSubject&)> add_nested_budgets = {};
    /// What an assessor would remark; set by evaluate_job().
    std::shared_ptr<const audit::AuditReport> audit = {};
    /// What the audit alone found critical, beside the gates of a certificate, and nobody accepts; set with `audit`.
    std::vector<certificate::Finding> critical_of_audit = {};
    std::vector<certificate::Waiver> waivers = {};  ///< of a job whose record is no certificate
};

/// A job whose reader has found nothing wrong, before it is evaluated.
struct ReadJob {
    const jobs::FileSource& files;
    const std::vector<std::string>& names;  ///< of its files, the job first
    double memory = 0.0;                    ///< about what its evaluation and record take, [byte]; 0: not known
};
/// Looks at a job before its evaluation, which may take long.
using BeforeEvaluation = std::function<void(const ReadJob&)>;

/// What the evaluation of a job is given, whatever its kind.
struct EvaluationTask {
    const jobs::ReadOnceSource& files;
    const std::string& job_file;  ///< name in `files`
    const CovarianceOutput& covariance;
    unsigned threads = 0;  ///< of Monte Carlo; 0: as many as the machine has
    const std::filesystem::path& templates;
    const gum::Progress& progress;
    const BeforeEvaluation& before = k_nothing;

    inline static const BeforeEvaluation k_nothing = {};

    /// To be called by every kind between reading and evaluating.
    /// \param names   as the reader of the job lists them, the job first
    /// \param memory  as of ReadJob
    void begin(const std::vector<std::string>& names, double memory = 0.0) const {
        if (before) {
            before({files, names, memory});
        }
    }

    /// The files of the job as its record states and holds them: the bytes that were parsed, up to 8 MiB of one file and
    /// 16 MiB of all.
    /// \param names  as the reader of the job lists them, the job first
    [[nodiscard]] std::vector<reports::InputFile> held_files(const std::vector<std::string>& names) const;

    /// The profile that certificate data ask for: found before the evaluation, which may take long.
    /// \throws gum::InputError  GC-CERT-0300 for a profile that is not in the folder
    [[nodiscard]] std::optional<certificate::Profile> profile_of(
        const std::optional<certificate::CertificateData>& data) const;
};

/// Certifies the record of an evaluation where the job states certificate data; else nothing.
/// \param task  whose laboratory, where it has one, the certificate is held against
void make_certificate(const EvaluationTask& task, Evaluation& evaluation,
                      const std::optional<certificate::CertificateData>& data,
                      const std::optional<certificate::Profile>& profile, const certificate::CapabilityInputs& inputs);
/// The same of a job whose reader has handed on what the register says of it; none where it names no laboratory.
void certify(Evaluation& evaluation, const certificate::CertificateData& data, const certificate::Profile& profile,
             const certificate::CapabilityInputs& inputs,
             const std::optional<certificate::LaboratoryRegister>& registered);

}  // namespace gumcert::evaluation
