#pragma once

#include <string_view>
#include <tuple>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The definition that a struct of the record is in its schema.
template <class Struct>
struct DefinitionOf {
    std::string_view name;
    std::string_view sentence = {};
};

/// Every struct that is described has a row; without one, record_schema.cpp does not compile.
inline constexpr std::tuple k_definitions{
    DefinitionOf<Software>{"software"},
    DefinitionOf<InputFile>{"input_file"},
    DefinitionOf<InputQuantity>{"input_quantity", "An input of a budget as a person knows it."},
    DefinitionOf<gum::Diagnostic>{"diagnostic"},
    DefinitionOf<IdentifiedSentence>{"identified_sentence",
                                     "A sentence of the program in this record: its id and arguments, by which it is "
                                     "said in other languages, and its English text."},
    DefinitionOf<IdentifiedSentence::Argument>{"sentence_argument"},

    DefinitionOf<Printed>{"printed"},
    DefinitionOf<Result>{"result"},
    DefinitionOf<ReportedResult>{"reported", "the result that holds: what every document prints"},
    DefinitionOf<BudgetRow>{"budget_row"},
    DefinitionOf<CorrelationRow>{"correlation_row",
                                 "what the correlations of the inputs add to the variance of a result"},
    DefinitionOf<SecondOrder>{"second_order"},
    DefinitionOf<MonteCarloSummary>{"monte_carlo"},
    DefinitionOf<GufValidation>{"validation", "law of propagation against Monte Carlo, JCGM 101:2008, clause 8"},
    DefinitionOf<ModelSummary>{"model"},
    DefinitionOf<SectionSummary>{
        "section",
        "Results with equations and points of their own: equations, unknowns and points are those of the record that "
        "come next after those of the sections before."},
    DefinitionOf<ResultCovariance>{"covariance", "covariance of results, in the products of their units"},
    DefinitionOf<CoverageRegion>{"region", "joint coverage region of all outputs, JCGM 102:2011"},
    DefinitionOf<CoverageRegion::SmallestRegion>{"smallest_region"},
    DefinitionOf<CoverageRegion::Validation>{"region_validation",
                                             "law of propagation against Monte Carlo, JCGM 102:2011, clause 8"},
    DefinitionOf<FitSummary>{"fit"},
    DefinitionOf<FitSummary::Parameter>{"fit_parameter"},
    DefinitionOf<FitSummary::Regressor>{"fit_regressor"},
    DefinitionOf<ReadingsSummary>{"readings"},
    DefinitionOf<VarianceAnalysis>{"variance_analysis"},
    DefinitionOf<OutlyingReading>{"outlying_reading"},

    DefinitionOf<RotaryTable>{"rotary"},
    DefinitionOf<SetUp>{"set_up"},
    DefinitionOf<ErrorsAtAngle>{"errors_at_angle", "the six error motions of ISO 230-7 at one angle, by name"},
    DefinitionOf<StatedValue>{"error_value"},
    DefinitionOf<Reversal>{"reversal"},
    DefinitionOf<RangeRow>{"range"},
    DefinitionOf<Station>{"station"},
    DefinitionOf<DeadPath>{"dead_path"},
    DefinitionOf<Reflector>{"reflector"},
    DefinitionOf<QuantityBudget>{"quantity_budget"},
    DefinitionOf<BudgetSummaryRow>{"budget_summary_row"},
    DefinitionOf<AdjustmentSummary>{"adjustment"},
    DefinitionOf<GlobalTest>{"global_test", "chi-square against its distribution, two-sided"},
    DefinitionOf<VarianceComponent>{"variance_component"},
    DefinitionOf<ReliabilityRow>{"reliability"},
    DefinitionOf<FlaggedDistance>{"flagged_distance"},
    DefinitionOf<FixtureReliabilityRow>{"fixture_reliability"},
    DefinitionOf<ExternalReliability>{
        "external_reliability",
        "largest change of a quantity by an error of one distance that is just too small to be found"},
    DefinitionOf<TableParameter>{"table_parameter"},
    DefinitionOf<MachineFrame>{"machine_frame",
                               "The reference frame of the machine, in which location errors are stated."},
    DefinitionOf<MachinePoint>{"machine_point"},
    DefinitionOf<PositioningAccuracy>{"iso230_2",
                                      "positioning about the axis; a parameter that the runs do not allow is absent"},
    DefinitionOf<PositioningTarget>{"positioning_target"},
    DefinitionOf<RotaryMonteCarlo>{"rotary_monte_carlo", "Monte Carlo of the whole measurement"},
    DefinitionOf<FixtureBudget>{"fixture_budget", "uncertainty of the coordinates of the fixture"},
    DefinitionOf<GroupTestSummary>{"group_tests"},
    DefinitionOf<GroupTestRow>{
        "group_test", "the largest of the tests of one kind of groups of distances; test values are chi-square"},
    DefinitionOf<ReversalModel>{"reversal_model"},
    DefinitionOf<ReversalTestRow>{"reversal_test"},
    DefinitionOf<VisitRow>{
        "visit", "what the distances of one visit of the table to an angle deviate by from what all others say"},
    DefinitionOf<SenseCurve>{"sense_curve",
                             "the six error motions of one sense of approach, in the order of error_names"},
    DefinitionOf<SensePoint>{"sense_point"},
    DefinitionOf<HarmonicRow>{"harmonics", "one error motion as a sum of A cos(k theta - phase)"},
    DefinitionOf<HarmonicOrder>{"harmonic_order"},
    DefinitionOf<Environment>{"environment",
                              "temperatures and air about the stations, and the thermal expansion of the fixture"},
    DefinitionOf<StationEnvironment>{"station_environment"},
    DefinitionOf<ExcludedDistances>{
        "excluded_distances",
        "Distances that the laboratory left out: those that agree with everything that is named."},

    DefinitionOf<CircleClosure>{"circle_closure", "comparison of two divided circles; angles in `unit`"},
    DefinitionOf<ClosureTestRow>{"closure_test"},
    DefinitionOf<ClosureSeriesRow>{"closure_series"},
    DefinitionOf<ClosureResidualRow>{"closure_residual"},

    DefinitionOf<Comparison>{"comparison"},
    DefinitionOf<ComparisonPoint>{"comparison_point"},
    DefinitionOf<ComparisonSummary>{"comparison_summary"},
    DefinitionOf<BiasLineSummary>{"comparison_bias",
                                  "Straight line through the differences: D = constant + slope (t - centre)."},
    DefinitionOf<SharedSource>{"comparison_shared_source"},
    DefinitionOf<ComparisonItemEvaluation>{
        "comparison_item", "One item in one round: assigned value, spread of the results and the checks."},
    DefinitionOf<ResultWeight>{"comparison_weight"},
    DefinitionOf<ConsistencySummary>{"comparison_consistency"},
    DefinitionOf<ReferenceEstimate>{"comparison_estimate"},
    DefinitionOf<HomogeneitySummary>{"comparison_homogeneity"},
    DefinitionOf<StabilitySummary>{"comparison_stability"},
    DefinitionOf<ConsensusCheck>{"comparison_consensus"},
    DefinitionOf<PairEquivalence>{"comparison_pair"},
    DefinitionOf<ItemWithoutResult>{"comparison_item_without_result"},
    DefinitionOf<ParticipantSummary>{"comparison_participant"},
    DefinitionOf<VectorScore>{"comparison_vector"},
    DefinitionOf<YoudenDiagram>{"comparison_youden"},
    DefinitionOf<YoudenPoint>{"comparison_youden_point"},
    DefinitionOf<BudgetFile>{"comparison_budget_file"},
    DefinitionOf<RefutedSide>{"comparison_refuted_side"},
    DefinitionOf<ComparisonIssuer>{"comparison_issuer"},

    DefinitionOf<certificate::Certificate>{"certificate_of_record",
                                           "The certificate: what the laboratory states, the results as they are "
                                           "certified, and what an assessor would remark."},
    DefinitionOf<certificate::CertificateData>{
        "certificate_data",
        "What the laboratory states beside the numbers (ISO/IEC 17025:2017, 7.8.2.1 and 7.8.4.1). Almost everything "
        "may be left out; the program then says which clause misses it, and prints a draft or a specimen."},
    DefinitionOf<certificate::LocalisedText>{"certificate_text", "A text for all languages, or one in each."},
    DefinitionOf<certificate::Profile>{"certificate_profile"},
    DefinitionOf<certificate::Profile::Term>{"certificate_profile_term"},
    DefinitionOf<certificate::Laboratory>{"certificate_laboratory"},
    DefinitionOf<certificate::Address>{"certificate_address"},
    DefinitionOf<certificate::Accreditation>{"certificate_accreditation"},
    DefinitionOf<certificate::ScopeEntry>{"certificate_scope_entry"},
    DefinitionOf<certificate::ScopeEntry::Range>{"certificate_scope_range"},
    DefinitionOf<certificate::Capability>{"certificate_capability"},
    DefinitionOf<certificate::CapabilityArgument>{"certificate_capability_argument"},
    DefinitionOf<certificate::CapabilityPoint>{"certificate_capability_point"},
    DefinitionOf<certificate::Customer>{"certificate_customer"},
    DefinitionOf<certificate::Item>{"certificate_item"},
    DefinitionOf<certificate::Place>{"certificate_place"},
    DefinitionOf<certificate::Dates>{"certificate_dates"},
    DefinitionOf<certificate::Method>{"certificate_method"},
    DefinitionOf<certificate::StandardUsed>{"certificate_standard_used"},
    DefinitionOf<certificate::StandardUsed::FurtherUncertainty>{"certificate_further_uncertainty"},
    DefinitionOf<certificate::Condition>{"certificate_condition"},
    DefinitionOf<certificate::Persons>{"certificate_persons"},
    DefinitionOf<certificate::Person>{"certificate_person"},
    DefinitionOf<certificate::AgreedSpecification>{"certificate_specification"},
    DefinitionOf<certificate::PointLimits>{"certificate_point_limits", "Limits that differ from point to point."},
    DefinitionOf<certificate::PointLimits::Accuracy>{"certificate_accuracy"},
    DefinitionOf<certificate::PointLimits::Step>{"certificate_limit_step"},
    DefinitionOf<certificate::PointTable>{
        "point_table", "The points of a job, what they have beside their results, and the tables that show them."},
    DefinitionOf<certificate::PointColumn>{"point_column", "Words or numbers of points, one each."},
    DefinitionOf<certificate::TableRequest>{"table_request", "What the job wants of one table."},
    DefinitionOf<certificate::SectionData>{
        "certificate_section", "What holds for the results of one section in place of what the certificate states."},
    DefinitionOf<certificate::TableRequest::GroupUnit>{"table_group_unit"},
    DefinitionOf<certificate::TableRequest::RowChoice>{"table_row_choice"},
    DefinitionOf<certificate::ShownColumn>{"table_shown_column"},
    DefinitionOf<certificate::TableLayout>{"table_layout", "How a certified table shows one group of points."},
    DefinitionOf<certificate::AgreedSpecification::Rule>{"certificate_decision_rule"},
    DefinitionOf<certificate::Opinion>{"certificate_opinion"},
    DefinitionOf<certificate::ExternalResults>{"certificate_external_results"},
    DefinitionOf<certificate::Parameter>{"certificate_parameter"},
    DefinitionOf<certificate::Adjustment>{"certificate_adjustment"},
    DefinitionOf<certificate::Amendment>{"certificate_amendment"},
    DefinitionOf<certificate::Omission>{"certificate_omission"},
    DefinitionOf<certificate::Waiver>{"certificate_waiver"},
    DefinitionOf<certificate::CertifiedTable>{
        "certificate_certified_table",
        "Results as a table of columns, with the texts that every form of the certificate prints."},
    DefinitionOf<certificate::CertifiedTable::Argument>{"certificate_certified_argument"},
    DefinitionOf<certificate::CertifiedColumn>{"certificate_certified_column"},
    DefinitionOf<certificate::CertifiedValue>{"certificate_certified_value",
                                              "One value: unrounded numbers, printed texts, scope and verdict."},
    DefinitionOf<certificate::Verdict>{"certificate_verdict",
                                       "Decision on conformity, with everything needed to check it by hand. Where "
                                       "printed.conformance_probability is empty, no probability is stated: "
                                       "conformance_probability and specific_risk are 0 then, and mean nothing."},
    DefinitionOf<certificate::Finding>{"certificate_finding",
                                       "Something that an assessor would remark; critical ones block the issue."},
    DefinitionOf<certificate::Change>{"certificate_change",
                                      "What an amendment states otherwise than the certificate that it amends."}};

}  // namespace gumcert::reports
