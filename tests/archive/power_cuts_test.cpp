// Simulated power cuts: what was acknowledged is there, whatever part of the rest had reached the disk.
//
//   GUMCERT_POWER_CUTS=N GUMCERT_POWER_CUT_SEED=S test_archive --gtest_filter='PowerCuts.*'
//
// kill -9 (crash_test.py) does not test the disk: what the system has taken survives it. Here calls of SQLite are recorded
// while an archive is written, the disk is made anew as it may be behind any of them, and the archive on it is opened.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <random>

#include "archive/archive.h"
#include "archive/store/open_store.h"
#include "archive/verification.h"
#include "gum/quantity/diagnostic.h"
#include "tests/archive/power_cut.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using Ask = std::function<Written(Archive&)>;

enum class Disk { as_it_should_be, whose_syncs_fail, that_lies, without_sync, with_sync_at_checkpoints };

struct Tally {
    long cuts = 0;
    long acknowledged = 0;  // entries that had been told at the cut, of all cuts
    long lost = 0;          // of those
    long damaged = 0;       // archives that cannot be opened, or are not sound
    long ahead = 0;         // archives with an entry that had not been told yet
    std::string first_fault;
};

/// What SQLite opens, and how often it moves pages from its log into the file.
sqlite3* g_opened = nullptr;
int g_frames_between_checkpoints = 1000;

int see_opened(sqlite3* database, char** /*message*/, const sqlite3_api_routines* /*routines*/) {
    g_opened = database;
    (void)sqlite3_wal_autocheckpoint(database, g_frames_between_checkpoints);
    return SQLITE_OK;
}

class OpenedDatabases {
public:
    OpenedDatabases() { (void)sqlite3_auto_extension(as_entry()); }
    ~OpenedDatabases() { (void)sqlite3_cancel_auto_extension(as_entry()); }
    OpenedDatabases(const OpenedDatabases&) = delete;
    OpenedDatabases& operator=(const OpenedDatabases&) = delete;

private:
    static void (*as_entry())() { return reinterpret_cast<void (*)()>(&see_opened); }  // NOLINT: as SQLite declares it
};

class PowerCutTrial {
public:
    PowerCutTrial(std::uint64_t seed, Disk kind) : random_(seed), seed_(seed), kind_(kind) {
        disk_.lie_about_sync(kind == Disk::that_lies);
    }

    Tally run(long cuts) {
        constexpr int k_lives_of_an_archive = 8;
        constexpr int k_cuts_of_a_life = 25;
        for (life_ = 0; tally_.cuts < cuts; ++life_) {
            if (life_ % k_lives_of_an_archive == 0) {
                before_.clear();
                in_flight_ = nullptr;
            }
            live();
            DiskImage next;
            std::size_t end = 0;
            for (int i = 0; i < k_cuts_of_a_life && tally_.cuts < cuts; ++i) {
                end = chance(calls_.size() + 1);
                next = test::image_after_power_cut(before_, calls_, end, random_);
                judge(next, end);
            }
            go_on_from(next, end);
        }
        return tally_;
    }

private:
    struct Told {
        std::size_t calls;  // before it was told
        LogEntry last;
    };
    struct ToldCopy {
        std::size_t calls;
        std::string file;
        LogEntry last;
    };

    test::StoreFolder folder_;
    test::ObservedDisk disk_;
    OpenedDatabases opened_;
    std::mt19937_64 random_;
    std::uint64_t seed_;
    Disk kind_;
    Tally tally_;
    int life_ = 0;
    test::DiskImage before_;
    std::vector<test::DiskCall> calls_;
    std::vector<Told> told_;
    std::vector<ToldCopy> copies_;
    std::vector<Ask> asked_;     // those of told_, and one more
    std::vector<LogEntry> log_;  // at the end of the life
    std::unique_ptr<Store> store_;
    Ask in_flight_;      // when the power ended
    bool kept_ = false;  // and it is there
    std::string now_;    // time of all entries

    using DiskImage = test::DiskImage;

    std::size_t chance(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
    [[nodiscard]] std::filesystem::path at_work(const std::string& name = "a.archive") const {
        return folder_.file("work") / name;
    }

    void live() {
        test::write_image(before_, folder_.file("work"), random_);
        calls_.clear();
        told_.clear();
        copies_.clear();
        asked_.clear();
        constexpr std::array<int, 3> k_frames = {1000, 5, 25};
        g_frames_between_checkpoints = k_frames.at(chance(k_frames.size()));
        disk_.record(&calls_);
        open();
        // What an archive had at the beginning is there while it is opened, too; a new one is told when it is begun.
        told_.push_back({before_.empty() ? calls_.size() : 0, *store_->last_entry()});
        if (in_flight_) {
            const Written again = ask(in_flight_);
            if (again.repeated != kept_) {
                fault("asked again with its key, a request that was " + std::string(kept_ ? "kept" : "lost") + " is " +
                      (again.repeated ? "known" : "carried out"));
            }
        }
        if (kind_ == Disk::whose_syncs_fail) {
            disk_.fail(test::DiskFault{.call = test::DiskFault::Call::sync, .at = 1 + static_cast<long>(chance(20))});
        }
        for (std::size_t i = 0; i <= chance(3); ++i) {
            issue("L" + std::to_string(life_) + "-" + std::to_string(i));
        }
        disk_.fail(std::nullopt);
        log_.clear();
        store_->each_entry([&](const LogEntry& entry) { log_.push_back(entry); });
        store_.reset();
        disk_.record(nullptr);
    }

    void open() {
        if (std::filesystem::exists(at_work())) {
            store_ = open_store(at_work().string(), Access::read_and_write);
        } else {
            const LogEntry first =
                first_entry({}, "gumcert of the tests", std::to_string(random_()), by("K. Keeper", ""));
            store_ = create_store(at_work().string(), first);
        }
        weaken(g_opened);
    }

    /// The store demands synchronous = FULL; here it is taken away again.
    void weaken(sqlite3* database) const {
        if (kind_ == Disk::without_sync) {
            (void)sqlite3_exec(database, "PRAGMA synchronous = OFF", nullptr, nullptr, nullptr);
        } else if (kind_ == Disk::with_sync_at_checkpoints) {
            (void)sqlite3_exec(database, "PRAGMA synchronous = NORMAL", nullptr, nullptr, nullptr);
        }
    }

    void tell() { told_.push_back({calls_.size(), *store_->last_entry()}); }

    [[nodiscard]] static Request by(const std::string& actor, const std::string& key) {
        return {.actor = actor, .at = "2026-11-27T12:00:00Z", .request_key = key, .why = "a digit was wrong"};
    }

    /// Whatever the disk refuses is asked for once more.
    template <class Work>
    auto persist(const Work& work) {
        try {
            return work();
        } catch (const gum::StorageError&) {
            if (kind_ != Disk::whose_syncs_fail) {
                throw;
            }
            return work();
        }
    }

    Written ask(const Ask& request) {
        asked_.push_back(request);
        Archive archive(*store_);
        const Written written = persist([&] { return request(archive); });
        tell();
        return written;
    }

    void issue(const std::string& number) {
        Draft draft = test::sample_draft(number);
        draft.documents[0].bytes += std::string(chance(12000), 'x');
        live_of(draft);
        if (chance(2) == 0) {
            Draft amendment = test::sample_draft(number + "/A1");
            amendment.amends =
                Draft::Amends{.number = number, .kind = "replaced", .changes = {{"U", "l", "0.1", "0.2"}}};
            live_of(amendment);
        }
    }

    void live_of(const Draft& draft) {
        (void)ask([draft](Archive& archive) { return archive.draft(draft, by("A. Author", draft.number)); });
        for (const char* const kind : {"reviewed", "authorised", "issued"}) {
            meanwhile();
            (void)ask([number = draft.number, kind](Archive& archive) {
                return archive.advance(number, kind, by("R. Reviewer", number + kind));
            });
        }
    }

    /// What else happens to an archive.
    void meanwhile() {
        switch (chance(12)) {
            case 0:  // the program ends, and begins again
                store_.reset();
                persist([&] { open(); });
                break;
            case 1:  // another program moves pages into the file
                checkpoint();
                break;
            case 2: {
                const std::string name = "copy-" + std::to_string(life_) + "-" + std::to_string(copies_.size());
                if (kind_ == Disk::as_it_should_be) {
                    store_->copy_to(at_work(name));
                    copies_.push_back({calls_.size(), name, *store_->last_entry()});
                }
                break;
            }
            default:
                break;
        }
    }

    void checkpoint() {
        constexpr std::array<const char*, 4> k_ways = {"PASSIVE", "FULL", "RESTART", "TRUNCATE"};
        sqlite3* other = nullptr;
        (void)sqlite3_open(at_work().c_str(), &other);
        weaken(other);
        const std::string way = std::string("PRAGMA wal_checkpoint(") + k_ways.at(chance(k_ways.size())) + ")";
        (void)sqlite3_exec(other, way.c_str(), nullptr, nullptr, nullptr);
        (void)sqlite3_close(other);
    }

    void fault(const std::string& what) {
        ++tally_.damaged;
        if (tally_.first_fault.empty()) {
            tally_.first_fault = "seed " + std::to_string(seed_) + ", life " + std::to_string(life_) + ", cut " +
                                 std::to_string(tally_.cuts) + ": " + what;
        }
    }

    [[nodiscard]] std::size_t number_told(std::size_t end) const {
        std::size_t number = 0;
        while (number < told_.size() && told_[number].calls <= end) {
            ++number;
        }
        return number;
    }

    /// Entries of an archive that is found; none where it is not sound, and that is noted.
    std::vector<LogEntry> sound_log(const std::filesystem::path& file, Access access) {
        std::vector<LogEntry> log;
        const auto store = open_store(file.string(), access);
        const Verification verification = verify_store(*store);
        if (!verification.sound()) {
            const gum::Diagnostic& found = verification.findings.front();
            fault(file.filename().string() + ": " + found.code + " " + found.where + " " + found.what);
            return log;
        }
        store->each_entry([&](const LogEntry& entry) { log.push_back(entry); });
        return log;
    }

    void judge(const DiskImage& image, std::size_t end) {
        ++tally_.cuts;
        const std::filesystem::path place = folder_.file("found");
        test::write_image(image, place, random_);
        const std::size_t number = number_told(end);
        try {
            judge_log(sound_log(place / "a.archive", chance(2) == 0 ? Access::read_only : Access::read_and_write),
                      number);
        } catch (const gum::DiagnosedError& error) {
            if (number > 0) {  // else an archive was not begun
                const gum::Diagnostic& found = error.diagnostics().front();
                tally_.acknowledged += told_[number - 1].last.seq;
                tally_.lost += told_[number - 1].last.seq;
                fault(found.code + " " + found.what);
            }
        }
        for (const ToldCopy& copy : copies_) {
            if (copy.calls <= end) {
                judge_copy(place, copy);
            }
        }
    }

    void judge_log(const std::vector<LogEntry>& log, std::size_t number) {
        const std::size_t told = number == 0 ? 0 : static_cast<std::size_t>(told_[number - 1].last.seq);
        tally_.acknowledged += static_cast<long>(told);
        if (log.size() < told) {
            tally_.lost += static_cast<long>(told - log.size());
            fault(std::to_string(told) + " entries were told, and " + std::to_string(log.size()) + " are there");
            return;
        }
        if (told > 0 && log[told - 1] != told_[number - 1].last) {
            ++tally_.lost;
            fault("entry " + std::to_string(told) + " is another one");
        }
        const std::size_t next = number < told_.size() ? static_cast<std::size_t>(told_[number].last.seq) : told;
        if (log.size() != told && log.size() != next) {
            fault(std::to_string(log.size()) + " entries are there, neither " + std::to_string(told) + " nor " +
                  std::to_string(next));
        }
        if (!std::equal(log.begin(), log.end(), log_.begin(), log_.begin() + static_cast<std::ptrdiff_t>(log.size()))) {
            fault("the log is not the one that was written");
        }
        tally_.ahead += log.size() > told ? 1 : 0;
        kept_ = log.size() > told;
    }

    void judge_copy(const std::filesystem::path& place, const ToldCopy& copy) {
        try {
            const std::vector<LogEntry> log = sound_log(place / copy.file, Access::read_only);
            if (log.empty() || log.back() != copy.last) {
                fault(copy.file + " is not what was copied");
            }
        } catch (const gum::DiagnosedError& error) {
            fault(copy.file + ": " + error.diagnostics().front().code + " " + error.diagnostics().front().what);
        }
    }

    /// The next life begins with what the last cut left.
    void go_on_from(const DiskImage& image, std::size_t end) {
        const std::size_t number = number_told(end);
        const bool sound = number > 0 && (kind_ == Disk::as_it_should_be || kind_ == Disk::whose_syncs_fail);
        before_ = sound ? image : DiskImage{};
        for (auto file = before_.begin(); file != before_.end();) {
            file = file->first.starts_with("copy-") ? before_.erase(file) : std::next(file);
        }
        // told_[0] is the opening; asked_[i] is told by told_[i + 1].
        in_flight_ = sound && number - 1 < asked_.size() ? asked_[number - 1] : nullptr;
    }
};

long number_in(const char* variable, long otherwise) {
    const char* const text = std::getenv(variable);
    return text == nullptr ? otherwise : std::strtol(text, nullptr, 10);
}

Tally cut_power(Disk kind, long cuts) {
    const auto seed = static_cast<std::uint64_t>(number_in("GUMCERT_POWER_CUT_SEED", 1));
    const Tally tally = PowerCutTrial(seed, kind).run(cuts);
    std::cout << "seed " << seed << ": " << tally.cuts << " power cuts, " << tally.acknowledged
              << " entries acknowledged, " << tally.lost << " lost, " << tally.damaged << " faults, " << tally.ahead
              << " archives ahead\n";
    return tally;
}

TEST(PowerCuts, LoseNothingThatWasAcknowledged) {
    const Tally tally = cut_power(Disk::as_it_should_be, number_in("GUMCERT_POWER_CUTS", 2000));
    EXPECT_EQ(tally.lost, 0);
    EXPECT_EQ(tally.damaged, 0) << tally.first_fault;
    EXPECT_GT(tally.ahead, 0);
}

/// A sync that fails may have lost what it was to bring, whatever the next one says.
TEST(PowerCuts, LoseNothingBehindASyncThatFailed) {
    const Tally tally = cut_power(Disk::whose_syncs_fail, number_in("GUMCERT_POWER_CUTS", 2000) / 8);
    EXPECT_EQ(tally.lost, 0);
    EXPECT_EQ(tally.damaged, 0) << tally.first_fault;
}

/// That the trial finds what it looks for: a store that does not synchronise loses entries and is damaged, one that does
/// at checkpoints only loses the last ones.
TEST(PowerCuts, AreNoticedWhereNothingIsSynchronised) {
    for (const Disk kind : {Disk::without_sync, Disk::that_lies}) {
        const Tally tally = cut_power(kind, 100);
        EXPECT_GT(tally.lost, 100);
        EXPECT_GT(tally.damaged, 10);
    }
    EXPECT_GT(cut_power(Disk::with_sync_at_checkpoints, 100).lost, 10);
}

}  // namespace
}  // namespace gumcert::archive
