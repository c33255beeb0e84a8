#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "self_test/case_run.h"

namespace gumcert::self_test {

/// A library that the program works with.
struct LibraryVersion {
    std::string name = {}, version = {};
    std::string sha256 = {};  ///< of its file; "": it is a part of the program
};

/// Which program ran where. The caller finds it out: nothing here reads the clock or asks the machine.
struct TestedSystem {
    std::string date = {};  ///< UTC, "2026-11-24T18:55:00Z"
    std::string name = {}, version = {}, commit = {}, compiler = {};
    std::string executable_sha256 = {};
    std::string processor = {}, operating_system = {};
    std::vector<LibraryVersion> libraries = {};
    std::string templates_sha256 = {};
    bool templates_of_release = true;     ///< false: somebody changed them
    bool cases_of_release = true;         ///< the same of the cases
    std::vector<std::string> fonts = {};  ///< families that documents can be set in; empty where they are not known
};

/// A run of the reference cases.
struct SelfTest {
    TestedSystem system;
    std::string unit_table_sha256 = {};  ///< it is a part of the program (docs/adr/0029-units-of-the-program-itself.md)
    std::string cases_sha256 = {};       ///< digest_of_cases()
    std::vector<CaseOutcome> cases = {};

    [[nodiscard]] std::size_t passed() const;
    [[nodiscard]] std::size_t compared() const;  ///< values of all cases
    [[nodiscard]] std::size_t agreed() const;
};

/// The cases in a folder, in the order of their names.
/// \throws gum::StorageError  GC-STORE-0016 if there is none
[[nodiscard]] std::vector<std::filesystem::path> case_files(const std::filesystem::path& folder);

/// SHA-256 of the lines "SHA-256  name" of the files, as sha256sum writes them.
/// \throws gum::StorageError  if one cannot be read
[[nodiscard]] std::string digest_of_cases(const std::vector<std::filesystem::path>& files);

/// Runs the cases side by side.
/// \param threads  0: as many as the machine has. Results do not depend on it
/// \param told     is called for every case, in the order of the files
/// \throws gum::StorageError  if a file cannot be read
[[nodiscard]] SelfTest run_self_test(const std::vector<std::filesystem::path>& files, unsigned threads,
                                     const std::filesystem::path& templates,
                                     const std::function<void(const CaseOutcome&)>& told = {});

/// Canonical JSON of schema gumcert/self-test/1; its member `digest` is the SHA-256 of the text without this member.
[[nodiscard]] std::string self_test_json(const SelfTest& test);

/// The SHA-256 that a text of self_test_json() states of itself.
[[nodiscard]] std::string digest_of_self_test(const std::string& json);

}  // namespace gumcert::self_test
