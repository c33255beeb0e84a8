#include "archive/store/file_names.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/support/archive_folder.h"

namespace gumcert::archive {
namespace {

namespace fs = std::filesystem;
using test::code_of;

class FileNames : public testing::Test {
protected:
    void SetUp() override { std::ofstream(file_) << "an archive"; }

    const test::StoreFolder folder_;
    const fs::path file_ = folder_.file();
};

TEST_F(FileNames, AFileIsOneByWhateverNameThatLeadsToIt) {
    const FileIdentity identity = identity_of(file_);
    EXPECT_NE(identity, FileIdentity{});
    fs::create_symlink(file_, folder_.file("link"));
    EXPECT_EQ(identity_of(folder_.file("link")), identity);
    fs::create_hard_link(file_, folder_.file("second"));
    EXPECT_EQ(identity_of(folder_.file("second")), identity);
    std::ofstream(folder_.file("other")) << "an archive";
    EXPECT_NE(identity_of(folder_.file("other")), identity) << "the same bytes are no name";
    EXPECT_EQ(identity_of(folder_.file("nothing")), FileIdentity{});
}

/// SQLite names the log after the name of the file: hard links are two logs, a symbolic link is not.
TEST_F(FileNames, SeveralLinksAreRefusedAndSymbolicOnesAreNot) {
    const FileIdentity opened = identity_of(file_);
    EXPECT_FALSE(may_have_another_name(file_));
    EXPECT_EQ(code_of([&] { require_one_name(file_, opened); }), "");
    fs::create_symlink(file_, folder_.file("link"));
    EXPECT_FALSE(may_have_another_name(folder_.file("link")));
    EXPECT_EQ(code_of([&] { require_one_name(folder_.file("link"), opened); }), "");
    fs::create_hard_link(file_, folder_.file("second"));
    for (const char* const name : {"a.archive", "second", "link"}) {
        EXPECT_TRUE(may_have_another_name(folder_.file(name))) << name;
        EXPECT_EQ(code_of([&] { require_one_name(folder_.file(name), opened); }), "GC-ARCHIVE-0014") << name;
    }
    fs::remove(folder_.file("second"));
    EXPECT_EQ(code_of([&] { require_one_name(file_, opened); }), "");
    EXPECT_FALSE(may_have_another_name(folder_.file("nothing"))) << "opening says that there is none";
}

TEST_F(FileNames, AnotherFileByTheNameOfTheOneThatWasOpenedIsRefused) {
    const FileIdentity opened = identity_of(file_);
    fs::rename(file_, folder_.file("moved"));
    EXPECT_EQ(code_of([&] { require_one_name(file_, opened); }), "GC-ARCHIVE-0014") << "moved away";
    std::ofstream(file_) << "another archive";
    EXPECT_EQ(code_of([&] { require_one_name(file_, opened); }), "GC-ARCHIVE-0014") << "another file";
    fs::remove(file_);
    fs::rename(folder_.file("moved"), file_);
    EXPECT_EQ(code_of([&] { require_one_name(file_, opened); }), "") << "back again";
}

TEST_F(FileNames, FilesBesideTheArchiveAreWritableLikeItself) {
    EXPECT_EQ(code_of([&] { require_rights_to_write(file_); }), "");
    EXPECT_EQ(code_of([&] { require_rights_to_write(folder_.file("nothing")); }), "") << "it can be made";
    if (geteuid() == 0) {
        GTEST_SKIP() << "root may write everything";
    }
    for (const char* const name : {"a.archive-wal", "a.archive-shm", "a.archive-journal", "a.archive"}) {
        std::ofstream(folder_.file(name), std::ios::app) << "x";
        fs::permissions(folder_.file(name), fs::perms::owner_read);
        EXPECT_EQ(code_of([&] { require_rights_to_write(file_); }), "GC-ARCHIVE-0006") << name;
        fs::permissions(folder_.file(name), fs::perms::owner_read | fs::perms::owner_write);
    }
}

}  // namespace
}  // namespace gumcert::archive
