#include "reports/view/certificate_view.h"
#include "reports/printable_text.h"

#include "gum/quantity/diagnostic.h"
#include "reports/wording.h"
#include "tests/support/sample_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace gumcert::reports {
namespace {

using nlohmann::json;

json wording() {
    std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/en.json");
    return json::parse(file);
}

void expect_strings_only(const json& value, const std::string& at) {
    if (value.is_structured()) {
        for (const auto& [key, item] : value.items()) {
            expect_strings_only(item, at + "/" + key);
        }
    } else {
        EXPECT_TRUE(value.is_string()) << at << " is " << value.type_name();
    }
}

const json& table_of_view(const json& view, const std::string& id) {
    for (const json& section : view["sections"]) {
        for (const json& block : section["blocks"]) {
            if (!block["table"].empty() && block["table"][0]["id"] == id) {
                return block["table"][0];
            }
        }
    }
    throw std::out_of_range(id);
}

TEST(CertificateView, HoldsStringsOnly) {
    expect_strings_only(certificate_view(test::sample_record(), Wording(wording())), "");
}

TEST(CertificateView, SectionsComeInTheOrderOfACertificate) {
    const json view = certificate_view(test::sample_record(), Wording(wording()));
    std::vector<std::string> ids;
    for (const json& section : view["sections"]) {
        ids.push_back(section["id"]);
    }
    EXPECT_THAT(ids,
                ::testing::ElementsAre("overview", "error_motions", "positioning", "identification", "conventions",
                                       "set_up", "uncertainty", "fixture", "monte_carlo", "adjustment", "reliability",
                                       "geometry", "comparison", "messages", "input", "comparison_points"));
}

TEST(CertificateView, DecimalSignsStandBelowEachOther) {
    EvaluationRecord record = test::sample_record();
    record.rotary->errors[0].errors[0].printed = {.value = "12", .U = "3", .unit = "µm"};
    record.rotary->errors[1].errors[0].printed = {.value = "1.5", .U = "0.25", .unit = "µm"};
    const json view = certificate_view(record, Wording(wording()));
    const json& rows = table_of_view(view, "errors")["rows"];
    EXPECT_EQ(rows[0]["cells"][1]["text"], "12");
    EXPECT_EQ(rows[0]["cells"][1]["pad"], ".00");
    EXPECT_EQ(rows[1]["cells"][1]["pad"], "0");
    EXPECT_EQ(rows[2]["cells"][1]["pad"], "");
    EXPECT_EQ(rows[0]["cells"][0]["pad"], "");
}

TEST(CertificateView, NamesTheErrorMotionsOfEveryAxis) {
    EvaluationRecord record = test::sample_record();
    record.rotary->axis = "C";
    record.rotary->error_names = {"EXC", "EYC", "EZC", "EAC", "EBC", "ECC"};
    const std::string text = certificate_view(record, Wording(wording())).dump();
    EXPECT_THAT(text, ::testing::HasSubstr("d_z: linear, along z (axial)"));
    EXPECT_THAT(text, ::testing::HasSubstr("e_c: angular, about z (positioning)"));
    EXPECT_THAT(text, ::testing::HasSubstr("e_a: angular, about x (tilt)"));
    EXPECT_THAT(text, ::testing::HasSubstr("R_z(θ)"));
}

TEST(CertificateView, AMissingTextIsAnError) {
    json texts = wording();
    texts["sentence"].erase("validity");
    EXPECT_THROW(static_cast<void>(certificate_view(test::sample_record(), Wording(texts))), gum::StorageError);
}

TEST(Wording, PlacesValuesOnce) {
    const json texts = {{"sentence", {{"s", "a {x} b {y} c"}}}};
    EXPECT_EQ(Wording(texts).fill("s", {{"x", "{y}"}, {"y", "2"}}), "a {y} b 2 c");
    EXPECT_THROW(static_cast<void>(Wording(texts).fill("s", {{"x", "1"}})), gum::StorageError);
}

TEST(Printable, RemovesWhatCouldMislead) {
    EXPECT_EQ(printable("Müller µm ″ 校 😀"), "Müller µm ″ 校 😀");
    EXPECT_EQ(printable("a\nb\tc"), "a b c");
    EXPECT_EQ(printable("1\u202E23\u2066\uFEFF"), "1\uFFFD23\uFFFD\uFFFD");
    EXPECT_EQ(printable(std::string("x\0\x1B[31m\x7F", 8)), "x\uFFFD\uFFFD[31m\uFFFD");
    EXPECT_EQ(printable("\xC3(\xFF\xE2\x82"), "\uFFFD(\uFFFD\uFFFD\uFFFD");
}

TEST(Shortened, CountsCharactersNotBytes) {
    EXPECT_EQ(shortened("µµµ", 3), "µµµ");
    EXPECT_EQ(shortened("µµµµ", 3), "µµµ…");
}

}  // namespace
}  // namespace gumcert::reports
