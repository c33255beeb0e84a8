#include "evaluation/recompute_record.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "encoding/sha2.h"
#include "json/canonical_json.h"
#include "text/utf8.h"

namespace gumcert::evaluation {
namespace {

using nlohmann::json;
using reports::EvaluationRecord;

const std::filesystem::path k_shipped_examples = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples";
const std::filesystem::path k_shipped_templates = std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates";

std::string record_of(const std::string& job) {
    return reports::to_canonical_json(
        evaluate_job(k_shipped_examples / job, CovarianceFile::with_others, 1, k_shipped_templates).record);
}

EvaluationRecord read(const std::string& text) {
    return reports::record_from_json(text, "record.json");
}

std::vector<gum::Diagnostic> refusals(const std::string& text) {
    try {
        EvaluationRecord record = read(text);
        if (const std::optional<gum::Diagnostic> why =
                recompute_record(record, "record.json", 1, k_shipped_templates)) {
            return {*why};
        }
    } catch (const gum::InputError& error) {
        return error.diagnostics();
    }
    return {};
}

std::vector<std::string> codes(const std::string& text) {
    std::vector<std::string> all;
    for (const gum::Diagnostic& d : refusals(text)) {
        all.push_back(d.code);
    }
    return all;
}

/// A record with one value changed, closed again with the digest that fits.
std::string edited(const std::string& text, const std::string& pointer, const json& value) {
    json record = json::parse(text);
    json& at = record.at(json::json_pointer(pointer));
    EXPECT_NE(at, value) << pointer;
    at = value;
    return reports::with_digest(record);
}

void leaves_of(const json& value, const json::json_pointer& at, std::vector<std::string>& out) {
    if (value.is_object()) {
        for (const auto& [key, item] : value.items()) {
            leaves_of(item, at / key, out);
        }
    } else if (value.is_array() && !value.empty()) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            leaves_of(value[i], at / i, out);
        }
    } else {
        out.push_back(at.to_string());
    }
}

std::vector<std::string> leaves(const json& record) {
    std::vector<std::string> all;
    leaves_of(record, json::json_pointer(), all);
    std::erase_if(all, [](const std::string& at) { return at.starts_with("/digest/"); });
    return all;
}

/// Another value of the same kind that somebody could write instead.
json another(const json& value, std::mt19937& random) {
    const unsigned way = static_cast<unsigned>(random() % 3U);
    if (value.is_boolean()) {
        return !value.get<bool>();
    }
    if (value.is_number_integer()) {
        const auto number = value.get<std::int64_t>();
        return way == 0 ? number + 1 : way == 1 ? 2 * number + 3 : std::max<std::int64_t>(number - 1, -1);
    }
    if (value.is_number()) {
        const double number = value.get<double>();
        return number == 0.0 ? 1e-3 : way == 0 ? 1.01 * number : way == 1 ? -number : number * 1.000001;
    }
    if (value.is_null()) {
        return way == 0 ? json(1.5) : way == 1 ? json("x") : json::array();
    }
    if (value.is_array()) {
        return json::array({1});
    }
    if (!value.is_string()) {
        return nullptr;
    }
    std::string text = value.get<std::string>();
    const std::size_t digit = text.find_first_of("0123456789");
    if (digit != std::string::npos && way != 2) {
        text[digit] = text[digit] == '9' ? '8' : static_cast<char>(text[digit] + 1);
        return text;
    }
    std::size_t first = 1;  // bytes of the first character
    while (first < text.size() && text::is_continuation(text[first])) {
        ++first;
    }
    return way == 1 && !text.empty() ? json(text.substr(first)) : json(text + "x");
}

struct Edits {
    int done = 0, refused = 0;
    std::vector<std::string> silent;
};

/// Random edits of single values, each closed with a digest that fits: only the recomputation stands against them.
Edits edit_at_random(const std::string& text, int count, unsigned seed) {
    const json record = json::parse(text);
    const EvaluationRecord evaluated = evaluated_again(read(text), "record.json", 1, k_shipped_templates);
    EXPECT_TRUE(disagreements(read(text), evaluated, "record.json").empty());
    // Half of the edits go to a value of a group of values chosen first, so that long lists do not take all of them.
    const std::vector<std::string> all = leaves(record);
    std::map<std::string, std::vector<std::string>> groups;
    for (const std::string& at : all) {
        std::string group;
        for (const char c : at) {
            group += c >= '0' && c <= '9' ? '0' : c;
        }
        groups[group].push_back(at);
    }
    std::vector<const std::vector<std::string>*> of_group;
    for (const auto& [name, members] : groups) {
        of_group.push_back(&members);
    }
    std::mt19937 random(seed);
    Edits edits;
    for (int i = 0; i < count; ++i) {
        const std::vector<std::string>& from = i % 2 == 0 ? all : *of_group[random() % of_group.size()];
        const std::string at = from[random() % from.size()];
        const json& value = record.at(json::json_pointer(at));
        const json other = another(value, random);
        if (other == value) {
            continue;
        }
        ++edits.done;
        json copy = record;
        copy.at(json::json_pointer(at)) = other;
        EXPECT_THROW(static_cast<void>(read(gumcert::json::canonical_json(copy))), gum::InputError)
            << at << " with the old digest";
        bool refused = false;
        try {
            const EvaluationRecord stated = read(reports::with_digest(copy));
            refused = not_recomputable(stated, "record.json").has_value();
            if (!refused) {
                refused = !disagreements(stated,
                                         at.starts_with("/job/files")
                                             ? evaluated_again(stated, "record.json", 1, k_shipped_templates)
                                             : evaluated,
                                         "record.json")
                               .empty();
            }
        } catch (const gum::InputError&) {
            refused = true;
        }
        if (refused) {
            ++edits.refused;
        } else {
            edits.silent.push_back(at + ": " + value.dump().substr(0, 60) + " -> " + other.dump().substr(0, 60));
        }
    }
    return edits;
}

/// What the files of a job do not say: their own names where nothing else names them, the job's and the covariance's.
bool is_a_file_name(const std::string& silent) {
    return silent.starts_with("/job/files/0/name:") || silent.starts_with("/covariance/file:") ||
           silent.starts_with("/rotary/covariance/file:");
}

void expect_no_silent_edit(const std::string& text, int count) {
    Edits edits = edit_at_random(text, count, 20260331);
    std::erase_if(edits.silent, is_a_file_name);
    EXPECT_GT(edits.done, count * 9 / 10);
    EXPECT_EQ(edits.silent, std::vector<std::string>());
    testing::Test::RecordProperty("edits", edits.done);
    testing::Test::RecordProperty("refused", edits.refused);
}

struct KindOfRecord {
    const char* name;
    const char* job;
    int edits;
};

class EveryRecord : public testing::TestWithParam<KindOfRecord> {};

TEST_P(EveryRecord, AgreesWithItsJob) {
    EXPECT_EQ(codes(record_of(GetParam().job)), std::vector<std::string>());
}

TEST_P(EveryRecord, RefusesEveryEditOfAValue) {
    expect_no_silent_edit(record_of(GetParam().job), GetParam().edits);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryRecord,
                         testing::Values(KindOfRecord{"budget", "end_gauge/job.json", 1000},
                                         KindOfRecord{"monte_carlo", "gauge_block/job.json", 400},
                                         KindOfRecord{"outputs", "resistance_and_reactance/job.json", 400},
                                         KindOfRecord{"points", "multimeter/job.json", 400},
                                         KindOfRecord{"fit", "thermometer/job.json", 400},
                                         KindOfRecord{"certificate", "certificate/end_gauge.json", 1000},
                                         KindOfRecord{"rotary_table", "rotary_table/job.json", 40},
                                         KindOfRecord{"laboratories", "comparison/key_comparison.json", 300},
                                         KindOfRecord{"proficiency_test", "comparison/proficiency_test.json", 200},
                                         KindOfRecord{"methods", "comparison/methods.json", 300}),
                         [](const testing::TestParamInfo<KindOfRecord>& kind) { return std::string(kind.param.name); });

TEST(RecomputeRecord, NamesThePlaceAndWhatTheJobGives) {
    const std::string text = record_of("certificate/end_gauge.json");
    const json record = json::parse(text);
    const std::string at = "/certificate/tables/0/columns/0/values/0/printed_U";
    const std::string U = record.at(json::json_pointer(at));
    const std::vector<gum::Diagnostic> found = refusals(edited(text, at, "10"));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "GC-RECORD-0022");
    EXPECT_EQ(found[0].where, "record.json#" + at);
    EXPECT_EQ(found[0].what, "\"10\"");
    EXPECT_EQ(found[0].rule, "the job that the record holds gives \"" + U + '"');
    EXPECT_EQ(found[0].severity, gum::Severity::error);
}

TEST(RecomputeRecord, GatesAreThoseOfTheJob) {
    // Critical findings block a certificate; a record that says they do not is not believed.
    json job = json::parse(read(record_of("certificate/end_gauge.json")).job_json);
    const json certificate =
        json::parse(*reports::bytes_of(read(record_of("certificate/end_gauge.json")).job_files.at(1)), nullptr, true,
                    /*ignore_comments=*/true);
    job["certificate"] = certificate;
    job["certificate"].erase("persons");
    std::map<std::string, std::string> files{{"job.json", job.dump()}};
    for (const reports::InputFile& file : read(record_of("certificate/end_gauge.json")).job_files) {
        files.emplace(file.name, reports::bytes_of(file).value());
    }
    const std::string text = reports::to_canonical_json(
        evaluate_job(jobs::MemoryFileSource(files), "job.json", CovarianceFile::none, 1, k_shipped_templates).record);
    ASSERT_TRUE(json::parse(text)["certificate"]["blocked"]);
    EXPECT_EQ(codes(edited(text, "/certificate/blocked", false)), std::vector<std::string>{"GC-RECORD-0022"});
}

TEST(RecomputeRecord, ManyDisagreementsAreNotAllListed) {
    const std::string text = record_of("end_gauge/job.json");
    json record = json::parse(text);
    for (json& row : record["results"]["l"]["budget"]) {
        for (const char* key : {"contribution", "sensitivity", "u", "share"}) {
            row[key] = 12345.0;
        }
    }
    const std::vector<gum::Diagnostic> found = refusals(reports::with_digest(record));
    ASSERT_EQ(found.size(), k_most_disagreements + 1);
    EXPECT_NE(found.back().what.find("more places"), std::string::npos);
}

TEST(RecomputeRecord, TheLastDigitOfAnotherComputerIsNoDisagreement) {
    const std::string text = record_of("end_gauge/job.json");
    const double u = json::parse(text)["results"]["l"]["u"];
    EXPECT_EQ(codes(edited(text, "/results/l/u", u * (1.0 + 1e-14))), std::vector<std::string>());
    EXPECT_EQ(codes(edited(text, "/results/l/u", u * (1.0 + 1e-8))), std::vector<std::string>{"GC-RECORD-0022"});
}

TEST(RecomputeRecord, FilesAreThoseOfTheirDigests) {
    const std::string text = record_of("multimeter/job.json");
    const json record = json::parse(text);
    const std::string points = record["job"]["files"][1]["content"];
    EXPECT_EQ(codes(edited(text, "/job/files/1/content", points + "\n")), std::vector<std::string>{"GC-RECORD-0023"});
    EXPECT_EQ(codes(edited(text, "/job/files/1/encoding", "base64")), std::vector<std::string>{"GC-RECORD-0023"});
    EXPECT_EQ(codes(edited(text, "/job/files/1/sha256", encoding::sha256("other"))),
              std::vector<std::string>{"GC-RECORD-0023"});
    // Another file with its own digest: the job is another one, and gives another record.
    json other = record;
    std::string text_of_job = other["job"]["files"][0]["content"];
    const std::size_t title = text_of_job.find("\"title\"");
    ASSERT_NE(title, std::string::npos);
    text_of_job.insert(text_of_job.find('"', title + 8) + 1, "New ");
    other["job"]["files"][0]["content"] = text_of_job;
    other["job"]["files"][0]["sha256"] = encoding::sha256(text_of_job);
    EXPECT_EQ(codes(reports::with_digest(other)).front(), "GC-RECORD-0022");
    // A job that cannot be evaluated.
    other["job"]["files"][0]["content"] = "{}";
    other["job"]["files"][0]["sha256"] = encoding::sha256("{}");
    EXPECT_EQ(codes(reports::with_digest(other)), std::vector<std::string>{"GC-RECORD-0024"});
}

TEST(RecomputeRecord, SaysWhyItCannot) {
    const std::string text = record_of("end_gauge/job.json");
    EXPECT_EQ(codes(edited(text, "/software/version", "9.9.9")), std::vector<std::string>{"GC-RECORD-0025"});
    EXPECT_EQ(codes(edited(text, "/software/commit", "0123456789ab")), std::vector<std::string>{"GC-RECORD-0025"});
    json record = json::parse(text);
    record.erase("digest");
    EXPECT_EQ(codes(gumcert::json::canonical_json(record)), std::vector<std::string>{"GC-RECORD-0026"});
    record["job"]["files"][0]["content"] = nullptr;
    record["job"]["files"][0]["encoding"] = "none";
    const std::vector<gum::Diagnostic> why = refusals(reports::with_digest(record));
    ASSERT_EQ(why.size(), 1U);
    EXPECT_EQ(why[0].code, "GC-RECORD-0027");
    EXPECT_NE(why[0].what.find("job.json"), std::string::npos);
}

TEST(RecomputeRecord, DoesNotDependOnTheNumberOfThreads) {
    EvaluationRecord record = read(record_of("gauge_block/job.json"));
    EXPECT_EQ(recompute_record(record, "record.json", 3, k_shipped_templates), std::nullopt);
}

// What is printed was computed here: a number that differs by less than two computers may differ is not taken over.
TEST(RecomputeRecord, BecomesTheRecordThatTheJobGives) {
    const std::string text = record_of("gauge_block/job.json");
    EvaluationRecord record = read(text);
    const double stated = record.results.front().budget.front().u.number;
    record.results.front().budget.front().u.number *= 1.0 + 9e-10;
    EXPECT_EQ(recompute_record(record, "record.json", 1, k_shipped_templates), std::nullopt);
    EXPECT_EQ(record.results.front().budget.front().u.number, stated);
    EXPECT_EQ(reports::to_canonical_json(record), text);
}

// Rows of a matrix of covariances have different units: a small variance is not nothing beside a large one.
TEST(RecomputeRecord, ComparesCovariancesWithTheirOwnUncertainties) {
    const std::map<std::string, std::string> files{{"job.json", R"({"schema": "gumcert/job/1", "kind": "budget",
        "model": ["f = a", "C = b"], "inputs": {"a": {"value": 1e9, "u": 141, "unit": "Hz"},
        "b": {"value": 1e-12, "u": 1.4e-16, "unit": "F"}}, "outputs": {"f": {"unit": "Hz"}, "C": {"unit": "F"}}})"}};
    const std::string text = reports::to_canonical_json(
        evaluate_job(jobs::MemoryFileSource(files), "job.json", CovarianceFile::none, 1, k_shipped_templates).record);
    EXPECT_EQ(codes(text), std::vector<std::string>());
    json record = json::parse(text);
    json& matrix = record["covariance"]["matrix"];
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
            json changed = record;
            json& element = changed["covariance"]["matrix"][i][j];
            element = i == j ? matrix[i][j].get<double>() * 100.0
                             : 0.1 * std::sqrt(matrix[0][0].get<double>() * matrix[1][1].get<double>());
            EXPECT_EQ(codes(reports::with_digest(changed)).size(), 1U) << i << j;
        }
    }
}

}  // namespace
}  // namespace gumcert::evaluation
