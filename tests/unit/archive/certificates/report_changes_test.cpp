#include "archive/certificates/report_changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/evaluate_job.h"
#include "reports/forms/render.h"
#include "tests/support/archive_folder.h"

namespace gumcert::archive {
namespace {

using nlohmann::json;

const std::filesystem::path k_tree(GUMCERT_SOURCE_DIR);

json base_job() {
    return json::parse(
        R"({"schema": "gumcert/job/1", "kind": "comparison", "title": "Comparison of gauge blocks", "unit": "um",
        "organiser": "Org", "notes": "Note one", "assigned_value": "largest_consistent_subset",
        "certificate": {"number": "CMP-1", "laboratory": {"name": "Example Institute"}, "languages": ["en"],
                        "dates": {"issued": "2026-11-02"}},
        "participants": [{"id": "A", "name": "Alpha", "value": 12.31, "u": 0.10, "cmc_U": 0.1},
                         {"id": "B", "name": "Beta", "value": 12.18, "u": 0.12, "nu": 20},
                         {"id": "C", "name": "Gamma", "value": 12.25, "U": 0.24, "k": 2},
                         {"id": "E", "name": "Epsilon", "value": 12.22, "u": 0.1},
                         {"id": "F", "name": "Phi", "value": 12.27, "u": 0.1},
                         {"id": "X", "name": "Xi", "value": 13.6, "u": 0.1},
                         {"id": "D", "name": "Delta", "value": null, "reason": "transport"}]})");
}

reports::EvaluationRecord evaluated(const json& job) {
    const test::StoreFolder folder;
    const std::filesystem::path file = folder.file("job.json");
    std::ofstream(file, std::ios::binary) << job.dump();
    return evaluation::evaluate_job(file, evaluation::CovarianceFile::none, 1, k_tree / "templates").record;
}

/// What is read of a report, without the digests of its files.
std::string read_of(const reports::EvaluationRecord& record) {
    reports::RenderAssets assets;
    assets.templates = k_tree / "templates";
    std::istringstream lines(reports::render_text(record, assets));
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        text += line.find("job.json") == std::string::npos ? line + '\n' : "";
    }
    return text;
}

std::string listed(const std::vector<certificate::Change>& changes) {
    std::string all;
    for (const certificate::Change& change : changes) {
        all += change.kind + " " + change.where + ": " + change.before + " -> " + change.after + "\n";
    }
    return all;
}

struct Mutation {
    const char* what;
    std::function<void(json&)> change;
};

const std::vector<Mutation>& mutations() {
    static const std::vector<Mutation> k_all = {
        {"nothing", [](json&) {}},
        {"notes", [](json& j) { j["notes"] = "Note two"; }},
        {"another language", [](json& j) { j["certificate"]["languages"] = {"de"}; }},
        {"one more language",
         [](json& j) {
             j["certificate"]["languages"] = {"en", "de"};
         }},
        {"title", [](json& j) { j["title"] = "Comparison of rings"; }},
        {"coverage probability", [](json& j) { j["coverage_probability"] = 0.99; }},
        {"coverage probability, little", [](json& j) { j["coverage_probability"] = 0.9546; }},
        {"capability", [](json& j) { j["participants"][0]["cmc_U"] = 0.11; }},
        {"capability, not printed", [](json& j) { j["participants"][0]["cmc_U"] = 0.1000001; }},
        {"independent source", [](json& j) { j["independent_sources"] = {"std"}; }},
        {"participant out", [](json& j) { j["participants"].erase(6); }},
        {"order of participants", [](json& j) { std::swap(j["participants"][0], j["participants"][1]); }},
        {"first participant out", [](json& j) { j["participants"].erase(0); }},
        {"result not consistent", [](json& j) { j["participants"][4]["value"] = 10.9; }},
        {"value in its last digits", [](json& j) { j["participants"][0]["value"] = 12.3100001; }},
        {"value", [](json& j) { j["participants"][0]["value"] = 12.13; }},
        {"degrees of freedom", [](json& j) { j["participants"][1]["nu"] = 25; }},
        {"reason", [](json& j) { j["participants"][6]["reason"] = "broken"; }},
        {"assigned value", [](json& j) { j["assigned_value"] = "median"; }},
        {"given value",
         [](json& j) {
             j["assigned_value"] = {{"value", 12.2}, {"U", 0.1}, {"k", 2}};
         }},
        {"sigma", [](json& j) { j["sigma_pt"] = 0.2; }},
        {"confidential name", [](json& j) { j["participants"][0]["name"] = "Alpha Ltd"; }},
        {"names released", [](json& j) { j["names"] = "released"; }},
        {"organiser", [](json& j) { j["organiser"] = "Other"; }},
        {"stability", [](json& j) { j["artefact_stability"] = "no change"; }},
        {"laboratory", [](json& j) { j["certificate"]["laboratory"]["name"] = "Institute 2"; }},
    };
    return k_all;
}

// Both ways: an amendment that changes what is read is no false one, and one that changes nothing of it is none.
TEST(ReportChanges, TellSomethingIfAndOnlyIfTheReportReadsOtherwise) {
    const reports::EvaluationRecord earlier = evaluated(base_job());
    const std::string read_earlier = read_of(earlier);
    for (const Mutation& mutation : mutations()) {
        json job = base_job();
        mutation.change(job);
        const reports::EvaluationRecord later = evaluated(job);
        const std::vector<certificate::Change> changes = changes_of_report(earlier, later);
        EXPECT_EQ(read_of(later) != read_earlier, !changes.empty()) << mutation.what << "\n" << listed(changes);
        for (const certificate::Change& change : changes) {
            EXPECT_NE(change.before, change.after) << mutation.what << " " << change.where;
            EXPECT_EQ(change.before.find("a list of"), std::string::npos) << mutation.what << " " << change.where;
        }
        EXPECT_EQ(changes_of_report(later, earlier).empty(), changes.empty()) << mutation.what;
    }
}

// Rows stand by the codes of their participants: where these stand in another order, no result has changed.
TEST(ReportChanges, TellTheRowsOfAParticipantByItsCode) {
    const reports::EvaluationRecord earlier = evaluated(base_job());
    json job = base_job();
    std::swap(job["participants"][0], job["participants"][4]);
    const std::string order = listed(changes_of_report(earlier, evaluated(job)));
    EXPECT_EQ(order.rfind("text /comparison/", 0), 0U) << order;
    EXPECT_NE(order.find("/comparison/order_of_participants: A, B, C, E, F, X, D -> F, B, C, E, A, X, D\n"),
              std::string::npos)
        << order;
    for (const char* const list : {"/comparison/points/", "/comparison/participants/", "/weights/"}) {
        EXPECT_EQ(order.find(list), std::string::npos) << order;
    }
    job = base_job();
    job["participants"].erase(6);
    job["participants"].insert(job["participants"].begin(), json{{"id", "N"}, {"value", nullptr}, {"reason", "late"}});
    for (const certificate::Change& change : changes_of_report(earlier, evaluated(job))) {
        if (change.where.starts_with("/comparison/participants/") || change.where.starts_with("/comparison/points/")) {
            EXPECT_TRUE(change.where.find("/D/") != std::string::npos || change.where.find("/N/") != std::string::npos)
                << change.where << ": " << change.before << " -> " << change.after;
        }
    }
}

// Counts, lists and words that have no digits of their own beside them, and whole texts.
TEST(ReportChanges, TellEachPlaceAsItIsPrinted) {
    const auto told = [](const std::function<void(json&)>& change) {
        json job = base_job();
        change(job);
        return listed(changes_of_report(evaluated(base_job()), evaluated(job)));
    };
    const auto has = [](const std::string& all, const std::string& line) {
        return all.find(line) != std::string::npos;
    };
    const std::string probability = told([](json& j) { j["coverage_probability"] = 0.99; });
    EXPECT_TRUE(has(probability, "printed /printed/coverage_probability: 95.45 % -> 99.00 %\n")) << probability;
    const std::string out = told([](json& j) { j["participants"].erase(6); });
    EXPECT_TRUE(has(out, "text /comparison/participants/D/id: D -> \n")) << out;
    const std::string subset = told([](json& j) { j["participants"][4]["value"] = 10.9; });
    for (const char* const line :
         {"text /comparison/items/0/not_consistent/0: X -> F\n", "text /comparison/items/0/not_consistent/1:  -> X\n",
          "number /comparison/summary/all/count_above_1: ", "number /comparison/participants/F/actions: 0 -> 1\n"}) {
        EXPECT_TRUE(has(subset, line)) << line << subset;
    }
    const std::string language = told([](json& j) { j["certificate"]["languages"] = {"en", "de"}; });
    EXPECT_EQ(language, "text /comparison/languages/1:  -> de\n");
    const std::string capability = told([](json& j) { j["participants"][0]["cmc_U"] = 0.11; });
    EXPECT_TRUE(has(capability, "/U_over_CMC: 2.0 -> 1.8\n")) << capability;
}

// Of many participants every score moves with the assigned value, and each stands in the list to the last one.
TEST(ReportChanges, EndNowhere) {
    json job = base_job();
    job["assigned_value"] = {{"value", 12.0}, {"U", 0.1}, {"k", 2}};
    job["participants"] = json::array();
    for (int i = 0; i < 400; ++i) {
        job["participants"].push_back(
            {{"id", "L" + std::to_string(i)}, {"value", 12.0 + 0.001 * (i % 97)}, {"u", 0.10}});
    }
    const reports::EvaluationRecord earlier = evaluated(job);
    job["assigned_value"]["value"] = 12.05;
    job["title"] = "Another title";
    const std::string all = listed(changes_of_report(earlier, evaluated(job)));
    for (int i = 0; i < 400; ++i) {
        const std::string place = "/comparison/points/L" + std::to_string(i) + "/printed/D:";
        EXPECT_NE(all.find(place), std::string::npos) << place;
    }
    EXPECT_NE(all.find("text /title: Comparison of gauge blocks -> Another title\n"), std::string::npos);
}

// A list of changes goes to every participant, and what stands in a log stands there for ever.
TEST(ReportChanges, NameNobodyWhoseNameIsConfidential) {
    const auto told = [](bool released, bool then_released) {
        json job = base_job();
        job["assigned_value"] = {{"method", "reference"}, {"participant", "A"}};
        const auto with_names = [&](bool are) {
            job.erase("names");
            if (are) {
                job["names"] = "released";
            }
            return evaluated(job);
        };
        const reports::EvaluationRecord earlier = with_names(released);
        job["participants"][0]["name"] = "Secret Ltd";
        job["participants"][1]["value"] = 12.19;
        return listed(changes_of_report(earlier, with_names(then_released)));
    };
    for (const bool released : {false, true}) {
        const std::string confidential = told(released, false);
        EXPECT_EQ(confidential.find("Alpha"), std::string::npos) << confidential;
        EXPECT_EQ(confidential.find("Secret"), std::string::npos) << confidential;
        EXPECT_NE(confidential.find("12.18 -> 12.19"), std::string::npos) << confidential;
    }
    EXPECT_NE(told(true, true).find("/participants/A/name: Alpha -> Secret Ltd\n"), std::string::npos);
    EXPECT_NE(told(false, true).find("/participants/A/name:  -> Secret Ltd\n"), std::string::npos);
}

}  // namespace
}  // namespace gumcert::archive
