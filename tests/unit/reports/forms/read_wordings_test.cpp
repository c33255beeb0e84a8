#include "reports/forms/read_wordings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

Wording named(const std::string& language) {
    return Wording(nlohmann::json{{"language", language}});
}

TEST(ReadWordings, ReadEachWordingOnce) {
    ReadWordings wordings;
    std::vector<std::string> read;
    const auto ask = [&](const std::vector<std::string>& key) {
        return wordings.find_or_read(key, [&] {
            read.push_back(key.back());
            return named(key.back());
        });
    };
    EXPECT_EQ(ask({"templates", "de"}).language(), "de");
    EXPECT_EQ(ask({"templates", "es"}).language(), "es");
    EXPECT_EQ(ask({"templates", "de"}).language(), "de");
    EXPECT_EQ(read, (std::vector<std::string>{"de", "es"}));
}

TEST(ReadWordings, KeepNothingOfOneThatCannotBeRead) {
    ReadWordings wordings;
    const auto broken = [&] {
        return wordings.find_or_read({"de"}, []() -> Wording { throw std::runtime_error("damaged"); });
    };
    EXPECT_THROW(static_cast<void>(broken()), std::runtime_error);
    EXPECT_EQ(wordings.find_or_read({"de"}, [] { return named("de"); }).language(), "de");
}

TEST(ReadWordings, OutliveWhatTheyWereFoundIn) {
    const Wording kept = [] {
        ReadWordings wordings;
        return wordings.find_or_read({"de"}, [] { return named("de"); });
    }();
    EXPECT_EQ(kept.language(), "de");
    EXPECT_THROW(static_cast<void>(kept.group("document")), gum::StorageError);
}

}  // namespace
}  // namespace gumcert::reports
