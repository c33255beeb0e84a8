#include "archive/certificates/affected_certificates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <utility>

#include "archive/store/sqlite_store.h"
#include "evaluation/evaluate_job.h"
#include "evaluation/read_file.h"
#include "reports/record/record_value.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using nlohmann::json;

const std::filesystem::path k_affected_tree(GUMCERT_SOURCE_DIR);

/// The standard of the example with what holds.
Correction correction_to(std::string corrected) {
    return {.standard = "STD-017",
            .corrected = std::move(corrected),
            .reason = "r",
            .templates = k_affected_tree / "templates"};
}

class ArchiveOfStandards : public testing::Test {
protected:
    void add(const std::string& number, const std::string& record, bool is_issued = true) {
        Draft draft = test::sample_draft(number);
        draft.record = record;
        (void)archive_.draft(draft, by("A. Author"));
        if (is_issued) {
            for (const char* const kind : {"reviewed", "authorised", "issued"}) {
                (void)archive_.advance(number, kind, by("R. Reviewer"));
            }
        }
    }
    Request by(const std::string& who) {
        return {.actor = who, .at = clock_.next(), .request_key = "", .why = "a reason"};
    }
    [[nodiscard]] std::set<std::string> found(const WrongStandard& standard, unsigned threads = 2) {
        std::set<std::string> numbers;
        for (const AffectedCertificate& one : find_affected(archive_, standard, threads)) {
            EXPECT_TRUE(numbers.insert(one.certificate.number).second) << "listed twice";
            EXPECT_FALSE(one.because.empty());
        }
        return numbers;
    }

    test::StoreFolder folder_;
    test::Clock clock_;
    std::unique_ptr<Store> store_ =
        create_sqlite_store(folder_.file(), first_entry({}, "gumcert", "nonce", by("K. Keeper")));
    Archive archive_{*store_};
};

/// Says that a record rests on something, in one of the ways that records have.
void let_rest_on(json& record, const std::string& name, int way) {
    switch (way) {
        case 0:
            record["certificate"]["data"]["standards"].push_back({{"identification", name}, {"certificate", "X"}});
            break;
        case 1:
            record["certificate"]["data"]["standards"].push_back({{"identification", "Y"}, {"certificate", name}});
            break;
        case 2:
            record["job"]["files"].push_back(
                {{"name", "laboratory/standards/" + name + ".json"}, {"encoding", "utf-8"}, {"content", "{}"}});
            break;
        case 3:
            record["results"]["l"]["budget"].push_back({{"components", {{{"source", name + ", certificate 7"}}}}});
            break;
        case 4:
            record["job"]["files"].push_back({{"name", "laboratory/standards/Z.json"},
                                              {"encoding", "utf-8"},
                                              {"content", json{{"calibrations", {{{"certificate", name}}}}}.dump()}});
            break;
        default:
            record["certificate"]["data"]["conditions"].push_back({{"sensor", name}});
    }
}

/// What a record says of something that it does not rest on.
void mention(json& record, const std::string& name) {
    record["title"] = name;
    record["results"]["l"]["budget"].push_back({{"source", name + "1, " + name + "-2, X" + name}});
}

// The oracle knows what was put in, and follows it by itself; it reads no record.
TEST_F(ArchiveOfStandards, AreFoundAllOfThemAndNoOther) {
    constexpr int k_certificates = 400;
    constexpr int k_standards = 12;
    std::mt19937_64 random(7);
    const auto chance = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
    struct Truth {
        std::set<int> standards, certificates;
        std::string day;
        bool has_first_day = false;
        bool is_withdrawn = false;
    };
    std::vector<Truth> truth;
    const auto number = [](int i) { return "EX-" + std::to_string(i); };
    for (int i = 0; i < k_certificates; ++i) {
        Truth one;
        json record = {{"title", "x"}};
        for (int n = chance(3); n > 0; --n) {
            one.standards.insert(chance(k_standards));
        }
        if (i > 0 && chance(3) == 0) {
            one.certificates.insert(chance(i));
        }
        for (const int standard : one.standards) {
            let_rest_on(record, "STD-" + std::to_string(standard), chance(6));
        }
        for (const int certificate : one.certificates) {
            let_rest_on(record, number(certificate), chance(6));
        }
        mention(record, "STD-" + std::to_string(chance(k_standards)) + "x");
        if (chance(5) > 0) {
            one.day = "2026-0" + std::to_string(1 + chance(9)) + "-15";
            record["certificate"]["data"]["dates"]["performed_to"] = one.day;
            one.has_first_day = chance(3) > 0;
            if (one.has_first_day) {
                record["certificate"]["data"]["dates"]["performed_from"] = one.day;
            }
        }
        add(number(i), record.dump(), chance(4) > 0);
        if (chance(10) == 0) {
            one.is_withdrawn = true;
            (void)archive_.advance(number(i), "withdrawn", by("R. Reviewer"));
        }
        truth.push_back(one);
    }
    for (int standard = 0; standard < k_standards; ++standard) {
        const WrongStandard wrong{"STD-" + std::to_string(standard), "2026-04-01",
                                  standard % 2 == 0 ? "" : "2026-06-30"};
        std::set<std::string> expected;
        std::set<std::string> reached;  // withdrawn ones are no answer, but lead on
        for (bool grows = true; grows;) {
            grows = false;
            for (int i = 0; i < k_certificates; ++i) {
                const Truth& one = truth[static_cast<std::size_t>(i)];
                const bool after = one.day.empty() || one.day >= wrong.since;
                const bool before = !one.has_first_day || wrong.until.empty() || one.day <= wrong.until;
                bool rests = one.standards.contains(standard) && before;
                for (const int other : one.certificates) {
                    rests = rests || reached.contains(number(other));
                }
                if (rests && after) {
                    grows = reached.insert(number(i)).second || grows;
                    if (!one.is_withdrawn) {
                        expected.insert(number(i));
                    }
                }
            }
        }
        EXPECT_FALSE(expected.empty());
        EXPECT_EQ(found(wrong, 1), expected) << wrong.name;
        EXPECT_EQ(found(wrong, 3), expected) << wrong.name;
        for (const AffectedCertificate& one : find_affected(archive_, wrong, 1)) {
            const Truth& of = truth[static_cast<std::size_t>(std::stoi(one.certificate.number.substr(3)))];
            const bool is_through =
                std::ranges::any_of(of.certificates, [&](int other) { return reached.contains(number(other)); });
            EXPECT_EQ(one.through.empty() && one.rests_on.empty(), !is_through) << one.certificate.number;
            for (const FoundBefore& other : one.rests_on) {
                const int i = std::stoi(other.number.substr(3));
                EXPECT_TRUE(of.certificates.contains(i) && reached.contains(other.number)) << one.certificate.number;
                EXPECT_EQ(other.state == "withdrawn", truth[static_cast<std::size_t>(i)].is_withdrawn);
            }
        }
    }
}

/// It may rest on anything, and what rests on it as well.
TEST_F(ArchiveOfStandards, TellARecordThatCannotBeRead) {
    add("EX-1", "no record");
    add("EX-2", R"({"source": "EX-1"})");
    add("EX-3", R"({"source": "EX-4"})");
    EXPECT_EQ(found({"STD-1", "2026-01-01", ""}), (std::set<std::string>{"EX-1", "EX-2"}));
}

/// A withdrawal takes the certificate back, and nothing of what others have calibrated with it.
TEST_F(ArchiveOfStandards, AreFoundThroughAWithdrawnCertificate) {
    add("G-1", R"({"source": "STD-017"})");
    add("G-2", R"({"source": "G-1"})");
    add("G-3", R"({"source": "G-2"})");
    add("G-4", "no record");
    add("G-5", R"({"source": "G-4"})");
    for (const char* const number : {"G-1", "G-2", "G-4"}) {
        (void)archive_.advance(number, "withdrawn", by("R. Reviewer"));
    }
    std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
    ASSERT_EQ(affected.size(), 2U);
    EXPECT_EQ(affected[0].certificate.number, "G-3");
    EXPECT_EQ(affected[0].through, "G-2");
    EXPECT_EQ(affected[0].through_state, "withdrawn");
    EXPECT_EQ(affected[1].certificate.number, "G-5");
    recalculate(affected, archive_, correction_to("{}"), 1);
    const std::string text = affected_text(affected);
    EXPECT_NE(text.find("through G-2, withdrawn: source"), std::string::npos) << text;
    EXPECT_EQ(json::parse(affected_json(affected, {}))["certificates"][0]["through_state"], "withdrawn");
    EXPECT_NE(affected_csv(affected).find(",withdrawn\n"), std::string::npos);
    EXPECT_NE(waits_for(affected[0]).find("which was withdrawn"), std::string::npos);
}

/// A number that was taken for an amendment may be meant for this one or for another: it is told, until it is used or withdrawn.
TEST_F(ArchiveOfStandards, TellNumbersThatWereTaken) {
    add("EX-1", R"({"source": "STD-017"})");
    add("EX-2", R"({"source": "STD-017"})");
    const auto told = [&] {
        std::string all;
        const std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
        const json list = json::parse(affected_json(affected, {}))["certificates"];
        for (const json& one : list) {
            all += one["number"].get<std::string>() + one["taken_numbers"].dump() + " ";
        }
        const bool is_told = affected_text(affected).find(
                                 "for an amendment of it, and not drafted: EX-1/A1, EX-1/A2;") != std::string::npos;
        return all + (is_told ? "in words, too, " : "") + affected[0].draft_number;
    };
    EXPECT_EQ(told(), "EX-1[] EX-2[] EX-1/A1");
    (void)archive_.take_amendment_number("EX-1", by("A. Author"));
    (void)archive_.take_amendment_number("EX-1", by("A. Author"));
    EXPECT_EQ(told(), R"(EX-1["EX-1/A1","EX-1/A2"] EX-2[] in words, too, EX-1/A3)");
    (void)archive_.advance("EX-1/A1", "withdrawn", by("R. Reviewer"));
    Draft draft = test::sample_draft("EX-1/A2");
    draft.amends = Draft::Amends{"EX-1", "amended", {{"text", "/title", "a", "b"}}};
    (void)archive_.draft(draft, by("A. Author"));
    EXPECT_EQ(told(), "EX-1[] EX-2[] EX-1/A3");
}

/// Two numbers that differ in a character that no name of a file has do not share a folder.
TEST_F(ArchiveOfStandards, HaveEachAFolderForItsDraft) {
    std::set<std::string> numbers;
    for (const char* const between : {"/", "_", ":", "\\", "-", "", "_1-"}) {
        for (const char* const after : {"1", "1/A1-2", "1_A1"}) {
            numbers.insert(std::string("N") + between + after);
        }
    }
    for (const std::string& number : numbers) {
        add(number, R"({"source": "STD-017"})");
    }
    std::set<std::string> folders;
    for (const AffectedCertificate& one : find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1)) {
        EXPECT_TRUE(folders.insert(one.draft_name).second) << one.draft_name;
        EXPECT_EQ(one.draft_name.find_first_of("/\\: "), std::string::npos) << one.draft_name;
    }
    EXPECT_EQ(folders.size(), numbers.size());
}

TEST_F(ArchiveOfStandards, AreCalculatedAgainAndRanked) {
    const std::filesystem::path folder = k_affected_tree / "examples" / "laboratory";
    const std::string record =
        reports::to_canonical_json(evaluation::evaluate_job(folder / "end_gauge.json", evaluation::CovarianceFile::none,
                                                            1, k_affected_tree / "templates")
                                       .record);
    add("EX-2026-0042", record);
    add("EX-2026-0042/A1", R"({"title": "a number that is taken"})", false);
    add("EX-9", R"({"results": {"source": "STD-017"}})");
    const std::string registered = evaluation::read_file(folder / "laboratory" / "standards" / "STD-017.json");
    const auto calculated = [&](const std::string& corrected) {
        std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
        recalculate(affected, archive_, correction_to(corrected), 2);
        return affected;
    };
    std::vector<AffectedCertificate> same = calculated(registered);
    ASSERT_EQ(same.size(), 2U);
    EXPECT_EQ(same[1].certificate.number, "EX-2026-0042");
    EXPECT_STREQ(same[1].recalculated->rerun.outcome(), "same");
    EXPECT_EQ(same[1].recalculated->shift, 0.0);
    EXPECT_EQ(same[1].draft_folder, "");
    EXPECT_EQ(same[0].recalculated->rerun.not_evaluated->code, "GC-ARCHIVE-0062");

    std::vector<AffectedCertificate> ended = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
    std::atomic<int> asked = 0;
    recalculate(
        ended, archive_,
        {.standard = "STD-017",
         .corrected = registered,
         .reason = "r",
         .templates = k_affected_tree / "templates",
         .watch = [&asked]() -> gum::Progress {
             ++asked;
             throw gum::StorageError(gum::Diagnostic{
                 .code = "GC-STORE-0024", .where = "--time-limit", .what = "used up", .rule = "", .action = ""});
         }},
        2);
    EXPECT_EQ(asked, 1) << "of each that is evaluated";
    ASSERT_EQ(ended.size(), 2U);
    EXPECT_EQ(ended[0].certificate.number, "EX-2026-0042");
    EXPECT_EQ(ended[0].recalculated->rerun.not_evaluated->what, "used up");
    EXPECT_NE(ended[1].recalculated->rerun.not_evaluated->what, "used up");
    EXPECT_TRUE(affected_text(ended).ends_with("\n2 certificates affected, 2 of which could not be calculated again\n"))
        << affected_text(ended);

    std::string corrected = registered;
    corrected.replace(corrected.find("50.000623"), 9, "50.001623");  // 1 µm: the gauge is out of its limits now
    const std::vector<AffectedCertificate> changed = calculated(corrected);
    ASSERT_EQ(changed.size(), 2U);
    const AffectedCertificate& first = changed[0];
    EXPECT_EQ(first.certificate.number, "EX-2026-0042");
    EXPECT_GT(first.recalculated->rerun.count(evaluation::ChangeKind::verdict), 0U);
    EXPECT_GT(first.recalculated->rerun.count(evaluation::ChangeKind::printed), 0U);
    EXPECT_GT(first.recalculated->shift, 1.0);
    EXPECT_EQ(first.draft_number, "EX-2026-0042/A2");
    const std::string all = affected_json(changed, {"STD-017", "2026-03-02", ""});
    EXPECT_EQ(json::parse(all)["certificates"][0]["outcome"], "verdict");
    EXPECT_EQ(json::parse(all)["certificates"][1]["outcome"], "cannot_say");
    EXPECT_EQ(all, affected_json(calculated(corrected), {"STD-017", "2026-03-02", ""}));
    EXPECT_EQ(affected_text(changed).find("draft"), std::string::npos) << "nobody has written one";
    EXPECT_EQ(json::parse(all)["certificates"][0]["draft"], "");
    EXPECT_NE(affected_csv(changed).find("\nEX-2026-0042,issued,2026-11-18,2026-11-19,,STD-017,verdict,"),
              std::string::npos);
}

/// What a certificate states outside of its annexes: its data, and the texts of its tables.
json stated_by(const reports::EvaluationRecord& record) {
    const json value = reports::to_json_value(record)["certificate"];
    json stated{{"data", value["data"]}, {"tables", json::array()}};
    const json tables = value["tables"].flatten();
    for (const auto& [pointer, leaf] : tables.items()) {
        if (leaf.is_string()) {
            stated["tables"].push_back(pointer + " " + leaf.get<std::string>());
        }
    }
    return stated;
}

/// Whatever the register corrects: there is a draft of a certificate that would be printed otherwise, and of no other one, for
/// an amendment that changes nothing is none.
TEST_F(ArchiveOfStandards, AreSameWhereTheyWouldStateTheSame) {
    const std::filesystem::path folder = folder_.file("laboratory");
    std::filesystem::copy(k_affected_tree / "examples" / "laboratory", folder,
                          std::filesystem::copy_options::recursive);
    const auto evaluated = [&] {
        return evaluation::evaluate_job(folder / "end_gauge.json", evaluation::CovarianceFile::none, 1,
                                        k_affected_tree / "templates")
            .record;
    };
    const reports::EvaluationRecord record = evaluated();
    add("EX-2026-0042", reports::to_canonical_json(record));
    add("EX-9", R"({"results": {"source": "STD-017"}})");
    const std::string registered = evaluation::read_file(folder / "laboratory" / "standards" / "STD-017.json");
    const json plain = json::parse(registered, nullptr, true, true);
    std::map<std::string, std::size_t> outcomes;
    std::vector<std::pair<std::string, json>> changes;
    const json leaves = plain.flatten();
    for (const auto& [pointer, value] : leaves.items()) {
        if (value.is_string()) {
            changes.emplace_back(pointer, value.get<std::string>() + "9");
        } else if (value.is_number() && pointer.ends_with("/value")) {
            for (const double relative : {2e-8, 1e-8, 2e-9}) {
                changes.emplace_back(pointer, value.get<double>() * (1.0 + relative));
            }
        } else if (value.is_number() && pointer.starts_with("/calibrations/3/")) {  // the one in use
            changes.emplace_back(pointer, value.get<double>() * 1.02);
        }
    }
    for (const auto& [pointer, value] : changes) {
        json changed = plain;
        changed[json::json_pointer(pointer)] = value;
        std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
        recalculate(affected, archive_, correction_to(changed.dump()), 1,
                    {.write = [](const std::vector<outputs::OutputFile>&) {}});
        const auto found = std::find_if(affected.begin(), affected.end(),
                                        [](const auto& one) { return one.certificate.number == "EX-2026-0042"; });
        ASSERT_NE(found, affected.end());
        const Recalculation& recalculation = *found->recalculated;
        const std::string outcome =
            json::parse(affected_json({*found}, {}))["certificates"][0]["outcome"].get<std::string>();
        if (recalculation.rerun.not_evaluated) {
            EXPECT_EQ(outcome, "cannot_say") << pointer;
            continue;
        }
        // The job evaluated anew, without the archive, is the oracle.
        std::ofstream(folder / "laboratory" / "standards" / "STD-017.json") << changed.dump();
        const json now = stated_by(evaluated());
        const json before = stated_by(record);
        EXPECT_EQ(found->draft_folder.empty(), now == before) << pointer << " " << value << " " << outcome;
        EXPECT_EQ(outcome == "printed", now["tables"] != before["tables"] && outcome != "verdict") << pointer;
        EXPECT_EQ(outcome == "same", now == before && outcome != "budget" && outcome != "verdict") << pointer;
        EXPECT_EQ(found->no_draft.empty(), now != before || outcome == "same") << pointer << " " << outcome;
        ++outcomes[outcome];
        if (outcome == "text") {
            EXPECT_EQ(affected[0].certificate.number, "EX-2026-0042") << "before what cannot be said";
            EXPECT_NE(affected_text(affected).find(recalculation.texts.front().place), std::string::npos) << pointer;
            EXPECT_EQ(json::parse(affected_json(affected, {}))["certificates"][0]["changes"].back()["kind"], "text");
        }
    }
    EXPECT_GE(outcomes["text"], 2U) << "certificate and issuer of the calibration in use";
    for (const char* const outcome : {"printed", "budget", "same"}) {
        EXPECT_GT(outcomes[outcome], 0U) << outcome;
    }
}

/// Of each certificate that changes there is a draft, or the list says why there is none.
TEST_F(ArchiveOfStandards, HaveADraftOrAReason) {
    const std::filesystem::path folder = folder_.file("laboratory");
    std::filesystem::copy(k_affected_tree / "examples" / "laboratory", folder,
                          std::filesystem::copy_options::recursive);
    json data = json::parse(evaluation::read_file(folder / "end_gauge_certificate.json"), nullptr, true, true);
    data["languages"] = {"en", "de"};
    std::ofstream(folder / "end_gauge_certificate.json") << data.dump();
    const std::string record =
        reports::to_canonical_json(evaluation::evaluate_job(folder / "end_gauge.json", evaluation::CovarianceFile::none,
                                                            1, k_affected_tree / "templates")
                                       .record);
    add("EX-2026-0042", record);
    add("EX-1", record, false);
    json corrected =
        json::parse(evaluation::read_file(folder / "laboratory" / "standards" / "STD-017.json"), nullptr, true, true);
    for (json& one : corrected["calibrations"]) {
        one["certificate"] = "another";
    }
    std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
    json changes;
    recalculate(affected, archive_, correction_to(corrected.dump()), 1,
                {.write = [&](const std::vector<outputs::OutputFile>& files) {
                    for (const outputs::OutputFile& file : files) {
                        const json read = json::parse(file.bytes, nullptr, false);
                        if (read.is_object() && read.contains("amendment")) {
                            changes = read["amendment"]["changes"];
                        }
                    }
                }});
    ASSERT_EQ(affected.size(), 2U);
    for (const AffectedCertificate& one : affected) {
        EXPECT_TRUE(one.recalculated->states_otherwise()) << one.certificate.number;
        EXPECT_NE(one.draft_folder.empty(), one.no_draft.empty()) << one.certificate.number;
        EXPECT_EQ(one.no_draft.empty(), one.certificate.state == "issued");
    }
    EXPECT_NE(affected_text(affected).find("no draft: it is drafted, and not issued"), std::string::npos);
    EXPECT_EQ(changes, json::parse(R"([{"en": "What is stated of the corrected standard STD-017",
                                        "de": "Angaben zum berichtigten Normal STD-017"}])"));
}

/// What a job states itself of a standard, and what rests on another certificate that is wrong, is not corrected with the register:
/// of a certificate that comes out the same nothing can be said then.
TEST_F(ArchiveOfStandards, AreNotTheSameWhereSomethingIsNotCorrected) {
    const std::filesystem::path folder = folder_.file("laboratory");
    std::filesystem::copy(k_affected_tree / "examples" / "laboratory", folder,
                          std::filesystem::copy_options::recursive);
    const auto add_record = [&](const std::string& number) {
        add(number, reports::to_canonical_json(evaluation::evaluate_job(folder / "end_gauge.json",
                                                                        evaluation::CovarianceFile::none, 1,
                                                                        k_affected_tree / "templates")
                                                   .record));
    };
    add_record("EX-1");
    add("EX-9", R"({"results": {"source": "STD-017"}})");
    std::string job = evaluation::read_file(folder / "end_gauge.json");
    job.replace(job.find("\"source\": \"CMP-02\""), 18, "\"source\": \"EX-9\"");
    std::ofstream(folder / "end_gauge.json") << job;
    add_record("EX-2");
    const auto calculated = [&](const std::string& standard, const std::string& corrected) {
        std::vector<AffectedCertificate> affected = find_affected(archive_, {standard, "2026-03-02", ""}, 1);
        recalculate(
            affected, archive_,
            {.standard = standard, .corrected = corrected, .reason = "r", .templates = k_affected_tree / "templates"},
            1);
        std::map<std::string, json> told;
        const json all = json::parse(affected_json(affected, {}));
        for (const json& one : all["certificates"]) {
            told[one["number"]] = one;
        }
        return told;
    };
    const auto registered = [&](const std::string& standard) {
        return evaluation::read_file(folder / "laboratory" / "standards" / (standard + ".json"));
    };
    std::map<std::string, json> told = calculated("STD-017", registered("STD-017"));
    EXPECT_EQ(told["EX-1"]["outcome"], "same");
    EXPECT_EQ(told["EX-2"]["outcome"], "cannot_say");
    EXPECT_EQ(told["EX-2"]["also_through"], "EX-9");
    EXPECT_NE(told["EX-2"]["cannot_say"].get<std::string>().find("EX-9, which is listed, too"), std::string::npos);
    told = calculated("CMP-02", registered("CMP-02"));
    EXPECT_EQ(told["EX-1"]["outcome"], "cannot_say");
    EXPECT_NE(told["EX-1"]["cannot_say"].get<std::string>().find("end_gauge.json#/inputs/d/components/1/source"),
              std::string::npos);
    std::string corrected = registered("CMP-02");
    corrected.replace(corrected.find("\"U\": 0.02"), 9, "\"U\": 0.05");
    told = calculated("CMP-02", corrected);
    EXPECT_EQ(told["EX-1"]["outcome"], "text") << "U in the row of traceability";
    EXPECT_EQ(told["EX-1"]["not_corrected"].size(), 2U);
}

/// What rests on others of the list comes out the same where they do, and nothing can be said of it where one of them does not, was
/// withdrawn, or cannot be judged.
TEST_F(ArchiveOfStandards, AreTheSameWhereAllOnWhichTheyRestAre) {
    const std::filesystem::path folder = folder_.file("laboratory");
    std::filesystem::copy(k_affected_tree / "examples" / "laboratory", folder,
                          std::filesystem::copy_options::recursive);
    const auto evaluated = [&](const char* job) {
        return reports::to_canonical_json(
            evaluation::evaluate_job(folder / job, evaluation::CovarianceFile::none, 1, k_affected_tree / "templates")
                .record);
    };
    add("EX-1", evaluated("end_gauge.json"));
    add("EX-9", R"({"results": {"source": "STD-017"}})");
    const std::string example = evaluation::read_file(folder / "end_gauge.json");
    const auto add_resting_on = [&](const std::string& number, const std::vector<std::string>& others,
                                    bool is_of_register = false) {
        std::string job = example;
        if (is_of_register) {
            job.replace(job.find("\"source\": \"CMP-02\""), 18, "\"source\": \"" + others.front() + "\"");
        } else {
            json budget{{"schema", "gumcert/job/1"}, {"kind", "budget"}, {"title", number}};
            budget["inputs"]["z"] = {{"value", 1.0}, {"u", 0.1}, {"unit", "um"}};
            std::string model = "y = z";
            for (std::size_t i = 0; i < others.size(); ++i) {
                const std::string name = "x_" + std::to_string(i);
                budget["inputs"][name] = {{"value", 1.0}, {"u", 0.1}, {"unit", "um"}, {"source", others[i]}};
                model += " + " + name;
            }
            budget["model"] = {model};
            job = budget.dump();
        }
        std::ofstream(folder / "resting.json") << job;
        add(number, evaluated("resting.json"));
    };
    add_resting_on("EX-2", {"EX-1"}, true);
    add_resting_on("T-1", {"EX-1"});
    add_resting_on("T-2", {"T-1", "EX-2"});
    add_resting_on("T-3", {"T-2", "EX-9"});
    add_resting_on("T-4", {"T-3", "T-2"});
    add_resting_on("T-5", {"EX-2", "NMI-2026-0117"});  // a certificate of the standard, by its number
    add_resting_on("W-1", {"EX-1"});
    add_resting_on("T-6", {"W-1"});
    add_resting_on("C-1", {"T-1", "C-2"});  // a circle
    add_resting_on("C-2", {"C-1"});
    add_resting_on("B-1", {"EX-2", "certificate NMI-2026-0117 of 2026-03-02"});
    add_resting_on("B-2", {"EX-2", "NMI 2026 0117"});
    add_resting_on("B-3", {"EX-2", "K-0815"});         // the serial number
    add_resting_on("B-4", {"EX-2", "NMI-2026-0171"});  // nobody knows what it is of
    for (const bool is_listed : {true, false}) {       // files of the job that the record does not hold
        reports::EvaluationRecord record =
            evaluation::evaluate_job(folder / "resting.json", evaluation::CovarianceFile::none, 1,
                                     k_affected_tree / "templates")
                .record;
        for (reports::InputFile& file : record.job_files) {
            file.content.reset();
        }
        if (!is_listed) {
            record.job_files.clear();
        }
        add(is_listed ? "B-5" : "B-6", reports::to_canonical_json(record));
    }
    (void)archive_.advance("W-1", "withdrawn", by("R. Reviewer"));
    const std::string registered = evaluation::read_file(folder / "laboratory" / "standards" / "STD-017.json");
    const auto outcomes = [&](const std::string& corrected) {
        std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
        recalculate(affected, archive_, correction_to(corrected), 1);
        std::map<std::string, std::string> told;
        const json all = json::parse(affected_json(affected, {}));
        for (const json& one : all["certificates"]) {
            told[one["number"]] = one["outcome"];
            EXPECT_EQ(one["outcome"] == "cannot_say", one["cannot_say"] != "") << one;
            const std::string& number = one["number"].get_ref<const std::string&>();
            EXPECT_EQ(one["shift"].is_null(), one["outcome"] == "cannot_say" || number.starts_with("T-")) << one;
        }
        return std::pair(told, affected_text(affected));
    };
    const std::map<std::string, std::string> same{{"EX-1", "same"},      {"EX-2", "same"},      {"EX-9", "cannot_say"},
                                                  {"T-1", "same"},       {"T-2", "same"},       {"T-3", "cannot_say"},
                                                  {"T-4", "cannot_say"}, {"T-5", "cannot_say"}, {"T-6", "cannot_say"},
                                                  {"C-1", "cannot_say"}, {"C-2", "cannot_say"}, {"B-1", "cannot_say"},
                                                  {"B-2", "cannot_say"}, {"B-3", "cannot_say"}, {"B-4", "cannot_say"},
                                                  {"B-5", "cannot_say"}, {"B-6", "cannot_say"}};
    const auto [told, text] = outcomes(registered);
    EXPECT_EQ(told, same);
    for (const char* const words :
         {"it rests on EX-1, which comes out the same", "and others, which come out the same",
          "it rests on W-1, which was withdrawn", "it rests on EX-9, which is listed, too",
          "states something of the standard itself: resting.json#/inputs/x_1/source",
          "\"NMI-2026-0171\", which may rest on the standard as well", "the record does not hold"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << text;
    }
    std::string corrected = registered;
    corrected.replace(corrected.find("50.000623"), 9, "50.000643");
    for (const auto& [number, outcome] : outcomes(corrected).first) {
        EXPECT_EQ(outcome, number == "EX-1" || number == "EX-2" ? "printed" : "cannot_say") << number;
    }
}

/// Names of files of a job are not those of its draft: the record of what it amends itself, a list of changes.
TEST_F(ArchiveOfStandards, HaveDraftsOfEachFileOnce) {
    const std::filesystem::path folder = folder_.file("laboratory");
    std::filesystem::copy(k_affected_tree / "examples" / "laboratory", folder,
                          std::filesystem::copy_options::recursive);
    const json data = json::parse(evaluation::read_file(folder / "end_gauge_certificate.json"), nullptr, true, true);
    const std::string job = evaluation::read_file(folder / "end_gauge.json");
    const auto add_record = [&](const std::string& number, const std::string& file_of_data, const json& amendment) {
        json changed = data;
        changed["number"] = number;
        if (!amendment.is_null()) {
            changed["amendment"] = amendment;
            changed["item"]["serial_number"] = "SN-1002";
        }
        std::ofstream(folder / file_of_data) << changed.dump();
        std::string with_data = job;
        with_data.replace(with_data.find("end_gauge_certificate.json"), 26, file_of_data);
        std::ofstream(folder / "end_gauge.json") << with_data;
        std::string record = reports::to_canonical_json(evaluation::evaluate_job(folder / "end_gauge.json",
                                                                                 evaluation::CovarianceFile::none, 1,
                                                                                 k_affected_tree / "templates")
                                                            .record);
        add(number, record);
        return record;
    };
    const std::string first = add_record("EX-1", "changes.json", json());
    std::ofstream(folder / "original_record.json") << first;
    (void)add_record("EX-2", "data.json",
                     {{"kind", "amended"},
                      {"number", "EX-1"},
                      {"reason", "The serial number was wrong."},
                      {"changes", {"serial number"}},
                      {"record", "original_record.json"}});
    std::filesystem::remove(folder / "original_record.json");
    (void)add_record("EX-3", "original_record.json", json());
    std::string corrected = evaluation::read_file(folder / "laboratory" / "standards" / "STD-017.json");
    corrected.replace(corrected.find("50.000623"), 9, "50.000643");
    std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
    std::size_t drafts = 0;
    recalculate(
        affected, archive_, correction_to(corrected), 1, {.write = [&](const std::vector<outputs::OutputFile>& files) {
            ++drafts;
            std::set<std::filesystem::path> places;
            for (const outputs::OutputFile& file : files) {
                EXPECT_TRUE(places.insert(file.path).second) << file.path;
                const json read = json::parse(file.bytes, nullptr, false);
                if (read.is_object() && read.value("schema", "") == "gumcert/archive-amendment-draft/1") {
                    EXPECT_EQ(file.path.filename(), "changes.json");
                    EXPECT_EQ(std::distance(file.path.begin(), file.path.end()), 2);
                }
                if (read.is_object() && read.contains("amendment")) {
                    const std::filesystem::path record =
                        file.path.parent_path() / read["amendment"]["record"].get<std::string>();
                    const auto of = std::ranges::find(files, record, &outputs::OutputFile::path);
                    ASSERT_NE(of, files.end());
                    EXPECT_EQ(json::parse(of->bytes)["certificate"]["data"]["number"], read["amendment"]["number"]);
                }
            }
        }});
    EXPECT_EQ(drafts, 3U);
}

/// Where an amendment was withdrawn nothing holds, and the original is amended once more: it has a draft as one that is issued, but
/// none that takes back what the withdrawn one had corrected, and none beside another one that is under way.
TEST_F(ArchiveOfStandards, HaveADraftWhereTheirAmendmentWasWithdrawn) {
    const std::string record = reports::to_canonical_json(
        evaluation::evaluate_job(k_affected_tree / "examples" / "laboratory" / "end_gauge.json",
                                 evaluation::CovarianceFile::none, 1, k_affected_tree / "templates")
            .record);
    json other = json::parse(record);
    other.erase("digest");
    other["certificate"]["data"]["item"]["serial_number"] = "SN-1002";
    const auto amend = [&](const std::string& original, const std::string& number, const std::string& with,
                           bool is_issued = true) {
        Draft amendment = test::sample_draft(number);
        amendment.record = with;
        amendment.amends = Draft::Amends{original, "amended", {{"text", "/title", "a", "b"}}};
        (void)archive_.draft(amendment, by("A. Author"));
        for (const char* const kind : {"reviewed", "authorised", "issued"}) {
            if (is_issued) {
                (void)archive_.advance(number, kind, by("R. Reviewer"));
            }
        }
    };
    const std::string unreadable = R"({"title": "another standard"})";
    for (const auto& [number, with] :
         {std::pair("EX-1", record), std::pair("EX-2", unreadable), std::pair("EX-3", other.dump()),
          std::pair("EX-4", unreadable), std::pair("EX-5", record)}) {
        add(number, record);
        amend(number, number + std::string("/A1"), with);
        if (std::string_view(number) != "EX-2") {
            (void)archive_.advance(number + std::string("/A1"), "withdrawn", by("R. Reviewer"));
        }
    }
    add("EX-6", record);
    amend("EX-5", "EX-5/A2", unreadable, false);
    amend("EX-6", "EX-6/A1", unreadable, false);
    json corrected = json::parse(evaluation::read_file(k_affected_tree / "examples" / "laboratory" / "laboratory" /
                                                       "standards" / "STD-017.json"),
                                 nullptr, true, true);
    for (json& one : corrected["calibrations"]) {
        one["certificate"] = "another";
    }
    std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
    recalculate(affected, archive_, correction_to(corrected.dump()), 1,
                {.write = [](const std::vector<outputs::OutputFile>&) {}});
    ASSERT_EQ(affected.size(), 6U);
    EXPECT_EQ(affected[0].certificate.state, "amended-by");
    EXPECT_EQ(affected[0].draft_folder, "EX-1_A2");
    EXPECT_EQ(affected[0].no_draft, "");
    const std::string told = affected_text(affected);
    for (const auto& [i, reason] :
         {std::pair(1U, "where what took its place changes, too"), std::pair(2U, "-> \"SN-1002\"; decide what holds"),
          std::pair(3U, "cannot be read from its record"), std::pair(4U, "EX-5/A2, which amends it, is not issued yet"),
          std::pair(5U, "EX-6/A1, which amends it, is not issued yet")}) {
        EXPECT_EQ(affected[i].draft_folder, "");
        EXPECT_NE(affected[i].no_draft.find(reason), std::string::npos) << affected[i].no_draft;
        EXPECT_NE(told.find(reason), std::string::npos) << told;
    }
    EXPECT_NE(told.find("EX-1/A1, which took its place, was withdrawn: amend it once more"), std::string::npos);
    EXPECT_NE(told.find("EX-5/A1, which took its place, was withdrawn\n"), std::string::npos);
    const json all = json::parse(affected_json(affected, {}))["certificates"];
    EXPECT_EQ(all[0]["withdrawn_amendment"], "EX-1/A1");
    EXPECT_EQ(all[4]["amendment_under_way"], "EX-5/A2");
}

/// What a newer version says otherwise whatever the standard is no effect of the correction, and no reason for a draft.
TEST_F(ArchiveOfStandards, TellNothingThatTheVersionAloneSaysOtherwise) {
    const std::filesystem::path folder = folder_.file("laboratory");
    std::filesystem::copy(k_affected_tree / "examples" / "laboratory", folder,
                          std::filesystem::copy_options::recursive);
    std::ofstream(folder / "b.json") << R"({"schema": "gumcert/job/1", "kind": "budget", "title": "b",
        "coverage_probability": 0.9545, "laboratory": "laboratory", "model": ["l = l_s*0.000244 + d"],
        "inputs": {"l_s": {"standard": "STD-017", "unit": "um", "date": "2026-11-18"},
                   "d": {"value": 0.11, "u": 0.1, "unit": "um"}}, "outputs": {"l": {"unit": "um"}}})";
    std::ofstream(folder / "comparison.json") << R"({"schema": "gumcert/job/1", "kind": "comparison", "title": "C",
        "unit": "um", "assigned_value": {"value": 12.2, "U": 0.1, "k": 2}, "artefact_stability": "no change",
        "certificate": {"number": "R-1", "laboratory": {"name": "Example Institute"}, "languages": ["en"],
                        "dates": {"issued": "2026-11-20"}},
        "participants": [{"id": "A", "budget": "b.json"}, {"id": "B", "value": 12.18, "u": 0.12},
                         {"id": "C", "value": 12.6, "U": 0.24, "k": 2.5}]})";
    const auto add_record = [&](const std::string& number, const char* job, const std::vector<const char*>& places) {
        json record = json::parse(reports::to_canonical_json(
            evaluation::evaluate_job(folder / job, evaluation::CovarianceFile::none, 1, k_affected_tree / "templates")
                .record));
        record.erase("digest");
        record["software"]["version"] = "0.0.1";
        for (const char* const place : places) {
            ASSERT_TRUE(record.contains(json::json_pointer(place))) << place;
            record[json::json_pointer(place)] = place == places.front() ? "of old" : "7";
        }
        add(number, record.dump());
    };
    add_record("EX-1", "end_gauge.json",
               {"/certificate/data/item/serial_number", "/certificate/tables/0/columns/0/values/0/printed_value"});
    add_record("R-1", "comparison.json", {"/comparison/remarks/0", "/comparison/participants/0/printed/max_abs_En"});
    const std::string registered = evaluation::read_file(folder / "laboratory" / "standards" / "STD-017.json");
    struct Told {
        json certificates;
        std::map<std::string, json> drafts;  // their lists of changes
    };
    const auto told = [&](const std::string& from, const std::string& to) {
        std::string corrected = registered;
        for (std::size_t at = corrected.find(from); at != std::string::npos;
             at = corrected.find(from, at + to.size())) {
            corrected.replace(at, from.size(), to);
        }
        std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
        Told all;
        recalculate(affected, archive_, correction_to(corrected), 1,
                    {.write = [&](const std::vector<outputs::OutputFile>& files) {
                        for (const outputs::OutputFile& file : files) {
                            if (file.path.filename() == "changes.json") {
                                const json read = json::parse(file.bytes);
                                all.drafts[read["amends"]] = read;
                            }
                        }
                    }});
        std::sort(affected.begin(), affected.end(),
                  [](const auto& a, const auto& b) { return a.certificate.number < b.certificate.number; });
        all.certificates = json::parse(affected_json(affected, {}))["certificates"];
        EXPECT_NE(affected_text(affected).find("another version of gumcert made it"), std::string::npos);
        return all;
    };
    const Told same = told("50.000623", "50.000623");
    ASSERT_EQ(same.certificates.size(), 2U);
    for (const json& one : same.certificates) {
        EXPECT_EQ(one["outcome"], "same") << one;
        EXPECT_EQ(one["shift"], 0.0);
        EXPECT_EQ(one["changes"], json::array());
        EXPECT_NE(one["version_in_words"], "");
    }
    EXPECT_TRUE(same.drafts.empty());
    Told changed = told("50.000623", "50.900623");
    EXPECT_EQ(changed.certificates[0]["outcome"], "verdict");
    EXPECT_EQ(changed.certificates[1]["outcome"], "printed");
    for (const char* const number : {"EX-1", "R-1"}) {
        EXPECT_FALSE(changed.drafts[number]["changes"].empty()) << number;
        EXPECT_EQ(changed.drafts[number]["changes"].dump().find("of old"), std::string::npos) << number;
        EXPECT_NE(changed.drafts[number]["changes_of_version"].dump().find("of old"), std::string::npos) << number;
    }
    const Told text = told("NMI-2026-0117", "NMI-2026-0118");
    EXPECT_EQ(text.certificates[0]["outcome"], "text") << "and no digit, which the version alone changes";
    EXPECT_EQ(text.certificates[0]["changes"].size(), 1U);
}

/// A result that rests on more than the standard is moved by less of its own U than the standard by its.
TEST_F(ArchiveOfStandards, AreRankedByWhatTheCertificateStates) {
    const std::filesystem::path folder = folder_.file("laboratory");
    std::filesystem::copy(k_affected_tree / "examples" / "laboratory", folder,
                          std::filesystem::copy_options::recursive);
    const std::string job = evaluation::read_file(folder / "end_gauge.json");
    const auto record_with = [&](const char* u) {
        std::string text = job;
        text.replace(text.find("\"u\": 5.8"), 8, std::string("\"u\": ") + u);
        std::ofstream(folder / "end_gauge.json") << text;
        return evaluation::evaluate_job(folder / "end_gauge.json", evaluation::CovarianceFile::none, 1,
                                        k_affected_tree / "templates")
            .record;
    };
    std::map<std::string, double> U;
    for (const auto& [number, u] : {std::pair("R-1", "320"), std::pair("R-2", "5.8")}) {
        const std::optional<reports::EvaluationRecord> record = record_with(u);
        U[number] = *record->certificate->tables.at(0).columns.at(0).values.at(0).U;
        add(number, reports::to_canonical_json(*record));
    }
    ASSERT_GT(U["R-1"], 5 * U["R-2"]);
    std::string corrected = evaluation::read_file(folder / "laboratory" / "standards" / "STD-017.json");
    corrected.replace(corrected.find("50.000623"), 9, "50.000643");  // 20 nm
    std::vector<AffectedCertificate> affected = find_affected(archive_, {"STD-017", "2026-03-02", ""}, 1);
    recalculate(affected, archive_, correction_to(corrected), 1);
    ASSERT_EQ(affected.size(), 2U);
    EXPECT_EQ(affected[0].certificate.number, "R-2");
    for (const AffectedCertificate& one : affected) {
        // The standard drifts: between its calibrations a part of the 20 nm counts, the same for both.
        EXPECT_NEAR(one.recalculated->shift * U[one.certificate.number], affected[0].recalculated->shift * U["R-2"],
                    0.5)
            << one.certificate.number;
        EXPECT_LT(one.recalculated->shift * U[one.certificate.number], 20.5);
    }
}

/// A standard is found by its letters: what only looks like its name is told, and so is a name that nothing has.
TEST_F(ArchiveOfStandards, AreToldWhereTheirNamesOnlyLookAlike) {
    add("EX-1", R"({"source": "STD-017"})");
    add("EX-2", R"({"source": "std-017, certificate 12"})");
    add("EX-3", R"({"source": "STD\u2011017"})");
    add("EX-4", R"({"source": "STD-0171, and STD-117"})");
    const auto remarks = [&](const std::string& name) {
        std::vector<gum::Diagnostic> told;
        (void)find_affected(archive_, {name, "2026-01-01", ""}, 1, {}, &told);
        std::string all;
        for (const gum::Diagnostic& one : told) {
            EXPECT_EQ(one.code, "GC-ARCHIVE-0064");
            all += one.what + '\n';
        }
        return all;
    };
    const std::string alike = remarks("STD-017");
    EXPECT_NE(alike.find("\"std-017, certificate 12\""), std::string::npos) << alike;
    EXPECT_NE(alike.find("\"STD\u2011017\""), std::string::npos) << alike;
    EXPECT_EQ(alike.find("STD-0171"), std::string::npos) << alike;
    EXPECT_EQ(alike.find("no record names it"), std::string::npos) << alike;
    EXPECT_EQ(remarks("STD-999"), "no record names it\n");
    EXPECT_EQ(remarks("STD-0171"), "");
}

TEST_F(ArchiveOfStandards, GiveTheSameDraftsWithAnyNumberOfThreads) {
    const std::filesystem::path folder = k_affected_tree / "examples" / "laboratory";
    const std::string record =
        reports::to_canonical_json(evaluation::evaluate_job(folder / "end_gauge.json", evaluation::CovarianceFile::none,
                                                            1, k_affected_tree / "templates")
                                       .record);
    constexpr int k_certificates = 300;  // more than are read at once
    std::set<std::string> expected;
    for (int i = 0; i < k_certificates; ++i) {
        const std::string number = "EX-" + std::to_string(i);
        const bool is_evaluated = i % 7 == 0;
        const bool is_issued = is_evaluated && i % 3 > 0;
        add(number,
            is_evaluated ? record + std::string(static_cast<std::size_t>(i), '\n')
                         : R"({"source": "STD-017", "title": ")" + number + R"("})",
            is_issued);
        if (is_issued) {
            expected.insert(number + "_A1");
        }
    }
    std::string corrected = evaluation::read_file(folder / "laboratory" / "standards" / "STD-017.json");
    corrected.replace(corrected.find("50.000623"), 9, "50.001623");
    const WrongStandard wrong{"STD-017", "2026-03-02", ""};
    const Correction correction{
        .standard = "STD-017", .corrected = corrected, .reason = "r", .templates = k_affected_tree / "templates"};
    struct Drafted {
        std::map<std::filesystem::path, std::string> files;
        std::set<std::string> folders;
        std::string report;
        std::vector<AffectedCertificate> affected;
    };
    const auto drafted = [&](unsigned threads, std::vector<AffectedCertificate> affected) {
        Drafted all;
        std::mutex mutex;
        std::size_t unfinished = 0;
        recalculate(affected, archive_, correction, threads,
                    {.write =
                         [&](const std::vector<outputs::OutputFile>& draft) {
                             const std::lock_guard lock(mutex);
                             ++unfinished;
                             all.folders.insert(draft.front().path.begin()->string());
                             for (const outputs::OutputFile& file : draft) {
                                 EXPECT_TRUE(all.files.emplace(file.path, file.bytes).second) << file.path;
                             }
                         },
                     .finish = [&] { unfinished = 0; }});
        EXPECT_EQ(unfinished, 0U);
        all.report = affected_json(affected, wrong);
        all.affected = std::move(affected);
        return all;
    };
    const Drafted one = drafted(1, find_affected(archive_, wrong, 1));
    const Drafted several = drafted(4, find_affected(archive_, wrong, 4));
    EXPECT_EQ(one.folders, expected);
    EXPECT_EQ(several.files, one.files);
    EXPECT_EQ(several.report, one.report);
    // What another machine has calculated is drafted alike.
    std::vector<AffectedCertificate> calculated = one.affected;
    for (AffectedCertificate& certificate : calculated) {
        certificate.draft_folder = "";
    }
    const Drafted later = drafted(2, std::move(calculated));
    EXPECT_EQ(later.files, one.files);
    EXPECT_EQ(later.report, one.report);
}

}  // namespace
}  // namespace gumcert::archive
