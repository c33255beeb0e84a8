#pragma once

#include "gum/coverage_choice.h"
#include "jobs/input_text.h"
#include "jobs/job_fields.h"

// The keys that jobs of several kinds have.

namespace gumcert::jobs {

inline constexpr NumberRange k_coverage_probability{.low = 0.0,
                                                    .high = 1.0,
                                                    .low_open = true,
                                                    .high_open = true,
                                                    .hint = "state a probability, not a percentage, such as 0.9545"};

/// Of results. Below, k would be printed as 0.1 and less; above, one trial of 10⁹ decides, and no document has the digits.
inline constexpr NumberRange k_probability_of_results{
    .low = 0.1, .high = 0.999999999, .hint = "state a probability, not a percentage, such as 0.9545"};

template <class Archive>
void describe_head(Archive& a, std::string_view kind, std::string_view sentence = {}) {
    a.definition(kind, sentence);
    a.by_hand("$schema", R"({"$ref": "#/definitions/schema_of_editor"})", "a text",
              "Where an editor finds the JSON Schema of jobs; the program does not look at it.");
    a.constant("schema", "gumcert/job/1", "The form of the file.");
    a.constant("kind", kind, "The kind of the job.");
}

/// Read by read_title() of jobs/certificate.
template <class Archive>
void describe_title(Archive& a) {
    a.by_hand("title", R"({"anyOf": [{"$ref": "#/definitions/title"}, {"$ref": "#/definitions/certificate_text"}]})",
              "a text, or one in each language", "Free text, for documents and digital certificates.");
}

template <class Archive, class Job>
void describe_coverage(Archive& a, Job& job) {
    a("coverage_probability", job.coverage_probability, In{k_probability_of_results},
      "Of all results; 0.9545 when left out.");
    a("coverage", job.coverage, gum::k_coverage_choices,
      "Which evaluation is reported; as_validated when left out: the law of propagation where it is adequate, Monte "
      "Carlo elsewhere.");
}

template <class Archive>
void describe_certificate(Archive& a) {
    a.by_hand("certificate", R"({"$ref": "#/definitions/certificate"})", "an object, or the name of a file with one",
              "What the laboratory states on the certificate; without it the documents are specimens.");
    a.by_code("laboratory", FileName{},
              "Folder with the data of the laboratory (docs/laboratory.md), relative to the job.");
}

template <class Archive>
void describe_notes(Archive& a) {
    a.by_hand("notes", R"({"type": "string"})", "a text", "For people; the program does not look at it.");
}

}  // namespace gumcert::jobs
