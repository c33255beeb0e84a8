#include "archive/store/store.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "encoding/sha2.h"
#include "tests/support/archive_folder.h"

namespace gumcert::archive {
namespace {

/// A store with contents and nothing else.
class Contents : public Store {
public:
    std::map<std::string, std::string> bytes;

    [[nodiscard]] std::string name() const override { return "contents"; }
    void read(const std::function<void()>& work) override { work(); }
    void write(const std::function<void()>& work) override { work(); }
    void append(const LogEntry&) override {}
    void put(const Content& content) override { bytes[content.sha256] = content.bytes; }
    void list(const ListedCertificate&) override {}
    [[nodiscard]] bool has(const std::string& sha256) override { return bytes.contains(sha256); }
    [[nodiscard]] std::optional<LogEntry> last_entry() override { return std::nullopt; }
    [[nodiscard]] std::optional<LogEntry> entry_of_request(const std::string&) override { return std::nullopt; }
    [[nodiscard]] std::vector<LogEntry> entries_of(const std::string&) override { return {}; }
    void entries_of_kind(const std::string&, const std::function<bool(const LogEntry&)>&) override {}
    [[nodiscard]] std::vector<ListedCertificate> listed() override { return {}; }
    void each_entry(const std::function<void(const LogEntry&)>&) override {}
    void each_content(const std::function<void(const Content&)>&) override {}
    [[nodiscard]] std::vector<std::string> own_problems() override { return {}; }
    void copy_to(const std::filesystem::path&) override {}

private:
    [[nodiscard]] std::optional<std::string> stored_bytes(const std::string& sha256) override {
        const auto found = bytes.find(sha256);
        return found == bytes.end() ? std::nullopt : std::optional(found->second);
    }
};

/// Whatever a store gives back under a hash has it: of every byte that is another one, the content is refused.
TEST(Store, NobodyGoesOnWithBytesOfAnotherHash) {
    Contents store;
    const std::string record = "{\"schema\": \"gumcert/record/1\"}";
    const std::string hash = encoding::sha256(record);
    EXPECT_EQ(store.content(hash), std::nullopt);
    store.put({hash, record});
    EXPECT_EQ(store.content(hash), record);
    for (std::size_t i = 0; i < record.size(); ++i) {
        store.bytes[hash][i] = static_cast<char>(store.bytes[hash][i] ^ 1);
        EXPECT_EQ(test::code_of([&] { (void)store.content(hash); }), "GC-ARCHIVE-0012") << i;
        store.bytes[hash] = record;
    }
    for (const std::string& other : {record + " ", record.substr(1), std::string()}) {
        store.bytes[hash] = other;
        EXPECT_EQ(test::code_of([&] { (void)store.content(hash); }), "GC-ARCHIVE-0012") << other;
    }
    const std::string nothing = encoding::sha256("");
    store.put({nothing, ""});
    EXPECT_EQ(store.content(nothing), "") << "no bytes are a content, too";
}

}  // namespace
}  // namespace gumcert::archive
