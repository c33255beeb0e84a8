#include "outputs/kept_files.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "gum/quantity/diagnostic.h"

namespace gumcert::outputs {
namespace {

TEST(KeptFiles, HaveAFolderOfTheirOwn) {
    EXPECT_EQ(kept_place("out/record.json"), "out/record-kept/record.json");
    EXPECT_EQ(kept_place("record.json"), "record-kept/record.json");
}

/// What make_or_keep() throws, and whether it kept anything.
template <class Error>
std::pair<std::string, bool> outcome_of(const Error& error) {
    bool kept = false;
    try {
        make_or_keep([&] { throw error; }, [&] { kept = true; });
    } catch (const gum::InputError&) {
        return {"input", kept};
    } catch (const gum::NoResultError&) {
        return {"no result", kept};
    } catch (const gum::StorageError& storage) {
        return {"storage " + storage.diagnostics().front().code, kept};
    } catch (const std::runtime_error&) {
        return {"other", kept};
    }
    return {"nothing", kept};
}

TEST(KeptFiles, AreWrittenWhereADocumentCannotBeMade) {
    const gum::Diagnostic why{.code = "GC-X-0001", .where = "", .what = "", .rule = "", .action = ""};
    EXPECT_EQ(outcome_of(gum::StorageError(why)), std::pair(std::string("storage GC-X-0001"), true));
    EXPECT_EQ(outcome_of(gum::NoResultError(why)), std::pair(std::string("storage GC-X-0001"), true))
        << "there is a result, and its files";
    EXPECT_EQ(outcome_of(gum::InputError(why)), std::pair(std::string("input"), false)) << "nothing is written then";
    EXPECT_EQ(outcome_of(std::runtime_error("")), std::pair(std::string("other"), true));
}

TEST(KeptFiles, AreNotWrittenWhereAllIsMade) {
    bool kept = false;
    make_or_keep([] {}, [&] { kept = true; });
    EXPECT_FALSE(kept);
}

}  // namespace
}  // namespace gumcert::outputs
