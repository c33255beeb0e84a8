#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "outputs/output_files.h"

namespace gumcert::evaluation {

/// A calibration that comes with the program: a folder with a job that runs.
struct Method {
    std::string name;   ///< "multimeter"
    std::string title;  ///< one line, English
    std::filesystem::path folder;
    std::string job;                 ///< name of the job in the folder
    std::vector<std::string> files;  ///< names of its files in the folder, the job first
};

/// The methods in a folder of examples, in the order of its methods.json.
/// \throws gum::StorageError  GC-STORE-0001 if it cannot be read, GC-STORE-0012 if it is damaged
[[nodiscard]] std::vector<Method> method_library(const std::filesystem::path& examples);

/// The method whose name is nearest to a word; "" where none is near.
[[nodiscard]] std::string nearest_method(const std::vector<Method>& methods, const std::string& word);

/// Copies the files of a method into a new folder.
/// \param folder  that does not exist yet, or is empty
/// \return the files that were written, the job first
/// \throws gum::StorageError  GC-STORE-0007 if there is something in the folder already; and nothing is written
std::vector<std::filesystem::path> begin_with(const Method& method, const std::filesystem::path& folder);

}  // namespace gumcert::evaluation
