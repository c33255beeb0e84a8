#include "evaluation/evaluation_task.h"

#include <utility>

#include "certificate/gates/register_gate.h"
#include "encoding/sha2.h"
#include "evaluation/certificate_profile.h"
#include "jobs/laboratory/laboratory_use.h"

namespace gumcert::evaluation {

namespace {

// A record holds the files of its job, so that it can be evaluated again: up to so many bytes of one and of all.
constexpr std::size_t k_largest_held_file = std::size_t{8} << 20U;
constexpr std::size_t k_most_held_bytes = std::size_t{16} << 20U;

}  // namespace

std::string CovarianceOutput::name(reports::CovarianceForm written,
                                   const std::vector<reports::InputFile>& files) const {
    if (file == CovarianceFile::own_folder) {
        return "covariance" + reports::covariance_ending(written);
    }
    std::string digests;
    for (const reports::InputFile& read : files) {
        digests += read.sha256;
    }
    return "covariance-" + encoding::sha256(digests).substr(0, 12) + reports::covariance_ending(written);
}

std::vector<reports::InputFile> EvaluationTask::held_files(const std::vector<std::string>& names) const {
    std::vector<reports::InputFile> held_ones;
    std::size_t held = 0;
    for (const std::string& name : names) {
        const std::string bytes = files.read(name);
        const bool holds = bytes.size() <= k_largest_held_file && held + bytes.size() <= k_most_held_bytes;
        held += holds ? bytes.size() : 0;
        held_ones.push_back(reports::input_file(name, bytes, holds));
    }
    return held_ones;
}

std::optional<certificate::Profile> EvaluationTask::profile_of(
    const std::optional<certificate::CertificateData>& data) const {
    return data ? std::optional(certificate_profile(*data, templates)) : std::nullopt;
}

void make_certificate(const EvaluationTask& task, Evaluation& evaluation,
                      const std::optional<certificate::CertificateData>& data,
                      const std::optional<certificate::Profile>& profile, const certificate::CapabilityInputs& inputs) {
    if (data && profile) {
        certify(evaluation, *data, *profile, inputs, jobs::register_of_job(task.files, task.job_file));
    }
}

void certify(Evaluation& evaluation, const certificate::CertificateData& data, const certificate::Profile& profile,
             const certificate::CapabilityInputs& inputs,
             const std::optional<certificate::LaboratoryRegister>& registered) {
    reports::certify(
        evaluation.record, data, profile, inputs,
        registered ? certificate::register_findings(data, *registered) : std::vector<certificate::Finding>());
    evaluation.blocked = evaluation.record.certificate->blocked;
}

}  // namespace gumcert::evaluation
