#include "reports/dcc/dcc_document.h"
#include "encoding/base64.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "reports/dcc/dcc_element.h"
#include "reports/dcc/dcc_reader.h"
#include "reports/dcc/dcc_rules.h"
#include "reports/dcc/dcc_writer.h"
#include "tests/unit/reports/dcc/dcc_samples.h"

namespace gumcert::reports {
namespace {

using test::certified_budget;
using test::certified_rotary_table;
using test::dcc_assets;
using testing::HasSubstr;

/// Renders and holds the document against its schema (where that is there) and against the business rules.
std::string checked(const EvaluationRecord& record, const std::vector<std::string>& languages = {"en"}) {
    std::string document = render_dcc(record, dcc_assets(languages));
    for (const gum::Diagnostic& d : check_dcc(document, "document")) {
        // The verdicts of the samples are invented, and their limits have nothing to do with the values.
        EXPECT_TRUE(d.severity != gum::Severity::error || d.code == "GC-DCC-0116") << message(d);
    }
    if (std::filesystem::exists(test::shared_dcc())) {
        EXPECT_EQ(test::schema_errors(document), "");
    }
    return document;
}

std::vector<ImportedQuantity> results_of(const std::string& document) {
    std::vector<ImportedQuantity> all = read_dcc(document, "document").quantities;
    std::erase_if(all, [](const ImportedQuantity& q) { return q.role != "result"; });
    return all;
}

/// Quantities whose refType holds a name.
std::vector<ImportedQuantity> named(const std::string& document, const std::string& name) {
    std::vector<ImportedQuantity> found = read_dcc(document, "document").quantities;
    std::erase_if(found, [&](const ImportedQuantity& q) {
        const std::vector<std::string> names = xml_list(q.ref_type);
        return std::find(names.begin(), names.end(), name) == names.end();
    });
    return found;
}

/// Texts of all elements of a name, in the order of the document.
std::vector<std::string> texts(const std::string& document, const std::string& element) {
    std::vector<std::string> found;
    for_each_element(read_dcc_root(document, "document"), [&](const XmlElement& e) {
        if (e.name == element) {
            found.push_back(e.trimmed());
        }
    });
    return found;
}

bool contains(const std::vector<std::string>& texts, const std::string& text) {
    return std::find(texts.begin(), texts.end(), text) != texts.end();
}

std::string ascii(const std::string& printed) {
    return printed.starts_with("\u2212") ? "-" + printed.substr(std::string("\u2212").size()) : printed;
}

TEST(DccDocument, OfARecordWithoutCertificateDataIsASpecimen) {
    const std::string budget = checked(test::sample_budget_record());
    EXPECT_EQ(texts(budget, "dcc:uniqueIdentifier"), std::vector<std::string>{"not stated (specimen)"});
    EXPECT_EQ(texts(budget, "dcc:beginPerformanceDate"), std::vector<std::string>{"0001-01-01"});
    EXPECT_NE(budget.find("refType=\"gumcert_specimen\""), std::string::npos);
    EXPECT_EQ(budget.find("basic_isInCMC"), std::string::npos);
    const auto l = named(budget, "gumcert_l");
    ASSERT_EQ(l.size(), 1U);
    EXPECT_EQ(l[0].value, "50000838");
    EXPECT_EQ(l[0].U, "93");
    EXPECT_EQ(l[0].k, "2.92");
    EXPECT_EQ(l[0].p, "0.99");
    EXPECT_EQ(l[0].unit, "nm");
    (void)checked(test::sample_record());
    (void)checked(test::sample_two_results_record());
}

TEST(DccDocument, SaysThatItsTemplatesWereChanged) {
    RenderAssets own = dcc_assets({"en"});
    EXPECT_EQ(render_dcc(certified_budget(), own).find("changedTemplates"), std::string::npos);
    own.changed_templates = "9e7c1a5b2d3f";
    const std::string document = render_dcc(certified_budget(), own);
    EXPECT_NE(document.find("<dcc:statement refType=\"gumcert_changedTemplates\">"), std::string::npos);
    EXPECT_TRUE(contains(texts(document, "dcc:reference"), "9e7c1a5b2d3f"));
    EXPECT_TRUE(contains(texts(document, "dcc:content"), "changed templates 9e7c1a5b2d3f"));
}

TEST(DccDocument, HoldsEveryCertifiedNumberAsItIsPrinted) {
    for (const EvaluationRecord& record : {certified_budget(), certified_rotary_table()}) {
        const std::string document = checked(record, {});
        std::vector<std::pair<std::string, std::string>> expected;
        for (const certificate::CertifiedTable& table : record.certificate->tables) {
            for (const certificate::CertifiedColumn& column : table.columns) {
                for (const certificate::CertifiedValue& v : column.values) {
                    expected.emplace_back(ascii(v.printed_value), v.printed_U);
                }
            }
        }
        std::vector<std::pair<std::string, std::string>> found;
        for (const ImportedQuantity& q : results_of(document)) {
            if (q.ref_type.starts_with("basic_m")) {  // measuredValue, measurementError
                found.emplace_back(q.value, q.U);
            }
        }
        EXPECT_EQ(found, expected);
    }
}

TEST(DccDocument, SaysWhatTheLaboratoryStates) {
    const std::string document = checked(certified_budget(), {});
    EXPECT_EQ(texts(document, "dcc:uniqueIdentifier"), std::vector<std::string>{"EX-2026-0042"});
    EXPECT_EQ(texts(document, "dcc:usedLangCodeISO639_1"), (std::vector<std::string>{"en", "de"}));
    EXPECT_EQ(texts(document, "dcc:mandatoryLangCodeISO639_1"), std::vector<std::string>{"en"});
    EXPECT_EQ(texts(document, "dcc:issueDate"), std::vector<std::string>{"2026-11-21"});
    EXPECT_EQ(texts(document, "dcc:receiptDate"), std::vector<std::string>{"2026-11-16"});
    EXPECT_EQ(texts(document, "dcc:role"), (std::vector<std::string>{"approval", "review", "calibration"}));
    EXPECT_EQ(texts(document, "dcc:inValidityRange"), std::vector<std::string>{"true"});
    EXPECT_EQ(texts(document, "dcc:model"), std::vector<std::string>{"EW 50"});
    const std::vector<std::string> contents = texts(document, "dcc:content");
    for (const char* text :
         {"Beispiel-Kalibrierlaboratorium", "Example Customer", "Lufttemperatur", "Laserinterferometer"}) {
        EXPECT_TRUE(contains(contents, text)) << text;
    }
    EXPECT_TRUE(contains(texts(document, "dcc:value"), std::string(64, 'a')));  // digest of the standard's certificate
    const auto minimum = named(document, "basic_temperatureMin");
    ASSERT_EQ(minimum.size(), 1U);
    EXPECT_EQ(minimum[0].value, "19.8");
    EXPECT_EQ(minimum[0].unit, "degC");
    EXPECT_EQ(named(document, "gumcert_expandedUncertaintyOfSensor").at(0).unit, "K");
    // Without the second language only the first one is there.
    const std::string german = checked(certified_budget(), {"de"});
    EXPECT_EQ(german.find("lang="), std::string::npos);
    EXPECT_TRUE(contains(texts(german, "dcc:content"), "Lufttemperatur"));
    EXPECT_FALSE(contains(texts(german, "dcc:content"), "Air temperature"));
}

TEST(DccDocument, MapsVerdictsToTheWordsOfTheFormat) {
    EvaluationRecord record = certified_rotary_table();
    certificate::CertifiedTable& motions = record.certificate->tables[1];
    ASSERT_EQ(motions.id, "error_motions");
    const std::array verdicts = {"pass",         "fail",          "conditional_pass", "conditional_fail",
                                 "undetermined", "not_applicable"};
    std::vector<certificate::CertifiedValue>& values = motions.columns[3].values;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i < verdicts.size()) {
            values[i].verdict = test::sample_verdict("axial", verdicts.at(i));
        }
    }
    values[1].scope_entry.clear();
    values[2].external = true;
    values[3].raised = true;
    const std::string document = checked(record, {});
    std::string words = "pass fail conditionalPass conditionalFail";
    for (std::size_t i = 4; i < values.size(); ++i) {
        words += " noPass";
    }
    EXPECT_TRUE(contains(texts(document, "dcc:conformityXMLList"), words));
    std::string exact = "pass fail conditional_pass conditional_fail undetermined not_applicable";
    for (std::size_t i = 6; i < values.size(); ++i) {
        exact += " none";
    }
    EXPECT_TRUE(contains(texts(document, "dcc:charsXMLList"), exact));
    std::string in_scope = "true false false";
    for (std::size_t i = 3; i < values.size(); ++i) {
        in_scope += " true";
    }
    EXPECT_TRUE(contains(texts(document, "dcc:validXMLList"), in_scope));
    const auto limits = named(document, "basic_toleranceLimitUpper");
    ASSERT_GE(limits.size(), 6U);
    EXPECT_TRUE(std::any_of(limits.begin(), limits.end(), [](const auto& q) { return q.value == "10.0"; }));
    // Single values have single words.
    EXPECT_TRUE(contains(texts(document, "dcc:conformity"), "pass"));
}

// A reader of the file alone must learn what the page says of a value and of a verdict.
TEST(DccDocument, SaysWhatTheModelGivesBesideAMeanOfTrials) {
    EvaluationRecord record = certified_budget();
    Result& result = record.results.at(0);
    result.reported.method = "monte_carlo";
    result.reported.u = 10.0;
    result.reported.value = result.value + 9.0;
    result.reported.printed.value = "50000847";
    certificate::CertifiedValue& v = record.certificate->tables[0].columns[0].values[0];
    v.verdict = test::sample_verdict("length", "not_applicable");
    v.verdict->note =
        "At the estimates of the input quantities the measurement model gives another value than the mean of the Monte "
        "Carlo trials, and the rule another verdict: nothing is decided.";
    const std::string document = checked(record, {});
    EXPECT_NE(document.find("the measurement model gives another value: " + result.name + ": "), std::string::npos);
    EXPECT_NE(document.find(v.verdict->note), std::string::npos);
}

TEST(DccDocument, WritesMonteCarloIntervals) {
    EvaluationRecord record = certified_budget();
    certificate::CertifiedValue& v = record.certificate->tables[0].columns[0].values[0];
    v.interval = {50000745.0, 50000932.0};
    v.printed_low = "50000745";
    v.printed_high = "50000932";
    v.printed_U.clear();
    v.printed_k.clear();
    v.u = 35.6;
    const auto l = named(checked(record), "gumcert_l");
    ASSERT_EQ(l.size(), 1U);
    EXPECT_EQ(l[0].kind, "coverage_interval");
    EXPECT_EQ(l[0].low, "50000745");
    EXPECT_EQ(l[0].high, "50000932");
    EXPECT_EQ(l[0].u, "36");
    EXPECT_EQ(l[0].p, "0.99");
}

TEST(DccDocument, KeepsColumnsApartThatStateDifferentThings) {
    EvaluationRecord record = certified_rotary_table();
    std::vector<certificate::CertifiedValue>& values = record.certificate->tables[1].columns[0].values;
    values[0].printed_U.clear();  // by definition without uncertainty
    values[0].U.reset();
    values[1].interval = {0.1, 1.2};
    values[1].printed_low = "0.10";
    values[1].printed_high = "1.20";
    const auto exa = named(checked(record), "gumcert_EXA");
    const std::size_t rows = values.size();
    ASSERT_EQ(exa.size(), 3 * rows);  // with U, with intervals, without uncertainty
    EXPECT_EQ(exa[0].value + exa[1].value, "NaNNaN");
    EXPECT_EQ(exa[2].kind, "expanded");
    EXPECT_EQ(exa[rows + 1].kind, "coverage_interval");
    EXPECT_EQ(exa[rows + 1].low, "0.10");
    EXPECT_EQ(exa[rows].value + exa[rows + 2].value, "NaNNaN");
    EXPECT_EQ(exa[2 * rows].kind, "none");
    EXPECT_EQ(exa[2 * rows].value, values[0].printed_value);
    EXPECT_EQ(exa[2 * rows + 1].value, "NaN");
}

TEST(DccDocument, StatesAFactorBelowOneInWords) {
    EvaluationRecord record = certified_budget();
    certificate::CertifiedValue& v = record.certificate->tables[0].columns[0].values[0];
    v.printed_k = "0.95";
    const std::string document = checked(record);
    const auto l = named(document, "gumcert_l");
    ASSERT_EQ(l.size(), 1U);
    EXPECT_EQ(l[0].kind, "standard");
    EXPECT_NE(document.find("Expanded uncertainties U: 93; coverage factors k: 0.95."), std::string::npos);
}

TEST(DccDocument, HoldsCovariancesUnrounded) {
    const std::string document = checked(test::sample_two_results_record());
    const std::vector<std::string> values = texts(document, "si:valueXMLList");
    ASSERT_EQ(values.size(), 5U);
    EXPECT_EQ(values[0], "127.73 219.85");
    EXPECT_EQ(values[1], "0.005041");
    EXPECT_EQ(values[2], "-0.01234");
    EXPECT_EQ(values[3], "-0.01234");
    EXPECT_EQ(values[4], "0.08738");
    EXPECT_TRUE(contains(texts(document, "si:unitXMLList"), "\\ohm\\tothe{2}"));
    EXPECT_EQ(texts(document, "si:coverageFactorXMLList"), std::vector<std::string>{"2.49"});
    EXPECT_EQ(texts(document, "si:coverageProbabilityXMLList"), std::vector<std::string>{"0.9545"});
}

TEST(DccDocument, AttachesALargeCovarianceAsTable) {
    EvaluationRecord record = test::sample_budget_record();
    ResultCovariance c;
    constexpr std::size_t k_quantities = 51;
    for (std::size_t i = 0; i < k_quantities; ++i) {
        c.names.push_back((i == 0 ? "=l" : "l") + std::to_string(i));  // the first would be a formula
        c.units.emplace_back("nm");
        c.matrix.emplace_back(k_quantities, 0.5);
    }
    record.covariance = c;
    const std::string document = checked(record);
    EXPECT_EQ(texts(document, "dcc:fileName"), std::vector<std::string>{"covariance.csv"});
    const std::string start = encoding::base64("result,unit,\"'=l0\",\"l");  // 21 bytes: no padding
    EXPECT_EQ(texts(document, "dcc:dataBase64").at(0).substr(0, start.size()), start);
    // Too large for the record itself: the file beside it is named.
    record.covariance->matrix.clear();
    record.covariance->file = "covariance.csv";
    EXPECT_NE(checked(record).find("is in the file covariance.csv beside"), std::string::npos);
}

TEST(DccDocument, RefersToTheCertificateThatItAmends) {
    EvaluationRecord record = certified_budget();
    certificate::Amendment amendment;
    amendment.kind = "replaced";
    amendment.number = "EX-2026-0041";
    amendment.sha256 = std::string(64, 'c');
    amendment.reason = "the serial number was wrong";
    amendment.changes = {"serial number"};
    record.certificate->data.amendment = amendment;
    std::string document = checked(record);
    EXPECT_EQ(texts(document, "dcc:typeOfChange"), std::vector<std::string>{"substituted"});
    EXPECT_EQ(texts(document, "dcc:replacedUniqueIdentifier"), std::vector<std::string>{"EX-2026-0041"});
    EXPECT_EQ(texts(document, "dcc:referralID").front(), "EX-2026-0041");
    EXPECT_TRUE(contains(texts(document, "dcc:value"), std::string(64, 'c')));
    record.certificate->data.amendment->kind = "amended";
    record.certificate->data.amendment->sha256.clear();
    document = checked(record);
    EXPECT_EQ(texts(document, "dcc:typeOfChange"), std::vector<std::string>{"amended"});
    EXPECT_EQ(document.find("dcc:previousReport"), std::string::npos);
}

TEST(DccDocument, MarksADraftWithItsFindings) {
    EvaluationRecord record = certified_budget();
    record.certificate->blocked = true;
    record.certificate->findings = {{.id = "R01-e",
                                     .clause = "ISO/IEC 17025:2017, 7.8.2.1 e",
                                     .severity = certificate::FindingSeverity::critical,
                                     .where = "/customer",
                                     .what = "no customer",
                                     .action = "State it."}};
    const std::string document = checked(record);
    EXPECT_NE(document.find("refType=\"gumcert_draft\""), std::string::npos);
    EXPECT_NE(document.find("no customer"), std::string::npos);
}

// A document that is printed again says what became of it, as its pages do.
TEST(DccDocument, SaysThatItIsSuperseded) {
    EvaluationRecord record = certified_budget();
    EXPECT_EQ(read_dcc(checked(record), "issued.xml").state, "");
    record.certificate->superseded_by = "EX-1/A1";
    const std::string document = checked(record);
    EXPECT_NE(document.find("SUPERSEDED by EX-1/A1"), std::string::npos);
    EXPECT_EQ(read_dcc(document, "superseded.xml").state, "superseded document");
    record.certificate->blocked = true;
    EXPECT_EQ(read_dcc(checked(record), "draft.xml").state, "draft");
}

TEST(DccDocument, DefinesUnitsThatAreNotInDSi) {
    EvaluationRecord record = certified_budget();
    record.certificate->tables[0].columns[0].unit = "inch";
    const std::string document = checked(record);
    EXPECT_TRUE(contains(texts(document, "si:unit"), "|inch"));
    EXPECT_EQ(texts(document, "dcc:nonSIDefinition").at(0), "1 inch = 0.0254 m");
}

/// "ft" looks like the femtotonne, "yd" like the yoctoday.
TEST(DccDocument, TakesNoSymbolForAPrefixWithAnotherUnit) {
    for (const char* unit : {"ft", "yd", "kt", "pt"}) {
        EvaluationRecord record = certified_budget();
        record.certificate->tables[0].columns[0].unit = unit;
        const std::string document = checked(record);
        EXPECT_TRUE(contains(texts(document, "si:unit"), std::string("|") + unit)) << unit;
        EXPECT_EQ(document.find("tonne"), std::string::npos);
        EXPECT_EQ(document.find("\\day"), std::string::npos);
    }
}

/// As the published good-practice files: every standard under basic_measurementStandard, its certificate as an element.
TEST(DccDocument, StatesEveryStandardWithItsCertificateAndCoverageFactor) {
    EvaluationRecord record = certified_budget();
    certificate::StandardUsed first = record.certificate->data.standards.at(0);
    first.U = 0.025;
    first.k = 2.5;
    first.unit = "um";
    certificate::StandardUsed second = first;
    second.role = "working";
    second.certificate = "CL-7";
    second.sha256.clear();
    record.certificate->data.standards = {first, second};
    const std::string document = checked(record);
    std::vector<std::string> ref_types;
    for_each_element(read_dcc_root(document, "document"), [&](const XmlElement& e) {
        if (e.name == "dcc:measuringEquipment") {
            ref_types.push_back(e.attribute("refType"));
            EXPECT_NE(e.child("dcc:certificate"), nullptr);
        }
    });
    EXPECT_EQ(ref_types, (std::vector<std::string>{"basic_measurementStandard gumcert_referenceStandard",
                                                   "basic_measurementStandard gumcert_workingStandard"}));
    EXPECT_EQ(texts(document, "dcc:referralID"), (std::vector<std::string>{first.certificate, "CL-7"}));
    EXPECT_EQ(texts(document, "dcc:procedure"), (std::vector<std::string>{"SHA-256", "not stated"}));
    const auto k = named(document, "gumcert_coverageFactorOfStandard");
    ASSERT_EQ(k.size(), 2U);
    EXPECT_EQ(k[0].value, "2.5");
    EXPECT_EQ(named(document, "gumcert_expandedUncertaintyOfStandard").at(0).value, "0.025");
}

TEST(DccDocument, NamesPressureAmongTheConditions) {
    EvaluationRecord record = certified_budget();
    certificate::Condition& condition = record.certificate->data.conditions.at(0);
    condition.kind = "pressure";
    condition.unit = "hPa";
    condition.minimum = 1010.0;
    condition.maximum = 1019.0;
    const std::string document = checked(record);
    const auto minimum = named(document, "gumcert_pressureMin");
    ASSERT_EQ(minimum.size(), 1U);
    EXPECT_EQ(minimum[0].value + " " + minimum[0].unit, "1010 hPa");
    EXPECT_EQ(named(document, "gumcert_pressureMax").size(), 1U);
}

TEST(DccDocument, LabelsDegreesOfFreedomByTheirResult) {
    const EvaluationRecord record = certified_rotary_table();
    std::set<std::string> labels;
    for (const ImportedQuantity& q : named(checked(record), "gumcert_effectiveDegreesOfFreedom")) {
        labels.insert(q.label);
    }
    std::set<std::string> expected;
    for (const certificate::CertifiedTable& table : record.certificate->tables) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            if (std::any_of(column.values.begin(), column.values.end(), [](const certificate::CertifiedValue& v) {
                    return d_si_number(v.printed_nu_eff) != "NaN";
                })) {
                expected.insert(column.result);
            }
        }
    }
    EXPECT_EQ(labels, expected);
    EXPECT_GE(labels.size(), 6U);
}

/// The standard uncertainty beside a covariance is not raised to the capability: such a result leaves the
/// accreditation.
TEST(DccDocument, MarksJointResultsWithinTheScope) {
    EvaluationRecord record = test::certified(test::sample_two_results_record(), "length");
    std::vector<certificate::CertifiedColumn>& columns = record.certificate->tables.front().columns;
    ASSERT_EQ(columns.size(), 2U);
    EXPECT_TRUE(contains(texts(checked(record), "dcc:validXMLList"), "true true"));
    columns[0].values[0].raised = true;
    EXPECT_TRUE(contains(texts(checked(record), "dcc:validXMLList"), "false true"));
    columns[0].values[0].raised = false;
    columns[1].values[0].scope_entry.clear();
    EXPECT_TRUE(contains(texts(checked(record), "dcc:validXMLList"), "true false"));
}

/// A standard uncertainty of 0 beside a covariance would be an error of this program's own check of digital certificates.
TEST(DccDocument, LeavesExactResultsOutOfJointOnes) {
    EvaluationRecord record = test::sample_two_results_record();
    ASSERT_EQ(record.covariance->names.size(), 2U);
    const std::string name = record.covariance->names[0];
    for (Result& result : record.results) {
        if (result.name == name) {
            result.u = 0.0;
        }
    }
    record.covariance->matrix[0] = {0.0, 0.0};
    record.covariance->matrix[1][0] = 0.0;
    const std::string document = checked(record);
    const std::vector<std::string> lists = texts(document, "si:valueStandardMUXMLList");
    EXPECT_FALSE(contains(lists, "0"));
    EXPECT_TRUE(std::none_of(lists.begin(), lists.end(), [](const auto& list) { return list.starts_with("0 "); }));
    EXPECT_EQ(texts(document, "si:covarianceXMLList").size(), 1U);
    record.covariance->matrix[1][1] = 0.0;
    for (Result& result : record.results) {
        result.u = 0.0;
    }
    EXPECT_TRUE(texts(checked(record), "si:covarianceXMLList").empty());
}

/// A singular covariance has no ellipsoid; the certificate prints the hyper-rectangle then.
TEST(DccDocument, StatesTheRectangleWhereThereIsNoEllipsoid) {
    EvaluationRecord record = test::sample_two_results_record();
    ASSERT_TRUE(record.region);
    record.region->k_p = {};
    record.region->k_q = {2.23, "2.23"};
    const std::string document = checked(record);
    EXPECT_EQ(document.find("ellipsoidalRegion"), std::string::npos);
    EXPECT_NE(document.find("<si:rectangularRegionMUXMLList>"), std::string::npos);
    EXPECT_EQ(texts(document, "si:coverageFactorXMLList"), std::vector<std::string>{"2.23"});
    record.region.reset();
    EXPECT_EQ(texts(checked(record), "si:coverageFactorXMLList"), std::vector<std::string>{"NaN"});
}

/// An imported certificate is the source of an input: its number and digest are passed on.
TEST(DccDocument, PassesOnWhereInputsComeFrom) {
    EvaluationRecord record = certified_budget();
    record.results.at(0).budget.at(0).source = "certificate EX-7, SHA-256 " + std::string(64, 'd');
    record.results.at(0).budget.at(0).input = "l_s";
    record.results.push_back(record.results[0]);  // the same input in another budget
    std::vector<std::string> sources;
    for_each_element(read_dcc_root(checked(record), "document"), [&](const XmlElement& e) {
        if (e.name == "{urn:gumcert:evaluation}inputSource" && e.attribute("input") == "l_s") {
            sources.push_back(e.text);
        }
    });
    EXPECT_EQ(sources, std::vector<std::string>{"certificate EX-7, SHA-256 " + std::string(64, 'd')});
}

TEST(DccDocument, ListsPointsOfABudget) {
    EvaluationRecord record = test::sample_budget_record();
    Result second = record.results[0];
    record.results[0].point = "low end";
    second.name = "l (high)";
    second.point = "high";
    second.coverage_probability = 0.95;
    second.k.reset();
    second.U.reset();
    second.coverage = "none";
    second.printed.U = "";
    record.results.push_back(second);
    const std::string document = checked(record);
    EXPECT_TRUE(contains(texts(document, "dcc:charsXMLList"), "low_end high"));
    const auto l = named(document, "gumcert_l");
    ASSERT_EQ(l.size(), 4U);  // once with U, once with u
    EXPECT_EQ(l[0].p, "0.99");
    EXPECT_EQ(l[3].u, "32");
}

TEST(DccDocument, StaysTheSameTreeWithHostileTexts) {
    EvaluationRecord plain = certified_budget();
    const auto tree = [](const EvaluationRecord& record) {
        std::string names;
        for_each_element(read_dcc_root(checked(record), "document"),
                         [&](const XmlElement& e) { names += e.name + "\n"; });
        return names;
    };
    const std::string expected = tree(plain);
    for (const std::string hostile :
         {"</dcc:content><script>alert(1)</script>", "<!DOCTYPE a [<!ENTITY x SYSTEM 'file:///etc/passwd'>]>&x;", "]]>",
          "{{name}} ${name} url(file:///etc/passwd)", "\u202Eevil\u202C", "\"'><&amp;&#0;", "  two  blanks \t",
          "a\x01\x02\xFF\xFE", "<!-- -->", "| \\metre"}) {
        EvaluationRecord record = plain;
        certificate::CertificateData& d = record.certificate->data;
        record.title = hostile;
        d.number = d.customer.order = d.item.manufacturer = d.item.type = d.item.serial_number = hostile;
        d.item.identification = d.laboratory.code = d.laboratory.telephone = d.laboratory.email = hostile;
        d.laboratory.name = d.customer.name = d.item.description = d.method.title = d.method.description = hostile;
        d.laboratory.address.lines = d.customer.address.lines = {hostile, hostile};
        d.persons.authorised_by->name = d.persons.performed_by->name = d.customer.contact = hostile;
        d.standards[0].name = hostile;
        d.standards[0].certificate = d.standards[0].identification = hostile;
        d.conditions[0].quantity = d.remarks[0] = hostile;
        d.conditions[0].sensor = d.specifications[0].document = hostile;
        record.certificate->tables[0].columns[0].name = hostile;
        record.job_files[0].name = hostile;
        EXPECT_EQ(tree(record), expected) << hostile;
    }
}

/// Parts of an address have elements of their own (locationType of schema 3.3.0); lines are further texts.
TEST(DccDocument, GivesAnAddressByItsParts) {
    EvaluationRecord record = certified_budget();
    certificate::Address& address = record.certificate->data.laboratory.address;
    address.lines = {"Building 5"};
    address.country = "DE";
    address.street = "Example Street";
    address.street_no = "1";
    address.post_office_box = "PO Box 7";
    address.postcode = "12345";
    address.city = "Example Town";
    address.state = "Region";
    const std::string text = checked(record);
    for (const char* element : {"<dcc:street>Example Street</dcc:street>", "<dcc:streetNo>1</dcc:streetNo>",
                                "<dcc:postOfficeBox>PO Box 7</dcc:postOfficeBox>", "<dcc:postCode>12345</dcc:postCode>",
                                "<dcc:city>Example Town</dcc:city>", "<dcc:state>Region</dcc:state>", "Building 5"}) {
        EXPECT_THAT(text, HasSubstr(element));
    }
    EXPECT_LT(text.find("Building 5"), text.find("<dcc:street>"));
}

TEST(DccDocument, NeverLosesANumber) {
    EvaluationRecord record = certified_budget();
    record.certificate->tables[0].columns[0].values[0].printed_value = "1 234";
    EXPECT_THROW((void)render_dcc(record, dcc_assets({"en"})), gum::NoResultError);
}

TEST(DccDocument, HasTheTitleInTheLanguagesOfTheCertificate) {
    EvaluationRecord record = certified_budget();
    record.title = "Length gauge";
    record.title_by_language.by_language = {{"en", "Length gauge"}, {"de", "Längenmaß"}};
    record.certificate->data.languages = {"de", "en"};
    const std::string text = checked(record, {});
    EXPECT_THAT(text, HasSubstr("<dcc:content lang=\"de\">Längenmaß</dcc:content>"));
    EXPECT_THAT(text, HasSubstr("<dcc:content lang=\"en\">Length gauge</dcc:content>"));
}

TEST(DccDocument, IsTheSameBytesEveryTime) {
    const EvaluationRecord record = certified_rotary_table();
    EXPECT_EQ(render_dcc(record, dcc_assets({})), render_dcc(record, dcc_assets({})));
}

// A section is a measurement result of its own, with the item and the method that it states.
TEST(DccDocument, WritesASectionAsAMeasurementResult) {
    EvaluationRecord record = certified_budget();
    certificate::Certificate& c = *record.certificate;
    std::vector<std::string> quantities;
    for (certificate::CertifiedTable& table : c.tables) {
        table.section = "part";
        for (const certificate::CertifiedColumn& column : table.columns) {
            quantities.push_back(column.result);
        }
    }
    record.sections = {{.name = "part", .title = "First part", .quantities = quantities}};
    certificate::SectionData own;
    own.section = "part";
    own.item = c.data.item;
    own.item->serial_number = "SN-OTHER";
    own.method = c.data.method;
    own.method->identification = "CP-OTHER";
    c.data.sections = {own};
    const std::string text = checked(record);
    EXPECT_THAT(text, HasSubstr("<dcc:measurementResult refId=\"item_2\">"));
    EXPECT_THAT(text, HasSubstr("<dcc:item>")) << "that of the certificate, which no result is of";
    EXPECT_THAT(text, HasSubstr("<dcc:item id=\"item_2\">"));
    EXPECT_TRUE(business_rule_breaches(read_dcc_root(text, "own"), "own").empty());
    EXPECT_THAT(text, HasSubstr("SN-OTHER"));
    EXPECT_THAT(text, HasSubstr("CP-OTHER"));
    EXPECT_THAT(text, HasSubstr("First part"));
    EvaluationRecord of_sections = record;
    certificate::Item& of_all = of_sections.certificate->data.item;
    of_all.serial_number = of_all.identification = "";
    of_all.condition = "Seal broken";
    of_all.manufacturer = "Maker of all";
    const std::string without = checked(of_sections);
    EXPECT_THAT(without, testing::Not(HasSubstr("<dcc:item>")));
    EXPECT_THAT(without, HasSubstr("Seal broken")) << "what is stated of all items, as on the first page";
    EXPECT_THAT(without, HasSubstr("Maker of all"));
    record.sections.push_back({.name = "other", .title = {}, .quantities = {}});
    const std::string two = checked(record);
    EXPECT_THAT(two, HasSubstr("<dcc:measurementResult refId=\"item_1\">")) << "one without an item of its own";
    EXPECT_THAT(two, HasSubstr("<dcc:item id=\"item_1\">"));
}

// One instrument in several sections (DC voltage, resistance) is one item, to which all of them refer.
TEST(DccDocument, WritesAnItemOfSeveralSectionsOnce) {
    EvaluationRecord record = certified_budget();
    certificate::Certificate& c = *record.certificate;
    std::vector<std::string> quantities;
    for (certificate::CertifiedTable& table : c.tables) {
        table.section = "a";
        for (const certificate::CertifiedColumn& column : table.columns) {
            quantities.push_back(column.result);
        }
    }
    for (const char* name : {"a", "b", "c"}) {
        record.sections.push_back({.name = name, .title = {}, .quantities = quantities});
        certificate::SectionData& own = c.data.sections.emplace_back();
        own.section = name;
        own.item = c.data.item;
        own.item->serial_number = std::string(name) == "b" ? "SN-B" : "SN-A";
        own.item->condition = std::string(name) == "c" ? "Seal broken" : "No damage seen";
        own.item->owner = std::string(name) == "c" ? "Second owner" : "First owner";
        own.item->stated_by_customer = {std::string(name) == "a" ? "condition" : "owner"};
    }
    const auto count = [](const std::string& text, const std::string& of) {
        std::size_t n = 0;
        for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + 1)) {
            ++n;
        }
        return n;
    };
    const std::string text = checked(record);
    EXPECT_EQ(count(text, "<dcc:item id="), 2U);
    EXPECT_EQ(count(text, "<dcc:measurementResult refId=\"item_2\">"), 2U);
    EXPECT_EQ(count(text, "<dcc:measurementResult refId=\"item_3\">"), 1U);
    EXPECT_EQ(count(text, ">SN-A<"), 1U);
    EXPECT_THAT(text, HasSubstr("Seal broken")) << "what a section says of it is kept";
    EXPECT_THAT(text, HasSubstr("Second owner"));
    EXPECT_EQ(count(text, "does not answer for it"), 3U) << "each item has what the customer stated of it";
    EXPECT_THAT(text, HasSubstr("(SN-A): "));
    EXPECT_THAT(text, HasSubstr("(SN-B): "));
    EXPECT_TRUE(business_rule_breaches(read_dcc_root(text, "own"), "own").empty());
    c.data.item = *c.data.sections[0].item;  // that of the certificate, too
    const std::string of_all = checked(record);
    EXPECT_EQ(count(of_all, "<dcc:item id="), 2U);
    EXPECT_EQ(count(of_all, "<dcc:measurementResult refId=\"item_1\">"), 2U);
}

/// Three points of a table, two of which are about pieces of a set.
EvaluationRecord record_of_set() {
    EvaluationRecord record = test::sample_budget_record();
    const Result first = record.results.front();
    record.results.clear();
    certificate::PointTable points;
    certificate::PointColumn serial;
    serial.name = "serial";
    serial.role = "serial_number";
    serial.printed = {"A 1", "A 2", ""};
    serial.values.resize(serial.printed.size());
    certificate::PointColumn nominal;
    nominal.name = "l_n";
    nominal.role = "nominal";
    nominal.unit = nominal.printed_unit = "mm";
    nominal.values = {0.5, 1.0, 2.0};
    nominal.printed = {"0.5", "1.0", "2.0"};
    for (const char* name : {"1", "2", "3"}) {
        points.points.emplace_back(name);
        Result& result = record.results.emplace_back(first);
        result.quantity = first.name;
        result.point = name;
        result.name = first.name + "[" + name + "]";
    }
    points.columns = {serial, nominal};
    certificate::TableRequest& table = points.tables.emplace_back();
    for (const auto& [show, of] :
         {std::pair("column", "serial"), std::pair("column", "l_n"), std::pair("value", "l"), std::pair("U", "l")}) {
        table.columns.push_back({.show = show, .of = of, .heading = {}, .role = "", .stage = ""});
    }
    record.points = points;
    return test::certified(std::move(record), "length");
}

/// The set is an item, its pieces are items below it, and rows refer to them.
TEST(DccDocument, NamesThePiecesOfASet) {
    const EvaluationRecord record = record_of_set();
    const std::string document = checked(record, {"en", "de"});
    EXPECT_THAT(document, HasSubstr("<dcc:item id=\"item_1_1\">"));
    EXPECT_THAT(document, HasSubstr("<dcc:result refId=\"item_1_1 item_1_2 item_1\""));
    EXPECT_THAT(document, HasSubstr("<dcc:list refId=\"item_1_1 item_1_2 item_1\">"));
    EXPECT_THAT(document, HasSubstr("<dcc:measurementResult refId=\"item_1\">"));
    EXPECT_THAT(document, HasSubstr("refType=\"basic_serialNumber gumcert_serial\""));
    const ImportedCertificate read = read_dcc(document, "document");
    ASSERT_EQ(read.items.size(), 3U) << "the set, and two pieces";
    EXPECT_EQ(read.items[1].name, "Nominal value 0.5 mm");
    EXPECT_THAT(read.items[2].identifications, testing::ElementsAre("Serial number A 2"));
    const auto nominal = named(document, "basic_nominalValue");
    ASSERT_GE(nominal.size(), 2U);
    EXPECT_EQ(nominal[0].role, "item");
    EXPECT_EQ(nominal[0].value, "0.5");
    EXPECT_EQ(nominal[0].unit, "mm");
    const auto l = named(document, "gumcert_l");
    ASSERT_EQ(l.size(), 3U);
    EXPECT_EQ(l[0].about, 1U);
    EXPECT_EQ(l[1].about, 2U);
    EXPECT_EQ(l[2].about, 0U);
    // A certificate about one item says nothing of it with every number.
    EXPECT_FALSE(named(checked(certified_budget()), "gumcert_l").at(0).about);
}

}  // namespace
}  // namespace gumcert::reports
