#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/comparison/comparison_job.h"
#include "jobs/comparison/comparison_side.h"
#include "jobs/job_common_fields.h"
#include "jobs/job_fields.h"
#include "jobs/monte_carlo_request.h"

namespace gumcert::jobs {

// What the file of a comparison job says, and its description (jobs/job_fields.h). Uncertainties, and all that a column
// of a CSV file may state as well, are read by code. Messages list keys in the order of the descriptions.

/// A result, without whose it is.
struct ResultStatement {
    ComparisonResult result;
    std::string item, round;
};
/// One entry of `participants`, with a result where the job has no `results`.
struct ParticipantStatement {
    gum::ComparisonParticipant participant;
    ResultStatement result;
};
/// One entry of `results`.
struct ListedResult {
    std::string participant;
    ResultStatement result;
};
struct ListedItem {
    gum::ComparisonItem item;
};
struct ReferenceValueStatement {
    double value = 0.0;
};
/// The keys of a comparison between laboratories.
struct LaboratoriesStatement {
    std::vector<ParticipantStatement> participants;
    std::vector<ListedResult> results;
    std::vector<ListedItem> items;
    std::vector<gum::ComparisonVector> vectors;
    bool names_released = false;
    gum::ComparisonItem item;  ///< what holds for items that state nothing else
};
/// The whole job file.
struct ComparisonStatement {
    ComparisonJob job;
    LaboratoriesStatement laboratories;
    MethodComparisonRequest methods;
};

/// A number that is squared and divided by.
[[nodiscard]] constexpr In positive(std::string_view hint) {
    return {{.low = 0.0, .low_open = true, .hint = hint},
            1.0,
            NumberRange{.low = k_least_compared_u, .high = k_largest_compared, .hint = hint}};
}

inline constexpr Line k_sentence{1000};
/// The largest u and U are those that can be computed with, and are refused together.
inline constexpr In k_stated_uncertainty{k_compared_uncertainty, 1.0,
                                         between(k_least_compared_u, k_largest_compared, "")};
inline constexpr NumberRange k_coverage_factor{
    .low = 0.0, .high = 1e6, .low_open = true, .hint = "state the coverage factor of the certificate, usually 2"};
inline constexpr NumberRange k_observations{.low = 1.0, .high = 1e9};
inline constexpr NumberRange k_deviation{.low = 0.0, .high = k_largest_compared};
inline constexpr In k_given_sigma_pt = positive("state the standard deviation that results are scored with");
inline constexpr Words<gum::SigmaPtMethod, 2> k_sigma_pt_words{
    {{"robust", gum::SigmaPtMethod::robust}, {"standard_deviation", gum::SigmaPtMethod::standard_deviation}}};
inline constexpr NumberRange k_alpha{.low = 0.0,
                                     .high = 0.5,
                                     .low_open = true,
                                     .high_open = true,
                                     .hint = "state the probability of failing a consistent set, 0.05 is usual"};
inline constexpr auto k_assigned_value_methods = [] {
    Words<gum::AssignedValueMethod, gum::k_assigned_value_words.size()> methods{};
    for (std::size_t i = 0; i < methods.size(); ++i) {
        methods[i] = {gum::k_assigned_value_words[i], static_cast<gum::AssignedValueMethod>(i)};
    }
    return methods;
}();
/// Those that need no other key: all but the first two.
inline constexpr auto k_methods_without_keys = [] {
    Words<gum::AssignedValueMethod, k_assigned_value_methods.size() - 2> methods{};
    for (std::size_t i = 0; i < methods.size(); ++i) {
        methods[i] = k_assigned_value_methods[i + 2];
    }
    return methods;
}();
inline constexpr Words<MethodCorrelation, 3> k_method_correlations{
    {{"none", MethodCorrelation::none},
     {"unknown", MethodCorrelation::unknown},
     {"shared_sources", MethodCorrelation::shared_sources}}};
// Uncertainties times the factor are squared and divided by.
inline constexpr NumberRange k_audited_factor{
    .low = 1e-6, .high = 1e6, .hint = "state what every uncertainty is multiplied by, such as 0.577"};
/// Rows of numbers, all of one length.
inline constexpr Several k_rows{Several{In{k_compared_value}, 1}, 1};

template <class Archive>
void describe_unit_of_comparison(Archive& a, std::string_view sentence) {
    a.by_hand("unit", R"({"$ref": "#/definitions/certificate_unit"})", "a unit", sentence);
}

template <class Archive>
void describe_uncertainty(Archive& a) {
    a.by_code("u", k_stated_uncertainty, "Standard uncertainty.");
    a.by_code("U", k_stated_uncertainty, "Expanded uncertainty: u = U/k.");
    a.by_code("k", In{k_coverage_factor}, "Its coverage factor.");
    a.by_code("nu", k_degrees_of_freedom, "Degrees of freedom of u; inf when left out.");
    a.needs("U", "k");
    a.needs("k", "U");
}

// ---- laboratories ---------------------------------------------------------------------------------------------------

template <class Archive>
void describe(Archive& a, gum::UncertaintySource& r) {
    a.definition("comparison_source");
    a.needed("source", r.source, Line{}, "The same name in all results that share it.");
    a.needed("u", r.contribution, In{k_compared_value}, "Its part of the standard uncertainty, signed.");
}

template <class Archive>
void describe(Archive& a, gum::AuditedUncertainty& r) {
    a.definition("comparison_audited_uncertainty");
    describe_uncertainty(a);
    a.needed("finding", r.finding, k_sentence, "What the audit found.");
    a.exactly_one_of({"u", "U"});
}

template <class Archive>
void describe(Archive& a, ResultStatement& r) {
    a("item", r.item, Label{}, "Where there are several: all results state it, or none.");
    a("round", r.round, Label{}, "Where there are several: all results state it, or none.");
    a.by_code("value", Either{In{k_compared_value}, Null{}}, "Left out or null: a missing result.");
    describe_uncertainty(a);
    a("s", r.result.standard_deviation, In{k_deviation}, "Standard deviation of single observations.");
    a("n", r.result.observations, Whole{k_observations}, "Their number.");
    a("contributes", r.result.contributes, Truth{}, "To the assigned value; true when left out.");
    a("reason", r.result.reason, k_sentence, "Why it does not, or why the result is missing.");
    a.list("sources", r.result.sources, "Parts of u from named sources, in the unit of the item.");
    a.by_code("budget", FileName{}, "A job of kind budget, whose only output is the result, with its sources.");
    a.part("audited", r.result.audited, "The uncertainty as it is once an audit finding is corrected.");
    a.at_most_one_of({"u", "U"});
}

template <class Archive>
void describe(Archive& a, gum::ComparisonParticipant& r) {
    a.needed("id", r.id, Label{}, "Stands for one laboratory everywhere in the job.");
    a("name", r.name, k_sentence, "For the report; the id when left out.");
    a("group", r.group, Label{}, "Participants of one group may share effects.");
    a("cmc_U", r.cmc_U, In{k_compared_uncertainty}, "Expanded uncertainty of the capability, in the unit of the item.");
}

template <class Archive>
void describe(Archive& a, ParticipantStatement& r) {
    a.definition("comparison_participant", "Who took part, with one result where the job has no `results`.");
    describe(a, r.participant);
    describe(a, r.result);
}

template <class Archive>
void describe(Archive& a, ListedResult& r) {
    a.definition("comparison_result", "What one participant reports for one item in one round.");
    a.needed("participant", r.participant, Label{}, "The id of the participant.");
    describe(a, r.result);
}

template <class Archive>
void describe(Archive& a, gum::AssignedValueRequest& r) {
    constexpr Words<bool, 2> k_constants{{{"published", false}, {"exact", true}}};
    constexpr Words<bool, 2> k_uncertainties{{{"robust", false}, {"trials", true}}};
    constexpr NumberRange k_least_and_most{.low = 1000.0, .high = 1e7, .hint = "100000 trials are usual"};
    a.definition("comparison_assigned_value", "Explained in docs/comparison_job.md.");
    a("method", r.method, k_assigned_value_methods, "given when left out, beside a value.");
    a("participant", r.participant, Label{}, "Method reference: whose result it is.");
    a.by_code("value", In{k_compared_value}, "Method given.");
    describe_uncertainty(a);
    a.list("sources", r.sources, "Parts of u that participants share.");
    a("traceability", r.traceability, AnyText{}, "A sentence for the report.");
    a("constants", r.exact_constants, k_constants, "Of algorithm_a; published when left out.");
    a("uncertainty", r.median_by_trials, k_uncertainties, "Of a median; robust when left out.");
    a("trials", r.trials, Whole{k_least_and_most}, "Of a median by trials; 100000 when left out.");
    a("seed", r.seed, Whole{between(0.0, k_largest_seed, "")}, "Of its random numbers; 1 when left out.");
    a.by_code("alpha", In{k_alpha}, "Of the test of consistency; 0.05 when left out.");
    a("power", r.power, In{between(0.0, 2.0, "")}, "Of the power-moderated mean.");
    a.at_least_one_of({"method", "value"});
    a.at_most_one_of({"u", "U"});
}

template <class Archive>
void describe(Archive& a, gum::SigmaPtRequest& r) {
    a.definition("comparison_sigma_pt");
    a("percent", r.value, In{{.low = 1e-12, .high = 1e6, .unit = "%", .hint = "state a percentage"}},
      "Of the assigned value.");
    a("mass_fraction_per_unit", r.mass_fraction_per_unit,
      In{{.low = 1e-30, .high = 1.0, .hint = "state the mass fraction that 1 of the unit is: 1e-6 for mg/kg"}},
      "Of the Horwitz curve: the mass fraction that 1 of the unit stands for.");
    a("reproducibility", r.reproducibility,
      In{{.low = k_least_compared_u,
          .high = k_largest_compared,
          .hint = "state the standard deviation under conditions of reproducibility"}},
      "Standard deviation of the measurement method between laboratories.");
    a("repeatability", r.repeatability, In{between(0.0, k_largest_compared, "")}, "The same within one laboratory.");
    a("replicates", r.replicates, Whole{between(1.0, 1e6, "")}, "Of which a result is the mean; 1 when left out.");
    a.exactly_one_of({"percent", "mass_fraction_per_unit", "reproducibility"});
    a.needs("reproducibility", "repeatability");
    a.needs("repeatability", "reproducibility");
    a.needs("replicates", "reproducibility");
}

template <class Archive>
void describe(Archive& a, ReferenceValueStatement& r) {
    a.definition("comparison_reference_value");
    a.needed("value", r.value, In{k_compared_value}, "In the unit of the item.");
    describe_uncertainty(a);
    a.exactly_one_of({"u", "U"});
}

template <class Archive>
void describe(Archive& a, gum::ComparisonItem& r) {
    ReferenceValueStatement reference;
    a.part_or("assigned_value", k_methods_without_keys, r.assigned_value,
              "Left out: mandel_paule; weighted_mean where the job states anything that correlates results.");
    a.part_or("sigma_pt", Either{k_given_sigma_pt, k_sigma_pt_words}, r.sigma_pt,
              "Standard deviation for proficiency assessment, for z and z'.");
    a("delta_E", r.delta_E, positive("state the largest error that is allowed"), "The largest error that is allowed.");
    a.by_code("homogeneity", k_rows, "Items by replicates, measured before the round; at least 2 x 2.");
    a.by_code("stability", k_rows, "Items by replicates, measured after the round.");
    a("kernel_bandwidth", r.kernel_bandwidth, positive("state the width of the kernel"),
      "Asks for the mode of the kernel density, with this width.");
    a.part("reference_value", reference, "An independent value that the consensus is held against.");
}

template <class Archive>
void describe(Archive& a, ListedItem& r) {
    a.definition("comparison_item", "Keys that an item leaves out are those at the top of the job.");
    a.needed("id", r.item.id, Label{}, "What results name.");
    a("name", r.item.name, k_sentence, "For the report; the id when left out.");
    describe_unit_of_comparison(a, "Of its values; that of the job when left out.");
    describe(a, r.item);
}

template <class Archive>
void describe(Archive& a, gum::ComparisonVector& r) {
    a.needed("name", r.name, Line{}, "Of the vector.");
    a.needed_by_code("items", Several{Label{}, 2, 100}, "The quantities that are measured together.");
    a.by_code("correlation", k_rows, "Of the results of one participant; left out: none.");
    a.by_code("reference_correlation", k_rows, "Of the assigned values; left out: none.");
}

template <class Archive>
void describe(Archive& a, LaboratoriesStatement& r) {
    constexpr Words<bool, 2> k_names{{{"confidential", false}, {"released", true}}};
    constexpr In k_r{k_correlation_coefficient};
    a.list_or("participants", FileObject{}, r.participants, "The file has one result a row.");
    a.list_or("results", FileObject{}, r.results, "Where participants have several; left out: with the participants.");
    a.list("items", r.items, "What was compared; left out: as the results name them, or one.", {.least = 1});
    a.by_code("rounds", Several{Label{}, 1}, "In the order of the report; left out: as the results name them.");
    a.by_code("correlations", Several{Row{Label{}, Label{}, k_r}},
              "Two participants, and the correlation of their results for every item.");
    a.by_code("groups", ByName{k_r}, "The correlation inside a group; that of a group without entry is unknown.");
    a.list("vectors", r.vectors, "Items that are measured together.");
    a.by_code("youden", Several{Several{Label{}, 2, 2}, 0}, "Pairs of items to plot against each other.");
    a("names", r.names_released, k_names,
      "Whether documents show the names of participants beside their ids; confidential when left out.");
    describe(a, r.item);
}

// ---- methods --------------------------------------------------------------------------------------------------------

template <class Archive>
void describe(Archive& a, SidePoint& r) {
    a.definition("comparison_side_point");
    a.needed("point", r.point.name, Label{}, "Its name.");
    a("direction", r.point.direction, Label{}, "Where there are several; occurs once with the name.");
    a("position", r.point.position, In{k_compared_value}, "For the plot and the bias line; one side is enough.");
    a.by_code("value", In{k_compared_value}, "Required, unless the side has a budget.");
    describe_uncertainty(a);
    a("u_common", r.u_common, In{k_deviation}, "The part of u that all points of the side share.");
    a.at_most_one_of({"u", "U"});
}

template <class Archive>
void describe(Archive& a, SideReading& r) {
    constexpr Words<bool, 2> k_of{{{"table", false}, {"artefact", true}}};
    a.definition("comparison_side");
    a("name", r.side.name, k_sentence, "Of the method, for the report.");
    a.list_or("points", FileName{}, r.points, "Beside a budget they have no values.", {.most = k_most_side_points});
    a("covariance", r.covariance_name, FileName{}, "CSV without header, in the order of the points of this side.");
    a.by_code("budget", FileName{}, "A job of kind budget with the same points.");
    a.by_code("job", FileName{},
              "A job of kind rotary_table or circle_closure, whose deviations of the angle are compared.");
    a("of", r.side.of_artefact, k_of, "Beside a circle_closure: which result; table when left out.");
    a("cmc_U", r.side.cmc_U, In{k_compared_uncertainty}, "Expanded uncertainty of the capability.");
    a.part("audited", r, "What changes once an audit finding is corrected.", [](auto& in, SideReading& reading) {
        in.needed("factor", reading.side.audited_factor, In{k_audited_factor}, "On every uncertainty.");
        in.needed("finding", reading.side.audit_finding, k_sentence, "What the audit found.");
    });
    a.at_least_one_of({"points", "budget", "job"});
    a.at_most_one_of({"covariance", "budget", "job"});
    a.at_most_one_of({"points", "job"});
}

/// `position`.
struct PositionKeys {
    template <class Archive>
    void operator()(Archive& a, MethodComparisonRequest& r) const {
        a.needed("name", r.position_name, Line{}, "Of the axis of the plot.");
        describe_unit_of_comparison(a, "Of the positions.");
    }
};

template <class Archive>
void describe(Archive& a, MethodComparisonRequest& r) {
    constexpr Words<bool, 2> k_bias_lines{{{"reference_value", false}, {"position", true}}};
    SideReading side;
    a.part_or("lab", FileName{}, side, "The method of the laboratory; a CSV file has its points.");
    a.part_or("reference", FileName{}, side, "The reference method; a CSV file has its points.");
    a.part("position", r, "What the positions of the points are.", PositionKeys());
    a.by_code("correlation", Either{In{k_correlation_coefficient}, k_method_correlations},
              "Of both values at one point. Left out: shared_sources where both sides have budgets, else unknown.");
    a("bias_line", r.bias_against_position, k_bias_lines,
      "What the line through the differences runs over; reference_value when left out.");
    a("tolerance", r.tolerance, positive("state the largest difference that is allowed"),
      "The smallest deviation that would have failed is held against it.");
}

// ---- both -----------------------------------------------------------------------------------------------------------

template <class Archive>
void describe(Archive& a, ComparisonStatement& r) {
    describe_head(a, k_comparison_kind,
                  "Between laboratories (participants), or of a method with a reference method (lab and reference).");
    describe_title(a);
    describe_notes(a);
    a("coverage_probability", r.job.coverage_probability, In{k_probability_of_results}, "0.9545 when left out.");
    a("organiser", r.job.organiser, k_sentence, "Of the comparison, for the report.");
    a("artefact_stability", r.job.artefact_stability, k_sentence,
      "What is known of the stability of what was compared, and in which uncertainty it is.");
    a.by_code("independent_sources", Several{Label{}},
              "Sources that several budgets name, and that are not shared all the same.");
    a.by_code("different_sources", Several{Label{}},
              "Names of sources that look alike and are different ones, for sure.");
    describe_certificate(a);
    describe_unit_of_comparison(a, "Of all values, e.g. um, mg/kg, degC; 1 when left out.");
    describe(a, r.laboratories);
    describe(a, r.methods);
    a.exactly_one_of({"participants", "lab"});
    a.all_need(keys_of<LaboratoriesStatement>(), "participants");
    a.all_need(keys_of<MethodComparisonRequest>(), "lab");
    a.needs("lab", "reference");
}

}  // namespace gumcert::jobs
