#include "jobs/laboratory/register_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "jobs/certificate/certificate_codes.h"
#include "jobs/laboratory/laboratory_codes.h"
#include "tests/fuzz/register_target.h"
#include "tests/support/file_content.h"
#include "tests/support/sample_laboratory.h"

namespace gumcert::jobs {
namespace {

using nlohmann::json;

/// The codes of what is refused of a file.
std::vector<std::string> codes_of(const json& file, bool is_standard) {
    const JsonDocument document = parse_json_document(file.dump(), "file.json");
    ProblemList problems("file.json");
    const bool is_read =
        is_standard ? read_standard(document, problems).has_value() : read_laboratory(document, problems).has_value();
    std::vector<std::string> codes;
    for (const gum::Diagnostic& diagnostic : problems.refused()) {
        codes.push_back(diagnostic.code);
    }
    EXPECT_EQ(is_read, codes.empty());
    return codes;
}

json sample_standard() {
    return json::parse(test::k_sample_standard);
}

/// What is refused of the sample with a value in place of another one.
std::vector<std::string> codes_with(const char* pointer, const json& value) {
    json file = sample_standard();
    file[json::json_pointer(pointer)] = value;
    return codes_of(file, true);
}

TEST(RegisterReader, ReadsWhatAStandardStates) {
    const JsonDocument document = parse_json_document(test::k_sample_standard, "file.json");
    ProblemList problems("file.json");
    const auto record = read_standard(document, problems);
    ASSERT_TRUE(record);
    EXPECT_EQ(record->id, "STD-1");
    EXPECT_EQ(record->role, "reference");
    ASSERT_EQ(record->calibrations.size(), 2U);
    const laboratory::Calibration& last = record->calibrations.back();
    EXPECT_EQ(last.valid_to, "2026-12-31");
    EXPECT_EQ(last.issuer.in("en"), "Institute");
    EXPECT_EQ(last.route, "1");
    EXPECT_EQ(last.results.front().value, 10.002);
    EXPECT_EQ(last.results.front().nu, 50.0);
    EXPECT_EQ(last.results.front().nominal, 10.0);
    EXPECT_EQ(record->drift.kind, laboratory::DriftKind::limit_per_year);
    EXPECT_EQ(record->drift.unit, "mV");
    EXPECT_EQ(record->drift.limit, 0.5);
}

TEST(RegisterReader, ReadsARelativeUncertainty) {
    const auto changed = [](const std::function<void(json&)>& change) {
        json file = sample_standard();
        change(file["/calibrations/0/results/0"_json_pointer]);
        return file;
    };
    const json relative = changed([](json& line) {
        line.erase("U");
        line["relative_U"] = 1e-4;
        line["value"] = -10.001;
    });
    const JsonDocument document = parse_json_document(relative.dump(), "file.json");
    ProblemList problems("file.json");
    const auto record = read_standard(document, problems);
    ASSERT_TRUE(record);
    EXPECT_DOUBLE_EQ(record->calibrations[0].results[0].U, 1e-4 * 10.001);
    using testing::ElementsAre;
    const std::string_view code = k_laboratory_coverage.code;
    EXPECT_THAT(codes_of(changed([](json& line) { line["relative_U"] = 1e-4; }), true), ElementsAre(code));
    EXPECT_THAT(codes_of(changed([](json& line) { line.erase("U"); }), true), ElementsAre(code));
    EXPECT_THAT(codes_of(changed([](json& line) {
                             line.erase("U");
                             line["relative_U"] = 1e-4;
                             line["value"] = 0;
                         }),
                         true),
                ElementsAre(code));
    EXPECT_THAT(codes_of(changed([](json& line) {
                             line.erase("U");
                             line["relative_U"] = 1e-4;
                             line["unit"] = "degC";
                         }),
                         true),
                ElementsAre(code));
    // A level, and an error of which the certificate states no share.
    const auto relative_of = [&](double value, const char* unit, const char* nominal_unit) {
        return codes_of(changed([&](json& line) {
                            line.erase("U");
                            line["relative_U"] = 1e-4;
                            line["value"] = value;
                            line["unit"] = unit;
                            line["nominal"] = 10;
                            line["nominal_unit"] = nominal_unit;
                        }),
                        true);
    };
    EXPECT_THAT(relative_of(10.001, "dB", "dB"), ElementsAre(code));
    EXPECT_THAT(relative_of(0.001, "V", "V"), ElementsAre(code));
    EXPECT_THAT(relative_of(2.0, "mV", "V"), ElementsAre(code));
    EXPECT_THAT(relative_of(10001.0, "mV", "V"), testing::IsEmpty());
    EXPECT_THAT(relative_of(0.001, "V", "A"), testing::IsEmpty()) << "of a shunt";
    EXPECT_THAT(codes_of(changed([](json& line) {
                             line.erase("U");
                             line["relative_U"] = 2;
                         }),
                         true),
                testing::SizeIs(1));
}

/// Lines of one certificate are told apart by their nominal values, and these by their units as well.
TEST(RegisterReader, TellsNominalValuesApartByTheirUnits) {
    const auto codes_of_lines = [](const char* first, const char* second) {
        json file = sample_standard();
        json& results = file["/calibrations/0/results"_json_pointer];
        results = json::array({results.front(), results.front()});
        results[0]["nominal_unit"] = first;
        results[1]["nominal_unit"] = second;
        return codes_of(file, true);
    };
    EXPECT_THAT(codes_of_lines("V", "V"), testing::ElementsAre(k_certificate_repeated.code));
    EXPECT_THAT(codes_of_lines("V", "mV"), testing::IsEmpty());
}

TEST(RegisterReader, RefusesWhatCannotBe) {
    using testing::Contains;
    using testing::ElementsAre;
    EXPECT_THAT(codes_of(sample_standard(), true), testing::IsEmpty());
    EXPECT_THAT(codes_with("/schema", "gumcert/job/1"), ElementsAre(k_laboratory_schema.code));
    EXPECT_THAT(codes_with("/calibrations/0/calibrated", "2026-02-30"), ElementsAre("GC-CERT-0107"));
    EXPECT_THAT(codes_with("/calibrations/0/calibrated", "2026-02-01"),  // after the next one, and after its last day
                ElementsAre(k_laboratory_order.code, k_laboratory_order.code));
    EXPECT_THAT(codes_with("/calibrations/1/valid_to", "2020-01-01"), ElementsAre(k_laboratory_order.code));
    EXPECT_THAT(codes_with("/calibrations/0/route", "9"), ElementsAre("GC-CERT-0106"));
    EXPECT_THAT(codes_with("/calibrations/0/results/0/unit", "volts per"), ElementsAre("GC-CERT-0109"));
    EXPECT_THAT(codes_with("/calibrations/0/results/0/low", 1), ElementsAre("GC-CERT-0115"));
    EXPECT_THAT(codes_with("/calibrations/0/results/0/U", 0), ElementsAre("GC-INPUT-0023"));
    EXPECT_THAT(codes_with("/calibrations/0/results/0/nu", "many"), ElementsAre("GC-INPUT-0021"));
    EXPECT_THAT(codes_with("/calibrations/0/results", json::array()), ElementsAre("GC-CERT-0117"));
    EXPECT_THAT(codes_with("/calibrations", json::array()), ElementsAre("GC-CERT-0117"));
    EXPECT_THAT(codes_with("/drift/limt", 1), ElementsAre("GC-INPUT-0022"));
    EXPECT_THAT(codes_with("/drift/model", "none"), ElementsAre(k_laboratory_drift.code));  // a limit that it has not
    EXPECT_THAT(codes_with("/interval", {{"method", "staircase"}}),
                testing::AllOf(testing::SizeIs(5), testing::Each(k_laboratory_interval.code)));
    json file = sample_standard();
    file["calibrations"][0]["results"][0].erase("k");
    file["calibrations"][1]["results"].push_back(file["calibrations"][1]["results"][0]);
    file["drift"].erase("limit");
    EXPECT_THAT(codes_of(file, true),
                testing::UnorderedElementsAre(k_laboratory_coverage.code, "GC-CERT-0114", k_laboratory_drift.code));
    file = sample_standard();
    file["drift"] = {{"model", "none"}};
    EXPECT_THAT(codes_of(file, true), Contains(k_laboratory_drift.code));
}

// What the fuzz target demands holds for its seeds, and for each of them cut short.
TEST(RegisterReader, EndsInAResultOrARefusal) {
    std::size_t accepted = 0;
    for (const auto& entry : std::filesystem::directory_iterator(GUMCERT_SOURCE_DIR "/tests/fuzz/corpus/register")) {
        const std::string bytes = test::file_content(entry.path());
        accepted += fuzz::register_file(bytes) ? 1U : 0U;
        for (std::size_t size = 0; size < bytes.rfind('}'); size += 7) {
            EXPECT_FALSE(fuzz::register_file(bytes.substr(0, size)));
        }
    }
    EXPECT_EQ(accepted, 3U);  // the fourth one is a laboratory
}

TEST(RegisterReader, ReadsTheLaboratory) {
    const JsonDocument document = parse_json_document(test::k_sample_laboratory, "laboratory.json");
    ProblemList problems("laboratory.json");
    const auto file = read_laboratory(document, problems);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->laboratory["name"], "Laboratory");
    EXPECT_EQ(file->accreditation["number"], "A-1");
    ASSERT_EQ(file->signatories.size(), 2U);
    EXPECT_EQ(file->signatories[0].to, "2026-06-30");
    EXPECT_THAT(file->signatories[0].methods, testing::ElementsAre("CP-1"));
    EXPECT_FALSE(file->signatories[1].authorises);
    json wrong = json::parse(test::k_sample_laboratory);
    wrong["signatories"][1]["id"] = "HL";
    wrong["accreditation"]["valid_to"] = "soon";
    EXPECT_THAT(codes_of(wrong, false), testing::UnorderedElementsAre("GC-CERT-0107", "GC-CERT-0114"));
}

}  // namespace
}  // namespace gumcert::jobs
