// What holds for every kind of store.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <vector>

#include "archive/store/open_store.h"
#include "encoding/sha2.h"
#include "tests/support/both_stores.h"
#include "tests/support/next_entry.h"

namespace gumcert::archive {
namespace {

using test::code_of;
using test::next_entry;

template <class Kind>
class StoreLaws : public test::OnBothStores<Kind> {
protected:
    const LogEntry first_ = next_entry();
    std::string place_;
    std::unique_ptr<Store> store_;

    void prepare() override {
        place_ = this->kind_.new_place();
        store_ = create_store(place_, first_);
    }
    [[nodiscard]] std::string code_of_append(const LogEntry& entry) {
        return code_of([&] { store_->write([&] { store_->append(entry); }); });
    }
    [[nodiscard]] static Content content_of(const std::string& bytes) { return {encoding::sha256(bytes), bytes}; }
};
TYPED_TEST_SUITE(StoreLaws, test::BothStores);

TYPED_TEST(StoreLaws, EntriesAndContentsAreKept) {
    const Content content = this->content_of(std::string("a\0b\xFF", 4));
    LogEntry second = next_entry(&this->first_, "key");
    second.record = content.sha256;
    second.hash = entry_hash(second);
    this->store_->write([&] {
        this->store_->put(content);
        this->store_->append(second);
        this->store_->list({"EX-2", "numbered", "", "", ""});
        this->store_->list({"EX-1", "numbered", "2026-11-24T18:52:52Z", "", ""});
        this->store_->list({"EX-1", "drafted", "2026-11-24T18:52:52Z", "a gauge", content.sha256});
    });
    this->store_.reset();
    const auto store = open_store(this->place_, Access::read_only);
    EXPECT_EQ(store->last_entry(), second);
    EXPECT_EQ(store->entry_of_request("key"), second);
    EXPECT_EQ(store->entry_of_request(""), std::nullopt);
    EXPECT_EQ(store->entries_of("EX-1"), std::vector{second});
    EXPECT_EQ(store->listed(),
              (std::vector<ListedCertificate>{{"EX-1", "drafted", "2026-11-24T18:52:52Z", "a gauge", content.sha256},
                                              {"EX-2", "numbered", "", "", ""}}));
    EXPECT_TRUE(store->has(content.sha256));
    EXPECT_FALSE(store->has(std::string(64, '0')));
    EXPECT_EQ(store->content(content.sha256), content.bytes);
    EXPECT_EQ(store->content(std::string(64, 'a')), std::nullopt);
    EXPECT_TRUE(store->own_problems().empty());
    EXPECT_EQ(code_of([&] { store->write([&] { store->append(next_entry(&second)); }); }), "GC-ARCHIVE-0006")
        << "it is opened for reading";
    EXPECT_EQ(store->last_entry(), second);
}

TYPED_TEST(StoreLaws, AllIsReadInItsOrder) {
    std::vector<LogEntry> all{this->first_};
    this->store_->write([&] {
        for (int i = 0; i < 2500; ++i) {  // more than a page of a server
            all.push_back(next_entry(&all.back()));
            this->store_->append(all.back());
        }
        for (int i = 0; i < 20; ++i) {
            this->store_->put(this->content_of(std::to_string(i)));
        }
    });
    std::vector<LogEntry> read;
    this->store_->each_entry([&](const LogEntry& entry) { read.push_back(entry); });
    EXPECT_EQ(read, all);
    read.clear();
    this->store_->entries_of_kind("numbered", [&](const LogEntry& entry) {
        read.push_back(entry);
        return true;
    });
    std::reverse(read.begin(), read.end());
    EXPECT_EQ(read, std::vector(all.begin() + 1, all.end()));
    int visited = 0;
    this->store_->entries_of_kind("numbered", [&](const LogEntry&) { return ++visited < 3; });
    EXPECT_EQ(visited, 3);
    std::size_t contents = 0;
    this->store_->each_content([&](const Content& content) {
        EXPECT_EQ(encoding::sha256(content.bytes), content.sha256);
        ++contents;
    });
    EXPECT_EQ(contents, 20U);
}

TYPED_TEST(StoreLaws, WorkIsKeptWholeOrNotAtAll) {
    EXPECT_THROW(this->store_->write([&] {
        this->store_->put(this->content_of("a"));
        this->store_->append(next_entry(&this->first_));
        throw std::runtime_error("on the way");
    }),
                 std::runtime_error);
    EXPECT_EQ(this->store_->last_entry(), this->first_);
    EXPECT_FALSE(this->store_->has(this->content_of("a").sha256));
    EXPECT_EQ(this->code_of_append(next_entry(&this->first_)), "");
}

TYPED_TEST(StoreLaws, AnArchiveIsBegunOnceAndWhole) {
    const std::string other = this->kind_.new_place();
    EXPECT_EQ(code_of([&] { (void)open_store(other, Access::read_only); }), "GC-ARCHIVE-0001");
    EXPECT_THROW((void)create_store(other, this->first_, [](Store&) { throw std::runtime_error("on the way"); }),
                 std::runtime_error);
    EXPECT_EQ(code_of([&] { (void)open_store(other, Access::read_only); }), "GC-ARCHIVE-0001");
    EXPECT_EQ(code_of([&] { (void)create_store(other, this->first_); }), "");
    EXPECT_EQ(code_of([&] { (void)create_store(other, this->first_); }), "GC-ARCHIVE-0002");
    EXPECT_EQ(open_store(other, Access::read_only)->last_entry(), this->first_) << "it is somebody else's";
}

TYPED_TEST(StoreLaws, OnlyWhatFollowsIsTaken) {
    LogEntry gap = next_entry(&this->first_);
    gap.seq = 3;
    LogEntry other_chain = next_entry(&this->first_);
    other_chain.prev[0] ^= 1;
    LogEntry unknown_record = next_entry(&this->first_);
    unknown_record.record = std::string(64, 'a');
    for (const LogEntry& wrong : {gap, other_chain, unknown_record, this->first_}) {
        EXPECT_EQ(this->code_of_append(wrong), "GC-ARCHIVE-0034");
    }
    EXPECT_EQ(this->store_->last_entry(), this->first_);
    const LogEntry second = next_entry(&this->first_, "key");
    EXPECT_EQ(this->code_of_append(second), "");
    EXPECT_EQ(this->code_of_append(next_entry(&second, "key")), "GC-ARCHIVE-0034") << "a key is used once";
    const auto put = [&] { this->store_->write([&] { this->store_->put(this->content_of("a")); }); };
    EXPECT_EQ(code_of(put), "");
    EXPECT_EQ(code_of(put), "GC-ARCHIVE-0034");
}

/// Each writer sees what the ones before it wrote.
TYPED_TEST(StoreLaws, WritersQueue) {
    std::vector<std::thread> writers;
    for (int writer = 0; writer < 8; ++writer) {
        writers.emplace_back([&] {
            const auto store = open_store(this->place_, Access::read_and_write);
            for (int i = 0; i < 20; ++i) {
                store->write([&] {
                    const std::optional<LogEntry> last = store->last_entry();
                    store->append(next_entry(&*last));
                });
            }
        });
    }
    for (std::thread& writer : writers) {
        writer.join();
    }
    EXPECT_EQ(this->store_->last_entry()->seq, 161);
}

TYPED_TEST(StoreLaws, ACopyIsOneFile) {
    const LogEntry second = next_entry(&this->first_);
    this->store_->write([&] {
        this->store_->append(second);
        this->store_->list({"EX-1", "numbered", second.at, "", ""});
    });
    const test::StoreFolder& folder = this->kind_.folder();
    this->store_->copy_to(folder.file("copy"));
    EXPECT_EQ(open_store(folder.file("copy").string(), Access::read_only)->listed(), this->store_->listed());
    EXPECT_EQ(this->code_of_append(next_entry(&second)), "");
    EXPECT_EQ(open_store(folder.file("copy").string(), Access::read_only)->last_entry(), second);
    EXPECT_FALSE(std::filesystem::exists(folder.file("copy-wal")));
}

}  // namespace
}  // namespace gumcert::archive
