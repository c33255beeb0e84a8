// Each call of the store on its disk fails in turn, with a full disk or with an error: nothing that was acknowledged is lost,
// no sound archive is called damaged, and the archive is used on when the trouble is over.
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <memory>
#include <vector>

#include "archive/archive.h"
#include "archive/store/open_store.h"
#include "archive/verification.h"
#include "gum/quantity/diagnostic.h"
#include "tests/archive/observed_disk.h"
#include "tests/archive/power_cut.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using test::DiskFault;
using Call = DiskFault::Call;

Request asked_with(const std::string& key) {
    return {.actor = key.find("drafted") == 0 ? "A. Author" : "R. Reviewer",
            .at = "2026-11-27T12:00:00Z",
            .request_key = key,
            .why = ""};
}

/// The life of a certificate, one request after the other.
std::vector<std::function<Written(Archive&)>> requests_for(const std::string& number) {
    std::vector<std::function<Written(Archive&)>> requests;
    requests.emplace_back([number](Archive& archive) {
        Draft draft = test::sample_draft(number);
        draft.documents[0].bytes += std::string(9000, 'x');
        return archive.draft(draft, asked_with("drafted " + number));
    });
    for (const char* const kind : {"reviewed", "authorised", "issued"}) {
        requests.emplace_back([number, kind](Archive& archive) {
            return archive.advance(number, kind, asked_with(kind + (" " + number)));
        });
    }
    return requests;
}

class DiskFaults : public testing::Test {
protected:
    test::StoreFolder folder_;
    test::ObservedDisk disk_;
    std::mt19937_64 random_{1};
    test::DiskImage sound_;  // an archive with two certificates
    std::unique_ptr<Store> store_;
    std::vector<LogEntry> told_before_, told_;  // entries: of sound_, and all
    Call failing_ = Call::write;
    int runs_ = 0, refused_ = 0;

    void SetUp() override {
        std::filesystem::create_directory(place());
        const auto store = begin(file());
        Archive archive(*store);
        for (const char* const number : {"B-1", "B-2"}) {
            for (const auto& request : requests_for(number)) {
                told_before_.push_back(request(archive).entry);
            }
        }
        store->copy_to(place() / "copy");
        sound_["a.archive"] = test::read_image(place()).at("copy");
    }
    void TearDown() override { std::cout << runs_ << " runs, " << refused_ << " refusals\n"; }

    [[nodiscard]] std::filesystem::path place() const { return folder_.file("work"); }
    [[nodiscard]] std::string file() const { return (place() / "a.archive").string(); }
    static std::unique_ptr<Store> begin(const std::string& file) {
        return create_store(file, first_entry({}, "gumcert of the tests", "nonce", asked_with("begin")));
    }

    /// Does some work with each call of a kind failing in turn, once and from there on, until there is none left.
    /// \param afterwards  what is done when the trouble is over
    void with_each_fault(Call call, bool full, const std::function<void()>& work,
                         const std::function<void()>& afterwards) {
        failing_ = call;
        for (const bool stays : {false, true}) {
            bool met = true;
            for (long at = 1; met && !HasFailure(); ++at) {
                SCOPED_TRACE("call " + std::to_string(at) + (stays ? " and all behind it" : ""));
                test::write_image(sound_, place(), random_);
                told_ = told_before_;
                disk_.fail(DiskFault{.call = call, .at = at, .stays = stays, .full = full});
                work();
                met = disk_.has_failed();
                disk_.fail(std::nullopt);
                afterwards();
                store_.reset();
                ++runs_;
            }
        }
    }

    /// Whether some work is done; else it was refused with the code that fits.
    bool is_done(bool full, const std::function<void()>& work) {
        try {
            work();
            return true;
        } catch (const gum::DiagnosedError& error) {
            const gum::Diagnostic& found = error.diagnostics().front();
            // Of a sync that COMMIT needs, SQLite forgets why it failed.
            EXPECT_TRUE(found.code == (full ? "GC-ARCHIVE-0005" : "GC-ARCHIVE-0008") ||
                        (found.code == "GC-ARCHIVE-0008" && failing_ == Call::sync))
                << found.code << ' ' << found.what;
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
        ++refused_;
        return false;
    }

    void ask(const std::function<Written(Archive&)>& request) {
        Archive archive(*store_);
        told_.push_back(request(archive).entry);
    }

    void write_with_each_fault(Call call, bool full) {
        const auto requests = requests_for("N-1");
        std::size_t next = 0;
        const auto work = [&] {
            next = 0;
            for (const std::size_t end : {std::size_t{2}, requests.size()}) {  // two programs, one after the other
                store_.reset();
                if (is_done(full, [&] { store_ = open_store(file(), Access::read_and_write); })) {
                    while (next < end && is_done(full, [&] { ask(requests[next]); })) {
                        ++next;
                    }
                }
            }
        };
        const auto afterwards = [&] {
            if (!store_) {
                store_ = open_store(file(), Access::read_and_write);
            }
            for (; next < requests.size(); ++next) {
                ask(requests[next]);
            }
            store_.reset();
            expect_all_told();
        };
        with_each_fault(call, full, work, afterwards);
    }

    /// Everything that was told is in a sound archive, and nothing else but its first entry.
    void expect_all_told() const {
        const auto found = open_store(file(), Access::read_only);
        const Verification verification = verify_store(*found);
        EXPECT_TRUE(verification.sound()) << verification.findings.front().what;
        std::vector<LogEntry> log;
        found->each_entry([&](const LogEntry& entry) { log.push_back(entry); });
        ASSERT_EQ(log.size(), 1 + told_.size());
        EXPECT_TRUE(std::equal(told_.begin(), told_.end(), log.begin() + 1));
    }
};

constexpr bool k_full = true;
constexpr bool k_error = false;

TEST_F(DiskFaults, AFullDiskLosesNothing) {
    for (const Call call : {Call::write, Call::sync, Call::truncate, Call::open, Call::share}) {
        SCOPED_TRACE(static_cast<int>(call));
        write_with_each_fault(call, k_full);
    }
    EXPECT_GT(refused_, 20);
}

TEST_F(DiskFaults, ADiskWithErrorsLosesNothing) {
    for (const Call call :
         {Call::read, Call::write, Call::sync, Call::truncate, Call::open, Call::remove, Call::share}) {
        SCOPED_TRACE(static_cast<int>(call));
        write_with_each_fault(call, k_error);
    }
    EXPECT_GT(refused_, 20);
}

/// What cannot be read says nothing about what is there.
TEST_F(DiskFaults, ErrorsAreNoDamage) {
    const auto work = [&] {
        (void)is_done(k_error, [&] {
            const auto store = open_store(file(), Access::read_only);
            const Verification verification = verify_store(*store);
            EXPECT_TRUE(verification.sound()) << verification.findings.front().what;
        });
    };
    with_each_fault(Call::read, k_error, work, [&] { expect_all_told(); });
    EXPECT_GT(refused_, 10);
}

TEST_F(DiskFaults, ACopyIsWholeOrRefused) {
    for (const bool full : {k_full, k_error}) {
        for (const Call call : {Call::write, Call::sync, Call::open}) {
            const std::string copy = (place() / "copy").string();
            bool copied = false;
            const auto work = [&] {
                copied = is_done(full, [&] { open_store(file(), Access::read_only)->copy_to(copy); });
            };
            const auto afterwards = [&] {
                EXPECT_TRUE(!copied || verify_store(*open_store(copy, Access::read_only)).sound());
                expect_all_told();
            };
            with_each_fault(call, full, work, afterwards);
        }
    }
}

/// An archive that could not be begun is begun in the same place when there is space.
TEST_F(DiskFaults, AnArchiveIsBegunOrRefused) {
    sound_.clear();
    told_before_.clear();
    for (const bool full : {k_full, k_error}) {
        for (const Call call : {Call::write, Call::sync, Call::open, Call::share}) {
            bool begun = false;
            const auto work = [&] { begun = is_done(full, [&] { store_ = begin(file()); }); };
            const auto afterwards = [&] {
                if (!begun) {
                    store_ = begin(file());
                }
                expect_all_told();
            };
            with_each_fault(call, full, work, afterwards);
        }
    }
}

}  // namespace
}  // namespace gumcert::archive
