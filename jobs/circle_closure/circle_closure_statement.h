#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/circle_closure.h"
#include "jobs/circle_closure/circle_closure_job.h"
#include "jobs/job_common_fields.h"
#include "jobs/job_fields.h"
#include "jobs/monte_carlo_request.h"

namespace gumcert::jobs {

// What the file of a circle_closure job says, and its description (jobs/job_fields.h). Values in units of the job,
// which are known only when the job is read, are read by code.

struct RepeatabilityStatement {
    std::optional<double> degrees_of_freedom;
    bool replaces_residuals = false;
    std::string source;
};

struct EffectStatement {
    std::string name;
    engine::ClosurePattern pattern = engine::ClosurePattern::reading;
};

struct CircleClosureStatement {
    CircleClosureJob job;
    std::optional<std::string> readings;  ///< name of the file
    RepeatabilityStatement repeatability;
    std::vector<EffectStatement> effects;
    MonteCarloStatement monte_carlo;
};

inline constexpr std::size_t k_most_effects = 100;
/// Whether the sides of the artefact are numbered against the sense in which the table turns.
inline constexpr Words<bool, 2> k_closure_numberings{{{"with", false}, {"against", true}}};
inline constexpr Words<engine::ClosurePattern, 6> k_closure_patterns{
    {{"scale", engine::ClosurePattern::scale},
     {"reading", engine::ClosurePattern::reading},
     {"step", engine::ClosurePattern::step},
     {"side", engine::ClosurePattern::side},
     {"turn", engine::ClosurePattern::turn},
     {"once_per_turn", engine::ClosurePattern::once_per_turn}}};

template <class Archive>
void describe(Archive& a, RepeatabilityStatement& r) {
    constexpr Words<bool, 2> k_uses{{{"check", false}, {"stated", true}}};
    a.needed_by_hand("u", R"({"type": "number", "exclusiveMinimum": 0})",
                     "a number greater than 0, in the unit of the job", "Standard uncertainty of one reading.");
    a("nu", r.degrees_of_freedom, In{{.low = 1.0, .high = 1e9, .hint = "leave it out where u is known exactly"}},
      "Its degrees of freedom; left out: u is known exactly.");
    a("use", r.replaces_residuals, k_uses,
      "A test of the residuals (check, when left out), or in place of them (stated).");
    a("source", r.source, Line{}, "Where it is from.");
}

// How an uncertainty may be stated is the business of StatementKeys; the keys are those of an input of a budget.
template <class Archive>
void describe(Archive& a, EffectStatement& r) {
    constexpr In k_positive{above_zero("")};
    a.needed("name", r.name, Line{}, "Of the row of the budget.");
    a.needed("acts_on", r.pattern, k_closure_patterns, "What the effect moves.");
    a.by_hand("unit", R"({"type": "string", "minLength": 1})", "a unit",
              "Of the values below; left out: 1 for a scale, that of the job else.");
    a.by_code("value", In{}, "Of a scale or a turn, in ratio or for a full turn; else 0.");
    a.by_code("u", k_positive, "Standard uncertainty.");
    a.by_code("U", k_positive, "Expanded uncertainty, with k or p.");
    a.by_code("k", k_positive, "Its coverage factor.");
    a.by_code("p", In{k_coverage_probability}, "Its coverage probability.");
    a.by_code("nu", k_degrees_of_freedom, "Degrees of freedom of the uncertainty.");
    a.by_code("reliability", In{{.low = 0.0, .high = 1.0, .low_open = true}},
              "Relative uncertainty of the uncertainty, in place of nu.");
    a.by_code("half_width", k_positive, "Of the distribution.");
    a.by_code("resolution", k_positive, "Full step of an indication.");
    a.by_code("distribution", AnyText{}, "Beside half_width.");
    a.by_code("type", Words<char, 2>{{{"A", 'A'}, {"B", 'B'}}}, "Of the evaluation.");
    a.by_code("source", AnyText{}, "Where it is from.");
    a.by_code("note", AnyText{}, "For people.");
    a.exactly_one_of({"u", "U", "half_width", "resolution"});
}

template <class Archive>
void describe(Archive& a, CircleClosureStatement& r) {
    constexpr Words<char, 3> k_axis_letters{{{"A", 'A'}, {"B", 'B'}, {"C", 'C'}}};
    constexpr Words<double, 2> k_senses{{{"positive", 1.0}, {"negative", -1.0}}};
    constexpr Words<bool, 2> k_drifts{{{"none", false}, {"linear", true}}};
    engine::CircleClosureMeasurement& measurement = r.job.measurement;
    describe_head(a, k_circle_closure_kind);
    describe_title(a);
    describe_notes(a);
    describe_coverage(a, r.job);
    describe_certificate(a);
    a.needed("steps", measurement.steps, Whole{{.low = 3.0, .high = 360.0}}, "Equal steps of a full turn.");
    a.needed("readings", r.readings, FileName{},
             "CSV: position, step, reading, and repetition where positions were measured more than once.");
    a.by_hand("unit", R"({"type": "string", "minLength": 1})", "a unit of angle",
              "Of readings and results; arcsec when left out.");
    a("axis", r.job.axis, k_axis_letters, "Deviations of the table are then named EAA, EBB or ECC; else T.");
    a("first_angle_deg", r.job.first_angle_deg, In{between(-360.0, 360.0, "°")},
      "Of the table at step 0; 0 when left out.");
    a("artefact", r.job.artefact, Line{}, "What stands on the table, for documents.");
    a.needed("numbering", measurement.against, k_closure_numberings,
             "Of the sides of the artefact, with or against the sense in which the table turns.");
    a("sense", measurement.sense, k_senses, "Of the reading, when the table turns on; positive when left out.");
    a("drift", measurement.removes_drift, k_drifts,
      "none when left out; linear: every series has a slope of its own, which is removed.");
    a.list("effects", r.effects, "Influence quantities that the readings do not show.", {.most = k_most_effects});
    a.part("repeatability", r.repeatability, "Of one reading, from earlier work.");
    a.part("monte_carlo", r.monte_carlo, "Monte Carlo beside the law of propagation.");
}

/// The keys of a circle_closure job, what they mean and what they allow.
[[nodiscard]] const JobFields& circle_closure_fields();

}  // namespace gumcert::jobs
