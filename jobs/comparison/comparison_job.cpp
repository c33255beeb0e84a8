#include "jobs/comparison/comparison_job.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "jobs/certificate/certificate_statement.h"
#include "jobs/comparison/comparison_keys.h"
#include "jobs/comparison/comparison_methods.h"
#include "jobs/comparison/comparison_participants.h"
#include "jobs/comparison/comparison_reading.h"
#include "jobs/job_kind.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

constexpr NumberRange k_probability{.low = 0.0,
                                    .high = 1.0,
                                    .low_open = true,
                                    .high_open = true,
                                    .hint = "state a probability, not a percentage, such as 0.9545"};

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
        const std::optional<JsonObject> root = JsonObject::root(document, k_comparison_keys, problems);
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
        job_.certificate = read_certificate(files_, document, problems);
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
        if (root.has("title")) {
            job_.title = root.optional_name("title", 1000).value_or("");
        }
        job_.coverage_probability = root.optional_number("coverage_probability", k_probability).value_or(0.9545);
        read_unused_texts(root);
        job_.organiser = root.optional_name("organiser", 1000).value_or("");
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
        const std::span<const std::string_view> others = has_methods
                                                             ? std::span<const std::string_view>{k_laboratories_keys}
                                                             : std::span<const std::string_view>{k_methods_keys};
        for (const std::string_view key : others) {
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
        constexpr std::array<std::pair<std::string_view, bool>, 2> k_names{
            {{"confidential", false}, {"released", true}}};
        reading.job.names_released = root.optional_choice("names", k_names).value_or(false);
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
    ComparisonJob job_;
};

}  // namespace

std::span<const JobKeys> comparison_job_keys() {
    static const std::vector<JobKeys> k_all{{"", k_comparison_keys},
                                            {"/participants/*", k_participant_result_keys},
                                            {"/participants/*/audited", k_audited_uncertainty_keys},
                                            {"/participants/*/sources/*", k_source_keys},
                                            {"/results/*", k_result_keys},
                                            {"/results/*/audited", k_audited_uncertainty_keys},
                                            {"/results/*/sources/*", k_source_keys},
                                            {"/items/*", k_listed_item_keys},
                                            {"/items/*/assigned_value", k_assigned_value_keys},
                                            {"/items/*/sigma_pt", k_sigma_keys},
                                            {"/items/*/reference_value", k_reference_value_keys},
                                            {"/assigned_value", k_assigned_value_keys},
                                            {"/assigned_value/sources/*", k_source_keys},
                                            {"/sigma_pt", k_sigma_keys},
                                            {"/reference_value", k_reference_value_keys},
                                            {"/vectors/*", k_vector_keys},
                                            {"/lab", k_side_keys},
                                            {"/lab/points/*", k_point_keys},
                                            {"/lab/audited", k_audited_factor_keys},
                                            {"/reference", k_side_keys},
                                            {"/reference/points/*", k_point_keys},
                                            {"/reference/audited", k_audited_factor_keys},
                                            {"/position", k_position_keys}};
    return k_all;
}

ComparisonJob read_comparison_job(const FileSource& source, const std::string& job_file) {
    return Reader(source, job_file).result();
}

ComparisonJob read_comparison_job(const std::filesystem::path& job_file) {
    return read_comparison_job(DiskFileSource(job_file.parent_path()), job_file.filename().string());
}

}  // namespace gumcert::jobs
