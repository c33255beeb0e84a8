#include "jobs/laboratory/laboratory_use.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "jobs/budget/budget_job.h"
#include "jobs/laboratory/laboratory_folder.h"
#include "laboratory/outlook.h"
#include "tests/support/sample_laboratory.h"

namespace gumcert::jobs {
namespace {

using nlohmann::json;

json job_of(const json& inputs, const json& certificate = {}) {
    json job{{"schema", "gumcert/job/1"}, {"kind", "budget"}, {"laboratory", "lab"}, {"inputs", inputs}};
    if (!certificate.is_null()) {
        job["certificate"] = certificate;
    }
    return job;
}

BudgetJob read(const json& job, std::map<std::string, std::string> files = test::sample_laboratory_files("lab/")) {
    files["job.json"] = job.dump();
    return read_budget_job(MemoryFileSource(std::move(files)), "job.json");
}

certificate::LaboratoryRegister register_of(const json& job) {
    std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
    files["job.json"] = job.dump();
    return register_of_job(MemoryFileSource(std::move(files)), "job.json").value();
}

std::vector<std::string> codes_of_job(const json& job) {
    std::vector<std::string> codes;
    try {
        (void)read(job);
    } catch (const gum::DiagnosedError& error) {
        for (const gum::Diagnostic& diagnostic : error.diagnostics()) {
            codes.push_back(diagnostic.code);
        }
    }
    return codes;
}

const json k_work = {{"status", "specimen"},
                     {"dates", {{"performed_from", "2026-07-01"}, {"performed_to", "2026-07-02"}}}};

TEST(LaboratoryUseTest, AnInputGetsValueUncertaintyAndDrift) {
    const BudgetJob job = read(job_of({{"V", {{"standard", "STD-1"}, {"unit", "mV"}}}}, k_work));
    ASSERT_EQ(job.inputs.size(), 1U);
    const auto& parts = job.inputs[0].components;
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_DOUBLE_EQ(parts[0].value, 10.002);  // SI
    EXPECT_DOUBLE_EQ(parts[0].u, 0.001);
    EXPECT_EQ(parts[0].degrees_of_freedom, 50.0);
    EXPECT_EQ(parts[0].source, "STD-1, certificate C-2");
    // 182 days from the calibration to the last day of the work, at 0.5 mV a year.
    EXPECT_NEAR(parts[1].u, 0.0005 * 182.0 / 365.25 / std::sqrt(3.0), 1e-12);
    EXPECT_EQ(job.inputs[0].unit.text(), "mV");
    EXPECT_THAT(job.files, testing::Contains("lab/standards/STD-1.json"));
}

TEST(LaboratoryUseTest, UnitAndDayMayComeFromRegisterAndInput) {
    const BudgetJob job = read(job_of({{"V", {{"standard", "STD-1"}, {"date", "2025-01-11"}, {"take", "deviation"}}}}));
    EXPECT_EQ(job.inputs[0].unit.text(), "V");
    EXPECT_NEAR(job.inputs[0].components[0].value, 0.001, 1e-12);  // by the calibration of that day
    EXPECT_EQ(job.inputs[0].components[0].source, "STD-1, certificate C-1");
}

/// What the folder does not have is no file that cannot be read: it is bad input, told once, with the names that there are.
TEST(LaboratoryUseTest, NamesWhatTheFolderHas) {
    const auto told = [](const json& job, const std::string& table = "") {
        std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
        files["p.csv"] = table;
        std::vector<std::string> messages;
        try {
            (void)read(job, std::move(files));
        } catch (const gum::InputError& error) {
            for (const gum::Diagnostic& one : error.diagnostics()) {
                messages.push_back(one.code + " " + gum::message(one));
            }
        }
        return messages;
    };
    const json sound{{"V", {{"value", 1}, {"u", 1}}}};
    const auto with = [&](const char* key, const json& value) {
        json certificate = k_work;
        certificate[key] = value;
        return job_of(sound, certificate);
    };
    using testing::AllOf;
    using testing::ElementsAre;
    using testing::HasSubstr;
    EXPECT_THAT(told(job_of({{"V", {{"standard", "STD-2"}}}}, k_work)),
                ElementsAre(AllOf(HasSubstr("GC-LAB-0112"), HasSubstr("/inputs/V/standard"), HasSubstr("\"STD-2\""),
                                  HasSubstr("lab/standards/"), HasSubstr("did you mean \"STD-1\"?"))));
    EXPECT_THAT(told(with("customer", "ACME")),
                ElementsAre(AllOf(HasSubstr("GC-LAB-0112"), HasSubstr("no such customer"), HasSubstr("\"CUST-3\""),
                                  testing::Not(HasSubstr("did you mean")))));
    EXPECT_THAT(told(with("customer", {{"id", "CUST-4"}, {"order", "1"}})),
                ElementsAre(AllOf(HasSubstr("GC-LAB-0112"), HasSubstr("/customer/id"))));
    EXPECT_THAT(told(with("method", "CP-2")), ElementsAre(AllOf(HasSubstr("GC-LAB-0112"), HasSubstr("\"CP-1\""))));
    EXPECT_THAT(told(with("standards", json::array({"STD-2"}))), ElementsAre(HasSubstr("GC-LAB-0112")));
    json points = job_of({{"V", {{"unit", "V"}}}, {"x", {{"unit", "V"}, {"u", 0.1}}}}, k_work);
    points["model"] = {"y = x - V"};
    points["points"] = {{"file", "p.csv"}};
    EXPECT_THAT(told(points, "V.standard,x\nSTD-2,1\nSTD-2,2\nSTD-1,3\n"),
                ElementsAre(AllOf(HasSubstr("GC-LAB-0112"), HasSubstr("p.csv:2:1"))));
}

/// U as a share of the value is that share of it, and the list of standards shows it with two digits.
TEST(LaboratoryUseTest, TakesARelativeUncertainty) {
    std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
    json standard = json::parse(files["lab/standards/STD-1.json"]);
    json& line = standard["/calibrations/1/results/0"_json_pointer];
    line.erase("U");
    line["relative_U"] = 2e-4;
    files["lab/standards/STD-1.json"] = standard.dump();
    const auto read_with = [&](const json& certificate) {
        return read(job_of({{"V", {{"standard", "STD-1"}}}}, certificate), files);
    };
    const BudgetJob job = read_with(k_work);
    EXPECT_DOUBLE_EQ(job.inputs[0].components[0].u, 0.5 * 2e-4 * 10.002);
    ASSERT_EQ(job.certificate->standards.size(), 1U);
    EXPECT_EQ(job.certificate->standards[0].U, 0.002);
    const auto contradictions = [&](double U) {
        json certificate = k_work;
        certificate["standards"] = {
            {{"identification", "STD-1"}, {"name", "Standard"}, {"U", U}, {"k", 2}, {"unit", "mV"}}};
        files["job.json"] = job_of({{"V", {{"standard", "STD-1"}}}}, certificate).dump();
        return register_of_job(MemoryFileSource(files), "job.json").value().contradictions;
    };
    EXPECT_TRUE(contradictions(2.0).empty()) << "to the digits that an uncertainty has";
    EXPECT_TRUE(contradictions(2.0004).empty());
    EXPECT_EQ(contradictions(2.1).size(), 1U);
}

TEST(LaboratoryUseTest, TellsContradictionsInPlainDigits) {
    json certificate = k_work;
    certificate["standards"] = {
        {{"identification", "STD-1"}, {"name", "Standard"}, {"U", 6e-5}, {"k", 2}, {"unit", "V"}}};
    const auto all = register_of(job_of({{"V", {{"standard", "STD-1"}}}}, certificate)).contradictions;
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].stated, "0.00006 V");
    EXPECT_EQ(all[0].registered, "0.002 V");
}

TEST(LaboratoryUseTest, OwnComponentsStandBehindThoseOfTheRegister) {
    const BudgetJob job = read(job_of({{"V",
                                        {{"standard", "STD-1"},
                                         {"date", "2026-01-01"},
                                         {"components", {{{"name", "cable"}, {"value", 0}, {"u", 0.1}}}}}}}));
    const auto& parts = job.inputs[0].components;
    ASSERT_EQ(parts.size(), 2U);  // no drift on the day of the calibration
    EXPECT_EQ(parts[1].u, 0.1);
}

/// A standard that is not there, or whose file is refused, is told as that, whatever the job makes of it: a model that lacks
/// its input is no fault of the model.
TEST(LaboratoryUseTest, AFaultOfTheRegisterIsNoFaultOfTheModel) {
    const auto told = [](const json& job, std::map<std::string, std::string> files) {
        std::vector<std::string> messages;
        try {
            files["p.csv"] = "V.at,x\n10,1\n10,2\n";
            (void)read(job, std::move(files));
        } catch (const gum::DiagnosedError& error) {
            for (const gum::Diagnostic& one : error.diagnostics()) {
                messages.push_back(one.code + " " + gum::message(one));
            }
        }
        return messages;
    };
    const json specification{
        {"id", "s"}, {"results", {"y"}}, {"unit", "V"}, {"rule", {{"id", "DR-01"}}}, {"limits", {{"by", "points"}}}};
    for (const bool in_sections : {false, true}) {
        for (const std::string role : {"", "reference"}) {
            for (const std::string points : {"file", "list", ""}) {
                for (const bool limits : {false, true}) {
                    json certificate = k_work;
                    if (limits) {
                        certificate["specifications"] = {specification};
                    }
                    json job =
                        job_of({{"V", {{"standard", "STD-1"}, {"unit", "V"}}}, {"x", {{"unit", "V"}, {"u", 0.1}}}},
                               certificate);
                    if (!role.empty()) {
                        job["inputs"]["V"]["role"] = role;
                    }
                    json part{{"model", {"y = x - V"}}};
                    if (points == "file") {
                        part["points"] = {{"file", "p.csv"}};
                    } else if (points == "list") {
                        part["points"] = {{{"V", {{"at", 10}}}, {"x", 1}}, {{"V", {{"at", 10}}}, {"x", 2}}};
                    } else {
                        job["inputs"]["x"]["value"] = 1;
                    }
                    if (in_sections) {
                        job["sections"]["A"] = part;
                    } else {
                        job.update(part);
                    }
                    SCOPED_TRACE(job.dump());
                    std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
                    files.erase("lab/standards/STD-1.json");
                    const std::vector<std::string> missing = told(job, files);
                    EXPECT_THAT(missing, testing::ElementsAre(testing::HasSubstr("has no such standard")));
                    EXPECT_THAT(missing, testing::Each(testing::StartsWith("GC-LAB-0112")));
                    EXPECT_THAT(missing, testing::Each(testing::HasSubstr("job.json#/inputs/V/standard")));
                    files["lab/standards/STD-1.json"] =
                        R"j({"schema": "gumcert/standard/1", "id": "STD-1", "drif": 1})j";
                    const std::vector<std::string> refused = told(job, files);
                    EXPECT_FALSE(refused.empty());
                    EXPECT_THAT(refused, testing::Each(testing::HasSubstr("lab/standards/STD-1.json")));
                }
            }
        }
    }
}

TEST(LaboratoryUseTest, PointsMayUseStandards) {
    json job = job_of({{"V", {{"unit", "V"}}}});
    job["points"] = {{{"V", {{"standard", "STD-1"}, {"date", "2026-01-01"}}}},
                     {{"V", {{"standard", "STD-1"}, {"date", "2025-01-01"}}}}};
    const BudgetJob read_job = read(job);
    EXPECT_EQ(read_job.points.size(), 2U);
}

TEST(LaboratoryUseTest, WhatCannotBeIsRefused) {
    using testing::ElementsAre;
    json without = job_of({{"V", {{"standard", "STD-1"}}}});
    EXPECT_THAT(codes_of_job(without), ElementsAre("GC-LAB-0107"));  // the day
    without.erase("laboratory");
    EXPECT_THAT(codes_of_job(without), ElementsAre("GC-LAB-0100"));
    const auto with = [](json input) {
        input["standard"] = "STD-1";
        return codes_of_job(job_of({{"V", std::move(input)}}, k_work));
    };
    EXPECT_THAT(with({{"unit", "K"}}), ElementsAre("GC-LAB-0108"));
    EXPECT_THAT(with({{"at", 5}}), ElementsAre("GC-LAB-0014"));
    EXPECT_THAT(with({{"at", "5"}}), ElementsAre("GC-CERT-0103"));
    EXPECT_THAT(with({{"take", "half"}}), ElementsAre("GC-CERT-0106"));
    EXPECT_THAT(with({{"date", "yesterday"}}), ElementsAre("GC-CERT-0107"));
    EXPECT_THAT(with({{"u", 1}}), testing::Not(testing::IsEmpty()));  // beside what the register states
    EXPECT_THAT(codes_of_job(job_of({{"V", {{"standard", "../x"}}}})), ElementsAre("GC-LAB-0101"));
}

TEST(LaboratoryUseTest, OneStandardInTwoInputsIsTold) {
    const json input{{"standard", "STD-1"}, {"date", "2026-01-01"}};
    json job = job_of({{"a", input}, {"b", input}});
    const std::vector<gum::Diagnostic> warnings = read(job).warnings;
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].code, "GC-LAB-0109");
    job["correlations"] = {{"a", "b", 0.9}};
    EXPECT_TRUE(read(job).warnings.empty());
}

TEST(LaboratoryUseTest, CertificateDataAreFilledIn) {
    json certificate = k_work;
    certificate["customer"] = {{"id", "CUST-3"}, {"order", "PO-1"}};
    certificate["method"] = "CP-1";
    certificate["persons"] = {{"authorised_by", "HL"}};
    const BudgetJob job = read(job_of({{"V", {{"standard", "STD-1"}}}}, certificate));
    ASSERT_TRUE(job.certificate);
    const certificate::CertificateData& data = *job.certificate;
    EXPECT_EQ(data.laboratory.name.in("en"), "Laboratory");
    EXPECT_EQ(data.accreditation->number, "A-1");
    EXPECT_THAT(data.accreditation->signatories, testing::ElementsAre("Head"));
    EXPECT_EQ(data.customer.name.in("en"), "Customer");
    EXPECT_EQ(data.customer.order, "PO-1");
    EXPECT_EQ(data.method.version, "4");
    EXPECT_EQ(data.persons.authorised_by->name, "Head");
    EXPECT_EQ(data.persons.authorised_by->authorised_to, "2026-06-30");
    ASSERT_EQ(data.standards.size(), 1U);
    EXPECT_EQ(data.standards[0].certificate, "C-2");
    EXPECT_EQ(data.standards[0].U, 0.002);
    EXPECT_EQ(data.standards[0].valid_to, "2026-12-31");
    const certificate::LaboratoryRegister facts = register_of(job_of({{"V", {{"standard", "STD-1"}}}}, certificate));
    EXPECT_TRUE(facts.contradictions.empty());
    ASSERT_EQ(facts.uses.size(), 1U);
    EXPECT_EQ(facts.uses[0].answer, "yes");
    EXPECT_EQ(facts.signatories.size(), 2U);
}

TEST(LaboratoryUseTest, SectionsNameTheirMethods) {
    json job = job_of({{"V", {{"standard", "STD-1"}}}}, k_work);
    job["sections"] = {{"DC", {{"model", {"y = 2*V"}}}}, {"AC", {{"model", {"z = 3*V"}}}}};
    job["certificate"]["sections"] = {{{"section", "DC"}, {"method", "CP-1"}},
                                      {{"section", "AC"}, {"method", {{"id", "CP-1"}, {"no_deviations", true}}}}};
    const BudgetJob read_job = read(job);
    ASSERT_TRUE(read_job.certificate);
    const auto& sections = read_job.certificate->sections;
    ASSERT_EQ(sections.size(), 2U);
    EXPECT_EQ(sections[0].method->version, "4");
    EXPECT_EQ(sections[1].method->version, "4");
    EXPECT_TRUE(sections[1].method->no_deviations);
    job["certificate"]["sections"][1]["method"]["id"] = "../CP-1";
    EXPECT_THAT(codes_of_job(job), testing::ElementsAre("GC-LAB-0101"));
    job["certificate"]["sections"][1]["method"]["id"] = "CP-1";
    job.erase("laboratory");
    job["inputs"] = {{"V", {{"value", 1}, {"u", 0.1}}}};
    EXPECT_THAT(codes_of_job(job), testing::ElementsAre("GC-LAB-0100", "GC-LAB-0100"));
}

TEST(LaboratoryUseTest, ContradictionsAreNoted) {
    json certificate = k_work;
    certificate["dates"] = {{"performed_from", "2027-02-01"}};
    certificate["accreditation"] = {{"number", "A-2"}};
    certificate["persons"] = {{"authorised_by", "nobody"}};
    certificate["standards"] = {
        {{"name", "Standard"}, {"identification", "STD-1"}, {"certificate", "C-2"}, {"U", 2}, {"unit", "mV"}},
        {{"name", "Other"}, {"identification", "STD-9"}}};
    EXPECT_THAT(codes_of_job(job_of({{"V", {{"standard", "STD-1"}}}}, certificate)),
                testing::ElementsAre("GC-LAB-0106"));
    certificate.erase("persons");
    certificate["standards"][0]["valid_to"] = "2027-12-31";
    const certificate::LaboratoryRegister facts = register_of(job_of({{"V", {{"standard", "STD-1"}}}}, certificate));
    ASSERT_EQ(facts.contradictions.size(), 2U);  // U in another unit is no contradiction
    EXPECT_EQ(facts.contradictions[0].where, "/accreditation/number");
    EXPECT_EQ(facts.contradictions[1].where, "/standards/0/valid_to");
    EXPECT_EQ(facts.contradictions[1].registered, "\"2026-12-31\"");
    EXPECT_EQ(facts.uses[0].answer, "no");  // expired
    EXPECT_THAT(facts.not_registered, testing::ElementsAre("STD-9"));
    EXPECT_TRUE(facts.not_listed.empty());
    certificate["standards"].erase(0);
    EXPECT_THAT(register_of(job_of({{"V", {{"standard", "STD-1"}}}}, certificate)).not_listed,
                testing::ElementsAre("STD-1"));
    EXPECT_FALSE(register_of_job(MemoryFileSource(std::map<std::string, std::string>{{"job.json", "{}"}}), "job.json"));
}

// "the certificate states an array, and the register an array" tells nobody which person or entry it is.
TEST(LaboratoryUseTest, AContradictionNamesTheEntryThatDiffers) {
    json certificate = k_work;
    certificate["accreditation"] = {{"signatories", {"A. Nobody"}}};
    const std::vector<certificate::LaboratoryRegister::Contradiction> found =
        register_of(job_of({{"V", {{"standard", "STD-1"}}}}, certificate)).contradictions;
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].where, "/accreditation/signatories/0");
    EXPECT_EQ(found[0].stated, "\"A. Nobody\"");
    EXPECT_EQ(found[0].registered, "nothing");
    for (const certificate::LaboratoryRegister::Contradiction& one : found) {
        EXPECT_EQ((one.stated + one.registered).find("an array"), std::string::npos);
        EXPECT_EQ((one.stated + one.registered).find("an object"), std::string::npos);
        EXPECT_NE(one.stated, one.registered);
    }
}

// ---- points in a table ----------------------------------------------------------------------------------------------

/// Two ranges of one standard, and a job whose points stand in a table.
std::map<std::string, std::string> files_with_table(const std::string& table, const json& changes = json::object()) {
    std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
    json standard = json::parse(test::k_sample_standard);
    for (json& calibration : standard["calibrations"]) {
        json line = calibration["results"][0];
        calibration["results"][0]["range"] = "10 V";
        line["range"] = "100 V";
        line["nominal"] = 100;
        line["value"] = 100.03;
        line["U"] = 0.01;
        calibration["results"].push_back(line);
    }
    files["lab/standards/STD-1.json"] = standard.dump();
    json job = job_of({{"V", {{"unit", "V"}}}, {"d", {{"value", 0}, {"u", 0.001}, {"unit", "V"}}}}, k_work);
    job["model"] = {"E = V + d"};
    job["outputs"] = {{"E", {{"unit", "V"}}}};
    job["points"] = {{"file", "points.csv"}};
    job.merge_patch(changes);
    files["job.json"] = job.dump();
    files["points.csv"] = table;
    return files;
}

TEST(LaboratoryUseTest, RowsOfATableNameStandards) {
    const auto files = files_with_table(
        "point,V.standard,V.at,V.range,V.date\n"
        "low,STD-1,10,10 V,2026-07-01\n"
        "high,STD-1,,100 V,\n");
    const BudgetJob job = read_budget_job(MemoryFileSource(files), "job.json");
    ASSERT_EQ(job.points.size(), 2U);
    const auto& low = job.points[0].inputs.at(0).second.components;
    ASSERT_EQ(low.size(), 2U);
    EXPECT_NEAR(low[1].u, 0.0005 * 181.0 / 365.25 / std::sqrt(3.0), 1e-12) << "to the day that is stated";
    EXPECT_DOUBLE_EQ(low[0].value, 10.002);
    EXPECT_DOUBLE_EQ(low[0].u, 0.001);
    EXPECT_EQ(low[0].source, "STD-1, certificate C-2");
    const auto& high = job.points[1].inputs.at(0).second.components;
    ASSERT_EQ(high.size(), 2U);
    EXPECT_DOUBLE_EQ(high[0].value, 100.03);
    EXPECT_DOUBLE_EQ(high[0].u, 0.005);
    EXPECT_NEAR(high[1].u, 0.0005 * 182.0 / 365.25 / std::sqrt(3.0), 1e-12) << "to the last day of the work";
    // The same points as objects of the job are the same numbers.
    auto objects = files_with_table(
        "",
        {{"points",
          {{{"point", "low"}, {"V", {{"standard", "STD-1"}, {"at", 10}, {"range", "10 V"}, {"date", "2026-07-01"}}}},
           {{"point", "high"}, {"V", {{"standard", "STD-1"}, {"range", "100 V"}}}}}}});
    const BudgetJob same = read_budget_job(MemoryFileSource(objects), "job.json");
    ASSERT_EQ(same.points.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const auto& a = job.points[i].inputs.at(0).second.components;
        const auto& b = same.points[i].inputs.at(0).second.components;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t c = 0; c < a.size(); ++c) {
            EXPECT_EQ(a[c].value, b[c].value);
            EXPECT_EQ(a[c].u, b[c].u);
            EXPECT_EQ(a[c].source, b[c].source);
        }
    }
    // The gates know of them, too.
    const auto facts = register_of_job(MemoryFileSource(files), "job.json").value();
    ASSERT_EQ(facts.uses.size(), 2U);
    EXPECT_EQ(facts.uses[1].standard, "STD-1");
    EXPECT_EQ(facts.uses[1].input, "V");
}

std::vector<std::vector<double>> values_of(const BudgetJob& job) {
    std::vector<std::vector<double>> all;
    for (const gum::BudgetPoint& point : job.points) {
        std::vector<double>& here = all.emplace_back();
        for (const auto& part : point.inputs.at(0).second.components) {
            here.push_back(part.value);
            here.push_back(part.u);
        }
    }
    return all;
}

BudgetJob read_table(const std::string& table, const json& changes = json::object()) {
    return read_budget_job(MemoryFileSource(files_with_table(table, changes)), "job.json");
}

/// The same of a certificate whose lines have nominal values only.
std::map<std::string, std::string> files_without_ranges(const std::string& table, const json& changes) {
    std::map<std::string, std::string> files = files_with_table(table, changes);
    json standard = json::parse(files["lab/standards/STD-1.json"]);
    for (json& calibration : standard["calibrations"]) {
        for (json& line : calibration["results"]) {
            line.erase("range");
        }
    }
    files["lab/standards/STD-1.json"] = standard.dump();
    return files;
}

json input_of(const json& input) {
    return {{"inputs", {{"V", input}}}};
}

const json k_named_once = {{"standard", "STD-1"}};
const std::string k_rows_at = "point,V.at\nlow,10\nhigh,100\n";

/// The standard stands in the input, and the rows say where it is used: the numbers of rows that name it each.
TEST(LaboratoryUseTest, AStandardIsNamedOnceForAllRows) {
    const std::vector<std::vector<double>> expected =
        values_of(read_table("point,V.standard,V.range,V.at\nlow,STD-1,10 V,10\nhigh,STD-1,100 V,100\n"));
    ASSERT_EQ(expected.size(), 2U);
    EXPECT_EQ(values_of(read_table("point,V.range\nlow,10 V\nhigh,100 V\n", input_of(k_named_once))), expected);
    EXPECT_EQ(values_of(read_table("point,V.at,V.range\nlow,10,10 V\nhigh,100,100 V\n", input_of(k_named_once))),
              expected);
    // A cell goes before the job, and an empty one leaves it to the job.
    EXPECT_EQ(values_of(read_table("point,V.range\nlow,\nhigh,100 V\n",
                                   input_of({{"standard", "STD-1"}, {"range", "10 V"}}))),
              expected);
    json list = input_of(k_named_once);
    const json points{{{"point", "low"}, {"V", {{"range", "10 V"}}}}, {{"point", "high"}, {"V", {{"range", "100 V"}}}}};
    list["points"] = {{"list", points}, {"file", nullptr}};
    EXPECT_EQ(values_of(read_table("", list)), expected);
    list["points"] = points;
    EXPECT_EQ(values_of(read_table("", list)), expected);
}

// A point whose standard does not fit states the input all the same: that it does not is no second fault.
TEST(LaboratoryUseTest, APointThatIsRefusedIsToldOnce) {
    json list = input_of(k_named_once);
    list["points"] = {{{"point", "low"}, {"V", {{"range", "10 V"}, {"at", 99}}}},
                      {{"point", "high"}, {"V", {{"range", "100 V"}}}}};
    std::vector<std::string> codes;
    try {
        (void)read_table("", list);
    } catch (const gum::DiagnosedError& error) {
        for (const gum::Diagnostic& diagnostic : error.diagnostics()) {
            codes.push_back(diagnostic.code);
        }
    }
    EXPECT_THAT(codes, testing::ElementsAre("GC-LAB-0014"));
}

TEST(LaboratoryUseTest, AStandardIsNamedOnceForAllNominalValues) {
    const auto values = [](const std::string& table, const json& changes) {
        return values_of(read_budget_job(MemoryFileSource(files_without_ranges(table, changes)), "job.json"));
    };
    const auto expected = values("point,V.standard,V.at\nlow,STD-1,10\nhigh,STD-1,100\n", json::object());
    ASSERT_EQ(expected.size(), 2U);
    EXPECT_EQ(values(k_rows_at, input_of(k_named_once)), expected);
    json sections = input_of(k_named_once);
    for (const char* key : {"model", "outputs", "points"}) {
        sections[key] = nullptr;
    }
    sections["sections"] = {{"all", {{"model", {"E = V + d"}}, {"points", {{"file", "points.csv"}}}}}};
    EXPECT_EQ(values(k_rows_at, sections), expected);
    const auto facts = register_of_job(MemoryFileSource(files_without_ranges(k_rows_at, sections)), "job.json");
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->uses.size(), 2U) << "the gates know of the rows of a section";
    // Without a unit in the job it is that of the register.
    const auto files = files_without_ranges(k_rows_at, input_of({{"standard", "STD-1"}, {"unit", nullptr}}));
    const BudgetJob in_volts = read_budget_job(MemoryFileSource(files), "job.json");
    EXPECT_EQ(in_volts.inputs.at(0).unit.text(), "V");
    EXPECT_EQ(values_of(in_volts), expected);
}

TEST(LaboratoryUseTest, ComponentsOfTheJobStandBehindAStandardThatIsNamedOnce) {
    const json changes =
        input_of({{"standard", "STD-1"}, {"components", {{{"name", "display"}, {"value", 0}, {"resolution", 0.01}}}}});
    const BudgetJob job = read_table("point,V.range\nlow,10 V\nhigh,100 V\n", changes);
    ASSERT_EQ(job.points.size(), 2U);
    for (const gum::BudgetPoint& point : job.points) {
        EXPECT_EQ(point.inputs.at(0).second.components.back().name, "display");
        EXPECT_EQ(point.inputs.at(0).second.components.size(), 3U) << "calibration, drift, display";
    }
}

/// Only a person is written out as a name and nothing else.
TEST(LaboratoryUseTest, WithoutAFolderThePersonsAloneAreToldToBeANameWrittenOut) {
    for (const auto& [key, value] : std::vector<std::pair<std::string, json>>{{"customer", "C-1"},
                                                                              {"method", "M-1"},
                                                                              {"standards", json::array({"STD-1"})},
                                                                              {"persons", {{"performed_by", "AF"}}}}) {
        json certificate = k_work;
        certificate[key] = value;
        json job = job_of({{"V", {{"value", 1}, {"u", 1}}}}, certificate);
        job.erase("laboratory");
        bool is_told = false;
        try {
            (void)read(job);
        } catch (const gum::DiagnosedError& error) {
            for (const gum::Diagnostic& diagnostic : error.diagnostics()) {
                if (diagnostic.code == "GC-LAB-0100") {
                    is_told = true;
                    EXPECT_EQ(diagnostic.action.find("A. Feld") != std::string::npos, key == "persons") << key;
                }
            }
        }
        EXPECT_TRUE(is_told) << key;
    }
}

TEST(LaboratoryUseTest, WhatIsWrongWithAStandardThatIsNamedOnceIsToldWithItsCell) {
    const auto told_of = [](const std::map<std::string, std::string>& files) {
        std::vector<std::string> all;
        try {
            (void)read_budget_job(MemoryFileSource(files), "job.json");
        } catch (const gum::DiagnosedError& error) {
            for (const gum::Diagnostic& diagnostic : error.diagnostics()) {
                all.push_back(diagnostic.code + " " + diagnostic.where);
            }
        }
        return all;
    };
    const auto told = [&](const std::string& table, const json& input) {
        return told_of(files_without_ranges(table, input_of(input)));
    };
    using testing::ElementsAre;
    using testing::SizeIs;
    EXPECT_THAT(told("point,V.at\nlow,10\nhigh,55\n", k_named_once), ElementsAre("GC-LAB-0014 points.csv:3:6"))
        << "between two calibrated values";
    EXPECT_THAT(told("point,V.at\nlow,10\nhigh,\n", k_named_once), ElementsAre("GC-LAB-0014 points.csv:3:6"))
        << "several lines, and no word of which";
    EXPECT_THAT(told_of(files_with_table("point,V.at,V.range\nlow,10,10 V\nhigh,10,100 V\n", input_of(k_named_once))),
                ElementsAre("GC-LAB-0014 points.csv:3:6"))
        << "a value of another range";
    EXPECT_THAT(told_of(files_with_table("point,V.at\nlow,10\n", input_of(k_named_once))),
                ElementsAre("GC-LAB-0014 points.csv:2:5"))
        << "several ranges, and no word of which";
    EXPECT_THAT(told("point,V.at\nlow,ten\n", k_named_once), SizeIs(1));
    EXPECT_THAT(told(k_rows_at, {{"standard", "STD-9"}}), SizeIs(1)) << "once, not once a row";
    EXPECT_THAT(told(k_rows_at, {{"standard", 9}}), SizeIs(1));
    EXPECT_THAT(told(k_rows_at, {{"standard", "STD-1"}, {"take", "half"}}), SizeIs(1));
    EXPECT_THAT(told("point,V.standard,V.at\nlow,STD-1,10\n", {{"unit", nullptr}}),
                testing::Contains("GC-LAB-0108 points.csv:2:5"))
        << "an input without a unit is a plain number";
}

TEST(LaboratoryUseTest, WhatIsWrongInARowIsToldWithItsCell) {
    const auto first = [](const std::string& table, const json& changes = json::object()) {
        try {
            (void)read_budget_job(MemoryFileSource(files_with_table(table, changes)), "job.json");
        } catch (const gum::DiagnosedError& error) {
            return error.diagnostics().at(0);
        }
        return gum::Diagnostic{};
    };
    const std::string good = "point,V.standard,V.range\nlow,STD-1,10 V\n";
    const gum::Diagnostic unknown_line = first(good + "high,STD-1,1 V\n");
    EXPECT_EQ(unknown_line.code, "GC-LAB-0014");
    EXPECT_EQ(unknown_line.where, "points.csv:3:6");
    const gum::Diagnostic no_identification = first(good + "high,../STD-1,100 V\n");
    EXPECT_EQ(no_identification.code, "GC-LAB-0101");
    EXPECT_EQ(no_identification.where, "points.csv:3:6");
    EXPECT_EQ(first(good + "high,,100 V\n").where, "points.csv:3:6") << "an empty cell";
    const gum::Diagnostic no_number = first("point,V.standard,V.at\nlow,STD-1,ten\n");
    EXPECT_EQ(no_number.where, "points.csv:2:11");
    const gum::Diagnostic no_date = first("point,V.standard,V.range,V.date\nlow,STD-1,10 V,today\n");
    EXPECT_EQ(no_date.where, "points.csv:2:16");
    const gum::Diagnostic alone = first("point,V,V.range\nlow,1,10 V\n");
    EXPECT_THAT(alone.what, testing::HasSubstr("\"V.range\" without \"V.standard\""));
    const gum::Diagnostic no_folder = first(good, {{"laboratory", nullptr}});
    EXPECT_EQ(no_folder.code, "GC-LAB-0100");
    EXPECT_EQ(no_folder.where, "points.csv:2:5");
    const gum::Diagnostic no_standard = first(good + "high,STD-9,100 V\n");
    EXPECT_EQ(no_standard.code, "GC-LAB-0112");
    EXPECT_EQ(no_standard.where, "points.csv:3:6");
    EXPECT_EQ(first("point,V.standard,V.range,V\nlow,STD-1,10 V,3\n").code, "GC-INPUT-0301")
        << "a value of its own beside that of the register";
}

TEST(LaboratoryUseTest, AStandardIsUsedOnADayOfTheWork) {
    const auto on = [](const char* date, json dates) {
        json work = k_work;
        work["dates"] = std::move(dates);
        return codes_of_job(job_of({{"V", {{"standard", "STD-1"}, {"date", date}}}}, work));
    };
    const json two_days{{"performed_from", "2026-07-01"}, {"performed_to", "2026-07-02"}};
    const json one_day{{"performed_from", "2026-07-01"}};
    for (const char* date : {"2026-07-01", "2026-07-02"}) {
        EXPECT_TRUE(on(date, two_days).empty()) << date;
    }
    for (const char* date : {"2026-01-01", "2026-06-30", "2026-07-03", "2027-04-01"}) {
        EXPECT_THAT(on(date, two_days), testing::ElementsAre("GC-LAB-0111")) << date;
        EXPECT_THAT(on(date, one_day), testing::ElementsAre("GC-LAB-0111")) << date;
    }
    EXPECT_TRUE(on("2026-07-01", one_day).empty());
}

// What the overview of the folder says of a standard on a day, the gates say of its use on that day.
TEST(LaboratoryUseTest, TheGatesKnowWhatTheOverviewOfTheFolderSays) {
    const std::vector<json> plans{{},
                                  {{"method", "staircase"},
                                   {"limit", 1},
                                   {"unit", "V"},
                                   {"present_days", 60},
                                   {"extend_by", 1.5},
                                   {"reduce_by", 0.5}},
                                  {{"method", "staircase"},
                                   {"limit", 1},
                                   {"unit", "mV"},
                                   {"present_days", 400},
                                   {"extend_by", 1.2},
                                   {"reduce_by", 0.7}},
                                  {{"method", "in_use_time"},
                                   {"hours", 100},
                                   {"hours_at_calibration", 0},
                                   {"readings", {{{"date", "2026-02-01"}, {"hours", 60}}}}}};
    int overdue = 0;
    for (const json& plan : plans) {
        for (const char* valid_to : {"", "2026-03-31", "2028-12-31"}) {
            for (const char* day : {"2024-12-31", "2025-06-01", "2026-01-01", "2026-02-28", "2026-03-31", "2026-04-01",
                                    "2026-12-31", "2027-06-30", "2029-01-01"}) {
                SCOPED_TRACE(plan.dump() + " " + valid_to + " " + day);
                json standard = json::parse(test::k_sample_standard);
                if (!plan.is_null()) {
                    standard["interval"] = plan;
                }
                for (json& calibration : standard["calibrations"]) {
                    calibration.erase("valid_to");
                }
                if (*valid_to != '\0') {
                    standard["calibrations"][1]["valid_to"] = valid_to;
                }
                std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
                files["lab/standards/STD-1.json"] = standard.dump();
                json work = k_work;
                work["dates"] = {{"performed_from", day}, {"performed_to", day}};
                files["job.json"] = job_of({{"V", {{"standard", "STD-1"}}}}, work).dump();
                const MemoryFileSource source(files);
                JobFiles folder_files(source, "");
                ProblemList problems("");
                JsonDocument named;
                named.value = json{{"laboratory", "lab"}};
                std::optional<LaboratoryFolder> folder = LaboratoryFolder::of_job(folder_files, named, problems);
                ASSERT_TRUE(folder);
                const laboratory::StandardRecord* record = folder->standard("STD-1");
                ASSERT_NE(record, nullptr);
                const laboratory::CalibrationState state = laboratory::calibration_outlook(*record, day).state;
                const certificate::LaboratoryRegister facts = register_of_job(source, "job.json").value();
                const bool is_blocked = !facts.overdue.empty() || facts.uses.empty() ||  // refused: not calibrated yet
                                        facts.uses.front().answer == "no";
                const bool is_out = state == laboratory::CalibrationState::overdue ||
                                    state == laboratory::CalibrationState::not_calibrated;
                EXPECT_EQ(is_blocked, is_out);
                overdue += facts.overdue.empty() ? 0 : 1;
            }
        }
    }
    EXPECT_GT(overdue, 5);
}

TEST(LaboratoryUseTest, AListedStandardMayBeOverdueToo) {
    std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
    json standard = json::parse(test::k_sample_standard);
    standard["interval"] = {{"method", "staircase"}, {"limit", 1},       {"unit", "V"},
                            {"present_days", 60},    {"extend_by", 1.5}, {"reduce_by", 0.5}};
    files["lab/standards/STD-1.json"] = standard.dump();
    json work = k_work;
    work["standards"] = {"STD-1"};
    files["job.json"] = job_of({{"V", {{"value", 1}, {"u", 1}}}}, work).dump();
    const certificate::LaboratoryRegister facts = register_of_job(MemoryFileSource(files), "job.json").value();
    ASSERT_EQ(facts.overdue.size(), 1U);
    EXPECT_EQ(facts.overdue[0].standard, "STD-1");
    EXPECT_EQ(facts.overdue[0].day, "2026-07-02");
    EXPECT_EQ(facts.overdue[0].due, "2026-04-01");  // 1.5 of 60 days after the calibration
}

/// The row of the traceability table of a standard with lines at 10, 20, 30 …, of which points use some.
certificate::StandardUsed row_of_lines(const json& lines, const std::vector<double>& at, const json& stated = {}) {
    std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
    json standard = json::parse(test::k_sample_standard);
    standard["drift"] = {{"model", "none"}, {"reason", "r"}};
    standard["interpolation"] = "linear";
    standard["calibrations"].erase(0);
    standard["calibrations"][0]["results"] = lines;
    files["lab/standards/STD-1.json"] = standard.dump();
    json work = k_work;
    if (!stated.is_null()) {
        work["standards"] = {stated};
    }
    json job = job_of({{"V", {{"standard", "STD-1"}, {"unit", "mV"}}}}, work);
    job["points"] = json::array();
    for (const double value : at) {
        job["points"].push_back({{"V", {{"at", value}}}});
    }
    files["job.json"] = job.dump();
    return read_budget_job(MemoryFileSource(files), "job.json").certificate->standards.at(0);
}

json line_at(double nominal, double U, double k = 2.0) {
    return {{"nominal", nominal}, {"value", nominal}, {"unit", "V"}, {"U", U}, {"k", k}};
}

// One U would be read as that of everything that was measured with the standard (ISO/IEC 17025:2017, 7.8.4.1 c).
TEST(LaboratoryUseTest, TheRowOfAStandardSpansTheLinesThatWereUsed) {
    const json lines{line_at(10, 0.002), line_at(20, 0.003), line_at(30, 0.005), line_at(40, 0.01),
                     line_at(50, 0.0001)};
    for (std::size_t first = 0; first < 4; ++first) {
        for (std::size_t last = first; last < 4; ++last) {
            std::vector<double> at;
            for (std::size_t i = last + 1; i > first; --i) {  // not in the order of the lines
                at.push_back(10.0 * static_cast<double>(i));
            }
            const certificate::StandardUsed row = row_of_lines(lines, at);
            EXPECT_EQ(row.U, lines[first]["U"].get<double>());
            EXPECT_EQ(row.U_to, first == last ? std::nullopt : std::optional(lines[last]["U"].get<double>()));
            EXPECT_EQ(row.k, 2.0);
            EXPECT_EQ(row.unit, "V");
        }
    }
    const certificate::StandardUsed between = row_of_lines(lines, {23.0});
    EXPECT_EQ(between.U, 0.003);
    EXPECT_EQ(between.U_to, 0.005) << "both neighbours";
    EXPECT_EQ(row_of_lines({line_at(10, 0.002), line_at(20, 0.002)}, {10.0, 20.0}).U_to, std::nullopt);
    const certificate::StandardUsed other_k = row_of_lines({line_at(10, 0.002), line_at(20, 0.009, 3.0)}, {10.0, 20.0});
    EXPECT_EQ(other_k.k, 3.0);
    EXPECT_EQ(other_k.U, 0.003);
    EXPECT_EQ(other_k.U_to, 0.009);
    const certificate::StandardUsed own =
        row_of_lines(lines, {10.0, 40.0}, {{"identification", "STD-1"}, {"U", 2}, {"k", 2}, {"unit", "mV"}});
    EXPECT_EQ(own.U, 2.0);
    EXPECT_EQ(own.U_to, std::nullopt) << "what the author states is not mixed with the register";
}

/// Volts say nothing of amperes: a calibrator has a U of each.
TEST(LaboratoryUseTest, TheRowOfAStandardHasEveryKindOfQuantityThatWasUsed) {
    std::map<std::string, std::string> files = test::sample_laboratory_files("lab/");
    json standard = json::parse(test::k_sample_standard);
    standard["drift"] = {{"model", "none"}, {"reason", "r"}};
    standard["calibrations"].erase(0);
    const auto line = [](const char* quantity, const char* unit, double U, double k) {
        return json{{"quantity", quantity}, {"value", 1.0}, {"unit", unit}, {"U", U}, {"k", k}};
    };
    standard["calibrations"][0]["results"] = {line("voltage", "V", 2e-6, 2.0), line("current", "mA", 3e-3, 2.0),
                                              line("small current", "A", 1e-6, 2.5),
                                              line("resistance", "ohm", 0.1, 2.0), line("time", "s", 7.0, 2.0)};
    files["lab/standards/STD-1.json"] = standard.dump();
    const auto with_rows = [&](const json& stated) {
        json inputs;
        for (const auto& [name, unit] : std::map<std::string, std::string>{
                 {"voltage", "V"}, {"current", "A"}, {"small current", "A"}, {"resistance", "ohm"}}) {
            inputs[std::string(1, name[0]) + std::to_string(name.size())] = {
                {"standard", "STD-1"}, {"quantity", name}, {"unit", unit}};
        }
        json work = k_work;
        if (!stated.is_null()) {
            work["standards"] = {stated};
        }
        files["job.json"] = job_of(inputs, work).dump();
        return MemoryFileSource(files);
    };
    const certificate::StandardUsed row = read_budget_job(with_rows({}), "job.json").certificate->standards.at(0);
    std::map<std::string, std::pair<double, std::optional<double>>> all{{row.unit, {row.U.value_or(0.0), row.U_to}}};
    for (const certificate::StandardUsed::FurtherUncertainty& one : row.further) {
        EXPECT_TRUE(all.emplace(one.unit, std::pair{one.U, one.U_to}).second) << one.unit;
    }
    ASSERT_EQ(all.size(), 3U) << "what was not used is not among them";
    EXPECT_EQ(all.at("V"), std::pair(2e-6, std::optional<double>()));
    EXPECT_EQ(all.at("ohm"), std::pair(0.1, std::optional<double>()));
    const bool is_in_milliamperes = all.contains("mA");
    const auto [U, U_to] = all.at(is_in_milliamperes ? "mA" : "A");
    const double scale = is_in_milliamperes ? 1e-3 : 1.0;
    EXPECT_NEAR(U * scale, 8e-7, 1e-12) << "1 µA with k = 2.5, stated with k = 2";
    EXPECT_NEAR(U_to.value_or(0.0) * scale, 3e-6, 1e-12);

    const auto contradictions = [&](double U_of_current) {
        const json stated{{"identification", "STD-1"},
                          {"U", 2},
                          {"k", 2},
                          {"unit", "uV"},
                          {"further", {{{"U", U_of_current}, {"k", 2}, {"unit", "uA"}}}}};
        return register_of_job(with_rows(stated), "job.json").value().contradictions.size();
    };
    EXPECT_EQ(contradictions(3.0), 0U);
    EXPECT_EQ(contradictions(2.0), 1U) << "2e-6 is a U of volts";
}

}  // namespace
}  // namespace gumcert::jobs
