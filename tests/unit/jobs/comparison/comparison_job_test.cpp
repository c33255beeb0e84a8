#include "jobs/comparison/comparison_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "jobs/comparison/comparison_codes.h"
#include "tests/support/campaign.h"
#include "tests/support/comparison_campaign.h"

namespace gumcert::jobs {
namespace {

using test::comparison_refusals;
using test::k_three_laboratories;
using test::k_two_methods;
using test::method_tables;
using test::read_comparison;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ComparisonJob, ReadsLaboratoriesWithTheirResults) {
    const ComparisonJob job = read_comparison(k_three_laboratories + R"j(, "title": "Round 1", "unit": "mg/kg",
        "organiser": "Example Proficiency Testing Provider")j");
    EXPECT_EQ(job.title, "Round 1");
    EXPECT_EQ(job.organiser, "Example Proficiency Testing Provider");
    ASSERT_EQ(job.participants.size(), 3U);
    EXPECT_EQ(job.participants[1].id, "B");
    EXPECT_EQ(job.participants[1].name, "B");
    ASSERT_EQ(job.items.size(), 1U);
    EXPECT_EQ(job.items[0].unit.text(), "mg/kg");
    EXPECT_EQ(job.items[0].id, "");
    EXPECT_EQ(job.items[0].assigned_value.method, gum::AssignedValueMethod::mandel_paule);
    EXPECT_THAT(job.rounds, ElementsAre(""));
    ASSERT_EQ(job.results.size(), 3U);
    EXPECT_EQ(job.results[0].value, 10.1);
    EXPECT_EQ(job.results[0].uncertainty->u, 0.1);
    EXPECT_FALSE(job.results[0].uncertainty->stated_as_expanded);
    // U = t_p(ν) u: the factor for 95.45 % of the normal distribution is 2.000 002.
    EXPECT_NEAR(job.results[0].uncertainty->U, 0.2, 1e-6);
    EXPECT_EQ(job.results[1].uncertainty->u, 0.2);
    EXPECT_EQ(job.results[1].uncertainty->U, 0.4);
    EXPECT_EQ(job.results[1].uncertainty->k, 2.0);
    EXPECT_TRUE(job.results[1].uncertainty->stated_as_expanded);
    EXPECT_TRUE(std::isinf(job.results[0].uncertainty->degrees_of_freedom));
    EXPECT_TRUE(job.youden.empty());
    EXPECT_FALSE(job.methods);
    EXPECT_EQ(test::texts(job.warnings), "");
}

TEST(ComparisonJob, TakesTheFactorOfTheDegreesOfFreedom) {
    // Golden vector 1: k(95.45 %, ν = 4) = 2.87.
    const ComparisonJob job = read_comparison(
        R"j("participants": [{"id": 1, "value": 1, "u": 1, "nu": 4}, {"id": 2, "value": 1, "u": 1, "nu": "inf"}])j");
    EXPECT_NEAR(job.results[0].uncertainty->k, 2.87, 0.005);
    EXPECT_EQ(job.participants[0].id, "1");
}

TEST(ComparisonJob, ReadsATableOfSeveralItemsAndRounds) {
    const ComparisonJob job = read_comparison(
        R"j("participants": {"file": "r.csv"}, "unit": "mg/kg", "groups": {"North": 0.3},
            "items": [{"id": "Hg", "name": "mercury", "sigma_pt": 0.0066, "delta_E": 0.02},
                      {"id": "Cd", "unit": "ug/kg", "assigned_value": "algorithm_a"}],
            "assigned_value": {"value": 0.044, "U": 0.0082, "k": 2, "traceability": "to the SI"}, "rounds": ["b", "a"])j",
        {{"r.csv",
          "participant,item,round,value,u,U,k,nu,s,n,group,contributes,reason,name,cmc_U\n"
          "L1,Hg,a,0.04,0.004,,,inf,0.01,6,North,,,First laboratory,0.01\n"
          "L1,Cd,a,3,,0.6,2,12,,,,no,blunder found,,\n"
          "L2,Hg,a,0.05,,,,,,,North,yes,,,\n"
          "L2,Cd,b,,,,,,,,,,broken sample,,\n"
          "L2,Cd,a,4,1,,,,,,,,,,\n"
          "L3,Cd,a,4.5,1,,,,,,,,,,\n"}});
    EXPECT_THAT(job.rounds, ElementsAre("b", "a"));
    ASSERT_EQ(job.participants.size(), 3U);
    EXPECT_EQ(job.participants[0].name, "First laboratory");
    EXPECT_EQ(job.participants[0].group, "North");
    EXPECT_EQ(job.participants[0].cmc_U, 0.01);
    EXPECT_EQ(job.participants[1].cmc_U, std::nullopt);
    EXPECT_EQ(job.group_correlation.at("North"), 0.3);
    ASSERT_EQ(job.results.size(), 5U);
    const ComparisonResult& first = job.results[0];
    EXPECT_EQ(first.standard_deviation, 0.01);
    EXPECT_EQ(first.observations, 6U);
    EXPECT_EQ(first.round, 1U);
    EXPECT_EQ(first.where, "r.csv:2:9");
    EXPECT_FALSE(job.results[1].contributes);
    EXPECT_EQ(job.results[1].reason, "blunder found");
    EXPECT_EQ(job.results[1].uncertainty->degrees_of_freedom, 12.0);
    EXPECT_FALSE(job.results[2].uncertainty);
    ASSERT_EQ(job.missing.size(), 1U);
    EXPECT_EQ(job.missing[0].participant, 1U);
    EXPECT_EQ(job.missing[0].item, 1U);
    EXPECT_EQ(job.missing[0].round, 0U);
    EXPECT_EQ(job.missing[0].reason, "broken sample");
    EXPECT_EQ(job.items[0].name, "mercury");
    EXPECT_EQ(job.items[0].unit.text(), "mg/kg");
    EXPECT_EQ(job.items[0].assigned_value.method, gum::AssignedValueMethod::given);
    EXPECT_EQ(job.items[0].assigned_value.value, 0.044);
    EXPECT_EQ(job.items[0].assigned_value.uncertainty->u, 0.0041);
    EXPECT_EQ(job.items[0].assigned_value.traceability, "to the SI");
    EXPECT_EQ(job.items[0].sigma_pt->value, 0.0066);
    EXPECT_EQ(job.items[0].delta_E, 0.02);
    EXPECT_EQ(job.items[1].unit.text(), "ug/kg");
    EXPECT_EQ(job.items[1].assigned_value.method, gum::AssignedValueMethod::algorithm_a);
    EXPECT_FALSE(job.items[1].sigma_pt);
    // Two items: their Youden plot needs no asking.
    EXPECT_THAT(job.youden, ElementsAre(std::pair<std::size_t, std::size_t>{0, 1}));
    EXPECT_THAT(job.files, ElementsAre("job.json", "r.csv"));
}

TEST(ComparisonJob, MakesItemsAndRoundsOfTheResults) {
    const ComparisonJob job = read_comparison(
        R"j("participants": {"file": "r.csv"}, "unit": "mm", "sigma_pt": {"percent": 10})j",
        {{"r.csv",
          "participant,item,round,value,u\nA,Z,2,1,1\nA,Y,2,1,1\nB,Z,2,1,1\nB,Y,2,1,1\nA,Y,1,1,1\nB,Y,1,1,1\n"}});
    ASSERT_EQ(job.items.size(), 2U);
    EXPECT_EQ(job.items[0].id, "Z");
    EXPECT_EQ(job.items[1].id, "Y");
    EXPECT_EQ(job.items[1].unit.text(), "mm");
    EXPECT_EQ(job.items[1].sigma_pt->method, gum::SigmaPtMethod::percent_of_assigned);
    EXPECT_THAT(job.rounds, ElementsAre("2", "1"));
}

TEST(ComparisonJob, OneRoundDoesNotLoseTheOthers) {
    const auto refused = [](const std::string& assigned, const std::string& table) {
        return read_comparison(R"("participants": {"file": "r.csv"}, "unit": "mm", "assigned_value": )" + assigned,
                               {{"r.csv", table}})
            .refused_items;
    };
    const auto weights = refused(R"("mandel_paule")",
                                 "participant,round,value,u\nA,1,1,1\nB,1,1,1\nC,1,1,1\nA,2,1,1\nB,2,1,\nC,2,1,1\n");
    ASSERT_EQ(weights.size(), 1U);
    EXPECT_EQ(weights.begin()->first.second, std::optional<std::size_t>(1));
    EXPECT_EQ(weights.begin()->second.code, k_result_without_uncertainty.code);
    EXPECT_THAT(weights.begin()->second.what, testing::HasSubstr("stated by \"B\" (item, round \"2\")"));
    const auto reference = refused(R"({"method": "reference", "participant": "A"})",
                                   "participant,round,value,u\nA,1,1,1\nB,1,1,1\nB,2,1,1\nC,2,1,1\n");
    ASSERT_EQ(reference.size(), 1U);
    EXPECT_EQ(reference.begin()->second.code, k_reference_without_result.code);
}

TEST(ComparisonJob, ReadsEveryWayToStateTheAssignedValue) {
    const auto method_of = [](const std::string& value) {
        return read_comparison(k_three_laboratories + ", \"assigned_value\": " + value).items[0].assigned_value;
    };
    for (const std::string_view word : gum::k_assigned_value_words) {
        if (word == "reference" || word == "given" || word == "vangel_rukhin") {
            continue;
        }
        const gum::AssignedValueRequest request = method_of("\"" + std::string(word) + "\"");
        EXPECT_EQ(gum::k_assigned_value_words[static_cast<std::size_t>(request.method)], word);
    }
    EXPECT_EQ(method_of(R"({"method": "reference", "participant": "B"})").participant, "B");
    const gum::AssignedValueRequest trials =
        method_of(R"({"method": "median", "uncertainty": "trials", "trials": 2e4, "seed": 7, "alpha": 0.1})");
    EXPECT_TRUE(trials.median_by_trials);
    EXPECT_EQ(trials.trials, 20000U);
    EXPECT_EQ(trials.seed, 7U);
    EXPECT_EQ(trials.alpha, 0.1);
    EXPECT_TRUE(method_of(R"({"method": "algorithm_a", "constants": "exact"})").exact_constants);
    EXPECT_EQ(method_of(R"({"method": "power_moderated_mean", "power": 1.5})").power, 1.5);
    const gum::AssignedValueRequest given =
        method_of(R"({"method": "given", "value": 3, "u": 0.5, "sources": [{"source": "S", "u": -0.3}]})");
    EXPECT_EQ(given.value, 3.0);
    ASSERT_EQ(given.sources.size(), 1U);
    EXPECT_EQ(given.sources[0].contribution, -0.3);
    EXPECT_THAT(given.where, HasSubstr("#/assigned_value"));
}

TEST(ComparisonJob, ReadsSigmaPtReplicatesAndReferenceValue) {
    const auto item = [](const std::string& keys) {
        return read_comparison(k_three_laboratories + ", " + keys).items[0];
    };
    EXPECT_EQ(item(R"("sigma_pt": "robust")").sigma_pt->method, gum::SigmaPtMethod::robust);
    EXPECT_EQ(item(R"("sigma_pt": {"mass_fraction_per_unit": 1e-6})").sigma_pt->mass_fraction_per_unit, 1e-6);
    const auto precision = item(R"("sigma_pt": {"reproducibility": 3, "repeatability": 1, "replicates": 2})").sigma_pt;
    EXPECT_EQ(precision->method, gum::SigmaPtMethod::precision);
    EXPECT_EQ(precision->replicates, 2U);
    const gum::ComparisonItem checked =
        item(R"("delta_E": 1, "homogeneity": [[1, 2], [3, 4], [5, 6]], "stability": [[7, 8]],
        "kernel_bandwidth": 0.5, "reference_value": {"value": 4, "U": 0.6, "k": 2})");
    EXPECT_EQ((*checked.homogeneity)(2, 1), 6.0);
    EXPECT_EQ((*checked.stability)(0, 1), 8.0);
    EXPECT_EQ(checked.kernel_bandwidth, 0.5);
    EXPECT_EQ(checked.reference_value, 4.0);
    EXPECT_EQ(checked.u_reference_value, 0.3);
}

TEST(ComparisonJob, ReadsResultsBesideParticipants) {
    const ComparisonJob job = read_comparison(
        R"j("participants": [{"id": "A", "name": "Laboratory A", "group": "G", "cmc_U": 0.1}, {"id": "B", "group": "G"},
                             {"id": "C"}],
            "results": [{"participant": "A", "value": 1, "u": 0.5, "sources": [{"source": "S", "u": 0.5}],
                         "audited": {"U": 2, "k": 2, "finding": "resolution left out"}},
                        {"participant": "B", "value": 2, "u": 0.5}, {"participant": "C", "value": null}],
            "correlations": [["B", "A", -0.2]], "groups": {"G": 0.1}, "independent_sources": ["S2"])j");
    ASSERT_EQ(job.results.size(), 2U);
    EXPECT_EQ(job.results[0].audited->uncertainty.u, 1.0);
    EXPECT_EQ(job.results[0].audited->finding, "resolution left out");
    EXPECT_EQ(job.results[0].sources.at(0).source, "S");
    ASSERT_EQ(job.missing.size(), 1U);
    EXPECT_EQ(job.missing[0].participant, 2U);
    ASSERT_EQ(job.correlations.size(), 1U);
    EXPECT_EQ(job.correlations[0].first, 0U);
    EXPECT_EQ(job.correlations[0].r, -0.2);
    EXPECT_THAT(job.independent_sources, ElementsAre("S2"));
    // Known to be missing: nothing to warn of.
    EXPECT_EQ(test::texts(job.warnings), "");
}

TEST(ComparisonJob, ReadsABudgetInPlaceOfAResult) {
    const ComparisonJob job = read_comparison(
        R"j("unit": "mm", "participants": [{"id": "A", "budget": "a/b.json"}, {"id": "B", "value": 1, "u": 1}])j",
        {{"a/b.json", test::point_budget("")}});
    ASSERT_TRUE(job.results[0].budget);
    EXPECT_EQ(job.results[0].budget_file, "a/b.json");
    EXPECT_EQ(job.results[0].budget->inputs.size(), 2U);
    EXPECT_FALSE(job.results[0].uncertainty);
    ASSERT_EQ(job.participant_budgets.size(), 1U);
    EXPECT_EQ(job.participant_budgets[0].participant, 0U);
    EXPECT_EQ(job.participant_budgets[0].file, "a/b.json");
    EXPECT_THAT(job.files, ElementsAre("job.json", "a/b.json"));
    const auto found = comparison_refusals(
        R"j("unit": "mm", "participants": [{"id": "A", "budget": "b.json"}, {"id": "B", "value": 1, "u": 1}])j",
        {{"b.json", R"({"schema": "gumcert/job/1", "kind": "budget", "inputs": {"X": {"value": 1, "u": -1}}})"}});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].where, HasSubstr("b.json#/inputs/X/u"));
}

TEST(ComparisonJob, ReadsVectorsAndYoudenPairs) {
    const ComparisonJob job = read_comparison(
        R"j("participants": {"file": "r.csv"}, "youden": [["z", "x"]],
            "vectors": [{"name": "P", "items": ["x", "y", "z"], "correlation": [[1, 0.5, 0], [0.5, 1, 0], [0, 0, 1]]}])j",
        {{"r.csv", "participant,item,value,u\nA,x,1,1\nA,y,1,1\nA,z,1,1\nB,x,1,1\nB,y,1,1\nB,z,1,1\n"}});
    ASSERT_EQ(job.vectors.size(), 1U);
    EXPECT_THAT(job.vectors[0].items, ElementsAre(0, 1, 2));
    EXPECT_EQ(job.vectors[0].correlation(0, 1), 0.5);
    EXPECT_TRUE(job.vectors[0].reference_correlation.isIdentity());
    EXPECT_THAT(job.youden, ElementsAre(std::pair<std::size_t, std::size_t>{2, 0}));
}

TEST(ComparisonJob, TakesAColumnOfUnitsThatAreThoseOfTheValues) {
    const ComparisonJob job = read_comparison(
        R"j("unit": "um", "items": [{"id": "d"}, {"id": "w", "unit": "mg/kg"}], "participants": {"file": "r.csv"})j",
        {{"r.csv",
          "participant,item,value,u,unit\nA,d,1,1,um\nB,d,2,1,µm\nC,d,3,1,\nA,w,1,1,ug/g\nB,w,2,1,mg kg-1\n"}});
    EXPECT_EQ(job.results.size(), 5U);
    EXPECT_EQ(test::texts(job.warnings), "");

    // Cells are padded, a dash states nothing, and a result that is missing is in no unit.
    const ComparisonJob padded = read_comparison(
        R"j("unit": "mg", "participants": {"file": "r.csv"})j",
        {{"r.csv", "participant,value,u,unit\nA,1,1, mg\nB,2,1,mg \nC,3,1,mg\xC2\xA0\nD,3,1,-\nE,,,n/a\nF,,,g\n"}});
    EXPECT_EQ(padded.results.size(), 4U);
    EXPECT_EQ(padded.missing.size(), 2U);
}

TEST(ComparisonJob, TakesAReasonBesideAValueWhoseContributionIsStated) {
    const ComparisonJob job =
        read_comparison(R"j("participants": {"file": "r.csv"})j",
                        {{"r.csv",
                          "participant,value,u,contributes,reason\nA,1,1,yes,measured twice\nB,2,1,no,late\nC,3,1,,\n"
                          "D,,,,withdrawn\n"}});
    EXPECT_EQ(job.results.size(), 3U);
    EXPECT_TRUE(job.results[0].contributes);
    EXPECT_EQ(job.missing.size(), 1U);
}

TEST(ComparisonJob, WarnsOfWhatAPersonShouldLookAt) {
    const auto codes = [](const std::string& keys, const test::ComparisonFiles& files = {}) {
        std::vector<std::string> all;
        for (const auto& warning : read_comparison(keys, files).warnings) {
            all.push_back(warning.code);
        }
        return all;
    };
    const std::string c = R"("participants": {"file": "r.csv"})";
    EXPECT_THAT(codes(c, {{"r.csv", "participant,value,u,colour\nA,1,1,red\nB,1,1,blue\n"}}),
                ElementsAre("GC-WARN-0001"));
    EXPECT_THAT(codes(c, {{"r.csv", "participant,value,U,k\nA,1,1,0.95\nB,1,1,2\n"}}), ElementsAre("GC-WARN-0021"));
    EXPECT_THAT(codes(c, {{"r.csv", "participant,value,U,k\nA,1,1,95\nB,1,1,2\n"}}), ElementsAre("GC-WARN-0021"));
    EXPECT_THAT(codes(c, {{"r.csv", "participant,value,U,k,nu\nA,1,1,63.66,1\nB,1,1,13.97,\n"}}), ElementsAre());
    EXPECT_THAT(codes(c, {{"r.csv", "participant,value,u\nA,1,1\nB,1,1\nC,,1\n"}}), ElementsAre("GC-WARN-0023"));
    EXPECT_THAT(codes(c, {{"r.csv", "participant,value,u\nLab 1,1,1\nlab-1,1,1\nLab 10,1,1\nL,1,1\n"}}),
                ElementsAre("GC-WARN-0025"));
    EXPECT_THAT(codes(c, {{"r.csv", "participant,value,u\n1-11,1,1\n11-1,1,1\n111,1,1\n"}}), ElementsAre())
        << "numbers of several parts are no spellings of each other";
    EXPECT_THAT(codes(c, {{"r.csv", "participant,value,u,Name,Uncertainty\nA,1,1,Ann,k = 2\nB,1,1,Ben,k = 2\n"}}),
                ElementsAre("GC-WARN-0001", "GC-WARN-0001"))
        << "they change no number";
    EXPECT_THAT(codes(k_three_laboratories + R"(, "assigned_value": {"value": 10})"), ElementsAre("GC-WARN-0022"));
    EXPECT_THAT(codes(k_three_laboratories + R"(, "assigned_value": {"method": "median", "power": 1})"),
                ElementsAre("GC-WARN-0006"));
    EXPECT_THAT(codes(k_three_laboratories + R"(, "delta_E": 1, "homogeneity": [[1, 2], [3, 4]])"),
                ElementsAre("GC-WARN-0024"));
    EXPECT_THAT(codes(R"("participants": [{"id": "A"}, {"id": "B"}, {"id": "C"}],
        "results": [{"participant": "A", "value": 1, "u": 1}, {"participant": "B", "value": 1, "u": 1}])"),
                ElementsAre("GC-WARN-0020"));
}

TEST(ComparisonJob, AcceptsCorrelationsThatHoldTogether) {
    EXPECT_EQ(
        test::texts(comparison_refusals(k_three_laboratories + R"(, "correlations": [["A", "B", 1], ["A", "C", -1],
        ["B", "C", -1]])")),
        "");
    // A group of many is not made a matrix of.
    std::string table = "participant,value,u,group\n";
    for (int i = 0; i < 5000; ++i) {
        table += std::to_string(i) + ",1,1,G\n";
    }
    EXPECT_EQ(test::texts(comparison_refusals(R"("participants": {"file": "r.csv"}, "groups": {"G": 0.5})",
                                              {{"r.csv", table}})),
              "");
}

// ---- methods --------------------------------------------------------------------------------------------------------

TEST(ComparisonJob, BringsBothMethodsIntoOneOrder) {
    const ComparisonJob job = read_comparison(
        k_two_methods + R"(, "position": {"name": "angle", "unit": "deg"}, "bias_line": "position", "tolerance": 3)",
        method_tables());
    const MethodComparisonRequest& methods = job.methods.value();
    EXPECT_EQ(methods.unit.text(), "um");
    EXPECT_EQ(methods.laboratory.name, "laboratory");
    EXPECT_EQ(methods.position_name, "angle");
    EXPECT_EQ(methods.position_unit->text(), "deg");
    EXPECT_TRUE(methods.bias_against_position);
    EXPECT_EQ(methods.tolerance, 3.0);
    EXPECT_EQ(methods.correlation, MethodCorrelation::unknown);
    ASSERT_EQ(methods.points.size(), 4U);
    EXPECT_EQ(methods.points[2].name, "P2");
    EXPECT_EQ(methods.points[2].direction, "x");
    EXPECT_EQ(methods.points[2].position, 90.0);
    EXPECT_THAT(methods.laboratory.value, ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(methods.reference.value, ElementsAre(1.1, 2.1, 3.1, 4.1));
    EXPECT_EQ(methods.reference.uncertainty[0].u, 0.2);
    // u² on the diagonal, what all points share beside it.
    EXPECT_DOUBLE_EQ(methods.reference.covariance(0, 0), 0.04);
    EXPECT_DOUBLE_EQ(methods.reference.covariance(0, 3), 0.01);
    EXPECT_DOUBLE_EQ(methods.laboratory.covariance(0, 0), 0.25);
    EXPECT_DOUBLE_EQ(methods.laboratory.covariance(0, 3), 0.0);
}

TEST(ComparisonJob, BringsACovarianceIntoTheOrderOfThePoints) {
    test::ComparisonFiles files = method_tables();
    files["reference.csv"] = "point,direction,value\nP2,y,4\nP2,x,3\nP1,y,2\nP1,x,1\n";
    files["v.csv"] = "4,0.1,0.2,0.3\n0.1,9,0.4,0.5\n0.2,0.4,16,0.6\n0.3,0.5,0.6,25\n";
    const ComparisonJob job = read_comparison(
        R"("lab": "lab.csv", "correlation": 0.25, "reference": {"name": "CMM", "points": "reference.csv",
           "covariance": "v.csv", "cmc_U": 2, "audited": {"factor": 0.577, "finding": "MPE taken as u"}})",
        files);
    const MethodComparisonRequest& methods = job.methods.value();
    EXPECT_EQ(methods.correlation, MethodCorrelation::given);
    EXPECT_EQ(methods.r, 0.25);
    EXPECT_EQ(methods.reference.name, "CMM");
    EXPECT_EQ(methods.reference.cmc_U, 2.0);
    EXPECT_EQ(methods.reference.audited_factor, 0.577);
    EXPECT_EQ(methods.reference.audit_finding, "MPE taken as u");
    // Points P1 x, P1 y, P2 x, P2 y are the rows 4, 3, 2, 1 of the file.
    EXPECT_EQ(methods.reference.covariance(0, 0), 25.0);
    EXPECT_EQ(methods.reference.covariance(0, 3), 0.3);
    EXPECT_EQ(methods.reference.covariance(1, 2), 0.4);
    EXPECT_EQ(methods.reference.covariance(2, 1), 0.4);
    EXPECT_EQ(methods.reference.uncertainty[3].u, 2.0);
}

TEST(ComparisonJob, TakesPointsFromBudgets) {
    const ComparisonJob job = read_comparison(
        R"("unit": "mm", "lab": {"budget": "lab.json"}, "reference": {"budget": "reference.json"},
           "independent_sources": ["room"])",
        {{"lab.json", test::point_budget(R"(["P1", "P2"])")},
         {"reference.json", test::point_budget(R"(["P2", "P1"])")}});
    const MethodComparisonRequest& methods = job.methods.value();
    EXPECT_EQ(methods.correlation, MethodCorrelation::shared_sources);
    ASSERT_EQ(methods.points.size(), 2U);
    EXPECT_THAT(methods.laboratory.budget_points, ElementsAre(0, 1));
    EXPECT_THAT(methods.reference.budget_points, ElementsAre(1, 0));
    EXPECT_TRUE(methods.laboratory.value.empty());
    EXPECT_THAT(job.files, ElementsAre("job.json", "lab.json", "reference.json"));
}

TEST(ComparisonJob, MatchesDirectionsWithThePointsOfABudget) {
    test::ComparisonFiles files = method_tables();
    files["b.json"] = test::point_budget(R"(["P2.x", "P1.x", "P1.y", "P2.y"])");
    const ComparisonJob job =
        read_comparison(R"("unit": "um", "lab": "lab.csv", "reference": {"budget": "b.json"})", files);
    EXPECT_THAT(job.methods->reference.budget_points, ElementsAre(1, 2, 0, 3));
    EXPECT_EQ(job.methods->correlation, MethodCorrelation::unknown);
    // Of a table beside a budget only the points are used: a unit is perhaps that of their positions.
    files["p.csv"] = "point,direction,position,Unit,Value\nP1,x,0,mm,2\nP1,y,0,mm,2\nP2,x,90,mm,2\nP2,y,90,mm,2\n";
    const ComparisonJob places = read_comparison(
        R"("unit": "um", "lab": "lab.csv", "reference": {"points": "p.csv", "budget": "b.json"})", files);
    EXPECT_EQ(places.methods->points.size(), 4U);
    const std::string told = test::texts(places.warnings);
    EXPECT_THAT(told, HasSubstr("the column \"Unit\" is not used"));
    EXPECT_THAT(told, HasSubstr("the column \"Value\" is not used"));
}

TEST(ComparisonJob, ComparesTwoBudgetsWithoutPoints) {
    const ComparisonJob job =
        read_comparison(R"("unit": "um", "lab": {"budget": "a.json"}, "reference": {"budget": "b.json"})",
                        {{"a.json", test::point_budget("")}, {"b.json", test::point_budget("")}});
    EXPECT_EQ(job.methods->points.size(), 1U);
    EXPECT_THAT(job.methods->reference.budget_points, ElementsAre(0));
}

// ---- size -----------------------------------------------------------------------------------------------------------

TEST(ComparisonJob, ReadsATableOfTwentyFiveThousandResults) {
    std::string table = "participant,item,value,U,k,group\n";
    for (int participant = 0; participant < 250; ++participant) {
        for (int item = 0; item < 100; ++item) {
            table += "L" + std::to_string(participant) + ",item " + std::to_string(item) + ",10." +
                     std::to_string(participant) + ",0.2,2,group " + std::to_string(participant % 7) + "\n";
        }
    }
    const ComparisonJob job = read_comparison(R"("participants": {"file": "r.csv"})", {{"r.csv", table}});
    EXPECT_EQ(job.results.size(), 25'000U);
    EXPECT_EQ(job.participants.size(), 250U);
    EXPECT_EQ(job.items.size(), 100U);
}

// ---- examples -------------------------------------------------------------------------------------------------------

TEST(ComparisonJob, ReadsTheShippedExamples) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/comparison";
    const ComparisonJob key = read_comparison_job(folder / "key_comparison.json");
    EXPECT_EQ(key.results.size(), 6U);
    EXPECT_EQ(test::texts(key.warnings), "");
    const ComparisonJob proficiency = read_comparison_job(folder / "proficiency_test.json");
    EXPECT_EQ(proficiency.items.size(), 2U);
    EXPECT_EQ(proficiency.youden.size(), 1U);
    EXPECT_FALSE(proficiency.missing.empty());
    EXPECT_EQ(test::texts(proficiency.warnings), "");
    const ComparisonJob methods = read_comparison_job(folder / "methods.json");
    EXPECT_EQ(methods.methods->correlation, MethodCorrelation::shared_sources);
    EXPECT_EQ(test::texts(methods.warnings), "");
}

}  // namespace
}  // namespace gumcert::jobs
