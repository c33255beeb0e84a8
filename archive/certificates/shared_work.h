#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "archive/archive.h"
#include "archive/certificates/affected_certificates.h"
#include "archive/certificates/archive_replay.h"
#include "archive/store/work_table.h"
#include "gum/monte_carlo/worker_threads.h"
#include "gum/quantity/progress.h"

namespace gumcert::archive {

/// Work with its tasks, as it is put into the table.
struct WorkToShare {
    SharedWork work;
    std::vector<WorkTask> tasks;
};

/// The recalculation of affected certificates, a task for each.
/// \param program  version and commit
[[nodiscard]] WorkToShare work_of(const std::vector<AffectedCertificate>& affected, const Correction& correction,
                                  const std::string& program);
/// The replay of archived records, a task for each.
/// \param records  number of the certificate and SHA-256 of its record
[[nodiscard]] WorkToShare work_of_replay(const std::vector<std::pair<std::string, std::string>>& records,
                                         const std::string& program);

/// One of those that do shared work, on all cores of its machine.
class ArchiveWorker {
public:
    /// \param threads    as of gum::WorkerThreads
    /// \param templates  of this machine
    /// \param watch      as of Correction
    ArchiveWorker(Archive& archive, WorkTable& table, unsigned threads, std::filesystem::path templates,
                  std::function<gum::Progress()> watch = {})
        : archive_(archive),
          table_(table),
          threads_(threads),
          templates_(std::move(templates)),
          watch_(std::move(watch)) {}

    /// Does some tasks that nobody else has.
    /// \return how many; 0 where none is left, or others have them
    std::size_t do_some(const SharedWork& work);
    /// How many of those that it did were not evaluated, as where a limit ended them.
    [[nodiscard]] std::size_t not_evaluated() const { return not_evaluated_; }
    /// Shares work with all other workers until it is done. Work that was begun before goes on.
    /// \param wait  is called where others have the last tasks
    void finish(const WorkToShare& shared, const std::function<void()>& wait, const gum::Progress& progress);

private:
    Archive& archive_;
    WorkTable& table_;
    gum::WorkerThreads threads_;
    std::filesystem::path templates_;
    std::function<gum::Progress()> watch_;
    std::size_t not_evaluated_ = 0;
};

/// Puts the results of shared work into the certificates, and ranks them.
/// \throws gum::StorageError  GC-ARCHIVE-0063 where somebody else has removed the work
void take_results(std::vector<AffectedCertificate>& affected, WorkTable& table, const WorkToShare& shared);
/// By number of the certificate.
/// \throws gum::StorageError  GC-ARCHIVE-0063 where somebody else has removed the work
[[nodiscard]] Replays replays_in(WorkTable& table, const WorkToShare& shared);

}  // namespace gumcert::archive
