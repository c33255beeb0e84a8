#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace gumcert::certificate {
namespace {

const std::filesystem::path k_tree = GUMCERT_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void find_all(const std::string& text, const char* pattern, const std::string& prefix, std::set<std::string>& found) {
    const std::regex expression(pattern);
    for (std::sregex_iterator i(text.begin(), text.end(), expression); i != std::sregex_iterator(); ++i) {
        found.insert(prefix + (*i)[1].str());
    }
}

/// Ids that the gates and the makers of records can give: texts of the form "X01", and the letters of FindingList::item.
std::set<std::string> ids_of_the_program() {
    std::set<std::string> ids;
    for (const char* folder : {"certificate", "reports/record/make"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(k_tree / folder)) {
            if (entry.path().extension() != ".cpp") {
                continue;
            }
            const std::string text = text_of(entry.path());
            find_all(text, R"re("([A-Z][0-9]{2}(?:-[0-9][a-z])?)")re", "", ids);
            find_all(text, R"re(found\.item\([^']*'([a-p])')re", "R07-", ids);
        }
    }
    return ids;
}

/// Ids in the first column of the tables of docs/findings.md.
std::set<std::string> ids_of_the_document() {
    std::set<std::string> ids;
    find_all(text_of(k_tree / "docs" / "findings.md"), R"re(\n\| ([A-Z][0-9]{2}(?:-[0-9a-z]+)?) \|)re", "", ids);
    return ids;
}

TEST(FindingsDocument, NamesEveryFindingThatTheProgramGivesAndNoOther) {
    const std::set<std::string> given = ids_of_the_program();
    EXPECT_GT(given.size(), 40U);
    EXPECT_EQ(given, ids_of_the_document());
}

}  // namespace
}  // namespace gumcert::certificate
