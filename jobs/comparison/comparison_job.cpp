#include "jobs/comparison/comparison_job.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "certificate/stated_text.h"
#include "certificate/text_words.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/certificate/certificate_statement.h"
#include "jobs/comparison/comparison_methods.h"
#include "jobs/comparison/comparison_participants.h"
#include "jobs/comparison/comparison_reading.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_kind.h"
#include "jobs/job_reader.h"
#include "jobs/laboratory/laboratory_certificate.h"
#include "jobs/laboratory/laboratory_use.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

/// An amended report says which one it amends or replaces, why, and what has changed (ISO/IEC 17025:2017, 7.8.8.1). Of certificates
/// the gates before issue ask it; a report has none, and prints what is stated.
void require_whole_amendment(const certificate::CertificateData& data, const std::string& where,
                             ProblemList& problems) {
    if (!data.amendment) {
        return;
    }
    const certificate::Amendment& stated = *data.amendment;
    const auto refuse = [&](std::string what, std::string action) {
        problems.refuse(k_incomplete_amendment, where, std::move(what),
                        "an amended report says which one it amends or replaces, why, and what has changed (ISO/IEC "
                        "17025:2017, 7.8.8.1)",
                        std::move(action));
    };
    if (!certificate::is_stated(stated.number)) {
        refuse("the report that this one amends or replaces is not named",
               "state its number in \"number\" of the amendment");
    } else if (certificate::letters_of(stated.number) == certificate::letters_of(data.number)) {
        refuse("the report has the number " + text::in_quotes(stated.number) + " of the one that it amends or replaces",
               "give it a number of its own");
    }
    if (!certificate::states_a_reason(stated.reason)) {
        refuse("no reason for the amendment is stated", "state \"reason\" of the amendment");
    }
    if (!certificate::any_stated(stated.changes)) {
        refuse("what has changed is not stated", "state \"changes\" of the amendment, a list of texts");
    }
}

/// Reads one job; every step notes what it finds, and `result` throws or returns at the end.
class Reader {
public:
    Reader(const FileSource& source, const std::string& job_file)
        : files_(source, job_file), budgets_(source, files_) {}

    ComparisonJob result() {
        const JobFiles::File file = files_.job();
        std::optional<JsonDocument> document = read_json_document(file.bytes, *file.problems);
        if (document) {
            read_job(*document, *file.problems);
        }
        files_.refuse_if_needed();
        job_.document = std::move(document->value);
        job_.files = files_.names();
        job_.warnings = files_.warnings();
        return std::move(job_);
    }

private:
    void read_job(const JsonDocument& document, ProblemList& problems) {
        const std::optional<std::string> kind = read_kind(document, problems);
        if (!kind || is_record(document)) {
            return;
        }
        if (*kind != k_comparison_kind) {
            problems.refuse(k_wrong_kind, document.where("/kind"), "a job of kind " + text::in_quotes(*kind),
                            "a job of kind \"comparison\" is expected here", "use the command for this kind of job");
            return;
        }
        const std::optional<JsonObject> root = JsonObject::root(document, keys_of<ComparisonStatement>(), problems);
        if (!root) {
            return;
        }
        const ComparisonReading reading{document, files_, problems, budgets_, job_};
        read_common(reading, *root);
        switch (form_of(*root)) {
            case Form::laboratories:
                read_laboratories(reading, *root);
                break;
            case Form::methods:
                read_methods(reading, *root);
                break;
            case Form::neither:
                break;
        }
        LaboratoryUse laboratory(files_, document, problems);
        LaboratoryCertificate completion(laboratory);
        job_.certificate = read_certificate(files_, document, problems, &completion);
        if (job_.certificate) {
            require_whole_amendment(*job_.certificate, document.where("/certificate/amendment"), problems);
        }
    }

    /// A record that is taken for a job is refused as such, once, and not key by key.
    static bool is_record(const JsonDocument& document) {
        if (!document.value.is_object() || !document.value.contains("schema")) {
            return false;
        }
        const nlohmann::json& schema = document.value.at("schema");
        return schema.is_string() && schema.get_ref<const std::string&>().starts_with("gumcert/record/");
    }

    void read_common(const ComparisonReading& reading, const JsonObject& root) {
        JobReader reader(root);
        read_title(root, {&reading.document, root.pointer("title"), &reading.problems}, job_.title);
        reader.read(stated_, {"coverage_probability"});
        read_unused_texts(root);
        reader.read(stated_, {"organiser", "artefact_stability"});
        job_.independent_sources = read_texts(reading, root, "independent_sources");
        job_.different_sources = read_texts(reading, root, "different_sources");
    }

    enum class Form { neither, laboratories, methods };

    /// Which of the two forms the job has; refuses keys of the other one.
    static Form form_of(const JsonObject& root) {
        const bool has_methods = root.has("lab") || root.has("reference");
        const bool has_laboratories = root.has("participants") || root.has("results");
        if (has_methods == has_laboratories) {
            root.refuse(k_comparison_form, has_methods ? "participants" : "",
                        has_methods ? "participants beside \"lab\" and \"reference\""
                                    : "neither participants nor \"lab\" and \"reference\"",
                        "laboratories are compared as \"participants\", a method with a reference method as \"lab\" "
                        "and \"reference\"",
                        has_methods ? "make two jobs of it" : "add the ones or the others");
            return Form::neither;
        }
        for (const std::string_view key :
             has_methods ? keys_of<LaboratoriesStatement>() : keys_of<MethodComparisonRequest>()) {
            if (root.has(key)) {
                root.refuse(k_comparison_form, key, "the key " + text::in_quotes(key) + " belongs to the other form",
                            has_methods ? "it is a key of comparisons between laboratories, with \"participants\""
                                        : "it is a key of comparisons of methods, with \"lab\" and \"reference\"",
                            "remove it");
            }
        }
        return has_methods ? Form::methods : Form::laboratories;
    }

    /// Whether the job says anything that makes results of different participants correlate.
    static bool states_correlation(const ComparisonJob& job) {
        return !job.correlations.empty() || !job.group_correlation.empty() ||
               std::any_of(job.results.begin(), job.results.end(), [](const ComparisonResult& result) {
                   return !result.sources.empty() || result.budget != nullptr;
               });
    }

    /// A way to the assigned value where the job states none: one whose uncertainty holds also where laboratories
    /// differ by more than they state, as far as the results allow it.
    static void choose_assigned_value(ComparisonJob& job) {
        for (gum::ComparisonItem& item : job.items) {
            if (item.assigned_value.by_default) {
                item.assigned_value.method = states_correlation(job) ? gum::AssignedValueMethod::weighted_mean
                                                                     : gum::AssignedValueMethod::mandel_paule;
            }
        }
    }

    static void read_laboratories(const ComparisonReading& reading, const JsonObject& root) {
        LaboratoriesStatement stated;
        JobReader(root).read(stated, {"names"});
        reading.job.names_released = stated.names_released;
        ParticipantsReader participants(reading, root);
        participants.read();
        read_participant_correlations(reading, root, participants);
        read_vectors(reading, root, participants);
        read_youden(reading, root, participants);
        choose_assigned_value(reading.job);
        check_results(reading, participants);
    }

    JobFiles files_;
    ComparisonBudgets budgets_;
    ComparisonStatement stated_;
    ComparisonJob& job_ = stated_.job;
};

}  // namespace

const JobFields& comparison_fields() {
    return fields_of<ComparisonStatement>();
}

std::span<const JobKeys> comparison_job_keys() {
    static const JobKeyTable k_keys(comparison_fields());
    return k_keys.objects();
}

ComparisonJob read_comparison_job(const FileSource& source, const std::string& job_file) {
    return Reader(source, job_file).result();
}

ComparisonJob read_comparison_job(const std::filesystem::path& job_file) {
    return read_comparison_job(DiskFileSource::of_job(job_file), job_file.filename().string());
}

}  // namespace gumcert::jobs
