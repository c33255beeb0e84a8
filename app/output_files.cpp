#include "app/output_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>

#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{"GC-STORE-0002", path.string(), what,
                                            "output files appear whole or not at all",
                                            "choose another folder with -o, or free the disk", gum::Severity::error});
}

std::string reason() {
    return std::strerror(errno);
}  // NOLINT(concurrency-mt-unsafe): one thread writes

std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

void synchronise_folder(const std::filesystem::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        (void)fsync(descriptor);  // a file system that cannot synchronise a folder does not lose the file for it
        close(descriptor);
    }
}

void write_whole(const std::filesystem::path& path, const std::string& bytes) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (descriptor < 0) {
        refuse(path, "cannot be created: " + reason());
    }
    std::size_t written = 0;
    while (written < bytes.size()) {
        const ssize_t count = write(descriptor, bytes.data() + written, bytes.size() - written);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            const std::string why = reason();
            close(descriptor);
            refuse(path, "cannot be written: " + why);
        }
        written += static_cast<std::size_t>(count);
    }
    if (fsync(descriptor) != 0 || close(descriptor) != 0) {
        refuse(path, "cannot be brought to the disk: " + reason());
    }
}

}  // namespace

void require_writable(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) {
        refuse(file, "is a folder, a file is needed");
    }
    // The first folder upwards that exists decides; what is below it will be made.
    std::filesystem::path folder = std::filesystem::absolute(folder_of(file), error).lexically_normal();
    while (!std::filesystem::exists(folder, error) && folder.has_relative_path()) {
        folder = folder.parent_path();
    }
    if (!std::filesystem::is_directory(folder, error)) {
        refuse(folder, "is not a folder");
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        refuse(folder, "cannot be written: " + reason());
    }
}

void require_not_an_input(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs) {
    std::error_code error;
    for (const std::filesystem::path& input : inputs) {
        if (std::filesystem::equivalent(output, input, error)) {
            throw gum::StorageError(gum::Diagnostic{
                "GC-STORE-0004", output.string(), "is an input of this command and would be overwritten",
                "inputs are never changed", "choose another name with -o", gum::Severity::error});
        }
    }
}

void write_files(const std::vector<OutputFile>& files) {
    for (const OutputFile& file : files) {
        require_writable(file.path);  // before the first is in place
    }
    std::vector<std::filesystem::path> temporary;
    try {
        for (const OutputFile& file : files) {
            std::error_code error;
            std::filesystem::create_directories(folder_of(file.path), error);
            if (error) {
                refuse(folder_of(file.path), "cannot be made: " + error.message());
            }
            temporary.push_back(folder_of(file.path) /
                                ("." + file.path.filename().string() + "." + std::to_string(getpid()) + ".part"));
            write_whole(temporary.back(), file.bytes);
        }
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (std::rename(temporary[i].c_str(), files[i].path.c_str()) != 0) {
                refuse(files[i].path, "cannot be put in place: " + reason());
            }
        }
    } catch (...) {
        for (const std::filesystem::path& path : temporary) {
            std::error_code ignored;
            std::filesystem::remove(path, ignored);
        }
        throw;
    }
    std::set<std::filesystem::path> folders;
    for (const OutputFile& file : files) {
        folders.insert(folder_of(file.path));
    }
    for (const std::filesystem::path& folder : folders) {
        synchronise_folder(folder);
    }
}

}  // namespace gumcert::app
