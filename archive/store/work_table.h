#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gumcert::archive {

/// Some work that several machines share: the same question about many certificates.
struct SharedWork {
    std::string id;       ///< digest of all that the results depend on: asked again, the work goes on where it was
    std::string program;  ///< version and commit of the program that may do it: results of two versions are not mixed
    std::string kind;     ///< what is to be done with a task
    std::string input;    ///< what all tasks have in common
};

/// A part of it that one worker does.
struct WorkTask {
    std::string name;   ///< number of the certificate
    std::string input;  ///< "" where the name says all
};

/// A table of tasks on the server that has the archive, in a schema of its own, gumcert_work. Nothing of the archive
/// depends on it: what is lost with it is computed again. (docs/adr/0060-workers-of-an-archive.md)
///
/// Every function throws gum::StorageError as the stores of archives do.
class WorkTable {
public:
    using DoTasks = std::function<std::vector<std::string>(const std::vector<WorkTask>&)>;

    WorkTable() = default;
    WorkTable(const WorkTable&) = delete;
    WorkTable& operator=(const WorkTable&) = delete;
    virtual ~WorkTable() = default;

    /// Puts work with its tasks into the table, where it is not there yet: all of it or nothing.
    virtual void add(const SharedWork& work, const std::vector<WorkTask>& tasks) = 0;
    /// The oldest work of a program that has tasks without a result.
    [[nodiscard]] virtual std::optional<SharedWork> next(const std::string& program) = 0;
    /// Takes up to `most` tasks that no other worker has, and keeps their results, in one transaction: where the worker
    /// ends before, by whatever, they are free again, and no result is kept twice.
    /// \param work  one result for each task
    /// \return number of tasks that were done; 0 where all are done, or in the hands of others
    virtual std::size_t do_some(const std::string& id, std::size_t most, const DoTasks& work) = 0;
    /// Number of tasks without a result.
    [[nodiscard]] virtual std::size_t open_tasks(const std::string& id) = 0;
    /// By name of the task.
    virtual void each_result(const std::string& id,
                             const std::function<void(const std::string& name, const std::string& result)>& visit) = 0;
    /// Removes work with its tasks and results.
    virtual void remove(const std::string& id) = 0;
};

/// \param address  "postgresql://…"
[[nodiscard]] std::unique_ptr<WorkTable> open_work_table(const std::string& address);

}  // namespace gumcert::archive
