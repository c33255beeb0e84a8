#include "outputs/refusal_log.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "outputs/output_files.h"

namespace gumcert::outputs {

namespace {

constexpr std::string_view k_beginning = "{\"at\":\"";  // of every line

/// Whether a file is empty, or begins as a log of refusals does.
bool is_refusal_log(int file) {
    struct stat status = {};
    std::array<char, k_beginning.size()> first{};
    return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
           (status.st_size == 0 ||
            (::pread(file, first.data(), first.size(), 0) == static_cast<ssize_t>(first.size()) &&
             std::string_view(first.data(), first.size()) == k_beginning));
}

std::string line_of(const Refusal& refusal) {
    constexpr std::size_t k_longest_place = 1000;  // [byte]
    nlohmann::ordered_json line;
    line["at"] = refusal.at;
    line["command"] = refusal.command;
    line["code"] = refusal.code;
    line["where"] = refusal.where.substr(0, k_longest_place);
    return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string append_refusal(const std::filesystem::path& log, const Refusal& refusal) {
    if (is_beside_an_archive(log)) {
        return "its name is that of a file that SQLite keeps beside an archive";
    }
    const auto reason = [] { return std::generic_category().message(errno); };
    const int file = ::open(log.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0600);
    if (file < 0) {
        return reason();
    }
    std::string failure;
    const std::string line = line_of(refusal);
    if (!is_refusal_log(file)) {
        failure = "it is no log of refusals";
    } else if (::write(file, line.data(), line.size()) != static_cast<ssize_t>(line.size())) {  // one call, one line
        failure = reason();
    }
    ::close(file);
    return failure;
}

}  // namespace gumcert::outputs
