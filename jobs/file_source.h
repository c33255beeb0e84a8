#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::jobs {

/// Largest file that is read, [byte].
inline constexpr std::size_t k_file_limit = std::size_t{64} << 20U;

/// Files of the laboratory folder have names that begin so, where the folder is not named by the job itself.
inline constexpr std::string_view k_laboratory_prefix = "laboratory:/";

/// Where a reader gets the files of a job from: a folder, or memory for tests.
class FileSource {
public:
    virtual ~FileSource() = default;

    /// The bytes of a file; never more than `k_file_limit` + 1, so that a larger file can be recognised and refused.
    /// \param name  as the job names it, relative to the job file
    /// \throws StorageError  if the file cannot be opened or read, or is not a regular file
    [[nodiscard]] virtual std::string read(const std::string& name) const = 0;
    /// Whether there are files of a laboratory, with k_laboratory_prefix before their names; they go before the folder
    /// that a job names.
    [[nodiscard]] virtual bool has_laboratory() const { return false; }
    /// Names without ".json" of the JSON files in a folder, in their order, for messages; none where nobody can say.
    /// \param folder  as the job would name a file in it: "laboratory:/standards/"
    [[nodiscard]] virtual std::vector<std::string> json_files(const std::string& folder) const;
};

/// Files of one folder of the disk, and of folders that a name leads to by `..`. A name shows where it leads: where `..` goes
/// up from is the folder before it in the name, and no symbolic link leads out of the folder at which the name begins.
class DiskFileSource : public FileSource {
public:
    /// Of the files beside a job, which the user names himself: it may be a link to anywhere.
    [[nodiscard]] static DiskFileSource of_job(const std::filesystem::path& job_file,
                                               std::filesystem::path laboratory = {}) {
        DiskFileSource source(job_file.parent_path(), std::move(laboratory));
        source.job_ = job_file.filename().string();
        return source;
    }
    /// \param laboratory  the folder of the laboratory; "": none
    explicit DiskFileSource(std::filesystem::path folder, std::filesystem::path laboratory = {})
        : folder_(std::move(folder)), laboratory_(std::move(laboratory)) {}
    [[nodiscard]] std::string read(const std::string& name) const override;
    [[nodiscard]] bool has_laboratory() const override { return !laboratory_.empty(); }
    [[nodiscard]] std::vector<std::string> json_files(const std::string& folder) const override;

private:
    std::filesystem::path folder_, laboratory_;
    std::string job_;  ///< "": no file is named by the user himself
};

/// Files in memory, name to content.
class MemoryFileSource : public FileSource {
public:
    explicit MemoryFileSource(std::map<std::string, std::string> files) : files_(std::move(files)) {}
    [[nodiscard]] std::string read(const std::string& name) const override;
    /// Where one of the names has the prefix: a record holds what was read of the laboratory under these names.
    [[nodiscard]] bool has_laboratory() const override;
    [[nodiscard]] std::vector<std::string> json_files(const std::string& folder) const override;

private:
    std::map<std::string, std::string> files_;
};

/// Another source of which every file is read once: what is parsed, parsed again and digested are the same bytes, also
/// where a file changes meanwhile. Two spellings of a name ("a.csv", "x/../a.csv") are two names.
class ReadOnceSource : public FileSource {
public:
    explicit ReadOnceSource(const FileSource& source) : source_(source) {}
    [[nodiscard]] std::string read(const std::string& name) const override;
    [[nodiscard]] bool has_laboratory() const override { return source_.has_laboratory(); }
    [[nodiscard]] std::vector<std::string> json_files(const std::string& folder) const override {
        return source_.json_files(folder);
    }

private:
    const FileSource& source_;
    mutable std::mutex lock_;
    mutable std::map<std::string, std::string> read_;
};

}  // namespace gumcert::jobs
