// What the fuzz targets demand, of their seeds and of small changes of them, wherever the tests run.
#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "tests/fuzz/workbook_targets.h"
#include "tests/support/word_mutations.h"

namespace gumcert::workbook {
namespace {

constexpr std::array<std::string_view, 36> k_words_of_workbooks{"A1",
                                                                "$B$2",
                                                                ":",
                                                                "!",
                                                                "'",
                                                                "\"",
                                                                "(",
                                                                ")",
                                                                "{",
                                                                "}",
                                                                ",",
                                                                ";",
                                                                "[1]",
                                                                "]",
                                                                "%",
                                                                "^",
                                                                "-",
                                                                "+",
                                                                "SUM(",
                                                                "IF(",
                                                                "1E9",
                                                                "0",
                                                                ".5",
                                                                " ",
                                                                "#REF!",
                                                                "TRUE",
                                                                "Sheet1!",
                                                                "A:A",
                                                                "<c r=\"B7\">",
                                                                "</c>",
                                                                "<f>",
                                                                "</f>",
                                                                "<v>",
                                                                "&amp;",
                                                                "\n",
                                                                "\t"};

TEST(WorkbookMutations, FormulasAreReadOrRefused) {
    test::run_word_mutations({.target = "workbook_formula",
                              .seeds = 5,
                              .accepted_seeds = 4,
                              .words = k_words_of_workbooks,
                              .random_seed = 1,
                              .count = 4000},
                             test::read_any_formula);
}

TEST(WorkbookMutations, PartsAreReadOrRefused) {
    test::run_word_mutations({.target = "workbook_xlsx",
                              .seeds = 2,
                              .accepted_seeds = 1,
                              .words = k_words_of_workbooks,
                              .random_seed = 2,
                              .count = 1500},
                             test::read_any_xlsx);
}

TEST(WorkbookMutations, CsvFilesAreReadOrRefused) {
    test::run_word_mutations({.target = "workbook_csv",
                              .seeds = 4,
                              .accepted_seeds = 3,
                              .words = k_words_of_workbooks,
                              .random_seed = 3,
                              .count = 3000},
                             test::read_any_csv);
}

}  // namespace
}  // namespace gumcert::workbook
